"""Trains seen obliquely, near faces over far ones, and a plan from its side, wheels as bars in their layers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from scipy.spatial import ConvexHull

from geartrain.drawing.backend import Axes, Path, PolyCollection, Polygon, Rectangle
from geartrain.drawing.callouts import Callout
from geartrain.drawing.projection import ProjectedScene, ScaledPage, arms_of, broken_wheels
from geartrain.drawing.style import BLACK, FILL, FINE, GREY, ORANGE, RED, SHADE
from geartrain.scene import SceneWheel
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

    Place = Callable[[Floats], Floats]


_SEAM = 0.3  # points: what joins two tiles of one surface
_FACES_RIGHT = 0.99  # of the direction to the right, along the axis of a wheel that is seen with its teeth from there
_SECTIONS = 48  # of a worm, between which its thread is drawn


@dataclass(frozen=True, slots=True)
class _Face:
    points: Floats
    depth: float
    light: float
    edge: float


def draw_obliquely(axes: Axes, standing: ProjectedScene, place: Place) -> None:
    """Every wheel as its two ends and the surface between them, tinted by what turns together, and arms over all.

    place   inches (..., 2) of what is seen (..., 3)
    """
    scene = standing.scene
    red = broken_wheels(scene)
    faces = [(wheel, face) for wheel in scene.wheels for face in _faces(standing, wheel)]
    _draw_faces(axes, sorted(faces, key=lambda each: each[1].depth), place, red, 2.0)
    _draw_arbors(axes, standing, place)


def oblique_callouts(standing: ProjectedScene, place: Place, wheels: Sequence[SceneWheel]) -> list[Callout]:
    """A line to each wheel, to where no nearer one hides its face."""
    ends = {wheel.id: _ends(standing, wheel) for wheel in standing.scene.wheels if wheels}
    outlines = {
        name: _silhouette(place(np.concatenate([far.points, near.points]))) for name, (far, near) in ends.items()
    }
    middle = np.mean([place(near.points).mean(0)[0] for _, near in ends.values()]) if ends else 0.0
    found = []
    for wheel in wheels:
        back, front = ends[wheel.id]
        trials = np.concatenate([_inner_points(face.points, place) for face in (front, back)])
        nearer = [outlines[name] for name, (_, near) in ends.items() if near.depth > front.depth]
        hidden = np.any([path.contains_points(trials) for path in nearer], axis=0) if nearer else np.zeros(len(trials))
        seen = trials if hidden.all() else trials[hidden == 0]
        best = seen[int(np.argmax(np.round(np.abs(seen[:, 0] - middle), 6)))]
        words = [(f"name {wheel.id}", f"{wheel.id} {wheel.teeth}")]
        found.append(Callout(words, (round(float(best[0]), 6), round(float(best[1]), 6))))
    return found


def _silhouette(points: Floats) -> Path:
    """The convex line round what is seen of a wheel."""
    return Path(points[ConvexHull(points).vertices])


def _inner_points(rim: Floats, place: Place) -> Floats:
    """Points (n, 2) within a face, from its rim inwards."""
    middle = rim.mean(0)
    return place(np.concatenate([middle + share * (rim[::4] - middle) for share in (0.85, 0.6, 0.35, 0.1)]))


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
    tints = [_tint(wheel, face.light) for wheel, face in faces]
    edges = [
        (RED if wheel.id in red else BLACK)
        if face.edge
        else tint  # a seam without a line lets what is behind it through
        for (wheel, face), tint in zip(faces, tints, strict=True)
    ]
    axes.add_collection(
        PolyCollection(
            [place(face.points) for _, face in faces],
            facecolors=tints,
            edgecolors=edges,
            linewidths=[face.edge or _SEAM for _, face in faces],
            zorder=order,
            gid="wheels",
        ),
        autolim=False,
    )


def _tint(wheel: SceneWheel, light: float) -> Floats:
    """The colour of the body, the paler the more light falls on it."""
    own = np.array(to_rgb(series_colour(wheel.body)))
    return np.asarray(own + (1 - own) * (0.3 + 0.6 * light))


def _faces(standing: ProjectedScene, wheel: SceneWheel) -> Iterator[_Face]:
    """The strips of the surface between both ends, then the far end, then the near one; of a worm, its thread."""
    far, near = _ends(standing, wheel)
    if wheel.kind == "worm":
        yield from _thread(standing, wheel)
        yield near
        return
    first, last = near.points, far.points
    middle = (first.mean(0) + last.mean(0)) / 2
    for start in range(0, len(first), max(len(first) // 72, 1)):
        strip = np.arange(start, min(start + max(len(first) // 72, 1), len(first)) + 1) % len(first)
        points = np.concatenate([first[strip], last[strip[::-1]]])
        away = points.mean(0) - middle
        # of a strip in the middle of the wheel, whose normal is no direction, any shade will do
        shade = 0.35 + 0.3 * float(away[2]) / max(float(np.linalg.norm(away)), 1e-9)
        if away[2] > 0 or wheel.kind == "ring" or wheel.cone > 0:
            yield _Face(points, float(points[:, 2].mean()), shade, 0.0)
    yield far
    yield near


def _thread(standing: ProjectedScene, wheel: SceneWheel) -> Iterator[_Face]:
    """What is seen of the surface of a worm, as tiles between sections along its axis."""
    heights = np.linspace(-0.5, 0.5, _SECTIONS + 1) * wheel.thickness
    rows = np.array([standing.seen(standing.outline(wheel, height=height)) for height in heights])
    after = np.roll(rows, -1, axis=1)
    tiles = np.stack([rows[:-1], after[:-1], after[1:], rows[1:]], axis=2).reshape(-1, 4, 3)
    normals = np.cross(tiles[:, 2] - tiles[:, 0], tiles[:, 3] - tiles[:, 1])
    towards = normals[:, 2] / np.maximum(np.linalg.norm(normals, axis=1), 1e-9)
    for points, up in zip(tiles[towards > 0], towards[towards > 0], strict=True):
        yield _Face(points, float(points[:, 2].mean()), float(up), 0.0)


def _ends(standing: ProjectedScene, wheel: SceneWheel) -> tuple[_Face, _Face]:
    """The end away from the reader and the one that is seen, with their teeth."""
    (high, wide), (low, narrow) = standing.ends(wheel)
    first = standing.seen(standing.outline(wheel, wide, high))
    last = standing.seen(standing.outline(wheel, narrow, low))
    up = standing.seen(standing.axis(wheel)) * np.sign(high - low)
    near, light = (first, float(up[2])) if up[2] > 0 else (last, -float(up[2]))
    far = last if near is first else first
    back = _Face(far, float(far[:, 2].min()) - 1.0, 0.3, 0.5)
    return back, _Face(near, float(near[:, 2].mean()), 0.45 + 0.4 * light, 0.8)


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


_FACE = (np.array(to_rgb(SHADE)) + np.array(to_rgb(FILL))) / 2  # colour of a bar


class SideScale:
    """Inches across the side view for heights towards the reader (mm): the reader stands on the right."""

    def __init__(self, left: float, width: float, low: float, size: float) -> None:
        self.left, self.scale, self.low = left, width / size, low

    def at(self, height: Any) -> Any:
        """Inches from the left for a height or heights (mm)."""
        return self.left + (height - self.low) * self.scale


def draw_side(page: ScaledPage, standing: ProjectedScene, depth: SideScale) -> None:
    """The train from its right, as high as the plan: layers side by side, the reader's side on the right."""
    red = broken_wheels(standing.scene)
    stacks: dict[tuple[float, float], list[float]] = {}
    for wheel in sorted(standing.scene.wheels, key=lambda each: float(standing.seen(standing.centre(each))[0])):
        edge = RED if wheel.id in red else BLACK
        style: dict[str, Any] = {"facecolor": (*_FACE, 0.7), "edgecolor": edge, "linewidth": 0.6, "zorder": 3}
        if not standing.faces(wheel):
            _draw_across_side(page, standing, wheel, depth, style)
            continue
        x, y, z = map(float, standing.seen(standing.centre(wheel)))
        half = max(wheel.tip, wheel.root) * page.scale
        middle = float(page.at(np.array([x, y, z]))[1])
        left, right = depth.at(z - wheel.thickness / 2), depth.at(z + wheel.thickness / 2)
        box = Rectangle((left, middle - half), right - left, 2 * half, gid=f"side {wheel.id}", **style)
        page.axes.add_artist(box)
        stacks.setdefault((round(x, 4), round(middle, 4)), []).extend((left, right))
    for (_, middle), ends in stacks.items():
        page.axes.plot([min(ends) - 0.06, max(ends) + 0.06], [middle, middle], color=BLACK, linewidth=1.4, zorder=4)
    text = "from the right" if abs(depth.scale / page.scale - 1) < 0.01 else "from the right, layers apart"
    page.axes.text(depth.left - 0.25, page.foot, text, fontsize=FINE, color=GREY)


def _draw_across_side(
    page: ScaledPage, standing: ProjectedScene, wheel: SceneWheel, depth: SideScale, style: dict[str, Any]
) -> None:
    """A wheel of another axis than those of the plan: its teeth where it faces the right, else the line round it."""
    ends = [face.points for face in _ends(standing, wheel)]
    places = [np.column_stack([depth.at(points[:, 2]), page.at(points)[:, 1]]) for points in ends]
    if abs(float(standing.seen(standing.axis(wheel))[0])) > _FACES_RIGHT:
        outline = places[int(np.argmax([points[:, 0].mean() for points in ends]))]
    else:
        every = np.concatenate(places)
        outline = every[ConvexHull(every).vertices]
    page.axes.add_artist(Polygon(outline, gid=f"side {wheel.id}", **style))
