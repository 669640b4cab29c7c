"""Tables on disk: long tables as CSV or Parquet, and small text files of points and edges.

Long tables are written in chunks, to a file whose name contains `partial` until it is complete. An interrupted CSV file
can be resumed. This module formats the rows of all CSV files.
"""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from geartrain.errors import GearTrainError, MissingExtraError, Problem, printable
from geartrain.numerics.files.atomic import destination, place, unfinished_file

T = TypeVar("T")

PARTIAL_SUFFIX = "# partial: "


def partial_name(path: Path) -> Path:
    """Return the name of the partial file of an interrupted run: `run.csv` -> `run.partial.csv`."""
    return path.with_name(f"{path.stem}.partial{path.suffix}")


def partial_file(path: Path, force: bool = False, resume: bool = False) -> Path:
    """Return the partial file of the table `path`, with the symbolic links of the path resolved.

    An existing partial file is from an interrupted run: `resume` continues the run, and `force` overwrites the file.
    Raises `GearTrainError` if the partial file or the table cannot be written.
    """
    found = partial_name(destination(path, force))
    if found.is_symlink():
        fix = "remove it, or give another name"
        what = "this is a symbolic link"
        raise GearTrainError(Problem(what, "a partial file must be a regular file", fix, str(found)))
    if found.exists() and not (force or resume):
        destination(found, force=True)  # raises the error for a file that is not regular
        why = "it contains the rows of an interrupted run"
        fix = "give --resume to continue it, or --force to begin again"
        raise GearTrainError(Problem("the partial file exists", why, fix, str(found)))
    return destination(found, force=True)


class LongTable:
    """CSV file that is written row by row as `name.partial.csv` and renamed to `name.csv` when it is complete.

    rows     number of rows, including the rows of an interrupted run that is resumed
    resume   True to continue the partial file
    force    True to overwrite an existing table
    replay   True to overwrite the partial file of an interrupted run, whose rows are stored elsewhere
    """

    def __init__(
        self, path: Path, header: str, resume: bool = False, force: bool = False, replay: bool = False
    ) -> None:
        self.path, self.force, self.header = path, force, header
        self.partial = partial_file(path, force, resume or replay)
        self.rows = 0
        try:
            if resume and self.partial.exists():
                self.rows = self._truncate_to_whole_rows()
                self._file = self.partial.open("ab")
            else:
                self._file = self.partial.open("wb")
                self.write([header])
                self.rows = 0
        except OSError as error:
            raise unfinished_file(self.partial, error) from None

    def _truncate_to_whole_rows(self) -> int:
        """Remove an incomplete row at the end of the partial file; return the number of complete rows."""
        # -1, because the first line is the header
        rows, end = -1, 0
        with self.partial.open("rb") as file:
            for line in file:
                if not line.endswith(b"\n") or line.startswith(PARTIAL_SUFFIX.encode()):
                    break
                if rows < 0 and line.decode("utf-8").rstrip("\n") != self.header:
                    what = "the partial file belongs to another run"
                    why = f"a resumed table must have the same columns as the file: {line.decode('utf-8').rstrip()}"
                    fix = "request the same outputs, or omit --resume to begin again"
                    raise GearTrainError(Problem(what, why, fix, str(self.partial)))
                rows, end = rows + 1, end + len(line)
        # the resumed run writes the incomplete row again
        os.truncate(self.partial, end)
        return max(rows, 0)

    def last(self) -> str:
        """Return the last complete row of an interrupted run."""
        with self.partial.open("rb") as file:
            lines = file.read().splitlines()
        return lines[-1].decode("utf-8") if self.rows else ""

    def write(self, rows: list[str]) -> None:
        """Append rows to the file. Raises `GearTrainError` if that fails."""
        try:
            self._file.write(("\n".join(rows) + "\n").encode("utf-8"))
        except OSError as error:
            raise unfinished_file(self.partial, error) from None
        self.rows += len(rows)

    def __enter__(self) -> LongTable:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        """Rename the file if it is complete; append a line to an interrupted file that marks it as partial."""
        try:
            if kind is not None:
                self._file.write(f"{PARTIAL_SUFFIX}stopped after {self.rows} rows\n".encode())
            self._file.close()
            if kind is None:
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            raise unfinished_file(self.partial, trouble) from None


