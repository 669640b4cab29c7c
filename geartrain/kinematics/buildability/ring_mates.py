"""Whether rings hold the wheels that mesh with them, and standard teeth let their tips pass."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import count
from math import acos, asin, cos, inf, radians, sqrt, tan
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.pitch_distances import PitchPair

PRESSURE = radians(20)
"""Pressure angle (rad) of standard teeth, where none is declared."""


@lru_cache(maxsize=4096)
def tip_room(z1: int, z2: int, pressure: float, h1: float, h2: float) -> float:
    """Angle by which the corner of a planet's tooth passes that of a ring's on its way out (rad, about the ring).

    z1, z2     teeth of the planet and the ring; z2 > z1
    pressure   rad; h1, h2 addenda in modules. Teeth without play; negative where the corners meet
    Known as trochoid interference (Elements of Metric Gear Technology, SDP/SI, equations 5-6 and 5-7). When the
    planet's corner stands on the ring's tip circle, at theta1 about its own axis and theta2 about the ring's (both from
    the line of centres), the planet has turned from where its flank met the pitch point by
    phi = theta1 + inv(alpha_a1) - inv(alpha), for the tooth is thinner at its tip, and the ring by phi z1/z2; the
    corner of the ring's tooth ahead is then at phi z1/z2 + inv(alpha) - inv(alpha_a2).
    -inf where the ring's tip circle lies within its base circle, or within the planet's tip circle. At 20 degrees and
    full depth a ring of 34 to 77 teeth wants 9 more than the planet, a larger one 8; the source says "larger than 9".
    """
    r1, r2, a = z1 / 2 + h1, z2 / 2 - h2, (z2 - z1) / 2
    if a <= 0:
        return -inf
    out = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1)
    if out > 1:  # a planet whose tips never reach the ring's tip circle has nothing to pass
        return inf
    if r2 <= r1 - a or 2 * r2 < z2 * cos(pressure):
        return -inf
    theta1 = acos(max(out, -1.0))
    theta2 = acos(max(-1.0, min((a * a + r2 * r2 - r1 * r1) / (2 * a * r2), 1.0)))
    tip1, tip2 = acos(z1 * cos(pressure) / (2 * r1)), acos(min(z2 * cos(pressure) / (2 * r2), 1.0))
    phi = theta1 + _involute(tip1) - _involute(pressure)
    return phi * z1 / z2 + _involute(pressure) - _involute(tip2) - theta2


@lru_cache(maxsize=4096)
def radial_room(z1: int, z2: int, pressure: float, h1: float, h2: float) -> float:
    """Angle by which a planet's teeth clear the ring's when it is put in across its axis (rad, about the planet).

    Arguments as of `tip_room`; negative where tips meet on the way (trimming interference, SDP/SI equations 5-9 to
    5-11). At 20 degrees and full depth a ring wants 17 teeth more than the planet, one of 80 or 100 teeth 16.
    """
    tip1, tip2 = (acos(min(z * cos(pressure) / (z + 2 * h), 1.0)) for z, h in ((z1, h1), (z2, -h2)))
    lean = cos(tip2) / cos(tip1)
    outer = asin(sqrt(min(max((1 - lean**-2) / (1 - (z1 / z2) ** 2), 0.0), 1.0)))
    inner = asin(sqrt(min(max((lean**2 - 1) / ((z2 / z1) ** 2 - 1), 0.0), 1.0)))
    start = _involute(pressure)
    return outer + _involute(tip1) - start - z2 / z1 * (inner + _involute(tip2) - start)


def _involute(angle: float) -> float:
    return tan(angle) - angle


def least_ring(planet: int) -> int:
    """Teeth of the smallest ring in which standard teeth of a planet pass the ring's tips."""
    # a ring of fewer than 34 teeth has its tip circle within its base circle
    first = max(planet + 1, 34)
    return next(z for z in count(first) if tip_room(planet, z, PRESSURE, 1.0, 1.0) > 0)


def check_rings(pairs: Sequence[PitchPair]) -> Iterator[BuildFinding]:
    """Rules R1 to R3: a ring has more teeth than its mate, and standard ones of a rigid mate enough more."""
    for pair in pairs:
        if pair.ring is None or set(pair.kinds) != {"spur"}:
            continue
        ring, planet = pair.counts[pair.ring], pair.counts[1 - pair.ring]
        name, mate = pair.wheels[pair.ring], pair.wheels[1 - pair.ring]
        # a bent wheel's teeth go in and out along the radius, and clear the ring's on its short side
        judged = pair.form is None and not pair.declared[1 - pair.ring].flexible
        if ring <= planet:
            why = (
                f"the distance of their axes would be ({ring} - {planet})/2 modules, and a ring is larger than its mate"
            )
            fix = f"make the other wheel the ring, or write a ring of at least {least_ring(planet)}"
            what = f"pair '{pair.name}': ring '{name}' {ring} does not hold '{mate}' {planet}"
            yield BuildFinding("R1", "error", Problem(what, why, fix, pair.place))
        elif judged and 33 < ring < least_ring(planet):
            what = f"pair '{pair.name}': tips of '{mate}' {planet} run into tips of the ring '{name}' {ring}"
            why = "standard teeth of 20 degrees cross outside the mesh (trochoid interference)"
            fix = (
                f"declare a tooth form with shorter addenda or a larger angle, or write a ring of {least_ring(planet)}"
            )
            yield BuildFinding("R2", "note", Problem(what, why, fix, pair.place))
        elif judged and ring > 33 and radial_room(planet, ring, PRESSURE, 1.0, 1.0) < 0:
            what = f"pair '{pair.name}': '{mate}' {planet} must be pushed into the ring '{name}' {ring} along its axis"
            why = "across it tips of standard teeth run into each other (trimming interference)"
            fix = f"leave a way in from the side, or write a ring of {_radial_ring(planet)}"
            yield BuildFinding("R3", "note", Problem(what, why, fix, pair.place))


def _radial_ring(planet: int) -> int:
    """Teeth of the smallest ring that a planet with standard teeth is put into across its axis."""
    return next(z for z in count(max(least_ring(planet), 34)) if radial_room(planet, z, PRESSURE, 1.0, 1.0) >= 0)
