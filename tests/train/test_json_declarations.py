"""JSON files are read by `json`, and give what the YAML parser gives for the same text: the same train, or errors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from shipped import every_train
from studies.train_families import chain

from geartrain import GearTrain, GearTrainError, load, shipped
from geartrain.train import declaration_files

PAIR: dict[str, Any] = {
    "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": {"teeth": 60, "internal": True}}}},
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"]}],
    "inputs": {"a": 1},
}
GOOD = "{\n" + ",\n".join(f" {json.dumps(key)}: {json.dumps(value)}" for key, value in PAIR.items()) + "\n}\n"


def outcome(text: str, file: Path) -> Any:
    """The declaration and some of its places, or the error; without the name of the file."""
    file.write_text(text, encoding="utf-8")
    try:
        train = load(file).declaration
    except GearTrainError as error:
        return str(error).replace(file.name, "FILE")
    places = [train.place(*loc) for loc in ((), ("links",), ("gears", 0), ("links", "b", "wheels", "w"), ("nothing",))]
    return train.model_dump(), [place.replace(file.name, "FILE") for place in places]


def count_parses(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the files that the YAML parser reads from now on."""
    met: list[str] = []

    def count(text: str, name: str) -> Any:
        met.append(Path(name).name)
        return parse(text, name)

    parse = declaration_files.parse_yaml
    monkeypatch.setattr(declaration_files, "parse_yaml", count)
    return met


@pytest.mark.parametrize("name", every_train())
def test_a_shipped_train_written_as_json_is_read_as_yaml_is(name: str, tmp_path: Path) -> None:
    data = yaml.safe_load(shipped()[name].read_text(encoding="utf-8"))
    text = json.dumps(data, indent=1, default=str, ensure_ascii=False)
    expected = outcome(text, tmp_path / "train.yaml")
    assert outcome(text, tmp_path / "train.json") == expected


CHANGES = {
    "as it is": ("", ""),
    "one line": (GOOD, json.dumps(PAIR)),
    "tabs": ("\n ", "\n\t"),
    "a key twice": ('"p": 20', '"p": 20,\n"p": 21'),
    "a link twice": ('"frame": {},', '"frame": {}, "frame": {},'),
    "not a number": ('"a": 1', '"a": NaN'),
    "infinity": ('"p": 20', '"p": Infinity'),
    "a big integer": ('"a": 1', '"a": 1' + "0" * 5000),
    "more teeth than allowed": ('"p": 20', f'"p": {10**30}'),
    "an exponent": ('"a": 1', '"a": 1.50E+2'),
    "minus zero": ('"a": 1', '"a": -0'),
    "null": ('"a": 1', '"a": null'),
    "a text": ('"a": 1', '"a": "1/3 rpm"'),
    "a boolean": ('"p": 20', '"p": true'),
    "a boolean in a list": ('["p", "w"]', '["p", true]'),
    "a float for teeth": ('"p": 20', '"p": 20.5'),
    "an unknown key": ('"inputs"', '"input"'),
    "an unknown wheel": ('["p", "w"]', '["p", "v"]'),
    "a list for a pair": ('{"pair": ["p", "w"]}', '["p", "w"]'),
    "a short form": ('"gears": [', '"gears": ["p ~ w"], "x": ['),
    **{f"{depth} lists": ('"a": 1', f'"a": {"[" * depth + "]" * depth}') for depth in (40, *range(29, 33))},
    "nested far too deeply": ('"a": 1', f'"a": {"[" * 5000}'),
    "a missing brace": ('"inputs": {', '"inputs": {{'),
    "a trailing comma": ('"a": 1', '"a": 1,'),
    "a comment": ('"inputs"', "# here\n" + '"inputs"'),
    "two documents": (GOOD, GOOD + "\n---\n" + GOOD),
    "a list": (GOOD, "[1, 2]"),
    "a number": (GOOD, "12"),
    "nothing": (GOOD, ""),
    "an escape": ('"a": {', '"\\u0061": {'),
    "umlauts": ('"A"', '"Ä"'),
    "a control character": ('"A"', '"A\x7f"'),
    "a parent": ('"inputs"', '"extends": "planetary-24-18-60", "inputs"'),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_json_file_has_the_train_or_the_errors_that_yaml_has(change: str, tmp_path: Path) -> None:
    old, new = CHANGES[change]
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    expected = outcome(text, tmp_path / "train.yaml")
    assert outcome(text, tmp_path / "train.json") == expected


def test_the_yaml_parser_reads_no_json_file_that_can_be_solved(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    met, file = count_parses(monkeypatch), tmp_path / "chain.json"
    data = chain(2000)
    file.write_text(json.dumps(data, indent=1))
    train = load(file)
    assert train.solve().speeds == GearTrain.declare(data).solve().speeds
    assert met == []
    line = file.read_text().splitlines().index('  "g0": 1') + 1
    assert train.declaration.place("inputs", "g0") == f"{file}:{line}"
    assert train.declaration.place("links") == f"{file}:2"
    assert met == ["chain.json"], "places are found once"
