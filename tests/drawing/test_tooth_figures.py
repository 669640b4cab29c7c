"""Figures of triangular teeth: positions of drawn elements, and drawing without its optional dependency."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from math import cos, degrees, hypot, pi, radians, sin

import numpy as np
import pytest

from geartrain.errors import GearTrainError, QuestionError
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

pytest.importorskip("matplotlib")

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from geartrain.drawing import render, sweep_figure
from geartrain.drawing.tooth_contact import teeth_figure, tooth_pair_pose
from geartrain.drawing.transmission_curves import triangular_figure

PAIRS = [(48, 96, 0.01), (96, 72, 0.025), (96, 96, 0.01), (15, 60, 0.02), (45, 225, 0.017), (12, 18, 0.03)]
STANDS = (45, 225, 0.017)
Points = np.ndarray[tuple[int, int], np.dtype[np.float64]]


@cache
def transmission(z1: int, z2: int, excess: float, direction: int = 1) -> TriangularTransmission:
    beta = radians(30)
    return TriangularTransmission(
        TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess), 0.2, direction
    )


def drawn(figure: Figure, gid: str) -> list[Points]:
    """Return the points of the lines and polygons with a name."""
    found = [line.get_xydata() for axes in figure.axes for line in axes.lines if line.get_gid() == gid]
    found += [patch.get_xy() for axes in figure.axes for patch in axes.patches if patch.get_gid() == gid]
    return [np.asarray(points) for points in found]


def from_line(point: Points, one: Points, other: Points) -> float:
    """Return the distance of a point from a segment."""
    along = other - one
    share = min(1.0, max(0.0, float((point - one) @ along / (along @ along))))
    return float(hypot(*(point - one - share * along)))


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("pair", PAIRS)
def test_the_contact_drawn_is_an_apex_on_the_other_flank(pair: tuple[int, int, float], direction: int) -> None:
    pair_transmission = transmission(*pair, direction)
    s = pair_transmission.sizes
    for interval in pair_transmission.intervals:
        if interval.held is not None:
            continue
        x = interval.end + 0.3 * interval.width
        ((point,),) = drawn(teeth_figure(pair_transmission, x), "contact")
        y = float(pair_transmission.contact.path.tooth_pair.angle(interval.phase, x))
        apex1 = np.array([s.R1 * cos(x), direction * s.R1 * sin(x)])
        apex2 = np.array([s.D - s.R2 * cos(y), direction * s.R2 * sin(y)])
        # roots of the two facing flanks: below the driver's tooth, above the driven tooth
        root1, root2 = s.R1 * sin(s.beta1) / sin(s.beta1 + pi / s.z1), s.R2 * sin(s.beta2) / sin(s.beta2 + pi / s.z2)
        valley1 = root1 * np.array([cos(x - pi / s.z1), direction * sin(x - pi / s.z1)])
        y += pi / s.z2
        valley2 = np.array([s.D - root2 * cos(y), direction * root2 * sin(y)])
        if interval.phase == "approach":
            assert np.abs(point - apex2).max() < 1e-12
        else:
            assert np.abs(point - apex1).max() < 1e-12
        assert from_line(point, apex1, valley1) < 1e-12
        assert from_line(point, apex2, valley2) < 1e-12


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("pair", PAIRS)
def test_the_wheels_touch_and_do_not_overlap(pair: tuple[int, int, float], direction: int) -> None:
    geometry = pytest.importorskip("shapely.geometry")
    pair_transmission = transmission(*pair, direction)
    for interval in pair_transmission.intervals:
        for share in (0.01, 0.5, 0.99):
            here = tooth_pair_pose(pair_transmission, interval.start - share * interval.width)
            one, two = (geometry.Polygon(here.outline(which)) for which in (1, 2))
            assert one.is_valid
            assert two.is_valid
            assert one.intersection(two).area < 1e-12
            if interval.held is None:
                assert one.distance(two) < 1e-9
            else:
                assert one.distance(two) > 1e-6, "nothing touches in a standstill"


@pytest.mark.parametrize("pair", [*PAIRS, (9, 120, 0.003), (400, 20, 0.01), (5000, 7000, 1e-5)])
def test_the_few_teeth_drawn_are_all_that_are_in_view(pair: tuple[int, int, float]) -> None:
    geometry = pytest.importorskip("shapely.geometry")
    pair_transmission = transmission(*pair)
    figure = teeth_figure(pair_transmission, whole=False)
    (axes,) = figure.axes
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    view = geometry.box(left, bottom, right, top)
    assert axes.get_aspect() == 1.0
    for which, name in ((1, "driver"), (2, "driven")):
        (few,) = drawn(figure, name)
        whole = geometry.Polygon(tooth_pair_pose(pair_transmission).outline(which)).intersection(view)
        assert geometry.Polygon(few).intersection(view).symmetric_difference(whole).area < 1e-12 * view.area
        assert len(few) <= 2 * max(pair_transmission.sizes.z1, pair_transmission.sizes.z2) + 1
        if pair[0] > 1000:
            assert len(few) < 60


def test_wheels_of_few_teeth_are_drawn_whole_and_others_on_demand() -> None:
    (few,) = drawn(teeth_figure(transmission(12, 18, 0.03)), "driven")
    (many,) = drawn(teeth_figure(transmission(48, 96, 0.01), whole=True), "driven")
    assert len(few) == 2 * 18 + 1, "closed"
    assert len(many) == 2 * 96 + 1


@pytest.mark.parametrize("pair", PAIRS)
def test_the_normal_passes_through_contact_and_instant_centre_which_divides_the_centres_by_the_speeds(
    pair: tuple[int, int, float],
) -> None:
    pair_transmission = transmission(*pair)
    figure, here = teeth_figure(pair_transmission), tooth_pair_pose(pair_transmission)
    ((centre,),), ((point,),), ((one, other),) = (drawn(figure, name) for name in ("centre", "contact", "normal"))
    assert centre == pytest.approx([pair_transmission.sizes.D * here.tau / (1 + here.tau), 0.0], abs=1e-12)
    assert from_line(centre, one, other) < 1e-12
    assert from_line(point, one, other) < 1e-12
    x = here.alpha1
    assert here.tau == pytest.approx(float(pair_transmission.contact.path.tooth_pair.speed(here.phase, x)), rel=1e-12)


def test_an_angle_that_no_tooth_pair_drives_at_is_a_position_of_a_tooth() -> None:
    pair_transmission = transmission(96, 96, 0.01)
    for alpha1 in (0.0, radians(9), radians(-1.2), radians(500)):
        here = tooth_pair_pose(pair_transmission, alpha1)
        turns = (here.alpha1 - alpha1) / pair_transmission.sizes.p1
        assert turns == pytest.approx(round(turns), abs=1e-9)
        assert any(each.end <= here.alpha1 <= each.start for each in pair_transmission.intervals)


def test_a_dwell_has_no_contact_to_mark() -> None:
    figure = teeth_figure(transmission(*STANDS), radians(-8.9))
    assert [drawn(figure, name) for name in ("contact", "normal", "centre")] == [[], [], []]
    assert "dwell" in figure.axes[0].get_title(loc="left")


@cache
def drawn_transmission(pair: tuple[int, int, float]) -> Figure:
    return triangular_figure(transmission(*pair))


def panels(figure: Figure) -> list[Axes]:
    assert len(figure.axes) == 4
    return figure.axes


@pytest.mark.parametrize("pair", PAIRS)
def test_the_thick_lines_cover_the_real_path_and_nothing_else(pair: tuple[int, int, float]) -> None:
    pair_transmission = transmission(*pair)
    wanted = [(each.phase, degrees(each.end), degrees(each.start)) for each in pair_transmission.intervals]
    for axes in panels(drawn_transmission(pair)):
        found = [
            (str(line.get_gid()).split()[1], float(np.min(line.get_xdata())), float(np.max(line.get_xdata())))
            for line in axes.lines
            if str(line.get_gid()).startswith("real")
        ]
        assert [phase for phase, *_ in found] == [phase for phase, *_ in wanted]
        assert [ends for _, *ends in found] == [pytest.approx(ends, abs=1e-12) for _, *ends in wanted]


@pytest.mark.parametrize("pair", PAIRS)
def test_the_thin_lines_cover_the_reach(pair: tuple[int, int, float]) -> None:
    pair_transmission = transmission(*pair)
    reach, matching = degrees(pair_transmission.sizes.reach1), degrees(pair_transmission.sizes.matching)
    figure = drawn_transmission(pair)
    for recess, approach in zip(drawn(figure, "ideal recess"), drawn(figure, "ideal approach"), strict=True):
        assert recess[[0, -1], 0] == pytest.approx([-reach, matching])
        assert approach[[0, -1], 0] == pytest.approx([matching, reach])


def test_the_curves_are_the_transmission() -> None:
    pair_transmission = transmission(48, 96, 0.01)
    figure = drawn_transmission((48, 96, 0.01))
    angle, speed, efficiency, first = drawn(figure, "real recess")
    (second,) = drawn(figure, "driven real recess")
    S = -np.radians(angle[:, 0])[1:-1]
    assert pair_transmission.alpha1(S) == pytest.approx(-S, abs=1e-12)
    assert angle[1:-1, 1] == pytest.approx(-np.degrees(pair_transmission.angle(S)), abs=1e-11)
    assert speed[1:-1, 1] == pytest.approx(pair_transmission.speed(S), abs=1e-12)
    assert efficiency[1:-1, 1] == pytest.approx(pair_transmission.efficiency(S), abs=1e-12)
    # output power divided by input power; moment arms are divided by the pitch radii
    assert efficiency[:, 1] == pytest.approx(speed[:, 1] * second[:, 1] / first[:, 1] * 2, abs=1e-12)
    (beside,) = figure.axes[1].child_axes
    figure.draw_without_rendering()
    centre = np.array(beside.get_ylim()) * pair_transmission.sizes.D
    tau = np.array(figure.axes[1].get_ylim())
    assert centre == pytest.approx(tau * (pair_transmission.sizes.D - centre), rel=1e-9)


def test_a_dwell_is_level_and_at_rest() -> None:
    pair_transmission = transmission(*STANDS)
    (still,) = [each for each in pair_transmission.intervals if each.held is not None]
    assert still.held is not None
    angle, speed, efficiency, arm = drawn(drawn_transmission(STANDS), "real dwell")
    assert angle[:, 1] == pytest.approx(degrees(still.held), abs=1e-12)
    assert (speed[:, 1] == 0).all()
    assert np.isnan(efficiency[:, 1]).all()
    assert np.isnan(arm[:, 1]).all()


def test_every_jump_is_annotated() -> None:
    figure = drawn_transmission((96, 72, 0.025))
    said = [text.get_text() for text in figure.axes[1].texts if text.get_gid() == "jump"]
    assert sorted(said) == ["jump 0.0682", "matching 0.0316"]


def columns(*shape: int) -> dict[str, np.ndarray]:
    whole = np.linspace(0.9, 1.0, int(np.prod(shape))).reshape(shape)
    return {"efficiency_mean": whole, "error_pp_deg": 1 - whole, "tau_min": whole - 0.1, "tau_max": whole, "x": whole}


def test_a_sweep_over_one_parameter_has_three_panels_before_bands_cut_half_way() -> None:
    x = np.array([3.0, 1.0, 2.0, 4.0])
    verdicts = np.array(["recess", "jam", "recess", "apart"])
    figure = sweep_figure({"clearance": x}, columns(4), verdicts)
    assert len(figure.axes) == 3
    for axes in figure.axes:
        bands = {str(p.get_gid()): (p.get_x(), p.get_x() + p.get_width()) for p in axes.patches}  # type: ignore[attr-defined]
        assert bands == {"band jam": (1.0, 1.5), "band recess": (1.5, 3.5), "band apart": (3.5, 4.0)}
    ((line),) = drawn(figure, "efficiency_mean")
    assert line[:, 0].tolist() == [1.0, 2.0, 3.0, 4.0]
    assert render(figure, ".png").startswith(b"\x89PNG")


@pytest.mark.parametrize("indexing", ["ij", "xy"])
def test_a_sweep_over_two_parameters_is_a_map_blank_where_nothing_turns(indexing: str) -> None:
    x, y = np.meshgrid([1.03, 1.01, 1.02], [20.0, 30.0, 40.0, 50.0], indexing=indexing)  # type: ignore[call-overload]
    verdicts = np.where(x < 1.015, "jam", np.where(y > 45, "dwell", np.where(y > 25, "recess", "astride")))
    figure = sweep_figure({"clearance": x, "half angle": y}, columns(*x.shape), verdicts)
    (mesh,) = [each for each in figure.axes[0].collections if each.get_gid() == "map"]
    shown = mesh.get_array()
    assert shown is not None
    assert np.ma.count_masked(shown) == (verdicts == "jam").sum()
    assert {text.get_text() for text in figure.axes[0].texts} == {"recess", "astride"}
    assert render(figure, ".svg").startswith(b"<?xml")


@pytest.mark.parametrize("shape", [(1,), (1, 1), (1, 4), (4, 1)])
def test_a_sweep_of_one_value_is_drawn_too(shape: tuple[int, ...]) -> None:
    names = ("clearance", "half angle")[: len(shape)]
    parameters = {name: np.indices(shape)[at].astype(float) for at, name in enumerate(names)}
    nothing = {name: np.full(shape, np.nan) for name in columns(1)}
    for values in (columns(*shape), nothing):
        sweep_figure(parameters, values, np.full(shape, "recess")).draw_without_rendering()


def test_arrays_that_are_no_sweep_are_refused() -> None:
    x = np.linspace(0, 1, 4)
    for parameters, verdicts in (({}, x), ({"a": x, "b": x}, x), ({"a": x}, x[:3]), ({"a": x[:0]}, x[:0])):
        with pytest.raises(QuestionError, match="cannot draw a sweep"):
            sweep_figure(parameters, {"efficiency_mean": x}, verdicts.astype(str))
    with pytest.raises(QuestionError, match="cannot draw a sweep"):
        sweep_figure({"a": x}, {}, x.astype(str))


@pytest.mark.parametrize(("suffix", "start"), [(".svg", b"<?xml"), (".PNG", b"\x89PNG"), (".pdf", b"%PDF")])
def test_the_same_figure_is_the_same_file(suffix: str, start: bytes) -> None:
    figure = Figure(figsize=(2, 2))
    figure.add_subplot().contourf([[0, 1], [1, 0]], hatches=["//"])
    first, again = (render(figure, suffix) for _ in range(2))
    assert first.startswith(start)
    assert first == again
    assert b"<dc:date>" not in first


@pytest.mark.parametrize("suffix", [".gif", ""])
def test_another_suffix_is_refused_with_those_that_are_known(suffix: str) -> None:
    with pytest.raises(GearTrainError, match=r"\.svg, \.png, \.pdf"):
        render(Figure(), suffix)


@pytest.mark.parametrize("pair", [(48, 96, 0.05), (3, 10, 0.01)])
def test_wheels_without_contact_are_refused_with_their_verdict(pair: tuple[int, int, float]) -> None:
    for draw in (triangular_figure, teeth_figure):
        with pytest.raises(GearTrainError, match="never touch"):
            draw(transmission(*pair))


def fresh(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=120)


def test_the_room_is_entered_without_matplotlib_and_pyplot_is_never_needed() -> None:
    done = fresh("import geartrain.drawing, sys; print('matplotlib' in sys.modules, 'numpy' in sys.modules)")
    assert done.stdout.split() == ["False", "False"]
    done = fresh("from geartrain.drawing import *; import sys; print('matplotlib.pyplot' in sys.modules)")
    assert (done.stdout.split(), done.stderr) == (["False"], "")


@pytest.mark.parametrize("name", ["render", "sweep_figure"])
def test_without_matplotlib_the_extra_is_named(name: str) -> None:
    block = "import sys; sys.modules['matplotlib'] = None\n"
    done = fresh(
        block + f"import geartrain.drawing\ntry:\n    geartrain.drawing.{name}\nexcept Exception as e:\n    print(e)"
    )
    assert "pip install 'matplotlib>=3.8'" in done.stdout
    assert done.stderr == ""


def test_what_is_not_in_the_room_is_missing() -> None:
    import geartrain.drawing

    with pytest.raises(AttributeError, match="nothing"):
        _ = geartrain.drawing.nothing
