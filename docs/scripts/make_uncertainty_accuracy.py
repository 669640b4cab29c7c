"""Write docs/uncertainty-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from matplotlib.axes import Axes
from studies.cut_pair_trials import EVERY, PLACES
from studies.page import HUES, INK, LINE, from_command_line, lowered, paragraphs, picture, read, write_page
from studies.page import span as span_of
from studies.uncertainty_records import COUNTS, DISPLACED, SINGLY, RateRecord, UncertaintyRecords, at_one
from studies.uncertainty_study import uncertainty

COLOURS = (HUES[0], HUES[1], HUES[3], HUES[2])
MARKERS = ("o", "s", "^", "D")
GOALS = {COUNTS: 1e6, PLACES: 1e6, EVERY: 1e5, DISPLACED: 1e5}


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(UncertaintyRecords, "uncertainty")
    parts = [HEAD, which(records), PLOT, rates(records), estimates(records), workers(records), memory(records)]
    write_page("uncertainty-accuracy", [*parts, ALL + lowered(records.tables())])
    draw(records)


def number(value: float) -> str:
    """Two digits, in millions where there are some."""
    if value >= 1e6:
        return f"{value / 1e6:.2g} million"
    return f"{float(f'{value:.2g}'):,.0f}" if value >= 10 else f"{value:.2g}"


def span(values: Sequence[float]) -> str:
    """Least to greatest, in these numbers."""
    return span_of(values, number)


def together(records: UncertaintyRecords, family: str) -> list[RateRecord]:
    """What is done many at a time."""
    return [row for row in records.rates if row.family == family and row.method != SINGLY]


def singly(records: UncertaintyRecords, family: str) -> list[RateRecord]:
    """The loops."""
    return [row for row in records.rates if row.family == family and row.method == SINGLY]


def met(rows: Sequence[RateRecord], family: str) -> str:
    """Whether what was asked for is reached."""
    goal, reached = GOALS[family], [row for row in rows if row.rate >= GOALS[family]]
    if len(reached) == len(rows):
        return f"more than the {number(goal)} asked for"
    if not reached:
        return f"less than the {number(goal)} asked for"
    cases = ", ".join(row.case if family != COUNTS else row.method for row in reached)
    return f"the {number(goal)} asked for are reached with {cases}, not with the rest"


def which(records: UncertaintyRecords) -> str:
    """What to count on, in numbers of the run."""
    counts, places, every = (together(records, family) for family in (COUNTS, PLACES, EVERY))
    error = max(at_one([row for row in records.errors if row.case == case]) for case in records.slopes)
    return "## What to count on\n\n" + paragraphs(
        WHICH,
        counts=span([row.rate for row in counts]),
        counts_ratio=span([row.ratio for row in counts]),
        places=span([row.rate for row in places]),
        places_ratio=span([row.ratio for row in places]),
        every=span([row.rate for row in every]),
        every_ratio=span([row.ratio for row in every]),
        percent=f"{100 * error / 1e4**0.5:.2g}",
        slopes=" and ".join(f"{power:.3f}" for power, _ in records.slopes.values()),
    )


def rates(records: UncertaintyRecords) -> str:
    """Rates, and what they are worth."""
    counts, places, every = (together(records, family) for family in (COUNTS, PLACES, EVERY))
    loops = [*singly(records, PLACES), *singly(records, EVERY)]
    wrong = sum(row.differing for row in records.rates)
    checked = sum(row.checked for row in records.rates)
    told = next(row for row in counts if row.error is not None)
    displaced = together(records, DISPLACED)
    # runs kept from before these were measured have none
    more = "\n" + paragraphs(FLANKS, **_of_flanks(records, displaced, places, every)) if displaced else ""
    return (
        "## Rates\n\n"
        + paragraphs(
            RATES,
            counted=number(singly(records, COUNTS)[0].rate),
            counts=met(counts, COUNTS),
            told=f"{told.error:.1e}",
            share=told.note,
            fitting=next(row.note for row in counts if row.checked),
            looped=span([row.rate for row in loops]),
            places=met(places, PLACES),
            places_off=f"{max(row.error or 0 for row in places):.1e}",
            every=met(every, EVERY),
            every_off=f"{max(row.error or 0 for row in every):.1e}",
            wrong="none" if not wrong else str(wrong),
            checked=checked,
        )
        + more
    )


def _of_flanks(
    records: UncertaintyRecords, displaced: list[RateRecord], places: list[RateRecord], every: list[RateRecord]
) -> dict[str, str]:
    """Rates of displaced flanks beside those of triangular teeth of the same counts."""

    def same(rows: list[RateRecord]) -> float:
        return next(row.rate for row in rows if row.case.startswith("64/38"))

    return {
        "flanks": span([row.rate for row in displaced]),
        "flanks_ratio": span([row.ratio for row in displaced]),
        "flanks_off": f"{max(row.error or 0 for row in displaced):.1e}",
        "over_places": span([same(places) / row.rate for row in displaced]),
        "over_every": span([row.rate / same(every) for row in displaced]),
        "looped": span([row.rate for row in singly(records, DISPLACED)]),
    }


def estimates(records: UncertaintyRecords) -> str:
    """How errors fall with trials."""
    first = next(row for row in records.errors if not row.truth_error)
    other = next(row for row in records.errors if row.truth_error)
    covered = [row.covered for row in records.errors if row.estimates >= 20]
    return "## Error of the estimates\n\n" + paragraphs(
        ESTIMATES,
        exact=f"{first.truth:.10f}",
        other=f"{other.truth:.4f} +- {other.truth_error:.4f}",
        slopes="; ".join(f"{case}: {power:.3f} +- {off:.3f}" for case, (power, off) in records.slopes.items()),
        minimum=f"{min(row.rms / row.expected for row in records.errors):.2f}",
        most=f"{max(row.rms / row.expected for row in records.errors):.2f}",
        covered=f"{100 * min(covered):.1f} to {100 * max(covered):.1f}",
    )


def workers(records: UncertaintyRecords) -> str:
    """What more processes bring."""
    one, *more = records.workers
    gains = "; ".join(f"{row.workers} workers are {one.seconds / row.seconds:.2f} times" for row in more)
    same = "The results are the same bit for bit." if all(row.same for row in more) else "THE RESULTS DIFFER."
    return "## Workers\n\n" + paragraphs(
        WORKERS, one=number(one.trials / one.seconds), ratio=number(one.ratio), gains=gains, same=same
    )


def memory(records: UncertaintyRecords) -> str:
    """What a batch takes beside what the program takes anyway."""
    known = [row for row in records.rates if row.megabytes is not None]
    if not known:
        return "## Memory\n\nIt was not measured here.\n"
    most = max(known, key=lambda row: row.megabytes or 0)
    return "## Memory\n\n" + paragraphs(
        MEMORY, most=f"{most.megabytes:.0f}", case=f"{most.case}, {most.method}", trials=f"{most.trials:,}"
    )


# ------------------------------------------------------------------------------------------------------------ picture


def draw(records: UncertaintyRecords) -> None:
    """Rates as bars beside their loops, and errors over trials."""
    with picture("uncertainty-accuracy", 1, 2, figsize=(14.4, 7.0), width_ratios=(3, 2)) as (_, axes):
        bars(axes[0], records)
        falling(axes[1], records)
        for ax in axes:
            ax.grid(color=LINE, lw=0.5, alpha=0.6)
            ax.set_axisbelow(True)
            ax.spines[["top", "right"]].set_visible(False)


def bars(ax: Axes, records: UncertaintyRecords) -> None:
    """Units a second of every way, and what was asked for."""
    rows = list(records.rates)
    goals = dict(zip(GOALS, COLOURS, strict=False))
    for at, row in enumerate(rows):
        alone = row.method == SINGLY
        ax.barh(at, row.rate, color=LINE if alone else goals[row.family], height=0.7)
        text = f"{number(row.rate)}" + ("" if alone else f", {number(row.ratio)} times the loop")
        ax.text(row.rate * 1.15, at, text, va="center", fontsize=9)
        if not alone:
            ax.plot([GOALS[row.family]] * 2, [at - 0.42, at + 0.42], color=INK, lw=1.6)
    names = [f"{row.family}: {row.method}\n{row.case}" for row in rows]
    ax.set_yticks(range(len(rows)), names, fontsize=8.5)
    ax.set(
        xscale="log", ylim=(len(rows) - 0.4, -0.6), xlim=(20, 2e10), xlabel="combinations, or tooth pitches, a second"
    )
    ax.set_title("Rates; a stroke is what was asked for", fontsize=11)


def falling(ax: Axes, records: UncertaintyRecords) -> None:
    """Errors of estimates over trials, and what independent trials would give."""
    for case, colour, marker in zip(records.slopes, COLOURS, MARKERS, strict=False):
        rows = [row for row in records.errors if row.case == case]
        trials = [row.trials for row in rows]
        label = "{}: slope {:.3f} +- {:.3f}".format(case, *records.slopes[case])
        ax.plot(trials, [row.rms for row in rows], color=colour, marker=marker, ms=6, lw=0, label=label)
        ax.plot(trials, [row.expected for row in rows], color=colour, lw=1, ls="--")
    ax.set(xscale="log", yscale="log", xlabel="trials", ylabel="rms error of the probability of a jam")
    ax.set_title("Estimates; dashed: independent trials, slope -1/2", fontsize=11)
    ax.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.13), fontsize=9.5)


HEAD = """# Error against run time: counts in doubt, wheels cut by hand

