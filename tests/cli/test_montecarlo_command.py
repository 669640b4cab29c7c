"""`geartrain montecarlo`: what is written and read back, what is refused, and what an interrupted run leaves."""

from __future__ import annotations

import csv
import json
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from commands import call

from geartrain import GearTrainError, load
from geartrain.errors import QuestionError
from geartrain.numerics.files import ColumnTable
from geartrain.workshop import find_trial_plan, read_error_overrides, run_trials

PAIR = """
    name: pair
    links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: 15}}}
    revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    gears: [{pair: [p, w]}]
    inputs: {a: 1}
    outputs: {b: {}}
    tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}
    cutting: {pitch_deviation: {normal: 2 %}}
"""
Write = Callable[..., Path]


def ask(*words: object) -> Any:
    return call("montecarlo", *words)


# -------------------------------------------------------------------------------------------------------------- answers


@pytest.mark.needs("pyarrow")
def test_parquet_csv_and_json_tell_the_same_trials(train_file: Write, here: Path) -> None:
    import pyarrow.parquet

    train = train_file(PAIR)
    for name in ("t.parquet", "t.csv", "t.json", "t.md", "t.html"):
        found = ask(train, "--trials", 300, "-o", here / name)
        assert found.exit_code == 0, found.output
    columns = pyarrow.parquet.read_table(here / "t.parquet").to_pydict()
    with (here / "t.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert columns["trial"] == list(range(300))
    assert pyarrow.parquet.ParquetFile(here / "t.parquet").metadata.num_row_groups > 1
    for name, column in columns.items():
        assert [float(row[name]) for row in rows] == column
    told = json.loads((here / "t.json").read_text())
    jams = sum(backlash < 0 for backlash in columns["p~w backlash (pitches)"])
    assert told["pairs"][0]["jam"]["count"] == jams == sum(mark % 2 for mark in columns["p~w events"])
    free = [error for error, mark in zip(columns["b error (deg)"], columns["p~w events"], strict=True) if not mark & 25]
    mean = sum(free) / len(free)
    assert told["outputs"][0]["mean_deg"][0] == pytest.approx(mean)
    assert told["outputs"][0]["stopped"] == 300 - len(free)
    assert "| p~w " in (here / "t.md").read_text()
    assert not list(here.glob("*partial*")), "whole runs leave nothing behind"


def test_everything_that_can_be_requested_stands_in_one_document(train_file: Write, here: Path) -> None:
    found = ask(
        train_file(PAIR),
        *("--trials", 128, "--of", "b", "--vary", "clearance_factor=1.01:1.03:2", "--sobol"),
        "--json",
    )
    assert found.exit_code == 0, found.output
    told = json.loads(found.stdout)
    assert [each["clearance"] for each in told["clearances"]] == [1.01, 1.03]
    assert {each["by"] for each in told["indices"]} == {"wheel", "kind"}
    assert len(told["courses"][0]["bands_deg"]) == 7
    assert "NaN" not in found.stdout


@pytest.mark.needs("pyarrow")
def test_an_interrupted_run_says_so_and_is_taken_up(
    train_file: Write, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import pyarrow.parquet

    from geartrain.workshop.monte_carlo import trial_run as running

    train, work = train_file(PAIR), running.work_block
    words = (train, "--trials", 700, "--seed", 3, "-o", here / "t.parquet")

    def interrupted(plan: Any, seed: int, task: list[int]) -> dict[str, Any]:
        if task[0] == 512:
            raise KeyboardInterrupt
        return work(plan, seed, task)

    monkeypatch.setattr(running, "work_block", interrupted)
    cut = ask(*words)
    assert cut.exit_code == 130
    assert "stopped after 512 of 700" in cut.output
    assert "--resume" in cut.output
    assert not (here / "t.parquet").exists()
    counted: list[int] = []
    monkeypatch.setattr(
        running, "work_block", lambda plan, seed, task: counted.append(task[0]) or work(plan, seed, task)
    )
    assert ask(*words, "--resume").exit_code == 0
    assert min(counted) == 512, "what was done is not done again"
    monkeypatch.undo()
    whole = here / "whole.parquet"
    assert ask(train, "--trials", 700, "--seed", 3, "-o", whole).exit_code == 0
    assert pyarrow.parquet.read_table(whole).equals(pyarrow.parquet.read_table(here / "t.parquet"))


def test_a_journal_of_another_question_is_refused(train_file: Write, here: Path) -> None:
    from geartrain.numerics import Journal
    from geartrain.workshop.monte_carlo.trial_run import journal_key

    plan = find_trial_plan(load(train_file(PAIR)))
    requested = journal_key(plan, 1, 300)
    Journal(here / "j", requested).close()
    others = [
        *(journal_key(plan, 2, 300), journal_key(plan, 1, 301), requested | {"geartrain": "0.0.0"}),
        *(journal_key(each, 1, 300) for each in (plan.scaled(1.01), plan.cleared(1.03))),
    ]
    for other in others:
        with pytest.raises(QuestionError, match="another run"):
            Journal(here / "j", other)
    Journal(here / "j", requested).close()


@pytest.mark.needs("pyarrow")
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a full device")
def test_a_full_disk_is_said_and_the_name_requested_for_is_not_taken(here: Path) -> None:
    path = here / "t.parquet"
    os.symlink("/dev/full", here / "t.partial.parquet")

    def fill() -> None:
        with ColumnTable(path, {}) as table:
            for _ in range(300):
                table.write({"a": list(range(20_000))})

    with pytest.raises(GearTrainError) as caught:
        fill()
    problem = caught.value.problems[0]
    assert problem.what
    assert problem.why
    assert problem.fix
    assert not path.exists()


# ------------------------------------------------------------------------------------------------------------- refusals


def test_shares_of_pairs_need_trials_that_turn(train_file: Write, here: Path) -> None:
    refused = ask(train_file(PAIR), "--trials", 1, "--plot", here / "x.svg", "--picture", "pairs")
    assert "variance shares need two trials in which the train turns" in str(refused.exception)


def test_trains_that_cannot_be_cut_are_refused_without_a_journal(train_file: Write, here: Path) -> None:
    refused = ask(train_file(PAIR), "--cutting", "pitch_deviation=45 %")
    assert "cannot be cut" in str(refused.exception)
    assert list(here.glob("*.jsonl")) == []
    bare = train_file(PAIR.replace("tooth_form", "note: ideal teeth #"), "bare.yaml")
    with pytest.raises(QuestionError, match="no tooth form"):
        find_trial_plan(load(bare), read_error_overrides(["pitch_deviation=2 %"]))
    loop = """
        links: {frame: {}, a: {wheels: {p: 20, q: 20}}, b: {wheels: {w: 15, v: 15}}}
        revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
        gears: [{id: one, pair: [p, w]}, {id: two, pair: [q, v]}]
        inputs: {a: 1}
        tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}
        cutting: {pitch_deviation: {normal: 2 %}}
    """
    closed = load(train_file(loop, "loop.yaml"))
    with pytest.raises(GearTrainError, match="form a loop"):
        find_trial_plan(closed)
    assert find_trial_plan(closed, without=("two",)).pairs[0].name == "one"


def test_without_its_extra_it_says_which_one(train_file: Write, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    refused = ask(train_file(PAIR), "--trials", 2, "-o", here / "t.parquet")
    assert "pip install 'pandas>=2.2' 'pyarrow>=16'" in str(refused.exception)


def test_a_few_wheels_that_cannot_be_cut_are_left_out_and_said(train_file: Write) -> None:
    plan = find_trial_plan(load(train_file(PAIR)), read_error_overrides(["pitch_deviation=22 %"]))
    found = run_trials(plan, 256)
    uncut = found.train.uncut
    assert 0 < uncut < 128
    assert found.train.events["jam"].of == 256 - uncut
