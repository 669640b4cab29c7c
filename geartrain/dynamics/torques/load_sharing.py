"""How pairs that the balance leaves open share a torque: as declared, equation (11), or alike among equal planets.

docs/torques.md, section 8.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction

from geartrain.dynamics.torques.torque_balance import LoadedPair, LoadShares
from geartrain.kinematics.circuits import Circuit
from geartrain.train import Train

_Key = tuple[object, ...]
_EVEN = ("gear", "parallel", "pins_in_holes")  # kinds of circuits whose ratio is the same at every instant


def find_shares(train: Train, circuits: Sequence[Circuit], loaded: Collection[str]) -> tuple[LoadShares, ...]:
    """Declared parts of the torque on each wheel that two or more such pairs have in common.

    loaded   links with a torque of their own, or that are held

    An idler hands on what it gets: nothing is shared there, though its pairs may share on their other wheels.
    """
    by_wheel: dict[str, dict[str, Fraction]] = {}
    for gear in train.gears:
        if gear.share is not None:
            for wheel in gear.pair:
                by_wheel.setdefault(wheel, {})[gear.name] = gear.share.value
    found = ((train.wheels[wheel][0], parts) for wheel, parts in by_wheel.items() if len(parts) > 1)
    return tuple((link, parts) for link, parts in found if link in loaded or not _is_idler(link, circuits, train.frame))


def _is_idler(link: str, circuits: Iterable[Circuit], frame: str) -> bool:
    return link != frame and sum(link in (each.i, each.j, each.carrier) for each in circuits) == 2


def find_ties(
    circuits: Sequence[Circuit],
    meshes: Sequence[LoadedPair],
    known: Mapping[str, Fraction],
    singled: Collection[str],
) -> tuple[tuple[str, ...], ...]:
    """Pairs of equal planets share alike: one carrier, the same mates, counts, efficiencies and own torque.

    singled   links that are not like others: the frame, held, locked, asked for, or with declared shares
    """
    apart = {*singled, *(circuit.carrier for circuit in circuits)}
    apart |= {link for circuit in circuits if circuit.kind not in _EVEN for link in (circuit.i, circuit.j)}
    by_planet: dict[str, list[tuple[_Key, str]]] = {}
    for circuit, mesh in zip(circuits, meshes, strict=True):
        first, second = circuit.wheels if circuit.kind == "gear" else (circuit.i, circuit.j)
        ways = (mesh.forward, mesh.backward)
        at_first, at_second, _ = mesh.torques(0)
        for planet, own, mate, other, losses in (
            (circuit.i, at_first, second, at_second, ways),
            (circuit.j, at_second, first, at_first, ways[::-1]),
        ):
            if planet not in apart:
                by_planet.setdefault(planet, []).append(((circuit.carrier, mate, own, other, losses), circuit.id))
    alike: dict[_Key, list[list[str]]] = {}
    for planet, found in by_planet.items():
        found.sort(key=lambda each: str(each[0]))
        key = (known.get(planet, Fraction(0)), *(key for key, _ in found))
        alike.setdefault(key, []).append([name for _, name in found])
    groups = [group for group in alike.values() if len(group) > 1]
    return tuple(names for group in groups for names in zip(*group, strict=True))
