"""Every way to the transmission law of triangular teeth: cost, memory and true error, as ratios to the direct formula.

Direct is `TriangularLaw`: few candidates, switching points as roots, then one formula an angle. Its alternatives: the
envelope of all couples sampled and interpolated; switching points found by scanning all couples; the law tabulated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from importlib import import_module
from importlib.util import find_spec
from math import ceil, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.bench.record import Record, Records, measure
from geartrain.teeth.table import DEGREE, Table, Tabulated
from geartrain.teeth.triangular.contact import APPROACH, RECESS, Couple
from geartrain.teeth.triangular.law import TriangularLaw
from geartrain.teeth.triangular.meshing import Window, find_window
from geartrain.teeth.triangular.path import Interval
from geartrain.teeth.triangular.sizes import Sizes, equal_depth

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]
Task = Callable[[], Any]
Advance = Callable[[str], None]

DIRECT, SCANNED, TABULATED = "direct", "scan of all couples", "tabulated"
QUANTITIES = ("error", "speed", "efficiency")
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
_CELLS = (2, 4, 8, 16, 64, 256)
_SCAN = 128  # positions in a pitch at which the scan asks who drives
_MARGIN = 1e-10  # of a pitch about a switching point, where rounding decides who drives


@dataclass(frozen=True, slots=True)
class MeshRecord(Record):
    """A record whose `links` counts the couples of teeth within reach, with what was asked for and at how many angles.

    The error is in pitches of the driven wheel for the quantity "error", relative to the mean ratio for "speed".
    """

    quantity: str = ""
    angles: int = 0


@dataclass(frozen=True, slots=True)
class MeshRecords(Records):
    """All measurements of one run: a table a pair, times as ratios to the direct formula."""

    rows: Sequence[MeshRecord]

    def to_markdown(self) -> str:
        """One table for each pair and quantity."""
        lines = [f"# {self.title}", ""]
        for family, links in dict.fromkeys((row.family, row.links) for row in self.rows):
            lines += [f"## {family}, {links} couples in reach", ""]
            group = [row for row in self.rows if row.family == family]
            for quantity in dict.fromkeys(row.quantity for row in group):
                lines += _table(quantity, [row for row in group if row.quantity == quantity])
        return "\n".join(lines)


def _table(quantity: str, rows: list[MeshRecord]) -> list[str]:
    base = next((row.seconds for row in rows if row.method == DIRECT and row.seconds), None)
    each = any(row.angles for row in rows)
    head = f"| {quantity} | {'angles/s' if each else 'time'} | time over direct | memory | true error | |"
    lines = [head, "|---|---|---|---|---|---|"]
    for row in rows:
        ratio = f"{row.seconds / base:.3g}" if row.seconds and base else "-"
        memory = "-" if row.megabytes is None else f"{row.megabytes:.0f} MB"
        error = "-" if row.error is None else f"{row.error:.1e}"
        lines.append(f"| {row.method} | {_cost(row)} | {ratio} | {memory} | {error} | {row.note} |")
    return [*lines, ""]


def _cost(row: MeshRecord) -> str:
    if row.seconds is None:
        return "-"
    return f"{row.angles / row.seconds:.2g}" if row.angles else f"{row.seconds * 1e3:.3g} ms"


def mesh(quick: bool = False, advance: Advance = lambda _: None) -> MeshRecords:
    """Measure all methods on all pairs (`quick`: two pairs, fewer angles); `advance` hears of every step."""
    rows = []
    for step in _steps(quick):
        advance(f"{step.pair.name}: {step.method}, {step.quantity}")
        rows.append(step.run())
    return MeshRecords("Triangular teeth: error against run time", rows)


def count_mesh_steps(quick: bool = False) -> int:
    """How many steps `mesh` will tell of."""
    return sum(1 for _ in _steps(quick))


@dataclass(frozen=True, slots=True)
class _Step:
    """One measurement: building by a method (`task`), or what was built asked for a quantity at all angles."""

    pair: _Pair
    method: str
    quantity: str
    task: Task | None = None

    def run(self) -> MeshRecord:
        pair, task, function = self.pair, self.task, None
        if task is None:
            function = pair.function(self.method, self.quantity)
            task = partial(function, pair.S)
        _ = pair.sizes, pair.name.startswith("growth") or pair.truth  # made before the processes part
        error = None if function is None else pair.error_of(self.quantity, function)
        found = measure(pair.name, pair.couples, self.method, task, lambda _: error)
        plain = {field.name: getattr(found, field.name) for field in fields(Record)}
        plain["note"] = found.note or (f"{function.cells} cells" if isinstance(function, Table) else "")
        if isinstance(function, Table):
            plain["note"] += f", {function.nbytes / 1024:.3g} KB"
        return MeshRecord(**plain, quantity=self.quantity, angles=0 if function is None else pair.angles)


def _steps(quick: bool) -> Iterator[_Step]:
    angles = 50_000 if quick else 200_000
    for z1, z2, beta, excess in (_PAIRS[0], _PAIRS[3]) if quick else _PAIRS:
        yield from _of_a_pair(_Pair(z1, z2, beta, excess, angles), _SAMPLES[:2] if quick else _SAMPLES)
    for z in () if quick else _GROWTH:
        pair = _Pair(z, z, 30.0, None, angles, "growth ", 1 / 2)
        for method in (DIRECT, SCANNED, "sampled, 1000"):
            yield _Step(pair, method, "path", partial(pair.build, method))
        yield _Step(pair, DIRECT, "window", pair.window)


def _of_a_pair(pair: _Pair, samples: Sequence[int]) -> Iterator[_Step]:
    """Building, then evaluating, by every method."""
    sampled = [f"sampled, {count}" for count in samples]
    coarse = [f"tabulated, {count} cells" for count in _CELLS]
    for method in (DIRECT, SCANNED, *sampled, TABULATED, *coarse):
        yield _Step(pair, method, "path", partial(pair.build, method))
    yield _Step(pair, DIRECT, "path, verdict", lambda: _law(pair.sizes).verdict)
    yield _Step(pair, DIRECT, "window", pair.window)
    for quantity in QUANTITIES:
        few = [] if quantity == "efficiency" else sampled
        for method in (DIRECT, SCANNED, *few, TABULATED, *(coarse if quantity == "error" else [])):
            yield _Step(pair, method, quantity)


def _law(sizes: Sizes) -> TriangularLaw:
    return TriangularLaw(sizes, friction=0.2)


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
        self.fraction, self._windows = fraction, 0
        self._built: dict[str, Any] = {}

    @cached_property
    def sizes(self) -> Sizes:
        z1, z2, beta, excess = self.given
        sizes = Sizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, 0.0)
        return sizes.at(find_window(sizes).at(self.fraction) if excess is None else excess)

    @property
    def couples(self) -> int:
        return int(2 * self.sizes.reach1 / self.sizes.p1) + 1

    @cached_property
    def law(self) -> TriangularLaw:
        return _law(self.sizes)

    def window(self) -> Window:
        """The window of clearance of the same pair, each time a little larger, so that none is remembered."""
        self._windows += 1
        sizes, scale = self.sizes, 1 + 1e-9 * self._windows
        return find_window(replace(sizes, R1=sizes.R1 * scale, R2=sizes.R2 * scale))

    def build(self, method: str) -> Any:
        """What answers by this method, from the sizes alone."""
        law = _law(self.sizes)
        name, _, count = method.partition(", ")
        if name == SCANNED:
            return scanned(self.sizes)
        if name == "sampled":
            return Sampled(self.sizes, int(count))
        _ = law.intervals
        if name == DIRECT:
            return law
        if count:
            return _Coarse(law, int(count.removesuffix(" cells")))
        table = Tabulated(law)
        _ = table.error_table
        return table

    def function(self, method: str, quantity: str) -> Function:
        """A quantity by this method, built before it is measured."""
        if method not in self._built:
            self._built[method] = self.build(method)
        built = self._built[method]
        found: Function = getattr(built, f"{quantity}_table" if method == TABULATED else quantity)
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
        points += [corner + side * near for corner in self.law.corners() for side in (-1, 1)]
        return np.mod(np.concatenate(points), pitch)

    @cached_property
    def truth(self) -> tuple[Floats, Floats]:
        return reference(self.sizes, self.checks)

    def error_of(self, quantity: str, function: Function) -> float | None:
        """Greatest true error: in driven pitches, or relative to the mean ratio; none for the efficiency."""
        if quantity == "efficiency":
            return None
        truth = self.truth[QUANTITIES.index(quantity)]
        scale = self.sizes.p2 if quantity == "error" else self.sizes.ratio
        return float(np.max(np.abs(function(self.checks) - truth))) / scale


class _Coarse:
    """The error alone, on as many cells as asked for."""

    def __init__(self, law: TriangularLaw, cells: int) -> None:
        self.error = Table(law.error, law.period, np.unique(np.mod(law.corners(), law.period)), cells, DEGREE)


# ------------------------------------------------------------------------------------------------------- alternatives


class Sampled:
    """The envelope of all couples at `count` positions of a pitch, the driven wheel dragged, and linear between."""

    def __init__(self, sizes: Sizes, count: int) -> None:
        self.ratio, self.pitch = sizes.ratio, sizes.p1
        self.grid: Floats = np.arange(count + 1.0) * (sizes.p1 / count)
        lowest = lowest_of_all(sizes, -self.grid[:-1])
        dragged = np.minimum.accumulate(np.concatenate((lowest + sizes.p2, lowest)))[count:]
        errors = -dragged - sizes.ratio * self.grid[:-1]
        self.errors = np.append(errors, errors[0])
        around = np.concatenate((errors[-1:], self.errors, errors[1:2]))
        self.speeds = sizes.ratio + (around[2:] - around[:-2]) * (count / (2 * sizes.p1))

    def error(self, S: Floats) -> Floats:
        """Transmission error (rad of the driven wheel)."""
        return np.asarray(np.interp(np.mod(S, self.pitch), self.grid, self.errors), dtype=float)

    def speed(self, S: Floats) -> Floats:
        """Speed ratio, from central differences."""
        return np.asarray(np.interp(np.mod(S, self.pitch), self.grid, self.speeds), dtype=float)


def lowest_of_all(sizes: Sizes, t: Floats) -> Floats:
    """U(t): the least driven angle over all couples in reach at driver positions t (rad); infinite where none is."""
    couple, reach = Couple(sizes), sizes.reach1
    lowest = np.full(t.shape, np.inf)
    for k in range(ceil((-reach - t.max()) / sizes.p1), int((reach - t.min()) // sizes.p1) + 1):
        x = t + k * sizes.p1
        inside = np.flatnonzero(np.abs(x) <= reach)
        y = np.fmin(couple.approach_angle(x[inside], np), couple.recess_angle(x[inside], np)) - k * sizes.p2
        lowest[inside] = np.minimum(lowest[inside], y)
    return lowest


Driver = tuple[int, str] | None


def scanned(sizes: Sizes) -> TriangularLaw:
    """The law on switching points found by a scan of all couples."""
    law = _law(sizes)
    vars(law.contact.path)["envelope"] = _Scan(sizes).envelope()
    _ = law.intervals
    return law


class _Scan:
    """Switching points where the lowest of all couples changes, by halving; what is shorter than a scan is missed."""

    def __init__(self, sizes: Sizes) -> None:
        self.sizes, self.couple = sizes, Couple(sizes)
        reach = int(sizes.reach1 // sizes.p1) + 2
        self.numbers = np.arange(-reach, reach + 2)

    def driver(self, t: float) -> Driver:
        """The couple and phase that are lowest at position t."""
        x = t + self.numbers * self.sizes.p1
        inside = np.abs(x) <= self.sizes.reach1
        if not inside.any():
            return None
        k, x = self.numbers[inside], x[inside]
        both = [
            self.couple.approach_angle(x, np) - k * self.sizes.p2,
            self.couple.recess_angle(x, np) - k * self.sizes.p2,
        ]
        at = int(np.nanargmin(np.fmin(*both)))
        return int(k[at]), APPROACH if both[0][at] < both[1][at] else RECESS

    def envelope(self) -> list[Interval]:
        """Who drives over one pitch, beginning at a switching point."""
        positions = -self.sizes.p1 * np.arange(_SCAN + 1) / _SCAN
        drivers = [self.driver(float(t)) for t in positions]
        switches: list[tuple[float, Driver]] = []
        for at in range(_SCAN):
            t, here = float(positions[at]), drivers[at]
            while here != drivers[at + 1]:
                t = self._switch(t, float(positions[at + 1]), here)
                here = self.driver(t)
                switches.append((t, here))
        found = []
        ends = [t for t, _ in switches[1:]] + [switches[0][0] - self.sizes.p1]
        for (start, driver), end in zip(switches, ends, strict=True):
            if driver is not None:
                shift = driver[0] * self.sizes.p1
                found.append(Interval(driver[1], start + shift, end + shift, driver[0]))
        return found

    def _switch(self, t: float, end: float, here: Driver) -> float:
        """The first position after t that `here` does not drive."""
        while end < (middle := end + (t - end) / 2) < t:
            t, end = (middle, end) if self.driver(middle) == here else (t, middle)
        return end


# ---------------------------------------------------------------------------------------------------------- reference


def reference(sizes: Sizes, S: Floats) -> tuple[Floats, Floats]:
    """Transmission error (rad) and speed ratio at driver angles S in the first pitch, from the law's definition.

    Contact of one couple from the two lines of flanks, every couple in reach asked, 40 digits if mpmath is installed,
    else the longest floats there are. Teeth past their reach hold the driven wheel where they left it.
    """
    real: Any = Multiple() if find_spec("mpmath") else Long()
    exact = Exact(sizes, real)
    answers = [exact.at(float(each)) for each in S]
    return np.array([error for error, _ in answers]), np.array([speed for _, speed in answers])


class Multiple:
    """40-digit arithmetic."""

    def __init__(self) -> None:
        context = import_module("mpmath").mp.clone()
        context.dps = 40
        self.number, self.pi = context.mpf, +context.pi
        self.sin, self.cos, self.asin, self.acos = context.sin, context.cos, context.asin, context.acos
        self.atan2, self.sqrt = context.atan2, context.sqrt


class Long:
    """The longest floats of the machine: 64 bits of mantissa on most."""

    def __init__(self) -> None:
        self.number = np.longdouble
        self.pi = 4 * np.arctan(np.longdouble(1))
        self.sin, self.cos, self.asin, self.acos = np.sin, np.cos, np.arcsin, np.arccos
        self.atan2, self.sqrt = np.arctan2, np.sqrt


class Exact:
    """The definition of the law, in whatever numbers `real` has, written as in a textbook: many digits may cancel."""

    def __init__(self, sizes: Sizes, real: Any) -> None:
        self.m, self.sizes = real, sizes
        self.R1, self.R2, self.b1, self.b2, excess = (
            real.number(x) for x in (sizes.R1, sizes.R2, sizes.beta1, sizes.beta2, sizes.excess)
        )
        self.p1, self.p2 = 2 * real.pi / sizes.z1, 2 * real.pi / sizes.z2
        least = self.R1 + self.R2 - min(self._depth(self.R1, self.p1, self.b1), self._depth(self.R2, self.p2, self.b2))
        self.D = (1 + excess) * least
        self.reach = real.acos((self.D**2 + self.R1**2 - self.R2**2) / (2 * self.D * self.R1))
        self.couple = Couple(sizes)

    def _depth(self, R: Any, pitch: Any, b: Any) -> Any:
        """The bottom of a space is where the flanks of two neighbouring teeth meet."""
        return R - R * self.m.sin(b) / self.m.sin(b + pitch / 2)

    def at(self, S: float) -> tuple[float, float]:
        """Error and speed ratio at driver angle S in the first pitch."""
        t = -self.m.number(S)
        y, speed = min(self._couple(t, k) for k in self._candidates(S))
        return float(-y + t * self.sizes.z1 / self.sizes.z2), float(speed)

    def _candidates(self, S: float) -> list[int]:
        """All couples in reach and the last to leave it, less those that floats show to be far from driving."""
        numbers = np.arange(
            ceil((S - float(self.reach)) / self.sizes.p1) - 2, (S + float(self.reach)) // self.sizes.p1 + 1
        )
        x = np.clip(numbers * self.sizes.p1 - S, -self.sizes.reach1, self.sizes.reach1)
        y = np.fmin(self.couple.approach_angle(x, np), self.couple.recess_angle(x, np)) - numbers * self.sizes.p2
        return [int(k) for k in numbers[y < y.min() + 1e-3 * self.sizes.p2]]

    def _couple(self, t: Any, k: int) -> tuple[Any, Any]:
        """Driven angle and speed ratio if couple k drove at position t."""
        x = t + k * self.p1
        if x > self.reach:
            return self.m.number(1e9), x
        if x < -self.reach:
            return min(self._approach(-self.reach), self._recess(-self.reach))[0] - k * self.p2, self.m.number(0)
        y, speed = min(self._approach(x), self._recess(x))
        return y - k * self.p2, speed

    def _approach(self, x: Any) -> tuple[Any, Any]:
        """R2 sin(psi + y) = D sin psi - R1 sin beta1: the driven apex on the driver's flank; and dy/dx."""
        psi = x + self.b1
        sine = (self.D * self.m.sin(psi) - self.R1 * self.m.sin(self.b1)) / self.R2
        return self.m.asin(sine) - psi, self.D * self.m.cos(psi) / (self.R2 * self.m.sqrt(1 - sine**2)) - 1

    def _recess(self, x: Any) -> tuple[Any, Any]:
        """D sin psi - R1 sin(psi - x) = R2 sin beta2, psi = beta2 - y: the driver's apex on the driven flank."""
        m = self.m
        along, across = self.D - self.R1 * m.cos(x), self.R1 * m.sin(x)
        psi = m.asin(self.R2 * m.sin(self.b2) / m.sqrt(along**2 + across**2)) - m.atan2(across, along)
        turned = self.R1 * m.cos(psi - x)
        return self.b2 - psi, turned / (self.D * m.cos(psi) - turned)
