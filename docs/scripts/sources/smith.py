"""W. D. Smith, Optimal shapes for gears, 1993: what his equations and claims come to.

Equations are worked out on finished profiles of the library (`smith_profiles`): points of the two teeth alone, turned
to where they touch and differentiated as they lie. s is signed as there: above 0 on gear 1's addendum.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import asin, cos, log, pi, radians, sin, sqrt, tan
from typing import Any, Literal

import numpy as np

import geartrain
from geartrain.teeth import BuckinghamFriction, DokosFriction
from geartrain.teeth.conjugate import closed_form_sides, optimal_sides
from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
from geartrain.teeth.friction_law import FOOT_A_MINUTE
from sources import smith_profiles as profiles
from sources.row import Finding
from sources.smith_profiles import Seen, crawl
from sources.ways import Command

ONCE, TWICE = 1e-9, 1e-6  # what differentiating points once and twice leaves
Kind = Literal["spur", "bevel"]
Sided = Callable[[Seen], Any]
SPUR, BEVEL = PitchSurfaces.spur(24, 36), PitchSurfaces.cones(24, 36)
BOTH: tuple[Kind, Kind] = ("spur", "bevel")


# ------------------------------------------------------------------------------------------------------------ profiles


@lru_cache(maxsize=16)
def path(kind: Kind, shape: str) -> PathOfContact:
    """A pair of 24 and 36 teeth: its path of contact, half a pitch to either side of the pitch point."""
    pitch = SPUR if kind == "spur" else BEVEL
    X, A, B, tilt = pitch.p / 2, pitch.A, pitch.B, radians(20)
    if shape == "involute":
        one = optimal_sides.involute(X, tilt)
        return PathOfContact(pitch, one, one)
    if shape == "stress":
        late, early = (optimal_sides.uniform_stress(pitch, a, b, X, tilt) for a, b in ((A, B), (B, A)))
        return PathOfContact(pitch, early, late)
    gamma = (A + B) / 0.4
    early, late = (optimal_sides.uniform_heat(pitch, b, gamma, X) for b in (A, B))
    return PathOfContact(pitch, early, late)


@lru_cache(maxsize=2)
def sides(kind: Kind) -> tuple[tuple[Seen, PathContact], ...]:
    """Approach and recess of three shapes."""
    found = []
    for shape in ("involute", "stress", "heat"):
        for recess in (False, True):
            seen = profiles.seen(path(kind, shape), recess, 0.3)
            found.append((seen, path(kind, shape).at(seen.X)))
    return tuple(found)


def off(kind: Kind, one: Sided, other: Sided) -> float:
    """The greatest difference of two formulas over all profiles, in parts of the greatest value."""
    return max(_off(one(v), other(v)) for v, _ in sides(kind))


def of_path(kind: Kind, one: Sided, other: Callable[[PathContact], Any]) -> float:
    """The same, the second being the library's account of the path."""
    return max(_off(one(v), other(c)) for v, c in sides(kind))


def _off(one: Any, other: Any) -> float:
    return float(np.abs(np.asarray(one) - other).max() / np.abs(other).max())


def frame(v: Seen) -> tuple[Any, Any]:
    """Unit vectors at the contact: away from gear 1's centre, and along its tooth, from the points of its body."""
    r, angle = v.r[0], v.body[0]
    D = profiles.differentiation(v.X)
    if v.bevel:
        points = np.array([np.sin(r) * np.sin(angle), np.sin(r) * np.cos(angle), np.cos(r)])
        away = np.array([np.cos(r) * np.sin(angle), np.cos(r) * np.cos(angle), -np.sin(r)])
    else:
        points, away = np.array([r * np.sin(angle), r * np.cos(angle)]), np.array([np.sin(angle), np.cos(angle)])
    along = points @ D.T
    return away, along


def cosine_of_psi(v: Seen) -> Any:
    """The cosine of the angle between radius and tooth, from points."""
    away, along = frame(v)
    return np.abs((away * along).sum(axis=0)) / np.linalg.norm(along, axis=0)


def arc_rate(v: Seen) -> Any:
    """ds over d theta of gear 1, from points."""
    _, along = frame(v)
    return np.linalg.norm(along, axis=0) / np.abs(profiles.differentiation(v.X) @ v.body[0])


def rate(v: Seen) -> float:
    """1/R1 + 1/R2, or the sum of cotangents."""
    return 1 / tan(v.R1) + 1 / tan(v.R2) if v.bevel else 1 / v.R1 + 1 / v.R2


