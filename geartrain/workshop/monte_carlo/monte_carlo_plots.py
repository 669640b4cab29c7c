"""Plots of Monte Carlo trials: pointer errors, probabilities of jams, and sensitivities.

`monte_carlo_figure` draws one picture of a result. Its plots take arrays of numbers: bands and histograms of errors, a
map of probabilities over two quantities, a tornado chart of variance shares, and the convergence of an estimate.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import shorten
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
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
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics import ProbabilityEstimate
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults


PICTURES = ("errors", "course", "convergence", "sobol", "pairs", "map")
PERCENTS = (2.5, 25.0, 50.0, 75.0, 97.5)
MOST = 20
LEVELS = (0.01, 0.1, 0.5)
Interval = tuple[float, float]
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
_BOUND = 0.01  # level of the bound at which its contour is drawn
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
        raise QuestionError(
            Problem(f"'{picture}' is not a kind of picture", "the kinds are predefined", f"use {', '.join(PICTURES)}")
        )
    times = "" if picture == "map" else f" {len(findings.trials.marks):,} times"
    return headed(_picture(findings, picture), f"{findings.trials.plan.name}, cut by hand{times}")


def _picture(findings: MonteCarloResult, picture: str) -> Figure:
    trials = findings.trials
    if picture == "errors":
        return errors_figure(trials)
    if picture == "course":
        return course_figure(findings.courses, trials.plan.driving_link)
    if picture == "convergence":
        return probability_convergence_figure(trials)
    if picture == "sobol":
        _require(findings.indices, "Sobol indices were not computed", "give --sobol")
        return indices_figure(findings.indices[0])
    if picture == "pairs":
        return pair_shares_figure(trials, trials.plan.outputs[0])
    return clearances_figure(findings.cleared)


def _require(what: Sequence[object], why: str, fix: str) -> None:
    if not what:
        raise QuestionError(Problem("there is nothing to draw", why, fix))


def errors_figure(trials: TrialResults) -> Figure:
    """Draw histograms of each pointer's error at random positions; of all trials if at most one trial can turn."""
    found = {each.name: np.degrees(each.kept) for each in trials.pointers}
    jammed = any(len(each.errors) <= 1 for each in trials.pointers)
    note = ", given by the pushing flanks of a train that jams" if jammed else ""
    return histogram_figure(found, f"at random positions{note}")


def course_figure(courses: Sequence[PointerErrorCourse], driving_link: str) -> Figure:
    """Draw bands of pointer errors along one turn of each evaluated pointer."""
    _require(courses, "the errors along a turn were computed for no pointer", "name the outputs to follow: --of NAME")
    return pointer_error_figure(
        {each.name: ErrorBands.of(each.turns, np.degrees(each.errors)) for each in courses}, driving_link
    )


def probability_convergence_figure(trials: TrialResults, event: str = "jam") -> Figure:
    """Draw the probability of an event in any pair over the number of trials."""
    return convergence_figure({"any pair": _trace_of(trials.convergence(event))}, f"probability of a {event}")


def _trace_of(steps: Sequence[tuple[int, ProbabilityEstimate]]) -> ConvergenceTrace:
    """Return the convergence steps of an estimate as arrays."""
    ends = np.array([share.interval for _, share in steps]).reshape(-1, 2)
    counts = np.array([float(count) for count, _ in steps])
    return ConvergenceTrace(counts, np.array([share.value for _, share in steps]), ends[:, 0], ends[:, 1])


def indices_figure(indices: SobolIndices) -> Figure:
    """Draw Sobol indices of one output, by wheel or by kind of error."""
    found = {
        each.name: VarianceShare(
            each.first.value, (each.first.low, each.first.high), each.total.value, (each.total.low, each.total.high)
        )
        for each in indices.indices
    }
    return tornado_figure(found, f"error of '{indices.output}' by {indices.by}: {indices.trials:,} base samples")


