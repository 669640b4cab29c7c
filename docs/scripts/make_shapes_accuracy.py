"""Write docs/shapes-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import log10
from textwrap import fill

from matplotlib.axes import Axes
from studies.page import HUES, INK, QUIET, from_command_line, lowered, paragraphs, picture, read, span, write_page
from studies.shape_study import ShapeRecords, WorkRecord, quickest, shapes

PROBLEMS = [f"{kind} {form}" for kind in ("stress", "heat", "friction") for form in ("spur", "bevel")]
# a colour of the palette and a marker for each
WAYS = {
    "package": (INK, "*"),
    "collocation": (HUES[0], "o"),
    "DOP853": (HUES[3], "s"),
    "RK45": (HUES[6], "v"),
    "Radau": (HUES[1], "^"),
    "BDF": (HUES[4], "D"),
    "direct search": (HUES[2], "X"),
}
TIMED = [way for way in WAYS if way != "direct search"]
MINIMUM = 1e-16


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(ShapeRecords, "shapes")
    parts = [HEAD, which(records), PLOT, winners(records), starts(records), extremes(records), inwards(records)]
    write_page("shapes-accuracy", [*parts, "## All measurements\n", lowered(records.tables()), ""])
    draw(records)


def of(records: ShapeRecords, problem: str, method: str) -> list[WorkRecord]:
    """The rows of one way to one problem."""
    return [row for row in records.work if (row.problem, row.method) == (problem, method)]


def time_at(records: ShapeRecords, problem: str, method: str, accuracy: float) -> float | None:
    """Least seconds of a way to an accuracy; None if it does not come so far."""
    best = quickest(of(records, problem, method), accuracy)
    return best and best.seconds


def ratios(records: ShapeRecords, method: str, accuracy: float, problems: Sequence[str]) -> list[float]:
    """Time of a way over that of the package's own, where it comes so far."""
    own = {problem: of(records, problem, "package")[0].seconds for problem in problems}
    found = {problem: time_at(records, problem, method, accuracy) for problem in problems}
    return [seconds / own[problem] for problem, seconds in found.items() if seconds is not None]


def which(records: ShapeRecords) -> str:
    """Which way to take when."""
    smooth = PROBLEMS[:4]
    return "## Which when\n\n" + paragraphs(
        WHICH,
        worst=max(row.error for row in records.work if row.method == "package"),
        time=span([1e3 * of(records, problem, "package")[0].seconds for problem in PROBLEMS]),
        dop=span(ratios(records, "DOP853", 1e-12, smooth)),
        radau=span(ratios(records, "Radau", 1e-12, smooth)),
        search=span([row.error for row in records.work if row.method == "direct search"], ".0e"),
        seconds=span([row.seconds for row in records.work if row.method == "direct search"]),
    )


def winners(records: ShapeRecords) -> str:
    """The quickest way to each accuracy, and how many times as long the others take."""
    lines = ["## Time to an accuracy", "", fill(TIMES, 120), ""]
    for accuracy in (1e-6, 1e-9, 1e-12):
        lines += [f"To {accuracy:.0e}, in milliseconds:", "", f"| problem | {' | '.join(TIMED)} |"]
        lines += ["|---" * (len(TIMED) + 1) + "|"]
        for problem in PROBLEMS:
            times = [time_at(records, problem, way, accuracy) for way in TIMED]
            cells = ["" if seconds is None else f"{1e3 * seconds:.3g}" for seconds in times]
            lines.append(f"| {problem} | {' | '.join(cells)} |")
        lines.append("")
    return "\n".join([*lines, growths(records)])


