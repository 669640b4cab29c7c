"""Exact speeds: eliminate what couples the components, then read every link off its component.

Speeds link by link: where two of a circuit's three links are known, the third follows.

This settles ordinary trains and every train whose links are driven one after another, in a time proportional to its
circuits and in plain integers. Where it gets stuck (a planetary set with its ring held needs two circuits at once) it
says nothing, and the coupled system is reduced and eliminated instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import ReducedSystem, SolvedPart
from geartrain.kinematics.relative_speeds import relative_speed
from geartrain.kinematics.speeds.diagnosis import (
    diagnose,
    free_verdict,
    held_rows,
    resolve_form,
    stationary_verdict,
    unwitnessed_verdict,
)
from geartrain.kinematics.verdict import Verdict
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.elimination import PRIME, Echelon, LinearForm, add_into, eliminate, rank_modulo, residues
from geartrain.numerics.factored_ratios import FactoredRatios
from geartrain.train import StateCase

# ---------------------------------------------------------------------------------------------------------- propagation


Terms = tuple[tuple[int, int], ...]
"""A row: pairs of link index and integer coefficient whose sum of products with the speeds vanishes."""


class PropagatedSpeeds(Mapping[str, Fraction]):
    """Exact speeds by link, each multiplied out when it is read."""

    def __init__(self, index: Mapping[str, int], products: FactoredRatios, signs: Mapping[str, int]) -> None:
        self._index, self._products, self._signs = index, products, signs

    def __getitem__(self, link: str) -> Fraction:
        speed = self._products.value(self._index[link])
        return -speed if link in self._signs else speed

    def __iter__(self) -> Iterator[str]:
        return iter(self._index)

    def __len__(self) -> int:
        return len(self._index)

    def __contains__(self, link: object) -> bool:
        return link in self._index


@collector_paused()
def propagate(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], case: StateCase, signs: Mapping[str, int]
) -> PropagatedSpeeds | None:
    """Every link's exact speed, or None where walking does not reach all, or meets a contradiction.

    signs   -1 for links whose axis points against the reference direction of its parallels
    """
    index = {link: at for at, link in enumerate(links)}
    rows = _rows(index, frame, circuits, case)
    users: list[list[int]] = [[] for _ in links]
    for at, row in enumerate(rows):
        for link, _ in row:
            users[link].append(at)
    waiting = [len(row) for row in rows]
    speeds = FactoredRatios(len(links))
    bottom = speeds.bottom  # 0: not known yet
    speeds.set_root(index[frame], 0)
    known = []
    for name, speed in _prescribed(case, signs):
        at = index[name]
        if bottom[at]:
            return None  # prescribed twice, or the frame: whether that agrees is for the diagnosis
        speeds.set_root(at, speed.numerator, speed.denominator)
        known.append(at)
    for row in rows:
        if len(row) == 1 and not bottom[row[0][0]]:
            speeds.set_root(row[0][0], 0)  # alone in its row: it stands still
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
    return PropagatedSpeeds(index, speeds, signs)


def _rows(index: Mapping[str, int], frame: str, circuits: Sequence[Circuit], case: StateCase) -> list[Terms]:
    """All circuits and locks as rows over the moving links."""
    rows: list[Terms] = []
    for circuit in circuits:
        rows.append(tuple([(index[link], factor) for link, factor in circuit.terms if link != frame]))
    for first, second in case.locks:
        if first != second:
            rows.append(tuple([(index[link], factor) for link, factor in ((first, 1), (second, -1)) if link != frame]))
    return rows


def _prescribed(case: StateCase, signs: Mapping[str, int]) -> list[tuple[str, Fraction]]:
    given = [(link, Fraction(0)) for link in case.fixed]
    return given + [(link, speed * signs.get(link, 1)) for link, speed in case.inputs.items()]


def _solve(row: Terms, speeds: FactoredRatios) -> int:
    """Give the one unknown link of a row its speed, and say which it was; -1 if it got one in the meantime."""
    target, lead = -1, 0
    moving = []
    for link, coefficient in row:
        if not speeds.bottom[link]:
            target, lead = link, coefficient
        elif speeds.top[link]:
            moving.append((link, coefficient))
    if target < 0:
        return -1
    if len(moving) == 1:
        link, coefficient = moving[0]
        speeds.follow(target, link, -coefficient, lead)
        return target
    speed = -sum((speeds.value(link) * coefficient for link, coefficient in moving), Fraction(0)) / lead
    speeds.set_root(target, speed.numerator, speed.denominator)
    return target


# --------------------------------------------------------------------------------------------------------- exact speeds


_GIVEN = -1  # the column in which prescribed numbers stand

EXACT_BUDGET = 400_000
"""Coefficient operations after which exact elimination gives way to floats; about a second."""

_PREDICTED = 40_000
"""Operations modulo a prime beyond which exact elimination is not tried.

