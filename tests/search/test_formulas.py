"""Outputs as rational functions of tooth counts: against solved trains, closed forms, brute force and exact values."""

from __future__ import annotations

import copy
import itertools
import pickle
import random
from collections.abc import Mapping
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_solver import solve_naively
from sampling import few_or_many
from shipped import every_train
from strategies import Data, driven_trains, overdriven_trains, requested_trains
from yaml import safe_load

from geartrain import GearTrain, load
from geartrain.errors import QuestionError
from geartrain.kinematics.formulas import Formula, Formulas, find_formulas, with_counts
from geartrain.train import Train, declare

ANY = (1,)
"""Allowed counts where only the formula is asked for."""


@cache
def loaded(name: str) -> GearTrain:
    return load(name)


def all_free(train: Train) -> dict[str, tuple[int, ...]]:
    return dict.fromkeys(train.wheels, ANY)


def formulas_of(name: str, state: str | None = None) -> Formulas:
    train = loaded(name).declaration
    return find_formulas(train, state, all_free(train))


def nearby(train: Train, draw: random.Random) -> dict[str, int]:
    """Counts within a fifth of the declared ones."""
    return {
        name: draw.randint(max(1, wheel.count * 4 // 5), wheel.count * 6 // 5)
        for name, (_, wheel) in train.wheels.items()
        if wheel.count is not None
    }


@pytest.mark.parametrize("name", every_train())
def test_every_output_of_a_shipped_train_is_what_the_train_solved_with_these_counts_gives(name: str) -> None:
    train = loaded(name).declaration
    draw = random.Random(name)
    declared = {wheel: part.count or 1 for wheel, (_, part) in train.wheels.items()}
    for state in train.states or (None,):
        found = find_formulas(train, state, all_free(train))
        assert not found.undetermined
        for counts in (declared, nearby(train, draw), nearby(train, draw)):
            assert found.turns(counts)
            answer = GearTrain(with_counts(train, counts)).solve(state, method="exact")
            assert answer.verdict
            assert {output: formula.value(counts) for output, formula in found.items()} == {
                output: result.speed for output, result in answer.outputs.items()
            }


@pytest.mark.parametrize("name", ["freeth-2021", "zf-8hp70", "pennestri-2002", "humpage", "worm"])
def test_wheels_that_are_not_free_keep_their_counts(name: str) -> None:
    train = loaded(name).declaration
    draw = random.Random(1)
    free = dict.fromkeys(draw.sample(sorted(train.wheels), max(1, len(train.wheels) // 3)), ANY)
    for state in train.states or (None,):
        few, many = find_formulas(train, state, free), find_formulas(train, state, all_free(train))
        others = {wheel: part.count or 1 for wheel, (_, part) in train.wheels.items() if wheel not in free}
        for output, formula in few.items():
            assert set(formula.wheels) <= set(free)
            part = many[output].fixed(others)
            assert (part.wheels, part.numerator, part.denominator) == (
                formula.wheels,
                formula.numerator,
                formula.denominator,
            )


def check_closed_form(formula: Formula, form: str) -> None:
    """Both agree exactly at random counts. `form` is an expression with the wheels as names."""
    draw = random.Random(form)
    for _ in range(20):
        counts = {wheel: draw.randint(5, 200) for wheel in formula.wheels}
        assert formula.value(counts) == eval(form, {}, {wheel: Fraction(count) for wheel, count in counts.items()})


@pytest.mark.parametrize(
    ("name", "state", "output", "form"),
    [
        ("wolfrom-175", None, "output", "(1 - r72*p28/(p30*r70)) / (1 + r72/s12)"),
        ("two-k-h-10000", None, "output", "1 - p101*g99/(g100*p100)"),
        ("humpage", None, "output", "i20/(i20+f76) - i20/(i20+f76) * f76*p24/(p56*o35)"),
        ("ferguson-paradox", None, "less", "100 * (1 - w100/w99)"),
        ("ravigneaux-set", "1", "OUT", "a/r"),
        ("ravigneaux-set", "2", "OUT", "a*(b+r)/(r*(a+b))"),
        ("ravigneaux-set", "4", "OUT", "1 + b/r"),
        ("ravigneaux-set", "R", "OUT", "-b/r"),
        ("zf-8hp70", "1", "OUT", "1 / (1 + r4/s4)"),
        ("zf-8hp70", "2", "OUT", "(1 + s2/r2) / (1 + r4/s4)"),
        ("zf-8hp70", "8", "OUT", "1 + s2/r2"),
        ("zf-8hp70", "R", "OUT", "(1 + s2/r2) / (1 - r3*r4/(s3*s4))"),
        ("nrel-grc-750", None, "high", "(1 + ring/s21) * g82*g88/(g23*g22)"),
        ("prague-orloj", None, "sidereal month", "s366/m379 - s366/z365"),
        ("prague-orloj", None, "synodic month", "s366/m379 - 1"),
        ("worm", None, "wheel", "-w2/w60"),
    ],
)
def test_known_sets_have_their_closed_forms(name: str, state: str | None, output: str, form: str) -> None:
    check_closed_form(formulas_of(name, state)[output], form)


def test_an_ordinary_train_is_a_product_of_ratios() -> None:
    moon = formulas_of("pennestri-2002")["moon"]
    assert str(moon) == "(5 Za2 Za4 Za10 Za11) / (Z4 Za5 Z10 Z11)"
    assert not moon.has_poles


# what a train with loops or too many prescriptions asks of its counts


def put(data: Data, counts: Mapping[str, int]) -> Data:
    """The plain declaration with other counts."""
    data = copy.deepcopy(data)
    for part in data["links"].values():
        for name, wheel in (part.get("wheels") or {}).items():
            if name in counts:
                part["wheels"][name] = counts[name] if isinstance(wheel, int) else {**wheel, "teeth": counts[name]}
    return data


def check_against_naive(data: Data, found: Formulas, counts: Mapping[str, int]) -> None:
    """Where the formulas say that the train turns, it does, at their speeds; and it does nowhere else."""
    known = solve_naively(put(data, counts))
    values = {name: formula.value(counts) for name, formula in found.items()}
    if found.turns(counts) and None not in values.values():
        still = known.kind == "locked" and not any(data.get("inputs", {}).values())
        assert still or known.kind in ("determined", "free")
        if not still:
            assert values == {name: known.speeds[name] for name in values}
    elif not any(formula.value(counts) == 0 for formula in found.exclusions):
        loops = [formula for formula in found.conditions if formula.label.startswith("loop")]
        held = any(formula.value(counts) != 0 for formula in loops)
        assert held or known.kind != "determined"


STEPPED = safe_load("""
links:
  frame: {wheels: {ring: {teeth: 80, internal: true}}}
  sun: {wheels: {s: 20}}
  arm: {}
  one: {wheels: {p1: 20, q1: 30}}
  two: {wheels: {p2: 20, q2: 30}}
revolutes:
  - {pair: [frame, sun], axis: main}
  - {pair: [frame, arm], axis: main}
  - {pair: [arm, one], axis: a}
  - {pair: [arm, two], axis: b}
gears: [{pair: [s, p1]}, {pair: [s, p2]}, {pair: [q1, ring]}, {pair: [q2, ring]}]
inputs: {sun: 1}
outputs: {arm: {}}
""")


def test_two_stepped_planets_turn_if_their_counts_are_in_one_proportion() -> None:
    found = find_formulas(declare(STEPPED), None, dict.fromkeys(["p1", "q1", "p2", "q2"], ANY))
    (condition,) = found.conditions
    assert condition.label in ("loop sun - one - frame - two closes", "loop sun - two - frame - one closes")
    assert len(condition.numerator) == 2
    for counts in itertools.product((20, 24, 30), repeat=4):
        chosen = dict(zip(("p1", "q1", "p2", "q2"), counts, strict=True))
        turns = solve_naively(put(STEPPED, chosen)).kind == "determined"
        assert turns == (chosen["p1"] * chosen["q2"] == chosen["p2"] * chosen["q1"])
        assert found.turns(chosen) == turns
        check_against_naive(STEPPED, found, chosen)


def test_equal_planets_between_one_sun_and_one_ring_ask_nothing() -> None:
    found = formulas_of("planets-in-place")
    assert found.conditions == ()
    check_closed_form(found["carrier"], "s / (s + ring)")


def test_a_loop_of_counts_that_are_not_free_holds_its_wheels_as_ever() -> None:
    data = put(STEPPED, {"q2": 31})
    found = find_formulas(declare(data), None, {"s": ANY})
    assert not found.turns({"s": 20}), "the sun is locked on its carrier, which the ring then holds"
    assert solve_naively(data).kind == "locked"
    free = {**data, "inputs": {}, "fixed": ["arm"], "outputs": {"sun": {}}}
    assert find_formulas(declare(free), None, {"s": ANY})["sun"].constant == 0


TWO_SUNS = safe_load("""
links:
  frame: {wheels: {r: {teeth: 60, internal: true}, f: 30}}
  one: {wheels: {s: 24}}
  two: {wheels: {e: 30}}
  arm: {}
  planet: {wheels: {p: 18}}
  other: {wheels: {q: 20}}
revolutes:
  - {pair: [frame, one], axis: main}
  - {pair: [frame, two], axis: main}
  - {pair: [frame, arm], axis: main}
  - {pair: [arm, planet], axis: a}
  - {pair: [arm, other], axis: b}
gears: [{pair: [s, p]}, {pair: [p, r]}, {pair: [q, f]}, {pair: [q, e]}]
outputs: {arm: {}}
""")


@pytest.mark.parametrize(
    ("inputs", "fixed"),
    [({"one": 7, "two": 1}, []), ({"one": 7}, ["two"]), ({"one": 7, "arm": 2}, []), ({"arm": 2, "two": 1}, [])],
)
@pytest.mark.parametrize("given", [True, False])
def test_inputs_too_many_by_one_are_a_condition_on_the_counts(
    inputs: dict[str, int], fixed: list[str], given: bool
) -> None:
    # seven turns of the first sun are two of the arm with 24 and 60 teeth; the other wheel follows by 1 - f/e
    data: Data = {**TWO_SUNS, "inputs": inputs, "fixed": fixed}
    sought = copy.deepcopy(data)
    for link, wheel in (("one", "s"), ("two", "e"), ("frame", "f")):
        sought["links"][link]["wheels"][wheel] = {"teeth": {"search": [10, 99]}}
    declared = declare(data if given else sought)
    found = find_formulas(declared, None, dict.fromkeys("srfe", ANY))
    assert len(found.conditions) == 1
    turned = 0
    for s, r, f, e in itertools.product((20, 24, 30), (60, 75), (15, 30), (15, 20, 30)):
        counts = {"s": s, "r": r, "f": f, "e": e}
        check_against_naive(data, found, counts)
        turned += found.turns(counts)
    assert turned > 0


def test_a_factor_that_is_cancelled_excludes_the_counts_where_the_train_is_free() -> None:
    data: Data = {**TWO_SUNS, "inputs": {"two": 0}, "outputs": {"arm": {}, "two": {}}}
    found = find_formulas(declare(data), None, dict.fromkeys("fe", ANY))
    assert found["arm"].constant == 0
    (exclusion,) = found.exclusions
    assert exclusion.wheels == ("f", "e")
    assert found.turns({"f": 30, "e": 31})
    assert not found.turns({"f": 30, "e": 30})
    assert solve_naively(put(data, {"e": 31})).speeds["arm"] == 0
    assert "arm" in solve_naively(data).undetermined


def test_a_pole_has_no_value() -> None:
    data: Data = {**TWO_SUNS, "inputs": {"two": 1}}
    arm = find_formulas(declare(data), None, dict.fromkeys("fe", ANY))["arm"]
    check_closed_form(arm.fixed({"f": 30}), "1 / (1 - 30/e)")
    assert arm.value({"f": 30, "e": 30}) is None
    assert arm.has_poles
    never = arm.fixed({"f": 30, "e": 30})
    assert never.value({}) is None
    assert never.constant is None
    assert np.isinf(never.accuracy({}))


def test_outputs_that_hang_on_more_inputs_are_undetermined_and_the_others_are_not() -> None:
    data: Data = {**TWO_SUNS, "inputs": {"one": 1}, "outputs": {"one": {}, "other": {}, "planet": {}, "arm": {}}}
    cut = {**data, "gears": data["gears"][:1] + data["gears"][2:]}
    found = find_formulas(declare(cut), None, all_free(declare(cut)))
    assert set(found) == {"one"}
    assert found.undetermined == ("other", "planet", "arm")


def test_a_train_held_whatever_its_counts_never_turns() -> None:
    data: Data = {**TWO_SUNS, "inputs": {"one": 1}, "fixed": ["arm"]}
    found = find_formulas(declare(data), None, all_free(declare(data)))
    assert any(condition.constant for condition in found.conditions)
    assert not found.turns(dict.fromkeys("srpqfe", 20))


def test_a_difference_of_axes_that_point_apart_has_the_signs_of_the_solver() -> None:
    train = declare(
        safe_load("""
        links:
          frame: {}
          a: {wheels: {x: {teeth: 20, kind: bevel}}}
          b: {wheels: {y: {teeth: 30, kind: bevel, facing: -1}, w: {teeth: 11, hand: left, kind: worm}}}
          c: {wheels: {z: 50}}
        axes: {A: {direction: [0, 0, -1]}, B: {direction: [1, 0, 0]}, C: {direction: [0, 0, 1]}}
        revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
        gears: [x ~ y, w ~ z]
        inputs: {a: 1}
        outputs: {b: {}, c: {}, apart: {of: c, relative_to: a}, other: {of: a, relative_to: c}}
        """)
    )
    found = find_formulas(train, None, all_free(train))
    for counts in ({"x": 20, "y": 30, "w": 11, "z": 50}, {"x": 7, "y": 9, "w": 2, "z": 31}):
        answer = GearTrain(with_counts(train, counts)).solve()
        assert {name: formula.value(counts) for name, formula in found.items()} == {
            name: result.speed for name, result in answer.outputs.items()
        }
    assert found["apart"].value(counts) != found["c"].value(counts) - 1, "the axes point apart"


def requested_for_all(data: Data, draw: random.Random) -> tuple[Data, dict[str, tuple[int, ...]]]:
    """Every link is an output; some wheels are free, with counts so few that loops often close."""
    data = {**data, "outputs": {link: {} for link in data["links"]}}
    wheels = [wheel for part in data["links"].values() for wheel in part["wheels"]]
    share, minimum, most = draw.choice([(0.4, 8, 40), (1, 8, 40), (1, 2, 4), (1, 1, 3)])
    return data, {wheel: tuple(range(minimum, most + 1)) for wheel in wheels if draw.random() < share}


@settings(max_examples=few_or_many(40, 80))
@given(st.one_of(requested_trains(), driven_trains(), overdriven_trains()), st.integers(0, 10**6))
def test_formulas_of_any_train_agree_with_naive_elimination_and_say_when_it_turns(data: Data, seed: int) -> None:
    draw = random.Random(seed)
    data, free = requested_for_all(data, draw)
    found = find_formulas(declare(data), None, free)
    for _ in range(4):
        counts = {wheel: draw.choice(allowed) for wheel, allowed in free.items()}
        check_against_naive(data, found, counts)


# values, accuracy and bounds


@settings(max_examples=few_or_many(40, 80))
@given(st.one_of(requested_trains(), driven_trains()), st.integers(0, 10**6))
def test_fast_values_lie_within_their_accuracy(data: Data, seed: int) -> None:
    draw = random.Random(seed)
    data, free = requested_for_all(data, draw)
    low = {wheel: draw.choice([draw.randint(1, 30), draw.randint(1, 10**12 - 9)]) for wheel in free}
    every = [{wheel: count + draw.randint(0, 2) for wheel, count in low.items()} for _ in range(12)]
    columns = {wheel: np.array([counts[wheel] for counts in every]) for wheel in free}
    for formula in find_formulas(declare(data), None, dict.fromkeys(free, ANY)).values():
        values = np.broadcast_to(formula.values(columns), len(every))
        accuracy = np.broadcast_to(formula.accuracy(columns), len(every))
        for counts, fast, bound in zip(every, values, accuracy, strict=True):
            value = formula.value(counts)
            if value is None:
                assert bound == np.inf
            else:
                assert bound == np.inf or abs(Fraction(float(fast)) - value) <= Fraction(float(bound)) * abs(value)


def test_accuracy_knows_of_cancellation_and_is_of_use() -> None:
    formula = formulas_of("two-k-h-10000")["output"]
    near = {"g100": 10**6, "p100": 10**6, "p101": 10**6 + 1, "g99": 10**6 - 1}  # 1 - (1 - 1e-12)
    columns = {wheel: np.array([count, 57]) for wheel, count in near.items()}
    exact = formula.value(near)
    accuracy = formula.accuracy(columns)
    assert exact == Fraction(1, 10**12)
    assert abs(Fraction(float(formula.values(columns)[0])) / exact - 1) <= Fraction(float(accuracy[0]))
    assert 1e-5 < accuracy[0] < 1e-2
    for name in ("freeth-2021", "pennestri-2002"):
        train = loaded(name).declaration
        counts = {wheel: np.array(part.count) for wheel, (_, part) in train.wheels.items()}
        found = formulas_of(name).values()
        assert max(float(formula.accuracy(counts)) for formula in found if formula.values(counts)) < 1e-12


# the interface


def test_formulas_are_a_mapping_plain_data_and_can_be_sent_to_other_processes() -> None:
    import json

    found = formulas_of("zf-8hp70", "R")
    assert list(found) == ["OUT"]
    assert len(found) == 1
    plain = json.loads(json.dumps(found.to_dict()))
    assert plain["outputs"]["OUT"]["text"] == "(s2 s3 s4 + s3 s4 r2) / (s3 s4 r2 - r4 r2 r3)"
    assert plain["conditions"] == []
    again = pickle.loads(pickle.dumps(found))
    assert again == found
    assert hash(again["OUT"]) == hash(found["OUT"])
    counts = {wheel: np.int64(10**12) for wheel in found["OUT"].wheels}
    assert found["OUT"].value(dict(counts, s3=np.int64(10**11))) == Fraction(-2, 9), "numpy's whole numbers are whole"


def test_changed_counts_leave_the_train_as_it_was_and_keep_marks_and_doubts(train_file: Any) -> None:
    path = train_file(
        """
        links:
          frame: {}
          a: {wheels: {p: {teeth: {value: 20, range: [18, 24]}, module: 2 mm}, o: {teeth: {search: [10, 20]}}}}
          b: {wheels: {w: 60}}
        revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
        gears: [{pair: [p, w]}]
        inputs: {a: 1}
        outputs: {b: {}}
        """
    )
    train = load(path).declaration
    assert train.wheels["p"][1].count == 20
    changed = with_counts(train, {"p": 24, "w": np.int64(48), "o": 11})
    assert {name: wheel.count for name, (_, wheel) in changed.wheels.items()} == {"p": 24, "o": 11, "w": 48}
    assert {name: wheel.count for name, (_, wheel) in train.wheels.items()} == {"p": 20, "o": None, "w": 60}
    assert GearTrain(changed).solve()["b"] == Fraction(-1, 2)
    assert GearTrain(train).solve()["b"] == Fraction(-1, 3)
    assert changed.place("gears", 0) == train.place("gears", 0) == f"{path}:6"
    assert changed.wheels["p"][1].uncertainty is not None
    assert changed.wheels["p"][1].module == train.wheels["p"][1].module
    assert with_counts(train, {"p": 30}).wheels["p"][1].uncertainty is None, "the evidence does not allow 30"
    assert type(changed.wheels["w"][1].count) is int


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda train: with_counts(train, {"rnig": 60}), "did you mean 'ring'"),
        (lambda train: with_counts(train, {"ring": 0}), "cannot have 0 teeth"),
        (lambda train: with_counts(train, {"ring": 2.5}), "cannot have 2.5 teeth"),
        (lambda train: find_formulas(train, None, {"rnig": ANY}), "did you mean 'ring'"),
        (lambda train: find_formulas(train, None, {"ring": ()}), "no allowed tooth count"),
        (lambda train: find_formulas(train, "4", {"ring": ANY}), "no state '4'"),
    ],
)
def test_what_the_train_does_not_have_is_refused(ask: Any, said: str) -> None:
    with pytest.raises(QuestionError, match=said) as caught:
        ask(loaded("planetary-24-18-60").declaration)
    assert all(problem.what and problem.why and problem.fix for problem in caught.value.problems)


def test_a_train_that_is_too_coupled_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.kinematics.formulas.laurent.MOST_PRODUCTS", 3)
    with pytest.raises(QuestionError, match=r"the formulas of .* are too long"):
        formulas_of("zf-8hp70", "5")


def test_formulas_need_no_array_library_until_columns_are_requested_for() -> None:
    import subprocess
    import sys

    code = (
        "import geartrain, sys; from geartrain.kinematics.formulas.output_formulas import find_formulas;"
        "t = geartrain.load('wolfrom-175').declaration; f = find_formulas(t, None, {'s12': (12, 13)})['output'];"
        "assert f.value({'s12': 12}) == geartrain.load('wolfrom-175').solve()['output'];"
        "assert 'numpy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
