"""Trains as built: each link is one body, supported by the link that carries its axis; hands are on arbors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import pytest
import shipped
from networkx.utils import UnionFind

import geartrain
from geartrain.scene import ManufacturingSizes, Scene, SolidModel, SolidPart, build_scene

RUNS = 0.35  # mm: maximum gap of running and press fits
# links without parts: parallel cranks carry them, or they have no wheels, and fingers and stars have no solids
TOGETHER = {
    "lathe-back-gear": {"countershaft"},
    "nrel-5mw": {"generator", "nacelle", "rotor"},
    "screw-jack": {"base", "ram", "screw"},
    "serpentine-belt": {"alternator", "compressor", "crank", "engine", "pump", "tensioner"},
    "longcase-clock-weight": {"weight"},
    "rv-reducer": {"eccentric"},
    "simple-calendar": {"date", "moon"},
    "count-wheel-striking": {"centre"},
    "film-projector": {"maltese"},
    "elliptical-gears": {"case", "driver", "driven", "oval"},
    "universal-joint-line": {"chassis", "gearbox", "front_shaft", "front_axle", "rear_shaft", "rear_axle"},
}


@dataclass(frozen=True)
class Body:
    """Solid of the library manifold3d, and its bounding box."""

    solid: Any
    low: Any
    high: Any

    @classmethod
    def of(cls, part: SolidPart) -> Body:
        library = pytest.importorskip("manifold3d", reason="the extra proof is not installed")
        placed = part.placed
        mesh = library.Mesh(
            np.ascontiguousarray(placed.vertices, dtype=np.float32), np.ascontiguousarray(placed.faces, dtype=np.uint32)
        )
        solid = library.Manifold(mesh)
        assert solid.status() == library.Error.NoError, part.name
        return cls(solid, placed.vertices.min(0), placed.vertices.max(0))

    def meets(self, other: Body) -> bool:
        """Return True if the gap to another body is at most a running fit."""
        if (np.maximum(self.low, other.low) - np.minimum(self.high, other.high) > RUNS).any():
            return False
        return bool(self.solid.min_gap(other.solid, RUNS) < RUNS)


def groups(bodies: Sequence[Body]) -> list[set[int]]:
    """Return the groups of bodies that are in contact."""
    found = UnionFind(range(len(bodies)))
    for one, other in combinations(range(len(bodies)), 2):
        if found[one] != found[other] and bodies[one].meets(bodies[other]):
            found.union(one, other)
    return list(found.to_sets())


@pytest.mark.parametrize(
    "name",
    shipped.every_train(None, {"freeth-2021", "pennestri-2002-missing", "lantern-mill", "huygens-planetarium-1682"}, 2),
)
def test_every_link_is_one_solid_body_and_is_borne_by_the_one_that_bears_its_axis(name: str) -> None:
    train = shipped.train(name)
    model = SolidModel(train, ManufacturingSizes())
    links = model.scene.bodies
    parts: dict[int, list[Body]] = {}
    for part in model.parts:
        if part.kind != "weight":  # a weight hangs on a line
            parts.setdefault(part.body, []).append(Body.of(part))
    assert {body.id for at, body in enumerate(links) if at not in parts} == TOGETHER.get(name, set())
    for at, own in parts.items():
        assert len(groups(own)) == 1, links[at].id
        # it is borne by the link that carries its axis, or by one about the same axis
        near = [each for each, link in enumerate(links) if each == links[at].parent or link.axis == links[at].axis]
        about = [body for each in near if each != at for body in parts.get(each, [])]
        # the guides of slides are not made
        if links[at].parent is not None and about and links[at].id not in train.declaration.sliding:
            assert any(one.meets(other) for one in own for other in about), f"{links[at].id} floats"


def of_kind(scene: Scene, kind: str) -> list[Any]:
    return [part for part in scene.parts if part.kind == kind]


def test_a_scene_as_built_has_the_parts_that_exports_have_in_the_same_places() -> None:
    train = shipped.train("longcase-clock")
    scene, model = build_scene(train), SolidModel(train, ManufacturingSizes())
    assert [part.name for part in scene.parts] == [part.name for part in model.structure]
    for told, made in zip(scene.parts, model.structure, strict=True):
        assert told.place == pytest.approx(made.place, abs=1e-8)
        assert bool(told.bands) != bool(told.outlines)
    assert [wheel.centre for wheel in scene.wheels] == [wheel.centre for wheel in model.scene.wheels]
    assert len(of_kind(scene, "frame")) == 2
    assert len(of_kind(scene, "dial")) == 1, "all dials of one side stand on one plate"


def test_hands_sit_on_the_ends_of_their_own_arbors_and_the_inner_one_is_the_outermost() -> None:
    scene = build_scene(shipped.train("longcase-clock"))
    minute, hour = (next(each for each in scene.pointers if each.output == name) for name in ("centre", "hour"))
    assert minute.level - hour.level > 1, "the minute hand goes over the hour hand"
    assert 0 < minute.seat < hour.seat, "the hour pipe runs on the centre arbor"
    for pointer in (minute, hour):
        assert pointer.dial is not None
        face = scene.dials[pointer.dial]
        hand = face.centre[2] + face.normal[2] * pointer.level
        rods = [part for part in scene.parts if part.body == pointer.body and part.kind in ("arbor", "pipe")]
        ends = [
            part.place[2] + part.direction[2] * height for part in rods for band in part.bands for height in band[:2]
        ]
        assert min(abs(hand - end) for end in ends) == pytest.approx(0.5, abs=1e-3)


def test_a_train_that_declares_no_axis_on_its_frame_has_no_parts() -> None:
    text = "name: t\nframe: f\nlinks: {f: {}, a: {}}\nrevolutes: [{pair: [f, a], axis: A}]\ninputs: {a: 1}\n"
    assert build_scene(geartrain.load(text)).parts == ()


def area(outline: Sequence[float]) -> float:
    """Return the area of an outline (Gauss's formula)."""
    x, y = np.array(outline[::2]), np.array(outline[1::2])
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


def test_a_disc_on_an_eccentric_has_a_hole_for_it_and_one_for_each_pin() -> None:
    scene = build_scene(shipped.train("cycloidal-reducer"))
    holes = {wheel.id: wheel.holes for wheel in scene.wheels}
    assert holes["ring"] == (), "what its pins fill is not opened"
    (coupling,) = scene.couplings
    eccentric = next(part for part in scene.parts if "eccentric" in part.name and part.outlines)
    bore, *others = sorted(holes["lobes"], key=lambda each: float(np.hypot(*np.reshape(each, (-1, 2)).mean(0))))
    wide = 2 * np.sqrt(area(eccentric.outlines[0]) / np.pi)
    assert 2 * np.sqrt(area(bore) / np.pi) == pytest.approx(wide, abs=0.3), "it runs on the eccentric"
    assert len(others) == len(coupling.holes_at)
    for hole in others:
        assert 2 * np.sqrt(area(hole) / np.pi) == pytest.approx(coupling.hole, abs=0.2)


def test_a_slot_is_cut_where_its_pin_wanders() -> None:
    scene = build_scene(shipped.train("freeth-2008"))
    (coupling,) = scene.couplings
    wheel = next(each for each in scene.wheels if each.id == "k2")
    x = np.cos(wheel.turn) * np.array(wheel.reference)
    x = x + np.sin(wheel.turn) * np.cross(wheel.direction, wheel.reference)
    y = np.cross(wheel.direction, x)
    out = np.subtract(coupling.pin_at, coupling.slot_at)
    out = out - (out @ np.array(wheel.direction)) * np.array(wheel.direction)
    way = np.array([out @ x, out @ y]) / np.linalg.norm(out)
    r, e = coupling.pin_radius, coupling.offset
    slot = max(wheel.holes, key=lambda each: float(np.hypot(*np.reshape(each, (-1, 2)).mean(0))))
    points = np.reshape(slot, (-1, 2))
    along, across = points @ way, points @ np.array([-way[1], way[0]])
    assert along.min() < r - e < r + e < along.max(), "the pin of 9.6 mm goes 1.1 mm in and out"
    assert along.max() - along.min() - 2 * e == pytest.approx(across.max() - across.min(), rel=1e-3)
    assert across.max() == pytest.approx(-across.min(), abs=1e-3)


def test_a_clock_has_its_pendulum_and_its_weight_in_true_size() -> None:
    scene = build_scene(shipped.train("longcase-clock"))
    hangers = {each.kind: each for each in scene.hangers}
    pendulum, line, weight = (hangers[kind] for kind in ("pendulum", "line", "weight"))
    assert scene.bodies[pendulum.body].id == "escape"
    assert pendulum.length == 994
    # one tooth per period of 2 pi sqrt(l/g): the escape wheel turns once per minute
    swing = 2 * np.pi * np.sqrt(0.994 / 9.80665)
    assert pendulum.rate * swing == pytest.approx(60, abs=0.02)
    great = scene.bodies[weight.body]
    assert great.id == "great"
    turned = -2 * np.pi * 16 * great.sense  # 16 turns of line, in reverse
    assert weight.rate * turned == pytest.approx(1277, abs=1), "as its declaration says, 1.28 m"
    # the line leaves the barrel on the side whose rim moves down
    arm = np.subtract(line.point, great.point)
    arm = arm - arm @ np.array(great.direction) * np.array(great.direction)
    # the line on two falls runs twice as far as the weight
    assert np.cross(np.array(great.direction) * turned, arm) @ np.array(line.down) == pytest.approx(2 * 1277, abs=2)
    assert np.pi * weight.wide**2 * 4 * weight.wide * 11.34e-6 == pytest.approx(5.9), "mass of lead in kg"
    zero = next(face.zero for face in scene.dials)
    assert pendulum.down == pytest.approx([-each for each in zero])
    behind = next(face for face in scene.dials)
    plates = [part for part in scene.parts if part.kind == "frame"]
    back = max(-np.dot(np.subtract(part.place, behind.centre), behind.normal) + part.height / 2 for part in plates)
    bob = -np.dot(np.subtract(pendulum.point, behind.centre), behind.normal) - 0.25 * pendulum.wide
    assert bob > back, "behind both plates"
    parts = {part.name: part for part in scene.parts}
    cock = parts["pendulum cock"]
    low, high = cock.bands[0][0], cock.bands[-1][1]
    at = np.subtract(pendulum.point, cock.place) @ np.array(cock.direction)
    assert low < at < high, "it hangs on its cock"
    assert np.subtract(pendulum.point, cock.place) - at * np.array(cock.direction) == pytest.approx([0, 0, 0], abs=1e-6)
    barrel = parts["great barrel"]
    assert (barrel.bands[0][2], barrel.body) == (25.4, weight.body)
    assert "collet of g96" not in parts, "the barrel is fixed to its wheel"
    assert build_scene(shipped.train("watch-going-train")).hangers == ()


def test_the_cage_of_a_ball_does_not_go_round_through_plates_of_the_frame() -> None:
    """The Moon's wheel is behind both plates, and the pinion of its phase is in front of them."""
    scene = build_scene(shipped.train("freeth-2021"))
    (post,) = (part for part in scene.parts if part.name == "ph1 cage post")
    assert {round(part.direction[2]) for part in (post, *of_kind(scene, "frame"))} == {1}
    low, high = (post.place[2] + end for end in (post.bands[0][0], post.bands[-1][1]))
    for plate in of_kind(scene, "frame"):
        assert high < plate.place[2] - plate.height / 2 or plate.place[2] + plate.height / 2 < low


def test_a_bracket_stands_on_the_side_of_its_wheels_where_no_other_is_in_its_way() -> None:
    """The wallower of a mill is in front of its pit wheel, on the side of all other axes."""
    scene = build_scene(shipped.train("lantern-mill"))
    wheels = {wheel.id: wheel for wheel in scene.wheels}
    (bracket,) = (part for part in scene.parts if part.name.startswith("water bracket"))
    pit, wallower = wheels["pit72"].centre[0], wheels["wallower18"].centre[0]
    assert wallower < pit < bracket.place[0]


def test_hands_pass_over_a_dial_that_turns_on_a_pipe_among_them() -> None:
    """The ecliptic of the Orloj was in front of the hands of Sun and Moon."""
    scene = shipped.built("prague-orloj")
    hours, ecliptic = scene.dials
    borne = np.dot(np.subtract(ecliptic.centre, hours.centre), hours.normal)
    height = {
        (each.output, each.dial): each.level + (borne if each.dial else 0)
        for each in scene.pointers
        if each.dial is not None
    }
    assert 1 < borne == pytest.approx(height["zodiac", 0])
    assert height["sun", 0] - borne > 1
    assert height["sun in zodiac", 1] == pytest.approx(height["sun", 0])  # each is the same hand
    assert height["sidereal month", 1] == pytest.approx(height["moon", 0])
    assert height["moon", 0] > height["sun", 0]


@pytest.mark.parametrize("name", ["al-biruni-box-of-the-moon", "byzantine-sundial-calendar"])
def test_a_dial_that_names_no_side_stands_on_feet_before_the_reader(name: str) -> None:
    """Its arbors did not extend to it, so that the dial had no support."""
    scene = shipped.built(name)
    assert all(face.plate > face.radius > 0 for face in scene.dials)
    assert all(each.seat > 0 and each.level > 0 for each in scene.pointers if each.dial is not None)
    assert sum(part.kind == "foot" for part in scene.parts) >= 3


@pytest.mark.parametrize("name", ["voulgaris-2022", "voulgaris-2024-a"])
def test_a_dial_on_the_side_lies_on_the_bracket_of_its_arbor_beside_that_of_the_crank(name: str) -> None:
    """The dial had no support, and the turning crank passed through it."""
    scene = shipped.built(name)
    (at,) = (n for n, face in enumerate(scene.dials) if face.id == "draconic")
    face, (hand,) = scene.dials[at], (each for each in scene.pointers if each.dial == at)
    own = scene.bodies[hand.body].id
    (bracket,) = (part for part in scene.parts if part.name == f"{own} bracket")
    (arbor,) = (part for part in scene.parts if part.name == f"{own} arbor")
    x, side = np.array(face.centre), np.array(face.normal)
    assert 0 < (x - bracket.place) @ side - bracket.height / 2 < 0.5
    assert 0 < (x + hand.level * side - arbor.place) @ side - arbor.bands[-1][1] < 1
    assert hand.seat == pytest.approx(2 * arbor.bands[-1][2])
    beside = [part for part in scene.parts if part.kind == "arbor" and abs(np.dot(part.direction, side)) > 0.99]
    for part in beside:
        off = np.cross(np.subtract(part.place, x), side)
        assert part is arbor or np.hypot.reduce(off) - part.bands[0][2] > 1.075 * face.radius > 10


@pytest.mark.parametrize("way", ["[0, 0, 1]", "[1, 0, 0]"])
@pytest.mark.parametrize("side", ["front", "back"])
def test_dials_stand_on_plates_whichever_way_all_axes_look(way: str, side: str) -> None:
    """Dials of a train with axes perpendicular to the view had no support."""
    scene = build_scene(
        geartrain.load(f"""
frame: f
links: {{f: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: 60}}}}}}
axes: {{A: {{direction: {way}, position: [0, 0, 0]}}, B: {{direction: {way}, position: [0, 40 mm, 0]}}}}
revolutes: {{A: [f, a], B: [f, b]}}
gears: [p ~ w]
inputs: {{a: 1}}
dials: {{d: {{face: {side}, divisions: 12}}}}
outputs: {{b: {{dial: d}}}}
""")
    )
    (face,), (hand,) = scene.dials, scene.pointers
    assert face.plate > face.radius > 0
    assert hand.seat > 0


def test_a_dial_on_the_side_is_laid_once_however_many_hands_it_has() -> None:
    """Each additional hand had reduced the dial."""
    more = "extends: voulgaris-2022\nname: more\noutputs: {one: {of: %s, dial: draconic}}\n"
    (own,) = (
        output.of or name
        for name, output in shipped.train("voulgaris-2022").declaration.outputs.items()
        if output.dial == "draconic"
    )
    scenes = shipped.built("voulgaris-2022"), build_scene(geartrain.load(more % own))
    once, twice = (next(face.radius for face in scene.dials if face.id == "draconic") for scene in scenes)
    assert once == twice
    hands = [each for each in scenes[1].pointers if scenes[1].dials[each.dial or 0].id == "draconic"]
    assert len({each.seat for each in hands}) == 1 < len(hands)


@pytest.mark.parametrize("name", ["zf-8hp70", "ford-10r80", "planetary-24-18-60"])
def test_supports_of_rings_are_as_wide_as_their_rims(name: str) -> None:
    """Six pins of 0.6 mm held a ring at its disc."""
    scene = shipped.built(name)
    rings = [wheel for wheel in scene.wheels if wheel.kind == "ring"]
    assert rings
    for ring in rings:
        held = [part for part in scene.parts if part.name.startswith((f"{ring.id} drum", f"{ring.id} post"))]
        turning = scene.bodies[ring.body].parent is not None
        assert [part.kind for part in held] == (["drum"] if turning else ["post"] * 3)
        for part in held:
            rim = 2 * max(ring.module, 0.0)
            low, high, radius, bore = max(part.bands, key=lambda band: band[2])
            assert radius - bore >= 0.9 * rim if turning else 2 * radius >= 0.9 * rim
            # it reaches from a face of the ring to a plate of the same body
            face = ring.centre[2] + np.array([-0.5, 0.5]) * ring.thickness
            assert min(abs(face - part.place[2] - low)) < 1e-6 or min(abs(face - part.place[2] - high)) < 1e-6
            plates = [each for each in scene.parts if each.body == ring.body and each.outlines]
            ends = [each.place[2] + side * each.height / 2 - part.place[2] for each in plates for side in (-1, 1)]
            assert min(abs(end - other) for end in ends for other in (low, high)) < 1e-6


def test_plates_of_a_clock_are_rectangles_and_other_plates_are_not() -> None:
    def fill(name: str) -> float:
        edge = of_kind(shipped.built(name), "frame")[0].outlines[0]
        return area(edge) / float(np.prod(np.ptp(np.reshape(edge, (-1, 2)), axis=0)))

    assert fill("longcase-clock") > 0.98
    assert fill("four-gear-loop") < 0.9
