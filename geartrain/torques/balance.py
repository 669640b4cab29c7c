"""Torque balance of every link: the transpose of the Willis system, exact, with losses applied in carriers' frames.

A mesh of links i and j with carrier k and row a (w_i - w_k) + b (w_j - w_k) = 0 carries one multiplier x: without loss
its torques are a x on i, b x on j, and minus their sum on k. Where i drives in the carrier's frame, j gets the share
eta of its torque; where j drives, i does. The loss is the driver's power in that frame times 1 - eta: never negative.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from geartrain.exact import Row, eliminate

Pattern = Mapping[str, int]
"""Mesh id -> 1 where its first link drives in the carrier's frame, -1 where the second does, 0 without loss."""

_KNOWN = -1  # the column in which known torques stand


@dataclass(frozen=True)
class Mesh:
    """One gear pair or coupling as a path of power.

    links, senses   i, j, k, and 1 or -1 for the sense of each link's axis
    a, b            coefficients of its row
    rolling         a (w_i - w_k), which is -b (w_j - w_k): 0 where the two do not roll on each other
    forward         efficiency with i driving, `backward` with j driving; 0 or less locks
    """

    id: str
    links: tuple[str, str, str]
    senses: tuple[int, int, int]
    a: int
    b: int
    rolling: Fraction
    forward: Fraction = Fraction(1)
    backward: Fraction = Fraction(1)

    @property
    def loses(self) -> bool:
        """True if it matters which of the two drives."""
        return bool(self.rolling) and (self.forward != 1 or self.backward != 1)

    def torques(self, side: int) -> tuple[Fraction, Fraction, Fraction]:
        """Torques on i, j, k per unit of the multiplier."""
        left = self.a * (self.backward if side < 0 else Fraction(1))
        right = self.b * (self.forward if side > 0 else Fraction(1))
        return left * self.senses[0], right * self.senses[1], -(left + right) * self.senses[2]

    def power(self, multiplier: Fraction) -> Fraction:
        """Power that flows from i to j in the carrier's frame, before losses where i drives."""
        return -multiplier * self.rolling


@dataclass(frozen=True)
class Balance:
    """What is known and what is not in one case.

    links     all links but the frame
    known     external torque by link: loads and friction of bearings; links not named have none
    unknown   links whose external torque is asked for
    held      links held to the frame; `locks`, pairs of links that turn together, with the senses of both axes
    """

    links: tuple[str, ...]
    meshes: tuple[Mesh, ...]
    known: Mapping[str, Fraction]
    unknown: tuple[str, ...]
    held: tuple[str, ...] = ()
    locks: tuple[tuple[tuple[str, int], tuple[str, int]], ...] = ()

    @property
    def size(self) -> int:
        """Number of unknown torques: meshes, then external ones, brakes and locks."""
        return len(self.meshes) + len(self.unknown) + len(self.held) + len(self.locks)

    def rows(self, pattern: Pattern) -> Iterator[Row]:
        """One row a link: all torques on it vanish."""
        rows: dict[str, Row] = {link: {} for link in self.links}
        for link, torque in self.known.items():
            if torque and link in rows:
                rows[link][_KNOWN] = torque
        for column, entries in enumerate(self._columns(pattern)):
            for link, coefficient in entries:
                if coefficient and link in rows:
                    rows[link][column] = rows[link].get(column, Fraction(0)) + coefficient
        return iter([{c: value for c, value in row.items() if value} for row in rows.values()])

    def _columns(self, pattern: Pattern) -> Iterator[Sequence[tuple[str, Fraction]]]:
        for mesh in self.meshes:
            yield tuple(zip(mesh.links, mesh.torques(pattern.get(mesh.id, 0)), strict=True))
        one = Fraction(1)
        yield from ([(link, one)] for link in (*self.unknown, *self.held))
        yield from ([(a, Fraction(s)), (b, Fraction(-t))] for (a, s), (b, t) in self.locks)


@dataclass(frozen=True)
class Solved:
    """Torques under one pattern: multipliers by mesh, external torques asked for, and on brakes and locks.

    `loose` are meshes whose share of a torque is not determined, as between equal planets.
    """

    multipliers: Mapping[str, Fraction]
    external: Mapping[str, Fraction]
    brakes: Mapping[str, Fraction]
    locks: tuple[Fraction, ...]
    loose: tuple[str, ...]


def solve_balance(balance: Balance, pattern: Pattern, ties: Sequence[Sequence[str]] = ()) -> Solved | None:
    """All torques under one pattern, or None where no torques balance the known ones.

    ties   groups of meshes that share alike: equal multipliers
    """
    columns = {mesh.id: column for column, mesh in enumerate(balance.meshes)}
    shares: list[Row] = [
        {columns[first]: Fraction(1), columns[other]: Fraction(-1)} for first, *others in ties for other in others
    ]
    echelon = eliminate([*balance.rows(pattern), *shares])
    if echelon.conditions:
        return None
    forms = echelon.forms()
    values: list[Fraction | None] = []
    for column in range(balance.size):
        form = forms.get(column)
        loose = form is None or any(other >= 0 for other in form)
        values.append(None if loose or form is None else form.get(_KNOWN, Fraction(0)))
    return _named(balance, values)


def _named(balance: Balance, values: Sequence[Fraction | None]) -> Solved:
    meshes, unknown, held = len(balance.meshes), len(balance.unknown), len(balance.held)
    zero = Fraction(0)
    plain = [zero if value is None else value for value in values]
    external = plain[meshes : meshes + unknown]
    brakes = plain[meshes + unknown : meshes + unknown + held]
    return Solved(
        {mesh.id: plain[at] for at, mesh in enumerate(balance.meshes)},
        dict(zip(balance.unknown, external, strict=True)),
        dict(zip(balance.held, brakes, strict=True)),
        tuple(plain[meshes + unknown + held :]),
        tuple(mesh.id for at, mesh in enumerate(balance.meshes) if values[at] is None),
    )


def is_consistent(balance: Balance, pattern: Pattern, solved: Solved) -> bool:
    """True if power flows through every mesh the way the pattern says, and none must pass one that locks."""
    for mesh in balance.meshes:
        side = pattern.get(mesh.id, 0)
        power = mesh.power(solved.multipliers[mesh.id])
        if power * side < 0:
            return False
        if power and side and (mesh.forward if side > 0 else mesh.backward) <= 0:
            return False
    return True
