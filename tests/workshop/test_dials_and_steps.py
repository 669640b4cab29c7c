"""Dial plates, read back mark by mark, and the steps by which a mechanism is put together."""

from __future__ import annotations

import io
import re
from itertools import pairwise
from math import atan2, hypot, pi
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
import shapely
from workpieces import part_rows, steps, workpiece

import geartrain
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files


def engraved(work: SolidModel, file: str) -> list[list[tuple[float, float]]]:
    """Lines of a written drawing, y upwards."""
    (found,) = [each for each in export_files(work, ["svg"]) if each.path == f"plates/{file}.svg"]
    (drawn,) = re.findall(r'<path fill="none" stroke="#c02020"[^>]* d="([^"]*)"', found.make().decode())
    lines = [re.findall(r"(-?[\d.]+) (-?[\d.]+)", line) for line in drawn.split("M ") if line]
    return [[(float(x), -float(y)) for x, y in line] for line in lines]


def about(work: SolidModel, lines: list[list[tuple[float, float]]], dial: str) -> list[list[tuple[float, float]]]:
    """Lines of one dial, counted from its middle, where its reader has it from that of the plate's first dial."""
    (plate,) = [each for each in work.dials if any(dial in circle.scales for circle in each.circles)]
    faces = {face.id: face for face in work.scene.dials}
    own, first = faces[dial], faces[next(iter(plate.circles[0].scales))]
    away, right = np.subtract(own.centre, first.centre), np.cross(own.zero, own.normal)
    x, y = float(away @ right), float(away @ np.array(own.zero))
    radius = next(circle.radius for circle in plate.circles if dial in circle.scales)
    moved = [[(u - x, v - y) for u, v in line] for line in lines]
    return [line for line in moved if hypot(*line[0]) <= radius]


def clockwise(point: tuple[float, float]) -> float:
    """Turns from above."""
    return (atan2(*point) / (2 * pi)) % 1


def test_the_dial_of_a_clock_has_sixty_minutes_and_twelve_hours_engraved_as_strokes() -> None:
    work = workpiece("longcase-clock-cycloidal")
    lines = about(work, engraved(work, "dial-minutes-and-hours-and-seconds"), "minutes")
    outer, inner = sorted({round(hypot(*line[0]), 2) for line in lines if len(line) > 80}, reverse=True)
    for radius, count in ((outer, 60), (inner, 12)):
        marks = [line[0] for line in lines if len(line) == 2 and hypot(*line[0]) == pytest.approx(radius, abs=0.01)]
        assert sorted(map(clockwise, marks)) == pytest.approx([k / count for k in range(count)], abs=1e-4)
    strokes = [line for line in lines if max(hypot(*point) for point in line) < 0.95 * inner - 1e-6]
    near = [line for line in strokes if abs(sum(x for x, _ in line) / len(line)) < 0.2 * inner and line[0][1] > 0]
    assert len(near) == 4, "XII: two strokes of the X, two of the I"


def test_the_metonic_spiral_has_235_months_in_five_turns() -> None:
    work = workpiece("freeth-2008")
    lines = about(work, engraved(work, "dial-metonic-and-games-and-callippic-and-saros-and-exeligmos"), "metonic")
    radial = [line for line in lines if len(line) == 2 and abs(clockwise(line[0]) - clockwise(line[1])) < 1e-4]
    # a turn is 6.57 mm wide: (1 - 0.55) / 5 of a radius of 73 mm; strokes of letters are shorter
    marks = sorted((line[0] for line in radial if hypot(*line[0]) - hypot(*line[1]) > 6), key=lambda mark: hypot(*mark))
    assert len(marks) == 236, "the last cell has an end too"
    assert [clockwise(mark) for mark in marks] == pytest.approx([5 * k / 235 % 1 for k in range(236)], abs=1e-4)
    radii = [hypot(*mark) for mark in marks]
    steps = [after - before for before, after in pairwise(radii)]
    assert steps == pytest.approx([(radii[-1] - radii[0]) / 235] * 235, abs=2e-4)


def test_arbors_go_through_the_dials_on_which_they_are_read() -> None:
    for name in ("longcase-clock-cycloidal", "freeth-2008"):
        work = workpiece(name)
        parts = {part.name: part for part in work.parts}
        assert work.dials
        for dial in work.dials:
            plate = parts[dial.name].placed.vertices
            low, high = plate[:, 2].min(), plate[:, 2].max()
            for circle in dial.circles:
                near = [part for part in parts.values() if hypot(*(part.place[:2] - np.array(circle.at))) < 1e-6]
                heights = {part.name: part.placed.vertices[:, 2] for part in near if part.kind in ("arbor", "pipe")}
                rods = [parts[name] for name, z in heights.items() if z.min() < low and z.max() > high]
                assert rods, f"nothing reaches {list(circle.scales)}"
                assert all(part.turned is not None and part.turned.diameter < circle.hole for part in rods)


