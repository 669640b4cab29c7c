"""What is told of a gear pair, in a train's report and on a page of its own: rows of tables, and figures.

Angles are in degrees in tables and in rad in figures, which have the same key where forms mean the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from geartrain.numerics.results import Key, Result, finite
from geartrain.teeth.pair_verdict import PairVerdict
from geartrain.teeth.transmission_figures import SlidingEfficiency, SpeedRatio, TransmissionError

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True)
class PairFigures(Result):
    """Figures of one pair, in one way of being driven; a form may add its own.

    teeth                of the driver and of the driven wheel
    verdict              whether they can turn
    speed_ratio          driven over driver; None for teeth without a motion
    transmission_error   of the driven wheel; None likewise
    efficiency           of sliding; None likewise
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        *("teeth", "verdict", Key("play", "verdict.play", finite)),
        *("speed_ratio", "transmission_error", "efficiency"),
    )

    teeth: tuple[int, int]
    verdict: PairVerdict
    speed_ratio: SpeedRatio | None
    transmission_error: TransmissionError | None
    efficiency: SlidingEfficiency | None

    @property
    def error_text(self) -> str:
        """Transmission error peak to peak (deg); a dash for teeth without a motion."""
        return self.transmission_error.text if self.transmission_error else "-"


def motion_figures(law: TransmissionFunction, moves: bool = True) -> tuple[SpeedRatio | None, TransmissionError | None]:
    """Speed ratio and transmission error; None for teeth that have no motion."""
    return (SpeedRatio.of(law), TransmissionError.of(law)) if moves else (None, None)


@dataclass(frozen=True)
class AccountTable:
    """The header of a table, and the row of one pair; `wide` where it needs the width of a page."""

    header: tuple[str, ...]
    row: tuple[str, ...]
    wide: bool = False


@dataclass(frozen=True)
class PairAccount:
    """Of one pair, in one way of being driven.

    words     what the tables of all pairs of this kind mean
    tables    one row of each
    figures   for JSON
    """

    words: str
    tables: tuple[AccountTable, ...]
    figures: PairFigures
