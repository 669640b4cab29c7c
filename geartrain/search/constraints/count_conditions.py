"""Constraints on tooth counts: linear equations, and conditions that reject candidates.

Centre distances are weighted sums of tooth counts. Conditions with sines of angles are evaluated in floats, and with
fifty digits if the result in floats is within its error bound of 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import reduce
from math import gcd, lcm
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.kinematics.buildability.equal_planets import AssemblyMesh, CountRef
    from geartrain.numerics.arrays import Bools, Ints

_DIGITS = 70  # fifty are needed; the others absorb the rounding of sums and powers
_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803")
_NEAR = 1e-7  # relative to the terms: bound of the float error, which a root of a difference increases
_EQUAL = Decimal("1e-25")  # relative to the terms: values that agree to 25 digits are equal

CandidateColumns = Mapping[str, "Ints"]
"""Tooth counts of many candidates by wheel, int64 arrays of equal length."""


CandidateTest = Callable[[CandidateColumns], "Bools"]
"""Predicate on candidates: a `functools.partial` that lacks only its last argument, so that it can be pickled.

It returns whether each candidate passes, shape (candidates,).
"""


@dataclass(frozen=True, slots=True)
class CountEquation:
    """Linear equation of tooth counts: the sum of coefficients times counts, plus a constant, is 0."""

    name: str
    """Description of the constraint in reports."""
    coefficients: Mapping[str, int]
    """Nonzero integer coefficient of each varied wheel; at least one wheel."""
    constant: int
    """Constant term of the equation, contributed by the wheels with fixed counts."""

    @property
    def wheels(self) -> tuple[str, ...]:
        """Varied wheels of the equation."""
        return tuple(self.coefficients)

    def left(self, columns: CandidateColumns) -> Ints:
        """Return the left side of the equation, shape (candidates,); 0 if it is satisfied. Sums above 2^63 overflow."""
        terms = [factor * columns[wheel] for wheel, factor in self.coefficients.items()]
        return np.asarray(reduce(np.add, terms) + self.constant, dtype=np.int64)

    def holds(self, columns: CandidateColumns) -> Bools:
        """Return whether each candidate satisfies the equation, shape (candidates,)."""
        return np.asarray(self.left(columns) == 0)

    def solve_for(self, wheel: str, columns: CandidateColumns) -> tuple[Ints, Bools]:
        """Return the count of one wheel from the counts of the other wheels, and whether it is an integer.

        Both arrays have shape (candidates,), or (1,) if the equation has only one wheel. `columns` need not include
        `wheel`. The count may be 0 or negative, and is rounded down if it is not an integer.
        """
        others = [factor * columns[name] for name, factor in self.coefficients.items() if name != wheel]
        total = reduce(np.add, others, np.array(self.constant, dtype=np.int64))
        count, rest = np.divmod(np.atleast_1d(-total), self.coefficients[wheel])
        return np.asarray(count, dtype=np.int64), np.asarray(rest == 0)


@dataclass(frozen=True, slots=True)
class Condition:
    """Constraint that can be tested but not solved for the count of a wheel."""

    name: str
    """Description of the constraint in reports; several conditions may share it."""
    wheels: tuple[str, ...]
    """Varied wheels of the condition, at least one."""
    test: CandidateTest
    """Predicate that returns whether each candidate satisfies the condition."""

    def holds(self, columns: CandidateColumns) -> Bools:
        """Return whether each candidate satisfies the condition, shape (candidates,), read-only.

        Columns of other wheels are ignored.
        """
        return np.broadcast_to(self.test(columns), columns[self.wheels[0]].shape)


CountConstraint = CountEquation | Condition
"""Constraint on tooth counts, with the attributes `name` and `wheels` and the method `holds`."""


def counts_of(columns: CandidateColumns, part: CountRef) -> Ints:
    """Return the counts of a wheel for all candidates: its column if it is varied, otherwise its fixed count."""
    return columns[part] if isinstance(part, str) else np.asarray(part, dtype=np.int64)


def free_of(*parts: CountRef) -> tuple[str, ...]:
    """Return the distinct ids of the varied wheels in a list of wheel ids and fixed counts, in order."""
    return tuple(dict.fromkeys(part for part in parts if isinstance(part, str)))


# --------------------------------------------------------------------------------------- weighted sums of tooth counts


@dataclass(frozen=True, slots=True)
class LinearSum:
    """Sum of weights times counts over varied wheels, plus a constant. Weights are never 0."""

    terms: Mapping[str, Fraction]
    constant: Fraction = Fraction(0)

    @classmethod
    def of(cls, parts: Iterable[tuple[Fraction | int, CountRef]]) -> LinearSum:
        """Build the sum of weights times parts, where a part is the id of a varied wheel or a fixed count."""
        total = cls({})
        for weight, part in parts:
            total = total + (
                cls({part: Fraction(weight)}) if isinstance(part, str) else cls({}, Fraction(weight * part))
            )
        return total

    def __add__(self, other: LinearSum) -> LinearSum:
        terms = dict(self.terms)
        for wheel, weight in other.terms.items():
            terms[wheel] = terms.get(wheel, Fraction(0)) + weight
        return LinearSum({wheel: weight for wheel, weight in terms.items() if weight}, self.constant + other.constant)

    def __sub__(self, other: LinearSum) -> LinearSum:
        return self + other.times(-1)

    def times(self, factor: Fraction | int) -> LinearSum:
        """Return the sum multiplied by a factor."""
        if not factor:
            return LinearSum({})
        return LinearSum({wheel: weight * factor for wheel, weight in self.terms.items()}, self.constant * factor)

    def plus(self, number: Fraction | int) -> LinearSum:
        """Return the sum with a number added to its constant."""
        return LinearSum(self.terms, self.constant + number)


@dataclass(frozen=True, slots=True)
class WholeSum:
    """Sum of integer weights times counts over varied wheels, plus an integer constant."""

    terms: tuple[tuple[str, int], ...]
    constant: int

    @property
    def wheels(self) -> tuple[str, ...]:
        """Varied wheels of the sum."""
        return tuple(wheel for wheel, _ in self.terms)

    def of(self, columns: CandidateColumns) -> Ints:
        """Return the values of the sum, shape (candidates,), or one number if it has no varied wheel. Sums above 2^63
        overflow.
        """
        total = np.asarray(self.constant, dtype=np.int64)
        for wheel, weight in self.terms:
            total = total + weight * columns[wheel]
        return np.asarray(total)


def whole(*sums: LinearSum) -> tuple[WholeSum, ...]:
    """Multiply several sums by the smallest common positive factor that makes all their weights integers."""
    scale = lcm(*(number.denominator for one in sums for number in (*one.terms.values(), one.constant)))
    return tuple(
        WholeSum(tuple((wheel, int(weight * scale)) for wheel, weight in one.terms.items()), int(one.constant * scale))
        for one in sums
    )


def plainest(one: LinearSum) -> WholeSum:
    """Return the multiple of a sum whose weights and constant are coprime integers and whose first weight is
    positive.
    """
    (found,) = whole(one)
    # the greatest common divisor of a zero sum is 0
    common = gcd(*(weight for _, weight in found.terms), found.constant) or 1
    if found.terms and found.terms[0][1] < 0:
        common = -common
    return WholeSum(tuple((wheel, weight // common) for wheel, weight in found.terms), found.constant // common)


def equality(one: WholeSum) -> str:
    """Format the equation that a sum is 0, without minus signs: `s + 2 p = r`."""
    pieces = [(one.constant, str(abs(one.constant)))] if one.constant else []
    pieces += [(weight, f"{abs(weight)} {wheel}" if abs(weight) != 1 else wheel) for wheel, weight in one.terms]
    left, right = ([text for weight, text in pieces if weight * side > 0] for side in (1, -1))
    return f"{' + '.join(left) or '0'} = {' + '.join(right) or '0'}"


# ------------------------------------------------------------------------------------ conditions on counts and on sums


def is_bounded(wheel: str, minimum: int, most: int, columns: CandidateColumns) -> Bools:
    """Return whether the tooth count of a wheel is from `minimum` to `most`, both inclusive."""
    return np.asarray((columns[wheel] >= minimum) & (columns[wheel] <= most))


def are_coprime(first: CountRef, second: CountRef, columns: CandidateColumns) -> Bools:
    """Return whether two counts are coprime, so that every tooth meets every tooth of its mate (hunting tooth)."""
    return np.asarray(np.gcd(counts_of(columns, first), counts_of(columns, second)) == 1)


def are_owned(numbers: Sequence[tuple[int, int]], used: Mapping[str, int], columns: CandidateColumns) -> Bools:
    """Return whether each candidate uses at most the given number of wheels of each count.

    numbers   tooth counts, and the number of wheels of each
    used      number of equal wheels that each varied wheel represents
    """
    total = {count: sum((columns[wheel] == count) * pieces for wheel, pieces in used.items()) for count, _ in numbers}
    return np.asarray(np.all([total[count] <= most for count, most in numbers], axis=0))


def is_different(wheel: str, others: Sequence[CountRef], columns: CandidateColumns) -> Bools:
    """Return whether the tooth count of a wheel differs from all other counts."""
    return np.asarray(np.all([columns[wheel] != counts_of(columns, other) for other in others], axis=0))


def is_near_zero(total: WholeSum, most: int, columns: CandidateColumns) -> Bools:
    """Return whether the absolute value of a sum of counts is at most `most`."""
    return np.asarray(np.abs(total.of(columns)) <= most)


def teeth_of(mesh: AssemblyMesh) -> LinearSum:
    """Return twice the centre distance of a spur pair [modules]."""
    return LinearSum.of(mesh.terms)


def distance_of(mesh: AssemblyMesh) -> LinearSum:
    """Return twice the centre distance of a spur pair whose wheels have the same module [m; dimensionless if the module
    has no unit].
    """
    assert mesh.module is not None
    return teeth_of(mesh).times(mesh.module)


# -------------------------------------------------- comparisons with sines, to fifty digits where floats cannot decide


Kernel = Callable[..., Sequence[Any]]
"""Function `kernel(root, *numbers)` that returns the terms of a clearance, for arrays of floats or for decimals.

