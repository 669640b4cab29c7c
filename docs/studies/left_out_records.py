"""What was found of trains of which arbors were left out, and its tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import comb

from studies.records import StudyRecords, number_text, seconds_text, table


@dataclass(frozen=True, slots=True)
class TreeRecord:
    """A train, or that part of it, of which arbors are left out.

    source    the arbor of the input
    arbors    those that it drives, each of which is left out in turn
    wheels    of all of them that mesh
    pointers  outputs whose speeds are known
    beside    arbors of the train that are no part of the tree
    teeth     least and greatest count
    """

    train: str
    source: str
    arbors: Sequence[str]
    wheels: int
    pointers: Sequence[str]
    beside: Sequence[str]
    teeth: Sequence[int]

    @property
    def questions(self) -> int:
        """How many arbors, and pairs of arbors, there are to be left out."""
        return comb(len(self.arbors) + 1, 2)


@dataclass(frozen=True, slots=True)
class NotAskedRecord:
    """A train of which nothing is asked, and why."""

    train: str
    why: str


@dataclass(frozen=True, slots=True)
class LeftOutRecord:
    """What explains a train without some of its arbors.

    lost         arbors that are left out
    added        their wheels: so many may be added
    mechanisms   explanations with 0, 1, ... added wheels, as far as they were counted
    classes      those that differ by more than what drives what
    rank         first and last of the train itself by weight, None where that is not known
    listed       whether all explanations were listed, so that the train must be among them
    seconds      for all with up to `added` wheels; None where that was not finished
    note         why not
    """

    train: str
    lost: Sequence[str]
    added: int
    mechanisms: Sequence[int]
    classes: Sequence[int | None]
    rank: Sequence[int] | None
    listed: bool
    seconds: float | None
    note: str = ""

    @property
    def is_whole(self) -> bool:
        """Whether all explanations were counted."""
        return self.seconds is not None

    @property
    def least(self) -> int | None:
        """The fewest added wheels that explain the dials, as far as was counted."""
        return next((added for added, count in enumerate(self.mechanisms) if count), None)


@dataclass(frozen=True)
class LeftOutRecords(StudyRecords):
    """Everything that was asked on one machine."""

    trees: Sequence[TreeRecord]
    rows: Sequence[LeftOutRecord]
    not_asked: Sequence[NotAskedRecord]

    @property
    def whole(self) -> list[LeftOutRecord]:
        """Questions that were finished."""
        return [row for row in self.rows if row.is_whole]

    @property
    def possible(self) -> int:
        """All questions that there are, with one arbor or two left out."""
        return sum(tree.questions for tree in self.trees)

    @property
    def lost(self) -> list[LeftOutRecord]:
        """Finished questions whose answer lacks the train itself: there must be none."""
        return [row for row in self.whole if row.listed and row.rank is None]

    def tables(self) -> list[str]:
        """A summary, every question, and the trains that are not asked."""
        lines = ["## By train", "", *table(_SUMMARY, [_TreeRows(tree, self._of(tree)) for tree in self.trees])]
        for tree in self.trees:
            own = self._of(tree)
            lines += [f"## {tree.train}", "", _about(tree, tree.questions - len(own)), "", *table(_COLUMNS, own)]
        return [*lines, "## Not asked", "", *table(_NOT_ASKED, self.not_asked)]

    def _of(self, tree: TreeRecord) -> list[LeftOutRecord]:
        return [row for row in self.rows if row.train == tree.train]


@dataclass(frozen=True)
class _TreeRows:
    tree: TreeRecord
    rows: list[LeftOutRecord]

    @property
    def whole(self) -> list[LeftOutRecord]:
        return [row for row in self.rows if row.is_whole]


def _about(tree: TreeRecord, unasked: int) -> str:
    beside = f" Not in the tree: {', '.join(tree.beside)}." if tree.beside else ""
    left = f" Pairs not asked, for one of the two alone was not finished: {unasked}." if unasked else ""
    pointers = ", ".join(tree.pointers)
    return f"From {tree.source} on; pointers: {pointers}; {tree.teeth[0]} to {tree.teeth[1]} teeth.{beside}{left}"


def rank_text(rank: Sequence[int] | None) -> str:
    """One rank, or the first and last of those that weigh the same."""
    if rank is None:
        return "-"
    return str(rank[0]) if rank[0] == rank[1] else f"{rank[0]} to {rank[1]}"


def _found(row: LeftOutRecord) -> str:
    """How many explanations there are with the fewest added wheels."""
    if row.least is None:
        return "-" if not row.mechanisms else f"none with {len(row.mechanisms) - 1}"
    return f"{row.mechanisms[row.least]:,} with {row.least}"


def _own(row: LeftOutRecord) -> str:
    return f"{row.mechanisms[row.added]:,} with {row.added}" if row.is_whole else f"? with {row.added}"


_COLUMNS: dict[str, Callable[[LeftOutRecord], str]] = {
    "left out": lambda row: ", ".join(row.lost),
    "fewest added wheels": _found,
    "as many as lost": _own,
    "classes": lambda row: number_text(row.classes[row.added] if row.is_whole else None, ","),
    "rank of the train": lambda row: (
        "too many" if row.is_whole and not row.listed and row.rank is None else rank_text(row.rank)
    ),
    "time": lambda row: row.note or seconds_text(row.seconds),
}
_SUMMARY: dict[str, Callable[[_TreeRows], str]] = {
    "train": lambda one: one.tree.train,
    "arbors": lambda one: str(len(one.tree.arbors)),
    "wheels": lambda one: str(one.tree.wheels),
    "pointers": lambda one: str(len(one.tree.pointers)),
    "questions": lambda one: str(one.tree.questions),
    "asked": lambda one: str(len(one.rows)),
    "finished": lambda one: str(len(one.whole)),
    "train found": lambda one: str(sum(row.rank is not None for row in one.whole)),
    "alone of its weight, first": lambda one: str(sum(row.rank is not None and row.rank[1] == 1 for row in one.whole)),
    "among the first": lambda one: str(sum(row.rank is not None and row.rank[0] == 1 for row in one.whole)),
    "greatest last rank": lambda one: f"{max((row.rank[1] for row in one.whole if row.rank), default=0):,}",
}
_NOT_ASKED: dict[str, Callable[[NotAskedRecord], str]] = {
    "train": lambda row: row.train,
    "why": lambda row: row.why,
}
