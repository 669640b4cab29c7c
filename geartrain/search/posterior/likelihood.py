"""Whether combinations fit what is known: floats decide where their error allows it, integers where it does not."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.formulas import Formula
from geartrain.kinematics.formulas.laurent import Term
from geartrain.numerics.arrays import Bools, Floats
from geartrain.numerics.bounded_polynomials import BoundedPolynomial, BoundedQuotient, in_range
from geartrain.numerics.exact import as_float, log10
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import Domains
from geartrain.search.join.wheel_monomials import Interval, IntervalConstraint, find_polynomial_constraints
from geartrain.search.posterior.monomial_columns import (
    Key,
    MonomialColumns,
    Powers,
    ProductPlan,
    find_product_plan,
    recipe_of,
)
from geartrain.search.posterior.observations import Observation, ObservedOutput


@dataclass(frozen=True, eq=False)
class FormulaValues:
    """A formula seen through monomials: each of them is part of one of its groups, or of none.

    quotient   None where floats may overflow, so that nothing can be said of their error
    plan       its products in few multiplications
    """

    quotient: BoundedQuotient | None
    plan: ProductPlan

    @classmethod
    def of(cls, formula: Formula, monomials: Sequence[Powers], domains: Domains) -> FormulaValues:
        """Compile a formula."""
        largest = [log10(Fraction(max(domains[wheel]))) for wheel in formula.wheels]
        if not formula.denominator or not in_range((*formula.numerator, *formula.denominator), largest):
            return cls(None, {})
        alone = len(formula.denominator) == 1
        scale, below = formula.denominator[0] if alone else (1, (0,) * len(formula.wheels))
        rounded = [2 * sum(map(abs, one.values())) + 7 for one in monomials]

        def made(terms: Sequence[Term]) -> BoundedPolynomial:
            pairs = []
            for coefficient, powers in terms:
                exponents = dict(zip(formula.wheels, map(int.__sub__, powers, below), strict=True))
                pairs.append((coefficient, _key(exponents, monomials)))
            return BoundedPolynomial.of(pairs, scale, rounded)

        quotient = BoundedQuotient(made(formula.numerator), None if alone else made(formula.denominator))
        sides = (quotient.upper,) if quotient.lower is None else (quotient.upper, quotient.lower)
        return cls(quotient, find_product_plan(key for side in sides for _, key in side.terms))

    @property
    def relative(self) -> float | None:
        """A bound on the relative error of every value; None where that depends on the row."""
        return None if self.quotient is None else self.quotient.relative

    def __call__(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Floats, Floats | None]:
        """Values at some rows, and bounds on their errors where `relative` is None: infinite where no digit is sure.

        plan   of many formulas at once; default its own
        """
        known = rows.values.get(self)
        if known is None:
            value, room = self._worked_out(rows, self.plan if plan is None else plan)
            known = _filled(value, rows.size), None if room is None else _filled(room, rows.size)
            rows.values[self] = known
        return known

    def bounded(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Floats, Floats]:
        """Values, and bounds on their errors in any case."""
        value, room = self(rows, plan)
        return value, (self.relative or 0) * np.abs(value) if room is None else room

    def _worked_out(self, rows: MonomialColumns, plan: ProductPlan) -> tuple[Floats, Floats | None]:
        if self.quotient is None:
            return np.zeros(()), np.full((), np.inf)
        return self.quotient(lambda key: rows.product(key, plan))


def _filled(values: Floats, size: int) -> Floats:
    return values if values.ndim else np.full(size, float(values))


def _key(exponents: Mapping[str, int], monomials: Sequence[Powers]) -> Key:
    """A monomial in wheels as a product of items."""
    found = []
    for item, powers in enumerate(monomials):
        wheel, power = next(iter(powers.items()))
        if exponents.get(wheel, 0):
            found.append((item, exponents[wheel] // power))
    return tuple(found)


class OutputLikelihood:
    """One witness before many combinations, seen through given monomials.

    witness   whose claims are judged
    soft      False: claims hold or not; True: they agree more or less, up to `FAR` tolerances
    value     its formula, where that is compiled already
    """

    def __init__(
        self,
        witness: ObservedOutput,
        monomials: Sequence[Powers],
        domains: Domains,
        soft: bool,
        value: FormulaValues | None = None,
    ) -> None:
        self.value = value or FormulaValues.of(witness.formula, monomials, domains)
        asked = witness.asked(soft)
        self._folded, self._ends = _folded(() if asked is None else asked.intervals)
        self._gate = None if asked is None else ExactConstraint(asked, monomials, domains)
        self._poles = ExactConstraint(
            IntervalConstraint(witness.name, witness.formula, ((None, None),)), monomials, domains
        )
        self._misfit = misfit_of(witness)

    def judge(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Bools, Floats]:
        """Which rows are in order, exactly; and their misfit, sum of (error / tolerance)^2, to rounding."""
        value, room = self.value(rows, plan)
        met, doubtful = self._decided(value, room)
        unsure = np.flatnonzero(doubtful)
        if len(unsure):
            met[unsure] = (self._gate or self._poles).holds(rows.pick(unsure))
        misfit = np.full(rows.size, np.inf)
        some = np.flatnonzero(met)
        misfit[some] = self._misfit(value[some])
        return met, misfit

    def _decided(self, value: Floats, room: Floats | None) -> tuple[Bools, Bools]:
        """What floats say, and where they are so near an end that they may be wrong."""
        if self._gate is None:
            sure = np.isfinite(value if room is None else room)
            return sure, ~sure
        met: Bools = np.zeros(len(value), dtype=np.bool_)
        doubtful: Bools = np.zeros(len(value), dtype=np.bool_)
        size = np.abs(value) if self._folded else value
        for middle, half, edge in self._ends:
            gap = np.abs(size - middle)
            gap -= half
            met |= gap <= 0
            np.abs(gap, out=gap)
            # a value twice as large as an end is far from it, so that a relative error needs no look at the value
            near = edge + 4 * (self.value.relative or 0) * (abs(middle) + half) if room is None else edge + room
            doubtful |= ~(gap > near)
        return met, doubtful


def _folded(intervals: Sequence[Interval]) -> tuple[bool, list[tuple[float, float, float]]]:
    """Intervals as middle, half and rounding of their ends; True if only those of the magnitude are given."""
    mirrored = {(None if high is None else -high, None if low is None else -low) for low, high in intervals}
    fold = len(intervals) > 1 and mirrored == set(intervals)
    found = []
    for low, high in intervals:
        if fold and low is not None and low < 0:
            continue
        if low is None or high is None:  # a ray is settled with the exact numbers
            found.append((0.0, 0.0, np.inf))
            continue
        ends = float(max(abs(low), abs(high)))
        found.append((float((low + high) / 2), float((high - low) / 2), 8 * UNIT_ROUNDOFF * ends))
    return fold, found


@dataclass(frozen=True, slots=True)
class _Scale:
    """A claim in floats: what is wanted, and one over the tolerance below and above."""

    wanted: float
    signed: bool
    below: float
    above: float

    @classmethod
    def of(cls, claim: Observation) -> _Scale:
        halves = (claim.half(side) for side in (False, True))
        wanted, below, above = (as_float(each or Fraction(0)) for each in (claim.wanted, *halves))
        if wanted is None or below is None or above is None:
            what = f"'{claim.label}' asks for a speed beyond the range of float64"
            why = "how far counts are off is weighed in floats, which hold 1e-308 to 1e308"
            raise RangeError(Problem(what, why, "leave this output out, or give it an exact `expect`"))
        return cls(wanted, claim.signed, *(1 / half if half else 0.0 for half in (below, above)))

    def misfit(self, value: Floats) -> Floats:
        off = (value if self.signed else np.abs(value)) - self.wanted
        found: Floats = (off * np.where(off > 0, self.above, self.below)) ** 2
        return found


def misfit_of(witness: ObservedOutput) -> Callable[[Floats], Floats]:
    """What speeds of an output miss its claims by: the sum of (error / tolerance)^2, to rounding."""
    scales = [_Scale.of(claim) for claim in witness.claims if not claim.is_exact]

    def misfit(speeds: Floats) -> Floats:
        return sum((scale.misfit(speeds) for scale in scales), np.zeros(len(speeds)))

    return misfit


class ExactConstraint:
    """A demand that holds or does not, decided exactly."""

    def __init__(self, asked: IntervalConstraint, monomials: Sequence[Powers], domains: Domains) -> None:
        self._band: PolynomialConstraint = find_polynomial_constraints(
            [asked], [recipe_of(powers) for powers in monomials], domains
        )[0]

    def holds(self, rows: MonomialColumns) -> Bools:
        """Where it holds."""
        return self._band.holds(rows)
