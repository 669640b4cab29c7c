"""Universal joints, non-circular wheels and laws in trains: mean rows, motion, torques, and what is refused.

Independent of the package: the vectors of a cross, tan(q/2) of ellipses, the power of virtual work, rolling arcs.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import atan, cos, degrees, pi, radians, tan
from typing import Any

import numpy as np
import pytest
from models import refusal
from scipy.integrate import quad
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from geartrain import GearTrain, load

TURN = 2 * pi
TWELVE = "[-3.2, -13.6, -12.5, -4, 2.9, 2.2, -3.6, -6.3, -0.1, 10.2, 16.4, 11.1]"


def two(coupling: str, more: str = "", speed: str = "1") -> GearTrain:
    """Two parallel shafts in the frame, with a coupling that a drives."""
    return load(f"""
        links: {{frame: {{}}, a: {{}}, b: {{}}}}
        revolutes: {{A: [frame, a], B: [frame, b]}}
        couplings: [{{pair: [a, b], {coupling}}}]
        inputs: {{a: {speed}}}
        outputs: {{b: {{}}}}
        {more}
    """)


def error(train: GearTrain, turns: Any, output: str = "b") -> np.ndarray:
    """Deviation of an output at positions of the input."""
    found = train.motion(outputs=[output]).at(np.atleast_1d(np.asarray(turns, dtype=float)))
    return np.asarray(found.error[0])


def extremes(train: GearTrain, output: str = "b") -> Any:
    """Statistics of an output over two turns, with searched extremes."""
    run = train.motion(outputs=[output]).run(turns=2.0, samples=2001)
    return run.statistics[0]


def test_case_l1_a_joint_of_30_degrees() -> None:
    train = two("kind: universal_joint, angle: 30 deg")
    assert train.solve()["b"] == 1
    found = extremes(train)
    assert round(degrees(found.peak_to_peak), 8) == 8.23438854
    assert found.speeds == pytest.approx((cos(radians(30)), 1 / cos(radians(30))), abs=1e-9)
    assert degrees(0.3 + float(error(train, 0.3 / TURN)[0])) == pytest.approx(19.656256851, abs=1e-9)


@pytest.mark.parametrize(
    ("second", "phase", "peak_to_peak", "at_1"),
    [
        (30, 90, 0.0, 1.0),
        (30, 0, 16.426421404, 1.1220015623),
        (20, 90, 4.6762476469, 1.0364608246),
        (20, 0, 11.784594991, 1.0892848637),
    ],
)
def test_case_l2_two_joints_in_one_plane(second: int, phase: int, peak_to_peak: float, at_1: float) -> None:
    train = load(f"""
        links: {{frame: {{}}, a: {{}}, b: {{}}, c: {{}}}}
        revolutes: {{A: [frame, a], B: [frame, b], C: [frame, c]}}
        couplings:
          - {{kind: universal_joint, pair: [a, b], angle: 30 deg}}
          - {{kind: universal_joint, pair: [b, c], angle: {second} deg, phase: {phase} deg}}
        inputs: {{a: 1}}
        outputs: {{c: {{}}}}
    """)
    found = extremes(train, "c")
    assert degrees(found.peak_to_peak) == pytest.approx(peak_to_peak, abs=1e-8)
    assert 1 + float(error(train, 1 / TURN, "c")[0]) == pytest.approx(at_1, abs=1e-10)
    tangent = tan(1) / cos(radians(30)) * (cos(radians(second)) if phase else 1 / cos(radians(second)))
    assert atan(tangent) == pytest.approx(at_1, abs=1e-10)


@pytest.mark.parametrize(("direction", "sense", "cosine"), [("[4, 3, 0]", 1, 0.8), ("[-4, 3, 0]", -1, 0.8)])
def test_the_angle_and_the_sense_of_a_joint_follow_from_its_axes(direction: str, sense: int, cosine: float) -> None:
    train = load(f"""
        links: {{frame: {{}}, a: {{}}, b: {{}}}}
        axes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: {direction}}}}}
        revolutes: {{A: [frame, a], B: [frame, b]}}
        couplings: [{{kind: universal_joint, pair: [a, b]}}]
        inputs: {{a: 1}}
        outputs: {{b: {{}}}}
    """)
    assert train.solve()["b"] == sense
    assert extremes(train).speeds == pytest.approx((cosine, 1 / cosine), abs=1e-9)


def joint_on_axes(direction: str, more: str = "") -> str:
    """A joint with the angle 30 deg, and the declared axes of its shafts."""
    return f"""
        links: {{frame: {{}}, a: {{}}, b: {{}}}}
        axes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: {direction}}}}}
        revolutes: {{A: [frame, a], B: [frame, b]}}
        couplings: [{{kind: universal_joint, pair: [a, b]{more}}}]
        inputs: {{a: 1}}
    """


def test_a_joint_at_90_degrees_and_a_joint_with_two_angles_are_refused() -> None:
    assert "a joint at 90 deg does not turn" in refusal(joint_on_axes("[0, 1, 0]"))
    said = refusal(joint_on_axes("[4, 3, 0]", ", angle: 30 deg"))
    assert "its angle is 30 deg, but its axes are at 36.8699 deg" in said
    assert "both declare the same angle" in said


def test_a_joint_without_angle_and_axes_has_only_its_mean_ratio() -> None:
    train = two("kind: universal_joint")
    assert train.solve()["b"] == 1
    assert not train.mechanics.couplings
    assert "has an unknown angle" in str(train.solve())


def test_the_forks_of_a_joint_that_turns_backwards_start_at_the_same_phase() -> None:
    """The driven angle depends on the angle of the driver only, in whichever sense it is reached."""
    S = np.linspace(0, 1, 41)
    for way in (1, -1):
        train = two("kind: universal_joint, angle: 40 deg, phase: 25 deg", speed=str(way))
        angle = way * TURN * S + radians(25)
        # an error is positive in the sense of the input
        q = np.arctan2(np.sin(angle), np.cos(angle) * cos(radians(40)))
        assert np.allclose(np.sin(way * error(train, S) + angle - q), 0, atol=1e-12)


@pytest.mark.parametrize(
    ("lobes", "e", "rho", "distance", "speeds", "q1", "peak_to_peak"),
    [
        ((1, 1), 0.3, 0.3, None, (7 / 13, 13 / 7), 0.57218614403, 69.830412495),
        ((2, 2), 0.2, 0.2, 2.0833333333, (2 / 3, 3 / 2), 0.80417255814, 23.073918066),
        ((1, 2), 0.3, 0.22893069472, 3.2212316391, (0.31371553684, 0.79690028271), 0.33021683271, 26.468250916),
        ((2, 1), 0.2, 0.29150262213, 1.5928648565, (1.0971675407, 3.6457513111), 1.4140496029, 67.791748999),
    ],
    ids=["L3", "L4", "L5", "L6"],
)
def test_cases_l3_to_l6_elliptical_and_lobed_wheels_from_the_short_radius(
    lobes: tuple[int, int], e: float, rho: float, distance: float | None, speeds: Any, q1: float, peak_to_peak: float
) -> None:
    first, second = lobes
    train = two(f"kind: elliptical, eccentricity: {e}, lobes: [{first}, {second}], phase: {180 / first} deg")
    (coupling,) = train.declaration.couplings
    assert train.solve()["b"] == -Fraction(first, second)
    assert coupling.transmission.rho == pytest.approx(rho, abs=1e-11)
    if distance is not None:
        assert coupling.distance == pytest.approx(distance, abs=1e-10)
    found = extremes(train)
    m = first / second
    assert tuple(m * each for each in found.speeds) == pytest.approx(speeds, abs=1e-9)
    low, high = coupling.transmission.error_range()
    assert degrees(high - low) == pytest.approx(peak_to_peak, abs=2e-9)
    assert degrees(found.peak_to_peak) == pytest.approx(peak_to_peak, rel=1e-9)
    # the driven wheel turns back
    start = float(error(train, 0.0)[0])
    turned = m - (float(error(train, 1 / TURN)[0]) - start)
    assert turned == pytest.approx(q1, abs=1e-10)

    # rolling: equal arcs of both wheels, by quadrature of r / (C - r)
    def ratio(theta: float, C: float) -> float:
        r = 1 / (1 + e * cos(first * theta))
        return r / (C - r)

    def excess(C: float) -> float:
        return quad(ratio, 0, TURN, args=(C,), limit=200)[0] - TURN * m

    closing = brentq(excess, 1 / (1 - e) + 1e-3, 10, xtol=1e-13)
    assert coupling.distance == pytest.approx(closing, abs=1e-9)
    assert quad(ratio, 0, 1, args=(closing,))[0] == pytest.approx(q1, abs=1e-9)


def test_equal_ellipses_turn_by_the_tangents_of_half_angles() -> None:
    train = two("kind: elliptical, eccentricity: 0.3")
    S = np.linspace(0.1, 3.0, 9)
    q = 2 * np.arctan(13 / 7 * np.tan(S / 2))
    assert np.allclose(S - error(train, S / TURN), q, atol=1e-12)
    assert train.declaration.couplings[0].formula == "tan(q / 2) = 1.85714 tan(S / 2)"


def test_case_l9_an_elliptical_planet_on_a_fixed_ellipse() -> None:
    """The arm turns by 1 rad from the short radius: the planet turns by 1 rad and by q(1) of the pair."""
    train = load("""
        links: {frame: {}, a: {}, arm: {}, b: {}}
        revolutes: {A: [frame, a, arm], B: [arm, b]}
        couplings: [{kind: elliptical, pair: [a, b], eccentricity: 0.3, phase: 180 deg}]
        inputs: {arm: 1}
        fixed: [a]
        outputs: {b: {}}
    """)
    assert train.solve()["b"] == 2
    found = train.motion(outputs=["b"]).at(np.array([0.0, 1 / TURN]))
    assert 2 + float(found.error[0, 1] - found.error[0, 0]) == pytest.approx(1.5721861440, abs=1e-10)
    assert 2 + float(found.rate[0, 1]) == pytest.approx(1.6434818, abs=1e-7)


def test_a_pitch_curve_through_an_ellipse_is_the_ellipse() -> None:
    e, n = 0.3, 96
    radii = [1 / (1 - e * cos(TURN * at / n)) for at in range(n)]
    curve = two(f"kind: pitch_curve, radii: {radii}")
    (coupling,) = curve.declaration.couplings
    assert coupling.distance == pytest.approx(2 / (1 - e**2), rel=1e-6)
    S = np.linspace(0, 1, 23)
    assert np.allclose(error(curve, S), error(two("kind: elliptical, eccentricity: 0.3"), S), atol=1e-6)


@pytest.mark.parametrize("lobes", [(1, 1), (2, 3), (3, 1)])
def test_a_pitch_curve_rolls_on_its_mate(lobes: tuple[int, int]) -> None:
    radii = [10, 11, 12.5, 11, 10, 9.5, 9, 9.5]
    train = two(f"kind: pitch_curve, radii: [{', '.join(f'{each} mm' for each in radii)}], lobes: {list(lobes)}")
    first, second = lobes
    lobe = TURN / first
    spline = CubicSpline(np.linspace(0, lobe, 9), [*radii, radii[0]], bc_type="periodic")
    cuts = np.linspace(0, lobe, 9)

    def turned(C: float, end: float) -> float:
        marks = [*cuts[cuts < end], end]
        return sum(
            quad(lambda x: spline(x) / (C - spline(x)), low, high, epsabs=1e-13)[0] for low, high in pairwise(marks)
        )

    C = brentq(lambda C: turned(C, lobe) - TURN / second, 12.9, 200, xtol=1e-12)
    (coupling,) = train.declaration.couplings
    assert coupling.distance == pytest.approx(C / 1000, rel=1e-11)
    assert train.solve()["b"] == -Fraction(first, second)
    for S in (0.3, 1.0, 0.9 * lobe):
        assert first / second * S - float(error(train, S / TURN)[0]) == pytest.approx(turned(C, S), abs=1e-10)


def test_case_l7_an_equation_cam_in_a_differential() -> None:
    """Two equal suns on idlers: their sum is twice the cage's motion. 6 deg of the hand are a minute."""
    train = load("""
        unit: {per: 365.2422 d}
        links:
          frame: {}
          year: {}
          arm: {wheels: {s2: 20}}
          mean: {wheels: {s1: 20}}
          cage: {wheels: {c: 40}}
          p: {wheels: {p1: 20}}
          q: {wheels: {p2: 20}}
          hand: {wheels: {h: 20}}
        revolutes: {Y: [frame, year], M: [frame, arm, mean, cage], P: [cage, p], Q: [cage, q], H: [frame, hand]}
        gears: [s1 ~ p1, p1 ~ p2, p2 ~ s2, c ~ h]
        couplings:
          - {kind: law, pair: [year, arm], mean: 0, unit: 6 deg, harmonics: {1: -7.659, 2: [9.863, 3.5932 rad]}}
        inputs: {year: 1, mean: 8765.8128}
        outputs: {hand: {}}
    """)
    assert train.solve()["hand"] == -Fraction("8765.8128")
    found = train.motion(outputs=["hand"]).run(turns=1.0, samples=20_001).statistics[0]
    # the pair c ~ h reverses the sense
    assert -degrees(found.most) / 6 == pytest.approx(-14.412527194, abs=1e-8)
    assert -degrees(found.minimum) / 6 == pytest.approx(16.533625081, abs=1e-8)
    assert degrees(found.rms) / 6 == pytest.approx(8.8300353906, abs=1e-3)  # the first position counts twice
    seconds = 3600 / 365.2422  # in a day, for a turn of the hand more in a year
    slow, fast = (float(Fraction("8765.8128")) * (each - 1) * seconds for each in found.speeds)
    assert (slow, fast) == pytest.approx((-28.082794405, 22.487142756), abs=1e-7)


