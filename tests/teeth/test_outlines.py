"""Outlines of whole wheels, read back from the files they are written to: sizes, teeth, play, and room in mesh."""

from __future__ import annotations

import csv
import re
from dataclasses import replace
from math import acos, atan2, ceil, cos, hypot, pi, radians, sin, sqrt, tan
from pathlib import Path as File

import numpy as np
import pytest
from commands import call
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain.errors import QuestionError
from geartrain.teeth import BlankSizes, Involute, WheelOutline
from geartrain.teeth.conjugate import ConjugatePair, WheelPair
from geartrain.teeth.outlines import Contour, outline

shapely = pytest.importorskip("shapely")
Points = np.ndarray[tuple[int, int], np.dtype[np.float64]]

MODULE, BACKLASH = 2.0, 0.1  # mm
FINE = ("--module", "2mm", "-p", "backlash=0.1mm", "--blank", "tolerance=0.0001mm")
PAIR = (24, 36, *FINE)

# the tips of both wheels at z = 24, 36, from the pitch point in modules: ends of printed profiles, or textbook sizes
TIPS = {
    "involute": ((0.0, 1.0), (0.0, -1.0)),
    "uniform_stress": ((-0.248733776772, 0.569047300815), (0.249675987356, -0.581800227604)),
    "uniform_temperature": ((-0.179037222126, 0.575180164119), (0.171278261231, -0.578832091546)),
    "least_friction": ((-0.196008996273, 0.457538489540), (0.187693555359, -0.456734822294)),
}
OPTIONS: dict[str, tuple[object, ...]] = {
    "uniform_temperature": ("-p", "heat=0.4"),
    "least_friction": ("-p", "pressure_angle=25deg", "-p", "margin=0.15"),
}


def written(form: str, wheel: int, to: File, *more: object) -> list[Points]:
    """The contours of the file that the command writes."""
    return told(form, wheel, to, *more)[0]


def told(form: str, wheel: int, to: File, *more: object) -> tuple[list[Points], str]:
    """The same, and what the command says."""
    pair = () if more and isinstance(more[0], int) else PAIR
    done = call(
        "mesh", *pair, *more, "--form", form, *OPTIONS.get(form, ()), "--profile", to, "--wheel", wheel, "--force"
    )
    assert done.exit_code == 0, done.output
    return {".svg": from_svg, ".dxf": from_dxf, ".csv": from_csv}[to.suffix](to), done.output


def from_csv(file: File) -> list[Points]:
    rows = list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))
    found: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        found.setdefault(row["contour"], []).append((float(row["x_mm"]), float(row["y_mm"])))
    for points in found.values():
        assert points[0] == points[-1], "a contour ends where it began"
    return [np.array(points[:-1]) for points in found.values()]


def from_dxf(file: File) -> list[Points]:
    ezdxf = pytest.importorskip("ezdxf")
    from ezdxf.path import make_path

    document = ezdxf.readfile(file)
    assert document.units == ezdxf.units.MM
    assert not document.audit().errors
    found = []
    for entity in document.modelspace():
        if entity.dxftype() == "CIRCLE":
            turn = np.linspace(0, 2 * pi, 720, endpoint=False)
            place = np.array([entity.dxf.center.x, entity.dxf.center.y])
            found.append(place + entity.dxf.radius * np.stack([np.cos(turn), np.sin(turn)], axis=1))
            continue
        assert entity.closed
        points = np.array([(p.x, p.y) for p in make_path(entity).flattening(1e-4)])
        assert hypot(*(points[0] - points[-1])) < 1e-9
        found.append(points[:-1])
    return found


