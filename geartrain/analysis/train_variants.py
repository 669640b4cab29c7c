"""One train with many tooth counts: all outputs of all of them at once, by their exact formulas."""

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

MOST_VARIANTS = 100_000_000


@dataclass(frozen=True)
class TrainVariants(Tabular, Result):
    """Speeds of outputs by assignment of tooth counts. `found["moon"]` is a column: of an output, or of counts.

    See Also
    --------
    geartrain.GearTrain.variants : gives it.
    """

    KEYS = ("wheels", "outputs", "counts", "speeds", "errors")

    wheels: tuple[str, ...]
    """Columns of `counts`."""
    outputs: tuple[str, ...]
    """Columns of `speeds` and `errors`."""
    counts: Ints
    """A row an assignment, shape (n, wheels); the last wheel changes fastest."""
    speeds: Floats
    """Shape (n, outputs) [unit of the train]; nan where a train is locked, free, or does not close a loop."""
    errors: Floats
    """Bounds on the relative errors of the speeds, infinite where no digit is sure; shape (n, outputs)."""
    formulas: Formulas
    """Where the speeds come from; `exact` asks them."""

    def __len__(self) -> int:
        return len(self.counts)

    def _summary(self) -> str:
        return f"{len(self)} trains by {', '.join(self.wheels)}; {', '.join(self.outputs)}"

    def _meaning(self, column: str) -> str:
        return "Tooth count of the wheel." if column in self.wheels else "Speed of the output [unit of the train]."

    def __getitem__(self, name: str) -> Any:
        """A column; `KeyError` for one there is not."""
        if name in self.outputs:
            return self.speeds[:, self.outputs.index(name)]
        if name in self.wheels:
            return self.counts[:, self.wheels.index(name)]
        raise KeyError(f"no column '{name}': there are {', '.join((*self.wheels, *self.outputs))}")

    def exact(self, row: int, output: str) -> Fraction | None:
        """The speed of one output in one row as a fraction; None where it has none.

        Parameters
        ----------
        row : int
            Of the table.
        output : str
            One of the outputs.
        """
        counts = dict(zip(self.wheels, self.counts[row].tolist(), strict=True))
        return self.formulas[output].value(counts) if self.formulas.turns(counts) else None

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Counts, then speeds."""
        return {name: self[name] for name in (*self.wheels, *self.outputs)}


def find_variants(
    declared: Train, state: str | None, counts: Mapping[str, Iterable[int]], outputs: Sequence[str]
) -> TrainVariants:
    """All combinations of some counts; see `GearTrain.variants`."""
    case = declared.case(state)
    for name in outputs:
        check_choice("output", name, case.outputs)
    choices = {wheel: tuple(int(count) for count in given) for wheel, given in counts.items()}
    number = prod(map(len, choices.values()))
    if number > MOST_VARIANTS:
        what = f"{number:,} assignments of counts are too many"
        raise QuestionError(Problem(what, f"{MOST_VARIANTS:,} fit into memory", "ask for fewer counts at once"))
    formulas = find_formulas(declared, state, choices)
    names = tuple(name for name in (outputs or case.outputs) if name in formulas)
    grid = np.meshgrid(*(np.array(each, dtype=np.int64) for each in choices.values()), indexing="ij")
    columns = {wheel: axis.ravel() for wheel, axis in zip(choices, grid, strict=True)}
    speeds, errors = (np.empty((number, len(names))) for _ in range(2))
    turns = np.ones(number, dtype=bool)
    for condition in formulas.conditions:
        turns &= condition.values(columns) == 0
    for exclusion in formulas.exclusions:
        turns &= exclusion.values(columns) != 0
    for at, name in enumerate(names):
        found = formulas[name]
        speeds[:, at] = np.where(turns, found.values(columns), np.nan)
        errors[:, at] = found.accuracy(columns)
    table = np.stack([columns[wheel] for wheel in choices], axis=1) if choices else np.zeros((1, 0), dtype=np.int64)
    for array in (table, speeds, errors):
        array.flags.writeable = False
    return TrainVariants(tuple(choices), names, table, speeds, errors, formulas)
