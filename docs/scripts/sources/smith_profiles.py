"""W. D. Smith's variables, read off finished profiles: r(theta) about a gear's own centre, psi_i, s, phi, c_i.

Made from points of the profiles alone, which are turned to where they touch, and differentiated as they lie. Angles
grow with the tooth's height, so that r' > 0; psi_i > 0; s carries the sign that equation (23) gives with its lower
root: positive on gear 1's addendum. Equations are written out in letters of their own, over floats, arrays or mpmath.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev as cheb

from geartrain.teeth.conjugate.path_of_contact import PathOfContact

NODES = 20


@dataclass(frozen=True)
class Seen:
    """One side of a pair of profiles at the displacements X, in the source's variables; gear numbers 1 and 2."""

    bevel: bool
    R1: float
    R2: float
    X: Any
    P: Any  # fixed frame, from the points of gear 1
    apart: float  # how far the points of gear 2 lie from these
    r: tuple[Any, Any]
    turned: tuple[Any, Any]  # angle at the centre from the line of centres, towards the motion
    body: tuple[Any, Any]  # the same of the body's points
    slope: tuple[Any, Any]  # r'
    bend: tuple[Any, Any]  # r''

    @property
    def s(self) -> Any:
        size = np.hypot(self.P[0], self.P[1])
        return np.sign(self.P[0]) * (np.arctan2(size, self.P[2]) if self.bevel else size)

    @property
    def cos_phi(self) -> Any:
        return np.abs(self.P[1]) / np.hypot(self.P[0], self.P[1])

    @property
    def sin_phi(self) -> Any:
        return np.abs(self.P[0]) / np.hypot(self.P[0], self.P[1])

    def height(self, gear: int) -> Any:
        """r, or sin r."""
        return np.sin(self.r[gear - 1]) if self.bevel else self.r[gear - 1]

    def reach(self, gear: int) -> float:
        """R, or sin R."""
        R = (self.R1, self.R2)[gear - 1]
        return sin(R) if self.bevel else R

    def psi(self, gear: int) -> Any:
        """Angle between radius and profile, equations (2) and (3)."""
        return np.arctan2(self.height(gear), self.slope[gear - 1])

    def along(self, gear: int) -> Any:
        """ds/dtheta, equations (25) and (26)."""
        return np.hypot(self.height(gear), self.slope[gear - 1])

    def curvature(self, gear: int) -> Any:
        """1/c or cot c, equations (27) and (29)."""
        r, p, q = self.r[gear - 1], self.slope[gear - 1], self.bend[gear - 1]
        if not self.bevel:
            return (r**2 - r * q + 2 * p**2) / (r**2 + p**2) ** 1.5
        over = np.cos(r) * np.sin(r) ** 2 - q * np.sin(r) + 2 * p**2 * np.cos(r)
        return over / (np.sin(r) ** 2 + p**2) ** 1.5

    def c(self, gear: int) -> Any:
        """Radius of curvature, in (0, pi) on the sphere."""
        kappa = self.curvature(gear)
        return np.arctan2(1, kappa) if self.bevel else 1 / kappa

    def crawl(self, gear: int) -> Any:
        """Speed of the contact along a profile over V: ds/dX, from the points alone."""
        return self.along(gear) * np.abs(self._rate(gear))

    def _rate(self, gear: int) -> Any:
        matrix = differentiation(self.X)
        return matrix @ self.body[gear - 1]


