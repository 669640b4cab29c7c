"""Plates of shafts: arms that go round what stands in the way, and flanges that clutches take hold of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from geartrain.scene.parts.carried_axes import CarrierSeat, TurningPlate
from geartrain.scene.parts.stack_discs import StackDisc

if TYPE_CHECKING:
    from geartrain.scene.parts.arbor_columns import AxisColumn
    from geartrain.scene.parts.frame_stack import FrameStack

_ARM, _FLANGE, _THIN = 0.3, 0.2, 0.02  # mm in the outermost gaps: arms are nearer to the wheels
_PART = 0.4  # of the widest disc on its axis: a flange
_ROOM = 4.0  # mm of a disc beyond all others on its axis: there a bar stands


def arm_seats(
    stack: FrameStack, column: AxisColumn, ends: Mapping[str, tuple[bool, bool]], slab_gaps: Sequence[float]
) -> Iterator[CarrierSeat]:
    """Arms for links that are tangled on an axis, and go out to dials on one side.

    An arm turns beyond all wheels; a bar beside the axis joins it to the widest disc of its link.
    """
    for link in column.tangled or ():
        below, above = ends.get(link, (False, False))
        about = [disc for disc in stack.discs if disc.axis == column.axis and disc.hub]
        own = [disc for disc in about if disc.link == link]
        if not own or below == above or link == stack.frame:
            continue
        widest = max(own, key=lambda disc: disc.root)
        between = [disc for disc in about if disc.link != link and (disc.middle > widest.middle) == above]
        if all(disc.outer + _ROOM < widest.root for disc in between):
            height = slab_gaps[-1] - _ARM if above else slab_gaps[0] + _ARM
            faces = height - _THIN, height + _THIN
            disc = replace(
                widest, name=f"{link} arm", low=faces[0], high=faces[1], outer=widest.root, root=0.0, apart=True
            )
            yield CarrierSeat(link, disc.name, (TurningPlate(disc),))


def flange_seats(stack: FrameStack, slab_gaps: Sequence[float]) -> Iterator[list[CarrierSeat]]:
    """Flanges, before or behind all wheels, on shafts that have nothing but brakes or clutches."""
    train = stack.train
    held = {link for each in train.declaration.clutches.values() for link in each.locks or (each.fixes,)}
    bearing = {axis.carrier for axis in stack.layout.axes.values()}
    for link, declared in train.declaration.links.items():
        axis = train.kinematics.tree.axis(link) or ""
        radius = _PART * max((disc.outer for disc in stack.discs if disc.axis == axis), default=0.0)
        if link in held - bearing and not declared.wheels and axis in stack.axes and radius:
            at, found = stack.flat(stack.axes[axis].point), []
            for height in (slab_gaps[0] + _FLANGE, slab_gaps[-1] - _FLANGE):
                disc = StackDisc(f"{link} flange", link, axis, at, height - _THIN, height + _THIN, radius)
                found.append(CarrierSeat(link, disc.name, (TurningPlate(disc, round=True, flange=True),)))
            yield found
