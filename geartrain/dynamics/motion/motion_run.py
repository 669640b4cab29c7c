"""One run of a motion: so many turns of the input in so many positions, and what is asked of it.

Its spectrum by exact orders of the input follows section 5 of docs/motion.md. A pair repeats `cycles` times in a turn
of the input, a rational number known exactly, so its harmonics fall on orders k cycles. To first order each line is
the pair's own harmonic times the output's sensitivity; the line that the composed motion really has there is measured
beside it, by a Fourier sum under a Hann window. What no line explains is the product of pairs that modulate each
other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import degrees, pi
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase
from geartrain.dynamics.motion.extreme_search import ExtremeSearch
from geartrain.dynamics.motion.run_statistics import SampledPeaks, count_extremes
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.numerics.results import Key, Pictured, Result, Tabular

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Floats

    Complex = NDArray[np.complex128]
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.dynamics.motion.superposition import ErrorEstimates, Superposition

    OnDone = Callable[[int], None]

_SAMPLES = 1 << 14  # of one period of a law
_HARMONICS = 24  # of each pair that are looked at
_MAIN = 3  # outputs in a summary
_FAINT = 1e-6  # of the strongest line


class HarmonicShare(NamedTuple):
    """A harmonic of a pair, and the amplitude (rad) it has in an output to first order."""

    pair: str
    """The pair."""
    harmonic: int
    """Number of the harmonic of its period."""
    amplitude: float
    """Its amplitude in the output to first order [rad]."""


@dataclass(frozen=True)
class SpectrumLine(Result):
    """One line of the spectrum of an output's error, at an exact order of the input.

    See Also
    --------
    MotionRun.spectra : where these stand, strongest first.
    """

    KEYS = (Key("order", to=float), Key("exact", "order"), "expected", "measured", Key("pairs", "shares"))

    order: Fraction
    """Periods per turn of the input."""
    shares: tuple[HarmonicShare, ...]
    """The pairs and harmonics that fall on this order, each with its amplitude to first order [rad]."""
    expected: float
    """Amplitude to first order, all of them together in their phases [rad]."""
    measured: float
    """Amplitude in the composed motion [rad]."""


def find_spectrum(
    motion: Motion, turns: float, samples: int, most: int = 12, on_done: Callable[[int], None] = lambda _: None
) -> dict[str, list[SpectrumLine]]:
    """The strongest lines of every output, strongest first, measured over `samples` positions.

    Lines are told apart if they differ by two periods over the run; over whole common periods the measure is exact but
    for harmonics beyond half the sampling rate.
    """
    from geartrain.dynamics.motion.superposition import Superposition

    superposed = Superposition(motion._forward if turns >= 0 else motion._backward)
    harmonics = [_harmonics(superposed, at) for at in range(len(superposed.sources))]
    found = {}
    for at, name in enumerate(motion.outputs):
        found[name] = _expected(superposed, harmonics, at, most)
    orders = sorted({line.order for lines in found.values() for line in lines})
    if not orders:
        on_done(samples)
        return {name: [] for name in found}
    measured = _measure(motion, turns, samples, orders, on_done)
    return {
        name: [
            SpectrumLine(line.order, line.shares, line.expected, measured[at, orders.index(line.order)])
            for line in found[name]
        ]
        for at, name in enumerate(motion.outputs)
    }


def _harmonics(superposed: Superposition, at: int) -> Complex:
    """Complex amplitudes of a pair's error at harmonics 1, 2, ... of its own period, in the phase of the run."""
    source = superposed.sources[at]
    u = np.arange(_SAMPLES) / _SAMPLES
    shift = source.start + superposed.lags[at]
    error = source.sense * source.transmission.error(u * source.transmission.period + shift)
    # twice, for half of a real wave stands at the negative frequency
    return np.asarray(2 * np.fft.rfft(error)[1 : _HARMONICS + 1] / _SAMPLES)


def _expected(superposed: Superposition, harmonics: list[Complex], output: int, most: int) -> list[SpectrumLine]:
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
            tuple(HarmonicShare(pair, k, abs(phasor)) for pair, k, phasor in parts),
            abs(sum(p for _, _, p in parts)),
            0.0,
        )
        for order, parts in phasors.items()
    ]
    # of equal amplitudes the lower order first, so that the list is the same each time
    lines.sort(key=lambda line: (-line.expected, line.order))
    strongest = lines[0].expected if lines else 0.0
    return [line for line in lines[:most] if line.expected > _FAINT * strongest]


