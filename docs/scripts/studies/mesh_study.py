"""Every way to the transmission law of triangular teeth: cost, memory and true error, as ratios to the direct formula.

Direct is `TriangularTransmission`: few candidates, switching points as roots, then one formula an angle. Its
alternatives: the envelope of all couples sampled and interpolated; switching points found by scanning all couples;
the law tabulated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.teeth.transmission_table import CellTable, fit, folded_kinks
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission
from studies.measurement import Step, Task, measure, taken
from studies.mesh_methods import Sampled, plain_transmission
from studies.records import StudyRecords
from studies.reference_solutions import reference

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]

DIRECT, TABULATED = "direct", "tabulated"
QUANTITIES = ("error", "speed")
_PAIRS: tuple[tuple[int, int, float, float | None], ...] = (
    # teeth, half angle in deg, excess (None: a third of the way from jamming to losing contact)
    (48, 96, 30, 0.01),
    (96, 96, 30, 0.01),
    (15, 53, 30, 0.01525),
    (3, 7, 20, 0.2),
    (1_000, 3_000, 30, None),
    (100_000, 100_000, 30, None),
)
_GROWTH = (100, 1_000, 10_000, 100_000, 1_000_000)
_SAMPLES = (100, 1_000, 10_000, 100_000)
_MARGIN = 1e-10  # of a pitch about a switching point, where rounding decides who drives


@dataclass(frozen=True, slots=True)
class MeshRecord:
    """A method on a pair: best time, growth of peak memory, greatest true error.

    tooth_pairs    of teeth within reach
    error      in pitches of the driven wheel for the quantity "error", relative to the mean ratio for "speed"
    quantity   what was asked for, and at how many `angles`
    """

    family: str
    tooth_pairs: int
    method: str
    seconds: float | None
    megabytes: float | None
    error: float | None
    note: str = ""
    quantity: str = ""
    angles: int = 0


@dataclass(frozen=True)
class MeshRecords(StudyRecords):
    """All measurements of one run: a table a pair and quantity, times as ratios to the direct formula."""

    rows: Sequence[MeshRecord]


def meshes(quick: bool = False) -> MeshRecords:
    """Measure all methods on all pairs (`quick`: two pairs, fewer angles)."""
    return MeshRecords("Triangular teeth: error against run time", taken(_steps(quick)))


def _step(pair: _Pair, method: str, quantity: str, task: Task | None = None) -> Step:
    """One measurement: building by a method (`task`), or what was built asked for a quantity at all angles."""

    def built() -> list[MeshRecord]:
        assert task is not None
        _ = pair.sizes, pair.name.startswith("growth") or pair.truth  # made before the processes part
        return [MeshRecord(pair.name, pair.tooth_pairs, method, *measure(task), quantity)]

    def requested() -> list[MeshRecord]:
        function = pair.function(method, quantity)
        error = pair.error_of(quantity, function)
        cost = measure(partial(function, pair.S), lambda _: error)
        note = cost.note
        if isinstance(function, CellTable):
            note = f"{note or f'{function.cells} cells'}, {function.coefficients.nbytes / 1024:.3g} KB"
        return [MeshRecord(pair.name, pair.tooth_pairs, method, *cost[:3], note, quantity, pair.angles)]

    return f"{pair.name}: {method}, {quantity}", requested if task is None else built


def _steps(quick: bool) -> Iterator[Step]:
    angles = 50_000 if quick else 200_000
    for z1, z2, beta, excess in (_PAIRS[0], _PAIRS[3]) if quick else _PAIRS:
        yield from _of_a_pair(_Pair(z1, z2, beta, excess, angles), _SAMPLES[:2] if quick else _SAMPLES)
    for z in () if quick else _GROWTH:
        pair = _Pair(z, z, 30.0, None, angles, "growth ", 1 / 2)
        yield _step(pair, DIRECT, "path", partial(pair.build, DIRECT))


def _of_a_pair(pair: _Pair, samples: Sequence[int]) -> Iterator[Step]:
    """Building, then evaluating, by every method."""
    sampled = [f"sampled, {count}" for count in samples]
    methods = (DIRECT, *sampled, TABULATED)
    for method in methods:
        yield _step(pair, method, "path", partial(pair.build, method))
    for quantity in QUANTITIES:
        for method in methods:
            yield _step(pair, method, quantity)


def _table(transmission: TriangularTransmission, quantity: str) -> CellTable:
    """A table of a quantity to 1e-12 of a pitch, or of the mean speed ratio."""
    scale = 1e-12 * float(transmission.ratio) * (transmission.pitch if quantity == "error" else 1.0)
    return fit(getattr(transmission, quantity), transmission.period, folded_kinks(transmission), scale)


class _Pair:
    """A pair of wheels, the angles at which it is measured, and all its methods, each made once."""

    def __init__(
        self,
        z1: int,
        z2: int,
        beta: float,
        excess: float | None,
        angles: int,
        prefix: str = "",
        fraction: float = 1 / 3,
    ) -> None:
        self.given, self.angles, self.name = (z1, z2, radians(beta), excess), angles, f"{prefix}{z1}/{z2}"
        self.fraction, self._requested = fraction, 0
        self._built: dict[str, Any] = {}

    @cached_property
    def sizes(self) -> TriangularSizes:
        z1, z2, beta, excess = self.given
        sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, 0.0)
        return sizes.at(find_window(sizes).at(self.fraction) if excess is None else excess)

    @property
    def tooth_pairs(self) -> int:
        return int(2 * self.sizes.reach1 / self.sizes.p1) + 1

    @cached_property
    def transmission(self) -> TriangularTransmission:
        return plain_transmission(self.sizes)

    def _fresh(self) -> TriangularSizes:
        """The same pair a little larger than ever before: what was worked out for it is not remembered."""
        self._requested += 1
        scale = 1 + 1e-9 * self._requested
        return replace(self.sizes, R1=self.sizes.R1 * scale, R2=self.sizes.R2 * scale)

    def build(self, method: str) -> Any:
        """What answers by this method, from the sizes alone."""
        sizes = self._fresh()
        transmission = plain_transmission(sizes)
        name, _, count = method.partition(", ")
        if name == "sampled":
            return Sampled(sizes, int(count))
        _ = transmission.intervals
        if name == DIRECT:
            return transmission
        return _table(transmission, "error")

    def function(self, method: str, quantity: str) -> Function:
        """A quantity by this method, built before it is measured."""
        if method not in self._built:
            self._built[method] = self.build(method)
        built = self._built[method]
        if method == TABULATED:
            return built if quantity == "error" else _table(self.transmission, quantity)
        found: Function = getattr(built, quantity)
        return found

    @cached_property
    def S(self) -> Floats:
        """Driver angles over ten turns, at random."""
        return np.random.default_rng(1).uniform(0, 20 * np.pi, self.angles)

    @cached_property
    def checks(self) -> Floats:
        """Driver angles in one pitch where errors are judged: at random, and crowding towards every corner."""
        pitch = self.sizes.p1
        near = pitch * np.geomspace(10 * _MARGIN, 0.1, 30)
        points = [np.random.default_rng(2).uniform(0, pitch, 100)]
        points += [kink + side * near for kink in self.transmission.kinks() for side in (-1, 1)]
        return np.mod(np.concatenate(points), pitch)

    @cached_property
    def truth(self) -> tuple[Floats, Floats]:
        return reference(self.sizes, self.checks)

    def error_of(self, quantity: str, function: Function) -> float:
        """Maximum true error: in driven pitches, or relative to the mean ratio."""
        truth = self.truth[QUANTITIES.index(quantity)]
        scale = self.sizes.p2 if quantity == "error" else self.sizes.ratio
        return float(np.max(np.abs(function(self.checks) - truth))) / scale
