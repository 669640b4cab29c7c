"""Solids, read back by other libraries than those that write them: STL, animated GLB, STEP."""

from __future__ import annotations

import json
import struct
from fractions import Fraction
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import LOCKED
from hypothesis import example, given, settings
from hypothesis import strategies as st
from places import TRAINS
from shipped import train as load
from workpieces import workpiece

import geartrain
from geartrain import GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.scene.solids.triangle_solids import approximation_solid, fill
from geartrain.workshop import train_file, wheel_file

shapely = pytest.importorskip("shapely")


def volume(solid: Any) -> float:
    """Within a closed surface: tetrahedra from the origin, by the divergence theorem."""
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum()) / 6


def inline(text: str, **making: float) -> SolidModel:
    return SolidModel(geartrain.load(text), ManufacturingSizes(**making))


# ----------------------------------------------------------------------------------------------------------- triangles


MIDDLES = [(-1.6, 0), (1.6, 0), (0, 1.6), (0, -1.6), (0, 0)]


@settings(max_examples=25)
@given(st.lists(st.floats(6, 12), min_size=3, max_size=24), st.lists(st.sampled_from(MIDDLES), unique=True))
@example([6.0, 6.0, 6.0], [(0, 1.6), (0, -1.6), (-1.6, 0), (0, 0)])  # holes one above the other
def test_triangles_fill_a_polygon_with_holes_and_nothing_else(
    radii: list[float], centres: list[tuple[float, float]]
) -> None:
    """A star-shaped outline with holes in its middle: the area is shapely's, no triangle lies beyond it."""
    turn = 2 * pi * np.arange(len(radii)) / len(radii)
    outer = np.array(radii)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    ring = 0.7 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    holes = [ring + np.array(centre) for centre in centres]
    points, triangles = fill(outer, holes)
    true = shapely.Polygon(outer, holes)
    parts = [shapely.Polygon(points[each]) for each in triangles]
    assert true.is_valid
    assert sum(part.area for part in parts) == pytest.approx(true.area, rel=1e-9)
    assert shapely.union_all(parts).symmetric_difference(true).area < 1e-9 * true.area


# ----------------------------------------------------------------------------------------------------------------- STL


def stl(data: bytes, folder: Path):  # type: ignore[no-untyped-def]
    mesh = pytest.importorskip("stl.mesh")
    path = folder / "part.stl"
    path.write_bytes(data)
    return mesh.Mesh.from_file(str(path))


@pytest.mark.parametrize(
    ("train", "wheel"),
    [("planetary-24-18-60", "s"), ("planetary-24-18-60", "ring"), ("moon-triangular", None), ("lantern-mill", "nut15")],
)
def test_a_wheel_as_stl_is_watertight_and_its_volume_is_its_area_times_its_thickness(
    train: str, wheel: str | None, tmp_path: Path
) -> None:
    work = workpiece(train, thickness=3)
    name = wheel or next(iter(work.blanks.wheels))
    read = stl(wheel_file(work, name, ".stl"), tmp_path)
    edges: dict[tuple[bytes, bytes], int] = {}
    for triangle in read.vectors:
        corners = [corner.tobytes() for corner in triangle]
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
            edges[a, b] = edges.get((a, b), 0) + 1
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges), "every edge is met once from either side"
    outer, *holes = (contour.flattened(1e-4) for contour in work.blanks.wheels[name].contours)
    area = shapely.Polygon(outer, holes).area
    volume = read.get_mass_properties()[0]
    assert float(volume) == pytest.approx(3 * area, rel=4e-3), "but for chords of 0.02 mm"
    assert np.ptp(read.z) == pytest.approx(3)


def test_every_part_of_an_assembly_is_closed_and_looks_outwards() -> None:
    trimesh = pytest.importorskip("trimesh")
    states = {"worm": None, "bevel-differential": "straight", "lantern-mill": None, "planetary": "ring fixed"}
    for name, state in states.items():
        for part in workpiece(name, state).parts:
            mesh = trimesh.Trimesh(part.placed.vertices, part.placed.faces, process=False)
            assert mesh.is_watertight, (name, part.name)
            assert mesh.is_winding_consistent, (name, part.name)
            assert mesh.volume > 0, (name, part.name)


