"""Plates, arbors, pipes and pillars: measured on the solids by another library, and against printed numbers."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from itertools import combinations
from math import dist, hypot, pi
from typing import Any

import numpy as np
import pytest
import shapely
from sampling import first_few
from shipped import built
from workpieces import part_rows, steps, workpiece

import geartrain
from geartrain import GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files, notices

manifold3d = pytest.importorskip("manifold3d")


def body(solid: Any) -> Any:
    mesh = manifold3d.Mesh64(
        vert_properties=np.ascontiguousarray(solid.vertices, dtype=np.float64),
        tri_verts=np.ascontiguousarray(solid.faces, dtype=np.uint64),
    )
    found = manifold3d.Manifold(mesh)
    assert found.status() == manifold3d.Error.NoError
    return found


def overlaps(work: SolidModel, *kinds: str) -> Iterator[tuple[str, str, float]]:
    """Solids that share more than a millionth of the smaller one; one of them of some kinds if any are given."""
    bodies = [(part, body(part.placed)) for part in work.parts]
    for (one, first), (other, second) in combinations(bodies, 2):
        a, b = first.bounding_box(), second.bounding_box()
        near = all(a[k] < b[k + 3] and b[k] < a[k + 3] for k in range(3))
        if near and (not kinds or {one.kind, other.kind} & {*kinds}):
            shared = (first ^ second).volume()
            if shared > 1e-6 * min(first.volume(), second.volume()):
                yield one.name, other.name, shared


def heights(work: SolidModel) -> dict[str, tuple[float, float]]:
    return {part.name: (part.placed.vertices[:, 2].min(), part.placed.vertices[:, 2].max()) for part in work.parts}


# ------------------------------------------------------------------------------------------------------------ the whole

CLEAR = [
    *("longcase-clock-cycloidal", "watch-going-train", "planetary-24-18-60", "planets-in-place", "moon-triangular"),
    *("al-biruni-box-of-the-moon", "isfahan-astrolabe-1221", "ravigneaux-set", "norton-planetary"),
    *("byzantine-sundial-calendar", "nrel-grc-750"),
]


@pytest.mark.parametrize("name", first_few(5, CLEAR))
def test_no_two_solids_overlap_where_nothing_is_said_to_be_in_the_way(name: str) -> None:
    work = workpiece(name)
    assert work.frame is not None
    assert [*work.frame.plan.notices, *work.frame.problems()] == []
    assert list(overlaps(work)) == []


@pytest.mark.parametrize(("process", "fit"), [("laser", 0.15), ("cnc", 0.03), ("fdm", 0.5), ("hand", 0.08)])
def test_arbors_reach_both_plates_and_pivots_stand_in_their_holes_with_the_fit_that_is_stated(
    process: str, fit: float
) -> None:
    """On the solids: no triangle of an arbor is nearer to its plates than the fits say, and shoulders shake."""
    work = workpiece("watch-going-train", process=process)
    parts, faces = {part.name: part for part in work.parts}, heights(work)
    plates = [parts[f"plate {side} plate"] for side in ("back", "front")]
    for axis in ("third", "escape"):  # the fourth goes on to its hand
        arbor = parts[f"{axis} arbor"]
        z, radii = arbor.placed.vertices[:, 2], np.hypot(*arbor.solid.vertices[:, :2].T)
        for plate in plates:
            low, high = faces[plate.name]
            inside = (z > low - 1e-9) & (z < high + 1e-9)
            pivot = radii[inside].max()
            assert inside.any(), "it reaches the plate"
            gap = body(arbor.placed).min_gap(body(plate.placed), 1.0)
            # all round, but for chords; a shoulder shakes by 0.1
            assert gap == pytest.approx(min(fit / 2, 0.1), abs=2e-3)
            assert pivot == pytest.approx(0.55 * radii.max(), abs=0.01)
        low, high = max(faces[p.name][0] for p in plates), min(faces[p.name][1] for p in plates)
        thick = z[radii > 0.9 * radii.max()]
        assert low - high == pytest.approx(np.ptp(thick) + 0.2, abs=1e-9), "0.2 mm of end shake"


def test_a_clock_stands_as_clockmakers_build_it() -> None:
    """The hour pipe runs on the centre arbor, outside it, before the front plate; the going train has no studs."""
    low = {name: ends[0] for name, ends in heights(workpiece("longcase-clock-cycloidal")).items()}
    dial = low["hour pipe"]  # its hands are below
    assert low["centre arbor"] <= dial < low["h72"] < low["plates front plate"]
    assert not [name for name in low if name.endswith("stud")]


@pytest.mark.parametrize("name", ["pennestri-2002", "voulgaris-2024-a", "longcase-clock-loaded"])
def test_coaxial_arbors_are_laid_out_so_that_one_runs_in_the_other(name: str) -> None:
    frame = workpiece(name).frame
    assert frame is not None
    assert [column.tangled for column in frame.plan.all_columns if column.tangled] == []


# -------------------------------------------------------------------------------------------------------- front plate


LOCKED = """
links: {frame: {}, a: {wheels: {a1: 40, a2: 41}}, b: {wheels: {b1: 20, b2: 21}}, c: {wheels: {c1: 60, c2: 61}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [a1, b1]}, {pair: [b2, c1]}]
inputs: {a: 1}
"""


def test_pillars_keep_clear_of_wheels_and_pivots_and_hold_all_axes() -> None:
    for name in ("longcase-clock-cycloidal", "gosper-2005", "watch-going-train"):
        work = workpiece(name)
        frame = work.frame
        assert frame is not None
        low, high = frame.plan.places.back[0], frame.plan.places.front[1]
        for at in frame.pillars:
            for wheel in work.scene.wheels:
                if low < wheel.centre[2] < high:
                    tip = wheel.tip if wheel.circuits else wheel.radius  # a wheel without a mate is cut as a disc
                    away = hypot(at[0] - wheel.centre[0], at[1] - wheel.centre[1])
                    assert away - tip - 4 >= 0.999
            for axis in frame.plan.stack.axes.values():
                assert hypot(at[0] - axis.point[0], at[1] - axis.point[1]) - 4 >= 4
    ring = shapely.Polygon(workpiece("watch-going-train").frame.pillars).convex_hull  # type: ignore[union-attr]
    assert all(ring.contains(shapely.Point(*axis.point[:2])) for axis in work.layout.axes.values())


@pytest.mark.parametrize("name", ["nrel-grc-750", "planetary-24-18-60", "wolfrom-175"])
def test_no_hole_of_a_plate_runs_into_another_and_posts_keep_clear_of_axes(name: str) -> None:
    """Another axis is 52.5 mm from the ring's axis, as its rim is: a post of the ring was in the hole of that axis."""
    frame = workpiece(name).frame
    assert frame is not None
    assert frame.posts
    for plate in frame.plates():
        for one, other in combinations(plate.holes, 2):
            assert dist(one.at, other.at) > (one.diameter + other.diameter) / 2, (plate.name, one, other)


