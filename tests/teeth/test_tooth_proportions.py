"""Teeth that share the pitch unequally, and racks by name."""

from __future__ import annotations

import json
from math import pi

import numpy as np
import pytest
from commands import call
from models import pair

from geartrain import GearTrainError
from geartrain.teeth import Cycloidal, Involute
from geartrain.teeth.conjugate import WheelPair, pair_outlines
from geartrain.teeth.contact import solve


@pytest.mark.parametrize("wheels", [(60, 8), (8, 60)])
def test_clock_teeth_leave_the_backlash_of_the_standard(wheels: tuple[int, int]) -> None:
    """BS 978: wheels pi/2 and leaves 1.05 modules thick leave 0.52; so do the outlines drawn and turned."""
    sizes = [pi / 2 if z == 60 else 1.05 for z in wheels]
    form = Cycloidal(form="cycloidal", thickness=[f"{each!r}" for each in sizes])
    transmission = form.transmission(*wheels)
    assert transmission.verdict.backlash * wheels[1] / 2 == pytest.approx(pi / 2 - 1.05)
    outlines = pair_outlines(form.pair(WheelPair(*wheels)))
    found = solve(*outlines, sum(wheels) / 2, np.linspace(0, 2 * pi / wheels[0], 7))
    assert found.backlash * wheels[1] / 2 == pytest.approx(pi / 2 - 1.05, abs=1e-6)


def test_equal_thickness_is_half_the_backlash_each() -> None:
    thin = Cycloidal(form="cycloidal", thickness=repr(pi / 2 - 0.05)).pair(WheelPair(12, 40))
    loose = Cycloidal(form="cycloidal", backlash="0.1").pair(WheelPair(12, 40))
    assert thin.halves == pytest.approx(loose.halves)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"thickness": "1.2", "backlash": "0.1"}, "both given"),
        ({"thickness": ["1.2", "0"]}, "thickness must be greater than 0, not 0"),
        ({"thickness": ["1.7", "1.5"]}, "exceed the pitch"),
    ],
)
def test_thickness_that_is_none_is_refused(given: dict[str, object], words: str) -> None:
    with pytest.raises(GearTrainError, match=words):
        pair("inputs: {a: 1}\ntooth_form: " + json.dumps({"form": "cycloidal", **given}))


@pytest.mark.parametrize(("name", "heights"), [("full", ("1", "1.25")), ("deep", ("1", "1.4")), ("stub", ("0.8", "1"))])
def test_racks_by_name_are_those_of_their_heights(name: str, heights: tuple[str, str]) -> None:
    named = Involute.model_validate({"form": "involute", "proportions": name})
    plain = Involute(form="involute", addendum=heights[0], dedendum=heights[1])
    assert (named.addendum, named.dedendum) == (plain.addendum, plain.dedendum)
    assert Involute.model_validate(named.model_dump(mode="json", exclude_unset=True)) == named


def test_racks_are_requested_for_once() -> None:
    result = call("mesh", "20", "40", "--form", "involute", "-p", "proportions=stub", "-p", "addendum=1")
    assert isinstance(result.exception, GearTrainError)
    assert "addendum and proportions are both given" in str(result.exception)
    assert "1.34653" in call("mesh", "20", "40", "--form", "involute", "-p", "proportions=stub").stdout
