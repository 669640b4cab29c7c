"""Projection of a scene onto the page: plan, view from the side, oblique view.

A train whose wheels are in parallel planes has a plan, and a side view in which its wheels are bars in their layers.
Other trains are drawn obliquely, near faces over far faces (painter's algorithm).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from scipy.spatial import ConvexHull

from geartrain.drawing.arrangement import Callout
from geartrain.drawing.style import (
    BLACK,
    FILL,
    FINE,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SHADE,
    Axes,
    Circle,
    Path,
    PolyCollection,
    Polygon,
    Rectangle,
)
from geartrain.numerics.polylines import simplified
from geartrain.scene import Scene
from geartrain.scene.elements import SceneCoupling, ScenePart, SceneWave, SceneWheel
from geartrain.scene.layout.wheel_reach import CROWN, height_on_cone, taper
from geartrain.scene.pose import ScenePose, scene_pose
from geartrain.teeth.outlines.fixed_teeth import bent_line

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

    Place = Callable[[Floats], Floats]

_OBLIQUE = (0.52, -0.62, 0.59)  # direction towards the reader in an oblique view
_MOST = 0.7  # share of the wheels that must face the reader in a plan; the others are drawn from their side
_ROUND = 73  # points of a circle
_FINE = 5000  # teeth beyond which a wheel is drawn as a circle, as its teeth are too small to be seen


@dataclass(frozen=True, slots=True)
class ProjectedScene:
    """Scene in a pose as seen by a reader."""

    scene: Scene
    pose: ScenePose
    screen: Floats
    """Matrix (3, 3) whose rows are unit vectors to the right, up and towards the reader."""

    @property
    def flat(self) -> bool:
        """True if at least 70 % of the wheels face the reader."""
        return sum(map(self.faces, self.scene.wheels)) >= _MOST * len(self.scene.wheels)

    def faces(self, wheel: SceneWheel) -> bool:
        """Return True if a wheel is viewed along its axis, from either side."""
        # the cosine is flat at 0: a deficit of 1e-9 is 0.0026 deg, less than any declared tilt and more than rounding
        return abs(float(self.axis(wheel) @ self.screen[2])) > 1 - 1e-9

    def seen(self, points: object) -> Floats:
        """Return the view coordinates (right, up, towards the reader) of points (..., 3)."""
        return np.asarray(np.asarray(points, dtype=float) @ self.screen.T)

    def axis(self, wheel: SceneWheel) -> Floats:
        """Return the unit vector along the axis of a wheel in this pose."""
        return self.pose.way(wheel.body, wheel.direction)

    def centre(self, wheel: SceneWheel) -> Floats:
        """Return the centre [mm] of the pitch circle of a wheel in the current pose."""
        return self.pose.point(wheel.body, wheel.centre)

    def outline(self, wheel: SceneWheel, scale: float = 1.0, height: float = 0.0, chord: float = 0.0) -> Floats:
        """Return the tooth outline of a wheel (points, 3) [mm], enlarged by `scale` and shifted along the wheel's axis.

        For a lantern pinion, and for a wheel whose teeth are too small to be visible, the result is the tip circle.

        height   shift along the axis [mm]; the teeth are rotated as their helix requires
        chord    maximum distance [mm] of omitted points from the outline
        """
        profile = self.scene.profiles[wheel.profile]
        tooth = np.array(profile.points)
        flat = tooth[:, :1] * np.stack([np.cos(tooth[:, 1]), np.sin(tooth[:, 1])], axis=1)
        tooth = tooth[simplified(flat, chord / (wheel.radius * scale))]
        if profile.hole or wheel.teeth > _FINE:
            return self.circle(wheel, wheel.tip * scale, height)
        radius = wheel.radius * scale * np.tile(tooth[:-1, 0], wheel.teeth)
        steps = 2 * np.pi / wheel.teeth * np.arange(wheel.teeth)
        # a helix rotates by tan(helix) / radius per mm along the axis
        first = wheel.turn + (0.0 if wheel.cone else height * np.tan(wheel.helix) / wheel.radius)
        angle = first + (steps[:, None] + tooth[None, :-1, 1]).ravel()
        if wave := self.wave(wheel):
            return self._bent(wave, radius, angle)
        return self._around(wheel, radius, angle, height)

    def wave(self, wheel: SceneWheel) -> SceneWave | None:
        """Return the strain wave that deflects a wheel; None for a rigid wheel."""
        return next((each for each in self.scene.waves if self.scene.wheels[each.wheel] is wheel), None)

    def bore(self, wave: SceneWave) -> Floats:
        """Return points (n, 3) [mm] along the bore of a flexible wheel, which is in contact with the wave generator."""
        angle = np.linspace(0, 2 * np.pi, _ROUND)
        return self._bent(wave, np.full(_ROUND, wave.middle - wave.wall / 2), angle)

    def _bent(self, wave: SceneWave, radius: Floats, angle: Floats) -> Floats:
        """Return points (n, 3) of a deflected flexible wheel [mm] from polar coordinates before deflection."""
        wheel = self.scene.wheels[wave.wheel]
        first, along = np.array(wheel.reference), np.array(wheel.direction)
        x, y = first @ wave.towards, np.cross(along, first) @ wave.towards
        lobe = np.arctan2(y, x) + self.pose.angles[wave.by] - self.pose.angles[wheel.body]
        line = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        found = bent_line(line, wave.middle, (wave.rise, wave.lobes), (0.0, float(lobe)))
        return self._around(wheel, np.hypot(*found.T), np.arctan2(found[:, 1], found[:, 0]), 0.0)

    def lobes(self, wave: SceneWave) -> Floats:
        """Return the points (lobes, 3) [mm] at which the outward deflection of a flexible wheel's bore is a maximum."""
        wheel = self.scene.wheels[wave.wheel]
        bore = wave.middle + wave.rise - wave.wall / 2
        turn = 2 * np.pi * np.arange(wave.lobes) / wave.lobes
        first, along = np.array(wave.towards), np.array(wheel.direction)
        ring = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * np.cross(along, first)
        # in the frame of the generator, which is coaxial with the wheel
        return self.pose.point(wave.by, np.array(wheel.centre) + bore * ring)

    def circle(self, wheel: SceneWheel, radius: float, height: float = 0.0) -> Floats:
        """Return points (n, 3) [mm] on a circle about the axis of a wheel."""
        angle = np.linspace(0, 2 * np.pi, _ROUND)
        return self._around(wheel, np.full(_ROUND, radius), angle, height)

    def pins(self, wheel: SceneWheel) -> Iterator[Floats]:
        """Yield the outline (n, 3) [mm] of each pin of a lantern pinion; yield nothing for other wheels."""
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
        """Return the height [mm] and the scale of both ends of a wheel; the large end of a bevel wheel is first."""
        half = wheel.thickness / 2
        if wheel.cone <= 0 or wheel.cone > CROWN:  # a crown wheel has no narrow end
            return (half, 1.0), (-half, 1.0)
        narrow = taper(wheel.cone, wheel.radius, wheel.thickness)
        return (0.0, 1.0), (-wheel.facing * height_on_cone(wheel.cone, wheel.radius, 0.0, narrow), narrow)


