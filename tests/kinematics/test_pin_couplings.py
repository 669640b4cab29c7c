"""Pins in slots: their mean motion is a winding number."""

from __future__ import annotations

import itertools
import math

import pytest
from models import refusal

from geartrain import load


def lunar(coupling: str) -> str:
    """A pin on k1 and a slot in k2, both riding on e, which turns once while k1 turns ten times."""
    return f"""
        links: {{frame: {{}}, e: {{}}, k1: {{}}, k2: {{}}}}
        revolutes: [{{pair: [frame, e], axis: e}}, {{pair: [e, k1], axis: k1}}, {{pair: [e, k2], axis: k2}}]
        couplings: [{{id: pin, pin: k1, slot: k2, {coupling}}}]
        inputs: {{e: 1, k1: 10}}
    """


@pytest.mark.parametrize(
    ("coupling", "speed"),
    [
        ("kind: pin_and_slot", 10),
        ("kind: pin_and_slot, pin_radius: 9.6 mm, offset: 1.1 mm", 10),
        ("kind: pin_and_slot, pin_radius: 3, offset: 0", 10),
        ("kind: pin_follower", 1),
        ("kind: pin_follower, pin_radius: 1.404 cm, offset: 36 mm", 1),
    ],
)
def test_a_slot_turns_by_the_winding_number_of_its_pin_in_the_carriers_frame(coupling: str, speed: int) -> None:
    train = load(lunar(coupling))
    assert train.solve()["k2"] == speed
    assert train.circuits[0].carrier == "e"
    assert train.mobility.couplings == 1


@pytest.mark.parametrize("turns", [1.1 / 9.6, 36 / 14.04])
def test_the_winding_number_is_what_the_transmission_of_the_slot_gains_in_a_turn(turns: float) -> None:
    # phi + atan2(e sin phi, r - e cos phi), followed numerically over one turn of the pin
    angles, total, steps = [], 0.0, 4000
    for at in range(steps + 1):
        phi = 2 * math.pi * at / steps
        angles.append(phi + math.atan2(turns * math.sin(phi), 1 - turns * math.cos(phi)))
    for before, after in itertools.pairwise(angles):
        total += math.remainder(after - before, 2 * math.pi)
    kind, e = ("pin_and_slot", 1.0) if turns < 1 else ("pin_follower", 1.0)
    speed = load(lunar(f"kind: {kind}, pin_radius: {e}, offset: {turns}")).solve()["k2"]
    assert speed - 1 == pytest.approx(total / (2 * math.pi) * (10 - 1), abs=1e-6)


@pytest.mark.parametrize(
    ("coupling", "said"),
    [
        ("kind: pin_and_slot, pin_radius: 10 mm, offset: 1 cm", "equals the offset"),
        ("kind: pin_and_slot, pin_radius: 1 mm, offset: 2 mm", "is a pin_follower"),
        ("kind: pin_follower, pin_radius: 2 mm, offset: 1 mm", "is a pin_and_slot"),
        ("kind: pin_and_slot, pin_radius: 2 mm, offset: 1", "only one of pin_radius 2 mm and offset 1 has a unit"),
        ("kind: pin_and_slot, pin_radius: 0 mm, offset: 1 mm", "out of range"),
        ("kind: pin_and_slot, pin_radius: 2 mm, offset: -1 mm", "out of range"),
        ("kind: pin_in_hole", "pins_in_holes"),
        ("kind: pin_and_slots", "pin_and_slot"),
    ],
)
def test_couplings_that_contradict_their_dimensions_are_refused(coupling: str, said: str) -> None:
    assert said in refusal(lunar(coupling))


def test_a_coupling_needs_a_carrier_like_a_gear_pair() -> None:
    assert "no carrier" in refusal(lunar("kind: pin_and_slot").replace("axis: k2", "axis: k1"))
