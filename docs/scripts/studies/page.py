"""Pages of accuracy: the command line of their scripts, text with its numbers, pictures."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import Any

from geartrain.scene.palette import THEMES
from studies.records import DATA, StudyRecords

DOCS = Path(__file__).resolve().parents[2]
_LIGHT = THEMES["light"]
INK, QUIET, LINE, HUES = _LIGHT.ink, _LIGHT.quiet, _LIGHT.line, _LIGHT.series
"""Colours of pictures: the package's own."""


def from_command_line(runs: Mapping[str, Callable[[], StudyRecords]], write: Callable[[], None]) -> None:
    """Write pages; with `--measure` after some studies have been run again.

    runs   name of the file in docs/data/ -> the study that fills it
    """
    requested = argparse.ArgumentParser(description="Write pages from the data in docs/data/.")
    requested.add_argument(
        "--measure", nargs="+", metavar="STUDY", choices=[*runs], default=[], help="run these studies again first"
    )
    for name in requested.parse_args().measure:
        print(f"{name}: measuring, which takes minutes to hours", file=sys.stderr)
        (DATA / f"{name}.json").write_text(runs[name]().text(), encoding="utf-8")
    write()


def with_numbers(text: str, numbers: Mapping[str, object]) -> str:
    """Markdown with its numbers; paragraphs and list items are filled to 120 columns, other blocks stay as they are."""
    blocks = (block.format(**numbers) for block in text.strip().split("\n\n"))
    return "\n\n".join(block if block.startswith(("|", "#", "!", "    ", "$$")) else _filled(block) for block in blocks)


def _filled(block: str) -> str:
    return fill(block, 120, subsequent_indent="  " if block.startswith("- ") else "", break_on_hyphens=False)


@contextmanager
def picture(name: str, *panels: int, **options: Any) -> Iterator[tuple[Any, Any]]:
    """A figure and its panels for docs/images/NAME.svg, the same bytes whenever it is drawn from the same run."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot as plt

    style: Any = {
        "font.size": 11,
        "svg.hashsalt": name.split("-")[0],
        "svg.fonttype": "none",
        "font.family": "sans-serif",
        **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), INK),
    }
    with plt.rc_context(style):
        figure, axes = plt.subplots(*panels, layout="constrained", **options)
        yield figure, axes
        for ax in axes.flat:
            ax.grid(color=LINE, lw=0.5, alpha=0.6)
            ax.set_axisbelow(True)
            ax.spines[["top", "right"]].set_visible(False)
        figure.savefig(DOCS / "images" / f"{name}.svg", metadata={"Date": None})
        plt.close(figure)


def error_over_time(
    ax: Any, title: str, unit: str, series: Mapping[str, list[tuple[float, float]]], minimum: float = 0.0
) -> None:
    """A panel with a line for each method: its (seconds, error); errors below `minimum` are drawn there."""
    from matplotlib.ticker import NullFormatter

    marks, times = "osD^vPX*", [seconds for points in series.values() for seconds, _ in points]
    for at, (name, points) in enumerate(series.items()):
        x, y = zip(*((seconds, max(error, minimum)) for seconds, error in points), strict=True)
        ax.plot(x, y, color=HUES[at % len(HUES)], marker=marks[at], ms=6, lw=1.4, label=name)
    ax.set(xscale="log", yscale="log", xlabel="seconds", ylabel=unit, xlim=(min(times) / 2, max(times) * 2))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_title(title, fontsize=11)
    ax.legend(frameon=False, fontsize=8.5)
