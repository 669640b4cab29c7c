"""Write docs/sources.md: errata and printed numbers of the sources, with the computed values.

`python docs/scripts/make_sources.py WORDS` prints the rows whose source and place contain the words, with the command
or expression that computes each.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path

from sources import others, pennestri, smith_rows, sorge, sphere
from sources.row import DECLARED, ERRATUM, NOT_COMPUTED, OUTSIDE, REPRODUCED, VERDICTS, Equal, Row, Source

PAGE = Path(__file__).resolve().parents[1] / "sources.md"
SOURCES: tuple[Source, ...] = (sorge.SOURCE, pennestri.SOURCE, smith_rows.SOURCE, sphere.SOURCE, others.SOURCE)

HEAD = """# Sources and their errata

This page compares every number, equation and statement of four sources with the values that geartrain computes. The
tests recompute each value. A number is classified as reproduced if the computed value agrees with it to within half a
unit of the last printed digit; an equation is classified as reproduced if its two sides are equal at many positions. A
number is classified as read if the shipped train or table declares it; such a number is not computed. The errata of
each source are numbered, and the evidence for each erratum is the computed value. The last section lists errata of
other publications.

To see how a value is computed, run, for example, `python docs/scripts/make_sources.py 'Sorge Eq. (12)'`.
"""


def page() -> str:
    """Return the whole page."""
    summary = [
        (f"[{each.name}](#{anchor(each)})", str(len(each.rows)), *(str(count(each)[kind]) for kind in VERDICTS))
        for each in SOURCES
    ]
    lines = [HEAD, *table(("source", "checked", "reproduced", "read", "errata", "not computed"), summary)]
    lines += [line for source in SOURCES for line in section(source)]
    return "\n".join(lines) + "\nThis page is written by `python docs/scripts/make_sources.py`.\n"


def anchor(source: Source) -> str:
    """Return the anchor of a source's heading."""
    return source.name.lower().replace(" ", "-")


def count(source: Source) -> Counter[str]:
    """Return the number of rows of each verdict."""
    return Counter(row.verdict for row in source.rows)


def section(source: Source) -> Iterator[str]:
    """Yield the tables of one source."""
    right = [row for row in source.rows if row.verdict in (REPRODUCED, DECLARED)]
    equations = [row for row in right if isinstance(row.judge, Equal)]
    numbers = [row for row in right if row.printed]
    statements = [row for row in right if not row.printed and not isinstance(row.judge, Equal)]
    yield from (f"## {source.name}", "", f"{source.cite}. {source.text}", "")
    yield from table(("erratum", "place", "printed", "correct", "evidence"), errata(source))
    if equations:
        yield from table(("equations reproduced", "maximum relative difference"), equal(equations))
    if numbers:
        yield from table(("place", "number", "printed", "computed"), grouped(numbers))
    if statements:
        yield from table(("place", "statement", "computed"), [(r.place, r.claim, r.ours) for r in statements])
    outside = [row for row in source.rows if row.verdict == OUTSIDE]
    if outside:
        yield from table(("not computed", "reason"), not_computed(outside))


def errata(source: Source) -> list[tuple[str, ...]]:
    """Return the errata of a source, numbered by its first letter."""
    found = [row for row in source.rows if row.verdict == ERRATUM]
    return [
        (
            f"{source.name[:2]}{number}",
            row.place,
            ": ".join(filter(None, (row.claim, row.printed))),
            row.erratum,
            "; ".join(filter(None, (row.ours, row.why))),
        )
        for number, row in enumerate(found, 1)
    ]


def equal(rows: Iterable[Row]) -> list[tuple[str, ...]]:
    """Return the places of equations and the bound of their difference, a line for each bound."""
    bounds: dict[str, list[str]] = {}
    for row in rows:
        bounds.setdefault(row.ours.removeprefix("equal to "), []).append(row.place)
    return [("; ".join(merged(places)), bound) for bound, places in bounds.items()]


def merged(places: Iterable[str]) -> Iterator[str]:
    """Yield places, with `Eq.` once for consecutive equations."""
    last = ""
    for place in places:
        head, _, rest = place.partition(" ")
        yield rest if head == last == "Eq." else place
        last = head


def grouped(rows: Iterable[Row]) -> Iterator[tuple[str, ...]]:
    """Yield lines of printed numbers; numbers of one table and meaning share a line."""
    for (head, claim), same in groupby(rows, lambda row: (row.place.partition(", ")[0], general(row))):
        each = list(same)
        if len(each) == 1:
            yield each[0].place, each[0].claim, each[0].printed, each[0].ours
            continue
        items = [(row.place.partition(", ")[2], row.printed, short(row)) for row in each]
        computed = "equal" if all(a == b for _, a, b in items) else ", ".join(ours for *_, ours in items)
        yield head, claim, ", ".join(f"{name}: {printed}" for name, printed, _ in items), computed


def general(row: Row) -> str:
    """Return the meaning of a number; the equations of a listing share one."""
    return "residual of each equation" if row.claim.endswith(" = 0") else row.claim


def short(row: Row) -> str:
    """Return a computed value as a fraction if there is one, or as printed if it rounds to it."""
    return row.ours.partition(" = ")[0] if " = " in row.ours else row.ours


def not_computed(rows: Iterable[Row]) -> list[tuple[str, ...]]:
    """Return the places of statements that are not computed and the reason, a line for each reason."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        reason = row.why.partition("; ")[0] if row.why.startswith(NOT_COMPUTED) else row.why
        reasons.setdefault(reason, []).append(row.place)
    return [("; ".join(places), reason) for reason, places in reasons.items()]


def table(header: tuple[str, ...], body: Iterable[tuple[str, ...]]) -> Iterator[str]:
    """Yield a Markdown table."""
    yield "| " + " | ".join(header) + " |"
    yield "|" + "---|" * len(header)
    for row in body:
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |"
    yield ""


def show(requested: str) -> None:
    """Print the rows whose source and place contain the words."""
    for source in SOURCES:
        for row in source.rows:
            if requested.lower() in f"{source.name} {row.place}".lower():
                way = row.way or row.check
                cells = (row.place, row.claim, row.printed, row.ours, way.text if way else "", row.verdict, row.erratum)
                print(" | ".join(filter(None, (*cells, row.why))), "" if row.passes else "FAILS")


def main(requested: str = "") -> None:
    """Write the page, or print the requested rows."""
    if requested:
        show(requested)
        return
    PAGE.write_text(page(), encoding="utf-8")
    print("wrote docs/sources.md")


if __name__ == "__main__":
    main(" ".join(sys.argv[1:]))
