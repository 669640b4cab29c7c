"""Laurent polynomials: the laws of a ring, determinants by their definition, divisors against Euclid at points."""

from __future__ import annotations

import itertools
import random
from fractions import Fraction
from math import prod

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from geartrain.kinematics.formulas import laurent
from geartrain.kinematics.formulas.laurent import Laurent, TooLongError, common_divisor, divide, minors
from geartrain.kinematics.formulas.output_formulas import GIVEN, solve_rows
from geartrain.kinematics.formulas.rational_functions import find_grouping

WIDTH = 3


def polynomials(most: int = 4, powers: tuple[int, int] = (-2, 2)) -> st.SearchStrategy[Laurent]:
    exponents = st.tuples(*[st.integers(*powers)] * WIDTH)
    coefficients = st.fractions(-9, 9, max_denominator=4).filter(bool)
    return st.dictionaries(exponents, coefficients, max_size=most).map(lambda terms: Laurent(WIDTH, terms))


points = st.tuples(*[st.integers(1, 9)] * WIDTH)


def at(p: Laurent, point: tuple[int, ...]) -> Fraction:
    """The value, written down apart from the package."""
    return sum(
        (
            value * prod(Fraction(base) ** power for base, power in zip(point, exponents, strict=True))
            for exponents, value in p.terms.items()
        ),
        Fraction(0),
    )


@given(polynomials(), polynomials(), polynomials(), points)
def test_laurent_polynomials_are_a_commutative_ring_and_their_values_are_numbers(
    p: Laurent, q: Laurent, r: Laurent, point: tuple[int, ...]
) -> None:
    zero, one = Laurent.constant(0, WIDTH), Laurent.constant(1, WIDTH)
    assert (p + q) + r == p + (q + r)
    assert p + q == q + p
    assert p + zero == p * one == p
    assert p - p == zero
    assert -p == zero - p
    assert p * q == q * p
    assert (p * q) * r == p * (q * r)
    assert p * (q + r) == p * q + p * r
    assert at(p + q, point) == at(p, point) + at(q, point)
    assert at(p * q, point) == at(p, point) * at(q, point)
    assert all((p * q).terms.values()), "no term is 0"


@given(polynomials(), points)
def test_residues_are_those_of_the_value(p: Laurent, point: tuple[int, ...]) -> None:
    prime = 1_000_003
    value = at(p, point)
    assert p.modulo(point, prime) == value.numerator * pow(value.denominator, -1, prime) % prime


@given(polynomials(1).filter(bool))
def test_a_monomial_has_an_inverse(p: Laurent) -> None:
    assert p.is_unit
    assert p * p.inverse() == Laurent.constant(1, WIDTH)


@given(polynomials())
def test_a_primitive_polynomial_is_a_multiple_by_a_unit_in_whole_numbers(p: Laurent) -> None:
    simple = p.primitive()
    assert simple.primitive() == simple
    if p:
        unit = divide(p, simple)
        assert unit is not None
        assert unit.is_unit
        assert all(value.denominator == 1 for value in simple.terms.values())
        assert all(min(powers) == 0 for powers in zip(*simple.terms, strict=True))


def test_a_product_past_every_use_is_refused() -> None:
    long = Laurent(1, {(power,): Fraction(1) for power in range(500)})
    with pytest.raises(TooLongError):
        long * long


def by_permutations(rows: list[dict[int, Laurent]], columns: list[int]) -> Laurent:
    total = zero = Laurent.constant(0, WIDTH)
    for order in itertools.permutations(range(len(columns))):
        swaps = sum(order[i] > order[j] for i, j in itertools.combinations(range(len(columns)), 2))
        term = Laurent.constant((-1) ** swaps, WIDTH)
        for row, column in zip(rows, order, strict=True):
            term = term * row.get(columns[column], zero)
        total = total + term
    return total


@given(st.data(), st.integers(1, 4))
def test_minors_are_signed_sums_over_permutations(data: st.DataObject, size: int) -> None:
    entries = st.one_of(st.none(), polynomials(2, (-1, 1)))
    rows = [{c: entry for c in range(size + 1) if (entry := data.draw(entries)) is not None} for _ in range(size)]
    found = minors(rows, WIDTH)
    for left_out in range(size + 1):
        assert found[left_out] == by_permutations(rows, [c for c in range(size + 1) if c != left_out])


@given(polynomials(), polynomials().filter(bool))
def test_a_product_divided_by_a_factor_is_the_other_and_a_remainder_is_seen(p: Laurent, q: Laurent) -> None:
    assert divide(p * q, q) == p
    found = divide(p * q + Laurent.variable(0, WIDTH), q)
    assert found is None or found * q == p * q + Laurent.variable(0, WIDTH)