def test_pins_stand_in_their_slots() -> None:
    """A pin at 9.6 mm about an axis 1.1 mm off, in 'k1', goes through the slot that is cut into 'k2'."""
    work = workpiece("freeth-2008")
    parts = {part.name: part for part in work.parts}
    bodies = [body.id for body in work.scene.bodies]
    pin, held, slotted = parts["anomaly pin"], parts["k1"], parts["k2"]
    assert bodies[pin.body] == "k1"
    k1, k2 = (np.array(work.layout.axes[label].point[:2]) for label in ("K1", "K2"))
    middle = pin.placed.vertices[:, :2].mean(axis=0)
    assert np.hypot(*(middle - k1)) == pytest.approx(9.6, abs=1e-6)
    assert 8.5 - 1e-6 <= np.hypot(*(middle - k2)) <= 10.7 + 1e-6
    for wheel, backlash in ((held, 0.0), (slotted, 0.05)):
        own = (pin.placed.vertices - wheel.place) @ wheel.turn  # the pin as the wheel sees it
        assert own[:, 2].min() <= -wheel.height / 2 + 1e-9, "it goes through"
        assert own[:, 2].max() >= wheel.height / 2 - 1e-9
        edge, *holes = (shapely.Polygon(contour.flattened(1e-3)) for contour in wheel.contours)
        rod = shapely.MultiPoint(own[:, :2]).convex_hull
        (hole,) = [each for each in holes if each.contains(rod.centroid)]
        assert edge.contains(hole)
        assert hole.buffer(1e-2 - backlash).contains(rod), "clear of the sides of a slot"


def test_pins_in_bars_where_wheels_are_too_small() -> None:
    """The follower of a planet's epicycle: a bar with a slot beyond all wheels of its link."""
    work = workpiece("freeth-jones-2012")
    parts = {part.name: part for part in work.parts}
    pin, slot = parts["venus pin"], parts["venus slot"]
    own = (pin.placed.vertices - slot.place) @ slot.turn
    bar, hole = (shapely.Polygon(contour.flattened(0.01)) for contour in slot.contours)
    assert own[:, 2].min() < 0 < own[:, 2].max(), "it goes through"
    assert bar.contains(hole)
    assert hole.contains(shapely.MultiPoint(own[:, :2]).convex_hull)


@pytest.mark.parametrize("name", ["bevel-differential", "humpage"])
def test_likenesses_narrow_to_where_their_axes_meet(name: str) -> None:
    """The teeth of a bevel wheel run from tips at the wide end straight towards the point that both axes share."""
    scene = workpiece(name, "straight" if name == "bevel-differential" else None).scene
    for at, mate in [way for pair in scene.pairs for way in (pair.wheels, pair.wheels[::-1])]:
        one, other = scene.wheels[at], scene.wheels[mate]
        n = np.cross(one.direction, other.direction)
        gap = np.array(other.centre) - np.array(one.centre)
        along = float(np.cross(gap, other.direction) @ n / (n @ n))
        assert abs(gap @ n) < 1e-6, "the axes meet"
        solid = approximation_solid(one, scene.profiles[one.profile], 2.0)
        apex = np.array([0.0, 0.0, along])
        far = solid.vertices - apex
        ways, sizes = far / np.linalg.norm(far, axis=1)[:, None], np.linalg.norm(far, axis=1)
        out = np.hypot(*solid.vertices[:, :2].T)
        tip = int(np.argmax(out))
        lengths = sizes[ways @ ways[tip] > 1 - 1e-9] / sizes[tip]
        assert lengths.min() < 0.98
        assert lengths.max() < 1 + 1e-9
        assert one.span == pytest.approx((solid.vertices[:, 2].min(), solid.vertices[:, 2].max()), abs=1e-9)
        edges = np.sort(
            np.concatenate([solid.faces[:, [0, 1]], solid.faces[:, [1, 2]], solid.faces[:, [2, 0]]]), axis=1
        )
        assert set(np.unique(edges, axis=0, return_counts=True)[1].tolist()) == {2}, "it is closed"


