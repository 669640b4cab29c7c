"""Whether teeth with a path of contact can be made and can drive: undercut, pointed tips, contact ratio."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_of_contact import PathOfContact
from geartrain.teeth.pair_verdict import ToothFault

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Halves = tuple[float, float]
"""Half the thickness of a tooth of each gear on its pitch surface, as X; infinite for pins, which have no point."""

_SCAN = 257  # contacts of a side: a speed that is below 0 between two of them only is not seen


def faults(path: PathOfContact, halves: Halves | None = None) -> tuple[ToothFault, ...]:
    """All reasons why teeth with this path cannot run; empty if they can. `halves` default to a quarter pitch."""
    return (*_undercuts(path), *_pointed(path, halves), *_broken(path))


def _undercuts(path: PathOfContact) -> Iterator[ToothFault]:
    """Where the contact would stand still on a profile: U = 0, a cusp, and undercut beyond it."""
    for recess in (False, True):
        if not (span := path.span(recess)):
            continue
        # not from the pitch point itself, where U is 0 for psi = 0, as of a cycloid
        d = span[0] + (span[1] - span[0]) * np.linspace(0, 1, _SCAN)[1:]
        contact = path.along(d, recess)
        for gear, U in ((1, contact.U1), (2, contact.U2)):
            if (U <= 0).any():
                X = _standstill(path, d, U, gear, recess)
                angle = degrees(X / path.pitch.reach_of(gear))
                where = "recess" if recess else "approach"
                yield ToothFault(
                    "undercut",
                    gear,
                    X,
                    f"gear {gear} is undercut",
                    f"in {where} the contact stands still on its dedendum {abs(angle):.6g} deg from the pitch point",
                    f"end the {where} before {abs(X) / path.pitch.p:.6g} pitches, or take more teeth or a larger "
                    "pressure angle",
                )


def _standstill(path: PathOfContact, d: Floats, U: Floats, gear: int, recess: bool) -> float:
    """X at the first distance where U of one gear is 0."""
    at = int(np.argmax(U <= 0))
    if at == 0:
        return 0.0

    def speed(x: float) -> float:
        contact = path.along(np.array([x]), recess)
        return float((contact.U1 if gear == 1 else contact.U2)[0])

    low, high = float(d[at - 1]), float(d[at])
    found = root(speed, low, high, float(U[at - 1]), float(U[at])) if U[at] < 0 else high
    return float(path.along(np.array([found]), recess).X[0])


def _pointed(path: PathOfContact, halves: Halves | None) -> Iterator[ToothFault]:
    """Where the two flanks of a tooth would meet before its tip."""
    for gear, X in ((1, path.arcs[1]), (2, -path.arcs[0])):
        if X and (room := tip_thickness(path, gear, halves)) < 0:
            z = path.pitch.teeth_of(gear)
            name = "recess" if X > 0 else "approach"
            point = _point(path, gear, X, halves)
            end = "end" if (X > 0) == (gear == 1) else "begin"
            shorter = (
                f"{end} the {name} before {abs(point) / path.pitch.p:.6g} pitches, or take a smaller pressure angle"
            )
            yield ToothFault(
                "pointed",
                gear,
                X,
                f"the teeth of gear {gear} come to a point before their tips",
                f"their flanks would cross by {-degrees(room):.4g} deg of its {360 / z:.4g} deg pitch",
                shorter if point else "leave its teeth some thickness: give less backlash, or shift it outwards",
            )


def _point(path: PathOfContact, gear: int, X: float, halves: Halves | None) -> float:
    """X of the contact at which the flanks of a tooth cross; 0 where they do from the first."""

    def room(x: float) -> float:
        return _thickness(path, gear, x, halves)

    foot, _ = path.ends(gear)
    foot = foot if foot * X > 0 else 0.0  # contact on one side of the pitch point keeps off it
    at_foot, at_tip = room(foot), room(X)
    return root(room, foot, X, at_foot, at_tip) if at_foot > 0 else 0.0


def tip_thickness(path: PathOfContact, gear: int, halves: Halves | None = None) -> float:
    """Angle (rad) of the top land of a gear's tooth; negative where its flanks cross. `halves` as in `faults`."""
    return _thickness(path, gear, path.ends(gear)[1], halves)


def _thickness(path: PathOfContact, gear: int, X: float, halves: Halves | None) -> float:
    """Angle (rad) between the flanks of a tooth where they touch at X."""
    reach = path.pitch.reach_of(gear)
    half = (halves[gear - 1] if halves else path.pitch.p / 4) / reach
    points = path.flank(gear, np.array([X]))[0]
    return float(2 * (half - _azimuth(path, gear, points)))


def _azimuth(path: PathOfContact, gear: int, point: Floats) -> float:
    """How far (rad) a body point is from the direction of the pitch point, towards the middle of its flank's tooth."""
    _, forwards = path.pitch.polar(gear, point)
    return float(-forwards if gear == 1 else forwards)  # a driver's tooth is behind its flank


def _broken(path: PathOfContact) -> Iterator[ToothFault]:
    ratio = path.contact_ratio
    # arcs of a pitch in all add up to 1 but for rounding
    if ratio < 1 - 1e-12:
        yield ToothFault(
            "contact ratio",
            0,
            float("nan"),
            f"the contact ratio is {ratio:.6g}",
            "one pair of teeth parts before the next one meets",
            "lengthen approach or recess until they are a pitch together",
        )
