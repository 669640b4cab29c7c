"""The study of gears on a sphere: convergence, judgement and closure stand in order. Times are never judged."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import networkx as nx
import pytest
from studies.loop_closures import draw_teeth, true_residue
from studies.planar_graphs import hull, trapezohedron, zonohedron
from studies.sphere_records import TARGET, ClosureRecord, PackRecord, SphereRecords
from studies.sphere_study import sphere

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


@pytest.fixture(scope="module")
def records() -> SphereRecords:
    return sphere(quick=True)


def closures(records: SphereRecords, method: str) -> list[ClosureRecord]:
    return sorted((row for row in records.closures if row.method == method), key=lambda row: row.power)


# circles -------------------------------------------------------------------------------------------------------------


def test_newton_squares_the_residual(records: SphereRecords) -> None:
    for row in records.packings:
        left = [residual for _, residual in row.steps]
        near = [(a, b) for a, b in pairwise(left) if a < 0.1 and b > 1e-11]
        assert near, "a step near the solution and above rounding"
        assert all(b < 1.0 * a**2 for a, b in near)
        assert left[-1] < 1e-13


def test_the_fixed_point_only_divides_the_residual(records: SphereRecords) -> None:
    for row in records.packings:
        (first, above), (last, below) = row.trace[0], row.trace[-1]
        each = (below / above) ** (1 / (last - first))
        assert 0.3 < each < 0.99
        assert row.left == below < TARGET
        assert row.sweeps == last > 10 * len(row.counted)
        assert len(row.counted) <= 6


def test_packings_touch_in_forty_digits(records: SphereRecords) -> None:
    for row in records.packings:
        assert 0 < row.judged < 1e-14
        assert row.overlaps == 0


@pytest.mark.parametrize(
    ("edges", "gears"), [(hull(11), 29), (zonohedron(6), 32), (zonohedron(3), 8), (trapezohedron(14), 30)]
)
def test_the_graphs_are_planar_bipartite_and_3_connected(edges: list[tuple[str, str]], gears: int) -> None:
    graph = nx.Graph(edges)
    assert len(graph) == gears
    assert graph.number_of_edges() == len(edges) == 2 * gears - 4, "all regions have four"
    assert nx.is_bipartite(graph)
    assert nx.check_planarity(graph)[0]
    assert nx.node_connectivity(graph) == 3


def test_small_graphs_are_fitted(records: SphereRecords) -> None:
    assert len(records.fits) == 3 * len(records.packings)
    for row in records.fits:
        assert row.exact
        assert row.residual < 1e-11
        assert row.moved < 3
    moved = {(row.family, row.gears, row.aim, row.minimum): row.moved for row in records.fits}
    for family, gears in {(row.family, row.gears) for row in records.fits if row.family == "hull"}:
        assert moved[family, gears, "pitch", 50] < moved[family, gears, "pitch", 12], "finer rounding moves axes less"


# closure -------------------------------------------------------------------------------------------------------------


def test_fractions_are_never_wrong(records: SphereRecords) -> None:
    rows = closures(records, "fractions")
    assert {row.power for row in rows} >= {1, 12}
    assert len({row.family for row in rows}) == 3
    assert all(row.error == row.wrong == 0 for row in rows)


def test_floats_err_in_proportion_to_the_teeth_until_verdicts_are_wrong(records: SphereRecords) -> None:
    rows = [row for row in closures(records, "floats of the fractions") if row.family == "6-antiprism"]
    for row in rows:
        assert 1e-17 < row.error / 10**row.power < 3e-15
    assert rows[0].wrong == 0
    assert rows[-1].power == 12
    assert 0 < rows[-1].wrong < rows[-1].loops


def test_angles_from_axes_know_nothing_at_many_teeth(records: SphereRecords) -> None:
    rows = closures(records, "floats from the axes")
    assert all(row.wrong == 0 and row.error < 1e-10 for row in rows if row.power == 1)
    last = [row for row in rows if row.power == 12]
    assert all(row.wrong >= row.loops // 2 for row in last)


def test_half_of_the_drawn_teeth_close() -> None:
    shares = [Fraction(1, 6), Fraction(2, 3)]
    for power in (1, 15):
        teeth = draw_teeth(shares, power, 40)
        assert all(10**power <= z < 10 ** (power + 1) for kind in teeth for z in kind.tolist())
        left = [true_residue(z, shares) for z in zip(*(each.tolist() for each in teeth), strict=True)]
        assert [not each for each in left] == [True] * 20 + [False] * 20
    assert true_residue((7, 3), (Fraction(1, 6), Fraction(2, 3))) == Fraction(1, 6)


# records -------------------------------------------------------------------------------------------------------------


def test_steps_count_to_the_target_and_ratios_with_them(records: SphereRecords) -> None:
    steps = [(1.0, 0.2), (2.0, 0.01), (4.0, 3e-5), (8.0, 2e-12), (16.0, 1e-15)]
    row: PackRecord = replace(records.packings[0], steps=steps, swept=60.0)
    assert row.counted == steps[:4]
    assert (row.newton, row.ratio) == (15.0, 4.0)
