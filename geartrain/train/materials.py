"""Materials of wheels: a small shipped table, those that a train declares, and the stock of each wheel."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Annotated

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Density, Figure, MeasuredLength, Pressure, above_zero
from geartrain.train.fields import Declared

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.train.declaration import Train
    from geartrain.train.mechanism import Wheel

_VICKERS = 9.80665e6  # Pa in one HV, which is kgf/mm2


def _contracts(figure: Figure) -> Figure:
    if not 0 <= figure.value < 0.5:
        raise PydanticCustomError(
            "poisson",
            "Poisson's ratio {text} is that of no material",
            {"text": figure.text, "fix": "write a number from 0 to less than 0.5, for metals about 0.3"},
        )
    return figure


def _partly(figure: Figure) -> Figure:
    if not 0 <= figure.value < 1:
        raise PydanticCustomError(
            "spread",
            "a spread of {text} is no part of a value",
            {"text": figure.text, "fix": "write a part from 0 to less than 1: 0.3 for 30 % to either side"},
        )
    return figure


_STRENGTH = "give for example 200 MPa"


class Material(Declared):
    """What a wheel is made of, as far as its strength asks.

    See Also
    --------
    Train : holds those of its own as `materials`, by name

    Examples
    --------
    >>> steel = material_table()["steel"]
    >>> steel.youngs_modulus.text, round(steel.hardness_pressure / 1e6)
    ('206 GPa', 1863)
    """

    youngs_modulus: Annotated[Pressure, above_zero("give for example 100 GPa")] = Field(description="Young's modulus")
    poisson: Annotated[Figure, AfterValidator(_contracts)] = Field(
        Figure.parse("0.3"), description="Poisson's ratio, 0 to less than 0.5"
    )
    strength: Annotated[Pressure, above_zero(_STRENGTH)] | None = Field(
        None,
        description="Stress at which it gives way: 0.2 % proof stress of metals, tensile strength of what does not "
        "yield; no safety is counted in it",
    )
    hardness: Annotated[Figure, above_zero("give for example 120, in HV")] | None = Field(
        None, description="Vickers hardness (HV), which wear goes by"
    )
    density: Annotated[Density, above_zero("give for example 8.5 g/cm3")] | None = Field(
        None, description="Density; `density` of a wheel goes before it"
    )
    spread: Annotated[Figure, AfterValidator(_partly)] = Field(
        Figure.parse("0.3"), description="How far the strength may be off to either side, as a part of it"
    )
    what: str = Field("", description="What is meant by the name")
    source: str = Field("", description="Where the values come from")

    @property
    def hardness_pressure(self) -> float | None:
        """Hardness as a pressure [Pa]: force over the area of the print."""
        return None if self.hardness is None else float(self.hardness.value) * _VICKERS


FaceWidth = Annotated[MeasuredLength, above_zero("give a length such as 3 mm")]


class ArborSizes(Declared):
    """The arbor of a link between its two bearings.

    See Also
    --------
    Link : holds it as `arbor`
    """

    diameter: FaceWidth = Field(description="Diameter between its shoulders")
    span: FaceWidth = Field(description="Length from the middle of one bearing to that of the other")
    pivot: FaceWidth | None = Field(None, description="Diameter of its pivots; default its own")
    pivot_length: FaceWidth | None = Field(None, description="Length of a pivot in its hole; default its diameter")
    material: str = Field("steel", description="Name of its material")


@cache
def material_table() -> Mapping[str, Material]:
    """The materials that need no declaration, by name; a train's own of the same name go before them.

    Returns
    -------
    mapping of str to Material
        With sources and spread, handbook means: no guarantee for any one sheet or bar.
    """
    text = files("geartrain.train").joinpath("materials.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return {row.pop("name"): Material.model_validate(row) for row in rows}


def wheel_thickness(train: Train, wheel: Wheel) -> Quantity | None:
    """Along its axis; where it is not declared it is as thick as its teeth are wide."""
    return wheel.thickness or wheel.face_width or train.thickness or train.face_width


def face_width(train: Train, wheel: Wheel) -> Quantity | None:
    """Width of its teeth; where it is not declared they are as wide as the wheel is thick."""
    return wheel.face_width or wheel.thickness or train.face_width or train.thickness


def material_named(train: Train, name: str) -> Material:
    """Of the train's own materials, else of the table."""
    return train.materials.get(name) or material_table()[name]
