"""Which facts single one train out among all that explain the evidence: each alone, and the smallest sets of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from geartrain.numerics.plain_data import Result
from geartrain.synthesis.reconstruction.candidate_train import named_candidate
from geartrain.synthesis.reconstruction.explained_facts import (
    LOOKED_FOR,
    lost_pointers,
    train_facts,
    wheels_in_doubt,
)
from geartrain.synthesis.reconstruction.lost_arbors import is_all_listed
from geartrain.synthesis.reconstruction.named_train import NamedArbor
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import Reconstructions
from geartrain.synthesis.reconstruction.sameness import mechanism
from geartrain.train import Train

GREATEST, LEAST = "greatest", "least"
"""Kinds of facts beside those that are looked for: how many teeth an added wheel has at most, and at least."""
_KINDS = (*LOOKED_FOR, GREATEST, LEAST)
_Subject = tuple[str, str]
_MOST_TOGETHER = 3
"""Facts that are tried together at most."""
_MOST_TRAINS = 2000
"""Trains among which one is singled out."""


@dataclass(frozen=True, slots=True)
class TellingFact(Result):
    """A fact that holds in a train and not in all.

    Attributes
    ----------
    kind : str
        What it is about: of the kinds of `Fact` those that are looked for, or `GREATEST` or `LEAST`.
    subject : str
        Of what it is; nothing for `GREATEST` and `LEAST`.
    answer : str
        What the train says.
    mechanisms : int
        How many trains say so, itself among them.
    """

    kind: str
    subject: str
    answer: str
    mechanisms: int


@dataclass(frozen=True, slots=True)
class TellingFacts(Result):
    """What singles a train out.

    Attributes
    ----------
    facts : tuple of TellingFact
        All of them, those that leave the fewest trains first.
    sets : tuple of tuple of TellingFact
        The smallest sets that leave the train alone, all of one size; of facts that leave the same trains the first
        stands for all. None if no three do.
    """

    facts: tuple[TellingFact, ...]
    sets: tuple[tuple[TellingFact, ...], ...]


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
    return single_out(trains, which, wheels_in_doubt(problem), lost_pointers(problem))


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
        yield (GREATEST, ""), str(max(added))
        yield (LEAST, ""), str(min(added))


def _alike(said: Sequence[Mapping[_Subject, str]], fact: _Subject, answer: str) -> Iterator[int]:
    """Trains of which a fact holds; of a bound, those that keep it."""
    for at, one in enumerate(said):
        own = one.get(fact)
        if fact[0] == GREATEST:
            agrees = own is None or int(own) <= int(answer)
        elif fact[0] == LEAST:
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
