"""`geartrain torques --turns`: text, JSON, CSV and pictures of the torque over a turn."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from math import log, pi
from pathlib import Path

import numpy as np
import pytest
from answer_schemas import holds
from commands import call
from dynamics.test_uncounted_losses import PIN as COUPLED

import geartrain

Write = Callable[..., Path]
PIN = COUPLED.replace("id: P, ", "")
LOCKS = PIN.replace("friction: 0.3", "friction: 0.8").replace("{a: 1}", "{b: 1}").replace("b: -10", "a: -10")
MEAN = 10 * (1 + 0.3 / pi * log(18 / 2))
SAMPLES = ("--samples", "300")


@pytest.fixture
def pin(train_file: Write) -> Path:
    return train_file(PIN, "pin.yaml")


def test_json_holds_the_torque_over_the_turns_at_its_top_level(pin: Path) -> None:
    done = call("torques", pin, "--turns", "1", *SAMPLES, "--json")
    assert done.exit_code == 0
    answer = json.loads(done.output)
    holds("torques", answer)
    over = answer["over_turn"]
    assert over["input"]["mean"] == pytest.approx(MEAN, rel=1e-8)
    assert (over["input"]["link"], over["locked_share"], over["flank_changes"]) == ("a", 0, {"a~b": 0})
    assert json.loads(call("torques", pin, "--json").output)["over_turn"] is None


def test_text_tells_extremes_energies_and_losses(pin: Path) -> None:
    text = call("torques", pin, "--turns", "1", *SAMPLES).output
    for said in ("12.0981949", "50.9784589", "lost in couplings", "everything repeats after 1 turn", "over 1 turn of"):
        assert said in text


def test_a_train_without_load_is_said_to_give_nothing_out(train_file: Write) -> None:
    path = train_file(
        PIN.replace("b: {}}\nrev", "b: {bearing: 1 N m}}\nrev").replace("loads: {b: -10 N m}", ""), "idle.yaml"
    )
    text = " ".join(call("torques", path, "--turns", "1", *SAMPLES).output.split())
    assert "no power is taken out; the maximum power" in text
    assert "No net energy is taken out: all energy put in is lost." in text
    assert "Efficiency, energy" not in text


def test_every_position_stands_in_the_table(pin: Path, tmp_path: Path) -> None:
    printed = call("torques", pin, "--turns", "2", *SAMPLES, "-o", "-.csv").output
    rows = list(csv.DictReader(io.StringIO(printed)))
    assert list(rows[0]) == ["turns", "torque_a", "starting", "lost_a~b"]
    assert len(rows) >= 300
    assert max(float(row["torque_a"]) for row in rows) == pytest.approx(50.98, abs=0.05)
    written = tmp_path / "t.csv"
    assert call("torques", pin, "--turns", "2", *SAMPLES, "-o", written).exit_code == 0
    assert written.read_text(encoding="utf-8").splitlines() == printed.splitlines()


def test_a_train_that_locks_says_where(train_file: Write) -> None:
    path = train_file(LOCKS, "locks.yaml")
    done = call("torques", path, "--turns", "1", *SAMPLES, "--json")
    assert done.exit_code == 1
    over = json.loads(done.output)["over_turn"]
    assert over["locked_share"] == pytest.approx(0.139505, abs=1e-6)
    assert over["input"]["mean"] is over["efficiency"] is over["starting"] is None
    assert "13.95 % of the run no torque balances" in call("torques", path, "--turns", "1", *SAMPLES).output


def test_another_link_can_be_requested_and_a_period_followed(pin: Path) -> None:
    turned = call("torques", pin, "--turns", "period", *SAMPLES, "--json")
    assert json.loads(turned.output)["over_turn"]["turns"] == 1


def test_pictures_mark_mean_extremes_and_locked_stretches(pin: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    picture = tmp_path / "t.svg"
    assert call("torques", pin, "--turns", "1", *SAMPLES, "--plot", picture).exit_code == 0
    drawn = picture.read_text(encoding="utf-8")
    assert 'id="maximum"' in drawn
    assert "mean 12.098" in drawn
    assert 'id="locked"' not in drawn
    pin.write_text(LOCKS, encoding="utf-8")
    assert call("torques", pin, "--turns", "1", *SAMPLES, "--plot", picture, "--force").exit_code == 1
    assert 'id="locked"' in picture.read_text(encoding="utf-8")


def test_what_is_lost_is_drawn_as_torque_at_the_link_that_is_requested() -> None:
    pytest.importorskip("matplotlib")
    train = geartrain.load("""
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {q: 60}, bearing: 3 N mm}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, q]}]
inputs: {b: 1}
crank: a
""")
    above, below = train.torques(turns=1, samples=20).plot().axes
    assert below.get_xlabel().startswith("losses, as torque at a (mN m)")
    assert above.get_ylabel() == "torque at a (mN m)"
    ends, mean = (np.asarray(each.get_xdata(), dtype=float) for each in below.lines)
    assert [*ends, *mean] == pytest.approx([1, 1, 1]), "3 N mm of the bearing, a third of it at the crank"
    assert float(above.lines[0].get_ydata()[0]) == pytest.approx(1)


# ------------------------------------------------------------------------------------------------------------- trials

SPREAD = PIN.replace("friction: 0.3", "friction: {sliding: 0.3, static: 0.4, deviation: 0.05}")


def test_trials_of_friction_have_the_spread_that_the_closed_form_tells(pin: Path) -> None:
    """The mean torque is linear in friction, 10 (1 + f ln(9)/pi), so its deviation is that part of the declared one."""
    pin.write_text(SPREAD, encoding="utf-8")
    words = ("--turns", "1", "--samples", "40", "--trials", "60", "--seed", "3")
    tried = json.loads(call("torques", pin, *words, "--json").output)["friction_trials"]
    mean, low, high = tried["mean"]["mean"]
    assert low < MEAN < high
    assert mean == pytest.approx(MEAN, abs=0.15)
    _, low, high = tried["mean"]["deviation"]
    assert low < 0.05 * 10 * log(9) / pi < high
    assert tried["starting"]["mean"][0] > tried["maximum"]["mean"][0]
    assert tried["spreads"] == {"a~b": {"sliding": 0.3, "deviation": 0.05, "range": None}}
    assert (tried["wanted"], tried["done"], tried["locks"]["count"]) == (60, 60, 0)
    text = call("torques", pin, *words, "--trials", "6").output
    assert "6 trials, seed 3" in text
    assert "a~b 0.3 ± 0.05" in " ".join(text.split())


def test_trials_of_a_train_without_loads_report_that_no_load_is_declared(pin: Path) -> None:
    pin.write_text(SPREAD.replace("loads: {b: -10 N m}", ""), encoding="utf-8")
    done = call("torques", pin, "--turns", "1", "--samples", "20", "--trials", "12")
    assert done.exit_code == 1
    assert "Verdict: unloaded" in done.output


def test_trials_are_the_same_whoever_works(pin: Path) -> None:
    pin.write_text(SPREAD, encoding="utf-8")
    words = ("torques", pin, "--turns", "1", "--samples", "20", "--trials", "12", "--json")
    alone, together = (json.loads(call(*words, *more).stdout)["friction_trials"] for more in ((), ("--workers", "2")))
    assert alone == together
