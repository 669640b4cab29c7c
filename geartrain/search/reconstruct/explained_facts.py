"""Facts derived from all candidates: marginal probabilities, the fact with maximum entropy, and the family tree.

A fact is a property that has one answer in each candidate, such as whether two wheels mesh, which arbor drives an
arbor, or the tooth count of a wheel. The marginals of a fact are the probabilities of its answers. The candidate
determines the answer, so the expected information of an observation of the fact is the entropy of these probabilities.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, NamedTuple, get_args

from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.results import Key, Result
from geartrain.search.information import entropy
from geartrain.search.reconstruct.candidate_names import NamedArbor, named_candidate
from geartrain.search.reconstruct.dropped_facts import ChangedCount, MissingExplanation
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import Reconstructions, topology_prior
from geartrain.search.reconstruct.search_tasks import TopologyTrains
from geartrain.search.reconstruct.train_topology import Topology
from geartrain.train import Train

FactKind = Literal["mesh", "pair", "driver", "pointer", "count", "added", "needed", "used"]
"""Kind of a fact about a candidate.

mesh     one wheel drives another wheel, such as `e4 > f1`
pair     two surviving wheels mesh, in either direction
driver   arbor that drives a surviving arbor
pointer  arbor that carries the pointer of a dial
count    tooth count of a surviving wheel for which it is uncertain
added    tooth count of a named added wheel
needed   at least one wheel with this tooth count is added
used     a surviving wheel meshes with another wheel
"""

_KINDS: tuple[FactKind, ...] = get_args(FactKind)

AN_ADDED_ARBOR = "an added arbor"
YES, NO, NONE, OUTSIDE, UNUSED = "yes", "no", "none", "not in the train", "not used"
_ELSE: dict[FactKind, str] = {"driver": OUTSIDE, "pointer": OUTSIDE, "count": UNUSED, "added": NONE}
"""Answer that is used if a candidate has no entry for a fact, keyed by kind of fact. For kinds without an entry, the
answer is `NO`.
"""

LOOKED_FOR: tuple[FactKind, ...] = ("pair", "driver", "count", "added", "pointer")
"""Kinds of facts that can be established by examining surviving or newly found fragments."""

_MOST_FACTS = 200
"""Maximum number of facts that are compared in order to find facts that partition the candidates in the same way."""


class Fact(NamedTuple):
    """Question about a train, such as which arbor drives a given arbor. Every candidate reconstruction gives exactly
    one answer.
    """

    kind: FactKind
    """Kind of the fact."""
    subject: str
    """Subject of the fact: names of wheels, name of an arbor or a dial, or a tooth count."""


@dataclass(frozen=True, slots=True)
class FactAnswer(Result):
    """Answer to a fact, with its posterior probability and the number of candidates that give this answer."""

    KEYS = ("answer", Key("weight", "share", float), "solutions")

    answer: str
    """Answer to the fact: a name, a tooth count, `yes` or `no`."""
    share: Fraction
    """Posterior probability of this answer, 0 to 1."""
    solutions: int
    """Number of candidates with this answer."""


@dataclass(frozen=True, slots=True)
class FactMarginal(Result):
    """Marginal distribution of the answers to one fact."""

    KEYS = ("kind", "subject", "bits", "answers")

    kind: FactKind
    """Kind of the fact."""
    subject: str
    """Subject of the fact: names of wheels, name of an arbor or a dial, or a tooth count."""
    answers: tuple[FactAnswer, ...]
    """Answers to the fact, in descending order of probability."""

    @property
    def bits(self) -> float:
        """Entropy of the answers [bit], which is the expected information of an observation of the fact."""
        return entropy(float(answer.share) for answer in self.answers)

    @property
    def trains(self) -> int:
        """Number of candidates from which the probabilities are computed."""
        return sum(answer.solutions for answer in self.answers)

    def share(self, answer: str) -> Fraction:
        """Return the posterior probability of one answer to the fact."""
        return next((one.share for one in self.answers if one.answer == answer), Fraction(0))


@dataclass(frozen=True, slots=True)
class NextFact(Result):
    """Fact whose observation is proposed, with other facts that give the same information."""

    KEYS = (Key("", "fact"), "same")

    fact: FactMarginal
    """Marginal distribution of the answers to the fact."""
    same: tuple[Fact, ...]
    """Other facts that partition the candidates in the same way."""


ListedFacts = Mapping[Fact, Mapping[str, Sequence[int]]]
"""Indices of the listed trains that give each answer to each fact."""
WeighedTrains = Sequence[tuple[NamedArbor, int]]
"""Candidates in descending order of weight. The weights are integers, so that sums are exact and fast."""


class FactTally:
    """Sums of weights and numbers of trains for each answer to each fact."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.trains = 0
        self._whole = Fraction(0)
        self._found: dict[Fact, dict[str, tuple[Fraction, int]]] = {}
        self._wheels = [wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels]

    def add_trains(self, weight: Fraction | int, number: int = 1) -> None:
        """Add `number` trains, each with the given weight, to the totals."""
        self._whole += weight * number
        self.trains += number

    def add(self, fact: Fact, answer: str, weight: Fraction | int, number: int = 1) -> None:
        """Add `number` trains, each with the given weight, to one answer to a fact. A train must have only one answer
        to a fact.
        """
        answers = self._found.setdefault(fact, {})
        before = answers.get(answer, (Fraction(0), 0))
        answers[answer] = before[0] + weight * number, before[1] + number

    def facts(self) -> Iterator[Fact]:
        """Yield all facts. Facts of the kind `used` are omitted for wheels that are used in every train."""
        used = [Fact("used", wheel) for wheel in self._wheels]
        used_by_all = {fact for fact in used if self._found.get(fact, {}).get(YES, (0, 0))[1] == self.trains}
        yield from (fact for fact in dict.fromkeys([*self._found, *used]) if fact not in used_by_all)

    def marginal(self, fact: Fact) -> FactMarginal:
        """Return the marginal distribution of the answers to a fact."""
        found = self._found.get(fact, {})
        answers = [FactAnswer(answer, weight / self._whole, number) for answer, (weight, number) in found.items()]
        # trains without an entry share one implicit answer
        left = self.trains - sum(answer.solutions for answer in answers)
        if left:
            rest = 1 - sum((answer.share for answer in answers), Fraction(0))
            answers.append(FactAnswer(_ELSE.get(fact.kind, NO), rest, left))
        answers.sort(key=lambda one: (-one.share, _answer_order(one.answer)))
        return FactMarginal(fact.kind, fact.subject, tuple(answers))


