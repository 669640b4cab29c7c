"""Evidence on a carrier is a problem seen from the carrier, and its trains turn as their dials say by the solver."""

from __future__ import annotations

from fractions import Fraction

import pytest
from carried_trees import problem_by_hand, random_evidence

from geartrain import GearTrain
from geartrain.search.reconstruct import candidate_train, evidence_question, find_reconstructions, read_evidence
from geartrain.train import declare


@pytest.mark.parametrize("rings", [False, True])
def test_the_problem_is_that_seen_from_the_carrier(rings: bool) -> None:
    for seed in range(200):
        data = random_evidence(seed, rings)
        assert evidence_question(declare(data)).problem == problem_by_hand(data), seed


@pytest.mark.parametrize("rings", [False, True])
def test_candidates_turn_as_their_dials_say(rings: bool, subtests: pytest.Subtests) -> None:
    """The solver knows nothing of reconstructions: it finds carriers by itself and solves Willis' equations."""
    answered = 0
    for seed in range(60):
        with subtests.test(seed=seed):
            answered += _turn_as_their_dials_say(seed, rings)
    assert answered > 30


def _turn_as_their_dials_say(seed: int, rings: bool) -> bool:
    data = random_evidence(seed, rings)
    evidence = declare(data)
    found = find_reconstructions(evidence_question(evidence).problem, listed=10)
    for one in found.candidates[:10]:
        train = GearTrain(candidate_train(evidence, one.arbor, "one"))
        assert train.mobility.by_rank == 1 + (len(data["inputs"]) - 1)
        solved = train.solve()
        assert solved
        for name, output in data["outputs"].items():
            assert train.declaration.outputs[name].relative_to == output.get("relative_to")
            assert solved.outputs[name].speed == Fraction(output["expect"])
    return bool(found.candidates)


MARS = """\
name: mars
links:
  frame: {wheels: {x56: 56}}
  b: {}
  cp64: {wheels: {cp64: 64, cp38: 38}}
  ma71: {wheels: {ma71: 71}}
  ma80s: {wheels: {ma80s: 80}}
  mars: {wheels: {ma80o: 80}}
revolutes: [{pair: [frame, b], axis: B}, {pair: [frame, mars], axis: B}]
inputs: {b: 1}
outputs:
  mars: {of: mars, expect: 151/284}
  anomaly: {of: ma71, relative_to: b, expect: 133/284}
reconstruct:
  carrier: b
  given: [{pair: [ma71, ma80s]}]
  idlers: true
  add: {wheels: 1, teeth: [12, 100]}
"""


def test_a_pin_in_a_slot_on_the_carrier() -> None:
    """Mars of 2021 without its idler: one of 89 counts, before the arbor cp64 or behind it."""
    evidence = read_evidence(MARS)
    found = find_reconstructions(evidence_question(evidence).problem, listed=1000)
    assert [count.solutions for count in found.counts] == [0, 2 * 89]
    for one in found.candidates[::20]:
        train = GearTrain(candidate_train(evidence, one.arbor, "one"))
        assert train.mobility.by_rank == 1
        solved = train.solve()
        assert solved
        assert (solved["mars"], solved["ma80s"]) == (Fraction(151, 284), Fraction(417, 284))
