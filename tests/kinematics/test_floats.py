"""The float path: its error, its estimate, its condition numbers, and many inputs at once."""

from __future__ import annotations

import json
import math
import random
import re
from fractions import Fraction
from functools import cache
from typing import Any

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from sampling import all_but
from studies.train_families import drift
from test_large_trains import ten_thousand_cascade

from geartrain import GearTrain, GearTrainError, load
from geartrain.errors import RangeError
from geartrain.kinematics import FloatSpeeds
from geartrain.kinematics.speeds.float_speeds import solve_floats
from geartrain.numerics import LongFloat, decimal

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


@pytest.mark.parametrize("name", STIFF)
def test_without_refinement_the_error_is_within_the_condition_of_the_output(name: str) -> None:
    train, link, exact = STIFF[name]
    raw = solve_floats(train.equations(), refine=False, condition_of=[link])
    assert abs(Fraction(raw[link]) / exact - 1) <= 4 * EPS * Fraction(raw.condition[link])


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
    assert train.kinematics.floats(condition_of=[link]).condition[link] == pytest.approx(condition, rel=digits)


def dense_condition(train: GearTrain, link: str) -> Fraction:
    """(|A^-1| |A| |x|)_link / |x_link| over the rationals, from the system's own rows."""
    links = list(train.declaration.links)
    rows = train.equations().equations
    size = len(links)
    a = [[Fraction(0)] * size for _ in rows]
    for at, row in enumerate(rows):
        for name, c in row.terms:
            a[at][links.index(name)] += c
    work = [[*row, *(Fraction(int(i == j)) for j in range(size))] for i, row in enumerate(a)]
    for column in range(size):
        pivot = next(r for r in range(column, size) if work[r][column])
        work[column], work[pivot] = work[pivot], work[column]
        lead = work[column][column]
        work[column] = [value / lead for value in work[column]]
        for r in range(size):
            if r != column and work[r][column]:
                factor = work[r][column]
                work[r] = [value - factor * above for value, above in zip(work[r], work[column], strict=True)]
    inverse = [row[size:] for row in work]
    x = [sum(inverse[i][at] * row.right for at, row in enumerate(rows)) for i in range(size)]
    spread = [sum(abs(c) * abs(x[j]) for j, c in enumerate(row)) for row in a]
    here = links.index(link)
    return sum(abs(inverse[here][at]) * spread[at] for at in range(size)) / abs(x[here])


@pytest.mark.parametrize("name", STIFF)
def test_one_transposed_solve_gives_the_condition_of_the_full_formula(name: str) -> None:
    train, link, _ = STIFF[name]
    found = train.kinematics.floats(condition_of=[link]).condition[link]
    assert found == pytest.approx(float(dense_condition(train, link)), rel=1e-6)


TWO_INPUTS = """
links:
  frame: {}
  sun: {wheels: {s: 24}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  planet: {wheels: {p: 18}}
  arm: {}
revolutes:
  - {pair: [frame, sun], axis: main}
  - {pair: [frame, ring], axis: main}
  - {pair: [frame, arm], axis: main}
  - {pair: [arm, planet], axis: planet}
gears: [{pair: [s, p]}, {pair: [p, r]}]
inputs: {sun: 1, ring: 0}
"""


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


def test_floats_and_exact_have_the_same_outputs_and_say_which_they_are() -> None:
    train = load("pennestri-2002")
    exact, floats = train.solve(method="exact"), train.solve(method="floats")
    assert (exact.method, floats.method) == ("exact", "floats")
    assert floats.verdict.kind == "determined"
    assert set(floats.outputs) == set(exact.outputs)
    for link, speed in exact.speeds.items():
        assert abs(Fraction(floats.speeds[link]) - speed) <= 2 * EPS * abs(speed)


def test_one_output_is_solved_in_floats_too() -> None:
    train = load("pennestri-2002")
    answer = train.solve(output="8", method="floats")
    assert answer["8"] == 0.25
    assert answer.work < len(train.circuits)


def test_redundant_rows_are_left_out_and_loops_that_close_do_no_harm() -> None:
    train = load("four-gear-loop")
    exact, floats = train.solve(), train.kinematics.floats()
    for link, speed in exact.speeds.items():
        assert abs(Fraction(floats[link]) - speed) <= EPS * abs(speed)


