"""Numbers and quantities as people write them."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from geartrain import GearTrain, GearTrainError
from geartrain.numerics import Figure, Quantity


@given(st.integers(-(10**12), 10**12))
def test_an_integer_is_exact(number: int) -> None:
    for raw in (number, str(number)):
        figure = Figure.parse(raw)
        assert (figure.value, figure.half) == (number, None)


@given(st.integers(-(10**6), 10**6), st.integers(1, 10**6), st.sampled_from(["/", ":", " / ", " : "]))
def test_a_fraction_is_exact(top: int, bottom: int, sign: str) -> None:
    figure = Figure.parse(f"{top}{sign}{bottom}")
    assert (figure.value, figure.half) == (Fraction(top, bottom), None)


@given(st.decimals(min_value=-1000, max_value=1000, places=4))
def test_a_decimal_holds_half_a_unit_of_its_last_digit_either_way(number: Decimal) -> None:
    figure, half = Figure.parse(f"{number:.4f}"), Fraction(1, 20000)
    assert figure.value == Fraction(number)
    assert figure.holds(figure.value + half)
    assert figure.holds(figure.value - half)
    assert not figure.holds(figure.value + half + Fraction(1, 10**9))
    assert not figure.holds(figure.value - half - Fraction(1, 10**9))


@pytest.mark.parametrize(
    ("text", "value", "half"),
    [
        ("1:30", "1/30", None),
        ("13.3684", "13.3684", "0.00005"),
        ("1.", "1", "0.5"),
        (".5", "0.5", "0.05"),
        ("-2.50", "-2.5", "0.005"),
        ("+3", "3", None),
        ("1e3", "1000", "500"),
        ("2.5e-3", "0.0025", "0.00005"),
        ("1.5/2", "0.75", None),
        (" 7 ", "7", None),
        (0.25, "0.25", "0.005"),
    ],
)
def test_digits_as_written_decide_what_holds(text: object, value: str, half: str | None) -> None:
    figure = Figure.parse(text)
    assert figure.value == Fraction(value)
    assert figure.half == (None if half is None else Fraction(half))


NO_NUMBERS = ["a", "1/2/3", "1:2:3", "1/", "/2", "0x10", "1_000", "1,5", "--1", "inf", "nan", "½", "1e9999"]
REFUSED = {
    "is not a number": ["", "1 2", "1" * 500, *NO_NUMBERS, True, None, [1]],
    "out of range": ["1e301", "-1e999", "1e200/1e-200", "9" * 302, "1e-301", "-1e-999", "1e-200/1e200"],
    "divides by zero": ["1/0", "3:0", "1/0.0"],
}


@pytest.mark.parametrize(("said", "raw"), [(said, raw) for said, every in REFUSED.items() for raw in every])
def test_what_is_no_number_is_refused(said: str, raw: object) -> None:
    with pytest.raises(ValueError, match=said):
        Figure.parse(raw)


def test_a_tolerance_replaces_the_digits() -> None:
    figure = Figure.parse("0.33")
    assert figure.holds(Fraction(1, 3))
    assert not figure.holds(Fraction(1, 3), Fraction(1, 1000))


@pytest.mark.parametrize(
    ("text", "dimension", "base"),
    [
        ("9.6 mm", "length", "0.0096"),
        ("1 in", "length", "0.0254"),
        ("18 ft", "length", "5.4864"),
        ("1 mile", "length", "1609.344"),
        ("3/8 in", "length", "0.009525"),
        ("30 deg", "angle", "1/12"),
        ("1 arcmin", "angle", "1/21600"),
        ("7 d", "time", "604800"),
        ("29.53059 d", "time", "2551442.976"),
        ("100 rpm", "speed", "5/3"),
        ("6 deg/s", "speed", "1/60"),
        ("-3 N mm", "torque", "-0.003"),
        ("5 Nm", "torque", "5"),
        ("20 ppm", "fraction", "0.00002"),
        ("2 %", "fraction", "0.02"),
        ("4 g cm2", "inertia", "4e-7"),
    ],
)
def test_units_are_exact(text: str, dimension: str, base: str) -> None:
    quantity = Quantity.parse(text, dimension, plain=False)
    assert quantity.base == Fraction(base)
    assert quantity.dimension == dimension
    assert str(quantity) == text


def test_an_rpm_is_two_pi_over_sixty_radians_a_second() -> None:
    assert Quantity.parse("1 rpm", "speed", plain=False).si == pytest.approx(2 * math.pi / 60, rel=1e-15)
    assert Quantity.parse("180 deg", "angle", plain=False).si == pytest.approx(math.pi, rel=1e-15)


def test_a_radian_is_no_rational_part_of_a_turn() -> None:
    quantity = Quantity.parse("1.5 rad", "angle", plain=False)
    assert quantity.si == 1.5
    assert float(quantity.base) == 1.5 / math.tau
    assert quantity.base != Fraction(1.5 / math.tau)  # to 50 digits, not to those of a float


@pytest.mark.parametrize(
    ("text", "dimension", "said"),
    [
        ("3 mm", "angle", "is a length, but an angle is required"),
        ("3 parsec", "length", "unknown unit"),
        ("3", "length", "no unit"),
        ("3 mm mm", "length", "unknown unit"),
        ("mm", "length", "not a number"),
    ],
)
def test_a_wrong_unit_is_refused(text: str, dimension: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Quantity.parse(text, dimension, plain=False)


def test_a_plain_number_is_welcome_where_only_ratios_are_requested() -> None:
    quantity = Quantity.parse("5/2", "speed", plain=True)
    assert (quantity.value, quantity.unit, quantity.dimension) == (Fraction(5, 2), None, None)


LENGTHS = [
    "{links: {a: {wheels: {x: {module: SIZE}}}}}",
    "{links: {a: {wheels: {x: {thickness: SIZE}}}}}",
    "{links: {a: {wheels: {x: {face_width: SIZE}}}}}",
    "{links: {a: {arbor: {diameter: SIZE, span: 20 mm}}}}",
    "{links: {a: {arbor: {diameter: 2 mm, span: SIZE}}}}",
    "{axes: {A: {position: [SIZE, 0, 0]}}}",
    "{thickness: SIZE}",
    "{drive: {weight: 1 kg, drum: SIZE}}",
    "{escapement: {link: a, teeth: 30, beat: 1 s, pendulum: SIZE}}",
    "{tooth_form: {form: involute, backlash: SIZE}}",
    "{tooth_form: {form: involute, centre_distance: SIZE}}",
    "{tooth_form: {form: lantern, pin_diameter: SIZE}}",
    "{cutting: {eccentricity: SIZE}}",
]


@pytest.mark.parametrize("change", LENGTHS)
@pytest.mark.parametrize("size", ["1e16 mm", "1e30 mm", "1e-20 mm", "2e9 km"])
def test_every_key_of_a_size_is_bounded_with_place_reason_and_fix(change: str, size: str) -> None:
    if "eccentricity" in change and size.startswith("1e-"):
        return  # an error may be as small as one likes
    with pytest.raises(GearTrainError) as found:
        GearTrain.declare(yaml.safe_load(PAIR)).with_changes(yaml.safe_load(change.replace("SIZE", size)))
    (problem,) = found.value.problems
    assert "out of range" in problem.what
    assert "from 1e-" in problem.why
    assert "write a length in that range" in problem.fix


PAIR = """
links: {frame: {}, a: {wheels: {x: {teeth: 20}}}, b: {wheels: {y: 30}}}
axes: {A: {direction: [0, 0, 1]}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [x, y]}]
inputs: {a: 1}
"""


def test_distances_that_something_goes_are_no_sizes_of_bodies() -> None:
    """An odometer may count the way round the Earth."""
    assert Quantity.parse("40075 km", "time or length", plain=False).base == 40_075_000
