"""What W. D. Smith's note says of axes that neither meet nor are parallel, and of contact at points."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np

from geartrain.dynamics.torques.mean_efficiencies import NORMAL_ANGLE, screw_efficiency
from geartrain.errors import GearTrainError
from geartrain.simulation.strength.contact_pressure import contact_ellipse
from geartrain.teeth import Cycloidal, LeastFriction, UniformStress, UniformTemperature
from geartrain.teeth.any_tooth_form import TOOTH_FORMS
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from sources.row import Finding
from sources.ways import answer

DUDLEY = 0.017, 0.061
"""Coefficients of friction that the note quotes from its source of efficiencies."""


def slowest(distance: float, angle: float, ratio: float) -> float:
    """The least speed at which two bodies pass each other in any point, over their relative rate of turning.

    The axes are `distance` apart under `angle` (rad), the second body turns `ratio` times as fast as the first: the
    pitch of the relative screw.
    """
    first, second = np.array([0.0, 0.0, 1.0]), ratio * np.array([np.sin(angle), 0.0, np.cos(angle)])
    turning = first - second
    moving = np.cross(second, [0.0, distance, 0.0])  # of the point where the first axis is met by the common normal
    return float(abs(turning @ moving) / (turning @ turning))


def rolling() -> Finding:
    """Parallel and meeting axes leave a line at rest; skew ones leave no point at rest."""
    rng = np.random.default_rng(3)
    draws = [(rng.uniform(0.1, 9), rng.uniform(0.1, pi - 0.1), rng.uniform(-4, 4)) for _ in range(500)]
    skew = min(slowest(*each) for each in draws)
    plane = max(max(slowest(0.0, angle, ratio), slowest(far, 0.0, ratio)) for far, angle, ratio in draws)
    text = (
        "relative screws of 500 pairs of axes: the pitch is 0 if the axes intersect or are parallel, otherwise above 0"
    )
    return Finding(plane < 1e-12 < skew, text)


def generatrix() -> Finding:
    """The relative screw axis meets the common normal, and both bodies slide along it only."""
    rng, across = np.random.default_rng(4), 0.0
    for _ in range(500):
        far, angle, ratio = rng.uniform(0.1, 9), rng.uniform(0.1, pi - 0.1), rng.uniform(-4, 4)
        second, base = ratio * np.array([np.sin(angle), 0.0, np.cos(angle)]), np.array([0.0, far, 0.0])
        turning = np.array([0.0, 0.0, 1.0]) - second
        foot = np.cross(turning, np.cross(second, base)) / (turning @ turning)
        for along in (-2.0, 0.0, 3.0):
            point = foot + along * turning
            speed = np.cross([0.0, 0.0, 1.0], point) - np.cross(second, point - base)
            across = max(across, float(np.linalg.norm(np.cross(speed, turning)) / np.linalg.norm(turning)))
        across = max(across, abs(float(foot[0])), abs(float(foot[2])))
    text = (
        "one line crosses the common normal of both axes and slides along itself; rotating it generates both surfaces"
    )
    return Finding(across < 1e-12, text)


def efficiencies() -> Finding:
    """Teeth alone: spur and bevel wheels of 24 and 36 teeth, and wheels on axes that cross under 90 degrees."""
    near = [
        answer(f"mesh 24 36 --friction {friction}{bevel}")["efficiency"]["mean"]
        for friction in DUDLEY
        for bevel in ("", " --shaft-angle 90deg")
    ]
    crossed = [
        screw_efficiency(radians(90 - lead), radians(lead), friction)
        for friction in DUDLEY
        for lead in (5, 10, 20, 30, 45)
    ]
    limit = 0.05 / 1.95 * cos(NORMAL_ANGLE)  # (1 - m) / (1 + m) = 0.95 at 45 degrees, m = friction / cos(20 degrees)
    text = (
        f"friction {DUDLEY[0]} to {DUDLEY[1]}, losses of teeth only; spur and bevel {100 * min(near):.1f} to "
        f"{100 * max(near):.1f} %; worms and crossed helices of 5 to 45 deg lead {100 * min(crossed):.1f} to "
        f"{100 * max(crossed):.1f} %, above 95 % if friction is less than {limit:.4f}"
    )
    return Finding(min(crossed) > 0.5 and max(crossed) < 0.97 < min(near), text)


def two_balls() -> float:
    """The greatest pressure of two balls, against Hertz's closed form (6 F E^2 / (pi^3 R^2))^(1/3)."""
    worst = 0.0
    for force, first, second, factor in ((10.0, 5.0, 8.0, 189.81), (200.0, 40.0, 11.0, 155.0)):
        curvature = 1 / first + 1 / second
        elastic = pi * factor**2
        closed = (6 * force * elastic**2 * curvature**2 / pi**3) ** (1 / 3)
        found = contact_ellipse(force, factor, (curvature, curvature), pi / 2).pressure
        worst = max(worst, abs(found / closed - 1))
    return worst


def fewest_teeth() -> Finding:
    """How few teeth a cycloidal wheel may have."""
    refused = []
    for z in (1, 2, 3):
        try:
            Cycloidal(form="cycloidal").pair(WheelPair(z, 20))
        except GearTrainError:
            refused.append(z)
    return Finding(refused == [1, 2], f"refused: {refused}")


def no_steady_heat() -> Finding:
    """The forms that are offered."""
    return Finding("uniform_heat" not in TOOTH_FORMS, ", ".join(TOOTH_FORMS))


def one_pair() -> Finding:
    """The arcs of the optimal shapes: together one pitch."""
    pair = WheelPair(24, 36)
    forms = (UniformStress(form="uniform_stress"), UniformTemperature(form="uniform_temperature"),
             LeastFriction(form="least_friction"))  # fmt: skip
    off = max(abs(sum(form.pair(pair).path.arcs) / pi - 1) for form in forms)
    return Finding(off < 1e-9, "their arcs of approach and recess are one pitch together")
