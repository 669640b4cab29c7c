"""Arbors that given couplings join are one arbor of the question, and several in a train."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from concrete_trees import random_problem, with_rings

from geartrain import GearTrain, GearTrainError
from geartrain.search.reconstruct import (
    ReconstructionProblem,
    SurvivingArbor,
    candidate_train,
    evidence_question,
    find_reconstructions,
    read_evidence,
)
from geartrain.search.reconstruct.link_roles import join_arbors


def parted(problem: ReconstructionProblem, seed: int) -> tuple[ReconstructionProblem, dict[str, tuple[str, ...]]]:
    """The question with some of its arbors in two or three that couplings join; wheels and dials are shared out."""
    chance = random.Random(seed)
    homes = {
        arbor.name: (arbor.name, *(f"{arbor.name}{end}" for end in "xy"[: chance.randint(0, 2)]))
        for arbor in (problem.input, *problem.arbors)
    }

    def parts(arbor: SurvivingArbor) -> list[SurvivingArbor]:
        places = sorted(chance.choice(range(len(homes[arbor.name]))) for _ in arbor.wheels)
        return [
            SurvivingArbor(name, tuple(wheel for wheel, place in zip(arbor.wheels, places, strict=True) if place == at))
            for at, name in enumerate(homes[arbor.name])
        ]

    first, *others = parts(problem.input)
    arbors = [part for arbor in problem.arbors for part in parts(arbor)]
    dials = tuple(replace(dial, place=chance.choice(homes.get(dial.place, (dial.place,)))) for dial in problem.dials)
    coaxial = frozenset(frozenset(chance.choice(homes[name]) for name in pair) for pair in problem.coaxial)
    changed = replace(problem, input=first, arbors=(*others, *arbors), dials=dials, coaxial=coaxial)
    return changed, {name: links for name, links in homes.items() if len(links) > 1}


def test_arbors_that_were_parted_are_joined_again() -> None:
    for seed in range(100):
        problem = with_rings(random_problem(seed, idlers=True), seed)
        assert join_arbors(*parted(problem, seed)) == problem


COUPLED = """\
links:
  frame: {}
  a: {wheels: {p: 20}}
  k: {}
  m: {wheels: {v: 40, w: 30}}
  n: {wheels: {x: 60}}
inputs: {a: 1}
outputs: {sun: {of: k, expect: -1/2}, moon: {of: n, expect: 1/4}, star: {expect: 1/3}}
reconstruct:
  given: [{pair: [m, k]}]
  add: {wheels: 1, teeth: [40, 50]}
