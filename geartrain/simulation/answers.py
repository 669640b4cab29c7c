"""Types of the simulation results that commands print as JSON."""

from __future__ import annotations

from typing import Any


def answers() -> dict[str, Any]:
    """Return the type of the result of each command of this package that prints JSON."""
    from geartrain.simulation.strength.strength_report import StrengthReport
    from geartrain.simulation.time.time_report import TimeReport

    return {"strength": StrengthReport, "dynamics": TimeReport}
