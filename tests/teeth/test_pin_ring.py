"""Discs of lobes in rings of pins: outlines against pins in the plane, forces by virtual work, ratios of reducers."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from commands import ended
from hypothesis import given, settings
from hypothesis import strategies as st
from models import pair
from shapely import Point, Polygon
from shapely.affinity import rotate, translate

import geartrain
from geartrain.errors import DeclarationError, GearTrainError
from geartrain.simulation.strength.pin_strength import lobe_load
from geartrain.teeth import PinRing
from geartrain.teeth.cycloidal_disc import CycloidalDisc
from geartrain.teeth.outlines import Contour, repeated

FORM = PinRing(form="pin_ring")
lobes = st.integers(3, 60)
shortening = st.floats(0.3, 0.85)


def polygon(tooth: Any, z: int) -> Polygon:
    return Polygon(Contour.of(repeated(tooth.tooth, z)).flattened(1e-5))


def pins_of(disc: CycloidalDisc) -> list[Point]:
    turns = 2 * pi / disc.pins * np.arange(disc.pins)
    return [Point(disc.circle * cos(turn), disc.circle * sin(turn)) for turn in turns]


def placed(disc: CycloidalDisc, shape: Polygon, turn: float) -> Polygon:
    """The disc while its eccentric has turned: at 0 a space stands at the pitch point."""
    own = np.degrees((pi - turn) / disc.lobes)
    return translate(rotate(shape, own, origin=(0, 0)), cos(turn) / 2, sin(turn) / 2)


@settings(max_examples=25)
@given(lobes, shortening, st.floats(0, 6.28))
def test_every_pin_touches_the_disc_wherever_the_eccentric_stands(z: int, part: float, turn: float) -> None:
    bare = CycloidalDisc(z, (z + 1) / 2 / part, 0.0)
    disc = CycloidalDisc(z, bare.circle, min(bare.sharpest * 0.8, 0.8 * bare.circle * sin(pi / (z + 1))))
    shape = placed(disc, polygon(disc.lobe(1e-4), z), turn)
    for pin in pins_of(disc):
        assert shape.exterior.distance(pin) == pytest.approx(disc.pin, abs=3e-4)
        assert not shape.contains(pin)


def test_clearance_is_that_to_every_pin() -> None:
    form = PinRing.declared({"clearance": "0.05"})
    disc = form.disc(11)
    shape = placed(disc, polygon(disc.lobe(1e-5), 11), 1.0)
    for pin in pins_of(disc):
        assert shape.exterior.distance(pin) - disc.pin == pytest.approx(0.05, abs=1e-4)
    # turned by its play it touches, and no sooner
    transmission = form.transmission(11, 12, driver=2)
    centre = (cos(1.0) / 2, sin(1.0) / 2)
    for part, free in ((0.49, True), (0.53, False)):
        turned = rotate(shape, np.degrees(part * transmission.verdict.backlash), origin=centre)
        assert all(turned.exterior.distance(pin) > disc.pin for pin in pins_of(disc)) is free


@settings(max_examples=25)
@given(lobes, shortening, st.floats(0.05, 0.8), st.floats(0, 6.28))
def test_a_disc_never_reaches_into_the_ring_behind_the_pins(z: int, part: float, thick: float, turn: float) -> None:
    bare = CycloidalDisc(z, (z + 1) / 2 / part, 0.0)
    disc = CycloidalDisc(z, bare.circle, min(bare.sharpest * 0.8, thick * bare.circle * sin(pi / (z + 1))), 0.01)
    opening = polygon(disc.pin_tooth(), z + 1)
    assert opening.contains(placed(disc, polygon(disc.lobe(1e-4), z), turn))
    assert opening.contains(placed(disc, polygon(disc.lobe(1e-4), z), 0.0)), "a lobe between two pins, farthest out"


@settings(max_examples=40)
@given(lobes, shortening, st.floats(0, 6.28), st.floats(0.001, 0.2), st.floats(1e-4, 100))
def test_with_a_clearance_the_reached_pins_bear(z: int, part: float, phase: float, back: float, give: float) -> None:
    """Turned under load, each pin is pressed back by as much as the disc overlaps it, and all balance the torque."""
    disc = CycloidalDisc(z, (z + 1) / 2 / part, 0.1, back, give)
    arms = disc.arms(phase + 2 * pi * np.arange(z + 1) / (z + 1))
    loads = disc.loads(np.array(phase))
    assert float((loads * arms).sum()) == pytest.approx(z / 2, rel=1e-9)
    bearing = loads > 0
    twist = (loads[bearing] * give + back) / arms[bearing]
    assert twist == pytest.approx(np.full(bearing.sum(), twist[0]), rel=1e-6), "it is turned by one angle"
    assert (twist[0] * arms[~bearing] <= back * (1 + 1e-9)).all(), "the others are not reached"


def test_a_little_load_is_borne_by_one_pin_and_a_great_one_by_half_of_all() -> None:
    free = PinRing.declared({"clearance": "0.02"}).disc(11)
    assert free.bearing_pins == FORM.disc(11).bearing_pins == (5, 6)
    assert free.maximum_load == FORM.disc(11).maximum_load
    light, heavy = (
        PinRing.declared({"clearance": "0.02", "deflection": give}).disc(11) for give in ("0.000001", "1000")
    )
    assert light.bearing_pins == (1, 1)
    assert light.maximum_load == pytest.approx(1, abs=0.2), "one pin with an arm near the pitch radius"
    assert heavy.bearing_pins == (5, 6)
    assert heavy.maximum_load == pytest.approx(free.maximum_load, rel=1e-3)
    assert light.maximum_load > PinRing.declared({"clearance": "0.02", "deflection": "0.05"}).disc(11).maximum_load


@given(lobes, shortening, st.floats(0, 6.28))
def test_arms_are_those_of_the_normals_and_forces_balance_the_torque(z: int, part: float, phase: float) -> None:
    disc = CycloidalDisc(z, (z + 1) / 2 / part, 0.1)
    angles = phase + 2 * pi * np.arange(z + 1) / (z + 1)
    pins = disc.circle * np.exp(1j * angles)
    pitch_point, middle = (z + 1) / 2, 0.5
    normal = (pitch_point - pins) / np.abs(pitch_point - pins)  # from the pin into the disc
    torque = (np.conj(pins - middle) * normal).imag
    arms = disc.arms(angles)
    # a pin pushes, it does not pull: only those on one side bear
    assert arms == pytest.approx(np.maximum(-torque, 0.0), abs=1e-9)
    loads = disc.loads(np.array(phase))
    assert float((loads * arms).sum()) == pytest.approx(z / 2)


def test_the_maximum_load_is_four_over_the_number_of_pins() -> None:
    """The formula of handbooks, 4 T / (e z_d z_p): of pins far out, whose normals are parallel."""
    disc = CycloidalDisc(59, 60 / 2 / 0.02, 0.1)
    assert disc.maximum_load == pytest.approx(4 / 60, rel=2e-3)
    assert FORM.disc(11).maximum_load == pytest.approx(4 / 12, rel=0.03)


def test_losses_are_the_work_of_friction_at_all_pins() -> None:
    """Worked out from points: how fast the disc slides past each pin where they touch, in the frame of the ring."""
    disc = FORM.disc(11)
    phase, step = 0.2, 1e-6

    def touching(turn: float) -> np.ndarray:
        # points of the disc that touch at `turn` = 0, as they stand later
        pins = disc.circle * np.exp(1j * (phase + 2 * pi * np.arange(12) / 12))
        at = pins + disc.pin * (6 - pins) / np.abs(6 - pins)
        own = np.exp(-1j * turn / 11)
        return np.asarray(0.5 * np.exp(1j * turn) + (at - 0.5) * own)

    speed = np.abs(touching(step) - touching(-step)) / (2 * step)
    loads = disc.loads(np.array(phase))
    # the disc turns by 1 + 1/11 against the eccentric in a radian of this
    lost = float((loads * speed).sum()) / (11 / 2 * (1 + 1 / 11))
    assert float(disc.sliding(np.array(phase))[1]) == pytest.approx(lost, rel=1e-6)
    assert float(FORM.transmission(11, 12, 0.05).efficiency_mean()) == pytest.approx(
        1 / (1 + 0.05 * disc.loss), rel=1e-4
    )


def test_transmission_keeps_its_ratio_and_shifts_by_its_backlash() -> None:
    transmission = PinRing.declared({"clearance": "0.02"}).transmission(11, 12)
    assert transmission.ratio == Fraction(11, 12)
    assert transmission.error([0.0, 0.3]) == pytest.approx([0, 0])
    assert transmission.reversed_motion().error(0.3) == pytest.approx(transmission.verdict.backlash)
    assert transmission.reversed.ratio == Fraction(12, 11)
    assert transmission.verdict.backlash == pytest.approx(4 * 0.02 / 12)


@pytest.mark.parametrize(
    ("given_", "z", "words"),
    [
        ({}, (11, 13), "give the ring 12 pins"),
        ({"pin_circle": "6"}, (11, 12), "larger pin_circle"),
        ({"pin_diameter": "5"}, (11, 12), "touch each other"),
        ({"pin_circle": "6.2", "pin_diameter": "2.5"}, (11, 12), "undercut"),
        ({"pin_circle": "20 mm"}, (11, 12), "no module"),
        ({}, (2, 3), "3 lobes or more"),
    ],
)
def test_what_cannot_be_is_refused_with_a_cure(given_: dict[str, str], z: tuple[int, int], words: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        PinRing.declared(given_).transmission(*z)
    assert words in str(caught.value)


def test_a_ring_is_wanted() -> None:
    with pytest.raises(GearTrainError, match="internal"):
        _ = pair("inputs: {a: 1}\ntooth_form: pin_ring").meshes


@pytest.mark.parametrize(
    ("name", "link", "ratio"),
    [
        ("cycloidal-reducer", "flange", Fraction(-11)),
        ("strain-wave", "cup", Fraction(-100)),
        ("rv-reducer", "output", 1 + Fraction(26, 10) * 40),
    ],
)
def test_reducers_have_the_ratio_of_their_makers_formula(name: str, link: str, ratio: Fraction) -> None:
    train = geartrain.load(name)
    answer = train.solve()
    (source,) = train.kinematics.cases[None].inputs
    assert Fraction(answer[source]) / Fraction(answer[link]) == ratio
    assert train.mobility.by_rank == 1


def test_torques_of_a_reducer_are_those_of_its_ratio_less_what_its_pins_lose() -> None:
    train = geartrain.load("cycloidal-reducer")
    found = train.torques()
    loss = train.meshes[0].transmission.disc.loss  # type: ignore[attr-defined]
    # of 12 times the power that passes the pins a part is lost
    assert float(found.external["shaft"]) == pytest.approx(10 / 11 * (1 + 12 * 0.05 * loss), rel=2e-3)
    assert not any("holes" in effect.where for effect in found.neglected)


def test_holes_are_cut_where_both_links_have_wheels() -> None:
    from geartrain.scene import ManufacturingSizes, SolidModel

    path = geartrain.shipped()["cycloidal-reducer"]
    text = path.read_text(encoding="utf-8").replace("flange: {}", "flange: {wheels: {out: {teeth: 15, module: 3 mm}}}")
    model = SolidModel(geartrain.load(text), ManufacturingSizes())
    names = {part.name for part in model.parts}
    assert {f"holes pin {at}" for at in range(1, 7)} <= names
    disc = next(part for part in model.parts if part.name == "lobes")
    assert sum(contour.is_circle for contour in disc.contours) >= 6


def test_the_disc_has_its_holes_for_pins_that_stand_in_a_plate() -> None:
    """Six on 12 mm, each free for a pin of 4 mm that goes round in it on 1.5 mm, with the play of what runs."""
    from geartrain.scene import ManufacturingSizes, SolidModel

    model = SolidModel(geartrain.load("cycloidal-reducer"), ManufacturingSizes())
    disc = next(part for part in model.parts if part.name == "lobes")
    middles = [(contour, contour.points.mean(axis=0)) for contour in disc.contours if contour.is_circle]
    holes = [(contour, at) for contour, at in middles if np.hypot(*at) > 1]
    assert [float(np.hypot(*at)) for _, at in holes] == pytest.approx([12] * 6)
    turns = sorted(float(np.arctan2(*at[::-1])) for _, at in holes)
    assert np.diff(turns) == pytest.approx([pi / 3] * 5)
    for contour, at in holes:
        reach = float(np.hypot(*(contour.points - at).T).max())
        assert reach == pytest.approx(2 + 1.5 + model.process.running / 2)
    assert model.process.running > 0
    assert not model.couplings.notices
    assert len([part for part in model.parts if part.name.startswith("holes pin")]) == 6


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("pins: 6", "pins: 2"), "greater than or equal to 3"),
        (("offset: 1.5 mm}", "offset: 1.5 mm, friction: 0.1}"), "not modelled"),
        (("kind: pins_in_holes", "kind: parallel"), "pins"),
    ],
)
def test_couplings_that_are_none_are_refused(change: tuple[str, str], words: str) -> None:
    text = geartrain.shipped()["cycloidal-reducer"].read_text(encoding="utf-8")
    assert change[0] in text
    with pytest.raises(DeclarationError, match=words):
        geartrain.load(text.replace(*change))


def test_an_offset_that_is_not_the_eccentricity_cannot_be_built() -> None:
    """It is half the module times one tooth."""
    text = geartrain.shipped()["cycloidal-reducer"].read_text(encoding="utf-8")
    (found,) = geartrain.load(text.replace("offset: 1.5 mm", "offset: 2 mm")).build_findings
    assert "2 mm apart" in found.problem.what
    assert "need 1.5 mm" in found.problem.what
    assert not geartrain.load(text).build_findings


def test_the_command_writes_the_load_of_a_pin() -> None:
    out = ended("mesh", 11, 12, "--form", "pin_ring", "--friction", 0.05, "--json")
    assert '"maximum_load": 0.33' in out.stdout


def test_the_command_takes_clearance_and_deflection() -> None:
    for options, bearing in (((), "5 to 6"), (("-p", "deflection=0.01"), "3 to 4")):
        done = ended("mesh", 11, 12, "--form", "pin_ring", "-p", "clearance=0.01", *options, "-o", "-")
        assert done.returncode == 0, done.stderr
        row = next(line for line in done.stdout.splitlines() if "wheel 1 -> wheel 2" in line).strip("| ").split("|")
        assert row[6].strip() == bearing
        assert float(row[-3]) == pytest.approx(np.degrees(4 * 0.01 / 12), rel=1e-3), "of the ring, which is driven"


def test_cranks_side_by_side_share_the_torque_alike_and_change_no_speed() -> None:
    """The sun of 10 teeth takes 400/105 N m; each of three cranks a third of it, 26/10 as much."""
    text = geartrain.shipped()["rv-reducer"].read_text(encoding="utf-8")
    three, one = geartrain.load("rv-reducer"), geartrain.load(text.replace("copies: 3, ", ""))
    assert three.solve().speeds == one.solve().speeds
    torques = three.torques()
    assert torques.verdict.kind == "determined"
    for at in ("", ".2", ".3"):
        assert float(torques.pairs[f"z1~z2{at}"].torques[1]) == pytest.approx(-400 / 105 / 3 * 2.6)
        assert float(torques.pairs[f"cranks{at}"].torques[1]) == pytest.approx(400 / 105 / 3 * 2.6)


def test_pins_in_slots_take_no_copies() -> None:
    text = """
    links: {frame: {}, arm: {}, p: {copies: 2, wheels: {a: 20}}, q: {wheels: {b: 30}}}
    revolutes: {main: [frame, arm, q], P: [arm, p]}
    gears: [a ~ b]
    couplings: [{id: pin, kind: pin_and_slot, pin: p, slot: q, pin_radius: 10 mm, offset: 2 mm}]
    inputs: {arm: 1}
    """
    with pytest.raises(DeclarationError, match="coupling 'pin' cannot connect 2 equal links 'p'"):
        geartrain.load(text).unfolded.solve()


@given(lobes, shortening, st.floats(0.1, 6.2), st.floats(0.1, 0.8))
@settings(max_examples=60, deadline=None)
def test_the_outline_is_as_round_as_handbooks_have_it(z: int, k: float, angle: float, part: float) -> None:
    """r = R (1 + K^2 - 2 K cos t)^(3/2) / (K (1 + zp) cos t - (1 + zp K^2)) + rp, hollow above 0."""
    R = (z + 1) / 2 / k
    disc = CycloidalDisc(z, R, part * min(CycloidalDisc(z, R, 1e-9).sharpest, R * sin(pi / (z + 1))))
    below = k * (z + 2) * cos(angle) - (1 + (z + 1) * k**2)
    curvature = float(disc.curvature(np.array(angle)))
    printed = R * (1 + k**2 - 2 * k * cos(angle)) ** 1.5
    assert curvature == pytest.approx(-below / (printed + disc.pin * below), rel=1e-6, abs=1e-9)
    # and the circle through three points
    a, b, c = disc.outline(np.array([angle - 1e-3, angle, angle + 1e-3])).tolist()
    area = ((b - a).conjugate() * (c - a)).imag / 2
    assert curvature == pytest.approx(4 * area / (abs(a - b) * abs(b - c) * abs(c - a)), rel=2e-3, abs=2e-3)


def test_pressure_by_another_form_of_hertz() -> None:
    """p = sqrt(F E*/(pi b R)), E* of two equal bodies E/(2 (1 - nu^2))."""
    found = geartrain.load("cycloidal-reducer").strength()
    lobe, holes = found.pins["lobes~ring"], found.pins["holes"]
    stiffness = 206_000 / 2 / (1 - 0.3**2)
    for each in (lobe, holes):
        assert each.pressure == pytest.approx(sqrt(each.force * stiffness / (pi * 8 * each.radius)), rel=1e-6)
    assert 1 / holes.radius == pytest.approx(1 / 2 - 1 / 3.5)
    assert holes.force == pytest.approx(4 * 10_000 / (6 * 12), rel=1e-4)
    # bending and shear by von Mises, spread over 8 mm of a pin of 4 mm that is held at one end
    bent, sheared = holes.force * 8 / 2 / (pi * 4**3 / 32), holes.force / (4 * pi)
    assert holes.pin_stress == pytest.approx(sqrt(bent**2 + 3 * sheared**2))


def test_no_pin_at_any_time_is_pressed_more_than_is_told() -> None:
    disc = CycloidalDisc(11, 25 / 3, 1.0)
    load, worst = lobe_load(disc), 0.0
    R, a, k = disc.circle, 6.0, 6.0 / disc.circle
    for turn in np.linspace(0, 2 * pi / 12, 500):
        angles = turn + 2 * pi * np.arange(12) / 12
        # arms by the cross product of pin and pitch point, both seen from the disc's middle half a module aside
        across = -R * np.sin(angles) / np.hypot(a - R * np.cos(angles), R * np.sin(angles))
        arms = np.maximum(-(a - 0.5) * across, 0.0)
        forces = arms * 5.5 / (arms**2).sum()
        below = k * 13 * np.cos(angles) - (1 + 12 * k**2)
        hollow = R * (1 + k**2 - 2 * k * np.cos(angles)) ** 1.5 / below + 1.0
        worst = max(worst, float((forces * (1 - 1 / hollow)).max()))
    assert load.force * load.curvature == pytest.approx(worst, rel=1e-3)
