"""Extreme trains with references in 50-digit arithmetic, and the errors of floating-point results.

The angles of a train are found from the transmission functions of `sorge`, which are solved simultaneously; tooth sizes
given as floats are treated as exact. Torques are balanced in fractions, from the statics of each wheel. `CASES`
compares each train with its reference; the tests bound the errors, and a page of the documentation lists them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import product
from math import pi, radians
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from sorge import APPROACH, Segment, mp
from sorge import Pair as Couple

from geartrain import load
from geartrain.dynamics import Motion, TransmissionErrorCurve
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

FRAME, ARM = "frame", "arm"
SETS = {"left": (FRAME, "A"), "right": (FRAME, "A"), ARM: (FRAME, "A"), "planet": (ARM, "P")}
EPS = 2.0**-53


@dataclass(frozen=True)
class Wheels:
    """Two external wheels and the declaration of their teeth, which are ideal without a form."""

    z1: int
    z2: int
    teeth: str = ""
    external = True

    @property
    def form(self) -> str:
        """Text of the tooth form in the declaration of a pair."""
        return f", {self.teeth}" if self.teeth else ""


@dataclass(frozen=True)
class Slot:
    """A pin at radius r in a slot whose axis is at the offset e, within the pin's circle."""

    r: float
    e: float
    external = False

    @property
    def form(self) -> str:
        """Text of the coupling in a declaration."""
        return f", pin_radius: {self.r}, offset: {self.e}"


@dataclass(frozen=True)
class Pair:
    """Driver, driven link, carrier and their connection."""

    driver: str
    driven: str
    carrier: str
    by: Wheels | Slot


@dataclass(frozen=True)
class Train:
    """Links with the link that bears them and their axis, pairs, and the input speeds; `frame` is at rest."""

    bases: dict[str, tuple[str, str]]
    pairs: tuple[Pair, ...]
    inputs: dict[str, float]

    @cached_property
    def at(self) -> dict[str, int]:
        """Numbers of the links; the frame is last."""
        return {link: number for number, link in enumerate([*self.bases, "frame"])}


def declared(train: Train) -> str:
    """Return the train as a declaration: two separate wheels for each pair, or a pin and a slot."""
    wheels: dict[str, list[str]] = {link: [] for link in train.bases}
    gears, slots = [], []
    for at, pair in enumerate(train.pairs):
        if pair.by.external:
            wheels[pair.driver].append(f"d{at}: {pair.by.z1}")
            wheels[pair.driven].append(f"f{at}: {pair.by.z2}")
            gears.append(f"  - {{pair: [d{at}, f{at}], driver: d{at}{pair.by.form}}}")
        else:
            slots.append(f"  - {{kind: pin_and_slot, pin: {pair.driver}, slot: {pair.driven}{pair.by.form}}}")
    lines = ["links:", "  frame: {}"]
    lines += [f"  {link}: {{wheels: {{{', '.join(each)}}}}}" for link, each in wheels.items()]
    lines += ["revolutes:"]
    lines += [f"  - {{pair: [{base}, {link}], axis: {axis}}}" for link, (base, axis) in train.bases.items()]
    lines += ["gears:", *gears] if gears else []
    lines += ["couplings:", *slots] if slots else []
    inputs = ", ".join(f"{link}: {Fraction(speed).limit_denominator(10**6)}" for link, speed in train.inputs.items())
    lines += [f"inputs: {{{inputs}}}", f"outputs: {{{', '.join(f'{link}: {{}}' for link in train.bases)}}}"]
    return "\n".join(lines)


def triangular(window: float | str = 0.5, half_angle: float = 30, radii: str = "equal_depth") -> str:
    """Return a tooth form in the syntax of a declaration."""
    return f"tooth_form: {{form: triangular, half_angle: {half_angle} deg, window: {window}, radii: {radii}}}"


def contact(tooth_pair: Couple, S: Any) -> tuple[Segment, Any]:
    """Return the tooth pair that drives at the forward angle S, and its alpha_1."""
    for segment in tooth_pair.path:
        over = mp.floor((segment.start + S) / tooth_pair.p1 - segment.k) + segment.k
        x = over * tooth_pair.p1 - S
        if x >= segment.end:
            return segment, x
    raise AssertionError("the path has a hole")


