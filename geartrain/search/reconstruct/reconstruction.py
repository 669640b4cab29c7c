"""A reconstruction in one call: from declared evidence, or a train without some arbors, to all that is known of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result, Shown
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.candidate_rules import check_same, find_known_train
from geartrain.search.reconstruct.dropped_facts import (
    ChangedCount,
    ChangedQuestion,
    changed_counts,
    explain_missing,
    without_each_fact,
)
from geartrain.search.reconstruct.evidence_translation import EvidenceQuestion, evidence_question
from geartrain.search.reconstruct.explained_facts import NO_FINDINGS, CandidateFindings, find_facts
from geartrain.search.reconstruct.known_rank import KnownRank, RankedQuestion, rank_known_train
from geartrain.search.reconstruct.link_roles import BaseLink, Joined
from geartrain.search.reconstruct.reconstruction_problem import Arbor, ReconstructionProblem, RequestedQuestion
from geartrain.search.reconstruct.reconstruction_search import (
    Candidate,
    ExplanationCount,
    Reconstructions,
    draw_candidates,
    explanations_text,
    find_reconstructions,
    rank_of,
)
from geartrain.search.reconstruct.search_tasks import ExpectedCost, expect_cost
from geartrain.search.reconstruct.spur_tree import find_spur_tree, lost_arbors, lost_evidence
from geartrain.search.reconstruct.train_construction import TrainConstruction
from geartrain.train import Train

_ALL = 1_000_000
_LOOKED_AT = 2000
"""Candidates whose meshes and counts are compared, also where fewer are listed."""


@dataclass(frozen=True, slots=True)
class ReconstructionRequest(Shown):
    """What is requested of a reconstruction.

    See Also
    --------
    reconstruct : answers it.
    """

    evidence: Train
    """A declaration with `reconstruct`; with `lost` a complete train."""
    lost: tuple[str, ...] = ()
    """Arbors of the train that are taken as lost."""
    source: str | None = None
    """With `lost`: the link at which the part of the train begins; default the first part that has the arbors."""
    seen: bool = False
    """With `lost`: whether the meshes of surviving wheels are known, and no more arbors are added than are lost."""
    wheels: int | None = None
    """How many wheels may be added; default what the evidence says."""
    idlers: bool = False
    """Whether a driven wheel may drive."""
    best: int | None = 20
    """How many trains are listed; None for all of them."""
    counts_only: bool = False
    """Whether trains are counted only, and none is listed."""
    per: Literal["mechanism", "class"] = "mechanism"
    """What has a weight of its own: every train, or every class of equal ratios."""
    sample: int = 0
    """Number of trains drawn at random by their weight."""
    seed: int = 1
    """Seed of all random drawing."""
    assumptions: bool = False
    """Whether each hard fact is dropped in turn, and the trains are counted again."""
    known: tuple[Train, ...] = ()
    """Trains that are ranked among the explanations."""
    same: Mapping[str, str] = field(default_factory=dict)
    """Wheels and outputs of these trains, with their names in the evidence."""


class ReconstructionRun:
    """How the long parts of a reconstruction are run: in this process, and to the end.

    A command overrides this to show progress, to keep journals, and to let a part be stopped.
    """

    def begin(self, problem: ReconstructionProblem) -> None:
        """Called before anything is searched."""

    def expect(self, problem: ReconstructionProblem, cost: ExpectedCost) -> None:
        """Called when the cost of the search is known."""

    def search(self, problem: ReconstructionProblem, cost: ExpectedCost) -> AbstractContextManager[Execution]:
        """How the search is executed."""
        return nullcontext(Execution())

    def assume(
        self, problem: ReconstructionProblem, changed: Sequence[ChangedQuestion], counted: Sequence[ChangedCount]
    ) -> AbstractContextManager[Execution]:
        """How changed questions are counted. A manager that suppresses an interruption keeps what was `counted`."""
        return nullcontext(Execution())

    def searched(self, complete: bool) -> None:
        """Called when all is searched."""

    def part(self, what: str) -> AbstractContextManager[Execution]:
        """How another part is executed; a manager that suppresses an interruption leaves it out."""
        return nullcontext(Execution())


@dataclass(frozen=True, slots=True)
class RankedTrain(Result):
    """One of the best explanations.

    See Also
    --------
    reconstruct : lists the best.
    """

    KEYS = ("rank", "ranks", "added", Key("weight", to=float), "wheels", "doubtful", "meshes")

    rank: int
    """Place among those that are listed, from 1 on."""
    ranks: tuple[int, int]
    """First and last rank by weight that it may have, for some weigh the same."""
    added: int
    """Added wheels."""
    weight: float
    """Share of the weight of all explanations."""
    wheels: dict[str, int]
    """Added wheels with their counts."""
    doubtful: dict[str, int]
    """Surviving wheels that have a range of counts, with the one that they have here."""
    meshes: tuple[str, ...]
    """Every mesh, the driving wheel first."""


@dataclass(frozen=True, slots=True)
class ReconstructionAnswer(Result):
    """The answer to a request.

    See Also
    --------
    reconstruct : gives it.
    """

    PAGE = "search.reconstruct.reconstruction_report:describe_reconstruction"

    KEYS = (
        "name",
        "requested",
        "expected",
        "counts",
        "complete",
        "unused",
        "best",
        "drawn",
        "original",
        "known",
        Key("", "findings"),
    )

    name: str
    """Of the evidence."""
    problem: ReconstructionProblem
    """The typed question."""
    counts: tuple[ExplanationCount, ...]
    """Explanations by number of added wheels."""
    complete: bool
    """Whether all were looked at."""
    unused: tuple[str, ...]
    """What is declared and plays no part."""
    best: tuple[RankedTrain, ...]
    """The best, as many as were requested."""
    original: tuple[int, int] | None = None
    """First and last rank by weight of the train of which arbors were left out, for some may weigh the same."""
    findings: CandidateFindings = NO_FINDINGS
    """What is found beyond counts."""
    base: BaseLink | None = None
    """What bears the arbors, where that is a carrier."""
    joined: Joined = field(default_factory=dict)
    """Links that given couplings join, by the arbor that stands for them."""
    expected: ExpectedCost | None = None
    """What the search was expected to cost before it began."""
    drawn: tuple[RankedTrain, ...] = ()
    """Trains drawn at random, as many as were requested; `rank` counts them."""
    known: tuple[KnownRank, ...] = ()
    """What given trains cost in the question."""
    evidence: Train | None = None
    """The evidence that was asked of; with lost arbors what is left of the train."""
    candidates: tuple[Candidate, ...] = ()
    """Those of `best`."""

    def _summary(self) -> str:
        return f"{self.name}: {explanations_text(self.counts)}, {len(self.best)} listed" + (
            "" if self.complete else ", incomplete"
        )

    @property
    def requested(self) -> RequestedQuestion:
        """What is asked."""
        return RequestedQuestion.of(self.problem)

    @property
    def total(self) -> int:
        """Mechanisms in all."""
        return sum(count.mechanisms for count in self.counts)


def reconstruct(request: ReconstructionRequest, run: ReconstructionRun | None = None) -> ReconstructionAnswer:
    """Find every train that explains the evidence, count them, and list the best.

    Parameters
    ----------
    request : ReconstructionRequest
        The evidence, and what is asked of it.
    run : ReconstructionRun, optional
        How the long parts are run; default one after the other in this process.

    Returns
    -------
    ReconstructionAnswer

    Raises
    ------
    QuestionError
        If the evidence cannot be asked so, or the search would not end.

    Examples
    --------
    >>> from geartrain.search.reconstruct import read_evidence
    >>> found = reconstruct(ReconstructionRequest(read_evidence("metonic-l-m")))
    >>> found.total, found.best[0].wheels
    (2, {'new_metonic1': 53})
    """
    run = run or ReconstructionRun()
    evidence, original = _of_train(request) if request.lost else (request.evidence, None)
    question = evidence_question(evidence, request.wheels, request.idlers)
    _check_known(request, question)
    problem = question.problem
    run.begin(problem)
    expected = expect_cost(problem)
    run.expect(problem, expected)
    listing = 0 if request.counts_only else _ALL if request.best is None else max(request.best, _LOOKED_AT)
    with run.search(problem, expected) as execution:
        found = find_reconstructions(problem, execution, listing, request.per)
    dropped = _without_facts(problem, run) if request.assumptions and found.complete else ()
    run.searched(found.complete)
    listed = () if request.counts_only else found.candidates[: request.best]
    dials = tuple(evidence.outputs)
    drawn = draw_candidates(found, problem, dials, request.sample, request.seed) if request.sample else ()
    return ReconstructionAnswer(
        evidence.name,
        problem,
        found.counts,
        found.complete,
        question.unused,
        best=tuple(_ranked(evidence, listed)),
        known=_ranks_of_known(request, evidence, problem, found, run),
        original=None if original is None else rank_of(original, found),
        findings=_findings(evidence, problem, found, dropped, request.counts_only, run),
        base=question.base,
        joined=question.joined,
        expected=expected,
        drawn=tuple(_ranked(evidence, drawn)),
        evidence=evidence,
        candidates=listed,
    )


def _of_train(request: ReconstructionRequest) -> tuple[Train, Arbor]:
    """Evidence of a train whose arbors are lost, and the train itself as a candidate."""
    tree = find_spur_tree(request.evidence, request.lost, request.source)
    return lost_evidence(tree, request.lost, request.seen), tree.arbor(lost_arbors(tree, request.lost))


def _check_known(request: ReconstructionRequest, question: EvidenceQuestion) -> None:
    """Raise `QuestionError` for known trains that cannot be ranked, before anything is searched."""
    if request.known and question.base.is_carrier:
        what = "trains are not ranked where arbors turn on a carrier"
        raise QuestionError(Problem(what, "a known train is read on fixed axes", "leave --rank out"))
    check_same(request.same, request.known, question.problem)
    for train in request.known:
        find_known_train(train, question.problem, request.same)


def _without_facts(problem: ReconstructionProblem, run: ReconstructionRun) -> tuple[ChangedCount, ...]:
    """The counts without each hard fact; only the first of them if that is stopped."""
    changed = without_each_fact(problem)
    counted: list[ChangedCount] = []
    with run.assume(problem, changed, counted) as execution:
        for each in changed_counts(changed, execution):
            counted.append(each)
    return tuple(counted)


def _ranks_of_known(
    request: ReconstructionRequest,
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    run: ReconstructionRun,
) -> tuple[KnownRank, ...]:
    """What each known train costs; one that is stopped is left out."""
    ranked: list[KnownRank] = []
    for train in request.known:
        with run.part(f"what {train.name} costs") as execution:
            question = RankedQuestion(evidence, problem, found, _whole_search(execution))
            ranked.append(rank_known_train(train, question, request.same))
    return tuple(ranked)


def _whole_search(execution: Execution) -> Callable[[ReconstructionProblem], Reconstructions]:
    """A search that ends with all explanations, or not at all."""

    def search(requested: ReconstructionProblem) -> Reconstructions:
        answer = find_reconstructions(requested, execution, listed=0)
        if not answer.complete:  # the search returns what it has when it is stopped
            raise KeyboardInterrupt
        return answer

    return search


def _findings(
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    dropped: tuple[ChangedCount, ...],
    counts_only: bool,
    run: ReconstructionRun,
) -> CandidateFindings:
    """What is found of the candidates, or why there are none; with `counts_only` assumptions only."""
    if counts_only:
        return CandidateFindings(assumptions=dropped)
    if found.complete and not any(count.mechanisms for count in found.counts):
        missing = None
        with run.part("why nothing fits") as execution:
            missing = explain_missing(problem, execution)
        return CandidateFindings(assumptions=dropped, missing=missing)
    return find_facts(evidence, problem, found, dropped)


def _ranked(evidence: Train, listed: Sequence[Candidate]) -> Iterator[RankedTrain]:
    for rank, candidate in enumerate(listed, 1):
        train = TrainConstruction.of(evidence, candidate.arbor)
        meshes = tuple(f"{driving} > {driven}" for driving, driven in train.meshes)
        yield RankedTrain(rank, candidate.ranks, candidate.added, candidate.weight, train.added, train.doubtful, meshes)