def seen(path: PathOfContact, recess: bool = True, first: float = 0.15, last: float = 0.95, nodes: int = NODES) -> Seen:
    """A side of a path between the fractions `first` and `last` of its arc."""
    pitch = path.pitch
    arc = path.arcs[1] if recess else -path.arcs[0]
    X = arc * (first + (last - first) * (chebyshev(nodes) + 1) / 2)
    points = path.flank(1, X), path.flank(2, X)
    frames = [_polar(points[k], (pitch.R1, pitch.R2)[k], k == 1, pitch.bevel) for k in (0, 1)]
    angles = [X / pitch.reach, X / pitch.reach2]
    placed = [
        _place(r, azimuth + angle, R, k == 1, pitch.bevel)
        for k, ((r, azimuth), angle, R) in enumerate(zip(frames, angles, (pitch.R1, pitch.R2), strict=True))
    ]
    D = differentiation(X)
    slopes, bends = [], []
    for r, azimuth in frames:
        rate = D @ azimuth
        slope = (D @ r) / rate
        slopes.append(np.abs(slope))
        bends.append((D @ slope) / rate)
    return Seen(
        pitch.bevel,
        pitch.R1,
        pitch.R2,
        X,
        placed[0],
        float(np.abs(np.array(placed[0]) - np.array(placed[1])).max()),
        (frames[0][0], frames[1][0]),
        (frames[0][1] + angles[0], frames[1][1] + angles[1]),
        (frames[0][1], frames[1][1]),
        (slopes[0], slopes[1]),
        (bends[0], bends[1]),
    )


def _polar(points: Any, R: float, above: bool, bevel: bool) -> tuple[Any, Any]:
    """Distance from the own centre, and angle there from the line of centres towards +x."""
    x, y = points[:, 0], points[:, 1] * (-1 if above else 1)
    if not bevel:
        return np.hypot(x, y + R), np.arctan2(x, y + R)
    # coordinates with the axis as pole: the pitch point lies at (0, sin R, cos R)
    high = y * cos(R) + points[:, 2] * sin(R)
    pole = -y * sin(R) + points[:, 2] * cos(R)
    return np.arctan2(np.hypot(x, high), pole), np.arctan2(x, high)


def _place(r: Any, angle: Any, R: float, above: bool, bevel: bool) -> tuple[Any, ...]:
    """The inverse: Cartesian coordinates from the pitch point."""
    sign = -1 if above else 1
    if not bevel:
        return r * np.sin(angle), sign * (r * np.cos(angle) - R)
    high, pole = np.sin(r) * np.cos(angle), np.cos(r)
    return np.sin(r) * np.sin(angle), sign * (high * cos(R) - pole * sin(R)), high * sin(R) + pole * cos(R)


def chebyshev(nodes: int) -> Any:
    """Extreme points of a Chebyshev polynomial, ascending."""
    return -np.cos(np.arange(nodes) * pi / (nodes - 1))


def differentiation(X: Any) -> Any:
    """Matrix of d/dX at nodes that are Chebyshev points of their range, through the coefficients."""
    nodes = len(X)
    x = chebyshev(nodes)
    V = cheb.chebvander(x, nodes - 1)
    slopes = np.stack([cheb.chebval(x, cheb.chebder(row)) for row in np.eye(nodes)], axis=1)
    return slopes @ np.linalg.inv(V) * 2 / (X[-1] - X[0])


# ---------------------------------------------------------- the long equations, for a jet r, p = r', q = r'' of gear 1


def root_Q(R: Any, r: Any, p: Any, sqrt: Callable[[Any], Any]) -> Any:
    """Equation (57)."""
    return sqrt(R**2 * r**2 + R**2 * p**2 - r**2 * p**2)


def big_M(Q: Any, r: Any, p: Any, q: Any) -> Any:
    """The bracket squared in equation (56)."""
    return p**4 + r**2 * Q + r**3 * q - r * q * Q + 2 * p**2 * Q


def printed_56(R: Any, H: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any]) -> Any:
    """Equation (56), term by term."""
    Q = root_Q(R, r, p, sqrt)
    below = (
        R**3 * r**4 + 2 * R**3 * p**4 - 2 * r**3 * p**3 * H - r**5 * p * H - r * p**5 * H + 2 * r**3 * q * Q * R
        - r**5 * q * R - R**3 * r**3 * q + 3 * R**3 * p**2 * r**2 - p**2 * r**4 * R - 2 * p**2 * r**2 * Q * R
        + r**3 * q * p**2 * R + p**4 * Q * R - 3 * p**4 * r**2 * R - R**3 * r * q * p**2 - r**4 * Q * R
    )  # fmt: skip
    return big_M(Q, r, p, q) ** 2 * R / ((p**2 + r**2) * p * r) / below


