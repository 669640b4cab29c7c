"""Document on one train, its graph as tables, and the document as an HTML page to share.

A page to share shows the verdict as a badge, pictures, wheels with their sources, and the animated train. Teeth, loads
and motion are described in separate modules, which are imported only if a train declares them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from math import degrees
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError
from geartrain.kinematics.answer import Answer, abridged_names
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.graph import MOST_SQUARE, adjacency_kinds, adjacency_labels, edge_rows
from geartrain.numerics.exact import abridged_text, plural
from geartrain.report.answers import answer_sections, doubtful_wheels, expectations_met, shift_table
from geartrain.report.couplings import coupling_sections, varying_section
from geartrain.report.document import (
    MOST_ROWS,
    CitedText,
    Document,
    PageExtras,
    Picture,
    Section,
    SourceReference,
    Table,
    cut,
    exact,
    filled_table,
    titled,
    without_details,
)
from geartrain.report.formula_report import formula_section
from geartrain.report.train_data import TrainReport
from geartrain.train import Train, Wheel
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.dynamics.clock_rate import Timekeeping
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import Mobility
    from geartrain.train.fusees import FuseeSpring

_CIRCUITS_ABREAST = 6  # columns of circuits that fit into one table
_MOST_SPACED, _MOST_LETTERS = 32, 72  # maximum links of a matrix with blanks between columns, and of any matrix
_MOST_CARRIERS = 4  # maximum number of carriers named in a summary
_LETTERS = {"": ".", "revolute": "R", "prismatic": "P", "gear": "G", "several": "+"}
SOURCES = "Sources"
"""Title of the section of references; an HTML page has a list of links instead."""

_MOST_SHORT = 30  # rows of the table of a notebook
_MATRIX = "Adjacency matrix"
_SIDES = ("above", "below", "behind")  # viewing sides that are written without an article


def describe_train(found: TrainReport) -> Document:
    """Return the report on a train: outputs, speeds, torques, strength and motion, then structure and errata."""
    train, answers = found.train, found.states
    declared = train.declaration
    held = [f"{line[0].upper()}{line[1:]}." for line in train.kinematics.gridlock.lines()]
    sections = [
        *_answers(train, answers),
        *_findings(train),
        *_loaded(found),
        *doubtful_wheels(train, answers),
        Section("Mobility", [_circuits_in_short(train), *_mobility_lines(train.mobility, held)]),
        *_adjacency(train),
        *(replace(section, detail=True) for section in _details(found)),
    ]
    return Document(declared.title or declared.name, tuple(_summary(train, answers)), sections)


def describe_answers(found: TrainReport) -> Document:
    """Return the report on a train without its detail sections (formulas, circuits, structure, errata, sources)."""
    return without_details(describe_train(found))


def describe_in_short(train: GearTrain) -> Document:
    """Return a short document for a notebook: the verdict on a train and the table of its outputs or states."""
    answers, declared = list(train.answers()), train.declaration
    name = f"{declared.name}: {declared.title}" if declared.title else declared.name
    summary = [line for line in _summary(train, answers) if "Verdict:" in line or line.startswith("Speeds are")]
    first = next(_answers(train, answers))
    tables = [replace(table, rows=cut(table.rows, most=_MOST_SHORT)) for table in first.tables]
    return Document(name, summary, [replace(first, tables=tables)])


def _details(found: TrainReport) -> Iterator[Section]:
    """Yield the detail sections: formulas, structure, circuits, phases, named adjacency matrix, errata, sources."""
    train, declared = found.train, found.train.declaration
    explained = True  # the notation of formulas is explained once
    for answer in found.states:
        if answer.verdict.kind != "refused":
            formulas = tuple(formula_section(train, answer.state, explained=explained))
            explained = explained and not formulas
            yield from formulas
    yield from _structure(train)
    yield _circuits(train)
    yield from coupling_sections(train)
    yield from _phasing(found.closure)
    if len(declared.links) <= MOST_SQUARE:
        others = "gear pairs and couplings" if declared.couplings else "gear pairs"
        slides = ", P(axis) a sliding pair" if declared.slides else ""
        text = f"R(axis) is a turning pair{slides}; the other entries are {others} by name."
        yield Section("Adjacency matrix by names", (text,), (adjacency_table(train),))
    if declared.errata:
        rows = [(e.place, e.printed, e.right, e.why) for e in declared.errata]
        yield Section("Errata of the sources", (), (Table(("place", "printed", "right", "why"), rows),))
    if declared.sources:
        lines = []
        for key, source in declared.sources.items():
            lines.append(f"Source {key}: {source.cite}" + (f" ({source.note})" if source.note else "") + ".")
        yield Section(SOURCES, lines)


def _answers(train: GearTrain, answers: Sequence[Answer]) -> Iterator[Section]:
    """Yield the sections on outputs, targets and speeds of each state; tables of all states come first."""
    box = None
    if train.declaration.clutches and train.states:
        with suppress(GearTrainError):  # not a valid gearbox
            box = train.gearbox()
    if box is not None:
        from geartrain.report.gearbox_report import gearbox_sections

        yield from gearbox_sections(box)
    elif train.states:
        yield shift_table(train, answers)
    for answer in answers:
        sections = list(answer_sections(train, answer))
        if box is None or not answer.verdict:
            yield from sections
        else:  # the tables of a gearbox already have all speeds and ratios
            yield from (replace(section, detail=True) for section in sections[:-1])


def _findings(train: GearTrain) -> Iterator[Section]:
    if train.build_findings:
        head = "An error prevents building as declared; a note is a warning or names an undeclared detail."
        findings = [(each.rule, each.level, each.problem.text) for each in train.build_findings]
        yield Section("Buildability", (head,), (Table(("rule", "level", "what, why, and what to do"), findings),))
    if train.kinematics.remarks:
        notes = (": ".join(filter(None, (remark.what, remark.why))) for remark in train.kinematics.remarks)
        yield Section("Remarks", [f"{note}." for note in notes])


def _loaded(found: TrainReport) -> Iterator[Section]:
    """Yield the sections on teeth, torques, strength and motion. Their modules are imported only if needed."""
    if found.teeth or found.pins:
        from geartrain.report.gear_pairs import teeth_sections

        yield from teeth_sections(found.train, found.teeth, found.pins)
    if found.couplings:
        yield varying_section(found.couplings)
    yield from _fusees(found.train)
    if found.torques:
        from geartrain.report.torque_report import loaded_sections

        yield from loaded_sections(found.torques)
    for clock in found.timekeeping:
        yield timekeeping_section(clock)
    for strength in found.strength:
        yield from wing("simulation.strength.strength_report").strength_sections(strength)
    if found.motion or found.teeth:
        from geartrain.report.motion_report import moving_sections

        yield from moving_sections(found.train, found.motion, bool(found.teeth))


def _fusees(train: GearTrain) -> Iterator[Section]:
    """Yield a section on each spring with a fusee, with its torque when fully wound, at the end, and at the maximum."""
    runs: dict[FuseeSpring, str | None] = {}
    for state in train.states or (None,):
        drive = train.declaration.case(state).drive
        if drive is not None and drive.spring is not None and (chained := drive.spring.chained) is not None:
            runs.setdefault(chained, state)
    for chained, state in runs.items():
        run = chained.run()
        rows = [
            ("torque, fully wound", f"{run.first:.6g} N m"),
            ("torque at the end", f"{run.last:.6g} N m"),
            ("maximum torque", f"{run.maximum:.6g} N m after {run.maximum_at:.4g} turns"),
            ("minimum torque", f"{run.minimum:.6g} N m after {run.minimum_at:.4g} turns"),
            ("mean torque", f"{run.mean:.6g} N m"),
        ]
        if chained.constant is not None:
            rows = [("torque", f"{run.mean:.6g} N m")]
        rows += [
            ("radius of the fusee", f"{1000 * run.radii[0]:.5g} mm to {1000 * run.radii[1]:.5g} mm"),
            ("length of chain", f"{1000 * run.chain:.6g} mm"),
            ("winding left", f"{run.left:.5g} turns"),
            ("energy", f"{run.energy:.6g} J"),
        ]
        text = f"Torque of the spring at its fusee over {chained.turns:g} turns of the fusee, without friction."
        yield Section(titled(state, "fusee"), (text,), (Table(("quantity", "value"), rows),))


def _summary(train: GearTrain, answers: Sequence[Answer]) -> Iterator[str]:
    declared = train.declaration
    for answer in answers:
        if not answer.verdict:
            state = f"State {answer.state}: " if answer.state is not None else ""
            expected = "as expected, " if answer.as_expected else ""
            yield f"{state}Verdict: {expected}{answer.verdict} ({answer.place})."
    if all(answer.as_expected for answer in answers) and any(answer.verdict for answer in answers):
        held = expectations_met(answers)
        yield f"Verdict: determined; {held}." if held else "Verdict: determined."
    unit = declared.unit_name
    side = declared.view.from_ or ""
    seen = side if side in _SIDES else f"the {side}"
    clock = f"; positive is {declared.view.positive} seen from {seen}" if side else ""
    slides = f"; slides in {declared.travel_unit}{'' if unit else ' per turn'}" if declared.sliding else ""
    yield (
        f"Speeds are in {unit}" if unit else "Speeds are numbers without a unit"
    ) + f"{slides}, absolute, about each link's own axis{clock}."
    yield f"Train '{declared.name}'" + (f", an extension of '{declared.extends}'." if declared.extends else ".")
    if declared.note:
        yield declared.note
    if train.kinematics.joint_sums:
        yield (
            "The speed of a link whose axis is carried about a non-parallel axis is a sum of joint speeds, not a "
            "rotation about one axis."
        )


def _structure(train: GearTrain) -> Iterator[Section]:
    declared = train.declaration
    parts = (declared.revolutes, declared.slides, declared.gears, declared.couplings, declared.wheels)
    counts = tuple(map(len, parts))
    nouns = ("turning pair", "sliding pair", "gear pair", "coupling", "wheel")
    counted = ", ".join(plural(count, noun) for count, noun in zip(counts, nouns, strict=True) if count)
    text = f"{len(declared.links)} links (the frame is '{declared.frame}'), {counted}."
    rows = []
    for name, link in declared.links.items():
        copies = f"{link.copies} equal copies" if link.copies > 1 else ""
        note = "; ".join(filter(None, (copies, link.note)))
        rows.append((name, _wheels(link.wheels), _joint(train, name), note))
    moves = "turns or slides in (axis)" if declared.sliding else "turns in (axis)"
    table = filled_table(("link", "wheels and teeth", moves, "note"), rows, 3)
    yield Section("Structure", (text,), (replace(table, rows=cut(table.rows)),))


def _adjacency(train: GearTrain) -> Iterator[Section]:
    """Yield a section with the adjacency matrix, one letter per cell; nothing if it is wider than a line."""
    links = list(train.declaration.links)
    if len(links) > _MOST_LETTERS:
        return
    gap = " " if len(links) <= _MOST_SPACED else ""
    cells = [[_LETTERS.get(kind, "C") for kind in row] for row in adjacency_kinds(train.declaration)]
    # only the last digit, so that every column is one character wide
    head = gap.join(str(at % 10) for at in range(1, len(links) + 1))
    rows = [(f"{at} {link}", gap.join(row)) for at, (link, row) in enumerate(zip(links, cells, strict=True), 1)]
    couplings = ", C coupling" if train.declaration.couplings else ""
    slides = ", P sliding pair" if train.declaration.slides else ""
    text = f"R turning pair{slides}, G gear pair{couplings}, + several; columns by last digit."
    yield Section(_MATRIX, (text,), (Table(("link", head), rows, wide=True),))


def _wheels(wheels: dict[str, Wheel]) -> str:
    return ", ".join(f"{name} {wheel.count}{_mark(wheel)}" for name, wheel in wheels.items()) or "-"


def _mark(wheel: Wheel) -> str:
    words: list[str] = [] if wheel.kind == "spur" else [wheel.kind]
    if wheel.is_helical:
        words.append(f"helical {abs(degrees(wheel.helix)):.6g} deg {wheel.hand or ''}".rstrip())
    if wheel.internal:
        words.append("ring")
    if wheel.uncertainty:
        words.append(f"{min(wheel.uncertainty.allowed)}-{max(wheel.uncertainty.allowed)}")
    if wheel.status in ("reconstructed", "hypothetical"):
        words.append(wheel.status)
    return f" ({', '.join(words)})" if words else ""


def _joint(train: GearTrain, link: str) -> str:
    parent = train.kinematics.tree.parent.get(link)
    return f"{train.kinematics.tree.top[link]} ({parent[1]})" if parent else "the frame"


def _circuits(train: GearTrain) -> Section:
    shown = train.circuits[:MOST_ROWS]
    starts = range(0, len(shown), _CIRCUITS_ABREAST)
    tables = [_abreast(train.declaration, shown[at : at + _CIRCUITS_ABREAST]) for at in starts]
    pairs = "gear pair and coupling" if train.declaration.couplings else "gear pair"
    text = f"One circuit for each {pairs}, of bodies i and j with carrier k: tau = (w_i - w_k)/(w_j - w_k)."
    more = [f"{len(train.circuits) - MOST_ROWS} more circuits are not shown."] if train.circuits[MOST_ROWS:] else []
    return Section("Fundamental circuits", (text, *more), tables)


def _abreast(declared: Train, circuits: Sequence[Circuit]) -> Table:
    """Return a table with a column for each fundamental circuit: its links, carrier, tooth counts and ratio."""
    from geartrain.teeth.coupling import coupling_model

    wheels = declared.wheels

    def teeth(circuit: Circuit, side: int) -> str:
        name = circuit.wheels[side]
        if not circuit.by_teeth:
            return coupling_model(circuit.kind).SIDES[side]
        return f"{name} {wheels[name][1].count}"

    rows = [
        ("body i", *(circuit.i for circuit in circuits)),
        ("body j", *(circuit.j for circuit in circuits)),
        ("body k", *(circuit.carrier for circuit in circuits)),
        ("Z_i", *(teeth(circuit, 0) for circuit in circuits)),
        ("Z_j", *(teeth(circuit, 1) for circuit in circuits)),
        ("tau", *(exact(circuit.ratio) + (" mm" if circuit.travels else "") for circuit in circuits)),
    ]
    return Table(("", *(circuit.id for circuit in circuits)), rows)


def _circuits_in_short(train: GearTrain) -> str:
    carriers = Counter(circuit.carrier for circuit in train.circuits).most_common()
    named = ", ".join(f"{count} with carrier '{link}'" for link, count in carriers[:_MOST_CARRIERS])
    # carriers that are not named are only counted
    rest = sum(count for _, count in carriers[_MOST_CARRIERS:])
    number = plural(len(train.circuits), "fundamental circuit")
    return f"{number}: {named}{f', {rest} with other carriers' if rest else ''}." if carriers else f"{number}."


def _mobility_lines(found: Mobility, held: Sequence[str] = ()) -> Iterator[str]:
    """Yield sentences on mobility by count and by rank, redundant circuits, locked links, and the resting links."""
    minus = f" - {plural(found.couplings, 'coupling')}" if found.couplings else ""
    slides = f" + {plural(found.sliding_pairs, 'sliding pair')}" if found.sliding_pairs else ""
    pairs = f"{plural(found.turning_pairs, 'turning pair')}{slides} - {plural(found.gear_pairs, 'gear pair')}{minus}"
    yield f"By count: {pairs} = {found.by_count}."
    # a rank modulo a prime may be lower than the true rank
    exact = " (exact)." if found.certain else " (rank modulo two primes)."
    yield f"By rank: {found.links} links - 1 - rank {found.rank} = {found.by_rank}{exact}"
    if found.redundant:
        many = "circuit" if found.redundant == 1 else "circuits"
        yield f"{found.redundant} redundant {many}, implied by the others."
    # large trains have hundreds of redundant loops
    for loop in found.loops[:12]:
        links, pairs = abridged_names(loop.links, " - "), abridged_names(loop.pairs)
        yield f"Redundant: loop {links} by {pairs}, ratio product {abridged_text(loop.product)}."
    if len(found.loops) > 12:
        yield f"... and {len(found.loops) - 12} more redundant loops."
    yield from (f"Redundant: the circuits that meet at link '{link}' are dependent." for link in found.shared[:12])
    yield from held
    if found.idle:
        yield f"Pairs that never roll: {', '.join(found.idle[:20])}."
    if found.still and found.by_rank:
        yield f"Links at rest in every motion: {', '.join(found.still[:20])}."


def phasing_document(closure: MeshPhasing) -> Document:
    """Return a document on the phase closure of a train's loops."""
    sections = list(_phasing(closure)) or [Section("Phase closure", ("The train has no loop to check.",))]
    return Document("Phase closure", (), sections)


