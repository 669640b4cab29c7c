"""How a long run is done: by which executor, with which journal, and where its progress is reported."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from geartrain.numerics.work.journal import Journal
from geartrain.numerics.work.task_runner import ProgressReport, run


@dataclass(frozen=True, slots=True)
class Execution:
    """How the independent tasks of a long question are done; the default does them in this process and keeps nothing.

    Attributes
    ----------
    executor : concurrent.futures.Executor or None
        What runs the tasks; None for this process. `open_executor` makes one.
    journal : Journal or None
        Where finished work is kept, to be taken up again.
    tell : callable or None
        Called with (tasks done, tasks in all), at most ten times a second and at the end.

    Examples
    --------
    >>> told = []
    >>> list(Execution(tell=lambda done, total: told.append((done, total))).run(abs, [-1, 2]))
    [1, 2]
    >>> told[-1]
    (2, 2)
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: ProgressReport | None = None

    def run(self, work: Callable[[Any], Any], tasks: Iterable[Any]) -> Iterator[Any]:
        """Results in the order of the tasks, as `geartrain.numerics.run`.

        Parameters
        ----------
        work : callable
            A function at the top of a module.
        tasks : iterable
            What it is called with.
        """
        return run(work, tasks, self.executor, self.journal, self.tell)
