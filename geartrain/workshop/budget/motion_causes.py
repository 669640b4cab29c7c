"""Three causes of the error of a pointer: theory of its pins, ripple of teeth, play when the crank turns back.

The ripple is the motion with real teeth less the motion of the same pins with ideal ones, at the same positions
(docs/motion.md, 3): the anomaly that pins are meant to give is no error of teeth. Lost motion is how far a pointer
stays behind when the crank turns back: the same composition on the coast flanks, less that on the drive flanks.

The pins, all teeth ideal, give an error d(phi) over one cycle of the pin. The true motion has the equation of centre
C(M) over one anomalistic revolution. How the pin stands at first is the maker's choice: the phase of M is the one that
leaves least, sum (d(phi) - C(phi + phase) - mean)^2, and the mean is where the pointer is set. The true motion of Moon
and Sun is Kepler's: M = E - e sin E, tan(nu/2) = sqrt((1 + e)/(1 - e)) tan(E/2). The Sun's pull on the Moon (evection,
variation, annual equation: 1.3, 0.7 and 0.2 degrees) and the planets' on both are left out.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from math import degrees, hypot, pi, sqrt
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from geartrain.dynamics.motion.extreme_search import ExtremeSearch
from geartrain.dynamics.motion.rate_bounds import error_difference
from geartrain.dynamics.motion.run_statistics import RunningStatistics, SampledPeaks, count_extremes
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.kinematics.willis_system import axis_sense
from geartrain.workshop.budget.pointer_budget import BudgetCause, CauseName, Declared

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorSamples
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.judged_outputs import OutputResult
    from geartrain.numerics.arrays import Floats


Body = Literal["moon", "sun"]
_FEW = 1e-12  # a smaller sensitivity is rounding
_STEPS = 40  # far more than Newton's method takes for any ellipse
_POSITIONS = 4096  # over one cycle of the pin
_NEAR = 0.02  # of the period: how far a target may be from the body's own


# ------------------------------------------------------------------------------------------------------- teeth and play


@dataclass(frozen=True)
class ErrorDifference:
    """Errors of one composition less those of another, of the same outputs at the same positions."""

    one: ErrorComposition
    other: ErrorComposition

    @property
    def chunk(self) -> int:
        """Positions worked on at once."""
        return min(self.one.chunk, self.other.chunk)

    def at(self, turns: Floats) -> ErrorSamples:
        """The differences where the input has made some turns, at most a chunk of them."""
        one, other = self.one.at(turns), self.other.at(turns)
        return error_difference(one, other)


class DeclaredPairs(NamedTuple):
    """What moves an output: gear pairs with real teeth, of how many; couplings, and those without dimensions."""

    real: int
    gears: int
    pins: tuple[str, ...]
    bare: tuple[str, ...]


@dataclass(frozen=True)
class ToothMotion:
    """What the teeth of a train do to its outputs over a run."""

    ripple: Mapping[str, RunningStatistics]
    """Tallies by output, of what the teeth alone add."""
    lost: Mapping[str, tuple[float, float]]
    """By output, greatest and rms of what is lost when the crank turns back (rad)."""
    pairs: Mapping[str, Mapping[str, float]]
    """By output, what each pair alone would give, peak to peak (deg)."""
    declared: Mapping[str, DeclaredPairs]
    """By output, what moves it and is declared."""
    reversing_drivers: tuple[str, ...]


def without_teeth(motion: Motion) -> Motion:
    """The same train with the same pins, and teeth that keep their ratio without play."""
    from geartrain.dynamics import Motion

    return Motion(replace(motion._problem, meshes={}), motion.outputs)


def find_tooth_motion(
    motion: Motion, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
) -> ToothMotion:
    """Ripple and lost motion of every output at `samples` positions of `turns` of the input.

    on_done   called with the number of positions of each stretch that is done
    """
    ripple = ErrorDifference(motion._forward, without_teeth(motion)._forward)
    lost = ErrorDifference(motion._backward, motion._forward)
    tallies = motion._statistics()
    maximum, squares = np.zeros(len(tallies)), np.zeros(len(tallies))
    back: set[str] = set()
    peaks = SampledPeaks(len(tallies))
    chunk = min(ripple.chunk, lost.chunk)
    for start in range(0, samples, chunk):
        at = turns * (np.arange(start, min(start + chunk, samples)) / (samples - 1))
        passage, backlash = ripple.at(at), lost.at(at)
        for tally, error, rate in zip(tallies, passage.error, passage.rate, strict=True):
            tally.add(error, rate)
        peaks.add(passage)
        back |= passage.reversing_drivers | backlash.reversing_drivers
        maximum = np.maximum(maximum, np.abs(backlash.error).max(axis=1))
        squares += np.sum(backlash.error**2, axis=1)
        on_done(len(at))
    search = ExtremeSearch(ripple.one, less=ripple.other)
    count_extremes(search, turns, turns / (samples - 1), peaks, tallies)
    names = list(motion.outputs)
    return ToothMotion(
        dict(zip(names, tallies, strict=True)),
        {
            name: (float(most), sqrt(square / samples))
            for name, most, square in zip(names, maximum, squares, strict=True)
        },
        pair_ripples(motion),
        {name: declared_pairs(motion, name) for name in names},
        tuple(sorted(back)),
    )


def pair_ripples(motion: Motion) -> dict[str, dict[str, float]]:
    """By output, the range of each pair's error times its sensitivity (deg), the greatest first; pins left out."""
    found = Superposition(motion._forward)
    pins = {joint.coupling.name for joint in motion._problem.pins}
    tables = {}
    for name, row in zip(motion.outputs, np.abs(found.response) * found.ranges, strict=True):
        sizes = {source.id: degrees(size) for source, size in zip(found.sources, row.tolist(), strict=True)}
        ranked = sorted(sizes.items(), key=lambda item: -item[1])
        tables[name] = {pair: size for pair, size in ranked if size > _FEW and pair not in pins}
    return tables