def mobility_document(found: Mobility) -> Document:
    """Return a document on the mobility of a train, without the causes of locking."""
    return Document("Mobility", (), [Section("Mobility", list(_mobility_lines(found)))])


def _phasing(closure: MeshPhasing | None) -> Iterator[Section]:
    """Yield a section on phase closure; yield nothing if the axes have no positions or the pairs do not form a loop."""
    if closure is None or closure.kind == "open":
        return
    rows = [(link, f"{degrees(angle):.6f}") for link, angle in closure.angles.items()]
    text = "With the zero marks of links at these angles, every tooth faces a gap; wheels have a tooth at the mark."
    lines = [line.strip() for line in closure.text.splitlines()]
    yield Section("Phase closure", (*lines, text), (Table(("link", "angle (deg)"), cut(rows)),))


# ---------------------------------------------------------------------------------------------------------------- graph


def adjacency_table(train: GearTrain) -> Table:
    """Return the adjacency matrix of links: R(axis) for turning pairs, names for gear pairs and couplings."""
    names = list(train.declaration.links)
    cells = adjacency_labels(train.declaration)
    return Table(("", *names), [(name, *row) for name, row in zip(names, cells, strict=True)], wide=True)


def describe_adjacency(train: GearTrain) -> Document:
    """Return a document that contains only the adjacency matrix of a train."""
    return Document(f"Adjacency of {train.name}", (), (Section("Matrix", (), (adjacency_table(train),)),))


