"""Exact speeds by propagation or elimination, and the verdict.

Propagation is tried first: if the speeds of two of a circuit's three links are known, the third follows. Propagation
solves ordinary trains, and every train whose links are driven one after another, in integers and in linear time. If it
stops before all speeds are known, as for a planetary set with a fixed ring, whose two circuits are coupled, the system
is reduced to components and solved by Gaussian elimination. If a solution does not exist or is not unique, the
diagnosis names the loops, inputs, brakes and locks that cause this.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import gcd, lcm
from typing import NamedTuple

from geartrain.kinematics.answer import Loop, Verdict, abridged_names
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import ReducedSystem, SolvedPart
from geartrain.kinematics.willis_system import relative_speed
from geartrain.numerics.containers import FrozenDict, ItemwiseMapping, collector_paused
from geartrain.numerics.elimination import (
    PRIME,
    Echelon,
    LinearForm,
    TooDenseError,
    add_into,
    eliminate,
    rank_modulo,
    residues,
)
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.factored_ratios import FactoredRatios
from geartrain.train import StateCase

_ZERO = Fraction(0)


class PrescriptionStatement(NamedTuple):
    """Input, brake or lock of a state: its kind (input, fixed or lock), a sentence that describes it, a sentence that
    describes its declaration, and its speed.
    """

    kind: str
    text: str
    declared: str
    speed: Fraction = _ZERO


def diagnose(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int], budget: int | None = None) -> Verdict:
    """Return the verdict on a state without a solution, which is either locked or contradictory, with its certificate.

    An input is locked if its link cannot move for any speeds of the other inputs. Inputs that can move separately but
    not together are contradictory. The certificate requires much memory for a long coupled train; if it takes more than
    `budget` operations, the verdict is returned without it.
    """
    rows, statements = _tagged(reduced, case, signs)
    structural, held = len(reduced.equations), len(rows) - len(case.inputs)
    try:
        forms = eliminate(rows[:held], budget).forms(budget)
        for row, stated in zip(rows[held:], statements[held - structural :], strict=True):
            resolved = resolve_form(row, forms)
            # no unknown is left: circuits and brakes imply that this speed is 0
            if stated.speed and not any(column >= 0 for column in resolved):
                given = {-1 - column: value for column, value in resolved.items()}
                return _describe_contradiction(reduced, case, given, statements)
        echelon = eliminate(rows, budget)
    except TooDenseError:
        return unwitnessed_verdict(reduced, case)
    for condition in echelon.conditions:
        # factor of each equation, by its index
        given = {-1 - column: value for column, value in condition.items()}
        stated_factors = ((statements[tag - structural], value) for tag, value in given.items() if tag >= structural)
        if sum((value * stated.speed for stated, value in stated_factors), _ZERO):
            return _describe_contradiction(reduced, case, given, statements)
    return unwitnessed_verdict(reduced, case)


def resolve_form(row: LinearForm, forms: Mapping[int, LinearForm]) -> LinearForm:
    """Return a linear form after replacing the solved unknowns by their values."""
    resolved: LinearForm = {}
    for column, coefficient in row.items():
        if column in forms:
            add_into(resolved, forms[column], coefficient)
        else:
            add_into(resolved, {column: coefficient}, 1)
    return resolved


def held_rows(reduced: ReducedSystem, case: StateCase) -> Iterator[LinearForm]:
    """Yield the linear forms that must be 0 because a link is fixed, or because two links are locked together."""
    index = reduced.components.index
    for link in case.fixed:
        yield dict(reduced.form(index[link]))
    for a, b in case.locks:
        row = dict(reduced.form(index[a]))
        add_into(row, reduced.form(index[b]), -1)
        yield row


def unwitnessed_verdict(reduced: ReducedSystem, case: StateCase) -> Verdict:
    """Return the verdict on a state without a solution, without a certificate. It is "locked" if an input cannot move,
    and "contradictory" if all inputs can move.
    """
    given = tuple(map(case.given, case.inputs))
    stuck = _locked_inputs(reduced, case)
    if stuck:
        return Verdict("locked", f"input '{stuck[0]}' is locked to the frame by the circuits", prescriptions=given)
    return Verdict("contradictory", f"{', '.join(given)} contradict the circuits", prescriptions=given)


def _locked_inputs(reduced: ReducedSystem, case: StateCase) -> list[str]:
    """Return the non-zero inputs that cannot move for any speeds of the other inputs, by elimination modulo a prime."""
    index = reduced.components.index
    rows = [dict(row) for row in (*reduced.equations, *held_rows(reduced, case))]
    rows += [{**reduced.form(index[link]), -1 - at: Fraction(1)} for at, link in enumerate(case.inputs)]
    # each input is a symbol, and conditions contain only symbols: relations between the inputs
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
    """Return all equations and the statements of brakes, locks and inputs. Equation t contains a symbol of its own as
    an additional unknown in column -1 - t, which shows from which equations a contradiction is combined. The index t
    counts the structural equations first, then brakes, locks and inputs.
    """
    index = reduced.components.index
    rows: list[LinearForm] = [dict(row) for row in (*reduced.equations, *held_rows(reduced, case))]
    statements: list[PrescriptionStatement] = [
        PrescriptionStatement("fixed", case.says(link), case.declares(link)) for link in case.fixed
    ]
    statements += [PrescriptionStatement("lock", case.says(a, b), case.declares(a, b)) for a, b in case.locks]
    for link, speed in case.inputs.items():
        rows.append(dict(reduced.form(index[link])))
        given = case.given(link)
        statements.append(PrescriptionStatement("input", given, given, speed * signs.get(link, 1)))
    for tag, row in enumerate(rows):
        # the symbols show which equations a contradiction is combined from
        row[-1 - tag] = Fraction(-1)
    return rows, statements


def _describe_contradiction(
    reduced: ReducedSystem, case: StateCase, given: Mapping[int, Fraction], statements: Sequence[PrescriptionStatement]
) -> Verdict:
    """Return the verdict on a contradiction; `given` are the factors of the equations in the contradictory sum."""
    parts, structural = reduced.components, len(reduced.equations)
    used = [(statements[tag - structural], value) for tag, value in sorted(given.items()) if tag >= structural]
    inputs = [(stated.text, value, stated.speed) for stated, value in used if stated.kind == "input"]
    moving = [text for text, _, speed in inputs if speed]
    held = [stated.text for stated, _ in used if stated.kind != "input"]
    prescriptions = tuple(dict.fromkeys(stated.declared for stated, _ in used))
    # loops whose equations are in the certificate
    chords = [reduced.origin[tag][1] for tag in given if tag < structural and reduced.origin[tag][0] == "loop"]
    loops = tuple(parts.loop(chord) for chord in chords)
    shut = f"{abridged_names([*map(str, loops)], '; ')} {'does' if len(loops) == 1 else 'do'} not close"
    # one input: it is locked; several: their speeds contradict each other
    if len(inputs) == 1:
        link = inputs[0][0].split(" = ")[0]
        if loops:
            text = f"{shut}, so {moving[0]} cannot turn"
        else:
            by = " and ".join(held) if held else f"the pairs {abridged_names(_pairs(reduced, given, structural))}"
            text = f"input '{link}' is locked to the frame: {by}"
        return Verdict("locked", text, prescriptions=prescriptions, loops=loops)
    # the relation between the inputs with coprime integer factors
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
        text += f", because {shut}"
    return Verdict("contradictory", text, prescriptions=prescriptions, loops=loops)


def _pairs(reduced: ReducedSystem, given: Mapping[int, Fraction], structural: int) -> list[str]:
    """Return the names of the pairs that transmit the contradictory speeds: in each component, the pairs on the paths
    between those links that also belong to another component. `given` contains the factors of the equations in the
    contradictory sum; the first `structural` equations couple components.
    """
    parts = reduced.components
    touched: dict[int, set[int]] = {}
    for tag in given:
        if tag < structural and reduced.origin[tag][0] == "share":
            _, link, _ = reduced.origin[tag]
            # a link in several components couples them; the pairs between such links are concerned
            for node in parts.nodes_of[link]:
                touched.setdefault(parts.node_group[node], set()).add(node)
    found = {circuit: None for nodes in touched.values() for circuit in parts.path(sorted(nodes))}
    return [parts.circuits[circuit].id for circuit in found]


def stationary_verdict(reduced: ReducedSystem, case: StateCase) -> Verdict:
    """Return the verdict on a state in which no input moves, and loops or brakes lock every link."""
    parts = reduced.components
    loops: tuple[Loop, ...] = tuple(parts.loop(circuit) for circuit in parts.breaking)
    holding = [case.declares(link) for link in case.fixed] + [case.declares(a, b) for a, b in case.locks]
    held = tuple(dict.fromkeys(holding))
    if loops:
        text = f"mobility 0: {loops[0]} does not close; every link is locked"
    elif held:
        text = f"mobility 0: {', '.join(held)}; no link can move"
    else:
        text = "mobility 0: every link is locked"
    links = tuple(link for link in parts.links if parts.index[link] != parts.frame)
    return Verdict("locked", text, links=links, prescriptions=held, loops=loops)


def free_verdict(
    reduced: ReducedSystem, case: StateCase, forms: Mapping[int, LinearForm], undetermined: Sequence[str], freedom: int
) -> Verdict:
    """Return the verdict on an underdetermined state. It contains all undetermined links, and a smallest set of at most
    12 links whose speeds would determine the other links.
    """
    index = reduced.components.index
    rows: list[LinearForm] = []
    fixes: list[str] = []
    # carriers first, as suitable inputs
    for link in sorted(undetermined, key=lambda name: index[name] not in reduced.own):
        row = resolve_form(reduced.form(index[link]), forms)
        loose = {column: value for column, value in row.items() if column >= 0}
        if eliminate([*rows, loose]).rank > len(rows):
            rows.append(loose)
            fixes.append(link)
        # each suggestion costs an elimination, and a reader needs only a few
        if len(fixes) == min(freedom, 12):
            break
    given = len(case.inputs)
    degrees = f"{freedom} degree{'s' if freedom > 1 else ''} of freedom"
    head = f"{given} of {given + freedom} degrees of freedom prescribed" if given else f"{degrees} and no input"
    if freedom == 1:
        more = "one more input" if given else "an input"
    else:
        more = f"{freedom} more inputs" if given else f"{freedom} inputs"
    text = f"{head}: speeds of {abridged_names(undetermined)} are undetermined; prescribe {more}, such as "
    text += ", ".join(fixes)
    return Verdict("free", text, links=tuple(undetermined), fixes=tuple(fixes))


# ---------------------------------------------------------------------------------------------------------- propagation


Terms = tuple[tuple[int, int], ...]
"""Equation: pairs of a link index and an integer coefficient; the sum of coefficient times speed is 0."""


@collector_paused()
def propagate(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], case: StateCase, signs: Mapping[str, int]
) -> Mapping[str, Fraction] | None:
    """Return the exact speed of every link; None if propagation does not reach all links, or finds a contradiction.

    signs   -1 for links whose axis is opposite to the reference direction of its parallel axes
    """
    index = {link: at for at, link in enumerate(links)}
    rows = _rows(index, frame, circuits, case)
    users: list[list[int]] = [[] for _ in links]
    for at, row in enumerate(rows):
        for link, _ in row:
            users[link].append(at)
    waiting = [len(row) for row in rows]
    speeds = FactoredRatios(len(links))
    bottom = speeds.bottom  # denominators; 0 means unknown
    speeds.set_root(index[frame], 0)
    known = []
    inputs = [(link, speed * signs.get(link, 1)) for link, speed in case.inputs.items()]
    for name, speed in [*((link, Fraction(0)) for link in case.fixed), *inputs]:
        at = index[name]
        if bottom[at]:
            return None  # prescribed twice, or the frame; the diagnosis decides whether that is consistent
        speeds.set_root(at, speed.numerator, speed.denominator)
        known.append(at)
    for row in rows:
        if len(row) == 1 and not bottom[row[0][0]]:
            speeds.set_root(row[0][0], 0)  # a row with one link: its speed is 0
            known.append(row[0][0])
    used = bytearray(len(rows))
    for here in known:
        for at in users[here]:
            waiting[at] -= 1
            if waiting[at] == 1:
                target = _solve(rows[at], speeds)
                if target >= 0:
                    used[at] = 1
                    known.append(target)
            elif waiting[at] == 0 and not used[at] and not speeds.vanishes(rows[at]):
                return None
    if not all(bottom):
        return None
    # products of ratios are multiplied out when a speed is read: if digits grow from link to link, all numbers together
    # would take memory in proportion to their square
    opposite = {link for link, sign in signs.items() if sign < 0}

    def speed_of(link: str) -> Fraction:
        found = speeds.value(index[link])
        return -found if link in opposite else found  # much faster than a product of fractions

    return ItemwiseMapping(links, speed_of, keep=False)


def _rows(index: Mapping[str, int], frame: str, circuits: Sequence[Circuit], case: StateCase) -> list[Terms]:
    rows: list[Terms] = []
    for circuit in circuits:
        rows.append(tuple([(index[link], factor) for link, factor in circuit.terms if link != frame]))
    for first, second in case.locks:
        if first != second:
            rows.append(tuple([(index[link], factor) for link, factor in ((first, 1), (second, -1)) if link != frame]))
    return rows


def _solve(row: Terms, speeds: FactoredRatios) -> int:
    """Solve an equation for its only unknown speed, and return the index of its link; -1 if all speeds are known."""
    target, lead = -1, 0
    moving = []
    for link, coefficient in row:
        if not speeds.bottom[link]:
            target, lead = link, coefficient
        elif speeds.top[link]:
            moving.append((link, coefficient))
    if target < 0:
        return -1
    # one other moving link: the speed is stored as a short ratio to it
    if len(moving) == 1:
        link, coefficient = moving[0]
        speeds.follow(target, link, -coefficient, lead)
        return target
    speed = -sum((speeds.value(link) * coefficient for link, coefficient in moving), Fraction(0)) / lead
    speeds.set_root(target, speed.numerator, speed.denominator)
    return target


# --------------------------------------------------------------------------------------------------------- exact speeds


_GIVEN = -1  # column of prescribed speeds

EXACT_BUDGET = 400_000
"""Maximum number of operations of exact elimination, which take about 1 s; floats are used beyond it."""

_PREDICTED = 40_000
"""Maximum number of operations in the elimination modulo a prime for which exact elimination is tried.

