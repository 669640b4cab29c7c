"""Three causes of the error of a pointer: its pins in slots, the ripple of teeth, and lost motion.

The ripple is the motion with the declared teeth minus the motion of the same pins with ideal teeth, at the same
positions (docs/motion.md, 3), because the anomaly that pins are meant to give is not an error of teeth. Lost motion is
the lag of a pointer when the crank turns back: the motion on the coast flanks minus the motion on the drive flanks.

With ideal teeth, the pins cause a deviation d(phi) from uniform motion over one cycle of the pin. The true motion has
the equation of centre C(M), with the mean anomaly M, over one anomalistic revolution. The initial phase of the pin is
chosen by the maker, so the phase of M is the one that minimises sum (d(phi) - C(phi + phase) - mean)^2. The mean is
removed because the pointer can be set. The true motion of Moon and Sun is Kepler's, with eccentricity e, eccentric
anomaly E and true anomaly nu: M = E - e sin E, tan(nu/2) = sqrt((1 + e)/(1 - e)) tan(E/2). Perturbations of the Moon by
the Sun (evection, variation, annual equation: 1.3, 0.7 and 0.2 degrees) and of both by the planets are neglected.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import degrees, hypot, pi, sqrt
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorDifference
from geartrain.dynamics.motion.motion_run import MotionRun
from geartrain.dynamics.motion.run_statistics import RunningStatistics
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.kinematics.willis_system import axis_sense
from geartrain.workshop.budget.pointer_budget import BudgetCause, Declared

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.judged_outputs import OutputResult
    from geartrain.numerics.arrays import Floats


Body = Literal["moon", "sun"]
_ROUNDING = 1e-12  # smaller sensitivities are rounding errors
_STEPS = 40  # maximum iterations, far more than Newton's method needs for these orbits
_POSITIONS = 4096  # positions over one cycle of the pin, a power of 2 for the FFT
_NEAR = 0.02  # maximum relative difference of a target from the period of the body


# --------------------------------------------------------------------------------------------------- teeth and backlash


class DeclaredPairs(NamedTuple):
    """Gear pairs and couplings on the path from the input to one output, counted by their declared data."""

    real: int
    """Number of gear pairs with declared tooth forms."""
    gears: int
    """Number of all gear pairs."""
    pins: tuple[str, ...]
    """Names of all couplings."""
    bare: tuple[str, ...]
    """Names of the couplings without declared dimensions."""


@dataclass(frozen=True)
class ToothMotion:
    """Ripple and lost motion of the outputs of a train due to its teeth, computed over several turns of the input."""

    ripple: Mapping[str, RunningStatistics]
    """Statistics of the transmission error of each output due to the teeth [rad], keyed by output."""
    lost: Mapping[str, tuple[float, float]]
    """Maximum and rms of the lag of each output after a reversal of the crank [rad], keyed by output."""
    pairs: Mapping[str, Mapping[str, float]]
    """Peak-to-peak error of each output due to the teeth of each pair [deg], keyed by output and then by pair."""
    declared: Mapping[str, DeclaredPairs]
    """Gear pairs and couplings that move each output, keyed by output."""
    reversing_drivers: tuple[str, ...]


def find_tooth_motion(motion: Motion, turns: float, samples: int) -> ToothMotion:
    """Return ripple and lag after a reversal of all outputs, at `samples` positions over `turns` turns of the input."""
    ripple = MotionRun(motion.without_anomaly(), turns, samples)
    ripple.run()
    # difference of two motions at the same position: backwards and forwards
    lost = ErrorDifference(motion._backward, motion._forward)
    maximum, squares = np.zeros(len(motion.outputs)), np.zeros(len(motion.outputs))
    back = set(ripple.reversing_drivers)
    for start in range(0, samples, lost.chunk):
        backlash = lost.at(turns * (np.arange(start, min(start + lost.chunk, samples)) / (samples - 1)))
        back |= backlash.reversing_drivers
        maximum = np.maximum(maximum, np.abs(backlash.error).max(axis=1))
        squares += np.sum(backlash.error**2, axis=1)
    names = list(motion.outputs)
    return ToothMotion(
        dict(zip(names, ripple.statistics, strict=True)),
        {
            name: (float(most), sqrt(square / samples))
            for name, most, square in zip(names, maximum, squares, strict=True)
        },
        pair_ripples(motion),
        {name: declared_pairs(motion, name) for name in names},
        tuple(sorted(back)),
    )


def pair_ripples(motion: Motion) -> dict[str, dict[str, float]]:
    """Return the peak-to-peak error due to each pair [deg], keyed by output and then by pair, in descending order."""
    # the transmission error of a pair times the sensitivity of the output to it
    found = Superposition(motion._forward)
    pins = {joint.coupling.name for joint in motion._problem.couplings}
    tables = {}
    for name, row in zip(motion.outputs, np.abs(found.response) * found.ranges, strict=True):
        sizes = {source.id: degrees(size) for source, size in zip(found.sources, row.tolist(), strict=True)}
        ranked = sorted(sizes.items(), key=lambda item: -item[1])
        tables[name] = {pair: size for pair, size in ranked if size > _ROUNDING and pair not in pins}
    return tables


def moving_pairs(motion: Motion, output: str) -> tuple[str, ...]:
    """Return the names of the pairs and couplings whose transmission errors affect an output."""
    spread, signs = motion._propagation, motion._problem.signs
    couplings = {circuit.id for circuit in motion._problem.circuits if circuit.swings}
    # depth-first search: the error of a pin depends on the angle of its driver, which other pairs move
    waiting, found = [motion.outputs[output]], dict.fromkeys(spread.pairs, False)
    index = {link: at for at, link in enumerate(spread.links)}
    while waiting:
        of, base = waiting.pop()
        row = spread.sensitivity(index[of], index[base], axis_sense(of, base, signs))
        for name, size in zip(spread.pairs, row.tolist(), strict=True):
            if abs(size) > _ROUNDING and not found[name]:
                found[name] = True
                if name in couplings:
                    joint = spread.joints[spread.pairs.index(name)]
                    waiting.append((spread.links[joint.driver], spread.links[joint.carrier]))
    return tuple(name for name, moves in found.items() if moves)


def declared_pairs(motion: Motion, output: str) -> DeclaredPairs:
    """Count the gear pairs on the path from the input to an output, and name the couplings on this path."""
    circuits = {circuit.id: circuit for circuit in motion._problem.circuits}
    real = set(motion._problem.meshes)
    sized = {joint.coupling.name for joint in motion._problem.couplings}
    moving = moving_pairs(motion, output)
    gears = [name for name in moving if circuits[name].kind == "gear"]
    pins = [name for name in moving if circuits[name].swings]
    return DeclaredPairs(
        sum(name in real for name in gears),
        len(gears),
        tuple(pins),
        tuple(name for name in pins if name not in sized),
    )


def tooth_causes(found: ToothMotion, name: str) -> tuple[BudgetCause, BudgetCause]:
    """Return the contributions of the causes "teeth" (ripple) and "lost motion" to the error of the output `name`."""
    known = found.declared[name]
    tally, (most, rms) = found.ripple[name], found.lost[name]
    bare = f"no dimensions are declared for {', '.join(known.bare)}"
    missing = bare if known.bare and not tally.peak_to_peak else ""
    if known.gears and not known.real:
        missing = f"none of the {known.gears} pairs that move it has a tooth form"
    if missing:
        return BudgetCause.unknown("teeth", missing), BudgetCause.unknown("lost motion", missing)
    if not known.gears and not known.pins:
        of = "no gear pair is between it and the input"
    else:
        of = f"{known.real} of {known.gears} pairs" if known.real < known.gears else f"all {known.gears} pairs"
    first = next(iter(found.pairs[name].items()), None)
    worst = f", largest by {first[0]} ({first[1]:.3g} deg by itself)" if first else ""
    more = f"; {bare}, so they add no ripple here" if known.bare else ""
    backlash = f"; backlash of {', '.join(known.pins)} unknown" if known.pins else ""
    declared: Declared = "part" if known.bare or known.real < known.gears else "whole"
    teeth = BudgetCause("teeth", declared, degrees(tally.peak_to_peak), degrees(tally.rms), note=of + worst + more)
    if known.real and most < _ROUNDING:  # teeth without backlash lose no motion, which is rarely meant
        return teeth, BudgetCause.unknown("lost motion", "the pairs that move it have teeth without backlash")
    declared = "part" if known.pins else declared
    return teeth, BudgetCause("lost motion", declared, degrees(most), degrees(rms), note=of + backlash)


# ---------------------------------------------------------------------------------------------------------- true motion


@dataclass(frozen=True, slots=True)
class TrueMotion:
    """Orbit of a celestial body. Its true motion is compared with the deviation of a pointer from uniform motion."""

    eccentricity: float
    """Present eccentricity of the orbit."""
    period: float
    """Sidereal or tropical period [d], to 0.01 d. The target period of a pointer must be close to it."""
    words: frozenset[str]
    """Words in the name of an output or link that identify the body."""
    source: str
    """Source from which the eccentricity is taken."""


TRUE_MOTIONS: dict[Body, TrueMotion] = {
    "moon": TrueMotion(0.0549, 27.3217, frozenset({"moon"}), "NASA planetary fact sheets (general knowledge)"),
    "sun": TrueMotion(0.0167, 365.2422, frozenset({"sun"}), "NASA planetary fact sheets (general knowledge)"),
}


def equation_of_centre(M: Floats, e: float) -> Floats:
    """Return the equation of centre (true minus mean anomaly) [rad] at mean anomalies M [rad] for an eccentricity e.

    Kepler's equation is solved for 0 <= e < 1 by Newton's method to rounding accuracy. It starts at the eccentric
    anomaly E = M + e sin M, from which it converges for the small e of these orbits.
    """
    E = M + e * np.sin(M)
    for _ in range(_STEPS):
        step = (E - e * np.sin(E) - M) / (1 - e * np.cos(E))
        E = E - step
        if np.max(np.abs(step), initial=0.0) < 1e-15:  # rounding errors of E
            break
    # nu - E by one atan2, without half angles, is continuous over many turns
    beta = e / (1 + np.sqrt(1 - e * e))
    found: Floats = 2 * np.arctan2(beta * np.sin(E), 1 - beta * np.cos(E)) + (E - M)
    return found


# ----------------------------------------------------------------------------------------------------------------- pins


@dataclass(frozen=True, slots=True)
class TheoryError:
    """Difference between the deviations of one link and of a celestial body from their uniform motions."""

    words: str
    """Description of the compared motions, or the reason why their difference is unknown."""
    peak_to_peak: float | None = None
    """Peak-to-peak difference [rad]; None if it is unknown."""
    rms: float = 0.0
    """Root mean square of the difference [rad]."""


def find_bodies(
    outputs: Iterable[OutputResult], frame: str, unit_days: float | None, named: Mapping[str, Body | None]
) -> dict[str, Body]:
    """Return the celestial body that each link represents, keyed by link, for outputs relative to the link `frame`.

    The body is given by `named` (None: no body), keyed by output. Otherwise the name of the output or link must contain
    the name of the body, and one of the declared target periods must be within 2 % of the period of the body.

    unit_days   duration of the train's unit of time (d); None if its unit is not a time
    """
    found: dict[str, Body] = {}
    for output in outputs:
        if output.relative_to != frame:
            continue
        words = set(re.split(r"[\W_]+", f"{output.name} {output.of}".lower()))
        speeds = [abs(float(target.speed)) for target in output.targets if target.speed] if unit_days else []
        inferred: Body | None = None
        for body, motion in TRUE_MOTIONS.items():
            near = any(abs((unit_days or 0.0) / speed / motion.period - 1) < _NEAR for speed in speeds)
            if inferred is None and near and words & motion.words:
                inferred = body
        represented = named.get(output.name, inferred)
        if represented is not None:
            # the first output of a link decides
            found.setdefault(output.of, represented)
    return found


def link_theory(problem: MotionProblem, link: str, body: Body) -> TheoryError:
    """Return the difference between the deviations of a link, with ideal teeth, and of a body from uniform motion.

    The result contains no values if a pin that moves the link has no dimensions, or if several pins move it.
    """
    from geartrain.dynamics import Motion

    motion = Motion(replace(problem, meshes={}), {link: (link, problem.frame)})
    if bare := declared_pairs(motion, link).bare:
        return TheoryError(f"no dimensions are declared for {', '.join(bare)}")
    used = [source for source in motion._forward.used if source.cycles]
    if len(used) > 1:
        return TheoryError(f"{len(used)} pins move '{link}' together")
    phase = 2 * pi * np.arange(_POSITIONS) / _POSITIONS
    error = np.zeros(_POSITIONS)
    if used:
        # `cycles` counts the cycles of the pin in a turn of the input
        error = motion.at(phase / (2 * pi * float(used[0].cycles))).error[0]
    # a link that turns backwards shows the anomaly with the opposite sign
    sense = -1.0 if problem.ratio(link) < 0 else 1.0
    rest = minimum_difference(sense * error, TRUE_MOTIONS[body].eccentricity)
    how = f"pin of {used[0].id}" if used else "uniform motion without a pin"
    words = f"{how} against the {body.capitalize()}, eccentricity {TRUE_MOTIONS[body].eccentricity}"
    return TheoryError(words, float(np.ptp(rest)), float(np.std(rest)))


def minimum_difference(error: Floats, e: float) -> Floats:
    """Return the difference between an error and the equation of centre [rad] over one cycle.

    The phase of the equation of centre is that at which the mean square of the difference is a minimum.

    error   error at the phases 2 pi k/n, shape (n,) [rad]; its mean is removed
    e       eccentricity of the orbit
    """
    from scipy.optimize import minimize_scalar

    n = len(error)
    phase = 2 * pi * np.arange(n) / n
    centre = equation_of_centre(phase, e)

    def rest(shift: float) -> Floats:
        left = error - equation_of_centre(phase + shift, e)
        found: Floats = left - left.mean()
        return found

    # correlation by FFT finds the best of n phases; it is then refined between its neighbours
    # the sum of squares is a constant minus twice this correlation
    product = np.fft.irfft(np.conj(np.fft.rfft(error)) * np.fft.rfft(centre), n)
    best, step = float(phase[int(np.argmax(product))]), 2 * pi / n
    found = minimize_scalar(
        lambda shift: float(np.sum(rest(shift) ** 2)), bounds=(best - step, best + step), method="bounded"
    )
    return rest(float(found.x))


def theory_cause(parts: list[TheoryError]) -> BudgetCause:
    """Return the contribution of the cause "theory" to the error of a pointer.

    parts   differences from the true motion, of the pointer's link and of its reference link: peak-to-peak values are
            added, and rms values are combined as a root sum of squares
    """
    if not parts:
        return BudgetCause.unknown("theory", "the true motion it shows is not known to geartrain")
    if unknown := [part.words for part in parts if part.peak_to_peak is None]:
        return BudgetCause.unknown("theory", "; ".join(unknown))
    # the cycles of the two links differ, so peak-to-peak values are added, and rms values in quadrature
    size = float(np.degrees(sum(part.peak_to_peak or 0.0 for part in parts)))
    rms = float(np.degrees(hypot(*(part.rms for part in parts))))
    return BudgetCause("theory", "whole", size, rms, note="; ".join(part.words for part in parts))
