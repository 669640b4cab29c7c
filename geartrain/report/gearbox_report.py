"""Documents on gearboxes: a table of the declared states, with columns for clutches, brakes and links, and a list of
all possible gears.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, exact, figure, result_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_series import GearSearch, PossibleGear
    from geartrain.analysis.gearbox import Gearbox, GearState, ShiftElement

_DIGITS = 5  # significant digits of ratios, torques and efficiencies
_MOST = 12  # combinations of closed elements that are listed
_RATIOS = (
    "Ratio: input speed divided by output speed; step: ratio divided by that of the next state. Recirculating: power "
    "that circulates between gear sets, divided by power in; mesh power: maximum power through a pair in "
    "the frame of its carrier, divided by power in."
)
_TORQUES = (
    "Torques divided by the input torque, driven from the input: of a brake on the link it holds, of a clutch on the "
    "first of the two links it locks. `open`: not determined by statics."
)
_ELEMENTS = "Maximum magnitudes over all states, relative to the torque and speed of the input."


def describe_gearbox(found: Gearbox) -> Document:
    """Return a document on a gearbox: ratios, speeds, slip and torques by state, and maximum load of each clutch."""
    return Document(f"Gearbox {found.name}", (found.title,) if found.title else (), tuple(gearbox_sections(found)))


def gearbox_sections(found: Gearbox) -> Iterator[Section]:
    """Yield the sections of `describe_gearbox`, for use in a longer document."""
    names = [each.name for each in found.elements]
    header = ("state", *names, "verdict", "ratio", "step", "efficiency", "recirculating", "mesh power")
    lines = [f"From '{found.input}' to '{found.output}'. x marks a closed clutch or brake.", _RATIOS]
    if any(each.kind.startswith("one-way") for each in found.elements):
        lines.append("* marks a one-way clutch that holds (only while the input drives).")
    if all(each.efficiency in (None, 1) for each in found.states):
        lines.append("No losses are declared: every efficiency is 1.")
    if found.spread is not None:
        lines.append(f"Overall spread of the forward states: {figure(found.spread, _DIGITS)}.")
    double = [f"{each.before} to {each.after}" for each in found.shifts if each.is_double]
    lines.append(f"Double-transition shifts: {', '.join(double) or 'none'}.")
    yield Section("Gears", lines, (Table(header, [_gear(each, names) for each in found.states]),))
    # links in the order of their first occurrence
    known = dict.fromkeys(link for each in found.states for link in each.speeds)
    # links at rest in every state have no column; a missing speed counts as motion
    links = [link for link in known if any(each.speeds.get(link, 1) for each in found.states)]
    yield Section("Speeds", (f"Exact. {_unit(found)}",), (_speeds(found.states, links),))
    yield Section("Slip of open elements", (_unit(found),), (_by_state(found.states, names, "slips"),))
    yield Section("Torques of closed elements", (_TORQUES,), (_by_state(found.states, names, "torques"),))
    yield Section("Elements", (_ELEMENTS,), (_elements(found),))


def _unit(found: Gearbox) -> str:
    """Return a sentence on the unit of speeds, which lists states in which this unit is not the speed of the input."""
    others = {each.state: each.driven_by or "no input, as declared" for each in found.states}
    named = ", ".join(f"{state} ({link})" for state, link in others.items() if link != found.input)
    return "Relative to the input speed" + (f"; relative to another link's in {named}." if named else ".")


def _gear(each: GearState, names: Sequence[str]) -> tuple[str, ...]:
    figures = (each.ratio, each.step, each.efficiency, each.recirculating, each.mesh_power)
    marks = ("*" if name in each.one_way else "x" if name in each.engaged else "" for name in names)
    return each.state, *marks, each.verdict.kind, *(figure(value, _DIGITS) for value in figures)


def _speeds(states: Sequence[GearState], links: Sequence[str]) -> Table:
    rows = [
        (each.state, *(exact(each.speeds[link]) if link in each.speeds else each.verdict.kind for link in links))
        for each in states
    ]
    return Table(("state", *links), rows, wide=True)


def _by_state(states: Sequence[GearState], columns: Sequence[str], field: str) -> Table:
    """Return a table of a field that maps names to numbers, with a row for each state and a column for each name."""
    rows = []
    for each in states:
        values = getattr(each, field)
        cells = {name: "open" if value is None else figure(value, _DIGITS) for name, value in values.items()}
        rows.append((each.state, *(cells.get(name, "") for name in columns)))
    return Table(("state", *columns), rows)


def _elements(found: Gearbox) -> Table:
    def closed(each: ShiftElement) -> str:
        return f"{len(each.states)} of {len(found.states)}: {', '.join(each.states)}" if each.states else "none"

    return result_table(
        found.elements,
        *("element=name", "kind", ("closed in", closed)),
        *(f"torque:{_DIGITS}", "in=torque_state", f"slip:{_DIGITS}", "in=slip_state"),
    )


def describe_gear_search(found: GearSearch) -> Document:
    """Return a document on all possible gears of a gearbox, and on the requested series of gears."""
    summary = (
        f"From '{found.input}' to '{found.output}': {found.combinations} combinations of {found.closed} closed "
        f"elements, of which {len(found.gears)} determine the output (exhaustive exact search)."
    )
    others = []
    for ways, effect in ((found.free, "free"), (found.locked, "locked")):
        more = f" and {len(ways) - _MOST} more" if len(ways) > _MOST else ""
        if ways:
            others.append(f"The output is {effect} with: {'; '.join(', '.join(way) for way in ways[:_MOST])}{more}.")
    table = Table(("closed", "ratio", "declared as"), list(map(_row, found.gears)))
    sections = [Section("Gears", (summary, *others), (table,))]
    if found.widest is not None and found.evenest is not None:
        both = [("The widest series", found.widest), ("The most even series", found.evenest)]
        # one series is both, so it is printed once
        if found.widest == found.evenest:
            both = [("The widest series, and the most even", found.widest)]
        head = f"{found.series:,} series meet the conditions; one of each kind is shown."
        head = "One series meets the conditions." if found.series == 1 else head
        for title, series in both:
            text = (
                f"Spread {figure(series.spread, _DIGITS)}; standard deviation of the logarithms of steps "
                f"{series.deviation:.3g}; double-transition shifts: {series.double_shifts}."
            )
            steps = [*(figure(step, _DIGITS) for step in series.steps), "-"]
            rows = [(*_row(gear), step) for gear, step in zip(series.gears, steps, strict=True)]
            table = Table(("closed", "ratio", "declared as", "step"), rows)
            sections.append(Section(title, (head, text), (table,)))
    elif found.requested:
        text = f"No series of {found.requested} gears has all its steps in the requested range."
        sections.append(Section("Series", (text,)))
    return Document(f"Gears of {found.name}", (found.title,) if found.title else (), tuple(sections))


def _row(gear: PossibleGear) -> tuple[str, ...]:
    ratio = "held" if gear.ratio is None else figure(gear.ratio, _DIGITS)
    return ", ".join(gear.engaged), ratio, ", ".join(gear.states)
