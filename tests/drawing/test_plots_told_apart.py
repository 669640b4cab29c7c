"""Elements of plots are distinguishable in every theme: map values, bands, coincident markers, and labels of lines."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import radians
from typing import Any

import numpy as np
import pytest
from seen_figure import alike, crowded, hidden, in_theme, palette, without_quantity
from shipped import train as load
from test_tooth_figures import transmission

pytest.importorskip("matplotlib")

from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import geartrain
from geartrain.drawing import sweep_figure
from geartrain.drawing.transmission_curves import triangular_figure
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission
from geartrain.workshop import ToothSizes, find_tooth_sizes, find_train_sizes

GRID = np.linspace(0.0, 1.0, 5)


@pytest.mark.parametrize("theme", ["dark", "print"])
def test_the_arrow_of_an_annotation_is_of_the_ink_of_its_theme(theme: Any) -> None:
    figure = triangular_figure(transmission(60, 30, 0.05))
    (time,) = [text for axes in figure.axes for text in axes.texts if text.get_text() == "time"]
    with in_theme(figure, theme):
        assert to_hex(time.arrow_patch.get_edgecolor()) == palette(theme).ink  # type: ignore[attr-defined]


def test_words_at_a_line_stay_within_their_panel() -> None:
    """With unequal angles and reversed motion the flanks coincide near the edge of the panel."""
    sizes = TriangularSizes(60, 30, *equal_depth(60, 30, radians(30), radians(35)), radians(30), radians(35), 0.05)
    for pair in (transmission(60, 30, 0.05), TriangularTransmission(sizes, 0.0, -1)):
        figure = triangular_figure(pair)
        figure.draw_without_rendering()
        (words,) = [text for text in figure.axes[0].texts if text.get_gid() == "matching"]
        panel, box = figure.axes[0].get_window_extent(), words.get_window_extent()
        assert panel.x0 < box.x0
        assert box.x1 < panel.x1


def test_numbers_of_the_instant_centre_keep_their_distance_where_a_wheel_stands() -> None:
    figure = triangular_figure(transmission(60, 40, 0.05))
    figure.draw_without_rendering()
    (beside,) = [each for each in figure.axes[1].child_axes if "instant centre" in each.get_ylabel()]
    at = beside.transData.transform([(0, tick) for tick in beside.get_yticks()])[:, 1]
    assert len(at) >= 3
    assert min(np.diff(at)) > 14 * figure.dpi / 72  # height of a line of text


def test_ways_of_running_are_told_apart_in_print() -> None:
    kinds = ["approach", "recess", "astride", "approach+recess", "jam", "clash"]
    x = np.arange(6.0)
    figure = sweep_figure({"z": x}, {"efficiency_mean": x}, np.array(kinds), "a sweep")
    assert not alike(figure)
    assert not without_quantity(figure)


def test_a_sweep_names_its_parameters_by_itself() -> None:
    x, y = np.meshgrid(GRID, GRID, indexing="ij")
    ways = np.full(x.shape, "recess")
    figure = sweep_figure({"half_angle": x, "z1": y}, {"efficiency_mean": x}, ways, units={"half_angle": "deg"})
    assert (figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()) == ("half angle (deg)", "teeth of wheel 1")
    figure = sweep_figure({"clearance_factor": GRID}, {"efficiency_mean": GRID}, ways[0])
    assert figure.axes[-1].get_xlabel() == "clearance factor"


def test_marks_of_one_place_stand_one_within_the_other() -> None:
    """Here the optimum of each pair is also the optimum of the train."""
    figure = find_train_sizes(load("moon-triangular"), "moon", "jam", {"window": (0.3, 0.7)}).plot()
    marks = [line for line in figure.axes[0].lines if line.get_gid() != "interval"]
    sizes = [line.get_markersize() for line in marks]
    assert len(marks) == 3
    assert all(inner < 0.8 * outer for outer, inner in pairwise(sizes))
    assert all(line.get_markerfacecolor() == "#ffffff" for line in marks[:-1])


def test_marks_of_best_sizes_are_in_view_and_their_key_is_below_all_designs() -> None:
    """Pitch-true teeth are better than all designs with a free window, and far from them."""
    start = ToothSizes((60, 30), 1.1, 0.5, (radians(30), radians(30)), 0.2)
    figure = find_tooth_sizes(start, free={"window": (0.4, 0.6)}).plot()
    figure.draw_without_rendering()
    (axes,) = figure.axes
    (legend,) = figure.legends
    assert axes.get_legend() is None
    assert legend.get_window_extent().y1 < axes.get_tightbbox().y0  # type: ignore[union-attr]
    marks = [line for line in axes.lines if line.get_gid() in ("best", "equal depth", "pitch-true")]
    assert len(marks) == 3
    for mark in marks:
        x, y = mark.get_xydata()[0]  # type: ignore[index]
        assert axes.get_xlim()[0] <= x <= axes.get_xlim()[1]
        assert axes.get_ylim()[0] <= y <= axes.get_ylim()[1]


def test_words_over_the_ends_of_a_band_stand_within_its_turns() -> None:
    train = load("norton-compound")
    (axes,) = train.torques().plot().axes
    turned = [patch for patch in axes.patches if patch.get_zorder() == 1.0]
    assert turned
    for text in axes.texts:
        box = text.get_window_extent().transformed(axes.transData.inverted())
        for band in turned:
            assert not band.get_path().intersects_bbox(box, filled=False), text.get_text()


def shapes(z1: int, z2: int, form: str) -> Figure:
    """Return the picture of a pair with a conjugate tooth form."""
    wheels = f"{{frame: {{}}, a: {{wheels: {{p: {z1}}}}}, b: {{wheels: {{q: {z2}}}}}}}"
    text = f"links: {wheels}\nrevolutes: {{A: [frame, a], B: [frame, b]}}\ngears: [p ~ q]\ninputs: {{a: 1}}\n"
    return geartrain.load(f"{text}tooth_form: {{{form}}}\n").meshes[0].plot()  # type: ignore[no-any-return]


def test_a_radial_flank_is_a_straight_line_not_its_rounding() -> None:
    figure = shapes(60, 8, "form: cycloidal, thickness: [1.5708, 1.05], addendum: [1.4, 0]")
    low, high = figure.axes[1].get_xlim()
    (flank,) = [line for line in figure.axes[1].lines if line.get_gid() == "cycloidal"]
    assert np.ptp(flank.get_xdata()) < 1e-12 < 0.05 < high - low


def test_a_spike_leaves_its_panel_where_the_rest_would_be_flat() -> None:
    """At the undercut of a pinion of 8 teeth the flank reverses, and the heat per area is unbounded."""
    figure = shapes(8, 36, "form: involute")
    (heat,) = [line for line in figure.axes[4].lines if line.get_gid() == "involute"]
    values = np.asarray(heat.get_ydata(), dtype=float)
    assert np.nanmax(values) > 100 * np.nanmedian(values)
    assert figure.axes[4].get_ylim()[1] < 30 * np.nanmedian(values)
    assert "curves extend beyond their panels" in figure.get_suptitle()


def keyed(*entries: Any) -> Figure:
    figure = Figure()
    figure.legend(handles=entries)
    return figure


def test_two_lines_or_areas_of_one_grey_are_found() -> None:
    light = palette("light")
    one, two = (Line2D([], [], color=colour, label=colour) for colour in (light.series[0], light.fault))
    assert alike(keyed(one, two)) == [(light.series[0], light.fault)]
    assert not alike(keyed(one, two), "light")
    assert not alike(keyed(one, Line2D([], [], color=light.fault, linestyle=":", label="dotted")))
    assert alike(keyed(*(Patch(color=colour, label=colour) for colour in (light.series[0], light.quiet))))


@pytest.mark.parametrize(
    ("draw", "over"),
    [
        (lambda axes: axes.plot([0, 1], [0, 1], "o", label="drawn"), "upper right"),
        (lambda axes: axes.plot([0, 1], [0, 1], label="drawn"), "center"),
        (lambda axes: axes.fill_between([0, 1], [0, 1], label="drawn"), "lower right"),
    ],
    ids=("a mark", "a line between its ends", "a filled area"),
)
def test_a_legend_over_what_is_drawn_is_found(draw: Callable[[Any], object], over: str) -> None:
    figure = Figure()
    axes = figure.subplots()
    draw(axes)
    axes.legend(loc=over)
    assert hidden(figure) == ["drawn"]
    axes.legend(loc="upper left")
    assert not hidden(figure)


def test_an_axis_without_words_and_numbers_that_run_into_each_other_are_found() -> None:
    figure = Figure(figsize=(4, 2))
    left, right = figure.subplots(1, 2)
    left.set(xlabel="turns", ylabel="error (deg)")
    right.set(ylabel="speed")
    figure.draw_without_rendering()
    assert without_quantity(figure) == ["x of panel 1"], "a label does not serve the column beside it"
    right.set(xlabel="turns", ylabel="")
    assert without_quantity(figure) == ["y of panel 1"]
    right.set_xlim(0, 10)
    right.set_xticks([4, 5], ["100", "101"])
    assert crowded(figure) == [("100", "101")]
