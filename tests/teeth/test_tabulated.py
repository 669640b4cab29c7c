"""Tabulated laws against the laws they were made from: stated error, order of convergence, many turns, standstills."""

from __future__ import annotations

from math import pi, radians
from typing import Any

import numpy as np
import pytest

from geartrain.teeth import TransmissionFunction
from geartrain.teeth.transmission_table import CellTable, fit, folded_kinks
from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth, find_window


def transmission_of(
    z1: int, z2: int, beta: float = 30, excess: float | None = None, direction: int = 1
) -> TriangularTransmission:
    b = radians(beta)
    sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, b, b), b, b, 0.0)
    return TriangularTransmission(sizes.at(find_window(sizes).at(0.4) if excess is None else excess), 0.2, direction)


def random_transmissions(count: int) -> list[Any]:
    """Running pairs drawn at random, some turning backwards."""
    draw = np.random.default_rng(20)
    found: list[Any] = []
    while len(found) < count:
        z1, z2, beta = int(draw.integers(12, 300)), int(draw.integers(12, 300)), float(draw.uniform(12, 50))
        b = radians(beta)
        sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, b, b), b, b, 0.0)
        window = find_window(sizes)
        if window:
            at = sizes.at(window.at(draw.uniform(0.05, 0.95)))
            transmission = TriangularTransmission(at, 0.2, int(draw.choice([-1, 1])))
            found.append(pytest.param(transmission, id=f"{z1}-{z2}-{beta:.0f}deg"))
    return found


TRANSMISSIONS = [
    *random_transmissions(12),
    pytest.param(transmission_of(96, 96, 30, 0.01), id="two sub-phases"),
    pytest.param(transmission_of(45, 225, 30, 0.018), id="45-225 dwelling"),
    pytest.param(transmission_of(45, 225, 30, 0.018, -1), id="45-225 dwelling, backwards"),
    pytest.param(transmission_of(3, 7, 20, 0.2), id="3-7 dwelling"),
]


def angles(transmission: TransmissionFunction, count: int = 20_000, turns: float = 3) -> np.ndarray:
    return np.random.default_rng(5).uniform(-turns * 2 * pi, turns * 2 * pi, count)


def tables(transmission: TransmissionFunction, tolerance: float = 1e-12) -> dict[str, CellTable]:
    """Tables of all quantities to a tolerance in pitches, of the mean speed, and of 1."""
    scales = {"error": transmission.pitch * float(transmission.ratio), "speed": float(transmission.ratio)}
    kinks = folded_kinks(transmission)
    return {
        name: fit(getattr(transmission, name), transmission.period, kinks, tolerance * scale)
        for name, scale in (scales | {"efficiency": 1.0}).items()
    }


@pytest.mark.parametrize("transmission", TRANSMISSIONS)
def test_a_table_agrees_with_its_transmission_to_the_error_it_states(transmission: TriangularTransmission) -> None:
    made_tables, S = tables(transmission), angles(transmission)
    scales = {"error": transmission.sizes.p2, "speed": float(transmission.ratio), "efficiency": 1.0}
    for quantity, scale in scales.items():
        made = made_tables[quantity]
        direct, read = getattr(transmission, quantity)(S), made(S)
        assert np.array_equal(np.isnan(direct), np.isnan(read))
        assert made.uncertainty <= 1e-12 * scale
        assert np.nanmax(np.abs(direct - read)) <= made.uncertainty


@pytest.mark.parametrize(("degree", "order"), [(2, 3), (3, 4), (4, 5)])
@pytest.mark.parametrize(
    "transmission", [transmission_of(48, 96, 30, 0.01), transmission_of(12, 12), transmission_of(15, 60, 30, 0.04)]
)
def test_the_order_of_convergence_exceeds_the_degree_by_one(transmission: Any, degree: int, order: int) -> None:
    S, places = angles(transmission), np.unique(np.mod(transmission.kinks(), transmission.period))
    truth, steps = transmission.error(S), np.arange(2, 12)
    errors = [
        np.abs(CellTable(transmission.error, transmission.period, places, 2**step, degree)(S) - truth).max()
        for step in steps
    ]
    above = np.array(errors) / transmission.sizes.p2 > 2e-14  # the rest is rounding
    assert above.sum() >= 3
    slope = -np.polyfit(steps[above][-3:], np.log2(np.array(errors)[above][-3:]), 1)[0]
    assert order - 0.5 < slope < order + 0.5


def test_a_tolerance_below_rounding_ends_and_the_table_says_so() -> None:
    transmission = transmission_of(48, 96, 30, 0.01)
    table = tables(transmission, 1e-20)["error"]
    assert 0 < table.uncertainty < 1e-14 * transmission.sizes.p2
    assert table.cells <= 1024


def test_two_kinks_in_one_cell_and_one_on_its_edge() -> None:
    """Steps at 0, half a period and twice within one cell: each exact, whatever the cells."""
    period, places = 1.0, np.array([0.0, 0.3, 0.3001, 0.5])

    def stairs(S: np.ndarray) -> np.ndarray:
        return np.searchsorted(places, np.mod(S, period), side="right").astype(float)

    S = np.array([-0.5, -1e-9, 0.0, 0.29999, 0.3, 0.30005, 0.3001, 0.49999, 0.5, 0.7])
    for cells in (2, 8, 32):
        assert np.allclose(CellTable(stairs, period, places, cells)(S), stairs(S), atol=1e-13)


@pytest.mark.parametrize("count", [2, 32, 33, 300])
def test_few_and_many_kinks_are_followed(count: int) -> None:
    """A polygon is interpolated between its corners, whether each corner is compared or the corners are searched."""
    rng = np.random.default_rng(count)
    corners, heights = np.sort(rng.uniform(0, 1, count)), rng.uniform(-1, 1, count)

    def polygon(S: Any) -> Any:
        return np.interp(S, corners, heights, period=1.0)

    S = rng.uniform(-3, 3, 5000)
    assert fit(polygon, 1.0, corners, 1e-9)(S) == pytest.approx(polygon(S), abs=1e-8)
