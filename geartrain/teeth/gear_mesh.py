"""What a train needs of a gear pair with real teeth, whatever their form."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, Self

from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from geartrain.errors import Problem
    from geartrain.teeth.transmission import TransmissionFunction


class DeclaredPair(Protocol):
    """What a mesh reads of the gear pair that declares it."""

    @property
    def name(self) -> str:
        """As others refer to it."""

    @property
    def pair(self) -> tuple[str, str]:
        """The two wheels."""

    @property
    def tooth_form(self) -> Any:
        """The form of its own; None: the train's."""

    @property
    def fitting(self) -> Any:
        """How exactly it is mounted; None: as the train says."""


class PairVerdict(Protocol):
    """Whether a pair of wheels can turn; true if it can.

    kind   "runs", or one word for why it does not
    text   the same in words
    play   play of the teeth (rad of the driven wheel)
    """

    @property
    def kind(self) -> str:
        """One word."""

    @property
    def text(self) -> str:
        """In words."""

    @property
    def play(self) -> float:
        """Play (rad of the driven wheel)."""

    def __bool__(self) -> bool: ...


@dataclass(frozen=True)
class MeshDriver:
    """The wheel that drives a gear pair (of a coupling, the link), and how that is known.

    known   False where the way of power is not determined: `wheel` is then taken to go on with, and no more
    """

    wheel: str
    why: str
    known: bool = True

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"driver": self.wheel, "driver_is": self.why, "determined": self.known}


@dataclass(frozen=True)
class GearMesh(ABC):
    """A gear pair with real teeth, and friction if it is declared.

    form   name of the tooth form
    who    the wheel that drives, and how that is known
    law    with that wheel driving, forwards
    note   what the form takes the wheels for, where it is not what they are
    """

    gear: DeclaredPair
    form: str
    who: MeshDriver
    place: str
    law: TransmissionFunction
    friction: float | None = None
    note: str = ""

    @property
    def name(self) -> str:
        """The name of the pair."""
        return self.gear.name

    @property
    def driver(self) -> str:
        """The wheel that drives, or is taken to where that is not determined."""
        return self.who.wheel

    @property
    def driven(self) -> str:
        """The other wheel."""
        first, second = self.gear.pair
        return second if self.driver == first else first

    @property
    @abstractmethod
    def reversed(self) -> TransmissionFunction:
        """The law with the other wheel driving."""

    @property
    @abstractmethod
    def verdict(self) -> PairVerdict:
        """Whether these teeth can turn."""

    @abstractmethod
    def _faults(self) -> Iterator[Problem]:
        """Everything that is wrong with these teeth, without pair and place."""

    @property
    def label(self) -> str:
        """The pair as a fault names it."""
        return f"pair '{self.name}'"

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """Everything that keeps these teeth from turning, with what would let them; empty if they turn."""
        return tuple(replace(each, what=f"{self.label}: {each.what}", place=self.place) for each in self._faults())

    @property
    def fault(self) -> Problem | None:
        """The first of them."""
        return self.faults[0] if self.faults else None

    @property
    def play(self) -> float:
        """Play of the teeth, in pitches."""
        return self.verdict.play / (self.law.period * float(self.law.ratio))

    @property
    def stands(self) -> float:
        """Where a tooth of the driven wheel stands when its angle is 0, in pitches past the line of centres."""
        return 0.0

    @property
    def rigid(self) -> bool:
        """True if the pair keeps its ratio at every instant: it adds nothing to any motion but its play."""
        return isinstance(self.law, ExactRatio)

    @property
    def rubs(self) -> bool:
        """True if something is lost between these teeth."""
        return bool(self.friction)

    def driven_by(self, driver: MeshDriver) -> Self:
        """The same teeth with this wheel driving."""
        law = self.law if driver.wheel == self.driver else self.reversed
        return replace(self, who=driver, law=law)

    @property
    def ways(self) -> tuple[Self, ...]:
        """The mesh as it is driven; where that is not determined, both ways."""
        return (self,) if self.who.known else (self, self.driven_by(replace(self.who, wheel=self.driven)))


def find_faults(ways: Sequence[GearMesh]) -> tuple[Problem, ...]:
    """Everything wrong with one pair in the ways it is driven; what is wrong in some ways only says in which."""
    said = [list(way._faults()) for way in ways]
    found: list[Problem] = []
    for way, faults in zip(ways, said, strict=True):
        for fault in faults:
            always = all(fault in other for other in said)
            label = way.label if always else f"{way.label}, '{way.driver}' driving"
            placed = replace(fault, what=f"{label}: {fault.what}", place=way.place)
            found += [] if placed in found else [placed]
    return tuple(found)
