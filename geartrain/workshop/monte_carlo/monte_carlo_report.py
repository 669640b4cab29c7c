"""Report on trials of a train with cutting errors: event probabilities of pairs, pointer errors and their causes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, isfinite
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, cut

if TYPE_CHECKING:
    from geartrain.numerics import IntervalEstimate, ProbabilityEstimate
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.monte_carlo.trial_results import (
        PointerErrorCourse,
        PointerErrorStatistics,
        TrialResults,
    )


def trials_document(found: TrialResults) -> Document:
    """Return the report on trials that `geartrain montecarlo` prints."""
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult

    return describe_monte_carlo(MonteCarloResult(found))


_EVENTS = ("jam", "clash", "dwell", "disengaged")


def describe_monte_carlo(found: MonteCarloResult) -> Document:
    """Return the report on Monte Carlo trials: events of pairs, pointer errors, and all further studies."""
    trials = found.trials
    intervals = "intervals are at the 95 % confidence level"
    summary = [f"{trials.done} trials, seed {trials.seed}; {intervals}.", *found.assumptions]
    if not trials.complete:
        summary.insert(0, f"PARTIAL: stopped after {trials.done} of {trials.wanted} trials.")
    return Document(f"Cut by hand: {trials.plan.name}", summary, list(_sections(found)))


def _sections(found: MonteCarloResult) -> Iterator[Section]:
    yield _verdict(found)
    yield _pairs(found)
    if found.trials.filings:
        yield _filing(found)
    yield pointer_section(found.trials.pointers)
    for course in found.courses:
        yield _course(course)
    yield from (_shares(found, pointer) for pointer in found.trials.pointers[:4] if len(pointer.shares) > 1)
    for each in found.indices:
        rows = [(index.name, *(_index(figure) for figure in (index.first, index.total))) for index in each.indices]
        text = f"Sobol indices by {each.by}, {each.trials} base samples; the total index includes all interactions."
        table = Table((each.by, "first order", "total"), cut(rows))
        yield Section(f"Sensitivity of {each.output} by {each.by}", (text,), (table,))
    if found.cleared:
        given = [case for case in found.cleared if case.clearance is not None]
        cells = [(f"{case.clearance:.6g}", *(share_text(case.events[event]) for event in _EVENTS)) for case in given]
        text = "Probability of each event in any pair of the train, with the same wheels at every clearance."
        yield Section("Clearance", (text,), (Table(("clearance", *_EVENTS), cells),))
    yield _convergence(found)


def share_text(each: ProbabilityEstimate) -> str:
    """Return a probability with its confidence interval as text such as `1.2 % (0.9..1.6)`, or "-" without trials."""
    if not each.of:
        return "-"
    low, high = each.interval
    return f"{_percent(each.value)} % ({_percent(low)}..{_percent(high)})"


def _percent(value: float) -> str:
    """Return a probability in percent as text, with two significant digits below 10 % and one decimal from there."""
    percent = 100 * value
    return f"{percent:.2g}" if percent < 10 else f"{percent:.1f}".removesuffix(".0")


def angle_text(figure: IntervalEstimate, digits: int = 3) -> str:
    """Return an angle [rad], converted to degrees, with its confidence interval as text such as `2.04 (1.9..2.2)`."""
    value, low, high = (f"{degrees(each):.{digits}g}" for each in (figure.value, figure.low, figure.high))
    return f"{value} ({low}..{high})"


def number_text(figure: IntervalEstimate, digits: int = 3) -> str:
    """Return a number with its confidence interval as text such as `12.4 (11.8..13)`."""
    return f"{figure.value:.{digits}g} ({figure.low:.{digits}g}..{figure.high:.{digits}g})"


def _verdict(found: MonteCarloResult) -> Section:
    train = found.trials.train
    jam, stops = train.events["jam"], train.events["stops"]
    worst = sorted(found.trials.pairs, key=lambda pair: -pair.events["jam"].value)[:3]
    names = ", ".join(f"{pair.name} ({share_text(pair.events['jam'])})" for pair in worst if pair.events["jam"].count)
    text = f"At least one pair jams in {share_text(jam)} of the trials, and jams or clashes in {share_text(stops)}."
    return Section("Verdict", (text, f"Jams most often: {names}." if names else "No pair jams."))


def _pairs(found: MonteCarloResult) -> Section:
    rows = []
    for pair in (*found.trials.pairs, found.trials.train):
        # NaN, which is not equal to itself, marks an unknown value
        backlash, bound = (f"{each:.3g}" if each == each else "-" for each in (pair.backlash, pair.bound))
        rows.append((pair.name, backlash, *(share_text(pair.events[name]) for name in _EVENTS), bound))
    header = ("pair", "backlash (pitches)", *_EVENTS, "bound on jams")
    text = (
        "Probability of each event over the full meshing cycle. The backlash is for perfect wheels, in pitches of the "
        "driven wheel. The bound 2 lcm(z1, z2) Q(backlash / 2 sigma) applies to pitch deviations only."
    )
    return Section("Pairs", (text,), (Table(header, cut(rows)),))


def _filing(found: MonteCarloResult) -> Section:
    rows = []
    for each in found.trials.filings:
        work = number_text(each.strokes), number_text(each.teeth), str(each.most)
        rows.append((each.name, share_text(each.filed), *work, share_text(each.jams)))
    header = ("pair", "jams before", "strokes", "teeth filed", "maximum strokes", "jams after")
    text = "If a pair jams, its flanks are filed until it passes. Strokes and teeth are means over all trials."
    return Section("Filing", (text,), (Table(header, cut(rows)),))


def pointer_section(pointers: Sequence[PointerErrorStatistics]) -> Section:
    """Return the report section on the errors of pointers."""
    rows: list[tuple[str, ...]] = []
    texts = ["Errors at random positions of the input, in degrees. Trials that jam are counted, but not averaged."]
    for pointer in pointers:
        ends = pointer.percentiles
        rows.append(
            (
                pointer.name + (" *" if pointer.of_all else ""),
                str(pointer.stopped),
                angle_text(pointer.mean),
                angle_text(pointer.deviation),
                *(angle_text(ends[percent]) for percent in (2.5, 97.5)),
                f"{degrees(pointer.maximum):.3g}",
                f"{degrees(pointer.first[0]):.2g}",
            )
        )
    if any(row[0].endswith("*") for row in rows):
        texts.append(
            "* Nearly all trials jam: the errors are those given by the pushing flanks in all trials, ignoring jams."
        )
    texts.append("Linear error: difference (rms) of the superposed errors of the pairs from the composed motion.")
    header = ("output", "jams", "mean", "sd", "2.5 %", "97.5 %", "maximum", "linear error")
    return Section("Pointers", texts, (Table(header, cut(rows)),))


def _course(course: PointerErrorCourse) -> Section:
    rows = []
    for percent, each in course.percentiles.items():
        # an end is infinite if too few trials are beyond the percentile
        ends = (f"{degrees(end):.3g}" if isfinite(end) else "?" for end in (each.low, each.high))
        rows.append((f"{percent} %", f"{degrees(each.value):.3g}", "..".join(ends)))
    text = f"Maximum absolute error along one turn of '{course.name}' in {course.count} trials, in degrees."
    return Section(f"Along a turn of {course.name}", (text,), (Table(("percentile", "error", "interval"), rows),))


def _shares(found: MonteCarloResult, pointer: PointerErrorStatistics) -> Section:
    rows = [
        (name, f"{100 * each:.3g} %")
        for name, each in sorted(pointer.shares.items(), key=lambda item: -abs(item[1]))
        if abs(each) > 5e-4  # three digits in percent would show 0
    ]
    text = (
        "Shares of the variance by pair, exact to first order. A share can be negative if two pairs have a wheel in "
        "common."
    )
    return Section(f"Variance of {pointer.name}", (text,), (Table(("pair", "share"), rows),))


def _index(figure: IntervalEstimate) -> str:
    return f"{figure.value:.3f} ({figure.low:.3f}..{figure.high:.3f})"


def _convergence(found: MonteCarloResult) -> Section:
    trials = found.trials
    rows = [
        (str(count), share_text(jam), share_text(stops))
        for (count, jam), (_, stops) in zip(trials.convergence("jam"), trials.convergence("stops"), strict=True)
    ]
    tables = [Table(("trials", "a pair jams", "a pair jams or clashes"), rows)]
    for at, pointer in enumerate(trials.pointers[:4]):
        spread = [(str(count), angle_text(sd, 4)) for count, sd in trials.pointer_convergence(at)]
        tables.append(Table((f"trials of {pointer.name}", "sd (deg)"), spread))
    return Section("Convergence", ("The same estimates from the first trials only.",), tuple(tables))
