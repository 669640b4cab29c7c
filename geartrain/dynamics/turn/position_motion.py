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

from geartrain.dynamics.motion.error_composition import ErrorComposition, InputPhase
from geartrain.dynamics.turn.flank_choice import FlankChoice

if TYPE_CHECKING:
    from collections.abc import Collection

    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Bools, Floats


class LinkMotion(NamedTuple):
    """How links turn at some positions of the input.

    turns    of the input, (n,)
    speeds   of links about the direction of their parallels, over the input's, (links, n)
    angles   by pair that is followed, forward angle of its law's driver (rad), (n,)
    """

    turns: Floats
    speeds: Floats
    angles: Mapping[str, Floats]


class PositionMotion:
    """The motion of all links of a train.

    motion     of all links, each seen from the frame, in the order of its solved system
    followed   pairs of constant ratio whose position is wanted all the same
    """

    def __init__(self, motion: Motion, followed: Collection[str]) -> None:
        self.motion = motion
        self.composition = motion.with_sources(followed)

    @cached_property
    def sources(self) -> Mapping[str, PairErrorSource]:
        """The pairs that are followed, by name."""
        return {source.id: source for source in self.composition.sources}

    @cached_property
    def links(self) -> Mapping[str, int]:
        """The row of each link."""
        return {link: row for row, link in enumerate(self.motion.spread.links)}

    @cached_property
    def _senses(self) -> Floats:
        return np.array([float(self.motion.train.signs.get(link, 1)) for link in self.links])[:, None]

    @cached_property
    def _means(self) -> Floats:
        return np.array([float(self.motion.train.ratio(link)) for link in self.links])[:, None]

    def at(self, turns: Floats, coasting: Mapping[str, Bools]) -> LinkMotion:
        """Speeds and angles at some positions, at most a chunk of them.

        coasting   by pair, the positions at which its coast flanks touch
        """
        composition = self.composition
        if coasting:
            sources = tuple(
                replace(each, law=FlankChoice(each.law, coasting[each.id])) if each.id in coasting else each
                for each in composition.sources
            )
            composition = ErrorComposition(composition.spread, sources, composition.outputs, composition.offsets)
        found = composition.at(turns)
        # a pointer that is set turns no driver
        error = found.error - np.array(composition.offsets or (0.0,))[:, None]
        phase = InputPhase(turns)
        angles = {name: composition.driver_angle(each, phase, error) for name, each in self.sources.items()}
        return LinkMotion(turns, self._senses * (self._means + found.rate), angles)
