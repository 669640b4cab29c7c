"""Report on the transmission errors or anomalies and the speeds of a train's outputs over revolutions of the input, as
data and as a document.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from geartrain.errors import GearTrainError
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, figure, titled
from geartrain.teeth.coupling import unmodelled_properties
from geartrain.wings import WingResult, has_wing, wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion, MotionRun, RunningStatistics
    from geartrain.dynamics.motion.motion_run import SpectrumLine
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver

_TURNS, _POSITIONS = 20.0, 20_001  # turns and positions of the run in a report


class PhaseRange(NamedTuple):
    """Range of the deviation of one output over several computations with random tooth phases."""

    peak_to_peak: tuple[float, float]
    """Minimum and maximum of the peak-to-peak deviation of the output [rad] in all runs."""
    rms: tuple[float, float]
    """Minimum and maximum of the root mean square deviation of the output [rad] in all runs."""


class PhaseSets(NamedTuple):
    """Number of evaluated sets of random tooth phases, and the random seed."""

    sets: int
    """Number of sets of random tooth phases."""
    seed: int | None
    """Random seed; None if no seed was given."""


class PartialRun(NamedTuple):
    """Number of positions that were computed in an interrupted run, and number of requested positions."""

    done: int
    """Number of positions that were computed."""
    of: int
    """Number of positions that were requested."""


@dataclass(frozen=True)
class OutputMotion:
    """Motion of one output over a run. A result that was not requested is None."""

    KEYS = (Key("", "tally"), "setting", "sensitivity", "phases", "spectrum")

    tally: RunningStatistics
    """Extreme values and moments of the deviation, and of the speed, over all evaluated positions."""
    setting: float
    """Constant offset of the pointer [rad] by which its deviation at turn 0 becomes 0."""
    sensitivity: Mapping[str, float]
    """Rotation of the output per rotation error of the driven wheel of each pair [rad/rad], keyed by pair."""
    phases: PhaseRange | None
    """Range of the deviation over all computations with random tooth phases; None if it was not requested."""
    spectrum: Sequence[SpectrumLine] | None
    """Spectral lines of the deviation, by order (cycles per turn of the input); None if not requested."""


@dataclass(frozen=True)
class MotionFigures(Result):
    """Deviations and speeds of the outputs over a run in one state; angles in rad, travels of slides in mm."""

    PAGE = "report.motion_report:describe_motion"

    KEYS = (
        *("name", "state", "input", "turns", "positions", "period", "drivers", "reversing_drivers", "rigid", "outputs"),
        *("separation", "phases", "partial", "advances"),
    )

    run: MotionRun
    """Motion run from which the results are taken. It is not included in the JSON data."""
    name: str
    """Name of the train."""
    state: str | None
    """Name of the requested state; None if no state was requested."""
    input: str
    """Name of the driving link. The number of turns refers to this link."""
    turns: float
    """Number of evaluated revolutions of the driving link; negative for backward motion."""
    positions: int
    """Number of positions at which the motion was computed."""
    period: Fraction | None
    """Turns of the driving link after which the motion repeats; None if every output moves uniformly."""
    drivers: Mapping[str, MeshDriver]
    """Driving wheel of each pair whose speed ratio varies, keyed by pair."""
    reversing_drivers: Sequence[str]
    """Names of the pairs whose driving wheel temporarily turns against its mean sense of rotation."""
    rigid: Sequence[str]
    """Names of the pairs whose tooth form keeps a constant speed ratio, without transmission error."""
    outputs: Mapping[str, OutputMotion]
    """Deviation, speed and further requested results of each output, keyed by output name."""
    separation: Annotated[Any, WingResult("simulation", "SeparationRates")] | None
    """Speeds of the driving link at which teeth first separate. The computed motion is valid only below these
    speeds; None if no link driven by the input has an inertia, if torques have no units, or if the optional package
    `simulation` is not installed.
    """
    phases: PhaseSets | None
    """Random tooth phases that were evaluated; None if none were requested."""
    partial: PartialRun | None
    """Progress of an interrupted run; None for a complete run."""
    advances: Mapping[str, float]
    """Mean speed of each link that one-way clutches drive stepwise, divided by the input speed [1]."""


@dataclass(frozen=True)
class UnfollowedMotion:
    """State of a train whose motion cannot be computed, and the reason."""

    KEYS = ("name", "state", "error")

    name: str
    """Name of the train."""
    state: str | None
    """Name of the state; None if the train has no states."""
    why: GearTrainError
    """Error that prevents the computation of the motion."""

    @property
    def error(self) -> str:
        """Text that states why the motion cannot be computed."""
        return str(self.why)


def collect_motion(run: MotionRun, name: str, state: str | None, separation: Any = None) -> MotionFigures:
    """Return the results of a motion run for each of its outputs."""
    motion = run.motion
    # pairs that drive no output are not reported
    used = {source.id for source in motion._forward.used}
    outputs = {
        tally.name: OutputMotion(
            tally,
            motion.pointer_offsets[tally.name],
            motion.sensitivity[tally.name],
            _phase_range([tallies[at] for tallies in run.phase_statistics]),
            run.spectra.get(tally.name),
        )
        for at, tally in enumerate(run.statistics)
    }
    return MotionFigures(
        run,
        name,
        state,
        input=motion._problem.driving_link,
        turns=run.turns,
        positions=run.done,
        period=motion.period,
        drivers={pair: motion._problem.drivers[pair] for pair in motion._problem.drivers if pair in used},
        reversing_drivers=sorted(run.reversing_drivers),
        rigid=[mesh.name for mesh in motion._problem.rigid],
        outputs=outputs,
        separation=separation,
        phases=PhaseSets(len(run.phase_statistics), run.seed) if run.phase_statistics else None,
        partial=PartialRun(run.done, run.samples) if run.done < run.samples else None,
        advances=motion.advances,
    )


def _phase_range(tallies: list[RunningStatistics]) -> PhaseRange | None:
    if not tallies:
        return None
    peaks, rms = zip(*((tally.peak_to_peak, tally.rms) for tally in tallies), strict=True)
    return PhaseRange((min(peaks), max(peaks)), (min(rms), max(rms)))


def collect_motions(train: GearTrain) -> Iterator[MotionFigures | UnfollowedMotion]:
    """Yield the motion of a train in every state; yield nothing if the speed ratios of all pairs are constant."""
    if not ripples(train):
        return
    from geartrain.dynamics import MotionRun

    for state in train.states or (None,):
        try:
            run = MotionRun(train.motion(state), _TURNS, _POSITIONS)
            run.run()
            separation = separation_rates(train, state)
        except GearTrainError as error:
            yield UnfollowedMotion(train.name, state, error)
        else:
            yield collect_motion(run, train.name, state, separation)


def separation_rates(train: GearTrain, state: str | None, without: Sequence[str] = ()) -> Any:
    """Return the input speeds at which teeth first separate in a state (`geartrain.simulation.SeparationRates`).

    The result is None if the train has no inertia or no units of torque, or if the package `simulation` is missing.
    """
    # reports are part of the core, which imports optional packages only on demand
    if not (train.declaration.has_inertia and has_wing("simulation")):
        return None
    separation = wing("simulation.contacts.separation_rate")
    if not separation.has_separation(train.mechanics, state):
        return None
    return separation.find_separation(train.mechanics, state, without)


def ripples(train: GearTrain) -> bool:
    """Return True if a coupling or pair has a variable speed ratio, so that outputs may not turn uniformly."""
    return bool(train.mechanics.couplings) or any(not mesh.rigid for mesh in train.meshes)


# ----------------------------------------------------------------------------------------------------------------- page


_ABREAST = 8  # outputs in one table
_ROUNDING = 1e-13  # rad: smaller deviations are rounding errors


def describe_motion(found: MotionFigures, every_output: bool = False) -> Document:
    """Return a document on the deviation and speed of each output over a run, and on further requested results."""
    run = found.run
    train, period = run.motion._problem, run.motion.period
    summary = [
        f"{run.turns:g} turns of '{train.driving_link}', {run.done} positions. Speeds are relative to the speed of "
        f"'{train.driving_link}'; the {train.deviation} is the angle minus its mean motion."
    ]
    if train.deviation == "deviation":
        summary.append(
            "A deviation includes the anomaly of pins, which is designed, and the transmission error of teeth."
        )
    if run.done < run.samples:
        summary.append(f"PARTIAL: stopped after {run.done} of {run.samples} positions.")
    if period is not None:
        summary.append(f"Everything repeats after {abridged_text(period)} turns of '{train.driving_link}'.")
    if run.motion._declaration is not None:
        summary += [f"Not modelled: {each}." for each in unmodelled_properties(run.motion._declaration.couplings)]
    sections = list(motion_sections(run, every_output))
    if found.separation is not None:
        sections.append(wing("simulation.contacts.separation_rate").separation_section(found.separation))
    return Document("Motion with real teeth and pins", summary, sections)


def motion_document(found: Motion | MotionRun) -> Document | None:
    """Return the document of a run, or of the default run of a motion; None if the motion has no run."""
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import MotionRun

    run = found if isinstance(found, MotionRun) else found._usual_run
    if not run.done:
        return None
    motion, separation = run.motion, None
    if motion._declaration is not None:
        separation = separation_rates(GearTrain(motion._declaration), motion._state, motion._without)
    return describe_motion(collect_motion(run, "", motion._state, separation))


def motion_sections(run: MotionRun, every_output: bool = False) -> Iterator[Section]:
    """Yield sections on the outputs, on the pairs that cause their deviations, and on further requested results."""
    yield Section("Outputs", tuple(_remarks(run)), _outputs(run.statistics, run.motion._problem.deviation))
    if run.motion._forward.used:
        yield _pairs(run, every_output)
        yield from _steps(run.motion)
    if rigid := _rigid(run.motion._problem.rigid):
        yield Section("Pairs that keep their ratio", (rigid,))
    if run.phase_statistics:
        yield _random_phases(run)
    for name, lines in run.spectra.items():
        if lines:
            yield _spectrum(name, lines, name in run.motion._sliding)


def moving_sections(
    train: GearTrain, found: Sequence[MotionFigures | UnfollowedMotion], toothed: bool
) -> Iterator[Section]:
    """Yield a section on the motion in each state; `toothed` is True for a train with tooth forms."""
    for each in found:
        head = titled(each.state, "motion")
        if isinstance(each, UnfollowedMotion):
            yield Section(head, [f"{problem.what}: {problem.why}." for problem in each.why.problems])
            continue
        run = each.run
        text = f"{run.turns:g} turns of '{run.motion._problem.driving_link}'; for details see `geartrain motion`."
        holds: tuple[str, ...] = ()
        if each.separation is not None:
            holds = tuple(wing("simulation.contacts.separation_rate").separation_text(each.separation))
        rippling = [tally for tally in run.statistics if tally.peak_to_peak] or run.statistics
        declared = train.declaration.outputs
        pointers = [tally for tally in rippling if tally.name in declared and declared[tally.name].is_pointer]
        yield Section(
            head, (text, *holds, *_remarks(run)), _outputs(pointers or rippling, run.motion._problem.deviation)
        )
    if toothed and not ripples(train):
        yield Section("Motion", (_rigid(train.meshes),))


def _rigid(meshes: Iterable[GearMesh]) -> str:
    """Return a sentence that lists the pairs of constant speed ratio by tooth form; "" if all ratios vary."""
    forms: dict[str, list[str]] = {}
    for mesh in meshes:
        if mesh.rigid:
            forms.setdefault(mesh.form.replace("_", " "), []).append(mesh.name)
    if not forms:
        return ""
    words = "; ".join(f"{', '.join(names)} ({form})" for form, names in forms.items())
    return f"These pairs keep their ratio at every instant and contribute no transmission error: {words}."


def _outputs(tallies: Sequence[RunningStatistics], deviation: str) -> tuple[Table, ...]:
    def row(tally: RunningStatistics) -> tuple[str, ...]:
        # a mean speed of 0 cannot be the divisor
        speeds = _speeds(*tally.speeds) + ("" if tally.ratio else " (divided by the input's)")
        return (
            tally.name,
            figure(tally.ratio, 9),
            *(_amount(tally.slides, each) for each in (tally.peak_to_peak, tally.rms)),
            speeds,
        )

    def head(unit: str) -> tuple[str, ...]:
        mean = "mean travel (mm per turn)" if unit == "mm" else "mean speed"
        return ("output", mean, *_deviation_heads(deviation, unit), "speed / mean speed")

    return _by_unit(tallies, head, row)


def _by_unit(
    tallies: Sequence[RunningStatistics],
    head: Callable[[str], tuple[str, ...]],
    row: Callable[[RunningStatistics], tuple[str, ...]],
) -> tuple[Table, ...]:
    """Return up to two tables: outputs that turn, with angles in deg, and links that slide, with travels in mm."""
    groups = {unit: [tally for tally in tallies if _unit(tally.slides) == unit] for unit in ("deg", "mm")}
    return tuple(Table(head(unit), list(map(row, own))) for unit, own in groups.items() if own)


def _speeds(low: float, high: float) -> str:
    # rounding of a speed of 0 must not print a sign
    return f"{round(low, 5) + 0.0:.5f}..{round(high, 5) + 0.0:.5f}"


def _unit(slides: bool) -> str:
    return "mm" if slides else "deg"


def _deviation_heads(deviation: str, unit: str) -> tuple[str, str]:
    return f"{deviation} p-p ({unit})", f"{deviation} rms ({unit})"


def _remarks(run: MotionRun) -> Iterator[str]:
    for link, speed in run.motion.advances.items():
        yield (
            f"'{link}' advances by {figure(speed, 11)} turn per turn of '{run.motion._problem.driving_link}' in its "
            "declared sense, with the fastest of the links that drive it through one-way clutches; otherwise friction "
            f"holds it. Not computed: the position of {', '.join(sorted(run.motion._problem.behind))} within a step."
        )
    if measured := [source.id for source in run.motion._forward.used if source.transmission.measured]:
        yield f"{', '.join(measured)}: teeth as measured, without random errors."
    if run.reversing_drivers:
        composition = run.motion._composition(run.turns)
        names = ", ".join(source.id for source in composition.used if source.id in run.reversing_drivers)
        yield (
            f"The driver of {names} temporarily turns backwards. Then the other flanks drive, and the crossing of the "
            "backlash is not simulated."
        )
    if jumping := [source.id for source in run.motion._forward.used if source.transmission.at_once]:
        yield f"{', '.join(jumping)} moves at once: the speeds of outputs are the speeds between these steps."
    if not all(tally.searched for tally in run.statistics):
        from geartrain.dynamics.motion.superposition import Superposition

        bounds = Superposition(run.motion._composition(run.turns)).bounds
        limits = (
            f"{tally.name} {tally.degrees_or_mm * most:.5g} {_unit(tally.slides)}"
            for tally, most in zip(run.statistics, bounds, strict=True)
        )
        yield (
            "The run is too long to search every pitch, so extremes are those of the computed positions; a shorter run "
            f"is searched completely. The {run.motion._problem.deviation} p-p is at most {', '.join(limits)}."
        )


def _pairs(run: MotionRun, every_output: bool) -> Section:
    motion = run.motion
    moved = [name for name in motion.outputs if any(motion.sensitivity[name][each.id] for each in motion._forward.used)]
    shown = moved if every_output else moved[:_ABREAST]
    own = motion._problem.deviation
    text = [f"Contribution of each pair to an output: the range of its own {own} times the output's sensitivity to it."]
    if still := [name for name in motion.outputs if name not in moved]:
        text.append(f"No pair affects {', '.join(still)}.")
    if neglected := moved[len(shown) :]:
        text.append(f"Not shown: {', '.join(neglected)}; `--wide` or `--of` shows them.")
    # a table with all outputs would be too wide
    blocks = [shown[at : at + _ABREAST] for at in range(0, len(shown), _ABREAST)]
    return Section("Pairs", tuple(text), tuple(_shares(motion, outputs) for outputs in blocks or [[]]))


def _shares(motion: Motion, outputs: Sequence[str]) -> Table:
    """Return a table of each pair's contribution to the peak-to-peak deviation of some outputs [deg or mm]."""
    rows = []
    for source in motion._forward.used:
        driver = motion._problem.drivers[source.id]
        low, high = source.transmission.error_range()
        reaches = {name: abs(motion.sensitivity[name][source.id]) * (high - low) for name in outputs}
        given = [_amount(name in motion._sliding, reach, 4) for name, reach in reaches.items()]
        rows.append((source.id, driver.wheel, driver.why, str(source.cycles), *given))
    named = (f"{name} ({_unit(name in motion._sliding)})" for name in outputs)
    return Table(("pair", "driving wheel", "basis", "periods a turn", *named), rows, wide=True)


