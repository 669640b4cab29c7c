"""Text that a user wrote, wherever it is shown: no spreadsheet runs it, no browser parses it, no terminal obeys it."""

from __future__ import annotations

import csv
import io
import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from commands import call, ended
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from places import ROOT

from geartrain import load
from geartrain.errors import Problem, printable
from geartrain.numerics.files import csv_text
from geartrain.report import Document, Section, Table, to_markdown, to_text

EVIL = "\x1b]0;owned\x07\x1b[2J\x9b31m\u202etxt"
STEERING = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2028\u2029]")
FORMULAS = ("=1+1", "@SUM(A1)", "+cmd|' /C calc'!A0", "-2+3", "\t=1", "\r=1")
NAMES = ("a,b", '"q"', "=HYPERLINK(1)", "@x", "+y", "-z", EVIL)

HOSTILE = {
    "name": "hostile" + EVIL,
    "title": "A title <script>alert(1)</script> & &lt;b&gt;" + EVIL,
    "note": "A note <img src=x onerror=alert(1)>" + EVIL,
    "links": {"frame": {}, "in" + EVIL: {"wheels": {"w" + EVIL: 20}}, "out": {"wheels": {"v": 30}}},
    "revolutes": [{"pair": ["frame", "in" + EVIL], "axis": "A"}, {"pair": ["frame", "out"], "axis": "B"}],
    "gears": [{"pair": ["w" + EVIL, "v"]}],
    "inputs": {"in" + EVIL: 1},
    "outputs": {name: {"of": "out", "expect": "7"} for name in NAMES},
    "sources": {"s" + EVIL: {"cite": "A source <b>" + EVIL}},
}


@pytest.fixture
def hostile(tmp_path: Path) -> Path:
    path = tmp_path / "t.yaml"
    path.write_text(json.dumps(HOSTILE), encoding="utf-8")
    return path


@given(st.lists(st.lists(st.text(max_size=8), min_size=1, max_size=4), min_size=1, max_size=4))
def test_every_row_is_one_line_of_as_many_cells_and_none_is_a_formula(rows: list[list[str]]) -> None:
    text = csv_text(rows[0], rows[1:])
    assert text.count("\n") == len(rows)
    assert not STEERING.search(text)
    read = list(csv.reader(io.StringIO(text, newline="")))
    assert [len(row) or 1 for row in read] == [len(row) for row in rows]
    for cell in (cell for row in read for cell in row):
        if cell[:1] in ("=", "@", "+", "-", "\t", "\r"):
            assert re.fullmatch(r"[+-]?[\d.eE/+-]+", cell), cell


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_is_disarmed_in_header_and_rows(text: str) -> None:
    header, row = csv.reader(csv_text([text], [[text]]).splitlines())
    assert header[0].startswith("'")
    assert row[0].startswith("'")


def test_numbers_stay_numbers() -> None:
    cells = [-1, 0.1, -2.5e-300, "-254/19", "+3", "-0.5", "-1e-9", "5207/5001", None, True]
    assert csv_text(cells, [[0.1 + 0.2], [1]]).splitlines() == [
        "-1,0.1,-2.5e-300,-254/19,+3,-0.5,-1e-9,5207/5001,,True",
        repr(0.1 + 0.2),
        "1",
    ]


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_float_is_read_back_as_it_was(value: float) -> None:
    assert float(csv_text([value], [])) == value


def odd_outputs(file: Path, parent: str, of: str) -> Path:
    outputs = {name: {"of": of, "targets": [{"speed": 1, "tolerance": "99 %"}]} for name in NAMES}
    file.write_text(json.dumps({"extends": parent, "outputs": outputs}), encoding="utf-8")
    return file


@pytest.mark.parametrize(
    "command",
    [
        lambda file, out: ("motion", file, "--turns", "1", "--samples", "8", "-o", out, *outputs()),
        lambda file, out: (
            "montecarlo",
            file,
            "--trials",
            "2",
            "--cutting",
            "pitch_deviation=2 %",
            "-o",
            out,
            *outputs(),
        ),
    ],
)
def test_columns_of_names_with_commas_do_not_shift(tmp_path: Path, command: Callable[..., Any]) -> None:
    file, out = odd_outputs(tmp_path / "t.yaml", "moon-triangular", "moon"), tmp_path / "x.csv"
    done = call(*command(file, out))
    assert done.exit_code == 0, done.exception
    text = out.read_text(encoding="utf-8")
    header, *rows = csv.reader(io.StringIO(text))
    assert rows
    assert {len(row) for row in rows} == {len(header)}
    assert any("a,b" in cell for cell in header)
    assert not any(cell.startswith(("=", "@", "+", "-")) for cell in header)
    assert not STEERING.search(text)
    assert all(re.fullmatch(r"[-+.\deEnaif]+", cell) for row in rows for cell in row)


def outputs() -> list[str]:
    return [word for name in NAMES for word in (f"--of={name}",)]


def test_every_other_csv_is_made_in_the_same_place(tmp_path: Path, hostile: Path) -> None:
    assert call("export", hostile, "--to", tmp_path / "set", "--as", "csv").exit_code == 1
    for path in (tmp_path / "set").rglob("*.csv"):
        text = path.read_text(encoding="utf-8")
        rows = list(csv.reader(io.StringIO(text)))
        assert len({len(row) for row in rows}) == 1, path
        assert not STEERING.search(text)
        for cell in (cell for row in rows for cell in row):
            assert not cell.startswith(("=", "@")), (path, cell)
            assert re.fullmatch(r"[-+].*", cell) is None or re.fullmatch(r"[-+][\d.eE/+-]+", cell), (path, cell)
    source = ROOT / "geartrain"
    uses = [path for path in source.rglob("*.py") if re.search(r"^\s*import csv$", path.read_text("utf-8"), re.M)]
    assert [path.name for path in uses if "csv.writer" in path.read_text("utf-8")] == ["files.py"]


