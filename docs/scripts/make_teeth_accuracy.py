"""Write docs/teeth-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial

from matplotlib.axes import Axes
from studies.page import (
    HUES,
    INK,
    PAPER,
    QUIET,
    from_command_line,
    lowered,
    number,
    paragraphs,
    picture,
    read,
    span,
    write_page,
)
from studies.records import seconds_text
from studies.tooth_number_records import (
    CHAIN,
    CONVERGENTS,
    EVERY,
    FACTORED,
    FORK,
    METHODS,
    PAIRS,
    PRINTED,
    PRODUCTS,
    RATIO,
    TRAIN,
    WALKED,
    TeethGrowth,
    TeethRecord,
    TeethRecords,
)
from studies.tooth_number_study import tooth_numbers

PUBLIC = 44.7  # seconds of the public brute-force tool
HAND = (FACTORED, WALKED, CONVERGENTS)
# a colour of the palette and a marker for each
WAYS = {
    FACTORED: (HUES[6], "v"),
    WALKED: (HUES[3], "^"),
    CONVERGENTS: (HUES[4], "D"),
    PAIRS: (HUES[2], "s"),
    PRODUCTS: (HUES[0], "o"),
    TRAIN: (HUES[1], "P"),
    EVERY: (INK, "x"),
}
SIZES = {2: (HUES[6], "v"), 3: (HUES[3], "s"), 4: (HUES[0], "o"), 5: (HUES[1], "^")}
FREE = {26: (HUES[6], "v"), 46: (HUES[3], "s"), 86: (HUES[0], "o")}
SHOWN = (("tropical month", 2), ("tropical month", 3), ("1009/997", 3))
WIDE = "12:100"


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(TeethRecords, "teeth")
    parts = [
        HEAD,
        which(records),
        PLOT,
        compared(records),
        growing(records),
        memory(records),
        ALL + lowered(records.tables()),
    ]
    write_page("teeth-accuracy", parts)
    draw(records)


def middle(values: Sequence[float]) -> float:
    """The median."""
    return sorted(values)[len(values) // 2]


def took(values: Sequence[float]) -> str:
    """Least to greatest time."""
    minimum, maximum = seconds_text(min(values)), seconds_text(max(values))
    return minimum if minimum == maximum else f"{minimum} to {maximum}"


def question(records: TeethRecords, name: str, stages: int, counts: str = WIDE) -> list[TeethRecord]:
    """The rows of one question."""
    return next(rows for rows in records.questions if rows[0].question == (name, stages, counts, counts))


def last(rows: Sequence[TeethRecord], method: str) -> TeethRecord:
    """A method's row with the most tries."""
    return [row for row in rows if row.method == method][-1]


def factor(rows: Sequence[TeethRecord], method: str) -> float | None:
    """A method's error over the least there is; None where one of them is 0 or missing."""
    miss, best = last(rows, method).miss, last(rows, PRODUCTS).miss
    return float(miss / best) if miss and best else None


def factors(records: TeethRecords, method: str, stages: int) -> list[float]:
    """The same over all questions of so many stages."""
    found = (factor(rows, method) for rows in records.questions if rows[0].stages == stages)
    return [each for each in found if each is not None]


def longer(records: TeethRecords, method: str, stages: int) -> list[float]:
    """Times over those of sorted products, of all questions of so many stages."""
    return [each for rows in records.questions if rows[0].stages == stages for each in longer_in(rows, method)]


def longer_in(rows: Sequence[TeethRecord], method: str) -> list[float]:
    """The same for one question."""
    return [last(rows, method).seconds / last(rows, PRODUCTS).seconds]


def grown(records: TeethRecords, family: str) -> list[TeethGrowth]:
    """The growth of one family, as far as it was measured."""
    return [row for row in records.growth if row.family == family and row.seconds is not None]


def products_of(records: TeethRecords, stages: int, size: int, share: bool = False) -> TeethGrowth:
    """One search by sorted products."""
    rows = [row for row in grown(records, RATIO) if (row.stages, row.counts) == (stages, size)]
    return next(row for row in rows if (row.share < 1) == share)


def time_of(row: TeethGrowth) -> float:
    """Seconds of the whole."""
    assert row.whole is not None
    return row.whole


