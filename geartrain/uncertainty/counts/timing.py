"""How fast exact variants come in batch, against solving the train once for each: measured in one run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import perf_counter
from typing import Any

import numpy as np

from geartrain.analysis import GearTrain
from geartrain.synthesis.formulas import with_counts
from geartrain.uncertainty.counts.batch import BLOCK, Batch, Grid
from geartrain.uncertainty.counts.doubts import find_doubts
from geartrain.uncertainty.counts.question import Question, ask


@dataclass(frozen=True, slots=True)
class Rates:
    """Variants a second: every output's speed to rounding with a bound on its error, and whether all fit, exactly.

    wheels, outputs  in doubt, and moved by them
    neighbours       variants a second, in the order of their numbers, as complete enumeration takes them
    drawn            variants a second at random, as a sample takes them
    naive            variants a second by solving the train for each
    checked          variants solved both ways; every speed was within its bound, and every verdict the same
    bound            the greatest bound on a relative error that was met
    """

    wheels: int
    outputs: int
    neighbours: float
    drawn: float
    naive: float
    checked: int
    bound: float

    @property
    def ratio(self) -> float:
        """How many times faster the slower way in batch is than solving each."""
        return min(self.neighbours, self.drawn) / self.naive

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        names = ("wheels", "outputs", "neighbours", "drawn", "naive", "checked", "bound", "ratio")
        return {name: getattr(self, name) for name in names}


def measure(
    train: GearTrain, free: Mapping[str, Sequence[int]], variants: int = 1 << 21, solved: int = 20, seed: int = 1
) -> Rates:
    """Measure a train with some wheels in doubt, whose outputs are judged by all that is asked of them.

    Structure and formulas are made before the clock runs. Raises `AssertionError` if the two ways disagree.
    """
    declared = train.declaration
    question = ask(declared, find_doubts(declared, free))
    batch = Batch(question, every=True)
    grid = Grid(batch)
    draw = np.random.Generator(np.random.PCG64(seed))
    blocks = max(1, variants // grid.block)
    first = int(draw.integers(max(1, min(grid.runs, 1 << 62) - blocks)))
    _ = grid.digits
    neighbours = _neighbours(batch, grid, first, min(first + blocks, grid.runs))
    drawn = _drawn(batch, variants, draw)
    naive, bound = _solved(train, question, batch, solved, draw)
    return Rates(len(batch.wheels), len(question.outputs), neighbours, drawn, naive, solved, bound)


def _neighbours(batch: Batch, grid: Grid, start: int, stop: int) -> float:
    for _, rows in grid.runs_from(start, start + 1):
        _look(batch, rows)  # lists and tables are made once
    return grid.block / _median(lambda at: _look(batch, at[1]), grid.runs_from(start, stop))


def _drawn(batch: Batch, variants: int, draw: np.random.Generator) -> float:
    blocks = max(1, variants // BLOCK)
    counts = [_some(batch, BLOCK, draw) for _ in range(min(blocks, 16))]
    return BLOCK / _median(lambda at: _look(batch, batch.columns(counts[at % len(counts)])), range(blocks))


def _median(work: Callable[[Any], None], over: Iterable[Any]) -> float:
    """The median time of one piece of work, in seconds: others who use the machine do not count."""
    times = []
    for each in over:
        begun = perf_counter()
        work(each)
        times.append(perf_counter() - begun)
    return sorted(times)[len(times) // 2]


def _look(batch: Batch, rows: Any) -> None:
    batch.judged(rows)
    batch.speeds(rows)


def _some(batch: Batch, size: int, draw: np.random.Generator) -> dict[str, Any]:
    return {wheel: draw.choice(np.array(counts), size) for wheel, counts in batch.domains.items()}


def _solved(
    train: GearTrain, question: Question, batch: Batch, size: int, draw: np.random.Generator
) -> tuple[float, float]:
    """Solve variants one by one, and hold what the batch says of them against that."""
    counts = _some(batch, size, draw)
    speeds, greatest = batch.speeds(batch.columns(counts)), 0.0
    spent: list[float] = []
    met, _ = batch.judged(batch.columns(counts))
    for at in range(size):
        teeth = {wheel: int(column[at]) for wheel, column in counts.items()}
        begun = perf_counter()
        answer = GearTrain(with_counts(train.declaration, teeth)).solve()
        spent.append(perf_counter() - begun)
        for name, (values, bounds) in speeds.items():
            exact = answer[name]
            assert isinstance(exact, Fraction), "a train of this size is solved exactly"
            greatest = max(greatest, float(bounds[at]) / abs(float(exact)) if exact else 0.0)
            assert abs(Fraction(float(values[at])) - exact) <= Fraction(float(bounds[at])), name
        fits = all(witness.fits(_exactly(answer[witness.name])) for witness in question.witnesses)
        assert fits == met[at], "floats and integers agree on what fits"
    return 1 / sorted(spent)[size // 2], greatest


def _exactly(speed: Fraction | float) -> Fraction:
    return Fraction(speed)