# ------------------------------------------------------------------------------------------------------ list, README


def test_the_list_of_parts_has_all_of_them_and_masses_of_their_volumes() -> None:
    work = workpiece("planetary-24-18-60")
    files = {each.path: each.make().decode() for each in export_files(work, ["svg"])}
    rows = list(csv.DictReader(io.StringIO(files["parts.csv"])))
    named = part_rows(work)
    assert set(named) == {part.name for part in work.parts}
    assert sum(int(row["count"]) for row in rows) == len(work.parts)
    density = {"brass": 8.47, "steel": 7.85}
    for part in work.parts:
        row = named[part.name]
        mass = body(part.placed).volume() * density[row["material"]] / 1000
        assert float(row["mass_g"]) == pytest.approx(mass, rel=4e-3), part.name
    guide = files["README.md"]
    assert "## Assembly" in guide
    assert "1. Fix " in guide
    assert all(f"{part.name}" in guide for part in work.parts)


def test_a_readme_follows_no_script_from_a_title() -> None:
    train = geartrain.load(LOCKED + "title: '[worn](JavaScript:alert(1)) <b>&#106;</b> [source](trains/a.yaml)'\n")
    files = {each.path: each for each in export_files(SolidModel(train, ManufacturingSizes()), ["svg"])}
    guide = files["README.md"].make().decode()
    assert r"[worn]\(JavaScript:alert(1)) &lt;b>&amp;#106;&lt;/b> [source](trains/a.yaml)" in guide


def test_what_cannot_be_built_is_named_with_what_is_in_the_way() -> None:
    expected = {"price-1974": "axis 'A' has no bearings", "zf-8hp70": "arbors 'S12' and 'R3S4' cannot be nested"}
    for name, text in expected.items():
        assert text in " ".join(each.what for each in notices(workpiece(name), ["svg"]))


def test_requested_sizes_are_made_or_refused() -> None:
    work = SolidModel(geartrain.load(LOCKED), ManufacturingSizes(bore=0))
    assert {part.kind for part in work.parts} == {"wheel"}
    assert all(blank.bore == 0 for blank in work.blanks.wheels.values())
    work = workpiece("watch-going-train", thickness=6.0)
    assert list(overlaps(work)) == []
    assert {part.height for part in work.parts if part.contours} == {6.0}
    with pytest.raises(GearTrainError, match="'lazer' is not a manufacturing process"):
        ManufacturingSizes(process="lazer")