@cache
def tooth_pair_of(sizes: TriangularSizes) -> Couple:
    """Return the tooth pair of the given sizes with its path; cached."""
    return Couple.of(sizes)


class Toothed:
    """Transmission function of triangular teeth."""

    def __init__(self, sizes: TriangularSizes) -> None:
        self.tooth_pair = tooth_pair_of(sizes)
        self.mean = mp.mpf(sizes.z1) / sizes.z2

    def angle(self, S: Any) -> Any:
        """Return the driven angle."""
        return self.mean * S + self.tooth_pair.error(S)

    def speed(self, S: Any) -> Any:
        """Return tau, which is 0 in a dwell."""
        segment, x = contact(self.tooth_pair, S)
        return mp.mpf(0) if segment.held is not None else self.tooth_pair.speed(x, segment.phase)


class Pinned:
    """Transmission function of a pin at the radius r in a slot whose axis is at the offset e, r > e."""

    mean = mp.mpf(1)

    def __init__(self, r: float, e: float) -> None:
        self.r, self.e = mp.mpf(r), mp.mpf(e)

    def angle(self, S: Any) -> Any:
        """Return the direction of the pin from the slot's axis, continuous over turns."""
        return S + mp.atan2(self.e * mp.sin(S), self.r - self.e * mp.cos(S))

    def speed(self, S: Any) -> Any:
        """Return the derivative of the angle."""
        r, e = self.r, self.e
        return r * (r - e * mp.cos(S)) / (r * r + e * e - 2 * r * e * mp.cos(S))


class Even:
    """Transmission function of ideal teeth."""

    def __init__(self, by: Wheels | Slot) -> None:
        self.mean = mp.mpf(1) if isinstance(by, Slot) else mp.mpf(by.z1) / by.z2

    def angle(self, S: Any) -> Any:
        """Return the mean ratio times S."""
        return self.mean * S

    def speed(self, S: Any) -> Any:
        """Return the mean ratio."""
        return self.mean


@dataclass(frozen=True)
class Set:
    """A transmission function whose driver starts at the angle S."""

    transmission: Any
    S: Any
    mean = property(lambda self: self.transmission.mean)

    def angle(self, S: Any) -> Any:
        """Return the driven angle."""
        return self.mean * self.S + self.transmission.angle(S - self.S)

    def speed(self, S: Any) -> Any:
        """Return the speed ratio."""
        return self.transmission.speed(S - self.S)


