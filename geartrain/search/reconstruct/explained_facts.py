"""Findings on candidates beyond their counts: marginals of single facts, the fact of greatest entropy, the family tree.

A fact has one answer in each candidate: whether two wheels mesh, what drives an arbor, the count of a wheel. Its
marginal is the weight of each answer; looking it up is expected to tell the entropy of these weights, as the candidate
decides the answer.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Literal, NamedTuple, get_args

from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.arbor_orders import AddedPlace, NamedMesh
from geartrain.search.reconstruct.candidate_names import NamedArbor
from geartrain.search.reconstruct.dropped_facts import ChangedCount, MissingExplanation
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem, SurvivingArbor
from geartrain.search.reconstruct.reconstruction_search import Reconstructions, topology_prior
from geartrain.search.reconstruct.search_tasks import OrderPart, TopologyTrains
from geartrain.search.reconstruct.train_construction import named_candidate
from geartrain.search.reconstruct.train_topology import Topology
from geartrain.search.weighted_alternatives import entropy
from geartrain.train import Train

FactKind = Literal["mesh", "pair", "driver", "pointer", "count", "added", "needed", "used"]
"""What a fact is about.

mesh     one wheel drives another, `e4 > f1`
pair     two surviving wheels mesh, whichever drives
driver   by which arbor a surviving one is driven
pointer  on which arbor the pointer of a dial is
count    the count of a surviving wheel that is in doubt
added    the count of an added wheel, by its name
needed   a wheel of this count is added
used     a surviving wheel meshes
"""

_KINDS: tuple[FactKind, ...] = get_args(FactKind)

AN_ADDED_ARBOR = "an added arbor"
YES, NO, NONE, OUTSIDE, UNUSED = "yes", "no", "none", "not in the train", "not used"
_ELSE: dict[FactKind, str] = {"driver": OUTSIDE, "pointer": OUTSIDE, "count": UNUSED, "added": NONE}
"""The answer of a candidate that says nothing of a fact; `NO` of the other kinds."""

LOOKED_FOR: tuple[FactKind, ...] = ("pair", "driver", "count", "added", "pointer")
"""Facts that may be found out by looking at what survives, or at what still turns up."""

_MOST_FACTS = 200
"""That are looked through for facts that divide the candidates in the same way."""


class Fact(NamedTuple):
    """A question with one answer in each candidate."""

    kind: FactKind
    """What is asked."""
    subject: str
    """Of which wheel, arbor or output."""


@dataclass(frozen=True, slots=True)
class FactAnswer(Result):
    """One answer to a fact."""

    KEYS = ("answer", Key("weight", "share", float), "mechanisms")

    answer: str
    """A name, a count, `yes` or `no`."""
    share: Fraction
    """Share of the weight of the candidates that give it."""
    mechanisms: int
    """How many candidates give it."""


@dataclass(frozen=True, slots=True)
class FactMarginal(Result):
    """What the candidates say of one fact."""

    KEYS = ("kind", "subject", "bits", "answers")

    kind: FactKind
    """What the fact is about."""
    subject: str
    """Wheels, an arbor, a dial or a count."""
    answers: tuple[FactAnswer, ...]
    """The one of the greatest weight first."""

    @property
    def bits(self) -> float:
        """What an answer is expected to tell [bit]."""
        return entropy(float(answer.share) for answer in self.answers)

    @property
    def trains(self) -> int:
        """How many candidates there are."""
        return sum(answer.mechanisms for answer in self.answers)

    def share(self, answer: str) -> Fraction:
        """The weight of an answer."""
        return next((one.share for one in self.answers if one.answer == answer), Fraction(0))


@dataclass(frozen=True, slots=True)
class NextFact(Result):
    """A fact to look for."""

    KEYS = (Key("", "fact"), "same")

    fact: FactMarginal
    """What each answer would leave."""
    same: tuple[Fact, ...]
    """Others that divide the candidates in the same way."""


@dataclass(frozen=True)
class WeighedTrains:
    """Candidates, the best first, with weights as whole numbers, which add up exactly and fast."""

    trains: tuple[NamedArbor, ...]
    weights: tuple[int, ...]

    @classmethod
    def of(cls, trains: Iterable[NamedArbor], weights: Iterable[Fraction | float]) -> WeighedTrains:
        """Candidates with weights of any sum."""
        return cls(tuple(trains), tuple(whole_multiple([Fraction(weight) for weight in weights])))

    @cached_property
    def whole(self) -> int:
        """The weight of all."""
        return sum(self.weights)


class FactTally:
    """By fact and answer, the weight and the number of the trains that give it."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.trains = 0
        self._whole = Fraction(0)
        self._found: dict[Fact, dict[str, tuple[Fraction, int]]] = {}
        self._wheels = [wheel.name for arbor in _survivors(problem) for wheel in arbor.wheels]

    def add_trains(self, weight: Fraction | int, number: int = 1) -> None:
        """So many more trains, of one weight each."""
        self._whole += weight * number
        self.trains += number

    def add(self, fact: Fact, answer: str, weight: Fraction | int, number: int = 1) -> None:
        """So many of them give an answer; none gives two to one fact."""
        answers = self._found.setdefault(fact, {})
        before = answers.get(answer, (Fraction(0), 0))
        answers[answer] = before[0] + weight * number, before[1] + number

    def facts(self) -> Iterator[Fact]:
        """All of them, without wheels that all trains use, but with those that none uses."""
        used = {wheel: Fact("used", wheel) for wheel in self._wheels}
        everywhere = {fact for fact in used.values() if self._found.get(fact, {}).get(YES, (0, 0))[1] == self.trains}
        yield from (fact for fact in {**self._found, **dict.fromkeys(used.values())} if fact not in everywhere)

    def marginal(self, fact: Fact) -> FactMarginal:
        """What the trains say of a fact."""
        found = self._found.get(fact, {})
        answers = [FactAnswer(answer, weight / self._whole, number) for answer, (weight, number) in found.items()]
        left = self.trains - sum(answer.mechanisms for answer in answers)
        if left:
            rest = 1 - sum((answer.share for answer in answers), Fraction(0))
            answers.append(FactAnswer(_ELSE.get(fact.kind, NO), rest, left))
        answers.sort(key=lambda one: (-one.share, _natural(one.answer)))
        return FactMarginal(fact.kind, fact.subject, tuple(answers))


