"""The study of tooth shapes: truth, orders and failures stand. Times are never judged."""

from __future__ import annotations

from math import log10, pi

import mpmath as mp
import numpy as np
import pytest
from studies.shape_cases import CASES, EXTREMES, TRUTH, ShapeCase
from studies.shape_methods import collocated, marched, packaged, searched
from studies.shape_study import WorkRecord, quickest

from geartrain.errors import RangeError
from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package

SMOOTH = [case for case in CASES if case.kind != "friction"]


def named(case: ShapeCase) -> str:
    return case.name


@pytest.mark.parametrize("case", SMOOTH[:1], ids=named)
def test_the_truth_solves_its_equation_as_mpmath_marches_it(case: ShapeCase) -> None:
    """From four fifths of the arc, where the package's series is good to 1e-15, to the end in 20 digits."""
    pitch, A, B = case.pitch, case.pitch.A, case.pitch.B
    make = {
        "stress": lambda: forms.uniform_stress(pitch, A, B, case.X, case.amount),
        "heat": lambda: forms.uniform_heat(pitch, B, case.gamma, case.X),
    }[case.kind]
    side = make()
    first = float(side.distance(np.array(case.X * 0.8)))
    with mp.workdps(20):
        k = mp.sin(case.amount) * mp.cos(case.amount)
        S, slope = (mp.sin, mp.cos) if pitch.bevel else (lambda d: d, lambda d: mp.mpf(1))

        def w(d: mp.mpf, psi: mp.mpf) -> mp.mpf:
            if case.kind == "heat":
                return B * S(d) + case.gamma * S(d) / mp.cos(psi)
            return ((B - A) * S(d) + mp.sqrt((A + B) ** 2 * S(d) ** 2 + 4 * k * mp.tan(psi))) / 2

        begin = [mp.mpf(first), mp.asin(mp.mpf(float(side.sin_psi(np.array(first)))))]
        path = mp.odefun(
            lambda X, u: [mp.cos(u[1]), (w(*u) - slope(u[0]) * mp.sin(u[1])) / S(u[0])],
            float(side.travel(np.array(first))), begin, tol=mp.mpf(10) ** -17,
        )  # fmt: skip
        end = path(case.X)
    assert float(end[0] / mp.mpf(TRUTH[case.name][0]) - 1) == pytest.approx(0, abs=2e-15)
    assert float(end[1] - mp.mpf(TRUTH[case.name][1])) == pytest.approx(0, abs=4e-15)


@pytest.mark.parametrize("case", [*CASES, *EXTREMES], ids=named)
def test_the_package_is_right_to_rounding_on_every_pair(case: ShapeCase) -> None:
    assert packaged(case) == pytest.approx(case.end, rel=1e-14)


@pytest.mark.parametrize("case", SMOOTH, ids=named)
def test_collocation_gains_a_digit_or_more_with_each_node(case: ShapeCase) -> None:
    errors = [abs(collocated(case, nodes) / case.end - 1) for nodes in (4, 6, 8)]
    assert 0.8 < log10(errors[0] / errors[2]) / 4 < 2.5
    assert abs(collocated(case, 24) / case.end - 1) < 1e-15


@pytest.mark.parametrize("case", SMOOTH, ids=named)
def test_the_error_of_a_start_falls_with_a_power_of_its_distance(case: ShapeCase) -> None:
    errors = [abs(marched(case, "DOP853", 1e-13, start) / case.end - 1) for start in (0.2, 0.1, 0.05)]
    assert 2 < np.log2(errors[0] / errors[1]) < 6
    assert 2 < np.log2(errors[1] / errors[2]) < 6


def test_a_direct_search_comes_near_the_closed_form_and_no_nearer() -> None:
    case = next(case for case in CASES if case.name == "friction spur")
    assert 1e-5 < abs(searched(case, 16) / case.end - 1) < 2e-2


# what collocation says when there is no solution ---------------------------------------------------------------------


def test_a_path_that_comes_to_a_right_angle_before_its_end_is_refused() -> None:
    """Marched apart, it comes to 90 degrees at an arc of 0.93 modules, short of half a pitch."""
    with pytest.raises(RangeError, match="does not reach"):
        forms.uniform_heat(PitchSurfaces.spur(5, 5), 0.4, 1.6, pi / 2)


def test_a_way_that_fails_has_no_error_and_is_never_the_quickest() -> None:
    rows = [WorkRecord("p", "m", 1, None, 1e-9), WorkRecord("p", "m", 2, 1e-7, 2.0), WorkRecord("p", "m", 3, 1e-9, 1.0)]
    assert quickest(rows, 1e-6) == rows[2]
    assert quickest(rows, 1e-12) is None
