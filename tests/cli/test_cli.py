"""The command: every verdict through `main`, keys by name, equations solved, graphs and schema read back."""

from __future__ import annotations

import csv
import inspect
import itertools
import json
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from commands import LOCKED, RIGHT, TWENTY, UNUSABLE, WRONG, ended, functions, verbs
from jsonschema import Draft202012Validator
from pennestri import TABLES_1_TO_3, TURNING_PAIRS
from places import ROOT, train_files
from shipped import every_train

from geartrain import load

COMMANDS = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")

# a wheel pair of its own beside the one that is driven: the train is free, its output is not
FREE = """
links: {frame: {}, a: {wheels: {x: 20}}, b: {wheels: {y: 60}}, c: {wheels: {u: 7}}, d: {wheels: {v: 9}}}
revolutes:
  [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}, {pair: [frame, d], axis: D}]
gears: [{pair: [x, y]}, {pair: [u, v]}]
inputs: {a: 1}
outputs: {b: {expect: -1/3}, d: {}}
"""
CONTRADICTORY = RIGHT.replace("inputs: {a: 1}", "inputs: {a: 1, b: 1}").replace("{expect: 1/2}", "{}")
LOCKED_POINTER = LOCKED + "outputs: {c: {}}\n"
PUBLISHED = RIGHT.replace("{expect: 1/2}", "{published: {value: 2.1, as: input/output}}")

Write = Callable[..., Path]


