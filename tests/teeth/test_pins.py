"""Pins in slots: laws against plane geometry, mean ratios by counting turns, the mechanism's own dimensions."""

from __future__ import annotations

import cmath
from math import asin, degrees, pi
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain import load
from geartrain.errors import GearTrainError
from geartrain.teeth import PinToSlotTransmission, SlotToPinTransmission
from geartrain.teeth.couplings.pins import pin_transmission
from geartrain.teeth.pair_results import SlidingEfficiency

TURN = np.linspace(0, 2 * pi, 721)
distances = st.tuples(st.floats(0.1, 10), st.floats(0.1, 10)).filter(lambda pair: abs(pair[0] / pair[1] - 1) > 0.01)


def seen_from_the_slot(r: float, e: float, angles: np.ndarray) -> np.ndarray:
    """Direction of the pin from the slot's axis, turn after turn."""
    return np.unwrap([cmath.phase(cmath.rect(r, angle) - e) for angle in angles])


@given(distances)
def test_the_slot_follows_the_direction_of_the_pin(pair: tuple[float, float]) -> None:
    transmission = PinToSlotTransmission(*pair)
    seen = seen_from_the_slot(*pair, TURN)
    start = 0 if pair[0] > pair[1] else pi
    assert np.allclose(transmission.angle(TURN) + start, seen - seen[0] + (0 if start == 0 else pi), atol=1e-9)
    assert round((seen[-1] - seen[0]) / (2 * pi)) == transmission.ratio


@given(distances.filter(lambda pair: pair[0] > pair[1]))
def test_a_slot_that_drives_undoes_the_pin_that_drives(pair: tuple[float, float]) -> None:
    there, back = PinToSlotTransmission(*pair), SlotToPinTransmission(*pair)
    assert np.allclose(back.angle(there.angle(TURN)), TURN, atol=1e-9)
    assert np.allclose(back.speed(there.angle(TURN)) * there.speed(TURN), 1, rtol=1e-7)


def loss(r: float, e: float, angle: float, friction: float, pin_drives: bool) -> float:
    """Power out over power in by the forces on one pin: a push across the slot, and friction against its sliding."""
    pin = cmath.rect(r, angle)
    arm = pin - e
    along = arm / abs(arm)
    across = along * 1j
    speed = (1j * pin / across).real / abs(arm)
    # velocity of the pin relative to the slot is along it
    sliding = ((1j * pin - 1j * speed * arm) / along).real
    push = 1.0 if speed > 0 else -1.0
    # what the driver does to the other side: a push across, and friction along with the sliding of pin over slot
    on_slot = push * across + friction * (np.sign(sliding) or 0) * along
    if not pin_drives:
        on_slot = push * across - friction * (np.sign(sliding) or 0) * along
    slot_torque = (arm.conjugate() * on_slot).imag
    pin_torque = (pin.conjugate() * on_slot).imag
    out, into = slot_torque * speed, pin_torque
    return out / into if pin_drives else into / out


@pytest.mark.parametrize(("r", "e"), [(9.6, 1.1), (10.0, 6.58), (1.0, 3.0)])
def test_friction_takes_what_the_forces_on_one_pin_say(r: float, e: float) -> None:
    angles = np.linspace(0.1, 6.2, 40)
    transmission = PinToSlotTransmission(r, e, 0.15)
    assert np.allclose(transmission.efficiency(angles), [loss(r, e, a, 0.15, True) for a in angles], rtol=1e-12)
    if r > e:
        back = SlotToPinTransmission(r, e, 0.15)
        slots = PinToSlotTransmission(r, e).angle(angles)
        assert np.allclose(back.efficiency(slots), [loss(r, e, a, 0.15, False) for a in angles], rtol=1e-12)


def test_the_lunar_pin_swings_by_the_arcsine_of_its_dimensions() -> None:
    (joint,) = load("freeth-2008").mechanics.pins
    assert joint.transmission.ratio == 1
    assert joint.transmission.amplitude == pytest.approx(asin(1.1 / 9.6), rel=1e-15)
    assert joint.transmission.speed_range() == pytest.approx((1 / (1 + 1.1 / 9.6), 1 / (1 - 1.1 / 9.6)), rel=1e-14)


def test_the_amplitudes_of_the_planets_are_those_of_their_dimensions() -> None:
    found = {joint.coupling.name: degrees(joint.transmission.amplitude) for joint in load("freeth-2021").mechanics.pins}
    printed = {"mercury": 22.95, "venus": 46.04, "mars": 41.1, "jupiter": 11.08, "saturn": 5.99}
    for name, amplitude in printed.items():
        assert found[name] == pytest.approx(amplitude, abs=0.06 if name == "mars" else 0.006)
    assert found["anomaly"] == pytest.approx(6.58, abs=0.005)


