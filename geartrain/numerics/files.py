"""Files: atomic output of results, tables as CSV and Parquet, and input of points and edges.

A file is written completely or not at all, and overwrites another file only on request. An interrupted long table
remains in a file whose name contains `partial`; a CSV file can be resumed.
"""

from __future__ import annotations

import csv
import io
import os
import re
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from geartrain.errors import GearTrainError, MissingExtraError, Problem, printable
from geartrain.numerics.exact import plural

_KINDS = (
    (stat.S_ISFIFO, "a FIFO (a named pipe)"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
    (stat.S_ISSOCK, "a socket"),
)


def destination(path: Path, force: bool = False) -> Path:
    """Return the file to which a result for `path` will be written, with symbolic links resolved.

    An existing file may only be overwritten with `force`, and only if it is a regular file whose permissions allow
    writing (also for root). Otherwise `GearTrainError` is raised. The function does not write anything.
    """
    try:
        try:
            mode = os.stat(path).st_mode
        except (FileNotFoundError, NotADirectoryError):
            mode = 0  # also a link to a file that does not exist yet; `_obstacle` reports a path through a file
        real = Path(os.path.realpath(path))
        obstacle = _obstacle(path, real, mode, force)
    except (OSError, ValueError, RuntimeError) as error:
        obstacle = _invalid_name(path, getattr(error, "strerror", None) or str(error))
    if obstacle is not None:
        raise GearTrainError(obstacle)
    return real


def write_text(path: Path, text: str, force: bool = False) -> None:
    """Write `text` atomically as UTF-8, following symbolic links; overwrite an existing file only with `force`."""
    write_bytes(path, text.encode("utf-8"), force)


def write_bytes(path: Path, data: bytes, force: bool = False) -> None:
    """Write `data` atomically, following symbolic links; overwrite an existing file only with `force`."""
    real = destination(path, force)
    try:
        # in the same folder, because a rename is atomic only within one file system
        handle, name = tempfile.mkstemp(dir=real.parent, prefix=f".{real.name[:64]}.")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            temporary.chmod(0o666 & ~umask())  # `mkstemp` makes the file readable by its owner only
            place(temporary, path, force)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise unfinished_file(path, error) from None


def place(temporary: Path, path: Path, force: bool = False) -> None:
    """Rename a finished temporary file on the same disk to `path`, after the checks of `destination`."""
    real = destination(path, force)
    with temporary.open("rb") as file:
        # before renaming: a power failure could otherwise leave the new name with an empty file
        os.fsync(file.fileno())
    if real.exists():
        old = real.stat()
        if hasattr(os, "chown"):
            with suppress(OSError):  # the system may not allow it
                os.chown(temporary, old.st_uid, old.st_gid)
        temporary.chmod(stat.S_IMODE(old.st_mode))
    if force or not _link(temporary, real, path):
        os.replace(temporary, real)
    with suppress(OSError):  # on systems that can flush a folder, the new name survives a power failure
        handle = os.open(real.parent, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def unfinished_file(path: Path, error: Exception) -> GearTrainError:
    """Return an error for a file that could not be written because of the disk error `error`."""
    why = getattr(error, "strerror", None) or str(error)
    fix = "free disk space, or check the folder and its permissions"
    return GearTrainError(Problem("the file cannot be written", why, fix, str(path)))


def umask() -> int:
    """Return the permission bits that are removed from new files."""
    mask = os.umask(0)  # it can only be read by setting it
    os.umask(mask)
    return mask


def _obstacle(path: Path, real: Path, mode: int, force: bool) -> Problem | None:
    """Return the problem that prevents writing the file `real` with the permissions `mode` (0 if missing), or None."""
    if stat.S_ISDIR(mode):
        fix = f"give a file in it: {path / 'NAME'}"
        return Problem("this is a folder", "a result is written to one file", fix, str(path))
    if mode and not stat.S_ISREG(mode):
        kind = next((name for is_kind, name in _KINDS if is_kind(mode)), "not a regular file")
        why = "a result can overwrite only a regular file"
        return Problem(f"this is {kind}", why, "give a file name, or - for standard output", str(path))
    if path.name in ("", "..") or not path.name.isprintable():
        return _invalid_name(path, "a file name must consist of printable characters")
    folder = real.parent
    if not folder.is_dir():
        what, why = f"folder {folder} does not exist", "an output file is written only to an existing folder"
        return Problem(what, why, "create the folder first", str(path))
    if not os.access(folder, os.W_OK | os.X_OK):
        return _unwritable(folder)
    if mode and not force:
        return _exists(path)
    if mode and (not mode & 0o222 or not os.access(real, os.W_OK)):
        why = f"its permissions ({stat.filemode(mode)}) forbid writing, and --force does not change them"
        return Problem("the file is read-only", why, "make it writable, or give another name", str(path))
    return None


def _unwritable(folder: Path) -> Problem:
    why = "its permissions do not allow writing"
    return Problem("the folder cannot be written to", why, "give another folder", str(folder))


def _exists(path: Path) -> Problem:
    what = "the file exists"
    return Problem(what, "existing files are overwritten only with --force", "give --force, or another name", str(path))


def _invalid_name(path: Path, why: str) -> Problem:
    return Problem("this is not a valid file name", why, "choose a shorter or simpler name", repr(str(path)))


def _link(temporary: Path, real: Path, path: Path) -> bool:
    """Give a file a new name by a hard link, which fails if the name exists; return False if the disk has no links."""
    try:
        os.link(temporary, real)
    except FileExistsError:
        raise GearTrainError(_exists(path)) from None
    except (OSError, AttributeError):
        return False
    temporary.unlink()
    return True


def check_folder(folder: Path, names: Sequence[str], force: bool = False) -> None:
    """Raise `GearTrainError` if the files cannot be written to a folder, or if one exists and `force` is False."""
    place = str(folder)
    if folder.exists() and not folder.is_dir():
        why = "several files are written to one folder"
        raise GearTrainError(Problem("this is not a folder", why, "give the path of a folder", place))
    nearest = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise GearTrainError(_unwritable(folder))
    there = [name for name in names if os.path.lexists(folder / name)]
    for name in there:
        destination(folder / name, force=True)  # raises the error for a file that is not regular or is read-only
    if there and not force:
        others = len(there) - 1
        more = f" and {plural(others, 'other file')} are" if others else " is"
        what = f"'{there[0]}'{more} already in the folder"
        why = "existing files are overwritten only with --force"
        raise GearTrainError(Problem(what, why, "give --force, or an empty folder", place))


def write_folder(folder: Path, files: Iterable[tuple[str, bytes]], force: bool = False) -> int:
    """Write named files to a folder and return their number; existing files are overwritten only with `force`.

    The files are created in a temporary folder and moved when all are complete, so that an error changes nothing.
    """
    made: list[str] = []
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=f".{folder.name}."))
        try:
            for name, data in files:
                path = beside / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
                made.append(name)
            _put(beside, folder, made, force)
        finally:
            shutil.rmtree(beside, ignore_errors=True)
    except OSError as error:
        why = error.strerror or str(error)
        what = "the files cannot be written"
        raise GearTrainError(Problem(what, why, "check the folder and its permissions", str(folder))) from None
    return len(made)


