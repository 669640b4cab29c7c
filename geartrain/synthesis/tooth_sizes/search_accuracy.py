"""Error against run time of ways to the radii of least loss, on one pair of a train: the stage `optimisation`.

In goes a train; out comes a row a way, for the pair with triangular teeth that loses most as it is declared: the
package's own search, scans in steps of 0.1 % and 1 %, Brent's bounded method once, differential evolution. The error of
each is its loss less the least that any of them found, among them a scan in steps of 0.01 % about the lowest of the
coarser one, polished by Brent's method.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from scipy.optimize import Bounds, differential_evolution, minimize_scalar

from geartrain.analysis import GearTrain, MethodAccuracy
from geartrain.analysis.method_accuracy import OPTIMISATION, AbsentStageError
from geartrain.errors import GearTrainError
from geartrain.numerics.arrays import Floats
from geartrain.synthesis.tooth_sizes.size_design import ToothSizes, equal_depth_radii
from geartrain.synthesis.tooth_sizes.size_search import Range, SizeSearch
from geartrain.teeth.triangular.clearance_window import forget_windows
from geartrain.teeth.triangular.triangular_transmission import forget_contacts

_REACH = 0.08  # of the radii, to either side of midway between equal depth and pitch-true
_COARSE, _STEP, _FINE = 0.01, 0.001, 0.0001  # of the scans
_TOLERANCE = 1e-8  # of Brent's method where it polishes: the loss is flat there
_POPULATION, _GENERATIONS = 10, 10  # of differential evolution


@dataclass(frozen=True, slots=True)
class _Trial:
    """What one way found, after how long [s] and how many designs."""

    method: str
    loss: float
    seconds: float
    evaluations: int


def measure_optimisation(
    train: GearTrain, state: str | None, on_method: Callable[[], None] = lambda: None
) -> Iterator[MethodAccuracy]:
    """Ways to the radii with which the pair that loses most loses least; each runs once, for its time is of seconds."""
    name, start = _worst_pair(train, state)
    middle = (1.0 + equal_depth_radii(*start.teeth, start.half_angles)) / 2
    box = middle * (1 - _REACH), middle * (1 + _REACH)
    _ = start.at({"radii": middle}).merit("loss")  # what is loaded once is no part of the first time
    trials = []
    for trial in _trials(start, box):
        trials.append(trial)
        on_method()
    least = min(trial.loss for trial in trials)
    reference = f"least loss of all, {100 * least:.5f} %, of {name}: {start.teeth[0]}/{start.teeth[1]}"
    for trial in trials:
        yield MethodAccuracy(
            OPTIMISATION,
            trial.method,
            trial.seconds,
            trial.loss - least,
            "of power",
            reference,
            evaluations=trial.evaluations,
        )


def _worst_pair(train: GearTrain, state: str | None) -> tuple[str, ToothSizes]:
    """The pair that loses most as it is declared, or in mid window where it does not turn so."""
    from geartrain.synthesis.tooth_sizes.declared_sizes import declared_sizes, sizeable_meshes

    try:
        meshes = sizeable_meshes(train.mechanics.meshes_in(state))
        declared = {name: declared_sizes(mesh) for name, mesh in meshes.items()}
    except GearTrainError as error:
        raise AbsentStageError(error.problems[0].what) from None
    if not meshes:
        raise AbsentStageError("no pair has triangular teeth of free sizes")
    losses = {name: sizes.loss for name, sizes in declared.items() if sizes.runs and sizes.friction > 0}
    if not losses:
        raise AbsentStageError("no pair with triangular teeth turns under friction")
    worst = max(losses, key=lambda name: losses[name])
    return worst, declared[worst]


def _trials(start: ToothSizes, box: Range) -> Iterator[_Trial]:
    """Every way in its turn; none takes over what another has worked out, unless it holds the other."""
    yield _by_search(start, box)
    yield _by_brent(start, box)
    yield _by_evolution(start, box)
    yield from _by_scans(start, box)


def _afresh() -> float:
    """The time now, with no window or contact of another way still known."""
    forget_windows()
    forget_contacts()
    return time.perf_counter()


def _by_search(start: ToothSizes, box: Range) -> _Trial:
    search = SizeSearch(start, {"radii": box})
    begun = _afresh()
    loss = search.least("loss", [start]).loss
    return _Trial("DIRECT, polished by Brent", loss, time.perf_counter() - begun, len(search.designs))


def _by_brent(start: ToothSizes, box: Range) -> _Trial:
    search = SizeSearch(start, {"radii": box})
    value = search.value("loss")
    begun = _afresh()
    found = minimize_scalar(lambda x: value((float(x),)), bounds=box, method="bounded", options={"xatol": _TOLERANCE})
    return _Trial("Brent, bounded, once", float(found.fun), time.perf_counter() - begun, len(search.designs))


def _by_evolution(start: ToothSizes, box: Range) -> _Trial:
    search = SizeSearch(start, {"radii": box})
    value = search.value("loss")

    def loss(x: Floats) -> float:
        return value((float(x[0]),))

    bounds = Bounds([box[0]], [box[1]])
    begun = _afresh()
    found = differential_evolution(loss, bounds, popsize=_POPULATION, maxiter=_GENERATIONS, seed=1, polish=False)
    return _Trial("differential evolution", float(found.fun), time.perf_counter() - begun, len(search.designs))


def _by_scans(start: ToothSizes, box: Range) -> Iterator[_Trial]:
    """The scan in steps of 0.1 %, that of 1 %, which is every tenth of it, and the finer one about its lowest."""
    low, high = box
    radii, losses, seconds = [], [], []
    _afresh()
    for step in range(int((high - low) / _STEP) + 1):
        radii.append(low + step * _STEP)
        begun = time.perf_counter()
        losses.append(start.at({"radii": radii[-1]}).merit("loss"))
        seconds.append(time.perf_counter() - begun)
    every = round(_COARSE / _STEP)
    yield _Trial("scan in steps of 1 %", min(losses[::every]), sum(seconds[::every]), len(losses[::every]))
    yield _Trial("scan in steps of 0.1 %", min(losses), sum(seconds), len(losses))
    lowest = radii[losses.index(min(losses))]
    fine = SizeSearch(start, {"radii": (max(low, lowest - _STEP), min(high, lowest + _STEP))})
    value = fine.value("loss")
    begun = _afresh()
    ((first, last),) = fine.bounds
    around = min((first + step * _FINE for step in range(int((last - first) / _FINE) + 1)), key=lambda x: value((x,)))
    near = max(first, around - _FINE), min(last, around + _FINE)
    minimize_scalar(lambda x: value((float(x),)), bounds=near, method="bounded", options={"xatol": _TOLERANCE})
    loss = min(design.merit("loss") for design in fine.designs.values())
    took = sum(seconds) + time.perf_counter() - begun
    yield _Trial("scan, then 0.01 % and Brent", min(loss, *losses), took, len(losses) + len(fine.designs))
