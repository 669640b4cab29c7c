"""Pairs and planetary sets of which only the ratio is known, as a train declares them.

The ratio p/q is the speed of the first link divided by the speed of the second, both relative to their carrier k:
q (w_1 - w_k) = p (w_2 - w_k). Links on two axes have their carrier from the turning pairs. Links on one axis may have
any other link of this axis as carrier; their row then is the Willis equation of a planetary set with basic ratio p/q.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, Field, model_validator

from geartrain.numerics.quantity import Figure, above_zero, bad
from geartrain.teeth.contact_coefficients import NumberOrKeys
from geartrain.teeth.coupling import Coupling, CouplingRow, ratio_row


class ApproximateRatio(NumberOrKeys):
    """Ratio with a tolerance if it is not known exactly. A bare number is an exact ratio."""

    value: Figure = Field(description="Ratio used in calculations")
    tolerance: Annotated[Figure, above_zero("give a tolerance above 0, or only the ratio")] | None = Field(
        None, description="Maximum deviation of the true ratio from `value`; default none, for an exact ratio"
    )


def _ratio(raw: object) -> object:
    return raw if isinstance(raw, dict | BaseModel) else {"value": Figure.parse(raw)}


DeclaredRatio = Annotated[ApproximateRatio, BeforeValidator(_ratio)]
"""Field type of a ratio with its tolerance. A bare number is accepted as an exact ratio."""


class Ratio(Coupling):
    """Pair of links, or planetary set, for which only the speed ratio is known."""

    PARALLEL = ""
    NEEDS_DISTANCE = False
    HOLDS = True
    UNKNOWN = "tooth counts, sizes, mesh frequency, backlash and transmission error"

    kind: Literal["ratio"] = Field(
        "ratio", description="Pair or planetary set of which only the ratio is known; this key may be omitted"
    )
    pair: tuple[str, str] = Field(description="First link, which counts as driving, and second link")
    ratio: DeclaredRatio = Field(
        description="Speed of the first link divided by that of the second, relative to the carrier, with its sign: an "
        "exact number, or `{value, tolerance}`"
    )
    carrier: str | None = Field(
        None, description="Carrier of a coaxial pair, a link on the same axis; default the link that bears the axis"
    )

    @model_validator(mode="after")
    def _check_ratio(self) -> Ratio:
        first, second = self.pair
        value, tolerance = self.ratio.value, self.ratio.tolerance
        if not value.value:
            what = f"with a ratio of 0, '{first}' would be at rest relative to its carrier"
            raise bad("ratio", what, f"write `fixed: [{first}]`, or give the ratio {first}/{second}")
        if tolerance is not None and tolerance.value >= abs(value.value):
            what = f"the ratio {value.text} with the tolerance {tolerance.text} may be 0"
            raise bad("ratio", what, "give a tolerance below the ratio")
        if self.carrier in self.pair:
            what = f"'{self.carrier}' is both the carrier and one of the pair"
            raise bad("ratio", what, "name the third link of the set as `carrier`, or omit it")
        return self

    @property
    def mean(self) -> Fraction:
        """Exact mean ratio: speed of the second link divided by the speed of the first link, relative to the carrier.
        It is the reciprocal of the declared ratio.
        """
        return 1 / self.ratio.value.value

    @property
    def bounds(self) -> tuple[Fraction, Fraction] | None:
        """Minimum and maximum of `mean` for a ratio with a tolerance; None for an exact ratio."""
        if self.ratio.tolerance is None:
            return None
        ratio, tolerance = self.ratio.value.value, self.ratio.tolerance.value
        return 1 / (ratio + tolerance), 1 / (ratio - tolerance)

    @property
    def about(self) -> str:
        """Text that shows the ratio as declared."""
        tolerance = self.ratio.tolerance
        return f"ratio {self.ratio.value}" if tolerance is None else f"ratio {self.ratio.value} ± {tolerance}"

    def references(self) -> Iterator[tuple[str, str, tuple[str | int, ...]]]:
        """Yield the kind, the name and the location in the declaration of both links and of the declared carrier."""
        yield from super().references()
        if self.carrier is not None:
            yield "link", self.carrier, ("carrier",)

    def rows(self, wheels: Mapping[str, tuple[str, Any]]) -> Sequence[CouplingRow]:
        """Return the only row of this coupling, which contains the declared carrier."""
        del wheels
        first, second = self.pair
        return (ratio_row(self.name, second, first, self.mean)._replace(carrier=self.carrier),)
