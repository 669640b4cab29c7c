"""Dials at declared places: axes of pointers, sizes, hands above each other, rectangular plates and engraved months."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import accumulate
from math import atan2, hypot, pi
from typing import Any

import numpy as np
import pytest
import shapely
import shipped

import geartrain
from geartrain.scene import lay_out
from geartrain.scene.dial_scale import engrave

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
MONTHS = [
    "Phoinikaios",
    "Kraneios",
    "Lanotropios",
    "Machaneus",
    "Dodekateus",
    "Eukleios",
    "Artemisios",
    "Psydreus",
    "Gameilios",
    "Agrianios",
    "Panamos",
    "Apellaios",
]


def scale_of(dial: str) -> Any:
    return next(each.scale for each in shipped.scene("freeth-2008").dials if each.id == dial)


def test_the_metonic_dial_reads_years_of_twelve_or_thirteen_months() -> None:
    scale = scale_of("metonic")
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
    scale = scale_of("metonic")
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
    scale = scale_of(dial)
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
