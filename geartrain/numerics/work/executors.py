"""Choice of an executor: none (this process), processes on this machine, or a dask cluster."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.work.worker_pool import Announcement, WorkerPool


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
    """Return a context manager that yields an executor for `run`, or None if the tasks run in this process.

    All running work is ended when the context is left.

    Parameters
    ----------
    workers : int, optional
        Number of processes on this machine, 1 or more; they are started with the first task. The default is the number
        of cores available to this process. By default, processes are started only if the work is not nearly finished
        after one second in this process.
    dask : str, optional
        Address of a dask scheduler, such as `tcp://10.0.0.1:8786`, whose workers run the tasks. It requires the extra
        `dask`, and the same version of geartrain on the cluster.
    announce : callable, optional
        Function that is called once with (tasks, workers) when other processes begin to work.

    Yields
    ------
    concurrent.futures.Executor or None
        Executor for `run` and `Execution`; it continues if workers die.

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
        raise QuestionError(Problem(what, "a run has at least one worker", "give 1 or more"))
    if dask is not None:
        from geartrain.numerics.work.cluster import DaskPool

        return DaskPool(dask)
    count = _default_count() if workers is None else workers
    if count == 1:
        return None
    from geartrain.numerics.work.processes import ProcessPool

    return ProcessPool(count, waits=workers is None)


def _default_count() -> int:
    """Return the number of available cores; 1 in a worker of `multiprocessing.Pool`, which must not start processes."""
    started = sys.modules.get("multiprocessing.process")
    return 1 if started is not None and started.current_process().daemon else cores()
