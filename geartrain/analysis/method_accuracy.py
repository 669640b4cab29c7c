"""The methods of each stage, run on one train: how long each takes, and how far it is off.

A stage yields its methods one by one, each with its error against the best that is known: exact speeds, laws asked
directly, motion composed from them, the balance of torques with losses.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError
from geartrain.teeth.transmission import TransmissionFunction

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.dynamics.motion.superposition import Superposition
    from geartrain.kinematics.answer import Answer
    from geartrain.numerics.arrays import Floats

Stage = Literal["speeds", "variants", "transmission functions", "motion", "torques", "optimisation"]
SPEEDS: Final = "speeds"
VARIANTS: Final = "variants"
LAWS: Final = "transmission functions"
MOTION: Final = "motion"
TORQUES: Final = "torques"
OPTIMISATION: Final = "optimisation"
"""Measured by `synthesis`, which knows how to size teeth."""
TURNS = 20.0
"""Turns of the input over which motion is followed."""
_NO_FORM = "no pair has a tooth form, and no pin its sizes"
_TOLERANCES = (1e-6, 1e-12)  # of tables, in pitches
_ENOUGH, _LONG = 0.1, 5.0  # seconds after which a task is not repeated, even if it ran but once


@dataclass(frozen=True, slots=True)
class MethodAccuracy:
    """One method of one stage.

    Attributes
    ----------
    stage, method : str
        Their names.
    seconds : float
        Time of one run, the best of those within a tenth of a second [s].
    error : float or None
        Greatest error, in `unit`; None for the method that others are held against.
    unit : str
        Of the error: relative, pitches of the driven side, degrees, or a part of the power that a pair is given.
    reference : str
        What the error was held against.
    prepared : float or None
        Time of what came before it once, such as making tables [s].
    ratio : float
        Seconds over those of the cheapest method of the stage, 1 or more.
    evaluations : int or None
        How often a search asked for the figure that it makes small; None for what is no search.

    See Also
    --------
    find_accuracy : measures them
    """

    stage: Stage
    method: str
    seconds: float
    error: float | None
    unit: Literal["relative", "pitches", "deg", "of power"]
    reference: str
    prepared: float | None = None
    ratio: float = 1.0
    evaluations: int | None = None


class AbsentStageError(Exception):
    """A stage that the train does not have, and why."""


class _Timed(NamedTuple):
    seconds: float
    found: Any


def best_of(task: Callable[..., Any], fresh: Callable[[], Sequence[Any]] = tuple) -> _Timed:
    """The least time of a task, and what it returned; `fresh` makes its arguments anew before every run, untimed."""
    best, total, runs, found = math.inf, 0.0, 0, None
    while not runs or total < _ENOUGH or (runs < 2 and total < _LONG):  # the first may have had to load a library
        given = fresh()
        runs += 1
        start = time.perf_counter()
        found = task(*given)
        took = time.perf_counter() - start
        best, total = min(best, took), total + took
    return _Timed(best, found)


def _as_declared(train: GearTrain) -> tuple[GearTrain]:
    """The train with nothing solved yet but its circuits."""
    fresh = GearTrain(train.declaration)
    _ = fresh.circuits
    return (fresh,)


# speeds --------------------------------------------------------------------------------------------------------------


def measure_speeds(train: GearTrain, state: str | None) -> Iterator[MethodAccuracy]:
    """Exact elimination and sparse LU, from circuits to the speeds of all links."""
    usual = train.solve(state)
    if not usual.verdict:
        raise AbsentStageError(usual.verdict.text)

    def solve(fresh: GearTrain, method: Any) -> Answer:
        answer = fresh.solve(state, method=method)
        _ = list(answer.speeds.values())  # each is multiplied out when read
        return answer

    exact = None
    if usual.method == "exact":
        seconds, exact = best_of(partial(solve, method="exact"), partial(_as_declared, train))
        yield MethodAccuracy(SPEEDS, "exact", seconds, _residual(train, state, exact), "relative", "every equation")
    seconds, floats = best_of(partial(solve, method="floats"), partial(_as_declared, train))
    if exact is not None and train.kinematics.cases[state].exact:
        error, reference = _off(floats, exact), "exact speeds"
    else:
        error, reference = _forecast(floats), "its own forecast"
    yield MethodAccuracy(SPEEDS, "floats", seconds, error, "relative", reference)


def _residual(train: GearTrain, state: str | None, answer: Answer) -> float:
    """The most by which a Willis equation is missed, over its largest term; 0 if all hold exactly."""
    worst = 0.0
    for row in train.equations(state).equations:
        terms = [coefficient * answer.speeds[link] for link, coefficient in row.terms]
        size = max((abs(term) for term in terms), default=0)
        if size:
            worst = max(worst, float(abs(sum(terms) - row.right) / size))
    return worst


def _off(floats: Answer, exact: Answer) -> float:
    """Greatest relative error of a speed that is not 0."""
    pairs = ((floats.speeds[link], Fraction(speed)) for link, speed in exact.speeds.items())
    return max((float(abs(Fraction(near) / speed - 1)) for near, speed in pairs if speed), default=0.0)


def _forecast(floats: Answer) -> float:
    """Greatest error that floats forecast of themselves, over the speed."""
    pairs = (
        (floats.accuracy[link].estimate, speed) for link, speed in floats.speeds.items() if link in floats.accuracy
    )
    return max((float(abs(estimate / speed)) for estimate, speed in pairs if speed), default=0.0)


# transmission functions ----------------------------------------------------------------------------------------------


def measure_laws(train: GearTrain, state: str | None, positions: int) -> Iterator[MethodAccuracy]:
    """Every pair's law asked directly, and read from tables."""
    laws = {mesh.name: mesh.law for mesh in train.mechanics.meshes_in(state) if not mesh.rigid}
    laws |= {pin.coupling.name: pin.law for pin in train.mechanics.pins}
    if not laws:
        raise AbsentStageError(
            "the law of each pair with a tooth form is its exact ratio" if train.meshes else _NO_FORM
        )
    import numpy as np

    from geartrain.teeth.transmission_table import TabulatedTransmission

    # equal steps could fall on the nodes of the tables, and miss their error; seeded, so that it is the same each time
    random = np.random.default_rng(1)
    S = {name: random.uniform(0, 10 * law.period, positions) for name, law in laws.items()}

    def ask(answering: dict[str, Any]) -> dict[str, Floats]:
        return {name: each.error(S[name]) for name, each in answering.items()}

    seconds, direct = best_of(partial(ask, laws))
    yield MethodAccuracy(LAWS, f"direct, {len(laws)} laws", seconds, None, "pitches", "the others are held against it")
    for tolerance in _TOLERANCES:

        def prepare(tolerance: float = tolerance) -> dict[str, Any]:
            tables = {name: TabulatedTransmission(law, tolerance) for name, law in laws.items()}
            for table in tables.values():
                _ = table.error_table
            return tables

        prepared, tables = best_of(prepare)
        seconds, read = best_of(partial(ask, tables))
        error, reference = _farthest(laws, direct, read)
        yield MethodAccuracy(LAWS, f"tabulated, {tolerance:.0e}", seconds, error, "pitches", reference, prepared)


