"""Coefficients of Coulomb friction and of restitution as a train declares them.

Restitution follows Newton's law of impact: two bodies that approach each other at a speed u separate at the speed e u.
The coefficient e is from 0 (the bodies stay together) to 1 (no energy is lost), and the fraction 1 - e^2 of the kinetic
energy of the approach is lost.
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    model_serializer,
    model_validator,
)

from geartrain.numerics.quantity import Figure, Friction, Quantity, Share, bad, check_range, checked, parse_friction


class NumberOrKeys(BaseModel):
    """Base class of parts of a declaration that may be given as a bare number instead of a mapping."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    @model_serializer(mode="wrap")
    def _declared(self, handler: Any) -> Any:
        """Return the part in the form in which it is declared: a bare number if only one key is given."""
        given = [value for _, value in self if value is not None]
        return str(given[0]) if len(given) == 1 else handler(self)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [{"type": ["number", "string"]}, handler(schema)]}


class CoulombFriction(NumberOrKeys):
    """Coefficient of Coulomb friction: friction force divided by normal force, independent of the sliding speed.

    A bare number is the coefficient `sliding`.
    """

    sliding: Friction = Field(description="Coefficient of sliding friction")
    static: Friction | None = Field(
        None,
        description="Coefficient of static friction, which must be overcome to start; `sliding` or more, default "
        "`sliding`",
    )
    deviation: Friction | None = Field(
        None,
        description="Standard deviation of the normal distribution of `sliding` in Monte Carlo runs; `static` keeps "
        "its ratio to `sliding`; default 0",
    )
    range: tuple[Friction, Friction] | None = Field(
        None,
        description="Minimum and maximum of the uniform distribution of `sliding` in Monte Carlo runs, instead of "
        "`deviation`",
    )

    @model_validator(mode="after")
    def _check_coefficients(self) -> CoulombFriction:
        check_range("friction", self.sliding, self.range)
        if self.range is not None and self.deviation is not None:
            fix = "omit `deviation` for a uniform distribution, or `range` for a normal distribution"
            raise bad("friction", "`range` and `deviation` are both given", fix)
        if self.static is not None and self.static.value < self.sliding.value:
            what = f"the static coefficient of friction {self.static.text} is below the sliding one {self.sliding.text}"
            raise bad("friction", what, "give a `static` friction of `sliding` or more, or omit `static`")
        return self

    @property
    def is_random(self) -> bool:
        """True if the coefficient is a random variable with a distribution of nonzero width."""
        if self.range is not None:
            return self.range[0].value < self.range[1].value
        return self.deviation is not None and bool(self.deviation.value)


def _sliding(raw: object) -> object:
    return raw if isinstance(raw, dict | BaseModel) else {"sliding": parse_friction(raw)}


DeclaredCoulombFriction = Annotated[CoulombFriction, BeforeValidator(_sliding)]
"""Field type of a Coulomb friction coefficient. A bare number is accepted as the coefficient `sliding`."""


DeclaredRestitution = Annotated[
    Figure,
    checked(
        lambda given: 0 <= given.value <= 1,
        "a restitution of {text} is out of range",
        "give a number from 0 (no rebound) to 1 (no loss of energy)",
    ),
]
"""Coefficient of restitution, 0 to 1."""


def _at_most_one(efficiency: Quantity) -> Quantity:
    if efficiency.base > 1:
        # a number up to 100 was probably meant as a percentage
        meant = f"{efficiency.text} %" if efficiency.unit is None and efficiency.base <= 100 else "0.98"
        fix = f"for example, write 0.98 or {meant}; no pair transmits more power than it receives"
        raise bad("efficiency", f"an efficiency of {efficiency.text} is above 1", fix)
    return efficiency


Efficiency = Annotated[Share, AfterValidator(_at_most_one)]


class Efficiencies(NumberOrKeys):
    """Basic efficiency of a pair (with fixed carrier) for each driving side, as a number up to 1 or a percentage.

    A value of 0 or less declares that the pair is self-locking if that side drives. At least one of the two values is
    above 0.
    """

    forward: Efficiency = Field(
        description="Efficiency with the first wheel driving, at most 1; 0 or less means self-locking"
    )
    backward: Efficiency = Field(
        description="Efficiency with the second wheel driving, at most 1; 0 or less means self-locking"
    )

    @model_validator(mode="after")
    def _check_directions(self) -> Efficiencies:
        if self.forward.base <= 0 and self.backward.base <= 0:
            what = f"an efficiency of {self.forward.text} transmits no power in either direction"
            raise bad("efficiency", what, "give an efficiency above 0 and at most 1, such as 0.98 or 98 %")
        return self


def _efficiency(raw: object) -> object:
    return raw if isinstance(raw, dict | Efficiencies) else {"forward": raw, "backward": raw}


DeclaredEfficiency = Annotated[Efficiencies, BeforeValidator(_efficiency)]
"""Field type of basic efficiencies. One number is accepted for both driving directions."""
