"""Journal of a long run: stored results, from which an interrupted run can be resumed with the same result.

A journal is a file of JSON lines to which lines are only appended. The first line contains plain data that identify the
run, under the key `question`. Each further line is one finished task, in the order of completion:

    {"geartrain journal":1,"question":{...}}
    {"crc":"1c291ca3","task":3,"mark":"d202ef8d","result":[1,2]}

`crc` is the CRC-32 of the rest of its line, and `mark` identifies the task (`task_runner.mark_of`). An incomplete end,
such as a line cut off by a kill or a power failure, is removed when the journal is resumed. Journals are checkpoints
and not results for users, and are therefore not written through `files`.
"""

from __future__ import annotations

import json
import os
import re
from array import array
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import Any
from zlib import crc32

from geartrain.errors import GearTrainError, Problem, QuestionError

_START = b'{"geartrain journal":1,'
_LINE = re.compile(rb'\{"crc":"([0-9a-f]{8})",("task":(\d{1,12}),"mark":"([0-9a-f]*)","result":(.*)\})\n')
_MOST_HEADER_BYTES = 10**7  # bytes: a file with a longer first line is not a journal
_SYNC_INTERVAL = 1.0  # s between flushes to disk: a power failure loses at most this; a kill loses no finished result


class Journal:
    """Results of the tasks of a run, stored by task number in a file until the run is complete.

    A journal is a context manager, which closes the file but does not remove it. `len()` returns the number of stored
    results. A journal needs 8 bytes of memory per task.

    Parameters
    ----------
    path : path or str
        Path of the file; the file is created, or resumed if it contains the same `question`.
    question : mapping
        Plain data that identify the run: all data on which the tasks and their results depend.
    resume : bool
        False to discard the results in the file, including the results of another run.

    Raises
    ------
    QuestionError
        If the file has another `question`, is not a journal, or is in use by another process.
    GearTrainError
        If the file cannot be read or written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from geartrain.numerics import run
    >>> with TemporaryDirectory() as folder:
    ...     for _ in range(2):  # the second time nothing is computed
    ...         with Journal(f"{folder}/journal", {"of": "squares"}) as journal:
    ...             print(len(journal), list(run(abs, [-1, 2], journal=journal)))
    0 [1, 2]
    2 [1, 2]
    """

    def __init__(self, path: Path | str, question: Mapping[str, Any], *, resume: bool = True) -> None:
        self.path = Path(path)
        plain = json.loads(json.dumps(question))
        header = _START + f'"question":{json.dumps(plain, ensure_ascii=False)}}}\n'.encode()
        if len(header) >= _MOST_HEADER_BYTES:
            raise _refused(
                "the data that identify the run are too long for a journal",
                "they have 10 MB or more",
                "shorten `question`",
                self.path,
            )
        self._at = array("q")  # position of the line of a task in the file; -1: not stored
        self._count, self._synced, self._dirty = 0, monotonic(), False
        if self.path.exists() and not self.path.is_file():
            raise _refused(
                "the file is not a journal", "it is not a regular file", "remove it, or give another name", self.path
            )
        try:
            with ExitStack() as opened:
                # append mode: writes go to the end wherever the reader is
                self._file = opened.enter_context(self.path.open("a+b", buffering=0))
                self._reader = opened.enter_context(self.path.open("rb"))
                opened.enter_context(_only_writer(self.path))
                end = self._resumable_length(plain, resume)
                self._file.truncate(end)
                if not end:
                    self._write(header)
                self._shut = opened.pop_all().close
        except OSError as error:
            raise _trouble(self.path, error) from None

    def _resumable_length(self, question: Any, resume: bool) -> int:
        """Return the length of the valid part of the file [bytes], or 0 if it is not resumed; index its results."""
        first = self._reader.readline(_MOST_HEADER_BYTES)
        # an incomplete first line: the run was killed while it wrote the header
        torn = not first.endswith(b"\n")
        begun = first.startswith(_START) or (torn and _START.startswith(first))
        if not begun or len(first) == _MOST_HEADER_BYTES:
            why = f"its first line does not begin with {_START.decode()}"
            raise _refused("the file is not a journal", why, "give another file", self.path)
        if torn or not resume:
            return 0
        try:
            theirs = json.loads(first)["question"]
        except (ValueError, KeyError):
            why = "its first line, which identifies the run, is damaged"
            raise _refused("the journal cannot be resumed", why, "remove it to begin again", self.path) from None
        if difference := first_difference(theirs, question):
            raise QuestionError(_another(difference, self.path))
        end = len(first)
        for line in self._reader:
            found = _valid_line(line)
            if found is None:
                break
            self._enter(int(found[3]), end)
            end += len(line)
        return end

    def _enter(self, task: int, at: int) -> None:
        if task >= len(self._at):
            self._at.extend([-1] * (task + 1 - len(self._at)))
        # a task that was stored twice is counted once
        self._count += self._at[task] < 0
        self._at[task] = at

    def __len__(self) -> int:
        return self._count

    def recall(self, task: int, mark: str = "") -> str | None:
        """Return the stored result of a task as JSON text; None if it is not stored.

        Parameters
        ----------
        task : int
            Number of the task, from 0.
        mark : str
            Identifier of the task; `QuestionError` is raised if another task is stored under this number.
        """
        if task >= len(self._at) or self._at[task] < 0:
            return None
        try:
            self._reader.seek(self._at[task])
            found = _valid_line(self._reader.readline())
        except OSError as error:
            raise _trouble(self.path, error) from None
        if found is None:
            raise _refused(
                f"task {task} of the journal cannot be read",
                "the file was changed during the run",
                "remove the journal to begin again",
                self.path,
            )
        if found[4].decode() != mark:
            why = "the work was divided into different tasks when this journal was begun"
            raise _refused(
                f"task {task} of the journal differs from the task of this run",
                why,
                "remove the journal to begin again",
                self.path,
            )
        return found[5].decode()

    def keep(self, task: int, mark: str, text: str) -> None:
        """Store a result in the journal; raise `GearTrainError` if that fails.

        Parameters
        ----------
        task : int
            Number of the task, from 0.
        mark : str
            Identifier of the task, in hexadecimal digits.
        text : str
            Result as one line of JSON.
        """
        rest = f'"task":{task},"mark":"{mark}","result":{text}}}'.encode()
        self._enter(task, self._write(b'{"crc":"%08x",' % crc32(rest) + rest + b"\n"))

    def _write(self, line: bytes) -> int:
        """Append a line and return its position in the file.

        The position is read from the file, because an interrupt can occur after a line is written and before this is
        recorded.
        """
        try:
            at = self._file.seek(0, os.SEEK_END)
            # an unbuffered write may write only a part of the line
            left = memoryview(line)
            while left:
                left = left[self._file.write(left) or 0 :]
            self._dirty = True
            if monotonic() - self._synced > _SYNC_INTERVAL:
                self._sync()
        except OSError as error:
            raise _trouble(self.path, error) from None
        return at

    def _sync(self) -> None:
        if self._dirty:
            os.fsync(self._file.fileno())
        self._synced, self._dirty = monotonic(), False

    @property
    def closed(self) -> bool:
        """True if the journal is closed, so that no results can be stored."""
        return self._file.closed

    def close(self) -> None:
        """Write the file to disk and close it; the run can be resumed later."""
        if not self.closed:
            with suppress(OSError):  # a full disk was already reported by the write
                self._sync()
            self._shut()

    def finish(self) -> None:
        """Remove the file after the run is complete and its result is saved. Raises `GearTrainError` if that fails."""
        self.close()
        try:
            self.path.unlink(missing_ok=True)
        except OSError as error:
            raise _trouble(self.path, error) from None

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self.close()


