"""Tasks for the tests of parallel runs, which record their process, wait at a gate or kill their worker; a small
cluster.
"""

from __future__ import annotations

import os
import select
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

PATIENCE = 60.0  # s: for what is certain to come, on however busy a machine


def until(condition: Any, what: str) -> Any:
    """Wait until a condition is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.02)
    raise AssertionError(f"waited in vain for {what}")


def next_line(stream: IO[str]) -> str:
    """Return the next line that a process writes to a pipe that is empty so far."""
    ready, _, _ = select.select([stream], [], [], PATIENCE)
    assert ready, f"no line in {PATIENCE:g} s"
    return stream.readline()


def alive(pid: int) -> bool:
    """Return True if the process exists and is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def note(folder: str, number: int) -> None:
    """Record, in one atomic write, that a task has begun and in which process."""
    descriptor = os.open(Path(folder) / "begun", os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    try:
        os.write(descriptor, f"{number} {os.getpid()}\n".encode())
    finally:
        os.close(descriptor)


def begun(folder: Path) -> list[tuple[int, int]]:
    """Return the tasks that have begun and their processes, in order of time."""
    path = folder / "begun"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return [(int(number), int(pid)) for number, pid in (line.split() for line in lines)]


def mixed(number: int) -> dict[str, Any]:
    """Return a result with every type of JSON; the first task takes longest."""
    time.sleep(0.02 if number == 0 else 0)
    return {"n": number, "third": number / 3, "huge": number**40, "pair": (number, None), "text": "Zähne\n", "no": []}


def slow(seconds: float) -> tuple[float, int]:
    """Return the time that the task took and its process."""
    time.sleep(seconds)
    return seconds, os.getpid()


def gated(task: tuple[str, int, int]) -> int:
    """Return the square; tasks from `free` on wait until the gate in the folder is open or the folder is deleted."""
    folder, number, free = task
    note(folder, number)
    end = time.monotonic() + 2 * PATIENCE
    while number >= free and not (Path(folder) / "gate").exists():
        assert time.monotonic() < end, "waited in vain at the gate"
        time.sleep(0.01)
    return number**2


def deadly(task: tuple[str, int, int]) -> int:
    """Return the square; task 5 kills its process the first `times` times."""
    folder, number, times = task
    note(folder, number)
    if number == 5 and sum(each == 5 for each, _ in begun(Path(folder))) <= times:
        os.kill(os.getpid(), signal.SIGKILL)
    return number**2


class AwkwardError(Exception):
    """An exception that can be pickled but not unpickled, like many exceptions of libraries."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(f"{first} and {second}")


def failing(task: tuple[str, int, str]) -> int:
    """Return the number; task 5 raises an exception."""
    from geartrain.errors import Problem, QuestionError

    folder, number, kind = task
    note(folder, number)
    if number == 5:
        if kind == "awkward":
            raise AwkwardError("this", "that")
        raise (
            QuestionError([Problem("what", "why", "fix", "place"), Problem("more")]) if kind == "ours" else KeyError(5)
        )
    return number


def not_plain(number: int) -> set[int]:
    """Return an object that JSON cannot represent."""
    return {number}


@contextmanager
def small_cluster() -> Iterator[Any]:
    """Yield a cluster of two worker processes with a scheduler in this process."""
    import dask
    import distributed

    # by default a local cluster drops a worker for good that is just starting again 15 s after another death
    with (
        dask.config.set({"distributed.deploy.lost-worker-timeout": "10 minutes"}),
        distributed.LocalCluster(
            n_workers=2, processes=True, threads_per_worker=1, dashboard_address=":0", silence_logs=60
        ) as cluster,
    ):
        yield cluster
