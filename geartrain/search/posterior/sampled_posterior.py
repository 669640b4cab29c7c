"""A sample of combinations: what every output does in each, whether it fits, and what all of them come to.

The structure is solved once, as formulas; each combination then costs a few multiplications an output. Combinations are
taken in blocks that fit the processor's cache. Sums are plain data that add up: tasks of any size, in any order.
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
"""Products of counts stay below this, so that they are exact in int64."""

BLOCK = 1 << 13
"""Combinations worked on at a time: 64 kB an array, so that a formula's columns stay in the processor's cache."""
_FEW = 0.5  # of the rows: where fewer are left, to copy them out costs less than to judge the others too


KEPT = 2000
"""Combinations that a task brings out to find the best; equals beyond are left out."""
TIE = 1 + 1e-9
"""Misfits in floats this near may be equal: which is less is decided later, exactly."""
Powers = Mapping[str, int]
"""Wheel -> its power in a monomial, never 0; powers of one monomial have no common divisor."""


Key = tuple[tuple[int, int], ...]
"""A product of powers of items: (item, power) pairs, items ascending, powers of either sign."""
ProductPlan = Mapping[Key, tuple[Key, Key]]
"""Product -> a shorter one that it holds, and what is still to be multiplied."""


class LikelihoodBatch:
    """A question put to arrays of counts.

    every    True: the speeds of all outputs are to be had too
    wheels   those that matter to a witness or to whether the train turns, in the order declared; with `every`, those
             of all outputs
    """

    def __init__(self, question: InferenceProblem, every: bool = False) -> None:
        self.question = question
        functions = [IntervalConstraint(witness.name, witness.formula, ()) for witness in question.witnesses]
        functions += question.conditions
        if every:
            functions += [IntervalConstraint(name, formula, ()) for name, formula in question.outputs.items()]
        moved = {wheel for one in functions for wheel in one.function.wheels}
        self.wheels = tuple(wheel for wheel in question.doubts if wheel in moved)
        self.domains = {wheel: question.doubts[wheel].counts for wheel in self.wheels}
        self.monomials = find_monomials(functions, self.domains)
        # formulas of few wheels first: they cost least, and what they refuse the others need not judge
        ordered = sorted(question.witnesses, key=lambda one: len(one.formula.wheels))
        outputs = question.outputs.items() if every else ()
        self._values = {name: FormulaValues.of(f, self.monomials, self.domains) for name, f in outputs}
        self._judges = [
            OutputLikelihood(one, self.monomials, self.domains, question.soft, self._values.get(one.name))
            for one in ordered
        ]
        self._gates = [exact_constraint(one, self.monomials, self.domains) for one in question.conditions]
        values = [*self._values.values(), *(judge.value for judge in self._judges)]
        self._plan = find_product_plan(key for value in values for key in value.plan)

    def columns(self, counts: Mapping[str, Ints]) -> MonomialColumns:
        """Some combinations: wheel -> counts, of one length, for all `wheels`."""
        return CombinationColumns(self.monomials, counts, len(next(iter(counts.values()))) if counts else 1)

    def turns(self, rows: MonomialColumns) -> Bools:
        """With which combinations the train turns at all."""
        found: Bools = np.ones(rows.size, dtype=np.bool_)
        for gate in self._gates:
            found &= gate.holds(rows)
        return found

    def judged(self, rows: MonomialColumns) -> tuple[Bools, Floats]:
        """Which combinations fit, exactly, and their misfit, to rounding; infinite where they do not.

        What one output refuses is not shown to the next, as soon as that saves work.
        """
        alive, total = np.arange(rows.size), np.zeros(rows.size)
        some = rows
        met = self.turns(rows)
        for judge in self._judges:
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
        """Output -> speeds, and bounds on their errors."""
        return {name: value.bounded(rows, self._plan) for name, value in self._values.items()}


class PosteriorTally:
    """Sums over combinations.

    examined    combinations
    turning   number of those with which the train turns
    weight    of those that fit: their number, or their degrees of agreement where that is asked for
    square    sum of squared degrees of agreement, for intervals
    by        for each wheel the weight of what fits with each of its counts
    sizes     sums of count x count', each from the wheel's `origin_of` on, weighted
    best      (misfit, indices of counts), best first
    ranked    False once equals had to be left out
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
        doubts = [batch.question.doubts[wheel] for wheel in batch.wheels]
        self._steps = [np.array(doubt.counts, dtype=np.float64) - origin_of(doubt) for doubt in doubts]

    def add(self, places: Mapping[str, Ints | int], misfit: Floats, weights: Any) -> None:
        """Rows that fit.

        places    wheel -> index of its count, one number for all rows or one for each
        misfit    of each row
        weights   of each row, whole numbers or floats
        """
        size = len(misfit)
        if not size:
            return
        at = [np.broadcast_to(places[wheel], (size,)) for wheel in self.batch.wheels]
        self.weight += plain_number(weights.sum())  # Python's own number: over many blocks int64 would not hold it
        self.square += float((weights.astype(np.float64) ** 2).sum())
        for sums, index in zip(self.by, at, strict=True):
            for choice in np.unique(index):
                sums[choice] += plain_number(weights[index == choice].sum())
        steps = np.array([own[index] for own, index in zip(self._steps, at, strict=True)])
        self.sizes += (steps * weights.astype(np.float64)) @ steps.T
        self._keep(misfit, at)

    def _keep(self, misfit: Floats, at: Sequence[Ints]) -> None:
        near = np.flatnonzero(misfit <= self._bar())
        order = near[np.argsort(misfit[near], kind="stable")[: KEPT + 1]]
        self.best += [(float(misfit[row]), tuple(int(index[row]) for index in at)) for row in order]
        self._trim()

    def _bar(self) -> float:
        return self.best[self.most - 1][0] * TIE if len(self.best) >= self.most else np.inf

    def _trim(self) -> None:
        self.best.sort()
        bar = self._bar()
        self.best = [one for one in self.best if one[0] <= bar]
        if len(self.best) > KEPT:
            self.ranked = False
            self.best = self.best[:KEPT]

    def join(self, other: Mapping[str, Any]) -> None:
        """Add what another tally came to."""
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
        """Plain data, for `join`."""
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
    """A sum as Python's own number, which does not overflow."""
    return float(value) if isinstance(value, float | np.floating) else int(value)


