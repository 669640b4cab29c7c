"""What keeps involute wheels from running: thick teeth, tips too long for roots or mates, a rack that undercuts."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, cos, degrees, hypot, sin
from typing import TYPE_CHECKING

from geartrain.conjugate.admissible import Fault, faults
from geartrain.conjugate.involutes import free_distance
from geartrain.conjugate.ringtips import tip_gap
from geartrain.errors import GearTrainError

if TYPE_CHECKING:
    from geartrain.conjugate.involutes import Involutes
    from geartrain.conjugate.path import Path

_ROUNDING = 1e-12  # modules


def involute_faults(pair: Involutes, path: Path) -> tuple[Fault, ...]:
    """All reasons why these wheels cannot run; empty if they can."""
    others = (fault for fault in faults(path, pair.halves) if fault.kind != "undercut")
    return (*_jam(pair), *_interference(pair, path), *_undercut(pair, path), *others, *_bottom(pair), *ring_tips(path))


def _jam(pair: Involutes) -> Iterator[Fault]:
    if pair.play < -_ROUNDING:
        try:
            apart = f"give a centre_distance of at least {free_distance(pair.first, pair.second):.6g} modules, or "
        except GearTrainError:
            apart = ""
        yield Fault(
            "jam",
            0,
            float("nan"),
            "the teeth jam",
            f"at the centre distance {pair.distance:.6g} modules they are thicker than the spaces by {-pair.play:.4g}",
            f"{apart}thin them with `backlash`, or shift the wheels less",
        )


def _interference(pair: Involutes, path: Path) -> Iterator[Fault]:
    """Where the tip of the mate goes past the point at which the line of action touches the base circle."""
    across = pair.distance * sin(pair.psi)
    for gear, mate, own, X in ((1, pair.second, pair.first, -path.arcs[0]), (2, pair.first, pair.second, path.arcs[1])):
        limit = hypot(mate.base, across)
        over = (limit - mate.tip) if mate.ring else (mate.tip - limit)
        if own.ring or over <= _ROUNDING:
            continue
        reach = path.pitch.reach if gear == 1 else path.pitch.reach2
        most = mate.addendum - over
        yield Fault(
            "interference",
            gear,
            X,
            f"the tips of gear {3 - gear} run into the roots of gear {gear}",
            f"their contact would go on past {degrees(_tangent(pair, path, gear) / reach):.6g} deg from the pitch "
            f"point, where the involute of gear {gear} begins at its base circle",
            f"give gear {3 - gear} an addendum of at most {most:.4g} modules, shift gear {gear} outwards, or take more "
            "teeth or a larger pressure angle",
        )


def _tangent(pair: Involutes, path: Path, gear: int) -> float:
    """Arc from the pitch point to where the line of action touches a gear's base circle: R tan psi."""
    R = path.pitch.R1 if gear == 1 else path.pitch.R2
    sine = sin(pair.psi)
    return float(R * sine / (1 - sine * sine) ** 0.5)


def _undercut(pair: Involutes, path: Path) -> Iterator[Fault]:
    """Where the rack's corner has cut away what the mate's tip should work on."""
    for gear, wheel, arc in ((1, pair.first, path.arcs[0]), (2, pair.second, path.arcs[1])):
        gone = wheel.undercut()
        R = path.pitch.R1 if gear == 1 else path.pitch.R2
        lowest = hypot(wheel.base, max(R * sin(pair.psi) - arc * cos(pair.psi), 0.0))
        if gone > lowest + _ROUNDING:
            least = wheel.cut - wheel.r * sin(wheel.psi) ** 2
            teeth = ceil(2 * (wheel.cut - wheel.shift) / sin(wheel.psi) ** 2 - 1e-9)
            yield Fault(
                "undercut",
                gear,
                (-1 if gear == 1 else 1) * arc,
                f"gear {gear} is undercut",
                f"the rack's corner cuts its involute away up to a radius of {gone:.6g} modules, and contact goes down "
                f"to {lowest:.6g}",
                f"shift gear {gear} outwards by {least:.4g} modules, or give it {teeth} teeth",
            )


def _bottom(pair: Involutes) -> Iterator[Fault]:
    """Where tips touch the bottom of the mate's spaces."""
    first, second = pair.first, pair.second
    if second.ring:
        room = second.root - pair.distance - first.tip, second.tip - pair.distance - first.root
    else:
        room = pair.distance - first.tip - second.root, pair.distance - second.tip - first.root
    for gear, left in zip((1, 2), room, strict=True):
        if left < -_ROUNDING:
            yield Fault(
                "clearance",
                gear,
                float("nan"),
                f"the tips of gear {gear} touch the bottom of the spaces of gear {3 - gear}",
                f"they are {-left:.4g} modules too long",
                f"give gear {gear} a smaller addendum, gear {3 - gear} a deeper dedendum, or more centre distance",
            )


def ring_tips(path: Path) -> Iterator[Fault]:
    """Where the tips of a pinion run into those of its ring after they have parted."""
    gap = tip_gap(path)
    if gap < 0:
        pitch = path.pitch
        yield Fault(
            "interference",
            0,
            path.arcs[1],
            "the tips of the pinion run into the tips of the ring",
            f"they cross {degrees(-gap):.4g} deg of the ring too far, of its pitch of {360 / pitch.z2:.4g} deg",
            "give the ring more teeth, or both shorter addenda",
        )