def which(records: TeethRecords) -> str:
    """Which way to take when, in numbers of the run."""
    three = [rows for rows in records.questions if rows[0].stages == 3]
    hand = [min(found) for rows in three if (found := [f for way in HAND if (f := factor(rows, way))])]
    printed = grown(records, PRINTED)[0]
    return "## Which when\n\n" + paragraphs(
        WHICH,
        two=took([last(rows, PRODUCTS).seconds for rows in records.questions if rows[0].stages == 2]),
        three=took([last(rows, PRODUCTS).seconds for rows in three]),
        four=seconds_text(time_of(products_of(records, 4, 200))),
        hand=span(hand),
        median=number(middle(hand)),
        tries=max(row.tries for row in records.rows if row.method == PAIRS),
        pairs=span(factors(records, PAIRS, 3)),
        longer=number(middle(longer(records, PAIRS, 3))),
        train=span([each for rows in three if last(rows, PRODUCTS).miss for each in longer_in(rows, TRAIN)]),
        exact=number(longer_in(question(records, "Metonic month", 3), TRAIN)[0]),
        solutions=printed.solutions,
        printed=seconds_text(printed.seconds),
        public=PUBLIC,
    )


def compared(records: TeethRecords) -> str:
    """What each way comes to."""
    every = question(records, "tropical month", 3)
    brute = last(every, EVERY)
    ended = [rows for rows in records.questions if last(rows, EVERY).proved]
    agree = sum(last(rows, EVERY).miss == last(rows, PRODUCTS).miss for rows in ended)
    trains = sum(last(rows, TRAIN).miss == last(rows, PRODUCTS).miss for rows in records.questions)
    public = next(rows for rows in records.questions if rows[0].wheels == "30:100")
    return "## Error against time\n\n" + paragraphs(
        COMPARED,
        factored=beside(records, FACTORED),
        walked=beside(records, WALKED),
        convergents=beside(records, CONVERGENTS),
        pairs=beside(records, PAIRS),
        prime=number(factor(question(records, "1009/997", 3), PAIRS) or 1),
        cut=number(factor(question(records, "1009/997", 3), WALKED) or 1),
        ended=len(ended),
        agree=agree,
        questions=len(records.questions),
        trains=trains,
        share=f"{float(Fraction(100 * brute.tries, brute.considered)):.1g}",
        hours=f"{brute.seconds * brute.considered / brute.tries / 3600:.1g}",
        best=f"{float(last(every, PRODUCTS).miss or 0):.2g}",
        own=own_loop(last(public, EVERY)),
        metonic=metonic(records),
    )


def beside(records: TeethRecords, method: str) -> str:
    """A way's errors over the best: median at two and three stages, and where it finds nothing."""
    told = [f"{number(middle(factors(records, method, stages)))} times at {stages} stages" for stages in (2, 3)]
    nothing = sum(last(rows, method).miss is None for rows in records.questions)
    return " and ".join(told) + (f" (nothing at all in {nothing} of {len(records.questions)})" if nothing else "")


def own_loop(row: TeethRecord) -> str:
    """How the loop of the benchmark did on the printed question."""
    if row.proved:
        return f"the loop of this benchmark ends there after {seconds_text(row.seconds)}"
    part = f"{100 * row.tries / row.considered:.0f} percent"
    return f"the loop of this benchmark has done {part} of it after {seconds_text(row.seconds)}"


def metonic(records: TeethRecords) -> str:
    """The ways that make 235/19 exactly with two stages."""
    rows = question(records, "Metonic month", 2)
    exact = [way for way in METHODS if last(rows, way).miss == 0]
    others = [way for way in METHODS if way not in exact]
    return f"{', '.join(exact)}" + (f" (not {', '.join(others)})" if others else "")


