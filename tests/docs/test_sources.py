"""docs/sources.md: each row is computed and passes, each omission has a reason, and the page shows the rows."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from fractions import Fraction
from typing import Any

import make_sources
import pytest
from places import DOCS
from sources.row import DECLARED, Corrected, Digits, Equal, Exactly, Finding, Found, Row, Source
from sources.ways import Call
from typer.main import get_command

import geartrain
from geartrain.cli import app


@pytest.mark.parametrize("source", make_sources.SOURCES, ids=lambda source: source.name)
def test_every_row_passes(source: Source, subtests: pytest.Subtests) -> None:
    for row in source.rows:
        with subtests.test(row.place):
            assert row.passes, f"{row.verdict}: printed {row.printed!r}, ours {row.ours}"


def test_the_page_is_what_its_script_writes() -> None:
    written = (DOCS / "sources.md").read_text(encoding="utf-8")
    assert written == make_sources.page(), "run python docs/scripts/make_sources.py"


def test_every_place_is_named_once_in_its_source() -> None:
    for source in make_sources.SOURCES:
        places = Counter(row.place for row in source.rows)
        assert [place for place, times in places.items() if times > 1] == [], source.name


def test_every_erratum_is_on_the_page_with_its_correction_and_evidence() -> None:
    written = (DOCS / "sources.md").read_text(encoding="utf-8")
    for source in make_sources.SOURCES:
        for row in source.rows:
            if row.erratum:
                lines = [line for line in written.splitlines() if f"| {row.place} |" in line]
                assert any(f"| {row.erratum} | {row.ours}" in line for line in lines), row.place


@pytest.mark.parametrize("name", ["sorge-pairs", "freeth-2021", "gosper-2005", "huygens-planetarium-1682"])
def test_errata_of_a_shipped_train_are_as_many_as_on_the_page(name: str) -> None:
    source, start = {
        "sorge-pairs": ("Sorge", ""),
        "freeth-2021": ("Other publications", "Freeth et al. 2021, "),
        "gosper-2005": ("Other publications", "Gosper"),
        "huygens-planetarium-1682": ("Other publications", "Dietzschold p. "),
    }[name]
    (rows,) = (each.rows for each in make_sources.SOURCES if each.name == source)
    found = [row for row in rows if row.erratum and row.place.startswith(start) and not row.place.endswith("Jupiter")]
    assert len(found) == len(geartrain.load(name).declaration.errata)


def value(thing: object) -> Call:
    return Call("thing", {"thing": thing})


@pytest.mark.parametrize(
    ("row", "passes"),
    [
        (Row("p", "c", "1.25", value(1.2549), Digits()), True),
        (Row("p", "c", "1.25", value(1.2551), Digits()), False),
        (Row("p", "c", "1.25", value(Fraction(5, 4)), Digits()), True),
        (Row("p", "c", "1.25", value(1.3), Digits(), "1.30, misread"), True),
        (Row("p", "c", "1.25", value(1.3), Digits(), "1.4"), False),
        (Row("p", "c", "1.25", value(1.25), Digits(), "1.25"), False),
        (Row("p", "c", "a", value("b"), Exactly(), "b: c"), True),
        (Row("p", "c", "a", value("b"), Exactly(), "c"), False),
        (Row("p", "c", "a", value("a"), Exactly()), True),
        (Row("p", "c", "a", value("b"), Exactly()), False),
        (Row("p", "c", "", value(1e-11), Equal()), False),
        (Row("p", "c", "", value((0.1, 1e-13)), Corrected(), "named"), True),
        (Row("p", "c", "", value((0.1, 0.1)), Corrected(), "named"), False),
        (Row("p", "c", "", value((0.0, 0.0)), Corrected(), "named"), False),
        (Row("p", "c", "", value(Finding(False, "no")), Found()), False),
        (Row("p", "c"), False),
        (Row("p", "c", why="a photograph"), False),
        (Row("p", "c", why="history: a photograph"), True),
        (Row("p", "c", why="nobody has it", check=value(Finding(True, "nobody"))), True),
        (Row("p", "c", why="nobody has it", check=value(Finding(False, "somebody"))), False),
        (Row("p", "c", "1.25", value(1.25), Digits(), echo=True), True),
        (Row("p", "c", "1.25", value(1.26), Digits(), echo=True), False),
    ],
)
def test_a_row_passes_only_if_its_value_agrees(row: Row, passes: bool) -> None:
    assert row.passes is passes


READ_OFF = re.compile(r"`(count\('\w+'(, price\(\))?\)|period\('\w+'\)|months_of_saros\(\)|speed\([12]\))`")
"""Expressions that read tooth counts, periods, and the speeds of the frame (1) and of the input (2)."""


def test_what_is_only_read_off_a_declaration_is_not_called_reproduced() -> None:
    rows = [row for source in make_sources.SOURCES for row in source.rows if row.way is not None and not row.erratum]
    read = {row.place for row in rows if READ_OFF.fullmatch(row.way.text)} | {"Table 4, w1", "Table 4, w2"}
    assert {row.place for row in rows if row.verdict == DECLARED} == read
    assert len(read) > 90


def test_every_command_of_a_reason_is_one_that_geartrain_understands() -> None:
    commands = {
        command
        for source in make_sources.SOURCES
        for row in source.rows
        for command in re.findall(r"`geartrain ([^`]+)`", row.why)
    }
    assert len(commands) > 10
    for command in sorted(commands):
        context, words = None, shlex.split(command)
        verb: Any = get_command(app)
        while hasattr(verb, "resolve_command"):
            context = verb.make_context(None, list(words), parent=context)
            _, verb, words = verb.resolve_command(context, [*context._protected_args, *context.args])
        verb.make_context(command, list(words), parent=context)
