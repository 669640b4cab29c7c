"""Eccentricity and pitch deviations of a wheel, estimated from measured angles of its teeth.

Let y_j be the angle of tooth j minus j pitches, positive towards later teeth, and gamma_j = 2 pi j / z. Teeth that are
evenly divided about a centre, which is at the distance e from the axis in the direction psi, satisfy the first of these
equations:

    y = c + atan2(E sin(psi - gamma), 1 + E cos(psi - gamma)),      y = c + A cos gamma + B sin gamma + delta,

where E = e / R, and R is the radius of the measured points. The second equation is its first-order approximation with
deviations delta: E = hypot(A, B) and psi = atan2(A, -B). A and B are estimated by least squares. The deviations delta
are independent, or result from division by stepping (`closed_steps`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, degrees, hypot, inf, isnan, nan, pi, sqrt
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.confidence_intervals import CONFIDENCE, IntervalEstimate, in_degrees
from geartrain.numerics.results import Key, Result, finite
from geartrain.train.manufacturing import FEWEST_ANGLES

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.train.manufacturing import MeasuredTeeth

DeviationLaw = Literal["independent", "stepped"]
LEVEL = 1 - CONFIDENCE
"""Significance level of the tests for an eccentricity and for division by stepping."""
_ROUNDING = 1e-15  # rad: minimum standard deviation, that of the angles of a perfect wheel in float64


def closed_steps(steps: Any) -> Floats:
    """Return the deviations of teeth that were marked out one after another with dividers, with mean 0.

    The sum of all steps is a full turn, so the mean step error is subtracted (Brownian bridge). The covariance is
    equation (5) of docs/cut-by-hand.md.

    steps   error of each step, shape (..., z), as the result
    """
    walk = np.cumsum(steps - np.mean(steps, axis=-1, keepdims=True), axis=-1)
    closed: Floats = walk - walk.mean(axis=-1, keepdims=True)
    return closed


def stepped_covariance(teeth: Ints, z: int) -> Floats:
    """Return the covariance matrix of `closed_steps` for the given teeth among z teeth, if steps have variance 1."""
    apart = np.abs(teeth[:, None] - teeth)
    found: Floats = (z * z - 1) / (12 * z) - apart * (z - apart) / (2 * z)
    return found


def _degrees(angle: float) -> float | None:
    return finite(degrees(angle))


@dataclass(frozen=True)
class WheelEstimate(Result):
    """Eccentricity and pitch deviations of a wheel, estimated from measured angles of its teeth.

    The eccentricity is a fraction of the radius at which the angles were measured. Intervals are at the 95 % level, and
    assume normal distributions.

    See Also
    --------
    estimate_wheel : Compute the estimates.
    """

    KEYS = (
        *("teeth", "measured", "law", "eccentricity", "eccentricity_error", "eccentric", "F", "p", "detectable"),
        Key("direction", to=in_degrees),
        Key("direction_error", to=_degrees),
        Key("deviation", to=in_degrees),
        *(Key(name, to=degrees) for name in ("deviation_error", "cutting_deviation")),
        *(Key("q", to=finite), Key("q_limit", to=finite), "stepped", Key("residuals", to=degrees)),
    )

    teeth: int
    """Number of teeth of the wheel."""
    numbers: Ints
    """Indices of the measured teeth, from 0."""
    law: DeviationLaw
    """Assumed model of the tooth deviations: independent deviations, or deviations that add up because each division
    was stepped off from the previous one with dividers.
    """
    coefficients: Floats
    """Mean angle c and coefficients A and B of the first harmonic [rad]."""
    covariance: Floats
    """Covariance matrix of A and B [rad^2]."""
    eccentricity: IntervalEstimate
    """Eccentricity [1] with its interval: the square root of the unbiased estimate of its square, at least 0."""
    eccentricity_error: float
    """Standard error of the eccentricity [1]."""
    direction: IntervalEstimate
    """Direction of the eccentricity, measured from the first tooth towards later teeth [rad], with its interval."""
    direction_error: float
    """Standard error of the direction [rad]."""
    deviation: IntervalEstimate
    """Standard deviation of the pitch deviations, or of the steps of the dividers [rad], with its chi-square interval.
    """
    deviation_error: float
    """Standard error of the estimated standard deviation `deviation` [rad]."""
    cutting_deviation: float
    """Standard deviation as in `deviation`, with the variance of the measurement error subtracted [rad]."""
    residuals: Floats
    """Deviation of each measured tooth from the fit [rad], positive for a tooth behind its fitted position."""
    F: float
    """Statistic of the test for an eccentricity, with 2 and n - 3 degrees of freedom for n measured teeth [1]."""
    p: float
    """Probability that a wheel without eccentricity has this value of F or a higher one [1]."""
    detectable: float
    """Eccentricity that would be found significant with a probability of 95 % [1]."""
    q: float
    """Von Neumann ratio of the residuals [1]: about 2 for independent deviations; smaller if each division was stepped
    off from the previous one with dividers, so that the deviations add up.
    """
    q_limit: float
    """5 % quantile of q for wheels with independent deviations [1]."""

    def _summary(self) -> str:
        found = f"eccentricity {self.eccentricity.value:.3g} of the radius" if self.eccentric else "not eccentric"
        return f"{self.measured} of {self.teeth} teeth, {found}, sd {degrees(self.deviation.value):.3g} deg"

    @property
    def measured(self) -> int:
        """Number of measured teeth."""
        return len(self.numbers)

    @property
    def off(self) -> Floats:
        """Angle of each measured tooth minus the angle that it would have on an evenly divided wheel with the same mean
        angle [rad].
        """
        gamma = 2 * pi * self.numbers / self.teeth
        found: Floats = self.residuals + self.coefficients[1:] @ [np.cos(gamma), np.sin(gamma)]
        return found

    @property
    def fitted(self) -> tuple[float, float]:
        """Fitted eccentricity as a fraction of the radius, and its direction [rad].

        On average, pitch deviations increase the fitted value. The estimate `eccentricity` is corrected for this bias.
        """
        _, A, B = self.coefficients.tolist()
        return hypot(A, B), atan2(A, -B)

    @property
    def eccentric(self) -> bool:
        """True if the eccentricity is significant at the 5 % level."""
        return self.p < LEVEL

    @property
    def stepped(self) -> bool:
        """True if von Neumann's ratio `q` is below its 5 % quantile: the wheel was probably divided by stepping."""
        return self.q < self.q_limit