def growing(records: TeethRecords) -> str:
    """How complete searches grow."""
    forks = {(row.shared, row.free): row for row in grown(records, FORK)}
    chains = {(row.free, row.counts): row for row in grown(records, CHAIN)}
    whole, part = products_of(records, 4, 200), products_of(records, 4, 200, True)
    five = products_of(records, 5, 200, True)
    return "## Growth\n\n" + paragraphs(
        GROWING,
        powers=", ".join(f"{exponent(records, stages):.1f} at {stages}" for stages in (2, 3, 4)),
        four=seconds_text(time_of(whole)),
        pairs=f"{whole.considered:.0e}",
        guessed=seconds_text(time_of(part)),
        over=f"{time_of(whole) / time_of(part):.1f}",
        part=f"{100 * part.share:.0f}",
        five=seconds_text(time_of(five)),
        ran=seconds_text(five.seconds),
        five_share=f"{100 * five.share:.1g}",
        five_pairs=f"{five.considered:.0e}",
        fifty=seconds_text(time_of(products_of(records, 5, 50))),
        hundred=seconds_text(time_of(products_of(records, 5, 100, True))),
        chain=", ".join(f"{seconds_text(chains[n, 46].seconds)} for {n}" for n in (2, 4, 6, 8, 10)),
        most=f"{chains[10, 46].considered:.0e}",
        solutions=f"{chains[10, 46].solutions:,}",
        forks="; ".join(forked(row) for row in forks.values()),
    )


def forked(row: TeethGrowth) -> str:
    """One train of two outputs."""
    many = f"{row.solutions:,} solution{'s' if row.solutions > 1 else ''}"
    return f"{row.shared} of {row.free} shared, {seconds_text(row.seconds)} ({many})"


def exponent(records: TeethRecords, stages: int) -> float:
    """The power of the number of counts with which time grows, between 100 and 200."""
    from math import log2

    return log2(time_of(products_of(records, stages, 200)) / time_of(products_of(records, stages, 100)))


def memory(records: TeethRecords) -> str:
    """What bounds the memory, and what it came to."""
    most = {stages: products_of(records, stages, 200, stages == 5).megabytes for stages in (2, 3, 4, 5)}
    if any(each is None for each in most.values()):
        return "## Memory\n\n" + paragraphs(BOUNDED, measured="It was not measured here.")
    told = ", ".join(f"{value:.0f} MB at {stages}" for stages, value in most.items())
    trains = max(row.megabytes or 0 for row in (*grown(records, CHAIN), *grown(records, FORK)))
    measured = f"Above what the program takes anyway it grew, with 200 counts, by {told} stages."
    return "## Memory\n\n" + paragraphs(BOUNDED, measured=f"{measured} In trains it grew by {trains:.0f} MB at most.")


# ------------------------------------------------------------------------------------------------------------ picture


def draw(records: TeethRecords) -> None:
    """Errors over time, and growth, all on logarithmic axes but the number of wheels."""
    with picture("teeth-accuracy", 2, 3, figsize=(14.4, 9.2)) as (figure, axes):
        for ax, (name, stages) in zip(axes[0], SHOWN, strict=True):
            errors(ax, records, name, stages)
        times(axes[1, 0], records)
        peaks(axes[1, 1], records)
        trains(axes[1, 2], records)
        handles, names = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, names, frameon=False, loc="outside upper center", ncols=len(names), fontsize=10)


def errors(ax: Axes, records: TeethRecords, name: str, stages: int) -> None:
    """Best error over time, a line for each way."""
    rows = question(records, name, stages)
    for method, (colour, marker) in WAYS.items():
        found = [row for row in rows if row.method == method and row.miss]
        points = [(row.seconds, float(row.miss or 0)) for row in found]
        if points:
            style = "steps-post" if method == EVERY else "default"
            ax.plot(
                *zip(*points, strict=True), color=colour, marker=marker, ms=6, lw=1.4, label=method, drawstyle=style
            )
    best = float(last(rows, PRODUCTS).miss or 0)
    ax.axhline(best, color=QUIET, lw=1, ls="--")
    ax.set(xscale="log", yscale="log", xlabel="seconds", ylabel="best error, part of the ratio")
    ax.set_title(f"{name}, {stages} stages of {WIDE}", fontsize=11)


def times(ax: Axes, records: TeethRecords) -> None:
    """Time of sorted products over the number of counts; hollow where it is extrapolated."""
    for stages, (colour, marker) in SIZES.items():
        rows = by_size(records, stages)
        points = [(row.counts, time_of(row)) for row in rows]
        ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=6, lw=1.4, label=f"{stages} stages")
        for point in (point for row, point in zip(rows, points, strict=True) if row.share < 1):
            ax.plot(*point, color=colour, marker=marker, ms=6, mfc=PAPER)
    ax.set(xscale="log", yscale="log", xlabel="counts of each wheel", ylabel="seconds")
    ax.set_title("The best of all, by sorted products", fontsize=11)
    ax.legend(frameon=False, loc="upper left", fontsize=9)
    ticks(ax)


