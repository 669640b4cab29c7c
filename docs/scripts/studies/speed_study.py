"""Every way to the speeds of a train: time, memory and true error over size."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from typing import Any

import numpy as np

from geartrain import GearTrain, load
from geartrain.kinematics import WillisEquation, WillisSystem
from geartrain.kinematics.components import SolvedPart
from geartrain.kinematics.speeds import solve
from geartrain.kinematics.speeds.float_speeds import prepare, solve_floats
from geartrain.kinematics.willis_matrix import PaddedRows
from geartrain.numerics.arrays import Floats
from studies.measurement import Task, measure
from studies.records import StudyRecords
from studies.train_families import FAMILIES

SIZES = (100, 1_000, 10_000, 100_000, 1_000_000)
_TREES_ONLY = 1_000_000  # links
_GRID_EXACT = 2_100
_FLINT_LINKS = 1_100
_ALL_LINKS = 200_000
_DRIFTED = 2_000  # links beyond which a ratio that drifts leaves float64, and each number is long
_JUDGED = 50  # equations into which such speeds are put


@dataclass(frozen=True, slots=True)
class SpeedRecord:
    """A method on a train: best time, growth of peak memory, maximum true relative error of any speed.

    None if the method did not finish, or if there is no exact answer to compare with.
    """

    family: str
    links: int
    method: str
    seconds: float | None
    megabytes: float | None
    error: float | None
    note: str = ""


@dataclass(frozen=True)
class SpeedRecords(StudyRecords):
    """All measurements of one run on one machine."""

    rows: Sequence[SpeedRecord]


def speeds(most: int = 1_000_000, minimum: int = 0, families: Collection[str] = tuple(FAMILIES)) -> SpeedRecords:
    """Measure all methods on `families` from `minimum` to `most` links; the largest size on trees only."""
    rows: list[SpeedRecord] = []
    for family, train in _trains(most, minimum, families):
        print(family, len(train.declaration.links), file=sys.stderr, flush=True)
        rows += _measure_all(family, train)
    return SpeedRecords("Speeds: error against run time", rows)


def _trains(most: int, minimum: int, families: Collection[str]) -> Iterator[tuple[str, GearTrain]]:
    """Two shipped trains, then each family as it grows."""
    for name in ("pennestri-2002", "freeth-2021") if minimum == 0 else ():
        yield name, load(name)
    for family in families:
        for size in SIZES:
            if minimum <= size <= most and (size < _TREES_ONLY or family == "tree"):
                yield family, GearTrain.declare(FAMILIES[family](size))


def _measure_all(family: str, train: GearTrain) -> list[SpeedRecord]:
    links, last = len(train.declaration.links), list(train.declaration.links)[-1]
    rows: list[SpeedRecord] = []

    def take(method: str, task: Task, error_of: Callable[[Any], float | None] = lambda _: None) -> None:
        rows.append(SpeedRecord(family, links, method, *measure(task, error_of)))

    system = train.equations()
    coupled = family == "grid" and links > _GRID_EXACT
    drifted = family == "drift" and links > _DRIFTED
    exact = None if coupled else _exact(train)
    some = WillisSystem(system.links, system.equations[:: links // _JUDGED]) if drifted else system
    if not (drifted and links > _ALL_LINKS):  # to read them all takes the square of their number, whatever is kept
        take("exact", lambda: _read(_exact(train)), lambda speeds: _residue(some, speeds))
    if exact is not None:
        take(
            "exact, one output",
            lambda: train.solve(output=last, method="exact")[last],
            lambda speed: _same(speed, exact[last]),
        )
    if drifted:
        return rows
    truth = None if exact is None else np.array([float(exact[link]) for link in train.declaration.links])
    matrix, equations = prepare(system)
    shuffled = _Shuffled(matrix, links)
    moving = [at for at, link in enumerate(train.declaration.links) if link in matrix.at]
    right = np.array([float(row.right) for row in equations])

    def error_of(x: Floats) -> float | None:
        return _error(x, None if truth is None else truth[moving])

    if links <= _FLINT_LINKS and find_spec("flint"):
        compiled = _compiled(matrix, equations)
        take(
            "compiled rationals, python-flint",
            lambda: compiled[0].solve(compiled[1]),
            lambda x: error_of(np.array([float(Fraction(int(v[0].p), int(v[0].q))) for v in x.tolist()])),
        )
    if links <= _ALL_LINKS:
        take("scipy spsolve", lambda: shuffled.spsolve(right), error_of)
    take("refined floats", lambda: _refined(system), lambda x: _error(x, truth))
    return rows


def _exact(train: GearTrain) -> Mapping[str, Fraction]:
    """Walk, reduce, eliminate, read off: everything but the circuits themselves."""
    declared = train.declaration
    part = SolvedPart(tuple(declared.links), declared.frame, train.circuits, tuple(declared.inputs))
    return solve(part, declared.case(train.states[0] if train.states else None), train.kinematics.signs, None).speeds


def _read(speeds: Mapping[str, Fraction]) -> Mapping[str, Fraction]:
    """The speeds, each multiplied out once."""
    for _ in speeds.values():
        pass
    return speeds


def _same(speed: Any, right: Fraction) -> float:
    return 0.0 if speed == right else float("inf")


def _residue(system: WillisSystem, speeds: Mapping[str, Fraction]) -> float:
    """0 if the speeds satisfy every raw equation exactly."""
    return 0.0 if all(_holds(row, speeds) for row in system.equations) else float("inf")


def _holds(row: WillisEquation, speeds: Mapping[str, Fraction]) -> bool:
    """The row in integers, cross-multiplied: reducing fractions of long numbers would take longer than solving."""
    top, bottom = 0, 1
    for link, coefficient in row.terms:
        speed = speeds[link]
        top = top * speed.denominator + coefficient * speed.numerator * bottom
        bottom *= speed.denominator
    return top * row.right.denominator == row.right.numerator * bottom


def _compiled(matrix: PaddedRows, equations: Sequence[WillisEquation]) -> tuple[Any, Any]:
    """The raw system as integer matrices of a compiled library."""
    import flint

    lines = [[0] * len(equations) for _ in equations]
    for at, line in enumerate(lines):
        for column, coefficient in zip(matrix.columns[at], matrix.coefficients[at], strict=True):
            line[column] += int(coefficient)
    return flint.fmpz_mat(lines), flint.fmpz_mat([[int(row.right)] for row in equations])


def _refined(system: WillisSystem) -> Floats:
    values: Floats = solve_floats(system).speeds.values[:, 0]
    return values


def _error(x: Any, truth: Floats | None) -> float | None:
    """Greatest relative error of any speed that is not 0."""
    if truth is None:
        return None
    used = truth != 0
    return float(np.max(np.abs((np.asarray(x)[used] - truth[used]) / truth[used])))


class _Shuffled:
    """The raw matrix with rows and columns in random order, as a user's model would arrive."""

    def __init__(self, rows: PaddedRows, seed: int) -> None:
        draw = np.random.default_rng(seed)
        size = len(rows.columns)
        self.lines, self.columns = draw.permutation(size), draw.permutation(size)
        self.matrix = rows.matrix()[self.lines][:, self.columns].tocsc()

    def _back(self, y: Floats) -> Floats:
        x = np.empty_like(y)
        x[self.columns] = y
        return x

    def spsolve(self, right: Floats) -> Floats:
        from scipy.sparse import linalg

        solver: Any = linalg
        return self._back(solver.spsolve(self.matrix, right[self.lines]))
