"""Data on one train: its speeds and outputs (`solve`), and the contents of its report."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from geartrain.numerics.results import Key, Result
from geartrain.wings import WingResult, has_wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics.clock_rate import Timekeeping
    from geartrain.errors import Problem
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.buildability import BuildFinding
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.gridlock.removal import Gridlock
    from geartrain.kinematics.judged_outputs import Sensitivity
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import Mobility
    from geartrain.report.couplings import VaryingCoupling
    from geartrain.report.gear_pairs import DrivenPair, DrivenPin
    from geartrain.report.motion_report import MotionFigures, UnfollowedMotion
    from geartrain.report.torque_report import TorqueFigures
    from geartrain.train.states import Erratum

_MOST_LINKS = 500  # maximum number of links of a train whose adjacency matrix is reported


@dataclass(frozen=True)
class TrainAnswers(Result):
    """Speeds and outputs of a train in each requested state."""

    KEYS: ClassVar[tuple[str | Key, ...]] = ("name", "title", "unit", "mobility", "states")

    train: GearTrain
    """Train that was solved. It is not included in the JSON data."""
    mobility: Mobility | None
    """Mobility of the train; None if only one output was requested, because mobility needs all circuits."""
    states: tuple[Answer, ...]
    """Speeds and outputs in each state. A train without states has one entry, whose `state` is None."""

    @property
    def name(self) -> str:
        """Name of the train."""
        return self.train.name

    @property
    def title(self) -> str:
        """Title of the train."""
        return self.train.declaration.title

    @property
    def unit(self) -> str:
        """Unit of the speeds; an empty string for numbers without a unit."""
        return self.train.declaration.unit_name


def collect_answers(train: GearTrain, answers: Iterable[Answer], whole: bool = True) -> TrainAnswers:
    """Return the data of `geartrain solve`: speeds and outputs of a train, and its mobility if `whole` is True."""
    return TrainAnswers(train, train.mobility if whole else None, tuple(answers))


@dataclass(frozen=True)
class AdjacencyLetters:
    """Adjacency matrix of the links. Its cells contain letters for turning pairs, gear pairs and couplings."""

    links: tuple[str, ...]
    """Names of the links, in the order of the rows and columns of the matrix."""
    cells: list[list[str]]
    """Connections between two links, row by row: R denotes a turning pair, G a gear pair, C a coupling."""


@dataclass(frozen=True)
class StateSensitivity:
    """Change of an output in one state if a wheel of uncertain tooth count has one tooth fewer or one tooth more."""

    KEYS = ("state", Key("", "change"))

    state: str | None
    """Name of the state; None if the train has no states."""
    change: Sensitivity
    """Relative change of the output if the wheel has one tooth fewer, and if it has one tooth more."""


@dataclass(frozen=True)
class TrainReport(TrainAnswers):
    """Results and data of the report on a train. `to_dict` returns its JSON data, and `describe_train` its document.

    See Also
    --------
    collect_report : Return the report of a train.
    """

    PAGE = "report.train_report:describe_train"
    TEXT = "report.train_report:describe_answers"

    KEYS = (
        *("name", "title", "unit", "mobility", "states", "gridlock", "closure", "sources"),
        Key("circuits", keys=("id", "kind", "i", "j", "carrier", "wheels", "ratio", "note")),
        *("adjacency", "build_findings", Key("remarks", keys=("place", "what", "why")), "sensitivity"),
        *("teeth", "pins", "couplings", "torques", "timekeeping", "strength", "motion", "errata"),
    )

    gridlock: Gridlock
    """Links that are locked together by meshes, and a minimal set of meshes whose removal frees them."""
    closure: MeshPhasing | None
    """Assembly condition: whether the teeth of every loop mesh at the declared positions; None without positions."""
    sources: Mapping[str, str]
    """Full citation of each source, keyed by the short name of the source."""
    circuits: tuple[Circuit, ...]
    """Fundamental circuit of each gear pair and coupling."""
    adjacency: AdjacencyLetters | None
    """Adjacency matrix of the links; None for a train of more than 500 links."""
    build_findings: tuple[BuildFinding, ...]
    """Findings on the buildability of the train: errors and notes."""
    remarks: tuple[Problem, ...]
    """Notes on conventions and mean values used in the results."""
    sensitivity: tuple[StateSensitivity, ...]
    """Changes of the outputs if a wheel with an uncertain tooth count has one tooth fewer or one tooth more."""
    teeth: tuple[DrivenPair, ...]
    """Pairs with a declared tooth form, one entry for each driving wheel that occurs in at least one state."""
    pins: tuple[DrivenPin, ...]
    """Pin-and-slot couplings whose dimensions are declared."""
    couplings: tuple[VaryingCoupling, ...]
    """Other couplings with a variable ratio, such as universal joints."""
    torques: tuple[TorqueFigures, ...]
    """Torques in every state with loads or bearing friction."""
    timekeeping: tuple[Timekeeping, ...]
    """Energy, amplitude and rate of a clock in every state with a load or a drive; empty without an escapement."""
    strength: tuple[Annotated[Any, WingResult("simulation", "TrainStrength")], ...]
    """Tooth strength in every state whose loads have units, if materials of wheels are declared."""
    motion: tuple[MotionFigures | UnfollowedMotion, ...]
    """Motion in every state with tooth forms or pins; an entry with `error` could not be computed."""
    errata: tuple[Erratum, ...]
    """Declared errors in the published sources."""


def collect_report(train: GearTrain, whole: bool = True) -> TrainReport:
    """Return the results and data of the report on a train: speeds, structure, teeth, torques and motion.

    Parameters
    ----------
    train : GearTrain
        Train to report on, in all its states. Teeth, torques and motion are computed only if the train declares data
        for them.
    whole : bool
        True to include the parts that need numpy: teeth, pins, torques, strength, motion and closure of loops.

    Returns
    -------
    TrainReport
        Report whose `to_dict` is the answer of `geartrain report --json`.

    Raises
    ------
    GearTrainError
        If declared teeth cannot be made.

    Examples
    --------
    The carrier of a planetary set with a fixed ring turns 24/(24 + 60) times as fast as its sun (docs/theory.md, 4):

    >>> import geartrain
    >>> report = collect_report(geartrain.load("planetary-24-18-60"))
    >>> report.to_dict()["states"][0]["speeds"]["carrier"]["exact"]
    '2/7'
    """
    from geartrain.kinematics.graph import adjacency_labels

    # the matrix has as many entries as the square of the number of links
    declared, small = train.declaration, len(train.declaration.links) <= _MOST_LINKS
    answers = tuple(train.answers())
    own = train.kinematics
    # sensitivities exist only for determined speeds
    uncertainties = ((answer, change) for answer in answers if answer.verdict for change in own.sensitivity(answer))
    loaded = tuple(state for state in own.usable_states if whole and declared.is_loaded(state))
    materials = (declared.material, *(wheel.material for _, wheel in declared.wheels.values()))
    has_strength = has_wing("simulation") and any(material is not None for material in materials)
    return TrainReport(
        **vars(collect_answers(train, answers)),
        gridlock=own.gridlock,
        closure=train.closure if whole and own.is_placed else None,
        sources={key: source.cite for key, source in declared.sources.items()},
        circuits=train.circuits,
        adjacency=AdjacencyLetters(tuple(declared.links), adjacency_labels(declared)) if small else None,
        build_findings=train.build_findings,
        remarks=own.remarks,
        sensitivity=tuple(StateSensitivity(answer.state, change) for answer, change in uncertainties),
        **_teeth_and_motion(train, whole),
        torques=_torques(train, loaded),
        timekeeping=_timekeeping(train) if whole and declared.escapement is not None else (),
        strength=tuple(train.strength(state) for state in loaded if has_strength and declared.has_torque_units(state)),
        errata=tuple(declared.errata),
    )


def _torques(train: GearTrain, loaded: Sequence[str | None]) -> tuple[TorqueFigures, ...]:
    if not loaded:
        return ()
    from geartrain.report.torque_report import collect_torques

    return tuple(collect_torques(train, train.torques(state)) for state in loaded)


def _timekeeping(train: GearTrain) -> tuple[Timekeeping, ...]:
    from geartrain.dynamics.clock_rate import find_timekeeping

    cases = (train.mechanics.unfolded.load_case(state) for state in train.kinematics.usable_states)
    found = (find_timekeeping(case) for case in cases if case is not None)
    return tuple(each for each in found if each is not None)


def _teeth_and_motion(train: GearTrain, whole: bool) -> dict[str, Any]:
    if not (whole and (train.mechanics.teeth or train.mechanics.couplings)):
        return {"teeth": (), "pins": (), "couplings": (), "motion": ()}
    from geartrain.report.couplings import varying_couplings
    from geartrain.report.gear_pairs import driven_pairs, driven_pins
    from geartrain.report.motion_report import collect_motions

    return {
        "teeth": driven_pairs(train),
        "pins": driven_pins(train),
        "couplings": tuple(varying_couplings(train)),
        "motion": tuple(collect_motions(train)),
    }
