"""Why a train does not move as asked: names for loops, brakes and prescriptions, with a certificate.

Every equation gets a symbol of its own, and elimination then says which of them add up to the contradiction.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import NamedTuple

from geartrain.kinematics.components import ReducedSystem
from geartrain.kinematics.verdict import Loop, Verdict, abridged_names
from geartrain.numerics.decimal_text import abridged_text
from geartrain.numerics.elimination import PRIME, LinearForm, TooDenseError, add_into, eliminate, rank_modulo, residues
from geartrain.train import StateCase

_ZERO = Fraction(0)


class PrescriptionStatement(NamedTuple):
    """What one prescription says: its kind (input, fixed, lock), in words, as declared, and its value."""

    kind: str
    text: str
    declared: str
    speed: Fraction = _ZERO


def diagnose(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int], budget: int | None = None) -> Verdict:
    """The verdict on a case that does not hold together, locked or contradictory, with its witnesses.

    An input is locked if its link stands still whatever the other inputs do; inputs that could move alone but not
    together are contradictory. Witnesses cost memory in a long coupled train: past `budget` operations the verdict
    comes without them.
    """
    rows, statements = _tagged(reduced, case, signs)
    structural, held = len(reduced.equations), len(rows) - len(case.inputs)
    try:
        forms = eliminate(rows[:held], budget).forms(budget)
        for row, stated in zip(rows[held:], statements[held - structural :], strict=True):
            resolved = resolve_form(row, forms)
            # no unknown is left: the circuits and brakes alone say that this speed is 0
            if stated.speed and not any(column >= 0 for column in resolved):
                return _name(reduced, case, _uses(resolved), statements)
        echelon = eliminate(rows, budget)
    except TooDenseError:
        return unwitnessed_verdict(reduced, case)
    for condition in echelon.conditions:
        given = _uses(condition)
        total = sum(
            (value * statements[tag - structural].speed for tag, value in given.items() if tag >= structural), _ZERO
        )
        if total:
            return _name(reduced, case, given, statements)
    return unwitnessed_verdict(reduced, case)


def _uses(row: LinearForm) -> dict[int, Fraction]:
    """How much of each tagged equation goes into a row of symbols."""
    return {-1 - column: value for column, value in row.items()}


def resolve_form(row: LinearForm, forms: Mapping[int, LinearForm]) -> LinearForm:
    """A row with its solved unknowns put in."""
    resolved: LinearForm = {}
    for column, coefficient in row.items():
        add_into(resolved, forms.get(column, {column: Fraction(1)}), coefficient)
    return resolved


def held_rows(reduced: ReducedSystem, case: StateCase) -> Iterator[LinearForm]:
    """One row for each link held to the frame and each pair locked together."""
    index = reduced.components.index
    for link in case.fixed:
        yield dict(reduced.form(index[link]))
    for a, b in case.locks:
        row = dict(reduced.form(index[a]))
        add_into(row, reduced.form(index[b]), -1)
        yield row


def unwitnessed_verdict(reduced: ReducedSystem, case: StateCase) -> Verdict:
    """What is certain without a certificate: an input that cannot move is locked, else several contradict."""
    given = tuple(map(case.given, case.inputs))
    stuck = _stuck(reduced, case)
    if stuck:
        return Verdict("locked", f"input '{stuck[0]}' is locked to the frame by the circuits", prescriptions=given)
    return Verdict("contradictory", f"{', '.join(given)} cannot hold with the circuits", prescriptions=given)


def _stuck(reduced: ReducedSystem, case: StateCase) -> list[str]:
    """The inputs that are to move and stand still whatever the others do, modulo a prime.

    With a symbol for each input, elimination leaves what the circuits say of the inputs alone.
    """
    rows = [dict(row) for row in (*reduced.equations, *held_rows(reduced, case))]
    rows += [
        {**reduced.form(reduced.components.index[link]), -1 - at: Fraction(1)} for at, link in enumerate(case.inputs)
    ]
    left = eliminate(map(residues, rows), modulus=PRIME).conditions
    said = [{-1 - column: value for column, value in row.items()} for row in left]
    rank = rank_modulo(said)
    return [
        link
        for at, (link, speed) in enumerate(case.inputs.items())
        if speed and rank_modulo([*said, {at: Fraction(1)}]) == rank
    ]


def _tagged(
    reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int]
) -> tuple[list[LinearForm], list[PrescriptionStatement]]:
    """All equations, each with a symbol -1-t of its own, t counting structure first, then prescriptions."""
    index = reduced.components.index
    rows: list[LinearForm] = [dict(row) for row in (*reduced.equations, *held_rows(reduced, case))]
    statements: list[PrescriptionStatement] = [
        PrescriptionStatement("fixed", case.says(link), case.declares(link)) for link in case.fixed
    ]
    statements += [PrescriptionStatement("lock", case.says(a, b), case.declares(a, b)) for a, b in case.locks]
    for link, speed in case.inputs.items():
        rows.append(dict(reduced.form(index[link])))
        statements.append(
            PrescriptionStatement("input", case.given(link), case.given(link), speed * signs.get(link, 1))
        )
    for tag, row in enumerate(rows):
        row[-1 - tag] = Fraction(-1)
    return rows, statements


def _name(
    reduced: ReducedSystem, case: StateCase, given: Mapping[int, Fraction], statements: Sequence[PrescriptionStatement]
) -> Verdict:
    """One contradiction in words. `given` says how much of each equation goes into it."""
    parts, structural = reduced.components, len(reduced.equations)
    used = [(statements[tag - structural], value) for tag, value in sorted(given.items()) if tag >= structural]
    inputs = [(stated.text, value, stated.speed) for stated, value in used if stated.kind == "input"]
    moving = [text for text, _, speed in inputs if speed]
    held = [stated.text for stated, _ in used if stated.kind != "input"]
    prescriptions = tuple(dict.fromkeys(stated.declared for stated, _ in used))
    chords = [reduced.origin[tag][1] for tag in given if tag < structural and reduced.origin[tag][0] == "loop"]
    loops = tuple(parts.loop(chord) for chord in chords)
    shut = f"{abridged_names([*map(str, loops)], '; ')} {'does' if len(loops) == 1 else 'do'} not close"
    if len(inputs) == 1:
        link = inputs[0][0].split(" = ")[0]
        if loops:
            text = f"{shut}, so {moving[0]} cannot turn"
        else:
            by = " and ".join(held) if held else f"the pairs {abridged_names(_pairs(reduced, given, structural))}"
            text = f"input '{link}' is locked to the frame: {by}"
        return Verdict("locked", text, prescriptions=prescriptions, loops=loops)
    scale = lcm(*(value.denominator for _, value, _ in inputs))
    numbers = [int(value * scale) for _, value, _ in inputs]
    common = gcd(*numbers) * (1 if numbers[0] > 0 else -1)
    terms = " ".join(
        f"{'-' if n < 0 else '+'} {abridged_text(abs(n))} {text.split(' = ')[0]}"
        for n, (text, _, _) in zip([n // common for n in numbers], inputs, strict=True)
    )
    residue = sum((value * speed for _, value, speed in inputs), Fraction(0)) * scale / common
    terms = f"{terms.removeprefix('+ ')} must be 0 and is {case.shown(residue)}"
    said = ", ".join(dict.fromkeys(stated.text for stated, _ in used))
    text = f"{said} contradict each other: {terms}"
    if loops:
        text += f", for {shut}"
    return Verdict("contradictory", text, prescriptions=prescriptions, loops=loops)


def _pairs(reduced: ReducedSystem, given: Mapping[int, Fraction], structural: int) -> list[str]:
    """The gear pairs that take part in a contradiction: the paths between the links its equations share."""
    parts = reduced.components
    touched: dict[int, set[int]] = {}
    for tag in given:
        if tag < structural and reduced.origin[tag][0] == "share":
            _, link, _ = reduced.origin[tag]
            for node in parts.nodes_of[link]:
                touched.setdefault(parts.node_group[node], set()).add(node)
    found = {circuit: None for nodes in touched.values() for circuit in parts.path(sorted(nodes))}
    return [parts.circuits[circuit].id for circuit in found]


def stationary_verdict(reduced: ReducedSystem, case: StateCase) -> Verdict:
    """Nothing is driven and nothing could be: the train itself, or its brakes, hold every link."""
    parts = reduced.components
    loops: tuple[Loop, ...] = tuple(parts.loop(circuit) for circuit in parts.breaking)
    holding = [case.declares(link) for link in case.fixed] + [case.declares(a, b) for a, b in case.locks]
    held = tuple(dict.fromkeys(holding))
    if loops:
        text = f"mobility 0: {loops[0]} does not close; every link is locked"
    elif held:
        text = f"mobility 0: {', '.join(held)}; every link stands still"
    else:
        text = "mobility 0: every link is locked"
    links = tuple(link for link in parts.links if parts.index[link] != parts.frame)
    return Verdict("locked", text, links=links, prescriptions=held, loops=loops)


def free_verdict(
    reduced: ReducedSystem, case: StateCase, forms: Mapping[int, LinearForm], undetermined: Sequence[str], freedom: int
) -> Verdict:
    """What is undetermined, and a least set of links whose speeds would settle it."""
    index = reduced.components.index
    rows: list[LinearForm] = []
    fixes: list[str] = []
    for link in sorted(undetermined, key=lambda name: index[name] not in reduced.own):  # carriers make good inputs
        row = resolve_form(reduced.form(index[link]), forms)
        loose = {column: value for column, value in row.items() if column >= 0}
        if eliminate([*rows, loose]).rank > len(rows):
            rows.append(loose)
            fixes.append(link)
        if len(fixes) == min(freedom, 12):
            break
    given = len(case.inputs)
    degrees = f"{freedom} degree{'s' if freedom > 1 else ''} of freedom"
    head = f"{given} of {given + freedom} degrees of freedom prescribed" if given else f"{degrees} and no input"
    more = (
        ("one more input" if given else "an input") if freedom == 1 else f"{freedom}{' more' if given else ''} inputs"
    )
    text = f"{head}: speeds of {abridged_names(undetermined)} undetermined; give {more}, such as {', '.join(fixes)}"
    return Verdict("free", text, links=tuple(undetermined), fixes=tuple(fixes))
