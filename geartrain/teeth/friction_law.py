"""Friction that depends on speed: friction laws that can replace a coefficient, and the friction of a pair
under such a law.

The measured values are taken from W. D. Smith, "Optimal shapes for gears" (1993): Buckingham's values for lubricated
cast iron, and Dokos's values for dry steel. Smith prints their end values but not their tables. The docstring of each
law describes the interpolation between these values.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import log, sqrt
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from geartrain.numerics.quantity import Figure, Quantity, Velocity, above_zero, bad, checked
from geartrain.numerics.results import Shown
from geartrain.numerics.roots import root

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

FOOT_A_MINUTE = 0.3048 / 60
"""Speed of one foot per minute, in m/s."""
BUCKINGHAM = ((0.0, 0.0517), (150.0, 0.0112), (2100.0, 0.0385))
"""Pairs of pitch-line speed [ft/min] and friction coefficient of lubricated cast iron (Buckingham, p. 404)."""
DOKOS = (0.53, 0.18, 1e7)
"""Friction coefficients of dry steel at the lowest and the highest speed, and the ratio of these speeds (Dokos)."""
SLOWEST_OF_DOKOS = Quantity.parse("0.0001 in/s", "velocity", False)


@cache
def buckingham_constants() -> tuple[float, float, float]:
    """Return the constants c1, c2 and c3 of `BuckinghamFriction` (for speeds in ft/min) that reproduce the three
    printed coefficients.

    c2 is the coefficient at rest. With a = exp(-c1 sqrt V1) and q = sqrt(V2/V1), the coefficients mu1 and mu2 at
    the speeds V1 < V2 give the equation c2 a^q + q (mu1 - c2 a) = mu2, which is solved for a.
    """
    (_, rest), (slow, low), (fast, high) = BUCKINGHAM
    q = sqrt(fast / slow)

    def off(a: float) -> float:
        return float(rest * a**q + q * (low - rest * a) - high)

    most = low / rest  # above it c3 would be negative
    a = root(off, 0.0, most, off(0.0), off(most))
    return -log(a) / sqrt(slow), rest, (low - rest * a) / sqrt(slow)


_POSITIVE = above_zero("give a number above 0")
Coefficient = Annotated[
    Figure, checked(lambda given: given.value >= 0, "a value of {text} is below 0", "give 0 or more")
]
PositiveFigure = Annotated[Figure, _POSITIVE]
PositiveVelocity = Annotated[Velocity, _POSITIVE]
Speeds = Literal["sliding", "pitch_line"]


class FrictionLaw(BaseModel, ABC):
    """Friction law: coefficient of friction of teeth as a function of the sliding speed at each contact or of the
    pitch-line speed.

    See Also
    --------
    geartrain.teeth.StribeckFriction, geartrain.teeth.BuckinghamFriction : two friction laws.
    geartrain.teeth.PairFriction : a friction law applied to a pair.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    if TYPE_CHECKING:
        law: str

    @abstractmethod
    def coefficient(self, speed: Floats) -> Floats:
        """Return the coefficient of friction at given speeds.

        Parameters
        ----------
        speed : ndarray
            Sliding speeds or pitch-line speeds, 0 or more [m/s].
        """

    @property
    def of_pitch_line(self) -> bool:
        """True if the coefficient depends on the pitch-line speed. The coefficient is then equal at all contacts."""
        return False

    @property
    def at_rest(self) -> float:
        """Coefficient of friction at speed 0, which applies when the train starts."""
        import numpy as np

        return float(self.coefficient(np.zeros(1))[0])


