"""Plot of a time-domain simulation: gaps between teeth with impacts, deviations of outputs, and their spectra."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from math import degrees, tau
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.style import (
    BLUE,
    FINE,
    PALE,
    RED,
    SMALL,
    Axes,
    Figure,
    curve_panels,
    headed,
    kept_extremes,
    legend_above,
    name_axes,
    series_look,
    short,
    write,
)
from geartrain.errors import Problem, QuestionError
from geartrain.simulation.time.run_figures import find_amplitudes

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.time.time_run import SpectrumPeak, TimeRun

_PAIRS = 6  # maximum number of pairs whose gaps are drawn
_STRETCH = 720  # samples of the interval in which gaps are drawn, about 60 teeth of the fastest pair
_MOST = 4000  # maximum number of points of a curve: first, minimum and maximum of each interval
_OUTPUTS = 4
"""Maximum number of outputs in the plot. Outputs with the smallest deviations are omitted."""
_OPEN = 1e-7  # smaller gaps count as contact [rad]
_SEEN = 1e-8  # smaller deviations count as 0 [rad]
_SMALL = 0.1  # fraction of the backlash below which gaps get a larger scale
_FLAT = 1e-3  # outputs with smaller deviations are not drawn [deg]
_NAMES = 8  # maximum number of labelled lines of a spectrum
_DEEPEST = 3e-5  # lower limit of the axis, relative to the maximum amplitude
_DECADES = 40.0  # maximum ratio of the limits of an axis with labels between powers of ten
_CLEAR = 1.09  # minimum ratio of two labelled frequencies
_name = partial(name_axes, size=SMALL, parse_math=False)


def time_run_figure(run: TimeRun, title: str = "") -> Figure:
    """Plot the gaps and impacts of pairs in an interval of the run, and the deviations and spectra of the outputs."""
    # contacts that are not pairs are escapements
    pairs, stops = _loose(run), [each.name for each in run.contacts if each.name not in run.gaps.labels[0]]
    moving = _moving(run)
    leading = [each.output for each in run.deviations if degrees(max(each.ahead, each.behind)) > _FLAT]
    tall = [1.25] * (len(pairs) + len(stops)) + [1.875] * bool(leading) + [2.5] * bool(moving)
    if not tall:
        what = f"the plot of '{run.train}' would be empty"
        why = "no pair has backlash, and no output deviates from its mean motion"
        raise QuestionError(Problem(what, why, "declare tooth forms with backlash, or an escapement"))
    figure, panels = curve_panels(tall, 0.9, share=False)
    if moving:
        _spectrum(panels.pop(), run, moving)
    if leading:
        _ahead(panels.pop(), run, [name for name in moving if name in leading])
    stretch = _stretch(run, pairs)
    for panel, pair in zip(panels, pairs, strict=False):
        _gap(panel, run, pair, stretch)
    for panel, stop in zip(panels[len(pairs) :], stops, strict=True):
        _speed(panel, run, stop, stretch)
    for panel in panels[:-1]:
        panel.tick_params(labelbottom=False)
    if panels:
        _name(panels[-1], _across_text(run))
        panels[0].scatter([], [], s=24, c=RED, marker="^", label="impact")
        if pairs:
            panels[0].fill_between([], [], [], color=PALE, alpha=0.6, label="coast flank")
        legend_above(panels[0], 2)
    return headed(figure, title)


def _across(run: TimeRun) -> Floats:
    """Return the values on the horizontal axis: revolutions of an input of prescribed speed, or time [s]."""
    return run.turns if run.driven == "rate" else run.time


def _across_text(run: TimeRun) -> str:
    return f"turns of {short(run.driving_link)}" if run.driven == "rate" else "time (s)"


def _loose(run: TimeRun) -> list[str]:
    """Return the names of the pairs whose gaps are drawn, in the order of declaration: of the pairs with backlash, the
    `_PAIRS` pairs that are out of contact for the longest time.
    """
    names = [
        name
        for row, name in enumerate(run.gaps.labels[0])
        if float(np.max(run.gaps.values[row] + run.coast_gaps.values[row], initial=0.0)) > _OPEN
    ]
    apart = {each.name: (each.apart, each.gap) for each in run.contacts}
    most = sorted(names, key=lambda name: apart[name], reverse=True)[:_PAIRS]
    return [name for name in names if name in most]


def _moving(run: TimeRun) -> list[str]:
    """Return the outputs that do not turn uniformly, at most `_OUTPUTS`, by descending deviation."""
    deviation = {each.output: max(each.ahead, each.behind) for each in run.deviations}
    swing = {name: max((peak.amplitude for peak in run.spectra[name]), default=0.0) for name in deviation}
    names = [name for name in deviation if max(deviation[name], swing[name]) > _SEEN]
    return sorted(names, key=lambda name: (deviation[name], swing[name]), reverse=True)[:_OUTPUTS]


def _stretch(run: TimeRun, pairs: list[str]) -> slice:
    """Return the range of samples in which gaps are drawn: `_STRETCH` samples, centred on the maximum gap."""
    whole = len(run.time)
    first = int(np.searchsorted(run.time, run.skip))
    middle = whole
    if pairs:
        open_ = np.max([np.minimum(run.gaps[pair], run.coast_gaps[pair])[first:] for pair in pairs], axis=0)
        if len(open_) and open_.max() > _OPEN:
            # centred on the maximum gap
            middle = first + int(open_.argmax())
    end = min(max(middle + _STRETCH // 2, first + _STRETCH), whole)
    return slice(max(first, end - _STRETCH), end)


def _gap(panel: Axes, run: TimeRun, pair: str, stretch: slice) -> None:
    """Plot the gap at the drive flank of a pair, with the coast flank as a band and marks of impacts."""
    at, front = _across(run)[stretch], np.degrees(run.gaps[pair][stretch])
    back = front + np.degrees(run.coast_gaps[pair][stretch])
    panel.fill_between(at, back, 1.06 * back.max(), color=PALE, alpha=0.6, linewidth=0, gid=f"coast flank {pair}")
    panel.plot(at, front, color=BLUE, linewidth=1.0, gid=f"gap {pair}")
    _impacts(panel, run, pair, stretch)
    top = 1.06 * back.max()
    if _FLAT < front.max() < _SMALL * back.min():
        top = 1.3 * front.max()  # the coast flank is outside of the panel
    panel.set_ylim(-0.12 * top, top)
    panel.set_xlim(at[0], at[-1])
    apart = next(each.apart for each in run.contacts if each.name == pair)
    words = f"{short(pair)}: apart {100 * apart:.3g} % of the time; coast flank from {back.min():.3g} deg"
    _name(panel, y="gap (deg)", title=words)


def _speed(panel: Axes, run: TimeRun, stop: str, stretch: slice) -> None:
    """Plot the speed of an escape wheel between its beats."""
    at = _across(run)[stretch]
    panel.plot(at, run.speeds[stop][stretch], color=BLUE, linewidth=1.0)
    _impacts(panel, run, stop, stretch)
    panel.set_xlim(at[0], at[-1])
    _name(panel, y="speed (rad/s)", title=f"{short(stop)}: speed between the beats of the escapement")


def _impacts(panel: Axes, run: TimeRun, contact: str, stretch: slice) -> None:
    """Mark the impacts of a contact at the lower edge of a panel, by marks that grow with their energy."""
    own = np.array([name == contact for name in run.impacts.contact], dtype=bool)
    if not own.any():
        return
    across = _across(run)
    # impacts lie between samples
    at = np.interp(run.impacts.time[own], run.time, across)
    energy = run.impacts.energy[own]
    near = (at >= across[stretch.start]) & (at <= across[stretch.stop - 1]) & (energy > 0)
    if near.any():
        # matplotlib's size is an area, so the area of a marker grows with the energy
        size, y = 4 + 36 * energy[near] / energy.max(), np.full(near.sum(), 0.05)
        foot = panel.get_xaxis_transform()
        panel.scatter(at[near], y, s=size, c=RED, marker="^", transform=foot, linewidths=0, zorder=4, clip_on=False)


def _ahead(panel: Axes, run: TimeRun, moving: list[str]) -> None:
    first = int(np.searchsorted(run.time, run.skip))
    across = _across(run)
    for place, name in enumerate(moving):
        angle = np.degrees(run.ahead[name][first:])
        kept = kept_extremes(angle, _MOST)
        panel.plot(across[first:][kept], angle[kept], linewidth=0.8, **series_look(place), label=short(name))
    if first < len(across):
        panel.set_xlim(across[first], across[-1])
    legend_above(panel, 4)
    _name(panel, _across_text(run), "ahead (deg)", "outputs: ahead of the motion with touching teeth")


def _spectrum(panel: Axes, run: TimeRun, moving: list[str]) -> None:
    first = int(np.searchsorted(run.time, run.skip))
    drawn = []
    for place, name in enumerate(moving):
        frequency, size = find_amplitudes(run.time[first:], run.outputs[name][first:])
        drawn.append(np.array([frequency[1:], np.degrees(size[1:])]))
        panel.plot(*drawn[-1], linewidth=0.8, **series_look(place), label=short(name))
    # all outputs share one axis
    top = max(float(size.max(initial=0.0)) for _, size in drawn)
    if top:
        legend_above(panel, 4)
        panel.set_yscale("log")
        panel.set_ylim(_DEEPEST * top, 60 * top)
        panel.set_xscale("log")
        panel.xaxis.set_major_formatter(lambda at, _: f"{at:g}")
        low, high = max(float(drawn[-1][0, 0]), abs(run.rate) / tau / 2), float(drawn[-1][0, -1])
        panel.set_xlim(low, high)
        # an axis of few decades needs labels between the powers of ten, such as 20, 30 and 50
        few = high < _DECADES * low
        panel.xaxis.set_minor_formatter(lambda at, _: f"{at:g}" if few and f"{at:e}"[0] in "235" else "")
        for at, amplitude, source in _named(run.spectra[moving[0]]):
            over = max(float(size[abs(heard / at - 1) < _CLEAR - 1].max(initial=0.0)) for heard, size in drawn)
            if low < at < high and amplitude > _DEEPEST * top:
                write(panel, at, 1.4 * over, source, rotation=60, ha="left", va="bottom", fontsize=FINE)
    _name(panel, "frequency (Hz)", "amplitude (deg)", f"spectrum; lines of {short(moving[0])} are labelled")


def _named(peaks: Sequence[SpectrumPeak]) -> Iterator[tuple[float, float, str]]:
    """Yield the frequency [Hz], amplitude [deg] and source of each spectral line to be labelled: up to `_NAMES` lines
    of known source, except lines with a frequency close to that of another labelled line.
    """
    taken: list[float] = []
    for peak in peaks:
        near = any(1 / _CLEAR < peak.frequency / each < _CLEAR for each in taken)
        if peak.source and not near and len(taken) < _NAMES:
            taken.append(peak.frequency)
            yield peak.frequency, float(np.degrees(peak.amplitude)), peak.source
