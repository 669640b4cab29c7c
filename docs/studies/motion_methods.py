"""Every way to the motion of one train, each judged by the direct composition and that by 40 digits."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.analysis.gear_train import GearTrain
from geartrain.analysis.loader import load
from geartrain.dynamics.motion import Motion, RunningStatistics, Superposition
from geartrain.teeth.triangular import clearance_window, triangular_transmission
from studies.measurement import timed
from studies.motion_records import (
    ADAPTIVE,
    BOUND,
    DIRECT,
    FIXED,
    INDEPENDENT,
    LAGGED,
    NOMINAL,
    PER_POSITION,
    TABLES,
    TABULATED,
    MotionRecord,
    TrainRecord,
)
from studies.reference_solutions import MotionTruth
from studies.time_marching import Marching

Floats = NDArray[np.float64]
Ask = Callable[[Floats], Floats]


_STEPS = (1, 10)  # of marching, to a position


class Effort(NamedTuple):
    """Positions in all, rounds whose median counts, positions that are marched to, positions judged in 40 digits."""

    positions: int
    rounds: int
    marched: int
    sample: int


@dataclass
class _Off:
    """Differences (rad) of a method from the direct composition, by output: greatest, and sums of squares."""

    greatest: Floats
    squares: Floats
    count: int = 0

    @classmethod
    def none(cls, outputs: int) -> _Off:
        return cls(np.zeros(outputs), np.zeros(outputs))

    def add(self, off: Floats) -> None:
        """Count differences (outputs, n)."""
        self.greatest = np.maximum(self.greatest, np.abs(off).max(axis=1))
        self.squares = self.squares + (off**2).sum(axis=1)
        self.count += off.shape[1]

    def worst(self) -> tuple[int, float, float]:
        """The output with the greatest difference, that, and the rms there (deg)."""
        at = int(np.argmax(self.greatest))
        return at, math.degrees(self.greatest[at]), math.degrees(math.sqrt(self.squares[at] / self.count))


@dataclass
class MotionCase:
    """A train, the outputs and the run that are asked for, and what was measured of them so far."""

    name: str
    source: str
    outputs: tuple[str, ...]
    turns: float
    effort: Effort
    times: dict[str, list[float]] = field(default_factory=dict)
    prepared: dict[str, list[float]] = field(default_factory=dict)
    off: dict[str, _Off] = field(default_factory=dict)
    doubted: dict[int, tuple[float, float]] = field(default_factory=dict)
    marched: dict[str, float] = field(default_factory=dict)
    memory: dict[str, float] = field(default_factory=dict)
    peaks: dict[str, float] = field(default_factory=dict)
    tallies: list[RunningStatistics] = field(default_factory=list)

    def steps(self) -> Iterator[tuple[str, Callable[[], None]]]:
        """What there is to measure, in order; each fills in a part of the case."""
        for at in range(self.effort.rounds):
            yield f"round {at + 1}", self._round
        yield "comparing", self._compare
        yield "40 digits", self._judge
        yield "memory", self._trace
        for steps in _STEPS:
            yield f"marching, {steps} a position", partial(self._march, f"{FIXED}, {steps} a position", steps)
        yield "marching, adaptive", partial(self._march, ADAPTIVE, 0)

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
    def asked(self) -> dict[str, Ask]:
        """Each method that answers position by position: turns (n,) to errors (rad) of the outputs (outputs, n)."""
        return {method: self._ask(self.direct if method == DIRECT else None, method) for method in PER_POSITION}

    def _ask(self, built: Motion | None, method: str) -> Ask:
        if method in (NOMINAL, LAGGED):
            superposed = Superposition((built or self.direct).ahead)
            return partial(superposed.at, lagged=method == LAGGED)
        made = built or self.train.motion(outputs=self.outputs, tolerance=_tolerance(method))
        return lambda turns: made.hung.at(turns).error

    @property
    def links(self) -> int:
        """Links that an error reaches and that an output hangs on."""
        return sum(len(step.links) for step in self.direct.ahead.steps)

    def stretches(self, positions: int) -> Iterator[Floats]:
        """The first of all positions, in stretches that fit in memory."""
        chunk, last = self.direct.ahead.chunk, self.effort.positions - 1
        for start in range(0, positions, chunk):
            yield self.turns * (np.arange(start, min(start + chunk, positions)) / last)

    def run(self, method: str, positions: int) -> Floats:
        """Greatest error by output over so many positions: nothing is kept of a stretch but that."""
        ask, most = self.asked[method], np.zeros(len(self.outputs))
        for turns in self.stretches(positions):
            most = np.maximum(most, np.abs(ask(turns)).max(axis=1))
        return most

    # --------------------------------------------------------------------------------------------------- measurements

    def _round(self) -> None:
        """Every method once, one after the other, so that ratios are of neighbours in time."""
        for method in PER_POSITION:
            self.asked[method](np.zeros(2))  # tables are made when first asked
        for method in PER_POSITION:
            self.prepared.setdefault(method, []).append(self._prepare(method))
            self.times.setdefault(method, []).append(timed(partial(self.run, method, self.effort.positions))[0])
        for method in (BOUND, INDEPENDENT):
            forget()
            built = load(self.source).motion(outputs=self.outputs)
            self.prepared.setdefault(method, []).append(timed(partial(built.hung.at, np.zeros(1)))[0])
            self.times.setdefault(method, []).append(timed(partial(_estimate, built, method))[0])

    def _prepare(self, method: str) -> float:
        """Seconds from the declaration to the first answer."""
        forget()

        def first_answer() -> None:
            built = load(self.source).motion(outputs=self.outputs, tolerance=_tolerance(method))
            self._ask(built, method)(np.zeros(1))

        return timed(first_answer)[0]

    def _compare(self) -> None:
        """All methods against the direct composition, over all positions."""
        self.tallies = self.direct.tallies()
        others = [method for method in PER_POSITION if method != DIRECT]
        self.off |= {method: _Off.none(len(self.outputs)) for method in others}
        for turns in self.stretches(self.effort.positions):
            passage = self.direct.hung.at(turns)
            for at, tally in enumerate(self.tallies):
                tally.add(passage.error[at], passage.rate[at])
            for method in others:
                off = self.asked[method](turns) - passage.error
                self.off[method].add(off)
                if method == TABLES[-1]:
                    self._doubt(turns, np.abs(off))

    def _doubt(self, turns: Floats, off: Floats) -> None:
        """Remember where each output differs most between composition and the finest tables: one of them errs there."""
        for at, column in enumerate(off.argmax(axis=1)):
            self.doubted[at] = max(self.doubted.get(at, (0.0, 0.0)), (float(off[at, column]), float(turns[column])))

    def _judge(self) -> None:
        """The direct composition against the definition of its laws, at random and where tables differ most."""
        last = self.effort.positions - 1
        at = np.random.default_rng(3).integers(0, last + 1, self.effort.sample)
        turns = np.append(self.turns * (at / last), [turn for _, turn in self.doubted.values()])
        truth, found = MotionTruth(self.direct), self.direct.hung.at(turns).error
        self.off[DIRECT] = _Off.none(len(self.outputs))
        self.off[DIRECT].add(np.array([truth.off(float(each), found[:, n]) for n, each in enumerate(turns)]).T)

    def _trace(self) -> None:
        """Peaks of memory that positions take, by method, and of the direct composition by their number."""
        for method in PER_POSITION:
            self.memory[method] = _peak(partial(self.run, method, self.effort.positions))
        for share in (100, 10, 1):
            positions = self.effort.positions // share
            self.peaks[str(positions)] = _peak(partial(self.run, DIRECT, positions))

    def _march(self, method: str, steps: int) -> None:
        """March to the first positions, and compare there; the time is extrapolated to all."""
        marching = Marching(self.train, self.outputs)
        turns = np.concatenate(list(self.stretches(self.effort.marched)))
        took, error = timed(partial(marching.follow, turns, steps))
        self.off[method] = _Off.none(len(self.outputs))
        self.off[method].add(error - self.direct.hung.at(turns).error)
        self.marched[method] = took * self.effort.positions / len(turns)

    # -------------------------------------------------------------------------------------------------------- results

    def rows(self) -> list[MotionRecord]:
        """A record for each method."""
        found = [self._scalar(BOUND), self._scalar(INDEPENDENT)]
        for method in (NOMINAL, LAGGED, *TABLES, DIRECT):
            at, greatest, rms = self.off[method].worst()
            times = (median(self.times[method]), self._ratio(method), median(self.prepared[method]))
            note = f"judged at {self.off[method].count} positions" if method == DIRECT else ""
            positions = self.effort.positions
            found.append(self._record(method, times, greatest, rms, at, self.memory[method], note, positions))
        return [*found, *(self._of_marching(method) for method in self.marched)]

    def _of_marching(self, method: str) -> MotionRecord:
        at, greatest, rms = self.off[method].worst()
        times = (self.marched[method], self.marched[method] / median(self.times[DIRECT]), None)
        note = f"extrapolated from {self.off[method].count} positions"
        return self._record(method, times, greatest, rms, at, None, note, self.effort.positions)

    def _scalar(self, method: str) -> MotionRecord:
        """A method that gives one number an output: the output on which it is farthest off."""
        values = getattr(Superposition(self.direct.ahead), "bounds" if method == BOUND else "independent")
        true = [tally.peak_to_peak if method == BOUND else tally.rms for tally in self.tallies]
        at = int(np.argmax(np.abs(np.array(values) - true)))
        off = math.degrees(abs(values[at] - true[at]))
        times = (median(self.times[method]), self._ratio(method), median(self.prepared[method]))
        note = f"{(values[at] / true[at] - 1) * 100:+.1f} % of its {'peak-to-peak' if method == BOUND else 'rms'}"
        error, rms = (off, None) if method == BOUND else (None, off)
        return self._record(method, times, error, rms, at, None, note, 0)

    def _record(
        self,
        method: str,
        times: tuple[float, float, float | None],
        error: float | None,
        rms: float | None,
        output: int,
        megabytes: float | None,
        note: str,
        positions: int,
    ) -> MotionRecord:
        seconds, ratio, prepared = times
        return MotionRecord(
            self.name,
            self.links,
            method,
            seconds,
            megabytes,
            error,
            note,
            rms,
            ratio,
            prepared,
            positions,
            self.outputs[output],
        )

    def _ratio(self, method: str) -> float:
        return median(own / base for own, base in zip(self.times[method], self.times[DIRECT], strict=True))

    def summary(self) -> TrainRecord:
        """What the train is and does."""
        lawful = {source.id for source in self.direct.ahead.sources}
        outputs = {
            tally.name: {"peak_to_peak": math.degrees(tally.peak_to_peak), "rms": math.degrees(tally.rms)}
            for tally in self.tallies
        }
        return TrainRecord(
            self.name,
            self.turns,
            self.effort.positions,
            self.links,
            [source.id for source in self.direct.ahead.used],
            [circuit.id for circuit in self.train.circuits if circuit.id not in lawful],
            outputs,
            self.peaks,
            self.effort.sample,
        )


def _tolerance(method: str) -> float | None:
    name, _, tolerance = method.partition(", ")
    return float(tolerance) if name == TABULATED else None


def _estimate(built: Motion, method: str) -> list[float]:
    superposed = Superposition(built.ahead)
    return superposed.bounds if method == BOUND else superposed.independent


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
