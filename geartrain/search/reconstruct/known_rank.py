"""Rank of a known train among all trains that explain the evidence, or the rules that the known train breaks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.candidate_names import named_candidate
from geartrain.search.reconstruct.candidate_rules import BrokenRule, broken_rules, find_known_train
from geartrain.search.reconstruct.explained_facts import (
    LOOKED_FOR,
    FactKind,
    lost_pointers,
    train_facts,
    uncertain_wheels,
)
from geartrain.search.reconstruct.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import (
    Reconstructions,
    is_all_listed,
    rank_of,
    train_prior,
    weight_ranks,
)
from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class TellingFact(Result):
    """Fact that distinguishes a given train from some other trains that explain the evidence."""

    kind: FactKind
    """Kind of the fact, one of `LOOKED_FOR`."""
    subject: str
    """Subject of the fact: names of wheels, name of an arbor or a dial, or a tooth count."""
    answer: str
    """Value of the fact in the given train."""
    solutions: int
    """Number of trains that explain the evidence and have this value, including the given train."""


def find_telling_facts(
    evidence: Train, problem: ReconstructionProblem, found: Reconstructions, candidate: Arbor
) -> tuple[TellingFact, ...]:
    """Return the observable facts that distinguish one train from other trains that explain the evidence, in ascending
    order of the number of trains in which the fact has the same value.

    The result is empty unless all trains that explain the evidence are listed.
    """
    if not is_all_listed(found):
        return ()
    doubtful, lost = uncertain_wheels(problem), lost_pointers(problem)
    own, *said = (
        dict(train_facts(named_candidate(evidence, arbor), doubtful, lost))
        for arbor in (candidate, *(one.arbor for one in found.candidates))
    )
    counted = (
        TellingFact(*fact, answer, sum(one.get(fact) == answer for one in said))
        for fact, answer in own.items()
        if fact.kind in LOOKED_FOR
    )
    telling = (fact for fact in counted if fact.solutions < len(said))
    return tuple(sorted(telling, key=lambda one: (one.solutions, LOOKED_FOR.index(one.kind), one.subject)))


@dataclass(frozen=True, slots=True)
class TrainPlace(Result):
    """Rank and probability of one train among all trains that explain the evidence."""

    KEYS = ("ranks", "trains", "ranks_alike", "trains_alike", Key("weight", to=float), Key("dearer", to=float))

    ranks: tuple[int, int]
    """First and last rank of the train by probability. They differ if several trains are equally probable."""
    trains: int
    """Number of candidate trains, all of which explain the evidence, among which the train is ranked."""
    ranks_alike: tuple[int, int]
    """First and last rank of the train among the candidate trains with the same number of added wheels. They differ if
    several trains are equally probable.
    """
    trains_alike: int
    """Number of candidate trains with the same number of added wheels as the train."""
    weight: float
    """Posterior probability of the train, 0 to 1."""
    dearer: Fraction
    """Probability of the most probable candidate train divided by the probability of this train, at least 1."""


@dataclass(frozen=True, slots=True)
class KnownRank(Result):
    """Rank of a known train among all trains that explain the evidence, or the rules that the train breaks."""

    train: str
    """Name of the known train."""
    wheels: dict[str, int]
    """Tooth count of each wheel that the train adds to the surviving wheels, keyed by the name of the wheel in the
    train.
    """
    arbors: int
    """Number of arbors that the train adds to the surviving arbors."""
    broken: tuple[BrokenRule, ...]
    """Rules of the problem that the train breaks; empty if the train explains the evidence."""
    notes: tuple[str, ...] = ()
    """Descriptions of features of the train that are ignored."""
    place: TrainPlace | None = None
    """Rank and probability of the train; None if it breaks rules or adds more wheels than permitted."""
    telling: tuple[TellingFact, ...] = ()
    """Facts that distinguish the train from other trains that explain the evidence; empty unless the train explains the
    evidence and all such trains are listed.
    """


def rank_known_train(
    train: Train,
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    same: Mapping[str, str] | None = None,
) -> KnownRank:
    """Return the rank of a known train among all trains that solve a reconstruction problem whose arbors turn in the
    frame.

    found   all trains that solve the problem
    same    name in the problem of each part that is named differently in the train; see `find_known_train`
    """
    known = find_known_train(train, problem, same)
    broken = broken_rules(known.arbor, problem)
    place = None if broken else find_place(known.arbor, problem, found)
    telling = () if place is None else find_telling_facts(evidence, problem, found, known.arbor)
    return KnownRank(train.name, dict(known.added), known.arbor.added_arbors, broken, known.notes, place, telling)


def find_place(candidate: Arbor, problem: ReconstructionProblem, found: Reconstructions) -> TrainPlace | None:
    """Return the rank and probability of one train among all trains that explain the evidence.

    Return None if it adds more wheels than permitted, or if trains with its number of wheels were not searched
    completely. If the prior depends only on the topology, the rank follows from the number of trains for each weight,
    so the trains need not be listed.
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
