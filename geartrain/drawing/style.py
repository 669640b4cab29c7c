"""Common parts of all figures: matplotlib names, colours and sizes, panels for curves and bars, text, and image files.

Importing this module without matplotlib raises an error that names the extra `plot`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from io import BytesIO
from textwrap import fill, shorten, wrap
from threading import Lock
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from geartrain.errors import GearTrainError, MissingExtraError, Problem, QuestionError, printable
from geartrain.scene.palette import THEMES, ThemeName, series_colour, series_dash

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.scene import Scene

try:
    import numpy as np
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

    from geartrain.drawing.theme_colours import SCALES, themed
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
_LONG = re.compile(rb"(\.\d{3})\d+")  # a thousandth of a point is finer than any screen resolves
_ONE_AT_A_TIME = Lock()  # the salt of SVG ids is a global setting of matplotlib


class ShownFigure(_Figure):
    """Figure that a notebook displays inline. The figure needs no window and shares no state with other figures."""

    def _repr_svg_(self) -> str:
        return render(self, ".svg").decode("utf-8")


Figure = ShownFigure


def render(figure: _Figure, suffix: str, dots: float = 100.0, theme: ThemeName = "light") -> bytes:
    """Return a figure as the bytes of an image file, reproducible with the same release of matplotlib.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Figure from any function of this package.
    suffix : {".svg", ".png", ".pdf"}
        File format.
    dots : float
        Resolution of a .png [dots per inch], above 0.
    theme : {"light", "dark", "print"}
        Colours on white, colours on a dark background, or black and greys for print.

    Returns
    -------
    bytes
        Content of the file; control characters in names are escaped.

    Raises
    ------
    GearTrainError
        If the suffix is not supported.

    Examples
    --------
    >>> render(Figure(), ".png")[1:4], render(Figure(), ".pdf")[:4]
    (b'PNG', b'%PDF')
    """
    kind = suffix.lower()
    if kind not in SUFFIXES:
        what = f"a plot cannot be written as {suffix or 'a file without suffix'}"
        raise GearTrainError(Problem(what, "the suffix determines the format", f"use one of {', '.join(SUFFIXES)}"))
    for text in _texts(figure):
        if (shown := printable(text.get_text())) != text.get_text():
            text.set_text(shown)
    buffer = BytesIO()
    with _ONE_AT_A_TIME, rc_context({"svg.hashsalt": "geartrain"}), themed(figure, theme):
        if figure.get_layout_engine():
            figure.draw_without_rendering()  # another layout has other ticks, whose labels change the layout again
        figure.savefig(buffer, format=kind[1:], dpi=dots, metadata=_METADATA[kind])
    data = buffer.getvalue()
    if kind != ".svg":
        return data
    data = printable(data.decode("utf-8")).encode("utf-8")  # ids too, as XML forbids control characters
    return _PATH.sub(lambda path: _LONG.sub(rb"\1", path[0]), data)


def _texts(artist: Artist) -> Iterator[Text]:
    """Yield the text objects of an artist, except texts of hidden axes, whose ticks are not created yet."""
    for child in artist.get_children():
        if isinstance(child, Text):
            yield child
        elif not (isinstance(child, Axis) and not child.axes.axison):
            yield from _texts(child)


WIDTH = 9.0  # inches: 900 pixels at 100 dots per inch
TEXT, SMALL, FINE = 11.0, 10.0, 8.0  # points; FINE is the minimum

_LIGHT = THEMES["light"]
BLACK, GREY, PALE, WHITE, RED = _LIGHT.ink, _LIGHT.quiet, _LIGHT.line, _LIGHT.paper, _LIGHT.fault
FILL, SHADE, SKY = _LIGHT.fill, _LIGHT.shade, _LIGHT.band
BLUE, ORANGE, PURPLE, GREEN = _LIGHT.series[:4]
"""Colours of wheels, of carriers, of couplings, and of other parts next to couplings."""
SCALE = SCALES["light"]
"""Colour scale of values on a map in the light theme."""
HALO = (withStroke(linewidth=3.0, foreground=WHITE),)  # keeps text readable over lines
_STEP, _CELL = 0.3, 58.0  # height of a row [in], and width of a column of cells [pt]
_WIDTHS = (1.4, 5.0)  # widths of the lines of intervals [pt], the widest interval first
MOST_ROWS = 20
"""Maximum number of rows of a chart of intervals at which the chart fits on a screen."""
LETTER = 0.62 / 72  # mean width of a letter [in] per point of font size


def series_look(at: int) -> dict[str, Any]:
    """Return the colour and dash pattern of the series with index `at`, as keyword arguments of matplotlib lines."""
    return {"color": series_colour(at), "linestyle": series_dash(at)}


def plain(axes: Axes) -> None:
    """Set the style of a panel: uniform text size, a light grid, and no frame at the top and at the right."""
    axes.tick_params(labelsize=SMALL)
    axes.grid(True, color=PALE, linewidth=0.5, alpha=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def name_axes(axes: Axes, x: str = "", y: str = "", title: str = "", size: float = TEXT, **how: Any) -> None:
    """Write the labels of the axes and the title of a panel. Further text properties are given in `how`."""
    if x:
        axes.set_xlabel(x, fontsize=size, **how)
    if y:
        axes.set_ylabel(y, fontsize=size, **how)
    if title:
        axes.set_title(title, fontsize=size, loc="left", color=BLACK, **how)


def curve_panels(heights: Sequence[float], margin: float = 0.0, share: bool = True) -> tuple[Figure, list[Axes]]:
    """Return a figure and its panels for curves, one below the other, with a common abscissa if `share` is True.

    heights   heights of the panels [in]
    margin    additional height of the figure [in]
    """
    figure = Figure(figsize=(WIDTH, margin + sum(heights)), layout="constrained")
    panels = figure.subplots(len(heights), 1, sharex=share, squeeze=False, height_ratios=heights)[:, 0]
    for axes in panels:
        plain(axes)
    return figure, list(panels)


class Row(NamedTuple):
    """Row of a chart: its name, its marks, its intervals, and the texts to its right."""

    name: str
    marks: Mapping[str, float]
    """Value of each mark in the row, keyed by series."""
    spans: Sequence[tuple[float, float]] = ()
    """Ends of the intervals in the row, the widest first; each is drawn thicker than the one before it."""
    beside: Sequence[str] = ()
    """Texts of the cells to the right of the row."""


DOT: Mapping[str, Any] = {"marker": "o", "markersize": 6, "color": BLACK, "markeredgecolor": WHITE}
"""Properties of the marks in a chart that has only one series."""


def interval_chart(
    panels: Mapping[str, Sequence[Row]],
    looks: Mapping[str, Mapping[str, Any]],
    heads: Sequence[str] = (),
    title: str = "",
    log: bool = False,
) -> Figure:
    """Return a chart of marks and intervals with one panel for each key of `panels`, which labels its axis.

    looks   matplotlib properties of the marks, keyed by series
    heads   heads of the cells next to the rows
    log     True for logarithmic axes
    """
    panels = {label: rows for label, rows in panels.items() if rows}
    heights = [0.9 + _STEP * len(rows) for rows in panels.values()]
    figure, axes = curve_panels(heights, 0.7, share=False)
    for panel, (label, rows) in zip(axes, panels.items(), strict=True):
        if log:
            panel.set_xscale("log")
            panel.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        draw_rows(panel, rows, looks, heads)
        name_axes(panel, label, size=SMALL, parse_math=False)
    if len(looks) > 1:
        known = {line.get_label(): line for panel in axes for line in panel.lines if line.get_label() in looks}
        legend_below(figure, len(known), list(known.values()))
    return headed(figure, title)


def draw_rows(
    axes: Axes, rows: Sequence[Row], looks: Mapping[str, Mapping[str, Any]], heads: Sequence[str] = ()
) -> None:
    """Draw the marks and intervals of the rows of a panel, and text cells to the right of the panel."""
    axes.grid(False, axis="y")
    axes.set_yticks(range(len(rows)), [short(row.name, 30) for row in rows], parse_math=False)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    for at, row in enumerate(rows):
        for width, ends in zip(_WIDTHS, row.spans, strict=False):
            look: dict[str, Any] = {"linewidth": width, "solid_capstyle": "butt", "zorder": 1 + width / 10}
            axes.plot(ends, [at, at], color=SHADE if width == _WIDTHS[1] else GREY, gid="interval", **look)
    for name, own in looks.items():
        places = [(row.marks[name], at) for at, row in enumerate(rows) if name in row.marks]
        if places:
            axes.plot(*zip(*places, strict=True), linewidth=0, label=name, gid=name, zorder=3, clip_on=False, **own)
    for at, cells in enumerate((heads, *(row.beside for row in rows)), -1):
        for column, text in enumerate(cells, 1):
            axes.annotate(
                text, (1.0, max(at, -0.75)), xycoords=axes.get_yaxis_transform(), xytext=(_CELL * column, 0),
                textcoords="offset points", ha="right", va="center", fontsize=SMALL, color=BLACK if at >= 0 else GREY,
                annotation_clip=False, parse_math=False, gid="cell",
            )  # fmt: skip


def figures(value: float) -> str:
    """Format a value with three significant digits and no power of ten; large values are formatted as integers."""
    return f"{value:.3g}" if not 1000 <= abs(value) < 1e9 else f"{value:.0f}"


def colour_bar(figure: Figure, axes: Axes, mesh: Any, name: str, **how: Any) -> None:
    """Draw the colour scale next to a map. Tick labels of the map and of the colour scale have the same size."""
    bar = figure.colorbar(mesh, ax=axes, pad=0.02, **how)
    bar.set_label(name, fontsize=TEXT)
    for each in (axes, bar.ax):
        each.tick_params(labelsize=SMALL)


def legend_below(
    figure: Figure,
    columns: int,
    handles: Sequence[Artist] | None = None,
    side: Literal["center", "left"] = "center",
    **how: Any,
) -> None:
    """Draw a legend below all panels. It contains the given handles or, if `handles` is None, all labelled artists."""
    how = {"fontsize": SMALL, "frameon": False, "ncols": columns, **how}
    if handles is not None:
        how["handles"] = handles
    figure.legend(loc="outside lower left" if side == "left" else "outside lower center", **how)


def legend_above(axes: Axes, columns: int) -> None:
    """Draw the legend of a panel above the panel, at the right."""
    how: dict[str, Any] = {"bbox_to_anchor": (1, 1), "borderpad": 0, "borderaxespad": 0.1, "frameon": False}
    axes.legend(loc="lower right", fontsize=SMALL, ncols=columns, **how)


def short(name: str, letters: int = 20) -> str:
    """Return a name shortened to at most `letters` characters."""
    return shorten(name, letters, placeholder="...")


def kept_extremes(values: Floats, most: int) -> Ints:
    """Return the indices of the positions to keep if a curve is thinned without losing its extremes.

    Each of about `most` / 3 intervals keeps its first position, its minimum and its maximum. All positions are kept if
    there are at most `most`.
    """
    if len(values) <= most:
        return np.arange(len(values))
    kept = []
    for part in np.array_split(np.arange(len(values)), most // 3):
        known = np.nan_to_num(values[part])
        kept += [part[0], part[known.argmin()], part[known.argmax()]]
    return np.unique([*kept, len(values) - 1])


def write(axes: Axes, x: float, y: float, text: str, color: str = BLACK, halo: float = 3.0, **how: Any) -> None:
    """Write a text without interpreting markup, with a halo."""
    # the halo is a separate text, because a single text with a halo would become outlines in a vector file
    how = {"ha": "center", "va": "center", "fontsize": SMALL, "color": color, "zorder": 8, "parse_math": False, **how}
    behind = {key: value for key, value in how.items() if key != "gid"}
    axes.text(x, y, text, path_effects=(Stroke(linewidth=halo, foreground=WHITE),), **behind)
    axes.text(x, y, text, **how)


def note(axes: Axes, text: str, at: tuple[float, float], offset: tuple[float, float], **how: Any) -> None:
    """Write text with a halo at an offset [pt] from a point of a panel.

    The text is to the right of the point if the horizontal offset is positive, or to the left if it is not.
    """
    how = {"ha": "left" if offset[0] > 0 else "right", "fontsize": SMALL, "path_effects": HALO, **how}
    axes.annotate(text, at, xytext=offset, textcoords="offset points", **how)


def sheet(width: float, height: float, title: str) -> tuple[Figure, Axes]:
    """Return a figure with one panel, whose coordinates are inches, and a title of at most two lines."""
    figure = Figure(figsize=(width, height), dpi=100)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(0.0, width)
    axes.set_ylim(0.0, height)
    axes.set_axis_off()
    room = int((width - 0.3) / (TEXT * LETTER))
    words = fill(title, max(room, 20)).splitlines()
    text = "\n".join(words[:2]) + (" ..." if len(words) > 2 else "")
    axes.text(0.15, height - 0.12, text, fontsize=TEXT, color=BLACK, va="top", parse_math=False, gid="title")
    return figure, axes


def headed(figure: Figure, title: str) -> Figure:
    """Return the figure with a title above all its panels, in as many lines as the figure's width requires."""
    letters = int(figure.get_size_inches()[0] / (TEXT * LETTER))
    title = "\n".join(line for part in title.splitlines() for line in wrap(part, letters))
    figure.suptitle(title, fontsize=TEXT, x=0.01, ha="left", color=BLACK, parse_math=False)
    return figure


def title_of(name: str, title: str) -> str:
    """Return the title above a picture of a train: the name of the train, followed by its title if there is one."""
    return f"{name}: {title}" if title else name


def after_turns(scene: Scene, turns: Fraction) -> str:
    """Return the end of a picture's title with the number of turns of the driving link; empty for 0 turns."""
    driver = "nothing" if scene.driving_link is None else scene.bodies[scene.driving_link].id
    return f", after {turns} turns of {driver}" if turns else ""


def too_many(train: GearTrain, count: int, most: int, what: str) -> None:
    """Raise `QuestionError` if `count` items of the kind `what` exceed `most`, the number that a picture can show."""
    if count > most:
        found, why = (
            f"'{train.name}' has {count} {what}, too many for this picture",
            f"at most {most} {what} are legible",
        )
        raise QuestionError(Problem(found, why, "draw a train with fewer parts, or another kind of picture"))
