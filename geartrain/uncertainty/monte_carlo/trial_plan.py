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
    """A train as its trials see it, in one state: all that one block of trials needs.

    Attributes
    ----------
    name : str
        Of the train.
    wheels : tuple of WheelErrors
        Every wheel with triangular teeth, and how it is cut.
    pairs : tuple of TrialPair
        Every pair of them, with its sizes and the errors of its axes.
    composition : ErrorComposition
        The motion with even teeth, whose laws the trials replace.
    outputs : tuple of str
        Names of the outputs.
    speeds : tuple of Fraction
        Of the outputs, over the input's.
    reach : tuple of tuple of int
        For each output the pairs that can move it, by number.
    span : float
        Turns of the input within which positions are drawn [turn].
    lead : str
        The link that is turned.

    See Also
    --------
    find_trial_plan : makes it
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
        """The plan with all errors, or those of one kind, so many times as great.

        Parameters
        ----------
        factor : float
            0 or more.
        kind : str
            A kind of error; "" for all.
        """

        def times(errors: Mapping[str, ErrorSpecification]) -> dict[str, ErrorSpecification]:
            return {each: off.times(factor) if kind in ("", each) else off for each, off in errors.items()}

        wheels = tuple(replace(each, errors=times(each.errors)) for each in self.wheels)
        pairs = tuple(replace(each, fitting=times(each.fitting)) for each in self.pairs)
        return replace(self, wheels=wheels, pairs=pairs)

    def cleared(self, clearance: float) -> TrialPlan:
        """The plan with every pair at another clearance.

        Parameters
        ----------
        clearance : float
            A factor of the least centre distance (1 and above), or a share of each pair's own window (below 1).
        """
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
    """Everything that Monte Carlo trials of a train with hand-cut wheels need, in one state.

    Parameters
    ----------
    train : GearTrain
        With triangular teeth, and `cutting` or `fitting` errors unless they are set here.
    settings : sequence of ErrorOverride
        Errors in place of what is declared; `read_error_overrides` reads them.
    outputs : sequence of str
        By default all.
    state : str, optional
        A declared state; None only of a train that has none.
    without : sequence of str
        Pairs left out, so that real teeth do not contradict each other around a loop.

    Returns
    -------
    TrialPlan
        To be handed to `run_trials`, `jamming_map`, `find_tolerance`, `find_sobol_indices` and `run_course`.

    Raises
    ------
    QuestionError
        For trains without triangular teeth or without errors.
    RangeError
        For errors greater than the tooth.
    GearTrainError
        For loops of real teeth.

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.uncertainty import find_trial_plan, read_error_overrides
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["placement=0.1 %"]), ["sun"])
    >>> [pair.name for pair in plan.pairs], plan.wheels[0].errors["placement"].size
    (['a~b1', 'b2~c1', 'c2~d1', 'd2~e'], 0.001)
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
