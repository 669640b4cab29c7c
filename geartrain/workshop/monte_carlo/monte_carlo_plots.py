"""Trials of a train cut by hand as pictures, one for each thing they tell, and how an estimate settles as they grow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.style import GREY, SMALL, TEXT, WIDTH, Axes, Figure, headed, plain, series_look
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour
from geartrain.workshop.monte_carlo.jam_map import jam_map_figure
from geartrain.workshop.monte_carlo.pointer_error_plots import ErrorBands, histogram_figure, pointer_error_figure
from geartrain.workshop.monte_carlo.tornado_chart import VarianceShare, tornado_figure

if TYPE_CHECKING:
    from geartrain.numerics import ProbabilityEstimate
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.monte_carlo.pointer_error import PointerErrorCourse
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices
    from geartrain.workshop.monte_carlo.trial_results import TrialResults


_TICKS = 8  # counts of trials that are written, or a few more


@dataclass(frozen=True, slots=True)
class ConvergenceTrace:
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


def convergence_figure(estimates: Mapping[str, ConvergenceTrace], unit: str = "probability") -> Figure:
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
        look = {**series_look(at), "linewidth": 1.6, "marker": "o", "markersize": 3.5}
        above.fill_between(each.trials, each.low, each.high, color=series_colour(at), alpha=0.15, linewidth=0)
        above.plot(each.trials, each.value, label=name, gid=name, **look)
        if each.truth is not None:
            above.axhline(each.truth, color=series_colour(at), linewidth=1.0, linestyle=":", gid=f"truth of {name}")
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
    counts = sorted({float(count) for each in estimates.values() for count in each.trials})
    below.set_xticks(counts[-1 :: -max(len(counts) // _TICKS, 1)][::-1], minor=False)
    below.set_xticks([], minor=True)
    below.xaxis.set_major_formatter(lambda count, _: f"{count:,.0f}")
    below.set_xlabel("trials", fontsize=TEXT)
    figure.legend(*above.get_legend_handles_labels(), loc="outside lower left", ncols=4, fontsize=SMALL, frameon=False)
    return figure


def _slope(axes: Axes, estimates: list[ConvergenceTrace]) -> None:
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
        "slope -1/2",
        (ends[0], 0.6 * level / np.sqrt(ends[0])),
        xytext=(0, -6),
        textcoords="offset points",
        fontsize=SMALL,
        color=GREY,
        va="top",
        ha="left",
    )


PICTURES = ("errors", "course", "convergence", "sobol", "pairs", "map")


def monte_carlo_figure(findings: MonteCarloResult, picture: str = "errors") -> Figure:
    """One picture of what trials of wheels cut by hand told.

    Parameters
    ----------
    findings : MonteCarloResult
        Trials, with whatever the picture shows.
    picture : {"errors", "course", "convergence", "sobol", "pairs", "map"}
        "errors": how often each pointer is how far off, at random positions of the input. "course": bands of pointer
        errors along one turn, of each output that was followed. "convergence": how the probability of a jam settled.
        "sobol": whose errors move the first output, by wheel, or by kind where that alone was asked. "pairs": the same
        by pair, from superposition. "map": how often the train jams over clearance and scale of its errors.

    Returns
    -------
    matplotlib.figure.Figure
        Errors in degrees, probabilities with their intervals of 95 %.

    Raises
    ------
    QuestionError
        Where what it shows was not asked for.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import (MonteCarloResult, find_trial_plan, read_error_overrides, run_trials)
    >>> plan = find_trial_plan(geartrain.load("moon-triangular"), read_error_overrides(["placement=2 %"]), ("moon",))
    >>> found = MonteCarloResult(run_trials(plan, trials=2, seed=1))
    >>> monte_carlo_figure(found, "convergence").axes[0].get_ylabel()
    'probability of a jam'
    """
    if picture not in PICTURES:
        raise QuestionError(Problem(f"there is no picture '{picture}'", "", f"use {', '.join(PICTURES)}"))
    times = "" if picture == "map" else f" {len(findings.trials.marks):,} times"
    return headed(_picture(findings, picture), f"{findings.trials.plan.name}, cut by hand{times}")


def _picture(findings: MonteCarloResult, picture: str) -> Figure:
    trials = findings.trials
    if picture == "errors":
        return errors_figure(trials)
    if picture == "course":
        return course_figure(findings.courses, trials.plan.lead)
    if picture == "convergence":
        return probability_convergence_figure(trials)
    if picture == "sobol":
        _need(findings.indices, "Sobol indices were not asked for", "ask for them: --sobol")
        return indices_figure(findings.indices[0])
    if picture == "pairs":
        return pair_shares_figure(trials, trials.plan.outputs[0])
    return clearances_figure(findings.cleared)


def _need(what: Sequence[object], why: str, fix: str) -> None:
    if not what:
        raise QuestionError(Problem("there is nothing to draw", why, fix))


def errors_figure(trials: TrialResults) -> Figure:
    """Histograms of every pointer's error at random positions; of all trials where in hardly any the train runs."""
    found = {each.name: np.degrees(each.kept) for each in trials.pointers}
    jammed = any(len(each.errors) <= 1 for each in trials.pointers)
    note = ", of a train that jams as its pushing flanks alone have it" if jammed else ""
    return histogram_figure(found, f"at random positions{note}")


