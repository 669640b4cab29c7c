"""How an estimate settles as trials grow in number."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.plot.library import Axes, Figure
from geartrain.plot.parts import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SMALL, TEXT, WIDTH, plain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_LOOKS = ((BLUE, "-"), (RED, "--"), (GREEN, "-."), (PURPLE, ":"), (ORANGE, "-"), (BLACK, "--"))


@dataclass(frozen=True, slots=True)
class Settling:
    """An estimate after so many trials, and its 95 percent interval: arrays (n,).

    trials      rising, above 0
    value       the estimate, from `low` to `high`
    truth       what it should come to, where that is known
    """

    trials: Floats
    value: Floats
    low: Floats
    high: Floats
    truth: float | None = None


def convergence_figure(estimates: Mapping[str, Settling], unit: str = "probability") -> Figure:
    """Each estimate with its interval over the number of trials, and below how wide the interval is.

    The dotted lines show what is known, and a slope of -1/2. Raises `QuestionError` where there is nothing to draw.
    """
    if not estimates or any(each.trials.size == 0 or each.trials.min() <= 0 for each in estimates.values()):
        raise QuestionError(
            Problem("no convergence to draw", "no estimate after a number of trials", "give one, after 1 trial or more")
        )
    figure = Figure(figsize=(WIDTH, 6.0), dpi=100, layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    for axes in (above, below):
        plain(axes)
        axes.set_xscale("log")
    for at, (name, each) in enumerate(estimates.items()):
        color, dashes = _LOOKS[at % len(_LOOKS)]
        look = {"color": color, "linestyle": dashes, "linewidth": 1.6, "marker": "o", "markersize": 3.5}
        above.fill_between(each.trials, each.low, each.high, color=color, alpha=0.15, linewidth=0)
        above.plot(each.trials, each.value, label=name, gid=name, **look)
        if each.truth is not None:
            above.axhline(each.truth, color=color, linewidth=1.0, linestyle=":", gid=f"truth of {name}")
        width = (each.high - each.low) / 2
        seen = width > 0
        below.plot(each.trials[seen], width[seen], gid=f"width of {name}", **look)
    _slope(below, list(estimates.values()))
    above.set_ylabel(unit, fontsize=TEXT)
    below.set_ylabel("half width of the\n95 % interval", fontsize=TEXT)
    widths = np.concatenate([(each.high - each.low) / 2 for each in estimates.values()])
    if (widths > 0).any():
        below.set_ylim(widths[widths > 0].min() / 2, 2 * widths.max())
        below.set_yscale("log")
    below.set_xlabel("trials", fontsize=TEXT)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=4, fontsize=SMALL, frameon=False)
    return figure


def _slope(axes: Axes, estimates: list[Settling]) -> None:
    """A line that falls as the root of the number of trials."""
    trials = np.concatenate([each.trials for each in estimates])
    widths = np.concatenate([(each.high - each.low) / 2 for each in estimates])
    seen = widths > 0
    if not seen.any() or trials.min() == trials.max():
        return
    ends = np.array([trials.min(), trials.max()])
    level = float(np.exp(np.mean(np.log(widths[seen] * np.sqrt(trials[seen])))))
    axes.plot(ends, 0.6 * level / np.sqrt(ends), color=GREY, linewidth=1.0, linestyle=":", gid="slope")
    axes.annotate(
        "slope -1/2", (ends[1], 0.6 * level / np.sqrt(ends[1])), fontsize=SMALL, color=GREY, va="top", ha="right"
    )
