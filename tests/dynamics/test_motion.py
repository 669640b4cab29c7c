"""Motion with real teeth and pins: composition by hand, published tables, conservation of mean speeds."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from math import asin, degrees, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call
from scipy.optimize import brentq

from geartrain import GearTrainError, load
from geartrain.dynamics import ErrorSamples, MotionRun, RunningStatistics
from geartrain.dynamics.motion import CoupledErrors, Superposition, solve_coupled_errors
from geartrain.kinematics.speeds import solve
from geartrain.simulation.contacts import find_tooth_impacts
from geartrain.teeth import Ideal

# a driver of the study starts where the pair before holds it back: the phases (pitches) at which its teeth are then
LAGGING = """
extends: moon-triangular
gears:
  - {id: b2~c1, pair: [b2, c1], phase: %r}
  - {id: c2~d1, pair: [c2, d1], phase: %r}
  - {id: d2~e, pair: [d2, e], phase: %r}
"""


@pytest.mark.parametrize(
    ("lagging", "turns", "samples", "peak", "rms", "minimum", "most"),
    [
        (True, 20, 400_001, 5.968, 1.238, 0.634, 1.763),
        pytest.param(True, 95, 4_000_001, 6.058, 1.2385, 0.630, 1.771, marks=pytest.mark.long),
        # teeth on the line of centres: flanks brought to touch one pair after the other
        (False, 20, 400_001, 5.980, 1.2398, 0.637, 1.768),
        pytest.param(False, 95, 4_000_001, 6.097, 1.2385, 0.629, 1.768, marks=pytest.mark.long),
    ],
)
def test_the_moon_runs_as_in_the_table(
    lagging: bool, turns: float, samples: int, peak: float, rms: float, minimum: float, most: float
) -> None:
    train = load("moon-triangular")
    if lagging:
        S, phases = 0.0, []
        for mesh in train.meshes:
            phases.append(S / mesh.transmission.period)
            S = float(mesh.transmission.angle(S))
        train = load(LAGGING % tuple(phases[1:]))
    found = train.motion(outputs=["moon"]).transmission_errors(turns, samples)
    ripple = found["moon"]
    assert degrees(ripple.peak_to_peak) == pytest.approx(peak, rel=2e-3)
    assert degrees(ripple.rms) == pytest.approx(rms, rel=1e-3)
    assert ripple.speed.min() / ripple.mean == pytest.approx(minimum, abs=2e-3)
    assert ripple.speed.max() / ripple.mean == pytest.approx(most, abs=6e-3)


def test_the_error_repeats_after_the_common_period_over_a_million_million_turns() -> None:
    motion = load("moon-triangular").motion(outputs=["moon"])
    # 95 turns of the crank are a whole number of pitches of every pair
    assert motion.period == 95
    turns = np.array([0.25, 1.75, 40.5])
    far = turns + 95 * 2.0**37  # exact in floats
    assert np.allclose(motion.at(far).error, motion.at(turns).error, rtol=0, atol=1e-11)
    found = motion.transmission_errors(95, 200_001)
    ripple = found["moon"]
    assert float(np.mean(ripple.speed[:-1])) == pytest.approx(ripple.mean, rel=1e-4)


def test_speed_is_the_derivative_of_the_angle() -> None:
    found = load("freeth-2021").motion(outputs=["mars", "moon", "venus"]).transmission_errors(2.0, 200_001)
    angle = next(iter(found.values())).angle
    for ripple in found.values():
        slope = np.gradient(ripple.mean * angle + ripple.error, angle)
        assert np.allclose(slope[1:-1], ripple.speed[1:-1], atol=1e-6 * np.abs(ripple.speed).max())


def test_the_lunar_pointer_has_the_anomaly_of_its_pin() -> None:
    found = load("freeth-2008").motion(outputs=["moon"]).transmission_errors(40.0, 200_001)
    assert found["moon"].peak_to_peak / 2 == pytest.approx(asin(1.1 / 9.6), rel=1e-6)


@pytest.mark.parametrize(
    ("planet", "minimum", "most"), [("mars", -0.369, 0.718), ("jupiter", -0.134, 0.232), ("saturn", -0.079, 0.125)]
)
def test_the_superior_planets_go_back(planet: str, minimum: float, most: float) -> None:
    train = load("freeth-2021")
    motion = train.motion(outputs=[planet])
    found = motion.transmission_errors(100.0, 200_001)
    ripple = found[planet]
    lead = float(train.solve()[motion._problem.driving_link])
    speeds = ripple.speed * lead * np.sign(ripple.mean * lead)
    assert speeds.min() == pytest.approx(minimum, abs=6e-4)
    assert speeds.max() == pytest.approx(most, abs=6e-4)
    assert speeds.min() < 0


DIFFERENTIAL = """
links:
  frame: {}
  left: {wheels: {l: 40, x: 60}}
  right: {wheels: {r: 44}}
  planet: {wheels: {p: 20, q: 18}}
  arm: {wheels: {y: 60}}
