"""The least value of functions with kinks, steps and many minima, at places that are known."""

from __future__ import annotations

from math import cos, floor, pi

import pytest

from geartrain.workshop.sizes.size_search import minimise, polish


def test_of_many_minima_with_kinks_the_minimum_is_found() -> None:
    """|x - 0.37| + 0.2 |sin| has a kink at every tooth; its least is where both vanish nearest to 0.37."""
    found = minimise(lambda at: abs(at[0] - 0.37) + 0.1 * (1 - cos(40 * pi * (at[0] - 0.37))), [(-1.0, 2.0)])
    assert found.best[0] == pytest.approx(0.37, abs=1e-6)
    assert len(found.seen) < 150


def test_a_minimum_at_a_bound_is_found() -> None:
    found = minimise(lambda at: at[0], [(0.25, 1.0)])
    assert found.best[0] == pytest.approx(0.25, abs=1e-6)


def test_a_step_is_no_hindrance() -> None:
    """Falls to 0.6 and is far higher beyond: the least is at the step."""
    found = minimise(lambda at: 1 - at[0] if at[0] <= 0.6 else 1e3, [(0.0, 1.0)])
    assert found.best[0] == pytest.approx(0.6, abs=1e-6)


@pytest.mark.parametrize("bend", [0.0, 0.5])
def test_a_valley_with_a_kink_along_its_bottom_is_followed(bend: float) -> None:
    """|y - x^2 bend| is not smooth where it is least: what moves along one variable at a time would stick there."""

    def value(at: tuple[float, ...]) -> float:
        x, y = at
        return abs(y - bend * x * x) + 0.05 * (x - 0.3) ** 2 + 0.2 * floor(3 * abs(x - 0.3))

    found = minimise(value, [(-1.0, 1.0), (-1.0, 1.0)])
    assert value(found.best) < 2e-4


def test_starts_are_never_lost() -> None:
    """A hole that nobody would find: the start in it is what is returned."""
    found = minimise(lambda at: -1.0 if at == (0.123456789,) else at[0] ** 2, [(-1.0, 1.0)], [(0.123456789,)])
    assert found.best == (0.123456789,)
    polish(found, (0.9,))
    assert found.best == (0.123456789,)