class StribeckFriction(FrictionLaw):
    """Friction that decreases from static to kinetic with the sliding speed, and may increase again because of a
    viscous term.

    Examples
    --------
    >>> law = StribeckFriction(law="stribeck", static="0.2", kinetic="0.08", speed="10 mm/s")
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.01, 1.0)]
    [0.2, 0.1241, 0.08]
    """

    law: Literal["stribeck"] = Field(
        description="Stribeck friction law: the coefficient falls from `static` to "
        "`kinetic` as the sliding speed increases"
    )
    static: Coefficient = Field(description="Coefficient of static friction, at speed 0")
    kinetic: Coefficient = Field(
        description="Coefficient of kinetic friction, the limit at high speed without `viscous`"
    )
    speed: PositiveVelocity = Field(
        description="Sliding speed at which 1/e of the difference between `static` and `kinetic` remains"
    )
    exponent: PositiveFigure = Field(Figure.parse("2"), description="Exponent of the speed, usually 1/2 to 2")
    viscous: Coefficient = Field(Figure.parse("0"), description="Increase of the coefficient per m/s of sliding speed")

    def coefficient(self, speed: Floats) -> Floats:
        """Return the coefficient of friction at sliding speeds v [m/s], docs/shapes.md (16).

        mu = kinetic + (static - kinetic) exp(-(v/speed)^exponent) + viscous v, where viscous is in s/m.
        """
        import numpy as np

        static, kinetic, exponent, viscous = (
            float(each.value) for each in (self.static, self.kinetic, self.exponent, self.viscous)
        )
        fallen: Floats = np.exp(-((speed / self.speed.si) ** exponent))
        return kinetic + (static - kinetic) * fallen + viscous * speed


class BuckinghamFriction(FrictionLaw):
    """Friction of lubricated cast-iron spur gears as a function of the pitch-line speed.

    Examples
    --------
    >>> law = BuckinghamFriction(law="buckingham")
    >>> [round(float(law.coefficient(feet * 0.3048 / 60)), 4) for feet in (0, 150, 2100)]
    [0.0517, 0.0112, 0.0385]
    """

    law: Literal["buckingham"] = Field(description="Buckingham's law of lubricated cast iron, for the pitch-line speed")

    @property
    def of_pitch_line(self) -> bool:
        """Always True: this friction law was measured as a function of the pitch-line speed."""
        return True

    def coefficient(self, speed: Floats) -> Floats:
        """Return the coefficient of friction at pitch-line speeds [m/s], by equation (17) of docs/shapes.md.

        It is c2 exp(-c1 sqrt v) + c3 sqrt v, with v the speed in ft/min and the constants of `buckingham_constants`.
        """
        import numpy as np

        c1, c2, c3 = buckingham_constants()
        root_of = np.sqrt(np.asarray(speed) / FOOT_A_MINUTE)
        found: Floats = c2 * np.exp(-c1 * root_of) + c3 * root_of
        return found


class DokosFriction(FrictionLaw):
    """Friction of dry steel on dry steel as a function of the sliding speed.

    The coefficient falls from 0.53 at `slowest` to 0.18 at 10^7 times that speed, and is constant below and above these
    speeds. Smith gives only the two end values and the ratio of the speeds, and states that the coefficient falls
    "gradually". Linear interpolation in log v and the value of `slowest` are assumptions.

    Examples
    --------
    >>> law = DokosFriction(law="dokos", slowest="2 mm/s")
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.02, 1e5)]
    [0.53, 0.48, 0.18]
    """

    law: Literal["dokos"] = Field(description="Dokos's law of dry steel on dry steel, for the sliding speed")
    slowest: PositiveVelocity = Field(
        SLOWEST_OF_DOKOS,
        description="Sliding speed up to which the coefficient is 0.53; assumed, since the source gives no speed",
    )

    def coefficient(self, speed: Floats) -> Floats:
        """Return the coefficient of friction at sliding speeds `speed` [m/s]."""
        import numpy as np

        first, last, factor = DOKOS
        # the logarithm is -inf at rest, which the clip below maps to the first coefficient
        with np.errstate(divide="ignore"):
            decades = np.log(np.asarray(speed) / self.slowest.si) / log(factor)
        found: Floats = first + (last - first) * np.clip(decades, 0.0, 1.0)
        return found