def euclid(p: list[Fraction], q: list[Fraction]) -> int:
    """Degree of the greatest common divisor of two univariate polynomials, coefficients by power."""
    while q:
        while len(p) >= len(q):
            factor, start = p[-1] / q[-1], len(p) - len(q)
            p = [a - factor * q[k - start] if k >= start else a for k, a in enumerate(p)][:-1]
        while p and not p[-1]:
            p.pop()
        p, q = q, p
    return len(p) - 1


def image(p: Laurent, variable: int, point: tuple[int, ...]) -> list[Fraction]:
    """The coefficients by power of one variable where the others are numbers."""
    powers = [exponents[variable] for exponents in p.terms]
    found = [Fraction(0)] * (max(powers) - min(powers) + 1)
    for exponents, value in p.terms.items():
        rest = tuple(0 if k == variable else power for k, power in enumerate(exponents))
        found[exponents[variable] - min(powers)] += at(Laurent(WIDTH, {rest: value}), point)
    return found


@given(polynomials(3, (0, 2)).filter(bool), polynomials(3, (0, 2)).filter(bool), polynomials(3, (0, 2)).filter(bool))
def test_a_common_divisor_divides_both_holds_all_that_is_common_and_no_more(p: Laurent, q: Laurent, r: Laurent) -> None:
    found = common_divisor(p * r, q * r)
    assert divide(p * r, found) is not None
    assert divide(q * r, found) is not None
    assert divide(found, r) is not None
    for variable in range(WIDTH):
        # at a point where no leading coefficient vanishes, the images have at least the divisor's degree in common
        images = [image(each, variable, (10_007, 20_011, 30_011)) for each in (p * r, q * r, found)]
        assume(all(each[-1] and each[0] for each in images))
        assert len(images[2]) - 1 == euclid(images[0], images[1])


@given(st.lists(polynomials().filter(bool), min_size=1, max_size=2), points)
def test_grouped_polynomials_have_the_same_quotients(given_: list[Laurent], point: tuple[int, ...]) -> None:
    grouping = find_grouping(given_)
    back = [grouping.back(p, WIDTH) for p in grouping.rewritten]
    units = [divide(p, q) for p, q in zip(given_, back, strict=True)]
    assert all(unit is not None and unit.is_unit for unit in units)
    assert len({tuple(unit.terms.items()) for unit in units if unit}) == 1, "all by one monomial"
    variables = [variable for members in grouping.members for variable in members]
    assert len(variables) == len(set(variables))


@settings(max_examples=40)
@given(st.data(), st.integers(1, 4))
def test_solved_rows_agree_with_elimination_in_numbers_at_any_point(data: st.DataObject, size: int) -> None:
    entries = st.one_of(st.none(), polynomials(2, (-1, 1)).filter(bool))
    rows = []
    for _ in range(size):
        row = {c: entry for c in (*range(size), GIVEN) if (entry := data.draw(entries)) is not None}
        rows.append(row)
    solution = solve_rows(rows, WIDTH)
    point = data.draw(points)
    matrix = [[at(row[c], point) if c in row else Fraction(0) for c in range(size)] for row in rows]
    right = [-at(row[GIVEN], point) if GIVEN in row else Fraction(0) for row in rows]
    known = gauss(matrix, right)
    if known is None or solution.conditions:
        return
    for column in range(size):
        value = solution.value({column: Laurent.constant(1, WIDTH)})
        assert value is not None, "what is determined at a point is determined nearly everywhere"
        bottom = at(solution.denominator(value), point)
        assert bottom, "a regular system has no vanishing determinant"
        assert at(value.numerator, point) / bottom == known[column]


def gauss(matrix: list[list[Fraction]], right: list[Fraction]) -> list[Fraction] | None:
    """The solution of a regular square system in numbers; None of a singular one."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for column in range(len(rows)):
        lead = next((k for k in range(column, len(rows)) if rows[k][column]), None)
        if lead is None:
            return None
        rows[column], rows[lead] = rows[lead], rows[column]
        rows[column] = [value / rows[column][column] for value in rows[column]]
        for k, row in enumerate(rows):
            if k != column and row[column]:
                rows[k] = [a - row[column] * b for a, b in zip(row, rows[column], strict=True)]
    return [row[-1] for row in rows]


def test_many_unknowns_that_all_hang_on_each_other_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(laurent, "MOST_PRODUCTS", 5000)
    draw = random.Random(1)
    rows = [
        {c: Laurent.variable(draw.randrange(3), WIDTH) + Laurent.constant(draw.randint(1, 9), WIDTH) for c in range(20)}
        for _ in range(20)
    ]
    with pytest.raises(TooLongError):
        solve_rows(rows, WIDTH)
