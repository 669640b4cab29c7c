"""Outputs of a declared train as exact rational functions of variable tooth counts.

Relative to one carrier, the speeds of connected wheels are monomial multiples of one unknown. The equations that couple
these components, and the equations of brakes, locks and inputs, are rows of Laurent polynomials. They are eliminated by
Markowitz pivoting on monomials, and the remaining core is solved by Cramer's rule.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from operator import itemgetter
from typing import NamedTuple

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.kinematics.circuits import Axes, Circuit, Tree, close_joints, find_circuits, find_tree
from geartrain.kinematics.components import Components, find_components, reduce_components, relevant_circuits
from geartrain.kinematics.formulas.laurent import Laurent, TooLongError, minors
from geartrain.kinematics.formulas.laurent import Term as Term
from geartrain.kinematics.formulas.rational_functions import Formula as Formula
from geartrain.kinematics.formulas.rational_functions import make_formula
from geartrain.numerics.elimination import PRIME, add_into, eliminate_units
from geartrain.numerics.results import Result
from geartrain.train import StateCase, Teeth, Train
from geartrain.train.fields import MOST_TEETH

Row = dict[int, Laurent]
"""Linear form, as a mapping from columns to coefficients. Columns >= 0 are unknowns; column -1 is the constant term,
which comes from prescribed speeds.
"""

GIVEN = -1  # column of prescribed speeds; unknowns have columns from 0
_Residues = dict[int, int]


class SymbolicValue(NamedTuple):
    """Value of a linear form as a rational function of tooth counts, not necessarily in lowest terms."""

    numerator: Laurent
    denominator: Laurent


@dataclass(frozen=True, slots=True)
class SymbolicSolution:
    """Solution of a linear system, in which each unknown is a rational function of tooth counts."""

    width: int
    point: Sequence[int]
    pivots: Sequence[tuple[int, Row]]
    """Pairs (column, rest). The unknown of the column is -rest, and `rest` contains no column of an earlier pair."""
    values: Mapping[int, Laurent]
    """Numerator of each unknown of the core, by column. Undetermined unknowns are set to 0."""
    determinant: Laurent
    """Determinant of the core, which is the common denominator of `values`."""
    span: Mapping[int, _Residues]
    """Rows of the core at a random point, reduced to echelon form, by leading column."""
    conditions: Sequence[tuple[int, Laurent]]
    """Pairs of the index of a row and the function in this row that is 0 if the system is consistent."""

    def value(self, form: Mapping[int, Laurent]) -> SymbolicValue | None:
        """Return the value of a linear form of the unknowns; None if the system does not determine it."""
        rest = dict(form)
        for column, equal in self.pivots:
            factor = rest.pop(column, None)
            if factor is not None:
                add_into(rest, equal, -factor)
        free = {c: entry.modulo(self.point, PRIME) for c, entry in rest.items() if c != GIVEN}
        # not in the row space of the core: the form contains a free unknown
        if _reduced_row(free, self.span):
            return None
        return _combined(rest, self.values, self.determinant)


def solve_rows(rows: Sequence[Row], width: int, preferred: Sequence[int] | None = None) -> SymbolicSolution:
    """Solve the linear system in which the linear form of every row is 0, with coefficients that are polynomials in
    tooth counts. Independent rows are selected by their values at a random point modulo a prime.

    preferred   intended tooth counts. If there are more coupled rows than unknowns, rows that are independent at these
                tooth counts are selected. If it is None, rows with prescribed values are preferred

    Raises `TooLongError` if too many unknowns depend on each other for their functions to be useful.
    """
    # fixed seed, so that results are reproducible
    draw = random.Random(width)
    # a non-zero polynomial vanishes at a random point with a probability of at most degree / (2^61 - 1)
    # (Schwartz-Zippel lemma)
    point = [draw.randrange(1, PRIME) for _ in range(width)]
    # unknowns whose pivots are monomials are eliminated; the core is left
    pivots, left = eliminate_units(rows, _LaurentRing())
    core = [(at, row) for at, row in left if row.keys() - {GIVEN}]
    core.sort(key=lambda pair: (GIVEN not in pair[1], pair[0]))
    conditions = [(at, row[GIVEN]) for at, row in sorted(left, key=itemgetter(0)) if row.keys() == {GIVEN}]
    chosen, span = _independent(core, point)
    leading = span
    if preferred is not None and len(chosen) < len(core):
        meant, there = _independent(core, preferred)
        if len(meant) == len(chosen):
            chosen, leading = meant, there
    values, determinant = _solve_core([core[at][1] for at in chosen], sorted(leading), width)
    for at, (origin, row) in enumerate(core):
        if at not in chosen:
            condition = _combined(row, values, determinant).numerator
            conditions += [(origin, condition)] if condition else []
    return SymbolicSolution(width, point, pivots, values, determinant, span, conditions)


class _LaurentRing:
    """Ring of Laurent polynomials, whose units are the monomials, for `eliminate_units`."""

    modulus = 0

    def inverse(self, entry: Laurent) -> Laurent | None:
        return entry.inverse() if entry.is_unit else None

    def words(self, entry: Laurent) -> int:
        return len(entry)


def _independent(rows: Iterable[tuple[int, Row]], point: Sequence[int]) -> tuple[list[int], dict[int, _Residues]]:
    """Return the indices of the first independent rows at a point, modulo a prime, and their echelon form."""
    chosen: list[int] = []
    span: dict[int, _Residues] = {}
    for at, (_, row) in enumerate(rows):
        rest = _reduced_row({c: entry.modulo(point, PRIME) for c, entry in row.items() if c != GIVEN}, span)
        if rest:
            lead = min(rest)
            # leading entries are normalised to 1
            inverse = pow(rest[lead], -1, PRIME)
            span[lead] = {column: value * inverse % PRIME for column, value in rest.items()}
            chosen.append(at)
    return chosen, span


def _reduced_row(row: Mapping[int, int], span: Mapping[int, _Residues]) -> _Residues:
    """Return a row after reduction by the rows of an echelon form, without zero entries."""
    rest = {column: value for column, value in row.items() if value}
    while True:
        lead = next((column for column in sorted(rest) if column in span), None)
        if lead is None:
            return rest
        factor = rest[lead]
        for column, value in span[lead].items():
            new = (rest.get(column, 0) - factor * value) % PRIME
            if new:
                rest[column] = new
            else:
                rest.pop(column, None)


def _solve_core(rows: Sequence[Row], columns: Sequence[int], width: int) -> tuple[dict[int, Laurent], Laurent]:
    """Return the solution of as many equations (`rows`) as unknowns (`columns`) by Cramer's rule: the numerator of each
    unknown, by column, and the determinant. Unknowns of other columns are 0.
    """
    place, size = {column: at for at, column in enumerate(columns)}, len(columns)
    zero = Laurent.constant(0, width)
    matrix = [
        {place[c]: entry for c, entry in row.items() if c in place} | {size: -row.get(GIVEN, zero)} for row in rows
    ]
    *replaced, determinant = minors(matrix, width)
    # the right-hand side is the last column, and moves past the columns after the replaced one
    values = {column: -replaced[at] if (size - 1 - at) & 1 else replaced[at] for column, at in place.items()}
    return values, determinant


def _combined(form: Mapping[int, Laurent], values: Mapping[int, Laurent], determinant: Laurent) -> SymbolicValue:
    """Return the value of a linear form in unknowns with the numerators `values` over a common denominator."""
    one, total = Laurent.constant(1, determinant.width), Laurent.constant(0, determinant.width)
    denominator = determinant if any(column in values for column in form) else one
    for column, entry in form.items():
        numerator = denominator if column == GIVEN else values.get(column)
        if numerator:
            total = total + entry * numerator
    return SymbolicValue(total, denominator)


# --------------------------------------------------------------------------------------------------- symbolic equations


@dataclass(frozen=True, slots=True)
class Chord:
    """Circuit that closes a loop, with the ratio product and the component of the loop."""

    circuit: int
    product: Laurent
    group: int


class SymbolicEquations:
    """Equations of a train in one state, as rows that must be 0. See `reduce_components` for the unknowns.

    circuits   fundamental circuits, in which all wheels in `free` have different tooth counts
    free       wheel -> index of its variable

    rows, origin   the equations, and the cause of each of them
    chords         circuits whose loops have the ratio product 1 only for some values of the variable tooth counts
    """

    def __init__(
        self,
        links: Sequence[str],
        frame: str,
        circuits: Sequence[Circuit],
        case: StateCase,
        signs: Mapping[str, int],
        free: Mapping[str, int],
    ) -> None:
        self._free, self._signs = free, signs
        self.width = len(free)
        parts = find_components(links, frame, circuits, case.inputs)
        self._ratios = self._find_ratios(parts)
        loops = []
        for at in (*parts.closing, *parts.breaking):
            circuit = parts.circuits[at]
            i, j = parts.ends(circuit)
            around = self._speed_ratio(circuit, circuit.j) * self._ratios[i] * self._ratios[j].inverse()
            loops.append(Chord(at, around, parts.node_group[i]))
        one = Laurent.constant(1, self.width)
        # a constant product other than 1: the loop locks for all values of the variable counts
        never = [chord.circuit for chord in loops if chord.product.is_constant and chord.product != one]
        self.chords = tuple(chord for chord in loops if not chord.product.is_constant)
        self._reduced = reduce_components(replace(parts, breaking=never))
        self.parts = parts
        stated = list(self._stated_rows(case))
        self.rows = [row for row, _ in stated]
        self.origin = [words for _, words in stated]

    def relative(self, link: str, base: str) -> Row:
        """Return the speed of `link` relative to `base` as a linear form; it is measured about the axis of `link`."""
        row = self._form(self.parts.index[link])
        add_into(row, self._form(self.parts.index[base]), self._constant(-1))
        sign = self._constant(self._signs.get(link, 1))
        return {column: entry * sign for column, entry in row.items()}

    def unknown(self, group: int) -> Row:
        """Return the unknown speed of one component as a linear form."""
        return {group: self._constant(1)}

    def _find_ratios(self, parts: Components) -> list[Laurent]:
        """Return the relative speed of the link of each node, divided by the unknown speed of its component."""
        found: dict[int, Laurent] = {}
        for start in range(len(parts.node_link)):
            chain = []
            node = start
            # iterative, because a train can be deeper than the recursion limit
            while node not in found and parts.node_parent[node] >= 0:
                chain.append(node)
                node = parts.node_parent[node]
            found.setdefault(node, self._constant(1))
            for child in reversed(chain):
                step = self._speed_ratio(parts.circuits[parts.node_circuit[child]], parts.links[parts.node_link[child]])
                found[child] = found[parts.node_parent[child]] * step
        return [found[node] for node in range(len(parts.node_link))]

    def _speed_ratio(self, circuit: Circuit, to: str) -> Laurent:
        """Return the speed of the link `to` of a circuit divided by that of the other link, relative to the carrier."""
        a, b = self._coefficient(circuit, 0), self._coefficient(circuit, 1)
        near, far = (a, b) if to == circuit.j else (b, a)
        return -(near * far.inverse())

    def _coefficient(self, circuit: Circuit, side: int) -> Laurent:
        """Return the coefficient a (`side` 0) or b (`side` 1) of a circuit: a variable with its sign, or a constant."""
        given = (circuit.a, circuit.b)[side]
        variable = self._free.get(circuit.wheels[side]) if circuit.by_teeth else None
        if variable is None:
            return self._constant(given)
        size = Laurent.variable(variable, self.width)
        return size if given > 0 else -size

    def _form(self, link: int) -> Row:
        """Return the speed of a link as a linear form in the unknowns, before the sign of its axis is applied."""
        if link == self.parts.frame:
            return {}
        own = self._reduced.own.get(link)
        return {own: self._constant(1)} if own is not None else self._relative_form(self.parts.nodes_of[link][0])

    def _relative_form(self, node: int) -> Row:
        """Return the speed of a node's link as a linear form: the carrier's speed plus the link's relative speed."""
        parts = self.parts
        row: Row = {parts.node_group[node]: self._ratios[node]}
        carrier = parts.node_carrier[node]
        if carrier != parts.frame:
            row[self._reduced.own[carrier]] = self._constant(1)
        return row

    def _stated_rows(self, case: StateCase) -> Iterator[tuple[Row, str]]:
        """Yield each row that must be 0 with its cause: couplings of components, brakes, locks, and inputs."""
        parts, index = self.parts, self.parts.index
        for (kind, subject, node), numbers in zip(self._reduced.origin, self._reduced.equations, strict=True):
            if kind == "share":
                row = self._form(subject)
                add_into(row, self._relative_form(node), self._constant(-1))
                yield row, f"'{parts.links[subject]}' is driven by several causes"
            else:  # a component that is locked to its carrier for all counts
                yield self.unknown(next(iter(numbers))), f"'{parts.circuits[subject].id}' locks its wheels"

        for link in case.fixed:
            yield self._form(index[link]), case.says(link)
        for a, b in case.locks:
            row = self._form(index[a])
            add_into(row, self._form(index[b]), self._constant(-1))
            yield row, case.says(a, b)
        for link, speed in case.inputs.items():
            row = self._form(index[link])
            if speed:
                row[GIVEN] = self._constant(-speed * self._signs.get(link, 1))
            yield row, f"'{link}' is an input"

    def _constant(self, value: Fraction | int) -> Laurent:
        return Laurent.constant(value, self.width)