class Exactly:
    """Angles of a train in 50 digits. Tooth sizes are those of the loaded train; everything else is computed here."""

    def __init__(self, train: Train, loaded: Any) -> None:
        self.train = train
        sizes = {mesh.name: mesh.transmission.sizes for mesh in loaded.meshes}
        known: dict[Any, Toothed] = {}
        self.transmissions = []
        for at, pair in enumerate(train.pairs):
            own = sizes.get(f"d{at}~f{at}")
            if isinstance(pair.by, Slot):
                self.transmissions.append(Pinned(pair.by.r, pair.by.e))
            elif own is None:
                self.transmissions.append(Even(pair.by))
            else:
                self.transmissions.append(known.setdefault(own, Toothed(own)))
        # each driver has a tooth, or its pin, on the line of centres where its link hangs at the start
        signs = [first * second for first, second in self.senses]
        ratios = [sign * transmission.mean for sign, transmission in zip(signs, self.transmissions, strict=True)]
        ahead = [
            second * transmission.angle(mp.mpf(0))
            for (_, second), transmission in zip(self.senses, self.transmissions, strict=True)
        ]
        hung = self._solved(ratios, ahead, 0)
        self.transmissions = [
            Set(transmission, self.forward(hung, at)[0]) for at, transmission in enumerate(self.transmissions)
        ]

    @cached_property
    def means(self) -> list[Any]:
        """Mean speeds of all links."""
        signs = [-1 if pair.by.external else 1 for pair in self.train.pairs]
        ratios = [sign * transmission.mean for sign, transmission in zip(signs, self.transmissions, strict=True)]
        return self._solved(ratios, [mp.mpf(0)] * len(ratios), 1)

    @cached_property
    def senses(self) -> list[tuple[int, int]]:
        """Signs of the forward angles S and q of each pair."""
        found = []
        for pair in self.train.pairs:
            driver, carrier = (self.means[self.train.at[link]] for link in (pair.driver, pair.carrier))
            ahead = 1 if driver >= carrier else -1
            found.append((ahead, -ahead if pair.by.external else ahead))
        return found

    def _solved(self, ratios: Sequence[Any], ahead: Sequence[Any], turning: Any) -> list[Any]:
        """Return the speeds of all links if each driven side is ahead by `ahead`, relative to the carrier."""
        train, size = self.train, len(self.train.at)
        rows, right = [], []
        for pair, ratio, more in zip(train.pairs, ratios, ahead, strict=True):
            row = {train.at[pair.driven]: mp.mpf(1)}
            for link, part in ((pair.driver, -ratio), (pair.carrier, ratio - 1)):
                row[train.at[link]] = row.get(train.at[link], 0) + part
            rows.append(row)
            right.append(more)
        for link, speed in (train.inputs | {FRAME: 0}).items():
            exact = Fraction(speed).limit_denominator(10**6)
            rows.append({train.at[link]: mp.mpf(1)})
            right.append(mp.mpf(exact.numerator) / exact.denominator * turning)
        return eliminated(rows, right, size)

    def forward(self, angles: Sequence[Any], number: int) -> tuple[Any, Any]:
        """Return the forward angles S and q of one pair."""
        pair, (first, second), at = self.train.pairs[number], self.senses[number], self.train.at
        carrier = angles[at[pair.carrier]]
        return first * (angles[at[pair.driver]] - carrier), second * (angles[at[pair.driven]] - carrier)

    def misfits(self, angles: Sequence[Any]) -> list[Any]:
        """Return the amount by which each driven side is behind the angle given by its transmission function."""
        places = [self.forward(angles, number) for number in range(len(self.transmissions))]
        return [transmission.angle(S) - q for transmission, (S, q) in zip(self.transmissions, places, strict=True)]

    def ratios(self, angles: Sequence[Any]) -> list[Any]:
        """Return the signed instantaneous ratios, driven by driver, relative to the carrier."""
        speeds = [
            transmission.speed(self.forward(angles, number)[0])
            for number, transmission in enumerate(self.transmissions)
        ]
        return [first * second * tau for (first, second), tau in zip(self.senses, speeds, strict=True)]

    def moved(self, turns: float, errors: Sequence[float]) -> list[Any]:
        """Return all angles for given transmission errors at a number of turns of the input."""
        turned = 2 * mp.pi * mp.mpf(turns)
        return [mean * turned + mp.mpf(error) for mean, error in zip(self.means, errors, strict=True)]

    def at(self, turns: float, guess: Sequence[float]) -> list[Any]:
        """Return all angles at a number of turns of the input, by Newton's method from a guess of the errors."""
        angles = self.moved(turns, guess)
        for _ in range(60):
            misfits = self.misfits(angles)
            ahead = [second * misfit for (_, second), misfit in zip(self.senses, misfits, strict=True)]
            step = self._solved(self.ratios(angles), ahead, 0)
            angles = [angle + more for angle, more in zip(angles, step, strict=True)]
            if max(map(abs, step)) < mp.mpf(10) ** -42:
                return angles
        raise AssertionError("no angles fit all laws")

    def errors(self, turns: float, angles: Sequence[Any]) -> list[Any]:
        """Return the angles minus their mean motion."""
        turned = 2 * mp.pi * mp.mpf(turns)
        return [angle - mean * turned for angle, mean in zip(angles, self.means, strict=True)]

    def rates(self, angles: Sequence[Any]) -> list[Any]:
        """Return the speeds of all links divided by the speed of the input."""
        return self._solved(self.ratios(angles), [mp.mpf(0)] * len(self.transmissions), 1)


def eliminated(rows: Sequence[dict[int, Any]], right: Sequence[Any], size: int) -> list[Any]:
    """Return the solution of sparse equations by elimination with the largest pivot of each row in turn."""
    rows, right, order = [dict(row) for row in rows], list(right), []
    left = list(range(size))
    while left:
        at = min(left, key=lambda number: len(rows[number]))
        column = max(rows[at], key=lambda link: abs(rows[at][link]))
        left.remove(at)
        order.append((at, column))
        for other in left:
            if column in rows[other]:
                factor = rows[other].pop(column) / rows[at][column]
                for link, value in rows[at].items():
                    if link != column:
                        rows[other][link] = rows[other].get(link, 0) - factor * value
                right[other] -= factor * right[at]
    found: list[Any] = [mp.mpf(0)] * size
    for at, column in reversed(order):
        known = sum(value * found[link] for link, value in rows[at].items() if link != column)
        found[column] = (right[at] - known) / rows[at][column]
    return found


