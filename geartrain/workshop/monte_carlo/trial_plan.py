"""A train as its trials see it: wheels with their errors, pairs with their sizes, and how errors reach the outputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING, Any

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import fraction_text
from geartrain.workshop.cutting.declared_errors import (
    OF_PAIRS,
    ErrorOverride,
    ErrorSpecification,
    WheelErrors,
    check_names,
    filing_stroke,
    pair_errors,
    wheel_errors,
)
from geartrain.workshop.cutting.displaced_pair import mean_lag
from geartrain.workshop.monte_carlo.trial_pair import DisplacedTrialPair, TrialPair, TriangularTrialPair

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.gear_mesh import GearMesh

_FARTHEST = 10**6  # turns of the input within which positions are drawn, where the train takes longer to repeat


@dataclass(frozen=True)
class TrialPlan:
    """A train as its trials see it, in one state: all that one block of trials needs.

    Attributes
    ----------
    name : str
        Of the train.
    wheels : tuple of WheelErrors
        Every wheel that is cut by hand, and how.
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

    @property
    def files(self) -> bool:
        """True if some pair is filed to fit."""
        return any(pair.stroke for pair in self.pairs)

    def scaled(self, factor: float) -> TrialPlan:
        """The plan with all errors multiplied by a factor.

        Parameters
        ----------
        factor : float
            0 or more.
        """

        def times(errors: Mapping[str, ErrorSpecification]) -> dict[str, ErrorSpecification]:
            return {each: off.times(factor) for each, off in errors.items()}

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
        return replace(self, pairs=tuple(each.cleared(clearance) for each in self.pairs))

    def question(self) -> dict[str, Any]:
        """All on which results hang, as plain data: a journal knows its train by it."""
        return {
            "train": self.name,
            "wheels": [
                [each.name, each.z, each.half_angle, _plain(each.errors), each.towards, dict(each.tables)]
                for each in self.wheels
            ],
            "pairs": [
                [each.name, each.first, each.second, *each.question, _plain(each.fitting), each.stroke]
                for each in self.pairs
            ],
            "outputs": [[name, fraction_text(speed)] for name, speed in zip(self.outputs, self.speeds, strict=True)],
            "span": self.span,
        }


def _plain(errors: Mapping[str, ErrorSpecification]) -> dict[str, Any]:
    return {kind: [off.way, off.size] for kind, off in errors.items()}


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
        With triangular or conjugate teeth, and `cutting` or `fitting` errors unless they are set here.
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
        To be handed to `run_trials`, `jamming_map`, `find_sobol_indices` and `run_course`.

    Raises
    ------
    QuestionError
        For trains without such teeth or without errors.
    RangeError
        For errors greater than the tooth.
    GearTrainError
        For loops of real teeth.

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["placement=0.1 %"]), ["sun"])
    >>> [pair.name for pair in plan.pairs], plan.wheels[0].errors["placement"].size
    (['a~b1', 'b2~c1', 'c2~d1', 'd2~e'], 0.001)
    """
    motion = train.motion(state, outputs, without)
    meshes = _cut_meshes(train, motion)
    even: dict[str, WheelErrors] = {}
    for mesh in meshes:
        for wheel in _even_wheels(train, mesh):
            even.setdefault(wheel.name, wheel)
    names = tuple(even)
    check_names(settings, names, [mesh.name for mesh in meshes])
    wheels = tuple(wheel_errors(train.declaration, each, settings) for each in even.values())
    senses = _Senses(motion)
    pairs = tuple(_pair(train, mesh, names, senses, settings) for mesh in meshes)
    composition = motion.with_sources([pair.name for pair in pairs])
    if all(wheel.true for wheel in wheels) and not any(pair.fitting for pair in pairs):
        what = f"'{train.name}' declares no errors"
        why = "wheels cut true neither jam nor stray"
        fix = "declare `cutting: {placement: {normal: 2 %}}`, or give --set placement='2 %'"
        raise QuestionError(Problem(what, why, fix))
    speeds = tuple(tally.ratio for tally in motion.tallies())
    reach = tuple(_reach(composition, at, [pair.name for pair in pairs]) for at in range(len(motion.outputs)))
    return TrialPlan(
        train.name,
        wheels,
        pairs,
        composition,
        tuple(motion.outputs),
        speeds,
        reach,
        _span(composition, pairs),
        motion.train.lead,
    )


def _cut_meshes(train: GearTrain, motion: Motion) -> list[GearMesh]:
    """The pairs whose teeth can be cut with errors. Raises `QuestionError` where there is none."""
    found = [mesh for mesh in motion.train.teeth if mesh.has_cut_sizes or mesh.displaced_contact is not None]
    if not found:
        what = f"'{train.name}' has no triangular teeth, nor others whose errors are reckoned"
        why = "cutting errors are reckoned tooth by tooth for triangular teeth and for all whose contact is known"
        fix = "declare `tooth_form: {form: involute}` or another such form on the train or on its pairs"
        raise QuestionError(Problem(what, why, fix))
    return found


def _even_wheels(train: GearTrain, mesh: GearMesh) -> tuple[WheelErrors, WheelErrors]:
    """The driver and the driven wheel of a pair without errors, as this pair has their teeth."""
    counts = [train.declaration.wheels[name][1].count or 0 for name in (mesh.driver, mesh.driven)]
    contact = mesh.displaced_contact
    if contact is None:
        named = zip((mesh.driver, mesh.driven), counts, mesh.cut_sizes.half_angles, mesh.cut_sizes.signs, strict=True)
        driver, driven = (WheelErrors(name, z, angle, ring=sign < 0) for name, z, angle, sign in named)
        return driver, driven
    first, second = contact.wheels
    return (
        WheelErrors(mesh.driver, counts[0], first.half_angle, displaced=first),
        WheelErrors(mesh.driven, counts[1], second.half_angle, displaced=second),
    )


def _span(composition: ErrorComposition, pairs: Sequence[TrialPair]) -> float:
    """Turns of the input after which the same teeth meet everywhere, no more than a million."""
    counts = {pair.name: pair.count for pair in pairs}
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
    wheels, contact = _even_wheels(train, mesh), mesh.displaced_contact
    lesser = min(wheels, key=lambda wheel: wheel.depth) if contact is not None else _less_deep(mesh, wheels)
    fitting = pair_errors(train.declaration, mesh, lesser, settings)
    fitting = {kind: off for kind, off in fitting.items() if kind in OF_PAIRS}
    mirrored = senses.mirrored(mesh.name, mesh.driver), senses.mirrored(mesh.name, mesh.driven)
    numbers = names.index(mesh.driver), names.index(mesh.driven)
    stroke = filing_stroke(train.declaration, mesh, lesser)
    if contact is None:
        sizes, even = mesh.cut_sizes, mesh.law.error_moments()[0]
        return TriangularTrialPair(mesh.name, *numbers, mirrored, even, sizes, fitting=fitting, stroke=stroke)
    # that of the first-order law itself, lest its own error at another distance be taken for one of cutting
    even = -mean_lag(contact)
    return DisplacedTrialPair(mesh.name, *numbers, mirrored, even, contact, fitting=fitting, stroke=stroke)


def _less_deep(mesh: GearMesh, wheels: tuple[WheelErrors, WheelErrors]) -> WheelErrors:
    """The wheel with the less deep triangular teeth, the driver of two alike."""
    depths = mesh.cut_sizes.depths
    return wheels[0] if depths[0] <= depths[1] else wheels[1]
