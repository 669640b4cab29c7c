"""Executor for a dask cluster, through the `concurrent.futures` interface of its client.

If a worker dies, dask assigns its tasks to another one. This module adds error messages in the form of this package,
and an error if no worker is left.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from importlib import import_module
from importlib.metadata import version
from time import monotonic
from typing import Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem
from geartrain.numerics.work.worker_pool import WorkerPool

try:
    dask: Any = import_module("dask")  # it has no type annotations
    dask.config.set(
        {"logging": {"distributed": "critical", "distributed.client": "critical"}}
    )  # errors are raised instead
    distributed: Any = import_module("distributed")
except ImportError:
    raise MissingExtraError("distributed", "dask", "work on a cluster") from None

_TIMEOUT = 5.0  # s to wait for the scheduler, and for a first worker
_PATIENCE = 60.0  # s without any worker after which the run fails
_DEATHS = 2  # deaths counted for a task that dask gave up: it is run without others before it is reported


class DaskPool(WorkerPool):
    """Executor on the workers of the dask scheduler at `address`. Raises `GearTrainError` if no worker can be used."""

    def __init__(self, address: str, answer: float = _TIMEOUT) -> None:
        self._address, self._seen = address, monotonic()
        try:
            with ThreadPoolExecutor(1) as aside:  # in a notebook, this thread already runs an event loop
                aside.submit(asyncio.run, _check_scheduler(address, answer)).result()
            self._client = distributed.Client(address, timeout=answer, set_as_default=False)
        except (OSError, ValueError) as error:
            fix = "check the address, and that `dask scheduler` runs there and prints the same address"
            raise GearTrainError(Problem(f"no dask scheduler responds at {address!r}", str(error), fix)) from None
        try:
            self._client.wait_for_workers(1, timeout=answer)
            theirs = set(self._client.run(version, "geartrain", on_error="return").values())
        except TimeoutError:
            self.dismiss()
            raise self._empty("has no workers", answer) from None
        if theirs != {ours := version("geartrain")}:
            self.dismiss()
            fix = f"install geartrain {ours} with the extra 'dask' for the scheduler and all workers"
            found = ", ".join(sorted(map(str, theirs)))
            what = f"the cluster at {address} runs another version of geartrain than {ours}"
            raise GearTrainError(Problem(what, f"its workers run {found}", fix))
        self._threads: int = sum(self._client.nthreads().values())
        self._executor = self._client.get_executor(pure=False)  # results must not be taken from a cache

    @property
    def width(self) -> int:
        """Number of tasks that run at the same time on all workers."""
        return max(1, self._threads)

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit a call, as `Executor.submit` does."""
        future: Future[Any] = self._executor.submit(fn, *args, **kwargs)
        return future

    def deaths(self, error: Exception) -> int:
        """Return the number of workers that died when a task failed with this error.

        Exceptions raised by the work itself are returned as results, so any other error of a future is caused by the
        cluster.
        """
        return _DEATHS if isinstance(error, distributed.scheduler.KilledWorker) else 1

    def check(self) -> None:
        """Raise `GearTrainError` if the scheduler does not respond, or has had no workers for a minute."""
        try:
            self._threads = sum(self._client.nthreads().values())
        except OSError:
            self._threads = 0
        if self._threads:
            self._seen = monotonic()
        elif monotonic() - self._seen > _PATIENCE:
            raise self._empty("has lost all its workers", _PATIENCE)

    def dismiss(self) -> None:
        """Cancel pending tasks and disconnect from the cluster, which continues to run."""
        with suppress(Exception):  # a client that lost its scheduler may fail to disconnect
            self._client.close(timeout=2)

    def _empty(self, what: str, seconds: float) -> GearTrainError:
        fix = f"start workers: `dask worker {self._address} --nthreads 1`, one for each core"
        return GearTrainError(
            Problem(f"the scheduler at {self._address} {what}", f"no worker was connected for {seconds:g} s", fix)
        )


async def _check_scheduler(address: str, answer: float) -> None:
    """Raise `OSError` if no scheduler responds.

    A client without a scheduler would continue to retry after it is discarded.
    """
    secured = distributed.Security().get_connection_args("client")
    await (await distributed.core.connect(address, timeout=answer, **secured)).close()
