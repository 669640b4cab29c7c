"""A layout: every axis and every wheel in space, in the pose in which all angles are zero."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from geartrain.errors import Problem
from geartrain.numerics.vectors import Vector

How = Literal["given", "found", "free"]


@dataclass(frozen=True, slots=True)
class AxisPlace:
    """An axis in the zero pose.

    point      a point of it (mm)
    direction  unit vector as declared: speeds of its links are positive about it
    how        given in the declaration, found from wheels that mesh, or free: put where there is room
    carrier    the link that bears it, the frame or a carrier
    """

    label: str
    point: Vector
    direction: Vector
    how: How
    carrier: str


@dataclass(frozen=True, slots=True)
class WheelPlace:
    """A wheel on its axis in the zero pose.

    centre     middle of its pitch circle, on its axis (mm)
    radius     of its pitch circle (mm); at the wide end of a bevel wheel
    module     pitch diameter over tooth count (mm); `given` if the declaration says it
    thickness  of its rim along the axis (mm)
    cone       half angle of its pitch cone (rad): 0 of a cylinder, pi/2 of a crown wheel
    facing     side of the axis, along `direction`, to which the cone opens (1 or -1); 0 of a cylinder
    layer      number of the level it stands in, 0 nearest the origin, growing along the axis; None off the main axes
    turn       angle (rad) of its first tooth about its axis' direction from `reference`, so that teeth mesh
    reference  unit vector across the axis from which `turn` is counted
    """

    wheel: str
    link: str
    axis: str
    centre: Vector
    radius: float
    module: float
    thickness: float
    given: bool = False
    cone: float = 0.0
    facing: int = 0
    layer: int | None = 0
    turn: float = 0.0
    reference: Vector = (1.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Layout:
    """All axes by label and all wheels by id; notices tell what could not be placed, or collides, and why.

    front   the side of z from which the train is looked at: 1 or -1
    """

    axes: Mapping[str, AxisPlace]
    wheels: Mapping[str, WheelPlace]
    notices: tuple[Problem, ...] = ()
    front: int = 1
    apart: Mapping[str, float] = field(default_factory=dict)
    """Gear pairs whose wheels do not touch as placed: how far (mm) their pitch circles are apart, negative into each
    other."""
