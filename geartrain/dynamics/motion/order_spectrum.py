"""The spectrum of an output's ripple by exact orders of the input: which pair contributes what.

Section 5 of docs/motion.md. A pair repeats `cycles` times in a turn of the input, a rational number known exactly, so
its harmonics fall on orders k cycles. To first order each line is the pair's own harmonic times the output's
sensitivity; the line that the composed motion really has there is measured beside it, by a Fourier sum under a Hann
window. What no line explains is the product of pairs that modulate each other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Floats

    Complex = NDArray[np.complex128]

_SAMPLES = 1 << 14  # of one period of a law
_HARMONICS = 24  # of each pair that are looked at
_FAINT = 1e-6  # of the strongest line


class HarmonicShare(NamedTuple):
    """A harmonic of a pair, and the amplitude (rad) it has in an output to first order."""

    pair: str
    harmonic: int
    amplitude: float


@dataclass(frozen=True)
class SpectrumLine(Result):
    """One line of the spectrum of an output's error, at an exact order of the input.

    Attributes
    ----------
    order : Fraction
        Periods per turn of the input.
    shares : tuple of HarmonicShare
        The pairs and harmonics that fall on this order, each with its amplitude to first order [rad].
    expected : float
        Amplitude to first order, all of them together in their phases [rad].
    measured : float
        Amplitude in the composed motion [rad].

    See Also
    --------
    MotionRun.spectra : where these stand, strongest first.
    """

    KEYS = (Key("order", to=float), Key("exact", "order"), "expected", "measured", Key("pairs", "shares"))

    order: Fraction
    shares: tuple[HarmonicShare, ...]
    expected: float
    measured: float


def find_spectrum(
    motion: Motion, turns: float, samples: int, most: int = 12, on_done: Callable[[int], None] = lambda _: None
) -> dict[str, list[SpectrumLine]]:
    """The strongest lines of every output, strongest first, measured over `samples` positions.

    Lines are told apart if they differ by two periods over the run; over whole common periods the measure is exact but
    for harmonics beyond half the sampling rate.
    """
    superposed = Superposition(motion.ahead if turns >= 0 else motion.back)
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
    error = source.sense * source.law.error(u * source.law.period + shift)
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
    for passage in motion.passages(turns, samples):
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
