"""The workers of a dask cluster: the same call, on machines that are already running.

What the cluster does itself is left to it: when one of its workers dies, its tasks go to another one. Here the client
is kept silent, what it raises is put in the words of this project, and a cluster that can do nothing any more is
noticed.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, InvalidStateError, ThreadPoolExecutor
from concurrent.futures import wait as waiting
from contextlib import ExitStack, contextmanager, suppress
from importlib.metadata import PackageNotFoundError, version
from time import monotonic
from typing import Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem
from geartrain.numerics.work.worker_pool import WorkerDiedError, WorkerPool

try:
    import distributed
    import distributed.comm
    from distributed.scheduler import KilledWorker
except ImportError:
    raise MissingExtraError("distributed", "dask", "work on a cluster") from None

dask: Any = distributed  # it carries no types
_ANSWER = 5.0  # s: for the scheduler to answer, and for a first worker to be there
_PATIENCE = 60.0  # s without any worker, after which none is expected to come back
_DEATHS = 2  # what a task counts that the cluster gave up: it goes on alone at once, for workers died with it before


def connect(address: str, answer: float = _ANSWER, patience: float = _PATIENCE) -> DaskPool:
    """The cluster of the scheduler at `address`.

    answer    s to wait for the scheduler, and again for its first worker
    patience  s for which a running cluster may be without workers

    Raises `GearTrainError` if no scheduler answers, if there are no workers, or if they cannot run geartrain.
    """
    with ExitStack() as undo:
        undo.enter_context(_silence())
        try:
            with ThreadPoolExecutor(1) as aside:  # a notebook has a loop of its own running in this thread
                aside.submit(asyncio.run, _knock(address, answer)).result()
            client = dask.Client(address, timeout=answer, set_as_default=False, name="geartrain")
        except Exception as error:  # what is no scheduler may answer anything
            raise _unreachable(address, error) from None
        undo.callback(_close, client)
        try:
            client.wait_for_workers(1, timeout=answer)
        except TimeoutError:
            raise _empty(f"the scheduler at {address} has no workers", answer, address) from None
        _compare(client, address)
        return DaskPool(client, address, patience, undo.pop_all())


async def _knock(address: str, answer: float) -> None:
    """See whether a scheduler answers. A client that finds none would try again when it is thrown away."""
    if not address:
        raise ValueError("the address is empty")
    manners = dask.Security().get_connection_args("client")
    door = await dask.comm.connect(address, timeout=answer, **manners)
    await door.close()


class DaskPool(WorkerPool):
    """The workers of a scheduler, through its client. Made by `connect`."""

    def __init__(self, client: Any, address: str, patience: float, undo: ExitStack) -> None:
        self._client, self._address, self._patience, self._undo = client, address, patience, undo
        self._open: dict[Future[Any], Any] = {}  # ours, the cluster's
        self._missed: float | None = None  # when it was first seen without workers, since the last sign of one
        self._width = self._threads()

    def _threads(self) -> int:
        """Tasks that run at once, all workers together."""
        return sum(self._client.nthreads().values())

    @property
    def width(self) -> int:
        """How many tasks run at once; as it was when last looked at."""
        return max(1, self._width)

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """As `Executor.submit`."""
        theirs = self._client.submit(fn, *args, pure=False, **kwargs)  # never taken from a cache
        ours: Future[Any] = Future()
        self._open[ours] = theirs
        ours.add_done_callback(self._closed)
        self._client.loop.add_callback(self._deliver, theirs, ours)
        return ours

    async def _deliver(self, theirs: Any, ours: Future[Any]) -> None:
        """Wait for a result and hand it on. A result that is lost on its way, its worker dead, is worked out again.

        `Client.get_executor` does the same but for the last: it looks at a future's state after the result is there,
        and takes the result for an exception if the worker died in between.
        """
        try:
            result = await self._client.gather(theirs, asynchronous=True)
        except BaseException as error:
            with suppress(InvalidStateError):  # ours was cancelled in the meantime
                ours.set_exception(self._translate(error))
        else:
            self._missed = None
            theirs.release()  # or the cluster would work it out again if it lost it now
            with suppress(InvalidStateError):
                ours.set_result(result)

    def _closed(self, ours: Future[Any]) -> None:
        theirs = self._open.pop(ours)
        if ours.cancelled():
            with suppress(OSError, RuntimeError):  # a client that lost its scheduler has nothing to cancel
                theirs.cancel()

    def _translate(self, error: BaseException) -> BaseException:
        if isinstance(error, KilledWorker):
            return WorkerDiedError(str(error), _DEATHS)
        return self._lost() if isinstance(error, CancelledError | asyncio.CancelledError | OSError) else error

    def _lost(self) -> GearTrainError:
        return GearTrainError(
            Problem(
                f"the scheduler at {self._address} is gone",
                "it ended, or the connection to it did, and with it what was being worked out",
                "start it again and resume: what was finished is in the journal, if one was kept",
            )
        )

    def check(self) -> None:
        """See whether there are workers. Raises `GearTrainError` if the scheduler is gone, or no worker comes back."""
        try:
            self._width = self._threads()
        except OSError:
            raise self._lost() from None
        if self._width:
            self._missed = None
        elif self._missed is None:
            self._missed = monotonic()
        elif monotonic() - self._missed > self._patience:
            raise _empty(f"all workers of the scheduler at {self._address} are gone", self._patience, self._address)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """As `Executor.shutdown`; the cluster itself goes on."""
        open_now = list(self._open)
        if cancel_futures:
            for future in open_now:
                future.cancel()
        elif wait:
            waiting(open_now)
        self._undo.close()

    def dismiss(self) -> None:
        """Cancel what has not begun, and let go of the cluster. Results of tasks that run there are dropped."""
        self.shutdown(cancel_futures=True)


def _here() -> str:
    """The version of geartrain where this runs."""
    try:
        return version("geartrain")
    except PackageNotFoundError:
        return "unknown"


def _compare(client: Any, address: str) -> None:
    """Ask the scheduler and every worker for their geartrain. Raises `GearTrainError` where one has another, or none.

    The scheduler unpacks each task that it passes on, so it needs geartrain too.
    """
    ours = _here()
    found: dict[str, object] = {}
    try:
        found |= client.run(_here, on_error="return")
        found["a worker"] = client.submit(_here, pure=False).result(timeout=30)
    except Exception as error:  # whatever unpacking raises there
        found["the scheduler"] = error
    for who, theirs in found.items():
        if theirs != ours:
            said = f"{type(theirs).__name__}: {theirs}" if isinstance(theirs, BaseException) else f"geartrain {theirs}"
            raise GearTrainError(
                Problem(
                    f"the cluster at {address} cannot do the work of geartrain {ours}",
                    f"{who} says {said}".splitlines()[0],
                    f"install geartrain {ours} with the extra 'dask' for its scheduler and all its workers",
                )
            )


def _unreachable(address: str, error: Exception) -> GearTrainError:
    known = isinstance(error, OSError | ValueError) and str(error)
    why = str(error).splitlines()[0] if known else "something answers there that is none"
    fix = "check the address, and that `dask scheduler` runs there and prints the same address"
    return GearTrainError(Problem(f"no scheduler answers at {address!r}", why, fix))


def _empty(what: str, seconds: float, address: str) -> GearTrainError:
    fix = f"start some: `dask worker {address} --nthreads 1`, one for each core"
    return GearTrainError(Problem(what, f"none was there for {seconds:g} s", fix))


def _close(client: Any) -> None:
    with suppress(Exception):  # a client that lost its scheduler may fail to say goodbye
        client.close(timeout=2)


@contextmanager
def _silence() -> Iterator[None]:
    """Keep dask and what it stands on from writing to the terminal: what matters is raised."""
    names = [name for name in logging.root.manager.loggerDict if name.startswith(("distributed", "tornado", "asyncio"))]
    before = {name: logging.getLogger(name).level for name in {*names, "distributed", "tornado", "asyncio"}}
    for name in before:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for name, level in before.items():
            logging.getLogger(name).setLevel(level)
