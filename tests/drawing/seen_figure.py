"""Legibility of figures besides their text: entries of a legend that look alike, and legends that cover curves."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from geartrain.drawing.theme_colours import themed
from geartrain.scene import THEMES

_LINE, _AREA = 70.0, 15.0  # grey levels of 255: minimum difference of lines and of areas that are distinguishable
_WIDTH = 1.6  # ratio of two distinguishable line widths
_SIZE = 1.3  # ratio of two distinguishable marker sizes


KINDS = ("plan", "stick", "graph", "lever", "dials")
"""Kinds of pictures of a train, as the refusal of another one lists them."""


def in_theme(figure: Figure, theme: Any) -> AbstractContextManager[Any]:
    """Return a context in which a figure has the colours of a theme."""
    return themed(figure, theme)


def palette(theme: str) -> Any:
    """Return the colours of a theme."""
    return THEMES[theme]  # type: ignore[index]


def alike(figure: Figure, theme: Any = "print") -> list[tuple[str, str]]:
    """Return the pairs of entries of one legend that are not distinguishable in a theme."""
    with themed(figure, theme):
        return [
            (one.get_text(), other.get_text())
            for legend in legends(figure)
            for (one, first), (other, second) in combinations(
                zip(legend.get_texts(), legend.legend_handles, strict=True), 2
            )
            if _same(first, second)
        ]


def legends(figure: Figure) -> Iterator[Legend]:
    """Yield all legends of a figure and of its axes."""
    yield from figure.legends
    for axes in figure.axes:
        if (own := axes.get_legend()) is not None:
            yield own


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, Line2D) and isinstance(other, Line2D):
        return _same_lines(one, other)
    if isinstance(one, Patch) and isinstance(other, Patch):
        return one.get_hatch() == other.get_hatch() and _apart(_seen(one), _seen(other)) < _AREA
    return False


def _same_lines(one: Line2D, other: Line2D) -> bool:
    if one.get_marker() != other.get_marker() or bool(one.get_linewidth()) != bool(other.get_linewidth()):
        return False
    if one.get_marker() not in ("None", None, "") and not one.get_linewidth():
        sizes = sorted((one.get_markersize(), other.get_markersize()))
        return sizes[1] < _SIZE * sizes[0] and _apart(one.get_color(), other.get_color()) < _LINE
    widths = sorted((one.get_linewidth(), other.get_linewidth()))
    dashes = [str(line._unscaled_dash_pattern) for line in (one, other)]  # type: ignore[attr-defined]
    return (
        widths[1] < _WIDTH * widths[0] and dashes[0] == dashes[1] and _apart(one.get_color(), other.get_color()) < _LINE
    )


def _apart(one: Any, other: Any) -> float:
    """Return the maximum difference of two colours in one channel, of 255."""
    return 255 * float(np.abs(np.subtract(to_rgba(one)[:3], to_rgba(other)[:3])).max())


def _seen(patch: Patch) -> tuple[float, ...]:
    """Return the colour of a transparent area on white."""
    *rgb, alpha = to_rgba(patch.get_facecolor())
    return tuple(1 - alpha + alpha * channel for channel in rgb)


def hidden(figure: Figure) -> list[str]:
    """Return the first texts of legends in axes that cover a line, a marker, a filled area or a bar with an id.

    Lines and bands across a whole panel, maps and contours may be covered.
    """
    figure.draw_without_rendering()
    found = []
    for axes in figure.axes:
        legend = axes.get_legend()
        if legend is None:
            continue
        box = legend.get_window_extent()
        bars = any(box.overlaps(bar.get_window_extent()) for bar in axes.patches if bar.get_gid())
        if bars or _over_lines(axes, box) or _over_collections(axes, box):
            found.append(legend.get_texts()[0].get_text())
    return found


def _over_lines(axes: Axes, box: Bbox) -> bool:
    """Return True if a box [pixels] covers a marker or a segment of a line."""
    for line in axes.lines:
        seen = _seen_part(box, line)
        if line.get_transform() != axes.transData or seen is None:
            continue
        drawn = line.get_linestyle() != "None" and line.get_path().transformed(axes.transData)
        if _holds(seen, axes, line.get_xydata()) or (drawn and drawn.intersects_bbox(seen, filled=False)):
            return True
    return False


def _over_collections(axes: Axes, box: Bbox) -> bool:
    """Return True if a box [pixels] covers a marker, a line or a filled area of a collection."""
    for each in axes.collections:
        seen = _seen_part(box, each)
        if seen is None:
            continue
        if isinstance(each, PathCollection):
            if _holds(seen, axes, each.get_offsets()):
                return True
        elif isinstance(each, (LineCollection, PolyCollection)):
            filled = isinstance(each, PolyCollection)
            paths = (path.transformed(each.get_transform()) for path in each.get_paths())
            if any(np.size(path.vertices) and path.intersects_bbox(seen, filled=filled) for path in paths):
                return True
    return False


def _seen_part(box: Bbox, artist: Artist) -> Bbox | None:
    """Return the visible part of a box of an artist, which may be clipped by its axes."""
    cut = artist.get_clip_box() if artist.get_clip_on() else None
    return box if cut is None else Bbox.intersection(box, cut)


def _holds(box: Bbox, axes: Axes, places: Any) -> bool:
    """Return True if one of some points in data coordinates is within a box [pixels]."""
    points = axes.transData.transform(np.asarray(places, dtype=float).reshape(-1, 2))
    return bool(((points > box.min) & (points < box.max)).all(1).any())


def crowded(figure: Figure) -> list[tuple[str, str]]:
    """Return neighbouring tick labels that are closer than half a letter."""
    figure.draw_without_rendering()
    found = []
    for axes in figure.axes:
        words = [text for text in axes.get_xticklabels() if text.get_text() and text.get_visible() and axes.axison]
        boxes = sorted(((text.get_window_extent(), text) for text in words), key=lambda each: each[0].x0)
        for (one, left), (other, right) in pairwise(boxes):
            if other.x0 - one.x0 > 0 and other.x0 - one.x1 < 0.3 * float(left.get_fontsize()) * figure.dpi / 72:
                found.append((left.get_text(), right.get_text()))
    return found


def untitled(figure: Figure) -> bool:
    """Return True if a figure has no title."""
    titles = [figure.get_suptitle(), *(axes.get_title(where) for axes in figure.axes for where in ("left", "center"))]
    titles += [text.get_text() for text in _words(figure) if text.get_gid() == "title"]
    return not any(titles)


def _words(figure: Figure) -> Iterator[Text]:
    yield from figure.texts
    for axes in figure.axes:
        yield from axes.texts


def without_quantity(figure: Figure) -> list[str]:
    """Return the axes with numbers but without a label; for shared axes, only the last is examined."""
    found = []
    for at, axes in enumerate(figure.axes):
        if not axes.axison:
            continue
        labels = (
            (axes.xaxis, any(text.get_text() for text in axes.get_xticklabels())),
            (axes.yaxis, any(_number(text.get_text()) for text in axes.get_yticklabels())),
        )
        left = axes.get_position().x0
        below = [each.get_xlabel() for each in figure.axes if abs(each.get_position().x0 - left) < 0.02]
        for axis, numbers in labels:
            words = axis.get_label_text() or (any(below) if axis is axes.xaxis else axes.get_title("left"))
            if numbers and not words:
                found.append(f"{axis.axis_name} of panel {at}")
    return found


def _number(text: str) -> bool:
    try:
        float(text.replace("−", "-"))
    except ValueError:
        return False
    return True
