"""Thin wheels that a wave bends into their rings: where they stand, and what the wave does to them.

A train declares such a wheel on an axis that a generator carries round, as if it were stiff: that gives its speed.
Bent, it stays about the generator's own axis, and its teeth come to the ring at each lobe (docs/reducers.md, (8)).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from geartrain.numerics.vectors import Vector, across, minus, size, unit_or_z
from geartrain.scene.elements import SceneBody, SceneWave, SceneWheel
from geartrain.teeth.outlines.fixed_teeth import wall

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.context import SceneContext
    from geartrain.scene.layout import Layout


@dataclass(frozen=True, slots=True)
class BentWheel:
    """A thin wheel and its generator.

    wheel, link   its own, and the link whose wave bends it
    axis          label of the generator's axis
    offset        from that to the axis on which the wheel is declared (mm): how far its wave rises, and towards where
    lobes         of the wave: as many as the ring has teeth more
    """

    wheel: str
    link: str
    axis: str
    offset: Vector
    lobes: int


def bent_wheels(train: GearTrain, layout: Layout) -> Iterator[BentWheel]:
    """All of a train as placed."""
    declared = train.declaration
    for gear in declared.gears:
        thin = next((name for name in gear.pair if declared.wheels[name][1].flexible), None)
        place = None if thin is None else layout.axes.get(train.kinematics.tree.axis(declared.wheels[thin][0]) or "")
        label = None if place is None else train.kinematics.tree.axis(place.carrier)
        if thin is None or place is None or label is None:
            continue
        own = layout.axes[label]
        counts = (declared.wheels[name][1] for name in gear.pair)
        lobes = abs(sum((wheel.count or 0) * (1 if wheel.internal else -1) for wheel in counts))
        offset = across(minus(place.point, own.point), unit_or_z(own.direction))
        if lobes and size(offset):
            yield BentWheel(thin, place.carrier, label, offset, lobes)


def bend(
    stage: SceneContext, bodies: Sequence[SceneBody], wheels: Sequence[SceneWheel]
) -> tuple[tuple[SceneBody, ...], tuple[SceneWheel, ...], tuple[SceneWave, ...]]:
    """Bodies and wheels with those that are bent about the axes of their generators, and the waves that bend them."""
    told, moved, waves = list(bodies), list(wheels), []
    for each in bent_wheels(stage.train, stage.layout):
        at, by = stage.wheel[each.wheel], stage.body[each.link]
        wheel = wheels[at]
        told[wheel.body] = replace(bodies[wheel.body], parent=bodies[by].parent, point=bodies[by].point)
        moved[at] = replace(wheel, centre=minus(wheel.centre, each.offset))
        way, rise, thin = unit_or_z(each.offset), size(each.offset), wall(wheel.radius)
        waves.append(SceneWave(at, by, way, rise, each.lobes, wheel.root - thin / 2, thin))
    return tuple(told), tuple(moved), tuple(waves)
