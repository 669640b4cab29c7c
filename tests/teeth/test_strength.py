"""Strength of one pair: printed numbers, closed forms and tables."""

from __future__ import annotations

from math import cos, isinf, pi, radians, sqrt, tan

import numpy as np
import pytest
from sampling import all_but

import geartrain
from geartrain.simulation import PairStrength
from geartrain.simulation.strength.contact_pressure import loss_over_friction
from geartrain.simulation.strength.iso_6336 import RackWheel, ToothLoad, ToothSide, root_stress

TWENTY = radians(20)
Material = tuple[float, float]
STEEL, BRASS, ACRYLIC = (206_000, 0.3), (100_000, 0.35), (3200, 0.35)  # Young's modulus [MPa], Poisson's ratio


def strength(
    counts: tuple[int, int],
    torque: float = 20_000,
    sizes: tuple[float, float] = (2, 20),
    bodies: tuple[Material, Material] = (STEEL, STEEL),
    **form: str,
) -> PairStrength:
    """Strength of a pair: torque of the first wheel [N mm], module and face width [mm], materials of both wheels."""
    module, width = sizes
    wheels = [
        {"teeth": count, "module": f"{module} mm", "face_width": f"{width} mm", "material": f"m{at}"}
        for at, count in enumerate(counts)
    ]
    materials = {
        f"m{at}": {"youngs_modulus": f"{E} MPa", "poisson": str(nu), "strength": "400 MPa"}
        for at, (E, nu) in enumerate(bodies)
    }
    train = geartrain.GearTrain.declare(
        {
            "links": {"frame": {}, "a": {"wheels": {"p": wheels[0]}}, "b": {"wheels": {"w": wheels[1]}}},
            "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]},
            "gears": ["p ~ w"],
            "tooth_form": {"form": "involute"} | form,
            "materials": materials,
            "inputs": {"a": 1},
            "loads": {"b": f"{torque * counts[1] / counts[0] / 1000!r} N m"},
        }
    )
    return train.strength().pairs["p~w"]


def pressures(pair: PairStrength) -> dict[str, float]:
    """Hertzian pressure by place of contact [MPa]."""
    return {place.where: place.pressure for place in pair.contact}


@pytest.mark.parametrize(
    ("first", "second", "printed"),
    [
        (STEEL, STEEL, 189.81),
        (STEEL, BRASS, 155.33),
        (BRASS, BRASS, 134.67),
        (BRASS, STEEL, 155.33),
        (ACRYLIC, ACRYLIC, 24.09),
    ],
)
def test_factors_of_elasticity_are_those_printed(first: Material, second: Material, printed: float) -> None:
    assert strength((17, 51), bodies=(first, second)).elasticity == pytest.approx(printed, abs=0.005)


def test_shigleys_example_14_3_of_a_steel_pinion_on_cast_iron() -> None:
    """Budynas and Nisbett, Shigley's Mechanical Engineering Design, 9th ed. 2011: Cp = 1817, sigma_C = -72 400 psi."""
    psi, inch, pound = 6894.757e-6, 25.4, 4.4482216
    module = inch / 8
    bodies = (30e6 * psi, 0.292), (14.5e6 * psi, 0.211)
    torque = 1.52 * 382 * pound * 8 * module
    pair = strength((16, 50), torque, (module, 1.5 * inch), bodies, addendum="0.9")
    assert pair.elasticity / sqrt(psi) == pytest.approx(1817, abs=1)
    assert pressures(pair)["pitch point"] / psi == pytest.approx(72_400, rel=2e-3)


def test_tooth_pairs_share_and_the_worst_place_is_found() -> None:
    # computed beforehand: 1362 at the start of contact, shared in halves; 796.348 at B; 719 at the pitch point
    pair = strength((17, 51))
    found = pressures(pair)
    assert found["start of contact"] == pytest.approx(1362, abs=1)
    assert {place.where: place.tooth_pairs for place in pair.contact}["start of contact"] == 2
    assert found["inner single contact of gear 1"] == pytest.approx(796.348, abs=0.01)
    assert found["pitch point"] == pytest.approx(719.16, abs=0.01)
    assert found["worst"] == pytest.approx(found["start of contact"])
    assert [wheel.pressure for wheel in pair.wheels] == pytest.approx([796.348] * 2, abs=0.01)


def test_cycloids_have_no_bound_at_the_pitch_point() -> None:
    assert isinf(pressures(strength((8, 60), 10, (1, 2), form="cycloidal"))["pitch point"])


LEWIS = {30: 0.359, 38: 0.384, 43: 0.397, 50: 0.409, 60: 0.422, 75: 0.435, 100: 0.447, 150: 0.460}
"""Lewis's Y for 20 degrees, full depth, load at the tip: Shigley's, 9th ed., table 14-2."""


@pytest.mark.parametrize("z", all_but({38, 43, 60, 75, 100}, LEWIS))
def test_the_form_factor_by_outline_is_that_of_the_table_from_30_teeth_on(z: int) -> None:
    assert strength((z, 60)).wheels[0].lewis == pytest.approx(LEWIS[z], rel=0.02)