def distance(v: Seen) -> Any:
    """s, or its sine."""
    return np.sin(v.s) if v.bevel else v.s


# -------------------------------------------------------------------------------------------- sections 1 to 8: geometry


def eq_4() -> float:
    """Distance of the modified normals from the centre along the curve (4): it should be one and the same."""
    mu, c = 0.2, 1.0
    r = np.linspace(1.05, 2.0, 60)
    root = np.sqrt(r**2 / c**2 - 1)
    inside = 1 - mu * root
    # d theta / dr, each term by itself
    slope = (-mu * (r / c**2) / root) / inside / mu + c / (r * np.sqrt(r**2 - c**2))
    psi = np.arctan(r * slope)  # between radius and curve
    reach = [r * np.abs(np.cos(psi + sign * np.arctan(mu))) for sign in (1, -1)]
    return float(min(np.ptp(each) / each.max() for each in reach))


def strings(kind: Kind) -> float:
    """The flank of an involute against its string, in the plane and by (5)."""
    made = path(kind, "involute")
    v = profiles.seen(made, True, 0.2)
    R, r, angle = v.R1, v.r[0], v.body[0]
    if kind == "bevel":
        base = asin(sin(R) * cos(radians(20)))
        string = np.arccos(np.cos(r) / cos(base)) / sin(base) - np.arccos(tan(base) / np.tan(r))
    else:
        base = R * cos(radians(20))
        string = np.sqrt((r / base) ** 2 - 1) - np.arccos(base / r)
    turn = np.abs(angle - angle[0])
    return _off(turn, np.abs(string - string[0]))


def cycloid_normal() -> float:
    """The normal of a cycloid turns at half the rate of its generating circle, and touches on that circle."""
    rho = 4.5
    made = closed_form_sides.cycloid(SPUR, SPUR.p / 2, rho)
    d = np.linspace(0.1, 0.9, 30) * made.end
    psi, X = np.arcsin(made.sin_psi(d)), made.travel(d)
    on_circle = np.abs(d * np.exp(1j * psi) - 1j * rho) / rho - 1
    return max(_off(psi, X / rho / 2), float(np.abs(on_circle).max()))


def involute_line() -> float:
    """The contact of an involute runs along a straight line at constant speed: d = X cos psi."""
    v = profiles.seen(path("spur", "involute"), True, 0.2)
    return max(_off(v.s, v.X * cos(radians(20))), float(np.ptp(v.cos_phi)))


def steady_force() -> Finding:
    """The normal force under constant torque, along the path of each shape, as maximum over minimum."""
    spread = {}
    for shape in ("involute", "stress", "heat"):
        v = profiles.seen(path("spur", shape), True, 0.3)
        spread[shape] = float(v.sin_phi.max() / v.sin_phi.min())
    text = ", ".join(f"{shape} {value:.3f}" for shape, value in spread.items())
    return Finding(
        spread["involute"] < 1 + 1e-9 < min(spread["stress"], spread["heat"]), f"maximum over minimum force: {text}"
    )


def gamma(v: Seen) -> Any:
    """w2 t - theta2."""
    return -v.turned[1]


def eq_6(v: Seen) -> Any:
    """Right side of (6), over the left."""
    return np.cos(v.r[1]) * np.cos(gamma(v)) + np.sin(gamma(v)) * np.tan(v.psi(2))


def eq_8(sign: float) -> float:
    """cos r1 by (8)."""
    return off(
        "bevel",
        lambda v: np.cos(v.R1) * np.cos(v.s) + sign * np.sin(v.R1) * np.sin(v.s) * v.cos_phi,
        lambda v: np.cos(v.r[0]),
    )


def eq_11(sign: float) -> float:
    """The square of r1 by (11), in parts of it."""
    return off("spur", lambda v: v.s**2 + v.R1**2 + sign * 2 * v.R1 * v.s * v.cos_phi, lambda v: v.r[0] ** 2)


def eq_21() -> float:
    """cos R1 by (21)."""
    return off(
        "bevel",
        lambda v: np.cos(v.r[0]) * np.cos(v.s) + np.sin(v.r[0]) * np.sin(v.s) * np.sin(v.psi(1)),
        lambda v: np.full_like(v.s, cos(v.R1)),
    )