def composed(transmissions: Sequence[Any], turns: float) -> tuple[Any, Any, Any]:
    """Return error, relative speed, and sensitivity to the error of each pair, of the last wheel of a chain."""
    S, hung, mean, gain, summed = 2 * mp.pi * mp.mpf(turns), mp.mpf(0), mp.mpf(1), mp.mpf(1), mp.mpf(0)
    for each in transmissions:
        transmission = Set(each, hung)
        tau = transmission.speed(S)
        S, hung, mean = transmission.angle(S), transmission.angle(hung), mean * transmission.mean
        gain, summed = gain * tau / transmission.mean, 1 + tau * summed
    return S - mean * 2 * mp.pi * mp.mpf(turns), gain, summed


@dataclass(frozen=True)
class Run:
    """Floating-point results of a train and their reference at some positions; angles in rad, speeds relative to the
    maximum speed of each link.

    off        maximum difference of the transmission error of each link; `speed_off` for its speed
    misfit     residual of the float angles in the transmission functions, in 50 digits
    refused    message if the train cannot be computed
    """

    found: dict[str, Any]
    off: dict[str, float]
    speed_off: dict[str, float]
    misfit: float
    seconds: float


def hung(motion: Motion, turns: float, samples: int) -> dict[str, TransmissionErrorCurve]:
    """Return the motion of every output as the teeth give it, without setting pointers."""
    composition, at = motion._unset, np.arange(samples)
    parts = [composition.at(turns * (each / (samples - 1))) for each in np.split(at, range(30_000, samples, 30_000))]
    error, rate = (np.concatenate([part[column] for part in parts], axis=1) for column in (1, 2))
    angle = 2 * np.pi * np.concatenate([part[0] for part in parts])
    return {
        tally.name: TransmissionErrorCurve(tally.name, tally.ratio, angle, error[row], tally.mean + rate[row])
        for row, tally in enumerate(motion._statistics())
    }


def run(train: Train, turns: float, samples: int, places: int) -> Run:
    """Compare `count` positions from 0 to `turns`."""
    loaded = load(declared(train))
    motion = loaded.motion()
    since = perf_counter()
    found = hung(motion, turns, samples)
    seconds = perf_counter() - since
    exactly = Exactly(train, loaded)
    off, speed_off, misfit = dict.fromkeys(train.bases, 0.0), dict.fromkeys(train.bases, 0.0), 0.0
    for at in np.linspace(0, samples - 1, places).round().astype(int).tolist():
        where = turns * (np.float64(at) / (samples - 1))
        mine = [float(found[link].error[at]) for link in train.bases] + [0.0]
        misfit = max(misfit, *(float(abs(each)) for each in exactly.misfits(exactly.moved(where, mine))))
        angles = exactly.at(where, mine)
        rates, errors = exactly.rates(angles), exactly.errors(where, angles)
        for link, number in list(train.at.items())[:-1]:
            most = float(np.abs(found[link].speed).max()) or 1.0
            off[link] = max(off[link], float(abs(mp.mpf(found[link].error[at]) - errors[number])))
            speed_off[link] = max(speed_off[link], float(abs(found[link].speed[at] - rates[number])) / most)
    return Run(found, off, speed_off, misfit, seconds)


class Measured(NamedTuple):
    """An error relative to 50 digits, and the run time of the floating-point computation [s]."""

    error: float
    seconds: float


@dataclass(frozen=True)
class Case:
    """One extreme train.

    extreme   description of the extreme
    of        quantity and unit of the error
    bound     rounding error of float64 times its amplification in the train
    why       reason why the train is rejected, if it is
    slow      takes longer than a quick test should
    """

    name: str
    extreme: str
    of: str
    measure: Callable[[], Measured]
    bound: float
    why: str
    slow: bool = False


def power(value: float) -> str:
    """Format a number as one digit and a power of ten, or plainly if that is shorter."""
    digit, exponent = f"{value:.0e}".split("e")
    return f"{value:g}" if 0.01 < value < 1000 else f"{digit}e{int(exponent)}"


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    """Return the result of a function and its run time [s]."""
    since = perf_counter()
    found = work()
    return found, perf_counter() - since


