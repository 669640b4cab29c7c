"""Which part of all assignments meets a demand or a rule, about: it steers a search, and decides nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import inf, isinf, log, prod

import numpy as np

from geartrain.numerics.arrays import Floats, Ints
from geartrain.numerics.bounded_polynomials import BoundedQuotient, products_of
from geartrain.numerics.exact import as_float
from geartrain.synthesis.constraints.count_conditions import CountConstraint, CountEquation
from geartrain.synthesis.join.product_lists import Domains
from geartrain.synthesis.join.wheel_monomials import Function, Interval, IntervalConstraint

_DRAWN = 4096  # assignments
_NEIGHBOURS = 40  # values; a share of fewer hits than these is too rough to steer by
_EXACT = 1e-7  # the width, in logarithms, that one exact value stands for


@dataclass(frozen=True, slots=True)
class SelectivitySample:
    """Assignments drawn at random, always the same ones.

    columns   wheel -> counts, (drawn,)
    """

    domains: Domains
    columns: Mapping[str, Ints]

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

    def of_demand(self, asked: IntervalConstraint) -> float:
        """About which part meets a demand; from the density of values nearby where few are drawn within."""
        speeds = self.speeds(asked.function)
        least = 1 / prod(len(self.domains[wheel]) for wheel in asked.function.wheels)
        return min(1.0, max(least, sum(_part(speeds, interval) for interval in asked.intervals)))

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