def by_size(records: TeethRecords, stages: int) -> list[TeethGrowth]:
    """Searches of so many stages by the number of counts: whole ones where there are such, else a share."""
    rows = {row.counts: row for row in grown(records, RATIO) if row.stages == stages and row.share < 1}
    rows |= {row.counts: row for row in grown(records, RATIO) if row.stages == stages and row.share == 1}
    return [rows[size] for size in sorted(rows)]


def peaks(ax: Axes, records: TeethRecords) -> None:
    """Memory of the same."""
    for stages, (colour, marker) in SIZES.items():
        rows = by_size(records, stages)
        points = [(row.counts, max(row.megabytes, 0.5)) for row in rows if row.megabytes is not None]
        if points:
            ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=6, lw=1.4, label=f"{stages} stages")
    ax.set(xscale="log", yscale="log", xlabel="counts of each wheel", ylabel="growth of peak memory, MB")
    ax.set_title("Its memory", fontsize=11)
    ax.legend(frameon=False, loc="upper left", fontsize=9)
    ticks(ax)


def ticks(ax: Axes) -> None:
    """The counts that were measured, written out."""
    ax.set_xticks([25, 50, 100, 200], ["25", "50", "100", "200"])
    ax.minorticks_off()


def trains(ax: Axes, records: TeethRecords) -> None:
    """Time of the search in trains over the number of free wheels."""
    for size, (colour, marker) in FREE.items():
        points = [(row.free, row.seconds) for row in grown(records, CHAIN) if row.counts == size]
        label = f"one output, {size} counts"
        ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=6, lw=1.4, label=label)
    marks = {1: (HUES[2], "D"), 2: (HUES[4], "P")}
    rows = grown(records, FORK)
    for own, (colour, marker) in marks.items():
        found = [row for row in rows if row.free - row.shared == 4 * own]
        label = f"two outputs, {own} own stage{'s' if own > 1 else ''}, {found[0].counts} counts"
        points = [(row.free, row.seconds) for row in found]
        ax.plot(*zip(*points, strict=True), color=colour, marker=marker, ms=6, lw=1.4, ls="--", label=label)
        for row in found:
            place = ((row.free, row.seconds or 0), (5, -12))
            ax.annotate(f"{row.shared} shared", *place, textcoords="offset points", fontsize=8, color=QUIET)
    ax.set(yscale="log", xlabel="free wheels", ylabel="seconds", ylim=(3e-3, 3e2))
    ax.set_title("All solutions in a train, counted", fontsize=11)
    ax.legend(frameon=False, loc="upper left", fontsize=9)


HEAD = """# Best error against time: tooth numbers

Written by

    python docs/scripts/make_teeth_accuracy.py --measure

on a machine with two cores, busy with other work too: times are medians of three rounds in which the ways take turns,
of one round where a task is long; compare them within a table only, as ratios. A round of growth is the best of the
repeats within a fifth of a second, in a process of its own, every time with tables made anew.
Errors are exact fractions, rounded only to be printed. A set of counts is unordered; a candidate is a set on top over a
set beneath.

The ways:

- **convergents, factored**: the continued fraction of the ratio; its convergents, nearest first, until one can be cut
  into so many admissible counts above and beneath, after multiplying both by a whole number up to 1000 times.
  What makers do by hand.
- **Stern-Brocot, factored**: the same with every fraction on the walk to the ratio, as Brocot's tables list them.
- **convergents by stage**: the first stage takes the last convergent of the k-th root of the ratio that its counts can
  make, the next one that of what is left, and the last stage makes up for all others as well as it can.
- **Stern-Brocot by stage**: the same with the nearest of all pairs in each stage. With more tries each stage but the
  last also takes the next nearest, up to 4096 combinations; the best of all is kept.
- **sorted products**: `find_stages`; complete, and shows that nothing is nearer.
- **in a train**: `search` in a declared train of so many stages, all of its wheels free; complete too.
- **every set**: a plain loop over all candidates in the order of the counts, given up after some seconds.
"""

