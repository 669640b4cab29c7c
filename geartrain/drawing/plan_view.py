"""Plan of a train to scale: wheels with their teeth, arms, pins and slots, from the front and from the side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10, pi
from textwrap import shorten, wrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb

from geartrain.drawing.arrangement import Box, Callout, CalloutMargin, LabelSpace, find_margin, text_box
from geartrain.drawing.projection import (
    ProjectedScene,
    ScaledPage,
    SideScale,
    arms_of,
    broken_wheels,
    coupling_spans,
    draw_across,
    draw_obliquely,
    draw_shapes,
    draw_side,
    oblique_callouts,
    part_points,
    project_scene,
)
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    FILL,
    FINE,
    GREY,
    LETTER,
    ORANGE,
    PURPLE,
    RED,
    SHADE,
    SMALL,
    Axes,
    Circle,
    Figure,
    Line2D,
    Patch,
    Path,
    PathPatch,
    Polygon,
    after_turns,
    sheet,
    title_of,
    write,
)
from geartrain.scene import Scene
from geartrain.scene.elements import SceneCoupling, SceneWheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

_FAR, _NEAR = np.array(to_rgb(SHADE)), np.array(to_rgb(FILL))  # colours of the lowest and highest layer
_ONLY = 0.7  # position between both colours of the only layer of a train
_CHORD, _COARSE = 0.002, 0.02  # maximum deviation of a simplified outline, in inches and in modules


def from_below(projected: ProjectedScene) -> list[SceneWheel]:
    """Return the wheels in drawing order: farthest from the reader first, and at equal distances the largest first."""
    return sorted(
        projected.scene.wheels, key=lambda wheel: (float(projected.seen(projected.centre(wheel))[2]), -wheel.radius)
    )


def draw_flat(page: ScaledPage, projected: ProjectedScene) -> None:
    """Draw a scene whose wheels face the reader: wheels, arms of carriers, wave generators, couplings and arbors."""
    scene, wheels = projected.scene, from_below(projected)
    heights = sorted({round(float(projected.seen(projected.centre(wheel))[2]), 6) for wheel in wheels})
    red = broken_wheels(scene)
    for order, wheel in enumerate(wheels):
        place = heights.index(round(float(projected.seen(projected.centre(wheel))[2]), 6))
        level = place / (len(heights) - 1) if len(heights) > 1 else _ONLY
        if not projected.faces(wheel):
            draw_across(page.axes, projected, wheel, page.at, red, 2 + order / len(wheels))
            continue
        _draw_wheel(page, projected, wheel, level, 2 + order / len(wheels), wheel.id in red)
    _draw_arms(page, projected)
    _draw_waves(page, projected)
    for coupling in scene.couplings:
        _draw_coupling(page, projected, coupling)
    draw_shapes(page.axes, projected, page.at)
    for spot in {tuple(np.round(page.at(projected.seen(projected.centre(wheel))), 4)) for wheel in wheels}:
        page.axes.add_artist(Circle(spot, 0.035, facecolor=BLACK, edgecolor="white", linewidth=0.5, zorder=6))


def _draw_wheel(
    page: ScaledPage, projected: ProjectedScene, wheel: SceneWheel, level: float, order: float, red: bool
) -> None:
    chord = min(_CHORD / page.scale, _COARSE * wheel.module)
    outline = page.at(projected.seen(projected.outline(wheel, chord=chord)))
    face = (*(_FAR + (_NEAR - _FAR) * level), 0.78)
    style: dict[str, Any] = {"edgecolor": RED if red else BLACK, "linewidth": 1.2 if red else 0.6, "zorder": order}
    if wheel.kind == "ring":
        rim = page.at(projected.seen(projected.circle(wheel, wheel.root * 1.1)))
        page.axes.add_artist(PathPatch(_area_between(rim, outline), facecolor=face, gid=f"wheel {wheel.id}", **style))
    elif wave := projected.wave(wheel):
        bore = page.at(projected.seen(projected.bore(wave)))
        page.axes.add_artist(PathPatch(_area_between(outline, bore), facecolor=face, gid=f"wheel {wheel.id}", **style))
    else:
        page.axes.add_artist(Polygon(outline, facecolor=face, gid=f"wheel {wheel.id}", **style))
    for pin in projected.pins(wheel):
        page.axes.add_artist(Polygon(page.at(projected.seen(pin)), facecolor="white", **style))
    centre = page.at(projected.seen(projected.centre(wheel)))
    pitch = Circle((float(centre[0]), float(centre[1])), wheel.radius * page.scale, fill=False, gid=f"pitch {wheel.id}")
    pitch.set(edgecolor=RED if red else BLUE, linewidth=0.6, linestyle="-.", zorder=order)
    page.axes.add_artist(pitch)


def _area_between(outer: Floats, inner: Floats) -> Path:
    """Return the path of the area between two closed lines."""
    codes = [
        code for line in (outer, inner) for code in (Path.MOVETO, *[Path.LINETO] * (len(line) - 1), Path.CLOSEPOLY)
    ]
    return Path(np.concatenate([outer, outer[:1], inner[::-1], inner[-1:]]), codes)


def _draw_arms(page: ScaledPage, projected: ProjectedScene) -> None:
    arms = list(arms_of(projected))
    wide = 4.5 if len(arms) < 6 else 2.5
    for body, start, end in arms:
        line = page.at(projected.seen(np.array([start, end])))
        name = f"arm {projected.scene.bodies[body].id}"
        page.axes.plot(*line.T, color="white", linewidth=wide + 2, solid_capstyle="round", zorder=4)
        page.axes.plot(*line.T, color=ORANGE, linewidth=wide, solid_capstyle="round", zorder=4, gid=name)


def _draw_waves(page: ScaledPage, projected: ProjectedScene) -> None:
    """Draw each wave generator from its axis to the points at which it deflects its flexible wheel outwards."""
    for wave in projected.scene.waves:
        name = f"wave {projected.scene.bodies[wave.by].id}"
        page.axes.add_artist(
            Polygon(page.at(projected.seen(projected.bore(wave))), fill=False, edgecolor=ORANGE, zorder=4)
        )
        hub = projected.centre(projected.scene.wheels[wave.wheel])
        for lobe in projected.lobes(wave):
            line = page.at(projected.seen(np.array([hub, lobe])))
            page.axes.plot(*line.T, color=ORANGE, linewidth=2.5, solid_capstyle="butt", zorder=4, gid=name)


def _draw_coupling(page: ScaledPage, projected: ProjectedScene, coupling: SceneCoupling) -> None:
    """Draw a coupling by pins: a pin in the part of its slot that it can reach, or several pins in round holes."""
    if coupling.hole:
        _draw_holes(page, projected, coupling)
        return
    pin = page.at(projected.seen(projected.pose.point(coupling.pin, coupling.pin_at)))
    (ends,) = coupling_spans(projected, coupling, page.at, page.scale)
    page.axes.plot(*ends.T, color=PURPLE, linewidth=5.5, solid_capstyle="round", zorder=5, gid=f"slot {coupling.id}")
    page.axes.plot(*ends.T, color="white", linewidth=3.0, solid_capstyle="round", zorder=5)
    spot = (float(pin[0]), float(pin[1]))
    page.axes.add_artist(Circle(spot, 0.045, facecolor=PURPLE, edgecolor=BLACK, zorder=6, gid=f"pin {coupling.id}"))


def _draw_holes(page: ScaledPage, projected: ProjectedScene, coupling: SceneCoupling) -> None:
    for what, body, places, size in (
        ("hole", coupling.slot, coupling.holes_at, coupling.hole),
        ("pin", coupling.pin, coupling.pins_at, coupling.pin_diameter),
    ):
        for at, place in enumerate(places):
            x, y = page.at(projected.seen(projected.pose.point(body, place)))
            gid = f"{what} {at + 1} {coupling.id}"
            round_ = Circle((float(x), float(y)), size / 2 * page.scale, zorder=5, gid=gid)
            face, edge = ("white", PURPLE) if what == "hole" else (PURPLE, BLACK)
            round_.set(facecolor=face, edgecolor=edge, linewidth=0.8)
            page.axes.add_artist(round_)


_ROUND = 16  # directions in which positions are tried
_SHARES = (0.72, 0.5, 0.86, 0.35)  # radii of candidate positions of a name, over the wheel's radius
_POINTS = (0.9, 0.75, 0.55, 0.3)  # radii of candidate ends of a callout line, over the wheel's radius
_STEP = 0.08  # inches between the points that keep names off arms and lines
_HUB, _LINE = 0.12, 0.04  # inches kept free around a hub or a point of an arm, and around a point of a callout line


@dataclass(frozen=True, slots=True)
class PlanNames:
    """Names of the wheels that face the reader, nearest first, and the areas in which they can be written."""

    wheels: Sequence[SceneWheel]
    centres: Floats
    """Centres of the wheels, shape (n, 2) [in]."""
    reach: Floats
    """Radii of the discs that the wheels hide, shape (n,) [in]; 0 for a ring gear, which is open."""
    arms: Floats
    """Points on arms, slots and pins in holes, shape (m, 2) [in]. Names must not cover these points."""
    scale: float
    """Scale of the plan: inches on paper per millimetre of the train."""

    @classmethod
    def of(
        cls, projected: ProjectedScene, wheels: Sequence[SceneWheel], at: Callable[[Floats], Floats], scale: float
    ) -> PlanNames:
        """Return the names of the given wheels. The function `at` converts view coordinates to inches."""
        centres = np.array([at(projected.seen(projected.centre(wheel))) for wheel in wheels]).reshape(-1, 2)
        reach = np.array([0.0 if wheel.kind == "ring" else wheel.tip * scale for wheel in wheels])
        ends = [at(projected.seen(np.array([start, end]))) for _, start, end in arms_of(projected)]
        pins = [span for each in projected.scene.couplings for span in coupling_spans(projected, each, at, scale)]
        return cls(wheels, centres, reach, _points_along([*ends, *pins]), scale)

    def place(self) -> tuple[list[tuple[SceneWheel, Box]], list[Callout]]:
        """Return the names that fit on their wheels, and callouts for the names that do not fit.

        Wheels of one axis whose names do not fit share a callout, which lists them from the smallest to the largest.
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
        """Return the names on wheels, moved within their wheels where a leader line would cross them.

        written   names and their boxes
        lines     leader lines of callouts, shape (2, 2) each [in]
        """
        room, order = self._room(lines), {wheel.id: at for at, wheel in enumerate(self.wheels)}
        found = []
        for wheel, box in written:
            moved = room.place(self._on_face(order[wheel.id]))
            if moved is None:
                room.take(box)
            found.append((wheel, moved or box))
        return found

    def _room(self, lines: Sequence[Floats]) -> LabelSpace:
        """Return a record of occupied boxes that contains all hubs, arms and leader lines."""
        room = LabelSpace()
        for x, y in (*self.centres, *self.arms):
            room.take((float(x), float(y), _HUB, _HUB))
        for x, y in _points_along(lines):
            room.take((float(x), float(y), _LINE, _LINE))
        return room

    def _on_face(self, order: int) -> Iterator[Box]:
        """Yield boxes for the name of a wheel within the visible part of its face. A ring gear has no such box."""
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
        # wheels are listed from the nearest, so that only earlier wheels can hide this one
        above = self.centres[:order], self.reach[:order]
        hidden = points_in_discs(corners.reshape(-1, 2), *above).reshape(len(spots), -1).any(1)
        yield from ((x, y, wide, high) for x, y in spots[within & ~hidden].tolist())

    def _callouts(self, rest: Sequence[int]) -> list[Callout]:
        """Return a callout for each axis of wheels whose names do not fit on their faces (`rest`, by index)."""
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
        """Return the visible point of a wheel farthest from the abscissa `middle` [in], or a point of its rim."""
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
    """Return points (n, 2) along lines (2, 2), spaced so closely that no text fits between two of them."""
    found = [np.zeros((0, 2))]
    for first, last in lines:
        steps = max(int(np.hypot(*(last - first)) / _STEP), 1)
        found.append(first + np.linspace(0, 1, steps + 1)[:, None] * (last - first))
    return np.concatenate(found)


