"""The best sizes of triangular teeth: against scans, another method and outlines; refusals."""

from __future__ import annotations

import json
import random
import re
from collections.abc import Sequence
from dataclasses import replace
from math import exp, pi, radians
from typing import Any

import numpy as np
import pytest
from places import DOCS
from scipy.optimize import differential_evolution

from geartrain.errors import QuestionError
from geartrain.teeth.triangular import TriangularTransmission, equal_depth
from geartrain.workshop import ProbabilityLimit, SizeLimit, ToothSizes, find_tooth_sizes

THIRTY = (pi / 6, pi / 6)
AIMS = ("loss", "error", "impact", "jam")


def pair(z1: int, z2: int, radii: float = 1.0, window: float = 0.5, friction: float = 0.2) -> ToothSizes:
    return ToothSizes((z1, z2), radii, window, THIRTY, friction)


def scanned(start: ToothSizes, aim: str, low: float, high: float) -> float:
    """The best of a scan in steps of 0.1 %."""
    steps = round((high - low) / 0.001)
    return min(start.at({"radii": low + step * 0.001}).merit(aim) for step in range(steps + 1))


# --------------------------------------------------------------------------------------------------- what is compared


@pytest.mark.parametrize(
    ("teeth", "equal", "true", "best"), [((48, 96), 3.19, 2.27, 0.94), ((15, 60), 10.3, 5.03, 2.65)]
)
def test_losses_of_radii_by_rule_and_of_better_ones(
    teeth: tuple[int, int], equal: float, true: float, best: float
) -> None:
    """Friction 0.2, half angle 30 deg, the middle of the window; 0.98 and 0.92 are the best in steps of 0.01."""
    start = pair(*teeth)
    R1, R2 = equal_depth(*teeth, *THIRTY)
    loss = [100 * start.at({"radii": each}).loss for each in (R2 / R1 * teeth[0] / teeth[1], 1.0)]
    assert loss == pytest.approx([equal, true], abs=0.05 if equal > 10 else 0.005)
    assert 100 * start.at({"radii": 0.98 if teeth == (48, 96) else 0.92}).loss == pytest.approx(best, abs=0.005)


@pytest.mark.parametrize("number", [np.float64, np.float32])
def test_sizes_may_be_numbers_of_numpy(number: type[np.floating]) -> None:
    teeth, angles = (np.int64(48), np.int64(96)), (number(0.5), number(0.5))
    found = ToothSizes(teeth, number(0.75), number(0.5), angles, number(0.25))
    plain = ToothSizes((48, 96), 0.75, 0.5, (0.5, 0.5), 0.25)
    assert found == plain
    assert [found.merit(aim) for aim in AIMS] == [plain.merit(aim) for aim in AIMS]
    assert json.dumps(found.at({"radii": number(1.0)}).to_dict()) == json.dumps(plain.at({"radii": 1.0}).to_dict())


@pytest.mark.parametrize("aim", AIMS)
def test_the_best_radii_are_no_worse_than_a_scan_in_steps_of_a_thousandth(aim: str) -> None:
    bounds = (0.95, 0.99)
    found = find_tooth_sizes(pair(48, 96), (aim,), {"radii": bounds})
    assert found.best.merit(aim) <= scanned(pair(48, 96), aim, *bounds)
    assert bounds[0] <= found.best.radii <= bounds[1]
    assert found.outlines.turns
    assert found.outlines.difference < 1e-4


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_the_best_radii_of_any_counts_are_no_worse_than_a_scan_of_all(seed: int) -> None:
    draw = random.Random(seed)
    start = pair(draw.randint(8, 120), draw.randint(8, 120), window=draw.uniform(0.2, 0.8))
    for aim in AIMS:
        found = find_tooth_sizes(start, (aim,))
        assert found.best.merit(aim) <= scanned(start, aim, 0.8, 1.25)
        # where another tooth pair barely touches, the outlines, which are polynomials, may miss it: 38/46 does so
        assert found.outlines.difference < 3e-3


