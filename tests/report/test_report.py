"""Reports read back by readers that know nothing of geartrain (markdown-it, html.parser, json), and written whole."""

from __future__ import annotations

import csv
import json
import os
import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import lru_cache
from html import unescape
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import pytest
import shipped
from commands import call, ended
from markdown_it import MarkdownIt
from markdown_it.token import Token
from pennestri import TABLES_1_TO_3, TURNING_PAIRS
from places import ROOT

from geartrain import load
from geartrain.report import to_html, to_markdown, to_text

Write = Callable[..., Path]
Rows = list[list[str]]
SCRIPT = (ROOT / "geartrain" / "report" / "page.js").read_text(encoding="utf-8")
VOID = {"meta", "link", "br", "hr", "img", "input", "base", "col", "wbr"}


class Page(HTMLParser):
    """Tables as rows of cells, headings, tags that are not closed, and whatever would be fetched or run.

    Strips in which a page prints what is too wide for paper stand apart, as `strips`.

    Links within the page fetch nothing; the one script that comes with every page is known.
    """

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tables: list[Rows] = []
        self.strips: list[Rows] = []
        self.filled = self.tables
        self.headings: list[str] = []
        self.open: list[str] = []
        self.astray: list[str] = []
        self.outside: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        fetched = [(key, value) for key, value in attrs if key in ("src", "href", "srcset", "action", "data")]
        self.outside += [f"{key}={value}" for key, value in fetched if (key, (value or "")[:1]) != ("href", "#")]
        self.outside += [key for key, _ in attrs if key.startswith("on")]
        if tag in ("iframe", "object", "embed", "link", "base", "form"):
            self.outside.append(tag)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "div":
            self.filled = self.strips if "paper" in (dict(attrs).get("class") or "").split() else self.tables
        if tag == "table":
            self.filled.append([])
        elif tag == "tr":
            self.filled[-1].append([])
        elif tag in ("td", "th"):
            self.filled[-1][-1].append("")
        elif tag in ("h1", "h2"):
            self.headings.append("")

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.astray.append(tag)

    def handle_data(self, data: str) -> None:
        last = self.open[-1] if self.open else ""
        if last in ("td", "th"):
            self.filled[-1][-1][-1] += data
        elif last in ("h1", "h2"):
            self.headings[-1] += data
        elif last == "script" and data != SCRIPT:
            self.outside.append(data)
        elif last == "style":
            self.outside += re.findall(r"url\([^)]*\)|@import[^;]*|https?:[^\s;]*", data)


@lru_cache(maxsize=1)
def tokens(text: str) -> tuple[Token, ...]:
    """A Markdown text as another program reads it: once for its tables and its headings."""
    return tuple(MarkdownIt("commonmark").enable("table").parse(text))


def markdown_tables(text: str) -> list[Rows]:
    tables: list[Rows] = []
    within = False
    for token in tokens(text):
        if token.type == "table_open":
            tables.append([])
        elif token.type == "tr_open":
            tables[-1].append([])
        elif token.type in ("td_open", "th_open"):
            within = True
        elif token.type in ("td_close", "th_close"):
            within = False
        elif token.type == "inline" and within:
            tables[-1][-1].append(unescape(token.content))
    return tables


def headings(text: str) -> list[str]:
    return [after.content for token, after in pairwise(tokens(text)) if token.type == "heading_open"]


def section(text: str, title: str) -> list[Rows]:
    """The tables of one section."""
    found = text[text.index(f"\n## {title}\n") + 1 :]
    return markdown_tables(found.split("\n## ", 1)[0])


def column(table: Rows, name: str) -> list[str]:
    at = table[0].index(name)
    return [row[at] for row in table[1:]]


def by_name(table: Rows) -> dict[str, dict[str, str]]:
    return {row[0]: dict(zip(table[0], row, strict=True)) for row in table[1:]}


@pytest.fixture(scope="module")
def paper() -> str:
    return call("report", "pennestri-2002", "--all", "-o", "-").output


