"""Figures of the page of errata, by other routes: the source's own equations at 50 digits, and trigonometry."""

from __future__ import annotations

import re
from math import asin, atan, atan2, cos, degrees, pi, radians, sin, sqrt, tan

import pytest
from places import DOCS
from sorge import Pair, mp

PAGE = (DOCS / "errata.md").read_text(encoding="utf-8")


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


@pytest.mark.parametrize("clearance", ["1.001", "1.006", "1.0111", "1.0113", "1.0117", "1.0118"])
def test_the_sub_regions_of_equal_wheels_are_those_of_the_equations(clearance: str) -> None:
    row = re.search(rf"^\| {re.escape(clearance)} \|(.*)\|$", PAGE, re.MULTILINE)
    assert row is not None
    printed = [0.0 if cell.strip() == "-" else float(cell) for cell in row[1].split("|")]
    assert shares(clearance) == pytest.approx(printed, abs=6e-4)


def test_the_piece_astride_is_born_and_is_left_alone_where_the_page_says() -> None:
    words = r"Each keeps 0\.494 to 0\.506 of a pitch until, at a = ([\d.]+), [^.]* from a = ([\d.]+)\."
    found = re.search(words, PAGE)
    assert found is not None
    assert found.groups() == ("1.011164", "1.011722")
    assert shares("1.011163")[1] == 0 < shares("1.011165")[1]
    assert min(shares("1.01171")) > 0
    assert shares("1.011723")[::2] == (0, 0)


def test_friction_takes_minimum_where_the_piece_astride_is_first_alone() -> None:
    lost = {a: float(1 - pair(a).mean_efficiency(mp.mpf("0.2"))[0]) for a in ("1.0116", "1.011725", "1.0119", "1.025")}
    assert min(lost, key=lost.__getitem__) == "1.011725"
    assert [f"{100 * lost[a]:.3f} %" for a in ("1.011725", "1.025")] == ["0.551 %", "0.841 %"]
    assert "| least friction | 1.011722 | 0.551 % |" in PAGE
    assert "| printed as best | 1.025 | 0.841 % |" in PAGE


def test_collisions_dissipate_minimum_near_the_clearance_of_the_page() -> None:
    spent = {
        a: float(sum((after - before) ** 2 / 2 for before, after in pair(a).jumps))
        for a in ("1.0118", "1.0190", "1.019273", "1.0196", "1.025")
    }
    assert min(spent, key=spent.__getitem__) == "1.019273"
    assert f"| least dissipated by collisions | 1.019273 | 0.694 % | {spent['1.019273']:.2e} |" in PAGE


def test_the_note_on_spheres_is_set_right_by_trigonometry() -> None:
    golden = (1 + sqrt(5)) / 2
    between = atan(2 / (1 + golden))  # from a pentagon's axis to a triangle's: 37.377 deg
    assert degrees(between) == pytest.approx(37.37736814, abs=5e-9)
    edge = atan(1 / 2)  # from a pentagon's axis to the middle of its edge
    cone = atan2(sin(between), 3 / 5 + cos(between))
    assert f"{degrees(2 * asin(sin(radians(18)) / cos(radians(36)))):.7f}°" in PAGE
    assert f"{degrees(asin(2 / 3)):.13f}°" in PAGE
    assert f"lies {degrees(cone):.3f}° from the pentagon's axis, the middle of the edge {degrees(edge):.3f}°" in PAGE
    assert f"irrational ratio {sin(edge) / sin(between - edge):.12f}" in PAGE
    assert f"< z5/z3 < {sqrt(3) / tan(pi / 10):.9f}" in PAGE
