"""Write docs/mesh-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

import re
from functools import partial
from textwrap import fill

from studies.mesh_study import DIRECT, SCANNED, TABULATED, MeshRecord, MeshRecords, meshes
from studies.page import HUES, INK, from_command_line, lowered, picture, read, span, write_page

MANY = 1_000_000  # angles over which building is spread
Rows = dict[tuple[str, str, str], MeshRecord]
SHOWN = ("48/96", "3/7", "1000/3000", "100000/100000")
# a colour of the palette and a marker for each
LOOKS = {
    "sampled and interpolated": (HUES[1], "s", r"sampled, \d+"),
    "tabulated, 2 to 256 cells": (HUES[0], "o", r"tabulated, \d+ cells"),
    "tabulated, default": (HUES[6], "*", "tabulated"),
    SCANNED: (HUES[3], "D", SCANNED),
    DIRECT: (INK, "X", DIRECT),
}


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(MeshRecords, "mesh")
    rows = {(row.family, row.method, row.quantity): row for row in records.rows}
    # growth has a table of its own
    kept = MeshRecords(records.title, [row for row in records.rows if not row.family.startswith("growth")])
    parts = [HEAD, default(rows), PLOT, growth(rows), findings(rows), TABLES, lowered(kept.tables())]
    write_page("mesh-accuracy", parts)
    draw(rows)


def pairs(rows: Rows) -> list[str]:
    """The pairs of the run, in its order."""
    return list(dict.fromkeys(family for family, *_ in rows if not family.startswith("growth")))


def per_angle(rows: Rows, pair: str, method: str) -> float | None:
    """Nanoseconds an angle for the transmission error at a million angles, building included."""
    built, requested = rows.get((pair, method, "path")), rows.get((pair, method, "error"))
    if built is None or requested is None or built.seconds is None or requested.seconds is None:
        return None
    return (built.seconds / MANY + requested.seconds / requested.angles) * 1e9


def seconds(rows: Rows, pair: str, method: str, quantity: str) -> float:
    """Seconds of a measurement that must be there."""
    found = rows[pair, method, quantity].seconds
    assert found is not None
    return found


def errors(rows: Rows, pattern: str, quantity: str = "error") -> list[float]:
    """True errors over all pairs of the methods whose name matches."""
    return [
        row.error
        for (_, method, requested), row in rows.items()
        if requested == quantity and re.fullmatch(pattern, method) and row.error is not None
    ]


def default(rows: Rows) -> str:
    """The default and why, in numbers of the run."""
    every = pairs(rows)
    rate = [rows[pair, DIRECT, "error"].angles / seconds(rows, pair, DIRECT, "error") / 1e6 for pair in every]
    fast = [rows[pair, TABULATED, "error"].angles / seconds(rows, pair, TABULATED, "error") / 1e6 for pair in every]
    gain = [seconds(rows, pair, DIRECT, "error") / seconds(rows, pair, TABULATED, "error") for pair in every]
    more = [
        (seconds(rows, pair, TABULATED, "path") - seconds(rows, pair, DIRECT, "path"))
        / (seconds(rows, pair, DIRECT, "error") - seconds(rows, pair, TABULATED, "error"))
        * rows[pair, DIRECT, "error"].angles
        for pair in every
    ]
    built = [seconds(rows, pair, DIRECT, "path") * 1e3 for pair in every]
    text = DEFAULT.format(
        worst=max(errors(rows, DIRECT)),
        rate=span(rate),
        built=span(built),
        fast=span(fast),
        gain=span(gain),
        table=max(errors(rows, TABULATED)),
        pays=round(max(more), -3),
        minimum=round(min(more), -3),
    )
    return HEADING + fill(text, 120) + "\n"


def growth(rows: Rows) -> str:
    """Milliseconds of building by the number of teeth."""
    methods = ((DIRECT, "path"), (SCANNED, "path"), ("sampled, 1000", "path"), (DIRECT, "window"))
    lines = [
        "| z/z | couples in reach | direct | scan of all couples | sampled, 1000 | window, direct |",
        "|---|---|---|---|---|---|",
    ]
    families = list(dict.fromkeys(family for family, *_ in rows if family.startswith("growth")))
    for family in families:
        cells = [f"{seconds(rows, family, *method) * 1e3:.3g} ms" for method in methods]
        lines.append(f"| {family.split()[1]} | {rows[family, DIRECT, 'path'].tooth_pairs} | {' | '.join(cells)} |")
    first, last = families[0], families[-1]
    ratios = [seconds(rows, last, *method) / seconds(rows, first, *method) for method in methods]
    tooth_pairs = rows[last, DIRECT, "path"].tooth_pairs / rows[first, DIRECT, "path"].tooth_pairs
    teeth = int(last.split("/")[1]) / int(first.split("/")[1])
    return "\n".join(lines) + "\n\n" + fill(GROWTH.format(*ratios, tooth_pairs=tooth_pairs, teeth=teeth), 120) + "\n"


def findings(rows: Rows) -> str:
    """What the run says, in sentences whose numbers are taken from it."""
    lines = []
    for pair in pairs(rows):
        sampled = [
            method for family, method, what in rows if family == pair and what == "error" and "sampled" in method
        ]
        finest = max(sampled, key=lambda method: int(method.split()[1]))
        ours, theirs = per_angle(rows, pair, DIRECT), per_angle(rows, pair, finest)
        error, speed = rows[pair, finest, "error"].error, rows[pair, finest, "speed"].error
        if ours and theirs:
            lines.append(
                f"{pair}: {finest.split()[1]} samples of all couples cost {theirs / ours:.3g} times the direct formula "
                f"over a million angles, and are wrong by up to {error:.1e} of a pitch; their speed by up to "
                f"{speed:.1e} of its mean."
            )
    scans = [seconds(rows, pair, SCANNED, "path") / seconds(rows, pair, DIRECT, "path") for pair in pairs(rows)]
    tables = [row for (_, method, _), row in rows.items() if method == TABULATED and row.note]
    largest = max(tables, key=lambda row: int(row.note.split()[0]))
    usual = [float(row.note.split()[0]) for row in tables if row.family != largest.family]
    lines += [
        f"The scan of all couples finds the same path (greatest error {max(errors(rows, SCANNED)):.1e} of a pitch), "
        f"but takes {span(scans)} times as long to build, and would miss an interval shorter than its step.",
        f"The table takes {span(usual)} cells; {largest.family} teeth, whose law is steep just before a tooth leaves, "
        f"take up to {largest.note}.",
        f"The speed's greatest true error is {max(errors(rows, DIRECT, 'speed')):.1e} of the mean direct and "
        f"{max(errors(rows, TABULATED, 'speed')):.1e} tabulated.",
    ]
    points = [fill(line, 120, initial_indent="- ", subsequent_indent="  ") for line in lines]
    return "## What this run found\n\n" + "\n".join(points) + "\n"


# ------------------------------------------------------------------------------------------------------------ picture


def draw(rows: Rows) -> None:
    """True error over cost an angle, a line a method, a panel a pair."""
    with picture("mesh-accuracy", 2, 2, figsize=(8.6, 7.4), sharex=True, sharey=True) as (figure, axes):
        for ax, pair in zip(axes.flat, SHOWN, strict=True):
            for name, (colour, marker, pattern) in LOOKS.items():
                points = curve(rows, pair, pattern)
                alone = 13 if marker == "*" else 9
                size = 6 if len(points) > 1 else alone
                ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=size, lw=1.6, label=name)
            tooth_pairs = rows[pair, DIRECT, "error"].tooth_pairs
            ax.set_title(f"{pair}, {tooth_pairs} {'couple' if tooth_pairs == 1 else 'couples'} in reach", fontsize=11)
            ax.set(xscale="log", yscale="log", ylim=(1e-16, 1e-1), xlim=(8, 8000))
        figure.supxlabel("ns an angle over a million angles, building included")
        figure.supylabel("greatest true error, pitches of the driven wheel")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)


def curve(rows: Rows, pair: str, pattern: str) -> list[tuple[float, float]]:
    """Cost and error of the methods whose name matches, in the order of the run."""
    points = []
    for (family, method, quantity), row in rows.items():
        if family == pair and quantity == "error" and re.fullmatch(pattern, method) and row.error is not None:
            cost = per_angle(rows, pair, method)
            if cost is not None:
                points.append((cost, row.error))
    return points


HEAD = """# Error against run time: the law of triangular teeth

