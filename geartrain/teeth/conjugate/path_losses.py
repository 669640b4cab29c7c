"""Costs of a path of contact: loss, maximum stress, heat, flash temperature and depth; their ratios to another path.

A force is known only with an assumption on how pairs of teeth that touch at once share the load. Two are made here:
one pair bears all of it along its whole path, or those in contact bear equal parts at every instant. They are the same
where the contact ratio is 1.

Friction of one contact is exact in its coefficient, for spur and bevel wheels and rings (docs/shapes.md (6)
for spur pairs).
The contact pushes with N along the normal n and rubs with mu N across it, against the sliding, whose sense turns at the
pitch point. Over N and the pitch-line speed, the power that enters at gear i, or leaves there, is the force times the
speed of that gear's body at the contact:

    gear 1: cos psi + s mu (S' sin psi + A S),   gear 2: cos psi + s mu (S' sin psi - B S),

s = sign d where gear 1 drives and -sign d where gear 2 does. The difference is mu (A + B) |S|, friction times sliding.
A contact line of a bevel pair has these ratios at every distance from the apex, so they are exact there as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import floor, inf, nan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.results import Key, Result, finite
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact, PathSide

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

# 12 nodes leave 1e-12 on usual paths and 24 rounding: twice that for steep ones
_GAUSS = np.polynomial.legendre.leggauss(48)
_SCAN = 257  # points of one piece among which an extreme is looked for
_NARROWED, _ACROSS = 5, 33  # times the bracket around it is scanned again, and by how many points
_ROUNDING = 1e-12  # of a pitch: a stretch so short is none

ONE_PAIR = "one pair of teeth bears the whole load along its whole path"
SHARED = "pairs of teeth in contact share the load equally at every instant"

LOADED = ("loss", "stress", "off_pitch", "heat", "flash")
"""Costs that depend on how the load is shared, in the order of tables."""
FREE = ("depth", "contact_ratio", "slowest")
"""Measures that do not."""
_STEP, _STEPS = 1.25, 40  # growth of the bracket, and how often it may grow: by 1.25^40 = 7500


@dataclass(frozen=True, slots=True)
class PathLosses(Result):
    """Costs of a path under one assumption on the load, friction and load taken out; lengths in modules or radians.

    See Also
    --------
    measure : gives it.
    """

    KEYS = ("assumption", *(Key(name, to=finite) for name in LOADED))

    assumption: str
    """How pairs of teeth share the load."""
    loss: float
    """Mean loss over friction, first order. One pair: (A + B) (J_a + J_r) / (X_a + X_r), the mean along its path
    (Buckingham); shared: the mean over a pitch (Ohlendorf)."""
    stress: float
    """Maximum Hertz pressure over sqrt(tangential force): sqrt(max H); infinite where psi is 0."""
    off_pitch: float
    """The same where |X| is more than a tenth of a pitch."""
    heat: float
    """Maximum heat per area of either profile, over friction times tangential force: max Q."""
    flash: float
    """Maximum of what the flash temperature is proportional to."""

    def over(self, other: PathLosses) -> dict[str, float]:
        """Each of the quantities as a ratio to another path's.

        Parameters
        ----------
        other : PathLosses
            Under the same assumption.
        """
        return {name: getattr(self, name) / getattr(other, name) for name in LOADED}


@dataclass(frozen=True, slots=True)
class PathMeasures(Result):
    """Costs of one path, and its geometry; lengths in modules or radians.

    See Also
    --------
    measure : gives it.
    """

    KEYS = ("one_pair", "shared", *(Key(name, to=finite) for name in FREE))

    one_pair: PathLosses
    """Costs where one pair carries the load."""
    shared: PathLosses
    """Costs where the pairs in contact share the load equally."""
    depth: float
    """Working depth |eta_a| + eta_r."""
    slowest: float
    """Minimum speed of the contact along a dedendum, over the pitch-line speed."""
    contact_ratio: float
    """Pitches of displacement while one pair touches."""

    def over(self, other: PathMeasures) -> PathRatios:
        """Each of the quantities as a ratio to another path's.

        Parameters
        ----------
        other : PathMeasures
            Such as those of an involute.
        """
        free = {name: getattr(self, name) / getattr(other, name) for name in FREE}
        return PathRatios(self.one_pair.over(other.one_pair), self.shared.over(other.shared), free)


@dataclass(frozen=True, slots=True)
class PathRatios(Result):
    """Measures of one path over those of another, by their names."""

    KEYS = (Key("one_pair", to=finite), Key("shared", to=finite), Key("", "free", finite))

    one_pair: dict[str, float]
    """Ratios of costs where one pair carries the load."""
    shared: dict[str, float]
    """Ratios of costs where the pairs in contact share the load equally."""
    free: dict[str, float]
    """Of what depends on no load."""


def measure(path: PathOfContact) -> PathMeasures:
    """Loss, stress, heat, flash temperature and depth of a path of contact.

    Parameters
    ----------
    path : PathOfContact
        Of any conjugate form.

    Returns
    -------
    PathMeasures
        Under two assumptions on the load.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> round(measure(Involute(form="involute").path(24, 36)).shared.loss, 4)
    0.155
    """
    alone = [(-path.arcs[0], path.arcs[1], 1)]
    slowest = -maximum(path, lambda c: -np.minimum(c.U1, c.U2))
    if min(path.arcs) >= 0:
        slowest = min(slowest, float(path.at(0.0).sin_psi))
    return PathMeasures(
        one_pair=_costs(path, ONE_PAIR, alone),
        shared=_costs(path, SHARED, sharing(path)),
        depth=depth(path),
        slowest=slowest,
        contact_ratio=path.contact_ratio,
    )


Stretch = tuple[float, float, int]
"""From one X to another, and how many pairs of teeth touch there."""


def sharing(path: PathOfContact) -> list[Stretch]:
    """The path in stretches of X on which as many pairs of teeth are in contact at once."""
    p, (approach, recess) = path.pitch.p, path.arcs
    whole = floor(path.contact_ratio)
    cuts = sorted(
        {-approach, recess}
        | {end for k in range(1, whole + 1) for end in (recess - k * p, -approach + k * p) if -approach < end < recess}
    )
    found = []
    for low, high in pairwise(cuts):
        if high - low > _ROUNDING * p:
            # counted in the middle of a stretch, where no rounding decides
            middle = (low + high) / 2
            found.append((low, high, floor((recess - middle) / p) + floor((approach + middle) / p) + 1))
    return found


def _costs(path: PathOfContact, assumption: str, stretches: list[Stretch]) -> PathLosses:
    """The costs where as many pairs as the stretches say share the load."""
    pitch = path.pitch
    bound = 0.1 * pitch.p

    # H, the square of the pressure, and heat go with the force on a pair; flash with its power of 3/4
    def most(what: Callable[[PathContact], Floats], power: float, beyond: float = 0.0) -> float:
        return max(float(maximum(path, what, beyond, low, high) / count**power) for low, high, count in stretches)

    rubbed = sum(_rubbed(path, low, high) / count for low, high, count in stretches)
    return PathLosses(
        assumption=assumption,
        loss=(pitch.A + pitch.B) * rubbed / sum((high - low) / count for low, high, count in stretches),
        stress=most(lambda c: c.H, 1.0) ** 0.5,
        off_pitch=_root(most(lambda c: c.H, 1.0, bound)),
        heat=most(lambda c: np.maximum(c.Q1, c.Q2), 1.0),
        flash=most(lambda c: c.flash, 0.75),
    )


def _root(value: float) -> float:
    """Square root; 0 where there is nothing to be the greatest of."""
    return float(max(value, 0.0) ** 0.5)


def _rubbed(path: PathOfContact, low: float, high: float) -> float:
    """J of the contacts between two X, both sides."""
    total = 0.0
    for recess in (False, True):
        if span := path.span(recess, low, high):
            total += sliding_integral(path.pitch, path.recess if recess else path.approach, *span)
    return total


def sliding_integral(pitch: PitchSurfaces, side: PathSide, start: float = 0.0, end: float = inf) -> float:
    """J of one side, docs/shapes.md (7): the integral of S / cos^2 psi over d, from `start` to `end`."""
    x, weights = _GAUSS
    total = 0.0
    for piece in side.pieces:
        first, last = max(piece.start, start), min(piece.end, end)
        if last > first:
            d = first + (last - first) * (x + 1) / 2
            total += float(weights @ (pitch.S(d) / (1 - piece.sin_psi(d) ** 2))) * (last - first) / 2
    return total


def depth(path: PathOfContact) -> float:
    """The working depth: height of the last contact over the first, both sides."""
    spans = ((side, path.span(recess)) for recess, side in ((False, path.approach), (True, path.recess)))
    return sum(height(path.pitch, side, *span) for side, span in spans if span)


def height(pitch: PitchSurfaces, side: PathSide, start: float | None = None, end: float | None = None) -> float:
    """Height of the last contact over the first, |eta|; over the pitch line but for paths that keep off it."""
    ends = np.array([side.start if start is None else start, side.end if end is None else end])
    low, high = pitch.S(ends) * side.sin_psi(ends)
    return float(high - low)


def sliding(path: PathOfContact) -> tuple[float, float]:
    """Greatest sliding over the pitch-line speed, and over the slower of the contact's speeds along the flanks."""
    pitch = path.pitch
    slide = maximum(path, lambda c: (pitch.A + pitch.B) * np.abs(pitch.S(c.d)))
    return slide, maximum(path, lambda c: c.Q1.clip(c.Q2) * c.cos_psi)