def _measure(
    motion: Motion, turns: float, samples: int, orders: list[Fraction], on_done: Callable[[int], None]
) -> Floats:
    """Amplitudes of the composed errors at some orders, (outputs, orders), under a Hann window unless it closes."""
    closes = bool(motion.period) and (Fraction(turns) / (motion.period or 1)).denominator == 1
    sums = np.zeros((len(motion.outputs), len(orders)), dtype=complex)
    centre, weights = np.zeros(len(motion.outputs)), 0.0
    means = np.zeros(len(orders), dtype=complex)
    done = 0
    for passage in motion._stretches(turns, samples):
        at = np.arange(done, done + len(passage.turns)) / (samples - 1)
        done += len(passage.turns)
        # over whole periods every line closes, and the last position repeats the first; else Hann against leakage
        window = np.where(at < 1, 1.0, 0.0) if closes else 1 - np.cos(2 * np.pi * at)
        angle = InputPhase(passage.turns)
        waves = np.exp(-2j * np.pi * np.stack([angle.cycles(order) for order in orders])) * window
        sums += passage.error @ waves.T
        means += waves.sum(axis=1)
        centre += passage.error @ window
        weights += float(window.sum())
        on_done(len(passage.turns))
    # the mean, a lag of no frequency, leaks into no line
    return np.asarray(2 * np.abs(sums - (centre / weights)[:, None] * means) / weights)


MOST_TURNS = 10**12
"""Beyond so many turns of an input, positions as floats no longer tell the teeth of one turn apart."""


def _untold(_: int) -> None:
    pass


