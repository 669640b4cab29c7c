"""Speeds of outputs for many combinations of tooth counts, computed together by exact formulas."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError, check_choice
from geartrain.kinematics.formulas import Formulas, find_formulas
from geartrain.numerics.results import Result, Tabular

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.train import Train

MOST_VARIANTS = 100_000_000  # 0.8 GB for each column of float64


@dataclass(frozen=True)
class TrainVariants(Tabular, Result):
    """Table of the speeds of outputs for many combinations of tooth counts.

    For a table `found`, `found["moon"]` is the column of the output or wheel "moon".

    See Also
    --------
    geartrain.GearTrain.variants : method that returns it
    """

    KEYS = ("wheels", "outputs", "counts", "speeds", "errors")

    wheels: tuple[str, ...]
    """Names of the wheels, in the order of the columns of `counts`."""
    outputs: tuple[str, ...]
    """Names of the outputs, in the order of the columns of `speeds` and `errors`."""
    counts: Ints
    """Tooth counts, shape (combinations, wheels); the count of the last wheel varies fastest."""
    speeds: Floats
    """Speeds of the outputs [the train's unit of speed], shape (combinations, outputs); NaN if locked, free or not
    closed.
    """
    errors: Floats
    """Upper bounds on the relative errors of the speeds, shape (combinations, outputs); infinite without digits."""
    formulas: Formulas
    """Exact formulas of the output speeds. The method `exact` evaluates them."""

    def __len__(self) -> int:
        return len(self.counts)

    def _summary(self) -> str:
        return f"{len(self)} trains by {', '.join(self.wheels)}; {', '.join(self.outputs)}"

    def _meaning(self, column: str) -> str:
        return (
            "Tooth count of the wheel." if column in self.wheels else "Speed of the output [the train's unit of speed]."
        )

    def __getitem__(self, name: str) -> Any:
        """Return the column of an output or a wheel. `KeyError` is raised for any other name."""
        if name in self.outputs:
            return self.speeds[:, self.outputs.index(name)]
        if name in self.wheels:
            return self.counts[:, self.wheels.index(name)]
        raise KeyError(f"no column '{name}'; columns are {', '.join((*self.wheels, *self.outputs))}")

    def exact(self, row: int, output: str) -> Fraction | None:
        """Return the exact speed of one output for one combination of tooth counts; None if the speed is undetermined.

        Parameters
        ----------
        row : int
            Index of the combination, which is its row in `counts`.
        output : str
            Name of an output.
        """
        counts = dict(zip(self.wheels, self.counts[row].tolist(), strict=True))
        return self.formulas[output].value(counts) if self.formulas.turns(counts) else None

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each combination: tooth count of each wheel and speed of each output."""
        return {name: self[name] for name in (*self.wheels, *self.outputs)}


def find_variants(
    declared: Train, state: str | None, counts: Mapping[str, Iterable[int]], outputs: Sequence[str]
) -> TrainVariants:
    """Compute the speeds of outputs for all combinations of the given tooth counts; see `GearTrain.variants`."""
    case = declared.case(state)
    for name in outputs:
        check_choice("output", name, case.outputs)
    choices = {wheel: tuple(int(count) for count in given) for wheel, given in counts.items()}
    number = prod(map(len, choices.values()))
    if number > MOST_VARIANTS:
        what = f"{number:,} combinations of tooth counts are too many"
        raise QuestionError(Problem(what, f"a table has at most {MOST_VARIANTS:,} rows", "pass fewer tooth counts"))
    formulas = find_formulas(declared, state, choices)
    names = tuple(name for name in (outputs or case.outputs) if name in formulas)
    grid = np.meshgrid(*(np.array(each, dtype=np.int64) for each in choices.values()), indexing="ij")
    columns = {wheel: axis.ravel() for wheel, axis in zip(choices, grid, strict=True)}
    speeds, errors = (np.empty((number, len(names))) for _ in range(2))
    # combinations for which the train is neither locked nor free
    turns = np.ones(number, dtype=bool)
    for condition in formulas.conditions:
        turns &= condition.values(columns) == 0
    for exclusion in formulas.exclusions:
        turns &= exclusion.values(columns) != 0
    for at, name in enumerate(names):
        found = formulas[name]
        # the formulas also have values for trains that are locked or free
        speeds[:, at] = np.where(turns, found.values(columns), np.nan)
        errors[:, at] = found.accuracy(columns)
    table = np.stack([columns[wheel] for wheel in choices], axis=1) if choices else np.zeros((1, 0), dtype=np.int64)
    for array in (table, speeds, errors):
        array.flags.writeable = False
    return TrainVariants(tuple(choices), names, table, speeds, errors, formulas)
