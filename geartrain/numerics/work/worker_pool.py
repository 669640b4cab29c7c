"""Executors: this process, processes on this machine or a dask cluster, whose workers can die."""

from __future__ import annotations

import os
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor
from contextlib import contextmanager
from typing import Any

from geartrain.errors import Problem, QuestionError

Announcement = Callable[[int, int], None]
"""Function called with (tasks, workers) when a run first uses other processes; 0 tasks if their number is unknown."""


class WorkerPool(Executor, ABC):
    """Executor that survives the death of workers: the futures of a dead worker fail with an error for which `deaths`
    is above 0, and the next submit works.

    announce   function called before the first task is submitted; None afterwards
    waits      True to do the first second of work in this process, which may be sufficient
    """

    announce: Announcement | None = None
    waits = False

    @property
    @abstractmethod
    def width(self) -> int:
        """Number of tasks that run at the same time, at least 1."""

    def carries(self, work: Callable[[Any], Any]) -> bool:
        """Return True if workers can receive this function, False if its tasks must run in this process."""
        del work
        return True

    def deaths(self, error: Exception) -> int:
        """Return the number of workers that died when a task failed with this error; 0 for any other failure."""
        return int(isinstance(error, BrokenExecutor))

    def begin(self, tasks: int) -> None:
        """Report at the first call that other processes will do `tasks` tasks (0 if unknown)."""
        # only the first call has an announcement
        announce, self.announce, self.waits = self.announce, None, False
        if announce is not None:
            announce(tasks, min(self.width, tasks or self.width))

    def check(self) -> None:
        """Raise `GearTrainError` if no pending task can finish; called every few seconds while waiting."""

    @abstractmethod
    def dismiss(self) -> None:
        """End the workers and their running tasks, or disconnect from them."""


def cores() -> int:
    """Return the number of processor cores that this process may use according to its affinity; at least 1."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


@contextmanager
def open_executor(
    workers: int | None = None, dask: str | None = None, announce: Announcement | None = None
) -> Iterator[Executor | None]:
    """Open a context that yields an executor for `run`, or None if the tasks run in this process.

    On exit the context manager ends all running work.

    Parameters
    ----------
    workers : int, optional
        Number of processes on this machine, 1 or more, started with the first task. The default is the number of cores
        available to this process. With the default number, processes are started only if the work is not nearly
        finished after one second in this process.
    dask : str, optional
        Address of a dask scheduler, such as `tcp://10.0.0.1:8786`, whose workers run the tasks. Needs the extra `dask`,
        and the same version of geartrain on the cluster.
    announce : callable, optional
        Function that is called once with (tasks, workers) when other processes begin to work.

    Yields
    ------
    concurrent.futures.Executor or None
        Argument for `run` and `Execution`; it survives the death of workers.

    Raises
    ------
    QuestionError
        If both `workers` and `dask` are given, or if `workers` is below 1.
    MissingExtraError
        If `dask` is given and the extra `dask` is not installed.
    GearTrainError
        If the cluster does not respond or cannot work.

    Examples
    --------
    >>> from geartrain.numerics import run
    >>> with open_executor(workers=1) as executor:
    ...     list(run(abs, [-1, 2], executor))
    [1, 2]
    """
    pool = _pool(workers, dask)
    if pool is not None:
        pool.announce = announce
    try:
        yield pool
    finally:
        if pool is not None:
            pool.dismiss()


def _pool(workers: int | None, dask: str | None) -> WorkerPool | None:
    if workers is not None and dask is not None:
        why = "the number of workers of a cluster is set when it is started"
        raise QuestionError(Problem("both workers and a dask scheduler are given", why, "give only one of them"))
    if workers is not None and workers < 1:
        what = f"the number of workers is {workers}"
        raise QuestionError(Problem(what, "at least one worker is needed", "give 1 or more"))
    if dask is not None:
        from geartrain.numerics.work.cluster import DaskPool

        return DaskPool(dask)
    count = _default_count() if workers is None else workers
    if count == 1:
        return None
    from geartrain.numerics.work.processes import ProcessPool

    return ProcessPool(count, waits=workers is None)


def _default_count() -> int:
    """Return the number of available cores; 1 in a worker of `multiprocessing.Pool`, which may not start processes."""
    started = sys.modules.get("multiprocessing.process")
    return 1 if started is not None and started.current_process().daemon else cores()