class TabulatedFriction(FrictionLaw):
    """Coefficient of friction, interpolated linearly in a table of speeds.

    Examples
    --------
    >>> law = TabulatedFriction(law="table", speeds=["0 m/s", "1 m/s"], coefficients=["0.2", "0.1"])
    >>> [round(float(law.coefficient(speed)), 4) for speed in (0.0, 0.25, 3.0)]
    [0.2, 0.175, 0.1]
    """

    law: Literal["table"] = Field(description="Table of coefficients at given speeds, interpolated linearly")
    speeds: tuple[Velocity, ...] = Field(
        description="Speeds in ascending order; the coefficient is constant outside their range"
    )
    coefficients: tuple[Coefficient, ...] = Field(description="Coefficient of friction at each speed")
    of: Speeds = Field("sliding", description="Kind of speed in the table: sliding (at each contact) or pitch_line")

    @model_validator(mode="after")
    def _check_table(self) -> TabulatedFriction:
        speeds = [speed.base for speed in self.speeds]
        if len(speeds) != len(self.coefficients) or len(speeds) < 2:
            fix = "give as many coefficients as speeds, at least two of each"
            raise bad("friction", "speeds and coefficients do not form a table", fix)
        if speeds[0] < 0 or any(low >= high for low, high in pairwise(speeds)):
            fix = "list speeds of 0 or more in increasing order"
            raise bad("friction", "the speeds are negative or not in increasing order", fix)
        return self

    @property
    def of_pitch_line(self) -> bool:
        """True if the speeds of the table are pitch-line speeds (`of: pitch_line`)."""
        return self.of == "pitch_line"

    def coefficient(self, speed: Floats) -> Floats:
        """Return the coefficient of friction at given speeds [m/s]: linear interpolation within the table, and the
        first or last coefficient outside the table.
        """
        import numpy as np

        found: Floats = np.interp(
            speed, [each.si for each in self.speeds], [float(each.value) for each in self.coefficients]
        )
        return found


AnyFrictionLaw = Annotated[
    StribeckFriction | BuckinghamFriction | DokosFriction | TabulatedFriction, Field(discriminator="law")
]
"""Field type of a friction law, given as a mapping with the key `law`."""


@cache
def law_keys() -> frozenset[str]:
    """Return the names of all fields that occur in friction laws."""
    laws = (StribeckFriction, BuckinghamFriction, DokosFriction, TabulatedFriction)
    return frozenset(key for law in laws for key in law.model_fields)


_NAME = re.compile(r"[a-z_]+")


def law_of_text(raw: object) -> object:
    """Convert a friction law in the form of a command-line option, such as `stribeck,static=0.2,kinetic=0.08,speed=10
    mm/s`, to a mapping as in a declaration.

    The values of a table column are separated by colons. Other values of `raw` are returned unchanged.
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
"""Field type of a friction law, given as a mapping in a declaration or as the text of a command-line option."""


@dataclass(frozen=True, slots=True)
class PairFriction(Shown):
    """Friction law of a pair at a known pitch-line speed, as a function of sliding speed divided by pitch-line speed.

    Examples
    --------
    Teeth that slide at one fifth of the pitch-line speed, which is 50 mm/s:

    >>> from geartrain.teeth import StribeckFriction
    >>> law = StribeckFriction(law="stribeck", static="0.2", kinetic="0.08", speed="10 mm/s")
    >>> round(float(PairFriction(law, 0.05)(0.2)), 4)
    0.1241
    """

    law: FrictionLaw
    """Friction law of the pair."""
    pitch_line: float | Floats
    """Pitch-line speed [m/s]: one value, or an array with one value for each position."""

    def __call__(self, sliding: ArrayLike) -> Floats:
        """Return the coefficient of friction at the relative sliding speeds `sliding` (sliding speed divided by
        pitch-line speed). The coefficient is NaN where `sliding` is NaN (no contact).
        """
        import numpy as np

        speed = np.asarray(sliding, dtype=float) * self.pitch_line
        if self.law.of_pitch_line:
            # NaN marks positions without a contact
            speed = np.where(np.isnan(speed), np.nan, self.pitch_line)
        return self.law.coefficient(speed)
