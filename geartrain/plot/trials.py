"""Trials of a train cut by hand as pictures: one for each thing they tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.plot.convergence import Settling, convergence_figure
from geartrain.plot.jam_map import jam_map_figure
from geartrain.plot.library import Figure
from geartrain.plot.straying import Bands, histogram_figure, straying_figure
from geartrain.plot.tornado import Sway, tornado_figure

if TYPE_CHECKING:
    from geartrain.uncertainty.trials import Cleared, Course, Findings, Indices, Share, Trials

PICTURES = ("errors", "course", "convergence", "sobol", "pairs", "map")


def findings_figure(findings: Findings, picture: str = "errors") -> Figure:
    """One picture of what trials told.

    errors        how often each pointer is how far off, at random positions of the input
    course        bands of pointer errors along one turn, of each output that was followed
    convergence   how the probability of a jam settled
    sobol         whose errors move the first output: by wheel, or by kind where that alone was asked
    pairs         by pair, from superposition
    map           how often the train jams over clearance and scale of its errors: needs a sweep of both

    Raises `QuestionError` where what it shows was not asked.
    """
    trials = findings.trials
    if picture == "errors":
        return errors_figure(trials)
    if picture == "course":
        return course_figure(findings.courses, trials.plan.lead)
    if picture == "convergence":
        return settling_figure(trials)
    if picture == "sobol":
        _need(findings.indices, "Sobol indices were not asked for", "ask for them: --sobol")
        return indices_figure(findings.indices[0])
    if picture == "pairs":
        return pair_shares_figure(trials, trials.plan.outputs[0])
    if picture == "map":
        return clearances_figure(findings.cleared, trials.plan.name)
    raise QuestionError(Problem(f"there is no picture '{picture}'", "", f"use {', '.join(PICTURES)}"))


def _need(what: Sequence[object], why: str, fix: str) -> None:
    if not what:
        raise QuestionError(Problem("there is nothing to draw", why, fix))


def errors_figure(trials: Trials) -> Figure:
    """Histograms of every pointer's error at random positions; of all trials where in hardly any the train runs."""
    found = {each.name: np.degrees(each.kept) for each in trials.pointers}
    jammed = any(len(each.errors) <= 1 for each in trials.pointers)
    note = ", flanks that push alone reckoned where the train jams" if jammed else ""
    return histogram_figure(found, f"{trials.plan.name} at random positions{note}")


def course_figure(courses: Sequence[Course], lead: str) -> Figure:
    """Bands of pointer errors along one turn of each pointer that was followed."""
    _need(courses, "no pointer was followed along its way", "name the outputs to follow: --output")
    return straying_figure({each.name: Bands.of(each.turns, np.degrees(each.errors)) for each in courses}, lead)


def settling_figure(trials: Trials, event: str = "jam") -> Figure:
    """How the probability settled that an event befalls any pair."""
    return convergence_figure({"any pair": _settling(trials.convergence(event))}, f"probability of a {event}")


def _settling(steps: Sequence[tuple[int, Share]]) -> Settling:
    """An estimate's steps as arrays."""
    ends = np.array([share.interval for _, share in steps]).reshape(-1, 2)
    counts = np.array([float(count) for count, _ in steps])
    return Settling(counts, np.array([share.value for _, share in steps]), ends[:, 0], ends[:, 1])


def indices_figure(indices: Indices) -> Figure:
    """Sobol indices of one output, by wheel or by kind of error."""
    found = {
        each.name: Sway(
            each.first.value, (each.first.low, each.first.high), each.total.value, (each.total.low, each.total.high)
        )
        for each in indices.indices
    }
    return tornado_figure(found, f"error of '{indices.output}' by {indices.by}: {indices.trials:,} base samples")


def pair_shares_figure(trials: Trials, output: str) -> Figure:
    """Which pair's teeth move one output, by superposition; these shares sum to 1."""
    shares = trials.pointer(output).shares
    return tornado_figure({name: Sway(value) for name, value in shares.items()}, f"error of '{output}' by pair")


def clearances_figure(cleared: Sequence[Cleared], title: str = "", event: str = "jam") -> Figure:
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
