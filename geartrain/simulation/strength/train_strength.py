"""Strength of all gear pairs and arbors of a train under their torques."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import hypot, inf, pi, sqrt
from typing import TYPE_CHECKING

from geartrain.dynamics.cut_teeth import find_cut_teeth, find_modules
from geartrain.dynamics.torques.torque_results import NeglectedEffect
from geartrain.dynamics.torques.train_torques import solve
from geartrain.dynamics.wheel_teeth import CHORD, WheelTeeth
from geartrain.errors import GearTrainError, Problem, QuestionError, check_numbers
from geartrain.simulation.strength.contact_pressure import WEAR_RANGE
from geartrain.simulation.strength.loaded_pair import PairUnderLoad, WheelUnderLoad
from geartrain.simulation.strength.pin_strength import PinnedDisc
from geartrain.simulation.strength.strength_results import (
    ArborStrength,
    PairStrength,
    PinContact,
    TrainStrength,
    WearRange,
    WheelForce,
)
from geartrain.simulation.strength.tooth_forces import ToothForces
from geartrain.simulation.strength.virtual_spurs import SkewPair, VirtualSpurs
from geartrain.teeth.couplings.pins import PinsInHoles
from geartrain.teeth.cycloidal_disc import DiscMesh
from geartrain.train import Train
from geartrain.train.declaration import face_width, material_named

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_results import PairTorque, Torques
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.train_teeth import TrainTeeth
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_requirement import CutTooth
    from geartrain.train import GearPair, Material, Wheel
    from geartrain.train.manufacturing import ArborSizes


# Julian year, as in the units of declarations
_YEAR = 365.25 * 86400  # s
_PINS = "steel"  # material of the pins of couplings if the train declares none


def solve_strength(
    train: TrainMechanics, state: str | None, service: Service, over: float | None = None
) -> TrainStrength:
    """Return pressures, stresses, safety factors and wear in one state, as described in `GearTrain.strength`."""
    check_numbers(over=over)
    own, train = service.checked(), train.unfolded
    found, loads = solve(train, state), train.load_case(state)
    if not found.verdict or loads is None:
        return TrainStrength(found.state, found.verdict)
    if not train.declaration.has_torque_units(found.state):
        what = "the loads have no unit"
        why = "stresses are computed from torques in N m"
        raise QuestionError(Problem(what, why, "declare the loads with a unit, such as `-0.5 N m`"))
    scale = service.time(train, found.state)
    covered = None if scale is None else scale * _input_speed(train, found.state)
    question = StrengthQuestion(train, loads, found, train.meshes_in(found.state), scale, covered, own)
    if over is None:
        return question.answer()
    from geartrain.dynamics.turn.train_turn import solve as solve_over_turns

    cycle = solve_over_turns(train, state, over)
    if not cycle.parts:
        return TrainStrength(found.state, cycle.verdict)
    # wear still uses the mean torques of the first solution
    maximum = {name: part.maximum for name, part in cycle.parts.items()}
    return replace(question, over=over, maximum=maximum).answer()


@dataclass(frozen=True)
class Service:
    """Service life of a train, and range of its wear coefficients."""

    turns: float | None = None
    """Number of revolutions of the input; None if wear is not requested, or if `years` is given."""
    years: float | None = None
    """Years of operation; None if wear is not requested, or if `turns` is given."""
    wear: tuple[float, float] | None = None
    """Minimum and maximum wear coefficient [1]; None to use `WEAR_RANGE`."""

    def checked(self) -> WearRange:
        """Return the range of wear coefficients.

        Raises `QuestionError` if the coefficients do not form a range, or if `turns` or `years` is not a number.
        """
        check_numbers(turns=self.turns, years=self.years)
        own = WearRange(*(self.wear or WEAR_RANGE))
        if not 0 < own.minimum <= own.maximum < inf:
            what = f"{own.minimum:g} to {own.maximum:g} is not a range of wear coefficients"
            why = "K must be positive, with the minimum first"
            raise QuestionError(Problem(what, why, "for example, give --wear 1e-7 1e-3"))
        return own

    def time(self, train: TrainMechanics, state: str | None) -> float | None:
        """Return the number of revolutions of a link in the service life, divided by its speed; None if no service life
        is given.
        """
        turns, years = self.turns, self.years
        if turns is None and years is None:
            return None
        if turns is not None and years is not None:
            why = "turns and years both define the service life"
            raise QuestionError(Problem("both turns and years are given", why, "omit --turns or --years"))
        for name, value in (("turns", turns), ("years", years)):
            if value is not None and not 0 < value < inf:
                what = f"a service life of {value:g} {name} is out of range"
                raise QuestionError(Problem(what, "it must be positive and finite", "give a finite number above 0"))
        speed, declared = _input_speed(train, state), train.declaration
        if not speed:
            fix = "declare a non-zero speed under `inputs`"
            raise QuestionError(Problem(f"'{declared.name}' does not move", "no input has a speed other than 0", fix))
        if turns is not None:
            return turns / speed
        case, unit = train.kinematics.case(state), declared.unit_speed
        assert years is not None
        # a declared rate takes precedence over the unit of speeds
        if case.rate is not None and case.rate.unit is not None:
            return years * _YEAR * float(case.rate.base) / speed
        if unit is None:
            what = "years cannot be converted to turns"
            why = "the speeds of this train are numbers without a unit"
            raise QuestionError(Problem(what, why, "give --turns, or declare `unit` or `rate`"))
        return years * _YEAR * float(unit)


def _input_speed(train: TrainMechanics, state: str | None) -> float:
    """Return the magnitude of the speed of the crank [the train's unit of speed], or of the first input that turns if
    no turning crank is declared; 0 if no input turns.
    """
    case, crank = train.kinematics.case(state), train.declaration.crank
    speeds = train.kinematics.solution(case).speeds
    if crank is not None and speeds.get(crank):
        return abs(float(speeds[crank]))
    return next((abs(float(speed)) for speed in case.inputs.values() if speed), 0.0)


# ------------------------------------------------------------------------------------------ pairs of a train under load


@dataclass(frozen=True)
class StrengthQuestion:
    """Strength analysis of a train under the loads of one state."""

    train: TrainMechanics
    """Train to be analysed. `setting` is its load case, and `torques` are the torques in this load case."""
    setting: LoadCase
    torques: Torques
    meshes: Sequence[GearMesh]
    """Gear pairs with a tooth form, and with their drivers in this load case."""
    scale: float | None
    """Revolutions of a link during the service life per unit of its relative speed; None if wear is not requested.

    `turns` is the number of revolutions of the input during the service life.
    """
    turns: float | None
    wear: WearRange
    """Minimum and maximum wear coefficient [1]."""
    over: float | None = None
    """Number of revolutions of the input over which the maximum torques are determined for the stresses; None for mean
    torques.
    """
    maximum: Mapping[str, float] = field(default_factory=dict)
    """Maximum torque on the driven side of each pair during the revolutions `over` [N m]; empty for mean torques."""
    neglected: dict[str, NeglectedEffect] = field(default_factory=dict, init=False)

    @property
    def declared(self) -> Train:
        """Declaration of the train."""
        return self.train.declaration

    @cached_property
    def modules(self) -> Mapping[str, float]:
        """Module of each wheel [m], keyed by wheel."""
        return find_modules(self.declared)

    @cached_property
    def teeth(self) -> Mapping[str, WheelTeeth]:
        """Cut teeth by name of the wheel, for all wheels that can be cut so that they mesh with all their mates."""
        return self._cut.wheels

    @cached_property
    def _cut(self) -> TrainTeeth:
        return find_cut_teeth(self.train)

    @cached_property
    def swings(self) -> Mapping[str, float]:
        """Maximum torque of each pair divided by its mean torque in the requested revolutions, 1 or more, by pair."""
        found = {}
        for circuit in self.setting.circuits:
            pair, maximum = self.torques.pairs.get(circuit.id), self.maximum.get(circuit.id)
            if pair is None or maximum is None or circuit.kind != "gear" or pair.driver not in circuit.wheels:
                continue
            # both refer to the torque on the driven wheel
            mean = abs(float(pair.torques[1 - circuit.wheels.index(pair.driver)]))
            found[circuit.id] = max(maximum / mean, 1.0) if mean else 1.0
        return found

    def answer(self) -> TrainStrength:
        """Return the strength of all pairs and arbors."""
        meshes = {mesh.name: mesh for mesh in self.meshes}
        forces = ToothForces(self.setting, self.modules, self.torques.pairs, meshes, self.swings)
        wheel_forces = tuple(forces.find())
        points = {pair.forces[0].pair: pair.contact() for pair in self._skew_pairs(forces, wheel_forces)}
        found: dict[str, PairStrength] = {}
        pins = dict(self._pins(meshes))
        for gear in self.declared.gears:
            mesh = meshes.get(gear.name)
            # discs and crossed wheels are treated separately
            if gear.name in self.neglected or gear.name in points or (mesh and isinstance(mesh, DiscMesh)):
                continue
            pair = self._pair(gear, meshes.get(gear.name), self.torques.pairs[gear.name])
            if pair is not None:
                found[gear.name] = pair.strength()
        arbors = tuple(self._arbors(wheel_forces, found))
        return TrainStrength(
            self.torques.state,
            self.torques.verdict,
            found,
            arbors,
            self.turns,
            self.wear,
            self._all_neglected(),
            wheel_forces,
            points,
            self.over,
            pins,
        )

    def _all_neglected(self) -> tuple[NeglectedEffect, ...]:
        """Return all neglected effects: effects of gear pairs in the order of the declaration, of arbors, and of
        varying torques.
        """
        swinging = [each for each in self.torques.neglected if each.what == "variation within a turn"]
        if self.over is None:
            why = "stresses follow from mean torques; `--peak-turns` uses the maximum over some turns"
            for each in swinging:
                self.neglected[f"swing of {', '.join(each.where)}"] = NeglectedEffect(each.what, each.where, why)
        order = {gear.name: at for at, gear in enumerate(self.declared.gears)}
        return tuple(
            self.neglected[name] for name in sorted(self.neglected, key=lambda name: order.get(name, len(order)))
        )

    def _skew_pairs(self, forces: ToothForces, wheel_forces: Sequence[WheelForce]) -> Iterator[SkewPair]:
        """Yield the gear pairs on crossed axes whose data are complete."""
        for circuit in self.setting.circuits:
            if circuit.kind != "gear" or not forces.is_crossed(circuit):
                continue
            wheels = {name: self.declared.wheels[name][1] for name in circuit.wheels}
            names = [self._material_name(wheel) for wheel in wheels.values()]
            if lacking := [
                *(f"'{name}' has no `helix_angle`" for name, wheel in wheels.items() if wheel.helix_angle is None),
                *self._missing_for_any(wheels, self.torques.pairs[circuit.id]),
            ]:
                self._leave_out(circuit.id, "; ".join(lacking))
                continue
            first, second = ((name, material_named(self.declared, name)) for name in names)
            both = [each for each in wheel_forces if each.pair == circuit.id]
            is_worm = any(wheel.kind == "worm" for wheel in wheels.values())
            wheels_there = forces.crossed_wheels(circuit)
            yield SkewPair(wheels_there, (both[0], both[1]), (first, second), is_worm, forces.involute_of(circuit))

    # -------------------------------------------------------------------------------------------------------- pins

    def _pins(self, meshes: Mapping[str, GearMesh]) -> Iterator[tuple[str, PinContact]]:
        """Yield name and strength of each contact of lobes or holes with pins whose data are complete."""
        for gear in self.declared.gears:
            mesh, torque = meshes.get(gear.name), self.torques.pairs[gear.name]
            if not isinstance(mesh, DiscMesh):
                continue
            wheels = {name: self.declared.wheels[name][1] for name in mesh.gears}
            if lacking := list(self._missing_data(mesh, wheels, torque)):
                self._leave_out(gear.name, "; ".join(lacking))
                continue
            disc, ring = wheels.values()
            moved = float(torque.torques[gear.pair.index(mesh.gears[0])]) * self.swings.get(gear.name, 1.0)
            width = 1e3 * min(self._width(disc), self._width(ring))
            pinned = PinnedDisc(mesh.gears[0], (self._named(disc), self._named(ring)), width, moved)
            yield gear.name, pinned.lobes(gear.name, mesh.transmission.disc, 1e3 * self.modules[mesh.gears[0]])
        for coupling in (each for each in self.declared.pin_couplings if isinstance(each, PinsInHoles)):
            found = self._in_holes(coupling)
            if found is not None:
                yield coupling.name, found

    def _in_holes(self, coupling: PinsInHoles) -> PinContact | None:
        torque = self.torques.pairs[coupling.name]
        if torque.loose or not torque.multiplier:
            return None
        own = self.declared.links[coupling.slot].wheels
        name = next((each for each, wheel in own.items() if self._width(wheel) and self._material_name(wheel)), None)
        if name is None:
            self._leave_out(coupling.name, f"no wheel of '{coupling.slot}' has a `material` and a `face_width`")
            return None
        of_pins = self.declared.material or _PINS
        pins = of_pins, material_named(self.declared, of_pins)
        load = float(torque.torques[0])
        found = PinnedDisc(name, (self._named(own[name]), pins), 1e3 * self._width(own[name]), load).holes(coupling)
        if found is None:
            self._leave_out(coupling.name, "its pin_radius, offset and pin_diameter are not all declared")
        return found

    def _named(self, wheel: Wheel) -> tuple[str, Material]:
        name = self._material_name(wheel)
        return name, material_named(self.declared, name)

    # ------------------------------------------------------------------------------------------------------- pairs

    def _pair(self, gear: GearPair, mesh: GearMesh | None, torque: PairTorque) -> PairUnderLoad | None:
        wheels = {name: self.declared.wheels[name][1] for name in gear.pair}
        lacking = list(self._missing_data(mesh, wheels, torque))
        if lacking or mesh is None:
            self._leave_out(gear.name, "; ".join(lacking))
            return None
        module, width = 1e3 * self.modules[gear.pair[0]], 1e3 * min(self._width(wheel) for wheel in wheels.values())
        spurs = VirtualSpurs.of(mesh, module, width)
        if spurs is not None and spurs.why_not:
            self._leave_out(gear.name, spurs.why_not)
            return None
        gears = [mesh.gears.index(name) + 1 for name in gear.pair]
        teeth = [
            self._teeth_in(mesh, name) if spurs is None else spurs.teeth(gears[at]) for at, name in enumerate(gear.pair)
        ]
        found = [
            WheelUnderLoad(
                name,
                gears[at],
                wheel.count or 0 if spurs is None else spurs.count(gears[at]),
                cut,
                self._material_name(wheel),
                material_named(self.declared, self._material_name(wheel)),
                float(torque.torques[at]) * self.swings.get(gear.name, 1.0),
                self._turns(torque, at),
            )
            for at, ((name, wheel), cut) in enumerate(zip(wheels.items(), teeth, strict=True))
            if cut is not None
        ]
        # bevels are calculated at mid-width
        middle = module if spurs is None else module * spurs.middle.shrunk
        swing = self.swings.get(gear.name, 1.0)
        notes = tuple(
            f"teeth of '{name}' are cut for this pair only, because the teeth of pair '{other}' cannot turn"
            for name in gear.pair
            if (other := self._pair_with_faults(mesh, name))
        )
        return PairUnderLoad(mesh, (found[0], found[1]), middle, width, self.wear, spurs, swing, notes)

    def _teeth_in(self, mesh: GearMesh, name: str) -> CutTooth | WheelTeeth | None:
        """Return the teeth of a wheel, cut for all its pairs, or only for the pair `mesh` if the teeth of another pair
        cannot turn; None if they cannot be cut.
        """
        if (cut := self.teeth.get(name)) is not None or not self._pair_with_faults(mesh, name):
            return cut
        try:
            return mesh.requirement(name, 1.0 if mesh.own_size is None else mesh.own_size.scale, CHORD).cut()
        except GearTrainError:
            return None

    def _pair_with_faults(self, mesh: GearMesh, name: str) -> str | None:
        """Return the name of another pair of wheel `name` whose faults prevent cutting the wheel; None if there is
        none.
        """
        # only a wheel that could not be cut has an unusable outline
        others = (each for each in self.meshes if each is not mesh and name in each.gears and name not in self.teeth)
        return next((other.name for other in others if other.faults), None)

    def _leave_out(self, pair: str, why: str) -> None:
        self.neglected[pair] = NeglectedEffect("strength", (pair,), why)

    def _missing_data(self, mesh: GearMesh | None, wheels: Mapping[str, Wheel], torque: PairTorque) -> Iterator[str]:
        """Yield a phrase for each datum that the strength of a pair with parallel or intersecting axes requires and
        that is missing, and for each unsupported feature.
        """
        if mesh is None:
            yield "it has no tooth form: declare `tooth_form`"
        elif not mesh.has_shape:
            yield "the shape of its teeth is not known: declare a tooth form with shapes"
        elif mesh.path is None and mesh.own_size is None:
            yield "its axes are not parallel, and it has no path of contact"
        elif any(wheel.is_helical for wheel in wheels.values()) and mesh.form != "involute":
            yield "its teeth are helical but not involute, which is not supported"
        elif faults := mesh.faults:
            yield f"its teeth cannot turn: {faults[0].what}"
        yield from self._missing_for_any(wheels, torque)
        if not torque.multiplier and not torque.loose:
            return
        for name, wheel in wheels.items():
            if not self._width(wheel):
                yield f"'{name}' has no `face_width`"
            if mesh is not None and mesh.own_size is not None and self._teeth_in(mesh, name) is None:
                why = "; ".join(str(problem.what) for problem in self._cut.problems.get(name, ()))
                yield f"'{name}' has no planar outline" + (f": {why}" if why else "")

    def _missing_for_any(self, wheels: Mapping[str, Wheel], torque: PairTorque) -> Iterator[str]:
        """Yield a phrase for each missing datum that the strength of any gear pair requires."""
        if not torque.multiplier and not torque.loose:
            yield "it carries no torque"
            return
        if torque.loose:
            yield "its share of the torque of parallel paths is not known: declare `share`"
        for name, wheel in wheels.items():
            if not self._material_name(wheel):
                yield f"'{name}' has no `material`"
            if name not in self.modules:
                yield f"'{name}' has no `module`"

    def _width(self, wheel: Wheel) -> float:
        """Return the width of a wheel's teeth [m]; 0 if it is not known."""
        found = face_width(self.declared, wheel)
        return 0.0 if found is None else found.si

    def _material_name(self, wheel: Wheel) -> str:
        return wheel.material or self.declared.material or ""

    def _turns(self, torque: PairTorque, at: int) -> float | None:
        """Return the number of revolutions of wheel `at`, 0 or 1, relative to the carrier during the service life; None
        if it is not known.
        """
        if self.scale is None:
            return None
        relative = self.setting.relative(torque.links[at], torque.links[2])
        return None if relative is None else abs(float(relative)) * self.scale

    # ------------------------------------------------------------------------------------------------------ arbors

    def _arbors(self, forces: Sequence[WheelForce], pairs: Mapping[str, PairStrength]) -> Iterator[ArborStrength]:
        """Yield the strength of each arbor whose forces are known."""
        # the normal force in single contact exceeds the mean force only for spur teeth
        straight = {each.pair for each in forces if not each.axial}
        steepest = {
            name: max((each.force for each in pair.contact if each.tooth_pairs == 1), default=0.0)
            for name, pair in pairs.items()
            if name in straight
        }
        known = {each.pair for each in forces}
        torques = {name: each for name, each in self.torques.pairs.items() if each.multiplier or each.loose}
        # pairs that transmit torque but whose tooth forces are unknown
        unknown = [gear for gear in self.declared.gears if gear.name in torques and gear.name not in known]
        for link, part in self.declared.links.items():
            if part.arbor is None:
                continue
            missing = next((gear.name for gear in unknown if not set(part.wheels).isdisjoint(gear.pair)), None)
            if missing is not None:
                why = (
                    f"the force of pair '{missing}' is not known: it has no `module`, or one wheel is a contrate wheel"
                )
                self.neglected[f"arbor {link}"] = NeglectedEffect("strength", (f"arbor {link}",), why)
                continue
            own = [each for each in forces if each.wheel in part.wheels]
            yield arbor_strength(link, part.arbor, material_named(self.declared, part.arbor.material), own, steepest)


# ------------------------------------------------------------------------------------------ arbors between two bearings


def arbor_strength(
    link: str, arbor: ArborSizes, material: Material, forces: Sequence[WheelForce], steepest: Mapping[str, float]
) -> ArborStrength:
    """Return the stresses and the strength of an arbor between two bearings, equations (16), (17) and (26) of
    docs/strength.md.

    The stresses are upper bounds for all positions of the arbor's wheels, as if all transverse forces acted in one
    direction.

    steepest   force of one tooth pair in single contact [N], by pair, for pairs in which it is known
    """
    across = sum(max(hypot(each.tangential, each.radial or 0.0), steepest.get(each.pair, 0.0)) for each in forces)
    # the arbor carries the larger sum of axial forces of one sign, its shoulders the resultant
    along = max(sum(max(each.axial, 0.0) for each in forces), sum(max(-each.axial, 0.0) for each in forces))
    thrust = abs(sum(each.axial for each in forces))
    couple = sum(abs(each.axial) * each.radius for each in forces)
    diameter, span = arbor.diameter.si * 1e3, arbor.span.si * 1e3
    pivot = diameter if arbor.pivot is None else arbor.pivot.si * 1e3
    # a pivot without a declared length is as long as its diameter
    length = pivot if arbor.pivot_length is None else arbor.pivot_length.si * 1e3
    # the axial stress adds to the bending stress of a round bar
    bending = 32 * maximum_moment(across, couple, span) / (pi * diameter**3) + 4 * along / (pi * diameter**2)
    torsion = 16 * max((abs(each.torque) * 1e3 for each in forces), default=0.0) / (pi * diameter**3)
    strength = None if material.strength is None else material.strength.si / 1e6
    shoulder = pi / 4 * (diameter**2 - pivot**2)
    return ArborStrength(
        link,
        arbor.material,
        across,
        thrust,
        bending,
        torsion,
        sqrt(bending**2 + 3 * torsion**2),
        # all transverse forces, and the reaction to their moment, on one pivot
        (across + couple / span) / (pivot * length),
        thrust / shoulder if shoulder > 0 else None,
        strength,
    )


def maximum_moment(force: float, couple: float, span: float) -> float:
    """Return the maximum bending moment of a bar between two bearings over all positions of its loads [N mm], equation
    (26) of docs/strength.md.

    A transverse force F at the fraction x of the bearing distance L causes the moment F L x (1 - x) at this position.
    An applied moment M causes at most M max(x, 1 - x).

    >>> maximum_moment(10.0, 0.0, 40.0), maximum_moment(0.0, 50.0, 40.0)
    (100.0, 50.0)
    """
    # the maximum is then at a bearing, otherwise between them
    if couple >= force * span:
        return couple
    return (force * span + couple) ** 2 / (4 * force * span)