def eq_22(sign: float) -> float:
    """sin s by (22)."""

    def sine(v: Seen) -> Any:
        R, r, psi = v.R1, v.r[0], v.psi(1)
        root = np.cos(r) * np.sqrt(np.sin(R) ** 2 - np.cos(psi) ** 2 * np.sin(r) ** 2)
        return (np.cos(R) * np.sin(psi) * np.sin(r) + sign * root) / (
            np.sin(psi) ** 2 * np.sin(r) ** 2 + np.cos(r) ** 2
        )

    return off("bevel", sine, lambda v: np.sin(v.s))


def eq_23(sign: float) -> float:
    """s by (23)."""
    return off(
        "spur",
        lambda v: v.r[0] * np.sin(v.psi(1)) + sign * np.sqrt(v.R1**2 - (v.r[0] * np.cos(v.psi(1))) ** 2),
        lambda v: v.s,
    )


def pins() -> float:
    """(12) to (16) against the library's path of a lantern, and its points of the mate."""
    R1, R2, A, B = 12.0, 18.0, 17.6, 0.8
    pitch = SPUR
    side = closed_form_sides.lantern(R2, A, B, pitch.p)
    nothing = optimal_sides.involute(1e-6, radians(20))
    made = PathOfContact(pitch, nothing, side)
    start = closed_form_sides.pin_angle(R2, A, B) * R2
    X = np.linspace(0.1, 0.9, 30) * pitch.p
    contact, points = made.at(X), made.flank(1, X)
    turn = (X + start) / R2
    C = np.sqrt(A**2 + R2**2 - 2 * A * R2 * np.cos(turn)) - B  # (12)
    x, y = C / (C + B) * A * np.sin(turn), C / (C + B) * (R2 - A * np.cos(turn))  # (13), mirrored
    r = np.hypot(x, y + R1)  # (14)
    part = C / (C + B)
    r15 = np.sqrt((part * A) ** 2 + (R1 + part * R2) ** 2 - 2 * (R1 + R2 * part) * part * A * np.cos(turn))
    theta16 = np.arctan2(part * A * np.sin(turn), part * (R1 / part + R2 - A * np.cos(turn))) - X / R1
    own_r, own_theta = np.hypot(points[:, 0], points[:, 1] + R1), np.arctan2(points[:, 0], points[:, 1] + R1)
    return max(_off(C, contact.d), _off(r, own_r), _off(r15, own_r), float(np.abs(theta16 - own_theta).max()))


def same_flank(shape: str) -> Finding:
    """Gear 1's flank beside mates of 36 and of 60 teeth."""
    flanks = []
    for mate in (36, 60):
        pitch = PitchSurfaces.spur(24, mate)
        X, A, B = pitch.p / 2, pitch.A, pitch.B
        if shape == "involute":
            one = other = optimal_sides.involute(X, radians(20))
        elif shape == "cycloid":
            one = other = closed_form_sides.cycloid(pitch, X, 4.5)
        elif shape == "friction":  # the note's own extremal, with its ends and its arc
            one = other = closed_form_sides.extremal(pitch, 1.0, radians(80), radians(50))
        elif shape == "temperature":  # the heat of gear 1 uniform, at one gamma
            one, other = (optimal_sides.uniform_heat(pitch, beta, 0.3, X) for beta in (A, -A))
        else:
            one, other = (optimal_sides.uniform_stress(pitch, a, b, X, radians(20)) for a, b in ((B, A), (A, B)))
        made = PathOfContact(pitch, one, other)
        first, last = made.arcs
        at = np.linspace(0.2 if shape == "friction" else -0.9 * first, 0.9 * last, 25)
        flanks.append(made.flank(1, at))
    apart = float(np.abs(flanks[0] - flanks[1]).max())
    text = "the same flank to 1e-10" if apart < 1e-10 else f"flanks up to {apart:.4f} modules apart"
    return Finding(apart < 1e-10, f"24 teeth with 36 and 60: {text}")


def sliding(kind: Kind) -> float:
    """(17) or (18), and (20) or (19), against the speeds of both surfaces."""
    printed = of_path(
        kind,
        lambda v: v.height(1) * np.sin(v.psi(1)) / v.reach(1) - v.height(2) * np.sin(v.psi(2)) / v.reach(2),
        lambda c: c.U1 - c.U2,
    )
    return max(printed, of_path(kind, lambda v: rate(v) * distance(v), lambda c: c.U1 - c.U2))


def dokos(times: float) -> float:
    """The coefficient of the library's law of dry steel, at so many times its slowest speed."""
    law = DokosFriction(law="dokos")
    return float(law.coefficient(np.array(law.slowest.si * times)))


