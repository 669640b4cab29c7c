"""What keeps involute wheels from running: thick teeth, tips too long for roots or mates, a rack that undercuts, and
tips of a pinion and its ring that do not clear each other after they have parted.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import acos, atan2, ceil, cos, degrees, hypot, inf, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError
from geartrain.teeth.conjugate.admissibility import faults
from geartrain.teeth.conjugate.involute_geometry import free_distance
from geartrain.teeth.pair_verdict import ToothFault

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.involute_geometry import InvolutePair
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

_LEAVES = 12.5  # teeth below which clockmakers cut cycloids


def tip_gap(path: PathOfContact) -> float:
    """Angle (rad of the ring) between the tip of a pinion's tooth and that of the ring's it has driven.

    Taken where the pinion's tip, the faster, leaves the ring's tip circle; negative where it would have run into the
    ring's tooth; where it never leaves, on the far side, where the teeth have slipped by half their difference.
    Infinite for any pair but a spur pinion in a ring with parted tip circles.
    """
    pitch = path.pitch
    if pitch.bevel or pitch.R2 > 0:
        return inf
    a = -pitch.R2 - pitch.R1
    (r1, start1), (r2, start2) = (
        _polar(flank(np.array([X]))[0], R)
        for flank, X, R in ((path.flank1, path.arcs[1], -pitch.R1), (path.flank2, -path.arcs[0], pitch.R2))
    )
    cosine = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1) if a > 0 else 2.0
    if cosine >= 1:
        return inf
    crossing = acos(max(cosine, -1.0))
    X = pitch.R1 * (crossing - start1)
    return start2 - X / pitch.R2 - atan2(r1 * sin(crossing), a + r1 * cos(crossing))


def _polar(point: Floats, height: float) -> tuple[float, float]:
    """Distance from a centre at `height` over the pitch point, and azimuth from straight up, forwards."""
    x, y = float(point[0]), float(point[1]) - height
    return (x * x + y * y) ** 0.5, atan2(x, y)


_ROUNDING = 1e-12  # modules


def involute_faults(pair: InvolutePair, path: PathOfContact) -> tuple[ToothFault, ...]:
    """All reasons why these wheels cannot run; empty if they can."""
    others = (fault for fault in faults(path, pair.halves) if fault.kind != "undercut")
    return (*_jam(pair), *_interference(pair, path), *_undercut(pair, path), *others, *_bottom(pair), *ring_tips(path))


def _jam(pair: InvolutePair) -> Iterator[ToothFault]:
    if pair.play < -_ROUNDING:
        try:
            apart = f"give a centre_distance of at least {free_distance(pair.first, pair.second):.6g} modules, or "
        except GearTrainError:
            apart = ""
        yield ToothFault(
            "jam",
            0,
            float("nan"),
            "the teeth jam",
            f"at the centre distance {pair.distance:.6g} modules they are thicker than the spaces by {-pair.play:.4g}",
            f"{apart}thin them with `backlash`, or shift the wheels less",
        )


def _interference(pair: InvolutePair, path: PathOfContact) -> Iterator[ToothFault]:
    """Where the tip of the mate goes past the point at which the line of action touches the base circle."""
    across = pair.distance * sin(pair.psi)
    for gear, mate, own, X in ((1, pair.second, pair.first, -path.arcs[0]), (2, pair.first, pair.second, path.arcs[1])):
        limit = hypot(mate.base, across)
        over = (limit - mate.tip) if mate.ring else (mate.tip - limit)
        if own.ring or over <= _ROUNDING:
            continue
        reach = path.pitch.reach if gear == 1 else path.pitch.reach2
        most = mate.addendum - over
        yield ToothFault(
            "interference",
            gear,
            X,
            f"the tips of gear {3 - gear} run into the roots of gear {gear}",
            f"their contact would go on past {degrees(_tangent(pair, path, gear) / reach):.6g} deg from the pitch "
            f"point, where the involute of gear {gear} begins at its base circle",
            f"give gear {3 - gear} an addendum of at most {most:.4g} modules, shift gear {gear} outwards, or take more "
            "teeth or a larger pressure angle",
        )


def _tangent(pair: InvolutePair, path: PathOfContact, gear: int) -> float:
    """Arc from the pitch point to where the line of action touches a gear's base circle: R tan psi."""
    R = path.pitch.R1 if gear == 1 else path.pitch.R2
    sine = sin(pair.psi)
    return float(R * sine / (1 - sine * sine) ** 0.5)


def _undercut(pair: InvolutePair, path: PathOfContact) -> Iterator[ToothFault]:
    """Where the rack's corner has cut away what the mate's tip should work on."""
    for gear, wheel, arc in ((1, pair.first, path.arcs[0]), (2, pair.second, path.arcs[1])):
        gone = wheel.undercut()
        R = path.pitch.R1 if gear == 1 else path.pitch.R2
        lowest = hypot(wheel.base, max(R * sin(pair.psi) - arc * cos(pair.psi), 0.0))
        if gone > lowest + _ROUNDING:
            least = wheel.cut - wheel.r * sin(wheel.psi) ** 2
            # a whole number that rounding has raised a little is that number
            teeth = ceil(2 * (wheel.cut - wheel.shift) / sin(wheel.psi) ** 2 - 1e-9)
            other = ", or take `form: cycloidal`, which suits few leaves" if 2 * wheel.r <= _LEAVES else ""
            yield ToothFault(
                "undercut",
                gear,
                (-1 if gear == 1 else 1) * arc,
                f"gear {gear} is undercut",
                f"the rack's corner cuts its involute away up to a radius of {gone:.6g} modules, and contact goes down "
                f"to {lowest:.6g}",
                f"shift gear {gear} outwards by {least:.4g} modules, or give it {teeth} teeth{other}",
            )


def _bottom(pair: InvolutePair) -> Iterator[ToothFault]:
    """Where tips touch the bottom of the mate's spaces."""
    first, second = pair.first, pair.second
    if second.ring:
        room = second.root - pair.distance - first.tip, second.tip - pair.distance - first.root
    else:
        room = pair.distance - first.tip - second.root, pair.distance - second.tip - first.root
    for gear, left in zip((1, 2), room, strict=True):
        if left < -_ROUNDING:
            yield ToothFault(
                "clearance",
                gear,
                float("nan"),
                f"the tips of gear {gear} touch the bottom of the spaces of gear {3 - gear}",
                f"they are {-left:.4g} modules too long",
                f"give gear {gear} a smaller addendum, gear {3 - gear} a deeper dedendum, or more centre distance",
            )


def ring_tips(path: PathOfContact) -> Iterator[ToothFault]:
    """Where the tips of a pinion run into those of its ring after they have parted."""
    gap = tip_gap(path)
    if gap < 0:
        pitch = path.pitch
        yield ToothFault(
            "interference",
            0,
            path.arcs[1],
            "the tips of the pinion run into the tips of the ring",
            f"they cross {degrees(-gap):.4g} deg of the ring too far, of its pitch of {360 / pitch.z2:.4g} deg",
            "give the ring more teeth, or both shorter addenda",
        )
