"""Motion of a train with real teeth by brute force: angles advance in small steps, from contact to contact.

No transmission function is used. A pair is a tooth of the driver against a tooth of the driven wheel: the distance of
an apex from the other tooth's flank shows whether they touch, and its derivatives give the speed ratio of the touching
wheels. At each step, the speeds of all links follow from the linear equations of the train with these instantaneous
ratios; when another tooth pair touches, the step ends and that pair drives.

Angles of a pair are forward angles S and q relative to the carrier, which increase as the pair turns; apices are at
x = k p1 - S and y = k p2 - q from the line of centres, positive on the entry side. At the start, every driver has an
apex, or its pin, on the line of centres, and every link is at 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from math import acos, cos, pi, radians, sin
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

APPROACH, RECESS = 0, 1
METHODS = {  # stages: how far on and along which stage; then the weights of all stages
    "Euler": ([], [1.0]),
    "midpoint": ([(0.5, 0)], [0.0, 1.0]),
    "Runge-Kutta": ([(0.5, 0), (0.5, 1), (1.0, 2)], [1 / 6, 1 / 3, 1 / 3, 1 / 6]),
}

MOST_MEETINGS = 60  # within one step


class JammedError(AssertionError):
    """No contact permits the step to be finished: the links push back on their drivers."""


class Contact(NamedTuple):
    """A tooth pair, and which apex is on which flank: the driven apex on the driver's flank in approach."""

    k: int
    phase: int


@dataclass(frozen=True)
class Teeth:
    """Two external wheels with triangular teeth of equal depth, the first driving; angles in degrees."""

    z1: int
    z2: int
    clearance: float
    half_angle: float = 30.0
    external = True
    mean = property(lambda self: self.z1 / self.z2)

    @property
    def form(self) -> str:
        """Text of the tooth form in the declaration of a pair."""
        return (
            f", tooth_form: {{form: triangular, half_angle: {self.half_angle} deg, clearance_factor: {self.clearance}}}"
        )

    @cached_property
    def sizes(self) -> tuple[float, float, float, float]:
        """R1, R2, D and the half angle; teeth of equal depth, R1 = 1."""
        b = radians(self.half_angle)
        h1, h2 = (1 - sin(b) / sin(b + pi / z) for z in (self.z1, self.z2))
        return 1.0, h1 / h2, self.clearance * (1 + h1 / h2 - h1), b

    @cached_property
    def reach(self) -> float:
        """Maximum |x| at which the driver's apex is within the driven tip circle."""
        R1, R2, D, _ = self.sizes
        return acos((D * D + R1 * R1 - R2 * R2) / (2 * D * R1))

    def place(self, contact: Contact, S: float, q: float) -> tuple[float, float]:
        """Return the angles of both apices of a tooth pair from the line of centres."""
        return contact.k * 2 * pi / self.z1 - S, contact.k * 2 * pi / self.z2 - q

    def gap(self, contact: Contact, S: float, q: float) -> float:
        """Return the distance of an apex from the line of the other tooth's flank; negative inside."""
        R1, R2, D, b = self.sizes
        x, y = self.place(contact, S, q)
        if contact.phase == APPROACH:
            return D * sin(x + b) - R1 * sin(b) - R2 * sin(x + b + y)
        return D * sin(b - y) - R2 * sin(b) - R1 * sin(b - y - x)

    def speed(self, contact: Contact, S: float, q: float) -> float:
        """Return the ratio dq/dS that preserves the gap."""
        R1, R2, D, b = self.sizes
        x, y = self.place(contact, S, q)
        if contact.phase == APPROACH:
            return D * cos(x + b) / (R2 * cos(x + b + y)) - 1
        return R1 * cos(b - y - x) / (D * cos(b - y) - R1 * cos(b - y - x))

    def near(self, S: float) -> Iterator[Contact]:
        """Yield every tooth pair whose driving tooth is within reach, in both phases."""
        p1 = 2 * pi / self.z1
        for k in range(int(np.ceil((S - self.reach) / p1)), int(np.floor((S + self.reach) / p1)) + 1):
            yield Contact(k, APPROACH)
            yield Contact(k, RECESS)

    def touching(self, S: float) -> tuple[Contact, float]:
        """Return the first contact of the driven wheel when it is turned back, and its angle there."""
        R1, R2, D, _ = self.sizes
        reach = acos((D * D + R2 * R2 - R1 * R1) / (2 * D * R2))
        found = []
        for contact in self.near(S):
            low, high = (contact.k * 2 * pi / self.z2 + end for end in (-reach, reach))
            if self.gap(contact, S, low) < 0 < self.gap(contact, S, high):
                found.append((brentq(partial(self.gap, contact, S), low, high, xtol=1e-15), contact))
        q, contact = max(found)
        return contact, q


