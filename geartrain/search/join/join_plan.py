"""In which order a join sets its items: a tree, because what is set may part the rest into pieces that do not meet.

Two outputs that share wheels no longer know each other once the shared wheels are set: their own wheels are then
counted each by themselves, for each distinct setting of what they share, and the counts multiplied.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import inf, isinf, log, prod

import numpy as np

from geartrain.numerics.arrays import Floats, Ints
from geartrain.numerics.bounded_polynomials import BoundedQuotient, products_of
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.search.constraints.count_conditions import Condition, CountConstraint, CountEquation
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import Domains, ItemRecipe, Weights, forecast
from geartrain.search.join.wheel_monomials import (
    Function,
    Interval,
    IntervalConstraint,
    extent,
    find_polynomial_constraints,
    find_recipes,
    find_wheel_monomials,
    quotients,
)

Items = frozenset[int]


@dataclass(frozen=True, slots=True)
class PlanNode:
    """One item of the plan, set when all above it are."""

    item: int
    """Which."""
    interface: tuple[int, ...]
    """Items above that this node or one below it looks at."""
    guide: int
    """The constraint that says which values to look at; -1: all."""
    checks: tuple[int, ...]
    """Further constraints that are complete with this item, in the order they are asked."""
    prunes: tuple[int, ...]
    """Polynomial constraints of which two or more items are open yet: rows that they surely refuse end here."""
    children: tuple[PlanNode, ...]
    """What is set next; no two of them share a constraint."""
    reach: tuple[int, ...]
    """All constraints of this node and those below."""

    def decided(self) -> Iterator[int]:
        """The constraints that are complete with this node, then with those below."""
        if self.guide >= 0:
            yield self.guide
        yield from self.checks
        for child in self.children:
            yield from child.decided()

    def below(self) -> Iterator[int]:
        """The items of this node and of those below."""
        yield self.item
        for child in self.children:
            yield from child.below()


@dataclass(frozen=True)
class JoinProblem:
    """Everything a worker needs to know of a join. Plain data and rules: it can be pickled."""

    domains: Domains
    """Wheel -> its counts, ascending."""
    requested: tuple[IntervalConstraint, ...]
    rules: tuple[CountConstraint, ...]
    """Constraints on counts; these, then `requested`, are numbered in this order."""
    late: tuple[CountConstraint, ...]
    """Rules that are asked last, of assignments of all wheels."""
    recipes: tuple[ItemRecipe, ...]
    """The items."""
    plan: PlanNode
    """The tree; its root is the first item."""
    steps: float
    """About how many partial assignments the join will look at."""
    weights: Weights = field(default_factory=dict)
    """Wheel -> a whole weight for each count, where assignments are weighed and not counted."""

    @cached_property
    def polynomial_constraints(self) -> tuple[PolynomialConstraint, ...]:
        """The demands in items."""
        return tuple(find_polynomial_constraints(self.requested, self.recipes, self.domains))

    @property
    def wheels(self) -> tuple[str, ...]:
        """The wheels in the order declared."""
        return tuple(self.domains)

    @property
    def total(self) -> int:
        """The weight of all assignments there are: their number, where each counts once."""
        return prod(sum(self.weights.get(wheel, (1,) * len(counts))) for wheel, counts in self.domains.items())

    @property
    def order(self) -> tuple[int, ...]:
        """The constraints in the order in which they are decided, the late rules last."""
        found = list(self.plan.decided())
        return (*found, *(at for at in range(len(self.reasons)) if at not in found))

    @property
    def reasons(self) -> tuple[str, ...]:
        """Names of the constraints, the late rules at the end."""
        return tuple(one.name for one in (*self.rules, *self.polynomial_constraints, *self.late))


def find_join_problem(
    domains: Domains,
    requested: Sequence[IntervalConstraint],
    rules: Sequence[CountConstraint],
    chances: Mapping[str, float],
    weights: Weights | None = None,
) -> JoinProblem:
    """The cheapest question found: which wheels to bundle, which rules to ask late, in which order to set items.

    chances   name of a rule or demand -> about which part of all assignments meets it
    weights   of `JoinProblem`
    """
    found = [
        _planned(domains, requested, early, late, recipes, chances)
        for early, late in _lateness(rules)
        for recipes in find_recipes(
            find_wheel_monomials(tuple(domains), requested, frozenset(w for rule in early for w in rule.wheels)),
            domains,
        )
    ]
    return replace(min(found, key=lambda question: question.steps), weights=weights or {})


def _lateness(
    rules: Sequence[CountConstraint],
) -> Iterator[tuple[tuple[CountConstraint, ...], tuple[CountConstraint, ...]]]:
    """Ways to part rules into those asked while wheels are set and those asked at the end."""
    equations = tuple(rule for rule in rules if isinstance(rule, CountEquation))
    conditions = tuple(rule for rule in rules if isinstance(rule, Condition))
    # a rule asked while wheels are set makes them items of their own, which may cost more than it saves
    yield tuple(rules), ()
    if conditions:
        yield equations, conditions
    if equations:
        yield (), tuple(rules)


def _planned(
    domains: Domains,
    requested: Sequence[IntervalConstraint],
    early: tuple[CountConstraint, ...],
    late: tuple[CountConstraint, ...],
    recipes: tuple[ItemRecipe, ...],
    chances: Mapping[str, float],
) -> JoinProblem:
    polynomials = find_polynomial_constraints(requested, recipes, domains)
    planner = _Planner(domains, recipes, early, polynomials, chances)
    node, steps = min((planner.plan(*way) for way in planner.ways()), key=lambda found: found[1])
    steps += sum(planner.sizes)
    steps += sum(forecast(side, domains)[1] / 4 for recipe in recipes for side in (recipe.top, recipe.bottom))
    if late:
        left = prod(len(counts) for counts in domains.values())
        steps += 3 * left * prod(chances.get(one.name, 1.0) for one in (*early, *polynomials))
    return JoinProblem(domains, tuple(requested), early, late, recipes, node, steps)


@dataclass
class _Planner:
    """Grows plans, and forecasts what they cost in partial assignments looked at."""

    domains: Domains
    recipes: Sequence[ItemRecipe]
    rules: Sequence[CountConstraint]
    polynomial_constraints: Sequence[PolynomialConstraint]
    chances: Mapping[str, float]
    sizes: list[int] = field(init=False)
    scopes: list[Items] = field(init=False)
    likely: list[float] = field(init=False)

    def __post_init__(self) -> None:
        self.sizes = [quotients(recipe.top, recipe.bottom, self.domains) for recipe in self.recipes]
        at = {wheel: item for item, recipe in enumerate(self.recipes) for wheel in recipe.wheels}
        self.scopes = [frozenset(at[wheel] for wheel in rule.wheels) for rule in self.rules]
        self.scopes += [frozenset(one.items) for one in self.polynomial_constraints]
        self.likely = [self.chances.get(one.name, 1.0) for one in (*self.rules, *self.polynomial_constraints)]

    def ways(self) -> Iterator[tuple[int, bool]]:
        """Which constraint to complete first, and whether items in many constraints come before small ones."""
        order = sorted(range(len(self.scopes)), key=lambda one: (len(self.scopes[one]), one))
        # six first constraints and two orders of items are tried: planning stays at milliseconds
        yield from product(order[:6] or [-1], (True, False))

    def plan(self, first: int, shared: bool) -> tuple[PlanNode, float]:
        """The tree over all items, and its cost."""
        node, cost = self._grow(frozenset(range(len(self.recipes))), frozenset(), 1.0, first, shared)
        # demands that came down to numbers are asked at the root
        converged = tuple(at for at, scope in enumerate(self.scopes) if not scope)
        return replace(node, checks=converged + node.checks, reach=converged + node.reach), cost

    def _grow(self, open_: Items, known: Items, rows: float, first: int, shared: bool) -> tuple[PlanNode, float]:
        active = [at for at, scope in enumerate(self.scopes) if scope & open_]
        item = self._next(open_, active, first, shared)
        complete = [at for at in active if self.scopes[at] & open_ == {item}]
        guide = self._guide(item, complete)
        checks = [at for at in complete if at != guide]
        interface = sorted({other for at in active for other in self.scopes[at] & known})
        rows = min(rows, prod(self.sizes[other] for other in interface))
        looked = rows * self.sizes[item] * (self._share(item, guide) if guide >= 0 else 1.0)
        kept = looked * prod((self.likely[at] for at in checks), start=1.0)
        rest = open_ - {item}
        children, cost = [], rows + (looked if rest or checks or guide < 0 else 0)
        for part in joined_groups(sorted(rest), (self.scopes[at] for at in active)):
            # less than one row is expected where guesses are rough: never so few that what follows looks free
            child, more = self._grow(frozenset(part), known | {item}, max(kept, 1e-3), first, shared)
            children.append(child)
            cost += more
        children.sort(key=lambda child: len(list(child.below())))
        prunes = [at for at in active if len(self.scopes[at] & open_) > 1 and at >= len(self.rules)]
        node = PlanNode(
            item, tuple(interface), guide, tuple(checks), tuple(prunes), tuple(children), tuple(sorted(active))
        )
        return node, cost

    def _share(self, item: int, guide: int) -> float:
        """Which part of an item's values its guide leaves."""
        return 1 / self.sizes[item] if guide < len(self.rules) else self.likely[guide]

    def _next(self, open_: Items, active: Sequence[int], first: int, shared: bool) -> int:
        """The item to set next: one that an equation gives, else one of the constraint that is cheapest to complete."""
        for at in active:
            left = self.scopes[at] & open_
            if at < len(self.rules) and len(left) == 1 and isinstance(self.rules[at], CountEquation):
                return next(iter(left))
        if not active:
            return min(open_)
        focus = first if first in active else min(active, key=lambda at: (self._growth(at, open_), at))

        def rank(item: int) -> tuple[int, int, int]:
            touching = sum(item in self.scopes[at] for at in active)
            return -touching if shared else 0, self.sizes[item], item

        return min(self.scopes[focus] & open_, key=rank)

    def _growth(self, at: int, open_: Items) -> float:
        return prod(self.sizes[item] for item in self.scopes[at] & open_) * self.likely[at]

    def _guide(self, item: int, complete: Sequence[int]) -> int:
        """The equation that gives the item, else the most selective polynomial constraint with windows in it."""
        for at in complete:
            if at < len(self.rules) and isinstance(self.rules[at], CountEquation):
                return at
        opening = [
            at
            for at in complete
            if at >= len(self.rules) and self.polynomial_constraints[at - len(self.rules)].opens(item)
        ]
        return min(opening, key=lambda at: self.likely[at], default=-1)


