"""The second cause: what the pins of a pointer make of its anomaly, against the true motion of Moon or Sun.

The pointer's pins, all teeth ideal, give an error d(phi) over one cycle of the pin. The true motion has the equation of
centre C(M) over one anomalistic revolution. How the pin stands at first is the maker's choice: the phase of M is the
one that leaves least, sum (d(phi) - C(phi + phase) - mean)^2, and the mean is where the pointer is set.

The true motion of Moon and Sun is Kepler's: M = E - e sin E, tan(nu/2) = sqrt((1 + e)/(1 - e)) tan(E/2). The Sun's pull
on the Moon (evection, variation, annual equation: 1.3, 0.7 and 0.2 degrees) and the planets' on both are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import hypot, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.workshop.budget.pointer_budget import BudgetCause
from geartrain.workshop.budget.tooth_motion import declared_pairs

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.judged_outputs import OutputResult
    from geartrain.numerics.arrays import Floats


# ---------------------------------------------------------------------------------------------------------- true motion


Body = Literal["moon", "sun"]

_STEPS = 40  # far more than Newton's method takes for any ellipse


@dataclass(frozen=True, slots=True)
class TrueMotion:
    """What is shipped of a body's orbit.

    eccentricity   of its ellipse, today
    period         from a star or the equinox back to it, to a hundredth (d): a pointer's target must be near it
    words          by which an output or link of it is known
    source         of the eccentricity
    """

    eccentricity: float
    period: float
    words: frozenset[str]
    source: str


TRUE_MOTIONS: dict[Body, TrueMotion] = {
    "moon": TrueMotion(0.0549, 27.3217, frozenset({"moon"}), "NASA planetary fact sheets (general knowledge)"),
    "sun": TrueMotion(0.0167, 365.2422, frozenset({"sun"}), "NASA planetary fact sheets (general knowledge)"),
}


def equation_of_centre(M: Floats, e: float) -> Floats:
    """True less mean anomaly (rad) at mean anomalies M (rad), eccentricity 0 <= e < 1: Kepler's equation by Newton.

    Right to rounding; E starts at M + e sin M, from where the method converges for the small e of these orbits.
    """
    E = M + e * np.sin(M)
    for _ in range(_STEPS):
        step = (E - e * np.sin(E) - M) / (1 - e * np.cos(E))
        E = E - step
        if np.max(np.abs(step), initial=0.0) < 1e-15:
            break
    # nu - E as one atan2: no half angles, no jumps between turns
    beta = e / (1 + np.sqrt(1 - e * e))
    found: Floats = 2 * np.arctan2(beta * np.sin(E), 1 - beta * np.cos(E)) + (E - M)
    return found


# ----------------------------------------------------------------------------------------------------------------- pins


_POSITIONS = 4096  # over one cycle of the pin
_NEAR = 0.02  # of the period: how far a target may be from the body's own


@dataclass(frozen=True, slots=True)
class TheoryError:
    """What one link's anomaly is off (rad), or why that is not known.

    known    False where a pin that moves the link has no dimensions, or several do
    """

    known: bool
    peak_to_peak: float
    rms: float
    words: str


def find_bodies(
    outputs: Iterable[OutputResult], frame: str, unit_days: float | None, named: Mapping[str, Body | None]
) -> dict[str, Body]:
    """The links that stand for a body: by the name of an output or link and a target near the body's period.

    named   by output, what it stands for whatever it is called; None: for nothing
    """
    found: dict[str, Body] = {}
    for output in outputs:
        if output.relative_to != frame:
            continue
        if output.name in named:
            body = named[output.name]
        else:
            body = next((each for each in TRUE_MOTIONS if _stands_for(output, each, unit_days)), None)
        if body is not None:
            found.setdefault(output.of, body)
    return found


def _stands_for(output: OutputResult, body: Body, unit_days: float | None) -> bool:
    motion = TRUE_MOTIONS[body]
    words = set(re.split(r"[\W_]+", f"{output.name} {output.of}".lower()))
    if not words & motion.words or not unit_days:
        return False
    periods = [unit_days / abs(float(target.speed)) for target in output.targets if target.speed]
    return any(abs(period / motion.period - 1) < _NEAR for period in periods)


def link_theory(problem: MotionProblem, link: str, body: Body) -> TheoryError:
    """The anomaly of one link, all teeth ideal, against the true motion of a body."""
    from geartrain.dynamics import Motion

    motion = Motion(replace(problem, meshes={}), {link: (link, problem.frame)})
    if bare := declared_pairs(motion, link).bare:
        return TheoryError(False, 0.0, 0.0, f"no dimensions are declared of {', '.join(bare)}")
    used = [source for source in motion.ahead.used if source.cycles]
    if len(used) > 1:
        return TheoryError(False, 0.0, 0.0, f"{len(used)} pins move '{link}' together")
    phase = 2 * pi * np.arange(_POSITIONS) / _POSITIONS
    error = np.zeros(_POSITIONS)
    if used:
        error = motion.at(phase / (2 * pi * float(used[0].cycles))).error[0]
    sense = -1.0 if problem.ratio(link) < 0 else 1.0
    rest = least_difference(sense * error, TRUE_MOTIONS[body].eccentricity)
    how = f"pin of {used[0].id}" if used else "no pin, a uniform motion,"
    words = f"{how} against the {body.capitalize()}, eccentricity {TRUE_MOTIONS[body].eccentricity}"
    return TheoryError(True, float(np.ptp(rest)), float(np.std(rest)), words)


def least_difference(error: Floats, e: float) -> Floats:
    """What is left of an error over one cycle less the equation of centre, at the phase that leaves least.

    error   (n,) at phases 2 pi k/n (rad); the mean of what is left is 0
    """
    from scipy.optimize import minimize_scalar

    n = len(error)
    phase = 2 * pi * np.arange(n) / n
    centre = equation_of_centre(phase, e)

    def rest(shift: float) -> Floats:
        left = error - equation_of_centre(phase + shift, e)
        found: Floats = left - left.mean()
        return found

    # correlation with all shifts at once finds the best of n phases; then between its neighbours
    product = np.fft.irfft(np.conj(np.fft.rfft(error)) * np.fft.rfft(centre), n)
    best, step = float(phase[int(np.argmax(product))]), 2 * pi / n
    found = minimize_scalar(
        lambda shift: float(np.sum(rest(shift) ** 2)), bounds=(best - step, best + step), method="bounded"
    )
    return rest(float(found.x))


def theory_cause(parts: list[TheoryError]) -> BudgetCause:
    """Parts of a pointer and of what it is read against: their cycles differ, so that peaks add, squares of rms too."""
    if not parts:
        return BudgetCause.unknown("theory", "no true motion is shipped for what it shows")
    if unknown := [part.words for part in parts if not part.known]:
        return BudgetCause.unknown("theory", "; ".join(unknown))
    size = float(np.degrees(sum(part.peak_to_peak for part in parts)))
    rms = float(np.degrees(hypot(*(part.rms for part in parts))))
    return BudgetCause("theory", "whole", size, rms, note="; ".join(part.words for part in parts))
