"""Measured modules, radii and places of axes weigh candidates as hand, plain minimisation and plain trials say."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

import pytest
from concrete_trees import random_problem
from places import TRAINS

from geartrain import GearTrainError
from geartrain.errors import QuestionError
from geartrain.search.reconstruct import (
    Arbor,
    Candidate,
    PlacedWheel,
    candidate_train,
    evidence_question,
    find_reconstructions,
    read_evidence,
)
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import (
    MeasuredWheel,
    PlacedArbor,
    SurvivingGeometry,
    find_unreachable,
)
from geartrain.train import Train

P, V, W, X = PlacedWheel("p", 20), PlacedWheel("v", 30), PlacedWheel("w", 40), PlacedWheel("x", 60)


def modules(**of: str) -> tuple[MeasuredWheel, ...]:
    return tuple(MeasuredWheel(name, True, Fraction(module)) for name, module in of.items())


def places(**of: tuple[int, int]) -> tuple[PlacedArbor, ...]:
    return tuple(PlacedArbor(name, (Fraction(x), Fraction(y))) for name, (x, y) in of.items())


def leaf(name: str | None, driven: PlacedWheel) -> Arbor:
    return Arbor(name, driven, (), ())


def pair(below: Arbor | None = None) -> Arbor:
    """p of a drives v of b, whose w drives what is below."""
    drives = () if below is None else ((W, (below,)),)
    return Arbor("a", None, (), ((P, (Arbor("b", V, (), drives),)),))


def shared(driver: PlacedWheel, *arbors: Arbor) -> Arbor:
    return Arbor("a", None, (), ((driver, arbors),))


# modules


SPREAD = {"module": Fraction(1, 20)}
RADIUS = MeasuredWheel("v", False, Fraction("15.75"))
ADDED = PlacedWheel(None, 20)
APART = Arbor("a", None, (), ((ADDED, (leaf("b", V),)), (ADDED, (leaf("c", X),))))
WEIGHTS: dict[str, tuple[Arbor, SurvivingGeometry, float]] = {
    "nothing measured": (pair(), SurvivingGeometry(), 1),
    # ln 1.05 = 0.04879, (0.04879/0.05)^2 / 2 = 0.4761
    "modules of a mesh": (pair(), SurvivingGeometry(modules(p="1", v="1.05"), **SPREAD), 0.62120),
    # 15.75 mm of 30 teeth: module 1.05
    "a radius gives the module": (pair(), SurvivingGeometry((*modules(p="1"), RADIUS), **SPREAD), 0.62120),
    "wheels of one arbor may differ": (pair(leaf("c", X)), SurvivingGeometry(modules(v="1", w="2"), **SPREAD), 1),
    # the added wheel has the module between 1 and 1.1: each is off by ln(1.1)/2 = 0.04766, 0.04766^2 / 0.05^2 = 0.9084
    "an added wheel has one module": (
        shared(ADDED, leaf("b", V), leaf("c", X)),
        SurvivingGeometry(modules(v="1", x="1.1"), **SPREAD),
        0.40317,
    ),
    "two added wheels have two": (APART, SurvivingGeometry(modules(v="1", x="1.1"), **SPREAD), 1),
    # it is 1, its mates 1.05 and 1/1.05: both are off by ln 1.05
    "a measured wheel does not move": (
        shared(P, leaf("b", V), leaf("c", X)),
        SurvivingGeometry(modules(p="1", v="1.05", x="20/21"), **SPREAD),
        0.62120**2,
    ),
    # radii 10 and 15.75 with an error of 0.5: e = 0.04879 has the variance 0.05^2 + 0.05^2 + 0.031746^2
    "small wheels are measured worse": (
        pair(),
        SurvivingGeometry(modules(p="1", v="1.05"), radius=Fraction(1, 2), **SPREAD),
        math.exp(-(0.04879016**2) / 0.00600781 / 2),
    ),
    "arbors in one place do not mesh": (pair(), SurvivingGeometry(arbors=places(a=(3, 4), b=(3, 4))), 0),
}


@pytest.mark.parametrize("case", WEIGHTS)
def test_a_candidate_weighs_what_a_calculator_says(case: str) -> None:
    arbor, geometry, weight = WEIGHTS[case]
    assert candidate_likelihood(arbor, geometry) == pytest.approx(weight, abs=1e-5)


@pytest.mark.parametrize("seed", range(20))
def test_modules_that_were_not_measured_are_the_best(seed: int) -> None:
    """Trees of wheels joined by idlers, against descent one wheel at a time."""
    dice = random.Random(seed)
    edges: list[tuple[int, int]] = []
    logs: dict[int, float] = {}
    count = 0

    def wheel() -> tuple[int, PlacedWheel]:
        nonlocal count
        count += 1
        name = f"w{count}"
        if dice.random() < 0.5:
            logs[count] = math.log(dice.choice((90, 95, 100, 107)) / 100)
        return count, PlacedWheel(name, 20)

    def grow(parent: int, depth: int) -> Arbor:
        number, own = wheel()
        edges.append((parent, number))
        passes = tuple(grow(number, depth - 1) for _ in range(dice.randint(0, 3) if depth else 0))
        return Arbor(f"arbor{number}", own, (), (), passes)

    first, root = wheel()
    arbor = Arbor("a", None, (), ((root, tuple(grow(first, 2) for _ in range(3))),))
    measured = tuple(
        MeasuredWheel(f"w{number}", True, Fraction(round(100 * math.exp(log)), 100)) for number, log in logs.items()
    )
    found = candidate_likelihood(arbor, SurvivingGeometry(measured, module=Fraction(1, 20)))
    at = {number: logs.get(number, 0.0) for number in range(1, count + 1)}
    for _ in range(3000):
        for number in at.keys() - logs.keys():
            mates = [at[b if a == number else a] for a, b in edges if number in (a, b)]
            at[number] = sum(mates) / len(mates)
    misfit = sum((at[a] - at[b]) ** 2 for a, b in edges)
    assert found == pytest.approx(math.exp(-misfit / 0.05**2 / 2), rel=1e-6)


def test_a_wheel_that_is_measured_badly_takes_the_side_of_its_mates() -> None:
    """The middle one of 1, 1.05, 1 is measured once and not twice: the least of x^2/v + 2 (d - x)^2/s^2."""
    radius = Fraction(1, 2)
    geometry = SurvivingGeometry(modules(p="1.05", v="1", x="1"), module=Fraction(1, 20), radius=radius)
    found = candidate_likelihood(shared(P, leaf("b", V), leaf("c", X)), geometry)
    d, errors = math.log(1.05), (0.5 / 10.5, 0.5 / 15, 0.5 / 30)

    def misfit(x: float) -> float:
        far = [(d - x) ** 2 / (0.05**2 + error**2) for error in errors[1:]]
        return (x / errors[0]) ** 2 + sum(far)

    minimum = min(misfit(step * 1e-6) for step in range(50_000))
    assert found == pytest.approx(math.exp(-minimum / 2), rel=1e-6)


# distances


def test_a_distance_is_weighed_and_bounded() -> None:
    """Radii 10 and 15 at 26 mm: ln(25/26) = -0.03922, (0.03922/0.03)^2 / 2 = 0.8546; its weight 0.4255."""
    measured, arbors = modules(p="1", v="1"), places(a=(0, 0), b=(10, 24))
    assert candidate_likelihood(pair(), SurvivingGeometry(measured, arbors)) == pytest.approx(0.4255, abs=1e-4)
    within = SurvivingGeometry(measured, arbors, reach=Fraction(1))
    assert candidate_likelihood(pair(), within) == pytest.approx(0.4255, abs=1e-4)
    assert candidate_likelihood(pair(), SurvivingGeometry(measured, arbors, reach=Fraction("0.999"))) == 0


def test_one_measured_wheel_says_the_module_of_both() -> None:
    """Module 1 of 20 teeth with a mate of 30: 25 mm again; three spreads of 4.3 % of its 15 mm are 1.935 mm."""
    arbors = places(a=(0, 0), b=(28, 0))
    free = SurvivingGeometry(modules(p="1"), arbors)
    assert candidate_likelihood(pair(), free) == pytest.approx(math.exp(-((math.log(25 / 28) / 0.03) ** 2) / 2))
    assert candidate_likelihood(pair(), SurvivingGeometry(modules(p="1"), arbors, reach=Fraction("1.064"))) == 0
    assert candidate_likelihood(pair(), SurvivingGeometry(modules(p="1"), arbors, reach=Fraction("1.066"))) > 0


def test_what_is_only_improbable_is_not_impossible() -> None:
    geometry = SurvivingGeometry(modules(p="1", v="9"), module=Fraction(1, 1000))
    assert 0 < candidate_likelihood(pair(), geometry) < 1e-300


# pruning


@pytest.mark.parametrize("seeds", [range(10), pytest.param(range(10, 40), marks=pytest.mark.slow)])
def test_pairs_kept_apart_lose_no_possible_candidate(seeds: range) -> None:
    """Random questions with random places: what is possible is the same with the pairs and without."""
    refused = possible = 0
    for seed in seeds:
        dice = random.Random(seed)
        problem = random_problem(seed, idlers=True)
        arbors = (problem.input, *problem.arbors)
        placed = [arbor for arbor in arbors if dice.random() < 0.8]
        sized = [wheel for arbor in arbors for wheel in arbor.wheels if dice.random() < 0.8]
        geometry = SurvivingGeometry(
            modules(**{wheel.name: dice.choice(("0.9", "1", "1.1")) for wheel in sized}),
            places(**{arbor.name: (dice.randint(0, 30), dice.randint(0, 30)) for arbor in placed}),
            reach=Fraction(dice.randint(2, 10)),
        )
        apart = problem.apart | frozenset(find_unreachable(arbors, geometry))
        try:
            every = find_reconstructions(problem, listed=20_000).candidates
            fewer = find_reconstructions(replace(problem, apart=apart), listed=20_000).candidates
        except QuestionError:
            continue
        able = [one.arbor for one in every if candidate_likelihood(one.arbor, geometry)]
        assert {*able} == {one.arbor for one in fewer if candidate_likelihood(one.arbor, geometry)}, seed
        refused += len(every) - len(able)
        possible += len(able)
    assert min(refused, possible) > 2


# from evidence

EVIDENCE = """\
links:
  frame: {}
  a: {wheels: {p: {teeth: 20, module: 1 mm}}}
  b: {wheels: {v: {teeth: {value: 30, range: [30, 32]}, module: 1 mm}, w: 40}}
  c: {wheels: {x: 60}}
