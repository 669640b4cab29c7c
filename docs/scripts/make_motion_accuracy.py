"""Write docs/motion-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from functools import partial
from textwrap import fill

from matplotlib.axes import Axes
from studies.motion_records import (
    ADAPTIVE,
    BOUND,
    DIRECT,
    INDEPENDENT,
    LAGGED,
    NOMINAL,
    TABLES,
    MotionRecord,
    MotionRecords,
    TrainRecord,
)
from studies.motion_study import motion
from studies.page import HUES, INK, QUIET, from_command_line, lowered, paragraphs, picture, read, span, write_page

MARCHED = ("marching, 1 a position", "marching, 10 a position")
MINIMUM = 1e-14  # degrees: what is less is drawn here
# a colour of the palette and a marker for each; a line joins the methods of one name
LOOKS = {
    "direct composition": (INK, "X", (DIRECT,)),
    "composition, tabulated laws": (HUES[6], "o", TABLES),
    "superposition, lag counted": (HUES[0], "^", (LAGGED,)),
    "superposition": (HUES[2], "v", (NOMINAL,)),
    "sum of ranges (peak-to-peak)": (HUES[4], "P", (BOUND,)),
    "independent phases (rms)": (HUES[5], "*", (INDEPENDENT,)),
    "marching, 1 and 10 steps a position": (HUES[1], "s", MARCHED),
    "marching, adaptive": (HUES[3], "D", (ADAPTIVE,)),
}
Rows = dict[tuple[str, str], MotionRecord]


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(MotionRecords, "motion")
    rows = {(row.family, row.method): row for row in records.rows}
    head = HEAD.format(sample=records.trains[0].sample)
    parts = [head, which(records, rows), PLOT, trains(records), costs(records, rows), growth(records)]
    write_page("motion-accuracy", [*parts, ALL + lowered(records.tables_of_trains())])
    draw(records, rows)


def thousands(values: list[float]) -> str:
    """Least to greatest with two digits that count."""
    minimum, maximum = (f"{float(f'{each:.2g}'):,.0f}" for each in (min(values), max(values)))
    return f"{minimum} to {maximum}"


def every(rows: Rows, families: list[str], methods: tuple[str, ...], what: str) -> list[float]:
    """A number of the records of some methods on some trains, where it is there."""
    found = [getattr(rows[family, method], what) for family in families for method in methods]
    return [each for each in found if each is not None]


def toothed(records: MotionRecords) -> list[str]:
    """The trains with real teeth."""
    return [train.family for train in records.trains if "teeth" in train.family or "triangular" in train.family]


def which(records: MotionRecords, rows: Rows) -> str:
    """Which method to take when, in numbers of the run."""
    families, real = [train.family for train in records.trains], toothed(records)
    smooth = [family for family in families if family not in real]
    ripple = {train.family: train.outputs for train in records.trains}

    def share(method: str, what: str = "error") -> list[float]:
        """Errors of a method in percent of the peak-to-peak ripple of the same output."""
        found = []
        for family in real:
            row = rows[family, method]
            found.append(getattr(row, what) / ripple[family][row.output]["peak_to_peak"] * 100)
        return found

    bounds = [
        (rows[family, BOUND].error or 0) / ripple[family][rows[family, BOUND].output]["peak_to_peak"] * 100
        for family in families
    ]
    off = [
        (rows[family, INDEPENDENT].rms or 0) / ripple[family][rows[family, INDEPENDENT].output]["rms"] * 100
        for family in families
    ]
    return "## Which method when\n\n" + paragraphs(
        WHICH,
        direct=max(every(rows, families, (DIRECT,), "error")),
        rate=span([rate / 1e6 for rate in every(rows, families, (DIRECT,), "rate")]),
        gain=span([1 / ratio for ratio in every(rows, real, TABLES, "ratio")]),
        coarse=max(every(rows, families, TABLES[:1], "error")),
        fine=max(every(rows, families, TABLES[2:], "error")),
        pins=span(every(rows, smooth, TABLES, "ratio")),
        bound=span(bounds, ".1f"),
        rms=span(off, ".1f"),
        estimate=span([1e3 * each for each in every(rows, families, (BOUND, INDEPENDENT), "seconds")]),
        lag=span(share(LAGGED)),
        lag_rms=span(share(LAGGED, "rms")),
        nominal=span(share(NOMINAL)),
        cheap=span(every(rows, real, (LAGGED,), "ratio")),
        march=thousands(every(rows, real, MARCHED[:1], "ratio")),
        march_off=span(every(rows, real, MARCHED[:1], "error")),
        adaptive=thousands(every(rows, real, (ADAPTIVE,), "ratio")),
        adaptive_off=span(every(rows, real, (ADAPTIVE,), "error"), ".1g"),
        smooth=min(every(rows, smooth, MARCHED, "error")),
        quick=min(every(rows, smooth, (ADAPTIVE,), "ratio")),
        rough=min(every(rows, smooth, (ADAPTIVE,), "error")),
    )


def trains(records: MotionRecords) -> str:
    """What each train is, and which of its pairs have no law."""
    lines = ["## The trains\n"]
    for train in records.trains:
        ideal = f"; without a law: {ideals(train)}" if train.ideal else "; every pair has a law"
        text = (
            f"- **{train.family}**: {train.turns:g} turns of the input, 19 years; outputs {', '.join(train.outputs)}; "
            f"{len(train.rippling)} rippling pairs reach them, over {train.links} lively links{ideal}."
        )
        lines.append(fill(text, 120, subsequent_indent="  "))
    return "\n".join(lines) + "\n\n" + paragraphs(TRAINS)


def ideals(train: TrainRecord) -> str:
    """Pairs without a law: all gear pairs where only pins have one."""
    if len(train.ideal) > 5:
        pins = [name for name in train.ideal if "~" not in name and name not in ("games", "callippic")]
        return f"all gear pairs, and {', '.join(pins)}" if pins else "all gear pairs"
    return ", ".join(train.ideal)


def costs(records: MotionRecords, rows: Rows) -> str:
    """Rates, preparation and memory."""
    families = [train.family for train in records.trains]
    composed = (DIRECT, *TABLES)
    rates = every(rows, families, composed, "rate")
    lines = ["| train | " + " | ".join(f"{int(at):,} positions" for at in records.trains[0].peaks) + " |"]
    lines += ["|---" * (1 + len(records.trains[0].peaks)) + "|"]
    for train in records.trains:
        lines.append(f"| {train.family} | " + " | ".join(f"{each:.1f} MB" for each in train.peaks.values()) + " |")
    text = paragraphs(
        COSTS,
        minimum=min(rates) / 1e6,
        verdict="is met by all four trains" if min(rates) >= 1e6 else "is not met",
        chains=chains(records),
        direct=span([1e3 * each for each in every(rows, families, (DIRECT,), "prepared")]),
        tables=span([1e3 * each for each in every(rows, families, TABLES, "prepared")]),
    )
    return "## Rate, preparation and memory\n\n" + text + "\n" + "\n".join(lines) + "\n"


def chains(records: MotionRecords) -> str:
    """How the chains stand to the required rate."""
    slow = [row for row in records.growth if row.rate < 1e6]
    if not slow:
        return "The chains below meet it too, up to the longest."
    names = ", ".join(f"{row.pairs:,} pairs ({row.rate / 1e6:.2g} million)" for row in slow)
    return f"Of the chains below it is missed by that of {names}."


def growth(records: MotionRecords) -> str:
    """How preparation and time grow with the pairs of a chain."""
    table = "\n".join(records.table_of_chains())
    first, last = records.growth[0], records.growth[-1]
    text = paragraphs(
        GROWTH,
        pairs=f"{last.pairs / first.pairs:,.0f}",
        run=last.seconds / first.seconds,
        prepared=last.prepared / first.prepared,
        each=last.prepared / last.pairs * 1e3,
        windows=last.windows / first.windows,
        rate=last.rate / 1e6,
        chunk=last.chunk,
    )
    return "## How it grows with the number of pairs\n\n" + table + "\n" + text


# ------------------------------------------------------------------------------------------------------------ picture


def draw(records: MotionRecords, rows: Rows) -> None:
    """Greatest error over seconds, a marker a method, a panel a train."""
    with picture("motion-accuracy", 2, 2, figsize=(9.4, 8.4), sharex=True, sharey=True) as (figure, axes):
        times = [row.seconds for row in records.rows if row.seconds]
        for ax, train in zip(axes.flat, records.trains, strict=True):
            panel(ax, train, rows)
            ax.set(xscale="log", yscale="log", ylim=(MINIMUM / 3, 3e3), xlim=(min(times) / 3, max(times) * 3))
        positions = records.trains[0].positions
        figure.supxlabel(f"seconds for {positions:,} positions, preparation apart")
        figure.supylabel("greatest error, degrees at the output")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)


def panel(ax: Axes, train: TrainRecord, rows: Rows) -> None:
    """One train: every method, and the ripple as a line."""
    for name, (colour, marker, methods) in LOOKS.items():
        points = [point(rows[train.family, method]) for method in methods]
        size = {"*": 12, "X": 10, "P": 9}.get(marker, 7)
        width = 1.4 if len(points) > 1 else 0
        ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=size, lw=width, label=name)
    if rows[train.family, LAGGED].error == 0:
        seconds = rows[train.family, LAGGED].seconds
        ax.annotate("none", (seconds, MINIMUM), (10, -1), textcoords="offset points", va="center", fontsize=9)
    most = max(each["peak_to_peak"] for each in train.outputs.values())
    ax.axhline(most, color=QUIET, lw=1, ls="--")
    ax.text(0.98, most * 1.6, "ripple itself", transform=ax.get_yaxis_transform(), ha="right", color=QUIET, fontsize=9)
    ax.set_title(train.family, fontsize=11)
    ax.set_yticks([10.0**at for at in range(-14, 4, 2)])


def point(row: MotionRecord) -> tuple[float, float]:
    """Seconds and error of a record."""
    error = row.rms if row.error is None else row.error
    assert row.seconds is not None
    assert error is not None
    return row.seconds, max(error, MINIMUM)


HEAD = """# Error against run time: the motion of whole trains