def test_the_form_factor_of_40_teeth_worked_out_by_hand() -> None:
    # the round (radius 0.38) about (19.0797, 1.38504) bounds the root: at x = 18.978, half the thickness is 1.01891
    x, half = 18.978, 1.38504 - sqrt(0.38**2 - (19.0797 - 18.978) ** 2)
    aa = np.arccos(20 * cos(TWENTY) / 21)
    gamma = pi / 80 + tan(TWENTY) - TWENTY - (tan(aa) - aa)
    apex = 20 * cos(TWENTY) / cos(aa - gamma)
    by_hand = (2 * half) ** 2 * cos(TWENTY) / (6 * (apex - x) * cos(aa - gamma))
    assert strength((40, 60)).wheels[0].lewis == pytest.approx(by_hand, rel=2e-4)
    assert by_hand == pytest.approx(0.3920, abs=2e-4)
    # with the force along the normal of the last chord of an outline of 0.001 modules it would be 0.389
    assert by_hand == pytest.approx(0.3890, rel=0.01)


@pytest.mark.parametrize(
    ("depth", "stress"), [(0.1, None), (0.3, 16.2379763), (0.5, 9.74278579), (0.6, 7.86614770), (0.0, 38.2070031)]
)
def test_a_triangular_tooth_bends_as_in_closed_form(depth: float, stress: float | None) -> None:
    """Case B4: 10 N normal to the flank at a depth below the apex; width 1.5, height 1.36, 30 degrees, sections from
    half the height.
    """
    apex, height, lean, force, width = 50.0, 1.36, pi / 6, 10.0, 1.5
    foot = apex - height
    side = ToothSide(np.array([[apex, 0.0], [foot, height * tan(lean)]]), 1)
    meets = apex - depth / cos(lean) ** 2
    found = side.weakest_section(ToothLoad(apex - depth, meets, lean))
    across = force * cos(lean)
    if stress is None:
        # the section of 48.7139290 at twice the depth of the line of action is above half the height
        x = height / 2
        stress = 3 * across * (x - depth / cos(lean) ** 2) / (2 * width * x**2 * tan(lean) ** 2)
        assert 3 * force * cos(lean) ** 3 / (8 * width * depth * tan(lean) ** 2) == pytest.approx(48.7139290, rel=1e-8)
    assert found.stress(across * meets, width, 1.0) == pytest.approx(stress, rel=3e-3)


A = ((17, 51), 0.0, (2, 20), 20_000, (STEEL, STEEL))
B = ((12, 60), 0.4, (1, 3), 100, (STEEL, BRASS))
C = ((20, 40), 0.0, (3, 6), 500, (ACRYLIC, ACRYLIC))


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
def test_method_b_gives_numbers_computed_beforehand(case: tuple, contact: tuple, pinion: tuple, wheel: tuple) -> None:
    counts, shift, sizes, torque, bodies = case
    pair = strength(counts, torque, sizes, bodies, shift=[str(shift), str(-shift)])
    found, (own, other) = pair.iso, (each.iso for each in pair.wheels)
    assert (found.ZH, found.Zeps, found.M1, found.nominal, found.stress[0]) == pytest.approx(contact, rel=5e-5)
    assert (own.chord, own.radius, own.lever, own.YF, own.YS, own.stress) == pytest.approx(pinion, rel=3e-4)
    assert (other.YF, other.YS, other.stress) == pytest.approx(wheel, rel=3e-4)


def test_inner_single_contact_by_iso_is_that_of_hertz() -> None:
    # M1 sH0/Zeps is Hertz's pressure where gear 1 begins to bear all
    pair = strength((17, 51))
    iso, hertz = pair.iso, pressures(pair)
    assert iso.M1 * iso.nominal / iso.Zeps == pytest.approx(hertz["inner single contact of gear 1"], rel=1e-6)
    assert iso.M2 * iso.nominal / iso.Zeps == pytest.approx(hertz["inner single contact of gear 2"], rel=1e-6)
    assert iso.nominal / iso.Zeps == pytest.approx(hertz["pitch point"], rel=1e-9)


AT_THE_TIP = {17: (2.97, 1.52), 20: (2.80, 1.55), 25: (2.62, 1.59), 30: (2.52, 1.625), 40: (2.40, 1.67),
              50: (2.32, 1.70), 60: (2.28, 1.73), 80: (2.22, 1.77), 100: (2.18, 1.79),
              24: (2.65, 1.58), 77: (2.226, 1.764)}  # fmt: skip
"""YFa and YSa of DIN 3990 and ISO 6336, load at the tip, 20 degrees, rack 1/1.25/0.38: table 10-5 and example 10-1 of
Pu Lianggui and Ji Minggang, Machine Design (in Chinese), 8th ed. 2006."""


@pytest.mark.parametrize("z", AT_THE_TIP)
def test_factors_at_the_tip_are_those_of_a_printed_table(z: int) -> None:
    found = root_stress(RackWheel(z, 0, z / 2 + 1), TWENTY, 1000, 10, 2, z / 2 + 1)
    assert pytest.approx(AT_THE_TIP[z], rel=0.02) == (found.YF, found.YS)


def test_worked_example_10_1_of_a_textbook() -> None:
    """Spur wheels 24/77, 1.3 times 99 480 N mm, allowed 522.5 MPa, width equal to diameter: d1 = 65.396 mm.

    Pu Lianggui and Ji Minggang, as above.
    """
    d1 = 65.396
    pair = strength((24, 77), 1.3 * 99_480, (d1 / 24, d1))
    assert pair.iso.nominal / pair.iso.Zeps == pytest.approx(522.5, rel=0.005)  # the book leaves the contact ratio out


def test_a_contact_ratio_beyond_the_standard_has_no_stress_of_the_standard() -> None:
    pair = strength((60, 60), addendum="1.35", dedendum="1.6")
    assert pair.iso is None
    assert pair.wheels[0].tip_stress


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
