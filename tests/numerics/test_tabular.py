"""Results as tables: rows are those of the answer, in frames, in records and in HTML."""

from __future__ import annotations

import sys
from functools import cache
from typing import Any

import numpy as np
import pytest

import geartrain
from geartrain.analysis import find_gears
from geartrain.errors import MissingExtraError
from geartrain.numerics import LabelledArray


@cache
def tables() -> dict[str, Any]:
    box, set_ = geartrain.load("zf-8hp70"), geartrain.load("planetary-24-18-60")
    loaded = geartrain.load("longcase-clock-loaded")
    return {
        "answer": set_.solve(),
        "torques": loaded.torques(),
        "gearbox": box.gearbox(),
        "variants": set_.variants({"s": range(20, 30)}),
        "cycle": loaded.torques(turns=0.01),
        "search": find_gears(box),
        "strength": loaded.strength(),
        "array": set_.kinematics.floats(inputs={"sun": [7.0, 14.0]}).speeds,
    }


@pytest.mark.needs("pandas")
@pytest.mark.parametrize("name", ["answer", "torques", "gearbox", "variants", "cycle", "search", "strength", "array"])
def test_frames_and_records_hold_the_columns_with_meanings_and_units(name: str) -> None:
    table = tables()[name]
    frame, records = table.to_frame(), table.to_records()
    assert list(frame.columns) == list(table.columns) == list(records.dtype.names)
    assert len(frame) == len(records) > 0
    for column, values in table.columns.items():
        given = [value for value in values if value is not None]
        assert frame[column].dropna().tolist() == [value for value in given if value == value]
    assert table._repr_html_().startswith("<")
    assert [*frame.attrs["meanings"]] == [*frame.columns]
    assert all(frame.attrs["meanings"].values())
    units = frame.attrs["units"]
    assert all(f"[{unit}]" in frame.attrs["meanings"][column] for column, unit in units.items())


@pytest.mark.needs("pandas")
def test_columns_that_are_fields_say_what_they_mean() -> None:
    assert tables()["cycle"].to_frame().attrs["meanings"]["turns"].startswith("Positions of the input")
    assert '<th title="Tooth count of the wheel.">' in tables()["variants"]._repr_html_()


@pytest.mark.needs("pandas")
def test_an_answer_is_exact_beside_its_floats() -> None:
    frame = geartrain.load("planetary-24-18-60").solve().to_frame().set_index("link")
    assert frame.exact["carrier"] == "2/7"
    assert frame.speed["carrier"] == 2 / 7


def test_a_gearbox_has_a_row_a_state() -> None:
    records = geartrain.load("zf-8hp70").gearbox().to_records()
    first = records[records["state"] == "1"]
    assert first["ratio"] == pytest.approx(4.696, abs=5e-4)
    assert records["engaged"][0].count(",") == 2


def test_every_gear_there_is_has_a_row() -> None:
    records = find_gears(geartrain.load("zf-8hp70")).to_records()
    assert len(records) == 9
    assert records["exact"][0] == "108/23"
    assert set(records["states"]) == {*"12345678R"}


def test_trials_and_budgets_have_rows_of_trials_and_of_causes() -> None:
    from geartrain.workshop import find_budget

    train = geartrain.load("moon-triangular")
    budget = find_budget(train)
    rows = budget.to_records()
    assert len(rows) == sum(len(pointer.causes) for pointer in budget.pointers)
    for row in rows:
        known = budget[row["pointer"]][row["cause"]].degrees
        assert row["degrees"] == known or (known is None and row["degrees"] != row["degrees"])


def test_a_run_in_time_has_a_row_a_sample() -> None:
    found = geartrain.load("moon-triangular-inertia").dynamics(rate=1.0, turns=0.02, skip=0.01)
    columns = found.columns
    assert columns["time (s)"] == found.time.tolist()
    link = found.speeds.labels[0][-1]
    assert columns[f"{link} speed (rad/s)"] == found.speeds[link].tolist()
    assert found.to_csv().splitlines()[0] == ",".join(columns)
    assert len(found.to_csv().splitlines()) == 1 + len(found.time)


@pytest.mark.needs("pandas")
def test_counts_in_doubt_have_a_row_a_count() -> None:
    from geartrain.search import infer_counts

    found = infer_counts(geartrain.load("freeth-2008-doubt").declaration)
    frame = found.to_frame()
    assert len(frame) == sum(len(each.uncertainty.counts) for each in found.posteriors.values())
    for _, rows in frame.groupby("wheel"):
        assert rows.prior.sum() == pytest.approx(1)
        assert rows.posterior.sum() == pytest.approx(1)
    chance = frame.set_index(["wheel", "teeth"]).posterior
    assert all(chance[wheel, each.likeliest] == chance[wheel].max() for wheel, each in found.posteriors.items())


@pytest.mark.needs("pandas")
def test_a_run_of_a_motion_has_a_row_an_output() -> None:
    from geartrain.dynamics import MotionRun

    run = MotionRun(geartrain.load("moon-triangular").motion(outputs=["moon"]), turns=1, samples=2001)
    assert len(run.to_frame()) == 0, "before it is counted"
    run.run()
    (row,) = run.to_records()
    assert row["exact"] == "254/95"
    assert row["error p-p (rad)"] == pytest.approx(0.103, abs=5e-4)
    assert row["slowest"] < 1 < row["fastest"]


@pytest.mark.needs("pandas")
def test_best_sizes_have_a_row_a_design() -> None:
    from geartrain.workshop import ToothSizes, find_tooth_sizes

    start = ToothSizes((48, 96), 1.0, 0.5, (np.pi / 6, np.pi / 6), 0.2)
    found = find_tooth_sizes(start, free={"radii": (0.95, 1.0)})
    frame = found.to_frame().set_index("design")
    assert frame.loss["best"] == found.best.loss <= frame.loss["equal depth"]
    assert frame.half_angle_1["best"] == pytest.approx(np.pi / 6)
    assert (frame.loss.drop("best") >= frame.loss["best"]).all()


def test_arrays_of_any_number_of_axes() -> None:
    values = np.arange(6.0)
    links, cases = ("a", "b"), ("0", "1", "2")
    one = LabelledArray(values, ("link",), (tuple("abcdef"),)).columns
    two = LabelledArray(values.reshape(2, 3), ("link", "case"), (links, cases)).columns
    three = LabelledArray(values.reshape(1, 2, 3), ("state", "link", "case"), (("s",), links, cases)).columns
    assert one["value"] == [0, 1, 2, 3, 4, 5]
    assert two == {"case": ("0", "1", "2"), "a": [0, 1, 2], "b": [3, 4, 5]}
    assert three["link"] == ["a", "a", "a", "b", "b", "b"]
    assert three["value"] == one["value"]


def test_without_pandas_it_is_said_what_brings_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtraError, match="tables"):
        geartrain.load("planetary-24-18-60").solve().to_frame()
