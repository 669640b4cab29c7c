"""Compositions of outputs at turn 0 of which every tooth and pin is where its phase says, and every pointer is set.

Section 3 of docs/motion.md. The angles of drivers are counted from turn 0, so that the errors of the pairs before a
pair do not move the tooth with which it starts.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, SeenLink

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_errors import PairErrors
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class PointerCompositions:
    """The compositions of some outputs of a train, from the errors of its pairs."""

    errors: PairErrors
    outputs: tuple[SeenLink, ...]

    def composed(self, way: int, besides: Collection[str] = ()) -> ErrorComposition:
        """The composition while the input turns that way; `besides` as of `PairErrors.sources`."""
        play, (teeth, pins) = self.errors.play(way), self._start
        found = ErrorComposition(self.errors.spread, tuple(self.errors.sources(way, besides)), self.outputs)
        sources = tuple(
            replace(
                each,
                phase=each.phase + found.driver_shift(each, play),
                set_back=found.driver_shift(each, teeth + pins),
            )
            for each in found.sources
        )
        return replace(found, sources=sources, offsets=tuple(each.difference(play - teeth) for each in self.outputs))

    @cached_property
    def _start(self) -> tuple[Floats, Floats]:
        """What teeth, and what pins add to the angle of each link at turn 0 (rad): linear, as all drivers are known."""
        deltas = np.zeros((len(self.errors.spread.pairs), 2))
        pins = {joint.coupling.name for joint in self.errors.train.pins}
        for each in self.errors.sources(1):
            deltas[each.pair, int(each.id in pins)] = each.sense * float(each.law.error(each.phase))
        teeth, slots = self.errors.spread.errors(deltas).T
        return teeth, slots

    @property
    def setting(self) -> Floats:
        """By how much each link is turned on its wheels (rad), so that its teeth do not displace it at turn 0."""
        return -self._start[0]
