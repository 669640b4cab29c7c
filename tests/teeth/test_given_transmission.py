"""Pairs with a given transmission error: tables, harmonics, runout, the inverse function, efficiencies and refusals."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from math import cos, degrees, pi, radians, sin
from typing import Any

import numpy as np
import pytest
from commands import call
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import jv

from geartrain import GearTrain, GearTrainError, load
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.teeth.table import GivenError
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.workshop.export.file_set import notices

EIGHT = [0, 0.03, 0.05, 0.04, 0.01, -0.03, -0.05, -0.04]


def table(**keys: Any) -> GivenError:
    return GivenError.declared(keys)


def eight(interpolation: str) -> TransmissionFunction:
    points = [[f"{k}/8", f"{error} deg"] for k, error in enumerate(EIGHT)]
    return table(error={"points": points, "interpolation": interpolation}).transmission(20, 60)


def chain(*forms: dict[str, Any] | None, counts: tuple[tuple[int, int], ...], **more: Any) -> GearTrain:
    """Return a train of external pairs, one shaft after the other, driven at its first shaft."""
    links: dict[str, Any] = {"frame": {}} | {f"s{k}": {"wheels": {}} for k in range(len(counts) + 1)}
    gears = []
    for k, (form, (first, second)) in enumerate(zip(forms, counts, strict=True)):
        links[f"s{k}"]["wheels"][f"p{k}"] = first
        links[f"s{k + 1}"]["wheels"][f"w{k}"] = second
        gears.append({"pair": [f"p{k}", f"w{k}"]} | ({} if form is None else {"tooth_form": {"form": "table", **form}}))
    joints = {f"A{k}": ["frame", f"s{k}"] for k in range(len(counts) + 1)}
    last = f"s{len(counts)}"
    kept = {"links": links, "revolutes": joints, "gears": gears, "inputs": {"s0": 1}, "outputs": {last: {}}}
    return GearTrain.declare(kept | more)


@pytest.mark.parametrize(
    ("interpolation", "errors", "range_"),
    [
        ("cubic", (0.016540178571, 0.042477678571, 0.048549107143, 0.027075892857,
                   -0.006394285714, -0.045274285714, -0.049486607143, -0.016805714286), 0.101245991390),
        ("pchip", (0.016285714286, 0.043, 0.046875, 0.027410714286,
                   -0.006457142857, -0.04552, -0.047, -0.017481142857), 0.1),
    ],
)  # fmt: skip
def test_u3_points_over_a_pitch(interpolation: str, errors: tuple[float, ...], range_: float) -> None:
    law = eight(interpolation)
    at = np.array([0.0625, 0.1875, 0.3125, 0.4375, 0.55, 0.7, 0.8125, 0.95]) * 2 * pi / 20
    assert np.degrees(law.error(at)) == pytest.approx(errors, abs=5e-13)
    low, high = law.error_range()
    assert degrees(high - low) == pytest.approx(range_, abs=5e-13)


def test_an_abrupt_fall_of_the_speed_has_no_steepest_slope() -> None:
    """Straight lines between the points have corners, where the teeth separate at every speed."""
    assert eight("linear").steepest_fall() is None
    smooth = eight("cubic")
    S = np.linspace(0, smooth.period, 100_001)
    assert smooth.steepest_fall() == pytest.approx(-np.gradient(smooth.speed(S), S).min(), rel=1e-3)


def test_u3_slopes_of_the_spline_have_their_extremes_between_the_points() -> None:
    low, high = eight("cubic").speed_range()
    a_pitch = 2 * pi / 20
    slopes = [degrees((each - 1 / 3) * a_pitch) for each in (low, high)]
    assert slopes == pytest.approx([-0.3373754153, 0.3485501066], abs=5e-11)


U1 = chain(
    {"error": {"over": "driver_turn", "harmonics": [[1, "0.4 deg"]]}},
    {"error": {"over": "driver_pitch", "harmonics": [[1, "0.1 deg"]]}},
    counts=((20, 60), (15, 45)),
)


def test_u1_errors_at_positions_and_their_range() -> None:
    motion = U1.motion()
    found = np.degrees(motion.at(np.array([10, 40, 100]) / 360).error[0])
    assert found == pytest.approx([0.100913675475, 0.045259919246, 0.187358813866], abs=5e-13)
    assert motion.period == 1
    run = motion.run(turns=1, samples=2000)
    assert degrees(run.statistics[0].peak_to_peak) == pytest.approx(0.466611165149, abs=1e-9)
    error = np.degrees(motion.at(np.linspace(0, 1, 1_000_001)).error[0])
    assert np.ptp(error) == pytest.approx(0.466611165149, abs=5e-13)


def test_u1_lines_are_bessel_functions() -> None:
    n = 256
    error = np.degrees(U1.motion().at(np.arange(n) / n).error[0])
    lines = 2 * np.fft.rfft(error) / n
    z = radians(15 * 0.4)
    wanted = {5: 0.1 * jv(0, z), 6: 0.1 * jv(1, z), 4: -0.1 * jv(1, z), 1: 0.4 / 3 + 0.1 * (jv(4, z) - jv(6, z))}
    printed = {5: 0.099726032168, 6: 0.005228813656, 4: -0.005228813656, 1: 0.133333364631}
    for order, amplitude in wanted.items():
        assert -lines[order].imag == pytest.approx(amplitude, abs=1e-13)
        assert amplitude == pytest.approx(printed[order], abs=5e-13)


def runout(**keys: Any) -> TransmissionFunction:
    return table(**keys).transmission(20, 60)


def test_u2_an_eccentric_driver() -> None:
    law = runout(eccentricity=["0.2", "0"])
    printed = [0.1363551848, 0.3678604328, 0.3816211002, 0.1693621529]
    printed += [-0.1416052281, -0.3689222790, -0.3823162606, -0.1742437177]
    assert np.degrees(law.error(np.radians(45 * np.arange(8)))) == pytest.approx(printed, abs=5e-11)
    low, high = law.error_range()
    assert degrees(high - low) == pytest.approx(0.8129719335, abs=5e-11)
    assert high - low == pytest.approx(2 * 0.2 / (30 * cos(radians(20))), rel=1e-13)
    assert [degrees(each) for each in law.error_moments()] == pytest.approx([-0.0014860768, 0.2874232191], abs=5e-11)
    assert [3 * each for each in law.speed_range()] == pytest.approx([0.9787164446, 1.0212835554], abs=5e-11)
    assert (law.pitch_count, law.period) == (20, 2 * pi)


def test_u2_an_eccentric_driven_wheel() -> None:
    law = runout(eccentricity=["0", "0.5"])
    printed = [-0.3693640227, -0.0183102419, 0.3371434774, 0.6513454351]
    printed += [0.8833310560, 1.0032441254, 0.9968491049, 0.8671353676]
    assert np.degrees(law.error(np.radians(60 * np.arange(8)))) == pytest.approx(printed, abs=5e-11)
    low, high = law.error_range()
    assert degrees(high - low) == pytest.approx(2.0324298338, abs=5e-11)
    assert (law.pitch_count, law.period) == (60, pytest.approx(6 * pi))


def rolled(counts: tuple[int, int], e: tuple[float, float], phi: tuple[float, float], ring: bool) -> Callable[..., Any]:
    """Return the speed ratio dq/dS of involute wheels, from the arms of their line of action about the fixed axes."""
    r1, r2 = (z / 2 * cos(radians(20)) for z in counts)
    second = -1 if ring else 1  # senses of rotation: a ring turns with the pinion, whose axis is then to the right
    axis = np.array([(counts[0] + counts[1]) / 2 if not ring else -(counts[1] - counts[0]) / 2, 0.0])

    def moment(a: np.ndarray, n: np.ndarray) -> float:
        return float(a[0] * n[1] - a[1] * n[0])

    def ratio(S: float, q: np.ndarray) -> float:
        turned = phi[1] - second * float(q[0])
        c1 = e[0] * np.array([cos(phi[0] + S), sin(phi[0] + S)])
        c2 = axis + e[1] * np.array([cos(turned), sin(turned)])
        about_c2 = -second * r2  # moment of the unit force on wheel 2 about its centre, r1 about that of wheel 1

        def off(theta: float) -> float:
            return r1 + moment(c1 - c2, np.array([cos(theta), sin(theta)])) - about_c2

        theta = brentq(off, radians(40), radians(89), xtol=1e-15)
        n = np.array([cos(theta), sin(theta)])
        return (r1 + moment(c1, n)) / (-second * (about_c2 + moment(c2 - axis, n)))

    return ratio


@pytest.mark.parametrize(
    ("counts", "e", "phi", "ring"),
    [
        ((20, 60), (0.2, 0.0), (0.0, 0.0), False),
        ((20, 60), (0.0, 0.5), (0.0, 0.0), False),
        ((20, 30), (0.3, 0.4), (0.7, -1.1), False),
        ((20, 60), (0.3, 0.4), (0.7, -1.1), True),
    ],
)
def test_runout_is_that_of_rolling_base_circles(counts: Any, e: Any, phi: Any, ring: bool) -> None:
    at = np.linspace(0, 14, 29)
    form = table(eccentricity=[str(each) for each in e], eccentricity_angle=[f"{each} rad" for each in phi])
    law = form._transmission(counts, e, ring)
    start = float(law.angle(0.0))
    q = solve_ivp(rolled(counts, e, phi, ring), (0, 14), [start], t_eval=at, rtol=1e-12, atol=1e-13).y[0]
    assert law.angle(at) == pytest.approx(q, abs=2e-10)
    ratio = rolled(counts, e, phi, ring)
    assert law.speed(at) == pytest.approx([ratio(S, [float(law.angle(S))]) for S in at], abs=1e-12)


def test_both_eccentricities_have_no_constant_error_but_that_of_second_order() -> None:
    law = table(eccentricity="0.1")._transmission((20, 60), (0.1, 0.1))
    mean, rms = law.error_moments()
    assert abs(mean) < 0.01 * rms


def test_errors_over_several_periods_are_added() -> None:
    both = table(
        error=[
            {"over": "driver_turn", "harmonics": [[1, "0.1 deg"]]},
            {"over": "driven_turn", "harmonics": [[2, "0.2 deg", "30 deg"]]},
            {"points": [["0", "0 deg"], ["9 deg", "0.01 deg"], ["15 deg", "-0.01 deg"]]},
        ]
    ).transmission(20, 30)
    assert (both.pitch_count, both.period) == (60, pytest.approx(6 * pi))
    S = 2.1
    at = (S % radians(18)) / radians(18)
    wave = 0.1 * sin(S) + 0.2 * sin(2 * S * 20 / 30 + radians(30))
    alone = table(error={"points": [["0", "0 deg"], ["9 deg", "0.01 deg"], ["15 deg", "-0.01 deg"]]})
    points = degrees(float(alone.transmission(20, 30).error(at * radians(18))))
    assert degrees(float(both.error(S))) == pytest.approx(wave + points, abs=1e-14)


INVERTED = [
    {"error": {"points": [[f"{k}/8", f"{error} deg"] for k, error in enumerate(EIGHT)]}},
    {"eccentricity": ["0.5", "0.5"]},
    {"error": {"over": "driver_turn", "harmonics": [[3, "2 deg", "40 deg"]]}},
]


@pytest.mark.parametrize("keys", INVERTED)
def test_the_other_wheel_drives_by_the_inverse_function(keys: dict[str, Any]) -> None:
    ahead = table(**keys).transmission(20, 30)
    back = table(**keys).transmission(20, 30, driver=2)
    S = np.linspace(-7, 30, 401)
    assert back.angle(ahead.angle(S)) == pytest.approx(S, abs=1e-13)
    assert back.speed(ahead.angle(S)) * ahead.speed(S) == pytest.approx(np.ones(401), abs=1e-12)
    assert (back.ratio, back.pitch_count) == (1 / ahead.ratio, ahead.pitch_count)
    q = np.linspace(0, back.period, 200_001)
    error, speed = back.error_and_speed(q)
    assert back.error_range() == pytest.approx((error.min(), error.max()), abs=1e-8)
    assert back.speed_range() == pytest.approx((speed.min(), speed.max()), rel=1e-7)
    assert back.error_moments() == pytest.approx((error[:-1].mean(), error[:-1].std()), abs=1e-9)


def test_errors_may_refer_to_the_second_wheel() -> None:
    law = table(driver=2, error={"over": "driver_turn", "harmonics": [[1, "0.5 deg"]]}).transmission(20, 30, driver=2)
    assert (law.ratio, law.period) == (Fraction(3, 2), pytest.approx(2 * pi))
    assert degrees(float(law.error(pi / 2))) == pytest.approx(0.5)


def test_turning_back_adds_the_backlash() -> None:
    form = table(error={"harmonics": [[1, "0.1 deg"]]}, backlash="0.3 deg")
    for driver, size in ((1, 0.3), (2, 0.3 * 30 / 20)):
        law = form.transmission(20, 30, driver=driver)
        coast = law.reversed_motion()
        assert np.degrees(coast.error([0.0, 1.0]) - law.error([0.0, 1.0])) == pytest.approx([size, size])
        assert degrees(law.verdict.backlash) == pytest.approx(size)  # type: ignore[attr-defined]


@pytest.mark.parametrize("driver", [1, 2])
def test_a_pair_may_have_only_backlash_and_efficiency(driver: int) -> None:
    law = table(backlash="0.2 deg", efficiency="0.9").transmission(20, 20, driver)
    assert (law.error_range(), law.speed_range(), law.pitch_count) == ((0, 0), (1, 1), 1)
    assert list(law.angle([0.0, 1.0])) == [0, 1]
    assert law.efficiency_mean() == pytest.approx(0.9)
    assert np.degrees(law.reversed_motion().error([0.3])) == pytest.approx(0.2)


def test_lines_between_points_leap_in_speed() -> None:
    form = table(error={"points": [["0", "0 deg"], ["1/4", "0.1 deg"]], "interpolation": "linear"})
    steep = radians(0.1) / (pi / 40)
    flat = radians(0.1) / (3 * pi / 40)
    (leap,) = form.transmission(20, 20).speed_leaps() or ()
    assert (leap.before, leap.after) == pytest.approx((1 - flat, 1 + steep))
    (other,) = form.transmission(20, 20, driver=2).speed_leaps() or ()
    assert (other.before, other.after) == pytest.approx((1 / (1 + steep), 1 / (1 - flat)))
    assert not eight("pchip").speed_leaps()


def test_the_steepest_fall_of_a_harmonic() -> None:
    law = table(error={"harmonics": [[2, "0.1 deg"]]}).transmission(20, 20)
    assert law.steepest_fall() == pytest.approx(radians(0.1) * 40**2)


def test_a_declared_efficiency_acts_in_mean_torques_and_at_every_position() -> None:
    error = {"over": "driver_turn", "harmonics": [[1, "2 deg"]]}
    form = {"error": error, "efficiency": {"forward": "0.9", "backward": "0.8"}}
    train = chain(form, counts=((20, 60),), loads={"s1": 3})
    assert train.torques().external["s0"] == pytest.approx(1 / 0.9)
    cycle = train.torques(turns=1, samples=4000)
    assert cycle.mean == pytest.approx(1 / 0.9, rel=1e-9)
    back = chain(form, counts=((20, 60),), loads={"s1": -3})
    assert back.torques().external["s0"] == pytest.approx(-0.8)
    assert back.torques(turns=1, samples=4000).mean == pytest.approx(-0.8, rel=1e-9)


def test_an_efficiency_over_a_turn_weighs_the_speed() -> None:
    points = [["0", "0.8"], ["1/4", "0.9"], ["1/2", "1"], ["3/4", "0.9"]]
    form = {
        "error": {"over": "driver_turn", "harmonics": [[1, "5 deg"]]},
        "efficiency_table": {"over": "driver_turn", "interpolation": "linear", "points": points},
    }
    train = chain(form, counts=((20, 60),), loads={"s1": 3})
    S = (np.arange(200_000) + 0.5) / 200_000 * 2 * pi
    eta = 0.8 + 0.2 * (1 - np.abs(S / pi - 1))
    driver = 3 * np.mean((1 / 3 + radians(5) * np.cos(S)) / eta)
    assert float(train.torques().external["s0"]) == pytest.approx(driver, rel=1e-9)
    assert train.torques(turns=1, samples=2000).mean == pytest.approx(driver, rel=1e-7)
    back = chain(form, counts=((20, 60),), loads={"s1": -3}).torques(turns=1, samples=2000)
    assert back.mean == pytest.approx(-3 * np.mean((1 / 3 + radians(5) * np.cos(S)) * eta), rel=1e-7)


def test_the_friction_of_a_train_does_not_apply_and_is_reported() -> None:
    train = chain({"error": {"harmonics": [[1, "0.1 deg"]]}}, counts=((20, 60),), loads={"s1": 3}, friction="0.1")
    torques = train.torques()
    assert torques.external["s0"] == 1
    assert any("no sliding speed" in each.why for each in torques.neglected)


@pytest.mark.parametrize("inputs", [{"s0": 1}, {"s2": 1}])
def test_a_run_finds_the_extremes_of_errors_over_many_pitches(inputs: dict[str, int]) -> None:
    error = {"over": "driven_turn", "harmonics": [[1, "0.2 deg"], [90, "0.05 deg", "1 rad"]]}
    output = "s2" if "s0" in inputs else "s0"
    train = chain({"error": error}, {"eccentricity": "0.3"}, counts=((24, 36), (20, 30)), inputs=inputs)
    motion = train.with_changes(outputs={output: {}}).motion(outputs=[output])
    assert motion.period == {"s0": Fraction(9, 2), "s2": Fraction(2)}[next(iter(inputs))]
    found = motion.run(turns=float(motion.period), samples=200).statistics[0].peak_to_peak
    dense = np.ptp(motion.at(np.linspace(0, float(motion.period), 20_001)).error[0])
    assert dense * (1 - 1e-8) <= found == pytest.approx(dense, rel=1e-5)


def test_the_spectrum_has_lines_at_fractions_of_the_pitch() -> None:
    error = {"over": "driven_turn", "harmonics": [[1, "0.2 deg"], [90, "0.05 deg"]]}
    motion = chain({"error": error}, counts=((20, 30),)).motion()
    run = motion.run(turns=3, samples=20_000)
    run.find_spectra()
    lines = {line.order: degrees(line.expected) for line in run.spectra["s1"]}
    assert lines == {Fraction(2, 3): pytest.approx(0.2), Fraction(60): pytest.approx(0.05)}


def test_a_phase_and_a_starting_angle_shift_the_error() -> None:
    form = {"error": {"over": "driver_turn", "harmonics": [[1, "0.2 deg"]]}}
    train = chain(form, counts=((20, 30),))
    shifted = train.with_changes(gears=[{"pair": ["p0", "w0"], "phase": "5"}])
    turned = train.with_changes(links={"s0": {"angle": "90 deg"}})
    # pointers are set to 0 at the start, and the driven shaft turns back
    for moved in (shifted, turned):
        assert np.degrees(moved.motion().at(np.array([0.25, 0.5])).error[0]) == pytest.approx([0.2, 0.4])


def test_a_planet_carries_its_runout_through_both_pairs() -> None:
    """An eccentric planet between sun and ring: the ring sees it half a turn of the planet later."""
    train = load("""
