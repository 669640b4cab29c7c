"""How the train is run and changed: clutches, states, errata, removals."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Speed, Torque
from geartrain.train.drives import Drive
from geartrain.train.fields import ByName, Declared, ExpectedVerdict, Id, Nothing
from geartrain.train.outputs import Output


class Clutch(Declared):
    """A brake or a clutch: one of `fixes` and `locks`.

    See Also
    --------
    Train : holds them as `clutches`, by name
    State : engages them
    """

    fixes: Id | None = Field(None, description="The link it holds to the frame")
    locks: tuple[Id, Id] | None = Field(None, description="The two links it makes one body")

    @model_validator(mode="after")
    def _is_one_thing(self) -> Clutch:
        if (self.fixes is None) == (self.locks is None):
            raise PydanticCustomError(
                "clutch", "a clutch fixes one link or locks two", {"fix": "give exactly one of fixes, locks"}
            )
        return self


class State(Declared):
    """One way the train is run. What is given here replaces the train's; outputs merge by name.

    See Also
    --------
    Train : holds them as `states`, by name
    StateCase : what comes of one
    """

    engaged: tuple[Id, ...] = Field((), description="Clutches and brakes that are closed")
    fixed: tuple[Id, ...] | None = Field(None, description="Links held to the frame, one body with it")
    locks: tuple[tuple[Id, Id], ...] | None = Field(None, description="Pairs of links that are one body")
    inputs: ByName[Speed] | None = Field(None, description="Prescribed speeds by link")
    loads: ByName[Torque] | None = Field(None, description="Torques on links; power into the train is positive")
    solve_for: Id | None = Field(None, description="The link whose torque is unknown")
    drive: Drive | None = Field(None, description="What drives the train in time")
    outputs: ByName[Annotated[Output, Nothing]] = Field(
        {}, validate_default=True, description="Outputs of this state, merged with the train's by name"
    )
    expect: ExpectedVerdict | None = Field(
        None, description="The verdict that holds and is no failure: neutral is free"
    )
    note: str | None = Field(None, description="A remark for the reader")


class Erratum(Declared):
    """Something a source prints that is not so."""

    place: Id = Field(description="Where it is printed")
    printed: Id = Field(description="What is printed")
    right: Id = Field(description="What is right")
    why: str = Field(description="How one knows")


class Remove(Declared):
    """What a child takes away from its parent before it adds its own."""

    links: tuple[Id, ...] = Field((), description="Links, with their wheels, joints, pairs and couplings")
    wheels: tuple[Id, ...] = Field((), description="Wheels, with their pairs")
    gears: tuple[Id, ...] = Field((), description="Gear pairs by id")
    couplings: tuple[Id, ...] = Field((), description="Couplings by id")
    revolutes: tuple[tuple[Id, Id], ...] = Field((), description="Turning pairs by their two links")
    outputs: tuple[Id, ...] = Field((), description="Outputs by name")
    dials: tuple[Id, ...] = Field((), description="Dials by name")
    states: tuple[Id, ...] = Field((), description="States by name")
    axes: tuple[Id, ...] = Field((), description="Axes by label")