def buckingham(feet: float) -> float:
    """The coefficient of the library's law of cast iron in oil, at so many feet a minute."""
    return float(BuckinghamFriction(law="buckingham").coefficient(np.array(feet * FOOT_A_MINUTE)))


def sliding_turns() -> Finding:
    """Signs of the sliding before and after the pitch point, and where it is 0."""
    signs = {bool(v.X[0] < 0): np.sign(c.U1 - c.U2) for v, c in sides("spur")}
    good = bool((signs[True] < 0).all() and (signs[False] > 0).all())
    return Finding(good, "0 only at s = 0, where it reverses")


# ---------------------------------------------------------------------------------------- sections 12 to 14: curvatures


def eq_24() -> float:
    """ds of y(x): a quarter of a circle."""
    x, weights = np.polynomial.legendre.leggauss(60)
    angle = pi / 8 * (x + 1)  # x = sin(angle), up to 45 deg
    steps = np.sqrt(1 + np.tan(angle) ** 2) * np.cos(angle)
    return abs(float(weights @ steps) * pi / 8 / (pi / 4) - 1)


def eq_27_first() -> float:
    """The radius of curvature of y = x^2 against the circle through three near points of it."""
    x, h = np.linspace(0.1, 1.0, 20), 1e-4
    printed = (1 + (2 * x) ** 2) ** 1.5 / 2
    a, b, c = (np.array([x + k * h, (x + k * h) ** 2]) for k in (-1, 0, 1))
    u, v = b - a, c - b
    area = np.abs(u[0] * v[1] - u[1] * v[0]) / 2
    circle = np.hypot(*u) * np.hypot(*v) * np.hypot(*(c - a)) / (4 * area)
    return _off(printed, circle)


def eq_28(kind: Kind) -> float:
    """(28), or the middle of (29), with psi' from points, against the curvature of the path."""

    def curvature(v: Seen) -> Any:
        D = profiles.differentiation(v.X)
        sign = np.sign((D @ v.r[0]) / (D @ v.body[0]))
        angle = v.body[0] * sign
        psi = np.arctan2(v.height(1), -v.slope[0])
        bend = (D @ psi) / (D @ angle)
        over = np.cos(v.r[0]) - bend if v.bevel else 1 - bend
        return over * np.sin(psi) / v.height(1)

    return of_path(kind, curvature, lambda c: c.k1)


def curvature(kind: Kind) -> float:
    """(27) or (29) from r, r' and r'' of both gears, against the curvature of the path."""
    return max(
        of_path(kind, lambda v: v.curvature(1), lambda c: c.k1),
        of_path(kind, lambda v: v.curvature(2), lambda c: -c.k2),
    )


def unlike_heat(kind: Kind) -> tuple[tuple[Seen, PathContact], ...]:
    """All but uniform heat, whose curvature is without bound at the pitch point."""
    return sides(kind)[:4]


def centres(v: Seen) -> tuple[Any, Any, Any, Any]:
    """Both centres of curvature in the fixed plane."""
    x, y = np.array(v.P) / v.s
    return x * (v.s - v.c(1)), y * (v.s - v.c(1)), x * (v.s + v.c(2)), y * (v.s + v.c(2))


def eq_30() -> float:
    """(30), in parts of its right side."""
    found = []
    for v, _ in unlike_heat("spur"):
        x1, y1, x2, y2 = centres(v)
        found.append(_off((v.R1 + v.R2) * (y1 * y2 + x2 * x1), (y1 - y2) * v.R1 * v.R2))
    return max(found)


def eq_31() -> float:
    """(31)."""
    found = []
    for v, _ in unlike_heat("spur"):
        x1, y1, x2, _y2 = centres(v)
        found.append(_off(y1 / ((1 / v.R2 + 1 / v.R1) * (y1**2 + x1**2) + y1), x2 / x1))
    return max(found)


def savary(kind: Kind) -> float:
    """(32) or (37), upper sign."""

    def left(v: Seen) -> Any:
        if v.bevel:
            return 1 / np.tan(v.c(1) - v.s) + 1 / np.tan(v.c(2) + v.s)
        return 1 / (v.c(1) - v.s) + 1 / (v.c(2) + v.s)

    return max(_off(left(v), rate(v) / v.cos_phi) for v, _ in unlike_heat(kind))


