"""What is told of a gear pair in a train's report: a row of each table that its kind has, and plain data.

Angles are in degrees in tables and in rad in data; data have the same key where forms mean the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, isfinite, nan
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True)
class AccountTable:
    """The header of a table, and the row of one pair; `wide` where it needs the width of a page."""

    header: tuple[str, ...]
    row: tuple[str, ...]
    wide: bool = False


@dataclass(frozen=True)
class PairAccount:
    """Of one pair, in one way of being driven.

    words    what the tables of all pairs of this kind mean
    tables   one row of each
    data     for JSON
    """

    words: str
    tables: tuple[AccountTable, ...]
    data: dict[str, Any]


class LossyTransmission(Protocol):
    """A transmission function that knows where friction locks it."""

    friction: float

    @property
    def locking_friction(self) -> float:
        """The least friction that locks."""

    def efficiency_mean(self) -> float:
        """Mean efficiency at constant driver torque."""

    def efficiency_at_constant_load(self) -> float:
        """Work out over work in at constant load."""

    def efficiency_least(self) -> float:
        """Least efficiency."""


def error_text(law: TransmissionFunction, runs: bool) -> str:
    """Transmission error peak to peak (deg); a dash for teeth that do not run."""
    low, high = law.error_range() if runs else (nan, nan)
    return f"{degrees(high - low):.6g}" if runs else "-"


def efficiency_text(law: LossyTransmission) -> str:
    """Mean efficiency, or that friction locks."""
    return "locks" if law.friction >= law.locking_friction else f"{law.efficiency_mean():.6f}"


def efficiency_data(law: LossyTransmission) -> dict[str, float | None]:
    """Friction and what it costs; null where it locks."""
    locks = law.friction >= law.locking_friction
    return {
        "friction": law.friction,
        "mean": None if locks else law.efficiency_mean(),
        "at_constant_load": None if locks else law.efficiency_at_constant_load(),
        "min": None if locks else law.efficiency_least(),
        "locks_at": law.locking_friction if isfinite(law.locking_friction) else None,
    }


def motion_data(law: TransmissionFunction, runs: bool = True) -> dict[str, Any]:
    """Speed ratio and transmission error; null for teeth that do not run."""
    if not runs:
        return {"speed_ratio": None, "transmission_error": None}
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    return {
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "transmission_error": {"peak_to_peak": high - low, "rms": rms, "mean": lag},
    }