def describe_edges(train: GearTrain) -> Document:
    """Return a document with the edge list of a train: one row for each turning pair, gear pair and coupling."""
    table = Table(("link", "link", "connected by", "axis or pair"), edge_rows(train.graph))
    return Document(f"Edges of {train.name}", (), (Section("Edges", (), (table,)),))


# -------------------------------------------------------------------------------------------------------- page to share


def describe_shared_page(
    found: TrainReport, pictures: Sequence[Picture] = (), viewer: str = "", notes: Sequence[str] = ()
) -> Document:
    """Return the report on a train for an HTML page, with pictures, viewer, verdict badge and linked sources."""
    document, declared = describe_train(found), found.train.declaration
    badge, sound = _badge(found)
    wheels = tuple(_wheels_with_sources(declared))
    references = {
        key: SourceReference(each.cite, each.url or "", each.note or "") for key, each in declared.sources.items()
    }
    folded = tuple(replace(section, detail=True) for section in wheels)
    aside = PageExtras(badge, sound, tuple(notes), tuple(pictures), viewer, folded, references)
    shown = [section for section in document.sections if section.title != SOURCES]
    shown = [replace(section, detail=section.detail or section.title == _MATRIX) for section in shown]
    return replace(document, sections=shown, aside=aside)


def _badge(found: TrainReport) -> tuple[str, bool]:
    """Return the worst verdict on a train as a short text, and True if the train is as expected."""
    train, answers = found.train, found.states
    wrong = [answer for answer in answers if not answer.as_expected]
    if wrong:
        kind = wrong[0].verdict.kind
        return (f"{kind} in {len(wrong)} of {len(answers)} states" if train.states else kind), False
    if train.mechanics.faults:
        return "teeth cannot turn", False
    failed = sum(len(answer.failures) + sum(each.fails for each in answer.one_way) for answer in answers)
    if failed:
        return f"{failed} expectation{'' if failed == 1 else 's'} failed", False
    kinds = dict.fromkeys(answer.verdict.kind for answer in answers)
    return " or ".join(kinds) + (" as expected" if [*kinds] != ["determined"] else ""), True