def _farthest(
    laws: dict[str, TransmissionFunction], direct: dict[str, Floats], found: dict[str, Floats]
) -> tuple[float, str]:
    """The greatest difference over all laws, in pitches (periods) of the driven side, and whose it is."""
    import numpy as np

    off = {}
    for name, law in laws.items():
        pitch = abs(float(law.ratio) or 1.0) * law.period
        off[name] = float(np.nanmax(np.abs(found[name] - direct[name]))) / pitch
    name = max(off, key=lambda each: off[each])
    return off[name], f"direct, of {name}"


# motion --------------------------------------------------------------------------------------------------------------


def measure_motion(train: GearTrain, state: str | None, positions: int) -> Iterator[MethodAccuracy]:
    """Errors composed in the solved order (by numpy, compiled, from tables), and superposed to first order."""
    if not train.mechanics.meshes_in(state) and not train.mechanics.pins:
        raise AbsentStageError(_NO_FORM)
    try:
        prepared, motion = best_of(partial(_composed, train, state))
    except GearTrainError as error:
        raise AbsentStageError(error.problems[0].what) from None
    if not motion.ahead.used:
        raise AbsentStageError("no error reaches an output")
    import numpy as np

    from geartrain.dynamics.motion.compiled_composition import compiled_composition
    from geartrain.dynamics.motion.superposition import Superposition
    from geartrain.numerics.kernels import usable

    turns: Floats = np.arange(positions, dtype=float) * (TURNS / positions)
    seconds, direct = best_of(partial(_errors, motion, turns))
    yield MethodAccuracy(MOTION, "composed", seconds, None, "deg", "the others are held against it", prepared)
    if usable() and (kernel := compiled_composition(motion.hung)) is not None:
        kernel.at(turns[:1])  # compiled, or loaded from disk
        seconds, found = best_of(lambda: kernel.at(turns))
        prepared, _ = best_of(partial(compiled_composition, motion.hung))
        yield _of_outputs("composed, compiled", seconds, found.error - direct, motion, direct, prepared)
    prepared, tabulated = best_of(partial(_composed, train, state, _TOLERANCES[-1]))
    seconds, found = best_of(partial(_errors, tabulated, turns))
    yield _of_outputs("composed, tabulated laws", seconds, found - direct, motion, direct, prepared)
    prepared, superposed = best_of(partial(_superposed, Superposition, motion))
    for method, lagged in (("superposed with lag", True), ("superposed", False)):
        seconds, found = best_of(partial(superposed.at, turns, lagged=lagged))
        yield _of_outputs(method, seconds, found - direct, motion, direct, prepared)


