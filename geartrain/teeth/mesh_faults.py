"""What is wrong with the teeth of a pair in the ways in which it is driven."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from geartrain.errors import Problem
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.pair_verdict import friction_lock, friction_lock_at_speed


def find_faults(ways: Sequence[GearMesh]) -> tuple[Problem, ...]:
    """Everything wrong with one pair in the ways it is driven; what is wrong in some ways only says in which."""
    said = [list(way.own_faults()) for way in ways]
    found: list[Problem] = []
    for way, faults in zip(ways, said, strict=True):
        for fault in faults:
            always = all(fault in other for other in said)
            label = way.label if always else f"{way.label}, '{way.driver}' driving"
            placed = replace(fault, what=f"{label}: {fault.what}", place=way.place)
            found += [] if placed in found else [placed]
    return tuple(found)


def friction_faults(mesh: GearMesh) -> Iterator[Problem]:
    """That friction locks these teeth, if it does."""
    if mesh.wheels.friction_law is None:
        if mesh.law.locks:
            yield friction_lock(mesh.law.friction, mesh.law.locking_friction)
    elif mesh.verdict and mesh.losses.locks:
        yield friction_lock_at_speed(mesh.wheels.friction_law.law, mesh.law.locking_friction)
