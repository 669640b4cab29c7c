"""Pictures of uncertainty: drawn values equal the given ones, and data that cannot be drawn are refused."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
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
from test_words_in_pictures import faults_of

from geartrain import load
from geartrain.errors import QuestionError
from geartrain.numerics import IntervalEstimate, ProbabilityEstimate
from geartrain.search import counts_figure, infer_counts, joint_posterior, most_informative_wheels
from geartrain.search.posterior.corner_plot import CountProbabilities, corner_figure
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
from geartrain.workshop.monte_carlo.monte_carlo_plots import (
    convergence_figure,
    course_figure,
    jam_map_figure,
    monte_carlo_figure,
    share_figure,
)
from geartrain.workshop.monte_carlo.sobol_indices import SobolIndex

RNG = np.random.default_rng(1)
TURNS = np.linspace(0, 2, 50)
ERRORS = RNG.normal(size=(41, 1)) * np.sin(np.pi * TURNS) + 0.1
PAIRS = {
    ("b1", "e3"): {(223, 217): 0.1, (223, 235): 0.2, (224, 217): 0.3, (224, 223): 0.4},
    ("b1", "m3"): {(223, 27): 0.3, (224, 27): 0.3, (224, 28): 0.4},
    ("e3", "m3"): {(217, 27): 0.4, (235, 27): 0.2, (223, 28): 0.4},
}
SINGLE = {"b1": {223: 0.3, 224: 0.7}, "e3": {217: 0.4, 223: 0.4, 235: 0.2}, "m3": {27: 0.6, 28: 0.4}}
MAP_X, MAP_Y = np.linspace(1.0, 1.03, 5), np.linspace(1, 8, 6)


def line(figure: Figure, gid: str, panel: int = 0) -> np.ndarray:
    """Return the points of the line with a name."""
    (found,) = [each for each in figure.axes[panel].lines if each.get_gid() == gid]
    return np.array(found.get_xydata())


def outline(figure: Figure, gid: str) -> tuple[float, float]:
    """Return the minimum and maximum ordinate of a filled band."""
    (found,) = [each for each in figure.axes[0].collections if each.get_gid() == gid]
    y = found.get_paths()[0].vertices[:, 1]
    return float(np.min(y)), float(np.max(y))


# ------------------------------------------------------------------------------------------------------------ straying


def course(errors: np.ndarray, name: str = "moon") -> PointerErrorCourse:
    """Return the course of errors [deg] over two turns."""
    return PointerErrorCourse(name, TURNS, np.radians(errors))


def test_the_bands_that_are_drawn_are_those_of_the_trials_that_turn() -> None:
    jams = np.full((3, 50), np.nan)
    figure = course_figure([course(np.vstack((ERRORS, jams))), course(2 * ERRORS, "sun")], "b")
    assert line(figure, "median") == pytest.approx(np.stack((TURNS, np.median(ERRORS, axis=0)), axis=1))
    assert line(figure, "one") == pytest.approx(np.stack((TURNS, ERRORS[0]), axis=1))
    for share, low, high in (("every trial", 0, 1), ("95 % of the trials", 0.025, 0.975), ("50 %", 0.25, 0.75)):
        ends = np.quantile(ERRORS, low, axis=0).min(), np.quantile(ERRORS, high, axis=0).max()
        assert outline(figure, share) == pytest.approx(ends)
    assert [axes.get_ylabel().split("\n")[0] for axes in figure.axes] == ["moon", "sun"]
    assert figure.axes[1].get_xlabel() == "turns of b"


# ------------------------------------------------------------------------------------------------------------ jam maps


def crossing(figure: Figure, gid: str) -> np.ndarray:
    """Return the points of the contour with a name."""
    (found,) = [each for each in figure.axes[0].collections if each.get_gid() == gid]
    return np.concatenate([path.vertices for path in found.get_paths()])


def test_contours_run_where_the_chance_is_theirs() -> None:
    """The arcsine of the square root of the probability is linear, so the contours are known lines."""
    x, y = np.linspace(0, 1, 40), np.linspace(0, 1, 41)
    ramp = np.sin((0.1 + x[:, None] + y[None, :]) / 2.2) ** 2
    figure = jam_map_figure(x, y, ramp)
    for level in (0.01, 0.1, 0.5):
        points = crossing(figure, f"{level:.0%}")
        if level == 0.01:
            assert np.abs(0.1 + points.sum(axis=1) - 2.2 * np.arcsin(0.1)).max() < 1e-9
        assert np.sin((0.1 + points.sum(axis=1)) / 2.2) ** 2 == pytest.approx(level)
    (mesh,) = [each for each in figure.axes[0].collections if each.get_gid() == "map"]
    assert np.array(mesh.get_array()).reshape(41, 40) == pytest.approx(ramp.T)


@pytest.mark.filterwarnings("error")
def test_a_map_without_a_contour_or_with_holes_is_drawn() -> None:
    nothing = np.zeros((5, 6))
    nothing[2, 3] = np.nan
    jam_map_figure(MAP_X, MAP_Y, nothing).draw_without_rendering()


# ------------------------------------------------------------------------------------------- tornado, corner, settling


def sure(value: float) -> IntervalEstimate:
    """Return an estimate with an interval of width 0."""
    return IntervalEstimate(value, value, value)


def test_shares_are_sorted_and_have_their_intervals() -> None:
    shares = {
        "a": (IntervalEstimate(0.1, 0.05, 0.15), IntervalEstimate(0.2, 0.1, 0.3)),
        "b": (sure(0.3), sure(0.5)),
        "c": (IntervalEstimate(0.2, 0.1, 0.4), sure(0.1)),
    }
    figure = share_figure(shares)
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.get_yticklabels()] == ["b", "a", "c"]
    assert line(figure, "first order").tolist() == [[0.3, 0], [0.1, 1], [0.2, 2]]
    assert line(figure, "total, with interactions").tolist() == [[0.5, 0], [0.2, 1], [0.1, 2]]
    ends = [tuple(each.get_xdata()) for each in axes.lines if each.get_gid() == "interval" and np.ptp(each.get_xdata())]
    assert ends == [(0.1, 0.3), (0.05, 0.15), (0.1, 0.4)]
    assert axes.get_ylim()[0] > axes.get_ylim()[1], "the largest share is on top"


def test_what_does_not_fit_is_counted() -> None:
    shares = {str(at): (sure(1 / (at + 1)),) for at in range(30)}
    (axes,) = share_figure(shares).axes
    assert len(axes.get_yticklabels()) == 20
    assert "10 more causes of at most 0.048" in axes.get_xlabel()


def test_a_corner_shows_every_chance_at_its_counts() -> None:
    likely = CountProbabilities(SINGLE, PAIRS, {}, {"b1": 223})
    figure = corner_figure(likely)
    panels = np.array(figure.axes).reshape(3, 3)
    bars = {round(bar.get_x() + bar.get_width() / 2): bar.get_height() for bar in panels[0, 0].patches}
    assert bars == pytest.approx({223: 0.3, 224: 0.7})
    (mesh,) = [each for each in panels[1, 0].collections if isinstance(each, QuadMesh)]
    cells = np.array(mesh.get_array())
    edges = mesh.get_coordinates()
    seen = {
        (round(float(edges[i, j, 0] + 0.5)), round(float(edges[i, j, 1] + 0.5))): float(cells[i, j])
        for i, j in np.ndindex(cells.shape)
        if cells[i, j]
    }
    assert seen == pytest.approx(dict(likely.pairs["b1", "e3"]))
    assert not panels[0, 2].axison


def test_a_panel_names_every_mode_of_its_wheel() -> None:
    """50 is declared and 49 to 52 are equally probable: the title prefers none of them."""
    equal = dict(zip(range(47, 55), np.array([1, 2, 7, 7, 7, 7, 2, 1]) / 34, strict=True))
    # 0.1 + 0.2 is not 0.3 in floats, but 21 and 23 are equally probable
    apart = {21: 0.3 / 0.7, 22: 0.1 / 0.7, 23: (0.1 + 0.2) / 0.7}
    figures = [
        corner_figure(CountProbabilities({"w": chances}, {})) for chances in (equal, apart, {21: 0.75, 22: 0.25})
    ]
    titles = [figure.axes[0].get_title() for figure in figures]
    assert titles == ["49-52: 20.6 % each", "2 of 21-23: 42.9 % each", "21: 75 %"]


def test_convergence_shows_estimates_and_their_intervals() -> None:
    steps = [(n, ProbabilityEstimate(n // 5, n)) for n in (10, 100, 1000)]
    figure = convergence_figure(steps)
    assert line(figure, "any pair").tolist() == [[10, 0.2], [100, 0.2], [1000, 0.2]]
    ends = [end for _, each in steps for end in each.interval]
    assert outline(figure, "95 %") == pytest.approx((min(ends), max(ends)))


# ----------------------------------------------------------------------------------------------- sweeps, and two wheels

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
    for bar in bars[: len(alone)]:
        count = round(bar.get_x() + bar.get_width() / 2)
        assert bar.get_height() == pytest.approx(alone[count] / len(fitting))


def test_where_nothing_fits_nothing_is_drawn() -> None:
    train = load(DOUBTFUL.replace("0.167, tolerance: 0.006", "5, tolerance: 0.001")).declaration
    found = infer_counts(train)
    with pytest.raises(QuestionError, match="nothing to draw"):
        counts_figure(found, joint_posterior(found, ["p", "q"], lambda held: infer_counts(train, free=held)))


# --------------------------------------------------------------------------------------------------- trials of a train


@pytest.fixture(scope="module")
def findings() -> MonteCarloResult:
    plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=1 %"]), ("moon",))
    trials = run_trials(plan, 300)
    cleared = jamming_map(plan, [0.3, 0.6], [0.5, 4.0], 20)
    return MonteCarloResult(trials, cleared, [run_course(plan, 0, 12, 1, 20)])


def test_pictures_of_trials_show_their_trials(findings: MonteCarloResult) -> None:
    trials = findings.trials
    errors = monte_carlo_figure(findings)
    known = np.array(trials.columns["moon error (deg)"])
    turns = ~(trials.marks & 0b11001).any(axis=1)
    turning = known[turns if turns.sum() >= 30 else np.isfinite(known)]
    assert line(errors, "median")[0, 0] == pytest.approx(np.median(turning))
    ends = [each.get_xdata() for each in errors.axes[0].lines if each.get_gid() == "interval"]
    assert ends == [pytest.approx(np.quantile(turning, share)) for share in ((0.025, 0.975), (0.25, 0.75))]
    course = monte_carlo_figure(findings, "course")
    assert line(course, "median")[:, 1] == pytest.approx(np.degrees(np.median(findings.courses[0].errors, axis=0)))
    (axes,) = monte_carlo_figure(findings, "pairs").axes
    (shares,) = [each for each in axes.lines if each.get_gid() == "first order"]
    assert sum(shares.get_xdata()) == pytest.approx(1)
    converged = line(monte_carlo_figure(findings, "convergence"), "any pair")
    assert converged[-1, 0] == 300
    assert converged[-1, 1] == pytest.approx((trials.marks & 1).any(axis=1).mean())
    figure = monte_carlo_figure(findings, "map")
    (mesh,) = [each for each in figure.axes[0].collections if each.get_gid() == "map"]
    seen = np.array(mesh.get_array()).reshape(2, 2)
    for each in findings.cleared:
        at = [0.5, 4.0].index(each.scale), [0.3, 0.6].index(each.clearance or 0)
        assert seen[at] == each.events["jam"].value


def test_pictures_of_what_was_not_requested_are_refused(findings: MonteCarloResult) -> None:
    bare = MonteCarloResult(findings.trials)
    for picture in ("course", "sobol", "map", "colour"):
        with pytest.raises(QuestionError) as caught:
            monte_carlo_figure(bare, picture)
        assert all(problem.fix for problem in caught.value.problems)


def test_indices_are_drawn_with_their_intervals(findings: MonteCarloResult) -> None:
    index = SobolIndex("e3", IntervalEstimate(0.3, 0.2, 0.4), IntervalEstimate(0.5, 0.4, 0.6))
    (axes,) = monte_carlo_figure(replace(findings, indices=[SobolIndices("moon", "wheel", 64, (index,))]), "sobol").axes
    marks = [each.get_xdata().item() for each in axes.lines if each.get_gid() != "interval"]
    assert marks == [0.3, 0.5]


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

# ---------------------------------------------------------------------------------------------------------- all of them

ALL: dict[str, Callable[[], Figure]] = {
    "straying": lambda: course_figure([course(ERRORS)]),
    "map": lambda: jam_map_figure(MAP_X, MAP_Y, np.linspace(0, 1, 30).reshape(5, 6)),
    "shares": lambda: share_figure(
        {f"wheel {at}": (IntervalEstimate(0.9**at, 0.1, 0.2), sure(1.0)) for at in range(25)}, "moon"
    ),
    "corner": lambda: corner_figure(CountProbabilities(SINGLE, PAIRS, {}, {"b1": 223}), "what fits"),
    "settling": lambda: convergence_figure([(1, ProbabilityEstimate(0, 1))]),
}


@pytest.mark.parametrize("name", list(ALL))
def test_everything_is_inside_and_the_words_are_large_enough(name: str) -> None:
    assert not faults_of(ALL[name]())


@pytest.mark.parametrize(
    "draw",
    [
        lambda: course_figure([]),
        lambda: course_figure([course(np.full((3, 50), np.nan))]),
        lambda: share_figure({}),
        lambda: corner_figure(CountProbabilities({str(at): {1: 1.0} for at in range(10)}, {})),
        lambda: corner_figure(CountProbabilities({}, {})),
        lambda: convergence_figure([]),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_what_to_do(draw: Callable[[], object]) -> None:
    with pytest.raises(QuestionError) as caught:
        draw()
    assert all(problem.what and problem.fix for problem in caught.value.problems)
