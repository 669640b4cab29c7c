"""Base class of executors whose workers can die, and futures that follow another future."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, InvalidStateError
from contextlib import suppress
from typing import Any

Announcement = Callable[[int, int], None]
"""Function called with (tasks, workers) when a run first uses other processes; 0 tasks if their number is unknown."""


class WorkerDiedError(BrokenExecutor):
    """Error of a task during which workers died, `times` of them one after another."""

    def __init__(self, text: str, times: int = 1) -> None:
        super().__init__(text)
        self.times = times


class WorkerPool(Executor, ABC):
    """Executor that survives the death of workers: the future fails with `BrokenExecutor`, and the next submit works.

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

    def begin(self, tasks: int) -> None:
        """Report at the first call that other processes will do `tasks` tasks (0 if unknown)."""
        announce, self.announce, self.waits = self.announce, None, False
        if announce is not None:
            announce(tasks, min(self.width, tasks or self.width))

    def check(self) -> None:
        """Raise `GearTrainError` if no pending task can finish; called every few seconds while waiting."""

    @abstractmethod
    def dismiss(self) -> None:
        """End the workers and their running tasks, or disconnect from them."""


def follow(theirs: Future[Any], translate: Callable[[BaseException], BaseException]) -> Future[Any]:
    """Return a future that ends as `theirs` does, with its exception translated; its cancellation cancels `theirs`."""
    ours: Future[Any] = Future()

    def ended(_: Future[Any]) -> None:
        error = CancelledError() if theirs.cancelled() else theirs.exception()
        with suppress(InvalidStateError):  # our future was cancelled, or failed with its pool, in the meantime
            if error is None:
                ours.set_result(theirs.result())
            else:
                ours.set_exception(translate(error))

    def given_up(_: Future[Any]) -> None:
        if ours.cancelled():
            theirs.cancel()

    ours.add_done_callback(given_up)
    theirs.add_done_callback(ended)
    return ours