def cosine_of_phi(kind: Kind) -> tuple[float, float]:
    """(33) or (38) as printed, and with the sine."""

    def printed(v: Seen) -> Any:
        return v.height(1) / v.reach(1) * np.cos(v.psi(1))

    return off(kind, printed, lambda v: v.cos_phi), off(kind, printed, lambda v: v.sin_phi)


def spherical_centres(which: int, sign: float = 1.0) -> float:
    """(34) and (35): cosines of A2 and A1, from unit vectors, against the printed sums."""
    found = []
    for v, _ in unlike_heat("bevel"):
        reach = v.s + v.c(2) if which == 2 else v.s - v.c(1)
        R, side = (v.R2, 1.0) if which == 2 else (v.R1, -1.0)
        up = v.P[1] / np.sin(v.s)
        cosine = side * sin(R) * np.sin(reach) * up + cos(R) * np.cos(reach)
        printed = np.cos(reach) * cos(R) + sign * np.sin(reach) * sin(R) * side * v.cos_phi
        found.append(_off(printed, cosine))
    return max(found)


def eq_36() -> float:
    """(36)."""
    return max(
        _off(v.cos_phi / np.tan(v.s + v.c(2)) - v.cos_phi / np.tan(v.s - v.c(1)), np.full_like(v.s, rate(v)))
        for v, _ in unlike_heat("bevel")
    )


def triangle(which: int) -> float:
    """(39) and (41), on a spherical triangle of sides R and A with w t between them, put up by unit vectors."""
    worst = 0.0
    for R, A, turn in ((0.4, 0.7, 0.3), (0.9, 0.5, 1.1), (0.3, 0.35, 2.0)):
        pitch = np.array([sin(R), 0, cos(R)])
        centre = np.array([sin(A) * cos(turn), sin(A) * sin(turn), cos(A)])
        along = np.array([cos(A) * cos(turn), cos(A) * sin(turn), -sin(A)])  # at the centre of curvature, from the axis
        across = np.array([-sin(turn), cos(turn), 0])
        to_pitch = pitch - centre * (pitch @ centre)
        alpha = np.arctan2(-(to_pitch @ across), -(to_pitch @ along))  # angle at the centre of curvature
        if which == 41:
            worst = max(worst, abs(cos(R) * cos(A) + sin(R) * sin(A) * cos(turn) - pitch @ centre))
        else:
            worst = max(worst, abs(sin(turn) / tan(alpha) + cos(turn) * cos(A) - sin(A) / tan(R)))
    return float(worst)


def speed_of_contact(kind: Kind) -> tuple[float, float]:
    """(42), (44) with c + s, and with c - s, against the speed of the contact along gear 1."""
    found = [[], []]  # type: list[list[float]]
    for v, c in unlike_heat(kind):
        for at, kept in ((v.c(1) + v.s, found[0]), (v.c(1) - v.s, found[1])):
            kept.append(_off(crawl(v, at), c.U1))
    return max(found[0]), max(found[1])


def eq_43() -> float:
    """cos A1 by (43), against the distance of the centre of curvature from the axis."""
    found = []
    for v, _ in unlike_heat("bevel"):
        reach = v.s - v.c(1)
        true = -sin(v.R1) * np.sin(reach) * v.P[1] / np.sin(v.s) + cos(v.R1) * np.cos(reach)
        r, c = v.r[0], v.c(1)
        found.append(_off(np.cos(r) * np.cos(c) + np.sin(r) * np.sin(c) * np.sin(v.psi(1)), true))
    return max(found)


# ------------------------------------------------------------------------------------- sections 15 to 19: what is best


def force(v: Seen) -> Any:
    """(47) or (49), for a torque of the pitch radius."""
    return np.sqrt(1 / v.slope[0] ** 2 + 1 / v.height(1) ** 2) * v.reach(1)


def forces(kind: Kind) -> float:
    """(47) or (49) against the balance of torques."""
    return of_path(kind, force, lambda c: 1 / c.cos_psi)


def rack_force() -> float:
    """(48) of straight racks: 1 over the cosine of their pressure angle, y being across the pitch line."""
    tilts = np.radians([14.5, 20.0, 30.0, 45.0])
    return _off(np.sqrt(1 + (1 / np.tan(tilts)) ** -2.0), 1 / np.cos(tilts))


def work(kind: Kind) -> float:
    """(46), (50): work over a side by the printed integrand over ds, against the library's loss over X."""
    found = []
    for v, c in sides(kind)[:4]:
        D = profiles.differentiation(v.X)
        printed = rate(v) * np.abs(distance(v)) * force(v) / v.crawl(1) * v.along(1) * np.abs(D @ v.body[0])
        found.append(_off(printed, np.abs(c.U1 - c.U2) / c.cos_psi))
    return max(found)


