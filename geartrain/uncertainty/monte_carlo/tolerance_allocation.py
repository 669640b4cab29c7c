"""Tolerance allocation: the greatest cutting error with which the train jams seldom enough."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import NormalDist
from typing import TYPE_CHECKING, NamedTuple

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.plain_data import Key, Result
from geartrain.numerics.work import Execution
from geartrain.uncertainty.confidence_intervals import CONFIDENCE, ProbabilityEstimate, wilson
from geartrain.uncertainty.manufacturing_errors.declared_errors import ERROR_KINDS
from geartrain.uncertainty.monte_carlo.clearance_study import judged_at
from geartrain.uncertainty.monte_carlo.trial_run import check_trials, jamming_bounds

if TYPE_CHECKING:
    from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan

_STEPS = 12  # halvings: the scale to 0.02 % of the widest
_WIDEST = 64.0  # times the declared errors: what passes there is sought no farther


class FailedScale(NamedTuple):
    """A scale of errors with which the event is not rare enough, and what the trials say there."""

    scale: float
    share: ProbabilityEstimate


@dataclass(frozen=True, slots=True)
class ToleranceAllocation(Result):
    """The greatest scale of errors at which an event is rare enough, with one-sided confidence.

    Attributes
    ----------
    kind : str
        The kind of error that was scaled; "" for all.
    event : str
        What is to be rare: jam, clash, stops, standstill or disengaged.
    chance : float
        Its probability stays below this, 0 to 1.
    confidence : float
        With which that is shown, 0.95.
    scale : float
        Factor of the declared errors.
    share : ProbabilityEstimate
        What the trials say there.
    next : FailedScale or None
        The least scale tried that failed, and what the trials say there.
    bound : float or None
        The scale at which the bound on jams by pitch errors reaches `chance`; None where it does not apply.
    sizes : dict of str to float
        Wheel or pair and kind -> size at that scale [pitch, half angle or depth].

    See Also
    --------
    find_tolerance : gives it
    """

    KEYS = (
        Key("kind", "scaled"),
        "event",
        "chance",
        "confidence",
        "scale",
        Key("", "share"),
        Key("next", keys=("scale", Key("", "share"))),
        Key("bound_scale", "bound"),
        "sizes",
    )

    kind: str
    event: str
    chance: float
    confidence: float
    scale: float
    share: ProbabilityEstimate
    next: FailedScale | None
    bound: float | None
    sizes: dict[str, float]

    @property
    def scaled(self) -> str:
        """The kind of error that was scaled, or `all`."""
        return self.kind or "all"


def find_tolerance(
    plan: TrialPlan,
    kind: str = "",
    chance: float = 0.01,
    trials: int = 4096,
    seed: int = 1,
    event: str = "jam",
    means: Execution | None = None,
) -> ToleranceAllocation:
    """Tolerance allocation by bisection on the scale of the declared errors, the same errors at every scale.

    Parameters
    ----------
    plan : TrialPlan
        The train with its errors.
    kind : str
        The kind of error to scale: placement, eccentricity, tip, aperture, centre or bearing; "" for all.
    chance : float
        The event is to be rarer than this, 0 to 1.
    trials : int
        At each scale, 1 to 10^9, and enough to show so small a chance.
    seed : int
        Of the random numbers.
    event : str
        Jam, clash, stops (jam or clash), standstill or disengaged.
    means : Execution, optional
        Executor and progress report; by default this process, and none. Nothing is journalled.

    Returns
    -------
    ToleranceAllocation
        The greatest scale that was shown to be safe.

    Raises
    ------
    QuestionError
        For a kind that nothing has.
    RangeError
        Where trials are too few to show it, or even wheels do it.

    Notes
    -----
    The upper end of Wilson's one-sided 95 % interval must lie below the chance (docs/cut-by-hand.md, 4).

    Examples
    --------
    How much greater may pitch errors of 0.1 % become until one such train in five jams? Here the bound says the same.

    >>> from geartrain import load
    >>> from geartrain.uncertainty import find_trial_plan, read_error_overrides
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["placement=0.1 %"]), ["sun"])
    >>> found = find_tolerance(plan, "placement", chance=0.2, trials=64)
    >>> round(found.scale), round(found.bound or 0)
    (6, 6)
    """
    check_trials(trials)
    means = replace(means or Execution(), journal=None)
    _check(plan, kind, chance, trials)
    tried: dict[float, ProbabilityEstimate] = {}

    def passes(scale: float) -> bool:
        tried[scale] = judged_at(plan, scale, kind, trials, seed, means).events[event]
        return wilson_upper(tried[scale]) < chance

    scale, failed = _bisect(passes)
    if not scale:
        what = f"with errors of {kind or 'every kind'} taken away the train still does '{event}' too often"
        fix = "give more clearance, or take away other errors too"
        raise RangeError(Problem(what, f"{tried[0.0].count} of {tried[0.0].of} trials do", fix))
    later = FailedScale(failed, tried[failed]) if failed is not None else None
    return ToleranceAllocation(
        kind,
        event,
        chance,
        CONFIDENCE,
        scale,
        tried[scale],
        later,
        _bound(plan, kind, chance),
        _sizes(plan, kind, scale),
    )


def wilson_upper(share: ProbabilityEstimate) -> float:
    """Upper end of Wilson's interval, one-sided; 1 where nothing could be cut."""
    return wilson(share.count, share.of, NormalDist().inv_cdf(CONFIDENCE))[1]


