"""Trains seen obliquely, near faces over far ones, and a plan from its side, wheels as bars in their layers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.backend import Axes, PolyCollection, Rectangle
from geartrain.drawing.projection import ProjectedScene, ScaledPage, arms_of, broken_wheels
from geartrain.drawing.style import BLACK, GREY, ORANGE, RED, LabelSpace, write
from geartrain.scene import SceneWheel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

    Place = Callable[[Floats], Floats]

_DARK, _LIGHT = np.array([0.50, 0.64, 0.78]), np.array([0.93, 0.96, 0.98])
_FINE = 7.5  # points


@dataclass(frozen=True, slots=True)
class _Face:
    points: Floats
    depth: float
    light: float
    edge: float


def draw_obliquely(axes: Axes, standing: ProjectedScene, place: Place, labels: bool) -> None:
    """Every wheel as its two ends and the surface between them, arms and names over all.

    place   inches (..., 2) of what is seen (..., 3)
    """
    scene = standing.scene
    red = broken_wheels(scene)
    faces = [(wheel, face) for wheel in scene.wheels for face in _faces(standing, wheel)]
    _draw_faces(axes, sorted(faces, key=lambda each: each[1].depth), place, red, 2.0)
    _draw_arbors(axes, standing, place)
    if labels:
        room = LabelSpace()
        for wheel in scene.wheels:
            x, y = place(standing.seen(standing.centre(wheel)))
            spots = [(float(x) + dx, float(y) + dy) for dy in (0.0, 0.2, -0.2, 0.4, -0.4) for dx in (0.0, 0.3, -0.3)]
            box = room.place([wheel.id, str(wheel.teeth)], _FINE, spots)
            if box is not None:
                write(axes, box[0], box[1], f"{wheel.id}\n{wheel.teeth}", fontsize=_FINE, gid=f"name {wheel.id}")


def draw_across(
    axes: Axes, standing: ProjectedScene, wheel: SceneWheel, place: Place, red: set[str], order: float
) -> None:
    """A wheel that a plan sees from its side."""
    faces = sorted(_faces(standing, wheel), key=lambda face: face.depth)
    _draw_faces(axes, [(wheel, face) for face in faces], place, red, order)


def _draw_faces(
    axes: Axes, faces: Sequence[tuple[SceneWheel, _Face]], place: Place, red: set[str], order: float
) -> None:
    """Faces in order, the last over all others."""
    edges = [RED if wheel.id in red else BLACK if face.edge else "none" for wheel, face in faces]
    axes.add_collection(
        PolyCollection(
            [place(face.points) for _, face in faces],
            facecolors=[(*(_DARK + (_LIGHT - _DARK) * face.light), 0.9) for _, face in faces],
            edgecolors=edges,
            linewidths=[face.edge for _, face in faces],
            zorder=order,
            gid="wheels",
        ),
        autolim=False,
    )


def _faces(standing: ProjectedScene, wheel: SceneWheel) -> Iterator[_Face]:
    """The end that is seen, with its teeth, and the strips of the surface between both ends."""
    (high, wide), (low, narrow) = standing.ends(wheel)
    first = standing.seen(standing.outline(wheel, wide, high))
    last = standing.seen(standing.outline(wheel, narrow, low))
    up = standing.seen(standing.axis(wheel)) * np.sign(high - low)
    near, light = (first, float(up[2])) if up[2] > 0 else (last, -float(up[2]))
    for start in range(0, len(first), max(len(first) // 72, 1)):
        strip = np.arange(start, min(start + max(len(first) // 72, 1), len(first)) + 1) % len(first)
        points = np.concatenate([first[strip], last[strip[::-1]]])
        middle = points.mean(0) - (first.mean(0) + last.mean(0)) / 2
        # of a strip in the middle of the wheel, whose normal is no direction, any shade will do
        shade = 0.35 + 0.3 * float(middle[2]) / max(float(np.linalg.norm(middle)), 1e-9)
        if middle[2] > 0 or wheel.kind == "ring" or wheel.cone > 0:
            yield _Face(points, float(points[:, 2].mean()), shade, 0.0)
    far = last if near is first else first
    yield _Face(far, float(far[:, 2].min()) - 1.0, 0.3, 0.4)
    yield _Face(near, float(near[:, 2].mean()), 0.55 + 0.4 * light, 0.6)


def _draw_arbors(axes: Axes, standing: ProjectedScene, place: Place) -> None:
    """Axes of wheels through their centres; of carriers, an arm to each axis they bear."""
    for wheel in standing.scene.wheels:
        centre, along = standing.centre(wheel), standing.axis(wheel)
        reach = max(2.5 * wheel.thickness, 0.25 * wheel.radius)
        line = place(standing.seen(np.array([centre - reach * along, centre + reach * along])))
        axes.plot(*line.T, color=BLACK, linewidth=1.2, zorder=4)
    for body, start, end in arms_of(standing):
        line = place(standing.seen(np.array([start, end])))
        axes.plot(*line.T, color=ORANGE, linewidth=4.0, zorder=4, gid=f"arm {standing.scene.bodies[body].id}")


_FACE = np.array([0.74, 0.82, 0.89])  # colour of a bar
_SIDE_FINE = 7.5  # points


class SideScale:
    """Inches across the side view for heights towards the reader (mm): the reader stands on the right."""

    def __init__(self, left: float, width: float, low: float, size: float) -> None:
        self.left, self.scale, self.low = left, width / size, low

    def at(self, height: float) -> float:
        """Inches from the left for a height (mm)."""
        return self.left + (height - self.low) * self.scale


def draw_side(page: ScaledPage, standing: ProjectedScene, depth: SideScale) -> None:
    """The train from its right, as high as the plan: layers side by side, the reader's side on the right."""
    red = broken_wheels(standing.scene)
    stacks: dict[tuple[float, float], list[float]] = {}
    facing = filter(standing.faces, standing.scene.wheels)
    for wheel in sorted(facing, key=lambda each: float(standing.seen(standing.centre(each))[0])):
        x, y, z = map(float, standing.seen(standing.centre(wheel)))
        half = max(wheel.tip, wheel.root) * page.scale
        middle = float(page.at(np.array([x, y, z]))[1])
        left, right = depth.at(z - wheel.thickness / 2), depth.at(z + wheel.thickness / 2)
        style: dict[str, Any] = {"edgecolor": RED if wheel.id in red else BLACK, "linewidth": 0.6, "zorder": 3}
        face = (*_FACE, 0.7)
        box = Rectangle((left, middle - half), right - left, 2 * half, facecolor=face, gid=f"side {wheel.id}", **style)
        page.axes.add_artist(box)
        stacks.setdefault((round(x, 4), round(middle, 4)), []).extend((left, right))
    for (_, middle), ends in stacks.items():
        page.axes.plot([min(ends) - 0.06, max(ends) + 0.06], [middle, middle], color=BLACK, linewidth=1.4, zorder=4)
    text = "from the right" if abs(depth.scale / page.scale - 1) < 0.01 else "from the right, layers apart"
    page.axes.text(depth.left, page.foot, text, fontsize=_SIDE_FINE, color=GREY)