def suns(counts: tuple[int, int, int, int], inputs: dict[str, float], form: str = "") -> Train:
    """Return two suns and a planet with two wheels on an arm: pairs (left, planet) and (planet, right)."""
    left, p, q, right = counts
    form = form or triangular()
    pairs = (Pair("left", "planet", ARM, Wheels(left, p, form)), Pair("planet", "right", ARM, Wheels(q, right, form)))
    return Train(SETS, pairs, inputs)


def near_locking(teeth: int, turns: float) -> Measured:
    """Return a set whose arm turns while one sun is held; the other sun moves by 1/(teeth^2 - 1) of the arm's speed."""
    train = suns((teeth, teeth + 1, teeth, teeth - 1), {ARM: 1, "left": 0})
    found = run(train, turns, 997, 9)
    return Measured(found.off["right"], found.seconds)


def at_rest(turns: float) -> Measured:
    """Return the same set with a ratio of exactly 1: the second sun moves only by the errors of its teeth."""
    found = run(suns((100, 50, 50, 100), {ARM: 1, "left": 0}), turns, 997, 9)
    assert not found.found["right"].mean
    return Measured(found.off["right"], found.seconds)


def pin_of_ratio_one(offset: float, turns: float) -> Measured:
    """Return a pin and slot on an arm between two pairs of equal wheels: all ratios relative to the arm are 1 or -1."""
    bases = {ARM: (FRAME, "A"), "sun": (FRAME, "A"), "p": (ARM, "P"), "s": (ARM, "Q"), "out": (FRAME, "A")}
    even = Wheels(50, 50, triangular())
    pairs = (Pair("sun", "p", ARM, even), Pair("p", "s", ARM, Slot(1.0, offset)), Pair("s", "out", ARM, even))
    found = run(Train(bases, pairs, {ARM: 1, "sun": 0}), turns, 997, 9)
    return Measured(found.off["out"], found.seconds)


def hanging(window: float, last: tuple[int, int]) -> Measured:
    """Return the residuals of all transmission functions of an arm driven by a wheel that its own planet drives."""
    form = triangular(window)
    pairs = (
        *suns((40, 20, 18, 44), {}, form).pairs,
        Pair("right", "lay", FRAME, Wheels(50, 40, form)),
        Pair("lay", ARM, FRAME, Wheels(*last, form)),
    )
    found = run(Train(SETS | {"lay": (FRAME, "B")}, pairs, {"left": 1}), 30.0, 20_001, 25)
    return Measured(found.misfit, found.seconds)


def chain(kinds: Sequence[tuple[int, int]], pairs: int, form: str) -> Train:
    """Return a chain of `count` pairs in series."""
    bases = {f"s{at}": (FRAME, f"A{at}") for at in range(pairs + 1)}
    meshing = (Wheels(*kinds[at % len(kinds)], form) for at in range(pairs))
    pairs_of = tuple(Pair(f"s{at}", f"s{at + 1}", FRAME, by) for at, by in enumerate(meshing))
    return Train(bases, pairs_of, {"s0": 1})


def twelve(teeth: tuple[int, int], turns: float) -> Measured:
    """Return the error of the last of twelve pairs of 10 to 1 or 1 to 10, relative to its maximum error."""
    found = run(chain([teeth], 12, triangular()), turns, 97, 7)
    return Measured(found.off["s12"] / float(np.abs(found.found["s12"].error).max()), found.seconds)


KINDS = ((100, 101), (103, 102), (99, 100), (101, 100))


def long_chain(pairs: int, places: Sequence[int]) -> Measured:
    """Return the maximum relative difference of the error of the last wheel of a long chain, the only one requested."""
    last, train = f"s{pairs}", chain(KINDS, pairs, triangular())
    every = ", ".join(f"{link}: {{}}" for link in train.bases)
    loaded = load(declared(train).replace(f"outputs: {{{every}}}", f"outputs: {{{last}: {{}}}}"))
    found, seconds = timed(lambda: hung(loaded.motion(), 3.3, 201))
    known: dict[Any, Toothed] = {}
    transmissions = [known.get(sizes) or known.setdefault(sizes, Toothed(sizes)) for sizes in _sizes(loaded)]
    off = 0.0
    for at in places:
        error, _, _ = composed(transmissions, 3.3 * (np.float64(at) / 200))
        mine = float(found[last].error[at]) * (1 if pairs % 2 == 0 else -1)
        off = max(off, float(abs(mine / error - 1)))
    return Measured(off, seconds)


