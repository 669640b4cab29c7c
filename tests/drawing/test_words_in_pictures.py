"""In every picture of every shipped train all words can be read: none under 8 points, over another, or over the edge.

Measured in the written file, where a glyph is an outline: what is measured is what a reader sees.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from places import train_files
from shipped import train as load

from geartrain.errors import QuestionError

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from seen_figure import KINDS, alike
from written_text import read_picture

from geartrain.drawing import picture, render

MINIMUM = 8.0  # points
WIDEST = 34.0  # inches: 3,400 pixels as the command draws them
FEW = ["planetary", "bevel-differential", "longcase-clock", "rv-reducer", "strain-wave", "worm", "zf-8hp70"]
ALL = sorted(path.stem for path in train_files())


def faults_of(figure: Figure) -> dict[str, object]:
    """Return the illegible texts of a figure by kind of fault; empty without faults."""
    found = read_picture(render(figure, ".svg"))
    assert found.texts, "a picture without words was not read"
    faults = {
        "over each other": found.overlaps(),
        "over the edge": found.clipped(),
        "too small": found.small(MINIMUM),
        "too large": [side for side in (found.width, found.height) if side > 72 * WIDEST],
    }
    return {name: what for name, what in faults.items() if what}


def check(name: str, kind: str, turns: Fraction = Fraction(0)) -> None:
    train = load(name)
    state = train.states[0] if train.states and kind != "lever" else None
    moving = any(circuit.carrier != train.declaration.frame for circuit in train.circuits)
    if (kind == "lever" and not moving) or (kind == "dials" and not any(c.outputs for c in train.declaration.cases)):
        with pytest.raises(QuestionError, match=name):
            picture(train, kind, state, turns)  # type: ignore[arg-type]
        return
    figure = picture(train, kind, state, turns)  # type: ignore[arg-type]
    assert not faults_of(figure)
    assert not alike(figure)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", FEW)
def test_words_can_be_read(name: str, kind: str) -> None:
    check(name, kind)


@pytest.mark.parametrize("name", ["al-biruni-box-of-the-moon", "ferguson-paradox", "prague-orloj"])
def test_words_can_be_read_after_some_turns(name: str) -> None:
    check(name, "plan", Fraction(31, 7))
    check(name, "dials", Fraction(31, 7))


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ALL)
def test_words_can_be_read_in_all_shipped_trains(name: str, kind: str) -> None:
    check(name, kind)
    if kind in ("plan", "dials"):
        check(name, kind, Fraction(355, 113))


def struck(words: Text, marks: Iterable[Bbox]) -> list[Bbox]:
    """Return the artists that a text covers."""
    box = words.get_window_extent()
    return [mark for mark in marks if box.x0 < mark.x1 and mark.x0 < box.x1 and box.y0 < mark.y1 and mark.y0 < box.y1]


@pytest.mark.parametrize(
    ("name", "kind", "part", "count"),
    [
        ("longcase-clock", "stick", "teeth", 2 * 5 + 1),  # the escape wheel meets no other
        # of the moving links, `b`, mars, jupiter and saturn turn in the frame, and carriers carry 6 others
        ("carman-thorndike-evans-2012", "stick", "bearing", 2 * (4 + 6)),
        ("rv-reducer", "plan", "pin ", 0),
        ("cycloidal-reducer", "plan", "pin ", 0),
        ("freeth-2008", "plan", "pin ", 0),
    ],
)
def test_words_keep_off_teeth_bearings_and_pins(name: str, kind: str, part: str, count: int) -> None:
    (axes,) = picture(load(name), kind, None, Fraction(0)).axes  # type: ignore[arg-type]
    marks = [each.get_window_extent() for each in axes.get_children() if str(each.get_gid()).startswith(part)]
    assert len(marks) == count or (marks and not count)
    words = [each for each in axes.texts if kind == "stick" or str(each.get_gid()).startswith("name ")]
    assert not [each.get_text() for each in words if struck(each, marks)]


@pytest.mark.parametrize("name", ["four-gear-loop", "longcase-clock", "rv-reducer", "zf-8hp70"])
def test_names_of_links_axes_and_couplings_keep_off_uprights(name: str) -> None:
    """The vertical line of a wheel passes other axes and their names."""
    (axes,) = picture(load(name), "stick", None, Fraction(0)).axes
    uprights = [
        line.get_window_extent()
        for line in axes.lines
        if (line.get_gid() or "").startswith(("wheel ", "crank ", "coupling ")) and np.ptp(line.get_xdata()) == 0
    ]
    assert uprights
    assert not [words.get_text() for words in axes.texts[1:] if struck(words, uprights)]


def test_lines_of_a_stick_diagram_tell_by_their_width_what_they_are_and_so_does_its_legend() -> None:
    (axes,) = (figure := picture(load("zf-8hp70"), "stick", None, Fraction(0))).axes
    drawn: dict[str, set[float]] = {}
    for line in axes.lines:
        drawn.setdefault((line.get_gid() or "").partition(" ")[0], set()).add(line.get_linewidth())
    keys = {line.get_label(): line.get_linewidth() for line in figure.legends[0].get_lines()}
    widths = [keys["links on their axes"], keys["wheels"], keys["carriers"]]
    assert [drawn[part] for part in ("link", "wheel", "crank")] == [{width} for width in widths]
    assert all(wider > 1.4 * width for width, wider in pairwise(widths))
    touching = [line for line in axes.lines if line.get_gid() == "teeth"]
    levels = sorted({(round(line.get_xdata()[0], 6), line.get_ydata()[0]) for line in touching})
    gaps = [high - low for (x, low), (at, high) in pairwise(levels) if x == at and high - low < 0.1]
    assert gaps
    assert min(gaps) * 72 > widths[1] + 1, "the marks of two wheels that touch are two"


@pytest.mark.parametrize(
    ("name", "most"), [("three-planets", 0), ("zf-8hp70", 0), ("price-1974", 0), ("freeth-2021", 17)]
)
def test_labels_of_a_graph_keep_off_other_edges(name: str, most: int) -> None:
    """In a graph of 60 links some thin edges are close together; no label covers the thick edge of a gear pair."""
    figure = picture(load(name), "graph", None, Fraction(0))
    figure.draw_without_rendering()
    (axes,) = figure.axes
    share = np.linspace(0, 1, 300)[:, None]
    edges = []
    for patch in axes.patches:
        kind, _, label = (patch.get_gid() or "").partition(" ")
        if kind in ("revolute", "gear", "coupling"):
            first, middle, last = np.asarray(patch.get_path().vertices, dtype=float)
            curve = (1 - share) ** 2 * first + 2 * share * (1 - share) * middle + share**2 * last
            edges.append((kind, label, axes.transData.transform(curve)))
    hit = []
    for text in axes.texts:
        if not (text.get_gid() or "").startswith("label "):
            continue
        box = text.get_window_extent()
        for kind, label, points in edges:
            inside = (points > (box.x0, box.y0)).all(1) & (points < (box.x1, box.y1)).all(1)
            if label != text.get_text() and inside.any():
                hit.append((kind, text.get_text(), label))
    assert len(edges) == sum((text.get_gid() or "").startswith("label ") for text in axes.texts)
    assert len(hit) <= most, hit
    assert not [each for each in hit if each[0] == "gear"]


@pytest.mark.parametrize(("name", "round_"), [("lantern-mill", "pit72"), ("huygens-planetarium-1682", "y300")])
def test_a_wheel_across_is_round_from_the_right_where_the_plan_has_its_edge(name: str, round_: str) -> None:
    """It was omitted, which left an empty space as wide as the wheel."""
    (axes,) = picture(load(name), "plan", None, Fraction(0)).axes
    sides = {
        (part.get_gid() or "").removeprefix("side "): part
        for part in axes.get_children()
        if "side " in str(part.get_gid())
    }
    assert set(sides) == set(load(name).declaration.wheels)
    extents = {wheel: part.get_window_extent() for wheel, part in sides.items()}
    own = extents.pop(round_)
    assert own.width == pytest.approx(own.height, rel=0.01)
    for edge in extents.values():
        assert edge.width < 0.2 * own.width


@pytest.mark.parametrize("name", ["huygens-planetarium-1682", "three-planets", "zf-8hp70"])
def test_words_along_a_wheel_leave_its_line_whole(name: str) -> None:
    """The gap is at least half a point, the width of the halo of the text."""
    (axes,) = picture(load(name), "stick", None, Fraction(0)).axes
    dots = axes.figure.dpi / 72
    uprights = [
        (line.get_window_extent(), line.get_linewidth() * dots / 2)
        for line in axes.lines
        if (line.get_gid() or "").startswith(("wheel ", "crank ")) and np.ptp(line.get_xdata()) == 0
    ]
    for words in axes.texts:
        box = words.get_window_extent()
        beside = [
            min(abs(box.x0 - line.x0), abs(box.x1 - line.x0)) - half
            for line, half in uprights
            if words.get_rotation() == 90 and box.y0 < line.y1 and line.y0 < box.y1
        ]
        assert min(beside, default=dots) > 0.5 * dots, words.get_text()


def test_panels_of_a_speed_diagram_fill_the_page() -> None:
    for name in ("planetary-24-18-60", "simpson-set"):
        figure = picture(load(name), "lever")
        right = max(axes.get_position().x1 for axes in figure.axes[1:])
        assert right * figure.get_size_inches()[0] == pytest.approx(figure.get_size_inches()[0] - 0.45, abs=0.01)


def test_rows_of_a_speed_diagram_hold_as_many_panels_as_each_other() -> None:
    """Four sets in a state: rows of three and one left gaps as wide as two panels."""
    figure = picture(load("zf-8hp70"), "lever")
    first = [axes for axes in figure.axes[1:] if axes.get_label().endswith(" 1")]
    rows = Counter(round(axes.get_position().y0, 3) for axes in first)
    assert list(rows.values()) == [2, 2]


TWO_FACES = """
name: two-faces
extends: price-1974
outputs: {lunar year: {dial: lower}}
dials: {lower: {centre: null, diameter: null}}
"""


def test_two_faces_of_one_dial_are_told_apart() -> None:
    """Its lower dial has hands about two axes."""
    (axes,) = picture(load(TWO_FACES), "dials").axes
    titles = {words.get_text() for words in axes.texts if (words.get_gid() or "").startswith("dial ")}
    assert titles == {"zodiac", "lower (synodic month)", "lower (lunar year)", "upper"}


def test_the_key_of_hands_shows_their_dashes() -> None:
    """A line shorter than one dash and gap looks like a hand without dashes."""
    (axes,) = picture(load("freeth-2021"), "dials", None, Fraction(0)).axes
    keys = [line for line in axes.lines if line.get_gid() == "key"]
    dashed = [line for line in keys if line.get_linestyle() == "--"]
    assert len(keys) == 15
    assert len(dashed) == 7
    for line in dashed:
        left, right = line.get_window_extent().get_points()[:, 0]
        _, pattern = line._dash_pattern  # type: ignore[attr-defined]
        assert (right - left) * 72 / axes.figure.dpi > 1.2 * sum(pattern)


def test_plain_faces_tell_no_cells() -> None:
    (axes,) = picture(load("planetary-24-18-60"), "dials", None, Fraction(1, 3)).axes
    assert any("at 2/9 turn" in words.get_text() for words in axes.texts)
    assert not any("cell" in words.get_text() for words in axes.texts)


def drawn(*texts: tuple[float, float, str, float, float]) -> Figure:
    figure = Figure(figsize=(4, 2))
    for x, y, words, size, angle in texts:
        figure.text(x / 4, y / 2, words, fontsize=size, rotation=angle, rotation_mode="anchor")
    return figure


@pytest.mark.parametrize(
    ("texts", "fault", "found"),
    [
        ([(1, 1, "first", 10, 0), (1.2, 1.02, "second", 10, 0)], "over each other", [("first", "second")]),
        ([(3.6, 1, "an overlong word", 10, 0)], "over the edge", ["an overlong word"]),
        ([(1, 1, "small", 7.5, 0)], "too small", [("small", 7.5)]),
    ],
)
def test_words_that_cannot_be_read_are_found(
    texts: list[tuple[float, float, str, float, float]], fault: str, found: list[object]
) -> None:
    assert faults_of(drawn(*texts)) == {fault: found}


def test_slanted_words_side_by_side_are_apart_though_their_upright_boxes_share_much() -> None:
    assert not faults_of(drawn((1, 0.3, "slanted words", 9, 60), (1.2, 0.3, "slanted words", 9, 60)))
    assert faults_of(drawn((1, 0.3, "slanted words", 9, 60), (1.05, 0.3, "slanted words", 9, 60)))


def test_a_word_is_as_wide_as_its_font_says() -> None:
    (text,) = read_picture(render(drawn((1, 1, "HHHH", 10, 0)), ".svg")).texts
    width = text.corners[:, 0].max() - text.corners[:, 0].min()
    assert text.size == pytest.approx(10)
    assert width == pytest.approx(4 * 7.52, abs=2.2)  # DejaVu Sans: the advance width of H is 0.752 em
