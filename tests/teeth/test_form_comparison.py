"""Tooth forms beside the reference involute of the same pair and arcs."""

from __future__ import annotations

from math import cos, pi, radians, sin, tan

import pytest

from geartrain.errors import GearTrainError
from geartrain.numerics import Quantity
from geartrain.teeth import Involute, Lantern, compare_forms
from geartrain.teeth.conjugate import WheelPair, measure

PAIR = WheelPair(24, 36)


@pytest.mark.parametrize("arcs", [(0.5, 0.5), (0.3, 0.9), (0.0, 1.0), (-0.1, 1.1)])
def test_the_reference_involute_has_its_arcs_and_the_loss_of_buckingham(arcs: tuple[float, float]) -> None:
    found = Involute.pair_of_arcs(PAIR, arcs, {})
    first, last = (arc * pi for arc in arcs)  # a pitch is pi modules
    assert found.path.contact_ratio == pytest.approx(sum(arcs), rel=1e-15)
    assert found.path.arcs == pytest.approx((first, last))
    # |S| / cos psi of an involute is X: friction costs (1/R1 + 1/R2) times its mean over the arc, whatever the angle
    area = (last * abs(last) + first * abs(first)) / 2
    assert measure(found.path).one_pair.loss == pytest.approx((1 / 12 + 1 / 18) * area / (first + last), rel=1e-12)


@pytest.mark.parametrize(("mu", "percent"), [(0.0112, 0.122), (0.0385, 0.420), (0.0517, 0.564)])
def test_an_involute_of_24_and_36_teeth_loses_the_percentage_printed(mu: float, percent: float) -> None:
    """W. D. Smith (1993), at Buckingham's coefficients."""
    loss = measure(Involute.pair_of_arcs(PAIR, (0.5, 0.5), {}).path).one_pair.loss
    assert 100 * mu * loss == pytest.approx(percent, abs=5e-4)


def test_the_reference_involute_touches_on_a_line_at_20_degrees_and_has_no_backlash() -> None:
    found = Involute.pair_of_arcs(PAIR, (0.5, 0.5), {})
    reach = pi / 2 * cos(radians(20))
    for gear, (R, low, high) in enumerate(((12, -reach, reach), (18, -reach, reach)), 1):
        ends = [((R * sin(radians(20)) + d) ** 2 + (R * cos(radians(20))) ** 2) ** 0.5 for d in (low, high)]
        assert found.path.radii(gear) == pytest.approx(ends, rel=1e-12)
    assert found.backlash == 0
    assert found.path.at(0.0).psi == pytest.approx(radians(20), rel=1e-14)


def test_an_involute_of_another_angle_is_compared_with_that_of_20_degrees() -> None:
    found = compare_forms(PAIR, ["involute"], pressure_angle=Quantity.parse("25 deg", "angle", False))
    (form,) = found.forms
    assert form.ratios is not None
    assert form.ratios.one_pair["loss"] == pytest.approx(1, rel=1e-12)
    # at the ends of the path U2 = sin psi - B d: the slowest contact on a dedendum
    slowest = [sin(psi) - pi / 2 * cos(psi) / 12 for psi in (radians(25), radians(20))]
    assert form.ratios.free["slowest"] == pytest.approx(slowest[0] / slowest[1], rel=1e-9)
    # heights along the line: the path has as much travel, at another slope
    depths = [sin(psi) * cos(psi) for psi in (radians(25), radians(20))]
    assert form.ratios.free["depth"] == pytest.approx(depths[0] / depths[1], rel=1e-12)


def test_pins_have_all_their_contact_in_recess_and_an_involute_of_their_arcs_beside_them() -> None:
    lantern, beside = compare_forms(PAIR, ["lantern"], (0.4, 0.7)).forms
    assert lantern.pitches is not None
    approach, recess = lantern.pitches
    assert approach < 0
    assert approach + recess == pytest.approx(1.1, abs=1e-7)
    assert beside.name == "involute, recess only"
    assert beside.pitches == pytest.approx(lantern.pitches)
    (alone,) = compare_forms(PAIR, ["lantern"], (0.0, 1.0)).forms
    assert alone.name == "lantern"


