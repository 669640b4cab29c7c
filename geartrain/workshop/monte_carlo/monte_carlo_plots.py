"""Plots of Monte Carlo trials: pointer errors, jam probabilities, variance shares and convergence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Sized
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    DOT,
    GREY,
    MOST_ROWS,
    RED,
    SCALE,
    WIDTH,
    Figure,
    Line2D,
    Patch,
    Row,
    colour_bar,
    curve_panels,
    figures,
    headed,
    interval_chart,
    legend_below,
    name_axes,
    series_look,
)
from geartrain.errors import Problem, QuestionError
from geartrain.numerics import IntervalEstimate

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics import ProbabilityEstimate
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults


PICTURES = ("errors", "course", "convergence", "sobol", "pairs", "map")
PERCENTS = (2.5, 25.0, 50.0, 75.0, 97.5)  # percentiles at the edges of bands
LEVELS = (0.01, 0.1, 0.5)  # probabilities of the contour lines of a map
_ROW = 2.3  # height of a panel [inch]
_COURSES = 4  # maximum number of pointers with bands on one page: those with the largest spread
_SHARE_LOOKS: dict[str, Mapping[str, Any]] = {
    "first order": DOT,
    "total, with interactions": {"marker": "o", "markersize": 10, "color": BLUE, "markerfacecolor": "none"},
}
_TURNING = "give trials in which the pointer turns: larger clearances, or smaller errors (--cutting)"
_SHARES = ("every trial", "95 % of the trials", "50 %")  # of the trials in a band
_SHADES = (0.12, 0.22, 0.26)  # opacities of the bands, which are drawn over each other
_DASHES: Any = (0, (4, 1.2))
_LEVEL_DASHES: tuple[Any, ...] = ((0, (1.2, 1.2)), (0, (5, 2)), "solid")
_JAM_TICKS = (0.0, 0.1, 0.5, 1.0)
_TICKS = 8  # approximate number of tick labels: more would overlap


def monte_carlo_figure(findings: MonteCarloResult, picture: str = "errors") -> Figure:
    """Draw the figure of the given kind for the Monte Carlo trials of a train with cutting errors."""
    if picture not in PICTURES:
        what = f"'{picture}' is not a kind of picture"
        raise QuestionError(Problem(what, "the kind selects the study to draw", f"use one of {', '.join(PICTURES)}"))
    times = "" if picture == "map" else f" {len(findings.trials.marks):,} times"
    return headed(_picture(findings, picture), f"{findings.trials.plan.name}, cut by hand{times}")


def _picture(findings: MonteCarloResult, picture: str) -> Figure:
    trials = findings.trials
    if picture == "errors":
        return error_figure(trials)
    if picture == "course":
        return course_figure(findings.courses, trials.plan.driving_link)
    if picture == "convergence":
        return convergence_figure(trials.convergence())
    if picture == "sobol":
        _require(findings.indices, "Sobol indices were not computed", "give --sobol")
        found = findings.indices[0]
        indices = {each.name: (each.first, each.total) for each in found.indices}
        return share_figure(indices, f"error of '{found.output}' by {found.by}: {found.trials:,} base samples")
    if picture == "pairs":
        first = trials.pointers[0]
        why = f"variance shares need two trials in which the train turns, and errors of '{first.name}' that differ"
        _require(first.shares, why, "give more --trials, smaller errors (--cutting), or another output (--of)")
        shares = {name: (IntervalEstimate(value, value, value),) for name, value in first.shares.items()}
        return share_figure(shares, f"error of '{first.name}' by pair")
    return _jam_map(findings.cleared)


def _require(drawn: Sized, why: str, fix: str) -> None:
    if not len(drawn):
        raise QuestionError(Problem("there is nothing to draw", why, fix))


def _jam_map(cleared: Sequence[ClearanceCase]) -> Figure:
    """Draw a map of the jam probability as a function of clearance factor and scale factor, from the given cases.

    The clearance factor is the centre distance divided by its minimum, at which tips touch roots. The scale factor
    multiplies all manufacturing errors.
    """
    clearances = sorted({each.clearance for each in cleared if each.clearance is not None})
    scales = sorted({each.scale for each in cleared})
    several = cleared if len(clearances) > 1 < len(scales) else ()
    _require(several, "a map has at least two clearances and two scales of errors", "give --vary with a COUNT above 1")
    table = np.full((len(clearances), len(scales)), np.nan)  # missing combinations remain blank
    for each in cleared:
        if each.clearance is not None:
            table[clearances.index(each.clearance), scales.index(each.scale)] = each.events["jam"].value
    return jam_map_figure(clearances, scales, table)


# --------------------------------------------------------------------------------------------------- errors of pointers


def course_figure(courses: Sequence[PointerErrorCourse], driving_link: str = "the input") -> Figure:
    """Draw median, central 50 and 95 % ranges and extremes of each pointer's error over turns of the driving link.

    The thin dashed line shows one trial. Trials in which an error is not finite are excluded. Raises `QuestionError` if
    there is no pointer to draw.
    """
    _require(courses, "no pointer errors along a turn were computed", "name the outputs to follow: --of NAME")
    given = {each.name: each for each in courses}
    errors = {name: np.degrees(each.errors[np.isfinite(each.errors).all(axis=1)]) for name, each in given.items()}
    bands = {name: _bands(name, each) for name, each in errors.items()}
    spread = {name: float(np.ptp(levels[1:-1])) for name, levels in bands.items()}
    largest = sorted(bands, key=lambda name: -spread[name])[:_COURSES]
    shown = {name: levels for name, levels in bands.items() if name in largest}
    left = len(bands) - len(shown)
    omitted = f"\n{left} pointers with smaller errors are not drawn: name them with --of" if left else ""
    spans = {float(np.ptp(given[name].turns)) for name in shown}
    figure, panels = curve_panels(
        [_ROW] * len(shown), 1.3, share=len(spans) <= 1
    )  # each over a turn of its own pointer
    for axes, (name, levels) in zip(panels, shown.items(), strict=True):
        turns = given[name].turns
        for at, (alpha, share) in enumerate(zip(_SHADES, _SHARES, strict=True)):
            axes.fill_between(turns, levels[at], levels[-1 - at], color=BLUE, alpha=alpha, linewidth=0, gid=share)
        axes.plot(turns, errors[name][0], color=RED, linewidth=0.9, linestyle=_DASHES, label="one of them", gid="one")
        axes.plot(turns, levels[3], color=BLACK, linewidth=1.6, label="median", gid="median")
        axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
        name_axes(axes, y=f"{name}\nerror (deg)", parse_math=False)
        axes.set_xlim(turns[0], turns[-1])
    name_axes(panels[-1], f"turns of {driving_link}{omitted}", parse_math=False)
    # legend patches in the visible shades of the bands, each of which is drawn over the wider bands
    clear = np.cumprod([1 - shade for shade in _SHADES]).tolist()
    keys = [
        Patch(color=BLUE, alpha=1 - part, linewidth=0, label=label) for part, label in zip(clear, _SHARES, strict=True)
    ]
    legend_below(figure, 5, [*keys, *panels[0].get_legend_handles_labels()[0]], "left")
    return figure


def _bands(name: str, errors: Floats) -> Floats:
    """Return minimum, five percentiles and maximum of a pointer's errors over the trials, shape (7, positions)."""
    _require(errors, f"'{name}' cannot turn in any trial", _TURNING)
    found: Floats = np.percentile(errors, (0, *PERCENTS, 100), axis=0)
    return found


