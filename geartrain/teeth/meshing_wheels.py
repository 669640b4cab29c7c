"""The two wheels of a gear pair as a train declares them, and the one that drives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw


class DeclaredPair(Protocol):
    """Attributes of a declared gear pair that a mesh uses."""

    @property
    def name(self) -> str:
        """Name of the pair."""

    @property
    def pair(self) -> tuple[str, str]:
        """Names of the two wheels."""

    @property
    def fitting(self) -> Any:
        """Mounting accuracy of the pair; None if the train's applies."""


class NamedForm(Protocol):
    """Attributes of a tooth form that its mesh uses."""

    @property
    def form(self) -> str:
        """Name of the form."""

    @property
    def words(self) -> str:
        """Name of the form in prose."""

    @property
    def has_lengths(self) -> bool:
        """True for teeth declared in units of length."""


@dataclass(frozen=True)
class MeshDriver(Result):
    """Driving wheel of a gear pair (driving link of a coupling), and the basis on which it is known."""

    KEYS = (Key("driver", "wheel"), Key("driver_is", "why"), Key("determined", "known"))

    wheel: str
    """Name of the driving wheel; of a coupling, the driving link."""
    why: str
    """Basis on which the driver is known."""
    known: bool = True
    """False if the direction of power flow is not determined. `wheel` is then only an assumption."""


_CONTRATE = "the contrate wheel is treated as a spur wheel"


@dataclass(frozen=True)
class MeshingWheels:
    """The two wheels of a gear pair as a train declares them: the input from which a tooth form makes a mesh."""

    gear: DeclaredPair
    place: str
    """Place of the pair's declaration in its file."""
    counts: tuple[int, int]
    """Tooth numbers."""
    kinds: tuple[str, str] = ("spur", "spur")
    """Kinds of the wheels, such as "spur", "helical", "bevel" or "contrate"."""
    internal: tuple[bool, bool] = (False, False)
    """True for each wheel that is a ring."""
    friction: float | None = None
    """Coefficient of friction; None if none is declared."""
    distance: float | None = None
    """Sum of transverse module times teeth of both wheels, halved [m]; None unless both declare a module with a unit.
    """
    friction_law: FrictionLaw | None = None
    """Friction law declared instead of a coefficient; `friction` is then None."""
    pitch_line: float | None = None
    """Pitch-line speed [m/s], which a friction law needs; None if it is not known."""
    helix: tuple[float, float] = (0.0, 0.0)
    """Helix angles [rad], positive for right-hand teeth."""
    width: float | None = None
    """Face width of the narrower wheel [m]; None if it is not known."""

    @property
    def module(self) -> float | None:
        """Mean transverse module [m]; None without a declared length."""
        return None if self.distance is None or not sum(self.counts) else 2 * self.distance / sum(self.counts)

    @property
    def pitch_distance(self) -> float | None:
        """Centre distance [m] at which the declared pitch circles touch; None without a declared length."""
        z1, z2 = self.counts
        return (
            self.distance
            if self.distance is None or not any(self.internal)
            else self.distance * abs(z1 - z2) / (z1 + z2)
        )

    @property
    def ring(self) -> Literal[0, 1, 2]:
        """Number of the wheel that is a ring, 1 or 2; 0 if neither is."""
        return 1 if self.internal[0] else 2 if self.internal[1] else 0

    @property
    def touching(self) -> float:
        """Centre distance [module] at which the pitch circles touch."""
        z1, z2 = self.counts
        return abs(z1 - z2) / 2 if any(self.internal) else (z1 + z2) / 2

    @property
    def driver(self) -> MeshDriver:
        """First wheel as the assumed driver, until the driver is known."""
        return MeshDriver(self.gear.pair[0], "", False)

    @property
    def note(self) -> str:
        """Note on a wheel that is treated as another kind; empty otherwise."""
        return _CONTRATE if "contrate" in self.kinds else ""


@dataclass(frozen=True, slots=True)
class PairSize:
    """Size of a pair with real teeth."""

    scale: float
    """Modules in one length unit of the teeth."""
    distance: float
    """Centre distance [module]."""
    stretch: float
    """Centre distance over the one at which the pitch circles touch."""
