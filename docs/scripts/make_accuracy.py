"""Write docs/accuracy.md from kept runs of the study of speeds."""

from __future__ import annotations

from functools import partial

from studies.page import from_command_line, lowered, read, write_page
from studies.speed_study import SpeedRecord, SpeedRecords, speeds

RUNS = {
    "kinematics-small": partial(speeds, 1_000),
    "kinematics-large": partial(speeds, 100_000, 10_000),
    "kinematics-million": partial(speeds, 1_000_000, 1_000_000, ["tree"]),
    "kinematics-drift": partial(speeds, 100_000, 1_000, ["drift"]),
}
Rows = dict[tuple[str, int, str], SpeedRecord]
REFINED = "sparse LU, COLAMD, refined, with estimate"


def main() -> None:
    """Read the runs, write the page."""
    runs = read(SpeedRecords, *RUNS)
    rows = {(row.family, row.links, row.method): row for run in runs for row in run.rows}
    told = SpeedRecords(runs[0].title, list(rows.values()))
    write_page("accuracy", [HEAD, growth(rows), DEFAULT, findings(rows), TABLES, lowered(told.tables())])


def growth(rows: Rows) -> str:
    """Seconds of each step by size, and microseconds a link: constant where the growth is linear."""
    lines = [
        "| family | links | declare | circuits | exact | exact, us a link | memory of exact | one output |",
        "|---|---|---|---|---|---|---|---|",
    ]
    families = list(dict.fromkeys(family for family, *_ in rows))
    sizes = [(families.index(family), links) for family, links, method in rows if method in ONE and links > 500]
    for at, links in sorted(set(sizes)):
        family = families[at]
        cells = [_seconds(rows.get((family, links, name))) for name in DECLARE_AND_CIRCUITS]
        exact, one = (rows.get((family, links, name)) for name in ONE)
        each = f"{exact.seconds / links * 1e6:.2g}" if exact and exact.seconds else "-"
        memory = "-" if exact is None or exact.megabytes is None else f"{exact.megabytes:.0f} MB"
        lines.append(
            f"| {family} | {links} | {' | '.join(cells)} | {_seconds(exact)} | {each} | {memory} | {_seconds(one)} |"
        )
    return "\n".join(lines)


ONE = ("exact", "exact, one output")
DECLARE_AND_CIRCUITS = ("(declare: checked models from plain data)", "(find the circuits)")


def _seconds(row: SpeedRecord | None) -> str:
    if row is None:
        return "-"
    return row.note if row.seconds is None else f"{row.seconds:.3g} s"


def findings(rows: Rows) -> str:
    """What the run says, in sentences whose numbers are taken from it."""
    lines = []
    for family, links, _ in [key for key in rows if key[2] == "scipy spsolve" and key[1] >= 50_000]:
        exact, raw = rows[family, links, "exact"], rows[family, links, "scipy spsolve"]
        if exact.seconds and raw.seconds:
            lines.append(
                f"- {family}, {links} links: `spsolve` on the raw system takes {raw.seconds / exact.seconds:.3g} times "
                f"the exact solve, and is wrong by up to {raw.error or 0:.1e}."
            )
        elif exact.seconds:
            lines.append(
                f"- {family}, {links} links: `spsolve` did not finish ({raw.note}); exact took {exact.seconds:.2g} s."
            )
    for name in ("pennestri-2002", "freeth-2021"):
        links = next(key[1] for key in rows if key[0] == name)
        exact, compiled = rows[name, links, "exact"], rows.get((name, links, "compiled rationals, python-flint"))
        if exact.seconds and compiled and compiled.seconds:
            lines.append(
                f"- {name}, {links} links: exact in {exact.seconds * 1e3:.2g} ms, "
                f"{exact.seconds / compiled.seconds:.2g} times a compiled dense rational solver."
            )
    refined = [row.error for key, row in rows.items() if key[2] == REFINED and row.error is not None]
    raw_errors = [row.error for key, row in rows.items() if key[2] == "sparse LU, COLAMD" and row.error is not None]
    lines.append(
        "- Over all trains with an exact answer, the greatest relative error of any speed is "
        f"{max(raw_errors):.1e} for the raw LU and {max(refined):.1e} after one refinement step (rounding: 1.1e-16)."
    )
    return "\n".join(lines) + "\n"


HEAD = """# Error against run time

Written by

    python docs/scripts/make_accuracy.py --measure

on a machine with two cores. Compare times within a table only: they are ratios to the exact solve of the same train
in the same run. The matrices of the sparse solvers come with rows and columns in random order, as a model arrives, and
their times leave assembly out; the exact times start from the circuits and leave nothing out. Memory is what the
peak grew by. The true error is the greatest relative error of any speed against the exact answer; the exact answer
itself is checked by putting it into every raw equation.

Families: **chain** (two wheels an arbor, in a row, the ratio kept near 1), **drift** (the same with 23 to 27 teeth on
20 to 26: the ratio drifts, to 1e36 in a thousand links), **tree** (each wheel meshes with one drawn from those before),
**epicyclic** (coaxial shafts, each driven by a planet between two shafts drawn from those before), **cascade**
(planetary stages), **lattice** (a square of meshing wheels, one redundant mesh for each small square), **grid** (a
square of shafts, each the carrier of a differential between two neighbours: every speed depends on all).

## How the steps grow
"""

DEFAULT = """
Declaring, finding circuits and solving exactly grow nearly linearly with the links: a link costs two to three times as
much in a train of a hundred thousand as in one of a thousand, whose data fit a cache; a chain's numbers also grow, with
the square root of its length. Where the ratio drifts they grow with the length: each link is kept as a short ratio to
one before it, so that solving stays linear, but to read all speeds is to write their digits, which are as many as the
square of the links. One output is one product. Plain floats to compare with end where the ratio leaves float64, so
that large drifting trains are measured exactly only, and judged by fifty equations. The grid is the exception, by
construction: its circuits are all coupled, and its exact numbers grow with the train.

## The default

`solve()` is exact. Where walking from link to link reaches everything, the exact answer costs about what the refined
floats would; coupled planetary stages cost five to seven times that, a few hundredths of a second for a thousand
links. In return nobody has to judge conditioning, and mobility and gridlock are decided without a tolerance. Exact
elimination has a budget: beyond linear work it may spend 400 000 coefficient operations, long numbers counting more. A
coupled system whose elimination is predicted to exceed it is solved in floats with one refinement step whose residual
is taken to twice the working precision. The prediction is the elimination modulo the prime 2^61 - 1, whose numbers stay
short, and it stops after 40 000 operations beyond linear work. The verdict follows from the factors where their
condition is below 2^40, a thousand times less than that of a singular matrix, and is taken modulo the prime otherwise.
The answer says so by `method: floats` and a tilde, and `solve` prints the reason and the estimate of the error.

The float path reports an error estimate for each speed: two more solves with the residual left after refinement, and
what errors of any sign within twice the precision may move (by the inverse up to 400 links, by random signs beyond).
It reports the true error wherever the exact answer is within the budget (`geartrain solve FILE --method floats`). It
carries an exponent for each link where speeds leave the range of float64, rather than return a 0.

## What this run found
"""

TABLES = """## All measurements
"""

if __name__ == "__main__":
    from_command_line(RUNS, partial(speeds, 1_000, 0, ["chain", "epicyclic"]), main)
