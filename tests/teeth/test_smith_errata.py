"""The long equations (56), (63) and (64) of W. D. Smith, Optimal shapes for gears (1993), in 40 digits.

The other equations are computed row by row in docs/scripts/sources/smith_rows.py (tests/docs/test_sources.py).
"""

from __future__ import annotations

from typing import Any

import mpmath as mp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sources.smith_profiles import big_M, corrected_56, corrected_63, loss_63, printed_56, printed_63, root_Q, stress_55

jets = st.tuples(st.floats(9, 13.5), st.floats(14, 60), st.floats(-200, 200))


@given(jets, st.floats(15, 80))
@settings(max_examples=40, deadline=None)
def test_56_is_what_the_cosine_of_33_makes_of_55_and_its_correction_what_the_sine_makes(jet: Any, R2: float) -> None:
    with mp.workdps(40):
        R1, wide, at = mp.mpf(12), mp.mpf(R2), tuple(map(mp.mpf, jet))
        H = 1 / (1 / R1 + 1 / wide)
        if abs(big_M(root_Q(R1, *at[:2], mp.sqrt), *at)) < 1:
            return
        true, wrong = (stress_55(R1, wide, *at, mp.sqrt, wrong=wrong) for wrong in (False, True))
        assert abs(corrected_56(R1, H, *at, mp.sqrt) / true - 1) < 1e-28
        assert abs(printed_56(R1, H, *at, mp.sqrt) / wrong - 1) < 1e-28
        assert abs(wrong / true - 1) > 1e-3


@given(jets, st.floats(15, 80))
@settings(max_examples=40, deadline=None)
def test_63_is_what_the_sum_in_45_makes_with_its_sign_turned_and_the_difference_is_linear(jet: Any, R2: float) -> None:
    with mp.workdps(40):
        R1, wide, at = mp.mpf(12), mp.mpf(R2), tuple(map(mp.mpf, jet))
        true, wrong = (loss_63(R1, wide, *at, mp.sqrt, opposite=opposite) for opposite in (False, True))
        assert abs(corrected_63(R1, wide, *at, mp.sqrt) - true) < 1e-28 * abs(true) + 1e-35
        assert abs(printed_63(R1, wide, *at, mp.sqrt) + wrong) < 1e-28 * abs(wrong) + 1e-35
        steps = [corrected_63(R1, wide, at[0], at[1], at[2] + k, mp.sqrt) for k in range(4)]
        assert abs(steps[0] - 2 * steps[1] + steps[2]) < 1e-30 * abs(steps[1]) + 1e-35
        bent = [printed_63(R1, wide, at[0], at[1], at[2] + k, mp.sqrt) for k in range(4)]
        assume(bent[1])  # where nothing is lost there is nothing to bend
        assert abs(bent[0] - 2 * bent[1] + bent[2]) > 1e-12 * abs(bent[1])


def lagrange(Z: Any, polynomial: list[Any]) -> Any:
    """The left side of (64) at theta = 0 on the curve r = sum of a_n theta^n."""

    def along(part: tuple[int, int, int]) -> Any:
        def value(theta: Any) -> Any:
            jets = [
                sum(mp.ff(n, order) * a * theta ** (n - order) for n, a in enumerate(polynomial) if n >= order)
                for order in range(3)
            ]
            return mp.diff(Z, tuple(jets), part)

        return value

    return along((1, 0, 0))(0) - mp.diff(along((0, 1, 0)), 0) + mp.diff(along((0, 0, 1)), 0, 2)


def test_64_is_of_the_second_order_with_the_right_z_and_of_the_fourth_with_the_printed_one() -> None:
    with mp.workdps(60):
        R1, R2 = mp.mpf(12), mp.mpf(18)
        right = lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt)  # noqa: E731
        printed = lambda r, p, q: printed_63(R1, R2, r, p, q, mp.sqrt)  # noqa: E731
        start = [mp.mpf("12.5"), mp.mpf(31), mp.mpf(-14)]
        plain, bent = [*start, 0, 0], [*start, mp.mpf(25), mp.mpf(-40)]
        assert abs(lagrange(right, plain) - lagrange(right, bent)) < 1e-18 * abs(lagrange(right, plain))
        assert abs(lagrange(printed, plain) - lagrange(printed, bent)) > 1e-3 * abs(lagrange(printed, plain))


def test_the_first_integral_solves_64_with_the_right_z_and_not_with_the_printed_one() -> None:
    """R1 (r^2 - Q) = D r r', of which the curve d = D cos psi, X = D ln d is the closed form."""
    with mp.workdps(70):
        R1, R2, D = mp.mpf(12), mp.mpf(18), mp.mpf(2)

        def rises(r: Any) -> Any:
            return mp.findroot(lambda p: R1 * (r * r - root_Q(R1, r, p, mp.sqrt)) - D * r * p, mp.mpf(8))

        r0 = mp.mpf("12.4")
        p0 = rises(r0)
        coefficients = mp.taylor(rises, r0, 3)
        p, f1, f2, f3 = (c * mp.factorial(n) for n, c in enumerate(coefficients))
        second = f1 * p
        third = f2 * p**2 + f1 * second
        fourth = f3 * p**3 + 3 * f2 * p * second + f1 * third
        curve = [r0, p, second / 2, third / 6, fourth / 24]
        assert abs(p - p0) < 1e-40
        scale = abs(lagrange(lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt), [r0, p, -second / 2, 0, 0]))
        assert abs(lagrange(lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt), curve)) < 1e-15 * scale
        assert abs(lagrange(lambda r, p, q: printed_63(R1, R2, r, p, q, mp.sqrt), curve)) > 1e-6 * scale
