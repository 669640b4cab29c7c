"""Triangular teeth in the plane: the balance of one contact with Coulomb friction.

The driver turns about the origin, the driven wheel about (D, 0). Apices are at alpha_1 and alpha_2 from the line of
centres, both positive towards the same side, and both angles decrease as the driver pushes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from sorge import APPROACH, Pair


class Contact(NamedTuple):
    """One contact of a tooth pair: its point, its normal, and the force of the driver on the driven wheel.

    off   distance of the apex from the line of the flank
    tau   driven speed divided by driver speed
    """

    D: Any
    point: tuple[Any, Any]
    normal: tuple[Any, Any]
    force: tuple[Any, Any]
    off: Any
    tau: Any

    @property
    def moments(self) -> tuple[Any, Any]:
        """Moments of the force about the driver's and the driven axis, each with the sign of the power."""
        first = self.point[0] * self.force[1] - self.point[1] * self.force[0]
        second = (self.point[0] - self.D) * self.force[1] - self.point[1] * self.force[0]
        return -first, second

    @property
    def centre(self) -> Any:
        """Distance from the driver's axis to the intersection of the normal and the line of centres."""
        return self.point[0] - self.point[1] * self.normal[0] / self.normal[1]


def contact(pair: Pair, x: Any, phase: str, friction: Any) -> Contact:
    """Return the balance of one contact.

    The driver turns at one radian per second, and the driven wheel at tau, which follows from the condition that the
    points in contact have equal velocities along the normal of the flank. The force of the driver on the driven wheel
    is the normal force plus friction, which opposes the sliding of the driven point.
    """
    m = pair.m
    y = pair.angle(x, phase)
    driver_apex = (pair.R1 * m.cos(x), pair.R1 * m.sin(x))
    driven_apex = (pair.D - pair.R2 * m.cos(y), pair.R2 * m.sin(y))
    if phase == APPROACH:
        point, lean = driven_apex, x + pair.b1
        along = (-m.cos(lean), -m.sin(lean))
    else:
        point, lean = driver_apex, pair.b2 - y
        along = (m.cos(lean), m.sin(lean))
    apices = (driven_apex[0] - driver_apex[0], driven_apex[1] - driver_apex[1])
    off = apices[0] * along[1] - apices[1] * along[0]
    normal = (along[1], -along[0])
    first = (point[1], -point[0])  # velocity of the driver's point, turning clockwise
    second = (-point[1], point[0] - pair.D)  # of the driven wheel's at unit speed, turning anticlockwise
    if _dot(normal, first) < 0:
        normal = (-normal[0], -normal[1])
    tau = _dot(normal, first) / _dot(normal, second)
    sliding = tau * _dot(along, second) - _dot(along, first)
    rub = -friction * m.sign(sliding)
    force = (normal[0] + rub * along[0], normal[1] + rub * along[1])
    return Contact(pair.D, point, normal, force, off, tau)


def power_ratio(pair: Pair, x: Any, phase: str, friction: Any) -> tuple[Any, Any, Any]:
    """Return output power divided by input power of one contact, the apex's distance from the flank's line, and tau."""
    found = contact(pair, x, phase, friction)
    into, out = found.moments
    return out * found.tau / into, found.off, found.tau


def _dot(a: tuple[Any, Any], b: tuple[Any, Any]) -> Any:
    return a[0] * b[0] + a[1] * b[1]
