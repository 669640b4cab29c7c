"""Contact of one tooth pair in approach and in recess: driven angle, speed ratio, its slope, and friction.

alpha_1 = x and alpha_2 = y are the angles of the two apices from the line of centres. They are positive on the entry
side and decrease as the driver pushes. In approach the driven apex slides on the driver's flank; in recess the driver's
apex slides on the driven flank. Equations are numbered as in F. Sorge, "A note on the mechanics of ancient gear
systems", and are written so that nothing cancels at large tooth numbers.

In an internal pair the radius of the ring gear and the centre distance are negative in these equations, and alpha_2,
the speed ratio tau and the slope of tau change their sign. If the ring gear drives, the half aperture angles are
negative too, which mirrors the pair. Each function takes numbers with `m = math`, or arrays with `m = numpy` (2.0 or
later).
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any, TypeAlias

from geartrain.teeth.triangular.pair_geometry import TriangularSizes

APPROACH, RECESS = "approach", "recess"
SLIP, RETURN = "slip", "return"
"""Phases of contact that cannot drive. They exist only with overhanging flanks.

In slip, the driver's apex touches an overhanging driven flank. In return, the driven apex touches the far side of an
overhanging driver flank. Both phases limit the backlash. The driven wheel would have to turn back, so it dwells
instead.
"""

FlankLine: TypeAlias = tuple[Any, Any, Any, Any, Any, Any]
"""Six values of a contact in approach at alpha_1 = x and alpha_2 = y: sin(x/2), sin psi, cos psi, s, q and sin y.

Here psi = x + beta1 is the direction of the driver's flank, beta1 is the half aperture angle, and s and q are the sine
and cosine of psi + y.
"""

DrivenApex: TypeAlias = tuple[Any, Any, Any, Any, Any]
"""Five values of a contact in recess or slip at alpha_1 = x and alpha_2 = y: sin x, cos x, arm, sin y and cos y.

