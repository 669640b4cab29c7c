"""What was found of trains of which arbors were left out, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

from studies.records import StudyRecords


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
class LeftOutRecord:
    """What explains a train without some of its arbors.

    lost         arbors that are left out
    added        their wheels: so many may be added
    solutions   explanations with 0, 1, ... added wheels, as far as they were counted
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
    solutions: Sequence[int]
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
        return next((added for added, count in enumerate(self.solutions) if count), None)


@dataclass(frozen=True)
class LeftOutRecords(StudyRecords):
    """Everything that was asked on one machine."""

    trees: Sequence[TreeRecord]
    rows: Sequence[LeftOutRecord]

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
