"""One loop of meshes, made readable: its gears in order, what it asks of their teeth, and what it misses by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from geartrain.kinematics.phasing.phase_system import (
    PhaseCondition,
    PhaseKind,
    PhaseSystem,
    ResidueKnowledge,
    judge_residue,
)
from geartrain.numerics.decimal_text import fraction_text
from geartrain.numerics.plain_data import Key, Result


@dataclass(frozen=True)
class LoopPhase(Result):
    """What one loop of meshes asks of its teeth, and what it gets: equations (2) and (3) of docs/closure.md.

    Attributes
    ----------
    gears : tuple of str
        Wheels in order; two wheels of one link between which the loop goes over are joined by `+`.
    meshes : tuple of str
        Pairs in order, the last one closes the loop. Where `together`, pairs of several loops in no order.
    weights : tuple of int
        Whole numbers with which the equations of the pairs add up; 1 and -1 but for compound wheels.
    residue : Fraction or float
        What the sum is off a whole number [pitch], from -1/2 to 1/2; a Fraction where it is exact.
    slack : float
        How far off the residue may be [pitch]; 0 where it is exact.
    how : {"exact", "recognised", "numeric"}
        recognised: exact, with angles taken for fractions that rounded positions allow.
    inside : mapping of str to Fraction or float, or None
        For each gear the part of a turn, with its sign, by which its tooth number enters the sum; None where wheels are
        compound.
    retime : mapping of str to float
        By how much to turn a wheel on its arbor, counterclockwise [pitch], to close the loop: any one of them.
    together : bool
        True for what several loops must fulfil only together.

    See Also
    --------
    MeshPhasing : an example
    """

    KEYS = ("gears", "meshes", "weights", Key("verdict", "kind"), "residue", "slack", "how", "miss", "inside", "retime")

    gears: tuple[str, ...]
    meshes: tuple[str, ...]
    weights: tuple[int, ...]
    residue: Fraction | float
    slack: float
    how: ResidueKnowledge
    inside: Mapping[str, Fraction | float] | None
    retime: Mapping[str, float]
    together: bool = False

    @property
    def kind(self) -> PhaseKind:
        """closes, misses, or unclear where positions are too rough to tell."""
        return judge_residue(self.residue, self.slack)

    @property
    def miss(self) -> Fraction | float:
        """What is left at the last pair when all others fit (pitches), with the best choice of teeth to engage."""
        return self.residue / self.weights[-1]

    @property
    def text(self) -> str:
        """One line."""
        name = " - ".join((*self.gears, *self.gears[:1])) if self.gears else f"{', '.join(self.meshes)} together"
        if self.kind == "closes":
            return f"{name} closes{self._doubt}"
        if self.kind == "unclear":
            return f"{name} cannot be told: positions are known to {self.slack:.2g} pitch only"
        words = f"{name} misses by {_shown(self.miss)} pitch at {self.meshes[-1]}{self._doubt}"
        if self.retime:
            wheel, turned = min(self.retime.items(), key=lambda each: abs(each[1]))
            words += f"; {wheel} turned on its arbor by {turned:.6g} pitch would close it"
        return words

    @property
    def _doubt(self) -> str:
        if self.how == "exact":
            return ""
        return " (angles recognised)" if self.how == "recognised" else f" (to {self.slack:.1g})"


def describe_loop(problem: PhaseSystem, condition: PhaseCondition) -> LoopPhase:
    """A condition with the names of gears and pairs."""
    gears: list[str] = []
    over: dict[str, int] = {}
    cycle = condition.cycle
    row = condition.row
    if cycle is not None:
        before = cycle.meshes[-1]
        for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
            came, goes = (_wheel(problem, one, node) for one in (before, mesh))
            gears.append(came if came == goes else f"{came}+{goes}")
            if came != goes:
                over |= {came: _pull(problem, before, node, row), goes: _pull(problem, mesh, node, row)}
            before = mesh
    meshes = cycle.meshes if cycle else tuple(row)
    return LoopPhase(
        tuple(gears),
        tuple(problem.circuits[mesh].id for mesh in meshes),
        tuple(row[mesh] for mesh in meshes),
        condition.residue,
        condition.slack,
        condition.how,
        None if over or cycle is None else _inside(problem, condition),
        {wheel: float(condition.residue) / pull for wheel, pull in over.items() if condition.kind == "misses"},
        cycle is None,
    )


def _wheel(problem: PhaseSystem, mesh: int, node: int) -> str:
    return problem.circuits[mesh].wheels[problem.ends[mesh][1] == node]


def _pull(problem: PhaseSystem, mesh: int, node: int, row: Mapping[int, int]) -> int:
    """What a pitch by which one wheel is turned on its arbor adds to the sum of a loop."""
    circuit = problem.circuits[mesh]
    return row[mesh] * (1 if problem.ends[mesh][0] == node or circuit.b > 0 else -1)


def _inside(problem: PhaseSystem, condition: PhaseCondition) -> dict[str, Fraction | float]:
    """Weights and signs times the azimuths of both contacts of each gear: the teeth that it has inside the loop."""
    contacts, cycle = problem.contacts, condition.cycle
    assert cycle is not None
    exact = isinstance(condition.residue, Fraction)
    found: dict[str, Fraction | float] = {}
    before = cycle.meshes[-1]
    for node, mesh in zip(cycle.nodes, cycle.meshes, strict=True):
        part: Fraction | float = Fraction(0)
        for one in (before, mesh):
            side = problem.ends[one][1] == node
            angle = contacts.part[one][side] if exact else float(contacts.azimuth[one, int(side)])
            part += _pull(problem, one, node, condition.row) * angle
        gear = _wheel(problem, mesh, node)
        found[gear] = found.get(gear, Fraction(0)) + part
        before = mesh
    return found


def _shown(value: Fraction | float) -> str:
    return fraction_text(abs(value)) if isinstance(value, Fraction) else f"{abs(value):.6g}"
