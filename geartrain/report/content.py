"""What a report on one train says, section by section."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.analysis import GearTrain
from geartrain.answer import Answer
from geartrain.circuits import Circuit
from geartrain.errors import Loop
from geartrain.outputs import OutputResult, Sensitivity, magnitude
from geartrain.report.document import Document, Section, Table, exact, figure, one_to, ppm
from geartrain.train import Train, Wheel

MOST_ROWS = 120
"""Longer tables are cut, and say so; the JSON has everything."""
MOST_MATRIX = 48
"""Trains with more links get their adjacency matrix from 'geartrain graph' only."""
_CIRCUITS_ABREAST = 6


def report_train(train: GearTrain) -> Document:
    """Structure, circuits, mobility, speeds, outputs, doubts and errata of one train."""
    declared = train.declaration
    answers = tuple(train.answers())
    sections = [*_structure(train), _circuits(train), _mobility(train)]
    if train.states:
        sections.append(_shift_table(train, answers))
    for answer in answers:
        sections += _answer(train, answer)
    sections += _doubts(train, answers)
    if declared.errata:
        rows = [(e.place, e.printed, e.right, e.why) for e in declared.errata]
        sections.append(Section("Errata of the sources", (), (Table(("place", "printed", "right", "why"), rows),)))
    return Document(declared.title or declared.name, tuple(_lead(train, answers)), tuple(sections))


def _lead(train: GearTrain, answers: Sequence[Answer]) -> Iterator[str]:
    declared = train.declaration
    yield f"Train '{declared.name}'" + (f", a change of '{declared.extends}'." if declared.extends else ".")
    if declared.note:
        yield declared.note
    for key, source in declared.sources.items():
        yield f"Source {key}: {source.cite}" + (f" ({source.note})" if source.note else "") + "."
    failed = sum(len(answer.failures) for answer in answers)
    for answer in answers:
        if not answer.verdict:
            state = f"State {answer.state}: " if answer.state is not None else ""
            yield f"{state}Verdict: {answer.verdict} ({answer.place})."
    if all(answer.verdict for answer in answers):
        expected = sum(result.expect_holds is not None for answer in answers for result in answer.outputs.values())
        held = f"all {expected} expectations hold" if not failed else f"{failed} of {expected} expectations FAIL"
        yield f"Verdict: determined; {held}." if expected else "Verdict: determined."
    unit = declared.unit_name
    clock = f"; positive is {declared.view.positive} seen from the {declared.view.from_}" if declared.view.from_ else ""
    yield (
        f"Speeds are in {unit}" if unit else "Speeds are plain numbers"
    ) + f", absolute, about each link's own axis{clock}."


def _structure(train: GearTrain) -> Iterator[Section]:
    declared = train.declaration
    wheels = sum(len(link.wheels) for link in declared.links.values())
    couplings = f"{len(declared.couplings)} coupling{'' if len(declared.couplings) == 1 else 's'}"
    counts = (
        f"{len(declared.links)} links (the frame is '{declared.frame}'), {len(declared.revolutes)} turning pairs, "
        f"{len(declared.gears)} gear pairs, {couplings}, "
        f"{wheels} wheels."
    )
    rows = [(name, _wheels(link.wheels), _joint(train, name), link.note or "") for name, link in declared.links.items()]
    notes = any(row[3] for row in rows)
    header = ("link", "wheels and teeth", "turns in (axis)", "note")
    table = Table(header if notes else header[:3], _cut([row if notes else row[:3] for row in rows]))
    yield Section("Structure", (counts,), (table,))
    if len(declared.links) <= MOST_MATRIX:
        from geartrain.graph import adjacency_labels

        cells = adjacency_labels(train.graph)
        names = list(train.graph)
        matrix = Table(("", *names), [(name, *row) for name, row in zip(names, cells, strict=True)], wide=True)
        yield Section(
            "Adjacency matrix",
            ("R(axis) is a turning pair, the others are gear pairs and couplings by id.",),
            (matrix,),
        )


def _wheels(wheels: dict[str, Wheel]) -> str:
    return ", ".join(f"{name} {wheel.count}{_mark(wheel)}" for name, wheel in wheels.items()) or "-"


def _mark(wheel: Wheel) -> str:
    words: list[str] = [] if wheel.kind == "spur" else [wheel.kind]
    if wheel.internal:
        words.append("ring")
    if wheel.doubt:
        words.append(f"{min(wheel.doubt.allowed)}-{max(wheel.doubt.allowed)}")
    if wheel.status in ("reconstructed", "hypothetical"):
        words.append(wheel.status)
    return f" ({', '.join(words)})" if words else ""


def _joint(train: GearTrain, link: str) -> str:
    parent = train.tree.parent.get(link)
    return f"{train.tree.top[link]} ({parent[1]})" if parent else "the frame"


def _cut(rows: Sequence[Sequence[str]]) -> list[Sequence[str]]:
    if len(rows) <= MOST_ROWS:
        return list(rows)
    return [*rows[:MOST_ROWS], (f"... {len(rows) - MOST_ROWS} more", *("" for _ in rows[0][1:]))]


def _circuits(train: GearTrain) -> Section:
    shown = train.circuits[:MOST_ROWS]
    tables = [
        _abreast(train.declaration, shown[at : at + _CIRCUITS_ABREAST])
        for at in range(0, len(shown), _CIRCUITS_ABREAST)
    ]
    text = "One circuit for each gear pair and coupling, k its carrier: tau = (w_i - w_k)/(w_j - w_k)."
    notes = tuple(f"{circuit.id}: {circuit.note}." for circuit in train.circuits if circuit.note)
    more = (
        (f"{len(train.circuits) - MOST_ROWS} more circuits are not shown.",) if len(train.circuits) > MOST_ROWS else ()
    )
    return Section("Fundamental circuits", (text, *notes, *more), tables)


def _abreast(declared: Train, circuits: Sequence[Circuit]) -> Table:
    """Circuits side by side, one row each for bodies, carrier, teeth and ratio."""
    wheels = declared.wheels

    def teeth(circuit: Circuit, side: int) -> str:
        name = circuit.wheels[side]
        if circuit.kind != "gear":
            return ("slot", "pin")[side]
        return f"{name} {wheels[name][1].count}"

    rows = [
        ("body i", *(circuit.i for circuit in circuits)),
        ("body j", *(circuit.j for circuit in circuits)),
        ("body k", *(circuit.carrier for circuit in circuits)),
        ("Z_i", *(teeth(circuit, 0) for circuit in circuits)),
        ("Z_j", *(teeth(circuit, 1) for circuit in circuits)),
        ("tau", *(str(circuit.ratio) for circuit in circuits)),
    ]
    return Table(("", *(circuit.id for circuit in circuits)), rows)


def _mobility(train: GearTrain) -> Section:
    found = train.mobility
    minus = f" - {found.couplings}" if found.couplings else ""
    lines = [
        f"By count: j_R - j_G = {found.turning_pairs} - {found.gear_pairs}{minus} = {found.by_count}.",
        f"By rank: {found.links} links - 1 - rank {found.rank} = {found.by_rank}"
        + (" (exact)." if found.certain else " (rank modulo two primes)."),
    ]
    if found.redundant:
        lines.append(f"{found.redundant} redundant circuits: the train moves in spite of them.")
    lines += [f"Redundant: {_loop(loop)}." for loop in found.loops[:12]]
    if len(found.loops) > 12:
        lines.append(f"... and {len(found.loops) - 12} more redundant loops.")
    lines += [f"Redundant: the circuits that meet at link '{link}' repeat each other." for link in found.shared[:12]]
    lines += [f"Locks: {_loop(loop)} does not close." for loop in found.locked[:12]]
    if found.still and found.by_rank:
        lines.append(f"Standing still in every motion: {', '.join(found.still[:20])}.")
    return Section("Mobility", lines)


def _loop(loop: Loop) -> str:
    return f"loop {' - '.join(loop.links)} by {', '.join(loop.pairs)}, ratio product {loop.product}"


def _shift_table(train: GearTrain, answers: Sequence[Answer]) -> Section:
    """States by rows: what is engaged, and the outputs' ratios."""
    declared = train.declaration
    clutches = list(declared.clutches)
    names = list(dict.fromkeys(name for answer in answers for name in answer.outputs))
    rows = []
    for answer in answers:
        engaged = declared.states[answer.state or ""].engaged
        marks = ["x" if clutch in engaged else "" for clutch in clutches]
        cells = [_speed_and_ratio(answer, name) for name in names]
        rows.append((str(answer.state), *marks, answer.verdict.kind, *cells))
    header = ("state", *clutches, "verdict", *names)
    return Section(
        "States",
        (f"x marks an engaged clutch or brake; {', '.join(names)} as speed and input/output.",),
        (Table(header, rows),),
    )