def extents(question: JoinProblem) -> list[tuple[float, float]]:
    """Least and greatest value of each item."""
    return [extent(recipe, question.domains) for recipe in question.recipes]


# Which part of all assignments meets a demand or a rule, about: it steers a search, and decides nothing.


_DRAWN = 4096  # assignments
_NEIGHBOURS = 40  # values; a share of fewer hits than these is too rough to steer by
_EXACT = 1e-7  # the width, in logarithms, that one exact value stands for


@dataclass(frozen=True, slots=True)
class SelectivitySample:
    """Assignments drawn at random, always the same ones."""

    domains: Domains
    columns: Mapping[str, Ints]
    """Wheel -> counts, (drawn,)."""

    @classmethod
    def of(cls, domains: Domains) -> SelectivitySample:
        """Draw them."""
        draw = np.random.default_rng(0)
        return cls(domains, {wheel: draw.choice(np.array(counts), _DRAWN) for wheel, counts in domains.items()})

    def of_rule(self, rule: CountConstraint) -> float:
        """About which part meets a rule."""
        if isinstance(rule, CountEquation):
            return 1 / max(len(self.domains[wheel]) for wheel in rule.wheels)
        return max(float(rule.holds(self.columns).mean()), 1 / _DRAWN)

    def of_demand(self, requested: IntervalConstraint) -> float:
        """About which part meets a demand; from the density of values nearby where few are drawn within."""
        speeds = self.speeds(requested.function)
        minimum = 1 / prod(len(self.domains[wheel]) for wheel in requested.function.wheels)
        return min(1.0, max(minimum, sum(_part(speeds, interval) for interval in requested.intervals)))

    def speeds(self, function: Function) -> Floats:
        """Values of a function, those it has not left out."""
        quotient = BoundedQuotient.of(function.numerator, function.denominator, [1] * len(function.wheels))
        values, _ = quotient(products_of([self.columns[wheel].astype(np.float64) for wheel in function.wheels]))
        values = np.broadcast_to(values, _DRAWN)
        return np.asarray(values[np.isfinite(values)])


def _rough(value: Fraction) -> float:
    """The number in float64; infinite where it is too large."""
    number = as_float(value)
    if number is None:
        number = 0.0 if abs(value) < 1 else inf if value > 0 else -inf
    return number


def _part(speeds: Floats, interval: Interval) -> float:
    low = -inf if interval[0] is None else _rough(interval[0])
    high = inf if interval[1] is None else _rough(interval[1])
    within = float(((speeds >= low) & (speeds <= high)).mean()) if len(speeds) else 1.0
    if within * len(speeds) >= _NEIGHBOURS or low <= 0 <= high or not len(speeds):
        return within
    # by the distance to the nearest few, in logarithms: ratios are spread evenly there, more or less
    side = np.log(speeds[speeds > 0] if low > 0 else -speeds[speeds < 0])
    if len(side) < _NEIGHBOURS or isinf(low) or isinf(high):
        return within
    ends = sorted((log(abs(low)), log(abs(high))))
    near = np.sort(np.abs(side - sum(ends) / 2))[_NEIGHBOURS - 1]
    # of many equal values the nearest few may be no distance away
    density = _NEIGHBOURS / _DRAWN / (2 * max(near, 1e-12))
    return float(min(density * max(ends[1] - ends[0], _EXACT), 1.0))
