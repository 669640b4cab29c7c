"""The two wheels of a gear pair as a train declares them, and the driving wheel."""

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
        """Mounting accuracy of the pair; None if the accuracy declared for the train applies."""


class NamedForm(Protocol):
    """Attributes of a tooth form that its mesh uses."""

    @property
    def form(self) -> str:
        """Name of the form."""

    @property
    def words(self) -> str:
        """Name of the form as it appears in sentences."""

    @property
    def has_shape(self) -> bool:
        """True if the form defines the shape of the teeth."""

    @property
    def has_lengths(self) -> bool:
        """True if the form declares a length with a unit."""


@dataclass(frozen=True)
class MeshDriver(Result):
    """Driving wheel of a gear pair, or driving link of a coupling, and the reason for this choice."""

    KEYS = (Key("driver", "wheel"), Key("driver_is", "why"), Key("determined", "known"))

    wheel: str
    """Name of the driving wheel, or of the driving link of a coupling."""
    why: str
    """Reason why this wheel is the driver, in words."""
    known: bool = True
    """False if the direction of power flow is not determined; `wheel` is then an assumption."""


_CONTRATE = "the contrate wheel is treated as a spur wheel"


@dataclass(frozen=True)
class MeshingWheels:
    """Two wheels of a gear pair as a train declares them, from which a tooth form makes a mesh."""

    gear: DeclaredPair
    """Declared gear pair."""
    place: str
    """Location of the pair's declaration in its file."""
    counts: tuple[int, int]
    """Tooth numbers of the first and of the second wheel."""
    kinds: tuple[str, str] = ("spur", "spur")
    """Kinds of the wheels, such as "spur", "helical", "bevel" or "contrate"."""
    internal: tuple[bool, bool] = (False, False)
    """True for each wheel that is a ring."""
    friction: float | None = None
    """Coefficient of friction; None if no friction or a friction law is declared."""
    distance: float | None = None
    """Half the sum, over both wheels, of transverse module times tooth number [m]; None if a module has no unit."""
    friction_law: FrictionLaw | None = None
    """Friction law declared instead of a coefficient; `friction` is then None."""
    pitch_line: float | None = None
    """Pitch-line speed, which a friction law needs [m/s]; None if unknown."""
    helix: tuple[float, float] = (0.0, 0.0)
    """Helix angles [rad], positive for right-hand teeth."""
    width: float | None = None
    """Face width of the narrower wheel [m]; None if unknown."""

    @property
    def module(self) -> float | None:
        """Mean transverse module of both wheels [m]; None if no lengths are declared."""
        return None if self.distance is None or not sum(self.counts) else 2 * self.distance / sum(self.counts)

    @property
    def pitch_distance(self) -> float | None:
        """Centre distance at which the declared pitch circles touch [m]; None if no lengths are declared."""
        z1, z2 = self.counts
        # `distance` belongs to the sum of the tooth numbers, also for a ring
        return (
            self.distance
            if self.distance is None or not any(self.internal)
            else self.distance * abs(z1 - z2) / (z1 + z2)
        )

    @property
    def ring(self) -> Literal[0, 1, 2]:
        """Number of the wheel that is a ring, 1 or 2; 0 if there is none."""
        return 1 if self.internal[0] else 2 if self.internal[1] else 0

    @property
    def touching(self) -> float:
        """Centre distance at which the pitch circles touch [module]."""
        z1, z2 = self.counts
        return abs(z1 - z2) / 2 if any(self.internal) else (z1 + z2) / 2

    @property
    def driver(self) -> MeshDriver:
        """First wheel as the assumed driver, used until the driver is determined."""
        return MeshDriver(self.gear.pair[0], "", False)

    @property
    def note(self) -> str:
        """Note on a contrate wheel, which is treated as a spur wheel; empty if neither wheel is a contrate wheel."""
        return _CONTRATE if "contrate" in self.kinds else ""


@dataclass(frozen=True, slots=True)
class PairSize:
    """Size of a pair with real teeth: scale of its lengths and centre distance, from which layouts place its wheels."""

    scale: float
    """Number of modules in one length unit of the teeth."""
    distance: float
    """Centre distance [module]."""
    stretch: float
    """Centre distance divided by the distance at which the pitch circles touch."""
