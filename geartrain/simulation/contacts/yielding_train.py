"""A train whose teeth yield: the contacts of `TrainModel`, each with a stiffness and a damping; how it swings.

M x'' + C x' + K x = 0 about contact, docs/dynamics.md (19): K = sum k r^T r over pairs that touch, r the row of speeds
by which a pair closes, ratios at their means; and the springs of drives.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.simulation.contacts.tooth_yield import PairYield, ToothYield, ToothYieldTable
from geartrain.simulation.contacts.train_model import TrainModel

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.contact_model import ContactPair
    from geartrain.simulation.contacts.rubbing_arms import Arms
    from geartrain.teeth.transmission import ExactRatio


@dataclass(frozen=True)
class YieldingTrain(TrainModel):
    """A train in one case as a model of contacts that yield. `restitution` is asked in place of what is declared."""

    restitution: float | None = None

    @cached_property
    def table(self) -> ToothYieldTable:
        """How its pairs yield."""
        driven = {}
        for gear in self.train.gears:
            first, second = gear.pair
            driver = self.problem.drivers.get(gear.name)
            driven[gear.name] = first if driver is not None and driver.wheel == second else second
        return ToothYieldTable(self.train, self._meshes, driven, self.restitution)

    def _is_contact(self, circuit: Circuit) -> bool:
        # what has no stiffness and need not yield keeps its ratio
        return circuit.id in self.table.pairs or super()._is_contact(circuit)

    def _even_arms(self, circuit: Circuit, law: ExactRatio) -> Arms | None:
        return None if self._gears[circuit.id].efficiency is None else super()._even_arms(circuit, law)

    @property
    def assumed(self) -> tuple[str, ...]:
        """What was estimated."""
        names = [pair.name for pair in self.model.pairs]
        yields = [self.table.pairs[name] for name in names]
        notes = [each.note for each in yields if each.note]
        assumed = [
            name
            for name, each in zip(names, yields, strict=True)
            if each.damping is None and self.restitution is None and self._undeclared(name)
        ]
        if assumed:
            ratio = self.table.pairs[assumed[0]].ratio
            notes.append(f"damping of {', '.join(assumed)} taken as {ratio:g} of the critical: none is declared")
        return tuple(notes)

    def _undeclared(self, name: str) -> bool:
        parts = {part.name: part for part in (*self.train.gears, *self.train.couplings)}
        return self.train.restitution_of(parts[name]) is None

    @cached_property
    def pair_yields(self) -> tuple[PairYield, ...]:
        """Of each pair of the model. Raises `QuestionError` where one has no stiffness, and for escapements."""
        if self.case.escapements:
            what = f"the escapement of '{self.train.name}'"
            raise QuestionError(Problem(what, "a stop is rigid, and these teeth yield", "take the rigid model"))
        lacking = [pair.name for pair in self.model.pairs if pair.name not in self.table.pairs]
        if lacking:
            what = f"nothing says how stiff the teeth of {', '.join(lacking)} are"
            why = "an estimate takes involute teeth of known module, thickness and density, of steel, brass or bronze"
            fix = "declare `stiffness`, of the pairs or the train, such as 20 N m/rad (of pins in N m/rad only)"
            raise QuestionError(Problem(what, why, fix))
        return tuple(self.table.pairs[pair.name] for pair in self.model.pairs)

    @cached_property
    def yields(self) -> ToothYield:
        """Stiffness and damping of each pair of the model."""
        stiffness = np.array([each.stiffness for each in self.pair_yields], dtype=np.float64)
        damping = [
            2 * each.ratio * np.sqrt(each.stiffness * self._inertia(self._row(pair)))
            if each.damping is None
            # declared
            else each.damping
            for pair, each in zip(self.model.pairs, self.pair_yields, strict=True)
        ]
        return ToothYield(stiffness, np.array(damping, dtype=np.float64))

    @cached_property
    def free(self) -> list[int]:
        """The coordinates whose speed is not prescribed."""
        return [at for at in range(len(self.coordinates)) if at not in self.model.given]

    def _row(self, pair: ContactPair) -> Floats:
        """Opening speed of a pair by the speeds of coordinates, at its mean ratio."""
        row = np.zeros(len(self.coordinates))
        for at, value in pair.driven.items():
            row[at] += value
        for at, value in pair.driver.items():
            row[at] -= pair.front.slope * value
        return row

    def _inertia(self, row: Floats) -> float:
        """What resists a row (kg m2): 1/(r M^-1 r^T); 0 where all its speeds are prescribed."""
        free = row[self.free]
        ease = float(free @ np.linalg.solve(self.mass[np.ix_(self.free, self.free)], free)) if free.any() else 0.0
        return 1 / ease if ease else 0.0

    @cached_property
    def matrices(self) -> tuple[Floats, Floats, Floats]:
        """M, C and K of the coordinates that are free."""
        stiffness, damping = np.zeros_like(self.mass), np.array(self.model.viscous)
        for pair, k, c in zip(self.model.pairs, *self.yields, strict=True):
            row = self._row(pair)
            stiffness += k * np.outer(row, row)
            damping += c * np.outer(row, row)
        for spring in self.model.springs:
            row = np.zeros(len(self.coordinates))
            for at, value in spring.angle.items():
                row[at] = value
            stiffness += spring.stiffness * np.outer(row, row)
        free = np.ix_(self.free, self.free)
        return self.mass[free], damping[free], stiffness[free]

    @cached_property
    def vibration(self) -> tuple[Floats, Floats]:
        """Squares of circular frequencies, and modes of the free coordinates with phi^T M phi = 1, rising."""
        from scipy.linalg import eigh

        if not self.free:
            what = f"'{self.train.name}' has nothing that can swing"
            why = "all its links keep their ratio to what drives"
            raise QuestionError(Problem(what, why, "declare `stiffness`, of a pair or the train"))
        mass, _, stiffness = self.matrices
        squares, modes = eigh(stiffness, mass)
        # what turns freely has 0, and rounding
        bound = 1e-12 * max(float(squares[-1]), 0.0)
        return np.where(squares > bound, squares, 0.0), modes

    @property
    def fastest(self) -> float:
        """Circular frequency of its fastest mode, or half the rate at which damping alone stops a pair (rad/s)."""
        rates = [0.0]
        for pair, c in zip(self.model.pairs, self.yields.damping, strict=True):
            inertia = self._inertia(self._row(pair))
            rates.append(float(c) / inertia / 2 if inertia else 0.0)
        return max(float(np.sqrt(self.vibration[0][-1])), *rates)
