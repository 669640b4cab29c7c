"""Constraints of `geartrain reconstruct`: parts that may be added, parts that must be used, and prior costs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, model_validator

from geartrain.numerics.plain_values import Boolean, whole_from
from geartrain.numerics.quantity import Figure, MeasuredLength, Quantity, Share, above_zero, bad
from geartrain.train.fields import Count, Declared, Id

MOST_ADDED = 1000
NEW_ARBOR = "new"
"""Value of `of` in an output that means that the arbor of the pointer does not survive."""


def _ordered(bounds: tuple[int, int]) -> tuple[int, int]:
    if bounds[0] > bounds[1]:
        raise bad("teeth", f"the range {bounds[0]} to {bounds[1]} is empty", "write the smaller count first")
    return bounds


PartNumber = Annotated[int, whole_from(0, MOST_ADDED, "parts")]
Factor = Annotated[Figure, above_zero("give a factor above 0, such as 10")]
Spread = Annotated[Share, above_zero("give a spread above 0, such as 4 %")]
Distance = Annotated[MeasuredLength, above_zero("give a length above 0, such as 0.5 mm")]


class AddedParts(Declared):
    """Parts that a reconstruction may add to the surviving parts."""

    wheels: PartNumber = Field(0, description="Maximum number of added wheels")
    arbors: PartNumber | None = Field(None, description="Maximum number of added arbors; default no limit")
    teeth: Annotated[tuple[Count, Count], AfterValidator(_ordered)] | None = Field(
        None, description="Minimum and maximum tooth count of an added wheel, inclusive"
    )
    on: Literal["any", "new"] = Field(
        "any", description="Arbors of added wheels: any (surviving ones too, as driving wheels) or only new ones"
    )

    @model_validator(mode="after")
    def _check_bounds(self) -> AddedParts:
        if self.wheels and self.teeth is None:
            what = "no range of tooth counts is given for added wheels"
            raise bad("add", what, "for example, add `teeth: [12, 225]`")
        return self


class GivenCoupling(Declared):
    """Coupling between two surviving links that is known from the evidence. The links have equal mean speeds in the
    same sense of rotation.
    """

    pair: tuple[Id, Id] = Field(description="Two links, beginning with the link of the pin")
    kind: Literal["pin_and_slot"] = Field(
        "pin_and_slot", description="Kind of coupling: a pin in a slot has a mean ratio of 1"
    )


class PriorCost(Declared):
    """Factors by which each assumption reduces the prior probability of a candidate."""

    wheel: Factor = Field(Figure.parse(10), description="Factor for each added wheel")
    arbor: Factor = Field(Figure.parse(10), description="Factor for each added arbor")
    unused: Factor = Field(Figure.parse(100), description="Factor for each surviving wheel that is not used")


class MeasuredGeometry(Declared):
    """Weights of measured modules, pitch radii and positions of axes. Without this block, these measurements are
    ignored.

    A misfit multiplies the weight of a candidate by exp(-(misfit/spread)^2 / 2). The default spread of modules is the
    root mean square of the twelve pairs of the Antikythera mechanism of 2006 in which both wheels are measured. The
    default spread of distances follows from the same errors for pairs in which only one wheel is measured.
    """

    module: Spread = Field(
        Quantity.parse("4.3 %", "fraction", True),
        description="Standard deviation of the logarithm of the ratio of modules in mesh, about the relative "
        "difference",
    )
    distance: Spread = Field(
        Quantity.parse("3 %", "fraction", True),
        description="Standard deviation of the logarithm of the sum of pitch radii divided by the distance between "
        "the axes",
    )
    reach: Distance | None = Field(
        None,
        description="Maximum difference between the sum of pitch radii and the distance between the axes; "
        "default no limit, only its weight",
    )
    radius: Distance | None = Field(
        None,
        description="Error of every measured pitch radius in addition to the spread of modules, because small wheels "
        "are measured less accurately; default none",
    )
    radii: Mapping[Id, Distance] = Field(
        {}, description="Measured pitch radii of surviving wheels, if the radius was measured instead of the module"
    )


class Reconstruction(Declared):
    """Rules for reconstructing a train from surviving parts. A declaration with these rules describes the evidence, not
    a complete train.

    In such a declaration the links are the surviving arbors, and the gears are pairs that were observed in mesh. An
    output without `of` is a pointer whose arbor is unknown; `of: new` means that its arbor does not survive.
    """

    add: AddedParts = Field(AddedParts(), description="Parts that may be added")
    carrier: Id | None = Field(
        None, description="Link on which the arbors turn, whose speed is an input; default the frame"
    )
    use: Literal["wheels", "arbors", "some"] = Field(
        "wheels", description="Parts that must be used: every surviving wheel, every surviving arbor, or neither"
    )
    sense: Literal["given", "free"] = Field(
        "given", description="Evidence of the speeds: given (with their signs) or free (only their magnitudes)"
    )
    idlers: Boolean = Field(False, description="True if a driven wheel may itself drive another (idler)")
    apart: tuple[tuple[Id, Id], ...] = Field((), description="Pairs of wheels that are known not to mesh")
    given: tuple[GivenCoupling, ...] = Field((), description="Known couplings")
    cost: PriorCost = Field(PriorCost(), description="Factors of the prior probability")
    geometry: MeasuredGeometry | None = Field(
        None, description="Weights of measured modules, radii and positions of axes; default not used"
    )