def from_svg(file: File) -> list[Points]:
    """Read without a library: a user unit must be a millimetre; y is turned back up."""
    text = file.read_text(encoding="utf-8")
    _, _, width, height = map(float, re.search(r'viewBox="([^"]+)"', text)[1].split())  # type: ignore[index]
    assert f'width="{width:.4f}mm" height="{height:.4f}mm"' in text
    found = []
    for part in re.search(r' d="([^"]+)"', text)[1].split("Z"):  # type: ignore[index]
        points: list[complex] = []
        for letter, numbers in re.findall(r"([MLA])([^MLA]+)", part):
            values = [float(value) for value in numbers.split()]
            end = complex(values[-2], -values[-1])
            if letter == "A":
                points += arc(points[-1], end, values[0], bool(values[3]), not values[4])
            points.append(end)
        if points:
            assert abs(points[0] - points[-1]) < 1e-9
            assert max(abs(z.real) for z in points) <= width / 2
            found.append(np.array([(z.real, z.imag) for z in points[:-1]]))
    return found


def arc(start: complex, end: complex, radius: float, large: bool, left: bool) -> list[complex]:
    """Points between the ends of an elliptical arc command with y up, by W3C's centre rule."""
    middle, half = (start + end) / 2, abs(end - start) / 2
    aside = 1j * (end - start) / abs(end - start) * sqrt(max(radius**2 - half**2, 0.0))
    centre = middle + (aside if left != large else -aside)
    turn = np.angle((end - centre) / (start - centre))
    if left and turn <= 0:
        turn += 2 * pi
    if not left and turn >= 0:
        turn -= 2 * pi
    count = max(2, ceil(abs(turn) / 0.01))
    return [centre + (start - centre) * np.exp(1j * turn * k / count) for k in range(1, count)]


def radii(points: Points) -> Points:
    return np.hypot(points[:, 0], points[:, 1])


def crossings(points: Points, radius: float) -> Points:
    """Azimuths (rad, ascending) at which a contour crosses a circle."""
    r, azimuth = radii(points), np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    r, azimuth = np.append(r, r[0]), np.append(azimuth, azimuth[0] + 2 * pi)
    at = np.flatnonzero((r[:-1] - radius) * (r[1:] - radius) < 0)
    share = (radius - r[at]) / (r[at + 1] - r[at])
    return azimuth[at] + share * (azimuth[at + 1] - azimuth[at])


@pytest.mark.parametrize(
    ("form", "suffix"),
    [*((form, ".dxf") for form in TIPS), ("uniform_stress", ".svg"), ("involute", ".svg"), ("involute", ".csv")],
)
def test_a_wheel_read_back_has_its_tips_teeth_and_thickness(form: str, suffix: str, tmp_path: File) -> None:
    (x1, y1), (x2, y2) = TIPS[form]
    tips = hypot(x1, y1 + 12), hypot(x2, 18 - y2)
    for gear, z in ((1, 24), (2, 36)):
        (teeth,) = written(form, gear, tmp_path / f"w{suffix}")
        assert shapely.Polygon(teeth).is_valid, "the outline crosses itself nowhere"
        r = radii(teeth)
        assert r.max() == pytest.approx(MODULE * tips[gear - 1], abs=2e-6)
        # a quarter of a module under the mate's tip
        assert r.min() == pytest.approx(MODULE * (30 - tips[2 - gear] - 0.25), abs=2e-4)
        cuts = crossings(teeth, z)  # the pitch radius in mm, at module 2
        assert len(cuts) == 2 * z
        widths = np.diff(cuts)
        thick = widths[0::2] if abs(widths[0] - widths[2]) < 1e-5 and _solid(teeth, z, cuts) else widths[1::2]
        assert thick * z == pytest.approx(pi * MODULE / 2 - BACKLASH / 2, abs=5e-4)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_chords_stay_within_the_tolerance_at_the_pitch_circle(tolerance: float, tmp_path: File) -> None:
    """A radial flank and an epicycloid of the mate's half pitch radius, with infinite curvature where they meet."""
    asked = (60, 8, "--module", "1mm", "-p", "backlash=0.1", "--blank", f"tolerance={tolerance}mm")
    for gear, R, rho in ((1, 30.0, 2.0), (2, 4.0, 15.0)):
        outer = shapely.Polygon(written("cycloidal", gear, tmp_path / "w.csv", *asked)[0]).exterior
        turn = np.linspace(0, 0.3, 400) ** 2
        curve = (R + rho) * np.exp(1j * turn * rho / R) - rho * np.exp(1j * turn * (1 + rho / R))
        half = (pi - 0.1) / (4 * R)  # a tooth is half the backlash narrower than half a pitch
        radial = np.linspace(0.995, 1.0, 100) * R * np.exp(1j * half)
        flank = np.concatenate((radial, curve.conj() * np.exp(1j * half)))
        off = outer.distance(shapely.points(flank.real, flank.imag))
        assert off.max() < tolerance


