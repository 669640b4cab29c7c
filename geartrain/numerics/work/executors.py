"""Which executor does the work: none (this process), processes on this machine, or a cluster."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.numerics.work.worker_pool import WorkerPool


def cores() -> int:
    """The cores that this process may use: fewer than the machine has where its affinity says so. At least 1."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


@contextmanager
def open_executor(workers: int | None = None, scheduler: str | None = None) -> Iterator[Executor | None]:
    """An executor for `run`, or None where one worker is enough: then the work is done in this process.

    A context manager: leaving it ends what is still running.

    Parameters
    ----------
    workers : int, optional
        Processes on this machine, 1 or more; default the cores this process may use. They start with the first task.
    scheduler : str, optional
        Address of a dask scheduler, such as `tcp://10.0.0.1:8786`: its workers do the work, however many they are.
        Needs the extra `dask`, and geartrain in the same version on the cluster.

    Yields
    ------
    concurrent.futures.Executor or None
        What `run` and `Execution` take; it outlives workers that die.

    Raises
    ------
    QuestionError
        If both are given, or `workers` is below 1.
    MissingExtraError
        If a scheduler is given without the extra.
    GearTrainError
        If the cluster does not answer or cannot work.

    Examples
    --------
    >>> from geartrain.numerics import run
    >>> with open_executor(workers=1) as executor:
    ...     list(run(abs, [-1, 2], executor))
    [1, 2]
    """
    crew = _crew(workers, scheduler)
    try:
        yield crew
    finally:
        if crew is not None:
            crew.dismiss()


def _crew(workers: int | None, scheduler: str | None) -> WorkerPool | None:
    if workers is not None and scheduler is not None:
        why = "how many workers a cluster has is its own matter"
        raise QuestionError(Problem("both workers and a scheduler are given", why, "give one of the two"))
    if workers is not None and workers < 1:
        raise QuestionError(Problem(f"{workers} workers", "it takes one to do the work", "ask for 1 or more"))
    if scheduler is not None:
        from geartrain.numerics.work.cluster import connect

        return connect(scheduler)
    count = cores() if workers is None else workers
    if count == 1:
        return None
    from geartrain.numerics.work.processes import ProcessPool

    return ProcessPool(count)
