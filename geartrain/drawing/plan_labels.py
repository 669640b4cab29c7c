"""Names and counts of the wheels of a plan: on the wheel where it is seen, else beside the plan with a line to it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.callouts import Callout
from geartrain.drawing.labels import Box, LabelSpace, text_box
from geartrain.drawing.projection import ProjectedScene, arms_of
from geartrain.drawing.style import FINE
from geartrain.scene import SceneWheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

_ROUND = 16  # directions in which a place is looked for
_SHARES = (0.72, 0.5, 0.86, 0.35)  # of a wheel's radius, where its name may stand
_POINTS = (0.9, 0.75, 0.55, 0.3)  # of it, where a line may end
_STEP = 0.08  # inches between the points that keep names off an arm
_HUB = 0.12  # inches that a hub keeps free


def place_names(
    standing: ProjectedScene, wheels: Sequence[SceneWheel], at: Callable[[Floats], Floats], scale: float
) -> tuple[list[tuple[SceneWheel, Box]], list[Callout]]:
    """Names that stand on their wheels, and those that a line must lead from: one to all of an axis, from inside out.

    wheels   that face the reader, the nearest first
    at       inches of what is seen; `scale`, inches of a millimetre
    """
    centres = np.array([at(standing.seen(standing.centre(wheel))) for wheel in wheels]).reshape(-1, 2)
    reach = np.array([0.0 if wheel.kind == "ring" else wheel.tip * scale for wheel in wheels])  # what it hides
    room = LabelSpace()
    for x, y in _kept_free(standing, centres, at):
        room.take((x, y, _HUB, _HUB))
    written: list[tuple[SceneWheel, Box]] = []
    rest: list[int] = []
    for order in sorted(range(len(wheels)), key=lambda order: wheels[order].radius):
        box = _on_face(wheels, order, centres, reach, scale, room)
        if box is None:
            rest.append(order)
        else:
            written.append((wheels[order], box))
    middle = float(centres[:, 0].mean()) if len(centres) else 0.0
    axes: dict[tuple[float, ...], list[int]] = {}
    for order in rest:
        axes.setdefault(tuple(np.round(centres[order], 4).tolist()), []).append(order)
    callouts = []
    for order, *others in axes.values():
        above = centres[:order], reach[:order]
        spot = tuple(np.round(centres[order], 6).tolist())
        anchor = spot if others else _anchor(wheels[order], centres[order], scale, above, middle)
        listed = sorted((wheels[each] for each in (order, *others)), key=lambda each: (each.radius, each.id))
        callouts.append(Callout([(f"name {each.id}", f"{each.id} {each.teeth}") for each in listed], anchor))
    return written, callouts


def _kept_free(
    standing: ProjectedScene, centres: Floats, at: Callable[[Floats], Floats]
) -> Iterator[tuple[float, float]]:
    """Hubs, and points along arms."""
    for x, y in centres:
        yield float(x), float(y)
    for _, start, end in arms_of(standing):
        first, last = at(standing.seen(np.array([start, end])))
        steps = max(int(np.hypot(*(last - first)) / _STEP), 1)
        for x, y in first + np.linspace(0, 1, steps + 1)[:, None] * (last - first):
            yield float(x), float(y)


def _on_face(
    wheels: Sequence[SceneWheel], order: int, centres: Floats, reach: Floats, scale: float, room: LabelSpace
) -> Box | None:
    """A place within the wheel's own face that nothing hides."""
    wheel = wheels[order]
    if wheel.kind == "ring":
        return None
    _, _, wide, high = text_box([wheel.id, str(wheel.teeth)], FINE, 0.0, 0.0)
    angles = pi / 2 + 2 * pi / _ROUND * np.arange(_ROUND)
    ways = np.stack([np.cos(angles), np.sin(angles)], 1)
    spots = centres[order] + wheel.root * scale * np.concatenate([share * ways for share in _SHARES])
    corners = spots[:, None] + np.array([(i * wide / 2, j * high / 2) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    apart = corners - centres[order]
    within = np.hypot(apart[..., 0], apart[..., 1]).max(1) < wheel.root * scale
    hidden = points_in_discs(corners.reshape(-1, 2), centres[:order], reach[:order]).reshape(len(spots), -1).any(1)
    return room.place((x, y, wide, high) for x, y in spots[within & ~hidden].tolist())


def _anchor(
    wheel: SceneWheel, centre: Floats, scale: float, above: tuple[Floats, Floats], middle: float
) -> tuple[float, float]:
    """A point of the wheel that is seen, the farthest out; of one that is hidden, of its rim."""
    shares = (1.05,) if wheel.kind == "ring" else _POINTS
    angles = 2 * pi / _ROUND * (np.arange(_ROUND) + 0.5)
    ways = np.stack([np.cos(angles), np.sin(angles)], 1)
    points = np.concatenate([centre + share * wheel.root * scale * ways for share in shares])
    seen = points[~points_in_discs(points, *above)]
    points = np.round(seen if len(seen) else points[:_ROUND], 6)
    best = points[int(np.argmax(np.round(np.abs(points[:, 0] - middle), 6)))]
    return float(best[0]), float(best[1])


def points_in_discs(points: Floats, centres: Floats, reach: Floats) -> NDArray[np.bool_]:
    """Which points (n, 2) lie in one of the discs (m, 2)."""
    if not len(points) or not len(centres):
        return np.zeros(len(points), dtype=bool)
    middle = points.mean(axis=0)
    far = np.hypot(*(points - middle).T).max()
    near = np.hypot(*(centres - middle).T) < reach + far + 1e-9  # others hide none of them
    apart = points[:, None] - centres[near]
    return np.asarray((np.hypot(apart[..., 0], apart[..., 1]) < reach[near]).any(axis=1))