links:
  frame: {}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  arm: {}
revolutes: {M: [frame, sun, ring, arm], P: [arm, planet]}
gears:
  - {pair: [s, p]}
  - {pair: [p, r], tooth_form: {form: table, error: {over: driver_turn, harmonics: [[1, 0.1 deg]]}}}
inputs: {sun: 1, arm: 0}
outputs: {ring: }
""")
    motion = train.motion()
    assert motion.period == Fraction(18, 24)
    turns = np.linspace(0, 1, 7)
    # the planet turns back: 24/18 turns a turn of the sun, forwards for its pair with the ring
    wanted = -0.1 * np.sin(2 * pi * turns * 24 / 18)
    assert np.degrees(motion.at(turns).error[0]) == pytest.approx(wanted, abs=1e-12)


def test_a_simulation_in_time_follows_the_runout() -> None:
    train = chain({"eccentricity": ["0.2", "0"]}, counts=((20, 60),), rate="1 turn/s", loads={"s1": "1 N m"})
    found = train.with_changes(links={link: {"inertia": "1 kg mm2"} for link in ("s0", "s1")}).dynamics(turns=2)
    # the driver turns uniformly, and the driven shaft turns back
    error = np.degrees(found["s1"] + 2 * pi * found.time / 3)
    assert np.ptp(error) == pytest.approx(0.8129719335, rel=1e-3)


POINT = ["0", "0 deg"]
REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["1/4", "0 deg"]]}}, "not greater than that of the previous"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["1/2", "0 deg"]]}}, "not greater than that of the previous"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["3/2", "0 deg"]]}}, "outside the period"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["-18 deg", "0 deg"]]}}, "outside the period"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"]]}}, "not enough points"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["1", "0.01 deg"]]}}, "drift of the measurement"),
    ({"error": {"points": [POINT, ["1/2", "0.1 deg"], ["1", "0.018 deg"]]}}, r"differ from 20/60 by 0\.001"),
    ({"error": {"points": [POINT, ["1/2", "3 deg"], ["18 deg", "6 deg"]]}}, "give the transmission error"),
    ({"error": {"harmonics": [["1", "1 deg"]]}}, "stops or turns back"),
    ({"error": {"harmonics": [["1.5", "0.1 deg"]]}}, "whole numbers"),
    ({"error": {"harmonics": [["0", "0.1 deg"]]}}, "whole numbers"),
    ({"error": {"points": [POINT], "harmonics": [["1", "0.1 deg"]]}}, "points and harmonics"),
    ({"error": {"over": "driver_turn"}}, "neither points nor harmonics"),
    ({"error": {"harmonics": [["1", "0.1"]]}}, "has no unit"),
    ({"error": {"harmonics": [["1", "nan deg"]]}}, "nan"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "efficiency": "1.1"}, "above 1"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "efficiency": "0"}, "no power"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "efficiency": {"forward": "0.9", "backward": "-1"}}, "out of range"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "efficiency_table": {"points": [["0", "0"]]}}, "out of range"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "backlash": "-1 deg"}, "below 0"),
    ({"error": {"harmonics": [["1", "0.1 deg"]]}, "clearance": "1.01"}, "clearance"),
    ({"eccentricity": "1.5"}, "base circles come"),
    ({"eccentricity": "1 mm"}, "cannot be converted to modules"),
]


@pytest.mark.parametrize(("keys", "message"), REFUSED)
def test_tables_that_define_no_motion_are_refused(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(GearTrainError, match=message):
        _ = chain(keys, counts=((20, 60),)).meshes


def test_friction_on_the_pair_is_refused() -> None:
    form = {"form": "table", "error": {"harmonics": [["1", "0.1 deg"]]}}
    train = chain(None, counts=((20, 60),))
    changed = train.with_changes(gears=[{"pair": ["p0", "w0"], "tooth_form": form, "friction": "0.1"}])
    with pytest.raises(GearTrainError, match="friction is declared together"):
        _ = changed.meshes


def test_nested_parameters_of_a_form_are_yaml_on_the_command_line() -> None:
    done = call(
        *("mesh", "20", "60", "--form", "table", "-p", "error={over: driver_turn, harmonics: [[1, 0.4 deg]]}"),
        *("-p", "efficiency=0.97", "--json", "-o", "-"),
    )
    found = json.loads(done.stdout)
    assert degrees(found["transmission_error"]["peak_to_peak"]) == pytest.approx(0.8)
    assert (found["efficiency"]["mean"], found["efficiency"]["friction"]) == (pytest.approx(0.97), None)
    refused = call("mesh", "20", "60", "--form", "table", "-p", "error={harmonics: [[1, 0.4]]}")
    assert refused.exit_code == 2
    assert "has no unit" in refused.stderr


def test_wheels_of_such_pairs_have_standard_teeth_and_no_stresses() -> None:
    train = load("mesh-sidebands")
    work = SolidModel(train, ManufacturingSizes())
    assert any("standard teeth are cut for a20~b60, c15~d45" in each.what for each in notices(work, ["svg"]))
    assert {gear.tooth_form.form for gear in work.sized.declaration.gears if gear.tooth_form} == {"ideal"}
    why = train.strength().neglected
    assert all("the shape of its teeth is not known" in each.why for each in why if each.what == "strength")


def test_equal_planets_and_bevels_may_have_such_pairs() -> None:
    form = {"form": "table", "error": {"harmonics": [[1, "0.02 deg"]]}}
    assert load("three-planets").with_changes(tooth_form=form).meshes
    assert load("bevel-differential").with_changes(tooth_form=form).meshes
    with pytest.raises(GearTrainError, match="the runout of this pair is not modelled"):
        _ = load("bevel-differential").with_changes(tooth_form={"form": "table", "eccentricity": "0.1"}).meshes