def run(*arguments: object) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of the console script."""
    done = ended(*arguments)
    return done.returncode, done.stdout, done.stderr


# ---------------------------------------------------------------------------------------------------------------- help


@pytest.mark.parametrize("verb", [name for name, _ in verbs() if name])
def test_every_verb_that_exists_has_help_and_every_option_of_it_is_in_the_docs(verb: str) -> None:
    code, out, _ = run(*verb.split(), "--help")
    assert code == 0
    assert f"geartrain {verb}" in out
    head = f"## geartrain {verb}\n"
    assert head in COMMANDS
    section = COMMANDS.split(head)[1].split("\n## ")[0]
    command = dict(verbs())[verb]
    assert inspect.cleandoc(command.help).splitlines()[0] in section
    for option in command.params:
        names = [name for name in option.opts if name.startswith("-") and name not in ("-h", "--help")]
        assert all(f"`{name}`" in section for name in names), names
        assert all(name in out for name in names), names
        assert option.name == "help" or option.help, f"{option.name} has a help text"


@pytest.mark.parametrize("verb", [name for name, _ in functions()])
def test_the_example_of_every_command_is_one_of_its_command_lines(verb: str) -> None:
    command = dict(verbs())[verb]
    (example,) = re.findall(r"Example: `geartrain ([^`]*)`", command.help)
    assert example.startswith(f"{verb} ")
    command.make_context(verb, shlex.split(example)[len(verb.split()) :])


def test_usage_names_the_command_as_it_was_started(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the script, or by `python -m geartrain` where there is none on the path; never by what called it in Python."""
    monkeypatch.setattr(sys.modules["__main__"], "__package__", "pytest", raising=False)
    assert "Usage: geartrain solve" in run("solve", "--help")[1]
    command = [sys.executable, "-m", "geartrain", "solve", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "Usage: python -m geartrain solve" in done.stdout


def test_a_command_without_a_verb_shows_its_help_and_a_misspelt_verb_is_corrected() -> None:
    code, out, err = run()
    assert code == 2
    assert "Usage: geartrain" in out + err
    code, out, err = run("reprot", "worm")
    assert (code, out) == (2, "")
    assert "'report'" in err


# ---------------------------------------------------------------------------------------------------------- exit codes


@pytest.mark.parametrize("verb", ["report", "check", "solve", "compare"])
@pytest.mark.parametrize(
    ("text", "kind", "code"),
    [
        (RIGHT, "determined", 0),
        (FREE, "free", 1),
        (LOCKED_POINTER, "locked", 1),
        (CONTRADICTORY, "contradictory", 1),
        (WRONG, "FAIL", 1),
        (PUBLISHED, "FAIL", 1),
    ],
)
def test_a_verdict_is_a_result_on_standard_output(
    train_file: Write, verb: str, text: str, kind: str, code: int
) -> None:
    ended, out, err = run(verb, train_file(text))
    assert (ended, err) == (code, "")
    assert code == 0 or kind in out


@pytest.mark.parametrize("verb", ["report", "check", "solve", "compare", "inspect equations", "inspect graph"])
def test_a_missing_or_unusable_file_has_no_result_and_a_reason_with_its_line(train_file: Write, verb: str) -> None:
    path = train_file(UNUSABLE)
    for file, *said in (
        ("penestri-2002.yaml", "the file does not exist", "pennestri-2002"),
        (path, f"{path}:3: unknown key 'geers'", "did you mean 'gears'?"),
    ):
        code, out, err = run(*verb.split(), file)
        assert (code, out) == (2, "")
        assert all(part in err for part in said)
        assert "Traceback" not in err


@pytest.mark.parametrize("verb", ["report", "compare"])
def test_all_unusable_files_are_told_at_once(train_file: Write, verb: str) -> None:
    first, second = train_file(UNUSABLE, "first.yaml"), train_file("links: []\n", "second.yaml")
    code, out, err = run(verb, first, "worm", second)
    assert (code, out) == (2, "")
    assert f"{first}:3" in err
    assert f"{second}:1" in err


def test_check_returns_the_worst_whatever_the_order(train_file: Write) -> None:
    codes = {
        train_file(RIGHT, "0.yaml"): 0,
        train_file(WRONG, "1.yaml"): 1,
        train_file(UNUSABLE, "2.yaml"): 2,
        train_file(LOCKED, "3.yaml"): 1,
    }
    for size in (1, 2, 4):
        for chosen in itertools.permutations(codes, size):
            code, out, err = run("check", *chosen)
            assert code == max(codes[path] for path in chosen)
            assert all(str(path) in (err if codes[path] == 2 else out) for path in chosen)


def test_a_quiet_check_says_nothing_of_what_is_right(train_file: Write) -> None:
    assert run("check", "--quiet", train_file(RIGHT), "pennestri-2002") == (0, "", "")
    code, out, _ = run("check", "--quiet", train_file(WRONG), "pennestri-2002")
    assert code == 1
    assert [line.split(" ")[0] for line in out.splitlines()] == ["FAIL"]


def test_check_names_the_state_that_fails(train_file: Write) -> None:
    child = train_file("extends: planetary\nstates: {ring fixed: {outputs: {carrier: {expect: 3/7}}}}\n")
    code, out, _ = run("check", child)
    assert code == 1
    assert f"FAIL {child}:2: state ring fixed output 'carrier' is 2/7; expected 3/7" in out
    assert out.count("FAIL") == 1


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_a_full_disk_behind_standard_output_is_no_verdict_and_no_traceback() -> None:
    with open("/dev/full", "w", encoding="utf-8") as full:
        command = [sys.executable, "-m", "geartrain", "report", "pennestri-2002"]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert "Traceback" not in done.stderr
    assert done.returncode == 2


# --------------------------------------------------------------------------------------------------------------- solve

TOP = {"name", "title", "unit", "mobility", "states"}
ANSWER = {"state", "verdict", "method", "speeds", "outputs"}
VERDICT = {"kind", "text", "links", "fixes", "prescriptions", "loops"}
MOBILITY = {"by_count", "by_rank", "rank", "redundant", "redundant_loops", "locked_loops", "still", "never_rolling"}
OUTPUT = {"exact", "value", "of", "relative_to", "output/input", "period_s", "expect", "published", "targets"}
TARGET = {"target", "speed", "compared", "ppm", "days_per_century", "degrees_per_unit", "met"}
TARGET |= {"seconds_per_day", "seconds_per_year", "days_to_one_day"}
REPORT = {"closure", "build_findings", "gridlock", "sources", "circuits", "adjacency", "remarks", "sensitivity"}
REPORT |= {"teeth", "pins", "couplings", "torques", "timekeeping", "strength", "motion", "errata"}


def check_answer(answer: Mapping[str, Any]) -> None:
    assert set(answer) == ANSWER
    assert set(answer["verdict"]) == VERDICT
    for speed in answer["speeds"].values():
        assert set(speed) == {"exact", "value"}
        assert float(Fraction(speed["exact"])) == speed["value"]
    for output in answer["outputs"].values():
        assert set(output) == OUTPUT
        assert output["expect"] is None or set(output["expect"]) == {"value", "holds"}
        assert output["published"] is None or set(output["published"]) == {"value", "as", "place", "found", "holds"}
        assert all(set(target) == TARGET for target in output["targets"])


def test_every_key_of_the_json_is_the_promised_one() -> None:
    whole = json.loads(run("solve", "pennestri-2002", "--json")[1])
    assert set(whole) == TOP
    assert set(whole["mobility"]) == MOBILITY
    (data,) = whole["states"]
    assert data["state"] is None
    check_answer(data)
    assert list(data["speeds"]) == [str(link) for link in range(1, 21)]
    assert [Fraction(speed["exact"]) for speed in data["speeds"].values()] == [Fraction(text) for text in TWENTY]
    shifts = json.loads(run("solve", "zf-8hp70", "--json")[1])
    assert set(shifts) == TOP
    assert [answer["state"] for answer in shifts["states"]] == ["1", "2", "3", "4", "5", "6", "7", "8", "R"]
    for answer in shifts["states"]:
        check_answer(answer)
    locked = json.loads(run("solve", "four-gear-loop", "--json")[1])
    for loop in locked["mobility"]["redundant_loops"]:
        assert set(loop) == {"carrier", "links", "pairs", "product"}
    assert locked["mobility"]["redundant_loops"], "four wheels in a ring repeat one circuit"


def test_the_json_of_one_output_or_state_leaves_out_what_was_not_requested() -> None:
    data = json.loads(run("solve", "pennestri-2002", "--of", "moon", "--json")[1])
    assert (set(data), data["mobility"]) == (TOP, None)
    (answer,) = data["states"]
    assert set(answer["outputs"]) == {"moon"}
    check_answer(answer)
    for more, states in ((("--state", "R"), ["R"]), (("--of", "OUT"), [*"12345678R"])):
        data = json.loads(run("solve", "zf-8hp70", *more, "--json")[1])
        assert set(data) == TOP
        assert [answer["state"] for answer in data["states"]] == states


def test_the_json_of_reports_has_the_promised_keys() -> None:
    (data,) = json.loads(run("report", "pennestri-2002", "--json")[1])
    assert set(data) == TOP | REPORT
    assert [c["carrier"] for c in data["circuits"]] == [line.split()[3] for line in TABLES_1_TO_3.strip().splitlines()]
    both = json.loads(run("compare", "worm", "zf-8hp70", "--json")[1])
    assert [set(train) for train in both] == [TOP | REPORT, TOP | REPORT]


def test_the_json_of_a_free_train_leaves_out_what_is_undetermined(train_file: Write) -> None:
    code, out, _ = run("solve", train_file(FREE), "--json")
    (data,) = json.loads(out)["states"]
    assert code == 1
    assert data["verdict"]["kind"] == "free"
    assert set(data["verdict"]["links"]) == {"c", "d"}
    assert set(data["speeds"]) == {"frame", "a", "b"}
    assert (data["outputs"]["d"]["exact"], data["outputs"]["d"]["value"]) == (None, None)


def test_a_pointer_is_solved_without_what_does_not_drive_it(train_file: Write) -> None:
    path = train_file(FREE)
    assert run("solve", path)[0] == 1
    code, out, _ = run("solve", path, "--of", "b")
    assert code == 0
    assert "-1/3" in out
    assert run("solve", path, "--of", "d")[0] == 1


def test_a_part_of_the_work_gives_the_same_number_for_every_pointer_of_the_cosmos() -> None:
    train = load("freeth-2021")
    whole = train.solve()
    works = {}
    for name, result in whole.outputs.items():
        answer = train.solve(output=name)
        assert answer[name] == result.speed, name
        works[name] = answer.work
    assert max(works.values()) < whole.work == len(train.circuits)
    assert works["crank"] == 1, "the crank is one pair away from b1"


def test_one_state_is_the_same_alone_and_among_all() -> None:
    every = run("solve", "zf-8hp70")[1]
    alone = [run("solve", "zf-8hp70", "--state", state)[1] for state in load("zf-8hp70").states]
    assert every == "".join(alone)
    assert len(alone) == 9


def test_printed_floats_come_with_an_estimate_and_a_true_error_that_is_true() -> None:
    (data,) = json.loads(run("solve", "pennestri-2002", "--method", "floats", "--json")[1])["states"]
    assert data["method"] == "floats"
    for speed, right in zip(data["speeds"].values(), TWENTY, strict=True):
        error = abs(Fraction(speed["value"]) - Fraction(right))
        assert speed["exact"] is None
        assert speed["true_error"] == float(error)
        assert error <= Fraction(speed["estimate"])
    _, out, _ = run("solve", "pennestri-2002", "--method", "floats")
    rows = re.findall(r"^  (\d+) .*estimate (\S+), true error (\S+)$", out, re.M)
    assert [row[0] for row in rows] == [str(link) for link in range(1, 21)]
    for link, estimate, error in rows:
        assert f"{data['speeds'][link]['estimate']:.1e}" == estimate
        assert f"{data['speeds'][link]['true_error']:.1e}" == error
    assert "estimate" not in run("solve", "pennestri-2002", "--method", "exact")[1]


# ----------------------------------------------------------------------------------------------------------- equations

Row = dict[str, Fraction]


def text_rows(text: str) -> Iterator[tuple[str, Row, Fraction]]:
    """Rows `label  3 w[a] - 2 w[b] = 0` as the label, coefficients and right side."""
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            label, body = re.split(r"\s{2,}", line, maxsplit=1)
            left, right = body.rsplit(" = ", 1)
            terms = re.findall(r"([+-]?)\s*(\d*(?:/\d+)?)\s*w\[([^]]+)\]", left)
            yield label, _row(terms), Fraction(right)


def latex_rows(text: str) -> Iterator[tuple[str, Row, Fraction]]:
    r"""Rows `3 \omega_{\text{a}} &= 0 && \text{label} \\`; fractions are \tfrac{a}{b}."""
    for line in text.splitlines():
        if "&=" in line:
            left, rest = line.split("&=")
            right, label = rest.removesuffix("\\\\").split("&&")
            terms = re.findall(r"([+-]?)\s*(\d*)\s*\\omega_\{\\text\{([^}]+)\}\}", left)
            yield _untext(label.strip()[6:].strip().removesuffix("}")), _row(terms), Fraction(right.strip())


def _untext(text: str) -> str:
    return text.replace("\\textasciitilde{}", "~").replace("\\_", "_")


def _row(terms: list[tuple[str, str, str]]) -> Row:
    row: Row = {}
    for sign, size, link in terms:
        row[_untext(link)] = row.get(_untext(link), Fraction(0)) + Fraction(size or 1) * (-1 if sign == "-" else 1)
    return row


@pytest.mark.parametrize("name", every_train())
def test_the_printed_equations_hold_every_pair_and_are_satisfied_by_the_speeds(name: str) -> None:
    train = load(name)
    if train.declaration.slides:
        pytest.skip("equations contain the symbol π")
    answers = list(train.answers())
    blocks = run("inspect", "equations", name)[1].split("\n\n")
    assert len(blocks) == len(answers)
    for answer, block in zip(answers, blocks, strict=True):
        rows = list(text_rows(block))
        assert answer.state is None or block.startswith(f"# state {answer.state}\n")
        labels = [label for label, _, _ in rows]
        rows_of = (row for coupling in train.declaration.couplings for row in coupling.row_names)
        for pair in (*(gear.name for gear in train.declaration.gears), *rows_of):
            assert labels.count(pair) == 1
        assert len(rows) >= len(train.declaration.links), "as many equations as unknowns"
        for label, row, right in rows:
            assert sum(value * answer.speeds[link] for link, value in row.items()) == right, label


@pytest.mark.parametrize("name", ["pennestri-2002", "humpage", "freeth-2021", "wolfrom-175"])
def test_latex_says_the_same_as_text(name: str) -> None:
    latex = run("inspect", "equations", name, "--latex")[1]
    rows = list(latex_rows(latex))
    assert rows == list(text_rows(run("inspect", "equations", name)[1]))
    assert len(rows) > len(load(name).circuits)
    assert latex.count("\\begin{align}") == latex.count("\\end{align}") == 1
    assert latex.count("{") == latex.count("}")


def test_latex_escapes_names_that_mean_something_there(train_file: Write) -> None:
    text = RIGHT.replace("b: {wheels", '"b_1 & 5%#$": {wheels').replace("frame, b]", 'frame, "b_1 & 5%#$"]')
    _, out, _ = run("inspect", "equations", train_file(text), "--latex")
    assert "\\text{b\\_1 \\& 5\\%\\#\\$}" in out


# --------------------------------------------------------------------------------------------------------------- graph


def test_a_large_train_is_listed_by_its_edges_unless_the_square_is_requested(train_file: Write) -> None:
    """Rows of wheels, one twice as long as the other: the list doubles, the square is four times as large."""
    sizes: dict[str, list[int]] = {"": [], "labels": []}
    for count in (60, 120):
        wheels = range(count)
        data = {
            "links": {"frame": {}} | {f"g{at}": {"wheels": {f"w{at}": 20}} for at in wheels},
            "revolutes": [{"pair": ["frame", f"g{at}"], "axis": f"A{at}"} for at in wheels],
            "gears": [{"pair": [f"w{at}", f"w{at + 1}"]} for at in wheels[:-1]],
        }
        file = train_file(json.dumps(data), f"row{count}.yaml")
        for form, found in sizes.items():
            code, told, _ = run("inspect", "graph", file, *(["--as", form] if form else []))
            assert code == 0
            found.append(len(told))
        _, told, _ = run("inspect", "graph", file)
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in told.splitlines() if " | g" in line]
        joints = [["frame", f"g{at}", "revolute", f"A{at}"] for at in wheels]
        pairs = [[f"g{at}", f"g{at + 1}", "gear", f"w{at}~w{at + 1}"] for at in wheels[:-1]]
        assert sorted(rows) == sorted(joints + pairs)
    assert sizes[""][1] < 2.2 * sizes[""][0]
    assert sizes["labels"][1] > 3.5 * sizes["labels"][0]


