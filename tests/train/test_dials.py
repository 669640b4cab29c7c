"""Dials as declared: named scales, names with spans, numerals, glyphs, rings, and what they refuse."""

from __future__ import annotations

from fractions import Fraction

import pytest

from geartrain import GearTrain
from geartrain.errors import DeclarationError
from geartrain.train import Dial, declare


def declared(**keys: object) -> dict[str, object]:
    return {
        "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
        "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]},
        "gears": ["p ~ w"],
        "inputs": {"a": 1},
        "dials": {"d": keys},
        "outputs": {"b": {"dial": "d"}},
    }


def dial(**keys: object) -> Dial:
    return declare(declared(**keys)).dials["d"]


def refusal(**keys: object) -> str:
    with pytest.raises(DeclarationError) as found:
        dial(**keys)
    return str(found.value)


def test_the_zodiac_is_twelve_signs_of_thirty_degrees() -> None:
    zodiac = dial(names="zodiac")
    assert (zodiac.divisions, zodiac.cell, len(zodiac.names)) == (360, "degree", 12)
    assert [first for _, first, _ in zodiac.parts] == [30 * sign for sign in range(12)]
    assert [zodiac.parts[at][0] for at in (0, 6, 11)] == ["Aries", "Libra", "Pisces"]


def test_the_egyptian_year_is_twelve_months_and_five_days() -> None:
    year = dial(names="egyptian_months")
    assert (year.divisions, year.cell) == (365, "day")
    assert [span for _, _, span in year.parts] == [30] * 12 + [5]
    assert year.parts[-1] == ("Epagomenal", Fraction(360), Fraction(5))


def test_a_named_scale_shares_out_other_divisions_where_they_are_whole() -> None:
    signs = dial(names="zodiac", divisions=12)
    assert {span for _, _, span in signs.parts} == {1}
    assert signs.cell == "", "a twelfth is no degree"
    assert "360 divisions cannot be distributed over" in refusal(names="egyptian_months", divisions=360)


def test_names_without_spans_share_the_divisions_equally() -> None:
    games = dial(names=["a", "b", "c", "d"])
    assert games.divisions == 4
    assert dial(names=["a", "b", "c"], divisions=76).parts[1] == ("b", Fraction(76, 3), Fraction(76, 3))


def test_names_with_spans_count_the_divisions() -> None:
    assert dial(names=[{"name": "a", "span": 2}, {"name": "b", "span": 5}]).divisions == 7


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"names": "zodiak"}, "did you mean 'zodiac'?"),
        ({"names": "egyptian_month"}, "did you mean 'egyptian_months'?"),
        ({"divisions": "zodiac"}, "write `names: zodiac`"),
        ({"divisions": 0}, "0 is not a valid number of divisions or turns"),
        ({"turns": "1/2"}, "1/2 is not a valid number of divisions or turns"),
        ({"divisions": 6, "names": [{"name": "a", "span": 2}, {"name": "b", "span": 3}]}, "up to 5, 1 too few for 6"),
        ({"divisions": 4, "names": [{"name": "a", "span": 2}, {"name": "b", "span": 3}]}, "up to 5, 1 too many for 4"),
        ({"names": ["a", {"name": "b", "span": 3}]}, "'a' has no span, but other names have one"),
        ({"divisions": 3, "glyphs": {4: "x"}}, "cell 4 is beyond the 3 divisions"),
        ({"glyphs": {"x": "y"}}, "x is not a valid number of divisions"),
        ({"numerals": "romain"}, "use 'roman' or 'arabic'"),
        ({"around": {"names": "zodiac", "turns": 2}}, "unknown key 'turns'"),
        ({"counted": "left"}, "use 'clockwise' or 'counter-clockwise'"),
    ],
)
def test_what_a_dial_refuses_it_says_how_to_mend(keys: dict[str, object], said: str) -> None:
    assert said in refusal(**keys)


def test_glyphs_are_read_by_their_cells() -> None:
    assert dict(dial(turns=4, divisions=223, glyphs={"13": "Η", 20: "Σ"}).glyphs) == {13: "Η", 20: "Σ"}


@pytest.mark.parametrize(
    ("face", "seen", "away"),
    [
        ("front", "dial", False),
        ("front", "back", True),
        ("back", "front", True),
        ("back", "rear", False),
        (None, "back", False),
    ],
)
def test_a_dial_looks_away_only_from_who_looks_from_behind_it(face: str | None, seen: str, away: bool) -> None:
    view = {"from": seen, "positive": "clockwise"}
    report = str(GearTrain.declare({**declared(**({"face": face} if face else {})), "view": view}).report())
    # the pointer makes -1/3 turn
    assert ("counter-clockwise, a turn in" in report) != away
