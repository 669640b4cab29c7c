"""Levers: abscissae by Willis' equation by hand, and speeds that lie on a line."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from typing import Any

import pytest
from shipped import train

from geartrain import GearTrain
from geartrain.kinematics.levers import find_levers


def levers(of: GearTrain) -> list[Any]:
    """The levers of a train."""
    return find_levers(of.declaration, of.kinematics.tree, of.circuits)


def test_the_abscissae_of_a_simple_set_are_its_tooth_ratios() -> None:
    (lever,) = levers(train("planetary-24-18-60"))
    assert dict(lever.abscissae) == {"carrier": 0, "sun": 1, "frame": Fraction(-24, 60)}


def test_levers_of_a_transmission_are_its_four_sets_by_willis() -> None:
    by_hand = {  # z_s (w_s - w_c) = -z_r (w_r - w_c)
        "C1R4": {"C1R4": 0, "S12": 1, "R1": Fraction(-48, 96)},
        "IN": {"IN": 0, "S12": 1, "R2S3": Fraction(-48, 96)},
        "C3": {"C3": 0, "R2S3": 1, "R3S4": Fraction(-69, 111)},
        "OUT": {"OUT": 0, "R3S4": 1, "C1R4": Fraction(-23, 85)},
    }
    assert {lever.carrier: dict(lever.abscissae) for lever in levers(train("zf-8hp70"))} == by_hand


@pytest.mark.parametrize("name", ["zf-8hp70", "ravigneaux-set", "bevel-differential", "freeth-2021", "wolfrom-175"])
def test_the_speeds_of_every_set_lie_on_a_line(name: str) -> None:
    declared = train(name)
    for state in declared.states or (None,):
        speeds = declared.solve(state, method="exact").speeds
        for lever in levers(declared):
            points = [(x, speeds[link] * declared.kinematics.signs.get(link, 1)) for link, x in lever.abscissae.items()]
            for (a, u), (b, v), (c, w) in combinations(points, 3):
                assert (b - a) * (w - u) == (c - a) * (v - u)
