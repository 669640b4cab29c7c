"""The results of simulations that commands print as JSON."""

from __future__ import annotations

from typing import Any


def answers() -> dict[str, Any]:
    """Question (a command, or a use of one) -> type of its result."""
    from geartrain.simulation.strength.strength_report import StrengthReport
    from geartrain.simulation.time.time_report import TimeReport

    return {"strength": StrengthReport, "dynamics": TimeReport}