# ------------------------------------------------------------------------------------------------------ output formulas


Counts = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Formulas(Mapping[str, Formula], Result):
    """Outputs of a train in one state as functions of its variable tooth counts. The object is also a mapping with the
    items of `outputs`.

    A loop can turn if its ratio product is 1. If it is not 1, the loop locks its wheels. Loops with variable tooth
    counts are assumed to turn. Therefore, a train that moves although such a loop is locked has no formulas. Loops
    without variable tooth counts may turn or be locked.
    """

    outputs: Mapping[str, Formula]
    """Exact speed of each output [the train's unit of speed]; a difference of speeds if `relative_to` is declared."""
    conditions: tuple[Formula, ...]
    """Functions that must all be 0 for the train to turn: conditions on loops, and on links that several parts drive or
    fix.

    The `label` of a function names the cause of the condition. If a function is a constant other than 0, the train
    never turns. The outputs are valid where all conditions are satisfied.
    """
    exclusions: tuple[Formula, ...]
    """Functions that must not be 0. If one of them is 0, the train is locked or free, although the outputs may still
    have values because a common factor was cancelled.
    """
    undetermined: tuple[str, ...]
    """Names of outputs that the inputs do not determine, whatever the tooth counts are."""

    def __getitem__(self, name: str) -> Formula:
        return self.outputs[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.outputs)

    def __len__(self) -> int:
        return len(self.outputs)

    def turns(self, counts: Mapping[str, int]) -> bool:
        """Return True if all functions in `conditions` are 0 and none in `exclusions` is 0 at the tooth counts."""
        met = all(condition.value(counts) == 0 for condition in self.conditions)
        return met and all(exclusion.value(counts) != 0 for exclusion in self.exclusions)


