"""Requirements of gear pairs on the teeth of a wheel, and the tooth that fits all pairs of the wheel."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.errors import Problem

if TYPE_CHECKING:
    from geartrain.teeth.outlines.tooth_outline import Vertex

SAME_SIZE = 1e-9  # of a length, or rad: smaller differences count as equal


@dataclass(frozen=True, slots=True)
class LanternPins:
    """Round pins of a lantern or of a ring of pins: number of the gear that has them, radius of the pin circle [module]
    and radius of a pin [module].
    """

    gear: int
    circle: float
    radius: float


@dataclass(frozen=True, slots=True)
class CutTooth:
    """Tooth of a wheel that is to be cut. Lengths are in modules."""

    kind: str
    """Kind of the wheel: external, ring or pins."""
    tip: float
    """Radius of the tip circle [module]."""
    root: float
    """Radius of the root circle [module]."""
    tooth: tuple[Vertex, ...] = ()
    """Vertices (x, y, bulge), root to root, of one tooth symmetric about the x axis [module]; empty for pins."""
    pins: LanternPins | None = None
    """Pins of a lantern, or of a ring gear whose teeth are separate pins in seats; None for a wheel with teeth."""


class WheelRequirement(ABC):
    """Requirement of one pair on the teeth of one of its wheels. It is compared with the requirements of the wheel's
    other pairs before the wheel is cut.
    """

    @property
    @abstractmethod
    def tip(self) -> float:
        """Radius of the tip circle [module]."""

    @abstractmethod
    def agrees(self, other: WheelRequirement) -> bool:
        """Return True if one wheel can satisfy both requirements, or False if it cannot."""

    @abstractmethod
    def cut(self, others: Sequence[WheelRequirement] = ()) -> CutTooth:
        """Return a tooth that satisfies this requirement and `others`, or raise `GearTrainError` if none exists."""


@dataclass(frozen=True, slots=True)
class FixedTooth(CutTooth, WheelRequirement):
    """Tooth that the tooth form defines completely, independent of the mate."""

    def agrees(self, other: WheelRequirement) -> bool:
        """Return True if both teeth have the same kind and the same vertices."""
        if not isinstance(other, FixedTooth) or (self.kind, len(self.tooth)) != (other.kind, len(other.tooth)):
            return False
        pairs = (pair for both in zip(self.tooth, other.tooth, strict=True) for pair in zip(*both, strict=True))
        return all(abs(a - b) <= SAME_SIZE * max(abs(a), 1.0) for a, b in pairs)

    def cut(self, others: Sequence[WheelRequirement] = ()) -> CutTooth:
        """Return the tooth itself. All requirements in `others` must agree with this tooth."""
        del others
        return self


@dataclass(frozen=True)
class PairRequirement:
    """Teeth that a pair requires for one wheel, with the names of the pair and of its tooth form for messages."""

    pair: str
    form: str
    words: str
    requirement: WheelRequirement


def disagreement(requested: Sequence[PairRequirement]) -> Problem | None:
    """Return a problem if the pairs of a wheel require different teeth; None if the same teeth satisfy all pairs."""
    odd = (other for other in requested[1:] if not requested[0].requirement.agrees(other.requirement))
    return next((_conflict(requested[0], other) for other in odd), None)


def _conflict(first: PairRequirement, other: PairRequirement) -> Problem:
    tips = [each.requirement.tip for each in (first, other)]
    if first.words != other.words:
        how = f"{first.words} teeth and {other.words} teeth"
    elif abs(tips[0] - tips[1]) > SAME_SIZE * tips[0]:
        how = f"tips {tips[0]:.6g} and {tips[1]:.6g} modules from the axis"
    else:
        how = f"{first.words} flanks of two shapes"
    return Problem(
        f"pairs '{first.pair}' and '{other.pair}' require different teeth",
        f"they require {how}, but a wheel has one kind of teeth",
        "declare teeth that mesh with both wheels, or declare a separate wheel for each pair",
    )
