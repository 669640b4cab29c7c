"""Types of the results that the simulation commands print as JSON."""

from __future__ import annotations

from typing import Any


def answers() -> dict[str, Any]:
    """Return a mapping from the name of each simulation command that prints JSON to its result type."""
    from geartrain.simulation.strength.strength_report import StrengthReport
    from geartrain.simulation.time.time_report import TimeReport

    return {"strength": StrengthReport, "dynamics": TimeReport}
