"""Gearboxes as pages: states by rows, elements and links by columns; and all gears that there are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, exact, figure, result_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_series import GearSearch, GearSeries, PossibleGear
    from geartrain.analysis.gearbox import Gearbox, GearState, ShiftElement

_DIGITS = 5
_MOST = 12  # ways to close elements that are named
_RATIOS = (
    "Ratio: input over output; step: that ratio over the next state's. Recirculating: power that runs round between "
    "gear sets over power in; inside: within one set."
)
_TORQUES = (
    "Over the input's torque, driven from the input: of a brake on what it holds, of a clutch on the first of the two "
    "links that it locks. `open`: statics alone does not give it."
)
_ELEMENTS = "Greatest of all states, in sizes over the input's torque and speed."


def describe_gearbox(found: Gearbox) -> Document:
    """States, speeds, slip and torques of elements, and what each element must bear.

    Parameters
    ----------
    found : Gearbox
        As `GearTrain.gearbox` gives it.

    Returns
    -------
    Document
        Speeds and torques over those of the input.

    Examples
    --------
    >>> import geartrain
    >>> page = describe_gearbox(geartrain.load("simpson-set").gearbox())
    >>> [section.title for section in page.sections]
    ['Gears', 'Speeds', 'Slip of open elements', 'Torques of closed elements', 'Elements']
    """
    return Document(f"Gearbox {found.name}", (found.title,) if found.title else (), tuple(gearbox_sections(found)))


def gearbox_sections(found: Gearbox) -> Iterator[Section]:
    """What `describe_gearbox` tells, as sections of a longer page."""
    names = [each.name for each in found.elements]
    header = ("state", *names, "verdict", "ratio", "step", "efficiency", "recirculating", "inside")
    lines = [f"From '{found.input}' to '{found.output}'. x marks a closed clutch or brake.", _RATIOS]
    if all(each.efficiency in (None, 1) for each in found.states):
        lines.append("No losses are declared: every efficiency is 1.")
    if found.spread is not None:
        lines.append(f"Overall spread of the forward states: {figure(found.spread, _DIGITS)}.")
    double = [f"{each.before} to {each.after}" for each in found.shifts if each.is_double]
    lines.append(f"Double-transition shifts: {', '.join(double) or 'none'}.")
    yield Section("Gears", lines, (Table(header, [_gear(each, names) for each in found.states]),))
    known = dict.fromkeys(link for each in found.states for link in each.speeds)
    links = [link for link in known if _moves(found, link)]
    yield Section("Speeds", (f"Exact. {_unit(found)}",), (_speeds(found.states, links),))
    slips = _by_state(found.states, names, lambda each: each.slips)
    yield Section("Slip of open elements", (_unit(found),), (slips,))
    torques = _by_state(found.states, names, lambda each: each.torques)
    yield Section("Torques of closed elements", (_TORQUES,), (torques,))
    yield Section("Elements", (_ELEMENTS,), (_elements(found),))


def _unit(found: Gearbox) -> str:
    """The unit of the speeds in a table, with the states whose input is at rest."""
    others = {each.state: each.driven_by or "no input, as declared" for each in found.states}
    named = ", ".join(f"{state} ({link})" for state, link in others.items() if link != found.input)
    return "Over the input's speed" + (f"; over that of another link in {named}." if named else ".")


def _moves(found: Gearbox, link: str) -> bool:
    return any(each.speeds.get(link, 1) for each in found.states)


def _gear(each: GearState, names: Sequence[str]) -> tuple[str, ...]:
    figures = (each.ratio, each.step, each.efficiency, each.recirculating, each.inner)
    marks = ("x" if name in each.engaged else "" for name in names)
    return each.state, *marks, each.verdict.kind, *(figure(value, _DIGITS) for value in figures)


def _speeds(states: Sequence[GearState], links: Sequence[str]) -> Table:
    rows = [
        (each.state, *(exact(each.speeds[link]) if link in each.speeds else each.verdict.kind for link in links))
        for each in states
    ]
    return Table(("state", *links), rows, wide=True)


def _by_state(
    states: Sequence[GearState],
    columns: Sequence[str],
    values: Callable[[GearState], Mapping[str, Fraction | None]],
) -> Table:
    def cell(of: Mapping[str, Fraction | None], name: str) -> str:
        if name not in of:
            return ""
        value = of[name]
        return "open" if value is None else figure(value, _DIGITS)

    rows = [(each.state, *(cell(values(each), name) for name in columns)) for each in states]
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
    """All gears, then the series that were asked for.

    Parameters
    ----------
    found : GearSearch
        As `geartrain.analysis.find_gears` gives it.

    Returns
    -------
    Document
        Ratios are input over output.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.analysis import find_gears
    >>> page = describe_gear_search(find_gears(geartrain.load("simpson-set")))
    >>> page.sections[0].tables[0].rows[0]
    ('forward, low', '2.4545', '1')
    """
    summary = (
        f"From '{found.input}' to '{found.output}': {found.closed} elements closed, {found.combinations} ways, "
        f"{len(found.gears)} of which determine the output; all were tried, exactly."
    )
    others = [
        f"{_some(ways)} {told}." for ways, told in ((found.free, "leave it free"), (found.locked, "lock it")) if ways
    ]
    sections = [
        Section("Gears", (summary, *others), (Table(("closed", "ratio", "declared as"), list(map(_row, found.gears))),))
    ]
    if found.widest is not None and found.evenest is not None:
        both = [("The widest series", found.widest), ("The most even series", found.evenest)]
        if found.widest == found.evenest:
            both = [("The widest series, and the most even", found.widest)]
        head = "One series holds." if found.series == 1 else f"{found.series:,} series hold; of each kind one is told."
        sections += [Section(title, (head, *_series(series)), (_series_table(series),)) for title, series in both]
    elif found.requested:
        sections.append(Section("Series", (f"No series of {found.requested} gears has all its steps in the window.",)))
    return Document(f"Gears of {found.name}", (found.title,) if found.title else (), tuple(sections))


def _some(ways: Sequence[Sequence[str]]) -> str:
    """Ways to close elements, not all where there are many."""
    more = f" and {len(ways) - _MOST} more" if len(ways) > _MOST else ""
    return "; ".join(", ".join(way) for way in ways[:_MOST]) + more


def _row(gear: PossibleGear) -> tuple[str, ...]:
    ratio = "held" if gear.ratio is None else figure(gear.ratio, _DIGITS)
    return ", ".join(gear.engaged), ratio, ", ".join(gear.states)


def _series(series: GearSeries) -> Iterator[str]:
    yield (
        f"Spread {figure(series.spread, _DIGITS)}; standard deviation of the logarithms of steps "
        f"{series.deviation:.3g}; double-transition shifts: {series.double_shifts}."
    )


def _series_table(series: GearSeries) -> Table:
    steps = [*(figure(step, _DIGITS) for step in series.steps), "-"]
    rows = [(*_row(gear), step) for gear, step in zip(series.gears, steps, strict=True)]
    return Table(("closed", "ratio", "declared as", "step"), rows)
