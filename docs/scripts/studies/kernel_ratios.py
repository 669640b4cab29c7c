"""Compiled kernels against numpy, in turns: how many times as fast each is, and how far its answer is off.

Run it as `PYTHONPATH=docs/scripts python -m studies.kernel_ratios`; it prints a table. Ratios are medians over rounds
in which both take their turn, after a first call that compiles the kernel or loads it from disk.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from geartrain import load
from geartrain.dynamics.motion.compiled_composition import compiled_composition
from studies.measurement import in_turns
from studies.records import table

TRAINS = {"moon-triangular": ("moon",), "freeth-2021": ("mars", "saturn"), "freeth-2021-teeth": ("mars", "moon")}
_ROUNDS = 9


class KernelRow(NamedTuple):
    """A kernel and numpy at the same work: units of it a second by both, their ratio, greatest difference.

    error   rad
    """

    work: str
    unit: str
    plain: float
    compiled: float
    ratio: float
    error: float


def motion_rows(rounds: int = _ROUNDS) -> Iterator[KernelRow]:
    """Composition of trains over 19 turns, one chunk of positions."""
    for name, outputs in TRAINS.items():
        composition = load(name).motion(outputs=outputs)._forward
        kernel = compiled_composition(composition)
        assert kernel is not None
        turns = np.linspace(0, 19, composition.chunk)
        kernel.at(turns), composition.at(turns)
        plain, fast = in_turns([partial(composition.at, turns), partial(kernel.at, turns)], rounds)
        work = len(composition.used) * len(turns)
        off = float(np.abs(plain.found.error - fast.found.error).max())
        yield KernelRow(name, "links", work / plain.median, work / fast.median, plain.over(fast), off)


COLUMNS: dict[str, Callable[[KernelRow], str]] = {
    "work": lambda row: row.work,
    "unit": lambda row: row.unit,
    "numpy, a second": lambda row: f"{row.plain:.2g}",
    "compiled, a second": lambda row: f"{row.compiled:.2g}",
    "ratio": lambda row: f"{row.ratio:.1f}",
    "maximum difference (rad)": lambda row: f"{row.error:.1e}",
}


def main() -> None:
    """Print the table."""
    print("\n".join(table(COLUMNS, motion_rows())))


if __name__ == "__main__":
    main()
