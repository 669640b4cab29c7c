"""What one fact carried, and why nothing fits: against plain growth of concrete trees, and numbers by hand."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from concrete_trees import exact_dial, explanations, random_problem, sure_arbor

from geartrain.errors import Problem, QuestionError
from geartrain.search.reconstruct import (
    Additions,
    ExplanationCount,
    ReconstructionProblem,
    Reconstructions,
    SurvivingWheel,
    evidence_question,
    read_evidence,
)
from geartrain.search.reconstruct.dropped_facts import (
    LoneDial,
    changed_counts,
    explain_missing,
    without_each_dial,
    without_each_fact,
)
from geartrain.search.reconstruct.reconstruction_problem import MeasuredWheel, PlacedArbor, SurvivingGeometry


def grown(problem: ReconstructionProblem) -> Reconstructions:
    """Plain growth as a search, which lists nothing."""
    return Reconstructions(tuple(ExplanationCount(*each.counts) for each in explanations(problem)), True, ())


def refusing(problem: ReconstructionProblem) -> Reconstructions:
    raise QuestionError(Problem("not today", "", ""))


TOY = ReconstructionProblem(
    sure_arbor("in", i=20), (sure_arbor("a", a1=30, a2=15),), (exact_dial("p", 1, place="new"),), Additions(1, 10, 16)
)
"""T1 of the literature's toys: in > a1, a2 > 15 would be wanted; 20/30 * 15/10 = 1."""


def test_every_hard_fact_is_dropped_once() -> None:
    problem = replace(
        TOY,
        meshes=frozenset({frozenset(("i", "a1"))}),
        apart=frozenset({frozenset(("i", "a2"))}),
        coaxial=frozenset({frozenset(("in", "a"))}),
    )
    assert [one.change for one in without_each_fact(problem)] == [
        "without the fact that a1 and i mesh",
        "without the fact that a2 and i do not mesh",
        "without the fact that a and in are coaxial",
        "without the sense of p",
        "without the fact that the arbor of p is lost",
        "if every surviving arbor is used, but not every wheel",
        "if surviving arbors need not be used",
        "if a driven wheel may drive",
        "if added wheels may have 5 to 16 teeth",
        "if added wheels may have 10 to 32 teeth",
    ]


def test_all_that_distances_keep_apart_is_one_fact() -> None:
    """Radii 10 and 15 of i and a1 do not reach over 40 mm, 10 and 7.5 of i and a2 neither"""
    wheels = tuple(MeasuredWheel(name, True, Fraction(1)) for name in ("i", "a1", "a2"))
    arbors = tuple(PlacedArbor(name, (Fraction(x), Fraction(0))) for name, x in (("in", 0), ("a", 40)))
    geometry = SurvivingGeometry(wheels, arbors, reach=Fraction(1))
    apart = frozenset(map(frozenset, (("i", "a1"), ("i", "a2"))))
    found = without_each_fact(replace(TOY, apart=apart, geometry=geometry))
    assert found[0].change == "if the distances of axes exclude no meshes"
    assert not found[0].problem.apart
    assert found[0].problem.geometry.reach is None
    assert "apart" not in found[1].change


def test_a_fact_that_is_not_there_is_not_dropped() -> None:
    free = replace(
        TOY, dials=(exact_dial("p", 1, signed=False),), use="some", idlers=True, additions=Additions(0, 1, 1)
    )
    assert without_each_fact(free) == []
    assert without_each_dial(free) == []


def test_the_sense_is_dropped_as_a_magnitude() -> None:
    dial = replace(TOY.dials[0], minimum=Fraction(-3), maximum=Fraction(2))
    found = {one.change: one.problem for one in without_each_fact(replace(TOY, dials=(dial,)))}
    (free,) = found["without the sense of p"].dials
    assert (free.minimum, free.maximum, free.signed, free.place) == (0, 3, False, "new")
    (back,) = without_each_fact(replace(TOY, dials=(replace(dial, maximum=Fraction(-2)),)))[0].problem.dials
    assert (back.minimum, back.maximum) == (2, 3)


def test_what_each_fact_of_the_back_train_carries() -> None:
    """The counts of independent programs: 29 without the senses."""
    problem = evidence_question(read_evidence("back-train")).problem
    found = {one.change: one.solutions for one in changed_counts(without_each_fact(problem))}
    assert found["without the sense of any dial"] == (0, 0, 29)
    assert found["without the fact that the arbor of metonic is lost"] == (0, 0, 4)


@pytest.mark.parametrize("seed", range(8))
def test_counts_of_changed_questions_are_those_of_plain_growth(seed: int) -> None:
    problem = random_problem(seed, wheels=1)
    changed = without_each_fact(problem)
    assert list(changed_counts(changed)) == list(changed_counts(changed, search=grown))


def test_what_cannot_be_requested_is_said() -> None:
    (one, *_) = changed_counts(without_each_fact(TOY), search=refusing)
    assert (one.solutions, one.refused, one.fewest, one.total) == ((), "not today", None, 0)


NOTHING = ReconstructionProblem(
    sure_arbor("in", i=20),
    (sure_arbor("a", a1=31),),
    (exact_dial("p", Fraction(-2, 3), place="a"), exact_dial("q", Fraction(-1, 2))),
    Additions(1, 10, 45),
)
"""p wants 20 > 30 and a wheel of 31 stands there; q is 20 > 40 on an added arbor."""


@pytest.mark.parametrize("search", [grown, None])
def test_why_nothing_fits(search: object) -> None:
    found = explain_missing(NOTHING, **({"search": search} if search else {}))
    assert found.dials == (LoneDial("p", None), LoneDial("q", 1))
    assert [(one.change, one.solutions) for one in found.uncertainties] == [("if a1 has 30 teeth", (0, 1))]
    assert found.refused == ()
    assert found.requested == 9 + 2 + 12  # facts and rules, dials, and two wheels by up to three teeth either way


def test_the_cheapest_doubt_is_first() -> None:
    """With two wheels to add, p may be on the arbor of 31 by way of an added one: 20 > x, y > 31 with 31 x = 30 y."""
    easy = replace(NOTHING, dials=NOTHING.dials[:1], additions=Additions(2, 10, 15))
    found = explain_missing(easy).uncertainties
    assert [one.fewest for one in found] == sorted(one.fewest or 0 for one in found)
    assert found[0].change == "if a1 has 30 teeth"


def test_a_misread_count_of_the_back_train_is_found() -> None:
    """With 224 for the wheel of 223 nothing fits; of 72 changes one alone mends it, and gives the four trains."""
    problem = evidence_question(read_evidence("back-train")).problem
    e3 = SurvivingWheel("e3", ((224, Fraction(1)),))
    arbors = tuple(
        replace(arbor, wheels=tuple(e3 if wheel.name == "e3" else wheel for wheel in arbor.wheels))
        for arbor in problem.arbors
    )
    found = explain_missing(replace(problem, arbors=arbors))
    assert [(one.change, one.solutions) for one in found.uncertainties] == [("if e3 has 223 teeth", (0, 0, 4))]
    assert found.dials == (LoneDial("metonic", 1), LoneDial("saros", 2))


def test_a_search_that_refuses_is_told() -> None:
    found = explain_missing(NOTHING, search=refusing)
    assert found.dials == (LoneDial("p", None, "not today"), LoneDial("q", None, "not today"))
    assert found.uncertainties == ()
    assert len(found.refused) == found.requested
