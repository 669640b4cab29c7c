"""A picture of each step of an assembly: from above and from the side, what comes in dark, what stands grey."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.palette import THEMES, series_colour
from geartrain.workshop.export.assembly_steps import AssemblyStep, assembly_steps

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart

_CHORD = 0.1  # mm: how far what is drawn of an outline may leave it
_GAP = 0.12  # of the width: between both views
_MARGIN = 0.04
_WIDE = 720  # pixels
_LETTER = 0.016  # of the width
_TOLD = 14  # parts that are named in the picture
_PAPER = THEMES["light"]
_NEW, _OLD = (series_colour(0), _PAPER.band), (_PAPER.line, "none")  # edge and face


def picture_path(number: int) -> str:
    """Where the picture of a step is, in the folder."""
    return f"assembly/{number:02d}.svg"


def step_pictures(work: SolidModel) -> Iterator[tuple[str, str, Callable[[], bytes]]]:
    """Path, title and maker of the picture of every step by which parts come in."""
    steps = assembly_steps(work)
    pictures = AssemblyPictures(work, steps) if steps else None
    before: dict[str, None] = {}
    for number, step in enumerate(steps, 1):
        if pictures is not None and step.parts and step.shown:
            draw = partial(pictures.draw, step, number, tuple(before))
            yield picture_path(number), f"step {number} of putting it together", draw
        before |= dict.fromkeys(step.parts)


class AssemblyPictures:
    """Pictures of one train in the coordinates of its stack (mm)."""

    def __init__(self, work: SolidModel, steps: Sequence[AssemblyStep]) -> None:
        assert work.frame is not None
        self.stack = work.frame.plan.stack
        shown = {name for step in steps if step.shown for name in step.parts}
        self.parts = {part.name: part for part in work.parts if part.name in shown}

    @cached_property
    def boxes(self) -> dict[str, Floats]:
        """Least and greatest right, up and height of each part, (2, 3)."""
        found = {}
        for name, part in self.parts.items():
            seen = part.placed.vertices @ self.stack.turn
            found[name] = np.array([seen.min(axis=0), seen.max(axis=0)])
        return found

    @cached_property
    def extent(self) -> tuple[Floats, Floats]:
        """Of all parts."""
        boxes = np.array(list(self.boxes.values()))
        return boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)

    def draw(self, step: AssemblyStep, number: int, before: Sequence[str]) -> bytes:
        """One step as SVG, after what came before it."""
        low, high = self.extent
        wide, deep, tall = (high - low).tolist()
        gap, margin = _GAP * wide, _MARGIN * wide
        letter = _LETTER * wide
        width, height = wide + 2 * margin, deep + gap + tall + 2 * margin + 3 * letter
        lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDE}" height="{_WIDE * height / width:.0f}" '
            f'viewBox="0 0 {width:.3f} {height:.3f}">',
            f"<title>{number}. {escape(step.text)}</title>",
            f'<rect width="{width:.3f}" height="{height:.3f}" fill="{_PAPER.paper}"/>',
            f'<g fill="{_PAPER.ink}" font-family="sans-serif" font-size="{letter:.3f}">',
        ]
        corner = np.array([margin, margin + 2 * letter])
        there = (name for name in before if name in self.parts and name not in step.parts)
        shown = [(name, _OLD) for name in there] + [(name, _NEW) for name in step.parts]
        stroke = wide / 700
        for name, (edge, fill) in shown:
            part = self.parts[name]
            style = f'stroke="{edge}" fill="{fill}" stroke-width="{stroke:.3f}" fill-opacity="0.35" fill-rule="evenodd"'
            lines.append(f'<path d="{" ".join(self._plan(part, corner, name in step.parts))}" {style}/>')
            (x0, _, z0), (x1, _, z1) = (self.boxes[name] - low).tolist()
            y = corner[1] + deep + gap + tall - z1
            lines.append(
                f'<rect x="{x0 + margin:.3f}" y="{y:.3f}" width="{x1 - x0:.3f}" height="{z1 - z0:.3f}" {style}/>'
            )
        lines += self._names(step, letter, corner)
        lines.append(f'<text x="{margin:.3f}" y="{margin + letter / 2:.3f}">Step {number}: from above</text>')
        lines.append(f'<text x="{margin:.3f}" y="{corner[1] + deep + gap - letter:.3f}">and from the side</text>')
        return "\n".join([*lines, "</g></svg>", ""]).encode("utf-8")

    def _plan(self, part: SolidPart, corner: Floats, fine: bool) -> Iterator[str]:
        """Outlines from above; turned parts, and wheels that stand already, as circles."""
        low, high = self.extent
        radius = part.turned.diameter / 2 if part.turned is not None else 0.0
        if part.kind == "wheel" and part.contours and not fine:
            radius = float(np.hypot(*part.contours[0].points.T).max())
        if radius:
            x, y, _ = (part.place @ self.stack.turn).tolist()
            x, y = corner[0] + x - low[0] - radius, corner[1] + high[1] - y
            half = f"a {radius:.3f} {radius:.3f} 0 1 0"
            yield f"M {x:.3f} {y:.3f} {half} {2 * radius:.3f} 0 {half} {-2 * radius:.3f} 0 Z"
            return
        for contour in part.contours:
            flat = contour.flattened(_CHORD)
            seen = (np.column_stack([flat, np.zeros(len(flat))]) @ part.turn.T + part.place) @ self.stack.turn
            yield _closed(corner[0] + seen[:, 0] - low[0], corner[1] + high[1] - seen[:, 1])
        if not part.contours:
            (x0, y0, _), (x1, y1, _) = self.boxes[part.name].tolist()
            x = corner[0] - low[0] + np.array([x0, x1, x1, x0])
            yield _closed(x, corner[1] + high[1] - np.array([y0, y0, y1, y1]))

    def _names(self, step: AssemblyStep, letter: float, corner: Floats) -> Iterator[str]:
        """Names of what comes in, at its middle, those of one place below each other; none of many."""
        low, high = self.extent
        taken: set[tuple[int, int]] = set()
        for name in step.parts if len(step.parts) <= _TOLD else ():
            x, y, _ = self.boxes[name].mean(axis=0)
            at = corner[0] + x - low[0], corner[1] + high[1] - y
            column, row = round(at[0] / letter / 4), round(at[1] / letter)
            while (column, row) in taken:
                row += 1
            taken.add((column, row))
            yield f'<text x="{at[0]:.3f}" y="{row * letter:.3f}" text-anchor="middle">{escape(name)}</text>'


def _closed(x: Floats, y: Floats) -> str:
    points = " L ".join(f"{a:.3f} {b:.3f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
    return f"M {points} Z"
