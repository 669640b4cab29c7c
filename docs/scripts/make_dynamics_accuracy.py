"""Write docs/dynamics-accuracy.md and its picture from a kept run of its study."""

from __future__ import annotations

from functools import partial
from math import log

from studies.dynamics_study import RESTITUTIONS, DynamicsRecords, PairRecord, TrainRecord, dynamics
from studies.page import HUES, QUIET, from_command_line, lowered, paragraphs, picture, read, span, write_page

# a colour of the palette and a marker for each
WAYS = {"rigid steps": (HUES[0], "o"), "teeth that yield": (HUES[1], "^")}


def main() -> None:
    """Read the run, write page and picture."""
    (records,) = read(DynamicsRecords, "dynamics")
    parts = [HEAD, which(records), PLOT, orders(records), converged(records)]
    write_page("dynamics-accuracy", [*parts, "## All measurements\n", lowered(records.tables())])
    draw(records)


def of(records: DynamicsRecords, restitution: float, method: str) -> list[PairRecord]:
    """The rows of one way."""
    return [row for row in records.pair if (row.restitution, row.method) == (restitution, method)]


def order(rows: list[PairRecord]) -> float:
    """By what power of the step the energy of blows comes right, from the second row to the last."""
    first, last = rows[1], rows[-1]
    return log(first.impacts / last.impacts) / log(last.steps / first.steps)


def which(records: DynamicsRecords) -> str:
    """Which way to take when."""
    rates = [row.steps * 2 / row.seconds for row in records.pair if row.steps > 30_000]
    return "## Which when\n\n" + paragraphs(
        WHICH,
        events=span([1e3 * of(records, each, "events")[0].seconds for each in RESTITUTIONS]),
        rate=span([rate / 1e6 for rate in rates]),
    )


def orders(records: DynamicsRecords) -> str:
    """How errors fall with the step."""
    found = [order(of(records, each, "rigid steps")) for each in RESTITUTIONS]
    last = [of(records, each, "rigid steps")[-1] for each in RESTITUTIONS]
    stiff = [of(records, each, "teeth that yield")[-1] for each in RESTITUTIONS]
    return "## How errors fall\n\n" + paragraphs(
        ORDERS,
        order=span(found, ".2f"),
        steps=f"{last[0].steps:,}",
        apart=span([abs(row.apart) for row in last], ".0e"),
        impacts=span([abs(row.impacts) for row in last], ".0e"),
        stiff_impacts=span([abs(row.impacts) for row in stiff], ".0e"),
        stiff_apart=span([abs(row.apart) for row in stiff], ".0e"),
    )


def converged(records: DynamicsRecords) -> str:
    """Which figures of a train settle."""

    def pair(restitution: float) -> tuple[TrainRecord, TrainRecord]:
        rows = [row for row in records.train if row.restitution == restitution and not row.stiffness]
        return rows[-2], rows[-1]

    def off(restitution: float, what: str) -> float:
        one, other = pair(restitution)
        return abs(getattr(one, what) - getattr(other, what))

    return "## What settles, and what is chaotic\n\n" + paragraphs(
        CONVERGED,
        steps=f"{pair(0.0)[0].steps:,}",
        calm_apart=100 * off(0.0, "apart"),
        calm=off(0.0, "stands"),
        apart=100 * off(0.3, "apart"),
        torque=100 * off(0.3, "torque") / pair(0.3)[0].torque,
        stands=off(0.3, "stands"),
        ahead=off(0.3, "ahead"),
    )


def draw(records: DynamicsRecords) -> None:
    """Error of the energy of blows, and of the share of time apart, over seconds."""
    with picture("dynamics-accuracy", 2, 2, figsize=(9.4, 7.4), sharex=True) as (figure, axes):
        for row, (what, label) in zip(
            axes, {"impacts": "energy of blows", "apart": "share of time apart"}.items(), strict=True
        ):
            for ax, restitution in zip(row, RESTITUTIONS, strict=True):
                for method, (colour, marker) in WAYS.items():
                    rows = of(records, restitution, method)
                    points = [(each.seconds, max(abs(getattr(each, what)), 1e-7)) for each in rows]
                    ax.plot(*zip(*points, strict=True), color=colour, marker=marker, lw=1.4, label=method)
                seconds = of(records, restitution, "events")[0].seconds
                ax.axvline(seconds, color=QUIET, ls="--", lw=1, label="events (the truth)")
                ax.set(xscale="log", yscale="log", title=f"{label}, restitution {restitution:g}")
        figure.supxlabel("seconds for two turns")
        figure.supylabel("error")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)


