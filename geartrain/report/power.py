"""Torques, flow of power and losses of a train, as sections and as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from geartrain.analysis import GearTrain
from geartrain.report.document import Document, Section, Table, figure
from geartrain.torques import Torques, declared_loads

_UNITS = (
    "Torques as loads are given; power is torque times speed in the train's unit, positive into the train; in a pair, "
    "in its carrier's frame."
)


def torques_document(train: GearTrain, found: Sequence[Torques]) -> Document:
    """Torques under the declared loads, one answer a state, and the efficiency there and back."""
    sections = [section for each in found for section in torque_sections(train, each)]
    lead = [f"Train '{train.name}'. {_UNITS}"]
    return Document(f"Torques of {train.name}", lead, sections)


def torque_sections(train: GearTrain, found: Torques) -> Iterator[Section]:
    """Links, pairs and verdict of one state."""
    state = found.state
    head = "Torques" if state is None else f"State {state}: torques"
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    if found.verdict.candidates and not found.verdict:
        lines.append(f"It can be one of {', '.join(found.verdict.candidates)}.")
    lines += _there_and_back(train, state)
    if not found.verdict:
        yield Section(head, lines)
        return
    efficiency, circulating = found.efficiency, found.circulating
    if efficiency is not None and circulating is not None:
        lines.append(
            f"Power in {figure(found.power_in, 9)}, lost {figure(found.loss, 9)}, efficiency {figure(efficiency, 10)}; "
            f"the greatest power through a pair is {figure(circulating, 5)} of it."
        )
    yield Section(head, lines, (_links(found), _pairs(found)))


def _links(found: Torques) -> Table:
    rows = [
        (
            link + (" (asked)" if link in found.asked else ""),
            figure(torque, 9),
            figure(found.speeds[link], 9),
            figure(found.powers[link], 9),
        )
        for link, torque in found.external.items()
    ]
    return Table(("link", "torque", "speed", "power"), rows)


def _pairs(found: Torques) -> Table:
    rows = [
        (
            pair.id + (" (shared)" if pair.loose else ""),
            pair.driver or "idle",
            *(figure(torque, 7) for torque in pair.torques),
            figure(pair.power, 7),
            figure(pair.loss, 7),
        )
        for pair in found.pairs.values()
    ]
    return Table(("pair", "driver", "torque on first", "on second", "on carrier", "power", "loss"), rows)


def ends(train: GearTrain, state: str | None) -> tuple[str, str] | None:
    """The one input and the one link that power leaves by: an output, loaded or alone; None if that is not plain."""
    case = train.declaration.case(state if state is not None or not train.states else train.states[0])
    if len(case.inputs) != 1:
        return None
    (source,) = case.inputs
    links = dict.fromkeys(output.of or name for name, output in case.outputs.items())
    loads = [link for link in declared_loads(train.declaration, case)[0] if link != source]
    chosen = loads if len(loads) == 1 else [link for link in links if link != source]
    return (source, chosen[0]) if len(chosen) == 1 else None


def there_and_back(train: GearTrain, state: str | None) -> list[tuple[Torques, str, str]]:
    """Torques driven from the input, and driven back from the output, each with where power enters and leaves.

    A unit of power leaves; empty where it is not plain which link is the output.
    """
    found = ends(train, state)
    ways = [] if found is None else [found, found[::-1]]
    return [(train.driven(load, source, state), source, load) for source, load in ways]


def _there_and_back(train: GearTrain, state: str | None) -> Iterator[str]:
    for torques, first, last in there_and_back(train, state):
        efficiency = torques.efficiency
        if torques.verdict.kind == "self-locking":
            yield f"'{last}' cannot be driven from '{first}': the train locks."
        elif efficiency is not None:
            word = " (ambiguous)" if torques.verdict.kind == "ambiguous" else ""
            yield f"Efficiency from '{first}' to '{last}': {figure(efficiency, 10)}{word}."


def torques_data(train: GearTrain, found: Torques) -> dict[str, Any]:
    """Torques of one state as plain data with stable keys."""
    ways = zip(("forward", "backward"), there_and_back(train, found.state), strict=False)
    drives = {name: _drive_data(each) for name, (each, _, _) in ways}
    return found.to_dict() | {"drives": drives or None}


def _drive_data(found: Torques) -> dict[str, Any]:
    efficiency: Fraction | None = found.efficiency if found.verdict else None
    return {
        "verdict": found.verdict.to_dict(),
        "efficiency": None if efficiency is None else float(efficiency),
        "exact": None if efficiency is None else str(efficiency),
    }
