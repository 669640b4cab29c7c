"""Transmission errors of the pairs of a moving train: driver, phase of the teeth, and propagation of the errors.

The equations are in sections 1 and 3 of docs/motion.md: the driver's angle S in its mean sense of rotation (3), and the
phase of the teeth at position 0.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isfinite, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import PairErrorSource
from geartrain.dynamics.motion.error_propagation import ErrorPath, find_error_propagation
from geartrain.dynamics.motion.motion_problem import MotionProblem
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.exact import log10

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_propagation import ErrorPropagation
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import TransmissionFunction


_FASTEST = 2**90  # periods per turn: the product of a position and the ratio has a precision of 106 bits
_HALVINGS = 54  # bisections of four periods, to rounding


@dataclass(frozen=True)
class PairErrors:
    """Pairs of a train with their transmission functions, as sources of errors of the links."""

    train: MotionProblem
    links: Collection[str]
    """Links whose errors are requested. The teeth of pairs that do not affect these links are not built."""

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Index of each link's column in the Willis system, by name of the link."""
        return {link: at for at, link in enumerate(self.train.system.links)}

    @cached_property
    def spread(self) -> ErrorPropagation:
        """Errors of the requested links as linear combinations of the errors of pairs."""
        held = {row.label for row in self.train.system.equations}
        circuits = {circuit.id: circuit for circuit in self.train.circuits if circuit.id in held}
        ends = {
            name: [self.index[link] for link in (each.i, each.j, *each.subtracted)] for name, each in circuits.items()
        }
        wanted = [self.index[link] for link in self.links]
        found = find_error_propagation(self.train.system, ends, lambda name: self._joint(circuits[name]), wanted)
        if found is None:
            raise GearTrainError(
                Problem(
                    "the error propagation equations of this train are singular",
                    "some gear pairs are redundant, in a loop that involves more than one carrier",
                    "omit a redundant pair with --without (`geartrain check` names the link that these pairs share)",
                )
            )
        return found

    @cached_property
    def _circuits(self) -> Mapping[str, Circuit]:
        return {circuit.id: circuit for circuit in self.train.circuits}

    def _joint(self, circuit: Circuit) -> ErrorPath:
        driven = self.driven_side(circuit)
        ends = [self.index[link] for link in (circuit.i, circuit.j)]
        bases = [self.index[link] for link in circuit.subtracted]
        coefficient = (circuit.a, circuit.b)[driven]
        return ErrorPath(ends[1 - driven], ends[driven], bases[1 - driven], coefficient, bases[driven])

    def driven_side(self, circuit: Circuit) -> int:
        """Return the side of a circuit whose angle is given by its transmission function: 0 for the first link, 1 for
        the second link.

        This is the driven wheel of a gear pair. In a coupling, it is always the first link, such as a slot, even if
        this link drives, because couplings have no backlash.
        """
        return int(circuit.kind == "gear" and self.train.drivers[circuit.id].wheel == circuit.wheels[0])

    @cached_property
    def _meshes(self) -> list[GearMesh]:
        reached = self.spread.reached
        names = [name for at, name in enumerate(self.spread.pairs) if at in reached and name in self.train.meshes]
        return [self.train.meshes[name] for name in names]

    def backlash(self, way: int) -> Floats:
        """Return the constant angle that the backlash of teeth with constant ratio adds to each link [rad].

        It is 0 while the input turns in the declared sense (`way` = 1).
        """
        transmissions = {} if way > 0 else {mesh.name: mesh.coast for mesh in self._meshes if mesh.rigid}
        ahead = {name: transmission.error_moments()[0] for name, transmission in transmissions.items()}
        circuits = self._circuits
        deltas = [ahead[name] * self.sense(circuits[name]) if name in ahead else 0.0 for name in self.spread.pairs]
        return np.asarray(self.spread.errors(np.array(deltas)[:, None])[:, 0])

    def sense(self, circuit: Circuit) -> int:
        """Return the sense of the driven wheel's mean motion relative to its carrier, 1 or -1."""
        driver = (circuit.i, circuit.j)[1 - self.driven_side(circuit)]
        forward = -1 if self.train.relative(driver, circuit.carrier) < 0 else 1
        return forward if circuit.a * circuit.b < 0 else -forward

    def sources(self, way: int, besides: Collection[str] = ()) -> Iterator[PairErrorSource]:
        """Yield the pairs with variable error and the pins as error sources, for one direction of the input (`way`, 1
        or -1).

        besides   names of pairs with constant ratio to be included as well
        """
        meshes = [mesh for mesh in self._meshes if not mesh.rigid or mesh.name in besides]
        transmissions: dict[str, TransmissionFunction] = {mesh.name: mesh.transmission for mesh in meshes}
        transmissions |= {joint.coupling.name: joint.transmission for joint in self.train.couplings}
        circuits = self._circuits
        for at, name in enumerate(self.spread.pairs):
            if name in transmissions:
                transmission = transmissions[name] if way > 0 else transmissions[name].reversed_motion()
                yield self._source(at, circuits[name], transmissions[name], transmission)

    def _source(
        self, at: int, circuit: Circuit, ahead: TransmissionFunction, transmission: TransmissionFunction
    ) -> PairErrorSource:
        driven = self.driven_side(circuit)
        ends, signs, carrier = (circuit.i, circuit.j), self.train.signs, circuit.subtracted[1 - driven]
        driver = self.train.relative(ends[1 - driven], carrier)
        forward = -1 if driver < 0 else 1
        sense = self.sense(circuit)
        if circuit.kind != "gear" and self.train.way * forward < 0:
            transmission = transmission.mirrored()
        # a follower with the mean ratio 0 has no sense: its error counts in the driver's sense
        if not circuit.b:
            sense = forward
        # a wheel's coefficient in the Willis equation is its tooth count
        periods = Fraction(abs((circuit.b, circuit.a)[driven]), transmission.pitch_count)
        if circuit.kind != "gear":
            periods = self.train.periods[circuit.id]
        senses = signs.get(ends[1 - driven], 1), signs.get(carrier, 1)
        angles = [self.train.angles.get(link, 0.0) for link in (ends[1 - driven], carrier)]
        # phases count in the forward sense, angles about declared axes
        turned = self.train.way * forward * (senses[0] * angles[0] - senses[1] * angles[1])
        phase = self._phase(circuit, ahead, driven) + turned
        cycles = abs(driver) * periods
        if cycles > _FASTEST:
            raise GearTrainError(
                Problem(
                    f"10^{log10(cycles):.0f} teeth of pair '{circuit.id}' mesh per turn of '{self.train.driving_link}'",
                    "float64 positions of the input are too coarse to resolve these teeth",
                    "choose an input nearer to this pair, or declare it without `tooth_form` (ideal teeth)",
                )
            )
        return PairErrorSource(circuit.id, transmission, at, *senses, cycles, phase, forward, sense)

    def _phase(self, circuit: Circuit, transmission: TransmissionFunction, driven: int) -> float:
        """Return the driver angle that corresponds to the tooth phase of a pair [rad]; 0 for a coupling. If a planet
        meshes with two wheels, the angle of the second pair follows from the first pair.
        """
        placed = None if circuit.id in self.train.phases else self.train.placed_by(circuit.id)
        if placed is not None:
            before, opposite = placed
            if (mesh := self.train.meshes.get(before)) is not None:
                first = self._circuits[before]
                start = self._phase(first, mesh.transmission, self.driven_side(first))
                teeth = round(2 * pi / transmission.pitch)
                pitches = (
                    float(mesh.transmission.angle(start)) / transmission.pitch
                    + mesh.tooth_phase
                    - (teeth / 2 if opposite else 0)
                )
                return (pitches % transmission.pitch_count) * transmission.pitch
        phase = self.train.phases.get(circuit.id, 0.0)
        if circuit.kind != "gear":
            return 0.0
        if driven == 1:
            return phase * transmission.pitch
        phase -= self.train.meshes[circuit.id].tooth_phase
        ratio, near = float(transmission.ratio), phase * transmission.pitch
        wanted = phase * ratio * transmission.pitch
        # the error changes by less than a driven period, because the driven side never turns back
        error = float(transmission.error(near))
        near -= error / ratio if isfinite(error) else 0.0
        low, high = near - 2 * transmission.period, near + 2 * transmission.period
        # bisection: the driven angle increases with the driver's, and kinks would disturb faster methods
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if float(transmission.angle(middle)) < wanted else (low, middle)
        return (low + high) / 2