def moving_pairs(motion: Motion, output: str) -> tuple[str, ...]:
    """The pairs and couplings whose error reaches an output, be it through the angle at which a pin stands."""
    spread, signs = motion._propagation, motion._problem.signs
    couplings = {circuit.id for circuit in motion._problem.circuits if circuit.swings}
    waiting, found = [motion.outputs[output]], dict.fromkeys(spread.pairs, False)
    index = {link: at for at, link in enumerate(spread.links)}
    while waiting:
        of, base = waiting.pop()
        row = spread.sensitivity(index[of], index[base], axis_sense(of, base, signs))
        for name, size in zip(spread.pairs, row.tolist(), strict=True):
            if abs(size) > _FEW and not found[name]:
                found[name] = True
                if name in couplings:
                    joint = spread.joints[spread.pairs.index(name)]
                    waiting.append((spread.links[joint.driver], spread.links[joint.carrier]))
    return tuple(name for name, moves in found.items() if moves)


def declared_pairs(motion: Motion, output: str) -> DeclaredPairs:
    """What moves an output, and how much of it is declared."""
    circuits = {circuit.id: circuit for circuit in motion._problem.circuits}
    real = set(motion._problem.meshes)
    sized = {joint.coupling.name for joint in motion._problem.pins}
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
    """Ripple and lost motion of one output."""
    known = found.declared[name]
    if known.gears and not known.real:
        return _undeclared(f"none of the {known.gears} pairs that move it has a tooth form")
    tally, (most, rms) = found.ripple[name], found.lost[name]
    bare = f"no dimensions are declared of {', '.join(known.bare)}"
    if known.bare and not tally.peak_to_peak:
        return _undeclared(bare)
    if not known.gears and not known.pins:
        of = "no gear pair lies between it and the input"
    else:
        of = f"{known.real} of {known.gears} pairs" if known.real < known.gears else f"all {known.gears} pairs"
    first = next(iter(found.pairs[name].items()), None)
    worst = f", most by {first[0]} ({first[1]:.3g} deg alone)" if first else ""
    more = f"; {bare}, which pass on no ripple here" if known.bare else ""
    backlash = f"; play of the pins of {', '.join(known.pins)} unknown" if known.pins else ""
    declared: Declared = "part" if known.bare or known.real < known.gears else "whole"
    lost = _cause("lost motion", "part" if known.pins else declared, most, rms, of + backlash)
    if known.real and most < _FEW:
        lost = BudgetCause.unknown("lost motion", "its pairs have teeth, but no backlash is declared")
    return _cause("teeth", declared, tally.peak_to_peak, tally.rms, of + worst + more), lost


def _undeclared(note: str) -> tuple[BudgetCause, BudgetCause]:
    return BudgetCause.unknown("teeth", note), BudgetCause.unknown("lost motion", note)


def _cause(name: CauseName, declared: Declared, size: float, rms: float, note: str) -> BudgetCause:
    return BudgetCause(name, declared, degrees(size), degrees(rms), note=note)


# ---------------------------------------------------------------------------------------------------------- true motion


@dataclass(frozen=True, slots=True)
class TrueMotion:
    """What is shipped of a body's orbit."""

    eccentricity: float
    """Of its ellipse, today."""
    period: float
    """From a star or the equinox back to it, to a hundredth (d): a pointer's target must be near it."""
    words: frozenset[str]
    """By which an output or link of it is known."""
    source: str
    """Of the eccentricity."""


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


@dataclass(frozen=True, slots=True)
class TheoryError:
    """What one link's anomaly is off (rad), or why that is not known."""

    known: bool
    """False where a pin that moves the link has no dimensions, or several do."""
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
    used = [source for source in motion._forward.used if source.cycles]
    if len(used) > 1:
        return TheoryError(False, 0.0, 0.0, f"{len(used)} pins move '{link}' together")
    phase = 2 * pi * np.arange(_POSITIONS) / _POSITIONS
    error = np.zeros(_POSITIONS)
    if used:
        error = motion.at(phase / (2 * pi * float(used[0].cycles))).error[0]
    sense = -1.0 if problem.ratio(link) < 0 else 1.0
    rest = minimum_difference(sense * error, TRUE_MOTIONS[body].eccentricity)
    how = f"pin of {used[0].id}" if used else "no pin, a uniform motion,"
    words = f"{how} against the {body.capitalize()}, eccentricity {TRUE_MOTIONS[body].eccentricity}"
    return TheoryError(True, float(np.ptp(rest)), float(np.std(rest)), words)


def minimum_difference(error: Floats, e: float) -> Floats:
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
