"""All text in plots of results is legible, and plots of any number of pointers fit on a page."""

from __future__ import annotations

import re
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from commands import call

pytest.importorskip("matplotlib")

from seen_figure import alike, crowded, hidden, untitled, without_quantity
from written_text import read_picture

from geartrain.drawing import render

CUT = ["montecarlo", "moon-triangular", "--cutting", "pitch_deviation=2%"]
PAIR = ["mesh", 60, 30, "--form", "triangular"]
QUICK = [
    ["mesh", 60, 30, "--form", "triangular", "-p", "clearance_factor=1.05", "--vary", "friction=0:0.5:6"],
    ["mesh", 60, 30, "--form", "triangular", "--vary", "clearance_factor=1.01:1.2:7", "--vary", "friction=0:0.5:6"],
    ["mesh", 60, 30, "--form", "triangular", "-p", "clearance_factor=1.05"],
    ["mesh", 24, 36, "--form", "involute"],
    ["torques", "norton-compound"],
    ["sphere", "cube", "--teeth", "4=12"],
    ["motion", "moon-triangular", "--turns", "0.2", "--samples", 101],
    ["motion", "lathe-thread", "--turns", "2", "--samples", 101],
    ["torques", "planetary-24-18-60-triangular", "--turns", "1", "--samples", 200],
    *([*CUT, "--trials", 20, "--picture", picture] for picture in ("errors", "convergence", "pairs")),
    [*CUT, "--trials", 8, "--of", "moon", "--picture", "course"],
    [*CUT, "--trials", 8, "--of", "moon", "--sobol", "--picture", "sobol"],
    [*PAIR, "--objective", "loss", "--friction", "0.2", "--free", "window=0.4:0.6"],
    [*PAIR, "--objective", "jam,error", "--free", "window=0.4:0.6"],
    ["optimise", "moon-triangular", "--of", "moon", "--objective", "jam", "--free", "window"],
]  # fmt: skip
SLOW = [
    ["mesh", 60, 30, "--form", "triangular", "-p", "clearance_factor=1.05", "--at", "-5deg"],
    ["motion", "moon-triangular", "--of", "moon", "--turns", "0.2", "--samples", 101],
    ["motion", "nrel-grc-750", "--turns", "2", "--samples", 101],
    ["montecarlo", "freeth-2021-teeth", "--cutting", "pitch_deviation=2%", "--trials", 6, "--picture", "course",
     *("--of", "moon", "--of", "saturn", "--of", "mars")],
    ["montecarlo", "pennestri-2002-teeth", "--cutting", "pitch_deviation=2%", "--trials", 8, "--of", "moon", "--sobol",
     "--picture", "sobol"],
    ["optimise", "pennestri-2002-teeth", "--of", "moon", "--objective", "jam", "--free", "window"],
    ["montecarlo", "moon-triangular", "--cutting", "pitch_deviation=2%", "--trials", 20, "--picture", "map"],
    ["budget", "freeth-2021"],
    ["budget", "freeth-2008"],
    ["mesh", 48, 24, "--compare"],
    ["torques", "longcase-clock-loaded"],
    ["torques", "zf-9hp48", "--state", "1"],
    ["dynamics", "moon-triangular-inertia", "--rate", "1", "--turns", "0.02"],
    ["posterior", "freeth-2008-doubt"],
    ["mesh", 60, 8, "--form", "cycloidal"],
]  # fmt: skip


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures of one question are made in parallel, and two runs cannot write one journal."""
    monkeypatch.chdir(tmp_path)


def check(arguments: list[object], folder: Path, option: str = "--plot") -> None:
    target = folder / "plot.svg"
    with patch("geartrain.drawing.render", wraps=render) as drawn:
        result = call(*arguments, option, target)
    assert target.exists(), result.output
    (figure,) = drawn.call_args.args[:1]
    assert (alike(figure), hidden(figure), crowded(figure)) == ([], [], [])
    assert (untitled(figure), without_quantity(figure)) == (False, [])
    read = read_picture(target.read_bytes())
    assert read.texts
    assert (read.overlaps(), read.clipped(), read.small(8.0)) == ([], [], [])
    assert max(read.width, read.height) < 34 * 72
    for found in set(re.findall("#([0-9a-f]{6})", render(figure, ".svg", theme="print").decode())):
        assert np.ptp(list(bytes.fromhex(found))) < 20, found
    assert b"#ffffff" not in render(figure, ".svg", theme="dark"), "the paper of the light theme"


@pytest.mark.parametrize("arguments", QUICK, ids=lambda words: " ".join(map(str, words)))
def test_words_of_a_plot_can_be_read(arguments: list[object], tmp_path: Path) -> None:
    check(arguments, tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("arguments", SLOW, ids=lambda words: " ".join(map(str, words)))
def test_words_of_a_plot_of_much_can_be_read(arguments: list[object], tmp_path: Path) -> None:
    check(arguments, tmp_path)