def test_a_lantern_of_arcs_is_the_one_that_declares_them() -> None:
    made = Lantern.pair_of_arcs(PAIR, (0.5, 0.5), {})
    declared = Lantern.declared({"arcs": [0, str(made.path.recess.arc / pi)]}).path(24, 36)
    assert made.path.arcs == pytest.approx(declared.arcs, abs=1e-9)


def test_every_conjugate_form_and_every_reading_can_be_compared() -> None:
    with pytest.raises(GearTrainError) as refused:
        compare_forms(PAIR, ["rubber"])
    known = refused.value.problems[0].fix.partition(": ")[2].split(", ")
    assert {form.name for form in compare_forms(PAIR).forms} <= {*known, "involute, recess only"}
    assert [name for name in known if name.startswith("uniform_temperature")] == [
        f"uniform_temperature{reading}" for reading in ("", "_a", "_b", "_c")
    ]
    assert not {"circular_arc", "triangular", "ideal"} & set(known)


def test_the_pressure_off_the_pitch_point_is_that_of_nearly_the_same_arcs() -> None:
    """With these arcs a second pair of teeth leaves contact exactly a tenth of a pitch from the pitch point."""
    exact, near = (compare_forms(PAIR, arcs=(0.3, last)).forms for last in (0.9, 0.9 - 1e-7))
    for form, other in zip(exact, near, strict=True):
        assert form.ratios is None or form.ratios.shared["off_pitch"] == pytest.approx(
            other.ratios.shared["off_pitch"], rel=1e-5
        )


REFUSED = [
    ({"names": ["rubber"]}, "'rubber' is not a tooth form", ""),
    ({"names": []}, "no tooth form is given", ""),
    ({"arcs": (-1.0, 2.0)}, "arcs of -1,2 are not valid", "arcs"),
    ({"arcs": (float("nan"), 1.0)}, "arcs of nan,1 are not valid", "arcs"),
    ({"arcs": (0.2, 0.2)}, "the contact ratio 0.4 is below 1", "arcs"),
    ({"pressure_angle": Quantity.parse("50 deg", "angle", False)}, "50 deg is out of range", "pressure_angle"),
]


@pytest.mark.parametrize(("requested", "what", "place"), REFUSED, ids=lambda value: str(value)[:40])
def test_what_cannot_be_compared_is_refused(requested: dict[str, object], what: str, place: str) -> None:
    with pytest.raises(GearTrainError) as refused:
        compare_forms(PAIR, **requested)  # type: ignore[arg-type]
    problem = refused.value.problems[0]
    assert what in problem.what
    assert problem.place == place


def test_a_form_that_gives_no_such_pair_says_why_in_place_of_numbers() -> None:
    found = compare_forms(WheelPair(24, 36, shaft_angle=pi / 2), ["involute", "lantern"])
    involute, lantern = found.forms
    assert involute.runs
    assert not lantern.runs
    assert lantern.ratios is None
    assert [fault.kind for fault in lantern.faults] == ["refused"]
    assert lantern.faults[0].fix


def test_a_parameter_that_is_none_is_placed_at_its_name() -> None:
    with pytest.raises(GearTrainError) as refused:
        Involute.declared({"pressure_angle": "95 deg"})
    assert [problem.place for problem in refused.value.problems] == ["pressure_angle"]
    with pytest.raises(GearTrainError) as refused:
        Involute.declared({"shift": "much"})
    assert [problem.place for problem in refused.value.problems] == ["shift"]
    undercut = 12 * tan(radians(10)) / pi
    found = compare_forms(PAIR, ["involute"], (0.7, 0.7), Quantity.parse("10 deg", "angle", False))
    assert f"before {undercut:.6g}" in found.forms[0].faults[0].fix
