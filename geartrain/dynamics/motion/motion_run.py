"""Run of a motion over a number of revolutions of the input, with its statistics and its spectrum by exact orders of
the input (docs/motion.md, section 5).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase
from geartrain.dynamics.motion.extreme_search import count_extremes
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.numerics.results import Key, Pictured, Result, Tabular

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Floats

    Complex = NDArray[np.complex128]
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.dynamics.motion.superposition import Superposition

    OnDone = Callable[[int], None]

_SAMPLES = 1 << 14  # samples of one period of a transmission function, or of 64 pitches
_HARMONICS = 24  # harmonics of the pitch evaluated for each pair
_MOST_LINES = 12  # spectral lines of an output
_MAIN = 3  # outputs in a summary
_ANGLES = ("angle (rad)", "error (rad)", "speed")  # columns of an output that turns
_FAINT = 1e-6  # fraction of the strongest line: weaker lines are omitted


class HarmonicShare(NamedTuple):
    """Harmonic of a pair's transmission error, and its first-order amplitude in the error of an output."""

    pair: str
    """Name of the pair whose error has this harmonic."""
    harmonic: int
    """Number of the harmonic, which is the number of its cycles per period of the pair's transmission error."""
    amplitude: float
    """First-order amplitude of the harmonic in the output's error [rad]."""


@dataclass(frozen=True)
class SpectrumLine(Result):
    """Line in the spectrum of an output's transmission error, at an exact order of the input."""

    KEYS = (Key("order", to=float), Key("exact", "order"), "expected", "measured", Key("pairs", "shares"))

    order: Fraction
    """Order of the line: exact number of periods per revolution of the input."""
    shares: tuple[HarmonicShare, ...]
    """Harmonics of the pairs' transmission errors that have this order."""
    expected: float
    """First-order estimate of the amplitude, which is the sum of `shares` with their phases [rad]."""
    measured: float
    """Amplitude of the line in the composed motion, from a Fourier sum [rad]."""


def find_spectrum(
    motion: Motion, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
) -> dict[str, list[SpectrumLine]]:
    """Return at most `_MOST_LINES` spectral lines of every output, in descending order of their first-order amplitudes.

    Two lines are resolved if their numbers of periods within the evaluated revolutions differ by at least 2. If these
    revolutions are an integer number of common periods, the amplitudes are exact except for aliases of harmonics above
    half the sampling rate.
    """
    from geartrain.dynamics.motion.superposition import Superposition

    superposed = Superposition(motion._composition(turns))
    harmonics = [_harmonics(superposed, at) for at in range(len(superposed.sources))]
    found = {name: _expected(superposed, harmonics, at) for at, name in enumerate(motion.outputs)}
    # lines of all outputs are measured in one pass through the run
    orders = sorted({line.order for lines in found.values() for line in lines})
    if not orders:
        # without lines nothing is measured, but the progress must still be complete
        on_done(samples)
        return {name: [] for name in found}
    measured = _measure(motion, turns, samples, orders, on_done)
    return {
        name: [replace(line, measured=measured[at, orders.index(line.order)]) for line in lines]
        for at, (name, lines) in enumerate(found.items())
    }


