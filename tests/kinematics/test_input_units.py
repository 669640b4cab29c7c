"""Inputs in any units of speed mean the same motion: order, zeros and the unit of each input change nothing.

The scales stand here once more, as turns a second, so that the tables under test are not their own witness.
"""

from __future__ import annotations

import json
import math
from copy import deepcopy
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from models import PAIR, PLANETARY, pair, refusal, torque_figures
from strategies import Data, driven_trains

import geartrain
from geartrain import GearTrain, GearTrainError, load
from geartrain.scene import ManufacturingSizes, SolidModel, make_scene
from geartrain.workshop import train_file

SCALES = {
    "turn/s": Fraction(1),
    "rpm": Fraction(1, 60),
    "turn/min": Fraction(1, 60),
    "turn/h": Fraction(1, 3600),
    "turn/d": Fraction(1, 24 * 3600),
    "deg/s": Fraction(1, 360),
}
RADIAN = 1 / (2 * math.pi)
RING = PLANETARY.replace(
    "frame: {{wheels: {{ring: {{teeth: 60, internal: true}}}}}}",
    "frame: {{}}\n  ring: {{wheels: {{ring: {{teeth: 60, internal: true}}}}}}",
).replace("revolutes:", "revolutes:\n  - {{pair: [frame, ring], axis: main}}")
TWO = PAIR.replace("gears: [{{pair: [p, w]}}]", "gears: []")


def a_second(answer: geartrain.Answer) -> dict[str, Fraction | float]:
    """Speeds in turns a second, by the unit the answer names."""
    scale = RADIAN if answer.unit == "rad/s" else SCALES[answer.unit]
    return {link: speed * scale for link, speed in answer.speeds.items()}


@pytest.mark.parametrize(
    "inputs",
    [
        "{ring: 0 rpm, sun: 1400 rpm}",
        "{sun: 1400 rpm, ring: 0 rpm}",
        "{ring: 0, sun: 1400 rpm}",
        "{ring: 0 deg/s, sun: 1400 rpm}",
        "{ring: 0 rad/s, sun: 1400 rpm}",
        "{sun: 1400 rpm, ring: 0 turn/d}",
    ],
)
def test_a_ring_that_stands_still_says_nothing_of_the_unit(inputs: str) -> None:
    answer = load(RING.format(rest=f"inputs: {inputs}")).solve()
    assert (answer.unit, answer["sun"], answer["ring"]) == ("rpm", 1400, 0)
    assert answer["carrier"] == 400  # 24 x 1400 / 84


def test_all_at_rest_are_at_rest_in_the_unit_named() -> None:
    answer = load(TWO.format(rest="inputs: {a: 0, b: 0 deg/s}")).solve()
    assert (answer.unit, answer["a"], answer["b"]) == ("deg/s", 0, 0)


def test_the_first_unit_that_turns_is_shown_whatever_the_others_are() -> None:
    answer = load(TWO.format(rest="inputs: {a: 6 deg/s, b: 1440 turn/d}")).solve()
    assert (answer.unit, answer["a"], answer["b"]) == ("deg/s", 6, 6)


def test_a_declared_unit_of_time_is_shown_and_named_inputs_are_counted_in_it() -> None:
    train = load(TWO.format(rest="unit: {per: 7 d}\ninputs: {a: 3 turn/d, b: 1/604800 turn/s}"))
    answer = train.solve()
    assert (answer.unit, answer["a"], answer["b"]) == ("turns per 7 d", 21, 1)
    year = load(TWO.format(rest="unit: {per: year_julian}\ninputs: {a: 1 turn/d, b: 0}")).solve()
    assert (year["a"], year["b"]) == (Fraction(1461, 4), 0)


def test_states_in_several_units_are_all_shown_in_one() -> None:
    text = "states:\n  slow: {inputs: {a: 6 deg/s, b: 0}}\n  fast: {inputs: {a: 60 rpm, b: 1 turn/s}}"
    train = load(TWO.format(rest=text))
    slow, fast = train.answers()
    assert (slow.unit, slow["a"]) == ("deg/s", 6)
    assert (fast.unit, fast["a"], fast["b"]) == ("deg/s", 360, 360)


def test_radians_alone_stay_exact() -> None:
    answer = load(RING.format(rest="inputs: {ring: 0 rpm, sun: 1.5 rad/s}")).solve()
    assert (answer.unit, answer.method, answer["carrier"]) == ("rad/s", "exact", Fraction(3, 7))