def project_scene(scene: Scene, turns: Fraction) -> ProjectedScene:
    """Return a scene after `turns` of its driving link, from the front if most wheels face the front, or obliquely."""
    posed = scene_pose(scene, turns)
    front = ProjectedScene(scene, posed, np.diag([float(scene.front), 1.0, float(scene.front)]))
    return front if front.flat else ProjectedScene(scene, posed, screen_of(np.array(_OBLIQUE)))


def screen_of(view: Floats) -> Floats:
    """Return the matrix (3, 3) whose rows point right, up and towards the reader (`view`)."""
    towards = view / np.linalg.norm(view)
    right = np.cross([0.0, 0.0, 1.0], towards)
    if np.linalg.norm(right) < 1e-9:  # seen from a pole, where up is undefined
        right = np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


class ScaledPage:
    """Page in inches, on which millimetres are drawn to scale; the text below a side view is at the height `foot`."""

    def __init__(self, axes: Axes, scale: float, shift: Floats, foot: float = 0.0) -> None:
        self.axes, self.scale, self.shift, self.foot = axes, scale, shift, foot

    def at(self, seen: Floats) -> Floats:
        """Return the positions on the page (..., 2) [in] that correspond to view coordinates (..., 3) [mm]."""
        return np.asarray(seen[..., :2] * self.scale + self.shift)


