"""Sections on the couplings of a train other than pins: sizes as declared, belt lengths, what is not modelled, and
transmission functions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from geartrain.report.document import Section, cut, filled_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain


def coupling_sections(train: GearTrain) -> Iterator[Section]:
    """Yield a section on the sizes of the couplings of a train and on what is not modelled; nothing for kinds without
    remarks."""
    declared = train.declaration
    shown = [each for each in declared.couplings if each.about or each.UNKNOWN]
    if not shown:
        return
    lengths = dict(_belt_lengths(train)) if any(each.kind == "belt" for each in shown) else {}
    rows = [(each.name, each.kind, each.about, lengths.get(each.name, ""), each.UNKNOWN) for each in shown]
    table = filled_table(("coupling", "kind", "sizes", "length", "not modelled"), rows, 3)
    yield Section("Couplings", (), (replace(table, rows=cut(table.rows)),))


def _belt_lengths(train: GearTrain) -> Iterator[tuple[str, str]]:
    """Yield the lengths of the belts around two pulleys whose diameters and axis positions are declared."""
    from geartrain.kinematics.buildability.belt_drives import pulley_pairs

    for pair in pulley_pairs(train.declaration, train.kinematics.tree, train.circuits):
        if pair.length is not None:
            yield pair.belt.name, f"{pair.length:.9g} mm{', crossed' if pair.belt.reversed else ''}"
