"""Write docs/left-out.md: every shipped train without some of its arbors, and the train's rank in what is found.

`python docs/scripts/make_left_out.py --measure` asks anew and keeps the answers in docs/data/left-out.json (minutes to
hours); a run that is stopped is taken up by the same command. `--more 20` asks for 20 minutes what the kept run lacks.
Without either the page is written from what is kept.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path

from studies.left_out_records import LeftOutRecords
from studies.left_out_study import LIMIT, QUICK, SHORT, forget, left_out, more_left_out, tree_records
from studies.page import lowered, paragraphs, read

from geartrain import shipped

DOCS = Path(__file__).resolve().parents[1]
PAGE, DATA = DOCS / "left-out.md", DOCS / "data" / "left-out.json"
JOURNAL = DATA.with_suffix(".journal")

HEAD = """# Trains found again

Written by

    python docs/scripts/make_left_out.py --measure

What is a reconstruction worth? Where the answer is known, one can see. Of every shipped train arbors are left out,
each one and each two of a part, and `geartrain reconstruct` is asked for all trains that explain what is left: the
other arbors with the wheels that mesh, their counts as used in the train, and the speeds of all pointers. Who meshes
with whom is not told, nor which arbors share an axis. By hand the same is

    geartrain reconstruct isfahan-astrolabe-1221 --lost pivot
"""

RULES = """
- A train is asked of part by part. A part is a tree: arbors that turn on the frame, or on one carrier, and that spur
wheels and rings drive from one of them. The first begins at the input. Where what bears the arbors changes another
part begins: on a carrier at the fixed wheels of the frame, or else at an arbor of an earlier part, whose speed is then
given; so behind a carrier too. Speeds are seen from the carrier, whose own is given. Links that a pin in a slot joins
are one arbor of it, and are lost together. `--from LINK` chooses a part by the link at which it begins.

- A pointer is an output that has a target and whose speed is known; where none follows, the last arbor whose speed is
declared. It stands on its arbor where that survives, else on a new one. Its speed is exact where `expect` is
declared, else within the tolerance of its target. Arbors that lead to no pointer, and wheels that mesh with nothing,
are left out throughout.

- As many wheels may be added as are lost, of as many teeth as any wheel of the part has, and in later parts as any of
all parts. Every surviving wheel must mesh, also one all of whose partners are lost. A driven wheel may drive where one
does in the part. No ring is added, so an arbor with one is not lost.

- Two arbors of different parts are not left out together: each part is a question of its own, whose answers are
combined with all of the other.

- The rank is that by weight, with the factors that evidence has by default. Explanations with equally many added
wheels and arbors weigh the same, so that a rank mostly is a range. Classes do not tell apart what drives what.

## What else is asked

A question may have too many explanations to count in a minute. So smaller ones are asked too, of one and of two arbors
alike.

- *Is the train found?* Where all explanations are listed, it is one of them (`listed`). Else the search is followed to
it: the lists of paths are made with those ways alone that the train takes, and paths are chosen and put together to
trees by the search itself. Whatever it rules out on the way, for all the reasons that it has, it would rule out here
too. What the train does not need is not looked for, and counts are held against what is wanted, not counted
(`followed`). Nothing but the evidence is told.

- *How does it rank where meshes are told?* The meshes of all wheels that survive are told (`--seen`), and no more
arbors may be added than are lost. So only what is lost is looked for, as where a mechanism lacks some of its arbors and
the rest stands.

- *Does anything weigh more?* An explanation that weighs more has fewer wheels than were lost, or as many and fewer
added arbors. All with fewer wheels are asked for; and all with as many wheels on fewer arbors, unless the pointers that
are lost need so many by their speeds. If both end, the first rank is known, exactly. The last rank is not: it would
take all explanations that weigh the same.

- `none with 4` says that none was found with up to 4 added wheels, which is as far as the search came.
"""

FOUND = """
There are {possible} such questions in {parts} parts of {trains} trains. {whole} were asked to the end. The train itself
was found in {found} of these{lost}; {many} have too many explanations to list. Followed along its own paths, the search
comes to the train in {reached}. So it was found in {every} questions, and missed in {missed}; {open} are open.

