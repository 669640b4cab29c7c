"""Whether the meshes of closed loops can engage: the verdict, the loops, wheel angles for assembly, errors spread.

A loop lists its gears in order, the divisibility rule of its tooth counts (which counts, or sums of them, must be
multiples of what), and the fraction of a pitch by which it misses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from geartrain.errors import Problem as Trouble
from geartrain.errors import QuestionError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.components import find_components
from geartrain.kinematics.phasing.azimuths import (
    EPS,
    MOUNT,
    PitchPoints,
    UnplacedPair,
    contact_families,
    mount_frame_wheels,
    place_pitch_points,
)
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
    """`modulus` divides the sum of tooth numbers, each times its factor."""

    modulus: int
    """Divides the weighted sum of the tooth counts."""
    factors: Mapping[str, int]
    """Weight of each tooth count, by wheel."""


@dataclass(frozen=True)
class DivisibilityRule(Result):
    """Conditions on the tooth numbers of a set: in each a modulus divides a sum of multiples of tooth numbers.

    See Also
    --------
    find_divisibility_rule : Gives it.
    spherical_divisibility_rule : Gives it for gears with axes through one point.
    """

    KEYS = ("text", "conditions")

    conditions: tuple[DivisibilityCondition, ...]
    """Modulus, and the factor of each kind's tooth number in the sum that it divides."""

    @property
    def text(self) -> str:
        """In words: `3 divides za and 5 divides zb`."""
        kinds = [kind for _, terms in self.conditions for kind in terms]
        short = all(kind[:1].isdigit() or len(kind) <= 2 for kind in kinds)  # z5, z4a and ze, else z[sun]
        sums = (f"{modulus} divides {_sum(terms, short)}" for modulus, terms in self.conditions)
        return " and ".join(sums) or "always"

    def holds(self, teeth: Mapping[str, int]) -> bool:
        """True if the set closes with these tooth numbers.

        Parameters
        ----------
        teeth : mapping of str to int
            Tooth number of each kind.
        """
        return not any(sum(f * teeth[kind] for kind, f in terms.items()) % m for m, terms in self.conditions)


