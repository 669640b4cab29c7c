"""The law of the page on radii: of pairs that it was not fitted to, and what stands on the page."""

from __future__ import annotations

import re
from math import exp, pi

import pytest
from places import DOCS

from geartrain.workshop import ToothSizes, find_tooth_sizes

PAGE = (DOCS / "best-radii.md").read_text(encoding="utf-8")
A, B = (float(each) for each in re.findall(r"-\s*([\d.]+)\\left\(", PAGE.split("$$")[1]))


def law(z1: int, z2: int) -> float:
    return exp(-A * (1 / z1 - 1 / z2) - B * (1 / z1 + 1 / z2) ** 2)


def times_the_least(z1: int, z2: int) -> float:
    pair = ToothSizes((z1, z2), law(z1, z2), 0.5, (pi / 6, pi / 6), 0.2)
    near = (pair.radii - 0.03, pair.radii + 0.03)
    return pair.loss / find_tooth_sizes(pair, free={"radii": near}).best.loss


def test_the_law_is_within_a_few_percent_of_the_least_loss() -> None:
    assert times_the_least(37, 89) < 1.02


@pytest.mark.long
@pytest.mark.parametrize("teeth", [(13, 47), (47, 13), (22, 101), (101, 22), (71, 73), (11, 17), (113, 64), (64, 38)])
def test_the_law_holds_for_other_counts_than_those_it_was_fitted_to(teeth: tuple[int, int]) -> None:
    assert times_the_least(*teeth) < 1.02


def test_the_page_has_the_pairs_of_the_literature() -> None:
    """48/96 and 15/60: the best, pitch-true radii and equal depth."""
    rows = {row[0]: row[3:] for line in PAGE.splitlines() if len(row := line.strip("| ").split(" | ")) == 7}
    assert rows["48/96"] == ["0.89 %", "0.89 %", "2.27 %", "3.19 %"]
    assert rows["15/60"] == ["2.65 %", "2.65 %", "5.03 %", "10.27 %"]
