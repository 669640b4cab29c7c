"""docs/sources.md: every row is worked out and stands, none is without a reason, and the page is what the rows say."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from fractions import Fraction
from typing import Any

import make_sources
import pytest
from places import DOCS
from sources.row import DECLARED, Digits, Equal, Exactly, Finding, Holds, Mended, Row, Source
from sources.ways import Call
from typer.main import get_command

from geartrain.cli import app


def sections() -> dict[str, str]:
    """The page of errata by the anchors of its headings."""
    found = {}
    for part in (DOCS / "errata.md").read_text(encoding="utf-8").split("\n## ")[1:]:
        head, _, body = part.partition("\n")
        found["".join(c for c in head.lower() if c.isalnum() or c in " -").replace(" ", "-")] = body
    return found


@pytest.mark.parametrize("source", make_sources.SOURCES, ids=lambda source: source.name)
def test_every_row_stands(source: Source, subtests: pytest.Subtests) -> None:
    for row in source.rows:
        with subtests.test(row.place):
            assert row.stands, f"{row.verdict}: printed {row.printed!r}, ours {row.ours}"


def test_the_page_is_what_its_script_writes() -> None:
    written = (DOCS / "sources.md").read_text(encoding="utf-8")
    assert written == make_sources.page(), "run python docs/scripts/make_sources.py"


def test_every_place_is_named_once_in_its_source() -> None:
    for source in make_sources.SOURCES:
        places = Counter(row.place for row in source.rows)
        assert [place for place, times in places.items() if times > 1] == [], source.name


@pytest.mark.parametrize("source", make_sources.SOURCES, ids=lambda source: source.name)
def test_every_erratum_has_its_proof_on_the_page_of_errata(source: Source) -> None:
    proofs = sections()
    for row in source.rows:
        if row.erratum:
            section = row.section or source.section
            assert row.erratum in proofs[section], f"{row.place}: errata.md#{section} does not say {row.erratum!r}"


def value(thing: object) -> Call:
    return Call("thing", {"thing": thing})


@pytest.mark.parametrize(
    ("row", "stands"),
    [
        (Row("p", "c", "1.25", value(1.2549), Digits()), True),
        (Row("p", "c", "1.25", value(1.2551), Digits()), False),
        (Row("p", "c", "1.25", value(Fraction(5, 4)), Digits()), True),
        (Row("p", "c", "1.25", value(1.3), Digits(), "named"), True),
        (Row("p", "c", "1.25", value(1.25), Digits(), "named"), False),
        (Row("p", "c", "a", value("a"), Exactly()), True),
        (Row("p", "c", "a", value("b"), Exactly()), False),
        (Row("p", "c", "", value(1e-11), Equal()), False),
        (Row("p", "c", "", value((0.1, 1e-13)), Mended(), "named"), True),
        (Row("p", "c", "", value((0.1, 0.1)), Mended(), "named"), False),
        (Row("p", "c", "", value((0.0, 0.0)), Mended(), "named"), False),
        (Row("p", "c", "", value(Finding(False, "no")), Holds()), False),
        (Row("p", "c"), False),
        (Row("p", "c", why="a photograph"), False),
        (Row("p", "c", why="history: a photograph"), True),
        (Row("p", "c", why="nobody has it", check=value(Finding(True, "nobody"))), True),
        (Row("p", "c", why="nobody has it", check=value(Finding(False, "somebody"))), False),
        (Row("p", "c", "1.25", value(1.25), Digits(), echo=True), True),
        (Row("p", "c", "1.25", value(1.26), Digits(), echo=True), False),
    ],
)
def test_a_row_stands_only_where_its_value_bears_it_out(row: Row, stands: bool) -> None:
    assert row.stands is stands


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
