"""Ordered results of independent tasks, which are the same for every executor, even if workers die.

Results are converted to JSON text in the process that computes them, so that they do not depend on whether they come
from this process, another process, another machine or a journal: tuples become lists and keys become strings.
"""

from __future__ import annotations

import json
import os
import pickle
import sys
import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sized
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from fractions import Fraction
from queue import Empty, SimpleQueue
from time import monotonic
from typing import Any
from zlib import crc32

from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.work.journal import Journal
from geartrain.numerics.work.worker_pool import Announcement, WorkerPool

TaskFunction = Callable[[Any], Any]
ProgressReport = Callable[[int, int], None]

_MOST_DEATHS = 4  # deaths of workers after which the run fails
_PENDING_PER_WORKER = 4  # tasks submitted per worker, so that no worker waits for this process
_RESULTS_AHEAD = 64  # results per worker that may be ahead of the first missing one, which limits memory
_REPORT_INTERVAL = 0.1  # s between two calls of `tell`
_CHECK_INTERVAL = 2.0  # s between two checks of the executor
_FIRST_SECONDS = 1.0  # s of work that this process does first: starting a process takes about as long


def run(
    work: TaskFunction,
    tasks: Iterable[Any],
    executor: Executor | None = None,
    journal: Journal | None = None,
    tell: ProgressReport | None = None,
) -> Iterator[Any]:
    """Yield `work(task)` for each task, in the order of the tasks.

    If a worker dies, its unfinished tasks are repeated. A task that repeatedly kills workers is run without other tasks
    before an error is raised. Pending tasks are cancelled when the iterator ends for any reason.

    Parameters
    ----------
    work : callable
        Function at the top level of a module, so that other processes can import it. Its results are plain JSON data
        and depend only on the task.
    tasks : iterable
        Any number of tasks, which are read on demand. At most 64 results per worker are stored while an earlier result
        is missing.
    executor : concurrent.futures.Executor, optional
        Any executor; by default tasks run in this process. An executor from `open_executor` continues if workers die.
    journal : Journal, optional
        Journal of stored results, which are not computed again; new results are added.
    tell : callable, optional
        Progress function, called with (tasks done, total number of tasks) at most ten times a second and at the end.
        The total is 0 if `tasks` has no length.

    Yields
    ------
    plain data
        Results in the form read from JSON: tuples become lists, and keys become strings.

    Raises
    ------
    GearTrainError
        If a task kills its workers, or no worker is left. Exceptions of `work` are raised immediately.

    Examples
    --------
    >>> list(run(abs, [-3, 4]))
    [3, 4]
    """
    pace = _Progress(tell, len(tasks) if isinstance(tasks, Sized) else 0)
    if executor is None or (isinstance(executor, WorkerPool) and not executor.carries(work)):
        return _run_here(work, tasks, journal, pace)
    return _Run(work, tasks, executor, journal, pace).results()


@dataclass(frozen=True, slots=True)
class Execution:
    """Execution of independent tasks, by default in this process and without a journal.

    Examples
    --------
    >>> reports = []
    >>> list(Execution(tell=lambda done, total: reports.append((done, total))).run(abs, [-1, 2]))
    [1, 2]
    >>> reports[-1]
    (2, 2)
    """

    executor: Executor | None = None
    """Executor of the tasks, such as one from `open_executor`; None for this process."""
    journal: Journal | None = None
    """Journal of finished results, with which a run can be resumed."""
    tell: ProgressReport | None = None
    """Progress function, called with (tasks done, total number of tasks), at most ten times a second and at the end."""

    def run(self, work: Callable[[Any], Any], tasks: Iterable[Any]) -> Iterator[Any]:
        """Yield the results in the order of the tasks, as `geartrain.numerics.run` does.

        Parameters
        ----------
        work : callable
            Function at the top level of a module.
        tasks : iterable
            Tasks, each of which is the argument of one call.
        """
        return run(work, tasks, self.executor, self.journal, self.tell)


