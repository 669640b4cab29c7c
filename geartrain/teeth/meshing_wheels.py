"""The two wheels of a gear pair as a train declares them, and which of them drives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw


class DeclaredPair(Protocol):
    """What a mesh reads of the gear pair that declares it."""

    @property
    def name(self) -> str:
        """As others refer to it."""

    @property
    def pair(self) -> tuple[str, str]:
        """The two wheels."""

    @property
    def fitting(self) -> Any:
        """How exactly it is mounted; None: as the train says."""


class NamedForm(Protocol):
    """What a mesh reads of the tooth form that made it."""

    @property
    def form(self) -> str:
        """Its name."""

    @property
    def words(self) -> str:
        """Its name as prose has it."""

    @property
    def has_lengths(self) -> bool:
        """True for teeth declared in units of length."""


@dataclass(frozen=True)
class MeshDriver(Result):
    """The wheel that drives a gear pair (of a coupling, the link), and how that is known."""

    KEYS = (Key("driver", "wheel"), Key("driver_is", "why"), Key("determined", "known"))

    wheel: str
    """The driving wheel; of a coupling, the driving link."""
    why: str
    """How it is known."""
    known: bool = True
    """False where the way of power is not determined: `wheel` is then taken to go on with, and no more."""


_CONTRATE = "the contrate is taken for a spur wheel"


@dataclass(frozen=True)
class MeshingWheels:
    """The two wheels of a gear pair as a train declares them: what a tooth form makes a mesh of."""

    gear: DeclaredPair
    place: str
    """Where the pair is declared."""
    counts: tuple[int, int]
    """Tooth numbers; `kinds` of the wheels, helical ones apart, and which of them are rings."""
    kinds: tuple[str, str] = ("spur", "spur")
    internal: tuple[bool, bool] = (False, False)
    friction: float | None = None
    """None where none is declared."""
    distance: float | None = None
    """Half the transverse modules times the teeth, summed (m); None unless both wheels declare a module with a unit."""
    friction_law: FrictionLaw | None = None
    """In place of a coefficient; then `friction` is None."""
    pitch_line: float | None = None
    """Speed of the pitch line (m/s), which a law of friction needs; None where it is not known."""
    helix: tuple[float, float] = (0.0, 0.0)
    """Helix angles (rad), of right hands above 0."""
    width: float | None = None
    """Of the narrower wheel (m); None where it is not known."""

    @property
    def module(self) -> float | None:
        """Mean transverse module (m); None without a declared length."""
        return None if self.distance is None or not sum(self.counts) else 2 * self.distance / sum(self.counts)

    @property
    def pitch_distance(self) -> float | None:
        """Distance (m) at which pitch circles of the declared modules touch; None without a declared length."""
        z1, z2 = self.counts
        return (
            self.distance
            if self.distance is None or not any(self.internal)
            else self.distance * abs(z1 - z2) / (z1 + z2)
        )

    @property
    def ring(self) -> Literal[0, 1, 2]:
        """Which wheel is a ring: 1 or 2, 0 if none is."""
        return 1 if self.internal[0] else 2 if self.internal[1] else 0

    @property
    def touching(self) -> float:
        """The distance (modules) at which pitch circles touch."""
        z1, z2 = self.counts
        return abs(z1 - z2) / 2 if any(self.internal) else (z1 + z2) / 2

    @property
    def driver(self) -> MeshDriver:
        """The first wheel, until the driver is known."""
        return MeshDriver(self.gear.pair[0], "", False)

    @property
    def note(self) -> str:
        """What the wheels are taken for, where it is not what they are; empty where it is."""
        return _CONTRATE if "contrate" in self.kinds else ""


@dataclass(frozen=True, slots=True)
class PairSize:
    """Of a pair with real teeth."""

    scale: float
    """Modules in one unit of its law's lengths."""
    distance: float
    """Of its axes, in modules."""
    stretch: float
    """That distance over the one at which pitch circles touch."""