def points_in_discs(points: Floats, centres: Floats, reach: Floats) -> NDArray[np.bool_]:
    """Return a mask of the points (n, 2) that are in a disc with one of `centres` (m, 2) and radii `reach`."""
    if not len(points) or not len(centres):
        return np.zeros(len(points), dtype=bool)
    middle = points.mean(axis=0)
    far = np.hypot(*(points - middle).T).max()
    near = np.hypot(*(centres - middle).T) < reach + far + 1e-9  # farther discs cannot contain any of the points
    apart = points[:, None] - centres[near]
    return np.asarray((np.hypot(apart[..., 0], apart[..., 1]) < reach[near]).any(axis=1))


_MINIMUM, _MOST, _WHEEL = 5.0, 11.0, 0.85  # inches: minimum and maximum side of the plan, mean share of a wheel
_RIM, _HEAD, _FOOT = 0.3, 0.75, 0.75
_SIDE = 1.1  # inches: minimum width of the side view
_NOTE_SIZE = 8.5  # points: text above the plan


def plan_figure(scene: Scene, turns: Fraction = Fraction(0), labels: bool = True) -> Figure:
    """Return a figure of the scene to scale after `turns` of its driving link. A train that is not planar is drawn
    obliquely.

    Pairs in a loop that does not close are drawn in red. The verdict on a train that does not turn is written above the
    plan.
    """
    projected = project_scene(scene, turns)
    plan = _PlanSize.of(projected)
    written, margin = _names(projected, plan, labels)
    beside = [wide + _RIM if wide else 0.0 for wide in margin.widths]
    width = max(plan.size[0] + 2 * _RIM + sum(beside) + plan.deep_room, 5.5)
    said = _verdict(scene, width)
    shifted = _elements(scene, width)
    over = max(plan.low[1] - margin.extent[0], margin.extent[1] - plan.low[1] - plan.size[1], 0.0)
    height = plan.size[1] + 2 * _RIM + 2 * over + _HEAD + _FOOT + 0.17 * (said.count("\n") + len(shifted))
    state = "" if scene.state is None else f" (state {scene.state})"
    figure, axes = sheet(width, height, title_of(scene.name, scene.title) + state + after_turns(scene, turns))
    left = (width - plan.size[0] - sum(beside) - plan.deep_room) / 2 + beside[0]
    shift = np.array([left, _FOOT + _RIM + over]) - plan.low
    page = ScaledPage(axes, plan.scale, shift, _FOOT - 0.1)
    if projected.flat:
        draw_flat(page, projected)
    else:
        draw_obliquely(axes, projected, page.at)
        draw_shapes(axes, projected, page.at)
    for wheel, (x, y, _, _) in written:
        words, x, y = f"{wheel.id}\n{wheel.teeth}", x + shift[0], y + shift[1]
        write(axes, x, y, words, fontsize=FINE, gid=f"name {wheel.id}", linespacing=1.0)
    margin.moved(float(shift[0]), float(shift[1])).draw(axes)
    if plan.deep:
        start = left + plan.size[0] + beside[1] + 2 * _RIM
        draw_side(page, projected, SideScale(start, plan.deep, plan.bottom, plan.depth))
    _scale_bar(axes, plan.scale)
    _remark(page, scene, width)
    _write_above(axes, shifted, said)
    handles = list(_legend(projected, margin.has_lists))
    figure.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1.0, 0.2 / height),
        ncols=len(handles),
        fontsize=SMALL - 1.5,
        frameon=False,
    )
    return figure


