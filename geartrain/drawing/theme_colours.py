"""Conversion of a figure from the colours of the light theme, in which all figures are drawn, to another theme."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection, PolyCollection
from matplotlib.colors import Colormap, LinearSegmentedColormap, ListedColormap, to_hex, to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Patch
from matplotlib.text import Text

from geartrain.scene.palette import THEMES, Theme, ThemeName

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Rgba = tuple[float, float, float, float]
_SHADES = 256  # colours of a scale
_ROUNDED = 0.5 / 255  # rounding error of a colour written with two hexadecimal digits per channel
_AREA = 0.5  # opacity above which a series colour fills an area that needs its own hatch, not a background band
SCALES = {name: LinearSegmentedColormap.from_list(name, theme.scale, _SHADES) for name, theme in THEMES.items()}
"""Colour scales of values on maps, keyed by theme."""
_COLOURS = ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor")
_LUMA = np.array([0.2126, 0.7152, 0.0722])  # weights of red, green and blue in lightness (ITU-R BT.709)


@contextmanager
def themed(figure: Figure, name: ThemeName) -> Iterator[None]:
    """Convert the figure to the colours of a theme within a `with` block, and restore the light colours afterwards."""
    if name == "light":
        yield
        return
    figure.draw_without_rendering()  # ticks and their labels are created on the first drawing
    painter = _Painter(name)
    try:
        painter.paint(figure)
        yield
    finally:
        for put, old in reversed(painter.undo):
            put(old)


def _all(artist: Artist) -> Iterator[Artist]:
    yield artist
    box = artist.get_bbox_patch() if isinstance(artist, Text) else None
    for part in (box, getattr(artist, "arrow_patch", None)):  # not children of their text
        if part is not None:
            yield part
    for child in artist.get_children():
        yield from _all(child)


class _Painter:
    """Recolouring of artists for a theme, with a list of changes to be undone."""

    def __init__(self, name: ThemeName) -> None:
        self.name = name
        self.undo: list[tuple[Callable[[Any], object], Any]] = []
        self._halos: list[object] = []  # converted once, as texts share them
        self._scales: list[Colormap] = []  # converted scales, as a colour bar shares the scale of its map

    def paint(self, figure: Figure) -> None:
        """Convert the colours and colour scales of all artists of a figure."""
        for artist in _all(figure):
            if isinstance(artist, Collection) and artist.get_array() is not None:
                self._scale(artist)
            elif not isinstance(artist, (Figure, Axes)):  # their patches have their colours
                self._colours(artist)
            for effect in artist.get_path_effects() or ():
                self._halo(effect)
        # ticks that will be created later, because a file of another resolution may have more ticks
        for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
            if (old := axis.get_tick_params().get("grid_color")) is not None:
                new = to_hex(themed_colour(to_rgba(old), self.name))
                self._put(partial(_set_grid, axis), old, new)

    def _put(self, put: Callable[[Any], object], old: Any, new: Any) -> None:
        self.undo.append((put, old))
        put(new)

    def _scale(self, artist: Collection) -> None:
        old: Any = artist.get_cmap()
        if old in self._scales:
            return
        if old == SCALES["light"]:
            new: Colormap = SCALES[self.name]
        else:
            rows = old(np.linspace(0, 1, _SHADES))
            new = ListedColormap([themed_colour(tuple(map(float, row)), self.name) for row in rows])  # type: ignore[arg-type]
        self._scales.append(new)
        self._put(artist.set_cmap, old, new)

    def _colours(self, artist: Artist) -> None:
        area = _area_of(artist, self.name)
        kinds = [kind for kind in _COLOURS if hasattr(artist, f"get_{kind}") and hasattr(artist, f"set_{kind}")]
        # read before any is set, as a marker follows its line
        olds = [getattr(artist, f"get_{kind}")() for kind in kinds]
        for kind, old in zip(kinds, olds, strict=True):
            self._put(getattr(artist, f"set_{kind}"), old, _themed_all(old, self.name))
        if area is not None:
            self._fill(artist, *area)

    def _fill(self, artist: Any, colour: Rgba, hatch: str) -> None:
        """Fill an area with a colour and a hatch; draw the outline and the hatch in the ink colour of the theme."""
        self._put(artist.set_facecolor, artist.get_facecolor(), colour)
        self._put(artist.set_edgecolor, artist.get_edgecolor(), THEMES[self.name].ink)
        if hasattr(artist, "set_hatchcolor"):  # from matplotlib 3.11 on, hatch and edge have separate colours
            self._put(artist.set_hatchcolor, artist.get_hatchcolor(), THEMES[self.name].ink)
        self._put(artist.set_hatch, artist.get_hatch(), hatch or artist.get_hatch())

    def _halo(self, effect: object) -> None:
        gc = getattr(effect, "_gc", {})  # matplotlib has no public accessor for the colour of a stroke
        if "foreground" in gc and not any(gc is known for known in self._halos):
            self._halos.append(gc)
            old = gc["foreground"]
            self._put(partial(gc.__setitem__, "foreground"), old, to_hex(themed_colour(to_rgba(old), self.name)))


def _set_grid(axis: Axis, colour: Any) -> None:
    axis.set_tick_params(grid_color=colour)


def _area_of(artist: Artist, name: ThemeName) -> tuple[Rgba, str] | None:
    """Return the fill colour and hatch of an area that has a colour of a data series; None if it has none."""
    areas = THEMES[name].areas
    if not areas or isinstance(artist, (Circle, FancyArrowPatch)) or not isinstance(artist, (Patch, PolyCollection)):
        return None
    faces = np.asarray(artist.get_facecolor()).reshape(-1, 4)
    if len(faces) != 1 or faces[0, 3] <= _AREA:
        return None
    own, series = to_hex(tuple(map(float, faces[0, :3]))), THEMES["light"].series  # type: ignore[arg-type]
    if own not in series:
        return None
    colour, hatch = areas[series.index(own)]
    red, green, blue = map(float, _rgb_of(colour))
    return (red, green, blue, float(faces[0, 3])), hatch


def _themed_all(colours: Any, name: ThemeName) -> Any:
    """Return the theme's equivalents of `colours`, which is one colour or an array with one colour per row."""
    if isinstance(colours, np.ndarray) and colours.ndim == 2:
        return [themed_colour(tuple(map(float, row)), name) for row in colours]  # type: ignore[arg-type]
    unset = isinstance(colours, str) and colours in ("none", "auto")
    return colours if unset else themed_colour(to_rgba(colours), name)