"""


def test_joined_arbors_are_one_in_the_question_and_several_in_a_train() -> None:
    """20 > 40 shows -1/2, behind the coupling too; 30 > 60 is 1/4 and 30 > 45 is 1/3."""
    evidence = read_evidence(COUPLED)
    question = evidence_question(evidence)
    assert question.joined == {"m": ("m", "k")}
    assert [arbor.name for arbor in question.problem.arbors] == ["m", "n"]
    assert question.problem.dials[0].place == "m"
    found = find_reconstructions(question.problem)
    assert [count.solutions for count in found.counts] == [0, 1]
    train = GearTrain(candidate_train(evidence, found.candidates[0].arbor, "one"))
    assert train.mobility.by_rank == 1
    assert train.solve()
    assert train.solve()["sun"] == Fraction(-1, 2)
    declared = train.declaration
    assert declared.outputs["sun"].of == "k"
    assert [(each.kind, each.pin, each.slot) for each in declared.couplings] == [("pin_and_slot", "m", "k")]
    assert {link: [*part.wheels] for link, part in declared.links.items() if link in "km"} == {"m": ["v", "w"], "k": []}


def test_a_coupling_that_is_declared_as_in_a_train_keeps_its_sizes() -> None:
    said = "{id: anomaly, kind: pin_and_slot, pin: k, slot: m, pin_radius: 9.6 mm, offset: 1.1 mm, status: surviving}"
    evidence = read_evidence(COUPLED.replace("  given: [{pair: [m, k]}]\n", "") + f"couplings: [{said}]\n")
    question, given = evidence_question(evidence), evidence_question(read_evidence(COUPLED))
    assert (question.problem, question.joined) == (given.problem, given.joined)
    train = GearTrain(candidate_train(evidence, find_reconstructions(question.problem).candidates[0].arbor, "one"))
    assert train.solve()
    assert train.declaration.couplings == evidence.couplings


def test_the_input_stands_for_what_is_joined_to_it_and_added_wheels_are_written_on_it() -> None:
    text = (
        COUPLED.replace("[m, k]", "[k, a]").replace("-1/2", "1").replace("star: {expect: 1/3}", "star: {expect: -2/5}")
    )
    evidence = read_evidence(text)
    assert evidence_question(evidence).joined == {"a": ("a", "k")}
    found = find_reconstructions(evidence_question(evidence).problem)
    declared = candidate_train(evidence, found.candidates[0].arbor, "one")
    assert [count.solutions for count in found.counts] == [0, 1]
    assert {link: len(part.wheels) for link, part in declared.links.items()}["new_star"] == 1
    assert [(each.pin, each.slot) for each in declared.couplings] == [("k", "a")]


def test_what_survives_unused_keeps_its_coupling_out() -> None:
    text = COUPLED.replace("{of: k, expect: -1/2}", "{expect: -2/5}").replace(
        "moon: {of: n, expect: 1/4}, star: {expect: 1/3}", ""
    )
    evidence = read_evidence(text.replace("  add:", "  use: some\n  add:"))
    found = find_reconstructions(evidence_question(evidence).problem)
    declared = candidate_train(evidence, found.candidates[0].arbor, "one")
    assert not declared.couplings
    assert declared.note == "Not used: k, m, n."


def test_the_moon_has_as_many_trains_behind_the_pin_as_before_it() -> None:
    """Two, by two programs, with the pointer at the pipe: 24 and 127 are forced, their order with c is not."""
    for name, sign in (("moon-c-e", -1), ("moon-pin-and-slot", 1)):
        evidence = read_evidence(name)
        found = find_reconstructions(evidence_question(evidence).problem)
        assert [count.solutions for count in found.counts] == [0, 0, 2]
        for one in found.candidates:
            assert GearTrain(candidate_train(evidence, one.arbor, "one")).solve()["moon"] == Fraction(sign * 254, 19)


AXES = "axes: {B: {position: [0 mm, 1 mm, 0 mm]}}\n"
REFUSED = {
    "frame": (COUPLED.replace("[m, k]", "[m, frame]"), ["would lock an arbor"]),
    "the carrier": (
        COUPLED.replace("[m, k]", "[m, c]").replace("  k: {}", "  c: {}\n  k: {}").replace("{a: 1}", "{a: 1, c: 2}")
        + "  carrier: c\n",
        ["'m' and 'c' would lock an arbor"],
    ),
    "itself": (COUPLED.replace("[m, k]", "[m, m]"), ["connects arbors that are already connected"]),
    "loop": (COUPLED.replace("[m, k]}", "[m, k]}, {pair: [k, n]}, {pair: [n, m]}"), ["'n' and 'm'", "already"]),
    "mesh": (COUPLED.replace("[m, k]", "[m, n]") + "gears: [{pair: [w, x]}]\n", ["known mesh 'w~x'", "lock"]),
    "follower": (
        COUPLED + "couplings: [{kind: pin_follower, pin: m, slot: n}]\n",
        ["'m~n' is not a pin and slot", "give the speed of the arbor that drives it"],
    ),
    "carrier": (
        COUPLED + "revolutes: [{pair: [n, k], axis: K}]\n",
        ["'k', which turns on 'n'", "crosses a carrier", "before and after 'n'"],
    ),
    "axes": (
        COUPLED + "revolutes: [{pair: [frame, n], axis: N}, {pair: [frame, k], axis: N}]\n",
        ["'m' and 'k' are connected, but are on different axes", "`apart`"],
    ),
    "places": (
        COUPLED + f"  geometry: {{}}\n{AXES}revolutes: [{{pair: [frame, m], axis: B}}]\n",
        ["'m' and 'k' are connected, but are on different axes"],
    ),
}


@pytest.mark.parametrize("why", REFUSED)
def test_what_cannot_be_joined_is_refused_by_name(why: str) -> None:
    text, words = REFUSED[why]
    with pytest.raises(GearTrainError) as caught:
        evidence_question(read_evidence(text))
    for word in words:
        assert word in str(caught.value), str(caught.value)


def test_joined_arbors_on_one_axis_keep_what_is_known_of_it() -> None:
    text = COUPLED + "  geometry: {}\n" + AXES
    text += "revolutes: [{pair: [frame, n], axis: B}, {pair: [frame, k], axis: B}, {pair: [frame, m], axis: B}]\n"
    problem = evidence_question(read_evidence(text)).problem
    assert problem.coaxial == {frozenset("mn")}
    assert sorted(arbor.name for arbor in problem.geometry.arbors) == ["m", "n"]
