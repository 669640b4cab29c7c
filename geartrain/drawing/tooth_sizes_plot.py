"""The designs of triangular teeth that were looked at: an aim over a size, or the front between two aims."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from geartrain.drawing.backend import Axes, Figure
from geartrain.drawing.style import BLACK, BLUE, GREEN, GREY, RED, SMALL, TEXT, WIDTH, plain

if TYPE_CHECKING:
    from geartrain.synthesis.tooth_sizes.best_sizes import BestToothSizes
    from geartrain.synthesis.tooth_sizes.size_design import ToothSizes

_LABELS = {
    "loss": "loss (%)",
    "error": "error, peak to peak (deg)",
    "impact": "impact",
    "jam": "margin (modules)",
    "radii": "R2/R1 over z2/z1",
    "window": "window",
    "half_angle": "half angle (deg)",
}
_MARGIN = 0.08  # of what is shown
_WORST = 4.0  # times the better of the designs by rule: worse ones are beyond the rim


def tooth_sizes_figure(found: BestToothSizes) -> Figure:
    """The best sizes of a pair with triangular teeth among all that were looked at.

    Parameters
    ----------
    found : BestToothSizes
        What `geartrain.synthesis.find_tooth_sizes` gives.

    Returns
    -------
    matplotlib.figure.Figure
        Of one aim a panel for each free size; of two the Pareto front between them, alone and among all designs. Radii
        of equal depth and pitch-true ones are marked.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.synthesis import ToothSizes, find_tooth_sizes
    >>> start = ToothSizes((48, 96), 1.0, 0.5, (pi / 6, pi / 6), 0.2)
    >>> tooth_sizes_figure(find_tooth_sizes(start, free={"window": (0.4, 0.6)})).axes[0].get_xlabel()
    'window'
    """
    if len(found.aims) == 2:
        return _front_figure(found)
    names = list(found.free)
    figure = Figure(figsize=(WIDTH, 3.2 * len(names)), layout="constrained")
    for axes, name in zip(figure.subplots(len(names), 1, squeeze=False)[:, 0], names, strict=True):
        _panel(axes, found, name, found.aims[0])
    return figure


def _front_figure(found: BestToothSizes) -> Figure:
    """The front alone, and where it stands among all designs."""
    first, second = found.aims
    figure = Figure(figsize=(WIDTH, 0.5 * WIDTH), layout="constrained")
    near, far = figure.subplots(1, 2)
    x, y = ([_shown(each, name) for each in found.front] for name in (first, second))
    plain(near)
    near.set_xlabel(_LABELS[first], fontsize=TEXT)
    near.set_ylabel(_LABELS[second], fontsize=TEXT)
    near.set_title("Pareto front", fontsize=TEXT)
    near.locator_params(axis="x", nbins=4)
    _panel(far, found, first, second)
    far.set_title("among all designs", fontsize=TEXT)
    for axes in (near, far):
        axes.plot(x, y, color=BLUE, linewidth=1.8, marker="o", markersize=3, gid="front", label="front")
    near.plot(x[0], y[0], color=RED, marker="*", markersize=9, linewidth=0)
    far.legend(fontsize=SMALL, frameon=False)
    return figure


def _panel(axes: Axes, found: BestToothSizes, across: str, up: str) -> None:
    """Designs as points, the best and those by rule marked."""
    plain(axes)
    order = sorted(found.tried, key=lambda each: _shown(each, across))
    x, y = ([_shown(each, name) for each in order] for name in (across, up))
    single = len(found.free) == 1 and across in found.free
    axes.plot(x, y, color=GREY, linewidth=1.2 if single else 0, marker=".", markersize=3, gid="tried")
    marks = (("best", found.best, RED, "*"), ("equal depth", found.equal_depth, BLACK, "s"))
    for name, each, color, marker in (*marks, ("pitch-true", found.pitch_true, GREEN, "D")):
        if each is not None:
            at = _shown(each, across), _shown(each, up)
            axes.plot(*at, color=color, marker=marker, markersize=7, linewidth=0, label=name, gid=name)
    axes.set_xlabel(_LABELS[across], fontsize=TEXT)
    axes.set_ylabel(_LABELS[up], fontsize=TEXT)
    for name, limit in ((across, axes.set_xlim), (up, axes.set_ylim)):
        if name not in found.free and name != "jam":
            limit(*_span(found, name))
    axes.legend(fontsize=SMALL, frameon=False)


def _span(found: BestToothSizes, name: str) -> tuple[float, float]:
    """What is shown of an aim: from its least to what is worth a look, the designs by rule included."""
    values = sorted(_shown(each, name) for each in found.tried)
    marked = [_shown(each, name) for each in (found.equal_depth, found.pitch_true, *found.front) if each is not None]
    high = max((*marked, min(values[-1], _WORST * max(values[0], 1e-12))))
    rim = _MARGIN * (high - values[0])
    return values[0] - rim, high + rim


def _shown(design: ToothSizes, name: str) -> float:
    """A size or a figure in the unit of its axis."""
    value = design.parameter(name) if name in ("radii", "window", "half_angle") else float(getattr(design, name))
    if name in ("error", "half_angle"):
        return degrees(value)
    return 100 * value if name == "loss" else value
