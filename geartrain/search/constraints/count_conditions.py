"""Constraints on tooth counts: linear equations, and conditions that reject candidates.

Centre distances are weighted sums of tooth counts. Conditions with sines of angles are evaluated in floating point, and
again with fifty digits if the magnitude of the result does not exceed its error bound.
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
    from geartrain.kinematics.buildability.equal_planets import AssemblyMesh, CountRef
    from geartrain.numerics.arrays import Bools, Ints

_DIGITS = 70  # fifty are needed; the others absorb the rounding of sums and powers
_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803")
_NEAR = 1e-7  # relative to the terms: bound of the float error, which a root of a difference increases
_EQUAL = Decimal("1e-25")  # relative to the terms: values that agree to 25 digits are equal

CandidateColumns = Mapping[str, "Ints"]
"""Tooth counts of many candidates, keyed by wheel; int64 arrays of equal length."""


CandidateTest = Callable[[CandidateColumns], "Bools"]
"""Predicate on candidates. It is a `functools.partial` that lacks only its last argument, so that it can be pickled.

It returns whether each candidate passes, shape (candidates,).
"""


@dataclass(frozen=True, slots=True)
class CountEquation:
    """Linear equation of tooth counts: the sum of all tooth counts, each multiplied by its coefficient, plus a constant
    is 0.
    """

    name: str
    """Name of the constraint in reports."""
    coefficients: Mapping[str, int]
    """Non-zero integer coefficient of each varied wheel; contains at least one wheel."""
    constant: int
    """Constant term of the equation, which is the contribution of the wheels with fixed tooth counts."""

    @property
    def wheels(self) -> tuple[str, ...]:
        """Ids of the varied wheels in the equation."""
        return tuple(self.coefficients)

    def holds(self, columns: CandidateColumns) -> Bools:
        """Return whether each candidate satisfies the equation, shape (candidates,). Sums above 2^63 overflow."""
        total = sum(factor * columns[wheel] for wheel, factor in self.coefficients.items())
        return np.asarray(total == -self.constant)

    def solve_for(self, wheel: str, columns: CandidateColumns) -> tuple[Ints, Bools]:
        """Return the tooth count of one wheel, computed from the tooth counts of the other wheels, and whether the
        result is an integer.

        Both arrays have shape (candidates,), or (1,) if the equation has only one wheel. `columns` need not include
        `wheel`. The tooth count may be 0 or negative. It is rounded down if it is not an integer.
        """
        others = [factor * columns[name] for name, factor in self.coefficients.items() if name != wheel]
        total = reduce(np.add, others, np.array(self.constant, dtype=np.int64))
        count, rest = np.divmod(np.atleast_1d(-total), self.coefficients[wheel])
        return np.asarray(count, dtype=np.int64), np.asarray(rest == 0)


@dataclass(frozen=True, slots=True)
class Condition:
    """Constraint on tooth counts that can only be tested for given tooth counts. Unlike a `CountEquation`, it does not
    determine the tooth count of a wheel from the tooth counts of the other wheels.
    """

    name: str
    """Name of the constraint in reports. Several conditions may have the same name."""
    wheels: tuple[str, ...]
    """Ids of the varied wheels in the condition, at least one."""
    test: CandidateTest
    """Predicate that returns whether each candidate satisfies the condition."""

    def holds(self, columns: CandidateColumns) -> Bools:
        """Return whether each candidate satisfies the condition, as a read-only array of shape (candidates,). `columns`
        must include the wheels of the condition.
        """
        return np.broadcast_to(self.test(columns), columns[self.wheels[0]].shape)


CountConstraint = CountEquation | Condition
"""Constraint on tooth counts, with the attributes `name` and `wheels` and the method `holds`."""


def counts_of(columns: CandidateColumns, part: CountRef) -> Ints:
    """Return the tooth counts of one wheel for all candidates: its column if `part` is the id of a varied wheel, or
    `part` itself if it is a fixed tooth count.
    """
    return columns[part] if isinstance(part, str) else np.asarray(part, dtype=np.int64)


def free_of(*parts: CountRef) -> tuple[str, ...]:
    """Return the distinct ids of varied wheels in `parts`, in order of occurrence. All other elements of `parts` are
    fixed tooth counts.
    """
    return tuple(dict.fromkeys(part for part in parts if isinstance(part, str)))


# --------------------------------------------------------------------------------------- weighted sums of tooth counts


@dataclass(frozen=True, slots=True)
class LinearSum:
    """Weighted sum of the tooth counts of varied wheels, plus a constant. No weight is 0."""

    terms: Mapping[str, Fraction]
    constant: Fraction = Fraction(0)

    @classmethod
    def of(cls, parts: Iterable[tuple[Fraction | int, CountRef]]) -> LinearSum:
        """Return the sum of weight * part over all given pairs (weight, part), where a part is the id of a varied wheel
        or a fixed tooth count.
        """
        total = cls({})
        for weight, part in parts:
            total += cls({part: Fraction(weight)}) if isinstance(part, str) else cls({}, Fraction(weight * part))
        return total

    def __add__(self, other: LinearSum) -> LinearSum:
        terms = dict(self.terms)
        for wheel, weight in other.terms.items():
            terms[wheel] = terms.get(wheel, Fraction(0)) + weight
        return LinearSum({wheel: weight for wheel, weight in terms.items() if weight}, self.constant + other.constant)

    def __sub__(self, other: LinearSum) -> LinearSum:
        return self + other.times(-1)

    def times(self, factor: Fraction | int) -> LinearSum:
        """Return the sum multiplied by a factor other than 0."""
        return LinearSum({wheel: weight * factor for wheel, weight in self.terms.items()}, self.constant * factor)

    def plus(self, number: Fraction | int) -> LinearSum:
        """Return the sum with a number added to its constant."""
        return LinearSum(self.terms, self.constant + number)


@dataclass(frozen=True, slots=True)
class WholeSum:
    """Weighted sum of the tooth counts of varied wheels, plus a constant. All weights and the constant are integers."""

    terms: tuple[tuple[str, int], ...]
    constant: int

    @property
    def wheels(self) -> tuple[str, ...]:
        """Ids of the varied wheels in the sum."""
        return tuple(wheel for wheel, _ in self.terms)

    def of(self, columns: CandidateColumns) -> Ints:
        """Return the value of the sum for each candidate as an array of shape (candidates,), or of shape () if the sum
        has no varied wheel. Sums above 2^63 overflow.
        """
        total = np.asarray(self.constant, dtype=np.int64)
        for wheel, weight in self.terms:
            total = total + weight * columns[wheel]
        return np.asarray(total)


def whole(*sums: LinearSum) -> tuple[WholeSum, ...]:
    """Return all sums, multiplied by the smallest common positive factor for which their weights and constants are
    integers.
    """
    scale = lcm(*(number.denominator for one in sums for number in (*one.terms.values(), one.constant)))
    return tuple(
        WholeSum(tuple((wheel, int(weight * scale)) for wheel, weight in one.terms.items()), int(one.constant * scale))
        for one in sums
    )


def primitive_sum(one: LinearSum) -> WholeSum:
    """Return a sum multiplied by the factor for which its weights and its constant are coprime integers and its first
    weight is positive.
    """
    (found,) = whole(one)
    # the greatest common divisor of a zero sum is 0
    common = gcd(*(weight for _, weight in found.terms), found.constant) or 1
    if found.terms and found.terms[0][1] < 0:
        common = -common
    return WholeSum(tuple((wheel, weight // common) for wheel, weight in found.terms), found.constant // common)


def equality(one: WholeSum) -> str:
    """Return the equation "sum = 0" as text without minus signs, such as `s + 2 p = r`."""
    pieces = [(one.constant, str(abs(one.constant)))] if one.constant else []
    pieces += [(weight, f"{abs(weight)} {wheel}" if abs(weight) != 1 else wheel) for wheel, weight in one.terms]
    left, right = ([text for weight, text in pieces if weight * side > 0] for side in (1, -1))
    return f"{' + '.join(left) or '0'} = {' + '.join(right) or '0'}"


# ------------------------------------------------------------------------------------ conditions on counts and on sums


def is_between(total: WholeSum, minimum: float, maximum: float, columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether a sum of tooth counts is at least `minimum` and at most `maximum`."""
    found = total.of(columns)
    return np.asarray((found >= minimum) & (found <= maximum))