WHICH = """
- One ratio: take sorted products. They give the best of all, and show it, in {two} for two stages and {three} for
three; the best of four stages of 200 counts takes {four}.

- By hand, with three stages, the best of factored fractions and convergents by stage is {hand} times as far off as it
need be (median {median}): now and then it is the best there is, and nothing tells so. Where the ratio itself can be cut
into counts, factoring finds that too, and no search is needed.

- Trying more pairs stage by stage does not pay: with {tries} tries at three stages the error is {pairs} times the
least, after {longer} times the time of sorted products (median).

- In a train: `search` takes {train} times as long as sorted products for the same question with three stages, and
{exact} times for 235/19, which very many assignments make exactly. Take it where several outputs, shared wheels or
fitter's rules are asked for: it alone can answer them together.

- Brute force is for two stages. For 13.368267 with three stages, wheels 30:100 over pinions 15:40, all within 1e-6, a
public brute-force tool (jes/clock-gear-train-calculator, under Node on another machine) took {public} s; the same
{solutions} solutions take {printed} here.
"""

PLOT = """![Best error over time for three questions; growth of time and memory](images/teeth-accuracy.svg)

Above: each mark is a run; lines join runs of one way with more tries, steps are the loop over every set as it gets
better; the dashed line is the least error there is. Below, hollow marks are extrapolated.
"""

COMPARED = """
Errors over the least there is, as medians over the questions: convergents, factored, {factored}; Stern-Brocot,
factored, {walked}; convergents by stage, {convergents}; Stern-Brocot by stage with all its tries, {pairs}.

The complete ways agree: in all {ended} questions where the loop over every set ended or came to an error of 0, its
error equals that of sorted products as a fraction ({agree} of {ended}), and so does that of the search in a train in
{trains} of {questions}.

The tropical month with three stages of 12:100 has a least error of {best}. The loop looked at {share} percent of all
candidates before it was given up; the whole would take about {hours} h. On the question of the public tool, {own}.

1009/997 is a quotient of primes that no wheel has, and close to 1. Few fractions on the way to it can be cut, and an
equal share for each stage is a pair like 1/1. With three stages the error by stage, with all tries, is {prime} times
the least, that of the nearest fraction that can be cut {cut} times.

235/19 with two stages can be made exactly. These ways do so: {metonic}.
"""

GROWING = """
The best by sorted products, with n counts for every wheel: from 100 to 200 counts time grows with n to the power
{powers} stages. The number of candidates grows with n to the power 2 k for k stages, that of products with n^k; where
only milliseconds are taken, most of them are the same for all.

Four stages of 200 counts, {pairs} candidates, took {four}. A few pieces evenly spread over all, {part} percent of
them, forecast {guessed} for one sweep; the whole search took {over} times that. Besides sweeping it tries pieces
first, to know how good the best will be, and may have to widen its tolerance and sweep again. Five stages of 200
({five_pairs} candidates) were measured in such pieces only: {five_share} percent of the work took {ran}, so a sweep
is extrapolated to {five} in one process, and one of 100 counts to {hundred}; a whole search will take longer by some
such factor. 50 counts, measured whole, took {fifty}. The pieces are independent: with an executor they run on as many
cores or machines as there are.

In a train, all solutions within 1e-3 counted, and the best one brought out: with 46 counts for each wheel one output
takes {chain} free wheels. With ten that is {most} assignments, of which {solutions} are solutions; they are counted
by products, not listed.

Two outputs, each with stages of its own, and none, one or two stages shared by both, 31 counts for each wheel: {forks}.
Outputs that share nothing are two searches, whose counts are multiplied. A shared wheel couples them: its values are
walked through, and the rest of each output is looked up for every one.
"""

BOUNDED = """
Products are not held as a list. The counts are cut at the middle count of each set: low parts and high parts are
tabulated, some n^3 numbers at most, and products are made window by window from these. A window holds 2 million
products on each side, or three for each row of the tables where those are longer. So memory depends on the tables and
the window, not on the number of products: four stages of 200 counts have 69 million of them on each side, five have
2800 million. {measured} More than some 400 counts at four stages and more are refused, with the reason.
"""

ALL = """## All measurements

"""

if __name__ == "__main__":
    from_command_line({"teeth": tooth_numbers}, partial(tooth_numbers, quick=True), main)
