"""Wheels as cut: equal on the screen and in the files, able to mesh with all mates, with the requested backlash."""

from __future__ import annotations

import re
from itertools import pairwise
from math import degrees, hypot

import numpy as np
import pytest
import shipped
from sampling import all_but
from workpieces import proofs, workpiece

import geartrain
from geartrain import GearTrain, GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel, make_scene
from geartrain.workshop import export_files, notices, wheel_file

TRAINS = sorted(geartrain.shipped())
CHORDS = 2.5e-3  # modules: backlash added by the chords of two flanks


def thinned(name: str) -> bool:
    """Whether a maker's backlash applies: triangular teeth have that of their clearance."""
    return not any(mesh.form == "triangular" for mesh in shipped.train(name).meshes)


# ------------------------------------------------------------------------------------------------------ one source


@pytest.mark.parametrize("name", shipped.every_train(TRAINS, step=3))
def test_what_turns_on_the_screen_is_what_is_cut(name: str) -> None:
    """Every vertex of either outline lies on the other, for every wheel that is cut.

    Undeclared teeth are drawn with the backlash that is cut, declared teeth as declared, before a maker thins them.
    """
    train = shipped.train(name)
    state = train.states[0] if train.states else None
    as_usual, exact = workpiece(name), workpiece(name, **({"backlash": 0.0} if thinned(name) else {}))
    scene = shipped.scene(name, state)
    for wheel in scene.wheels:
        blank = as_usual.blanks.wheels.get(wheel.id)
        if blank is not None and not any(words in blank.form for words in ("no form is declared", "of a strain wave")):
            blank = exact.blanks.wheels.get(wheel.id)
        if blank is None or (not thinned(name) and blank.form != "triangular"):
            continue
        # it meshes nothing: standard teeth are a likeness, and only its pitch circle is cut
        if not wheel.circuits and blank.contours[0].is_circle:
            assert np.hypot(*blank.contours[0].points.T) == pytest.approx([wheel.radius] * 2)
            continue
        r, a = np.array(scene.profiles[wheel.profile].points).T
        own = wheel.radius * np.column_stack([r * np.cos(a), r * np.sin(a)])
        if blank.kind == "pins":
            hole = blank.contours[1].points
            away, radius = (np.hypot(*(each - hole.mean(axis=0)).T) for each in (own, hole[:1]))
            assert away == pytest.approx(np.full(len(own), radius[0]), abs=1e-12)
            continue
        if blank.pins is not None:  # pins are parts of their own, and the ring has seats for them
            R, reach = blank.pins.circle * blank.module, blank.pins.radius * blank.module
            on_pin = np.abs(np.hypot(own[:, 0] - R, own[:, 1]) - reach)
            off = np.minimum(on_pin, np.abs(r * wheel.radius - wheel.root))
            assert off.max() < 2e-3 * blank.module, "on a pin, or on the ring between pins"
            assert wheel.tip == pytest.approx(R - reach, rel=1e-12)
            continue
        teeth = blank.contours[1 if blank.kind == "ring" else 0]
        count = len(teeth.points) // blank.teeth
        cut = [*teeth.points[: count + 1]] if len(teeth.points) > count else [*teeth.points]
        off = beside(own[1:-1], np.array(cut), teeth.bulges).max()
        assert off < 1e-12 * max(wheel.radius, 1), f"{wheel.id}: a point of the screen is off by {off}"
        apart = max(np.hypot(*(own - vertex).T).min() for vertex in cut[:count])
        assert apart < 1e-12 * max(wheel.radius, 1), f"{wheel.id}: a vertex that is cut is {apart} off the screen's"
        assert wheel.tip == pytest.approx(blank.tip_radius, rel=1e-12)
        assert wheel.root == pytest.approx(blank.root_radius, rel=1e-12)


