"""Rank of a known train among all trains that explain the evidence, or the rules that it breaks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.candidate_names import NamedArbor
from geartrain.search.reconstruct.candidate_rules import BrokenRule, broken_rules, find_known_train
from geartrain.search.reconstruct.explained_facts import (
    LOOKED_FOR,
    lost_pointers,
    train_facts,
    uncertain_wheels,
)
from geartrain.search.reconstruct.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import (
    Reconstructions,
    is_all_listed,
    rank_of,
    train_key,
    train_prior,
    weight_ranks,
)
from geartrain.search.reconstruct.train_construction import named_candidate
from geartrain.train import Train

# Facts that distinguish one train from all other explanations: single facts, and the smallest sets of facts.


MAXIMUM, MINIMUM = "maximum", "minimum"
"""Kinds of facts on the maximum and the minimum tooth count of the added wheels of a train."""
_KINDS = (*LOOKED_FOR, MAXIMUM, MINIMUM)
_Subject = tuple[str, str]
_MOST_TOGETHER = 3
"""Maximum number of facts in a set that distinguishes one train from all others."""
_MOST_TRAINS = 2000
"""Maximum number of trains among which one train is distinguished."""


@dataclass(frozen=True, slots=True)
class TellingFact(Result):
    """Distinguishing fact: it is true of a given explanation, but not of all explanations."""

    kind: str
    """Kind of the fact: one of `LOOKED_FOR`, or `MAXIMUM` or `MINIMUM`."""
    subject: str
    """Wheels, arbor or dial of the fact; empty for `MAXIMUM` and `MINIMUM`."""
    answer: str
    """Answer to the fact in the train."""
    solutions: int
    """Number of trains with this answer, including the train itself."""


@dataclass(frozen=True, slots=True)
class TellingFacts(Result):
    """Facts that distinguish one train from all other explanations, singly and in the smallest sets."""

    facts: tuple[TellingFact, ...]
    """All distinguishing facts, in ascending order of the number of trains that share them."""
    sets: tuple[tuple[TellingFact, ...], ...]
    """Smallest sets of facts that are true only of this train; all sets have the same size, at most three.

    Facts that are true of the same trains are represented by the first of these facts.
    """


def find_telling_facts(
    evidence: Train, problem: ReconstructionProblem, found: Reconstructions, candidate: Arbor
) -> TellingFacts | None:
    """Find facts that distinguish one explanation from all others.

    Return None unless all explanations are listed and there are 2 to 2000 of them.
    """
    if not is_all_listed(found) or not 1 < len(found.candidates) <= _MOST_TRAINS:
        return None
    wanted = train_key(candidate)
    which = next(at for at, one in enumerate(found.candidates) if train_key(one.arbor) == wanted)
    trains = [named_candidate(evidence, one.arbor) for one in found.candidates]
    doubtful, lost = uncertain_wheels(problem), lost_pointers(problem)
    said = [dict(_observable_facts(train, doubtful, lost)) for train in trains]
    left: dict[TellingFact, frozenset[int]] = {}
    for fact, answer in said[which].items():
        alike = frozenset(_trains_with(said, fact, answer))
        if len(alike) < len(trains):
            left[TellingFact(*fact, answer, len(alike))] = alike
    facts = sorted(left, key=lambda one: (one.solutions, _KINDS.index(one.kind), one.subject))
    first: dict[frozenset[int], TellingFact] = {}
    for each in facts:
        first.setdefault(left[each], each)  # equivalent facts are represented by the first
    return TellingFacts(tuple(facts), tuple(_smallest_sets(first, which)))


def _observable_facts(train: NamedArbor, doubtful: set[str], lost: set[str]) -> Iterator[tuple[_Subject, str]]:
    """Yield the observable facts of a train, and the maximum and minimum tooth count of its added wheels."""
    for fact, answer in train_facts(train, doubtful, lost):
        if fact.kind in LOOKED_FOR:
            yield (fact.kind, fact.subject), answer
    added = [wheel.teeth for arbor in train.arbors() for wheel in arbor.wheels() if wheel.added]
    if added:
        yield (MAXIMUM, ""), str(max(added))
        yield (MINIMUM, ""), str(min(added))


def _trains_with(said: Sequence[Mapping[_Subject, str]], fact: _Subject, answer: str) -> Iterator[int]:
    """Yield the indices of trains for which a fact is true. A fact of the kind `MAXIMUM` or `MINIMUM` is true if all
    added wheels of the train respect the limit.
    """
    for at, one in enumerate(said):
        own = one.get(fact)
        if fact[0] == MAXIMUM:
            agrees = own is None or int(own) <= int(answer)
        elif fact[0] == MINIMUM:
            agrees = own is None or int(own) >= int(answer)
        else:
            agrees = own == answer
        if agrees:
            yield at


def _smallest_sets(first: Mapping[frozenset[int], TellingFact], which: int) -> Iterable[tuple[TellingFact, ...]]:
    """Return the smallest sets of facts that are true only of the given train."""
    for number in range(1, _MOST_TOGETHER + 1):
        found = [
            tuple(first[each] for each in some)
            for some in combinations(first, number)
            if frozenset.intersection(*some) == {which}
        ]
        if found:
            return found
    return ()


@dataclass(frozen=True, slots=True)
class TrainPlace(Result):
    """Rank and probability of one explanation among all explanations."""

    KEYS = ("ranks", "trains", "ranks_alike", "trains_alike", Key("weight", to=float), Key("dearer", to=float))

    ranks: tuple[int, int]
    """First and last rank by probability. They differ if several trains are equally probable."""
    trains: int
    """Number of explanations among which the train is ranked."""
    ranks_alike: tuple[int, int]
    """First and last rank among explanations with the same number of added wheels."""
    trains_alike: int
    """Number of explanations with the same number of added wheels."""
    weight: float
    """Posterior probability of the train, 0 to 1."""
    dearer: Fraction
    """Probability of the most probable explanation divided by the probability of this train, at least 1."""


@dataclass(frozen=True, slots=True)
class KnownRank(Result):
    """Rank of a known train in a problem, or the rules that it breaks."""

    train: str
    """Name of the train."""
    wheels: dict[str, int]
    """Tooth count of each wheel that the train adds, by its name in the train."""
    arbors: int
    """Number of arbors that the train adds."""
    broken: tuple[BrokenRule, ...]
    """Rules that the train breaks; empty if it is an explanation."""
    notes: tuple[str, ...] = ()
    """Features of the train that are ignored."""
    place: TrainPlace | None = None
    """Rank of the train; None if it breaks rules or adds more wheels than permitted."""
    telling: TellingFacts | None = None
    """Facts that distinguish the train; None unless the train is an explanation and 2 to 2000 explanations are all
    listed.
    """


def rank_known_train(
    train: Train,
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    same: Mapping[str, str] | None = None,
) -> KnownRank:
    """Rank a known train among the explanations of a problem whose arbors turn in the frame.

    found   all explanations of the problem
    same    name in the problem of each part that the train names differently; see `find_known_train`
    """
    known = find_known_train(train, problem, same)
    broken = broken_rules(known.arbor, problem)
    place = None if broken else find_place(known.arbor, problem, found)
    telling = None if place is None else find_telling_facts(evidence, problem, found, known.arbor)
    return KnownRank(train.name, dict(known.added), known.arbor.added_arbors, broken, known.notes, place, telling)


def find_place(candidate: Arbor, problem: ReconstructionProblem, found: Reconstructions) -> TrainPlace | None:
    """Return the rank and probability of one explanation among all explanations.

    Return None if it adds more wheels than permitted, or its number of wheels was not searched completely. If the prior
    depends only on the topology, the rank follows from the numbers of trains of each weight, and no train is listed.
    """
    if found.topologies:
        weight = train_prior(candidate, problem)
    else:
        ranks = rank_of(candidate, found)
        if ranks is None:
            return None
        weight = Fraction(found.candidates[ranks[0] - 1].weight)
    every = [(each.weight, each.solutions) for each in found.weights]
    alike = [(each.weight, each.solutions) for each in found.weights if each.added == candidate.added_wheels]
    if weight not in dict(alike):
        return None
    return TrainPlace(
        weight_ranks(every)[weight],
        sum(number for _, number in every),
        weight_ranks(alike)[weight],
        sum(number for _, number in alike),
        float(weight / sum(own * number for own, number in every)),
        max(own for own, _ in every) / weight,
    )
