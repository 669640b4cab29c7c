"""Whether a pair of wheels can turn, whatever the form of its teeth: the verdict, and each fault with its remedy."""

from __future__ import annotations

from dataclasses import dataclass, replace

from geartrain.errors import Problem
from geartrain.numerics.results import Key, Result, finite


def _which(gear: int) -> int | None:
    """None for the pair as a whole."""
    return gear or None


@dataclass(frozen=True, slots=True)
class ToothFault(Result):
    """One reason why teeth cannot run.

    gear    1 or 2; 0 for the pair
    X       pitch-line displacement at which it begins; NaN for the pair
    what, why, fix   in words
    """

    KEYS = ("kind", Key("gear", to=_which), "what", "why", "fix")

    kind: str
    gear: int
    X: float
    what: str
    why: str
    fix: str

    @property
    def problem(self) -> Problem:
        """The fault as a problem that has no place yet."""
        return Problem(self.what, self.why, self.fix)


@dataclass(frozen=True, slots=True)
class PairVerdict(Result):
    """Whether a pair of wheels can turn; true if it can.

    Attributes
    ----------
    kind : str
        "runs", or the kind of the first fault.
    text : str
        What is the case.
    play : float
        Least play of the teeth over a pitch [rad of the driven wheel].
    faults : tuple of ToothFault
        All reasons why they cannot, each with what, why and what to do.

    See Also
    --------
    geartrain.teeth.GearMesh : its `verdict`.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> verdict = Involute(form="involute").law(8, 60).verdict
    >>> bool(verdict), verdict.kind, verdict.faults[0].gear
    (False, 'interference', 1)
    """

    KEYS = ("kind", "text", Key("play", to=finite), "faults", "why", "fix")

    kind: str
    text: str
    play: float
    faults: tuple[ToothFault, ...] = ()

    def __bool__(self) -> bool:
        return self.kind == "runs"

    @property
    def why(self) -> str:
        """Why they cannot, for the first reason; empty if they can."""
        return self.faults[0].why if self.faults else ""

    @property
    def fix(self) -> str:
        """What would let them, for the first reason; empty if they can."""
        return self.faults[0].fix if self.faults else ""

    def explained(self, why: str, fix: str) -> PairVerdict:
        """The verdict with its one reason told in full.

        Parameters
        ----------
        why, fix : str
            The reason, and what would let the pair turn.

        Returns
        -------
        PairVerdict
            With one fault, of the pair as a whole.
        """
        return replace(self, faults=(ToothFault(self.kind, 0, float("nan"), self.text, why, fix),))


def verdict_of_faults(faults: tuple[ToothFault, ...], play: float) -> PairVerdict:
    """The verdict on teeth with these faults; `play` in rad of the driven wheel."""
    text = "; ".join(fault.what for fault in faults) or "the teeth run"
    return PairVerdict(faults[0].kind if faults else "runs", text, play, faults)


def friction_lock(friction: float, locking: float) -> Problem:
    """The fault of teeth that lock from a friction of `locking` on."""
    return Problem(
        f"a friction of {friction:g} locks these teeth",
        f"from {locking:.6g} on the driver pushes somewhere against more sliding than it can overcome",
        f"give a friction below {locking:.4g}, or let the other wheel drive",
    )


def friction_lock_at_speed(law: str, locking: float) -> Problem:
    """The fault of teeth that lock somewhere at the speed at which they run under a law of friction."""
    return Problem(
        f"friction by the law '{law}' locks these teeth",
        f"somewhere the driver pushes against more sliding than it can overcome: a constant friction of {locking:.6g} "
        "would",
        "give less friction, another speed, or let the other wheel drive",
    )
