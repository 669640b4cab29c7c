"""Plots of the best sizes of triangular teeth: all designs of a pair, and the objective of each pair of a train before
and after optimisation.
"""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Any

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    RED,
    TEXT,
    WHITE,
    WIDTH,
    Axes,
    Figure,
    Row,
    curve_panels,
    headed,
    interval_chart,
    legend_below,
    name_axes,
    plain,
)

if TYPE_CHECKING:
    from geartrain.workshop.sizes.best_sizes import BestToothSizes
    from geartrain.workshop.sizes.size_design import ToothSizes
    from geartrain.workshop.sizes.train_size_search import BestTrainSizes

_LABELS = {
    "loss": "loss (%)",
    "error": "error, peak to peak (deg)",
    "impact": "impact",
    "jam": "margin (modules)",
    "radii": "(R2/R1) / (z2/z1)",
    "window": "window",
    "half_angle": "half angle (deg)",
}
_OPEN: dict[str, Any] = {"markerfacecolor": WHITE, "markeredgewidth": 1.6}
_PAIR_MARKS: tuple[tuple[str, str, dict[str, Any]], ...] = (  # of decreasing size, so that all remain visible
    ("as declared", "declared", {"marker": "s", "markersize": 12, "color": BLACK, **_OPEN}),
    ("best separately", "apart", {"marker": "o", "markersize": 8.5, "color": BLUE, **_OPEN}),
    ("best for the train", "together", {"marker": "*", "markersize": 6, "color": RED}),
)
_DESIGN_MARKS: dict[str, dict[str, Any]] = {
    "equal depth": {"marker": "s", "markersize": 12, "color": BLACK, **_OPEN},
    "pitch-true": {"marker": "D", "markersize": 8, "color": GREEN, **_OPEN},
    "best": {"marker": "*", "markersize": 8, "color": RED},
}
_MARGIN = 0.08  # of the range shown
_WORST = 4.0  # multiple of the best value up to which designs are shown


def tooth_sizes_figure(found: BestToothSizes) -> Figure:
    """Draw the best sizes of a pair with triangular teeth, and all evaluated designs."""
    z1, z2 = found.teeth
    best = " and ".join(_LABELS[aim].partition(",")[0].partition(" (")[0] for aim in found.aims)
    title = f"triangular teeth, {z1} and {z2}, wheel {found.driver} drives: best {best}"
    if len(found.aims) == 2:
        return headed(_front_figure(found), title)
    # one panel for each free parameter
    figure, panels = curve_panels([3.2] * len(found.free), share=False)
    for axes, name in zip(panels, found.free, strict=True):
        _panel(axes, found, name, found.aims[0])
    _key(figure, figure.axes[0])
    return headed(figure, title)


def train_sizes_figure(found: BestTrainSizes) -> Figure:
    """Draw the objective of each pair of a train for its declared and its best sizes. The pair with the worst declared
    value is at the top.
    """
    sign = -1.0 if found.aim == "jam" else 1.0
    pairs = sorted(found.pairs, key=lambda pair: -sign * _shown(pair.declared or pair.together, found.aim))
    rows = []
    for pair in pairs:
        marks = {
            name: _shown(each, found.aim) for name, of, _ in _PAIR_MARKS if (each := getattr(pair, of)) is not None
        }
        ends = marks.get("as declared", marks["best for the train"]), marks["best for the train"]
        rows.append(Row(f"{pair.name}, {pair.teeth[0]}/{pair.teeth[1]}", marks, (ends,)))
    before, after = (
        "none" if each is None else f"{_in_units(each, found.aim):.3g}" for each in (found.before, found.together)
    )
    label = _LABELS[found.aim]
    title = f"{found.train} to {found.output}: {label} {before} as declared, {after} optimised"
    figure = interval_chart({label: rows}, {name: look for name, _, look in _PAIR_MARKS}, title=title)
    axes = figure.axes[0]
    axes.set_xlim(left=min(0.0, axes.get_xlim()[0]))
    return figure


def _front_figure(found: BestToothSizes) -> Figure:
    """Draw the Pareto front in one panel, and the front together with all designs in another panel."""
    first, second = found.aims
    figure = Figure(figsize=(WIDTH, 0.5 * WIDTH), layout="constrained")
    near, far = figure.subplots(1, 2)
    x, y = ([_shown(each, name) for each in found.front] for name in (first, second))
    plain(near)
    name_axes(near, _LABELS[first], _LABELS[second])
    near.set_title("Pareto front", fontsize=TEXT)
    near.locator_params(axis="x", nbins=4)
    _panel(far, found, first, second)
    far.set_title("among all designs", fontsize=TEXT)
    for axes in (near, far):
        axes.plot(x, y, color=BLUE, linewidth=1.8, marker="o", markersize=3, gid="front", label="front", zorder=2.5)
    near.plot(x[0], y[0], color=RED, marker="*", markersize=9, linewidth=0)
    _key(figure, far)
    return figure


def _key(figure: Figure, axes: Axes) -> None:
    """Add a legend of the markers below all panels, where it hides no designs."""
    handles, _ = axes.get_legend_handles_labels()
    legend_below(figure, len(handles), handles)


def _panel(axes: Axes, found: BestToothSizes, across: str, up: str) -> None:
    """Draw designs as points over two named quantities, and markers for the best and the rule-based designs."""
    plain(axes)
    order = sorted(found.tried, key=lambda each: _shown(each, across))
    x, y = ([_shown(each, name) for each in order] for name in (across, up))
    single = len(found.free) == 1 and across in found.free
    axes.plot(x, y, color=GREY, linewidth=1.2 if single else 0, marker=".", markersize=3, gid="tried")
    designs = (found.equal_depth, found.pitch_true, found.best)
    for each, (name, look) in zip(designs, _DESIGN_MARKS.items(), strict=True):
        if each is not None:
            at = _shown(each, across), _shown(each, up)
            axes.plot(*at, linewidth=0, label=name, gid=name, zorder=3, clip_on=False, **look)
    name_axes(axes, _LABELS[across], _LABELS[up])
    for name, limit in ((across, axes.set_xlim), (up, axes.set_ylim)):
        if name not in found.free and name != "jam":
            limit(*_span(found, name))


def _span(found: BestToothSizes, name: str) -> tuple[float, float]:
    """Return the axis limits of a quantity, which exclude designs with more than four times the best value."""
    values = sorted(_shown(each, name) for each in found.tried)
    marked = [_shown(each, name) for each in (found.equal_depth, found.pitch_true, *found.front) if each is not None]
    # designs far worse than the best would compress all other designs into a line
    low, high = min(values[0], *marked), max((*marked, min(values[-1], _WORST * max(values[0], 1e-12))))
    rim = _MARGIN * (high - low)
    return low - rim, high + rim


def _shown(design: ToothSizes, name: str) -> float:
    """Return a size or an objective of a design in the unit of its plot axis."""
    value = design.parameter(name) if name in ("radii", "window", "half_angle") else float(getattr(design, name))
    return _in_units(value, name)


def _in_units(value: float, name: str) -> float:
    if name in ("error", "half_angle"):
        return degrees(value)
    return 100 * value if name == "loss" else value
