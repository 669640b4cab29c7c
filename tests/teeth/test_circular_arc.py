"""Circular-arc clock teeth: the standard's tables, polygons that touch where the law says, one file for all else."""

from __future__ import annotations

import re
from math import asin, atan2, cos, hypot, isclose, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
import shipped
from commands import call
from models import PAIR
from shapely import affinity, prepare
from shapely.geometry import Polygon

import geartrain
from geartrain import GearTrain, load
from geartrain.errors import GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.teeth import CircularArc

FORM = CircularArc.declared({})

# Wheel addendum and radius of its arc in modules, by leaves and ratio: tables of BS 978 Part 2 as M. Robinson's library
# for OpenSCAD (2016) transcribes them.
RATIOS = (3, 4, 5, 6, 7.5, 10, 12)
TABLE = {
    6: ((1.259, 1.280, 1.293, 1.303, 1.313, 1.322, 1.328), (1.855, 1.886, 1.906, 1.920, 1.934, 1.949, 1.957)),
    7: ((1.335, 1.359, 1.374, 1.385, 1.396, 1.408, 1.414), (1.968, 2.003, 2.025, 2.041, 2.058, None, 2.084)),
    8: ((1.403, 1.430, 1.447, 1.459, 1.471, 1.484, 1.491), (2.068, 2.107, 2.132, 2.150, 2.169, 2.187, 2.197)),
    9: ((1.465, 1.494, 1.513, 1.526, 1.540, 1.554, 1.561), (2.160, 2.202, 2.230, 2.249, 2.269, 2.290, 2.301)),
    10: ((1.523, 1.554, 1.574, 1.588, 1.603, 1.618, 1.626), (2.244, 2.290, 2.320, 2.341, 2.363, 2.385, 2.397)),
    12: ((1.626, 1.661, 1.684, 1.700, 1.717, 1.734, 1.743), (2.396, 2.448, 2.482, 2.505, 2.530, 2.556, 2.569)),
    14: ((1.718, 1.756, 1.782, 1.799, 1.818, 1.837, 1.847), (2.532, 2.589, 2.626, 2.652, 2.679, 2.707, 2.722)),
    15: ((1.760, 1.801, 1.827, 1.845, 1.864, 1.884, 1.895), (2.594, 2.654, 2.692, 2.719, 2.748, 2.777, 2.792)),
    16: ((1.801, 1.843, 1.870, 1.889, 1.909, 1.929, 1.940), (2.654, 2.715, 2.756, 2.784, 2.813, 2.844, 2.859)),
}


@pytest.mark.parametrize("leaves", TABLE)
def test_wheels_have_the_addenda_and_radii_of_the_standard(leaves: int) -> None:
    # the last digit printed, and the radius taken from an addendum already rounded; one entry (None) is a slip
    heights, radii = TABLE[leaves]
    for ratio, height, radius in zip(RATIOS, heights, radii, strict=True):
        if (ratio * leaves) % 1 == 0:
            wheel, _ = FORM.teeth(int(ratio * leaves), leaves)
            assert wheel.addendum == pytest.approx(height, abs=0.001)
            assert radius is None or wheel.radius == pytest.approx(radius, abs=0.0015)


@pytest.mark.parametrize(
    ("leaves", "thickness", "addendum", "radius"),
    [(6, 1.05, 0.855, 1.05), (8, 1.05, 0.67, 0.70), (10, 1.05, 0.525, 0.525), (12, 1.25, 0.625, 0.625)],
)
def test_leaves_are_thinner_than_half_a_pitch(leaves: int, thickness: float, addendum: float, radius: float) -> None:
    wheel, leaf = FORM.teeth(6 * leaves, leaves)
    assert (leaf.thickness, leaf.addendum, leaf.radius) == (thickness, addendum, radius)
    assert wheel.thickness == pi / 2
    # their spaces are 0.4 modules deeper than the wheel's tips are high
    assert leaf.dedendum == pytest.approx(wheel.addendum + 0.4, rel=1e-12)


def rolled_addendum(leaves: int, ratio: float) -> float:
    """Where an epicycloid that starts at a tooth's edge on the pitch circle reaches the middle of the tooth."""
    rho, R = leaves / 4, ratio * leaves / 2
    low, high = 0.0, pi
    for _ in range(100):
        turn = (low + high) / 2
        arm = turn * rho / R
        x = (R + rho) * cos(arm) - rho * cos(arm + turn)
        y = (R + rho) * sin(arm) - rho * sin(arm + turn)
        low, high = (turn, high) if atan2(y, x) < pi / (2 * ratio * leaves) else (low, turn)
    return hypot(x, y) - R


