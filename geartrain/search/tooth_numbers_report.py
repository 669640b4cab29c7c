"""Documents and flat tables for the results of searches for tooth counts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Document, Section, Table, cut, exact, figure

if TYPE_CHECKING:
    from geartrain.search.epicyclic.epicyclic_sets import EpicyclicKind, SetFindings
    from geartrain.search.orrery.orrery_search import Orrery
    from geartrain.search.ratio.stage_search import StageFindings
    from geartrain.search.search_outcome import Shortfall
    from geartrain.search.stern_brocot import Approximants
    from geartrain.search.target_ratio import TargetRatio
    from geartrain.search.train.train_findings import Assignment, PartFindings, Standing, TrainFindings

_MANY = 3  # with more outputs a table of assignments shows only the maximum error; JSON has all errors


def error_text(value: Fraction) -> str:
    """Format a relative error: in ppm if it is below 0.1 %, in per cent if it is larger, and as "0" if it is exactly
    zero.
    """
    if abs(value) < Fraction(1, 1000):
        return "0" if not value else f"{float(value) * 1e6:+.6g} ppm"
    return f"{float(value) * 100:+.6g} %"


def stage_rows(found: StageFindings) -> list[dict[str, Any]]:
    """Return the rows of the table of gear stages that were found for a ratio, each as a dict keyed by column."""
    return [
        {
            "top": _product(one.top),
            "beneath": _product(one.beneath),
            "ratio": str(one.ratio),
            "value": float(one.ratio),
            "error": float(one.error),
            "stages": " ".join(f"{a}/{b}" for a, b in one.pairs),
            "total": one.total,
            "largest": one.largest,
            "distinct": one.distinct,
        }
        for one in found
    ]


def _product(counts: Sequence[int]) -> str:
    return "*".join(map(str, counts))


def describe_stages(found: StageFindings) -> Document:
    """Return the document on the gear stages found for a ratio."""
    summary = [_wanted(found.wanted), *([f"{found.note[0].upper()}{found.note[1:]}."] if found.note else [])]
    within = "exact" if not found.tolerance else f"within {figure(float(found.tolerance), 4)}"
    search = "exhaustive search" if found.complete else "interrupted search"
    summary.append(
        f"{found.count} solutions ({within}) among {figure(float(found.considered), 4)} combinations; {search}."
    )
    rows = [
        (
            f"{_product(one.top)} / {_product(one.beneath)}",
            exact(one.ratio),
            figure(one.ratio, 12),
            error_text(one.error),
            "  ".join(f"{a}/{b}" for a, b in one.pairs),
            str(one.total),
        )
        for one in found.solutions
    ]
    lines = [
        "The ratio is output speed / input speed if the numerator wheels drive, input speed / output speed if they are "
        "driven."
    ]
    table = Table(("teeth", "ratio", "decimal", "error", "stages", "sum"), cut(rows))
    sections = [Section("Solutions", lines, [table])] if rows else []
    return Document(f"Tooth numbers for {found.wanted.label}", summary, [*sections, *_shortfall(found.shortfall)])


def _wanted(wanted: TargetRatio) -> str:
    note = f" ({wanted.note})" if wanted.note else ""
    return f"Wanted: {exact(wanted.value)} = {figure(wanted.value, 12)}{note}."


def approximant_rows(found: Approximants) -> list[dict[str, Any]]:
    """Return the rows of the table of fractions that approximate a ratio, each as a dict keyed by column."""
    return [each.to_dict() for each in found.solutions]


def describe_approximants(found: Approximants) -> Document:
    """Return the document on the fractions that approximate a ratio."""
    wanted = found.wanted
    rows = [(exact(one.value), figure(one.value, 12), one.kind, error_text(one.error)) for one in found.solutions]
    table = Table(("fraction", "decimal", "kind", "error"), cut(rows))
    summary = [_wanted(wanted), f"Numerators and denominators up to {found.most}."]
    return Document(f"Fractions that approximate {wanted.label}", summary, [Section("Fractions", (), [table])])


def _shortfall(shortfall: Shortfall) -> list[Section]:
    """Return a list with one section on rejected candidates, the closest of them, and suggestions; an empty list if
    there is nothing to report.
    """
    lines = [f"Nearest: {shortfall.nearest}."] if shortfall.nearest else []
    lines += [f"Suggestions: {shortfall.advice}."] if shortfall.advice else []
    removed = {reason: count for reason, count in shortfall.removed.items() if count}
    rows = [(reason, figure(float(count), 6) if count > 10**9 else str(count)) for reason, count in removed.items()]
    if not lines and not rows:
        return []
    return [Section("Rejected candidates", lines, [Table(("rejected by", "candidates"), cut(rows))] if rows else [])]


# ------------------------------------------------------------------------------------------------------------- trains


def assignment_rows(found: TrainFindings) -> list[dict[str, Any]]:
    """Return the rows of the table of solutions for a train, each as a dict with the tooth count of each wheel and the
    error of each output.
    """
    return [
        {**one.teeth, **{f"error of {name}": float(each.error) for name, each in one.outputs.items()}}
        for one in found.solutions
    ]


def describe_assignments(found: TrainFindings) -> Document:
    """Return the document on the tooth counts found for a train, with a section for each independent part."""
    summary = [f"{figure(float(found.count), 6)} assignments of {', '.join(found.wheels)} satisfy all requirements."]
    summary += [f"{remark[0].upper()}{remark[1:]}." for remark in found.remarks]
    sections = [section for part in found.parts for section in _part(part)]
    if found.where:
        sections.append(_ranks(found.where))
    return Document(f"Tooth numbers of {found.name}", summary, sections)


def _part(part: PartFindings) -> list[Section]:
    """Return the sections on one part of a train, whose varied wheels are independent of all other varied wheels: its
    requirements, its number of solutions, and its best solutions. If there are no solutions, the rejected candidates
    are described instead.
    """
    requested = "; ".join([*part.demands, *part.rules])
    lines = [f"Required: {requested}." if requested else "No requirements."]
    within = "" if part.tolerance is None else f" within {figure(float(part.tolerance), 4)}"
    search = "complete search" if part.complete else f"incomplete search: {part.reason}"
    lines.append(f"{part.count} of {figure(float(part.considered), 6)} assignments are solutions{within} ({search}).")
    if part.complete and part.reason:
        lines.append(f"Not ranked: {part.reason}.")
    title = ", ".join(part.outputs) or ", ".join(part.wheels)
    tables = [_assignments(part.solutions)] if part.solutions else []
    rest = [] if part.solutions else _shortfall(part.shortfall)
    return [Section(title, lines, tables), *rest]


def _assignments(solutions: Sequence[Assignment]) -> Table:
    outputs = tuple(solutions[0].outputs)
    if len(outputs) > _MANY:
        rows = [[*map(str, one.teeth.values()), error_text(one.error)] for one in solutions]
        return Table([*solutions[0].teeth, "maximum error"], cut(rows), wide=True)
    header = [*solutions[0].teeth, *(f"{name}, {what}" for name in outputs for what in ("speed", "error"))]
    rows = [
        [
            *map(str, one.teeth.values()),
            *(text for each in one.outputs.values() for text in (exact(each.speed), error_text(each.error))),
        ]
        for one in solutions
    ]
    return Table(header, cut(rows))


def _ranks(standings: Sequence[Standing]) -> Section:
    rows = []
    for one in standings:
        teeth = {} if one.assignment is None else one.assignment.teeth
        errors = {} if one.assignment is None else one.assignment.outputs
        rows.append(
            (
                ", ".join(f"{wheel} = {count}" for wheel, count in teeth.items()) or ", ".join(one.wheels),
                "; ".join(f"{name} {error_text(each.error)}" for name, each in errors.items()),
                "-" if one.rank is None else str(one.rank),
                "; ".join(one.refused),
            )
        )
    return Section("Ranks of the given assignments", (), [Table(("teeth", "errors", "rank", "rejected by"), rows)])


# ---------------------------------------------------------------------------------------------------- epicyclic sets


def set_rows(found: SetFindings) -> list[dict[str, Any]]:
    """Return the rows of the table of epicyclic sets that were found, each as a dict keyed by column."""
    return [
        {
            "mode": one.mode.key,
            **one.teeth,
            "input/output": str(one.ratio),
            "error": float(one.error),
            "places": one.places,
            "room": one.room,
        }
        for one in found.solutions
    ]


def describe_sets(found: SetFindings) -> Document:
    """Return the document on the epicyclic sets found for a ratio."""
    summary = [
        f"Wanted: {found.ratio_is} = {exact(found.wanted)} = {figure(found.wanted, 10)}, in either sense by default.",
        f"{found.count} combinations of set and mode run"
        + (" within the tolerance." if found.tolerance is not None else "; the best are:" if found.count else "."),
    ]
    sections = []
    if found.solutions:
        rows = [
            (
                ", ".join(f"{wheel} {count}" for wheel, count in one.teeth.items()),
                str(one.mode),
                exact(one.ratio),
                error_text(one.error),
                f"{one.places}" if one.places else "any",
                figure(one.room, 4),
            )
            for one in found.solutions
        ]
        header = ("teeth", "mode", "input/output", "error", "positions", "clearance, modules")
        sections.append(Section("Sets", (), [Table(header, cut(rows))]))
    return Document(f"Sets of the kind {found.kind}", summary, [*sections, *_shortfall(found.shortfall)])


def describe_set_kinds(kinds: Mapping[str, EpicyclicKind]) -> Document:
    """Return the document on the types of epicyclic sets."""
    rows = [
        (kind.name, kind.title, ", ".join(kind.wheels), str(len(kind.modes)), kind.modes[0].key)
        for kind in kinds.values()
    ]
    table = Table(("kind", "description", "wheels", "modes", "example mode"), rows)
    return Document("Kinds of epicyclic sets", [], [Section("Kinds", (), [table])])


# ----------------------------------------------------------------------------------------------------------- orreries


def orrery_rows(found: Orrery) -> list[dict[str, Any]]:
    """Return the rows of the table of gear pairs of an orrery, each as a dict keyed by column."""
    return [pair.to_dict() for pair in found.pairs]


def describe_orrery(found: Orrery) -> Document:
    """Return the report on an orrery: its gear pairs, the periods of its arbors, and proved bounds of its size."""
    proof = "proved minimum" if found.complete else f"lower bound {found.minimum_wheels}"
    limits = {"proved": "proof of the minimum", "effort": "effort limit"}
    summary = [
        f"{found.wheels} wheels ({proof}) in {len(found.pairs)} pairs (lower bound {found.minimum_pairs}).",
        f"Maximum error {error_text(max(found.errors.values(), key=abs))}. "
        f"End of the search: {limits.get(found.ended, found.ended)}.",
    ]
    shown = {arbor.name: arbor for arbor in found.arbors}
    rows = [
        (
            pair.parent,
            f"{pair.driver} / {pair.driven}",
            pair.child,
            figure(shown[pair.child].period, 12),
            error_text(found.errors[pair.child]) if pair.child in found.errors else "",
            "same" if shown[pair.child].sense > 0 else "opposite",
        )
        for pair in found.pairs
    ]
    header = ("driving arbor", "driver / driven", "driven arbor", "period", "speed error", "sense")
    return Document("Orrery", summary, [Section("Pairs", (), [Table(header, cut(rows))])])
