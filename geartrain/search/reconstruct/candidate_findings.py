"""Findings on candidates beyond their counts, in one result; the family tree is a trie over meshes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.candidate_names import NamedArbor
from geartrain.search.reconstruct.candidate_train import named_candidate
from geartrain.search.reconstruct.dropped_facts import ChangedCount, MissingExplanation
from geartrain.search.reconstruct.explained_facts import (
    MOST_SUMMED,
    ExplainedFacts,
    FactMarginal,
    NextFact,
    WeighedTrains,
    sum_facts,
)
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_result import Reconstructions, topology_prior
from geartrain.train import Train

# Candidates as a family tree: a trie over their meshes, from the input along the path to each pointer in turn.
# Counts part candidates last: a branch is a structure, and the trains at its end differ by their counts alone.


@dataclass(frozen=True, slots=True)
class FamilyTrain(Result):
    """A candidate at the end of a branch.

    Attributes
    ----------
    rank : int
        From 1 on.
    weight : float
        Share of the weight of all in the tree.
    counts : dict of str to int
        Of added wheels, then of surviving ones in whose count the candidates differ.
    """

    KEYS = ("rank", Key("weight", "share", float), "counts")

    rank: int
    share: Fraction
    counts: dict[str, int]


@dataclass(frozen=True, slots=True)
class FamilyBranch(Result):
    """A stretch of meshes that a family of candidates has in common.

    Attributes
    ----------
    parent : int or None
        Place in the tree of the branch from which it goes on; None for the stem.
    meshes : tuple of str
        The driving wheel first; in brackets the pointers of the arbor that is driven.
    weight : float
        Share of the weight of all in the tree.
    mechanisms : int
        How many candidates it holds.
    trains : tuple of FamilyTrain
        Candidates that end here, the best first.
    """

    KEYS = ("parent", "meshes", Key("weight", "share", float), "mechanisms", "trains")

    parent: int | None
    meshes: tuple[str, ...]
    share: Fraction
    mechanisms: int
    trains: tuple[FamilyTrain, ...]


def grow_family_tree(weighed: WeighedTrains, doubtful: Sequence[str] = ()) -> tuple[FamilyBranch, ...]:
    """The tree, each branch before those that go on from it, and heavy ones before light ones.

    doubtful   names of surviving wheels whose counts are told too
    """
    root = _Node()
    for rank, (train, weight) in enumerate(zip(weighed.trains, weighed.weights, strict=True), 1):
        root.add(train, weight, FamilyTrain(rank, Fraction(weight, weighed.whole), _counts(train, doubtful)))
    return tuple(_flat(root)) if weighed.trains else ()


@dataclass
class _Node:
    """A mesh of the trie, with all that goes on from it."""

    weight: int = 0
    mechanisms: int = 0
    below: dict[str, _Node] = field(default_factory=dict)
    ends: list[FamilyTrain] = field(default_factory=list)

    def add(self, train: NamedArbor, weight: int, end: FamilyTrain) -> None:
        node = self
        node._count(weight)
        for step in _steps(train):
            node = node.below.setdefault(step, _Node())
            node._count(weight)
        node.ends.append(end)

    def _count(self, weight: int) -> None:
        self.weight += weight
        self.mechanisms += 1


def _flat(root: _Node) -> Iterator[FamilyBranch]:
    """Branches in their order; meshes that all of a family share are one."""
    waiting: list[tuple[int | None, list[str], _Node]] = [(None, [], root)]
    number = 0
    while waiting:
        parent, meshes, node = waiting.pop()
        while len(node.below) == 1 and not node.ends:
            ((mesh, node),) = node.below.items()
            meshes.append(mesh)
        share = Fraction(node.weight, root.weight)
        yield FamilyBranch(parent, tuple(meshes), share, node.mechanisms, tuple(node.ends))
        heaviest_first = sorted(node.below.items(), key=lambda one: -one[1].weight)
        waiting += [(number, [mesh], below) for mesh, below in reversed(heaviest_first)]
        number += 1


def _steps(train: NamedArbor) -> Iterator[str]:
    if train.dials:
        yield _shown(train)
    for _, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        yield f"{wheel.name} > {arbor.driven.name}{_shown(arbor) and f' {_shown(arbor)}'}"


def _shown(arbor: NamedArbor) -> str:
    """The pointers of an arbor, in brackets."""
    return f"({', '.join(arbor.dials)})" if arbor.dials else ""


def _counts(train: NamedArbor, doubtful: Sequence[str]) -> dict[str, int]:
    wheels = [wheel for arbor in train.arbors() for wheel in arbor.wheels()]
    counts = {wheel.name: wheel.teeth for wheel in wheels}
    names = (*(wheel.name for wheel in wheels if wheel.added), *(name for name in doubtful if name in counts))
    return {name: counts[name] for name in names}


@dataclass(frozen=True, slots=True)
class CandidateFindings(Result):
    """What is told beyond counts.

    Attributes
    ----------
    listed : int
        How many candidates the family tree holds.
    share : float
        Their share of the weight of all explanations, as far as that is known.
    of_all : bool
        Whether facts are told of all trains, and not of those in the family tree alone.
    marginals : tuple of FactMarginal
        What the trains say of every fact.
    next_facts : tuple of NextFact
        What to look for, the most telling first.
    family : tuple of FamilyBranch
        The family tree of candidates; shares are of their weight.
    assumptions : tuple of ChangedCount
        The counts without each hard fact, where that was asked.
    missing : MissingExplanation or None
        Why there is none.
    """

    listed: int = 0
    share: float = 0.0
    of_all: bool = False
    marginals: tuple[FactMarginal, ...] = ()
    next_facts: tuple[NextFact, ...] = ()
    family: tuple[FamilyBranch, ...] = ()
    assumptions: tuple[ChangedCount, ...] = ()
    missing: MissingExplanation | None = None


NO_FINDINGS = CandidateFindings()


def find_facts(
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    assumptions: tuple[ChangedCount, ...] = (),
) -> CandidateFindings:
    """Marginals and facts to look for, of all trains where they can be summed, and the family tree of the listed."""
    candidates = found.candidates
    if not candidates:
        return CandidateFindings(assumptions=assumptions)
    trains = (named_candidate(evidence, one.arbor) for one in candidates)
    weighed = WeighedTrains.of(trains, (one.weight for one in candidates))
    tally = None
    if found.topologies and sum(each.mechanisms for each in found.topologies) <= MOST_SUMMED:
        every = ((each.topology, topology_prior(each.topology, problem)) for each in found.topologies)
        tally = sum_facts(every, problem, tuple(evidence.outputs))
    facts = ExplainedFacts(weighed, problem, tally)
    marginals = facts.marginals()
    differ = {fact.subject for fact in marginals if fact.kind == "count" and len(fact.answers) > 1}
    return CandidateFindings(
        len(candidates),
        float(min(1, sum(one.weight for one in candidates))),
        tally is not None or len(candidates) == sum(count.mechanisms for count in found.counts),
        marginals,
        facts.next_facts(),
        grow_family_tree(weighed, [name for name in evidence.wheels if name in differ]),
        assumptions,
    )