def arms_of(projected: ProjectedScene) -> Iterator[tuple[int, Floats, Floats]]:
    """Yield, for every arm of a carrier, the index of the carrier's body and the arm's end points in this pose [mm]."""
    scene = projected.scene
    seen = set()
    for at, body in enumerate(scene.bodies):
        if body.parent is None or scene.bodies[body.parent].role != "carrier":
            continue
        ends = projected.pose.point(body.parent, scene.bodies[body.parent].point), projected.pose.point(at, body.point)
        key = (body.parent, *np.round(ends[1], 6))
        if key not in seen:
            seen.add(key)
            yield body.parent, *ends


def coupling_spans(
    projected: ProjectedScene, coupling: SceneCoupling, at: Callable[[Floats], Floats], scale: float
) -> list[Floats]:
    """Return lines (2, 2) [in] across a coupling: one along its slot, or two diameters of each of its holes.

    at      conversion of view coordinates (..., 3) to inches (..., 2)
    scale   inches per millimetre
    """
    pose, half = projected.pose, coupling.hole / 2 * scale
    if coupling.hole:
        middles = [at(projected.seen(pose.point(coupling.slot, place))) for place in coupling.holes_at]
        across = half * np.array([[[-1, 0], [1, 0]], [[0, -1], [0, 1]]])
        return [middle + line for middle in middles for line in across]
    pin = at(projected.seen(pose.point(coupling.pin, coupling.pin_at)))
    body = projected.scene.bodies[coupling.slot]
    hub = at(projected.seen(pose.point(coupling.slot, coupling.slot_at if body else body.point)))
    along, reach = pin - hub, coupling.offset * scale
    far = float(np.hypot(*along)) or 1.0
    return [hub + np.outer([max(far - 1.2 * reach, 0.3 * far), far + 0.6 * reach + 0.04], along / far)]


def part_points(part: ScenePart, outline: int = 0) -> Floats:
    """Return points (n, 3) [mm] of one outline of a flat part, or of the section of a turned part, at all angles 0."""
    x, z = np.array(part.across), np.array(part.direction)
    if part.outlines:
        flat = np.array(part.outlines[outline]).reshape(-1, 2)
        return np.asarray(np.array(part.place) + flat[:, :1] * x + flat[:, 1:] * np.cross(z, x))
    low, high = part.bands[0][0], part.bands[-1][1]
    wide = max(radius for _, _, radius, _ in part.bands)
    ring = [(low, wide), (high, wide), (high, -wide), (low, -wide)]
    return np.asarray([np.array(part.place) + along * z + out * x for along, out in ring])


