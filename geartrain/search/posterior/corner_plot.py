"""Corner plot of the posterior of tooth counts: marginal probabilities of each wheel and joint probabilities of each
pair of wheels.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isclose
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    LETTER,
    PALE,
    RED,
    SCALE,
    SMALL,
    TEXT,
    Axes,
    Figure,
    Line2D,
    MaxNLocator,
    Patch,
    headed,
    legend_below,
    name_axes,
)
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.search.posterior.posterior_result import ToothCountPosterior


Chances = Mapping[int, float]
Pair = tuple[str, str]
Pairs = Mapping[Pair, Mapping[tuple[int, int], float]]
MOST = 9  # panels of more wheels would be too small to read
_CELL = 1.35  # side of a panel [inch]
_TICKS = 3  # maximum number of tick intervals
_FEW = 20  # maximum number of counts whose bars have separate outlines
_DASHES: Any = (0, (3, 2))


@dataclass(frozen=True, slots=True)
class CountProbabilities:
    """Probabilities of tooth counts that are drawn in a corner plot."""

    single: Mapping[str, Chances]
    """Posterior probability of each tooth count, keyed by wheel."""
    pairs: Pairs
    """Joint probability of each pair of tooth counts, keyed by pair of wheels in the order of `single`."""
    before: Mapping[str, Chances]
    """Prior probability of each tooth count, keyed by wheel."""
    declared: Mapping[str, int]
    """Declared tooth count of each wheel for which a tooth count is declared."""


def counts_figure(found: ToothCountPosterior, pairs: Pairs) -> Figure:
    """Draw a corner plot of uncertain tooth counts: posterior and prior of each wheel, and joint posterior of each pair
    of wheels.

    Parameters
    ----------
    found : ToothCountPosterior
        Posterior of the tooth counts.
    pairs : mapping
        Joint probability of each pair of tooth counts, keyed by pair of wheels in the order of declaration; see
        `joint_posterior`.

    Returns
    -------
    matplotlib.figure.Figure
        Figure with a panel for each wheel and each pair.

    Raises
    ------
    QuestionError
        If no combination satisfies the observations, or if the pairs contain no wheel or more than 9 wheels.

    Examples
    --------
    >>> from geartrain.train.declaration_files import read_declaration
    >>> from geartrain.search import infer_counts
    >>> found = infer_counts(read_declaration("planetary-24-18-60"), free={"s": (23, 24), "ring": (58, 60)})
    >>> figure = counts_figure(found, {("s", "ring"): {(24, 60): 1.0}})
    >>> figure.axes[-1].get_xlabel()
    'ring'
    """
    wheels = list(dict.fromkeys(wheel for pair in pairs for wheel in pair))
    if not all(found[wheel].probabilities for wheel in wheels):
        what = f"no combination of counts of '{found.name}' satisfies the observations, so there is nothing to draw"
        why = "the posterior probabilities of the counts are then undefined"
        raise QuestionError(Problem(what, why, "widen the tolerances or the ranges of counts"))
    if not 0 < len(wheels) <= MOST:
        why, fix = f"{len(wheels)} wheels do not fit on a page", f"give 1 to {MOST} wheels with their probabilities"
        raise QuestionError(Problem("the tooth counts cannot be drawn", why, fix))
    single, before, declared, spans = {}, {}, {}, {}
    for wheel in wheels:
        prior = found[wheel].uncertainty
        posterior = zip(prior.counts, map(float, found[wheel].probabilities), strict=True)
        single[wheel] = {count: probability for count, probability in posterior if probability}
        before[wheel] = dict(zip(prior.counts, map(float, prior.priors), strict=True))
        spans[wheel] = prior.counts[0], prior.counts[-1]
        if prior.declared is not None:
            declared[wheel] = prior.declared
    likely = CountProbabilities(single, pairs, before, declared)
    side = max(5.0, 0.9 + _CELL * len(wheels))
    figure = Figure(figsize=(side, side), layout="constrained")
    panels = figure.subplots(len(wheels), len(wheels), squeeze=False)
    for row, down in enumerate(wheels):
        for column, across in enumerate(wheels):
            axes = panels[row, column]
            if column > row:
                axes.set_axis_off()
                continue
            axes.tick_params(labelsize=SMALL, labelleft=column == 0 and row > 0, labelbottom=row == len(wheels) - 1)
            _ticks(axes.xaxis, spans[across])
            if row == column:
                _marginal_panel(axes, likely, across, spans[across])
            else:
                _joint_panel(axes, likely, (across, down), spans)
            axes.set_xlim(spans[across][0] - 0.5, spans[across][1] + 0.5)
        name_axes(panels[-1, row], down, parse_math=False)
        if row:
            name_axes(panels[row, 0], y=down, parse_math=False)
    handles: list[Any] = [Patch(color=BLUE, label="posterior"), Patch(fill=False, edgecolor=GREY, label="prior")]
    if declared:
        handles.append(Line2D([], [], color=RED, linewidth=1.2, linestyle=_DASHES, label="declared"))
    legend_below(figure, 3, handles)
    title = f"{found.name}: counts that give {', '.join(witness.name for witness in found.witnesses)}"
    headed(figure, fill(title, max(int((side - 0.2) / (TEXT * LETTER)), 20)))
    return figure


def _marginal_panel(axes: Axes, likely: CountProbabilities, wheel: str, span: tuple[int, int]) -> None:
    """Draw the posterior probabilities of the tooth counts of one wheel as bars, and their prior probabilities as
    outlines of bars.
    """
    probabilities = likely.single[wheel]
    wide = 0.86 if span[1] - span[0] < _FEW else 1.0  # a narrow gap would be less than a pixel
    axes.bar(list(probabilities), list(probabilities.values()), width=wide, color=BLUE, linewidth=0, gid=f"{wheel}")
    before = likely.before[wheel]
    _outline(axes, before)
    axes.set_ylim(0, 1.08 * max([*probabilities.values(), *before.values()]))
    axes.set_yticks([])
    axes.set_title(_modes(probabilities), fontsize=SMALL, color=BLACK, pad=3)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    if wheel in likely.declared:
        axes.axvline(likely.declared[wheel], color=RED, linewidth=1.2, linestyle=_DASHES)


def _outline(axes: Axes, probabilities: Chances) -> None:
    """Draw the outlines of bars. If there are many bars, draw only the line along their tops, because the vertical
    lines would merge.
    """
    if len(probabilities) <= _FEW:
        axes.bar(
            list(probabilities), list(probabilities.values()), width=0.86, fill=False, edgecolor=GREY, linewidth=1.0
        )
        return
    counts = np.arange(min(probabilities), max(probabilities) + 1)
    edges = np.append(counts, counts[-1] + 1) - 0.5
    axes.stairs([probabilities.get(int(count), 0.0) for count in counts], edges, color=GREY, linewidth=1.0)


def _joint_panel(axes: Axes, likely: CountProbabilities, pair: Pair, spans: Mapping[str, tuple[int, int]]) -> None:
    """Draw a square for each pair of tooth counts. A darker square has a higher probability."""
    (a, first), (b, second) = ((wheel, spans[wheel]) for wheel in pair)
    table = np.zeros((second[1] - second[0] + 1, first[1] - first[0] + 1))
    for (one, other), probability in likely.pairs[pair].items():
        table[other - second[0], one - first[0]] = probability
    edges = [np.arange(span[0], span[1] + 2) - 0.5 for span in (first, second)]
    # the colour scale needs two different ends, even if all probabilities are 0
    mesh = axes.pcolormesh(*edges, table, cmap=SCALE, vmin=0.0, vmax=max(float(table.max()), 1e-300), rasterized=True)
    mesh.set_gid(f"{a}, {b}")
    _ticks(axes.yaxis, second)
    axes.set_ylim(second[0] - 0.5, second[1] + 0.5)
    for wheel, line in ((a, axes.axvline), (b, axes.axhline)):
        if wheel in likely.declared:
            line(likely.declared[wheel], color=RED, linewidth=1.0, linestyle=_DASHES)
    for each in axes.spines.values():
        each.set_color(PALE)


def _ticks(axis: Any, span: tuple[int, int]) -> None:
    low, high = span
    found = MaxNLocator(nbins=_TICKS, steps=(1, 2, 3, 4, 5, 10), integer=True, min_n_ticks=1).tick_values(low, high)
    axis.set_ticks([int(tick) for tick in found if low <= tick <= high])


def _modes(probabilities: Chances) -> str:
    """Format the most probable tooth count with its probability, such as `64: 80 %`. If several tooth counts are
    equally probable, format their range, such as `49-52: 10 % each`.
    """
    largest = max(probabilities.values())
    modes = sorted(count for count, probability in probabilities.items() if isclose(probability, largest))
    percent, span = f"{100 * largest:.3g} %", modes[-1] - modes[0] + 1
    if len(modes) == 1:
        return f"{modes[0]}: {percent}"
    some = "" if len(modes) == span else f"{len(modes)} of "
    return f"{some}{modes[0]}-{modes[-1]}: {percent} each"