Fill makes numbers long: in grids and random networks of differentials, this many operations with short numbers are some
400,000 of `EXACT_BUDGET`.
"""

_FEW = 100  # equations up to which the prediction would cost as much as it saves


@dataclass(frozen=True, slots=True)
class FreeForms:
    """What is left of a train that is free: forms of its unknowns in those that stayed free."""

    reduced: ReducedSystem
    forms: Mapping[int, LinearForm]

    def difference(self, of: str, base: str) -> Fraction | None:
        """The difference of two links' speeds, unsigned; None where free unknowns remain in it."""
        index = self.reduced.components.index
        row = dict(self.reduced.form(index[of]))
        add_into(row, self.reduced.form(index[base]), -1)
        return _value(resolve_form(row, self.forms))


@dataclass(frozen=True, slots=True)
class Solution:
    """Exact speeds of a train in one case, and the verdict.

    speeds      link -> speed, in the order declared; only links that are determined
    ratios      link -> input -> speed over that input, the others at rest
    signs       -1 for links whose axis points against its parallels
    loose       every link as a form of what stayed free; None where all is determined, or nothing is
    """

    verdict: Verdict
    speeds: Mapping[str, Fraction]
    ratios: Mapping[str, Mapping[str, Fraction]]
    signs: Mapping[str, int]
    loose: FreeForms | None = None

    def relative(self, of: str, base: str) -> Fraction | None:
        """Speed of a link seen from another, about the first one's axis; None where it is not determined.

        It may be determined though both links are free: it is wherever the difference lies in the space of the rows.
        """
        found = relative_speed(of, base, self.speeds.get, self.signs)
        if found is not None or self.loose is None:
            return found
        value = self.loose.difference(of, base)
        return None if value is None else value * self.signs.get(of, 1)

    def __getitem__(self, link: str) -> Fraction:
        return self.speeds[link]

    def __iter__(self) -> Iterator[str]:
        return iter(self.speeds)


class _Ratios(Mapping[str, Mapping[str, Fraction]]):
    """The exact link x input table. It is solved for when first read: a case with one answer does not need it."""

    def __init__(self, part: SolvedPart, case: StateCase, signs: Mapping[str, int]) -> None:
        self._part, self._case, self._signs = part, case, signs

    @cached_property
    def _forms(self) -> dict[int, LinearForm]:
        """Every unknown in terms of the inputs, one symbol each."""
        reduced = self._part.reduced
        index = reduced.components.index
        rows = [*reduced.equations, *held_rows(reduced, self._case)]
        rows += [{**reduced.form(index[link]), -1 - at: Fraction(-1)} for at, link in enumerate(self._case.inputs)]
        return eliminate(rows).forms()

    def __getitem__(self, link: str) -> Mapping[str, Fraction]:
        reduced = self._part.reduced
        form = resolve_form(reduced.form(reduced.components.index[link]), self._forms)
        own = self._signs.get(link, 1)
        return {
            name: own * form.get(-1 - at, Fraction(0)) * self._signs.get(name, 1)
            for at, name in enumerate(self._case.inputs)
        }

    def __iter__(self) -> Iterator[str]:
        return iter(self._part.links)

    def __len__(self) -> int:
        return len(self._part.links)


@collector_paused()
def solve(part: SolvedPart, case: StateCase, signs: Mapping[str, int], budget: int | None = EXACT_BUDGET) -> Solution:
    """Solve one case exactly: link by link where that reaches every link, else reduced and eliminated.

    signs    -1 for links whose axis points against its parallels: their speeds change sign at this door
    budget   operations allowed beyond linear work; `TooDenseError` past it, None for no bound
    """
    ratios = _Ratios(part, case, signs)
    walked = propagate(part.links, part.frame, part.circuits, case, signs) if any(case.inputs.values()) else None
    if walked is not None:
        return Solution(determined_verdict(case), walked, ratios, signs)
    reduced = part.reduced
    budget = elimination_budget(reduced, budget)
    rows = [*reduced.equations, *held_rows(reduced, case), *_driven(reduced, case, signs)]
    echelon = eliminate_within(rows, budget)
    if echelon.conditions:
        return Solution(diagnose(reduced, case, signs, budget), {}, ratios, signs)
    if not any(case.inputs.values()) and _all_still(reduced, case, budget):
        return Solution(stationary_verdict(reduced, case), dict.fromkeys(part.links, Fraction(0)), ratios, signs)
    forms = echelon.forms(budget)
    speeds, undetermined = _read_off(reduced, forms, signs)
    if undetermined:
        freedom = reduced.unknowns - echelon.rank
        verdict = free_verdict(reduced, case, forms, undetermined, freedom)
        return Solution(verdict, speeds, ratios, signs, FreeForms(reduced, forms))
    return Solution(determined_verdict(case, reduced), speeds, ratios, signs)


def elimination_budget(reduced: ReducedSystem, budget: int | None) -> int | None:
    """The budget for one system: uncoupled equations cost a few operations each, and are always allowed."""
    return None if budget is None else budget + 30 * len(reduced.equations)


