"""The pieces of a search: what a worker does with one, and what all of them come to together."""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from geartrain.synthesis.trains.assignments import Assignment
from geartrain.synthesis.trains.joining import Columns, Join, SpentError
from geartrain.synthesis.trains.plans import Question
from geartrain.synthesis.trains.pooling import Order, Pool


@dataclass(frozen=True, slots=True)
class Work:
    """What all tasks of one pass share.

    question  to be answered
    order     of what is listed
    most      assignments that one task may bring out to list the best of them
    """

    question: Question
    order: Order
    most: int

    def packed(self) -> bytes:
        """As a worker takes it."""
        return pickle.dumps(self)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Work, Join]:
    work = pickle.loads(packed)
    assert isinstance(work, Work)
    return work, Join(work.question)


def do_task(packed: bytes, task: Mapping[str, Any]) -> dict[str, Any]:
    """One piece of a search: a part of the values of some items.

    task   `parts`: [[item, number, of], ...], the part with this number of so many; `budget`: steps it may take;
           `pieces`: into how many it is cut, so that not all is lost when the budget ends
    Returns `count`, `removed` (one number for each constraint), `listed` (whether `best` holds the best), `best`
    (counts in the order of the wheels), `steps`, and `cut` (whether the budget ended it).
    """
    work, join = _unpacked(packed)
    total: dict[str, Any] = {"count": 0, "removed": [0] * len(work.question.reasons), "listed": True, "cut": False}
    pool, spent = Pool(work.order, work.question.wheels), 0
    for slices in _slices(join, task["parts"], task["pieces"]):
        join.cut(slices, task["budget"] - spent)
        try:
            found = _do_piece(work, join, pool, total["count"])
        except SpentError:
            total["cut"] = True
            break
        finally:
            spent += join.steps
        total["count"] += found["count"]
        total["removed"] = [a + b for a, b in zip(total["removed"], found["removed"], strict=True)]
        total["listed"] &= found["listed"]
    return total | {"best": pool.best() if total["listed"] else [], "steps": spent}


def _slices(join: Join, parts: Sequence[Sequence[int]], pieces: int) -> Iterator[dict[int, tuple[int, int]]]:
    """The runs of values that some parts are, the first of them cut into pieces."""
    runs = {item: (len(join.items[item]) * at // of, len(join.items[item]) * (at + 1) // of) for item, at, of in parts}
    item = parts[0][0]
    first, last = runs[item]
    step = max(1, -(-(last - first) // pieces))
    if all(start < end for start, end in runs.values()):
        for start in range(first, last, step):
            yield runs | {item: (start, min(start + step, last))}


def _do_piece(work: Work, join: Join, pool: Pool, before: int) -> dict[str, Any]:
    """Count; then bring out what is to be listed, or what late rules must see."""
    question = work.question
    counts, gone = join.count(question.plan, join.start())
    count = int(counts[0])
    removed = [int(gone[at][0]) if at in gone else 0 for at in range(len(question.reasons))]
    listed = before + count <= work.most
    if question.late or listed:
        count = 0
        for rows in join.stream((question.plan,), join.start()):
            for columns in join.wheels(rows):
                columns = _late(question, columns, removed)
                count += len(next(iter(columns.values())))
                pool.add(columns)
        listed = True
    return {"count": count, "removed": removed, "listed": listed}


def _late(question: Question, columns: Columns, removed: list[int]) -> Columns:
    """The assignments that the late rules let pass."""
    number = len(question.reasons) - len(question.late)
    for at, rule in enumerate(question.late, number):
        met = rule.holds(columns)
        removed[at] += int((~met).sum())
        columns = {wheel: column[met] for wheel, column in columns.items()}
    return columns


@dataclass(frozen=True, slots=True)
class Tally:
    """What the tasks of a pass came to.

    count     assignments that meet everything
    removed   for each constraint, how many it refused
    best      the best, best first
    listed    False if there were too many to bring out: `best` is then empty
    cut       True if a task spent its budget
    stopped   True if the run was interrupted: the rest is of the tasks that were done
    """

    count: int
    removed: tuple[int, ...]
    best: tuple[Assignment, ...]
    listed: bool
    cut: bool
    stopped: bool


def merged(work: Work, results: Iterable[Mapping[str, Any]]) -> Tally:
    """Add up the results of tasks; an interrupt ends the sum, not the search."""
    count, listed, cut, stopped = 0, True, False, False
    removed = [0] * len(work.question.reasons)
    pool = Pool(work.order, work.question.wheels)
    try:
        for result in results:
            count += result["count"]
            removed = [a + b for a, b in zip(removed, result["removed"], strict=True)]
            listed, cut = listed and result["listed"], cut or result["cut"]
            if result["best"]:
                pool.add(dict(zip(pool.wheels, np.array(result["best"], dtype=np.int64).T, strict=True)))
    except KeyboardInterrupt:
        stopped = True
    found = (dict(zip(pool.wheels, counts, strict=True)) for counts in (pool.best() if listed else ()))
    best = tuple(one for teeth in found if (one := work.order.assignment(teeth)) is not None)
    return Tally(count, tuple(removed), best, listed, cut, stopped)