def test_markdown_holds_no_html_of_a_user() -> None:
    text = "<script>x</script> 1 < 2 && a<b> <!-- c --> &lt; &#60; R&D </td>"
    table = Table((text, "x"), [(text, "|")])
    found = to_markdown([Document(f"{text}\n# no heading", (text,), (Section(text, (text,), (table,)),))])
    assert not re.search(r"<[A-Za-z/!?]", found)
    assert not re.search(r"&#?\w+;", found.replace("&lt;", "").replace("&amp;", ""))
    assert "1 < 2 && a" in found
    assert "R&D" in found
    assert "\n# no heading" not in found
    assert all(line.count(" | ") == 1 for line in found.splitlines() if line.startswith("| "))


@pytest.mark.parametrize("verb", ["report", "compare"])
def test_a_report_of_a_hostile_train_holds_none(verb: str, hostile: Path) -> None:
    text = call(verb, hostile, "-o", "-").stdout
    assert "script" in text or verb == "compare"
    assert not re.search(r"<(script|img|b)\b", text)
    tokens = MarkdownIt("commonmark").enable("table").parse(text)
    inner = [child for token in tokens for child in token.children or ()]
    assert not [token for token in (*tokens, *inner) if token.type.startswith("html")]


SHOWN = [
    *(("report",), ("report", "--json"), ("compare",), ("compare", "--all"), ("compare", "--json")),
    *(("solve",), ("solve", "--json"), ("solve", "--method", "floats"), ("check",), ("inspect equations",)),
    *(
        ("inspect equations", "--latex"),
        ("torques",),
        ("torques", "--json"),
        ("motion", "--turns", "1", "--samples", "8"),
    ),
    *(("inspect graph",), *(("inspect graph", "--as", form) for form in ("matrix", "dot", "graphml", "json"))),
    *(("draw", "--kind", "graph", "-o", "-"), ("solve", "--of", "x" + EVIL)),
    *(("solve", "--state", EVIL), ("teeth",), ("posterior",), ("montecarlo",), ("motion", "--turns", EVIL)),
    *(("export", "--to", "parts" + EVIL), ("solve", "-o", "x" + EVIL), ("solve", "--method", EVIL)),
]


@pytest.mark.parametrize("words", SHOWN, ids=lambda words: printable(" ".join(words)))
def test_nothing_that_is_shown_steers_a_terminal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, hostile: Path, words: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    done = call(*words[0].split(), hostile, *words[1:])
    said = done.stdout + done.stderr + (str(done.exception) if done.exception else "")
    assert said
    assert not STEERING.search(said), STEERING.search(said)
    if done.stdout and ("--json" in words or words[-1] == "json"):
        assert "\x1b" in json.dumps(json.loads(done.stdout), ensure_ascii=False).encode().decode("unicode_escape")
    if done.stdout and words[-1] == "graphml":
        ET.fromstring(done.stdout)


@pytest.mark.parametrize(
    "wrong",
    [
        {"links": {"frame": {}}, "ge" + EVIL: 1},
        {"links": {"frame": {}}, "gears": [{"pair": ["x" + EVIL, "y"]}]},
        {"extends": "none" + EVIL},
        {"links": {"frame": {"wheels": {"x": "twenty" + EVIL}}}},
    ],
)
def test_no_error_steers_one(tmp_path: Path, wrong: dict[str, Any]) -> None:
    path = tmp_path / "t.yaml"
    path.write_text(json.dumps(wrong), encoding="utf-8")
    done = ended("check", path)
    assert done.returncode == 2
    assert "\\x1b" in done.stderr, done.stderr
    assert not STEERING.search(done.stderr)


@pytest.mark.parametrize(
    "words",
    [
        (EVIL,),
        (f"--{EVIL}",),
        ("solve", "worm", f"--x{EVIL}"),
        ("draw", "worm", "--kind", EVIL),
        ("inspect", "bench", EVIL),
    ],
)
def test_no_complaint_of_a_wrong_command_line_steers_one(words: tuple[str, ...]) -> None:
    done = ended(*words)
    assert done.returncode == 2
    assert "owned" in done.stderr
    assert not STEERING.search(re.sub(r"\x1b\[\d*(;\d+)*m", "", done.stderr))


def test_a_terminal_shows_a_hostile_report_as_text(hostile: Path) -> None:
    text = to_text([load(hostile).report()], 200)
    assert not STEERING.search(text)
    assert "\\x1b]0;owned" in text


def test_a_picture_of_hostile_names_is_xml(tmp_path: Path, hostile: Path) -> None:
    for kind in ("graph", "stick"):
        out = tmp_path / f"{kind}.svg"
        call("draw", hostile, "--kind", kind, "-o", out)
        ET.fromstring(out.read_bytes())


def test_what_is_harmless_is_left_alone() -> None:
    text = "Zahnräder, 歯車, 18\xa0000\tμm\n— ½"
    assert printable(text) == text
    assert printable("\x1b[1m\r\x00\udc80") == "\\x1b[1m\\r\\x00\\udc80"
    assert str(Problem("a\x07b", "c\x1b", "d\x9b", "e\x00")) == "e\\x00: a\\x07b\n  why: c\\x1b\n  fix: d\\x9b"
