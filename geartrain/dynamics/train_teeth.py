"""Teeth of every wheel of a train, which are cut to suit all its mates.

Drawing, simulation and manufacture use the same teeth. A wheel has the teeth that its pairs declare, or standard teeth
if they declare none. If it belongs to several pairs, it has the deepest roots that these pairs require, and fillets
that clear all mates. If its pairs require different teeth, the wheel has no teeth.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from geartrain.dynamics.gear_meshes import find_sizes
from geartrain.dynamics.wheel_teeth import CHORD, WheelTeeth
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.willis_system import relative_speed
from geartrain.numerics.containers import FrozenDict
from geartrain.teeth.conjugate.conjugate_form import conjugate_pair_of
from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.outlines.fixed_teeth import ESCAPE_WORDS, ESCAPEMENT, WAVE, WAVE_WORDS, escape_tooth, wave_tooth
from geartrain.teeth.outlines.tooth_requirement import ToothRequirement
from geartrain.teeth.outlines.wheel_requirement import PairRequirement, disagreement
from geartrain.teeth.standard_teeth import (
    BACKLASH,
    UndeclaredWheel,
    check_size,
    lone_mate,
    standard_form,
    standard_teeth,
)

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.meshing_wheels import DeclaredPair
    from geartrain.teeth.standard_teeth import StandardTeeth
    from geartrain.train import GearPair, Wheel

STANDARD = "standard"


class ToothingPlace(Protocol):
    """Protocol of an object that gives the module [mm] and the pitch cone angle [rad] of a wheel."""

    @property
    def module(self) -> float:
        """Pitch diameter divided by tooth count [mm]."""

    @property
    def cone(self) -> float:
        """Half angle of the pitch cone [rad]; 0 for a cylindrical wheel."""


@dataclass(frozen=True, slots=True)
class PairBacklash:
    """Backlash of a pair of cut wheels: along the pitch line [mm], and as an angle of rotation of each wheel [rad]."""

    pair: str
    wheels: tuple[str, str]
    length: float
    angles: tuple[float, float]
    contact_ratio: float | None = None
    """Contact ratio of conjugate teeth at their design centre distance; None for other teeth."""
    more_contact: str = ""
    """Advice on how to increase the contact ratio; empty if there is none."""


@dataclass(frozen=True, slots=True)
class TrainTeeth:
    """Teeth of all wheels of a train, or the reasons why wheels have no teeth."""

    wheels: Mapping[str, WheelTeeth]
    """Teeth of each wheel that has teeth, by name. `problems` contains the reasons why other wheels have no teeth."""
    problems: Mapping[str, tuple[Problem, ...]]
    approximations: Mapping[str, WheelTeeth]
    """Teeth, cut to suit its first pair, of each wheel whose pairs require different teeth, by name."""
    flat: frozenset[str]
    """Names of the wheels whose teeth are straight and in one plane."""
    backlashes: tuple[PairBacklash, ...]
    """Backlash of each pair in which both wheels have teeth."""


def find_train_teeth(
    train: TrainMechanics,
    places: Mapping[str, ToothingPlace],
    backlash: float | None = None,
    apart: Mapping[str, float] = FrozenDict(),
) -> TrainTeeth:
    """Return the teeth of all wheels whose teeth are straight and in one plane.

    backlash    backlash of pairs without a declared form [mm]; by default 1/20 of the module
    apart       centre distance minus its design value [mm], by pair, for displaced wheels
    """
    return _Toothing(train, places, backlash, apart).all()


def find_disagreements(train: TrainMechanics, places: Mapping[str, ToothingPlace]) -> Mapping[str, Problem]:
    """Return a problem for each wheel whose pairs require different declared tooth forms, by wheel."""
    toothing, found = _Toothing(train, places), {}
    for name in (each for each in toothing.pairs if each in toothing.shaped):
        # faulty teeth, and teeth that are not plane, have no disagreement
        with suppress(GearTrainError):
            if (problem := disagreement(toothing.requirements(name))) is not None:
                found[name] = problem
    return found


class _Toothing:
    def __init__(
        self,
        train: TrainMechanics,
        places: Mapping[str, ToothingPlace],
        backlash: float | None = None,
        apart: Mapping[str, float] = FrozenDict(),
    ) -> None:
        self.train, self.declared, self.places = train, train.declaration, places
        self.backlash, self.apart = backlash, apart
        self.unbuilt: tuple[Problem, ...] = ()
        try:
            meshes = train.meshes
        except GearTrainError as error:
            # other wheels are still cut; these problems are reported for the wheels concerned
            meshes, self.unbuilt = (), error.problems
        self.meshes = {mesh.name: mesh for mesh in meshes if mesh.has_shape}
        self.sizes = find_sizes(meshes)
        self.pairs: dict[str, list[GearPair]] = {name: [] for name in self.declared.wheels}
        for gear in self.declared.gears:
            for wheel in gear.pair:
                self.pairs[wheel].append(gear)
        # pairs of a flexible wheel and a ring gear
        self.waves = {
            gear.name
            for gear in self.declared.gears
            if self._mesh(gear) is None
            and {self._wheel(name).internal for name in gear.pair} == {False, True}
            and any(self._wheel(name).flexible for name in gear.pair)
        }
        self.shaped = {name for name in self.pairs if any(self._mesh(gear) is not None for gear in self.pairs[name])}

    def _wheel(self, name: str) -> Wheel:
        return self.declared.wheels[name][1]

    def _mesh(self, gear: GearPair) -> GearMesh | None:
        return self.meshes.get(gear.name)

    def _wave_pairs(self, name: str) -> list[GearPair]:
        return [gear for gear in self.pairs[name] if gear.name in self.waves]

    def _is_flat(self, name: str) -> bool:
        kinds = {self._wheel(mate).kind for gear in self.pairs[name] for mate in gear.pair}
        return self._wheel(name).kind == "spur" and not self.places[name].cone and "worm" not in kinds

    # -------------------------------------------------------------------------------------------- standard teeth

    @cached_property
    def standard(self) -> dict[str, StandardTeeth]:
        """Standard teeth of each wheel whose pairs declare no tooth form, by wheel."""
        free = (name for name in self.pairs if name not in self.shaped and not self._wave_pairs(name))
        gears = {name: self._gear(name) for name in free if self._is_flat(name)}
        pairs = [gear.pair for gear in self.declared.gears if set(gear.pair) <= set(gears)]
        return standard_teeth(gears, pairs)

    def _gear(self, name: str) -> UndeclaredWheel:
        wheel = self._wheel(name)
        return UndeclaredWheel(wheel.count or 1, wheel.internal)

    def _standard_requested(self, name: str) -> Iterator[PairRequirement]:
        own, teeth = self._gear(name), self.standard[name]
        mates = [(gear, self._mate(gear, name)) for gear in self.pairs[name]]
        if shaped := next(((gear, mate) for gear, mate in mates if mate in self.shaped and self._is_flat(mate)), None):
            raise _half_declared(name, *shaped, next(g.name for g in self.pairs[shaped[1]] if self._mesh(g)))
        flat = [(gear.name, self._gear(mate), self.standard[mate]) for gear, mate in mates if mate in self.standard]
        for name_of_pair, mate, its in flat or [("", lone_mate(own), teeth)]:
            form, wheels, at = self._standard_pair((own, teeth), (mate, its), name)
            pair = conjugate_pair_of(form, wheels)  # raises an error for impossible wheels, before sizes are computed
            required = ToothRequirement(pair, at, CHORD, max(form.bottom_clearance(wheels, at), 0.0))
            yield PairRequirement(name_of_pair, STANDARD, teeth.words, required)

    def _standard_pair(
        self, first: tuple[UndeclaredWheel, StandardTeeth], second: tuple[UndeclaredWheel, StandardTeeth], name: str
    ) -> tuple[Involute, WheelPair, int]:
        """Return the standard tooth form of two wheels, the pair that they form (a ring gear is its second wheel), and
        the position of `first` in this pair, 1 or 2.
        """
        (one, teeth), (other, its) = (second, first) if first[0].internal else (first, second)
        form = standard_form(teeth, its, self._standard_backlash(name))
        return form, WheelPair(one.z, other.z, other.internal), 2 if first[0].internal else 1

    def _standard_backlash(self, name: str) -> float:
        return BACKLASH if self.backlash is None else self.backlash / self.places[name].module

    @staticmethod
    def _mate(gear: DeclaredPair, name: str) -> str:
        first, second = gear.pair
        return second if first == name else first

    # ----------------------------------------------------------------------------------------------------------- wheels

    def all(self) -> TrainTeeth:
        found: dict[str, WheelTeeth] = {}
        problems: dict[str, tuple[Problem, ...]] = {}
        approximations: dict[str, WheelTeeth] = {}
        for name in self.pairs:
            try:
                requested = self.requirements(name)
                try:
                    if problem := disagreement(requested):
                        raise GearTrainError(problem)
                    found[name] = self._cut(name, requested)
                except GearTrainError as error:
                    problems[name] = error.problems
                    # pictures show such a wheel with the teeth of its first pair
                    approximations[name] = self._cut(name, requested[:1])
            except GearTrainError as error:
                problems.setdefault(name, error.problems)
        flat = frozenset(name for name in self.pairs if self._is_flat(name))
        return TrainTeeth(found, problems, approximations, flat, tuple(self._backlashes(found)))

    def requirements(self, name: str) -> list[PairRequirement]:
        """Return the teeth of a wheel that each of its pairs requires. Raise `GearTrainError` if the teeth cannot be
        cut, or if they have no plane outline.
        """
        wheel, place = self._wheel(name), self.places[name]
        if not self._is_flat(name):
            kind = wheel.kind if wheel.kind != "spur" else "bevel" if place.cone else "worm wheel"
            why = "only straight teeth in one plane have an outline"
            fix = "export STL or GLB, which approximate its teeth"
            raise GearTrainError(Problem(f"a {kind} has no plane outline", why, fix))
        for each in (name, *(self._mate(gear, name) for gear in self.pairs[name])):
            check_size(self._wheel(each).count or 1)
        # `unbuilt` does not say which pairs are faulty, so all wheels with a form are refused
        if self.unbuilt and any(self.declared.form_of(gear) for gear in self.pairs[name]):
            raise GearTrainError(self.unbuilt)
        if not self.pairs[name] and (turning := self._escapement_sense(name)):
            return [PairRequirement("", ESCAPEMENT, ESCAPE_WORDS, escape_tooth(wheel.count or 1, turning))]
        if wave_pairs := self._wave_pairs(name):
            tooth = wave_tooth(wheel.count or 1, self._standard_backlash(name), wheel.internal)
            return [PairRequirement(gear.name, WAVE, WAVE_WORDS, tooth) for gear in wave_pairs]
        if name not in self.shaped:
            return list(self._standard_requested(name))
        meshes = [mesh for gear in self.pairs[name] if (mesh := self._mesh(gear)) is not None]
        # mates that are not spur wheels count only if there is no spur mate
        flat = [mesh for mesh in meshes if self._wheel(self._mate(mesh.gear, name)).kind == "spur"]
        scales = {mesh.name: self.sizes[mesh.name].scale if mesh.name in self.sizes else 1.0 for mesh in meshes}
        return [
            PairRequirement(
                mesh.name, mesh.form, mesh.tooth_form.words, mesh.requirement(name, scales[mesh.name], CHORD)
            )
            for mesh in flat or meshes
        ]

    def _escapement_sense(self, name: str) -> int:
        """Return the sense, 1 or -1, in which an escapement lets its escape wheel turn; 0 for other wheels."""
        link, wheel = self.declared.wheels[name]
        if self.declared.escapement is None or not self.declared.escapement.has_wheel(link, wheel.count):
            return 0
        try:
            speeds = self.train.kinematics.solve(self.declared.state_or_first(None)).speeds
            speed = relative_speed(
                link, self.train.tree.reference(link, self.train.tree.top[link]), speeds.get, self.train.signs
            )
        except GearTrainError:
            speed = None
        return -1 if speed is not None and speed < 0 else 1

    def _cut(self, name: str, requested: Sequence[PairRequirement]) -> WheelTeeth:
        first, *others = requested
        cut = first.requirement.cut([each.requirement for each in others])
        z = self._wheel(name).count or 1
        return WheelTeeth(name, z, cut.kind, first.form, first.words, cut.tip, cut.root, cut.tooth, cut.pins)

    def _backlashes(self, found: Mapping[str, WheelTeeth]) -> Iterator[PairBacklash]:
        """Yield the backlash of each pair of which both wheels have teeth."""
        for gear in self.declared.gears:
            if not set(gear.pair) <= set(found):
                continue
            arc = self._backlash(gear)
            if arc is not None:
                radii = [(self._wheel(name).count or 0) / 2 for name in gear.pair]
                angles = arc / radii[0], arc / radii[1]
                size = self.places[gear.pair[0]].module
                yield PairBacklash(gear.name, gear.pair, arc * size, angles, *self._contact(gear))

    def _contact(self, gear: GearPair) -> tuple[float | None, str]:
        """Return the contact ratio of a pair, and advice on how to increase it. The ratio is None for teeth that are
        not conjugate, and for teeth at another centre distance than designed.
        """
        mesh = self._mesh(gear)
        if gear.name in self.waves or gear.name in self.apart:
            return None, ""
        if isinstance(mesh, ConjugateMesh):
            return mesh.path.contact_ratio, mesh.tooth_form.more_contact
        if mesh is not None:
            return None, ""
        form, wheels = self._standard_form(gear)
        return conjugate_pair_of(form, wheels).path.contact_ratio, form.more_contact

    def _standard_form(self, gear: GearPair) -> tuple[Involute, WheelPair]:
        first, second = ((self._gear(name), self.standard[name]) for name in gear.pair)
        return self._standard_pair(first, second, gear.pair[0])[:2]

    def _backlash(self, gear: GearPair) -> float | None:
        """Return the backlash of a gear pair along its pitch circles [module]; None if the wheels are displaced and
        their transmission function depends on the centre distance.
        """
        mesh, displaced = self._mesh(gear), gear.name in self.apart and gear.name not in self.waves
        if not displaced:
            if mesh is None:
                return self._standard_backlash(gear.pair[0])
            return mesh.verdict.backlash * (self._wheel(mesh.driven).count or 0) / 2
        gap = self.apart[gear.name] / self.places[gear.pair[0]].module
        if mesh is not None:
            return mesh.backlash_apart(gap)
        form, wheels = self._standard_form(gear)
        return form.backlash_apart(wheels, gap)


def _half_declared(name: str, gear: GearPair, mate: str, other: str) -> GearTrainError:
    return GearTrainError(
        Problem(
            f"the teeth that mesh with '{mate}' are not declared",
            f"pair '{gear.name}' declares no tooth form, and '{mate}' takes its teeth from pair '{other}'",
            f"declare a `tooth_form` for pair '{gear.name}' too",
        )
    )
