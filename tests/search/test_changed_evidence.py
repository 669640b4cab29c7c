"""What one fact carried, and why nothing fits: against other programs, and numbers by hand."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from concrete_trees import declared, exact_dial, sections, sure_arbor
from places import TRAINS

from geartrain import Problem, QuestionError
from geartrain.search.reconstruct import (
    Additions,
    ReconstructionAnswer,
    ReconstructionProblem,
    ReconstructionRequest,
    find_reconstructions,
    read_evidence,
    reconstruct,
)
from geartrain.train import Train


def refusing(problem: ReconstructionProblem) -> None:
    raise QuestionError(Problem("not today", "", ""))


def answered(problem: ReconstructionProblem | Train) -> ReconstructionAnswer:
    """The answer with the counts without each fact."""
    evidence = problem if isinstance(problem, Train) else declared(problem)
    return reconstruct(ReconstructionRequest(evidence, assumptions=True))


def counts(problem: ReconstructionProblem | Train) -> dict[str, tuple[int, ...]]:
    """Change -> numbers of trains."""
    return {one.change: one.solutions for one in answered(problem).findings.assumptions}


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
    assert list(counts(problem)) == [
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
    evidence = read_evidence("""
links: {in: {wheels: {i: {teeth: 20, module: 1 mm}}},
        a: {wheels: {a1: {teeth: 30, module: 1 mm}, a2: {teeth: 15, module: 1 mm}}}}
axes: {I: {position: [0 mm, 0 mm, 0 mm]}, A: {position: [40 mm, 0 mm, 0 mm]}}
revolutes: [{pair: [frame, in], axis: I}, {pair: [frame, a], axis: A}]
inputs: {in: 1}
outputs: {p: {of: new, expect: 1}}
reconstruct: {add: {wheels: 1, teeth: [10, 16]}, geometry: {reach: 1 mm}}
""")
    first, *others = counts(evidence)
    assert first == "if the distances between axes exclude no meshes"
    assert not any("do not mesh" in change for change in others)
    assert counts(evidence)[first] == (0, 1)


def test_a_fact_that_is_not_there_is_not_dropped() -> None:
    free = replace(
        TOY, dials=(exact_dial("p", 1, signed=False),), use="some", idlers=True, additions=Additions(0, 3, 3)
    )
    assert counts(free) == {}


@pytest.mark.parametrize(("minimum", "most", "magnitudes"), [(-3, 2, (0, 3)), (-3, -2, (2, 3))])
def test_the_sense_is_dropped_as_a_magnitude(minimum: int, most: int, magnitudes: tuple[int, int]) -> None:
    dial = replace(TOY.dials[0], minimum=Fraction(minimum), maximum=Fraction(most))
    low, high = map(Fraction, magnitudes)
    wide = replace(TOY, dials=(dial,), additions=Additions(1, 3, 45))
    free = replace(wide, dials=(replace(dial, minimum=low, maximum=high, signed=False),))
    expected = tuple(count.solutions for count in find_reconstructions(free).counts)
    assert counts(wide)["without the sense of p"] == expected
    assert any(expected)


def test_what_each_fact_of_the_back_train_carries() -> None:
    """The counts of independent programs: 29 without the senses."""
    found = counts(read_evidence("back-train"))
    assert found["without the sense of any dial"] == (0, 0, 29)
    assert found["without the fact that the arbor of metonic is lost"] == (0, 0, 4)


NOTHING = ReconstructionProblem(
    sure_arbor("in", i=20),
    (sure_arbor("a", a1=31),),
    (exact_dial("p", Fraction(-2, 3), place="a"), exact_dial("q", Fraction(-1, 2))),
    Additions(1, 10, 45),
)
"""p wants 20 > 30 and a wheel of 31 stands there; q is 20 > 40 on an added arbor."""


def dials(found: Any) -> list[tuple[str, int | None, str | None]]:
    return [(one.dial, one.fewest, one.refused) for one in found.dials]


def missing(problem: ReconstructionProblem | Train) -> Any:
    found = answered(problem).findings.missing
    assert found is not None
    return found


def test_the_cheapest_doubt_is_first() -> None:
    """With two wheels to add, p may be on the arbor of 31 by way of an added one: 20 > x, y > 31 with 31 x = 30 y."""
    easy = replace(NOTHING, dials=NOTHING.dials[:1], additions=Additions(2, 10, 15))
    found = missing(easy).uncertainties
    assert [one.fewest for one in found] == sorted(one.fewest or 0 for one in found)
    assert found[0].change == "if a1 has 30 teeth"


def test_a_misread_count_of_the_back_train_is_found() -> None:
    """With 224 for the wheel of 223 nothing fits; of 72 changes one alone mends it, and gives the four trains."""
    text = (TRAINS / "evidence" / "back-train.yaml").read_text(encoding="utf-8")
    found = missing(read_evidence(text.replace("e3: {teeth: 223", "e3: {teeth: 224")))
    assert [(one.change, one.solutions) for one in found.uncertainties] == [("if e3 has 223 teeth", (0, 0, 4))]
    assert dials(found) == [("metonic", 1, None), ("saros", 2, None)]


def test_the_page_tells_why_nothing_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    def tables() -> dict[str, list[tuple[str, ...]]]:
        page = sections(answered(NOTHING)).values()
        words = {paragraph for section in page for paragraph in section.paragraphs}
        rows = {each.title: [tuple(row) for row in each.tables[0].rows] for each in page if each.tables}
        return rows | {word: [] for word in words}

    found = tables()
    assert found["Why no train explains the evidence"] == [
        ("p", "not explained with at most 1 added wheel"),
        ("q", "explained with 1 added wheel"),
    ]
    assert found["Changes of the evidence that would help"] == [("if a1 has 30 teeth", "1", "1")]
    assert found["Effect of each assumption"][:2] == [
        ("all facts", "0", "0", "0"),
        ("without the sense of p", "0", "0", "0"),
    ]
    # facts and rules, dials, and two wheels by up to three teeth either way
    assert any(text.startswith(f"{9 + 2 + 12} changes of the evidence tried") for text in found)
    assert not any("Not searched" in text for text in found)
    monkeypatch.setattr("geartrain.search.reconstruct.dropped_facts.find_reconstructions", refusing)
    found = tables()
    assert found["Why no train explains the evidence"] == [("p", "not today"), ("q", "not today")]
    assert found["Effect of each assumption"][1] == ("without the sense of p", "-", "-", "not today")
    assert "No single change leaves an explanation." in found
