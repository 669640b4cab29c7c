"""Studies without repeats: their times are never judged."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from studies import measurement


@pytest.fixture(scope="session", autouse=True)
def _once() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measurement, "ENOUGH", 0.0)
        yield
