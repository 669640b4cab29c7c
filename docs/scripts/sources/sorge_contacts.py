"""Contacts of the six pairs of Sorge's figures, and his equations as printed beside what they should equal.

Angles, speed ratio and efficiency are the library's. Places, normals, velocities and arms are made here from the two
angles alone, by plane vectors: O1 is the origin, O2 at (D, 0), and y > 0 is the entry side.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from geartrain.teeth import Triangular
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

FRICTION = 0.2
PHI = np.arctan(FRICTION)
SAMPLES = 400
FIGURES = {
    **{"3a": (48, 96, "1.01"), "3b": (48, 96, "1.025")},
    **{"4a": (96, 72, "1.01"), "4b": (96, 72, "1.025")},
    **{"5a": (96, 96, "1.01"), "5b": (96, 96, "1.025")},
}
Values = Any  # arrays of float64
Formula = Callable[["Contact"], Values]


@dataclass(frozen=True)
class Contact:
    """Sizes of a pair, and its contacts of one phase: alpha_1, alpha_2, speed ratio and efficiency."""

    z1: int
    z2: int
    R1: float
    R2: float
    D: float
    beta: float
    phase: str
    x: Values
    y: Values
    tau: Values
    eta: Values

    @cached_property
    def lean(self) -> Values:
        """Direction of the flank in contact: the driver's in approach, the driven wheel's in recess."""
        return self.x + self.beta if self.phase == "approach" else self.beta - self.y

    @cached_property
    def apices(self) -> tuple[Values, Values]:
        """V1 and V2."""
        one = np.array([self.R1 * np.cos(self.x), self.R1 * np.sin(self.x)])
        return one, np.array([self.D - self.R2 * np.cos(self.y), self.R2 * np.sin(self.y)])

    @property
    def point(self) -> Values:
        """Where the teeth touch: the driven apex in approach, the driver's in recess."""
        return self.apices[1] if self.phase == "approach" else self.apices[0]

    @property
    def along(self) -> Values:
        """Unit vector of the flank in contact, towards its apex in approach."""
        return np.array([np.cos(self.lean), np.sin(self.lean)])

    @property
    def normal(self) -> Values:
        """Unit vector in which the driven wheel is pushed."""
        return np.array([np.sin(self.lean), -np.cos(self.lean)])

    @property
    def apart(self) -> Values:
        """v, the distance of the apices."""
        return np.hypot(*(self.apices[0] - self.apices[1]))

    @property
    def centre(self) -> Values:
        """O1C, where the normal meets the line of centres."""
        return self.point[0] + self.point[1] * np.tan(self.lean)

    @property
    def velocities(self) -> tuple[Values, Values]:
        """Of both wheels at the contact, the driver turning at 1."""
        (a, b), c = self.point, self.point[0] - self.D
        return np.array([b, -a]), self.tau * np.array([-b, c])

    @property
    def normal_speeds(self) -> tuple[Values, Values]:
        """Parts of the velocities along the normal."""
        one, two = self.velocities
        return (one * self.normal).sum(axis=0), (two * self.normal).sum(axis=0)

    @property
    def force(self) -> Values:
        """Direction of the force on the driven wheel: the push, and friction against the sliding."""
        one, two = self.velocities
        slides = ((two - one) * self.along).sum(axis=0)
        force = self.normal - FRICTION * np.sign(slides) * self.along
        return force / np.hypot(*force)

    @property
    def arms(self) -> tuple[Values, Values]:
        """b1 and b2: distances of both centres from the force."""
        (a, b), (p, q) = self.point, self.force
        return b * p - a * q, (a - self.D) * q - b * p


def transmission(z1: int, z2: int, clearance: float | str) -> TriangularTransmission:
    """A pair of the note: equilateral teeth of equal depth, friction 0.2."""
    form = Triangular.model_validate({"form": "triangular", "half_angle": "30 deg", "clearance_factor": str(clearance)})
    return form.transmission(z1, z2, FRICTION)