def draw_shapes(axes: Axes, projected: ProjectedScene, place: Place) -> None:
    """Draw the parts of couplings, such as belts and cams: flat parts by outlines, turned parts by sections or circles.

    place   conversion of view coordinates (..., 3) to inches (..., 2)
    """
    # turned parts after flat parts, whose holes are white
    for part in sorted(projected.scene.shapes, key=lambda part: bool(part.bands)):
        style: dict[str, Any] = {"edgecolor": PURPLE, "linewidth": 0.8, "zorder": 5}
        style["facecolor"] = (*to_rgb(PURPLE), 0.12)
        lines = range(len(part.outlines)) if part.outlines else (0,)
        outlines = [place(projected.seen(projected.pose.point(part.body, part_points(part, at)))) for at in lines]
        if part.bands:
            centre = place(projected.seen(projected.pose.point(part.body, np.array(part.place))))
            end_on = abs(float(projected.pose.way(part.body, part.direction) @ projected.screen[2])) > 1 - 1e-9
            if end_on:
                side = float(np.hypot(*(outlines[0][1] - centre)))
                axes.add_artist(Circle((float(centre[0]), float(centre[1])), side, gid=part.name, **style))
                continue
        for at, line in enumerate(outlines):
            axes.add_artist(Polygon(line, gid=part.name, **(style | ({"facecolor": "white"} if at else {}))))


def broken_wheels(scene: Scene) -> set[str]:
    """Return the names of the wheels of pairs whose loop does not close or whose teeth cannot run."""
    return {scene.wheels[wheel].id for pair in scene.pairs if pair.broken for wheel in pair.wheels}


# ----------------------------------------------------------------------------------------------- oblique and side views


_DARK, _LIGHT = np.array(to_rgb(SHADE)), np.array(to_rgb(FILL))  # colours of a face in shade and in light
_SEAM = 0.3  # points: line width that closes the gap between two tiles of one surface
_FACES_RIGHT = 0.99  # cosine between the right and a wheel's axis beyond which the side view shows its teeth
_SECTIONS = 48  # intervals along a worm between whose sections its thread is drawn


@dataclass(frozen=True, slots=True)
class _Face:
    points: Floats
    depth: float
    light: float
    edge: float


def draw_obliquely(axes: Axes, projected: ProjectedScene, place: Place) -> None:
    """Draw every wheel by its two ends and the surface between its ends, then the axes of wheels and the arms.

    place   conversion of view coordinates (..., 3) to inches (..., 2)
    """
    scene = projected.scene
    red = broken_wheels(scene)
    faces = [(wheel, face) for wheel in scene.wheels for face in _faces(projected, wheel)]
    _draw_faces(axes, sorted(faces, key=lambda each: each[1].depth), place, red, 2.0)
    for wheel in scene.wheels:
        centre, along = projected.centre(wheel), projected.axis(wheel)
        reach = max(2.5 * wheel.thickness, 0.25 * wheel.radius)
        line = place(projected.seen(np.array([centre - reach * along, centre + reach * along])))
        axes.plot(*line.T, color=BLACK, linewidth=1.2, zorder=4)
    for body, start, end in arms_of(projected):
        line = place(projected.seen(np.array([start, end])))
        axes.plot(*line.T, color=ORANGE, linewidth=4.0, zorder=4, gid=f"arm {scene.bodies[body].id}")


def oblique_callouts(projected: ProjectedScene, place: Place, wheels: Sequence[SceneWheel]) -> list[Callout]:
    """Return a callout for each wheel, anchored if possible at a point of its faces that no nearer wheel hides."""
    ends = {wheel.id: _ends(projected, wheel) for wheel in projected.scene.wheels if wheels}
    seen = {name: place(np.concatenate([face.points for face in both])) for name, both in ends.items()}
    outlines = {name: Path(points[ConvexHull(points).vertices]) for name, points in seen.items()}
    middle = np.mean([place(near.points).mean(0)[0] for _, near in ends.values()]) if ends else 0.0
    found = []
    for wheel in wheels:
        back, front = ends[wheel.id]
        points = []  # within each face, from its rim inwards
        for face in (front, back):
            centre = face.points.mean(0)
            points += [centre + share * (face.points[::4] - centre) for share in (0.85, 0.6, 0.35, 0.1)]
        trials = place(np.concatenate(points))
        nearer = [outlines[name] for name, (_, near) in ends.items() if near.depth > front.depth]
        hidden = np.any([path.contains_points(trials) for path in nearer], axis=0) if nearer else np.zeros(len(trials))
        free = trials if hidden.all() else trials[hidden == 0]
        best = free[int(np.argmax(np.round(np.abs(free[:, 0] - middle), 6)))]
        words = [(f"name {wheel.id}", f"{wheel.id} {wheel.teeth}")]
        found.append(Callout(words, (round(float(best[0]), 6), round(float(best[1]), 6))))
    return found