Written by

    python docs/scripts/make_motion_accuracy.py --measure

on a machine with two cores, busy with other work too. Compare times within a train only: they are medians of five
rounds, and ratios to the direct composition in the same round. Run times and memory are kept from an earlier run with
the same settings. The methods:

- **direct**: the composition of `geartrain motion`. In the solved order of the train every pair's law is asked at the
  angle that the errors before it give its driver. Errors and speeds come together.
- **tabulated**: the same composition, laws read from tables of the given tolerance (in pitches):
  `geartrain motion --tabulated`.
- **superposition**: the sum of all pairs' errors times the output's sensitivity, each driver turning evenly from its
  angle at turn 0; **with lag**, about the angle to which the mean errors of all pairs bring it.
- **sum of ranges**: sensitivities times the ranges of the pairs' errors, a bound on the peak-to-peak ripple.
- **independent rms**: the rms ripple if no phases were related. Neither asks for a position.
- **marching**: what a general multibody program does. All angles are advanced in time; at each stage every pair says
  its instantaneous ratio, and one linear system gives the speeds of all links. By the classical method of Runge and
  Kutta with 1 or 10 steps to a position, or by scipy's adaptive RK45 with a relative tolerance of 1e-9. It is given the
  start and the formulas of the ratios for free. It was followed over the first 1/200 of the positions only, its time
  extrapolated to all and its error, which grows with the way, left as it stands there.

