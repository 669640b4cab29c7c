"""A gear pair whose form gives the outline of both wheels and nothing else: its motion follows from their contact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.teeth.gear_mesh import GearMesh, PairSize, friction_lock

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateVerdict
    from geartrain.teeth.outline_transmission import OutlineTransmission
    from geartrain.teeth.outlines.wheel_requirement import FixedTooth


@dataclass(frozen=True)
class OutlineMesh(GearMesh):
    """A spur pair with any teeth; `teeth` of the first and the second wheel as they are cut, in modules."""

    law: OutlineTransmission
    teeth: tuple[FixedTooth, FixedTooth]

    @cached_property
    def reversed(self) -> OutlineTransmission:
        """The law with the other wheel driving."""
        return self.law.reversed

    @property
    def verdict(self) -> ConjugateVerdict:
        """Whether these teeth can turn."""
        return self.law.verdict

    @property
    def stands(self) -> float:
        """Half a tooth of both wheels: the driven angle is counted from where flanks touch."""
        return self.law.gears.lead / pi

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Lengths of the law are modules already."""
        del tips
        distance = self.law.gears.distance
        return PairSize(1.0, distance, distance / self.wheels.touching)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """The tooth as the form has it, arcs and all."""
        del scale, tolerance
        return self.teeth[self.gear.pair.index(wheel)]

    def _faults(self) -> Iterator[Problem]:
        yield from (Problem(fault.what, fault.why, fault.fix) for fault in self.verdict.faults)
        if self.law.friction >= self.law.locking_friction:
            yield friction_lock(self.law.friction, self.law.locking_friction)
