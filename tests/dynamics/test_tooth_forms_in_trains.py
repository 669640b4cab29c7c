"""Every tooth form within trains: what is refused, what moves, what is lost, against Willis's balances by hand."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from math import acos, cos, pi, radians, sin, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call
from hypothesis import given, settings
from hypothesis import strategies as st
from models import PAIR, PLANETARY

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics import MotionRun
from geartrain.report import collect_report
from geartrain.teeth import GearMesh
from geartrain.teeth.conjugate import ConjugateTransmission

INVOLUTE = "{form: involute}"
FORMS = ("involute", "cycloidal", "lantern", "uniform_stress", "uniform_temperature", "least_friction")
SHIPPED = ("planetary-24-18-60-involute", "longcase-clock-cycloidal", "lantern-mill", "bevel-differential-involute")
ALPHA = radians(20)


def only(train: GearTrain) -> Any:
    (mesh,) = train.meshes
    return mesh


def pair(form: str, p: str = "20", w: str = "60", axes: str = "", more: str = "inputs: {a: 1}") -> GearTrain:
    text = PAIR.format(rest=f"tooth_form: {form}\n{axes}\n{more}")
    return load(text.replace("p: 20", f"p: {p}").replace("w: 60", f"w: {w}"))


def said(train: GearTrain) -> str:
    with pytest.raises(GearTrainError) as caught:
        _ = train.meshes
    return str(caught.value)


@pytest.mark.parametrize("form", FORMS)
def test_every_form_gives_an_external_pair_its_exact_ratio(form: str) -> None:
    mesh = only(pair(f"{{form: {form}}}"))
    assert (mesh.form, mesh.driver, mesh.driven) == (form, "p", "w")
    assert mesh.verdict
    assert mesh.faults == ()
    assert mesh.transmission.ratio == Fraction(1, 3)
    assert mesh.rigid


@pytest.mark.parametrize("form", ["involute", "cycloidal", "uniform_stress", "uniform_temperature", "least_friction"])
def test_every_form_but_pins_gives_a_bevel_pair_the_angle_of_its_axes(form: str) -> None:
    axes = "axes: {A: {direction: [0, 0, 1]}, B: {direction: [1, 0, 1]}}"
    mesh = only(pair(f"{{form: {form}}}", "{teeth: 20, kind: bevel}", "{teeth: 60, kind: bevel}", axes))
    pitch = mesh.transmission.path.pitch
    assert pitch.bevel
    shaft = pitch.R1 + pitch.R2
    assert shaft == pytest.approx(pi / 4, rel=1e-15)
    assert sin(pitch.R1) / sin(pitch.R2) == pytest.approx(1 / 3, rel=1e-12)


DIRECTIONS = st.tuples(*[st.integers(-5, 5)] * 3).filter(any)


@given(DIRECTIONS, DIRECTIONS, st.sampled_from([1, -1]), st.sampled_from([1, -1]))
@settings(max_examples=40, deadline=None)
def test_a_shaft_angle_lies_between_the_ways_in_which_both_wheels_face(
    u: tuple[int, ...], v: tuple[int, ...], f: int, g: int
) -> None:
    dot, size = f * g * sum(a * b for a, b in zip(u, v, strict=True)), sum(a * a for a in u) * sum(b * b for b in v)
    axes = f"axes: {{A: {{direction: {list(u)}}}, B: {{direction: {list(v)}}}}}"
    wheels = (f"{{teeth: 20, kind: bevel, facing: {side}}}" for side in (f, g))
    train = pair("{form: cycloidal}", *wheels, axes)
    if dot * dot == size:
        assert "the shaft angle of its bevel wheels is not declared" in said(train)
    else:
        pitch = only(train).transmission.path.pitch
        shaft = pitch.R1 + pitch.R2
        assert shaft == pytest.approx(acos(dot / sqrt(size)), abs=1e-7)


@pytest.mark.parametrize(
    ("form", "p", "w", "axes", "words"),
    [
        (INVOLUTE, "{teeth: 2, kind: worm}", "60", "", ("the thread of a worm", "tooth_form: {form: ideal}")),
        (INVOLUTE, "{teeth: 20, kind: bevel}", "{teeth: 60, kind: bevel}", "", ("shaft angle", "`axes`")),
        (INVOLUTE, "{teeth: 20, kind: bevel}", "{teeth: 60, kind: contrate}", "", ("pitch cones", "ideal")),
        (INVOLUTE, "2", "60", "", ("a wheel of 2 teeth", "at least 3")),
        ("{form: lantern}", "20", "{teeth: 60, internal: true}", "", ("a ring of pins", "another tooth_form")),
        ("{form: cycloidal, centre_distance: 45}", "20", "60", "", ("never touch", "change the centre distance")),
        (
            INVOLUTE,
            "{teeth: 20, kind: bevel}",
            "{teeth: 60, kind: bevel}",
            "axes: {A: {direction: [0, 0, 1], position: [0, 0, 0]}, B: {direction: [1, 0, 0], position: [0, 1, 0]}}",
            ("do not intersect", "positions"),
        ),
    ],
    ids=["worm", "no axes", "contrate", "too few", "pins", "apart", "skew"],
)
def test_a_pair_that_cannot_have_a_form_is_refused_by_name_with_what_to_do(
    form: str, p: str, w: str, axes: str, words: tuple[str, ...]
) -> None:
    text = said(pair(form, p, w, axes))
    assert "pair 'p~w'" in text
    assert "fix: " in text
    for word in words:
        assert word in text


def test_a_pair_without_a_form_of_its_own_is_told_of_though_another_is_refused() -> None:
    train = load(
        PLANETARY.format(rest="inputs: {sun: 1}\ntooth_form: {form: lantern}").replace("s: 24", "s: {teeth: 2}")
    )
    text = said(train)
    assert "pair 's~p'" in text
    assert "pair 'p~ring'" in text


def test_a_contrate_is_taken_for_a_spur_wheel_whatever_the_axes() -> None:
    axes = "axes: {A: {direction: [0, 0, 1]}, B: {direction: [1, 0, 0]}}"
    mesh = only(pair(INVOLUTE, "20", "{teeth: 60, kind: contrate}", axes))
    assert mesh.note == "the contrate wheel is treated as a spur wheel"
    assert not mesh.transmission.path.pitch.bevel


@pytest.mark.parametrize("crank", ["a", "b"])
def test_a_ring_may_be_named_first_and_stays_the_second_gear(crank: str) -> None:
    rest = f"inputs: {{{crank}: 1}}\nfriction: 0.1"
    ring = "{teeth: 60, internal: true}"
    plain = only(pair("{form: cycloidal}", "20", ring, more=rest))
    text = PAIR.format(rest=f"tooth_form: {{form: cycloidal}}\n{rest}").replace("w: 60", f"w: {ring}")
    turned = only(load(text.replace("pair: [p, w]", "pair: [w, p]")))
    assert (turned.gears, plain.gears) == (("p", "w"), ("p", "w"))
    assert turned.driver == plain.driver == {"a": "p", "b": "w"}[crank]
    assert turned.transmission.ratio == plain.transmission.ratio == (Fraction(1, 3) if crank == "a" else 3)
    assert turned.transmission.efficiency_mean() == plain.transmission.efficiency_mean()
    assert turned.reversed.efficiency_mean() == plain.reversed.efficiency_mean()


def test_a_ring_named_first_is_refused_where_its_form_tells_the_wheels_apart() -> None:
    text = PAIR.format(rest="tooth_form: {form: involute, addendum: [1, 0.9]}\ninputs: {a: 1}")
    text = text.replace("w: 60", "w: {teeth: 60, internal: true}")
    assert only(load(text)).gears == ("p", "w")
    problem = said(load(text.replace("pair: [p, w]", "pair: [w, p]")))
    assert "the assignment of addendum" in problem
    assert "`pair: [p, w]`" in problem


def test_lengths_with_a_unit_are_compared_with_the_modules_of_the_wheels() -> None:
    wheels = ("{teeth: 20, module: 2 mm}", "{teeth: 60, module: 2 mm}")
    mesh = only(pair("{form: involute, backlash: 0.1 mm}", *wheels))
    # 0.1 mm on the driven pitch circle of 60 mm, and a pitch there of 2 mm pi
    assert mesh.verdict.backlash == pytest.approx(0.1 / 60, rel=1e-12)
    assert mesh.backlash == pytest.approx(0.1 / (2 * pi), rel=1e-12)


@pytest.mark.parametrize(
    ("form", "teeth", "kinds"),
    [
        ("{form: cycloidal, arcs: [1/4, 1/2]}", ("20", "60"), ["contact ratio"]),
        ("{form: involute, addendum: [1.9, 1]}", ("20", "60"), ["pointed"]),
        ("{form: involute, addendum: [1, 0.8]}", ("9", "60"), ["undercut"]),
    ],
)
def test_teeth_that_cannot_run_fail_check_and_report_with_what_would_fit(
    tmp_path: Path, form: str, teeth: tuple[str, str], kinds: list[str]
) -> None:
    path = tmp_path / "t.yaml"
    text = PAIR.format(rest=f"tooth_form: {form}\ninputs: {{a: 1}}")
    path.write_text(text.replace("p: 20", f"p: {teeth[0]}").replace("w: 60", f"w: {teeth[1]}"), encoding="utf-8")
    mesh = only(load(path))
    assert not mesh.verdict
    assert set(kinds) <= {fault.kind for fault in mesh.verdict.faults}
    result = call("check", path)
    assert result.exit_code == 1
    line = re.sub(r"\s+", " ", result.output)
    for problem, fault in zip(mesh.faults, mesh.verdict.faults, strict=True):
        assert f"FAIL {path}:9: pair 'p~w' (gear 1 is 'p', gear 2 'w'): {fault.what}; {fault.why}; {fault.fix}" in line
        assert problem.fix
    assert call("report", path).exit_code == 1
    assert mesh.faults[0].what in str(load(path).report())
    (data,) = json.loads(call("report", path, "--json").output)[0]["teeth"]
    assert data["verdict"]["kind"] == mesh.verdict.kind
    assert [fault["fix"] for fault in data["verdict"]["faults"]] == [fault.fix for fault in mesh.verdict.faults]
    assert data["efficiency"] is None


def test_friction_that_locks_is_a_fault_and_the_train_is_self_locking() -> None:
    mesh = only(pair(INVOLUTE, "18", more="inputs: {a: 1}\nfriction: 4"))
    assert "a coefficient of friction of 4 locks" in mesh.faults[0].what
    train = pair(INVOLUTE, "18", more="inputs: {a: 1}\nfriction: 4\nloads: {b: 1}")
    assert train.torques().verdict.kind == "self-locking"


def test_an_unknown_form_or_key_is_told_with_those_there_are() -> None:
    with pytest.raises(GearTrainError, match="did you mean 'involute'"):
        pair("{form: involut}")
    with pytest.raises(GearTrainError, match="uniform_temperature"):
        pair("{form: square}")
    with pytest.raises(GearTrainError) as caught:
        pair("{form: involute, presure_angle: 20 deg}")
    (problem,) = caught.value.problems
    assert (problem.why, problem.fix) == (
        "`tooth_form` accepts only known keys, so that a misspelt key is not ignored",
        "did you mean 'pressure_angle'?",
    )


CHAIN = """
links: {{frame: {{}}, a: {{wheels: {{a20: 20}}}}, b: {{wheels: {{b60: 60, b24: 24}}}}, c: {{wheels: {{c36: 36}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{pair: [a20, b60], tooth_form: {first}}}, {{pair: [b24, c36], tooth_form: {second}}}]
inputs: {{a: 1}}
"""
RIPPLING = "{form: triangular, half_angle: 30 deg, window: 0.5}"


@pytest.mark.parametrize("form", FORMS)
def test_conjugate_teeth_among_others_change_no_bit_of_any_motion(form: str) -> None:
    def motion(first: str) -> tuple[Any, Any]:
        run = MotionRun(load(CHAIN.format(first=first, second=RIPPLING)).motion(), 3.0, 257)
        run.run()
        run.run_random_phases(2, 7)
        run.find_spectra()
        return run.statistics, (run.phase_statistics, run.spectra)

    assert motion(f"{{form: {form}}}") == motion("{form: ideal}")


def test_no_position_is_requested_of_a_transmission_that_is_rigid(monkeypatch: pytest.MonkeyPatch) -> None:
    calls, motion = [], load("planetary-24-18-60-involute").motion()
    for turns in (1.0, -1.0):
        MotionRun(motion, turns, 3).run()  # finds the driving wheels, by the efficiencies of the pairs
    for name in ("error", "speed", "error_and_speed", "angle"):
        monkeypatch.setattr(ConjugateTransmission, name, lambda self, S, name=name: calls.append(name))
    for turns in (5.0, -5.0):
        run = MotionRun(motion, turns, 1001)
        run.run()
        run.find_spectra()
    assert calls == []
    assert motion._forward.sources == ()
    assert motion.period is None
    assert all(tally.peak_to_peak == tally.rms == 0 for tally in run.statistics)


def test_turning_back_every_driven_wheel_is_ahead_by_the_backlash_between() -> None:
    form = "{form: involute, backlash: 0.1}"
    motion = load(CHAIN.format(first=form, second=form)).motion(outputs=["b", "c"])
    turns = np.linspace(0, 3, 5)
    assert not motion._forward.at(turns).error.any()
    # 0.1 modules on pitch radii of 30 and 18; b turns against a, and takes c along the other way
    b = -0.1 / 30
    c = -b * 24 / 36 + 0.1 / 18
    passage = motion._backward.at(-turns)
    np.testing.assert_allclose(passage.error, np.repeat([[b], [c]], 5, axis=1), rtol=1e-12)
    assert not passage.rate.any()


def test_backlash_of_rigid_teeth_shifts_where_the_next_teeth_stand() -> None:
    train = load(CHAIN.format(first="{form: involute, backlash: 0.3}", second=RIPPLING))
    plain = load(CHAIN.format(first="{form: ideal}", second=RIPPLING))
    turns = np.linspace(0, 1, 101)
    real, ideal = train.motion(outputs=["c"]), plain.motion(outputs=["c"])
    found, other = real._backward, ideal._backward
    lag = 0.3 / 30
    transmission = next(mesh.transmission for mesh in train.meshes if mesh.form == "triangular").reversed_motion()
    # c's error is that of its own teeth where b really stands, and what b is ahead by, carried on
    b = 2 * pi * -turns / 3 + lag
    hung, apart = (
        each.at(-turns).error[0] - motion.pointer_offsets["c"] for each, motion in ((found, real), (other, ideal))
    )
    np.testing.assert_allclose(hung, transmission.error(b) + lag * 24 / 36, atol=1e-12)
    np.testing.assert_allclose(apart, transmission.error(b - lag), atol=1e-12)


def test_teeth_at_another_distance_than_their_own_bring_their_transmission_to_the_motion() -> None:
    wide = "{form: cycloidal, centre_distance: 40.1}"
    train = load(CHAIN.format(first=wide, second="{form: ideal}"))
    mesh = only(train)
    assert not mesh.rigid
    low, high = mesh.transmission.error_range()
    assert high - low > 1e-6
    assert only(pair("{form: cycloidal, centre_distance: 40}")).rigid
    assert only(pair("{form: involute, centre_distance: 40.1}")).rigid
    run = MotionRun(train.motion(outputs=["b", "c"]), 1.0, 4001)
    run.run()
    b, c = run.statistics
    assert b.peak_to_peak == pytest.approx(high - low, rel=2e-3)
    assert c.peak_to_peak == pytest.approx((high - low) * 24 / 36, rel=2e-3)
    (data,) = collect_report(train).to_dict()["teeth"]
    assert data["transmission_error"]["peak_to_peak"] == high - low


def test_rigid_teeth_in_a_redundant_loop_contradict_nothing_and_triangular_ones_do() -> None:
    form = "tooth_form: {form: involute, addendum: 0.9}\n"
    text = "extends: three-planets\nname: three\n"
    run = MotionRun(load(text + form).motion(), 1.0, 11)
    run.run()
    assert all(tally.peak_to_peak == 0 for tally in run.statistics)
    ring = "gears: [" + ", ".join(f"{{pair: [p{at}, r78], tooth_form: {{form: ideal}}}}" for at in (1, 2, 3)) + "]\n"
    with pytest.raises(GearTrainError, match="form a loop"):
        load(text + ring + f"tooth_form: {RIPPLING}\n").motion()


def test_the_motion_of_a_train_where_nothing_ripples_can_be_requested_for_everything() -> None:
    words = ("--samples", "50", "--spectrum", "--phases", "1", "--json")
    result = call("motion", "planetary-24-18-60-involute", *words)
    assert result.exit_code == 0
    data = json.loads(result.output)
    assert data["rigid"] == ["s~p", "p~ring"]
    assert data["drivers"] == {}


def mean_loss(
    z1: int,
    z2: int,
    mu: float,
    tips: tuple[float, float] = (1.0, 1.0),
    back: bool = False,
    steps: int = 20001,
    at_load: bool = False,
) -> float:
    """Mean loss of unshifted 20 deg involutes by forces alone, gear 1 driving, or gear 2; a ring has negative teeth.

    At constant torque of the driver, or of the driven gear: then it is the torque put in, 1/eta, that has a mean.
    Every couple in contact takes an equal share. Normal and friction force have the arms of the base circles and of
    the lengths of line of action on either side of the contact; the friction turns round at the pitch point.
    """
    radii = z1 / 2, z2 / 2
    bases = [R * cos(ALPHA) for R in radii]
    heads = [R + tip for R, tip in zip(radii, tips, strict=True)]
    recess, approach = (
        sqrt(head**2 - base**2) * (1 if R > 0 else -1) - R * sin(ALPHA)
        for head, base, R in zip(heads, bases, radii, strict=True)
    )
    pitch = pi * cos(ALPHA)
    first = np.mod((np.arange(steps) + 0.5) / steps * pitch + approach, pitch) - approach
    d = first[:, None] + pitch * np.arange(4)
    arms = [(R * sin(ALPHA) + way * d) / base for R, base, way in zip(radii, bases, (1, -1), strict=True)]
    if back:
        eta = (1 - np.sign(d) * mu * arms[0]) / (1 - np.sign(d) * mu * arms[1])
    else:
        eta = (1 + np.sign(d) * mu * arms[1]) / (1 + np.sign(d) * mu * arms[0])
    touching = d <= recess
    mean = (eta * touching).sum(axis=1) / touching.sum(axis=1)
    return 1 - (float(1 / np.mean(1 / mean)) if at_load else float(np.mean(mean)))


def test_the_losses_of_a_planetary_are_those_of_forces_on_its_teeth_and_of_willis() -> None:
    train = load("planetary-24-18-60-involute")
    # Mueller: i0 = -60/24, power flows from the sun to the ring in the carrier's frame
    i0 = -60 / 24
    ring = 18, -60, 0.06, (1.0, 0.9)
    eta0 = (1 - mean_loss(24, 18, 0.06, at_load=True)) * (1 - mean_loss(*ring, at_load=True))
    there, back = train.driven("carrier", "sun"), train.driven("sun", "carrier")
    assert float(there.efficiency or 0) == pytest.approx((1 - i0 * eta0) / (1 - i0), abs=1e-6)
    eta_back = (1 - mean_loss(24, 18, 0.06, back=True, at_load=True)) * (1 - mean_loss(*ring, back=True, at_load=True))
    assert float(back.efficiency or 0) == pytest.approx((1 - i0) / (1 - i0 / eta_back), abs=1e-6)
    loaded = train.torques()
    assert loaded.verdict
    assert float(loaded.efficiency or 0) == pytest.approx((1 - i0 * eta0) / (1 - i0), abs=1e-6)
    assert train.solve()["carrier"] == Fraction(2, 7)


@given(
    st.integers(20, 60), st.integers(20, 60), st.sampled_from(["cycloidal", "uniform_stress"]), st.floats(0.001, 0.2)
)
@settings(max_examples=12, deadline=None)
def test_any_simple_planetary_has_the_efficiency_of_willis_for_its_basic_one(
    sun: int, planet: int, form: str, mu: float
) -> None:
    text = PLANETARY.format(rest=f"inputs: {{sun: 1}}\ntooth_form: {{form: {form}}}\nfriction: {mu!r}")
    ring = sun + 2 * planet
    text = text.replace("s: 24", f"s: {sun}").replace("p: 18", f"p: {planet}").replace("teeth: 60", f"teeth: {ring}")
    train = load(text)
    first, second = train.meshes
    i0 = -ring / sun
    there = first.transmission.efficiency_at_constant_load() * second.transmission.efficiency_at_constant_load()  # type: ignore[attr-defined]
    back = first.reversed.efficiency_at_constant_load() * second.reversed.efficiency_at_constant_load()
    assert float(train.driven("carrier", "sun").efficiency or 0) == pytest.approx(
        (1 - i0 * there) / (1 - i0), rel=1e-12
    )
    assert float(train.driven("sun", "carrier").efficiency or 0) == pytest.approx((1 - i0) / (1 - i0 / back), rel=1e-12)


def bevel_loss(z1: int, z2: int, shifts: tuple[float, float]) -> float:
    """Mean loss over friction to first order of 20 deg spherical involutes at 90 deg, by arcs on the sphere."""
    R1 = np.arctan2(z1, z2)
    R2 = pi / 2 - R1
    module = 2 * sin(R1) / z1
    # a module at the large end is along the back cone: height h there is the angle atan(h / (1 / module))
    ends = []
    for R, shift in ((R1, shifts[0]), (R2, shifts[1])):
        tip = R + np.arctan(module * (1 + shift))
        base = np.arcsin(sin(R) * cos(ALPHA))
        # unwound great circle from the base circle's tangent point, less the part up to the pitch point
        ends.append(np.arccos(cos(tip) / cos(base)) - np.arccos(cos(R) / cos(base)))
    recess, approach = (end / cos(ALPHA) for end in ends)
    p = pi * module
    first = np.mod((np.arange(20001) + 0.5) / 20001 * p + approach, p) - approach
    X = first[:, None] + p * np.arange(4)
    each = (1 / tan(R1) + 1 / tan(R2)) * np.sin(np.abs(X) * cos(ALPHA)) / cos(ALPHA)
    touching = recess >= X
    return float(np.mean((each * touching).sum(axis=1) / touching.sum(axis=1)))


def test_the_losses_of_a_bevel_differential_are_those_of_arcs_on_the_sphere_and_of_its_balance() -> None:
    little = 1e-4
    train = load(f"extends: bevel-differential-involute\nname: little\nfriction: {little}\n")
    side, drive = bevel_loss(16, 10, (-0.3, 0.3)), bevel_loss(11, 41, (0.4, -0.4))
    held = train.torques("crown held").efficiency
    assert (1 - float(held or 0)) / little == pytest.approx(2 * side, rel=2e-4)
    # one wheel held: half the power goes through the spider's frame
    crown = train.torques("one wheel held").efficiency
    assert (1 - float(crown or 0)) / little == pytest.approx(drive + side, rel=2e-4)


def test_the_balance_of_a_bevel_differential_with_one_wheel_held_is_exact_in_friction() -> None:
    train = load("bevel-differential-involute")
    transmissions: dict[str, GearMesh] = {mesh.name: mesh for mesh in train.mechanics.meshes_in("one wheel held")}
    drive = transmissions["pinion~c41"].transmission.efficiency_at_constant_load()
    # in the crown's frame power goes from the held wheel to the loaded one
    eta0 = (
        transmissions["l16~p10"].transmission.efficiency_at_constant_load()
        * transmissions["r16~p10"].transmission.efficiency_at_constant_load()
    )
    found = train.torques("one wheel held").efficiency
    assert float(found or 0) == pytest.approx(drive * 2 / (1 + 1 / eta0), rel=1e-13)


def test_the_losses_of_a_wolfrom_set_are_those_of_its_torques_by_hand() -> None:
    train = load("extends: wolfrom-175\nname: w\nfriction: 0.06\nloads: {output: -1}\ntooth_form: {form: cycloidal}\n")
    found = train.torques()
    assert [pair.driver for pair in found.pairs.values()] == ["s12", "p30", "r70"]
    meshes = {mesh.name: mesh for mesh in train.meshes}
    eta1 = meshes["s12~p30"].transmission.efficiency_at_constant_load()
    eta2 = meshes["p30~r72"].transmission.efficiency_at_constant_load()
    ring = meshes["p28~r70"]
    # there it is the driver's torque that is given
    eta3 = (ring.transmission if ring.driver == "r70" else ring.reversed).efficiency_mean()
    # in the arm's frame sun and loaded ring put power in, and the held ring takes it out
    sun = (1 - eta2 * eta3 * 24 / 25) / (1 + 6 * eta1 * eta2)
    assert float(found.external["sun"]) == pytest.approx(sun, rel=1e-12)
    assert float(found.efficiency or 0) == pytest.approx(1 / 175 / sun, rel=1e-12)


def test_a_declared_efficiency_stands_before_that_of_the_teeth() -> None:
    text = PAIR.format(rest=f"tooth_form: {INVOLUTE}\nfriction: 0.1\ninputs: {{a: 1}}")
    train = load(text.replace("pair: [p, w]", "pair: [p, w], efficiency: 0.9"))
    assert train.driven("b", "a").efficiency == Fraction(9, 10)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_trains_with_forms_run_and_keep_their_exact_outputs(name: str) -> None:
    train = load(name)
    assert train.meshes
    assert all(mesh.verdict and mesh.rigid and mesh.friction for mesh in train.meshes)
    assert all(not answer.failures and answer.verdict for answer in train.answers())
    assert any(result.expect_holds for answer in train.answers() for result in answer.outputs.values())
    parent = train.declaration.extends
    if parent:
        for state in train.states or (None,):
            assert dict(train.solve(state).speeds) == dict(load(parent).solve(state).speeds)


def test_the_mill_turns_as_its_counts_say_with_its_wheels_at_right_angles() -> None:
    speeds = load("lantern-mill").solve().speeds
    assert abs(speeds["stone"]) == Fraction(72, 18) * Fraction(60, 15)
    assert abs(speeds["second"]) == Fraction(72, 18) * Fraction(60, 20)
