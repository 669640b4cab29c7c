"""Months of eclipses on the Saros dial, counted again by the eclipse year model of Freeth 2014 (PLOS ONE 9(7):e103275).

A month has 38 units, an eclipse year 446, so that 223 months are 19 eclipse years; a node comes every 223 units.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import shipped

MONTHS, MONTH, TO_NODE = 223, 38, 223
FIRST_NODE, FULL, NEW = 66, 17, 36  # units: the first node; from the beginning of a month to the full and the new Moon
LIMIT, SOUTHERN = 20, 7  # units from a node at which the Moon is eclipsed, and the Sun north of its path; south of it
MOON, SUN = "Σ", "Η"
LEGIBLE = {20: MOON, 25: SUN, 26: MOON, 72: SUN, 78: SUN, 79: MOON, 114: MOON, 119: SUN, 190: MOON}
LEGIBLE |= dict.fromkeys((125, 131, 137, 172, 178, 184), MOON + SUN)
"""Those whose hours are read on the fragments (table S3B)."""


def past_node(units: int) -> tuple[int, bool]:
    """Units past the nearest node, and whether the Moon goes north there."""
    node = round((units - FIRST_NODE) / TO_NODE)
    return units - FIRST_NODE - TO_NODE * node, node % 2 == 1


def model() -> Iterator[tuple[int, str]]:
    """Of two lunar eclipses in a row, the first alone is told."""
    told = False
    for month in range(1, MONTHS + 1):
        begun = MONTH * (month - 1)
        moon = not told and abs(past_node(begun + FULL)[0]) <= LIMIT
        off, rising = past_node(begun + NEW)
        sun = abs(off) <= (LIMIT if (off >= 0) == rising else SOUTHERN)
        told = moon
        if moon or sun:
            yield month, MOON * moon + SUN * sun


@pytest.mark.parametrize("name", ["freeth-2008", "freeth-2021", "voulgaris-2022"])
def test_the_glyphs_are_those_of_the_eclipse_year_model(name: str) -> None:
    assert MONTHS * MONTH == 19 * 2 * TO_NODE, "a Saros is 19 eclipse years"
    assert dict(shipped.train(name).declaration.dials["saros"].glyphs) == dict(model())


def test_there_are_51_of_them_and_they_agree_with_what_is_read_on_the_fragments() -> None:
    glyphs = shipped.train("freeth-2008").declaration.dials["saros"].glyphs
    assert len(glyphs) == 51
    assert [sum(kind in each for each in glyphs.values()) for kind in (MOON, SUN)] == [38, 28]
    assert {month: glyphs[month] for month in LEGIBLE} == LEGIBLE