def error_figure(trials: TrialResults) -> Figure:
    """Draw the median and the central 50 and 95 % ranges of each shown pointer's error, the widest range on top.

    Raises `QuestionError` if a pointer has no errors.
    """
    shown = [each for each in trials.pointers if each.name in trials.plan.shown]
    for pointer in shown:
        _require(pointer.kept, f"'{pointer.name}' cannot turn in any trial", _TURNING)
    ranges = {each.name: np.percentile(np.degrees(each.kept), PERCENTS) for each in shown}
    ranked = sorted(ranges, key=lambda name: ranges[name][0] - ranges[name][-1])
    days = any(trials.plan.shown.values())
    rows = []
    for name in ranked[:MOST_ROWS]:
        low, lower, middle, upper, high = map(float, ranges[name])
        per_day = trials.plan.shown[name]
        time = [figures((high - low) / per_day) if per_day else "-"] * days
        cells = (f"{figures(middle)}°", f"{figures(high - low)}°", *time)
        rows.append(Row(name, {"median": middle}, ((low, high), (lower, upper)), cells))
    note = ", given by the pushing flanks of a train that jams" if any(len(each.errors) <= 1 for each in shown) else ""
    left = f"\n{len(ranked) - MOST_ROWS} pointers with smaller errors are not drawn: name them with --of"
    label = f"error (deg) at random positions{note}\ndot median, thick 50 %, thin 95 % of the trials"
    label += left if len(ranked) > MOST_ROWS else ""
    return interval_chart({label: rows}, {"median": DOT}, ("median", "95 %", *["days"] * days))


# ------------------------------------------------------------------------------------------------- map of probabilities


