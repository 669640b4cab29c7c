"""Trials of one pair in blocks of their own seeds: what errors of estimates and workers are measured on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.bench.uncertainty_pairs import sized
from geartrain.bench.uncertainty_records import ErrorRecord
from geartrain.bench.uncertainty_truth import SHARE, chance_of_jam, uneven_driven
from geartrain.numerics.work import open_executor, run
from geartrain.uncertainty.confidence_intervals import wilson
from geartrain.uncertainty.manufacturing_errors import CuttingErrorModel, CutWheel, ErrorDistribution, batch_verdicts
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair

Bools = NDArray[np.bool_]

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
    driver = cutting.draw(CutWheel.driver_of(sizes), rng, BLOCK)
    return CutGearPair(sizes, driver, cutting.draw(CutWheel.driven_of(sizes), rng, BLOCK))


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
