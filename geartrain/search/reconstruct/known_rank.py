"""Rank of a known train among all that explain the evidence, or the rules that it breaks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations

from geartrain.errors import QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.candidate_names import NamedArbor
from geartrain.search.reconstruct.candidate_rules import (
    BrokenRule,
    KnownTrain,
    admitting_question,
    as_missing_dial,
    broken_rules,
    find_known_train,
)
from geartrain.search.reconstruct.dropped_facts import Search
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
    mechanism,
    prior,
    rank_of,
    weight_ranks,
)
from geartrain.search.reconstruct.train_construction import named_candidate
from geartrain.train import Train

# Which facts single one train out among all that explain the evidence: each alone, and the smallest sets of them.


MAXIMUM, MINIMUM = "maximum", "minimum"
"""Kinds of facts beside those that are looked for: how many teeth an added wheel has at most, and at least."""
_KINDS = (*LOOKED_FOR, MAXIMUM, MINIMUM)
_Subject = tuple[str, str]
_MOST_TOGETHER = 3
"""Facts that are tried together at most."""
_MOST_TRAINS = 2000
"""Trains among which one is singled out."""


@dataclass(frozen=True, slots=True)
class TellingFact(Result):
    """A fact that holds in a train and not in all."""

    kind: str
    """What it is about: of the kinds of `Fact` those that are looked for, or `MAXIMUM` or `MINIMUM`."""
    subject: str
    """Of what it is; nothing for `MAXIMUM` and `MINIMUM`."""
    answer: str
    """What the train says."""
    mechanisms: int
    """How many trains say so, itself among them."""


@dataclass(frozen=True, slots=True)
class TellingFacts(Result):
    """What singles a train out."""

    facts: tuple[TellingFact, ...]
    """All of them, those that leave the fewest trains first."""
    sets: tuple[tuple[TellingFact, ...], ...]
    """The smallest sets that leave the train alone, all of one size; of facts that leave the same trains the first
    stands for all. None if no three do."""


def find_telling_facts(
    evidence: Train, problem: ReconstructionProblem, found: Reconstructions, candidate: Arbor
) -> TellingFacts | None:
    """What singles one of all explanations out; None where they are not all listed, or too many.

    Parameters
    ----------
    evidence : Train
    problem : ReconstructionProblem
        What the evidence asks.
    found : Reconstructions
        All that explains it.
    candidate : Arbor
        One of them.
    """
    if not is_all_listed(found) or not 1 < len(found.candidates) <= _MOST_TRAINS:
        return None
    wanted = mechanism(candidate)
    which = next(at for at, one in enumerate(found.candidates) if mechanism(one.arbor) == wanted)
    trains = [named_candidate(evidence, one.arbor) for one in found.candidates]
    return single_out(trains, which, uncertain_wheels(problem), lost_pointers(problem))


def single_out(trains: Sequence[NamedArbor], which: int, doubtful: set[str], lost: set[str]) -> TellingFacts:
    """What singles one of some trains out.

    which     its place among them
    doubtful  surviving wheels whose counts are in doubt
    lost      dials whose place is not known
    """
    said = [dict(_said(train, doubtful, lost)) for train in trains]
    left: dict[TellingFact, frozenset[int]] = {}
    for fact, answer in said[which].items():
        alike = frozenset(_alike(said, fact, answer))
        if len(alike) < len(trains):
            left[TellingFact(*fact, answer, len(alike))] = alike
    facts = sorted(left, key=lambda one: (one.mechanisms, _KINDS.index(one.kind), one.subject))
    first: dict[frozenset[int], TellingFact] = {}
    for each in facts:
        first.setdefault(left[each], each)
    return TellingFacts(tuple(facts), tuple(_smallest(first, which)))


def _said(train: NamedArbor, doubtful: set[str], lost: set[str]) -> Iterator[tuple[_Subject, str]]:
    """What a train says of what may be found out; and how large its added wheels are."""
    for fact, answer in train_facts(train, doubtful, lost):
        if fact.kind in LOOKED_FOR:
            yield (fact.kind, fact.subject), answer
    added = [wheel.teeth for arbor in train.arbors() for wheel in arbor.wheels() if wheel.added]
    if added:
        yield (MAXIMUM, ""), str(max(added))
        yield (MINIMUM, ""), str(min(added))


def _alike(said: Sequence[Mapping[_Subject, str]], fact: _Subject, answer: str) -> Iterator[int]:
    """Trains of which a fact holds; of a bound, those that keep it."""
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


def _smallest(first: Mapping[frozenset[int], TellingFact], which: int) -> Iterable[tuple[TellingFact, ...]]:
    """The smallest sets of facts that leave a train alone."""
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
    """Where an explanation stands among all."""

    KEYS = ("ranks", "trains", "ranks_alike", "trains_alike", Key("weight", to=float), Key("dearer", to=float))

    ranks: tuple[int, int]
    """First and last rank by weight that it may have, for some weigh the same."""
    trains: int
    """How many explanations there are."""
    ranks_alike: tuple[int, int]
    """The same among those with as many added wheels."""
    trains_alike: int
    """How many these are."""
    weight: float
    """Its share of the weight of all."""
    dearer: Fraction
    """By what factor the best weighs more; 1 for the best."""


@dataclass(frozen=True, slots=True)
class AdmittingQuestion(Result):
    """A changed question that a train explains."""

    changes: tuple[str, ...]
    """What is otherwise in it."""
    wheels: dict[str, int]
    """Wheels that the train adds in it, with their counts."""
    arbors: int
    """Arbors that it adds."""
    requested: int
    """Up to how many added wheels it was asked: as many as the train adds, if so many may be."""
    mechanisms: tuple[int, ...]
    """Trains with just 0, 1, 2, ... added wheels that explain it."""
    place: TrainPlace | None
    """Where the train stands; None where it adds more wheels than were asked."""
    refused: str | None = None
    """Why it could not be asked, or was not."""


@dataclass(frozen=True, slots=True)
class KnownRank(Result):
    """What a known train costs in a question."""

    train: str
    """Its name."""
    wheels: dict[str, int]
    """Wheels that it adds, by their names in it, with their counts."""
    arbors: int
    """Arbors that it adds."""
    broken: tuple[BrokenRule, ...]
    """The rules that it breaks; none where it is an explanation."""
    notes: tuple[str, ...] = ()
    """What of the train plays no part."""
    place: TrainPlace | None = None
    """Where it stands; None where it breaks rules, or adds more wheels than may be added."""
    admitted: tuple[AdmittingQuestion, ...] = ()
    """What it costs in questions without these rules: with its dials as it has them, and without those whose speed
    is not the given one."""
    telling: TellingFacts | None = None
    """What singles it out, where all explanations are listed."""


@dataclass(frozen=True)
class RankedQuestion:
    """A question among whose explanations trains are ranked."""

    evidence: Train
    """What is known, and what it asks; arbors turn in the frame."""
    problem: ReconstructionProblem
    """What is known, and what it asks; arbors turn in the frame."""
    found: Reconstructions
    """All that explains it."""
    search: Search
    """What finds all that explains a changed question, with which a train is ranked that breaks rules."""


def rank_known_train(train: Train, question: RankedQuestion, same: Mapping[str, str] | None = None) -> KnownRank:
    """What a train costs in a question.

    Parameters
    ----------
    train : Train
    question : RankedQuestion
    same : mapping of str to str, optional
        Names of the train by which the question calls something otherwise; see `find_known_train`.
    """
    problem, found = question.problem, question.found
    known = find_known_train(train, problem, same)
    broken = broken_rules(known.arbor, problem)
    place = None if broken else find_place(known.arbor, problem, found)
    admitted = tuple(_all_admitted(train, problem, question.search, same or {})) if broken else ()
    telling = None if place is None else find_telling_facts(question.evidence, problem, found, known.arbor)
    return KnownRank(
        train.name, dict(known.added), known.arbor.added_arbors, broken, known.notes, place, admitted, telling
    )


def find_place(candidate: Arbor, problem: ReconstructionProblem, found: Reconstructions) -> TrainPlace | None:
    """Where an explanation stands among all; None if it adds more wheels than may be added, or that was not finished.

    Where trains weigh as their structure, the numbers of trains of each weight tell it, and no train need be listed.
    """
    added = candidate.added_wheels
    counts = {count.added: count.mechanisms for count in found.counts}
    if not counts.get(added):
        return None
    if not found.weights:
        return _listed_place(candidate, found)
    weight = prior(candidate, problem)
    every = [(each.weight, each.mechanisms) for each in found.weights]
    alike = [(each.weight, each.mechanisms) for each in found.weights if each.added == added]
    whole = sum(own * number for own, number in every)
    return TrainPlace(
        weight_ranks(every)[weight],
        sum(counts.values()),
        weight_ranks(alike)[weight],
        counts[added],
        float(weight / whole),
        max(own for own, _ in every) / weight,
    )


def _listed_place(candidate: Arbor, found: Reconstructions) -> TrainPlace | None:
    """The same where each train is weighed by itself, and all are listed."""
    ranks = rank_of(candidate, found)
    if ranks is None:
        return None
    added = candidate.added_wheels
    weight = found.candidates[ranks[0] - 1].weight
    alike = [(one.weight, 1) for one in found.candidates if one.added == added]
    return TrainPlace(
        ranks,
        len(found.candidates),
        weight_ranks(alike)[weight],
        len(alike),
        weight,
        Fraction(found.candidates[0].weight) / Fraction(weight),
    )


def _all_admitted(
    train: Train, problem: ReconstructionProblem, search: Search, same: Mapping[str, str]
) -> Iterator[AdmittingQuestion]:
    """Questions that take a train, each in one way."""
    told = set[tuple[str, ...]]()
    for without_dials in (False, True):
        changes, changed, known = _changed(train, problem, same, without_dials)
        if known is None or changes in told:
            continue
        told.add(changes)
        own = known.arbor.added_wheels
        requested = replace(changed, additions=replace(changed.additions, wheels=min(own, changed.additions.wheels)))
        said = changes, dict(known.added), known.arbor.added_arbors, requested.additions.wheels
        try:
            found = search(requested)
        except QuestionError as error:
            yield AdmittingQuestion(*said, (), None, error.problems[0].what)
        else:
            mechanisms = tuple(count.mechanisms for count in found.counts)
            yield AdmittingQuestion(*said, mechanisms, find_place(known.arbor, requested, found))


def _changed(
    train: Train, problem: ReconstructionProblem, same: Mapping[str, str], without_dials: bool
) -> tuple[tuple[str, ...], ReconstructionProblem, KnownTrain | None]:
    """What changes a question so that a train breaks no rule, the question, and the train in it; None if nothing does.

    The train is read again after each round, for without a dial less of it is asked for, and less of what survives.
    """
    changes: dict[str, None] = {}
    known = find_known_train(train, problem, same)
    while broken := broken_rules(known.arbor, problem):
        if without_dials:
            broken = tuple(as_missing_dial(each) for each in broken)
        changed = admitting_question(problem, broken)
        changes.update(dict.fromkeys(each.change for each in broken if each.change is not None))
        if changed == problem or not changed.dials:
            return (), problem, None
        problem = changed
        known = find_known_train(train, problem, same)
    return tuple(changes), problem, known
