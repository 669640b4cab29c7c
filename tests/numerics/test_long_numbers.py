"""Numbers of thousands of digits: written, read and told everywhere, whatever limit Python sets on integers."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from commands import call
from hypothesis import assume, example, given
from hypothesis import strategies as st

from geartrain import GearTrain
from geartrain.errors import RangeError
from geartrain.numerics import decimal
from geartrain.numerics.exact import fraction_text, read_fraction

MINIMUM = 640  # digits: no process can set its limit lower, but for none at all
PAIRS = 60


@pytest.fixture(autouse=True)
def limit() -> Iterator[None]:
    """The lowest limit there is on integers and their digits; nobody may move it."""
    before = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(MINIMUM)
    yield
    assert sys.get_int_max_str_digits() == MINIMUM, "the limit is the user's"
    sys.set_int_max_str_digits(before)


def chain(driver: int, driven: int, **more: Any) -> dict[str, Any]:
    """Sixty pairs in a row, all alike: their product has some seven hundred digits."""
    links: dict[str, Any] = {"frame": {}, "g0": {"wheels": {}}}
    for at in range(1, PAIRS + 1):
        links[f"g{at - 1}"]["wheels"][f"a{at}"] = driver
        links[f"g{at}"] = {"wheels": {f"b{at}": driven}}
    return {
        "name": "long",
        "links": links,
        "revolutes": [{"pair": ["frame", f"g{at}"], "axis": f"A{at}"} for at in range(PAIRS + 1)],
        "gears": [{"pair": [f"a{at}", f"b{at}"]} for at in range(1, PAIRS + 1)],
        "inputs": {"g0": 1},
        **more,
    }


LAST = f"g{PAIRS}"
POINTER = {
    "dials": {"face": {"face": "front"}},
    "view": {"from": "front", "positive": "clockwise"},
    "outputs": {"last": {"of": LAST, "dial": "face", "expect": "1/3", "targets": [{"speed": "235/19"}]}},
}
NEAR = chain(999_999_999_989, 999_999_999_999, **POINTER)  # 0.9999999994: long, and of ordinary size
NEAR["links"][LAST]["wheels"] |= {
    f"b{PAIRS}": {"teeth": {"value": 999_999_999_999, "range": [999_999_999_998, 10**12]}}
}
FAR = chain(999_999_999_999, 17, **POINTER)  # beyond any float
LOADED = chain(999_999_999_999, 17, outputs={"last": {"of": LAST}}, loads={LAST: "1 N m"}, crank="g0")
LOOP = chain(999_999_999_989, 999_999_999_999)
LOOP["gears"] = [*LOOP["gears"], {"pair": ["a1", f"b{PAIRS}"]}]  # does not close


def long(driver: int, driven: int) -> Fraction:
    """The ratio of the chain, by a power."""
    return Fraction(-driver, driven) ** PAIRS


whole = st.integers(-(10**30), 10**30) | st.builds(
    lambda size, seed, sign: sign * (pow(3, size) ^ seed),
    st.integers(0, 12_000),
    st.integers(0, 2**60),
    st.sampled_from([-1, 1]),
)


@given(whole)
@example(10**640)
@example(10**640 - 1)
@example(-(10**2500))
def test_integers_of_any_size_are_written_as_python_does_without_its_limit(number: int) -> None:
    sys.set_int_max_str_digits(0)
    plain = str(number)
    sys.set_int_max_str_digits(MINIMUM)
    assert fraction_text(number) == plain
    assert read_fraction(plain) == number


@given(whole, whole.filter(bool))
def test_fractions_are_read_back_as_they_were_written(top: int, bottom: int) -> None:
    value = Fraction(top, bottom)
    found = read_fraction(fraction_text(value))
    assert (found.numerator, found.denominator) == (value.numerator, value.denominator)
    assert hash(found) == hash(value)


@given(whole.filter(bool), whole.filter(bool), st.integers(2, 20))
def test_decimals_beyond_floats_are_right_to_half_a_unit_of_their_last_digit(
    top: int, bottom: int, digits: int
) -> None:
    value = Fraction(top, bottom)
    assume(not Fraction(1, 10**308) < abs(value) < 10**309)
    mantissa, _, exponent = decimal(value, digits).partition("e")
    assert len(mantissa.lstrip("-")) == digits + 1
    unit = Fraction(10) ** (int(exponent) - digits + 1)
    assert abs(Fraction(mantissa) * Fraction(10) ** int(exponent) - value) * 2 <= unit


def test_ties_are_decided_by_all_digits() -> None:
    tie = Fraction(25 * 10**2000)
    assert [decimal(value, 1) for value in (tie - 1, tie, tie + 1)] == ["2e+2001", "2e+2001", "3e+2001"]


def test_a_long_number_is_told_by_its_decimal_and_the_number_of_its_digits(tmp_path: Path) -> None:
    file = tmp_path / "long.yaml"
    file.write_text(json.dumps(FAR | {"outputs": {"last": {"of": LAST}}}), encoding="utf-8")
    value = long(999_999_999_999, 17)
    told = call("solve", file, "--of", "last").output
    assert "(720 digits)/(74 digits)" in told
    assert decimal(value, 12) in told
    assert "e+6" in told


def test_json_has_every_digit(tmp_path: Path) -> None:
    file = tmp_path / "long.yaml"
    file.write_text(json.dumps(FAR), encoding="utf-8")
    value = long(999_999_999_999, 17)
    (data,) = json.loads(call("solve", file, "--json").output)["states"]
    assert read_fraction(data["speeds"][LAST]["exact"]) == value
    assert data["speeds"][LAST]["value"] is None
    assert data["speeds"][LAST]["decimal"] == decimal(value)
    (target,) = data["outputs"]["last"]["targets"]
    assert target["ppm"] is None, "no float holds it, and infinity would be a lie"


def test_a_notebook_shows_a_long_number_short() -> None:
    answer = GearTrain.declare(chain(999_999_999_999, 17)).solve()
    assert "(720 digits)/(74 digits)" in answer._repr_html_()


TOLD = [("solve",), ("solve", "--json"), ("check",), ("report",), ("report", "--json")]
SHOWN = [
    ("solve", "--of", "last", "--json"),
    ("report", "-o", "page.html"),
    ("compare", "{}"),
    ("compare", "{}", "--json"),
    ("inspect equations",),
    ("inspect equations", "--latex"),
    ("motion", "--turns", "1"),
    ("motion", "--turns", "1", "--json"),
    ("view", "-o", "view.html"),
    ("draw", "--kind", "dials", "--turns", "2", "-o", "dials.svg"),
    ("export", "--to", "parts", "--as", "csv"),
    ("export", "-o", "train.rexsj"),
]
REQUESTED = [
    *((command, data) for command in TOLD for data in (NEAR, FAR, LOADED, LOOP)),
    *((command, data) for command in SHOWN for data in (NEAR, FAR)),
    *((command, LOADED) for command in [("torques",), ("torques", "--json")]),
]


@pytest.mark.parametrize(
    ("command", "data"), REQUESTED, ids=lambda part: " ".join(part) if isinstance(part, tuple) else ""
)
def test_every_command_tells_long_numbers(
    command: tuple[str, ...], data: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("long.yaml").write_text(json.dumps(data), encoding="utf-8")
    name, *options = command
    result = call(*name.split(), "long.yaml", *(option.format("long.yaml") for option in options))
    if name == "motion" and data is FAR:  # angles are followed in float64
        assert isinstance(result.exception, RangeError)
    else:
        assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
        assert result.exit_code in (0, 1), result.output


def test_counts_in_doubt_tell_long_numbers(tmp_path: Path) -> None:
    file = tmp_path / "near.yaml"
    file.write_text(json.dumps(NEAR), encoding="utf-8")
    for more in ((), ("--json",)):
        result = call("posterior", file, *more)
        assert result.exit_code in (0, 1), result.exception
