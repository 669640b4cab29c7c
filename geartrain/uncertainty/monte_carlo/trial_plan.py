"""A train as its trials see it: wheels with their errors, pairs with their sizes, and how errors reach the outputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING, Any

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.decimal_text import fraction_text
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.uncertainty.manufacturing_errors.declared_errors import (
    OF_PAIRS,
    ErrorOverride,
    ErrorSpecification,
    WheelErrors,
    check_names,
    pair_errors,
    wheel_errors,
)

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.gear_mesh import GearMesh

_FARTHEST = 10**6  # turns of the input within which positions are drawn, where the train takes longer to repeat


@dataclass(frozen=True, slots=True)
class TrialPair:
    """One gear pair: `first` drives, both wheels by number; `mirrored` where a wheel turns against its own numbering.

    even     mean error of the pair without cutting errors (rad of the driven wheel)
    fitting  errors of its axes, in depths of the less deep teeth
    """

    name: str
    sizes: TriangularSizes
    first: int
    second: int
    mirrored: tuple[bool, bool]
    even: float
    fitting: Mapping[str, ErrorSpecification] = field(default_factory=dict)

    @property
    def depth(self) -> float:
        """Depth of the less deep teeth (as the radii)."""
        return min(self.sizes.depths)


@dataclass(frozen=True)
class TrialPlan:
    """All that one block of trials needs; it travels to the workers.

    composition   the motion with even teeth, whose laws the trials replace
    reach         for each output the pairs that can move it, by number
    span          turns of the input within which positions are drawn
    """

    name: str
    wheels: tuple[WheelErrors, ...]
    pairs: tuple[TrialPair, ...]
    composition: ErrorComposition
    outputs: tuple[str, ...]
    speeds: tuple[Fraction, ...]
    reach: tuple[tuple[int, ...], ...]
    span: float
    lead: str

    @property
    def position(self) -> int:
        """The number of the stream from which positions are drawn; pairs come before it, and wheels before them."""
        return len(self.wheels) + len(self.pairs)

    def scaled(self, factor: float, kind: str = "") -> TrialPlan:
        """All errors, or those of one kind, so many times as great."""

        def times(errors: Mapping[str, ErrorSpecification]) -> dict[str, ErrorSpecification]:
            return {each: off.times(factor) if kind in ("", each) else off for each, off in errors.items()}

        wheels = tuple(replace(each, errors=times(each.errors)) for each in self.wheels)
        pairs = tuple(replace(each, fitting=times(each.fitting)) for each in self.pairs)
        return replace(self, wheels=wheels, pairs=pairs)

    def cleared(self, clearance: float) -> TrialPlan:
        """Every pair at a clearance factor (1 and above), or at a share of its own window (below 1)."""
        return replace(self, pairs=tuple(replace(each, sizes=_cleared(each, clearance)) for each in self.pairs))

    def question(self) -> dict[str, Any]:
        """All on which results hang, as plain data: a journal knows its train by it."""
        return {
            "train": self.name,
            "wheels": [
                [each.name, each.z, each.half_angle, _plain(each.errors), each.towards, dict(each.tables)]
                for each in self.wheels
            ],
            "pairs": [
                [each.name, each.first, each.second, *_sizes(each.sizes), _plain(each.fitting)] for each in self.pairs
            ],
            "outputs": [[name, fraction_text(speed)] for name, speed in zip(self.outputs, self.speeds, strict=True)],
            "span": self.span,
        }


def _plain(errors: Mapping[str, ErrorSpecification]) -> dict[str, Any]:
    return {kind: [off.way, off.size] for kind, off in errors.items()}


def _sizes(sizes: TriangularSizes) -> tuple[float, ...]:
    return sizes.R1, sizes.R2, sizes.beta1, sizes.beta2, sizes.excess


def _cleared(pair: TrialPair, clearance: float) -> TriangularSizes:
    if clearance >= 1:
        return pair.sizes.at(clearance - 1)
    from geartrain.teeth.triangular.clearance_window import find_window

    window = find_window(pair.sizes)
    if not window:
        what = f"pair '{pair.name}' has no window of clearance"
        raise RangeError(Problem(what, "no clearance lets its even teeth turn", "give clearance factors above 1"))
    return pair.sizes.at(window.at(clearance))


def find_trial_plan(
    train: GearTrain,
    settings: Sequence[ErrorOverride] = (),
    outputs: Sequence[str] = (),
    state: str | None = None,
    without: Sequence[str] = (),
) -> TrialPlan:
    """The plan of a train in one state.

    settings   errors in place of what is declared; `outputs`, by default all; `without`, pairs left out
    Raises `QuestionError` for trains without triangular teeth or without errors, `RangeError` for errors greater than
    the tooth, `GearTrainError` for loops of real teeth.
    """
    motion = train.motion(state, outputs, without)
    meshes = [mesh for mesh in motion.train.teeth if mesh.has_cut_sizes]
    if not meshes:
        what = f"'{train.name}' has no triangular teeth"
        why = "cutting errors are reckoned tooth by tooth for straight flanks that meet in a point"
        fix = "declare `tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}` on the train or on its pairs"
        raise QuestionError(Problem(what, why, fix))
    names = tuple(dict.fromkeys(wheel for mesh in meshes for wheel in (mesh.driver, mesh.driven)))
    check_names(settings, names, [mesh.name for mesh in meshes])
    angles = _half_angles(meshes)
    wheels = tuple(wheel_errors(train.declaration, name, angles[name], settings) for name in names)
    senses = _Senses(motion)
    pairs = tuple(_pair(train, mesh, names, senses, settings) for mesh in meshes)
    if all(wheel.true for wheel in wheels) and not any(pair.fitting for pair in pairs):
        what = f"'{train.name}' declares no errors"
        why = "wheels cut true neither jam nor stray"
        fix = "declare `cutting: {placement: {normal: 2 %}}`, or give --set placement='2 %'"
        raise QuestionError(Problem(what, why, fix))
    speeds = tuple(tally.ratio for tally in motion.tallies())
    reach = tuple(_reach(motion.ahead, at, [pair.name for pair in pairs]) for at in range(len(motion.outputs)))
    return TrialPlan(
        train.name,
        wheels,
        pairs,
        motion.ahead,
        tuple(motion.outputs),
        speeds,
        reach,
        _span(motion.ahead, pairs),
        motion.train.lead,
    )


def _half_angles(meshes: Sequence[GearMesh]) -> dict[str, float]:
    """Half angle of the teeth of every wheel, as its first pair has them (rad)."""
    found: dict[str, float] = {}
    for mesh in meshes:
        sizes = mesh.cut_sizes
        found.setdefault(mesh.driver, sizes.beta1)
        found.setdefault(mesh.driven, sizes.beta2)
    return found


def _span(composition: ErrorComposition, pairs: Sequence[TrialPair]) -> float:
    """Turns of the input after which the same teeth meet everywhere, no more than a million."""
    counts = {pair.name: lcm(pair.sizes.z1, pair.sizes.z2) for pair in pairs}
    cycles = [source.cycles / counts.get(source.id, 1) for source in composition.used if source.cycles]
    if not cycles:
        return 1.0
    whole = Fraction(lcm(*(each.denominator for each in cycles)), gcd(*(each.numerator for each in cycles)))
    return float(min(whole, Fraction(_FARTHEST)))


def _reach(composition: ErrorComposition, output: int, names: Sequence[str]) -> tuple[int, ...]:
    alone = ErrorComposition(composition.spread, composition.sources, (composition.outputs[output],))
    used = {source.id for source in alone.used}
    return tuple(at for at, name in enumerate(names) if name in used)


class _Senses:
    """Which way each wheel turns in each of its pairs: teeth are numbered as they pass in the first of them."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self.circuits: dict[str, Circuit] = {circuit.id: circuit for circuit in motion.train.circuits}
        self.first: dict[str, int] = {}

    def mirrored(self, pair: str, wheel: str) -> bool:
        """True if the wheel turns the other way in this pair than in its first."""
        circuit = self.circuits[pair]
        link = circuit.i if wheel == circuit.wheels[0] else circuit.j
        sense = -1 if self.motion.train.relative(link, circuit.carrier) < 0 else 1
        return self.first.setdefault(wheel, sense) != sense


def _pair(
    train: GearTrain, mesh: GearMesh, names: tuple[str, ...], senses: _Senses, settings: Sequence[ErrorOverride]
) -> TrialPair:
    sizes = mesh.cut_sizes
    first = sizes.depths[0] <= sizes.depths[1]
    lesser, angle = (mesh.driver, sizes.beta1) if first else (mesh.driven, sizes.beta2)
    fitting = pair_errors(train.declaration, mesh, lesser, angle, settings)
    return TrialPair(
        mesh.name,
        sizes,
        names.index(mesh.driver),
        names.index(mesh.driven),
        (senses.mirrored(mesh.name, mesh.driver), senses.mirrored(mesh.name, mesh.driven)),
        mesh.law.error_moments()[0],
        {kind: off for kind, off in fitting.items() if kind in OF_PAIRS},
    )
