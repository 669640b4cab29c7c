"""The float path: its error, its estimate, its condition numbers, and many inputs at once."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import pytest
from test_large_trains import ten_thousand_cascade
from test_states import FREE_SET

from geartrain import GearTrain, GearTrainError, load
from geartrain.errors import RangeError

EPS = Fraction(1, 2**53)


def wolfrom(sun: int, planet: int, ring: int, planet_2: int, ring_2: int) -> GearTrain:
    """Sun in, first ring fixed, a compound planet, second ring out."""
    links: dict[str, Any] = {
        "frame": {"wheels": {"r1": {"teeth": ring, "internal": True}}},
        "sun": {"wheels": {"s": sun}},
        "arm": {},
        "out": {"wheels": {"r2": {"teeth": ring_2, "internal": True}}},
        "planet": {"wheels": {"p1": planet, "p2": planet_2}},
    }
    revolutes = [{"pair": ["frame", link], "axis": "main"} for link in ("sun", "arm", "out")]
    revolutes.append({"pair": ["arm", "planet"], "axis": "planet"})
    gears = [{"pair": ["s", "p1"]}, {"pair": ["p1", "r1"]}, {"pair": ["p2", "r2"]}]
    return GearTrain.declare({"links": links, "revolutes": revolutes, "gears": gears, "inputs": {"sun": 1}})


def wolfrom_ratio(sun: int, planet: int, ring: int, planet_2: int, ring_2: int) -> Fraction:
    """Output over input by hand: the arm makes s/(s + r1), and 1 - (r1/p1)(p2/r2) of that is left over."""
    return Fraction(sun, sun + ring) * (1 - Fraction(ring * planet_2, planet * ring_2))


STIFF = {
    f"ten thousand, {stages} times": (
        GearTrain.declare(ten_thousand_cascade(stages)), f"m{stages}", Fraction(1, 10 ** (4 * stages))
    )
    for stages in (1, 2, 3, 4)
}  # fmt: skip
STIFF["ten thousand with teeth that fill a float"] = (
    GearTrain.declare(ten_thousand_cascade(2, scale=9_876_543_211)), "m2", Fraction(1, 10**8)
)  # fmt: skip
for title, teeth in (("a million", (55, 233, 610, 144, 377)), ("Fibonacci", (55, 10946, 28657, 6765, 17711))):
    STIFF[f"Wolfrom of {title}"] = wolfrom(*teeth), "out", wolfrom_ratio(*teeth)


@pytest.mark.parametrize("name", STIFF)
def test_one_refinement_step_leaves_every_speed_within_a_rounding_of_the_exact_one(name: str) -> None:
    train, link, exact = STIFF[name]
    answer, floats = train.solve(), train.kinematics.floats()
    assert answer[link] == exact
    for other, speed in answer.speeds.items():
        off = abs(Fraction(floats[other]) - speed)
        assert off <= EPS * abs(speed)
        assert off <= Fraction(float(floats.estimate[other][0]))
    estimate = Fraction(float(floats.estimate[link][0]))
    assert estimate <= 8 * EPS * abs(exact), "an estimate that says nothing is no estimate"


# cond(A, x) of the output, as printed; the second Wolfrom loses eight digits though its matrix looks harmless
@pytest.mark.parametrize(
    ("name", "condition"),
    [
        ("ten thousand, 1 times", 8.0399e4),
        ("ten thousand, 2 times", 1.6e5),
        ("ten thousand, 3 times", 2.4119e5),
        ("ten thousand, 4 times", 3.2e5),
        ("Wolfrom of a million", 2.2e5),
        ("Wolfrom of Fibonacci", 4.8e8),
    ],
)
def test_condition_numbers_are_those_printed(name: str, condition: float) -> None:
    train, link, _ = STIFF[name]
    digits = 5e-5 if condition in (8.0399e4, 2.4119e5) else 0.025
    assert train.kinematics.floats().condition[link] == pytest.approx(condition, rel=digits)


TWO_INPUTS = FREE_SET.format(rest="inputs: {sun: 1, ring: 0}")


def test_many_inputs_at_once_are_each_solved() -> None:
    suns, rings = [1.0, 0.0, 7.0, -2.5], [0.0, 1.0, -7.0, 2.5]
    found = load(TWO_INPUTS).kinematics.floats(inputs={"sun": suns, "ring": rings})
    assert found.speeds.values.shape == (5, 4)
    for case, (sun, ring) in enumerate(zip(suns, rings, strict=True)):
        arm = (24 * Fraction(sun) + 60 * Fraction(ring)) / 84
        assert abs(Fraction(float(found.speeds["arm"][case])) - arm) <= EPS * abs(arm)
        assert found.speeds["frame"][case] == 0
        assert found.speeds["sun"][case] == sun


def test_results_are_read_only_and_labelled() -> None:
    found = load(TWO_INPUTS).kinematics.floats()
    with pytest.raises(ValueError, match="read-only"):
        found.speeds.values[0, 0] = 1
    assert found.speeds.axes == ("link", "case")
    with pytest.raises(KeyError, match="no link 'moon'"):
        found["moon"]


def test_one_output_is_solved_in_floats_too() -> None:
    train = load("pennestri-2002")
    answer = train.solve(output="8", method="floats")
    assert answer["8"] == 0.25
    assert answer.work < len(train.circuits)


@pytest.mark.parametrize("inputs", ["{}", "{sun: 1}", "{sun: 1, ring: 1, arm: 2}"])
def test_a_train_that_is_not_determined_has_no_float_solution(inputs: str) -> None:
    train = load(TWO_INPUTS.replace("{sun: 1, ring: 0}", inputs))
    with pytest.raises(GearTrainError):
        train.kinematics.floats()


def sets_between_shafts(seed: int) -> dict[str, Any]:
    """Planetary sets between some shafts and the case, drawn at random; shafts may stand still by cancellation."""
    count, draw = random.Random(seed).randint(3, 14), random.Random(seed)
    links: dict[str, Any] = {"frame": {"wheels": {}}} | {f"s{at}": {"wheels": {}} for at in range(count)}
    joints = [{"pair": ["frame", f"s{at}"], "axis": "main"} for at in range(count)]
    gears: list[list[str]] = []
    while len(gears) < 2 * (count - 1):
        first, second, carrier = (f"s{at}" for at in draw.sample(range(count), 3))
        first = "frame" if draw.random() < 0.25 else first
        second = "frame" if draw.random() < 0.1 else second
        if first == second:
            continue
        at = len(gears)
        planet, sun, further = (draw.randint(17, 60) for _ in range(3))
        links[f"p{at}"] = {"wheels": {f"u{at}": planet, f"v{at}": further}}
        links[first]["wheels"][f"a{at}"] = sun
        ring = {"teeth": draw.randint(60, 150), "internal": True} if draw.random() < 0.5 else draw.randint(17, 60)
        links[second]["wheels"][f"b{at}"] = ring
        joints.append({"pair": [carrier, f"p{at}"], "axis": f"P{at}"})
        gears += [[f"a{at}", f"u{at}"], [f"v{at}", f"b{at}"]]
    return {"links": links, "revolutes": joints, "gears": [{"pair": pair} for pair in gears], "inputs": {"s0": 1}}


FAILED = (42, 641)  # a shaft at rest, off by more than an estimate that errors of one sign alone had made


@pytest.fixture(scope="module")
def determined_sets(request: pytest.FixtureRequest) -> list[tuple[int, GearTrain, dict[str, Fraction]]]:
    """Those of 250 seeds (700 with `--slow`) whose speeds are determined, with the exact speeds."""
    seeds = dict.fromkeys((*FAILED, *range(700 if request.config.getoption("--slow") else 250)))
    drawn = ((seed, GearTrain.declare(sets_between_shafts(seed))) for seed in seeds)
    solved = ((seed, train, train.solve()) for seed, train in drawn)
    return [(seed, train, dict(answer.speeds)) for seed, train, answer in solved if answer.verdict]


@pytest.mark.parametrize("inverted", [400, 0], ids=["by the inverse", "by random signs"])
def test_no_speed_is_farther_off_than_its_estimate(
    inverted: int, determined_sets: list[tuple[int, GearTrain, dict[str, Fraction]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a speed is 0 because great ones cancel, and what is left of it is nothing but rounding."""
    monkeypatch.setattr("geartrain.kinematics.speeds.float_speeds._INVERTED", inverted)
    judged = still = 0
    for seed, train, truth in determined_sets:
        floats = train.solve(method="floats")
        judged += 1
        for link, speed in floats.speeds.items():
            off = abs(Fraction(speed) - truth[link])
            assert off <= Fraction(floats.accuracy[link].estimate), (
                f"seed {seed}: {link} is {speed}, off by {float(off)}"
            )
            still += not truth[link] and bool(speed)
    assert judged > 100
    assert still > 3, "zeros that floats do not hit are what is tried here"