def corrected_56(R: Any, H: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any]) -> Any:
    """The same with H Q N^4 in the place of -H r r' N^4."""
    Q = root_Q(R, r, p, sqrt)
    N2, M = r**2 + p**2, big_M(root_Q(R, r, p, sqrt), r, p, q)
    return M**2 * R / (N2 * r * p * (H * Q * N2**2 - R * (r**2 - Q) * M))


def printed_63(R1: Any, R2: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any]) -> Any:
    """Equation (63), term by term; what it is proportional to."""
    Q = root_Q(R1, r, p, sqrt)
    over = (2 * r**4 + 4 * r**2 * p**2 + p**4 - r**3 * q - r**2 * Q + Q * r * q - 2 * Q * p**2) ** 2
    below = (
        2 * r**4 * Q + R1**2 * r**3 * q - 2 * r**6 - 3 * r**4 * p**2 - r**3 * Q * q + 4 * r**2 * Q * p**2
        - 3 * R1**2 * r**2 * p**2 - r**3 * q * p**2 - R1**2 * r**4 - 2 * R1**2 * p**4 + R1**2 * r * q * p**2 + Q * p**4
    )  # fmt: skip
    return (R2 + R1) * (r**2 - Q) / ((r**2 + p**2) * R2 * p * r) * over / below


def corrected_63(R1: Any, R2: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any]) -> Any:
    """The same from equation (45) with c - s."""
    Q = root_Q(R1, r, p, sqrt)
    return (R1 + R2) / R2 * (r**2 - Q) * big_M(Q, r, p, q) / (r * p * (r**2 + p**2) * Q)


def stress_55(R1: Any, R2: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any], wrong: bool = False) -> Any:
    """Equation (55) put together from (27), (23) with the lower sign, (32) and (33); `wrong`: (33) as printed."""
    N = sqrt(r**2 + p**2)
    c1 = N**3 / (r**2 - r * q + 2 * p**2)
    cosine, sine = p / N, r / N
    s = r * sine - sqrt(R1**2 - (r * cosine) ** 2)
    cos_phi = -r / R1 * cosine if wrong else sqrt(1 - (r / R1 * cosine) ** 2)
    c2 = 1 / ((1 / R1 + 1 / R2) / cos_phi - 1 / (c1 - s)) - s
    return sqrt(1 / r**2 + 1 / p**2) * (1 / c1 + 1 / c2)


def loss_63(R1: Any, R2: Any, r: Any, p: Any, q: Any, sqrt: Callable[[Any], Any], opposite: bool = False) -> Any:
    """F V_s / V_c ds/dtheta from (47), (20), (45) and (25); `opposite`: c + s in (45), as printed."""
    N = sqrt(r**2 + p**2)
    c, sine = N**3 / (r**2 - r * q + 2 * p**2), r / N
    s = r * sine - sqrt(R1**2 - (r * p / N) ** 2)
    own = s if opposite else -s
    crawl = (R1**2 - r**2 + s**2 + 2 * c * own + 2 * r * c * sine) * c / (2 * R1 * (c + own) ** 2)
    return sqrt(1 / r**2 + 1 / p**2) * (1 / R1 + 1 / R2) * R1 * s / crawl * N / R1


def crawl(v: Seen, at: Any) -> Any:
    """(42) with (43), or (44) with the law of cosines, which is (45); `at` in the place of c + s."""
    r, R, c, psi = v.r[0], v.R1, v.c(1), v.psi(1)
    if v.bevel:
        cos_A = np.cos(r) * np.cos(c) + np.sin(r) * np.sin(c) * np.sin(psi)
        return (cos_A - np.cos(R) * np.cos(at)) * np.sin(c) / (np.sin(R) * np.sin(at) ** 2)
    A2 = r**2 + c**2 - 2 * r * c * np.sin(psi)
    return (R**2 + at**2 - A2) * c / (2 * R * at**2)