def draw_across(
    axes: Axes, projected: ProjectedScene, wheel: SceneWheel, place: Place, red: set[str], order: float
) -> None:
    """Draw a wheel whose axis is in the plane of the plan, as seen from its side, at the drawing order `order`."""
    faces = sorted(_faces(projected, wheel), key=lambda face: face.depth)
    _draw_faces(axes, [(wheel, face) for face in faces], place, red, order)


def _draw_faces(
    axes: Axes, faces: Sequence[tuple[SceneWheel, _Face]], place: Place, red: set[str], order: float
) -> None:
    """Draw faces in the given order, so that the last face is on top. Wheels whose name is in `red` have red edges."""
    tints = [_DARK + (_LIGHT - _DARK) * face.light for _, face in faces]
    edges = [
        (RED if wheel.id in red else BLACK)
        if face.edge
        else tint  # without a line, parts behind would show through the seam
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


def _faces(projected: ProjectedScene, wheel: SceneWheel) -> Iterator[_Face]:
    """Yield the visible faces of a wheel: strips or, for a worm, tiles of its lateral surface, then its end faces."""
    far, near = _ends(projected, wheel)
    if wheel.kind == "worm":
        yield from _thread(projected, wheel)
        yield near
        return
    first, last = near.points, far.points
    middle = (first.mean(0) + last.mean(0)) / 2
    for start in range(0, len(first), max(len(first) // 72, 1)):
        strip = np.arange(start, min(start + max(len(first) // 72, 1), len(first)) + 1) % len(first)
        points = np.concatenate([first[strip], last[strip[::-1]]])
        away = points.mean(0) - middle
        # a strip in the middle of the wheel has no normal, and its shade is arbitrary
        shade = 0.35 + 0.3 * float(away[2]) / max(float(np.linalg.norm(away)), 1e-9)
        if away[2] > 0 or wheel.kind == "ring" or wheel.cone > 0:
            yield _Face(points, float(points[:, 2].mean()), shade, 0.0)
    yield far
    yield near


def _thread(projected: ProjectedScene, wheel: SceneWheel) -> Iterator[_Face]:
    """Yield the visible surface of a worm's thread as tiles between sections along its axis."""
    heights = np.linspace(-0.5, 0.5, _SECTIONS + 1) * wheel.thickness
    rows = np.array([projected.seen(projected.outline(wheel, height=height)) for height in heights])
    after = np.roll(rows, -1, axis=1)
    tiles = np.stack([rows[:-1], after[:-1], after[1:], rows[1:]], axis=2).reshape(-1, 4, 3)
    normals = np.cross(tiles[:, 2] - tiles[:, 0], tiles[:, 3] - tiles[:, 1])
    towards = normals[:, 2] / np.maximum(np.linalg.norm(normals, axis=1), 1e-9)
    for points, up in zip(tiles[towards > 0], towards[towards > 0], strict=True):
        yield _Face(points, float(points[:, 2].mean()), float(up), 0.0)


def _ends(projected: ProjectedScene, wheel: SceneWheel) -> tuple[_Face, _Face]:
    """Return the end faces of a wheel with their teeth: first the face away from the reader, then the visible face."""
    (high, wide), (low, narrow) = projected.ends(wheel)
    first = projected.seen(projected.outline(wheel, wide, high))
    last = projected.seen(projected.outline(wheel, narrow, low))
    up = projected.seen(projected.axis(wheel)) * np.sign(high - low)
    near, light = (first, float(up[2])) if up[2] > 0 else (last, -float(up[2]))
    far = last if near is first else first
    # 1 mm deeper than its deepest point, so that the hidden end does not cover the strips of its own wheel
    back = _Face(far, float(far[:, 2].min()) - 1.0, 0.3, 0.5)
    return back, _Face(near, float(near[:, 2].mean()), 0.45 + 0.4 * light, 0.8)


_FACE = (_DARK + _LIGHT) / 2  # colour of a bar


class SideScale:
    """Conversion of heights [mm], measured towards the reader of the plan, to abscissae of the side view [in]."""

    def __init__(self, left: float, width: float, low: float, size: float) -> None:
        self.left, self.scale, self.low = left, width / size, low

    def at(self, height: Any) -> Any:
        """Return the abscissa on the page [in] of a height [mm] towards the reader, or of an array of heights."""
        return self.left + (height - self.low) * self.scale


def draw_side(page: ScaledPage, projected: ProjectedScene, depth: SideScale) -> None:
    """Draw a train as seen from its left side, with its layers side by side and the reader of the plan at the right."""
    red = broken_wheels(projected.scene)
    stacks: dict[tuple[float, float], list[float]] = {}
    for wheel in sorted(projected.scene.wheels, key=lambda each: -float(projected.seen(projected.centre(each))[0])):
        edge = RED if wheel.id in red else BLACK
        style: dict[str, Any] = {"facecolor": (*_FACE, 0.7), "edgecolor": edge, "linewidth": 0.6, "zorder": 3}
        if not projected.faces(wheel):
            _draw_across_side(page, projected, wheel, depth, style)
            continue
        x, y, z = map(float, projected.seen(projected.centre(wheel)))
        half = max(wheel.tip, wheel.root) * page.scale
        middle = float(page.at(np.array([x, y, z]))[1])
        left, right = depth.at(z - wheel.thickness / 2), depth.at(z + wheel.thickness / 2)
        box = Rectangle((left, middle - half), right - left, 2 * half, gid=f"side {wheel.id}", **style)
        page.axes.add_artist(box)
        if wheel.helix:
            # right-hand teeth fall towards the right; the thread of a worm rises by more than the bar
            rise = min(max(-float(np.tan(wheel.helix)) * (right - left), -half), half)
            for at in (-1, 0, 1):  # three lines, as in ISO 2203
                start = middle + at * half / 3 - rise / 2
                look: dict[str, Any] = {"color": edge, "linewidth": 0.5, "zorder": 3.5}
                page.axes.plot((left, right), [start, start + rise], gid=f"helix {wheel.id}", **look)
        stacks.setdefault((round(x, 4), round(middle, 4)), []).extend((left, right))
    for (_, middle), ends in stacks.items():
        page.axes.plot([min(ends) - 0.06, max(ends) + 0.06], [middle, middle], color=BLACK, linewidth=1.4, zorder=4)
    text = "from the left" if abs(depth.scale / page.scale - 1) < 0.01 else "from the left, layers spread"
    page.axes.text(depth.left - 0.25, page.foot, text, fontsize=FINE, color=GREY)


def _draw_across_side(
    page: ScaledPage, projected: ProjectedScene, wheel: SceneWheel, depth: SideScale, style: dict[str, Any]
) -> None:
    """Draw a wheel that does not face the reader, with its teeth if it faces right, otherwise as a silhouette."""
    ends = [face.points for face in _ends(projected, wheel)]
    places = [np.column_stack([depth.at(points[:, 2]), page.at(points)[:, 1]]) for points in ends]
    if abs(float(projected.seen(projected.axis(wheel))[0])) > _FACES_RIGHT:
        outline = places[int(np.argmax([points[:, 0].mean() for points in ends]))]
    else:
        every = np.concatenate(places)
        outline = every[ConvexHull(every).vertices]
    page.axes.add_artist(Polygon(outline, gid=f"side {wheel.id}", **style))