def amplifiers(counts: list[tuple[int, int, int, int]], driven: str) -> dict[str, Any]:
    """Differentials in a row, f ~ p and q ~ g: the sun g turns at 1 - f q / (p g) of its carrier."""
    links: dict[str, Any] = {"frame": {"wheels": {}}, "x0": {}}
    joints, gears = [{"pair": ["frame", "x0"], "axis": "main"}], []
    for at, (f, p, q, g) in enumerate(counts):
        links["frame"]["wheels"][f"f{at}"] = f
        links[f"p{at}"] = {"wheels": {f"p{at}": p, f"q{at}": q}}
        links[f"x{at + 1}"] = {"wheels": {f"g{at}": g}}
        joints.append({"pair": ["frame", f"x{at + 1}"], "axis": "main"})
        joints.append({"pair": [f"x{at}", f"p{at}"], "axis": f"P{at}"})
        gears += [{"pair": [f"f{at}", f"p{at}"]}, {"pair": [f"q{at}", f"g{at}"]}]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {driven: 1}}


def test_a_ratio_of_1e18_is_refused_in_floats_and_exact_otherwise() -> None:
    train = GearTrain.declare(amplifiers([(10**9 - 1, 10**9, 10**9 + 1, 10**9)], "x1"))
    assert train.solve()["x0"] == 10**18
    with pytest.raises(RangeError, match=r"in float64[^$]*use `method=.exact.`"):
        train.kinematics.floats()
    with pytest.raises(RangeError, match=r"in float64[^$]*use `method=.exact.`"):
        train.solve(method="sparse")