Errors are in degrees of the output that has the greatest. They are judged against the direct composition at the same
positions; for the sum of ranges it is that of the peak-to-peak ripple, for independent phases that of its rms. The
direct composition itself is judged at {sample} random positions, and where it differs most from the finest tables,
against 40 digits: teeth by the contact of one couple from the two lines of flanks, every couple in reach asked; pins by
their triangle; the spread of errors by exact elimination of all rows of the train at once, without the solved order;
each pair asked again until nothing changes. Where mpmath is not installed, the machine's longest floats are used.
"""

WHICH = """
- Take the direct composition. It is right to {direct:.1e} degrees over 19 years, {rate} million links a second, and
nothing else gives the truth of a train whose pairs modulate each other.

- Take tables (`--tabulated 1e-12`) in trains of teeth where preparation is little beside the run: they go {gain} times
as fast, and are off by {fine:.1e} degrees at most; {coarse:.1e} at a tolerance of 1e-6. The run takes as long at any
tolerance, so there is little reason to ask for less than 1e-12. For pins alone a table saves little or nothing, since
their formula is as short ({pins} of the direct time).

- Take the sum of ranges and independent phases (`--estimates`) to compare many designs: {estimate} milliseconds a
train, whatever the span. The sum is {bound} percent above the peak-to-peak ripple, the rms {rms} percent off.