def _sorted_marginals(tally: FactTally) -> tuple[FactMarginal, ...]:
    """Return the marginal distributions of all facts except facts of the kind `pair`, sorted by kind and then by
    descending probability.
    """

    def order(one: FactMarginal) -> tuple[object, ...]:
        # facts with the answers yes and no by the probability of yes
        share = one.answers[0].share if one.kind in _ELSE else one.share(YES)
        return _KINDS.index(one.kind), -share, _answer_order(one.subject)

    return tuple(sorted((tally.marginal(fact) for fact in tally.facts() if fact.kind != "pair"), key=order))


def _next_facts(tally: FactTally, listed: ListedFacts, trains: int) -> tuple[NextFact, ...]:
    """Return the observable facts whose answers differ among the trains, in descending order of entropy. Equivalent
    facts, which divide the trains in the same way, are combined into one entry.

    trains   number of trains in `listed`
    """
    requested = [tally.marginal(fact) for fact in tally.facts() if fact.kind in LOOKED_FOR]
    requested = [one for one in requested if len(one.answers) > 1]
    order = {kind: at for at, kind in enumerate(LOOKED_FOR)}
    # rounded, so that equal entropies are ordered by kind
    requested.sort(key=lambda one: (-round(one.bits, 12), order[one.kind], one.subject))
    alike: dict[Hashable, list[FactMarginal]] = {}
    for one in requested[:_MOST_FACTS]:
        fact = Fact(one.kind, one.subject)
        parts = [frozenset(indexes) for indexes in listed.get(fact, {}).values()]
        rest = frozenset(range(trains)).difference(*parts)
        division = frozenset([*parts, *([rest] if rest else [])])
        totals = frozenset((answer.share, answer.solutions) for answer in one.answers)
        # if the listed trains do not show the whole division, the fact is equivalent to no other
        alike.setdefault((division, totals) if len(division) >= len(one.answers) else fact, []).append(one)
    return tuple(
        NextFact(first, tuple(Fact(one.kind, one.subject) for one in others)) for first, *others in alike.values()
    )


