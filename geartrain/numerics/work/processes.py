"""Worker processes on this machine.

Processes are spawned, not forked: a fork copies locks that other threads hold, on which a worker would wait forever.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Future, InvalidStateError, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Thread
from typing import Any

from geartrain.numerics.work.worker_pool import WorkerPool

_MOST = 61 if sys.platform == "win32" else 10_000  # processes: Windows cannot wait for more


class ProcessPool(WorkerPool):
    """Pool of up to `workers` processes, which are started on demand and replaced if they die. `waits` has the same
    meaning as in `WorkerPool`.

    The processes end when this process ends, even if it is killed. Each process has one end of a pipe (`leash`), and
    exits when the other end is closed.
    """

    def __init__(self, workers: int, waits: bool = False) -> None:
        self.waits = waits
        self._workers = min(workers, _MOST)
        self._context = get_context("spawn")
        self._leash, self._hand = self._context.Pipe(duplex=False)
        self._pool: ProcessPoolExecutor | None = None
        self._open: set[Future[Any]] = set()
        self._shut = False

    @property
    def width(self) -> int:
        """Number of tasks that run at the same time."""
        return self._workers

    def carries(self, work: Callable[[Any], Any]) -> bool:
        """Return True if the function can be pickled; False for other functions, such as local ones."""
        try:
            pickle.dumps(work)
        except (AttributeError, TypeError, pickle.PicklingError):
            return False
        return True

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit a call, as `Executor.submit` does. A new pool is started if a worker has died."""
        if self._shut:
            raise RuntimeError("cannot schedule new futures after shutdown")
        try:
            future = self._submit_to_pool(fn, *args, **kwargs)
        except BrokenExecutor:
            pool, self._pool = self._pool, None
            if pool is not None:
                pool.shutdown(wait=False, cancel_futures=True)
            for pending in list(self._open):  # a future that was submitted while the pool broke would never complete
                pending.set_exception(BrokenExecutor("a worker process died"))
            future = self._submit_to_pool(fn, *args, **kwargs)
        self._open.add(future)
        future.add_done_callback(self._open.discard)
        return future

    def _submit_to_pool(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        # not within `_interrupts_blocked`, because creating a pool starts a resource tracker, which unblocks signals
        if self._pool is None:
            self._pool = ProcessPoolExecutor(self._workers, self._context, _start_worker, (self._leash,))
        with _interrupts_blocked():
            future = self._pool.submit(fn, *args, **kwargs)
        _ignore_late_failure(future)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Stop the pool, as `Executor.shutdown` does. If `wait` is True, all workers have ended on return."""
        if self._pool is not None:
            self._pool.shutdown(wait, cancel_futures=cancel_futures)
        self._shut = True
        if wait:
            self._hand.close()
            self._leash.close()

    def dismiss(self) -> None:
        """End the workers and their running tasks."""
        if self._open:
            self._hand.close()
        self.shutdown(cancel_futures=True)


def _ignore_late_failure(future: Future[Any]) -> None:
    """Make a future ignore an exception that the pool sets after the future was cancelled or has failed."""
    # when workers die, the pool's thread sets an exception on all of its futures; if one of them was cancelled or
    # failed just before, this would end the thread with a traceback, and the other futures would never complete
    fail = future.set_exception

    def set_exception(error: BaseException | None) -> None:
        with suppress(InvalidStateError):
            fail(error)

    future.set_exception = set_exception  # type: ignore[method-assign, assignment]


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Start processes in this context with SIGINT blocked, so that only the parent process handles Ctrl-C."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _start_worker(leash: Connection) -> None:
    """Prepare a new worker: SIGINT is ignored, and the pipe to the parent process is watched."""

    def exit_with_parent() -> None:
        """Exit this process when the parent's end of the pipe is closed."""
        with suppress(OSError, EOFError):
            leash.poll(None)
        os._exit(1)

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=exit_with_parent, daemon=True).start()
