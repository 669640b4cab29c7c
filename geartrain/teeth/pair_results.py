"""Results of one gear pair, whatever its tooth form: figures of its motion and losses, verdict, rows of tables.

Each figure has its keys here only: reports of trains and pages of one pair share them. Angles are in degrees in tables
and in rad in figures.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING, ClassVar

from geartrain.errors import Problem
from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.teeth.pin_transmission import PinTransmission
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True, slots=True)
class SpeedRatio(Result):
    """Speed ratio of a pair over a period: driven over driver, without sign.

    See Also
    --------
    geartrain.teeth.TransmissionFunction.speed : the ratio at each angle.

    Examples
    --------
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> SpeedRatio.of(PinToSlotTransmission(2, 1)).to_dict()
    {'mean': 1.0, 'exact': '1', 'min': 0.6666666666666666, 'max': 2.0}
    """

    KEYS = (Key("mean", to=float), Key("exact", "mean"), Key("min", "minimum"), Key("max", "maximum"))

    mean: Fraction
    """The ratio of tooth numbers, or the winding number of a pin."""
    minimum: float
    """Least ratio at any angle."""
    maximum: float
    """Greatest ratio at any angle."""

    @classmethod
    def of(cls, transmission: TransmissionFunction) -> SpeedRatio:
        """Of a transmission function.

        Parameters
        ----------
        transmission : TransmissionFunction
            Any.

        Returns
        -------
        SpeedRatio
            Over its period.
        """
        return cls(transmission.ratio, *transmission.speed_range())

    @property
    def relative(self) -> tuple[float, float]:
        """Least and greatest over the mean."""
        return self.minimum / float(self.mean), self.maximum / float(self.mean)


@dataclass(frozen=True, slots=True)
class TransmissionError(Result):
    """Transmission error of a pair over a period, positive where the driven side is ahead of uniform motion.

    See Also
    --------
    geartrain.teeth.TransmissionFunction.error : the error at each angle.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> error = TransmissionError.of(PinToSlotTransmission(2, 1))  # amplitude asin(1/2)
    >>> round(error.peak_to_peak / pi, 12), error.mean
    (0.333333333333, 0.0)
    """

    KEYS = ("peak_to_peak", "rms", "mean")

    peak_to_peak: float
    """Greatest less least [rad of the driven side]."""
    rms: float
    """About the mean [rad]."""
    mean: float
    """A lag that depends on where angles are counted from [rad]."""

    @classmethod
    def of(cls, transmission: TransmissionFunction) -> TransmissionError:
        """Of a transmission function.

        Parameters
        ----------
        transmission : TransmissionFunction
            Any.

        Returns
        -------
        TransmissionError
            Over its period.
        """
        low, high = transmission.error_range()
        mean, rms = transmission.error_moments()
        return cls(high - low, rms, mean)

    @property
    def text(self) -> str:
        """Peak to peak, in degrees."""
        return f"{degrees(self.peak_to_peak):.6g}"


@dataclass(frozen=True, slots=True)
class SlidingEfficiency(Result):
    """Power out over power in of a pair with friction, read off its transmission function when asked.

    Over a turn the torques of both sides cannot be constant at once: `mean` is at constant torque of the driver,
    `at_constant_load` at constant torque of the driven side. All are None where friction locks the pair.

    See Also
    --------
    geartrain.teeth.GearMesh.efficiency : that of a pair of a train, either wheel driving.

    Examples
    --------
    A slot that drives its pin locks from sqrt(r^2 - e^2)/e on.

    >>> from geartrain.teeth import SlotToPinTransmission
    >>> efficiency = SlidingEfficiency(SlotToPinTransmission(5, 3, 0.1))
    >>> round(efficiency.locking_friction, 6), efficiency.locks, round(efficiency.minimum, 6)
    (1.333333, False, 0.925)
    """

    KEYS = ("friction", "mean", "at_constant_load", Key("min", "minimum"), Key("locks_at", "locking_friction"))

    transmission: TransmissionFunction
    """Of the pair."""

    @property
    def friction(self) -> float:
        """Coefficient of friction; its mean over the driver's angle where it depends on speed."""
        return self.transmission.friction

    @property
    def locks(self) -> bool:
        """True if friction locks the pair somewhere."""
        return self.transmission.locks

    @property
    def mean(self) -> float | None:
        """Mean efficiency over the driver's angle, at constant driver torque."""
        return None if self.locks else finite(self.transmission.efficiency_mean())

    @property
    def at_constant_load(self) -> float | None:
        """Work done on a constant torque of the driven side over the work put in; None where none is done."""
        return None if self.locks else finite(self.transmission.efficiency_at_constant_load())

    @property
    def minimum(self) -> float | None:
        """Least efficiency at any angle."""
        return None if self.locks else finite(self.transmission.efficiency_minimum())

    @property
    def locking_friction(self) -> float | None:
        """The least friction that locks; None where none does."""
        return finite(self.transmission.locking_friction)

    @property
    def text(self) -> str:
        """The mean, or that friction locks."""
        return "locks" if self.mean is None else f"{self.mean:.6f}"


def _which(gear: int) -> int | None:
    """None for the pair as a whole."""
    return gear or None


# -------------------------------------------------------------------------------------------------------------- verdict


