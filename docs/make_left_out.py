"""Write docs/left-out.md: every shipped train without some of its arbors, and the train's rank in what is found.

`python docs/make_left_out.py --measure` asks anew and keeps the answers in docs/data/left-out.json (minutes to hours);
a run that is stopped is taken up by the same command. Without it the page is written from what is kept.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path

from studies.left_out_records import LeftOutRecords
from studies.left_out_study import LIMIT, QUICK, forget, left_out, tree_records
from studies.page import lowered, paragraphs, read

from geartrain import shipped

DOCS = Path(__file__).resolve().parent
PAGE, DATA = DOCS / "left-out.md", DOCS / "data" / "left-out.json"
JOURNAL = DATA.with_suffix(".journal")

HEAD = """# Trains found again

Written by

    python docs/make_left_out.py --measure

What is a reconstruction worth? Where the answer is known, one can see. Of every shipped train arbors are left out,
each one and each two, and `geartrain reconstruct` is asked for all trains that explain what is left: the other arbors
with the wheels that mesh, their counts as used in the train, and the speeds of all pointers. Who meshes with whom is
not told, nor which arbors share an axis. By hand the same is

    geartrain reconstruct isfahan-astrolabe-1221 --without pivot
"""

RULES = """
- Asked are trees: arbors on the frame that spur wheels drive from one input, without rings and loops. Where a train
has more, its tree is taken alone, such as all behind the table of the Moon in the Antikythera mechanism; what is not
in it is named.

- A pointer is an output that has a target and whose speed is known; where none follows, the last arbor whose speed is
declared. It stands on its arbor where that survives, else on a new one. Its speed is exact where `expect` is
declared, else within the tolerance of its target. Arbors that lead to no pointer, and wheels that mesh with nothing,
are left out throughout.

- As many wheels may be added as are lost, of as many teeth as any wheel of the tree has. Every surviving wheel must
mesh, also one all of whose partners are lost. A driven wheel may drive where one does in the tree.

- The rank is that by weight, with the factors that evidence has by default. Explanations with equally many added
wheels and arbors weigh the same, so that a rank mostly is a range. Classes do not tell apart what drives what.
"""

FOUND = """
There are {possible} such questions. {asked} were asked and {whole} finished in the processor time that each had; two
arbors are not left out where one of them alone was not finished. The train itself was found in {found} of the finished
ones{lost}; {many} have too many explanations to list. In {first} it has none of more weight above it, and in {alone} it
is the only one of the greatest weight. {more} have explanations with fewer wheels than were lost, which then weigh
more.
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
    found = paragraphs(
        FOUND,
        possible=f"{records.possible:,}",
        asked=f"{len(records.rows):,}",
        whole=f"{len(records.whole):,}",
        found=f"{len(ranks):,}",
        many=f"{sum(not row.listed and row.rank is None for row in records.whole):,}",
        lost=lost if records.lost else "",
        first=f"{sum(rank[0] == 1 for rank in ranks):,}",
        alone=f"{sum(rank[1] == 1 for rank in ranks):,}",
        more=f"{sum(row.least is not None and row.least < row.added for row in records.whole):,}",
    )
    return [HEAD, found, "## What is asked\n", paragraphs(RULES), lowered(records.tables())]


def merged(kept: LeftOutRecords, new: LeftOutRecords) -> LeftOutRecords:
    """A kept run with some trains asked anew, and the trees of all trains as they are shipped now."""
    every = tree_records(tuple(shipped()))
    again = {row.train for row in new.rows}
    rows = [row for row in kept.rows if row.train not in again] + list(new.rows)
    trees = [tree.train for tree in every.trees]
    return replace(
        every, rows=sorted((row for row in rows if row.train in trees), key=lambda row: trees.index(row.train))
    )


def from_command_line() -> None:
    """Write the page; with `--measure` after its run was made anew, with `--quick` print a short run instead."""
    asked = argparse.ArgumentParser(description="Write docs/left-out.md from its kept run.")
    asked.add_argument("--measure", action="store_true", help="ask anew, which takes minutes to hours")
    asked.add_argument("--quick", action="store_true", help="print the tables of a short run, and write nothing")
    asked.add_argument(
        "--limit", type=float, default=LIMIT, help="processor seconds for a question (default %(default)g)"
    )
    asked.add_argument("--workers", type=int, default=1, help="questions at once (default %(default)s)")
    asked.add_argument(
        "--train",
        action="append",
        default=[],
        help="ask of this train alone, and write nothing; with --measure put it among the others",
    )
    given = asked.parse_args()
    if given.quick or (given.train and not given.measure):
        names = given.train or QUICK
        print(left_out(names, given.limit, given.workers).to_markdown())
        return
    if given.measure:
        found = left_out(given.train, given.limit, given.workers, JOURNAL)
        if given.train:
            found = merged(read(LeftOutRecords, DATA.stem)[0], found)
        text = json.dumps(found.to_dict(), indent=1, ensure_ascii=False, allow_nan=False)
        DATA.write_text(text + "\n", encoding="utf-8")
        forget(JOURNAL)
    main()


if __name__ == "__main__":
    from_command_line()
