"""Compositions whose pointers are set: at turn 0 every link stands where ideal teeth would have it.

Section 3 of docs/motion.md. Teeth hold their links back; whoever mounts a train turns every link on its wheels until it
reads right, and pins turn with their links.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, SeenLink
from geartrain.teeth.constant_lag import ConstantLag

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_errors import PairErrors
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class PointerCompositions:
    """The compositions of some outputs of a train, from the errors of its pairs."""

    errors: PairErrors
    outputs: tuple[SeenLink, ...]

    def composed(self, way: int, besides: Collection[str] = ()) -> ErrorComposition:
        """Every link is set where ideal teeth would have it at turn 0; its pins are counted from there."""
        found, setting = self._hung(way, self.outputs, besides), self.setting
        if setting is None:
            return found
        sources = list(found.sources)
        for at, source in enumerate(sources):
            if source.id in self._pins:
                turned = found.driver_shift(source, setting)
                sources[at] = replace(source, start=source.start + turned, turned=turned)
        own = found.offsets or (0.0,) * len(self.outputs)
        offsets = [each + seen.difference(setting) for each, seen in zip(own, self.outputs, strict=True)]
        return ErrorComposition(self.errors.spread, tuple(sources), self.outputs, tuple(offsets))

    def hung(self, ahead: ErrorComposition) -> ErrorComposition:
        """A composition of this train while it turns as declared, with every link as its teeth hold it."""
        offsets = self._hung(1, self.outputs).offsets
        return ErrorComposition(self.errors.spread, ahead.sources, self.outputs, offsets)

    def _hung(self, way: int, outputs: tuple[SeenLink, ...], besides: Collection[str] = ()) -> ErrorComposition:
        """The composition with every link as its teeth hold it: at turn 0 it lags by what they do."""
        found = ErrorComposition(self.errors.spread, tuple(self.errors.sources(way, besides)), outputs)
        error = self.errors.play(way)
        if error is None:
            return found
        sources = tuple(replace(each, start=each.start + found.driver_shift(each, error)) for each in found.sources)
        return ErrorComposition(self.errors.spread, sources, outputs, tuple(seen.difference(error) for seen in outputs))

    @cached_property
    def _pins(self) -> frozenset[str]:
        return frozenset(joint.coupling.name for joint in self.errors.train.pins)

    @cached_property
    def setting(self) -> Floats | None:
        """By how much links are turned on their wheels (rad), so that none lags at turn 0; None where nothing does.

        Only links that are asked for, or that carry pins, are looked at.
        """
        if not self.errors.train.rippling and self.errors.play(1) is None:
            return None
        pins = [each for each in self.errors.sources(1) if each.id in self._pins]
        joints = [self.errors.spread.joints[each.pair] for each in pins]
        links = sorted({*(link for seen in self.outputs for link in (seen.of, seen.base)), *(j.driver for j in joints),
                        *(j.carrier for j in joints)})  # fmt: skip
        outputs = tuple(SeenLink(link, self.errors.index[self.errors.train.frame]) for link in links)
        ideal = np.zeros(len(self.errors.spread.links))
        ideal[links] = ErrorComposition(self.errors.spread, tuple(pins), outputs).at(np.zeros(1)).error[:, 0]
        hung = self._hung(1, outputs)
        # a pin turns with its link, so that at turn 0 it stands as if all teeth were ideal
        still = {each.pair: ConstantLag.at(each.law, each.start + hung.driver_shift(each, ideal)) for each in pins}
        sources = tuple(replace(each, law=still.get(each.pair, each.law)) for each in hung.sources)
        real = ErrorComposition(self.errors.spread, sources, outputs, hung.offsets).at(np.zeros(1)).error[:, 0]
        setting = np.zeros_like(ideal)
        setting[links] = ideal[links] - real
        return setting
