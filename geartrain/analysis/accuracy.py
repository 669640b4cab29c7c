"""Error and run time of the computation methods for speeds, motion and torques of one train.

Each method is compared with the most accurate method of its stage. docs/scripts/studies/ measures families of trains.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.numerics.results import Shown, Tabular, TrainResult

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.kinematics.answer import Answer
    from geartrain.numerics.arrays import Floats

Stage = Literal["speeds", "motion", "torques"]

_TURNS = 20.0  # revolutions of the input over which motion is computed
_SAMPLES = (20_000, 2_000, 200, 20)  # numbers of positions per revolution for torque; the first is the reference
_PASSAGES = 6_000  # tooth engagements in a run, times the number of evaluated pairs
_ENOUGH, _LONG = 0.1, 5.0  # [s] total time after which a task is not repeated; the second even after one run
_REFERENCE = "reference for the other methods"
_NO_FORM = "no pair declares a tooth form, and no pin its dimensions"


@dataclass(frozen=True, slots=True)
class MethodAccuracy(Shown):
    """Run time and error of one method for computing speeds, motion or torques."""

    stage: Stage
    """Stage of the computation, such as "speeds"."""
    method: str
    """Name of the method, such as "exact" or "floats"."""
    seconds: float
    """Run time of the method [s]."""
    error: float | None
    """Maximum error of the results compared with `reference`, in `unit`; None for the reference method itself."""
    unit: Literal["relative", "deg"]
    """Unit of `error`: "relative" for a relative error, "deg" for an angle."""
    reference: str
    """Reference of the comparison: another method, the method's own error estimate, or the power balance."""
    prepared: float | None = None
    """Run time of preparations, which `seconds` does not include [s]; None if there are none."""
    ratio: float = 1.0
    """Run time divided by the run time of the fastest method of the stage."""


