"""Errors and speeds of a train's outputs over a run: figures for JSON, from which the page is told."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from geartrain.errors import GearTrainError
from geartrain.numerics.results import Key, Result
from geartrain.wings import WingResult, has_wing, wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import ErrorEstimates, MotionRun, RunningStatistics, SpectrumLine
    from geartrain.teeth.meshing_wheels import MeshDriver

_TURNS, _POSITIONS = 20.0, 20_001  # of the run in a report


class PhaseRange(NamedTuple):
    """Least and greatest error (rad) of one output over runs with other phases."""

    peak_to_peak: tuple[float, float]
    rms: tuple[float, float]


class PhaseSets(NamedTuple):
    """How many sets of random phases were tried, and their seed."""

    sets: int
    seed: int | None


class PartialRun(NamedTuple):
    """What was done of an interrupted run."""

    done: int
    of: int


@dataclass(frozen=True)
class OutputMotion:
    """One output of a run; what was not asked for is None.

    setting       by how much the pointer is turned on its wheels, so that at turn 0 its teeth do not displace it (rad)
    sensitivity   radians of the output per radian of error of a pair's driven side, by pair
    """

    KEYS = (Key("", "tally"), "setting", "sensitivity", "phases", "estimates", "spectrum")

    tally: RunningStatistics
    setting: float
    sensitivity: Mapping[str, float]
    phases: PhaseRange | None
    estimates: ErrorEstimates | None
    spectrum: Sequence[SpectrumLine] | None


@dataclass(frozen=True)
class MotionFigures(Result):
    """Errors and speeds of a train with real teeth and pins in one state, over a run; angles in rad.

    Attributes
    ----------
    run : MotionRun
        What was done; not part of the data.
    name : str
        Of the train.
    state : str or None
        As it was named.
    input : str
        The link whose turns are counted.
    turns : float
        Of the input [turn]; negative backwards.
    positions : int
        At which the motion was worked out.
    period : Fraction or None
        Turns of the input after which everything repeats; None where nothing ripples.
    drivers : mapping of str to MeshDriver
        The driving wheel of each pair that ripples.
    turned_back : sequence of str
        Pairs whose driver turns against its mean at times.
    rigid : sequence of str
        Pairs with real teeth that keep their ratio at every instant and add nothing.
    outputs : mapping of str to OutputMotion
        Transmission error, speed and whatever else was asked, by output.
    separation : geartrain.simulation.SeparationRates or None
        Up to which rate of the input this motion holds; None where no inertia is declared.
    phases : PhaseSets or None
        Random phases that were tried.
    partial : PartialRun or None
        What was done of an interrupted run.

    See Also
    --------
    collect_motion : Gives it.
    """

    KEYS = (
        *("name", "state", "input", "turns", "positions", "period", "drivers", "turned_back", "rigid", "outputs"),
        *("separation", "phases", "partial"),
    )

    run: MotionRun
    name: str
    state: str | None
    input: str
    turns: float
    positions: int
    period: Fraction | None
    drivers: Mapping[str, MeshDriver]
    turned_back: Sequence[str]
    rigid: Sequence[str]
    outputs: Mapping[str, OutputMotion]
    separation: Annotated[Any, WingResult("simulation", "SeparationRates")] | None
    phases: PhaseSets | None
    partial: PartialRun | None


@dataclass(frozen=True)
class UnfollowedMotion:
    """A state in which the motion cannot be followed, and why."""

    KEYS = ("name", "state", "error")

    name: str
    state: str | None
    why: GearTrainError

    @property
    def error(self) -> str:
        """Why, in words."""
        return str(self.why)


def collect_motion(run: MotionRun, name: str, state: str | None, separation: Any = None) -> MotionFigures:
    """Figures of a run, by output.

    Parameters
    ----------
    run : MotionRun
        After its `go`, and `try_phases`, `estimate` or `analyse` where these are wanted.
    name : str
        Of the train.
    state : str or None
        As it was named.
    separation : geartrain.simulation.SeparationRates, optional
        Up to which rate of the input this motion holds.

    Returns
    -------
    MotionFigures
        Its `to_dict` is the answer of `geartrain motion --json`.

    Examples
    --------
    Teeth change the speed of the moon within a turn of the crank, but never its mean, 254/19 in a year of 5 turns:

    >>> import geartrain
    >>> from geartrain.dynamics import MotionRun
    >>> run = MotionRun(geartrain.load("moon-triangular").motion(), turns=1.0, samples=101)
    >>> run.go()
    >>> collect_motion(run, "moon-triangular", None).to_dict()["outputs"]["moon"]["ratio"]
    '254/95'
    """
    motion = run.motion
    used = {source.id for source in motion.ahead.used}
    outputs = {
        tally.name: OutputMotion(
            tally,
            motion.setting[tally.name],
            motion.sensitivity[tally.name],
            _phase_range([tallies[at] for tallies in run.phased]),
            run.estimates.get(tally.name),
            run.spectra.get(tally.name),
        )
        for at, tally in enumerate(run.tallies)
    }
    return MotionFigures(
        run,
        name,
        state,
        input=motion.train.lead,
        turns=run.turns,
        positions=run.done,
        period=motion.period,
        drivers={pair: motion.train.drivers[pair] for pair in motion.train.drivers if pair in used},
        turned_back=sorted(run.turned_back),
        rigid=[mesh.name for mesh in motion.train.rigid],
        outputs=outputs,
        separation=separation,
        phases=PhaseSets(len(run.phased), run.seed) if run.phased else None,
        partial=PartialRun(run.done, run.samples) if run.done < run.samples else None,
    )


def _phase_range(tallies: list[RunningStatistics]) -> PhaseRange | None:
    if not tallies:
        return None
    peaks, rms = zip(*((tally.peak_to_peak, tally.rms) for tally in tallies), strict=True)
    return PhaseRange((min(peaks), max(peaks)), (min(rms), max(rms)))


def collect_motions(train: GearTrain) -> Iterator[MotionFigures | UnfollowedMotion]:
    """Motion in every state; nothing, and no computation, for a train of ideal teeth and pins without sizes."""
    if not ripples(train):
        return
    from geartrain.dynamics import MotionRun

    for state in train.states or (None,):
        try:
            run = MotionRun(train.motion(state), _TURNS, _POSITIONS)
            run.go()
            separation = separation_rates(train, state)
        except GearTrainError as error:
            yield UnfollowedMotion(train.name, state, error)
        else:
            yield collect_motion(run, train.name, state, separation)


def separation_rates(train: GearTrain, state: str | None, without: Sequence[str] = ()) -> Any:
    """The `geartrain.simulation.SeparationRates` of a state.

    None if nothing behind the input has an inertia, if torques have no units, or without the wing `simulation`.
    """
    if not (train.declaration.has_inertia and has_wing("simulation")):
        return None
    separation = wing("simulation.contacts.train_separation")
    if not separation.has_separation(train.mechanics, state):
        return None
    return separation.find_separation(train.mechanics, state, without)


def ripples(train: GearTrain) -> bool:
    """Whether any pair or pin has an error of its own."""
    return bool(train.mechanics.pins) or any(not mesh.rigid for mesh in train.meshes)
