"""Compiled kernels against numpy, in turns: how many times as fast each is, and how far its answer is off.

Run it as `PYTHONPATH=docs/scripts python -m studies.kernel_ratios`; it prints a table. Ratios are medians over rounds
in which both take their turn, after a first call that compiles the kernel or loads it from disk.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from geartrain.analysis.gear_train import load
from geartrain.dynamics.motion.compiled_composition import compiled_composition
from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.turn.compiled_turn import compiled_turn
from geartrain.dynamics.turn.turn_analysis import find_turn_balance
from geartrain.dynamics.turn.turn_balance import TurnBalance
from geartrain.uncertainty.manufacturing_errors.compiled_verdicts import compiled_verdicts
from studies.cut_pair_trials import EVERY, Batch
from studies.measurement import in_turns
from studies.records import number_text, table

TRAINS = {"moon-triangular": ("moon",), "freeth-2021": ("mars", "saturn"), "freeth-2021-teeth": ("mars", "moon")}
LOADED = {"moon-triangular": "moon", "freeth-2021": "mars", "price-1974": "moon", "pennestri-2002": "'5'"}
TEETH = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\nfriction: 0.2\n"
PAIRS = ((64, 38, 0.02, 500), (48, 24, 0.02, 4000), (45, 225, 0.01, 900), (20, 60, 0.015, 4000))
_ROUNDS = 9


class KernelRow(NamedTuple):
    """A kernel and numpy at the same work: units of it a second by both, their ratio, greatest difference.

    error   rad; of torques, relative
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
        composition = load(name).motion(outputs=outputs).ahead
        kernel = compiled_composition(composition)
        assert kernel is not None
        turns = np.linspace(0, 19, composition.chunk)
        kernel.at(turns), composition.at(turns)
        plain, fast = in_turns([partial(composition.at, turns), partial(kernel.at, turns)], rounds)
        work = sum(len(step.links) for step in composition.steps) * len(turns)
        off = float(np.abs(plain.found.error - fast.found.error).max())
        yield KernelRow(name, "links", work / plain.median, work / fast.median, plain.over(fast), off)


def cutting_rows(rounds: int = _ROUNDS) -> Iterator[KernelRow]:
    """Verdicts on pairs cut with every error."""
    for z1, z2, excess, trials in PAIRS:
        batch = Batch(z1, z2, excess, EVERY, trials)
        compiled_verdicts(batch.pair)
        plain, fast = in_turns([batch.together, partial(compiled_verdicts, batch.pair)], rounds)
        work = trials * batch.pitches
        off = float(np.abs(plain.found.play - fast.found.play).max())
        yield KernelRow(batch.name, "tooth pitches", work / plain.median, work / fast.median, plain.over(fast), off)


def turn_rows(rounds: int = _ROUNDS) -> Iterator[KernelRow]:
    """The balance of torques at random positions of a turn, with assumed teeth, friction and bearings."""
    for name, link in LOADED.items():
        train = load(f"extends: {name}\n{TEETH}links: {{{link}: {{bearing: 1 N mm}}}}\n")
        setting = train.mechanics.load_case()
        assert setting is not None
        balance = find_turn_balance(setting, find_motion_problem(train.mechanics), None)
        assert isinstance(balance, TurnBalance)
        kernel = compiled_turn(balance)
        assert kernel is not None
        turns = np.random.default_rng(1).random(8192)
        kernel.at(turns, False)
        plain, fast = in_turns([partial(balance.at, turns), partial(kernel.at, turns, False)], rounds)
        torque = plain.found.torque
        off = float(np.abs(fast.found[1].torque - torque).max() / np.abs(torque).max())
        work = len(balance.pairs) * len(turns)
        yield KernelRow(f"torque of {name}", "pairs", work / plain.median, work / fast.median, plain.over(fast), off)


COLUMNS: dict[str, Callable[[KernelRow], str]] = {
    "work": lambda row: row.work,
    "unit": lambda row: row.unit,
    "numpy, a second": lambda row: number_text(row.plain, ".2g"),
    "compiled, a second": lambda row: number_text(row.compiled, ".2g"),
    "ratio": lambda row: number_text(row.ratio, ".1f"),
    "greatest difference (rad; of torques, relative)": lambda row: number_text(row.error, ".1e"),
}


def main() -> None:
    """Print the table."""
    print("\n".join(table(COLUMNS, [*motion_rows(), *turn_rows(), *cutting_rows()])))


if __name__ == "__main__":
    main()