def maximum(
    path: PathOfContact,
    what: Callable[[PathContact], Floats],
    beyond: float = 0.0,
    low: float = -inf,
    high: float = inf,
) -> float:
    """The greatest value of a quantity where |X| >= `beyond`, X from `low` to `high`; -inf where there is no contact.

    Scanned piece by piece, then narrowed.
    """
    best = -inf
    for recess, side in ((False, path.approach), (True, path.recess)):
        for first, last in _reaches(path, recess, beyond, low, high):
            best = max(best, _peak(lambda d, recess=recess: what(path.along(d, recess)), first, last, side.end))  # type: ignore[misc]
    return best


def _reaches(
    path: PathOfContact, recess: bool, beyond: float, low: float, high: float
) -> Iterator[tuple[float, float]]:
    """The distances of one side between which a greatest value is looked for, piece by piece."""
    if beyond:
        low, high = (max(low, beyond), high) if recess else (low, min(high, -beyond))
    if not (span := path.span(recess, low, high)):
        return
    for piece in (path.recess if recess else path.approach).pieces:
        # at a joint itself a side answers with the next piece
        first, last = max(piece.start, span[0]), min(float(np.nextafter(piece.end, 0.0)), span[1])
        if last > first:
            yield first, last


def _peak(f: Callable[[Floats], Floats], first: float, last: float, scale: float) -> float:
    """Greatest value of f on [first, last]; what is 0/0 at the pitch point itself is asked beside it."""
    d = np.linspace(first, last, _SCAN)
    if first == 0.0:
        # near enough for its limit, where what is 0/0 still has half its digits
        d[0] = min(1e-7 * scale, float(d[1]))
        at_pitch = f(np.zeros(1))[0]
        if np.isposinf(at_pitch):
            return inf
    values = np.where(np.isnan(found := f(d)), -inf, found)
    best = float(values.max())
    for _ in range(_NARROWED):
        at = int(np.argmax(values))
        d = np.linspace(d[max(at - 1, 0)], d[min(at + 1, len(d) - 1)], _ACROSS)
        values = f(d)
        best = max(best, float(values.max()))
    return best