`root` is the square root of the number type, with 0 for negative arguments.
"""


def decimal(number: Fraction | int) -> Decimal:
    """Convert a fraction to a decimal, correct to at least fifty digits."""
    with localcontext(prec=_DIGITS):
        return Decimal(Fraction(number).numerator) / Decimal(Fraction(number).denominator)


def sine(turns: Fraction) -> Decimal:
    """Return the sine of an angle from -1 to 1 turns to fifty digits, by its power series."""
    with localcontext(prec=_DIGITS):
        x = 2 * _PI * decimal(turns)
        term = total = x
        order = 1
        # alternating series: the error is below the first omitted term
        while abs(term) > Decimal(10) ** -_DIGITS:
            order += 2
            term = -term * x * x / (order * (order - 1))
            total += term
        return total


def cosine(turns: Fraction) -> Decimal:
    """Return the cosine of an angle from -1 to 3/4 turns to fifty digits."""
    return sine(turns + Fraction(1, 4))


def is_positive(kernel: Kernel, counts: Sequence[Ints], constants: Sequence[Decimal], strictly: bool) -> Bools:
    """Return, for each candidate, whether the sum of the terms of a kernel is positive (if `strictly`), or
    non-negative.

    counts     integers, arrays that broadcast to one shape, (candidates,)
    constants  numbers that are the same for all candidates

    The sum is evaluated in floats, and with fifty digits where the result in floats is near 0. Terms may include roots
    of differences of products.
    """
    spread = np.broadcast_arrays(*counts)
    terms = kernel(_root, *(column.astype(float) for column in spread), *map(float, constants))
    margin, scale = _total(terms), _total([np.abs(term) for term in terms])
    found = np.broadcast_to(margin > 0, spread[0].shape).copy()
    # the float result is within its error bound of 0
    for at in np.flatnonzero(np.broadcast_to(np.abs(margin) <= _NEAR * scale, found.shape)):
        found.flat[at] = _decide(kernel, [int(column.flat[at]) for column in spread], constants, strictly)
    return found


def _root(square: Any) -> NDArray[np.float64]:
    return np.asarray(np.sqrt(np.maximum(np.asarray(square, dtype=float), 0.0)))


def _decimal_root(square: Decimal) -> Decimal:
    return max(square, Decimal(0)).sqrt()


def _total(terms: Sequence[Any]) -> NDArray[np.float64]:
    return np.asarray(sum(terms), dtype=float)


def _decide(kernel: Kernel, counts: Sequence[int], constants: Sequence[Decimal], strictly: bool) -> bool:
    with localcontext(prec=_DIGITS):
        terms = kernel(_decimal_root, *map(Decimal, counts), *constants)
        total, scale = sum(terms, Decimal(0)), sum(map(abs, terms), Decimal(0))
        return bool(total > scale * _EQUAL if strictly else total >= -scale * _EQUAL)
