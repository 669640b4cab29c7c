"""Teeth of the viewer as solids: they do not overlap in the poses in which they are drawn."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

pytest.importorskip("manifold3d", reason="the extra proof is not installed")

import shipped
from studies.drawn_solids import opened
from studies.drawn_study import ASIDE, NOTHING, measured, overlap, through_the_cycle

if TYPE_CHECKING:
    from playwright.sync_api import Browser

# rings, involutes of no play, bevels, crowns and pins, triangular teeth on and off the phase of their law, a disc among
# pins, a worm, circular arcs that ripple, a ring of two teeth more than its wheel, wheels of three teeth, a bent one
TRAINS = (
    "planetary-24-18-60-involute",
    "planetary-24-18-60-triangular",
    "humpage",
    "lantern-mill",
    "moon-triangular",
    "pennestri-2002-teeth",
    "cycloidal-reducer",
    "worm",
    "longcase-clock-bs978",
    "norton-compound",
    "lu-daolong-hodometer",
    "crossed-helical",
    "strain-wave",
)


@pytest.mark.parametrize("name", TRAINS)
def test_drawn_teeth_have_nothing_in_common_through_a_pitch_and_through_the_cycle(browser: Browser, name: str) -> None:
    found = measured(browser, name, 4, 3)
    assert not found.left
    assert found.worst < NOTHING, found.pair
    assert found.turned > 0.01, "off its phase every pair is found"


def test_a_wheel_that_stands_off_its_phase_is_found(browser: Browser) -> None:
    scene = shipped.built("planetary-24-18-60")
    with opened(browser, scene) as teeth:
        for pair in scene.pairs:
            kept, turned = overlap(teeth, pair, 1, 0)
            assert kept < NOTHING
            assert turned > 0.2, "half of a tooth and more, which its sector of the rim contains"


def test_a_pin_stays_in_its_slot_whether_sizes_are_declared_or_chosen(browser: Browser) -> None:
    scene = shipped.built("freeth-2021")
    with opened(browser, scene) as teeth:
        names = {coupling.id for coupling in teeth.slotted}
        assert names == {"mercury", "venus", "true_sun", "mars", "jupiter", "saturn"}
        assert {coupling.drawn for coupling in teeth.slotted} == {True, False}
        for coupling in teeth.slotted:
            poses = teeth.matrices([*through_the_cycle(scene, 6)])
            assert max(teeth.in_slot(coupling, each) for each in poses) < NOTHING, coupling.id
            assert max(teeth.in_slot(coupling, each, ASIDE) for each in poses) > 0.01, coupling.id


def test_a_pendulum_swings_once_a_tooth_and_a_weight_falls_as_its_barrel_turns(browser: Browser) -> None:
    scene = shipped.built("longcase-clock")
    with opened(browser, scene) as drawn:
        poses = drawn.matrices([Fraction(0), Fraction(1, 7200), Fraction(3, 7200), Fraction(1, 4), Fraction(12)])
    bodies = poses[:, -len(scene.hangers) :]  # after all other wheels
    where = {hanger.kind: at for at, hanger in enumerate(scene.hangers)}
    end = {}
    for kind in ("pendulum", "line", "weight"):
        hanger = scene.hangers[where[kind]]
        start = np.array([*np.add(hanger.point, np.multiply(hanger.down, hanger.length)), 1.0])
        end[kind] = (bodies[:, where[kind]] @ start)[:, :3] - start[:3]
    down = np.array(scene.hangers[where["weight"]].down)
    aside = np.linalg.norm(end["pendulum"], axis=1)
    # the driving link turns once per hour; after 0.5 s of a period of 2 s the deflection is 994 mm times 2 degrees
    assert aside[1] == pytest.approx(34.8, abs=0.1)
    assert end["pendulum"][2] == pytest.approx(end["pendulum"][1] * [-1, 1, 1], abs=1e-3), "to the other side"
    assert aside[[0, 3]] == pytest.approx([0, 0], abs=1e-3), "after 450 swings"
    assert end["weight"] @ down == pytest.approx(end["line"] @ down, abs=1e-6)
    # 16 turns of line in 8 days of 24 hours
    fall = 16 * 2 * np.pi * 12.7 / 192
    assert end["weight"] @ down == pytest.approx(fall * np.array([0, 1 / 7200, 3 / 7200, 0.25, 12]), abs=1e-3)
