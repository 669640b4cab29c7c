"""What is told of candidates beyond their counts, in one result."""

from __future__ import annotations

from dataclasses import dataclass

from geartrain.numerics.plain_data import Result
from geartrain.synthesis.reconstruction.candidate_prior import skeleton_prior
from geartrain.synthesis.reconstruction.candidate_train import named_candidate
from geartrain.synthesis.reconstruction.dropped_facts import ChangedCount
from geartrain.synthesis.reconstruction.explained_facts import ExplainedFacts, FactMarginal, NextFact, WeighedTrains
from geartrain.synthesis.reconstruction.fact_sums import MOST_SUMMED, sum_facts
from geartrain.synthesis.reconstruction.family_tree import FamilyBranch, grow_family_tree
from geartrain.synthesis.reconstruction.missing_explanation import MissingExplanation
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import Reconstructions
from geartrain.train import Train


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
    if found.skeletons and sum(each.mechanisms for each in found.skeletons) <= MOST_SUMMED:
        every = ((each.skeleton, skeleton_prior(each.skeleton, problem)) for each in found.skeletons)
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
