"""What an output depends on: the pairs whose error would move it, exactly.

An error in one pair is a right-hand side in its row. What it does to an output is the weight of that row in the one
combination of rows that gives the output, so that one elimination of the transposed system answers for all outputs.
A follower stands still in the mean whatever its pin does, and swings with it: what turns the pin counts too.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.kinematics.relative_speeds import axis_sense
from geartrain.numerics.elimination import LinearForm, TooDenseError, eliminate
from geartrain.scene.context import SceneContext

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.willis_system import WillisSystem

_BUDGET = 4_000_000  # operations


def find_dependence(stage: SceneContext) -> Mapping[str, tuple[str, ...]]:
    """Names of pairs and couplings by output, in order from the input; nothing for a train that does not move.

    Of meshes in parallel, such as several planets between two wheels, all count.
    """
    if not stage.answer.verdict:
        return {}
    system = stage.train.equations(stage.answer.state)
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    followers = [circuit for circuit in circuits.values() if circuit.kind == "pin_follower"]
    ends = [_ends(stage, name) for name in stage.outputs]
    ends += [_seen(stage, circuit.j, circuit.carrier) for circuit in followers]
    try:
        weights = _weights(system, ends)
    except TooDenseError:
        return {}
    swings = dict(zip((circuit.id for circuit in followers), weights[len(stage.outputs) :], strict=True))
    return {
        name: _ordered(stage, circuits, _with_swings(used, swings))
        for name, used in zip(stage.outputs, weights, strict=False)
    }


def _with_swings(used: set[str], swings: Mapping[str, set[str]]) -> set[str]:
    """Also what turns the pins of the followers that are used."""
    found, left = set(used), set(swings)
    while met := found & left:
        left -= met
        found.update(*(swings[name] for name in met))
    return found


def _ends(stage: SceneContext, name: str) -> dict[str, int]:
    """An output as a sum of declared speeds."""
    return _seen(stage, *stage.outputs[name].links(name, stage.train.declaration.frame))


def _seen(stage: SceneContext, of: str, base: str) -> dict[str, int]:
    """A link seen from another, as a sum of declared speeds."""
    found = {of: 1}
    found[base] = found.get(base, 0) - axis_sense(of, base, stage.train.kinematics.signs)
    return found


def _weights(system: WillisSystem, outputs: Sequence[Mapping[str, int]]) -> list[set[str]]:
    """For each output the labels of the rows that have a weight in it; redundant rows have none."""
    columns: dict[str, LinearForm] = {link: {} for link in system.links}
    for at, row in enumerate(system.equations):
        for link, coefficient in row.terms:
            columns[link][at] = Fraction(coefficient)
    for number, output in enumerate(outputs):
        for link, factor in output.items():
            if factor:
                columns[link][-1 - number] = Fraction(-factor)
    forms = eliminate(columns.values(), _BUDGET).forms(_BUDGET)
    found: list[set[str]] = [set() for _ in outputs]
    for at, form in forms.items():
        for number in range(len(outputs)):
            if form.get(-1 - number):
                found[number].add(system.equations[at].label)
    return found


def _ordered(stage: SceneContext, circuits: Mapping[str, Circuit], used: Iterable[str]) -> tuple[str, ...]:
    """Pairs in the order in which one meets them, walking from the inputs."""
    left = dict.fromkeys(name for name in circuits if name in set(used))
    for loop in stage.train.mobility.loops:
        if any(pair in left for pair in loop.pairs):
            left.update(dict.fromkeys(loop.pairs))
    touching: dict[str, list[str]] = {}
    for name in left:
        for link in {circuits[name].i, circuits[name].j, circuits[name].carrier}:
            touching.setdefault(link, []).append(name)
    frame = stage.train.declaration.frame
    queue = deque(link for link in (stage.lead, *stage.case.inputs) if link is not None)
    seen = {frame, *queue}
    found: dict[str, None] = {}
    while queue:
        for name in touching.get(queue.popleft(), ()):
            if name not in found:
                found[name] = None
                for link in (circuits[name].j, circuits[name].i, circuits[name].carrier):
                    if link not in seen:
                        seen.add(link)
                        queue.append(link)
    return (*found, *(name for name in left if name not in found))
