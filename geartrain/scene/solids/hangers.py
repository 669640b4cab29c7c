"""What hangs on a train as built, in true size: the pendulum of its escapement, and the weight that drives it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector, cross, dot, plus, scaled
from geartrain.scene.built_elements import SceneHanger
from geartrain.scene.parts.ring_posts import TENON
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.solid_part import SolidPart
from geartrain.train.wheel_stock import material_named

if TYPE_CHECKING:
    from geartrain.scene.parts.barrels import Barrel
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.train_scene import Scene
    from geartrain.train import Train

_BOB, _THICK = 0.05, 0.25  # a bob's radius over the pendulum's length, and half its thickness over its radius
_ROD = 0.04  # a pendulum's rod: its radius over the bob's
_TALL = 4.0  # height of a weight over its radius
_ANCHOR = sqrt(2)  # of the escape wheel's radius: where an anchor over a quarter of it turns
_COCK = 2.0  # mm: radius of what bears a pendulum
_AWAY = 2.0  # mm between the frame and a bob
_LINE, _START = 0.6, 150.0  # mm: radius of a line, its length in the zero pose


@dataclass(frozen=True)
class HangingParts:
    """Of a train that declares them, and that has a dial by which one knows the way down."""

    scene: Scene
    declared: Train
    plan: FramePlan
    barrel: Barrel | None

    def found(self) -> tuple[SceneHanger, ...]:
        """The pendulum, then the line and the weight."""
        return () if self.front is None else tuple(each for each in (self.pendulum, *self._weight()) if each)

    @property
    def frame(self) -> int:
        """Index of the body of the frame."""
        return next(at for at, body in enumerate(self.scene.bodies) if body.id == self.plan.stack.frame)

    @cached_property
    def front(self) -> tuple[Vector, Vector] | None:
        """Towards the reader, and down."""
        normal = self.plan.stack.normal
        assert normal is not None
        faces = (face for face in self.scene.dials if abs(dot(face.normal, normal)) > 0.5)
        face = next(faces, None)
        return None if face is None else (face.normal, scaled(face.zero, -1.0))

    @cached_property
    def pendulum(self) -> SceneHanger | None:
        """Behind the frame, above the escape wheel."""
        escapement, normal = self.declared.escapement, self.plan.stack.normal
        assert normal is not None
        if self.front is None or escapement is None or escapement.pendulum is None:
            return None
        index = next(at for at, body in enumerate(self.scene.bodies) if body.id == escapement.link)
        body = self.scene.bodies[index]
        if body.parent != self.frame:
            return None  # pallets ride on a carriage, which takes no pendulum round
        wheels = (each for each in self.scene.wheels if each.body == index and each.teeth == escapement.teeth)
        wheel = next(wheels, None)
        if wheel is None or abs(dot(body.direction, normal)) < 1 - 1e-6:
            return None
        length, down = 1000 * escapement.pendulum.si, self.front[1]
        bob = _BOB * length
        behind = self._side * (_AWAY + _THICK * bob) + self._last
        above = plus(body.point, down, -_ANCHOR * wheel.radius)
        point = plus(above, normal, behind - dot(above, normal))
        return SceneHanger("pendulum", index, point, body.direction, down, length, escapement.teeth, bob)

    @property
    def _side(self) -> float:
        """1 where the reader looks against the normal, and what is behind the frame is above it; else -1."""
        assert self.front is not None
        assert self.plan.stack.normal is not None
        return -1.0 if dot(self.front[0], self.plan.stack.normal) > 0 else 1.0

    @property
    def _last(self) -> float:
        """Height of what is behind all else."""
        places, way = self.plan.places, max if self._side > 0 else min
        faces = [face for plate in (places.back, places.front, self.plan.bridge or ()) for face in plate]
        return way([*faces, *(face for disc in self.plan.discs for face in (disc.low, disc.high))])

    def cock(self) -> Iterator[TurnedPart]:
        """The stud in the frame on which a pendulum hangs."""
        if self.pendulum is None:
            return
        stack, places, side = self.plan.stack, self.plan.places, self._side
        assert stack.normal is not None
        plate = max((places.back, places.front), key=lambda faces: side * faces[0])
        end = dot(self.pendulum.point, stack.normal) + side * 2 * _COCK
        low, high = sorted((plate[1] if side > 0 else plate[0], end))
        bands = Band(*plate, TENON * _COCK), Band(low, high, _COCK)
        at, joint = stack.flat(self.pendulum.point), f"in its plate, {self.plan.process.joint}"
        yield TurnedPart(stack.frame, "pendulum cock", "cock", at, bands if side > 0 else bands[::-1], joint)

    def _weight(self) -> Iterator[SceneHanger]:
        """On a line from the barrel."""
        barrel, drive, crank = self.barrel, self.declared.drive, self.scene.crank
        if barrel is None or drive is None or drive.weight is None or crank is None or self.front is None:
            return
        body, down = self.scene.bodies[crank], self.front[1]
        way = Fraction(body.speed or 0) * body.sense
        if not way:
            return
        middle = self.plan.stack.in_space(barrel.at, (barrel.low + barrel.high) / 2)
        # where the rim of the barrel goes down as it turns forward
        rate = barrel.radius if way > 0 else -barrel.radius
        side = plus(middle, cross(down, body.direction), rate)
        lead = material_named(self.declared, "lead").density
        assert lead is not None
        radius = 1000 * (drive.weight.si / lead.si / (pi * _TALL)) ** (1 / 3)
        yield SceneHanger("line", crank, side, body.direction, down, _START, rate, _LINE)
        yield SceneHanger("weight", crank, side, body.direction, down, _START, rate, radius)


def hanging_solids(hanger: SceneHanger, frame: int) -> Iterator[SolidPart]:
    """The turned parts of what hangs, which hang still with the frame (its index); a line is bought."""
    end, wide = plus(hanger.point, hanger.down, hanger.length), hanger.wide
    if hanger.kind == "pendulum":
        rod = Band(_COCK, hanger.length - wide, _ROD * wide)
        yield _turned(frame, "pendulum rod", (hanger.point, hanger.down, hanger.direction), rod)
        bob = Band(-_THICK * wide, _THICK * wide, wide)
        yield _turned(frame, "pendulum bob", (end, hanger.direction, hanger.down), bob)
    elif hanger.kind == "weight":
        yield _turned(frame, "weight", (end, hanger.down, hanger.direction), Band(0.0, _TALL * wide, wide))


def _turned(frame: int, name: str, place: tuple[Vector, Vector, Vector], band: Band) -> SolidPart:
    at, z, x = place
    turn = np.column_stack([x, cross(z, x), z])
    kind = name.split()[-1]
    part = TurnedPart("", name, kind, (0.0, 0.0), (band,))
    return SolidPart(frame, name, kind, turn, np.array(at), turned=part)
