"""Azimuths of the pitch points of gear pairs on parallel or intersecting axes, with their accuracy."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.quantity import UNITS, Figure, Quantity
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.numerics.vectors import IntegerVector, across_whole, azimuth, cross, dot, frame, minus, parallel, unit
from geartrain.train import Train

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

EPS = 2 * UNIT_ROUNDOFF  # spacing of float64 numbers at 1: bounds the error of an angle in turns


@dataclass(frozen=True)
class UnplacedPair:
    """Gear pair or coupling without an assembly condition, with the reason why its position is unknown."""

    name: str
    """Name of the pair or coupling."""
    why: str
    """Reason why the position of the pair or coupling is unknown."""


@dataclass(frozen=True)
class PitchPoints:
    """Pitch points of gear pairs with known positions; arrays have a row for each pair and a column for each wheel."""

    circuits: tuple[Circuit, ...]
    """Circuits of the pairs. A wheel on the frame is a separate link, because its mounting angle is free."""
    azimuth: Floats
    """Azimuth of the pitch point about the axis of the wheel, counterclockwise about its positive sense [turn]."""
    slack: Floats
    """Maximum error of the azimuth [turn]."""
    family: Sequence[tuple[int, int]]
    """Family number of each contact; the angles between contacts of a family are known fractions of a turn."""
    part: Sequence[tuple[Fraction, Fraction]]
    """Exact angle of each contact from the first contact of its family [turn]."""
    guessed: frozenset[int] = frozenset()
    """Families in which an angle was recognised as a fraction from rounded positions."""
    omitted: tuple[UnplacedPair, ...] = ()
    """Pairs and couplings that are omitted because their positions are unknown."""

    @cached_property
    def teeth(self) -> Floats:
        """Coefficients a and b of the pairs, shape (pairs, 2): tooth counts; b is negative for internal pairs."""
        return np.array([(c.a, c.b) for c in self.circuits], float).reshape(-1, 2)

    @cached_property
    def constant(self) -> Floats:
        """Constant c of equation (1) of docs/closure.md, a theta_i + b theta_j = c (mod 1), in [0, 1) [pitch]."""
        # integer pitches are removed before the sum, to keep digits; 1/2 because a tooth meets a gap
        whole: Floats = np.mod(np.mod(self.teeth * self.azimuth, 1.0).sum(axis=1) + 0.5, 1.0)
        return whole

    @cached_property
    def uncertainty(self) -> Floats:
        """Maximum error of each pair's `constant` [pitch]."""
        # a pitch is 1/z turn, so the error of an azimuth counts z times
        uncertainty: Floats = (np.abs(self.teeth) * (self.slack + 2 * EPS)).sum(axis=1) + 4 * EPS
        return uncertainty

    @cached_property
    def scale(self) -> int:
        """Common denominator of 1/2 and of the exact angles of all contacts."""
        found = {part.denominator for parts in self.part for part in parts}
        # dtype object, because the common denominator may exceed 64 bits
        return int(np.lcm.reduce(np.array([2, *found], dtype=object)))

    @cached_property
    def exact_constant(self) -> list[int]:
        """Constant c of each pair as an integer multiple of 1/`scale` [pitch], if the azimuth of each contact is
        measured from the first contact of its family.
        """
        scale, found = self.scale, []
        for circuit, (p, q) in zip(self.circuits, self.part, strict=True):
            here, there = p.numerator * (scale // p.denominator), q.numerator * (scale // q.denominator)
            found.append((circuit.a * here + circuit.b * there + scale // 2) % scale)
        return found


def contact_families(keys: Sequence[tuple[object, object]]) -> tuple[list[tuple[int, int]], Mapping[object, int]]:
    """Return the number of the family to which each of the two contacts of every pair belongs, and the family numbers
    by key. Contacts with equal keys are in the same family.
    """
    number: dict[object, int] = {}
    for pair in keys:
        for key in pair:
            number.setdefault(key, len(number))
    return [(number[i], number[j]) for i, j in keys], number


MOUNT = "\0"  # separates the frame's name from that of a wheel mounted on it
_NUMBER = re.compile(r"\s*[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?")
_DECIMAL = re.compile(r"[.eE]")
_COMPARED = 8  # families of a wheel with which a new contact is compared
_Z: IntegerVector = (0, 0, 1)


@dataclass(frozen=True, slots=True)
class _Axis:
    """Axis in integer coordinates, with the maximum errors that result from the rounding of its declared numbers."""

    way: IntegerVector
    """Declared direction as an integer vector."""
    unsure: float
    """Maximum error of the declared direction [rad]."""
    sense: IntegerVector
    """Direction about which positive speeds rotate, which is common to all parallel axes."""
    place: IntegerVector | None
    """Point on the axis, in a unit of length that is common to all axes; None if no position is declared."""
    error: Fraction
    """Maximum error of the point `place`, in the unit of length of `place`."""


@collector_paused()
def place_pitch_points(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> PitchPoints:
    """Return the pitch points of all gear pairs, in the pose in which moving axes are declared."""
    axes = _axes(train)
    # an undeclared axis is parallel to z, without a position
    plain = _Axis(_Z, 0.0, _Z, None, Fraction(0))
    placed: list[Circuit] = []
    contacts: list[_Contact] = []
    turns: list[tuple[float, float]] = []
    omitted: list[UnplacedPair] = []
    for circuit in circuits:
        if circuit.kind != "gear":
            omitted.append(UnplacedPair(circuit.id, "it has no teeth in mesh"))
            continue
        first, second = (axes.get(tree.axis_seen_from(circuit.carrier, link), plain) for link in (circuit.i, circuit.j))
        found = _contact(train, circuit, first, second)
        if isinstance(found, str):
            omitted.append(UnplacedPair(circuit.id, found))
            continue
        placed.append(mount_frame_wheels(circuit, train.frame))
        contacts.append(found)
        turns.append((_azimuth(found.ways[0], first.sense), _azimuth(found.ways[1], second.sense)))
    slack = np.array([each.error + each.rounding for each in contacts]).reshape(-1, 1) * np.ones(2)
    family, part, guessed = _families(placed, contacts, turns)
    return PitchPoints(tuple(placed), np.array(turns).reshape(-1, 2), slack, family, part, guessed, tuple(omitted))


def mount_frame_wheels(circuit: Circuit, frame: str) -> Circuit:
    """Return the circuit in which a wheel on the frame is a separate link, because its mounting angle is free."""
    i, j = circuit.i, circuit.j
    if frame not in (i, j):
        return circuit
    first, second = circuit.wheels
    return circuit._replace(
        i=f"{frame}{MOUNT}{first}" if i == frame else i, j=f"{frame}{MOUNT}{second}" if j == frame else j
    )


# ---------------------------------------------------------------------------------------------------------------- axes


def _axes(train: Train) -> dict[str, _Axis]:
    """Return the declared axes in integer coordinates; positions are multiples of one length for the whole train."""
    points = {label: [part.base for part in axis.position] for label, axis in train.axes.items() if axis.position}
    # a common unit of length makes all coordinates integers
    unit = math.lcm(*{part.denominator for point in points.values() for part in point})
    # z first, because undeclared axes are parallel to z and positive about it
    senses: list[IntegerVector] = [_Z]
    known: dict[tuple[str, ...], tuple[IntegerVector, float, IntegerVector]] = {}
    found: dict[str, _Axis] = {}
    for label, axis in train.axes.items():
        # equal texts are parsed once, because large trains repeat directions
        key = tuple(figure.text for figure in axis.direction)
        if key not in known:
            known[key] = _direction(axis.direction, senses)
        way, unsure, sense = known[key]
        place, error = None, Fraction(0)
        if axis.position:
            x, y, z = (part.numerator * (unit // part.denominator) for part in points[label])
            place, error = (x, y, z), unit * Fraction(math.hypot(*map(_half_digit, axis.position)))
        found[label] = _Axis(way, unsure, sense, place, error)
    return found


def _direction(figures: Sequence[Figure], senses: list[IntegerVector]) -> tuple[IntegerVector, float, IntegerVector]:
    """Return a direction as integers, its maximum error [rad], and the first direction in `senses` parallel to it."""
    values = [figure.value for figure in figures]
    scale = math.lcm(*(value.denominator for value in values))
    x, y, z = (int(value * scale) for value in values)
    common = math.gcd(x, y, z)
    way = x // common, y // common, z // common
    rough = math.hypot(*(float(figure.half or 0) for figure in figures))
    sense = next((known for known in senses if parallel(known, way)), None)
    if sense is None:
        senses.append(way)
    return way, rough / math.hypot(*(float(figure.value) for figure in figures)), sense or way


def _half_digit(length: Quantity) -> float:
    """Return half a unit of the last declared decimal of a length [m]; 0 for integers and fractions (exact)."""
    number = _NUMBER.match(length.text)
    if number is None or not _DECIMAL.search(number[0]) or "/" in length.text or ":" in length.text:
        return 0.0
    scale = UNITS[length.unit][1] if length.unit in UNITS else Fraction(1)
    return float((Figure.parse(number[0].strip()).half or 0) * scale)


# ------------------------------------------------------------------------------------------------------------ contacts


class _Contact(NamedTuple):
    """Pitch point of a gear pair as seen from the axes of its two wheels."""

    ways: tuple[IntegerVector, IntegerVector]
    """Vectors from the two axes to the pitch point, each perpendicular to its axis."""
    error: float
    """Maximum error of the azimuths that is due to the rounding of declared numbers [turn]."""
    rounding: float
    """Maximum error of the azimuths that is due to rounding in their computation [turn]."""


def _contact(train: Train, circuit: Circuit, first: _Axis, second: _Axis) -> _Contact | str:
    """Return the contact of a gear pair, or the reason why it is unknown."""
    wheels = [train.wheels[name][1] for name in circuit.wheels]
    kinds = {wheel.kind for wheel in wheels}
    if "worm" in kinds:
        return "the phase of a worm is set by shifting it along its axis"
    if not parallel(first.way, second.way) and any(wheel.is_helical for wheel in wheels):
        return "the phase of helical wheels on skew axes is set by shifting one along its axis"
    if parallel(first.way, second.way):
        if kinds != {"spur"}:
            return "a bevel pair on parallel axes has no pitch point"
        return _parallel_contact(first, second, [wheel.internal for wheel in wheels])
    return _intersecting_contact(first, second, [wheel.facing for wheel in wheels])


def _parallel_contact(first: _Axis, second: _Axis, internal: Sequence[bool]) -> _Contact | str:
    """Return the contact of two wheels on parallel axes, or the reason why it is unknown. The pitch point is on the
    side of the other axis, or on the opposite side for the mate of a ring.
    """
    if first.place is None or second.place is None:
        return "the positions of its axes are not declared"
    way = across_whole(minus(second.place, first.place), first.sense)
    if not any(way):
        return "its axes coincide"
    # across_whole scales by the square of the length of `sense`
    length = _norm(way) / dot(first.sense, first.sense)  # exact, because positions may have hundreds of digits
    rounded = _turns(float((first.error + second.error) / length))
    back = minus((0, 0, 0), way)
    # four roundings in the arctangent of exact integers
    return _Contact((back if internal[1] else way, way if internal[0] else back), rounded, 4 * EPS)


def _intersecting_contact(first: _Axis, second: _Axis, facing: Sequence[int]) -> _Contact | str:
    """Return the contact of two wheels on intersecting axes, or the reason why it is unknown. The pitch point of a
    wheel is on the side towards which the pitch cone of its mate opens.
    """
    if first.place is not None and second.place is not None:
        apart = dot(minus(second.place, first.place), cross(first.way, second.way))
        reach = _norm(minus(second.place, first.place))
        slack = first.error + second.error + reach * Fraction(first.unsure + second.unsure)
        if abs(apart) > slack * _norm(first.way) * _norm(second.way):
            return "its axes do not intersect"
    n, m = ((f * a.way[0], f * a.way[1], f * a.way[2]) for a, f in ((first, facing[0]), (second, facing[1])))
    sine = float(_norm(cross(n, m)) / (_norm(n) * _norm(m)))
    # an error of one direction turns the common plane of both axes by at most error/sine
    rounded = _turns((first.unsure + second.unsure) / sine)
    # the rounding error of a direction normal to an axis grows as the angle between the axes decreases
    return _Contact((across_whole(m, first.way), across_whole(n, second.way)), rounded, 16 * EPS / sine)


def _norm(vector: IntegerVector) -> Fraction:
    """Return the length of an integer vector as a Fraction accurate to 64 bits."""
    # the root of an integer shifted by 128 bits has 64 bits after the binary point
    return Fraction(math.isqrt(dot(vector, vector) << 128), 1 << 64)


def _turns(sine: float) -> float:
    # rounding as large as the distance: the direction is unknown
    return math.asin(sine) / math.tau if sine < 1 else 0.5


def _azimuth(way: IntegerVector, sense: IntegerVector) -> float:
    """Return the azimuth of a vector about an axis [turn], counterclockwise from the first vector of `frame`."""
    axis = unit(_floats(sense))
    turn = azimuth(_floats(way), axis, frame(axis)[0]) / math.tau % 1.0
    return 0.0 if turn == 1.0 else turn  # a tiny negative angle is rounded up


def _floats(vector: IntegerVector) -> tuple[float, float, float]:
    """Return a vector as floats. It is scaled if its components have hundreds of digits."""
    x, y, z = vector
    top = max(abs(x), abs(y), abs(z))
    if top.bit_length() < 300:  # squares and products are within float64
        return float(x), float(y), float(z)
    return float(Fraction(x, top)), float(Fraction(y, top)), float(Fraction(z, top))


# ------------------------------------------------------------------------------------------------------------ families


def _families(
    circuits: Sequence[Circuit], contacts: Sequence[_Contact], turns: Sequence[tuple[float, float]]
) -> tuple[list[tuple[int, int]], list[tuple[Fraction, Fraction]], frozenset[int]]:
    """Return, for all pairs, the family numbers of the two contacts and the angles of the contacts from the first
    contact of their family [turn]. Also return the families in which an angle was recognised as a fraction from rounded
    positions.
    """
    heads: dict[tuple[str, str], list[tuple[int, IntegerVector, float, int]]] = {}
    guessed: set[int] = set()
    count = 0
    found: list[list[tuple[int, Fraction]]] = []
    for at, circuit in enumerate(circuits):
        found.append([])
        for link, way, turn in zip((circuit.i, circuit.j), contacts[at].ways, turns[at], strict=True):
            known = heads.setdefault((link, circuit.carrier), [])
            # few are compared, which keeps the cost linear for a hub with thousands of mates
            for number, head, zero, other in known[-_COMPARED:]:
                part = rational_angle(head, way, (turn - zero) % 1)
                if part is None and contacts[at].error + contacts[other].error:
                    slack = sum(each.error + each.rounding for each in (contacts[at], contacts[other]))
                    part = recognised_angle((turn - zero) % 1, slack)
                    guessed.update([number] if part is not None else [])
                if part is not None:
                    found[-1].append((number, part))
                    break
            else:
                known.append((count, way, turn, at))
                found[-1].append((count, Fraction(0)))
                count += 1
    family = [(i, j) for (i, _), (j, _) in found]
    return family, [(p, q) for (_, p), (_, q) in found], frozenset(guessed)


_PROBABILITY = 1e-3  # maximum probability that a random angle is taken for a fraction
_DENSITY = 3 / math.pi**2  # about this times q squared reduced fractions below 1 have a denominator up to q


def rational_angle(u: IntegerVector, v: IntegerVector, turn: float) -> Fraction | None:
    """Return the angle from the integer vector u to v [turn] if it is a rational fraction of a turn; None if it is
    irrational.

    The square of the cosine, (u.v)^2 / (u.u v.v), is rational. If the angle is a rational fraction of a turn, Niven's
    theorem requires this square to be 0, 1/4, 1/2, 3/4 or 1. The angle is therefore a multiple of 1/24 turn or
    irrational. `turn` is a floating-point approximation of the angle [turn], with an error below 1/48.
    """
    along = dot(u, v)
    square = dot(u, u) * dot(v, v)
    if 4 * along * along % square:  # the square of the cosine is not a multiple of 1/4
        return None
    return Fraction(round(24 * turn) % 24, 24)


def recognised_angle(turn: float, slack: float) -> Fraction | None:
    """Return the fraction of a turn within `slack` of an angle [turn]; None if such a fraction could be a coincidence.

    Fractions with denominators up to q match a random angle with the probability 0.6 q^2 slack, which limits q. At most
    one such fraction exists, and by Legendre's theorem it is a convergent of the continued fraction of the angle.

    >>> recognised_angle(0.3333, 1e-4), recognised_angle(0.3679, 1e-4)
    (Fraction(1, 3), None)
    """
    most = math.sqrt(_PROBABILITY / (2 * _DENSITY * slack))
    before, last = (0, 1), (1, 0)
    rest = turn
    while True:
        whole = math.floor(rest)
        before, last = last, (whole * last[0] + before[0], whole * last[1] + before[1])
        if last[1] > most:
            return None
        if abs(turn - last[0] / last[1]) <= slack:
            return Fraction(last[0] % last[1], last[1])
        # the remainder is not 0 here: the convergent would be the angle to rounding, and the loop has ended above
        rest = 1 / (rest - whole)


def centred_residue(value: Fraction) -> Fraction:
    """Return a number reduced modulo 1 to the interval (-1/2, 1/2]."""
    return value - math.ceil(value - Fraction(1, 2))