def spirals() -> float:
    """The curves of the wrong formula cross radii at 45 deg: r' = r, and r' = sin r on the sphere."""
    theta, h = np.linspace(-1, 0.5, 30), 1e-5

    def loxodrome(t: Any) -> Any:
        return 2 * np.arctan(np.exp(t) / 2)

    slope = (loxodrome(theta + h) - loxodrome(theta - h)) / (2 * h)
    return _off(slope, np.sin(loxodrome(theta)))


def shared_work() -> Finding:
    """Work of one engagement of 24/36 involutes, the force undivided, and divided among the pairs in contact."""
    answer = Command("mesh 24 36", "losses_and_stresses").value()
    ratio = Command("mesh 24 36", "contact_ratio").value()
    whole, divided = answer["one_pair"]["loss"] * ratio, answer["shared"]["loss"]
    part = divided / whole
    return Finding(
        abs(part - 1) < 1e-6, f"contact ratio {ratio:.3f}: if the force is shared, W is {part:.3f} times as large"
    )


def losses(kind: Kind) -> tuple[float, float]:
    """How far the form factor by (51) or (52) spreads over pairs, as printed and corrected; it should be one number."""
    printed, corrected, G = [], [], 0.02
    radii = ((1.0, 1.0), (1.0, 3.0), (1.0, 10.0)) if kind == "spur" else ((0.3, 0.4), (0.3, 1.2), (0.9, 0.6))
    for R1, R2 in radii:
        pitch = PitchSurfaces(100, 100, R1, R2, kind == "bevel")
        made = optimal_sides.involute(G, radians(20))
        x, weights = np.polynomial.legendre.leggauss(20)
        c = PathOfContact(pitch, made, made).at(G * (x + 1) / 2)
        loss = float(weights @ ((c.U1 - c.U2) / c.cos_psi)) / 2 / G
        ratio = R1 / R2 if kind == "spur" else sin(R1) / sin(R2)
        printed.append(loss / (ratio + 1 / ratio))
        corrected.append(loss / (pitch.A + pitch.B))
    return max(printed) / min(printed) - 1, max(corrected) / min(corrected) - 1


def trains() -> Finding:
    """Loss of three stages of 10 over one of 1000, with one pinion, by (51) as it must be."""
    one, three = 1 + 1 / 1000, 3 * (1 + 1 / 10)
    return Finding(
        three < one, f"for 1000 to 1 with the same pinion, three stages lose {three / one:.2f} times as much"
    )


def heights() -> Finding:
    """J of racks over the pressure angle, at one height and at one arc."""
    tilts = np.radians([14.5, 20.0, 30.0, 45.0, 60.0])
    arcs = 1 / (np.sin(tilts) * np.cos(tilts))
    same = [float(optimal_sides.involute(1.0, float(tilt)).travel(np.array(cos(tilt)))) for tilt in tilts]
    at_height = int(np.argmin(arcs**2 / 2)) == 3
    return Finding(at_height and np.ptp(same) > 1e-9, "45 deg is best at one height; at one arc all are equal")


def stress() -> float:
    """(55), (58): the printed left side, over its value at one place, against the stress of the path."""
    found = []
    for kind in BOTH:
        found += [_off(force(v) * (v.curvature(1) + v.curvature(2)), c.H) for v, c in unlike_heat(kind)]
    return max(found)


def long_one(equation: int) -> tuple[float, float]:
    """(56) or (63) as printed and corrected, on involutes and uniform stress of 24/36, recess."""
    printed, corrected = [], []
    for v, c in (sides("spur")[1], sides("spur")[3]):
        jet = (v.r[0], v.slope[0], v.bend[0], np.sqrt)
        H = 1 / (1 / v.R1 + 1 / v.R2)
        if equation == 56:
            true, first, second = c.H, profiles.printed_56(v.R1, H, *jet), profiles.corrected_56(v.R1, H, *jet)
            scale: Any = v.R1
        else:
            true, first, second = c.Q1, profiles.printed_63(v.R1, v.R2, *jet), profiles.corrected_63(v.R1, v.R2, *jet)
            scale = v.R1 / v.along(1)
        printed.append(_off(first * scale, true))
        corrected.append(_off(second * scale, true))
    return min(printed), max(corrected)


