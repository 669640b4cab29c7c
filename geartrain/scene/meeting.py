"""Where two wheels meet: directions of contact and ways of turning, in the zero pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.scene.space import Vector, across, cross, dot, minus, scaled, size, unit
from geartrain.scene.stage import Stage

if TYPE_CHECKING:
    from geartrain.circuits import Circuit
    from geartrain.layout import WheelPlace

_NONE = 1e-9  # mm, or of a unit vector


@dataclass(frozen=True, slots=True)
class Meeting:
    """The two wheels of a pair.

    contact    unit vectors from their centres, across their axes, to where they touch
    same       1 where both turn about their own direction with teeth going one way at the contact, else -1
    distance   of their axes (mm); None unless these are parallel
    """

    contact: tuple[Vector, Vector]
    same: int
    distance: float | None


def meet(stage: Stage, circuit: Circuit) -> Meeting | None:
    """How the wheels of a pair meet; None for a worm, and for wheels about one axis."""
    wheels = [stage.train.declaration.wheels[name][1] for name in circuit.wheels]
    if "worm" in (wheels[0].kind, wheels[1].kind):
        return None
    first, second = (stage.layout.wheels[name] for name in circuit.wheels)
    axes = stage.reference(first.axis), stage.reference(second.axis)
    parallel = size(cross(*axes)) < _NONE
    if parallel:
        between = across(minus(second.centre, first.centre), axes[0])
        if size(between) < _NONE:
            return None
        n = unit(between)
        back = scaled(n, -1.0)
        # a ring is touched from within, on the far side of its mate
        contact = (back, back) if wheels[1].internal else (n, n) if wheels[0].internal else (n, back)
    else:
        contact = _towards(stage, first, second, axes[0]), _towards(stage, second, first, axes[1])
    ways = [cross(axis, n) for axis, n in zip(axes, contact, strict=True)]
    return Meeting(contact, 1 if dot(*ways) > 0 else -1, size(between) if parallel else None)


def _towards(stage: Stage, own: WheelPlace, mate: WheelPlace, axis: Vector) -> Vector:
    """Across the axis of a bevel wheel towards its mate, which lies off the apex on the side it faces."""
    lies = scaled(stage.along(mate.axis), float(mate.facing)) if mate.facing else minus(mate.centre, own.centre)
    return unit(across(lies, axis))
