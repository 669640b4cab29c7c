"""Whether the teeth of all loops meet when a train is put together, and the angles at which its wheels go in."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import Any

from geartrain.analysis import GearTrain
from geartrain.report.document import Section, Table, cut


def closure_sections(train: GearTrain) -> Iterator[Section]:
    """Phase closure of a train whose axes have positions and whose pairs form loops; nothing for others."""
    if not train.is_placed or train.closure.kind == "open":
        return
    closure = train.closure
    rows = [(link, f"{degrees(angle):.6f}") for link, angle in closure.angles.items()]
    text = "Zero marks of links at these angles put every tooth before a gap; wheels have a tooth at their link's mark."
    lines = [line.strip() for line in closure.text.splitlines()]
    yield Section("Putting it together", (*lines, text), (Table(("link", "angle (deg)"), cut(rows)),))


def closure_data(train: GearTrain) -> dict[str, Any] | None:
    """The same as plain data; None where positions are not declared."""
    return train.closure.to_dict() if train.is_placed else None