@dataclass(frozen=True, slots=True)
class _PlanSize:
    """Dimensions of a plan on paper [in], and heights of its layers in the train [mm]."""

    scale: float
    """Scale of the plan: inches on paper per millimetre of the train."""
    low: Floats
    """Lower left corner (2,) of the plan, relative to the origin of the train [in]."""
    size: Floats
    """Width and height of the plan (2,) [in]."""
    bottom: float
    """Height of the lowest layer, measured towards the reader [mm]."""
    depth: float
    """Total height of all layers [mm]."""
    deep: float
    """Width of the side view [in]; 0 if the plan has no side view."""

    @classmethod
    def of(cls, projected: ProjectedScene) -> _PlanSize:
        """Return the dimensions of the plan of a scene in its pose."""
        wheels, bodies = projected.scene.wheels, projected.scene.bodies
        hubs = [[projected.pose.point(at, body.point)] for at, body in enumerate(bodies)]  # without wheels: the size
        shapes = [projected.pose.point(part.body, part_points(part)) for part in projected.scene.shapes]
        points = projected.seen(np.concatenate([*(_extent(projected, wheel) for wheel in wheels), *shapes, *hubs]))
        low, high = points.min(0), points.max(0)
        size = np.maximum(high - low, 1e-6)  # a train of points only has no extent, and the scale divides by it
        side = min(max(_MINIMUM, _WHEEL * len(wheels) ** 0.5 * 1.7), _MOST)
        scale = side / float(size[:2].max())
        layered = projected.flat and size[2] > 1e-9 and len({wheel.layer for wheel in wheels}) > 1
        deep = max(float(size[2]) * scale, _SIDE) if layered else 0.0
        return cls(scale, scale * low[:2], scale * size[:2], float(low[2]), float(size[2]), deep)

    def at(self, seen: Floats) -> Floats:
        """Convert view coordinates (..., 3) [mm] to distances (..., 2) from the origin of the train on the
        page [in].
        """
        return np.asarray(self.scale * seen[..., :2])

    @property
    def deep_room(self) -> float:
        """Width of the side view including its margins [in]."""
        return self.deep + 2 * _RIM if self.deep else 0.0


