"""Verdict and results of a pair with triangular teeth as functions of one or two varied parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import degrees, nan

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import GearTrainError
from geartrain.teeth.triangular.real_path import matches
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

TransmissionFactory = Callable[..., TriangularTransmission]
"""Function that returns a transmission function for keyword arguments with values of the varied parameters."""

ASTRIDE = "astride"
_MOST_CHANGES = 100
COLUMNS = (
    "tau_min",
    "tau_max",
    "error_pp_deg",
    "error_rms_deg",
    "efficiency_mean",
    "efficiency_min",
    "maximum_jump",
    "backlash_deg",
    "lost_deg",
)


@dataclass(frozen=True)
class ParameterSweep:
    """Results of a parameter sweep: parameter values, results and verdicts. Each quantity is one array, and all arrays
    have the same shape.

    `phases` names the phases of the real path in order of time, such as "approach+recess".
    """

    parameters: dict[str, NDArray[np.float64]]
    columns: dict[str, NDArray[np.float64]]
    verdicts: NDArray[np.str_]
    phases: NDArray[np.str_]

    @property
    def header(self) -> tuple[str, ...]:
        """Names of the columns of the table that `rows` yields."""
        return (*self.parameters, "verdict", "phases", *self.columns)

    @property
    def labels(self) -> NDArray[np.str_]:
        """Label of each point of the sweep: the phases of the pair if it runs, or its verdict if it does not run."""
        return np.where(self.verdicts == "runs", self.phases, self.verdicts)

    def rows(self) -> Iterator[tuple[object, ...]]:
        """Yield one table row for each point of the sweep. The first parameter varies slowest."""
        arrays = (*self.parameters.values(), self.verdicts, self.phases, *self.columns.values())
        return zip(*(array.ravel().tolist() for array in arrays), strict=True)


def sweep(
    make: TransmissionFactory, ranges: Mapping[str, Sequence[float]], on_point: Callable[[], None] = lambda: None
) -> ParameterSweep:
    """Return the results at every combination of values of one or two parameters.

    `make` creates a transmission function from keyword arguments with the names in `ranges`. If a combination does not
    give a valid pair, its verdict is "none" and its results are NaN. Teeth that never touch have their own verdict, and
    their results are NaN. `on_point` is called after each combination.
    """
    shape = tuple(len(values) for values in ranges.values())
    grids = np.meshgrid(*(np.asarray(values, dtype=float) for values in ranges.values()), indexing="ij")
    numbers = np.full((len(COLUMNS), int(np.prod(shape))), nan)
    verdicts, phases = [], []
    for at, point in enumerate(product(*ranges.values())):
        verdict, phase, found = _point(make, dict(zip(ranges, point, strict=True)))
        verdicts.append(verdict)
        phases.append(phase)
        numbers[:, at] = found
        on_point()
    return ParameterSweep(
        dict(zip(ranges, grids, strict=True)),
        {name: row.reshape(shape) for name, row in zip(COLUMNS, numbers, strict=True)},
        np.array(verdicts).reshape(shape),
        np.array(phases).reshape(shape),
    )


def _point(make: TransmissionFactory, values: dict[str, float]) -> tuple[str, str, Sequence[float]]:
    try:
        transmission = make(**values)
    # such teeth do not exist; the sweep continues with the next point
    except GearTrainError:
        return "none", "", [nan] * len(COLUMNS)
    verdict = transmission.verdict
    # teeth that never touch have a verdict, but no speeds and errors
    if not transmission.intervals:
        return verdict.kind, "", [nan] * len(COLUMNS)
    minimum, most = transmission.speed_range()
    low, high = transmission.error_range()
    row = [
        minimum,
        most,
        degrees(high - low),
        degrees(transmission.error_moments()[1]),
        transmission.efficiency_mean(),
        transmission.efficiency_minimum(),
        max((jump.value for jump in transmission.jumps), default=0.0),
        degrees(verdict.backlash),
        degrees(transmission.contact.lost),
    ]
    return verdict.kind, phases_of(transmission), row


def phases_of(transmission: TriangularTransmission) -> str:
    """Return the successive phases of contact of driving tooth pairs, starting at entry and joined by "+", such as
    "approach+recess".

    If a tooth pair goes from approach to recess without a loss of contact, both phases are replaced by "astride".
    """
    path = transmission.intervals
    through = [matches(path[at - 1], path[at], transmission.period) for at in range(len(path))]
    entries = [at for at, matched in enumerate(through) if not matched and path[at].held is None]
    first = max(entries, key=lambda at: path[at].start, default=0)
    names: list[str] = []
    for at in (*range(first, len(path)), *range(first)):
        if through[at] and names:
            names[-1] = ASTRIDE
        else:
            names.append(path[at].phase)
    return "+".join(names)


@dataclass(frozen=True)
class VerdictChange:
    """Value of a parameter at which the verdict of a pair changes, or its phases of contact if it runs. `before` and
    `after` are the verdict or phases at smaller and at larger values.
    """

    value: float
    before: str
    after: str


def changes(make: TransmissionFactory, name: str, found: ParameterSweep) -> list[VerdictChange]:
    """Return all changes of verdict or phases along the sweep `found` of the parameter `name`, at most 100, by
    bisection. `make` creates a transmission function from a value of this parameter.
    """
    values = found.parameters[name].tolist()
    labels = [_label(v, p) for v, p in zip(found.verdicts.tolist(), found.phases.tolist(), strict=True)]
    seen: list[VerdictChange] = []
    for at in range(1, len(values)):
        low, before = values[at - 1], labels[at - 1]
        while before != labels[at] and len(seen) < _MOST_CHANGES:
            low, after = _locate(make, name, low, values[at], before, labels[at])
            seen.append(VerdictChange(low, before, after))
            before = after
    return seen


def _locate(
    make: TransmissionFactory, name: str, low: float, high: float, before: str, after: str
) -> tuple[float, str]:
    # 60 bisections reduce any range to neighbouring floats
    for _ in range(60):
        middle = low + (high - low) / 2
        # about 100 floats apart: the verdict has no finer resolution
        if not low < middle < high or high - low < 1e-13 * abs(high):
            break
        verdict, phases, _row = _point(make, {name: middle})
        label = _label(verdict, phases)
        low, high, after = (middle, high, after) if label == before else (low, middle, label)
    return high, after


def _label(verdict: str, phases: str) -> str:
    return f"{verdict} ({phases})" if phases else verdict


def best(make: TransmissionFactory, name: str, found: ParameterSweep) -> tuple[float, float] | None:
    """Return the value of the parameter `name` at which the efficiency of running pairs is a maximum, and this
    efficiency; None if no pair runs.

    The best point of the sweep `found` is refined between its neighbours by golden-section search, with the
    transmission functions that `make` creates.
    """
    values = found.parameters[name].tolist()
    efficiency = np.where(found.verdicts == "runs", found.columns["efficiency_mean"], nan)
    if np.isnan(efficiency).all():
        return None
    at = int(np.nanargmax(efficiency))

    def value(x: float) -> float:
        verdict, _phases, row = _point(make, {name: x})
        return row[COLUMNS.index("efficiency_mean")] if verdict == "runs" else -1.0

    low, high = values[max(at - 1, 0)], values[min(at + 1, len(values) - 1)]
    golden = (5**0.5 - 1) / 2
    # 0.618^40 = 4e-9: function values resolve only half the digits of a maximum
    for _ in range(40):
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if value(a) >= value(b) else (a, high)
    x = low + (high - low) / 2
    return (x, value(x)) if value(x) >= float(efficiency[at]) else (values[at], float(efficiency[at]))
