"""Order in which a join assigns its variables. It is a tree, because assigned variables separate the remaining
variables into independent parts.

Two outputs with common wheels are independent once the common wheels are assigned. The assignments of their other
wheels are then counted separately for each distinct assignment of the common wheels, and the two numbers are
multiplied.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from math import inf, isinf, log, prod

import numpy as np

from geartrain.numerics.arrays import Floats
from geartrain.numerics.bounded_polynomials import bounded_quotient, products_of
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.search.constraints.count_conditions import Condition, CountConstraint, CountEquation
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import Domains, Factors, Weights, forecast
from geartrain.search.join.wheel_monomials import (
    Interval,
    IntervalConstraint,
    find_polynomial_constraints,
    find_recipes,
    find_wheel_monomials,
)

Items = frozenset[int]


@dataclass(frozen=True, slots=True)
class PlanNode:
    """Node of a join plan. The node assigns one variable. The variables of its ancestors in the tree are assigned
    before.
    """

    item: int
    """Index of the variable that the node assigns."""
    interface: tuple[int, ...]
    """Indices of the variables that are assigned by ancestors of this node and on which a constraint of this node or of
    its subtree depends.
    """
    guide: int
    """Index of the constraint that selects the values of the variable to be examined; -1 if all values are examined."""
    checks: tuple[int, ...]
    """Indices of the constraints, other than the guide, whose last variable is assigned at this node; in the order of
    evaluation.
    """
    prunes: tuple[int, ...]
    """Indices of the polynomial constraints by which rows are pruned at this node. Each of them has at least two free
    variables.
    """
    children: tuple[PlanNode, ...]
    """Child nodes. No two of them have a common constraint."""

    def evaluated(self) -> Iterator[int]:
        """Yield the indices of the constraints that are evaluated at this node, and then of those that are evaluated at
        its descendants. A constraint is evaluated at the node that assigns its last variable.
        """
        if self.guide >= 0:
            yield self.guide
        yield from self.checks
        for child in self.children:
            yield from child.evaluated()


@dataclass(frozen=True)
class JoinProblem:
    """Complete description of a join: wheels with their admissible tooth counts, constraints, variables, and plan. It
    can be pickled and sent to worker processes.
    """

    domains: Domains
    """Admissible tooth counts of each wheel, in ascending order."""
    requested: tuple[IntervalConstraint, ...]
    """Constraints on the values of rational functions of the tooth counts."""
    rules: tuple[CountConstraint, ...]
    """Constraints on tooth counts. A constraint index refers to the sequence of `rules` followed by `requested`."""
    late: tuple[CountConstraint, ...]
    """Constraints on tooth counts that are evaluated last, when all wheels have a tooth count."""
    recipes: tuple[Factors, ...]
    """Definitions of the variables as products of tooth counts."""
    plan: PlanNode
    """Root of the plan. It assigns the first variable."""
    steps: float
    """Expected number of partial assignments that the join examines."""
    weights: Weights = field(default_factory=dict)
    """Integer weight of each tooth count, keyed by wheel; empty if assignments are counted instead of weighted."""

    @cached_property
    def polynomial_constraints(self) -> tuple[PolynomialConstraint, ...]:
        """Constraints of `requested` in terms of the variables, as polynomial constraints."""
        return tuple(find_polynomial_constraints(self.requested, self.recipes, self.domains))

    @property
    def wheels(self) -> tuple[str, ...]:
        """Names of the wheels in the order of declaration."""
        return tuple(self.domains)

    @property
    def total(self) -> int:
        """Total weight of all assignments before constraints are applied. It is their number if no weights are
        given.
        """
        return prod(sum(self.weights.get(wheel, (1,) * len(counts))) for wheel, counts in self.domains.items())

    @property
    def order(self) -> tuple[int, ...]:
        """Indices of all constraints in the order in which the join evaluates them. The indices of the constraints
        `late`, which are evaluated last, are at the end.
        """
        found = list(self.plan.evaluated())
        return (*found, *(at for at in range(len(self.constraint_names)) if at not in found))

    @property
    def constraint_names(self) -> tuple[str, ...]:
        """Names of all constraints in the order of their indices. They are reported as reasons for the rejection of
        assignments.
        """
        return tuple(one.name for one in (*self.rules, *self.polynomial_constraints, *self.late))


def find_join_problem(
    domains: Domains,
    requested: Sequence[IntervalConstraint],
    rules: Sequence[CountConstraint],
    weights: Weights | None = None,
    probabilities: Mapping[str, float] | None = None,
) -> JoinProblem:
    """Return the join problem whose plan has the minimum expected cost.

    The plans that are compared differ in the constraints that are evaluated last.

    weights         integer weights of tooth counts, as in `JoinProblem`
    probabilities   fraction of the assignments that satisfy a constraint, keyed by the name of the constraint; by
                    default it is estimated
    """
    equations = tuple(rule for rule in rules if isinstance(rule, CountEquation))
    conditions = tuple(rule for rule in rules if isinstance(rule, Condition))
    # a rule evaluated early makes its wheels separate variables, which may cost more than it saves
    choices: list[tuple[tuple[CountConstraint, ...], tuple[CountConstraint, ...]]] = [(tuple(rules), ())]
    if conditions:
        choices.append((equations, conditions))
    if equations:
        choices.append(((), tuple(rules)))
    if probabilities is None:
        probabilities = estimate_probabilities(domains, requested, rules)
    found = [_Planner(domains, requested, early, late, probabilities).problem() for early, late in choices]
    return replace(min(found, key=lambda question: question.steps), weights=weights or {})


class _Planner:
    """Search for the order in which a join assigns its variables (the plan). The constraints `early` are evaluated as
    soon as all their variables are assigned, and the constraints `late` after all other constraints.
    """

    def __init__(
        self,
        domains: Domains,
        requested: Sequence[IntervalConstraint],
        early: tuple[CountConstraint, ...],
        late: tuple[CountConstraint, ...],
        probabilities: Mapping[str, float],
    ) -> None:
        self.domains, self.requested, self.rules, self.late = domains, requested, early, late
        alone = frozenset(wheel for rule in early for wheel in rule.wheels)
        self.recipes = find_recipes(find_wheel_monomials(tuple(domains), requested, alone), domains)
        self.polynomial_constraints = find_polynomial_constraints(requested, self.recipes, domains)
        self.sizes = [forecast(recipe, domains)[0] for recipe in self.recipes]
        at = {wheel: item for item, recipe in enumerate(self.recipes) for wheel, _ in recipe}
        self.scopes: list[Items] = [frozenset(at[wheel] for wheel in rule.wheels) for rule in early]
        self.scopes += [frozenset(one.items) for one in self.polynomial_constraints]
        self.likely = [probabilities.get(one.name, 1.0) for one in (*early, *self.polynomial_constraints)]

    def problem(self) -> JoinProblem:
        """Return the join problem with the plan and the expected number of examined partial assignments."""
        plan, steps = self._grow(frozenset(range(len(self.recipes))), frozenset(), 1.0)
        # constraints without variables are evaluated at the root
        constant = tuple(at for at, scope in enumerate(self.scopes) if not scope)
        plan = replace(plan, checks=constant + plan.checks)
        steps += sum(self.sizes)
        steps += sum(forecast(recipe, self.domains)[1] / 4 for recipe in self.recipes)
        if self.late:
            left = prod(len(counts) for counts in self.domains.values())
            steps += 3 * left * prod(self.likely)
        return JoinProblem(self.domains, tuple(self.requested), self.rules, self.late, self.recipes, plan, steps)

    def _grow(self, open_: Items, known: Items, rows: float) -> tuple[PlanNode, float]:
        """Return the root of the plan for the variables `open_`, which are not yet assigned, and the expected number of
        partial assignments that the join examines to assign them.

        known   variables that are already assigned
        rows    expected number of partial assignments of these variables
        """
        active = [at for at, scope in enumerate(self.scopes) if scope & open_]
        item = self._next(open_, active)
        complete = [at for at in active if self.scopes[at] & open_ == {item}]
        guide = self._guide(item, complete)
        checks = [at for at in complete if at != guide]
        interface = sorted({other for at in active for other in self.scopes[at] & known})
        # equal rows on the interface are merged
        rows = min(rows, prod(self.sizes[other] for other in interface))
        examined = rows * self.sizes[item]
        if guide >= 0:
            # an equation selects one value
            examined *= 1 / self.sizes[item] if guide < len(self.rules) else self.likely[guide]
        kept = examined * prod((self.likely[at] for at in checks), start=1.0)
        rest = open_ - {item}
        children, cost = [], rows + (examined if rest or checks or guide < 0 else 0)
        parts = map(frozenset, joined_groups(sorted(rest), (self.scopes[at] for at in active)))
        # subtrees with few constraints first, because they are cheap and may reject rows early
        for part in sorted(parts, key=lambda part: sum(bool(self.scopes[at] & part) for at in active)):
            # a lower limit of the expected rows, because rough estimates would make later nodes appear free
            child, more = self._grow(part, known | {item}, max(kept, 1e-3))
            children.append(child)
            cost += more
        prunes = [at for at in active if len(self.scopes[at] & open_) > 1 and at >= len(self.rules)]
        return PlanNode(item, tuple(interface), guide, tuple(checks), tuple(prunes), tuple(children)), cost

    def _next(self, open_: Items, active: Sequence[int]) -> int:
        """Return the index of the variable that is assigned next: a variable that an equation determines, if there is
        one, or the variable that occurs in most constraints, among the unassigned variables of the constraint with the
        lowest cost.
        """
        for at in active:
            left = self.scopes[at] & open_
            if at < len(self.rules) and len(left) == 1 and isinstance(self.rules[at], CountEquation):
                return next(iter(left))
        if not active:
            return min(open_)

        def growth(at: int) -> float:
            return prod(self.sizes[item] for item in self.scopes[at] & open_) * self.likely[at]

        focus = min(active, key=lambda at: (growth(at), at))

        def rank(item: int) -> tuple[int, int, int]:
            touching = sum(item in self.scopes[at] for at in active)
            return -touching, self.sizes[item], item

        return min(self.scopes[focus] & open_, key=rank)

    def _guide(self, item: int, complete: Sequence[int]) -> int:
        """Return the index of an equation in `complete` that can be solved for variable `item`. If there is none,
        return the index of the most selective polynomial constraint in `complete` whose admissible values of the
        variable are index ranges; -1 if there is none either.
        """
        for at in complete:
            if at < len(self.rules) and isinstance(self.rules[at], CountEquation):
                return at
        opening = [
            at
            for at in complete
            if at >= len(self.rules) and self.polynomial_constraints[at - len(self.rules)].has_index_ranges(item)
        ]
        return min(opening, key=lambda at: self.likely[at], default=-1)


# Approximate share of the assignments that satisfy a constraint or rule. It affects the speed of a search only.


_DRAWN = 4096  # number of sampled assignments
_NEIGHBOURS = 40  # number of nearest values for a density; fewer hits give too rough an estimate
_EXACT = 1e-7  # width of an exact value in logarithms


def estimate_probabilities(
    domains: Domains, requested: Sequence[IntervalConstraint], rules: Sequence[CountConstraint]
) -> dict[str, float]:
    """Return an estimate of the fraction of assignments that satisfy each constraint, keyed by the name of the
    constraint. The estimates are based on a random sample of assignments.
    """
    # fixed seed, so that a plan and its tasks are reproducible
    draw = np.random.default_rng(0)
    columns = {wheel: draw.choice(np.array(counts), _DRAWN) for wheel, counts in domains.items()}
    found = {}
    for rule in rules:
        if isinstance(rule, CountEquation):
            # an equation fixes one count; a sample would contain too few solutions
            found[rule.name] = 1 / max(len(domains[wheel]) for wheel in rule.wheels)
        else:
            found[rule.name] = max(float(rule.holds(columns).mean()), 1 / _DRAWN)
    for one in requested:
        function = one.function
        product = products_of([columns[wheel].astype(np.float64) for wheel in function.wheels])
        values, _ = bounded_quotient(function.numerator, function.denominator, [1] * len(function.wheels), product)
        values = np.broadcast_to(values, _DRAWN)
        speeds = np.asarray(values[np.isfinite(values)])
        minimum = 1 / prod(len(domains[wheel]) for wheel in function.wheels)
        found[one.name] = min(1.0, max(minimum, sum(_interval_share(speeds, each) for each in one.intervals)))
    return found


def _as_float64(value: Fraction) -> float:
    """Convert a fraction to float64. The result is 0 or infinite if the fraction is out of range."""
    number = as_float(value)
    if number is None:
        number = 0.0 if abs(value) < 1 else inf if value > 0 else -inf
    return number


def _interval_share(speeds: Floats, interval: Interval) -> float:
    low = -inf if interval[0] is None else _as_float64(interval[0])
    high = inf if interval[1] is None else _as_float64(interval[1])
    within = float(((speeds >= low) & (speeds <= high)).mean()) if len(speeds) else 1.0
    if within * len(speeds) >= _NEIGHBOURS or low <= 0 <= high or not len(speeds):
        return within
    # from the distance to the nearest values in logarithms, where ratios are roughly uniform
    side = np.log(speeds[speeds > 0] if low > 0 else -speeds[speeds < 0])
    if len(side) < _NEIGHBOURS or isinf(low) or isinf(high):
        return within
    ends = sorted((log(abs(low)), log(abs(high))))
    near = np.sort(np.abs(side - sum(ends) / 2))[_NEIGHBOURS - 1]
    # for many equal values the distance of the nearest ones may be 0
    density = _NEIGHBOURS / _DRAWN / (2 * max(near, 1e-12))
    return float(min(density * max(ends[1] - ends[0], _EXACT), 1.0))