def pair_shares_figure(trials: TrialResults, output: str) -> Figure:
    """Draw the variance shares of one output by pair, from superposition; their sum is 1."""
    shares = trials.pointer(output).shares
    return tornado_figure(
        {name: VarianceShare(value) for name, value in shares.items()}, f"error of '{output}' by pair"
    )


def clearances_figure(cleared: Sequence[ClearanceCase], title: str = "", event: str = "jam") -> Figure:
    """Draw a map of the probability of an event over the clearance and the scale of the errors.

    Raises `QuestionError` unless there are two or more values of both.
    """
    clearances = sorted({each.clearance for each in cleared if each.clearance is not None})
    scales = sorted({each.scale for each in cleared})
    table = np.full((len(clearances), len(scales)), np.nan)  # missing combinations remain blank
    for each in cleared:
        if each.clearance is not None:
            table[clearances.index(each.clearance), scales.index(each.scale)] = each.events[event].value
    factors = bool(clearances) and clearances[0] >= 1
    across = "clearance factor" if factors else "fraction of the clearance window of each pair"
    return jam_map_figure(clearances, scales, table, axis_names=(across, "factor of the declared errors"), title=title)


# --------------------------------------------------------------------------------------------------- errors of pointers


@dataclass(frozen=True, slots=True)
class ErrorBands:
    """Ranges of the error that contain given shares of the trials, over turns of the input, as arrays (positions,)."""

    turns: Floats
    """Positions of the input [turn]."""
    minimum: Floats
    """Minimum error over the trials [deg]."""
    maximum: Floats
    """Maximum error over the trials [deg]."""
    percentiles: Floats
    """2.5, 25, 50, 75 and 97.5 % percentiles of the error, shape (5, positions) [deg]."""
    trials: int
    """Number of trials that can turn; trials that jam are excluded."""
    example: Floats | None = None
    """Error of one trial as an example [deg], or None."""

    @classmethod
    def of(cls, turns: ArrayLike, errors: ArrayLike) -> ErrorBands:
        """Return the bands of the errors of all trials [deg], shape (trials, positions); trials with NaN are excluded.

        Raises `QuestionError` if no trial is left, or if the numbers of positions and turns differ.
        """
        places, table = np.asarray(turns, dtype=float), np.atleast_2d(np.asarray(errors, dtype=float))
        table = table[np.isfinite(table).all(axis=1)]
        if table.shape[1:] != places.shape or not table.size:
            raise _no_errors(f"errors of shape {table.shape} at {places.size} positions")
        levels = np.percentile(table, PERCENTS, axis=0)
        return cls(places, table.min(axis=0), table.max(axis=0), levels, len(table), table[0])


def pointer_error_figure(pointers: Mapping[str, ErrorBands], driving_link: str = "the input") -> Figure:
    """Draw median, central 50 and 95 % ranges and extremes of each pointer's error over turns of the driving link.

    The thin dashed line is one trial. Raises `QuestionError` without a pointer to draw.
    """
    shown, left = _largest_spreads(pointers, lambda bands: float(np.ptp(bands.percentiles)))
    spans = {float(np.ptp(bands.turns)) for bands in shown.values()}
    figure, panels = _panels(shown, share=len(spans) <= 1)  # each over a turn of its own pointer
    for axes, (name, bands) in zip(panels, shown.items(), strict=True):
        low, lower, middle, upper, high = bands.percentiles
        for each in zip((bands.minimum, low, lower), (bands.maximum, high, upper), _SHADES, _SHARES, strict=True):
            _between(axes, bands.turns, *each)
        if bands.example is not None:
            axes.plot(
                bands.turns, bands.example, color=RED, linewidth=0.9, linestyle=_DASHES, label="one of them", gid="one"
            )
        axes.plot(bands.turns, middle, color=BLACK, linewidth=1.6, label="median", gid="median")
        axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
        name_axes(axes, y=f"{name}\nerror (deg)", parse_math=False)
        axes.set_xlim(bands.turns[0], bands.turns[-1])
    name_axes(panels[-1], f"turns of {driving_link}{left}", parse_math=False)
    legend_below(figure, 5, [*_bands_key(), *panels[0].get_legend_handles_labels()[0]], "left")
    return figure


