"""The influence of each load on every torque of a train without losses, exact and whatever the loads weigh.

x = sum c_o T_o, point 3 of "Who drives a pair" in docs/torques.md: one elimination for all loads at once, each load a
symbol, and every unknown torque a linear form of symbols. Where loads go on through one torque only, and with one sign,
only their sum matters from there on: it becomes a symbol of its own, so that long trains stay cheap and their numbers
short.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.torques.block_solution import solve_block
from geartrain.numerics.block_triangular import Block
from geartrain.numerics.elimination import LinearForm, add_into

if TYPE_CHECKING:
    from geartrain.dynamics.torques.torque_balance import TorqueBalance

UnitLoads = Mapping[str, Mapping[str, Fraction]]
"""Who resists -> link -> torque at a load of one."""

_NAMED = 3  # loads named; of the others it is said how many they are


@dataclass(frozen=True)
class LoadGroup:
    """Loads summed up: how many, and the first of their names in alphabetical order."""

    count: int
    names: tuple[str, ...]

    def __str__(self) -> str:
        rest = self.count - len(self.names)
        names = [*self.names, f"{rest} more"] if rest else list(self.names)
        return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))

    def joined(self, other: LoadGroup) -> LoadGroup:
        """Both together; what is in both counts once as far as it is named."""
        names = sorted({*self.names, *other.names})
        twice = len({*self.names} & {*other.names})
        return LoadGroup(self.count + other.count - twice, tuple(names[:_NAMED]))


NOTHING = LoadGroup(0, ())


class LoadInfluence(NamedTuple):
    """Which loads act on one mesh: those that make its multiplier positive, and negative; `open` if nothing tells."""

    plus: LoadGroup = NOTHING
    minus: LoadGroup = NOTHING
    open: bool = False


def find_load_influence(balance: TorqueBalance, loads: UnitLoads) -> dict[str, LoadInfluence] | None:
    """The influence of loads on every mesh; None where no torques balance the loads.

    balance   without losses; its known torques only tell which links are loaded
    """
    weighing = _InfluenceSolver(balance, loads)
    return weighing.found if weighing.go() else None


class _InfluenceSolver:
    def __init__(self, balance: TorqueBalance, loads: UnitLoads) -> None:
        self.balance, self.loads = balance, loads
        self.found: dict[str, LoadInfluence] = {}

    def _start(self) -> None:
        self.takers: dict[int, LoadGroup] = {}
        self.rows: dict[int, LinearForm] = {row: {} for row in self.balance.rows}
        self.holders: dict[int, set[int]] = {}
        at = {link: row for row, link in enumerate(self.balance.links)}
        for name in sorted(self.loads):
            symbol = self._symbol(LoadGroup(1, (name,)))
            for link, torque in self.loads[name].items():
                if at.get(link) in self.rows:
                    self._add(at[link], {symbol: torque}, 1)

    def _symbol(self, taker: LoadGroup) -> int:
        symbol = -1 - len(self.takers)
        self.takers[symbol] = taker
        self.holders[symbol] = set()
        return symbol

    def _add(self, row: int, form: LinearForm, factor: Fraction | int) -> None:
        own = self.rows[row]
        add_into(own, form, factor)
        for symbol in form:
            (self.holders[symbol].add if symbol in own else self.holders[symbol].discard)(row)

    def go(self) -> bool:
        """Solve block by block, or all at once where a block leaves open what a later one may need."""
        self._start()
        done = self._through(self.balance.parts)
        if done is None:
            self._start()
            done = self._through([self.balance.whole])
        return bool(done)

    def _through(self, blocks: Sequence[Block]) -> bool | None:
        self.found = {}
        for block in blocks:
            forms = self._solve(block)
            if forms is None:
                return False
            if block is not blocks[-1] and None in forms.values():
                return None
            for column, form in forms.items():
                self._take(column, form)
        return True

    def _solve(self, block: Block) -> dict[int, LinearForm | None] | None:
        """Every unknown of a block as a form of symbols, None where it stays open; None for all if nothing balances."""
        known = {row: self.rows.pop(row) for row in block.rows}
        for row, form in known.items():
            for symbol in form:
                self.holders[symbol].discard(row)
        found = solve_block(self.balance.columns, block, dict.fromkeys(block.columns, 0), known)
        if found is None or len(block.rows) > 1 or len(block.columns) > 1:
            return found
        return {column: None if form is None else self._merged(form) for column, form in found.items()}

    def _merged(self, form: LinearForm) -> LinearForm:
        """One symbol for loads of one sign that are told apart nowhere else."""
        signs = {value > 0 for value in form.values()}
        if len(signs) != 1 or any(self.holders[symbol] for symbol in form):
            return form
        return {self._symbol(self._sum(form)): Fraction(1 if signs.pop() else -1)}

    def _sum(self, symbols: Sequence[int] | LinearForm) -> LoadGroup:
        found = NOTHING
        for symbol in symbols:
            found = found.joined(self.takers[symbol])
        return found

    def _take(self, at: int, form: LinearForm | None) -> None:
        column = self.balance.columns[at]
        if form is None:
            share = LoadInfluence(open=True)
        else:
            share = LoadInfluence(
                self._sum([symbol for symbol, value in form.items() if value > 0]),
                self._sum([symbol for symbol, value in form.items() if value < 0]),
            )
            for row, coefficient in column.pieces[0].items():
                if row in self.rows and form:
                    self._add(row, form, coefficient)
        self.found |= {mesh.id: share for mesh in column.meshes}
