"""What is told of a pin in a slot: its dimensions, and its transmission function in figures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.results import Result
from geartrain.teeth.transmission_figures import SlidingEfficiency, SpeedRatio, TransmissionError

if TYPE_CHECKING:
    from geartrain.teeth.pin_transmission import PinTransmission


@dataclass(frozen=True)
class PinFigures(Result):
    """Figures of a pin in a slot.

    pin_radius, offset   m, or plain
    speed_ratio          of the driven side over the driver
    amplitude            greatest transmission error (rad)
    transmission_error   of the driven side
    efficiency           of the pin sliding along its slot
    """

    pin_radius: float
    offset: float
    speed_ratio: SpeedRatio
    amplitude: float
    transmission_error: TransmissionError
    efficiency: SlidingEfficiency


def pin_figures(law: PinTransmission) -> PinFigures:
    """Of one coupling, whichever side drives."""
    error = TransmissionError.of(law)
    return PinFigures(law.r, law.e, SpeedRatio.of(law), law.amplitude, error, SlidingEfficiency(law))
