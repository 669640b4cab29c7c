"""Flat parts, graphs and tables, read back by other libraries than those that write them."""

from __future__ import annotations

import csv
import io
import json
import re
from fractions import Fraction
from math import atan2, hypot, pi, radians

import networkx as nx
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from shipped import train as load
from workpieces import outlines
from workpieces import workpiece as shipped_work

import geartrain
from geartrain import GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files, notices, train_file, wheel_file
from geartrain.workshop.export.cut_sheets import file_names

shapely = pytest.importorskip("shapely")

PAIR = """
name: pair
links: {{frame: {{}}, a: {{wheels: {{p: {z1}}}}}, b: {{wheels: {{w: {z2}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]}}]
tooth_form: {form}
inputs: {{a: 1}}
outputs: {{b: }}
"""
INVOLUTE = "{form: involute, backlash: 0.05}"
TRIANGULAR = "{form: triangular, half_angle: 30 deg, clearance_factor: 1.02}"


def workpiece(z1: int = 24, z2: int = 36, form: str = INVOLUTE, **making: float) -> SolidModel:
    return SolidModel(geartrain.load(PAIR.format(z1=z1, z2=z2, form=form)), ManufacturingSizes(**making))


# ---------------------------------------------------------------------------------------------------- reading back


def from_svg(data: bytes) -> list[np.ndarray]:
    """Closed lines of a drawing to cut, at scale 1:1, without the point that closes them."""
    text = data.decode()
    width, shown = re.search(r'width="([\d.]+)mm".* viewBox="\S+ \S+ ([\d.]+) ', text).groups()  # type: ignore[union-attr]
    assert width == shown
    return [np.array(line[:-1]) for line in outlines(text)]


def from_dxf(data: bytes) -> dict[str, list[np.ndarray]]:
    """Polygons by layer, from dxfgrabber, arcs of polylines unrolled here."""
    dxfgrabber = pytest.importorskip("dxfgrabber")
    document = dxfgrabber.read(io.StringIO(data.decode()))
    assert document.header["$INSUNITS"] == 4, "millimetres"
    found: dict[str, list[np.ndarray]] = {}
    for entity in document.modelspace():
        if entity.dxftype == "CIRCLE":
            turn = np.linspace(0, 2 * pi, 256, endpoint=False)
            x, y = entity.center[:2]
            ring = np.stack([x + entity.radius * np.cos(turn), y + entity.radius * np.sin(turn)], axis=1)
            found.setdefault(entity.layer, []).append(ring)
        elif entity.dxftype == "LWPOLYLINE":
            assert entity.is_closed
            found.setdefault(entity.layer, []).append(unrolled([p[:2] for p in entity.points], entity.bulge))
        else:
            found.setdefault(entity.layer, [])
    return found


def unrolled(points: list[tuple[float, float]], bulges: list[float]) -> np.ndarray:
    """A bulge b is an arc whose height is b times half its chord, to the right of it where b is positive."""
    out: list[complex] = []
    ring = [complex(*p) for p in points]
    for start, end, bulge in zip(ring, [*ring[1:], ring[0]], bulges, strict=True):
        out.append(start)
        if bulge:
            sweep = 4 * np.arctan(bulge)
            centre = start + (end - start) / 2 * (1 + 1j / np.tan(sweep / 2))
            out += [centre + (start - centre) * np.exp(1j * sweep * k / 64) for k in range(1, 64)]
    return np.array([(z.real, z.imag) for z in out])


def polygon(rings: list[np.ndarray]):  # type: ignore[no-untyped-def]
    outer, *holes = sorted(rings, key=lambda ring: -np.hypot(*ring.T).max())
    found = shapely.Polygon(outer, holes)
    assert found.is_valid
    return found


def teeth_of(ring: np.ndarray, radius: float) -> int:
    """Half the number of times a closed line crosses a circle."""
    outside = np.hypot(*ring.T) > radius
    return int((outside != np.roll(outside, 1)).sum()) // 2


# ---------------------------------------------------------------------------------------------------------- flat parts


