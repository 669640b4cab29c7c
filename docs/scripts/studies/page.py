"""What the makers of pages of accuracy share: the run they read or measure, prose with its numbers, a picture."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import Any, TypeVar

from geartrain.scene.palette import THEMES
from studies.records import StudyRecords

DOCS = Path(__file__).resolve().parents[2]
Records = TypeVar("Records", bound=StudyRecords)
_LIGHT = THEMES["light"]
INK, QUIET, LINE, PAPER, HUES = _LIGHT.ink, _LIGHT.quiet, _LIGHT.line, _LIGHT.paper, _LIGHT.series
"""Colours of pictures: the package's own."""


def read(kind: type[Records], *names: str) -> list[Records]:
    """Kept runs of a study."""
    texts = ((DOCS / "data" / f"{name}.json").read_text(encoding="utf-8") for name in names)
    return [kind.from_dict(json.loads(text)) for text in texts]


def from_command_line(
    runs: Mapping[str, Callable[[], StudyRecords]], quick: Callable[[], StudyRecords], write: Callable[[], None]
) -> None:
    """Write a page; with `--measure` after its runs were made anew, with `--quick` print a short run instead.

    runs   name of the file under docs/data/ -> the study that fills it
    """
    requested = argparse.ArgumentParser(description="Write a page from its kept run.")
    requested.add_argument("--measure", action="store_true", help="make the run anew, which takes minutes to hours")
    requested.add_argument("--quick", action="store_true", help="print the tables of a short run, and write nothing")
    given = requested.parse_args()
    if given.quick:
        print(quick().to_markdown())
        return
    for name, study in runs.items() if given.measure else ():
        text = json.dumps(study().to_dict(), indent=2, ensure_ascii=False, allow_nan=False)
        (DOCS / "data" / f"{name}.json").write_text(text + "\n", encoding="utf-8")
    write()


def write_page(name: str, parts: Sequence[str]) -> None:
    """docs/NAME-accuracy.md from its parts."""
    (DOCS / f"{name}.md").write_text("\n".join(parts), encoding="utf-8")
    print(f"wrote docs/{name}.md")


def lowered(lines: Sequence[str]) -> str:
    """Tables of a study, their headings a level lower."""
    return "\n".join(lines).replace("## ", "### ")


def paragraphs(text: str, **numbers: object) -> str:
    """Text with its numbers, each paragraph or point filled."""
    parts = text.format(**numbers).strip().split("\n\n")
    filled = (
        fill(part, 120, subsequent_indent="  " if part[:2] == "- " else "", break_on_hyphens=False) for part in parts
    )
    return "\n\n".join(filled) + "\n"


def number(value: float, form: str = ".2g") -> str:
    """Two digits, without powers of ten where a reader can do without."""
    return f"{float(f'{value:.2g}'):,.0f}" if 10 <= value < 1e6 else f"{value:{form}}"


def span(values: Sequence[float], form: str | Callable[[float], str] = ".2g") -> str:
    """Least to greatest, or one number where both are written alike; `form` for `number`, or what writes a number."""
    write = form if callable(form) else lambda value: number(value, form)
    minimum, maximum = write(min(values)), write(max(values))
    return minimum if minimum == maximum else f"{minimum} to {maximum}"


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
            ax.spines[["top", "right"]].set_visible(False)
        figure.savefig(DOCS / "images" / f"{name}.svg", metadata={"Date": None})
        plt.close(figure)
    print(f"wrote docs/images/{name}.svg")