def test_the_adjacency_matrix_of_the_report_is_table_7_cell_by_cell(paper: str) -> None:
    cells = {pair: f"R({axis})" for pair, axis in TURNING_PAIRS.items()}
    for line in TABLES_1_TO_3.strip().splitlines():
        name, i, j, *_ = line.split()
        cells[int(i), int(j)] = name
    expected = [["", *map(str, range(1, 21))]] + [
        [str(i), *(cells.get((i, j)) or cells.get((j, i)) or "" for j in range(1, 21))] for i in range(1, 21)
    ]
    assert section(paper, "Adjacency matrix by names") == [expected]


def test_the_short_matrix_has_one_letter_for_each_edge_of_table_7() -> None:
    assert len(call("report", "freeth-2021").output.splitlines()) <= 150
    shown = call("report", "pennestri-2002").output
    assert len(shown.splitlines()) <= 100
    rows = [line.split() for line in shown[shown.index("link  1 2 3") :].splitlines()[1:21]]
    gears = {tuple(map(int, line.split()[1:3])) for line in TABLES_1_TO_3.strip().splitlines()}
    for i, row in enumerate(rows, 1):
        for j, letter in enumerate(row[2:], 1):
            edge = {(i, j), (j, i)}
            assert letter == ("R" if edge & set(TURNING_PAIRS) else "G" if edge & gears else "."), edge


def test_a_section_is_printed_on_request_and_an_unknown_one_is_refused() -> None:
    shown = call("report", "pennestri-2002", "--section", "errata").output
    assert "z18 = 15" in shown
    assert "Mobility" not in shown
    refused = ended("report", "pennestri-2002", "--section", "nothing")
    assert refused.returncode == 2
    assert "Fundamental circuits" in refused.stderr


def test_the_report_carries_every_erratum_of_the_declaration_with_what_is_right(paper: str) -> None:
    (table,) = section(paper, "Errata of the sources")
    printed = dict(zip(column(table, "printed"), column(table, "right"), strict=True))
    assert "60" in printed["z18 = 15"]
    assert "235/19" in next(right for text, right in printed.items() if "236/19" in text)
    assert "27.32166" in next(right for text, right in printed.items() if "27.3229" in text)
    assert all(column(table, "why"))


@pytest.mark.parametrize("name", shipped.every_train(dear={"longcase-clock-loaded"}, step=2))
def test_html_and_markdown_of_a_report_hold_the_same_tables(name: str) -> None:
    document = shipped.document(name)
    page, text = Page(to_html([document])), to_markdown([document])
    assert page.tables == markdown_tables(text)
    assert page.headings == headings(text)
    assert all(len({len(row) for row in table}) == 1 for table in page.tables)
    assert sum(map(len, page.tables)) > len(shipped.train(name).declaration.links)
    assert (page.open, page.astray, page.outside) == ([], [], [])


def test_what_is_wider_than_paper_is_printed_in_strips_with_every_cell_once() -> None:
    page = Page(to_html([shipped.document("freeth-2021")]))
    (matrix,) = (
        table for table in page.tables if len(table[0]) == len(shipped.train("freeth-2021").kinematics.tree.parent) + 2
    )
    parts = [strip for strip in page.strips if len(strip) == len(matrix) and strip[1][0] == matrix[1][0]]
    widths = [sum(max(map(len, column)) + 1 for column in zip(*strip, strict=True)) for strip in parts]
    assert 90 < max(widths) <= 111
    assert all([row[0] for row in strip] == [row[0] for row in matrix] for strip in parts)
    assert [[cell for part in rows for cell in part[1:]] for rows in zip(*parts, strict=True)] == [
        row[1:] for row in matrix
    ]