@pytest.mark.parametrize("hand", ["right", "left"])
def test_the_thread_of_a_worm_winds_as_its_hand_says_one_axial_pitch_a_start(hand: str) -> None:
    """Along its axis by a quarter of its lead, starts times pi times the axial module, a crest is a quarter turn on."""
    text = (TRAINS / "engineering" / "worm.yaml").read_text(encoding="utf-8").replace("hand: right", f"hand: {hand}")
    scene = inline(text.partition("inputs:")[0]).scene
    worm, wheel = scene.wheels
    points = approximation_solid(worm, scene.profiles[worm.profile]).vertices
    lead = 2 * pi * (2 * wheel.radius / 60)  # two starts, and sixty teeth on the pitch circle of the wheel
    r, angle = np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0])
    crest = r > 0.999 * r.max()

    def middle(height: float) -> complex:
        here = crest & (abs(points[:, 2] - height) < 1e-6)
        return complex(np.exp(2j * angle[here]).mean())  # both threads fall on each other

    heights = np.unique(np.round(points[:, 2], 9))
    one, other = heights[3], heights[17]
    turned = np.angle(middle(other) / middle(one)) / 2
    wanted = (1 if hand == "right" else -1) * 2 * pi * (other - one) / lead
    assert np.exp(2j * turned) == pytest.approx(np.exp(2j * wanted), abs=1e-6)


# ----------------------------------------------------------------------------------------------------------------- GLB


