"""Coefficients of Coulomb friction and of restitution as a train declares them.

Restitution is Newton's law of impact: two sides that approach each other at a speed u separate at the speed e u. The
coefficient e is from 0 (they stay together) to 1 (no energy is lost), and the fraction 1 - e^2 of the kinetic energy of
the approach is lost.
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

from geartrain.numerics.quantity import Figure, Friction, bad, parse_friction


class CoulombFriction(BaseModel):
    """Coulomb friction: friction force divided by normal force, independent of the sliding speed.

    A bare number is the coefficient `sliding`.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

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

    @model_validator(mode="after")
    def _check_static(self) -> CoulombFriction:
        if self.static is not None and self.static.value < self.sliding.value:
            what = f"the static coefficient of friction {self.static.text} is below the sliding one {self.sliding.text}"
            raise bad("friction", what, "give a `static` friction of `sliding` or more, or omit `static`")
        return self

    @model_serializer(mode="wrap")
    def _declared(self, handler: Any) -> Any:
        """Return the coefficient as declared: a bare number if only `sliding` is given."""
        return str(self.sliding) if self.static is None and self.deviation is None else handler(self)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [{"type": ["number", "string"]}, handler(schema)]}


def _sliding(raw: object) -> object:
    return raw if isinstance(raw, dict | BaseModel) else {"sliding": parse_friction(raw)}


DeclaredCoulombFriction = Annotated[CoulombFriction, BeforeValidator(_sliding)]
"""Field type: Coulomb friction, or a bare number for its coefficient `sliding`."""


def _check_restitution(figure: Figure) -> Figure:
    if not 0 <= figure.value <= 1:
        fix = "give a number from 0 (no rebound) to 1 (no loss of energy)"
        raise bad("restitution", f"a restitution of {figure.text} is out of range", fix)
    return figure


DeclaredRestitution = Annotated[Figure, AfterValidator(_check_restitution)]
"""Coefficient of restitution, 0 to 1."""
