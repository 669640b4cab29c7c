"""What is told of one train as plain data: its answers alone, and all that a report holds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from geartrain.numerics.results import Key, Result
from geartrain.wings import WingResult, has_wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.errors import Problem
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.buildability import BuildFinding
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.gridlock.removal import Gridlock
    from geartrain.kinematics.judged_outputs import Sensitivity
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import Mobility
    from geartrain.report.gear_pairs import DrivenPair, DrivenPin
    from geartrain.report.motion_report import MotionFigures, UnfollowedMotion
    from geartrain.report.torque_report import TorqueFigures
    from geartrain.train import Train
    from geartrain.train.states import Erratum

_MOST_LINKS = 500  # of a train whose adjacency is told


@dataclass(frozen=True)
class TrainAnswers(Result):
    """A train and its answers: one for each state that was asked for."""

    KEYS: ClassVar[tuple[str | Key, ...]] = ("name", "title", "unit", "mobility", "states")

    train: GearTrain
    """The train itself, which is not part of the data."""
    mobility: Mobility | None
    """None where one output was asked for: it takes all circuits, where that takes those that drive it."""
    states: tuple[Answer, ...]
    """Answers; a train without states has one, whose `state` is None."""

    @property
    def name(self) -> str:
        """Of the train."""
        return self.train.name

    @property
    def title(self) -> str:
        """One line for a reader."""
        return self.train.declaration.title

    @property
    def unit(self) -> str:
        """Of speeds; empty for plain numbers."""
        return self.train.declaration.unit_name


def collect_answers(train: GearTrain, answers: Iterable[Answer], whole: bool = True) -> TrainAnswers:
    """What `solve` tells: answers of a train; without its mobility unless it is solved as a whole."""
    return TrainAnswers(train, train.mobility if whole else None, tuple(answers))


@dataclass(frozen=True)
class AdjacencyLetters:
    """Which links are joined: in row and column order of `links` the turning pairs, gear pairs and couplings."""

    links: tuple[str, ...]
    """Names of the rows and columns, in order."""
    cells: list[list[str]]
    """Letters of the joints between two links, row by row: R a turning pair, G a gear pair, C a coupling."""


@dataclass(frozen=True)
class StateSensitivity:
    """What one tooth on a wheel in doubt does to an output in a state."""

    KEYS = ("state", Key("", "change"))

    state: str | None
    """The state; None for a train without states."""
    change: Sensitivity
    """What one tooth less and one more change."""


@dataclass(frozen=True)
class TrainReport(TrainAnswers):
    """All that a report on a train holds; `to_dict` gives its JSON, `describe_train` its page.

    See Also
    --------
    collect_report : Gives it.
    """

    PAGE = "report.train_report:describe_train"
    TEXT = "report.train_report:describe_answers"

    KEYS = (
        *("name", "title", "unit", "mobility", "states", "gridlock", "closure", "sources"),
        Key("circuits", keys=("id", "kind", "i", "j", "carrier", "wheels", "ratio", "note")),
        *("adjacency", "build_findings", Key("remarks", keys=("place", "what", "why")), "sensitivity"),
        *("teeth", "pins", "torques", "strength", "motion", "errata"),
    )

    gridlock: Gridlock
    """Links that are locked together, and the least meshes to remove."""
    closure: MeshPhasing | None
    """Whether the teeth of all loops meet; None where axes have no positions."""
    sources: Mapping[str, str]
    """Citations by key."""
    circuits: tuple[Circuit, ...]
    """The fundamental circuit of each gear pair and coupling."""
    adjacency: AdjacencyLetters | None
    """Which links are joined; None for very large trains."""
    build_findings: tuple[BuildFinding, ...]
    """What of the train cannot be built, and what is unwise."""
    remarks: tuple[Problem, ...]
    """Conventions that the answers rest on."""
    sensitivity: tuple[StateSensitivity, ...]
    """What one tooth more or less on a wheel in doubt does."""
    teeth: tuple[DrivenPair, ...]
    """Pairs with real teeth, in every way in which they are driven."""
    pins: tuple[DrivenPin, ...]
    """Couplings with dimensions."""
    torques: tuple[TorqueFigures, ...]
    """Of every state with loads, or friction of bearings."""
    strength: tuple[Annotated[Any, WingResult("simulation", "TrainStrength")], ...]
    """Of every state with loads in units, where a train says what its wheels are made of."""
    motion: tuple[MotionFigures | UnfollowedMotion, ...]
    """Of every state of a train with real teeth or pins; where it cannot be followed, the `error`."""
    errata: tuple[Erratum, ...]
    """Errors of the sources, as declared."""


def collect_report(train: GearTrain, whole: bool = True) -> TrainReport:
    """Everything a report holds: answers, structure, teeth, torques, motion, doubts and errata.

    Parameters
    ----------
    train : GearTrain
        A train in all its states. What it does not declare, such as teeth or loads, is not worked out.
    whole : bool
        False leaves out what takes numpy: teeth, pins, torques, strength, motion, and whether loops close.

    Returns
    -------
    TrainReport
        Its `to_dict` is the answer of `geartrain report --json`.

    Raises
    ------
    GearTrainError
        If teeth are declared that cannot be made.

    Examples
    --------
    The carrier of a planetary set whose ring is held turns 24/(24 + 60) as fast as its sun (docs/theory.md, 4):

    >>> import geartrain
    >>> report = collect_report(geartrain.load("planetary-24-18-60"))
    >>> report.to_dict()["states"][0]["speeds"]["carrier"]["exact"]
    '2/7'
    """
    from geartrain.kinematics.graph import adjacency_labels

    declared, small = train.declaration, len(train.declaration.links) <= _MOST_LINKS
    answers = tuple(train.answers())
    own = train.kinematics
    doubts = ((answer, change) for answer in answers if answer.verdict for change in own.sensitivity(answer))
    loaded = tuple(state for state in own.usable_states if whole and declared.is_loaded(state))
    return TrainReport(
        **vars(collect_answers(train, answers)),
        gridlock=own.gridlock,
        closure=train.closure if whole and own.is_placed else None,
        sources={key: source.cite for key, source in declared.sources.items()},
        circuits=train.circuits,
        adjacency=AdjacencyLetters(tuple(declared.links), adjacency_labels(declared)) if small else None,
        build_findings=train.build_findings,
        remarks=own.remarks,
        sensitivity=tuple(StateSensitivity(answer.state, change) for answer, change in doubts),
        **_teeth_and_motion(train, whole),
        torques=_torques(train, loaded),
        strength=tuple(train.strength(state) for state in loaded if _has_strength(declared, state)),
        errata=tuple(declared.errata),
    )


def _torques(train: GearTrain, loaded: Sequence[str | None]) -> tuple[TorqueFigures, ...]:
    if not loaded:
        return ()
    from geartrain.report.torque_report import collect_torques

    return tuple(collect_torques(train, train.torques(state)) for state in loaded)


def _teeth_and_motion(train: GearTrain, whole: bool) -> dict[str, Any]:
    """The fields on real teeth and pins, empty for a train that has none."""
    if not (whole and (train.mechanics.teeth or train.mechanics.pins)):
        return {"teeth": (), "pins": (), "motion": ()}
    from geartrain.report.gear_pairs import driven_pairs, driven_pins
    from geartrain.report.motion_report import collect_motions

    return {"teeth": driven_pairs(train), "pins": driven_pins(train), "motion": tuple(collect_motions(train))}


def _has_strength(declared: Train, state: str | None) -> bool:
    """True if a state has loads in units, a wheel declares its material, and the wing `simulation` is installed."""
    if not has_wing("simulation"):
        return False
    if declared.material is None and all(wheel.material is None for _, wheel in declared.wheels.values()):
        return False
    from geartrain.dynamics.torques.power_flow import has_torque_units

    return has_torque_units(declared, state)
