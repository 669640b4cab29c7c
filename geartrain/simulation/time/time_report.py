"""Motion in time: figures for JSON, and the page that is told from them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import degrees, tau
from typing import TYPE_CHECKING

from geartrain.numerics.exact import percent_text, watts_text
from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, cut, figure, filled_table
from geartrain.report.torque_report import energy_table, turns_text

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.simulation.contacts.link_inertia import LinkInertia
    from geartrain.simulation.contacts.separation_rate import SeparationRates
    from geartrain.simulation.time.stepped_separation import SteppedSeparation
    from geartrain.simulation.time.time_run import ContactInTime, ConvergedFigure, TimeRun


_SURE = 1e-9  # an account that closes to less says nothing more
_STILL = 1e-9  # rad: rounding of angles
_CLOSE = 0.01  # error of steps that is asked for


@dataclass(frozen=True)
class TimeReport(Result):
    """A train in time, with the rates at which its teeth were to part.

    See Also
    --------
    collect_time_report : Gives it.
    """

    PAGE = "simulation.time.time_report:describe_time_run"

    KEYS = ("title", "separation", "stepped", "inertias", Key("", "run"))

    title: str
    """One line for a reader."""
    separation: SeparationRates | None
    """At what rate teeth first part, by pair, from the condition for it; None where no torques or inertia are known."""
    inertias: tuple[LinkInertia, ...]
    """What moves is as heavy as this."""
    run: TimeRun
    """The run."""
    stepped: SteppedSeparation | None = None
    """The same by stepping, where it was asked for."""


def collect_time_report(
    train: GearTrain, run: TimeRun, without: tuple[str, ...] = (), stepped: SteppedSeparation | None = None
) -> TimeReport:
    """A run with the rates at which teeth first part.

    Parameters
    ----------
    train : GearTrain
        The train.
    run : TimeRun
        What its `dynamics` gave.
    without : tuple of str
        Pairs that were left out.
    stepped : SteppedSeparation, optional
        What `step_to_separation` gave.

    Returns
    -------
    TimeReport
        Its `to_dict` is the answer of `geartrain dynamics --json`.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("moon-triangular-inertia")
    >>> found = collect_time_report(train, train.dynamics("1 turn/s", turns=0.01, skip=0, steps=2000))
    >>> found.separation.pair, found.to_dict()["driving_link"]
    ('d2~e', 'crank')
    """
    from geartrain.simulation.contacts.link_inertia import find_link_inertias
    from geartrain.simulation.contacts.separation_rate import find_separation, has_separation

    own, state = train.mechanics, run.state
    separation = find_separation(own, state, without) if has_separation(own, state) else None
    inertias = find_link_inertias(own, state, with_inputs=run.driven != "rate")
    return TimeReport(train.declaration.title, separation, inertias, run, stepped)


def describe_time_run(found: TimeReport) -> Document:
    """Up to which rate all teeth touch, then what a train did in time: contacts, drive, outputs, energy, spectra.

    Parameters
    ----------
    found : TimeReport
        From `collect_time_report`.

    Returns
    -------
    Document
        Angles in degrees, torques in N mm; what differs between steps of length h and h/2 is marked.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("moon-triangular-inertia")
    >>> run = train.dynamics("1 turn/s", turns=0.01, skip=0, steps=2000)
    >>> [section.title for section in describe_time_run(collect_time_report(train, run)).sections[:3]]
    ['Up to which rate it holds', 'Contacts', 'Drive and outputs']
    """
    return Document(f"Motion in time of {found.run.train}", list(_summary(found.run)), list(_sections(found)))


def time_document(run: TimeRun) -> Document | None:
    """Return what `geartrain dynamics` prints for a run; None where the train is not known."""
    from geartrain.analysis.gear_train import GearTrain

    if run._declaration is None:
        return None
    return describe_time_run(collect_time_report(GearTrain(run._declaration), run, run._without))


def _sections(found: TimeReport) -> Iterator[Section]:
    run = found.run
    if found.separation is not None:
        from geartrain.simulation.contacts.separation_rate import separation_section

        section = separation_section(found.separation)
        yield replace(section, paragraphs=(*section.paragraphs, *_unlike(run)))
    if found.stepped is not None:
        yield Section("The same by stepping", (_stepped(found.stepped),))
    if run.contacts:
        yield _contacts(run)
    yield _outputs(run)
    yield _energy(run)
    for name, peaks in run.spectra.items():
        if peaks and peaks[0].amplitude > _STILL:
            rows = [
                (figure(peak.order, 6), figure(peak.frequency, 6), figure(degrees(peak.amplitude), 4), peak.source)
                for peak in peaks
            ]
            header = (f"per turn of {run.driving_link}", "Hz", "amplitude (deg)", "pair and harmonic")
            apart = figure(2 * tau / (abs(run.rate) * run.duration), 2)
            text = (
                "The strongest lines of its angle about its mean motion, under a Hann window, which tells orders apart "
                f"that differ by {apart} or more."
            )
            yield Section(f"Spectrum of {name}", (text,), (Table(header, rows),))
    if any(_compared(each) for each in run.figures):
        yield _converged(run)
    if found.inertias:
        yield _inertia(found.inertias)


def _unlike(run: TimeRun) -> Iterator[str]:
    """Why teeth of this run may part at lesser rates than those at which they first part."""
    if run.driven != "rate":
        yield "These rates are of an input that turns evenly; this one need not."
    if run.model == "compliant":
        yield "These rates are of rigid teeth: such as yield swing where their speed ratio jumps, and may part before."
    elif run.restitution:
        yield "These rates are without restitution: with one, teeth bounce wherever their speed ratio jumps."


def _summary(run: TimeRun) -> Iterator[str]:
    ways = {
        "rate": f"the speed of '{run.link}' is kept",
        "torque": f"a steady torque, such as a weight's, drives '{run.link}'",
        "spring": f"a spring drives '{run.link}'",
        "hand": f"a hand that yields drives '{run.link}'",
    }
    state = "" if run.state is None else f", in state {run.state}"
    turns = round(abs(run.rate) * run.duration / tau, 6)
    if run.driven == "torque" and not turns:
        yield f"'{run.driving_link}' STANDS STILL: what drives '{run.link}' does not overcome what resists it."
    yield (
        f"While '{run.driving_link}' makes {turns_text(turns)} at {figure(abs(run.rate) / tau, 6)} "
        f"turn/s{state}, after "
        f"{figure(run.skip, 4)} s that are not counted; {ways[run.driven]}. Steps of {figure(run.step, 4)} s."
        + (f" Restitution {figure(run.restitution, 4)}." if run.restitution else "")
    )
    if not run.complete:
        yield "PARTIAL: stopped; the figures are of what was done, and were not compared with those of shorter steps."
    if run.unsolved:
        yield (
            f"NOT SOLVED in {run.unsolved} steps: no contacts agree with their forces there, as where friction locks "
            "the train (`geartrain torques --turns` says where). A guess was taken: do not rely on these figures."
        )
    yield from (f"Left out: {note}." for note in run.notes)
    yield from (f"Assumed: {each}." for each in run.assumed)


def _stepped(found: SteppedSeparation) -> str:
    text = "" if found.complete else "PARTIAL: stopped. "
    text += f"Stepped without restitution over {turns_text(found.turns)} of '{found.input}'"
    if found.rate is not None and found.error is not None and found.at is not None:
        text += f", flanks of {found.pair} part from {figure(found.rate, 6)} ± {figure(found.error, 2)} turn/s on"
        text += f", after {figure(found.at, 6)} turns"
    elif found.holds is not None:
        text += f", all flanks touch at {figure(found.holds, 5)} turn/s"
    else:
        text += ", nothing is known yet"
    return (
        f"{text}; by the condition they part from {figure(found.predicted, 6)} turn/s on in these turns. "
        f"Flights of less than {figure(found.flight, 3)} turns may be overlooked."
    )


def _contacts(run: TimeRun) -> Section:
    rows = [_contact(run, each) for each in run.contacts]
    header = (
        *("contact", "apart (%)", "coast (%)", "impacts a turn", "each (µJ)", "all (mW)"),
        *("hardest (rad/s)", "gap (deg)", "torque (N mm)", "friction (mW)", "peak (N mm)", "dynamic factor"),
    )
    text = [
        f"Shares of time apart and on the coast flank; impacts in a turn of '{run.driving_link}', the "
        f"energy of each and the "
        "power of all, the closing speed of the hardest; the greatest angle between the driven side and its nearer "
        "flank; the mean torque on the driven side.",
        "Teeth are rigid here: an impact is an impulse, whose force has no peak, and so there is no dynamic factor."
        if run.model == "rigid"
        else "Teeth yield: peaks are the greatest torques on the driven side, and the dynamic factor is such a peak "
        "over that of a train in balance at every moment.",
    ]
    return Section("Contacts", text, (filled_table(header, cut(rows), 3),))


def _contact(run: TimeRun, each: ContactInTime) -> tuple[str, ...]:
    turn = tau / abs(run.rate) if run.rate else 0.0
    return (
        each.name,
        figure(100 * each.apart, 4),
        figure(100 * each.coast, 4),
        figure(each.impact_rate * turn, 4),
        figure(1e6 * each.power / each.impact_rate, 4) if each.impact_rate else "",
        figure(1e3 * each.power, 4) if each.impact_rate else "",
        figure(each.hardest, 4) if each.impact_rate else "",
        figure(degrees(each.gap), 4) if each.gap > _STILL else "",
        figure(1e3 * each.torque, 5),
        figure(1e3 * each.rubbed, 4) if each.rubbed else "",
        figure(1e3 * each.peak, 5) if each.peak is not None else "",
        figure(each.dynamic_factor, 4) if each.dynamic_factor is not None else "",
    )


def _outputs(run: TimeRun) -> Section:
    power = (run.energy.drive if run.driven == "rate" else run.energy.put_in) / run.duration
    word = "given back" if power < 0 else "put in"
    text = [
        f"Torque at '{run.link}': {figure(1e3 * run.torque, 5)} N mm in the mean; {word}: {watts_text(abs(power))}.",
        "Outputs against the motion in which all drive flanks touch, which is that of `geartrain motion`.",
    ]
    off = [each for each in run.deviations if max(each.ahead, each.behind) > _STILL]
    if not off:
        text.append("None is ahead or behind.")
    rows = [
        (summary.output, *(_angle(each) for each in (summary.ahead, summary.behind, summary.rms))) for summary in off
    ]
    header = ("output", "ahead, at most (deg)", "behind, at most (deg)", "rms (deg)")
    return Section("Drive and outputs", text, (Table(header, cut(rows)),) if rows else ())


def _angle(angle: float) -> str:
    return figure(degrees(angle), 4) if angle > _STILL else "0"


def _energy(run: TimeRun) -> Section:
    energy = run.energy
    whole = sum(max(each, 0.0) for each in (energy.drive, energy.loads, energy.springs))
    amounts = {
        "put in by the drive": energy.drive,
        "put in by loads and steady drives": energy.loads,
        "put in by springs": energy.springs,
        "lost in bearings": energy.bearings,
        "lost to viscous drag": energy.drag,
        "lost by friction of teeth and pins": energy.friction,
        "lost in impacts" if run.model == "rigid" else "lost in teeth that yield": energy.impact_loss,
        "taken by the length of steps": energy.steps,
        "more kinetic energy than at first": energy.kinetic,
        "more in teeth that yield": energy.elastic,
    }
    table = energy_table("J", amounts, whole, 6)
    closure = max(energy.closure, 1e-15)
    if not table.rows:
        return Section(
            "Energy", ("None is put in, lost or kept: nothing loads the train, and nothing heavy gets faster.",)
        )
    claim = (
        f"the account claims {_SURE:.0e}" if closure <= _SURE else f"which is less well than the {_SURE:.0e} claimed"
    )
    text = f"What is put in, lost and kept agrees to {closure:.0e} of it; {claim}."
    return Section("Energy", (text,), (table,))


def _converged(run: TimeRun) -> Section:
    means = [each for each in run.figures if each.kind == "mean"]
    text = ["Each figure by steps of length h, and of h/2, which is used elsewhere."]
    if any(each.interval is not None for each in means):
        text.append(
            "The mean of a longer run lies within ± of that of h/2 with a confidence of 95 %, by blocks of whole turns."
        )
    else:
        text.append("How far means of a longer run differ is not known: that takes 5 turns or more.")
    text += _unsettled(run)
    if any(each.apart for each in run.contacts):
        text.append(
            "Robust are means over many turns: shares of time apart, torque, power. Chaotic are single flights and "
            "blows, and so extremes, angles at one moment, and which teeth part when: another start gives others."
        )
    rows = [_compared(each) for each in (*means, *(each for each in run.figures if each.kind == "extreme"))]
    header = ("figure", "unit", "h", "h/2", "±", "kind", "converged")
    return Section("What settled", text, (filled_table(header, cut([row for row in rows if row is not None]), 2),))


def _unsettled(run: TimeRun) -> Iterator[str]:
    """Figures that depend on the length of steps or of the run, by how much, and what to ask for instead."""
    loose = [each for each in run.figures if not each.converged]
    if not loose:
        yield "All agree."
        return
    yield f"NOT SETTLED: {', '.join(each.name for each in loose)}."
    sizes = {each.name: abs(each.fine - each.coarse) / abs(each.fine) for each in loose if each.unit and each.fine}
    name = max(sizes, key=lambda each: sizes[each], default=None)
    if name is not None and sizes[name] > _CLOSE:
        steps = tau / abs(run.rate) / run.step / 2 * sizes[name] / _CLOSE
        yield (
            f"The error of their steps is estimated by h against h/2, at most {percent_text(sizes[name])} ({name}): "
            f"`--steps {float(f'{steps:.2g}'):.0f}` brings it to {percent_text(_CLOSE)}, unless the motion is chaotic, "
            "where extremes need not settle."
        )
    if any((each.interval or 0.0) > abs(each.fine - each.coarse) for each in loose):
        yield "Where ± is the greater, ask for more `--turns`: four times as many halve it."


def _compared(each: ConvergedFigure) -> tuple[str, ...] | None:
    scale, unit, minimum = {
        "rad": (degrees(1), "deg", _STILL),
        "N m": (1e3, "N mm", 0.0),
        "W": (1e3, "mW", 0.0),
        "": (100.0, "%", 0.0),
        "rad/s": (1.0, "rad/s", 0.0),
    }[each.unit]
    if max(abs(each.coarse), abs(each.fine)) <= minimum:
        return None
    values = (figure(scale * value, 5) for value in (each.coarse, each.fine))
    interval = "" if each.interval is None else figure(scale * each.interval, 2)
    return (each.name, unit, *values, interval, each.kind, "yes" if each.converged else "no")


def _inertia(found: Sequence[LinkInertia]) -> Section:
    rows = [
        (
            each.link,
            figure(each.value, 5) if each.value else "-",
            each.source,
            figure(each.carried, 5) if each.carried else "",
            "; ".join(each.missing),
        )
        for each in found
    ]
    header = ("link", "kg m2", "from", "of it by planets", "not known")
    return Section("Inertia", (), (filled_table(header, cut(rows), 3),))
