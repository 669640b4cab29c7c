"""What a gear pair requires of the teeth of one of its wheels; one tooth that fits all pairs of the wheel."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.errors import Problem

if TYPE_CHECKING:
    from geartrain.teeth.outlines.tooth_outline import Vertex

SAME_SIZE = 1e-9  # of a length, or rad: what differs by less is one


@dataclass(frozen=True, slots=True)
class LanternPins:
    """Round pins that are the teeth of a wheel: which gear has them, the radius of their circle, their own; modules."""

    gear: int
    circle: float
    radius: float


@dataclass(frozen=True, slots=True)
class CutTooth:
    """The tooth of a wheel as it is cut, lengths in modules."""

    kind: str
    """External, ring or pins."""
    tip: float
    """Radii."""
    root: float
    """Radii."""
    tooth: tuple[Vertex, ...] = ()
    """About the x axis, from root to root; empty for pins."""
    pins: LanternPins | None = None
    """Of a lantern; of a ring whose teeth are pins, parts of their own, that lie in its inside."""


class WheelRequirement(ABC):
    """The teeth that one pair wants on one of its wheels."""

    @property
    @abstractmethod
    def tip(self) -> float:
        """Radius of the tips (modules)."""

    @abstractmethod
    def agrees(self, other: WheelRequirement) -> bool:
        """True if one wheel does for both."""

    @abstractmethod
    def cut(self, others: Sequence[WheelRequirement] = ()) -> CutTooth:
        """The tooth for this pair and for others that agree. Raises `GearTrainError` where there is none."""


@dataclass(frozen=True)
class FixedTooth(WheelRequirement):
    """A tooth that its form gives whole, whatever the mate does; vertices, kind and pins as in `CutTooth`, modules."""

    tip_radius: float
    root_radius: float
    tooth: tuple[Vertex, ...]
    kind: str = "external"
    pins: LanternPins | None = None

    @property
    def tip(self) -> float:
        """Radius of the tips (modules)."""
        return self.tip_radius

    def agrees(self, other: WheelRequirement) -> bool:
        """True if every vertex is the same."""
        if not isinstance(other, FixedTooth) or (self.kind, len(self.tooth)) != (other.kind, len(other.tooth)):
            return False
        pairs = (pair for both in zip(self.tooth, other.tooth, strict=True) for pair in zip(*both, strict=True))
        return all(abs(a - b) <= SAME_SIZE * max(abs(a), 1.0) for a, b in pairs)

    def cut(self, others: Sequence[WheelRequirement] = ()) -> CutTooth:
        """The tooth itself."""
        del others
        return CutTooth(self.kind, self.tip_radius, self.root_radius, self.tooth, self.pins)


@dataclass(frozen=True)
class PairRequirement:
    """What a pair requires of a wheel: its name, the form of its teeth and that form in words, and the teeth."""

    pair: str
    form: str
    words: str
    requirement: WheelRequirement


def disagreement(requested: Sequence[PairRequirement]) -> Problem | None:
    """Why one wheel does not do for all its pairs; None where it does."""
    odd = (other for other in requested[1:] if not requested[0].requirement.agrees(other.requirement))
    return next((_at_odds(requested[0], other) for other in odd), None)


def _at_odds(first: PairRequirement, other: PairRequirement) -> Problem:
    tips = [each.requirement.tip for each in (first, other)]
    if first.words != other.words:
        how = f"{first.words} teeth and {other.words} teeth"
    elif abs(tips[0] - tips[1]) > SAME_SIZE * tips[0]:
        how = f"tips {tips[0]:.6g} and {tips[1]:.6g} modules from the axis"
    else:
        how = f"{first.words} flanks of two shapes"
    return Problem(
        f"its pairs '{first.pair}' and '{other.pair}' ask for different teeth",
        f"they want {how}, and a wheel is cut once",
        "declare teeth that run with both mates, or give each of them a wheel of its own",
    )