def origin_of(doubt: ToothCountPrior) -> int:
    """The count from which the others are reckoned, so that sums of products keep their digits: the likeliest."""
    return doubt.counts[doubt.weights.index(max(doubt.weights))]


def packed(question: InferenceProblem, most: int) -> bytes:
    """What all tasks share, as a worker takes it."""
    return pickle.dumps((question, most))


@lru_cache(maxsize=1)
def _unpacked(shared: bytes) -> tuple[LikelihoodBatch, int]:
    question, most = pickle.loads(shared)
    return LikelihoodBatch(question), most


def sample_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """Combinations drawn by their prior chances: task is the seed, the number of the block, and how many."""
    batch, most = _unpacked(shared)
    tally = PosteriorTally(batch, most)
    seed, block, size = task
    # a stream for each block: what is drawn does not depend on how blocks are shared out
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, block])))
    places = {}
    for wheel in batch.wheels:
        chances = np.array([float(prior) for prior in batch.question.doubts[wheel].priors])
        places[wheel] = draw.choice(len(chances), size, p=chances / chances.sum())
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


# ------------------------------------------- likelihood: floats decide where their error allows it, integers elsewhere


@dataclass(frozen=True, eq=False)
class FormulaValues:
    """A formula seen through monomials: each of them is part of one of its groups, or of none."""

    quotient: BoundedQuotient | None
    """None where floats may overflow, so that nothing can be said of their error."""
    plan: ProductPlan
    """Its products in few multiplications."""

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
        requested = witness.requested(soft)
        self._folded, self._ends = _folded(() if requested is None else requested.intervals)
        self._gate = None if requested is None else exact_constraint(requested, monomials, domains)
        self._poles = exact_constraint(
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


def exact_constraint(
    requested: IntervalConstraint, monomials: Sequence[Powers], domains: Domains
) -> PolynomialConstraint:
    """A demand that holds or does not, decided exactly."""
    (found,) = find_polynomial_constraints([requested], [recipe_of(powers) for powers in monomials], domains)
    return found


# ----------------------------------------- monomials of counts: columns of values, exact as quotients of whole numbers


class MonomialColumns(PartialAssignments):
    """Rows that hold the values of their items themselves, not places in a list.

    tops, bottoms   item -> (size,) int64, positive
    values          what was made of the rows, and by whom: values and bounds on their errors
    """

    __slots__ = ("_bottoms", "_products", "_tops", "values")

    def __init__(self, tops: Sequence[Ints], bottoms: Sequence[Ints], size: int) -> None:
        super().__init__((), {}, size)
        self._tops, self._bottoms = tops, bottoms
        self._products: dict[Key, Floats] = {}
        self.values: dict[object, tuple[Floats, Floats | None]] = {}

    def x(self, item: int) -> Floats:
        """Values of an item, float64: two conversions and one division, three roundings at most."""
        if item not in self._x:
            self._x[item] = self.top(item) / self.bottom(item)
        return self._x[item]

    def top(self, item: int) -> Ints:
        """Numerators of an item's values."""
        return self._tops[item]

    def bottom(self, item: int) -> Ints:
        """Denominators of an item's values."""
        return self._bottoms[item]

    def product(self, key: Key, plan: ProductPlan) -> Floats:
        """A product of items in float64: one rounding for each multiplication or division beside those of the items."""
        if key not in self._products:
            shorter, rest = plan.get(key, ((), key))
            found: Floats = self.product(shorter, plan) if shorter else np.ones(())
            for item, power in rest:
                for _ in range(abs(power)):
                    found = found * self.x(item) if power > 0 else found / self.x(item)
            self._products[key] = found
        return self._products[key]

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """Some rows, by mask or by index."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return MonomialColumns([one[where] for one in self._tops], [one[where] for one in self._bottoms], size)


class CombinationColumns(MonomialColumns):
    """Rows of counts: the monomials are multiplied out when they are asked for.

    monomials   the items
    counts      wheel -> (size,) counts
    """

    __slots__ = ("_counts", "_monomials")

    def __init__(self, monomials: Sequence[Powers], counts: Mapping[str, Ints], size: int) -> None:
        super().__init__((), (), size)
        self._monomials, self._counts = monomials, counts

    def x(self, item: int) -> Floats:
        """Values of an item: one rounding at most for each factor, and one for each conversion."""
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
                    side *= self._counts[wheel]  # in place: new arrays cost more than what is done with them
        bottom, top = sides
        top = np.ones(()) if top is None else top
        return top if bottom is None else np.divide(top, bottom, out=bottom)

    def top(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._whole(item, 1)

    def bottom(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._whole(item, -1)

    def _whole(self, item: int, sign: int) -> Ints:
        found = np.ones(self.size, dtype=np.int64)
        for wheel, power in self._monomials[item].items():
            for _ in range(max(power * sign, 0)):
                found = found * self._counts[wheel]
        return found

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """As of `MonomialColumns`."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return CombinationColumns(
            self._monomials, {wheel: column[where] for wheel, column in self._counts.items()}, size
        )


