"""Sections on the couplings of a train other than pins: declared sizes, belt lengths, effects that are not modelled,
and transmission functions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING

from geartrain.numerics.results import Result
from geartrain.report.document import Section, Table, cut, filled_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain


def coupling_sections(train: GearTrain) -> Iterator[Section]:
    """Yield a section on the sizes of couplings and on effects that are not modelled; nothing without couplings."""
    shown = [each for each in train.declaration.couplings if each.about or each.UNKNOWN]
    if shown:
        lengths = {}  # of belts around two pulleys with declared diameters and axis positions
        if any(each.kind == "belt" for each in shown):
            from geartrain.kinematics.buildability.belt_drives import pulley_pairs

            for pair in pulley_pairs(train.declaration, train.kinematics.tree, train.circuits):
                if pair.length is not None:
                    crossed = ", crossed" if pair.belt.reversed else ""
                    lengths[pair.belt.name] = f"{pair.length:.9g} mm{crossed}"
        rows = [(each.name, each.kind, each.about, lengths.get(each.name, ""), each.UNKNOWN) for each in shown]
        table = filled_table(("coupling", "kind", "sizes", "length", "not modelled"), rows, 3)
        yield Section("Couplings", (), (replace(table, rows=cut(table.rows)),))


@dataclass(frozen=True)
class VaryingCoupling(Result):
    """Coupling with a variable ratio, other than a pin in a slot, and its transmission function."""

    coupling: str
    """Name of the coupling."""
    kind: str
    """Kind of the coupling."""
    driver: str
    """Name of the driving link."""
    driven: str
    """Name of the driven link."""
    ratio: Fraction
    """Exact mean ratio: speed of the driven link divided by speed of the driving link, relative to the carrier."""
    swing: float
    """Peak-to-peak deviation of the driven link from uniform motion [rad]."""
    speed_ratio: tuple[float, float]
    """Minimum and maximum speed ratio. The sign is chosen so that the mean ratio is positive."""
    at_once: bool
    """True if the driven link moves in steps, between which `speed_ratio` applies."""
    formula: str
    """Driven angle q as a function of the driver's angle S; "" if no closed form is known."""


def varying_section(couplings: Sequence[VaryingCoupling]) -> Section:
    """Return a section on the transmission functions of couplings."""
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


def varying_couplings(train: GearTrain) -> Iterator[VaryingCoupling]:
    """Yield the couplings of a train with a variable ratio, except pins in slots."""
    # the mechanics of a train import numpy
    if not train.declaration.couplings:
        return
    pins = {pin.coupling.name for pin in train.mechanics.pins}
    for each, law in ((joint.coupling, joint.transmission) for joint in train.mechanics.couplings):
        if each.name not in pins:
            driver, driven = each.links(train.declaration.wheels)
            (low, high), speeds = law.error_range(), law.speed_range()
            yield VaryingCoupling(
                each.name, each.kind, driver, driven, each.mean, high - low, speeds, law.at_once, each.formula
            )