def _harmonics(superposed: Superposition, at: int) -> Complex:
    """Return the complex amplitudes [rad] of harmonics 1, 2, ... of the periodic error of pair number `at`, with phases
    that refer to position 0 of the input.
    """
    source = superposed.sources[at]
    pitches = source.transmission.pitch_count
    samples = _SAMPLES * (1 + (pitches - 1) // 64)
    u = np.arange(samples) / samples
    shift = source.start + superposed.lags[at]
    error = source.sense * source.transmission.error(u * source.transmission.period + shift)
    # factor 2, because half of the amplitude of a real signal is at the negative frequency
    return np.asarray(2 * np.fft.rfft(error)[1 : _HARMONICS * pitches + 1] / samples)


def _expected(superposed: Superposition, harmonics: list[Complex], output: int) -> list[SpectrumLine]:
    phasors: dict[Fraction, list[tuple[str, int, complex]]] = {}
    for at, source in enumerate(superposed.sources):
        if not source.cycles:
            continue
        for k, amplitude in enumerate(harmonics[at], 1):
            line = (source.id, k, complex(superposed.response[output, at] * amplitude))
            phasors.setdefault(k * source.cycles, []).append(line)
    lines = [
        SpectrumLine(
            order,
            tuple(
                HarmonicShare(pair, k, abs(phasor))
                for pair, k, phasor in parts
                # a harmonic of rounding errors may have the order of a line
                if abs(phasor) >= _FAINT * max(abs(each) for _, _, each in parts)
            ),
            abs(sum(p for _, _, p in parts)),
            0.0,
        )
        for order, parts in phasors.items()
    ]
    # lines of equal amplitude are ordered by order, so that the list is reproducible
    lines.sort(key=lambda line: (-line.expected, line.order))
    strongest = lines[0].expected if lines else 0.0
    return [line for line in lines[:_MOST_LINES] if line.expected > _FAINT * strongest]


def _measure(
    motion: Motion, turns: float, samples: int, orders: list[Fraction], on_done: Callable[[int], None]
) -> Floats:
    """Return the amplitudes of the output errors at given orders of the input [rad], shape (outputs, orders), from a
    Fourier sum over all positions. A Hann window is used unless `turns` is an integer number of periods.
    """
    closes = bool(motion.period) and (Fraction(turns) / (motion.period or 1)).denominator == 1
    sums = np.zeros((len(motion.outputs), len(orders)), dtype=complex)
    centre, weights = np.zeros(len(motion.outputs)), 0.0
    means = np.zeros(len(orders), dtype=complex)
    done = 0
    for passage in motion._stretches(turns, samples):
        at = np.arange(done, done + len(passage.turns)) / (samples - 1)
        done += len(passage.turns)
        # whole periods need no window, but the last position repeats the first; otherwise Hann reduces leakage
        window = np.where(at < 1, 1.0, 0.0) if closes else 1 - np.cos(2 * np.pi * at)
        angle = InputPhase(passage.turns)
        waves = np.exp(-2j * np.pi * np.stack([angle.cycles(order) for order in orders])) * window
        sums += passage.error @ waves.T
        means += waves.sum(axis=1)
        centre += passage.error @ window
        weights += float(window.sum())
        on_done(len(passage.turns))
    # the mean is subtracted, so that it does not leak into any line
    return np.asarray(2 * np.abs(sums - (centre / weights)[:, None] * means) / weights)


MOST_TURNS = 10**12
"""Maximum number of revolutions. Beyond it, positions in float64 do not resolve single teeth."""


@dataclass
class MotionRun(Tabular, Pictured):
    """Evaluation of a motion at input positions from 0 to `turns` revolutions.

    The methods `run`, `run_random_phases` and `find_spectra` compute the results.

    Raises
    ------
    QuestionError
        If `turns` exceeds 1e12, or if there are fewer than two samples.

    Examples
    --------
    >>> import geartrain
    >>> run = MotionRun(geartrain.load("moon-triangular").motion(outputs=["moon"]), turns=1, samples=2001)
    >>> run.run()
    >>> moon, = run.statistics
    >>> moon.ratio, round(moon.peak_to_peak, 3), round(moon.rms, 3)
    (Fraction(254, 95), 0.103, 0.022)
    """

    MEANINGS: ClassVar = {
        "output": "Output or link.",
        "mean speed": "Mean speed divided by the input speed [1].",
        "exact": "Mean speed divided by the input speed, as a fraction [1].",
        "error p-p (rad)": "Maximum minus minimum of the transmission error [rad].",
        "error rms (rad)": "Root mean square of the transmission error about its mean [rad].",
        "slowest": "Minimum speed minus mean speed, divided by the input speed [1].",
        "fastest": "Maximum speed minus mean speed, divided by the input speed [1].",
        "mean travel": "Mean travel of a link that slides, per turn of the input [mm/turn].",
        "exact travel": "Mean travel of a link that slides, per turn of the input, as a fraction [mm/turn].",
        "error p-p (mm)": "Maximum minus minimum of the error of a link that slides [mm].",
        "error rms (mm)": "Root mean square of the error of a link that slides, about its mean [mm].",
        "slowest travel": "Minimum minus mean travel of a link that slides, per turn of the input [mm/turn].",
        "fastest travel": "Maximum minus mean travel of a link that slides, per turn of the input [mm/turn].",
    }

    PAGE = "report.motion_report:motion_document"

    FIGURE = "drawing.output_error_plots:motion_figure"

    motion: Motion
    """Motion that is evaluated."""
    turns: float
    """Number of revolutions of the input, up to 1e12 in magnitude. If it is negative, the input turns against its
    declared sense, and the coast flanks are in contact.
    """
    samples: int
    """Number of evaluated positions, 2 or more, including the first and the last position."""
    statistics: list[RunningStatistics] = field(default_factory=list)
    """Extremes, mean and root mean square of each output's error, and extremes of its speed."""
    phase_statistics: list[list[RunningStatistics]] = field(default_factory=list)
    """Extremes, mean and root mean square of each output's error for each set of random phases."""
    seed: int | None = None
    """Random seed for the phases; None if no random phases were used."""
    spectra: dict[str, list[SpectrumLine]] = field(default_factory=dict)
    """Spectral lines by output, in descending order of the first-order amplitude."""
    done: int = 0
    """Number of positions evaluated so far; it is less than `samples` after an interrupted run."""
    reversing_drivers: set[str] = field(default_factory=set)
    """Names of pairs whose driver temporarily turned against its mean sense; their backlash is not modelled."""

    def __post_init__(self) -> None:
        if not abs(self.turns) <= MOST_TURNS:
            why = f"float64 resolves single teeth only up to {MOST_TURNS:g} turns"
            fix = f"pass turns from -{MOST_TURNS:g} to {MOST_TURNS:g}"
            raise QuestionError(Problem(f"turns = {self.turns:g} is out of range", why, fix))
        if self.samples < 2:
            raise QuestionError(
                Problem(
                    f"samples = {self.samples} is too small",
                    "a run has at least two positions of the input",
                    "pass samples >= 2",
                )
            )

    def _summary(self) -> str:
        declared = self.motion._declaration
        turns = f"{self.turns:g} turn{'' if self.turns == 1 else 's'}"
        peaks = [
            f"{each.name} {each.degrees_or_mm * each.peak_to_peak:.4g} {'mm' if each.slides else 'deg'}"
            for each in self.statistics[:_MAIN]
        ]
        shown = f"transmission error p-p {', '.join(peaks)}" if peaks else "not run yet"
        more = f", {len(self.statistics) - _MAIN} more" if len(self.statistics) > _MAIN else ""
        cut = f", stopped after {self.done} of {self.samples} positions" if 0 < self.done < self.samples else ""
        return f"{'' if declared is None else declared.name + ': '}{turns}, {shown}{more}{cut}"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each evaluated output: mean speed, transmission error and extreme speeds.

        The mean speed is divided by the input speed [1], and the error is in rad. `slowest` and `fastest` are the
        extreme speeds minus the mean speed, divided by the input speed [1]. For links that slide there are separate
        columns, in mm and in mm per revolution.
        """
        meanings = list(self.MEANINGS)
        found: dict[str, Sequence[Any]] = {"output": [each.name for each in self.statistics]}
        for slides in sorted({each.slides for each in self.statistics} or {False}):
            rows = [
                (float(each.ratio), str(each.ratio), each.peak_to_peak, each.rms, each.slow, each.fast)
                if each.slides == slides
                else (None,) * 6
                for each in self.statistics
            ]
            heads = meanings[7:] if slides else meanings[1:7]
            found |= {head: [row[at] for row in rows] for at, head in enumerate(heads)}
        return found

    def run(self, on_done: OnDone = lambda _: None) -> None:
        """Evaluate the outputs at every position, and search for extremes between the positions.

        Parameters
        ----------
        on_done : callable
            Progress function, called with the number of positions computed since the last call.

        Raises
        ------
        GearTrainError
            If coupled pairs have no unique solution.
        """
        self.statistics = self.motion._statistics()
        for passage in self.motion._stretches(self.turns, self.samples):
            for at, tally in enumerate(self.statistics):
                tally.add(passage.error[at], passage.rate[at])
            self.reversing_drivers |= passage.reversing_drivers
            self.done += len(passage.turns)
            on_done(len(passage.turns))
        # samples miss sharp peaks, so extremes are searched between them
        motions = [each for each in (self.motion, self.motion._ideal) if each is not None]
        compositions, sampler = [each._composition(self.turns) for each in motions], self.motion._sampler(self.turns)
        self.reversing_drivers |= count_extremes(compositions, sampler, self.turns, self.statistics)

    def run_random_phases(self, count: int, seed: int, on_done: OnDone = lambda _: None) -> None:
        """Repeat the computation with random tooth phases of the pairs that declare no phase.

        Parameters
        ----------
        count : int
            Number of sets of phases.
        seed : int
            Random seed, 0 or more.
        on_done : callable
            Progress function, as in `run`.
        """
        self.seed = seed if count else None
        if seed < 0:
            raise QuestionError(
                Problem(f"seed = {seed} is out of range", "a random seed must not be negative", "pass seed >= 0")
            )
        random = np.random.default_rng(seed)
        for _ in range(count):
            other = MotionRun(self.motion.with_random_phases(random), self.turns, self.samples)
            other.run(on_done)
            self.phase_statistics.append(other.statistics)

    def find_spectra(self, on_done: OnDone = lambda _: None) -> None:
        """Compute the spectrum of every output at exact orders of the input.

        Parameters
        ----------
        on_done : callable
            Progress function, as in `run`.
        """
        self.spectra = find_spectrum(self.motion, self.turns, self.samples, on_done=on_done)

    @property
    def _position_columns(self) -> list[str]:
        units = [
            (tally.name, ("travel (mm)", "error (mm)", "speed (mm/turn)") if tally.slides else _ANGLES)
            for tally in self.motion._statistics()
        ]
        return ["turns", *(f"{name} {what}" for name, heads in units for what in heads)]

    def _values(self, passage: ErrorSamples) -> list[Floats]:
        """Return the columns of a table of positions: revolutions of the input, and, for each output, its angle [rad],
        error [rad] and speed divided by the input speed [1], or its travel [mm], error [mm] and speed [mm/turn] if it
        slides.
        """
        found = [passage.turns]
        for at, (tally, start) in enumerate(zip(self.motion._statistics(), self.motion._start_angles, strict=True)):
            error, angle = passage.error[at], (1 if tally.slides else 2 * pi) * passage.turns
            found += [start + tally.mean * angle + error, error, tally.mean + passage.rate[at]]
        return found

    def _check_resumed(self, row: str, rows: int) -> None:
        """Raise an error if `row`, number `rows` of a partial table, has another position than in this run."""
        # same order of operations as in `_stretches`, so that the float and its text are identical
        turns = self.turns * ((rows - 1) / (self.samples - 1))
        if rows > self.samples or row.split(",")[0] != repr(turns):
            why = f"its row {rows} is at {row.split(',')[0]} turns, but this run has {turns!r} there"
            fix = "give the same turns and samples, or omit --resume to start again"
            raise GearTrainError(Problem("the partial file belongs to another run", why, fix))