def eq_57() -> float:
    """Q by (57) against what it stands for, r^2 - s N with the lower sign of (23)."""
    return off(
        "spur",
        lambda v: profiles.root_Q(v.R1, v.r[0], v.slope[0], np.sqrt),
        lambda v: v.r[0] ** 2 - v.s * np.hypot(v.r[0], v.slope[0]),
    )


def involute_root() -> Finding:
    """Radius of curvature of an involute towards its base circle: its power of r - r0."""
    base = 12 * cos(radians(20))
    above = np.array([1e-4, 1e-6])
    c = np.sqrt((base + above) ** 2 - base**2)  # the string
    v = profiles.seen(path("spur", "involute"), True, 0.2)
    assert _off(v.c(1), np.sqrt(v.r[0] ** 2 - base**2)) < TWICE
    power = float(log(c[0] / c[1]) / log(above[0] / above[1]))
    return Finding(abs(power - 0.5) < 1e-4, f"c varies as (r - r0)^{power:.3f}, stress as (r - r0)^{-power / 2:.3f}")


def heat() -> float:
    """(60) times (61) is (62), and (62) is the heat of the path."""
    found = []
    for kind in BOTH:
        for v, c in unlike_heat(kind):
            relative = v.curvature(1) + v.curvature(2)
            made = np.sqrt(force(v)) * np.sqrt(relative) * rate(v) * np.abs(distance(v))
            lasts = np.sqrt(force(v)) / (np.sqrt(relative) * v.crawl(1))
            found.append(_off(made * lasts, c.Q1))
    return max(found)


def order_of_64() -> tuple[float, float]:
    """How the left side of (64) depends on r''' and r'''', with Z as printed and corrected; 0 is the second order."""
    import mpmath as mp

    def lagrange(Z: Any, curve: list[Any]) -> Any:
        def along(part: tuple[int, int, int]) -> Any:
            def value(theta: Any) -> Any:
                jets = [
                    sum(mp.ff(n, k) * a * theta ** (n - k) for n, a in enumerate(curve) if n >= k) for k in range(3)
                ]
                return mp.diff(Z, tuple(jets), part)

            return value

        return along((1, 0, 0))(0) - mp.diff(along((0, 1, 0)), 0) + mp.diff(along((0, 0, 1)), 0, 2)

    found = []
    with mp.workdps(40):
        for Z in (profiles.printed_63, profiles.corrected_63):

            def value(r: Any, p: Any, q: Any, Z: Any = Z) -> Any:
                return Z(mp.mpf(12), mp.mpf(18), r, p, q, mp.sqrt)

            start = [mp.mpf("12.5"), mp.mpf(31), mp.mpf(-14)]
            plain = lagrange(value, [*start, 0, 0])
            bent = lagrange(value, [*start, mp.mpf(25), mp.mpf(-40)])
            found.append(float(abs(plain - bent) / abs(plain)))
    return found[0], found[1]


def uniform(form: str, kind: Kind) -> Finding:
    """A solved pair: how far what is to be uniform departs from it."""
    if form == "friction":
        pitch = SPUR if kind == "spur" else BEVEL
        side = closed_form_sides.extremal(pitch, pitch.p / 2, radians(80), radians(50))
        d = np.linspace(side.pieces[0].start, side.pieces[0].end, 30)[1:-1]
        S = np.sin(d) if pitch.bevel else d
        D = S / np.sqrt(1 - side.sin_psi(d) ** 2)
        return Finding(float(np.ptp(D) / D.max()) < 1e-9, "S = D cos psi along its closed form, from 80 to 50 deg")
    if form == "stress":
        spread = max(float(np.ptp(c.H) / c.H.max()) for _, c in sides(kind)[2:4])
        return Finding(spread < 1e-9, "the stress is uniform to 1e-9 in approach and recess")
    spread = 0.0
    for (_, c), ded in zip(sides(kind)[4:], ("Q1", "Q2"), strict=True):
        heat = getattr(c, ded)
        spread = max(spread, float(np.ptp(heat) / heat.max()))
    return Finding(spread < 1e-9, "the heat of the hotter tooth is uniform to 1e-9 in approach and recess")