def estimate_wheel(
    angles: Sequence[float | None], teeth: int | None = None, error: float = 0.0, law: DeviationLaw | None = None
) -> WheelEstimate:
    """Estimate eccentricity and pitch deviations of a wheel from the measured angles of its teeth.

    Parameters
    ----------
    angles : sequence of float or None
        Direction of each tooth seen from the axis [rad], increasing from tooth to tooth; None or NaN for a missing
        tooth.
    teeth : int, optional
        Number of teeth if teeth are missing after the last angle; by default the number of angles.
    error : float
        Standard deviation of the measurement error of an angle [rad].
    law : {"independent", "stepped"}, optional
        Assumed deviations of the teeth; by default chosen by von Neumann's ratio.

    Returns
    -------
    WheelEstimate
        Estimates with standard errors and intervals.

    Raises
    ------
    RangeError
        If fewer than four teeth were measured.

    References
    ----------
    von Neumann, J. 1941. Distribution of the ratio of the mean square successive difference to the variance. Ann. Math.
    Stat. 12, 367-395.

    Examples
    --------
    >>> from math import radians
    >>> estimate_wheel([radians(each) for each in (0.3, 71.9, 143.7, 216.1)], teeth=5)
    <WheelEstimate 4 of 5 teeth, not eccentric, sd 0.046 deg>
    """
    z = len(angles) if teeth is None else teeth
    given = {at: float(each) for at, each in enumerate(angles) if each is not None and not isnan(each)}
    if len(given) < FEWEST_ANGLES:
        why = f"an eccentricity and a standard deviation are estimated from at least {FEWEST_ANGLES} teeth"
        raise RangeError(Problem(f"only {len(given)} angles were measured", why, "measure more teeth"))
    numbers = np.array(list(given))
    off = np.array(list(given.values())) - 2 * pi * numbers / z
    # about the circular mean, so that a zero between two teeth does not split the angles
    mean = float(np.angle(np.exp(1j * off).sum()))
    return _estimate(numbers, mean + np.remainder(off - mean + pi, 2 * pi) - pi, z, error, law)


def estimate_measured(measured: MeasuredTeeth, count: int) -> WheelEstimate:
    """Return the estimates from the measured angles that are declared for a wheel with `count` teeth."""
    angles = [None if each is None else each.si for each in measured.angles or ()]
    return estimate_wheel(angles, count, 0.0 if measured.error is None else measured.error.si)