@dataclass(frozen=True, slots=True)
class ToothFault(Result):
    """One reason why teeth cannot run."""

    KEYS = ("kind", Key("gear", to=_which), "what", "why", "fix")

    kind: str
    """Kind of fault, such as `jam`, `clash` or `undercut`."""
    gear: int
    """1 or 2; 0 for the pair."""
    X: float
    """Pitch-line displacement at which it begins; NaN for the pair."""
    what: str
    """The fault in words."""
    why: str
    """Its reason in words."""
    fix: str
    """Its remedy in words."""

    @property
    def problem(self) -> Problem:
        """The fault as a problem that has no place yet."""
        return Problem(self.what, self.why, self.fix)


@dataclass(frozen=True, slots=True)
class PairVerdict(Result):
    """Whether a pair of wheels can turn; true if it can.

    See Also
    --------
    geartrain.teeth.GearMesh : its `verdict`.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> verdict = Involute(form="involute").transmission(8, 60).verdict
    >>> bool(verdict), verdict.kind, verdict.faults[0].gear
    (False, 'interference', 1)
    """

    KEYS = ("kind", "text", Key("backlash", to=finite), "faults", "why", "fix")

    kind: str
    """"runs", or the kind of the first fault."""
    text: str
    """What is the case."""
    backlash: float
    """Least play of the teeth over a pitch [rad of the driven wheel]."""
    faults: tuple[ToothFault, ...] = ()
    """All reasons why they cannot, each with what, why and what to do."""

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


def verdict_of_faults(faults: tuple[ToothFault, ...], backlash: float) -> PairVerdict:
    """The verdict on teeth with these faults; `backlash` in rad of the driven wheel."""
    text = "; ".join(fault.what for fault in faults) or "the teeth run"
    return PairVerdict(faults[0].kind if faults else "runs", text, backlash, faults)


def friction_lock(friction: float, locking: float) -> Problem:
    """The fault of teeth that lock from a friction of `locking` on."""
    return Problem(
        f"a friction of {friction:g} locks these teeth",
        f"from {locking:.6g} on the driver pushes somewhere against more sliding than it can overcome",
        f"give a friction below {locking:.4g}, or let the other wheel drive",
    )


def friction_lock_at_speed(transmission: str, locking: float) -> Problem:
    """The fault of teeth that lock somewhere at the speed at which they run under a law of friction."""
    return Problem(
        f"friction by the law '{transmission}' locks these teeth",
        f"somewhere the driver pushes against more sliding than it can overcome: a constant friction of {locking:.6g} "
        "would",
        "give less friction, another speed, or let the other wheel drive",
    )


# ------------------------------------------------------------------------------------------- figures and rows of tables


@dataclass(frozen=True)
class PinFigures(Result):
    """Figures of a pin in a slot."""

    pin_radius: float
    """Distance of the pin from its axis [m, or plain]."""
    offset: float
    """Distance of the two axes [m, or plain]."""
    speed_ratio: SpeedRatio
    """Of the driven side over the driver."""
    amplitude: float
    """Greatest transmission error (rad)."""
    transmission_error: TransmissionError
    """Of the driven side."""
    efficiency: SlidingEfficiency
    """Of the pin sliding along its slot."""


def pin_figures(transmission: PinTransmission) -> PinFigures:
    """Of one coupling, whichever side drives."""
    error = TransmissionError.of(transmission)
    return PinFigures(
        transmission.r,
        transmission.e,
        SpeedRatio.of(transmission),
        transmission.amplitude,
        error,
        SlidingEfficiency(transmission),
    )


@dataclass(frozen=True)
class PairFigures(Result):
    """Figures of one pair, in one way of being driven; a form may add its own."""

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        *("teeth", "verdict", Key("backlash", "verdict.backlash", finite)),
        *("speed_ratio", "transmission_error", "efficiency"),
    )

    teeth: tuple[int, int]
    """Of the driver and of the driven wheel."""
    verdict: PairVerdict
    """Whether they can turn."""
    speed_ratio: SpeedRatio | None
    """Driven over driver; None for teeth without a motion."""
    transmission_error: TransmissionError | None
    """Of the driven wheel; None likewise."""
    efficiency: SlidingEfficiency | None
    """Of sliding; None likewise."""

    @property
    def error_text(self) -> str:
        """Transmission error peak to peak (deg); a dash for teeth without a motion."""
        return self.transmission_error.text if self.transmission_error else "-"


def motion_figures(
    transmission: TransmissionFunction, moves: bool = True
) -> tuple[SpeedRatio | None, TransmissionError | None]:
    """Speed ratio and transmission error; None for teeth that have no motion."""
    return (SpeedRatio.of(transmission), TransmissionError.of(transmission)) if moves else (None, None)


@dataclass(frozen=True)
class AccountTable:
    """The header of a table, and the row of one pair; `wide` where it needs the width of a page."""

    header: tuple[str, ...]
    row: tuple[str, ...]
    wide: bool = False


@dataclass(frozen=True)
class PairAccount:
    """Of one pair, in one way of being driven."""

    words: str
    """What the tables of all pairs of this kind mean."""
    tables: tuple[AccountTable, ...]
    """One row of each."""
    figures: PairFigures
    """For JSON."""