def half_tooth(z: int, thickness: float, addendum: float, radius: float, root: float) -> np.ndarray:
    """Points from the root to the tip of a tooth about the x axis, on its side of positive y."""
    R = z / 2
    edge = np.array([R * cos(thickness / z), R * sin(thickness / z)])
    tip = np.array([R + addendum, 0.0])
    chord = tip - edge
    across = np.array([-chord[1], chord[0]]) / np.hypot(*chord)
    far = sqrt(radius**2 - chord @ chord / 4)
    centre = min(((edge + tip) / 2 + side * far * across for side in (1, -1)), key=lambda point: point[1])
    away = np.hypot(*centre)
    lean = atan2(centre[1], centre[0]) + asin(radius / away)
    start = sqrt(away**2 - radius**2) * np.array([cos(lean), sin(lean)])
    ends = [atan2(*(point - centre)[::-1]) for point in (start, tip)]
    turn = np.linspace(*ends, 3000)
    arc = centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return np.concatenate([[root * np.array([cos(lean), sin(lean)])], arc])


def teeth_near(z: int, side: np.ndarray, root: float, count: int) -> Polygon:
    """Some teeth about the x axis on a sector of their wheel."""
    points = [np.zeros(2)]
    for k in range(-count, count + 1):
        turn = 2 * pi * k / z
        place = np.array([[cos(turn), sin(turn)], [-sin(turn), cos(turn)]])
        points += [*(side * [1, -1] @ place), *(side[::-1] @ place)]
    return Polygon(points)


@pytest.mark.parametrize(("z1", "z2"), [(60, 8), (96, 12), (8, 60)])
def test_polygons_touch_where_the_transmission_says(z1: int, z2: int) -> None:
    leaves, ratio = min(z1, z2), max(z1, z2) / min(z1, z2)
    factor = rolled_addendum(leaves, ratio)
    thin, low, round_ = (1.05, 0.67, 0.70) if leaves == 8 else (1.25, 0.625, 0.625)
    sizes = {max(z1, z2): (pi / 2, 0.95 * factor, 1.4 * factor), leaves: (thin, low, round_)}
    wheels = []
    for z in (z1, z2):
        root = z / 2 - 2  # so deep that nothing touches the bottom
        wheels.append(teeth_near(z, half_tooth(z, *sizes[z], root), root, 2))
    transmission = FORM.transmission(z1, z2)
    begin = (sizes[z1][0] + sizes[z2][0]) / z2  # half a tooth of both, as the driven angle counts
    for S in np.linspace(0.02, 0.98, 7) * transmission.period:
        driver = affinity.rotate(wheels[0], S, origin=(0, 0), use_radians=True)
        prepare(driver)
        expected = float(transmission.angle(S)) + begin
        free, overlapping = expected + 2e-3, expected - 2e-3
        for _ in range(16):  # to 6e-8
            middle = (free + overlapping) / 2
            turn = (pi - middle) % (2 * pi / z2)
            turned = affinity.rotate(wheels[1], turn - 2 * pi / z2 * round((turn - pi) / (2 * pi / z2)), (0, 0), True)
            driven = affinity.translate(turned, (z1 + z2) / 2, 0)
            if driver.intersects(driven):
                overlapping = middle
            else:
                free = middle
        assert free == pytest.approx(expected, abs=2e-6)


def test_the_ratio_holds_in_the_mean_and_the_other_flanks_are_the_mirror_image() -> None:
    transmission = FORM.transmission(60, 8, 0.15)
    S = np.linspace(0, transmission.period, 4001)
    speed = np.trapezoid(transmission.speed(S), S) / transmission.period
    assert speed == pytest.approx(7.5, rel=2e-5)  # the rule's own error at the leaps
    coast = transmission.reversed_motion()
    backlash = pi * 2 / 8 - 2 * (pi / 2 + 1.05) / 8  # of the thicknesses on the pitch circle
    assert coast.error(-S) == pytest.approx(backlash - transmission.error(S), abs=1e-12)
    minimum = float((coast.error(S) - transmission.error(S)).min())
    assert transmission.verdict.backlash == pytest.approx(minimum, abs=1e-4)


def test_the_next_tooth_strikes_where_the_speed_leaps() -> None:
    transmission = FORM.transmission(60, 8)
    leaps = [leap.size for leap in transmission.speed_leaps()]
    fine = np.linspace(0, transmission.period, 200_001)
    steps = np.diff(transmission.angle(fine)) / np.diff(fine)  # a leap of speed is one of slope
    at = int(np.argmax(np.diff(steps)))
    assert leaps == pytest.approx([steps[at + 2] - steps[at - 1]], abs=1e-4)
    assert transmission.reversed_motion().speed_leaps() == transmission.speed_leaps()


def test_the_steepest_fall_is_the_steepest_of_a_scan() -> None:
    transmission = FORM.transmission(60, 8)
    S = np.linspace(0, transmission.period, 20_001)
    falls = -np.diff(transmission.speed(S)) / np.diff(S)
    assert transmission.steepest_fall() == pytest.approx(falls.max(), rel=1e-3)
    assert transmission.reversed_motion().steepest_fall() == transmission.steepest_fall()


def test_friction_costs_and_no_friction_costs_nothing() -> None:
    assert FORM.transmission(60, 8).efficiency_mean() == pytest.approx(1, abs=1e-12)
    better, worse = (FORM.transmission(60, 8, friction).efficiency_mean() for friction in (0.05, 0.2))
    assert 0.9 < worse < better < 1


