"""What ratio is wanted and which tooth counts may make it, read from text."""

from __future__ import annotations

import csv
import pickle
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import geartrain
from geartrain.errors import GearTrainError, QuestionError, RangeError
from geartrain.search import CountRuns, TargetRatio, read_counts, read_ratio

YEAR, MONTH = Fraction("365.242190402"), Fraction("29.530588853")  # days, as the table prints them


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("13.368267", "13.368267"),
        ("235/19", "235/19"),
        ("235 : 19", "235/19"),
        ("1:30", "1/30"),
        ("2.5e-3", "1/400"),
        ("1.5/2", "3/4"),
        ("235 months / 19 years", "235/19"),
        ("235 months/19 years", "235/19"),
        ("27759 days / 940 months", "27759/940"),
        ("1 year / 365.2422 days", "10000/3652422"),
        ("223 lunar months : 18.03 years", "22300/1803"),
        ("365.2422 d / 29.53059 d", "36524220/2953059"),
        ("6940/19 d / 6940/235 d", "235/19"),
        ("24 hours / 90 min", "16"),
        ("7 days / 12 h", "14"),
        ("year_callippic / month_callippic", "940/76"),
        ("year_callippic/29.53059 d", "36525000/2953059"),
        ("metonic_months_per_year", "235/19"),
        ("saros_synodic_months", "223"),
        ("saros_synodic_months / saros_anomalistic_months", "223/239"),
        ("metonic_sidereal_months_per_year / metonic_months_per_year", "254/235"),
        ("lunar_nodes_per_year_saros", "12/223"),
    ],
)
def test_a_ratio_means_what_its_words_say(text: str, value: str) -> None:
    wanted = read_ratio(text)
    assert wanted.value == Fraction(value)
    assert wanted.sense == 0
    assert wanted.label == text


def test_a_quotient_of_two_periods_is_how_often_the_second_turns_in_the_first() -> None:
    wanted = read_ratio("year_tropical_J2000 / month_synodic_J2000")
    assert wanted.value == YEAR / MONTH
    assert 12 < wanted.value < 13
    assert read_ratio("month_synodic_J2000", per="year_tropical_J2000").value == wanted.value
    assert read_ratio("29.530588853 d", per="365.242190402 d").value == wanted.value
    # a speed per year stays what it is per year
    assert read_ratio("metonic_months_per_year", per="year_julian").value == Fraction(235, 19)


def test_a_name_brings_its_source_along() -> None:
    note = read_ratio("year_tropical_J2000 / month_synodic_J2000").note
    assert "365.242190402 d" in note
    assert "Simon et al. 1994" in note
    assert "Chapront" in note
    assert read_ratio("235 months / 19 years").note == "235 months in the time of 19 years"
    assert read_ratio("1:30").to_dict() == {
        "label": "1:30",
        "ratio": "1/30",
        "value": 1 / 30,
        "sense": 0,
        "note": "as given",
    }


def test_every_name_of_the_table_is_read() -> None:
    path = Path(geartrain.__file__).parent / "train" / "periods.csv"
    for row in csv.DictReader(path.read_text(encoding="utf-8").splitlines()):
        value = abs(Fraction(row["exact"] or row["value"]))
        if row["kind"] == "period":
            assert read_ratio(row["name"], per="1 d").value == 1 / value
            with pytest.raises(QuestionError, match="is a period, not a ratio"):
                read_ratio(row["name"])
        else:
            assert read_ratio(row["name"]).value == value


@pytest.mark.parametrize(("sign", "sense"), [("", 0), ("+", 1), ("-", -1), ("−", -1), ("- ", -1)])
@pytest.mark.parametrize("text", ["13.368267", "235/19", "235 months / 19 years", "metonic_months_per_year"])
def test_a_sign_in_front_asks_for_a_sense(sign: str, sense: int, text: str) -> None:
    wanted = read_ratio(sign + text)
    assert wanted.sense == sense
    assert wanted.value == read_ratio(text).value > 0


@given(st.integers(1, 10**30), st.integers(1, 10**30), st.sampled_from(["/", ":", " / "]))
def test_a_fraction_is_exact_at_any_length(top: int, bottom: int, sign: str) -> None:
    assert read_ratio(f"{top}{sign}{bottom}").value == Fraction(top, bottom)
    assert read_ratio(f"{top} x{sign}{bottom} y").value == Fraction(top, bottom)
    assert read_ratio(f"{top} h / {bottom} h").value == Fraction(top, bottom)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "lacks a number"),
        (" - ", "lacks a number"),
        ("235/", "lacks a number"),
        ("0", "contains a zero"),
        ("-0", "contains a zero"),
        ("0 months / 19 years", "contains a zero"),
        ("235/0", "contains a zero"),
        ("5/0 d / 3 d", "divides by zero"),
        ("--3", "has a sign"),
        ("235/-19", "has a sign"),
        ("1/2/3", "more than one division sign"),
        ("9" * 401, "at most 400 characters"),
        ("9" * 5000, "5000 characters"),
        ("1e9999", "three digits"),
        ("1e308", "1e308 is out of range"),
        ("1e-320", "from 1e-300 to 1e300"),
        ("1e-400", "from 1e-300 to 1e300"),
        ("1e-200/1e200", "from 1e-30 to 1e30"),
        ("1e31", "from 1e-30 to 1e30"),
        ("1_000", "is not a number"),
        ("%", "is not a number"),
        ("year_tropicl_J2000", "did you mean 'year_tropical_J2000'"),
        ("moon", "is not a number"),
        ("235 months", "only one count"),
        ("19 years", "'235 months / 19 years'"),
        ("month_synodic_J2000", "'year_tropical_J2000 / month_synodic_J2000'"),
        ("year_tropical_J2000", "'year_tropical_J2000 / month_synodic_J2000'"),
        ("-29.5 d", "'year_tropical_J2000 / 29.5 d'"),
        ("235 months / 19", "different quantities"),
        ("365 d / 1 lunation", "different quantities"),
        ("year_julian / metonic_months_per_year", "different quantities"),
        ("24 hours / 1 day", "the same time on both sides"),
        ("235 month_synodic_J2000 / 19 year_julian", "ambiguous"),
        ("3 mm / 2 mm", "is a length"),
        ("100 rpm / 3 rpm", "is a speed"),
    ],
)
def test_what_has_no_meaning_is_refused_with_advice(text: str, said: str) -> None:
    check_refusal(lambda: read_ratio(text), said)