@pytest.mark.parametrize("form", [INVOLUTE, TRIANGULAR, "{form: ideal}", "{form: cycloidal, backlash: 0.05}"])
def test_wheels_read_back_have_their_teeth_their_bore_and_the_same_area_in_svg_and_dxf(form: str) -> None:
    pytest.importorskip("ezdxf")
    work = workpiece(form=form, module=2, bore=5)
    for wheel, z in (("p", 24), ("w", 36)):
        svg, dxf = from_svg(wheel_file(work, wheel, ".svg")), from_dxf(wheel_file(work, wheel, ".dxf"))
        drawn, cut = polygon(svg), polygon(dxf["CUT"])
        assert teeth_of(np.array(cut.exterior.coords), z) == z, "they cross the pitch circle of module 2"
        assert drawn.area == pytest.approx(cut.area, rel=2e-5)
        assert drawn.symmetric_difference(cut).area < 1e-4 * cut.area
        (bore,) = cut.interiors
        assert shapely.Polygon(bore).area == pytest.approx(pi * 2.5**2, rel=1e-3)
        pitch = shapely.Polygon(dxf["PITCH"][0])
        assert pitch.area == pytest.approx(pi * z**2, rel=1e-3)
        assert "ENGRAVE" in dxf


def test_triangular_teeth_are_the_polygon_of_their_half_angle() -> None:
    work = workpiece(64, 38, TRIANGULAR, module=1, bore=0)
    (outline,) = from_svg(wheel_file(work, "w", ".svg"))
    r = np.hypot(*outline.T)
    tips, valleys = outline[r > r.mean()], outline[r < r.mean()]
    assert (len(tips), len(valleys)) == (38, 38)
    turn = np.sort(np.arctan2(tips[:, 1], tips[:, 0]))
    assert np.allclose(np.diff(turn), 2 * pi / 38, atol=1e-6)
    tip = tips[np.argmin(abs(np.arctan2(tips[:, 1], tips[:, 0])))]
    assert abs(atan2(tip[1], tip[0])) < 1e-6, "the first tooth on the x axis"
    near = valleys[np.argsort(np.hypot(*(valleys - tip).T))[:2]]
    for x, y in near - tip:
        assert abs(atan2(y, -x)) == pytest.approx(radians(30), abs=1e-5)


def test_a_ring_is_cut_inside_its_rim_and_its_planets_fit_in() -> None:
    work = shipped_work("planetary-24-18-60-involute")
    ring = polygon(from_svg(wheel_file(work, "ring", ".svg")))
    hole, *posts = sorted(ring.interiors, key=lambda each: -shapely.Polygon(each).area)
    module = work.layout.wheels["ring"].module
    assert len(posts) == 3, "posts hold it to a plate"
    assert teeth_of(np.array(hole.coords), 30 * module) == 60
    assert ring.exterior.distance(hole) > module


def test_wheels_of_one_shape_share_a_sheet_that_says_how_often() -> None:
    work = shipped_work("freeth-2008")
    sheets = [each for each in export_files(work, ["svg"]) if each.path.startswith("wheels/")]
    flat = [name for name, (_, wheel) in work.train.declaration.wheels.items() if wheel.kind == "spur"]
    listed = [name for each in sheets for name in re.split(", ", each.title.split(":")[0].split(", 2 times")[0])]
    names = [name for name in listed if not name.endswith("times")]
    assert sorted(names) == sorted(flat)
    assert len(sheets) < len(flat)


