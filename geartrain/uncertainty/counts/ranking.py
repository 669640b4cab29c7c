"""The combinations that agree best, in an order that no rounding and no way of searching can change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import exp

from geartrain.uncertainty.counts.question import Question
from geartrain.uncertainty.counts.result import Chance, Combination
from geartrain.uncertainty.counts.summing import Candidate

_NEAR = 1 + 1e-9
_MOST = 2000


def gather(candidates: Iterator[Candidate], most: int) -> tuple[list[Candidate], bool]:
    """The first `most` of an ascending list and all equals of the last; False if equals had to be left out."""
    found: list[Candidate] = []
    for candidate in candidates:
        if len(found) >= most and candidate.misfit > found[most - 1].misfit * _NEAR:
            return found, True
        if len(found) >= max(most, _MOST):
            return found, False
        found.append(candidate)
    return found, True


def together(parts: Sequence[Sequence[Candidate]], most: int) -> list[Candidate]:
    """Combinations of one candidate of each part, the best of them and their equals."""
    found = [Candidate(0.0, {})]
    for part in parts:
        joined = (
            Candidate(left.misfit + right.misfit, {**left.teeth, **right.teeth}) for left in found for right in part
        )
        ordered = sorted(joined, key=lambda one: one.misfit)
        found, _ = gather(iter(ordered), most)
    return found


def rank(
    question: Question, candidates: Iterable[Candidate], most: int, evidence: Chance | None
) -> tuple[Combination, ...]:
    """Exact figures of the candidates, best first: by misfit, then prior weight, then nearness to what is declared.

    evidence   of all that fits; None where it is not known, and then no chances are given
    """
    made = [_combination(question, candidate.teeth, evidence) for candidate in candidates]
    made.sort(key=lambda one: (one.misfit, -_weight(question, one.teeth), len(one.changed), tuple(one.teeth.values())))
    return tuple(made[:most])


def _combination(question: Question, teeth: Mapping[str, int], evidence: Chance | None) -> Combination:
    ordered = {wheel: teeth[wheel] for wheel in question.doubts if wheel in teeth}
    speeds: dict[str, Fraction] = {}
    errors: dict[str, Fraction] = {}
    misfit = Fraction(0)
    for witness in question.witnesses:
        speed = witness.formula.value(ordered)
        assert speed is not None, "what fits has a speed"
        speeds[witness.name] = speed
        claim = max(witness.claims, key=lambda one: one.misfit(speed))
        value = speed if claim.signed else abs(speed)
        errors[witness.name] = value / claim.wanted - 1 if claim.wanted else value
        misfit += witness.misfit(speed)
    changed = tuple(wheel for wheel, count in ordered.items() if count != question.doubts[wheel].declared)
    chance = _chance(question, ordered, misfit, evidence)
    return Combination(ordered, speeds, errors, misfit, chance, changed)


def _chance(question: Question, teeth: Mapping[str, int], misfit: Fraction, evidence: Chance | None) -> Chance | None:
    if evidence is None or not evidence.value:
        return None
    prior = Fraction(1)
    for wheel, count in teeth.items():
        doubt = question.doubts[wheel]
        prior *= doubt.priors[doubt.counts.index(count)]
    if question.soft or not isinstance(evidence.value, Fraction):
        return Chance(float(prior) * (exp(-float(misfit) / 2) if question.soft else 1) / float(evidence.value))
    return Chance(prior / evidence.value)


def _weight(question: Question, teeth: Mapping[str, int]) -> int:
    found = 1
    for wheel, count in teeth.items():
        doubt = question.doubts[wheel]
        found *= doubt.weights[doubt.counts.index(count)]
    return found