def test_case_l10_a_table_and_its_range() -> None:
    train = two(f"kind: law, mean: 0, unit: 1 deg, table: {TWELVE}")
    assert train.solve()["b"] == 0
    assert degrees(float(error(train, 0.04)[0])) == pytest.approx(-9.3791744, abs=1e-10)
    found = extremes(train)
    assert degrees(found.minimum) == pytest.approx(-14.508061186, abs=1e-8)
    assert degrees(found.most) == pytest.approx(16.443871908, abs=1e-8)


@pytest.mark.parametrize("mean", ["3/7", "-3/7", "0", "-2"])
@pytest.mark.parametrize("speed", ["1", "-1"])
def test_the_driven_angle_of_a_law_is_that_of_its_formula_in_either_sense(mean: str, speed: str) -> None:
    train = two(
        f"kind: law, mean: {mean}, unit: 2 deg, per: 3/2, phase: 40 deg, harmonics: {{1: [3, 20 deg], 4: 0.5}}",
        speed=speed,
    )
    way = int(speed)
    turns = np.linspace(0, 2, 31)
    angle = way * TURN * turns + radians(40)
    d = radians(2) * (3 * np.sin(angle / 1.5 + radians(20)) + 0.5 * np.sin(4 * angle / 1.5))
    # an error is positive in the sense of the input
    assert np.allclose(way * error(train, turns), d, atol=1e-12)
    assert train.solve()["b"] == way * Fraction(mean)
    assert train.motion(outputs=["b"]).period == Fraction(3, 2)


