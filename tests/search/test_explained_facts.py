"""Marginals, the next fact to look for and the family tree: of candidates made by hand, and of random questions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import log2

import pytest
from concrete_trees import (
    ADDED,
    concrete,
    declared,
    explanations,
    meshes,
    nodes,
    package_arbor,
    plain_prior,
    random_problem,
    sections,
    with_rings,
)
from sampling import all_but, first_few

from geartrain.report import Document, Section, to_markdown
from geartrain.search.reconstruct import (
    Additions,
    Arbor,
    Candidate,
    CandidateFindings,
    ExplanationCount,
    PlacedWheel,
    RankedTrain,
    ReconstructionAnswer,
    ReconstructionProblem,
    Reconstructions,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
    evidence_question,
    find_facts,
    find_reconstructions,
    read_evidence,
)


def survivor(name: str, **counts: tuple[int, ...]) -> SurvivingArbor:
    wheels = (
        SurvivingWheel(wheel, tuple((count, Fraction(1, len(teeth))) for count in teeth))
        for wheel, teeth in counts.items()
    )
    return SurvivingArbor(name, tuple(wheels))


PROBLEM = ReconstructionProblem(
    survivor("in", i=(10,)),
    (survivor("a", a1=(20,), a2=(30,)), survivor("c", c1=(40, 41), c2=(15,))),
    (SearchedDial("sun", Fraction(1), Fraction(1)),),
    Additions(2, 10, 60),
    use="some",
)


def sun(teeth: int) -> Arbor:
    return Arbor(None, PlacedWheel(None, teeth), ("sun",), ())


def arbor(name: str, driven: tuple[str, int], driving: tuple[str, int], below: Arbor) -> Arbor:
    return Arbor(name, PlacedWheel(*driven), (), ((PlacedWheel(*driving), (below,)),))


def whole(first: Arbor) -> Arbor:
    return Arbor("in", None, (), ((PlacedWheel("i", 10), (first,)),))


def through_a_and_c(count: int, last: int) -> Arbor:
    return whole(arbor("a", ("a1", 20), ("a2", 30), arbor("c", ("c1", count), ("c2", 15), sun(last))))


FOUR = (
    through_a_and_c(40, 53),
    through_a_and_c(41, 53),
    whole(arbor("c", ("c1", 40), ("c2", 15), arbor("a", ("a1", 20), ("a2", 30), sun(53)))),
    whole(arbor("a", ("a2", 30), ("a1", 20), sun(50))),
)


def findings(problem: ReconstructionProblem, arbors: Sequence[Arbor], weights: Sequence[float]) -> CandidateFindings:
    """What is said of candidates of these weights, whatever the search would say that they weigh."""
    listed = (Candidate(one, 0, weight, (1, 1)) for one, weight in zip(arbors, weights, strict=True))
    return find_facts(declared(problem), problem, Reconstructions((), True, tuple(listed)))


FOUND = findings(PROBLEM, FOUR, [0.5, 0.25, 0.125, 0.125])
"""Weights 1/2, 1/4, 1/8, 1/8: in > a > c twice, in > c > a, and in > a the other way round without c."""


@pytest.mark.parametrize(
    ("kind", "subject", "answers"),
    [
        ("mesh", "i > a1", [("yes", "3/4", 2), ("no", "1/4", 2)]),
        ("mesh", "a2 > c1", [("yes", "3/4", 2), ("no", "1/4", 2)]),
        ("mesh", "c2 > new_sun1", [("yes", "3/4", 2), ("no", "1/4", 2)]),
        ("mesh", "a1 > new_sun1", [("no", "7/8", 3), ("yes", "1/8", 1)]),
        ("driver", "a", [("in", "7/8", 3), ("c", "1/8", 1)]),
        ("driver", "c", [("a", "3/4", 2), ("in", "1/8", 1), ("not in the train", "1/8", 1)]),
        ("pointer", "sun", [("an added arbor", "1", 4)]),
        ("count", "c1", [("40", "5/8", 2), ("41", "1/4", 1), ("not used", "1/8", 1)]),
        ("added", "new_sun1", [("53", "7/8", 3), ("50", "1/8", 1)]),
        ("needed", "53", [("yes", "7/8", 3), ("no", "1/8", 1)]),
        ("used", "c1", [("yes", "7/8", 3), ("no", "1/8", 1)]),
    ],
)
def test_marginals(kind: str, subject: str, answers: list[tuple[str, str, int]]) -> None:
    found = {(one.kind, one.subject): one for one in FOUND.marginals}
    told = [(answer.answer, answer.share, answer.solutions) for answer in found[kind, subject].answers]
    assert told == [(answer, Fraction(share), count) for answer, share, count in answers]
    assert found[kind, subject].bits == pytest.approx(bits(*(float(Fraction(share)) for _, share, _ in answers)))


def test_what_all_agree_in_is_first_and_wheels_that_all_use_are_left_out() -> None:
    found = FOUND.marginals
    assert [one.subject for one in found if one.kind == "used"] == ["c1", "c2"]
    meshes = [one for one in found if one.kind == "mesh"]
    assert [one.share("yes") for one in meshes] == sorted((one.share("yes") for one in meshes), reverse=True)
    assert {one.kind for one in found} == {"mesh", "driver", "pointer", "count", "added", "needed", "used"}
    unused = [one for one in findings(PROBLEM, FOUR[3:], [1]).marginals if one.kind == "used"]
    assert [(one.subject, one.share("no")) for one in unused] == [("c1", 1), ("c2", 1)]


def bits(*shares: float) -> float:
    return -sum(share * log2(share) for share in shares)


def test_the_most_telling_fact_is_first_and_those_that_divide_alike_stand_together() -> None:
    found = FOUND.next_facts
    assert [(one.fact.kind, one.fact.subject) for one in found] == [
        ("count", "c1"),
        ("driver", "c"),
        ("pair", "a1 and i"),
        ("pair", "a1 and c2"),
        ("pair", "a2 and i"),
    ]
    assert [one.fact.bits for one in found] == pytest.approx(
        [
            bits(5 / 8, 1 / 4, 1 / 8),
            bits(3 / 4, 1 / 8, 1 / 8),
            bits(3 / 4, 1 / 4),
            bits(7 / 8, 1 / 8),
            bits(7 / 8, 1 / 8),
        ]
    )
    assert found[2].same == (("pair", "a2 and c1"),)
    assert ("driver", "a") in found[3].same
    assert ("added", "new_sun1") in found[4].same
    assert findings(PROBLEM, FOUR[:1], [1]).next_facts == (), "one candidate leaves nothing to look for"


def test_the_family_tree() -> None:
    tree = FOUND.family
    told = [(one.parent, one.meshes, one.share, one.solutions) for one in tree]
    assert told == [
        (None, (), 1, 4),
        (0, ("i > a1", "a2 > c1", "c2 > new_sun1 (sun)"), Fraction(3, 4), 2),
        (0, ("i > c1", "c2 > a1", "a2 > new_sun1 (sun)"), Fraction(1, 8), 1),
        (0, ("i > a2", "a1 > new_sun1 (sun)"), Fraction(1, 8), 1),
    ]
    ends = [[(train.rank, list(train.counts.items())) for train in one.trains] for one in tree]
    assert ends == [
        [],
        [(1, [("new_sun1", 53), ("c1", 40)]), (2, [("new_sun1", 53), ("c1", 41)])],
        [(3, [("new_sun1", 53), ("c1", 40)])],
        [(4, [("new_sun1", 50)])],
    ]


def test_a_stem_is_one_branch_and_no_candidates_have_no_tree() -> None:
    tree = findings(PROBLEM, (FOUR[0], through_a_and_c(40, 54)), [1, 1]).family
    assert [(one.parent, one.meshes) for one in tree] == [(None, ("i > a1", "a2 > c1", "c2 > new_sun1 (sun)"))]
    assert [train.counts for train in tree[0].trains] == [{"new_sun1": 53}, {"new_sun1": 54}]
    assert findings(PROBLEM, (), ()).family == ()


def sections_of(found: CandidateFindings) -> dict[str, Section]:
    answer = ReconstructionAnswer("toy", PROBLEM, (ExplanationCount(2, 4, 4, 4),), True, (), (), findings=found)
    return sections(answer)


def test_the_page_tells_what_is_shared_where_trains_differ_and_what_to_look_for() -> None:
    page = sections_of(FOUND)
    assert list(page["Facts common to all trains"].paragraphs) == ["Facts: the pointer of sun is on an added arbor."]
    meshes, answers, needed = (list(table.rows) for table in page["Facts that differ"].tables)
    assert meshes[:4] == [
        ("a2 > c1", "75 %", "2"),
        ("c2 > new_sun1", "75 %", "2"),
        ("i > a1", "75 %", "2"),
        ("a1 > new_sun1", "12.5 %", "1"),
    ]
    assert ("the count of c1", "40: 62.5 % (2), 41: 25 % (1), not used: 12.5 % (1)", "1.3") in answers
    assert needed == [("53", "87.5 %", "3"), ("50", "12.5 %", "1")]
    assert list(page["The next fact to look for"].tables[0].rows)[2:4] == [
        ("whether a1 and i mesh", "0.811", "yes: 75 % (2), no: 25 % (2)", "whether a2 and c1 mesh"),
        (
            "whether a1 and c2 mesh",
            "0.544",
            "no: 87.5 % (3), yes: 12.5 % (1)",
            "whether c1 and i mesh; which arbor drives a",
        ),
    ]
    shown = to_markdown([Document("Trains", (), [page["The family tree"]])])
    assert [line for line in shown.splitlines() if line.lstrip().startswith("- ")] == [
        "- the input: 100 %, 4 trains",
        "  - i > a1, a2 > c1, c2 > new_sun1 (sun): 75 %, 2 trains",
        "    - 50 %, rank 1 with new_sun1 53, c1 40",
        "    - 25 %, rank 2 with new_sun1 53, c1 41",
        "  - i > c1, c2 > a1, a2 > new_sun1 (sun): 12.5 %, rank 3 with new_sun1 53, c1 40",
        "  - i > a2, a1 > new_sun1 (sun): 12.5 %, rank 4 with new_sun1 50",
    ]


def test_what_all_share_is_told_in_sentences() -> None:
    page = sections_of(findings(PROBLEM, FOUR[:2], [1, 1]))
    meshes, needed, besides = page["Facts common to all trains"].paragraphs
    assert meshes == "Meshes: a2 > c1, c2 > new_sun1, i > a1."
    assert needed == "All trains add a wheel of 53."
    assert besides == "Further facts: the pointer of sun is on an added arbor; new_sun1 is added with 53 teeth."


def test_a_wide_family_is_cut_and_says_what_is_left_out() -> None:
    many = [whole(arbor("a", ("a1", 20), ("a2", 30), sun(teeth))) for teeth in range(10, 19)]
    (branch,) = sections_of(findings(PROBLEM, many, [1] * 9))["The family tree"].branches
    assert [each.text for each in branch.below][-1] == "3 more"


def test_a_page_shows_intervals_of_ranks_and_what_is_not_counted() -> None:
    counts = (ExplanationCount(0, 3, 2, 1), ExplanationCount(1, 999_999, None, None))
    best = tuple(
        RankedTrain(rank, ranks, 0, 0.25, {}, {}, ("a > b",)) for rank, ranks in ((1, (1, 1)), (2, (2, 3)), (3, (2, 3)))
    )
    page = sections(ReconstructionAnswer("some", PROBLEM, counts, True, (), best))
    assert page["Counts"].tables[0].rows[1] == ("1", "999999", "not counted", "not counted")
    assert [row[0] for row in page["Most probable trains"].tables[0].rows] == ["1", "2 (2-3)", "3 (2-3)"]


# ---- random questions, against concrete trees

Question = tuple[tuple[Candidate, ...], CandidateFindings, list[Fraction]]


@cache
def question(seed: int) -> Question:
    """Candidates of a random question, and what shares of 1, 2, 3, ... over their sum, not those of the search, say."""
    problem = random_problem(seed, idlers=True)
    found = find_reconstructions(problem).candidates
    weights = range(1, len(found) + 1)
    said = findings(problem, [one.arbor for one in found], weights)
    return found, said, [Fraction(weight, sum(weights)) for weight in weights]


SEEDS = [seed for seed in range(14, 60) if seed not in (28, 29, 50, 55)]  # which have no answer, or over 300


def test_most_random_questions_have_an_answer() -> None:
    assert [seed for seed in range(14, 60) if 0 < len(question(seed)[0]) <= 300] == SEEDS


@pytest.mark.parametrize("seed", SEEDS)
def test_bits_are_the_mean_of_what_each_answer_tells(seed: int) -> None:
    """By the weights of candidates one by one: what is known of them after each answer against before."""
    found, said, shares = question(seed)
    facts = said.next_facts
    assert [one.fact.bits for one in facts] == sorted((one.fact.bits for one in facts), reverse=True)
    for one in (each for each in facts if each.fact.kind == "pair"):
        pair = frozenset(one.fact.subject.split(" and "))
        holds = [
            pair in {frozenset((driving[0], driven[0])) for driving, driven in meshes(concrete(each.arbor))}
            for each in found
        ]
        expected = 0.0
        for answer in (True, False):
            part = [share for share, held in zip(shares, holds, strict=True) if held == answer]
            chance = sum(part)
            expected += float(chance) * sum(float(share / chance) * log2(1 / chance) for share in part)
        assert one.fact.bits == pytest.approx(expected)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_family_tree_holds_every_candidate_once(seed: int) -> None:
    found, said, shares = question(seed)
    tree = said.family
    ends = {train.rank: train.share for branch in tree for train in branch.trains}
    assert [ends[rank] for rank in range(1, len(found) + 1)] == shares
    assert sum(len(branch.trains) for branch in tree) == len(found)
    for at, branch in enumerate(tree):
        below = [other for other in tree if other.parent == at]
        assert branch.solutions == len(branch.trains) + sum(other.solutions for other in below)
        assert branch.share == sum(one.share for one in (*branch.trains, *below))
        assert len(below) != 1 or branch.trains, "a stem is one branch"
        assert len({other.meshes[0] for other in below}) == len(below)
    for branch in (branch for branch in tree if branch.trains):
        path = list(branch.meshes)
        at = branch.parent
        while at is not None:
            path = [*tree[at].meshes, *path]
            at = tree[at].parent
        for train in branch.trains:
            assert len([mesh for mesh in path if " > " in mesh]) == len(meshes(concrete(found[train.rank - 1].arbor)))


# ---- sums over all trains of random questions, against sums train by train and over concrete trees

Told = dict[tuple[str, str], dict[str, tuple[Fraction, int]]]


def questions(first: int, rings: bool) -> list[ReconstructionProblem]:
    plain = [random_problem(seed, idlers=True) for seed in range(first, first + 60)]
    return [with_rings(problem, seed) for seed, problem in enumerate(plain, first)] if rings else plain


def said(problem: ReconstructionProblem, summed: bool) -> Told:
    """What is said of all trains, by sums over topologies or train by train."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geartrain.search.reconstruct.explained_facts.MOST_SUMMED", 10**9 if summed else 0)
        found = find_facts(declared(problem), problem, find_reconstructions(problem, listed=20_000))
    facts = [*found.marginals, *(one.fact for one in found.next_facts)]
    return {(one.kind, one.subject): {a.answer: (a.share, a.solutions) for a in one.answers} for one in facts}