def course_figure(courses: Sequence[PointerErrorCourse], lead: str) -> Figure:
    """Bands of pointer errors along one turn of each pointer that was followed."""
    _need(courses, "no pointer was followed along its way", "name the outputs to follow: --output")
    return pointer_error_figure(
        {each.name: ErrorBands.of(each.turns, np.degrees(each.errors)) for each in courses}, lead
    )


def probability_convergence_figure(trials: TrialResults, event: str = "jam") -> Figure:
    """How the probability settled that an event befalls any pair."""
    return convergence_figure({"any pair": _settling(trials.convergence(event))}, f"probability of a {event}")


def _settling(steps: Sequence[tuple[int, ProbabilityEstimate]]) -> ConvergenceTrace:
    """An estimate's steps as arrays."""
    ends = np.array([share.interval for _, share in steps]).reshape(-1, 2)
    counts = np.array([float(count) for count, _ in steps])
    return ConvergenceTrace(counts, np.array([share.value for _, share in steps]), ends[:, 0], ends[:, 1])


def indices_figure(indices: SobolIndices) -> Figure:
    """Sobol indices of one output, by wheel or by kind of error."""
    found = {
        each.name: VarianceShare(
            each.first.value, (each.first.low, each.first.high), each.total.value, (each.total.low, each.total.high)
        )
        for each in indices.indices
    }
    return tornado_figure(found, f"error of '{indices.output}' by {indices.by}: {indices.trials:,} base samples")


def pair_shares_figure(trials: TrialResults, output: str) -> Figure:
    """Which pair's teeth move one output, by superposition; these shares sum to 1."""
    shares = trials.pointer(output).shares
    return tornado_figure(
        {name: VarianceShare(value) for name, value in shares.items()}, f"error of '{output}' by pair"
    )


def clearances_figure(cleared: Sequence[ClearanceCase], title: str = "", event: str = "jam") -> Figure:
    """A map of how often the train jams, over its clearance and the scale of its errors.

    Raises `QuestionError` unless there are two or more of both.
    """
    clearances = sorted({each.clearance for each in cleared if each.clearance is not None})
    scales = sorted({each.scale for each in cleared})
    table = np.full((len(clearances), len(scales)), np.nan)
    for each in cleared:
        if each.clearance is not None:
            table[clearances.index(each.clearance), scales.index(each.scale)] = each.events[event].value
    factors = bool(clearances) and clearances[0] >= 1
    across = "clearance factor" if factors else "share of each pair's own window of clearance"
    return jam_map_figure(clearances, scales, table, axis_names=(across, "errors, over those declared"), title=title)
