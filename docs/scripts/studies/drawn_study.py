"""Teeth as the viewer draws them: by how much they run into each other through a pitch and through the whole cycle."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from stills import open_browser

import geartrain
from geartrain import GearTrain
from geartrain.scene import Scene, build_scene, lay_out
from geartrain.scene.elements import ScenePair
from studies.drawn_solids import DrawnTeeth, opened
from studies.measurement import taken
from studies.records import StudyRecords

if TYPE_CHECKING:
    from playwright.sync_api import Browser

START = Fraction(137, 1000)  # turns of the lead: where nothing stands on a line of symmetry
PITCH, CYCLE = 24, 24  # positions within a pitch of each mesh, and at random within the whole cycle of the train
ASIDE = 0.7  # mm: by how much a slot is turned so that it shows
NOTHING = 1e-6
"""Of a tooth: what rounding may leave of a touch."""


@dataclass(frozen=True)
class DrawnRecord:
    """One train: the worst of its pairs, and the least that any of them would have in common off its phase."""

    train: str
    pairs: int
    positions: int
    worst: float
    pair: str
    turned: float
    left: str


@dataclass(frozen=True)
class DrawnRecords(StudyRecords):
    """All trains."""

    trains: Sequence[DrawnRecord]


def all_trains() -> DrawnRecords:
    """The study, of all shipped trains."""
    return DrawnRecords("Teeth as they are drawn", _records(list(geartrain.shipped()), PITCH, CYCLE))


def _records(names: Sequence[str], pitch: int, cycle: int) -> list[DrawnRecord]:
    with open_browser() as browser:
        return taken((name, partial(_one, browser, name, pitch, cycle)) for name in names)


def _one(browser: Browser, name: str, pitch: int, cycle: int) -> list[DrawnRecord]:
    return [measured(browser, name, pitch, cycle)]


def measured(browser: Browser, name: str, pitch: int, cycle: int) -> DrawnRecord:
    """A shipped train in its first state.

    pitch, cycle   positions within a pitch of each mesh, and at random within the whole cycle
    """
    train = geartrain.load(name)
    scene = build_scene(train)
    left = dict(unfit(train, scene))
    found: dict[str, tuple[float, float]] = {}
    with opened(browser, scene) as teeth:
        for pair in scene.pairs:
            if pair.id not in left:
                found[pair.id] = overlap(teeth, pair, pitch, cycle)
        for coupling in teeth.slotted:
            poses = teeth.matrices([*through_the_cycle(scene, pitch + cycle)])
            there, turned = (max(teeth.in_slot(coupling, each, by) for each in poses) for by in (0.0, ASIDE))
            found[coupling.id] = there, turned
        for coupling in (each for each in scene.couplings if each.id in teeth.holed):
            poses = teeth.matrices([*through_the_cycle(scene, pitch + cycle)])
            there, turned = (max(teeth.in_holes(coupling, each, by) for each in poses) for by in (0.0, ASIDE))
            found[coupling.id] = there, turned
    worst = max(found, key=lambda pair: found[pair][0], default="")
    return DrawnRecord(
        name,
        len(found),
        len(found) * (pitch + cycle),
        found[worst][0] if found else 0.0,
        worst,
        min((turned for _, turned in found.values()), default=0.0),
        "; ".join(f"{pair}: {why}" for pair, why in left.items()),
    )


def overlap(teeth: DrawnTeeth, pair: ScenePair, pitch: int, cycle: int) -> tuple[float, float]:
    """What teeth of a pair have in common at most, and what they would have off their phase, of a tooth."""
    turns = [*through_a_pitch(teeth.scene, pair, pitch), *through_the_cycle(teeth.scene, cycle)]
    poses, bent = teeth.matrices(turns), teeth.bent(turns)
    there = [teeth.common(pair, bodies, bent=thin) for bodies, thin in zip(poses, bent, strict=True)]
    # by less than a pitch: how far teeth with play have to be turned is not known
    turned = [teeth.common(pair, poses[0], eighths / 8, bent[0]) for eighths in range(1, 8)]
    return max(there), max(turned)


def through_a_pitch(scene: Scene, pair: ScenePair, count: int) -> Iterator[Fraction]:
    """Turns of the lead that part a pitch of a mesh evenly."""
    wheel = scene.wheels[pair.wheels[0]]
    rate = abs(_speed(scene, wheel.body) - _speed(scene, pair.carrier)) or Fraction(1)
    return (START + Fraction(at, count) / (wheel.teeth * rate) for at in range(count))


def through_the_cycle(scene: Scene, count: int) -> Iterator[Fraction]:
    """Turns of the lead at random before all stands as at the beginning, the same in every run."""
    draw = random.Random(scene.name)
    period = Fraction(scene.movement.period or 1)
    return (period * Fraction(draw.randrange(10**9), 10**9) for _ in range(count))


def _speed(scene: Scene, body: int) -> Fraction:
    return scene.bodies[body].sense * Fraction(scene.bodies[body].speed or 0)


def unfit(train: GearTrain, scene: Scene) -> Iterator[tuple[str, str]]:
    """Pairs that cannot stand as declared, which the train is told of, and why."""
    apart = lay_out(train).apart
    for pair in scene.pairs:
        if pair.broken:
            yield pair.id, "in a loop that does not close"
        elif apart.get(pair.id, 0.0) < 0:
            yield pair.id, f"its axes are {-apart[pair.id]:g} mm too near"
        elif any(f"the teeth of '{pair.id}' do not mesh" in notice["what"] for notice in scene.notices):
            yield pair.id, "closes a loop, and its teeth do not meet"