# ------------------------------------------------------------------------------- axes that a carrier bears side by side


def test_two_axes_a_millimetre_apart_stand_on_one_stud_with_a_step() -> None:
    """The Moon's k1 and k2, 1.1 mm apart on e3: the foot holds all of the thinner end, which begins where it ends."""
    model = workpiece("freeth-2008")
    parts = {part.name: part for part in model.parts}
    foot, end, seat = parts["K2 stud"], parts["K1 stud"], parts["e3"]
    assert foot.turned is not None
    assert end.turned is not None
    apart = float(np.hypot(*(foot.place - end.place)[:2]))
    assert apart == pytest.approx(1.1, abs=1e-9)
    thick, thin = (max(band.radius for band in each.turned.bands[-1:]) for each in (foot, end) if each.turned)
    assert thin + apart <= thick
    faces = heights(model)
    assert faces["K2 stud"][1] == pytest.approx(faces["e3"][1]), "held in the wheel"
    assert faces["K1 stud"][1] == pytest.approx(faces["K2 stud"][0]), "one goes on where the other ends"
    assert seat.body == foot.body == end.body
    # from above e3, k2, k1, as found in the fragments, and nothing between that the pin could meet
    assert faces["k1"][1] < faces["k2"][0] < faces["k2"][1] < faces["e3"][0]
    between = {name for name, (low, high) in faces.items() if faces["k1"][1] <= low and high <= faces["k2"][0]}
    assert between == set()


def test_the_carrier_of_a_wolfrom_set_stands_between_its_planets_and_the_disc_of_a_ring() -> None:
    middles = {name: sum(ends) / 2 for name, ends in heights(workpiece("wolfrom-175")).items()}
    discs = sorted((middles["r70 disc"], middles["r72 disc"]))
    assert discs[0] < min(middles["p28"], middles["p30"]) < max(middles["p28"], middles["p30"]) < discs[1]
    assert discs[0] < middles["arm carrier plate"] < discs[1]


@pytest.mark.slow
def test_an_axis_that_no_plate_can_bear_gets_a_bridge() -> None:
    """The way of 'o1' to the plates is through the rim of 'p1': its arbor runs in a bridge beyond all wheels."""
    work = workpiece("freeth-2006")
    parts = {part.name: part for part in work.parts}
    arbor, bridge = parts["o arbor"], parts["frame bridge"]
    faces = heights(work)
    assert faces["p1"][1] < faces["o arbor"][0], "it ends before the wheel that was in its way"
    assert faces["o arbor"][0] < faces["frame bridge"][0] < faces["frame bridge"][1] < faces["o arbor"][1]
    assert arbor.turned is not None
    stack = work.frame.plan.stack if work.frame is not None else None
    assert stack is not None
    own = stack.flat(tuple(arbor.place)) - np.array(stack.flat(tuple(bridge.place)))
    (hole,) = [each.points for each in bridge.contours[1:] if hypot(*(own - each.points.mean(axis=0))) < 1e-5]
    assert np.ptp(hole[:, 0]) - arbor.turned.bands[0].radius * 2 == pytest.approx(0.08, abs=1e-6)
    collars = [parts[f"o {side} collar"] for side in ("lower", "upper")]
    assert faces[collars[0].name][1] < faces["frame bridge"][0], "one below"
    assert faces["frame bridge"][1] < faces[collars[1].name][0], "one above"
    pillars = [part for name, part in parts.items() if name.startswith("bridge pillar")]
    assert len(pillars) >= 3
    assert all(faces[part.name][1] == pytest.approx(faces["frame bridge"][1]) for part in pillars)
    assert "frame bridge" not in {part.name for part in workpiece("freeth-2008").parts}


# -------------------------------------------------------------------------------------------------------------- pillars


BRASS = 100_000.0  # N/mm2, Young's modulus
PUSH = 10.0  # N, of a hand at the crank


def parts_of_kind(name: str, kind: str) -> list[Any]:
    return [part for part in built(name).parts if part.kind == kind]


def thickness(pillar: Any) -> float:
    return 2 * max(radius for _, _, radius, _ in pillar.bands)


@pytest.mark.parametrize("name", ["worm", "bevel-differential", "humpage", "south-pointing-chariot", "zf-8hp70"])
def test_pillars_are_thin_beside_their_plates_and_stiff_enough(name: str) -> None:
    """Beams held at both ends, which one end leaves sideways: F l^3 / 12 E I a pillar (Roark, table 8.1, case 1b)."""
    found = parts_of_kind(name, "pillar")
    kinks = np.array(parts_of_kind(name, "frame")[0].outlines[0]).reshape(-1, 2)
    assert all(thickness(pillar) <= max(3.0, 0.062 * dist(np.ptp(kinks, axis=0), (0, 0))) for pillar in found)
    stiffness = 0.0
    for pillar in found:
        length = max(high - low for low, high, _, _ in pillar.bands)
        stiffness += 12 * BRASS * pi * thickness(pillar) ** 4 / 64 / length**3
    assert PUSH / stiffness < 0.02, "mm: a tenth of the shake of an arbor"


