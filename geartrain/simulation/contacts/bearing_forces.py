"""Forces on the bearings whose friction increases with their load, as arrays for time steps.

The directions of the forces and their shares on two bearings are those of `BearingLoads`, which treats equal planets as
separate links. In the simulated train, equal planets are one link; the torque of its pair is divided equally among the
pairs of these planets.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.torques.neglected_effects import unknown_forces
from geartrain.kinematics.planet_copies import original
from geartrain.simulation.contacts.contact_model import LoadedBearings

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.bearing_loads import AxisForce, BearingLoads
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.contact_model import Bearing
    from geartrain.simulation.contacts.time_case import PowerInput
    from geartrain.train import Train


@dataclass(frozen=True)
class BearingForces:
    """Forces on the bearings with load-dependent friction in a simulated train."""

    train: Train
    problem: MotionProblem
    drive: PowerInput
    loads: BearingLoads

    @cached_property
    def pairs(self) -> Mapping[str, str]:
        """Pair of the simulated train, in which equal planets are one, by pair of the train with separate planets.

        Redundant pairs, whose shares of the torque are unknown, are omitted.
        """
        problem, wheels = self.problem, self.train.wheels
        rows = {row.label for row in problem.system.equations}
        own = {each.wheels: each.id for each in problem.circuits if each.kind == "gear" and each.id in rows}
        gears = (each for each in self.loads.setting.circuits if each.kind == "gear")
        found = {
            each.id: own.get((original(each.wheels[0], wheels), original(each.wheels[1], wheels))) for each in gears
        }
        return {copy: pair for copy, pair in found.items() if pair is not None}

    @cached_property
    def forces(self) -> Mapping[int, AxisForce]:
        """Forces of gear pairs, keyed by their index in `BearingLoads.forces`."""
        return {at: force for at, force in enumerate(self.loads.forces) if force.name in self.pairs}

    @cached_property
    def names(self) -> set[str]:
        """Names of the pairs of the simulated train that exert forces on loaded bearings."""
        return {self.pairs[force.name] for force in self.forces.values()}

    @cached_property
    def thrust(self) -> Mapping[str, float]:
        """Friction torque of shoulders due to weights along their axes [N m], by link, added for equal planets."""
        found: Counter[str] = Counter()
        for link, torque in zip(self.loads.links, self.loads.thrust[:, 0].tolist(), strict=True):
            found[self._declared(link)] += torque
        return found

    @property
    def notes(self) -> list[str]:
        """Notes on forces that the simulation neglects."""
        known = {self.loads.forces[at].name for at in self.forces}
        loose = [force.name for force in self.loads.forces if force.links[0] is not None and force.name not in known]
        found = [f"{each}: {each.why}" for each in unknown_forces(self.loads, loose=loose)]
        if self.drive.kind != "torque":
            lines = [force.name for force in self.loads.forces if force.links[0] is None]
            found += [f"pull of the line on the bearing of {link}: the drive prescribes a speed" for link in lines]
        return found

    def arrays(
        self, bearings: Sequence[Bearing], sides: Mapping[str, tuple[int, int]], speeds: Floats
    ) -> LoadedBearings:
        """Return the forces on the loaded bearings as arrays for time steps.

        sides    senses (1 or -1) of the forward rotation of the driver and of the driven side about the reference
                 direction, by contact
        speeds   speeds of all links per unit speed of each coordinate, shape (links, n)
        """
        loads, forces = self.loads, [*self.forces.values()]
        contact = {name: at for at, name in enumerate(sides)}
        of_link = {link: (at, radius) for at, each in enumerate(bearings) for link, radius in each.radii.items()}
        links = [loads.links[number] for number, _, _ in loads.supports]
        rows = [row for row, link in enumerate(links) if self._declared(link) in of_link]
        found = [of_link[self._declared(links[row])] for row in rows]
        constant = self.constant[rows]
        ways = loads.ways(links[row] for row in rows)[:, :, 0]
        return LoadedBearings(
            np.array([contact[self.pairs[force.name]] for force in forces], dtype=np.int64),
            np.array([self._row(force, *sides[self.pairs[force.name]]) for force in forces]).reshape(-1, 8),
            np.array([self._turn(force.carrier, speeds) for force in forces]).reshape(-1, speeds.shape[1]),
            loads.ways(force.carrier for force in forces)[:, :, 0],
            np.array([bearing for bearing, _ in found], dtype=np.int64),
            np.ascontiguousarray(loads.shares[np.ix_(rows, [*self.forces])]),
            np.column_stack([constant, ways, [radius for _, radius in found]]),
        )

    def _declared(self, link: str) -> str:
        return original(link, self.train.links)

    def _row(self, force: AxisForce, driver: int, driven: int) -> list[float]:
        # the copies of a planet have equal parts and turn equally about their own axes
        second, setting = force.links[1], self.loads.setting
        equal = Counter(self.pairs.values())[self.pairs[force.name]]
        part = setting.sense(second) * self.problem.signs.get(self._declared(second), 1) / equal
        return [part * driver, part * driven, *force.along, *(force.lean * each for each in force.apart)]

    def _turn(self, carrier: str, speeds: Floats) -> Floats:
        own: Floats = speeds[self.problem.system.links.index(self._declared(carrier))]
        return self.loads.setting.sense(carrier) * own

    @cached_property
    def constant(self) -> Floats:
        """Constant force on each support [N], from weights of links and the cord of a driving weight, shape (supports,
        3).
        """
        found = self.loads.weights[:, :, 0].copy()
        for at, force in enumerate(self.loads.forces):
            if force.links[0] is None and self.drive.kind == "torque":
                found += self.loads.shares[:, at : at + 1] * abs(self.drive.torque) * np.array(force.apart)
        return found
