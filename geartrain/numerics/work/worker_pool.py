"""What all executors share whose workers may die: pools, and futures that follow another one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, InvalidStateError
from contextlib import suppress
from typing import Any

Announcement = Callable[[int, int], None]
"""Called with (tasks, workers) when a run first uses other processes; 0 tasks where their number is not known."""


class WorkerDiedError(BrokenExecutor):
    """Workers died with a task: `times` of them, one after the other."""

    def __init__(self, text: str, times: int = 1) -> None:
        super().__init__(text)
        self.times = times


class WorkerPool(Executor, ABC):
    """An executor that survives the death of workers: a future fails with `BrokenExecutor`, the next submit works.

    announce   called when the first task is about to be handed over; then None
    waits      whether the first second of work is done in this process, in case that is all
    """

    announce: Announcement | None = None
    waits = False

    @property
    @abstractmethod
    def width(self) -> int:
        """How many tasks run at once; at least 1."""

    def carries(self, work: Callable[[Any], Any]) -> bool:
        """True if workers can be given this work; else it is done in this process."""
        del work
        return True

    def begin(self, tasks: int) -> None:
        """Other processes are about to do so many tasks (0: not known): announce it, the first time."""
        announce, self.announce, self.waits = self.announce, None, False
        if announce is not None:
            announce(tasks, min(self.width, tasks or self.width))

    def check(self) -> None:
        """Called every few seconds while nothing is finished. Raises `GearTrainError` where nothing ever will be."""

    @abstractmethod
    def dismiss(self) -> None:
        """End the workers, or disconnect from them, with what they still run."""


def follow(theirs: Future[Any], translate: Callable[[BaseException], BaseException]) -> Future[Any]:
    """A future that ends as `theirs` does, its exception translated; cancelling it cancels theirs."""
    ours: Future[Any] = Future()

    def ended(_: Future[Any]) -> None:
        error = CancelledError() if theirs.cancelled() else theirs.exception()
        with suppress(InvalidStateError):  # ours was cancelled, or failed with its pool, in the meantime
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
