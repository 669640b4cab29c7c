"""One pass of a search over a part: its requirements as a join, planned, cut into tasks, and run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import cast

from geartrain.numerics.work import Journal, run
from geartrain.synthesis.constraints.count_conditions import CountConstraint
from geartrain.synthesis.join.join_plan import find_join_problem
from geartrain.synthesis.join.product_lists import Domains
from geartrain.synthesis.join.selectivity import SelectivitySample
from geartrain.synthesis.join.wheel_monomials import IntervalConstraint
from geartrain.synthesis.train.best_assignments import AssignmentOrder
from geartrain.synthesis.train.independent_parts import SearchPart
from geartrain.synthesis.train.output_requirements import OutputRequirement
from geartrain.synthesis.train.pass_tasks import PassTally, PassWork, Task, cut, do_task, merged

NOTHING = PassTally(0, (), (), True, False, True)
"""What a pass comes to that was not begun, because the search was interrupted."""

Tell = Callable[[int, int], None]


@dataclass
class PassRunner:
    """How the tasks of all passes are run: executor, journal of finished tasks, report of progress.

    Several passes share a journal: each begins where the last one ended.
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: Tell | None = None
    done: int = 0
    stopped: bool = False

    def run(self, work: PassWork, tasks: Sequence[Task]) -> PassTally:
        """Do the tasks of a pass. After an interrupt nothing more is done."""
        if self.stopped:
            return NOTHING
        journal = None if self.journal is None else cast(Journal, _Section(self.journal, self.done))
        before, tell = self.done, self.tell
        self.done += len(tasks)

        def told(done: int, total: int) -> None:
            if tell is not None:
                tell(before + done, before + total)

        tally = merged(work, run(partial(do_task, work.packed()), tasks, self.executor, journal, told))
        self.stopped = tally.stopped
        return tally

    def release(self) -> None:
        """The search is over: further questions are answered in this process, without journal or report."""
        self.executor = self.journal = self.tell = None
        self.stopped = False


class _Section:
    """A journal whose tasks are numbered from somewhere on."""

    def __init__(self, journal: Journal, offset: int) -> None:
        self._journal, self._offset = journal, offset

    @property
    def closed(self) -> bool:
        """As of the journal."""
        return self._journal.closed

    def recall(self, task: int, mark: str = "") -> str | None:
        """As of the journal."""
        return self._journal.recall(task + self._offset, mark)

    def keep(self, task: int, mark: str, text: str) -> None:
        """As of the journal."""
        self._journal.keep(task + self._offset, mark, text)


@dataclass(frozen=True, slots=True)
class PassResult:
    """What a pass came to.

    share      the common tolerance it was run with, if any
    searched   part of the assignments that it looked at; 1 where it is complete
    tally      counts and the best
    reasons    what refused assignments, parallel to the tally's numbers
    order      indices of the reasons in the order in which they are decided
    steps      about how many it was forecast to take
    """

    share: Fraction | None
    searched: float
    tally: PassTally
    reasons: tuple[str, ...] = ()
    order: tuple[int, ...] = ()
    steps: float = 0.0

    @property
    def complete(self) -> bool:
        """True if every assignment was looked at."""
        return self.searched == 1 and not self.tally.cut and not self.tally.stopped

    @property
    def removed(self) -> dict[str, int]:
        """Reason -> assignments it refused, in the order asked; rules of one name together."""
        found: dict[str, int] = {}
        for at in self.order:
            reason = self.reasons[at]
            found[reason] = found.get(reason, 0) + (self.tally.removed[at] if self.tally.removed else 0)
        return found


NOT_BEGUN = PassResult(None, 0.0, NOTHING)
"""A pass that an interrupt kept from beginning."""


@dataclass
class PartSearch:
    """The passes over one part.

    limit     steps that one pass may take
    """

    part: SearchPart
    order: AssignmentOrder
    runner: PassRunner
    limit: float
    alone: tuple[tuple[str, int], ...] = field(init=False)
    domains: Domains = field(init=False)
    rules: tuple[CountConstraint, ...] = field(init=False)
    _sample: SelectivitySample | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        """Rules on one wheel narrow its counts, and are done with."""
        domains: Domains = self.part.domains
        alone = []
        for rule in self.part.rules:
            if len(rule.wheels) == 1:
                narrowed = narrow(domains, rule)
                alone.append((rule.name, size_of(domains) - size_of(narrowed)))
                domains = narrowed
        self.alone, self.domains = tuple(alone), domains
        self.rules = tuple(rule for rule in self.part.rules if len(rule.wheels) > 1)

    @property
    def sample(self) -> SelectivitySample:
        """Some assignments."""
        if self._sample is None:
            self._sample = SelectivitySample.of(self.domains)
        return self._sample

    def without(self, *, rule: str = "", asking: OutputRequirement | None = None) -> PartSearch:
        """The same search without the rules of one name, or one output less."""
        part = replace(
            self.part,
            rules=tuple(one for one in self.part.rules if one.name != rule),
            askings=tuple(one for one in self.part.askings if one is not asking),
        )
        return PartSearch(part, self.order, self.runner, self.limit)

    def asked(self, share: Fraction | None, strict: bool = False) -> tuple[IntervalConstraint, ...]:
        """Every demand of a pass."""
        found = [asking.asked(share, strict) for asking in self.part.askings]
        return (*self.part.conditions, *(one for one in found if one is not None))

    def chances(self, asked: Sequence[IntervalConstraint]) -> dict[str, float]:
        """About which part of the assignments meets each rule and demand."""
        chances = {rule.name: self.sample.of_rule(rule) for rule in self.rules}
        return chances | {one.name: self.sample.of_demand(one) for one in asked}

    def run(self, share: Fraction | None, most: float, *, strict: bool = False) -> PassResult:
        """One pass: all counted, and the best brought out if there are at most `most`.

        share    graded demands are narrowed to this common tolerance
        strict   leave out what lies on the ends of intervals
        """
        if not size_of(self.domains):
            return PassResult(share, 1.0, PassTally(0, (), (), True, False, False))
        asked = self.asked(share, strict)
        question = find_join_problem(self.domains, asked, self.rules, self.chances(asked))
        tasks, searched = cut(question, self.limit)
        work = PassWork(question, self.order, int(min(most, 1 << 62)))
        tally = self.runner.run(work, tasks)
        return PassResult(share, searched, tally, question.reasons, question.order, question.steps)


def size_of(domains: Domains) -> int:
    """Assignments there are."""
    total = 1
    for counts in domains.values():
        total *= len(counts)
    return total


def narrow(domains: Domains, rule: CountConstraint) -> Domains:
    """The counts that a rule on one wheel leaves."""
    import numpy as np

    (wheel,) = rule.wheels
    counts = domains[wheel]
    if not counts:
        return domains
    met = rule.holds({wheel: np.array(counts, dtype=np.int64)})
    return {**domains, wheel: tuple(count for count, good in zip(counts, met.tolist(), strict=True) if good)}
