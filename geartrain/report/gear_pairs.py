"""Sections and data on the declared tooth forms, pins and other couplings with variable ratio of a train."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
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
    """Pair with a declared tooth form, driven by one of its wheels."""

    KEYS = (Key("pair", "mesh.name"), Key("", "mesh.who"), "states", *_OF_PAIR)

    mesh: GearMesh
    states: tuple[str, ...] = ()
    """Names of the states in which `mesh.driver` drives."""

    @cached_property
    def account(self) -> PairAccount:
        """Results of the mesh as numbers, text and tables."""
        return self.mesh.account()

    @property
    def figures(self) -> PairFigures:
        """Sizes, transmission function and losses of the mesh."""
        return self.account.figures


@dataclass(frozen=True)
class DrivenPin(Result):
    """Pin-and-slot coupling with declared dimensions, and its results while the pin drives."""

    KEYS = ("coupling", Key("ratio", "figures.speed_ratio.mean"), Key("", "figures"))

    coupling: str
    """Name of the coupling."""
    figures: PinFigures
    """Transmission function and losses of the coupling with the pin driving."""


@dataclass(frozen=True)
class VaryingCoupling(Result):
    """Coupling with a variable ratio other than a pin in a slot, and its transmission function."""

    KEYS = ("coupling", "kind", "driver", "driven", "ratio", "swing", "speed_ratio", "at_once", "formula")

    coupling: str
    """Name of the coupling."""
    kind: str
    """Kind of the coupling."""
    driver: str
    """Driving link; `driven` is the driven link."""
    driven: str
    ratio: Fraction
    """Exact mean speed of the driven link divided by the speed of the driver, relative to the carrier."""
    swing: float
    """Maximum minus minimum deviation of the driven link from uniform motion [rad]."""
    speed_ratio: tuple[float, float]
    """Minimum and maximum speed ratio, with the sign of the mean ratio taken as positive."""
    at_once: bool
    """True if the driven link jumps; its speed ratio is then the ratio between jumps."""
    formula: str
    """Driven angle q as a function of the driver's angle S; empty if there is no closed form."""


_MOST_PAIRS = 12  # with more, a report as text omits their tables


def teeth_sections(
    train: GearTrain, pairs: Sequence[DrivenPair], pins: Sequence[DrivenPin], couplings: Sequence[VaryingCoupling] = ()
) -> Iterator[Section]:
    """Yield sections on the pairs with a declared tooth form, on the pins and on other couplings with a variable ratio;
    nothing if a train has none of them.
    """
    if pairs:
        yield _teeth(train, pairs)
    if pins:
        yield _pins(train)
    if couplings:
        yield _varying(couplings)


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
    """Return one table with the rows of several pairs of the same tooth form."""
    return Table(rows[0].header, [each.row for each in rows], wide=rows[0].wide)


def without_losses(mesh: GearMesh) -> Section | None:
    """Return the section on the friction of a pair whose sliding losses are 0 or not known; None for other pairs."""
    if not mesh.has_friction:
        return Section("Friction", ("No friction is given, so that sliding losses are 0.",))
    return None if mesh.computes_losses else Section("Friction", (f"{mesh.friction_words}.",))


def fault_text(fault: Problem) -> str:
    """Return the fault, its cause and its remedy as sentences."""
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


def _varying(couplings: Sequence[VaryingCoupling]) -> Section:
    rows = []
    for each in couplings:
        low, high = each.speed_ratio
        speeds = f"{low:.6f}..{high:.6f}" + (", jumps" if each.at_once else "")
        ends = f"{each.driver} -> {each.driven}"
        rows.append((each.coupling, each.kind, ends, str(each.ratio), f"{degrees(each.swing):.5f}", speeds))
    header = ("coupling", "kind", "driver -> driven", "mean ratio", "swing (deg)", "speed ratio")
    text = (
        "Angles of the driven link relative to the carrier, for a driver that turns uniformly. The swing is the range "
        "of the deviation from uniform motion."
    )
    formulas = [f"{each.coupling}: {each.formula}." for each in couplings if each.formula]
    where = ["q is the angle of the driven link, S that of the driver with its phase."] if formulas else []
    return Section("Couplings with variable ratio", (text, *formulas, *where), (Table(header, rows),))


def varying_couplings(train: GearTrain) -> tuple[VaryingCoupling, ...]:
    """Return the couplings of a train with a variable ratio, without pins in slots."""
    found = []
    pins = {pin.coupling.name for pin in train.mechanics.pins}
    for joint in train.mechanics.couplings:
        coupling, transmission = joint.coupling, joint.transmission
        if coupling.name not in pins:
            driver, driven = coupling.links(train.declaration.wheels)
            low, high = transmission.error_range()
            speeds, formula = transmission.speed_range(), coupling.formula
            found.append(
                VaryingCoupling(
                    coupling.name,
                    coupling.kind,
                    driver,
                    driven,
                    coupling.mean,
                    high - low,
                    speeds,
                    transmission.at_once,
                    formula,
                )
            )
    return tuple(found)


def driven_pairs(train: GearTrain) -> tuple[DrivenPair, ...]:
    """Return the pairs with a declared tooth form, with one entry for each wheel that drives in at least one state."""
    return tuple(DrivenPair(mesh, states) for ways in train.mechanics.driven_ways.values() for mesh, states in ways)


def driven_pins(train: GearTrain) -> tuple[DrivenPin, ...]:
    """Return the pin-and-slot couplings of a train with declared dimensions, each with the pin driving."""
    return tuple(DrivenPin(joint.coupling.name, pin_figures(joint.transmission)) for joint in train.mechanics.pins)
