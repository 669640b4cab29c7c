"""Pillars: as thick as they must be and no thicker, and even about what the plates bear."""

from __future__ import annotations

from math import dist, pi

import numpy as np
import pytest
from shipped import built

from geartrain.scene.elements import ScenePart

BRASS = 100_000.0  # N/mm2, Young's modulus
PUSH = 10.0  # N, of a hand at the crank


def parts(name: str, kind: str) -> list[ScenePart]:
    return [part for part in built(name).parts if part.kind == kind]


def thickness(pillar: ScenePart) -> float:
    return 2 * max(radius for _, _, radius, _ in pillar.bands)


@pytest.mark.parametrize("name", ["worm", "bevel-differential", "humpage", "south-pointing-chariot", "zf-8hp70"])
def test_pillars_are_thin_beside_their_plates_and_stiff_enough(name: str) -> None:
    """Beams held at both ends, which one end leaves sideways: F l^3 / 12 E I a pillar (Roark, table 8.1, case 1b)."""
    found = parts(name, "pillar")
    corners = np.array(parts(name, "frame")[0].outlines[0]).reshape(-1, 2)
    assert all(thickness(pillar) <= max(3.0, 0.062 * dist(np.ptp(corners, axis=0), (0, 0))) for pillar in found)
    stiffness = 0.0
    for pillar in found:
        length = max(high - low for low, high, _, _ in pillar.bands)
        stiffness += 12 * BRASS * pi * thickness(pillar) ** 4 / 64 / length**3
    assert PUSH / stiffness < 0.02, "mm: a tenth of the shake of an arbor"


@pytest.mark.parametrize("name", ["planetary-24-18-60", "two-k-h-10000", "ferguson-paradox", "zf-8hp70"])
def test_pillars_of_a_train_about_one_axis_stand_evenly_to_its_left_and_right(name: str) -> None:
    """Else three stood at one end and one at the other, and the plate was a wedge."""
    places = np.array([pillar.place[:2] for pillar in parts(name, "pillar")])
    (axis,) = {part.place[:2] for part in parts(name, "arbor") if part.body and "planet" not in part.name}
    left, right = (places[side * (places[:, 0] - axis[0]) > 0] - axis for side in (-1, 1))
    assert len(left) == len(right) == 2
    assert np.abs(left).mean(axis=0) == pytest.approx(np.abs(right).mean(axis=0), abs=0.3)
    assert np.abs(places - axis)[:, 1].max() < 0.2 * np.abs(places - axis)[:, 0].min()
