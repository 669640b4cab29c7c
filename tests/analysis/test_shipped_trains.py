"""Every shipped train keeps its promises."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
import yaml
from commands import call
from jsonschema import Draft202012Validator

from geartrain import load, shipped


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