def _speed_and_ratio(answer: Answer, name: str) -> str:
    result = answer.outputs.get(name)
    if result is None or result.speed is None:
        return "-"
    inverse = f" (in/out {figure(1 / result.ratio, 6)})" if result.ratio else ""
    return f"{exact(result.speed)}{inverse}"


def _answer(train: GearTrain, answer: Answer) -> Iterator[Section]:
    head = f"State {answer.state}: " if answer.state is not None else ""
    case = train.declaration.case(answer.state)
    given = [f"{link} = {speed}" for link, speed in case.inputs.items()]
    given += [f"{link} fixed" for link in case.fixed] + [f"{a} and {b} locked together" for a, b in case.locks]
    lines = [f"Prescribed: {', '.join(given) or 'nothing'}.", f"Verdict: {answer.verdict}."]
    if answer.method == "floats":
        lines.append("Solved in floats: the coupled system is too dense for exact elimination.")
    yield Section(_title(head, "speeds"), lines, tuple(_speeds(train, answer)))
    if answer.outputs:
        yield _outputs(train, answer, head)
    targets = [
        (
            name,
            target.label,
            figure(target.speed, 10),
            ppm(target.ppm),
            _signed(target.days_per_century),
            _signed(target.degrees_per_unit),
            _met(target.met),
        )
        for name, result in answer.outputs.items()
        for target in result.targets
    ]
    if targets:
        header = (
            "output",
            "target",
            "target speed",
            "error ppm",
            "days per century",
            "degrees per unit",
            "within tolerance",
        )
        yield Section(
            _title(head, "against the targets"), ("By magnitude; a positive error is fast.",), (Table(header, targets),)
        )