@pytest.mark.parametrize("name", ["planetary-24-18-60", "two-k-h-10000", "ferguson-paradox", "zf-8hp70"])
def test_pillars_of_a_train_about_one_axis_stand_evenly_to_its_left_and_right(name: str) -> None:
    """Else three stood at one end and one at the other, and the plate was a wedge."""
    places = np.array([pillar.place[:2] for pillar in parts_of_kind(name, "pillar")])
    (axis,) = {part.place[:2] for part in parts_of_kind(name, "arbor") if part.body and "planet" not in part.name}
    left, right = (places[side * (places[:, 0] - axis[0]) > 0] - axis for side in (-1, 1))
    assert len(left) == len(right) == 2
    assert np.abs(left).mean(axis=0) == pytest.approx(np.abs(right).mean(axis=0), abs=0.3)
    assert np.abs(places - axis)[:, 1].max() < 0.2 * np.abs(places - axis)[:, 0].min()


# -------------------------------------------------------------------------------------------------- spacers and collets


@pytest.fixture(scope="module", params=["longcase-clock-cycloidal", "freeth-2006", "price-1974"])
def work(request: pytest.FixtureRequest) -> SolidModel:
    return workpiece(request.param)


def sleeves(work: SolidModel) -> list[Any]:
    return [part for part in work.parts if part.kind in ("spacer", "collet") and part.turned is not None]


def test_spacers_and_collets_stand_at_the_faces_of_their_wheels_with_the_same_bore(work: SolidModel) -> None:
    faces = heights(work)
    assert {part.kind for part in sleeves(work)} == {"spacer", "collet"}
    for part in sleeves(work):
        names = part.name.removeprefix("spacer ").removeprefix("collet of ").split(" to ")
        low, high = faces[part.name]
        if part.kind == "spacer":
            assert (low, high) == pytest.approx((faces[names[0]][1], faces[names[1]][0]), abs=1e-9)
        else:
            bottom, top = faces[names[0]]
            assert low == pytest.approx(top, abs=1e-9) or high == pytest.approx(bottom, abs=1e-9)
            assert high - low >= 0.5 - 1e-9
        for bore in (work.blanks.wheels[name].bore for name in names if name in work.blanks.wheels):
            assert bore == 0 or 2 * part.turned.bands[0].bore == pytest.approx(bore)
        assert part.turned.bands[0].radius - part.turned.bands[0].bore >= 0.6 - 1e-9


def test_they_stand_in_nothing_and_come_in_with_their_wheels(work: SolidModel) -> None:
    """Solids against solids by manifold3d, their own arbors and wheels too; and the steps of the assembly."""
    assert list(overlaps(work, "spacer", "collet")) == []
    for part in sleeves(work):
        (step,) = (step for step in steps(work) if part.name in step.parts)
        assert step.parts.count(part.name) == 1
        assert part.kind in step.text


def test_wheels_beside_pins_and_slots_have_none() -> None:
    work = workpiece("freeth-2008")
    coupled = {link for each in work.train.declaration.couplings for link in (each.pin, each.slot)}
    assert coupled
    assert not coupled & {part.turned.link for part in sleeves(work)}


# --------------------------------------------------------------------------- plates where wheels across go through them


@pytest.mark.parametrize(
    ("name", "wheel", "plate"),
    [
        ("worm", "w60", "case back plate"),
        ("crossed-helical", "w20", "frame back plate"),
        ("voulgaris-2024-a", "t1", "frame front plate"),
    ],
)
def test_a_wheel_across_goes_through_its_plate_with_air_round_it(name: str, wheel: str, plate: str) -> None:
    """In its own middle plane the wheel is a rectangle in the plate, 0.4 mm away from what is left."""
    model = workpiece(name)
    parts = {part.name: part for part in model.parts}
    flat = parts[plate]
    own = (parts[wheel].placed.vertices - flat.place) @ flat.turn
    within = own[np.abs(own[:, 2]) < flat.height / 2 + 3]
    assert len(within)
    outer, *holes = (each.flattened(0.005) for each in flat.contours)
    material = shapely.Polygon(outer, holes)
    gaps = [material.distance(shapely.Point(x, y)) for x, y, z in within if abs(z) <= flat.height / 2]
    assert min(gaps) == pytest.approx(0.4, abs=0.02)