def test_the_fastest_harmonic_is_followed_between_positions() -> None:
    """30 waves in a turn: the search for extremes must not step over them."""
    train = two("kind: law, mean: 1, unit: 1 deg, harmonics: {1: 1, 30: 0.5}")
    found = train.motion(outputs=["b"]).run(turns=1.0, samples=11).statistics[0]
    S = np.linspace(0, TURN, 2_000_001)
    d = np.sin(S) + 0.5 * np.sin(30 * S)
    assert degrees(found.peak_to_peak) == pytest.approx(d.max() - d.min(), abs=1e-8)


@pytest.mark.parametrize(
    "coupling",
    [
        "kind: universal_joint, angle: 40 deg",
        "kind: elliptical, eccentricity: 0.3",
        "kind: pitch_curve, radii: [10, 11, 12, 11, 10, 9]",
        f"kind: law, mean: 0, unit: 1 deg, table: {TWELVE}",
        f"kind: law, mean: -1/2, unit: 1 deg, table: {TWELVE}, between: straight",
    ],
)
def test_the_torque_over_a_turn_is_that_of_virtual_work(coupling: str) -> None:
    """T_D = -q' T_F at every position, without division by q'; q' from differences of the driven angle."""
    train = two(coupling, "loads: {b: -3 N m}")
    found = train.torques(turns=1, samples=500)
    inside = (found.turns > 1e-4) & (found.turns < 1 - 1e-4)
    at = found.turns[inside][::7]
    motion = train.motion(outputs=["b"])
    ahead, behind = (motion.at(at + step).error[0] for step in (1e-6, -1e-6))
    slope = float(train.solve()["b"]) + (ahead - behind) / (2 * TURN * 1e-6)
    smooth = np.abs(np.mod(at * 12 + 0.5, 1) - 0.5) > 1e-3  # away from the corners of straight lines
    assert np.allclose(found.torque[inside][::7][smooth], 3 * slope[smooth], atol=1e-5 * np.abs(slope).max())
    # without friction the mean torque is the load times the exact mean ratio
    assert found.mean == pytest.approx(3 * float(train.solve()["b"]), abs=1e-8)