def _names(
    projected: ProjectedScene, plan: _PlanSize, labels: bool
) -> tuple[list[tuple[SceneWheel, Box]], CalloutMargin]:
    """Return the names on wheels with their boxes, and callouts for the other names [in]; empty without `labels`."""
    written: list[tuple[SceneWheel, Box]] = []
    callouts: list[Callout] = []
    facing = [wheel for wheel in from_below(projected)[::-1] if projected.faces(wheel)] if projected.flat else []
    names = PlanNames.of(projected, facing, plan.at, plan.scale)
    if labels and projected.flat:
        written, callouts = names.place()
        across = [wheel for wheel in projected.scene.wheels if not projected.faces(wheel)]
        callouts += oblique_callouts(projected, plan.at, across)
    elif labels:
        callouts = oblique_callouts(projected, plan.at, projected.scene.wheels)
    edges = float(plan.low[0]) - _RIM, float(plan.low[0] + plan.size[0]) + _RIM
    margin = find_margin(callouts, edges, (float(plan.low[1]), float(plan.low[1] + plan.size[1])))
    return names.place_beside(written, margin.lines), margin


def _write_above(axes: Axes, shifted: Sequence[tuple[str, str]], said: str) -> None:
    """Write the lines of text `shifted`, each with its colour, and then the verdict `said`, below the title."""
    height = axes.get_ylim()[1]
    for row, (words, color) in enumerate(shifted):
        write(axes, 0.15, height - 0.64 - 0.17 * row, words, color, ha="left", fontsize=_NOTE_SIZE, gid="elements")
    if said:
        axes.text(
            0.15, height - 0.55 - 0.17 * len(shifted), said, fontsize=_NOTE_SIZE, color=RED, va="top", parse_math=False
        )