@pytest.mark.parametrize(
    ("planet", "minimum", "most"), [("mars", -0.369, 0.718), ("jupiter", -0.134, 0.232), ("saturn", -0.079, 0.125)]
)
def test_the_superior_planets_turn_back_at_the_speeds_of_the_law(planet: str, minimum: float, most: float) -> None:
    train = load("freeth-2021")
    answer = train.solve()
    (joint,) = (joint for joint in train.mechanics.pins if joint.coupling.name == planet)
    circuit = next(circuit for circuit in train.circuits if circuit.id == planet)
    carrier, pin = float(answer[circuit.carrier]), float(answer[joint.coupling.pin])
    # a pair of equal wheels brings the slot's motion back to the pointer
    speeds = [carrier - factor * (pin - carrier) for factor in joint.transmission.speed_range()]
    mean = carrier - (pin - carrier)
    assert mean == pytest.approx(float(answer[planet]))
    assert sorted(abs(s) * np.sign(s * mean) for s in speeds) == pytest.approx([minimum, most], abs=6e-4)


@pytest.mark.parametrize("r", [2.0, 1 + 1e-6, 1 + 1e-9])
def test_a_slot_that_drives_is_exact_to_rounding_even_if_the_pin_almost_meets_its_axis(r: float) -> None:
    transmission = SlotToPinTransmission(r, 1, 1e-6)
    angles = np.concatenate([np.linspace(0, 3, 31), pi / 2 + np.logspace(-8, -1, 15)])
    with mpmath.workdps(40):
        exact = []
        for angle in map(mpmath.mpf, angles.tolist()):
            sine = mpmath.sin(angle) / mpmath.mpf(r)
            cosine = mpmath.sqrt(1 - sine**2)
            speed = 1 - mpmath.cos(angle) / (mpmath.mpf(r) * cosine)
            exact.append(
                [float(each) for each in (-mpmath.asin(sine), speed, 1 - transmission.friction * sine / cosine)]
            )
    found = np.stack([transmission.error(angles), transmission.speed(angles), transmission.efficiency(angles)], axis=1)
    assert np.abs(found - np.array(exact)).max() < 1e-15


@pytest.mark.parametrize("kind", [PinToSlotTransmission, SlotToPinTransmission])
@pytest.mark.parametrize(("r", "e", "f"), [(9.6, 1.1, 0.2), (10, 5, 0.4), (3, 0, 0.3)])
def test_the_minimum_efficiency_is_the_minimum_of_a_scan(kind: Any, r: float, e: float, f: float) -> None:
    transmission = kind(r, e, f)
    assert transmission.efficiency_minimum() == pytest.approx(
        transmission.efficiency(np.linspace(0, 2 * pi, 100_001)).min(), rel=1e-8
    )


def test_a_pin_that_locks_has_no_efficiency_and_a_follower_none_at_a_constant_load() -> None:
    """A slot locks its pin from the friction at which 1 - f tan d is 0 where sin d = e/r: here tan d = 1/sqrt(3)."""
    locked = SlidingEfficiency(SlotToPinTransmission(10, 5, 1.8)).to_dict()
    none = dict.fromkeys(("mean", "at_constant_load", "min"))
    assert locked == {"friction": 1.8, **none, "locks_at": pytest.approx(3**0.5)}
    follower = SlidingEfficiency(PinToSlotTransmission(5, 10, 0.1)).to_dict()
    assert follower["min"] == 0.0
    assert follower["at_constant_load"] is follower["locks_at"] is None
    assert 0 < follower["mean"] < 1
    assert SlidingEfficiency(PinToSlotTransmission(5, 10)).minimum == 1.0


def test_a_pin_and_its_slot_drive_each_other_by_one_name() -> None:
    there, back = (pin_transmission(9.6, 1.1, 0.1, driver) for driver in ("pin", "slot"))
    assert (there.driver, back.driver) == ("pin", "slot")
    assert there.amplitude == back.amplitude == pytest.approx(asin(1.1 / 9.6))


@pytest.mark.parametrize(
    ("requested", "said", "place"),
    [
        ((1.0, 9.0, 0.0, "slot"), "an oscillating slot cannot drive", "driver"),
        ((9.0, 8.0, 0.6, "slot"), "locks the pin in its slot", "friction"),  # sqrt(81 - 64) / 8 = 0.515
        ((9.0, 9.0, 0.0, "pin"), "through the slot's axis", ""),
    ],
)
def test_a_pin_that_cannot_turn_says_which_parameter_would_let_it(requested: Any, said: str, place: str) -> None:
    with pytest.raises(GearTrainError) as refused:
        pin_transmission(*requested)
    assert said in refused.value.problems[0].what
    assert refused.value.problems[0].place == place