def paper_edges() -> dict[frozenset[str], tuple[str, str]]:
    """Edges of the paper by their two links: the kind and the label."""
    edges = {frozenset(map(str, pair)): ("revolute", str(axis)) for pair, axis in TURNING_PAIRS.items()}
    for line in TABLES_1_TO_3.strip().splitlines():
        name, i, j, *_ = line.split()
        edges[frozenset((i, j))] = ("gear", name)
    return edges


FORMS = {".graphml": "graphml", ".json": "json", ".dot": "dot", ".gv": "dot", ".md": "labels"}


@pytest.mark.parametrize(("suffix", "form"), FORMS.items())
def test_a_form_of_graph_is_chosen_by_suffix_or_by_name(tmp_path: Path, suffix: str, form: str) -> None:
    by_suffix, by_name = tmp_path / f"a{suffix}", tmp_path / "b.json"
    assert run("inspect", "graph", "pennestri-2002", "-o", by_suffix)[:2] == (0, "")
    assert run("inspect", "graph", "pennestri-2002", "--as", form, "-o", by_name)[0] == 0
    code, out, _ = run("inspect", "graph", "pennestri-2002", "--as", form)
    assert code == 0
    assert (
        by_suffix.read_text(encoding="utf-8").rstrip() == by_name.read_text(encoding="utf-8").rstrip() == out.rstrip()
    )
    assert out.startswith({"graphml": "<graphml", "json": "{", "dot": 'graph "pennestri-2002" {', "labels": "#"}[form])


