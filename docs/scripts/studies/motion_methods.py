"""Every way to the motion of one train, each judged by the direct composition and that by 40 digits."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain import GearTrain, load
from geartrain.dynamics import Motion, RunningStatistics
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.teeth.triangular import clearance_window, triangular_transmission
from studies.measurement import Rounds, Task, in_turns, timed
from studies.motion_records import (
    ADAPTIVE,
    BOUND,
    DIRECT,
    FIXED,
    INDEPENDENT,
    LAGGED,
    PER_POSITION,
    MotionRecord,
    TrainRecord,
)
from studies.reference_solutions import MotionTruth
from studies.time_marching import Marching

Floats = NDArray[np.float64]
Ask = Callable[[Floats], Floats]


class Effort(NamedTuple):
    """Positions in all, rounds whose median counts, positions that are marched to, positions judged in 40 digits."""

    positions: int
    rounds: int
    marched: int
    sample: int


@dataclass
class _Off:
    """Differences (rad) of a method from the direct composition, by output: greatest, and sums of squares."""

    maximum: Floats
    squares: Floats
    count: int = 0

    @classmethod
    def none(cls, outputs: int) -> _Off:
        return cls(np.zeros(outputs), np.zeros(outputs))

    def add(self, off: Floats) -> None:
        """Count differences (outputs, n)."""
        self.maximum = np.maximum(self.maximum, np.abs(off).max(axis=1))
        self.squares = self.squares + (off**2).sum(axis=1)
        self.count += off.shape[1]

    def worst(self) -> tuple[int, float, float]:
        """The output with the greatest difference, that, and the rms there (deg)."""
        at = int(np.argmax(self.maximum))
        return at, math.degrees(self.maximum[at]), math.degrees(math.sqrt(self.squares[at] / self.count))


@dataclass
class MotionCase:
    """A train, the outputs and the run that are asked for, and what was measured of them so far."""

    name: str
    source: str
    outputs: tuple[str, ...]
    turns: float
    effort: Effort
    taken: dict[str, Rounds] = field(default_factory=dict)
    off: dict[str, _Off] = field(default_factory=dict)
    marched: dict[str, float] = field(default_factory=dict)
    peaks: dict[str, float] = field(default_factory=dict)
    tallies: list[RunningStatistics] = field(default_factory=list)

    def steps(self) -> Iterator[tuple[str, Callable[[], None]]]:
        """What there is to measure, in order; each fills in a part of the case."""
        yield "every method in turn", self._take_turns
        yield "comparing", self._compare
        yield "40 digits", self._judge
        yield "memory", self._trace
        yield FIXED, partial(self._march, FIXED, 1)
        yield ADAPTIVE, partial(self._march, ADAPTIVE, 0)

    # ---------------------------------------------------------------------------------------------------- the methods

    @cached_property
    def train(self) -> GearTrain:
        """The train, loaded once for all that is not preparation."""
        return load(self.source)

    @cached_property
    def direct(self) -> Motion:
        """The motion that asks the laws themselves."""
        return self.train.motion(outputs=self.outputs)

    @cached_property
    def requested(self) -> dict[str, Ask]:
        """Each method that answers position by position: turns (n,) to errors (rad) of the outputs (outputs, n)."""
        return {method: self._ask(method) for method in PER_POSITION}

    def _ask(self, method: str) -> Ask:
        if method == LAGGED:
            return partial(Superposition(self.direct._forward).at, lagged=True)
        return lambda turns: self.direct._unset.at(turns).error

    @property
    def links(self) -> int:
        """Links that an error reaches and that an output depends on."""
        return len(self.direct._forward.used)

    def stretches(self, positions: int) -> Iterator[Floats]:
        """The first of all positions, in stretches that fit in memory."""
        chunk, last = self.direct._forward.chunk, self.effort.positions - 1
        for start in range(0, positions, chunk):
            yield self.turns * (np.arange(start, min(start + chunk, positions)) / last)

    def run(self, method: str, positions: int) -> Floats:
        """Greatest error by output over so many positions: nothing is kept of a stretch but that."""
        ask, most = self.requested[method], np.zeros(len(self.outputs))
        for turns in self.stretches(positions):
            most = np.maximum(most, np.abs(ask(turns)).max(axis=1))
        return most

    # --------------------------------------------------------------------------------------------------- measurements

    def _take_turns(self) -> None:
        """Every method over all positions, or to its estimate."""
        answers: dict[str, Task] = {m: partial(self.run, m, self.effort.positions) for m in PER_POSITION}
        answers |= {method: partial(self._estimate, method) for method in (BOUND, INDEPENDENT)}
        for method in PER_POSITION:
            self.requested[method](np.zeros(2))  # tables are made when first asked
        self.taken = dict(zip(answers, in_turns(answers.values(), self.effort.rounds), strict=True))

    def _estimate(self, method: str) -> list[float]:
        """Estimate without any position, by output (rad)."""
        superposed = Superposition(self.direct._forward)
        return superposed.bounds if method == BOUND else superposed.independent

    def _compare(self) -> None:
        """All methods against the direct composition, over all positions."""
        self.tallies = self.direct._statistics()
        others = [method for method in PER_POSITION if method != DIRECT]
        self.off |= {method: _Off.none(len(self.outputs)) for method in others}
        for turns in self.stretches(self.effort.positions):
            passage = self.direct._unset.at(turns)
            for at, tally in enumerate(self.tallies):
                tally.add(passage.error[at], passage.rate[at])
            for method in others:
                self.off[method].add(self.requested[method](turns) - passage.error)

    def _judge(self) -> None:
        """The direct composition against the definition of its laws, at random."""
        last = self.effort.positions - 1
        at = np.random.default_rng(3).integers(0, last + 1, self.effort.sample)
        turns = self.turns * (at / last)
        truth, found = MotionTruth(self.direct), self.direct._unset.at(turns).error
        self.off[DIRECT] = _Off.none(len(self.outputs))
        self.off[DIRECT].add(np.array([truth.off(float(each), found[:, n]) for n, each in enumerate(turns)]).T)

    def _trace(self) -> None:
        """Peaks of memory of the direct composition by the number of positions."""
        for share in (100, 10, 1):
            positions = self.effort.positions // share
            self.peaks[str(positions)] = _peak(partial(self.run, DIRECT, positions))

    def _march(self, method: str, steps: int) -> None:
        """March to the first positions, and compare there; the time is extrapolated to all."""
        marching = Marching(self.train, self.outputs)
        turns = np.concatenate(list(self.stretches(self.effort.marched)))
        took, error = timed(partial(marching.follow, turns, steps))
        self.off[method] = _Off.none(len(self.outputs))
        self.off[method].add(error - self.direct._unset.at(turns).error)
        self.marched[method] = took * self.effort.positions / len(turns)

    # -------------------------------------------------------------------------------------------------------- results

    def rows(self) -> list[MotionRecord]:
        """A record for each method."""
        estimates = [self._of_estimate(method) for method in (BOUND, INDEPENDENT)]
        composed = [self._of_positions(method) for method in (LAGGED, DIRECT)]
        return [*estimates, *composed, *(self._of_marching(method) for method in self.marched)]

    def _record(self, method: str, output: int, **more: Any) -> MotionRecord:
        return MotionRecord(self.name, self.links, method, output=self.outputs[output], **more)

    def _of_positions(self, method: str) -> MotionRecord:
        at, maximum, rms = self.off[method].worst()
        return self._record(
            method,
            at,
            error=maximum,
            rms=rms,
            **self._times(method),
            note=f"judged at {self.off[method].count} positions" if method == DIRECT else "",
            positions=self.effort.positions,
        )

    def _of_marching(self, method: str) -> MotionRecord:
        at, maximum, rms = self.off[method].worst()
        seconds = self.marched[method]
        return self._record(
            method,
            at,
            error=maximum,
            rms=rms,
            seconds=seconds,
            ratio=seconds / self.taken[DIRECT].median,
            note=f"extrapolated from {self.off[method].count} positions",
            positions=self.effort.positions,
        )

    def _of_estimate(self, method: str) -> MotionRecord:
        """The output on which one number an output is farthest off: of the peak to peak, or of the rms."""
        values, bound = self.taken[method].found, method == BOUND
        true = [tally.peak_to_peak if bound else tally.rms for tally in self.tallies]
        at = int(np.argmax(np.abs(np.array(values) - true)))
        off = math.degrees(abs(values[at] - true[at]))
        note = f"{(values[at] / true[at] - 1) * 100:+.1f} % of its {'peak-to-peak' if bound else 'rms'}"
        return self._record(method, at, **{"error" if bound else "rms": off}, **self._times(method), note=note)

    def _times(self, method: str) -> dict[str, float]:
        own = self.taken[method]
        return {"seconds": own.median, "ratio": own.over(self.taken[DIRECT])}

    def summary(self) -> TrainRecord:
        """What the train is and does."""
        pins = (joint.coupling.name for joint in self.direct._problem.couplings)
        lawful = {*self.direct._problem.meshes, *pins}
        outputs = {
            tally.name: {"peak_to_peak": math.degrees(tally.peak_to_peak), "rms": math.degrees(tally.rms)}
            for tally in self.tallies
        }
        return TrainRecord(
            self.name,
            self.turns,
            self.effort.positions,
            self.links,
            [source.id for source in self.direct._forward.used],
            [circuit.id for circuit in self.train.circuits if circuit.id not in lawful],
            outputs,
            self.peaks,
            self.effort.sample,
        )


def _peak(task: Callable[[], Any]) -> float:
    """Most memory (MB) that a task has at once beyond what is there before it."""
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    try:
        task()
        return (tracemalloc.get_traced_memory()[1] - before) / 2**20
    finally:
        tracemalloc.stop()


def forget() -> None:
    """Drop the windows and paths that earlier trains left behind, so that preparing finds its own."""
    triangular_transmission._contact.cache_clear()
    clearance_window._window.cache_clear()