def jam_map_figure(clearances: ArrayLike, scales: ArrayLike, probabilities: ArrayLike) -> Figure:
    """Draw the probability of a jam as a shaded map, with contour lines at 1, 10 and 50 %.

    clearances     ascending clearance factors, or relative positions between the limits of the clearance factor, (n,)
    scales         ascending scale factors of the errors, (m,)
    probabilities  probabilities of a jam, 0 to 1, (n, m); NaN for missing data
    """
    x, y, table = (np.asarray(each, dtype=float) for each in (clearances, scales, probabilities))
    figure = Figure(figsize=(WIDTH, 6.4), layout="constrained")
    axes = figure.add_subplot()
    shown = np.ma.masked_invalid(table.T)
    mesh = axes.pcolormesh(x, y, shown, shading="gouraud", cmap=SCALE, vmin=0.0, vmax=1.0, rasterized=True)
    mesh.set_gid("map")
    colour_bar(figure, axes, mesh, "probability of a jam", ticks=_JAM_TICKS, format=lambda tick, _: f"{tick:.0%}")
    handles = []
    # probabilities rise from 0 to 1 within few cells; arcsin(sqrt(p)) is more linear, so contours interpolate well
    arcsines = np.arcsin(np.sqrt(shown))
    for level, dashes in zip(LEVELS, _LEVEL_DASHES, strict=True):
        contour = axes.contour(x, y, arcsines, levels=[np.arcsin(np.sqrt(level))], colors=BLACK, linewidths=2.0)
        contour.set_linestyle([dashes])
        contour.set_gid(f"{level:.0%}")
        handles.append(Line2D([], [], color=BLACK, linestyle=dashes, linewidth=2.0, label=f"{level:.0%}"))
    legend_below(figure, 4, handles, "left", handlelength=4)
    across = "clearance factor" if x[0] >= 1 else "fraction of the clearance window of each pair"
    name_axes(axes, across, "factor of the declared errors")
    return figure


# ---------------------------------------------------------------------------------------------------- variance shares


def share_figure(shares: Mapping[str, Sequence[IntervalEstimate]], title: str = "") -> Figure:
    """Draw the shares of causes in the variance of an output's error, with confidence intervals as lines.

    Only the largest shares are drawn. Raises `QuestionError` if there is no cause.

    shares   for each cause, the share of its own effect and, if known, its share including all interactions
    """
    _require(shares, "a chart of shares needs at least one cause", "give the share of a wheel, pair or kind of error")
    ranked = sorted(shares.items(), key=lambda each: -each[1][-1].value)
    shown, rest = ranked[:MOST_ROWS], ranked[MOST_ROWS:]
    rows = [
        Row(
            name,
            dict(zip(_SHARE_LOOKS, (each.value for each in known), strict=False)),
            [(each.low, each.high) for each in reversed(known)],
            [f"{100 * each.value:.3g} %" for each in known],
        )
        for name, known in shown
    ]
    more = f"; {len(rest)} more causes of at most {rest[0][1][-1].value:.2g} are not drawn" if rest else ""
    looks = dict(list(_SHARE_LOOKS.items())[: max(len(known) for _, known in shown)])
    label = f"share of the variance{more}" + ("\nlines: 95 % intervals, thick: first order" if len(looks) > 1 else "")
    return interval_chart({label: rows}, looks, ("first", "total")[: len(looks)], title)


# ---------------------------------------------------------------------------------------------------------- convergence


def probability_figure(steps: Sequence[tuple[float, ProbabilityEstimate]], name: str, missing: str, fix: str) -> Figure:
    """Draw a probability with its 95 % interval as a curve. Raises `QuestionError` if there are no steps.

    steps          ascending abscissas with their probability estimates
    missing, fix   texts of the error: reason why there are no steps, and remedy
    """
    _require(steps, missing, fix)
    x = np.array([float(each) for each, _ in steps])
    low, high = np.array([share.interval for _, share in steps]).T
    figure, (axes,) = curve_panels([3.6])
    axes.fill_between(x, low, high, color=BLUE, alpha=0.15, linewidth=0, gid="95 %")
    look = {**series_look(0), "linewidth": 1.6, "marker": "o", "markersize": 3.5}
    axes.plot(x, [share.value for _, share in steps], gid=name, **look)
    return figure


def convergence_figure(steps: Sequence[tuple[int, ProbabilityEstimate]]) -> Figure:
    """Draw the probability that at least one pair jams, with its 95 % interval, over the number of trials.

    Raises `QuestionError` if there are no trials.

    steps   ascending numbers of trials with their probability estimates
    """
    figure = probability_figure(steps, "any pair", "no trial is completed", "give at least one trial")
    (axes,), counts = figure.axes, [count for count, _ in steps]
    axes.set_xscale("log")
    name_axes(axes, "trials; shaded: 95 % interval", "probability of a jam")
    # every n-th number of trials from the last one down, so that the full number is labelled
    axes.set_xticks(counts[-1 :: -max(len(counts) // _TICKS, 1)][::-1], minor=False)
    axes.set_xticks([], minor=True)
    axes.xaxis.set_major_formatter(lambda count, _: f"{count:,.0f}")
    return figure
