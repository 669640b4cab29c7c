"""The study of speeds: every method on a small train, judged by exact answers. Times are never judged."""

from __future__ import annotations

import pytest
from studies import speed_study
from studies.speed_study import speeds

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


def test_every_method_on_small_trains_is_right_and_says_how_right() -> None:
    found = speeds(100, 1, ["chain", "epicyclic", "grid"])
    for row in found.rows:
        assert row.seconds is not None or row.note
        if row.method in ("exact", "exact, one output"):
            assert row.error == 0
        elif row.error is not None:
            assert row.error < 1e-11
    assert {row.family for row in found.rows} == {"chain", "epicyclic", "grid"}


def test_a_drifting_chain_is_measured_exactly_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed_study, "SIZES", (120,))
    monkeypatch.setattr(speed_study, "_DRIFTED", 100)
    monkeypatch.setattr(speed_study, "_JUDGED", 20)
    errors = {row.method: row.error for row in speeds(120, 1, ["drift"]).rows}
    assert errors["exact"] == errors["exact, one output"] == 0
    assert len(errors) == 2