def test_what_an_author_writes_can_neither_run_in_a_page_nor_break_a_table(train_file: Write) -> None:
    path = train_file(
        'title: "<script>alert(1)</script> & | <b>"\n'
        'links: {frame: {}, "a|b": {note: "<img src=x onerror=y> | z", wheels: {"w|1": 20}}, c: {wheels: {v: 30}}}\n'
        'revolutes: [{pair: [frame, "a|b"], axis: "A|x"}, {pair: [frame, c], axis: C}]\n'
        'gears: [{id: "G|1", pair: ["w|1", v]}]\n'
        'inputs: {"a|b": 1}\n',
        "t.yaml",
    )
    document = load(path).report()
    page, text = Page(to_html([document])), to_markdown([document])
    assert page.outside == []
    assert page.headings[0] == "<script>alert(1)</script> & | <b>"
    assert page.tables == markdown_tables(text)
    speeds, _letters, structure, circuits, *_ = page.tables
    assert speeds[2][0] == structure[2][0] == "a|b"
    assert structure[2][3] == "<img src=x onerror=y> | z"
    assert circuits[0][1] == "G|1"


def test_a_note_of_several_lines_stays_within_its_cell(train_file: Write) -> None:
    path = train_file(
        'links: {frame: {}, a: {note: "one\\ntwo", wheels: {w: 20}}, c: {wheels: {v: 30}}}\n'
        "revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, c], axis: C}]\n"
        "gears: [{pair: [w, v]}]\n"
        "inputs: {a: 1}\n"
        'errata: [{place: p, printed: 1, right: 2, why: "because\\nof this"}]\n',
        "t.yaml",
    )
    text = str(load(path).report())
    assert [row[0] for row in section(text, "Structure")[0]] == ["link", "frame", "a", "c"]
    assert len(section(text, "Errata of the sources")[0]) == 2


@pytest.mark.parametrize("name", ["pennestri-2002", "zf-8hp70", "freeth-2021"])
def test_the_json_of_a_report_says_what_the_markdown_says(name: str, tmp_path: Path) -> None:
    out = tmp_path / "r.json"
    assert call("report", name, "-o", out).exit_code == 0
    whole = json.loads(out.read_text(encoding="utf-8"))
    assert whole == json.loads(call("report", name, "--json").output)
    (data,) = whole
    text = call("report", name, "--all", "-o", "-").output
    (matrix,) = section(text, "Adjacency matrix by names")
    assert [matrix[0][1:], *(row[1:] for row in matrix[1:])] == [
        data["adjacency"]["links"],
        *data["adjacency"]["cells"],
    ]
    circuits = {}
    for table in section(text, "Fundamental circuits"):
        for at, circuit in enumerate(table[0][1:], start=1):
            circuits[circuit] = [row[at] for row in table[1:]]
    assert list(circuits) == [circuit["id"] for circuit in data["circuits"]]
    for circuit in data["circuits"]:
        bodies = [circuit["i"], circuit["j"], circuit["carrier"]]
        assert [*bodies, circuit["ratio"]] == [*circuits[circuit["id"]][:3], circuits[circuit["id"]][5]]
    if name == "zf-8hp70":  # all states stand in one table, without the frame; its input turns at 1
        strips = section(text, "Speeds")
        for at, answer in enumerate(data["states"], start=1):
            told = {link: row for table in strips for link, row in zip(table[0], table[at], strict=True)}
            assert told.pop("state") == answer["state"]
            assert told == {link: speed["exact"] for link, speed in answer["speeds"].items() if link != "case"}
        return
    for answer in data["states"]:
        head = "Speeds" if answer["state"] is None else f"State {answer['state']}: speeds"
        (table,) = section(text, head)
        assert column(table, "speed") == [speed["exact"] for speed in answer["speeds"].values()]


@pytest.mark.parametrize("suffix", [".md", ".html", ".json", ".HTML", ""])
def test_several_trains_stand_in_one_report_in_the_order_requested(suffix: str, tmp_path: Path) -> None:
    names = ["zf-8hp70", "worm", "planetary"]
    titles = [load(name).declaration.title for name in names]
    out = tmp_path / f"r{suffix}"
    assert call("report", *names, "-o", out).exit_code == 0
    text = out.read_text(encoding="utf-8")
    if suffix == ".json":
        assert [train["title"] for train in json.loads(text)] == titles
    elif suffix.lower() == ".html":
        assert [title for title in Page(text).headings if title in titles] == titles
    else:
        assert [title for title in headings(text) if title in titles] == titles
        assert text.rstrip() == call("report", *names, "-o", "-").output.rstrip()


