"""Fractions near a number, and the pairs of wheels they are: against definitions, brute force and printed numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many

from geartrain.errors import QuestionError, RangeError
from geartrain.search import StageFindings, TargetRatio, approximants, find_stages, read_counts, read_ratio
from geartrain.search.ratio import stage_search

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


def values(number: Fraction, most: int, minimum: str) -> list[str]:
    return [str(found.value) for found in approximants(number, most, minimum)]  # type: ignore[arg-type]


def test_convergents_of_pi_and_of_the_root_of_two_are_the_known_ones() -> None:
    assert values(PI, 10**6, "convergent")[:5] == ["3", "22/7", "333/106", "355/113", "103993/33102"]
    assert values(ROOT, 300, "convergent") == ["1", "3/2", "7/5", "17/12", "41/29", "99/70", "239/169"]


def test_best_approximations_of_pi_are_the_known_ones() -> None:
    # On-Line Encyclopedia of Integer Sequences, A063674 over A063673
    known = "3 13/4 16/5 19/6 22/7 179/57 201/64 223/71 245/78 267/85 289/92 311/99 333/106 355/113 52163/16604"
    # a convergent need not be best; these two sequences list 333/106, which is both
    assert values(PI, 52163, "best") == known.split()


def test_leap_years_of_365_2422_days() -> None:
    assert values(Fraction("0.2422"), 130, "convergent") == ["1/4", "7/29", "8/33", "31/128"]
    assert values(Fraction("365.2422"), 46752, "convergent") == ["365", "1461/4", "10592/29", "12053/33", "46751/128"]


def test_the_metonic_cycle_is_a_convergent_of_the_two_months() -> None:
    found = values(read_ratio("29.53059 d / 27.32166 d").value, 300, "convergent")
    assert found == ["1", "13/12", "27/25", "40/37", "107/99", "254/235"]
    assert "235/19" in values(read_ratio("365.2422 d / 29.53059 d").value, 300, "convergent")


def test_brocots_example() -> None:
    # a shaft of 23 minutes and one of 191; Brocot 1861, after B. Hayes, On the Teeth of Wheels, American Scientist 88
    # (2000): he begins with the row "8 1 -7", where -7 is 8 x 23 - 1 x 191, and goes on between 8/1 and 9/1
    found = approximants(Fraction(191, 23), 191)[7:]
    rows = [(f.value.numerator, f.value.denominator, int(f.error * 191 * f.value.denominator)) for f in found]
    assert rows[0] == (8, 1, -7)
    assert rows[1] == (9, 1, 16)
    # each row below is the sum of two above, third number included
    assert rows[2:] == [(17, 2, 9), (25, 3, 2), (33, 4, -5), (58, 7, -3), (83, 10, -1), (108, 13, 1), (191, 23, 0)]


def test_a_long_target_without_a_kind_is_refused() -> None:
    assert values(Fraction(1, 10**9), 10**12, "convergent") == ["1/1000000000"]
    with pytest.raises(RangeError, match="only the convergents"):
        approximants(Fraction(1, 10**9), 10**9)


def test_numbers_that_are_not_positive_are_refused() -> None:
    with pytest.raises(QuestionError, match="must be positive"):
        approximants(Fraction(0), 10)


def pairs(
    wanted: TargetRatio,
    wheels: Sequence[int],
    pinions: Sequence[int],
    tolerance: Fraction | None = None,
    best: int | None = None,
) -> StageFindings:
    """One stage, by the search in long ranges whatever their length."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stage_search, "_LONG", 0)
        return find_stages(wanted, 1, wheels, pinions, tolerance=tolerance, best=best)  # type: ignore[arg-type]


def all_pairs(
    value: Fraction, wheels: Sequence[int], pinions: Sequence[int], tolerance: Fraction | None
) -> list[tuple[int, int]]:
    """Every pair, in the order asked for."""
    top, beneath = (wheels, pinions) if value >= 1 else (pinions, wheels)
    errors = {(p, q): abs(Fraction(p, q) / value - 1) for p in top for q in beneath}
    kept = [pair for pair in errors if tolerance is None or errors[pair] <= tolerance]
    return sorted(kept, key=lambda pair: (errors[pair], sum(pair), max(pair), pair))


counts = st.lists(st.integers(1, 60), min_size=1, max_size=12, unique=True).map(sorted) | st.builds(
    lambda first, size: range(first, first + size), st.integers(1, 40), st.integers(1, 30)
)
tolerances = st.none() | st.builds(Fraction, st.integers(0, 300), st.integers(1, 300))