def _wheels_with_sources(declared: Train) -> Iterator[Section]:
    """Yield a table of wheels with sources, status and notes; nothing if only tooth counts are declared."""
    rows = []
    for name, (link, wheel) in declared.wheels.items():
        uncertainty = wheel.teeth if not isinstance(wheel.teeth, int) else None
        source = wheel.source or (uncertainty.source if uncertainty else None) or ""
        counts = uncertainty.allowed if uncertainty else ()
        allowed = "" if not counts else f"{min(counts)}-{max(counts)}"
        note = "; ".join(filter(None, (wheel.note, uncertainty.note if uncertainty else None)))
        rows.append((name, link, str(wheel.count), allowed, wheel.status or "", CitedText(source), note))
    header = ("wheel", "link", "teeth", "allowed", "status", "source", "note")
    table = filled_table(header, rows, 3)
    # the first three columns are in the structure already
    if len(table.header) > 3:
        yield Section("Wheels and their sources", (), (replace(table, rows=cut(table.rows)),))


_PER_DAY = 86400.0


def timekeeping_section(found: Timekeeping) -> Section:
    """Return a section on the energy, the amplitude and the rate of a clock in one state."""
    lines = [f"{verdict}."] if (verdict := _verdict(found)) else []
    lines.append(
        "Friction of pivots is included only as declared by `bearing`. Rates are for a constant amplitude; friction on "
        "the dead faces, backlash of the crutch and air drag are not modelled."
    )
    return Section(titled(found.state, "timekeeping"), lines, (Table(("quantity", "value"), list(_rows(found))),))


