"""Losses and loads of a path of contact: friction loss, maximum stress, heat, flash temperature and working depth.

The tooth force is known only with an assumption on how tooth pairs in contact at the same time share the load. Two
assumptions are used here: one pair bears the whole load along its whole path, or the pairs in contact bear equal parts
at every instant. Both assumptions give the same results if the contact ratio is 1.

The efficiency of one contact is an exact function of the friction coefficient, for spur and bevel wheels and ring gears
(docs/shapes.md (6) for spur pairs). The contact pushes with N along the normal n and rubs with mu N across it, against
the sliding, whose sense reverses at the pitch point. The power that enters at gear i, or leaves there, divided by N and
by the pitch-line speed, is, at the distance d from the pitch point and the pressure angle psi,

    gear 1: cos psi + s mu (S' sin psi + A S),   gear 2: cos psi + s mu (S' sin psi - B S),

with s = sign d if gear 1 drives and -sign d if gear 2 drives. S is d, or sin d on the sphere, S' is its derivative, and
A and B are the curvatures of the pitch surfaces. The difference is mu (A + B) |S|, friction times sliding. A contact
line of a bevel pair has these ratios at every distance from the apex, so they are exact there also.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain, pairwise
from math import floor, inf, nan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.results import Key, Result, finite
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

# 12 nodes give 1e-12 and 24 give rounding on usual paths; twice as many for steep ones
_GAUSS = np.polynomial.legendre.leggauss(48)
_SCAN = 257  # grid points of one piece in the search for a maximum
_NARROWED, _ACROSS = 5, 33  # number of refinements of its bracket, and grid points of each
_ROUNDING = 1e-12  # fraction of a pitch: shorter intervals are rounding error
_NEARLY_0 = 1e-14  # fraction of a pitch: rounding error of an arc

ONE_PAIR = "one pair of teeth bears the whole load along its whole path"
SHARED = "pairs of teeth in contact share the load equally at every instant"

LOADED = ("loss", "stress", "off_pitch", "heat", "flash")
"""Names of the results that depend on how tooth pairs share the load, in the order of the table columns."""
FREE = ("depth", "contact_ratio", "slowest")
"""Names of the results that do not depend on how tooth pairs share the load."""
_STEP, _STEPS = 1.25, 40  # growth factor of the bracket, and maximum number of growths: 1.25^40 = 7500


@dataclass(frozen=True, slots=True)
class PathLosses(Result):
    """Loss, stress, heat and flash temperature along a path of contact, for one assumption on how tooth pairs share the
    load.

    All quantities are normalised by friction and load. Lengths are in modules, or in radians for bevel gears.

    See Also
    --------
    measure : Function that computes these quantities.
    """

    KEYS = ("assumption", *(Key(name, to=finite) for name in LOADED))

    assumption: str
    """Description of the assumption on how tooth pairs share the load."""
    loss: float
    """Mean power loss divided by the input power and by the friction coefficient, to first order.

    If one tooth pair carries the load, this is the mean along its path, (A + B) (J_a + J_r) / (X_a + X_r)
    (Buckingham), with the curvatures A and B of the pitch surfaces, and sliding integrals J and arcs X of approach
    and recess. If tooth pairs share the load, it is the mean over a pitch (Ohlendorf).
    """
    stress: float
    """Maximum Hertzian pressure divided by the square root of the tangential force, apart from a material constant: the
    square root of the maximum of `PathContact.H`. It is infinite if the pressure angle is 0 at a contact.
    """
    off_pitch: float
    """Maximum of the quantity described in `stress` over contacts at least a tenth of a pitch away from the pitch
    point; 0 if there are no such contacts.
    """
    heat: float
    """Maximum frictional heat per unit area of a profile, divided by friction coefficient and tangential force."""
    flash: float
    """Maximum of F_n^(3/4) kr^(1/4) |sqrt U1 - sqrt U2| along the path of contact. Blok's flash temperature is
    proportional to this quantity. F_n is the normal force, kr is the relative curvature, and U1 and U2 are the contact
    speeds along the profiles.
    """

    def over(self, other: PathLosses) -> dict[str, float]:
        """Return the ratio of each quantity to the same quantity of another path of contact.

        Parameters
        ----------
        other : PathLosses
            Losses of the other path, for the same assumption on how tooth pairs share the load.
        """
        return {name: getattr(self, name) / getattr(other, name) for name in LOADED}


@dataclass(frozen=True, slots=True)
class PathMeasures(Result):
    """Losses, loads and geometry of one path of contact. Lengths are in modules, or in radians for bevel gears."""

    KEYS = ("one_pair", "shared", *(Key(name, to=finite) for name in FREE))

    one_pair: PathLosses
    """Losses and loads if one tooth pair carries the whole load."""
    shared: PathLosses
    """Losses and loads if the tooth pairs in contact share the load in equal parts."""
    depth: float
    """Working depth |eta_a| + eta_r, where eta_a and eta_r are the heights of the first and the last contact above the
    pitch line [module; rad for bevel gears].
    """
    slowest: float
    """Minimum speed of the contact point along a dedendum, divided by the pitch-line speed."""
    contact_ratio: float
    """Contact ratio: arc of contact divided by pitch."""

    def over(self, other: PathMeasures) -> PathRatios:
        """Return the ratio of each quantity to the same quantity of another path of contact.

        other   results of the reference path, for example of the path of an involute
        """
        free = {name: getattr(self, name) / getattr(other, name) for name in FREE}
        return PathRatios(self.one_pair.over(other.one_pair), self.shared.over(other.shared), free)


@dataclass(frozen=True, slots=True)
class PathRatios(Result):
    """Ratios of the results of one path of contact to the results of a reference path, keyed by name of the result."""

    KEYS = (Key("one_pair", to=finite), Key("shared", to=finite), Key("", "free", finite))

    one_pair: dict[str, float]
    """Ratios of losses and loads for the case that one tooth pair carries the whole load."""
    shared: dict[str, float]
    """Ratios of losses and loads for the case that the tooth pairs in contact share the load equally."""
    free: dict[str, float]
    """Ratios of the results that do not depend on how tooth pairs share the load."""


def measure(path: PathOfContact) -> PathMeasures:
    """Return loss, stress, heat, flash temperature and working depth of a path of contact, for two assumptions: one
    tooth pair carries the whole load, or the pairs in contact share it equally.

    Parameters
    ----------
    path : PathOfContact
        Path of contact of any conjugate form.

    Returns
    -------
    PathMeasures
        Results for both assumptions on load sharing.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> round(measure(Involute(form="involute").path(24, 36)).shared.loss, 4)
    0.155
    """
    single = [(-path.arcs[0], path.arcs[1], 1)]
    slowest = -maximum(path, lambda c: -np.minimum(c.U1, c.U2))
    if min(path.arcs) >= 0:
        # the search excludes the pitch point itself, where both contact speeds are sin psi
        slowest = min(slowest, float(path.at(0.0).sin_psi))
    return PathMeasures(
        one_pair=_losses_of(path, ONE_PAIR, single),
        shared=_losses_of(path, SHARED, sharing(path)),
        depth=depth(path),
        slowest=slowest,
        contact_ratio=path.contact_ratio,
    )


Stretch = tuple[float, float, int]
"""Interval of the arc X: first value, last value, and number of tooth pairs in contact within the interval."""


def sharing(path: PathOfContact) -> list[Stretch]:
    """Return the intervals of rotation, as arcs on the pitch surfaces, with a constant number of tooth pairs."""
    p, (approach, recess) = path.pitch.p, path.arcs
    whole = floor(path.contact_ratio)
    cuts = sorted(
        {-approach, recess}
        | {end for k in range(1, whole + 1) for end in (recess - k * p, -approach + k * p) if -approach < end < recess}
    )
    found = []
    for low, high in pairwise(cuts):
        if high - low > _ROUNDING * p:
            # counted in the middle of an interval, where rounding has no influence
            middle = (low + high) / 2
            found.append((low, high, floor((recess - middle) / p) + floor((approach + middle) / p) + 1))
    return found


def _losses_of(path: PathOfContact, assumption: str, stretches: list[Stretch]) -> PathLosses:
    """Return loss, stress, heat and flash temperature if tooth pairs share the load equally in each of the intervals
    `stretches`. `assumption` is the name of this assumption in the result.
    """
    pitch = path.pitch
    # the pressure is unbounded at the pitch point of some forms, so it is also computed beyond a tenth of a pitch; less
    # rounding, so that a change of the number of tooth pairs exactly there counts for every form
    bound = (0.1 - _NEARLY_0) * pitch.p

    # H (pressure squared) and heat are proportional to the force on a pair, flash to its power 3/4
    def most(what: Callable[[PathContact], Floats], power: float, beyond: float = 0.0) -> float:
        return max(float(maximum(path, what, beyond, low, high) / count**power) for low, high, count in stretches)

    total = sum(_sliding_between(path, low, high) / count for low, high, count in stretches)
    return PathLosses(
        assumption=assumption,
        loss=(pitch.A + pitch.B) * total / sum((high - low) / count for low, high, count in stretches),
        stress=most(lambda c: c.H, 1.0) ** 0.5,
        # a maximum over no contact is -inf
        off_pitch=max(most(lambda c: c.H, 1.0, bound), 0.0) ** 0.5,
        heat=most(lambda c: np.maximum(c.Q1, c.Q2), 1.0),
        flash=most(lambda c: c.flash, 0.75),
    )


def _sliding_between(path: PathOfContact, low: float, high: float) -> float:
    """Return the sliding integral J of docs/shapes.md (7) between two arcs X on the pitch surfaces: the integral of S /
    cos^2 psi over the distance d, with the pressure angle psi. S is d, or sin d for bevel gears.
    """
    x, weights = _GAUSS
    total = 0.0
    for _, piece, first, last in path.legs(low, high):
        d = first + (last - first) * (x + 1) / 2
        total += float(weights @ (path.pitch.S(d) / (1 - piece.sin_psi(d) ** 2))) * (last - first) / 2
    return total


def depth(path: PathOfContact) -> float:
    """Return the working depth [module; rad for bevel gears]: the difference in height, perpendicular to the pitch
    line, between the first and the last contact.
    """
    total = 0.0
    for _, piece, first, last in path.legs():
        ends = np.array([first, last])
        total += float(np.diff(path.pitch.S(ends) * piece.sin_psi(ends))[0])
    return total


def sliding(path: PathOfContact) -> tuple[float, float]:
    """Return two maxima over the path of contact: of the sliding speed divided by the pitch-line speed, and of the
    sliding speed divided by the lower of the two contact speeds along the flanks.
    """
    pitch = path.pitch
    slide = maximum(path, lambda c: (pitch.A + pitch.B) * np.abs(pitch.S(c.d)))
    # Q cos psi is sliding speed divided by contact speed; the larger Q belongs to the slower contact
    return slide, maximum(path, lambda c: c.Q1.clip(c.Q2) * c.cos_psi)


def maximum(
    path: PathOfContact,
    what: Callable[[PathContact], Floats],
    beyond: float = 0.0,
    low: float = -inf,
    high: float = inf,
) -> float:
    """Return the maximum of the contact quantity `what` over contacts whose arc X on the pitch surfaces is from `low`
    to `high`, with |X| at least `beyond`; -inf if there are no such contacts.

    Each piece of the path is scanned on a grid, and the bracket of its maximum is then refined.
    """
    bounds = ((low, min(high, -beyond)), (max(low, beyond), high)) if beyond else ((low, high),)
    best = -inf
    for recess, piece, first, last in chain.from_iterable(path.legs(*each) for each in bounds):
        # at a joint itself the methods of a side evaluate the next piece
        last = min(last, float(np.nextafter(piece.end, 0.0)))
        best = max(best, peak(lambda d, recess=recess: what(path.along(d, recess)), first, last))  # type: ignore[misc]
    return best


def peak(f: Callable[[Floats], Floats], first: float, last: float) -> float:
    """Return the maximum of f on [first, last] by repeated grid refinement.

    At 0, the pitch point of a path of contact, f may be 0/0, so it is evaluated at a small distance from 0.
    """
    d = np.linspace(first, last, _SCAN)
    if first == 0.0:
        # close enough for the limit, far enough that a quotient 0/0 keeps half its digits
        d[0] = min(1e-7 * last, float(d[1]))
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
    """Return the input and the output power of a contact, divided by normal force and pitch-line speed, if gear number
    `driver` drives.
    """
    rising, S = pitch.S_slope(contact.d) * contact.sin_psi, pitch.S(contact.d)
    rub = np.sign(contact.d) * (friction if driver == 1 else -friction)
    first = contact.cos_psi + rub * (rising + pitch.A * S)
    second = contact.cos_psi + rub * (rising - pitch.B * S)
    return (first, second) if driver == 1 else (second, first)


def efficiency(pitch: PitchSurfaces, contact: PathContact, friction: float, driver: int = 1) -> Floats:
    """Return the efficiency of conjugate teeth at given contacts, as an exact function of the friction coefficient.

    Parameters
    ----------
    pitch : PitchSurfaces
        Pitch surfaces of the path.
    contact : PathContact
        Contacts on the path.
    friction : float
        Coefficient of friction, 0 or more.
    driver : {1, 2}
        Number of the driving gear.

    Returns
    -------
    ndarray
        Output power divided by input power, of the shape of `contact`; NaN where friction locks the contact.

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
    """Return the minimum friction coefficient at which a contact of the path locks; infinite if no contact can lock.

    Contacts lock in the driver's approach only, where friction pushes the driven tooth towards the line of centres.
    """
    pitch = path.pitch

    def lean(contact: PathContact) -> Floats:
        # power out is linear in friction: cos psi minus friction times this slope times cos psi
        power = powers(pitch, contact, 1.0, driver)[1] - contact.cos_psi
        found: Floats = -power / contact.cos_psi
        return found

    steepest = maximum(path, lean)
    return 1 / steepest if steepest > 0 else inf


