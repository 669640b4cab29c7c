"""Friction that depends on speed: laws that may replace a coefficient, and a pair under one.

The measured values are those that W. D. Smith prints in "Optimal shapes for gears" (1993): Buckingham's for lubricated
cast iron, Dokos's for dry steel. Smith gives their ends, not their tables; how values between them are found is said at
each law.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import log, sqrt
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure, Quantity, Velocity
from geartrain.numerics.results import Shown
from geartrain.numerics.roots import root

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

FOOT_A_MINUTE = 0.3048 / 60
"""m/s."""
BUCKINGHAM = ((0.0, 0.0517), (150.0, 0.0112), (2100.0, 0.0385))
"""Pitch-line speed (ft/min) and coefficient of lubricated cast-iron spur gears: Buckingham, p. 404, as Smith cites."""
DOKOS = (0.53, 0.18, 1e7)
"""Coefficient of dry steel on dry steel, slowest and fastest, and the factor between the speeds: Dokos, likewise."""
SLOWEST_OF_DOKOS = Quantity.parse("0.0001 in/s", "velocity", False)


def stribeck(v: Floats, static: float, kinetic: float, speed: float, exponent: float, viscous: float) -> Floats:
    """mu = kinetic + (static - kinetic) exp(-(v/speed)^exponent) + viscous v, docs/shapes.md (16).

    Stribeck's fall from rest to full sliding with the viscous rise after it; v, speed in m/s, viscous in s/m.
    """
    import numpy as np

    found: Floats = kinetic + (static - kinetic) * np.exp(-((v / speed) ** exponent)) + viscous * v
    return found


def buckingham(V: Floats) -> Floats:
    """mu = c2 exp(-c1 sqrt V) + c3 sqrt V at the pitch-line speed V (m/s), docs/shapes.md (17)."""
    import numpy as np

    c1, c2, c3 = buckingham_constants()
    root_of = np.sqrt(np.asarray(V) / FOOT_A_MINUTE)
    found: Floats = c2 * np.exp(-c1 * root_of) + c3 * root_of
    return found


@cache
def buckingham_constants() -> tuple[float, float, float]:
    """c1, c2, c3, V in ft/min, at which the law has the three printed values: c2 is that of the stationary pair.

    With a = exp(-c1 sqrt V1) of the slower pair and q = sqrt(V2/V1), the two others give
    c2 a^q + q (mu1 - c2 a) = mu2 for a.
    """
    (_, rest), (slow, low), (fast, high) = BUCKINGHAM
    q = sqrt(fast / slow)

    def off(a: float) -> float:
        return float(rest * a**q + q * (low - rest * a) - high)

    most = low / rest
    a = root(off, 0.0, most, off(0.0), off(most))
    return -log(a) / sqrt(slow), rest, (low - rest * a) / sqrt(slow)


def dokos(v: Floats, slowest: float) -> Floats:
    """mu falls from 0.53 at `slowest` to 0.18 at 10^7 times that speed, evenly in log v, docs/shapes.md (18).

    Level beyond both. Smith prints no more than both ends and the factor ("gradually"), and no speed.
    """
    import numpy as np

    first, last, factor = DOKOS
    with np.errstate(divide="ignore"):
        decades = np.log(np.asarray(v) / slowest) / log(factor)
    found: Floats = first + (last - first) * np.clip(decades, 0.0, 1.0)
    return found


def _bad(what: str, fix: str) -> PydanticCustomError:
    return PydanticCustomError("friction", "{what}", {"what": what, "fix": fix})


def _positive(value: Any) -> Any:
    if value.value <= 0:
        raise _bad(f"{value.text} is not above 0", "give a number above 0")
    return value


def _not_negative(value: Any) -> Any:
    if value.value < 0:
        raise _bad(f"{value.text} is below 0", "give 0 or more")
    return value


Coefficient = Annotated[Figure, AfterValidator(_not_negative)]
PositiveFigure = Annotated[Figure, AfterValidator(_positive)]
PositiveVelocity = Annotated[Velocity, AfterValidator(_positive)]
Speeds = Literal["sliding", "pitch_line"]


class FrictionLaw(BaseModel, ABC):
    """Friction between teeth as a function of a speed: of sliding, at each contact, or of the pitch line.

    See Also
    --------
    geartrain.teeth.StribeckFriction, geartrain.teeth.BuckinghamFriction : two of them.
    geartrain.teeth.PairFriction : a pair that runs under one.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    if TYPE_CHECKING:
        law: str

    @abstractmethod
    def coefficient(self, speed: Floats) -> Floats:
        """The coefficient of friction.

        Parameters
        ----------
        speed : ndarray
            Speeds of 0 or more [m/s].
        """

    @property
    def of_pitch_line(self) -> bool:
        """True if the speed is that of the pitch line, so that the coefficient is the same at every contact."""
        return False

    @property
    def at_rest(self) -> float:
        """The coefficient at speed 0: what a start has to overcome."""
        import numpy as np

        return float(self.coefficient(np.zeros(1))[0])


class StribeckFriction(FrictionLaw):
    """Friction that falls from rest to full sliding, and may rise again with the speed.

    Examples
    --------
    >>> law = StribeckFriction(law="stribeck", static="0.2", kinetic="0.08", speed="10 mm/s")
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.01, 1.0)]
    [0.2, 0.1241, 0.08]
    """

    law: Literal["stribeck"] = Field(description="Falls from rest to full sliding: Stribeck")
    static: Coefficient = Field(description="Coefficient at rest")
    kinetic: Coefficient = Field(description="Coefficient that it falls to")
    speed: PositiveVelocity = Field(description="Speed of sliding at which 1/e of the fall is left")
    exponent: PositiveFigure = Field(Figure.parse("2"), description="Of the speed, 2 by default; 1/2 to 2 are usual")
    viscous: Coefficient = Field(Figure.parse("0"), description="What a speed of 1 m/s adds")

    def coefficient(self, speed: Floats) -> Floats:
        """`stribeck`."""
        exponent, viscous = float(self.exponent.value), float(self.viscous.value)
        return stribeck(speed, float(self.static.value), float(self.kinetic.value), self.speed.si, exponent, viscous)


