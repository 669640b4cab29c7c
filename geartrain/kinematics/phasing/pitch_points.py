"""Where every wheel is met by its mates: azimuths of contacts, in floats and as exact parts of a turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import Components
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


EPS = 2 * UNIT_ROUNDOFF


@dataclass(frozen=True)
class UnplacedPair:
    """A gear pair or coupling that has no known place, and why."""

    name: str
    why: str


@dataclass(frozen=True)
class PitchPoints:
    """The gear pairs whose place is known. All arrays have a row a pair and a column for each of its two wheels.

    circuits   the pairs; a wheel on the frame is a link of its own here, free to be mounted as it must
    azimuth    direction from the wheel's axis to the pitch point (turns, counterclockwise about its positive sense)
    slack      how far off the azimuth may be (turns)
    family     contacts of one wheel with one number stand at known parts of a turn from each other
    part       those parts, from the first of the family
    guessed    families in which a part was recognised from rounded positions
    left_out   pairs and couplings without a known place
    """

    circuits: tuple[Circuit, ...]
    azimuth: Floats
    slack: Floats
    family: Sequence[tuple[int, int]]
    part: Sequence[tuple[Fraction, Fraction]]
    guessed: frozenset[int] = frozenset()
    left_out: tuple[UnplacedPair, ...] = ()

    @cached_property
    def teeth(self) -> Floats:
        """Coefficients a and b of the pairs: tooth counts, the second negative where the sense is kept."""
        return np.array([(c.a, c.b) for c in self.circuits], float).reshape(-1, 2)

    @cached_property
    def constant(self) -> Floats:
        """c of equation (1) of the page on closure, in pitches from 0 to 1: a theta_i + b theta_j = c (mod 1)."""
        # whole pitches go before the sum, where they would eat digits; 1/2, for a tooth meets a gap
        whole: Floats = np.mod(np.mod(self.teeth * self.azimuth, 1.0).sum(axis=1) + 0.5, 1.0)
        return whole

    @cached_property
    def doubt(self) -> Floats:
        """How far off `constant` may be (pitches)."""
        # a pitch is 1 / z turn: what is unsure of an azimuth counts z times
        doubt: Floats = (np.abs(self.teeth) * (self.slack + 2 * EPS)).sum(axis=1) + 4 * EPS
        return doubt

    @cached_property
    def scale(self) -> int:
        """A denominator that all exact parts of a turn, and one half, have in common."""
        found = {part.denominator for parts in self.part for part in parts}
        # as objects: a common denominator of many parts may pass 64 bits
        return int(np.lcm.reduce(np.array([2, *found], dtype=object)))

    @cached_property
    def exact_constant(self) -> list[int]:
        """c counted in parts of `scale`, with azimuths from the first contact of each family."""
        scale, found = self.scale, []
        for circuit, (p, q) in zip(self.circuits, self.part, strict=True):
            here, there = p.numerator * (scale // p.denominator), q.numerator * (scale // q.denominator)
            found.append((circuit.a * here + circuit.b * there + scale // 2) % scale)
        return found


def mesh_nodes(parts: Components, circuits: Sequence[Circuit]) -> list[tuple[int, int]]:
    """The two nodes of every pair: its links as seen from its carrier."""
    index = parts.index
    at = {key: node for node, key in enumerate(zip(parts.node_link, parts.node_carrier, strict=True))}
    return [(at[index[c.i], index[c.carrier]], at[index[c.j], index[c.carrier]]) for c in circuits]


def contact_families(keys: Sequence[tuple[object, object]]) -> tuple[list[tuple[int, int]], Mapping[object, int]]:
    """One family for each wheel's key, in order."""
    number: dict[object, int] = {}
    for pair in keys:
        for key in pair:
            number.setdefault(key, len(number))
    return [(number[i], number[j]) for i, j in keys], number