def _verdict(scene: Scene, width: float) -> str:
    """Return the verdict on the train, wrapped to a width [in] and at most four lines; empty for a determined train."""
    if scene.verdict["kind"] == "determined":
        return ""
    room = int((width - 0.3) / (_NOTE_SIZE * LETTER))
    lines = wrap(f"{scene.verdict['kind']}: {scene.verdict['text']}", room)
    return "\n".join(lines[:4]) + (" ..." if len(lines) > 4 else "")


def _elements(scene: Scene, width: float) -> list[tuple[str, str]]:
    """Return lines of text that list the closed brakes and clutches, then the open ones, each line with its colour."""
    room = int((width - 0.3) / (_NOTE_SIZE * LETTER))
    lines = []
    for word, closed, color in (("closed", True, PURPLE), ("open", False, GREY)):
        some = [each.text for each in scene.elements if each.closed is closed]
        lines += [(line, color) for line in wrap(f"{word}: {', '.join(some)}", room)] if some else []
    return lines


def _extent(projected: ProjectedScene, wheel: SceneWheel) -> Floats:
    """Return points on the circumference of a wheel that determine its bounding box."""
    most = max(wheel.tip, wheel.root) * (1.12 if wheel.kind == "ring" else 1.0)
    half = wheel.thickness / 2
    return np.concatenate([projected.circle(wheel, most, half), projected.circle(wheel, most, -half)])


