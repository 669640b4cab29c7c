"""Teeth of one wheel, cut to suit all its mates, for use in drawings, motion and manufacture."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.tooth_outline import Vertex, repeated
from geartrain.teeth.outlines.wheel_outline import lantern, pin_seats
from geartrain.teeth.outlines.wheel_requirement import LanternPins

CHORD = 1e-3  # modules: chordal tolerance of flanks and fillets
_RIM = 2.0  # modules: rim thickness of a ring outside the roots
_PIN = 48  # points of the polygon of a pin
_SAME = 1e-9  # rad: angles closer than this coincide


@dataclass(frozen=True, slots=True)
class WheelTeeth:
    """Teeth of one wheel. All lengths are in modules."""

    wheel: str
    z: int
    kind: str
    """Kind of the wheel: `external`, `ring` or `pins`."""
    form: str
    """Name of the declared tooth form, or `standard`. `words` is a description of the tooth form for a manufacturer."""
    words: str
    tip: float
    """Tip radius of the wheel [modules]."""
    root: float
    """Root radius of the wheel [modules]."""
    tooth: tuple[Vertex, ...] = ()
    """Outline of the first tooth from root to root [modules], symmetric about the x axis; empty for pins."""
    pins: LanternPins | None = None
    """Pins of a lantern, or separate pins of a ring with pin teeth; None for cut teeth."""

    def contours(self, module: float) -> tuple[Contour, ...]:
        """Return all contours of the wheel about the origin [mm]: the outer contour, followed by the holes."""
        if self.pins is not None and self.kind == "pins":
            return tuple(lantern(self.pins, self.z, module))
        if self.pins is not None:
            return Contour.circle((self.depth + _RIM) * module), pin_seats(self.pins, self.z, self.root, module)
        teeth = Contour.of(repeated(self.tooth, self.z)).scaled(module)
        return (teeth,) if self.kind == "external" else (Contour.circle((self.root + _RIM) * module), teeth)

    @property
    def depth(self) -> float:
        """Root radius [modules]; for a ring with pins, the radius to the bottom of the pin seats if that is larger."""
        if self.pins is None or self.kind == "pins":
            return self.root
        return max(self.root, self.pins.circle + self.pins.radius)

    def section(self) -> tuple[tuple[float, float], ...]:
        """Return the points of one tooth or pin, each as radius divided by pitch radius [1] and angle [rad].

        The section of a tooth extends from the middle of one space to the middle of the next; a pin is a closed circle.
        Arcs are replaced by chords.
        """
        R = self.z / 2
        if self.pins is not None and self.kind == "pins":
            turns = [2 * pi * at / _PIN for at in range(_PIN)]
            round_ = [(self.pins.circle + self.pins.radius * cos(t), self.pins.radius * sin(t)) for t in turns]
            return tuple((hypot(x, y) / R, atan2(y, x)) for x, y in round_)
        points = Contour.of((*self.tooth[:-1], (*self.tooth[-1][:2], 0.0))).flattened(CHORD).tolist()
        half = pi / self.z
        # points on the borders of the pitch are omitted, because both ends are added below
        inside = [(hypot(x, y) / R, atan2(y, x)) for x, y in points if abs(atan2(y, x)) < half - _SAME]
        return ((self.root / R, -half), *inside, (self.root / R, half))
