"""What try.html shows, asked of Python as the page asks it: no numpy can be imported."""

from __future__ import annotations

import json
import subprocess
import sys
from fractions import Fraction
from functools import cache
from math import hypot
from pathlib import Path
from typing import Any

import pytest
import shipped
import try_page
import yaml
from places import train_files

import geartrain

ROOT = Path(__file__).parent.parent.parent
HEAVY = ("numpy", "scipy", "matplotlib", "pandas", "sympy", "shapely")
SCRIPT = f"""
import json, sys
for name in {HEAVY}:
    sys.modules[name] = None  # an import of it fails, as where it is not installed
sys.path.insert(0, {str(ROOT / "docs" / "scripts" / "site" / "try")!r})
import try_answer
try_answer.gather(sys.argv[1])
print(json.dumps([json.loads(try_answer.answer(text)) for text in json.load(sys.stdin)]))
"""


def answers(folder: Path, texts: list[str]) -> list[dict[str, Any]]:
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(folder)],
        input=json.dumps(texts),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return list(json.loads(done.stdout))


@cache
def texts() -> dict[str, str]:
    return {path.stem: path.read_text(encoding="utf-8") for path in train_files()}


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
    return dict(zip(texts(), answers(tmp_path_factory.mktemp("trains"), list(texts().values())), strict=True))


def test_every_shipped_train_is_answered_without_numpy(found: dict[str, dict[str, Any]]) -> None:
    assert set(found) == set(shipped.trains())
    for name, answer in found.items():
        assert "page" in answer, f"{name}: {answer['problems']}"
        assert "<script" not in answer["page"], name
        for link in answer["links"]:
            assert link in answer["page"], name


def test_what_a_train_expects_stands_on_its_dials(found: dict[str, dict[str, Any]]) -> None:
    """The figures are those that the declarations give, read here as plain YAML."""
    checked = 0
    for name, text in texts().items():
        for output, wanted in (yaml.safe_load(text).get("outputs") or {}).items():
            expect = str((wanted or {}).get("expect", ""))
            states = found[name]["states"]
            if not expect or len(states) > 1 or not expect.replace("/", "").lstrip("-").isdigit():
                continue
            dials = [each for each in states[0]["dials"] if each["name"] == str(output)]
            assert len(dials) == 1, f"{name} {output}"
            (dial,) = dials
            assert Fraction(dial["exact"]) == Fraction(expect), f"{name} {output}"
            assert dial["holds"] is True
            checked += 1
    assert checked > 150


def test_pitch_circles_of_wheels_that_mesh_touch_in_planetary_sets(found: dict[str, dict[str, Any]]) -> None:
    for name, pairs in {
        "planetary-24-18-60": [("s", "p"), ("p", "ring")],
        "longcase-clock": [],
        "strain-wave": [("spline", "ring")],
    }.items():
        at = {wheel["wheel"]: wheel for wheel in found[name]["plan"]["wheels"]}
        for one, other in pairs:
            a, b = at[one], at[other]
            ring = a["ring"] or b["ring"]
            wanted = abs(a["radius"] - b["radius"]) if ring else a["radius"] + b["radius"]
            assert hypot(a["x"] - b["x"], a["y"] - b["y"]) == pytest.approx(wanted, rel=1e-9), f"{name} {one} ~ {other}"


def test_equal_planets_are_all_drawn_and_turn(tmp_path: Path) -> None:
    text = texts()["planetary-24-18-60"].replace("planet:  {wheels: {p: 18}}", "planet:  {wheels: {p: 18}, copies: 4}")
    assert "copies" in text
    (answer,) = answers(tmp_path, [text])
    planets = [each for each in answer["plan"]["wheels"] if each["radius"] == 9]
    assert len(planets) == 4
    turns = answer["states"][0]["turns"]
    assert all(turns[each["link"]] == pytest.approx(-2 / 3) for each in planets)


def test_problems_have_their_lines(tmp_path: Path) -> None:
    lines = texts()["planetary-24-18-60"].splitlines()
    (at,) = [number for number, line in enumerate(lines, 1) if line.startswith("inputs:")]
    misspelt = "\n".join([*lines[: at - 1], "input: {sun: 1}", *lines[at:]])
    wrong = "\n".join(lines).replace("expect: 2/7", "expect: 3/7")
    empty, open_, no_mapping = "", "links: {", "a list\n- of words\n"
    first, second, *others = answers(tmp_path, [misspelt, wrong, empty, open_, no_mapping])
    (problem,) = [each for each in first["problems"] if "inputs" in each["fix"]]
    assert problem["line"] == at
    (failure,) = [each for each in second["problems"] if each["level"] == "error"]
    assert "2/7" in failure["what"]
    assert lines[failure["line"] - 1].lstrip().startswith("carrier:")
    assert not second["sound"]
    for answer in others:
        assert answer["problems"]
        assert not answer["sound"]


def test_an_example_that_extends_a_train_is_written_out_in_full(tmp_path: Path) -> None:
    path = geartrain.shipped()["freeth-2006"]
    full = try_page._example(path)["text"]
    assert "extends" in path.read_text(encoding="utf-8")
    assert "extends" not in full
    short, written = answers(tmp_path, [path.read_text(encoding="utf-8"), full])
    assert (written["verdict"], written["states"]) == (short["verdict"], short["states"])
