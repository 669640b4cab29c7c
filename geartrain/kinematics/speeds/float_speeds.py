"""Float64 speeds through a sparse LU, one refinement step with a doubly exact residual, and their error.

The rows are integers, so the residual of a float solution can be had to twice the working precision by error-free
products and sums; one step with it leaves every component within a rounding or two (docs/accuracy.md).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.speeds.scaling import find_exponents
from geartrain.kinematics.willis_system import WillisEquation, WillisSystem
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import PRIME, as_float, eliminate, residues
from geartrain.numerics.labelled_array import LabelledArray, labelled_array
from geartrain.numerics.long_float import HIGHEST, LOWEST, Real, scaled

Floats = NDArray[np.float64]
_UNIT_ROUNDOFF = 2.0**-53
_GIVEN = -1  # the column of what is prescribed
_INVERTED, _ABREAST = 400, 64  # links up to which the inverse is made, and columns of it at a time
_DRAWN = 12  # sets of signs beyond
_ORDINARY = 400  # powers of two up to which speeds are solved as they are
_LOW = 1e-200  # entries of a scaled row below this are dropped


@dataclass(frozen=True, slots=True)
class FloatSpeeds(FrozenFields):
    """Float64 speeds with an estimate of their error.

    speeds     (link, case) in the train's unit, to be multiplied by 2**exponents
    estimate   (link, case) absolute error to expect of each speed, to be multiplied by 2**exponents too
    condition  link -> component-wise condition number cond(A, x) of the first case, where asked for
    exponents  (link, case) 0 wherever float64 holds the speed and its estimate
    """

    speeds: LabelledArray
    estimate: LabelledArray
    condition: Mapping[str, float]
    exponents: LabelledArray

    def __getitem__(self, link: str) -> float:
        speed = self.number(link)
        if isinstance(speed, float):
            return speed
        what = f"the speed of '{link}' is {speed}, beyond the range of float64"
        fix = f"read `speeds` times 2 to the power of `exponents`, or `decimal('{link}')`"
        raise RangeError(Problem(what, "a float holds 1e-308 to 1e308", fix))

    def number(self, link: str, case: int = 0) -> Real:
        """The speed of a link, as a float where one holds it."""
        return scaled(float(self.speeds[link][case]), int(self.exponents[link][case]))

    def decimal(self, link: str, case: int = 0, digits: int = 10) -> str:
        """The speed of a link in decimal, of any size."""
        return f"{self.number(link, case):.{digits}g}"


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what leaves the range is scaled, or refused below
def solve_floats(
    system: WillisSystem,
    redundant: Sequence[str] = (),
    inputs: Mapping[str, Sequence[float]] | None = None,
    condition_of: Sequence[str] = (),
    ordering: str = "COLAMD",
    refine: bool = True,
) -> FloatSpeeds:
    """Solve a determined Willis system in float64.

    redundant     labels of circuits known to add nothing (loops that close); they are left out
    inputs        link -> speeds, one a case, for every input of the system: one factorisation serves all
    condition_of  links whose component-wise condition is wanted, one transposed solve each
    ordering      column ordering of the factorisation; COLAMD is the one that never turns quadratic
    refine        one refinement step (else the raw LU, for comparison)

    Where speeds leave the range of float64 each case is solved with a power of two of its own for every link.
    Raises `RangeError` where the system is not square and regular, or where that does not bring it within the range
    either: a silent 0 is never returned.
    """
    frame, matrix, rows = prepare(system, redundant)
    given = _given(rows, inputs)
    x, estimate, exponents, condition = _solve_any(matrix, rows, given, _Way(ordering, refine, condition_of))
    return FloatSpeeds(
        _with_frame(system, frame, x),
        _with_frame(system, frame, estimate),
        condition,
        _with_frame(system, frame, exponents),
    )


class _Way(NamedTuple):
    """How to solve, as `solve_floats` is told."""

    ordering: str
    refine: bool
    condition_of: Sequence[str]


def _solve_any(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> tuple[Floats, Floats, NDArray[np.int64], dict[str, float]]:
    """Speeds and estimates over powers of two, those powers, and conditions; ordinary trains need no powers."""
    near = None
    with suppress(RangeError):
        near = _solve(matrix, rows, given, way)
    if near is not None and _is_ordinary(near[0]):
        return near[0], near[1], np.zeros(near[0].shape, dtype=np.int64), near[2]
    cases = [_solve_far(matrix, rows, [line[at : at + 1] for line in given], way) for at in range(len(given[0]))]
    x, estimate, exponents, conditions = zip(*cases, strict=True)
    return np.hstack(x), np.hstack(estimate), np.hstack(exponents), conditions[0]


def _is_ordinary(x: Floats) -> bool:
    """True if no speed is so large or small that its errors, or their squares in `_reach`, leave float64."""
    sizes = np.frexp(x)[1]
    return bool(((x == 0) | (np.abs(sizes) <= _ORDINARY)).all())


def _solve(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> tuple[Floats, Floats, dict[str, float]]:
    """Speeds, estimates and conditions; `RangeError` where float64 does not hold them."""
    right, remainder = _right_sides(rows, given)
    try:
        lu = matrix.factorise(way.ordering)
    except RuntimeError as error:
        raise RangeError(_no_factors(len(rows), str(error))) from None
    x = lu.solve(right)
    if way.refine:
        x = x + lu.solve(matrix.residual(x, right, remainder))
        matrix.prescribe(x, right)
    rest = matrix.residual(x, right, remainder)
    _check_range(matrix, x, rest, rows)
    left = lu.solve(rest)
    more = lu.solve(matrix.residual(left, rest, np.zeros_like(rest)))
    # what is left, the rounding of x itself, and what residuals in twice the precision and the last solution may hide
    hidden = 16 * _UNIT_ROUNDOFF**2 * matrix.size(x) + 16 * _UNIT_ROUNDOFF * matrix.size(more) + matrix.sunk(x)
    estimate = 2 * (np.abs(left) + np.abs(more)) + _UNIT_ROUNDOFF * np.abs(x) + _reach(lu, hidden)
    return x, estimate, {link: matrix.condition(lu, link, x[:, 0]) for link in way.condition_of}


def _solve_far(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> tuple[Floats, Floats, NDArray[np.int64], dict[str, float]]:
    """One case, in speeds over powers of two: scaling by them rounds nothing, so all is as good as near 1."""
    exponents = np.array(find_exponents(rows, [right for (right,) in given], list(matrix.at)), dtype=np.int64)
    near, shifts = matrix.scaled(exponents)
    moved = [[right * Fraction(2) ** -shift] for (right,), shift in zip(given, shifts.tolist(), strict=True)]
    x, estimate, condition = _solve(near, rows, moved, way)
    powers = exponents[:, None]
    held = _held(x, powers) & _held(estimate, powers)
    folded = np.where(held, powers, 0).astype(np.intc)
    return np.ldexp(x, folded), np.ldexp(estimate, folded), np.where(held, 0, powers), condition


def _held(values: Floats, powers: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Where values times powers of two are 0 or within float64 with all their bits."""
    sizes = np.frexp(values)[1] + powers
    held: NDArray[np.bool_] = (values == 0) | ((sizes >= LOWEST) & (sizes <= HIGHEST))
    return held


