"""Wheels as they are cut: the same on the screen as in the files, fit for all their mates, with the play asked for."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache, cached_property
from itertools import pairwise
from math import atan2, cos, degrees, hypot, pi, sin, tan, tau
from typing import Any

import numpy as np
import pytest
import shapely
import shipped
import yaml
from shapely.affinity import affine_transform

import geartrain
from geartrain import GearTrain, GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel, make_scene
from geartrain.workshop import export_files, notices, wheel_file

TRAINS = sorted(geartrain.shipped())
PLAYED = [
    "ferguson-paradox",
    "lantern-mill",
    "longcase-clock",
    "longcase-clock-bs978",
    "longcase-clock-cycloidal",
    "planetary-24-18-60",
    "planetary-24-18-60-involute",
]
NOTHING = 1e-9  # mm2: an overlap that is none
FEELER = 1e-12  # mm2: an overlap by which a touch is felt
CHORDS = 2.5e-3  # modules: what the chords of two flanks add to their play


@cache
def workpiece(name: str, **making: float) -> SolidModel:
    """A shipped train in some sizes, made once for all tests that ask for the same."""
    train = shipped.train(name)
    model = SolidModel(train, ManufacturingSizes(**making), train.states[0] if train.states else None)
    vars(model)["_laid"] = shipped.layout(name)  # as the model itself would lay out the train, for each of its sizes
    return model


def unrolled(points: Any, bulges: Any) -> np.ndarray:
    """A closed line with arcs as 48 chords each: a bulge b is an arc whose height is b times half its chord."""
    start = points @ np.array([1, 1j])
    end, bulge = np.roll(start, -1), np.asarray(bulges, dtype=float)
    arcs = bulge != 0
    sweep = 4 * np.arctan(bulge[arcs])
    centre = start[arcs] + (end - start)[arcs] / 2 * (1 + 1j / np.tan(sweep / 2))
    line = np.full((len(start), 48), np.nan, dtype=complex)
    line[:, 0] = start
    steps = np.exp(1j * sweep[:, None] * np.arange(1, 48) / 48)
    line[arcs, 1:] = centre[:, None] + (start[arcs] - centre)[:, None] * steps
    line = line[~np.isnan(line.real)]
    return np.column_stack([line.real, line.imag])


def material(blank: Any) -> Any:
    """A wheel as a polygon; of a lantern its pins, of a ring what stands round its hole."""
    outer, *holes = (unrolled(each.points, each.bulges) for each in blank.contours)
    if blank.kind == "pins":
        pins = map(shapely.Polygon, holes)
        return shapely.union_all([pin for pin in pins if pin.centroid.distance(shapely.Point(0, 0)) > 1e-6])
    whole = shapely.Polygon(outer, holes)
    assert whole.is_valid, "holes lie inside and apart"
    return whole if blank.pins is None else shapely.union_all([whole, *round_pins(blank)])


def round_pins(blank: Any) -> list[Any]:
    """Those that lie in the seats of a ring, by the chords round them."""
    turns, sides = 2 * np.pi * np.arange(blank.teeth) / blank.teeth, 2048
    reach, R = blank.pins.radius / cos(pi / 4 / sides) * blank.module, blank.pins.circle * blank.module
    return [shapely.Point(R * cos(t), R * sin(t)).buffer(reach, quad_segs=sides) for t in turns.tolist()]


def facing(wheel: Any, half: float) -> Any:
    """What of a wheel lies within an angle, twice `half`, about the x axis; all of it where that is no wedge."""
    if half > pi / 3:
        return wheel
    far = 2 * max(wheel.bounds)
    return wheel.intersection(shapely.Polygon([(0, 0), (far, -far * tan(half)), (far, far * tan(half))]))


def moved(wheel: Any, turn: float, away: float = 0.0) -> Any:
    """A wheel turned about its axle, then taken along the x axis."""
    return affine_transform(wheel, [cos(turn), -sin(turn), sin(turn), cos(turn), away, 0])


def lines(blank: Any) -> tuple[bytes, ...]:
    """All that `material` is made from."""
    return (blank.kind.encode(), *(part.tobytes() for each in blank.contours for part in (each.points, each.bulges)))


class Meshed:
    """The two wheels of a pair on their axles, the second, or the ring, to the right; turned as the pair's law has it.

    Knows the tooth numbers, where the layout puts the axes, and for triangular teeth their law.
    """

    def __init__(self, work: SolidModel, gear: Any) -> None:
        first, second = gear.pair
        mesh = next((each for each in work.sized.meshes if each.name == gear.name), None)
        self.transmission = None
        if mesh is not None and mesh.form == "triangular":
            first, second, self.transmission = mesh.driver, mesh.driven, mesh.transmission
        self.uneven = ()  # laws of both flanks of teeth that are not conjugate
        if hasattr(getattr(mesh, "transmission", None), "gears"):
            first, second, self.uneven = mesh.driver, mesh.driven, (mesh.transmission, mesh.coast)
        if work.blanks.wheels[first].kind == "ring":
            first, second = second, first
        one, other = (work.blanks.wheels[each] for each in (first, second))
        self.z1, self.z2, self.ring = one.teeth, other.teeth, other.kind == "ring"
        self.R2, self.module = other.pitch_radius, other.module
        places = work.layout.wheels
        apart = np.subtract(places[second].centre, places[first].centre)
        along = np.array(work.layout.axes[places[first].axis].direction)
        self.distance = float(np.linalg.norm(apart - (apart @ along) * along))
        self.tip = one.tip_radius
        self.reach = self.distance - other.tip_radius
        self.blanks = one, other
        self.own: dict[float, Any] = {}
        self.key = (lines(one), lines(other), round(self.distance, 9))

    @cached_property
    def shapes(self) -> tuple[Any, Any]:
        """Both wheels as polygons, made for pairs that are turned; of a pair without a ring the teeth near the mate."""
        first, second = map(material, self.blanks)
        if self.ring:
            return first, second
        low, _, far, high = self.zone
        return (
            facing(first, atan2(high, low) + self.most(self.z1)),
            facing(second, atan2(high, self.distance - far) + self.most(self.z2)),
        )

    @cached_property
    def zone(self) -> tuple[float, float, float, float]:
        """Where the tip circles of a pair without a ring overlap, a module broader on all sides: two corners."""
        high = self.tip * (1 - min(self.reach / self.tip, 1.0) ** 2) ** 0.5 + self.module
        return self.reach - self.module, -high, self.tip + self.module, high

    @staticmethod
    def most(z: int) -> float:
        """How far a wheel is turned from where it is at t = 0 without play, at most."""
        return 2 * tau / z

    def overlap(self, t: float, lag: float = 0.0, back: bool = False) -> float:
        """Common area when the first wheel is t on, the second `lag` (rad) ahead of the middle of its play."""
        if self.transmission is not None:
            transmission = self.transmission.reversed_motion() if back else self.transmission
            turned = float(transmission.angle(np.array(t))) + lag
            turn = turned if self.ring else pi - turned
        elif self.ring:
            turn = pi / self.z2 + t * self.z1 / self.z2 + lag
        else:
            turn = pi + pi / self.z2 - t * self.z1 / self.z2 - lag
        _, second = self.shapes
        away = -self.distance if self.ring else self.distance
        other = moved(second, turn, away)
        if not self.ring:  # where the tip circles overlap, for speed
            assert abs(t) < self.most(self.z1)
            assert abs(turn - pi) < self.most(self.z2)
            other = shapely.clip_by_rect(other, *self.zone)
        return float(self.turned(t).intersection(other).area)

    def turned(self, t: float) -> Any:
        """The first wheel when it is t on, made once for all places of the second."""
        if t not in self.own:
            own = moved(self.shapes[0], t)
            self.own = {t: own if self.ring else shapely.clip_by_rect(own, *self.zone)}
        return self.own[t]

    def flanks(self, t: float) -> list[float]:
        """Where teeth that are not conjugate meet, `lag` of either flank; a chord of an outline short of it."""
        middle = self.uneven[0].gears.backlash / self.z2 if self.uneven else 0.0
        errors = [float(transmission.error(np.array(t))) - middle for transmission in self.uneven]
        return [error + short for error, short in zip(errors, (1e-4, -1e-4), strict=False)]

    def positions(self, count: int) -> Iterator[float]:
        """Through a pitch of the first wheel, none of them a symmetric one."""
        return (tau / self.z1 * (k + 0.137) / count for k in range(count))

    def backlash(self, t: float) -> float:
        """How far (mm on the pitch circle) the second wheel is free, found by turning it until it bites."""
        ends = []
        for way in (1, -1):
            free, met = 0.0, way * 0.5 * pi / self.z2
            assert self.overlap(t, met) > NOTHING
            for _ in range(20):  # to a millionth of half the tooth
                middle = (free + met) / 2
                free, met = (free, middle) if self.overlap(t, middle) > FEELER else (middle, met)
            ends.append(free)
        return abs(ends[0] - ends[1]) * self.R2


@cache
def sizes(name: str, backlash: float) -> tuple[tuple[str, Meshed, float], ...]:
    """Every pair of a train whose wheels are cut and stand where they mesh, with the play that the README states."""
    train = shipped.train(name)
    thinned = not any(mesh.form == "triangular" for mesh in train.meshes)
    work = workpiece(name, **({"backlash": backlash} if thinned else {}))
    backlashes = {each.pair: each for each in work.blanks.backlashes}
    wheels = train.declaration.wheels
    gears = [
        gear
        for gear in train.declaration.gears
        if gear.name in backlashes
        and gear.name not in work.layout.apart
        and not any(wheels[wheel][1].flexible for wheel in gear.pair)  # bent, not rolled, into its ring
    ]
    return tuple((gear.name, Meshed(work, gear), backlashes[gear.name].length) for gear in gears)


def overlapping(trains: Iterable[str], backlash: float, count: int) -> tuple[int, list[str]]:
    """How many different pairs were turned, and those whose wheels overlap."""
    seen: set[Any] = set()
    wrong = []
    for name in trains:
        for pair, meshed, given in sizes(name, backlash):
            if meshed.key in seen:
                continue
            seen.add(meshed.key)
            side = (1 - 1e-7) * given / 2 / meshed.R2 if meshed.transmission is None else 0.0
            for t in meshed.positions(count):
                for lag in meshed.flanks(t) or {side, -side}:
                    both = (False, True) if meshed.transmission is not None else (False,)
                    worst = max(meshed.overlap(t, lag, back) for back in both)
                    wrong += [f"{name} {pair} at {degrees(t):.4f} deg: {worst:.3g} mm2"] if worst > NOTHING else []
    return len(seen), wrong


# ------------------------------------------------------------------------------------------------------ one source


@pytest.mark.parametrize("name", shipped.every_train(TRAINS))
def test_what_turns_on_the_screen_is_what_is_cut(name: str) -> None:
    """Every vertex of either outline lies on the other, for every wheel that is cut.

    Teeth nobody declares are drawn with the play that is cut; declared ones as they are declared, before a maker thins
    them.
    """
    train = shipped.train(name)
    state = train.states[0] if train.states else None
    thinned = not any(mesh.form == "triangular" for mesh in train.meshes)
    as_usual, exact = workpiece(name), workpiece(name, **({"backlash": 0.0} if thinned else {}))
    scene = shipped.scene(name, state)
    for wheel in scene.wheels:
        blank = as_usual.blanks.wheels.get(wheel.id)
        if blank is not None and not any(words in blank.form for words in ("no form is declared", "of a strain wave")):
            blank = exact.blanks.wheels.get(wheel.id)
        if blank is None or (not thinned and blank.form != "triangular"):
            continue
        if (
            not wheel.circuits and blank.contours[0].is_circle
        ):  # it meshes nothing: standard teeth are a likeness, and only its pitch circle is cut
            assert np.hypot(*blank.contours[0].points.T) == pytest.approx([wheel.radius] * 2)
            continue
        points = scene.profiles[wheel.profile].points
        if blank.kind == "pins":
            hole = blank.contours[1].points.mean(axis=0)
            for r, angle in points:
                at = np.array([r * wheel.radius * cos(angle), r * wheel.radius * sin(angle)])
                assert hypot(*(at - hole)) == pytest.approx(hypot(*(blank.contours[1].points[0] - hole)), abs=1e-12)
            continue
        if blank.pins is not None:  # pins are parts of their own, and the ring has seats for them
            R, reach, inside = (
                part * blank.module for part in (blank.pins.circle, blank.pins.radius, wheel.root / blank.module)
            )
            for r, a in points:
                at = r * wheel.radius
                on_pin = abs(hypot(at * cos(a) - R, at * sin(a)) - reach)
                assert min(on_pin, abs(at - inside)) < 2e-3 * blank.module, "on a pin, or on the ring between pins"
            assert wheel.tip == pytest.approx(R - reach, rel=1e-12)
            continue
        teeth = blank.contours[1 if blank.kind == "ring" else 0]
        count = len(teeth.points) // blank.teeth
        own = np.array([(r * wheel.radius * cos(a), r * wheel.radius * sin(a)) for r, a in points])
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


def test_the_wheels_of_two_known_trains_have_one_size() -> None:
    """The planet of 18 teeth is 0.9 modules tall, for so its ring needs it; drawn it used to be 1 module tall."""
    for name, wheel, R, addendum in (("planetary-24-18-60", "p", 9, 0.9), ("gm-4t60", "p2", 8, 0.8)):
        work, scene = (
            workpiece(name),
            shipped.scene(name, shipped.train(name).states[0] if shipped.train(name).states else None),
        )
        drawn = next(each for each in scene.wheels if each.id == wheel)
        module = work.blanks.wheels[wheel].module
        assert drawn.radius == pytest.approx(R * module)
        assert drawn.tip == pytest.approx((R + addendum) * module, rel=1e-12)
        assert work.blanks.wheels[wheel].tip_radius == pytest.approx((R + addendum) * module, rel=1e-12)


# ------------------------------------------------------------------------------------------- parts that turn together


@pytest.mark.parametrize(
    ("names", "pairs"), [(list(shipped.KINDS), 50), pytest.param(TRAINS, 180, marks=pytest.mark.slow)]
)
def test_no_two_wheels_of_a_shipped_train_overlap_as_they_turn(names: list[str], pairs: int) -> None:
    count, wrong = overlapping(names, 0.0, 3)
    assert count > pairs
    assert wrong == []


def test_no_two_wheels_that_are_cut_with_backlash_overlap_at_either_end_of_it() -> None:
    """One train of each form that can be thinned, of standard teeth a ring and pairs that jam too."""
    count, wrong = overlapping(PLAYED, 0.08, 3)
    assert count == 20
    assert wrong == []


@pytest.mark.long
@pytest.mark.parametrize("backlash", [0.0, 0.08])
def test_no_two_wheels_overlap_at_many_positions(backlash: float) -> None:
    _, wrong = overlapping(TRAINS, backlash, 12)
    assert wrong == []


@pytest.mark.parametrize("backlash", [0.0, 0.02, 0.08])
@pytest.mark.parametrize(
    "name", ["planetary-24-18-60", "planetary-24-18-60-involute", "longcase-clock-cycloidal", "longcase-clock"]
)
def test_the_backlash_that_is_measured_is_the_backlash_that_was_requested_for(name: str, backlash: float) -> None:
    found = sizes(name, backlash)
    assert found
    assert all(stated == pytest.approx(backlash, abs=1e-9) for _, _, stated in found)
    for pair, meshed in {meshed.key: (pair, meshed) for pair, meshed, _ in found}.values():
        minimum = min(meshed.backlash(t) for t in meshed.positions(3))
        assert backlash - 1e-5 <= minimum <= backlash + CHORDS * meshed.module, pair


@pytest.mark.parametrize("form", ["involute", "cycloidal", "lantern", "uniform_stress"])
def test_declared_backlash_is_cut_in_its_own_unit_where_a_module_is_requested_for(form: str) -> None:
    """`backlash: 0.1 mm` has nothing to be compared with until --module says what a module is."""
    train = declared(f"{{form: {form}, backlash: 0.1 mm}}")
    assert SolidModel(train, ManufacturingSizes()).blanks.wheels == {}
    assert any("module" in each.fix for each in SolidModel(train, ManufacturingSizes()).blanks.notices)
    work = SolidModel(train, ManufacturingSizes(module=2.0, bore=0.0))
    (backlash,) = work.blanks.backlashes
    assert backlash.length == pytest.approx(0.1, abs=1e-9)
    assert backlash.angles == pytest.approx((0.1 / 24, 0.1 / 36))
    meshed = Meshed(work, train.declaration.gears[0])
    minimum = min(meshed.backlash(t) for t in meshed.positions(4))
    assert 0.1 - 1e-5 <= minimum <= 0.1 + 2 * CHORDS
    assert max(meshed.overlap(t, lag) for t in meshed.positions(5) for lag in (0.0499 / 36, -0.0499 / 36)) <= NOTHING


def declared(form: str, ids: str = "") -> GearTrain:
    return GearTrain.declare(
        yaml.safe_load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: 24}}}}, b: {{wheels: {{w: 36}}}}{ids}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{id: G1, pair: [p, w]}}]
tooth_form: {form}
inputs: {{a: 1}}
""")
    )


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
    train = GearTrain.declare(
        yaml.safe_load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: 24}}}}, b: {{wheels: {{w: 36, q: 20}}}}, c: {{wheels: {{v: 30}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{id: G1, pair: [p, w], tooth_form: {said or "{form: cycloidal}"}}}, {{id: G2, pair: [q, v]}}]
tooth_form: {{form: involute}}
inputs: {{a: 1}}
""")
    )
    work = SolidModel(train, ManufacturingSizes(module=2.0, bore=0.0, **made))
    assert {each.pair: each.length for each in work.blanks.backlashes} == pytest.approx(
        dict(zip(("G1", "G2"), backlashes, strict=True)), abs=1e-9
    )


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
    jammed = workpiece("ferguson-paradox", backlash=0.05)
    text = next(each for each in export_files(jammed, ["svg"]) if each.path == "README.md").make().decode()
    assert re.search(r"^- w101~p20: -0\.3\d+ mm, .*; the pair jams$", text, re.M)


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
    work = SolidModel(GearTrain.declare(yaml.safe_load(IDLER.format(first=PLAIN, second=second))), ManufacturingSizes())
    assert set(work.blanks.wheels) == {"p", "x"}
    told = "wheel 'w' is not cut: its pairs 'one' and 'two' require different teeth"
    assert [each.what for each in notices(work, ["svg"])] == [told]
    assert [(each.rule, each.level, each.problem.what) for each in work.train.build_findings] == [("W3", "note", told)]
    with pytest.raises(GearTrainError, match="'one' and 'two'"):
        wheel_file(work, "w", ".svg")
    scene = make_scene(work.train)
    assert any("'w'" in notice["what"] for notice in scene.notices)


@pytest.mark.parametrize("second", [PLAIN, "{form: involute, addendum: [1, 0.8]}", "{form: involute, dedendum: 1.4}"])
def test_pairs_that_can_share_a_wheel_share_it(second: str) -> None:
    train = GearTrain.declare(yaml.safe_load(IDLER.format(first=PLAIN, second=second)))
    work = SolidModel(train, ManufacturingSizes(bore=0.0))
    assert set(work.blanks.wheels) == {"p", "w", "x"}
    for gear in train.declaration.gears:
        meshed = Meshed(work, gear)
        assert max(meshed.overlap(t) for t in meshed.positions(6)) <= NOTHING


def test_a_wheel_beside_declared_teeth_without_a_form_of_its_own_is_named() -> None:
    text = IDLER.format(first=PLAIN, second="{form: ideal}")
    work = SolidModel(GearTrain.declare(yaml.safe_load(text)), ManufacturingSizes())
    assert set(work.blanks.wheels) == {"p", "w"}
    assert any("the teeth that mesh with 'w' are not declared" in each.what for each in work.blanks.notices)


@pytest.mark.parametrize("name", ["freeth-2021-teeth", "pennestri-2002-teeth", "moon-triangular", "sorge-pairs"])
def test_axes_stand_as_far_apart_as_the_law_of_triangular_teeth_asks(name: str) -> None:
    """Centre distance over tip radius as in the law, for every mate of every wheel: so each wheel has one size."""
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
    data = yaml.safe_load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: {teeth}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w], tooth_form: {form}}}]
inputs: {{a: 1}}
""")
    work = SolidModel(GearTrain.declare(data), ManufacturingSizes())
    assert "w" not in work.blanks.wheels
    assert any("wheel 'w'" in each.what for each in work.blanks.notices)
    drawn = make_scene(work.train).wheels[1]
    assert drawn.tip > drawn.root > 0


def test_shifted_involutes_stand_where_they_run_without_backlash() -> None:
    """The layout used to leave them at the distance of their reference circles, where such teeth jam."""
    train = declared("{form: involute, shift: [0.4, 0.3]}")
    work = SolidModel(train, ManufacturingSizes(bore=0.0, backlash=0.0))
    meshed = Meshed(work, train.declaration.gears[0])
    assert meshed.distance > 30.6
    assert max(meshed.overlap(t) for t in meshed.positions(8)) <= NOTHING
    assert max(meshed.backlash(t) for t in meshed.positions(4)) < CHORDS


def test_a_pinion_that_never_leaves_the_teeth_of_its_ring_is_refused() -> None:
    """82 teeth in 84, a module tall: no tip circle is crossed, and the teeth overlap on the far side."""
    ring = declared("{form: involute}").declaration.model_dump(mode="json", exclude_unset=True)
    ring["links"]["a"]["wheels"]["p"], ring["links"]["b"]["wheels"]["w"] = 82, {"teeth": 84, "internal": True}
    (fault,) = GearTrain.declare(ring).meshes[0].faults
    assert "tips of the ring" in fault.what