def powers(pitch: PitchSurfaces, contact: PathContact, friction: float, driver: int = 1) -> tuple[Floats, Floats]:
    """Power in and power out of a contact over normal force and pitch-line speed; `driver` 1 or 2."""
    rising, S = pitch.S_slope(contact.d) * contact.sin_psi, pitch.S(contact.d)
    rub = np.sign(contact.d) * (friction if driver == 1 else -friction)
    first = contact.cos_psi + rub * (rising + pitch.A * S)
    second = contact.cos_psi + rub * (rising - pitch.B * S)
    return (first, second) if driver == 1 else (second, first)


def efficiency(pitch: PitchSurfaces, contact: PathContact, friction: float, driver: int = 1) -> Floats:
    """Efficiency of one contact of conjugate teeth, exact in friction.

    Parameters
    ----------
    pitch : PitchSurfaces
        Of the path.
    contact : PathContact
        One contact or many.
    friction : float
        Coefficient of friction, 0 or more.
    driver : {1, 2}
        The gear that drives.

    Returns
    -------
    ndarray
        Power out over power in, of the contact's shape; NaN where the contact locks.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> path = Involute(form="involute").path(24, 36)
    >>> [round(float(value), 4) for value in efficiency(path.pitch, path.at([-1.0, 0.0, 1.0]), 0.1)]
    [0.9857, 1.0, 0.9867]
    """
    into, out = powers(pitch, contact, friction, driver)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(out > 0, out / into, np.nan)


