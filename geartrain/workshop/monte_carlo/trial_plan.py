"""A train as its trials see it: wheels with their errors, pairs with their sizes, and how errors reach the outputs.

A `TrialPair` is a gear pair whose wheels are drawn, judged, filed and set in motion, whatever their teeth; a
`TrialPlan` holds all pairs of a train and the composition of their errors.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import gcd, inf, lcm, nan, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Shown
from geartrain.workshop.cutting.cut_wheel import CutGearPair
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
from geartrain.workshop.cutting.displaced_pair import DisplacedPair, even_backlash, mean_lag
from geartrain.workshop.cutting.file_strokes import FileableCutPair, FilingWork, file_to_fit
from geartrain.workshop.cutting.meshing_cycle import batch_verdicts
from geartrain.workshop.cutting.minimum_backlash import jamming_bound, nominal_backlash
from geartrain.workshop.cutting.trial_transmission import (
    CutTrialTransmission,
    DisplacedTrialTransmission,
    TrialTransmissionFunction,
)
from geartrain.workshop.monte_carlo.random_streams import fitted

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Ints
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts


_SPOILT = 0.125  # of a pitch: a flank filed beyond a quarter of its tooth's thickness
_FARTHEST = 10**6  # turns of the input within which positions are drawn, where the train takes longer to repeat


# ---------------------------------------------------------------------------------------------------------------- pairs


@dataclass(frozen=True, slots=True)
class TrialPair(ABC):
    """One gear pair: `first` drives, both wheels by number; `mirrored` where a wheel turns against its own
    numbering."""

    name: str
    first: int
    second: int
    mirrored: tuple[bool, bool]
    even: float
    """Mean error of the pair without cutting errors (rad of the driven wheel)."""
    fitting: Mapping[str, ErrorSpecification] = field(default_factory=dict, kw_only=True)
    """Errors of its axes, in depths of the less deep teeth."""
    stroke: float = field(default=0.0, kw_only=True)
    """What one stroke of the file takes, in the same depths; 0 where nothing is filed to fit."""

    @property
    @abstractmethod
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers of the driver and of the driven wheel."""

    @property
    @abstractmethod
    def depth(self) -> float:
        """Depth of the less deep teeth (in the unit of lengths of the wheels)."""

    @property
    @abstractmethod
    def backlash(self) -> float:
        """Nominal play, in pitches of the driven wheel."""

    @property
    @abstractmethod
    def question(self) -> tuple[float, ...]:
        """Its sizes, on which results hang."""

    @abstractmethod
    def cut(self, wheels: Sequence[Any], shift: Any) -> Any:
        """The pair of drawn wheels on its axles, these so much farther apart."""

    @abstractmethod
    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """What becomes of each trial of a cut pair."""

    @abstractmethod
    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """The transmission functions of a cut pair; `rows` says which trial is asked at each angle."""

    @abstractmethod
    def filed(self, pair: Any) -> FilingWork[Any]:
        """A cut pair filed to fit."""

    @abstractmethod
    def cleared(self, clearance: float) -> TrialPair:
        """The pair at another clearance."""

    def jamming_bound(self, sigma: float) -> float:
        """A bound on the probability of a jam by normal errors of placement (of a pitch); NaN where none is known."""
        del sigma
        return nan

    @property
    def pitches(self) -> tuple[float, float]:
        """Pitches of both wheels (rad)."""
        return 2 * pi / self.teeth[0], 2 * pi / self.teeth[1]

    @property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.teeth[0] * self.teeth[1] // gcd(*self.teeth)