@pytest.mark.parametrize("rings", [False, True])
@pytest.mark.parametrize("first", first_few(1, [100, 160]))
def test_sums_are_those_over_all_trains(first: int, rings: bool) -> None:
    answered = 0
    for problem in questions(first, rings):
        found, expected = said(problem, summed=True), said(problem, summed=False)
        assert found.keys() == expected.keys()
        for key, answers in expected.items():
            assert found[key].keys() == answers.keys()
            for answer, (share, number) in answers.items():
                assert found[key][answer] == (pytest.approx(share, rel=1e-12), number)
        answered += bool(found)
    assert answered > (10 if rings else 40)


@pytest.mark.parametrize("first", all_but({220}, [220, 250]))
def test_sums_are_those_over_concrete_trees(first: int) -> None:
    """Meshes of survivors and counts that are needed, weighed by the table of the page."""
    for seed in range(first, first + 30):
        problem = random_problem(seed, idlers=True)
        found = said(problem, summed=True)
        trees = [tree for one in explanations(problem) for tree in one.solutions]
        weights = [plain_prior(tree, problem) for tree in trees]
        direct: dict[tuple[str, str], Fraction] = defaultdict(Fraction)
        for tree, weight in zip(trees, weights, strict=True):
            assert concrete(package_arbor(tree)) == tree
            for driving, driven in meshes(tree):
                if driving[0] and driven[0]:
                    direct["mesh", f"{driving[0]} > {driven[0]}"] += weight / sum(weights)
            added = {node[1][1] for node in nodes(tree) if node[1] and node[1][0] == ADDED}
            added |= {wheel[1] for node in nodes(tree) for wheel, _ in node[3] if wheel[0] == ADDED}
            for teeth in added:
                direct["needed", str(teeth)] += weight / sum(weights)
        survivors = {wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}
        told = {
            key: answers["yes"][0]
            for key, answers in found.items()
            if key[0] == "needed" or (key[0] == "mesh" and set(key[1].split(" > ")) <= survivors)
        }
        assert told == direct


@pytest.mark.parametrize(("most", "told"), [(10**6, 4), (3, 1)])
def test_facts_are_told_of_all_trains_unless_they_are_too_many(
    most: int, told: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One of the four trains of the back is listed."""
    evidence = read_evidence("back-train")
    problem = evidence_question(evidence).problem
    found = find_reconstructions(problem)
    monkeypatch.setattr("geartrain.search.reconstruct.explained_facts.MOST_SUMMED", most)
    findings = find_facts(evidence, problem, replace(found, candidates=found.candidates[:1]))
    assert findings.of_all == (told == 4)
    assert {one.trains for one in findings.marginals} == {told}
    assert (findings.listed, len(findings.family)) == (1, 1)
    report = ReconstructionAnswer("back", problem, found.counts, True, (), (), findings=findings)
    said = "computed over all trains." if told == 4 else "Shares are relative to them."
    assert sum(line.endswith(said) for line in str(report).splitlines()) == 1
