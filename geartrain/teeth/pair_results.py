"""Results of one gear pair of any tooth form: kinematics, losses, verdict, and table rows.

The JSON keys of these results, in reports on trains and on single pairs, are defined only here. Angles are in degrees
in tables and in rad in results.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING, ClassVar

from geartrain.errors import Problem
from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.teeth.couplings.pin_transmission import PinTransmission
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True, slots=True)
class SpeedRatio(Result):
    """Speed ratio of a pair over a period: driven speed divided by driver speed, without the sign of the mean ratio. It
    is negative only while a pin follower moves backwards.
    """

    KEYS = (Key("mean", to=float), Key("exact", "mean"), Key("min", "minimum"), Key("max", "maximum"))

    mean: Fraction
    """Mean speed ratio: the ratio of the tooth numbers, or the winding number of a pin coupling."""
    minimum: float
    """Minimum speed ratio over a period."""
    maximum: float
    """Maximum speed ratio over a period."""

    @classmethod
    def of(cls, transmission: TransmissionFunction) -> SpeedRatio:
        """Return the speed ratio of a transmission function.

        transmission   transmission function of any gear pair or pin coupling
        """
        return cls(transmission.ratio, *transmission.speed_range())

    @property
    def relative(self) -> tuple[float, float]:
        """Minimum and maximum speed ratio, each divided by the mean speed ratio."""
        return self.minimum / float(self.mean), self.maximum / float(self.mean)


@dataclass(frozen=True, slots=True)
class TransmissionError(Result):
    """Transmission error of a pair over a period, positive if the driven side is ahead of uniform motion."""

    peak_to_peak: float
    """Maximum minus minimum transmission error [rad of the driven side]."""
    rms: float
    """Root mean square deviation of the transmission error from its mean [rad of the driven side]."""
    mean: float
    """Mean transmission error [rad of the driven side]. This constant depends on the zero of the angles."""

    @classmethod
    def of(cls, transmission: TransmissionFunction) -> TransmissionError:
        """Return the statistics of the transmission error of a transmission function.

        transmission   transmission function of any gear pair or pin coupling
        """
        low, high = transmission.error_range()
        mean, rms = transmission.error_moments()
        return cls(high - low, rms, mean)

    @property
    def text(self) -> str:
        """Text with the peak-to-peak transmission error in degrees."""
        return f"{degrees(self.peak_to_peak):.6g}"


@dataclass(frozen=True, slots=True)
class SlidingEfficiency(Result):
    """Efficiency of a pair with friction: output power divided by input power. The values are computed on access from
    the transmission function.

    The torques on both sides cannot be constant at the same time. `mean` is the efficiency at constant torque of the
    driver, and `at_constant_load` is the efficiency at constant torque of the driven side. All efficiencies are None if
    friction locks the pair.
    """

    KEYS = ("friction", "mean", "at_constant_load", Key("min", "minimum"), Key("locks_at", "locking_friction"))

    transmission: TransmissionFunction
    """Transmission function of the pair."""

    @property
    def friction(self) -> float | None:
        """Coefficient of friction, or its mean if it depends on speed; None for a declared efficiency."""
        return self.transmission.friction

    @property
    def locks(self) -> bool:
        """True if friction locks the pair at some driver angle."""
        return self.transmission.locks

    @property
    def mean(self) -> float | None:
        """Mean of the efficiency over the driver angle at constant driver torque; None if friction locks the pair."""
        return None if self.locks else finite(self.transmission.efficiency_mean())

    @property
    def at_constant_load(self) -> float | None:
        """Work output divided by work input at constant load torque; None if the pair locks or does no work."""
        return None if self.locks else finite(self.transmission.efficiency_at_constant_load())

    @property
    def minimum(self) -> float | None:
        """Minimum of the efficiency over all driver angles; None if friction locks the pair."""
        return None if self.locks else finite(self.transmission.efficiency_minimum())

    @property
    def locking_friction(self) -> float | None:
        """Minimum coefficient of friction at which the pair locks; None if the pair never locks."""
        return finite(self.transmission.locking_friction)

    @property
    def text(self) -> str:
        """Text with the mean efficiency, or "locks" if friction locks the pair."""
        return "locks" if self.mean is None else f"{self.mean:.6f}"


# -------------------------------------------------------------------------------------------------------------- verdict


def _gear_or_none(gear: int) -> int | None:
    """Return the number of the faulty gear, or None if `gear` is 0, which means the pair as a whole."""
    return gear or None


@dataclass(frozen=True, slots=True)
class ToothFault(Result):
    """Fault that prevents the teeth of a pair from running, with its cause and remedy. Faults are part of a verdict."""

    KEYS = ("kind", Key("gear", to=_gear_or_none), "what", "why", "fix")

    kind: str
    """Kind of fault, such as `jam`, `clash` or `undercut`."""
    gear: int
    """Number of the faulty gear, 1 or 2; 0 if the fault concerns the pair as a whole."""
    X: float
    """Arc X on the pitch surfaces at which the fault begins [module; rad for bevel gears]; NaN if undefined."""
    what: str
    """Statement that describes the fault."""
    why: str
    """Statement that gives the cause of the fault."""
    fix: str
    """Suggested correction of the fault, as a sentence."""

    @property
    def problem(self) -> Problem:
        """Fault as a `Problem`, which has no location in a file."""
        return Problem(self.what, self.why, self.fix)


@dataclass(frozen=True, slots=True)
class PairVerdict(Result):
    """Verdict on whether a pair of wheels can run. Its truth value is True if the pair can run."""

    KEYS = ("kind", "text", Key("backlash", to=finite), "faults", "why", "fix")

    kind: str
    """Kind of the verdict: "runs" if the pair can run, or the kind of the first fault if it cannot."""
    text: str
    """Sentence that states the verdict."""
    backlash: float
    """Minimum backlash of the teeth over a pitch [rad of the driven wheel]."""
    faults: tuple[ToothFault, ...] = ()
    """All faults that prevent the teeth from running; empty if the teeth can run."""

    def __bool__(self) -> bool:
        return self.kind == "runs"

    @property
    def why(self) -> str:
        """Cause of the first fault; an empty string if the teeth can run."""
        return self.faults[0].why if self.faults else ""

    @property
    def fix(self) -> str:
        """Remedy of the first fault; an empty string if the teeth can run."""
        return self.faults[0].fix if self.faults else ""

    def explained(self, why: str, fix: str) -> PairVerdict:
        """Return a copy of the verdict with a single fault that has the given cause and remedy.

        why, fix   cause of the fault, and its remedy
        """
        return replace(self, faults=(ToothFault(self.kind, 0, float("nan"), self.text, why, fix),))


def verdict_of_faults(faults: tuple[ToothFault, ...], backlash: float) -> PairVerdict:
    """Return the verdict on teeth with the given faults and backlash [rad of the driven wheel]."""
    text = "; ".join(fault.what for fault in faults) or "the teeth run"
    return PairVerdict(faults[0].kind if faults else "runs", text, backlash, faults)


def friction_lock(friction: float, locking: float) -> Problem:
    """Return the problem of teeth that friction locks: the coefficient `friction` is not below the limit `locking`."""
    return Problem(
        f"a coefficient of friction of {friction:g} locks these teeth",
        f"at a coefficient of {locking:.6g} or more the driver cannot overcome the sliding friction at some angle",
        f"give a coefficient of friction below {locking:.4g}, or let the other wheel drive",
    )


def friction_lock_at_speed(law: str, locking: float) -> Problem:
    """Return the problem of teeth that lock, at their speed, under the friction law named `law`.

    `locking` is the minimum constant coefficient of friction that locks the teeth.
    """
    return Problem(
        f"the friction law '{law}' locks these teeth at this speed",
        f"the driver cannot overcome the sliding friction at some angle; the limit is a coefficient of {locking:.6g}",
        "give a law with less friction or another speed, or let the other wheel drive",
    )


# -------------------------------------------------------------------------------------------- properties and table rows


@dataclass(frozen=True)
class PinFigures(Result):
    """Results of one pin coupling for the case that one of its sides drives: dimensions, motion and efficiency."""

    pin_radius: float
    """Distance of the pin from its axis [m, or the unit of the declared lengths]."""
    offset: float
    """Distance between the axes of pin and slot [m, or the unit of the declared lengths]."""
    speed_ratio: SpeedRatio
    """Speed ratio: speed of the driven side divided by speed of the driver."""
    amplitude: float
    """Maximum transmission error of the driven side [rad]."""
    transmission_error: TransmissionError
    """Transmission error of the driven side."""
    efficiency: SlidingEfficiency
    """Efficiency of the coupling with friction of the pin along its slot."""


def pin_figures(transmission: PinTransmission) -> PinFigures:
    """Return dimensions, speed ratio, transmission error and efficiency of one pin coupling."""
    speed, error = SpeedRatio.of(transmission), TransmissionError.of(transmission)
    efficiency = SlidingEfficiency(transmission)
    return PinFigures(transmission.r, transmission.e, speed, transmission.amplitude, error, efficiency)


@dataclass(frozen=True)
class PairFigures(Result):
    """Results of one pair with one of its wheels driving. Some tooth forms have a subclass with further results."""

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        *("teeth", "verdict", Key("backlash", "verdict.backlash", finite)),
        *("speed_ratio", "transmission_error", "efficiency"),
    )

    teeth: tuple[int, int]
    """Tooth numbers of the driver and of the driven wheel."""
    verdict: PairVerdict
    """Verdict on whether the teeth of the pair can run."""
    speed_ratio: SpeedRatio | None
    """Speed ratio: driven speed divided by driver speed; None if the teeth cannot run."""
    transmission_error: TransmissionError | None
    """Transmission error of the driven wheel; None if the teeth cannot run."""
    efficiency: SlidingEfficiency | None
    """Efficiency with sliding friction of the teeth; None if the teeth cannot run."""

    @property
    def error_text(self) -> str:
        """Text with the peak-to-peak transmission error in degrees; "-" if the teeth cannot run."""
        return self.transmission_error.text if self.transmission_error else "-"


def motion_figures(
    transmission: TransmissionFunction, moves: bool = True
) -> tuple[SpeedRatio | None, TransmissionError | None]:
    """Return the speed ratio and the transmission error. Both are None if the teeth cannot run (`moves` is False)."""
    return (SpeedRatio.of(transmission), TransmissionError.of(transmission)) if moves else (None, None)


@dataclass(frozen=True)
class AccountTable:
    """Header of a table in the report on pairs, and the row of one pair. If `wide` is True, the table fills
    the page.
    """

    header: tuple[str, ...]
    row: tuple[str, ...]
    wide: bool = False


@dataclass(frozen=True)
class PairAccount:
    """Report on one pair for the case that one of its wheels drives: tables as text, and results for JSON."""

    words: str
    """Text that explains the tables of all pairs that have the same kind of report."""
    tables: tuple[AccountTable, ...]
    """Tables of the report, each with the row of this pair."""
    figures: PairFigures
    """Results that are written to JSON."""
