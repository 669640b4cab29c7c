"""Strength of one pair: printed numbers, closed forms, scaling laws, finite elements against beams."""

from __future__ import annotations

from math import cos, isinf, pi, radians, sqrt, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain
from geartrain.errors import RangeError
from geartrain.simulation.strength.contact_pressure import (
    ContactLoad,
    Elasticity,
    elasticity_factor,
    hertz_pressure,
    loss_over_friction,
)
from geartrain.simulation.strength.iso_6336 import (
    RackPair,
    RackWheel,
    ToothLoad,
    ToothSide,
    contact_stress,
    outer_single_contact,
    pin_stress,
    root_stress,
)
from geartrain.teeth import Cycloidal, Involute
from geartrain.teeth.conjugate import WheelPair
from geartrain.teeth.outlines.tooth_requirement import ToothRequirement

TWENTY = radians(20)
STEEL, BRASS = Elasticity(206_000, 0.3), Elasticity(100_000, 0.35)
ACRYLIC = Elasticity(3200, 0.35)


def side_of(z: int, mate: int = 60, gear: int = 1, ring: bool = False) -> ToothSide:
    pair = Involute(form="involute").pair(WheelPair(z, mate, ring))
    cut = ToothRequirement(pair, gear, 1e-4, 0.25).cut()
    return ToothSide.of(cut.tooth, -1 if ring and gear == 2 else 1)


# ------------------------------------------------------------------------------------------------------------- Hertz


@pytest.mark.parametrize(
    ("first", "second", "printed"),
    [
        (STEEL, STEEL, 189.81),
        (STEEL, BRASS, 155.33),
        (BRASS, BRASS, 134.67),
        (Elasticity(3200, 0.35), ACRYLIC, 24.09),
    ],
)
def test_factors_of_elasticity_are_those_printed(first: Elasticity, second: Elasticity, printed: float) -> None:
    assert elasticity_factor(first, second) == pytest.approx(printed, abs=0.005)
    assert elasticity_factor(first, second) == elasticity_factor(second, first)


def test_the_pressure_carries_the_force() -> None:
    # a half ellipse of half width b = sqrt(4 F R/(pi L E*)), integrated plainly
    force, width, R = 800.0, 12.0, 4.0
    E = 1 / sum((1 - each.poisson**2) / each.youngs_modulus for each in (STEEL, BRASS))
    b = sqrt(4 * force * R / (pi * width * E))
    p0 = hertz_pressure(elasticity_factor(STEEL, BRASS), force, width, 1 / R)
    x = (np.arange(200_000) + 0.5) / 200_000 * 2 * b - b
    carried = float((p0 * np.sqrt(1 - (x / b) ** 2)).mean()) * 2 * b * width
    assert carried == pytest.approx(force, rel=1e-5)


def test_shigleys_example_14_3_of_a_steel_pinion_on_cast_iron() -> None:
    """Budynas and Nisbett, Shigley's Mechanical Engineering Design, 9th ed. 2011: Cp = 1817, sigma_C = -72 400 psi."""
    psi, inch, pound = 6894.757e-6, 25.4, 4.4482216
    factor = elasticity_factor(Elasticity(30e6 * psi, 0.292), Elasticity(14.5e6 * psi, 0.211))
    assert factor / sqrt(psi) == pytest.approx(1817, abs=1)
    transmission = Involute(form="involute", addendum="0.9").transmission(16, 50)
    module = inch / 8
    load = ContactLoad(transmission.path, module, 1.5 * inch, 1.52 * 382 * pound * 8 * module, factor)
    pitch_point = next(each for each in load.places() if each.where == "pitch point")
    assert pitch_point.pressure / psi == pytest.approx(72_400, rel=2e-3)