@dataclass(frozen=True, slots=True)
class TrainAccuracy(Tabular, TrainResult):
    """Run time and error of each method for speeds, motion and torques of one train in one of its declared states."""

    ROW = "MethodAccuracy"
    MEANINGS: ClassVar = {
        "error": "Maximum error; empty for the reference method [see `unit`].",
        "ratio": "Run time divided by the run time of the fastest method of the stage [1].",
    }

    PAGE = "report.accuracy_report:accuracy_document"

    state: str | None
    """Name of the state; None for a train without states."""
    positions: int
    """Number of input positions at which motion is computed."""
    methods: tuple[MethodAccuracy, ...]
    """Measured methods, ordered by stage."""
    neglected: dict[str, str]
    """Reason why a stage was not measured, keyed by stage. Stages that were measured are omitted."""

    def _summary(self) -> str:
        return f"{self._named}: {len(self.methods)} methods at {self.positions} positions"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each method: stage, method, run time, error and reference."""
        names = [field.name for field in fields(MethodAccuracy)]
        return {name: [getattr(each, name) for each in self.methods] for name in names}


def find_accuracy(train: GearTrain, state: str | None = None, positions: int = 10_000) -> TrainAccuracy:
    """Measure the run time and the error of every method that computes speeds, motion or torques."""
    stages: Mapping[Stage, Callable[[GearTrain, str | None, int], Iterator[MethodAccuracy]]] = {
        "speeds": _measure_speeds,
        "motion": _measure_motion,
        "torques": _measure_torques,
    }
    methods: list[MethodAccuracy] = []
    neglected: dict[str, str] = {}
    for stage, measure in stages.items():
        rows: list[MethodAccuracy] = []
        try:
            rows.extend(measure(train, state, positions))
        # a stage that does not apply to the train is reported with its reason
        except GearTrainError as error:
            neglected[stage] = error.problems[0].what
        fastest = min((row.seconds for row in rows), default=0.0)
        methods += [replace(row, ratio=row.seconds / fastest) for row in rows]
    return TrainAccuracy(state, positions, tuple(methods), neglected, _declaration=train.declaration)


def _best_of(task: Callable[[], Any]) -> tuple[float, Any]:
    """Run a task repeatedly; return its minimum run time [s], and its result. Modules are imported in the first run."""
    times: list[float] = []
    while not times or sum(times) < _ENOUGH or (len(times) < 2 and sum(times) < _LONG):
        start = time.perf_counter()
        found = task()
        times.append(time.perf_counter() - start)
    return min(times), found


def _measure_speeds(train: GearTrain, state: str | None, _: int) -> Iterator[MethodAccuracy]:
    """Yield the accuracy of exact elimination, if it is the default for the train, and of elimination in floats."""
    usual = train.solve(state)
    if not usual.verdict:
        raise QuestionError(Problem(usual.verdict.text))

    def solve(method: Any) -> Answer:
        # a new train each time, because a GearTrain caches its results
        answer = GearTrain(train.declaration).solve(state, method=method)
        list(answer.speeds.values())  # speeds are computed when they are read
        return answer

    seconds, floats = _best_of(partial(solve, "floats"))
    off = [abs(each.estimate / floats[link]) for link, each in floats.accuracy.items() if floats[link]]
    reference = "its error estimate"
    if usual.method == "exact":
        exactly, exact = _best_of(partial(solve, "exact"))
        yield MethodAccuracy("speeds", "exact", exactly, None, "relative", _REFERENCE)
        off = [abs(Fraction(floats[link]) / Fraction(speed) - 1) for link, speed in exact.speeds.items() if speed]
        reference = "exact speeds"
    yield MethodAccuracy("speeds", "floats", seconds, float(max(off, default=0.0)), "relative", reference)


def _measure_motion(train: GearTrain, state: str | None, positions: int) -> Iterator[MethodAccuracy]:
    """Yield the accuracy of exact composition of transmission functions, and of the superposition of small errors."""
    if not train.mechanics.meshes_in(state) and not train.mechanics.couplings:
        raise QuestionError(Problem(_NO_FORM))
    import numpy as np

    from geartrain.dynamics.motion.superposition import Superposition

    def compose() -> Motion:
        motion = train.motion(state)
        motion._unset.at(np.zeros(2))  # transmission functions are built at the first use
        return motion

    prepared, motion = _best_of(compose)
    if not motion._forward.used:
        raise QuestionError(Problem("no transmission error affects an output"))
    turns: Floats = np.arange(positions, dtype=float) * (_TURNS / positions)
    seconds, direct = _best_of(lambda: motion._unset.at(turns).error)
    ripple = np.degrees(np.ptp(direct, axis=1))
    yield MethodAccuracy("motion", "composed", seconds, None, "deg", _REFERENCE, prepared)

    def row(method: str, evaluate: Callable[[], Floats], prepared: float) -> MethodAccuracy:
        seconds, found = _best_of(evaluate)
        off = np.degrees(np.abs(found - direct).max(axis=1))
        at = int(np.lexsort((ripple, off))[-1])  # ties are broken by the largest ripple
        reference = f"composed, output {list(motion.outputs)[at]}: {ripple[at]:.3g} deg peak to peak"
        return MethodAccuracy("motion", method, seconds, float(off[at]), "deg", reference, prepared)

    prepared, superposed = _best_of(partial(Superposition, motion._forward))
    yield row("superposed with lag", partial(superposed.at, turns, lagged=True), prepared)
    yield row("superposed", partial(superposed.at, turns, lagged=False), prepared)


def _measure_torques(train: GearTrain, state: str | None, _: int) -> Iterator[MethodAccuracy]:
    """Yield the accuracy of the torque balance, and of mean torques over a revolution for few and many positions."""
    if not train.declaration.is_loaded(state):
        raise QuestionError(Problem("no loads are declared"))
    # a new train in each run, because results are cached
    seconds, found = _best_of(lambda: GearTrain(train.declaration).torques(state))
    if not found.verdict:
        raise QuestionError(Problem(f"{found.verdict.kind}: {found.verdict.text}"))
    through = max(map(abs, found.powers.values()), default=0)
    # external power must equal the loss
    missed = float(abs(sum(found.powers.values()) - found.loss) / through) if through else 0.0
    yield MethodAccuracy("torques", "balance with losses", seconds, missed, "relative", "power balance")
    used = train.motion(state, tuple(train.declaration.links))._forward.used
    passages = sum(float(each.cycles) for each in used)
    # a shorter run for long trains limits the number of tooth engagements
    span = min(1.0, _PASSAGES / (len(used) * passages)) if passages else 0.0
    mean = None
    for samples in _SAMPLES if span else ():
        seconds, found = _best_of(partial(train.torques, state, turns=span, samples=samples))
        if not found.mean:
            return
        error, reference = None, _REFERENCE
        if mean is not None:
            error, reference = abs(found.mean / mean - 1), f"mean of {_SAMPLES[0]} samples"
        method = f"over {span:.3g} turns, {samples} samples"
        yield MethodAccuracy("torques", method, seconds, error, "relative", reference)
        mean = mean or found.mean