def train_facts(train: NamedArbor, doubtful: set[str], lost: set[str]) -> Iterator[tuple[Fact, str]]:
    """Yield each fact of a candidate once, with its answer.

    Facts about tooth counts of surviving wheels are yielded only for wheels in `doubtful`, and facts about pointers
    only for dials in `lost`.
    """
    yield from _order_facts(train, doubtful, lost)
    added = train.added_wheels()
    yield from ((Fact("added", wheel.name), str(wheel.teeth)) for wheel in added)
    yield from ((Fact("needed", str(teeth)), YES) for teeth in {wheel.teeth for wheel in added})


def _order_facts(train: NamedArbor, doubtful: set[str], lost: set[str]) -> Iterator[tuple[Fact, str]]:
    """Yield the facts of a candidate that do not depend on the tooth counts of added wheels."""
    for arbor in train.arbors():
        for dial in lost.intersection(arbor.dials):
            yield Fact("pointer", dial), AN_ADDED_ARBOR if arbor.added else arbor.name
        for wheel in arbor.wheels():
            if not wheel.added:
                yield Fact("used", wheel.name), YES
            if wheel.name in doubtful:
                yield Fact("count", wheel.name), str(wheel.teeth)
    for driving, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        yield Fact("mesh", f"{wheel.name} > {arbor.driven.name}"), YES
        if not (wheel.added or arbor.driven.added):
            yield Fact("pair", " and ".join(sorted((wheel.name, arbor.driven.name)))), YES
        if not arbor.added:
            yield Fact("driver", arbor.name), AN_ADDED_ARBOR if driving.added else driving.name


def lost_pointers(problem: ReconstructionProblem) -> set[str]:
    """Return the names of the dials for which the arbor of the pointer is not known."""
    return {dial.name for dial in problem.dials if dial.place is None}


def uncertain_wheels(problem: ReconstructionProblem) -> set[str]:
    """Return the names of the surviving wheels whose tooth counts are uncertain."""
    arbors = (problem.input, *problem.arbors)
    return {wheel.name for arbor in arbors for wheel in arbor.wheels if not wheel.is_sure}


def _answer_order(answer: str) -> tuple[int, str]:
    """Return a sort key for answers: tooth counts in ascending order come before words."""
    return (int(answer), "") if answer.isdigit() else (1 << 62, answer)


# Marginals of facts over all trains of a question: exact sums of weights and numbers, without enumeration of trains.


MOST_SUMMED = 20_000_000
"""Maximum number of trains for which sums over all choices of tooth counts are fast."""


def sum_facts(
    weighed: Iterable[tuple[Topology, Fraction]], problem: ReconstructionProblem, evidence: Train
) -> FactTally:
    """Return the sums over all trains of the given topologies for all facts. Each topology is given with the prior
    weight of one of its trains.
    """
    trains, sums = TopologyTrains(problem), FactTally(problem)
    lost, doubtful = lost_pointers(problem), uncertain_wheels(problem)
    for topology, weight in weighed:
        for part in trains.parts(topology):
            if not part.choices:
                continue
            sums.add_trains(weight, part.trains)
            # all choices of counts are possible in every order of a part, so their numbers are multiplied
            for order, kinds in part.orders:
                named = named_candidate(evidence, order)
                for fact, answer in _order_facts(named, doubtful, lost):
                    sums.add(fact, answer, weight, part.choices)
                for wheel in named.added_wheels():
                    for count, choices in trains.counts.of_kind(part.open, kinds[wheel.teeth]).items():
                        sums.add(Fact("added", wheel.name), str(count), weight, choices)
            for count, choices in trains.counts.with_any(part.open).items():
                sums.add(Fact("needed", str(count)), YES, weight, len(part.orders) * choices)
    return sums