@dataclass(frozen=True, slots=True)
class TriangularTrialPair(TrialPair):
    """Triangular teeth: exact for errors of any size."""

    sizes: TriangularSizes

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        return self.sizes.z1, self.sizes.z2

    @property
    def depth(self) -> float:
        """Depth of the less deep teeth (as the radii)."""
        return min(self.sizes.depths)

    @property
    def backlash(self) -> float:
        """Nominal play, in pitches."""
        return nominal_backlash(self.sizes)

    @property
    def question(self) -> tuple[float, ...]:
        """Radii, half angles, distance."""
        sizes = self.sizes
        return *sizes.signed_radii, sizes.beta1, sizes.beta2, sizes.excess

    def cut(self, wheels: Sequence[Any], shift: Any) -> CutGearPair:
        """Wheels of outer radius 1 in the sizes of the pair."""
        sizes = self.sizes
        R1, R2 = sizes.signed_radii
        first = fitted(wheels[self.first], R1, sizes.beta1, self.mirrored[0])
        second = fitted(wheels[self.second], R2, sizes.beta2, self.mirrored[1])
        return CutGearPair(sizes, first, second, shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """One trial where all share everything."""
        first = pair.first if pair.trials else replace(pair.first, place=pair.first.place[None])
        return batch_verdicts(pair.sizes, first, pair.second, pair.shift)

    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Tooth by tooth."""
        return CutTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """Those that jam are filed; the others are left as they are drawn."""
        count = pair.trials[0] if pair.trials else 1
        jams = np.flatnonzero(self.verdicts(pair).jams)
        strokes, teeth = np.zeros((2, count), np.int64)
        low = tuple(np.zeros((count, 2, z)) for z in self.teeth)
        if len(jams):
            whole = FileableCutPair(_each(pair, count))
            work = file_to_fit(whole.taken(jams), self.stroke * self.depth, _SPOILT * self.sizes.R2 * self.pitches[1])
            strokes[jams], teeth[jams] = work.strokes, work.teeth
            for own, filed in zip(low, work.low, strict=True):
                own[jams] = filed
            pair = whole.filed((low[0], low[1])).pair
        return FilingWork(pair, strokes, teeth, (low[0], low[1]))

    def jamming_bound(self, sigma: float) -> float:
        """2 lcm Q(play / 2 sigma)."""
        return jamming_bound(self.sizes, sigma)

    def cleared(self, clearance: float) -> TriangularTrialPair:
        """1 and the excess, which of an external pair is its clearance factor, or a share of the pair's own window."""
        return replace(self, sizes=self._cleared(clearance))

    def _cleared(self, clearance: float) -> TriangularSizes:
        if clearance >= 1:
            return self.sizes.at(clearance - 1)
        from geartrain.teeth.triangular.clearance_window import find_window

        window = find_window(self.sizes)
        if not window:
            what = f"pair '{self.name}' has no window of clearance"
            raise RangeError(Problem(what, "no clearance lets its even teeth turn", "give clearance factors above 1"))
        return self.sizes.at(window.at(clearance))


@dataclass(frozen=True, slots=True)
class DisplacedTrialPair(TrialPair):
    """Other teeth: displaced flanks along the contact of a couple, right to first order in the errors."""

    contact: DisplacedContact

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        first, second = self.contact.wheels
        return first.z, second.z

    @property
    def depth(self) -> float:
        """Depth of the less deep teeth (modules; rad on cones)."""
        return min(each.depth for each in self.contact.wheels)

    @property
    def backlash(self) -> float:
        """Nominal play, in pitches."""
        return even_backlash(self.contact) / self.pitches[1]

    @property
    def question(self) -> tuple[float, ...]:
        """What the contact is made of, by a few of its numbers."""
        at = self.contact
        return at.start, at.end, float(at.normal[0]), float(at.normal[-1]), at.backlash, float(at.even[0])

    def cut(self, wheels: Sequence[Any], shift: Any) -> DisplacedPair:
        """Wheels as they turn in this pair."""
        pair = zip((self.first, self.second), self.mirrored, strict=True)
        first, second = (wheels[at].mirrored() if turned else wheels[at] for at, turned in pair)
        if not np.broadcast_shapes(first.trials, second.trials, np.shape(shift)):
            first = replace(first, place=first.place[None])
        return DisplacedPair(self.contact, first, second, shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """What becomes of each trial."""
        found: MeshingVerdicts = pair.verdicts()
        return found

    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Of the foremost couple at each angle."""
        return DisplacedTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """By strokes of the length declared."""
        return file_to_fit(pair, self.stroke * self.depth, _SPOILT * self.contact.wheels[0].pitch)

    def cleared(self, clearance: float) -> DisplacedTrialPair:
        """A factor of the centre distance (1 and above)."""
        if clearance < 1 or not self.contact.distance < inf:
            what = f"pair '{self.name}' has no {'window of clearance' if clearance < 1 else 'centre distance'}"
            why = "shares of a window are of triangular teeth, factors of a centre distance of parallel axes"
            raise RangeError(
                Problem(what, why, "leave --clearance out, or give factors above 1 where axes are parallel")
            )
        return replace(self, contact=self.contact.apart_by((clearance - 1) * self.contact.distance))


def _each(pair: CutGearPair, count: int) -> CutGearPair:
    """The pair with an axis of trials on both wheels."""
    wheels = [
        replace(wheel, place=np.broadcast_to(wheel.place, (count, wheel.z))) for wheel in (pair.first, pair.second)
    ]
    return CutGearPair(pair.sizes, wheels[0], wheels[1], pair.shift)


# ------------------------------------------------------------------------------------------------------------ the train


@dataclass(frozen=True)
class TrialPlan(Shown):
    """A train as its trials see it, in one state: all that one block of trials needs.

    See Also
    --------
    find_trial_plan : makes it
    """

    name: str
    """Of the train."""
    wheels: tuple[WheelErrors, ...]
    """Every wheel that is cut by hand, and how."""
    pairs: tuple[TrialPair, ...]
    """Every pair of them, with its sizes and the errors of its axes."""
    composition: ErrorComposition
    """The motion with even teeth, whose laws the trials replace."""
    outputs: tuple[str, ...]
    """Names of the outputs."""
    speeds: tuple[Fraction, ...]
    """Of the outputs, over the input's."""
    reach: tuple[tuple[int, ...], ...]
    """For each output the pairs that can move it, by number."""
    span: float
    """Turns of the input within which positions are drawn [turn]."""
    driving_link: str
    """The link that is turned."""

    def _summary(self) -> str:
        return f"{self.name}: {len(self.wheels)} wheels, {len(self.pairs)} pairs, outputs {', '.join(self.outputs[:6])}"

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
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> [pair.name for pair in plan.pairs], plan.wheels[0].errors["pitch_deviation"].size
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
    composition = motion._with_sources([pair.name for pair in pairs])
    if all(wheel.true for wheel in wheels) and not any(pair.fitting for pair in pairs):
        what = f"'{train.name}' declares no errors"
        why = "wheels cut true neither jam nor stray"
        fix = "declare `cutting: {pitch_deviation: {normal: 2 %}}`, or give --set placement='2 %'"
        raise QuestionError(Problem(what, why, fix))
    speeds = tuple(tally.ratio for tally in motion._statistics())
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
        motion._problem.driving_link,
    )


def _cut_meshes(train: GearTrain, motion: Motion) -> list[GearMesh]:
    """The pairs whose teeth can be cut with errors. Raises `QuestionError` where there is none."""
    found = [mesh for mesh in motion._problem.teeth if mesh.has_cut_sizes or mesh.displaced_contact is not None]
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
        self.circuits: dict[str, Circuit] = {circuit.id: circuit for circuit in motion._problem.circuits}
        self.first: dict[str, int] = {}

    def mirrored(self, pair: str, wheel: str) -> bool:
        """True if the wheel turns the other way in this pair than in its first."""
        circuit = self.circuits[pair]
        link = circuit.i if wheel == circuit.wheels[0] else circuit.j
        sense = -1 if self.motion._problem.relative(link, circuit.carrier) < 0 else 1
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
        sizes, even = mesh.cut_sizes, mesh.transmission.error_moments()[0]
        return TriangularTrialPair(mesh.name, *numbers, mirrored, even, sizes, fitting=fitting, stroke=stroke)
    # that of the first-order law itself, lest its own error at another distance be taken for one of cutting
    even = -mean_lag(contact)
    return DisplacedTrialPair(mesh.name, *numbers, mirrored, even, contact, fitting=fitting, stroke=stroke)


def _less_deep(mesh: GearMesh, wheels: tuple[WheelErrors, WheelErrors]) -> WheelErrors:
    """The wheel with the less deep triangular teeth, the driver of two alike."""
    depths = mesh.cut_sizes.depths
    return wheels[0] if depths[0] <= depths[1] else wheels[1]
