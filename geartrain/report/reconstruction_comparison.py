"""Document that compares alternative reconstructions of a train side by side."""

from __future__ import annotations

from collections.abc import Sequence

from geartrain.analysis.gear_train import GearTrain
from geartrain.kinematics.answer import Answer
from geartrain.report.document import Document, ExactText, Section, Table, exact, figure, ppm


def describe_comparison(trains: Sequence[GearTrain], everything: bool = False) -> Document:
    """Return a document that compares trains in columns: output speeds, errors against targets, and tooth counts."""
    columns = [
        (train.name if answer.state is None else f"{train.name} {answer.state}", train, answer)
        for train in trains
        for answer in train.answers()
    ]
    names = _names([answer for _, _, answer in columns], everything)
    header = ("output", *(label for label, _, _ in columns))
    rows = [(name, *(_speed(answer, name) for _, _, answer in columns)) for name in names]
    summary = [f"'{train.name}': {train.declaration.title or 'no title'}." for train in trains]
    units = dict.fromkeys(train.declaration.unit_name or "numbers without a unit" for train in trains)
    open_ = [(label, answer.verdict) for label, _, answer in columns if not answer.verdict]
    summary += [f"'{label}' is {verdict.kind}: {verdict.text}" for label, verdict in open_]
    summary.append(f"Speeds are in {' and '.join(units)}." + (" The units differ." if len(units) > 1 else ""))
    sections = [Section("Outputs", (), (Table(header, rows),))]
    targets = _targets(columns)
    if targets:
        said = ["Positive is fast."]
        if any(row[0].endswith(_MAGNITUDE) for row in targets):
            said.append("By magnitude: the target has no `sense`, so that either sense of rotation meets it.")
        table = Table(("output and target", *header[1:]), targets)
        sections.append(Section("Error against the targets in ppm", tuple(said), (table,)))
    teeth = _teeth(trains)
    if teeth:
        table = Table(("wheel", *(train.name for train in trains)), teeth)
        sections.append(Section("Wheels that differ", (), (table,)))
    return Document("Comparison", summary, sections)


_MAGNITUDE = " (magnitude)"


def _names(answers: Sequence[Answer], everything: bool) -> list[str]:
    results = [result for answer in answers for result in answer.outputs.values()]
    pointers = [result.name for result in results if result.output.dial or result.targets]
    if pointers and not everything:
        return list(dict.fromkeys(pointers))
    links = [link for answer in answers for link in answer.speeds]
    return list(dict.fromkeys([result.name for result in results] or links))


def _speed(answer: Answer, name: str) -> str:
    result = answer.outputs.get(name)
    speed = result.speed if result is not None else answer.speeds.get(name)
    if speed is None:
        return "" if answer.verdict else answer.verdict.kind
    decimal = figure(speed, 7)
    # an exact value that equals its decimal is printed once
    shown = exact(speed) if exact(speed) == decimal else f"{exact(speed)} = {decimal}"
    return ExactText(shown + (" FAILS" if result is not None and not result.holds else ""), speed)


def _targets(columns: Sequence[tuple[str, GearTrain, Answer]]) -> list[tuple[str, ...]]:
    labels: dict[tuple[str, str], str] = {}
    for _, _, answer in columns:
        for name, found in answer.outputs.items():
            for target in found.targets:
                how = labels.setdefault((name, target.label), "")
                # a single target without `sense` is enough to mark its row
                labels[name, target.label] = how if target.goal.signed else _MAGNITUDE
    rows = []
    for (name, label), how in labels.items():
        cells = []
        for _, _, answer in columns:
            result = answer.outputs.get(name)
            own = next((each for each in result.targets if each.label == label), None) if result else None
            # the difference in speed if the target speed is 0
            cells.append("" if own is None else ppm(own.ppm) if own.speed else f"off by {figure(own.error, 7)}")
        rows.append((f"{name}: {label}{how}", *cells))
    return rows


def _teeth(trains: Sequence[GearTrain]) -> list[tuple[str, ...]]:
    wheels = dict.fromkeys(wheel for train in trains for wheel in train.declaration.wheels)
    rows = []
    for wheel in wheels:
        counts = [str(found[1].count) if (found := train.declaration.wheels.get(wheel)) else "" for train in trains]
        # wheels with equal counts in all trains are omitted
        if len(set(counts)) > 1:
            rows.append((wheel, *counts))
    return rows
