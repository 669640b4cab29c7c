"""Reducers as they are made: what is written of them is read back and turned by hand, apart from what wrote it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from math import cos, hypot, pi, sin
from typing import Any

import numpy as np
import pytest
import shapely
from sampling import all_but
from shapely.affinity import affine_transform, rotate, translate
from workpieces import outlines, workpiece

import geartrain
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files
from geartrain.workshop.export.proof import TrainProof, overlaps, prove_train, read_wheels

Point = tuple[float, float]


@cache
def proof(name: str) -> TrainProof:
    return prove_train(workpiece(name))


@cache
def written(name: str) -> dict[str, list[list[Point]]]:
    """Closed lines (mm) of every drawing that is written of a train."""
    files = export_files(workpiece(name), ["svg"])
    flat = (each for each in files if each.path.startswith(("wheels/", "plates/")))
    return {each.path.partition("/")[2].removesuffix(".svg"): outlines(each.make().decode()) for each in flat}


@dataclass(frozen=True)
class Circle:
    x: float
    y: float
    diameter: float

    @classmethod
    def of(cls, line: list[Point]) -> Circle | None:
        points = np.array(line)
        middle = shapely.Polygon(line).centroid
        away = np.hypot(points[:, 0] - middle.x, points[:, 1] - middle.y)
        return cls(middle.x, middle.y, 2 * away.mean()) if np.ptp(away) < 1e-4 else None


def circles(name: str, drawing: str) -> list[Circle]:
    return [found for line in written(name)[drawing] if (found := Circle.of(line))]


def part(name: str, of: str) -> Any:
    return next(each for each in workpiece(name).parts if each.name == of)


def parts(name: str, start: str) -> list[Any]:
    return [each for each in workpiece(name).parts if each.name.startswith(start) and each.kind == "pin"]


def in_place(name: str, of: str, drawing: str) -> shapely.Polygon:
    """A drawn part in its place in the zero pose, seen along z."""
    made, (outer, *holes) = part(name, of), sorted(written(name)[drawing], key=lambda line: -shapely.Polygon(line).area)
    (a, b), (c, d), (x, y) = made.turn[0, :2], made.turn[1, :2], made.place[:2]
    return affine_transform(shapely.Polygon(outer, holes), [a, b, c, d, x, y])


def middles(name: str, start: str) -> tuple[shapely.MultiPoint, float]:
    """Of pins in the zero pose, seen along z, and their radius."""
    pins = parts(name, start)
    radii = {each.turned.diameter / 2 for each in pins if each.turned}
    assert len(radii) == 1
    return shapely.MultiPoint([each.place[:2] for each in pins]), radii.pop()


def gaps(disc: shapely.Polygon, pins: tuple[shapely.MultiPoint, float]) -> list[float]:
    """Between a disc and round pins that do not reach beyond it with their middles."""
    return [disc.distance(middle) - pins[1] for middle in pins[0].geoms]


REDUCERS = ("cycloidal-reducer", "rv-reducer", "strain-wave")


@pytest.mark.parametrize("name", all_but({"rv-reducer"}, REDUCERS))
def test_a_reducer_is_ready_to_cut(name: str) -> None:
    assert proof(name).verdict == "ready to cut", [str(each.problem.what) for each in proof(name).findings]
    assert all(mesh.minimum > 0 for mesh in proof(name).meshes)


def test_the_eccentric_is_drawn_as_far_out_of_the_middle_as_half_a_module() -> None:
    disc, hole = sorted(circles("cycloidal-reducer", "shaft-eccentric"), key=lambda each: -each.diameter)
    assert hypot(disc.x - hole.x, disc.y - hole.y) == pytest.approx(1.5, abs=1e-6)
    arbor = part("cycloidal-reducer", "shaft arbor").turned
    assert arbor is not None
    assert hole.diameter == pytest.approx(arbor.diameter, abs=1e-4), "fixed on its arbor"
    bore = min(circles("cycloidal-reducer", "lobes"), key=lambda each: hypot(each.x, each.y))
    assert bore.diameter - disc.diameter == pytest.approx(0.08, abs=1e-4), "the disc turns on it with a running fit"


def test_pins_of_the_ring_stand_in_holes_on_their_circle() -> None:
    holes = [each for each in circles("cycloidal-reducer", "frame-back-plate") if abs(each.diameter - 6) < 1e-3]
    assert len(holes) == 12
    assert [hypot(each.x, each.y) for each in holes] == pytest.approx([25.0] * 12, abs=1e-6)
    angles = sorted(np.arctan2(each.y, each.x) for each in holes)
    assert np.diff(angles) == pytest.approx([pi / 6] * 11, abs=1e-6)
    pins = {(round(each.place[0], 5), round(each.place[1], 5)) for each in parts("cycloidal-reducer", "ring pin")}
    assert pins == {(round(each.x, 5), round(each.y, 5)) for each in holes}


def test_the_disc_passes_all_pins_with_backlash_wherever_its_eccentric_stands() -> None:
    disc = in_place("cycloidal-reducer", "lobes", "lobes")
    ring, flange = (middles("cycloidal-reducer", f"{which} pin") for which in ("ring", "holes"))
    assert (len(ring[0].geoms), len(flange[0].geoms)) == (12, 6)
    # it touches its pins at the start; turned back by half its backlash it is free of all
    back = max(np.linspace(-0.3, 0.3, 61), key=lambda each: min(gaps(rotate(disc, each, origin=(1.5, 0)), ring)))
    assert abs(back) == pytest.approx(np.degrees(0.15 / 16.5) / 2, abs=0.01)
    solid = shapely.Polygon(disc.exterior)
    for turn in np.linspace(0, 11, 89):  # turns of the shaft: the disc and the flange come round once, backwards
        own, e = back - 360 * turn / 11, np.array([1.5 * cos(2 * pi * turn), 1.5 * sin(2 * pi * turn)])
        turned = translate(rotate(disc, own, origin=(1.5, 0)), e[0] - 1.5, e[1])
        assert 0.07 < min(gaps(turned, ring)) < 0.08, "a lobe stands 0.075 mm back from every pin"
        outline = translate(rotate(solid, own, origin=(1.5, 0)), e[0] - 1.5, e[1])
        carried = rotate(flange[0], own, origin=(0, 0))
        assert outline.contains(carried)
        assert gaps(turned, (carried, flange[1])) == pytest.approx([0.04] * 6, abs=1e-3), "half of the running fit"
    assert min(gaps(translate(disc, 0.2, 0), ring)) < -0.1, "on a wrong eccentric it would run into its pins"


@pytest.mark.parametrize(
    ("name", "axis", "drawn"),
    [
        ("cycloidal-reducer", (0.0, 0.0), ("frame-back-plate", "frame-front-plate", "flange-plate", "shaft-eccentric")),
        ("rv-reducer", (0.0, 0.0), ("frame-back-plate", "frame-front-plate", "output-carrier-plate")),
        ("rv-reducer", (27.0, 0.0), ("output-carrier-plate", "crank-eccentric")),
        ("rv-reducer", (-13.5, 27 * sin(2 * pi / 3)), ("output-carrier-plate", "crank.2-eccentric")),
    ],
)
def test_holes_for_a_shaft_are_above_each_other_in_all_plates(name: str, axis: Point, drawn: tuple[str, ...]) -> None:
    for drawing in drawn:
        made = part(name, drawing.replace("-", " "))
        found = [made.turn[:2, :2] @ (each.x, each.y) + made.place[:2] for each in circles(name, drawing)]
        assert min(hypot(x - axis[0], y - axis[1]) for x, y in found) < 1e-6, drawing


def test_every_part_of_a_reducer_is_in_its_list_and_in_a_step() -> None:
    files = {each.path: each for each in export_files(workpiece("cycloidal-reducer"), ["svg"])}
    listed = files["parts.csv"].make().decode()
    for name in ("shaft eccentric", "flange plate", "ring pin 12", "holes pin 6", "shaft eccentric washer 2"):
        assert name in listed
    guide = files["README.md"].make().decode()
    for step in ("Put lobes on shaft eccentric", "Press the pins of 'holes' into flange plate", "and pins of rings"):
        assert step in guide


def test_all_cranks_bear_the_disc_side_by_side_wherever_they_stand() -> None:
    name = "rv-reducer"
    holes = [each for each in circles(name, "lobes") if abs(each.diameter - 11.08) < 1e-3]
    disc, middle = part(name, "lobes"), np.array([1.0, 0.0])
    assert len(holes) == 3
    for number, crank in enumerate(("crank", "crank.2", "crank.3")):
        turn = 2 * pi * number / 3
        place = 27 * np.array([cos(turn), sin(turn)])
        round_, bore = sorted(circles(name, f"{crank}-eccentric"), key=lambda each: -each.diameter)
        made = part(name, f"{crank} eccentric")
        centre, arbor = (made.turn[:2, :2] @ (each.x, each.y) + made.place[:2] for each in (round_, bore))
        assert arbor == pytest.approx(place, abs=1e-6)
        assert centre - arbor == pytest.approx(middle, abs=1e-6), "as far out as the disc, and the same way"
        # each stays in its hole while all turn alike, because the holes are on the circle of the cranks
        found = [disc.turn[:2, :2] @ (each.x, each.y) + disc.place[:2] for each in holes]
        assert min(np.hypot(*(each - centre)) for each in found) < 1e-6
        assert round_.diameter == pytest.approx(11.0, abs=1e-4)


def test_pins_of_a_carrier_stand_midway_between_its_cranks() -> None:
    places = [each.place for each in parts("rv-reducer", "holes pin")]
    pins = sorted(np.degrees(np.arctan2(y, x)) % 360 for x, y, _ in places)
    assert pins == pytest.approx([60, 180, 300], abs=1e-6)


def test_two_discs_stand_opposite_each_other_and_share_pins_and_load() -> None:
    text = geartrain.shipped()["cycloidal-reducer"].read_text(encoding="utf-8")
    train = geartrain.load(text.replace("disc:   {wheels", "disc:   {copies: 2, wheels"))
    assert train.solve().speeds == geartrain.load("cycloidal-reducer").solve().speeds
    assert not [each for each in train.build_findings if each.is_error]
    torques = train.torques()
    for pair in ("lobes~ring", "lobes.2~ring"):
        assert float(torques.pairs[pair].torques[0]) == pytest.approx(-5.0, rel=1e-9), "half of what leaves"
    model = SolidModel(train, ManufacturingSizes())
    named = {each.name: each for each in model.parts}
    first, second = (named[f"shaft eccentric{end}"] for end in ("", " 2"))
    assert first.place[:2] == pytest.approx([1.5, 0.0], abs=1e-9)
    assert second.place[:2] == pytest.approx([-1.5, 0.0], abs=1e-9), "so that they balance"
    assert abs(first.place[2] - second.place[2]) > 8, "beside each other along the shaft"
    pins = [each for each in model.parts if each.name.startswith("holes")]
    assert len(pins) == 6, "one set for both discs"
    low, high = (end(named[disc].placed.vertices[:, 2]) for disc, end in (("lobes", np.min), ("lobes.2", np.max)))
    for each in pins:
        assert each.placed.vertices[:, 2].min() < low + 1e-6
        assert each.placed.vertices[:, 2].max() > high
    for disc in ("lobes", "lobes.2"):
        flat = named[disc]
        holes = [contour.points.mean(axis=0) for contour in flat.contours if contour.is_circle]
        found = [flat.turn[:2, :2] @ hole + flat.place[:2] for hole in holes if np.hypot(*hole) > 1]
        for each in pins:
            assert min(hypot(*(hole - each.place[:2])) for hole in found) == pytest.approx(1.5, abs=1e-6)


# ------------------------------------------------------------------------------------------------------------- a wave


def bent(line: np.ndarray, turn: float, rise: float = 1.0) -> np.ndarray:
    """Points of a ring of 200 teeth in one of 202 while a wave is at `turn`, by steps along the middle line.

    The line is bent to the curve R + rise cos 2(t - turn); places on it keep their distances, which are added up, and
    what lies beside it stays across it.
    """
    middle, t = 97.9, np.linspace(0, 2 * pi, 40001)
    curve = (middle + rise * np.cos(2 * (t - turn))) * np.exp(1j * t)
    run = np.concatenate([[0.0], np.cumsum(abs(np.diff(curve)))])
    run *= 2 * pi / run[-1]
    # a symmetric wave leaves its own four axes where they are
    run += turn - np.interp(turn, t, run)
    angle = np.angle(line @ np.array([1, 1j])) - 2 * turn / 200
    at = np.interp(
        angle,
        np.concatenate([run - 2 * pi, run[1:], run[1:] + 2 * pi]),
        np.concatenate([t - 2 * pi, t[1:], t[1:] + 2 * pi]),
    )
    foot = (middle + rise * np.cos(2 * (at - turn))) * np.exp(1j * at)
    along = (1j * (middle + rise * np.cos(2 * (at - turn))) - 2 * rise * np.sin(2 * (at - turn))) * np.exp(1j * at)
    points = foot + (np.hypot(*line.T) - middle) * -1j * along / abs(along)
    return np.column_stack([points.real, points.imag])


def many(line: list[Point]) -> np.ndarray:
    points = np.array(line)
    points = points[:-1] if np.allclose(points[0], points[-1]) else points
    after = np.roll(points, -1, axis=0)
    return np.stack([points + (after - points) * k / 4 for k in range(4)], axis=1).reshape(-1, 2)


def by_size(drawing: str) -> list[list[Point]]:
    return sorted(written("strain-wave")[drawing], key=lambda line: -shapely.Polygon(line).area)


def test_a_thin_wheel_bent_by_its_wave_passes_its_ring_with_backlash() -> None:
    teeth, (_, ring) = by_size("spline")[0], by_size("ring")[:2]
    around = rotate(shapely.Polygon(ring), 180 / 202, origin=(0, 0))
    gaps = []
    for turn in np.linspace(0, 2 * pi / 202, 9):
        wheel = shapely.Polygon(bent(many(teeth), turn))
        assert around.contains(wheel)
        gaps.append(around.exterior.distance(wheel))
    assert 0.005 < min(gaps) < 0.05 / 2, "0.05 mm of play, along both flanks"
    assert not around.contains(shapely.Polygon(bent(many(teeth), 0.0, 0.0))), "no round wheel goes in"
    assert not around.contains(shapely.Polygon(bent(many(teeth), 0.0, 1.2)))


def test_the_wave_is_as_long_as_the_bore_of_the_wheel_that_it_bends() -> None:
    wave = shapely.Polygon(by_size("generator-wave")[0])
    low, bottom, high, top = wave.bounds
    # it rises by 1 mm, and falls by as much
    assert (high - low) / 2 - (top - bottom) / 2 == pytest.approx(2.0, abs=0.01)
    bore = min(circles("strain-wave", "spline"), key=lambda each: each.diameter)
    # the inside of a ring that is bent without stretching is as long as before but for the square of its bend
    assert wave.length == pytest.approx(pi * (bore.diameter - 0.08), rel=3e-4)


def test_a_flexible_cup_is_no_obstacle_and_is_told() -> None:
    told = [each.problem.what for each in proof("strain-wave").findings]
    assert any("'spline' and the wall of 'cup' are one thin part" in each for each in told)
    wall, wheel, bottom = (
        part("strain-wave", name).placed.vertices[:, 2] for name in ("cup wall", "spline", "cup plate")
    )
    assert wall.min() == pytest.approx(wheel.max(), abs=1e-6)
    assert wall.max() == pytest.approx(bottom.min(), abs=1e-6)


def test_a_wave_that_does_not_bend_the_wheel_into_its_ring_is_seen() -> None:
    model = workpiece("strain-wave")
    assert model.frame is not None
    (wave,) = model.frame.plan.stack.eccentrics
    cut = read_wheels(model).materials
    assert max(overlaps(model, wave, cut["spline"], ("ring", cut["ring"]))) == 0
    assert wave.wave is not None
    flat = replace(wave, wave=replace(wave.wave, rise=0.5))
    assert min(overlaps(model, flat, cut["spline"], ("ring", cut["ring"]))) > 0.1
