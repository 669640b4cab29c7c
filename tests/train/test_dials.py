"""Dials as declared: named scales, names with spans, numerals, glyphs, rings, and what they refuse."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from geartrain import GearTrain
from geartrain.errors import DeclarationError
from geartrain.train import declare


def declared(**keys: object) -> dict[str, object]:
    return {
        "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
        "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]},
        "gears": ["p ~ w"],
        "inputs": {"a": 1},
        "dials": {"d": keys},
        "outputs": {"b": {"dial": "d"}},
    }


def dial(**keys: object) -> Any:
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
        ({"face": "left"}, "use 'front' or 'back'"),
        ({"diameter": "0 mm"}, "must be greater than 0"),
        ({"diameter": "-3 mm"}, "give a diameter such as 150 mm"),
        ({"centre": ["0 mm"]}, "dials.d.centre"),
        ({"source": "X"}, "declare `sources: {X: author and year}`"),
        ({"divisions": 3, "doubled": [4]}, "cell 4 is beyond the 3 divisions"),
        ({"names": ["day", "night"], "inscriptions": {"nigth": "ΝΥΞ"}}, "did you mean 'night'?"),
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


def test_names_of_cells_repeat_and_leap_months_double_the_month_before() -> None:
    found = dial(divisions=7, cell_names=["a", "b", "c"], doubled=[3, 6])
    assert " ".join(found.cells) == "a b b c a a b"


BIG, SMALL = {"centre": ["0 mm", "0 mm"], "diameter": "100 mm"}, {"centre": ["20 mm", "0 mm"], "diameter": "10 mm"}


@pytest.mark.parametrize(
    ("one", "other", "over"),
    [
        (BIG, {**BIG, "centre": ["101 mm", "0 mm"]}, None),
        (BIG, {**BIG, "centre": ["60 mm", "79 mm"]}, "0.798"),  # 100 - sqrt(60^2 + 79^2)
        (BIG, {**BIG, "centre": ["99 mm", "0 mm"], "face": "back"}, None),
        (BIG, SMALL, None),
        # a circle is engraved to 0.74 of its radius: 20 mm + 20 mm - 37 mm
        (BIG, {**SMALL, "diameter": "40 mm"}, "3"),
        # a spiral of five turns to 0.46 of its radius: 20 mm + 5 mm - 23 mm
        ({**BIG, "turns": 5}, SMALL, "2"),
        # on the right, after a quarter turn, its outermost turn is 3/4 of 0.09 radii from its end, or 3.375 mm
        ({**BIG, "turns": 5}, {**BIG, "centre": ["97 mm", "0 mm"]}, None),
        ({**BIG, "turns": 5, "counted": "counter-clockwise"}, {**BIG, "centre": ["97 mm", "0 mm"]}, "1.88"),
    ],
)
def test_dials_of_one_face_may_not_overlap(one: dict[str, object], other: dict[str, object], over: str | None) -> None:
    data = {**declared(**one), "dials": {"d": one, "e": other}}
    if over is None:
        assert set(declare(data).dials) == {"d", "e"}
        return
    with pytest.raises(DeclarationError) as found:
        declare(data)
    assert f"dials 'd' and 'e' overlap by {over} mm" in str(found.value)
    assert "reduce a `diameter`" in str(found.value)