# ------------------------------------------------------------------------- uniform temperature of a given working depth


def to_depth(depth: Callable[[float], float], wanted: float, start: float, most: float) -> float:
    """Return the parameter gamma of `uniform_heat` for which the function `depth` returns the depth `wanted`. The depth
    increases with gamma.

    start   initial guess of gamma, around which the root is bracketed
    most    upper bound of the depth, such as the sum of the arcs of contact

    Raises `GearTrainError` if no gamma gives the wanted depth.
    """

    def off(gamma: float) -> float:
        try:
            return depth(gamma) - wanted
        except GearTrainError:
            return nan  # the depth cannot be reached, or the contact speed would be 0

    low = high = start
    at_low = at_high = off(start) if wanted < most else nan
    for _ in range(_STEPS if wanted < most else 0):
        if at_low < 0 < at_high or at_low == 0:
            break
        # increase gamma while the depth is too small; decrease it if it is too large or NaN (not reachable)
        if not at_high >= 0 and at_high == at_high:
            low, at_low, high = high, at_high, high * _STEP
            at_high = off(high)
        else:
            high, at_high, low = low, at_low, low / _STEP
            at_low = off(low)
    if not (at_low <= 0 <= at_high):
        why = "before that depth, the pressure angle would reach 90 deg or the contact speed would be 0"
        fix = "use another depth, shorter arcs or more teeth, or give `heat`"
        if at_low > 0:
            why = "even the maximum `heat` gives deeper teeth"
            fix = "use more depth or shorter arcs, or give `heat`"
        what = f"no value of `heat` gives these teeth a working depth of {wanted:.6g}"
        raise GearTrainError(Problem(what, why, fix))
    return root(off, low, high, at_low, at_high)
