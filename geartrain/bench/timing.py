"""How long a task takes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any


def timed(task: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds, and what the task returned."""
    start = time.perf_counter()
    found = task()
    return time.perf_counter() - start, found
