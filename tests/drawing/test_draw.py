"""Pictures of trains, read back from SVG and compared with geometry, fractions and the declaration."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from fractions import Fraction
from functools import cache
from itertools import combinations
from math import atan2, hypot, pi
from pathlib import Path

import numpy as np
import pytest
import shipped
import yaml
from commands import LOCKED, call
from places import TRAINS
from shipped import train as load

import geartrain
from geartrain.errors import GearTrainError, QuestionError

pytest.importorskip("matplotlib")
pytest.importorskip("svgelements")

import svgelements
from matplotlib.figure import Figure
from seen_figure import KINDS

from geartrain.drawing import picture, render

FEW = [
    *("planetary-24-18-60", "pennestri-2002", "longcase-clock", "zf-8hp70", "bevel-differential", "humpage"),
    *("al-biruni-box-of-the-moon", "ferguson-paradox", "four-gear-loop", "worm", "lantern-mill"),
]
Points = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
SafeLoader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
SVG = "{http://www.w3.org/2000/svg}"


@cache
def drawn(
    name: str, kind: str, turns: Fraction = Fraction(0), state: str | None = None, outputs: tuple[str, ...] = ()
) -> Figure:
    """Return a cached picture, for tests that do not change it."""
    return picture(load(name), kind, state, turns, outputs=outputs)  # type: ignore[arg-type]


@cache
def svg(name: str, kind: str, turns: Fraction = Fraction(0), state: str | None = None) -> ET.Element:
    return ET.fromstring(render(drawn(name, kind, turns, state), ".svg"))


def lines_of(figure: Figure, gid: str) -> list[Points]:
    """Return the points (n, 2) of each line with a name."""
    return [np.asarray(line.get_xydata(), dtype=float) for line in figure.axes[0].lines if line.get_gid() == gid]


def grounds_of(figure: Figure) -> list[Points]:
    """Return the lower left and the upper right corner (2, 2) of each hatched area."""
    hatched = [patch for patch in figure.axes[0].patches if patch.get_gid() == "ground"]
    return [patch.get_path().transformed(patch.get_patch_transform()).get_extents().get_points() for patch in hatched]


def path_of(root: ET.Element, gid: str) -> list[tuple[float, float]]:
    """Return the vertices of the first path of a group, with y upwards."""
    group = next(each for each in root.iter(f"{SVG}g") if each.get("id") == gid)
    path = svgelements.Path(next(group.iter(f"{SVG}path")).get("d"))
    return [(each.end.x, -each.end.y) for each in path if each.end is not None]


def circle_of(root: ET.Element, gid: str) -> tuple[float, float, float]:
    """Return centre and radius of a drawn circle."""
    points = np.array(path_of(root, gid))
    low, high = points.min(0), points.max(0)
    assert high[0] - low[0] == pytest.approx(high[1] - low[1], rel=1e-4)
    x, y = (low + high) / 2
    return float(x), float(y), float(high[0] - low[0]) / 2


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_train_gives_the_same_bytes(kind: str) -> None:
    once, again = (render(picture(geartrain.load("planetary-24-18-60"), kind), ".svg") for _ in range(2))  # type: ignore[arg-type]
    assert once == again


@pytest.mark.parametrize("name", ["planetary-24-18-60", "longcase-clock", "ferguson-paradox"])
def test_the_pitch_circles_of_every_pair_touch_on_paper(name: str) -> None:
    root, declared = svg(name, "plan"), load(name).declaration
    for gear in declared.gears:
        if gear.name in shipped.layout(name).apart:
            continue
        (x1, y1, r1), (x2, y2, r2) = (circle_of(root, f"pitch {wheel}") for wheel in gear.pair)
        ring = any(declared.wheels[wheel][1].internal for wheel in gear.pair)
        assert hypot(x1 - x2, y1 - y2) == pytest.approx(abs(r1 - r2) if ring else r1 + r2, rel=1e-4)


@pytest.mark.parametrize("name", ["planetary-24-18-60", "longcase-clock", "moon-triangular"])
def test_every_outline_has_as_many_teeth_as_the_file_says(name: str) -> None:
    root = svg(name, "plan")
    for wheel, (_, declared) in load(name).declaration.wheels.items():
        x, y, _ = circle_of(root, f"pitch {wheel}")
        points = outline_of(root, wheel, declared.internal)
        radius = np.hypot(*(points - (x, y)).T)
        outside = radius > (radius.max() + radius.min()) / 2
        rises = np.count_nonzero(outside & ~np.roll(outside, 1))
        assert rises == declared.count, wheel


@pytest.mark.slow
def test_the_plan_of_sixty_nine_wheels_is_small_enough_for_a_page() -> None:
    assert len(render(drawn("freeth-2021", "plan"), ".svg")) < 1_500_000


HELICAL = """
links: {frame: {}, a: {wheels: {a20: {teeth: 20, helix_angle: 25 deg, hand: right}}},
  b: {wheels: {b30: {teeth: 30, helix_angle: 25 deg, hand: left}, b15: 15}}, c: {wheels: {c40: 40}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [a20 ~ b30, b15 ~ c40]
inputs: {a: 1}
"""


def test_lines_on_a_bar_have_the_angle_and_hand_of_its_helix() -> None:
    """If the axis is level, right-hand teeth fall towards the right on the side that the reader sees."""
    figure = picture(geartrain.load(HELICAL), "plan")
    slopes = {
        str(line.get_gid())[6:]: float(np.divide(*np.diff(np.asarray(line.get_xydata(), dtype=float), axis=0)[0][::-1]))
        for line in figure.axes[0].lines
        if str(line.get_gid()).startswith("helix ")
    }
    assert slopes == pytest.approx({"a20": -np.tan(np.radians(25)), "b30": np.tan(np.radians(25))})


@pytest.mark.parametrize("turns", [Fraction(0), Fraction(31, 7)])
@pytest.mark.parametrize("name", ["planetary-24-18-60", "longcase-clock"])
def test_no_tooth_is_drawn_over_a_tooth_of_its_mate(name: str, turns: Fraction) -> None:
    shapes = pytest.importorskip("shapely.geometry")
    root, declared = svg(name, "plan", turns), load(name).declaration
    for gear in declared.gears:
        one, other = (outline_of(root, wheel, declared.wheels[wheel][1].internal) for wheel in gear.pair)
        _, _, radius = circle_of(root, f"pitch {gear.pair[0]}")
        module = 2 * radius / (declared.wheels[gear.pair[0]][1].count or 1)
        first, second = shapes.Polygon(one), shapes.Polygon(other)
        ring = declared.wheels[gear.pair[1]][1].internal
        over = first.difference(second) if ring else first.intersection(second)
        assert over.area < 0.02 * module**2, gear.name


def outline_of(root: ET.Element, wheel: str, ring: bool) -> Points:
    """Return the vertices of a wheel's teeth; for a ring, without its rim, which is drawn first."""
    x, y, pitch = circle_of(root, f"pitch {wheel}")
    points = np.array(path_of(root, f"wheel {wheel}"))
    return points[np.hypot(*(points - (x, y)).T) < pitch * 1.08] if ring else points


def test_the_planet_goes_round_as_fractions_say() -> None:
    name = "planetary-24-18-60"  # the carrier makes 2/7 turn per turn of the sun
    centres = []
    for turns in (Fraction(0), Fraction(7, 8), Fraction(7, 4), Fraction(7, 2)):
        root = svg(name, "plan", turns)
        px, py, _ = circle_of(root, "pitch p")
        sx, sy, size = circle_of(root, "pitch s")
        centres.append(complex((px - sx) / size, (py - sy) / size))
    start, quarter, half, whole = centres
    front = shipped.scene(name).front
    assert quarter / start == pytest.approx(1j * front, abs=1e-3)
    assert half / start == pytest.approx(-1, abs=1e-3)
    assert whole / start == pytest.approx(1, abs=1e-3)


def test_a_loop_that_locks_is_red_and_the_verdict_stands_above() -> None:
    figure = picture(geartrain.load(LOCKED), "plan")
    edges = {patch.get_gid(): patch.get_edgecolor() for patch in figure.axes[0].patches}
    assert len({edges[f"wheel {wheel}"] for wheel in "xyz"}) == 1
    free = picture(geartrain.load(LOCKED.replace(", {pair: [z, x]}", "")), "plan")
    (sound,) = {p.get_edgecolor() for p in free.axes[0].patches if str(p.get_gid()).startswith("wheel")}
    assert edges["wheel x"] != sound
    assert any(text.get_text().startswith("locked: loop a - b - c") for text in figure.axes[0].texts)
    assert not any("locked" in text.get_text() for text in free.axes[0].texts)


def segments(figure: Figure, prefix: str) -> list[tuple[str, float, float, float]]:
    """Return the vertical lines with a prefix: wheel, x, lower and upper end."""
    found = []
    for line in figure.axes[0].lines:
        if str(line.get_gid()).startswith(prefix):
            xs, ys = (np.asarray(each, dtype=float) for each in line.get_data())
            assert xs[0] == xs[1]
            found.append((str(line.get_gid())[len(prefix) :], float(xs[0]), float(min(ys)), float(max(ys))))
    return found


@pytest.mark.parametrize("name", FEW)
def test_uprights_of_a_stick_diagram_never_lie_on_each_other(name: str) -> None:
    figure = drawn(name, "stick")
    for (one, x, low, high), (other, at, bottom, top) in combinations(segments(figure, "wheel "), 2):
        if abs(x - at) < 1e-6 and one != other:
            assert high <= bottom + 1e-9 or top <= low + 1e-9, f"{one} and {other}"


@pytest.mark.parametrize("name", FEW)
def test_the_two_wheels_of_every_pair_end_at_each_other(name: str) -> None:
    figure, declared = drawn(name, "stick"), load(name).declaration
    ends: dict[str, list[tuple[float, float]]] = {}
    for wheel, x, low, high in segments(figure, "wheel "):
        ends.setdefault(wheel, []).extend([(x, low), (x, high)])
    assert set(ends) == set(declared.wheels)
    for gear in declared.gears:
        ring = any(declared.wheels[wheel][1].internal for wheel in gear.pair)
        one, other = (ends[wheel] for wheel in gear.pair)
        gaps = [hypot(x - u, y - v) for x, y in one for u, v in other]
        assert min(gaps) == pytest.approx(hypot(0.3, 0.064) if ring else 0.064, abs=1e-6), gear.name


@pytest.mark.parametrize("state", ["1", "6", "R"])
def test_a_stick_diagram_shows_which_brakes_and_clutches_are_closed(state: str) -> None:
    """Each has two plates, close together if it is closed, on stems to the shafts of the links that it joins."""
    train = load("zf-8hp70")
    figure = picture(train, "stick", state)
    gaps = {}
    for name in train.declaration.clutches:
        one, other = lines_of(figure, f"element {name}")
        gaps[name] = abs(one[0, 0] - other[0, 0])
    closed = train.declaration.states[state].engaged
    assert max(gaps[name] for name in closed) < min(gap for name, gap in gaps.items() if name not in closed)
    assert len(grounds_of(figure)) == 2, "of the two brakes"


def shafts_of(figure: Figure) -> dict[str, tuple[float, float, float]]:
    """Return left end, right end and height of the shaft of each link."""
    found = {}
    for line in figure.axes[0].lines:
        if str(line.get_gid()).startswith("link "):
            xs, ys = (np.asarray(each, dtype=float) for each in line.get_data())
            found[str(line.get_gid())[5:]] = float(xs.min()), float(xs.max()), float(ys[0])
    return found


@pytest.mark.parametrize(
    "name", ["zf-8hp70", "ford-10r80", "mercedes-9g-tronic", "ravigneaux-set", "torqueflite", "lathe-back-gear"]
)
def test_brakes_and_clutches_are_between_the_members_that_they_join(name: str) -> None:
    """A stem leads from a plate to the shaft of each link; the left plate of a brake is next to the hatching."""
    figure, train = drawn(name, "stick"), load(name)
    shafts = shafts_of(figure)
    for element, clutch in train.declaration.clutches.items():
        plate, _ = lines_of(figure, f"element {element}")
        for link, stem in zip(clutch.links, lines_of(figure, f"stem {element}"), strict=True):
            left, right, height = shafts[link]
            assert stem[0, 1] == pytest.approx(height), (element, link)
            assert left < stem[0, 0] < right, (element, link)
        off = [
            (abs(high[0] - plate[0, 0]), abs((low + high)[1] / 2 - plate[:, 1].mean()))
            for low, high in grounds_of(figure)
        ]
        assert sum(x < 0.06 and y < 0.01 for x, y in off) == (len(clutch.links) == 1), element


@pytest.mark.parametrize(
    ("name", "element", "ahead"),
    # retro-direct: the hub may run ahead of its sprocket; torqueflite: `F` lets C2 turn forward past the case
    [("retro-direct", "S", "wheel"), ("retro-direct", "L", "wheel"), ("torqueflite", "F", "C2")],
)
def test_the_triangle_of_a_one_way_clutch_points_to_the_link_that_may_run_ahead(
    name: str, element: str, ahead: str
) -> None:
    figure = drawn(name, "stick")
    (triangle,) = (patch for patch in figure.axes[0].patches if patch.get_gid() == f"one-way {element}")
    corners = np.asarray(triangle.get_path().vertices)[:3]
    tip = next(x for x, y in corners if np.isclose(y, corners[:, 1].mean()))
    back = min(corners[:, 0], key=lambda x: -abs(x - tip))
    height = shafts_of(figure)[ahead][2]
    (stem,) = (line[0, 0] for line in lines_of(figure, f"stem {element}") if np.isclose(line[0, 1], height))
    assert abs(tip - stem) < abs(back - stem)


@pytest.mark.parametrize(("locks", "side"), [("[carrier, frame]", 1), ("[frame, carrier]", -1)])
def test_a_clutch_to_the_frame_has_its_hatching_on_the_side_of_the_frame(locks: str, side: int) -> None:
    text = (TRAINS / "engineering" / "planetary-24-18-60.yaml").read_text(encoding="utf-8")
    start = text.index("outputs:")
    figure = picture(geartrain.load(f"{text[:start]}clutches: {{X: {{locks: {locks}}}}}\n"), "stick")
    plates = [line[0, 0] for line in lines_of(figure, "element X")]
    (hatched,) = (
        corners[:, 0].mean() for corners in grounds_of(figure) if np.ptp(corners[:, 1]) > np.ptp(corners[:, 0])
    )
    assert np.sign(hatched - np.mean(plates)) == side


@pytest.mark.parametrize(
    ("name", "held"),
    [
        ("planetary-24-18-60", 1),  # the ring on the frame
        ("norton-planetary", 0),
        ("longcase-clock", 0),
        ("wolfrom-175", 1),  # fixed by a key of the declaration
        ("planetary", 1),  # ring fixed in the first state
    ],
)
def test_bearings_are_bars_and_only_held_links_are_hatched(name: str, held: int) -> None:
    figure, train = drawn(name, "stick"), load(name)
    assert len(grounds_of(figure)) == held
    assert ("held by the frame" in [text.get_text() for text in figure.legends[0].get_texts()]) == bool(held)
    bars = lines_of(figure, "bearing")
    for link, (left, right, height) in shafts_of(figure).items():
        if train.kinematics.tree.top[link] == train.declaration.frame:
            own = [bar for bar in bars if left - 1e-9 <= bar[0, 0] < bar[1, 0] <= right]
            heights = (round(bar[0, 1] - height, 6) for bar in own)
            assert sorted(each for each in heights if abs(each) < 0.06) == [-0.05, 0.05], link


def test_the_strands_of_a_belt_cross_where_it_drives_with_its_back() -> None:
    figure = drawn("retro-direct", "stick")
    strands = {name: lines_of(figure, f"coupling {name}")[0] for name in ("ring~s", "ring~l")}
    assert {name: bool(np.ptp(line[:, 0])) for name, line in strands.items()} == {"ring~s": False, "ring~l": True}
    words = [text.get_text() for text in figure.axes[0].texts]
    assert {"ring 44", "s 18", "l 26"} <= set(words)
    assert not segments(figure, "wheel "), "its wheels are the pulleys"


@pytest.mark.parametrize("name", ["rv-reducer", "strain-wave"])
def test_what_keeps_two_links_parallel_stands_between_their_shafts(name: str) -> None:
    """Two lines that do not touch, one from the shaft of each link."""
    figure = drawn(name, "stick")
    coupling = next(each for each in load(name).declaration.couplings if each.kind == "parallel")
    lower, upper = sorted(sorted(line[:, 1].tolist()) for line in lines_of(figure, f"coupling {coupling.name}"))
    assert [lower[0], upper[1]] == sorted(shafts_of(figure)[link][2] for link in (coupling.pin, coupling.slot))
    assert lower[1] < upper[0]
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "kept parallel" in words
    assert ("pins in holes" in words) == (name == "rv-reducer")


def test_a_plan_bends_a_thin_wheel_where_its_wave_stands() -> None:
    """After 1/6 turn the generator is at 60 degrees, where the teeth have their maximum radius."""
    figure = picture(load("strain-wave"), "plan", turns=Fraction(1, 6))
    lobes = lines_of(figure, "wave generator")
    ways = [np.diff(line, axis=0)[0] for line in lobes]
    assert sorted(np.degrees(np.arctan2(y, x)) for x, y in ways) == pytest.approx([-120, 60])
    (wheel,) = (patch for patch in figure.axes[0].patches if patch.get_gid() == "wheel spline")
    line = np.asarray(wheel.get_path().vertices) - lobes[0][0]
    far, scale = np.hypot(*line.T), np.hypot(*ways[0]) / (99.1 - 2.4 + 1)
    at = np.degrees(np.arctan2(line[:, 1], line[:, 0])) % 180
    assert far[np.abs(at - 60) < 1].max() / scale == pytest.approx(101.7, abs=0.01)
    assert far[np.abs(at - 150) < 1].max() / scale == pytest.approx(99.7, abs=0.01)


def test_closed_elements_stand_above_a_plan_and_at_the_members_of_a_speed_diagram() -> None:
    train = load("zf-8hp70").declaration
    for state, declared in train.states.items():
        engaged = set(declared.engaged)
        plan = drawn("zf-8hp70", "plan", state=state)
        words = " ".join(text.get_text() for text in plan.axes[0].texts if text.get_gid() == "elements")
        closed, _, opened = words.partition("open: ")
        assert set(re.findall(r"(\w+) (?:brakes|joins)", closed)) == engaged
        assert set(re.findall(r"(\w+) (?:brakes|joins)", opened)) == set(train.clutches) - engaged
        lever = drawn("zf-8hp70", "lever", state=state)
        shown = " ".join(text.get_text() for axes in lever.axes for text in axes.texts)
        assert {name for each in re.findall(r"\[(.*?)\]", shown) for name in each.split(", ")} == engaged
        for axes in lever.axes:
            for line in axes.lines:
                if line.get_gid() == "held":
                    assert set(np.asarray(line.get_ydata())) == {0.0}
    assert "elements" not in gids(drawn("planetary-24-18-60", "plan"))


def gids(figure: Figure) -> list[str]:
    """Return the names of all artists with a name."""
    return [str(artist.get_gid()) for artist in figure.findobj() if artist.get_gid()]


def test_what_has_a_name_in_a_graph_has_it_in_the_file() -> None:
    root = svg("prius-power-split", "graph")
    named = sorted(gids(drawn("prius-power-split", "graph")))
    assert len(named) > 10
    assert sorted(g.get("id") for g in root.iter(f"{SVG}g") if g.get("id") in named) == named


@pytest.mark.parametrize("name", [*FEW, "freeth-2008"])
def test_a_graph_has_an_edge_for_every_pair_in_the_file(name: str) -> None:
    kinds = [re.match(r"(revolute|gear|coupling|link) ", gid) for gid in gids(drawn(name, "graph"))]
    counted = {kind: sum(m is not None and m[1] == kind for m in kinds) for kind in ("revolute", "gear", "coupling")}
    declared = load(name).declaration
    wanted = {"revolute": len(declared.revolutes), "gear": len(declared.gears), "coupling": len(declared.couplings)}
    assert counted == wanted
    if "extends" not in (
        data := yaml.load(next(TRAINS.glob(f"*/{name}.yaml")).read_text(encoding="utf-8"), SafeLoader)
    ):
        assert wanted["gear"] == len(data["gears"])
    assert sum(m is not None and m[1] == "link" for m in kinds) == len(declared.links)


@pytest.mark.parametrize("name", [*FEW, "freeth-2008"])
def test_vertices_of_a_graph_keep_apart(name: str) -> None:
    figure = drawn(name, "graph")
    places = []
    for patch in figure.axes[0].patches:
        if str(patch.get_gid()).startswith("link "):
            box = patch.get_path().transformed(patch.get_patch_transform()).get_extents()
            places.append(((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2, box.width))
    for (x, y, width), (u, v, other) in combinations(places, 2):
        assert hypot(x - u, y - v) > (width + other) / 2 + 0.1


def test_a_speed_diagram_shows_the_published_speeds_as_fractions() -> None:
    figure = drawn("zf-8hp70", "lever")
    shown = [text.get_text() for axes in figure.axes for text in axes.texts if text.get_gid() == "speed OUT"]
    assert shown == ["23/108", "23/72", "77/162", "3/5", "6871/8826", "1", "143/120", "3/2", "-529/1744"]


def angle_of(figure: Figure, output: str) -> float:
    """Return the angle of a drawn pointer, clockwise from the top [turns]."""
    ((start, end),) = lines_of(figure, f"pointer {output}")
    return atan2(*(end - start)) / (2 * pi) % 1


@pytest.mark.parametrize("turns", [Fraction(31, 7), Fraction(-5, 3), Fraction(10**12 * 12 + 1, 4)])
def test_the_hands_of_a_clock_stand_where_the_time_is(turns: Fraction) -> None:
    figure = picture(load("longcase-clock"), "dials", turns=turns)  # the input is the minute hand
    for output, speed in {"centre": Fraction(1), "hour": Fraction(1, 12), "escape": Fraction(60)}.items():
        assert angle_of(figure, output) == pytest.approx(float(turns * speed % 1), abs=1e-9)


@pytest.mark.parametrize("turns", [Fraction(1, 50), Fraction(1, 17), Fraction(3, 7)])
def test_the_drawn_moon_is_lit_as_its_elongation_from_the_sun_requires(turns: Fraction) -> None:
    """The hands of Sun and Moon give the elongation: (1 - cos) / 2 of the disc is lit, on the side of the Sun."""
    figure = drawn("freeth-2021", "dials", turns)
    ahead = (angle_of(figure, "sun") - angle_of(figure, "moon")) % 1  # of the Sun, clockwise as seen from the Moon
    (moon,) = (patch for patch in figure.axes[0].patches if patch.get_gid() == "moon")
    (lit,) = (patch for patch in figure.axes[0].patches if patch.get_gid() == "lit")
    x, y = np.asarray(lit.get_path().vertices).T
    area = abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2
    share = (1 - np.cos(2 * pi * ahead)) / 2
    assert area / (pi * moon.radius**2) == pytest.approx(share, abs=0.002)  # type: ignore[attr-defined]
    assert np.sign(x.mean() - moon.center[0]) == np.sign(np.sin(2 * pi * ahead))  # type: ignore[attr-defined]
    assert any(f"{100 * share:.0f} % lit" in text.get_text() for text in figure.axes[0].texts)


def test_the_usual_sense_of_hands_is_written_once() -> None:
    texts = [text.get_text() for text in drawn("freeth-2021", "dials").axes[0].texts]
    assert sum(" clockwise" in text for text in texts) == 1
    backwards = {text.split(":")[0] for text in texts if text.endswith(", counter-clockwise")}
    assert backwards == {"games", "nodes", "phase"}, "the ball turns as the Moon gains on the Sun"


def test_a_pointer_on_a_spiral_moves_outwards_with_every_turn() -> None:
    reach = []
    for years in (0, 8, 16):  # five turns in nineteen years
        figure = drawn("freeth-2021", "dials", turns=Fraction(years), outputs=("metonic",))
        ((start, end),) = lines_of(figure, "pointer metonic")
        reach.append(hypot(*(end - start)))
        assert angle_of(figure, "metonic") == pytest.approx(float(Fraction(years * 5, 19) % 1), abs=1e-9)
    assert np.diff(reach, 2) == pytest.approx(0, abs=1e-9)
    assert reach[1] > reach[0] * 1.2


DIALLED = [name for name in shipped.trains() if load(name).declaration.dials and not load(name).states]


@pytest.mark.parametrize("name", shipped.every_train(DIALLED))
def test_a_pointer_at_its_zero_mark_reads_the_first_cell(name: str) -> None:
    """The rounding error at the start is about 1e-17 turns, with either sign."""
    scene = shipped.scene(name)
    shown = {text.get_text() for text in drawn(name, "dials").axes[0].texts}
    set_to_sky = {each.pointer for each in scene.epoch.settings} if scene.epoch else set()
    numbered = [each for each in enumerate(scene.pointers) if each[0] not in set_to_sky]
    read = [each for _, each in numbered if each.dial is not None and each.speed is not None]
    assert read
    for pointer in read:
        if (name, pointer.output) == ("equation-clock", "solar"):
            continue  # the cam turns it away from its mark
        text = next(each for each in shown if each.startswith(f"{pointer.output}: at "))
        assert scene.dials[pointer.dial or 0].scale.reading_text(Fraction(0)) in text


@pytest.mark.parametrize(
    ("kind", "outputs", "said"),
    [
        ("map", (), f"kinds are {', '.join(KINDS)}"),
        ("dials", ("minute hand",), "no output 'minute hand'"),
        ("lever", (), "no epicyclic set"),
    ],
)
def test_a_picture_that_cannot_be_drawn_is_refused_with_a_remedy(
    kind: str, outputs: tuple[str, ...], said: str
) -> None:
    with pytest.raises(QuestionError) as caught:
        picture(load("longcase-clock"), kind, outputs=outputs)  # type: ignore[arg-type]
    assert all(problem.fix for problem in caught.value.problems)
    assert said in str(caught.value)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("suffix", "head"), [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")])
def test_the_command_writes_what_the_suffix_says(here: Path, suffix: str, head: bytes) -> None:
    assert call("draw", "four-gear-loop", "-o", f"x{suffix}").exit_code == 0
    assert (here / f"x{suffix}").read_bytes().startswith(head)


def test_without_a_name_the_picture_is_called_after_train_and_kind(here: Path) -> None:
    assert call("draw", "planetary-24-18-60", "--kind", "lever").exit_code == 0
    assert [path.name for path in here.iterdir()] == ["planetary-24-18-60-lever.svg"]


def test_the_name_of_a_train_never_leads_out_of_the_folder(here: Path) -> None:
    (here / "t.yaml").write_text("name: ../<script>/x\n" + LOCKED, encoding="utf-8")
    assert call("draw", "t.yaml", "--kind", "graph").exit_code == 1
    assert sorted(path.name for path in here.iterdir()) == ["script-x-graph.svg", "t.yaml"]
    ET.fromstring((here / "script-x-graph.svg").read_bytes())


@pytest.mark.parametrize(
    ("path", "said"), [("nowhere/x.svg", "nowhere does not exist"), ("x\x07.svg", "not a valid file name")]
)
@pytest.mark.parametrize("force", [False, True])
def test_what_cannot_be_a_file_is_refused_with_a_reason_and_a_way_out(
    here: Path, path: str, said: str, force: bool
) -> None:
    found = call("draw", "four-gear-loop", "-o", path, *["--force"] * force).exception
    assert isinstance(found, GearTrainError)
    assert said in str(found)
    (problem,) = found.problems
    assert problem.why
    assert problem.fix
    assert problem.place


@pytest.mark.parametrize(
    "wrong", [("--turns", "many"), ("--turns", "1/0"), ("--turns", "inf"), ("--kind", "poem"), ("-o", "x.gif")]
)
def test_wrong_options_are_unusable_input(here: Path, wrong: tuple[str, str]) -> None:
    result = call("draw", "four-gear-loop", *wrong)
    assert result.exit_code == 2 or isinstance(result.exception, GearTrainError)  # the exit code of the command is 2
    assert not list(here.iterdir())


def test_a_train_that_locks_is_drawn_and_told(here: Path) -> None:
    (here / "t.yaml").write_text(LOCKED, encoding="utf-8")
    result = call("draw", "t.yaml", "-o", "t.svg")
    assert result.exit_code == 1
    assert "locked" in result.stderr
    assert (here / "t.svg").exists()


def test_a_figure_shows_itself_in_a_notebook() -> None:
    figure = drawn("planetary-24-18-60", "plan")
    shown = figure._repr_svg_()  # type: ignore[attr-defined]
    assert shown.encode("utf-8") == render(figure, ".svg")