class ExplainedFacts:
    """What trains say of every fact, and which facts divide them alike.

    Parameters
    ----------
    weighed : WeighedTrains
        All of them, or the best.
    problem : ReconstructionProblem
    tally : FactTally, optional
        The sums over all, where they are known; facts divide alike if they do so in `weighed`, with equal sums.
    """

    def __init__(self, weighed: WeighedTrains, problem: ReconstructionProblem, tally: FactTally | None = None) -> None:
        self._weighed = weighed
        self._listed: dict[Fact, dict[str, list[int]]] = {}
        lost, doubtful = lost_pointers(problem), uncertain_wheels(problem)
        own = FactTally(problem)
        for index, (train, weight) in enumerate(zip(weighed.trains, weighed.weights, strict=True)):
            own.add_trains(weight)
            for fact, answer in train_facts(train, doubtful, lost):
                self._listed.setdefault(fact, {}).setdefault(answer, []).append(index)
                own.add(fact, answer, weight)
        self._tally = own if tally is None else tally

    def marginals(self) -> tuple[FactMarginal, ...]:
        """Of every fact but `pair`, those of a kind together; what is in all trains first, then by weight."""
        found = [self._tally.marginal(fact) for fact in self._tally.facts() if fact.kind != "pair"]
        return tuple(sorted(found, key=lambda one: (_KINDS.index(one.kind), -_affirmed(one), _natural(one.subject))))

    def next_facts(self) -> tuple[NextFact, ...]:
        """Facts that would divide the trains, the most telling first."""
        requested = [self._tally.marginal(fact) for fact in self._tally.facts() if fact.kind in LOOKED_FOR]
        requested = [one for one in requested if len(one.answers) > 1]
        order = {kind: at for at, kind in enumerate(LOOKED_FOR)}
        requested.sort(key=lambda one: (-round(one.bits, 12), order[one.kind], one.subject))
        alike: dict[Hashable, list[FactMarginal]] = {}
        for one in requested[:_MOST_FACTS]:
            alike.setdefault(self._parts(one), []).append(one)
        return tuple(
            NextFact(first, tuple(Fact(one.kind, one.subject) for one in others)) for first, *others in alike.values()
        )

    def _parts(self, one: FactMarginal) -> Hashable:
        """The parts into which a fact divides the trains that are listed, and how many trains of all each part has."""
        fact = Fact(one.kind, one.subject)
        parts = [frozenset(indexes) for indexes in self._listed.get(fact, {}).values()]
        rest = frozenset(range(len(self._weighed.trains))).difference(*parts)
        found = frozenset([*parts, *([rest] if rest else [])])
        if len(found) < len(one.answers):  # those that are listed do not show how it divides all
            return fact
        return found, frozenset((answer.share, answer.mechanisms) for answer in one.answers)


