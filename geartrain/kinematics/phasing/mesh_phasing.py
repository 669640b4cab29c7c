"""Phase closure of the loops of a train: verdict, loops, angles of the wheels for assembly, and distributed errors.

The result for a loop consists of its gears in order, the divisibility rule of its tooth counts (a modulus divides a
tooth count or a weighted sum of tooth counts), and the phase error of its last mesh if all other meshes have no phase
error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.components import find_components
from geartrain.kinematics.phasing.azimuths import MOUNT, UnplacedPair, mount_frame_wheels, place_pitch_points
from geartrain.kinematics.phasing.phase_system import (
    PhaseCondition,
    PhaseKind,
    PhaseSystem,
    ResidueKnowledge,
    judge_residue,
)
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Key, Result
from geartrain.train import Train

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Row = dict[str, int]


class DivisibilityCondition(NamedTuple):
    """Condition of a `DivisibilityRule`: `modulus` divides a weighted sum of tooth counts."""

    modulus: int
    """Divisor of the weighted sum of the tooth counts."""
    factors: Mapping[str, int]
    """Weight of the tooth count of each wheel, or of each kind of wheel."""


@dataclass(frozen=True)
class DivisibilityRule(Result):
    """Divisibility conditions on the tooth counts of a set of gears under which the teeth mesh around all loops."""

    KEYS = ("text", "conditions")

    conditions: tuple[DivisibilityCondition, ...]
    """Conditions on the tooth counts, which must all be satisfied."""

    @property
    def text(self) -> str:
        """Rule as text, such as `3 divides za and 5 divides zb`."""
        kinds = [kind for _, terms in self.conditions for kind in terms]
        # short names are written like z5, z4a and ze, others like z[sun]
        short = all(kind[:1].isdigit() or len(kind) <= 2 for kind in kinds)
        sums = (f"{modulus} divides {_sum(terms, short)}" for modulus, terms in self.conditions)
        return " and ".join(sums) or "always"

    def holds(self, teeth: Mapping[str, int]) -> bool:
        """Return True if all loops close with these tooth counts.

        Parameters
        ----------
        teeth : mapping of str to int
            Tooth count of each kind of wheel.
        """
        return not any(sum(f * teeth[kind] for kind, f in terms.items()) % m for m, terms in self.conditions)


def find_divisibility_rule(forms: Iterable[Mapping[str, Fraction]]) -> DivisibilityRule:
    """Find the divisibility rule of the tooth counts z under which the sum of form[kind] z[kind] is an integer for each
    linear form.

    Only the coefficients modulo 1 matter. The forms generate a finite abelian group, which is the direct sum of its
    p-parts. In every p-part, the rows modulo a power of p are reduced to Howell (triangular) form. Finally, the
    conditions on a single kind of wheel are combined.
    """
    rows = list({tuple(sorted((k, f % 1) for k, f in form.items() if f % 1)): None for form in forms})
    kinds = sorted({kind for row in rows for kind, _ in row})
    scale = math.lcm(*(value.denominator for row in rows for _, value in row))
    whole = [[int(dict(row).get(kind, 0) * scale) for kind in kinds] for row in rows]
    alone: dict[str, int] = {}
    mixed: list[tuple[int, Row]] = []
    for power in _prime_powers(scale):
        # p-part of a form: the multiple that is 1 modulo the power of p and 0 modulo the cofactor (Chinese remainders)
        lifted = [[value * pow(scale // power, -1, power) % power for value in row] for row in whole]
        for modulus, row in (_simplest_form(row, power) for row in _independent_generators(lifted, power)):
            terms = {kind: value for kind, value in zip(kinds, row, strict=True) if value}
            if len(terms) == 1:
                alone[next(iter(terms))] = alone.get(next(iter(terms)), 1) * modulus
            else:
                _join(mixed, modulus, terms)
    single = [(modulus, {kind: 1}) for kind, modulus in sorted(alone.items())]
    return DivisibilityRule(tuple(DivisibilityCondition(modulus, terms) for modulus, terms in (*single, *mixed)))


def _join(found: list[tuple[int, Row]], modulus: int, terms: Row) -> None:
    """Add the condition that `modulus` divides the sum with the weights `terms`. If its modulus and that of an earlier
    condition are coprime and one sum expresses both conditions, they are replaced by one condition on the product of
    the moduli.
    """
    for at, (other, known) in enumerate(found):
        kinds = {*known, *terms}
        for says, to in ((terms, other), (known, modulus)):
            if math.gcd(other, modulus) == 1 and not any((known.get(k, 0) - terms.get(k, 0)) % to for k in kinds):
                found[at] = (other * modulus, says)
                return
    found.append((modulus, terms))


def _prime_powers(number: int) -> Iterable[int]:
    prime = 2
    while number > 1:
        # trial division up to the square root; the remaining cofactor is prime
        if prime * prime > number:
            prime = number
        power = 1
        while number % prime == 0:
            power *= prime
            number //= prime
        if power > 1:
            yield power
        prime += 1


def _independent_generators(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Return a smallest subset of the rows of the Howell form that generates the same group modulo a prime power."""

    def group_order(some: Sequence[Sequence[int]]) -> int:
        firsts = (next(value for value in row if value) for row in _howell_form(some, power))
        return math.prod(power // math.gcd(first, power) for first in firsts)

    found = _howell_form(rows, power)
    for row in found[::-1]:
        fewer = [other for other in found if other is not row]
        if group_order(fewer) == group_order(found):
            found = fewer
    return found


def _howell_form(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Return the Howell (triangular) form of the rows modulo a prime power, which generates the same group."""
    found = []
    active = [list(row) for row in rows]
    width = len(active[0]) if active else 0
    for column in range(width):
        entries = [row for row in active if row[column] % power]
        if not entries:
            continue
        pivot = min(entries, key=lambda row: math.gcd(row[column], power))
        common = math.gcd(pivot[column], power)
        # invertible, because the common divisor with a prime power contains every factor p
        turn = pow(pivot[column] // common, -1, power)
        pivot = [value * turn % power for value in pivot]
        rest = []
        for row in active:
            times = row[column] // common
            rest.append([(a - times * b) % power for a, b in zip(row, pivot, strict=True)])
        # a multiple that is 0 in this column may still constrain the other columns
        rest.append([value * (power // common) % power for value in pivot])
        active = [row for row in rest if any(row)]
        found.append(pivot)
    return found


def _simplest_form(row: Sequence[int], power: int) -> tuple[int, list[int]]:
    """Return the modulus and the smallest equivalent weights of the congruence row · x = 0 (mod power)."""
    common = math.gcd(*row, power)
    modulus = power // common
    choices = []
    # the unit affects only the notation, so at most 1000 are tried
    for unit in range(1, min(modulus, 1000) + 1):
        if math.gcd(unit, modulus) == 1:
            reduced = [value // common * unit % modulus for value in row]
            weights = [value - modulus if 2 * value > modulus else value for value in reduced]
            first = next((value for value in weights if value), 0)
            # small weights are preferred, then few negative weights, then a positive first weight
            choices.append((sum(map(abs, weights)), sum(value < 0 for value in weights), first < 0, weights))
    return modulus, min(choices)[-1]


def _sum(terms: Mapping[str, int], short: bool) -> str:
    words: list[str] = []
    for kind, factor in terms.items():
        size = "" if abs(factor) == 1 else f"{abs(factor)} "
        sign = "- " if factor < 0 else "+ " if words else ""
        words.append(f"{sign}{size}{f'z{kind}' if short else f'z[{kind}]'}")
    return " ".join(words)


# ----------------------------------------------------------------------------------------------------------- loop phase


@dataclass(frozen=True)
class LoopPhase(Result):
    """Phase condition of one loop of meshes, with its residue: equations (2) and (3) of docs/closure.md."""

    KEYS = ("gears", "meshes", "weights", Key("verdict", "kind"), "residue", "slack", "how", "miss", "inside", "retime")

    gears: tuple[str, ...]
    """Wheels in their order around the loop; two wheels of one link that both belong to it are joined by `+`."""
    meshes: tuple[str, ...]
    """Names of the pairs in their order around the loop; the last pair closes it. If `together` is True, these are the
    pairs of several loops, in any order.
    """
    weights: tuple[int, ...]
    """Integer weight of each pair in the sum of the phase equations; 1 or -1 except in loops with compound wheels."""
    residue: Fraction | float
    """Weighted sum of the phase constants of the pairs minus the nearest integer, from -1/2 to 1/2 [pitch]; a Fraction
    if it is exact.
    """
    slack: float
    """Upper bound on the numerical error of `residue` [pitch]; 0 if the residue is an exact fraction."""
    how: ResidueKnowledge
    """Accuracy of the residue: "exact", "recognised" (exact, with inferred fractions), or "numeric"."""
    inside: Mapping[str, Fraction | float] | None
    """Signed angle of the arc inside the loop at each wheel [turn], which is the coefficient of its tooth count in the
    sum of the phase equations; None for loops with compound wheels.
    """
    retime: Mapping[str, float]
    """Rotation of each wheel on its arbor that would close the loop, counterclockwise [pitch]; one of these rotations
    is sufficient.
    """
    together: bool = False
    """True for a condition on several loops together that does not follow from the conditions of the single loops."""

    @property
    def kind(self) -> PhaseKind:
        """Verdict: "closes", "misses", or "unclear" if the positions are not accurate enough."""
        return judge_residue(self.residue, self.slack)

    @property
    def miss(self) -> Fraction | float:
        """Phase error of the last pair if all other pairs mesh exactly [pitch]. The teeth that engage are chosen so
        that its magnitude is minimal.
        """
        return self.residue / self.weights[-1]

    @property
    def text(self) -> str:
        """Description of the loop and its verdict in one line of text."""
        name = " - ".join((*self.gears, *self.gears[:1])) if self.gears else f"{', '.join(self.meshes)} together"
        accuracy = {"exact": "", "recognised": " (angles recognised)", "numeric": f" (to {self.slack:.1g})"}[self.how]
        if self.kind == "closes":
            return f"{name} closes{accuracy}"
        if self.kind == "unclear":
            return f"{name} is undecided: positions are accurate to {self.slack:.2g} pitch only"
        miss = abs(self.miss)
        size = fraction_text(miss) if isinstance(miss, Fraction) else f"{miss:.6g}"
        words = f"{name} misses by {size} pitch at {self.meshes[-1]}{accuracy}"
        if self.retime:
            # the wheel with the smallest rotation is suggested
            wheel, turned = min(self.retime.items(), key=lambda each: abs(each[1]))
            words += f"; {wheel} turned on its arbor by {turned:.6g} pitch would close it"
        return words


def describe_loop(problem: PhaseSystem, condition: PhaseCondition) -> LoopPhase:
    """Return a phase condition as a `LoopPhase`, with the names of its wheels and pairs."""
    gears: list[str] = []
    over: dict[str, int] = {}
    cycle = condition.cycle
    row = condition.row
    if cycle is not None:
        before = cycle.meshes[-1]
        for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
            came, goes = (_wheel(problem, one, node) for one in (before, mesh))
            # different wheels: the loop passes over a compound wheel
            gears.append(came if came == goes else f"{came}+{goes}")
            if came != goes:
                over |= {came: _sum_change(problem, before, node, row), goes: _sum_change(problem, mesh, node, row)}
            before = mesh
    meshes = cycle.meshes if cycle else tuple(row)
    return LoopPhase(
        tuple(gears),
        tuple(problem.circuits[mesh].id for mesh in meshes),
        tuple(row[mesh] for mesh in meshes),
        condition.residue,
        condition.slack,
        condition.how,
        None if over or cycle is None else _inside_angles(problem, condition),
        {wheel: float(condition.residue) / pull for wheel, pull in over.items() if condition.kind == "misses"},
        cycle is None,
    )


def _wheel(problem: PhaseSystem, mesh: int, node: int) -> str:
    return problem.circuits[mesh].wheels[problem.ends[mesh][1] == node]


def _sum_change(problem: PhaseSystem, mesh: int, node: int, row: Mapping[int, int]) -> int:
    """Return the change of a loop's weighted sum of phase equations if a wheel is rotated by one pitch [pitch]."""
    return row[mesh] * (1 if problem.ends[mesh][0] == node or problem.circuits[mesh].b > 0 else -1)


def _inside_angles(problem: PhaseSystem, condition: PhaseCondition) -> dict[str, Fraction | float]:
    """Return the angle between the two contacts of each gear in a loop, multiplied by its weight [turn]."""
    contacts, cycle = problem.contacts, condition.cycle
    assert cycle is not None
    exact = isinstance(condition.residue, Fraction)
    found: dict[str, Fraction | float] = {}
    before = cycle.meshes[-1]
    for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
        part: Fraction | float = Fraction(0)
        for one in (before, mesh):
            side = problem.ends[one][1] == node
            # families cancel in an exact residue, so angles within the family suffice
            angle = contacts.part[one][side] if exact else float(contacts.azimuth[one, int(side)])
            part += _sum_change(problem, one, node, condition.row) * angle
        gear = _wheel(problem, mesh, node)
        found[gear] = found.get(gear, Fraction(0)) + part
        before = mesh
    return found


# --------------------------------------------------------------------------------------------------------- mesh phasing


_SHOWN = 10  # maximum number of loops listed in a text


@dataclass(frozen=True)
class MeshPhasing(Result):
    """Assembly condition of a train: mesh phases around every loop, and angles at which the wheels are mounted.

    See equations (1) to (4) of docs/closure.md. The truth value of the result is False if a loop does not close or is
    unclear.

    Examples
    --------
    Two planets with 18 teeth are placed opposite each other between a sun with 24 teeth and a ring with 60 teeth. They
    can be assembled, because 2 divides 24 + 60.

    >>> import geartrain
    >>> found = geartrain.load("planets-in-place").closure
    >>> found.kind, found.worst, len(found.loops)
    ('closes', Fraction(0, 1), 2)
    >>> found.loops[0].gears, found.loops[0].weights
    (('p2', 's', 'p1', 'ring'), (-1, 1, -1, 1))
    """

    KEYS = (
        Key("verdict", "kind"),
        "text",
        "how",
        "worst",
        "loops",
        "rule",
        Key("angles", to=math.degrees),
        Key("wheels", to=math.degrees),
        Key("errors", "spread_errors"),
        "last",
        "spread",
        "fits",
        "unjudged",
        "omitted",
        "rigid",
        Key("complete", "problem.complete"),
    )

    PAGE = "report.train_report:phasing_document"

    problem: PhaseSystem = field(repr=False)
    """Phase equations of all meshes."""
    backlashes: Mapping[str, float] = field(default_factory=dict)
    """Circumferential backlash of each pair whose tooth form determines a backlash [pitch]."""
    alike: Callable[[], Mapping[str, str]] = field(default=dict, repr=False)
    """Function that returns the name in `rule` of each wheel's tooth count; equal wheels have the same name."""
    unjudged: int = 0
    """Number of loops that cannot be checked because the position of one of their pairs or couplings is unknown."""

    def _summary(self) -> str:
        if "kind" not in vars(self):
            return "not judged yet"
        worst = "" if self.kind == "open" else f", worst miss {float(self.worst):.3g} pitches"
        return f"{self.kind}: {len(self.problem.conditions)} loops{worst}"

    @cached_property
    def loops(self) -> Sequence[LoopPhase]:
        """Phase conditions of short loops (a cycle basis), then conditions that each concern several loops."""
        return tuple(describe_loop(self.problem, condition) for condition in self.problem.conditions)

    @cached_property
    def missing(self) -> tuple[int, ...]:
        """Indices of the loops that do not close, in descending order of their phase errors."""
        found = [(-abs(float(one.miss)), at) for at, one in enumerate(self.problem.conditions) if one.kind == "misses"]
        return tuple(at for _, at in sorted(found))

    @cached_property
    def kind(self) -> PhaseKind:
        """Result of checking whether the tooth phases of all loops of meshes are compatible: "closes" (all are),
        "misses" (a loop is not), "unclear" (the check of a loop is inconclusive), or "open" (no loop can be checked).
        """
        if self.missing:
            return "misses"
        if not self.problem.conditions:
            return "open"
        return "unclear" if any(one.kind == "unclear" for one in self.problem.conditions) else "closes"

    def __bool__(self) -> bool:
        """Return False if a loop does not close or is unclear, and True if all loops close."""
        return self.kind in ("closes", "open")

    @property
    def how(self) -> ResidueKnowledge:
        """Lowest accuracy of the residues of all loops: "exact", "recognised" or "numeric"."""
        ways = {one.how for one in self.problem.conditions}
        return "numeric" if "numeric" in ways else "recognised" if "recognised" in ways else "exact"

    @property
    def rigid(self) -> int:
        """Number of loops with a ratio product other than 1, which cannot turn and have no phase condition."""
        return len(self.problem.parts.breaking)

    @property
    def omitted(self) -> tuple[UnplacedPair, ...]:
        """Pairs and couplings that were not checked because their positions are unknown."""
        return self.problem.contacts.omitted

    @cached_property
    def worst(self) -> Fraction | float:
        """Maximum magnitude of the phase error of the last pair in any loop [pitch]."""
        misses = [one.miss for one in self.problem.conditions]
        worst = max(misses, key=lambda miss: abs(float(miss)), default=Fraction(0))
        return -worst if worst < 0 else worst

    @cached_property
    def angles(self) -> Mapping[str, float]:
        """Angle of the zero mark of every link in the pose in which all teeth mesh, in [0, 2 pi) [rad].

        Angles are measured counterclockwise about the positive sense of the axis from the projection of x (of y if the
        axis is nearly parallel to x). Carriers are in their declared pose if possible. All wheels of a link have a
        tooth at the zero mark of the link. If loops do not close, their phase errors are distributed. A wheel on the
        frame is listed like a link, by its own name.
        """
        turns = self.problem.spread_angles if self.missing else self.problem.tree_angles
        parts = self.problem.parts
        return {
            _name(link): turns[at] % 1.0 * math.tau
            for at, link in enumerate(parts.links)
            if at in parts.nodes_of or at in self.problem.carriers
        }

    @cached_property
    def wheels(self) -> Mapping[str, float]:
        """Angle of the first tooth of every wheel from its reference direction, from 0 to one pitch [rad]."""
        angles, found = self.angles, {}
        for circuit in self.problem.circuits:
            teeth = (circuit.a, abs(circuit.b))
            for wheel, link, z in zip(circuit.wheels, (circuit.i, circuit.j), teeth, strict=True):
                found[wheel] = angles[_name(link)] % (math.tau / z)
        return found

    @cached_property
    def errors(self) -> Mapping[str, float]:
        """Phase error of every pair [pitch] if the phase errors of the loops are distributed by least squares."""
        return self._errors(self.problem.spread_angles)

    @property
    def spread_errors(self) -> Mapping[str, float]:
        """Phase error of every pair [pitch] as in `errors`; empty if all loops close."""
        return self.errors if self.missing else {}

    @cached_property
    def last_errors(self) -> Mapping[str, float]:
        """Phase error of every pair [pitch] if the last pair of each loop takes up the loop's entire phase error."""
        return self._errors(self.problem.tree_angles)

    @cached_property
    def last(self) -> float:
        """Maximum magnitude of the phase errors in `last_errors` [pitch]; 0 if all loops close."""
        return max(map(abs, self.last_errors.values()), default=0.0) if self.missing else 0.0

    @cached_property
    def spread(self) -> float:
        """Maximum magnitude of the phase errors distributed by least squares [pitch]; 0 if all loops close."""
        return max(map(abs, self.errors.values()), default=0.0) if self.missing else 0.0

    @cached_property
    def fits(self) -> bool | None:
        """True if all loops close, or if the backlash of each pair is sufficient for its phase error in `errors`; False
        if the backlash of a pair is too small. None if all loops that can be checked close but a loop cannot be
        checked, or if a required backlash is unknown.
        """
        if not self.missing:
            return None if self.kind == "unclear" else True
        errors = self.errors
        # a tooth in the middle of its gap can move by half of the backlash to either side
        if any(abs(error) > self.backlashes[name] / 2 for name, error in errors.items() if name in self.backlashes):
            return False
        # errors below 1e-9 pitch are rounding errors, and need no backlash
        off = [name for name, error in errors.items() if abs(error) > 1e-9]
        return True if all(name in self.backlashes for name in off) else None

    @cached_property
    def rule(self) -> DivisibilityRule | None:
        """Divisibility rule of the tooth counts; None if a residue is not exact, if wheels are compound, or if a loop
        has an odd number of pairs.
        """
        forms, kinds = [], self.alike()
        for loop in self.loops:
            # an odd number of meshes adds half a pitch, which no divisibility condition can express
            if loop.inside is None or len(loop.meshes) % 2:
                return None
            form: dict[str, Fraction] = {}
            for gear, part in loop.inside.items():
                if not isinstance(part, Fraction):
                    return None
                kind = kinds.get(gear, gear)
                form[kind] = form.get(kind, Fraction(0)) + part
            forms.append(form)
        return find_divisibility_rule(forms)

    @property
    def text(self) -> str:
        """Verdict and its consequences, as lines of text."""
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        count = len(self.problem.conditions)
        loops = f"{count} loop{'s' if count != 1 else ''}"
        if self.kind == "open":
            yield "phase closure: no loop " + ("can be checked" if self.unjudged else "with a phase condition")
        elif self.kind == "misses":
            yield f"phase closure: {len(self.missing)} of {loops} miss{'es' if len(self.missing) == 1 else ''}"
        elif self.kind == "closes":
            # maximum error of all residues
            near = f"to {max(one.slack for one in self.problem.conditions):.1g} pitch"
            ways = {"exact": "exactly", "recognised": "exactly, with angles inferred from rounded positions"}
            yield f"phase closure: {loops} close{'s' if count == 1 else ''}, {ways.get(self.how, near)}"
        else:
            yield f"phase closure: not all of {loops} can be decided, because positions are too inaccurate"
        shown = self.missing or [at for at, one in enumerate(self.problem.conditions) if one.kind == "unclear"]
        yield from (f"  {describe_loop(self.problem, self.problem.conditions[at]).text}" for at in shown[:_SHOWN])
        if len(shown) > _SHOWN:
            yield f"  and {len(shown) - _SHOWN} more"
        if self.missing:
            yield f"  assembled one after the other, the last meshes are off by up to {self.last:.6g} pitch"
            effects = {
                True: ", which the backlash absorbs",
                False: ", which the backlash does not absorb",
                None: ", and not all backlash is known",
            }
            effect = effects[self.fits] if self.backlashes else ""
            yield f"  distributed over all meshes, errors are up to {self.spread:.6g} pitch{effect}"
        if self.unjudged:
            passes = "loop passes" if self.unjudged == 1 else "loops pass"
            yield f"  {self.unjudged} {passes} through pairs with unknown position, not checked:"
            yield from (f"    {one.name}: {one.why}" for one in self.omitted[:_SHOWN])
        if self.rigid:
            yield f"  {self.rigid} loop{'s' if self.rigid > 1 else ''} cannot turn, without phase condition"
        if not self.problem.complete:
            yield "  loops were checked one by one, without conditions on several loops together"

    def _errors(self, angles: Sequence[float] | Floats) -> dict[str, float]:
        found = self.problem.errors(angles).tolist()
        return {circuit.id: error for circuit, error in zip(self.problem.circuits, found, strict=True)}


def _name(link: str) -> str:
    """Return the name of a link. For a wheel that is mounted on the frame, return the name of the wheel."""
    return link.rpartition(MOUNT)[2]


def find_phasing(
    train: Train, tree: Tree, circuits: Sequence[Circuit], backlashes: Mapping[str, float] | None = None
) -> MeshPhasing:
    """Return the mesh phases of a declared train around its loops, in the pose in which its moving axes are declared.

    backlashes   circumferential backlash [pitch] of each pair for which it is known, by pair
    """
    contacts = place_pitch_points(train, tree, circuits)
    parts = find_components(_links(train, contacts.circuits), train.frame, contacts.circuits)
    unjudged = 0
    if contacts.omitted:
        every = [mount_frame_wheels(circuit, train.frame) for circuit in circuits]
        whole = find_components(_links(train, every), train.frame, every)
        # loops that are closed only by pairs with unknown positions
        unjudged = max(len(whole.closing) - len(parts.closing), 0)
    return MeshPhasing(PhaseSystem(parts, contacts), dict(backlashes or {}), lambda: _equal_wheels(train), unjudged)


def _links(train: Train, circuits: Sequence[Circuit]) -> tuple[str, ...]:
    mounts = (link for circuit in circuits for link in (circuit.i, circuit.j) if MOUNT in link)
    return tuple(dict.fromkeys([*train.links, *mounts]))


def _equal_wheels(train: Train) -> dict[str, str]:
    """Return, for each wheel, the name of the first wheel that is equal to it and has equal mates."""
    marks = {name: (wheel.count, wheel.internal) for name, (_, wheel) in train.wheels.items()}
    mates: dict[str, list[object]] = {name: [] for name in marks}
    for gear in train.gears:
        first, second = gear.pair
        mates[first].append(marks[second])
        mates[second].append(marks[first])
    heads: dict[object, str] = {}
    return {name: heads.setdefault((mark, tuple(sorted(map(repr, mates[name])))), name) for name, mark in marks.items()}