def test_tooth_pairs_share_and_the_worst_place_is_found() -> None:
    # computed beforehand: 1362 at the start of contact, shared in halves; 796.348 at B; 719 at the pitch point
    transmission = Involute(form="involute").transmission(17, 51)
    load = ContactLoad(transmission.path, 2, 20, 20_000, elasticity_factor(STEEL, STEEL))
    places = {each.where: each for each in load.places()}
    assert places["start of contact"].pressure == pytest.approx(1362, abs=1)
    assert places["start of contact"].tooth_pairs == 2
    assert places["inner single contact of gear 1"].pressure == pytest.approx(796.348, abs=0.01)
    assert places["pitch point"].pressure == pytest.approx(719.16, abs=0.01)
    assert places["worst"].pressure == pytest.approx(places["start of contact"].pressure)
    assert load.single_pressure() == pytest.approx(796.348, abs=0.01)


@given(st.floats(-0.85, 0.74))
def test_the_forces_of_all_tooth_pairs_balance_the_torque(position: float) -> None:
    transmission = Involute(form="involute").transmission(17, 51)
    load = ContactLoad(transmission.path, 2, 20, 20_000, 189.8)
    X = position * transmission.path.pitch.p
    (force,), (count,) = load.forces(np.array([X]))
    base = 17 * cos(TWENTY)  # mm, module 2
    assert force * count * base == pytest.approx(20_000, rel=1e-9)
    assert len(load.tooth_pairs(X)) == count


@settings(max_examples=few_or_many(20, 60))
@given(st.floats(0.5, 8), st.floats(0.1, 30))
def test_pressure_goes_with_the_root_of_force_and_the_inverse_of_size(scale: float, more: float) -> None:
    transmission = Involute(form="involute").transmission(20, 40)
    one = ContactLoad(transmission.path, 1, 5, 100, 150.0).single_pressure()
    assert ContactLoad(transmission.path, 1, 5, 100 * more, 150.0).single_pressure() == pytest.approx(one * sqrt(more))
    # all lengths times s, forces times s^2: the same pressure
    grown = ContactLoad(transmission.path, scale, 5 * scale, 100 * scale**3, 150.0)
    assert grown.single_pressure() == pytest.approx(one)


def test_cycloids_have_no_bound_at_the_pitch_point() -> None:
    load = ContactLoad(Cycloidal(form="cycloidal").transmission(8, 60).path, 1, 2, 10, 150.0)
    assert load.has_cusp
    assert isinf(next(each for each in load.places() if each.where == "pitch point").pressure)


# ------------------------------------------------------------------------------------------------------------- Lewis

LEWIS = {30: 0.359, 38: 0.384, 43: 0.397, 50: 0.409, 60: 0.422, 75: 0.435, 100: 0.447, 150: 0.460}
"""Lewis's Y for 20 degrees, full depth, load at the tip: Shigley's, 9th ed., table 14-2."""


@pytest.mark.parametrize("z", LEWIS)
def test_the_form_factor_by_outline_is_that_of_the_table_from_30_teeth_on(z: int) -> None:
    side = side_of(z)
    section = side.weakest_section(side.load_at(side.tip, z / 2 * cos(TWENTY)))
    assert section.lewis_factor(z / 2) == pytest.approx(LEWIS[z], rel=0.02)


def test_the_form_factor_of_40_teeth_worked_out_by_hand() -> None:
    # the round (radius 0.38) about (19.0797, 1.38504) bounds the root: at x = 18.978, half the thickness is 1.01891
    x, half = 18.978, 1.38504 - sqrt(0.38**2 - (19.0797 - 18.978) ** 2)
    aa = np.arccos(20 * cos(TWENTY) / 21)
    gamma = pi / 80 + tan(TWENTY) - TWENTY - (tan(aa) - aa)
    apex = 20 * cos(TWENTY) / cos(aa - gamma)
    by_hand = (2 * half) ** 2 * cos(TWENTY) / (6 * (apex - x) * cos(aa - gamma))
    side = side_of(40)
    found = side.weakest_section(side.load_at(side.tip, 20 * cos(TWENTY)))
    assert found.lewis_factor(20) == pytest.approx(by_hand, rel=2e-4)
    assert by_hand == pytest.approx(0.3920, abs=2e-4)
    # with the force along the normal of the last chord of an outline of 0.001 modules it would be 0.389
    assert by_hand == pytest.approx(0.3890, rel=0.01)


