"""What the outputs are known to do: claims on speeds, each with its tolerance, and how well a speed agrees."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from geartrain.kinematics.formulas import Formula
from geartrain.search.join.wheel_monomials import Interval, IntervalConstraint, is_within
from geartrain.search.train.output_requirements import SpeedRequirement, meet, of_either_sense

LikelihoodKind = Literal["all", "targets", "figures"]
LIKELIHOOD_KINDS: tuple[LikelihoodKind, ...] = ("all", "targets", "figures")
FAR = Fraction(5)
"""Where agreement is by degree: what is off by more tolerances than this is refused. It would weigh exp(-12.5)."""
_LINE: Interval = (None, None)


@dataclass(frozen=True, slots=True)
class Observation:
    """One thing known about an output's speed.

    label      in words, such as "speed 254/19 within 0.2 %"
    wanted     the speed, in the train's unit; positive where only the magnitude counts
    signed     False: only the magnitude counts
    intervals  where the speed (or its magnitude) may lie, closed; None stands for no bound
    """

    label: str
    wanted: Fraction
    signed: bool
    intervals: tuple[Interval, ...]

    @property
    def is_exact(self) -> bool:
        """True if one speed is allowed and no other."""
        return all(low == high for low, high in self.intervals)

    def scaled(self, factor: Fraction) -> Observation:
        """The claim with all tolerances multiplied by a factor."""
        if factor == 1:
            return self
        stretched = tuple((self._moved(low, factor), self._moved(high, factor)) for low, high in self.intervals)
        return replace(self, intervals=stretched)

    def _moved(self, end: Fraction | None, factor: Fraction) -> Fraction | None:
        return None if end is None else self.wanted + factor * (end - self.wanted)

    def half(self, above: bool) -> Fraction | None:
        """How far the speed may lie above or below what is wanted; None for any distance."""
        own = [each for each in self.intervals if is_within(self.wanted, (each,))]
        end = own[0][1 if above else 0] if own else None
        return None if end is None else abs(end - self.wanted)

    def met(self, speed: Fraction) -> bool:
        """True if a speed is in order."""
        value = speed if self.signed else abs(speed)
        return is_within(value, self.intervals)

    def misfit(self, speed: Fraction) -> Fraction:
        """(error / tolerance)^2; 0 without a bound on that side, and for an exact claim, which is met or not."""
        value = speed if self.signed else abs(speed)
        half = self.half(value > self.wanted)
        return ((value - self.wanted) / half) ** 2 if half else Fraction(0)

    def allowed(self) -> tuple[Interval, ...]:
        """The speeds that are in order, of either sense where only the magnitude counts."""
        if self.signed:
            return self.intervals
        ((low, high),) = self.intervals
        assert low is not None, "a target has a tolerance on both sides"
        assert high is not None, "a target has a tolerance on both sides"
        return of_either_sense(low, high)


@dataclass(frozen=True, slots=True)
class ObservedOutput:
    """An output of which something is known.

    name       of the output; "state: output" where several states are asked at once
    formula    its speed as a function of the wheels in doubt; of one or more of them
    claims     all hold at once; one at least
    """

    name: str
    formula: Formula
    claims: tuple[Observation, ...]

    @property
    def text(self) -> str:
        """The claims in words."""
        return "; ".join(claim.label for claim in self.claims)

    def fits(self, speed: Fraction | None) -> bool:
        """True if a speed meets every claim; a train that has no speed there does not."""
        return speed is not None and all(claim.met(speed) for claim in self.claims)

    def misfit(self, speed: Fraction) -> Fraction:
        """The sum over the claims of (error / tolerance)^2."""
        return sum((claim.misfit(speed) for claim in self.claims), Fraction(0))

    def asked(self, soft: bool) -> IntervalConstraint | None:
        """What must hold without doubt: every claim, where they are `soft` within `FAR` tolerances; None: nothing."""
        common: tuple[Interval, ...] = (_LINE,)
        for claim in self.claims:
            common = meet(common, (claim.scaled(FAR) if soft else claim).allowed())
        return None if common == (_LINE,) else IntervalConstraint(self.name, self.formula, common)

    def constraint(self, soft: bool, graded: bool) -> IntervalConstraint:
        """As `asked`, for a join: where every speed is in order it must have one. `graded`: how well it agrees, too."""
        return replace(self.asked(soft) or IntervalConstraint(self.name, self.formula, (_LINE,)), graded=graded)


def observations_of(
    demands: Sequence[SpeedRequirement], kind: LikelihoodKind, factor: Fraction = Fraction(1)
) -> tuple[Observation, ...]:
    """The demands on an output as claims; those on targets without a tolerance claim nothing.

    kind     "targets": without `expect` and `published`; "figures": only those; "all"
    factor   multiplies every tolerance
    """
    return tuple(claim.scaled(factor) for claim in _claims(demands, kind))


def _claims(demands: Sequence[SpeedRequirement], kind: LikelihoodKind) -> Iterator[Observation]:
    for demand in demands:
        if (
            demand.allowed is None
            or demand.approached
            or kind not in ("all", "targets" if demand.target else "figures")
        ):
            continue
        intervals = demand.allowed
        if not demand.signed:
            most = demand.allowed[-1][1]
            assert most is not None, "a target has a tolerance"
            intervals = ((2 * demand.wanted - most, most),)
        yield Observation(demand.label, demand.wanted, demand.signed, intervals)
