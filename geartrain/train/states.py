"""How the train is run and changed: clutches, states, errata, removals; and everything prescribed in one state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Annotated

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.errors import Loc, Problem
from geartrain.numerics.decimal_text import abridged_text, decimal
from geartrain.numerics.quantity import Quantity, Speed, Torque
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


# ----------------------------------------------------------------------------------------------------------- state case


@dataclass(frozen=True, slots=True)
class StateCase:
    """What is prescribed when the train is run in one state.

    Attributes
    ----------
    state : str or None
        The state; None for a train without states.
    inputs : mapping of str to Fraction
        Prescribed speed by link [`Train.unit_name`].
    fixed : tuple of str
        Links held to the frame.
    locks : tuple of (str, str)
        Pairs of links that turn together.
    outputs : mapping of str to Output
        What is asked for in this state, by name.
    loc : tuple of str or int
        Where the inputs were declared: the keys that lead to them.
    engaged : tuple of str
        Clutches and brakes that are closed.
    clutches : mapping of tuple of str to str
        The clutch or brake behind a fixed link or a lock.
    loads : mapping of str to Quantity
        Torques on links; power into the train is positive.
    solve_for : str or None
        The link whose torque is named as unknown.
    drive : Drive or None
        What drives the train in time: the state's, the train's, or its `rate`.
    rate : Quantity or None
        Speed of the input in real time, where `drive` or the train's `rate` says it.
    expect : {"determined", "free", "locked"}
        The verdict that is no failure.
    exact : bool
        False where radians had to be counted in turns, or turns in radians: to 50 digits then.
    causes : mapping of tuple of str to tuple of str
        A link that is fixed, or two that are locked, only because something else is -> the links of that.
    problems : tuple of Problem
        Why no speed can be calculated in this state; mostly none.

    Examples
    --------
    >>> import geartrain
    >>> case = geartrain.load("planetary").declaration.case("sun fixed")
    >>> case.fixed, case.given("ring")
    (('sun',), 'ring = 1')
    """

    state: str | None
    inputs: Mapping[str, Fraction]
    fixed: tuple[str, ...]
    locks: tuple[tuple[str, str], ...]
    outputs: Mapping[str, Output]
    loc: Loc
    engaged: tuple[str, ...]
    clutches: Mapping[tuple[str, ...], str]
    loads: Mapping[str, Quantity] = field(default_factory=dict)
    solve_for: str | None = None
    exact: bool = True
    drive: Drive | None = None
    rate: Quantity | None = None
    expect: ExpectedVerdict = "determined"
    causes: Mapping[tuple[str, ...], tuple[str, ...]] = field(default_factory=dict)
    problems: tuple[Problem, ...] = ()

    def given(self, link: str) -> str:
        """A prescribed speed in words: `sun = 1400`.

        Parameters
        ----------
        link : str
            One of the inputs.
        """
        return f"{link} = {self.shown(self.inputs[link])}"

    def shown(self, speed: Fraction) -> str:
        """A speed for a reader: as a fraction, or in decimal where it is not exact.

        Parameters
        ----------
        speed : Fraction
            Any speed of the case.
        """
        return abridged_text(speed) if self.exact else decimal(speed)

    def says(self, *links: str) -> str:
        """A brake on one link or a lock of two, in words, and what it follows from where it is not declared itself.

        Parameters
        ----------
        *links : str
            One link that is held, or two that are locked together.
        """
        declared = self.declares(*links)
        if self.causes.get(links, links) == links:
            return declared
        held = f"'{links[0]}' still" if len(links) == 1 else f"'{links[0]}' and '{links[1]}' together"
        return f"{declared}, which holds {held}"

    def declares(self, *links: str) -> str:
        """What is declared behind a brake or a lock, in words, with the clutch that does it.

        Parameters
        ----------
        *links : str
            One link that is held, or two that are locked together.
        """
        links = self.causes.get(links, links)
        by = f" by {self.clutches[links]}" if links in self.clutches else ""
        return (
            f"'{links[0]}' is fixed{by}"
            if len(links) == 1
            else f"'{links[0]}' and '{links[1]}' are locked together{by}"
        )