def minimum_height(shape: str) -> Finding:
    """Whether the greatest of the criterion is the least possible: against an involute of 80 or 45 deg."""
    tilt = {"stress": 45.0, "temperature": 80.0}[shape]
    other = optimal_sides.involute(SPUR.p / 2, radians(tilt))
    c = PathOfContact(SPUR, other, other).at(np.linspace(-0.999, 0.999, 400) * SPUR.p / 2)
    own = path("spur", "stress" if shape == "stress" else "heat").at(np.linspace(-0.999, 0.999, 400) * SPUR.p / 2)
    first, second = (float(np.max(e.H if shape == "stress" else np.maximum(e.Q1, e.Q2))) for e in (own, c))
    return Finding(first <= second, f"maximum {first:.3f}; {second:.3f} for an involute of {tilt:g} deg")


def extremal_is_minimum() -> Finding:
    """J of the note's problem: the closed extremal against other paths between the same ends, over the same arc."""
    side = closed_form_sides.extremal(SPUR, 1.0, radians(80), radians(50))
    first, last = side.pieces[0].start, side.pieces[0].end
    x, weights = np.polynomial.legendre.leggauss(40)
    half = (last - first) / 2
    d = first + half * (x + 1)
    slope = 1 / np.sqrt(1 - side.sin_psi(d) ** 2)
    own = float(weights @ (d * slope**2)) * half
    others = []
    for wave in (1, 2, 3):
        bump = 0.05 * wave * pi * np.cos(wave * pi * (x + 1) / 2)
        others.append(float(weights @ (d * (slope + bump) ** 2)) * half)
    good = abs(own * log(last / first) - 1) < 1e-9 and min(others) > own
    return Finding(good, f"J = X^2/ln(d2/d1) = {own:.6f}; three other paths give at least {min(others):.6f}")


# ------------------------------------------------------------------------------------------------- what commands give


def misplaced(form: str) -> float:
    """Transmission error, peak to peak (rad), of 24/36 with their axes a tenth of a module too far apart."""
    train = geartrain.load(
        "links: {frame: {}, a: {wheels: {A: 24}}, b: {wheels: {B: 36}}}\n"
        "revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]\n"
        f"gears: [{{pair: [A, B], tooth_form: {{form: {form}, centre_distance: 30.1}}}}]\ninputs: {{a: 1}}\n"
    )
    low, high = train.meshes[0].transmission.error_range()
    return float(high - low)


def spacing() -> Finding:
    """Involutes against other forms, misplaced."""
    found = {form: misplaced(form) for form in ("involute", "cycloidal", "uniform_stress")}
    text = ", ".join(f"{form} {1e3 * value:.3f} mrad" for form, value in found.items())
    return Finding(
        found["involute"] < 1e-12 < min(found["cycloidal"], found["uniform_stress"]), f"transmission error: {text}"
    )


def compared(form: str, what: str) -> float:
    """A ratio to the involute of the same arcs, from `geartrain mesh 24 36 --compare`."""
    rows = {row["form"]: row["ratios"] for row in Command("mesh 24 36 --compare", "forms").value()}
    return float(rows[form]["one_pair"][what])


def cycloids_rub() -> Finding:
    """Whether cycloids lose less than involutes at the same arcs."""
    loss = compared("cycloidal", "loss")
    return Finding(loss < 1, f"at the same arcs they lose {loss:.4f} times as much")


def contact_number() -> Finding:
    """Contact ratio of standard involutes."""
    ratio = float(Command("mesh 24 36", "contact_ratio").value())
    return Finding(ratio > 1.4, f"24/36, 20 deg: {ratio:.3f}")


def arithmetic(which: str) -> float:
    """The numbers of section 16, from (51) as printed."""
    X = sqrt(2 + sqrt(3))
    two = ((1 + sqrt(3) + sqrt(2 * sqrt(3))) / 2) ** 2
    assert abs(3 * (X + 1 / X) - X**3 - X**-3) < 1e-12
    assert abs(2 * (sqrt(two) + 1 / sqrt(two)) - two - 1 / two) < 1e-12
    return {"33": (1000 + 1 / 1000) / (3 * (10 + 1 / 10)), "X": X, "cube": X**3, "two": two}[which]


def law_of_gearing() -> Finding:
    """Points of both teeth at one place, at every displacement, for three shapes in the plane and on the sphere."""
    apart = max(v.apart / (1 if v.bevel else v.R2) for kind in BOTH for v, _ in sides(kind))
    return Finding(apart < 1e-12, "both teeth coincide at every displacement, for three shapes, to 1e-12")


def not_one_flank() -> Finding:
    """Uniform stress: the flank depends on the mate."""
    found = same_flank("stress")
    return Finding(not found, found.text)