Fill-in increases the number of digits: in grids and random networks of differentials, 40,000 operations with short
numbers correspond to the 400,000 operations of `EXACT_BUDGET`.
"""

_FEW = 100  # for fewer equations the prediction costs as much as it saves


@dataclass(frozen=True, slots=True)
class Solution:
    """Exact speeds of the determined links of a train in one state, with the verdict and the speed ratios."""

    verdict: Verdict
    speeds: Mapping[str, Fraction]
    """Speeds of the determined links, by link, in the order of the declaration."""
    ratios: Mapping[str, Mapping[str, Fraction]]
    """Speed of a link divided by the speed of one input if other inputs are at rest, as `ratios[link][input]`."""
    signs: Mapping[str, int]
    """Sign of each link's axis, by link: -1 if it points against the reference direction of the axes parallel to it.
    Links with the sign 1 are omitted.
    """
    difference: Callable[[str, str], Fraction | None] | None = None
    """Function that returns the difference of two links' speeds before axis signs are applied, or None if the
    difference is undetermined. It is given only if the train is free.
    """

    def relative(self, of: str, base: str) -> Fraction | None:
        """Return the speed of the link `of` relative to the link `base`, about the axis of `of`; None if it is not
        determined. The difference of two speeds can be determined although neither of them is.
        """
        found = relative_speed(of, base, self.speeds.get, self.signs)
        if found is not None or self.difference is None:
            return found
        value = self.difference(of, base)
        return None if value is None else value * self.signs.get(of, 1)

    def __getitem__(self, link: str) -> Fraction:
        return self.speeds[link]

    def __iter__(self) -> Iterator[str]:
        return iter(self.speeds)


def _speed_ratios(part: SolvedPart, case: StateCase, signs: Mapping[str, int]) -> Mapping[str, Mapping[str, Fraction]]:
    """Return the exact speed ratios as `ratios[link][input]`; equations are solved when the mapping is accessed."""

    @cache
    def forms() -> dict[int, LinearForm]:
        reduced = part.reduced
        index = reduced.components.index
        rows = [*reduced.equations, *held_rows(reduced, case)]
        # input number i has the symbol -1 - i
        rows += [{**reduced.form(index[link]), -1 - at: Fraction(-1)} for at, link in enumerate(case.inputs)]
        return eliminate(rows).forms()

    def ratios(link: str) -> Mapping[str, Fraction]:
        form = resolve_form(part.reduced.form(part.reduced.components.index[link]), forms())
        own = signs.get(link, 1)
        return FrozenDict(
            (name, own * form.get(-1 - at, _ZERO) * signs.get(name, 1)) for at, name in enumerate(case.inputs)
        )

    return ItemwiseMapping(part.links, ratios)


@collector_paused()
def solve(part: SolvedPart, case: StateCase, signs: Mapping[str, int], budget: int | None = EXACT_BUDGET) -> Solution:
    """Solve the train in one state exactly: by propagation if it reaches every link, or by reduction and elimination if
    not.

    signs    -1 for links whose axis is opposite to the reference direction; results refer to the declared directions
    budget   maximum number of operations in addition to linear work, beyond which `TooDenseError` is raised; None for
             no limit
    """
    ratios = _speed_ratios(part, case, signs)
    # if all inputs are 0, only the rank shows whether a link can move
    walked = propagate(part.links, part.frame, part.circuits, case, signs) if any(case.inputs.values()) else None
    if walked is not None:
        return Solution(determined_verdict(case), walked, ratios, signs)
    reduced = part.reduced
    budget = elimination_budget(reduced, budget)
    held = [*reduced.equations, *held_rows(reduced, case)]
    echelon = eliminate_within([*held, *_input_rows(reduced, case, signs)], budget)
    if echelon.conditions:
        return Solution(diagnose(reduced, case, signs, budget), {}, ratios, signs)
    # all inputs 0: speeds are 0 also for a locked train, so the rank decides
    if not any(case.inputs.values()) and eliminate(held, budget).rank == reduced.unknowns:
        return Solution(stationary_verdict(reduced, case), dict.fromkeys(part.links, Fraction(0)), ratios, signs)
    forms = echelon.forms(budget)
    speeds, undetermined = _determined_speeds(reduced, forms, signs)
    if undetermined:
        freedom = reduced.unknowns - echelon.rank
        verdict = free_verdict(reduced, case, forms, undetermined, freedom)

        def difference(of: str, base: str) -> Fraction | None:
            index = reduced.components.index
            row = dict(reduced.form(index[of]))
            add_into(row, reduced.form(index[base]), -1)
            return _value(resolve_form(row, forms))

        return Solution(verdict, speeds, ratios, signs, difference)
    return Solution(determined_verdict(case, reduced), speeds, ratios, signs)


def elimination_budget(reduced: ReducedSystem, budget: int | None) -> int | None:
    """Return the maximum number of operations for one system: `budget` plus 30 for each equation, which is the cost of
    an uncoupled equation; None if `budget` is None.
    """
    return None if budget is None else budget + 30 * len(reduced.equations)


def eliminate_within(rows: Sequence[LinearForm], budget: int | None) -> Echelon:
    """Return the echelon form of the rows. Raises `TooDenseError` if exact elimination exceeds `budget` operations, or
    if elimination modulo a prime predicts this.
    """
    if budget is not None and len(rows) > _FEW:
        eliminate(map(residues, rows), _PREDICTED + 10 * len(rows), PRIME)
    return eliminate(rows, budget)


def exact_verdict(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int]) -> Verdict:
    """Return the verdict without speeds, by elimination modulo a prime, for systems too dense for exact numbers."""
    held = [*reduced.equations, *held_rows(reduced, case)]
    if not any(case.inputs.values()) and rank_modulo(held) == reduced.unknowns:
        return stationary_verdict(reduced, case)
    echelon = eliminate(map(residues, [*held, *_input_rows(reduced, case, signs)]), modulus=PRIME)
    if echelon.conditions:
        return unwitnessed_verdict(reduced, case)
    freedom = reduced.unknowns - echelon.rank
    if freedom:
        given_count = len(case.inputs)
        return Verdict("free", f"{given_count} of {given_count + freedom} degrees of freedom prescribed")
    return determined_verdict(case, reduced)


def determined_verdict(case: StateCase, reduced: ReducedSystem | None = None) -> Verdict:
    """Return the verdict that all speeds are determined. Its text mentions any loop that locks a part of the train."""
    parts = reduced.components if reduced else None
    loops = tuple(parts.loop(circuit) for circuit in parts.breaking[:1]) if parts else ()
    text = f"every speed follows from {', '.join(case.inputs)}"
    if loops:
        text += f"; {loops[0]} does not close and locks its links to '{loops[0].carrier}'"
    return Verdict("determined", text, loops=loops)


def _input_rows(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int]) -> Iterator[LinearForm]:
    """Yield one row for each input, with the prescribed speed in column -1."""
    for link, speed in case.inputs.items():
        row = dict(reduced.form(reduced.components.index[link]))
        if speed:
            row[_GIVEN] = -speed * signs.get(link, 1)
        yield row


def _determined_speeds(
    reduced: ReducedSystem, forms: Mapping[int, LinearForm], signs: Mapping[str, int]
) -> tuple[Mapping[str, Fraction], list[str]]:
    """Return the speeds of the determined links, each computed on first access, and the names of the other links."""
    index = reduced.components.index

    def speed(link: str) -> Fraction | None:
        return _value(resolve_form(reduced.form(index[link]), forms))

    known = {unknown for unknown, form in forms.items() if _value(form) is not None}
    # free unknowns may cancel, which only the form shows
    determined = [
        link for link in index if known.issuperset(reduced.unknowns_of(index[link])) or speed(link) is not None
    ]

    def about_own_axis(link: str) -> Fraction:
        found = speed(link) or _ZERO
        return -found if signs.get(link, 1) < 0 else found

    speeds = ItemwiseMapping(determined, about_own_axis, keep=False)
    return speeds, [link for link in index if link not in speeds]


def _value(form: LinearForm) -> Fraction | None:
    """Return the value of a linear form; None if it contains a free unknown."""
    return None if any(column >= 0 for column in form) else form.get(_GIVEN, _ZERO)
