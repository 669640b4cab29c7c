"""One run of a motion: so many turns of the input in so many positions, and what is asked of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.order_spectrum import SpectrumLine, find_spectrum
from geartrain.dynamics.motion.run_statistics import PeakRefinement
from geartrain.dynamics.motion.superposition import ErrorEstimates, find_estimates
from geartrain.errors import GearTrainError, Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.numerics.arrays import Floats

    OnDone = Callable[[int], None]


MOST_TURNS = 10**12
"""Beyond so many turns of an input, positions as floats no longer tell the teeth of one turn apart."""


def _nobody(_: int) -> None:
    pass


@dataclass
class MotionRun:
    """`samples` positions from 0 to `turns` of the input; results stand here as far as they were asked for.

    tallies     peaks and moments by output; `phased`, the same for each set of random phases
    done        positions counted so far: fewer than `samples` in a run that was interrupted
    """

    motion: Motion
    turns: float
    samples: int
    tallies: list[RunningStatistics] = field(default_factory=list)
    phased: list[list[RunningStatistics]] = field(default_factory=list)
    seed: int | None = None
    estimates: dict[str, ErrorEstimates] = field(default_factory=dict)
    spectra: dict[str, list[SpectrumLine]] = field(default_factory=dict)
    done: int = 0

    def __post_init__(self) -> None:
        if not abs(self.turns) <= MOST_TURNS:
            why = "so far away positions do not tell the teeth of one turn apart"
            raise QuestionError(
                Problem(
                    f"a motion over {self.turns:g} turns", why, f"give turns from -{MOST_TURNS:g} to {MOST_TURNS:g}"
                )
            )
        if self.samples < 2:
            raise QuestionError(
                Problem(f"{self.samples} positions of the input", "from one to the next it turns", "give 2 or more")
            )

    def go(self, on_done: OnDone = _nobody) -> None:
        """Count every position; `on_done` is told of each stretch."""
        self.tallies = self.motion.tallies()
        peaks = PeakRefinement(len(self.tallies), self.turns / (self.samples - 1))
        for passage in self.motion.passages(self.turns, self.samples):
            for at, tally in enumerate(self.tallies):
                tally.add(passage.error[at], passage.rate[at])
            peaks.add(passage)
            self.done += len(passage.turns)
            on_done(len(passage.turns))
        peaks.sharpen(self.motion.ahead if self.turns >= 0 else self.motion.back, self.turns, self.tallies)

    def try_phases(self, count: int, seed: int, on_done: OnDone = _nobody) -> None:
        """The same run with `count` sets of random phases."""
        self.seed = seed if count else None
        if seed < 0:
            raise QuestionError(Problem(f"a seed of {seed}", "random numbers begin at 0 or more", "give 0 or more"))
        random = np.random.default_rng(seed)
        for _ in range(count):
            other = MotionRun(self.motion.at_random(random), self.turns, self.samples)
            other.go(on_done)
            self.phased.append(other.tallies)

    def estimate(self, on_done: OnDone = _nobody) -> None:
        """Cheap estimates with their true error."""
        self.estimates = find_estimates(self.motion, self.turns, self.samples, on_done)

    def analyse(self, on_done: OnDone = _nobody) -> None:
        """Spectra by exact order."""
        self.spectra = find_spectrum(self.motion, self.turns, self.samples, on_done=on_done)

    @property
    def columns(self) -> list[str]:
        """Names of the columns of a table of all positions."""
        names = self.motion.outputs
        return ["turns", *(f"{name} {what}" for name in names for what in ("angle (rad)", "error (rad)", "speed"))]

    def values(self, passage: ErrorSamples) -> list[Floats]:
        """The columns of one stretch: an angle is its start, mean motion and error; a speed is over the input's."""
        found = [passage.turns]
        angle = 2 * pi * passage.turns
        for at, (tally, start) in enumerate(zip(self.motion.tallies(), self.motion.starts, strict=True)):
            error = passage.error[at]
            found += [start + tally.mean * angle + error, error, tally.mean + passage.rate[at]]
        return found

    def check_resumed(self, row: str, rows: int) -> None:
        """Refuse to go on with a table whose last row is not of this run."""
        turns = self.turns * ((rows - 1) / (self.samples - 1))
        if rows > self.samples or row.split(",")[0] != repr(turns):
            what = f"its row {rows} stands at {row.split(',')[0]} turns, and this run has {turns!r} there"
            raise GearTrainError(
                Problem("the partial file is of another run", what, "give the same turns and samples, or begin again")
            )
