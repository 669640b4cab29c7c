"""Random sample of combinations of tooth counts: speeds of outputs, likelihoods, and their sums.

The train is solved once, as formulas; each combination then costs a few multiplications per output. Combinations are
evaluated in blocks that fit into the processor cache. Sums are plain data that can be added, for tasks of any size and
in any order.
"""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.formulas import Formula
from geartrain.kinematics.formulas.laurent import Term
from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.bounded_polynomials import BoundedPolynomial, BoundedQuotient, in_range
from geartrain.numerics.exact import as_float, log10
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import Domains, ItemRecipe, PartialAssignments
from geartrain.search.join.wheel_monomials import (
    Interval,
    IntervalConstraint,
    find_polynomial_constraints,
    find_wheel_monomials,
)
from geartrain.search.posterior.inference_problem import InferenceProblem, Observation, ObservedOutput, ToothCountPrior

LARGEST = 1 << 62
"""Upper bound of products of tooth counts, below which they are exact in int64."""

BLOCK = 1 << 13
"""Number of combinations per block: 64 kB per array, so that the columns of a formula stay in the processor cache."""
_FEW = 0.5  # share of rows below which copying the remaining rows is cheaper than evaluating all


KEPT = 2000
"""Maximum number of best combinations that a task returns; further ties are omitted."""
TIE = 1 + 1e-9
"""Ratio of two misfits in floats below which they may be equal and are later compared exactly."""
Powers = Mapping[str, int]
"""Power of each wheel in a monomial, not 0; the powers of one monomial have no common divisor."""


Key = tuple[tuple[int, int], ...]
"""Product of powers of variables, as pairs (variable, power) with ascending variables and powers of either sign."""
ProductPlan = Mapping[Key, tuple[Key, Key]]
"""Factorisation of each product into a shorter product that divides it, and the remaining factor."""


class LikelihoodBatch:
    """Vectorised likelihood of an inference problem for arrays of tooth counts.

    every    True if the speeds of all outputs are also required
    wheels   wheels that an observed output or a condition depends on, with `every` also those of all outputs, in the
             order of declaration
    """

    def __init__(self, question: InferenceProblem, every: bool = False) -> None:
        self.question = question
        functions = [IntervalConstraint(witness.name, witness.formula, ()) for witness in question.witnesses]
        functions += question.conditions
        if every:
            functions += [IntervalConstraint(name, formula, ()) for name, formula in question.outputs.items()]
        moved = {wheel for one in functions for wheel in one.function.wheels}
        self.wheels = tuple(wheel for wheel in question.uncertainties if wheel in moved)
        self.domains = {wheel: question.uncertainties[wheel].counts for wheel in self.wheels}
        self.monomials = find_monomials(functions, self.domains)
        # formulas of few wheels first: they are cheap, and rows that they reject need no further evaluation
        ordered = sorted(question.witnesses, key=lambda one: len(one.formula.wheels))
        outputs = question.outputs.items() if every else ()
        self._values = {name: FormulaValues.of(f, self.monomials, self.domains) for name, f in outputs}
        self._likelihoods = [
            OutputLikelihood(one, self.monomials, self.domains, question.soft, self._values.get(one.name))
            for one in ordered
        ]
        self._conditions = [exact_constraint(one, self.monomials, self.domains) for one in question.conditions]
        values = [*self._values.values(), *(judge.value for judge in self._likelihoods)]
        self._plan = find_product_plan(key for value in values for key in value.plan)

    def columns(self, counts: Mapping[str, Ints]) -> MonomialColumns:
        """Return the columns for combinations that are given as counts of equal length for each wheel of `wheels`."""
        return CombinationColumns(self.monomials, counts, len(next(iter(counts.values()))) if counts else 1)

    def turns(self, rows: MonomialColumns) -> Bools:
        """Return whether the train turns, for each combination."""
        found: Bools = np.ones(rows.size, dtype=np.bool_)
        for gate in self._conditions:
            found &= gate.holds(rows)
        return found

    def judged(self, rows: MonomialColumns) -> tuple[Bools, Floats]:
        """Return whether each combination satisfies the observations, exactly, and its misfit up to rounding.

        The misfit is infinite for the others. Combinations that one output rejects are removed before the next output
        when this saves work.
        """
        alive, total = np.arange(rows.size), np.zeros(rows.size)
        some = rows
        met = self.turns(rows)
        for judge in self._likelihoods:
            if np.count_nonzero(met) < _FEW * some.size:
                kept = np.flatnonzero(met)
                if not len(kept):
                    break
                alive, some, met = alive[kept], some.pick(kept), met[kept]
            own, off = judge.judge(some, self._plan)
            met &= own
            total[alive] += off
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        found[alive] = met
        return found, np.where(found, total, np.inf)

    def speeds(self, rows: MonomialColumns) -> dict[str, tuple[Floats, Floats]]:
        """Return the speeds of each output, and upper bounds of their absolute errors."""
        return {name: value.bounded(rows, self._plan) for name, value in self._values.items()}