@pytest.mark.parametrize("eta", [0.9, 0.5])
def test_the_efficiency_of_a_cam_takes_its_share_on_both_strokes(eta: float) -> None:
    """Lifting, the cam gives q' T / eta; lowering, the load gives it back q' T eta."""
    train = two(f"kind: law, mean: 0, unit: 1 deg, efficiency: {eta}, harmonics: {{1: 10}}", "loads: {b: -3 N m}")
    found = train.torques(turns=1, samples=2000)
    slope = radians(10) * np.cos(TURN * found.turns)
    expected = 3 * np.where(slope > 0, slope / eta, slope * eta)
    assert np.allclose(found.torque, expected, atol=1e-6)
    # work up and down over half a turn each
    work = 3 * 2 * radians(10)
    assert found.energy.lost == pytest.approx(work * (1 / eta - 1) + work * (1 - eta), rel=1e-9)


def test_side_loads_and_followers_are_named_as_left_out() -> None:
    joint = two("kind: universal_joint, angle: 40 deg", "loads: {b: -3 N m}").torques()
    assert [each.what for each in joint.neglected if "joint" in each.what] == ["side loads of joints"]
    cam = two(f"kind: law, mean: 0, unit: 1 deg, table: {TWELVE}", "loads: {b: -3 N m}").torques()
    assert "friction of followers" in [each.what for each in cam.neglected]