@settings(max_examples=few_or_many(70, 150))
@given(positive, counts, counts, tolerances, st.none() | st.integers(1, 40))
def test_pairs_are_those_of_brute_force(
    value: Fraction, wheels: Sequence[int], pinions: Sequence[int], tolerance: Fraction | None, best: int | None
) -> None:
    found = pairs(TargetRatio(value), wheels, pinions, tolerance, best)
    expected = all_pairs(value, wheels, pinions, tolerance)
    assert [stages.pairs[0] for stages in found] == expected[: 20 if best is None and tolerance is None else best]
    for stages in found:
        assert stages.pairs == ((stages.top[0], stages.beneath[0]),)
        assert stages.ratio == Fraction(stages.top[0], stages.beneath[0])
        assert stages.error == stages.ratio / value - 1
    if tolerance is not None:
        assert found.count == len(expected)


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
    within = pairs(TargetRatio(value), wheels, pinions, tolerance)
    assert [stages.pairs[0] for stages in within] == inside
    assert within.count == len(inside)
    found = [stages.pairs[0] for stages in pairs(TargetRatio(value), wheels, pinions, best=best)]
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


@pytest.mark.parametrize("value", ["1", "254/235", "29.53059/27.32166", "0.73", "1/2", "2.000001", "3.7"])
@pytest.mark.parametrize("minimum", [12, 2000, 4500])
def test_so_do_ranges_where_the_tree_is_the_shorter_way(value: str, minimum: int) -> None:
    check_ranges(read_ratio(value).value, range(minimum, 6000), range(minimum // 2, 6000), Fraction(1, 10**6), 50)


@given(st.integers(10**30, 10**32), st.integers(10**7, 10**9))
def test_in_ranges_of_a_thousand_million_the_best_pair_is_the_nearest_fraction(number: int, most: int) -> None:
    value = Fraction(number, 10**30)
    (best,) = pairs(TargetRatio(value), range(1, 10**12), range(1, most + 1), best=1)
    # the standard library finds the nearest fraction by its denominator alone
    assert best.ratio == value.limit_denominator(most)
    (long,) = pairs(TargetRatio(value), range(1, 10**12), range(most // 2, most + 1), best=1)
    assert abs(long.error) >= abs(best.error)
    assert long.beneath[0] >= most // 2


def test_the_month_in_a_range_of_a_thousand_million() -> None:
    wanted = read_ratio("year_tropical_J2000 / month_synodic_J2000")
    wheels = read_counts("12:1000000000")
    found = pairs(wanted, wheels, wheels, best=5)
    assert len(found) == 5
    errors = [abs(stages.error) for stages in found]
    assert errors == sorted(errors)
    assert errors[0] < Fraction(1, 10**16)
    (metonic,) = pairs(wanted, range(12, 300), range(12, 30), best=1)
    assert metonic.pairs == ((235, 19),)


def test_a_ratio_below_one_has_its_wheels_beneath() -> None:
    (found,) = pairs(read_ratio("19/235"), range(100, 300), range(12, 60), best=1)
    assert (found.top, found.beneath, found.error) == ((19,), (235,), 0)


def test_multiples_of_an_exact_fraction_are_all_there() -> None:
    found = pairs(read_ratio("235/19"), range(30, 1000), range(12, 100), Fraction(0))
    assert [stages.pairs[0] for stages in found] == [(235, 19), (470, 38), (705, 57), (940, 76)]
    wheels = read_counts("12:1000000000")
    assert [stages.pairs[0] for stages in pairs(read_ratio("1"), wheels, wheels, best=3)] == [
        (12, 12),
        (13, 13),
        (14, 14),
    ]
    assert pairs(read_ratio("1"), wheels, wheels, Fraction(0), best=1).count == 10**9 - 11


@pytest.mark.parametrize(
    ("value", "wheels", "pinions", "pair"),
    [
        ("1000000000", "12:1000000000", "12:1000000000", (10**9, 12)),
        ("1/1000000000", "12:1000000000", "12:1000000000", (12, 10**9)),
        ("13", "100000000:1000000000", "1000000000:2000000000", (10**9, 10**9)),
        ("5", "12:1000000,2000000:9000000", "900000000:1000000000", (9000000, 900000000)),
        ("12", "120000000:120100000", "10000000:10001000", (120000000, 10000000)),
    ],
)
def test_a_ratio_out_of_reach_has_its_nearest_pair_at_a_corner(
    value: str, wheels: str, pinions: str, pair: tuple[int, int]
) -> None:
    found = pairs(read_ratio(value), read_counts(wheels), read_counts(pinions), best=2)
    assert found[0].pairs == (pair,)
    assert abs(found[1].error) >= abs(found[0].error)


def test_a_list_too_long_is_counted_and_refused() -> None:
    wheels = read_counts("12:1000000000")
    number = pairs(read_ratio("13.368267"), wheels, wheels, Fraction(1, 10**6), best=1).count
    with pytest.raises(RangeError, match=f"{number} pairs are within the tolerance"):
        pairs(read_ratio("13.368267"), wheels, wheels, Fraction(1, 10**6))
    assert len(pairs(read_ratio("13.368267"), wheels, wheels, Fraction(1, 10**6), best=7)) == 7


def test_impossible_questions_are_refused() -> None:
    with pytest.raises(QuestionError, match="give 0 or more"):
        pairs(read_ratio("2"), [30], [15], Fraction(-1, 10))
    with pytest.raises(QuestionError, match="give best >= 1"):
        pairs(read_ratio("2"), [30], [15], best=0)
    with pytest.raises(QuestionError, match="no tooth counts"):
        pairs(read_ratio("2"), [], [15])