def _composed(train: GearTrain, state: str | None, tolerance: float | None = None) -> Motion:
    """The motion of all outputs, ready to be asked: laws and tables are made when first needed."""
    import numpy as np

    motion = train.motion(state, tolerance=tolerance)
    motion.hung.at(np.zeros(2))
    return motion


def _superposed(made: type[Superposition], motion: Motion) -> Superposition:
    superposed = made(motion.ahead)
    _ = superposed.lags
    return superposed


def _errors(motion: Motion, turns: Floats) -> Floats:
    return motion.hung.at(turns).error


def _of_outputs(
    method: str, seconds: float, off: Floats, motion: Motion, direct: Floats, prepared: float
) -> MethodAccuracy:
    """The output that is farthest off, with the size of its own error to compare."""
    import numpy as np

    greatest, ripple = np.degrees(np.abs(off).max(axis=1)), np.degrees(np.ptp(direct, axis=1))
    # of outputs equally far off the one with the largest ripple
    at = int(np.lexsort((ripple, greatest))[-1])
    reference = f"composed, of {list(motion.outputs)[at]}: {ripple[at]:.3g} deg peak to peak"
    return MethodAccuracy(MOTION, method, seconds, float(greatest[at]), "deg", reference, prepared)


# torques -------------------------------------------------------------------------------------------------------------


def measure_torques(train: GearTrain, state: str | None) -> Iterator[MethodAccuracy]:
    """The exact balance with losses, virtual work, which leaves losses out, and torque over a turn by its samples."""
    if not train.declaration.is_loaded(state):
        raise AbsentStageError("no loads are declared")
    seconds, found = best_of(lambda fresh: fresh.torques(state), partial(_as_declared, train))
    if not found.verdict:
        raise AbsentStageError(f"{found.verdict.kind}: {found.verdict.text}")
    powers = found.powers
    through = max((abs(power) for power in powers.values()), default=0)
    missed = abs(sum(powers.values()) - found.loss) / through if through else 0
    yield MethodAccuracy(TORQUES, "balance with losses", seconds, float(missed), "relative", "power in, out and lost")
    yield from _over_turn(train, state)
    asked = [link for link in found.asked if found.speeds.get(link) and found.external.get(link)]
    if len(found.asked) != 1 or not asked:
        return
    (link,) = asked
    loads = [name for name in train.declaration.case(state).loads if name != link]  # and no friction of bearings

    def virtual_work(fresh: GearTrain) -> Any:
        speeds = fresh.solve(state).speeds
        return -sum(found.external[name] * speeds[name] for name in loads) / speeds[link]

    seconds, lossless = best_of(virtual_work, partial(_as_declared, train))
    error = float(abs(lossless / found.external[link] - 1))
    yield MethodAccuracy(
        TORQUES, "virtual work, without losses", seconds, error, "relative", f"balance with losses, of {link}"
    )


_SAMPLES = (20_000, 2_000, 200, 20)  # of a run; the first is what the others are held against
_WORTH_COMPILING = 1.0  # s of a run
_PASSAGES = 6_000  # teeth that pass in a run, times the pairs that are asked at each


def _over_turn(train: GearTrain, state: str | None) -> Iterator[MethodAccuracy]:
    """The mean torque over a turn, or as much of it as is soon followed; nothing where no pair is uneven."""
    from geartrain.numerics.kernels import usable

    try:
        used = train.motion(state, tuple(train.declaration.links)).ahead.used
        passages = sum(float(each.cycles) for each in used)
        if not passages:
            return
        span = min(1.0, _PASSAGES / (len(used) * passages))
        best = train.torques(state, turns=span, samples=_SAMPLES[0], fast=False)
    except GearTrainError:  # teeth in a loop: the motion has no order
        return
    if not best.mean:
        return
    run = "a turn" if span == 1 else f"{span:.3g} turns"
    slowest = 0.0
    for samples in _SAMPLES:
        seconds, found = best_of(partial(_mean_torque, train, state, span, samples))
        slowest = max(slowest, seconds)
        error = None if samples == _SAMPLES[0] or found is None else abs(found / best.mean - 1)
        reference = "the others are held against it" if samples == _SAMPLES[0] else f"{_SAMPLES[0]} samples, the mean"
        yield MethodAccuracy(TORQUES, f"over {run}, {samples} samples", seconds, error, "relative", reference)
    if slowest >= _WORTH_COMPILING and usable():
        _mean_torque(train, state, span, 2, True)  # compiled, or loaded from disk
        seconds, found = best_of(partial(_mean_torque, train, state, span, _SAMPLES[0], True))
        error = None if found is None else abs(found / best.mean - 1)
        name = f"over {run}, {_SAMPLES[0]} samples, compiled"
        yield MethodAccuracy(TORQUES, name, seconds, error, "relative", f"{_SAMPLES[0]} samples, the mean")


def _mean_torque(train: GearTrain, state: str | None, span: float, samples: int, fast: bool = False) -> float | None:
    return train.torques(state, turns=span, samples=samples, fast=fast).mean