@pytest.mark.parametrize("inputs", ["{}", "{sun: 1}", "{sun: 1, ring: 1, arm: 2}"])
def test_a_train_that_is_not_determined_has_no_float_solution(inputs: str) -> None:
    train = load(TWO_INPUTS.replace("{sun: 1, ring: 0}", inputs))
    with pytest.raises(GearTrainError):
        train.kinematics.floats()


@pytest.mark.parametrize("inputs", ["{}", "{sun: 1}", "{sun: 1, ring: 1, arm: 2}", "{sun: 1, ring: 1, arm: 1}"])
def test_the_verdict_is_exact_whatever_the_method(inputs: str) -> None:
    train = load(TWO_INPUTS.replace("{sun: 1, ring: 0}", inputs))
    assert train.solve(method="floats").verdict.kind == train.solve(method="exact").verdict.kind


def test_the_estimate_holds_for_a_link_that_stands_still() -> None:
    train = load(
        """
        links: {frame: {}, L1: {}, L2: {}, L3: {}, L4: {wheels: {a: 11}}, L5: {wheels: {b: 15}}}
        revolutes:
          - {pair: [L1, frame], axis: A1}
          - {pair: [L2, frame], axis: A1}
          - {pair: [L3, L1], axis: A3}
          - {pair: [L4, L3], axis: A3}
          - {pair: [L5, frame], axis: A1}
        gears: [{pair: [a, b]}]
        couplings: [{kind: pin_and_slot, pin: L2, slot: L3}, {kind: pin_and_slot, pin: frame, slot: L3}]
        inputs: {L4: 3}
        fixed: [L1]
        """
    )
    exact, floats = train.solve(), train.kinematics.floats()
    for link, speed in exact.speeds.items():
        assert abs(Fraction(floats[link]) - speed) <= Fraction(float(floats.estimate[link][0])), link


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
    inverted: int,
    determined_sets: list[tuple[int, GearTrain, dict[str, Fraction]]],
    monkeypatch: pytest.MonkeyPatch,
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
    with pytest.raises(RangeError, match=r"in float64[^$]*use the exact method"):
        train.kinematics.floats()
    with pytest.raises(RangeError, match=r"in float64[^$]*use the exact method"):
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
            floats = train.kinematics.floats(condition_of=[*truth])
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


# Beyond the range of float64 ------------------------------------------------------------------------------------------


def row(*pairs: tuple[int, int]) -> dict[str, Any]:
    """A chain of pairs, driver and driven."""
    links: dict[str, Any] = {"frame": {}, "g0": {"wheels": {}}}
    for at, (driver, driven) in enumerate(pairs, 1):
        links[f"g{at - 1}"]["wheels"][f"a{at}"] = driver
        links[f"g{at}"] = {"wheels": {f"b{at}": driven}}
    joints = [{"pair": ["frame", f"g{at}"], "axis": f"A{at}"} for at in range(len(pairs) + 1)]
    gears = [{"pair": [f"a{at}", f"b{at}"]} for at in range(1, len(pairs) + 1)]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {"g0": 1}}


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


def before_shafts(seed: int) -> dict[str, Any]:
    """Sets between shafts, some at rest by cancellation, behind four hundred pairs 97/7 or 7/97."""
    data, pair = sets_between_shafts(seed), (97, 7) if seed % 2 else (7, 97)
    front = row(*[pair] * 400)
    front = json.loads(re.sub(r'"([ab]\d+)"', r'"front \1"', json.dumps(front)))
    front["links"]["g400"]["wheels"]["front a401"] = 31
    data["links"]["s0"]["wheels"]["front b401"] = 30
    return {
        "links": data["links"] | front["links"] | {"frame": data["links"]["frame"]},
        "revolutes": data["revolutes"] + front["revolutes"],
        "gears": [*data["gears"], *front["gears"], {"pair": ["front a401", "front b401"]}],
        "inputs": {"g0": 1},
    }


def by_hand(data: dict[str, Any]) -> list[Fraction]:
    """Speeds of a chain, link by link."""
    speeds = [Fraction(1)]
    for at in range(1, len(data["links"]) - 1):
        driver, driven = (data["links"][f"g{at - 1 + own}"]["wheels"][f"{'ab'[own]}{at}"] for own in (0, 1))
        speeds.append(-speeds[-1] * Fraction(driver, driven))
    return speeds


