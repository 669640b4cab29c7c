"""One measurement of work against precision: in this process, or in one of its own with its peak of memory."""

from __future__ import annotations

import gc
import multiprocessing
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from multiprocessing.connection import Connection
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

ENOUGH = 0.2
"""Seconds of repeats after which a task is not repeated."""
LIMIT = 120.0
"""Seconds after which a method is said not to finish."""

Task = Callable[[], Any]
Step = tuple[str, Callable[[], Sequence[Any]]]
"""What is measured, and what measures it and returns its records."""


def taken(steps: Iterable[Step]) -> list[Any]:
    """The records of all steps; each is named on standard error before it is taken."""
    rows: list[Any] = []
    for name, measured in steps:
        print(name, file=sys.stderr, flush=True)
        rows += measured()
    return rows


def timed(task: Task, clock: Callable[[], float] = time.perf_counter) -> tuple[float, Any]:
    """Seconds, and what the task returned."""
    start = clock()
    found = task()
    return clock() - start, found


class Rounds(NamedTuple):
    """What a task took in each of some rounds (s), and what it returned in the first."""

    seconds: list[float]
    found: Any

    @property
    def median(self) -> float:
        """The median of the rounds (s)."""
        return median(self.seconds)

    def over(self, other: Rounds) -> float:
        """How many times as long as another task: the median of the ratios within each round."""
        return median(own / base for own, base in zip(self.seconds, other.seconds, strict=True))


def in_turns(tasks: Iterable[Task], rounds: int, clock: Callable[[], float] = time.perf_counter) -> list[Rounds]:
    """Every task once a round, one after the other, so that ratios are of neighbours in time."""
    requested = list(tasks)
    taken = [[timed(task, clock) for task in requested] for _ in range(rounds)]
    return [Rounds([seconds for seconds, _ in own], own[0][1]) for own in zip(*taken, strict=True)]


class Cost(NamedTuple):
    """Best time (s), growth of peak memory (MB) and greatest error of a task; None stands for what could not be had."""

    seconds: float | None
    megabytes: float | None
    error: float | None
    note: str = ""


def measure(task: Task, error_of: Callable[[Any], float | None] = lambda _: None, limit: float = LIMIT) -> Cost:
    """Time `task` in a forked process, best of repeats within `ENOUGH`, and judge what it returned.

    error_of   result -> its greatest error, outside the time measured
    """
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_child, args=(there, task, error_of))
    process.start()
    there.close()
    try:
        if not here.poll(limit):
            return Cost(None, None, None, f"not within {limit:.0f} s")
        return Cost(*here.recv())
    except EOFError:
        return Cost(None, None, None, "out of memory")
    finally:
        process.kill()
        process.join()


class Gathered(NamedTuple):
    """What came in time, and why there is no more; "" where all came."""

    found: list[Any]
    note: str


def gathered(items: Callable[[], Iterable[Any]], limit: float, gigabytes: float) -> Gathered:
    """What an iterator yields in a forked process, as far as it comes in some time and memory.

    limit      seconds of its processor: what else runs beside it does not count
    gigabytes  of memory
    """
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_gather, args=(there, items, limit, gigabytes))
    process.start()
    there.close()
    found: list[Any] = []
    try:
        while True:
            ended, item = here.recv()
            if ended:
                return Gathered(found, item)
            found.append(item)
    except EOFError:
        process.join()
        late = process.exitcode == -signal.SIGPROF
        return Gathered(found, f"not within {limit:g} s" if late else f"more than {gigabytes:g} GB")
    finally:
        process.kill()
        process.join()


def _addresses() -> int:
    """Bytes of addresses that this process has; 0 where that cannot be read."""
    held = Path("/proc/self/statm")
    return int(held.read_text().split()[0]) * resource.getpagesize() if held.exists() else 0


def _gather(pipe: Connection, items: Callable[[], Iterable[Any]], limit: float, gigabytes: float) -> None:
    # the signal ends the process
    signal.setitimer(signal.ITIMER_PROF, max(limit, 1e-6))
    # a forked process begins with the addresses of the one that asks, which may be gigabytes that nobody uses
    most = _addresses() + int(gigabytes * 1e9)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    try:
        for item in items():
            pipe.send((False, item))
        pipe.send((True, ""))
    except MemoryError:
        pipe.send((True, f"more than {gigabytes:g} GB"))
    except Exception as error:  # what cannot be asked is a row of the table, not the end of the run
        pipe.send((True, (str(error).strip() or type(error).__name__).splitlines()[0]))


def _child(pipe: Connection, task: Task, error_of: Callable[[Any], float | None]) -> None:
    gc.freeze()  # the parent's objects stay shared pages
    before = _reset_peak()
    try:
        best, total, result = float("inf"), 0.0, None
        while not total or total < ENOUGH:
            took, result = timed(task)
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