@pytest.mark.long
@pytest.mark.parametrize("teeth", [(15, 60), (48, 96), (60, 15)])
@pytest.mark.parametrize("aim", ["loss", "error"])
def test_three_free_sizes_are_no_worse_than_what_differential_evolution_finds(teeth: tuple[int, int], aim: str) -> None:
    free = {"radii": (0.85, 1.1), "window": (0.2, 0.8), "half_angle": (radians(20), radians(40))}
    found = find_tooth_sizes(pair(*teeth), (aim,), free)

    def value(x: Sequence[float]) -> float:
        return min(pair(*teeth).at(dict(zip(free, map(float, x), strict=True))).merit(aim), 1e6)

    other = differential_evolution(value, list(free.values()), maxiter=40, popsize=10, seed=1, polish=False)
    assert found.best.merit(aim) <= other.fun * (1 + 1e-3)


@pytest.mark.slow
def test_two_free_sizes_are_better_than_one() -> None:
    """For the error of 15/60, in a small box: the kept result of differential evolution is 0.001065 rad for three."""
    free = {"radii": (0.94, 0.97), "window": (0.7, 0.8)}
    found = find_tooth_sizes(replace(pair(15, 60), half_angles=(radians(21.24),) * 2), ("error",), free)
    assert found.best.error < 0.001065
    assert found.best.window == pytest.approx(0.8, abs=1e-3)


# --------------------------------------------------------------------------------------------------------- definitions


def test_the_margin_is_how_far_the_axes_can_move_before_the_teeth_jam_or_lose_each_other() -> None:
    design = pair(15, 60, radii=0.94, window=0.3)
    sizes = design.sizes
    module = 2 * sizes.D / 75
    for way, kind in ((-1, "jam"), (1, None)):
        distances = (sizes.D + way * part * design.jam * module for part in (0.999, 1.001))
        near, beyond = (sizes.at(each / sizes.deepest_distance - 1) for each in distances)
        assert TriangularTransmission(near).verdict
        assert bool(TriangularTransmission(beyond).verdict) is (kind is None)


@pytest.mark.parametrize(("z1", "z2", "radii", "window"), [(96, 96, 1.0, 0.4), (48, 96, 0.98, 0.5)])
def test_the_impact_is_what_inelastic_collisions_dissipate(z1: int, z2: int, radii: float, window: float) -> None:
    """J (tau+ - tau-)^2 / 2 of each, over J tau^2 / 2 of the mean."""
    design = pair(z1, z2, radii=radii, window=window)
    assert design.transmission is not None
    spent = sum((jump.after - jump.before) ** 2 / 2 for jump in design.transmission.jumps)
    assert len(design.transmission.jumps) >= 1
    assert design.impact == pytest.approx(spent / ((z1 / z2) ** 2 / 2), rel=1e-12)


def test_swapped_wheels_driven_by_the_other_are_the_same_pair() -> None:
    one, other = pair(15, 60, radii=0.92), replace(pair(60, 15, radii=1 / 0.92), driver=2)
    for figure in ("loss", "error", "impact", "jam"):
        assert getattr(other, figure) == pytest.approx(getattr(one, figure), rel=1e-9)


# -------------------------------------------------------------------------------------------------- limits and fronts


def test_limits_are_kept_and_cost_something() -> None:
    free, limit = {"radii": (0.95, 1.0)}, SizeLimit("jam", 1.122)
    loose, tight = (find_tooth_sizes(pair(48, 96), ("loss",), free, limits) for limits in ((), (limit,)))
    assert loose.best.jam < limit.bound <= tight.best.jam
    assert tight.best.loss > loose.best.loss


def test_a_limit_on_a_chance_is_requested_of_few_designs_and_met() -> None:
    """A chance that falls at 0.9853: the best that is let in is there, for the loss rises from 0.9823 on."""
    requested: list[float] = []

    def chance(design: ToothSizes) -> float:
        requested.append(design.radii)
        return 0.0 if design.radii >= 0.9853 else 0.5

    found = find_tooth_sizes(pair(48, 96), free={"radii": (0.95, 1.0)}, probability=ProbabilityLimit(0.1, chance))
    assert 0.9853 <= found.best.radii < 0.9856
    assert found.stops == 0.0
    assert len(requested) < 20
    with pytest.raises(QuestionError, match="jam or clash with a probability above"):
        find_tooth_sizes(pair(48, 96), free={"window": (0.4, 0.6)}, probability=ProbabilityLimit(0.1, lambda _: 1.0))