def pair_of(floats: FloatSpeeds, link: str, case: int = 0) -> tuple[Fraction, Fraction]:
    """Speed and estimate as the numbers that they stand for."""
    power = Fraction(2) ** int(floats.exponents[link][case])
    return Fraction(float(floats.speeds[link][case])) * power, Fraction(float(floats.estimate[link][case])) * power


CHAINS = {
    "up": lambda: row(*[(11, 10)] * 2000),
    "further up": lambda: row(*[(11, 10)] * 8000),
    "down": lambda: row(*[(5, 6)] * 4400),
    "up and back": lambda: row(*[(6, 5)] * 4400, *[(5, 6)] * 4400),
    "two thousand steep ones": lambda: row(*[(50, 10)] * 2000),
    "five thousand steep ones": lambda: row(*[(10, 50)] * 5000),
}
GENTLE_CHAINS = {
    "gently down": lambda: row(*[(10, 11)] * 8000),
    "gently up and back": lambda: row(*[(11, 10)] * 8000, *[(10, 11)] * 8000),
    "drifting": lambda: drift(12_000),
}


@cache
def chain(name: str) -> tuple[GearTrain, FloatSpeeds]:
    """A chain with its speeds, which several tests look at."""
    train = GearTrain.declare((CHAINS | GENTLE_CHAINS)[name]())
    return train, train.kinematics.floats()


