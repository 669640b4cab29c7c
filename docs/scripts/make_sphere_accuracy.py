"""Write docs/sphere-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from matplotlib.axes import Axes
from studies.loop_closures import FRACTIONS as EXACT
from studies.loop_closures import FROM_AXES, ROUNDED
from studies.page import (
    HUES,
    INK,
    PAPER,
    QUIET,
    from_command_line,
    lowered,
    paragraphs,
    picture,
    read,
    span,
    write_page,
)
from studies.sphere_records import (
    TARGET,
    TOLERANCE,
    ClosureRecord,
    FitRecord,
    PackRecord,
    SphereRecords,
    growth,
)
from studies.sphere_study import sphere

# a colour of the palette and a marker for each
FAMILIES = {"hull": (HUES[0], "o"), "zonohedron": (HUES[3], "s"), "trapezohedron": (HUES[1], "^")}
PRISM, PLANETS = "6-antiprism", "planetary"
LOOPS = {
    (PRISM, FROM_AXES): (HUES[1], "^", "sphere, angles from the axes"),
    (PLANETS, "floats"): (HUES[0], "o", "planetary"),
    (PRISM, ROUNDED): (HUES[3], "s", "sphere, fractions as floats"),
}


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(SphereRecords, "sphere")
    parts = [
        HEAD,
        which(records),
        PLOT,
        circles(records),
        moves(records),
        loops(records),
        ALL + lowered(records.tables()),
    ]
    write_page("sphere-accuracy", parts)
    draw(records)


def count(many: int, verb: str) -> str:
    """How many do what: none overlaps."""
    return f"{many or 'none'} {verb}"


def ends(values: Sequence[float]) -> tuple[float, float]:
    """Least and greatest."""
    return min(values), max(values)


def of(rows: Sequence[PackRecord], family: str) -> list[PackRecord]:
    """The graphs of one family, by size."""
    return sorted((row for row in rows if row.family == family), key=lambda row: row.gears)


def fits_of(records: SphereRecords, aim: str, minimum: int, family: str = "") -> list[FitRecord]:
    """The fits for one aim, all families or one, by size."""
    found = [row for row in records.fits if row.aim == aim and row.minimum == minimum and family in ("", row.family)]
    return sorted(found, key=lambda row: row.gears)


def largest(records: SphereRecords) -> list[PackRecord]:
    """The largest graph of each family."""
    return [of(records.packings, family)[-1] for family in FAMILIES]


def closures_of(records: SphereRecords, method: str, family: str = "") -> list[ClosureRecord]:
    """Loops by one method, of all families or one, by teeth."""
    found = [row for row in records.closures if row.method == method and family in ("", row.family)]
    return sorted(found, key=lambda row: row.power)


def first_wrong(rows: Sequence[ClosureRecord], what: str = "wrong") -> str:
    """The least power of ten of teeth at which a verdict is wrong."""
    powers = [row.power for row in rows if getattr(row, what)]
    return f"10^{min(powers)}" if powers else "no number measured"


def exponents(rows: dict[str, list[tuple[int, float]]]) -> str:
    """Exponents of growth with the gears, least to greatest over the families."""
    return span([growth(*zip(*points, strict=True)) for points in rows.values()], ".1f")


def by_family(records: SphereRecords, what: str) -> dict[str, list[tuple[int, float]]]:
    """Gears and a time of the packing, for each family."""
    return {family: [(row.gears, getattr(row, what)) for row in of(records.packings, family)] for family in FAMILIES}


def fit_growth(records: SphereRecords, aim: str, minimum: int) -> str:
    """The exponents of the time from the graph to the sizes."""
    return exponents({f: [(row.gears, row.whole) for row in fits_of(records, aim, minimum, f)] for f in FAMILIES})


def which(records: SphereRecords) -> str:
    """Which way to take when, in numbers of the run."""
    big = largest(records)
    small = [row for row in records.packings if row.gears < 20]
    return "## Which when\n\n" + paragraphs(
        WHICH,
        large=span([row.ratio for row in big]),
        more=", or more where it was given up" if any(row.left >= TARGET for row in big) else "",
        small=span([row.ratio for row in small]),
        families=len(big),
        coarse=exact_of(records, 12),
        fine=exact_of(records, 50),
        axes=first_wrong(closures_of(records, FROM_AXES)),
        prism=first_wrong(closures_of(records, ROUNDED, PRISM)),
        planets=first_wrong(closures_of(records, "floats", PLANETS)),
    )


def exact_of(records: SphereRecords, minimum: int) -> int:
    """How many of the largest graphs were brought to one pitch."""
    return sum(row.exact and row.gears > 900 for row in fits_of(records, "pitch", minimum))


def circles(records: SphereRecords) -> str:
    """Newton against the fixed point, and the packing they lead to."""
    big = largest(records)
    stopped = [row for row in big if row.left >= TARGET]
    steep = {family: max(max(row.squares, default=0) for row in of(records.packings, family)) for family in FAMILIES}
    steps = max(len(row.counted) for row in records.packings)
    return "## Circles\n\n" + paragraphs(
        CIRCLES,
        sizes=span([row.gears for row in records.packings]),
        few=min(len(row.counted) for row in records.packings),
        most=steps,
        hull=f"{steep['hull']:.1f}",
        zono=f"{steep['zonohedron']:.1f}",
        trap=f"{steep['trapezohedron']:.0f}",
        sweeps=span([row.sweeps for row in big if row.left < TARGET]),
        ratios=span([row.ratio for row in big if row.left < TARGET]),
        stopped=stopping(stopped),
        newton=exponents(by_family(records, "newton")),
        fixed=exponents(by_family(records, "swept")),
        whole=exponents(by_family(records, "seconds")),
        share=span([100 * row.newton / row.seconds for row in big], ".1f"),
        judged=max(row.judged for row in records.packings),
        stated=max(row.residual for row in records.packings),
        overlaps=count(sum(row.overlaps for row in records.packings), "overlaps"),
    )


def stopping(rows: Sequence[PackRecord]) -> str:
    """What is to say of fixed points that were given up."""
    if not rows:
        return ""
    told = (
        f"on the {row.family} of {row.gears} gears it was given up after {row.sweeps:,} sweeps and {row.ratio:,.0f} "
        f"times Newton's time, {row.left:.0e} rad off"
        for row in rows
    )
    return "; " + "; ".join(told)


def moves(records: SphereRecords) -> str:
    """Axes moved to one pitch, or to closed loops."""
    good = [row for row in records.fits if row.exact]
    return "## Axes moved\n\n" + paragraphs(
        MOVES,
        exact=len(good),
        all=len(records.fits),
        pitch=max(row.residual for row in good if row.aim == "pitch"),
        pitch_steps=span([row.steps for row in good if row.aim == "pitch"]),
        phases=max(row.residual for row in good if row.aim == "phases"),
        phase_steps=span([row.steps for row in good if row.aim == "phases"]),
        coarse=span([row.moved for row in fits_of(records, "pitch", 12) if row.exact], ".1g"),
        fine=span([row.moved for row in fits_of(records, "pitch", 50) if row.exact], ".1g"),
        loops=span([row.moved for row in fits_of(records, "phases", 12) if row.exact], ".1g"),
        failed=f"{failures(records)} {strayed(records)}",
        pitch_growth=fit_growth(records, "pitch", 50),
        phase_growth=fit_growth(records, "phases", 12),
        sizing=span([100 * row.sizing / row.whole for row in records.fits if row.gears > 900], ".1f"),
    )


def failures(records: SphereRecords) -> str:
    """The fits that did not become exact."""
    bad = [row for row in records.fits if not row.exact]
    if not bad:
        return "Every fit is exact."
    told = [
        f"{row.family} of {row.gears}, {row.aim} from {row.minimum} teeth ({row.steps} steps, {row.residual:.1e} left)"
        for row in bad
    ]
    return "Not exact: " + "; ".join(told) + "."


def strayed(records: SphereRecords) -> str:
    """The fits that left a solution they had all but reached."""
    return " ".join(
        f"On the {row.family} of {row.gears} the steps for {row.aim} all but reached a solution, left it again and "
        f"ended at one {row.moved:.0f} degrees away."
        for row in records.fits
        if row.strayed
    )


def loops(records: SphereRecords) -> str:
    """Closure by fractions against floats."""
    exact = closures_of(records, EXACT)
    axes, rounded = closures_of(records, FROM_AXES), closures_of(records, ROUNDED, PRISM)
    planets = closures_of(records, "floats", PLANETS)
    sphere = [row for row in exact if row.family != PLANETS]
    beside = {(row.family, row.power): row.seconds for row in closures_of(records, ROUNDED)}
    ratios = sorted(row.seconds / beside[row.family, row.power] for row in sphere)
    near = {row.power: row.seconds for row in planets}
    slow = sorted(row.seconds / near[row.power] for row in exact if row.family == PLANETS)
    at = {row.power: row for row in rounded}
    return "## Closure\n\n" + paragraphs(
        CLOSURE,
        loops=f"{sum(row.loops for row in exact):,}",
        wrong=count(sum(row.wrong for row in exact), "is wrong"),
        minimum=at[1].error,
        most=at[12].error,
        axes_off=next(row.error for row in axes if row.power == 12 and row.family == PRISM),
        axes=first_wrong(axes),
        axes_best=first_wrong(axes, "best"),
        prism=first_wrong(rounded),
        prism_best=first_wrong(rounded, "best"),
        coprime=first_wrong([row for row in closures_of(records, ROUNDED) if row.family != PRISM]),
        planets=first_wrong(planets),
        planets_best=first_wrong(planets, "best"),
        unclear=first_wrong(planets, "unclear"),
        own=count(sum(row.own for row in planets), "is wrong"),
        ratio=ratios[len(ratios) // 2],
        planet_ratio=slow[len(slow) // 2],
        nano=sorted(1e9 * row.seconds for row in sphere)[len(sphere) // 2],
        micro=sorted(1e6 * row.seconds for row in exact if row.family == PLANETS)[len(near) // 2],
    )


# ------------------------------------------------------------------------------------------------------------ picture


def draw(records: SphereRecords) -> None:
    """Residuals, times and float errors, all on logarithmic axes."""
    with picture("sphere-accuracy", 2, 2, figsize=(10.4, 9.2)) as (_, axes):
        convergence(axes[0, 0], records)
        radii(axes[0, 1], records)
        wholes(axes[1, 0], records)
        closure(axes[1, 1], records)
        for ax in axes.flat:
            ax.set(xscale="log", yscale="log")


def convergence(ax: Axes, records: SphereRecords) -> None:
    """Residual over steps of Newton and sweeps of the fixed point."""
    for row in largest(records):
        colour, marker = FAMILIES[row.family]
        left = [residual for _, residual in row.steps]
        ax.plot(range(1, len(left) + 1), left, color=colour, marker=marker, ms=5, lw=1.4, label=row.family)
        ax.plot(*zip(*row.trace, strict=True), color=colour, ls=":", lw=1.8)
    ax.axhline(TARGET, color=QUIET, lw=1, ls="--")
    ax.text(3e4, TARGET / 2, "timed to here", color=QUIET, fontsize=9, ha="right", va="top")
    ax.text(16, 3e-9, "Newton", color=QUIET)
    ax.text(5000, 3e-9, "fixed point", color=QUIET)
    ax.set(xlabel="Newton steps or sweeps", ylabel="largest residual of an angle, rad")
    ax.set_title("Radii of about 1000 gears", fontsize=11)
    ax.legend(frameon=False, loc="upper right", fontsize=9)


def radii(ax: Axes, records: SphereRecords) -> None:
    """Time of both over the gears."""
    for family, (colour, marker) in FAMILIES.items():
        rows = of(records.packings, family)
        gears = [row.gears for row in rows]
        ax.plot(gears, [row.newton for row in rows], color=colour, marker=marker, ms=6, lw=1.4)
        ax.plot(gears, [row.swept for row in rows], color=colour, ls=":", lw=1.8)
        for row in rows:
            done = row.left < TARGET
            ax.plot(row.gears, row.swept, color=colour, marker=marker, ms=6, mfc=colour if done else PAPER)
            if not done:
                ax.annotate("given up", (row.gears, row.swept), (-8, 4), textcoords="offset points", ha="right")
    ax.text(250, 2.6e-3, "Newton", color=QUIET)
    ax.text(110, 3.5, "fixed point", color=QUIET, ha="right")
    ax.set(xlabel="gears", ylabel="seconds")
    ax.set_title("Time for radii right to 1e-11 rad", fontsize=11)


def wholes(ax: Axes, records: SphereRecords) -> None:
    """Time of whole tasks over the gears, for hulls."""
    rows = of(records.packings, "hull")
    lines = {
        "from the graph to closed loops": (HUES[2], "D", fits_of(records, "phases", 12, "hull"), "whole"),
        "from the graph to one pitch": (HUES[4], "s", fits_of(records, "pitch", 50, "hull"), "whole"),
        "packing alone": (INK, "X", rows, "seconds"),
        "Newton for the radii alone": (HUES[0], "o", rows, "newton"),
        "sizes alone": (HUES[6], "v", fits_of(records, "pitch", 50, "hull"), "sizing"),
    }
    for name, (colour, marker, found, what) in lines.items():
        times = [getattr(row, what) for row in found]
        ax.plot([row.gears for row in found], times, color=colour, marker=marker, ms=6, lw=1.4, label=name)
    low, high = (rows[-3].gears, rows[-1].gears)
    base = lines["sizes alone"][2][-1].sizing / 5
    ax.plot((low, high), (base * low / high, base), color=QUIET, lw=1, ls="--")
    ax.text(high, base / 1.5, "slope 1", color=QUIET, fontsize=9, va="top", ha="right")
    ax.set(ylim=(1e-4, 1e3), xlabel="gears", ylabel="seconds")
    ax.set_title("Time of the whole, hulls", fontsize=11)
    ax.legend(frameon=False, loc="upper left", fontsize=9)


def closure(ax: Axes, records: SphereRecords) -> None:
    """Errors of float loop sums over teeth; crosses where verdicts are wrong."""
    for (family, method), (colour, marker, name) in LOOPS.items():
        rows = closures_of(records, method, family)
        teeth, errors = [10.0**row.power for row in rows], [row.error for row in rows]
        ax.plot(teeth, errors, color=colour, marker=marker, ms=5, lw=1.4, label=name)
        wrong = [(10.0**row.power, row.error) for row in rows if row.wrong]
        label = "wrong verdicts" if (family, method) == (PLANETS, "floats") else None
        ax.plot(*zip(*wrong, strict=True), color=INK, marker="x", ms=9, lw=0, label=label)
        if method == "floats":
            bounds = [row.bound or 0 for row in rows]
            ax.plot(teeth, bounds, color=colour, ls="--", lw=1.2, label="planetary, its own forecast")
    ax.axhline(TOLERANCE, color=QUIET, lw=1, ls="--")
    ax.text(1e15, TOLERANCE / 1.5, "tolerance", color=QUIET, fontsize=9, va="top", ha="right")
    ax.axhline(0.5, color=QUIET, lw=1)
    ax.text(10, 0.7, "half a pitch: nothing is known", color=QUIET, fontsize=9, va="bottom")
    ax.set(ylim=(3e-15, 1e2), xlabel="teeth, at least", ylabel="greatest error of a residue, pitches")
    ax.set_title("Loop sums in floats; fractions have no error", fontsize=11)
    ax.legend(frameon=False, loc="lower right", fontsize=9)


HEAD = """# Residual against steps and time: gears on a sphere