def growths(records: ShapeRecords) -> str:
    """What ten times the accuracy costs: factor of time a digit, between 1e-6 and 1e-12."""
    body = []
    for way in ("collocation", "DOP853", "RK45", "Radau", "BDF"):
        factors = []
        for problem in PROBLEMS[:4]:
            coarse, fine = time_at(records, problem, way, 1e-6), time_at(records, problem, way, 1e-12)
            if coarse and fine:
                factors.append((fine / coarse) ** (1 / 6))
        if factors:
            body.append(f"{way} {span(factors)}")
    digits = []
    for problem in PROBLEMS[:4]:
        rows = [row for row in of(records, problem, "collocation") if row.error > 3e-15]
        digits.append(log10(rows[0].error / rows[-1].error) / (rows[-1].setting - rows[0].setting))
    return paragraphs(GROWTH, factors=", ".join(body), digits=span(digits))


def starts(records: ShapeRecords) -> str:
    """The series start at several distances."""
    lines = ["## Starting beside the pitch point", "", fill(START, 120), ""]
    problems = PROBLEMS[:4]
    lines += [f"| distance | {' | '.join(problems)} |", "|---" * 5 + "|"]
    for row in of(records, problems[0], "start"):
        errors = [next(r.error for r in of(records, p, "start") if r.setting == row.setting) for p in problems]
        lines.append(f"| {row.setting:.1e} | {' | '.join(f'{error:.1e}' for error in errors)} |")
    return "\n".join([*lines, ""])


def extremes(records: ShapeRecords) -> str:
    """Extreme pairs."""
    own = [row for row in records.extremes if row.method == "package"]
    ways = {method: [row.error for row in records.extremes if row.method == method] for method in methods(records)}
    slow = max(own, key=lambda row: row.seconds)
    return "## Extreme pairs\n\n" + paragraphs(
        EXTREMES,
        pairs=len(own),
        own=max(row.error for row in own),
        nodes=span([row.nodes for row in own], "d"),
        slow=slow.case,
        seconds=1e3 * slow.seconds,
        far=max(ways["DOP853 from 1e-02"]),
        near=max(ways["DOP853 from 1e-04"]),
    )


def methods(records: ShapeRecords) -> list[str]:
    """Ways to the extreme pairs."""
    return list(dict.fromkeys(row.method for row in records.extremes))


def inwards(records: ShapeRecords) -> str:
    """Marching inwards."""
    lines = ["## Inwards", "", fill(INWARDS, 120), ""]
    problems = PROBLEMS[:4]
    lines += [f"| distance | {' | '.join(problems)} |", "|---" * 5 + "|"]
    rows = {(row.problem, row.distance): row for row in records.inward}
    for distance in dict.fromkeys(row.distance for row in records.inward):
        errors = [rows[problem, distance].error for problem in problems]
        cells = ["lost" if error == float("inf") else f"{error:.1e}" for error in errors]
        lines.append(f"| {distance:g} | {' | '.join(cells)} |")
    measured = []
    for problem in problems:
        near, far = rows[problem, 0.003], rows[problem, 0.03]
        if near.error < 1:
            measured.append(f"{log10(near.error / far.error) / log10(0.1):.3f} ({near.exponent:.3f}) for {problem}")
    return "\n".join(
        [*lines, "", fill(f"Exponents between 0.03 and 0.003, theory's in brackets: {', '.join(measured)}.", 120), ""]
    )


# ------------------------------------------------------------------------------------------------------------ picture


def draw(records: ShapeRecords) -> None:
    """Error over time for each problem, logarithmic."""
    with picture("shapes-accuracy", 3, 2, figsize=(10.4, 12), sharex=True, sharey=True) as (_, axes):
        for ax, problem in zip(axes.flat, PROBLEMS, strict=True):
            work(ax, records, problem)
        axes[0, 0].legend(frameon=False, fontsize=9, loc="upper right")
        axes[2, 0].legend(frameon=False, fontsize=9, loc="upper right")


