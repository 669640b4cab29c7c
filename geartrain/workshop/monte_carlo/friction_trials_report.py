"""Trials of friction as a section of a page: mean, greatest and starting torque and efficiency with their intervals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.report.document import Section, Table
from geartrain.workshop.monte_carlo.monte_carlo_report import number_text, share_text

if TYPE_CHECKING:
    from geartrain.workshop.monte_carlo.friction_trials import FrictionTrials, TrialFigure


def trial_sections(found: FrictionTrials) -> Iterator[Section]:
    """What of the torque over the run is sure, given what is of friction."""
    lines = [f"{found.done} trials, seed {found.seed}; estimates with the interval that holds with 95 %."]
    if not found.complete:
        lines.insert(0, f"PARTIAL: stopped after {found.done} of {found.wanted} trials.")
    drawn = ", ".join(f"{name} {each.sliding:g} ± {each.deviation:g}" for name, each in found.spreads.items())
    lines.append(f"Drawn from normal distributions, what falls below 0 as 0: {drawn}.")
    if found.locks.count:
        lines.append(f"The train locks in {share_text(found.locks)} of the trials, which have no mean torque.")
    yield Section("Trials of friction", lines, (_figures(found),))


def _figures(found: FrictionTrials) -> Table:
    told = {
        f"mean torque at {found.link}": found.mean,
        "greatest": found.greatest,
        "starting": found.starting,
        "efficiency": found.efficiency,
    }
    rows = [_row(name, figure) for name, figure in told.items() if len(figure.values)]
    return Table(("over the trials", "mean", "deviation", "95 % lie between", "and"), rows)


def _row(name: str, figure: TrialFigure) -> tuple[str, ...]:
    percentiles = figure.percentiles
    low, high = min(percentiles), max(percentiles)
    ends = f"{percentiles[low].value:.5g}", f"{percentiles[high].value:.5g}"
    return (name, number_text(figure.mean, 5), number_text(figure.deviation), *ends)