@lru_cache(maxsize=1)
def figures() -> dict[str, TriangularTransmission]:
    """The pairs of Figs. 3 to 5."""
    return {name: transmission(*given) for name, given in FIGURES.items()}


def seen(pair: TriangularTransmission, phase: str) -> Contact:
    """The contacts of one phase on the real path, from the law: its angle, its speed and its efficiency."""
    sizes = pair.sizes
    S = (np.arange(SAMPLES) + 0.5) / SAMPLES * pair.period
    x = pair.alpha1(S)
    tooth_pair = np.round((x + S) / sizes.p1)  # teeth are numbered from the driver's at S = 0
    chosen = (x > sizes.matching) == (phase == "approach")
    y = tooth_pair * sizes.p2 - pair.angle(S)
    return Contact(
        sizes.z1,
        sizes.z2,
        sizes.R1,
        sizes.R2,
        sizes.D,
        sizes.beta1,
        phase,
        *(each[chosen] for each in (x, y, pair.speed(S), pair.efficiency(S))),
    )


@lru_cache(maxsize=2)
def contacts(phase: str) -> tuple[Contact, ...]:
    """The contacts of one phase in all figures that have some."""
    found = (seen(pair, phase) for pair in figures().values())
    return tuple(each for each in found if each.x.size)


def off(phase: str, one: Formula, other: Formula) -> float:
    """The greatest difference of two formulas over all contacts of a phase, in parts of the greatest value."""
    return max(_off(one(each), other(each)) for each in contacts(phase))


def _off(one: Values, other: Values) -> float:
    return float(np.abs(one - other).max() / max(np.abs(other).max(), 1e-300))


# ---------------------------------------------------------------------------------------------- equations as printed


def inner(c: Contact) -> Values:
    """D sin(alpha_1 + beta) - R1 sin(beta), which stands in Eqs. (7) to (12)."""
    return c.D * np.sin(c.x + c.beta) - c.R1 * np.sin(c.beta)


def root(c: Contact) -> Values:
    """The square root of Eqs. (9) to (12)."""
    return np.sqrt(c.R2**2 - inner(c) ** 2)


def eq_9(c: Contact) -> Values:
    """v in approach."""
    return c.R1 * np.cos(c.beta) - c.D * np.cos(c.x + c.beta) + root(c)


def square(c: Contact) -> Values:
    """The square of O2V1."""
    return c.D**2 + c.R1**2 - 2 * c.D * c.R1 * np.cos(c.x)


def eq_12(c: Contact) -> Values:
    """tau in approach."""
    return c.D * np.cos(c.x + c.beta) / root(c) - 1


def eq_16(c: Contact, sign: float) -> Values:
    """v in recess, with either sign of the root."""
    return c.R2 * np.cos(c.beta) + sign * np.sqrt(square(c) - (c.R2 * np.sin(c.beta)) ** 2)


def quotient_17(c: Contact, v: Values) -> Values:
    """alpha_2 in recess by the quotient of tangents."""
    a = c.R1 * np.sin(c.x) / (c.D - c.R1 * np.cos(c.x))
    b = v * np.sin(c.beta) / (c.R2 - v * np.cos(c.beta))
    return np.arctan((a - b) / (1 + a * b))


def difference_17(c: Contact, v: Values) -> Values:
    """The same by two angles, each in its quadrant."""
    seen_from_2 = np.arctan2(c.R1 * np.sin(c.x), c.D - c.R1 * np.cos(c.x))
    return seen_from_2 - np.arctan2(v * np.sin(c.beta), c.R2 - v * np.cos(c.beta))


def turned(c: Contact) -> Values:
    """cos(beta - alpha_1 - alpha_2), which stands in Eqs. (18) to (33)."""
    return np.cos(c.beta - c.x - c.y)


def eq_19(c: Contact) -> Values:
    """tau in recess."""
    return c.R1 * turned(c) / (c.D * np.cos(c.lean) - c.R1 * turned(c))


