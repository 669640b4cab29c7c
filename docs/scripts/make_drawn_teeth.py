"""Write docs/drawn-teeth.md from a kept run of its study; `--measure` makes the run anew, in a browser."""

from __future__ import annotations

from studies.drawn_study import CYCLE, NOTHING, PITCH, DrawnRecords, all_trains, quick
from studies.page import from_command_line, paragraphs, read, write_page


def main() -> None:
    """Read the run, write the page."""
    (records,) = read(DrawnRecords, "drawn-teeth")
    write_page("drawn-teeth", [HEAD, told(records), "\n".join(records.tables())])


def told(records: DrawnRecords) -> str:
    """What the table says, in words."""
    rows = records.trains
    worst = max(rows, key=lambda row: row.worst)
    return paragraphs(
        TOLD,
        pairs=sum(row.pairs for row in rows),
        trains=len(rows),
        positions=sum(row.positions for row in rows),
        worst="nothing at all" if worst.worst == 0 else f"{worst.worst:.1e} of a tooth ({worst.train}, {worst.pair})",
        above=sum(row.worst > NOTHING for row in rows),
        nothing=f"{NOTHING:g}",
        left=sum(row.left.count(":") for row in rows),
    )


HEAD = f"""# Teeth as they are drawn do not run into each other

Written by

    python docs/scripts/make_drawn_teeth.py --measure

The page of every shipped train is opened in a browser and asked for the very triangles of its teeth, and for the
matrices by which it turns them. From these [manifold3d](https://github.com/elalish/manifold) makes closed solids and
intersects every tooth of a wheel with every near one of its mate: bevels, crowns, rings, lanterns, the threads of
worms, triangular teeth with their ripple. Lobes are intersected with the pins of their ring, and pins with the bars
that have their slots, or with the wheels that have slots or round holes for them. Positions are {PITCH} through a pitch
of each mesh, and {CYCLE} at random through the cycle of the train. What teeth have in common is given over the volume
of the smaller tooth.

That the measure can fail is shown beside it: one wheel is turned on by eighths of a pitch, a slot by 0.7 mm, and the
column says what is then in common at most, for the pair of the train of which this is least. Triangular teeth with
much play can be turned far before they touch, some by nearly a whole pitch.
"""

TOLD = """
In {pairs:,} pairs of {trains} trains, in {positions:,} positions, the most in common is {worst}; trains above {nothing}
of a tooth: {above}. Left out are {left} pairs that cannot stand as they are declared, which the package tells.

The wheel of a strain wave bends as it turns: its teeth are taken as they are bent in each position.
"""

if __name__ == "__main__":
    from_command_line({"drawn-teeth": all_trains}, quick, main)
