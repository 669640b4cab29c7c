"""What hangs on a train as built, in true size: the pendulum of its escapement, and the weight that drives it."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import pi, sqrt
from typing import TYPE_CHECKING

from geartrain.numerics.vectors import cross, dot, plus, scaled
from geartrain.scene.built_elements import SceneHanger
from geartrain.scene.parts.sleeves import free_beside

if TYPE_CHECKING:
    from geartrain.numerics.vectors import Vector
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.train_scene import Scene
    from geartrain.train import Train

_BOB, _THICK = 0.05, 0.4  # a bob's radius over the pendulum's length, and half its thickness over its radius
_ANCHOR = sqrt(2)  # of the escape wheel's radius: where an anchor over a quarter of it turns
_COCK = 2.0  # mm: radius of what bears a pendulum
_AWAY = 2.0  # mm between the frame and a bob
_LEAD = 11.34  # g/cm3
_TALL = 4.0  # height of a weight over its radius
_LINE, _START, _BARREL = 0.6, 150.0, 10.0  # mm: radius of a line, its length in the zero pose, length of a barrel


def find_hangers(scene: Scene, declared: Train, plan: FramePlan) -> tuple[SceneHanger, ...]:
    """Of a train that declares them, and that has a dial by which one knows the way down."""
    stack = plan.stack
    assert stack.normal is not None
    faces = (face for face in scene.dials if abs(dot(face.normal, stack.normal)) > 0.5)
    face = next(faces, None)
    if face is None:
        return ()
    down = scaled(face.zero, -1.0)
    return (*_pendulum(scene, declared, plan, down, face.normal), *_weight(scene, declared, plan, down))


def _pendulum(scene: Scene, declared: Train, plan: FramePlan, down: Vector, front: Vector) -> Iterator[SceneHanger]:
    """Behind the frame, on a cock above the escape wheel."""
    escapement = declared.escapement
    if escapement is None or escapement.pendulum is None:
        return
    index = next(at for at, body in enumerate(scene.bodies) if body.id == escapement.link)
    body = scene.bodies[index]
    wheel = next((each for each in scene.wheels if each.body == index and each.teeth == escapement.teeth), None)
    normal = plan.stack.normal
    assert normal is not None
    if wheel is None or abs(dot(body.direction, normal)) < 1 - 1e-6:
        return
    length = 1000 * escapement.pendulum.si
    bob = _BOB * length
    faces = [face for plate in (plan.places.back, plan.places.front, plan.bridge or ()) for face in plate]
    faces += [face for disc in plan.discs for face in (disc.low, disc.high)]
    side = -1.0 if dot(front, normal) > 0 else 1.0
    behind = max(faces) if side > 0 else min(faces)
    out, hang = scaled(normal, side), abs(behind - dot(body.point, normal)) + _AWAY + _THICK * bob
    above = plus(body.point, down, -_ANCHOR * wheel.radius)
    foot = plus(above, out, abs(behind - dot(body.point, normal)))
    yield SceneHanger("pendulum", index, plus(above, out, hang), body.direction, down, length, escapement.teeth, bob)
    frame = next(at for at, each in enumerate(scene.bodies) if each.parent is None)
    yield SceneHanger("rod", frame, foot, out, down, _AWAY + _THICK * bob + 2 * _COCK, 0.0, _COCK)


def _weight(scene: Scene, declared: Train, plan: FramePlan, down: Vector) -> Iterator[SceneHanger]:
    """On a line from a barrel beside the widest wheel of the link at which power enters."""
    drive = declared.drive
    if drive is None or drive.weight is None or drive.drum is None or scene.crank is None:
        return
    body, drum = scene.bodies[scene.crank], 1000 * drive.drum.si
    own = [(column, each) for column in plan.columns for each in column.members if each.link == body.id]
    way = Fraction(body.speed or 0) * body.sense
    if not own or not own[0][1].discs or not way:
        return
    column, member = own[0]
    widest = max(member.discs, key=lambda disc: disc.outer)
    faces = free_beside(plan, column, member, widest.name, (drum, _BARREL))
    if faces is None:
        return
    low, high = faces
    sign = 1.0 if way > 0 else -1.0
    normal = plan.stack.in_space((0.0, 0.0), 1.0)
    yield SceneHanger("rod", scene.crank, plan.stack.in_space(column.at, low), normal, down, high - low, 0.0, drum)
    middle = plan.stack.in_space(column.at, (low + high) / 2)
    # where the rim of the barrel goes down as it turns forward
    side = plus(middle, cross(down, body.direction), sign * drum)
    radius = (1e6 * drive.weight.si / _LEAD / (pi * _TALL)) ** (1 / 3)
    rate = sign * drum
    yield SceneHanger("line", scene.crank, side, body.direction, down, _START, rate, _LINE)
    yield SceneHanger("weight", scene.crank, side, body.direction, down, _START, rate, radius)
