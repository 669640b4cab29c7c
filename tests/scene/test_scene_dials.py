"""Dials: readings, cells and engraving of their scales, and their places on the plates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate, combinations, pairwise
from math import atan2, hypot, pi
from typing import Any

import numpy as np
import pytest
import shapely
import shipped
from hypothesis import given
from hypothesis import strategies as st

import geartrain
from geartrain import GearTrain
from geartrain.scene import engrave, lay_out, make_scene
from geartrain.scene.stroke_letters import curved_text, letter_strokes

BASE = {
    "links": {"frame": {}, "a": {}},
    "revolutes": {"A": ["frame", "a"]},
    "inputs": {"a": 1},
    "outputs": {"a": {"dial": "d"}},
}


def shown(train: GearTrain) -> Any:
    """Return the scale of the only dial in the scene of a train."""
    (found,) = make_scene(train).dials
    return found.scale


def scale_of(**dial: Any) -> Any:
    return shown(GearTrain.declare({**BASE, "dials": {"d": dial}}))


METONIC = scale_of(turns=5, divisions=235, cell="month")
SAROS = scale_of(turns=4, divisions=223, cell="month")
ZODIAC = scale_of(names="zodiac")
HOURS = scale_of(divisions=12, numerals="roman", cell="hour")
MINUTES = scale_of(divisions=60, numerals="arabic", cell="minute")
DOUBLE = scale_of(divisions=24, numerals={"style": "roman", "to": 12}, cell="hour")


def scales() -> Iterator[tuple[str, Any]]:
    """Yield the scales of all shipped trains, with the train names."""
    plain = GearTrain.declare({**BASE, "dials": {"d": {}}}).declaration
    for name in shipped.trains():
        for key, dial in shipped.train(name).declaration.dials.items():
            if dial.look == "scale":
                yield f"{name} {key}", shown(GearTrain(plain.model_copy(update={"dials": {"d": dial}})))


@given(st.integers(1, 7), st.integers(1, 400), st.data())
def test_a_pointer_in_the_middle_of_a_cell_reads_it(turns: int, divisions: int, data: st.DataObject) -> None:
    cell = data.draw(st.integers(1, divisions))
    rounds = data.draw(st.integers(-3, 3))
    middle = Fraction((2 * cell - 1) * turns, 2 * divisions) + rounds * turns
    read = scale_of(turns=turns, divisions=divisions).read(middle)
    assert (read.cell, read.turn) == (cell, int((middle - rounds * turns) // 1) + 1)


def test_a_reading_has_the_turn_the_cell_and_what_is_engraved_in_it() -> None:
    years = {0: "turn 1, month 1", Fraction(19, 5): "turn 2, month 48", 19 - Fraction(19, 235): "turn 5, month 235"}
    years |= {19: "turn 1, month 1"}  # a turn of the Metonic spiral is 47 months, 3.8 years
    assert {year: METONIC.reading_text(year * Fraction(5, 19)) for year in years} == years
    # a turn of the Saros spiral is 55 3/4 months
    months = [SAROS.reading_text(Fraction(turn)) for turn in range(4)]
    assert months == [f"turn {turn}, month {month}" for turn, month in ((1, 1), (2, 56), (3, 112), (4, 168))]
    saros = scale_of(turns=4, divisions=223, cell="month", glyphs={72: "Η"})
    assert saros.reading_text(saros.turn_of(Fraction(143, 2))) == "turn 2, month 72, Η"
    assert saros.reading_text(saros.turn_of(72)) == "turn 2, month 73"


def test_signs_and_days_are_told_by_name() -> None:
    assert ZODIAC.reading_text(Fraction(134, 360)) == "Leo, degree 15"
    year = scale_of(names="egyptian_months")
    assert year.reading_text(Fraction(364, 365)) == "Epagomenal, day 5"
    assert scale_of(names=["Isthmia", "Nemea"]).reading_text(Fraction(3, 4)) == "Nemea"
    assert scale_of(names=["", "8"]).reading_text(Fraction(1, 4)) == "cell 1", "a blank sector has its number"
    assert scale_of().reading_text(Fraction(1, 4)) == ""


def test_the_sun_passes_the_first_sign_in_a_twelfth_of_a_year() -> None:
    scene = shipped.scene("freeth-2008")
    zodiac = next(each.scale for each in scene.dials if each.id == "zodiac")
    assert [zodiac.read(Fraction(month, 12)).name for month in range(12)] == [name for name, *_ in ZODIAC.names]


def test_numerals_end_at_the_zero_mark() -> None:
    assert " ".join(text for text, _ in HOURS.numerals) == "I II III IV V VI VII VIII IX X XI XII"
    assert {line: text for text, line in HOURS.numerals}[0] == "XII"
    assert [text for text, _ in DOUBLE.numerals] == [text for text, _ in HOURS.numerals] * 2
    assert [int(text) for text, _ in MINUTES.numerals] == list(range(5, 61, 5))
    assert all(int(text) % 60 == line for text, line in MINUTES.numerals)


def test_clocks_tell_the_line_that_is_past() -> None:
    times = Fraction(49, 4), Fraction(9, 2), Fraction(0)  # quarter past twelve, half past four, twelve
    assert [HOURS.reading_text(each / 12) for each in times] == ["hour 12", "hour 4", "hour 12"]
    assert [MINUTES.reading_text(each) for each in times] == ["minute 15", "minute 30", "minute 0"]
    found = [DOUBLE.reading_text(Fraction(each, 24)) for each in (0, 11, 12, 13, 23)]
    assert found == [f"hour {hour}" for hour in (12, 11, 12, 1, 11)]


def borders(parts: list[Any], radius: float) -> list[float]:
    """Return the angles of lines inwards from a circle, clockwise from the top [turns]."""
    lines = [line for part in parts if part.kind in ("fine", "bold") for line in part.lines]
    return sorted(atan2(*line[0]) / (2 * pi) % 1 for line in lines if abs(hypot(*line[0]) - radius) < 1e-9)


@pytest.mark.parametrize(("way", "at"), [("clockwise", 1 / 8), ("counter-clockwise", 7 / 8)])
def test_what_is_counted_the_other_way_is_engraved_the_other_way(way: str, at: float) -> None:
    parts = engrave(scale_of(divisions=4, glyphs={1: "A"}, counted=way))
    letters = [part for part in parts if part.kind == "letters"][-1]
    points = [point for line in letters.lines for point in line]
    x, y = (sum(values) / len(points) for values in zip(*points, strict=True))
    assert atan2(x, y) / (2 * pi) % 1 == pytest.approx(at, abs=0.01)


def test_borders_run_the_way_a_dial_is_counted() -> None:
    spans = [{"name": "", "span": 1}, {"name": "", "span": 3}]
    found = {}
    for way in ("clockwise", "counter-clockwise"):
        parts = engrave(scale_of(names=spans, counted=way))
        found[way] = [atan2(*line[0]) / (2 * pi) % 1 for part in parts if part.kind == "bold" for line in part.lines]
    assert found == {"clockwise": [0, 1 / 4], "counter-clockwise": [0, 3 / 4]}


def test_degrees_and_days_are_engraved_one_by_one() -> None:
    parts = engrave(scale_of(names="zodiac", around={"names": "egyptian_months"}))
    assert borders(parts, 1.0) == pytest.approx([day / 365 for day in range(365)], abs=1e-9)
    assert borders(parts, scale_of(around={}).outer) == pytest.approx([d / 360 for d in range(360)], abs=1e-9)


def test_a_spiral_has_a_border_at_both_ends_of_every_month() -> None:
    for scale, months in ((METONIC, 235), (SAROS, 223)):
        lines = [line for part in engrave(scale) if part.kind == "fine" for line in part.lines]
        assert len(lines) == months + 1
        pitch = 0.45 / scale.turns
        for month, (outer, inner) in enumerate(lines):
            turned = month * scale.turns / months
            assert hypot(*outer) == pytest.approx(0.55 + pitch * turned)
            assert hypot(*inner) == pytest.approx(hypot(*outer) - pitch)
            assert atan2(*outer) / (2 * pi) % 1 == pytest.approx(turned % 1, abs=1e-9) or turned % 1 < 1e-9


def letters_of(scale: Any) -> list[tuple[tuple[float, float], ...]]:
    """Return the strokes of all letters."""
    return [line for part in engrave(scale) if part.kind == "letters" for line in part.lines]


def crossed(scale: Any) -> bool:
    """Return True if a stroke of a letter crosses a border."""
    lines = [line for part in engrave(scale) if part.kind in ("fine", "bold") for line in part.lines]
    angle = np.array([atan2(*a) for a, _ in lines])
    low, high = (np.array([pick(hypot(*a), hypot(*b)) for a, b in lines]) for pick in (min, max))
    for stroke in letters_of(scale):
        for one, other in pairwise(stroke):
            first, last = sorted((atan2(*one), atan2(*other)))
            near, far = sorted((hypot(*one), hypot(*other)))
            met = (first < angle) & (angle < last) & (low < far - 1e-9) & (near < high - 1e-9)
            if last - first < 1 and met.any():  # otherwise the stroke crosses the branch cut of atan2
                return True
    return False


def test_engraving_keeps_within_its_dial_and_letters_off_borders() -> None:
    for scale, name in {scale: name for name, scale in scales()}.items():
        parts = engrave(scale)
        assert all(hypot(*point) < 1 + 1e-9 for part in parts for line in part.lines for point in line), name
        assert all(part.width > 0.0014 for part in parts if part.kind == "letters"), f"{name}: too small to be read"
        assert not crossed(scale), name


@given(st.lists(st.text("ABCDEFGHIJ", min_size=1, max_size=14), min_size=1, max_size=12))
def test_a_name_keeps_to_its_own_divisions(names: list[str]) -> None:
    parts = engrave(scale_of(names=[{"name": each} for each in names]))
    for stroke in (line for part in parts if part.kind == "letters" for line in part.lines):
        turns = [atan2(*point) / (2 * pi) % 1 * len(names) for point in stroke]
        assert len(names) == 1 or {int(turn) for turn in turns} == {int(turns[0])}


def test_no_two_letters_are_drawn_alike() -> None:
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZΓΔΘΛΞΠΣΦΨΩ0123456789.,-/'°:+"
    drawn = {letter: letter_strokes(letter) for letter in letters}
    assert not [pair for pair in combinations(letters, 2) if drawn[pair[0]] == drawn[pair[1]]]
    assert letter_strokes("Α") == letter_strokes("A"), "Greek and Latin share their capitals"
    assert letter_strokes("Ж") == letter_strokes("Ѭ"), "a box"
    for letter in letters:
        strokes, wide = drawn[letter]
        assert all(0 <= x <= wide + 1e-9 and 0 <= y <= 1 for stroke in strokes for x, y in stroke), letter


def test_text_below_the_middle_stands_upright_and_is_not_mirrored() -> None:
    """The bar of a T is above its stem, and the foot of an L is to the right of its stem."""
    bar, foot = curved_text("T", 0.1, 1.0, pi, inwards=True)
    assert bar[0][1] == bar[1][1] > foot[0][1]
    ((top, corner, end),) = curved_text("L", 0.1, 1.0, pi, inwards=True)
    assert end[0] > corner[0] + 0.03
    assert top[1] > corner[1] + 0.09


ANTIKYTHERA = ("freeth-2008", "freeth-2006", "freeth-2021", "freeth-jones-2012", "price-1974", "voulgaris-2024-a")
PRICE_TO_METONIC, SPIRALS = 63.0, 145.5  # mm: from b up to the upper dial (Price), between the spirals (Allen et al.)


def seen(name: str) -> dict[str, tuple[float, float]]:
    """Return the axes of the pointers of a train [mm], to the right and upwards for the reader of each dial."""
    scene, layout = shipped.scene(name), lay_out(shipped.train(name))
    tree = shipped.train(name).kinematics.tree
    found = {}
    for pointer in scene.pointers:
        if pointer.dial is not None and scene.dials[pointer.dial].look == "scale":
            x, y, _ = layout.axes[tree.axis(scene.bodies[pointer.body].id) or ""].point
            # a reader of the front looks along +z, and has -x on the right
            found[scene.dials[pointer.dial].id] = (x if scene.dials[pointer.dial].face == "back" else -x, y)
    return found


@pytest.mark.parametrize("name", ANTIKYTHERA)
def test_pointers_turn_about_the_declared_centres_and_all_wheels_mesh(name: str) -> None:
    train = shipped.train(name)
    assert not lay_out(train).apart
    axes, placed = seen(name), 0
    for dial, at in axes.items():
        centre = train.declaration.dials[dial].centre
        if centre is not None:
            assert at == pytest.approx([1000 * each.si for each in centre], abs=1e-9), dial
            placed += 1
    assert placed >= 4


def test_the_back_has_the_published_distances() -> None:
    axes = seen("freeth-2008")
    assert axes["metonic"] == pytest.approx((0, PRICE_TO_METONIC))
    assert np.subtract(axes["metonic"], axes["saros"]) == pytest.approx((0, SPIRALS))
    games = np.subtract(axes["games"], axes["metonic"])
    # 24.4 mm in Freeth et al. 2008: (57 + 60) / 2 teeth of a module of 0.417 mm
    assert games == pytest.approx(((57 + 60) / 2 * 0.417, 0), abs=1e-9)
    assert np.subtract(axes["callippic"], axes["metonic"]) == pytest.approx(-games)


@pytest.mark.parametrize("name", ["freeth-2008", "price-1974"])
def test_dials_have_their_diameters_and_outer_hands_pass_over_inner_ones(name: str) -> None:
    scene, declared = shipped.built(name), shipped.train(name).declaration.dials
    levels = {scene.dials[each.dial].id: each.level for each in scene.pointers if each.dial is not None}
    for face in scene.dials:
        size = declared[face.id].diameter
        assert size is not None
        assert face.placed
        assert face.radius == pytest.approx(500 * size.si), face.id
        # the scale is engraved on the plate in this size
        assert face.plate > face.radius
    inner = {"freeth-2008": {"games": "metonic", "callippic": "metonic", "exeligmos": "saros"}}
    for small, large in inner.get(name, {"lower small": "lower"}).items():
        assert levels[large] - levels[small] > 1


def test_the_plates_are_upright_rectangles_of_the_size_of_the_case() -> None:
    scene = shipped.built("freeth-2008")
    plates = [part for part in scene.parts if part.kind == "dial"]
    assert len(plates) == 2
    for part in plates:
        edge = np.reshape(part.outlines[0], (-1, 2))
        x, y = part.place[0] + edge[:, 0], part.place[1] + edge[:, 1]
        assert (np.ptp(x), np.ptp(y)) == pytest.approx((180, 330), abs=1e-3)
        assert (x.max() + x.min(), y.max() + y.min()) == pytest.approx((0, -19.5), abs=1e-3)
        assert shapely.Polygon(edge).area > 0.999 * 180 * 330, "corners of 2.5 mm"


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ("axes: {N: {position: [0 mm, 60 mm, 0 mm]}}", "dial 'metonic' is drawn 3 mm from its declared centre"),
        ("outputs: {exeligmos: {dial: saros}}", "dial 'saros' is drawn"),
        ("dials: {draconic: {centre: [9 mm, 0 mm]}}", "dial 'draconic' is drawn"),
        ("dials: {games: {centre: [22 mm, 63 mm]}}", "the pitch circles of 'nO' and 'o1' overlap by 2.39 mm"),
    ],
)
def test_a_centre_that_cannot_be_kept_is_reported(changed: str, said: str) -> None:
    layout = lay_out(geartrain.load(f"name: changed\nextends: voulgaris-2022\n{changed}\n"))
    assert any(said in notice.what for notice in layout.notices)
    assert all(notice.fix for notice in layout.notices)


def test_a_dial_without_a_place_is_computed() -> None:
    assert not any(face.placed for face in shipped.scene("longcase-clock").dials)
    assert {face.id for face in shipped.scene("voulgaris-2022").dials if not face.placed} == {"draconic"}


LEAP = (1, 3, 6, 8, 11, 14, 17)  # assumed in the declaration
MONTHS = (
    *("Phoinikaios", "Kraneios", "Lanotropios", "Machaneus", "Dodekateus", "Eukleios"),
    *("Artemisios", "Psydreus", "Gameilios", "Agrianios", "Panamos", "Apellaios"),
)


def scale_of_shipped(dial: str) -> Any:
    return next(each.scale for each in shipped.scene("freeth-2008").dials if each.id == dial)


def test_the_metonic_dial_reads_years_of_twelve_or_thirteen_months() -> None:
    scale = scale_of_shipped("metonic")
    months = [
        (year, month)
        for year in range(1, 20)
        for month in (*MONTHS[:4], *(["Machaneus"] if year in LEAP else []), *MONTHS[4:])
    ]
    assert len(months) == 235 == 19 * 12 + 7
    for cell, (year, month) in enumerate(months):
        turn = Fraction(2 * cell + 1, 2 * 47)  # 47 months per turn
        assert scale.reading_text(turn) == f"turn {cell // 47 + 1}, year {year}, {month}"


def test_every_engraved_month_is_inside_its_cell() -> None:
    scale = scale_of_shipped("metonic")
    letters = [part for part in engrave(scale) if part.kind == "letters"]
    lines = list(accumulate((len(part.lines) for part in letters), initial=0))
    assert lines[-1] > 235 * 8
    pitch, taken = (1 - 0.55) / 5, set()
    for part in letters:
        points = np.array([point for line in part.lines for point in line])
        x, y = points.mean(axis=0)
        # the coil whose band contains the middle of the text, then the cell by the angle
        turn = atan2(x, y) / (2 * pi) % 1
        coil = next(k for k in range(5) if 0.55 + pitch * (turn + k) >= hypot(x, y))
        cell = int((coil + turn) * 47)
        taken.add(cell)
        for u, v in points:
            own = atan2(u, v) / (2 * pi) % 1 + coil
            assert cell <= own * 47 <= cell + 1, cell
            assert 0 < (0.55 + pitch * own) - hypot(u, v) < pitch, cell
    assert taken == set(range(235))


@pytest.mark.parametrize("dial", ["zodiac", "games", "exeligmos"])
def test_engraved_names_stay_in_their_parts_of_the_ring(dial: str) -> None:
    scale = scale_of_shipped(dial)
    for ring in filter(None, (replace(scale, around=None), scale.around)):
        ends = np.array([float(first / ring.divisions) for _, first, _ in ring.names])
        letters = [line for part in engrave(ring) if part.kind == "letters" for line in part.lines]
        parts = []
        for line in letters:
            x, y = np.array(line).T
            assert np.all(np.hypot(x, y) < ring.outer)
            (part,) = set(np.searchsorted(ends, ring.way * np.arctan2(x, y) / (2 * pi) % 1, side="right"))
            parts.append(part)
        assert len(set(parts)) == sum(bool(name) for name, *_ in ring.names) - (dial == "zodiac" and len(ends) == 13)