def eliminate_within(rows: Sequence[LinearForm], budget: int | None) -> Echelon:
    """Exact elimination within a budget; `TooDenseError` at once where its fill is predicted to exceed it.

    The prediction is the same elimination modulo a prime, whose numbers are short, and it stops at its own limit.
    """
    if budget is not None and len(rows) > _FEW:
        eliminate(map(residues, rows), _PREDICTED + 10 * len(rows), PRIME)
    return eliminate(rows, budget)


def exact_verdict(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int]) -> Verdict:
    """The verdict alone, modulo a prime: for coupled systems too dense for rational elimination."""
    held = [*reduced.equations, *held_rows(reduced, case)]
    if not any(case.inputs.values()) and rank_modulo(held) == reduced.unknowns:
        return stationary_verdict(reduced, case)
    echelon = eliminate(map(residues, [*held, *_driven(reduced, case, signs)]), modulus=PRIME)
    if echelon.conditions:
        return unwitnessed_verdict(reduced, case)
    freedom = reduced.unknowns - echelon.rank
    if freedom:
        given_count = len(case.inputs)
        return Verdict("free", f"{given_count} of {given_count + freedom} degrees of freedom prescribed")
    return determined_verdict(case, reduced)


def determined_verdict(case: StateCase, reduced: ReducedSystem | None = None) -> Verdict:
    """The good verdict, with a word on a loop that holds part of the train, if there is one."""
    parts = reduced.components if reduced else None
    loops = tuple(parts.loop(circuit) for circuit in parts.breaking[:1]) if parts else ()
    text = f"every speed follows from {', '.join(case.inputs)}"
    if loops:
        text += f"; {loops[0]} does not close and holds its links on '{loops[0].carrier}'"
    return Verdict("determined", text, loops=loops)


def _driven(reduced: ReducedSystem, case: StateCase, signs: Mapping[str, int]) -> Iterator[LinearForm]:
    """One row for each input; what is prescribed stands in the one column -1."""
    for link, speed in case.inputs.items():
        row = dict(reduced.form(reduced.components.index[link]))
        if speed:
            row[_GIVEN] = -speed * signs.get(link, 1)
        yield row


def _all_still(reduced: ReducedSystem, case: StateCase, budget: int | None) -> bool:
    """True if nothing can move at all: an input of 0, or none, then hides a locked train."""
    return eliminate([*reduced.equations, *held_rows(reduced, case)], budget).rank == reduced.unknowns


class _ReadOff(Mapping[str, Fraction]):
    """Speeds by link, put together when read: the carrier's plus the ratio times the component's unknown."""

    def __init__(self, reduced: ReducedSystem, known: Sequence[Fraction | None], signs: Mapping[str, int]) -> None:
        self._reduced, self._known, self._signs = reduced, known, signs
        self._cancelled: dict[str, Fraction] = {}
        self._links: dict[str, None] = {}

    def take(self, link: str, speed: Fraction | None = None) -> None:
        """Count a link among those that are determined; `speed` where its parts are not, but their sum is."""
        self._links[link] = None
        if speed is not None:
            self._cancelled[link] = speed

    def __getitem__(self, link: str) -> Fraction:
        if link not in self._links:
            raise KeyError(link)
        speed = self._cancelled.get(link)
        if speed is None:
            speed = self._composed(self._reduced.components.index[link])
        return -speed if link in self._signs else speed

    def _composed(self, link: int) -> Fraction:
        parts, zero = self._reduced.components, Fraction(0)
        if link == parts.frame:
            return zero
        if link in self._reduced.own:
            return self._known[self._reduced.own[link]] or zero
        node = parts.nodes_of[link][0]
        carrier = parts.node_carrier[node]
        unknown = self._known[parts.node_group[node]] or zero
        # mostly 1 or 0, and fractions may be long: no product is made that changes nothing
        speed = parts.relative(node) if unknown == 1 else parts.relative(node) * unknown if unknown else zero
        carried = zero if carrier == parts.frame else self._known[self._reduced.own[carrier]]
        return speed + carried if carried else speed

    def __iter__(self) -> Iterator[str]:
        return iter(self._links)

    def __len__(self) -> int:
        return len(self._links)

    def __contains__(self, link: object) -> bool:
        return link in self._links


def _read_off(
    reduced: ReducedSystem, forms: Mapping[int, LinearForm], signs: Mapping[str, int]
) -> tuple[Mapping[str, Fraction], list[str]]:
    """The speed of every link that has one, and the links that have none."""
    parts = reduced.components
    known = [_value(forms.get(unknown)) for unknown in range(reduced.unknowns)]
    speeds = _ReadOff(reduced, known, signs)
    undetermined: list[str] = []
    for at, name in enumerate(parts.links):
        if at == parts.frame or all(known[unknown] is not None for unknown in reduced.unknowns_of(at)):
            speeds.take(name)
            continue
        speed = _value(resolve_form(reduced.form(at), forms))  # free parts may still cancel
        if speed is None:
            undetermined.append(name)
        else:
            speeds.take(name, speed)
    return speeds, undetermined


def _value(form: LinearForm | None) -> Fraction | None:
    """The value of a form, or None where it holds a free unknown."""
    if form is None or any(column >= 0 for column in form):
        return None
    return form.get(_GIVEN, Fraction(0))