Written by

    python docs/scripts/make_uncertainty_accuracy.py --measure

on a machine with two cores, busy with other work. So times of one process are those its processor spent, medians of
three rounds; whatever is done many at a time stands beside a plain loop over single solutions in the same rounds, as
the ratio of their times and by the difference of their results. Only workers are timed by the clock.

- **Tooth counts**: freeth-2008, all of its 35 wheels in doubt, five counts each. The loop declares the train with each
  combination, solves it, and compares the outputs with their targets within 0.5 percent. In a batch the formulas of the
  outputs are found once; then whether a combination fits is decided exactly, by floats with a bound and by whole
  numbers where that leaves a doubt, and the speeds of all outputs are told with a bound on their error.
- **Places** and **every error**: pairs of triangular teeth of half angle 30 degrees over their full cycle. Teeth out of
  place by a standard deviation of 4.13 percent of the pitch; or by 2 percent, heights by 4 percent and eccentricity by
  7 percent of the depth, half angles by 3 percent. The loop makes the law of each pair of wheels and lists its events;
  in a batch only the places are looked at where something can go wrong. A tooth pitch is one of the lcm(z1, z2) of a
  cycle.
- **Displaced flanks**: pairs of involute and cycloidal teeth, out of place and eccentric. The loop asks the law of
  every couple at many angles of the cycle; in a batch the terms of the two wheels are apart, and a cycle costs z1 + z2.
