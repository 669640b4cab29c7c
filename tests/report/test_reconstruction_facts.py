"""What is told of candidates beyond counts: words and tables of results made by hand; trees in every form."""

from __future__ import annotations

from fractions import Fraction
from io import StringIO

import pytest
from rich.console import Console

from geartrain.report import Document, Section, to_html, to_markdown
from geartrain.report.document import Branch, SceneText
from geartrain.report.text import to_terminal
from geartrain.search.reconstruct.dropped_facts import ChangedCount, LoneDial, MissingExplanation
from geartrain.search.reconstruct.explained_facts import (
    Fact,
    FactAnswer,
    FactKind,
    FactMarginal,
    FamilyBranch,
    FamilyTrain,
    NextFact,
)
from geartrain.search.reconstruct.reconstruction_report import (
    assumptions_section,
    family_section,
    missing_sections,
    next_section,
    shared_sections,
)

EVIL = "<script>alert(1)</script>"
HALF = Fraction(1, 2)


def marginal(kind: FactKind, subject: str, *answers: tuple[str, Fraction, int]) -> FactMarginal:
    return FactMarginal(kind, subject, tuple(FactAnswer(*answer) for answer in answers))


def sure(kind: FactKind, subject: str, answer: str = "yes") -> FactMarginal:
    return marginal(kind, subject, (answer, Fraction(1), 3))


def test_what_all_share_is_told_in_sentences() -> None:
    agreed = [
        sure("mesh", "b2 > l1"),
        sure("mesh", "l2 > m1"),
        sure("driver", "l", "b"),
        sure("needed", "53"),
        sure("count", "e3", "223"),
        sure("used", "f1", "no"),
        sure("pointer", "sun", "g"),
    ]
    (section,) = shared_sections(agreed)
    assert list(section.paragraphs) == [
        "In all of them: b2 > l1, l2 > m1.",
        "All of them need a wheel of 53.",
        "Besides: e3 has 223 teeth; f1 is not used; the pointer of sun is on g.",
    ]


def test_where_they_part_each_answer_has_its_share() -> None:
    parted = [
        marginal("mesh", "e4 > f1", ("yes", HALF, 1), ("no", HALF, 2)),
        marginal("count", "e3", *((str(count), Fraction(1, 8), 1) for count in range(220, 228))),
        marginal("needed", "53", ("no", Fraction(3, 4), 2), ("yes", Fraction(1, 4), 1)),
    ]
    nothing, section = shared_sections(parted)
    assert "the trains agree in no fact" in nothing.paragraphs[0]
    meshes, answers, needed = section.tables
    assert list(meshes.rows) == [("e4 > f1", "50 %", "1")]
    assert list(answers.rows) == [
        (
            "the count of e3",
            "220: 12.5 % (1), 221: 12.5 % (1), 222: 12.5 % (1), 223: 12.5 % (1), 4 more: 50 %",
            "3",
        )
    ]
    assert list(needed.rows) == [("53", "25 %", "1")]
    assert list(shared_sections([])) == []
    assert list(shared_sections([marginal("needed", "53", ("yes", Fraction(1), 1))])) == []
    (section,) = shared_sections([sure("count", "e3", "223")])
    assert list(section.paragraphs) == ["In all of them: e3 has 223 teeth."]


def test_the_next_fact_says_what_each_answer_leaves() -> None:
    fact = marginal("pair", "e4 and f1", ("no", HALF, 2), ("yes", HALF, 2))
    (section,) = next_section([NextFact(fact, (Fact("driver", "f"), Fact("added", "m_new1"), Fact("count", "g1")))])
    assert list(section.tables[0].rows) == [
        (
            "whether e4 and f1 mesh",
            "1",
            "no: 50 % (2), yes: 50 % (2)",
            "which arbor drives f; the count of m_new1, which is added and 1 more",
        )
    ]
    (long,) = next_section([NextFact(fact, ())] * 14)
    assert len(long.tables[0].rows) == 12
    assert "12 of 14." in long.paragraphs
    assert list(next_section([])) == []


def test_assumptions_stand_beside_what_is_given() -> None:
    changes = [ChangedCount("without the sense of sun", (0, 5)), ChangedCount("if idle", (), False, "not asked yet")]
    (section,) = assumptions_section([0, 2], changes)
    assert list(section.tables[0].rows) == [
        ("all facts", "0", "2", "2"),
        ("without the sense of sun", "0", "5", "5"),
        ("if idle", "-", "-", "not asked yet"),
    ]
    assert list(assumptions_section([0], [])) == []