def _run_here(work: TaskFunction, tasks: Iterable[Any], journal: Journal | None, pace: _Progress) -> Iterator[Any]:
    pace.step(0)
    for index, task in enumerate(tasks):
        mark = mark_of(task) if journal is not None else ""
        text = journal.recall(index, mark) if journal is not None else None
        if text is None:
            text = as_text(work(task))
            if journal is not None:
                journal.keep(index, mark, text)
        pace.step()
        yield json.loads(text)
    pace.end()


class _Progress:
    """Counter of finished tasks. It reports them at most once per `_REPORT_INTERVAL`."""

    def __init__(self, tell: ProgressReport | None, total: int) -> None:
        self.tell, self.total, self.done = tell, total, 0
        self._reported = -1
        self._at = -_REPORT_INTERVAL

    def step(self, count: int = 1) -> None:
        """Count further tasks as done, and report the progress if enough time has passed since the last report."""
        self.done += count
        if self.tell and (monotonic() - self._at >= _REPORT_INTERVAL or self.done == self.total):
            self._report(self.tell)

    def end(self) -> None:
        if self.tell and self._reported != self.done:
            self._report(self.tell)

    def _report(self, tell: ProgressReport) -> None:
        self._reported, self._at = self.done, monotonic()
        tell(self.done, self.total)


@dataclass(slots=True)
class _Submission:
    """Submitted task; `deaths` counts the workers that died while it was running or queued."""

    index: int
    task: Any
    mark: str
    deaths: int = 0