def find_formulas(
    train: Train, state: str | None, free: Mapping[str, Counts], inputs: Mapping[str, int] | None = None
) -> Formulas:
    """Return the speed of every output in one state as a function of the variable tooth counts.

    state    name of a declared state, or None for a train without states
    free     allowed tooth counts of wheels, by wheel; all other wheels keep their declared tooth count
    inputs   speeds of the input links, by link; None for the declared speeds

    Raises `QuestionError` for wheels or states that the train does not have, or if the coupled part of the train is too
    large. Raises `DeclarationError` if a wheel that is not in `free` has no tooth count.
    """
    _check_wheels(train, free)
    train.check_state(state)
    for name, counts in free.items():
        if not counts:
            what = f"wheel '{name}' has no allowed tooth count"
            why = "its count is variable, and the sequence of its allowed counts is empty"
            place = train.place("links", train.wheels[name][0], "wheels", name)
            raise QuestionError(Problem(what, why, f"give at least one count, such as `{{'{name}': [20]}}`", place))
    tree = find_tree(train)
    (case,) = close_joints(train, tree, [train.case(state)])
    if inputs is not None:
        case = replace(case, inputs={link: Fraction(speed) for link, speed in inputs.items()})
    # rings last, as usual in formulas
    wheels = tuple(
        sorted((name for name in train.wheels if name in free), key=lambda name: train.wheels[name][1].internal)
    )
    equations = _equations(train, tree, case, wheels, free)
    try:
        return _collect_formulas(train, tree, case, equations, wheels)
    except TooLongError:
        why = "they would have millions of terms, because many speeds depend on each other"
        fix = "vary fewer wheels, or request fewer outputs"
        raise QuestionError(Problem(f"the formulas of '{train.name}' are too long", why, fix)) from None


