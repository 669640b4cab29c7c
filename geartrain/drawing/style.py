"""Colours, sizes and wording that the figures share, and words on a picture where there is room for them."""

from __future__ import annotations

from math import degrees
from textwrap import fill, shorten
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.backend import Axes, Figure, Stroke, withStroke
from geartrain.drawing.theme_colours import SCALES
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.scene.palette import THEMES, series_colour, series_dash
from geartrain.teeth.triangular.real_path import STANDSTILL
from geartrain.teeth.triangular.tooth_couple import APPROACH, RECESS
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.arrays import Floats, Ints


WIDTH = 9.0  # inches: 900 pixels at 100 dots per inch
TEXT, SMALL, FINE = 11.0, 10.0, 8.0  # points; nothing is written smaller

_LIGHT = THEMES["light"]
BLACK, GREY, PALE, WHITE, RED = _LIGHT.ink, _LIGHT.quiet, _LIGHT.line, _LIGHT.paper, _LIGHT.fault
FILL, SHADE, SKY = _LIGHT.fill, _LIGHT.shade, _LIGHT.band
BLUE, ORANGE, PURPLE, GREEN = _LIGHT.series[:4]
"""Of wheels, of carriers, of couplings, and of what else stands beside them."""
SCALE = SCALES["light"]
"""Of values on a map."""
HALO = (withStroke(linewidth=3.0, foreground=WHITE),)  # keeps text readable over lines
LETTER = 0.62 / 72  # inches of a letter by points of its size, on the average
PHASES = {APPROACH: BLUE, RECESS: ORANGE, STANDSTILL: BLACK}


def series_look(at: int) -> dict[str, Any]:
    """Colour and dashes of the series at a place from 0 on, as lines take them."""
    return {"color": series_colour(at), "linestyle": series_dash(at)}


def pair_text(law: TriangularTransmission, friction: float | None = None) -> str:
    """Tooth numbers, half angle, clearance factor and friction, by default the law's, of a pair, the driver first."""
    sizes = law.sizes
    betas = [f"{degrees(beta):.6g}°" for beta in (sizes.beta1, sizes.beta2)]
    beta = betas[0] if betas[0] == betas[1] else ", ".join(betas)
    wheels = [f"a ring of {z}" if s < 0 else str(z) for z, s in zip((sizes.z1, sizes.z2), sizes.signs, strict=True)]
    backwards = "" if law.direction > 0 else ", backwards"
    return (
        f"{wheels[0]} drives {wheels[1]}{backwards}: half angle {beta}, clearance factor "
        f"{sizes.clearance_factor:.10g}, friction {law.friction if friction is None else friction:.6g}"
    )


def require_contact(law: TriangularTransmission) -> None:
    """Raise `GearTrainError` where the pair has no teeth, or none that touch."""
    if not law.sizes.has_valleys or not law.intervals:
        raise GearTrainError(
            Problem("this pair has no contact to draw", law.verdict.text, "change its teeth or its clearance")
        )


def plain(axes: Axes) -> None:
    """Text of one size, a light grid, no box."""
    axes.tick_params(labelsize=SMALL)
    axes.grid(True, color=PALE, linewidth=0.5, alpha=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def legend_above(axes: Axes, columns: int) -> None:
    """A legend between a panel and what stands above it, at the right."""
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1, 1),
        borderpad=0,
        borderaxespad=0.1,
        frameon=False,
        fontsize=SMALL,
        ncols=columns,
    )


def short(name: str, letters: int = 20) -> str:
    """A name within some letters."""
    return shorten(name, letters, placeholder="...")


def kept_extremes(values: Floats, most: int) -> Ints:
    """Of each stretch of a course the first position, the least and the greatest, so that no peak is lost.

    most   about so many positions; all of them where there are no more
    """
    if len(values) <= most:
        return np.arange(len(values))
    kept = []
    for part in np.array_split(np.arange(len(values)), most // 3):
        known = np.nan_to_num(values[part])
        kept += [part[0], part[known.argmin()], part[known.argmax()]]
    return np.unique([*kept, len(values) - 1])


def write(axes: Axes, x: float, y: float, text: str, color: str = BLACK, halo: float = 3.0, **how: Any) -> None:
    """Words as they are, and a halo behind them: words with a halo of their own are mere outlines in a vector file."""
    how = {"ha": "center", "va": "center", "fontsize": SMALL, "color": color, "zorder": 8, "parse_math": False, **how}
    behind = {key: value for key, value in how.items() if key != "gid"}
    axes.text(x, y, text, path_effects=(Stroke(linewidth=halo, foreground=WHITE),), **behind)
    axes.text(x, y, text, **how)


def sheet(width: float, height: float, title: str) -> tuple[Figure, Axes]:
    """A figure whose axes are inches from its lower left corner, with a title at its top (two lines: 0.5 inches)."""
    figure = Figure(figsize=(width, height), dpi=100)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(0.0, width)
    axes.set_ylim(0.0, height)
    axes.set_axis_off()
    room = int((width - 0.3) / (TEXT * LETTER))
    words = fill(title, max(room, 20)).splitlines()
    text = "\n".join(words[:2]) + (" ..." if len(words) > 2 else "")
    axes.text(0.15, height - 0.12, text, fontsize=TEXT, color=BLACK, va="top", parse_math=False, gid="title")
    return figure, axes


def headed(figure: Figure, title: str) -> Figure:
    """The figure with a title above all its panels."""
    figure.suptitle(title, fontsize=TEXT, x=0.01, ha="left", color=BLACK, parse_math=False)
    return figure


def title_of(name: str, title: str) -> str:
    """What stands above a picture of a train."""
    return f"{name}: {title}" if title else name


def too_many(train: GearTrain, count: int, most: int, what: str) -> None:
    """Raise `QuestionError` where a picture would hold more than `most` of something."""
    if count > most:
        raise QuestionError(
            Problem(
                f"'{train.name}' has {count} {what}, too many for this picture",
                f"a page holds {most} that can still be told apart",
                "draw a part of it, or another kind of picture",
            )
        )