def simulated(coupling: str) -> GearTrain:
    """A train with inertia that can be simulated in time."""
    return two(coupling, "rate: 1 turn/s").with_changes(
        links={"b": {"inertia": "30 kg mm2"}, "a": {"inertia": "9 g cm2"}}
    )


@pytest.mark.parametrize(
    "coupling",
    [
        "kind: universal_joint, angle: 30 deg, phase: 20 deg",
        "kind: elliptical, eccentricity: 0.2",
        "kind: law, mean: 1, unit: 1 deg, table: [0, 1, 0, -1], between: straight",
    ],
)
def test_the_motion_in_time_follows_the_transmission_function(coupling: str) -> None:
    train = simulated(coupling)
    found = train.dynamics(turns=1, skip=0)
    assert "balance closes" in str(found)


def test_a_law_that_jumps_is_refused_in_time() -> None:
    train = simulated("kind: law, mean: 1, unit: 1 deg, table: [0, 1, 0, -1], between: steps")
    with pytest.raises(Exception, match="an instantaneous step has no defined force"):
        str(train.dynamics())


@pytest.mark.parametrize(
    ("coupling", "said"),
    [
        ("kind: universal_joint, angle: 90 deg", "a joint at 90 deg does not turn"),
        ("kind: universal_joint, angle: -10 deg", "is below 0"),
        ("kind: elliptical, eccentricity: 1", "does not close"),
        ("kind: elliptical, eccentricity: 0.2, lobes: [0, 1]", "greater than or equal to 1"),
        ("kind: pitch_curve, radii: [1, 2, 3]", "`radii` has 3 values"),
        ("kind: pitch_curve, radii: [10, 10, 10, -1]", "not above 0"),
        ("kind: pitch_curve, radii: [10, 10 mm, 10, 11]", "unit"),
        ("kind: pitch_curve, radii: [30, 1, 1, 1, 1, 1]", "passes through its own axis"),
        ("kind: law, mean: 0, unit: 1 deg", "needs `harmonics` or `table`; found: neither"),
        ("kind: law, mean: 0, unit: 1 deg, harmonics: {0: 1}", "a constant is `phase`"),
        ("kind: law, mean: 0, unit: 1 deg, table: [1, 2, 3]", "`table` has 3 values"),
        ("kind: law, mean: 0, unit: 1 deg, table: [1, 2, 3, 2, 1]", "is repeated at the end"),
        ("kind: law, mean: 0, unit: 1 deg, table: [1, 2, 3, 2], per: 0", "greater than 0"),
        ("kind: law, mean: 0, harmonics: {1: 1}", "unit"),
    ],
)
def test_what_cannot_turn_is_refused(coupling: str, said: str) -> None:
    text = f"""
        links: {{frame: {{}}, a: {{}}, b: {{}}}}
        revolutes: {{A: [frame, a], B: [frame, b]}}
        couplings: [{{pair: [a, b], {coupling}}}]
        inputs: {{a: 1}}
    """
    assert said in refusal(text)