class PosteriorTally:
    """Sums over the combinations of a sample.

    examined  number of combinations
    turning   number of combinations with which the train turns
    weight    sum of the likelihoods
    square    sum of the squared likelihoods, for intervals
    by        sum of the likelihoods for each count of each wheel
    sizes     weighted sums of products of two counts, each relative to the `origin_of` its wheel
    best      pairs (misfit, indices of counts), ascending
    ranked    False if ties were omitted
    """

    def __init__(self, batch: LikelihoodBatch, most: int) -> None:
        self.batch, self.most = batch, most
        self.examined = self.turning = 0
        self.weight: Any = 0
        self.square = 0.0
        self.by: list[list[Any]] = [[0] * len(batch.domains[wheel]) for wheel in batch.wheels]
        self.sizes: Floats = np.zeros((len(batch.wheels), len(batch.wheels)))
        self.best: list[tuple[float, tuple[int, ...]]] = []
        self.ranked = True
        uncertainties = [batch.question.uncertainties[wheel] for wheel in batch.wheels]
        self._steps = [
            np.array(uncertainty.counts, dtype=np.float64) - origin_of(uncertainty) for uncertainty in uncertainties
        ]

    def add(self, places: Mapping[str, Ints | int], misfit: Floats, weights: Any) -> None:
        """Add combinations that satisfy the observations.

        places    index of the count of each wheel: one number for all combinations, or one for each
        misfit    misfit of each combination
        weights   likelihood of each combination, integers or floats
        """
        size = len(misfit)
        if not size:
            return
        at = [np.broadcast_to(places[wheel], (size,)) for wheel in self.batch.wheels]
        self.weight += plain_number(weights.sum())  # a Python integer: the sum of many blocks may exceed int64
        self.square += float((weights.astype(np.float64) ** 2).sum())
        for sums, index in zip(self.by, at, strict=True):
            for choice in np.unique(index):
                sums[choice] += plain_number(weights[index == choice].sum())
        steps = np.array([own[index] for own, index in zip(self._steps, at, strict=True)])
        self.sizes += (steps * weights.astype(np.float64)) @ steps.T
        self._keep(misfit, at)

    def _keep(self, misfit: Floats, at: Sequence[Ints]) -> None:
        near = np.flatnonzero(misfit <= self._threshold())  # candidates for the list of the best
        order = near[np.argsort(misfit[near], kind="stable")[: KEPT + 1]]
        self.best += [(float(misfit[row]), tuple(int(index[row]) for index in at)) for row in order]
        self._trim()

    def _threshold(self) -> float:
        return self.best[self.most - 1][0] * TIE if len(self.best) >= self.most else np.inf

    def _trim(self) -> None:
        self.best.sort()
        threshold = self._threshold()
        self.best = [one for one in self.best if one[0] <= threshold]
        if len(self.best) > KEPT:
            self.ranked = False
            self.best = self.best[:KEPT]

    def join(self, other: Mapping[str, Any]) -> None:
        """Add the sums of another tally."""
        self.examined += other["examined"]
        self.turning += other["turning"]
        self.weight += other["weight"]
        self.square += other["square"]
        self.by = [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(self.by, other["by"], strict=True)]
        self.sizes += np.array(other["sizes"]).reshape(self.sizes.shape)
        self.best += [(misfit, tuple(at)) for misfit, at in other["best"]]
        self.ranked &= other["ranked"]
        self._trim()

    def to_dict(self) -> dict[str, Any]:
        """Return the sums as plain data, for `join`."""
        return {
            "examined": self.examined,
            "turning": self.turning,
            "weight": plain_number(self.weight),
            "square": self.square,
            "by": [[plain_number(value) for value in sums] for sums in self.by],
            "sizes": self.sizes.tolist(),
            "best": [[misfit, list(at)] for misfit, at in self.best],
            "ranked": self.ranked,
        }


