"""The search of reconstructions against plain growth of concrete trees, on small questions of all kinds.

Plain growth itself is held against counts by hand here, and against other programs in `test_reconstruction_counts`.
"""

from __future__ import annotations

import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest
from concrete_trees import (
    Found,
    concrete,
    exact_dial,
    explanations,
    meshes,
    plain_prior,
    random_problem,
    sure_arbor,
    with_rings,
)
from sampling import first_few

from geartrain.search.reconstruct import (
    Additions,
    Arbor,
    PlacedWheel,
    ReconstructionProblem,
    SurvivingArbor,
    find_reconstructions,
)


def grown_alike(problem: ReconstructionProblem, seed: int) -> tuple[Found, ...]:
    """Hold what is found against plain growth, which is given back."""
    found = find_reconstructions(problem, listed=20_000)
    right = explanations(problem)
    assert found.complete
    assert [tuple(count.to_dict().values()) for count in found.counts] == [each.counts for each in right], seed
    trees = [(one.added, concrete(one.arbor)) for one in found.candidates]
    assert len(set(trees)) == len(trees)
    assert set(trees) == {(each.counts.added, tree) for each in right for tree in each.solutions}, seed
    weights = {tree: plain_prior(tree, problem) for _, tree in trees}
    alike, whole = Counter(weights.values()), sum(weights.values())
    for one, (_, tree) in zip(found.candidates, trees, strict=True):
        heavier = sum(number for weight, number in alike.items() if weight > weights[tree])
        assert one.ranks == (heavier + 1, heavier + alike[weights[tree]])
        assert one.weight == pytest.approx(float(weights[tree] / whole))
    return right


def test_the_one_of_the_first_toy() -> None:
    """20/30 * 15/10 = 1."""
    question = ReconstructionProblem(
        sure_arbor("in", i=20), (sure_arbor("a", a1=30, a2=15),), (exact_dial("P", 1),), Additions(3, 10, 16)
    )
    pointer = ("", ("", 10), ("P",), ())
    only = ("in", (), (), ((("i", 20), (("a", ("a1", 30), (), ((("a2", 15), (pointer,)),)),)),))
    assert explanations(question)[1].solutions == {only}
    shown = Arbor(None, PlacedWheel(None, 10), ("P",), ())
    between = Arbor("a", PlacedWheel("a1", 30), (), ((PlacedWheel("a2", 15), (shown,)),))
    assert concrete(Arbor("in", None, (), ((PlacedWheel("i", 20), (between,)),))) == only


def test_a_ring_keeps_the_sense_and_holds_smaller_wheels_alone() -> None:
    """20 > x, y > 24 (a ring), 12 > z or 20 > 24, 12 > x, y > z: both turn by 10 y / (x z), forward."""
    counts = range(10, 31)
    ring = SurvivingArbor("a", (replace(sure_arbor("a", R=24).wheels[0], internal=True), *sure_arbor("a", s=12).wheels))
    question = ReconstructionProblem(
        sure_arbor("in", i=20), (ring,), (exact_dial("P", "1/2", place="new"),), Additions(3, 10, 30)
    )
    fitting = [y for x, y, z in product(counts, repeat=3) if x * z == 20 * y]
    outside = sum(y < 24 for y in fitting)
    assert (outside, len(fitting)) == (51, 71)
    right = [each.counts.solutions for each in grown_alike(question, 0)]
    assert right == [0, 0, 0, outside + len(fitting)]
    back = replace(question, dials=(exact_dial("P", "-1/2", place="new"),))
    assert [each.counts.solutions for each in grown_alike(back, 0)] == [0, 1, 0, 0]


def test_most_random_questions_have_answers() -> None:
    answered = [any(each.solutions for each in explanations(random_problem(seed))) for seed in range(40)]
    assert sum(answered) > 20


