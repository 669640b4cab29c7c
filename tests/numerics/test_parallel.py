"""Independent work: the same results whoever does it, whoever dies, and wherever it is cut."""

from __future__ import annotations

import json
import math
import multiprocessing
import os
import random
import resource
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from contextlib import closing, contextmanager
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from threading import Lock
from typing import Any

import pytest
from clusters import (
    PATIENCE,
    alive,
    begun,
    deadly,
    failing,
    gated,
    mixed,
    not_plain,
    slow,
    small_cluster,
    until,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from places import TESTS

from geartrain.errors import GearTrainError, MissingExtraError, QuestionError
from geartrain.numerics import Journal, open_executor, run
from geartrain.numerics.work import cores
from geartrain.numerics.work.worker_pool import WorkerPool


@pytest.fixture(scope="module", autouse=True)
def light_workers() -> Iterator[None]:
    """A spawned process imports the main module of its parent: here that would be all of pytest."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys.modules["__main__"], "__spec__", None)
        patch.delattr(sys.modules["__main__"], "__file__", raising=False)
        yield


@pytest.fixture(scope="module")
def processes() -> Iterator[Executor]:
    with open_executor(2) as executor:
        assert executor is not None
        yield executor


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    pytest.importorskip("distributed")
    with small_cluster() as cluster:
        yield cluster


@pytest.fixture(scope="module")
def dask(cluster: Any) -> Iterator[Executor]:
    with open_executor(dask=cluster.scheduler_address) as executor:
        assert executor is not None
        yield executor


@pytest.fixture(params=["processes", "dask"])
def crew(request: pytest.FixtureRequest) -> Executor:
    """Workers that can die."""
    return request.getfixturevalue(request.param)


@pytest.fixture(params=["here", "threads", "processes", "dask"])
def executor(request: pytest.FixtureRequest) -> Iterator[Executor | None]:
    """Everybody."""
    if request.param == "here":
        yield None
    elif request.param == "threads":
        with ThreadPoolExecutor(3) as threads:
            yield threads
    else:
        yield request.getfixturevalue(request.param)


# first, because the threads of a cluster use `random`, which hypothesis reports as an error
@settings(max_examples=30)
@given(
    width=st.integers(1, 4),
    deadly=st.dictionaries(st.integers(0, 39), st.sampled_from([1, 1, 1, 99]), max_size=6),
    seed=st.integers(0, 999),
)
def test_only_a_task_that_kills_is_blamed_and_one_accident_is_forgiven(
    width: int, deadly: dict[int, int], seed: int
) -> None:
    killers = {task for task, times in deadly.items() if times == 99}
    with closing(Mortal(width, dict(deadly), seed)) as crew:
        results = run(abs, range(40), crew)
        if killers:
            with pytest.raises(GearTrainError, match="terminated its worker") as caught:
                list(results)
            assert int(caught.value.problems[0].what.split()[1]) in killers
        else:
            assert list(results) == list(range(40))
        assert crew.most <= 4 * width


def test_results_come_in_the_order_of_the_tasks_and_are_the_same_whoever_works(executor: Executor | None) -> None:
    wanted = [
        {"n": n, "third": n / 3, "huge": n**40, "pair": [n, None], "text": "Zähne\n", "no": []} for n in range(40)
    ]
    assert list(run(mixed, range(40), executor)) == wanted


def test_a_journal_changes_no_result_and_gives_it_again_without_work(executor: Executor | None, tmp_path: Path) -> None:
    plain = list(run(gated, [(str(tmp_path), n, 99) for n in range(30)], executor))
    for _ in range(2):
        with Journal(tmp_path / "journal", {"requested": 1}) as journal:
            assert list(run(gated, [(str(tmp_path), n, 99) for n in range(30)], executor, journal)) == plain
            assert len(journal) == 30
    assert sorted(number for number, _ in begun(tmp_path)) == sorted(2 * list(range(30)))


@pytest.mark.parametrize("kind", ["ours", "awkward", "theirs"])
def test_what_the_work_raises_goes_up_whole(executor: Executor | None, kind: str, tmp_path: Path) -> None:
    tasks = [(str(tmp_path), n, kind) for n in range(4000)]
    with pytest.raises(Exception, match=r"what|this and that|5") as caught:
        list(run(failing, tasks, executor))
    if kind == "ours":
        assert isinstance(caught.value, QuestionError)
        assert str(caught.value) == "place: what\n  why: why\n  fix: fix\nmore"
        assert [problem.place for problem in caught.value.problems] == ["place", ""]
    assert len(begun(tmp_path)) < 4000, "the others are cancelled"
    if executor is not None:
        assert list(run(mixed, range(3), executor)) == list(run(mixed, range(3))), "the executor goes on"


def test_a_result_that_is_no_plain_data_is_refused_by_everybody(executor: Executor | None) -> None:
    with pytest.raises(TypeError, match="JSON"):
        list(run(not_plain, [1], executor))


def test_tasks_are_taken_as_they_are_needed(executor: Executor | None, tmp_path: Path) -> None:
    taken = 0

    def endless() -> Iterator[int]:
        nonlocal taken
        while True:
            yield taken
            taken += 1

    with Journal(tmp_path / "journal", {}) as journal, closing(run(mixed, endless(), executor, journal)) as results:
        assert [next(results)["n"] for _ in range(60)] == list(range(60))
    assert taken <= 60 + 64 * (cores() + 2)
    taken = 0
    with Journal(tmp_path / "journal", {}) as journal, closing(run(mixed, endless(), executor, journal)) as results:
        assert next(results)["n"] == 0
        assert taken <= 64 * (cores() + 2), "kept results are not all read at once either"


def test_progress_is_told_at_most_ten_times_a_second_and_to_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0

    def work(_: int) -> None:
        nonlocal now
        now += 0.03

    monkeypatch.setattr("geartrain.numerics.work.task_runner.monotonic", lambda: now)
    told: list[tuple[int, int, float]] = []
    list(run(work, range(50), tell=lambda done, total: told.append((done, total, now))))
    assert told[0][:2] == (0, 50)
    assert told[-1][:2] == (50, 50)
    times = [at for _, _, at in told[:-1]]
    assert min(b - a for a, b in pairwise(times)) >= 0.1
    assert len(told) == 14  # 1.5 s, every fourth task, and the last word
    told.clear()
    list(run(work, iter(range(7)), tell=lambda done, total: told.append((done, total, now))))
    assert told[-1][:2] == (7, 0)


def test_a_worker_killed_in_the_middle_costs_nothing_but_time(
    crew: Executor, processes: Executor, tmp_path: Path
) -> None:
    tasks = [(str(tmp_path), n, 6) for n in range(30)]
    with Journal(tmp_path / "journal", {}) as journal:
        results = run(gated, tasks, crew, journal)
        first = [next(results) for _ in range(6)]
        waiting = until(lambda: {pid: n for n, pid in begun(tmp_path) if n >= 6 and alive(pid)}, "a task at the gate")
        victim, task = next(iter(waiting.items()))
        os.kill(victim, signal.SIGKILL)
        (tmp_path / "gate").touch()
        assert first + list(results) == [n**2 for n in range(30)]
        assert len(journal) == 30
    runs = [n for n, _ in begun(tmp_path)]
    assert runs.count(task) >= 2, "what the dead worker did was begun again"
    if crew is processes:  # a cluster may be told too late that a result has arrived
        assert [runs.count(n) for n in range(6)] == [1] * 6, "what was finished was not"


def test_a_task_that_always_kills_its_worker_is_named_and_no_other_is(processes: Executor, tmp_path: Path) -> None:
    with Journal(tmp_path / "journal", {}) as journal:
        with pytest.raises(GearTrainError, match="task 5 terminated its worker") as caught:
            list(run(deadly, [(str(tmp_path), n, 99) for n in range(30)], processes, journal))
        assert "4 worker processes" in caught.value.problems[0].why
        assert "__main__" in caught.value.problems[0].fix
        assert len(journal) >= 5, "what came before it is kept"
    assert sum(n == 5 for n, _ in begun(tmp_path)) == 4


def test_a_cluster_gives_up_a_task_that_kills_its_workers(cluster: Any, dask: Executor, tmp_path: Path) -> None:
    before, cluster.scheduler.allowed_failures = cluster.scheduler.allowed_failures, 0
    try:
        with pytest.raises(GearTrainError, match="task 5 terminated its worker"):
            list(run(deadly, [(str(tmp_path), n, 99) for n in range(12)], dask))
    finally:
        cluster.scheduler.allowed_failures = before
    assert 2 <= sum(n == 5 for n, _ in begun(tmp_path)) <= 4
    assert list(run(mixed, range(3), dask)) == list(run(mixed, range(3)))


class Mortal(WorkerPool):
    """A pool in this process: tasks end in any order; those that are deadly so many times take all others along."""

    def __init__(self, width: int, deadly: dict[int, int], seed: int) -> None:
        self._width, self.deadly, self.draw = width, deadly, random.Random(seed)
        self.waiting: list[tuple[Future[Any], Any, Any]] = []
        self.died: Counter[int] = Counter()
        self.most = 0
        self.lock, self.thread = Lock(), ThreadPoolExecutor(1)

    @property
    def width(self) -> int:
        return self._width

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        with self.lock:
            self.waiting.append((future, fn, args))
            self.most = max(self.most, len(self.waiting))
            if any(self.died[task] >= 2 for _, _, (_, task) in self.waiting):
                assert len(self.waiting) == 1, "a suspect runs alone"
        self.thread.submit(self.step)
        return future

    def step(self) -> None:
        with self.lock:
            ended = self.waiting.pop(self.draw.randrange(len(self.waiting))) if self.waiting else None
            if ended is None:
                return
            future, fn, args = ended
            gone = []
            if self.deadly.get(args[1], 0):
                self.deadly[args[1]] -= 1
                gone, self.waiting = [ended, *self.waiting], []
                self.died.update(task for _, _, (_, task) in gone)
        for each, _, _ in gone:
            each.set_exception(BrokenExecutor("killed"))
        if not gone:
            future.set_result(fn(*args))

    def close(self) -> None:
        self.thread.shutdown()

    def dismiss(self) -> None:
        self.close()


def test_a_pool_that_stays_broken_is_said() -> None:
    class Plain(Executor):
        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            raise BrokenExecutor

    with pytest.raises(GearTrainError, match="the executor is broken"):
        list(run(abs, [1], Plain()))


def test_leaving_ends_what_still_runs(tmp_path: Path) -> None:
    with open_executor(2) as executor:
        future = executor.submit(gated, (str(tmp_path), 0, 0))
        until(lambda: begun(tmp_path), "a task at the gate")
    assert future.done()
    assert not any(alive(pid) for _, pid in begun(tmp_path))
    with pytest.raises(RuntimeError, match="shutdown"):
        executor.submit(gated, (str(tmp_path), 0, 0))


def test_tasks_cancelled_just_before_a_worker_dies_upset_nothing(tmp_path: Path) -> None:
    """The pool's own thread would end with a traceback, which pytest reports, and leave futures open."""
    with open_executor(2) as executor:
        futures = [executor.submit(gated, (str(tmp_path), n, 0)) for n in range(9)]
        until(lambda: begun(tmp_path), "a task at the gate")
        assert [future.cancel() for future in futures[5:]] == [True] * 4
        os.kill(begun(tmp_path)[0][1], signal.SIGKILL)
        for future in futures[:5]:
            with pytest.raises(BrokenExecutor):
                future.result(timeout=PATIENCE)


def kept(path: Path, question: Any, results: list[Any]) -> bytes:
    """The bytes of a journal of these results, finished in another order than asked."""
    with Journal(path, question) as journal:
        for number in sorted(range(len(results)), key=lambda n: (n * 7) % 5):
            journal.keep(number, f"{number:08x}", json.dumps(results[number]))
    return path.read_bytes()


@pytest.fixture
def no_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many small journals need not reach the disk."""
    monkeypatch.setattr(os, "fsync", lambda _: None)


RESULTS: list[Any] = [[1, 2.5e-300, 'zwölf {"task":3}\n'], {}, None, {"a": [{"b": 0.1}]}, 10**50, -0.0]


def test_a_journal_cut_at_any_byte_is_taken_up_and_ends_the_same(no_disk: None, tmp_path: Path) -> None:
    path = tmp_path / "journal"
    question = {"ratio": "235/19", "wheels": [15, 16]}
    whole = kept(path, question, RESULTS)
    ends = [at + 1 for at, byte in enumerate(whole) if byte == 10]
    for cut in range(len(whole) + 1):
        path.write_bytes(whole[:cut])
        with Journal(path, question) as journal:
            assert len(journal) == max(sum(end <= cut for end in ends) - 1, 0), "only what is torn is lost"
            for number, result in enumerate(RESULTS):
                text = journal.recall(number, f"{number:08x}")
                if text is None:
                    journal.keep(number, f"{number:08x}", json.dumps(result))
        with Journal(path, question) as journal:
            assert [journal.recall(n, f"{n:08x}") for n in range(len(RESULTS))] == [json.dumps(r) for r in RESULTS]
        assert sorted(path.read_bytes().splitlines()) == sorted(whole.splitlines())


def test_a_journal_with_a_wrong_byte_gives_no_wrong_result(no_disk: None, tmp_path: Path) -> None:
    path = tmp_path / "journal"
    whole = kept(path, {"ratio": "235/19"}, RESULTS)
    for at in range(len(whole)):
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
        try:
            with Journal(path, {"ratio": "235/19"}) as journal:
                for number, result in enumerate(RESULTS):
                    assert journal.recall(number, f"{number:08x}") in (None, json.dumps(result))
        except QuestionError:
            assert at <= whole.index(b"\n"), "the first line is no journal's, or of another question"


def test_floats_come_back_to_the_last_bit(tmp_path: Path) -> None:
    numbers = [0.1, math.pi, 5e-324, 1.7976931348623157e308, -0.0, math.inf]
    with Journal(tmp_path / "journal", {}) as journal:
        list(run(float, numbers, None, journal))
    with Journal(tmp_path / "journal", {}) as journal:
        back = list(run(float, numbers, None, journal))
    assert [number.hex() for number in back] == [number.hex() for number in numbers]


def test_a_journal_is_a_text_that_a_reader_can_read(tmp_path: Path) -> None:
    kept(tmp_path / "journal", {"ratio": "235/19", "Räder": [15, 120]}, [[7]])
    assert (tmp_path / "journal").read_text(encoding="utf-8").splitlines() == [
        '{"geartrain journal":1,"question":{"ratio": "235/19", "Räder": [15, 120]}}',
        '{"crc":"caae0c25","task":0,"mark":"00000000","result":[7]}',
    ]


@pytest.mark.parametrize(
    ("theirs", "ours", "said"),
    [
        ({"a": 1, "w": [15, 16]}, {"a": 1, "w": [15, 17]}, "w[1] is 16 in the journal and 17 in this run"),
        ({"a": {"b": "x"}}, {"a": {"b": "y"}}, 'a.b is "x" in the journal and "y" in this run'),
        ({"a": 1}, {"a": 1, "c": 2}, "c is only in this run"),
        ({"a": 1, "c": 2}, {"a": 1}, "c is only in the journal"),
        ({"w": [1, 2]}, {"w": [1, 2, 3]}, "w has 2 entries in the journal and 3 in this run"),
        ({"a": 1}, {"a": True}, "a is 1 in the journal and true in this run"),
        ({"a": None}, {"a": {}}, "a is null in the journal and {} in this run"),
    ],
)
def test_another_question_is_refused_with_the_first_difference(
    theirs: dict[str, Any], ours: dict[str, Any], said: str, tmp_path: Path
) -> None:
    path = tmp_path / "journal"
    before = kept(path, theirs, [1, 2])
    with pytest.raises(QuestionError, match="the journal belongs to another run") as caught:
        Journal(path, ours)
    assert caught.value.problems[0].why == said
    assert caught.value.problems[0].place == str(path)
    assert path.read_bytes() == before
    with Journal(path, ours, resume=False) as journal:
        assert len(journal) == 0, "to begin again is allowed"


def test_the_order_of_keys_makes_no_other_question(tmp_path: Path) -> None:
    kept(tmp_path / "journal", {"a": (1, 2), "b": 3}, [1])
    with Journal(tmp_path / "journal", {"b": 3, "a": [1, 2]}) as journal:
        assert len(journal) == 1


@pytest.mark.parametrize("content", ["name: a train\nlinks: {}\n", "{}", "\n", '{"geartrain": 1}\n', "\0" * 100])
@pytest.mark.parametrize("resume", [True, False])
def test_a_file_that_is_no_journal_is_left_as_it_is(content: str, resume: bool, tmp_path: Path) -> None:
    path = tmp_path / "train.yaml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(QuestionError, match="the file is not a journal"):
        Journal(path, {}, resume=resume)
    assert path.read_text(encoding="utf-8") == content


def test_work_cut_into_other_pieces_is_refused(tmp_path: Path) -> None:
    with Journal(tmp_path / "journal", {}) as journal:
        list(run(str, [[1, 2], [3, Fraction(1, 3)]], None, journal))
    with Journal(tmp_path / "journal", {}) as journal:
        assert list(run(str, [(1, 2), (3, Fraction(1, 3))], None, journal)) == ["[1, 2]", "[3, Fraction(1, 3)]"]
        with pytest.raises(QuestionError, match="task 1 of the journal differs from the task of this run"):
            list(run(str, [[1, 2], [3, Fraction(2, 3)]], None, journal))


def test_two_runs_do_not_share_a_journal(tmp_path: Path) -> None:
    with Journal(tmp_path / "journal", {}), pytest.raises(QuestionError, match="another run is writing"):
        Journal(tmp_path / "journal", {})
    Journal(tmp_path / "journal", {}).close()
    assert list(tmp_path.iterdir()) == [tmp_path / "journal"], "the lock goes with the run"


def test_a_journal_goes_when_the_run_is_whole_and_only_then(tmp_path: Path) -> None:
    with Journal(tmp_path / "journal", {}) as journal:
        list(run(abs, [-1], None, journal))
    assert (tmp_path / "journal").exists()
    with Journal(tmp_path / "journal", {}) as journal:
        journal.finish()
        assert journal.closed
    assert not (tmp_path / "journal").exists()


def test_a_journal_that_cannot_be_written_is_said_and_keeps_what_it_has(tmp_path: Path) -> None:
    with pytest.raises(GearTrainError, match="the journal cannot be read or written"):
        Journal(tmp_path / "nowhere" / "journal", {})
    with pytest.raises(GearTrainError, match="it is not a regular file"):
        Journal(tmp_path, {})
    with Journal(tmp_path / "journal", {}) as journal, a_full_disk(250):
        with pytest.raises(GearTrainError, match="the journal cannot be read or written"):
            list(run(abs, range(9), None, journal))
        assert (tmp_path / "journal").stat().st_size == 250, "the last line is torn"
    with Journal(tmp_path / "journal", {}) as journal:
        assert 0 < len(journal) < 9
        assert list(run(abs, range(9), None, journal)) == list(range(9))


@contextmanager
def a_full_disk(size: int) -> Iterator[None]:
    """No file may grow beyond so many bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


SCRIPT = """
import json, sys
sys.path.insert(0, {tests!r})
from clusters import gated
from geartrain.numerics import Journal, open_executor, run
with Journal({folder!r} + "/journal", {{"requested": 1}}) as journal, open_executor({workers}) as executor:
    print(json.dumps(list(run(gated, [({folder!r}, n, 6) for n in range(20)], executor, journal))))
"""


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("cut", [signal.SIGINT, signal.SIGKILL])
def test_a_run_cut_by_a_signal_leaves_a_journal_and_nobody_behind(
    workers: int, cut: signal.Signals, tmp_path: Path
) -> None:
    code = SCRIPT.format(tests=str(TESTS), folder=str(tmp_path), workers=workers)
    start = subprocess.Popen(
        [sys.executable, "-W", "error", "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    with start:
        until(lambda: any(n >= 6 for n, _ in begun(tmp_path)) and lines(tmp_path) >= 7, "tasks at the gate")
        # Ctrl-C reaches all processes of a terminal; a kill meets one
        os.killpg(start.pid, cut) if cut is signal.SIGINT else os.kill(start.pid, cut)
        out, err = start.communicate(timeout=PATIENCE)
    assert (start.returncode, out) == (-cut, "")
    assert err.count("Traceback") == (cut is signal.SIGINT), f"only the run itself says a word: {err}"
    until(lambda: not any(alive(pid) for _, pid in begun(tmp_path)), "the workers to leave")
    (tmp_path / "gate").touch()
    with Journal(tmp_path / "journal", {"requested": 1}) as journal:
        assert list(run(gated, [(str(tmp_path), n, 6) for n in range(20)], None, journal)) == [n**2 for n in range(20)]
    assert [sum(n == each for n, _ in begun(tmp_path)) for each in range(6)] == [1] * 6


def lines(folder: Path) -> int:
    """Lines of the journal."""
    return (folder / "journal").read_bytes().count(b"\n") if (folder / "journal").exists() else 0


def test_an_iterator_that_is_left_keeps_what_was_finished_meanwhile(processes: Executor, tmp_path: Path) -> None:
    with Journal(tmp_path / "journal", {}) as journal:
        with closing(run(gated, [(str(tmp_path), n, 99) for n in range(9)], processes, journal)) as results:
            next(results)
            until(lambda: len(begun(tmp_path)) >= 8, "the tasks in flight")
            until(lambda: processes.submit(abs, 1).result(timeout=PATIENCE), "all before this one")
        assert len(journal) >= 7


def test_one_worker_is_this_process_and_brings_no_pool() -> None:
    code = """
import sys
from geartrain.numerics import open_executor, run
with open_executor(1) as executor:
    assert executor is None
    assert list(run(abs, [-1, 2], executor)) == [1, 2]
print(*sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"multiprocessing", "distributed"} & {name.partition(".")[0] for name in done.stdout.split()}


def by_default(tasks: list[float]) -> tuple[list[Any], list[tuple[int, int]], set[int]]:
    """Results, announcements and processes of a run on three cores whose tasks take so many seconds."""
    announced: list[tuple[int, int]] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geartrain.numerics.work.task_runner.cores", lambda: 3)
        with open_executor(announce=lambda *numbers: announced.append(numbers)) as executor:
            found = list(run(slow, tasks, executor))
    return [seconds for seconds, _ in found], announced, {process for _, process in found}


def test_work_of_less_than_a_second_stays_in_this_process() -> None:
    tasks = [0.001] * 200
    assert by_default(tasks) == (tasks, [], {os.getpid()})


def test_a_long_run_is_announced_once_and_shared_by_processes() -> None:
    tasks = [0.15] * 60
    results, announced, processes = by_default(tasks)
    assert results == tasks
    (shared,) = announced
    assert shared[1] == 3
    assert 40 <= shared[0] < 60, "the first second of work is done here"
    assert len(processes - {os.getpid()}) == 3


def test_a_few_long_tasks_are_shared_by_as_many_processes() -> None:
    """Of three tasks the first is done here, and shows that the others take long."""
    results, announced, processes = by_default([1.1, 1.0, 0.9])
    assert results == [1.1, 1.0, 0.9]
    assert announced == [(2, 2)]
    assert len(processes) == 3


def test_a_process_that_may_not_start_others_works_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.numerics.work.task_runner.cores", lambda: 3)
    monkeypatch.setitem(multiprocessing.current_process()._config, "daemon", True)
    with open_executor() as executor:
        assert executor is None


def test_work_that_cannot_be_sent_to_a_process_is_done_here(processes: Executor) -> None:
    assert list(run(lambda number: [number, os.getpid()], range(3), processes)) == [[n, os.getpid()] for n in range(3)]


def test_the_work_that_is_requested_of_some_workers_is_theirs_from_the_first_task() -> None:
    announced: list[tuple[int, int]] = []
    with open_executor(2, announce=lambda *numbers: announced.append(numbers)) as executor:
        found = list(run(slow, [0.0] * 3, executor))
        found += run(slow, [0.0] * 3, executor)
    assert os.getpid() not in {process for _, process in found}
    assert announced == [(3, 2)]


def test_workers_are_as_many_as_the_cores_this_process_may_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "geartrain.numerics.work.task_runner.cores", cores
    )  # tests have one core unless they ask for more
    assert 1 <= cores() <= (os.cpu_count() or 1)
    for count in (1, 3):
        if hasattr(os, "process_cpu_count"):
            monkeypatch.setattr(os, "process_cpu_count", lambda count=count: count)
        monkeypatch.setattr(os, "sched_getaffinity", lambda _, count=count: set(range(count)), raising=False)
        with open_executor() as executor:
            assert (1 if executor is None else executor.width) == count


@pytest.mark.parametrize(
    ("requested", "said"),
    [
        ({"workers": 0}, "the number of workers is 0"),
        ({"workers": 2, "dask": "tcp://x:1"}, "both workers and a dask scheduler"),
    ],
)
def test_what_cannot_be_requested_is_refused(requested: dict[str, Any], said: str) -> None:
    with pytest.raises(QuestionError, match=said), open_executor(**requested):
        pass


def test_a_cluster_without_the_extra_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "geartrain.numerics.work.cluster", raising=False)
    with pytest.raises(MissingExtraError, match="distributed is not installed") as caught, open_executor(dask="x"):
        pass
    assert caught.value.problems[0].fix == "pip install 'distributed>=2024.8' # 37 MB"


def test_nobody_at_an_address_is_said_without_a_word_of_noise() -> None:
    pytest.importorskip("distributed")
    code = """
from geartrain.errors import GearTrainError
from geartrain.numerics.work.cluster import DaskPool
for address in ("tcp://127.0.0.1:1", "nonsense://x", "tcp://", ""):
    try:
        DaskPool(address, answer=0.5)
    except GearTrainError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=PATIENCE)
    assert done.stderr == ""
    assert done.stdout.count("no dask scheduler responds") == done.stdout.count("  why: ") == done.stdout.count("fix: ")
    assert done.stdout.count("no dask scheduler responds") == 4


def test_a_cluster_of_another_version_is_refused(cluster: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    here = os.getpid()
    monkeypatch.setattr("geartrain.numerics.work.cluster.version", lambda _: "9.9" if os.getpid() == here else "9.8")
    with pytest.raises(GearTrainError, match=r"runs another version of geartrain than 9\.9") as caught:
        open_executor(dask=cluster.scheduler_address).__enter__()
    assert caught.value.problems[0].why == "its workers run 9.8"
    assert "9.9" in caught.value.problems[0].fix


def test_a_cluster_without_workers_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr("geartrain.numerics.work.cluster.DaskPool.__init__.__defaults__", (0.3,))
    local = distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=":0", silence_logs=60)
    with local, pytest.raises(GearTrainError, match="has no workers"):
        open_executor(dask=local.scheduler_address).__enter__()


def test_a_cluster_that_is_lost_in_the_middle_is_told_and_what_it_did_is_kept(cluster: Any, tmp_path: Path) -> None:
    tasks = [(str(tmp_path), n, 2) for n in range(9)]
    with open_executor(dask=cluster.scheduler_address) as found:
        crew: Any = found
        with Journal(tmp_path / "journal", {}) as journal, closing(run(gated, tasks, crew, journal)) as results:
            assert [next(results), next(results)] == [0, 1]
            crew._client.loop.add_callback(crew._client.scheduler_comm.comm.abort)
            with pytest.raises(GearTrainError, match="the work was interrupted"):
                next(results)
        until(lambda: crew._client.status == "running", "the client to find the scheduler: it leaves nothing open")
    (tmp_path / "gate").touch()
    with Journal(tmp_path / "journal", {}) as journal:
        assert len(journal) == 2
        assert list(run(gated, tasks, None, journal)) == [n**2 for n in range(9)]