def locking_friction(path: PathOfContact, driver: int = 1) -> float:
    """The least friction at which some contact of the path locks; infinite where none does.

    Contacts lock in the driver's approach only, where the driven side's tooth is rubbed towards the line of centres.
    """
    pitch = path.pitch

    def lean(contact: PathContact) -> Floats:
        # power out is linear in friction: cos psi less friction times this lean
        power = powers(pitch, contact, 1.0, driver)[1] - contact.cos_psi
        found: Floats = -power / contact.cos_psi
        return found

    steepest = maximum(path, lean)
    return 1 / steepest if steepest > 0 else inf


# -------------------------------------------------------------------------------- uniform temperature of a wanted depth


def to_depth(depth: Callable[[float], float], wanted: float, start: float, most: float) -> float:
    """The gamma = (A + B) / heat whose `depth`, which grows with it, is as wanted; looked for around `start`.

    most   a depth that no heat gives, such as the arcs summed: a contact rises by less than it travels

    Raises `GearTrainError` where no heat gives that depth.
    """

    def off(gamma: float) -> float:
        try:
            return depth(gamma) - wanted
        except GearTrainError:
            return nan  # too steep to be reached, or too hot for the contact to move

    low = high = start
    at_low = at_high = off(start) if wanted < most else nan
    for _ in range(_STEPS if wanted < most else 0):
        if at_low < 0 < at_high or at_low == 0:
            break
        # upwards while even the hottest is too low; NaN, which cannot be reached, and too deep both lead downwards
        if not at_high >= 0 and at_high == at_high:
            low, at_low, high = high, at_high, high * _STEP
            at_high = off(high)
        else:
            high, at_high, low = low, at_low, low / _STEP
            at_low = off(low)
    if not (at_low <= 0 <= at_high):
        what = f"no heat gives these teeth a working depth of {wanted:.6g}"
        if at_low > 0:
            raise GearTrainError(
                Problem(what, "even the hottest are deeper", "ask for more depth or shorter arcs, or give the heat")
            )
        raise GearTrainError(
            Problem(
                what,
                "their pressure angle would reach a right angle, or their contact stand still, before",
                "ask for another depth, shorter arcs or more teeth, or give the heat",
            )
        )
    return root(off, low, high, at_low, at_high)