def _title(head: str, words: str) -> str:
    return head + words if head else words[0].upper() + words[1:]


def _signed(value: float | None) -> str:
    return "-" if value is None else f"{value:+.5g}"


def _met(met: bool | None) -> str:
    return "" if met is None else "yes" if met else "NO"


def _speeds(train: GearTrain, answer: Answer) -> Iterator[Table]:
    if not answer.speeds:
        return
    moving = [speed for speed in train.declaration.case(answer.state).inputs.values() if speed]
    rows = []
    for link, speed in answer.speeds.items():
        mark = " (sum of joint speeds)" if link in train.bookkeeping else ""
        ratio = speed / moving[0] if len(moving) == 1 else None
        rows.append((link + mark, exact(speed), figure(speed), one_to(ratio)))
    yield Table(("link", "speed", "decimal", "output : input"), _cut(rows))


def _outputs(train: GearTrain, answer: Answer, head: str) -> Section:
    rows = [_output(train, result) for result in answer.outputs.values()]
    header = ("output", "of", "speed", "decimal", "output/input", "expect", "published", "as read")
    used = [at for at in range(len(header)) if at < 4 or any(row[at] for row in rows)]
    marks = [result.output.note for result in answer.outputs.values() if result.output.note]
    notes = (
        [f"{name}: {result.output.note}." for name, result in answer.outputs.items() if result.output.note]
        if marks
        else []
    )
    return Section(
        _title(head, "outputs"),
        notes,
        (Table([header[at] for at in used], [[row[at] for at in used] for row in rows]),),
    )


def _output(train: GearTrain, result: OutputResult) -> tuple[str, ...]:
    declared = train.declaration
    of = result.of if result.relative_to == declared.frame else f"{result.of} seen from {result.relative_to}"
    expect, published = result.output.expect, result.output.published
    return (
        result.name,
        of + (" (sum of joint speeds)" if result.bookkeeping else ""),
        exact(result.speed),
        figure(result.speed),
        exact(result.ratio) if result.ratio is not None and result.ratio != result.speed else "",
        "" if expect is None else "holds" if result.expect_holds else f"FAILS: {expect.value} expected",
        ""
        if published is None
        else f"{published.value} {published.as_}" + ("" if result.published_holds else " FAILS"),
        _as_read(declared, result),
    )


def _as_read(declared: Train, result: OutputResult) -> str:
    """The sense a reader of the dial sees: it flips on a face that looks the other way."""
    dial = declared.dials.get(result.output.dial or "")
    if dial is None or not result.speed:
        return ""
    flipped = dial.face is not None and declared.view.from_ is not None and dial.face != declared.view.from_
    clockwise = ((declared.view.positive == "clockwise") == (result.speed > 0)) != flipped
    turn = 1 / magnitude(result.speed)
    words = ["clockwise" if clockwise else "counter-clockwise", f"a turn in {figure(turn, 7)}"]
    if dial.turns > 1:
        words.append(f"{dial.turns} turns in {figure(turn * dial.turns, 7)}")
    if dial.divisions > 1:
        words.append(f"a division in {figure(turn * dial.turns / dial.divisions, 7)}")
    return ", ".join(words)


def _doubts(train: GearTrain, answers: Sequence[Answer]) -> Iterator[Section]:
    """Wheels in doubt, and what one tooth on each of them does to the pointers."""
    for answer in answers:
        found = list(train.sensitivity(answer)) if answer.verdict else []
        pointers = {name for name, result in answer.outputs.items() if result.output.dial or result.targets}
        if pointers:
            found = [item for item in found if item.output in pointers]
        if not found:
            continue
        head = f"State {answer.state}: " if answer.state is not None else ""
        text = "Change of speed in ppm, solved again exactly; outputs that move alike stand together."
        table = Table(("wheel", "teeth", "allowed", "one fewer", "one more", "outputs"), list(_grouped(found)))
        yield Section(_title(head, "wheels in doubt"), (text,), (table,))


def _grouped(found: Sequence[Sensitivity]) -> Iterator[tuple[str, ...]]:
    groups: dict[tuple[str, str, str], list[Sensitivity]] = {}
    for item in found:
        groups.setdefault((item.wheel, _shift(item.less), _shift(item.more)), []).append(item)
    for (wheel, less, more), items in groups.items():
        allowed = items[0].allowed
        span = (
            f"{allowed[0]}-{allowed[-1]}"
            if allowed == tuple(range(allowed[0], allowed[-1] + 1))
            else ", ".join(map(str, allowed))
        )
        yield wheel, str(items[0].teeth), span, less, more, ", ".join(item.output for item in items)


def _shift(value: float | None) -> str:
    return "locks or stands" if value is None else f"{value:+.6g}"