Where nothing but the surviving wheels and the pointers is told, its first rank is known in {ranked} questions. In
{first} nothing weighs more than the train, and in {alone} it is known to be the only one of the greatest weight. {more}
have explanations with fewer wheels than were lost. Where the meshes of what survives are told too, its rank is known in
{told}: in {best} nothing weighs more, and in {only} it is the only one of the greatest weight. What is open did not end
in the time that it had, or is still to be asked (`--more`).
"""


def main() -> None:
    """Read the run, write the page."""
    (records,) = read(LeftOutRecords, DATA.stem)
    PAGE.write_text("\n".join(page(records)), encoding="utf-8")
    print("wrote docs/left-out.md")


def page(records: LeftOutRecords) -> list[str]:
    """The page, part by part."""
    ranks = [row.rank for row in records.whole if row.rank is not None]
    lost = "; not: " + ", ".join(f"{row.train} without {' and '.join(row.lost)}" for row in records.lost)
    told = [row.told for row in records.rows if row.told is not None]
    many = sum(row.is_whole and not row.listed and row.rank is None for row in records.rows)
    numbers = {
        "possible": records.possible,
        "parts": len(records.trees),
        "trains": len({tree.train for tree in records.trees}),
        "whole": len(records.whole),
        "found": len(ranks),
        "many": many,
        "reached": sum(bool(row.reached) for row in records.rows),
        "open": records.possible - sum(row.is_found for row in records.rows) - len(records.lost),
        "every": sum(row.is_found for row in records.rows),
        "missed": len(records.lost),
        "ranked": sum(row.first is not None for row in records.rows),
        "first": sum(row.first == 1 for row in records.rows),
        "told": len(told),
        "best": sum(rank[0] == 1 for rank in told),
        "only": sum(rank[1] == 1 for rank in told),
        "alone": sum(rank[1] == 1 for rank in ranks),
        "more": sum(row.minimum is not None and row.minimum < row.added for row in records.rows),
    }
    found = paragraphs(
        FOUND, lost=lost if records.lost else "", **{name: f"{number:,}" for name, number in numbers.items()}
    )
    return [HEAD, found, "## What is asked\n", paragraphs(RULES), lowered(records.tables())]


def merged(kept: LeftOutRecords, new: LeftOutRecords) -> LeftOutRecords:
    """A kept run with some trains asked anew, and the trees of all trains as they are shipped now."""
    every = tree_records(tuple(shipped()))
    again = {row.train for row in new.rows}
    rows = [row for row in kept.rows if row.train not in again] + list(new.rows)
    parts = [(tree.train, tree.part) for tree in every.trees]
    known = [row for row in rows if (row.train, row.part) in parts]
    return replace(every, rows=sorted(known, key=lambda row: parts.index((row.train, row.part))))


def _keep(found: LeftOutRecords) -> None:
    text = json.dumps(found.to_dict(), indent=1, ensure_ascii=False, allow_nan=False)
    DATA.write_text(text + "\n", encoding="utf-8")


def from_command_line() -> None:
    """Write the page; with `--measure` after its run was made anew, with `--quick` print a short run instead."""
    requested = argparse.ArgumentParser(description="Write docs/left-out.md from its kept run.")
    requested.add_argument("--measure", action="store_true", help="ask anew, which takes minutes to hours")
    requested.add_argument("--quick", action="store_true", help="print the tables of a short run, and write nothing")
    requested.add_argument(
        "--limit", type=float, default=LIMIT, help="processor seconds for a question (default %(default)g)"
    )
    requested.add_argument("--workers", type=int, default=1, help="questions at once (default %(default)s)")
    requested.add_argument(
        "--train",
        action="append",
        default=[],
        help="ask of this train alone, and write nothing; with --measure put it among the others",
    )
    requested.add_argument(
        "--short",
        type=float,
        default=SHORT,
        help="processor seconds for what is asked of an unfinished question (default %(default)g)",
    )
    requested.add_argument("--more", type=float, help="run missing questions for N minutes and keep the results")
    given = requested.parse_args()
    if given.more:
        (kept,) = read(LeftOutRecords, DATA.stem)
        _keep(more_left_out(kept, given.train, given.limit, given.short, given.more))
        main()
        return
    if given.quick or (given.train and not given.measure):
        names = given.train or QUICK
        print(left_out(names, given.limit, given.workers).to_markdown())
        return
    if given.measure:
        found = left_out(given.train, given.limit, given.workers, JOURNAL, given.short)
        if given.train:
            found = merged(read(LeftOutRecords, DATA.stem)[0], found)
        _keep(found)
        forget(JOURNAL)
    main()


if __name__ == "__main__":
    from_command_line()