def _reach(lu: Any, error: Floats) -> Floats:
    """How far errors in the equations, of any sign, may move each speed: |A^-1| error.

    A solution for one set of signs may cancel to 0 where another does not. The inverse is made column by column up to
    some hundred links; beyond, the root mean square over random signs and sizes stands for it, four times over.
    """
    found = np.zeros_like(error)
    size, cases = error.shape
    if size <= _INVERTED:
        for start in range(0, size, _ABREAST):
            columns = np.arange(start, min(start + _ABREAST, size))
            units = np.zeros((size, len(columns)))
            units[columns, np.arange(len(columns))] = 1.0
            found += np.abs(lu.solve(units)) @ error[columns]
        return found
    draw = np.random.default_rng(size)
    for case in range(cases):
        signs = draw.choice([-1.0, 1.0], (size, _DRAWN)) * draw.uniform(0.5, 1.5, (size, _DRAWN))
        found[:, case] = 4 * np.sqrt((lu.solve(signs * error[:, case, None]) ** 2).mean(axis=1))
    return found


def prepare(system: WillisSystem, redundant: Sequence[str] = ()) -> tuple[str, PaddedRows, list[WillisEquation]]:
    """The frame, and as many independent rows as there are moving links, ready to be factorised."""
    frame = next(row.terms[0][0] for row in system.equations if row.kind == "frame")
    links = [link for link in system.links if link != frame]
    rows = _independent(system, links, set(redundant))
    return frame, PaddedRows(links, rows), rows


