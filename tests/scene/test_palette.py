"""Colours of the palette are distinguishable, also with colour vision deficiencies, and are defined once."""

from __future__ import annotations

import importlib.util
import re
from itertools import combinations
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from geartrain.scene import THEMES, series_colour, series_dash

ROOT = Path(__file__).resolve().parents[2]
Vector = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
# Machado, Oliveira and Fernandes 2009, table 1, severity 1.0; linear RGB
SIGHT = {
    "all colours": np.eye(3),
    "no red": np.array([[0.152286, 1.052583, -0.204868],
                        [0.114503, 0.786281, 0.099216],
                        [-0.003882, -0.048116, 1.051998]]),
    "no green": np.array([[0.367322, 0.860646, -0.227968],
                          [0.280085, 0.672501, 0.047413],
                          [-0.011820, 0.042940, 0.968881]]),
    "no blue": np.array([[1.255528, -0.076749, -0.178779],
                         [-0.078411, 0.930809, 0.147602],
                         [0.004733, 0.691367, 0.303900]]),
}  # fmt: skip
# distance in CIE L*a*b* (CIE 1976), of which 2.3 is just noticeable
MINIMUM = {"all colours": 16.0, "no red": 13.0, "no green": 13.0, "no blue": 8.5}
XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
WHITE = np.array([0.95047, 1.0, 1.08883])


def linear(colour: str) -> Vector:
    rgb = np.array([int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)])
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(rgb: Vector) -> Vector:
    t = XYZ @ np.clip(rgb, 0, 1) / WHITE
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of WCAG 2.2."""
    dark, light = sorted(float(XYZ[1] @ linear(each)) for each in (one, other))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("sight", SIGHT)
@pytest.mark.parametrize("name", ["light", "dark"])
def test_any_two_series_and_the_ink_are_told_apart(name: str, sight: str) -> None:
    theme = THEMES[name]  # type: ignore[index]
    seen = {colour: lab(SIGHT[sight] @ linear(colour)) for colour in (*theme.series, theme.ink)}
    close = {(a, b): float(np.linalg.norm(seen[a] - seen[b])) for a, b in combinations(seen, 2)}
    assert min(close.values()) > MINIMUM[sight], min(close, key=lambda pair: close[pair])


@pytest.mark.parametrize("name", THEMES)
def test_every_colour_of_words_can_be_read_on_its_paper(name: str) -> None:
    theme = THEMES[name]  # type: ignore[index]
    for colour in (*theme.series, theme.ink, theme.quiet, theme.fault, theme.accent):
        assert contrast(colour, theme.paper) > 4.5, colour
        assert contrast(colour, theme.desk) > 4.4, colour
    for face in (theme.fill, theme.band):
        assert contrast(theme.ink, face) > 4.5, face


def test_colour_and_dashes_never_repeat_together() -> None:
    assert len({(series_colour(at), series_dash(at)) for at in range(70)}) == 70
    assert len({(series_colour(at, "print"), series_dash(at)) for at in range(10)}) == 10


def test_the_viewer_has_the_palette_of_the_package() -> None:
    for name, text in maker().files().items():
        assert (ROOT / "geartrain" / "viewer" / "src" / name).read_text(encoding="utf-8") == text


def test_pages_and_the_built_viewer_hold_no_other_colours_of_series() -> None:
    built = (ROOT / "geartrain" / "viewer" / "built" / "viewer.css").read_text(encoding="utf-8")
    for name in ("light", "dark"):
        for at, colour in enumerate(THEMES[name].series):  # type: ignore[index]
            assert re.search(rf"--hand-{at}: ?{colour}[;}}]", built), (name, colour)


# materials and backgrounds, which need not be distinguishable by colour
MADE_OF = re.compile(
    r"^(?:export const (?:BRASS|PARTS) = .*|\s*--(?:stage|edge|gd-edge|on-accent|wash|bad-wash): .*)$", re.MULTILINE
)
GROUNDS = {"#f4f1ea", "#ffffff", "#9aa1ab"}


def sources() -> list[Path]:
    viewer, docs = ROOT / "geartrain" / "viewer" / "src", ROOT / "docs"
    plots = [
        *docs.glob("scripts/make_*.py"),
        *docs.glob("scripts/studies/*.py"),
        # colours of flat files are operations of a laser cutter
        *(path for path in (ROOT / "geartrain" / "drawing").rglob("*.py") if path.stem != "flat_files"),
    ]
    return [*viewer.rglob("*.js"), *viewer.rglob("*.css"), *plots]


def test_no_picture_has_a_colour_of_its_own() -> None:
    own = {each for theme in THEMES.values() for each in re.findall("#[0-9a-f]{6}", repr(theme))}
    found = {}
    for path in sources():
        text = MADE_OF.sub("", path.read_text(encoding="utf-8"))
        other = {each.lower() for each in re.findall(r"#[0-9A-Fa-f]{6}\b", text)} - own - GROUNDS
        if other:
            found[path.name] = other
    assert not found


def maker() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_palette", ROOT / "docs" / "scripts" / "make_palette.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
