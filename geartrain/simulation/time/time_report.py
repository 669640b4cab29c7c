"""Report of a time-domain simulation, as a document and as data for JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import degrees, tau
from typing import TYPE_CHECKING

from geartrain.numerics.exact import percent_text, watts_text
from geartrain.numerics.quantity import TRAVEL_ARM
from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, cut, figure, filled_table
from geartrain.report.torque_report import energy_table, turns_text

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.simulation.contacts.link_inertia import LinkInertia
    from geartrain.simulation.contacts.separation_rate import SeparationRates
    from geartrain.simulation.time.time_run import ConvergedFigure, TimeRun


_SURE = 1e-9  # tolerance of the relative error of the energy balance; a smaller error is rounding
_STILL = 1e-9  # rad: rounding of angles
_CLOSE = 0.01  # target of the relative discretisation error


@dataclass(frozen=True)
class TimeReport(Result):
    """Results of a time-domain simulation, and the predicted input speeds at which teeth separate."""

    PAGE = "simulation.time.time_report:describe_time_run"

    KEYS = ("title", "separation", "inertias", Key("", "run"))

    title: str
    """Title of the train, on one line."""
    separation: SeparationRates | None
    """Input speeds at which teeth first separate, computed from the closed-form condition; None if no inertia is
    declared or the torques have no unit.
    """
    inertias: tuple[LinkInertia, ...]
    """Moments of inertia of the moving links."""
    run: TimeRun
    """Results of the time-domain simulation."""


def collect_time_report(train: GearTrain, run: TimeRun, without: tuple[str, ...] = ()) -> TimeReport:
    """Return the report on a time-domain simulation, with the input speeds at which teeth first separate."""
    from geartrain.simulation.contacts.link_inertia import find_link_inertias
    from geartrain.simulation.contacts.separation_rate import find_separation, has_separation

    own, state = train.mechanics, run.state
    separation = find_separation(own, state, without) if has_separation(own, state) else None
    inertias = find_link_inertias(own, state, with_inputs=run.driven != "rate")
    return TimeReport(train.declaration.title, separation, inertias, run)


def describe_time_run(found: TimeReport) -> Document:
    """Return a document on a time-domain simulation: separation of teeth, contacts, drive, outputs, energy, spectra and
    convergence.
    """
    return Document(f"Motion in time of {found.run.train}", list(_summary(found.run)), list(_sections(found)))


def time_document(run: TimeRun) -> Document | None:
    """Return the report on a run that `geartrain dynamics` prints, or None if the run has no declaration of a train."""
    from geartrain.analysis.gear_train import GearTrain

    if run._declaration is None:
        return None
    return describe_time_run(collect_time_report(GearTrain(run._declaration), run, run._without))


def _sections(found: TimeReport) -> Iterator[Section]:
    run = found.run
    if found.separation is not None:
        from geartrain.simulation.contacts.separation_rate import separation_section

        section, notes = separation_section(found.separation), []
        if run.driven != "rate":
            notes.append("Separation rates assume an input of constant speed; the speed of this input may vary.")
        if run.model == "compliant":
            notes.append(
                "Separation rates assume rigid teeth; compliant teeth vibrate at ratio jumps and may separate earlier."
            )
        elif run.restitution:
            notes.append(
                "Separation rates assume no restitution; with restitution, teeth bounce wherever their speed ratio "
                "jumps."
            )
        yield replace(section, paragraphs=(*section.paragraphs, *notes))
    if run.contacts:
        yield _contacts(run)
    yield _outputs(run)
    yield _energy(run)
    for name, peaks in run.spectra.items():
        if peaks and peaks[0].amplitude > _STILL:
            rows = [
                (figure(peak.order, 6), figure(peak.frequency, 6), _angle(run, name, peak.amplitude), peak.source)
                for peak in peaks
            ]
            header = (f"per turn of {run.driving_link}", "Hz", "amplitude (deg)", "pair and harmonic")
            # a Hann window resolves two bins
            apart = figure(2 * tau / (abs(run.rate) * run.duration), 2)
            text = (
                "The strongest lines of its angle about the mean motion, under a Hann window, which resolves orders "
                f"that differ by {apart} or more."
            )
            yield Section(f"Spectrum of {name}", (text,), (Table(header, rows),))
    if any(_compared(each) for each in run.figures):
        yield _converged(run)
    if found.inertias:
        yield _inertia(found.inertias)


def _summary(run: TimeRun) -> Iterator[str]:
    ways = {
        "rate": f"the speed of '{run.link}' is prescribed",
        "torque": f"a constant torque, for example of a weight, drives '{run.link}'",
        "spring": f"a spring drives '{run.link}'",
        "hand": f"a compliant hand drives '{run.link}'",
    }
    state = "" if run.state is None else f", in state {run.state}"
    # rounding of the duration must not show
    turns = round(abs(run.rate) * run.duration / tau, 6)
    if run.driven == "torque" and not turns:
        yield f"'{run.driving_link}' DOES NOT MOVE: the drive at '{run.link}' does not overcome the resistance."
    yield (
        f"'{run.driving_link}' makes {turns_text(turns)} at {figure(abs(run.rate) / tau, 6)} "
        f"turn/s{state}, after "
        f"{figure(run.skip, 4)} s that are not evaluated; {ways[run.driven]}. Time step {figure(run.step, 4)} s."
        + (f" Restitution {figure(run.restitution, 4)}." if run.restitution else "")
    )
    if not run.complete:
        yield "PARTIAL: the run was stopped; the figures are not compared with those of a shorter time step."
    if run.unsolved:
        yield (
            f"NOT SOLVED in {run.unsolved} steps: no consistent contacts were found, for example if friction locks "
            "the train (`geartrain torques --turns` shows where). Do not rely on these figures."
        )
    yield from (f"Not included: {note}." for note in run.notes)
    yield from (f"Assumed: {each}." for each in run.assumed)


def _contacts(run: TimeRun) -> Section:
    turn = tau / abs(run.rate) if run.rate else 0.0
    rows = [
        (
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
        for each in run.contacts
    ]
    header = (
        *("contact", "apart (%)", "coast (%)", "impacts per turn", "each (µJ)", "all (mW)"),
        *("hardest (rad/s)", "gap (deg)", "torque (N mm)", "friction (mW)", "peak (N mm)", "dynamic factor"),
    )
    text = [
        "Percentage of time without contact (apart) and on the coast flank; impacts per turn of "
        f"'{run.driving_link}', "
        "their mean energy and total "
        "power, and the maximum closing speed (hardest); the maximum angle between the driven side and its nearer "
        "flank (gap); the mean torque on the driven side.",
        "Teeth are rigid: an impact is an impulse without a peak force, so the dynamic factor is undefined."
        if run.model == "rigid"
        else "Teeth are compliant: the peak is the maximum torque on the driven side; the dynamic factor is its ratio "
        "to the maximum quasi-static torque.",
    ]
    return Section("Contacts", text, (filled_table(header, cut(rows), 3),))


def _outputs(run: TimeRun) -> Section:
    # only a prescribed speed has its power in `drive`
    power = (run.energy.drive if run.driven == "rate" else run.energy.put_in) / run.duration
    word = "power returned" if power < 0 else "input power"
    torque = f"torque at '{run.link}': {figure(1e3 * run.torque, 5)} N mm"
    if _slides(run, run.link):
        torque = f"force at '{run.link}': {figure(run.torque / float(TRAVEL_ARM), 5)} N"
    text = [
        f"Mean {torque}; {word}: {watts_text(abs(power))}.",
        "Deviations of outputs from the motion in which all drive flanks touch (`geartrain motion`).",
    ]
    off = [each for each in run.deviations if max(each.ahead, each.behind) > _STILL]
    if not off:
        text.append("No output deviates.")
    rows = [
        (summary.output, *(_angle(run, summary.output, each) for each in (summary.ahead, summary.behind, summary.rms)))
        for summary in off
    ]
    header = ("output", "maximum ahead (deg)", "maximum behind (deg)", "rms (deg)")
    return Section("Drive and outputs", text, (Table(header, cut(rows)),) if rows else ())


def _slides(run: TimeRun, name: str) -> bool:
    """Return True if the output or link with the given name slides, False if it turns."""
    declared = run._declaration
    if declared is None or not declared.sliding:
        return False
    output = declared.case(run.state).outputs.get(name)
    return (name if output is None or output.of is None else output.of) in declared.sliding


def _angle(run: TimeRun, name: str, angle: float) -> str:
    """Return a deviation as text: degrees for an output that turns, or mm with the unit for an output that slides."""
    if angle <= _STILL:
        return "0"
    return f"{figure(angle / tau, 4)} mm" if _slides(run, name) else figure(degrees(angle), 4)


def _energy(run: TimeRun) -> Section:
    energy = run.energy
    # percentages refer to the total input
    whole = sum(max(each, 0.0) for each in (energy.drive, energy.loads, energy.springs))
    amounts = {
        "input by the drive": energy.drive,
        "input by loads and constant torques": energy.loads,
        "input by springs": energy.springs,
        "lost in bearings": energy.bearings,
        "lost to viscous drag": energy.drag,
        "lost in pairs and couplings": energy.friction,
        "lost in impacts" if run.model == "rigid" else "lost by damping of teeth": energy.impact_loss,
        "numerical dissipation": energy.steps,
        "increase of kinetic energy": energy.kinetic,
        "increase of elastic energy of teeth": energy.elastic,
    }
    table = energy_table("J", amounts, whole, 6)
    # rounding errors have this order; a value of 0 would suggest exact arithmetic
    closure = max(energy.closure, 1e-15)
    if not table.rows:
        return Section(
            "Energy", ("No energy is supplied, lost or stored: the train has no load, and no inertia is accelerated.",)
        )
    claim = f"the tolerance is {_SURE:.0e}" if closure <= _SURE else f"this exceeds the tolerance of {_SURE:.0e}"
    text = f"The energy balance closes to a relative error of {closure:.0e}; {claim}."
    return Section("Energy", (text,), (table,))


def _converged(run: TimeRun) -> Section:
    means = [each for each in run.figures if each.kind == "mean"]
    text = ["Figures with time steps h and h/2; the values at h/2 are used elsewhere."]
    if any(each.interval is not None for each in means):
        text.append("± is half the 95 % confidence interval of a mean at h/2, from batch means over whole turns.")
    else:
        text.append("Confidence intervals of means require 5 turns or more.")
    text += _unconverged_notes(run)
    if any(each.apart for each in run.contacts):
        text.append(
            "Means over many turns (percentages of time, torque, power) are robust. Single flights and impacts are "
            "chaotic, and so are extremes and angles at one moment: another start gives other values."
        )
    rows = [_compared(each) for each in (*means, *(each for each in run.figures if each.kind == "extreme"))]
    header = ("figure", "unit", "h", "h/2", "±", "kind", "converged")
    return Section("Convergence", text, (filled_table(header, cut([row for row in rows if row is not None]), 2),))


def _unconverged_notes(run: TimeRun) -> Iterator[str]:
    """Yield sentences on results that differ between both time steps, and options that help."""
    loose = [each for each in run.figures if not each.converged]
    if not loose:
        yield "All figures converged."
        return
    yield f"NOT CONVERGED: {', '.join(each.name for each in loose)}."
    sizes = {each.name: abs(each.fine - each.coarse) / abs(each.fine) for each in loose if each.unit and each.fine}
    name = max(sizes, key=lambda each: sizes[each], default=None)
    if name is not None and sizes[name] > _CLOSE:
        # the error is of the first order in the time step
        steps = tau / abs(run.rate) / run.step / 2 * sizes[name] / _CLOSE
        yield (
            f"The discretisation error, estimated from h and h/2, is at most {percent_text(sizes[name])} ({name}): "
            f"`--steps {float(f'{steps:.2g}'):.0f}` reduces it to {percent_text(_CLOSE)}, unless the motion is chaotic "
            "and extremes do not converge."
        )
    if any((each.interval or 0.0) > abs(each.fine - each.coarse) for each in loose):
        yield "If ± exceeds the difference of h and h/2, increase `--turns`: four times as many halve ±."


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
    header = ("link", "kg m2", "source", "by planets (kg m2)", "missing")
    return Section("Inertia", (), (filled_table(header, cut(rows), 3),))
