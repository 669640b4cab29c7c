"""Pictures of uncertainty: drawn values equal the given ones, and data that cannot be drawn are refused."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from commands import call

pytest.importorskip("matplotlib")

from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from seen_figure import alike

from geartrain import load
from geartrain.errors import QuestionError
from geartrain.numerics import IntervalEstimate
from geartrain.search import counts_figure, infer_counts, joint_posterior, most_informative_wheels
from geartrain.workshop import (
    MonteCarloResult,
    PointerErrorCourse,
    SobolIndices,
    find_trial_plan,
    jamming_map,
    read_error_overrides,
    run_course,
    run_trials,
)
from geartrain.workshop.monte_carlo.sobol_indices import SobolIndex

RNG = np.random.default_rng(1)
TURNS = np.linspace(0, 2, 50)
ERRORS = RNG.normal(size=(41, 1)) * np.sin(np.pi * TURNS) + 0.1


MAP_X, MAP_Y = np.linspace(1.0, 1.03, 5), np.linspace(1, 8, 6)


def line(figure: Figure, gid: str, panel: int = 0) -> np.ndarray:
    """Return the points of the line with a name."""
    (found,) = [each for each in figure.axes[panel].lines if each.get_gid() == gid]
    return np.array(found.get_xydata())


def course(errors: np.ndarray, name: str = "moon") -> PointerErrorCourse:
    """Return the course of errors [deg] over two turns."""
    return PointerErrorCourse(name, TURNS, np.radians(errors))


def test_the_bands_that_are_drawn_are_those_of_the_trials_that_turn(findings: MonteCarloResult) -> None:
    jams = np.full((3, 50), np.nan)
    drawn = [course(np.vstack((ERRORS, jams))), course(2 * ERRORS, "sun")]
    figure = replace(findings, courses=drawn).plot("course")
    assert line(figure, "median") == pytest.approx(np.stack((TURNS, np.median(ERRORS, axis=0)), axis=1))
    assert line(figure, "one") == pytest.approx(np.stack((TURNS, ERRORS[0]), axis=1))
    for share, low, high in (("every trial", 0, 1), ("95 % of the trials", 0.025, 0.975), ("50 %", 0.25, 0.75)):
        (band,) = [each for each in figure.axes[0].collections if each.get_gid() == share]
        y = band.get_paths()[0].vertices[:, 1]
        ends = np.quantile(ERRORS, low, axis=0).min(), np.quantile(ERRORS, high, axis=0).max()
        assert (np.min(y), np.max(y)) == pytest.approx(ends)
    assert [axes.get_ylabel().split("\n")[0] for axes in figure.axes] == ["moon", "sun"]


def test_each_pointer_is_drawn_over_its_own_turn_and_the_key_is_as_dark_as_its_bands(
    findings: MonteCarloResult,
) -> None:
    turns = {"moon": np.linspace(0, 0.1, 30), "sun": np.linspace(0, 4, 30)}
    courses = [PointerErrorCourse(name, each, RNG.normal(size=(20, 30))) for name, each in turns.items()]
    figure = replace(findings, courses=courses).plot("course")
    assert [axes.get_xlim()[1] for axes in figure.axes] == [0.1, 4.0]
    assert not alike(figure)
    assert not alike(figure, "light")
    through = 1.0
    for band, key in zip(figure.axes[0].collections, figure.legends[0].get_patches(), strict=True):
        through *= 1 - band.get_alpha()
        assert key.get_alpha() == pytest.approx(1 - through)


def sure(value: float) -> IntervalEstimate:
    """Return an estimate with an interval of width 0."""
    return IntervalEstimate(value, value, value)


def shares(findings: MonteCarloResult, indices: Iterable[SobolIndex]) -> Figure:
    """Return the picture of Sobol indices of one pointer."""
    return replace(findings, indices=[SobolIndices("moon", "wheel", 64, tuple(indices))]).plot("sobol")


def test_shares_are_sorted_and_have_their_intervals(findings: MonteCarloResult) -> None:
    figure = shares(
        findings,
        (
            SobolIndex("a", IntervalEstimate(0.1, 0.05, 0.15), IntervalEstimate(0.2, 0.1, 0.3)),
            SobolIndex("b", sure(0.3), sure(0.5)),
            SobolIndex("c", IntervalEstimate(0.2, 0.1, 0.4), sure(0.1)),
        ),
    )
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.get_yticklabels()] == ["b", "a", "c"]
    assert line(figure, "first order").tolist() == [[0.3, 0], [0.1, 1], [0.2, 2]]
    assert line(figure, "total, with interactions").tolist() == [[0.5, 0], [0.2, 1], [0.1, 2]]
    ends = [tuple(each.get_xdata()) for each in axes.lines if each.get_gid() == "interval" and np.ptp(each.get_xdata())]
    assert ends == [(0.1, 0.3), (0.05, 0.15), (0.1, 0.4)]
    assert axes.get_ylim()[0] > axes.get_ylim()[1], "the largest share is on top"


def test_what_does_not_fit_is_counted(findings: MonteCarloResult) -> None:
    many = [SobolIndex(str(at), sure(1 / (at + 1)), sure(1 / (at + 1))) for at in range(30)]
    (axes,) = shares(findings, many).axes
    assert len(axes.get_yticklabels()) == 20
    assert "10 more causes of at most 0.048" in axes.get_xlabel()


DOUBTFUL = """
name: doubtful
frame: frame
links:
  frame: {}
  a: {wheels: {p: {teeth: {value: 20, range: [18, 22]}}}}
  b: {wheels: {q: {teeth: {value: 40, choices: [38, 40, 43]}}, r: {teeth: {value: 12, range: [11, 14]}}}}
  c: {wheels: {s: {teeth: {value: 36, range: [34, 37]}}}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
  - {pair: [frame, c], axis: C}
gears:
  - {pair: [p, q]}
  - {pair: [r, s]}
inputs: {a: 1}
outputs: {c: {expect: {value: 0.167, tolerance: 0.006}}}
"""
RANGES = {"p": range(18, 23), "q": (38, 40, 43), "r": range(11, 15), "s": range(34, 38)}


def test_pairs_of_counts_are_those_of_all_combinations_that_fit() -> None:
    fitting = [
        teeth
        for teeth in product(*RANGES.values())
        if abs(Fraction(teeth[0] * teeth[2], teeth[1] * teeth[3]) - Fraction("0.167")) <= Fraction("0.006")
    ]
    train = load(DOUBTFUL).declaration
    found = infer_counts(train)
    wheels = most_informative_wheels(found)
    assert wheels == list(RANGES)
    pairs = joint_posterior(found, wheels, lambda held: infer_counts(train, free=held))
    assert len(pairs) == 6
    for (a, b), chances in pairs.items():
        places = wheels.index(a), wheels.index(b)
        seen = Counter((teeth[places[0]], teeth[places[1]]) for teeth in fitting)
        assert chances == pytest.approx({both: count / len(fitting) for both, count in seen.items()})
    assert len(most_informative_wheels(found, 2)) == 2
    figure = counts_figure(found, pairs)
    bars = figure.axes[0].patches
    alone = Counter(teeth[0] for teeth in fitting)
    (mesh,) = [each for each in figure.axes[len(wheels)].collections if isinstance(each, QuadMesh)]
    assert sum(np.ravel(mesh.get_array())) == pytest.approx(1)
    assert max(np.ravel(mesh.get_array())) == pytest.approx(max(pairs["p", "q"].values()))
    for bar in bars[: len(alone)]:
        count = round(bar.get_x() + bar.get_width() / 2)
        assert bar.get_height() == pytest.approx(alone[count] / len(fitting))


def test_where_nothing_fits_nothing_is_drawn() -> None:
    train = load(DOUBTFUL.replace("0.167, tolerance: 0.006", "5, tolerance: 0.001")).declaration
    found = infer_counts(train)
    with pytest.raises(QuestionError, match="nothing to draw"):
        counts_figure(found, joint_posterior(found, ["p", "q"], lambda held: infer_counts(train, free=held)))


@pytest.fixture(scope="module")
def findings() -> MonteCarloResult:
    plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=1 %"]), ("moon",))
    trials = run_trials(plan, 300)
    cleared = jamming_map(plan, [0.3, 0.6], [0.5, 4.0], 20)
    return MonteCarloResult(trials, cleared, [run_course(plan, 0, 12, 1, 20)])


def test_pictures_of_trials_show_their_trials(findings: MonteCarloResult) -> None:
    trials = findings.trials
    errors = findings.plot()
    known = np.array(trials.columns["moon error (deg)"])
    turns = ~(trials.marks & 0b11001).any(axis=1)
    turning = known[turns if turns.sum() >= 30 else np.isfinite(known)]
    assert line(errors, "median")[0, 0] == pytest.approx(np.median(turning))
    ends = [each.get_xdata() for each in errors.axes[0].lines if each.get_gid() == "interval"]
    assert ends == [pytest.approx(np.quantile(turning, share)) for share in ((0.025, 0.975), (0.25, 0.75))]
    course = findings.plot("course")
    assert line(course, "median")[:, 1] == pytest.approx(np.degrees(np.median(findings.courses[0].errors, axis=0)))
    (axes,) = findings.plot("pairs").axes
    (shares,) = [each for each in axes.lines if each.get_gid() == "first order"]
    assert sum(shares.get_xdata()) == pytest.approx(1)
    converged = line(findings.plot("convergence"), "any pair")
    assert converged[-1, 0] == 300
    assert converged[-1, 1] == pytest.approx((trials.marks & 1).any(axis=1).mean())
    figure = findings.plot("map")
    (mesh,) = [each for each in figure.axes[0].collections if each.get_gid() == "map"]
    seen = np.array(mesh.get_array()).reshape(2, 2)
    for each in findings.cleared:
        at = [0.5, 4.0].index(each.scale), [0.3, 0.6].index(each.clearance or 0)
        assert seen[at] == each.events["jam"].value


def test_pictures_of_what_was_not_requested_are_refused(findings: MonteCarloResult) -> None:
    bare = MonteCarloResult(findings.trials)
    for picture in ("course", "sobol", "map", "colour"):
        with pytest.raises(QuestionError) as caught:
            bare.plot(picture)
        assert all(problem.fix for problem in caught.value.problems)


def test_the_command_draws_what_it_is_requested_for(tmp_path: Path) -> None:
    train = tmp_path / "pair.yaml"
    train.write_text(PAIR, encoding="utf-8")
    plot = tmp_path / "map.svg"
    requested = ("montecarlo", train, "--trials", 20, "--vary", "window=0.2:0.8:2", "--picture", "map", "--plot", plot)
    done = call(*requested)
    assert done.exit_code == 0, done.output
    assert "probability of a jam" in plot.read_text(encoding="utf-8")
    assert call(*requested[:-3], "colour", "--plot", plot).exit_code == 2
    assert call(*requested[:-1], tmp_path / "map.gif").exit_code == 2


def test_the_command_draws_counts_in_doubt(tmp_path: Path) -> None:
    train, plot = tmp_path / "doubtful.yaml", tmp_path / "corner.svg"
    train.write_text(DOUBTFUL, encoding="utf-8")
    done = call("posterior", train, "--free", "r=12", "--plot", plot, "--json")
    assert done.exit_code == 0, done.output
    drawn = plot.read_text(encoding="utf-8")
    assert all(f'id="{wheel}"' in drawn for wheel in "pqs")
    assert 'id="r"' not in drawn, "a wheel held to one count is in no doubt"


PAIR = """
name: pair
frame: frame
links: {frame: {}, a: {wheels: {p: 12}}, b: {wheels: {q: 18}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, q]}]
inputs: {a: 1}
outputs: {b: {}}
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
cutting: {pitch_deviation: {normal: 2 %}}
"""
