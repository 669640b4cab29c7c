"""`geartrain posterior`, as a user runs it."""

from __future__ import annotations

import csv
import io
import json
from fractions import Fraction
from pathlib import Path

import pytest
from commands import call

TRAIN = """
name: pair
links:
  frame: {}
  a: {wheels: {w: {teeth: {value: 20, range: [18, 22]}}}}
  b: {wheels: {v: {teeth: {value: 60, choices: [58, 60, 62]}}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [w, v]}]
inputs: {a: 1}
outputs:
  b: {targets: [{speed: -1/3, tolerance: 4 %}]}
"""
FITS = {
    (w, v) for w in range(18, 23) for v in (58, 60, 62) if abs(Fraction(w, v) / Fraction(1, 3) - 1) <= Fraction(4, 100)
}


@pytest.fixture
def train(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "pair.yaml"
    path.write_text(TRAIN)
    return path


def test_a_sweep_lists_what_fits_and_leaves_no_journal(train: Path) -> None:
    result = call("posterior", train)
    assert result.exit_code == 0
    assert f"{len(FITS)} fit" in result.stdout
    assert "Best combinations" in result.stdout
    assert [path.name for path in train.parent.iterdir()] == ["pair.yaml"]


def test_json_csv_and_parquet_hold_the_same_combinations(train: Path) -> None:
    plain = json.loads(call("posterior", train, "--json").stdout)
    assert {(one["teeth"]["w"], one["teeth"]["v"]) for one in plain["best"]} == FITS
    assert Fraction(plain["evidence"]["exact"]) == Fraction(len(FITS), 15)
    assert plain["fits"] == len(FITS)
    assert call("posterior", train, "-o", "out.csv").exit_code == 0
    rows = list(csv.DictReader(io.StringIO(Path("out.csv").read_text())))
    assert {(int(row["w"]), int(row["v"])) for row in rows} == FITS
    for row in rows:
        assert float(row["speed of b"]) == pytest.approx(-int(row["w"]) / int(row["v"]), rel=1e-15)
    parquet = pytest.importorskip("pyarrow.parquet")
    assert call("posterior", train, "-o", "out.parquet").exit_code == 0
    table = parquet.read_table("out.parquet").to_pylist()
    assert [(row["w"], row["v"], row["misfit"]) for row in table] == [
        (int(row["w"]), int(row["v"]), float(row["misfit"])) for row in rows
    ]


def test_pages_are_written_whole(train: Path) -> None:
    assert call("posterior", train, "-o", "out.md").exit_code == 0
    assert Path("out.md").read_text().startswith("# Uncertain tooth counts of pair")
    assert call("posterior", train, "-o", "out.html").exit_code == 0
    assert "Sensitivity of outputs to tooth counts" in Path("out.html").read_text()


def test_counts_are_freed_held_and_weighed_by_options(train: Path) -> None:
    plain = json.loads(call("posterior", train, "--free", "w=20", "--free", "v=57,59:61", "--json").stdout)
    assert plain["wheels"]["v"]["counts"] == [57, 59, 60, 61]
    assert plain["wheels"]["w"]["counts"] == [20]
    assert plain["combinations"] == 4
    assert json.loads(call("posterior", train, "--gaussian", "--json").stdout)["soft"] is True
    tight = json.loads(call("posterior", train, "--scale", "0", "--json").stdout)
    assert {(one["teeth"]["w"], one["teeth"]["v"]) for one in tight["best"]} == {(20, 60)}


def test_nothing_that_fits_is_an_answer_and_exit_1(train: Path) -> None:
    result = call("posterior", train, "--free", "w=40:45")
    assert result.exit_code == 1
    assert "None of them fits" in result.stdout


def test_a_sample_may_be_resumed_and_another_question_is_refused(train: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from geartrain.search.posterior import inference as sweeping

    options = ("--method", "sample", "--samples", "100000", "--json")
    whole = json.loads(call("posterior", train, *options).stdout)
    real = sweeping.PosteriorTally.join

    def cut(tally: sweeping.PosteriorTally, other: dict[str, object]) -> None:
        real(tally, other)
        if tally.examined > 50_000:
            raise KeyboardInterrupt

    monkeypatch.setattr(sweeping.PosteriorTally, "join", cut)
    result = call("posterior", train, *options)
    assert result.exit_code == 130
    assert json.loads(result.stdout)["ended"] == "interrupted"
    monkeypatch.setattr(sweeping.PosteriorTally, "join", real)
    assert len(list(train.parent.glob("*.partial.jsonl"))) == 1
    other = call("posterior", train, "--method", "sample", "--samples", "90000", "--resume")
    assert other.exit_code != 0
    assert "another run" in str(other.exception)
    assert json.loads(call("posterior", train, *options, "--resume").stdout) == whole
    assert not list(train.parent.glob("*.partial.jsonl"))


def test_an_interrupted_exact_run_prints_a_short_sample_and_keeps_nothing(
    train: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("geartrain.search.posterior.inference.find_exact_posterior", interrupted)
    result = call("posterior", train, "--method", "exact", "--json")
    assert result.exit_code == 130
    found = json.loads(result.stdout)
    assert (found["ended"], found["method"], found["ranked"]) == ("interrupted", "sample", False)
    assert any("has no partial result" in remark for remark in found["remarks"])
    assert found["examined"] == 1 << 16
    assert float(found["evidence"]["low"]) < len(FITS) / 15 < float(found["evidence"]["high"])
    assert "stopped before any work was finished" in result.stderr
    few = json.loads(call("posterior", train, "--method", "exact", "--samples", "1000", "--json").stdout)
    assert few["examined"] == 1000, "no more is drawn than was allowed"
    assert not list(train.parent.glob("*.partial.jsonl"))