def _check(plan: TrialPlan, kind: str, chance: float, trials: int) -> None:
    if kind and kind not in ERROR_KINDS:
        raise QuestionError(Problem(f"no kind of error is called '{kind}'", "", f"use one of {', '.join(ERROR_KINDS)}"))
    if not _sizes(plan, kind, 1.0):
        fix = f"declare it, or give --set {kind}=SIZE: its size is what is scaled"
        raise QuestionError(Problem(f"no wheel or pair has an error of {kind}", "there is nothing to scale", fix))
    if not 0 < chance < 1:
        raise QuestionError(Problem(f"a chance of {chance:g}", "it lies between 0 and 1", "write for example 1%"))
    if wilson_upper(ProbabilityEstimate(0, trials)) >= chance:
        least = next(n for n in (2**k for k in range(40)) if wilson_upper(ProbabilityEstimate(0, n)) < chance)
        what = f"{trials} trials cannot show a chance below {chance:g}"
        why = f"even if none of them does it, {wilson_upper(ProbabilityEstimate(0, trials)):.2g} is not excluded"
        raise RangeError(Problem(what, why, f"ask for {least} trials or more"))


def _bisect(passes: Callable[[float], bool]) -> tuple[float, float | None]:
    """The greatest scale found that passes, and the least that does not."""
    low, high = 0.0, 1.0  # the same wheels at every scale, so that what passes does so monotonically but for a few
    if passes(high):
        while passes(high * 2):
            high *= 2
            if high >= _WIDEST:
                return high, None
        low, high = high, high * 2
    elif not passes(0.0):
        return 0.0, high
    for _ in range(_STEPS):
        middle = (low + high) / 2
        low, high = (middle, high) if passes(middle) else (low, middle)
    return low, high


def _bound(plan: TrialPlan, kind: str, chance: float) -> float | None:
    """The scale at which the sum of the bounds of all pairs reaches the chance."""
    if kind not in ("", "placement") or len(jamming_bounds(plan)) < len(plan.pairs):
        return None
    low, high = 0.0, 1.0
    while sum(jamming_bounds(plan.scaled(high)).values()) < chance and high < _WIDEST:
        high *= 2
    # 40 halvings: to 1e-10
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if sum(jamming_bounds(plan.scaled(middle)).values()) < chance else (low, middle)
    return low


def _sizes(plan: TrialPlan, kind: str, scale: float) -> dict[str, float]:
    """Sizes of errors at a scale, as fractions of pitch, half angle or depth."""
    found = {}
    for name, errors in [(w.name, w.errors) for w in plan.wheels] + [(p.name, p.fitting) for p in plan.pairs]:
        for each, off in errors.items():
            if kind in ("", each) and off.size:
                found[f"{name}.{each}"] = off.size * scale
    return found