def _sizes(loaded: Any) -> list[Any]:
    return [mesh.transmission.sizes for mesh in loaded.meshes]


def at_the_edge(window: float) -> Measured:
    """Return Price's train to the Moon over the common period, with all pairs at one position in their windows."""
    form = triangular(repr(window))
    bases = {"crank": (FRAME, "A"), "sun": (FRAME, "B"), "c": (FRAME, "C"), "d": (FRAME, "D"), "moon": (FRAME, "E")}
    counts, links = ((45, 225), (64, 38), (48, 24), (127, 32)), list(bases)
    pairs = [Pair(links[at], links[at + 1], FRAME, Wheels(*each, form)) for at, each in enumerate(counts)]
    found = run(Train(bases, tuple(pairs), {"crank": 1}), 95.0, 10_007, 15)
    return Measured(found.off["moon"], found.seconds)


DRAWN = [0.013, 0.29, 0.41, 0.67, 0.83, 0.999]  # of a pitch


def thirty(z1: int, z2: int, excess: float) -> TriangularSizes:
    """Return teeth of equal depth with half angles of 30 degrees."""
    beta = radians(30)
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def almost_apart(share: float) -> Measured:
    """Return the error, in driven pitches, for 48 and 96 teeth near the clearance at which tips no longer touch."""
    sizes = thirty(48, 96, 0.01)
    sizes = sizes.at(sizes.maximum_excess * share)
    transmission, tooth_pair = TriangularTransmission(sizes), tooth_pair_of(sizes)
    S = np.array(DRAWN) * sizes.p1
    errors, seconds = timed(lambda: transmission.error(S))
    pairs = zip(S.tolist(), errors.tolist(), strict=True)
    return Measured(max(float(abs(error - tooth_pair.error(x)) / tooth_pair.p2) for x, error in pairs), seconds)


def near_friction_locking(teeth: tuple[int, int], digits: int, at_load: bool) -> Measured:
    """Return the relative error of the mean efficiency with friction just below the locking friction."""
    sizes = thirty(*teeth, 0.01)
    friction = TriangularTransmission(sizes).locking_friction * (1 - 10.0**-digits)
    transmission = TriangularTransmission(sizes, friction)
    mine, seconds = timed(transmission.efficiency_at_constant_load if at_load else transmission.efficiency_mean)
    true = tooth_pair_of(sizes).mean_efficiency(mp.mpf(friction))[int(at_load)]
    return Measured(float(abs(mine / true - 1)), seconds)


def locking(teeth: tuple[int, int]) -> Measured:
    """Return the relative error of the locking friction before the line of centres."""
    sizes = thirty(*teeth, 0.01)
    tooth_pair = tooth_pair_of(sizes)
    mine, seconds = timed(lambda: TriangularTransmission(sizes).locking_friction)
    starts = [segment.start for segment in tooth_pair.path if segment.phase == APPROACH]
    most = max(mp.tan(tooth_pair.lean(x, APPROACH)) for x in starts if tooth_pair.angle(x, APPROACH) > 0)
    return Measured(float(abs(mine * most - 1)), seconds)


def pin_near_offset(more: float, turns: float) -> Measured:
    """Return the error of the slot of a pin at r = (1 + more) e, each turn slightly further past the fastest place."""
    train = Train(
        {"pin": (FRAME, "B"), "slot": (FRAME, "C")}, (Pair("pin", "slot", FRAME, Slot(1 + more, 1.0)),), {"pin": 1}
    )
    found = run(train, turns * (1 + 1e-7), round(turns) + 1, 31)
    return Measured(found.off["slot"], found.seconds)


CIRCULATING = (50, 45, 40, 44)  # basic ratio 100/99: the right sun makes 1/99 turn back for a turn of the arm