HEAD = """# Error against run time: motion in time

Written by

    python docs/scripts/make_dynamics_accuracy.py --measure

on a machine with two cores, busy with other work too: times are of single runs, compiled, and kept from an earlier
run with the same settings. Three ways for one pair, a
pin at 10 in a slot whose axis is 2 off and which is 0.4 wider, an inertia of 1e-5 kg m2 behind it under a friction of
1 N mm. It is driven at 32 rad/s; from 20.4 rad/s on teeth part. Two turns, without restitution and with one of 0.5.

- **events**: from event to event, the truth here. Flights by scipy's `solve_ivp` (DOP853) up to where a flank is met,
  a blow, contact up to where the flank would pull. Bounces that leave a ten-millionth of the driver's speed end in
  contact.
- **rigid steps**: `train.dynamics()`, 500 to 128 000 steps a turn.
- **teeth that yield**: `train.dynamics(model="compliant")`, a stiffness of 100 to 100 000 N m/rad, the damping at
  which as much comes back as the restitution says, 80 steps in the period of its swing.

And the Moon's train (`moon-triangular-inertia`) at one turn a second, where only steps can be taken: hundreds of blows
a turn, some at once.
"""

WHICH = """
- Take rigid steps for whole trains: they ask for no stiffness, and their cost does not depend on how often teeth
strike. They go {rate} million steps a second.

- Take teeth that yield where forces are asked for: peaks of torque, dynamic factors, resonance. Their cost grows with
the root of the stiffness, and what they say of time apart is that of rigid teeth only in the limit.

- Follow events for one pair, or as a check: {events} ms here. In a train events come too often, and with a
restitution each landing has endlessly many.
"""

PLOT = """![Error over seconds](images/dynamics-accuracy.svg)

Lower and further left is better. To the left rigid steps are few, and teeth that yield soft.
"""

ORDERS = """
With rigid steps the energy of blows comes right with the step to the power {order}; at {steps} steps a turn it is off
by {blows}, the share of time apart by {apart}. Steps that are longer than flights lose these, so that with a
restitution few steps say too much or too little of time apart.

With the stiffest teeth the energy of blows is off by {stiff_blows} and the share by {stiff_apart}: they spring back a
little even where rigid ones do not, since a spring and damper that never pull throw back a twentieth at least here.
The greatest gap of a flight is off as one over the stiffness, which the tests hold.
"""

CONVERGED = """
Two runs of the Moon's train with {steps} steps a turn and one more tell what depends on the step. Without restitution
shares of time apart differ by {calm_apart:.2g} percentage points, and where the Moon stands after 4.9 turns by
{calm:.2g} degrees: blows without bounce forget how they came about, so that the whole motion is robust.

With a restitution of 0.3 shares differ by {apart:.2g} percentage points and the torque at the crank by {torque:.2g}
%: means are robust. Where the Moon stands differs by {stands:.2g} degrees, and the most that it is ahead by
{ahead:.2g}: a single trajectory is chaotic, and so is every greatest value.

Teeth of 20 and 200 N m/rad say other things of this train. Its first modes, 27 and 86 Hz, then lie among the
frequencies at which teeth pass, 13 to 86 Hz, and it swings; and blows that come together run through a chain of
springs as they do not through one of rigid wheels, so that no restitution makes the two alike. Bronze teeth some
millimetres wide are of the order of thousands of N m/rad.
"""

if __name__ == "__main__":
    from_command_line({"dynamics": dynamics}, partial(dynamics, quick=True), main)
