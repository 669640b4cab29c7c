"""The third and fourth cause: the ripple of the teeth through the train, and the play when the crank turns back.

The ripple is the motion with real teeth less the motion of the same pins with ideal ones, at the same positions
(docs/motion.md, 3): the anomaly that pins are meant to give is no error of teeth. Lost motion is how far a pointer
stays behind when the crank turns back: the same composition on the coast flanks, less that on the drive flanks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import degrees, sqrt
from typing import TYPE_CHECKING, NamedTuple

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
    from geartrain.numerics.arrays import Floats

_FEW = 1e-12  # a smaller sensitivity is rounding


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
    """What the teeth of a train do to its outputs over a run.

    ripple       tallies by output, of what the teeth alone add
    lost         by output, greatest and rms of what is lost when the crank turns back (rad)
    pairs        by output, what each pair alone would give, peak to peak (deg)
    declared     by output, what moves it and is declared
    """

    ripple: Mapping[str, RunningStatistics]
    lost: Mapping[str, tuple[float, float]]
    pairs: Mapping[str, Mapping[str, float]]
    declared: Mapping[str, DeclaredPairs]
    turned_back: tuple[str, ...]


def without_teeth(motion: Motion) -> Motion:
    """The same train with the same pins, and teeth that keep their ratio without play."""
    from geartrain.dynamics import Motion

    return Motion(replace(motion.train, meshes={}), motion.outputs)


def find_tooth_motion(
    motion: Motion, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
) -> ToothMotion:
    """Ripple and lost motion of every output at `samples` positions of `turns` of the input.

    on_done   called with the number of positions of each stretch that is done
    """
    ripple = ErrorDifference(motion.ahead, without_teeth(motion).ahead)
    lost = ErrorDifference(motion.back, motion.ahead)
    tallies = motion.tallies()
    greatest, squares = np.zeros(len(tallies)), np.zeros(len(tallies))
    back: set[str] = set()
    peaks = SampledPeaks(len(tallies))
    chunk = min(ripple.chunk, lost.chunk)
    for start in range(0, samples, chunk):
        at = turns * (np.arange(start, min(start + chunk, samples)) / (samples - 1))
        passage, play = ripple.at(at), lost.at(at)
        for tally, error, rate in zip(tallies, passage.error, passage.rate, strict=True):
            tally.add(error, rate)
        peaks.add(passage)
        back |= passage.turned_back | play.turned_back
        greatest = np.maximum(greatest, np.abs(play.error).max(axis=1))
        squares += np.sum(play.error**2, axis=1)
        on_done(len(at))
    search = ExtremeSearch(ripple.one, less=ripple.other)
    count_extremes(search, turns, turns / (samples - 1), peaks, tallies)
    names = list(motion.outputs)
    return ToothMotion(
        dict(zip(names, tallies, strict=True)),
        {
            name: (float(most), sqrt(square / samples))
            for name, most, square in zip(names, greatest, squares, strict=True)
        },
        pair_ripples(motion),
        {name: declared_pairs(motion, name) for name in names},
        tuple(sorted(back)),
    )


def pair_ripples(motion: Motion) -> dict[str, dict[str, float]]:
    """By output, the range of each pair's error times its sensitivity (deg), the greatest first; pins left out."""
    found = Superposition(motion.ahead)
    pins = {joint.coupling.name for joint in motion.train.pins}
    tables = {}
    for name, row in zip(motion.outputs, np.abs(found.response) * found.ranges, strict=True):
        sizes = {source.id: degrees(size) for source, size in zip(found.sources, row.tolist(), strict=True)}
        ranked = sorted(sizes.items(), key=lambda item: -item[1])
        tables[name] = {pair: size for pair, size in ranked if size > _FEW and pair not in pins}
    return tables


def moving_pairs(motion: Motion, output: str) -> tuple[str, ...]:
    """The pairs and couplings whose error reaches an output, be it through the angle at which a pin stands."""
    spread, signs = motion.spread, motion.train.signs
    couplings = {circuit.id for circuit in motion.train.circuits if circuit.swings}
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
    circuits = {circuit.id: circuit for circuit in motion.train.circuits}
    real = set(motion.train.meshes)
    sized = {joint.coupling.name for joint in motion.train.pins}
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
    play = f"; play of the pins of {', '.join(known.pins)} unknown" if known.pins else ""
    declared: Declared = "part" if known.bare or known.real < known.gears else "whole"
    lost = _cause("lost motion", "part" if known.pins else declared, most, rms, of + play)
    if known.real and most < _FEW:
        lost = BudgetCause.unknown("lost motion", "its pairs have teeth, but no backlash is declared")
    return _cause("teeth", declared, tally.peak_to_peak, tally.rms, of + worst + more), lost


def _undeclared(note: str) -> tuple[BudgetCause, BudgetCause]:
    return BudgetCause.unknown("teeth", note), BudgetCause.unknown("lost motion", note)


def _cause(name: CauseName, declared: Declared, size: float, rms: float, note: str) -> BudgetCause:
    return BudgetCause(name, declared, degrees(size), degrees(rms), note=note)
