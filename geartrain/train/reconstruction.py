"""Constraints of `geartrain reconstruct`: the parts that may be added, the parts that must be used, and their prior
cost.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure, MeasuredLength, Quantity, Share, above_zero
from geartrain.train.fields import Boolean, Count, Declared, Id

MOST_ADDED = 1000
NEW_ARBOR = "new"
"""Value of `of` in an output if the arbor of its pointer does not survive."""


def _number(raw: object) -> object:
    """Read a whole number from 0 to 1000."""
    try:
        # True is an int of Python's; a text of thousands of digits would take minutes to read
        number = raw if type(raw) is int else int(raw) if isinstance(raw, str) and len(raw) <= 30 else None
    except ValueError:
        number = None
    if number is not None and 0 <= number <= MOST_ADDED and str(raw).isascii():
        return number
    fix = f"give a whole number from 0 to {MOST_ADDED}"
    raise PydanticCustomError("number", "{shown} is no number of parts", {"shown": str(raw)[:30], "fix": fix})


def _ordered(bounds: tuple[int, int]) -> tuple[int, int]:
    if bounds[0] > bounds[1]:
        context = {"low": bounds[0], "high": bounds[1], "fix": "write the least count first"}
        raise PydanticCustomError("teeth", "the range {low} to {high} is empty", context)
    return bounds


PartNumber = Annotated[int, BeforeValidator(_number)]
Factor = Annotated[Figure, above_zero("give a factor above 0, such as 10")]
Spread = Annotated[Share, above_zero("give a spread above 0, such as 4 %")]
Distance = Annotated[MeasuredLength, above_zero("give a length above 0, such as 0.5 mm")]


class AddedParts(Declared):
    """Parts that may be added to the surviving ones.

    See Also
    --------
    Reconstruction : has it as `add`
    """

    wheels: PartNumber = Field(0, description="The most wheels that may be added")
    arbors: PartNumber | None = Field(None, description="The most arbors that may be added; default any number")
    teeth: Annotated[tuple[Count, Count], AfterValidator(_ordered)] | None = Field(
        None, description="Least and greatest count of an added wheel, inclusive"
    )
    on: Literal["any", "new"] = Field(
        "any", description="Where added wheels stand: also beside surviving wheels, to drive, or on new arbors alone"
    )

    @model_validator(mode="after")
    def _is_bounded(self) -> AddedParts:
        if self.wheels and self.teeth is None:
            raise PydanticCustomError(
                "add", "wheels are added whose counts have no bounds", {"fix": "add for example `teeth: [12, 225]`"}
            )
        return self


class GivenCoupling(Declared):
    """A known coupling of two surviving links: their mean speeds are equal, with the same sense of rotation.

    See Also
    --------
    Reconstruction : has them as `given`
    """

    pair: tuple[Id, Id] = Field(description="The two links, that of the pin first")
    kind: Literal["pin_and_slot"] = Field("pin_and_slot", description="A pin in a slot: a mean ratio of 1")


class PriorCost(Declared):
    """Factors by which each assumption reduces the prior probability of a candidate.

    See Also
    --------
    Reconstruction : has it as `cost`
    """

    wheel: Factor = Field(Figure.parse(10), description="Each added wheel")
    arbor: Factor = Field(Figure.parse(10), description="Each added arbor")
    unused: Factor = Field(Figure.parse(100), description="Each surviving wheel that is not used")


class MeasuredGeometry(Declared):
    """Weights of measured modules, pitch radii and positions of axes. Without this block they are ignored.

    A misfit has the weight exp(-(misfit/spread)^2 / 2). The default spread of modules is the root mean square of the
    twelve pairs of the Antikythera mechanism of 2006 in which both wheels are measured. The default spread of distances
    corresponds to the same errors if only one wheel is measured.

    See Also
    --------
    Reconstruction : has it as `geometry`
    """

    module: Spread = Field(
        Quantity.parse("4.3 %", "fraction", True),
        description="Spread of modules of wheels in mesh: the logarithm of their quotient, which is the difference "
        "over the mean",
    )
    distance: Spread = Field(
        Quantity.parse("3 %", "fraction", True),
        description="Spread of the sum of pitch radii about the distance of the axes: the logarithm of their quotient",
    )
    reach: Distance | None = Field(
        None,
        description="By how much the sum of pitch radii may miss the distance of the axes at most; "
        "default anything, at its weight",
    )
    radius: Distance | None = Field(
        None,
        description="Error of every measured pitch radius, beside the spread of modules, for small wheels are measured "
        "worse; default none, so that the spread alone counts",
    )
    radii: Mapping[Id, Distance] = Field(
        {}, description="Measured pitch radii of surviving wheels, where that and not the module was measured"
    )


class Reconstruction(Declared):
    """Rules for the explanation of evidence. A declaration that has them is evidence, not a train.

    Its links are the surviving arbors, its gears are pairs that were observed in mesh, and an output without `of` is a
    pointer whose arbor is unknown (`of: new` if that arbor is known not to survive).

    Examples
    --------
    >>> requested = Reconstruction(add={"wheels": 2, "teeth": (12, 225)})
    >>> requested.add.on, requested.use, requested.sense, requested.cost.unused.value
    ('any', 'wheels', 'given', Fraction(100, 1))
    """

    add: AddedParts = Field(AddedParts(), description="What may be added")
    carrier: Id | None = Field(
        None, description="The link on which the arbors turn, with its speed among the inputs; default the frame"
    )
    use: Literal["wheels", "arbors", "some"] = Field(
        "wheels", description="What must be used: every surviving wheel, every surviving arbor, or neither"
    )
    sense: Literal["given", "free"] = Field(
        "given", description="Whether the signs of speeds are evidence, or their magnitudes alone"
    )
    idlers: Boolean = Field(False, description="Whether a driven wheel may itself drive")
    apart: tuple[tuple[Id, Id], ...] = Field((), description="Pairs of wheels known not to mesh")
    given: tuple[GivenCoupling, ...] = Field((), description="Couplings that are taken as they are")
    cost: PriorCost = Field(PriorCost(), description="Factors of the prior")
    geometry: MeasuredGeometry | None = Field(
        None, description="How modules, radii and positions of axes are weighed; default not at all"
    )
