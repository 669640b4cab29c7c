"""How every link of a train turns at each position, and where the driver of each pair stands: the motion of all links.

Where the torque through a pair presses on its coast flanks the law of those gives its error there: a position may have
another flank in each pair.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, InputPhase, common_period
from geartrain.dynamics.motion.kink_positions import KinkSearch
from geartrain.teeth.transmission import DerivedTransmission

if TYPE_CHECKING:
    from collections.abc import Collection
    from fractions import Fraction

    from numpy.typing import ArrayLike

    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction


class FlankChoice(DerivedTransmission):
    """At each angle it is asked at, the law of the flanks that touch there; of a period, that of the drive flanks.

    coasting   where the coast flanks touch: one for each angle
    """

    def __init__(self, transmission: TransmissionFunction, coasting: Bools) -> None:
        super().__init__(transmission)
        self.coasting, self.friction = coasting, transmission.friction

    def picked(self, columns: Ints) -> FlankChoice:
        """For some of the angles."""
        return FlankChoice(self.transmission, self.coasting[columns])

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Of either flank where it touches: the play lies between them."""
        S = np.asarray(S, dtype=float)
        error, speed = np.empty_like(S), np.empty_like(S)
        for transmission, where in (
            (self.transmission, ~self.coasting),
            (self.transmission.reversed_motion(), self.coasting),
        ):
            if where.any():
                error[where], speed[where] = transmission.error_and_speed(S[where])
        return error, speed

    def error(self, S: ArrayLike) -> Floats:
        """Of either flank where it touches."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """Of either flank where it touches."""
        return self.error_and_speed(S)[1]

    def efficiency(self, S: ArrayLike) -> Floats:
        """Of the drive flanks."""
        return self.transmission.efficiency(S)

    def efficiency_mean(self) -> float:
        """Of the drive flanks."""
        return self.transmission.efficiency_mean()

    def efficiency_at_constant_load(self) -> float:
        """Of the drive flanks."""
        return self.transmission.efficiency_at_constant_load()

    def efficiency_minimum(self) -> float:
        """Of the drive flanks."""
        return self.transmission.efficiency_minimum()


class LinkMotion(NamedTuple):
    """How links turn at some positions of the input."""

    turns: Floats
    """Of the input, (n,)."""
    speeds: Floats
    """Of links about the direction of their parallels, over the magnitude of the input's, (links, n)."""
    angles: Mapping[str, Floats]
    """By pair that is followed, forward angle of its law's driver (rad), (n,)."""


class PositionMotion:
    """The motion of the links of a train that torque passes through.

    motion     of links, each seen from the frame
    pairs      those whose position is wanted, as far as their ratio or what they lose depends on it
    """

    def __init__(self, motion: Motion, pairs: Collection[str]) -> None:
        self.motion = motion
        self._kinks: dict[tuple[frozenset[str], float], Floats] = {}
        self.composition = motion._with_sources(pairs)
        self.sources: Mapping[str, PairErrorSource] = {
            source.id: source for source in self.composition.sources if source.id in pairs
        }

    @cached_property
    def links(self) -> Mapping[str, int]:
        """The row of each link."""
        return {link: row for row, link in enumerate(self.motion.outputs)}

    @cached_property
    def _columns(self) -> list[int]:
        """The number of each link in the solved order."""
        at = {link: number for number, link in enumerate(self.motion._propagation.links)}
        return [at[link] for link in self.links]

    @property
    def period(self) -> Fraction | None:
        """Turns of the input after which every pair that is followed stands as at the start; None where none is."""
        return common_period(self.composition.used)

    @property
    def way(self) -> int:
        """-1 where the input turns backwards about its own axis: motion counts in its own sense."""
        return self.motion._problem.way

    @cached_property
    def senses(self) -> Floats:
        """Of each link: 1 or -1, that of its axis over the input's own."""
        return np.array([float(self.way * self.motion._problem.signs.get(link, 1)) for link in self.links])

    @cached_property
    def means(self) -> Floats:
        """Mean speed of each link over the input's."""
        return np.array([float(self.motion._problem.ratio(link)) for link in self.links])

    def at(self, turns: Floats, coasting: Mapping[str, Bools]) -> LinkMotion:
        """Speeds and angles at some positions, at most a chunk of them.

        coasting   by pair, the positions at which its coast flanks touch
        """
        composition = self._with_transmissions(
            {name: FlankChoice(self.sources[name].transmission, where) for name, where in coasting.items()}
        )
        found = composition.at(turns)
        # a pointer that is set turns no driver
        own = found.error - np.array(composition.offsets or (0.0,))[:, None]
        error = dict(zip(self._columns, own, strict=True))
        phase = InputPhase(turns)
        angles = {name: composition.driver_angle(each, phase, error) for name, each in self.sources.items()}
        return LinkMotion(turns, self.senses[:, None] * (self.means[:, None] + found.rate), angles)

    def kinks(self, coasting: frozenset[str], span: float) -> Floats:
        """Turns of the input, from 0 to `span`, at which a law has a corner while some pairs coast all along."""
        if (coasting, span) not in self._kinks:
            composition = self.coasting_all_along(coasting)
            self._kinks[coasting, span] = KinkSearch(composition).over(0.0, span).turns
        return self._kinks[coasting, span]

    def coasting_all_along(self, pairs: Collection[str]) -> ErrorComposition:
        """The composition with the coast flanks of some pairs touching everywhere."""
        return self._with_transmissions({name: self.sources[name].transmission.reversed_motion() for name in pairs})

    def _with_transmissions(self, transmissions: Mapping[str, TransmissionFunction]) -> ErrorComposition:
        composition = self.composition
        if not transmissions:
            return composition
        sources = tuple(
            replace(each, transmission=transmissions.get(each.id, each.transmission)) for each in composition.sources
        )
        return ErrorComposition(composition.spread, sources, composition.outputs, composition.offsets)