def train_facts(train: NamedArbor, doubtful: set[str], lost: set[str]) -> Iterator[tuple[Fact, str]]:
    """All that a candidate says, no fact twice; of the counts in doubt, and of pointers whose place is not known."""
    wheels = [wheel for arbor in train.arbors() for wheel in arbor.wheels()]
    for arbor in train.arbors():
        for dial in lost.intersection(arbor.dials):
            yield Fact("pointer", dial), AN_ADDED_ARBOR if arbor.added else arbor.name
    for wheel in wheels:
        if wheel.added:
            yield Fact("added", wheel.name), str(wheel.teeth)
        else:
            yield Fact("used", wheel.name), YES
        if wheel.name in doubtful:
            yield Fact("count", wheel.name), str(wheel.teeth)
    for teeth in {wheel.teeth for wheel in wheels if wheel.added}:
        yield Fact("needed", str(teeth)), YES
    for driving, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        yield Fact("mesh", f"{wheel.name} > {arbor.driven.name}"), YES
        if not (wheel.added or arbor.driven.added):
            yield Fact("pair", " and ".join(sorted((wheel.name, arbor.driven.name)))), YES
        if not arbor.added:
            yield Fact("driver", arbor.name), AN_ADDED_ARBOR if driving.added else driving.name


def lost_pointers(problem: ReconstructionProblem) -> set[str]:
    """Dials whose place is not known."""
    return {dial.name for dial in problem.dials if dial.place is None}


def uncertain_wheels(problem: ReconstructionProblem) -> set[str]:
    """Surviving wheels that may have several counts."""
    return {wheel.name for arbor in _survivors(problem) for wheel in arbor.wheels if not wheel.is_sure}


def _survivors(problem: ReconstructionProblem) -> Sequence[SurvivingArbor]:
    return (problem.input, *problem.arbors)


def _affirmed(fact: FactMarginal) -> Fraction:
    """The weight of yes, or of the likeliest answer where there is no yes and no."""
    return fact.answers[0].share if fact.kind in _ELSE else fact.share(YES)


def _natural(answer: str) -> tuple[int, str]:
    """Counts by size, then words."""
    return (int(answer), "") if answer.isdigit() else (1 << 62, answer)


# What all trains of a question say of single facts: weights and numbers, summed exactly without listing a train.


MOST_SUMMED = 20_000_000
"""Trains up to which sums over choices of counts are fast."""


def sum_facts(
    weighed: Iterable[tuple[Topology, Fraction]], problem: ReconstructionProblem, dials: Sequence[str]
) -> FactTally:
    """What the trains of topologies say, each topology with the weight of one of its trains."""
    trains, sums = TopologyTrains(problem, dials), FactTally(problem)
    lost, doubtful = lost_pointers(problem), uncertain_wheels(problem)
    for topology, weight in weighed:
        parts = [part for part in trains.parts(topology) if part.choices and part.orders.total]
        number = sum(part.choices * part.orders.total for part in parts)
        sums.add_trains(weight, number)
        for fact, answer in _everywhere(topology, lost, doubtful):
            sums.add(fact, answer, weight, number)
        for part in parts:
            for fact, answer, own in _told(part, trains):
                sums.add(fact, answer, weight, own)
    return sums


