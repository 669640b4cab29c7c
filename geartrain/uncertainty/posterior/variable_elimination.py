"""Rows of a decomposition: states that differ in nothing a later output can see are one.

All combinations without listing them: wheel by wheel, rows that later outputs cannot tell apart made one.

An output is judged as soon as all its wheels have counts. What it refuses goes no further, and what only it could
tell apart becomes one row. Sums over all combinations are then sums over paths through the rows: forward for what
comes before, backward for what comes after, as in a hidden Markov chain (forward-backward, Baum 1970; here exact, in
whole numbers).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.graphs import joined_groups
from geartrain.synthesis.join.product_lists import Floats, Ints
from geartrain.synthesis.join.wheel_monomials import Domains, IntervalConstraint
from geartrain.uncertainty.posterior.inference_problem import InferenceProblem
from geartrain.uncertainty.posterior.likelihood import ExactConstraint, OutputLikelihood
from geartrain.uncertainty.posterior.monomial_columns import MonomialColumns, Powers, find_monomials, product
from geartrain.uncertainty.posterior.observations import ObservedOutput

_GOLDEN = 0x9E3779B97F4A7C15


@dataclass(frozen=True)
class EliminationState:
    """What is known after some wheels have their counts: the monomials that matter later, each row once.

    monomials       wheel -> power of each
    tops, bottoms   their values in lowest terms, (size,) each
    """

    monomials: tuple[Powers, ...]
    tops: tuple[Ints, ...]
    bottoms: tuple[Ints, ...]
    size: int

    @property
    def columns(self) -> MonomialColumns:
        """As a judge takes it."""
        return MonomialColumns(self.tops, self.bottoms, self.size)

    def grown(self, wheel: str, counts: Sequence[int], most: int) -> tuple[EliminationState, Ints, Ints]:
        """Every row with every count of one more wheel: the state, whose row, which count; at most so many rows."""
        if self.size * len(counts) > most:
            raise EliminationLimitError
        parents = np.repeat(np.arange(self.size), len(counts))
        choices = np.tile(np.arange(len(counts)), self.size)
        tops = (*(top[parents] for top in self.tops), np.array(counts, dtype=np.int64)[choices])
        bottoms = (*(bottom[parents] for bottom in self.bottoms), np.ones(len(parents), dtype=np.int64))
        return EliminationState((*self.monomials, {wheel: 1}), tops, bottoms, len(parents)), parents, choices

    def merged(
        self, asked: Sequence[IntervalConstraint], domains: Mapping[str, tuple[int, ...]]
    ) -> tuple[EliminationState, Ints]:
        """The state seen through what is still asked, and for each row of this one its row there."""
        known = {wheel for powers in self.monomials for wheel in powers}
        kept = {wheel: counts for wheel, counts in domains.items() if wheel in known}
        monomials = find_monomials(asked, kept, self.monomials)
        made = [self._monomial(powers) for powers in monomials]
        first, rows = distinct_rows([column for pair in made for column in pair], self.size)
        state = EliminationState(
            monomials, tuple(top[first] for top, _ in made), tuple(low[first] for _, low in made), len(first)
        )
        return state, rows

    def kept(self, where: NDArray[np.bool_]) -> EliminationState:
        """Some of the rows."""
        tops, bottoms = (tuple(column[where] for column in each) for each in (self.tops, self.bottoms))
        return EliminationState(self.monomials, tops, bottoms, int(where.sum()))

    def _monomial(self, powers: Powers) -> tuple[Ints, Ints]:
        parts = []
        for at, own in enumerate(self.monomials):
            wheel, power = next(iter(own.items()))
            if wheel in powers:
                parts.append((self.tops[at], self.bottoms[at], powers[wheel] // power))
        top, bottom = product(parts, self.size)
        common = np.gcd(top, bottom)
        return top // common, bottom // common


EMPTY = EliminationState((), (), (), 1)


class EliminationLimitError(Exception):
    """A decomposition passed its limit of rows."""


def distinct_rows(columns: Sequence[Ints], size: int) -> tuple[Ints, Ints]:
    """Index of one row of each kind, and for each row its kind. Sorted by a hash, which is then checked to be one."""
    if not columns:
        return np.zeros(min(size, 1), dtype=np.int64), np.zeros(size, dtype=np.int64)
    seed = _GOLDEN
    while True:
        key = np.zeros(size, dtype=np.uint64)
        for column in columns:
            key = (key ^ (key >> np.uint64(29)) ^ column.view(np.uint64)) * np.uint64(seed)
        _, first, kinds = np.unique(key, return_index=True, return_inverse=True)
        if all(np.array_equal(column, column[first][kinds]) for column in columns):
            return first, kinds
        seed = (seed * _GOLDEN + 2) & (1 << 64) - 1 | 1


_EVERYTHING = (None, None)


@dataclass(frozen=True)
class EliminationStep:
    """One wheel gets its counts. Transitions are parallel arrays, `parents` ascending.

    wheel     which
    parents   row before
    choices   index of the count
    children  row after, or -1 - nothing: what is refused is left out
    misfit    that the outputs judged here add; None where none is judged
    size      rows after
    """

    wheel: str
    parents: Ints
    choices: Ints
    children: Ints
    misfit: Floats | None
    size: int


@dataclass(frozen=True)
class EliminationPart:
    """Wheels that the outputs join, as steps from one row to one row; without steps where nothing fits."""

    wheels: tuple[str, ...]
    steps: tuple[EliminationStep, ...]


def eliminate_wheels(question: InferenceProblem, limit: int) -> tuple[EliminationPart, ...]:
    """Every part of a question. Raises `EliminationLimitError` when more than `limit` transitions are made."""
    return tuple(_Elimination(question, wheels).decompose(limit) for wheels in find_independent_parts(question))


def find_independent_parts(question: InferenceProblem) -> list[tuple[str, ...]]:
    """The wheels in lots that no output and no condition joins, in the order declared."""
    scopes = [witness.formula.wheels for witness in question.witnesses]
    scopes += [condition.function.wheels for condition in question.conditions]
    return [tuple(lot) for lot in joined_groups(question.doubts, scopes)]


@dataclass(frozen=True, slots=True)
class _Factor:
    """Something to be judged: a witness, or a condition."""

    asked: IntervalConstraint
    witness: ObservedOutput | None


class _Elimination:
    """The walk through one part."""

    def __init__(self, question: InferenceProblem, wheels: tuple[str, ...]) -> None:
        self.wheels, self.soft = wheels, question.soft
        self.domains: Domains = {wheel: question.doubts[wheel].counts for wheel in wheels}
        self.tasks = [_Factor(one, None) for one in question.conditions if set(one.function.wheels) & set(wheels)]
        for witness in question.witnesses:
            if set(witness.formula.wheels) & set(wheels):
                self.tasks.append(_Factor(IntervalConstraint(witness.name, witness.formula, (_EVERYTHING,)), witness))

    def decompose(self, limit: int) -> EliminationPart:
        """The steps of all wheels, in an order that keeps the rows few."""
        state, left, done = EMPTY, list(self.tasks), 0
        steps: list[EliminationStep] = []
        for wheel in self._order():
            step, state, left = self._step(state, wheel, left, {step.wheel for step in steps}, limit - done)
            done += len(step.choices)
            steps.append(step)
        return EliminationPart(self.wheels, tuple(steps))

    def _order(self) -> Iterator[str]:
        """Wheels of the output that adds fewest combinations first; what nothing asks for last."""
        known: list[str] = []
        left = [task.asked.function.wheels for task in self.tasks]
        while left:
            costs = [float(np.prod([len(self.domains[w]) for w in wheels if w not in known])) for wheels in left]
            wheels = left.pop(int(np.argmin(costs)))
            new = [wheel for wheel in wheels if wheel not in known]
            known += new
            yield from new
        yield from (wheel for wheel in self.wheels if wheel not in known)

    def _step(
        self, state: EliminationState, wheel: str, left: Sequence[_Factor], known: set[str], most: int
    ) -> tuple[EliminationStep, EliminationState, list[_Factor]]:
        grown, parents, choices = state.grown(wheel, self.domains[wheel], most)
        now, rows = grown.merged([task.asked for task in left], self.domains)
        ready = [task for task in left if set(task.asked.function.wheels) <= known | {wheel}]
        if not ready:
            return EliminationStep(wheel, parents, choices, rows, None, now.size), now, list(left)
        met, misfit = self._judged(ready, now)
        later = [task for task in left if task not in ready]
        after, moved = now.kept(met).merged([task.asked for task in later], self.domains)
        to = np.full(now.size, -1, dtype=np.int64)
        to[met] = moved
        kept = met[rows]
        step = EliminationStep(wheel, parents[kept], choices[kept], to[rows[kept]], misfit[rows[kept]], after.size)
        return step, after, later

    def _judged(self, ready: Sequence[_Factor], state: EliminationState) -> tuple[NDArray[np.bool_], Floats]:
        """What all that can be judged now says of each row."""
        rows = state.columns
        met: NDArray[np.bool_] = np.ones(state.size, dtype=np.bool_)
        misfit = np.zeros(state.size)
        for task in ready:
            if task.witness is None:
                met &= ExactConstraint(task.asked, state.monomials, self.domains).holds(rows)
                continue
            own, off = OutputLikelihood(task.witness, state.monomials, self.domains, self.soft).judge(rows)
            met &= own
            misfit += np.where(own, off, 0)
        return met, misfit


__all__ = ["EliminationLimitError", "EliminationPart", "EliminationStep", "eliminate_wheels", "find_independent_parts"]
