"""Plots of Monte Carlo trials: pointer errors, probabilities of jams, and sensitivities.

`monte_carlo_figure` draws one picture of a result: bands and histograms of errors, a map of probabilities over two
quantities, a tornado chart of variance shares, or the convergence of an estimate.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from textwrap import shorten
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    RED,
    SCALE,
    SKY,
    SMALL,
    WIDTH,
    Axes,
    Figure,
    Line2D,
    MaxNLocator,
    Patch,
    bar_panel,
    colour_bar,
    curve_panels,
    draw_interval,
    headed,
    legend_above,
    legend_below,
    name_axes,
    series_look,
)
from geartrain.errors import Problem, QuestionError
from geartrain.numerics import IntervalEstimate
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics import ProbabilityEstimate
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse


PICTURES = ("errors", "course", "convergence", "sobol", "pairs", "map")
PERCENTS = (2.5, 25.0, 50.0, 75.0, 97.5)  # percentiles at the edges of bands
MOST = 20  # maximum number of bars of a tornado chart
LEVELS = (0.01, 0.1, 0.5)  # probabilities of the contour lines of a map
_Given = TypeVar("_Given")
_ROW = 2.3  # height of a panel [inch]
_POINTERS = 12  # maximum number of pointers drawn: those with the largest spread
_SHARES = ("every trial", "95 % of the trials", "50 %")  # of the trials in a band
_SHADES = (0.12, 0.22, 0.26)  # opacities of the bands, which are drawn over each other
_DASHES: Any = (0, (4, 1.2))
_STILL = 90  # maximum characters for the names of pointers without error
_BINS = (12, 60)  # minimum and maximum number of bins of a histogram
_LEVEL_DASHES: tuple[Any, ...] = ((0, (1.2, 1.2)), (0, (5, 2)), "solid")
_JAM_TICKS = (0.0, 0.1, 0.5, 1.0)
_TICKS = 8  # approximate number of tick labels: more would overlap


def monte_carlo_figure(findings: MonteCarloResult, picture: str = "errors") -> Figure:
    """Draw one figure of the Monte Carlo trials of a train with cutting errors.

    Parameters
    ----------
    findings : MonteCarloResult
        Trials, with the study that the figure shows.
    picture : {"errors", "course", "convergence", "sobol", "pairs", "map"}
        "errors": histogram of each pointer's error at random positions of the input. "course": bands of the pointer
        errors along one revolution, for each output that was computed. "convergence": probability of a jam against the
        number of trials. "sobol": Sobol indices of the first output by wheel, or by kind of error if only these were
        computed. "pairs": variance shares by pair, from superposition. "map": probability of a jam against clearance
        and scale of the errors.

    Returns
    -------
    matplotlib.figure.Figure
        Figure with errors in degrees, and probabilities with their 95 % confidence intervals.

    Raises
    ------
    QuestionError
        If the study that the figure shows was not computed.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import (MonteCarloResult, find_trial_plan, read_error_overrides, run_trials)
    >>> errors = read_error_overrides(["pitch_deviation=2 %"])
    >>> plan = find_trial_plan(geartrain.load("moon-triangular"), errors, ("moon",))
    >>> found = MonteCarloResult(run_trials(plan, trials=2, seed=1))
    >>> monte_carlo_figure(found, "convergence").axes[0].get_ylabel()
    'probability of a jam'
    """
    if picture not in PICTURES:
        what = f"'{picture}' is not a kind of picture"
        raise QuestionError(Problem(what, "the kind selects the study to draw", f"use one of {', '.join(PICTURES)}"))
    times = "" if picture == "map" else f" {len(findings.trials.marks):,} times"
    return headed(_picture(findings, picture), f"{findings.trials.plan.name}, cut by hand{times}")


def _picture(findings: MonteCarloResult, picture: str) -> Figure:
    trials = findings.trials
    if picture == "errors":
        jammed = any(len(each.errors) <= 1 for each in trials.pointers)
        note = ", given by the pushing flanks of a train that jams" if jammed else ""
        errors = {each.name: np.degrees(each.kept) for each in trials.pointers}
        return histogram_figure(errors, f"at random positions{note}")
    if picture == "course":
        why = "no pointer errors along a turn were computed"
        _require(findings.courses, why, "name the outputs to follow: --of NAME")
        return course_figure(findings.courses, trials.plan.driving_link)
    if picture == "convergence":
        return convergence_figure(trials.convergence())
    if picture == "sobol":
        _require(findings.indices, "Sobol indices were not computed", "give --sobol")
        found = findings.indices[0]
        indices = {each.name: (each.first, each.total) for each in found.indices}
        return tornado_figure(indices, f"error of '{found.output}' by {found.by}: {found.trials:,} base samples")
    if picture == "pairs":
        first = trials.pointers[0]
        why = f"variance shares need two trials that turn, and errors of '{first.name}' that differ"
        _require(first.shares, why, "give more --trials, smaller errors (--cutting), or another output (--of)")
        shares = {name: (IntervalEstimate(value, value, value),) for name, value in first.shares.items()}
        return tornado_figure(shares, f"error of '{first.name}' by pair")
    return _jam_map(findings.cleared)


def _require(what: Collection[object], why: str, fix: str) -> None:
    if not what:
        raise QuestionError(Problem("there is nothing to draw", why, fix))


def _jam_map(cleared: Sequence[ClearanceCase]) -> Figure:
    """Draw a map of the probability of a jam over the clearance and the factor of the errors."""
    clearances = sorted({each.clearance for each in cleared if each.clearance is not None})
    scales = sorted({each.scale for each in cleared})
    table = np.full((len(clearances), len(scales)), np.nan)  # missing combinations remain blank
    for each in cleared:
        if each.clearance is not None:
            table[clearances.index(each.clearance), scales.index(each.scale)] = each.events["jam"].value
    return jam_map_figure(clearances, scales, table)


# --------------------------------------------------------------------------------------------------- errors of pointers


def course_figure(courses: Sequence[PointerErrorCourse], driving_link: str = "the input") -> Figure:
    """Draw median, central 50 and 95 % ranges and extremes of each pointer's error over turns of the driving link.

    The thin dashed line is one trial; trials without a finite error at every position are excluded. Raises
    `QuestionError` without a pointer to draw.
    """
    given = {each.name: each for each in courses}
    errors = {name: np.degrees(each.errors[np.isfinite(each.errors).all(axis=1)]) for name, each in given.items()}
    bands = {name: _bands(each) for name, each in errors.items()}
    shown, left = _largest_spreads(bands, lambda levels: float(np.ptp(levels[1:-1])))
    spans = {float(np.ptp(given[name].turns)) for name in shown}
    figure, panels = _panels(shown, share=len(spans) <= 1)  # each over a turn of its own pointer
    for axes, (name, levels) in zip(panels, shown.items(), strict=True):
        turns = given[name].turns
        for at, (alpha, share) in enumerate(zip(_SHADES, _SHARES, strict=True)):
            axes.fill_between(turns, levels[at], levels[-1 - at], color=BLUE, alpha=alpha, linewidth=0, gid=share)
        axes.plot(turns, errors[name][0], color=RED, linewidth=0.9, linestyle=_DASHES, label="one of them", gid="one")
        axes.plot(turns, levels[3], color=BLACK, linewidth=1.6, label="median", gid="median")
        axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
        name_axes(axes, y=f"{name}\nerror (deg)", parse_math=False)
        axes.set_xlim(turns[0], turns[-1])
    name_axes(panels[-1], f"turns of {driving_link}{left}", parse_math=False)
    legend_below(figure, 5, [*_bands_key(), *panels[0].get_legend_handles_labels()[0]], "left")
    return figure


def _bands(errors: Floats) -> Floats:
    """Return minimum, `PERCENTS` and maximum over the trials, shape (7, positions)."""
    if not errors.size:
        raise _no_errors("a pointer cannot turn in any trial")
    found: Floats = np.percentile(errors, (0, *PERCENTS, 100), axis=0)
    return found


def histogram_figure(errors: Mapping[str, ArrayLike], note: str = "") -> Figure:
    """Draw histograms of each pointer's error [deg], with lines at the percentiles 2.5, 25, 50, 75 and 97.5.

    errors   error in every trial, by pointer; NaN values, from trials that jam, are excluded
    note     text under the last panel, such as the range of positions
    Raises `QuestionError` if there is nothing to draw.
    """
    shown, left = _largest_spreads(errors, _spread)
    figure, panels = _panels(shown)
    for axes, (name, given) in zip(panels, shown.items(), strict=True):
        values = np.asarray(given, dtype=float).ravel()
        values = values[np.isfinite(values)]
        if not values.size:
            raise _no_errors(f"'{name}' cannot turn in any trial")
        axes.hist(values, bins=_edges(values).tolist(), color=BLUE, alpha=0.45, edgecolor="white", linewidth=0.4)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=(1, 2, 5, 10), integer=True))
        _percentiles(axes, values)
        name_axes(axes, y=f"{name}\ntrials of {values.size:,}", parse_math=False)
    name_axes(panels[-1], f"error (deg){'; ' if note else ''}{note}{left}", parse_math=False)
    return figure


def _largest_spreads(what: Mapping[str, _Given], spread: Callable[[_Given], float]) -> tuple[dict[str, _Given], str]:
    """Return the pointers with the largest spread, in the given order, and a note on the omitted pointers."""
    straying = [name for name in what if spread(what[name]) > 0] or list(what)
    names = set(sorted(straying, key=lambda name: -spread(what[name]))[:_POINTERS])
    left, still = len(straying) - len(names), [name for name in what if name not in straying]
    words = f"\n{left} pointers with smaller errors are not drawn: name them with --of" if left else ""
    if still:
        words += f"\nno error: {shorten(', '.join(still), _STILL, placeholder=' ...')}"
    return {name: each for name, each in what.items() if name in names}, words


def _spread(given: ArrayLike) -> float:
    """Return the range (maximum minus minimum) of the finite values; 0 without values."""
    values = np.asarray(given, dtype=float)
    values = values[np.isfinite(values)]
    return float(np.ptp(values)) if values.size else 0.0


def _percentiles(axes: Axes, values: Floats) -> None:
    low, lower, middle, upper, high = np.percentile(values, PERCENTS)
    axes.axvline(middle, color=BLACK, linewidth=1.8, label=f"median {middle:.3g}", gid="median")
    for ends, style, share in (((lower, upper), (0, (6, 2)), 50), ((low, high), (0, (2, 1.5)), 95)):
        words = f"{share} %: {ends[0]:.3g} to {ends[1]:.3g}"
        for at, end in enumerate(ends):
            axes.axvline(end, color=RED, linewidth=1.5, linestyle=style, label=None if at else words, gid=f"{share} %")
    legend_above(axes, 3)


def _edges(values: Floats) -> Floats:
    """Return bin edges by the Freedman-Diaconis rule (width 2 IQR / n^(1/3)), with a limited number of bins."""
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-12 * max(abs(low), abs(high)):  # bins narrower than rounding errors would be meaningless
        half = max(abs(low), 1e-9) * 0.1
        return np.linspace(low - half, high + half, _BINS[0] + 1)
    middle = float(np.subtract(*np.percentile(values, (75, 25))))
    width = 2 * middle / values.size ** (1 / 3)
    # the interquartile range is 0 if at least half of the values are equal
    bins = _BINS[1] if width <= 0 else int(np.clip((high - low) / width, *_BINS))
    return np.linspace(low, high, bins + 1)


def _panels(what: Mapping[str, Any], share: bool = False) -> tuple[Figure, list[Axes]]:
    if not what:
        raise _no_errors("no pointer is given")
    return curve_panels([_ROW] * len(what), 1.3, share)


def _bands_key() -> list[Patch]:
    """Return legend patches in the visible shades of the bands, since each band is drawn over the wider ones."""
    through = np.cumprod([1 - shade for shade in _SHADES])
    return [
        Patch(color=BLUE, alpha=1 - float(left), linewidth=0, label=label)
        for left, label in zip(through, _SHARES, strict=True)
    ]


def _no_errors(why: str) -> QuestionError:
    return QuestionError(Problem("the errors cannot be drawn", why, "give trials that turn, and at least one pointer"))


# ------------------------------------------------------------------------------------------------- map of probabilities


def jam_map_figure(clearances: ArrayLike, scales: ArrayLike, probabilities: ArrayLike) -> Figure:
    """Draw the probability of a jam as a shaded map, with contour lines at 1, 10 and 50 %.

    clearances     ascending clearance factors, or fractions of clearance windows, (n,)
    scales         ascending factors of the errors, (m,)
    probabilities  probabilities of a jam, 0 to 1, (n, m); NaN for missing data

    Raises `QuestionError` if the arrays do not form a map.
    """
    x, y, table = (np.asarray(each, dtype=float) for each in (clearances, scales, probabilities))
    _check(x, y, table)
    figure = Figure(figsize=(WIDTH, 6.4), layout="constrained")
    axes = figure.add_subplot()
    shown = np.ma.masked_invalid(table.T)
    mesh = axes.pcolormesh(x, y, shown, shading="gouraud", cmap=SCALE, vmin=0.0, vmax=1.0, rasterized=True)
    mesh.set_gid("map")
    colour_bar(figure, axes, mesh, "probability of a jam", ticks=_JAM_TICKS, format=lambda tick, _: f"{tick:.0%}")
    handles = [_line(axes, x, y, shown, *each) for each in zip(LEVELS, _LEVEL_DASHES, strict=True)]
    legend_below(figure, 4, handles, "left", handlelength=4)
    across = "clearance factor" if x[0] >= 1 else "fraction of the clearance window of each pair"
    name_axes(axes, across, "factor of the declared errors")
    return figure


def _line(axes: Axes, x: Floats, y: Floats, shown: Any, level: float, dashes: Any) -> Line2D:
    # probabilities rise from 0 to 1 within few cells; arcsin(sqrt(p)) is more linear there, so contours interpolate
    # well
    contour = axes.contour(x, y, _arcsine(shown), levels=[_arcsine(level)], colors=BLACK, linewidths=2.0)
    contour.set_linestyle([dashes])
    contour.set_gid(f"{level:.0%}")
    return Line2D([], [], color=BLACK, linestyle=dashes, linewidth=2.0, label=f"{level:.0%}")


def _arcsine(probability: Any) -> Any:
    return np.arcsin(np.sqrt(probability))


def _check(x: Floats, y: Floats, table: Floats) -> None:
    finite = table[np.isfinite(table)]
    rising = all(each.ndim == 1 and each.size > 1 and (np.diff(each) > 0).all() for each in (x, y))
    if not (rising and table.shape == (x.size, y.size) and finite.size and finite.min() >= 0 and finite.max() <= 1):
        what = f"the arrays do not form a map: clearances {x.shape}, scales {y.shape}, probabilities {table.shape}"
        why = "a map has at least two ascending values on each axis, and probabilities from 0 to 1 (or NaN)"
        raise QuestionError(
            Problem(what, why, "give ascending arrays of shapes (n,) and (m,), and probabilities of shape (n, m)")
        )


# -------------------------------------------------------------------------------------------------------- tornado chart


def tornado_figure(shares: Mapping[str, Sequence[IntervalEstimate]], title: str = "") -> Figure:
    """Draw a tornado chart: for each cause a bar of its first-order and total share, with intervals as whiskers.

    Only the `MOST` largest causes are drawn, and the axis label gives the number of omitted causes. Raises
    `QuestionError` without a cause.

    shares   first-order share of the variance by cause, and the total share with all interactions if it is known
    """
    if not shares:
        what, why = "the list of causes is empty", "a tornado chart needs at least one cause"
        raise QuestionError(Problem(what, why, "give the share of at least one cause"))
    ranked = sorted(shares.items(), key=lambda each: -each[1][-1].value)
    shown, rest = ranked[:MOST], ranked[MOST:]
    figure, axes = bar_panel([name for name, _ in shown], 1.6 + 0.34 * len(shown))
    for at, (_, (own, *whole)) in enumerate(shown):
        for total in whole:
            axes.barh(at, total.value, color=SKY, height=0.72, gid="whole")
            _whisker(axes, at + 0.18, total)
        axes.barh(at, own.value, color=BLUE, height=0.36, gid="own")
        _whisker(axes, at - 0.08, own)
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    more = f"; {len(rest)} more causes of at most {rest[0][1][-1].value:.2g} are not drawn" if rest else ""
    name_axes(axes, f"share of the variance{more}", title=title, parse_math=False)
    if any(len(share) > 1 for _, share in shown):
        handles = [Patch(color=BLUE, label="first order"), Patch(color=SKY, label="total, with interactions")]
        axes.legend(handles=handles, loc="lower right", fontsize=SMALL, frameon=False)
    return figure


def _whisker(axes: Axes, at: float, share: IntervalEstimate) -> None:
    draw_interval(axes, at, (share.low, share.high) if share.low < share.high else None)


# ---------------------------------------------------------------------------------------------------------- convergence


def convergence_figure(steps: Sequence[tuple[int, ProbabilityEstimate]]) -> Figure:
    """Draw the probability of a jam in any pair with its interval over the number of trials, and below it the half
    width of the interval.

    A dotted line shows a slope of -1/2. Raises `QuestionError` without trials.

    steps   ascending numbers of trials with their estimates
    """
    _require(steps, "no trial is completed", "give at least one trial")
    counts = np.array([float(count) for count, _ in steps])
    low, high = np.array([share.interval for _, share in steps]).T
    width = (high - low) / 2
    figure, (above, below) = curve_panels((3.6, 2.4))
    below.set_xscale("log")
    look = {**series_look(0), "linewidth": 1.6, "marker": "o", "markersize": 3.5}
    above.fill_between(counts, low, high, color=series_colour(0), alpha=0.15, linewidth=0)
    above.plot(counts, [share.value for _, share in steps], label="any pair", gid="any pair", **look)
    below.plot(counts, width, gid="width of any pair", **look)
    if len(counts) > 1:
        _slope(below, counts, width)
    name_axes(above, y="probability of a jam")
    name_axes(below, "trials", "half width of the\n95 % interval")
    below.set_ylim(width.min() / 2, 2 * width.max())
    below.set_yscale("log")
    # every n-th number of trials from the last one down, so that the full number is labelled
    below.set_xticks(counts[-1 :: -max(len(counts) // _TICKS, 1)][::-1], minor=False)
    below.set_xticks([], minor=True)
    below.xaxis.set_major_formatter(lambda count, _: f"{count:,.0f}")
    legend_below(figure, 4, side="left")
    return figure


def _slope(axes: Axes, trials: Floats, widths: Floats) -> None:
    """Draw a reference line proportional to the inverse square root of the number of trials."""
    ends = trials[[0, -1]]
    # geometric mean fit, lowered by 0.6 so that the line does not cover the points
    line = 0.6 * np.exp(np.mean(np.log(widths * np.sqrt(trials)))) / np.sqrt(ends)
    axes.plot(ends, line, color=GREY, linewidth=1.0, linestyle=":", gid="slope")
    beside: dict[str, Any] = {
        "xytext": (0, -6),
        "textcoords": "offset points",
        "fontsize": SMALL,
        "color": GREY,
        "va": "top",
    }
    axes.annotate("slope -1/2", (ends[0], line[0]), ha="left", **beside)
