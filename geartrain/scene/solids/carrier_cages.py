"""Cages: what a carrier holds axes with that lie at an angle to its own, as those of the pinions of a differential.

An eye bears the outer end of the pinion's arbor. A post leads from it along the carrier's axis: to a wheel of the
carrier that reaches so far out, else to an arm beyond all wheels which reaches in to the carrier's axis; to one beside
the pinion where a plate of the frame stands before the wheel.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.parts.ring_posts import TENON
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import around, basis
from geartrain.scene.solids.brackets import GAP, LAND, on_axis, wheel_ends
from geartrain.scene.solids.solid_part import SolidPart
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneBody, SceneWheel
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.train_scene import Scene

_ARM = 1.0  # mm: thickness of an arm
_PAST = 0.25  # mm between a wheel and an arm
_SAME = 1e-6


@dataclass(frozen=True)
class Cage:
    """What holds the axis of one body: `reach`, places along its direction that its arbor goes on to (mm)."""

    body: int
    reach: float
    parts: tuple[SolidPart, ...]


def find_cages(scene: Scene, plan: FramePlan, bores: Mapping[str, float]) -> tuple[Cage, ...]:
    """Of every axis that is carried round at an angle to that of its carrier; `bores`, as for brackets."""
    found = []
    for at, body in enumerate(scene.bodies):
        carrier = None if body.parent is None else scene.bodies[body.parent]
        if carrier is None or carrier.parent is None or not bores.get(body.axis) or wheel_ends(scene, at) is None:
            continue
        if abs(float(np.dot(body.direction, carrier.direction))) < 1 - _SAME:
            found.append(_Holder(scene, plan, at, bores).cage())
    return tuple(found)


@dataclass(frozen=True)
class _Holder:
    scene: Scene
    plan: FramePlan
    at: int
    bores: Mapping[str, float]

    @property
    def body(self) -> SceneBody:
        return self.scene.bodies[self.at]

    @property
    def index(self) -> int:
        assert self.body.parent is not None
        return self.body.parent

    @property
    def carrier(self) -> SceneBody:
        return self.scene.bodies[self.index]

    @property
    def along(self) -> Floats:
        """Direction of the carrier's axis."""
        return np.array(self.carrier.direction)

    def height(self, point: object) -> float:
        """Along the carrier's axis, from its point."""
        return float((np.asarray(point, dtype=float) - np.array(self.carrier.point)) @ self.along)

    def cage(self) -> Cage:
        radius = self.bores[self.body.axis] / 2
        post = min(2.0, 0.6 + 0.8 * radius)
        side, end = self._outer_end()
        eye = self._eye(radius, post, end + side * (GAP + post))
        height = self.height(eye.place)
        aside = eye.place - on_axis(self.carrier, height)
        away = float(np.hypot(*self._flat(aside)))
        seat = self._own_wheel(height, away)
        if seat is not None and self._is_behind_a_plate(height, seat):
            seat, level = None, self._beside(height)
        else:
            level = self._level(height, away - post) if seat is None else seat
        way = 1 if level > height else -1
        ends = [height + way * (radius + LAND / 2), level]
        if seat is None:  # through the arm
            ends[1:] = level - way * _ARM / 2, level + way * _ARM / 2
        parts = [eye, self._post(eye.place - height * self.along, ends, post)]
        if seat is None:
            parts.append(self._arm(aside, away, level, post))
        return Cage(self.at, end + side * (GAP + 2 * post), tuple(parts))

    def _flat(self, aside: Floats) -> tuple[float, float]:
        right, up = basis(self.carrier.direction)
        return float(aside @ np.array(right)), float(aside @ np.array(up))

    def _outer_end(self) -> tuple[int, float]:
        """On which side, and where along its arbor, the last wheel ends, away from the carrier's axis."""
        ends = wheel_ends(self.scene, self.at)
        assert ends is not None
        normal = np.cross(self.body.direction, self.along)
        gap = np.array(self.carrier.point) - np.array(self.body.point)
        near = float(np.cross(gap, self.along) @ normal / (normal @ normal))  # where the axes cross
        side = 1 if sum(ends) / 2 > near else -1
        return side, max(ends) if side > 0 else min(ends)

    def _eye(self, radius: float, post: float, middle: float) -> SolidPart:
        bore = radius + self.plan.process.running / 2
        part = TurnedPart(
            self.carrier.id, f"{self.body.id} eye", "collar", (0.0, 0.0), (Band(-post, post, radius + LAND, bore),)
        )
        return self._placed(part, on_axis(self.body, middle), self.body)

    def _post(self, foot: Floats, ends: Sequence[float], radius: float) -> SolidPart:
        """From the eye on; with a tenon from the second to the third height."""
        sizes = zip(pairwise(ends), (radius, TENON * radius), strict=False)
        bands = sorted((Band(min(pair), max(pair), size) for pair, size in sizes), key=lambda band: band.low)
        part = TurnedPart(self.carrier.id, f"{self.body.id} cage post", "post", (0.0, 0.0), tuple(bands))
        return self._placed(part, foot, self.carrier)

    def _placed(self, part: TurnedPart, place: Floats, about: SceneBody) -> SolidPart:
        turn = np.column_stack([*basis(about.direction), about.direction])
        return SolidPart(self.index, part.name, part.kind, turn, place, turned=part)

    def _own_wheel(self, height: float, away: float) -> float | None:
        """The nearest face of the carrier's wheels that reach out to a post, within their teeth."""
        own = (wheel for wheel in self._coaxial() if wheel.body == self.index and wheel.tip > away)
        faces = (face for wheel in own for face in self._faces(wheel, wheel.web))
        return min(faces, key=lambda each: abs(each - height), default=None)

    def _is_behind_a_plate(self, height: float, seat: float) -> bool:
        """True if a plate of the frame stands between two heights."""
        stack, places = self.plan.stack, self.plan.places
        if stack.normal is None or abs(float(np.dot(self.along, stack.normal))) < 1 - _SAME:
            return False
        low, high = sorted((height, seat))
        plates = (self.height(stack.in_space((0.0, 0.0), sum(faces) / 2)) for faces in (places.back, places.front))
        return any(low < each < high for each in plates)

    def _beside(self, height: float) -> float:
        """The middle of an arm next to the pinion, where the fewest wheels of the carrier's axis are in its way."""
        reach = max(wheel.radius for wheel in self.scene.wheels if wheel.body == self.at) + _PAST + _ARM / 2

        def hit(level: float) -> int:
            wheels = list(self._coaxial())
            faces = (self._faces(wheel, wheel.span) for wheel in wheels)
            return sum(low - _ARM / 2 < level < high + _ARM / 2 for low, high in faces)

        return min((height + reach, height - reach), key=hit)

    def _coaxial(self) -> Iterator[SceneWheel]:
        """Wheels about the carrier's axis."""
        for wheel in self.scene.wheels:
            aside = np.array(wheel.centre) - on_axis(self.carrier, self.height(wheel.centre))
            upright = abs(float(np.dot(wheel.direction, self.along))) > 1 - _SAME
            if upright and float(np.abs(aside).max()) < _SAME:
                yield wheel

    def _faces(self, wheel: SceneWheel, ends: tuple[float, float]) -> tuple[float, float]:
        """Heights of the `ends` of a wheel about the carrier's axis, that count from its centre along its direction."""
        up = 1 if float(np.dot(wheel.direction, self.along)) > 0 else -1
        low, high = sorted(self.height(wheel.centre) + up * end for end in ends)
        return low, high

    def _level(self, height: float, inner: float) -> float:
        """The middle of an arm beyond all wheels on the side where the fewest are in the post's way."""
        wheels = list(self._coaxial())

        def cost(side: int) -> tuple[int, float]:
            there = [wheel for wheel in wheels if side * (self.height(wheel.centre) - height) > 0]
            hit = sum(wheel.tip > inner or wheel.kind == "ring" for wheel in there)
            return hit, side * beyond(side)

        def beyond(side: int) -> float:
            own = [max(side * face for face in self._faces(wheel, wheel.span)) for wheel in wheels]
            reach = max(wheel.radius for wheel in self.scene.wheels if wheel.body == self.at)
            return side * (max([each for each in own if each > side * height] or [side * height + reach]))

        side = min((1, -1), key=cost)
        return beyond(side) + side * (_PAST + _ARM / 2)

    def _arm(self, aside: Floats, away: float, level: float, post: float) -> SolidPart:
        """From the axis out to a post; its hub runs on what goes through it."""
        hub = self.bores.get(self.carrier.axis, 2.0) / 2 + self.plan.process.running / 2
        across = aside / (away or 1.0)
        wide = max(hub + LAND, post)
        tenon = TENON * post + self.plan.process.press / 2
        cut = around([(0.0, 0.0), (away, 0.0)], wide), Contour.circle(hub), Contour.circle(tenon, (away, 0.0))
        turn = np.column_stack([across, np.cross(self.along, across), self.along])
        place = on_axis(self.carrier, level)
        return SolidPart(self.index, f"{self.body.id} cage arm", "plate", turn, place, "", cut, _ARM)
