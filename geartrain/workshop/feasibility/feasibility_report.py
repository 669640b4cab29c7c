"""Report on the feasibility of a train, and plot of the probability that it turns."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, cut
from geartrain.workshop.feasibility.feasibility_trials import OUTCOMES
from geartrain.workshop.monte_carlo.monte_carlo_report import pointer_section, share_text

if TYPE_CHECKING:
    from geartrain.drawing.style import Figure
    from geartrain.numerics import IntervalEstimate
    from geartrain.workshop.feasibility.feasibility_trials import FeasibilityResult

_CAUSES = 3  # causes of an outcome that are printed


def describe_feasibility(found: FeasibilityResult) -> Document:
    """Return the report on the feasibility of a train."""
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
        half = found.accuracy_for(0.5)
        text = "Probability that the train turns, with the same random numbers at every standard deviation."
        text += "" if half is None else f" It is 50 % at {half:.3g} deg."
        rows = [(f"{accuracy:.4g}", share_text(share)) for accuracy, share in found.curve.items()]
        yield Section("Accuracy", (text,), (Table(("pitch deviation (deg)", "turns"), rows),))
    yield pointer_section(found.trials.pointers)


def _outcomes(found: FeasibilityResult) -> Section:
    wheels = " with perfect wheels" if found.perfect else ""
    text = f"The train{wheels} turns in {share_text(found.outcomes['turns'])} of the trials, given: {found.conditions}."
    rows = []
    for name in OUTCOMES:
        causes = [f"{part} {100 * share.value:.3g} %" for part, share in found.causes.get(name, {}).items()]
        more = [f"{len(causes) - _CAUSES} more"] if len(causes) > _CAUSES else []
        rows.append((name, share_text(found.outcomes[name]), ", ".join([*causes[:_CAUSES], *more])))
    rows.append(("- rough running", share_text(found.rough), "tips clash, of the trials that turn"))
    rows.append(("- loss of contact", share_text(found.loose), "of the trials that turn"))
    if found.forced is not None:
        rows.append(("- breaks if forced", share_text(found.forced["torque"]), "by the hand, of the trials that jam"))
        rows.append(("- with the wedge", share_text(found.forced["wedge"]), "flanks of the jammed pair squeezed"))
    notes = [f"Not included: {each}." for each in found.neglected]
    return Section("Outcome", (text, *notes), (Table(("outcome", "probability", "cause, of all trials"), cut(rows)),))


def _torque(found: FeasibilityResult) -> Section:
    assert found.crank_torque is not None
    low, median, high = found.crank_torque.values()
    over = "at mean speeds" if found.plan.turns is None else f"maximum over {found.plan.turns:g} revolutions"
    text = (
        f"Torque at '{found.plan.crank}': median {_torque_text(median)} N mm, 90 % of the trials from "
        f"{_torque_text(low)} to {_torque_text(high)} N mm ({over})."
    )
    drive = found.plan.declared.case(found.plan.state).drive
    handle = None if drive is None or drive.hand is None else drive.hand.handle
    text += "" if handle is None else f" The median is {median.value / handle.si:.3g} N at the handle."
    return Section("Crank torque", (text,))


def _torque_text(figure: IntervalEstimate) -> str:
    return f"{1e3 * figure.value:.4g} ({1e3 * figure.low:.4g}..{1e3 * figure.high:.4g})"


def feasibility_figure(found: FeasibilityResult) -> Figure:
    """Draw the probability that a train turns over its accuracy. Raises `QuestionError` if it was not computed."""
    from geartrain.drawing.style import headed, name_axes
    from geartrain.workshop.monte_carlo.monte_carlo_plots import probability_figure

    what = "the curve of the accuracies was not computed", "give accuracies: --accuracy 0.02:0.3:6"
    figure = probability_figure(list(found.curve.items()), "turns", *what)
    label = "standard deviation of the pitches (deg); shaded: 95 % interval"
    name_axes(figure.axes[0], label, "probability that the train turns")
    return headed(figure, f"{found.trials.plan.name}: accuracy that is needed")
