"""The command, as its user meets it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import networkx as nx
import pytest
from typer.testing import CliRunner, Result

from geartrain.cli import app
from geartrain.cli.common import NOT_USABLE

DOCS = Path(__file__).parent.parent / "docs"
VERBS = ("report", "compare", "check", "solve", "equations", "graph", "schema", "list", "periods", "bench")

LOCKED = """
links: {frame: {}, a: {wheels: {x: 20}}, b: {wheels: {y: 30}}, c: {wheels: {z: 40}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [x, y]}, {pair: [y, z]}, {pair: [z, x]}]
inputs: {a: 1}
"""
WRONG = LOCKED.replace(", {pair: [z, x]}", "") + "outputs:\n  c: {expect: 1/3}\n"
RIGHT = WRONG.replace("1/3", "1/2")
UNUSABLE = RIGHT.replace("gears:", "geers:")

# pennestri-2002, Table 4, as fractions
TWENTY = (
    *("0", "5", "-1", "-1", "254/19", "16/9", "-1", "1/4", "-1/2", "32/19"),
    *("-64/19", "-254/19", "-197/76", "-254/19", "1", "470/19", "-235/19", "235/57", "-235/228", "-235/38"),
)


def call(*arguments: object) -> Result:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def process(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "geartrain", *map(str, arguments)], capture_output=True, text=True, check=False
    )


@pytest.fixture
def file(tmp_path: Path):
    def write(text: str, name: str = "t.yaml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_has_help_and_a_place_in_the_docs(verb: str) -> None:
    result = call(verb, "--help")
    assert result.exit_code == 0
    assert "Usage" in result.output
    assert f"geartrain {verb}" in (DOCS / "commands.md").read_text(encoding="utf-8")


def test_the_version_is_the_packages() -> None:
    from importlib.metadata import version

    assert call("--version").output.strip() == f"geartrain {version('geartrain')}"


@pytest.mark.parametrize("verb", ["report", "check", "solve", "compare"])
@pytest.mark.parametrize(("text", "code"), [(RIGHT, 0), (LOCKED, 1), (WRONG, 1)])
def test_exit_codes_tell_a_sound_train_from_a_verdict(file, verb: str, text: str, code: int) -> None:
    assert call(verb, file(text)).exit_code == code


@pytest.mark.parametrize("verb", ["report", "check", "solve", "compare", "equations", "graph"])
def test_unusable_input_is_said_on_standard_error_with_its_line_and_without_a_traceback(file, verb: str) -> None:
    path = file(UNUSABLE)
    done = process(verb, path)
    assert done.returncode == NOT_USABLE
    assert f"{path}:4: unknown key 'geers'" in done.stderr
    assert "did you mean 'gears'?" in done.stderr
    assert "Traceback" not in done.stderr


def test_check_tells_about_every_file_and_returns_the_worst(file) -> None:
    good, bad, worse = file(RIGHT, "good.yaml"), file(WRONG, "bad.yaml"), file(UNUSABLE, "worse.yaml")
    done = process("check", bad, worse, good)
    assert done.returncode == 2
    assert f"FAIL {bad}:7: output 'c' is 1/2; expected 1/3" in done.stdout
    assert f"ok   {good}" in done.stdout
    assert str(worse) in done.stderr
    assert process("check", bad, good).returncode == 1


def test_solve_prints_the_twenty_speeds_of_the_paper_as_json() -> None:
    data = json.loads(call("solve", "pennestri-2002", "--json").output)
    assert set(data) == {"name", "title", "unit", "mobility", "state", "verdict", "method", "speeds", "outputs"}
    assert [speed["exact"] for speed in data["speeds"].values()] == list(TWENTY)
    assert [float(Fraction(text)) for text in TWENTY] == [speed["value"] for speed in data["speeds"].values()]
    assert data["verdict"]["kind"] == "determined"
    assert data["mobility"]["by_rank"] == data["mobility"]["by_count"] == 1
    assert {"exact", "value", "expect", "targets"} <= set(data["outputs"]["moon"])


def test_states_stand_side_by_side_and_one_can_be_asked_for() -> None:
    data = json.loads(call("solve", "zf-8hp70", "--json").output)
    assert Fraction(data["states"]["5"]["speeds"]["OUT"]["exact"]) == Fraction(6871, 8826)
    one = json.loads(call("solve", "zf-8hp70", "--json", "--state", "5").output)
    assert one["speeds"] == data["states"]["5"]["speeds"]


def test_one_output_is_solved_alone() -> None:
    result = call("solve", "pennestri-2002", "--output", "moon")
    assert result.exit_code == 0
    assert "254/19" in result.output
    assert "235/57" not in result.output


def test_floats_show_an_estimate_that_covers_their_true_error() -> None:
    data = json.loads(call("solve", "two-k-h-10000", "--method", "floats", "--json").output)
    assert data["method"] == "floats"
    for speed in data["speeds"].values():
        assert speed["exact"] is None
        assert speed["true_error"] <= speed["estimate"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["solve", "pennestri-2002", "--output", "mooon"], "did you mean 'moon'?"),
        (["solve", "zf-8hp70", "--state", "9"], "no state '9'"),
        (["solve", "nowhere.yaml"], "no such file"),
        (["periods", "no such word"], "no name contains"),
    ],
)
def test_a_question_that_has_no_answer_is_refused_kindly(arguments: list[str], said: str) -> None:
    done = process(*arguments)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["solve", "pennestri-2002", "--method", "guess"],
        ["graph", "pennestri-2002", "--as", "poem"],
        ["report", "pennestri-2002", "-o", "x.pdf"],
        ["compare", "pennestri-2002", "-o", "x.pdf"],
        ["schema", "--as", "poem"],
        ["bench", "kinematics", "--family", "poem"],
    ],
)
def test_a_form_that_does_not_exist_is_refused(arguments: list[str]) -> None:
    assert call(*arguments).exit_code == 2


def test_equations_name_every_circuit_as_text_and_latex() -> None:
    text, latex = call("equations", "pennestri-2002").output, call("equations", "pennestri-2002", "--latex").output
    for at in range(1, 19):
        assert any(line.startswith(f"G{at} ") for line in text.splitlines())
        assert f"\\text{{G{at}}}" in latex
    assert "32 w[12] + 64 w[13] - 96 w[20] = 0" in text


def test_graphs_are_read_back_by_other_readers(tmp_path: Path) -> None:
    call("graph", "pennestri-2002", "-o", tmp_path / "g.graphml")
    graph = nx.read_graphml(tmp_path / "g.graphml")
    assert (graph.number_of_nodes(), graph.number_of_edges()) == (20, 37)
    data = json.loads(call("graph", "pennestri-2002", "--as", "json").output)
    assert sum(edge["kind"] == "gear" for edge in data["edges"]) == 18
    matrix = json.loads(call("graph", "pennestri-2002", "--as", "matrix").output)
    assert sum(map(sum, matrix["values"])) == 2 * 37
    dot = call("graph", "pennestri-2002", "--as", "dot").output
    assert dot.count(" -- ") == 37


def test_the_shipped_trains_and_periods_are_listed() -> None:
    listing = call("list").output
    assert all(name in listing for name in ("pennestri-2002", "freeth-2021", "zf-8hp70", "prague-orloj"))
    assert "29.530588853" in call("periods", "month_synodic_J2000").output


def test_a_pipe_that_closes_early_ends_quietly() -> None:
    command = f"{sys.executable} -m geartrain report freeth-2021 | head -n 1"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False, env=os.environ)
    assert done.stdout.startswith("# ")
    assert "Traceback" not in done.stderr