def are_coprime(first: CountRef, second: CountRef, columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether two tooth counts are coprime, so that every tooth of one wheel meets every
    tooth of the other (hunting tooth).
    """
    return np.asarray(np.gcd(counts_of(columns, first), counts_of(columns, second)) == 1)


def are_owned(numbers: Sequence[tuple[int, int]], used: Mapping[str, int], columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether no tooth count is used for more wheels than are available with this tooth
    count.

    numbers   pairs (tooth count, number of available wheels with this tooth count)
    used      number of wheels, such as the copies of a planet, that have the tooth count of each varied wheel
    """
    total = {count: sum((columns[wheel] == count) * pieces for wheel, pieces in used.items()) for count, _ in numbers}
    return np.asarray(np.all([total[count] <= most for count, most in numbers], axis=0))


def is_different(wheel: str, others: Sequence[CountRef], columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether the tooth count of a wheel differs from all tooth counts in `others`."""
    return np.asarray(np.all([columns[wheel] != counts_of(columns, other) for other in others], axis=0))


def distance_of(mesh: AssemblyMesh) -> LinearSum:
    """Return twice the centre distance of a spur gear pair as a sum of tooth counts, in the unit of the module. Both
    wheels must have the same module.
    """
    assert mesh.module is not None
    return LinearSum.of(mesh.terms).times(mesh.module)


# -------------------------------------------------- comparisons with sines, to fifty digits where floats cannot decide


Kernel = Callable[..., Sequence[Any]]
"""Function `kernel(root, *numbers)` that returns the terms of a clearance. The numbers are arrays of floats, or
decimals.

The argument `root` is the square-root function for the number type; it returns 0 for negative arguments.
"""


def decimal(number: Fraction | int) -> Decimal:
    """Convert a fraction to a decimal that is correct to at least fifty significant digits."""
    with localcontext(prec=_DIGITS):
        return Decimal(Fraction(number).numerator) / Decimal(Fraction(number).denominator)


def sine(turns: Fraction) -> Decimal:
    """Return the sine of an angle [turn] from -1 to 1 to fifty digits, by its power series."""
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
    """Return the cosine of an angle [turn], which must be from -1 to 3/4, to fifty digits."""
    return sine(turns + Fraction(1, 4))


def is_positive(kernel: Kernel, counts: Sequence[Ints], constants: Sequence[Decimal], strictly: bool) -> Bools:
    """Return, for each candidate, whether the sum of the numbers that the function `kernel` returns is positive (if
    `strictly` is True) or non-negative (if it is False).

    counts      arguments of `kernel` that differ between candidates: integer arrays that broadcast to (candidates,)
    constants   arguments of `kernel` that are the same for all candidates

    The sum is evaluated in floating point, and again with fifty digits where the floating-point result is near 0.
    """
    columns = np.broadcast_arrays(*counts)
    floats = (column.astype(float) for column in columns)
    terms = kernel(lambda square: np.sqrt(np.maximum(square, 0.0)), *floats, *map(float, constants))
    margin, scale = sum(terms), sum(map(np.abs, terms))
    found = np.broadcast_to(margin > 0, columns[0].shape).copy()
    # the float result is within its error bound of 0
    for at in np.flatnonzero(np.broadcast_to(np.abs(margin) <= _NEAR * scale, found.shape)):
        with localcontext(prec=_DIGITS):
            exact = (Decimal(int(column.flat[at])) for column in columns)
            digits = kernel(lambda square: max(square, Decimal(0)).sqrt(), *exact, *constants)
            total, bound = sum(digits, Decimal(0)), _EQUAL * sum(map(abs, digits), Decimal(0))
            found.flat[at] = total > bound if strictly else total >= -bound
    return found
