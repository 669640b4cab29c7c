"""The plan of a train to scale: wheels with their teeth, arms, pins and slots, from the front and from the side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10
from textwrap import shorten, wrap
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.backend import Axes, Figure, Line2D, Patch
from geartrain.drawing.callouts import Callout, CalloutMargin, find_margin
from geartrain.drawing.labels import Box
from geartrain.drawing.oblique_side_views import SideScale, draw_obliquely, draw_side, oblique_callouts
from geartrain.drawing.plan_labels import PlanNames
from geartrain.drawing.plan_parts import draw_flat, from_below
from geartrain.drawing.projection import ProjectedScene, ScaledPage, project_scene
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    FINE,
    GREY,
    LETTER,
    ORANGE,
    PURPLE,
    RED,
    SMALL,
    sheet,
    title_of,
    write,
)
from geartrain.scene import Scene, SceneWheel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_LEAST, _MOST, _WHEEL = 5.0, 11.0, 0.85  # inches: sides of the plan, and what each wheel should have on the average
_RIM, _HEAD, _FOOT = 0.3, 0.75, 0.75
_SIDE = 1.1  # inches: least width of the side view
_TOLD = 8.5  # points: what is told above the plan


def plan_figure(scene: Scene, turns: Fraction = Fraction(0), labels: bool = True) -> Figure:
    """The scene after `turns` of its lead, to scale; trains across the plane are drawn obliquely.

    What lets a train not turn is red, with the verdict above.
    """
    standing = project_scene(scene, turns)
    plan = _PlanSize.of(standing)
    written, margin = _names(standing, plan, labels)
    beside = [wide + _RIM if wide else 0.0 for wide in margin.widths]
    width = max(plan.size[0] + 2 * _RIM + sum(beside) + plan.deep_room, 5.5)
    said = _verdict(scene, width)
    shifted = _elements(scene, width)
    over = max(plan.low[1] - margin.extent[0], margin.extent[1] - plan.low[1] - plan.size[1], 0.0)
    height = plan.size[1] + 2 * _RIM + 2 * over + _HEAD + _FOOT + 0.17 * (said.count("\n") + len(shifted))
    figure, axes = sheet(width, height, _title(scene, turns))
    left = (width - plan.size[0] - sum(beside) - plan.deep_room) / 2 + beside[0]
    shift = np.array([left, _FOOT + _RIM + over]) - plan.low
    page = ScaledPage(axes, plan.scale, shift, _FOOT - 0.1)
    if standing.flat:
        draw_flat(page, standing)
    else:
        draw_obliquely(axes, standing, page.at)
    for wheel, (x, y, _, _) in written:
        words, x, y = f"{wheel.id}\n{wheel.teeth}", x + shift[0], y + shift[1]
        write(axes, x, y, words, fontsize=FINE, gid=f"name {wheel.id}", linespacing=1.0)
    margin.moved(float(shift[0]), float(shift[1])).draw(axes)
    if plan.deep:
        start = left + plan.size[0] + beside[1] + 2 * _RIM
        draw_side(page, standing, SideScale(start, plan.deep, plan.bottom, plan.depth))
    _scale_bar(axes, plan.scale)
    _remark(page, scene, width)
    _write_above(axes, shifted, said)
    handles = list(_legend(standing, margin.has_lists))
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
    """Sizes of a plan on paper, in inches but for its depth.

    scale          inches of a millimetre
    low, size      lower left corner, about the origin of the train, and sides
    bottom, depth  height of the lowest layer towards the reader and of all layers (mm)
    deep           width of the side view, 0 without one
    """

    scale: float
    low: Floats
    size: Floats
    bottom: float
    depth: float
    deep: float

    @classmethod
    def of(cls, standing: ProjectedScene) -> _PlanSize:
        """Of a scene in its pose."""
        wheels = standing.scene.wheels
        points = np.concatenate([*(standing.seen(_extent(standing, wheel)) for wheel in wheels), *_hubs(standing)])
        low, high = points.min(0), points.max(0)
        size = np.maximum(high - low, 1e-6)  # of points alone: the scale divides by it
        side = min(max(_LEAST, _WHEEL * len(wheels) ** 0.5 * 1.7), _MOST)
        scale = side / float(size[:2].max())
        layered = standing.flat and size[2] > 1e-9 and len({wheel.layer for wheel in wheels}) > 1
        deep = max(float(size[2]) * scale, _SIDE) if layered else 0.0
        return cls(scale, scale * low[:2], scale * size[:2], float(low[2]), float(size[2]), deep)

    def at(self, seen: Floats) -> Floats:
        """Inches (..., 2) about the origin of the train of what is seen (..., 3)."""
        return np.asarray(self.scale * seen[..., :2])

    @property
    def deep_room(self) -> float:
        """What the side view takes of the page."""
        return self.deep + 2 * _RIM if self.deep else 0.0


def _names(
    standing: ProjectedScene, plan: _PlanSize, labels: bool
) -> tuple[list[tuple[SceneWheel, Box]], CalloutMargin]:
    """Names on wheels and beside the plan, in inches about the origin of the train."""
    written: list[tuple[SceneWheel, Box]] = []
    callouts: list[Callout] = []
    facing = [wheel for wheel in from_below(standing)[::-1] if standing.faces(wheel)] if standing.flat else []
    names = PlanNames.of(standing, facing, plan.at, plan.scale)
    if labels and standing.flat:
        written, callouts = names.place()
        across = [wheel for wheel in standing.scene.wheels if not standing.faces(wheel)]
        callouts += oblique_callouts(standing, plan.at, across)
    elif labels:
        callouts = oblique_callouts(standing, plan.at, standing.scene.wheels)
    edges = float(plan.low[0]) - _RIM, float(plan.low[0] + plan.size[0]) + _RIM
    margin = find_margin(callouts, edges, (float(plan.low[1]), float(plan.low[1] + plan.size[1])))
    return names.place_beside(written, margin.lines), margin


def _write_above(axes: Axes, shifted: Sequence[tuple[str, str]], said: str) -> None:
    """Lines of brakes and clutches, then the verdict, below the title."""
    height = axes.get_ylim()[1]
    for row, (words, color) in enumerate(shifted):
        write(axes, 0.15, height - 0.64 - 0.17 * row, words, color, ha="left", fontsize=_TOLD, gid="elements")
    if said:
        axes.text(
            0.15, height - 0.55 - 0.17 * len(shifted), said, fontsize=_TOLD, color=RED, va="top", parse_math=False
        )


def _title(scene: Scene, turns: Fraction) -> str:
    title = title_of(scene.name, scene.title)
    if scene.state is not None:
        title += f" (state {scene.state})"
    if turns:
        title += f", after {turns} turns of {scene.bodies[scene.lead].id if scene.lead is not None else 'nothing'}"
    return title


def _verdict(scene: Scene, width: float) -> str:
    """Why a train does not turn, in lines that fit; nothing where it does."""
    if scene.verdict["kind"] == "determined":
        return ""
    room = int((width - 0.3) / (_TOLD * LETTER))
    lines = wrap(f"{scene.verdict['kind']}: {scene.verdict['text']}", room)
    return "\n".join(lines[:4]) + (" ..." if len(lines) > 4 else "")


def _elements(scene: Scene, width: float) -> list[tuple[str, str]]:
    """Lines of brakes and clutches that are closed, then of those that are open, with their colours."""
    room = int((width - 0.3) / (_TOLD * LETTER))
    lines = []
    for word, closed, color in (("closed", True, PURPLE), ("open", False, GREY)):
        some = [each.text for each in scene.elements if each.closed is closed]
        lines += [(line, color) for line in wrap(f"{word}: {', '.join(some)}", room)] if some else []
    return lines


def _extent(standing: ProjectedScene, wheel: SceneWheel) -> Floats:
    """Points around a wheel."""
    most = max(wheel.tip, wheel.root) * (1.12 if wheel.kind == "ring" else 1.0)
    half = wheel.thickness / 2
    return np.concatenate([standing.circle(wheel, most, half), standing.circle(wheel, most, -half)])


def _hubs(standing: ProjectedScene) -> list[Floats]:
    """Axes of all bodies, so that trains without wheels have a size too."""
    bodies = standing.scene.bodies
    return [standing.seen([standing.pose.point(at, body.point)]) for at, body in enumerate(bodies)]


def _remark(page: ScaledPage, scene: Scene, width: float) -> None:
    """What could not be placed or has no room, in one line at the foot."""
    found = [notice["what"] for notice in scene.notices[:1]]
    if len(scene.notices) > 1:
        found.insert(1, f"and {len(scene.notices) - 1} more")
    text = shorten("; ".join(found), int((width - 0.3) / (FINE * LETTER)), placeholder=" ...")
    page.axes.text(0.15, 0.08, text, fontsize=FINE, color=GREY, parse_math=False, gid="remark")


def _scale_bar(axes: Axes, scale: float) -> None:
    """A round number of millimetres, about an inch long."""
    raw = 1.1 / scale
    power = 10.0 ** floor(log10(raw))
    length = max(step * power for step in (1, 2, 5) if step * power <= raw * 1.0001)
    y = 0.45
    axes.plot([0.2, 0.2 + length * scale], [y, y], color=BLACK, linewidth=2.5, solid_capstyle="butt", gid="scale bar")
    write(axes, 0.2 + length * scale / 2, y + 0.12, f"{length:g} mm", fontsize=FINE)


def _legend(standing: ProjectedScene, lists: bool) -> Iterator[Line2D | Patch]:
    scene = standing.scene
    if standing.flat:
        yield Line2D([], [], color=BLUE, linestyle="-.", linewidth=0.6, label="pitch circles")
    if any(body.role == "carrier" for body in scene.bodies):
        yield Line2D([], [], color=ORANGE, linewidth=4.5, label="carriers")
    if scene.couplings:
        yield Line2D([], [], color=PURPLE, linewidth=5.5, label="slots and pins")
    if any(pair.broken for pair in scene.pairs):
        yield Patch(facecolor="white", edgecolor=RED, label="loop that does not close")
    if lists:
        yield Line2D([], [], color=GREY, linewidth=0.6, label="wheels of one axis, from inside out")
