"""Feasibility: figures computed by hand and by quadrature, closed forms of probabilities, and laws of the outcomes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import isinf, pi, radians, sin, sqrt
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest
from sorge import Pair

from geartrain import GearTrain, load
from geartrain.errors import DeclarationError, QuestionError
from geartrain.numerics import Execution, Journal
from geartrain.workshop import FeasibilityResult, find_feasibility_plan, read_error_overrides, run_feasibility
from geartrain.workshop.feasibility.feasibility_plan import wedge_torque
from geartrain.workshop.monte_carlo.friction_trials import draw_friction

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


FACTORS = (0.241249, 0.252230, 0.408495, 0.333820)
"""Loss of each pair per unit of the coefficient of friction."""


def plan_of(text: str, cutting: str = "", **how: Any) -> Any:
    return find_feasibility_plan(load(text), read_error_overrides([cutting] if cutting else []), **how)


def counts(found: FeasibilityResult) -> Mapping[str, int]:
    return {name: each.count for name, each in found.outcomes.items() if each.count}


# --------------------------------------------------------------------------------------------------- torques and forces


def test_the_torque_of_the_teeth_is_the_product_of_their_efficiencies() -> None:
    """Ratio 95/254, and each pair loses 0.2 of its factor by hand: 3.45216008 N mm at the crank for 1 N mm."""
    pairs = zip(("a, b1", "b2, c1", "c2, d1", "d2, e"), FACTORS, strict=True)
    gears = ", ".join(f"{{pair: [{pair}], efficiency: {1 - 0.2 * loss:.9f}}}" for pair, loss in pairs)
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
    """Cases of triangular 48/96 at a clearance factor of 1.01, friction 0.2, by the closure equations of the source."""
    lean, z = pi / 6, (48, 96)
    depths = [1 - sin(lean) / sin(lean + pi / each) for each in z]
    pair = Pair(*z, 1, depths[0] / depths[1], lean, lean, 0.01)

    def front(degrees: float) -> tuple[float, float]:
        x = radians(degrees)
        return float(pair.speed(x)), float(pair.efficiency(x, 0.2))

    def back(degrees: float) -> tuple[float, float]:
        """The mirror image of a front flank; the driven wheel drives, so that friction has the opposite sign."""
        x = radians(degrees)
        return float(pair.speed(x)), 1 / float(pair.efficiency(x, -0.2))

    assert back(-7) == pytest.approx((0.477005708, 0.932847613), abs=1e-9)
    assert wedge_torque(1, front(-2), back(-7)) == pytest.approx(10.4562747, rel=1e-8)
    assert wedge_torque(front(-2)[0], front(-2), back(-7)) == pytest.approx(5.57636597, rel=1e-8)
    # past the narrowest place backlash opens: friction alone holds the pair
    assert wedge_torque(1, front(-5), back(-3)) == pytest.approx(100.710907, rel=1e-8)
    assert wedge_torque(1, (front(-5)[0], 1), (back(-3)[0], 1)) == 0
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
    shares = np.array(FACTORS)
    apart = replace(plan, per_part=True)
    own = np.array([apart.drawn_loads(1, trial).crank for trial in range(48)])  # type: ignore[union-attr]
    assert own.mean() == pytest.approx(mean, abs=4 * sd / sqrt(48))
    assert own.std() / drawn.std() == pytest.approx(sqrt(np.sum(shares**2)) / shares.sum(), rel=0.25)


def crank_of_the_moon(mus: Any, pivots: Any, radii: Any, angle: float = 20.0, exact: bool = True) -> Any:
    """Torque at the crank for 1 N mm on the Moon, from the forces of one pair after the other, shape (n,).

    A pair with the efficiency eta has its force through the point of the line of centres that divides it by eta z2/z1;
    without `exact` through the pitch point, and the torque of the driver is z1/z2 of that of the driven wheel over eta.

    mus      coefficient of friction of each pair, shape (4, n)
    pivots   coefficient of friction of each pivot, shape (5, n); `radii` of pivots in mm
    """
    axes = np.array([(-67.5, 0), (0, 0), (25.5, 0), (37.37867647, 13.52394341), (0, 0)])
    circles, slope = radii * pivots / np.hypot(1, pivots), np.radians(angle)
    torque, other = np.ones_like(mus[0]), np.zeros((2, len(mus[0])))
    for pair, (z1, z2) in reversed([*enumerate(((45, 225), (64, 38), (48, 24), (127, 32)))]):
        line = axes[pair + 1] - axes[pair]
        length = np.hypot(*line)
        across = (-1) ** pair * np.array([-line[1], line[0]]) / length
        way = (np.cos(slope) * across + np.sin(slope) * line / length)[:, None]
        eta = 1 - FACTORS[pair] * mus[pair]
        ratio = z2 / z1 * (eta if exact else np.ones_like(eta))
        force = np.zeros_like(eta)
        for _ in range(60):
            friction = circles[pair + 1] * np.hypot(*(force * way + other))
            force = (torque + friction) / (length * ratio / (1 + ratio) * np.cos(slope))
        other = -force * way
        torque = force * length / (1 + ratio) * np.cos(slope) / (1 if exact else eta)
    return torque + circles[0] * np.hypot(*other)


def spread_of_the_crank(case: str, angle: float, exact: bool = True) -> tuple[float, float]:
    """Mean and standard deviation over frictions U(.1, .3) of teeth, U(.1, .2) of pivots, and radii U(1, 3).

    By Gauss's rule; with separate draws of all parts from 70,000 random draws.
    """
    if case == "B3b":
        drawn, weight = np.random.default_rng(1).uniform(-1, 1, (14, 70_000)), np.full(70_000, 1 / 70_000)
    else:
        apart = 5 if case == "B2" else 1
        nodes, weights = np.polynomial.legendre.leggauss(3)
        grid = np.array(np.meshgrid(*[nodes] * (2 + apart))).reshape(2 + apart, -1)
        weight = np.prod(np.array(np.meshgrid(*[weights / 2] * (2 + apart))).reshape(2 + apart, -1), axis=0)
        drawn = np.concatenate([grid[[0] * 4], grid[[1] * 5], grid[2:] if apart == 5 else grid[[2] * 5]])
    found = crank_of_the_moon(0.2 + 0.1 * drawn[:4], 0.15 + 0.05 * drawn[4:9], 2 + drawn[9:], angle, exact)
    mean = float(weight @ found)
    return mean, sqrt(weight @ (found - mean) ** 2)


PIVOTS = """
extends: moon-triangular
name: moon-with-pivots
links: {LINKS}
axes:
  A: {position: [-67.5 mm, 0 mm, 0 mm]}
  B: {position: [0 mm, 0 mm, 0 mm]}
  C: {position: [25.5 mm, 0 mm, 0 mm]}
  D: {position: [37.37867647 mm, 13.52394341 mm, 0 mm]}
  E: {position: [0 mm, 0 mm, 0 mm]}
