"""How big a wheel is: its pitch circle, its rim, and the room it needs."""

from __future__ import annotations

from dataclasses import dataclass, replace

from geartrain.layout.reading import Reading
from geartrain.layout.scales import Scales
from geartrain.teeth.standard import DEDENDUM

_TIP = DEDENDUM  # modules beyond the pitch circle that are kept free: a tooth, and clearance
_RING = 3.5  # modules of a ring's rim
_WIDE = 2.5  # modules of a wheel's thickness
_SHELF = 1.4  # thicknesses from shelf to shelf
_WORM = 12.0  # modules of a worm's length


@dataclass(frozen=True, slots=True)
class Size:
    """Sizes of a wheel (mm).

    inner, outer   within `inner`, all is free inside a ring; `outer` is the radius it needs
    shelf          its middle over that of the lowest wheel of its level, where that has shelves
    """

    radius: float
    module: float
    thickness: float
    inner: float
    outer: float
    shelf: float = 0.0

    def on(self, low: int, high: int) -> Size:
        """The same wheel, as broad as it must be to stand on some shelves."""
        step = _SHELF * self.thickness
        broad = (high - low) * step + self.thickness
        return replace(self, thickness=broad, shelf=(low + high) / 2 * step)

    @property
    def foot(self) -> float:
        """How far the middle of a wheel on the lowest of its shelves is under its own (mm)."""
        return (self.thickness - _WIDE * self.module) / 2


def find_sizes(reading: Reading, scales: Scales) -> dict[str, Size]:
    """Sizes of all wheels."""
    found = {}
    for wheel, (_, kind) in reading.wheels.items():
        module = scales.module[wheel]
        radius = float(reading.size(wheel)) * module
        thickness = (_WORM if kind.kind == "worm" else _WIDE) * module
        inner, outer = (
            (radius - _TIP * module, radius + _RING * module) if kind.internal else (0.0, radius + _TIP * module)
        )
        found[wheel] = Size(radius, module, thickness, max(inner, 0.0), outer)
    return found
