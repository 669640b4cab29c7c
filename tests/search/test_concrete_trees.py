"""The plain growth of trees, against which the search of reconstructions is held, gives the known counts of toys."""

from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest
from concrete_trees import concrete, exact_dial, explanations, random_problem, sure_arbor

from geartrain.search.reconstruct import (
    Additions,
    Arbor,
    PlacedWheel,
    ReconstructionProblem,
    SurvivingArbor,
    find_reconstructions,
)


def toy(wheels: dict[str, int], arbor: dict[str, int], dials: dict[str, str], minimum: int, maximum: int, signed: bool):
    return ReconstructionProblem(
        input=sure_arbor("in", **wheels),
        arbors=(sure_arbor("a", **arbor),),
        dials=tuple(exact_dial(name, speed, signed=signed) for name, speed in dials.items()),
        additions=Additions(3, minimum, maximum),
    )


def t1(signed: bool) -> ReconstructionProblem:
    return toy({"i": 20}, {"a1": 30, "a2": 15}, {"P": "1"}, 10, 16, signed)


def t3(signed: bool) -> ReconstructionProblem:
    return toy({"i": 10}, {"a1": 20, "a2": 15}, {"P": "1/2", "Q": "1/3"}, 8, 16, signed)


def t4(signed: bool) -> ReconstructionProblem:
    return toy({"i": 10, "j": 12}, {"a1": 20, "a2": 15}, {"P": "-1", "Q": "1/2"}, 9, 14, signed)


@pytest.mark.parametrize(
    ("question", "signed", "solutions"),
    [
        (t1, True, (0, 1, 0, 0)),
        (t1, False, (0, 1, 0, 26)),
        (t3, True, (0, 0, 0, 2)),
        (t3, False, (0, 0, 0, 9)),
        (t4, True, (0, 0, 0, 0)),
        (t4, False, (0, 0, 0, 0)),
    ],
)
def test_toys_have_their_counts(question, signed, solutions):
    found = explanations(question(signed))
    assert tuple(each.counts.solutions for each in found) == solutions
    assert all(each.counts.classes <= each.counts.multisets <= each.counts.solutions for each in found)


def test_the_one_of_the_first_toy():
    found = explanations(t1(True))[1]
    pointer = ("", ("", 10), ("P",), ())
    assert found.solutions == {("in", (), (), ((("i", 20), (("a", ("a1", 30), (), ((("a2", 15), (pointer,)),)),)),))}
    assert found.counts.added == 1
    assert Fraction(20, 30) * Fraction(15, 10) == 1
    shown = Arbor(None, PlacedWheel(None, 10), ("P",), ())
    between = Arbor("a", PlacedWheel("a1", 30), (), ((PlacedWheel("a2", 15), (shown,)),))
    assert found.solutions == {concrete(Arbor("in", None, (), ((PlacedWheel("i", 20), (between,)),)))}


def test_a_ring_keeps_the_sense_and_holds_smaller_wheels_alone():
    """20 > x, y > 24 (a ring), 12 > z or 20 > 24, 12 > x, y > z: both turn by 10 y / (x z), forward."""
    counts = range(10, 31)
    ring = SurvivingArbor("a", (replace(sure_arbor("a", R=24).wheels[0], internal=True), *sure_arbor("a", s=12).wheels))
    question = ReconstructionProblem(
        sure_arbor("in", i=20), (ring,), (exact_dial("P", "1/2", place="new"),), Additions(3, 10, 30)
    )
    fitting = [y for x, y, z in product(counts, repeat=3) if x * z == 20 * y]
    outside = sum(y < 24 for y in fitting)
    assert (outside, len(fitting)) == (51, 71)
    found = [each.counts for each in explanations(question)]
    assert [each.solutions for each in found] == [0, 0, 0, outside + len(fitting)]
    counted = find_reconstructions(question).counts
    assert [(each.solutions, each.multisets, each.classes) for each in counted] == [each[1:] for each in found]
    back = replace(question, dials=(exact_dial("P", "-1/2", place="new"),))
    assert [each.counts.solutions for each in explanations(back)] == [0, 1, 0, 0]
    assert [each.solutions for each in find_reconstructions(back).counts] == [0, 1, 0, 0]


def test_al_biruni_without_the_moon_wheel():
    question = ReconstructionProblem(
        input=sure_arbor("week", w7=7, w10=10),
        arbors=(sure_arbor("phase", p59=59, p19=19), sure_arbor("transfer", t59=59, t24=24), sure_arbor("sun", s48=48)),
        dials=(exact_dial("moon", "-1/4"), exact_dial("phase", "-7/59"), exact_dial("sun", "-133/6962")),
        additions=Additions(1, 7, 60),
    )
    assert [each.counts for each in explanations(question)] == [(0, 0, 0, 0), (1, 2, 2, 2)]


def test_most_random_questions_have_answers():
    answered = [any(each.solutions for each in explanations(random_problem(seed))) for seed in range(40)]
    assert sum(answered) > 20
