"""A scene as it stands on paper after some turns: outlines of wheels, arms, pins, seen from a direction."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.backend import Axes
from geartrain.numerics.polylines import simplified
from geartrain.scene import Scene, SceneCoupling, SceneWave, SceneWheel
from geartrain.scene.layout.wheel_reach import CROWN, height_on_cone, taper
from geartrain.scene.pose import ScenePose, scene_pose
from geartrain.teeth.outlines.fixed_teeth import bent_line

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_OBLIQUE = (0.52, -0.62, 0.59)  # towards the reader, of trains that do not lie in one plane
_MOST = 0.7  # of the wheels that must face the reader in a plan; the others are then seen from the side
_ROUND = 73  # points of a circle
_FINE = 5000  # teeth beyond which nobody sees them on paper: such a wheel is drawn as a circle


@dataclass(frozen=True, slots=True)
class ProjectedScene:
    """A scene in a pose, and the directions right, up and towards the reader as rows of `screen` (3, 3)."""

    scene: Scene
    pose: ScenePose
    screen: Floats

    @property
    def flat(self) -> bool:
        """True if most wheels face the reader."""
        return sum(map(self.faces, self.scene.wheels)) >= _MOST * len(self.scene.wheels)

    def faces(self, wheel: SceneWheel) -> bool:
        """True if a wheel is seen along its axis."""
        # the cosine is flat there: 1e-9 off 1 is 0.0026 deg, less than any declared tilt and more than rounding
        return abs(float(self.axis(wheel) @ self.screen[2])) > 1 - 1e-9

    def seen(self, points: object) -> Floats:
        """Right, up and towards the reader of points (..., 3)."""
        return np.asarray(np.asarray(points, dtype=float) @ self.screen.T)

    def axis(self, wheel: SceneWheel) -> Floats:
        """Unit vector along the axis of a wheel, towards its body's direction."""
        return self.pose.way(wheel.body, wheel.direction)

    def centre(self, wheel: SceneWheel) -> Floats:
        """Middle of the pitch circle of a wheel."""
        return self.pose.point(wheel.body, wheel.centre)

    def outline(self, wheel: SceneWheel, scale: float = 1.0, height: float = 0.0, chord: float = 0.0) -> Floats:
        """Teeth of a wheel (points, 3) times `scale`, moved along its axis by `height` (mm) as its helix winds.

        chord   how far (mm) points that are left out may lie beside the line
        """
        profile = self.scene.profiles[wheel.profile]
        tooth = np.array(profile.points)
        flat = tooth[:, :1] * np.stack([np.cos(tooth[:, 1]), np.sin(tooth[:, 1])], axis=1)
        tooth = tooth[simplified(flat, chord / (wheel.radius * scale))]
        if profile.hole or wheel.teeth > _FINE:
            return self.circle(wheel, wheel.tip * scale, height)
        radius = wheel.radius * scale * np.tile(tooth[:-1, 0], wheel.teeth)
        steps = 2 * np.pi / wheel.teeth * np.arange(wheel.teeth)
        first = wheel.turn + (0.0 if wheel.cone else height * np.tan(wheel.helix) / wheel.radius)
        angle = first + (steps[:, None] + tooth[None, :-1, 1]).ravel()
        if wave := self.wave(wheel):
            return self._bent(wave, radius, angle)
        return self._around(wheel, radius, angle, height)

    def wave(self, wheel: SceneWheel) -> SceneWave | None:
        """What bends a wheel, if it is thin."""
        return next((each for each in self.scene.waves if self.scene.wheels[each.wheel] is wheel), None)

    def bore(self, wave: SceneWave) -> Floats:
        """The edge of a wave, on which its wheel runs (points, 3)."""
        angle = np.linspace(0, 2 * np.pi, _ROUND)
        return self._bent(wave, np.full(_ROUND, wave.middle - wave.wall / 2), angle)

    def _bent(self, wave: SceneWave, radius: Floats, angle: Floats) -> Floats:
        """Points (n, 3) of the middle plane of a thin wheel as its wave bends it.

        radius, angle   (n,) of them in the round wheel, from its reference
        """
        wheel = self.scene.wheels[wave.wheel]
        first, along = np.array(wheel.reference), np.array(wheel.direction)
        x, y = first @ wave.towards, np.cross(along, first) @ wave.towards
        lobe = np.arctan2(y, x) + self.pose.angles[wave.by] - self.pose.angles[wheel.body]
        line = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        found = bent_line(line, wave.middle, (wave.rise, wave.lobes), (0.0, float(lobe)))
        return self._around(wheel, np.hypot(*found.T), np.arctan2(found[:, 1], found[:, 0]), 0.0)

    def lobes(self, wave: SceneWave) -> Floats:
        """Points (lobes, 3) of the bore of a thin wheel that its wave presses out the most."""
        wheel = self.scene.wheels[wave.wheel]
        bore = wave.middle + wave.rise - wave.wall / 2
        turn = 2 * np.pi * np.arange(wave.lobes) / wave.lobes
        first, along = np.array(wave.towards), np.array(wheel.direction)
        ring = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * np.cross(along, first)
        # of the generator, about whose axis the wheel stands too
        return self.pose.point(wave.by, np.array(wheel.centre) + bore * ring)

    def circle(self, wheel: SceneWheel, radius: float, height: float = 0.0) -> Floats:
        """A circle about a wheel's axis (points, 3)."""
        angle = np.linspace(0, 2 * np.pi, _ROUND)
        return self._around(wheel, np.full(_ROUND, radius), angle, height)

    def pins(self, wheel: SceneWheel) -> Iterator[Floats]:
        """The pins of a lantern, (points, 3) each; of other wheels none."""
        profile = self.scene.profiles[wheel.profile]
        if profile.hole and wheel.teeth <= _FINE:
            tooth = np.array(profile.points)
            for at in range(wheel.teeth):
                angle = wheel.turn + 2 * np.pi * at / wheel.teeth + tooth[:, 1]
                yield self._around(wheel, wheel.radius * tooth[:, 0], angle, 0.0)

    def _around(self, wheel: SceneWheel, radius: Floats, angle: Floats, height: float) -> Floats:
        along, first = np.array(wheel.direction), np.array(wheel.reference)
        second = np.cross(along, first)
        ring = np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second
        return self.pose.point(wheel.body, np.array(wheel.centre) + radius[:, None] * ring + height * along)

    def ends(self, wheel: SceneWheel) -> tuple[tuple[float, float], tuple[float, float]]:
        """Height along the axis (mm) and scale of the two ends of a wheel; of a bevel wheel the wide end first."""
        half = wheel.thickness / 2
        if wheel.cone <= 0 or wheel.cone > CROWN:  # which has no narrow end
            return (half, 1.0), (-half, 1.0)
        narrow = taper(wheel.cone, wheel.radius, wheel.thickness)
        return (0.0, 1.0), (-wheel.facing * height_on_cone(wheel.cone, wheel.radius, 0.0, narrow), narrow)