def beside(points: np.ndarray, vertices: np.ndarray, bulges: np.ndarray) -> np.ndarray:
    """How far each point is from a line of straight edges and arcs."""
    at, kinks = points @ (1, 1j), vertices @ (1, 1j)
    best = np.abs(at[:, None] - kinks).min(axis=1)
    for (a, b), bulge in zip(pairwise(kinks), bulges[: len(kinks) - 1], strict=True):
        if bulge:
            centre = a + (b - a) / 2 * (1 + 1j / np.tan(2 * np.arctan(bulge)))
            spoke, sweep = at - centre, 4 * np.arctan(bulge)
            along = np.angle(spoke / (a - centre)) / sweep
            off = np.abs(np.abs(spoke) - np.abs(a - centre))
        else:
            within = (at - a) / (b - a)
            along, off = within.real, np.abs(within.imag) * np.abs(b - a)
        best = np.where((along >= 0) & (along <= 1), np.minimum(best, off), best)
    return best


# ------------------------------------------------------------------------------------------- parts that turn together


@pytest.mark.parametrize(
    "name", shipped.every_train(TRAINS, {"pennestri-2002-missing", "freeth-2021", "huygens-planetarium-1682"}, 3)
)
def test_wheels_as_cut_turn_with_the_backlash_that_the_readme_states(name: str) -> None:
    for mesh in proofs(workpiece(name, **({"backlash": 0.08} if thinned(name) else {}))).values():
        if mesh.declared > 1e-6:
            assert mesh.overlap == 0.0, mesh.pair
            assert mesh.minimum >= mesh.declared - 1e-3, mesh.pair
        else:
            assert mesh.overlap > 0 or mesh.minimum < 1e-3, mesh.pair


def test_a_pair_that_names_its_driven_wheel_first_has_the_backlash_that_is_stated() -> None:
    """Triangular teeth have less where the driven wheel is held: their ratio is not that of the means."""
    mesh = proofs(workpiece("pennestri-2002-teeth"))["G14"]
    assert mesh.minimum == pytest.approx(mesh.declared, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "backlash"),
    [
        ("planetary-24-18-60", 0.02),
        ("planetary-24-18-60", 0.08),
        ("planetary-24-18-60-involute", 0.08),
        ("longcase-clock-cycloidal", 0.02),
        ("longcase-clock", 0.08),
    ],
)
def test_the_backlash_that_is_measured_is_the_backlash_that_was_requested_for(name: str, backlash: float) -> None:
    for mesh in proofs(workpiece(name, backlash=backlash)).values():
        assert mesh.declared == pytest.approx(backlash, abs=1e-9)
        assert backlash - 5e-4 <= mesh.minimum <= backlash + CHORDS * mesh.module + 4e-4, mesh.pair


@pytest.mark.parametrize("form", all_but({"lantern"}, ["involute", "cycloidal", "lantern", "uniform_stress"]))
def test_declared_backlash_is_cut_in_its_own_unit_where_a_module_is_requested_for(form: str) -> None:
    """`backlash: 0.1 mm` has nothing to be compared with until --module says what a module is."""
    train = declared(f"{{form: {form}, backlash: 0.1 mm}}")
    assert SolidModel(train, ManufacturingSizes()).blanks.wheels == {}
    assert any("module" in each.fix for each in SolidModel(train, ManufacturingSizes()).blanks.notices)
    work = SolidModel(train, ManufacturingSizes(module=2.0, bore=0.0))
    (backlash,) = work.blanks.backlashes
    assert backlash.length == pytest.approx(0.1, abs=1e-9)
    assert backlash.angles == pytest.approx((0.1 / 24, 0.1 / 36))
    assert 0.1 - 5e-4 <= proofs(work)["G1"].minimum <= 0.1 + 2 * CHORDS + 4e-4


