"""Figures of the errata by other routes: the source's own equations at 50 digits, and trigonometry."""

from __future__ import annotations

import re
from math import asin, atan, atan2, cos, degrees, pi, radians, sin, sqrt, tan

import pytest
from places import DOCS
from sorge import Pair, mp

import geartrain

PAGE = (DOCS / "sources.md").read_text(encoding="utf-8")


def pair(clearance: str) -> Pair:
    """Equal wheels of 96 teeth, half aperture 30 deg."""
    return Pair(96, 96, 1, 1, mp.pi / 6, mp.pi / 6, mp.mpf(clearance) - 1)


def shares(clearance: str) -> tuple[float, float, float]:
    """Parts of a pitch in approach apart, astride the matching position, in recess apart."""
    one = pair(clearance)
    found = {"approach": mp.mpf(0), "astride": mp.mpf(0), "recess": mp.mpf(0)}
    for each in one.path:
        inner = each.end if each.phase == "approach" else each.start
        where = "astride" if abs(inner - one.matching) < mp.mpf(10) ** -20 else each.phase
        found[where] += abs(each.start - each.end) / one.p1
    return float(found["approach"]), float(found["astride"]), float(found["recess"])


def test_the_recess_sub_region_of_equal_wheels_is_given_by_the_equations() -> None:
    found = re.search(r"width of the recess sub-phase, in pitches: ([\d.]+) at ([\d.]+), ([\d.]+) at ([\d.]+) ", PAGE)
    assert found is not None
    for printed, clearance in (found.groups()[:2], found.groups()[2:]):
        assert shares(clearance)[2] == pytest.approx(float(printed), abs=6e-4)


def test_the_piece_astride_begins_and_remains_where_the_errata_of_the_train_say() -> None:
    reasons = " ".join(erratum.why for erratum in geartrain.load("sorge-pairs").declaration.errata)
    found = re.search(r"up to a clearance of ([\d.]+); astride alone from ([\d.]+)", reasons)
    assert found is not None
    assert found.groups() == ("1.011164", "1.011722")
    assert shares("1.011163")[1] == 0 < shares("1.011165")[1]
    assert min(shares("1.01171")) > 0
    assert shares("1.011723")[::2] == (0, 0)


def test_friction_takes_minimum_where_the_piece_astride_is_first_alone() -> None:
    lost = {a: float(1 - pair(a).mean_efficiency(mp.mpf("0.2"))[0]) for a in ("1.0116", "1.011725", "1.0119", "1.025")}
    assert min(lost, key=lost.__getitem__) == "1.011725"
    assert [f"{100 * lost[a]:.3f} %" for a in ("1.011725", "1.025")] == ["0.551 %", "0.841 %"]
    assert "sliding loss 0.841 %, at 1.0117219 0.551 %;" in PAGE


def test_collisions_dissipate_minimum_near_the_clearance_of_the_page() -> None:
    spent = {
        a: float(sum((after - before) ** 2 / 2 for before, after in pair(a).jumps))
        for a in ("1.0118", "1.0190", "1.019273", "1.0196", "1.025")
    }
    assert min(spent, key=spent.__getitem__) == "1.019273"
    assert f"impact loss {spent['1.025']:.2e} J2 w1^2, at 1.019273 {spent['1.019273']:.2e}" in PAGE


def test_the_note_on_spheres_is_set_right_by_trigonometry() -> None:
    golden = (1 + sqrt(5)) / 2
    between = atan(2 / (1 + golden))  # from a pentagon's axis to a triangle's: 37.377 deg
    assert degrees(between) == pytest.approx(37.37736814, abs=5e-9)
    edge = atan(1 / 2)  # from a pentagon's axis to the middle of its edge
    cone = atan2(sin(between), 3 / 5 + cos(between))
    assert f"{degrees(2 * asin(sin(radians(18)) / cos(radians(36)))):.7f}" in PAGE
    assert f"{degrees(asin(2 / 3)):.12f}" in PAGE
    assert f"{degrees(cone):.3f} deg from the pentagon's axis; the middle of the edge is at {degrees(edge):.3f}" in PAGE
    assert f"irrational ratio {sin(edge) / sin(between - edge):.6f}" in PAGE
    assert f"< 45/33 < {sqrt(3) / tan(pi / 10):.4f} |" in PAGE
