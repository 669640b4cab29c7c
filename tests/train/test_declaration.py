"""The declaration line by line: ids, numbers, teeth, outputs, units, targets, dials."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import get_args

import pytest
from models import PAIR, PLANETARY, pair, planetary, refusal

from geartrain import GearTrainError, load, teeth
from geartrain.errors import DeclarationError
from geartrain.train import declare, period_table


def test_the_same_train_is_read_from_text_file_mapping_and_name(tmp_path: Path) -> None:
    text = PLANETARY.format(rest="inputs: {sun: 1}")
    path = tmp_path / "p.yaml"
    path.write_text(text, encoding="utf-8")
    data = {
        "links": {
            "frame": {"wheels": {"ring": {"teeth": 60, "internal": True}}},
            "sun": {"wheels": {"s": 24}},
            "planet": {"wheels": {"p": 18}},
            "carrier": {},
        },
        "revolutes": [
            {"pair": ["frame", "sun"], "axis": "main"},
            {"pair": ["frame", "carrier"], "axis": "main"},
            {"pair": ["carrier", "planet"], "axis": "planet"},
        ],
        "gears": [{"pair": ["s", "p"]}, {"pair": ["p", "ring"]}],
        "inputs": {"sun": 1},
    }
    speeds = [load(source).solve().speeds for source in (text, path, str(path), data, "planetary-24-18-60")]
    assert all(dict(one) == dict(speeds[0]) for one in speeds)
    assert load(path).name == "p"


def test_a_link_may_hold_nothing_and_a_pair_is_named_after_its_wheels() -> None:
    train = load(PAIR.format(rest="inputs: {a: 1}").replace("frame: {}", "frame:"))
    assert train.circuits[0].id == "p~w"


def test_ids_are_the_text_as_written() -> None:
    train = load(
        """
        frame: no
        links:
          no: {}
          1: {wheels: {010: 020}}
          1:30: {wheels: {0x10: 60}}
        revolutes: [{pair: [no, 1], axis: yes}, {pair: [no, 1:30], axis: 2024-01-01}]
        gears: [{pair: [010, 0x10]}]
        inputs: {1: 1}
        outputs: {1:30: {expect: -1/3}}
        """
    )
    assert list(train.declaration.links) == ["no", "1", "1:30"]
    assert train.circuits[0].wheels == ("010", "0x10")
    answer = train.solve()
    assert answer["1:30"] == Fraction(-1, 3)
    assert answer


def test_name_spaces_are_separate() -> None:
    train = load(
        """
        frame: x
        links: {x: {}, a: {wheels: {a: 20}}, b: {wheels: {b: 60}}}
        revolutes: [{pair: [x, a], axis: a}, {pair: [x, b], axis: b}]
        gears: [{id: a, pair: [a, b]}]
        inputs: {a: 1}
        dials: {a: {}}
        outputs: {a: {of: b, dial: a}}
        """
    )
    answer = train.solve()
    assert answer.speeds["a"] == 1
    assert answer["a"] == Fraction(-1, 3), "an output of the name comes before the link"


@pytest.mark.parametrize(
    ("expect", "holds"),
    [
        ("-1/3", True),
        ("-1:3", True),
        ("-0.333", True),
        ("-0.3333", True),
        ("-0.3330", False),  # four digits were written
        ("-0.334", False),
        ("-0.33", True),
        ("-3.3e-1", True),
        ("-3.30e-1", False),
        ("1/3", False),
        ("0", False),
        ("{value: -0.33, tolerance: 0.004}", True),
        ("{value: -0.33, tolerance: 0.003}", False),
        ("{value: -1/3}", True),
        ("'-1/3'", True),
    ],
)
def test_an_expectation_holds_at_the_digits_written(expect: str, holds: bool) -> None:
    answer = pair(f"inputs: {{a: 1}}\noutputs: {{b: {{expect: {expect}}}}}").solve()
    assert answer.outputs["b"].expect_holds is holds
    assert bool(answer) is holds
    assert [output.name for output in answer.failures] == ([] if holds else ["b"])


def test_half_a_unit_of_the_last_digit_is_the_bound_itself() -> None:
    # 1/8 = 0.125 lies exactly half a unit of the last digit from 0.12 and from 0.13
    train = load(PAIR.format(rest="inputs: {a: -3/8}\noutputs: {x: {of: b, expect: 0.12}, y: {of: b, expect: 0.13}}"))
    answer = train.solve()
    assert answer["x"] == Fraction(1, 8)
    assert answer.failures == ()


@pytest.mark.parametrize(("speed", "value"), [("1:30", "1/30"), ("2.5", "5/2"), ("1e3", "1000"), ("-7", "-7")])
def test_inputs_are_exact_whatever_their_form(speed: str, value: str) -> None:
    assert pair(f"inputs: {{a: {speed}}}").solve()["b"] == -Fraction(value) / 3


@pytest.mark.parametrize(
    ("published", "holds"),
    [
        ("{value: -3, as: input/output}", True),
        ("{value: -2.99, as: input/output}", False),
        ("{value: -0.333, as: output/input}", True),
        ("{value: -2.33, as: speed, place: table 1}", True),
        ("{value: -2.33}", True),
        ("{value: -2.3, as: output/input}", False),
        ("{value: -2.3, tolerance: 0.04}", True),
    ],
)
def test_what_a_source_prints_is_a_speed_or_a_ratio(published: str, holds: bool) -> None:
    answer = pair(f"inputs: {{a: 7}}\noutputs: {{b: {{published: {published}}}}}").solve()
    assert answer.outputs["b"].published_holds is holds


def test_a_published_ratio_needs_one_input_that_is_not_zero() -> None:
    output = "outputs: {carrier: {published: {value: 3.5, as: input/output}}}"
    assert planetary(f"inputs: {{sun: 1}}\n{output}").solve().outputs["carrier"].published_holds is True
    two = load(
        PLANETARY.format(rest=f"inputs: {{sun: 1, hand: 1}}\n{output}")
        .replace("carrier: {}", "carrier: {}\n  hand: {}", 1)
        .replace("revolutes:", "revolutes:\n  - {pair: [frame, hand], axis: hand}")
    )
    assert two.solve().outputs["carrier"].published_holds is False


@pytest.mark.parametrize(
    "teeth",
    ["{value: 60, range: [59, 61]}", "{value: 60, choices: [50, 60]}", "{value: 60, search: [15, 80]}", "{value: 60}"],
)
def test_a_doubtful_tooth_count_is_used_at_its_value(teeth: str) -> None:
    train = load(PAIR.format(rest="inputs: {a: 1}").replace("w: 60", f"w: {{teeth: {teeth}}}"))
    assert train.solve()["b"] == Fraction(-1, 3)


def test_a_range_is_inclusive_and_lists_its_counts() -> None:
    train = load(
        PAIR.format(rest="inputs: {a: 1}").replace(
            "w: 60", "w: {teeth: {value: 60, range: [59, 61], weights: [1, 2, 1]}, status: surviving}"
        )
    )
    ((name, wheel),) = train.declaration.uncertain_wheels()
    assert name == "w"
    assert wheel.uncertainty.allowed == (59, 60, 61)
    assert wheel.status == "surviving"


def test_an_output_is_a_link_or_a_link_seen_from_a_link() -> None:
    answer = planetary(
        "inputs: {sun: 7}\noutputs: {rel: {of: planet, relative_to: carrier}, sun: ~, arm: {of: carrier}}"
    ).solve()
    assert answer["sun"] == 7
    assert answer["arm"] == 2
    # in the carrier's frame the sun makes 5 turns, and the planet -24/18 as many
    assert answer["rel"] == Fraction(-24, 18) * 5


def test_named_inputs_give_speeds_in_their_unit() -> None:
    train = pair("inputs: {a: 90 rpm}")
    assert train.declaration.unit_name == "rpm"
    assert train.solve()["b"] == -30
    assert train.solve().unit == "rpm"


def test_a_unit_names_what_one_turn_takes() -> None:
    train = pair("inputs: {a: 1}\nunit: {per: year_tropical_J2000}")
    assert train.declaration.unit_name == "turns per tropical year"
    assert train.declaration.unit_days == Fraction("365.242190402")
    assert pair("inputs: {a: 1}\nunit: {per: 7 d}").declaration.unit_days == 7
    assert pair("inputs: {a: 1}\nunit: {per: 12 h}").declaration.unit_days == Fraction(1, 2)
    assert pair("inputs: {a: 1}\nunit: {per: 18 ft}").declaration.unit_days is None


def test_a_speed_per_year_needs_a_unit_that_is_a_year() -> None:
    name = next(row.name for row in period_table().values() if row.kind == "speed")
    text = PAIR.format(rest=f"inputs: {{a: 1}}\nunit: {{per: %s}}\noutputs: {{b: {{targets: [{name}]}}}}")
    assert "the train's unit is not a year" in refusal(text % "1 d")
    assert load(text % "year_julian").solve().outputs["b"].targets[0].speed == period_table()[name].value


REFUSED = {
    "inputs: {a: 1}\noutputs: {%s}": [
        ("x: {}", "no link 'x'"),
        ("b: {relative_to: c}", "no link 'c'"),
        ("b: {dial: c}", "no dial 'c'"),
        ("b: {expect: one third}", "not a number"),
        ("b: {expect: 1/0}", "divides by zero"),
        ("b: {published: {value: 1, as: output/crank}}", "published"),
        ("b: {published: {value: 1, source: nobody}}", "no source 'nobody'"),
    ],
    "inputs: {%s}": [
        ("a: 2 mm", "a length, but a speed is required"),
        ("a: 2 furlongs", "unknown unit"),
        ("frame: 1", "the frame 'frame' is an input"),
        ("c: 1", "no link 'c'"),
    ],
    "inputs: {a: 1}\n%s": [
        ("crank: c", "no link 'c'"),
        ("unit: {per: 1 year}", "write `unit: {per: year_tropical_J2000}`"),
        ("unit: {per: 7}", "is not a unit"),
        ("unit: {per: month_synodic_j2000}", "did you mean 'month_synodic_J2000'"),
        ("unit: {per: 18 ft}\noutputs: {b: {targets: [{period: 3 d}]}}", "the train's unit is not a time"),
        ("view: {positive: up}", "positive"),
    ],
    "inputs: {a: 1}\nunit: {per: 1 d}\noutputs: {b: {targets: [%s]}}": [
        ("month_synodyc_J2000", "did you mean 'month_synodic_J2000'"),
        ("{name: month_synodic_J2000, period: 3 d}", "a target needs exactly one of its keys"),
        ("{turns: 3}", "a target needs exactly one of its keys"),
        ("{period: 29.5}", "no unit"),
        ("{period: 29.5 mm}", "the train's unit is not a length"),
        *((row.name, f"'{row.name}' is a count") for row in period_table().values() if row.kind == "count"),
    ],
    "inputs: {a: 1}\ntooth_form: {%s}": [
        ("form: square", "triangular"),
        ("half_angle: 30 deg", "form"),
        ("form: triangular, half_angle: 30, clearance_factor: 1.01", "no unit"),
        ("form: triangular, half_angle: 95 deg, clearance_factor: 1.01", "outside 0 to 90 deg"),
        ("form: triangular, half_angle: 30 deg, clearance_factor: 1.01, window: 0.5", "given 2 times"),
        ("form: triangular, half_angle: 30 deg", "given 0 times"),
    ],
}


@pytest.mark.parametrize(
    ("rest", "said"), [(rest % each, said) for rest, parts in REFUSED.items() for each, said in parts]
)
def test_what_makes_no_sense_is_refused(rest: str, said: str) -> None:
    assert said in refusal(PAIR.format(rest=rest))


@pytest.mark.parametrize(
    ("teeth", "said"),
    [
        ("{teeth: {value: 60, range: [61, 65]}}", "outside its range or choices"),
        ("{teeth: {value: 60, range: [65, 55]}}", "empty"),
        ("{teeth: {value: 60, choices: [50, 55]}}", "outside its range or choices"),
        ("{teeth: {value: 60, range: [59, 61], weights: [1, 2]}}", "2 weights are given for 3 counts"),
        ("{teeth: {range: [59, 61]}}", "no value"),
        ("{teeth: {search: [15, 80]}}", "wheel 'w' has no tooth count yet"),
        ("{teeth: {value: 0}}", "'0' is not a tooth count"),
        *((each, "not a tooth count") for each in ("20.0", "1e3", "true", "٣٤")),
    ],
)
def test_a_tooth_count_that_makes_no_sense_is_refused(teeth: str, said: str) -> None:
    assert said in refusal(PAIR.format(rest="inputs: {a: 1}").replace("w: 60", f"w: {teeth}"))


def test_the_view_is_counter_clockwise_unless_it_says_otherwise() -> None:
    assert pair().declaration.view.positive == "counter-clockwise"
    view = pair("inputs: {a: 1}\nview: {from: front, positive: clockwise}").declaration.view
    assert (view.from_, view.positive) == ("front", "clockwise")


def test_the_view_and_the_dial_never_change_a_sign() -> None:
    rest = "inputs: {a: 1}\nview: {from: back, positive: clockwise}\ndials: {d: {face: back, turns: 4, divisions: 223}}"
    train = pair(f"{rest}\noutputs: {{b: {{dial: d}}}}")
    assert train.solve()["b"] == Fraction(-1, 3)
    dial = train.declaration.dials["d"]
    assert (dial.face, dial.turns, dial.divisions) == ("back", 4, 223)


Refuse = Callable[..., GearTrainError]


@pytest.mark.parametrize(
    ("text", "said", "line"),
    [
        ("links: {frame: {}}\ncolour: red\n", "unknown key 'colour'", 2),
        ("frame: f\nlinks: {f: {}, a: {wheel: {p: 20}}}\n", "did you mean 'wheels'", 2),
        ("title: nothing else\n", "key 'links' is missing", 1),
    ],
)
def test_the_top_level_knows_its_keys(refused: Refuse, text: str, said: str, line: int) -> None:
    refused(text, said, line=line)


def test_a_tooth_form_may_be_named_alone() -> None:
    def read(form: object) -> object:
        pair = {"pair": ["p", "w"], "tooth_form": form}
        links = {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}}
        train = declare({"links": links, "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]}, "gears": [pair]})
        return train.gears[0].tooth_form

    kinds = [kind for kind in (getattr(teeth, name) for name in teeth.__all__) if hasattr(kind, "model_fields")]
    names = [get_args(kind.model_fields["form"].annotation)[0] for kind in kinds if "form" in kind.model_fields]
    assert len(names) >= 10
    for name in names:
        try:
            wanted = read({"form": name})
        except DeclarationError as error:
            with pytest.raises(DeclarationError, match=re.escape(error.problems[0].what)):
                read(name)
        else:
            assert read(name) == wanted
    with pytest.raises(DeclarationError, match="involute"):
        read("involut")


def test_a_tooth_form_that_was_just_read_can_be_written() -> None:
    """pydantic before 2.14 builds a member of a union without its serializer, and cannot write it."""
    code = """
import geartrain
form = geartrain.load("moon-triangular").declaration.tooth_form
print(type(type(form).__pydantic_serializer__).__name__)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "SchemaSerializer\n"