def test_backlash_and_sizes_may_be_declared() -> None:
    # leaves of the standard have half a module of play, and are thinned for more
    for backlash, thickness in (("0.1", 1.05), ("0.6", pi / 2 - 0.6)):
        form = CircularArc.declared({"backlash": backlash})
        assert form.teeth(60, 8)[1].thickness == pytest.approx(thickness, rel=1e-15)
    # teeth of the standard for pairs in which either wheel drives
    same = CircularArc.declared({"thickness": "1.41", "addendum": "1.29", "radius": "2.06"})
    first, second = same.teeth(40, 40)
    assert isclose(first.thickness, 1.41)
    assert first == second
    assert same.transmission(40, 40).verdict


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"radius": "0.3"}, "cannot be .* modules thick"),
        ({"thickness": "3.2"}, "cannot be .* modules thick"),
        ({"thickness": "1.4", "backlash": "0.1"}, "both given"),
    ],
)
def test_parameters_that_make_no_tooth_are_refused(given: dict[str, str], said: str) -> None:
    with pytest.raises(GearTrainError, match=said):
        CircularArc.declared(given).transmission(60, 8)


def test_rings_and_teeth_too_few_are_refused() -> None:
    text = PAIR.format(rest="tooth_form: {form: circular_arc}\ninputs: {a: 1}")
    for wheel, said in (("w: {teeth: 60, internal: true}", "a ring cannot have"), ("w: 3", "3 teeth")):
        with pytest.raises(GearTrainError, match=said):
            _ = load(text.replace("w: 60", wheel)).meshes


def test_axles_too_near_jam_and_too_far_part() -> None:
    for distance, kind in ((33.4, "jam"), (36.1, "contact ratio")):
        form = CircularArc.declared({"centre_distance": str(distance)})
        assert kind in {fault.kind for fault in form.transmission(60, 8).verdict.faults}


@pytest.fixture(scope="module")
def clock() -> GearTrain:
    return shipped.train("longcase-clock-bs978")


def test_a_shipped_clock_runs_with_them_and_its_hands_stray_by_little(clock: GearTrain) -> None:
    assert not clock.mechanics.faults
    assert {mesh.form for mesh in clock.meshes} == {"circular_arc"}
    said = " ".join(str(clock.report()).split())
    assert "circular arc" in said
    assert "the contact of their outlines" in said


def test_what_is_cut_has_the_standards_tips(clock: GearTrain) -> None:
    wheels = SolidModel(clock, ManufacturingSizes()).blanks.wheels
    great, leaf = ((wheels[name], wheels[name].pitch_radius * 2 / z) for name, z in (("g96", 96), ("c8", 8)))
    # the table at ratios 11 and 12: 1.488, 1.491
    assert great[0].tip_radius / great[1] == pytest.approx(48 + 1.488, abs=0.006)
    assert leaf[0].tip_radius / leaf[1] == pytest.approx(4.67, rel=1e-12)
    assert Polygon(great[0].contours[0].flattened(1e-4)).is_valid


def test_a_wheel_is_cut_to_scale_and_its_transmission_drawn(tmp_path: Path) -> None:
    made, plot = tmp_path / "leaf.csv", tmp_path / "law.svg"
    words = ("60", "8", "--module", "2mm", "--wheel", "2", "--profile", str(made), "--plot", str(plot))
    assert call("mesh", "--form", "circular_arc", *words).exit_code == 0
    points = np.loadtxt(made, delimiter=",", skiprows=1)[:, 1:]
    outline = Polygon(points)
    assert outline.is_valid
    radii = np.hypot(*points.T)
    assert radii.max() == pytest.approx(2 * 4.67, abs=1e-6)
    assert "transmission error" in plot.read_text() or plot.stat().st_size > 10_000


def test_no_file_of_the_package_but_its_own_the_registry_and_the_map_names_it() -> None:
    package = Path(geartrain.__file__).parent
    files = (path for path in package.rglob("*.py") if re.search(r"circular[_-]arc|CircularArc", path.read_text()))
    assert {path.relative_to(package).as_posix() for path in files} == {
        "teeth/circular_arc.py",
        "teeth/any_tooth_form.py",
        "teeth/__init__.py",
    }


def test_friction_at_the_pitch_point_is_that_beside_it() -> None:
    """Where the contact crosses the line of centres its place is rounding, and a normal made from it could lock."""
    transmission = load("longcase-clock-bs978").meshes[2].transmission
    # of 56 that drive 7
    S = 0.08425395 + np.concatenate([np.linspace(-size, size, 10_001) for size in (1e-4, 5e-8)])
    sliding, into, out = transmission.rubbing(S)
    assert sliding.min() < 1e-7 < sliding.max() < 2e-3
    assert np.isfinite(into).all()
    assert np.isfinite(out).all()
    assert transmission.efficiency(S) == pytest.approx(1.0, abs=2e-4)