def test_a_dense_train_of_which_no_digit_is_known_in_floats_is_solved_exactly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.kinematics.train_kinematics.EXACT_BUDGET", -(10**6))
    train = GearTrain.declare(amplifiers([(10**9 - 1, 10**9, 10**9 + 1, 10**9)], "x1"))
    answer = train.solve()
    assert answer.method == "exact"
    assert answer["x0"] == 10**18
    assert GearTrain.declare(planetaries(2)).solve().method == "floats"


def test_estimate_and_bound_are_valid_up_to_a_condition_of_1e24_or_the_floats_are_refused() -> None:
    """The error is exact; the bound is (25b), condition times the maximum residual."""
    draw, given, refused = random.Random(1), 0, 0
    for _ in range(200):
        counts = []
        for _ in range(draw.choice([1, 1, 2, 3])):
            n, k = int(10 ** draw.uniform(2, 11.9 if len(counts) == 0 else 5)), draw.randint(1, 3)
            counts.append((n - k, n, n + k, n))  # 1 - f q / (p g) is (k / n)**2
        train = GearTrain.declare(amplifiers(counts, draw.choice(["x0", f"x{len(counts)}"])))
        truth = train.solve().speeds
        try:
            floats = train.kinematics.floats()
        except RangeError:
            refused += 1
            continue
        given += 1
        bound = Fraction(float(floats.residual.values.max())) + EPS  # and one rounding, that of the speed itself
        for link, speed in truth.items():
            off = abs(Fraction(floats[link]) - speed)
            assert off <= Fraction(float(floats.estimate[link][0])), (counts, link)
            if speed and floats.condition[link] < float("inf"):
                assert off <= Fraction(floats.condition[link]) * bound * abs(Fraction(floats[link])), (counts, link)
    assert given > 100
    assert refused > 20


def planetaries(stages: int) -> dict[str, Any]:
    """Sun in, ring fixed, carrier out to the next sun: planet and carrier of a stage are known only together."""
    links: dict[str, Any] = {"frame": {"wheels": {}}, "c0": {"wheels": {}}}
    joints, gears = [{"pair": ["frame", "c0"], "axis": "main"}], []
    for at in range(stages):
        links["frame"]["wheels"][f"r{at}"] = {"teeth": 900, "internal": True}
        links[f"c{at}"]["wheels"][f"s{at}"] = 20
        links[f"p{at}"] = {"wheels": {f"p{at}": 440}}
        links[f"c{at + 1}"] = {"wheels": {}}
        joints.append({"pair": ["frame", f"c{at + 1}"], "axis": "main"})
        joints.append({"pair": [f"c{at + 1}", f"p{at}"], "axis": f"a{at}"})
        gears += [{"pair": [f"s{at}", f"p{at}"]}, {"pair": [f"p{at}", f"r{at}"]}]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {"c0": 1}}


@pytest.mark.parametrize("stages", [72, 80, 300])
def test_a_cascade_past_the_range_is_refused_in_floats_and_exact_otherwise(
    stages: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    train = GearTrain.declare(planetaries(stages))
    exact = Fraction(1, 46**stages)
    if stages == 72:
        floats = train.kinematics.floats()
        off = abs(Fraction(floats[f"c{stages}"]) - exact)
        assert off <= Fraction(float(floats.estimate[f"c{stages}"][0])) <= exact / 10**12
        return
    with pytest.raises(RangeError, match=r"use `method=.exact.`"):
        train.solve(method="sparse")
    monkeypatch.setattr("geartrain.kinematics.train_kinematics.EXACT_BUDGET", -(10**6))
    assert train.solve()[f"c{stages}"] == exact