The arm is R2 cos(beta2) - v, where R2 is the tip radius and beta2 the half aperture angle of the driven wheel, and v is
the smaller root of Eq. (16).
"""


class ToothPair:
    """Constants of one pair of triangular teeth, and its contact as a function of the angle alpha_1 = x [rad] of the
    driver's apex from the line of centres. The parameter `m` of a method is `math` or, for arrays, `numpy`.
    """

    __slots__ = ("D", "R1", "R2", "cos1", "cos2", "delta", "entry", "leans", "mirror", "side", "sign2", "sin1", "sin2")

    def __init__(self, sizes: TriangularSizes) -> None:
        self.R1, self.R2 = sizes.signed_radii
        self.side, (self.mirror, self.sign2) = sizes.side, sizes.signs
        self.D, self.delta = self.side * sizes.D, sizes.delta
        self.sin1, self.cos1 = self.mirror * math.sin(sizes.beta1), math.cos(sizes.beta1)
        self.sin2, self.cos2 = self.mirror * math.sin(sizes.beta2), math.cos(sizes.beta2)
        self.entry, self.leans = math.sin(sizes.reach1 / 2), sizes.lean[0]

    # -------------------------------------------------------------------------------------------- geometry of a contact

    def _flank_line(self, x: Any, m: ModuleType) -> FlankLine:
        # half angles: 1 - cos x would cancel near the line of centres
        u, w = m.sin(x / 2), m.cos(x / 2)
        sine, cosine = 2 * u * w, 1 - 2 * u * u
        sin_psi = self.sin1 * cosine + self.cos1 * sine
        cos_psi = self.cos1 * cosine - self.sin1 * sine
        c = (2 * self.R1 * u * (self.cos1 * w - self.sin1 * u) - self.delta * sin_psi) / self.R2
        s = sin_psi + c
        # a flank tangent to the tip circle has s = 1 up to rounding error
        q = m.sqrt(abs((1 - s) * (1 + s)))
        # sin(alpha_2) = s cos psi - q sin psi as a product with c = s - sin psi: the difference cancels at large z
        return u, sin_psi, cos_psi, s, q, c * (cos_psi + sin_psi * (sin_psi + s) / (cos_psi + q))

    def _driver_arm(self, u: Any, cos_psi: Any, q: Any) -> Any:
        """Return the distance, along the driver's flank, from the foot of the perpendicular from the driver's axis to
        the contact: R1 cos(beta1) - v, with v from Eq. (9). `u`, `cos_psi` and `q` are values of a `FlankLine`, where u
        = sin(x/2).
        """
        # with overhang W and its divisor vanish together; at such small tooth numbers the difference loses no digits
        if self.leans:
            return self.D * cos_psi - self.R2 * q
        W = 4 * self.D * self.R1 * (self.entry - u) * (self.entry + u)
        return self.R1 * self.cos1 - W / (self.D * cos_psi - self.R1 * self.cos1 + self.R2 * q)

    def _driven_apex(self, x: Any, m: ModuleType) -> DrivenApex:
        u = m.sin(x / 2)
        sine, cosine = 2 * u * m.cos(x / 2), 1 - 2 * u * u
        W = 4 * self.D * self.R1 * (self.entry - u) * (self.entry + u)
        foot = self.R2 * self.cos2
        square = foot * foot - W
        # negative where teeth overlap beyond their flanks; max(square, 0) written for arrays and numbers
        arm = self.sign2 * m.sqrt((square + abs(square)) / 2)
        # the smaller root foot - arm as a quotient, because the difference would cancel
        v = W / (foot + arm)
        across, along = self.R1 * sine, self.R2 - self.delta + 2 * self.R1 * u * u
        inner, outer = self.R2 - v * self.cos2, v * self.sin2
        square = self.R2 * self.R2 - W
        return sine, cosine, arm, (across * inner - along * outer) / square, (along * inner + across * outer) / square

    def _apex_directions(self, apex: DrivenApex) -> tuple[Any, Any, Any, Any, Any, Any]:
        """Return six values of a contact in recess at alpha_1 = x and alpha_2 = y: R2 cos(beta2) - v with v from Eq.
        (16), cosine and sine of beta2 - x - y, sine and cosine of beta2 - y, and sin x. beta2 is the half aperture
        angle of the driven wheel.
        """
        sine, cosine, arm, sin_y, cos_y = apex
        sin_psi, cos_psi = self.sin2 * cos_y - self.cos2 * sin_y, self.cos2 * cos_y + self.sin2 * sin_y
        return arm, cos_psi * cosine + sin_psi * sine, sin_psi * cosine - cos_psi * sine, sin_psi, cos_psi, sine

    # -------------------------------------------------------------------------------------------- motion and friction

    def angle(self, phase: str, x: Any, m: ModuleType = math) -> Any:
        """Return the angle alpha_2 [rad] of the driven apex from the line of centres at alpha_1 = x [rad], by Eq. (7)
        in approach and by Eq. (17) in recess and slip.

        If the driven apex touches the far side of an overhanging flank (`RETURN`), alpha_2 is the second root of Eq.
        (7).
        """
        if phase == RETURN:
            _, sin_psi, cos_psi, s, _, _ = self._flank_line(-x, m)
            return m.asin(s) + m.atan2(sin_psi, cos_psi) - math.pi
        return self._angle(phase, self._contact(phase, x, m), m)

    def normal_arms(self, phase: str, x: Any, m: ModuleType = math) -> tuple[Any, Any]:
        """Return the distances n1 and n2 of the two wheel centres from the common normal at the contact. The ratio
        n1/n2 is the speed ratio.

        They are computed from Eq. (11) in approach and from Eq. (18) in recess.
        """
        return self._arms(phase, self._contact(phase, x, m))

    def speed(self, phase: str, x: Any, m: ModuleType = math) -> Any:
        """Return the speed ratio tau = d alpha_2 / d alpha_1, by Eqs. (12) and (19); negative in the return phase."""
        if phase == RETURN:
            _, _, cos_psi, _, q, _ = self._flank_line(-x, m)
            return -1 - self.D * cos_psi / (self.R2 * q)
        first, second = self.normal_arms(phase, x, m)
        return first / second

    def angle_and_speed(self, phase: str, x: Any, m: ModuleType = math) -> tuple[Any, Any]:
        """Return `angle` and `speed` at the same x from one evaluation of the contact."""
        if phase == RETURN:
            return self.angle(phase, x, m), self.speed(phase, x, m)
        contact = self._contact(phase, x, m)
        first, second = self._arms(phase, contact)
        return self._angle(phase, contact, m), first / second

    def _contact(self, phase: str, x: Any, m: ModuleType) -> Any:
        """Return sines and cosines that describe the contact: a `FlankLine` in approach, otherwise a `DrivenApex`."""
        return self._flank_line(x, m) if phase == APPROACH else self._driven_apex(x, m)

    def _angle(self, phase: str, contact: Any, m: ModuleType) -> Any:
        if phase == APPROACH:
            *_, sin_y = contact
            return self.side * m.asin(sin_y)
        *_, sin_y, cos_y = contact
        return self.side * m.atan2(sin_y, cos_y)

    def _arms(self, phase: str, contact: Any) -> tuple[Any, Any]:
        if phase == APPROACH:
            u, _, cos_psi, _, q, _ = contact
            return self.mirror * self._driver_arm(u, cos_psi, q), self.sign2 * self.R2 * q
        arm, q, *_ = self._apex_directions(contact)
        return self.mirror * self.R1 * q, self.sign2 * arm

    def slope(self, phase: str, x: Any, m: ModuleType = math) -> Any:
        """Return the derivative of the speed ratio tau with respect to alpha_1 [1/rad].

        In approach, it is (1 + tau) [(1 + tau) tan(psi + alpha_2) - tan psi], where psi = alpha_1 + beta1. In recess,
        it is tau (1 + tau) [(1 + tau) tan(beta2 - alpha_1 - alpha_2) - tau tan(beta2 - alpha_2)]: in reversed motion
        the driven wheel meets the driver in approach at the ratio 1/tau, and the slope of this motion is multiplied by
        tau cubed. beta1 and beta2 are the half aperture angles of driver and driven wheel.
        """
        if phase == RETURN:
            _, sin_psi, cos_psi, s, q, _ = self._flank_line(-x, m)
            more = self.D * cos_psi / (self.R2 * q)
            return more * (more * s / q - sin_psi / cos_psi)
        if phase == APPROACH:
            u, sin_psi, cos_psi, s, q, _ = self._flank_line(x, m)
            more = 1 + self._driver_arm(u, cos_psi, q) / (self.R2 * q)
            return self.side * more * (more * s / q - sin_psi / cos_psi)
        arm, q, s, sin_psi, cos_psi, _ = self._apex_directions(self._driven_apex(x, m))
        tau = self.R1 * q / arm
        return self.side * tau * (1 + tau) * ((1 + tau) * s / q - tau * sin_psi / cos_psi)

    def friction(self, phase: str, x: Any, m: ModuleType = math) -> tuple[Any, Any, Any]:
        """Return three values: the side of the line of centres on which the contact is (1 or -1), and tan2 and tan1 of
        Eqs. (32) and (33). For each wheel, this is the distance of its centre from the line of the flank, divided by
        its distance from the common normal.

        If wheel 1 drives, the efficiency at the friction coefficient f is (1 - f side tan2) / (1 - f side tan1).
        """
        mirror = self.mirror
        if phase == APPROACH:
            u, _, cos_psi, s, q, sin_y = self._flank_line(x, m)
            side = self.side * m.copysign(1.0, sin_y)
            return side, mirror * s / q, mirror * self.R1 * self.sin1 / self._driver_arm(u, cos_psi, q)
        arm, q, s, _, _, sine = self._apex_directions(self._driven_apex(x, m))
        return m.copysign(1.0, sine), mirror * self.R2 * self.sin2 / arm, mirror * s / q

    def efficiency(self, phase: str, x: Any, f: Any, m: ModuleType = math) -> Any:
        """Return the sliding efficiency at the friction coefficient f, by the corrected Eqs. (32) and (33)."""
        side, tan2, tan1 = self.friction(phase, x, m)
        return (1 - f * side * tan2) / (1 - f * side * tan1)

    def sliding(self, phase: str, x: Any, m: ModuleType = math) -> Any:
        """Return the sliding velocity divided by the driver's angular speed, docs/shapes.md (14).

        The result is (1 + tau) times the distance of the contact from the instant centre, where tau is the speed ratio.
        With the tip radii R1 and R2 and the angle psi of the common normal from the pitch line, this distance is R2
        |sin alpha_2| / cos psi in approach and R1 |sin alpha_1| / cos psi in recess. (1 + tau) / cos psi is the centre
        distance divided by the distance of the driven axis from the normal.
        """
        if phase == APPROACH:
            *_, q, sin_y = self._flank_line(x, m)
            return abs(self.D) * abs(sin_y) / q
        sine, _, arm, _, _ = self._driven_apex(x, m)
        return abs(self.D * self.R1 * sine / arm)

    def moment_arms(self, phase: str, x: Any, f: Any, m: ModuleType = math) -> tuple[Any, Any]:
        """Return the distances b1 and b2 of the two wheel centres from the line of the contact force at the friction
        coefficient f, by the corrected Eqs. (28) to (31).

        This line is the normal, rotated about the contact by the friction angle. For each wheel, b = (n - f side h) /
        sqrt(1 + f^2), where h is the distance of the wheel centre from the line of the flank, docs/teeth.md (11a).
        """
        n1, n2 = self.normal_arms(phase, x, m)
        side, tan2, tan1 = self.friction(phase, x, m)
        length = m.hypot(1.0, f)
        return n1 * (1 - f * side * tan1) / length, n2 * (1 - f * side * tan2) / length

    def instant_centre(self, phase: str, x: Any, m: ModuleType = math) -> Any:
        """Return the distance O1C from the driver's axis to the instant centre, docs/teeth.md (11b).

        The instant centre is the intersection of the common normal and the line of centres.
        """
        n1, n2 = self.normal_arms(phase, x, m)
        return self.D * n1 / (self.mirror * n1 + self.sign2 * n2)

    def contact(self, x: float) -> float:
        """Return the angle alpha_2 [rad] of the driven apex at the angle alpha_1 = x of the driver's apex, where |x| is
        at most alpha_1max. It is the smaller of the angles in approach and in recess.
        """
        return float(min(self.angle(APPROACH, x), self.angle(RECESS, x)))
