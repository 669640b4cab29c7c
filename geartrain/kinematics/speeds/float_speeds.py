"""Float64 speeds by sparse LU and iterative refinement with extra-precise residuals, and their error bounds.

The coefficients are integers, so that the residual of a float solution can be computed in twice the working precision
by
error-free products and sums. Refinement with it reduces the error of every component to one or two roundings
(docs/accuracy.md), as long as the factors have any correct digit of the inverse. Beyond that no bound from the same
factors is valid, and the solution is refused (Demmel, Hida, Kahan, Li, Mukherjee and Riedy, Error bounds from
extra-precise iterative refinement, 2006).

Trains whose speeds leave the range of float64 are scaled by powers of two. The exponents are estimated by elimination
in
numbers with 53 bits and unlimited exponents. The scaled rows are then solved and checked like any other.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import frexp, log2
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.speeds.padded_rows import PaddedRows
from geartrain.kinematics.willis_equation import WillisEquation
from geartrain.kinematics.willis_matrix import independent_rows
from geartrain.kinematics.willis_system import WillisSystem
from geartrain.numerics.containers import FrozenFields, LazyMapping
from geartrain.numerics.elimination import TooDenseError, eliminate
from geartrain.numerics.exact import as_float
from geartrain.numerics.labelled_array import LabelledArray, labelled_array
from geartrain.numerics.long_float import HIGHEST, LOWEST, LongFloat, Real, scaled, split
from geartrain.numerics.results import Shown
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


# -------------------------------------------------------------------------------------------------------------- scaling


_GIVEN = -1  # column of prescribed speeds
_LOST = (
    44  # bits of cancellation beyond which a sum counts as 0; 9 bits less than float64 has, for accumulated rounding
)
_BUDGET = 4_000_000  # operations of the elimination, about a minute
_TOO_DENSE = Problem(
    "speeds leave the range of float64 in a train that is coupled too densely",
    "their orders of magnitude take too long to compute",
    "use the exact method, or request a single output",
)


@dataclass(frozen=True, slots=True, eq=False)
class _RoughFloat(LongFloat):
    """Float with unlimited exponent; a sum becomes 0 after almost complete cancellation."""

    @classmethod
    def make(cls, mantissa: float, exponent: int) -> Any:
        part, power = frexp(mantissa)
        return cls(part, power + exponent)

    def __add__(self, other: Any) -> Any:
        total = LongFloat.__add__(self, other)
        if isinstance(other, _RoughFloat) and other and self:
            most = max(self.exponent, other.exponent)
            if total.exponent < most - _LOST:
                return _RoughFloat(0.0, 0)
        return total

    __radd__ = __add__


def find_exponents(rows: Sequence[WillisEquation], given: Sequence[Fraction], links: Sequence[str]) -> list[int]:
    """Return for each link an exponent of two such that its speed divided by this power is near 1.

    given   right-hand side of each row

    Raises `RangeError` if elimination would take more than about a minute.
    """
    at = {link: column for column, link in enumerate(links)}
    lines = [{at[link]: c for link, c in row.terms if link in at} for row in rows]
    forms: Any = [
        {column: _RoughFloat(*split(c)) for column, c in line.items()}
        | ({_GIVEN: _RoughFloat(*split(-right))} if right else {})
        for line, right in zip(lines, given, strict=True)
    ]
    found: dict[int, float] = {}
    try:
        solved = eliminate(forms, _BUDGET).forms(_BUDGET)
    except TooDenseError:
        raise RangeError(_TOO_DENSE) from None
    for column, form in solved.items():
        speed: Any = form.get(_GIVEN)
        if speed and len(form) == 1:
            # logarithms, because the speed itself may be beyond float64
            found[column] = log2(abs(speed.mantissa)) + speed.exponent
    for line, right in zip(lines, given, strict=True):
        if len(line) == 1 and not right:  # fixed link
            found[next(iter(line))] = 0.0
    _assign_exponents(lines, found)
    # integer exponents, so that scaling is exact
    return [round(found.get(column, 0.0)) for column in range(len(links))]


def _assign_exponents(lines: Sequence[Mapping[int, int]], found: dict[int, float]) -> None:
    """Assign exponents to links at rest: the minimum exponent that makes an entry comparable with others of its row.

    In rows of faster links the scaled entry is then negligible, which is correct because the link does not move.
    """
    users: dict[int, list[int]] = {}
    for row, line in enumerate(lines):
        for column in line:
            users.setdefault(column, []).append(row)
    # breadth-first search from links with known exponents
    queue = deque(column for line in lines if found.keys() & line for column in line if column not in found)
    while queue:
        column = queue.popleft()
        if column in found:
            continue
        sizes = [
            max(found[other] + log2(abs(lines[row][other])) for other in lines[row] if other in found)
            - log2(abs(lines[row][column]))
            for row in users[column]
            if found.keys() & lines[row].keys()
        ]
        found[column] = min(sizes)
        queue.extend(other for row in users[column] for other in lines[row] if other not in found)


# --------------------------------------------------------------------------------------------------------- float speeds


_INVERTED, _ABREAST = (
    400,
    64,
)  # maximum number of links for which the inverse is computed, and columns computed together
_DRAWN = 12  # random sets of signs for more links
_STEPS = 8  # maximum refinement steps; each at least halves the error if they converge
_ITERATIONS = 4  # power iterations that bound a condition number
_LARGEST_CONDITION = 1 / (
    8 * UNIT_ROUNDOFF
)  # 1 / (4 eps): beyond this condition number no digit of the inverse is correct
_REGULAR = 2.0**40  # condition number up to which the factors prove that the matrix is regular
_ORDINARY = 400  # exponents of two up to which speeds are solved unscaled: squares stay within float64


@dataclass(frozen=True, slots=True)
class FloatSpeeds(FrozenFields, Shown):
    """Float64 speeds by sparse LU and iterative refinement, with an estimate of their error (docs/theory.md, 11).

    `floats[link]` returns the speed of a link in the first case, and raises `RangeError` if it exceeds the range of
    float64.

    Notes
    -----
    The refinement step is equation (23) with its residual in twice the precision; the error estimate is (24). Every
    speed is accurate to one or two roundings (docs/accuracy.md). The relative error of a speed is at most its condition
    number times the largest residual (Oettli and Prager 1964). Higham, Accuracy and Stability of Numerical Algorithms,
    chapter 7.

    Examples
    --------
    >>> import geartrain
    >>> floats = geartrain.load("planetary-24-18-60").kinematics.floats()
    >>> floats["carrier"] == 2 / 7, floats.decimal("carrier", digits=4)
    (True, '0.2857')
    """

    speeds: LabelledArray
    """Speeds, axes (link, case) [unit of the train times 2**exponents]."""
    estimate: LabelledArray
    """Estimated absolute error of each speed, with axes and unit of `speeds`."""
    residual: LabelledArray
    """Relative residual |b - A x| / (|A| |x|) of each row of the matrix, axes (row, case), computed in twice the
    working precision [1].
    """
    condition: Mapping[str, float]
    """Link -> component-wise condition number cond(A, x) of the first case, equation (25), for the requested links. It
    is at least 1, and infinite for a link at rest. Computed at the first access.
    """
    exponents: LabelledArray
    """Exponents of two, axes (link, case); 0 if the speed and its estimate are within the range of float64."""

    def _summary(self) -> str:
        return self.speeds._summary()

    def __getitem__(self, link: str) -> float:
        speed = self.number(link)
        if isinstance(speed, float):
            return speed
        what = f"the speed of '{link}' is {speed}, beyond the range of float64"
        fix = f"use `decimal('{link}')`, or multiply `speeds` by 2**`exponents`"
        raise RangeError(Problem(what, "float64 covers 1e-308 to 1e308", fix))

    def number(self, link: str, case: int = 0) -> Real:
        """Return the speed of a link [unit of the train]: a float, or a `LongFloat` beyond the range of float64.

        Parameters
        ----------
        link : str
            Name of the link.
        case : int
            Index of the case, from 0.
        """
        return scaled(float(self.speeds[link][case]), int(self.exponents[link][case]))

    def decimal(self, link: str, case: int = 0, digits: int = 10) -> str:
        """Return the speed of a link of any magnitude as decimal text.

        Parameters
        ----------
        link : str
            Name of the link.
        case : int
            Index of the case, from 0.
        digits : int
            Number of significant digits, 1 or more.
        """
        return f"{self.number(link, case):.{digits}g}"


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # overflow is scaled or refused below
def solve_floats(
    system: WillisSystem,
    inputs: Mapping[str, Sequence[float]] | None = None,
    condition_of: Sequence[str] = (),
    ordering: str = "COLAMD",
    refine: bool = True,
) -> FloatSpeeds:
    """Solve a determined Willis system in float64 by factorisation of its `matrix()`.

    inputs        input link -> speeds, one for each case, for every input of the system; all cases share one
    factorisation
    condition_of  links whose component-wise condition number is requested; each costs one transposed solve when it is
    read
    ordering      column ordering of the factorisation; only COLAMD never takes quadratic time
    refine        True for iterative refinement, False for the unrefined LU solution (for comparison)

    If speeds leave the range of float64, each case is solved with a separate power of two for every link. Raises
    `RangeError` if the system is not square and regular, or if scaling does not bring it within the range either.
    Speeds never underflow to 0.
    """
    matrix, rows = prepare(system)
    found, exponents = _solve_with_scaling(
        matrix, rows, _right_hand_sides(rows, inputs), _Options(ordering, refine, condition_of)
    )
    cases = [str(case) for case in range(found.x.shape[1])]
    return FloatSpeeds(
        _with_frame(system, matrix, found.x),
        _with_frame(system, matrix, found.estimate),
        labelled_array(found.residual, row=[row.label for row in rows], case=cases),
        found.condition,
        _with_frame(system, matrix, exponents),
    )


class _Solved(NamedTuple):
    """Speeds and their error estimates (link, case), residuals (row, case), and condition numbers by link."""

    x: Floats
    estimate: Floats
    residual: Floats
    condition: Mapping[str, float]


class _Options(NamedTuple):
    """Options of `solve_floats`."""

    ordering: str
    refine: bool
    condition_of: Sequence[str]


def _solve_with_scaling(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], options: _Options
) -> tuple[_Solved, NDArray[np.int64]]:
    """Return scaled speeds with their error estimates, and the exponents of two, which are 0 for ordinary trains."""
    near = None
    with suppress(RangeError):
        near = _solve(matrix, rows, given, options)
    # scaling is needed only for extreme speeds
    if near is not None and _is_ordinary(near.x):
        return near, np.zeros(near.x.shape, dtype=np.int64)
    # exponents depend on the input speeds, so each case is scaled separately
    cases = [_solve_scaled(matrix, rows, [line[at : at + 1] for line in given], options) for at in range(len(given[0]))]
    found, exponents = zip(*cases, strict=True)
    x, estimate, residual, conditions = zip(*found, strict=True)
    return _Solved(np.hstack(x), np.hstack(estimate), np.hstack(residual), conditions[0]), np.hstack(exponents)


def _is_ordinary(x: Floats) -> bool:
    """Return whether all speeds are so near 1 in magnitude that their errors and squares stay within float64."""
    sizes = np.frexp(x)[1]
    return bool(((x == 0) | (np.abs(sizes) <= _ORDINARY)).all())


def _solve(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], options: _Options
) -> _Solved:
    """Return the solution with error estimates. Raises `RangeError` beyond the range of float64."""
    right, remainder = _rounded_right_sides(rows, given)
    try:
        lu = matrix.factorise(options.ordering)
    except RuntimeError as error:
        raise RangeError(_no_factors(len(rows), str(error))) from None
    x = lu.solve(right)
    if options.refine:
        x = _refined(lu, matrix, x, right, remainder)
    rest = matrix.residual(x, right, remainder)
    _check_range(matrix, x, rest, rows)
    left = lu.solve(rest)  # remaining error, refined once below
    more = lu.solve(matrix.residual(left, rest, np.zeros_like(rest)))
    # rounding errors of the residuals in twice the precision and of the last solution, and dropped entries
    terms = matrix.size(x)
    hidden = 16 * UNIT_ROUNDOFF**2 * terms + 16 * UNIT_ROUNDOFF * matrix.size(more) + matrix.sunk(x)
    reach, spread = np.hsplit(_error_bound(lu, np.hstack([hidden, terms])), 2)
    _check_digits(lu, matrix, np.abs(x), spread)
    estimate = 2 * (np.abs(left) + np.abs(more)) + UNIT_ROUNDOFF * np.abs(x) + reach
    residual = np.divide(np.abs(rest), terms, out=np.zeros_like(rest), where=terms > 0)
    # the factors are kept in memory until the condition numbers are read, and only if these were requested
    condition = (
        LazyMapping(partial(matrix.condition, lu, options.condition_of, x[:, 0])) if options.condition_of else {}
    )
    return _Solved(x, estimate, residual, condition)


def _refined(lu: Any, matrix: PaddedRows, x: Floats, right: Floats, remainder: Floats) -> Floats:
    """Return the solution after iterative refinement (23), which ends when a step is not smaller than half the last
    step.
    """
    last = 1.0
    for _ in range(_STEPS):
        step = lu.solve(matrix.residual(x, right, remainder))
        x = x + step
        matrix.prescribe(x, right)
        moved = np.max(np.divide(np.abs(step), np.abs(x), out=np.zeros_like(x), where=x != 0), initial=0.0)
        # steps shrink by a constant factor, so the remaining error is about moved * moved / last
        if not UNIT_ROUNDOFF * last < moved**2 <= (last / 2) ** 2:
            break
        last = moved
    return x


def _solve_scaled(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], options: _Options
) -> tuple[_Solved, NDArray[np.int64]]:
    """Solve one case for speeds that are scaled by powers of two, which causes no rounding."""
    exponents = np.array(find_exponents(rows, [right for (right,) in given], list(matrix.at)), dtype=np.int64)
    near, shifts = matrix.scaled(exponents)
    moved = [[right * Fraction(2) ** -shift] for (right,), shift in zip(given, shifts.tolist(), strict=True)]
    found = _solve(near, rows, moved, options)
    powers = exponents[:, None]
    held = _is_representable(found.x, powers) & _is_representable(found.estimate, powers)
    # numpy's ldexp takes C ints; exponents beyond float64 are kept separately
    folded = np.where(held, powers, 0).astype(np.intc)
    there = found._replace(x=np.ldexp(found.x, folded), estimate=np.ldexp(found.estimate, folded))
    return there, np.where(held, 0, powers)


def _is_representable(values: Floats, powers: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return a mask of the values that, times powers of two, are 0 or normal float64 numbers."""
    sizes = np.frexp(values)[1] + powers
    held: NDArray[np.bool_] = (values == 0) | ((sizes >= LOWEST) & (sizes <= HIGHEST))
    return held


