"""Input data of trials: wheels with errors, pairs with any tooth form, and the composition of their errors."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import chain
from math import gcd, inf, lcm, nan, pi
from typing import TYPE_CHECKING, Any

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Shown
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutWheel
from geartrain.workshop.cutting.declared_errors import (
    ErrorOverride,
    ErrorSpecification,
    WheelErrors,
    check_names,
    pair_errors,
    wheel_errors,
)
from geartrain.workshop.cutting.displaced_pair import DisplacedPair, even_backlash, mean_lag
from geartrain.workshop.cutting.file_strokes import FilingWork, file_to_fit, tight_place
from geartrain.workshop.cutting.meshing_cycle import batch_verdicts, jamming_bound, nominal_backlash
from geartrain.workshop.cutting.trial_transmission import (
    CutTrialTransmission,
    DisplacedTrialTransmission,
    TrialTransmissionFunction,
)

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.numerics.arrays import Ints
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts


_MAXIMUM_FILING = 0.125  # pitches: a quarter of the thickness of a tooth, beyond which a flank is useless
_MAXIMUM_SPAN = 10**6  # turns of the input, if the train takes longer to repeat: doubles keep 1e-10 of a turn there


# ---------------------------------------------------------------------------------------------------------------- pairs


@dataclass(frozen=True, slots=True)
class TrialPair(ABC):
    """Gear pair of a plan, with any tooth form."""

    name: str
    first: int
    """Index of the driver among the wheels of the plan."""
    second: int
    """Index of the driven wheel."""
    mirrored: tuple[bool, bool]
    """Flags of driver and driven wheel, True if the teeth pass the mesh in descending order of their numbers."""
    teeth: tuple[int, int]
    """Numbers of teeth of the driver and of the driven wheel."""
    depth: float
    """Smaller tooth depth of the two wheels [unit of the radii, module, or rad for bevel gears]."""
    even: float
    """Mean transmission error of the pair without cutting errors [rad of the driven wheel]."""
    fitting: Mapping[str, ErrorSpecification] = field(default_factory=dict, kw_only=True)
    """Errors of the axes, keyed by kind, as fractions of the smaller tooth depth of the two wheels."""
    stroke: float = field(default=0.0, kw_only=True)
    """Depth of one stroke of the file divided by the smaller tooth depth of the two wheels; 0 if the pair is not filed.
    """

    @property
    @abstractmethod
    def backlash(self) -> float:
        """Nominal backlash [pitch of the driven wheel]."""

    @property
    @abstractmethod
    def question(self) -> tuple[float, ...]:
        """Numbers on which the results of the pair depend. With other data, they identify the run in a journal."""

    @abstractmethod
    def cut(self, wheels: Sequence[Any], shift: Any) -> Any:
        """Return the pair with the given wheels, scaled to its sizes, and the centre distance increased by `shift`."""

    @abstractmethod
    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """Return the events (jam, clash, dwell, loss of contact) and minimum backlash of a cut pair in each trial."""

    @abstractmethod
    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Return the transmission functions of a cut pair. `rows` contains the trial of each driver angle."""

    @abstractmethod
    def filed(self, pair: Any) -> FilingWork[Any]:
        """Return the result of filing a cut pair until it turns without a jam.

        A pair remains jammed if more than an eighth of a pitch would have to be removed from a flank.
        """

    @abstractmethod
    def cleared(self, clearance: float) -> TrialPair:
        """Return the pair at another centre distance.

        clearance   clearance factor if it is 1 or more, otherwise the position between the minimum (0) and the maximum
                    (1) of the clearance factor at which the pair turns
        """

    def jamming_bound(self, sigma: float) -> float:
        """Return an upper bound of the jam probability for normal pitch deviations `sigma` [pitch]; NaN if unknown."""
        return nan

    @property
    def pitches(self) -> tuple[float, float]:
        """Angular pitches of both wheels [rad]."""
        return 2 * pi / self.teeth[0], 2 * pi / self.teeth[1]

    @property
    def count(self) -> int:
        """Number of tooth pairs in one full meshing cycle."""
        return lcm(*self.teeth)