def check_refusal(ask: Callable[[], object], said: str) -> None:
    with pytest.raises(QuestionError) as caught:
        ask()
    assert said in str(caught.value)
    (problem,) = caught.value.problems
    assert all((problem.what, problem.why, problem.fix))


@pytest.mark.parametrize(
    ("text", "per", "said"),
    [
        ("235/19", "year_julian", "is already a ratio"),
        ("year_julian / month_metonic", "1 d", "is already a ratio"),
        ("saros_synodic_months", "year_julian", "is already a ratio"),
        ("metonic_months_per_year", "1 d", "is already a ratio"),
        ("month_synodic_J2000", "12", "must be a period"),
        ("month_synodic_J2000", "0 d", "zero"),
        ("month_synodic_J2000", "year_tropicl_J2000", "did you mean"),
    ],
)
def test_per_is_a_period_and_belongs_to_a_lone_period(text: str, per: str, said: str) -> None:
    check_refusal(lambda: read_ratio(text, per), said)


def test_a_wanted_ratio_is_positive() -> None:
    for value in (Fraction(0), Fraction(-1, 3)):
        with pytest.raises(QuestionError, match="must be positive"):
            TargetRatio(value)


@given(st.text(max_size=30) | st.text("0123456789.:/,+-eEdhx ", max_size=12))
def test_any_text_is_read_or_refused(text: str) -> None:
    problems = []
    for read in (read_ratio, read_counts):
        try:
            read(text)
        except GearTrainError as error:
            problems += error.problems
    assert all(problem.what and problem.why and problem.fix for problem in problems)


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        ("15:18", (15, 16, 17, 18)),
        ("30,36,48", (30, 36, 48)),
        ("48, 30 ,36,30", (30, 36, 48)),
        ("12:14,48,60", (12, 13, 14, 48, 60)),
        ("12:14,13:16, 17", (12, 13, 14, 15, 16, 17)),
        (" 7 ", (7,)),
        ("1:1", (1,)),
    ],
)
def test_counts_ascend_without_repeats(text: str, counts: tuple[int, ...]) -> None:
    assert tuple(read_counts(text)) == counts
    assert np.array(tuple(read_counts(text))).tolist() == list(counts)


@given(st.sets(st.integers(1, 60), min_size=1))
def test_runs_are_the_sequence_of_their_counts(counts: set[int]) -> None:
    plain = sorted(counts)
    runs = CountRuns.of(counts)
    assert list(runs) == plain == list(runs.as_array())
    assert [len(runs), runs.minimum, runs.most] == [len(plain), plain[0], plain[-1]]
    assert [runs[at] for at in range(len(runs))] == plain
    assert (runs[-1], runs[1:4], runs[::-1]) == (plain[-1], tuple(plain[1:4]), tuple(plain[::-1]))
    for count in range(-1, 63):
        assert (count in runs) == (count in counts)
        assert (np.int64(count) in runs) == (count in counts)
    assert (
        read_counts(str(runs))
        == runs
        == pickle.loads(pickle.dumps(runs))
        == CountRuns.of(runs)
        == CountRuns.of(plain[::-1])
    )


def test_a_range_of_any_length_stays_a_range() -> None:
    counts = read_counts("12:1000000000")
    assert (len(counts), counts[-1], counts[10**8], 10**9 in counts) == (10**9 - 11, 10**9, 10**8 + 12, True)
    assert counts == CountRuns.of(range(12, 10**9 + 1))
    assert counts.to_dict() == {"counts": "12:1000000000", "minimum": 12, "most": 10**9, "number": 10**9 - 11}
    with pytest.raises(RangeError, match="999999989 tooth counts are too many to list"):
        counts.as_array()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no tooth counts"),
        ("12,,14", "'' is not a tooth count"),
        ("0:5", "a wheel cannot have 0 teeth"),
        ("-5", "is not a tooth count"),
        ("12-40", "is not a tooth count"),
        ("12.5", "is not a tooth count"),
        ("12:40:2", "is not a tooth count"),
        ("40:12", "for example, write 12:40"),
        ("1000000000001", "tooth counts are from 1 to"),
        ("9" * 200, "is not a tooth count"),
    ],
)
def test_what_no_wheel_can_have_is_refused_with_advice(text: str, said: str) -> None:
    check_refusal(lambda: read_counts(text), said)