def _error_bound(lu: Any, error: Floats) -> Floats:
    """Return the maximum change of each speed if the equations have errors of any sign: |A^-1| error.

    For a single set of signs the effects of several errors may cancel. The inverse is computed column by column for
    up to 400 links. For more links four times the root mean square over random signs and sizes is used.
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
    draw = np.random.default_rng(size)  # fixed seed, so that estimates are reproducible
    for case in range(cases):
        signs = draw.choice([-1.0, 1.0], (size, _DRAWN)) * draw.uniform(0.5, 1.5, (size, _DRAWN))
        found[:, case] = 4 * np.sqrt((lu.solve(signs * error[:, case, None]) ** 2).mean(axis=1))
    return found


def prepare(system: WillisSystem) -> tuple[PaddedRows, list[WillisEquation]]:
    """Return the matrix for factorisation and its rows: as many independent rows as there are moving links.

    Raises `RangeError` if the system is not square.
    """
    links, rows = independent_rows(system.links, system.equations, system.redundant)
    if len(rows) > len(links):
        what = "the prescribed speeds contradict each other"
        raise RangeError(
            Problem(what, "no speeds satisfy all equations", "print `train.solve().verdict`, which names the cause")
        )
    if len(rows) < len(links):
        what = f"there are only {len(rows)} independent equations for {len(links)} moving links"
        why = "speeds in float64 are computed only if they are determined"
        raise RangeError(Problem(what, why, "print `train.solve().verdict`, which names the cause"))
    return PaddedRows(links, rows), rows


def _with_frame(system: WillisSystem, matrix: PaddedRows, values: NDArray[Any]) -> LabelledArray:
    """Return values with one row for each link in the order of the declaration, 0 for the frame."""
    at = next(at for at, link in enumerate(system.links) if link not in matrix.at)
    return labelled_array(
        np.insert(values, at, 0, axis=0),
        link=system.links,
        case=[str(case) for case in range(values.shape[1])],
    )


def _right_hand_sides(
    rows: Sequence[WillisEquation], inputs: Mapping[str, Sequence[float]] | None
) -> list[list[Fraction]]:
    """Return the right-hand side of every row, one number for each case [unit of the train]."""
    cases = len(next(iter(inputs.values()))) if inputs else 1
    return [
        [Fraction(value) for value in inputs[row.terms[0][0]]]
        if inputs is not None and row.kind == "input"
        else [row.right] * cases
        for row in rows
    ]


def _rounded_right_sides(rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]]) -> tuple[Floats, Floats]:
    right = np.zeros((len(rows), len(given[0])))
    remainder = np.zeros_like(right)
    for at, line in enumerate(given):
        if not any(line):
            continue
        nearest = [as_float(value) for value in line]
        if None in nearest:
            raise RangeError(_out_of_range(rows[at].label))
        right[at] = nearest
        # rounding of the inputs is corrected in the residual
        remainder[at] = [float(value - Fraction(near)) for value, near in zip(line, right[at].tolist(), strict=True)]
    return right, remainder


def _check_range(matrix: PaddedRows, x: Floats, rest: Floats, rows: Sequence[WillisEquation]) -> None:
    """Raise `RangeError` for a solution with overflow or underflow.

    One mesh changes a speed by a factor of at most 1e12, so a speed that underflows to 0 has neighbours near the lower
    limit
    of float64.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        size = matrix.size(x)
        # rows near the lower limit of float64 with large residuals: subnormal numbers have lost digits
        lost = (size < 1e-250) & (np.abs(rest) > 1e-8 * size)
        # overflow or breakdown of the factors; negated `<=`, so that nan counts as wrong
        wrong = ~(
            np.abs(rest) <= 1e-6 * np.maximum(size, np.abs(matrix.coefficients).sum(axis=1)[:, None] * np.abs(x).max())
        )
    # a speed that underflowed to 0 was below 5e-324, so its neighbours are below 5e-312
    sunk = ((x != 0) & (np.abs(x) < 1e-280))[matrix.columns].any(axis=1) & (matrix.coefficients != 0).any(axis=1)[
        :, None
    ]
    bad = (lost | wrong | sunk).any(axis=1)
    if bad.any():
        raise RangeError(_out_of_range(rows[int(np.argmax(bad))].label))