def _remark(page: ScaledPage, scene: Scene, width: float) -> None:
    """Write the first notice of the scene, and the number of further notices, in one line at the bottom of the page."""
    found = [notice["what"] for notice in scene.notices[:1]]
    if len(scene.notices) > 1:
        found.insert(1, f"and {len(scene.notices) - 1} more")
    text = shorten("; ".join(found), int((width - 0.3) / (FINE * LETTER)), placeholder=" ...")
    page.axes.text(0.15, 0.08, text, fontsize=FINE, color=GREY, parse_math=False, gid="remark")


def _scale_bar(axes: Axes, scale: float) -> None:
    """Draw a scale bar with the length of a round number of millimetres, at most 1.1 inches on paper."""
    raw = 1.1 / scale
    power = 10.0 ** floor(log10(raw))
    length = max(step * power for step in (1, 2, 5) if step * power <= raw * 1.0001)
    y = 0.45
    axes.plot([0.2, 0.2 + length * scale], [y, y], color=BLACK, linewidth=2.5, solid_capstyle="butt", gid="scale bar")
    write(axes, 0.2 + length * scale / 2, y + 0.12, f"{length:g} mm", fontsize=FINE)


def _legend(projected: ProjectedScene, lists: bool) -> Iterator[Line2D | Patch]:
    scene = projected.scene
    if projected.flat and scene.wheels:
        yield Line2D([], [], color=BLUE, linestyle="-.", linewidth=0.6, label="pitch circles")
    if any(body.role == "carrier" for body in scene.bodies):
        yield Line2D([], [], color=ORANGE, linewidth=4.5, label="carriers")
    if scene.couplings:
        yield Line2D([], [], color=PURPLE, linewidth=5.5, label="slots and pins")
    if scene.shapes:
        yield Patch(facecolor="white", edgecolor=PURPLE, label="couplings")
    if any(pair.broken for pair in scene.pairs):
        yield Patch(facecolor="white", edgecolor=RED, label="loop that does not close")
    if lists:
        yield Line2D([], [], color=GREY, linewidth=0.6, label="wheels of one axis, from inside out")