@dataclass(frozen=True, slots=True)
class TriangularTrialPair(TrialPair):
    """Gear pair with triangular teeth. The results are exact for errors of any size."""

    sizes: TriangularSizes

    @property
    def backlash(self) -> float:
        """Nominal backlash [pitch of the driven wheel]."""
        return nominal_backlash(self.sizes)

    @property
    def question(self) -> tuple[float, ...]:
        """Signed radii, half angles and excess of the centre distance, on which the results of the pair depend."""
        sizes = self.sizes
        return *sizes.signed_radii, sizes.beta1, sizes.beta2, sizes.excess

    def cut(self, wheels: Sequence[Any], shift: Any) -> CutGearPair:
        """Return the pair with the given wheels, whose tip radius is 1 (-1 if internal), scaled to its own radii."""
        cut = []
        for at, R, beta, mirrored in zip(
            (self.first, self.second), self.sizes.signed_radii, self.sizes.half_angles, self.mirrored, strict=True
        ):
            drawn: CutWheel = wheels[at]
            wheel = CutWheel(R, beta, drawn.place, abs(R) * drawn.tip, drawn.leading, drawn.trailing)
            cut.append(wheel.mirrored() if mirrored else wheel)
        return CutGearPair(self.sizes, cut[0], cut[1], shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """Return the events (jam, clash, dwell, loss of contact) of a cut pair in each trial."""
        return batch_verdicts(pair.sizes, pair.first, pair.second, pair.shift)

    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Return the transmission functions of a cut pair, computed tooth by tooth."""
        return CutTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """Return the result of filing a cut pair until it turns without a jam."""
        limit = _MAXIMUM_FILING * self.sizes.R2 * self.pitches[1]
        return file_to_fit(pair, tight_place, self.stroke * self.depth, limit)

    def jamming_bound(self, sigma: float) -> float:
        """Return an upper bound of the jam probability for normal pitch deviations `sigma` [pitch]."""
        return jamming_bound(self.sizes, sigma)

    def cleared(self, clearance: float) -> TriangularTrialPair:
        """Return the pair at a clearance factor of 1 or more, or at a position from 0 to 1 between its limits."""
        if clearance >= 1:  # a clearance factor; smaller numbers are fractions of the window
            return replace(self, sizes=self.sizes.at(clearance - 1))
        from geartrain.teeth.triangular.clearance_window import find_window

        window = find_window(self.sizes)
        if not window:
            what = f"pair '{self.name}' has no clearance window"
            why = "its perfect teeth jam or lose contact at every clearance factor"
            raise RangeError(Problem(what, why, "give clearance factors above 1: --vary clearance_factor=1.005:1.04:8"))
        return replace(self, sizes=self.sizes.at(window.at(clearance)))


@dataclass(frozen=True, slots=True)
class DisplacedTrialPair(TrialPair):
    """Gear pair of any other tooth form, with flanks displaced at the contact, to first order in the errors."""

    contact: DisplacedContact

    @property
    def backlash(self) -> float:
        """Nominal backlash [pitch of the driven wheel]."""
        return even_backlash(self.contact) / self.pitches[1]

    @property
    def question(self) -> tuple[float, ...]:
        """Numbers of the contact, such as its ends and its backlash, on which the results of the pair depend."""
        at = self.contact
        return at.start, at.end, float(at.normal[0]), float(at.normal[-1]), at.backlash, float(at.even[0])

    def cut(self, wheels: Sequence[Any], shift: Any) -> DisplacedPair:
        """Return the pair with the given wheels, which are mirrored if `mirrored` is True."""
        pair = zip((self.first, self.second), self.mirrored, strict=True)
        first, second = (wheels[at].mirrored() if turned else wheels[at] for at, turned in pair)
        return DisplacedPair(self.contact, first, second, shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """Return the events (jam, clash, dwell, loss of contact) of a cut pair in each trial."""
        found: MeshingVerdicts = pair.verdicts()
        return found

    def transmission(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Return the transmission functions of a cut pair, in which the tooth pair with the smallest lag drives."""
        return DisplacedTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """Return the result of filing a cut pair until it turns without a jam."""
        limit = _MAXIMUM_FILING * self.contact.wheels[0].pitch
        return file_to_fit(pair, DisplacedPair.tight_place, self.stroke * self.depth, limit)

    def cleared(self, clearance: float) -> DisplacedTrialPair:
        """Return the pair with another clearance factor of the centre distance, 1 or more."""
        if clearance < 1 or not self.contact.distance < inf:
            what = f"pair '{self.name}' has no {'clearance window' if clearance < 1 else 'centre distance'}"
            why = "only triangular teeth have a clearance window, and only parallel axes have a centre distance"
            fix = "omit --vary, or give clearance factors above 1 if all axes are parallel"
            raise RangeError(Problem(what, why, fix))
        return replace(self, contact=self.contact.apart_by((clearance - 1) * self.contact.distance))


# ---------------------------------------------------------------------------------------------------------------- train


@dataclass(frozen=True)
class TrialPlan(Shown):
    """Input data of Monte Carlo trials of a train in one state.

    See Also
    --------
    find_trial_plan : Make a plan from a train.
    """

    name: str
    """Name of the train."""
    wheels: tuple[WheelErrors, ...]
    """Sizes and cutting errors of all wheels in the pairs of the trials."""
    pairs: tuple[TrialPair, ...]
    """Gear pairs that contain a wheel with cutting errors. Each entry includes the sizes and the mounting errors of the
    pair.
    """
    composition: ErrorComposition
    """Composed motion of the train with perfect teeth. In each trial, the transmission functions of the cut pairs
    replace the perfect ones.
    """
    outputs: tuple[str, ...]
    """Names of the outputs."""
    speeds: tuple[Fraction, ...]
    """Speeds of the outputs relative to the input, as ratios of output speed to input speed."""
    reach: tuple[tuple[int, ...], ...]
    """Indices of the pairs that affect each output."""
    span: float
    """Range from which the random positions of the input are drawn [turn]."""
    driving_link: str
    """Name of the driving link."""
    shown: Mapping[str, float | None] = field(default_factory=dict)
    """Mean speed of each plotted output [deg/d]; None if it is unknown. The plotted outputs are the requested outputs,
    or by default the outputs with a dial.
    """

    def _summary(self) -> str:
        return f"{self.name}: {len(self.wheels)} wheels, {len(self.pairs)} pairs, outputs {', '.join(self.outputs[:6])}"

    @property
    def position(self) -> int:
        """Index of the random stream from which the positions of the input are drawn.

        Each wheel has a stream, then each pair, and the last stream is used for the positions.
        """
        return len(self.wheels) + len(self.pairs)

    @property
    def files(self) -> bool:
        """True if at least one pair is filed to fit."""
        return any(pair.stroke for pair in self.pairs)

    def scaled(self, factor: float) -> TrialPlan:
        """Return a copy of the plan with all errors multiplied by a factor, except tables of measured errors.

        Parameters
        ----------
        factor : float
            Factor, 0 or more.
        """

        def times(errors: Mapping[str, ErrorSpecification]) -> dict[str, ErrorSpecification]:
            return {kind: replace(off, size=off.size * factor) for kind, off in errors.items()}

        # measured tables describe one real wheel and keep their values
        wheels = tuple(replace(each, errors=times(each.errors)) for each in self.wheels)
        pairs = tuple(replace(each, fitting=times(each.fitting)) for each in self.pairs)
        return replace(self, wheels=wheels, pairs=pairs)

    def cleared(self, clearance: float) -> TrialPlan:
        """Return a copy of the plan with every pair at another clearance factor.

        Parameters
        ----------
        clearance : float
            Clearance factor (1 or more), or relative position between the limits of each pair's clearance factor (below
            1).
        """
        return replace(self, pairs=tuple(each.cleared(clearance) for each in self.pairs))

    def jamming_bound(self, pair: TrialPair) -> float:
        """Return an upper bound of the jam probability of a pair. It is NaN if the pair is filed, if it has errors
        other than normally distributed pitch deviations, or if no bound is known for its teeth.

        Parameters
        ----------
        pair : TrialPair
            Pair of the plan.
        """
        wheels = self.wheels[pair.first], self.wheels[pair.second]
        plain = all(not each.tables and set(each.errors) <= {"pitch_deviation"} for each in wheels)
        normal = all(off.way == "normal" for each in wheels for off in each.errors.values())
        if not (plain and normal) or pair.fitting or pair.stroke:
            return nan
        # the bound assumes one deviation for both wheels: the larger one is safe
        return pair.jamming_bound(max((off.size for each in wheels for off in each.errors.values()), default=0.0))

    def question(self) -> dict[str, Any]:
        """Return all data on which the results depend, as plain data. A journal identifies the run by these data."""
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
    perfect: bool = False,
) -> TrialPlan:
    """Collect the input data for Monte Carlo trials of a train with cutting errors, in one state.

    Parameters
    ----------
    train : GearTrain
        Train in which some pairs have triangular teeth or teeth with a known path of contact. It must declare
        `cutting` or `fitting` errors unless `settings` contains errors.
    settings : sequence of ErrorOverride
        Errors that replace the declared errors; `read_error_overrides` parses them from strings.
    outputs : sequence of str
        Names of outputs or links, by default all outputs.
    state : str, optional
        Name of a declared state. Required if the train declares states.
    without : sequence of str
        Names of pairs to omit, so that the teeth of the remaining pairs do not form a closed loop.
    perfect : bool
        True if a train without errors is allowed.

    Returns
    -------
    TrialPlan
        Input of `run_trials`, `jamming_map`, `find_sobol_indices` and `run_course`.

    Raises
    ------
    QuestionError
        If the train has no such pair, if no errors are given, or if an output slides.
    RangeError
        If errors are larger than a tooth.
    GearTrainError
        If pairs with tooth forms close a loop.

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> [pair.name for pair in plan.pairs], plan.wheels[0].errors["pitch_deviation"].size
    (['a~b1', 'b2~c1', 'c2~d1', 'd2~e'], 0.001)
    """
    motion = train.motion(state, outputs, without)._turning(outputs)
    meshes = [mesh for mesh in motion._problem.teeth if mesh.has_cut_sizes or mesh.displaced_contact is not None]
    both = [_even_wheels(train, mesh) for mesh in meshes]
    if not meshes:
        what = f"'{train.name}' has no tooth form for which cutting errors can be computed"
        why = "cutting errors are computed for triangular teeth and for forms with a known path of contact"
        fix = "declare `tooth_form: {form: involute}` or another such form for the train or for its pairs"
        raise QuestionError(Problem(what, why, fix))
    # a wheel in several pairs is drawn once, with the teeth of its first pair
    even: dict[str, WheelErrors] = {}
    for wheel in chain.from_iterable(both):
        even.setdefault(wheel.name, wheel)
    names, pair_names = tuple(even), [mesh.name for mesh in meshes]
    check_names(settings, names, pair_names)
    wheels = tuple(wheel_errors(train.declaration, each, settings) for each in even.values())
    mirrored = _mirrored(motion, meshes)
    pairs = tuple(
        _pair(train, mesh, pair, names, turned, settings)
        for mesh, pair, turned in zip(meshes, both, mirrored, strict=True)
    )
    composition = motion._with_sources(pair_names)
    if not perfect and all(wheel.true for wheel in wheels) and not any(pair.fitting for pair in pairs):
        what = f"'{train.name}' declares no manufacturing errors"
        why = "without them all trials are identical"
        fix = "declare `cutting: {pitch_deviation: {normal: 2 %}}`, or give --cutting 'pitch_deviation=2 %'"
        raise QuestionError(Problem(what, why, fix))
    speeds = tuple(tally.ratio for tally in motion._statistics())
    reach = tuple(_reach(composition, at, pair_names) for at in range(len(motion.outputs)))
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
        {name: motion._degrees_per_day(name) for name in motion._shown},
    )