@pytest.mark.parametrize("start", first_few(4, [20, 40, 60, 100, 80, *range(120, 200, 20), 0]))
def test_small_questions_have_the_answers_of_plain_growth(start: int) -> None:
    for seed in range(start, start + 20):
        grown_alike(random_problem(seed, idlers=True), seed)


@pytest.mark.parametrize("start", first_few(2, range(1000, 1160, 20)))
def test_small_questions_with_rings_have_the_answers_of_plain_growth(start: int) -> None:
    turning = 0
    for seed in range(start, start + 20):
        problem = with_rings(random_problem(seed, idlers=True), seed)
        for found in grown_alike(problem, seed):
            turning += any(
                problem.rings & {name for pair in meshes(one) for name, _ in pair} for one in found.solutions
            )
    assert turning


# ----------------------------------------------------------------------------------------- exact dials, counts in doubt


def exact_problem(seed: int) -> ReconstructionProblem:
    """A random question whose dials are exact, with a wheel more in doubt."""
    problem, chance = random_problem(seed), random.Random(seed)
    middles = [(dial.minimum + dial.maximum) / 2 for dial in problem.dials]
    dials = tuple(replace(dial, minimum=at, maximum=at) for dial, at in zip(problem.dials, middles, strict=True))
    if not problem.arbors:
        return replace(problem, dials=dials)
    arbors = list(problem.arbors)
    at = chance.randrange(len(arbors))
    (first, *others) = arbors[at].wheels
    teeth = sorted({first.counts[0][0], first.counts[0][0] + 1, *(count for count, _ in first.counts)})
    doubted = replace(first, counts=tuple((count, Fraction(1, len(teeth))) for count in teeth))
    arbors[at] = replace(arbors[at], wheels=(doubted, *others))
    return replace(problem, dials=dials, arbors=tuple(arbors))


@pytest.mark.parametrize("first", first_few(2, [2000, 2060, 2020, 2040, 2080, 2100]))
def test_exact_questions_have_the_answers_of_plain_growth(first: int) -> None:
    right = [grown_alike(exact_problem(seed), seed) for seed in range(first, first + 20)]
    assert sum(any(each.solutions for each in found) for found in right) > 5


@pytest.mark.parametrize(
    ("name", "value", "first"),
    [
        ("added_counts.ROUNDING", 0.05, 2000),  # many quotients seem to agree
        ("path_lists._PIECE", 3, 2020),
    ],
)
def test_no_answer_depends_on_keys_or_on_how_many_paths_are_grown_at_once(
    name: str, value: object, first: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"geartrain.search.reconstruct.{name}", value)
    for seed in range(first, first + 20):
        grown_alike(exact_problem(seed), seed)


# ------------------------------------------------------------------------------------------------ meshes that were seen


def seen(problem: ReconstructionProblem, seed: int) -> ReconstructionProblem | None:
    """The question with the meshes of survivors that one of its explanations has; None where there are none."""
    chance = random.Random(seed)
    trees = [tree for each in explanations(problem) for tree in sorted(each.solutions)]
    if not trees:
        return None
    pairs = {frozenset((one[0], other[0])) for one, other in meshes(chance.choice(trees))}
    known = frozenset(pair for pair in pairs if "" not in pair)
    some = frozenset(pair for pair in known if chance.random() < 0.9)
    return replace(problem, meshes=some, apart=frozenset()) if some else None


@pytest.mark.parametrize(
    ("idlers", "rings", "minimum"),
    [(False, False, 15), pytest.param(True, False, 15, marks=pytest.mark.slow), (False, True, 2)],
)
def test_questions_of_which_meshes_were_seen_have_the_answers_of_plain_growth(
    idlers: bool, rings: bool, minimum: int
) -> None:
    requested = 0
    for seed in range(4000, 4100):
        problem = random_problem(seed, wheels=1, idlers=idlers)
        problem = seen(with_rings(problem, seed) if rings else problem, seed)
        if problem is not None:
            requested += 2 * len(problem.meshes) > len(problem.arbors)
            grown_alike(problem, seed)
    assert requested > minimum