Written by

    python docs/scripts/make_mesh_accuracy.py --measure

on a machine with two cores. Compare times within a pair only: they are ratios to the direct formula in the same run.
The methods:

- **direct**: `TriangularTransmission`. Of all couples of teeth only those that can be lowest are asked, the switching
  points are roots found to rounding, and each angle takes one formula.
- **tabulated**: `TabulatedTransmission(transmission)`. Polynomials of degree 4 on uniform cells cut at the corners
of the law,
  from the law's own answers at Chebyshev nodes within each cell. As many cells as it takes for 1e-12 of a driven pitch
  (default), or as many as given.
- **sampled**: the lowest of all couples in reach at so many positions of a pitch, linear between.
- **scan of all couples**: who drives is asked of all couples at 128 positions of a pitch, each change is narrowed down
  by halving, and then the direct formula answers.

The true error is judged against the definition of the law in 40 digits: the contact of one couple from the two lines
of flanks in the textbook form, every couple in reach asked, at random angles and at angles that crowd towards every
corner. It is in pitches of the driven wheel, or relative to the mean speed ratio. Where mpmath is not installed, the
machine's longest floats are used instead of 40 digits. Memory is what the peak grew by.
"""

HEADING = """## The default

"""

DEFAULT = """Evaluate directly. The formula answers {rate} million angles a second, builds in {built} ms, and is right
to {worst:.1e} of a pitch: nothing that interpolates comes near that without being made from it. Tabulate where a law is
asked at very many angles, as in long spans of a train: a table answers {fast} million angles a second, {gain} times the
direct rate, and its true error in this run is at most {table:.1e} of a pitch. It pays for itself after {least:,.0f} to
{pays:,.0f} angles.
"""

PLOT = """![True error over cost an angle, for four pairs](images/mesh-accuracy.svg)

Lower and further left is better. Sampling gains one digit for ten times the samples, because the corners lie between
samples, and its speed does not converge at a corner at all. The table cuts its cells at the corners, and gains a digit
and a half for twice the cells until rounding is reached.

## How building grows with the number of teeth

Equal wheels in the middle of their window of clearance, the worst place for the direct path: there the two couples that
take turns differ little over a whole pitch.
"""

GROWTH = """From the first row to the last the teeth are {teeth:,.0f} times as many, and the couples within reach
{couples:.0f} times. Building directly takes {0:.1f} times as long, the scan {1:.1f} times and sampling {2:.0f} times;
the window of clearance, which asks many laws, {3:.0f} times.
"""

TABLES = """## All measurements
"""

if __name__ == "__main__":
    from_command_line({"mesh": meshes}, partial(meshes, quick=True), main)
