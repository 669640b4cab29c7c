"""Everything that was asked of the trials of one train, and what is assumed in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING, Any

from geartrain.uncertainty.confidence_intervals import CONFIDENCE
from geartrain.uncertainty.monte_carlo.random_streams import BLOCK

if TYPE_CHECKING:
    from geartrain.uncertainty.monte_carlo.clearance_study import ClearanceCase
    from geartrain.uncertainty.monte_carlo.pointer_error import PointerErrorCourse, TrialResults
    from geartrain.uncertainty.monte_carlo.sobol_indices import SobolIndices
    from geartrain.uncertainty.monte_carlo.tolerance_allocation import ToleranceAllocation


@dataclass(frozen=True, slots=True)
class MonteCarloResult:
    """Trials, and what else was asked: other clearances, courses along a turn, indices, a tolerance."""

    trials: TrialResults
    cleared: Sequence[ClearanceCase] = ()
    courses: Sequence[PointerErrorCourse] = ()
    indices: Sequence[SobolIndices] = ()
    tolerance: ToleranceAllocation | None = None

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What is taken for granted, in sentences."""
        return tuple(self._assumptions())

    def _assumptions(self) -> Iterator[str]:
        plan = self.trials.plan
        yield (
            "Teeth are independent of each other, and so are wheels; a wheel is one and the same in all its pairs. "
            "Each trial cuts all wheels anew."
        )
        yield (
            "The driven wheel drags and so stays in contact. A jam holds it fast from both sides, whatever it does; a "
            "clash is a tooth that comes in against a tip, which a hand that leads it may pass."
        )
        if any("bearing" in pair.fitting for pair in plan.pairs):
            yield (
                "Bearings move from tooth to tooth: jams are judged with the axes at their nearest, the rest at their "
                "farthest too, which is the worst that can be."
            )
        uncut = self.trials.train.uncut
        if uncut:
            yield (
                f"{uncut} trials hold a wheel that cannot be cut, two of its teeth falling into one: they are left "
                "out of all shares."
            )
        yield (
            "A pointer's error is its distance from where teeth that keep their ratio would have it; the mean lag of "
            "even teeth, with which pointers are set, is taken off. Laws of pairs and pins are composed exactly."
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; angles in degrees, sizes of errors as fractions of pitch, half angle and depth.

        What was not asked for is an empty list, or None.
        """
        trials, plan = self.trials, self.trials.plan
        return {
            "train": plan.name,
            "seed": trials.seed,
            "trials": trials.done,
            "block": BLOCK,
            "confidence": CONFIDENCE,
            "assumptions": list(self.assumptions),
            "errors": {"wheels": _errors(plan.wheels, "errors"), "pairs": _errors(plan.pairs, "fitting")},
            "any_pair": trials.train.to_dict(),
            "pairs": [pair.to_dict() for pair in trials.pairs],
            "outputs": [pointer.to_dict() for pointer in trials.pointers],
            "convergence": {
                event: [{"trials": count, **share.to_dict()} for count, share in trials.convergence(event)]
                for event in ("jam", "stops")
            },
            "partial": None if trials.complete else {"done": trials.done, "of": trials.wanted},
            "clearances": [one.to_dict() for one in self.cleared],
            "courses": [one.to_dict() for one in self.courses],
            "indices": [one.to_dict() for one in self.indices],
            "tolerance": None if self.tolerance is None else self.tolerance.to_dict(),
        }

    def pointer_convergence(self, at: int) -> list[tuple[int, float, float, float]]:
        """Trials, and the standard deviation of an output with its interval (deg)."""
        rows = self.trials.pointer_convergence(at)
        return [(n, degrees(each.value), degrees(each.low), degrees(each.high)) for n, each in rows]


def _errors(things: Sequence[Any], key: str) -> dict[str, Any]:
    return {
        each.name: {kind: {off.way: off.size} for kind, off in getattr(each, key).items()}
        for each in things
        if getattr(each, key)
    }