axes: {A: {position: [0 mm, 0 mm, 5 mm]}, B: {position: [0 mm, 2.5 cm, 0 mm]}, C: {position: [0 mm, 80 mm, 0 mm]}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
inputs: {a: 1}
outputs: {sun: {expect: 1/3}}
reconstruct:
  add: {wheels: 2, teeth: [10, 20]}
  geometry: {module: 5 %, reach: 1 mm, radii: {x: 31 mm}}
"""


def test_geometry_of_evidence() -> None:
    question = evidence_question(read_evidence(EVIDENCE))
    geometry = question.problem.geometry
    assert (geometry.module, geometry.distance, geometry.reach) == (Fraction(1, 20), Fraction(3, 100), 1)
    assert geometry.module_of(PlacedWheel("x", 62)) == geometry.module_of(PlacedWheel("v", 31)) == 1
    assert geometry.square_distance("b", "c") == 55**2
    assert not question.unused


def test_wheels_that_cannot_reach_each_other_are_kept_apart() -> None:
    """p meshes v at 25 mm if it has 30 to 32 teeth; all that x reaches is 41 mm, 46 mm and, with w, 51 to 53.58 mm."""
    problem = evidence_question(read_evidence(EVIDENCE)).problem
    assert problem.apart == {frozenset(pair) for pair in ("px", "vx", "wp")}
    nearer = EVIDENCE.replace("[0 mm, 80 mm", "[0 mm, 71 mm")  # c stands 46 mm from b
    assert frozenset("vx") not in evidence_question(read_evidence(nearer)).problem.apart


def test_axes_of_one_place_are_one() -> None:
    text = EVIDENCE.replace("[0 mm, 80 mm, 0 mm]", "[0 mm, 25 mm, 7 mm]")
    assert frozenset("bc") in evidence_question(read_evidence(text)).problem.coaxial


def test_without_being_requested_for_geometry_backlashes_no_part() -> None:
    text = "\n".join(line for line in EVIDENCE.splitlines() if "geometry" not in line)
    question = evidence_question(read_evidence(text))
    assert question.problem.geometry == SurvivingGeometry()
    assert not question.problem.apart
    assert len(question.unused) == 5


# the back train of the Antikythera mechanism

MODULES = {"b2": 0.479, "l1": 0.455, "l2": 0.487, "m1": 0.503, "m2": 0.514, "e3": 0.466, "e4": 0.526}
MODULES |= {"f1": 0.499, "f2": 0.522, "g1": 0.513}
FOUR = [
    {("l1", "b2"), ("m1", "l2"), ("f1", "e4"), ("g1", "f2")},  # that of 2006
    {("l1", "b2"), ("m1", "l2"), ("e3", "f2"), ("g1", "e4")},
    {("l1", "b2"), ("f1", "l2"), ("m1", "e4"), ("g1", "m2")},
    {("l1", "b2"), ("f1", "l2"), ("e3", "m2"), ("g1", "e4")},
]
"""Meshes of surviving wheels, the driven one first, of the four trains with two added wheels."""


def meshes_of(evidence: Train, candidate: Candidate) -> list[tuple[str, str]]:
    """Driving and driven wheel, mesh by mesh."""
    return [gear.pair for gear in candidate_train(evidence, candidate.arbor, "one").gears]


PLACES = {"b": 0, "l": 24, "m": 61, "E": 119, "f": 182, "g": 204}
"""Along a line (mm), rounded, as the train of 2006 would have them with the measured modules."""


@pytest.mark.parametrize(
    ("spreads", "shares", "room"),
    [
        # the arrangement of E is decided at nine to one, and hardly whether l drives m or f
        ("module: 4.4 %", [0.366, 0.025, 0.544, 0.065], 1e-3),
        ("module: 3 %, radius: 0.15 mm", [0.293, 0.006, 0.546, 0.155], 0.01),
        ("module: 1/10000, radius: 0.3 mm", [0.159, 0.016, 0.018, 0.807], 0.01),
    ],
)
def test_which_train_modules_prefer_hangs_on_how_their_errors_are_spread(
    spreads: str, shares: list[float], room: float
) -> None:
    """If radii alone are off, the last of the four is the best; shares by a calculator, from the modules by hand."""
    text = (TRAINS / "evidence" / "back-train-modules.yaml").read_text(encoding="utf-8")
    evidence = read_evidence(text.replace("module: 4.4 %", spreads))
    problem = evidence_question(evidence).problem
    weights = {}
    for candidate in find_reconstructions(problem, listed=20_000).candidates:
        pairs = {pair[::-1] for pair in meshes_of(evidence, candidate)}
        at = next(at for at, meshes in enumerate(FOUR) if meshes <= pairs)
        weights[at] = candidate_likelihood(candidate.arbor, problem.geometry)
    assert [weights[at] / sum(weights.values()) for at in range(4)] == pytest.approx(shares, abs=room)


def test_places_of_axes_would_single_it_out() -> None:
    """No measured places: they are made for the train of 2006, and show that the others could not stand there."""
    text = (TRAINS / "evidence" / "back-train-modules.yaml").read_text(encoding="utf-8")
    text = text.replace("geometry: {module: 4.4 %}", "geometry: {module: 4.4 %, reach: 2 mm}")
    text += f"axes: {{{', '.join(f'{name}: {{position: [{x} mm, 0 mm, 0 mm]}}' for name, x in PLACES.items())}}}\n"
    text += f"revolutes: [{', '.join(f'{{pair: [frame, {name}], axis: {name}}}' for name in PLACES)}]\n"
    evidence = read_evidence(text)
    problem = evidence_question(evidence).problem
    (only,) = find_reconstructions(problem, listed=20_000).candidates
    assert {pair[::-1] for pair in meshes_of(evidence, only)} >= FOUR[0]
    assert candidate_likelihood(only.arbor, problem.geometry) > 0
    teeth = {name: wheel.count for name, (_, wheel) in evidence.wheels.items()}
    arbors = {name: link for name, (link, _) in evidence.wheels.items()}
    for one, other in combinations(MODULES, 2):
        gap = abs(PLACES[arbors[one]] - PLACES[arbors[other]])
        misfit = gap - (MODULES[one] * teeth[one] + MODULES[other] * teeth[other]) / 2
        assert (frozenset((one, other)) in problem.apart) == (abs(misfit) > 2 and gap > 0), (one, other)


MISTAKES = {
    "a radius of no wheel": (EVIDENCE.replace("{x: 31 mm}", "{y: 31 mm}"), "'y'"),
    "a radius and a module": (
        EVIDENCE.replace("{x: 31 mm}", "{v: 15 mm}"),
        "both a module and a pitch radius are given for 'v'",
    ),
    "no reach": (EVIDENCE.replace("reach: 1 mm", "reach: 0 mm"), "must be greater than 0"),
    "a spread of nothing": (EVIDENCE.replace("5 %", "0 %"), "must be greater than 0"),
    "a module of nothing": (EVIDENCE.replace("module: 1 mm}}}", "module: 0 mm}}}"), "must be greater than 0"),
    "a mesh that cannot be": (EVIDENCE + "gears: [{pair: [v, x]}]\n", "the known mesh 'v~x' is impossible"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told(mistake: str) -> None:
    text, words = MISTAKES[mistake]
    with pytest.raises(GearTrainError, match=words):
        evidence_question(read_evidence(text))
