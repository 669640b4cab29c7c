"""The teeth of one wheel, as they are cut for all its mates: to be drawn, turned and made."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.tooth_outline import Vertex, repeated
from geartrain.teeth.outlines.wheel_outline import lantern, pin_seats
from geartrain.teeth.outlines.wheel_requirement import LanternPins

CHORD = 1e-3  # modules: how far a chord may leave a flank or a round
_RIM = 2.0  # modules round the roots of a ring
_PIN = 48  # points round a pin
_SAME = 1e-9  # rad


@dataclass(frozen=True, slots=True)
class WheelTeeth:
    """The teeth of one wheel, lengths in modules."""

    wheel: str
    z: int
    kind: str
    """External, ring or pins."""
    form: str
    """Name of the declared form, or `standard`; `words`, what a maker is told."""
    words: str
    tip: float
    """Radii."""
    root: float
    """Radii."""
    tooth: tuple[Vertex, ...] = ()
    """The first of them, about the x axis, from root to root; empty for pins."""
    pins: LanternPins | None = None
    """Of a lantern; of a ring whose teeth are pins, parts of their own."""

    def contours(self, module: float) -> tuple[Contour, ...]:
        """All of the wheel (mm), the outer contour first, then holes; the axle at (0, 0)."""
        if self.pins is not None and self.kind == "pins":
            return tuple(lantern(self.pins, self.z, module))
        if self.pins is not None:
            return Contour.circle((self.depth + _RIM) * module), pin_seats(self.pins, self.z, self.root, module)
        teeth = Contour.of(repeated(self.tooth, self.z)).scaled(module)
        return (teeth,) if self.kind == "external" else (Contour.circle((self.root + _RIM) * module), teeth)

    @property
    def depth(self) -> float:
        """Radius of the roots; of a ring with pins that to which these reach, if that is more."""
        if self.pins is None or self.kind == "pins":
            return self.root
        return max(self.root, self.pins.circle + self.pins.radius)

    def section(self) -> tuple[tuple[float, float], ...]:
        """Radius (over the pitch radius) and angle of one tooth, from mid-space to mid-space, or round a pin.

        Arcs are chords.
        """
        R = self.z / 2
        if self.pins is not None and self.kind == "pins":
            turns = [2 * pi * at / _PIN for at in range(_PIN)]
            round_ = [(self.pins.circle + self.pins.radius * cos(t), self.pins.radius * sin(t)) for t in turns]
            return tuple((hypot(x, y) / R, atan2(y, x)) for x, y in round_)
        points = Contour.of((*self.tooth[:-1], (*self.tooth[-1][:2], 0.0))).flattened(CHORD).tolist()
        half = pi / self.z
        # without the points on the borders of the pitch, which stand at both ends below
        inside = [(hypot(x, y) / R, atan2(y, x)) for x, y in points if abs(atan2(y, x)) < half - _SAME]
        return ((self.root / R, -half), *inside, (self.root / R, half))