def themed_colour(colour: Rgba, name: ThemeName) -> Rgba:
    """Return the theme's equivalent of a colour of the light theme.

    A colour of the palette becomes the palette colour of the theme, and a mixture of the two face colours becomes the
    same mixture. Any other colour is converted to the same relative lightness between paper and ink.
    """
    light, theme = THEMES["light"], THEMES[name]
    known = dict(zip(_named(light), _named(theme), strict=True))
    found, own = known.get(to_hex(colour[:3])), np.array(colour[:3])
    shade, along = _rgb_of(light.shade), _rgb_of(light.fill) - _rgb_of(light.shade)
    share = float((own - shade) @ along / (along @ along))
    if found:
        rgb = _rgb_of(found)
    elif 0.0 <= share <= 1.0 and np.abs(shade + share * along - own).max() <= _ROUNDED:
        rgb = _rgb_of(theme.shade) + share * (_rgb_of(theme.fill) - _rgb_of(theme.shade))
    else:
        paper, ink, lightness = _rgb_of(theme.paper), _rgb_of(theme.ink), float(_LUMA @ own)
        hue = 0.0 if name == "print" else own - lightness
        rgb = np.clip(ink + lightness * (paper - ink) + hue, 0.0, 1.0)
    red, green, blue = map(float, rgb)
    return red, green, blue, colour[3]


def _rgb_of(colour: str) -> Floats:
    return np.array(to_rgba(colour)[:3])


def _named(theme: Theme) -> Sequence[str]:
    own = (theme.paper, theme.ink, theme.quiet, theme.line, theme.fault, theme.fill, theme.shade, theme.band)
    return (*theme.series, *own)
