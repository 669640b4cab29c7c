"""How long a task takes, and how that is written."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any


def timed(task: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds, and what the task returned."""
    start = time.perf_counter()
    found = task()
    return time.perf_counter() - start, found


def seconds_text(value: float | None) -> str:
    """A time in three digits with a unit from ns to min; a dash where there is none."""
    if value is None:
        return "-"
    scales = ((60.0, "min"), (1.0, "s"), (1e-3, "ms"), (1e-6, "us"))
    scale, unit = next(((scale, unit) for scale, unit in scales if value >= scale), (1e-9, "ns"))
    return f"{value / scale:.3g} {unit}"
