"""What reports say, read back from Markdown, HTML, JSON and a terminal."""

from __future__ import annotations

import io
import json
from html.parser import HTMLParser
from pathlib import Path

import pytest
from rich.console import Console
from test_cli import TWENTY, UNUSABLE, call

from geartrain import load
from geartrain.report import compare_trains, report_train, to_html, to_markdown, to_terminal

# Tables 1 to 3 of pennestri-2002: bodies i, j and carrier k of the fundamental circuits
CIRCUITS = {
    "G1": "2 3 1", "G2": "2 4 1", "G3": "4 10 1", "G4": "4 6 1", "G5": "4 15 1", "G6": "5 11 1", "G7": "5 12 1",
    "G8": "6 7 1", "G9": "7 8 1", "G10": "8 9 1", "G11": "10 11 1", "G12": "12 13 20", "G13": "13 14 20",
    "G14": "16 20 1", "G15": "14 15 20", "G16": "16 17 1", "G17": "17 18 1", "G18": "18 19 1",
}  # fmt: skip


class Cells(HTMLParser):
    """The cells of every table, and everything that would ask a server."""

    def __init__(self) -> None:
        super().__init__()
        self.cells: list[str] = []
        self.requests: list[str] = []
        self.inside = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.requests += [value for key, value in attrs if key in ("src", "href") and value]
        if tag in ("td", "th"):
            self.inside = True
            self.cells.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag in ("td", "th"):
            self.inside = False

    def handle_data(self, data: str) -> None:
        if self.inside:
            self.cells[-1] += data


def markdown_cells(text: str) -> list[str]:
    rows = [line for line in text.splitlines() if line.startswith("|") and not line.startswith("|--")]
    return [cell.strip().replace("\\|", "|") for line in rows for cell in line[1:-1].split(" |")]


def column(text: str, name: str) -> list[str]:
    """The cells under a heading, down to the end of its table."""
    lines = text.splitlines()
    start = next(at for at, line in enumerate(lines) if name in [cell.strip() for cell in line.split("|")])
    place = [cell.strip() for cell in lines[start].split("|")].index(name)
    found = []
    for line in lines[start + 2 :]:
        if not line.startswith("|"):
            break
        found.append(line.split("|")[place].strip())
    return found


@pytest.fixture(scope="module")
def pennestri() -> str:
    return to_markdown([report_train(load("pennestri-2002"))])


def test_the_report_has_the_papers_circuits(pennestri: str) -> None:
    circuits = pennestri[pennestri.index("## Fundamental circuits") :]
    for name, bodies in CIRCUITS.items():
        assert " ".join(column(circuits, name)[:3]) == bodies


def test_the_report_has_the_papers_speeds(pennestri: str) -> None:
    assert column(pennestri[pennestri.index("## Speeds") :], "speed") == list(TWENTY)


def test_the_report_has_the_adjacency_of_table_7(pennestri: str) -> None:
    matrix = pennestri[pennestri.index("## Adjacency") :]
    twenty = column(matrix, "20")
    assert [(at + 1, cell) for at, cell in enumerate(twenty) if cell] == [
        (13, "R(13)"),
        (14, "R(14)"),
        (15, "R(15)"),
        (16, "G14"),
    ]


def test_the_report_names_the_errata(pennestri: str) -> None:
    errata = pennestri[pennestri.index("## Errata") :]
    assert {"z18 = 15", "1.7777", "O1, O2, X = 32, 48, 41"} <= set(column(errata, "printed"))


def test_html_has_the_same_cells_and_asks_no_server() -> None:
    documents = [report_train(load(name)) for name in ("freeth-2021", "zf-8hp70")]
    reader = Cells()
    reader.feed(to_html(documents))
    assert reader.requests == []
    assert [cell.strip() for cell in reader.cells] == markdown_cells(to_markdown(documents))


def test_the_json_of_several_trains_is_a_list() -> None:
    data = json.loads(call("report", "worm", "planetary-24-18-60", "--json").output)
    assert [train["name"] for train in data] == ["worm", "planetary-24-18-60"]
    assert data[1]["speeds"]["carrier"]["exact"] == "2/7"


def test_nothing_is_written_when_a_run_fails(tmp_path: Path) -> None:
    bad, out = tmp_path / "bad.yaml", tmp_path / "out.md"
    bad.write_text(UNUSABLE, encoding="utf-8")
    out.write_text("before", encoding="utf-8")
    assert call("report", "worm", bad, "-o", out).exit_code != 0
    assert out.read_text(encoding="utf-8") == "before"
    assert call("report", "worm", "-o", tmp_path / "no" / "out.md").exit_code != 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.yaml", "out.md"]
    assert call("report", "worm", "-o", out).exit_code == 0
    assert "-1/30" in out.read_text(encoding="utf-8")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.yaml", "out.md"]


def test_reconstructions_stand_side_by_side() -> None:
    text = to_markdown([compare_trains([load("freeth-2006"), load("freeth-2008")])])
    rows = {line.split("|")[1].strip(): line.split("|")[2:4] for line in text.splitlines() if line.startswith("|")}
    assert [cell.strip() for cell in rows["games"]] == ["", "1/4 = 0.25"]
    assert rows["callippic"][0] == rows["callippic"][1]
    assert [cell.strip() for cell in rows["nO"]] == ["", "57"]


def test_the_shift_table_marks_what_is_engaged() -> None:
    text = to_markdown([report_train(load("zf-8hp70"))])
    table = text[text.index("## States") :]
    engaged = {"1": "ABC", "2": "ABE", "3": "BCE", "4": "BDE", "5": "BCD", "6": "CDE", "7": "ACD", "R": "ABD"}
    states = column(table, "state")
    for state, clutches in engaged.items():
        assert "".join(name for name in "ABCDE" if column(table, name)[states.index(state)] == "x") == clutches


def test_of_the_back_dials_only_the_games_pointer_turns_counter_clockwise() -> None:
    text = to_markdown([report_train(load("freeth-2008"))])
    outputs = text[text.index("## Outputs") :]
    read = dict(zip(column(outputs, "output"), column(outputs, "as read"), strict=True))
    for name in ("metonic", "callippic", "saros", "exeligmos"):
        assert read[name].startswith("clockwise")
    assert read["games"].startswith("counter-clockwise")


@pytest.mark.parametrize("width", [60, 80, 200])
def test_a_narrow_terminal_loses_no_cell_of_the_matrix(width: int) -> None:
    console = Console(file=io.StringIO(), width=width)
    to_terminal([report_train(load("pennestri-2002"))], console)
    shown = console.file.getvalue()  # type: ignore[attr-defined]
    matrix = shown[shown.index("Adjacency") : shown.index("Fundamental")].split()
    for at in range(1, 19):
        assert matrix.count(f"G{at}") == 2