Written by

    python docs/scripts/make_sphere_accuracy.py --measure

on a machine with two cores, busy with other work too: times are medians of three rounds or more; compare them within
a table only, as ratios. Where mpmath is not installed, the machine's longest floats are used.

The graphs, from about 10 to about 1000 gears each:

- **hull**: gears on all vertices and faces of the hull of random points on the sphere. No symmetry.
- **zonohedron**: gears on the vertices of a zonohedron with random directions; all regions are rhombic.
- **trapezohedron**: two poles that mesh with half of all other gears each. Symmetric, sizes as unlike as can be.

Radii are found by **Newton**'s method on the convex function of Bobenko and Springborn, as in `from_graph`. The
alternative is the **fixed point** of Thurston, as Collins and Stephenson iterate it: each radius is corrected as if all
neighbours were alike, gears and regions in turn, all of one sort at once. It needs no linear system and ten lines.
"""

WHICH = """
- Take Newton's method for circles, as `from_graph` does: at about 1000 gears the fixed point takes {large} times as
long to the same residual{more}. With fewer than 20 gears it takes {small} times as long: there the choice does not
matter.

- Ask for one pitch with more teeth where a graph is large: the axes must make up for the rounding of teeth. Of
{families} graphs of about 1000 gears {coarse} is fitted exactly from 12 teeth, {fine} from 50.

