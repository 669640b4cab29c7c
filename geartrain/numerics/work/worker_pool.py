"""What the executors of this room have beyond those of the standard library."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, InvalidStateError
from contextlib import suppress
from typing import Any


class WorkerDiedError(BrokenExecutor):
    """Workers died with a task: `times` of them, one after the other."""

    def __init__(self, text: str, times: int = 1) -> None:
        super().__init__(text)
        self.times = times


class WorkerPool(Executor, ABC):
    """An executor that outlives its workers: a future fails with `BrokenExecutor`, the next submit works again."""

    @property
    @abstractmethod
    def width(self) -> int:
        """How many tasks run at once; at least 1."""

    def check(self) -> None:
        """Asked now and then while nothing is finished. Raises `GearTrainError` where nothing will ever be."""

    @abstractmethod
    def dismiss(self) -> None:
        """End the workers, or let go of them, with what they still run."""


def follow(theirs: Future[Any], translate: Callable[[BaseException], BaseException]) -> Future[Any]:
    """A future of ours that ends as theirs does, with what failed translated; cancelling ours cancels theirs."""
    ours: Future[Any] = Future()

    def ended(_: Future[Any]) -> None:
        error = CancelledError() if theirs.cancelled() else theirs.exception()
        with suppress(InvalidStateError):  # ours was cancelled, or given up, in the meantime
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
