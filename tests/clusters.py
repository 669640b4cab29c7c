"""Work for others to do: tasks that note where they ran, wait at a gate, kill their worker; and a small cluster."""

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
    """Wait for something to be true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.02)
    raise AssertionError(f"waited in vain for {what}")


def next_line(stream: IO[str]) -> str:
    """The next line that a process writes into a pipe, which is empty so far."""
    ready, _, _ = select.select([stream], [], [], PATIENCE)
    assert ready, f"no line in {PATIENCE:g} s"
    return stream.readline()


def alive(pid: int) -> bool:
    """True if there is such a process, and it is not one that only waits to be buried."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def note(folder: str, number: int) -> None:
    """Write down that a task is begun, and by which process: one write, whole or not at all."""
    descriptor = os.open(Path(folder) / "begun", os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    try:
        os.write(descriptor, f"{number} {os.getpid()}\n".encode())
    finally:
        os.close(descriptor)


def begun(folder: Path) -> list[tuple[int, int]]:
    """Which tasks were begun by which processes, in time."""
    path = folder / "begun"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return [(int(number), int(pid)) for number, pid in (line.split() for line in lines)]


def mixed(number: int) -> dict[str, Any]:
    """A result with all that JSON has, and the longest work first."""
    time.sleep(0.02 if number == 0 else 0)
    return {"n": number, "third": number / 3, "huge": number**40, "pair": (number, None), "text": "Zähne\n", "no": []}


def slow(seconds: float) -> tuple[float, int]:
    """The time it takes, and the process that took it."""
    time.sleep(seconds)
    return seconds, os.getpid()


def gated(task: tuple[str, int, int]) -> int:
    """The square; tasks from `free` on wait until the folder has a gate that is open, or is gone with its test."""
    folder, number, free = task
    note(folder, number)
    end = time.monotonic() + 2 * PATIENCE
    while number >= free and not (Path(folder) / "gate").exists():
        assert time.monotonic() < end, "waited in vain at the gate"
        time.sleep(0.01)
    return number**2


def deadly(task: tuple[str, int, int]) -> int:
    """The square; task 5 kills its process the first `times` times."""
    folder, number, times = task
    note(folder, number)
    if number == 5 and sum(each == 5 for each, _ in begun(Path(folder))) <= times:
        os.kill(os.getpid(), signal.SIGKILL)
    return number**2


class AwkwardError(Exception):
    """An exception that pickles and does not unpickle, as many do."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(f"{first} and {second}")


def failing(task: tuple[str, int, str]) -> int:
    """The number; task 5 raises."""
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
    """What JSON does not have."""
    return {number}


@contextmanager
def small_cluster() -> Iterator[Any]:
    """Two workers, each a process of its own, under a scheduler in this one."""
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
