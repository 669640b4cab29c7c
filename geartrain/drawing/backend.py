"""What the figures take from matplotlib, in one place, and a figure as the bytes of an image file.

Importing this module without matplotlib names the extra.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import BytesIO
from threading import Lock

from geartrain.errors import GearTrainError, MissingExtraError, Problem, printable
from geartrain.scene.palette import ThemeName

try:
    from matplotlib import rc_context
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure as _Figure
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle, FancyArrowPatch, Patch, PathPatch, Polygon, Rectangle
    from matplotlib.path import Path
    from matplotlib.patheffects import Stroke, withStroke
    from matplotlib.text import Text
    from matplotlib.ticker import MaxNLocator

    from geartrain.drawing.theme_colours import themed
except ImportError:
    raise MissingExtraError("matplotlib", "plot", "a plot") from None

__all__ = [
    "SUFFIXES",
    "Axes",
    "Circle",
    "FancyArrowPatch",
    "Figure",
    "Line2D",
    "MaxNLocator",
    "Patch",
    "Path",
    "PathPatch",
    "PolyCollection",
    "Polygon",
    "Rectangle",
    "Stroke",
    "Text",
    "rc_context",
    "render",
    "withStroke",
]


SUFFIXES = (".svg", ".png", ".pdf")

_METADATA: dict[str, dict[str, str | None]] = {
    ".svg": {"Date": None},
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None},
}
_PATH = re.compile(rb'\bd="[^"]*"')
_LONG = re.compile(rb"(\.\d{3})\d+")  # a thousandth of a point is finer than any screen
_ONE_AT_A_TIME = Lock()  # the salt of SVG names can only be given for all figures at once


class ShownFigure(_Figure):
    """A figure that a notebook shows as it is: no window, and no state that figures share."""

    def _repr_svg_(self) -> str:
        return render(self, ".svg").decode("utf-8")


Figure = ShownFigure


def render(figure: _Figure, suffix: str, dots: float = 100.0, theme: ThemeName = "light") -> bytes:
    """A figure as the bytes of an image file; the same figure gives the same bytes with one release of matplotlib.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        From any function of this room.
    suffix : {".svg", ".png", ".pdf"}
        The format.
    dots : float
        Resolution of a .png [dots per inch], above 0.
    theme : {"light", "dark", "print"}
        Colours: on white, on a dark ground, or black and greys for a printer without colours.

    Returns
    -------
    bytes
        What the file holds; control characters in names are written out.

    Raises
    ------
    GearTrainError
        For another suffix.

    Examples
    --------
    >>> render(Figure(), ".png")[1:4], render(Figure(), ".pdf")[:4]
    (b'PNG', b'%PDF')
    """
    kind = suffix.lower()
    if kind not in SUFFIXES:
        raise GearTrainError(
            Problem(f"no plot can be written as {suffix or 'a file without suffix'}", fix=f"use {', '.join(SUFFIXES)}")
        )
    for text in _texts(figure):
        if (shown := printable(text.get_text())) != text.get_text():
            text.set_text(shown)
    buffer = BytesIO()
    with _ONE_AT_A_TIME, rc_context({"svg.hashsalt": "geartrain"}), themed(figure, theme):
        if figure.get_layout_engine():
            figure.draw_without_rendering()  # laid out anew, panels have other ticks, and their words another width
        figure.savefig(buffer, format=kind[1:], dpi=dots, metadata=_METADATA[kind])
    data = buffer.getvalue()
    if kind != ".svg":
        return data
    data = printable(data.decode("utf-8")).encode("utf-8")  # ids too: XML has no control characters at all
    return _PATH.sub(lambda path: _LONG.sub(rb"\1", path[0]), data)


def _texts(artist: Artist) -> Iterator[Text]:
    """All words in it, but for axes that are not shown: their ticks would be made only to be asked for words."""
    for child in artist.get_children():
        if isinstance(child, Text):
            yield child
        elif not (isinstance(child, Axis) and not child.axes.axison):
            yield from _texts(child)