def test_a_straight_tooth_is_a_cantilever() -> None:
    # thickness 1, a force of 2 across it at x = 30: at x = 20, sigma = 6 F l/t^2 = 120
    side = ToothSide(np.array([[30.0, 0.0], [30.0, 0.5], [20.0, 0.5]]), 1)
    found = side.weakest_section(ToothLoad(30.0, 30.0, 0.0))
    assert found.thickness == pytest.approx(1)
    assert found.stress(2 * 30.0, 1, 1) == pytest.approx(120)


def test_the_tooth_of_a_ring_is_loaded_towards_its_root() -> None:
    side = side_of(24, 60, 2, True)
    by_path, by_flank = side.load_at(side.tip, 30 * cos(TWENTY)), side.load_at_tip()
    assert by_path.apex == pytest.approx(by_flank.apex, abs=2e-3)
    assert by_path.angle > 0
    assert side.weakest_section(by_path).x > by_path.apex


def test_a_pin_held_at_both_ends() -> None:
    # M = F l/12 and W = pi d^3/32
    assert pin_stress(12.0, 5.0, 2.0) == pytest.approx(5.0 / (pi * 8 / 32))


# ---------------------------------------------------------------------------------------------------------- ISO 6336

A = (17, 51, 0.0, 2, 20, 20_000, STEEL, STEEL)
B = (12, 60, 0.4, 1, 3, 100, STEEL, BRASS)
C = (20, 40, 0.0, 3, 6, 500, ACRYLIC, ACRYLIC)


@pytest.mark.parametrize(
    ("case", "contact", "pinion", "wheel"),
    [
        (A, (2.49457, 0.88761, 1.10733, 638.33, 706.85), (1.88402, 0.58110, 0.9837, 1.6898, 1.7704, 87.99),
         (1.3503, 2.0228, 80.33)),
        (B, (2.49457, 0.91576, 1.04516, 264.49, 276.43), (2.03536, 0.45731, 1.0032, 1.4077, 2.0592, 16.10),
         (1.7876, 1.7261, 17.14)),
        (C, (2.49457, 0.88785, 1.06234, 14.061, 14.937), (1.94475, 0.57295, 0.9928, 1.5934, 1.8160, 2.679),
         (1.3841, 1.9752, 2.531)),
    ],
    ids="ABC",
)  # fmt: skip
def test_method_b_gives_the_numbers_computed_beforehand(
    case: tuple, contact: tuple[float, ...], pinion: tuple[float, ...], wheel: tuple[float, ...]
) -> None:
    z1, z2, x, m, b, torque, first, second = case
    eps = Involute(form="involute", shift=(x, -x)).transmission(z1, z2).path.contact_ratio
    wheels = (RackWheel(z1, x, z1 / 2 + 1 + x), RackWheel(z2, -x, z2 / 2 + 1 - x))
    pair = RackPair(*wheels, TWENTY, TWENTY, eps)
    force = torque / (m * z1 / 2)
    found = contact_stress(pair, elasticity_factor(first, second), force, b, m)
    assert (found.ZH, found.Zeps, found.M1, found.nominal, found.stress[0]) == pytest.approx(contact, rel=5e-5)
    roots = [root_stress(each, TWENTY, force, b, m, outer_single_contact(each, TWENTY, eps)) for each in wheels]
    own = roots[0]
    assert (own.chord, own.radius, own.lever, own.YF, own.YS, own.stress) == pytest.approx(pinion, rel=3e-4)
    assert (roots[1].YF, roots[1].YS, roots[1].stress) == pytest.approx(wheel, rel=3e-4)


def test_inner_single_contact_by_iso_is_that_of_hertz() -> None:
    # M1 sH0/Zeps is Hertz's pressure where gear 1 begins to bear all
    transmission = Involute(form="involute").transmission(17, 51)
    pair = RackPair(RackWheel(17, 0, 9.5), RackWheel(51, 0, 26.5), TWENTY, TWENTY, transmission.path.contact_ratio)
    found = contact_stress(pair, 189.81, 1000, 20, 2)
    load = ContactLoad(transmission.path, 2, 20, 17_000, 189.81)
    places = {each.where: each.pressure for each in load.places()}
    assert found.M1 * found.nominal / found.Zeps == pytest.approx(places["inner single contact of gear 1"], rel=1e-6)
    assert found.M2 * found.nominal / found.Zeps == pytest.approx(places["inner single contact of gear 2"], rel=1e-6)
    assert found.nominal / found.Zeps == pytest.approx(places["pitch point"], rel=1e-9)