def test_no_design_of_a_front_is_better_than_another_in_both() -> None:
    found = find_tooth_sizes(pair(15, 60, radii=0.95), ("loss", "error"), {"window": (0.3, 0.8)})
    losses, errors = [each.loss for each in found.front], [each.error for each in found.front]
    assert losses == sorted(losses)
    assert errors == sorted(errors, reverse=True)
    assert 20 < len(found.front) <= 200
    for one in found.front:
        assert not any(each.loss <= one.loss and each.error < one.error for each in found.tried)
        assert not any(each.loss < one.loss and each.error <= one.error for each in found.tried)
    # the ends are the optima of each objective
    assert found.front[0].loss == found.best.loss
    alone = find_tooth_sizes(pair(15, 60, radii=0.95), ("error",), {"window": (0.3, 0.8)})
    assert found.front[-1].error == pytest.approx(alone.best.error, rel=1e-6)


@pytest.mark.parametrize(
    ("friction", "aims", "free", "limits", "word"),
    [
        (0.2, ("speed",), None, {}, "does not name one objective"),
        (0.2, ("loss", "loss"), None, {}, "does not name one objective"),
        (0.2, ("loss",), {"depth": None}, {}, "not a free parameter"),
        (0.2, ("loss",), {"window": (0.5, 1.5)}, {}, "not valid"),
        (0.2, ("loss",), {"radii": (1.0, 0.9)}, {}, "not valid"),
        (0.2, ("loss",), {}, {}, "no parameter is free"),
        (0.2, ("loss",), {"radii": (0.98, 0.99)}, {"loss": 1e-4}, "violates a limit"),
        (0.2, ("loss",), {"radii": (0.98, 0.99)}, {"los": 0.01}, "loss"),
        (9.0, ("loss",), {"radii": (0.97, 0.98)}, {}, "no design in the ranges can turn"),
        (0.0, ("loss",), None, {}, "without friction"),
    ],
)
def test_what_cannot_be_requested_or_found_is_said(
    friction: float, aims: tuple[str, ...], free: Any, limits: dict[Any, float], word: str
) -> None:
    with pytest.raises(QuestionError, match=word):
        find_tooth_sizes(pair(48, 96, friction=friction), aims, free, [SizeLimit(*each) for each in limits.items()])


def test_outlines_and_transmission_agree_on_wheels_of_two_half_angles() -> None:
    design = replace(pair(24, 36, radii=0.97), half_angles=(0.5, 0.6))
    found = find_tooth_sizes(design, free={"radii": (0.97, 0.971)}).outlines
    assert found.turns
    assert found.difference < 1e-4


# ------------------------------------------------------------------------------------- the formula of the page on radii


PAGE = (DOCS / "best-radii.md").read_text(encoding="utf-8")
A, B = (float(each) for each in re.findall(r"-\s*([\d.]+)\\left\(", PAGE.split("$$")[1]))


def times_the_minimum(z1: int, z2: int) -> float:
    by_formula = pair(z1, z2, exp(-A * (1 / z1 - 1 / z2) - B * (1 / z1 + 1 / z2) ** 2))
    near = (by_formula.radii - 0.03, by_formula.radii + 0.03)
    return by_formula.loss / find_tooth_sizes(by_formula, free={"radii": near}).best.loss


OTHERS = ((13, 47), (47, 13), (22, 101), (101, 22), (71, 73), (11, 17), (113, 64), (64, 38))


@pytest.mark.parametrize("teeth", [(37, 89), *(pytest.param(each, marks=pytest.mark.long) for each in OTHERS)])
def test_the_law_holds_for_other_counts_than_those_it_was_fitted_to(teeth: tuple[int, int]) -> None:
    assert times_the_minimum(*teeth) < 1.02


def test_the_page_has_the_pairs_of_the_literature() -> None:
    """48/96 and 15/60: the best, pitch-true radii and equal depth."""
    rows = {row[0]: row[3:] for line in PAGE.splitlines() if len(row := line.strip("| ").split(" | ")) == 7}
    assert rows["48/96"] == ["0.89 %", "0.89 %", "2.27 %", "3.19 %"]
    assert rows["15/60"] == ["2.65 %", "2.65 %", "5.03 %", "10.27 %"]
