"""All combinations without listing them: wheel by wheel, rows that later outputs cannot tell apart made one.

An output is judged as soon as all its wheels have counts. What it refuses goes no further, and what only it could
tell apart becomes one row. Sums over all combinations are then sums over paths through the rows: forward for what
comes before, backward for what comes after, as in a hidden Markov chain (forward-backward, Baum 1970; here exact, in
whole numbers).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.trains.bundles import Asked, Domains
from geartrain.synthesis.trains.items import Floats, Ints
from geartrain.uncertainty.counts.evidence import Witness
from geartrain.uncertainty.counts.judging import Gate, Judge
from geartrain.uncertainty.counts.merging import EMPTY, State, TooManyError
from geartrain.uncertainty.counts.question import Question

_EVERYTHING = (None, None)


@dataclass(frozen=True)
class Step:
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
class Part:
    """Wheels that the outputs join, as steps from one row to one row; without steps where nothing fits."""

    wheels: tuple[str, ...]
    steps: tuple[Step, ...]


def decompose(question: Question, limit: int) -> tuple[Part, ...]:
    """Every part of a question. Raises `TooManyError` when more than `limit` transitions are made."""
    return tuple(_Parting(question, wheels).decompose(limit) for wheels in find_parts(question))


def find_parts(question: Question) -> list[tuple[str, ...]]:
    """The wheels in lots that no output and no condition joins, in the order declared."""
    lots: list[set[str]] = [{wheel} for wheel in question.doubts]
    scopes = [witness.formula.wheels for witness in question.witnesses]
    scopes += [condition.function.wheels for condition in question.conditions]
    for scope in scopes:
        joined = [lot for lot in lots if not lot.isdisjoint(scope)]
        lots = [lot for lot in lots if lot not in joined] + [set().union(*joined)]
    order = {wheel: at for at, wheel in enumerate(question.doubts)}
    return sorted((tuple(sorted(lot, key=order.__getitem__)) for lot in lots), key=lambda lot: order[lot[0]])


@dataclass(frozen=True, slots=True)
class _Task:
    """Something to be judged: a witness, or a condition."""

    asked: Asked
    witness: Witness | None


class _Parting:
    """The walk through one part."""

    def __init__(self, question: Question, wheels: tuple[str, ...]) -> None:
        self.wheels, self.soft = wheels, question.soft
        self.domains: Domains = {wheel: question.doubts[wheel].counts for wheel in wheels}
        self.tasks = [_Task(one, None) for one in question.conditions if set(one.function.wheels) & set(wheels)]
        for witness in question.witnesses:
            if set(witness.formula.wheels) & set(wheels):
                self.tasks.append(_Task(Asked(witness.name, witness.formula, (_EVERYTHING,)), witness))

    def decompose(self, limit: int) -> Part:
        """The steps of all wheels, in an order that keeps the rows few."""
        state, left, done = EMPTY, list(self.tasks), 0
        steps: list[Step] = []
        for wheel in self._order():
            step, state, left = self._step(state, wheel, left, {step.wheel for step in steps}, limit - done)
            done += len(step.choices)
            steps.append(step)
        return Part(self.wheels, tuple(steps))

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
        self, state: State, wheel: str, left: Sequence[_Task], known: set[str], most: int
    ) -> tuple[Step, State, list[_Task]]:
        grown, parents, choices = state.grown(wheel, self.domains[wheel], most)
        now, rows = grown.merged([task.asked for task in left], self.domains)
        ready = [task for task in left if set(task.asked.function.wheels) <= known | {wheel}]
        if not ready:
            return Step(wheel, parents, choices, rows, None, now.size), now, list(left)
        met, misfit = self._judged(ready, now)
        later = [task for task in left if task not in ready]
        after, moved = now.kept(met).merged([task.asked for task in later], self.domains)
        to = np.full(now.size, -1, dtype=np.int64)
        to[met] = moved
        kept = met[rows]
        step = Step(wheel, parents[kept], choices[kept], to[rows[kept]], misfit[rows[kept]], after.size)
        return step, after, later

    def _judged(self, ready: Sequence[_Task], state: State) -> tuple[NDArray[np.bool_], Floats]:
        """What all that can be judged now says of each row."""
        rows = state.columns
        met: NDArray[np.bool_] = np.ones(state.size, dtype=np.bool_)
        misfit = np.zeros(state.size)
        for task in ready:
            if task.witness is None:
                met &= Gate(task.asked, state.monomials, self.domains).holds(rows)
                continue
            own, off = Judge(task.witness, state.monomials, self.domains, self.soft).judge(rows)
            met &= own
            misfit += np.where(own, off, 0)
        return met, misfit


__all__ = ["Part", "Step", "TooManyError", "decompose", "find_parts"]
