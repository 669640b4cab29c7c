"""Draw docs/images/architecture.svg from the layers contract in pyproject.toml and the imports of the package."""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from textwrap import wrap
from xml.sax.saxutils import escape

import grimp
import networkx as nx

from geartrain.scene.palette import THEMES

DOCS = Path(__file__).resolve().parents[1]
PACKAGE = DOCS.parent / "geartrain"
WIDTH, HEIGHT, COLUMN, ROW = 218, 54, 246, 84
COLUMNS = {"spherical": 0.6, "scene": 2.0, "analysis": 2.0, "dynamics": 2.0, "wings": 2.4}
"""Columns of packages that are alone in their row and would hide an arrow in the middle."""
LETTERS = 36  # of a line in a box, which has two
LIGHT = THEMES["light"]
BOX = '<rect x="{x:.0f}" y="{y:.0f}" width="{w}" height="{h}" rx="6" fill="{fill}" stroke="{edge}" stroke-width="1.3"/>'
TEXT = '<text x="{x:.0f}" y="{y:.0f}" text-anchor="middle" {style}>{text}</text>'
LINE = '<path d="{d}" fill="none" stroke="{quiet}" stroke-width="1.4" marker-end="url(#end)"/>'


def layers() -> list[list[str]]:
    """Rooms from the top, those beside each other in one list, as the contract has them."""
    project = tomllib.loads((DOCS.parent / "pyproject.toml").read_text(encoding="utf-8"))
    contract = next(each for each in project["tool"]["importlinter"]["contracts"] if each["type"] == "layers")
    return [[room.strip() for room in layer.split("|")] for layer in contract["layers"]]


def arrows(rooms: set[str]) -> nx.DiGraph:
    """Which room imports from which, without the arrows that others imply (transitive reduction)."""
    imports = grimp.build_graph("geartrain")
    graph = nx.DiGraph()
    for module in imports.modules:
        for target in imports.find_modules_directly_imported_by(module):
            one, other = (name.split(".")[1:2] for name in (module, target))
            if one != other and rooms.issuperset((*one, *other)) and one and other:
                graph.add_edge(one[0], other[0])
    return nx.transitive_reduction(graph)


def purpose(room: str) -> str:
    """The first clause of what the room says of itself; with the next one where it is short, cut at a comma if long."""
    path = PACKAGE / room / "__init__.py"
    said = ast.get_docstring(ast.parse((path if path.exists() else PACKAGE / f"{room}.py").read_text(encoding="utf-8")))
    assert said, room
    sentence = re.split(r"\.(?:\s|$)", said.replace("\n", " "))[0]
    clauses = re.split(r"(?<=[:;])\s", sentence)
    text = " ".join(clauses[: 2 if len(clauses[0].split()) < 4 else 1])
    while len(wrap(text, LETTERS)) > 2 and "," in text:
        text = text.rpartition(",")[0]
    return text.rstrip(":;,")


def places(rows: list[list[str]]) -> dict[str, tuple[float, float]]:
    """Middle of each room's box."""
    found = {}
    for at, row in enumerate(rows):
        for column, room in enumerate(row):
            x = COLUMNS.get(room, column + (4 - len(row)) / 2)
            found[room] = (COLUMN * (x + 0.5), ROW * (at + 0.5))
    return found


def line(start: tuple[float, float], end: tuple[float, float]) -> str:
    """A path from below one box to above another; past three rows and more it runs down first and comes in aside."""
    (x, y), (X, Y) = start, end
    below = f"M{x:.0f},{y + HEIGHT / 2:.0f}"
    if x != X and Y - y > 4 * ROW:
        side = X - WIDTH / 2 - 6 if x < X else X + WIDTH / 2 + 6
        turn = 60 if x < X else -60
        return f"{below} L{x:.0f},{Y - 60:.0f} Q{x:.0f},{Y:.0f} {x + turn:.0f},{Y:.0f} L{side:.0f},{Y:.0f}"
    return f"{below} L{X:.0f},{Y - HEIGHT / 2 - 6:.0f}"


def elements() -> Iterator[str]:
    """The picture, arrows beneath boxes."""
    rows = layers()
    rooms = set(chain.from_iterable(rows))
    where = places(rows)
    width, height = COLUMN * 4, ROW * len(rows)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        'font-family="sans-serif" role="img" aria-label="Packages of geartrain and their imports">'
    )
    yield '<defs><marker id="end" markerWidth="9" markerHeight="9" refX="6" refY="4" orient="auto">'
    yield f'<path d="M0,0 L8,4 L0,8 Z" fill="{LIGHT.quiet}"/></marker></defs>'
    yield f'<rect width="{width}" height="{height}" fill="white"/>'
    for one, other in sorted(arrows(rooms).edges):
        yield LINE.format(d=line(where[one], where[other]), quiet=LIGHT.quiet)
    for room, (x, y) in where.items():
        yield BOX.format(x=x - WIDTH / 2, y=y - HEIGHT / 2, w=WIDTH, h=HEIGHT, fill=LIGHT.fill, edge=LIGHT.ink)
        said = wrap(purpose(room), LETTERS)
        top = y - (4 if len(said) > 1 else -2)
        yield TEXT.format(x=x, y=top - 6, style='font-size="14" font-weight="bold"', text=room)
        for at, text in enumerate(said):
            yield TEXT.format(x=x, y=top + 10 + 13 * at, style='font-size="11"', text=escape(text))
    yield "</svg>"


def main() -> None:
    """Write the picture."""
    (DOCS / "images" / "architecture.svg").write_text("\n".join(elements()) + "\n", encoding="utf-8")
    print("wrote docs/images/architecture.svg")


if __name__ == "__main__":
    main()
