"""What the study of motion measured, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from studies.records import StudyRecords

BOUND, INDEPENDENT = "sum of ranges", "independent rms"
LAGGED = "superposition with lag"
DIRECT = "direct"
FIXED, ADAPTIVE = "marching, 1 a position", "marching, RK45"
PER_POSITION = (DIRECT, LAGGED)


@dataclass(frozen=True, slots=True)
class MotionRecord:
    """A method on a train.

    links        that an error reaches and an output depends on
    seconds      for all positions, without preparation
    error, rms   greatest and root mean square error (deg) of the output that has the greatest, `output`; that of the
                 peak-to-peak ripple for the sum of ranges, and that of its rms for independent phases
    ratio        seconds over those of the direct composition in the same round
    positions    that were worked out; marching is extrapolated from fewer to all
    """

    family: str
    links: int
    method: str
    seconds: float | None = None
    error: float | None = None
    note: str = ""
    rms: float | None = None
    ratio: float | None = None
    positions: int = 0
    output: str = ""

    @property
    def rate(self) -> float | None:
        """Positions times lively links a second."""
        return self.positions * self.links / self.seconds if self.seconds and self.positions else None


@dataclass(frozen=True, slots=True)
class TrainRecord:
    """One train of the run.

    turns     of the input, over `positions`
    rippling  pairs and couplings whose errors reach an output; `ideal`, those of the train that have no law
    outputs   name -> peak-to-peak and rms ripple (deg)
    peaks     positions -> peak memory (MB) of the direct composition
    sample    random positions at which the direct composition is judged
    """

    family: str
    turns: float
    positions: int
    links: int
    rippling: Sequence[str]
    ideal: Sequence[str]
    outputs: dict[str, dict[str, float]]
    peaks: dict[str, float]
    sample: int


@dataclass(frozen=True, slots=True)
class GrowthRecord:
    """A chain of so many pairs: seconds to declare it, to find windows, to spread errors and build laws, and to run."""

    pairs: int
    positions: int
    chunk: int
    declared: float
    windows: float
    prepared: float
    seconds: float

    @property
    def rate(self) -> float:
        """Positions times links a second."""
        return self.positions * self.pairs / self.seconds


@dataclass(frozen=True)
class MotionRecords(StudyRecords):
    """All measurements of one run: a table a train, and one of the chains."""

    rows: Sequence[MotionRecord]
    trains: Sequence[TrainRecord] = ()
    growth: Sequence[GrowthRecord] = ()