def find_product_plan(keys: Iterable[Key]) -> ProductPlan:
    """Products in few multiplications: each from the longest of the others that it holds."""
    plan: dict[Key, tuple[Key, Key]] = {}
    for key in sorted(dict.fromkeys(keys), key=lambda one: sum(abs(power) for _, power in one)):
        whole = dict(key)
        inside = [one for one in plan if all(_holds(whole.get(item, 0), power) for item, power in one)]
        longest = max(inside, key=lambda one: sum(abs(power) for _, power in one), default=())
        taken = dict(longest)
        rest = tuple((item, power - taken.get(item, 0)) for item, power in key if power != taken.get(item, 0))
        plan[key] = longest, rest
    return plan


def _holds(whole: int, power: int) -> bool:
    return 0 < power <= whole or whole <= power < 0


def recipe_of(powers: Powers) -> ItemRecipe:
    """A monomial as what is multiplied above and below."""
    above = tuple((wheel, power) for wheel, power in powers.items() if power > 0)
    return ItemRecipe(above, tuple((wheel, -power) for wheel, power in powers.items() if power < 0))


def find_monomials(requested: Sequence[IntervalConstraint], domains: Mapping[str, Sequence[int]]) -> tuple[Powers, ...]:
    """As few monomials as possible through which all functions see the wheels, each exact in int64.

    domains   the wheels in question; only those on which a function depends are in a monomial
    """
    moving = {wheel for one in requested for wheel in one.function.wheels}
    bundles = find_wheel_monomials([wheel for wheel in domains if wheel in moving], requested, frozenset())
    return tuple(part for bundle in bundles for part in _parts(bundle.powers, domains))


def primitive(powers: Powers) -> dict[str, int]:
    """Powers without their common divisor, the first positive."""
    common = math.gcd(*powers.values())
    common = common if next(iter(powers.values())) > 0 else -common
    return {wheel: power // common for wheel, power in powers.items()}


def _parts(powers: Powers, domains: Mapping[str, Sequence[int]]) -> Iterator[Powers]:
    """A monomial cut between wheels where its products would not fit int64."""
    held: dict[str, int] = {}
    for wheel in (wheel for wheel in domains if wheel in powers):
        both = {**held, wheel: powers[wheel]}
        if held and not fits(primitive(both), domains):
            yield primitive(held)
            both = {wheel: powers[wheel]}
        held = both
    yield primitive(held)


def fits(powers: Powers, domains: Mapping[str, Sequence[int]]) -> bool:
    """True if all values of a monomial, above and below, are exact in int64."""
    sizes = [1, 1]
    for wheel, power in powers.items():
        sizes[power > 0] *= max(domains[wheel]) ** abs(power)
    return max(sizes) < LARGEST