@dataclass(frozen=True)
class Slot:
    """A pin at radius r in a slot whose axis is at the offset e, within the pin's circle."""

    r: float
    e: float
    external = False
    mean = 1.0

    @property
    def form(self) -> str:
        """Text of the coupling in a declaration."""
        return f", pin_radius: {self.r}, offset: {self.e}"

    def gap(self, contact: Contact, S: float, q: float) -> float:
        """Return the distance of the pin from the middle of the slot."""
        return (self.r * cos(S) - self.e) * sin(q) - self.r * sin(S) * cos(q)

    def speed(self, contact: Contact, S: float, q: float) -> float:
        """Return the pin's speed across the slot divided by its distance from the slot's axis."""
        across = self.r * cos(S - q)
        return across / (across - self.e * cos(q))

    def near(self, S: float) -> Iterator[Contact]:
        """Return nothing, because no other contact is possible."""
        return iter(())

    def touching(self, S: float) -> tuple[Contact, float]:
        """Return the contact at the start: the slot points along the pin's radius."""
        assert S == 0.0
        return Contact(0, 0), 0.0


@dataclass(frozen=True)
class Pair:
    """Driver, driven link, carrier and connection: `Teeth`, a `Slot`, or an object with the same attributes."""

    driver: str
    driven: str
    carrier: str
    by: Any


