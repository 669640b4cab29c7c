"""Mechanics of a train: declared teeth and pins, driving wheels, and the loads of each state.

Every property is computed at the first access and cached. This object is the input for torques, motion, strength and
dynamic simulation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, final

from geartrain.errors import Problem
from geartrain.kinematics.planet_copies import as_one, has_copies, with_copies
from geartrain.kinematics.train_kinematics import TrainKinematics
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from geartrain.dynamics.gear_meshes import CouplingMesh, PinMesh
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver
    from geartrain.train import StateCase, Train

DrivenWays = Mapping[str, Sequence[tuple["GearMesh", tuple[str, ...]]]]
"""Mesh for each wheel that drives a pair in some state, with the names of these states, by name of the pair."""


@final
@dataclass(frozen=True, eq=False)
class TrainMechanics(Shown):
    """Mechanics of a train that depend on teeth and loads: drivers, transmission functions, and load cases."""

    kinematics: TrainKinematics
    """Kinematics of the same train, without teeth and loads."""
    _settings: dict[str | None, LoadCase | None] = field(default_factory=dict, init=False, repr=False)
    _drivers: dict[tuple[str | None, tuple[str, ...]], Mapping[str, MeshDriver]] = field(
        default_factory=dict, init=False, repr=False
    )

    def _summary(self) -> str:
        return self.declaration.name

    @property
    def declaration(self) -> Train:
        """Declaration of the train."""
        return self.kinematics.declaration

    @property
    def tree(self) -> Tree:
        """Spanning tree of the turning pairs, rooted at the frame."""
        return self.kinematics.tree

    @property
    def circuits(self) -> tuple[Circuit, ...]:
        """Fundamental circuits, one for each gear pair and coupling."""
        return self.kinematics.circuits

    @property
    def signs(self) -> Mapping[str, int]:
        """Sign of the axis of each link, keyed by link: -1 if the axis points against the reference direction of the
        axes parallel to it, otherwise 1.
        """
        return self.kinematics.signs

    # ------------------------------------------------------------------------------------------------- equal planets

    @property
    def unfolded(self) -> TrainMechanics:
        """Train in which equal planets are separate links, which share loads; self if no link has copies."""
        # not cached if it is the train itself, because that would be a reference cycle
        return self._with_copies if has_copies(self.declaration) else self

    @cached_property
    def _with_copies(self) -> TrainMechanics:
        return TrainMechanics(TrainKinematics(with_copies(self.declaration, self.tree)))

    @property
    def planets_as_one(self) -> TrainMechanics:
        """Train in which one planet has the inertia and stiffness of all its copies; self if no link has copies."""
        return self._as_one if has_copies(self.declaration) else self

    @cached_property
    def _as_one(self) -> TrainMechanics:
        return TrainMechanics(TrainKinematics(as_one(self.declaration)))

    # --------------------------------------------------------------------------------------------------------- teeth

    @cached_property
    def undriven(self) -> Mapping[str, GearMesh]:
        """Gear pairs that declare a tooth form, by name of the pair. Their first wheel is the driver, and their teeth
        are computed on first access.
        """
        if not any(map(self.declaration.form_of, self.declaration.gears)):
            return {}  # avoids importing tooth forms for a train without any
        from geartrain.dynamics.gear_meshes import find_meshes
        from geartrain.kinematics.circuits.fundamental import shaft_angle

        # the mapping must not refer to the train, because a reference cycle delays the release of memory
        train, tree, circuits = self.declaration, self.tree, {circuit.id: circuit for circuit in self.circuits}
        return find_meshes(train, lambda gear: shaft_angle(train, tree, circuits[gear.name]))

    @cached_property
    def teeth(self) -> tuple[GearMesh, ...]:
        """All gear pairs that declare a tooth form, with computed tooth geometry and the first wheel as driver."""
        if not self.undriven:
            return ()
        from geartrain.dynamics.gear_meshes import all_meshes

        return all_meshes(self.undriven)

    @cached_property
    def meshes(self) -> tuple[GearMesh, ...]:
        """Gear pairs with a declared tooth form. The driver of each pair is its driver in the first state in which the
        driver is determined.
        """
        ways = self.driven_ways.values()
        return tuple(next((way for way, _ in each if way.who.known), each[0][0]) for each in ways)

    @cached_property
    def driven_ways(self) -> DrivenWays:
        """Pairs with a declared tooth form, by name: for each wheel that drives in some state, the mesh and the names
        of these states.

        If the driver of a pair is undetermined, both wheels are included.
        """
        found: dict[str, dict[str, tuple[GearMesh, tuple[str, ...]]]] = {mesh.name: {} for mesh in self.teeth}
        for state in self.kinematics.usable_states:
            own = () if state is None else (state,)
            for way in (way for mesh in self.meshes_in(state) for way in mesh.ways):
                known, states = found[way.name].get(way.driver, (way, ()))
                # a known driver replaces the same driver where it was assumed
                found[way.name][way.driver] = (known if known.who.known else way), states + own
        return {name: list(ways.values()) for name, ways in found.items()}

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """Problems that prevent declared teeth from turning in a driving direction that occurs in a state."""
        if not self.teeth:
            return ()
        from geartrain.teeth.gear_mesh import find_faults

        return tuple(fault for ways in self.driven_ways.values() for fault in find_faults([way for way, _ in ways]))

    def meshes_in(self, state: str | None = None) -> tuple[GearMesh, ...]:
        """Return the gear pairs with a declared tooth form, each with its driver in one state.

        state   name of a declared state. None is allowed only for a train without states.
        """
        if not self.teeth:
            return ()
        drivers = self.drivers(state)
        driven = tuple(mesh.driven_by(drivers[mesh.name]) for mesh in self.teeth)
        # only friction that depends on speed needs the load case
        if all(mesh.wheels.friction_law is None for mesh in driven):
            return driven
        from geartrain.dynamics.pair_speeds import at_own_speeds

        return at_own_speeds(driven, self.load_case(state))

    @cached_property
    def couplings(self) -> tuple[CouplingMesh, ...]:
        """Couplings with variable ratio and declared dimensions, each with its transmission function."""
        if not self.declaration.couplings:
            return ()
        from geartrain.dynamics.gear_meshes import find_couplings
        from geartrain.kinematics.circuits import couplings_on_axes

        return find_couplings(self.declaration, couplings_on_axes(self.declaration, self.tree))

    @property
    def pins(self) -> tuple[PinMesh, ...]:
        """Couplings in `couplings` that consist of a pin and a slot."""
        if not self.couplings:
            return ()
        from geartrain.dynamics.gear_meshes import PinMesh

        return tuple(each for each in self.couplings if isinstance(each, PinMesh))

    # ------------------------------------------------------------------------------------------------ loads and motion

    def drivers(self, state: str | None = None, without: Sequence[str] = ()) -> Mapping[str, MeshDriver]:
        """Return the driver of each pair and coupling in one state.

        The driver is declared, or follows from the direction of power flow relative to the pair's carrier.

        state     name of a declared state. None is allowed only for a train without states.
        without   names of pairs that are omitted
        """
        from geartrain.dynamics.torques.drivers import find_drivers

        state = self.kinematics.case(state).state
        key = state, tuple(without)
        if key not in self._drivers:
            circuits = self.kinematics.circuits_without(without)
            self._drivers[key] = find_drivers(self.declaration, circuits, self.load_case(state))
        return self._drivers[key]

    def load_case(self, state: str | None = None) -> LoadCase | None:
        """Return the load case of one state with its speeds and teeth; None if the verdict on the speeds is neither
        determined nor free.

        state   name of a declared state. None is allowed only for a train without states.
        """
        case = self.kinematics.case(state)
        if case.state not in self._settings:
            self._settings[case.state] = self.make_load_case(case)
        return self._settings[case.state]

    def make_load_case(self, case: StateCase) -> LoadCase | None:
        """Return the load case with the prescribed speeds, brakes, locks and loads of `case`, which may differ from the
        declared ones; None if the verdict on the speeds is neither determined nor free.

        case   state case in which locks are given joint by joint, as in `TrainKinematics.cases`
        """
        from geartrain.dynamics.torques.load_case import LoadCase, speed_forms

        own = self.kinematics
        solution = own.solution(case)
        # torques may be determined although speeds are free: docs/torques.md, (14) to (16)
        if solution.verdict.kind not in ("determined", "free"):
            return None
        forms = {}
        if solution.verdict.kind == "free":
            system = own.case_equations(case)
            forms = speed_forms(system.links, system.equations)
        train, meshes, couplings = self.declaration, self.undriven, self.couplings
        return LoadCase(train, own.tree, own.circuits, own.signs, case, solution.speeds, meshes, couplings, forms)