def _solid(teeth: Points, radius: float, cuts: Points) -> bool:
    """True if a tooth lies between the first two crossings."""
    middle = (cuts[0] + cuts[1]) / 2
    return bool(shapely.Polygon(teeth).contains(shapely.Point(radius * cos(middle), radius * sin(middle))))


def solid(contours: list[Points], kind: str) -> shapely.Geometry:
    """The matter of a wheel; of a lantern, its pins."""
    if kind == "pins":
        return shapely.union_all([shapely.Polygon(points) for points in contours[1:]])
    found = shapely.Polygon(contours[0])
    for hole in contours[1:]:
        found = found.difference(shapely.Polygon(hole))
    return found


def turned(points: Points, angle: float, to: float = 0.0) -> Points:
    c, s = cos(angle), sin(angle)
    found: Points = points @ np.array([[c, s], [-s, c]]) + [to, 0.0]
    return found


def moved(first: shapely.Geometry, angle: float, to: float) -> shapely.Geometry:
    return shapely.transform(first, lambda points: turned(points, angle, to))


def seats(z1: int, z2: int, distance: float, internal: bool, phi1: float, more: float = 0.0) -> tuple[float, float]:
    """How the second wheel stands in the plane: its angle, `more` turned on, and the place of its axle."""
    start = pi / z2 if internal else pi + pi / z2
    sense = 1 if internal else -1
    return start + sense * phi1 * z1 / z2 + more, -distance if internal else distance


def free_turn(first: shapely.Geometry, second: shapely.Geometry, seat: tuple[float, float], sense: int) -> float:
    """How far (rad) the second wheel turns from its seat until it touches the first."""
    angle, place = seat
    free, hit = 0.0, 0.01
    for _ in range(30):
        middle = (free + hit) / 2
        if first.intersects(moved(second, angle + sense * middle, place)):
            hit = middle
        else:
            free = middle
    return free


MESHES = {
    "involute": (24, 36),
    "involute with a ring": (24, 60, "--internal"),
    "involute shifted": (12, 37, "-p", "shift=0.4,0"),
    "involute in recess only": (36, 70, "--internal", "-p", "shift=0.696,0.226"),
    "involute in approach only": (60, 40, "-p", "shift=-1.15,1.15"),
    "uniform_stress": (17, 40),
    "uniform_temperature": (24, 36, "-p", "reading=c"),
    "least_friction": (24, 36),
    "cycloidal": (8, 48),
    "lantern": (40, 10),
    "lantern that drives": (10, 40, "-p", "pins=1"),
}


@pytest.mark.parametrize("name", MESHES)
def test_two_wheels_turn_through_a_pitch_untouched_with_the_backlash_between_them(name: str, tmp_path: File) -> None:
    form, options = name.split()[0], MESHES[name]
    z1, z2 = int(str(options[0])), int(str(options[1]))
    internal = "--internal" in options
    more = (*options, *FINE)
    one, title = told(form, 1, tmp_path / "1.csv", *more, "--json")
    contours = [one, written(form, 2, tmp_path / "2.csv", *more)]
    pins = 0 if form != "lantern" else 1 if "pins=1" in options else 2
    first, second = (solid(contours[gear - 1], "pins" if gear == pins else "teeth") for gear in (1, 2))
    distance = float(re.search(r'"centre_distance": ([\d.]+)', title)[1])  # type: ignore[index]
    # more than three pitches either side of the pitch point are enough, and quick
    R2 = distance * z2 / (z2 - z1 if internal else z1 + z2)
    R1 = R2 * z1 / z2
    near = shapely.box(R1 - 12, -20, R1 + 12, 20)
    angle, place = seats(z1, z2, distance, internal, 0.0)
    first = first.intersection(near)
    second = shapely.transform(
        moved(second, angle, place).intersection(near), lambda points: turned(points - [place, 0.0], -angle)
    )
    shapely.prepare(first)
    pitch = 2 * pi / z1
    for phi1 in np.linspace(0, pitch, 200, endpoint=False):
        angle, place = seats(z1, z2, distance, internal, phi1)
        # in the frame of the first wheel, which was made ready once
        there = moved(moved(second, angle, place), -phi1, 0.0)
        assert not first.intersects(there), phi1
    for phi1 in pitch * np.array([0.1, 0.55]):
        here = moved(first, phi1, 0.0)
        seat = seats(z1, z2, distance, internal, phi1)
        backlash = sum(free_turn(here, second, seat, sense) for sense in (1, -1))
        assert backlash * R2 == pytest.approx(BACKLASH, rel=0.02)


