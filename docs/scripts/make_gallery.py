"""Write the gallery of shipped trains from what they answer: `python docs/scripts/make_gallery.py`.

The site turns each row into a card with the train's picture, a page in which it turns, and its report.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import geartrain
from geartrain import Answer, GearTrain
from geartrain.report.document import exact

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "gallery.md"
GROUPS = {
    "antikythera": "The Antikythera mechanism",
    "historic": "Clocks, calendars and other old machines",
    "engineering": "Gearboxes, loops and puzzles",
}
LEAD = """# Gallery

This page lists all shipped trains, each with the speed of its first output and the number of further outputs (`+20`).
All trains are determined unless otherwise noted. The [site](contributing.md#documentation) shows the plan, the dials,
the animated page and the report of each train; `geartrain view NAME -o x.html` writes the animated page. The files are
in `trains/`; each file cites its sources.
"""
MOST = 1


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    print(f"wrote {PAGE.relative_to(ROOT)}")


def page() -> str:
    """The page: a table for each folder of trains."""
    return LEAD + "".join(line for folder, title in GROUPS.items() for line in _group(folder, title))


def _group(folder: str, title: str) -> Iterator[str]:
    yield f"\n## {title}\n\n| train | what it is | speed of an output |\n|---|---|---|\n"
    for path in sorted((ROOT / "trains" / folder).glob("*.yaml")):
        train = geartrain.load(path)
        answers = list(train.answers())
        cells = (path.stem, train.declaration.title or "", _verdict(train, answers) + _outputs(answers))
        yield f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |\n"


def _verdict(train: GearTrain, answers: list[Answer]) -> str:
    """Return all that differs from a determined train."""
    kinds = dict.fromkeys(answer.verdict.kind for answer in answers)
    words = [kind for kind in kinds if kind != "determined"]
    if any(mesh.fault for mesh in train.meshes):
        words.append("teeth cannot turn")
    return "".join(f"{word}; " for word in words)


def _outputs(answers: list[Answer]) -> str:
    """Return the first outputs with their speeds if there is one state; pointers before others."""
    if len(answers) > 1:
        return f"{len(answers)} states"
    results = sorted(answers[0].outputs.values(), key=lambda result: not (result.output.dial or result.targets))
    shown = [f"{result.name} {exact(result.speed)}" for result in results[:MOST]]
    return ", ".join(shown) + (f", +{len(results) - MOST}" if len(results) > MOST else "")


if __name__ == "__main__":
    main()