class _Run:
    """Execution of tasks by an executor: tasks to be submitted, pending futures, and results to be yielded in order."""

    def __init__(
        self, work: TaskFunction, tasks: Iterable[Any], executor: Executor, journal: Journal | None, pace: _Progress
    ) -> None:
        self.work, self.executor, self.journal, self.pace = work, executor, journal, pace
        self.tasks = iter(enumerate(tasks))
        self.ended: SimpleQueue[Future[Any]] = SimpleQueue()
        self.pending: dict[Future[Any], _Submission] = {}
        self.again: deque[_Submission] = deque()
        self.ready: dict[int, str] = {}
        self.next = self.issued = 0
        self.exhausted = False
        self.checked = monotonic()

    def results(self) -> Iterator[Any]:
        try:
            self.pace.step(0)
            if isinstance(self.executor, WorkerPool) and self.executor.waits:
                yield from self._first_results()
            while True:
                self._fill()
                for result in self._due():
                    yield result
                    self._fill()
                if not self.pending and not self.again and self.exhausted:
                    break
                self._process_next()
            self.pace.end()
        finally:
            self._cancel()

    def _first_results(self) -> Iterator[Any]:
        """Yield the first results, computed in this process until starting workers is worthwhile."""
        done, spent = 0, 0.0
        while not self.exhausted:
            submission = self._next_task()
            if submission is not None:
                begun = monotonic()
                self._finished(submission, as_text(self.work(submission.task)))
                done, spent = done + 1, spent + monotonic() - begun
            yield from self._due()
            rest = spent / done * (self.pace.total - self.pace.done) if done and self.pace.total else spent
            if min(spent, rest) > _FIRST_SECONDS:
                return

    def _due(self) -> Iterator[Any]:
        while self.next in self.ready:
            text = self.ready.pop(self.next)
            self.next += 1
            yield json.loads(text)

    @property
    def _width(self) -> int:
        return self.executor.width if isinstance(self.executor, WorkerPool) else cores()

    def _fill(self) -> None:
        """Submit tasks until enough are pending; if a worker died during a task, run this task without other tasks."""
        if any(each.deaths for each in self.pending.values()):
            return
        if self.again:
            if not self.pending:
                self._submit(self.again.popleft())
            return
        width = self._width
        while len(self.pending) < _PENDING_PER_WORKER * width and self.issued < self.next + _RESULTS_AHEAD * width:
            submission = self._next_task()
            if submission is None:
                return
            self._submit(submission)

    def _next_task(self) -> _Submission | None:
        """Return the next task that is not in the journal; None if too many results are stored, or no task is left."""
        for index, task in self.tasks:
            self.issued = index + 1
            mark = mark_of(task) if self.journal is not None else ""
            text = self.journal.recall(index, mark) if self.journal is not None else None
            if text is None:
                return _Submission(index, task, mark)
            self.ready[index] = text
            self.pace.step()
            # results of a journal are limited like others, so that they do not fill the memory
            if self.issued >= self.next + _RESULTS_AHEAD * self._width:
                return None
        self.exhausted = True
        return None

    def _submit(self, submission: _Submission) -> None:
        if isinstance(self.executor, WorkerPool):
            self.executor.begin(max(self.pace.total - self.pace.done, 0))
        try:
            future = self.executor.submit(carry, self.work, submission.task)
        except BrokenExecutor:
            why = "one of its workers died, and it does not start new workers"
            fix = "use the executor of open_executor, which survives the death of workers"
            raise GearTrainError(Problem("the executor is broken", why, fix)) from None
        self.pending[future] = submission
        future.add_done_callback(self.ended.put)

    def _process_next(self) -> None:
        """Wait for the next future that ends; store its result, or queue its task again if its worker died."""
        pool = self.executor if isinstance(self.executor, WorkerPool) else None
        future = None
        while future is None:
            if pool is not None and monotonic() - self.checked > _CHECK_INTERVAL:
                pool.check()
                self.checked = monotonic()
            with suppress(Empty):
                future = self.ended.get(timeout=_CHECK_INTERVAL)
        submission = self.pending.pop(future)
        try:
            outcome = future.result()
        except CancelledError:
            why = "its executor was shut down, or lost its scheduler, before the work was done"
            fix = "run it again; finished tasks are in the journal, if there is one"
            raise GearTrainError(Problem("the work was interrupted", why, fix)) from None
        except Exception as error:
            deaths = pool.deaths(error) if pool is not None else int(isinstance(error, BrokenExecutor))
            if not deaths:
                raise
            submission.deaths += deaths
            if submission.deaths >= _MOST_DEATHS:
                raise _killer_error(submission) from None
            self.again.append(submission)
        else:
            if isinstance(outcome, RemoteFailure):
                raise outcome.error()
            self._finished(submission, outcome)

    def _finished(self, submission: _Submission, text: str) -> None:
        if self.journal is not None:
            self.journal.keep(submission.index, submission.mark, text)
        self.ready[submission.index] = text
        self.pace.step()

    def _cancel(self) -> None:
        """Cancel all pending tasks, and store the results of tasks that finished in the meantime."""
        for future in self.pending:
            future.cancel()
        for future, submission in self.pending.items():
            if future.done() and not future.cancelled() and not future.exception():
                outcome = future.result()
                if isinstance(outcome, str) and self.journal is not None and not self.journal.closed:
                    with suppress(GearTrainError):  # it would hide the error that ends the run
                        self.journal.keep(submission.index, submission.mark, outcome)
        self.pending.clear()


def _killer_error(submission: _Submission) -> GearTrainError:
    shown = repr(submission.task)
    shown = shown if len(shown) <= 200 else f"{shown[:200]}..."
    return GearTrainError(
        Problem(
            f"task {submission.index} terminated its worker: {shown}",
            f"{submission.deaths} worker processes died while they ran this task; the last one ran no other task. "
            "Possible causes are too little memory, a signal from another process, and an error at start-up",
            "provide more memory, or use smaller tasks or fewer workers. A script that starts workers needs the line "
            'if __name__ == "__main__": before its code',
        )
    )


@dataclass(frozen=True, slots=True)
class RemoteFailure:
    """Exception raised in a worker, in a form that can always be transferred to another process.

    A process pool treats an exception that it cannot unpickle as a dead worker. An exception whose `__init__` takes
    arguments other than its text is corrupted by pickling.
    """

    trace: str
    """Traceback in the worker, as text."""
    kind: type[GearTrainError] | None = None
    """Class of the exception if it is a `GearTrainError`; None for other exceptions."""
    problems: tuple[Problem, ...] = ()
    """Problems of the exception if it is a `GearTrainError`; empty for other exceptions."""
    pickled: bytes = b""
    """Pickled form of any other exception; empty if it cannot be pickled without loss."""

    def error(self) -> Exception:
        """Return the exception, with the worker's traceback as a note."""
        error: Exception
        if self.kind is not None:
            error = self.kind.__new__(self.kind)
            GearTrainError.__init__(error, self.problems)
        elif self.pickled:
            error = pickle.loads(self.pickled)
        else:
            error = RuntimeError(self.trace.rstrip().rpartition("\n")[2])
        error.add_note(f"raised in a worker:\n{self.trace}")
        return error


