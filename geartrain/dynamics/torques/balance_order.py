"""The balance of mean torques as a pattern for those of single positions: in which order they follow, which idle."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.dynamics.torques.torque_balance import TorqueBalance

_SCALES = 1_000_003, 1_414_213  # of the coefficients of a row, so that nothing in it cancels by chance


def idle_pairs(balance: TorqueBalance) -> set[str]:
    """The pairs through which no torque passes at any position: nothing beyond them asks for one."""
    rows = {row for row, torque in balance.rows.items() if torque}
    idle: set[str] = set()
    for block in balance.parts:
        columns = [balance.columns[at] for at in block.columns]
        if rows.isdisjoint(block.rows):
            idle.update(mesh.id for column in columns for mesh in column.meshes)
        else:
            rows.update(row for column in columns for row in column.pieces[0])
    return idle


def without_pairs(balance: TorqueBalance, names: set[str]) -> TorqueBalance:
    """The balance of the rest."""
    return replace(
        balance,
        meshes=tuple(mesh for mesh in balance.meshes if mesh.id not in names),
        ties=tuple(tied for tied in balance.ties if names.isdisjoint(tied)),
    )


def generic_balance(balance: TorqueBalance) -> TorqueBalance:
    """The balance with numbers of which nothing cancels by chance, as at single positions: for the order in it."""
    group = {name: at for at, names in enumerate(balance.ties, 1) for name in names}
    meshes = tuple(
        replace(
            mesh,
            a=_SCALES[0] * mesh.a + group.get(mesh.id, len(balance.ties) + at),
            b=_SCALES[1] * (mesh.b or -1),
            forward=Fraction(1),
            backward=Fraction(1),
        )
        for at, mesh in enumerate(balance.meshes, 1)
    )
    return replace(balance, meshes=meshes)