def project_scene(scene: Scene, turns: Fraction) -> ProjectedScene:
    """A scene after some turns of its lead, from the front where most axes are parallel, else obliquely."""
    posed = scene_pose(scene, turns)
    front = ProjectedScene(scene, posed, np.diag([float(scene.front), 1.0, float(scene.front)]))
    return front if front.flat else ProjectedScene(scene, posed, _screen(np.array(_OBLIQUE)))


def _screen(view: Floats) -> Floats:
    towards = view / np.linalg.norm(view)
    right = np.cross([0.0, 0.0, 1.0], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


class ScaledPage:
    """Axes in inches on which millimetres are drawn.

    foot   height of the words below the side view
    """

    def __init__(self, axes: Axes, scale: float, shift: Floats, foot: float = 0.0) -> None:
        self.axes, self.scale, self.shift, self.foot = axes, scale, shift, foot

    def at(self, seen: Floats) -> Floats:
        """Inches (..., 2) of what is seen (..., 3)."""
        return np.asarray(seen[..., :2] * self.scale + self.shift)


def arms_of(standing: ProjectedScene) -> Iterator[tuple[int, Floats, Floats]]:
    """Body, own axis and borne axis of every arm of a carrier, as points of space."""
    scene = standing.scene
    seen = set()
    for at, body in enumerate(scene.bodies):
        if body.parent is None or scene.bodies[body.parent].role != "carrier":
            continue
        ends = standing.pose.point(body.parent, scene.bodies[body.parent].point), standing.pose.point(at, body.point)
        key = (body.parent, *np.round(ends[1], 6))
        if key not in seen:
            seen.add(key)
            yield body.parent, *ends


def coupling_spans(
    standing: ProjectedScene, coupling: SceneCoupling, at: Callable[[Floats], Floats], scale: float
) -> list[Floats]:
    """Lines (2, 2) over what a coupling takes of a plan [inches]: along its slot, or two across each of its holes.

    at, scale   inches (..., 2) of what is seen (..., 3), and of a millimetre
    """
    pose, half = standing.pose, coupling.hole / 2 * scale
    if coupling.hole:
        middles = [at(standing.seen(pose.point(coupling.slot, place))) for place in coupling.holes_at]
        across = half * np.array([[[-1, 0], [1, 0]], [[0, -1], [0, 1]]])
        return [middle + line for middle in middles for line in across]
    pin = at(standing.seen(pose.point(coupling.pin, coupling.pin_at)))
    body = standing.scene.bodies[coupling.slot]
    hub = at(standing.seen(pose.point(coupling.slot, coupling.slot_at if body else body.point)))
    along, reach = pin - hub, coupling.offset * scale
    far = float(np.hypot(*along)) or 1.0
    return [hub + np.outer([max(far - 1.2 * reach, 0.3 * far), far + 0.6 * reach + 0.04], along / far)]


def broken_wheels(scene: Scene) -> set[str]:
    """Wheels of pairs in a loop that does not close."""
    return {scene.wheels[wheel].id for pair in scene.pairs if pair.broken for wheel in pair.wheels}