class BuckinghamFriction(FrictionLaw):
    """Lubricated cast-iron spur gears, by the speed of the pitch line.

    Examples
    --------
    >>> law = BuckinghamFriction(law="buckingham")
    >>> [round(float(law.coefficient(feet * 0.3048 / 60)), 4) for feet in (0, 150, 2100)]
    [0.0517, 0.0112, 0.0385]
    """

    law: Literal["buckingham"] = Field(description="Lubricated cast iron, by pitch-line speed: Buckingham")

    @property
    def of_pitch_line(self) -> bool:
        """True: it was measured so."""
        return True

    def coefficient(self, speed: Floats) -> Floats:
        """`buckingham`."""
        return buckingham(speed)


class DokosFriction(FrictionLaw):
    """Dry steel on dry steel.

    Examples
    --------
    >>> law = DokosFriction(law="dokos", slowest="2 mm/s")
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.02, 1e5)]
    [0.53, 0.48, 0.18]
    """

    law: Literal["dokos"] = Field(description="Dry steel on dry steel, by speed of sliding: Dokos")
    slowest: PositiveVelocity = Field(
        SLOWEST_OF_DOKOS,
        description="Speed at which the coefficient is 0.53; default 0.0001 in/s, which is no source's",
    )

    def coefficient(self, speed: Floats) -> Floats:
        """`dokos`."""
        return dokos(speed, self.slowest.si)


class TabulatedFriction(FrictionLaw):
    """Coefficients at some speeds, straight lines between them.

    Examples
    --------
    >>> law = TabulatedFriction(law="table", speeds=["0 m/s", "1 m/s"], coefficients=["0.2", "0.1"])
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.25, 3.0)]
    [0.2, 0.175, 0.1]
    """

    law: Literal["table"] = Field(description="Coefficients at speeds of your own")
    speeds: tuple[Velocity, ...] = Field(description="Speeds, each above the last; level before the first and beyond")
    coefficients: tuple[Coefficient, ...] = Field(description="The coefficient at each")
    of: Speeds = Field("sliding", description="Of which speed: sliding, at each contact, or pitch_line")

    @model_validator(mode="after")
    def _is_a_table(self) -> TabulatedFriction:
        speeds = [speed.base for speed in self.speeds]
        if len(speeds) != len(self.coefficients) or len(speeds) < 2:
            raise _bad("speeds and coefficients are no two columns", "give as many of both, two at least")
        if speeds[0] < 0 or any(low >= high for low, high in pairwise(speeds)):
            raise _bad("these speeds do not rise from 0 or more", "write them in rising order")
        return self

    @property
    def of_pitch_line(self) -> bool:
        """As declared."""
        return self.of == "pitch_line"

    def coefficient(self, speed: Floats) -> Floats:
        """By linear interpolation."""
        import numpy as np

        found: Floats = np.interp(
            speed, [each.si for each in self.speeds], [float(each.value) for each in self.coefficients]
        )
        return found


AnyFrictionLaw = Annotated[
    StribeckFriction | BuckinghamFriction | DokosFriction | TabulatedFriction, Field(discriminator="law")
]
"""What a declaration may say of friction besides a number."""


@cache
def law_keys() -> frozenset[str]:
    """Every key that some law has."""
    laws = (StribeckFriction, BuckinghamFriction, DokosFriction, TabulatedFriction)
    return frozenset(key for law in laws for key in law.model_fields)


_NAME = re.compile(r"[a-z_]+")


def law_of_text(raw: object) -> object:
    """A law as an option gives it, `stribeck,static=0.2,kinetic=0.08,speed=10 mm/s`, as a declaration would.

    Columns of a table have colons between their values; whatever else it is given stays what it is.
    """
    parts = raw.split(",") if isinstance(raw, str) else raw
    if not isinstance(parts, list) or not parts or not _NAME.fullmatch(str(parts[0]).strip()):
        return raw
    found: dict[str, object] = {"law": str(parts[0]).strip()}
    for part in parts[1:]:
        name, _, value = str(part).partition("=")
        found[name.strip()] = [each.strip() for each in value.split(":")] if ":" in value else value.strip()
    return found


FrictionLawOfText = Annotated[AnyFrictionLaw, BeforeValidator(law_of_text)]
"""The same, as an option may give it too."""


@dataclass(frozen=True, slots=True)
class PairFriction(Shown):
    """A law of friction in a pair whose pitch line runs at some speed: the coefficient, by the speed of sliding.

    Examples
    --------
    Teeth that slide at a fifth of the pitch line's 50 mm/s:

    >>> from geartrain.teeth import StribeckFriction
    >>> law = StribeckFriction(law="stribeck", static="0.2", kinetic="0.08", speed="10 mm/s")
    >>> round(float(PairFriction(law, 0.05)(0.2)), 4)
    0.1241
    """

    law: FrictionLaw
    """The law."""
    pitch_line: float | Floats
    """Speed of the pitch line, one or one for each position [m/s]."""

    def __call__(self, sliding: ArrayLike) -> Floats:
        """The coefficient where teeth slide at these speeds, over that of the pitch line."""
        import numpy as np

        speed = np.asarray(sliding, dtype=float) * self.pitch_line
        if self.law.of_pitch_line:
            speed = np.where(np.isnan(speed), np.nan, self.pitch_line)
        return self.law.coefficient(speed)