def with_counts(train: Train, counts: Mapping[str, int]) -> Train:
    """Return a copy of a validated declaration with other tooth counts; line numbers and uncertainties are preserved.

    counts   new tooth counts, from 1 to 10^12, by wheel

    The computing time is linear in the number of links. Raises `QuestionError` for wheels that the train does not have,
    and for invalid tooth counts.
    """
    _check_wheels(train, counts)
    links = dict(train.links)
    for name, count in counts.items():
        if not 0 < count <= MOST_TEETH or count != int(count):
            what, why = f"wheel '{name}' cannot have {count} teeth", "a tooth count is a whole number from 1 to 10^12"
            raise QuestionError(Problem(what, why, f"give another count, such as `{{'{name}': 20}}`"))
        link, wheel = train.wheels[name]
        value: int | Teeth = int(count)
        if not isinstance(wheel.teeth, int):
            # the declared range or choices are kept if they include the tooth count
            low, high = wheel.teeth.range or (count, count)
            if count in wheel.teeth.choices if wheel.teeth.choices is not None else low <= count <= high:
                value = wheel.teeth.model_copy(update={"value": value})
        changed = wheel.model_copy(update={"teeth": value})
        links[link] = links[link].model_copy(update={"wheels": {**links[link].wheels, name: changed}})
    copied = train.model_copy(update={"links": links})
    copied.__dict__.pop("wheels", None)  # the copy contains the cached property of the original
    return copied