def involute(z1: int, z2: int, approach: float, recess: float, psi: float, backlash: float) -> ConjugatePair:
    """Arcs in pitches, psi in deg, backlash in modules."""
    pair = Involute.pair_of_arcs(WheelPair(z1, z2), (approach, recess), {"pressure_angle": f"{psi!r} deg"})
    half = (pi - backlash) / 4
    return replace(pair, halves=(half, half))


def points_of(wheel: WheelOutline) -> list[Points]:
    return [contour.flattened(1e-4) for contour in wheel.contours]


@given(st.integers(18, 90), st.integers(18, 90), st.floats(16, 28), st.floats(0.3, 0.7), st.floats(0, 1))
@settings(max_examples=20, deadline=None)
def test_involutes_have_textbook_tips_and_clear(z1: int, z2: int, psi: float, approach: float, phase: float) -> None:
    recess = 1.1 - approach
    pair = involute(z1, z2, approach, recess, psi, 0.08)
    pitch = pair.path.pitch
    limits = (z1 / 2 * tan(radians(psi)), z2 / 2 * tan(radians(psi)))
    if approach * pi > 0.98 * limits[0] or recess * pi > 0.98 * limits[1] or pair.faults:
        return
    wheels = [outline(pair, gear, BlankSizes()) for gear in (1, 2)]
    for wheel, R, arc_ in ((wheels[0], pitch.R1, recess), (wheels[1], pitch.R2, approach)):
        length = R * sin(radians(psi)) + arc_ * pi * cos(radians(psi))  # on the line of action, from its touching point
        assert wheel.tip_radius == pytest.approx(hypot(R * cos(radians(psi)), length), rel=1e-12)
    first, second = (solid(points_of(wheel), "teeth") for wheel in wheels)
    assert first.is_valid
    assert second.is_valid
    phi1 = phase * 2 * pi / z1
    seat = seats(z1, z2, wheels[0].centre_distance, False, phi1)
    assert not moved(first, phi1, 0.0).intersects(moved(second, *seat))


def test_the_root_is_rounded_by_the_fillet_requested_for(tmp_path: File) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    written("involute", 1, tmp_path / "w.dxf", "--blank", "fillet=0.3mm")
    (teeth,) = ezdxf.readfile(tmp_path / "w.dxf").modelspace()
    points = list(teeth.get_points("xyb"))
    found = set()
    for (x, y, bulge), (u, v, _) in zip(points, [*points[1:], points[0]], strict=True):
        if bulge:
            found.add(round(hypot(u - x, v - y) * (1 + bulge**2) / (4 * abs(bulge)), 6))
    # rounds, and arcs of the root circle and of the tip circle
    assert found == {0.3, 21.5, 26.0}


def test_a_fillet_that_does_not_fit_is_refused_with_the_largest_that_does() -> None:
    pair = involute(24, 36, 0.6, 0.6, 20, 0.0)
    with pytest.raises(QuestionError) as caught:
        outline(pair, 1, BlankSizes(fillet=1.5))
    (problem,) = caught.value.problems
    most = float(re.search(r"at most ([\d.]+) mm", problem.fix)[1])  # type: ignore[index]
    assert outline(pair, 1, BlankSizes(fillet=0.999 * most)).fillet == pytest.approx(0.999 * most)
    with pytest.raises(QuestionError):
        outline(pair, 1, BlankSizes(fillet=1.01 * most))