def _with_frame(system: WillisSystem, frame: str, values: NDArray[Any]) -> LabelledArray:
    """One row a link in the order declared, the frame's being 0."""
    at = system.links.index(frame)
    return labelled_array(
        np.insert(values, at, 0, axis=0),
        link=system.links,
        case=[str(case) for case in range(values.shape[1])],
    )


def _independent(system: WillisSystem, links: Sequence[str], redundant: set[str]) -> list[WillisEquation]:
    """The rows without the frame's and those that add nothing; as many as there are moving links, or a `RangeError`."""
    rows = [
        row
        for row in system.equations
        if row.kind in ("input", "fixed", "lock") or (row.kind != "frame" and row.label not in redundant)
    ]
    if len(rows) > len(links):
        at = {link: column for column, link in enumerate(links)}
        forms = [
            residues({at[link]: Fraction(c) for link, c in row.terms if link in at} | {_GIVEN: -row.right})
            for row in rows
        ]
        echelon = eliminate(forms, modulus=PRIME)
        if echelon.conditions:
            raise RangeError(
                Problem(
                    "the prescribed speeds contradict each other",
                    "no speeds satisfy all equations",
                    "ask for the verdict",
                )
            )
        idle = set(echelon.redundant)
        rows = [row for position, row in enumerate(rows) if position not in idle]
    if len(rows) != len(links):
        raise RangeError(
            Problem(
                f"{len(rows)} independent equations for {len(links)} moving links",
                "a train that is free, locked or contradictory has no float solution",
                "ask for the exact verdict first",
            )
        )
    return rows


def _given(rows: Sequence[WillisEquation], inputs: Mapping[str, Sequence[float]] | None) -> list[list[Fraction]]:
    """The right-hand side of every row, one number a case."""
    cases = len(next(iter(inputs.values()))) if inputs else 1
    return [
        [Fraction(value) for value in inputs[row.terms[0][0]]]
        if inputs is not None and row.kind == "input"
        else [row.right] * cases
        for row in rows
    ]


def _right_sides(rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]]) -> tuple[Floats, Floats]:
    """Right-hand sides as float plus the exact remainder that the float leaves."""
    right = np.zeros((len(rows), len(given[0])))
    remainder = np.zeros_like(right)
    for at, line in enumerate(given):
        if not any(line):
            continue
        nearest = [as_float(value) for value in line]
        if None in nearest:
            raise RangeError(_out_of_range(rows[at].label))
        right[at] = nearest
        remainder[at] = [float(value - Fraction(near)) for value, near in zip(line, right[at].tolist(), strict=True)]
    return right, remainder


