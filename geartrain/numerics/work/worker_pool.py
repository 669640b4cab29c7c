"""Base class of executors whose workers can die."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor
from typing import Any

Announcement = Callable[[int, int], None]
"""Function called with (tasks, workers) when other processes first work; 0 tasks if their number is unknown."""


class WorkerPool(Executor, ABC):
    """Executor that continues if workers die: the futures of a dead worker fail with an error for which `deaths` is
    positive, and further tasks can be submitted.

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
        """Return True if workers can receive this function; False if its tasks must run in this process."""
        del work
        return True

    def deaths(self, error: Exception) -> int:
        """Return the number of workers that died when a task failed with this error; 0 for any other failure."""
        return int(isinstance(error, BrokenExecutor))

    def begin(self, tasks: int) -> None:
        """Report at the first call that other processes will perform `tasks` tasks (0 if the number is unknown)."""
        # only the first call has an announcement
        announce, self.announce, self.waits = self.announce, None, False
        if announce is not None:
            announce(tasks, min(self.width, tasks or self.width))

    def check(self) -> None:
        """Raise `GearTrainError` if no pending task can finish; this is called every few seconds while waiting."""

    @abstractmethod
    def dismiss(self) -> None:
        """End the workers and their running tasks, or disconnect from them."""