tooth_form: null
friction: {sliding: 0.2, range: [0.1, 0.3]}
loads: {moon: -1 N mm}
"""


@pytest.mark.parametrize(
    ("case", "shared", "published", "digits"),
    [
        ("B2", "[coefficient]", (4.27470691, 0.38586384), 2e-6),
        ("B3", "[coefficient, radius]", (4.28119635, 0.45488562), 3e-6),
        ("B3b", "[]", (4.26319, 0.22242), 3e-3),
    ],
)
def test_pivots_share_what_the_declaration_says(case: str, shared: str, published: Any, digits: float) -> None:
    """With forces through pitch points the reference gives the published spread of the crank torque; geartrain has the
    points at which both moments balance.
    """
    assert spread_of_the_crank(case, 30, exact=False) == pytest.approx(published, abs=digits)
    mean, deviation = spread_of_the_crank(case, 20)
    own = f"bearing: {{coefficient: 0.15, range: [0.1, 0.2], radius: 2 mm, radii: [1 mm, 3 mm], shared: {shared}}}"
    links = ", ".join(f"{link}: {{{own}}}" for link in ("crank", "sun", "c", "d", "moon"))
    declared, trials = load(PIVOTS.replace("LINKS", links)).declaration, 80
    found = []
    for trial in range(trials):
        drawn = draw_friction(declared, 1, trial, per_part=case == "B3b")
        bearings = [link.bearing for link in drawn.links.values() if link.bearing is not None]
        pivots = np.array([[float(each.coefficient.value)] for each in bearings if each.coefficient is not None])
        radii = np.array([[1e3 * each.radius.si] for each in bearings if each.radius is not None])
        frictions = [gear.friction or drawn.friction for gear in drawn.gears]
        mus = np.array([[float(each.sliding.value)] for each in frictions])  # type: ignore[union-attr]
        counts = len(np.unique(mus)), len(np.unique(pivots)), len(np.unique(radii))
        assert counts == {"B2": (1, 1, 5), "B3": (1, 1, 1), "B3b": (4, 5, 5)}[case]
        gears = (
            gear.changed(friction=None, efficiency=repr(1 - loss * mu))
            for gear, loss, mu in zip(drawn.gears, FACTORS, mus[:, 0].tolist(), strict=True)
        )
        torques = GearTrain(drawn.changed(gears=tuple(gears))).torques()
        found.append(1e3 * abs(float(torques.external["crank"])))
        assert found[-1] == pytest.approx(crank_of_the_moon(mus, pivots, radii)[0], rel=1e-9)
    assert np.mean(found) == pytest.approx(mean, abs=4 * deviation / sqrt(trials))
    assert np.std(found) == pytest.approx(deviation, rel=4 / sqrt(2 * trials))


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


@pytest.mark.parametrize(("accuracy", "jams"), [(0.1, 0.014), (0.15, 0.902), (0.2, 1.0)])
def test_the_moon_train_jams_as_often_as_in_512_trials(accuracy: float, jams: float) -> None:
    found = run_feasibility(plan_of(MOON, f"pitch_deviation={accuracy} deg", outputs=("moon",)), 96)
    share = found.outcomes["jams"]
    assert share.interval[0] - 0.02 <= jams <= share.interval[1] + 0.02
    if share.count:
        assert next(iter(found.causes["jams"])) == "a~b1"
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
    text = MOON.replace("window: 0.5", f"window: {window}").replace("drive:", "#")
    plan = plan_of(text, "pitch_deviation=0.05 deg", outputs=("moon",))
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
    neglected = [each.partition(":")[0] for each in bare.neglected]
    assert neglected == ["cutting errors", "crank torque and stresses", "the strength of the hand"]


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
    thin, thick = (
        next(part for part in plan_of(text.replace("D", pivot)).parts if part.name == "arbor of a")
        for pivot in ("0.2 mm", "2 mm")
    )
    # the pivot is as long as its diameter: 16 F / (pi d^2), with F from the tangential force of 2 N up to 1.3 of it
    assert 16 * 2 / (np.pi * 0.04) < thin.stress < 1.3 * 16 * 2 / (np.pi * 0.04)
    assert thick.stress < 5


def test_the_stress_of_a_part_in_several_pairs_follows_the_pair_that_grows_most() -> None:
    part = replace(plan_of(PAIR).parts[0], stress=10.0, loads={"x": 2.0, "y": 1.0})
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
