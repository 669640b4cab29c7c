"""Very many combinations one by one: what every output does, and whether each combination fits.

The structure is solved once, as formulas; each combination then costs a few multiplications an output. Combinations are
taken in blocks that fit the processor's cache.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import cached_property
from math import prod
from typing import Any

import numpy as np

from geartrain.synthesis.trains.bundles import Asked
from geartrain.synthesis.trains.items import Floats, Ints
from geartrain.uncertainty.counts.columns import Columns, Drawn, Powers, Shifted, find_monomials, find_plan
from geartrain.uncertainty.counts.judging import Bools, Gate, Judge, Value
from geartrain.uncertainty.counts.question import Question

BLOCK = 1 << 13
"""Combinations worked on at a time: 64 kB an array."""
_FEW = 0.5


class Batch:
    """A question put to arrays of counts.

    every    True: the speeds of all outputs are to be had too
    wheels   those that matter to a witness or to whether the train turns, in the order declared; with `every`, those
             of all outputs
    """

    def __init__(self, question: Question, every: bool = False) -> None:
        self.question = question
        functions = [Asked(witness.name, witness.formula, ()) for witness in question.witnesses]
        functions += question.conditions
        if every:
            functions += [Asked(name, formula, ()) for name, formula in question.outputs.items()]
        moved = {wheel for one in functions for wheel in one.function.wheels}
        self.wheels = tuple(wheel for wheel in question.doubts if wheel in moved)
        self.domains = {wheel: question.doubts[wheel].counts for wheel in self.wheels}
        self.monomials = find_monomials(functions, self.domains)
        ordered = sorted(question.witnesses, key=lambda one: len(one.formula.wheels))
        outputs = question.outputs.items() if every else ()
        self._values = {name: Value.of(f, self.monomials, self.domains) for name, f in outputs}
        self._judges = [
            Judge(one, self.monomials, self.domains, question.soft, self._values.get(one.name)) for one in ordered
        ]
        self._gates = [Gate(one, self.monomials, self.domains) for one in question.conditions]
        values = [*self._values.values(), *(judge.value for judge in self._judges)]
        self._plan = find_plan(key for value in values for key in value.plan)

    def columns(self, counts: Mapping[str, Ints]) -> Columns:
        """Some combinations: wheel -> counts, of one length, for all `wheels`."""
        return Drawn(self.monomials, counts, len(next(iter(counts.values()))) if counts else 1)

    def turns(self, rows: Columns) -> Bools:
        """With which combinations the train turns at all."""
        found: Bools = np.ones(rows.size, dtype=np.bool_)
        for gate in self._gates:
            found &= gate.holds(rows)
        return found

    def judged(self, rows: Columns) -> tuple[Bools, Floats]:
        """Which combinations fit, exactly, and their misfit, to rounding; infinite where they do not.

        What one output refuses is not shown to the next, as soon as that saves work.
        """
        alive, total = np.arange(rows.size), np.zeros(rows.size)
        some = rows
        met = self.turns(rows)
        for judge in self._judges:
            if np.count_nonzero(met) < _FEW * some.size:
                kept = np.flatnonzero(met)
                if not len(kept):
                    break
                alive, some, met = alive[kept], some.pick(kept), met[kept]
            own, off = judge.judge(some, self._plan)
            met &= own
            total[alive] += off
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        found[alive] = met
        return found, np.where(found, total, np.inf)

    def speeds(self, rows: Columns) -> dict[str, tuple[Floats, Floats]]:
        """Output -> speeds, and bounds on their errors."""
        return {name: value.bounded(rows, self._plan) for name, value in self._values.items()}


class Grid:
    """All combinations of a batch, numbered: the first wheels turn slowest, as digits of a number.

    A run of neighbours shares the counts of the outer wheels, so only the inner ones are multiplied out, once.
    """

    def __init__(self, batch: Batch) -> None:
        self.batch = batch
        sizes = [len(batch.domains[wheel]) for wheel in batch.wheels]
        split, inner = len(sizes), 1
        while split and inner * sizes[split - 1] <= BLOCK:
            split -= 1
            inner *= sizes[split]
        self.outer, self.inner = batch.wheels[:split], batch.wheels[split:]
        self.block = inner
        self.runs = prod(sizes[:split])

    @cached_property
    def digits(self) -> dict[str, Ints]:
        """Inner wheel -> index of its count, for one run."""
        return _digits(np.arange(self.block), self._sizes(self.inner))

    @cached_property
    def _table(self) -> Columns:
        counts = {wheel: np.array(self.batch.domains[wheel])[at] for wheel, at in self.digits.items()}
        return Drawn(self._parts(self.inner), counts, self.block)

    def _parts(self, wheels: Collection[str]) -> list[Powers]:
        """The monomials as far as some wheels go."""
        return [{w: p for w, p in powers.items() if w in wheels} for powers in self.batch.monomials]

    def runs_from(self, start: int, stop: int) -> Iterator[tuple[dict[str, int], Columns]]:
        """Runs by number: the indices of the outer wheels' counts, and the rows."""
        parts, sizes = self._parts(self.outer), self._sizes(self.outer)
        for run in range(start, stop):
            at = _digits(run, sizes)
            counts = {wheel: np.array([self.batch.domains[wheel][int(index)]]) for wheel, index in at.items()}
            yield {wheel: int(index) for wheel, index in at.items()}, Shifted(self._table, Drawn(parts, counts, 1))

    def _sizes(self, wheels: tuple[str, ...]) -> dict[str, int]:
        return {wheel: len(self.batch.domains[wheel]) for wheel in wheels}


def _digits(number: Any, sizes: Mapping[str, int]) -> dict[str, Any]:
    """The digits of a number, or of an array of them, whose places have these sizes, the last one least."""
    found: dict[str, Any] = {}
    rest = number
    for wheel in reversed(tuple(sizes)):
        rest, found[wheel] = divmod(rest, sizes[wheel])
    return {wheel: found[wheel] for wheel in sizes}
