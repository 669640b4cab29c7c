"""Results of a run: times in contact, energies, outputs, spectra, and the comparison of two time steps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import repeat
from math import sqrt, tau
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.numerics.labelled_array import labelled_array
from geartrain.simulation.steps.contact_solution import (
    BEARINGS,
    CHANGES,
    FRICTION,
    GAP,
    IMPACT_COUNT,
    IMPACT_ENERGY,
    IMPACT_LOSS,
    IMPACT_SPEED,
    IMPACTS,
    IMPULSE,
    RUBBED,
    STEP,
    TIME_APART,
    TIME_COAST,
    UNSOLVED,
    VISCOUS,
    WORK_DRIVE,
    WORK_SPRING,
    WORK_TORQUE,
)
from geartrain.simulation.time.time_run import (
    ContactInTime,
    ConvergedFigure,
    EnergyAccount,
    ImpactList,
    OutputDeviation,
    SpectrumPeak,
    TimeRun,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.train_model import TrainModel
    from geartrain.simulation.steps.simulation import SimulatedRun, StepPlan


FEWEST = 5
"""Minimum number of batches that is required for a confidence interval."""

_CONFIDENCE = 0.95
_CORRELATED = 0.9  # maximum lag-1 correlation: beyond it the batches are too short for an interval
_MOST = 12  # maximum number of lines
_HARMONICS = 24  # harmonics of each pair
_NARROW = 1.0  # tolerance between a line and a harmonic [bins]
_AGREE = {"mean": 0.05, "extreme": 0.01}  # relative tolerance of the convergence of a figure
_SHARE, _ANGLE = 0.005, 1e-6  # absolute tolerances of a fraction of time, and of an angle [rad]
_Figure = tuple[str, str, float, Literal["mean", "extreme"]]


@dataclass(frozen=True)
class RunFigures:
    """Results of one run for the requested outputs, computed from its samples, contact times and energies."""

    of: TrainModel
    outputs: Sequence[tuple[str, str, str]]
    run: SimulatedRun
    static_peaks: Sequence[float | None]
    """Maximum quasi-static torque of each pair with compliant teeth [N m]; None if it is unknown."""

    @property
    def plan(self) -> StepPlan:
        """Time steps of the run."""
        return self.run.plan

    @cached_property
    def duration(self) -> float:
        """Duration of the evaluated part of the run [s]."""
        return self.plan.step * self.plan.steps

    @cached_property
    def first(self) -> int:
        """Index of the first sample in the evaluated part of the run."""
        return self.plan.skip // self.plan.stride

    @cached_property
    def time(self) -> Floats:
        """Times of the samples [s]."""
        return np.asarray(self.plan.step * self.plan.stride * np.arange(1, len(self.run.angles) + 1), dtype=np.float64)

    @cached_property
    def turned(self) -> Floats:
        """Angles through which all links have turned since the start [rad], shape (links, samples)."""
        # angles of links are the same linear forms of the coordinates as speeds
        found: Floats = self.of.speeds @ self.run.angles.T
        return found

    @cached_property
    def turns(self) -> Floats:
        """Revolutions of the driving link at the samples, positive in its sense of rotation."""
        turned = self.turned[self.of.index[self.of.problem.driving_link]] / tau
        return np.asarray(self.of.problem.way * turned, dtype=np.float64)

    @cached_property
    def names(self) -> list[str]:
        """Names of pairs and pins, followed by names of links with an escapement, in the order used by the kernels."""
        return [pair.name for pair in self.of.model.pairs] + [stop.name for stop in self.of.model.stops]

    @cached_property
    def contacts(self) -> tuple[ContactInTime, ...]:
        """Results of each pair, pin and escapement in the evaluated part of the run."""
        steps, time = self.plan.steps, self.duration
        peaks: Iterable[tuple[float | None, float | None]] = repeat((None, None), len(self.names))
        if self.run.peaks is not None:
            peaks = zip(self.run.peaks.tolist(), self.static_peaks, strict=True)
        return tuple(
            ContactInTime(
                name,
                float(counts[TIME_APART] / steps),
                float(counts[TIME_COAST] / steps),
                float(counts[IMPACT_COUNT] / time),
                float(counts[IMPACT_ENERGY] / time),
                float(counts[IMPACT_SPEED]),
                float(counts[IMPULSE] / time),
                float(counts[RUBBED] / time),
                float(counts[GAP]),
                float(counts[CHANGES] / time),
                peak,
                peak / static if peak is not None and static else None,
            )
            for name, counts, (peak, static) in zip(self.names, self.run.counts, peaks, strict=True)
        )

    @cached_property
    def energy(self) -> EnergyAccount:
        """Energy balance of the evaluated part of the run."""
        energy = self.run.energy
        return EnergyAccount(
            drive=float(energy[WORK_DRIVE]),
            loads=float(energy[WORK_TORQUE]),
            springs=float(energy[WORK_SPRING]),
            bearings=float(energy[BEARINGS]),
            drag=float(energy[VISCOUS]),
            friction=float(energy[FRICTION]),
            impact_loss=float(energy[IMPACT_LOSS]),
            steps=float(energy[STEP]),
            kinetic=self.run.end - self.run.start,
            stored=self.run.end,
            elastic=self.run.pressed,
        )

    @cached_property
    def drive(self) -> Floats:
        """Torque at the power input [N m], positive in the sense of rotation of the link on which it acts."""
        source = self.of.case.drive
        way = -1.0 if self.of.typical(source.link) < 0 else 1.0
        # a prescribed speed needs the constraint torque of the run
        if source.kind == "rate":
            return np.asarray(way * self.run.drive[:, self.of.coordinates.index(source.link)])
        if source.kind == "torque":
            return np.full(len(self.time), way * source.torque)
        rest = source.wound + source.rate * self.time
        return np.asarray(way * source.stiffness * (rest - self.turned[self.of.index[source.link]]))

    @cached_property
    def torque(self) -> float:
        """Mean torque at the power input [N m]."""
        source, energy = self.of.case.drive, self.energy
        if source.kind == "torque":
            return float(abs(source.torque))
        angle = abs(float(self.of.speeds[self.of.index[source.link]] @ self.run.turned))
        work = energy.drive if source.kind == "rate" else energy.springs
        others = {link: speed for link, speed in self.of.prescribed.items() if link != source.link and speed}
        # samples inside the counted part
        begin, end = (self.plan.step * each for each in (self.plan.skip, self.plan.skip + self.plan.steps))
        counted = self.run.drive[(self.time > begin) & (self.time < end + self.plan.step / 2)]
        if source.kind == "rate" and len(counted):
            # other prescribed links do work, too: their mean torques times their angles
            torques = counted.mean(axis=0)
            for link, speed in others.items():
                work -= float(torques[self.of.coordinates.index(link)]) * speed * self.duration
        return work / angle if angle else 0.0

    @cached_property
    def differences(self) -> dict[str, Floats]:
        """Angle by which each output is ahead of the motion with all drive flanks in contact [rad], keyed by output."""
        motion, turns, forwards = self.of.motion, self.turns, self.of.problem.way
        names = list(motion.outputs)
        at = motion.at(np.append(turns, 0.0)).error if motion._forward.used else np.zeros((len(names), len(turns) + 1))
        found = {}
        for name, link, base in self.outputs:
            parts = []
            for each in (link, base):
                row = names.index(each)
                mean = float(self.of.problem.ratio(each)) * tau * turns
                # the last column is position 0, from which angles are counted
                touching = mean + at[row, :-1] - at[row, -1]
                parts.append(self.turned[self.of.index[each]] - forwards * touching)
            sense = self.of.sense(link, base)
            # positive in the output's own sense of rotation
            way = -1.0 if self.of.typical(link) - sense * self.of.typical(base) < 0 else 1.0
            found[name] = way * (parts[0] - sense * parts[1])
        return found

    @cached_property
    def deviations(self) -> tuple[OutputDeviation, ...]:
        """Maximum and rms deviations of each output from the motion with all drive flanks in contact."""
        counted = {name: each[self.first :] for name, each in self.differences.items()}
        return tuple(
            OutputDeviation(
                name,
                float(max(each.max(initial=0.0), 0.0)),
                float(max(-each.min(initial=0.0), 0.0)),
                float(np.sqrt(np.mean(each**2))) if len(each) else 0.0,
            )
            for name, each in counted.items()
        )

    def means(self) -> Iterator[_Figure]:
        """Yield the name, the unit and the value of each mean result of the simulation, and the word "mean"."""
        yield "torque of the drive", "N m", self.torque, "mean"
        yield "impact power", "W", self.energy.impact_loss / self.duration, "mean"
        for each in self.contacts:
            yield f"{each.name} apart", "", each.apart, "mean"
            yield f"{each.name} on the coast flank", "", each.coast, "mean"

    def intervals(self) -> list[float | None]:
        """Return the half-width of the 95 % confidence interval of each mean; each is None if the simulation is too
        short.
        """
        blocks = [[each[2] for each in replace(self, run=part).means()] for part in self.run.blocks]
        return [batch_half_width(np.array(each)) for each in zip(*blocks, strict=True)]

    def extremes(self) -> Iterator[_Figure]:
        """Yield the name, the unit and the value of each maximum of the simulation, and the word "extreme"."""
        for each in self.contacts:
            if each.impact_rate:
                yield f"{each.name} hardest impact", "rad/s", each.hardest, "extreme"
            if each.peak is not None:
                yield f"{each.name} peak torque", "N m", each.peak, "extreme"
        for deviation in self.deviations:
            yield f"{deviation.output} ahead", "rad", deviation.ahead, "extreme"
            yield f"{deviation.output} behind", "rad", deviation.behind, "extreme"

    @cached_property
    def gaps(self) -> tuple[Floats, Floats]:
        """Gaps from the driven side of each pair to the drive flank and to the coast flank [rad], two arrays of shape
        (pairs, samples).
        """
        angles, found = self.run.angles, np.zeros((2, len(self.of.model.pairs), len(self.time)))
        for row, pair in enumerate(self.of.model.pairs):
            S, q = (
                start + angles[:, list(form)] @ np.array([*form.values()], dtype=np.float64)
                for start, form in zip(pair.start, (pair.driver, pair.driven), strict=True)
            )
            found[0, row] = q - pair.front(S)
            found[1, row] = pair.back(S) - q
        return found[0], found[1]

    def result(self, coarse: RunFigures | None) -> TimeRun:
        """Return the results of this run, compared with the run `coarse` of longer time steps unless it is None."""
        links, time = self.of.problem.system.links, [repr(float(each)) for each in self.time]
        start = np.array([self.of.problem.angles.get(link, 0.0) for link in links])[:, None]
        pairs = self.names[: len(self.of.model.pairs)]
        outputs = [name for name, _, _ in self.outputs]
        rate = abs(self.of.case.rate) / tau
        cycles = {source.id: float(source.cycles) for source in self.of.sources.values()}
        cycles |= {f"beat of {link}": 1 / (rate * beat) for link, (_, beat) in self.of.case.escapements.items()}
        counted = {name: self.angle_of(name)[self.first :] for name in outputs}
        return TimeRun(
            self.of.train.name,
            self.of.state,
            self.of.problem.driving_link,
            float(self.of.speeds[self.of.index[self.of.problem.driving_link]] @ self.run.turned) / self.duration,
            self.of.case.drive.link,
            self.of.case.drive.kind,
            self.plan.step,
            self.plan.step * self.plan.skip,
            self.duration,
            _frozen(self.time),
            _frozen(self.turns),
            labelled_array(start + self.turned, link=links, time=time),
            labelled_array(self.of.speeds @ self.run.speeds.T, link=links, time=time),
            labelled_array(np.ascontiguousarray(self.run.forces.T), contact=self.names, time=time),
            labelled_array(self.gaps[0], pair=pairs, time=time),
            labelled_array(self.gaps[1], pair=pairs, time=time),
            labelled_array(np.array([self.angle_of(name) for name in outputs]), output=outputs, time=time),
            labelled_array(np.array([self.differences[name] for name in outputs]), output=outputs, time=time),
            _frozen(self.drive),
            self.torque,
            self.contacts,
            self._impacts(),
            self.energy,
            self.deviations,
            {name: tuple(find_peaks(self.time[self.first :], counted[name], rate, cycles)) for name in outputs},
            () if coarse is None else tuple(self._compared(coarse)),
            self.run.numbers[UNSOLVED],
            self.of.notes,
            coarse is not None,
            "rigid" if self.of.yields is None else "compliant",
            self.of.assumed,
            max((self.of.case.restitution.get(name, 0.0) for name in self.names), default=0.0),
        )

    def _compared(self, coarse: RunFigures) -> Iterator[ConvergedFigure]:
        """Yield each result together with its value from the run `coarse`, which has longer time steps."""
        # a contact may have impacts in only one of the runs
        coarse_extremes = {each[0]: each for each in coarse.extremes()}
        rows = [*zip(coarse.means(), self.means(), self.intervals() or repeat(None), strict=False)]
        rows += [(coarse_extremes.get(each[0], (*each[:2], 0.0, each[3])), each, None) for each in self.extremes()]
        for one, other, interval in rows:
            name, unit, value, kind = other
            yield ConvergedFigure(name, unit, one[2], value, kind, _converged(one, other, interval), interval)

    def _impacts(self) -> ImpactList:
        time, which, speed, energy, impulse = (_frozen(each) for each in self.run.impacts.T.copy())
        names = tuple(self.names[int(each)] for each in which)
        return ImpactList(self.run.numbers[IMPACTS], names, time, speed, energy, impulse)

    def angle_of(self, name: str) -> Floats:
        """Return the angle through which the output `name` has turned at each sample [rad]."""
        link, base = next(each[1:] for each in self.outputs if each[0] == name)
        found: Floats = self.turned[self.of.index[link]] - self.of.sense(link, base) * self.turned[self.of.index[base]]
        return found


def _converged(one: _Figure, other: _Figure, interval: float | None) -> bool:
    _, unit, value, kind = one
    # fractions of time have an absolute tolerance
    share = _AGREE[kind] * max(abs(value), abs(other[2])) if unit else _SHARE
    near = max(share, _ANGLE if unit == "rad" else 0.0)
    return bool(max(abs(value - other[2]), interval or 0.0) <= near)


def _frozen(values: Floats) -> Floats:
    values = np.asarray(values)
    values.flags.writeable = False
    return values


# ------------------------------------------------------------------------------------ confidence intervals: batch means


def batch_half_width(means: Floats) -> float | None:
    """Return the half-width of the 95 % confidence interval of a mean, computed from the means of n equal consecutive
    batches, shape (n,). Return None if there are too few batches.

    The interval is Student's t with n - 1 degrees of freedom, widened by sqrt((1 + r)/(1 - r)) for the lag-1
    correlation r of the batches, whose estimate is 1/n too low on average (Law and Kelton, Simulation Modeling and
    Analysis, section 9.5).
    """
    from scipy.special import stdtrit

    n = len(means)
    if n < FEWEST:
        return None
    off = means - means.mean()
    squares = float(off @ off)
    if not squares:
        return 0.0
    # 1/n corrects the bias of the estimated correlation
    lag = min(max(float(off[1:] @ off[:-1]) / squares + 1 / n, 0.0), _CORRELATED)
    wide = float(stdtrit(n - 1, (1 + _CONFIDENCE) / 2)) * sqrt(squares / (n - 1) / n)
    return wide * sqrt((1 + lag) / (1 - lag))


# ------------------------------------------------------------------------------------------------ spectrum of an output


def find_peaks(time: Floats, angle: Floats, rate: float, cycles: Mapping[str, float]) -> list[SpectrumPeak]:
    """Return the strongest lines in the spectrum of an angle, computed with a Hann window.

    time     evenly spaced times [s] of the angles `angle` [rad], whose mean motion is removed
    rate     revolutions of the driving link per second
    cycles   number of periods of each pair per revolution of the driving link, by pair
    """
    frequencies, size = find_amplitudes(time, angle)
    if not len(size):
        return []
    bin_width = float(frequencies[1])
    top = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    strongest = top[np.argsort(-size[top])][:_MOST]
    found = []
    for at in strongest:
        # a parabola through the logarithms of three bins locates the line between them
        # the small number avoids log 0 in an empty bin
        left, middle, right = np.log(size[at - 1 : at + 2] + 1e-300)
        shift = (left - right) / 2 / (left - 2 * middle + right)
        frequency = float((at + shift) * bin_width)
        order = frequency / rate
        found.append(SpectrumPeak(order, frequency, float(size[at]), _source(order, bin_width / rate, cycles)))
    return found


def find_amplitudes(time: Floats, angle: Floats) -> tuple[Floats, Floats]:
    """Return the frequencies [Hz] and the amplitudes [rad] of the spectrum of an angle, with a Hann window and without
    the mean motion.

    Both arrays are empty if there are too few samples.
    """
    if len(time) < 16:
        return np.zeros(0), np.zeros(0)
    # a linear fit removes the mean motion, whose leakage would hide the lines
    swing = angle - np.polyval(np.polyfit(time - time[0], angle, 1), time - time[0])
    window = np.hanning(len(swing))
    # amplitude: both halves of the spectrum, divided by the gain of the window
    size = np.abs(np.fft.rfft(swing * window)) * 2 / window.sum()
    return np.arange(len(size)) / (len(swing) * (time[1] - time[0])), size


def _source(order: float, width: float, cycles: Mapping[str, float]) -> str:
    """Return the pair and its lowest harmonic, such as "c2~d1 x1", that lies within `width` of a vibration order, which
    it may cause; "" if there is none.
    """
    near = [
        (harmonic, name)
        for name, own in cycles.items()
        if own
        for harmonic in range(1, _HARMONICS + 1)
        if abs(order - harmonic * own) <= _NARROW * width
    ]
    return "{1} x{0}".format(*min(near)) if near else ""
