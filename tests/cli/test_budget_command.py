"""`geartrain budget`: what its options mean, what it refuses, and how it is stopped."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from commands import call

REQUESTED = ("budget", "freeth-2008", "--of", "moon", "--turns", "1", "--samples", "64")


def told(*more: str) -> Any:
    done = call(*REQUESTED, "--json", *more)
    assert done.exit_code == 0, done.output
    return json.loads(done.stdout)


def test_the_span_is_a_time_or_a_period_of_the_table() -> None:
    assert told()["span_days"] == pytest.approx(6585.3213)
    assert told("--span", "6940 d")["span_days"] == 6940.0
    short, long = told("--span", "1 d"), told("--span", "callippic_76_tropical_years_modern")
    ratios = [each["pointers"][0]["causes"][0]["degrees"] for each in (short, long)]
    assert ratios[1] / ratios[0] == pytest.approx(27758.4065)


def test_a_body_is_taken_from_a_name_unless_it_is_said() -> None:
    def theory(*more: str) -> Any:
        return told(*more)["pointers"][0]["causes"][1]

    assert "Moon" in theory()["note"]
    assert "Sun" in theory("--body", "moon=sun")["note"]
    assert theory("--body", "moon=none")["declared"] == "not declared"


def test_a_state_is_chosen_and_the_first_is_taken_without() -> None:
    chariot = ("budget", "south-pointing-chariot", "--turns", "1", "--samples", "64", "--json")
    assert json.loads(call(*chariot).stdout)["state"] == "straight on"
    assert json.loads(call(*chariot, "--state", "on the spot").stdout)["state"] == "on the spot"


def test_trials_that_are_stopped_are_no_budget(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    from geartrain.workshop import TrialResults

    monkeypatch.setattr(TrialResults, "complete", property(lambda self: False))
    out = tmp_path / "x.json"
    more = ("--cutting", "pitch_deviation=1 %", "--trials", "4", "--turns", "1", "--samples", "64")
    done = call("budget", "moon-triangular", *more, "-o", out)
    assert done.exit_code == 130
    assert not out.exists()