AT_THE_TIP = {17: (2.97, 1.52), 20: (2.80, 1.55), 25: (2.62, 1.59), 30: (2.52, 1.625), 40: (2.40, 1.67),
              50: (2.32, 1.70), 60: (2.28, 1.73), 80: (2.22, 1.77), 100: (2.18, 1.79)}  # fmt: skip
"""YFa and YSa of DIN 3990 and ISO 6336, load at the tip, 20 degrees, rack 1/1.25/0.38: table 10-5 of Pu Lianggui and
Ji Minggang, Machine Design (in Chinese), 8th ed. 2006."""


@pytest.mark.parametrize("z", AT_THE_TIP)
def test_factors_at_the_tip_are_those_of_a_printed_table(z: int) -> None:
    found = root_stress(RackWheel(z, 0, z / 2 + 1), TWENTY, 1000, 10, 2, z / 2 + 1)
    assert pytest.approx(AT_THE_TIP[z], rel=0.02) == (found.YF, found.YS)


def test_worked_example_10_1_of_a_textbook() -> None:
    """Spur wheels 24/77, 1.3 times 99 480 N mm, allowed 522.5 MPa, width equal to diameter: d1 = 65.396 mm.

    And the factors of their roots, 2.65 and 1.58, 2.226 and 1.764: Pu Lianggui and Ji Minggang, as above.
    """
    d1, u = 65.396, 77 / 24
    pair = RackPair(RackWheel(24, 0, 13), RackWheel(77, 0, 39.5), TWENTY, TWENTY, 1.7)
    found = contact_stress(pair, elasticity_factor(STEEL, STEEL), 2 * 1.3 * 99_480 / d1, d1, d1 / 24)
    assert found.nominal / found.Zeps == pytest.approx(522.5, rel=0.005)  # the book leaves the contact ratio out
    assert u == pytest.approx(3.2, rel=0.005)
    for z, printed in ((24, (2.65, 1.58)), (77, (2.226, 1.764))):
        root = root_stress(RackWheel(z, 0, z / 2 + 1), TWENTY, 1000, 10, 2, z / 2 + 1)
        assert pytest.approx(printed, rel=0.02) == (root.YF, root.YS)


def test_a_contact_ratio_beyond_the_standard_is_refused() -> None:
    with pytest.raises(RangeError, match="from 1 to 2"):
        RackPair(RackWheel(17, 0, 9.5), RackWheel(51, 0, 26.5), TWENTY, TWENTY, 2.1)


# -------------------------------------------------------------------------------------------------------------- wear


def test_the_loss_of_sharp_triangles_is_that_of_their_polygons() -> None:
    # polygons in contact followed in small steps, apart from this package, with its error of some 1e-4
    expected = {"a~b1": 0.244759, "b2~c1": 0.241991, "c2~d1": 0.376065}
    found = {mesh.name: loss_over_friction(mesh) for mesh in geartrain.load("moon-triangular").meshes}
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, abs=1.5e-4)


def test_the_loss_of_involutes_is_ohlendorfs() -> None:
    # H. Ohlendorf 1958, ISO/TR 14179-2: HV = pi (1/z1 + 1/z2) (1 - eps + eps1^2 + eps2^2)/cos beta, couples sharing
    mesh = next(each for each in geartrain.load("planetary-24-18-60-involute").meshes if each.name == "s~p")
    path = mesh.path
    assert path is not None
    one, two = (arc / path.pitch.p for arc in path.arcs)
    expected = pi * (1 / 24 + 1 / 18) * (1 - one - two + one**2 + two**2)
    assert loss_over_friction(mesh) == pytest.approx(expected, rel=2e-3)
