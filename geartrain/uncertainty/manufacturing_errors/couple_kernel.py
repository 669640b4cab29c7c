"""One couple of cut teeth as kernels: the formulas of `teeth.triangular.tooth_couple`, number by number.

There they serve arrays, here a loop over teeth that is compiled. Equations are numbered as there.
"""

from __future__ import annotations

from math import asin, atan2, copysign, cos, inf, sin, sqrt
from typing import NamedTuple

from geartrain.numerics.kernels import kernel


class CutCouple(NamedTuple):
    """The constants of a couple, as of `CutToothPairs`."""

    R1: float
    R2: float
    D: float
    delta: float
    sin1: float
    cos1: float
    sin2: float
    cos2: float
    entry: float
    reach: float
    exit_angle: float


@kernel
def make_couple(
    R1: float, R2: float, D: float, delta: float, flank1: tuple[float, float], flank2: tuple[float, float]
) -> CutCouple:
    """A couple of two teeth; `flank1` and `flank2` are sine and cosine of the half angles that meet."""
    mirror = copysign(1.0, R1)
    entry, leaving = _half_sine(R1, R2, D, delta), _half_sine(R2, R1, D, delta)
    # tips that pass clear of each other touch nowhere
    reach = 2.0 * asin(entry) if delta > 0 else -inf
    sin1, sin2 = mirror * flank1[0], mirror * flank2[0]
    return CutCouple(R1, R2, D, delta, sin1, flank1[1], sin2, flank2[1], entry, reach, -2.0 * asin(leaving))


@kernel
def _half_sine(R1: float, R2: float, D: float, delta: float) -> float:
    """Sine of half the reach of wheel 1, Eq. (4)."""
    return sqrt(min(max(delta * (2.0 * R2 - delta) / (4.0 * D * R1), 0.0), 1.0))


@kernel
def approach(couple: CutCouple, x: float) -> tuple[float, float, float]:
    """alpha_2 in approach at x, Eq. (7), tau, Eq. (12), and d tau / d alpha_1."""
    u, w = sin(x / 2), cos(x / 2)
    sine, cosine = 2 * u * w, 1 - 2 * u * u
    sin_psi = couple.sin1 * cosine + couple.cos1 * sine
    cos_psi = couple.cos1 * cosine - couple.sin1 * sine
    c = (2 * couple.R1 * u * (couple.cos1 * w - couple.sin1 * u) - couple.delta * sin_psi) / couple.R2
    s = sin_psi + c
    q = sqrt(abs((1 - s) * (1 + s)))
    side = copysign(1.0, couple.D)
    y = side * asin(c * (cos_psi + sin_psi * (sin_psi + s) / (cos_psi + q)))
    W = 4 * couple.D * couple.R1 * (couple.entry - u) * (couple.entry + u)
    arm = couple.R1 * couple.cos1 - W / (couple.D * cos_psi - couple.R1 * couple.cos1 + couple.R2 * q)
    tau = arm / (couple.R2 * q)
    return y, side * tau, side * (1 + tau) * ((1 + tau) * s / q - sin_psi / cos_psi)


@kernel
def recess(couple: CutCouple, x: float) -> tuple[float, float, float]:
    """alpha_2 in recess at x, Eq. (17), tau, Eq. (19), and d tau / d alpha_1."""
    u = sin(x / 2)
    sine, cosine = 2 * u * cos(x / 2), 1 - 2 * u * u
    W = 4 * couple.D * couple.R1 * (couple.entry - u) * (couple.entry + u)
    foot = couple.R2 * couple.cos2
    arm = copysign(sqrt(max(foot * foot - W, 0.0)), couple.R2)
    v = W / (foot + arm)
    across, along = couple.R1 * sine, couple.R2 - couple.delta + 2 * couple.R1 * u * u
    inner, outer = couple.R2 - v * couple.cos2, v * couple.sin2
    square = couple.R2 * couple.R2 - W
    sin_y, cos_y = (across * inner - along * outer) / square, (along * inner + across * outer) / square
    sin_psi = couple.sin2 * cos_y - couple.cos2 * sin_y
    cos_psi = couple.cos2 * cos_y + couple.sin2 * sin_y
    q, s = cos_psi * cosine + sin_psi * sine, sin_psi * cosine - cos_psi * sine
    tau = couple.R1 * q / arm
    side = copysign(1.0, couple.D)
    return (
        side * atan2(sin_y, cos_y),
        side * tau,
        side * tau * (1 + tau) * ((1 + tau) * s / q - tau * sin_psi / cos_psi),
    )


@kernel
def contact(couple: CutCouple, x: float) -> float:
    """f(x) = min(approach, recess): alpha_2 at first contact, where |x| is within the reach."""
    return min(approach(couple, x)[0], recess(couple, x)[0])


@kernel
def held(couple: CutCouple, x: float) -> float:
    """alpha_2 of the driven tooth: in contact, or where the couple has left it."""
    if x < -couple.reach:
        return couple.exit_angle
    return contact(couple, min(x, couple.reach))


@kernel
def is_below(couple: CutCouple, x: float, bound: float) -> bool:
    """Whether alpha_2 as it is `held` is at most so much: one phase often tells."""
    if x < -couple.reach:
        return couple.exit_angle <= bound
    x = min(x, couple.reach)
    return approach(couple, x)[0] <= bound or recess(couple, x)[0] <= bound
