"""Examples of the reference: each one loads and is as declared, and every key has one."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from commands import call
from places import DOCS

from geartrain import load
from geartrain.search.reconstruct import read_evidence
from geartrain.train.examples import examples

TEXTS = [pytest.param(text, id=f"{part} {at}") for part, texts in examples().items() for at, text in enumerate(texts)]
PAGE = (DOCS / "reference.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def schema() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(call("inspect", "schema").stdout)
    return found


@pytest.mark.parametrize("text", TEXTS)
def test_every_example_loads_and_meets_its_expectations(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheel.csv").write_text("tooth,angle\n" + "".join(f"{n},{60 * n}\n" for n in range(6)))
    if "reconstruct:" in text:
        assert read_evidence(f"{text}\n").reconstruct is not None
    else:
        assert all(load(f"{text}\n").answers())


def test_the_page_prints_the_examples() -> None:
    blocks = re.findall(r"^```yaml\n(.*?)\n```$", PAGE, re.MULTILINE | re.DOTALL)
    assert sorted(blocks) == sorted(texts[0].rstrip() for texts in examples().values())


def test_every_key_has_an_example_that_its_schema_accepts(schema: dict[str, Any]) -> None:
    jsonschema = pytest.importorskip("jsonschema")
    for name, part in {"Train": schema, **schema["$defs"]}.items():
        for options in (part, *part.get("anyOf", ())):
            for key, shape in options.get("properties", {}).items():
                (value,) = shape["examples"]
                errors = jsonschema.Draft202012Validator({"$defs": schema["$defs"], **shape}).iter_errors(value)
                assert list(errors) == [], f"{name}.{key}: {value}"


def test_every_line_of_the_tables_is_yaml_of_one_key() -> None:
    lines = re.findall(r"^\| `((?:[^`|])+)` \|", PAGE, re.MULTILINE)
    units = re.findall(r"^\| [a-z ]+ \| `", PAGE, re.MULTILINE)
    assert len(lines) > 280
    assert len(units) > 10
    for line in lines:
        assert len(yaml.load(line, yaml.BaseLoader)) == 1, line
    assert not re.findall(r"\} \|", PAGE), "Markdown reads braces at the end of a cell as its attributes"