def work(ax: Axes, records: ShapeRecords, problem: str) -> None:
    """One problem."""
    for way, (colour, marker) in WAYS.items():
        rows = [row for row in of(records, problem, way) if row.error < 1]
        if rows:
            times, errors = [1e3 * row.seconds for row in rows], [max(row.error, MINIMUM) for row in rows]
            size = 12 if way == "package" else 5
            ax.plot(times, errors, color=colour, marker=marker, ms=size, lw=1.3, label=way, zorder=3 if size > 5 else 2)
    ax.axhline(2.2e-16, color=QUIET, lw=1, ls="--")
    ax.set(xscale="log", yscale="log", xlabel="milliseconds", ylabel="relative error of the last contact")
    ax.set_title(problem.replace("heat", "temperature"), fontsize=11)


HEAD = """# Error against run time: tooth shapes

Written by

    python docs/scripts/make_shapes_accuracy.py --measure

on a machine with two cores, busy with other work too: times are the least of five rounds, and still uneven; compare
them within a table only, as ratios. The error is that of the distance of the last contact after half a pitch, 24 and 36
teeth, relative to a solution in 40 digits. Theory: [Tooth shapes](shapes.md).

- **stress**, **heat**: uniform stress from 20 degrees, uniform temperature at Q* = 0.4, each by marching over X (pairs
  of Runge and Kutta, **RK45** and **DOP853**; implicit **Radau** and **BDF**) from a series of the second order at a
  thousandth of the arc, and by **collocation** with a number of nodes;
- **friction**: at most 25 degrees and at least 0.15 along the dedendum. Marching is given the length of the ray, which
  the others must find; **direct search** knows no theory, and looks for the best pressure angle in each of many cells;
- **package**: as `uniform_stress`, `uniform_heat` and `least_friction` do it, with the number of nodes it needs, or in
  closed form.
"""

WHICH = """
- Take what the package does: {worst:.0e} off at most, in {time} ms, with nothing to choose. Collocation needs no
special care at the pitch point, where marching must start on a series. What it gives is the whole path, from which
every contact follows; marching gives the last contact only.

- For the last contact alone an explicit pair of high order, marched outwards, costs no more: to 1e-12 DOP853 takes
{dop} times as long as the package, Radau {radau} times. The equations are singular at the pitch point, but not stiff
outwards: implicit ways gain nothing. For errors of 1e-6 RK45 is the quickest.

- Least friction has a closed form. A direct search by sequential quadratic programs is {search} off, takes {seconds}
seconds, and comes no nearer with more cells.

- Never march inwards.
"""

PLOT = """![Error of the last contact over run time, six problems](images/shapes-accuracy.svg)

A star is the package. Errors below 1e-16 are drawn there; the dashed line is the spacing of floats.
"""

TIMES = """The least time of each way to an error of at most so much; empty for collocation in the problems of friction,
which have a closed form. A direct search comes to none of these."""

GROWTH = """
What another digit costs, as a factor of time between 1e-6 and 1e-12, for stress and heat: {factors}. Collocation gains
{digits} digits with each node.
"""

START = """DOP853 at a tolerance of 1e-13, begun at so many arcs from the pitch point on a series whose first neglected
term is of the third order in sin psi (stress) or g (heat). Errors fall with a power of the distance until rounding is
reached; since the bounded solution draws its neighbours in, even a poor start is forgiven outwards."""

EXTREMES = """
Of {pairs} pairs (pressure angles of 0.1 to 44.9 degrees, 5 to 100,000 teeth, 200 to 1, a crown gear, cones of 88
degrees) the package is {own:.0e} off at most, with {nodes} nodes; the longest, {slow}, takes {seconds:.3g} ms. DOP853
begun at a hundredth of the arc is up to {far:.0e} off, begun at a ten-thousandth {near:.0e}: how near it must begin
depends on the pair, and a small pressure angle wants it nearer.
"""

INWARDS = """Marching from the last contact towards the pitch point at the sharpest tolerance, begun with a pressure
angle that is 1e-6 rad off. The error grows as theory says; outwards it falls by the same law, which is why marching
outwards forgives its start. Distances are parts of the last."""

if __name__ == "__main__":
    from_command_line({"shapes": shapes}, partial(shapes, quick=True), main)