# ------------------------------------------------------------------------------------------------------ the family tree


# Family tree of the candidates: a trie over their meshes, from the input along the path to each pointer in turn.
# Branches are topologies; the trains at the end of a branch differ only in their tooth counts.


@dataclass(frozen=True, slots=True)
class FamilyTrain(Result):
    """Candidate whose last mesh, in the order of the family tree, belongs to a given branch."""

    KEYS = ("rank", Key("weight", "share", float), "counts")

    rank: int
    """Rank of the candidate by probability, starting with 1."""
    share: Fraction
    """Probability of the candidate, normalised over the candidates in the tree, 0 to 1."""
    counts: dict[str, int]
    """Tooth counts of added wheels, followed by those of surviving wheels whose tooth counts differ among the
    candidates.
    """


@dataclass(frozen=True, slots=True)
class FamilyBranch(Result):
    """Branch of the family tree: consecutive meshes that are common to all candidates in the branch."""

    KEYS = ("parent", "meshes", Key("weight", "share", float), "solutions", "trains")

    parent: int | None
    """Index of the parent branch; None for the first branch."""
    meshes: tuple[str, ...]
    """Meshes in the format "driving > driven", followed by the pointers of the driven arbor in parentheses."""
    share: Fraction
    """Total probability of the candidates in the branch, normalised over the candidates in the tree, 0 to 1."""
    solutions: int
    """Number of candidates in the branch."""
    trains: tuple[FamilyTrain, ...]
    """Candidates whose last mesh is in this branch, in descending order of probability."""


def grow_family_tree(weighed: WeighedTrains, doubtful: Sequence[str] = ()) -> tuple[FamilyBranch, ...]:
    """Build the family tree in depth-first order, with branches in descending order of probability.

    doubtful   names of surviving wheels whose tooth counts are included in the tree
    """
    root, whole = _Node(), sum(weight for _, weight in weighed)
    for rank, (train, weight) in enumerate(weighed, 1):
        path = [root]
        for step in _steps(train):
            path.append(path[-1].below.setdefault(step, _Node()))
        for node in path:
            node.weight += weight
            node.solutions += 1
        counts = {wheel.name: wheel.teeth for arbor in train.arbors() for wheel in arbor.wheels()}
        names = (*(wheel.name for wheel in train.added_wheels()), *(name for name in doubtful if name in counts))
        path[-1].ends.append(FamilyTrain(rank, Fraction(weight, whole), {name: counts[name] for name in names}))
    return tuple(_branches(root))


@dataclass
class _Node:
    """Node of the trie: a mesh, and the meshes that follow it in at least one candidate."""

    weight: int = 0
    solutions: int = 0
    below: dict[str, _Node] = field(default_factory=dict)
    ends: list[FamilyTrain] = field(default_factory=list)


def _branches(root: _Node) -> Iterator[FamilyBranch]:
    """Yield the branches in depth-first order. A sequence of meshes without alternatives forms one branch."""
    waiting: list[tuple[int | None, list[str], _Node]] = [(None, [], root)]
    number = 0
    while waiting:
        parent, meshes, node = waiting.pop()
        while len(node.below) == 1 and not node.ends:
            ((mesh, node),) = node.below.items()
            meshes.append(mesh)
        share = Fraction(node.weight, root.weight)
        yield FamilyBranch(parent, tuple(meshes), share, node.solutions, tuple(node.ends))
        heaviest_first = sorted(node.below.items(), key=lambda one: -one[1].weight)
        # reversed, because the stack returns the last entry first
        waiting += [(number, [mesh], below) for mesh, below in reversed(heaviest_first)]
        number += 1


def _steps(train: NamedArbor) -> Iterator[str]:
    """Yield the meshes of a train as text, each followed by the pointers of the driven arbor in parentheses."""
    if train.dials:
        yield f"({', '.join(train.dials)})"
    for _, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        pointers = f" ({', '.join(arbor.dials)})" if arbor.dials else ""
        yield f"{wheel.name} > {arbor.driven.name}{pointers}"


