"""The two wheels of a gear pair as a train declares them, and the driving wheel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw


class DeclaredPair(Protocol):
    """Attributes of a declared gear pair that its mesh uses."""

    @property
    def name(self) -> str:
        """Name of the pair."""

    @property
    def pair(self) -> tuple[str, str]:
        """Names of the first and of the second wheel."""

    @property
    def fitting(self) -> Any:
        """Mounting accuracy of the pair; None if the accuracy declared for the train applies."""


class NamedForm(Protocol):
    """Attributes of a tooth form that the mesh of a pair uses."""

    @property
    def form(self) -> str:
        """Name of the tooth form."""

    @property
    def words(self) -> str:
        """Name of the tooth form as it is written in sentences."""

    @property
    def has_shape(self) -> bool:
        """True if the tooth form defines the shape of the teeth."""

    @property
    def has_lengths(self) -> bool:
        """True if the tooth form declares a length with a unit."""


@dataclass(frozen=True)
class MeshDriver(Result):
    """Driving wheel of a gear pair, or driving link of a coupling, and the reason why it drives."""

    KEYS = (Key("driver", "wheel"), Key("driver_is", "why"), Key("determined", "known"))

    wheel: str
    """Name of the driving wheel, or of the driving link of a coupling."""
    why: str
    """Text that states why this wheel is the driver."""
    known: bool = True
    """False if the direction of power flow is not determined. In that case `wheel` is an assumption."""


_CONTRATE = "the contrate wheel is treated as a spur wheel"


@dataclass(frozen=True)
class MeshingWheels:
    """Two wheels of a gear pair as a train declares them, for which a tooth form creates a mesh."""

    gear: DeclaredPair
    """Declared gear pair."""
    place: str
    """Location of the pair's declaration within its file."""
    counts: tuple[int, int]
    """Tooth counts of the first and of the second wheel."""
    kinds: tuple[str, str] = ("spur", "spur")
    """Kinds of the wheels, such as "spur", "helical", "bevel" or "contrate"."""
    internal: tuple[bool, bool] = (False, False)
    """True for each wheel that is a ring gear."""
    friction: float | None = None
    """Coefficient of friction; None if no friction is declared or if a friction law is declared."""
    distance: float | None = None
    """Mean over both wheels of transverse module times tooth count [m]; None if a module has no unit."""
    friction_law: FrictionLaw | None = None
    """Friction law that is declared instead of a coefficient; None if no friction law is declared."""
    pitch_line: float | None = None
    """Pitch-line speed [m/s], which a friction law requires; None if unknown."""
    helix: tuple[float, float] = (0.0, 0.0)
    """Helix angles of both wheels [rad]; positive for right-hand teeth."""
    width: float | None = None
    """Face width of the narrower wheel [m]; None if unknown."""

    @property
    def module(self) -> float | None:
        """Mean transverse module of both wheels [m]; None if no lengths are declared."""
        return None if self.distance is None or not sum(self.counts) else 2 * self.distance / sum(self.counts)

    @property
    def pitch_distance(self) -> float | None:
        """Centre distance at which the declared pitch circles touch [m]; None if no lengths are declared."""
        if self.distance is None or not any(self.internal):
            return self.distance
        # `distance` belongs to the sum of the tooth numbers, also for a ring
        z1, z2 = self.counts
        return self.distance * abs(z1 - z2) / (z1 + z2)

    @property
    def ring(self) -> Literal[0, 1, 2]:
        """Number of the wheel that is a ring gear, 1 or 2; 0 if there is no ring gear."""
        return 1 if self.internal[0] else 2 if self.internal[1] else 0

    @property
    def touching(self) -> float:
        """Centre distance at which the pitch circles touch [module]."""
        z1, z2 = self.counts
        return abs(z1 - z2) / 2 if any(self.internal) else (z1 + z2) / 2

    @property
    def driver(self) -> MeshDriver:
        """First wheel as the assumed driver, which is used until the driver is determined."""
        return MeshDriver(self.gear.pair[0], "", False)

    @property
    def note(self) -> str:
        """Note that a contrate wheel is treated as a spur wheel; empty if neither wheel is a contrate wheel."""
        return _CONTRATE if "contrate" in self.kinds else ""


@dataclass(frozen=True, slots=True)
class PairSize:
    """Lengths of a pair: the length unit of its tooth data, and the centre distance at which its wheels are placed."""

    scale: float
    """Length unit of the teeth, in modules."""
    distance: float
    """Centre distance [module]."""
    stretch: float
    """Centre distance divided by the centre distance at which the pitch circles touch."""
