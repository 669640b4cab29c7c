"""Sections and data on the declared tooth forms and pins of a train."""

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
    """Gear pair with a declared tooth form, driven by one of its two wheels."""

    KEYS = (Key("pair", "mesh.name"), Key("", "mesh.who"), "states", *_OF_PAIR)

    mesh: GearMesh
    states: tuple[str, ...] = ()
    """Names of the states in which the wheel `mesh.driver` drives."""

    @cached_property
    def account(self) -> PairAccount:
        """Results of the mesh as numbers, texts and tables."""
        return self.mesh.account()

    @property
    def figures(self) -> PairFigures:
        """Sizes, transmission function and losses of the mesh."""
        return self.account.figures


@dataclass(frozen=True)
class DrivenPin(Result):
    """Pin-and-slot coupling with declared dimensions, and results for the case that the pin drives."""

    KEYS = ("coupling", Key("ratio", "figures.speed_ratio.mean"), Key("", "figures"))

    coupling: str
    """Name of the coupling."""
    figures: PinFigures
    """Transmission function and losses of the coupling for the case that the pin drives."""


_MOST_PAIRS = 12  # with more, a report as text omits their tables


def teeth_sections(train: GearTrain, pairs: Sequence[DrivenPair], pins: Sequence[DrivenPin]) -> Iterator[Section]:
    """Yield sections on the pairs with a declared tooth form and on the pins of a train, if there are any."""
    if pairs:
        yield _teeth(train, pairs)
    if pins:
        yield _pins(train)


def _teeth(train: GearTrain, pairs: Sequence[DrivenPair]) -> Section:
    accounts: dict[str, list[PairAccount]] = {}
    for pair in pairs:
        # pairs with the same description share their tables
        accounts.setdefault(pair.account.words, []).append(pair.account)
    # each description is printed once
    lines = list(accounts)
    tables = [
        joined_table(each) for same in accounts.values() for each in zip(*(one.tables for one in same), strict=True)
    ]
    rows = [(pair.mesh.name, pair.mesh.driver, pair.mesh.who.why, ", ".join(pair.states)) for pair in pairs]
    tables.append(filled_table(("pair", "driving wheel", "basis", "states"), rows, 3, wide=True))
    lines += [f"Pair '{mesh.name}': {mesh.note}." for mesh in train.meshes if mesh.note]
    lines += map(fault_text, train.mechanics.faults)
    return Section("Teeth", lines, tables, detail=len(pairs) > _MOST_PAIRS)


def joined_table(rows: Sequence[AccountTable]) -> Table:
    """Return one table that contains the rows of several pairs with the same tooth form."""
    return Table(rows[0].header, [each.row for each in rows], wide=rows[0].wide)


def without_losses(mesh: GearMesh) -> Section | None:
    """Return a section that states why a pair has no computed sliding losses; None for a pair with such losses."""
    if not mesh.has_friction:
        return Section("Friction", ("No friction is given, so that sliding losses are 0.",))
    return None if mesh.computes_losses else Section("Friction", (f"{mesh.friction_words}.",))


def fault_text(fault: Problem) -> str:
    """Return sentences on a fault, its cause and its remedy."""
    return f"{fault.what}; {fault.why}. {fault.fix}." if fault.why else f"{fault.what}. {fault.fix}."


def _pins(train: GearTrain) -> Section:
    rows = []
    for joint in train.mechanics.pins:
        transmission, coupling = joint.transmission, joint.coupling
        sizes = (f"{coupling.pin} -> {coupling.slot}", str(coupling.pin_radius), str(coupling.offset))
        speeds = "{:.6f}..{:.6f}".format(*transmission.speed_range())
        amplitude = f"{degrees(transmission.amplitude):.5f}"
        rows.append((coupling.name, *sizes, str(transmission.ratio), amplitude, speeds))
    header = ("coupling", "pin -> slot", "pin radius", "offset", "mean ratio", "amplitude (deg)", "speed ratio")
    text = "Speeds and angles of the slot relative to the carrier, for a pin that turns uniformly relative to it."
    return Section("Pins", (text,), (Table(header, rows),))


def driven_pairs(train: GearTrain) -> tuple[DrivenPair, ...]:
    """Return the pairs with a tooth form, with an entry for each wheel that drives in at least one state."""
    return tuple(DrivenPair(mesh, states) for ways in train.mechanics.driven_ways.values() for mesh, states in ways)


def driven_pins(train: GearTrain) -> tuple[DrivenPin, ...]:
    """Return the pin-and-slot couplings of a train with declared dimensions. In each result the pin drives."""
    return tuple(DrivenPin(joint.coupling.name, pin_figures(joint.transmission)) for joint in train.mechanics.pins)