class ColumnTable:
    """Parquet file that is written in row groups as `name.partial.parquet` and renamed when it is complete.

    about    metadata of the file, by key
    force    True to overwrite an existing table
    replay   True to overwrite the partial file of an interrupted run

    After an interrupt, the partial file is closed and can be read. Raises `MissingExtraError` if pyarrow is not
    installed, and `GearTrainError` if the file cannot be written.
    """

    def __init__(self, path: Path, about: Mapping[str, str], force: bool = False, replay: bool = False) -> None:
        try:
            self._arrow: Any = import_module("pyarrow")  # it has no type annotations
            import_module("pyarrow.parquet")
        except ImportError:
            raise MissingExtraError("pyarrow", "tables", "Parquet") from None
        self._writer: Any = None
        self.path, self.partial, self.force = path, partial_file(path, force, replay), force
        self.about, self.rows = dict(about), 0

    def write(self, columns: Mapping[str, Any]) -> None:
        """Append arrays of equal length as one row group. Raises `GearTrainError` if that fails."""
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
        """Rename the file if it is complete; an interrupted file keeps its partial name."""
        if self._writer is None:
            return
        try:
            self._writer.close()
            if kind is None:
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            if kind is None:  # otherwise the error that ended the run is reported
                raise unfinished_file(self.partial, trouble) from None


_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?(/\d+)?")
_FORMULA = ("=", "@", "+", "-", "\t", "\r", "\n")


def csv_line(cells: Iterable[object]) -> str:
    r"""Format one row as CSV without a line end. Cells are quoted if necessary.

    None is written as an empty cell, and floats with all digits.

    An apostrophe is put before text that a spreadsheet would interpret as a formula, except numbers and fractions.
    Control characters are escaped, so that a row is always one line of the file.

    >>> csv_line(["a,b", "=1+1", "-254/19", -0.5, None])
    '"a,b",\'=1+1,-254/19,-0.5,'
    """
    return csv_lines([cells])[0]


def csv_lines(rows: Iterable[Iterable[object]]) -> list[str]:
    """Format several rows as lines of CSV text with `csv_line`."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([_cell(cell) for cell in row] for row in rows)
    return out.getvalue().split("\n")[:-1]


def csv_text(header: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """Format a table as CSV in which each row ends with a line feed."""
    return "\n".join((csv_line(header), *csv_lines(rows), ""))


def _cell(cell: object) -> object:
    if cell is None:
        return ""
    if not isinstance(cell, str):
        return cell
    text = printable(cell).replace("\n", "\\n").replace("\t", "\\t")
    # an apostrophe prevents a spreadsheet from evaluating the text
    return f"'{text}" if cell.startswith(_FORMULA) and not _NUMBER.fullmatch(cell) else text


def read_points(path: Path) -> list[tuple[float, float, float]]:
    """Read points from a file with three numbers per line, separated by blanks or commas.

    `#` begins a comment. Raises `GearTrainError`, which lists the invalid lines.
    """

    def point(words: list[str]) -> tuple[float, float, float]:
        x, y, z = map(float, words)
        return x, y, z

    return _parsed_rows(path, point, "is not a point", "a point consists of three numbers", "write x y z")


def read_edges(path: Path) -> list[tuple[str, str]]:
    """Read edges from a file with two names per line, separated by blanks or commas.

    `#` begins a comment. Raises `GearTrainError`, which lists the invalid lines.
    """

    def edge(words: list[str]) -> tuple[str, str]:
        first, second = words
        return first, second

    return _parsed_rows(path, edge, "is not a mesh", "a mesh consists of two names", "write the names of two gears")


def _parsed_rows(path: Path, parse: Callable[[list[str]], T], what: str, why: str, fix: str) -> list[T]:
    """Return the parsed lines of a file; `parse` raises `ValueError` for invalid words."""
    found, problems = [], []
    for at, words in _rows(path):
        try:
            found.append(parse(words))
        except ValueError:
            problems.append(Problem(f"'{' '.join(words)}' {what}", why, fix, f"{path}:{at}"))
    if problems:
        raise GearTrainError(problems)
    return found


def _rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        what = "the file cannot be read"
        raise GearTrainError(Problem(what, str(why), "check its name and contents", str(path))) from None
    for at, line in enumerate(text.splitlines(), 1):
        if words := line.partition("#")[0].replace(",", " ").split():
            yield at, words