def products(c: Contact) -> tuple[Values, Values]:
    """The products of cosines and of sines in Eqs. (28) to (33)."""
    apex = c.y if c.phase == "approach" else c.x
    phi = PHI * np.sign(apex)
    lean = c.lean + (c.x if c.phase == "approach" else -c.y) * 0
    first = np.cos(c.beta + c.x + c.y) if c.phase == "approach" else turned(c)
    return first * np.cos(lean + phi), np.sin(apex) * np.sin(phi)


def arms(c: Contact, corrected: bool = True) -> tuple[Values, Values]:
    """b1 and b2 by Eqs. (28) to (31); (31) also as printed."""
    cc, ss = products(c)
    if c.phase == "approach":
        return (c.R2 * (c.tau * cc + ss) / np.cos(c.lean), c.R2 * (cc - ss) / np.cos(c.lean))
    second = cc / c.tau - ss if corrected else (cc - ss) / c.tau
    return c.R1 * (cc + ss) / np.cos(c.lean), c.R1 * second / np.cos(c.lean)


def eq_32(c: Contact) -> Values:
    """Efficiency in approach."""
    cc, ss = products(c)
    return (cc - ss) / (cc + ss / c.tau)


def eq_33(c: Contact, sign: float) -> Values:
    """Efficiency in recess; sign +1 as printed."""
    cc, ss = products(c)
    return (cc + sign * c.tau * ss) / (cc - sign * ss)


# --------------------------------------------------------------------------------------------------------- collisions


@dataclass(frozen=True)
class End:
    """An end of an interval of the real path: alpha_1, alpha_2 and the pair."""

    pair: TriangularTransmission
    phase: str
    x: float

    @property
    def y(self) -> float:
        """alpha_2: Eq. (7), or (17) with two angles."""
        c = self.contact
        v = eq_16(c, -1.0)
        found = np.arcsin(inner(c) / c.R2) - c.x - c.beta if self.phase == "approach" else difference_17(c, v)
        return float(found)

    @property
    def contact(self) -> Contact:
        """The sizes with this alpha_1."""
        s = self.pair.sizes
        x = np.float64(self.x)
        return Contact(s.z1, s.z2, s.R1, s.R2, s.D, s.beta1, self.phase, x, None, None, None)

    @property
    def share(self) -> float:
        """The fraction of Eqs. (22), (26) and (27): tau, of Eq. (12) in approach and (19) in recess."""
        s, c = self.pair.sizes, self.contact
        if self.phase == "approach":
            return float(eq_12(c))
        over = s.R1 * np.cos(s.beta1 - self.x - self.y)
        return float(over / (s.D * np.cos(s.beta1 - self.y) - over))


def ends(name: str) -> Iterator[tuple[End, End]]:
    """Begin and end of the intervals of a figure."""
    pair = figures()[name]
    for each in pair.intervals:
        yield End(pair, each.phase, each.start), End(pair, each.phase, each.end)


def jump(name: str, kind: str) -> float:
    """A jump of a figure, from the law."""
    return float(next(each.value for each in figures()[name].jumps if each.kind == kind))


def eq_25(corrected: bool) -> float:
    """The jump of Fig. 3a; as printed alpha_2 without an index is read as that of the entry."""
    ((first, last),) = ends("3a")
    s = first.pair.sizes

    def side(at: End, other: float) -> float:
        return float(s.D * np.cos(s.beta1 - at.y) / np.cos(s.beta1 - at.x - other) - s.R1)

    return 1 - side(first, first.y) / side(last, last.y if corrected else first.y)


def eq_26(corrected: bool) -> float:
    """The jump into approach of Fig. 5a, from the end of recess."""
    found = {at.phase: (at, last) for at, last in ends("5a")}
    last, first = found["recess"][1], found["approach"][0]
    return 1 - last.share / first.share if corrected else 1 - last.share / (first.share + 1) - 1


def eq_27(name: str) -> float:
    """The jump into recess of Fig. 5a, or at the matching position of Figs. 4b and 5b."""
    found = {at.phase: (at, last) for at, last in ends(name)}
    return 1 - found["approach"][1].share / found["recess"][0].share


def eq_22() -> float:
    """The jump of Fig. 4a."""
    ((first, last),) = ends("4a")
    return 1 - last.share / first.share