# --------------------------------------------------------------------------------------------------------- all findings


@dataclass(frozen=True, slots=True)
class CandidateFindings(Result):
    """Facts derived from the candidates: marginals, facts to observe next, family tree, and sensitivity to
    assumptions.

    See Also
    --------
    find_facts : Derive facts from candidates.
    """

    listed: int = 0
    """Number of candidates in the family tree."""
    share: float = 0.0
    """Total posterior probability of the candidates in the family tree, 0 to 1."""
    of_all: bool = False
    """True if the facts are computed from all trains; False if they are computed only from the trains in the family
    tree.
    """
    marginals: tuple[FactMarginal, ...] = ()
    """Marginal distribution of every fact except facts of the kind `pair`."""
    next_facts: tuple[NextFact, ...] = ()
    """Facts to observe next, in descending order of their entropy."""
    family: tuple[FamilyBranch, ...] = ()
    """Family tree of the listed candidates. Its probabilities are normalised over these candidates."""
    assumptions: tuple[ChangedCount, ...] = ()
    """Number of trains that explain the evidence if one hard constraint is omitted, for each constraint; empty if this
    was not requested.
    """
    missing: MissingExplanation | None = None
    """Reasons why no train explains the evidence; None if a train explains it, or if the reasons were not searched for.
    """


def find_facts(
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    assumptions: tuple[ChangedCount, ...] = (),
) -> CandidateFindings:
    """Derive facts from the candidates: marginals, facts to observe next, and the family tree.

    The marginals and the facts to observe next are based on all trains if sums over all trains can be computed.

    Parameters
    ----------
    evidence : Train
        Evidence that the candidates explain.
    problem : ReconstructionProblem
        Reconstruction problem of this evidence.
    found : Reconstructions
        Explanations of the problem.
    assumptions : tuple of ChangedCount
        Numbers of trains without each hard constraint, which are copied to the result.

    Returns
    -------
    CandidateFindings

    Examples
    --------
    >>> from geartrain.search.reconstruct import evidence_question, find_reconstructions, read_evidence
    >>> evidence = read_evidence("metonic-l-m")
    >>> problem = evidence_question(evidence).problem
    >>> found = find_facts(evidence, problem, find_reconstructions(problem))
    >>> found.next_facts[0].fact.subject, found.next_facts[0].fact.bits
    ('b2 and l1', 1.0)
    """
    candidates = found.candidates
    if not candidates:
        return CandidateFindings(assumptions=assumptions)
    weights = whole_multiple([Fraction(one.weight) for one in candidates])
    weighed = [(named_candidate(evidence, one.arbor), each) for one, each in zip(candidates, weights, strict=True)]
    lost, doubtful = lost_pointers(problem), uncertain_wheels(problem)
    listed: dict[Fact, dict[str, list[int]]] = {}
    for index, (train, _) in enumerate(weighed):
        for fact, answer in train_facts(train, doubtful, lost):
            listed.setdefault(fact, {}).setdefault(answer, []).append(index)
    of_all = bool(found.topologies) and sum(each.solutions for each in found.topologies) <= MOST_SUMMED
    if of_all:
        every = ((each.topology, topology_prior(each.topology, problem)) for each in found.topologies)
        tally = sum_facts(every, problem, evidence)
    else:
        tally = FactTally(problem)
        for _, weight in weighed:
            tally.add_trains(weight)
        for fact, answers in listed.items():
            for answer, indexes in answers.items():
                for index in indexes:
                    tally.add(fact, answer, weighed[index][1])
    marginals = _sorted_marginals(tally)
    differ = {fact.subject for fact in marginals if fact.kind == "count" and len(fact.answers) > 1}
    return CandidateFindings(
        len(candidates),
        float(min(1, sum(one.weight for one in candidates))),
        of_all or len(candidates) == sum(count.solutions for count in found.counts),
        marginals,
        _next_facts(tally, listed, len(weighed)),
        grow_family_tree(weighed, [name for name in evidence.wheels if name in differ]),
        assumptions,
    )
