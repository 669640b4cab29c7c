"""The spectrum of an output's angle in time, its lines named by the pairs whose teeth pass so often."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from geartrain.simulation.time.run_parts import SpectrumPeak

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_MOST = 12  # lines
_HARMONICS = 24  # of each pair
_NARROW = 1.0  # bins by which a line may miss a harmonic


def find_peaks(time: Floats, angle: Floats, rate: float, cycles: Mapping[str, float]) -> list[SpectrumPeak]:
    """The strongest lines, under a Hann window.

    time     evenly spaced (s); `angle` (rad), whose mean motion is taken off
    rate     turns of the lead a second
    cycles   periods of each pair in a turn of the lead
    """
    frequencies, size = find_amplitudes(time, angle)
    if not len(size):
        return []
    bin_width = float(frequencies[1])
    top = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    strongest = top[np.argsort(-size[top])][:_MOST]
    found = []
    for at in strongest:
        # a parabola through the logarithms of three bins: where between them the line is
        left, middle, right = np.log(size[at - 1 : at + 2] + 1e-300)
        shift = (left - right) / 2 / (left - 2 * middle + right)
        frequency = float((at + shift) * bin_width)
        order = frequency / rate
        found.append(SpectrumPeak(order, frequency, float(size[at]), _source(order, bin_width / rate, cycles)))
    return found


def find_amplitudes(time: Floats, angle: Floats) -> tuple[Floats, Floats]:
    """Frequencies (Hz) and amplitudes (rad) under a Hann window, mean motion taken off; empty for too few samples."""
    if len(time) < 16:
        return np.zeros(0), np.zeros(0)
    swing = angle - np.polyval(np.polyfit(time - time[0], angle, 1), time - time[0])
    window = np.hanning(len(swing))
    size = np.abs(np.fft.rfft(swing * window)) * 2 / window.sum()
    return np.arange(len(size)) / (len(swing) * (time[1] - time[0])), size


def _source(order: float, width: float, cycles: Mapping[str, float]) -> str:
    """The lowest harmonic within reach."""
    near = [
        (harmonic, name)
        for name, own in cycles.items()
        if own
        for harmonic in range(1, _HARMONICS + 1)
        if abs(order - harmonic * own) <= _NARROW * width
    ]
    return "{1} x{0}".format(*min(near)) if near else ""