def test_a_ring_has_its_teeth_inwards_and_a_rim(tmp_path: File) -> None:
    outer, teeth = written(
        "involute", 2, tmp_path / "r.dxf", 24, 60, "--internal", "--module", "2mm", "--blank", "rim=5mm"
    )
    r = radii(teeth)
    assert r.min() == pytest.approx(60 - 2, abs=1e-4)
    assert r.max() == pytest.approx(60 + 2.5, abs=1e-4)
    assert radii(outer) == pytest.approx(60 + 2.5 + 5, abs=1e-3)
    assert len(crossings(teeth, 60)) == 120


def test_a_lantern_is_a_disc_with_a_hole_for_each_pin(tmp_path: File) -> None:
    disc, *holes, bore = written(
        *("lantern", 2, tmp_path / "l.csv", 40, 10, "--module", "2mm"),
        *("--blank", "bore=4mm", "--blank", "rim=1mm", "-p", "pin_diameter=3mm"),
    )
    assert len(holes) == 10
    for hole in holes:
        centre = hole.mean(axis=0)
        assert hypot(*centre) == pytest.approx(10, abs=1e-2)
        assert radii(hole - centre).max() == pytest.approx(1.5, abs=5e-3)
    assert radii(disc).max() == pytest.approx(10 + 1.5 + 1, abs=1e-5)
    assert radii(bore).max() == pytest.approx(2, abs=1e-5)


def test_chords_leave_a_flank_by_no_more_than_the_tolerance() -> None:
    pair = involute(24, 36, 0.8, 0.8, 20, 0.0)
    for tolerance in (0.01, 0.001, 0.0001):
        (teeth,) = outline(pair, 1, BlankSizes(tolerance=tolerance)).contours
        flank = teeth.points[np.abs(np.arctan2(teeth.points[:, 1], teeth.points[:, 0])) < pi / 24]
        flank = flank[(flank[:, 1] > 0) & (radii(flank) > 11.5)]
        middles = (flank[1:] + flank[:-1]) / 2
        r = radii(middles)
        # the involute through the pitch circle, half a tooth off the x axis
        base = 12 * cos(radians(20))
        roll = np.sqrt((r / base) ** 2 - 1)
        start = pi / 48 + tan(radians(20)) - radians(20)
        true = start - (roll - np.arctan(roll))
        off = np.abs(np.arctan2(middles[:, 1], middles[:, 0]) - true) * r
        assert off.max() < 1.1 * tolerance
        assert len(flank) < 30 + 0.6 / sqrt(tolerance)


@given(st.floats(-2.5, 2.5).filter(lambda b: abs(b) > 1e-3), st.floats(1e-5, 1e-2))
def test_an_arc_is_flattened_on_its_circle(bulge: float, tolerance: float) -> None:
    contour = Contour.of([(0.0, 0.0, bulge), (1.0, 0.0, 0.0), (0.5, 3.0, 0.0)])
    points = contour.flattened(tolerance)[:-2]
    sweep = 4 * np.arctan(bulge)
    radius = 1 / (2 * abs(sin(sweep / 2)))
    centre = np.array([0.5, 0.5 / tan(sweep / 2)])
    assert radii(points - centre) == pytest.approx(radius, rel=1e-9)
    if len(points) > 1:
        half = np.hypot(*(points[1] - points[0])) / 2
        assert radius - sqrt(max(radius**2 - half**2, 0.0)) <= 1.01 * tolerance or len(points) == 2
        assert atan2(points[1][1], points[1][0]) * bulge < 0, "a positive bulge turns left, below its chord"
    assert acos(max(-1.0, 1 - tolerance / radius)) > 0


def test_a_circle_as_wide_as_a_country_has_a_bounded_number_of_points() -> None:
    found = Contour.circle(4e11).flattened(0.01)
    assert len(found) == 65536
    assert np.hypot(*found.T) == pytest.approx(4e11, rel=1e-14)
    assert len(Contour.circle(1e5).flattened(0.01)) == pytest.approx(pi / acos(1 - 0.01 / 1e5), rel=1e-3)