def _verdict(found: Timekeeping) -> str:
    if found.efficiency <= 0:
        return f"The clock does not go: friction takes all of the torque at '{found.source}'"
    if found.goes is None:
        return ""
    needed = _torque(found, found.minimum_torque) if found.minimum_weight is None else f"{found.minimum_weight:.4g} kg"
    return f"The clock {'goes' if found.goes else 'does not go'}: at least {needed} is needed at '{found.source}'"


def _torque(found: Timekeeping, size: float | None) -> str:
    return "" if size is None else f"{size:.6g} {'N' if found.slides else 'N m'}"


def _rows(found: Timekeeping) -> Iterator[tuple[str, str]]:
    kind = "force" if found.slides else "torque"
    yield f"{kind} at {found.source}", _torque(found, found.torque)
    yield f"power at {found.source}", f"{1e6 * found.power:.6g} uW"
    yield "efficiency up to the escape wheel", f"{found.efficiency:.6f}"
    if found.lost_in_bearings:
        yield "lost in pivots", f"{100 * found.lost_in_bearings:.4g} %"
    yield "energy per beat", f"{1e6 * found.beat_energy:.6g} uJ"
    if found.amplitude is not None:
        yield "amplitude of the pendulum", f"{degrees(found.amplitude):.5g} deg"
    if found.minimum_torque is not None:
        yield f"minimum {kind} at {found.source}", _torque(found, found.minimum_torque)
    if found.minimum_weight is not None:
        yield "minimum weight", f"{found.minimum_weight:.4g} kg"
    if found.descent is not None:
        yield "descent of the weight", f"{1000 * _PER_DAY * found.descent:.6g} mm/day"
    if found.going_time is not None:
        yield "going time", f"{found.going_time / _PER_DAY:.5g} days"
    rates = (
        ("rate, circular error", found.circular, "s/day"),
        ("rate, escapement error", found.escapement, "s/day"),
        ("rate, thermal expansion", found.thermal, "s/day per kelvin"),
    )
    yield from ((what, f"{rate:+.4g} {unit}") for what, rate, unit in rates if rate is not None)