_UNSIZED = ", ".join(
    f"{name}: {{diameter: null}}" for name in ["zodiac", "metonic", "games", "callippic", "saros", "exeligmos"]
)


@pytest.mark.parametrize("name", ["freeth-2008", "voulgaris-2024-a"])
def test_the_edge_of_a_dial_passes_the_wheel_of_the_crank(name: str) -> None:
    """The feet are outside the dials; the edge of the plate between them passed through the crown wheel."""
    train = geartrain.load(f"name: unsized\nextends: {name}\ndial_plate: null\ndials: {{{_UNSIZED}}}\n")
    work = SolidModel(train, ManufacturingSizes())
    (plate,) = (each for each in work.parts if each.name.startswith("dial zodiac") and each.kind == "plate")
    (crown,) = (each for each in work.parts if each.name == "a1")
    x, y, z = crown.placed.vertices.T
    low, high = plate.placed.vertices[:, 2].min(), plate.placed.vertices[:, 2].max()
    assert z.min() < low < high < z.max(), "it reaches through the height of the plate"
    edge = shapely.MultiPoint(plate.placed.vertices[:, :2]).convex_hull
    assert edge.area > 1e4
    assert edge.distance(shapely.box(x.min(), y.min(), x.max(), y.max())) > 0.1


def test_a_dxf_has_the_engraving_on_its_layer_as_open_lines() -> None:
    work = workpiece("longcase-clock-cycloidal")
    (found,) = [each for each in export_files(work, ["dxf"]) if each.path.endswith("and-seconds.dxf")]
    space = ezdxf.read(io.StringIO(found.make().decode())).modelspace()
    lines = [each for each in space.query("LWPOLYLINE") if each.dxf.layer == "ENGRAVE"]
    assert len(lines) == len(engraved(work, "dial-minutes-and-hours-and-seconds")) > 60 + 60 + 12 + 3, "and numerals"
    assert not any(line.closed for line in lines)


# --------------------------------------------------------------------------------------------------------------- steps


@pytest.mark.parametrize("name", ["longcase-clock-cycloidal", "freeth-2008", "wolfrom-175", "ravigneaux-set"])
def test_every_part_comes_in_by_some_step(name: str) -> None:
    work = workpiece(name)
    came = [part for step in steps(work) for part in step.parts]
    assert work.frame is not None
    across = set(work.layout.wheels) - {disc.name for disc in work.frame.plan.discs}
    bearingless = {part.name for part in work.parts if part.turned is not None and part.kind == "arbor"} - set(came)
    assert {part.name for part in work.parts} - set(came) == across | bearingless
    assert bearingless <= {f"{work.layout.wheels[wheel].link} arbor" for wheel in across}


def test_steps_have_pictures_that_name_what_comes_in() -> None:
    work = workpiece("planetary-24-18-60")
    files = {each.path: each for each in export_files(work, ["svg"])}
    found = steps(work)
    readme = files["README.md"].make().decode()
    for number, step in enumerate(found, 1):
        path = f"assembly/{number:02d}.svg"
        assert (path in files) == bool(step.parts)
        assert f"{number}. {step.text}" in readme
        if step.parts:
            assert f"([picture]({path}))" in readme
            root = ElementTree.fromstring(files[path].make())
            told = [each.text for each in root.iter("{http://www.w3.org/2000/svg}text")]
            assert set(step.parts) <= set(told)


def test_a_clock_is_made_with_its_barrel_its_pendulum_and_its_weight() -> None:
    """A weight of 5.9 kg of lead, a rod and a bob that are 994 mm from their cock; no picture is a metre high."""
    work = workpiece("longcase-clock")
    rows = part_rows(work)
    assert (rows["weight"]["material"], float(rows["weight"]["mass_g"])) == ("lead", pytest.approx(5900, rel=1e-3))
    assert rows["great barrel"]["size_mm"].startswith("diameter 50.8,")
    parts = {part.name: part for part in work.parts}
    hung = parts["pendulum rod"].place - parts["pendulum bob"].place
    assert np.linalg.norm(hung) == pytest.approx(994)
    plates, cock = (parts["plates back plate"], parts["plates front plate"]), parts["pendulum cock"].place[:2]
    holes = [contour.points + plate.place[:2] - cock for plate in plates for contour in plate.contours[1:]]
    radii = [hole[:, 0].max() for hole in holes if np.hypot(*hole.mean(axis=0)) < 1e-6]
    assert radii == [pytest.approx(1.2, abs=0.05)], "a hole in one plate for its tenon"
    pictures = [each.make().decode() for each in export_files(work, ["svg"]) if re.match("assembly/.*svg", each.path)]
    heights = [int(re.search(r'height="(\d+)"', each).group(1)) for each in pictures]  # type: ignore[union-attr]
    assert max(heights) < 1200
