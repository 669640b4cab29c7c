"""`geartrain teeth`, as a user runs it."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import subprocess
import sys
from fractions import Fraction
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

import pytest
from clusters import PATIENCE, until
from commands import call
from sampling import first_few

from geartrain import load

HANDS = """
name: hands
links:
  frame: {}
  minute: {wheels: {cannon: {teeth: {search: [8, 40]}}}}
  arbor: {wheels: {minute-wheel: {teeth: {search: [20, 80]}}, nut: {teeth: {search: [6, 30]}}}}
  hour: {wheels: {hour-wheel: {teeth: {search: [20, 90]}}}}
revolutes:
  - {pair: [frame, minute], axis: centre}
  - {pair: [frame, arbor], axis: side}
  - {pair: [frame, hour], axis: centre}
gears:
  - {pair: [cannon, minute-wheel]}
  - {pair: [nut, hour-wheel]}
inputs: {minute: 1}
outputs:
  hour: {expect: 1/12}
"""


@pytest.fixture
def hands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "hands.yaml"
    path.write_text(HANDS, encoding="utf-8")
    return path


def answer(*arguments: object) -> dict[str, object]:
    alone = () if arguments[0] == "approximants" else ("--workers", 1)
    done = call("teeth", *arguments, *alone, "--json")
    assert done.exit_code in (0, 1), done.stderr
    return json.loads(done.stdout)


def test_a_month_has_the_solutions_that_trying_everything_finds(hands: Path) -> None:
    ranges = ("--pinions", "12:40", "--wheels", "30:130")
    found = answer("ratio", "13.368267", "--stages", 2, *ranges, "--tolerance", "0.001 %", "--best", 100)
    assert found["complete"] is True
    assert found["count"] == len(found["solutions"]) == 9
    for one in found["solutions"]:
        top, beneath = one["teeth"]
        ratio = Fraction(prod(top), prod(beneath))
        assert str(ratio) == one["ratio"]
        assert one["error"] == pytest.approx(float(ratio / Fraction("13.368267") - 1), rel=1e-12)
        assert sorted(a for a, _ in one["stages"]) == sorted(top)


def test_csv_and_json_tell_the_same(hands: Path) -> None:
    requested = ("ratio", "235 months / 19 years", "--range", "15:60", "--best", 4)
    rows = list(csv.DictReader(io.StringIO(call("teeth", *requested, "--workers", 1, "-o", "-.csv").stdout)))
    for row, one in zip(rows, answer(*requested)["solutions"], strict=True):
        assert [list(map(int, row[side].split("*"))) for side in ("top", "beneath")] == one["teeth"]
        assert row["ratio"] == one["ratio"]
        for name in ("value", "error", "total", "largest", "distinct"):
            assert float(row[name]) == one[name]


def test_an_unwanted_sense_is_refused_by_name(hands: Path) -> None:
    def requested(*more: object) -> Any:
        return call("teeth", "ratio", "--stages", 1, "--range", "15:240", "--workers", 1, *more)

    done = requested("+235/19")
    assert (done.exit_code, "idler" in done.stdout) == (1, True)
    assert requested("--", "-235/19").exit_code == requested("+235/19", "--internal", 1).exit_code == 0


def test_fractions_on_the_way_are_told_with_their_kinds(hands: Path) -> None:
    found = answer("approximants", "365.2422", "--range", "1:60000")["solutions"]
    kinds = {row["value"]: row["kind"] for row in found}  # type: ignore[index]
    assert kinds["1461/4"] == kinds["10592/29"] == kinds["12053/33"] == "convergent"


def test_fractions_of_any_size_are_approximants() -> None:
    found = answer("approximants", "3.14159265358979", "--range", "12:1000000000")
    assert abs(found["solutions"][-1]["error"]) < 1e-14  # type: ignore[index]


def test_the_wheels_of_a_train_are_those_that_looking_at_all_of_them_finds(hands: Path) -> None:
    found = answer("train", hands, "--best", 100)
    rows = {tuple(one["teeth"].values()) for one in found["solutions"]}  # type: ignore[union-attr]
    every = product(range(8, 41), range(20, 81), range(6, 31))
    expected = {(a, b, c, a + b - c) for a, b, c in every if 20 <= a + b - c <= 90 and a * c * 12 == b * (a + b - c)}
    assert (found["complete"], found["count"], rows) == (True, len(expected), expected)


def test_a_solution_is_written_as_a_train_that_does_what_is_requested(hands: Path) -> None:
    done = call(
        "teeth", "train", hands, "--sort", "total", "--pick", 2, "-o", hands.parent / "found.yaml", "--workers", 1
    )
    assert done.exit_code == 0
    made = load(hands.parent / "found.yaml")
    assert made.solve()["hour"] == Fraction(1, 12)
    assert call("check", hands.parent / "found.yaml").exit_code == 0
    assert sum(wheel.count or 0 for _, wheel in made.declaration.wheels.values()) == 80


@pytest.mark.parametrize(("ratio", "options", "sense"), [("235/19", (), 1), ("5", ("--stages", 1, "--internal", 1), 1)])
def test_stages_are_written_as_a_train_whose_numerator_drives(
    tmp_path: Path, ratio: str, options: tuple[object, ...], sense: int
) -> None:
    assert call("teeth", "ratio", ratio, *options, "-o", tmp_path / "found.yaml").exit_code == 0
    train = load(tmp_path / "found.yaml")
    assert [train.solve()[name] for name in train.declaration.outputs] == [sense * Fraction(ratio)]


def test_nothing_found_tells_what_to_relax_and_exits_with_one(hands: Path) -> None:
    done = call("teeth", "train", hands, "--max-radius", "9", "--hunting", "--workers", 1)
    assert done.exit_code == 1
    assert "Suggestions" in done.stdout
    assert "candidates" in done.stdout


def test_where_a_printed_row_stands(hands: Path) -> None:
    known = ("--where", "VO1=32,VO2=50,VX=40", "--where", "VO1=32,VO2=48,VX=41")
    right, wrong = answer("train", "pennestri-2002-missing", "--best", 1, *known)["where"]  # type: ignore[misc]
    assert right["rank"] == 21
    assert right["refused"] == []
    assert wrong["rank"] is None
    assert wrong["assignment"]["outputs"]["venus"]["error"] == pytest.approx(-0.064162, abs=5e-7)


def test_a_set_and_an_orrery_are_written_as_trains(hands: Path) -> None:
    made = hands.parent / "made.yaml"
    requested = ("teeth", "set", 142, "--kind", "wolfrom", "--planets", 3, "--range", "12:100")
    assert call(*requested, "-o", made).exit_code == 0
    (output,) = load(made).solve().outputs.values()
    assert output.ratio == Fraction(1, 142)
    assert "wolfrom" in call("teeth", "set", "--kind", "list").stdout
    requested = ("teeth", "orrery", "moon=29.53059", "venus=224.701", "--range", "12:120", "--tolerance", "1e-4")
    assert call(*requested, "-o", made, "--force").exit_code == 0
    found = load(made).solve()
    for name, period in (("moon", Fraction("29.53059")), ("venus", Fraction("224.701"))):
        assert abs(abs(found[name]) * period - 1) < Fraction(1, 10**4)


# cut and taken up ----------------------------------------------------------------------------------------------------

LONG = (
    *("teeth", "ratio", "13.36838", "--stages", "4", "--range", "12:120"),
    *("--tolerance", "1e-9", "--best", "5", "--json"),
)


def start(folder: Path, *more: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "geartrain", *LONG, *more]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=folder, stdout=pipe, stderr=pipe, text=True, start_new_session=True)


def wait_for_work(running: subprocess.Popen[str], folder: Path) -> None:
    """Until a task is in the journal below its head, or all is done."""

    def begun() -> bool:
        lines = (path.read_bytes().count(b"\n") for path in folder.glob("*.partial.jsonl"))
        return running.poll() is not None or max(lines, default=0) > 1

    until(begun, "a finished task")


@pytest.fixture(scope="module")
def uncut(tmp_path_factory: pytest.TempPathFactory) -> str:
    """What a search says that nobody cuts."""
    folder = tmp_path_factory.mktemp("whole")
    running = start(folder, "--workers", "1")
    said, _ = running.communicate(timeout=5 * PATIENCE)
    assert running.returncode == 0
    assert not list(folder.glob("*.partial.jsonl"))
    return said


@pytest.mark.parametrize("cut", first_few(1, [signal.SIGKILL, signal.SIGINT]), ids=["killed", "interrupted"])
def test_a_search_that_was_cut_is_taken_up_and_ends_the_same(cut: signal.Signals, uncut: str, tmp_path: Path) -> None:
    running = start(tmp_path, "--workers", "1")
    wait_for_work(running, tmp_path)
    os.killpg(running.pid, cut)
    out, err = running.communicate(timeout=5 * PATIENCE)
    kept = list(tmp_path.glob("*.partial.jsonl"))
    if running.returncode == 0 or (cut == signal.SIGINT and not kept and not out):  # what is cut prints its result
        pytest.skip("it ended before it was cut")
    assert kept
    if cut == signal.SIGINT:
        assert running.returncode == 130
        assert "--resume" in err
        assert json.loads(out)["complete"] is False
    again = start(tmp_path, "--resume", "--workers", "2")
    said, _ = again.communicate(timeout=5 * PATIENCE)
    assert again.returncode == 0
    assert said == uncut
    assert not list(tmp_path.rglob("*.partial.jsonl"))


def test_a_negative_ratio_is_no_option() -> None:
    found = answer("ratio", "-4", "--range", "12:48", "--stages", 1, "--best", 1)
    assert (found["wanted"]["sense"], found["solutions"][0]["teeth"]) == (-1, [[48], [12]])


def test_conditions_on_one_pair_hold_in_long_ranges_too() -> None:
    found = answer("ratio", "3", "--stages", 1, "--range", "12:100050", "--hunting", "--best", 3)
    assert [one["error"] != 0 for one in found["solutions"]] == [True] * 3  # 3 n over n is never coprime
    assert answer("ratio", "+3", "--stages", 1, "--range", "12:100050")["count"] == 0  # an external pair reverses


def test_a_file_is_written_in_the_form_of_its_name_whatever_is_printed(hands: Path) -> None:
    done = call("teeth", "ratio", "235/19", "--best", 1, "--workers", 1, "--json", "-o", "found.csv")
    assert json.loads(done.stdout)["solutions"]
    assert (hands.parent / "found.csv").read_text(encoding="utf-8").startswith("top,beneath,ratio")
    assert not call("teeth", "ratio", "235/19", "--best", 1, "--workers", 1, "--json", "-o", "found").stdout
    assert json.loads((hands.parent / "found").read_text(encoding="utf-8"))["solutions"]