def _check_digits(lu: Any, matrix: PaddedRows, speeds: Floats, spread: Floats) -> None:
    """Raise `RangeError` if the factors have no correct digit: if the spectral radius of |A^-1| |A| is at least 1 / (4
    eps).

    The radius is the condition number of the system in the best units for each link (Bauer 1963). For any positive v it
    is at most the maximum of |A^-1| |A| v / v (Collatz and Wielandt), and power iteration from |x| lowers that bound. A
    link that is at rest, or slow because large terms cancel, costs one iteration. If the factors are wrong themselves,
    the bound stays at the limit.

    speeds   |x|
    spread   |A^-1| |A| |x|, computed with the factors
    """
    condition = _condition(lu, matrix, speeds, spread, _LARGEST_CONDITION)
    if (condition <= _LARGEST_CONDITION).all():
        return
    at = int(np.argmax(condition.max(axis=1)))
    what = f"no digit of the speed of '{list(matrix.at)[at]}' is correct in float64"
    why = f"rounding errors of the equations are amplified more than {_LARGEST_CONDITION:.0e} times"
    raise RangeError(Problem(what, why, "use the exact method"))


def _condition(lu: Any, matrix: PaddedRows, speeds: Floats, spread: Floats, limit: float) -> Floats:
    """Return |A^-1| |A| v / v for the first v of a power iteration whose maximum, a bound of the spectral radius, is
    below `limit`.
    """
    for _ in range(_ITERATIONS):
        condition = np.divide(spread, speeds, out=np.where(spread == 0, 0.0, np.inf), where=speeds > 0)
        if (condition <= limit).all():
            break
        speeds, spread = spread, _error_bound(lu, matrix.size(spread))
    return condition


def is_regular(system: WillisSystem) -> bool:
    """Return True if float64 arithmetic proves that the system determines all speeds, False if it does not or if the
    test is inconclusive.

    The computed factors of a singular matrix are the exact factors of a regular matrix that differs from it by rounding
    errors, so their condition number is about 1 / eps. The limit for the condition number is a thousand times lower.
    """
    try:
        matrix, _ = prepare(system)
        lu = matrix.factorise("COLAMD")
    except (RangeError, RuntimeError):
        return False
    ones = np.ones((len(matrix.at), 1))
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return bool((_condition(lu, matrix, ones, _error_bound(lu, matrix.size(ones)), _REGULAR) <= _REGULAR).all())


def _out_of_range(label: str) -> Problem:
    return Problem(
        f"a speed leaves the range of float64 near '{label}'",
        "a ratio above 1e308 or below 1e-308 would become infinity or 0",
        "use the exact method",
    )


def _no_factors(size: int, message: str) -> Problem:
    return Problem(
        f"the {size} equations cannot be factorised in float64 ({message.strip()})",
        "ratios above 1e308, and differences smaller than the rounding error, make the system numerically singular",
        "use the exact method",
    )
