"""Tabulated laws against the laws they were made from: stated error, order of convergence, many turns, standstills."""

from __future__ import annotations

from fractions import Fraction
from math import pi, radians
from typing import Any

import numpy as np
import pytest
from studies.reference_solutions import reference

from geartrain.teeth import Ideal, TransmissionFunction
from geartrain.teeth.transmission_table import CellTable, TabulatedTransmission
from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth, find_window


def law_of(
    z1: int, z2: int, beta: float = 30, excess: float | None = None, direction: int = 1
) -> TriangularTransmission:
    b = radians(beta)
    sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, b, b), b, b, 0.0)
    return TriangularTransmission(sizes.at(find_window(sizes).at(0.4) if excess is None else excess), 0.2, direction)


def random_laws(count: int) -> list[Any]:
    """Running pairs drawn at random, some turning backwards."""
    draw = np.random.default_rng(20)
    found: list[Any] = []
    while len(found) < count:
        z1, z2, beta = int(draw.integers(12, 300)), int(draw.integers(12, 300)), float(draw.uniform(12, 50))
        b = radians(beta)
        sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, b, b), b, b, 0.0)
        window = find_window(sizes)
        if window:
            law = TriangularTransmission(sizes.at(window.at(draw.uniform(0.05, 0.95))), 0.2, int(draw.choice([-1, 1])))
            found.append(pytest.param(law, id=f"{z1}-{z2}-{beta:.0f}deg"))
    return found


STANDSTILLS = [
    pytest.param(law_of(45, 225, 30, 0.018), id="45-225 standing"),
    pytest.param(law_of(45, 225, 30, 0.018, -1), id="45-225 standing, backwards"),
    pytest.param(law_of(3, 7, 20, 0.2), id="3-7 standing"),
]
LAWS = [*random_laws(12), pytest.param(law_of(96, 96, 30, 0.01), id="two sub-phases"), *STANDSTILLS]


def angles(law: TransmissionFunction, count: int = 20_000, turns: float = 3) -> np.ndarray:
    return np.random.default_rng(5).uniform(-turns * 2 * pi, turns * 2 * pi, count)


@pytest.mark.parametrize("law", LAWS)
def test_a_table_agrees_with_its_law_to_the_error_it_states(law: TriangularTransmission) -> None:
    table, S = TabulatedTransmission(law), angles(law)
    scales = {"error": law.sizes.p2, "speed": float(law.ratio), "efficiency": 1.0}
    for quantity, scale in scales.items():
        made: CellTable = getattr(table, f"{quantity}_table")
        direct, read = getattr(law, quantity)(S), getattr(table, quantity)(S)
        assert np.array_equal(np.isnan(direct), np.isnan(read))
        assert made.uncertainty <= 1e-12 * scale
        assert np.nanmax(np.abs(direct - read)) <= made.uncertainty


@pytest.mark.parametrize("law", STANDSTILLS)
def test_a_standing_wheel_stands_in_the_table_too(law: TriangularTransmission) -> None:
    table, S = TabulatedTransmission(law), angles(law)
    standing = np.isnan(law.efficiency(S))
    assert 0 < standing.sum() < len(S)
    assert np.isnan(table.efficiency(S[standing])).all()
    assert np.abs(table.speed(S[standing])).max() <= table.speed_table.uncertainty


@pytest.mark.parametrize(("degree", "order"), [(2, 3), (3, 4), (4, 5)])
@pytest.mark.parametrize("law", [law_of(48, 96, 30, 0.01), law_of(12, 12), law_of(15, 60, 30, 0.04)])
def test_the_order_of_convergence_is_one_more_than_the_degree(
    law: TriangularTransmission, degree: int, order: int
) -> None:
    S, places = angles(law), np.unique(np.mod(law.corners(), law.period))
    truth, steps = law.error(S), np.arange(2, 12)
    errors = [np.abs(CellTable(law.error, law.period, places, 2**step, degree)(S) - truth).max() for step in steps]
    above = np.array(errors) / law.sizes.p2 > 2e-14  # the rest is rounding
    assert above.sum() >= 3
    slope = -np.polyfit(steps[above][-3:], np.log2(np.array(errors)[above][-3:]), 1)[0]
    assert order - 0.5 < slope < order + 0.5


