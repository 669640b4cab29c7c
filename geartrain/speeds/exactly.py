"""Exact speeds: eliminate what couples the components, then read every link off its component."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from geartrain.components import Reduced
from geartrain.errors import Loop, Verdict
from geartrain.exact import PRIME, Echelon, Row, TooDenseError, add_into, eliminate, rank_modulo, residues
from geartrain.speeds.diagnosis import diagnose, free_verdict
from geartrain.train import Case

EXACT_BUDGET = 400_000
"""Coefficient operations after which exact elimination gives way to floats; about a second."""


@dataclass(frozen=True, slots=True)
class Mobility:
    """Degrees of freedom by count and by exact rank, and what makes them differ.

    by_count    turning pairs less gear pairs and couplings; right only without redundancy
    by_rank     links less one less the rank of all circuits; always right
    redundant   circuits that add nothing, and the loops they close
    locked      loops that do not close, and hold their component on its carrier
    still       links that stand still whatever drives the train
    certain     False where the rank was taken modulo two primes (exact but for accidents of 1e-36)
    """

    links: int
    turning_pairs: int
    gear_pairs: int
    couplings: int
    by_rank: int
    redundant: int
    loops: tuple[Loop, ...]
    shared: tuple[str, ...]
    locked: tuple[Loop, ...]
    still: tuple[str, ...]
    certain: bool = True

    @property
    def by_count(self) -> int:
        """j_R - j_G, couplings counted with the gear pairs."""
        return self.turning_pairs - self.gear_pairs - self.couplings

    @property
    def rank(self) -> int:
        """Rank of the circuits' rows."""
        return self.links - 1 - self.by_rank


@dataclass(frozen=True, slots=True)
class Solution:
    """Exact speeds of a train in one case, and the verdict.

    speeds      link -> speed, in the order declared; only links that are determined
    ratios      link -> input -> speed over that input, the others at rest
    freedom     degrees of freedom left when everything prescribed is held
    work        circuits that were solved
    """

    verdict: Verdict
    speeds: Mapping[str, Fraction]
    ratios: Mapping[str, Mapping[str, Fraction]]
    freedom: int
    work: int

    def __getitem__(self, link: str) -> Fraction:
        return self.speeds[link]

    def __iter__(self) -> Iterator[str]:
        return iter(self.speeds)


class _Ratios(Mapping[str, Mapping[str, Fraction]]):
    """The exact link x input table, each row made when it is read."""

    __slots__ = ("_forms", "_inputs", "_reduced", "_signs")

    def __init__(
        self, reduced: Reduced, forms: Mapping[int, Row], inputs: Sequence[str], signs: Mapping[str, int]
    ) -> None:
        self._reduced, self._forms, self._inputs, self._signs = reduced, forms, inputs, signs

    def __getitem__(self, link: str) -> Mapping[str, Fraction]:
        form = _resolve(self._reduced.form(self._reduced.components.index[link]), self._forms)
        own = self._signs.get(link, 1)
        return {
            name: own * form.get(-1 - at, Fraction(0)) * self._signs.get(name, 1)
            for at, name in enumerate(self._inputs)
        }

    def __iter__(self) -> Iterator[str]:
        return iter(self._reduced.components.links)

    def __len__(self) -> int:
        return len(self._reduced.components.links)


def solve(
    reduced: Reduced, case: Case, signs: Mapping[str, int], budget: int | None = EXACT_BUDGET
) -> Solution:
    """Solve one case exactly.

    signs    -1 for links whose axis points against its parallels: their speeds change sign at this door
    budget   operations allowed; `TooDenseError` beyond, None for no bound
    """
    parts = reduced.components
    inputs = list(case.inputs)
    rows = [*reduced.equations, *_held(reduced, case)]
    for at, link in enumerate(inputs):
        row = dict(reduced.form(parts.index[link]))
        row[-1 - at] = Fraction(-1)
        rows.append(row)
    echelon = eliminate(rows, budget)
    values = [case.inputs[link] * signs.get(link, 1) for link in inputs]
    broken = [row for row in echelon.conditions if _evaluate(row, values)]
    forms = echelon.forms()
    if broken or not inputs or _all_still(reduced, echelon, case, budget):
        verdict = diagnose(reduced, case, signs)
        if verdict is not None:
            return Solution(verdict, {}, _Ratios(reduced, forms, inputs, signs), 0, len(parts.circuits))
    free = reduced.unknowns - echelon.rank
    speeds: dict[str, Fraction] = {}
    undetermined: list[str] = []
    for at, name in enumerate(parts.links):
        speed = _speed(reduced, at, forms, values)
        if speed is None:
            undetermined.append(name)
        else:
            speeds[name] = -speed if name in signs else speed
    verdict = (
        free_verdict(reduced, case, forms, undetermined, free) if undetermined else _determined(reduced, case)
    )
    return Solution(verdict, speeds, _Ratios(reduced, forms, inputs, signs), free, len(parts.circuits))


