"""Pairs of hand-cut wheels, judged many at once and one by one; trials of which the chance of a jam is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb, lcm, radians, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics import open_executor, run
from geartrain.numerics.confidence_intervals import wilson
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutWheel
from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts, batch_verdicts, nominal_backlash
from studies.cut_pair_transmission import CutPairLaw
from studies.cutting_errors import CuttingErrorModel, ErrorDistribution, with_errors
from studies.uncertainty_records import ErrorRecord

Bools = NDArray[np.bool_]

PLACES, EVERY = "places", "every error"
ERRORS = {
    PLACES: CuttingErrorModel(ErrorDistribution(0.0413)),
    EVERY: CuttingErrorModel(
        ErrorDistribution(0.02), ErrorDistribution(0.04), ErrorDistribution(0.03), ErrorDistribution(0.07)
    ),
}
"""Standard deviations: places in pitches; heights and eccentricity in depths, half angles in half angles."""


def sized(z1: int, z2: int, excess: float) -> TriangularSizes:
    """Teeth of half angle 30 degrees and one depth on both wheels."""
    beta = radians(30)
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def _even_wheels(sizes: TriangularSizes) -> tuple[CutWheel, CutWheel]:
    """Driver and driven wheel without errors."""
    return CutWheel.even(sizes.z1, sizes.R1, sizes.beta1), CutWheel.even(sizes.z2, sizes.R2, sizes.beta2)


Single = tuple[float, tuple[bool, bool, bool]]
"""Least play (rad of the driven wheel); whether it stops, stands still somewhere, loses contact."""


@dataclass(frozen=True)
class Batch:
    """Wheels of one pair, drawn once and judged in several ways."""

    z1: int
    z2: int
    excess: float
    errors: str
    trials: int
    seed: int = 1

    @property
    def name(self) -> str:
        """`64/38 at 1.02`."""
        return f"{self.z1}/{self.z2} at {1 + self.excess:g}"

    @property
    def pitches(self) -> int:
        """Tooth pitches of a full cycle: one trial."""
        return lcm(self.z1, self.z2)

    @cached_property
    def pair(self) -> CutGearPair:
        """The wheels, (trials, z) each."""
        sizes, rng = sized(self.z1, self.z2, self.excess), np.random.default_rng(self.seed)
        cutting = ERRORS[self.errors]
        driver, driven = (cutting.draw(wheel, rng, self.trials) for wheel in _even_wheels(sizes))
        return CutGearPair(sizes, driver, driven)

    def together(self) -> MeshingVerdicts:
        """All trials at once."""
        return batch_verdicts(self.pair.sizes, self.pair.first, self.pair.second)

    def singly(self, trials: int) -> list[Single]:
        """The first trials by a plain loop."""
        return [self._single(at) for at in range(trials)]

    def _single(self, at: int) -> Single:
        transmission = CutPairLaw.of(self.pair.sizes, self.pair.first.taken(at), self.pair.second.taken(at))
        events = transmission.events
        return events.backlash, (events.stop is not None, bool(events.of("dwell")), bool(events.of("disengaged")))

    def compared(self, found: MeshingVerdicts, singly: list[Single]) -> tuple[float, int]:
        """Greatest difference of a play (pitches of the driven wheel), and trials of other verdicts."""
        marks = np.stack((found.stops, found.dwell, found.disengaged), axis=1)[: len(singly)]
        backlash = np.array([each for each, _ in singly])
        off = np.abs(backlash - found.backlash[: len(singly)]).max() / self.pair.sizes.p2
        return float(off), int((marks != np.array([each for _, each in singly])).any(axis=1).sum())


# a pair whose chance of a jam is a finite sum -------------------------------------------------------------------------

SHARE = 0.88
"""The play over the greatest difference of two driven places."""


def chance_of_jam(z: int, share: float) -> float:
    """Chance that, of z independent uniform numbers on 0..1 in a circle, one exceeds the one before by `share`.

    With a share of 1/2 or more two such steps never follow each other, and steps that do not are independent, each
    of chance q = (1 - share)^2 / 2. So the chance that there is none is the sum of (-q)^k over the ways to choose k
    steps of the circle that do not touch, z / (z - k) (z - k choose k) of them.
    """
    if not 0.5 <= share <= 1 or z < 3:
        raise ValueError("steps are rare only for a share from 1/2 to 1, in a circle of 3 or more")
    q = (1 - share) ** 2 / 2
    return -sum(z * comb(z - k, k) // (z - k) * (-q) ** k for k in range(1, z // 2 + 1))


def uneven_driven(places: NDArray[np.float64]) -> CutGearPair:
    """64 even teeth drive 38 whose places, -1 to 1, use up the play when two neighbours differ by 2 `SHARE`.

    A driven tooth that is late against the one before it by more than the least play jams; errors as small as these
    let nothing else jam.
    """
    sizes = sized(64, 38, 0.01)
    half = nominal_backlash(sizes) * sizes.p2 / (2 * SHARE)
    driver, driven = _even_wheels(sizes)
    return CutGearPair(sizes, driver, with_errors(driven, place=half * places))


# trials in blocks of their own seeds ----------------------------------------------------------------------------------

BLOCK = 2000
"""Trials that are drawn together."""
SIGMA = 0.0516
EXACT, NORMAL = "64/38 at 1.01, driven places uniform", "64/38 at 1.02, places normal of 5.16 %"


def block_of_jams(task: Sequence[Any]) -> str:
    """Which trials of one block jam, packed: task is the case, the seed, and the number of the block."""
    case, seed, block = task
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(block,)))
    pair = _exact(rng) if case == EXACT else _normal(rng)
    return np.packbits(batch_verdicts(pair.sizes, pair.first, pair.second).jams).tobytes().hex()


def _exact(rng: np.random.Generator) -> CutGearPair:
    return uneven_driven(rng.uniform(-1.0, 1.0, (BLOCK, 38)))


def _normal(rng: np.random.Generator) -> CutGearPair:
    sizes, cutting = sized(64, 38, 0.02), CuttingErrorModel(ErrorDistribution(SIGMA))
    driver, driven = (cutting.draw(wheel, rng, BLOCK) for wheel in _even_wheels(sizes))
    return CutGearPair(sizes, driver, driven)


def jams(case: str, blocks: int, seed: int = 1, workers: int = 1, on_done: Callable[[], None] = lambda: None) -> Bools:
    """Which trials jam, (blocks * BLOCK,); the same for any number of workers."""
    tasks = [(case, seed, block) for block in range(blocks)]
    found = []
    with open_executor(workers) as executor:
        for text in run(block_of_jams, tasks, executor):
            found.append(np.unpackbits(np.frombuffer(bytes.fromhex(text), np.uint8))[:BLOCK])
            on_done()
    return np.concatenate(found).astype(bool)


def errors_of(case: str, found: Bools, numbers: Sequence[int]) -> list[ErrorRecord]:
    """How far estimates from so many trials are off, each from trials of its own out of those found.

    The exact case is held against its sum, the other against the mean of all that were found.
    """
    truth = chance_of_jam(38, SHARE) if case == EXACT else float(found.mean())
    off = 0.0 if case == EXACT else sqrt(truth * (1 - truth) / len(found))
    rows = []
    for number in numbers:
        hits = found[: len(found) // number * number].reshape(-1, number).sum(axis=1)
        rms = float(np.sqrt(np.mean(np.square(hits / number - truth))))
        ends = [wilson(int(each), number) for each in hits]
        covered = sum(low <= truth <= high for low, high in ends) / len(ends)
        rows.append(ErrorRecord(case, truth, off, number, len(hits), rms, sqrt(truth * (1 - truth) / number), covered))
    return rows
