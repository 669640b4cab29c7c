"""Palette of drawings, plots, reports and pages, in a light, a dark and a print theme.

Series differ in colour and in dashes; `series_dash` gives the number of distinct combinations. In print, areas differ
in grey and hatch. Values are mapped to a scale of colours whose low end is close to the paper. In the light and the
dark theme, any two of the ten colours, and each colour and the ink, remain distinguishable for readers with protanopia
or deuteranopia (tests/scene/test_palette.py measures distances in CIE L*a*b* under the simulation of Machado, Oliveira
and Fernandes 2009, A physiologically-based model for simulation of color vision deficiency, IEEE Trans. Vis. Comput.
Graph. 15:1291). All colours have enough contrast to be read as text on their paper.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ThemeName = Literal["light", "dark", "print"]
Dash = Literal["-"] | tuple[int, tuple[float, ...]]

_DASHES: tuple[Dash, ...] = (
    "-",
    (0, (6, 2)),
    (0, (1.2, 1.4)),
    (0, (6, 1.6, 1.2, 1.6)),
    (0, (3, 1.2)),
    (0, (6, 1.6, 1.2, 1.6, 1.2, 1.6)),
    (0, (11, 3)),
)


@dataclass(frozen=True, slots=True)
class Theme:
    """Theme of drawings and pages: a colour, as #rrggbb, for each purpose."""

    desk: str
    """Background colour of a page, behind its cards."""
    paper: str
    """Background colour of drawings and text."""
    ink: str
    """Colour of lines and text."""
    quiet: str
    """Colour of secondary text."""
    line: str
    """Colour of secondary lines, such as grids and borders."""
    accent: str
    """Colour of headings and links of a page."""
    fault: str
    """Colour of errors and faulty parts."""
    fill: str
    """Colour of faces in a picture. `shade` is the colour of faces that are turned away, and `band` the colour of flows
    and marks.
    """
    shade: str
    band: str
    scale: tuple[str, str, str]
    """Colours of the minimum, the middle and the maximum of a scale of values; colours in between are interpolated."""
    series: tuple[str, ...]
    """Ten colours of curves and areas, in the order in which they are used."""
    areas: tuple[tuple[str, str], ...] = ()
    """Colour and matplotlib hatch of the area of each series; empty if areas have the colours of the series."""

    @property
    def css(self) -> str:
        """Theme as CSS custom properties of a page; `hand-N` is the colour of series N."""
        named = {
            "ink": self.ink,
            "quiet": self.quiet,
            "paper": self.desk,
            "card": self.paper,
            "line": self.line,
            "accent": self.accent,
            "bad": self.fault,
            **{f"hand-{at}": colour for at, colour in enumerate(self.series)},
        }
        return " ".join(f"--{name}: {colour};" for name, colour in named.items())


THEMES: dict[ThemeName, Theme] = {
    "light": Theme(
        desk="#fbfaf6",
        paper="#ffffff",
        ink="#211e18",
        quiet="#655f52",
        line="#c9c3b4",
        accent="#7a4a12",
        fault="#b3261e",
        fill="#edf3f9",
        shade="#6f97bd",
        band="#7fbce6",
        scale=("#edf3f9", "#7fbce6", "#0072b2"),
        series=(
            "#0072b2", "#a05a00", "#bb2288", "#227755", "#440088",
            "#772200", "#0000ee", "#dd2266", "#005544", "#442244",
        ),
    ),
    "dark": Theme(
        desk="#17150f",
        paper="#201d16",
        ink="#ece6d8",
        quiet="#b0a894",
        line="#4a4436",
        accent="#e5b06a",
        fault="#ff9a8f",
        fill="#43566a",
        shade="#253341",
        band="#2f6690",
        scale=("#253341", "#2f6690", "#6ab7ff"),
        series=(
            "#6ab7ff", "#ffb000", "#dd5577", "#bbbb88", "#6677ff",
            "#998800", "#aaeeff", "#cc99aa", "#eeffaa", "#aa77aa",
        ),
    ),
    "print": Theme(
        desk="#ffffff",
        paper="#ffffff",
        ink="#000000",
        quiet="#555555",
        line="#bbbbbb",
        accent="#000000",
        fault="#000000",
        fill="#f2f2f2",
        shade="#b8b8b8",
        band="#d8d8d8",
        scale=("#f6f6f6", "#b4b4b4", "#6e6e6e"),
        series=("#000000", "#737373") * 5,  # two greys: dashes repeat with the other one
        areas=(
            ("#555555", ""), ("#bbbbbb", ""), ("#ffffff", "/////"), ("#e4e4e4", ""), ("#ffffff", "xxxxx"),
            ("#ffffff", "-----"), ("#bbbbbb", "....."), ("#ffffff", "|||||"), ("#bbbbbb", "\\\\\\\\\\"),
            ("#ffffff", "....."),
        ),
    ),
}  # fmt: skip
"""Themes of drawings and pages, by name."""


def series_colour(at: int, theme: ThemeName = "light") -> str:
    """Return the colour of a series of a plot; colours repeat after ten series.

    Parameters
    ----------
    at : int
        Index of the series, counted from 0.
    theme : {"light", "dark", "print"}
        Theme of the plot.

    Returns
    -------
    str
        Colour as hexadecimal text.

    Examples
    --------
    >>> series_colour(0) == series_colour(10) == THEMES["light"].series[0]
    True
    """
    series = THEMES[theme].series
    return series[at % len(series)]


def series_dash(at: int) -> Dash:
    """Return the dash pattern of a series of a plot.

    There are 70 distinct combinations of colour and dash pattern, and 10 in the print theme.

    Parameters
    ----------
    at : int
        Index of the series, counted from 0.

    Returns
    -------
    str or tuple
        Dash pattern for matplotlib, in line widths.

    Examples
    --------
    >>> series_dash(0)
    '-'
    """
    return _DASHES[(at + at // len(THEMES["light"].series)) % len(_DASHES)]
