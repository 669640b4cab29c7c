"""Fusees, which are conical pulleys that equalise the torque of a mainspring, and the torque at the fusee over its run.

A chain runs from the fusee onto the barrel, of radius R. The radius r of the fusee depends on the angle phi by which it
has turned. The spring unwinds by dw = -(r/R) dphi, and the torque at the fusee is T = k w r/R, where k is the stiffness
of the spring and w its wound angle (w0 at phi = 0). A constant torque T requires the radius r = T R/(k sqrt(w0^2 - 2 T
phi/k)).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import inf, sqrt, tau
from typing import NamedTuple


class FuseeRun(NamedTuple):
    """Torque at a fusee from the fully wound spring until the chain has left the fusee, and the chain and winding
    required.
    """

    first: float
    """Torque with the fully wound spring [N m]; `last` is the torque when the chain has left the fusee."""
    last: float
    maximum: float
    """Maximum torque [N m], reached after `maximum_at` turns of the fusee."""
    maximum_at: float
    minimum: float
    """Minimum torque [N m], reached after `minimum_at` turns of the fusee."""
    minimum_at: float
    mean: float
    """Mean torque over the angle of the fusee [N m]."""
    radii: tuple[float, float]
    """Radius of the fusee with the fully wound spring, and when the chain has left the fusee [m]."""
    chain: float
    """Length of the chain that passes from the fusee to the barrel [m]."""
    left: float
    """Number of turns by which the spring is still wound when the chain has left the fusee."""
    energy: float
    """Energy that the spring delivers from fully wound until the chain has left the fusee [J]."""


class ConicalSection(NamedTuple):
    """Section of a fusee in which the radius is a linear function of the angle of the fusee."""

    start: float
    """Angle of the fusee at the beginning of the section [rad]; `width` is the angle of the section [rad]."""
    width: float
    radius: float
    """Radius at the beginning [m]; `slope` is the derivative of the radius with respect to the angle [m/rad]."""
    slope: float
    wound: float
    """Wound angle of the spring at the beginning of the section [rad]."""
    barrel: float
    """Radius of the barrel [m]."""

    def state(self, phi: float) -> tuple[float, float]:
        """Return the wound angle of the spring [rad] and the radius [m] at the angle `phi` of the fusee [rad]."""
        x = phi - self.start
        return self.wound - (self.radius + self.slope * x / 2) * x / self.barrel, self.radius + self.slope * x

    def extremes(self) -> Iterator[float]:
        """Yield the angles of the fusee [rad] at which its torque can be extreme: both ends, and stationary points."""
        yield from (self.start, self.start + self.width)
        # with r = radius + r' x this is a quadratic in x
        a, b = 1.5 * self.slope**2, 3 * self.radius * self.slope
        c = self.radius**2 - self.slope * self.wound * self.barrel
        if a and (inside := b**2 - 4 * a * c) >= 0:
            roots = ((-b + sign * sqrt(inside)) / (2 * a) for sign in (1, -1))
            yield from (self.start + x for x in roots if 0 < x < self.width)

    @property
    def end(self) -> float:
        """Angle of the fusee at which the spring has run down [rad]; infinite if this is not within the section."""
        # smaller root of slope x^2/2 + radius x = barrel wound
        inside = self.radius**2 + 2 * self.slope * self.barrel * self.wound
        x = 2 * self.barrel * self.wound / (self.radius + sqrt(inside)) if inside >= 0 else inf
        return self.start + x if x <= self.width else inf


class FuseeSpring(NamedTuple):
    """Spring in a barrel with a fusee: stiffness [N m/rad], initial wound angle [rad], and radius of the barrel [m]."""

    stiffness: float
    wound: float
    barrel: float
    turns: float
    """Number of turns of the fusee from the fully wound spring until the chain has left the fusee."""
    constant: float | None
    """Constant torque at the fusee [N m]; None if the fusee is declared by its radii."""
    radii: tuple[float, ...] = ()
    """Radii of the fusee at equally spaced angles [m], from the fully wound spring to the end of the chain."""

    @property
    def angle(self) -> float:
        """Angle of the fusee from fully wound to the end of the chain [rad]."""
        return tau * self.turns

    def _sections(self) -> list[ConicalSection]:
        """Return the sections of the fusee between its declared radii."""
        width, wound, found = self.angle / (len(self.radii) - 1), self.wound, []
        for at, (first, last) in enumerate(pairwise(self.radii)):
            found.append(ConicalSection(at * width, width, first, (last - first) / width, wound, self.barrel))
            wound -= (first + last) / 2 * width / self.barrel
        return found

    def state(self, phi: float) -> tuple[float, float]:
        """Return the wound angle of the spring [rad] and the radius of the fusee [m] at a fusee angle `phi` [rad]."""
        if self.constant is None:
            sections = self._sections()
            return next((each for each in sections if phi <= each.start + each.width), sections[-1]).state(phi)
        wound = sqrt(max(self.wound**2 - 2 * self.constant * phi / self.stiffness, 0.0))
        return wound, self.constant * self.barrel / (self.stiffness * wound) if wound else inf

    def torque(self, phi: float) -> float:
        """Return the torque at the fusee [N m] after the fusee has turned by `phi` [rad]."""
        if self.constant is not None:
            return self.constant
        wound, radius = self.state(phi)
        return self.stiffness * wound * radius / self.barrel

    def run(self) -> FuseeRun:
        """Return the torque at the fusee from the fully wound spring to the end of the chain, and the length of chain
        and the winding that this requires.
        """
        left, last = self.state(self.angle)
        energy = self.stiffness * (self.wound - left) * (self.wound + left) / 2
        places = [0.0, self.angle]
        if self.constant is None:
            places = [place for section in self._sections() for place in section.extremes()]
        maximum, minimum = (pick(places, key=self.torque) for pick in (max, min))
        return FuseeRun(
            self.torque(0.0),
            self.torque(self.angle),
            self.torque(maximum),
            maximum / tau,
            self.torque(minimum),
            minimum / tau,
            energy / self.angle,
            (self.state(0.0)[1], last),
            self.barrel * (self.wound - left),
            left / tau,
            energy,
        )

    @property
    def end(self) -> float:
        """Number of turns of the fusee until the spring has run down; infinite if the chain ends before."""
        if self.constant is None:
            return min((section.end for section in self._sections()), default=inf) / tau
        end = self.stiffness * self.wound**2 / (2 * self.constant)
        return end / tau if end < self.angle else inf
