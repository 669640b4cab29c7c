"""Float64 speeds by sparse LU factorisation and iterative refinement with extra-precise residuals, and their error
bounds.

The coefficients are integers, so that the residual of a float solution can be computed in twice the working precision
by error-free products and sums. Refinement with this residual reduces the error of every component to one or two
roundings (docs/accuracy.md), provided that the factors give the inverse to at least one correct digit. Otherwise no
bound computed from the factors is valid, and the solution is rejected (Demmel, Hida, Kahan, Li, Mukherjee and Riedy,
Error bounds from extra-precise iterative refinement, 2006).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.circuits.fundamental import WillisEquation
from geartrain.kinematics.willis_matrix import PaddedRows, independent_rows
from geartrain.kinematics.willis_system import WillisSystem
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import as_float
from geartrain.numerics.labelled_array import LabelledArray, labelled_array
from geartrain.numerics.results import Shown
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_INVERTED, _ABREAST = 400, 64  # maximum number of links for which the inverse is computed; columns computed together
_DRAWN = 12  # random sets of signs for more links
_STEPS = 8  # maximum refinement steps; each at least halves the error if they converge
_ITERATIONS = 4  # power iterations that bound a condition number
_LARGEST_CONDITION = 1 / (8 * UNIT_ROUNDOFF)  # 1 / (4 eps): beyond it no digit of the inverse is correct
_LARGEST_EXPONENT = 400  # of two, of a speed: the squares of errors stay within float64


@dataclass(frozen=True, slots=True)
class FloatSpeeds(FrozenFields, Shown):
    """Float64 speeds computed by sparse LU factorisation and iterative refinement, with error estimates
    (section 11 of docs/theory.md).

    `floats[link]` is the speed of a link for the first set of input speeds. Each speed is 0, or its magnitude is
    between 1e-120 and 1e120.

    Notes
    -----
    The refinement step is equation (23), with the residual computed in twice the working precision; the error estimate
    is equation (24). Every speed is accurate to one or two roundings (docs/accuracy.md). The relative error of a speed
    is at most its condition number times the largest residual (Oettli and Prager 1964; Higham, Accuracy and Stability
    of Numerical Algorithms, chapter 7).

    Examples
    --------
    >>> import geartrain
    >>> floats = geartrain.load("planetary-24-18-60").kinematics.floats()
    >>> floats["carrier"] == 2 / 7
    True
    """

    speeds: LabelledArray
    """Speeds with axes (link, case) [the train's unit of speed]; a case is one set of input speeds."""
    estimate: LabelledArray
    """Estimated absolute error of each speed, with the axes and the unit of `speeds`."""
    residual: LabelledArray
    """Relative residual |b - A x| / (|A| |x|) of each row of the matrix, axes (row, case), computed in twice the
    working precision [1].
    """
    condition: Mapping[str, float]
    """Component-wise condition number cond(A, x) of the speed of each link in the first case, equation (25). It is 1 or
    more, and infinite for a link at rest, whose relative error is undefined. The mapping is empty for trains of more
    than 400 links.
    """

    def _summary(self) -> str:
        return self.speeds._summary()

    def __getitem__(self, link: str) -> float:
        return float(self.speeds[link][0])


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # overflow is refused below
def solve_floats(system: WillisSystem, inputs: Mapping[str, Sequence[float]] | None = None) -> FloatSpeeds:
    """Solve a determined Willis system in float64 by factorisation of its `matrix()`.

    inputs   speeds by input link, with one number for each set of input speeds; the matrix is factorised only once

    Raises `RangeError` if the system is not square and regular, or if a speed is not between 1e-120 and 1e120.
    """
    matrix, rows = prepare(system)
    right, remainder = _rounded_right_sides(rows, _right_hand_sides(rows, inputs))
    try:
        lu = matrix.factorise()
    except RuntimeError as error:
        what = f"the {len(rows)} equations cannot be factorised in float64 ({str(error).strip()})"
        why = (
            "ratios above 1e308, and differences smaller than the rounding error, make the system numerically singular"
        )
        raise RangeError(Problem(what, why, "use `method='exact'`")) from None
    x = _refined(lu, matrix, lu.solve(right), right, remainder)
    rest = matrix.residual(x, right, remainder)
    _check_range(matrix, x, rest, rows)
    left = lu.solve(rest)  # remaining error, refined once below
    more = lu.solve(matrix.residual(left, rest, np.zeros_like(rest)))
    # rounding errors of the residuals in twice the precision and of the last solution
    terms = matrix.size(x)
    hidden = 16 * UNIT_ROUNDOFF**2 * terms + 16 * UNIT_ROUNDOFF * matrix.size(more)
    reach, spread = np.hsplit(_error_bound(lu, np.hstack([hidden, terms])), 2)
    _check_digits(lu, matrix, np.abs(x), spread)
    # equation (24) with A^-1 r' refined once; the factor 2 covers the rounding errors of that solution
    estimate = 2 * (np.abs(left) + np.abs(more)) + UNIT_ROUNDOFF * np.abs(x) + reach
    residual = np.divide(np.abs(rest), terms, out=np.zeros_like(rest), where=terms > 0)
    # component-wise condition numbers |A^-1| |A| |x| / |x|; the numerator is exact if the inverse was computed
    condition: dict[str, float] = {}
    if len(x) <= _INVERTED:
        size, at = np.abs(x[:, 0]), matrix.at
        numbers = np.divide(spread[:, 0], size, out=np.full_like(size, np.inf), where=size != 0).tolist()
        condition = {link: numbers[at[link]] if link in at else float("inf") for link in system.links}
    return FloatSpeeds(
        _with_frame(system, matrix, x),
        _with_frame(system, matrix, estimate),
        labelled_array(residual, row=[row.label for row in rows], case=[str(case) for case in range(x.shape[1])]),
        condition,
    )


def _refined(lu: Any, matrix: PaddedRows, x: Floats, right: Floats, remainder: Floats) -> Floats:
    """Return the solution after iterative refinement by equation (23) of docs/theory.md."""
    last = 1.0
    for _ in range(_STEPS):
        step = lu.solve(matrix.residual(x, right, remainder))
        x = x + step
        # prescribed speeds remain exact, although each step is rounded
        matrix.prescribe(x, right)
        moved = np.max(np.divide(np.abs(step), np.abs(x), out=np.zeros_like(x), where=x != 0), initial=0.0)
        # steps shrink by a constant factor, so the remaining error is about moved * moved / last
        if not UNIT_ROUNDOFF * last < moved**2 <= (last / 2) ** 2:
            break
        last = moved
    return x


def _error_bound(lu: Any, error: Floats) -> Floats:
    """Return the maximum change |A^-1| error of each speed if the equations have errors of any sign. For more than 400
    links, it is estimated by four times the root mean square over errors with random signs and magnitudes.
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
    """Return the matrix for factorisation, which has one row for each moving link, and the equations of its rows.
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
    """Return an array with one row for each link in the order of the declaration; the row of the frame is 0."""
    at = next(at for at, link in enumerate(system.links) if link not in matrix.at)
    return labelled_array(
        np.insert(values, at, 0, axis=0), link=system.links, case=[str(case) for case in range(values.shape[1])]
    )


def _right_hand_sides(
    rows: Sequence[WillisEquation], inputs: Mapping[str, Sequence[float]] | None
) -> list[list[Fraction]]:
    """Return the right-hand side of every row, with one number for each set of input speeds [the train's unit of
    speed].
    """
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
    """Raise `RangeError` if the solution overflows or underflows. One mesh changes a speed by a factor of at most 1e12,
    so a speed that underflows to 0 has neighbours that are too small.
    """
    far = ((x != 0) & (np.abs(np.frexp(x)[1]) > _LARGEST_EXPONENT)).any(axis=1)
    # a row whose links are all nearly at rest is compared with the fastest link of the train
    limit = np.maximum(matrix.size(x), np.abs(matrix.coefficients).sum(axis=1)[:, None] * np.abs(x).max())
    # breakdown of the factors; negated `<=`, so that nan counts as wrong
    wrong = (~(np.abs(rest) <= 1e-6 * limit)).any(axis=1)
    if far.any():
        raise RangeError(_out_of_range(list(matrix.at)[int(np.argmax(far))]))
    if wrong.any():
        raise RangeError(_out_of_range(rows[int(np.argmax(wrong))].label))


def _check_digits(lu: Any, matrix: PaddedRows, speeds: Floats, spread: Floats) -> None:
    """Raise `RangeError` if the factors may have no correct digit, because a bound on the spectral radius of |A^-1| |A|
    exceeds 1 / (4 eps). `speeds` is |x|, and `spread` is |A^-1| |A| |x|, computed with the factors.
    """
    # The spectral radius is the condition number of the system if the units of speed are chosen optimally for each link
    # (Bauer 1963). For any positive vector v, it is at most the maximum of |A^-1| |A| v / v (Collatz and Wielandt), and
    # power iteration from |x| lowers this bound. If the factors are wrong, it remains above the limit.
    for _ in range(_ITERATIONS):
        condition = np.divide(spread, speeds, out=np.where(spread == 0, 0.0, np.inf), where=speeds > 0)
        if (condition <= _LARGEST_CONDITION).all():
            return
        speeds, spread = spread, _error_bound(lu, matrix.size(spread))
    at = int(np.argmax(condition.max(axis=1)))
    what = f"no digit of the speed of '{list(matrix.at)[at]}' is correct in float64"
    why = f"rounding errors of the equations are amplified more than {_LARGEST_CONDITION:.0e} times"
    raise RangeError(Problem(what, why, "use `method='exact'`"))


def _out_of_range(label: str) -> Problem:
    return Problem(
        f"a speed near '{label}' is too small or too large for floating-point numbers",
        "speeds and ratios must be between 1e-120 and 1e120, so that their rounding errors can be bounded",
        "use `method='exact'`",
    )
