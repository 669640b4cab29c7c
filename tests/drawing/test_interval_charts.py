"""Charts of intervals show the figures of the tables, on one axis with its unit, with a row for each dial."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from commands import call
from shipped import train as load

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from seen_figure import alike
from test_words_in_pictures import faults_of

from geartrain import GearTrain
from geartrain import load as load_text
from geartrain.dynamics import MotionRun
from geartrain.errors import QuestionError
from geartrain.workshop import BudgetQuestion, find_budget, find_trial_plan, read_error_overrides

SHORT = {"turns": 0.5, "samples": 501}
SCREEN = 9.0, 9.0  # inches, 900 pixels
DAYS_A_YEAR = 365.24219  # of the train's unit, the tropical year


def names_of(figure: Figure, panel: int = 0) -> list[str]:
    return [label.get_text() for label in figure.axes[panel].get_yticklabels()]


def spans_of(figure: Figure, panel: int = 0) -> list[list[tuple[float, float]]]:
    """Return the ends of the intervals of each row."""
    lines = [line for line in figure.axes[panel].lines if line.get_gid() == "interval"]
    rows = [[line for line in lines if line.get_ydata()[0] == at] for at in range(len(names_of(figure, panel)))]
    return [[tuple(map(float, line.get_xdata())) for line in row] for row in rows]


def marks_of(figure: Figure, series: str) -> dict[str, float]:
    """Return the values of the marks of a series, by name of the row."""
    names = names_of(figure)
    found = [line for line in figure.axes[0].lines if line.get_gid() == series]
    return {names[int(y)]: float(x) for line in found for x, y in np.asarray(line.get_xydata())}


def cells_of(figure: Figure, panel: int = 0) -> list[list[str]]:
    """Return the cells next to the rows, the heads first."""
    cells = [text for text in figure.axes[panel].texts if text.get_gid() == "cell"]
    heights = sorted({text.xy[1] for text in cells})
    return [[text.get_text() for text in cells if text.xy[1] == height] for height in heights]


def drawn(train: GearTrain, outputs: tuple[str, ...] = (), turns: float = 0.5, samples: int = 501) -> Figure:
    return MotionRun(train.motion(outputs=outputs), turns, samples).plot()


def in_dials(train: GearTrain) -> set[str]:
    return {name for name, output in train.declaration.outputs.items() if output.dial}


def test_the_intervals_of_a_motion_are_the_figures_of_its_table() -> None:
    figure = drawn(load("moon-triangular"))
    table = json.loads(call("motion", "moon-triangular", "--turns", "0.5", "--samples", 501, "--json").output)[
        "outputs"
    ]
    assert names_of(figure) == ["moon", "sun"], "the largest error is at the top"
    errors = load("moon-triangular").motion().at(np.linspace(0.0, 0.5, 100_001)).error
    for name, (whole, middle) in zip(names_of(figure), spans_of(figure), strict=True):
        known = {key: np.degrees(value) for key, value in table[name]["transmission_error"].items()}
        assert np.diff(whole) == pytest.approx(known["peak_to_peak"])
        assert middle == pytest.approx((-known["rms"], known["rms"]))
        own = np.degrees(errors[["sun", "moon"].index(name)])
        assert whole == pytest.approx((own.min() - own.mean(), own.max() - own.mean()), abs=0.02 * np.ptp(own))
    assert figure.axes[0].get_xlabel().startswith("transmission error, less its mean (deg)")
    assert cells_of(figure)[0] == ["range"], "the train has no unit of time"


def test_the_anomaly_of_pins_is_not_in_the_error_of_teeth() -> None:
    """The same train without teeth has only the anomaly, at the same positions."""
    outputs, turns = ("moon", "mars"), np.linspace(0.0, 0.5, 5001)
    with_teeth, without = (load(name).motion(outputs=outputs) for name in ("freeth-2021-teeth", "freeth-2021"))
    teeth = np.degrees(with_teeth.at(turns).error - without.at(turns).error)
    figure = drawn(load("freeth-2021-teeth"), outputs, 0.5, 5001)
    known = dict(zip(outputs, np.ptp(teeth, axis=1), strict=True))
    assert known["moon"] < 10 < np.degrees(np.ptp(with_teeth.at(turns).error[0]))
    for name, (whole, _) in zip(names_of(figure), spans_of(figure), strict=True):
        assert np.diff(whole) == pytest.approx(known[name], rel=0.01)


def test_days_next_to_a_row_are_the_range_divided_by_the_speed() -> None:
    train = load("freeth-2021-teeth")
    figure = drawn(train)
    uniform = {"sun", "true_sun"}  # turn with the driving link
    assert set(names_of(figure)) == in_dials(train) - uniform
    assert set(figure.get_suptitle().partition("uniform: ")[2].split(", ")) == uniform
    heads, *rows = cells_of(figure)
    assert heads == ["range", "days"]
    speeds = {name: abs(float(output.speed)) for name, output in train.solve().outputs.items() if output.speed}
    for name, (degrees, days), (whole, _) in zip(names_of(figure), rows, spans_of(figure), strict=True):
        assert float(degrees.removesuffix("°")) == pytest.approx(np.ptp(whole), rel=0.005)
        assert float(days) == pytest.approx(np.ptp(whole) / 360 * DAYS_A_YEAR / speeds[name], rel=0.006)


def test_only_dials_have_rows_but_arbors_can_be_requested() -> None:
    train = load("longcase-clock-cycloidal")
    assert set(names_of(drawn(train))) == in_dials(train) == {"centre", "escape", "hour"}
    assert set(names_of(drawn(train, ("great", "third")))) == {"great", "third"}
    targets = {name for name, output in load("pennestri-2002-teeth").declaration.outputs.items() if output.targets}
    assert set(names_of(drawn(load("pennestri-2002-teeth"), turns=0.02, samples=21))) == targets


def test_uniform_motion_is_said_and_a_train_without_teeth_shows_its_anomaly() -> None:
    figure = drawn(load("nrel-grc-750"))
    assert "every output moves uniformly" in figure.get_suptitle()
    assert all(row == ["0°"] for row in cells_of(figure)[1:])
    assert drawn(load("freeth-2021")).axes[0].get_xlabel().startswith("anomaly, less its mean (deg)")


def test_any_number_of_pointers_fits_on_a_screen() -> None:
    train = load("freeth-2021-teeth")
    links = tuple(link for link in train.declaration.links if link != train.declaration.frame)
    figure = drawn(train, links, 0.02, 21)
    assert len(names_of(figure)) == 20
    assert "outputs with smaller errors are omitted: select them with --of" in figure.get_suptitle()
    assert not faults_of(figure)
    assert all(side <= most for side, most in zip(figure.get_size_inches(), SCREEN, strict=True))


def test_the_marks_of_a_budget_are_the_figures_of_its_table() -> None:
    budget = find_budget(load("freeth-2021-teeth"), BudgetQuestion(outputs=("moon", "saros", "metonic"), **SHORT))
    figure = budget.plot()
    assert names_of(figure) == sorted(budget.shown, key=lambda name: -budget[name].total)
    assert figure.axes[0].get_xscale() == "log"
    assert "(deg)" in figure.axes[0].get_xlabel()
    table = budget.columns
    rows = zip(table["pointer"], table["cause"], table["degrees"], strict=True)
    known = {(name, cause): size for name, cause, size in rows if size}
    whole = {(name, cause): size for cause in table["cause"] for name, size in marks_of(figure, cause).items()}
    part = {(name, cause): x for cause in table["cause"] for name, x in marks_of(figure, f"{cause}, in part").items()}
    assert {**whole, **part} == pytest.approx(known)
    assert part.keys() == {each for each in known if budget[each[0]][each[1]].declared == "part"}
    for name, (total, days) in zip(names_of(figure), cells_of(figure)[1:], strict=True):
        size = sum(value for (of, _), value in known.items() if of == name)
        assert float(total.removesuffix("°")) == pytest.approx(size, rel=0.005)
        assert float(days) == pytest.approx(size / budget[name].degrees_per_day, rel=0.006)
    assert not alike(figure)


def test_a_budget_shows_its_dials() -> None:
    train = load("freeth-2021-teeth")
    budget = find_budget(train, BudgetQuestion(turns=0.02, samples=51))
    assert set(budget.shown) == in_dials(train) < {pointer.name for pointer in budget.pointers}


def test_trials_show_the_dials_of_a_train() -> None:
    train = load("longcase-clock-cycloidal")
    plan = find_trial_plan(train, read_error_overrides(["pitch_deviation=1 %"]))
    assert plan.shown.keys() == in_dials(train) < set(plan.outputs)
    assert plan.shown["hour"] == pytest.approx(720), "two turns a day"


def test_a_torque_fills_its_axis_and_the_dots_are_the_mean_losses() -> None:
    found = load("planetary-24-18-60-triangular").torques(turns=1, samples=2000)
    figure = found.plot()
    above, below = figure.axes
    assert above.get_ylabel() == "torque at sun (mN m)"
    assert found.minimum is not None
    assert found.maximum is not None
    low, high = above.get_ylim()
    assert 1000 * (found.maximum.torque - found.minimum.torque) > 0.9 * (high - low)
    assert below.get_xlabel().startswith("losses, as torque at sun (mN m)")
    dots = next(line for line in below.lines if line.get_gid() == "mean").get_xdata()
    # the sun is the input, so its mean torque of a loss is the energy divided by the angle of the run
    assert [*dots] == pytest.approx([1000 * found.parts[name].loss / (2 * np.pi) for name in ("s~p", "p~ring")])
    for name, ((low, high),) in zip(("s~p", "p~ring"), spans_of(figure, 1), strict=True):
        power = found.losses.values[found.losses.labels[0].index(name)]
        assert (low, high) == pytest.approx((1000 * power.min(), 1000 * power.max()))


LATHE = """
extends: lathe-thread
name: lathe-with-teeth
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
"""
LEAD = 6.0  # mm of carriage per turn of the lead screw


def test_columns_of_a_link_that_slides_are_in_millimetres_as_their_cells() -> None:
    """The carriage follows the lead screw exactly, so its error is that of the screw times the lead over a turn."""
    train = load_text(LATHE)
    run = train.motion().run(turns=2, samples=501)
    screw, carriage = ({tally.name: tally for tally in run.statistics}[name] for name in ("leadscrew", "carriage"))
    assert (screw.unit, carriage.unit) == ("rad", "mm")
    for figure in ("peak_to_peak", "rms"):
        assert getattr(carriage, figure) == pytest.approx(getattr(screw, figure) / (2 * np.pi) * LEAD)
    assert run.motion.sensitivity["carriage"]["a~i"] == pytest.approx(
        -run.motion.sensitivity["leadscrew"]["a~i"] / (2 * np.pi) * LEAD
    )
    figure = run.plot()
    assert [names_of(figure, panel) for panel in (0, 1)] == [["handwheel", "leadscrew"], ["carriage"]]
    assert [f"({unit})" in axes.get_xlabel() for unit, axes in zip(("deg", "mm"), figure.axes, strict=True)] == [
        True
    ] * 2
    assert np.diff(spans_of(figure, 1)[0][0]) == pytest.approx(carriage.peak_to_peak)


def test_frames_of_a_link_that_slides_are_in_millimetres() -> None:
    pytest.importorskip("pandas")
    train = load_text(LATHE)
    run = train.motion().run(turns=2, samples=501)
    carriage = next(tally for tally in run.statistics if tally.name == "carriage")
    frame = run.to_frame().set_index("output")
    assert frame["error p-p (mm)"]["carriage"] == carriage.peak_to_peak
    assert np.isnan(frame["error p-p (rad)"]["carriage"])
    assert frame.attrs["units"].keys() >= {"error p-p (mm)", "mean travel"}
    assert all(frame.attrs["units"][f"error p-p ({unit})"] == unit for unit in ("rad", "mm"))
    curve = train.motion().transmission_error("carriage", 2, 501)
    assert curve.to_frame().attrs["units"]["error"] == "mm"


def test_tables_of_motion_have_the_unit_of_their_cells_in_every_section(tmp_path: Path) -> None:
    path = tmp_path / "lathe.yaml"
    path.write_text(LATHE, encoding="utf-8")
    options = ("--turns", "1", "--samples", 201, "--spectrum", "--phases", "1", "--of", "carriage")
    text = call("motion", path, *options, "-o", "-").output
    assert "(mm)" in text
    assert "(deg)" not in text
    assert not re.search(r"\d mm\b", text), "units are in the heads of columns"
    table = json.loads(call("motion", path, *options, "--json").output)["outputs"]["carriage"]
    spectrum = table["spectrum"][0]["measured"]
    assert table["unit"] == "mm"
    assert 0 < spectrum < table["transmission_error"]["peak_to_peak"]
    rows = tmp_path / "rows.csv"
    call("motion", path, "--turns", "1", "--samples", 11, "--of", "carriage", "--of", "leadscrew", "-o", rows)
    with rows.open(encoding="utf-8") as lines:
        table = list(csv.DictReader(lines))
    for row in table:
        angle = float(row["leadscrew angle (rad)"]) - float(table[0]["leadscrew angle (rad)"])
        travel = float(row["carriage travel (mm)"]) - float(table[0]["carriage travel (mm)"])
        assert travel == pytest.approx(-angle / (2 * np.pi) * LEAD, abs=1e-12)


def test_errors_of_pointers_are_not_computed_for_slides() -> None:
    train = load_text(LATHE)
    assert "carriage" not in find_trial_plan(train, read_error_overrides(["pitch_deviation=1 %"])).outputs
    with pytest.raises(QuestionError, match="'carriage' slides"):
        find_budget(train, BudgetQuestion(outputs=("carriage",), **SHORT))