def balanced(counts: tuple[int, int, int, int], etas: Sequence[Mapping[int, Fraction]]) -> list[Fraction]:
    """Return the efficiencies from the arm to the right sun with the left sun held, one for each direction of power
    flow.

    The torques of a pair on its two wheels have the same sign and the ratio of the teeth, multiplied by eta if the
    first wheel drives relative to the arm (1), and divided by eta if the second wheel drives (-1).
    """
    left_teeth, p, q, r = counts
    left = Fraction(-1)
    planet = -left * left_teeth / p
    right = -planet * q / r
    resisting = Fraction(-1 if right + 1 > 0 else 1)
    found = []
    for first, second in product((1, -1), repeat=2):
        from_planet = -resisting
        from_left = (
            -from_planet * q / (r * etas[1][second] ** second)
        )  # on the planet, against what the right sun does to it
        held = -from_left * left_teeth / (p * etas[0][first] ** first)
        if from_left * planet * first >= 0 and from_planet * right * second >= 0:
            found.append(resisting * (right + 1) / (resisting + held))
    return found


def circulating(teeth: str) -> Any:
    """Return the set with its arm driving, for the computation of torques."""
    return load(declared(suns(CIRCULATING, {ARM: 1}, teeth)) + "\nfixed: [left]")


def lost_in_circulation(friction: float) -> Measured:
    """Return the relative error of the efficiency from the arm to the slow sun for teeth with friction."""
    train = circulating(f"{triangular()}, friction: {friction}")
    torques, seconds = timed(lambda: train.driven("right", ARM))
    means = [tooth_pair_of(sizes).mean_efficiency(mp.mpf(friction)) for sizes in _sizes(train)]
    # the moment on the right sun is given, then that on the planet: on what is driven (1), or on the driver (-1)
    (true,) = balanced(CIRCULATING, [{1: Fraction(str(load)), -1: Fraction(str(drive))} for drive, load in means])
    return Measured(float(abs(torques.efficiency / true - 1)), seconds)


def amplified(turns: float) -> Measured:
    """Return the relative error of an arm for a pair with real teeth followed by ideal wheels of ratio 99."""
    left_teeth, p, q, r = CIRCULATING
    pairs = (
        Pair("crank", "right", FRAME, Wheels(60, 60, triangular())),
        Pair("right", "planet", ARM, Wheels(r, q)),
        Pair("planet", "left", ARM, Wheels(p, left_teeth)),
    )
    train = Train(SETS | {"crank": (FRAME, "B")}, pairs, {"crank": 1, "left": 0})
    found = run(train, turns, 997, 9)
    return Measured(found.off[ARM] / float(np.abs(found.found[ARM].error).max()), found.seconds)


RADIANS, SHARE, PITCHES = "rad of the output", "relative", "driven pitches"


def plain(periods: float) -> float:
    """Return the rounding error of a mean angle as a plain product, which subtracting whole periods avoids."""
    return periods if periods <= 2048 else 0


