"""Which executor does the work: none (this process), processes on this machine, or a dask cluster.

Worker processes are spawned, not forked: a fork copies the locks that other threads of this process hold (numpy's, a
progress bar's), and a worker that waits for one of those waits for ever. Spawning is also the one way that is the
same on all systems. It costs each worker its imports, once.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, InvalidStateError, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Thread
from typing import Any

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.work.worker_pool import Announcement, WorkerDiedError, WorkerPool, follow

_MOST = 61 if sys.platform == "win32" else 10_000  # as many processes as Windows can wait for


class ProcessPool(WorkerPool):
    """Up to `workers` processes, started as they are needed and replaced when one dies; `waits` as in `WorkerPool`.

    They end with this process, whatever ends it: each holds one end of a pipe, the leash, and leaves when the other end
    is gone.
    """

    def __init__(self, workers: int, waits: bool = False) -> None:
        self.waits = waits
        self._workers = min(workers, _MOST)
        self._context = get_context("spawn")
        self._leash, self._hand = self._context.Pipe(duplex=False)
        self._pool: ProcessPoolExecutor | None = None
        self._open: dict[Future[Any], Future[Any]] = {}  # the pool's, ours
        self._shut = False

    @property
    def width(self) -> int:
        """How many tasks run at once."""
        return self._workers

    def carries(self, work: Callable[[Any], Any]) -> bool:
        """True if it can be pickled: outlines of teeth that are local functions cannot."""
        try:
            pickle.dumps(work)
        except (AttributeError, TypeError, pickle.PicklingError):
            return False
        return True

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """As `Executor.submit`; after a worker died, in a fresh pool."""
        if self._shut:
            raise RuntimeError("cannot schedule new futures after shutdown")
        try:
            theirs = self._handed(fn, *args, **kwargs)
        except BrokenExecutor:
            self._abandon()
            theirs = self._handed(fn, *args, **kwargs)
        ours = follow(theirs, _translate)
        self._open[theirs] = ours
        theirs.add_done_callback(self._closed)
        return ours

    def _closed(self, theirs: Future[Any]) -> None:
        self._open.pop(theirs, None)

    def _handed(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        # a pool is made outside: it starts the tracker of multiprocessing, which lets signals through again
        if self._pool is None:
            self._pool = ProcessPoolExecutor(self._workers, self._context, _begin, (self._leash,))
        with _deaf():
            theirs = self._pool.submit(fn, *args, **kwargs)
        _bear_cancellation(theirs)
        return theirs

    def _abandon(self) -> None:
        """The pool is broken and goes. Its futures fail here: one that was handed over just then would stay open."""
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.shutdown(wait=False, cancel_futures=True)
        for future in list(self._open.values()):
            with suppress(InvalidStateError):
                future.set_exception(WorkerDiedError("a worker process died"))
        self._open.clear()

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """As `Executor.shutdown`; with `wait` nothing is left of the workers."""
        if self._pool is not None:
            self._pool.shutdown(wait, cancel_futures=cancel_futures)
        self._shut = True
        if wait:
            self._hand.close()
            self._leash.close()

    def dismiss(self) -> None:
        """End the workers, with what they still run."""
        if self._open:
            self._hand.close()
        self.shutdown(cancel_futures=True)


def _bear_cancellation(future: Future[Any]) -> None:
    """Let a future that was cancelled fail in silence.

    When workers end just after a future was cancelled, the thread of the pool still has it on its list of those that
    fail; before Python 3.12 it dies of that one with a traceback, and leaves the others open.
    """
    fail = future.set_exception

    def set_exception(error: BaseException | None) -> None:
        with suppress(InvalidStateError):
            fail(error)

    future.set_exception = set_exception  # type: ignore[method-assign, assignment]


def _translate(error: BaseException) -> BaseException:
    return WorkerDiedError("a worker process died") if isinstance(error, BrokenExecutor) else error


@contextmanager
def _deaf() -> Iterator[None]:
    """Start processes that never hear Ctrl-C, not even before `_begin`: it is this one's to say what is kept.

    A process inherits the signals its parent holds back. One that comes meanwhile is delivered afterwards.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin(leash: Connection) -> None:
    """What a worker does first."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_hold, args=(leash,), daemon=True).start()


def _hold(leash: Connection) -> None:
    """Leave when the other end of the leash is gone."""
    with suppress(OSError, EOFError):
        leash.poll(None)
    os._exit(1)


def cores() -> int:
    """The number of cores that this process may use, its affinity respected; at least 1."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


@contextmanager
def open_executor(
    workers: int | None = None, dask: str | None = None, announce: Announcement | None = None
) -> Iterator[Executor | None]:
    """An executor for `run`, or None where one worker is enough: then the work is done in this process.

    A context manager: leaving it ends what is still running.

    Parameters
    ----------
    workers : int, optional
        Processes on this machine, 1 or more, started with the first task. By default as many as this process may use
        cores; they are started only if the work is not nearly finished after a second in this process.
    dask : str, optional
        Address of a dask scheduler, such as `tcp://10.0.0.1:8786`: its workers do the work. Needs the extra `dask`,
        and geartrain in the same version on the cluster.
    announce : callable, optional
        Called once with (tasks, workers) when other processes begin to work.

    Yields
    ------
    concurrent.futures.Executor or None
        What `run` and `Execution` take; it survives the death of workers.

    Raises
    ------
    QuestionError
        If both are given, or `workers` is below 1.
    MissingExtraError
        If an address is given without the extra.
    GearTrainError
        If the cluster does not answer or cannot work.

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
        why = "the number of workers of a cluster is set where it is started"
        raise QuestionError(Problem("both workers and a dask scheduler are given", why, "give one of the two"))
    if workers is not None and workers < 1:
        raise QuestionError(Problem(f"{workers} workers", "at least one is needed to do the work", "ask for 1 or more"))
    if dask is not None:
        from geartrain.numerics.work.cluster import DaskPool

        return DaskPool(dask)
    count = _default_count() if workers is None else workers
    if count == 1:
        return None
    return ProcessPool(count, waits=workers is None)


def _default_count() -> int:
    """All cores; 1 in a worker of `multiprocessing.Pool`, which may not start processes."""
    started = sys.modules.get("multiprocessing.process")
    return 1 if started is not None and started.current_process().daemon else cores()
