"""Checks that teeth with a path of contact can be made and can drive: undercut, pointed tips, contact ratio.

Involutes have further checks: backlash, tips too long for the mate's roots or flanks, undercut by the rack, and tips
of a pinion and its ring gear that collide after their teeth have left contact.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import acos, atan2, ceil, cos, degrees, hypot, inf, nan, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.involute_geometry import free_distance
from geartrain.teeth.conjugate.path_of_contact import PathOfContact
from geartrain.teeth.pair_results import ToothFault

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.involute_geometry import InvolutePair

Halves = tuple[float, float]
"""Half-thicknesses of the teeth of gears 1 and 2, as arcs X on the pitch surface [module]; infinite for round pins."""

_SCAN = 257  # contacts sampled on a side; a speed below 0 only between two samples is not detected
_LEAVES = 12.5  # tooth number below which clockmakers cut cycloids
_ROUNDING = 1e-12  # modules: a smaller overlap is not a fault


def faults(path: PathOfContact, halves: Halves) -> tuple[ToothFault, ...]:
    """Return all faults of teeth with this path of contact and these half-thicknesses; empty if the teeth can run."""
    return (*_undercuts(path), *_pointed(path, halves), *_contact_ratio_fault(path))


def _undercuts(path: PathOfContact) -> Iterator[ToothFault]:
    """Yield a fault for each point of a profile at which the contact has zero speed along the profile. At such a point
    the profile has a cusp. Beyond the cusp, the teeth are undercut.
    """
    for recess in (False, True):
        if not (span := path.span(recess)):
            continue
        # the pitch point itself is excluded: U is 0 there for psi = 0, as for a cycloid
        d = span[0] + (span[1] - span[0]) * np.linspace(0, 1, _SCAN)[1:]
        contact = path.along(d, recess)
        for gear, U in ((1, contact.U1), (2, contact.U2)):
            if (U <= 0).any():
                X = _dwell(path, d, U, gear, recess)
                angle = degrees(X / path.pitch.reach_of(gear))
                where = "recess" if recess else "approach"
                why = f"in {where} the contact speed on its dedendum is 0 at {abs(angle):.6g} deg from the pitch point"
                limit = f"{abs(X) / path.pitch.p:.6g} pitches"
                fix = f"end the {where} before {limit}, or use more teeth or a larger pressure angle"
                yield ToothFault("undercut", gear, X, f"gear {gear} is undercut", why, fix)


def _dwell(path: PathOfContact, d: Floats, U: Floats, gear: int, recess: bool) -> float:
    """Return the arc X on the pitch surfaces at which the contact first has zero speed along the profile of `gear`, in
    recess if `recess` is True. The result is refined between two entries of `d` (distances from the pitch point) and
    `U` (speeds).
    """
    at = int(np.argmax(U <= 0))
    if at == 0:
        return 0.0

    def speed(x: float) -> float:
        contact = path.along(np.array([x]), recess)
        return float((contact.U1 if gear == 1 else contact.U2)[0])

    low, high = float(d[at - 1]), float(d[at])
    found = root(speed, low, high, float(U[at - 1]), float(U[at])) if U[at] < 0 else high
    return float(path.along(np.array([found]), recess).X[0])


def _pointed(path: PathOfContact, halves: Halves) -> Iterator[ToothFault]:
    """Yield a fault for each gear whose flanks would intersect below the tip, given both half-thicknesses `halves`."""
    for gear, X in ((1, path.arcs[1]), (2, -path.arcs[0])):
        thickness = partial(tooth_thickness, path, gear, halves)
        if not X or not (at_tip := thickness(X)) < 0:
            continue
        # contact on one side only does not reach the pitch point
        foot = path.ends(gear)[0] if path.ends(gear)[0] * X > 0 else 0.0
        at_foot = thickness(foot)
        # arc at which the flanks intersect; 0 if they intersect from the start
        point = root(thickness, foot, X, at_foot, at_tip) if at_foot > 0 else 0.0
        # a tip of gear 1 works in recess, a tip of gear 2 in approach
        name, end = ("recess" if X > 0 else "approach"), ("end" if (X > 0) == (gear == 1) else "begin")
        shorter = f"{end} the {name} before {abs(point) / path.pitch.p:.6g} pitches, or use a smaller pressure angle"
        fix = shorter if point else "give thicker teeth by less backlash or by a profile shift outwards"
        pitch = 360 / path.pitch.teeth_of(gear)
        why = f"the flanks of a tooth would cross by {-degrees(at_tip):.4g} deg; the pitch is {pitch:.4g} deg"
        yield ToothFault("pointed", gear, X, f"the teeth of gear {gear} come to a point before their tips", why, fix)


def tooth_thickness(path: PathOfContact, gear: int, halves: Halves, X: float) -> float:
    """Return the angular thickness of a tooth of `gear` [rad] at the profile point that is in contact at the arc X on
    the pitch surfaces; negative if the flanks have intersected before. `halves` are the half-thicknesses at X = 0.
    """
    _, forwards = path.pitch.polar(gear, path.flank(gear, X))
    # a driver's tooth is behind its flank, a driven tooth ahead of it
    towards_middle = -float(forwards) if gear == 1 else float(forwards)
    return 2 * (halves[gear - 1] / path.pitch.reach_of(gear) - towards_middle)


def _contact_ratio_fault(path: PathOfContact) -> Iterator[ToothFault]:
    ratio = path.contact_ratio
    # arcs with a sum of one pitch give 1 except for rounding
    if ratio < 1 - 1e-12:
        why = "one tooth pair leaves contact before the next one enters it"
        fix = "lengthen approach or recess until their sum is at least one pitch"
        yield ToothFault("contact ratio", 0, nan, f"the contact ratio {ratio:.6g} is below 1", why, fix)


# ------------------------------------------------------------------------------------------------------------ involutes


def tip_gap(path: PathOfContact) -> float:
    """Return the angle at the ring gear [rad] between the tip of a pinion tooth and the tip of the ring tooth that it
    drives.

    The angle is measured where the pinion's tip, which is faster, leaves the ring's tip circle. The angle is negative
    if the tips collide before that. If the pinion's tip is always inside this circle, the angle is measured opposite
    the mesh, where the pinion is ahead by half the difference of the tooth numbers in pitches. The angle is infinite
    unless the pair is a spur pinion in a ring gear with intersecting tip circles.
    """
    pitch = path.pitch
    if pitch.bevel or pitch.R2 > 0:
        return inf
    a = -pitch.R2 - pitch.R1
    (r1, start1), (r2, start2) = (
        map(float, pitch.polar(gear, path.flank(gear, path.ends(gear)[1]))) for gear in (1, 2)
    )
    # coaxial wheels (a = 0) have concentric tip circles, which do not intersect
    cosine = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1) if a > 0 else 2.0
    if cosine >= 1:
        return inf
    crossing = acos(max(cosine, -1.0))
    X = pitch.R1 * (crossing - start1)
    return start2 - X / pitch.R2 - atan2(r1 * sin(crossing), a + r1 * cos(crossing))


def involute_faults(pair: InvolutePair, path: PathOfContact) -> tuple[ToothFault, ...]:
    """Return all faults that prevent these involute wheels from running; an empty tuple if the wheels can run."""
    # the undercut of an involute follows from the rack's corner instead of the contact speed
    others = (fault for fault in faults(path, pair.halves) if fault.kind != "undercut")
    return (*_jam(pair), *_interference(pair, path), *_undercut(pair, path), *others, *_bottom(pair), *ring_tips(path))


def _jam(pair: InvolutePair) -> Iterator[ToothFault]:
    if pair.backlash < -_ROUNDING:
        try:
            # no distance may exist at which the teeth are free; then this advice is omitted
            apart = f"give a centre_distance of at least {free_distance(pair.first, pair.second):.6g} modules, or "
        except GearTrainError:
            apart = ""
        thick = f"{-pair.backlash:.4g} modules thicker than the spaces"
        why = f"at the centre distance {pair.distance:.6g} modules the teeth are {thick}"
        fix = f"{apart}thin the teeth with `backlash`, or reduce the profile shifts"
        yield ToothFault("jam", 0, nan, "the teeth jam", why, fix)


def _interference(pair: InvolutePair, path: PathOfContact) -> Iterator[ToothFault]:
    """Yield a fault for each wheel whose tip passes the end of the line of action on the mate's base circle."""
    across = pair.distance * sin(pair.psi)
    for gear, mate, own, X in ((1, pair.second, pair.first, -path.arcs[0]), (2, pair.first, pair.second, path.arcs[1])):
        # radius of the mate at the point where the line of action touches the base circle of this gear
        limit = hypot(mate.base, across)
        over = (limit - mate.tip) if mate.ring else (mate.tip - limit)
        # the involute of a ring continues outwards from its base circle, so it has no such limit
        if own.ring or over <= _ROUNDING:
            continue
        # the line of action touches the base circle at the arc R tan(psi) from the pitch point
        angle = degrees(tan(pair.psi))
        what = f"the tips of gear {3 - gear} run into the roots of gear {gear}"
        start = f"{angle:.6g} deg from the pitch point, where the involute of gear {gear} begins at its base circle"
        lower = f"give gear {3 - gear} an addendum of at most {mate.addendum - over:.4g} modules"
        fix = f"{lower}, shift gear {gear} outwards, or use more teeth or a larger pressure angle"
        yield ToothFault("interference", gear, X, what, f"their contact would continue past {start}", fix)


