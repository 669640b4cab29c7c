"""Names and counts of the wheels of a plan: on the wheel where it is seen, else beside the plan with a line to it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.callouts import Callout
from geartrain.drawing.labels import Box, LabelSpace, text_box
from geartrain.drawing.projection import ProjectedScene, arms_of, coupling_spans
from geartrain.drawing.style import FINE
from geartrain.scene import SceneWheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

_ROUND = 16  # directions in which a place is looked for
_SHARES = (0.72, 0.5, 0.86, 0.35)  # of a wheel's radius, where its name may stand
_POINTS = (0.9, 0.75, 0.55, 0.3)  # of it, where a line may end
_STEP = 0.08  # inches between the points that keep names off arms and lines
_HUB, _LINE = 0.12, 0.04  # inches that a hub or a point of an arm keeps free, and a point of a line to a name


@dataclass(frozen=True, slots=True)
class PlanNames:
    """Where the names of wheels that face the reader, the nearest first, may stand in a plan, in inches.

    centres   of the wheels (n, 2)
    reach     what each hides (n,); of a ring nothing, which is open
    arms      points (m, 2) that keep names off arms, slots, and pins in holes
    scale     inches of a millimetre
    """

    wheels: Sequence[SceneWheel]
    centres: Floats
    reach: Floats
    arms: Floats
    scale: float

    @classmethod
    def of(
        cls, standing: ProjectedScene, wheels: Sequence[SceneWheel], at: Callable[[Floats], Floats], scale: float
    ) -> PlanNames:
        """Of the wheels of a scene; `at`, inches of what is seen."""
        centres = np.array([at(standing.seen(standing.centre(wheel))) for wheel in wheels]).reshape(-1, 2)
        reach = np.array([0.0 if wheel.kind == "ring" else wheel.tip * scale for wheel in wheels])
        ends = [at(standing.seen(np.array([start, end]))) for _, start, end in arms_of(standing)]
        pins = [span for each in standing.scene.couplings for span in coupling_spans(standing, each, at, scale)]
        return cls(wheels, centres, reach, _points_along([*ends, *pins]), scale)

    def place(self) -> tuple[list[tuple[SceneWheel, Box]], list[Callout]]:
        """Names that stand on their wheels, and those that a line must lead from: one to all of an axis, from inside
        out.
        """
        room, written, rest = self._room(()), [], []
        for order in sorted(range(len(self.wheels)), key=lambda order: self.wheels[order].radius):
            box = room.place(self._on_face(order))
            if box is None:
                rest.append(order)
            else:
                written.append((self.wheels[order], box))
        return written, self._callouts(rest)

    def place_beside(
        self, written: Sequence[tuple[SceneWheel, Box]], lines: Sequence[Floats]
    ) -> list[tuple[SceneWheel, Box]]:
        """Names that stand on their wheels moved off the lines (2, 2) that lead to others, where there is room."""
        room, order = self._room(lines), {wheel.id: at for at, wheel in enumerate(self.wheels)}
        found = []
        for wheel, box in written:
            moved = room.place(self._on_face(order[wheel.id]))
            if moved is None:
                room.take(box)
            found.append((wheel, moved or box))
        return found

    def _room(self, lines: Sequence[Floats]) -> LabelSpace:
        """Room off hubs, arms and lines."""
        room = LabelSpace()
        for x, y in (*self.centres, *self.arms):
            room.take((float(x), float(y), _HUB, _HUB))
        for x, y in _points_along(lines):
            room.take((float(x), float(y), _LINE, _LINE))
        return room

    def _on_face(self, order: int) -> Iterator[Box]:
        """Places within the wheel's own face that nothing hides."""
        wheel, centre = self.wheels[order], self.centres[order]
        if wheel.kind == "ring":
            return
        _, _, wide, high = text_box([wheel.id, str(wheel.teeth)], FINE, 0.0, 0.0)
        angles = pi / 2 + 2 * pi / _ROUND * np.arange(_ROUND)
        ways = np.stack([np.cos(angles), np.sin(angles)], 1)
        spots = centre + wheel.root * self.scale * np.concatenate([share * ways for share in _SHARES])
        corners = spots[:, None] + np.array([(i * wide / 2, j * high / 2) for i in (-1, 0, 1) for j in (-1, 0, 1)])
        apart = corners - centre
        within = np.hypot(apart[..., 0], apart[..., 1]).max(1) < wheel.root * self.scale
        above = self.centres[:order], self.reach[:order]
        hidden = points_in_discs(corners.reshape(-1, 2), *above).reshape(len(spots), -1).any(1)
        yield from ((x, y, wide, high) for x, y in spots[within & ~hidden].tolist())

    def _callouts(self, rest: Sequence[int]) -> list[Callout]:
        """A line to each axis of wheels whose names have no room on them."""
        middle = float(self.centres[:, 0].mean()) if len(self.centres) else 0.0
        axes: dict[tuple[float, ...], list[int]] = {}
        for order in rest:
            axes.setdefault(tuple(np.round(self.centres[order], 4).tolist()), []).append(order)
        callouts = []
        for order, *others in axes.values():
            x, y = np.round(self.centres[order], 6).tolist()
            anchor = (x, y) if others else self._anchor(order, middle)
            listed = sorted((self.wheels[each] for each in (order, *others)), key=lambda each: (each.radius, each.id))
            callouts.append(Callout([(f"name {each.id}", f"{each.id} {each.teeth}") for each in listed], anchor))
        return callouts

    def _anchor(self, order: int, middle: float) -> tuple[float, float]:
        """A point of the wheel that is seen, the farthest out; of one that is hidden, of its rim."""
        wheel = self.wheels[order]
        shares = (1.05,) if wheel.kind == "ring" else _POINTS
        angles = 2 * pi / _ROUND * (np.arange(_ROUND) + 0.5)
        ways = np.stack([np.cos(angles), np.sin(angles)], 1)
        rims = [self.centres[order] + share * wheel.root * self.scale * ways for share in shares]
        points = np.concatenate(rims)
        seen = points[~points_in_discs(points, self.centres[:order], self.reach[:order])]
        points = np.round(seen if len(seen) else points[:_ROUND], 6)
        best = points[int(np.argmax(np.round(np.abs(points[:, 0] - middle), 6)))]
        return float(best[0]), float(best[1])


def _points_along(lines: Sequence[Floats]) -> Floats:
    """Points (n, 2) along lines (2, 2), close enough that no word stands between two of them."""
    found = [np.zeros((0, 2))]
    for first, last in lines:
        steps = max(int(np.hypot(*(last - first)) / _STEP), 1)
        found.append(first + np.linspace(0, 1, steps + 1)[:, None] * (last - first))
    return np.concatenate(found)


def points_in_discs(points: Floats, centres: Floats, reach: Floats) -> NDArray[np.bool_]:
    """Which points (n, 2) lie in one of the discs (m, 2)."""
    if not len(points) or not len(centres):
        return np.zeros(len(points), dtype=bool)
    middle = points.mean(axis=0)
    far = np.hypot(*(points - middle).T).max()
    near = np.hypot(*(centres - middle).T) < reach + far + 1e-9  # others hide none of them
    apart = points[:, None] - centres[near]
    return np.asarray((np.hypot(apart[..., 0], apart[..., 1]) < reach[near]).any(axis=1))