def exact_verdict(reduced: Reduced, case: Case, signs: Mapping[str, int]) -> Verdict:
    """The verdict alone, modulo a prime: for coupled systems too dense for rational elimination."""
    index = reduced.components.index
    rows = [dict(row) for row in (*reduced.equations, *_held(reduced, case))]
    for at, link in enumerate(case.inputs):
        rows.append({**reduced.form(index[link]), -1 - at: Fraction(-1)})
    echelon = eliminate(map(residues, rows), modulus=PRIME)
    values = [speed * signs.get(link, 1) for link, speed in case.inputs.items()]
    prime_values = [value.numerator * pow(value.denominator, -1, PRIME) for value in values]
    if any(
        sum(int(c) * prime_values[-1 - column] for column, c in row.items()) % PRIME
        for row in echelon.conditions
    ):
        given = tuple(f"{link} = {speed}" for link, speed in case.inputs.items())
        return Verdict(
            "contradictory", f"{', '.join(given)} cannot hold with the circuits", prescriptions=given
        )
    freedom = reduced.unknowns - echelon.rank
    if freedom:
        return Verdict("free", f"{len(values)} of {len(values) + freedom} degrees of freedom prescribed")
    return _determined(reduced, case)


def _determined(reduced: Reduced, case: Case) -> Verdict:
    given = ", ".join(case.inputs)
    parts = reduced.components
    loops = tuple(parts.loop(circuit) for circuit in parts.breaking[:1])
    text = f"every speed follows from {given}"
    if loops:
        text += f"; {loops[0]} does not close and holds its links on '{loops[0].carrier}'"
    return Verdict("determined", text, loops=loops)


def _held(reduced: Reduced, case: Case) -> Iterator[Row]:
    """One row for each link held to the frame and each pair locked together."""
    index = reduced.components.index
    for link in case.fixed:
        yield dict(reduced.form(index[link]))
    for a, b in case.locks:
        row = dict(reduced.form(index[a]))
        add_into(row, reduced.form(index[b]), -1)
        yield row


def _all_still(reduced: Reduced, echelon: Echelon, case: Case, budget: int | None) -> bool:
    """True if nothing can move at all: an input of 0 then hides a locked train."""
    if not echelon.conditions or any(case.inputs.values()):
        return False
    held = [*reduced.equations, *_held(reduced, case)]
    return eliminate(held, budget).rank == reduced.unknowns


def _evaluate(row: Row, values: Sequence[Fraction]) -> Fraction:
    return sum((coefficient * values[-1 - column] for column, coefficient in row.items()), Fraction(0))


def _resolve(row: Row, forms: Mapping[int, Row]) -> Row:
    """A form of unknowns in terms of inputs and free unknowns."""
    resolved: Row = {}
    for column, coefficient in row.items():
        add_into(resolved, forms.get(column, {column: Fraction(1)}), coefficient)
    return resolved


def _speed(
    reduced: Reduced, link: int, forms: Mapping[int, Row], values: Sequence[Fraction]
) -> Fraction | None:
    """A link's speed, or None where it is not determined."""
    form = _resolve(reduced.form(link), forms)
    if any(column >= 0 for column in form):
        return None
    return _evaluate(form, values)


def find_mobility(reduced: Reduced, turning_pairs: int, budget: int | None = EXACT_BUDGET) -> Mobility:
    """Mobility of the train itself, nothing prescribed, decided exactly."""
    parts = reduced.components
    gears = sum(circuit.kind == "gear" for circuit in parts.circuits)
    shared: list[str] = []
    still: list[str] = []
    certain = True
    try:
        echelon = eliminate(reduced.equations, budget)
    except TooDenseError:
        certain = False
        rank = max(rank_modulo(reduced.equations, PRIME), rank_modulo(reduced.equations, (1 << 61) - 31))
    else:
        rank = echelon.rank
        forms = echelon.forms() if parts.breaking or parts.holding or rank else {}
        still = [
            name
            for at, name in enumerate(parts.links)
            if at != parts.frame and not _resolve(reduced.form(at), forms)
        ]
        shared = [parts.links[reduced.origin[row][1]] for row in echelon.redundant]
    freedom = reduced.unknowns - rank
    redundant = len(parts.circuits) - (len(parts.links) - 1 - freedom)
    return Mobility(
        len(parts.links),
        turning_pairs,
        gears,
        len(parts.circuits) - gears,
        freedom,
        redundant,
        tuple(parts.loop(circuit) for circuit in parts.closing[:1000]),
        tuple(shared),
        tuple(parts.loop(circuit) for circuit in parts.breaking[:1000]),
        tuple(still),
        certain,
    )
