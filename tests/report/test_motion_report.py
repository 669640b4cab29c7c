"""The page of a motion: the table of pairs tells what it leaves out, and leaves nothing out when asked."""

from __future__ import annotations

from commands import call

Rows = list[list[str]]


def pairs(*words: str) -> tuple[list[str], list[Rows]]:
    """Return the paragraphs and the tables of the section on pairs; each table begins with its header."""
    page = call("motion", "pennestri-2002-teeth", "--turns", "1", "--samples", "11", *words, "-o", "-").stdout
    lines = page.split("\n## Pairs\n\n")[1].split("\n## ")[0].splitlines()
    tables: list[Rows] = []
    for line in lines:
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if cells and cells[0] == "pair":
            tables.append([])
        if cells and not cells[0].startswith("--"):
            tables[-1].append(cells)
    return [line for line in lines if line and not line.startswith("|")], tables


def columns(tables: list[Rows]) -> list[str]:
    return [head.removesuffix(" (deg)") for table in tables for head in table[0][4:]]


def test_outputs_that_are_left_out_are_named() -> None:
    paragraphs, tables = pairs()
    assert columns(tables) == [str(link) for link in range(3, 11)]
    others = ", ".join([*map(str, range(11, 21)), "sun", "moon"])
    assert paragraphs[1:] == ["No pair affects 1, 2.", f"Not shown: {others}; `--wide` or `--of` shows them."]


def test_every_output_has_its_column_when_requested() -> None:
    paragraphs, tables = pairs("--wide")
    assert columns(tables) == [*map(str, range(3, 21)), "sun", "moon"]
    assert not any("Not shown" in line for line in paragraphs)
    assert {len(table) for table in tables} == {1 + 18}


def test_a_share_is_the_range_of_the_pair_times_its_lever() -> None:
    """G18 drives link 19 from 18; G17 reaches 19 through G18, whose 15 teeth drive 60."""
    _, (table,) = pairs("--of", "18", "--of", "19")
    share = {row[0]: [float(cell) for cell in row[4:]] for row in table[1:]}
    assert share["G18"][0] == 0
    assert abs(share["G17"][0] / share["G17"][1] - 4) < 2e-3
