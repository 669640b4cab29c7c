"""How a long run is done: who works, what is kept of it, who is told."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from geartrain.numerics.work.journal import Journal
from geartrain.numerics.work.task_runner import ProgressReport, run


@dataclass(frozen=True, slots=True)
class Execution:
    """How independent tasks are done; the default does them in this process and keeps nothing.

    executor   None: in this process; see `open_executor`
    journal    where finished work is kept, to be taken up again
    tell       called with (tasks done, tasks in all)
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: ProgressReport | None = None

    def run(self, work: Callable[[Any], Any], tasks: Iterable[Any]) -> Iterator[Any]:
        """Results in the order of the tasks; as `geartrain.numerics.work.run`."""
        return run(work, tasks, self.executor, self.journal, self.tell)
