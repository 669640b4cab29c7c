"""Pictures in all themes: no colour of the light theme remains, and the figure itself is unchanged."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from fractions import Fraction
from io import BytesIO
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from commands import call
from shipped import train as load

pytest.importorskip("matplotlib")

from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle
from PIL import Image
from seen_figure import KINDS, in_theme, palette

from geartrain.drawing import picture, render

_COLOUR = re.compile(rb"#[0-9a-f]{6}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_dark_picture_has_no_colour_of_the_light_one_and_a_picture_for_print_is_grey(kind: str) -> None:
    figure = picture(load("planetary"), kind, load("planetary").states[0])  # type: ignore[arg-type]
    dark = {found.decode() for found in _COLOUR.findall(render(figure, ".svg", theme="dark"))}
    light = palette("light")
    assert not dark & {light.paper, light.ink, light.quiet, light.line, light.fault, *light.series, "#000000"}
    assert palette("dark").paper in dark
    for found in _COLOUR.findall(render(figure, ".svg", theme="print")):
        red, green, blue = (int(found[at : at + 2], 16) for at in (1, 3, 5))
        assert max(red, green, blue) - min(red, green, blue) <= 2, found


def test_values_with_a_scale_of_colours_are_grey_in_print_and_as_before_after_it() -> None:
    figure = Figure()
    figure.subplots().pcolormesh([[0.0, 0.5], [0.7, 1.0]], cmap="Blues")
    before = render(figure, ".svg")
    for found in _COLOUR.findall(render(figure, ".svg", theme="print")):
        assert max(bytes.fromhex(found[1:].decode())) - min(bytes.fromhex(found[1:].decode())) <= 2, found
    assert render(figure, ".svg") == before


def bars(width: int) -> Figure:
    """Return a figure with a bar of each series, 40 pixels high, with a pitch of 50 pixels."""
    figure = Figure(figsize=(5, 1), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, 500), ylim=(0, 100))
    axes.set_axis_off()
    for at in range(10):
        axes.add_patch(Rectangle((50 * at + 20, 30), width, 40, color=palette("light").series[at], linewidth=0))
    return figure


def look(crop: np.ndarray) -> np.ndarray:
    """Return the mean grey of a part of a picture, and its changes to the side, upwards and along both diagonals."""
    ways = (
        crop[:, 1:] - crop[:, :-1],
        crop[1:] - crop[:-1],
        crop[1:, 1:] - crop[:-1, :-1],
        crop[1:, :-1] - crop[:-1, 1:],
    )
    return np.array([crop.mean(), *(abs(way).mean() for way in ways)])


@pytest.mark.parametrize("width", [10, 24])
def test_areas_of_any_two_series_are_told_apart_in_print_however_short(width: int) -> None:
    """Two areas are distinguishable if their grey or their texture differs by a tenth of 255."""
    data = render(bars(width), ".png", theme="print")
    grey = np.asarray(Image.open(BytesIO(data)).convert("L"), dtype=float)
    looks = [look(grey[34:66, 50 * at + 22 : 50 * at + 18 + width]) for at in range(10)]
    apart = {pair: float(abs(looks[pair[0]] - looks[pair[1]]).max()) for pair in combinations(range(10), 2)}
    assert min(apart.values()) > 25.5, min(apart, key=lambda pair: apart[pair])


def test_areas_and_their_legend_have_one_filling_in_print_and_a_veil_has_none() -> None:
    figure = Figure()
    axes = figure.subplots()
    (bar,) = axes.bar([0], [1], color=palette("light").series[2])
    veil = axes.axhspan(0, 1, color=palette("light").series[2], alpha=0.2)
    (entry,) = axes.legend(handles=[Patch(color=palette("light").series[2], label="third")]).get_patches()
    before = render(figure, ".svg")
    with in_theme(figure, "print"):
        colour, hatch = palette("print").areas[2]
        assert [(to_hex(each.get_facecolor()), each.get_hatch()) for each in (bar, entry)] == [(colour, hatch)] * 2
        assert {to_hex(each.get_edgecolor()) for each in (bar, entry)} == {palette("print").ink}
        assert veil.get_hatch() is None
    for found in _COLOUR.findall(render(figure, ".svg", theme="print")):
        assert max(bytes.fromhex(found[1:].decode())) == min(bytes.fromhex(found[1:].decode())), found
    assert render(figure, ".svg") == before


def test_a_box_behind_words_is_of_the_paper_of_its_theme() -> None:
    figure = Figure()
    figure.text(0.5, 0.5, "words", bbox={"facecolor": palette("light").paper, "linewidth": 0})
    found = render(figure, ".svg", theme="dark")
    assert palette("light").paper.encode() not in found


def test_a_figure_is_as_it_was_after_a_theme() -> None:
    figure = picture(load("al-biruni-box-of-the-moon"), "plan", None, Fraction(1, 3))
    before = render(figure, ".svg")
    assert render(figure, ".svg", theme="dark") != before
    assert render(figure, ".svg", theme="print") != before
    assert render(figure, ".svg") == before


@pytest.mark.parametrize(
    ("theme", "paper"), [("light", (255, 255, 255)), ("dark", (32, 29, 22)), ("print", (255,) * 3)]
)
def test_the_command_draws_on_the_paper_of_its_theme(theme: str, paper: tuple[int, int, int], tmp_path: Path) -> None:
    target = tmp_path / "worm.png"
    assert call("draw", "worm", "-o", target, "--theme", theme).exit_code == 0
    assert tuple(np.asarray(Image.open(target).convert("RGB"))[0, 0]) == paper


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_a_layer_nearer_to_the_reader_is_lighter_in_every_theme(theme: str) -> None:
    """The wheels of the clock are in seven layers."""
    root = ET.fromstring(render(picture(load("longcase-clock"), "plan"), ".svg", theme=theme))  # type: ignore[arg-type]
    faces = []
    for group in root.iter("{http://www.w3.org/2000/svg}g"):
        if (group.get("id") or "").startswith("wheel "):
            (style,) = [path.get("style", "") for path in group.iter("{http://www.w3.org/2000/svg}path")]
            red, green, blue = (int(part, 16) for part in re.findall("fill: #(..)(..)(..)", style)[0])
            faces.append(0.2126 * red + 0.7152 * green + 0.0722 * blue)
    assert len(faces) == len(load("longcase-clock").declaration.wheels)
    assert faces == sorted(faces), "drawn from the farthest to the nearest"
    assert faces[-1] > faces[0] + 20