def test_a_disk_that_fills_up_leaves_the_old_file_and_no_scraps(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = tmp_path / "old.md"
    old.write_text("before", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    result = call("report", "worm", "-o", old, "--force")
    assert "No space left on device" in str(result.exception)
    assert old.read_text(encoding="utf-8") == "before"
    assert list(tmp_path.iterdir()) == [old]


def test_alternatives_stand_side_by_side_with_exact_numbers() -> None:
    text = call("compare", "freeth-2006", "freeth-2008", "-o", "-").output
    (table,) = section(text, "Outputs")
    assert table[0] == ["output", "freeth-2006", "freeth-2008"]
    rows = {row[0]: row[1:] for row in table[1:]}
    assert rows["games"][0] == ""
    assert rows["games"][1].startswith("1/4 ")
    # five turns in nineteen years, one in seventy-six, four in 223 months, one in 669
    saros = Fraction(4) * Fraction(235, 19) / 223
    for name, right in (
        ("metonic", Fraction(-5, 19)),
        ("callippic", Fraction(-1, 76)),
        ("saros", -saros),
        ("exeligmos", -saros / 12),
    ):
        assert rows[name][0] == rows[name][1]
        assert rows[name][0].split(" = ")[0] == str(right)


def test_the_wheels_that_differ_are_those_that_differ_in_the_declarations() -> None:
    text = call("compare", "freeth-2008", "freeth-2008-b224", "freeth-2006", "-o", "-").output
    (table,) = section(text, "Wheels that differ")
    names = table[0][1:]
    wheels = [{name: str(w.count) for name, (_, w) in load(train).declaration.wheels.items()} for train in names]
    every = dict.fromkeys(wheel for counts in wheels for wheel in counts)
    expected = [[wheel, *(counts.get(wheel, "") for counts in wheels)] for wheel in every]
    assert sorted(table[1:]) == sorted(row for row in expected if len(set(row[1:])) > 1)
    assert by_name(table)["b1"] == {
        "wheel": "b1",
        "freeth-2008": "223",
        "freeth-2008-b224": "224",
        "freeth-2006": "223",
    }


def test_the_errors_compared_are_speed_over_target_less_one() -> None:
    with open(ROOT / "geartrain" / "train" / "periods.csv", encoding="utf-8", newline="") as source:
        periods = {row["name"]: row for row in csv.DictReader(source)}
    year = Fraction(periods["year_tropical_J2000"]["value"])
    trains = [load(name) for name in ("price-1974", "freeth-2008")]
    (table,) = section(
        call("compare", "price-1974", "freeth-2008", "-o", "-").output, "Error against the targets in ppm"
    )
    checked = 0
    for row in table[1:]:
        output, label = row[0].removesuffix(" (magnitude)").split(": ", 1)
        turns, _, name = label.rpartition(" turns in ")
        if periods.get(name, {}).get("kind") != "period" or periods[name]["exact"]:
            continue
        target = Fraction(turns or 1) * year / Fraction(periods[name]["value"])
        for train, cell in zip(trains, row[1:], strict=True):
            if cell:
                error = (abs(Fraction(train.solve()[output])) / target - 1) * 10**6
                assert float(cell) == pytest.approx(float(error), rel=1e-5, abs=1e-9)
                checked += 1
    assert checked >= 10


def test_the_shift_table_has_the_ratios_and_clutches_of_the_maker() -> None:
    # ZF's catalogue prints two decimals; three of five elements are closed in every gear
    catalogue = {
        "1": ("ABC", "4.70"), "2": ("ABE", "3.13"), "3": ("BCE", "2.10"), "4": ("BDE", "1.67"), "5": ("BCD", "1.28"),
        "6": ("CDE", "1.00"), "7": ("ACD", "0.84"), "8": ("ADE", "0.67"), "R": ("ABD", "-3.30"),
    }  # fmt: skip
    (table,) = section(call("report", "zf-8hp70", "-o", "-").output, "Gears")
    assert table[0][:8] == ["state", *"ABCDE", "verdict", "ratio"]
    found = {}
    for row in table[1:]:
        assert set(row[1:6]) == {"x", ""}
        engaged = "".join(name for name, mark in zip("ABCDE", row[1:6], strict=True) if mark)
        found[row[0]] = (engaged, f"{float(row[7]):.2f}")
        assert row[6] == "determined"
    assert found == catalogue


@pytest.mark.parametrize("name", ["freeth-2008", "freeth-2021", "freeth-jones-2012"])
def test_only_the_games_pointer_turns_anticlockwise_for_who_reads_the_back(name: str) -> None:
    (table,) = section(call("report", name, "--all", "-o", "-").output, "All outputs")
    rows = by_name(table)
    read = {pointer: rows[pointer]["as read"] for pointer in ("metonic", "callippic", "saros", "exeligmos", "games")}
    sense = {pointer: words.split(",")[0] for pointer, words in read.items()}
    assert sense == dict.fromkeys(("metonic", "callippic", "saros", "exeligmos"), "clockwise") | {
        "games": "counter-clockwise"
    }
    assert rows["metonic"]["speed"].startswith("-")
    assert rows["games"]["speed"] == "1/4"
    # on the front there is no mirror: what is positive is clockwise
    assert rows["sun"]["as read"].split(",")[0] == rows["moon"]["as read"].split(",")[0] == "clockwise"
    # five turns of the Metonic spiral take nineteen years and show 235 months
    assert "a turn in 3.8 years," in read["metonic"]
    assert "5 turns in 19 years," in read["metonic"]
    assert f"one month in {19 / 235 * 365.2421897:.6g} d"  # tropical years of J2000 in read["metonic"]


def terminal(name: str, width: int) -> str:
    return to_text([shipped.document(name)], width)


def strips(shown: str) -> Iterator[tuple[str, str]]:
    """The cells of the matrix on a terminal with the column they start under."""
    matrix = shown[shown.index("Adjacency matrix by names") :].split("Errata of the sources")[0]
    head: dict[int, str] = {}
    lines = matrix.splitlines()
    start = next(at for at, line in enumerate(lines) if line.startswith(" "))
    for line in lines[start:]:
        if not line.strip():
            continue
        if line.startswith(" "):
            head = {found.start(): found.group() for found in re.finditer(r"\S+", line)}
            continue
        row = line.split()[0]
        for found in re.finditer(r"\S+", line):
            if found.start():
                yield f"{row} {head[found.start()]}", found.group()


@pytest.mark.parametrize("width", [40, 80, 120])
def test_a_terminal_shows_every_cell_of_table_7_in_its_row_and_column(width: int) -> None:
    shown = terminal("pennestri-2002", width)
    assert max(map(len, shown.splitlines())) <= width
    expected = {}
    pairs = {pair: f"R({axis})" for pair, axis in TURNING_PAIRS.items()}
    pairs |= {(int(i), int(j)): name for name, i, j, *_ in map(str.split, TABLES_1_TO_3.strip().splitlines())}
    for (i, j), cell in pairs.items():
        expected |= {f"{i} {j}": cell, f"{j} {i}": cell}
    found = list(strips(shown))
    assert dict(found) == expected
    assert len(found) == len(expected) == 74


@pytest.mark.parametrize("name", ["pennestri-2002", "zf-8hp70", "freeth-2021"])
def test_a_terminal_of_80_columns_is_never_overrun_and_shows_every_speed(name: str) -> None:
    shown = terminal(name, 80)
    assert max(map(len, shown.splitlines())) <= 80
    for answer in load(name).answers():
        for speed in answer.speeds.values():
            assert str(speed) in shown


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("south-pointing-chariot", "seen from above"),
        ("watch-going-train", "turns per h,"),
        ("prague-orloj", "from the dial"),
    ],
)
def test_units_and_sides_are_told_as_one_says_them(name: str, words: str) -> None:
    assert words in " ".join(terminal(name, 80).split())
