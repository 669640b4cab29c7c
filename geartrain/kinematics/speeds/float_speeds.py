"""Float64 speeds by sparse LU and iterative refinement with extra-precise residuals, and their error bounds.

The rows are integers, so the residual of a float solution can be computed to twice the working precision by error-free
products and sums. Refinement with it brings every component within a rounding or two (docs/accuracy.md), as long as the
factors hold any digit of the inverse: beyond that no bound from the same factors is valid, and the solution is refused
(Demmel, Hida, Kahan, Li, Mukherjee and Riedy, Error bounds from extra-precise iterative refinement, 2006).

Powers of two by which the speeds of a train that leaves float64 are near 1: its rows solved roughly.

The rows are eliminated as the exact ones are, in numbers of 53 bits whose exponent has no end. What comes out may be
wrong in any digit but its size; nothing is answered by it, and the scaled rows are solved and judged as any are.
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


_GIVEN = -1  # the column of what is prescribed
_LOST = 44  # bits that a sum may lose before what is left of it is taken for the rounding of a 0
_BUDGET = 4_000_000  # operations of the elimination
_TOO_DENSE = Problem(
    "speeds leave the range of float64 in a train that is coupled too densely",
    "their sizes take too long to find",
    "use the exact method, or ask for one output",
)


@dataclass(frozen=True, slots=True, eq=False)
class _Rough(LongFloat):
    """A long float at any size, whose sums are 0 where next to nothing is left of their terms."""

    @classmethod
    def make(cls, mantissa: float, exponent: int) -> Any:
        part, power = frexp(mantissa)
        return cls(part, power + exponent)

    def __add__(self, other: Any) -> Any:
        total = LongFloat.__add__(self, other)
        if isinstance(other, _Rough) and other and self:
            most = max(self.exponent, other.exponent)
            if total.exponent < most - _LOST:
                return _Rough(0.0, 0)
        return total

    __radd__ = __add__


def find_exponents(rows: Sequence[WillisEquation], given: Sequence[Fraction], links: Sequence[str]) -> list[int]:
    """An exponent of two for each link, so that its speed over that power is near 1.

    given   right-hand side of each row

    Raises `RangeError` where the rows are too dense to be eliminated in a minute or so.
    """
    at = {link: column for column, link in enumerate(links)}
    lines = [{at[link]: c for link, c in row.terms if link in at} for row in rows]
    forms: Any = [
        {column: _Rough(*split(c)) for column, c in line.items()} | ({_GIVEN: _Rough(*split(-right))} if right else {})
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
            # in logarithms: the speed itself may be beyond float64
            found[column] = log2(abs(speed.mantissa)) + speed.exponent
    for line, right in zip(lines, given, strict=True):
        if len(line) == 1 and not right:  # held still
            found[next(iter(line))] = 0.0
    _spread(lines, found)
    # whole powers, so that scaling by them rounds nothing
    return [round(found.get(column, 0.0)) for column in range(len(links))]


def _spread(lines: Sequence[Mapping[int, int]], found: dict[int, float]) -> None:
    """Links that stand still have no size of their own: the least that a row with others gives them.

    In a row that turns faster its entry then sinks, and says nothing there that the row did not say without it.
    """
    users: dict[int, list[int]] = {}
    for row, line in enumerate(lines):
        for column in line:
            users.setdefault(column, []).append(row)
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


_INVERTED, _ABREAST = 400, 64  # links up to which the inverse is made, and columns of it at a time
_DRAWN = 12  # sets of signs beyond
_STEPS = 8  # of refinement; where they converge at all, each at least halves the error
_ITERATIONS = 4  # power iterations that bound a condition number
_KNOWN = 1 / (8 * UNIT_ROUNDOFF)  # 1 / (4 eps): condition beyond which the factors hold no digit of the inverse
_REGULAR = 2.0**40  # condition up to which factors prove that their matrix is regular; beyond, it is in doubt
_ORDINARY = 400  # powers of two up to which speeds are solved as they are


@dataclass(frozen=True, slots=True)
class FloatSpeeds(FrozenFields, Shown):
    """Float64 speeds by sparse LU and one refinement step, with an estimate of their error (docs/theory.md, 11).

    `floats[link]` is the speed of a link in the first case; `RangeError` where float64 does not hold it.

    Notes
    -----
    The step is equation (23), its residual in twice the precision; the estimate is (24). Every speed comes within a
    rounding or two (docs/accuracy.md). The relative error of a speed is at most its condition times the greatest
    residual (Oettli and Prager 1964). Higham, Accuracy and Stability of Numerical Algorithms, chapter 7.

    Examples
    --------
    >>> import geartrain
    >>> floats = geartrain.load("planetary-24-18-60").kinematics.floats()
    >>> floats["carrier"] == 2 / 7, floats.decimal("carrier", digits=4)
    (True, '0.2857')
    """

    speeds: LabelledArray
    """Axes (link, case) [the train's unit], to be multiplied by 2**exponents."""
    estimate: LabelledArray
    """Absolute error to expect of each speed, axes and unit as those of `speeds`."""
    residual: LabelledArray
    """Axes (row, case): by what part of its terms each row of the matrix is off, |b - A x| over |A| |x|, in twice
    the precision [1]."""
    condition: Mapping[str, float]
    """Component-wise condition number cond(A, x) of the first case, equation (25), of each link it was asked for; 1
    or more, infinite of a link at rest. Made when read."""
    exponents: LabelledArray
    """Axes (link, case): powers of two, 0 wherever float64 holds the speed and its estimate."""

    def _summary(self) -> str:
        return self.speeds._summary()

    def __getitem__(self, link: str) -> float:
        speed = self.number(link)
        if isinstance(speed, float):
            return speed
        what = f"the speed of '{link}' is {speed}, beyond the range of float64"
        fix = f"read `speeds` times 2 to the power of `exponents`, or `decimal('{link}')`"
        raise RangeError(Problem(what, "a float holds 1e-308 to 1e308", fix))

    def number(self, link: str, case: int = 0) -> Real:
        """The speed of a link, as a float where one holds it.

        Parameters
        ----------
        link : str
            Name of the link.
        case : int
            Which of the cases, from 0.
        """
        return scaled(float(self.speeds[link][case]), int(self.exponents[link][case]))

    def decimal(self, link: str, case: int = 0, digits: int = 10) -> str:
        """The speed of a link in decimal, of any size.

        Parameters
        ----------
        link : str
            Name of the link.
        case : int
            Which of the cases, from 0.
        digits : int
            Significant digits, 1 or more.
        """
        return f"{self.number(link, case):.{digits}g}"


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what leaves the range is scaled, or refused below
def solve_floats(
    system: WillisSystem,
    inputs: Mapping[str, Sequence[float]] | None = None,
    condition_of: Sequence[str] = (),
    ordering: str = "COLAMD",
    refine: bool = True,
) -> FloatSpeeds:
    """Solve a determined Willis system in float64: its `matrix()` is factorised.

    inputs        link -> speeds, one a case, for every input of the system: one factorisation serves all
    condition_of  links whose component-wise condition is wanted, one transposed solve each when they are read
    ordering      column ordering of the factorisation; COLAMD is the one that never turns quadratic
    refine        one refinement step (else the raw LU, for comparison)

    Where speeds leave the range of float64 each case is solved with a power of two of its own for every link.
    Raises `RangeError` where the system is not square and regular, or where that does not bring it within the range
    either: a silent 0 is never returned.
    """
    matrix, rows = prepare(system)
    found, exponents = _solve_any(matrix, rows, _given(rows, inputs), _Way(ordering, refine, condition_of))
    cases = [str(case) for case in range(found.x.shape[1])]
    return FloatSpeeds(
        _with_frame(system, matrix, found.x),
        _with_frame(system, matrix, found.estimate),
        labelled_array(found.residual, row=[row.label for row in rows], case=cases),
        found.condition,
        _with_frame(system, matrix, exponents),
    )


class _Solved(NamedTuple):
    """Speeds and their estimates (link, case), residuals (row, case), conditions by link."""

    x: Floats
    estimate: Floats
    residual: Floats
    condition: Mapping[str, float]


class _Way(NamedTuple):
    """How to solve, as `solve_floats` is told."""

    ordering: str
    refine: bool
    condition_of: Sequence[str]


def _solve_any(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> tuple[_Solved, NDArray[np.int64]]:
    """What is found, speeds and estimates over powers of two, and those powers; ordinary trains need none."""
    near = None
    with suppress(RangeError):
        near = _solve(matrix, rows, given, way)
    if near is not None and _is_ordinary(near.x):
        return near, np.zeros(near.x.shape, dtype=np.int64)
    cases = [_solve_far(matrix, rows, [line[at : at + 1] for line in given], way) for at in range(len(given[0]))]
    found, exponents = zip(*cases, strict=True)
    x, estimate, residual, conditions = zip(*found, strict=True)
    return _Solved(np.hstack(x), np.hstack(estimate), np.hstack(residual), conditions[0]), np.hstack(exponents)


def _is_ordinary(x: Floats) -> bool:
    """True if no speed is so large or small that its errors, or their squares in `_reach`, leave float64."""
    sizes = np.frexp(x)[1]
    return bool(((x == 0) | (np.abs(sizes) <= _ORDINARY)).all())


def _solve(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> _Solved:
    """What is found; `RangeError` where float64 does not hold it."""
    right, remainder = _right_sides(rows, given)
    try:
        lu = matrix.factorise(way.ordering)
    except RuntimeError as error:
        raise RangeError(_no_factors(len(rows), str(error))) from None
    x = lu.solve(right)
    if way.refine:
        x = _refined(lu, matrix, x, right, remainder)
    rest = matrix.residual(x, right, remainder)
    _check_range(matrix, x, rest, rows)
    left = lu.solve(rest)  # what is still off, itself refined once below
    more = lu.solve(matrix.residual(left, rest, np.zeros_like(rest)))
    # what is left, the rounding of x itself, and what residuals in twice the precision and the last solution may hide
    terms = matrix.size(x)
    hidden = 16 * UNIT_ROUNDOFF**2 * terms + 16 * UNIT_ROUNDOFF * matrix.size(more) + matrix.sunk(x)
    reach, spread = np.hsplit(_reach(lu, np.hstack([hidden, terms])), 2)
    _check_digits(lu, matrix, np.abs(x), spread)
    estimate = 2 * (np.abs(left) + np.abs(more)) + UNIT_ROUNDOFF * np.abs(x) + reach
    residual = np.divide(np.abs(rest), terms, out=np.zeros_like(rest), where=terms > 0)
    # the factors are kept for as long as nobody has read the conditions, and not where none were asked for
    condition = LazyMapping(partial(matrix.condition, lu, way.condition_of, x[:, 0])) if way.condition_of else {}
    return _Solved(x, estimate, residual, condition)


def _refined(lu: Any, matrix: PaddedRows, x: Floats, right: Floats, remainder: Floats) -> Floats:
    """Iterative refinement (23): one step for an ordinary train, more while a step at least halves the last one."""
    last = 1.0
    for _ in range(_STEPS):
        step = lu.solve(matrix.residual(x, right, remainder))
        x = x + step
        matrix.prescribe(x, right)
        moved = np.max(np.divide(np.abs(step), np.abs(x), out=np.zeros_like(x), where=x != 0), initial=0.0)
        # steps shrink by a constant factor: what is left after this one is about moved times moved / last
        if not UNIT_ROUNDOFF * last < moved**2 <= (last / 2) ** 2:
            break
        last = moved
    return x


def _solve_far(
    matrix: PaddedRows, rows: Sequence[WillisEquation], given: Sequence[Sequence[Fraction]], way: _Way
) -> tuple[_Solved, NDArray[np.int64]]:
    """One case, in speeds over powers of two: scaling by them rounds nothing, so all is as good as near 1."""
    exponents = np.array(find_exponents(rows, [right for (right,) in given], list(matrix.at)), dtype=np.int64)
    near, shifts = matrix.scaled(exponents)
    moved = [[right * Fraction(2) ** -shift] for (right,), shift in zip(given, shifts.tolist(), strict=True)]
    found = _solve(near, rows, moved, way)
    powers = exponents[:, None]
    held = _held(found.x, powers) & _held(found.estimate, powers)
    # numpy's ldexp takes C ints: powers that float64 cannot hold stay beside the number
    folded = np.where(held, powers, 0).astype(np.intc)
    there = found._replace(x=np.ldexp(found.x, folded), estimate=np.ldexp(found.estimate, folded))
    return there, np.where(held, 0, powers)


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
    draw = np.random.default_rng(size)  # seeded: the same train has the same estimate on every run
    for case in range(cases):
        signs = draw.choice([-1.0, 1.0], (size, _DRAWN)) * draw.uniform(0.5, 1.5, (size, _DRAWN))
        found[:, case] = 4 * np.sqrt((lu.solve(signs * error[:, case, None]) ** 2).mean(axis=1))
    return found


def prepare(system: WillisSystem) -> tuple[PaddedRows, list[WillisEquation]]:
    """As many independent rows as there are moving links, ready to be factorised, or a `RangeError`."""
    links, rows = independent_rows(system.links, system.equations, system.redundant)
    if len(rows) > len(links):
        what = "the prescribed speeds contradict each other"
        raise RangeError(Problem(what, "no speeds satisfy all equations", "ask for the verdict"))
    if len(rows) < len(links):
        what = f"{len(rows)} independent equations for {len(links)} moving links"
        why = "a train that is free, locked or contradictory has no float solution"
        raise RangeError(Problem(what, why, "ask for the exact verdict first"))
    return PaddedRows(links, rows), rows


def _with_frame(system: WillisSystem, matrix: PaddedRows, values: NDArray[Any]) -> LabelledArray:
    """One row a link in the order declared, the frame's being 0."""
    at = next(at for at, link in enumerate(system.links) if link not in matrix.at)
    return labelled_array(
        np.insert(values, at, 0, axis=0),
        link=system.links,
        case=[str(case) for case in range(values.shape[1])],
    )


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


def _check_range(matrix: PaddedRows, x: Floats, rest: Floats, rows: Sequence[WillisEquation]) -> None:
    """Refuse a solution that overflowed, or sank below what float64 can hold on its way along the train.

    One mesh changes a speed by a factor of 1e12 at most, so a speed that sank to 0 left others near the edge.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        size = matrix.size(x)
        # rows near the end of float64 whose terms do not cancel: subnormal numbers have lost their digits
        lost = (size < 1e-250) & (np.abs(rest) > 1e-8 * size)
        # an overflow, or factors that broke down; not `>`, so that nan counts as wrong
        wrong = ~(
            np.abs(rest) <= 1e-6 * np.maximum(size, np.abs(matrix.coefficients).sum(axis=1)[:, None] * np.abs(x).max())
        )
    # what sank to 0 was below 5e-324, and what it meshes with below 5e-312: such a neighbour gives it away
    sunk = ((x != 0) & (np.abs(x) < 1e-280))[matrix.columns].any(axis=1) & (matrix.coefficients != 0).any(axis=1)[
        :, None
    ]
    bad = (lost | wrong | sunk).any(axis=1)
    if bad.any():
        raise RangeError(_out_of_range(rows[int(np.argmax(bad))].label))


def _check_digits(lu: Any, matrix: PaddedRows, speeds: Floats, spread: Floats) -> None:
    """Refuse factors that hold no digit of the inverse: the spectral radius of |A^-1| |A| is 1 / (4 eps) or more.

    The radius is the condition of the system in the best units for each link (Bauer 1963). For any positive v it is at
    most the maximum of |A^-1| |A| v / v (Collatz and Wielandt); power iteration from |x| lowers that bound. A link that
    is at rest, or slow because large terms cancel, costs one iteration; computed by factors that are wrong themselves,
    the bound stays at the limit.

    speeds   |x|
    spread   |A^-1| |A| |x|, by the factors
    """
    condition = _condition(lu, matrix, speeds, spread, _KNOWN)
    if (condition <= _KNOWN).all():
        return
    at = int(np.argmax(condition.max(axis=1)))
    what = f"no digit of the speed of '{list(matrix.at)[at]}' is known in float64"
    why = f"rounding errors of the equations are amplified more than {_KNOWN:.0e} times"
    raise RangeError(Problem(what, why, "use the exact method"))


def _condition(lu: Any, matrix: PaddedRows, speeds: Floats, spread: Floats, limit: float) -> Floats:
    """|A^-1| |A| v / v, whose maximum bounds the spectral radius, for the first v that brings it below the limit."""
    for _ in range(_ITERATIONS):
        condition = np.divide(spread, speeds, out=np.where(spread == 0, 0.0, np.inf), where=speeds > 0)
        if (condition <= limit).all():
            break
        speeds, spread = spread, _reach(lu, matrix.size(spread))
    return condition


def is_regular(system: WillisSystem) -> bool:
    """True if float64 proves that the system determines all speeds; False if it does not, or if that is in doubt.

    The factors of a singular matrix are those of a regular one that differs by roundings, so that their condition is
    about 1 / eps. The limit is a thousand times lower.
    """
    try:
        matrix, _ = prepare(system)
        lu = matrix.factorise("COLAMD")
    except (RangeError, RuntimeError):
        return False
    ones = np.ones((len(matrix.at), 1))
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return bool((_condition(lu, matrix, ones, _reach(lu, matrix.size(ones)), _REGULAR) <= _REGULAR).all())


def _out_of_range(label: str) -> Problem:
    return Problem(
        f"a speed leaves the range of float64 near '{label}'",
        "ratios beyond 1e308 would come out as 0 or infinity",
        "use the exact method",
    )


def _no_factors(size: int, message: str) -> Problem:
    return Problem(
        f"the {size} equations cannot be factorised in float64 ({message.strip()})",
        "ratios beyond 1e308, and differences below one rounding, make a regular system singular to working precision",
        "use the exact method",
    )
