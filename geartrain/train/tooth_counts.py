"""A tooth count as it is declared where it is in doubt: a best value, and what the evidence allows."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure
from geartrain.train.fields import Count, Declared


class Teeth(Declared):
    """A tooth count with its doubt: a best value, and a range or choices.

    See Also
    --------
    Wheel : an example
    """

    value: Count | None = Field(None, description="The count used")
    range: tuple[Count, Count] | None = Field(
        None, description="Least and greatest count the evidence allows, inclusive"
    )
    choices: tuple[Count, ...] | None = Field(None, fail_fast=True, description="The counts the evidence allows")
    weights: tuple[Figure, ...] | None = Field(
        None, fail_fast=True, description="Relative weight of each count in range or choices"
    )
    source: str | None = Field(None, description="Key of the source")
    search: tuple[Count, ...] | None = Field(
        None,
        min_length=2,
        fail_fast=True,
        description="The count is to be found: within two bounds, inclusive, or among three or more counts",
    )
    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _makes_sense(self) -> Teeth:
        bounds = self.range or self.search
        if bounds and len(bounds) == 2 and bounds[0] > bounds[1]:
            raise PydanticCustomError(
                "teeth",
                "the range {low} to {high} is empty",
                {"low": bounds[0], "high": bounds[1], "fix": "write the least count first"},
            )
        if self.value is None and self.search is None:
            raise PydanticCustomError("teeth", "the tooth count has no value", {"fix": "give `value`, or `search`"})
        counts = self.allowed
        if self.value is not None and counts and self.value not in counts:
            raise PydanticCustomError(
                "teeth",
                "the value {value} lies outside what its evidence allows",
                {"value": self.value, "fix": "widen the range or choices, or correct the value"},
            )
        if self.weights is not None and len(self.weights) != len(counts):
            raise PydanticCustomError(
                "teeth",
                "{given} weights for {count} counts",
                {"given": len(self.weights), "count": len(counts), "fix": "give one weight for each count"},
            )
        return self

    @property
    def allowed(self) -> tuple[int, ...]:
        """All counts the evidence allows; empty where no doubt is declared."""
        if self.choices is not None:
            return self.choices
        if self.range is None or self.range[1] - self.range[0] > 10**6:
            return ()
        return tuple(range(self.range[0], self.range[1] + 1))

    @property
    def searched(self) -> Sequence[int]:
        """The counts of `search`, ascending; empty without it."""
        if self.search is None:
            return ()
        return range(self.search[0], self.search[1] + 1) if len(self.search) == 2 else sorted(set(self.search))

    @property
    def chances(self) -> dict[int, Fraction]:
        """The chance of each count before anything else is known, as its `weights` say, ascending; the sum is 1.

        All counts are alike where no weights are declared, and those of `search`; counts of weight 0 are left out.
        Empty where no doubt is declared. Not to be asked where there is a `fault_of_weights`.

        Examples
        --------
        >>> Teeth(value=64, range=(63, 65), weights=(1, 3, 0)).chances
        {63: Fraction(1, 4), 64: Fraction(3, 4)}
        """
        counts = self.allowed
        if not counts:
            counts = tuple(self.searched)
        weights = [Fraction(1)] * len(counts) if self.weights is None else [figure.value for figure in self.weights]
        whole, found = sum(weights), dict.fromkeys(sorted(counts), Fraction(0))
        for count, weight in zip(counts, weights, strict=True):  # a count may be listed twice
            found[count] += weight / whole
        return {count: chance for count, chance in found.items() if chance}

    @property
    def fault_of_weights(self) -> str | None:
        """Why its weights are no chances; None where they are."""
        weights = [figure.value for figure in self.weights or ()]
        if any(weight < 0 for weight in weights):
            return "one is negative"
        return "all are 0" if weights and not any(weights) else None