def plain_number(value: Any) -> int | float:
    """Convert a sum to a Python number, which cannot overflow."""
    return float(value) if isinstance(value, float | np.floating) else int(value)


def origin_of(uncertainty: ToothCountPrior) -> int:
    """Return the most probable count of a prior, relative to which sums of products lose no digits."""
    return uncertainty.counts[uncertainty.weights.index(max(uncertainty.weights))]


def packed(question: InferenceProblem, most: int) -> bytes:
    """Return the data that all tasks share, pickled."""
    return pickle.dumps((question, most))


@lru_cache(maxsize=1)
def _unpacked(shared: bytes) -> tuple[LikelihoodBatch, int]:
    question, most = pickle.loads(shared)
    return LikelihoodBatch(question), most


def sample_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """Draw combinations from their prior, and return the sums over them.

    task   random seed, number of the block, number of combinations
    """
    batch, most = _unpacked(shared)
    tally = PosteriorTally(batch, most)
    seed, block, size = task
    # an independent random stream for each block: the draws do not depend on the distribution of tasks
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, block])))
    places = {}
    for wheel in batch.wheels:
        probabilities = np.array([float(prior) for prior in batch.question.uncertainties[wheel].priors])
        places[wheel] = draw.choice(len(probabilities), size, p=probabilities / probabilities.sum())
    for start in range(0, size, BLOCK):
        here = {wheel: at[start : start + BLOCK] for wheel, at in places.items()}
        rows = batch.columns({wheel: np.array(batch.domains[wheel])[at] for wheel, at in here.items()})
        met, misfit = batch.judged(rows)
        tally.examined += rows.size
        tally.turning += int(batch.turns(rows).sum())
        fit = np.flatnonzero(met)
        weights = np.exp(-misfit[fit] / 2) if batch.question.soft else np.ones(len(fit), dtype=np.int64)
        tally.add({wheel: at[fit] for wheel, at in here.items()}, misfit[fit], weights)
    return tally.to_dict()


# ----------------------------------------- likelihood: floats decide if their error bound allows it, integers otherwise


@dataclass(frozen=True, eq=False)
class FormulaValues:
    """Formula of a speed, compiled to products of monomials."""

    quotient: BoundedQuotient | None
    """Formula with error bounds; None if floats may overflow, so that errors have no bound."""
    plan: ProductPlan
    """Plan that forms the products of the formula with few multiplications."""

    @classmethod
    def of(cls, formula: Formula, monomials: Sequence[Powers], domains: Domains) -> FormulaValues:
        """Compile a formula for given monomials."""
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
        """Upper bound of the relative error of every value; None if it depends on the row."""
        return None if self.quotient is None else self.quotient.relative

    def __call__(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Floats, Floats | None]:
        """Return the value at each row, and upper bounds of the absolute errors if `relative` is None.

        A bound is infinite if no digit is certain.

        plan   plan of many formulas at once; default the plan of this formula
        """
        known = rows.values.get(self)
        if known is None:
            value, room = self._evaluated(rows, self.plan if plan is None else plan)
            known = _filled(value, rows.size), None if room is None else _filled(room, rows.size)
            rows.values[self] = known
        return known

    def bounded(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Floats, Floats]:
        """Return the value at each row, and upper bounds of the absolute errors."""
        value, room = self(rows, plan)
        return value, (self.relative or 0) * np.abs(value) if room is None else room

    def _evaluated(self, rows: MonomialColumns, plan: ProductPlan) -> tuple[Floats, Floats | None]:
        if self.quotient is None:
            return np.zeros(()), np.full((), np.inf)
        return self.quotient(lambda key: rows.product(key, plan))


