"""Bearings that turn back within a turn, though their mean speed does not show it: interval bounds, equation (21).

docs/torques.md, section 13. To the mean speed of every link each uneven pair adds g (tau(S) - m) w: g its gain there,
tau its speed ratio at the angle S of its driver, m the mean of that, w the speed of its driver seen from the carrier.
Gains are exact, and w lies within bounds that widen from pair to pair; so a bearing named here may turn back, and one
not named does not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.load_case import LoadCase
from geartrain.numerics.elimination import LinearForm, eliminate
from geartrain.numerics.exact import as_float

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction

_MOST_UNEVEN = 300  # pairs followed: the gains of n pairs at n links are n squared numbers
_SAMPLES = 1 << 14  # angles at which a speed is averaged, for three digits
_SLACK = 1e-12  # of a speed: less than this backwards is rounding


@dataclass(frozen=True)
class SpeedBounds:
    """Least and greatest speed of a bearing.

    magnitude, most   mean and greatest of its magnitude, where one pair alone makes it uneven
    """

    low: float
    high: float
    magnitude: float | None = None
    most: float | None = None

    @property
    def turns_back(self) -> bool:
        """True if there are speeds of both signs between them."""
        return self.low < -_SLACK * abs(self.high) and self.high > _SLACK * abs(self.low)

    def plus(self, other: SpeedBounds) -> SpeedBounds:
        """Of the sum of two speeds."""
        return SpeedBounds(self.low + other.low, self.high + other.high)

    def times(self, other: SpeedBounds) -> SpeedBounds:
        """Of the product of two numbers."""
        ends = [_product(x, y) for x in (self.low, self.high) for y in (other.low, other.high)]
        return SpeedBounds(min(ends), max(ends))


@dataclass(frozen=True)
class _Uneven:
    """A pair whose speed ratio is not constant: its row has factor (tau - m) times the speed of its driver.

    law      None where it is not known: a pin without dimensions, teeth that cannot turn
    driver   seen from the carrier; `mean` is m
    """

    id: str
    law: TransmissionFunction | None
    driver: str
    carrier: str
    factor: Fraction
    mean: Fraction

    @property
    def swing(self) -> SpeedBounds:
        """Bounds of tau - m."""
        if self.law is None:
            return SpeedBounds(-inf, inf)
        low, high = self.law.speed_range()
        return SpeedBounds(low - float(self.mean), high - float(self.mean))


def find_reversing_bearings(setting: LoadCase, links: Sequence[str]) -> Mapping[str, SpeedBounds] | None:
    """The links among these that may turn back in their joints; None where there is too much to follow."""
    uneven = list(_uneven(setting))
    if len(uneven) > _MOST_UNEVEN:
        return None
    if not uneven or not links:
        return {}
    gains = _gains(setting, uneven)
    added = _added(setting, uneven, gains)
    found = {}
    for link in links:
        bounds = _bounds(setting, gains, added, link, setting.tree.parent[link][0])
        if bounds.turns_back:
            found[link] = _with_mean(setting, uneven, gains, link, bounds)
    return found


def _uneven(setting: LoadCase) -> Iterator[_Uneven]:
    for circuit in setting.circuits:
        if circuit.swings:
            joint = setting.joints.get(circuit.id)
            law = joint.law if joint else None
            yield _Uneven(circuit.id, law, circuit.j, circuit.carrier, Fraction(circuit.a), Fraction(-circuit.b))
            continue
        tooth = setting.meshes.get(circuit.id)
        if tooth is None or tooth.rigid:
            continue
        first = tooth.driver == circuit.wheels[0]
        driver, own = (circuit.i, circuit.a) if first else (circuit.j, circuit.b)
        mean = Fraction(tooth.law.ratio)
        yield _Uneven(circuit.id, tooth.law if tooth.verdict else None, driver, circuit.carrier, -own / mean, mean)


def _gains(setting: LoadCase, uneven: Sequence[_Uneven]) -> Mapping[str, Mapping[int, float]]:
    """What a unit of each pair's deviation, by number, adds to each link's speed; inputs keep theirs."""
    number = {each.id: at for at, each in enumerate(uneven)}
    system = setting.system
    column = {link: at for at, link in enumerate(system.links)}
    rows: list[LinearForm] = []
    for row in system.equations:
        form: LinearForm = {column[link]: Fraction(value) for link, value in row.terms}
        if row.kind not in ("input", "fixed", "lock", "frame") and row.label in number:
            form[-1 - number[row.label]] = -uneven[number[row.label]].factor
        rows.append(form)
    forms = eliminate(rows).forms()
    return {
        link: {-1 - key: setting.sense(link) * _number(value) for key, value in forms.get(at, {}).items() if key < 0}
        for link, at in column.items()
    }


def _between(gains: Mapping[str, Mapping[int, float]], link: str, carrier: str) -> dict[int, float]:
    """Gains at a link seen from another."""
    found = dict(gains[link])
    for number, gain in gains[carrier].items():
        found[number] = found.get(number, 0.0) - gain
    return {number: gain for number, gain in found.items() if gain}


def _bounds(
    setting: LoadCase, gains: Mapping[str, Mapping[int, float]], added: Sequence[SpeedBounds], link: str, carrier: str
) -> SpeedBounds:
    """Bounds of a link's speed seen from another."""
    mean = setting.relative(link, carrier)
    found = SpeedBounds(-inf, inf) if mean is None else SpeedBounds(_number(mean), _number(mean))
    for number, gain in _between(gains, link, carrier).items():
        found = found.plus(added[number].times(SpeedBounds(gain, gain)))
    return found