def _equations(
    train: Train, tree: Tree, case: StateCase, wheels: Sequence[str], free: Mapping[str, Counts]
) -> SymbolicEquations:
    """Return the equations that affect the outputs, with large random tooth counts for the variable wheels."""
    representative = with_counts(train, {name: free[name][0] for name in wheels})
    # large and random, so that no loop closes by coincidence of equal counts
    draw = random.Random(0)
    sizes = {name: draw.randrange(10**6, 10**9) for name in wheels}
    circuits = [circuit.with_counts(sizes) for circuit in find_circuits(representative, tree)]
    requested = {link for name, output in case.outputs.items() for link in output.links(name, train.frame)}
    kept = {train.frame, *requested, *case.inputs, *case.fixed, *(link for lock in case.locks for link in lock)}
    circuits = relevant_circuits(circuits, kept)
    kept |= {link for circuit in circuits for link in (circuit.i, circuit.j, *circuit.subtracted)}
    links = [link for link in train.links if link in kept]
    variables = {name: at for at, name in enumerate(wheels)}
    return SymbolicEquations(links, train.frame, circuits, case, Axes(train, tree).link_signs, variables)


def _collect_formulas(
    train: Train, tree: Tree, case: StateCase, equations: SymbolicEquations, wheels: Sequence[str]
) -> Formulas:
    counts = [train.wheels[name][1].count for name in wheels]
    preferred = [count for count in counts if count is not None] if all(counts) else None
    solution = solve_rows(equations.rows, equations.width, preferred)
    outputs: dict[str, Formula] = {}
    undetermined: list[str] = []
    cancelled: dict[str, Laurent] = {}
    for name, output in case.outputs.items():
        of, base = output.links(name, train.frame)
        value = solution.value(equations.relative(of, tree.reference(of, base)))
        if value is None:
            undetermined.append(name)
            continue
        outputs[name], common = make_formula(name, wheels, *value)
        # a cancelled factor that can vanish hides tooth counts at which the train is locked or free
        if not common.is_definite:
            cancelled[name] = common
    stated = [(equations.origin[row], left) for row, left in solution.conditions]
    stated += _loop_conditions(equations, solution)
    excluded = [(f"the motion of '{name}' is determined", common) for name, common in cancelled.items()]
    return Formulas(outputs, _zero_conditions(stated, wheels), _zero_conditions(excluded, wheels), tuple(undetermined))


def _loop_conditions(equations: SymbolicEquations, solution: SymbolicSolution) -> Iterator[tuple[str, Laurent]]:
    """Yield the label of each loop with variable tooth counts, and the function that is 0 if the loop can turn."""
    one = Laurent.constant(1, equations.width)
    for chord in equations.chords:
        rolls = solution.value(equations.unknown(chord.group))
        # wheels that never roll impose no condition
        if rolls is not None and not rolls.numerator:
            continue
        loop = equations.parts.loop(chord.circuit)
        left = chord.product - one
        # wheels that may be at rest: the condition is satisfied there too
        if rolls is not None and not rolls.numerator.is_definite:
            left = left * rolls.numerator
        yield f"loop {' - '.join(loop.links)} closes", left


def _zero_conditions(stated: Sequence[tuple[str, Laurent]], wheels: Sequence[str]) -> tuple[Formula, ...]:
    """Return the labelled functions, which must be 0, without duplicates and without monomial factors."""
    found: dict[tuple[Term, ...], Formula] = {}
    for label, left in stated:
        _, powers = max((value < 0, exponents) for exponents, value in left.terms.items())
        unit = Laurent(left.width, {powers: abs(left.terms[powers])})
        formula, _ = make_formula(label, wheels, left, unit)
        # conditions with equal numerators have equal zeros
        found.setdefault(formula.numerator, formula)
    return tuple(found.values())


def _check_wheels(train: Train, wheels: Mapping[str, object]) -> None:
    for name in wheels:
        if name not in train.wheels:
            what, why = f"'{train.name}' has no wheel '{name}'", "only declared wheels have tooth counts"
            raise QuestionError(Problem(what, why, suggest(name, train.wheels)))