def _steps(motion: Motion) -> Iterator[Section]:
    """Yield a section on couplings whose driven link rests for a part of each period; yield nothing without any."""
    rows = []
    for source in motion._forward.used:
        transmission = source.transmission
        if transmission.dwell:
            peak = "at once" if transmission.at_once else f"{transmission.speed_range()[1]:.8g}"
            rows.append((source.id, str(transmission.dwell), str(transmission.ratio), peak))
    if rows:
        text = "Couplings that move by steps: speeds of the driven link relative to the driver, seen from the carrier."
        header = ("coupling", "fraction at rest", "mean ratio", "maximum speed ratio")
        yield Section("Steps", (text,), (Table(header, rows),))


def _random_phases(run: MotionRun) -> Section:
    def row(tally: RunningStatistics) -> tuple[str, ...]:
        sets = [tallies[run.statistics.index(tally)] for tallies in run.phase_statistics]
        errors = ("..".join(f"{tally.degrees_or_mm * end:.5g}" for end in ends) for ends in _phase_range(sets) or ())
        lows, highs = zip(*(each.speeds for each in sets), strict=True)
        return tally.name, *errors, _speeds(min(lows), max(highs))

    deviation = run.motion._problem.deviation
    text = f"{len(run.phase_statistics)} sets of random phases of the teeth, seed {run.seed}."
    tables = _by_unit(
        run.statistics, lambda unit: ("output", *_deviation_heads(deviation, unit), "speed / mean speed"), row
    )
    return Section("Random phases", (text,), tables)


def _amount(slides: bool, value: float, digits: int = 6) -> str:
    """Return a string with an angle in degrees, or with the travel in mm of a link that slides (`slides` is True)."""
    # joints that cancel leave rounding errors
    value = value if abs(value) > _ROUNDING else 0.0
    return f"{value if slides else degrees(value):.{digits}g}"


def _spectrum(name: str, lines: list[SpectrumLine], slides: bool) -> Section:
    rows = []
    for line in lines:
        sources = ", ".join(f"{pair} x{harmonic}" for pair, harmonic, _ in line.shares)
        amplitudes = (_amount(slides, each) for each in (line.expected, line.measured))
        rows.append((str(line.order), figure(float(line.order), 8), sources, *amplitudes))
    unit = _unit(slides)
    header = ("order", "per turn of the input", "pair and harmonic", f"expected ({unit})", f"measured ({unit})")
    text = "Amplitudes by exact order: expected to first order, and measured in the composed motion."
    return Section(f"Spectrum of {name}", (text,), (Table(header, rows),))
