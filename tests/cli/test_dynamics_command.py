"""`geartrain dynamics`: text, JSON, CSV of motion in time; what is refused, and what an interrupted run gives."""

from __future__ import annotations

import csv
import json
import signal
from collections.abc import Callable
from itertools import pairwise
from math import tau
from pathlib import Path
from typing import Any

import pytest
from answer_schemas import holds
from commands import HEAVY, call, interrupt_after

Write = Callable[..., Path]
TURN = ("--rate", "0.3", "--turns", "1", "--skip", "0", "--steps", "1000", "--no-fast")


@pytest.fixture
def pin(train_file: Write) -> Path:
    """A pin at 10 mm in a slot whose axis is 8 mm away, with inertia and drag behind it."""
    return train_file(HEAVY, "pin.yaml")


def answer(*words: object) -> dict[str, Any]:
    done = call("dynamics", *words, "--json")
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.output)
    holds("dynamics", found)
    return found


def test_the_json_has_the_closed_rate_of_a_pin_and_the_torque_of_virtual_work(pin: Path) -> None:
    found = answer(pin, *TURN)
    # docs/dynamics.md, equation 7: sqrt(drag/(inertia 13.0441342)) rad/s
    assert found["separation"]["rate"] == pytest.approx((1e-3 / (1e-5 * 13.0441342)) ** 0.5 / tau, rel=1e-7)
    # a slot turns once while its pin does, and its drag never changes sides
    assert found["torque"] == pytest.approx(1e-3, rel=2e-3)  # and what steps of this length take
    assert (found["driven"], found["link"], found["complete"]) == ("rate", "a", True)
    assert [each["link"] for each in found["inertias"]] == ["b"]


def test_the_text_begins_with_the_rate_at_which_teeth_part_and_marks_what_converged(pin: Path) -> None:
    text = call("dynamics", pin, *TURN).output
    lines = text.splitlines()
    heads = [line for line, below in pairwise(lines) if line and below == "-" * len(line)]
    assert heads[:4] == ["Separation rate", "Contacts", "Drive and outputs", "Energy"]
    assert "The motion is valid up to 0.44067 turn/s of 'a'" in text
    assert "'a' makes 1 turn at 0.3 turn/s" in text
    assert "the dynamic factor is undefined" in " ".join(text.split())
    assert "All figures converged." in text


def test_a_train_that_friction_locks_on_its_way_has_no_solution_there(train_file: Write) -> None:
    # a slot that drives its pin locks where f > |cos d / sin d|: 14 % of a turn
    path = train_file(
        """
links: {frame: {}, a: {inertia: 1 g cm2}, b: {inertia: 100 g cm2}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: 0.8}]
inputs: {b: 1}
loads: {a: -10 N mm}
""",
        "locks.yaml",
    )
    done = call("dynamics", path, *TURN)
    assert done.exit_code == 1
    assert "NOT SOLVED in" in done.output
    assert "for example if friction locks the train" in " ".join(done.output.split())


def test_where_teeth_bounce_or_yield_the_rate_at_which_rigid_ones_part_is_told_as_such(pin: Path) -> None:
    bouncing = call("dynamics", pin, *TURN, "--restitution", "0.3").output
    assert "Restitution 0.3." in bouncing
    assert "Separation rates assume no restitution" in bouncing
    assert answer(pin, *TURN, "--restitution", "0.3")["restitution"] == 0.3
    pin.write_text(HEAVY + "stiffness: 20 N m/rad\n", encoding="utf-8")
    assert "Separation rates assume rigid teeth" in call("dynamics", pin, *TURN, "--model", "compliant").output
    assert "These rates" not in call("dynamics", pin, *TURN).output


def test_a_load_that_drives_gives_power_back_at_what_is_kept(train_file: Write) -> None:
    path = train_file("extends: worm\nname: driven\nloads: {wheel: -1 N m}\n", "driven.yaml")
    text = call("dynamics", path, "--rate", "1", "--turns", "1").output
    # 1 N m over 30 at 2 pi rad/s
    assert "Mean torque at 'screw': -33.333 N mm; power returned: 209.4 mW." in text


@pytest.mark.parametrize(("torque", "still"), [("0.5 N mm", True), ("2 N mm", False)])
def test_a_train_that_its_drive_does_not_move_is_said_to_stand_still(
    train_file: Write, torque: str, still: bool
) -> None:
    path = train_file(
        "links: {frame: {}, a: {inertia: 1e-5 kg m2, bearing: 1 N mm}}\n"
        "revolutes: [{pair: [frame, a], axis: A}]\n"
        f"inputs: {{a: 1}}\nrate: 1 turn/s\ndrive: {{torque: {torque}}}\n",
        "driven.yaml",
    )
    done = call("dynamics", path, "--turns", "1", "--skip", "0", "--steps", "500", "--no-fast")
    assert ("'a' DOES NOT MOVE" in done.output) is still


def test_the_course_is_printed_and_written_as_one_table_with_labelled_columns(pin: Path, tmp_path: Path) -> None:
    printed = call("dynamics", pin, *TURN, "-o", "-.csv").output
    assert call("dynamics", pin, *TURN, "-o", tmp_path / "x.csv").exit_code == 0
    assert (tmp_path / "x.csv").read_text(encoding="utf-8") == printed
    rows = list(csv.DictReader(printed.splitlines()))
    assert {"time (s)", "turns", "b angle (rad)", "b speed (rad/s)", "a~b gap (rad)", "a~b coast gap (rad)"} <= set(
        rows[0]
    )
    for row in rows:
        assert float(row["turns"]) == pytest.approx(0.3 * float(row["time (s)"]))
        # a pin without clearance keeps its slot
        assert abs(float(row["a~b gap (rad)"])) < 1e-9


@pytest.mark.slow
def test_the_picture_has_a_panel_for_each_pair_with_backlash_and_marks_impacts(tmp_path: Path) -> None:
    picture = tmp_path / "moon.svg"
    words = ("--rate", "1", "--turns", "0.3", "--skip", "0.1", "--steps", "4000", "--no-fast")
    assert call("dynamics", "moon-triangular-inertia", *words, "--plot", picture).exit_code == 0
    text = picture.read_text(encoding="utf-8")
    for pair in ("a~b1", "b2~c1", "c2~d1", "d2~e"):
        assert f'id="gap {pair}"' in text
        assert f'id="coast flank {pair}"' in text


@pytest.mark.parametrize("text", ["0.3", "0.3 turn/s", "18 rpm"])
def test_a_plain_rate_is_in_turns_a_second(pin: Path, text: str) -> None:
    assert answer(pin, *TURN, "--rate", text)["rate"] == pytest.approx(0.3 * tau)


def test_an_interrupted_run_gives_what_was_done(pin: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told = interrupt_after(3, monkeypatch)
    before = signal.getsignal(signal.SIGINT)
    done = call("dynamics", pin, *TURN[:-2], "5000", "--no-fast", "--json")
    assert done.exit_code == 130
    found = json.loads(done.stdout)
    holds("dynamics", found)
    assert found["complete"] is False
    assert found["figures"] == []
    assert 0 < found["duration"] < 1 / 0.3
    assert found["torque"] > 0
    assert "stopped after" in done.stderr
    assert len(told) == 3
    assert sum(told) < 1_000_000 / 3
    assert signal.getsignal(signal.SIGINT) is before
