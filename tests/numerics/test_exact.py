"""The counting room: elimination, rank modulo a prime, and numbers beyond the range of floats."""

from __future__ import annotations

from decimal import Context, Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_solver import echelon
from sampling import few_or_many
from scipy.optimize import linprog

from geartrain.numerics import decimal
from geartrain.numerics.elimination import TooDenseError, eliminate, feasible
from geartrain.numerics.exact import log10

SAMPLE = few_or_many(30, 60)  # systems of each law; `--slow` draws new ones, and twice as many
coefficients = st.fractions(min_value=-5, max_value=5, max_denominator=4)


@st.composite
def systems(draw: st.DrawFn) -> list[dict[int, Fraction]]:
    """Rows in up to six unknowns and up to two symbols (columns -1, -2), some of them multiples of others."""
    columns = st.sampled_from([-2, -1, 0, 1, 2, 3, 4, 5])
    rows = draw(st.lists(st.dictionaries(columns, coefficients.filter(bool), max_size=4), max_size=7))
    for row in draw(st.lists(st.sampled_from(rows), max_size=2)) if rows else []:
        rows.append({column: 3 * value for column, value in row.items()})
    return rows


def dense(rows: list[dict[int, Fraction]], columns: list[int]) -> list[list[Fraction]]:
    return [[row.get(column, Fraction(0)) for column in columns] for row in rows]


@settings(max_examples=SAMPLE)
@given(systems())
def test_elimination_leaves_a_system_with_the_same_solutions(rows: list[dict[int, Fraction]]) -> None:
    found, order = eliminate(rows), [0, 1, 2, 3, 4, 5, -1, -2]
    kept = [{**rest, column: Fraction(1)} for column, rest in found.pivots] + list(found.conditions)
    before, after = dense(rows, order), dense(kept, order)
    echelon(before, 8)
    echelon(after, 8)
    assert [row for row in before if any(row)] == [row for row in after if any(row)]


@settings(max_examples=SAMPLE)
@given(systems())
def test_forms_are_free_of_pivots_and_satisfy_every_row(rows: list[dict[int, Fraction]]) -> None:
    found = eliminate(rows)
    forms = found.forms()
    assert set(forms) == {column for column, _ in found.pivots}
    assert all(column not in forms for form in forms.values() for column in form)
    conditions = dense(list(found.conditions), [-1, -2])
    rank = len(echelon(conditions, 2))
    for row in rows:
        put_in: dict[int, Fraction] = {}
        for column, value in row.items():
            for other, factor in forms.get(column, {column: Fraction(1)}).items():
                put_in[other] = put_in.get(other, Fraction(0)) + value * factor
        put_in = {column: value for column, value in put_in.items() if value}
        assert all(column < 0 for column in put_in), "what is left is a condition on symbols"
        assert len(echelon([*conditions, *dense([put_in], [-1, -2])], 2)) == rank, "and follows from the conditions"


def test_elimination_stops_at_its_budget() -> None:
    size = 30
    rows = [{j: Fraction(1, i + j + 1) for j in range(size)} for i in range(size)]
    with pytest.raises(TooDenseError):
        eliminate(rows, budget=1000)
    assert eliminate(rows).rank == size, "the Hilbert matrix is regular"


def test_a_chain_of_substitutions_costs_linear_work() -> None:
    rows = [{at: Fraction(1), at + 1: Fraction(-2)} for at in range(5000)] + [{5000: Fraction(1)}]
    assert eliminate(rows, budget=4 * 5001).rank == 5001


@given(st.integers(-(10**40), 10**40).filter(bool), st.integers(1, 10**40), st.integers(-600, 600))
def test_decimal_is_what_the_standard_library_rounds_to(top: int, bottom: int, shift: int) -> None:
    value = Fraction(top, bottom) * Fraction(10) ** shift
    context = Context(prec=10, Emax=10**6, Emin=-(10**6))
    exact = Context(prec=60, Emax=10**6, Emin=-(10**6))
    right = context.plus(exact.divide(Decimal(value.numerator), Decimal(value.denominator)))
    found = Decimal(decimal(value, 10))
    assert abs(found - right) <= abs(right) * Decimal("1.01e-9")
    assert (found < 0) == (value < 0)


def test_decimal_rounds_up_through_a_power_of_ten() -> None:
    assert Decimal(decimal(Fraction(10**400) - 1, 5)) == Decimal("1e400")


@given(st.integers(1, 10**300), st.integers(1, 10**300))
def test_log10_works_for_numbers_of_any_size(top: int, bottom: int) -> None:
    value = Fraction(top, bottom)
    assert log10(value * 10**400) - log10(value) == pytest.approx(400)
    assert log10(-value) == log10(value)
    assert log10(1 / value) == pytest.approx(-log10(value))


@given(st.lists(st.lists(st.integers(-3, 3), min_size=4, max_size=4), min_size=1, max_size=7))
def test_forms_can_all_be_kept_above_zero_where_linear_programming_says_so(rows: list[list[int]]) -> None:
    forms = [{column - 1: Fraction(value) for column, value in enumerate(row) if value} for row in rows]
    matrix = np.array(rows, dtype=float)
    # the constant stands in the column -1; in floats: is there an x with matrix x >= -constant
    truth = linprog(np.zeros(3), A_ub=-matrix[:, 1:], b_ub=matrix[:, 0], bounds=(None, None), method="highs")
    assert feasible(forms) == (truth.status == 0)
