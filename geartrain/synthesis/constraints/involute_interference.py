"""Where involute teeth of a pair get in each other's way: undercut, and tips beyond the mate's involute."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_CEILING, localcontext
from fractions import Fraction
from math import cos, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.synthesis.constraints.count_conditions import Condition, counts_of, free_of
from geartrain.synthesis.constraints.decimal_sines import decimal, is_positive, sine

if TYPE_CHECKING:
    from decimal import Decimal

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.synthesis.constraints.count_conditions import CandidateColumns, CountRef
    from geartrain.synthesis.constraints.train_assembly import AssemblyMesh


def least_teeth(pressure: Fraction, addendum: Fraction) -> int:
    """Least teeth of a spur wheel that a rack does not undercut: z >= 2 h / sin(alpha)^2, rounded up.

    pressure   alpha, turns (0 to 1/4); addendum h of the rack, modules. 18 at 20 degrees (17.1), 32 at 14.5
    The rack's tip reaches h below the pitch line; the involute ends where the line of action leaves the base circle,
    r sin(alpha)^2 below it.
    """
    with localcontext(prec=50):
        limit = decimal(2 * addendum) / sine(pressure) ** 2
        # what agrees with a whole number in 25 digits is that number, and is not rounded up past it
        return int((limit - decimal(Fraction(1, 10**25))).to_integral_value(ROUND_CEILING))


def external_terms(root: Any, z1: Any, z2: Any, square: Any, h: Any) -> tuple[Any, ...]:
    """Terms of z1 (z1 + 2 z2) sin(alpha)^2 - 4 h (z2 + h): 0 or more if the tip of 2 stays on the involute of 1.

    The tip circle of 2 must cut the line of action before the point where that touches the base circle of 1:
    r_a2^2 - r_b2^2 <= (a sin alpha)^2. With r_a2 = z2/2 + h, r_b2 = z2 cos(alpha)/2, a = (z1 + z2)/2 the squares of z2
    cancel. For z2 without end it is z1 sin(alpha)^2 >= 2 h, the rack. Solved for z1 it is the least pinion that
    textbooks of machine elements print (Shigley, at 20 degrees: 13 teeth go with 16 at most, 14 with 26, 15 with 45).
    """
    return z1 * (z1 + 2 * z2) * square, -4 * h * (z2 + h)


def ring_terms(root: Any, z1: Any, z2: Any, square: Any, h: Any) -> tuple[Any, ...]:
    """Terms of z1 (2 z2 - z1) sin(alpha)^2 - 4 h (z2 - h): 0 or more if the ring's tip stays on the involute of 1.

    h is the ring's addendum. As for an external pair with z2 and h negative; derived apart: the ring's tip circle must
    cut the line of action beyond the point where that touches the base circle of 1, counted from the ring's own,
    r_a2^2 - r_b2^2 >= (a sin alpha)^2 with r_a2 = z2/2 - h and a = (z2 - z1)/2.
    """
    return z1 * (2 * z2 - z1) * square, -4 * h * (z2 - h)


def tip_room(z1: Any, z2: Any, pressure: float, h1: float, h2: float) -> Floats:
    """Angle by which the corner of a planet's tooth passes that of a ring's on its way out (rad, about the ring).

    z1, z2     teeth of the planet and the ring, arrays; z2 > z1
    pressure   rad; h1, h2 addenda in modules. Teeth without play; negative where the corners meet
    Known as trochoid interference (Elements of Metric Gear Technology, SDP/SI, equations 5-6 and 5-7). When the
    planet's corner stands on the ring's tip circle, at theta1 about its own axis and theta2 about the ring's (both from
    the line of centres), the planet has turned from where its flank met the pitch point by
    phi = theta1 + inv(alpha_a1) - inv(alpha), for the tooth is thinner at its tip, and the ring by phi z1/z2; the
    corner of the ring's tooth ahead is then at phi z1/z2 + inv(alpha) - inv(alpha_a2).
    -inf where the ring's tip circle lies within its base circle, or within the planet's tip circle. At 20 degrees and
    full depth a ring of 34 to 77 teeth wants 9 more than the planet, a larger one 8; the source says "larger than 9".
    """
    z1, z2 = np.asarray(z1, dtype=float), np.asarray(z2, dtype=float)
    r1, r2, a = z1 / 2 + h1, z2 / 2 - h2, (z2 - z1) / 2
    C = cos(pressure)
    with np.errstate(divide="ignore", invalid="ignore"):
        out = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1)
        # clipped: sets whose tip circles do not cross are set aside at the end
        theta1 = np.arccos(np.clip(out, -1, 1))
        theta2 = np.arccos(np.clip((a * a + r2 * r2 - r1 * r1) / (2 * a * r2), -1, 1))
        tip1 = np.arccos(z1 * C / (2 * r1))
        tip2 = np.arccos(np.clip(z2 * C / (2 * r2), -1, 1))
        phi = theta1 + involute(tip1) - involute(pressure)
        room = phi * z1 / z2 + involute(pressure) - involute(tip2) - theta2
    possible = (a > 0) & (r2 > r1 - a) & (2 * r2 >= z2 * C)
    # a planet whose tips never reach the ring's tip circle has nothing to pass
    return np.asarray(np.where(out > 1, np.where(a > 0, np.inf, -np.inf), np.where(possible, room, -np.inf)))


def involute(angle: Any) -> Floats:
    """inv(alpha) = tan(alpha) - alpha (rad)."""
    return np.asarray(np.tan(angle) - angle)


@dataclass(frozen=True, slots=True)
class OnInvolute:
    """Tips of an external pair stay on each other's involute, exactly."""

    first: CountRef
    second: CountRef
    pressure: Fraction
    addendum: Fraction

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where they do, (candidates,)."""
        z1, z2 = counts_of(columns, self.first), counts_of(columns, self.second)
        constants = _square(self.pressure), decimal(self.addendum)
        one = is_positive(external_terms, [z1, z2], constants, False)
        return np.asarray(one & is_positive(external_terms, [z2, z1], constants, False))


@dataclass(frozen=True, slots=True)
class InRing:
    """Tips of a planet and a ring keep clear of each other's flanks. Tips that pass by less than 1e-9 rad meet."""

    planet: CountRef
    ring: CountRef
    pressure: Fraction
    addendum: Fraction
    ring_addendum: Fraction

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where they do, (candidates,)."""
        z1, z2 = counts_of(columns, self.planet), counts_of(columns, self.ring)
        fits = np.asarray((z2 > z1) & (z2 > float(2 * self.ring_addendum)))
        fits &= is_positive(ring_terms, [z1, z2], [_square(self.pressure), decimal(self.ring_addendum)], False)
        angle = float(self.pressure) * 2 * pi
        return np.asarray(fits & (tip_room(z1, z2, angle, float(self.addendum), float(self.ring_addendum)) > 1e-9))


def _square(pressure: Fraction) -> Decimal:
    with localcontext(prec=70):
        return sine(pressure) ** 2


def interference(
    mesh: AssemblyMesh, pressure: Fraction, addendum: Fraction, ring_addendum: Fraction
) -> Iterator[Condition]:
    """The condition on a spur pair with a free count. Angles in turns, addenda in modules."""
    wheels = free_of(*mesh.parts)
    if not wheels or not mesh.spur:
        return
    name = f"interference: '{mesh.wheels[0]}' and '{mesh.wheels[1]}' at {float(pressure * 360):g} deg"
    if mesh.ring is None:
        yield Condition(name, wheels, OnInvolute(*mesh.parts, pressure, addendum))
    else:
        planet, ring = mesh.parts[1 - mesh.ring], mesh.parts[mesh.ring]
        yield Condition(name, wheels, InRing(planet, ring, pressure, addendum, ring_addendum))
