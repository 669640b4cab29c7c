"""Every shipped train without each arbor, and without each two: what explains the rest, and the train's rank in it.

A question is asked in a process of its own that has so much time and memory; finished ones are kept in a journal, so
that a run that is stopped is taken up where it was. Two arbors are left out where each alone was finished.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import combinations
from pathlib import Path
from time import process_time
from typing import Any

from geartrain.errors import GearTrainError
from geartrain.numerics import Journal, open_executor, run
from geartrain.synthesis.reconstruction.evidence_question import evidence_question
from geartrain.synthesis.reconstruction.lost_arbors import is_all_listed, lost_evidence, rank_of
from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions
from geartrain.synthesis.reconstruction.sameness import mechanism
from geartrain.synthesis.reconstruction.spur_tree import SpurTree, find_spur_tree
from geartrain.train.declaration_files import read_declaration, shipped
from studies.left_out_records import LeftOutRecord, LeftOutRecords, NotAskedRecord, TreeRecord
from studies.measurement import gathered

LIMIT = 60.0
"""Processor seconds for a question."""
LISTED = 20_000
"""Explanations among which a train is looked for."""
TITLE = "Trains found again"
QUICK = ("vitruvius-hodometer", "watch-going-train", "isfahan-astrolabe-1221", "four-gear-loop")
_MEMORY = 4.0  # GB for a question
Task = tuple[str, tuple[str, ...], float]
"""A train, the arbors that are left out, and the seconds that there are."""


def left_out(
    names: Sequence[str] = (), limit: float = LIMIT, workers: int | None = 1, journal: Path | None = None
) -> LeftOutRecords:
    """Ask of some shipped trains, by default of all.

    limit    processor seconds for a question
    journal  what is finished is kept in two files beside it, for one and for two arbors, which `forget` removes
    """
    trees, not_asked = find_trees(names or tuple(shipped()))
    one = [(name, (link,), limit) for name, tree in trees.items() for link in tree.driven]
    singles = _asked(one, workers, _part(journal, 1))
    short = {(row.train, row.lost[0]) for row in singles if not row.is_whole}
    pairs = [(name, lost, limit) for name, tree in trees.items() for lost in combinations(tree.driven, 2)]
    able = [(name, lost, seconds) for name, lost, seconds in pairs if not any((name, link) in short for link in lost)]
    rows = [*singles, *_asked(able, workers, _part(journal, 2))]
    return LeftOutRecords(TITLE, [_tree_record(tree) for tree in trees.values()], rows, not_asked)


def tree_records(names: Sequence[str]) -> LeftOutRecords:
    """What would be asked of some trains, before it is."""
    trees, not_asked = find_trees(names)
    return LeftOutRecords(TITLE, [_tree_record(tree) for tree in trees.values()], [], not_asked)


def find_trees(names: Sequence[str]) -> tuple[dict[str, SpurTree], list[NotAskedRecord]]:
    """The trees of trains by name, and the trains that have none of their own. Of the same trees the first counts."""
    trees: dict[str, SpurTree] = {}
    not_asked: list[NotAskedRecord] = []
    known: dict[Any, str] = {}
    for name in sorted(names, key=lambda name: (len(name), name)):  # a variant has a longer name than what it varies
        try:
            tree = find_spur_tree(read_declaration(name))
        except GearTrainError as error:
            problem = error.problems[0]
            not_asked.append(NotAskedRecord(name, ": ".join(filter(None, (problem.what, problem.why)))))
            continue
        dials = evidence_question(lost_evidence(tree, [next(iter(tree.driven))])).problem.dials
        own = known.setdefault((mechanism(tree.arbor()), dials), name)
        if own == name:
            trees[name] = tree
        else:
            not_asked.append(NotAskedRecord(name, f"the same tree as {own}"))
    return dict(sorted(trees.items())), sorted(not_asked, key=lambda row: row.train)


def ask(task: Sequence[Any]) -> dict[str, Any]:
    """What explains a train without some arbors, as plain data of its record."""
    name, lost, limit = task
    tree = find_spur_tree(read_declaration(name))
    found, note = gathered(partial(_answers, tree, tuple(lost)), limit, _MEMORY)
    own = _wheels(tree, lost)
    last: dict[str, Any] = (
        found[-1] if found else {"mechanisms": [], "classes": [], "rank": None, "listed": False, "seconds": None}
    )
    print(f"{name} without {', '.join(lost)}: {last['mechanisms']} {note}", file=sys.stderr, flush=True)
    return {"train": name, "lost": list(lost), "added": own, "note": note, **last}


def _answers(tree: SpurTree, lost: tuple[str, ...]) -> Iterator[dict[str, Any]]:
    """The answer with 0, 1, ... added wheels, so that there is one where the time ends before the last."""
    evidence, original = lost_evidence(tree, lost), tree.arbor(lost)
    own = _wheels(tree, lost)
    for wheels in range(own + 1):
        start = process_time()
        found = find_reconstructions(evidence_question(evidence, wheels).problem, listed=LISTED)
        seconds = process_time() - start
        yield {
            "mechanisms": [count.mechanisms for count in found.counts],
            "classes": [count.classes for count in found.counts],
            "rank": rank_of(original, found) if wheels == own else None,
            "listed": is_all_listed(found),
            "seconds": seconds if wheels == own and found.complete else None,
        }


def _asked(tasks: Sequence[Task], workers: int | None, journal: Path | None) -> list[LeftOutRecord]:
    with open_executor(workers) as executor:
        if journal is None:
            return [LeftOutRecord(**row) for row in run(ask, tasks, executor)]
        with Journal(journal, {"tasks": tasks}) as kept:
            return [LeftOutRecord(**row) for row in run(ask, tasks, executor, kept)]


def _part(journal: Path | None, many: int) -> Path | None:
    return None if journal is None else journal.with_name(f"{journal.name}-{many}")


def forget(journal: Path) -> None:
    """Remove what a finished run kept."""
    for many in (1, 2):
        journal.with_name(f"{journal.name}-{many}").unlink(missing_ok=True)


def _wheels(tree: SpurTree, lost: Iterable[str]) -> int:
    return sum(len(tree.wheels_of(link)) for link in lost)


def _tree_record(tree: SpurTree) -> TreeRecord:
    counts = tree.counts.values()
    teeth = [min(counts), max(counts)]
    parts = list(tree.driven), len(counts), list(tree.pointers), list(tree.beside)
    return TreeRecord(tree.train.name, tree.source, *parts, teeth)