COMPONENTS = {5120: "<i1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
STEPS = 65534  # along the largest extent of a part


class Glb:
    """The chunks of a binary glTF file, by its specification: a header, JSON, bytes."""

    def __init__(self, data: bytes) -> None:
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.json = json.loads(data[20 : 20 + size])
        _, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0"
        self.bytes = data[28 + size :]
        self.nodes = {node["name"]: at for at, node in reversed(list(enumerate(self.json["nodes"])))}

    def values(self, accessor: int) -> np.ndarray:
        """Elements of an accessor as floats, those that are normalised as the specification has them."""
        found = self.json["accessors"][accessor]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[found["type"]]
        kind = np.dtype(COMPONENTS[found["componentType"]])
        view = self.json["bufferViews"][found["bufferView"]]
        start, stride = view["byteOffset"] + found["byteOffset"], view.get("byteStride", width * kind.itemsize)
        raw = np.ndarray((found["count"], width), kind, self.bytes, start, (stride, kind.itemsize)).astype(float)
        return np.maximum(raw / np.iinfo(kind).max, -1) if found.get("normalized") else raw

    def mesh(self, node: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Positions and normals of a node's vertices, in its own coordinates, and its triangles (m, 3)."""
        (primitive,) = self.json["meshes"][self.json["nodes"][node]["mesh"]]["primitives"]
        position, normal = primitive["attributes"]["POSITION"], primitive["attributes"]["NORMAL"]
        indices = self.values(primitive["indices"]).astype(int).reshape(-1, 3)
        return self.values(position), self.values(normal), indices

    def matrix(self, node: int) -> np.ndarray:
        return np.array(self.json["nodes"][node]["matrix"]).reshape(4, 4).T

    def channels(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Moments and quaternions by the name of the node they turn."""
        (animation,) = self.json["animations"]
        found = {}
        for channel in animation["channels"]:
            assert channel["target"]["path"] == "rotation"
            sampler = animation["samplers"][channel["sampler"]]
            name = self.json["nodes"][channel["target"]["node"]]["name"]
            found[name] = self.values(sampler["input"])[:, 0], self.values(sampler["output"])
        return found


def turned(quaternions: np.ndarray) -> np.ndarray:
    """Angle about z (rad) along the shorter way from key to key."""
    angle = 2 * np.arctan2(quaternions[:, 2], quaternions[:, 3])
    return np.unwrap(angle)


@pytest.mark.parametrize("internal", ["", ", internal: true"])
def test_a_wheel_of_more_teeth_than_are_cut_is_its_pitch_circle(internal: str) -> None:
    teeth = 10**6
    work = inline(f"""
        links: {{frame: {{}}, a: {{wheels: {{p: {{teeth: {teeth}{internal}}}}}}}, b: {{wheels: {{w: 60}}}}}}
        revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
        gears: [{{pair: [p, w]}}]
        inputs: {{a: 1}}
    """)
    part = next(part for part in work.parts if part.name == "p")
    wheel = next(wheel for wheel in work.scene.wheels if wheel.id == "p")
    assert len(part.solid.vertices) < 10**5
    across = np.hypot(*part.solid.vertices[:, :2].T)
    assert float(abs(across - wheel.radius).min()) < 1e-9 * wheel.radius


@pytest.mark.parametrize(("train", "state"), [("three-planets", None), ("humpage", None), ("worm", None)])
def test_a_glb_shows_the_solids_within_half_a_step_of_quantisation(train: str, state: str | None) -> None:
    """A step is the largest extent of a part over 65534; its node turns and moves it to its place on its body."""
    work = workpiece(train, state)
    glb = Glb(train_file(work, "glb"))
    for part in work.parts:
        node = glb.nodes[part.name]
        step = float(np.ptp(part.solid.vertices, axis=0).max()) / STEPS
        matrix = glb.matrix(node)
        assert matrix[:3, :3] == pytest.approx(step * part.turn, rel=1e-12)
        positions, normals, triangles = glb.mesh(node)
        body = work.scene.bodies[part.body]
        assert node in glb.json["nodes"][glb.nodes[body.id]]["children"]
        shown = positions @ matrix[:3, :3].T + matrix[:3, 3] + np.array(body.point)
        exact = part.placed.vertices[part.placed.faces]
        away = (shown[triangles] - exact) @ part.turn
        assert np.abs(away).max() <= step / 2 * (1 + 1e-6)
        assert np.abs(positions).max() == 32767
        a, b, c = (exact[:, k] for k in range(3))
        across = np.cross(b - a, c - a)
        length = np.linalg.norm(across, axis=1)
        clear = length > 1e-9  # mm2: a thinner triangle has no direction
        true = (across[clear] / length[clear, None]) @ part.turn
        assert np.abs(normals[triangles][clear] - true[:, None]).max() < 0.5 / 127 + 1e-6
        assert len(np.unique(np.hstack([positions, normals]), axis=0)) == len(positions), "no vertex is there twice"


@pytest.mark.parametrize("train", ["three-planets", "freeth-2008"])
def test_a_glb_keeps_the_rules_of_glTF_for_accessors(train: str) -> None:
    """Alignment to 4 bytes, ends that are those of the values, indices in range: glTF 2.0, sections 3.6.2 and 3.7.2."""
    glb = Glb(train_file(workpiece(train), "glb"))
    content, size = glb.json, len(glb.bytes)
    assert content["buffers"] == [{"byteLength": size}]
    assert content["extensionsRequired"] == content["extensionsUsed"] == ["KHR_mesh_quantization"]
    ends = [(view["byteOffset"], view["byteOffset"] + view["byteLength"]) for view in content["bufferViews"]]
    assert [low for low, _ in ends] == [0, *(high for _, high in ends[:-1])]
    assert ends[-1][1] == size
    vertices, indices, keys = content["bufferViews"]
    assert (vertices["target"], vertices["byteStride"] % 4, indices["target"]) == (34962, 0, 34963)
    assert not {"target", "byteStride"} & (indices.keys() - {"target"} | keys.keys())
    for at, each in enumerate(content["accessors"]):
        view = content["bufferViews"][each["bufferView"]]
        assert (view["byteOffset"] + each["byteOffset"]) % 4 == 0
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[each["type"]] * np.dtype(COMPONENTS[each["componentType"]]).itemsize
        stride = view.get("byteStride", width)
        assert each["byteOffset"] + stride * (each["count"] - 1) + width <= view["byteLength"]
        if "min" in each:
            values = glb.values(at)
            assert (values.min(axis=0).tolist(), values.max(axis=0).tolist()) == (each["min"], each["max"])
    for mesh in content["meshes"]:
        (primitive,) = mesh["primitives"]
        position, normal = (content["accessors"][primitive["attributes"][name]] for name in ("POSITION", "NORMAL"))
        assert (position["componentType"], position.get("normalized"), normal["componentType"]) == (5122, None, 5120)
        assert normal["normalized"] is True
        assert {"min", "max"} <= position.keys()
        used = glb.values(primitive["indices"])
        assert (used.min(), used.max()) == (0, position["count"] - 1), "every vertex is used, and no other one"
        assert position["count"] == normal["count"] <= 65535, "the largest index of 16 bits restarts a primitive"
    for sampler in content["animations"][0]["samplers"]:
        clock = content["accessors"][sampler["input"]]
        assert clock["min"][0] == 0
        assert clock["count"] == content["accessors"][sampler["output"]]["count"]
    assert all(node["children"] for node in content["nodes"] if "children" in node), "no list is empty"


def test_equal_parts_share_one_mesh_and_equal_shapes_their_vertices() -> None:
    glb = Glb(train_file(workpiece("three-planets"), "glb"))
    meshes = {name: glb.json["nodes"][at].get("mesh") for name, at in glb.nodes.items()}
    for names in (["p1", "p2", "p3"], [f"pillar {k}" for k in (1, 2, 3, 4)], ["one stud", "two stud", "three stud"]):
        assert len({meshes[name] for name in names}) == 1, names
    assert len({meshes[name] for name in ("s30", "r78", "p1", "one stud", "pillar 1")}) == 5


def test_wheels_of_equal_shape_and_different_status_share_vertices_but_no_mesh() -> None:
    work = inline("""
        links: {frame: {}, a: {wheels: {p: {teeth: 20, status: surviving}}},
          b: {wheels: {w: 30}}, c: {wheels: {q: {teeth: 20, status: hypothetical}}}}
        revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
        gears: [p ~ w, w ~ q]
        inputs: {a: 1}
    """)
    glb = Glb(train_file(work, "glb"))
    found = [glb.json["meshes"][glb.json["nodes"][glb.nodes[name]]["mesh"]] for name in ("p", "q")]
    (one,), (other,) = (mesh["primitives"] for mesh in found)
    assert one["attributes"] == other["attributes"]
    assert one["indices"] == other["indices"]
    names = [glb.json["materials"][each["material"]]["name"] for each in (one, other)]
    assert names == ["surviving", "hypothetical"]


def test_a_glb_takes_at_most_26_bytes_for_a_triangle_of_a_wheel() -> None:
    """Separate corners with floats needed 72. The rest is key frames, and 600 bytes of JSON for each part."""
    work = workpiece("three-planets")
    data = train_file(work, "glb")
    glb = Glb(data)
    for wheel in work.scene.wheels:
        positions, _, triangles = glb.mesh(glb.nodes[wheel.id])
        assert 12 * len(positions) + 2 * triangles.size <= 26 * len(triangles)
    vertices, indices, keys = (view["byteLength"] for view in glb.json["bufferViews"])
    shown = sum(len(glb.mesh(glb.nodes[mesh["name"]])[2]) for mesh in glb.json["meshes"])
    assert vertices + indices <= 26 * shown
    assert len(data) <= vertices + indices + keys + 600 * len(work.parts)


def test_key_frames_are_the_exact_angles_of_a_planetary_and_close() -> None:
    """Willis by hand: ring of 60 held, sun of 24 turned: the carrier 2/7, the planet of 18 over the carrier -20/21."""
    work = workpiece("planetary-24-18-60")
    glb = Glb(train_file(work, "glb"))
    channels = glb.channels()
    assert set(channels) == {"sun", "carrier", "planet"}
    relative = {"sun": Fraction(1), "carrier": Fraction(2, 7), "planet": Fraction(-24, 18) * (1 - Fraction(2, 7))}
    turns = 21  # the minimum number after which all three are in their initial positions
    for name, (moments, quaternions) in channels.items():
        angle = turned(quaternions)
        share = np.arange(len(moments)) / (len(moments) - 1)
        assert np.allclose(moments / moments[-1], share, atol=1e-6)
        assert np.abs(angle - angle[0] - 2 * pi * float(relative[name]) * turns * share).max() < 1e-4
        assert np.abs(np.abs(quaternions[0] @ quaternions[-1]) - 1) < 1e-6, "it loops"
        assert np.allclose(np.linalg.norm(quaternions, axis=1), 1, atol=1e-6)
        assert (np.abs(np.diff(angle)) < pi).all(), "no step takes the longer way"
    nodes = glb.json["nodes"]
    assert glb.nodes["planet"] in nodes[glb.nodes["carrier"]]["children"], "the planet rides on the carrier"


def test_key_frames_of_real_teeth_follow_the_motion() -> None:
    """At key frames the driven wheel of triangular teeth has the angle of the motion, not its mean angle."""
    work = workpiece("moon-triangular")
    turns = Fraction(1, 2)
    channels = Glb(train_file(work, "glb", turns)).channels()
    train = work.train
    links = tuple(train.declaration.links)
    motion = train.motion(None, links)
    worst = 0.0
    for link, (moments, quaternions) in channels.items():
        at = links.index(link)
        if train.kinematics.tree.parent[link][0] != train.declaration.frame:
            continue
        error = motion.at(float(turns) * moments / moments[-1]).error[at]
        body = work.scene.bodies[at]
        mean = 2 * pi * float(Fraction(body.speed or 0) * turns) * moments / moments[-1]
        away = turned(quaternions) - body.sense * body.direction[2] * (body.start + mean + error)
        assert np.abs((away + pi) % (2 * pi) - pi).max() < 1e-5
        worst = max(worst, float(np.ptp(error)))
    assert worst > 1e-3, "teeth that show"


def test_a_train_that_cannot_turn_has_no_animation_and_more_turns_than_key_frames_are_refused() -> None:
    glb = Glb(train_file(inline(LOCKED), "glb"))
    assert not glb.json.get("animations")
    assert glb.json["meshes"]
    for turns in (Fraction(0), Fraction(-1), Fraction(10**9)):
        with pytest.raises(GearTrainError, match="cannot be animated"):
            train_file(workpiece("planetary-24-18-60"), "glb", turns)


def test_the_same_train_is_the_same_file() -> None:
    works = [SolidModel(load("planetary-24-18-60"), ManufacturingSizes()) for _ in range(2)]
    for make in (lambda work: train_file(work, "glb"), lambda work: wheel_file(work, "s", ".dxf")):
        first, second = map(make, works)
        assert first == second


# ---------------------------------------------------------------------------------------------------------------- STEP


PAIR = """
links: {frame: {}, a: {wheels: {p: 11}}, b: {wheels: {w: 17}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
inputs: {a: 1}
"""


@pytest.fixture(scope="module")
def pair() -> tuple[SolidModel, bytes]:
    """Eleven and seventeen teeth, and their STEP file."""
    pytest.importorskip("OCP")
    work = inline(PAIR, thickness=2, bore=4)
    return work, train_file(work, "step")


def test_step_read_back_has_every_part_by_name_and_its_volume(pair: tuple[SolidModel, bytes], tmp_path: Path) -> None:
    cascadio = pytest.importorskip("cascadio")
    trimesh = pytest.importorskip("trimesh")
    work, data = pair
    path, mesh = tmp_path / "pair.step", tmp_path / "pair.glb"
    path.write_bytes(data)
    cascadio.step_to_glb(str(path), str(mesh), tol_linear=0.005, tol_angular=0.1)
    scene = trimesh.load(mesh)
    text = path.read_text(encoding="latin-1")
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    for part in work.parts:
        assert f"'{part.name}'" in text, "named"
    flat = scene.to_mesh()
    true = sum(volume(part.solid) for part in work.parts)
    assert abs(flat.volume) * 1e9 == pytest.approx(true, rel=1e-2), "metres to millimetres"
    low = np.min([part.placed.vertices.min(axis=0) for part in work.parts], axis=0)
    high = np.max([part.placed.vertices.max(axis=0) for part in work.parts], axis=0)
    assert sorted((flat.extents * 1000).round(1)) == pytest.approx(sorted((high - low).round(1)), abs=0.2)


def test_step_keeps_arcs_and_parses_as_part_21(pair: tuple[SolidModel, bytes], tmp_path: Path) -> None:
    p21 = pytest.importorskip("steputils.p21")
    work, data = pair
    path = tmp_path / "pair.step"
    path.write_bytes(data)
    kinds: dict[str, int] = {}
    for section in p21.readfile(str(path)).data:
        for instance in section.instances.values():
            if hasattr(instance, "entity"):
                kinds[instance.entity.name] = kinds.get(instance.entity.name, 0) + 1
    assert len(work.parts) == 10
    assert kinds["MANIFOLD_SOLID_BREP"] == 5, "two wheels; of two arbors, two plates and four pillars one of each"
    # of a tooth at least the land at its tip, the ground at its root and two fillets between are arcs
    assert kinds["CIRCLE"] > 4 * (11 + 17)
    assert kinds["CYLINDRICAL_SURFACE"] > 2 * (11 + 17)
