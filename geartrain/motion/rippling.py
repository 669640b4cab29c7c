"""From a solved train to its composition: which meshes ripple, who drives, and how their errors spread."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.circuits import Circuit
from geartrain.errors import GearTrainError, Problem
from geartrain.motion.composition import Composition, Source

if TYPE_CHECKING:
    from geartrain.meshes import Mesh, PinJoint
    from geartrain.motion.composition import Floats
    from geartrain.system import System

_ROUNDING = 1e-15  # of the greatest response: what is less is none


@dataclass(frozen=True)
class Moving:
    """What motion needs to know of a train in one case.

    system      the labelled rows, redundant circuits left out; `redundant` names those
    speeds      exact mean speeds; `lead` is the input whose angle is given
    """

    system: System
    redundant: frozenset[str]
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    speeds: Mapping[str, Fraction]
    lead: str
    teeth: Sequence[Mesh]
    pins: Sequence[PinJoint]

    def mean(self, link: str) -> float:
        """Mean speed of a link over the lead's."""
        return float(self.speeds[link] / self.speeds[self.lead])


@dataclass(frozen=True)
class Ripple:
    """What real teeth and pins do to one output over the positions asked for.

    error   transmission error (rad): angle less its mean motion; `speed` over its mean, both by position
    """

    name: str
    mean: float
    error: Floats
    speed: Floats

    @property
    def peak_to_peak(self) -> float:
        """Greatest less least error (rad)."""
        return float(np.ptp(self.error))

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean (rad)."""
        return float(np.std(self.error))

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        relative = self.speed / self.mean if self.mean else self.speed
        return {
            "transmission_error": {"peak_to_peak": self.peak_to_peak, "rms": self.rms},
            "speed": {"min": float(relative.min()), "max": float(relative.max()), "mean": self.mean},
        }


class Motion:
    """A train's motion as a function of the angle of its input."""

    def __init__(self, train: Moving, outputs: Mapping[str, tuple[str, str]]) -> None:
        self.train, self.outputs = train, outputs
        self._links = {link: at for at, link in enumerate(train.system.links)}

    @cached_property
    def _sources(self) -> list[tuple[Source, Circuit, int]]:
        """Each rippling mesh with its circuit and the side that is driven, 0 for i, 1 for j."""
        teeth = {mesh.name: mesh for mesh in self.train.teeth}
        pins = {joint.coupling.name: joint for joint in self.train.pins}
        found = []
        for circuit in self.train.circuits:
            if circuit.id in teeth:
                mesh = teeth[circuit.id]
                driven = 1 if mesh.driver == circuit.wheels[0] else 0
                found.append((self._source(circuit, driven, mesh.law), circuit, driven))
            elif circuit.id in pins:
                found.append((self._source(circuit, 0, pins[circuit.id].law), circuit, 0))
        for source, _, _ in found:
            if source.id in self.train.redundant:
                raise GearTrainError(
                    Problem(
                        f"pair '{source.id}' closes a loop that is redundant",
                        "its real teeth contradict those of the rest of the loop, pitch by pitch",
                        "give one pair of the loop ideal teeth",
                    )
                )
        return found

    def _source(self, circuit: Circuit, driven: int, law: Any) -> Source:
        ends = (circuit.i, circuit.j)
        driver, follower = (self._relative(ends[1 - driven], circuit), self._relative(ends[driven], circuit))
        sense = 1 if follower >= 0 else -1
        if circuit.kind != "gear":  # a pin's error has the sense of the slot's own angle
            sense = -1 if driver < 0 else 1
        return Source(circuit.id, law, driver, sense)

    def _relative(self, link: str, circuit: Circuit) -> float:
        signs, carrier = self.train.signs, circuit.carrier
        return signs.get(link, 1) * self.train.mean(link) - signs.get(carrier, 1) * self.train.mean(carrier)

    @cached_property
    def composition(self) -> Composition:
        """Sources, their influence on each other, and the response of the outputs."""
        spread = self._spread()
        signs = self.train.signs
        influence = np.array(
            [
                signs.get(driver, 1) * spread[self._links[driver]]
                - signs.get(circuit.carrier, 1) * spread[self._links[circuit.carrier]]
                for driver, circuit in ((_driver(each), each[1]) for each in self._sources)
            ]
        ).reshape(len(self._sources), len(self._sources))
        rows = [spread[self._links[of]] - spread[self._links[base]] for of, base in self.outputs.values()]
        response = np.array(rows).reshape(len(self.outputs), len(self._sources))
        return Composition(tuple(source for source, _, _ in self._sources), influence, response)

    def _spread(self) -> Floats:
        """Radians of every link per radian of each source's driven error, (links, sources)."""
        equations = [row for row in self.train.system.equations if row.label not in self.train.redundant]
        at = {row.label: number for number, row in enumerate(equations)}
        matrix = np.zeros((len(equations), len(self._links)))
        for number, row in enumerate(equations):
            for link, coefficient in row.terms:
                matrix[number, self._links[link]] += float(coefficient)
        right = np.zeros((len(equations), len(self._sources)))
        for column, (_, circuit, driven) in enumerate(self._sources):
            right[at[circuit.id], column] = float((circuit.a, circuit.b)[driven])
        spread = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
        spread[np.abs(spread) < _ROUNDING * np.max(np.abs(spread), initial=0.0)] = 0.0
        return spread

    def ripples(
        self, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
    ) -> tuple[Floats, dict[str, Ripple]]:
        """Angles of the input (rad) and the ripple of every output at them; `on_done` is told of each chunk."""
        angle = np.linspace(0.0, 2 * pi * turns, samples)
        error, rate = self.composition.motion(angle, on_done)
        found = {}
        for at, (name, (of, base)) in enumerate(self.outputs.items()):
            mean = self.train.mean(of) - self.train.mean(base)
            found[name] = Ripple(name, mean, error[at], mean + rate[at])
        return angle, found


def _driver(each: tuple[Source, Circuit, int]) -> str:
    _, circuit, driven = each
    return circuit.i if driven == 1 else circuit.j