class PaddedRows:
    """The integer rows as arrays, padded to a common number of terms."""

    def __init__(self, links: Sequence[str], rows: Sequence[WillisEquation]) -> None:
        self.at = {link: column for column, link in enumerate(links)}
        width = max(len(row.terms) for row in rows)
        self.columns = np.zeros((len(rows), width), dtype=np.intc)
        self.coefficients = np.zeros((len(rows), width))
        for at, row in enumerate(rows):
            for position, (link, coefficient) in enumerate(term for term in row.terms if term[0] in self.at):
                self.columns[at, position] = self.at[link]
                self.coefficients[at, position] = coefficient
        self.low = np.zeros_like(self.coefficients, dtype=bool)

    def scaled(self, exponents: NDArray[np.int64]) -> tuple[PaddedRows, NDArray[np.int64]]:
        """The rows in speeds over powers of two, and the power by which each was divided: entries of 1 to 2 lead.

        All these scalings are exact. Entries that sink below 1e-200 of their row are dropped: no rounding is moved by
        them, and their products would lose the bits that residuals are made of. What they may do is in `sunk`.
        """
        sizes = np.frexp(self.coefficients)[1] + exponents[self.columns]
        shifts = np.where(self.coefficients != 0, sizes, np.iinfo(np.int64).min).max(axis=1) - 1
        moved = np.clip(exponents[self.columns] - shifts[:, None], -2000, 2000).astype(np.intc)
        near = copy(self)
        near.coefficients = np.ldexp(self.coefficients, moved)
        near.low = (self.coefficients != 0) & (np.abs(near.coefficients) < _LOW)
        near.coefficients[near.low] = 0.0
        return near, shifts

    def matrix(self) -> Any:
        """The rows as a sparse matrix, column compressed."""
        from scipy.sparse import csc_array

        size, width = self.columns.shape
        lines = np.repeat(np.arange(size, dtype=np.intc), width)
        used = self.coefficients.ravel() != 0
        entries = (self.coefficients.ravel()[used], (lines[used], self.columns.ravel()[used]))
        return csc_array(entries, shape=(size, size))

    def factorise(self, ordering: str) -> Any:
        """The sparse LU factors."""
        from scipy.sparse import linalg

        solver: Any = linalg
        return solver.splu(self.matrix(), permc_spec=ordering)

    def residual(self, x: Floats, right: Floats, remainder: Floats) -> Floats:
        """right - A x, accumulated to twice the working precision."""
        total, low = right.copy(), remainder.copy()
        for position in range(self.columns.shape[1]):
            product, error = _two_product(-self.coefficients[:, position, None], x[self.columns[:, position]])
            total, carry = _two_sum(total, product)
            low = low + carry + error
        return total + low

    def prescribe(self, x: Floats, right: Floats) -> None:
        """Links whose row is their own speed get it to the last bit."""
        single = np.flatnonzero((self.coefficients != 0).sum(axis=1) == 1)
        own = self.coefficients[single, 0] == 1
        x[self.columns[single[own], 0]] = right[single[own]]

    def size(self, x: Floats) -> Floats:
        """|A| |x|, row by row."""
        total: Floats = np.einsum("rt,rtc->rc", np.abs(self.coefficients), np.abs(x[self.columns]))
        return total

    def sunk(self, x: Floats) -> Floats:
        """The most that dropped entries come to, row by row."""
        total: Floats = np.einsum("rt,rtc->rc", _LOW * self.low, np.abs(x[self.columns]))
        return total

    def condition(self, lu: Any, link: str, x: Floats) -> float:
        """cond(A, x) of one link: one transposed solve, (|y|, |A||x|) / |x_link|."""
        column = self.at[link]
        unit = np.zeros(len(x))
        unit[column] = 1.0
        y = lu.solve(unit, trans="T")
        total = float(np.abs(y) @ self.size(x[:, None])[:, 0])
        return total / abs(float(x[column])) if x[column] else float("inf")


def _two_sum(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """a + b = s + e exactly (Knuth)."""
    s = a + b
    part = s - a
    return s, (a - (s - part)) + (b - part)


def _two_product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """a b = p + e exactly, barring underflow (Dekker)."""
    p = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def _split(a: Floats) -> tuple[Floats, Floats]:
    big = 134217729.0 * a  # 2^27 + 1
    high = big - (big - a)
    return high, a - high


def _check_range(matrix: PaddedRows, x: Floats, rest: Floats, rows: Sequence[WillisEquation]) -> None:
    """Refuse a solution that overflowed, or sank below what float64 can hold on its way along the train.

    One mesh changes a speed by a factor of 1e12 at most, so a speed that sank to 0 left others near the edge.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        size = matrix.size(x)
        lost = (size < 1e-250) & (np.abs(rest) > 1e-8 * size)
        wrong = ~(
            np.abs(rest) <= 1e-6 * np.maximum(size, np.abs(matrix.coefficients).sum(axis=1)[:, None] * np.abs(x).max())
        )
    sunk = ((x != 0) & (np.abs(x) < 1e-280))[matrix.columns].any(axis=1) & (matrix.coefficients != 0).any(axis=1)[
        :, None
    ]
    bad = (lost | wrong | sunk).any(axis=1)
    if bad.any():
        raise RangeError(_out_of_range(rows[int(np.argmax(bad))].label))


def _out_of_range(label: str) -> Problem:
    return Problem(
        f"a speed leaves the range of float64 near '{label}'",
        "ratios beyond 1e308 would come out as 0 or infinity",
        "use the exact method",
    )


def _no_factors(size: int, message: str) -> Problem:
    return Problem(
        f"the {size} equations cannot be factorised in float64 ({message.strip()})",
        "speeds beyond the range of float64 make a regular system look singular",
        "use the exact method",
    )