def _even_wheels(train: GearTrain, mesh: GearMesh) -> tuple[WheelErrors, WheelErrors]:
    """Return the driver and the driven wheel of a pair with their tooth form, but without cutting errors."""
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
    """Return the number of input turns after which the same teeth meet again in every pair [turn], at most 10^6."""
    counts = {pair.name: pair.count for pair in pairs}
    cycles = [source.cycles / counts.get(source.id, 1) for source in composition.used if source.cycles]
    if not cycles:
        return 1.0
    # least common multiple of the periods, which are the inverses of the cycles per turn
    whole = Fraction(lcm(*(each.denominator for each in cycles)), gcd(*(each.numerator for each in cycles)))
    return float(min(whole, Fraction(_MAXIMUM_SPAN)))


def _reach(composition: ErrorComposition, output: int, names: Sequence[str]) -> tuple[int, ...]:
    alone = ErrorComposition(composition.spread, composition.sources, (composition.outputs[output],))
    # `used` omits pairs without influence on this output
    used = {source.id for source in alone.used}
    return tuple(at for at, name in enumerate(names) if name in used)


def _mirrored(motion: Motion, meshes: Sequence[GearMesh]) -> list[tuple[bool, bool]]:
    """Return two flags for each mesh: True if the teeth of the driver, or of the driven wheel, pass the mesh in
    descending order of their numbers.
    """
    circuits = {circuit.id: circuit for circuit in motion._problem.circuits}
    first: dict[str, int] = {}
    found = []
    for mesh in meshes:
        circuit, flags = circuits[mesh.name], []
        for wheel in (mesh.driver, mesh.driven):
            link = circuit.i if wheel == circuit.wheels[0] else circuit.j
            sense = -1 if motion._problem.relative(link, circuit.carrier) < 0 else 1
            # teeth are numbered in the order in which they pass the mesh of the first pair of the wheel
            flags.append(first.setdefault(wheel, sense) != sense)
        found.append((flags[0], flags[1]))
    return found


def _pair(
    train: GearTrain,
    mesh: GearMesh,
    wheels: tuple[WheelErrors, WheelErrors],
    names: tuple[str, ...],
    mirrored: tuple[bool, bool],
    settings: Sequence[ErrorOverride],
) -> TrialPair:
    contact, counts = mesh.displaced_contact, (wheels[0].z, wheels[1].z)
    depths = mesh.cut_sizes.depths if contact is None else [wheel.depth for wheel in wheels]
    # the wheel with the smaller tooth depth; the driver if both depths are equal
    lesser = wheels[0] if depths[0] <= depths[1] else wheels[1]
    fitting, stroke = pair_errors(train.declaration, mesh, lesser, settings)
    given = mesh.name, names.index(mesh.driver), names.index(mesh.driven), mirrored, counts, min(depths)
    if contact is None:
        even = mesh.transmission.error_moments()[0]
        return TriangularTrialPair(*given, even, mesh.cut_sizes, fitting=fitting, stroke=stroke)
    # the mean of the first-order transmission function itself, so that its model error at another centre distance is
    # not counted as a cutting error
    return DisplacedTrialPair(*given, -mean_lag(contact), contact, fitting=fitting, stroke=stroke)