@pytest.mark.parametrize("name", all_but({"five thousand steep ones", *GENTLE_CHAINS}, (*CHAINS, *GENTLE_CHAINS)))
def test_chains_of_any_ratio_are_solved_within_their_estimates(name: str, recwarn: pytest.WarningsRecorder) -> None:
    (_, floats), truth = chain(name), by_hand((CHAINS | GENTLE_CHAINS)[name]())
    for at in {*range(0, len(truth), max(1, len(truth) // 40)), len(truth) - 1}:
        speed, estimate = pair_of(floats, f"g{at}")
        assert abs(speed - truth[at]) <= estimate <= abs(truth[at]) / 10**12
    assert not recwarn.list


@pytest.mark.parametrize(
    ("data", "link", "exact"),
    [
        (ten_thousand_cascade(100), "m100", Fraction(1, 10**400)),
        (planetaries(300), "c300", Fraction(1, 46**300)),
    ],
    ids=["ten thousand a hundred times", "simple sets"],
)
def test_cascades_past_the_range_are_solved_within_their_estimates(
    data: dict[str, Any], link: str, exact: Fraction
) -> None:
    train = GearTrain.declare(data)
    floats = train.kinematics.floats()
    for each, truth in train.solve().speeds.items():
        speed, estimate = pair_of(floats, each)
        assert abs(speed - truth) <= estimate <= abs(truth) / 10**12
    assert abs(pair_of(floats, link)[0] / exact - 1) <= Fraction(1, 10**12)


def test_the_cascade_of_ten_thousand_is_solved_upwards_too() -> None:
    data = ten_thousand_cascade(100) | {"inputs": {"m100": 1}}
    speed, estimate = pair_of(GearTrain.declare(data).kinematics.floats(), "m0")
    assert abs(speed - 10**400) <= estimate <= Fraction(10) ** 388


def test_no_speed_beyond_the_range_is_farther_off_than_its_estimate(request: pytest.FixtureRequest) -> None:
    """Also where shafts stand still by cancellation of speeds that float64 does not hold."""
    judged = 0
    for seed in range(40 if request.config.getoption("--slow") else 16):
        train = GearTrain.declare(before_shafts(seed))
        answer = train.solve()
        if not answer.verdict:
            continue
        floats, judged = train.kinematics.floats(), judged + 1
        for link, truth in answer.speeds.items():
            speed, estimate = pair_of(floats, link)
            assert abs(speed - truth) <= estimate, f"seed {seed}: {link}"
            assert not truth or estimate <= abs(truth) / 10**9, f"seed {seed}: {link}"
    assert judged > 5


def test_a_train_whose_sizes_take_too_long_to_find_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.kinematics.speeds.float_speeds._BUDGET", 1000)
    with pytest.raises(RangeError, match="coupled too densely"):
        GearTrain.declare(planetaries(300)).kinematics.floats()


def test_trains_of_ordinary_speeds_are_solved_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("nothing is to be scaled")

    monkeypatch.setattr("geartrain.kinematics.speeds.float_speeds.find_exponents", refuse)
    for train in (*(train for train, _, _ in STIFF.values()), load("pennestri-2002"), GearTrain.declare(row((11, 10)))):
        assert not train.kinematics.floats().exponents.values.any()


def test_a_speed_is_a_float_wherever_one_holds_it_and_is_told_in_decimal_elsewhere() -> None:
    _, floats = chain("further up")
    assert floats.exponents["g7000"][0] == 0
    assert floats["g7000"] == pytest.approx(float(Fraction(11, 10) ** 7000), rel=1e-15)
    assert floats.exponents["g8000"][0] > 1024
    assert floats.decimal("g8000", digits=12) == decimal(Fraction(11, 10) ** 8000, 12)
    with pytest.raises(RangeError, match=r"(?s)'g8000' is 1\.\d+e\+331.*decimal\('g8000'\)"):
        floats["g8000"]


def test_every_case_has_exponents_of_its_own() -> None:
    train, _ = chain("two thousand steep ones")
    floats = train.kinematics.floats(inputs={"g0": [1.0, 0.0, 1e-300, 1e300]})
    for case, driven in enumerate((1.0, 0.0, 1e-300, 1e300)):
        speed, estimate = pair_of(floats, "g2000", case)
        assert abs(speed - Fraction(driven) * 5**2000) <= estimate
        assert estimate <= speed / 10**12


def test_an_answer_in_floats_tells_speeds_of_any_size_and_never_as_exact() -> None:
    data = row(*[(50, 10)] * 2000)
    data["outputs"] = {"last": {"of": "g2000", "expect": "1/3"}}
    data["outputs"]["slip"] = {"of": "g2000", "relative_to": "g1999"}
    answer = GearTrain.declare(data).solve(method="floats")
    assert isinstance(answer["last"], LongFloat)
    assert not answer.outputs["last"].holds
    assert abs(Fraction(answer["slip"]) / (5**2000 + 5**1999) - 1) < 1e-15
    plain = json.loads(json.dumps(answer.to_dict(), allow_nan=False))
    assert plain["speeds"]["g2000"] == {
        "exact": None,
        "value": None,
        "decimal": decimal(Fraction(5**2000), 12),
        "estimate": None,
        "true_error": plain["speeds"]["g2000"]["true_error"],
        "condition": pytest.approx(4001),  # each of 2000 pairs adds 2
    }
    assert plain["outputs"]["last"]["decimal"] == decimal(Fraction(5**2000), 12)
    assert plain["outputs"]["last"]["output/input"] is None


def number(part: float, power: int) -> float | LongFloat:
    """part x 2^power, as a float if one holds it without loss."""
    return math.ldexp(part, power) if -1021 <= power <= 1024 else LongFloat(part, power)


SIZES = st.tuples(st.floats(0.5, 1, exclude_max=True), st.sampled_from([1, -1]), st.integers(-3000, 3000))


@given(SIZES, SIZES)
@example((0.5, 1, 2000), (0.5, -1, 2000))
@example((0.75, 1, 2000), (0.5, -1, 2000 - 54))
def test_long_floats_round_as_floats_do(one: tuple[float, int, int], other: tuple[float, int, int]) -> None:
    a, b = (number(part * sign, power) for part, sign, power in (one, other))
    exact_a, exact_b = (Fraction(part * sign) * Fraction(2) ** power for part, sign, power in (one, other))
    assume(isinstance(a, LongFloat) or isinstance(b, LongFloat))
    assert (Fraction(a), Fraction(b)) == (exact_a, exact_b)
    for found, exact in (
        (a + b, exact_a + exact_b),
        (a - b, exact_a - exact_b),
        (a * b, exact_a * exact_b),
        (a / b, exact_a / exact_b),
        *([(a - exact_b, exact_a - exact_b)] if isinstance(a, LongFloat) else []),
        *([(exact_a / b, exact_a / exact_b)] if isinstance(b, LongFloat) else []),
    ):
        assert abs(Fraction(found) - exact) <= EPS * abs(exact)
        assert isinstance(found, float) == (not exact or Fraction(2) ** -1022 <= abs(exact) < Fraction(2) ** 1024)
    assert ((a < b), (a <= b), (a > 0), (a == b)) == (
        exact_a < exact_b,
        exact_a <= exact_b,
        exact_a > 0,
        exact_a == exact_b,
    )
    assert f"{a:.6g}" == decimal(exact_a, 6)