@dataclass(frozen=True)
class Train:
    """Links with the link that bears them and their axis, pairs, and the input speeds; `frame` is at rest."""

    bases: dict[str, tuple[str, str]]
    pairs: tuple[Pair, ...]
    inputs: dict[str, float]

    @cached_property
    def at(self) -> dict[str, int]:
        """Numbers of the links; the frame is last."""
        return {link: number for number, link in enumerate([*self.bases, "frame"])}

    def solved(self, ratios: Sequence[float], ahead: Sequence[float], turning: float) -> np.ndarray:
        """Return the speeds of all links if each driven side is ahead of its ratio by `ahead`, relative to the
        carrier.
        """
        still, turned, given = self._rows
        right = np.array([*ahead, *(turning * given)])
        matrix = still + turned * np.array([*ratios, *[0.0] * len(given)])[:, None]
        return np.linalg.solve(matrix, right)

    @cached_property
    def _rows(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rows of the pairs and of the given speeds: constant part, part proportional to the ratio, and given
        speeds.
        """
        size, given = len(self.at), self.inputs | {"frame": 0.0}
        still, turned = np.zeros((size, size)), np.zeros((size, size))
        for row, pair in enumerate(self.pairs):
            still[row, self.at[pair.driven]] += 1.0
            still[row, self.at[pair.carrier]] -= 1.0
            turned[row, self.at[pair.driver]] -= 1.0
            turned[row, self.at[pair.carrier]] += 1.0
        for row, link in enumerate(given, start=len(self.pairs)):
            still[row, self.at[link]] = 1.0
        return still, turned, np.array(list(given.values()))

    def speeds(self, ratios: Sequence[float]) -> np.ndarray:
        """Return the speeds of all links for given signed ratios of the pairs, driven by driver."""
        return self.solved(ratios, [0.0] * len(self.pairs), 1.0)

    @cached_property
    def means(self) -> np.ndarray:
        """Mean speeds."""
        return self.speeds([-pair.by.mean if pair.by.external else pair.by.mean for pair in self.pairs])

    @cached_property
    def senses(self) -> list[tuple[int, int]]:
        """Signs that convert the driver and driven angles of each pair to forward angles."""
        means = self.means
        ahead = [1 if means[self.at[pair.driver]] >= means[self.at[pair.carrier]] else -1 for pair in self.pairs]
        return [(a, -a if pair.by.external else a) for a, pair in zip(ahead, self.pairs, strict=True)]

    @cached_property
    def touches(self) -> list[tuple[Contact, float]]:
        """Contact of each pair with the driver on the line of centres, and the driven angle there."""
        return [pair.by.touching(0.0) for pair in self.pairs]

    def forward(self, angles: np.ndarray, number: int) -> tuple[float, float]:
        """Return the forward angles S and q of one pair from angles of links that are 0 at the start."""
        pair, (first, second) = self.pairs[number], self.senses[number]
        carrier = angles[self.at[pair.carrier]]
        S, q = angles[self.at[pair.driver]] - carrier, angles[self.at[pair.driven]] - carrier
        return float(first * S), float(second * q) + self.touches[number][1]

    def rates(self, angles: np.ndarray, contacts: Sequence[Contact]) -> np.ndarray:
        """Return the speeds of all links at these angles for the given contacts."""
        ratios = []
        for number, (pair, contact) in enumerate(zip(self.pairs, contacts, strict=True)):
            first, second = self.senses[number]
            ratios.append(first * second * pair.by.speed(contact, *self.forward(angles, number)))
        return self.speeds(ratios)

    @property
    def lag(self) -> np.ndarray:
        """Angles of all links at the start minus their angles with ideal teeth."""
        mean = [first * second * pair.by.mean for pair, (first, second) in zip(self.pairs, self.senses, strict=True)]
        ahead = [second * q for (_, second), (_, q) in zip(self.senses, self.touches, strict=True)]
        return self.solved(mean, ahead, 0.0)


def declared(train: Train) -> str:
    """Return the train as a declaration: two separate wheels for each pair, or a pin and a slot."""
    wheels: dict[str, list[str]] = {link: [] for link in train.bases}
    gears, slots = [], []
    for at, pair in enumerate(train.pairs):
        if pair.by.external:
            wheels[pair.driver].append(f"d{at}: {pair.by.z1}")
            wheels[pair.driven].append(f"f{at}: {pair.by.z2}")
            gears.append(f"  - {{pair: [d{at}, f{at}], driver: d{at}{pair.by.form}}}")
        else:
            slots.append(f"  - {{kind: pin_and_slot, pin: {pair.driver}, slot: {pair.driven}{pair.by.form}}}")
    lines = ["links:", "  frame: {}"]
    lines += [f"  {link}: {{wheels: {{{', '.join(each)}}}}}" for link, each in wheels.items()]
    lines += ["revolutes:"]
    lines += [f"  - {{pair: [{base}, {link}], axis: {axis}}}" for link, (base, axis) in train.bases.items()]
    lines += ["gears:", *gears] if gears else []
    lines += ["couplings:", *slots] if slots else []
    inputs = ", ".join(f"{link}: {Fraction(speed).limit_denominator(10**6)}" for link, speed in train.inputs.items())
    lines += [f"inputs: {{{inputs}}}", f"outputs: {{{', '.join(f'{link}: {{}}' for link in train.bases)}}}"]
    return "\n".join(lines)


# ------------------------------------------------------------------------------------------------------------- marching


def march(train: Train, turned: float, steps: int, method: str, locate: bool = True) -> Iterator[np.ndarray]:
    """Return the angles of all links at the start and after each of `steps` equal steps of the inputs.

    With `locate`, a step ends where other teeth touch; otherwise they are noticed at the end of the step.
    """
    angles, contacts = np.zeros(len(train.at)), [contact for contact, _ in train.touches]
    yield angles
    for _ in range(steps):
        angles, contacts = (_located if locate else _noticed)(train, angles, contacts, turned / steps, method)
        yield angles


def _noticed(
    train: Train, angles: np.ndarray, contacts: list[Contact], step: float, method: str
) -> tuple[np.ndarray, list[Contact]]:
    new = _step(train, angles, contacts, step, method)
    for meeting in list(_met(train, contacts, angles, new)):
        contacts = meeting.made(contacts)
    return new, contacts


def _located(
    train: Train, angles: np.ndarray, contacts: list[Contact], step: float, method: str
) -> tuple[np.ndarray, list[Contact]]:
    left = step
    for _ in range(MOST_MEETINGS):
        new = _step(train, angles, contacts, left, method)
        met = list(_met(train, contacts, angles, new))
        if not met:
            return new, contacts
        times = [meeting.when(angles, contacts, left, method) for meeting in met]
        first = times.index(min(times))
        angles, left = _step(train, angles, contacts, times[first], method), left - times[first]
        contacts = met[first].made(contacts)
    raise JammedError


def _step(train: Train, angles: np.ndarray, contacts: list[Contact], step: float, method: str) -> np.ndarray:
    """Return the result of one step of an explicit method with unchanged contacts."""
    earlier, weights = METHODS[method]
    rates = [train.rates(angles, contacts)]
    for part, stage in earlier:
        rates.append(train.rates(angles + part * step * rates[stage], contacts))
    return angles + step * sum(weight * rate for weight, rate in zip(weights, rates, strict=True))


def _met(train: Train, contacts: list[Contact], old: np.ndarray, new: np.ndarray) -> Iterator[_Meeting]:
    """Return the apices that have passed through a flank within a step."""
    for number, pair in enumerate(train.pairs):
        before, after = train.forward(old, number), train.forward(new, number)
        for contact in pair.by.near(after[0]):
            gap = pair.by.gap(contact, *after)
            if contact != contacts[number] and gap < 0 and gap < pair.by.gap(contact, *before):
                yield _Meeting(train, number, contact)


@dataclass(frozen=True)
class _Meeting:
    """An apex that reaches a flank."""

    train: Train
    number: int
    contact: Contact

    def when(self, angles: np.ndarray, contacts: list[Contact], step: float, method: str) -> float:
        """Return the fraction of the step until contact."""

        def gap(part: float) -> float:
            at = self.train.forward(_step(self.train, angles, contacts, part, method), self.number)
            return self.train.pairs[self.number].by.gap(self.contact, *at)

        return 0.0 if gap(0.0) <= 0 else float(brentq(gap, 0.0, step, xtol=1e-15))

    def made(self, contacts: list[Contact]) -> list[Contact]:
        """Return the contacts including this one."""
        return [self.contact if number == self.number else each for number, each in enumerate(contacts)]
