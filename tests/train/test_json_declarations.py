"""JSON files are declarations too: the YAML parser reads them, with the line of every value."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from shipped import every_train

from geartrain import GearTrain, GearTrainError, load, shipped

PAIR: dict[str, Any] = {
    "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": {"teeth": 60, "internal": True}}}},
    "revolutes": [{"pair": ["frame", "a"], "axis": "Ä"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"]}],
    "inputs": {"a": 1},
}


@pytest.mark.parametrize("name", every_train())
def test_a_shipped_train_written_as_json_is_the_same_train(name: str, tmp_path: Path) -> None:
    data = yaml.safe_load(shipped()[name].read_text(encoding="utf-8"))
    if (parent := shipped()[name].with_name(data.get("extends", "none"))).is_file():
        data["extends"] = str(parent)
    file = tmp_path / "train.json"
    file.write_text(json.dumps(data, indent=1, default=str, ensure_ascii=False), encoding="utf-8")
    read, shipped_one = load(file), load(name)
    assert (read.circuits, read.kinematics.cases.keys()) == (shipped_one.circuits, shipped_one.kinematics.cases.keys())


@pytest.mark.parametrize("style", [{}, {"indent": "\t"}, {"indent": 2, "ensure_ascii": False}])
def test_json_may_be_indented_by_tabs_and_hold_escapes(style: Any, tmp_path: Path) -> None:
    file = tmp_path / "pair.json"
    file.write_text(json.dumps(PAIR, **style), encoding="utf-8")
    assert load(file).solve().speeds == GearTrain.declare(PAIR).solve().speeds
    assert load(file).declaration.revolutes[0].axis == "Ä"


def test_a_problem_in_json_is_reported_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "pair.json"
    file.write_text(json.dumps(PAIR | {"input": {}}, indent=1), encoding="utf-8")
    line = file.read_text(encoding="utf-8").splitlines().index(' "input": {}') + 1
    with pytest.raises(GearTrainError, match=f"pair.json:{line}: unknown key 'input'"):
        load(file)
