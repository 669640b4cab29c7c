"""Tooth numbers that were found, as pages and as flat tables: of a ratio, a train, an epicyclic set, an orrery."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Document, Section, Table, cut, exact, figure

if TYPE_CHECKING:
    from geartrain.search.epicyclic.epicyclic_sets import EpicyclicKind, SetFindings
    from geartrain.search.orrery.orrery_search import Orrery
    from geartrain.search.ratio.stage_search import StageFindings
    from geartrain.search.search_outcome import GearStages, Shortfall
    from geartrain.search.stern_brocot import Approximants
    from geartrain.search.target_ratio import TargetRatio
    from geartrain.search.train.train_findings import Assignment, PartFindings, Standing, TrainFindings

_MANY = 3  # outputs beyond which a table of assignments tells only the greatest error; the JSON has all


def error_text(value: Fraction) -> str:
    """A relative error: in parts per million where it is small, in per cent where it is not, 0 where it is exactly."""
    if abs(value) < Fraction(1, 1000):
        return "0" if not value else f"{float(value) * 1e6:+.6g} ppm"
    return f"{float(value) * 100:+.6g} %"


def stage_rows(found: StageFindings) -> list[dict[str, Any]]:
    """The solutions as a flat table."""
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
    """Solutions of a ratio by stages."""
    summary = [_wanted(found.wanted), *([f"{found.note[0].upper()}{found.note[1:]}."] if found.note else [])]
    if found.tolerance is not None:
        whole = "every one was looked at" if found.complete else "not all of them were looked at"
        summary.append(
            f"{found.count} of {figure(float(found.considered), 4)} pairs of sets are within "
            f"{figure(float(found.tolerance), 4)}; {whole}."
        )
    sections = [_solutions(found.solutions)] if found.solutions else []
    return Document(f"Tooth numbers for {found.wanted.label}", summary, [*sections, *_shortfall(found.shortfall)])


def _wanted(wanted: TargetRatio) -> str:
    note = f" ({wanted.note})" if wanted.note else ""
    return f"Wanted: {exact(wanted.value)} = {figure(wanted.value, 12)}{note}."


def _solutions(solutions: Sequence[GearStages]) -> Section:
    rows = [
        (
            f"{_product(one.top)} / {_product(one.beneath)}",
            exact(one.ratio),
            figure(one.ratio, 12),
            error_text(one.error),
            "  ".join(f"{a}/{b}" for a, b in one.pairs),
            str(one.total),
        )
        for one in solutions
    ]
    return Section("Solutions", (), [Table(("teeth", "ratio", "decimal", "error", "stages", "sum"), cut(rows))])


def approximant_rows(found: Approximants) -> list[dict[str, Any]]:
    """The fractions as a flat table."""
    return [each.to_dict() for each in found.solutions]


def describe_approximants(found: Approximants) -> Document:
    """The fractions on the way to a ratio."""
    wanted = found.wanted
    rows = [(exact(one.value), figure(one.value, 12), one.kind, error_text(one.error)) for one in found.solutions]
    table = Table(("fraction", "decimal", "kind", "error"), cut(rows))
    summary = [_wanted(wanted), f"Numerators and denominators up to {found.most}."]
    return Document(f"Fractions on the way to {wanted.label}", summary, [Section("Fractions", (), [table])])


def _shortfall(shortfall: Shortfall) -> list[Section]:
    """Where the others went; what was nearest, and what to relax."""
    lines = [f"Nearest: {shortfall.nearest}."] if shortfall.nearest else []
    lines += [f"To relax: {shortfall.advice}."] if shortfall.advice else []
    removed = {reason: count for reason, count in (shortfall.removed or {}).items() if count}
    rows = [(reason, figure(float(count), 6) if count > 10**9 else str(count)) for reason, count in removed.items()]
    if not lines and not rows:
        return []
    return [Section("Where the others went", lines, [Table(("removed by", "candidates"), cut(rows))] if rows else [])]


# ------------------------------------------------------------------------------------------------------------- trains


def assignment_rows(found: TrainFindings) -> list[dict[str, Any]]:
    """The solutions of the whole train as a flat table."""
    return [
        {**one.teeth, **{f"error of {name}": float(each.error) for name, each in one.outputs.items()}}
        for one in found.solutions
    ]


def describe_assignments(found: TrainFindings) -> Document:
    """What was found for the free wheels of a train, part by part."""
    summary = [f"{figure(float(found.count), 6)} assignments of {', '.join(found.wheels)} meet everything."]
    summary += [f"{remark[0].upper()}{remark[1:]}." for remark in found.remarks]
    sections = [section for part in found.parts for section in _part(part)]
    if found.where:
        sections.append(_standings(found.where))
    return Document(f"Tooth numbers of {found.name}", summary, sections)


def _part(part: PartFindings) -> list[Section]:
    """One independent part: what is asked, how many there are, the best of them."""
    requested = "; ".join([*part.demands, *part.rules])
    lines = [f"Asked: {requested}." if requested else "Nothing is asked."]
    within = "" if part.tolerance is None else f" within {figure(float(part.tolerance), 4)}"
    whole = "complete" if part.complete else f"not complete: {part.reason}"
    lines.append(f"{part.count} of {figure(float(part.considered), 6)} assignments{within} ({whole}).")
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
        return Table([*solutions[0].teeth, "greatest error"], cut(rows), wide=True)
    header = [*solutions[0].teeth, *(f"{name}, {what}" for name in outputs for what in ("speed", "error"))]
    rows = [
        [
            *map(str, one.teeth.values()),
            *(text for each in one.outputs.values() for text in (exact(each.speed), error_text(each.error))),
        ]
        for one in solutions
    ]
    return Table(header, cut(rows))


def _standings(standings: Sequence[Standing]) -> Section:
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
    return Section("Where these stand", (), [Table(("teeth", "errors", "rank", "refused by"), rows)])


# ---------------------------------------------------------------------------------------------------- epicyclic sets


def set_rows(found: SetFindings) -> list[dict[str, Any]]:
    """The sets as a flat table."""
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
    """Epicyclic sets for a ratio."""
    summary = [
        f"Wanted: {found.ratio_is} = {exact(found.wanted)} = {figure(found.wanted, 10)}, in any sense unless asked.",
        f"{found.count} sets in their modes run"
        + (" within the tolerance." if found.tolerance is not None else "; the best of them:" if found.count else "."),
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
        header = ("teeth", "mode", "input/output", "error", "planets fit at", "room, modules")
        sections.append(Section("Sets", (), [Table(header, cut(rows))]))
    return Document(f"Sets of the kind {found.kind}", summary, [*sections, *_shortfall(found.shortfall)])


def describe_set_kinds(kinds: Mapping[str, EpicyclicKind]) -> Document:
    """The kinds of epicyclic sets."""
    rows = [
        (kind.name, kind.title, ", ".join(kind.wheels), str(len(kind.modes)), kind.modes[0].key)
        for kind in kinds.values()
    ]
    table = Table(("kind", "what", "wheels", "modes", "such as"), rows)
    return Document("Kinds of epicyclic sets", [], [Section("Kinds", (), [table])])


# ----------------------------------------------------------------------------------------------------------- orreries


def orrery_rows(found: Orrery) -> list[dict[str, Any]]:
    """The pairs of an orrery as a flat table."""
    return [pair.to_dict() for pair in found.pairs]


def describe_orrery(found: Orrery) -> Document:
    """An orrery: its pairs, what each arbor shows, what is proved."""
    proof = "proved to be the fewest" if found.complete else f"at least {found.minimum_wheels} are needed"
    ended = "an interrupt" if found.ended == "interrupted" else found.ended
    summary = [
        f"{found.wheels} wheels in {len(found.pairs)} pairs; {proof}, and at least {found.minimum_pairs} pairs.",
        f"Greatest error {error_text(max(found.errors.values(), key=abs))}. The search ended by {ended}.",
    ]
    shown = {arbor.name: arbor for arbor in found.arbors}
    rows = [
        (
            pair.parent,
            f"{pair.driver} / {pair.driven}",
            pair.child,
            figure(shown[pair.child].period, 12),
            error_text(found.errors[pair.child]) if pair.child in found.errors else "",
            "with" if shown[pair.child].sense > 0 else "against",
        )
        for pair in found.pairs
    ]
    header = ("arbor", "driver / driven", "arbor driven", "period", "error of speed", "sense")
    return Document("Orrery", summary, [Section("Pairs", (), [Table(header, cut(rows))])])
