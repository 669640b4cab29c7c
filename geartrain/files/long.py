"""Long tables to disk, piece by piece: under a name that says partial until they are whole, and taken up again."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

from geartrain.errors import GearTrainError, Problem
from geartrain.files.writing import destination, place, unwritten

MARK = "# partial: "


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
            raise unwritten(self.partial, error) from None

    def _take_up(self) -> int:
        """Cut off the mark and a torn last row; count the rows that are whole."""
        rows, end = -1, 0
        with self.partial.open("rb") as file:
            for line in file:
                if not line.endswith(b"\n") or line.startswith(MARK.encode()):
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
            raise unwritten(self.partial, error) from None
        self.rows += len(rows)

    def __enter__(self) -> LongTable:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        """Whole: take the name asked for. Interrupted: stay partial, and say so in the last line."""
        try:
            if kind is not None:
                self._file.write(f"{MARK}stopped after {self.rows} rows\n".encode())
            self._file.close()
            if kind is None:
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            raise unwritten(self.partial, trouble) from None
