"""What real teeth and pins do to outputs, as a page."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, figure

if TYPE_CHECKING:
    from geartrain.motion import Ripple


def motion_document(lead: str, turns: float, found: Mapping[str, Ripple]) -> Document:
    """Error and speed of each output while the input `lead` makes some turns."""
    rows = []
    for name, ripple in found.items():
        scale = ripple.mean or 1.0
        low, high = sorted((float(ripple.speed.min()) / scale, float(ripple.speed.max()) / scale))
        rows.append(
            (
                name,
                figure(ripple.mean, 9),
                f"{degrees(ripple.peak_to_peak):.6g}",
                f"{degrees(ripple.rms):.6g}",
                f"{low:.5f}..{high:.5f}" if ripple.mean else f"{low:.5f}..{high:.5f} (absolute)",
            )
        )
    text = (
        f"While '{lead}' makes {turns:g} turns. Speeds are over that of '{lead}'; the error is the angle less its mean "
        "motion."
    )
    header = ("output", "mean speed", "error p-p (deg)", "error rms (deg)", "speed over its mean")
    return Document("Motion with real teeth and pins", (text,), (Section("Outputs", (), (Table(header, rows),)),))
