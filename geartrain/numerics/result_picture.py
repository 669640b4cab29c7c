"""Results that show themselves: the one way from a room to those above it that draw."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, ClassVar


def picture_maker(room: str, name: str) -> Callable[..., Any]:
    """A function that draws or describes, by its name, for a method that hands itself to it.

    Rooms that draw stand above those that calculate. A result reaches up to them here alone, by name, and when it is
    asked to show itself: nothing that draws is imported before.

    room   where it is, by the name below `geartrain`
    name   of the function or class, public there
    """
    found: Callable[..., Any] = getattr(import_module(f"geartrain.{room}"), name)
    return found


class Pictured:
    """A result with a picture of its own: the function `FIGURE` of the package `DRAWN_IN` makes it."""

    __slots__ = ()

    FIGURE: ClassVar[str]
    DRAWN_IN: ClassVar[str] = "drawing"

    def plot(self, *how: Any) -> Any:
        """The result as a figure of matplotlib, which notebooks show.

        Parameters
        ----------
        *how
            What the function that draws such results takes after the result itself.

        Returns
        -------
        matplotlib.figure.Figure
            For `geartrain.drawing.render`, or to be drawn on.

        Raises
        ------
        MissingExtraError
            Without matplotlib, which the extra `plot` brings.
        """
        return picture_maker(self.DRAWN_IN, self.FIGURE)(self, *how)