def _undercut(pair: InvolutePair, path: PathOfContact) -> Iterator[ToothFault]:
    """Yield a fault for each wheel whose flank the rack's corner has cut away where the mate's tip touches it."""
    for gear, wheel, arc in ((1, pair.first, path.arcs[0]), (2, pair.second, path.arcs[1])):
        cut_radius = wheel.undercut()
        R = path.pitch.R1 if gear == 1 else path.pitch.R2
        lowest = hypot(wheel.base, max(R * sin(pair.psi) - arc * cos(pair.psi), 0.0))
        if cut_radius > lowest + _ROUNDING:
            minimum = wheel.cut - wheel.r * sin(wheel.psi) ** 2
            # an integer raised slightly by rounding must not become the next integer
            teeth = ceil(2 * (wheel.cut - wheel.shift) / sin(wheel.psi) ** 2 - 1e-9)
            other = ", or use `form: cycloidal`, which suits pinions of few leaves" if 2 * wheel.r <= _LEAVES else ""
            cut = f"the rack's corner cuts its involute away up to a radius of {cut_radius:.6g} modules"
            why = f"{cut}, but contact extends down to {lowest:.6g}"
            fix = f"shift gear {gear} outwards by {minimum:.4g} modules, or give it {teeth} teeth{other}"
            X = -arc if gear == 1 else arc
            yield ToothFault("undercut", gear, X, f"gear {gear} is undercut", why, fix)


def _bottom(pair: InvolutePair) -> Iterator[ToothFault]:
    """Yield a fault for each wheel whose tips touch the bottom of the mate's tooth spaces."""
    for gear in (1, 2):
        gap = pair.bottom_clearance(3 - gear)
        if gap < -_ROUNDING:
            what = f"the tips of gear {gear} touch the bottom of the spaces of gear {3 - gear}"
            deeper = f"gear {3 - gear} a deeper dedendum, or a larger centre distance"
            fix = f"give gear {gear} a smaller addendum, {deeper}"
            yield ToothFault("clearance", gear, nan, what, f"they are {-gap:.4g} modules too long", fix)


def ring_tips(path: PathOfContact) -> Iterator[ToothFault]:
    """Yield a fault if the tips of a pinion and of its ring gear collide after their teeth have left contact."""
    gap = tip_gap(path)
    if gap < 0:
        what = "the tips of the pinion run into the tips of the ring"
        why = f"they overlap by {degrees(-gap):.4g} deg of the ring, whose pitch is {360 / path.pitch.z2:.4g} deg"
        fix = "give the ring more teeth, or both wheels shorter addenda"
        yield ToothFault("interference", 0, path.arcs[1], what, why, fix)