NOT_FLAT = [
    *(("worm", "w2", "worm"), ("bevel-differential", "c41", "bevel")),
    pytest.param("lantern-mill", "pit72", "contrate", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("train", "wheel", "word"), NOT_FLAT)
def test_what_has_no_flat_outline_is_refused_by_name_and_the_rest_is_written(train: str, wheel: str, word: str) -> None:
    work = shipped_work(train)
    assert any(f"'{wheel}'" in each.what and word in each.what for each in notices(work, ["svg"]))
    with pytest.raises(GearTrainError, match=word):
        wheel_file(work, wheel, ".svg")
    assert any(each.path == "README.md" and wheel in each.make().decode() for each in export_files(work, ["svg"]))


def test_both_plates_have_a_hole_at_every_axis_and_four_for_pillars_and_stand_round_them() -> None:
    work = workpiece(module=2, bore=4)
    plates = [each for each in export_files(work, ["svg"]) if each.path.startswith("plates/")]
    assert [each.path for each in plates] == ["plates/frame-back-plate.svg", "plates/frame-front-plate.svg"]
    for plate in plates:
        drawn = polygon(from_svg(plate.make()))
        holes = [shapely.Polygon(ring) for ring in drawn.interiors]
        axes = sorted(axis.point[:2] for axis in work.layout.axes.values())
        nearest = [min(holes, key=lambda hole: hypot(hole.centroid.x - x, hole.centroid.y - y)) for x, y in axes]
        centres = [(hole.centroid.x, hole.centroid.y) for hole in nearest]
        assert len(holes) == 6
        assert np.allclose(centres, axes, atol=1e-4)
        assert hypot(*np.subtract(*centres)) == pytest.approx(60, abs=1e-4), "24 and 36 teeth of module 2: 60 mm"
        pivot = 0.55 * 4 + 0.08
        assert [hole.area for hole in nearest] == pytest.approx([pi * pivot**2 / 4] * 2, rel=1e-3)
        assert all(ring.distance(drawn.exterior) > 2.9 for ring in drawn.interiors)


def test_slots_are_as_long_as_the_pin_wanders() -> None:
    """A pin at 9.6 mm about an axis 1.1 mm off comes as near as 8.5 mm, and as far as 10.7; it is 2 mm thick."""
    work = SolidModel(load("freeth-2008"), ManufacturingSizes(bore=2))
    (wheel,) = [each for each in export_files(work, ["svg"]) if each.path.endswith("wheels/k2.svg")]
    drawn = polygon(from_svg(wheel.make()))
    holes = [shapely.Polygon(ring) for ring in drawn.interiors]
    slot = max(holes, key=lambda hole: hole.centroid.distance(shapely.Point(0, 0)))
    ends = [shapely.Point(0, 0).distance(slot), shapely.Point(0, 0).hausdorff_distance(slot)]
    assert ends == pytest.approx((8.5 - 1.1, 10.7 + 1.1), abs=2e-3)
    assert slot.area == pytest.approx(np.pi * 1.1**2 + 2.2 * 2.2, rel=1e-3)
    assert not [each for each in export_files(work, ["svg"]) if "plates/slot" in each.path], "no disc of its own"


@given(st.lists(st.text(max_size=12), max_size=12))
@example(["CON", "aux", "com1.x", "NUL.svg", "../x", "..", "a/b\\c:d", "/etc/passwd", "."])
def test_names_of_parts_become_names_of_files_that_differ_stay_in_the_folder_and_suit_windows(names: list[str]) -> None:
    found = file_names(names)
    assert len({name.lower() for name in found}) == len(names)
    for name in found:
        assert re.fullmatch(r"[\w+][\w.+-]*", name)
        assert not re.match(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)", name)


# ------------------------------------------------------------------------------------------------------ graphs, tables


def test_graphml_is_read_back_by_networkx_with_every_link_and_pair() -> None:
    work = shipped_work("freeth-2008")
    graph = nx.parse_graphml(train_file(work, "graphml").decode(), force_multigraph=True)
    declaration = work.train.declaration
    assert set(graph) == set(declaration.links)
    kinds = [data["kind"] for _, _, data in graph.edges(data=True)]
    assert kinds.count("gear") == len(declaration.gears)
    assert kinds.count("revolute") == len(declaration.revolutes)


def test_dot_is_read_back_with_every_edge() -> None:
    work = SolidModel(load("planetary"), ManufacturingSizes(), "ring fixed")
    text = train_file(work, "dot").decode()
    edges = re.findall(r'^  "([^"]*)" -- "([^"]*)" \[label="([^"]*)"', text, re.M)
    declaration = work.train.declaration
    joints = {(frozenset(joint.pair), joint.axis) for joint in declaration.revolutes}
    owners = {wheel: link for link, part in declaration.links.items() for wheel in part.wheels}
    pairs = {(frozenset(owners[wheel] for wheel in gear.pair), gear.name) for gear in declaration.gears}
    assert len(edges) == len(declaration.revolutes) + len(declaration.gears)
    assert {(frozenset((a, b)), label) for a, b, label in edges} == joints | pairs


def tables(work: SolidModel) -> dict[str, list[dict[str, str]]]:
    files = {each.path: each.make().decode() for each in export_files(work, ["csv"]) if each.path.endswith(".csv")}
    return {path[7:-4]: list(csv.DictReader(io.StringIO(text))) for path, text in files.items()}


def test_tables_hold_exact_values_and_the_same_in_decimal() -> None:
    """Against the textbook's arithmetic of a planetary whose ring is held."""
    found = tables(SolidModel(load("planetary-24-18-60"), ManufacturingSizes()))
    speeds = {row["link"]: Fraction(row["speed"]) for row in found["links"]}
    # ring held: carrier = z_s / (z_s + z_r), planet from (w_p - w_c) z_p = -(w_s - w_c) z_s
    carrier = Fraction(24, 24 + 60)
    assert speeds["carrier"] == carrier
    assert speeds["planet"] == carrier - Fraction(24, 18) * (1 - carrier)
    for row in (*found["links"], *found["outputs"]):
        assert float(row["speed_decimal"]) == pytest.approx(float(Fraction(row["speed"])), rel=1e-14)
    assert {row["wheel"]: int(row["teeth"]) for row in found["wheels"]} == {"ring": 60, "s": 24, "p": 18}
    for row in found["circuits"]:
        a, b = int(row["a"]), int(row["b"])
        assert Fraction(row["ratio"]) == Fraction(-b, a)


@pytest.mark.parametrize("name", ["freeth-2008", "freeth-2021", "bevel-differential", "zf-8hp70"])
def test_every_row_of_a_declaration_is_in_its_tables(name: str) -> None:
    train = load(name).unfolded
    found = tables(SolidModel(train, ManufacturingSizes()))
    assert {row["wheel"] for row in found["wheels"]} == set(train.declaration.wheels)
    assert [row["pair"] for row in found["pairs"]] == [gear.name for gear in train.declaration.gears]
    assert {row["link"] for row in found["links"]} == set(train.declaration.links)
    assert len(found["couplings"]) == len(train.declaration.couplings)
    assert {row["state"] for row in found["links"]} == (set(train.states) or {""})
    assert all(row["holds"] == "yes" for row in found["outputs"])


def test_distances_of_axes_that_lie_are_those_of_their_plane() -> None:
    """Axes along x, 30 mm apart in y and 40 mm in z, are 50 mm apart, wherever their wheels are along them."""
    train = geartrain.load("""
links: {frame: {}, a: {wheels: {p: {teeth: 20, module: 2 mm}}}, b: {wheels: {q: 30}}}
axes:
  A: {direction: [1, 0, 0], position: [0 mm, 0 mm, 0 mm]}
  B: {direction: [1, 0, 0], position: [7 mm, 30 mm, 40 mm]}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ q]
inputs: {a: 1}
""")
    work = SolidModel(train, ManufacturingSizes())
    components = json.loads(train_file(work, "rexs"))["model"]["components"]
    (stage,) = (part for part in components if part["type"] == "cylindrical_stage")
    (distance,) = (each["floating_point"] for each in stage["attributes"] if each["id"] == "center_distance")
    assert distance == pytest.approx(50, rel=1e-12)
    assert tables(work)["pairs"][0]["distance_mm"] == "50"


@pytest.mark.parametrize("sizes", ["module: 1 m", "module: 0.01 mm", "module: 1 mm, thickness: 2 m"])
def test_wheels_declared_beyond_what_is_made_are_refused_by_their_place(sizes: str) -> None:
    text = PAIR.format(z1=24, z2=36, form=INVOLUTE).replace("p: 24", f"p: {{teeth: 24, {sizes}}}")
    work = SolidModel(geartrain.load(text), ManufacturingSizes())
    with pytest.raises(GearTrainError, match="cannot be made") as found:
        export_files(work, ["svg"])
    assert all(each.place and each.why and each.fix for each in found.value.problems)