def test_radians_beside_turns_are_floats_and_say_so() -> None:
    answer = load(TWO.format(rest="inputs: {a: 60 rpm, b: 10 rad/s}")).solve()
    assert (answer.unit, answer.method) == ("rpm", "floats")
    assert isinstance(answer["b"], float)
    assert answer["b"] == pytest.approx(600 * RADIAN, rel=1e-15)
    plain = answer.to_dict()["speeds"]["b"]
    assert plain["exact"] is None
    assert plain["estimate"] <= 2e-16 * plain["value"]


def test_a_contradiction_in_radians_is_told_in_decimals() -> None:
    verdict = pair("inputs: {a: 60 rpm, b: 10 rad/s}").solve().verdict
    assert verdict.kind == "contradictory"
    assert "b = 95.49296586" in verdict.text


def test_radians_that_cancel_are_no_contradiction() -> None:
    train = pair("inputs: {a: 3 rad/s, b: -1 rad/s}\nunit: {per: 1 d}")
    assert train.solve().verdict
    assert not pair("inputs: {a: 3 rad/s, b: -10 rpm}").solve().verdict


@pytest.mark.parametrize("speed", ["60 rpm", "1 turn/s", "360 deg/s", "3600 turn/h", "6.283185307179586 rad/s"])
@pytest.mark.parametrize("torque", ["-3 N m", "-3000 N mm"])
def test_watts_are_the_same_in_every_unit(speed: str, torque: str) -> None:
    train = pair(f"inputs: {{a: {speed}}}\nloads: {{b: {torque}}}")
    # 3 N m against a third of a turn backwards a second
    power = float(train.torques().power_in) * torque_figures(train).watts_per_unit
    assert power == pytest.approx(2 * math.pi, rel=1e-14)


@pytest.mark.parametrize("inputs", ["{a: 0 rpm, b: 360 deg/s}", "{b: 360 deg/s, a: 0}", "{a: 0, b: 60 rpm}"])
@pytest.mark.parametrize("unit", ["", "unit: {per: 1 min}"])
def test_watts_are_right_beside_a_zero_and_in_a_declared_unit(inputs: str, unit: str) -> None:
    train = load(TWO.format(rest=f"inputs: {inputs}\nloads: {{b: 3 N m}}\n{unit}"))
    assert float(train.solve()["b"]) * torque_figures(train).watts_per_unit == pytest.approx(2 * math.pi, rel=1e-14)


@pytest.mark.parametrize(
    ("rest", "a_minute"),
    [
        ("inputs: {a: 60 rpm}", 60),
        ("inputs: {a: 6 deg/s}", 1),
        ("inputs: {a: 6.283185307179586 rad/s}", 60),
        ("inputs: {a: 1440}\nunit: {per: 1 d}", 1),
        ("inputs: {a: 2 rpm}\nunit: {per: 1 d}", 2),
    ],
)
def test_an_export_counts_turns_a_minute(rest: str, a_minute: float) -> None:
    model = json.loads(train_file(SolidModel(pair(rest), ManufacturingSizes()), "rexs"))["model"]
    (running,) = (case["components"] for case in model["load_spectrum"]["load_cases"])
    shaft = next(each for each in running if each["name"] == "a")
    assert shaft["attributes"][0]["floating_point"] == pytest.approx(a_minute, rel=1e-15)


@pytest.mark.parametrize(
    ("rest", "turns"),
    [("90 rpm", 90.0), ("90 deg/s", 0.25), ("6.283185307179586 rad/s", 1.0), ("90 turn/d", 90.0), ("90", 90.0)],
)
def test_a_picture_steps_by_the_turns_of_one_unit_of_time(rest: str, turns: float) -> None:
    assert float(Fraction(make_scene(pair(f"inputs: {{a: {rest}}}")).step)) == pytest.approx(turns, rel=1e-15)


@pytest.mark.parametrize(
    ("rest", "said"),
    [
        ("inputs: {a: 1400 RPM}", "did you mean 'rpm'?"),
        ("inputs: {a: 1400 Rpm}", "did you mean 'rpm'?"),
        ("inputs: {a: 1 Deg/S}", "did you mean 'deg/s'?"),
        ("inputs: {a: 1 rad/sec}", "did you mean 'rad/s'?"),
        ("inputs: {a: 1}\nloads: {b: 3 nm}", "did you mean 'Nm'?"),
        ("inputs: {a: 2 rpm, b: 1}", "inputs with and without units are mixed"),
        ("inputs: {a: 2 rpm}\nunit: {per: 18 ft}", "does not match the `unit` of the train"),
        ("inputs: {a: 2 N m}", "is a torque, but a speed, a length or a velocity is required"),
        ("states:\n  one: {inputs: {a: 2 rpm}}\n  two: {inputs: {a: 1}}", "inputs with and without units are mixed"),
        ("inputs: {a: 1}\nloads: {a: 5, b: 10 N mm}", "torques with and without units are mixed"),
        ("inputs: {a: 1}\nloads: {a: 5 N m}\nstates: {s: {loads: {b: 4}}}", "torques with and without units are mixed"),
    ],
)
def test_mixtures_and_misspellings_are_refused(rest: str, said: str) -> None:
    assert said in refusal(PAIR.format(rest=rest))