def declared(form: str, p: int = 24, w: int | str = 36) -> GearTrain:
    return geartrain.load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: {p}}}}}, b: {{wheels: {{w: {w}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{id: G1, pair: [p, w]}}]
tooth_form: {form}
inputs: {{a: 1}}
""")


def test_a_backlash_that_a_pair_cannot_have_is_refused_by_name() -> None:
    triangular = "{form: triangular, half_angle: 30 deg, clearance_factor: 1.02}"
    for form, said in ((triangular, "triangular teeth of pair 'G1'"), ("{form: involute, backlash: 0.1}", "pair 'G1'")):
        with pytest.raises(GearTrainError, match=said) as caught:
            _ = SolidModel(declared(form), ManufacturingSizes(backlash=0.1)).blanks
        assert caught.value.problems[0].fix.startswith("omit --backlash, or ")


@pytest.mark.parametrize(("said", "made", "backlashes"), [
    ("", {}, (0.1, 0.1)),
    ("", {"backlash": 0.03}, (0.03, 0.03)),
    ("{form: cycloidal, backlash: 0.2 mm}", {}, (0.2, 0.1)),
    ("{form: cycloidal, backlash: 0.2 mm}", {"backlash": 0.03}, (0.2, 0.03)),
])  # fmt: skip
def test_every_pair_is_cut_with_backlash_which_it_declares_or_the_maker_gives_or_a_twentieth_of_the_module(
    said: str, made: dict[str, float], backlashes: tuple[float, float]
) -> None:
    train = geartrain.load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: 24}}}}, b: {{wheels: {{w: 36, q: 20}}}}, c: {{wheels: {{v: 30}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{id: G1, pair: [p, w], tooth_form: {said or "{form: cycloidal}"}}}, {{id: G2, pair: [q, v]}}]
tooth_form: {{form: involute}}
inputs: {{a: 1}}
""")
    work = SolidModel(train, ManufacturingSizes(module=2.0, bore=0.0, **made))
    assert [each.pair for each in work.blanks.backlashes] == ["G1", "G2"]
    assert [each.length for each in work.blanks.backlashes] == pytest.approx(backlashes, abs=1e-9)


def test_the_readme_states_the_backlash_of_every_pair() -> None:
    work = workpiece("planetary-24-18-60-involute", module=2.0, backlash=0.1)
    text = next(each for each in export_files(work, ["svg"]) if each.path == "README.md").make().decode()
    rows = re.findall(r"^- (\S+): ([\d.]+) mm, ([\d.]+)° of (\S+), ([\d.]+)° of (\S+)$", text, re.M)
    assert [(row[0], row[3], row[5]) for row in rows] == [("s~p", "s", "p"), ("p~ring", "p", "ring")]
    for _, length, first, one, second, other in rows:
        assert float(length) == pytest.approx(0.1)
        z = {"s": 24, "p": 18, "ring": 60}
        for angle, wheel in ((first, one), (second, other)):
            assert float(angle) == pytest.approx(degrees(0.1 / z[wheel]), rel=1e-3)


# ------------------------------------------------------------------------------------------------ several mates


IDLER = """
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: 30}}}}, c: {{wheels: {{x: 40}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{id: one, pair: [p, w], tooth_form: {first}}}, {{id: two, pair: [w, x], tooth_form: {second}}}]
inputs: {{a: 1}}
"""
PLAIN = "{form: involute}"


@pytest.mark.parametrize(
    "second",
    ["{form: involute, backlash: 0.2}", "{form: cycloidal}", "{form: involute, addendum: [0.8, 1]}",
     "{form: involute, pressure_angle: 25 deg}", "{form: lantern, pins: 1}",
     "{form: triangular, half_angle: 30 deg, clearance_factor: 1.02}"],
)  # fmt: skip
def test_pairs_that_ask_for_different_teeth_of_one_wheel_are_named(second: str) -> None:
    work = SolidModel(geartrain.load(IDLER.format(first=PLAIN, second=second)), ManufacturingSizes())
    assert set(work.blanks.wheels) == {"p", "x"}
    told = "wheel 'w' is not cut: pairs 'one' and 'two' require different teeth"
    assert [each.what for each in notices(work, ["svg"])] == [told]
    assert [(each.rule, each.level, each.problem.what) for each in work.train.build_findings] == [("W3", "note", told)]
    with pytest.raises(GearTrainError, match="'one' and 'two'"):
        wheel_file(work, "w", ".svg")
    scene = make_scene(work.train)
    assert any("'w'" in notice["what"] for notice in scene.notices)


@pytest.mark.parametrize("second", [PLAIN, "{form: involute, addendum: [1, 0.8]}", "{form: involute, dedendum: 1.4}"])
def test_pairs_that_can_share_a_wheel_share_it(second: str) -> None:
    train = geartrain.load(IDLER.format(first=PLAIN, second=second))
    work = SolidModel(train, ManufacturingSizes(bore=0.0, backlash=0.01))
    assert set(work.blanks.wheels) == {"p", "w", "x"}
    assert all(mesh.overlap == 0.0 for mesh in proofs(work).values())


def test_a_wheel_beside_declared_teeth_without_a_form_of_its_own_is_named() -> None:
    work = SolidModel(geartrain.load(IDLER.format(first=PLAIN, second="{form: ideal}")), ManufacturingSizes())
    assert set(work.blanks.wheels) == {"p", "w"}
    assert any("the teeth that mesh with 'w' are not declared" in each.what for each in work.blanks.notices)


@pytest.mark.parametrize("name", ["freeth-2021-teeth", "pennestri-2002-teeth", "moon-triangular", "sorge-pairs"])
def test_axes_stand_as_far_apart_as_the_law_of_triangular_teeth_asks(name: str) -> None:
    """Centre distance over tip radius is that of the tooth form for every mate, so each wheel has one size."""
    work = workpiece(name)
    places, checked = work.layout.wheels, 0
    for mesh in work.train.meshes:
        if not {mesh.driver, mesh.driven} <= set(work.blanks.wheels) or mesh.form != "triangular":
            continue
        one, other = (places[each].centre[:2] for each in (mesh.driver, mesh.driven))
        distance, transmission = hypot(one[0] - other[0], one[1] - other[1]), mesh.transmission.sizes
        for wheel, R in ((mesh.driver, transmission.R1), (mesh.driven, transmission.R2)):
            assert distance / work.blanks.wheels[wheel].tip_radius == pytest.approx(transmission.D / R, rel=1e-9)
            checked += 1
    assert checked >= 8


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("form", ["{form: ideal}", "{form: involute}", "{form: lantern}", "{form: cycloidal}"])
@pytest.mark.parametrize("teeth", [1, 2, 10_001, 10**12])
def test_wheels_that_nobody_cuts_are_named_and_drawn_all_the_same(teeth: int, form: str) -> None:
    work = SolidModel(declared(form, 20, teeth), ManufacturingSizes())
    assert "w" not in work.blanks.wheels
    assert any("wheel 'w'" in each.what for each in work.blanks.notices)
    drawn = make_scene(work.train).wheels[1]
    assert drawn.tip > drawn.root > 0


def test_shifted_involutes_stand_where_they_run_without_backlash() -> None:
    """The layout used to leave them at the distance of their reference circles, where such teeth jam."""
    train = declared("{form: involute, shift: [0.4, 0.3]}")
    work = SolidModel(train, ManufacturingSizes(bore=0.0, backlash=0.01))
    places = work.layout.wheels
    assert hypot(*np.subtract(places["w"].centre, places["p"].centre)) > 30.6 * places["p"].module
    mesh = proofs(work)["G1"]
    assert mesh.overlap == 0.0
    assert mesh.most < 0.01 + CHORDS * mesh.module


def test_a_pinion_that_never_leaves_the_teeth_of_its_ring_is_refused() -> None:
    """82 teeth in 84, a module tall: no tip circle is crossed, and the teeth overlap on the far side."""
    (fault,) = declared("{form: involute}", 82, "{teeth: 84, internal: true}").meshes[0].faults
    assert "tips of the ring" in fault.what