def find_divisibility_rule(forms: Iterable[Mapping[str, Fraction]]) -> DivisibilityRule:
    """The rule that all forms take whole values: sum of form[kind] z[kind] is an integer for each.

    Forms matter modulo 1, and generate a finite group; it is the sum of its parts for each prime p, and in every part
    rows modulo a power of p are brought to a triangle. Conditions on one kind only are joined again.

    Parameters
    ----------
    forms : iterable of mapping of str to Fraction
        Factor of each kind's tooth number.

    Returns
    -------
    DivisibilityRule
        No condition follows from the others.

    Examples
    --------
    >>> from fractions import Fraction
    >>> find_divisibility_rule([{"a": Fraction(2, 3), "b": Fraction(-2, 5)}]).text
    '3 divides za and 5 divides zb'
    """
    rows = list({tuple(sorted((k, f % 1) for k, f in form.items() if f % 1)): None for form in forms})
    kinds = sorted({kind for row in rows for kind, _ in row})
    scale = math.lcm(*(value.denominator for row in rows for _, value in row))
    whole = [[int(dict(row).get(kind, 0) * scale) for kind in kinds] for row in rows]
    alone: dict[str, int] = {}
    mixed: list[tuple[int, Row]] = []
    for power in _prime_powers(scale):
        # the part for p of a form: a multiple that is 1 modulo the power of p and 0 modulo the rest
        lifted = [[value * pow(scale // power, -1, power) % power for value in row] for row in whole]
        for modulus, row in (_plain(row, power) for row in _needed(lifted, power)):
            terms = {kind: value for kind, value in zip(kinds, row, strict=True) if value}
            if len(terms) == 1:
                alone[next(iter(terms))] = alone.get(next(iter(terms)), 1) * modulus
            else:
                _join(mixed, modulus, terms)
    single = [(modulus, {kind: 1}) for kind, modulus in sorted(alone.items())]
    return DivisibilityRule(tuple(DivisibilityCondition(modulus, terms) for modulus, terms in (*single, *mixed)))


def _join(found: list[tuple[int, Row]], modulus: int, terms: Row) -> None:
    """Add a condition; to one of another prime where the same sum says both."""
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
        # trial division: what has no divisor up to its root is prime
        if prime * prime > number:
            prime = number
        power = 1
        while number % prime == 0:
            power *= prime
            number //= prime
        if power > 1:
            yield power
        prime += 1


def _needed(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Generators of the same group without those that the others make too."""
    found = _triangle(rows, power)
    for row in found[::-1]:
        fewer = [other for other in found if other is not row]
        if _order(fewer, power) == _order(found, power):
            found = fewer
    return found


def _order(rows: Sequence[Sequence[int]], power: int) -> int:
    """The number of elements of the group."""
    firsts = (next(value for value in row if value) for row in _triangle(rows, power))
    return math.prod(power // math.gcd(first, power) for first in firsts)


def _triangle(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Rows that generate the same group modulo a prime power, in triangular (Howell) form."""
    found = []
    active = [list(row) for row in rows]
    width = len(active[0]) if active else 0
    for column in range(width):
        entries = [row for row in active if row[column] % power]
        if not entries:
            continue
        pivot = min(entries, key=lambda row: math.gcd(row[column], power))
        common = math.gcd(pivot[column], power)
        turn = pow(pivot[column] // common, -1, power)
        pivot = [value * turn % power for value in pivot]
        rest = []
        for row in active:
            times = row[column] // common
            rest.append([(a - times * b) % power for a, b in zip(row, pivot, strict=True)])
        # a multiple that clears the column may say something about the others
        rest.append([value * (power // common) % power for value in pivot])
        active = [row for row in rest if any(row)]
        found.append(pivot)
    return found


def _plain(row: Sequence[int], power: int) -> tuple[int, list[int]]:
    """The same condition in the smallest numbers."""
    common = math.gcd(*row, power)
    modulus = power // common
    row = [value // common for value in row]
    # only how the condition reads depends on the unit: past 1000 of them none is looked at
    units = [unit for unit in range(1, min(modulus, 1000) + 1) if math.gcd(unit, modulus) == 1]
    return modulus, min((_centred(row, unit, modulus) for unit in units), key=_size)


def _centred(row: Sequence[int], unit: int, modulus: int) -> list[int]:
    found = [value * unit % modulus for value in row]
    return [value - modulus if 2 * value > modulus else value for value in found]


def _size(row: Sequence[int]) -> tuple[int, int, int, list[int]]:
    """Small factors first, then few minus signs, then a plus in front."""
    first = next((value for value in row if value), 0)
    return sum(map(abs, row)), sum(value < 0 for value in row), first < 0, list(row)


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
    """What one loop of meshes asks of its teeth, and what it gets: equations (2) and (3) of docs/closure.md.

    See Also
    --------
    MeshPhasing : an example
    """

    KEYS = ("gears", "meshes", "weights", Key("verdict", "kind"), "residue", "slack", "how", "miss", "inside", "retime")

    gears: tuple[str, ...]
    """Wheels in order; two wheels of one link between which the loop goes over are joined by `+`."""
    meshes: tuple[str, ...]
    """Pairs in order, the last one closes the loop. Where `together`, pairs of several loops in no order."""
    weights: tuple[int, ...]
    """Whole numbers with which the equations of the pairs add up; 1 and -1 but for compound wheels."""
    residue: Fraction | float
    """What the sum is off a whole number [pitch], from -1/2 to 1/2; a Fraction where it is exact."""
    slack: float
    """How far off the residue may be [pitch]; 0 where it is exact."""
    how: ResidueKnowledge
    """Recognised: exact, with angles taken for fractions that rounded positions allow."""
    inside: Mapping[str, Fraction | float] | None
    """For each gear the part of a turn, with its sign, by which its tooth number enters the sum; None where wheels
    are compound."""
    retime: Mapping[str, float]
    """By how much to turn a wheel on its arbor, counterclockwise [pitch], to close the loop: any one of them."""
    together: bool = False
    """True for what several loops must fulfil only together."""

    @property
    def kind(self) -> PhaseKind:
        """closes, misses, or unclear where positions are too rough to tell."""
        return judge_residue(self.residue, self.slack)

    @property
    def miss(self) -> Fraction | float:
        """What is left at the last pair when all others fit (pitches), with the best choice of teeth to engage."""
        return self.residue / self.weights[-1]

    @property
    def text(self) -> str:
        """One line."""
        name = " - ".join((*self.gears, *self.gears[:1])) if self.gears else f"{', '.join(self.meshes)} together"
        if self.kind == "closes":
            return f"{name} closes{self._doubt}"
        if self.kind == "unclear":
            return f"{name} cannot be told: positions are known to {self.slack:.2g} pitch only"
        words = f"{name} misses by {_shown(self.miss)} pitch at {self.meshes[-1]}{self._doubt}"
        if self.retime:
            wheel, turned = min(self.retime.items(), key=lambda each: abs(each[1]))
            words += f"; {wheel} turned on its arbor by {turned:.6g} pitch would close it"
        return words

    @property
    def _doubt(self) -> str:
        if self.how == "exact":
            return ""
        return " (angles recognised)" if self.how == "recognised" else f" (to {self.slack:.1g})"


def describe_loop(problem: PhaseSystem, condition: PhaseCondition) -> LoopPhase:
    """A condition with the names of gears and pairs."""
    gears: list[str] = []
    over: dict[str, int] = {}
    cycle = condition.cycle
    row = condition.row
    if cycle is not None:
        before = cycle.meshes[-1]
        for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
            came, goes = (_wheel(problem, one, node) for one in (before, mesh))
            gears.append(came if came == goes else f"{came}+{goes}")
            if came != goes:
                over |= {came: _pull(problem, before, node, row), goes: _pull(problem, mesh, node, row)}
            before = mesh
    meshes = cycle.meshes if cycle else tuple(row)
    return LoopPhase(
        tuple(gears),
        tuple(problem.circuits[mesh].id for mesh in meshes),
        tuple(row[mesh] for mesh in meshes),
        condition.residue,
        condition.slack,
        condition.how,
        None if over or cycle is None else _inside(problem, condition),
        {wheel: float(condition.residue) / pull for wheel, pull in over.items() if condition.kind == "misses"},
        cycle is None,
    )


def _wheel(problem: PhaseSystem, mesh: int, node: int) -> str:
    return problem.circuits[mesh].wheels[problem.ends[mesh][1] == node]


def _pull(problem: PhaseSystem, mesh: int, node: int, row: Mapping[int, int]) -> int:
    """What a pitch by which one wheel is turned on its arbor adds to the sum of a loop."""
    circuit = problem.circuits[mesh]
    return row[mesh] * (1 if problem.ends[mesh][0] == node or circuit.b > 0 else -1)


def _inside(problem: PhaseSystem, condition: PhaseCondition) -> dict[str, Fraction | float]:
    """Weights and signs times the azimuths of both contacts of each gear: the teeth that it has inside the loop."""
    contacts, cycle = problem.contacts, condition.cycle
    assert cycle is not None
    exact = isinstance(condition.residue, Fraction)
    found: dict[str, Fraction | float] = {}
    before = cycle.meshes[-1]
    for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
        part: Fraction | float = Fraction(0)
        for one in (before, mesh):
            side = problem.ends[one][1] == node
            angle = contacts.part[one][side] if exact else float(contacts.azimuth[one, int(side)])
            part += _pull(problem, one, node, condition.row) * angle
        gear = _wheel(problem, mesh, node)
        found[gear] = found.get(gear, Fraction(0)) + part
        before = mesh
    return found


def _shown(value: Fraction | float) -> str:
    return fraction_text(abs(value)) if isinstance(value, Fraction) else f"{abs(value):.6g}"


# --------------------------------------------------------------------------------------------------------- mesh phasing


_SHOWN = 10  # loops named in a text


@dataclass(frozen=True)
class MeshPhasing(Result):
    """The assembly condition: whether the teeth of every loop meet, and the angles at which the wheels are put in.

    Equations (1) to (4) of docs/closure.md. True unless some loop misses or cannot be told.

    Examples
    --------
    Two planets of 18 teeth opposite each other between 24 and 60: 2 divides 24 + 60, and they go in (docs/closure.md).

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
        "left_out",
        "rigid",
        Key("complete", "problem.complete"),
    )

    PAGE = "report.train_report:phasing_document"

    problem: PhaseSystem = field(repr=False)
    """The phases of all meshes."""
    backlashes: Mapping[str, float] = field(default_factory=dict)
    """Play of pairs whose teeth know it [pitch]."""
    alike: Callable[[], Mapping[str, str]] = field(default=dict, repr=False)
    """Gives wheel -> name under which its tooth number stands in `rule`."""
    unjudged: int = 0
    """Loops of the train that go through a pair or pin without a known place."""

    def _summary(self) -> str:
        if "kind" not in vars(self):
            return "not judged yet"
        worst = "" if self.kind == "open" else f", worst miss {float(self.worst):.3g} pitches"
        return f"{self.kind}: {len(self.problem.conditions)} loops{worst}"

    @cached_property
    def loops(self) -> Sequence[LoopPhase]:
        """A basis of all loops, as short as they are found; then what loops must only fulfil together."""
        return _Loops(self.problem)

    @cached_property
    def missing(self) -> tuple[int, ...]:
        """Which loops do not close: the worst first."""
        found = [(-abs(float(one.miss)), at) for at, one in enumerate(self.problem.conditions) if one.kind == "misses"]
        return tuple(at for _, at in sorted(found))

    @cached_property
    def kind(self) -> PhaseKind:
        """closes, misses, unclear (some loop cannot be told), or open: no loop is judged."""
        if self.missing:
            return "misses"
        if not self.problem.conditions:
            return "open"
        return "unclear" if any(one.kind == "unclear" for one in self.problem.conditions) else "closes"

    def __bool__(self) -> bool:
        """True unless some loop misses or cannot be told."""
        return self.kind in ("closes", "open")

    @property
    def how(self) -> ResidueKnowledge:
        """How the loops are known, by the weakest of them."""
        ways = {one.how for one in self.problem.conditions}
        return "numeric" if "numeric" in ways else "recognised" if "recognised" in ways else "exact"

    @property
    def rigid(self) -> int:
        """Loops whose ratios do not multiply to 1; they cannot turn, and are not asked for phases."""
        return len(self.problem.parts.breaking)

    @property
    def left_out(self) -> tuple[UnplacedPair, ...]:
        """Pairs and couplings without a known place."""
        return self.problem.contacts.left_out

    @cached_property
    def worst(self) -> Fraction | float:
        """The largest miss of a loop (pitches)."""
        misses = [one.miss for one in self.problem.conditions]
        worst = max(misses, key=lambda miss: abs(float(miss)), default=Fraction(0))
        return -worst if worst < 0 else worst

    @cached_property
    def angles(self) -> Mapping[str, float]:
        """Angle of every link (rad, from 0 to a turn) at which its zero mark stands for all teeth to mesh.

        Counterclockwise about its positive sense from x, as seen along its axis (from y where the axis is nearly x),
        with carriers in the pose in which they are declared where they can stand in it. The teeth of all wheels of a
        link have a tooth at its mark. Where loops miss, errors are spread. A wheel on the frame is named as a link.
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
        """Angle of the first tooth of every wheel from its reference direction (rad, from 0 to its pitch)."""
        angles, found = self.angles, {}
        for circuit in self.problem.circuits:
            teeth = (circuit.a, abs(circuit.b))
            for wheel, link, z in zip(circuit.wheels, (circuit.i, circuit.j), teeth, strict=True):
                found[wheel] = angles[_name(link)] % (math.tau / z)
        return found

    @cached_property
    def errors(self) -> Mapping[str, float]:
        """What every pair is off where the loops miss, spread by least squares (pitches)."""
        return self._errors(self.problem.spread_angles)

    @property
    def spread_errors(self) -> Mapping[str, float]:
        """The same; nothing where all loops close."""
        return self.errors if self.missing else {}

    @cached_property
    def last_errors(self) -> Mapping[str, float]:
        """What pairs are off if all the error is left to the pairs put in last (pitches)."""
        return self._errors(self.problem.tree_angles)

    @cached_property
    def last(self) -> float:
        """The largest of `last_errors` (pitches): residues of loops add up from one to the next."""
        return max(map(abs, self.last_errors.values()), default=0.0) if self.missing else 0.0

    @cached_property
    def spread(self) -> float:
        """The largest error when it is spread over all meshes (pitches); 0 where all loops close."""
        return max(map(abs, self.errors.values()), default=0.0) if self.missing else 0.0

    @cached_property
    def fits(self) -> bool | None:
        """True if the play of the teeth takes up the errors as spread; None where loops miss and a play is unknown."""
        if not self.missing:
            return None if self.kind == "unclear" else True
        errors = self.errors
        if any(abs(error) > self.backlashes[name] / 2 for name, error in errors.items() if name in self.backlashes):
            return False
        # less than 1e-9 pitch is rounding, and needs no play
        off = [name for name, error in errors.items() if abs(error) > 1e-9]
        return True if all(name in self.backlashes for name in off) else None

    @cached_property
    def rule(self) -> DivisibilityRule | None:
        """What the tooth numbers must be multiples of; None where loops are not exact, or wheels are compound."""
        forms, kinds = [], self.alike()
        for loop in self.loops:
            form = _by_kind(loop.inside, kinds)
            if form is None or len(loop.meshes) % 2:
                return None
            forms.append(form)
        return find_divisibility_rule(forms)

    @property
    def text(self) -> str:
        """The verdict and what follows from it, in lines."""
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        count = len(self.problem.conditions)
        loops = f"{count} loop{'s' if count != 1 else ''}"
        if self.kind == "open":
            yield "phase closure: no loop whose teeth would have to meet" + (" is judged" if self.unjudged else "")
        elif self.kind == "misses":
            yield f"phase closure: {len(self.missing)} of {loops} miss{'es' if len(self.missing) == 1 else ''}"
        elif self.kind == "closes":
            near = f"to {max(one.slack for one in self.problem.conditions):.1g} pitch"
            ways = {"exact": "exactly", "recognised": "exactly, with the angles that rounded positions mean"}
            yield f"phase closure: {loops} close{'s' if count == 1 else ''}, {ways.get(self.how, near)}"
        else:
            yield f"phase closure: not all of {loops} can be told, for positions are too rough"
        shown = self.missing or [at for at, one in enumerate(self.problem.conditions) if one.kind == "unclear"]
        yield from (f"  {self.loops[at].text}" for at in shown[:_SHOWN])
        if len(shown) > _SHOWN:
            yield f"  and {len(shown) - _SHOWN} more"
        if self.missing:
            yield f"  put in one after the other, the last meshes are off by up to {self.last:.6g} pitch"
            yield f"  spread over all meshes, errors are up to {self.spread:.6g} pitch{self._backlash}"
        if self.unjudged:
            goes = "loop goes" if self.unjudged == 1 else "loops go"
            yield f"  {self.unjudged} {goes} through pairs without a known place, not judged:"
            yield from (f"    {one.name}: {one.why}" for one in self.left_out[:_SHOWN])
        if self.rigid:
            yield f"  {self.rigid} loop{'s' if self.rigid > 1 else ''} cannot turn, not asked for phases"
        if not self.problem.complete:
            yield "  loops were judged one by one: what they must only fulfil together was not looked for"

    @property
    def _backlash(self) -> str:
        if not self.backlashes:
            return ""
        words = {
            True: "which the play takes up",
            False: "which the play does not take up",
            None: "and not all play is known",
        }
        return f", {words[self.fits]}"

    def _errors(self, angles: Sequence[float] | Floats) -> dict[str, float]:
        found = self.problem.errors(angles).tolist()
        return {circuit.id: error for circuit, error in zip(self.problem.circuits, found, strict=True)}


class _Loops(Sequence[LoopPhase]):
    """Conditions made readable one at a time, when they are looked at."""

    def __init__(self, problem: PhaseSystem) -> None:
        self.problem = problem

    def __len__(self) -> int:
        return len(self.problem.conditions)

    def __getitem__(self, at: Any) -> Any:
        if isinstance(at, slice):
            return [self[one] for one in range(*at.indices(len(self)))]
        return describe_loop(self.problem, self.problem.conditions[at])


def _by_kind(inside: Mapping[str, Fraction | float] | None, kinds: Mapping[str, str]) -> dict[str, Fraction] | None:
    if inside is None:
        return None
    form: dict[str, Fraction] = {}
    for gear, part in inside.items():
        if not isinstance(part, Fraction):
            return None
        kind = kinds.get(gear, gear)
        form[kind] = form.get(kind, Fraction(0)) + part
    return form


def _name(link: str) -> str:
    """A link; a wheel on the frame by the wheel's name."""
    return link.rpartition(MOUNT)[2]


_FRAME = MOUNT  # no gear on a sphere has this name
_OFF = 1e-6  # turns: contacts declared regular stand nearer than this to where they should


class SphericalGears(Protocol):
    """Gears with axes through one point.

    See Also
    --------
    geartrain.spherical.Configuration : Has these attributes.
    """

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the gears."""

    @property
    def axes(self) -> Floats:
        """Outward unit vectors, (gears, 3)."""

    @property
    def meshes(self) -> tuple[tuple[int, int], ...]:
        """Pairs of gears by index."""

    @property
    def kinds(self) -> tuple[str, ...]:
        """Kind of each gear."""

    @property
    def regular(self) -> tuple[int, ...]:
        """p where the contacts of a gear stand at multiples of a p-th of a turn; 0 where angles are floats."""

    @property
    def teeth(self) -> Mapping[str, int]:
        """Tooth number of each kind."""


def find_phasing(
    train: Train, tree: Tree, circuits: Sequence[Circuit], backlashes: Mapping[str, float] | None = None
) -> MeshPhasing:
    """Closure of a declared train, in the pose in which its moving axes are declared.

    plays   pair -> play of its teeth (pitches), as far as it is known
    """
    contacts = place_pitch_points(train, tree, circuits)
    parts = find_components(_links(train, contacts.circuits), train.frame, contacts.circuits)
    unjudged = 0
    if contacts.left_out:
        every = [mount_frame_wheels(circuit, train.frame) for circuit in circuits]
        whole = find_components(_links(train, every), train.frame, every)
        unjudged = max(len(whole.closing) - len(parts.closing), 0)
    return MeshPhasing(PhaseSystem(parts, contacts), dict(backlashes or {}), lambda: _alike(train), unjudged)


def _links(train: Train, circuits: Sequence[Circuit]) -> tuple[str, ...]:
    """All links, and the frame's wheels as links of their own."""
    mounts = (link for circuit in circuits for link in (circuit.i, circuit.j) if MOUNT in link)
    return tuple(dict.fromkeys([*train.links, *mounts]))


def _alike(train: Train) -> dict[str, str]:
    """Wheels of one tooth count, alike and among mates that are alike, under the name of the first."""
    marks = {name: (wheel.count, wheel.internal) for name, (_, wheel) in train.wheels.items()}
    mates: dict[str, list[object]] = {name: [] for name in marks}
    for gear in train.gears:
        first, second = gear.pair
        mates[first].append(marks[second])
        mates[second].append(marks[first])
    heads: dict[object, str] = {}
    return {name: heads.setdefault((mark, tuple(sorted(map(repr, mates[name])))), name) for name, mark in marks.items()}


def spherical_phasing(configuration: SphericalGears, teeth: Mapping[str, int] | None = None) -> MeshPhasing:
    """Closure of gears with axes through one point.

    Parameters
    ----------
    configuration : SphericalGears
        Such as a `geartrain.spherical.Configuration`.
    teeth : mapping of str to int, optional
        Tooth number of each kind, instead of those of the configuration.

    Returns
    -------
    MeshPhasing
        Angles of links count from the direction that `configuration.frame` gives first.

    Raises
    ------
    QuestionError
        If a kind has no tooth number.

    Examples
    --------
    Gears in the faces of an icosidodecahedron; 3 must divide z3, and 5 must divide z5:

    >>> from geartrain.spherical import from_polyhedron, solid
    >>> gears = from_polyhedron(solid("icosidodecahedron"))
    >>> [bool(spherical_phasing(gears, {"5": five, "3": 6})) for five in (10, 12)]
    [True, False]
    """
    counts = {**configuration.teeth, **(teeth or {})}
    missing = [kind for kind in dict.fromkeys(configuration.kinds) if kind not in counts]
    if missing:
        what = f"no tooth number for {', '.join(missing)}"
        raise QuestionError(Trouble(what, "phases count teeth", "give `teeth` for every kind, or ask for the rule"))
    return _closure(configuration, [counts[kind] for kind in configuration.kinds])


def spherical_divisibility_rule(configuration: SphericalGears) -> DivisibilityRule | None:
    """The condition on tooth numbers under which gears with axes through one point can be put together.

    Parameters
    ----------
    configuration : SphericalGears
        Such as a `geartrain.spherical.Configuration`; its tooth numbers do not matter.

    Returns
    -------
    DivisibilityRule or None
        None if contacts are not at known rational parts of a turn.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron, solid
    >>> spherical_divisibility_rule(from_polyhedron(solid("icosidodecahedron"))).text
    '3 divides z3 and 5 divides z5'
    """
    return _closure(configuration, [1] * len(configuration.names)).rule


def _closure(configuration: SphericalGears, counts: Sequence[int]) -> MeshPhasing:
    names = configuration.names
    circuits = tuple(
        Circuit(
            f"{names[i]}~{names[j]}", "gear", names[i], names[j], _FRAME, counts[i], counts[j], (names[i], names[j])
        )
        for i, j in configuration.meshes
    )
    contacts = _contacts(configuration, circuits)
    parts = find_components((_FRAME, *names), _FRAME, circuits)
    return MeshPhasing(PhaseSystem(parts, contacts), {}, lambda: dict(zip(names, configuration.kinds, strict=True)))


def _contacts(configuration: SphericalGears, circuits: tuple[Circuit, ...]) -> PitchPoints:
    meshes = np.array(configuration.meshes, int).reshape(-1, 2)
    azimuth, sine = spherical_azimuths(np.asarray(configuration.axes, float), meshes)
    keys: list[tuple[object, object]] = []
    part: list[tuple[Fraction, Fraction]] = []
    first: dict[int, float] = {}
    for pair, turns in zip(meshes.tolist(), azimuth.tolist(), strict=True):
        found = []
        key: list[object] = []
        for gear, turn in zip(pair, turns, strict=True):
            parts = configuration.regular[gear]
            step = (turn - first.setdefault(gear, turn)) * parts
            if abs(step - round(step)) > _OFF * parts:
                what = f"'{configuration.names[gear]}' has contacts that are no multiples of 1/{parts} turn apart"
                raise QuestionError(Trouble(what, "it is declared regular", "declare it with `regular` 0"))
            found.append(Fraction(round(step), parts) % 1 if parts else Fraction(0))
            key.append(gear if parts else (len(keys), gear))
        part.append((found[0], found[1]))
        keys.append((key[0], key[1]))
    family, _ = contact_families(keys)
    # the smaller the angle between the axes, the more of a direction across one is rounding
    slack = 16 * EPS / sine[:, None] * np.ones(2)
    return PitchPoints(circuits, azimuth, slack, family, part)


def spherical_azimuths(axes: Floats, meshes: np.ndarray) -> tuple[Floats, Floats]:
    """Azimuths (turns) of both contacts of every mesh about outward axes, and the sine of the angle between the axes.

    They count from the first of two directions: the axis across the coordinate axis that is farthest from it.
    """
    # farthest from the axis, so that the vector product is never near 0
    minimum = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    first = np.cross(axes, minimum)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(axes, first)
    own, mate = axes[meshes], axes[meshes[:, ::-1]]
    x = (mate * first[meshes]).sum(axis=2)
    y = (mate * second[meshes]).sum(axis=2)
    sine = np.linalg.norm(np.cross(own[:, 0], mate[:, 0]), axis=1)
    return np.mod(np.arctan2(y, x) / math.tau, 1.0), sine
