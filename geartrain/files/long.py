"""Long tables to disk, piece by piece: under a name that says partial until they are whole, and taken up again."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

from geartrain.errors import GearTrainError, Problem

MARK = "# partial: "


def partial_name(path: Path) -> Path:
    """`run.csv` -> `run.partial.csv`."""
    return path.with_name(f"{path.stem}.partial{path.suffix}")


class LongTable:
    """A CSV that grows row by row as `name.partial.csv`, and becomes `name.csv` when it is whole.

    rows     rows there already, where an interrupted run is resumed
    """

    def __init__(self, path: Path, header: str, resume: bool = False) -> None:
        self.path, self.partial, self.header = path, partial_name(path), header
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
            raise _trouble(self.partial, error) from None

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
            raise _trouble(self.partial, error) from None
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
                os.replace(self.partial, self.path)
        except OSError as trouble:
            raise _trouble(self.partial, trouble) from None


def _trouble(path: Path, error: OSError) -> GearTrainError:
    return GearTrainError(
        Problem(
            "the file cannot be written",
            error.strerror or str(error),
            "check the folder and its permissions",
            str(path),
        )
    )