REDUCED = "Whole periods are taken off the exact mean angle, so that the length of the run costs nothing."
CASES = (
    *(
        Case(
            "differential near locking",
            f"output {power(1 / teeth**2)} of the arm, {power(turns)} turns",
            RADIANS,
            partial(near_locking, teeth, turns),
            (4 + plain(teeth * turns)) * EPS * 2 * pi / teeth,
            "Nothing cancels: means are fractions, and only errors, a small part of a pitch, are floats. " + REDUCED,
            slow=teeth > 1000,
        )
        for teeth, turns in ((32, 10.0), (1000, 1e3), (31_623, 1e6))
    ),
    Case(
        "ratio of exactly 1 on an arm",
        "output at rest on average, 1e6 turns",
        RADIANS,
        partial(at_rest, 1e6),
        2 * EPS,
        REDUCED,
    ),
    *(
        Case(
            "pin and slot of ratio 1 on an arm",
            f"offset {power(offset)} of the pin's radius, 1e6 turns",
            RADIANS,
            partial(pin_of_ratio_one, offset, 1e6),
            8 * EPS,
            REDUCED,
        )
        for offset in (0.5, 1e-9)
    ),
    *(
        Case(
            "twelve pairs, 10 to 1 each",
            f"speed times 1e12, {power(turns)} turns of the slow end",
            SHARE,
            partial(twelve, (300, 30), turns),
            64 * EPS,
            "The first error is rounded to one part in 1e16 and then turned 1e11 times: the fast end is right to "
            "1e-15 of an error of 1e10 rad, which is some 1e-5 rad. Its own mean angle is exact.",
        )
        for turns in (1e-12, 10.0, 1e6)
    ),
    Case(
        "twelve pairs, 1 to 10 each",
        "speed over 1e12, 1e6 turns of the fast end",
        SHARE,
        partial(twelve, (30, 300), 1e6),
        64 * EPS,
        "Only the last pair's error is left at the slow end. " + REDUCED,
    ),
    *(
        Case(
            "pairs in a row, each with a transmission error",
            f"{pairs:,} pairs",
            SHARE,
            partial(long_chain, pairs, places),
            pairs * EPS,
            "Each pair rounds the angle of the next, and the errors of all add up.",
            slow,
        )
        for pairs, places, slow in ((300, (77, 200), False), (1_000, (77,), True))
    ),
    *(
        Case(
            "efficiency near friction locking",
            f"{teeth[0]}/{teeth[1]} teeth, friction 1 - 1e-{digits} of the locking friction, constant driver torque",
            SHARE,
            partial(near_friction_locking, teeth, digits, False),
            40 * EPS,
            "The efficiency falls to 0 at one end of the path only; its mean stays well determined.",
            slow=digits > 3,
        )
        for teeth, digits in (((96, 72), 3), ((96, 72), 9), ((48, 24), 6))
    ),
    *(
        Case(
            "efficiency near friction locking",
            f"96/72 teeth, friction 1 - 1e-{digits} of the locking friction, constant load",
            SHARE,
            partial(near_friction_locking, (96, 72), digits, True),
            40 * EPS * 10**digits,
            "The inverse of the efficiency grows without bound towards one end of the path, and what is left before "
            "locking is the small difference of two floats.",
        )
        for digits in (1, 3, 6)
    ),
    Case(
        "friction locking",
        "96/72 teeth",
        SHARE,
        partial(locking, (96, 72)),
        16 * EPS,
        "A tangent at the end of the path.",
    ),
    *(
        Case(
            "clearance at an end of the window",
            f"window {text}, the Moon's train over 95 turns",
            RADIANS,
            partial(at_the_edge, window),
            600 * EPS,
            "An angle of many pitches is rounded before its place in the pitch is known.",
        )
        for window, text in ((1e-9, "1e-9"), (1 - 1e-9, "1 - 1e-9"))
    ),
    *(
        Case(
            "tips that hardly overlap",
            f"48/96 teeth, tips overlap by 1e-{digits} of the maximum",
            PITCHES,
            partial(almost_apart, 1 - 10.0**-digits),
            8 * EPS * 10 ** (digits / 2),
            "The reach of a couple is the root of the overlap: it loses half as many digits as the overlap does.",
        )
        for digits in (6, 9, 12)
    ),
    *(
        Case(
            "recirculating power",
            f"100 times the throughput, friction {friction:g}",
            SHARE,
            partial(lost_in_circulation, friction),
            400 * 5e-16,
            "Efficiencies of teeth enter the balance with 15 digits, and the circulation multiplies what was cut off.",
            slow=friction > 0.01,
        )
        for friction in (0.01, 0.1)
    ),
    *(
        Case(
            "transmission error multiplied by the train",
            f"99 times, {power(turns)} turns",
            SHARE,
            partial(amplified, turns),
            (8 + plain(60 * turns)) * EPS,
            REDUCED,
        )
        for turns in (10.0, 1e6)
    ),
    *(
        Case(
            "pin near the axis of its slot",
            f"r/e = 1 + {power(more)}, {power(turns)} turns, near its fast position",
            RADIANS,
            partial(pin_near_offset, more, turns),
            16 * EPS,
            "The slot makes half a turn while the pin passes; the pin's distance from the fast place keeps its digits "
            "if whole turns are taken off first.",
        )
        for more, turns in ((1e-3, 1000.0), (1e-3, 1e4), (1e-6, 1000.0), (1e-6, 1e4))
    ),
    *(
        Case(
            "four pairs in a ring",
            f"window {window:g}, {last[0]}/{last[1]} teeth at its end, 30 turns, misfit of all pairs",
            "rad",
            partial(hanging, window, last),
            64 * EPS * 2 * pi * 30,
            "Angles of all turns are added in floats before the laws are asked.",
            slow=window < 0.5 or last != (30, 60),
        )
        for window, last in ((0.5, (30, 60)), (0.1, (40, 60)), (0.5, (60, 60)))
    ),
)
