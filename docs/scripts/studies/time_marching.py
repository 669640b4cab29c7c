"""Marching in time, as a general multibody program follows a train: the named alternative to composition."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from itertools import accumulate
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain import GearTrain
from geartrain.dynamics import Motion
from geartrain.dynamics.motion.error_composition import PairErrorSource
from geartrain.teeth import TransmissionFunction
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

Floats = NDArray[np.float64]


class Marching:
    """All links advanced in time, as a general multibody program does: no solved order, no law in closed form.

    At each stage every pair says its instantaneous ratio at the angles reached so far, and one linear system gives all
    speeds. The ratios come for free from the laws' own formulas, and so do the angles of the start.
    """

    def __init__(self, train: GearTrain, outputs: Sequence[str]) -> None:
        motion, whole = train.motion(outputs=outputs), train.motion(outputs=list(train.declaration.links))
        moving = self.moving = motion._problem
        names = moving.system.links
        at = {link: number for number, link in enumerate(names)}
        lead = float(moving.speeds[moving.driving_link])
        self.matrix = np.zeros((len(names), len(names)))
        self.right = np.array([float(row.right) / lead for row in moving.system.equations])
        row_of = {}
        for number, row in enumerate(moving.system.equations):
            row_of[row.label] = number
            for link, coefficient in row.terms:
                self.matrix[number, at[link]] = float(coefficient)
        self.pairs = [self._pair(motion, source, row_of[source.id]) for source in motion._forward.sources]
        self.ends = [(at[of], at[base]) for of, base in motion.outputs.values()]
        self.means = np.array([tally.mean for tally in motion._statistics()])
        start = whole._unset.at(np.zeros(1)).error[:, 0]
        self.start = np.zeros(len(names))
        self.start[[at[link] for link in train.declaration.links]] = start

    @staticmethod
    def _pair(motion: Motion, source: PairErrorSource, row: int) -> Marched:
        joint = motion._propagation.joints[source.pair]
        own, carried = source.forward * source.driver_sense, source.forward * source.carrier_sense
        ratio, scale = float(source.transmission.ratio), joint.coefficient * source.sense
        return Marched(
            _speed_of(source.transmission), ratio, source.start, joint.driver, joint.carrier, own, carried, row, scale
        )

    def speeds(self, angle: Floats) -> Floats:
        """Speeds of all links over the input's, at angles (rad) of all links."""
        matrix = self.matrix.copy()
        for pair in self.pairs:
            S = pair.own * angle[pair.driver] - pair.carried * angle[pair.carrier] + pair.start
            ahead = pair.scale * (pair.speed(float(S)) - pair.ratio)
            matrix[pair.row, pair.driver] -= ahead * pair.own
            matrix[pair.row, pair.carrier] += ahead * pair.carried
        return np.linalg.solve(matrix, self.right)

    def follow(self, turns: Floats, steps: int) -> Floats:
        """Errors (rad) of the outputs at equidistant turns from 0, with so many steps to each; 0 leaves it to RK45."""
        time = 2 * np.pi * turns
        angles = self._adaptive(time) if steps == 0 else self._fixed(time, steps)
        found = [angles[:, of] - angles[:, base] for of, base in self.ends]
        return np.array(found) - self.means[:, None] * time

    def _fixed(self, time: Floats, steps: int) -> Floats:
        """The classical method of Runge and Kutta."""
        angle, found = self.start, [self.start]
        h = (time[1] - time[0]) / steps
        for _ in range(len(time) - 1):
            for _ in range(steps):
                a = self.speeds(angle)
                b = self.speeds(angle + h / 2 * a)
                c = self.speeds(angle + h / 2 * b)
                d = self.speeds(angle + h * c)
                angle = angle + h / 6 * (a + 2 * b + 2 * c + d)
            found.append(angle)
        return np.array(found)

    def _adaptive(self, time: Floats) -> Floats:
        from scipy.integrate import solve_ivp

        ends = (float(time[0]), float(time[-1]))
        solved = solve_ivp(lambda _, angle: self.speeds(angle), ends, self.start, t_eval=time, rtol=1e-9, atol=1e-12)
        return np.asarray(solved.y.T)


class Marched(NamedTuple):
    """A pair as marching sees it: where its driver and carrier stand among the links, its row, and its ratio."""

    speed: Callable[[float], float]
    ratio: float
    start: float
    driver: int
    carrier: int
    own: int
    carried: int
    row: int
    scale: int


def _speed_of(transmission: TransmissionFunction) -> Callable[[float], float]:
    """dq/dS at one angle, in plain floats: arrays of one element would cost ten times as much."""
    if isinstance(transmission, TriangularTransmission):
        return _Path(transmission).speed
    return lambda S: float(transmission.speed(S))


class _Path:
    """Triangular teeth in plain floats: which stretch of the path an angle falls in, and its formula."""

    def __init__(self, transmission: TriangularTransmission) -> None:
        self.intervals, self.period, self.tooth_pair = (
            transmission.intervals,
            transmission.period,
            transmission.contact.path.tooth_pair,
        )
        self.edges = [0.0, *accumulate(interval.width for interval in transmission.intervals)]
        first = transmission.intervals[0]
        self.first = first.start - first.tooth_pair * transmission.period

    def speed(self, S: float) -> float:
        """dq/dS at S (rad)."""
        gone = (S + self.first) % self.period
        at = min(bisect_right(self.edges, gone), len(self.intervals)) - 1
        interval = self.intervals[at]
        if interval.held is not None:
            return 0.0
        return float(self.tooth_pair.speed(interval.phase, interval.start - (gone - self.edges[at]), math))