def histogram_figure(errors: Mapping[str, ArrayLike], note: str = "") -> Figure:
    """Draw histograms of each pointer's error [deg], with lines at the percentiles 2.5, 25, 50, 75 and 97.5.

    errors   pointer -> its error in every trial; NaN, in trials that jam, is excluded
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
    """Return the pointers with the largest spread, in the given order, and a note on the others."""
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


def _between(axes: Axes, x: Floats, low: Floats, high: Floats, alpha: float, label: str) -> None:
    axes.fill_between(x, low, high, color=BLUE, alpha=alpha, linewidth=0, gid=label)


def _bands_key() -> list[Patch]:
    """Return legend patches in the visible shades, since each band is drawn over the wider ones."""
    through = np.cumprod([1 - shade for shade in _SHADES])
    return [
        Patch(color=BLUE, alpha=1 - float(left), linewidth=0, label=label)
        for left, label in zip(through, _SHARES, strict=True)
    ]


def _no_errors(why: str) -> QuestionError:
    return QuestionError(Problem("the errors cannot be drawn", why, "give trials that turn, and at least one pointer"))


# ------------------------------------------------------------------------------------------------- map of probabilities


def jam_map_figure(
    clearances: ArrayLike,
    sizes: ArrayLike,
    probabilities: ArrayLike,
    bound: ArrayLike | None = None,
    axis_names: tuple[str, str] = ("clearance factor", "pitch deviation (standard deviation, % of the pitch)"),
    title: str = "",
) -> Figure:
    """Draw the probability of a jam as a shaded map, with contour lines at 1, 10 and 50 %.

    clearances  ascending clearances, (n,); `sizes`: ascending sizes of the error, (m,)
    probabilities     probabilities of a jam, 0 to 1, (n, m); NaN for missing data
    bound       upper bound on the probability, (n, m); its 1 % contour is drawn
    axis_names  labels of clearances and sizes

    Raises `QuestionError` if the arrays do not form a map.
    """
    x, y, table = (np.asarray(each, dtype=float) for each in (clearances, sizes, probabilities))
    limit = None if bound is None else np.asarray(bound, dtype=float)
    _check(x, y, table, limit)
    figure = Figure(figsize=(WIDTH, 6.4), layout="constrained")
    axes = figure.add_subplot()
    shown = np.ma.masked_invalid(table.T)
    mesh = axes.pcolormesh(x, y, shown, shading="gouraud", cmap=SCALE, vmin=0.0, vmax=1.0, rasterized=True)
    mesh.set_gid("map")
    colour_bar(figure, axes, mesh, "probability of a jam", ticks=_JAM_TICKS, format=lambda tick, _: f"{tick:.0%}")
    handles = [_line(axes, x, y, shown, *each) for each in zip(LEVELS, _LEVEL_DASHES, strict=True)]
    if limit is not None:
        handles.append(_bound(axes, x, y, limit))
    legend_below(figure, 4, handles, "left", handlelength=4)
    name_axes(axes, *axis_names, title)
    return figure


def _line(axes: Axes, x: Floats, y: Floats, shown: Any, level: float, dashes: Any) -> Line2D:
    # probabilities rise from 0 to 1 within few cells; arcsin(sqrt(p)) is more linear there, so contours interpolate
    # well
    contour = axes.contour(x, y, _arcsine(shown), levels=[_arcsine(level)], colors=BLACK, linewidths=2.0)
    contour.set_linestyle([dashes])
    contour.set_gid(f"{level:.0%}")
    return Line2D([], [], color=BLACK, linestyle=dashes, linewidth=2.0, label=f"{level:.0%}")


def _bound(axes: Axes, x: Floats, y: Floats, limit: Floats) -> Line2D:
    """Draw the contour of the upper bound at 1 %; below it the bound proves that jams are rare."""
    color = ORANGE
    # a bound of 0 has no logarithm, so it is clipped far below the contour
    rare = np.log10(np.clip(np.ma.masked_invalid(limit.T), 1e-9, 1.0))
    contour = axes.contour(x, y, rare, levels=[np.log10(_BOUND)], colors=color, linewidths=2.0)
    contour.set_linestyle(["dashdot"])
    contour.set_gid("bound")
    return Line2D([], [], color=color, linestyle="dashdot", linewidth=2.0, label=f"bound of {_BOUND:.0%}")


def _arcsine(probability: Any) -> Any:
    return np.arcsin(np.sqrt(probability))


def _check(x: Floats, y: Floats, table: Floats, limit: Floats | None) -> None:
    finite = table[np.isfinite(table)]
    rising = all(each.ndim == 1 and each.size > 1 and (np.diff(each) > 0).all() for each in (x, y))
    shaped = table.shape == (x.size, y.size) and (limit is None or limit.shape == table.shape)
    if not (rising and shaped and finite.size and finite.min() >= 0 and finite.max() <= 1):
        raise QuestionError(
            Problem(
                f"the arrays do not form a map: clearances {x.shape}, sizes {y.shape}, probabilities {table.shape}",
                "a map needs at least two ascending values on each axis, and a probability from 0 to 1 for each pair",
                "give arrays of shapes (n,), (m,) and (n, m)",
            )
        )


# -------------------------------------------------------------------------------------------------------- tornado chart


@dataclass(frozen=True, slots=True)
class VarianceShare:
    """Share of the variance of a result that is due to one cause, 0 to 1."""

    own: float
    """First-order share, of the cause by itself; `own_within` is its interval, or None."""
    own_within: Interval | None = None
    whole: float | None = None
    """Total share including all interactions, with its interval `whole_within`; None for causes without
    interactions.
    """
    whole_within: Interval | None = None

    @property
    def rank(self) -> float:
        """Share by which the bars are sorted: total if known, otherwise first order."""
        return self.own if self.whole is None else self.whole


def tornado_figure(shares: Mapping[str, VarianceShare], title: str = "", most: int = MOST) -> Figure:
    """Draw a tornado chart: for each cause a bar of its first-order and total share, with intervals as whiskers.

    Only the `most` largest causes are drawn, and the axis label gives the number of the others. Raises `QuestionError`
    without a cause.
    """
    if not shares:
        what, why = "the list of causes is empty", "a tornado chart needs at least one cause"
        raise QuestionError(Problem(what, why, "give the share of at least one cause"))
    if most < 1:
        raise QuestionError(Problem(f"most is {most}", "a tornado chart shows at least one cause", "give most >= 1"))
    ranked = sorted(shares.items(), key=lambda each: -each[1].rank)
    shown, rest = ranked[:most], ranked[most:]
    figure, axes = bar_panel([name for name, _ in shown], 1.6 + 0.34 * len(shown))
    for at, (_, share) in enumerate(shown):
        if share.whole is not None:
            axes.barh(at, share.whole, color=SKY, height=0.72, gid="whole")
            draw_interval(axes, at + 0.18, share.whole_within)
        axes.barh(at, share.own, color=BLUE, height=0.36, gid="own")
        draw_interval(axes, at - 0.08, share.own_within)
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    name_axes(axes, f"share of the variance{_omitted(rest)}", title=title, parse_math=False)
    if any(share.whole is not None for _, share in shown):
        handles = [Patch(color=BLUE, label="first order"), Patch(color=SKY, label="total, with interactions")]
        axes.legend(handles=handles, loc="lower right", fontsize=SMALL, frameon=False)
    return figure


def _omitted(rest: list[tuple[str, VarianceShare]]) -> str:
    if not rest:
        return ""
    return f"; {len(rest)} more causes of at most {max(share.rank for _, share in rest):.2g} are not drawn"


# ---------------------------------------------------------------------------------------------------------- convergence


@dataclass(frozen=True, slots=True)
class ConvergenceTrace:
    """Estimate as a function of the number of trials, with its 95 % confidence interval, as arrays (n,)."""

    trials: Floats
    """Numbers of trials in ascending order, above 0."""
    value: Floats
    """Estimates; `low` and `high` are the limits of the interval."""
    low: Floats
    high: Floats
    truth: float | None = None
    """True value, if it is known."""


def convergence_figure(estimates: Mapping[str, ConvergenceTrace], unit: str = "probability") -> Figure:
    """Draw each estimate with its interval over the number of trials, and below it the half width of the interval.

    Dotted lines show known true values and a slope of -1/2. Raises `QuestionError` if there is nothing to draw.
    """
    if not estimates or any(each.trials.size == 0 or each.trials.min() <= 0 for each in estimates.values()):
        raise QuestionError(
            Problem(
                "the convergence cannot be drawn",
                "the list of estimates is empty, or an estimate has no trial numbers or one that is not positive",
                "give at least one estimate, with trial numbers of 1 or more",
            )
        )
    figure, (above, below) = curve_panels((3.6, 2.4))
    below.set_xscale("log")
    for at, (name, each) in enumerate(estimates.items()):
        look = {**series_look(at), "linewidth": 1.6, "marker": "o", "markersize": 3.5}
        above.fill_between(each.trials, each.low, each.high, color=series_colour(at), alpha=0.15, linewidth=0)
        above.plot(each.trials, each.value, label=name, gid=name, **look)
        if each.truth is not None:
            above.axhline(each.truth, color=series_colour(at), linewidth=1.0, linestyle=":", gid=f"truth of {name}")
        width = (each.high - each.low) / 2
        seen = width > 0
        below.plot(each.trials[seen], width[seen], gid=f"width of {name}", **look)
    _slope(below, list(estimates.values()))
    name_axes(above, y=unit)
    name_axes(below, "trials", "half width of the\n95 % interval")
    widths = np.concatenate([(each.high - each.low) / 2 for each in estimates.values()])
    if (widths > 0).any():
        below.set_ylim(widths[widths > 0].min() / 2, 2 * widths.max())
        below.set_yscale("log")
    # every n-th number of trials from the last one down, so that the full number is labelled
    counts = sorted({float(count) for each in estimates.values() for count in each.trials})
    below.set_xticks(counts[-1 :: -max(len(counts) // _TICKS, 1)][::-1], minor=False)
    below.set_xticks([], minor=True)
    below.xaxis.set_major_formatter(lambda count, _: f"{count:,.0f}")
    legend_below(figure, 4, side="left")
    return figure


def _slope(axes: Axes, estimates: list[ConvergenceTrace]) -> None:
    """Draw a reference line proportional to the inverse square root of the number of trials."""
    trials = np.concatenate([each.trials for each in estimates])
    widths = np.concatenate([(each.high - each.low) / 2 for each in estimates])
    seen = widths > 0
    if not seen.any() or trials.min() == trials.max():
        return
    ends = np.array([trials.min(), trials.max()])
    level = float(np.exp(np.mean(np.log(widths[seen] * np.sqrt(trials[seen])))))
    axes.plot(ends, 0.6 * level / np.sqrt(ends), color=GREY, linewidth=1.0, linestyle=":", gid="slope")
    axes.annotate(
        "slope -1/2",
        (ends[0], 0.6 * level / np.sqrt(ends[0])),
        xytext=(0, -6),
        textcoords="offset points",
        fontsize=SMALL,
        color=GREY,
        va="top",
        ha="left",
    )
