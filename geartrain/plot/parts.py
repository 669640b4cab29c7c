"""Colours, sizes and wording that the figures share."""

from __future__ import annotations

from math import degrees

from geartrain.errors import GearTrainError, Problem
from geartrain.plot.library import Axes, withStroke
from geartrain.teeth.triangular.contact import APPROACH, RECESS
from geartrain.teeth.triangular.law import TriangularLaw
from geartrain.teeth.triangular.path import STANDSTILL

WIDTH = 9.0  # inches: 900 pixels at 100 dots per inch
TEXT, SMALL = 11.0, 10.0  # points

# colours that remain distinct to the colour-blind (Okabe and Ito)
BLACK, GREY, PALE = "#222222", "#6e6e6e", "#bdbdbd"
BLUE, SKY, GREEN, ORANGE, RED, PURPLE = "#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#cc79a7"
HALO = (withStroke(linewidth=3.0, foreground="white"),)  # keeps text readable over lines
PHASES = {APPROACH: BLUE, RECESS: RED, STANDSTILL: BLACK}


def pair_text(law: TriangularLaw) -> str:
    """Tooth numbers, half angle, clearance factor and friction of a law's pair, the driver first."""
    sizes = law.sizes
    betas = [f"{degrees(beta):.6g}°" for beta in (sizes.beta1, sizes.beta2)]
    beta = betas[0] if betas[0] == betas[1] else ", ".join(betas)
    backwards = "" if law.direction > 0 else ", backwards"
    return (
        f"{sizes.z1} drives {sizes.z2}{backwards}: half angle {beta}, clearance factor {1 + sizes.excess:.10g}, "
        f"friction {law.friction:.6g}"
    )


def require_contact(law: TriangularLaw) -> None:
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