def _filled(values: Floats, size: int) -> Floats:
    return values if values.ndim else np.full(size, float(values))


def _key(exponents: Mapping[str, int], monomials: Sequence[Powers]) -> Key:
    found = []
    for item, powers in enumerate(monomials):
        wheel, power = next(iter(powers.items()))
        if exponents.get(wheel, 0):
            found.append((item, exponents[wheel] // power))
    return tuple(found)


class OutputLikelihood:
    """Likelihood of the observations of one output, for many combinations.

    witness   observed output
    soft      True for a Gaussian likelihood up to `FAR` tolerances, False for the likelihood 1 or 0
    value     compiled formula, if there is one
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
        requested = witness.requested(soft)
        self._interval_ends, self._ends = _interval_ends(() if requested is None else requested.intervals)
        self._gate = None if requested is None else exact_constraint(requested, monomials, domains)
        self._poles = exact_constraint(
            IntervalConstraint(witness.name, witness.formula, ((None, None),)), monomials, domains
        )
        self._misfit = misfit_of(witness)

    def judge(self, rows: MonomialColumns, plan: ProductPlan | None = None) -> tuple[Bools, Floats]:
        """Return whether each row satisfies the observations, exactly, and the misfits of the speeds up to rounding."""
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
        """Return the decisions in floats, and a mask of the rows so close to a bound that the decision may be wrong."""
        if self._gate is None:
            sure = np.isfinite(value if room is None else room)
            return sure, ~sure
        met: Bools = np.zeros(len(value), dtype=np.bool_)
        doubtful: Bools = np.zeros(len(value), dtype=np.bool_)
        size = np.abs(value) if self._interval_ends else value
        for middle, half, edge in self._ends:
            # distance from the middle of the interval, then from its ends
            gap = np.abs(size - middle)
            gap -= half
            met |= gap <= 0
            np.abs(gap, out=gap)
            # larger values are far from both ends, so the relative error is bounded at the ends only
            near = edge + 4 * (self.value.relative or 0) * (abs(middle) + half) if room is None else edge + room
            doubtful |= ~(gap > near)
        return met, doubtful


def _interval_ends(intervals: Sequence[Interval]) -> tuple[bool, list[tuple[float, float, float]]]:
    """Return whether the intervals bound only the magnitude, and each interval as (middle, half width, rounding
    error).
    """
    mirrored = {(None if high is None else -high, None if low is None else -low) for low, high in intervals}
    fold = len(intervals) > 1 and mirrored == set(intervals)
    found = []
    for low, high in intervals:
        if fold and low is not None and low < 0:
            continue
        if low is None or high is None:  # half-open intervals are decided by the exact constraint
            found.append((0.0, 0.0, np.inf))
            continue
        ends = float(max(abs(low), abs(high)))
        found.append((float((low + high) / 2), float((high - low) / 2), 8 * UNIT_ROUNDOFF * ends))
    return fold, found


@dataclass(frozen=True, slots=True)
class _Scale:
    """Observation in floats: observed speed, and reciprocal tolerances below and above it."""

    wanted: float
    signed: bool
    below: float
    above: float

    @classmethod
    def of(cls, claim: Observation) -> _Scale:
        halves = (claim.half(side) for side in (False, True))
        wanted, below, above = (as_float(each or Fraction(0)) for each in (claim.wanted, *halves))
        if wanted is None or below is None or above is None:
            what = f"'{claim.label}' is a speed beyond the range of float64"
            why = "misfits are computed in floats from 1e-308 to 1e308"
            raise RangeError(Problem(what, why, "omit this output, or give it an exact `expect`"))
        return cls(wanted, claim.signed, *(1 / half if half else 0.0 for half in (below, above)))

    def misfit(self, value: Floats) -> Floats:
        off = (value if self.signed else np.abs(value)) - self.wanted
        found: Floats = (off * np.where(off > 0, self.above, self.below)) ** 2
        return found


def misfit_of(witness: ObservedOutput) -> Callable[[Floats], Floats]:
    """Return a function from speeds of an output to their misfits, sums of (error / tolerance)^2, up to rounding."""
    scales = [_Scale.of(claim) for claim in witness.claims if not claim.is_exact]

    def misfit(speeds: Floats) -> Floats:
        return sum((scale.misfit(speeds) for scale in scales), np.zeros(len(speeds)))

    return misfit


def exact_constraint(
    requested: IntervalConstraint, monomials: Sequence[Powers], domains: Domains
) -> PolynomialConstraint:
    """Convert an interval constraint to polynomials in monomials, whose signs decide it exactly."""
    (found,) = find_polynomial_constraints([requested], [recipe_of(powers) for powers in monomials], domains)
    return found


# ----------------------------------------------- monomials of counts: columns of values, exact as quotients of integers


class MonomialColumns(PartialAssignments):
    """Rows that store the values of their variables instead of indices into lists.

    tops, bottoms   variable -> positive values, shape (size,) int64
    values          cached values of each function, with upper bounds of their errors
    """

    __slots__ = ("_bottoms", "_products", "_tops", "values")

    def __init__(self, tops: Sequence[Ints], bottoms: Sequence[Ints], size: int) -> None:
        super().__init__((), {}, size)
        self._tops, self._bottoms = tops, bottoms
        self._products: dict[Key, Floats] = {}
        self.values: dict[object, tuple[Floats, Floats | None]] = {}

    def x(self, item: int) -> Floats:
        """Return the values of a variable, float64 with at most three roundings: two conversions and one division."""
        if item not in self._x:
            self._x[item] = self.top(item) / self.bottom(item)
        return self._x[item]

    def top(self, item: int) -> Ints:
        """Return the numerators of the values of a variable."""
        return self._tops[item]

    def bottom(self, item: int) -> Ints:
        """Return the denominators of the values of a variable."""
        return self._bottoms[item]

    def product(self, key: Key, plan: ProductPlan) -> Floats:
        """Return a product of variables in float64, with one further rounding per multiplication or division."""
        if key not in self._products:
            shorter, rest = plan.get(key, ((), key))
            found: Floats = self.product(shorter, plan) if shorter else np.ones(())
            for item, power in rest:
                for _ in range(abs(power)):
                    found = found * self.x(item) if power > 0 else found / self.x(item)
            self._products[key] = found
        return self._products[key]

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """Return the rows selected by a mask or by indices."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return MonomialColumns([one[where] for one in self._tops], [one[where] for one in self._bottoms], size)


class CombinationColumns(MonomialColumns):
    """Rows of tooth counts, whose monomials are computed on demand.

    monomials   variables
    counts      wheel -> counts, shape (size,)
    """

    __slots__ = ("_counts", "_monomials")

    def __init__(self, monomials: Sequence[Powers], counts: Mapping[str, Ints], size: int) -> None:
        super().__init__((), (), size)
        self._monomials, self._counts = monomials, counts

    def x(self, item: int) -> Floats:
        """Return the values of a variable, with at most one rounding per factor and one per conversion."""
        if item not in self._x:
            self._x[item] = self._quotient(self._monomials[item])
        return self._x[item]

    def _quotient(self, powers: Powers) -> Floats:
        sides: list[Floats | None] = [None, None]
        for wheel, power in powers.items():
            for _ in range(abs(power)):
                side = sides[power > 0]
                if side is None:
                    sides[power > 0] = self._counts[wheel].astype(np.float64)
                else:
                    # in place, because allocating arrays costs more than the multiplication
                    side *= self._counts[wheel]
        bottom, top = sides
        top = np.ones(()) if top is None else top
        return top if bottom is None else np.divide(top, bottom, out=bottom)

    def top(self, item: int) -> Ints:
        """Return the numerators of the values of a variable."""
        return self._whole(item, 1)

    def bottom(self, item: int) -> Ints:
        """Return the denominators of the values of a variable."""
        return self._whole(item, -1)

    def _whole(self, item: int, sign: int) -> Ints:
        found = np.ones(self.size, dtype=np.int64)
        for wheel, power in self._monomials[item].items():
            for _ in range(max(power * sign, 0)):
                found = found * self._counts[wheel]
        return found

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """Return the rows selected by a mask or by indices."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return CombinationColumns(
            self._monomials, {wheel: column[where] for wheel, column in self._counts.items()}, size
        )


def find_product_plan(keys: Iterable[Key]) -> ProductPlan:
    """Plan products with few multiplications: each is formed from the longest other product that divides it."""
    plan: dict[Key, tuple[Key, Key]] = {}
    for key in sorted(dict.fromkeys(keys), key=lambda one: sum(abs(power) for _, power in one)):
        whole = dict(key)
        inside = [one for one in plan if all(_divides(whole.get(item, 0), power) for item, power in one)]
        longest = max(inside, key=lambda one: sum(abs(power) for _, power in one), default=())
        taken = dict(longest)
        rest = tuple((item, power - taken.get(item, 0)) for item, power in key if power != taken.get(item, 0))
        plan[key] = longest, rest
    return plan


def _divides(whole: int, power: int) -> bool:
    return 0 < power <= whole or whole <= power < 0


def recipe_of(powers: Powers) -> ItemRecipe:
    """Convert a monomial to the definition of a variable."""
    above = tuple((wheel, power) for wheel, power in powers.items() if power > 0)
    return ItemRecipe(above, tuple((wheel, -power) for wheel, power in powers.items() if power < 0))


def find_monomials(requested: Sequence[IntervalConstraint], domains: Mapping[str, Sequence[int]]) -> tuple[Powers, ...]:
    """Return the minimum number of monomials through which all functions depend on the wheels, each exact in int64.

    domains   possible counts of the wheels; wheels that no function depends on are in no monomial
    """
    moving = {wheel for one in requested for wheel in one.function.wheels}
    bundles = find_wheel_monomials([wheel for wheel in domains if wheel in moving], requested, frozenset())
    return tuple(part for bundle in bundles for part in _parts(bundle, domains))


def primitive(powers: Powers) -> dict[str, int]:
    """Return the powers divided by their common divisor, the first of them positive."""
    common = math.gcd(*powers.values())
    common = common if next(iter(powers.values())) > 0 else -common
    return {wheel: power // common for wheel, power in powers.items()}


def _parts(powers: Powers, domains: Mapping[str, Sequence[int]]) -> Iterator[Powers]:
    """Split a monomial into parts whose products of counts fit into int64."""
    held: dict[str, int] = {}
    for wheel in (wheel for wheel in domains if wheel in powers):
        both = {**held, wheel: powers[wheel]}
        if held and not fits(primitive(both), domains):
            yield primitive(held)
            both = {wheel: powers[wheel]}
        held = both
    yield primitive(held)


def fits(powers: Powers, domains: Mapping[str, Sequence[int]]) -> bool:
    """Return whether all numerators and denominators of a monomial are exact in int64."""
    sizes = [1, 1]
    for wheel, power in powers.items():
        sizes[power > 0] *= max(domains[wheel]) ** abs(power)
    return max(sizes) < LARGEST
