"""What is prescribed when a train is run in one state, and how that is said."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.errors import Loc, Problem
from geartrain.numerics.decimal_text import abridged_text, decimal
from geartrain.numerics.quantity import Quantity
from geartrain.train.drives import Drive
from geartrain.train.fields import ExpectedVerdict
from geartrain.train.outputs import Output


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
