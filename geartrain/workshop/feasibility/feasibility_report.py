"""Report on the feasibility of a train: outcomes and their causes, crank torque, required accuracy, pointer errors."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, cut
from geartrain.workshop.feasibility.feasibility_result import OUTCOMES
from geartrain.workshop.monte_carlo.monte_carlo_report import angle_text, share_text

if TYPE_CHECKING:
    from geartrain.numerics import IntervalEstimate
    from geartrain.workshop.feasibility.feasibility_result import FeasibilityResult

_CAUSES = 3  # causes of an outcome that are printed
_POINTERS = 6  # pointers that are printed: those with the largest errors


def describe_feasibility(found: FeasibilityResult) -> Document:
    """Return the report on the feasibility of a train.

    Parameters
    ----------
    found : FeasibilityResult
        Result of `run_feasibility`.

    Returns
    -------
    Document
        Probabilities with Wilson's 95 % confidence intervals, torques in N mm, pointer errors in degrees.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import find_feasibility_plan, run_feasibility
    >>> plan = find_feasibility_plan(geartrain.load("moon-triangular"), outputs=("moon",))
    >>> [section.title for section in describe_feasibility(run_feasibility(plan, trials=4)).sections]
    ['Outcome', 'Pointers']
    """
    trials = found.trials
    summary = [f"{trials.done} trials, seed {trials.seed}; intervals are at the 95 % confidence level."]
    if not trials.complete:
        summary.insert(0, f"PARTIAL: stopped after {trials.done} of {trials.wanted} trials.")
    return Document(f"Feasibility: {trials.plan.name}", summary, list(_sections(found)))


def _sections(found: FeasibilityResult) -> Iterator[Section]:
    yield _outcomes(found)
    if found.crank_torque is not None:
        yield _torque(found)
    if found.curve:
        yield _curve(found)
    yield _pointers(found)


def _outcomes(found: FeasibilityResult) -> Section:
    text = f"The train turns in {share_text(found.outcomes['turns'])} of the trials, given: {found.conditions}."
    rows = [(name, share_text(found.outcomes[name]), _causes(found, name)) for name in OUTCOMES]
    rows.append(("- rough running", share_text(found.rough), "tips clash, of the trials that turn"))
    rows.append(("- loss of contact", share_text(found.loose), "of the trials that turn"))
    if found.forced is not None:
        rows.append(
            ("- breaks if forced", share_text(found.forced.torque), "torque of the hand, of the trials that jam")
        )
        rows.append(("- with the wedge", share_text(found.forced.wedge), "flanks of the jammed pair squeezed"))
    notes = [f"Not included: {each}." for each in found.neglected]
    table = Table(("outcome", "probability", "cause, share of all trials"), cut(rows))
    return Section("Outcome", (text, *notes), (table,))


def _causes(found: FeasibilityResult, outcome: str) -> str:
    own = [each for each in found.causes if each.outcome == outcome]
    more = f", {len(own) - _CAUSES} more" if len(own) > _CAUSES else ""
    return ", ".join(f"{each.part} {100 * each.share.value:.3g} %" for each in own[:_CAUSES]) + more


def _torque(found: FeasibilityResult) -> Section:
    torque = found.crank_torque
    assert torque is not None
    text = f"Torque at '{found.plan.crank}': median {_torque_text(torque.median)} N mm"
    text += f", 90 % of the trials from {_torque_text(torque.low)} to {_torque_text(torque.high)} N mm"
    over = "at mean speeds" if found.plan.turns is None else f"maximum over {found.plan.turns:g} revolutions"
    drive = found.plan.declared.case(found.plan.state).drive
    handle = None if drive is None or drive.hand is None else drive.hand.handle
    force = f" The median is {torque.median.value / handle.si:.3g} N at the handle." if handle is not None else ""
    return Section("Crank torque", (f"{text} ({over}).{force}",))


def _torque_text(figure: IntervalEstimate) -> str:
    return f"{1e3 * figure.value:.4g} ({1e3 * figure.low:.4g}..{1e3 * figure.high:.4g})"


def _curve(found: FeasibilityResult) -> Section:
    half = found.accuracy_for(0.5)
    text = "Probability that the train turns, with the same random numbers at every standard deviation of the pitches."
    needed = "" if half is None else f" It is 50 % at {half:.3g} deg."
    rows = [(f"{step.accuracy:.4g}", share_text(step.turns)) for step in found.curve]
    return Section("Accuracy", (text + needed,), (Table(("pitch deviation (deg)", "turns"), rows),))


def _pointers(found: FeasibilityResult) -> Section:
    pointers = sorted(found.trials.pointers, key=lambda pointer: -pointer.deviation.value)
    rows = []
    for pointer in pointers[:_POINTERS]:
        ends = (angle_text(pointer.percentiles[percent]) for percent in (2.5, 97.5))
        name = pointer.name + (" *" if pointer.of_all else "")
        rows.append((name, angle_text(pointer.deviation), *ends, f"{degrees(pointer.maximum):.3g}"))
    text = "Errors due to cutting at random positions, in degrees, in trials in which the output turns."
    if any(row[0].endswith("*") for row in rows):
        text += " * Nearly all trials jam: errors given by the pushing flanks, ignoring jams."
    left = len(pointers) - len(rows)
    text += f" {left} pointers with smaller errors are not listed." if left else ""
    return Section("Pointers", (text,), (Table(("output", "sd", "2.5 %", "97.5 %", "maximum"), rows),))