def _estimate(numbers: Ints, off: Floats, z: int, error: float, law: DeviationLaw | None) -> WheelEstimate:
    """Return the estimates for a wheel with z teeth.

    numbers   indices of the measured teeth
    off       deviations of the measured teeth from an even division (rad)
    error     standard deviation of the measurement error of an angle (rad)
    law       assumed deviations of the teeth; None to choose by von Neumann's ratio
    """
    from scipy.special import chdtri, fdtrc, fdtri, ncfdtrinc, stdtrit

    gamma, n, freedom = 2 * pi * numbers / z, len(numbers), len(numbers) - 3
    design = np.stack([np.ones(n), np.cos(gamma), np.sin(gamma)], axis=1)
    inverse = np.linalg.pinv(design)
    coefficients = inverse @ off
    residuals = off - design @ coefficients
    squares = max(float(residuals @ residuals), n * _ROUNDING**2)
    # differences between neighbouring teeth; the first and the last tooth are not compared
    step = np.diff(np.eye(n), axis=0)[np.diff(numbers) == 1] @ (np.eye(n) - design @ inverse)
    steps = max(float(np.sum((step @ off) ** 2)), n * _ROUNDING**2)
    q, q_limit = _successive_ratio(step, steps / squares, n)
    law = law or ("stepped" if q < q_limit else "independent")
    unit, variance, ends = np.eye(n), squares / freedom, 1
    if law == "stepped" and len(step):
        unit = stepped_covariance(numbers, z)
        variance, ends = steps / float(np.trace(step @ unit @ step.T)), 2
    covariance = variance * (inverse @ unit @ inverse.T)[1:, 1:]
    ab = coefficients[1:]
    size, F = float(np.hypot(*ab)), float(ab @ np.linalg.solve(covariance, ab)) / 2
    tails = LEVEL / 2, 1 - LEVEL / 2
    p, student = float(fdtrc(2, freedom, F)), float(stdtrit(freedom, tails[1]))
    noncentrality = float(ncfdtrinc(2, freedom, LEVEL, float(fdtri(2, freedom, 1 - LEVEL))))
    detectable = sqrt(noncentrality * np.linalg.eigvalsh(covariance)[-1])
    along = ab / size if size else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])
    error_along, error_across = (sqrt(each @ covariance @ each) for each in (along, across))
    eccentricity, direction = sqrt(max(0.0, size**2 - np.trace(covariance))), atan2(ab[0], -ab[1])
    turn, deviation = error_across / size if size else inf, sqrt(variance)
    half = student * error_along
    low, high = (max(0.0, eccentricity - half), eccentricity + half) if p < LEVEL else (0.0, detectable)
    return WheelEstimate(
        z,
        numbers,
        law,
        coefficients,
        covariance,
        IntervalEstimate(eccentricity, low, high),
        error_along,
        IntervalEstimate(direction, direction - student * turn, direction + student * turn),
        turn,
        IntervalEstimate(deviation, *(deviation * sqrt(freedom / chdtri(freedom, each)) for each in tails)),
        deviation / sqrt(2 * freedom),
        # a step has the measurement errors of both its ends
        sqrt(max(0.0, variance - ends * error**2)),
        residuals,
        F,
        p,
        detectable,
        q,
        q_limit,
    )


def _successive_ratio(step: Floats, ratio: float, n: int) -> tuple[float, float]:
    """Return von Neumann's ratio, as if all n - 1 differences were known, and its 5 % quantile without stepping.

    The ratio is nearly normal, with the moments of a quotient of quadratic forms of normal variables.

    step    matrix that converts deviations to differences between the residuals of neighbouring teeth
    ratio   sum of squares of these differences, divided by the sum of squares of the residuals
    n       number of measured teeth
    """
    if not len(step) or n == FEWEST_ANGLES:  # with one degree of freedom the ratio is constant
        return nan, -inf
    from scipy.special import ndtri

    scale, freedom = (n - 1) / len(step), n - 3
    trace, square = float(np.sum(step**2)), float(np.sum((step @ step.T) ** 2))
    variance = 2 * max(0.0, freedom * square - trace**2) / (freedom**2 * (freedom + 2))
    return scale * ratio, scale * (trace / freedom + float(ndtri(LEVEL)) * sqrt(variance))
