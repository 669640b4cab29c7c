"""Tables to and from disk: long ones as CSV or Parquet, small ones as text.

Long tables are written piece by piece, under a name that says partial until they are whole; a CSV that was interrupted
is taken up again. Rows become the text of a CSV here and nowhere else. What a user has in small tables, points or the
edges of a graph, one a line, is read here.
"""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem, printable
from geartrain.numerics.files.atomic import destination, place, unfinished_file

PARTIAL_SUFFIX = "# partial: "


def partial_name(path: Path) -> Path:
    """`run.csv` -> `run.partial.csv`."""
    return path.with_name(f"{path.stem}.partial{path.suffix}")


def partial_file(path: Path, force: bool = False, resume: bool = False) -> Path:
    """The partial file of a table for `path`, beside the file that its symbolic links lead to.

    One that is there belongs to an interrupted run: `resume` goes on with it, `force` writes over it. Raises
    `GearTrainError` where it, or the table, cannot be written.
    """
    found = partial_name(destination(path, force))
    if found.is_symlink():
        fix = "remove it, or give another name"
        raise GearTrainError(Problem("this is a symbolic link", "a partial file is none", fix, str(found)))
    if found.exists() and not (force or resume):
        destination(found, force=True)  # what is no regular file is said to be that
        why, fix = "an interrupted run left it", "give --resume to go on with it, or --force to begin again"
        raise GearTrainError(Problem("the partial file exists", why, fix, str(found)))
    return destination(found, force=True)


class LongTable:
    """A CSV that grows row by row as `name.partial.csv`, and becomes `name.csv` when it is whole.

    rows     rows there already, where an interrupted run is resumed
    resume   go on with the partial file
    force    write over a table that is there
    replay   begin the partial file of an interrupted run again: its rows come from elsewhere
    """

    def __init__(
        self, path: Path, header: str, resume: bool = False, force: bool = False, replay: bool = False
    ) -> None:
        self.path, self.force, self.header = path, force, header
        self.partial = partial_file(path, force, resume or replay)
        self.rows = 0
        try:
            if resume and self.partial.exists():
                self.rows = self._take_up()
                self._file = self.partial.open("ab")
            else:
                self._file = self.partial.open("wb")
                self.write([header])
                self.rows = 0
        except OSError as error:
            raise unfinished_file(self.partial, error) from None

    def _take_up(self) -> int:
        """Cut off the mark and a torn last row; count the rows that are whole."""
        rows, end = -1, 0
        with self.partial.open("rb") as file:
            for line in file:
                if not line.endswith(b"\n") or line.startswith(PARTIAL_SUFFIX.encode()):
                    break
                if rows < 0 and line.decode("utf-8").rstrip("\n") != self.header:
                    raise GearTrainError(
                        Problem(
                            "the partial file is of another run",
                            f"its columns are {line.decode('utf-8').rstrip()}",
                            "ask for the same outputs, or leave --resume out to begin again",
                            str(self.partial),
                        )
                    )
                rows, end = rows + 1, end + len(line)
        os.truncate(self.partial, end)
        return max(rows, 0)

    def last(self) -> str:
        """The last whole row that was taken up."""
        with self.partial.open("rb") as file:
            lines = file.read().splitlines()
        return lines[-1].decode("utf-8") if self.rows else ""

    def write(self, rows: list[str]) -> None:
        """Append rows. Raises `GearTrainError`."""
        try:
            self._file.write(("\n".join(rows) + "\n").encode("utf-8"))
        except OSError as error:
            raise unfinished_file(self.partial, error) from None
        self.rows += len(rows)

    def __enter__(self) -> LongTable:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        """Whole: take the name asked for. Interrupted: stay partial, and say so in the last line."""
        try:
            if kind is not None:
                self._file.write(f"{PARTIAL_SUFFIX}stopped after {self.rows} rows\n".encode())
            self._file.close()
            if kind is None:
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            raise unfinished_file(self.partial, trouble) from None


class ColumnTable:
    """A Parquet file that grows by row groups as `name.partial.parquet`, and becomes `name.parquet` when it is whole.

    about   texts kept beside the columns; readers of Parquet show them as metadata
    force   write over a table that is there
    replay  begin the partial file of an interrupted run again

    Interrupted, the partial file is closed and can be read as far as it goes. Raises `MissingExtraError` without
    pyarrow, `GearTrainError` where nothing can be written.
    """

    def __init__(self, path: Path, about: Mapping[str, str], force: bool = False, replay: bool = False) -> None:
        try:
            self._arrow: Any = import_module("pyarrow")  # it carries no types
            import_module("pyarrow.parquet")
        except ImportError:
            raise MissingExtraError("pyarrow", "tables", "Parquet") from None
        self._writer: Any = None
        self.path, self.partial, self.force = path, partial_file(path, force, replay), force
        self.about, self.rows = dict(about), 0

    def write(self, columns: Mapping[str, Any]) -> None:
        """Append arrays of one length as one row group. Raises `GearTrainError`."""
        table = self._arrow.table(dict(columns))
        try:
            if self._writer is None:
                schema = table.schema.with_metadata(self.about)
                self._writer = self._arrow.parquet.ParquetWriter(self.partial, schema)
            self._writer.write_table(table.cast(self._writer.schema), row_group_size=max(1, table.num_rows))
        except (OSError, self._arrow.ArrowException) as error:
            raise unfinished_file(self.partial, error) from None
        self.rows += table.num_rows

    def __enter__(self) -> ColumnTable:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        """Whole: take the name asked for. Interrupted: stay partial."""
        if self._writer is None:
            return
        try:
            self._writer.close()
            if kind is None:
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            if kind is None:  # else what ended the run is said, not this
                raise unfinished_file(self.partial, trouble) from None


_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?(/\d+)?")
_FORMULA = ("=", "@", "+", "-", "\t", "\r", "\n")


def csv_line(cells: Iterable[object]) -> str:
    """One row without its end: quoted where that is needed, None as nothing, floats with all their digits.

    A text that a spreadsheet would take for a formula gets an apostrophe in front; numbers and fractions that are
    written as text do not. Control characters are written out, so that a row is always one line of a file.

    >>> csv_line(["a,b", "=1+1", "-254/19", -0.5, None])
    '"a,b",\\'=1+1,-254/19,-0.5,'
    """
    return csv_lines([cells])[0]


def csv_lines(rows: Iterable[Iterable[object]]) -> list[str]:
    """Several rows, each as `csv_line` has it."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([_cell(cell) for cell in row] for row in rows)
    return out.getvalue().split("\n")[:-1]


def csv_text(header: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """A whole table, each row ended by a line feed."""
    return "\n".join((csv_line(header), *csv_lines(rows), ""))


def _cell(cell: object) -> object:
    if cell is None:
        return ""
    if not isinstance(cell, str):
        return cell
    text = printable(cell).replace("\n", "\\n").replace("\t", "\\t")
    return f"'{text}" if cell.startswith(_FORMULA) and not _NUMBER.fullmatch(cell) else text


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
