"""The periods an orrery is to show, and how far each may be missed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.errors import Problem, QuestionError, RangeError

ROUNDING = 1e-12
"""Logarithms of periods and ratios, below 100 in magnitude, are right to better than this."""


@dataclass(frozen=True)
class PeriodTargets:
    """The periods wanted, in turns of the first arbor, and how far each may be missed.

    names       as asked
    periods     exact, positive
    tolerances  greatest relative error of each speed, exact, below 1
    """

    names: tuple[str, ...]
    periods: tuple[Fraction, ...]
    tolerances: tuple[Fraction, ...]

    @cached_property
    def bounds(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """Least and greatest period admitted, of each."""
        both = zip(self.periods, self.tolerances, strict=True)
        return tuple((period / (1 + slack), period / (1 - slack)) for period, slack in both)

    @cached_property
    def logs(self) -> tuple[tuple[float, float], ...]:
        """`bounds` as logarithms, wide enough for rounding."""
        return tuple((math.log(low) - ROUNDING, math.log(high) + ROUNDING) for low, high in self.bounds)

    @property
    def everything(self) -> int:
        """The set of all aims, as bits."""
        return (1 << len(self.periods)) - 1

    def meets(self, aim: int, ratio: Fraction) -> bool:
        """True if an arbor of this period shows aim number `aim`; exact."""
        low, high = self.bounds[aim]
        return low <= ratio <= high

    def error(self, aim: int, ratio: Fraction) -> Fraction:
        """Speed over wanted speed, less 1; positive is fast."""
        return self.periods[aim] / ratio - 1


def read_period_targets(
    periods: Mapping[str, Fraction], tolerance: Fraction | float | Mapping[str, Fraction | float]
) -> PeriodTargets:
    """Aims from periods by name and one tolerance for all or one for each."""
    if not periods:
        raise QuestionError(Problem("no periods are asked for", "an orrery shows at least one", "name one period"))
    if len(periods) > 30:
        raise RangeError(Problem(f"{len(periods)} periods", "the search keeps sets of up to 30", "split the orrery"))
    slack = tolerance if isinstance(tolerance, Mapping) else dict.fromkeys(periods, tolerance)
    problems = [
        Problem(f"period {name!r} is {value}", "a period is a positive number of turns", "give its magnitude")
        for name, value in periods.items()
        if value <= 0
    ]
    problems += [
        Problem(
            f"no usable tolerance for {name!r}: {slack.get(name)}",
            "a relative tolerance lies from 0 to below 1",
            "give for instance 1e-6",
        )
        for name in periods
        if not 0 <= slack.get(name, -1) < 1
    ]
    if problems:
        raise QuestionError(problems)
    return PeriodTargets(
        tuple(periods),
        tuple(Fraction(value) for value in periods.values()),
        tuple(Fraction(str(slack[name])) for name in periods),
    )


def members(bits: int) -> Iterator[int]:
    """The numbers in a set held as bits."""
    at = 0
    while bits >> at:
        if bits >> at & 1:
            yield at
        at += 1