@contextmanager
def _only_writer(path: Path) -> Iterator[None]:
    """Hold an exclusive lock on a journal by means of a lock file. The lock is released when the process ends."""
    from filelock import FileLock, Timeout

    lock = FileLock(f"{path}.lock", timeout=0, thread_local=False)
    try:
        lock.acquire()
    except Timeout:
        raise _refused(
            "another run is writing this journal", "two runs would mix their results", "wait until it ends", path
        ) from None
    try:
        yield
    finally:
        # Unix: removed while locked, so that nobody locks a file about to be removed; Windows removes it on release
        with suppress(OSError):
            Path(lock.lock_file).unlink()
        lock.release()


def another_question(path: Path, question: Mapping[str, Any]) -> Problem:
    """Return a problem which reports that the journal belongs to a run with other inputs, and names the first input
    that differs from `question`.
    """
    try:
        with path.open("rb") as file:
            theirs = json.loads(file.readline(_MOST_HEADER_BYTES))["question"]
    except (OSError, ValueError, KeyError, TypeError):
        return _another("its first line, which identifies the run, cannot be read", path)
    return _another(first_difference(theirs, json.loads(json.dumps(question))), path)


def _another(difference: str, path: Path) -> Problem:
    fix = "give the same options to resume; omit --resume, or remove the file, to begin again"
    return Problem("the journal belongs to another run", difference, fix, str(path))


def first_difference(theirs: Any, ours: Any, place: str = "") -> str:
    """Describe the first difference between two plain data structures; return an empty string if they are equal.

    >>> first_difference({"wheels": [30, 36]}, {"wheels": [30, 48]})
    'wheels[1] is 36 in the journal and 48 in this run'
    """
    if isinstance(theirs, dict) and isinstance(ours, dict):
        for key in [*theirs, *(key for key in ours if key not in theirs)]:
            step = f"{place}.{key}" if place else key
            if key not in ours or key not in theirs:
                return f"{step} is only in {'the journal' if key in theirs else 'this run'}"
            if said := first_difference(theirs[key], ours[key], step):
                return said
        return ""
    if isinstance(theirs, list) and isinstance(ours, list):
        for number, (left, right) in enumerate(zip(theirs, ours, strict=False)):
            if said := first_difference(left, right, f"{place}[{number}]"):
                return said
        if len(theirs) != len(ours):
            return f"{place} has {len(theirs)} entries in the journal and {len(ours)} in this run"
        return ""
    if type(theirs) is type(ours) and theirs == ours:
        return ""
    return f"{place or 'it'} is {json.dumps(theirs)} in the journal and {json.dumps(ours)} in this run"


def _valid_line(line: bytes) -> re.Match[bytes] | None:
    """Return the match of `_LINE` with a complete line whose checksum is correct; None for any other line."""
    found = _LINE.fullmatch(line)
    return found if found is not None and int(found[1], 16) == crc32(found[2]) else None


def _refused(what: str, why: str, fix: str, path: Path) -> QuestionError:
    return QuestionError(Problem(what, why, fix, str(path)))


def _trouble(path: Path, error: OSError) -> GearTrainError:
    why = error.strerror or str(error)
    return GearTrainError(
        Problem("the journal cannot be read or written", why, "check the folder and its permissions", str(path))
    )
