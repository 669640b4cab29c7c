"""What was found of trains of which arbors were left out, and its tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import comb

from studies.records import StudyRecords, number_text, seconds_text, table


@dataclass(frozen=True, slots=True)
class TreeRecord:
    """A part of a train of which arbors are left out.

    part      what bears its arbors and where it begins; nothing for that from the input on the frame
    source    the arbor at which it begins
    arbors    those that it drives, each of which is left out in turn
    wheels    of all of them that mesh
    pointers  outputs whose speeds are known
    teeth     least and greatest count that is added
    """

    train: str
    part: str
    source: str
    arbors: Sequence[str]
    wheels: int
    pointers: Sequence[str]
    teeth: Sequence[int]

    @property
    def questions(self) -> int:
        """How many arbors, and pairs of arbors, there are to be left out."""
        return comb(len(self.arbors) + 1, 2)


@dataclass(frozen=True, slots=True)
class CoverRecord:
    """How much of a train is asked.

    links     how many it has beside the frame
    left_out  how many of them are left out, in some part
    others    the others, each with the reason
    """

    train: str
    links: int
    left_out: int
    others: Sequence[str]


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
    part         of the train, as of a tree
    reached      whether the search comes to the train, followed along its own paths; None where that was not asked
    told         first and last rank of the train where the meshes of what survives are told; None where that was not
                 finished or not asked
    better       of a question that was not finished: how many explanations weigh more; None where that is not known
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
    part: str = ""
    reached: bool | None = None
    told: Sequence[int] | None = None
    better: int | None = None

    @property
    def is_found(self) -> bool:
        """Whether the train is known to be among the explanations."""
        return self.rank is not None or bool(self.reached)

    @property
    def first(self) -> int | None:
        """The first rank that the train may have; None where it is open."""
        if self.rank is not None:
            return self.rank[0]
        return None if self.better is None else self.better + 1

    @property
    def is_whole(self) -> bool:
        """Whether all explanations were counted."""
        return self.seconds is not None

    @property
    def minimum(self) -> int | None:
        """The fewest added wheels that explain the dials, as far as was counted."""
        return next((added for added, count in enumerate(self.mechanisms) if count), None)


@dataclass(frozen=True)
class LeftOutRecords(StudyRecords):
    """Everything that was asked on one machine."""

    trees: Sequence[TreeRecord]
    rows: Sequence[LeftOutRecord]
    not_requested: Sequence[NotAskedRecord]
    covers: Sequence[CoverRecord]

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
        """Answers that lack the train itself: there must be none."""
        return [row for row in self.rows if (row.is_whole and row.listed and row.rank is None) or row.reached is False]

    def tables(self) -> list[str]:
        """A summary, how much of each train is asked, every question, and the trains that are not asked."""
        lines = ["## By train", "", *table(_SUMMARY, [_TreeRows(tree, self._of(tree)) for tree in self.trees])]
        lines += ["## Arbors that are left out", "", *table(_COVER, self.covers)]
        for tree in self.trees:
            own = self._of(tree)
            lines += [f"## {_heading(tree)}", "", _about(tree, tree.questions - len(own)), "", *table(_COLUMNS, own)]
        return [*lines, "## Not asked", "", *table(_NOT_REQUESTED, self.not_requested)]

    def _of(self, tree: TreeRecord) -> list[LeftOutRecord]:
        return [row for row in self.rows if (row.train, row.part) == (tree.train, tree.part)]


@dataclass(frozen=True)
class _TreeRows:
    tree: TreeRecord
    rows: list[LeftOutRecord]

    @property
    def whole(self) -> list[LeftOutRecord]:
        return [row for row in self.rows if row.is_whole]


def _heading(tree: TreeRecord) -> str:
    return ", ".join(filter(None, (tree.train, tree.part)))


def _about(tree: TreeRecord, unasked: int) -> str:
    left = f" Not asked yet: {unasked}." if unasked else ""
    pointers = ", ".join(tree.pointers)
    return f"From {tree.source} on; pointers: {pointers}; {tree.teeth[0]} to {tree.teeth[1]} teeth.{left}"


def _found(row: LeftOutRecord) -> str:
    """How many explanations there are with the fewest added wheels."""
    if row.minimum is None:
        return "-" if not row.mechanisms else f"none with {len(row.mechanisms) - 1}"
    return f"{row.mechanisms[row.minimum]:,} with {row.minimum}"


def _was_found(row: LeftOutRecord) -> str:
    if row.is_whole and row.listed and row.rank is None:
        return "no"
    if row.is_found:
        return "listed" if row.rank is not None else "followed"
    return "open" if row.reached is None else "no"


def _own(row: LeftOutRecord) -> str:
    return f"{row.mechanisms[row.added]:,} with {row.added}" if row.is_whole else f"? with {row.added}"


_COLUMNS: dict[str, Callable[[LeftOutRecord], str]] = {
    "left out": lambda row: ", ".join(row.lost),
    "fewest added wheels": _found,
    "as many as lost": _own,
    "classes": lambda row: number_text(row.classes[row.added] if row.is_whole else None, ","),
    "train found": _was_found,
    "first rank": lambda row: number_text(row.first, ",") if row.first else "open",
    "last rank": lambda row: number_text(row.rank[1], ",") if row.rank else "open",
    "with meshes told": lambda row: (
        " to ".join(f"{rank:,}" for rank in dict.fromkeys(row.told)) if row.told else "open"
    ),
    "time": lambda row: row.note or seconds_text(row.seconds),
}
_SUMMARY: dict[str, Callable[[_TreeRows], str]] = {
    "train": lambda one: _heading(one.tree),
    "arbors": lambda one: str(len(one.tree.arbors)),
    "wheels": lambda one: str(one.tree.wheels),
    "pointers": lambda one: str(len(one.tree.pointers)),
    "questions": lambda one: str(one.tree.questions),
    "asked to the end": lambda one: str(len(one.whole)),
    "train found": lambda one: str(sum(row.is_found for row in one.rows)),
    "first rank known": lambda one: str(sum(row.first is not None for row in one.rows)),
    "it is 1": lambda one: str(sum(row.first == 1 for row in one.rows)),
    "known with meshes told": lambda one: str(sum(row.told is not None for row in one.rows)),
    "it is 1 there": lambda one: str(sum(row.told is not None and row.told[0] == 1 for row in one.rows)),
    "alone of its weight, first": lambda one: str(sum(row.rank is not None and row.rank[1] == 1 for row in one.whole)),
    "greatest last rank": lambda one: f"{max((row.rank[1] for row in one.whole if row.rank), default=0):,}",
}
_COVER: dict[str, Callable[[CoverRecord], str]] = {
    "train": lambda row: row.train,
    "links": lambda row: str(row.links),
    "left out": lambda row: str(row.left_out),
    "not left out": lambda row: "; ".join(row.others),
}
_NOT_REQUESTED: dict[str, Callable[[NotAskedRecord], str]] = {
    "train": lambda row: row.train,
    "why": lambda row: row.why,
}