"""

WHICH = """
- Sweep counts without fear: {counts} combinations a second, {counts_ratio} times as many as by solving each.

- A pair whose teeth are only out of place is judged at {places} tooth pitches a second ({places_ratio} times the loop),
with heights, flanks and eccentricity off too at {every} ({every_ratio} times).

- 10,000 trials give a probability near 1/5 with an error of {percent} percentage points. For a digit more take a
hundred times as many: errors fall with trials to the power {slopes}.
"""

PLOT = """![Rates of batches and loops; error of estimates over trials](images/uncertainty-accuracy.svg)
"""

RATES = """
**Counts.** One by one {counted} combinations a second; in a batch {counts}. Speeds are off by {told} of their value at
most, {share}. Both ways decide alike: {fitting}.

**Teeth.** One by one {looped} tooth pitches a second. Places: {places}; the least play of a cycle differs from that of
the single law by {places_off} of a pitch at most, because it is read from a table of the even couple wherever it is not
near 0, where it is worked out. Every error: {every}; there the difference is {every_off} of a pitch. Where teeth are
only out of place, a cycle costs z1 + z2 steps and not lcm(z1, z2), so long cycles come quickest by the pitch.

Of {checked} trials and combinations done both ways {wrong} were decided otherwise. The single law has been held against
polygons and against equations in 40 digits elsewhere: see the tests of the package.
"""

FLANKS = """
**Displaced flanks.** Involute and cycloidal teeth, out of place by 1 percent of the pitch and eccentric by 0.02
modules: {flanks} tooth pitches a second, {flanks_ratio} times a loop that asks every couple at 16 angles of each pitch
({looped}). The cost is {over_places} times that of triangular teeth of the same counts that are only out of place, and
{over_every} times less than of those with every error. The least play differs from the loop's by {flanks_off} of a
pitch: the batch looks at eight positions of a pitch, with each tooth where an even one would be.
"""

ESTIMATES = """
Two pairs of 64 and 38 teeth. In the first the driver is even and the driven teeth are uniformly out of place, by so
little that only two neighbours can jam, where one is late against the other by more than the play. No two such steps
can follow each other, so the chance that there is none is a finite sum over matchings of a circle; a jam has the
probability {exact}. In the second all teeth are normally out of place; it is held against the mean of all trials of the
run, {other}, of which the estimates are part.

Every estimate is made of trials of its own among those of its number; other numbers share out the same trials again, so
that their errors are correlated and slopes are less sure than their standard errors say. The measured power of the
number of trials: {slopes}. The errors are
{least} to {most} times those of independent trials. Of the 95 percent intervals {covered} percent hold the truth, where
20 estimates or more were made.
"""

WORKERS = """
One process does {one} trials a second of 64/38 teeth normally out of place, by the clock, drawing included: {ratio}
times the loop. Beside it, {gains} as fast, the start of the processes included. {same} With two cores that others use
too, this says little about a machine of your own.
"""

MEMORY = """
A batch is worked on in pieces that fit a cache, so that memory depends on what is handed in and out: the greatest
growth of the peak is {most} MB, of {case}, for {trials} trials.
"""

ALL = """## All measurements

"""

if __name__ == "__main__":
    from_command_line({"uncertainty": uncertainty}, partial(uncertainty, quick=True), main)
