"""One measurement of work against precision, taken in a process of its own."""

from __future__ import annotations

import gc
import multiprocessing
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

LIMIT = 120.0
"""Seconds after which a method is said not to finish."""


@dataclass(frozen=True, slots=True)
class Record:
    """A method on a train: best time, growth of peak memory, greatest true relative error of any speed.

    None stands for what could not be had: a method that did not finish, or an error without an exact answer.
    """

    family: str
    links: int
    method: str
    seconds: float | None
    megabytes: float | None
    error: float | None
    note: str = ""


@dataclass(frozen=True, slots=True)
class Records:
    """All measurements of one run on one machine."""

    title: str
    rows: Sequence[Record]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"title": self.title, "rows": [asdict(row) for row in self.rows]}

    def to_markdown(self) -> str:
        """One table a family and size, with each method's time over that of the exact method."""
        lines = [f"# {self.title}", ""]
        for key in dict.fromkeys((row.family, row.links) for row in self.rows):
            group = [row for row in self.rows if (row.family, row.links) == key]
            base = next((row.seconds for row in group if row.method == "exact" and row.seconds), None)
            lines += [
                f"## {key[0]}, {key[1]} links",
                "",
                "| method | time | ratio to exact | memory | true error |",
                "|---|---|---|---|---|",
            ]
            for row in group:
                ratio = f"{row.seconds / base:.3g}" if row.seconds and base else "-"
                memory = "-" if row.megabytes is None else f"{row.megabytes:.0f} MB"
                error = row.note or ("-" if row.error is None else "0" if row.error == 0 else f"{row.error:.1e}")
                lines.append(f"| {row.method} | {_time(row.seconds)} | {ratio} | {memory} | {error} |")
            lines.append("")
        return "\n".join(lines)


def _time(seconds: float | None) -> str:
    if seconds is None:
        return "-"
    return (
        f"{seconds * 1e6:.0f} us"
        if seconds < 1e-3
        else f"{seconds * 1e3:.3g} ms"
        if seconds < 1
        else f"{seconds:.3g} s"
    )


Task = Callable[[], Any]


def measure(
    family: str, links: int, method: str, task: Task, error_of: Callable[[Any], float | None], limit: float = LIMIT
) -> Record:
    """Time `task` in a forked process, best of repeats within a fifth of a second, and judge what it returned.

    error_of   result -> its greatest relative error, outside the time measured
    """
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_child, args=(there, task, error_of))
    process.start()
    there.close()
    try:
        if not here.poll(limit):
            return Record(family, links, method, None, None, None, f"not within {limit:.0f} s")
        seconds, megabytes, error, note = here.recv()
    except EOFError:
        return Record(family, links, method, None, None, None, "out of memory")
    finally:
        process.kill()
        process.join()
    return Record(family, links, method, seconds, megabytes, error, note)


def _child(pipe: Connection, task: Task, error_of: Callable[[Any], float | None]) -> None:
    gc.freeze()  # the parent's objects stay shared pages
    before = _reset_peak()
    try:
        best, total, result = float("inf"), 0.0, None
        while total < 0.2:
            start = time.perf_counter()
            result = task()
            took = time.perf_counter() - start
            best, total = min(best, took), total + took
        memory = None if before is None else (_status("VmHWM") or 0) / 1024 - before
        pipe.send((best, memory, error_of(result), ""))
    except Exception as error:  # a method that cannot is a row of the table, not the end of the run
        pipe.send((None, None, None, (str(error).strip() or type(error).__name__).splitlines()[0]))


def _reset_peak() -> float | None:
    """Forget the peak of memory so far (Linux), and say what is in use in MB."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return None
    resident = _status("VmRSS")
    return None if resident is None else resident / 1024


def _status(key: str) -> int | None:
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key):
            return int(line.split()[1])
    return None