def _added(
    setting: LoadCase, uneven: Sequence[_Uneven], gains: Mapping[str, Mapping[int, float]]
) -> Sequence[SpeedBounds]:
    """Bounds of what each pair adds, its driver's speed being bounded by what the others add."""
    swings = [each.swing for each in uneven]
    added = [SpeedBounds(0.0, 0.0)] * len(uneven)
    # where no pairs depend on each other in a circle each round settles one more, and the last sees no change
    for _ in range(len(uneven) + 1):
        turning = [_bounds(setting, gains, added, each.driver, each.carrier) for each in uneven]
        wider = [swing.times(speed) for swing, speed in zip(swings, turning, strict=True)]
        if wider == added:
            return added
        added = wider
    # pairs that depend on each other in a circle: no bound was found
    return [SpeedBounds(-inf, inf)] * len(uneven)


def _with_mean(
    setting: LoadCase,
    uneven: Sequence[_Uneven],
    gains: Mapping[str, Mapping[int, float]],
    link: str,
    bounds: SpeedBounds,
) -> SpeedBounds:
    """With the mean magnitude, where one pair alone makes the link uneven and that pair's driver turns evenly."""
    import numpy as np

    carrier = setting.tree.parent[link][0]
    own = _between(gains, link, carrier)
    mean = setting.relative(link, carrier)
    if len(own) != 1 or mean is None:
        return bounds
    ((number, gain),) = own.items()
    pair = uneven[number]
    speed = setting.relative(pair.driver, pair.carrier)
    if pair.law is None or speed is None or _between(gains, pair.driver, pair.carrier):
        return bounds
    # midpoint rule: for a periodic function with kinks as good as any
    S = (np.arange(_SAMPLES) + 0.5) * (pair.law.period / _SAMPLES)
    found = np.abs(_number(mean) + gain * (pair.law.speed(S) - float(pair.mean)) * _number(speed))
    return SpeedBounds(bounds.low, bounds.high, float(found.mean()), max(-bounds.low, bounds.high))


def _number(value: Fraction) -> float:
    """The nearest float, infinite where there is none."""
    number = as_float(value)
    if number is not None:
        return number
    return 0.0 if abs(value) < 1 else inf if value > 0 else -inf


def _product(x: float, y: float) -> float:
    """x times y, 0 where one of them is 0 and the other has no bound."""
    return x * y if x and y else 0.0