def as_text(result: Any) -> str:
    """Return a result as one line of JSON. Raises `TypeError` if it is not plain data."""
    return json.dumps(result, separators=(",", ":"))


def carry(work: Callable[[Any], Any], task: Any) -> str | RemoteFailure:
    """Return the result of the function `work` for one task as JSON text, or the exception that it raised."""
    try:
        return as_text(work(task))
    except Exception as error:
        return raised(error)


def raised(error: Exception) -> RemoteFailure:
    """Return an exception in a form that can be transferred to another process."""
    trace = "".join(traceback.format_exception(error))
    if isinstance(error, GearTrainError):
        return RemoteFailure(trace, type(error), error.problems)
    try:
        pickled = pickle.dumps(error)
        back = pickle.loads(pickled)
    except Exception:  # pickling runs code of the exception
        return RemoteFailure(trace)
    # an exception whose __init__ takes other arguments may be unpickled with another text or as another class
    faithful = type(back) is type(error) and str(back) == str(error)
    return RemoteFailure(trace, pickled=pickled if faithful else b"")


def mark_of(task: Any) -> str:
    """Return a checksum of a task, by which a journal identifies it; empty if the task cannot be written as JSON."""
    try:
        text = json.dumps(task, separators=(",", ":"), default=_fraction)
    except (TypeError, ValueError):
        return ""
    return f"{crc32(text.encode()):08x}"


def _fraction(value: Any) -> str:
    if isinstance(value, Fraction):
        return fraction_text(value)
    raise TypeError


def cores() -> int:
    """Return the number of processor cores that this process may use according to its affinity; at least 1."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


@contextmanager
def open_executor(
    workers: int | None = None, dask: str | None = None, announce: Announcement | None = None
) -> Iterator[Executor | None]:
    """Return a context manager that yields an executor for `run`, or None if the tasks run in this process.

    All running work is ended when the context is left.

    Parameters
    ----------
    workers : int, optional
        Number of processes on this machine, 1 or more; they are started with the first task. The default is the number
        of cores available to this process. By default, processes are started only if the work is not nearly finished
        after one second in this process.
    dask : str, optional
        Address of a dask scheduler, such as `tcp://10.0.0.1:8786`, whose workers run the tasks. It requires the extra
        `dask`, and the same version of geartrain on the cluster.
    announce : callable, optional
        Function that is called once with (tasks, workers) when other processes begin to work.

    Yields
    ------
    concurrent.futures.Executor or None
        Executor for `run` and `Execution`; it continues if workers die.

    Raises
    ------
    QuestionError
        If both `workers` and `dask` are given, or if `workers` is below 1.
    MissingExtraError
        If `dask` is given and the extra `dask` is not installed.
    GearTrainError
        If the cluster does not respond or cannot work.

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
        why = "the number of workers of a cluster is set when it is started"
        raise QuestionError(Problem("both workers and a dask scheduler are given", why, "give only one of them"))
    if workers is not None and workers < 1:
        what = f"the number of workers is {workers}"
        raise QuestionError(Problem(what, "a run has at least one worker", "give 1 or more"))
    if dask is not None:
        from geartrain.numerics.work.cluster import DaskPool

        return DaskPool(dask)
    if workers is None:
        # a worker of `multiprocessing.Pool` is a daemon, which must not start processes
        started = sys.modules.get("multiprocessing.process")
        count = 1 if started is not None and started.current_process().daemon else cores()
    else:
        count = workers
    if count == 1:
        return None
    from geartrain.numerics.work.processes import ProcessPool

    return ProcessPool(count, waits=workers is None)
