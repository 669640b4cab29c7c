"""Cups of strain waves: the wall that joins a thin wheel, which a wave bends, to what it turns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from geartrain.errors import Problem
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart

KIND = "wall"
"""Of the part that it is."""


@dataclass(frozen=True, slots=True)
class FlexibleCup:
    """A thin wheel and the link of its cup.

    name    of the coupling that says that both turn alike
    link    with the bottom of the cup; `slot`, with the wheel
    wheel   its name
    at      of the cup's axis across the stack (mm)
    reach   outside radius of the wall; `wall`, how thick it is (mm)
    """

    name: str
    link: str
    slot: str
    wheel: str
    at: Point
    reach: float
    wall: float

    def part(self, plate: tuple[float, float], wheel: StackDisc) -> TurnedPart:
        """The wall, from the face of the wheel to the bottom."""
        low, high = (wheel.high, plate[0]) if plate[0] > wheel.middle else (plate[1], wheel.low)
        band = Band(low, high, self.reach, self.reach - self.wall)
        return TurnedPart(self.link, f"{self.link} wall", KIND, self.at, (band,), f"one piece with {self.wheel}")

    def told(self) -> Iterator[Problem]:
        """What no drawing can show of it."""
        what = f"'{self.wheel}' and the wall of '{self.link}' are one thin piece, which no sheet gives"
        why = f"a wave bends it: its wall is {self.wall:.3g} mm thick"
        fix = f"turn it, or print it of what bends, from wheels/{self.wheel}.stl and {self.link} wall in assembly.stl"
        yield Problem(what, why, fix)