def test_why_nothing_fits() -> None:
    dials = (LoneDial("sun", None), LoneDial("moon", 1), LoneDial("saros", None, "too wide"))
    doubts = (ChangedCount("if a1 has 30 teeth", (0, 2)),)
    alone, cheapest = missing_sections(MissingExplanation(dials, doubts, 23, ("if idle",)), 2)
    assert list(alone.tables[0].rows) == [
        ("sun", "fails: no train with 2 added wheels or fewer"),
        ("moon", "explained with 1 added wheel"),
        ("saros", "too wide"),
    ]
    assert list(cheapest.tables[0].rows) == [("if a1 has 30 teeth", "1", "2")]
    assert "23 changes" in cheapest.paragraphs[0]
    assert "Not searched: if idle." in cheapest.paragraphs
    _, none = missing_sections(MissingExplanation(dials, (), 1, ()), 2)
    assert "No single change leaves an explanation." in none.paragraphs
    assert list(missing_sections(None, 2)) == []


TREE = (
    FamilyBranch(None, ("b2 > l1",), Fraction(1), 3, ()),
    FamilyBranch(
        0, ("l2 > x1 (sun)",), Fraction(3, 4), 2, tuple(FamilyTrain(at, Fraction(3, 8), {"x1": at}) for at in (1, 2))
    ),
    FamilyBranch(0, ("l1 > x1 (sun)",), Fraction(1, 4), 1, (FamilyTrain(3, Fraction(1, 4), {}),)),
)


def test_the_family_tree_is_told_in_lines() -> None:
    (section,) = family_section(TREE, turning=1)
    shown = to_markdown([Document("Trains", (), [section])])
    assert shown.splitlines()[6:11] == [
        "- b2 > l1: 100 %, 3 trains",
        "  - l2 > x1 (sun): 75 %, 2 trains",
        "    - 37.5 %, rank 1 with x1 1",
        "    - 37.5 %, rank 2 with x1 2",
        "  - l1 > x1 (sun): 25 %, rank 3",
    ]
    ends = section.branches[0].below[0].below
    assert isinstance(ends[0].text, SceneText)
    assert not isinstance(ends[1].text, SceneText)
    assert list(family_section(())) == []


def test_a_wide_family_is_cut_and_says_what_is_left_out() -> None:
    light = [
        FamilyBranch(0, (f"i > x{at}",), Fraction(1, 100), 1, (FamilyTrain(at, Fraction(1, 100), {}),))
        for at in range(100)
    ]
    (section,) = family_section([FamilyBranch(None, (), Fraction(1), 100, ()), *light])
    below = section.branches[0].below
    assert len(below) == 60
    assert below[-1].text == "41 lighter branches: 41 %, 41 trains"
    many = FamilyBranch(
        None, ("i > x1",), Fraction(1), 9, tuple(FamilyTrain(at, Fraction(1, 9), {}) for at in range(1, 10))
    )
    (section,) = family_section([many])
    assert [branch.text for branch in section.branches[0].below][-1] == "3 more"


BRANCHES = [Branch("stem", [Branch(EVIL, [Branch(SceneText("end", 2))]), Branch("other")])]
DOCUMENT = Document("Title", (), [Section("Tree", ["Said."], branches=BRANCHES)])


def test_a_tree_is_a_list_of_lists_in_markdown() -> None:
    text = to_markdown([DOCUMENT])
    assert "- stem\n  - &lt;script>alert(1)&lt;/script>\n    - end\n  - other\n\n" in f"{text}\n"


def test_a_tree_is_joined_by_strokes_on_a_terminal() -> None:
    out = StringIO()
    to_terminal([DOCUMENT], Console(file=out, width=80))
    lines = [line.rstrip() for line in out.getvalue().splitlines()]
    assert lines[4:8] == ["stem", f"├── {EVIL}", "│   └── end", "└── other"]


def test_a_tree_on_a_page_is_escaped_and_its_scenes_are_marked() -> None:
    pytest.importorskip("jinja2")
    page = to_html([DOCUMENT])
    assert EVIL not in page
    assert '<span data-scene="2">end</span>' in page
    assert page.count("<ul>") == page.count("</ul>")
    assert page.count("<li>") == page.count("</li>")
