"""Every shipped train without each arbor, and without each two: what explains the rest, and the train's rank in it.

A question is asked in a process of its own that has so much time and memory; finished ones are kept in a journal, so
that a run that is stopped is taken up where it was. Two arbors are asked to the end where each alone was. Of each
question it is also asked whether the search comes to the train, and how the train ranks where meshes were seen; and of
those that were not finished, whether anything weighs more.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, replace
from fractions import Fraction
from functools import partial
from itertools import combinations
from time import monotonic, process_time
from typing import Any

from geartrain import shipped
from geartrain.errors import GearTrainError
from geartrain.search.reconstruct import ReconstructionProblem, evidence_question, find_reconstructions
from geartrain.search.reconstruct.known_rank import find_place
from geartrain.search.reconstruct.reconstruction_search import is_all_listed, rank_of, train_key, train_prior
from geartrain.search.reconstruct.spur_tree import (
    SpurTree,
    find_spur_trees,
    lost_arbors,
    lost_evidence,
    lost_wheels,
)
from geartrain.train.declaration_files import read_declaration
from studies.followed_train import is_reached
from studies.left_out_records import LeftOutRecord, LeftOutRecords, TreeRecord
from studies.measurement import gathered

LIMIT = 60.0
"""Processor seconds for a question."""
SHORT = 5.0
"""Processor seconds for the rank where meshes are told, and for what weighs more."""
LISTED = 20_000
"""Explanations among which a train is looked for."""
TITLE = "Recovery of known trains"
_LESS = ("reached", "told", "better")
"""What is asked beside a question itself; the last only where that was not finished."""
_MEMORY = 4.0  # GB for a question
Part = tuple[str, str]
"""A train, and the name of one of its parts."""
Question = tuple[str, str, tuple[str, ...]]
"""A train, its part, and the arbors that are left out."""
Rows = dict[Question, LeftOutRecord]


def left_out(
    kept: LeftOutRecords,
    names: Sequence[str] = (),
    limit: float = LIMIT,
    short: float = SHORT,
    minutes: float = 600,
) -> LeftOutRecords:
    """Ask what a kept run lacks, by default of all shipped trains: questions, and parts of unfinished ones.

    limit    processor seconds for a question
    short    processor seconds for what is asked of a question that was not finished
    minutes  after which nothing more is asked; the next call continues
    """
    trees, _ = find_trees(tuple(shipped()))
    known = {(row.train, row.part, tuple(row.lost)): row for row in kept.rows}
    end = monotonic() + 60 * minutes
    waiting = [each for each in _questions(trees) if not names or each[0][0] in names]
    # questions with few lost wheels and exact dials first: their lists are short
    quick = {part: _is_exact(tree) for part, tree in trees.items()}
    waiting.sort(key=lambda each: (not quick[each[0]], lost_wheels(trees[each[0]], each[1]), len(each[1])))
    steps: list[Callable[[Rows, SpurTree, Question, float, float], None]]
    steps = [_add_new, _add_known, *(partial(_add_less, what) for what in _LESS)]
    for step in steps:
        for part, lost in waiting:
            if monotonic() > end:
                break
            step(known, trees[part], (*part, lost), limit, short)
    order = {(*part, lost): at for at, (part, lost) in enumerate(_questions(trees))}
    rows = sorted((key for key in known if key in order), key=order.__getitem__)
    return LeftOutRecords(
        TITLE, [_tree_record(*part, tree) for part, tree in trees.items()], [known[key] for key in rows]
    )


def _add_new(known: Rows, tree: SpurTree, key: Question, limit: float, short: float) -> None:
    """Ask to the end what is not known."""
    if key not in known:
        name, part, lost = key
        able = _finished(known.values())
        full = limit if len(lost) == 1 or all((name, part, link) in able for link in lost) else 0.0
        known[key] = LeftOutRecord(**_requested_to_the_end(tree, key, full))


def _add_known(known: Rows, tree: SpurTree, key: Question, limit: float, short: float) -> None:
    """Tell of what was not finished that nothing weighs more, where that needs no search."""
    row = known.get(key)
    if row is None or row.is_whole or row.better is not None or len(row.solutions) < row.added or any(row.solutions):
        return
    lost = key[2]
    if fewest_new_arbors(evidence_question(lost_evidence(tree, lost)).problem) >= tree.arbor(lost).added_arbors:
        known[key] = replace(row, better=0)


def _add_less(what: str, known: Rows, tree: SpurTree, key: Question, limit: float, short: float) -> None:
    """Ask less of what was not finished."""
    row = known.get(key)
    if row is not None and getattr(row, what) is None and not (what == "better" and row.is_whole):
        known[key] = LeftOutRecord(**asdict(row) | _less(what, tree, row, short))


def _questions(trees: dict[Part, SpurTree]) -> Iterator[tuple[Part, tuple[str, ...]]]:
    for many in (1, 2):
        yield from ((part, lost) for part, tree in trees.items() for lost in combinations(tree.able, many))


def _finished(rows: Iterable[LeftOutRecord]) -> set[tuple[str, str, str]]:
    return {(row.train, row.part, row.lost[0]) for row in rows if row.is_whole and len(row.lost) == 1}


def find_trees(names: Sequence[str]) -> tuple[dict[Part, SpurTree], dict[str, str]]:
    """The parts of trains, and the trains that have none of their own. Of the same parts the first counts."""
    trees: dict[Part, SpurTree] = {}
    not_requested: dict[str, str] = {}
    known: dict[Any, str] = {}
    for name in sorted(names, key=lambda name: (len(name), name)):  # a variant has a longer name than what it varies
        try:
            parts = find_spur_trees(read_declaration(name))
        except GearTrainError as error:
            refused = error.problems[0]
            not_requested[name] = ": ".join(filter(None, (refused.what, refused.why)))
            continue
        same = set()
        for tree in parts:
            problem = evidence_question(lost_evidence(tree, [tree.able[0]])).problem
            key = train_key(tree.arbor()), problem.dials, problem.input_speed, problem.rings
            own = known.setdefault(key, name)
            if own == name:
                trees[name, tree.name] = tree
            else:
                same.add(own)
        if same and not any((name, tree.name) in trees for tree in parts):
            not_requested[name] = f"the same parts as {' and '.join(sorted(same))}"
    return dict(sorted(trees.items())), not_requested


def _requested_to_the_end(tree: SpurTree, question: Question, limit: float) -> dict[str, Any]:
    """All explanations, as far as they come in time; with no time none is looked for."""
    name, part, lost = question
    found: list[Any] = []
    note = "not asked to the end"
    if limit:
        found, note = gathered(partial(_answers, tree, lost), limit, _MEMORY)
    last: dict[str, Any] = (
        found[-1] if found else {"solutions": [], "classes": [], "rank": None, "listed": False, "seconds": None}
    )
    print(f"{name} {part} without {', '.join(lost)}: {last['solutions']} {note}", file=sys.stderr, flush=True)
    return {"train": name, "part": part, "lost": list(lost), "added": lost_wheels(tree, lost), "note": note, **last}


def _answers(tree: SpurTree, lost: tuple[str, ...]) -> Iterator[dict[str, Any]]:
    """The answer with 0, 1, ... added wheels, so that there is one where the time ends before the last."""
    evidence, original = lost_evidence(tree, lost), tree.arbor(lost)
    own = lost_wheels(tree, lost)
    for wheels in range(own + 1):
        start = process_time()
        found = find_reconstructions(evidence_question(evidence, wheels).problem, listed=LISTED)
        seconds = process_time() - start
        yield {
            "solutions": [count.solutions for count in found.counts],
            "classes": [count.classes for count in found.counts],
            "rank": rank_of(original, found) if wheels == own else None,
            "listed": is_all_listed(found),
            "seconds": seconds if wheels == own and found.complete else None,
        }


# what else is asked


def _less(what: str, tree: SpurTree, row: LeftOutRecord, short: float) -> dict[str, Any]:
    """One more thing that is asked of a question, as far as that comes in time."""
    lost = tuple(row.lost)
    told: dict[str, Any]
    if what == "better":
        steps, _ = gathered(partial(_better, tree, lost, row), short, _MEMORY)
        solutions = max([list(row.solutions), *(step for step, _ in steps)], key=len)
        classes = [*row.classes, *[None] * (len(solutions) - len(row.classes))]
        told = {"better": steps[-1][1] if steps else None, "solutions": solutions, "classes": classes}
    else:
        found, _ = gathered(lambda: iter([_requested_at_once(what, tree, lost)]), short, _MEMORY)
        told = {what: found[0] if found else None}
    print(f"{row.train} {row.part} without {', '.join(lost)}: {told}", file=sys.stderr, flush=True)
    return told


def _requested_at_once(what: str, tree: SpurTree, lost: tuple[str, ...]) -> Any:
    return _is_reached(tree, lost) if what == "reached" else _rank_with_meshes(tree, lost)


def _is_reached(tree: SpurTree, lost: tuple[str, ...]) -> bool:
    return is_reached(tree.arbor(lost_arbors(tree, lost)), evidence_question(lost_evidence(tree, lost)).problem)


def _rank_with_meshes(tree: SpurTree, lost: tuple[str, ...]) -> tuple[int, int]:
    """First and last rank of the train where the meshes of what survives are told."""
    problem = evidence_question(lost_evidence(tree, lost, seen=True)).problem
    place = find_place(tree.arbor(lost_arbors(tree, lost)), problem, find_reconstructions(problem, listed=0))
    assert place is not None  # it is reached
    return place.ranks


def _better(tree: SpurTree, lost: tuple[str, ...], row: LeftOutRecord) -> Iterator[tuple[list[int], int | None]]:
    """Numbers of explanations with 0, 1, ... wheels fewer than are lost, and at last how many weigh more in all.

    With as many wheels as are lost those weigh more that have fewer added arbors.
    """
    evidence, original = lost_evidence(tree, lost), tree.arbor(lost)
    whole = evidence_question(evidence).problem
    own, weight = whole.additions.wheels, train_prior(original, whole)
    solutions, weights = list(row.solutions[:own]), Counter[Fraction]()
    if any(solutions):
        solutions = []
    for wheels in range(len(solutions), own):
        found = find_reconstructions(evidence_question(evidence, wheels).problem)
        solutions = [count.solutions for count in found.counts]
        weights = Counter({each.weight: each.solutions for each in found.weights})
        yield solutions, None
    better = sum(number for each, number in weights.items() if each > weight)
    fewer = original.added_arbors - 1
    if fewest_new_arbors(whole) <= fewer:
        found = find_reconstructions(replace(whole, additions=replace(whole.additions, arbors=fewer)))
        better += sum(count.solutions for count in found.counts if count.added == own)
    yield solutions, better


def fewest_new_arbors(problem: ReconstructionProblem) -> int:
    """How many arbors must be added at least, for pointers of different speeds that have none."""
    bounds = [sorted((abs(dial.minimum), abs(dial.maximum))) for dial in problem.dials if dial.place == "new"]
    number, last = 0, Fraction(-1)
    for minimum, maximum in sorted(bounds, key=lambda each: each[1]):
        if minimum > last:
            number, last = number + 1, maximum
    return number


def _tree_record(name: str, part: str, tree: SpurTree) -> TreeRecord:
    counted = tree.source, list(tree.able), len(tree.counts), list(tree.pointers), list(tree.teeth)
    return TreeRecord(name, part, *counted)


def _is_exact(tree: SpurTree) -> bool:
    """Whether no pointer has a tolerance."""
    return all(dial.is_exact for dial in evidence_question(lost_evidence(tree, tree.able[:1])).problem.dials)


def continued() -> LeftOutRecords:
    """Continue the kept run: what it lacks, for ten hours at most."""
    return left_out(LeftOutRecords.read("left-out"))
