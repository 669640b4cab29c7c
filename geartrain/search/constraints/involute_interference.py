"""Where involute teeth of a pair get in each other's way: undercut, and tips beyond the mate's involute."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_CEILING, localcontext
from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.kinematics.buildability.pitch_distances import tip_room
from geartrain.search.constraints.count_conditions import Condition, counts_of, free_of
from geartrain.search.constraints.decimal_sines import decimal, is_positive, sine

if TYPE_CHECKING:
    from decimal import Decimal

    from geartrain.kinematics.buildability.equal_planets import AssemblyMesh, CountRef
    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.search.constraints.count_conditions import CandidateColumns


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


def tip_rooms(z1: Any, z2: Any, pressure: float, h1: float, h2: float) -> Floats:
    """`tip_room` of each candidate (rad); arguments as there, tooth counts as arrays of one shape."""
    planets, rings = np.broadcast_arrays(np.asarray(z1, dtype=np.int64), np.asarray(z2, dtype=np.int64))
    # many candidates share a few pairs of counts
    pairs, which = np.unique(np.stack((planets.ravel(), rings.ravel())), axis=1, return_inverse=True)
    rooms = np.array([tip_room(planet, ring, pressure, h1, h2) for planet, ring in pairs.T.tolist()], dtype=float)
    return np.asarray(rooms[which.ravel()].reshape(planets.shape))


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
        return np.asarray(fits & (tip_rooms(z1, z2, angle, float(self.addendum), float(self.ring_addendum)) > 1e-9))


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