def test_the_matrix_in_numbers_is_the_matrix_in_letters() -> None:
    data = json.loads(run("inspect", "graph", "pennestri-2002", "--as", "matrix")[1])
    rows, columns = data["labels"]
    ones = {frozenset((rows[i], columns[j])) for i, row in enumerate(data["values"]) for j, n in enumerate(row) if n}
    assert ones == set(paper_edges())
    assert {n for row in data["values"] for n in row} == {0, 1}


# -------------------------------------------------------------------------------------------- schema, list and periods


def keys(part: object, place: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every property of a schema, however deep."""
    if isinstance(part, dict):
        for name, child in part.get("properties", {}).items():
            yield f"{place}/{name}", child
        for name, child in part.items():
            yield from keys(child, f"{place}/{name}")
    elif isinstance(part, list):
        for at, child in enumerate(part):
            yield from keys(child, f"{place}/{at}")


def test_every_property_of_the_schema_is_described() -> None:
    found = json.loads(run("inspect", "schema")[1])
    assert found["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    Draft202012Validator.check_schema(found)
    properties = dict(keys(found))
    assert len(properties) > 80
    assert [place for place, child in properties.items() if not child.get("description", "").strip()] == []


SOUND: dict[str, Any] = {
    "links": {"frame": None, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": {"teeth": {"value": 60}}}}},
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"]}],
    "axes": {"A": {"direction": [0, 0, 1]}},
    "dials": {"d": {"face": "back"}},
    "states": {"on": {"fixed": []}},
    "inputs": {"a": 1},
    "outputs": {"b": {"expect": "-1/3", "targets": [{"speed": "1/3"}]}},
}


@pytest.mark.parametrize(
    "place",
    [
        (),
        ("links", "a"),
        ("links", "b", "wheels", "w"),
        ("links", "b", "wheels", "w", "teeth"),
        ("revolutes", 0),
        ("gears", 0),
        ("axes", "A"),
        ("dials", "d"),
        ("states", "on"),
        ("outputs", "b"),
        ("outputs", "b", "targets", 0),
    ],
    ids=lambda place: ".".join(map(str, place)) or "train",
)
def test_the_schema_accepts_a_train_and_refuses_a_key_it_does_not_know_anywhere(place: tuple[str | int, ...]) -> None:
    validator = Draft202012Validator(json.loads(run("inspect", "schema")[1]))
    data = json.loads(json.dumps(SOUND))
    assert validator.is_valid(data)
    part = data
    for step in place:
        part = part[step]
    part["teeeth"] = 1
    assert not validator.is_valid(data)


def test_the_schema_is_written_for_editors_and_for_readers(tmp_path: Path) -> None:
    out = tmp_path / "schema.json"
    assert run("inspect", "schema", "-o", out)[0] == 0
    assert out.read_text(encoding="utf-8") == run("inspect", "schema")[1]
    markdown = run("inspect", "schema", "--as", "markdown")[1]
    assert markdown == (ROOT / "docs" / "reference.md").read_text(encoding="utf-8")


def test_the_list_names_every_file_of_trains_with_its_title() -> None:
    lines = run("list")[1].splitlines()
    files = sorted(path.stem for path in train_files())
    assert sorted(line.split()[0] for line in lines) == files
    assert all(line.split(maxsplit=1)[1].strip() for line in lines)


@pytest.mark.parametrize("word", ["saros", "month_", "venus", ""])
def test_periods_shows_the_rows_with_a_word_and_no_others(word: str) -> None:
    with open(ROOT / "geartrain" / "train" / "periods.csv", encoding="utf-8", newline="") as source:
        rows = {row["name"]: row for row in csv.DictReader(source) if word in row["name"]}
    lines = {line.split()[0]: line.split() for line in run("periods", word)[1].splitlines()}
    assert set(lines) == set(rows)
    assert rows
    for name, line in lines.items():
        right = Fraction(rows[name]["exact"] or rows[name]["value"])
        assert abs(Fraction(line[1]) - right) <= abs(right) / 10**11
        assert (line[2] == "d") == (rows[name]["kind"] == "period")


# ----------------------------------------------------------------------------------------------------------- processes


def test_the_version_is_the_packages() -> None:
    assert run("--version")[1].strip() == f"geartrain {version('geartrain')}"


def test_a_pipe_that_closes_early_ends_quietly() -> None:
    command = f"{sys.executable} -m geartrain inspect schema | head -n 1"  # more than a pipe takes in one go
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
    assert done.stdout == "{\n"
    assert "Traceback" not in done.stderr
