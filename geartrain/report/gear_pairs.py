"""Real teeth and pins as sections of a train's report, and as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import degrees
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.numerics.results import Key, Result
from geartrain.report.document import Section, Table, filled_table
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, PinFigures, pin_figures

if TYPE_CHECKING:
    from geartrain.errors import Problem

_OF_PAIR = (Key("form", "mesh.form"), Key("gears", "mesh.gears"), Key("note", "mesh.note"), Key("", "figures"))


@dataclass(frozen=True)
class DrivenPair(Result):
    """A pair with real teeth in one way in which it is driven."""

    KEYS = (Key("pair", "mesh.name"), Key("", "mesh.who"), "states", *_OF_PAIR)

    mesh: GearMesh
    states: tuple[str, ...] = ()
    """In which it is driven so."""

    @cached_property
    def account(self) -> PairAccount:
        """What the mesh tells of itself."""
        return self.mesh.account()

    @property
    def figures(self) -> PairFigures:
        """Its figures."""
        return self.account.figures


@dataclass(frozen=True)
class DrivenPin(Result):
    """A coupling with dimensions, its pin driving."""

    KEYS = ("coupling", Key("ratio", "figures.speed_ratio.mean"), Key("", "figures"))

    coupling: str
    """Name of the coupling."""
    figures: PinFigures
    """Its figures with the pin driving."""


_MOST_PAIRS = 12  # with more, a report as text omits their tables


def teeth_sections(train: GearTrain, pairs: Sequence[DrivenPair], pins: Sequence[DrivenPin]) -> Iterator[Section]:
    """The real teeth and pins of a train; nothing where none are declared."""
    if pairs:
        yield _teeth(train, pairs)
    if pins:
        yield _pins(train)


def _teeth(train: GearTrain, pairs: Sequence[DrivenPair]) -> Section:
    accounts: dict[str, list[PairAccount]] = {}
    for pair in pairs:
        accounts.setdefault(pair.account.words, []).append(pair.account)
    lines = list(accounts)
    tables = [
        joined_table(each) for same in accounts.values() for each in zip(*(one.tables for one in same), strict=True)
    ]
    tables.append(_drivers(pairs))
    lines += [f"Pair '{mesh.name}': {mesh.note}." for mesh in train.meshes if mesh.note]
    lines += map(fault_text, train.mechanics.faults)
    return Section("Teeth", lines, tables, detail=len(pairs) > _MOST_PAIRS)


def joined_table(rows: Sequence[AccountTable]) -> Table:
    """One table of all pairs of a kind."""
    return Table(rows[0].header, [each.row for each in rows], wide=rows[0].wide)


def fault_text(fault: Problem) -> str:
    """What is wrong, why, and what to do, as sentences."""
    return f"{fault.what}; {fault.why}. {fault.fix}." if fault.why else f"{fault.what}. {fault.fix}."


def _drivers(pairs: Sequence[DrivenPair]) -> Table:
    """The wheel that drives each pair, and how that is known."""
    rows = [(pair.mesh.name, pair.mesh.driver, pair.mesh.who.why, ", ".join(pair.states)) for pair in pairs]
    return filled_table(("pair", "driver", "how that is known", "states"), rows, 3, wide=True)


def _pins(train: GearTrain) -> Section:
    rows = []
    for joint in train.mechanics.pins:
        transmission, coupling = joint.transmission, joint.coupling
        minimum, most = transmission.speed_range()
        rows.append(
            (
                coupling.name,
                f"{coupling.pin} -> {coupling.slot}",
                str(coupling.pin_radius),
                str(coupling.offset),
                str(transmission.ratio),
                f"{degrees(transmission.amplitude):.5f}",
                f"{minimum:.6f}..{most:.6f}",
            )
        )
    header = ("coupling", "pin -> slot", "pin radius", "offset", "mean ratio", "amplitude (deg)", "speed ratio")
    text = "Speeds and angles of the slot in the carrier's frame, the pin turning evenly there."
    return Section("Pins", (text,), (Table(header, rows),))


def driven_pairs(train: GearTrain) -> tuple[DrivenPair, ...]:
    """Real teeth of a train in every way they are driven; empty where none are declared."""
    return tuple(DrivenPair(mesh, states) for ways in train.mechanics.driven_ways.values() for mesh, states in ways)


def driven_pins(train: GearTrain) -> tuple[DrivenPin, ...]:
    """Pins of a train; empty where none has dimensions."""
    return tuple(DrivenPin(joint.coupling.name, pin_figures(joint.transmission)) for joint in train.mechanics.pins)