def test_a_zero_needs_no_unit() -> None:
    text = PAIR.format(rest="inputs: {a: 3700 rpm}\nloads: {b: -5 N mm}").replace(
        "  a: {", "  a: {angle: 0, bearing: 0, "
    )
    train = load(text)
    assert train.declaration.links["a"].angle is not None
    assert train.torques().external["b"] == Fraction(-1, 200)


def spoken(draw: st.DrawFn, speed: Fraction, units: list[str]) -> str:
    """A speed in turns a second, in a unit of one's choice; a zero may be bare."""
    unit = draw(st.sampled_from(units))
    if not speed and draw(st.booleans()):
        return "0"
    return f"{speed / SCALES[unit]} {unit}"


@st.composite
def alike(draw: st.DrawFn) -> tuple[Data, Data]:
    """A determined train in turns a second, and the same with its inputs reordered and each in a unit of its own."""
    data = draw(driven_trains())
    inputs = {link: Fraction(0) if draw(st.integers(0, 3)) == 0 else speed for link, speed in data["inputs"].items()}
    shuffled = draw(st.permutations(list(inputs)))
    own = {link: f"{speed} turn/s" for link, speed in inputs.items()}
    other = {link: spoken(draw, inputs[link], list(SCALES)) for link in shuffled}
    return {**data, "inputs": own}, {**data, "inputs": other}


@given(alike())
def test_order_zeros_and_units_of_inputs_change_nothing(both: tuple[Data, Data]) -> None:
    first, second = (GearTrain.declare(data).solve() for data in both)
    assert first.verdict.kind == second.verdict.kind
    if second.unit:  # bare zeros alone name no unit
        assert a_second(first) == a_second(second)


@given(alike(), st.data())
def test_radians_change_nothing_but_the_last_digits(both: tuple[Data, Data], data: st.DataObject) -> None:
    plain, other = both
    links = list(plain["inputs"])
    turned = deepcopy(other)
    for link in data.draw(st.lists(st.sampled_from(links), unique=True)):
        turned["inputs"][link] = f"{float(Fraction(plain['inputs'][link].split()[0])) / RADIAN!r} rad/s"
    first, second = GearTrain.declare(plain).solve(), GearTrain.declare(turned).solve()
    if not second.unit:
        return
    assert first.verdict.kind == second.verdict.kind
    size = max((abs(float(speed)) for speed in first.speeds.values()), default=0.0)
    for link, speed in a_second(second).items():
        assert float(speed) == pytest.approx(float(first[link]), rel=1e-12, abs=1e-12 * size)
    inputs = [text.split() for text in turned["inputs"].values()]
    kinds = {len(text) > 1 and text[1] == "rad/s" for text in inputs if Fraction(text[0])}
    assert second.method == ("floats" if len(kinds) > 1 else "exact")


def test_radians_beside_turns_beyond_all_floats_are_refused_in_words() -> None:
    """A train of 1,200 pairs 40/8 beside a shaft in rad/s: 5^1200 turns."""
    links: Data = {"frame": {}, "z": {}}
    data: Data = {"links": links, "revolutes": [{"pair": ["frame", "z"], "axis": "z"}], "gears": []}
    for at in range(1201):
        links[f"g{at}"] = {"wheels": {f"d{at}": 40, f"n{at}": 8}}
        data["revolutes"].append({"pair": ["frame", f"g{at}"], "axis": f"x{at}"})
        data["gears"] += [{"pair": [f"d{at - 1}", f"n{at}"]}] if at else []
    train = GearTrain.declare({**data, "inputs": {"g0": "1 rpm", "z": "1 rad/s"}})
    with pytest.raises(GearTrainError, match="is outside the range of float64"):
        train.solve()
    assert GearTrain.declare({**data, "inputs": {"g0": "1 rpm", "z": "1 turn/d"}}).solve()["g1200"] == 5**1200
