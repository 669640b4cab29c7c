"""Every shipped train keeps its promises."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
import yaml
from commands import call
from jsonschema import Draft202012Validator
from places import TRAINS, train_files
from shipped import train as load

from geartrain import GearTrain, shipped


@pytest.mark.parametrize("name", shipped())
def test_a_shipped_train_holds_all_it_expects_and_names_its_sources(name: str) -> None:
    train = load(name)
    assert train.name == name
    assert train.declaration.title
    assert train.declaration.sources
    for answer in train.answers():
        assert answer.verdict.kind == "determined"
        assert not answer.failures
        for result in answer.outputs.values():  # what is still to be found has a target to be met instead
            assert result.output.expect is not None or any(target.met for target in result.targets)


@pytest.mark.parametrize("name", shipped())
def test_floats_agree_with_exact_speeds_within_their_estimate(name: str) -> None:
    train = load(name)
    for answer in train.answers():
        floats = train.kinematics.floats(answer.state)
        for link, speed in answer.speeds.items():
            assert abs(Fraction(floats[link]) - Fraction(speed)) <= Fraction(float(floats.estimate[link][0]))


class Plain(yaml.SafeLoader):
    """Scalars as an editor's YAML 1.2 sees them, dates and sexagesimals left as text."""


Plain.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in found if tag.rsplit(":", 1)[1] in ("null", "float", "int")]
    for first, found in yaml.SafeLoader.yaml_implicit_resolvers.items()
    if first in "-+0123456789.~n"
}
Plain.add_implicit_resolver("tag:yaml.org,2002:bool", __import__("re").compile("^(true|false)$"), list("tf"))


def as_json(value: object) -> object:
    return json.loads(json.dumps(value))


def test_an_editor_accepts_every_shipped_train_and_refuses_a_slip() -> None:
    found = json.loads(call("inspect", "schema").stdout)
    Draft202012Validator.check_schema(found)
    validator = Draft202012Validator(found)
    for path in shipped().values():
        data = as_json(yaml.load(path.read_text(encoding="utf-8"), Plain))
        assert [error.message for error in validator.iter_errors(data)] == []
    assert not validator.is_valid({"links": {"frame": None}, "geers": []})
    assert not validator.is_valid({"links": {"a": {"wheels": {"w": "many"}}}})
    assert not validator.is_valid({"gears": []}), "a train that extends nothing has links"


def chain(train: GearTrain, teeth: dict[str, int]) -> Fraction:
    """Ratio of a simple chain of pairs, by magnitude: the product of driving over driven teeth."""
    ratio = Fraction(1)
    for gear in train.declaration.gears:
        ratio *= Fraction(teeth[gear.pair[0]], teeth[gear.pair[1]])
    return ratio


def test_what_turns_kinks_has_the_ratio_counted_by_hand() -> None:
    assert abs(Fraction(load("worm").solve()["wheel"])) == Fraction(2, 60)
    # Humpage: arm held, the casing makes -20/76 of the pinion, the output -(20/56)(24/35)
    arm = Fraction(20, 20 + 76)
    output = arm - Fraction(20, 56) * Fraction(24, 35) * (1 - arm)
    assert output == Fraction(17, 1176)
    assert (load("humpage").solve()["arm"], load("humpage").solve()["output"]) == (arm, output)
    train = load("lu-daolong-hodometer")
    teeth = {name: wheel.count or 0 for name, (_, wheel) in train.declaration.wheels.items()}
    (given,) = train.solve().ratios["upper"].values()
    assert abs(given) == chain(train, teeth)
    train = load("bevel-differential")
    for answer in train.answers():
        left, right, crown, shaft = (answer.speeds[link] for link in ("left", "right", "crown", "shaft"))
        assert left + right == 2 * crown
        assert abs(41 * crown) == abs(11 * shaft)
    assert len(train.states) == 4


def test_all_files_in_the_folder_of_trains_are_shipped_and_their_names_are_their_own() -> None:
    files = train_files()
    assert {path.stem: path.resolve() for path in files} == {name: path.resolve() for name, path in shipped().items()}
    assert len({path.stem for path in files}) == len(files)


TRIALS = ("pennestri-2002", "moon-triangular")  # of no reconstruction of its own
ANTIKYTHERA = sorted(path.stem for path in (TRAINS / "antikythera").glob("*.yaml"))


@pytest.mark.parametrize("name", [name for name in ANTIKYTHERA if not name.startswith(TRIALS)])
def test_a_reconstruction_says_of_each_wheel_whether_it_survives(name: str) -> None:
    wheels = load(name).declaration.wheels
    assert {wheel.status for _, wheel in wheels.values()} <= {"surviving", "reconstructed", "hypothetical"}


def test_thirty_gears_survive_and_no_reconstruction_has_more() -> None:
    surviving = {
        name: {wheel for wheel, (_, found) in load(name).declaration.wheels.items() if found.status == "surviving"}
        for name in ANTIKYTHERA
    }
    assert len(surviving["freeth-2021"]) == 30
    assert surviving["freeth-2008"] < surviving["freeth-2021"], (
        "what the rear mechanism leaves out is r1 and a contrate"
    )
    assert max(map(len, surviving.values())) == 30
    # what was found in 2005 is no guess: the counts of the four back trains that are said to survive
    wheels = load("freeth-2021").declaration.wheels
    assert [wheels[name][1].count for name in ("b1", "e3", "m1", "k1", "k2")] == [223, 223, 96, 50, 50]


def test_the_cosmos_has_the_wheels_of_the_rear_mechanism_and_those_of_the_planets() -> None:
    cosmos, rear = (load(name).declaration.wheels for name in ("freeth-2021", "freeth-2008"))
    assert len(cosmos) == 69
    shared = set(cosmos) & set(rear)
    assert {name: cosmos[name][1].count for name in shared} == {name: rear[name][1].count for name in shared}
    assert len(shared) == len(rear)
