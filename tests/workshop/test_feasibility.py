"""Feasibility: figures computed by hand and by quadrature, closed forms of probabilities, and laws of the outcomes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import isinf, sqrt
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest

from geartrain import GearTrain, load
from geartrain.errors import DeclarationError, QuestionError
from geartrain.numerics import Execution, Journal
from geartrain.train.states import HandDrive
from geartrain.workshop import FeasibilityResult, find_feasibility_plan, read_error_overrides, run_feasibility
from geartrain.workshop.feasibility.feasibility_plan import LoadedPart, wedge_torque

NORMAL = NormalDist()
MOON = """
extends: moon-triangular
name: hand-made-moon
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
links:
  crank: {wheels: {a: {module: 0.5 mm}}}
  sun: {wheels: {b1: {module: 0.5 mm}, b2: {module: 0.5 mm}}}
  c: {wheels: {c1: {module: 0.5 mm}, c2: {module: 0.5 mm}}}
  d: {wheels: {d1: {module: 0.5 mm}, d2: {module: 0.5 mm}}}
  moon: {wheels: {e: {module: 0.5 mm}}}
thickness: 1.5 mm
material: sheet
materials: {sheet: {youngs_modulus: 105 GPa, strength: 140 MPa, spread: 0.35}}
loads: {moon: -1 N mm}
drive: {hand: {torque: 150 N mm, handle: 30 mm}}
"""
RANGE = "friction: {sliding: 0.2, range: [0.1, 0.3]}"
PAIR = """
name: pair
links: {frame: {}, a: {wheels: {p: {teeth: 20, module: 1 mm}}}, b: {wheels: {w: {teeth: 30, module: 1 mm}}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
inputs: {a: 1}
outputs: {b: {}}
tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}
loads: {b: 30 N mm}
thickness: 2 mm
material: sheet
materials: {sheet: {youngs_modulus: 105 GPa, strength: 140 MPa, spread: 0}}
"""


def plan_of(text: str, cutting: str = "", **how: Any) -> Any:
    return find_feasibility_plan(load(text), read_error_overrides([cutting] if cutting else []), **how)


def counts(found: FeasibilityResult) -> Mapping[str, int]:
    return {name: each.count for name, each in found.outcomes.items() if each.count}


# --------------------------------------------------------------------------------------------------- torques and forces


def test_the_torque_of_the_teeth_is_the_product_of_their_efficiencies() -> None:
    """Ratio 95/254, and each pair loses 0.2 of its factor by hand: 3.45216008 N mm at the crank for 1 N mm."""
    factors = {"a, b1": 0.241249, "b2, c1": 0.252230, "c2, d1": 0.408495, "d2, e": 0.333820}
    gears = ", ".join(f"{{pair: [{pair}], efficiency: {1 - 0.2 * loss:.9f}}}" for pair, loss in factors.items())
    plan = plan_of(MOON + f"gears: [{gears}]\n")
    assert plan.nominal is not None
    assert 1e3 * plan.nominal.crank == pytest.approx(3.45216008, abs=2e-8)
    assert plan.nominal.driven["d2~e"] == pytest.approx(1e-3)


def test_a_held_train_yields_first_at_the_tooth_with_the_largest_force() -> None:
    """Teeth of module 0.5, width 1.5 and 30 degrees yield at 110 MPa under 110 / K newtons at the pitch circle."""
    stiff = 3 / (1.5 * 1.36034952 * np.tan(np.radians(30)) ** 2)
    assert stiff == pytest.approx(4.41063116, abs=2e-8)
    radii = {"a~b1": 56.25, "b2~c1": 9.5, "c2~d1": 6.0, "d2~e": 8.0}
    plan = plan_of(MOON)

    def breaking(pair: str) -> tuple[float, str]:
        return min((110 / (stiff * torque / radii[name]), name) for name, torque in plan.held(pair).items())

    assert breaking("a~b1") == (pytest.approx(280.572089, abs=1e-6), "a~b1")
    for pair in ("b2~c1", "c2~d1", "d2~e"):
        assert breaking(pair) == (pytest.approx(79.8071720, abs=2e-7), "b2~c1")


def test_a_pair_that_jams_is_a_wedge() -> None:
    front, back = (0.533303317, 0.986484388), (0.477005708, 0.932847613)
    assert wedge_torque(1, front, back) == pytest.approx(10.4562747, rel=1e-8)
    assert wedge_torque(front[0], front, back) == pytest.approx(5.57636597, rel=1e-8)
    front, back = (0.500747886, 0.965080391), (0.522902827, 0.9731)
    opens = wedge_torque(1, (front[0], 1.0), (back[0], 1.0))
    assert opens == 0, "without friction the pair releases itself where the backlash opens"
    for efficiency, gain in ((0.99, 49.748744), (0.97, 16.412860), (0.95, 9.743590), (0.9, 4.736842)):
        assert wedge_torque(1, (1, efficiency), (1, efficiency)) == pytest.approx(gain, abs=5e-7)
    assert isinf(wedge_torque(1, (1, 1), (1, 1)))


def test_the_mean_torque_is_that_of_gauss_quadrature_over_the_friction() -> None:
    plan = plan_of(MOON + RANGE)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    torques = np.array([plan_of(MOON + f"friction: {0.2 + 0.1 * x!r}").nominal.crank for x in nodes.tolist()])  # type: ignore[union-attr]
    mean = weights @ torques / 2
    sd = sqrt(weights @ (torques - mean) ** 2 / 2)
    drawn = np.array([plan.drawn_loads(1, trial).crank for trial in range(48)])  # type: ignore[union-attr]
    assert drawn.mean() == pytest.approx(mean, abs=4 * sd / sqrt(48))
    assert drawn.std() == pytest.approx(sd, rel=0.2)
    assert sd / mean > 0.05
    # separate draws average out: the standard deviation falls to the root of the sum of the squares of the shares
    shares = np.array([0.241249, 0.252230, 0.408495, 0.333820])
    apart = replace(plan, per_part=True)
    own = np.array([apart.drawn_loads(1, trial).crank for trial in range(48)])  # type: ignore[union-attr]
    assert own.mean() == pytest.approx(mean, abs=4 * sd / sqrt(48))
    assert own.std() / drawn.std() == pytest.approx(sqrt(np.sum(shares**2)) / shares.sum(), rel=0.25)


# -------------------------------------------------------------------------------------------------------- probabilities


def test_the_strength_is_lognormal_and_drawn_once_per_workshop() -> None:
    plan = plan_of(MOON)
    drawn = plan.strengths(1, 20_000)
    assert (drawn == drawn[:, :1]).all()
    share = NORMAL.cdf(np.log(100 / 140) / 0.35)
    assert np.mean(drawn[:, 0] < 100) == pytest.approx(share, abs=4 * sqrt(share * (1 - share) / 20_000))
    apart = replace(plan, per_part=True).strengths(1, 2000)
    assert abs(np.corrcoef(np.log(apart[:, 0]), np.log(apart[:, 1]))[0, 1]) < 0.1
    assert np.array_equal(plan.strengths(1, 300), drawn[:300])


@pytest.mark.parametrize(
    ("accuracy", "jams", "pair"), [(0.1, 0.014, "a~b1"), (0.15, 0.902, "a~b1"), (0.2, 1.0, "a~b1")]
)
def test_the_moon_train_jams_as_often_as_in_512_trials(accuracy: float, jams: float, pair: str) -> None:
    found = run_feasibility(plan_of(MOON, f"pitch_deviation={accuracy} deg", outputs=("moon",)), 96)
    share = found.outcomes["jams"]
    assert share.interval[0] - 0.02 <= jams <= share.interval[1] + 0.02
    if share.count:
        assert next(iter(found.causes["jams"])) == pair
    forced = found.forced
    assert forced is not None
    if accuracy == 0.15:
        # the hand loads a~b1 with half of what the sheet bears, and its wedge with five times that
        assert forced["wedge"].value > 0.98
        assert forced["torque"].value < 0.08


def test_the_step_of_accuracy_lies_between_0_10_and_0_15_degrees() -> None:
    plan = plan_of(MOON, "pitch_deviation=0.05 deg", outputs=("moon",))
    found = run_feasibility(plan, 64, accuracies=(0.05, 0.1, 0.15, 0.2))
    shares = [step.value for step in found.curve.values()]
    assert shares == sorted(shares, reverse=True)
    assert shares[0] == 1
    assert shares[1] > 0.9 > 0.3 > shares[2] > shares[3] == 0
    half = found.accuracy_for(0.5)
    assert half is not None
    assert 0.1 < half < 0.15
    assert found.accuracy_for(1.1) is None
    assert counts(found) == {"turns": 64}
    direct = run_feasibility(plan_of(MOON, "pitch_deviation=0.15 deg", outputs=("moon",)), 64)
    assert direct.outcomes["turns"] == found.curve[0.15]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("window", "jams"),
    [(0.3, (0, 0.979, 1, 1)), (0.5, (0, 0.014, 0.902, 1)), (0.7, (0, 0, 0.07, 0.85))],
)
def test_the_step_moves_with_the_clearance(window: float, jams: tuple[float, ...]) -> None:
    text = MOON.replace("window: 0.5", f"window: {window}").replace("drive:", "case: null\n#")
    plan = plan_of(text.replace("case: null\n", ""), "pitch_deviation=0.05 deg", outputs=("moon",))
    found = run_feasibility(plan, 512, accuracies=(0.05, 0.1, 0.15, 0.2))
    for step, share in zip(found.curve.values(), jams, strict=True):
        assert step.value == pytest.approx(1 - share, abs=0.0006)


@pytest.mark.parametrize(
    ("hand", "strength", "outcome"), [(10, 140, "too stiff"), (90, 140, "turns"), (90, 1, "breaks")]
)
def test_without_spreads_every_trial_has_the_deterministic_outcome(hand: int, strength: int, outcome: str) -> None:
    text = PAIR.replace("strength: 140", f"strength: {strength}")
    found = run_feasibility(plan_of(text + f"drive: {{hand: {{torque: {hand} N mm}}}}\n"), 32)
    assert counts(found) == {outcome: 32}
    assert [*found.causes["breaks"]] == (["tooth of w"] if outcome == "breaks" else []), "the driven tooth is weaker"
    assert found.crank_torque is not None
    # 20 and 30 teeth without friction: two thirds of the load
    assert found.crank_torque[5.0].value == found.crank_torque[95.0].value == pytest.approx(20e-3)


def test_jams_that_the_torque_of_the_hand_cannot_break_are_not_counted_as_unbroken() -> None:
    """The planet jams in the fixed ring, which cannot be held."""
    text = """
extends: planetary-24-18-60
links:
  sun: {wheels: {s: {module: 1 mm}}}
  planet: {wheels: {p: {module: 1 mm}}}
  frame: {wheels: {ring: {module: 1 mm}}}
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
thickness: 2 mm
material: sheet
materials: {sheet: {youngs_modulus: 105 GPa, strength: 140 MPa}}
loads: {carrier: -10 N mm}
drive: {hand: {torque: 150 N mm}}
"""
    found = run_feasibility(plan_of(text, "pitch_deviation=1 deg"), 32)
    assert [*found.causes["jams"]] == ["p~ring"]
    assert found.forced is not None
    assert found.forced["torque"].of == found.forced["wedge"].of == 0


def test_outcomes_sum_to_one_and_what_is_not_declared_is_named() -> None:
    found = run_feasibility(plan_of(MOON + RANGE, "pitch_deviation=0.12 deg", outputs=("moon",)), 40)
    assert sum(each.count for each in found.outcomes.values()) == 40
    assert {each.of for each in found.outcomes.values()} == {40}
    assert found.neglected == ()
    assert "uniform" in found.conditions
    assert "once per workshop" in found.conditions
    bare = run_feasibility(find_feasibility_plan(load("moon-triangular"), outputs=("moon",)), 4)
    assert bare.crank_torque is None
    assert bare.forced is None
    assert bare.causes == {"cannot be cut": {}, "jams": {}, "breaks": {}}
    assert [each.partition(":")[0] for each in bare.neglected] == [
        "cutting errors",
        "crank torque and stresses",
        "the strength of the hand",
    ]


def test_wilsons_intervals_cover_the_probability_that_the_hand_is_too_weak() -> None:
    """The crank needs 20 N mm; a hand of 10 to 50 N mm is too weak with probability 1/4."""
    plan = plan_of(PAIR + "drive: {hand: {torque: 30 N mm, range: [10 N mm, 50 N mm]}}\n")
    hit = 0
    for seed in range(60):
        low, high = run_feasibility(plan, 32, seed).outcomes["too stiff"].interval
        hit += low <= 0.25 <= high
    assert 52 <= hit <= 60


def test_friction_that_locks_the_train_is_too_stiff_for_any_hand() -> None:
    # a triangular pair with a large coefficient of friction cannot be driven
    found = run_feasibility(plan_of(PAIR + "friction: 3\ndrive: {hand: {torque: 1000 N m}}\n"), 4)
    assert counts(found) == {"too stiff": 4}
    assert found.crank_torque is None


def test_an_arbor_breaks_at_its_pivot() -> None:
    """20 N mm at a pitch radius of 10 mm press 2 N on the flanks, and some more on one pivot: 16 F l / (pi d^3)."""
    text = PAIR.replace("a: {wheels", "a: {arbor: {diameter: 4 mm, span: 20 mm, pivot: D, material: sheet}, wheels")
    arbors = [part for part in plan_of(text.replace("D", "0.2 mm")).parts if part.name == "arbor of a"]
    (arbor,) = arbors
    # the pivot is as long as its diameter: 16 F / (pi d^2), with F from the tangential force of 2 N up to 1.3 of it
    assert 16 * 2 / (np.pi * 0.04) < arbor.stress < 1.3 * 16 * 2 / (np.pi * 0.04)
    thick = [part for part in plan_of(text.replace("D", "2 mm")).parts if part.name == "arbor of a"]
    assert thick[0].stress < 5


def test_the_stress_of_a_part_in_several_pairs_follows_the_pair_that_grows_most() -> None:
    part = LoadedPart("arbor of c", "brass", 100, 0.1, 10.0, {"x": 2.0, "y": 1.0})
    assert part.stresses({"x": np.array([2.0, 4.0]), "y": np.array([3.0, 1.0])}).tolist() == [30, 20]
    assert part.stresses({"z": 1.0}).tolist() == [0]


# ---------------------------------------------------------------------------------------------------- runs and refusals


class CutError(Exception):
    """Stands for a machine that stops."""


def test_a_resumed_run_has_the_same_result(tmp_path: Path) -> None:
    plan = plan_of(PAIR + RANGE, "pitch_deviation=1 %")
    whole = run_feasibility(plan, 80, accuracies=(0.5, 1.0)).to_dict()
    done = 0

    def stop(at: int, of: int) -> None:
        nonlocal done
        done = at
        if at >= 2:
            raise CutError

    path = tmp_path / "x.jsonl"
    with Journal(path, {}) as journal, pytest.raises(CutError):
        run_feasibility(plan, 80, accuracies=(0.5, 1.0), means=Execution(None, journal, stop))
    assert done >= 2
    with Journal(path, {}) as journal:
        assert len(journal) >= 1
        found = run_feasibility(plan, 80, accuracies=(0.5, 1.0), means=Execution(None, journal))
    assert found.to_dict() == whole


@pytest.mark.parametrize("accuracies", [(-0.1,), (float("inf"),), (0.1,) * 101])
def test_a_curve_of_other_accuracies_is_refused(accuracies: tuple[float, ...]) -> None:
    with pytest.raises(QuestionError, match="accurac"):
        run_feasibility(plan_of(PAIR), 2, accuracies=accuracies)


@pytest.mark.parametrize(
    "line",
    [
        "friction: {sliding: 0.4, range: [0.1, 0.3]}",
        "friction: {sliding: 0.2, range: [0.3, 0.1]}",
        "friction: {sliding: 0.2, range: [0.1, 0.3], deviation: 0.1}",
        "drive: {hand: {torque: 5 N mm, range: [10 N mm, 50 N mm]}}",
        "drive: {hand: {rate: 1, range: [10 N mm, 50 N mm]}}",
    ],
)
def test_a_range_that_does_not_fit_is_refused(line: str) -> None:
    with pytest.raises(DeclarationError, match="range"):
        load(PAIR + line)


def test_a_hand_keeps_its_torque_as_drive() -> None:
    hand = HandDrive(torque="0.2 N m", range=("0.1 N m", "0.3 N m"), handle="30 mm")
    assert hand.torque is not None
    assert hand.torque.si == 0.2
    assert GearTrain(load(PAIR + "drive: {hand: {torque: 20 N mm}}").declaration).declaration.drive is not None