def _everywhere(topology: Topology, lost: set[str], doubtful: set[str]) -> Iterator[tuple[Fact, str]]:
    """What holds in each train of a topology."""
    for branching in topology.branchings:
        for dial in lost.intersection(branching.here):
            yield Fact("pointer", dial), branching.name or AN_ADDED_ARBOR
    for wheel in topology.used:
        assert wheel.name is not None
        yield Fact("used", wheel.name), YES
        if wheel.name in doubtful:
            yield Fact("count", wheel.name), str(wheel.teeth)


def _told(part: OrderPart, trains: TopologyTrains) -> Iterator[tuple[Fact, str, int]]:
    """What holds in some trains of a part, and in how many."""
    for told, orders in part.orders.marginals.items():
        if isinstance(told, NamedMesh):
            for fact, answer in _of_mesh(told):
                yield fact, answer, int(orders) * part.choices
        elif isinstance(told, AddedPlace):
            for count, choices in trains.counts.of_kind(part.open, told.kind).items():
                yield Fact("added", told.name), str(count), int(orders) * choices
    for count, choices in trains.counts.with_any(part.open).items():
        yield Fact("needed", str(count)), YES, int(part.orders.total) * choices


def _of_mesh(mesh: NamedMesh) -> Iterator[tuple[Fact, str]]:
    driving, wheel, arbor = mesh
    assert arbor.driven is not None
    yield Fact("mesh", f"{wheel.name} > {arbor.driven.name}"), YES
    if wheel.placed.name is not None and arbor.driven.placed.name is not None:
        yield Fact("pair", " and ".join(sorted((wheel.name, arbor.driven.name)))), YES
    if not arbor.added:
        yield Fact("driver", arbor.name), AN_ADDED_ARBOR if driving.added else driving.name


# ----------------------------------------------------------------------------------------------------- the family tree


# Candidates as a family tree: a trie over their meshes, from the input along the path to each pointer in turn.
# Counts part candidates last: a branch is a structure, and the trains at its end differ by their counts alone.


@dataclass(frozen=True, slots=True)
class FamilyTrain(Result):
    """A candidate at the end of a branch."""

    KEYS = ("rank", Key("weight", "share", float), "counts")

    rank: int
    """From 1 on."""
    share: Fraction
    """Share of the weight of all candidates in the tree."""
    counts: dict[str, int]
    """Of added wheels, then of surviving ones in whose count the candidates differ."""


@dataclass(frozen=True, slots=True)
class FamilyBranch(Result):
    """A stretch of meshes that a family of candidates has in common."""

    KEYS = ("parent", "meshes", Key("weight", "share", float), "mechanisms", "trains")

    parent: int | None
    """Place in the tree of the branch from which it goes on; None for the stem."""
    meshes: tuple[str, ...]
    """The driving wheel first; in brackets the pointers of the arbor that is driven."""
    share: Fraction
    """Share of the weight of all candidates in the tree."""
    mechanisms: int
    """How many candidates it holds."""
    trains: tuple[FamilyTrain, ...]
    """Candidates that end here, the best first."""


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


# -------------------------------------------------------------------------------------------------------- all findings


@dataclass(frozen=True, slots=True)
class CandidateFindings(Result):
    """What is told beyond counts."""

    listed: int = 0
    """How many candidates the family tree holds."""
    share: float = 0.0
    """Their share of the weight of all explanations, as far as that is known."""
    of_all: bool = False
    """Whether facts are told of all trains, and not of those in the family tree alone."""
    marginals: tuple[FactMarginal, ...] = ()
    """What the trains say of every fact."""
    next_facts: tuple[NextFact, ...] = ()
    """What to look for, the most telling first."""
    family: tuple[FamilyBranch, ...] = ()
    """The family tree of candidates; shares are of their weight."""
    assumptions: tuple[ChangedCount, ...] = ()
    """The counts without each hard fact, where that was asked."""
    missing: MissingExplanation | None = None
    """Why there is none."""


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