revolutes: {A: [frame, left, right, arm], P: [arm, planet]}
gears: [{pair: [l, p], driver: l}, {pair: [q, r], driver: q}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {left: 1, arm: 1/3}
outputs: {right: {}}
"""


def test_teeth_that_close_a_redundant_loop_are_named() -> None:
    text = "extends: four-gear-loop\ntooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\n"
    with pytest.raises(GearTrainError, match="a20~b30, b30~c40, c40~d50, d50~a20 form a loop, a - b - c - d - a"):
        load(text).motion()
    # along a path that spans the loop it moves: around the other way without either pair next to d
    train = load(text)
    one, other = (train.motion(outputs=["d"], without=[pair]) for pair in ("c40~d50", "d50~a20"))
    ids = [[source.id for source in motion._forward.sources] for motion in (one, other)]
    assert ids == [["d50~a20"], ["a20~b30", "b30~c40", "c40~d50"]]
    first, second = (motion.transmission_errors(3.0, 2001)["d"] for motion in (one, other))
    assert first.ratio == second.ratio
    assert np.abs(np.ptp(first.error - second.error)) > 1e-3
    with pytest.raises(GearTrainError, match="did you mean 'c40~d50'"):
        load(text).motion(without=["c40~d5"])


def test_a_train_of_ideal_teeth_has_no_ripple() -> None:
    found = load("pennestri-2002").motion(outputs=["moon"]).transmission_errors(1.0, 11)
    assert found["moon"].peak_to_peak == 0
    assert (found["moon"].speed == found["moon"].mean).all()


PAIR = """
links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {w: 36, v: 20}}, c: {wheels: {u: 30}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [p, w]}, {pair: [u, v]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {a: 1}
outputs: {b: {}, c: {}}
"""


def test_a_phase_is_that_of_the_first_wheel_whoever_drives() -> None:
    plain = load(PAIR).motion()
    declared = PAIR.replace("{pair: [p, w]}", "{pair: [p, w], phase: 1/4}").replace("[u, v]", "[u, v], phase: 0.3")
    shifted = load(declared).motion()
    transmission = {source.id: source.transmission for source in plain._forward.sources}
    first, second = shifted._forward.sources
    assert first.phase == pytest.approx(2 * pi / 24 / 4, rel=1e-15)
    # the first wheel of the second pair is driven: its own tooth is 0.3 of a pitch past the line of centres
    assert float(transmission["u~v"].angle(second.phase)) == pytest.approx(0.3 * 2 * pi / 30, rel=1e-11)
    # a phase of the first pair is a turn of the crank by as much
    turns = np.linspace(0, 2, 101)
    moved = plain.at(turns + 1 / 24 / 4).error[0] - plain.at([1 / 24 / 4]).error[0]
    assert np.allclose(shifted.at(turns).error[0], moved, rtol=0, atol=1e-13)


def test_a_starting_angle_turns_the_teeth_with_the_link() -> None:
    turns = np.linspace(0, 2, 101)
    turned = load(PAIR.replace("a: {wheels: {p: 24}}", "a: {wheels: {p: 24}, angle: 1.5 deg}")).motion()
    plain = load(PAIR).motion()
    moved = plain.at(turns + 1.5 / 360).error[0] - plain.at([1.5 / 360]).error[0]
    assert np.allclose(turned.at(turns).error[0], moved, rtol=0, atol=1e-13)


def test_random_phases_are_those_of_their_seed_and_leave_declared_ones() -> None:
    train = load(PAIR.replace("{pair: [p, w]}", "{pair: [p, w], phase: 1/4}")).motion()
    starts = [
        [source.phase for source in train.with_random_phases(np.random.default_rng(seed))._forward.sources]
        for seed in (1, 1, 2)
    ]
    assert starts[0] == starts[1] != starts[2]
    assert {each[0] for each in starts} == {train._forward.sources[0].phase}


def test_turned_back_the_other_flanks_drive_and_all_backlash_is_taken_up() -> None:
    motion = load(PAIR).motion()
    ahead = motion.transmission_errors(1.0, 4001)
    back = motion.transmission_errors(-1.0, 4001)
    angle = next(iter(back.values())).angle
    assert angle[-1] == pytest.approx(-2 * pi)
    # the mirror image: the same range, and the teeth apart by the play
    assert back["b"].peak_to_peak == pytest.approx(ahead["b"].peak_to_peak, rel=1e-5)
    (mesh, _) = load(PAIR).meshes
    first = [motion._forward.at(-angle).error[0] for angle in (np.linspace(0, 1 / 24, 50),)]
    behind = motion._backward.at(-np.linspace(0, 1 / 24, 50)).error[0]
    backlash = -(behind - first[0])  # b turns against a
    assert (backlash > 0).all()
    assert backlash.min() == pytest.approx(mesh.verdict.backlash, rel=0.05)


def test_power_decides_who_drives_where_a_load_is_declared() -> None:
    loaded = PAIR.replace("inputs: {a: 1}", "inputs: {a: 1}\nloads: {a: -2 N m}\nsolve_for: c")
    drivers = load(loaded).motion()._problem.drivers
    assert (drivers["p~w"].wheel, drivers["u~v"].wheel) == ("w", "u")
    assert "power" in drivers["p~w"].why
    ideal = load(PAIR).motion()._problem.drivers
    assert (ideal["p~w"].wheel, ideal["p~w"].why) == ("p", "power flow a -> b and c")
    page = call("motion", "moon-triangular", "--turns", 1, "--samples", 101).stdout
    assert "power flow crank -> moon" in page
    # driven from the far end, the wheel near the input still follows the law of the other
    backwards = load(loaded).motion()
    (source,) = (source for source in backwards._forward.sources if source.id == "p~w")
    passage = backwards.at(np.linspace(0, 1, 201))
    b = -24 / 36 * 2 * pi * passage.turns + passage.error[0]
    # the first wheel is driven here: a tooth of it, not of its driver, is on the line of centres at the start
    assert np.allclose(source.transmission.angle(source.phase), 0, atol=1e-15)
    assert np.allclose(source.transmission.angle(source.phase - b), 2 * pi * passage.turns, rtol=0, atol=1e-11)


def test_estimates_and_spectrum_are_those_of_the_table_and_of_a_fourier_sum() -> None:
    run = MotionRun(load("moon-triangular").motion(outputs=["moon"]), 95.0, 380_001)
    superposed = Superposition(run.motion._forward)
    assert degrees(superposed.bounds[0]) == pytest.approx(6.46, abs=5e-3)
    assert degrees(superposed.independent[0]) == pytest.approx(1.2385, abs=5e-5)
    # the same sums from angles at which flanks are brought to touch
    turns = np.arange(380_001) / 4000
    composed = run.motion.at(turns).error[0]
    for lagged, maximum, rms in ((False, 0.9538, 0.19181), (True, 0.7162, 0.11933)):
        off = superposed.at(turns, lagged)[0] - composed
        off -= off.mean()
        assert degrees(np.abs(off).max()) == pytest.approx(maximum, abs=1e-4)
        assert degrees(off.std()) == pytest.approx(rms, abs=1e-5)
    run.find_spectra()
    lines = run.spectra["moon"]
    assert lines[0].order == Fraction(1536, 95)  # 24-wheel: 64/38 turns of the 225-wheel's 1/5, times 48 teeth
    assert [pair for pair, _, _ in lines[1].shares] == ["b2~c1"]
    passage = run.motion.at(np.arange(380_000) / 4000)
    lines_by_fft = 2 * np.abs(np.fft.rfft(passage.error[0])) / 380_000
    for line in lines:
        assert line.measured == pytest.approx(lines_by_fft[int(line.order * 95)], rel=1e-9)
        assert line.expected == pytest.approx(line.measured, rel=0.3)


@pytest.mark.parametrize("name", ["freeth-2021", "pennestri-2002", "freeth-2008", "ravigneaux-set"])
def test_sensitivities_are_the_change_of_an_output_with_a_tooth_count(name: str) -> None:
    """A driven wheel with slightly more teeth falls behind as by an error in proportion to its own relative angle."""
    train = load(name)
    state = train.states[0] if train.states else None
    motion = train.motion(state)
    speeds = {link: motion._problem.ratio(link) for link in train.declaration.links}
    step = Fraction(1, 10**12)
    checked = 0
    for at, circuit in enumerate(train.circuits):
        if circuit.kind != "gear" or circuit.id not in motion._propagation.pairs:
            continue
        driven = int(motion._problem.drivers[circuit.id].wheel == circuit.wheels[0])
        a, b = (10**12 * count + (side == driven) * count for side, count in enumerate((circuit.a, circuit.b)))
        circuits = [*train.circuits[:at], circuit._replace(a=a, b=b), *train.circuits[at + 1 :]]
        case = train.declaration.case(state)
        lead = case.inputs[motion._problem.driving_link]
        changed = solve(replace(train.kinematics.whole, circuits=circuits), case, train.kinematics.signs)
        link = (circuit.i, circuit.j)[driven]
        relative = motion._problem.relative(link, circuit.carrier)
        for output, (of, base) in motion.outputs.items():
            found = (changed.speeds[of] - changed.speeds[base]) / lead - (speeds[of] - speeds[base])
            expected = -motion.sensitivity[output][circuit.id] * float(relative * step)
            assert float(found) == pytest.approx(expected, rel=1e-9, abs=1e-24)
            checked += 1
    assert checked


OPPOSED = """
axes: {A: {direction: [0, 0, 1]}, B: {direction: [0, 0, %s]}}
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: 60}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {a: 1}
outputs: {seen: {of: b, relative_to: a}, back: {of: a, relative_to: b}, own: {of: b}}
"""


def test_an_axis_may_point_down_where_an_output_is_seen_from_another_link(tmp_path: Path) -> None:
    """Whichever way the axis of b is declared to point, the same wheels turn: all that is about it changes sign."""
    runs = {}
    for sense in (1, -1):
        path = tmp_path / f"axis{sense}.yaml"
        path.write_text(OPPOSED % sense, encoding="utf-8")
        train = load(path)
        speeds = train.solve()
        motion = train.motion()
        assert [tally.ratio for tally in motion._statistics()] == [speeds[name] for name in motion.outputs]
        runs[sense] = motion, speeds
    (up, speeds), (down, turned) = runs[1], runs[-1]
    assert [speeds["seen"], speeds["back"]] == [Fraction(-4, 3), Fraction(4, 3)]
    senses = {"seen": -1, "back": 1, "own": -1}
    turns = np.linspace(0, 3, 301)
    errors = dict(zip(up.outputs, up.at(turns).error, strict=True))
    assert np.ptp(errors["own"]) > 1e-3
    for name, found in zip(down.outputs, down.at(turns).error, strict=True):
        assert turned[name] == senses[name] * speeds[name]
        assert np.allclose(found, senses[name] * errors[name], rtol=0, atol=1e-14)
        sensitivities = up.sensitivity[name], down.sensitivity[name]
        assert [abs(each["p~w"]) for each in sensitivities] == [1.0, 1.0]
    assert np.allclose(errors["back"], -errors["seen"], rtol=0, atol=1e-14)


def test_an_interrupted_table_is_partial_and_is_taken_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out, partial = tmp_path / "run.csv", tmp_path / "run.partial.csv"
    arguments = ("motion", "moon-triangular", "--turns", 3, "--samples", 100_001, "--of", "moon", "-o", out)
    composition = type(load("moon-triangular").motion(outputs=["moon"])._forward)
    whole = composition.at
    calls = []

    def at(self: Any, turns: np.ndarray) -> ErrorSamples:
        if len(turns) == 1:  # where the pointers are set
            return whole(self, turns)
        calls.append(len(turns))
        if len(calls) == 3:
            raise KeyboardInterrupt
        return whole(self, turns)

    monkeypatch.setattr(composition, "at", at)
    stopped = call(*arguments)
    assert stopped.exit_code == 130
    assert not out.exists()
    lines = partial.read_text(encoding="utf-8").splitlines()
    assert lines[-1] == f"# partial: stopped after {sum(calls[:2])} rows"
    assert len(lines) == sum(calls[:2]) + 2
    monkeypatch.undo()
    other = call(*arguments[:3], 4, *arguments[4:], "--resume")
    assert isinstance(other.exception, GearTrainError)
    partial.write_text("\n".join(lines[:-1]) + "\n0.123,to", encoding="utf-8")  # torn by a power cut
    assert call(*arguments, "--resume").exit_code == 0
    assert not partial.exists()
    resumed = out.read_text(encoding="utf-8")
    assert call(*arguments, "--force").exit_code == 0
    assert resumed == out.read_text(encoding="utf-8")


def test_an_interrupted_summary_says_what_it_has_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "run.json"
    whole = RunningStatistics.add
    seen: list[int] = []

    def add(self: RunningStatistics, error: np.ndarray, rate: np.ndarray) -> None:
        if len(seen) == 2:
            raise KeyboardInterrupt
        seen.append(len(error))
        whole(self, error, rate)

    monkeypatch.setattr(RunningStatistics, "add", add)
    arguments = ("motion", "moon-triangular", "--samples", 100_001, "--of", "moon", "-o", out)
    assert call(*arguments).exit_code == 130
    assert not out.exists()
    data = json.loads((tmp_path / "run.partial.json").read_text(encoding="utf-8"))
    assert data["partial"] == {"done": sum(seen), "of": 100_001}


IMPACTS = PAIR.replace("b: {wheels", "b: {inertia: 3 g cm2, wheels").replace(
    "c: {wheels", "c: {inertia: 5 g cm2, wheels"
)


def test_a_impact_strikes_the_inertia_of_all_that_turns_with_the_driven_wheel() -> None:
    train = load(IMPACTS + "rate: 2 turn/s\n")
    first, second = find_tooth_impacts(train.mechanics).values()
    ratio = 20 / 30
    assert first.inertia == pytest.approx((3 + 5 * ratio**2) * 1e-7, rel=1e-12)
    assert second.inertia == pytest.approx(5e-7, rel=1e-12)
    transmission = train.meshes[0].transmission
    lost = sum(leap.size**2 / 2 for leap in transmission.speed_leaps())
    dissipated = lost * first.inertia * (4 * pi) ** 2
    assert first.power == pytest.approx(dissipated * 2 * 24, rel=1e-12)
    assert second.rate == pytest.approx(2 * 24 / 36 * 20, rel=1e-12)
    assert find_tooth_impacts(load(PAIR).mechanics) == {}
    assert find_tooth_impacts(load(IMPACTS).mechanics) == {}


def test_around_a_differential_every_link_is_struck_by_its_own_jump() -> None:
    """The power a blow takes is the kinetic energy of the velocities lost, whatever links share it."""
    inertias = {"planet": 2e-7, "right": 7e-7, "arm": 9e-7, "left": 1e-3}
    text = DIFFERENTIAL.replace("inputs: {left: 1, arm: 1/3}", "inputs: {left: 1, arm: 1/3}\nrate: 1 turn/s")
    for link, inertia in inertias.items():
        text = text.replace(f"  {link}: {{", f"  {link}: {{inertia: {inertia * 1e7:.12g} g cm2, ")
    found = find_tooth_impacts(load(text).mechanics)
    # l~p: the planet jumps by 1, and right with it by -18/44; both inputs keep their speed
    assert found["l~p"].inertia == pytest.approx(2e-7 + 7e-7 * (18 / 44) ** 2, rel=1e-12)
    assert found["q~r"].inertia == pytest.approx(7e-7, rel=1e-12)


def test_the_picture_shows_where_a_pointer_goes_back() -> None:
    year = MotionRun(load("freeth-2021").motion(outputs=["mars"]), 3.0, 5001).plot()
    labels = [panel.get_ylabel() for panel in year.axes]
    assert labels == ["mars\nangle (deg)", "mars\nanomaly\nless its mean (deg)", "mars\nspeed divided by mean"]
    back = year.axes[0].lines[2]
    assert back.get_label() == "backward"
    y = np.asarray(back.get_ydata(), dtype=float)
    assert (np.diff(y)[np.isfinite(np.diff(y))] < 0).all()
    long = MotionRun(load("freeth-2021").motion(outputs=["mars"]), 284.0, 100_001).plot()
    assert long.axes[0].get_ylabel() == "mars\nbackward motion (deg)"
    (arcs,) = long.axes[0].lines
    starts = np.flatnonzero(np.diff(np.isfinite(np.append(np.nan, arcs.get_ydata())).astype(int)) == 1)
    # 133 arcs, the first cut in two by the ends of the run; those that pass 0 on the dial are broken there
    assert 134 <= len(starts) < 150


REVERSED_PIN = """
links: {frame: {}, a: {wheels: {p: 24}}, k: {wheels: {w: 36}}, out: {wheels: {x: 30}}, last: {wheels: {y: 40}}}
revolutes: {A: [frame, a], B: [frame, k], C: [frame, out], D: [frame, last]}
gears: [{pair: [p, w]}, {pair: [x, y]}]
couplings: [{id: pin, kind: KIND, pin: k, slot: out, pin_radius: RADIUS mm, offset: 5 mm}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {a: 1}
outputs: {k: {}, out: {}, last: {}}
"""


@pytest.mark.parametrize(("kind", "radius"), [("pin_and_slot", 9), ("pin_follower", 4)])
@pytest.mark.parametrize("turns", [2.0, -2.0])
def test_a_slot_points_to_its_pin_whichever_way_the_pin_goes(kind: str, radius: float, turns: float) -> None:
    motion = load(REVERSED_PIN.replace("KIND", kind).replace("RADIUS", str(radius))).motion()
    passage = next(motion._stretches(turns, 1001))
    ratios = [float(tally.ratio) for tally in motion._statistics()]
    k, out, _ = (2 * pi * ratio * passage.turns + e for ratio, e in zip(ratios, passage.error, strict=True))
    # the slot's axis is 5 mm from the pin's, in the direction from which the pin's angle counts
    to_pin = radius * np.exp(1j * k) - 5
    seen = to_pin if kind == "pin_and_slot" else -to_pin
    assert np.allclose(np.exp(1j * out), seen / np.abs(seen), rtol=0, atol=1e-12)
    if kind == "pin_and_slot":
        assert not passage.reversing_drivers
    else:  # its slot rocks, and the wheel on it with it
        assert passage.reversing_drivers == {"x~y"}


def test_what_a_run_tells_is_of_that_run_alone() -> None:
    motion = load(REVERSED_PIN.replace("KIND", "pin_follower").replace("RADIUS", "4")).motion()
    whole = MotionRun(motion, turns=1.0, samples=1001)
    whole.run()
    assert whole.reversing_drivers == {"x~y"}
    # the slot has not begun to rock back yet where this run ends
    short = MotionRun(motion, turns=0.1, samples=101)
    short.run()
    assert short.reversing_drivers == set()


@pytest.mark.parametrize("name", ["freeth-2021-teeth", "pennestri-2002-teeth"])
def test_every_transmission_holds_at_the_angle_where_its_driver_stands(name: str) -> None:
    train = load(name)
    links = list(train.declaration.links)
    motion = train.motion(outputs=links)
    turns = np.linspace(0, 1.7, 400)
    passage = motion.at(turns)
    angle = dict(zip(links, passage.error, strict=True))
    for link in links:
        angle[link] = angle[link] + 2 * pi * float(motion._problem.ratio(link)) * turns
    meshes = {mesh.name: mesh for mesh in train.meshes}
    for circuit in train.circuits:
        i, j, k = (
            train.kinematics.signs.get(link, 1) * angle[link] for link in (circuit.i, circuit.j, circuit.carrier)
        )
        mesh = meshes.get(circuit.id)
        if mesh is None:
            continue
        first = mesh.driver == circuit.wheels[0]
        driver, driven = (i - k, j - k) if first else (j - k, i - k)
        way = np.sign(driver[-1] - driver[0])
        transmission, start = mesh.transmission, 0.0
        if not first:  # a tooth of the driven wheel is on the line of centres
            ends = -2 * transmission.period, 2 * transmission.period
            start = brentq(lambda S, own=transmission: float(own.angle(S)), *ends, xtol=1e-16)
        turned = way * (transmission.angle(start + way * driver) - transmission.angle(start))
        assert np.allclose(driven, -np.sign(circuit.a * circuit.b) * turned, rtol=0, atol=1e-9), circuit.id


def test_a_tally_of_stretches_is_that_of_the_whole() -> None:
    random = np.random.default_rng(3)
    error, rate = random.normal(size=(2, 1000)) + np.linspace(0, 5, 1000)
    tally = RunningStatistics("x", Fraction(1))
    for part in np.split(np.arange(1000), [10, 300, 950]):
        tally.add(error[part], rate[part])
    assert tally.rms == pytest.approx(float(np.std(error)), rel=1e-13)
    assert (tally.minimum, tally.most, tally.slow) == (error.min(), error.max(), rate.min())


def test_speeds_of_coupled_pairs_are_the_slopes_of_their_angles() -> None:
    motion = load("pennestri-2002-teeth").motion()
    turns = np.linspace(0.1, 0.1 + 1e-4, 5)
    passage = motion.at(turns)
    slope = np.gradient(passage.error, 2 * pi * turns, axis=1)[:, 1:-1]
    assert np.allclose(slope, passage.rate[:, 1:-1], rtol=0, atol=1e-5)
    assert np.abs(passage.rate).max() > 0.01


ExactRatio = type(Ideal(form="ideal").transmission(1, 1))


class Saw(ExactRatio):
    """A law of straight pieces: its error climbs steeply and falls gently."""

    def __init__(self, height: float, rise: float) -> None:
        super().__init__(Fraction(1), 2 * pi)
        self.height, self.rise = height, rise

    def error(self, S: np.ndarray) -> np.ndarray:
        x = np.mod(S, 2 * pi)
        return self.height * np.interp(x, [0, self.rise, 2 * pi], [-1, 1, -1])

    def speed(self, S: np.ndarray) -> np.ndarray:
        x = np.mod(S, 2 * pi)
        return 1 + 2 * self.height * np.where(x < self.rise, 1 / self.rise, -1 / (2 * pi - self.rise))


def test_newton_is_kept_from_leaping_over_kinks_and_refuses_a_dead_centre() -> None:
    base = np.linspace(0, 2 * pi, 5001)[None]
    one = CoupledErrors(("m",), (Saw(0.5, 0.2),), np.array([1.0]), np.array([[-4.0]]))
    delta, rate, turning = solve_coupled_errors(one, base, [1.0])
    transmission = one.transmissions[0]
    assert np.abs(delta[0] - transmission.error(base[0] - 4 * delta[0])).max() < 1e-13
    assert np.allclose(turning[0], 1 - 4 * rate[0])
    # the driven side drives its own driver faster than it is driven: past a dead centre
    with pytest.raises(GearTrainError, match="dead centre"):
        solve_coupled_errors(CoupledErrors(("m",), one.transmissions, np.array([1.0]), np.array([[4.0]])), base, [1.0])


class Points(ExactRatio):
    """A law of straight pieces through some points of one turn; it jumps where two of them have the same S."""

    def __init__(self, S: list[float], q: list[float]) -> None:
        super().__init__(Fraction(1), 2 * pi)
        self.S, self.q = np.array([0, *S, 2 * pi]), np.array([0, *q, 2 * pi])

    def error(self, S: np.ndarray) -> np.ndarray:
        x = np.mod(S, 2 * pi)
        return np.interp(x, self.S, self.q) - x

    def speed(self, S: np.ndarray) -> np.ndarray:
        at = np.searchsorted(self.S, np.mod(S, 2 * pi), side="right") - 1
        return (np.diff(self.q) / np.where(np.diff(self.S) > 0, np.diff(self.S), 1))[at]


@pytest.mark.parametrize(
    ("S", "q"),
    [([1.0, 2.0], [1.4, 1.4]), ([1.0, 2.0, 4.0, 5.0], [1.9, 1.9, 4.8, 4.8]), ([2.0, 3.0, 3.0], [2.1, 2.1, 3.4])],
    ids=["a dwell", "two dwells", "a dwell that ends in a jump"],
)
def test_a_driver_that_is_turned_by_what_it_drives_is_followed_past_dwells_and_jumps(
    S: list[float], q: list[float]
) -> None:
    """Where the driven wheel is given, q = base, the driver is at the inverse of the law, which is exact by points."""
    base = np.linspace(0, 2 * pi, 4001)[None, 1:-1]
    pair = CoupledErrors(("m",), (Points(S, q),), np.array([1.0]), np.array([[-1.0]]))
    delta, _, _ = solve_coupled_errors(pair, base, [1.0])
    inverse = np.interp(base[0], [0, *q, 2 * pi], [0, *S, 2 * pi])
    clear = np.abs(base[0][:, None] - q).min(axis=1) > 1e-6  # in a dwell the driver is anywhere
    assert np.abs(base[0] - delta[0] - inverse)[clear].max() < 1e-9


def test_a_driver_that_is_turned_by_what_it_drives_is_infinitely_behind_where_nothing_touches() -> None:
    class Apart(ExactRatio):
        def error(self, S: np.ndarray) -> np.ndarray:
            return np.full_like(S, -np.inf)

        def speed(self, S: np.ndarray) -> np.ndarray:
            return np.zeros_like(S)

    pair = CoupledErrors(("m",), (Apart(Fraction(1), 2 * pi),), np.array([1.0]), np.array([[-1.0]]))
    delta, rate, _ = solve_coupled_errors(pair, np.zeros((1, 3)), [1.0])
    assert (delta == -np.inf).all()
    assert not rate.any()