def _put(beside: Path, folder: Path, names: Iterable[str], force: bool) -> None:
    if not os.path.lexists(folder):
        beside.chmod(0o777 & ~umask())
        beside.replace(folder)
        return
    names = list(names)
    check_folder(folder, names, force)
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
    for name in names:
        write_bytes(folder / name, (beside / name).read_bytes(), force)


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
        """Remove an incomplete row at the end of the partial file; return the number of rows that remain."""
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
    """Read points from a file with three numbers per line, separated by blanks or commas; `#` begins a comment."""

    def point(words: list[str]) -> tuple[float, float, float]:
        x, y, z = map(float, words)
        return x, y, z

    return _parsed_rows(path, point, "is not a point", "a point consists of three numbers", "write x y z")


def read_edges(path: Path) -> list[tuple[str, str]]:
    """Read edges from a file with two names per line, separated by blanks or commas; `#` begins a comment."""

    def edge(words: list[str]) -> tuple[str, str]:
        first, second = words
        return first, second

    return _parsed_rows(path, edge, "is not a mesh", "a mesh consists of two names", "write the names of two gears")


def _parsed_rows(path: Path, parse: Callable[[list[str]], T], what: str, why: str, fix: str) -> list[T]:
    """Return the words of each line of a file as parsed by `parse`. Lines with errors are reported as problems."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        cause = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        problem = Problem("the file cannot be read", str(cause), "check its name and contents", str(path))
        raise GearTrainError(problem) from None
    found, problems = [], []
    for at, line in enumerate(text.splitlines(), 1):
        words = line.partition("#")[0].replace(",", " ").split()
        try:
            if words:
                found.append(parse(words))
        except ValueError:
            problems.append(Problem(f"'{' '.join(words)}' {what}", why, fix, f"{path}:{at}"))
    if problems:
        raise GearTrainError(problems)
    return found
