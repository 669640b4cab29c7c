"""What combinations looked at one by one come to, in plain data that adds up: tasks of any size, in any order."""

from __future__ import annotations

import pickle
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from geartrain.synthesis.trains.items import Floats, Ints
from geartrain.uncertainty.counts.batch import BLOCK, Batch, Grid
from geartrain.uncertainty.counts.doubts import Doubt
from geartrain.uncertainty.counts.question import Question
from geartrain.uncertainty.counts.summing import plain

KEPT = 2000
"""Combinations that a task brings out to find the best; equals beyond are left out."""
_LONG = 1 << 53
_NEAR = 1 + 1e-9


class Tally:
    """Sums over combinations.

    looked    combinations
    turning   prior weight of those with which the train turns (in a sample: their number)
    weight    of those that fit: prior weight, by degree of agreement where that is asked for
    fits      their number
    square    sum of squared degrees of agreement, for intervals
    by        for each wheel the weight of what fits with each of its counts
    sizes     sums of count x count', each from the wheel's `origin_of` on, weighted
    best      (misfit, indices of counts), best first
    ranked    False once equals had to be left out
    """

    def __init__(self, batch: Batch, most: int) -> None:
        self.batch, self.most = batch, most
        self.looked = self.fits = 0
        self.turning: Any = 0
        self.weight: Any = 0
        self.square = 0.0
        self.by: list[list[Any]] = [[0] * len(batch.domains[wheel]) for wheel in batch.wheels]
        self.sizes: Floats = np.zeros((len(batch.wheels), len(batch.wheels)))
        self.best: list[tuple[float, tuple[int, ...]]] = []
        self.ranked = True
        doubts = [batch.question.doubts[wheel] for wheel in batch.wheels]
        self._steps = [np.array(doubt.counts, dtype=np.float64) - origin_of(doubt) for doubt in doubts]

    def add(self, places: Mapping[str, Ints | int], misfit: Floats, weights: Any) -> None:
        """Rows that fit.

        places    wheel -> index of its count, one number for all rows or one for each
        misfit    of each row
        weights   of each row, whole numbers or floats
        """
        size = len(misfit)
        if not size:
            return
        at = [np.broadcast_to(places[wheel], (size,)) for wheel in self.batch.wheels]
        self.fits += size
        self.weight += plain(weights.sum())
        self.square += float((weights.astype(np.float64) ** 2).sum())
        for sums, index in zip(self.by, at, strict=True):
            for choice in np.unique(index):
                sums[choice] += plain(weights[index == choice].sum())
        steps = np.array([own[index] for own, index in zip(self._steps, at, strict=True)])
        self.sizes += (steps * weights.astype(np.float64)) @ steps.T
        self._keep(misfit, at)

    def _keep(self, misfit: Floats, at: Sequence[Ints]) -> None:
        near = np.flatnonzero(misfit <= self._bar())
        order = near[np.argsort(misfit[near], kind="stable")[: KEPT + 1]]
        self.best += [(float(misfit[row]), tuple(int(index[row]) for index in at)) for row in order]
        self._trim()

    def _bar(self) -> float:
        return self.best[self.most - 1][0] * _NEAR if len(self.best) >= self.most else np.inf

    def _trim(self) -> None:
        self.best.sort()
        bar = self._bar()
        self.best = [one for one in self.best if one[0] <= bar]
        if len(self.best) > KEPT:
            self.ranked = False
            self.best = self.best[:KEPT]

    def join(self, other: Mapping[str, Any]) -> None:
        """Add what another tally came to."""
        self.looked += other["looked"]
        self.fits += other["fits"]
        self.turning += other["turning"]
        self.weight += other["weight"]
        self.square += other["square"]
        self.by = [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(self.by, other["by"], strict=True)]
        self.sizes += np.array(other["sizes"]).reshape(self.sizes.shape)
        self.best += [(misfit, tuple(at)) for misfit, at in other["best"]]
        self.ranked &= other["ranked"]
        self._trim()

    def to_dict(self) -> dict[str, Any]:
        """Plain data, for `join`."""
        return {
            "looked": self.looked,
            "fits": self.fits,
            "turning": plain(self.turning),
            "weight": plain(self.weight),
            "square": self.square,
            "by": [[plain(value) for value in sums] for sums in self.by],
            "sizes": self.sizes.tolist(),
            "best": [[misfit, list(at)] for misfit, at in self.best],
            "ranked": self.ranked,
        }


def origin_of(doubt: Doubt) -> int:
    """The count from which the others are reckoned, so that sums of products keep their digits: the likeliest."""
    return doubt.counts[doubt.weights.index(max(doubt.weights))]


def packed(question: Question, most: int) -> bytes:
    """What all tasks share, as a worker takes it."""
    return pickle.dumps((question, most))


@lru_cache(maxsize=1)
def _unpacked(shared: bytes) -> tuple[Batch, Grid, int]:
    question, most = pickle.loads(shared)
    batch = Batch(question)
    return batch, Grid(batch), most


def grid_of(question: Question) -> Grid:
    """All combinations of the wheels that matter, in runs."""
    return Grid(Batch(question))


def enumerate_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """The runs from task[0] up to task[1] of all combinations."""
    batch, grid, most = _unpacked(shared)
    tally = Tally(batch, most)
    doubts = batch.question.doubts
    total = int(np.prod([doubts[wheel].total for wheel in batch.wheels], dtype=object))
    kind: Any = np.int64 if total < _LONG else object
    inner = np.ones(grid.block, dtype=kind)
    for wheel, at in grid.digits.items():
        inner = inner * np.array(doubts[wheel].weights, dtype=kind)[at]
    for places, rows in grid.runs_from(*task):
        outer = 1
        for wheel, index in places.items():
            outer *= doubts[wheel].weights[index]
        met, misfit = batch.judged(rows)
        tally.looked += rows.size
        turning = batch.turns(rows) if batch.question.conditions else slice(None)
        tally.turning += plain(inner[turning].sum()) * outer
        fit = np.flatnonzero(met)
        weights = inner[fit] * outer
        if batch.question.soft:
            weights = weights.astype(np.float64) / total * np.exp(-misfit[fit] / 2)
        tally.add({**places, **{wheel: at[fit] for wheel, at in grid.digits.items()}}, misfit[fit], weights)
    return tally.to_dict()


def sample_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """Combinations drawn by their prior chances: task is the seed, the number of the block, and how many."""
    batch, _, most = _unpacked(shared)
    tally = Tally(batch, most)
    seed, block, size = task
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, block])))
    places = {}
    for wheel in batch.wheels:
        chances = np.array([float(prior) for prior in batch.question.doubts[wheel].priors])
        places[wheel] = draw.choice(len(chances), size, p=chances / chances.sum())
    for start in range(0, size, BLOCK):
        here = {wheel: at[start : start + BLOCK] for wheel, at in places.items()}
        rows = batch.columns({wheel: np.array(batch.domains[wheel])[at] for wheel, at in here.items()})
        met, misfit = batch.judged(rows)
        tally.looked += rows.size
        tally.turning += int(batch.turns(rows).sum())
        fit = np.flatnonzero(met)
        weights = np.exp(-misfit[fit] / 2) if batch.question.soft else np.ones(len(fit), dtype=np.int64)
        tally.add({wheel: at[fit] for wheel, at in here.items()}, misfit[fit], weights)
    return tally.to_dict()