@pytest.mark.parametrize("law", LAWS[:4] + STANDSTILLS)
def test_a_table_repeats_over_many_turns(law: TriangularTransmission) -> None:
    table = TabulatedTransmission(law)
    S = angles(law, 1_000, 0.5)
    for periods in (1, -7, 10**4, 10**7):
        far = S + periods * law.period
        assert np.abs(table.error(far) - law.error(far)).max() <= table.error_table.uncertainty + 1e-14 * law.sizes.p2
        turned = table.angle(far) - table.angle(S)
        rounding = 4e-16 * np.abs(far).max() * (1 + law.speed_range()[1])  # of both angles
        assert np.abs(turned - periods * law.sizes.p2).max() <= 2 * table.error_table.uncertainty + rounding
    assert table.ratio == Fraction(law.sizes.z1, law.sizes.z2)


@pytest.mark.parametrize("law", LAWS)
def test_the_driven_angle_never_falls(law: TriangularTransmission) -> None:
    table = TabulatedTransmission(law)
    S = np.linspace(-2 * law.period, 2 * law.period, 50_001)
    assert np.diff(table.angle(S)).min() >= -2 * table.error_table.uncertainty - 1e-15


def test_a_table_meets_the_definition_of_the_law_in_many_digits() -> None:
    law = law_of(96, 96, 30, 0.01)
    S = np.random.default_rng(3).uniform(0, law.period, 50)
    error, speed = reference(law.sizes, S)
    table = TabulatedTransmission(law)
    assert np.abs(table.error(S) - error).max() <= table.error_table.uncertainty + 1e-14 * law.sizes.p2
    assert np.abs(table.speed(S) - speed).max() <= table.speed_table.uncertainty + 1e-14


def test_a_coarser_tolerance_makes_a_smaller_table_that_keeps_it() -> None:
    law = law_of(12, 12)
    fine, coarse = (TabulatedTransmission(law, tolerance).error_table for tolerance in (1e-13, 1e-7))
    assert coarse.nbytes < fine.nbytes
    assert fine.uncertainty <= 1e-13 * law.sizes.p2 < coarse.uncertainty <= 1e-7 * law.sizes.p2


def test_a_tolerance_below_rounding_ends_and_the_table_says_so() -> None:
    law = law_of(48, 96, 30, 0.01)
    table = TabulatedTransmission(law, 1e-20).error_table
    assert 0 < table.uncertainty < 1e-14 * law.sizes.p2
    assert table.cells <= 1024


def test_any_shape_a_number_nothing_and_what_is_no_number() -> None:
    law = law_of(48, 96, 30, 0.01)
    table = TabulatedTransmission(law)
    assert table.error(np.zeros((3, 0))).shape == (3, 0)
    assert table.speed(0.1).shape == ()
    assert table.angle([[0.1, 0.2]]).shape == (1, 2)
    assert np.isnan(table.error([np.nan, np.inf, -np.inf])).all()


def test_a_law_without_corners_and_what_a_table_leaves_to_its_law() -> None:
    rigid = TabulatedTransmission(Ideal(form="ideal").law(20, 60))
    assert np.array_equal(rigid.angle([0.0, 3.0]), [0.0, 1.0])
    assert np.allclose(rigid.efficiency([0.0, 7.0]), 1, rtol=0, atol=1e-15)
    law = law_of(48, 96, 30, 0.01)
    table = TabulatedTransmission(law)
    assert table.speed_range() == law.speed_range()
    assert table.error_range() == law.error_range()
    assert table.error_moments() == law.error_moments()
    assert table.efficiency_mean() == law.efficiency_mean()
    assert table.efficiency_at_constant_load() == law.efficiency_at_constant_load()


def test_two_corners_in_one_cell_and_one_on_its_edge() -> None:
    """Steps at 0, half a period and twice within one cell: each exact, whatever the cells."""
    period, places = 1.0, np.array([0.0, 0.3, 0.3001, 0.5])

    def stairs(S: np.ndarray) -> np.ndarray:
        return np.searchsorted(places, np.mod(S, period), side="right").astype(float)

    S = np.array([-0.5, -1e-9, 0.0, 0.29999, 0.3, 0.30005, 0.3001, 0.49999, 0.5, 0.7])
    for cells in (2, 8, 32):
        assert np.allclose(CellTable(stairs, period, places, cells)(S), stairs(S), atol=1e-13)
