"""Motion of all links at given positions of the input: speeds of the links, and driver angles of the pairs.

If the torque of a pair acts on the coast flanks, the transmission error of the pair follows from the transmission
function of these flanks. The flank in contact may change from position to position.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, InputPhase, common_period
from geartrain.dynamics.motion.kink_positions import KinkSearch

if TYPE_CHECKING:
    from collections.abc import Collection
    from fractions import Fraction

    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Bools, Floats


class LinkMotion(NamedTuple):
    """Speeds of the links and angles of the drivers at n positions of the input."""

    turns: Floats
    """Positions of the input [revolutions], shape (n,)."""
    speeds: Floats
    """Speeds of links about the reference direction, divided by the size of the input speed [1], shape (links, n)."""
    angles: Mapping[str, Floats]
    """Angle of the driver of each evaluated pair in its mean sense of rotation [rad], shape (n,), by pair."""


class PositionMotion:
    """Speeds of the links that transmit torque, and angles of drivers, with either flank of each pair in contact.

    motion  motion of these links relative to the frame
    pairs   names of the pairs whose ratio or losses depend on position
    """

    def __init__(self, motion: Motion, pairs: Collection[str]) -> None:
        self.motion = motion
        self.composition = motion._with_sources(pairs)
        self.sources: Mapping[str, PairErrorSource] = {
            source.id: source for source in self.composition.sources if source.id in pairs
        }

    @cached_property
    def links(self) -> Mapping[str, int]:
        """Row index of each link in the arrays of speeds, by link."""
        return {link: row for row, link in enumerate(self.motion.outputs)}

    @cached_property
    def _columns(self) -> list[int]:
        at = {link: number for number, link in enumerate(self.motion._propagation.links)}
        return [at[link] for link in self.links]

    @property
    def period(self) -> Fraction | None:
        """Revolutions of the input after which the evaluated pairs repeat; None if no pairs are evaluated."""
        return common_period(self.composition.used)

    @property
    def way(self) -> int:
        """Sign of the input's speed about its own axis. Positions increase in the sense in which the input turns."""
        return self.motion._problem.way

    @cached_property
    def senses(self) -> Floats:
        """Sense of each link's axis relative to the motion of the input, 1 or -1."""
        return np.array([float(self.way * self.motion._problem.signs.get(link, 1)) for link in self.links])

    @cached_property
    def means(self) -> Floats:
        """Mean speed of each link divided by the speed of the input [1]."""
        return np.array([float(self.motion._problem.ratio(link)) for link in self.links])

    def at(self, turns: Floats, coasting: Mapping[str, Bools]) -> LinkMotion:
        """Return the link speeds and driver angles at positions of the input [revolutions]. The number of positions may
        not exceed `composition.chunk`.

        coasting   boolean mask of the positions at which the coast flanks of a pair are in contact, by pair
        """
        speeds = np.empty((len(self.links), len(turns)))
        angles = {name: np.empty(len(turns)) for name in self.sources}
        # positions with the same flanks in contact have one composition; a row of zeros allows for no coasting pair
        masks = np.array([np.zeros(len(turns), bool), *coasting.values()])
        patterns, numbers = np.unique(masks, axis=1, return_inverse=True)
        for number, pattern in enumerate(patterns[1:].T):
            where = numbers.ravel() == number
            composition = self.coasting_all_along([name for name, on in zip(coasting, pattern, strict=True) if on])
            found = composition.at(turns[where])
            # the offset of a set pointer does not turn any driver
            own = found.error - np.array(composition.offsets or (0.0,))[:, None]
            error = dict(zip(self._columns, own, strict=True))
            phase = InputPhase(turns[where])
            for name, each in self.sources.items():
                angles[name][where] = composition.driver_angle(each, phase, error)
            speeds[:, where] = self.senses[:, None] * (self.means[:, None] + found.rate)
        return LinkMotion(turns, speeds, angles)

    def kinks(self, coasting: frozenset[str], span: float) -> Floats:
        """Return the positions of the input from 0 to `span` [revolutions] at which a transmission function has a kink.

        coasting   pairs whose coast flanks are in contact at all positions
        """
        return KinkSearch(self.coasting_all_along(coasting)).over(0.0, span).turns

    def coasting_all_along(self, pairs: Collection[str]) -> ErrorComposition:
        """Return the error composition with the coast flanks of the given pairs in contact at all positions."""
        if not pairs:
            return self.composition
        sources = tuple(
            replace(each, transmission=each.transmission.reversed_motion()) if each.id in pairs else each
            for each in self.composition.sources
        )
        return replace(self.composition, sources=sources)