@dataclass
class MotionRun(Tabular, Pictured):
    """One run of a motion: positions from 0 to `turns` of the input, and what is asked of them.

    It has the results that were requested by `run`, `run_random_phases`, `find_estimates` and `find_spectra`.

    Raises
    ------
    QuestionError
        If there are more turns than positions can tell apart, or fewer than two samples.

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
        "mean speed": "Mean speed over that of the input [1].",
        "exact": "Mean speed over that of the input, as a fraction [1].",
        "error p-p (rad)": "Maximum less minimum of the transmission error [rad].",
        "error rms (rad)": "Root mean square of the transmission error about its mean [rad].",
        "slowest": "Minimum of the speed less its mean, over the speed of the input [1].",
        "fastest": "Maximum of the speed less its mean, over the speed of the input [1].",
    }

    PAGE = "report.motion_report:motion_document"

    FIGURE = "motion_figure"

    motion: Motion
    """The motion that is followed."""
    turns: float
    """Turns of the input, within 1e12 either way; negative turns go on the other flanks."""
    samples: int
    """Positions, 2 or more, both ends included."""
    statistics: list[RunningStatistics] = field(default_factory=list)
    """Peaks and moments by output."""
    phase_statistics: list[list[RunningStatistics]] = field(default_factory=list)
    """The same for each set of random phases."""
    seed: int | None = None
    """Of these phases; None where none were drawn."""
    estimates: dict[str, ErrorEstimates] = field(default_factory=dict)
    """By output."""
    spectra: dict[str, list[SpectrumLine]] = field(default_factory=dict)
    """By output, the strongest lines first."""
    done: int = 0
    """Positions counted so far: fewer than `samples` in a run that was interrupted."""
    reversing_drivers: set[str] = field(default_factory=set)
    """Pairs whose driver was seen turning against its mean; the play between their flanks is not followed there."""

    def __post_init__(self) -> None:
        if not abs(self.turns) <= MOST_TURNS:
            why = "so far away positions do not tell the teeth of one turn apart"
            raise QuestionError(
                Problem(
                    f"a motion over {self.turns:g} turns", why, f"give turns from -{MOST_TURNS:g} to {MOST_TURNS:g}"
                )
            )
        if self.samples < 2:
            raise QuestionError(
                Problem(f"{self.samples} positions of the input", "from one to the next it turns", "give 2 or more")
            )

    def _summary(self) -> str:
        declared = self.motion._declaration
        turns = f"{self.turns:g} turn{'' if self.turns == 1 else 's'}"
        peaks = [f"{each.name} {degrees(each.peak_to_peak):.4g} deg" for each in self.statistics[:_MAIN]]
        shown = f"transmission error p-p {', '.join(peaks)}" if peaks else "not run yet"
        more = f", {len(self.statistics) - _MAIN} more" if len(self.statistics) > _MAIN else ""
        cut = f", stopped after {self.done} of {self.samples} positions" if 0 < self.done < self.samples else ""
        return f"{'' if declared is None else declared.name + ': '}{turns}, {shown}{more}{cut}"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each output that was counted: mean speed over the input's, error [rad], speed over its mean."""
        return {
            "output": [each.name for each in self.statistics],
            "mean speed": [float(each.ratio) for each in self.statistics],
            "exact": [str(each.ratio) for each in self.statistics],
            "error p-p (rad)": [each.peak_to_peak for each in self.statistics],
            "error rms (rad)": [each.rms for each in self.statistics],
            "slowest": [each.slow for each in self.statistics],
            "fastest": [each.fast for each in self.statistics],
        }

    def run(self, on_done: OnDone = _untold) -> None:
        """Count every position, and seek the extremes between them.

        Parameters
        ----------
        on_done : callable
            Called with the number of positions of each stretch that is done.

        Raises
        ------
        GearTrainError
            If pairs depend on each other in a way that cannot be followed.
        """
        self.statistics = self.motion._statistics()
        peaks = SampledPeaks(len(self.statistics))
        for passage in self.motion._stretches(self.turns, self.samples):
            for at, tally in enumerate(self.statistics):
                tally.add(passage.error[at], passage.rate[at])
            peaks.add(passage)
            self.reversing_drivers |= passage.reversing_drivers
            self.done += len(passage.turns)
            on_done(len(passage.turns))
        composition = self.motion._forward if self.turns >= 0 else self.motion._backward
        search = ExtremeSearch(composition)
        count_extremes(search, self.turns, self.turns / (self.samples - 1), peaks, self.statistics)
        self.reversing_drivers |= search.reversing_drivers

    def run_random_phases(self, count: int, seed: int, on_done: OnDone = _untold) -> None:
        """The same run with random phases of the pairs that declare none.

        Parameters
        ----------
        count : int
            Sets of phases.
        seed : int
            Of the random numbers, 0 or more.
        on_done : callable
            As of `run`.
        """
        self.seed = seed if count else None
        if seed < 0:
            raise QuestionError(Problem(f"a seed of {seed}", "random numbers begin at 0 or more", "give 0 or more"))
        random = np.random.default_rng(seed)
        for _ in range(count):
            other = MotionRun(self.motion.with_random_phases(random), self.turns, self.samples)
            other.run(on_done)
            self.phase_statistics.append(other.statistics)

    def find_estimates(self, on_done: OnDone = _untold) -> None:
        """Make the cheap estimates, with their true error.

        Parameters
        ----------
        on_done : callable
            As of `run`.
        """
        from geartrain.dynamics.motion.superposition import find_estimates

        self.estimates = find_estimates(self.motion, self.turns, self.samples, on_done)

    def find_spectra(self, on_done: OnDone = _untold) -> None:
        """Make the spectra by exact order.

        Parameters
        ----------
        on_done : callable
            As of `run`.
        """
        self.spectra = find_spectrum(self.motion, self.turns, self.samples, on_done=on_done)

    @property
    def _position_columns(self) -> list[str]:
        """Names of the columns of a table of all positions."""
        names = self.motion.outputs
        return ["turns", *(f"{name} {what}" for name in names for what in ("angle (rad)", "error (rad)", "speed"))]

    def _values(self, passage: ErrorSamples) -> list[Floats]:
        """The columns of one stretch: an angle is its start, mean motion and error; a speed is over the input's.

        Parameters
        ----------
        passage : ErrorSamples
            The stretch.

        Returns
        -------
        list of array of float, (n,)
            As `_position_columns` names them.
        """
        found = [passage.turns]
        angle = 2 * pi * passage.turns
        for at, (tally, start) in enumerate(zip(self.motion._statistics(), self.motion._start_angles, strict=True)):
            error = passage.error[at]
            found += [start + tally.mean * angle + error, error, tally.mean + passage.rate[at]]
        return found

    def _check_resumed(self, row: str, rows: int) -> None:
        """Refuse to go on with a table whose last row is not of this run.

        Parameters
        ----------
        row : str
            The last row, its cells parted by commas.
        rows : int
            How many there are.

        Raises
        ------
        GearTrainError
            If this run has other turns there, or fewer positions.
        """
        # the operations of `_stretches` in their order: the same float, and so the same text
        turns = self.turns * ((rows - 1) / (self.samples - 1))
        if rows > self.samples or row.split(",")[0] != repr(turns):
            what = f"its row {rows} stands at {row.split(',')[0]} turns, and this run has {turns!r} there"
            raise GearTrainError(
                Problem("the partial file is of another run", what, "give the same turns and samples, or begin again")
            )