- Superpose with lag to see the shape of a ripple or its spectrum, not for its values: the greatest error is {lag}
percent, the rms error {lag_rms} percent of the peak-to-peak ripple, at {cheap} of the direct time. Without the lag the
greatest error is {nominal} percent: it leaves out by how much the mean lag differs from that of turn 0. Where one pin
alone stands between input and output, superposition is the truth.

- Do not march. One step a position takes {march} times as long and is {march_off} degrees off already at the first
1/200 of the way, because steps go over the corners of the laws, where a tooth hands over to the next. Error control
finds each corner by shrinking the step: {adaptive} times as long, and still {adaptive_off} degrees off. Where nothing
has a corner, as with pins alone, marching is only slow: adaptive, {rough:.0e} degrees at {quick:.0f} times the direct
time, and {smooth:.0e} degrees with as many steps as positions.
"""

PLOT = """![Greatest error over seconds, for four trains](images/motion-accuracy.svg)

Lower and further left is better. The dashed line is the greatest peak-to-peak ripple of the train: a method near it
knows nothing of where the output stands. Errors below 1e-14 degrees are drawn there.
"""

TRAINS = """
Triangular teeth have a half angle of 30 degrees and stand in the middle of each pair's own window of clearance. Every
pair of Price's train and of Freeth's admits such teeth. Those between a contrate and a spur wheel (A~B1, A~A2, a1~b1,
b0~ph1) take the law of two spur wheels, as everywhere in geartrain. The pin that carries the true Sun has no published
sizes and stays ideal; no output asked for depends on it.

In Price's train the Sun's dial does not ripple: two equal wheels turn on one crank wheel, and what one pair takes the
other gives back. Around its differential three pairs depend on each other, and so does the crank, which drives what the
input turns: their errors are found by iteration, at the cost of some evaluations of each law.
"""

COSTS = """
The requirement of 10^6 positions times links a second for composed motion {verdict}: their slowest composition, direct
or tabulated, goes through {least:.2g} million. Lively links are those that an error reaches and an output depends on.
{chains}

Preparing, from the text of the declaration to the first position, takes {direct} milliseconds for direct composition,
most of it the windows of clearance, found once for each kind of pair; and {tables} for tables.

Memory is bounded by the stretch of positions worked on at once (32768, less in long trains), not by their number. Peaks
of the direct composition:
"""

GROWTH = """
Chains of pairs of triangular teeth in the middle of their windows, 40 to 76 teeth in steps of four, of each pair the
wheel driving that brings the whole ratio back to 1. From the first row to the last the pairs are {pairs} times as many,
the run takes {run:,.0f} times as long and the spread and laws {prepared:,.0f} times, {each:.2g} ms a pair; the windows
only {windows:.0f} times, since a hundred kinds of pairs are all there are. The longest chain works on {chunk} positions
at once, so that its memory stays bounded; the cost of each call then shows, and its rate falls to {rate:.2g} million
links a second.
"""

ALL = """## All measurements

"""

if __name__ == "__main__":
    from_command_line({"motion": motion}, partial(motion, quick=True), main)
