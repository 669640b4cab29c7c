"""Complete reconstruction by one function call, from declared evidence or from a train some of whose arbors are treated
as lost.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result, Shown
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.candidate_rules import check_same, find_known_train
from geartrain.search.reconstruct.dropped_facts import (
    ChangedCount,
    changed_counts,
    explain_missing,
    without_each_fact,
)
from geartrain.search.reconstruct.evidence_translation import EvidenceQuestion, evidence_question
from geartrain.search.reconstruct.explained_facts import CandidateFindings, find_facts
from geartrain.search.reconstruct.known_rank import KnownRank, rank_known_train
from geartrain.search.reconstruct.link_roles import BaseLink, Joined
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem, RequestedQuestion
from geartrain.search.reconstruct.reconstruction_search import (
    Candidate,
    ExplanationCount,
    Reconstructions,
    explanations_text,
    find_reconstructions,
    rank_of,
)
from geartrain.search.reconstruct.spur_tree import find_spur_tree, lost_arbors, lost_evidence
from geartrain.search.reconstruct.train_construction import TrainConstruction
from geartrain.train import Train

_MOST_LISTED = 1_000_000  # list of all trains, `best` None
_MINIMUM_COMPARED = 2000
"""Minimum number of candidates whose meshes and tooth counts are compared, even if fewer candidates are listed."""


@dataclass(frozen=True, slots=True)
class ReconstructionRequest(Shown):
    """Input of `reconstruct`: evidence, limits and options of the search.

    See Also
    --------
    reconstruct : Find the trains that explain the evidence.
    """

    evidence: Train
    """Declaration with the block `reconstruct`; if `lost` is given, the declaration of a complete train."""
    lost: tuple[str, ...] = ()
    """Names of the arbors of the train that are treated as lost."""
    source: str | None = None
    """Link at which the reconstructed part of the train begins, used with `lost`. If None, this is the first link of
    the first part that contains the lost arbors.
    """
    seen: bool = False
    """True if the meshes of surviving wheels are known, and no more arbors may be added than are lost. Used with
    `lost`.
    """
    wheels: int | None = None
    """Maximum number of added wheels. If None, the number in the evidence is used."""
    idlers: bool = False
    """True to allow that a driven wheel also drives (an idler)."""
    best: int | None = 20
    """Maximum number of trains to list; None to list all of them."""
    counts_only: bool = False
    """True to count the trains without listing them."""
    prior_of: Literal["solution", "class"] = "solution"
    """Unit of the uniform prior: the same weight for every train ("solution"), or the same weight for every equivalence
    class of trains with equal ratios ("class").
    """
    assumptions: bool = False
    """True to count the trains again without each hard constraint of the evidence, one constraint at a time."""
    known: tuple[Train, ...] = ()
    """Known trains whose ranks among the reconstructed trains are computed."""
    same: Mapping[str, str] = field(default_factory=dict)
    """Name in the evidence of each wheel or output that has a different name in a known train, keyed by its name in the
    known train.
    """


class ReconstructionRun:
    """Callbacks and executors for the long parts of a reconstruction.

    By default, every part is executed in this process without interruption. The command overrides the methods to show
    progress, to write journals, and to let the user interrupt a part.
    """

    def begin(self, problem: ReconstructionProblem) -> None:
        """Handle the start of the search. By default, nothing is done; the command prints the size of the problem."""

    def search(self, problem: ReconstructionProblem) -> AbstractContextManager[Execution]:
        """Return a context manager that provides the executor of the search."""
        return nullcontext(Execution())

    def searched(self, complete: bool) -> None:
        """Handle the end of the search. By default, nothing is done. `complete` is True if the search covered all
        candidates.
        """

    def part(self, what: str) -> AbstractContextManager[Execution]:
        """Return a context manager that provides the executor for the part of a reconstruction with the name `what`,
        after the search.

        If an override suppresses an interruption (Ctrl-C), results of this part that are not yet computed are missing
        in the answer.
        """
        return nullcontext(Execution())


@dataclass(frozen=True, slots=True)
class RankedTrain(Result):
    """Train in the list of the best trains that explain the evidence.

    See Also
    --------
    reconstruct : Find the trains that explain the evidence.
    """

    KEYS = ("rank", "ranks", "added", Key("weight", to=float), "wheels", "doubtful", "meshes")

    rank: int
    """Position of the train in the list, starting with 1."""
    ranks: tuple[int, int]
    """First and last rank of the train by probability. They differ if several trains are equally probable."""
    added: int
    """Number of added wheels in the train."""
    weight: float
    """Posterior probability of the train, 0 to 1."""
    wheels: dict[str, int]
    """Tooth count of each added wheel, keyed by wheel."""
    doubtful: dict[str, int]
    """Tooth count in this train of each surviving wheel with an uncertain tooth count, keyed by wheel."""
    meshes: tuple[str, ...]
    """All meshes of the train, each in the format "driving > driven"."""


@dataclass(frozen=True, slots=True)
class ReconstructionAnswer(Result):
    """Result of `reconstruct`: numbers of trains, best trains, facts common to the trains, and ranks of known trains.

    See Also
    --------
    reconstruct : Find the trains that explain the evidence.
    """

    PAGE = "search.reconstruct.reconstruction_report:describe_reconstruction"

    KEYS = (
        "name",
        "requested",
        "counts",
        "complete",
        "unused",
        "best",
        "original",
        "known",
        Key("", "findings"),
    )

    name: str
    """Name of the declared evidence."""
    problem: ReconstructionProblem
    """Reconstruction problem that was searched."""
    counts: tuple[ExplanationCount, ...]
    """Number of trains that explain the evidence, for each number of added wheels."""
    complete: bool
    """True if the search covered all candidates."""
    unused: tuple[str, ...]
    """Descriptions of declared facts that the search does not use, one line for each."""
    best: tuple[RankedTrain, ...]
    """Most probable trains in descending order of probability, at most as many as requested."""
    original: tuple[int, int] | None = None
    """First and last rank of the original train by probability, if arbors of it were treated as lost. None if no arbors
    were treated as lost, or if the train is not listed.
    """
    findings: CandidateFindings = field(default_factory=CandidateFindings)
    """Facts derived from the listed trains: facts that all trains share, the most informative facts, and the family
    tree of the trains.
    """
    base: BaseLink | None = None
    """Base of the train, which is the link that carries the arbors (the frame or a carrier), and input link of the
    train.
    """
    joined: Joined = field(default_factory=dict)
    """Links that form one arbor because declared couplings connect them, keyed by the name of the arbor."""
    known: tuple[KnownRank, ...] = ()
    """Ranks of the known trains, or the rules that these trains break."""
    evidence: Train | None = None
    """Evidence of the problem. If arbors of a train are treated as lost, this is the evidence that remains."""
    candidates: tuple[Candidate, ...] = ()
    """Candidate reconstructions, in the order of `best`."""

    def _summary(self) -> str:
        return f"{self.name}: {explanations_text(self.counts)}, {len(self.best)} listed" + (
            "" if self.complete else ", incomplete"
        )

    @property
    def requested(self) -> RequestedQuestion:
        """Size of the reconstruction problem: numbers of surviving arbors and wheels, of pointers, and of added
        wheels.
        """
        return RequestedQuestion.of(self.problem)

    @property
    def total(self) -> int:
        """Number of all trains that explain the evidence, summed over the numbers of added wheels."""
        return sum(count.solutions for count in self.counts)


def reconstruct(request: ReconstructionRequest, run: ReconstructionRun | None = None) -> ReconstructionAnswer:
    """Find and count all trains that explain the evidence, and list the most probable trains.

    Parameters
    ----------
    request : ReconstructionRequest
        Evidence, limits and options of the search.
    run : ReconstructionRun, optional
        Executors of the long stages. By default the stages run one after the other in this process.

    Returns
    -------
    ReconstructionAnswer

    Raises
    ------
    QuestionError
        If the evidence does not support the request, or if the search would take too long.

    Examples
    --------
    >>> from geartrain.search.reconstruct import read_evidence
    >>> found = reconstruct(ReconstructionRequest(read_evidence("metonic-l-m")))
    >>> found.total, found.best[0].wheels
    (2, {'new_metonic1': 53})
    """
    run = run or ReconstructionRun()
    evidence, original = request.evidence, None
    if request.lost:
        tree = find_spur_tree(request.evidence, request.lost, request.source)
        evidence = lost_evidence(tree, request.lost, request.seen)
        original = tree.arbor(lost_arbors(tree, request.lost))
    question = evidence_question(evidence, request.wheels, request.idlers)
    _check_known(request, question)
    problem = question.problem
    run.begin(problem)
    listing = _MOST_LISTED if request.best is None else max(request.best, _MINIMUM_COMPARED)
    with run.search(problem) as execution:
        found = find_reconstructions(problem, execution, 0 if request.counts_only else listing, request.prior_of)
    run.searched(found.complete)
    listed = () if request.counts_only else found.candidates[: request.best]
    best = []
    for rank, candidate in enumerate(listed, 1):
        train = TrainConstruction(evidence, candidate.arbor)
        meshes = tuple(f"{driving} > {driven}" for driving, driven in train.meshes)
        best.append(
            RankedTrain(rank, candidate.ranks, candidate.added, candidate.weight, train.added, train.doubtful, meshes)
        )
    return ReconstructionAnswer(
        evidence.name,
        problem,
        found.counts,
        found.complete,
        question.unused,
        best=tuple(best),
        known=tuple(rank_known_train(train, evidence, problem, found, request.same) for train in request.known),
        original=None if original is None else rank_of(original, found),
        findings=_findings(request, evidence, problem, found, run),
        base=question.base,
        joined=question.joined,
        evidence=evidence,
        candidates=listed,
    )


def _check_known(request: ReconstructionRequest, question: EvidenceQuestion) -> None:
    """Raise `QuestionError` if a known train cannot be ranked. This is checked before the search."""
    if request.known and question.base.is_carrier:
        what = "known trains cannot be ranked if arbors turn on a carrier"
        raise QuestionError(Problem(what, "ranking supports only trains with fixed axes", "omit --rank"))
    check_same(request.same, request.known, question.problem)
    for train in request.known:
        find_known_train(train, question.problem, request.same)


def _findings(
    request: ReconstructionRequest,
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    run: ReconstructionRun,
) -> CandidateFindings:
    """Return the facts that are derived from the candidates. If there are no candidates, the result contains the
    reasons why no train explains the evidence. It also contains the numbers of trains without each hard constraint, if
    they are requested.
    """
    counted: list[ChangedCount] = []
    if request.assumptions and found.complete:
        with run.part("assumptions") as execution:
            # one by one, because an interruption keeps those that are counted
            for each in changed_counts(without_each_fact(problem), execution):
                counted.append(each)
    dropped = tuple(counted)
    if request.counts_only:
        return CandidateFindings(assumptions=dropped)
    if found.complete and not any(count.solutions for count in found.counts):
        missing = None
        with run.part("reasons why no train explains the evidence") as execution:
            missing = explain_missing(problem, execution)
        return CandidateFindings(assumptions=dropped, missing=missing)
    return find_facts(evidence, problem, found, dropped)
