"""Values of polynomials in float64 and their bounds, against Fractions."""

from __future__ import annotations

from fractions import Fraction
from math import prod

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from geartrain.numerics.bounded_polynomials import (
    BoundedPolynomial,
    BoundedQuotient,
    Monomial,
    in_range,
    monomial_of,
    products_of,
)

Terms = list[tuple[int, Monomial]]

WIDTH = 3
powers = st.tuples(*[st.integers(0, 3)] * WIDTH).map(monomial_of)
coefficients = st.one_of(st.integers(-9, 9), st.integers(-(10**30), 10**30)).filter(bool)
sums = st.lists(st.tuples(coefficients, powers), min_size=1, max_size=4, unique_by=lambda term: term[1])
points = st.lists(st.tuples(*[st.one_of(st.integers(1, 40), st.integers(1, 10**12))] * WIDTH), min_size=1, max_size=6)


def exact(terms: Terms, point: tuple[int, ...]) -> Fraction:
    each = (prod((Fraction(point[at]) ** power for at, power in monomial), start=Fraction(c)) for c, monomial in terms)
    return sum(each, Fraction(0))


@given(sums, sums, points)
def test_values_are_off_by_no_more_than_their_bounds(upper: Terms, lower: Terms, at: list[tuple[int, ...]]) -> None:
    product = products_of(list(np.array(at, dtype=np.float64).T))
    scale = max(abs(c) for c, _ in (*upper, *lower))
    sides = [BoundedPolynomial.of(terms, scale, [1] * WIDTH) for terms in (upper, lower)]
    for terms, side in zip((upper, lower), sides, strict=True):
        values, errors = (np.broadcast_to(part, len(at)) for part in side.bounded(product))
        for point, value, error in zip(at, values, errors, strict=True):
            assert abs(Fraction(float(value)) - exact(terms, point) / scale) <= Fraction(float(error))
    values, errors = (np.broadcast_to(part, len(at)) for part in BoundedQuotient(*sides).bounded(product))
    for point, value, error in zip(at, values, errors, strict=True):
        if error < np.inf:
            truth = exact(upper, point) / exact(lower, point)
            assert abs(Fraction(float(value)) - truth) <= Fraction(float(error))


def test_a_bound_is_of_use_where_nothing_cancels_and_infinite_at_a_pole() -> None:
    x, y = ((0, 1),), ((1, 1),)
    sides = [BoundedPolynomial.of(terms, 1, [1, 1]) for terms in ([(1, x), (1, y)], [(1, x), (-1, y)])]
    assert sides[0].relative < 1e-14
    assert sides[1].relative is None
    _, errors = BoundedQuotient(*sides).bounded(products_of([np.array([3.0, 7.0]), np.array([2.0, 7.0])]))
    assert errors[0] < 1e-13
    assert errors[1] == np.inf


def test_terms_near_the_ends_of_floats_are_told() -> None:
    assert in_range([(10**30, (2, 2)), (Fraction(1, 10**9), (0, 0))], [12, 12])
    assert not in_range([(1, (9, 9))], [12, 12])
    assert not in_range([(Fraction(1, 10**300), (0, 0))], [12, 12])
