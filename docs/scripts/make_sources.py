"""Write docs/sources.md: what the four sources print, and what geartrain gives for it.

`python docs/scripts/make_sources.py WORDS` works out and prints the rows whose source and place hold the words instead.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from sources import pennestri, smith_rows, sorge, sphere
from sources.row import ERRATUM, VERDICTS, Row, Source

PAGE = Path(__file__).resolve().parents[1] / "sources.md"
SOURCES: tuple[Source, ...] = (sorge.SOURCE, pennestri.SOURCE, smith_rows.SOURCE, sphere.SOURCE)


def page() -> str:
    """The whole page."""
    return "\n".join([*lead(), *(line for source in SOURCES for line in section(source))]).rstrip() + "\n"


def lead() -> Iterator[str]:
    """Head and summary."""
    yield from ("# Every printed number", "")
    yield "Written by `python docs/scripts/make_sources.py`, which works out every row; the tests do the same. Each"
    yield "equation, figure, table entry and claim of the sources, the value printed, ours, what gives it, and"
    yield "the verdict:"
    yield ""
    yield "- **reproduced**: equal within half a unit of the last digit printed; an equation at many places; words"
    yield "  where what they say was found so;"
    yield "- **declared**: equal, but only read off the shipped train or table, which has it from the source:"
    yield "  nothing is computed;"
    yield "- **erratum**: it is not, and the link leads to a proof that `python docs/scripts/make_errata.py` runs;"
    yield "- **out of scope**: nothing that geartrain computes, with the reason; a reason that is not of the source"
    yield "  itself is worked out like a row."
    yield ""
    yield "A command is given with the place of the value in its JSON. A call is an expression of Python, with the"
    yield "names of the source's module in `docs/scripts/sources/`; `python docs/scripts/make_sources.py"
    yield "'Sorge Eq. (12)'` works out one row."
    yield ""
    yield from table(
        ("source", "rows", *VERDICTS),
        [
            (
                f"[{each.name}](#{each.name.lower()})",
                str(len(each.rows)),
                *(str(count(each)[kind]) for kind in VERDICTS),
            )
            for each in SOURCES
        ],
    )


def count(source: Source) -> Counter[str]:
    """Rows by verdict."""
    return Counter(row.verdict for row in source.rows)


def section(source: Source) -> Iterator[str]:
    """The table of one source."""
    yield from (f"## {source.name}", "", source.cite + ".", source.text, "")
    yield from table(("place", "what", "printed", "ours", "by", "verdict"), [cells(source, row) for row in source.rows])


def cells(source: Source, row: Row) -> tuple[str, ...]:
    """One row."""
    verdict = f"[{ERRATUM}](errata.md#{row.section or source.section})" if row.erratum else row.verdict
    if row.why:
        verdict += f": {row.why}"
    way = row.way or row.check
    by = "" if way is None else way.text
    return row.place, row.claim, row.printed, row.ours, by, verdict


def table(header: tuple[str, ...], body: list[tuple[str, ...]]) -> Iterator[str]:
    """A Markdown table."""
    yield "| " + " | ".join(header) + " |"
    yield "|" + "---|" * len(header)
    for row in body:
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |"
    yield ""


def show(requested: str) -> None:
    """Print the rows whose source and place hold the words."""
    for source in SOURCES:
        for row in source.rows:
            if requested.lower() in f"{source.name} {row.place}".lower():
                print(" | ".join(cell for cell in cells(source, row) if cell), "" if row.stands else "DOES NOT STAND")


def main(requested: str = "") -> None:
    """Write the page, or print what is asked for."""
    if requested:
        show(requested)
        return
    PAGE.write_text(page(), encoding="utf-8")
    print("wrote docs/sources.md")


if __name__ == "__main__":
    main(" ".join(sys.argv[1:]))
