"""What is told of candidates beyond their counts, in one result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.numerics.plain_data import Result
from geartrain.synthesis.reconstruction.candidate_train import named_candidate
from geartrain.synthesis.reconstruction.dropped_facts import ChangedCount
from geartrain.synthesis.reconstruction.explained_facts import ExplainedFacts, FactMarginal, NextFact, WeighedTrains
from geartrain.synthesis.reconstruction.family_tree import FamilyBranch, grow_family_tree
from geartrain.synthesis.reconstruction.missing_explanation import MissingExplanation
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import Candidate
from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class CandidateFindings(Result):
    """What is told beyond counts; shares are of the weight of the candidates that are looked at.

    Attributes
    ----------
    listed : int
        How many candidates are looked at.
    share : float
        Their share of the weight of all explanations, as far as that is known.
    marginals : tuple of FactMarginal
        What they say of every fact.
    next_facts : tuple of NextFact
        What to look for, the most telling first.
    family : tuple of FamilyBranch
        Their tree.
    assumptions : tuple of ChangedCount
        The counts without each hard fact, where that was asked.
    missing : MissingExplanation or None
        Why there is none.
    """

    listed: int = 0
    share: float = 0.0
    marginals: tuple[FactMarginal, ...] = ()
    next_facts: tuple[NextFact, ...] = ()
    family: tuple[FamilyBranch, ...] = ()
    assumptions: tuple[ChangedCount, ...] = ()
    missing: MissingExplanation | None = None


NO_FINDINGS = CandidateFindings()


def find_facts(
    evidence: Train,
    problem: ReconstructionProblem,
    candidates: Sequence[Candidate],
    assumptions: tuple[ChangedCount, ...] = (),
) -> CandidateFindings:
    """Marginals, facts to look for and the family tree of candidates, the best first."""
    if not candidates:
        return CandidateFindings(assumptions=assumptions)
    trains = (named_candidate(evidence, one.arbor) for one in candidates)
    weighed = WeighedTrains.of(trains, (one.weight for one in candidates))
    facts = ExplainedFacts(weighed, problem)
    marginals = facts.marginals()
    differ = {fact.subject for fact in marginals if fact.kind == "count" and len(fact.answers) > 1}
    return CandidateFindings(
        len(candidates),
        float(min(1, sum(one.weight for one in candidates))),
        marginals,
        facts.next_facts(),
        grow_family_tree(weighed, [name for name in evidence.wheels if name in differ]),
        assumptions,
    )
