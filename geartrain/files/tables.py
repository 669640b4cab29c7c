"""Small tables of a user's own: points, and edges of a graph, one a line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from geartrain.errors import GearTrainError, Problem


def read_points(path: Path) -> list[tuple[float, float, float]]:
    """Three numbers a line, parted by blanks or commas; `#` begins a remark. Raises `GearTrainError` with the lines."""
    points: list[tuple[float, float, float]] = []
    problems = []
    for at, words in _rows(path):
        try:
            x, y, z = map(float, words)
        except ValueError:
            text = f"'{' '.join(words)}' is no point"
            problems.append(Problem(text, "a point is three numbers", "write x y z", f"{path}:{at}"))
        else:
            points.append((x, y, z))
    if problems:
        raise GearTrainError(problems)
    return points


def read_edges(path: Path) -> list[tuple[str, str]]:
    """Two names a line, parted by blanks or commas. Raises `GearTrainError` with the lines at fault."""
    edges: list[tuple[str, str]] = []
    problems = []
    for at, words in _rows(path):
        if len(words) == 2:
            edges.append((words[0], words[1]))
        else:
            text = f"'{' '.join(words)}' is no mesh"
            problems.append(Problem(text, "a mesh is two names", "write the two gears", f"{path}:{at}"))
    if problems:
        raise GearTrainError(problems)
    return edges


def _rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise GearTrainError(Problem("the file cannot be read", str(why), "check its name", str(path))) from None
    for at, line in enumerate(text.splitlines(), 1):
        if words := line.partition("#")[0].replace(",", " ").split():
            yield at, words
