"""Remarks on a sound declaration: none of it stops the train on paper, so all of it is a note, never an error."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.errors import Problem
from geartrain.kinematics.circuits import Circuit, Tree, lint_rigid_bodies
from geartrain.train import Train


def lint_train(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> Iterator[Problem]:
    """Notes on a sound declaration."""
    yield from _conventions(train, circuits)
    yield from _centre_distances(train, tree, circuits)
    yield from lint_rigid_bodies(train, tree, train.cases)


def _conventions(train: Train, circuits: Sequence[Circuit]) -> Iterator[Problem]:
    at = {gear.name: position for position, gear in enumerate(train.gears)}
    for circuit in circuits:
        if circuit.note:
            yield Problem(f"'{circuit.id}': {circuit.note}", "", "", train.place("gears", at[circuit.id]))


def _centre_distances(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> Iterator[Problem]:
    """A wheel between two wheels of one axis has one centre distance: z_ring - z_planet = z_sun + z_planet.

    In half modules, for spur wheels of one module. Profile shift bridges a tooth or two (30 + 2 x 23 = 76 runs with a
    ring of 78), so this only warns.
    """
    met: dict[tuple[str, str, str], tuple[int, str, bool]] = {}
    at = {gear.name: position for position, gear in enumerate(train.gears)}
    wheels = train.wheels
    for circuit in circuits:
        if circuit.kind != "gear":
            continue
        for own, mate in (circuit.wheels, circuit.wheels[::-1]):
            (_, wheel), (link, other) = wheels[own], wheels[mate]
            if {wheel.kind, other.kind} != {"spur"} or wheel.count is None or other.count is None or wheel.internal:
                continue
            distance = other.count - wheel.count if other.internal else other.count + wheel.count
            key = (circuit.carrier, own, tree.axis_seen_from(circuit.carrier, link))
            before = met.setdefault(key, (distance, mate, other.internal))
            if before[0] != distance:
                yield _distance_problem(train, own, mate, before, distance, at[circuit.id])


def _distance_problem(
    train: Train, own: str, mate: str, before: tuple[int, str, bool], distance: int, at: int
) -> Problem:
    first, name, ring = before
    why = f"'{name}' asks for {first} and '{mate}' for {distance} half modules between the same two axes"
    odd = " (and no whole tooth count fits between them)" if (first - distance) % 2 and ring else ""
    return Problem(
        f"'{own}' has two centre distances",
        why + odd,
        "give the meshes different modules or shifted profiles, or correct a count",
        train.place("gears", at),
    )
