"""Fractions near a number, and the pairs of wheels they are: against definitions, brute force and printed numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain.errors import QuestionError, RangeError
from geartrain.search import StageFindings, TargetRatio, approximants, find_stages, read_counts, read_ratio

PI = Fraction("3.14159265358979323846264338327950288419716939937510")
ROOT = Fraction(math.isqrt(2 * 10**400), 10**200)  # the square root of two, to 200 decimals

positive = st.builds(Fraction, st.integers(1, 400), st.integers(1, 400))
bounds = st.integers(1, 40)


def walk_by_hand(value: Fraction, most: int) -> list[Fraction]:
    """From the root of the tree, one mediant at a time."""
    (a, b), (c, d), found = (0, 1), (1, 0), []
    while max(a + c, b + d) <= most:
        found.append(Fraction(a + c, b + d))
        if found[-1] == value:
            break
        if found[-1] < value:
            a, b = a + c, b + d
        else:
            c, d = a + c, b + d
    return found


def continued(value: Fraction) -> list[Fraction]:
    """The convergents of the continued fraction, each worked out from its terms backwards."""
    terms, rest = [], value
    while True:
        terms.append(math.floor(rest))
        if rest == terms[-1]:
            break
        rest = 1 / (rest - terms[-1])
    found = []
    for count in range(1, len(terms) + 1):
        last = Fraction(terms[count - 1])
        for term in terms[: count - 1][::-1]:
            last = term + 1 / last
        found.append(last)
    return found


def is_best(fraction: Fraction, value: Fraction) -> bool:
    """The definition: every other positive fraction whose denominator is not larger is farther off."""
    near = abs(fraction - value)
    for q in range(1, fraction.denominator + 1):
        p = math.floor(value * q)
        for other in {Fraction(t, q) for t in (p - 1, p, p + 1, p + 2) if t > 0} - {fraction}:
            if abs(other - value) <= near:
                return False
    return True


@given(positive, bounds)
def test_the_walk_is_that_of_one_mediant_at_a_time(value: Fraction, most: int) -> None:
    found = approximants(value, most)
    assert [approximant.value for approximant in found] == walk_by_hand(value, most)
    assert all(approximant.error == approximant.value / value - 1 for approximant in found)


@given(positive, bounds)
def test_kinds_are_as_defined(value: Fraction, most: int) -> None:
    found = {approximant.value: approximant.kind for approximant in approximants(value, most)}
    fits = [c for c in continued(value) if c and max(c.numerator, c.denominator) <= most]
    assert [fraction for fraction, kind in found.items() if kind == "convergent"] == list(dict.fromkeys(fits))
    best = [fraction for fraction, kind in found.items() if is_best(fraction, value)]
    assert [fraction for fraction, kind in found.items() if kind == "best"] == [f for f in best if f not in fits]
    # and no best one is missing from the walk
    for p in range(1, most + 1):
        for q in range(1, most + 1):
            if abs(Fraction(p, q) - value) < Fraction(1, q) and is_best(Fraction(p, q), value):
                assert Fraction(p, q) in found


@given(positive, bounds)
def test_a_list_of_convergents_or_best_ones_is_the_whole_list_without_the_others(value: Fraction, most: int) -> None:
    found = approximants(value, most)
    for minimum, kinds in (("convergent", ["convergent"]), ("best", ["convergent", "best"])):
        assert approximants(value, most, minimum) == tuple(a for a in found if a.kind in kinds)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("number", "most", "kind", "known"),
    [
        (PI, 104347, "convergent", "3 22/7 333/106 355/113 103993/33102"),
        (ROOT, 300, "convergent", "1 3/2 7/5 17/12 41/29 99/70 239/169"),
        # On-Line Encyclopedia of Integer Sequences, A063674 over A063673; a convergent need not be best, but 333/106,
        # which these two sequences list, is both
        (
            PI,
            52163,
            "best",
            "3 13/4 16/5 19/6 22/7 179/57 201/64 223/71 245/78 267/85 289/92 311/99 333/106 355/113 52163/16604",
        ),
        # leap years
        (Fraction("0.2422"), 130, "convergent", "1/4 7/29 8/33 31/128"),
        (Fraction("365.2422"), 46752, "convergent", "365 1461/4 10592/29 12053/33 46751/128"),
        # the Metonic cycle: 254 sidereal months are 235 synodic months, and 19 years
        (read_ratio("29.53059 d / 27.32166 d").value, 300, "convergent", "1 13/12 27/25 40/37 107/99 254/235"),
        (read_ratio("365.2422 d / 29.53059 d").value, 300, "convergent", "12 25/2 37/3 99/8 136/11 235/19"),
        (Fraction(1, 10**9), 10**12, "convergent", "1/1000000000"),
    ],
)
def test_lists_are_the_known_ones(number: Fraction, most: int, kind: Any, known: str) -> None:
    assert " ".join(str(found.value) for found in approximants(number, most, kind)) == known


def test_brocots_example() -> None:
    # a shaft of 23 minutes and one of 191; Brocot 1861, after B. Hayes, On the Teeth of Wheels, American Scientist 88
    # (2000): he begins with the row "8 1 -7", where -7 is 8 x 23 - 1 x 191, and goes on between 8/1 and 9/1
    found = approximants(Fraction(191, 23), 191)[7:]
    rows = [(f.value.numerator, f.value.denominator, int(f.error * 191 * f.value.denominator)) for f in found]
    assert rows[0] == (8, 1, -7)
    assert rows[1] == (9, 1, 16)
    # each row below is the sum of two above, third number included
    assert rows[2:] == [(17, 2, 9), (25, 3, 2), (33, 4, -5), (58, 7, -3), (83, 10, -1), (108, 13, 1), (191, 23, 0)]


def test_numbers_that_are_not_positive_and_long_lists_are_refused() -> None:
    with pytest.raises(RangeError, match="only the convergents"):
        approximants(Fraction(1, 10**9), 10**9)
    with pytest.raises(QuestionError, match="must be positive"):
        approximants(Fraction(0), 10)


def pairs(
    wanted: TargetRatio, wheels: Sequence[int], pinions: Sequence[int], tolerance: Fraction | None, best: int
) -> StageFindings:
    return find_stages(wanted, 1, wheels, pinions, tolerance=tolerance, best=best)


def pairs_by_denominator(
    value: Fraction, top: Sequence[int], beneath: Sequence[int], tolerance: Fraction
) -> list[tuple[int, int]]:
    """The pairs of two ranges within a tolerance, looked up for every count beneath, in the order asked for."""
    low, high = value * (1 - tolerance), value * (1 + tolerance)
    inside = []
    for q in beneath:
        first, last = max(math.ceil(low * q), top[0]), min(math.floor(high * q), top[-1])
        inside += [(p, q) for p in range(first, last + 1)]
    return sorted(inside, key=lambda pair: (abs(Fraction(*pair) - value), sum(pair), max(pair), pair))


def check_ranges(value: Fraction, wheels: range, pinions: range, tolerance: Fraction, best: int) -> None:
    top, beneath = (wheels, pinions) if value >= 1 else (pinions, wheels)
    inside = pairs_by_denominator(value, top, beneath, tolerance)
    within = pairs(TargetRatio(value), wheels, pinions, tolerance, len(inside) + 1)
    assert [stages.pairs[0] for stages in within] == inside
    assert within.count == len(inside)
    found = [stages.pairs[0] for stages in pairs(TargetRatio(value), wheels, pinions, None, best)]
    assert found[: len(inside)] == inside[:best]
    assert len(found) == min(best, len(top) * len(beneath))


@settings(max_examples=25)
@given(
    st.fractions(Fraction(1, 50), 50, max_denominator=10**6),
    st.integers(1, 900),
    st.integers(1, 900),
    st.integers(1, 3000),
    st.integers(1, 3000),
    st.fractions(0, Fraction(1, 2000)),
    st.integers(1, 60),
)
def test_long_ranges_give_what_a_look_at_every_count_gives(
    value: Fraction, a: int, b: int, more: int, most: int, tolerance: Fraction, best: int
) -> None:
    check_ranges(value, range(a, a + more), range(b, b + most), tolerance, best)


def test_multiples_of_an_exact_fraction_are_all_there() -> None:
    found = pairs(read_ratio("235/19"), range(30, 1000), range(12, 100), Fraction(0), 20)
    assert [stages.pairs[0] for stages in found] == [(235, 19), (470, 38), (705, 57), (940, 76)]


@pytest.mark.parametrize(
    ("value", "wheels", "pinions", "pair"),
    [
        ("1000", "12:1000", "12:1000", (1000, 12)),
        ("1/1000", "12:1000", "12:1000", (12, 1000)),
        ("13", "100:1000", "1000:2000", (1000, 1000)),
        ("5", "12:100,200:900", "90000:90100", (900, 90000)),
    ],
)
def test_a_ratio_out_of_reach_has_its_nearest_pair_at_a_corner(
    value: str, wheels: str, pinions: str, pair: tuple[int, int]
) -> None:
    found = pairs(read_ratio(value), read_counts(wheels), read_counts(pinions), None, 2)
    assert found[0].pairs == (pair,)
    assert abs(found[1].error) >= abs(found[0].error)