- Leave closure to fractions, which cost hardly more and are never wrong. Floats at a fixed tolerance are wrong from
{planets} teeth in planetaries, from {prism} on a sphere with the right fractions in floats, and from {axes} where the
angles come from axes. For gears that can be cut any of these is good enough; a residue with its own forecast is better
than a tolerance, since it says where it knows nothing.
"""

PLOT = """![Residuals, times and errors of loop sums on logarithmic axes](images/sphere-accuracy.svg)

Above: lines are Newton's method, dots the fixed point; a hollow mark is a fixed point that was given up after a minute.
"""

CIRCLES = """
Newton's method needs {few} to {most} steps to a residual of 1e-11 rad, for {sizes} gears. The convergence is
quadratic: once the residual is below 0.1 rad, the next is at most C times its square, with C = {hull} on hulls, {zono}
on zonohedra and {trap} on trapezohedra (1/rad). Trapezohedra begin farther off, since a step changes no radius by more
than a factor of e^2, and a pole is hundreds of times as large as its neighbours.

The fixed point takes {sweeps} sweeps at about 1000 gears, {ratios} times as long{stopped}. It converges linearly, and
slower the more gears there are.

Time grows with the power {newton} of the gears (100 and more) for Newton's steps, with {fixed} for the fixed point,
and with {whole} for the whole packing: radii, places, centre and polish. Newton's steps are {share} percent of it at
about 1000 gears.

After the polish the packing states a residual of {stated:.1e} rad at most. From its axes and half-angles, taken as
they are, tangencies and right angles in 40 digits are off by {judged:.1e} rad at most. Of all pairs of gears, each
measured in space, {overlaps}.
"""

MOVES = """
Teeth are rounded to the circles, then axes moved: {exact} of {all} fits are exact. One pitch takes {pitch_steps} steps
and leaves pitches that differ by {pitch:.1e} at most (in their logarithm); axes move by {coarse} degrees where the
smallest gear has 12 teeth, by {fine} where it has 50. Closed loops take {phase_steps} steps and leave {phases:.1e}
pitches at most; axes move by {loops} degrees.

{failed}

From the graph to the sizes, time grows with the power {pitch_growth} of the gears (100 and more) for one pitch from 50
teeth, and {phase_growth} for closed loops. Sizes themselves, with all collisions looked for, take {sizing} percent of
that at about 1000 gears.
"""

CLOSURE = """
Loops of gears on all faces of three solids, and planetaries with seven equal planets; half of the tooth numbers close
the loop, half miss. The truth comes from whole numbers without bound. On a sphere a loop counts as closed when it
misses by less than 1e-9 pitches, the tolerance of `suggest`.

Of {loops} loops judged by fractions {wrong}. The error of float sums grows in proportion to the teeth. With the right
fractions rounded to floats it is {least:.0e} pitches at 10 teeth and {most:.0e} at 10^12. With angles from the axes,
kept to 13 decimals of a turn, it is {axes_off:.1g} pitches at 10^12, so that nothing is known.

Where verdicts are first wrong: with angles from the axes at {axes} teeth; with fractions in floats at {prism} on the
6-antiprism, but only at {coprime} on the other two solids, whose fractions have no common divisor below, so that a
loop closes only where each product is a whole number by itself and rounds to it; in planetaries at {planets}. At the
best tolerance there is, half the least residue that a loop can have, these become {axes_best}, {prism_best} and
{planets_best}; but who knows that residue knows the fractions.

The float residues of planetaries come with a forecast of their error. Judged by that they say unclear from {unclear}
teeth on, and of their verdicts {own}.

A loop on a sphere costs {nano:.0f} ns by fractions (whole numbers over a common denominator, many tooth numbers at
once), {ratio:.1f} times as long as in floats. A loop of a planetary costs {micro:.0f} microseconds by fractions,
{planet_ratio:.1f} times as long as in floats.
"""

ALL = """## All measurements

"""

if __name__ == "__main__":
    from_command_line({"sphere": sphere}, partial(sphere, quick=True), main)
