"""Every way to the motion of whole trains with real teeth and pins: error and time, as ratios to direct composition.

Direct asks every law itself, in the solved order. Its alternatives: tables of the laws, sums over pairs to first order,
two estimates without any position, and marching in time as a general multibody program does. The direct composition
itself is judged by the laws' definitions in 40 digits.
"""

from __future__ import annotations

import math
import random
import time
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property, partial
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.analysis import GearTrain
from geartrain.bench.marching import Marching
from geartrain.bench.record import Record, Records
from geartrain.bench.truth import Truth
from geartrain.files import load
from geartrain.motion import Motion, Superposition, Tally
from geartrain.teeth.triangular import law as _laws
from geartrain.teeth.triangular import meshing as _meshing

Floats = NDArray[np.float64]
Ask = Callable[[Floats], Floats]
Advance = Callable[[str], None]

BOUND, INDEPENDENT = "sum of ranges", "independent rms"
NOMINAL, LAGGED = "superposition", "superposition with lag"
DIRECT, TABULATED = "direct", "tabulated"
FIXED, ADAPTIVE = "marching", "marching, RK45"
TOLERANCES = (1e-6, 1e-9, 1e-12)
TABLES = tuple(f"{TABULATED}, {tolerance:.0e}" for tolerance in TOLERANCES)
PER_POSITION = (DIRECT, *TABLES, NOMINAL, LAGGED)
_TEETH = {"form": "triangular", "half_angle": "30 deg", "window": 0.5}
_DIALS = ("sun", "moon", "synodic month", "lunar year", "four years")
_POINTERS = ("moon", "mercury", "venus", "mars", "jupiter", "saturn")
_STEPS = (1, 10)  # of marching, to a position
_PAIRS = (10, 100, 1_000, 10_000)
_FEW_PAIRS = (10, 30)
_GROWN = 4_000  # positions of the chains
_QUICKEST = 20_000  # most positions of a quick run


@dataclass(frozen=True, slots=True)
class MotionRecord(Record):
    """A method on a train: `links` counts the lively ones, `seconds` is for all positions, without preparation.

    error, rms   greatest and root mean square error (deg) of the output that has the greatest, `output`; that of the
                 peak-to-peak ripple for the sum of ranges, and that of its rms for independent phases
    ratio        seconds over those of the direct composition in the same round
    prepared     seconds from the declaration to the first position, every law and window found anew
    positions    that were worked out; marching is extrapolated from fewer to all
    """

    rms: float | None = None
    ratio: float | None = None
    prepared: float | None = None
    positions: int = 0
    output: str = ""

    @property
    def rate(self) -> float | None:
        """Positions times lively links a second."""
        return self.positions * self.links / self.seconds if self.seconds and self.positions else None


@dataclass(frozen=True, slots=True)
class TrainRecord:
    """One train of the run.

    turns     of the input, over `positions`
    rippling  pairs and couplings whose errors reach an output; `ideal`, those of the train that have no law
    outputs   name -> peak-to-peak and rms ripple (deg)
    peaks     positions -> peak memory (MB) of the direct composition
    sample    random positions at which the direct composition is judged
    """

    family: str
    turns: float
    positions: int
    links: int
    rippling: Sequence[str]
    ideal: Sequence[str]
    outputs: dict[str, dict[str, float]]
    peaks: dict[str, float]
    sample: int


@dataclass(frozen=True, slots=True)
class GrowthRecord:
    """A chain of so many pairs: seconds to declare it, to find windows, to spread errors and build laws, and to run."""

    pairs: int
    positions: int
    chunk: int
    declared: float
    windows: float
    prepared: float
    seconds: float

    @property
    def rate(self) -> float:
        """Positions times links a second."""
        return self.positions * self.pairs / self.seconds


@dataclass(frozen=True, slots=True)
class MotionRecords(Records):
    """All measurements of one run: a table a train, and one of the chains."""

    rows: Sequence[MotionRecord]
    trains: Sequence[TrainRecord] = ()
    growth: Sequence[GrowthRecord] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        more = {"trains": [asdict(each) for each in self.trains], "growth": [asdict(each) for each in self.growth]}
        return {"title": self.title, "rows": [asdict(row) for row in self.rows], **more}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> MotionRecords:
        """What `to_dict` gave."""
        return cls(
            data["title"],
            [MotionRecord(**row) for row in data["rows"]],
            [TrainRecord(**row) for row in data["trains"]],
            [GrowthRecord(**row) for row in data["growth"]],
        )

    def to_markdown(self) -> str:
        """One table for each train, and the growth with the number of pairs."""
        lines = [f"# {self.title}", ""]
        for train in self.trains:
            ripple = (f"{name} {each['peak_to_peak']:.4g} ({each['rms']:.4g})" for name, each in train.outputs.items())
            lines += [
                f"## {train.family}",
                "",
                f"{train.positions} positions over {train.turns:g} turns, {len(train.rippling)} rippling pairs, "
                f"{train.links} lively links.",
                f"Peak-to-peak (rms) ripple in degrees: {', '.join(ripple)}.",
                "",
                *_table([row for row in self.rows if row.family == train.family]),
            ]
        return "\n".join([*lines, "## Chains of pairs", "", *_growth_table(self.growth)])


def _table(rows: Sequence[MotionRecord]) -> list[str]:
    lines = [
        "| method | greatest error | rms error | of | time | time over direct | links/s | prepared | memory | |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        errors = ("-" if each is None else f"{each:.1e} deg" for each in (row.error, row.rms))
        times = (f"{_seconds(row.seconds)} | {_number(row.ratio)} | {_number(row.rate, '.2g')}", _seconds(row.prepared))
        memory = "-" if row.megabytes is None else f"{row.megabytes:.1f} MB"
        lines.append(f"| {row.method} | {' | '.join((*errors, row.output, *times, memory))} | {row.note} |")
    return [*lines, ""]


def _growth_table(rows: Sequence[GrowthRecord]) -> list[str]:
    lines = [
        "| pairs | declare | windows | spread and laws | positions | run | links/s | positions at once |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        times = (_seconds(each) for each in (row.declared, row.windows, row.prepared))
        rest = (str(row.positions), _seconds(row.seconds), f"{row.rate:.2g}", str(row.chunk))
        lines.append(f"| {row.pairs} | {' | '.join((*times, *rest))} |")
    return [*lines, ""]


def _seconds(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value * 1e3:.3g} ms" if value < 1 else f"{value:.3g} s" if value < 1000 else f"{value:.0f} s"


def _number(value: float | None, form: str = ".3g") -> str:
    return "-" if value is None else f"{value:{form}}"


# ---------------------------------------------------------------------------------------------------------- measuring


def motion(quick: bool = False, positions: int = 1_000_000, advance: Advance = lambda _: None) -> MotionRecords:
    """Measure all methods on all trains (`quick`: two trains, few positions); `advance` hears of every step."""
    rows: list[MotionRecord] = []
    trains, growth = [], []
    for case in _cases(quick, positions):
        for name, step in case.steps():
            advance(f"{case.name}: {name}")
            step()
        rows += case.rows()
        trains.append(case.summary())
    for pairs in _chains(quick):
        advance(f"chain of {pairs} pairs")
        growth.append(_grown(pairs, 1 if quick else 5))
    return MotionRecords("Motion of whole trains: error against run time", rows, trains, growth)


def count_motion_steps(quick: bool = False) -> int:
    """How many steps `motion` will tell of."""
    return sum(len(list(case.steps())) for case in _cases(quick, 2)) + len(_chains(quick))


def _cases(quick: bool, positions: int) -> list[_Case]:
    if quick:
        effort = _Effort(min(positions, _QUICKEST), rounds=1, marched=5, sample=3)
    else:
        effort = _Effort(positions, rounds=5, marched=max(10, positions // 200), sample=100)
    cases = [
        _Case("moon-triangular", "moon-triangular", ("moon",), 95.0, effort),
        _Case("price-1974, triangular teeth", _toothed("price-1974"), _DIALS, 19.0, effort),
        _Case("freeth-2021, pins", "freeth-2021", _POINTERS, 19.0, effort),
        _Case("freeth-2021, pins and triangular teeth", _toothed("freeth-2021"), _POINTERS, 19.0, effort),
    ]
    return cases[:2] if quick else cases


def _toothed(name: str) -> str:
    """A shipped train with triangular teeth in the middle of each pair's window."""
    form = ", ".join(f"{key}: {value}" for key, value in _TEETH.items())
    return f"extends: {name}\nname: {name}-triangular\ntooth_form: {{{form}}}\n"


def _chains(quick: bool) -> Sequence[int]:
    return _FEW_PAIRS if quick else _PAIRS


def _forget() -> None:
    """Drop the windows and paths that earlier trains left behind, so that preparing finds its own."""
    _laws._contact.cache_clear()
    _meshing._window.cache_clear()


def _timed(task: Callable[[], Any]) -> float:
    start = time.perf_counter()
    task()
    return time.perf_counter() - start


class _Effort(NamedTuple):
    """Positions in all, rounds whose median counts, positions that are marched to, positions judged in 40 digits."""

    positions: int
    rounds: int
    marched: int
    sample: int


@dataclass
class _Off:
    """Differences (rad) of a method from the direct composition, by output: greatest, and sums of squares."""

    greatest: Floats
    squares: Floats
    count: int = 0

    @classmethod
    def none(cls, outputs: int) -> _Off:
        return cls(np.zeros(outputs), np.zeros(outputs))

    def add(self, off: Floats) -> None:
        """Count differences (outputs, n)."""
        self.greatest = np.maximum(self.greatest, np.abs(off).max(axis=1))
        self.squares = self.squares + (off**2).sum(axis=1)
        self.count += off.shape[1]

    def worst(self) -> tuple[int, float, float]:
        """The output with the greatest difference, that, and the rms there (deg)."""
        at = int(np.argmax(self.greatest))
        return at, math.degrees(self.greatest[at]), math.degrees(math.sqrt(self.squares[at] / self.count))


@dataclass
class _Case:
    """A train, the outputs and the run that are asked for, and what was measured of them so far."""

    name: str
    source: str
    outputs: tuple[str, ...]
    turns: float
    effort: _Effort
    times: dict[str, list[float]] = field(default_factory=dict)
    prepared: dict[str, list[float]] = field(default_factory=dict)
    off: dict[str, _Off] = field(default_factory=dict)
    doubted: dict[int, tuple[float, float]] = field(default_factory=dict)
    marched: dict[str, float] = field(default_factory=dict)
    memory: dict[str, float] = field(default_factory=dict)
    peaks: dict[str, float] = field(default_factory=dict)
    tallies: list[Tally] = field(default_factory=list)

    def steps(self) -> Iterator[tuple[str, Callable[[], None]]]:
        """What there is to measure, in order; each fills in a part of the case."""
        for at in range(self.effort.rounds):
            yield f"round {at + 1}", self._round
        yield "comparing", self._compare
        yield "40 digits", self._judge
        yield "memory", self._trace
        for steps in _STEPS:
            yield f"marching, {steps} a position", partial(self._march, f"{FIXED}, {steps} a position", steps)
        yield "marching, adaptive", partial(self._march, ADAPTIVE, 0)

    # ---------------------------------------------------------------------------------------------------- the methods

    @cached_property
    def train(self) -> GearTrain:
        """The train, loaded once for all that is not preparation."""
        return load(self.source)

    @cached_property
    def direct(self) -> Motion:
        """The motion that asks the laws themselves."""
        return self.train.motion(outputs=self.outputs)

    @cached_property
    def asked(self) -> dict[str, Ask]:
        """Each method that answers position by position: turns (n,) to errors (rad) of the outputs (outputs, n)."""
        return {method: self._ask(self.direct if method == DIRECT else None, method) for method in PER_POSITION}

    def _ask(self, built: Motion | None, method: str) -> Ask:
        if method in (NOMINAL, LAGGED):
            superposed = Superposition((built or self.direct).ahead)
            return partial(superposed.at, lagged=method == LAGGED)
        made = built or self.train.motion(outputs=self.outputs, tolerance=_tolerance(method))
        return lambda turns: made.ahead.at(turns).error

    @property
    def links(self) -> int:
        """Links that an error reaches and that an output hangs on."""
        return sum(len(step.links) for step in self.direct.ahead.steps)

    def stretches(self, positions: int) -> Iterator[Floats]:
        """The first of all positions, in stretches that fit in memory."""
        chunk, last = self.direct.ahead.chunk, self.effort.positions - 1
        for start in range(0, positions, chunk):
            yield self.turns * (np.arange(start, min(start + chunk, positions)) / last)

    def run(self, method: str, positions: int) -> Floats:
        """Greatest error by output over so many positions: nothing is kept of a stretch but that."""
        ask, most = self.asked[method], np.zeros(len(self.outputs))
        for turns in self.stretches(positions):
            most = np.maximum(most, np.abs(ask(turns)).max(axis=1))
        return most

    # --------------------------------------------------------------------------------------------------- measurements

    def _round(self) -> None:
        """Every method once, one after the other, so that ratios are of neighbours in time."""
        for method in PER_POSITION:
            self.asked[method](np.zeros(2))  # tables are made when first asked
        for method in PER_POSITION:
            self.prepared.setdefault(method, []).append(self._prepare(method))
            self.times.setdefault(method, []).append(_timed(partial(self.run, method, self.effort.positions)))
        for method in (BOUND, INDEPENDENT):
            _forget()
            built = load(self.source).motion(outputs=self.outputs)
            self.prepared.setdefault(method, []).append(_timed(partial(built.at, np.zeros(1))))
            self.times.setdefault(method, []).append(_timed(partial(_estimate, built, method)))

    def _prepare(self, method: str) -> float:
        """Seconds from the declaration to the first answer."""
        _forget()
        start = time.perf_counter()
        built = load(self.source).motion(outputs=self.outputs, tolerance=_tolerance(method))
        self._ask(built, method)(np.zeros(1))
        return time.perf_counter() - start

    def _compare(self) -> None:
        """All methods against the direct composition, over all positions."""
        self.tallies = self.direct.tallies()
        others = [method for method in PER_POSITION if method != DIRECT]
        self.off |= {method: _Off.none(len(self.outputs)) for method in others}
        for turns in self.stretches(self.effort.positions):
            passage = self.direct.ahead.at(turns)
            for at, tally in enumerate(self.tallies):
                tally.add(passage.error[at], passage.rate[at])
            for method in others:
                off = self.asked[method](turns) - passage.error
                self.off[method].add(off)
                if method == TABLES[-1]:
                    self._doubt(turns, np.abs(off))

    def _doubt(self, turns: Floats, off: Floats) -> None:
        """Remember where each output differs most between composition and the finest tables: one of them errs there."""
        for at, column in enumerate(off.argmax(axis=1)):
            self.doubted[at] = max(self.doubted.get(at, (0.0, 0.0)), (float(off[at, column]), float(turns[column])))

    def _judge(self) -> None:
        """The direct composition against the definition of its laws, at random and where tables differ most."""
        last = self.effort.positions - 1
        at = np.random.default_rng(3).integers(0, last + 1, self.effort.sample)
        turns = np.append(self.turns * (at / last), [turn for _, turn in self.doubted.values()])
        truth, found = Truth(self.direct), self.direct.ahead.at(turns).error
        self.off[DIRECT] = _Off.none(len(self.outputs))
        self.off[DIRECT].add(np.array([truth.off(float(each), found[:, n]) for n, each in enumerate(turns)]).T)

    def _trace(self) -> None:
        """Peaks of memory that positions take, by method, and of the direct composition by their number."""
        for method in PER_POSITION:
            self.memory[method] = _peak(partial(self.run, method, self.effort.positions))
        for share in (100, 10, 1):
            positions = self.effort.positions // share
            self.peaks[str(positions)] = _peak(partial(self.run, DIRECT, positions))

    def _march(self, method: str, steps: int) -> None:
        """March to the first positions, and compare there; the time is extrapolated to all."""
        marching = Marching(self.train, self.outputs)
        turns = np.concatenate(list(self.stretches(self.effort.marched)))
        start = time.perf_counter()
        error = marching.follow(turns, steps)
        took = time.perf_counter() - start
        self.off[method] = _Off.none(len(self.outputs))
        self.off[method].add(error - self.direct.at(turns).error)
        self.marched[method] = took * self.effort.positions / len(turns)

    # -------------------------------------------------------------------------------------------------------- results

    def rows(self) -> list[MotionRecord]:
        """A record for each method."""
        found = [self._scalar(BOUND), self._scalar(INDEPENDENT)]
        for method in (NOMINAL, LAGGED, *TABLES, DIRECT):
            at, greatest, rms = self.off[method].worst()
            times = (median(self.times[method]), self._ratio(method), median(self.prepared[method]))
            note = f"judged at {self.off[method].count} positions" if method == DIRECT else ""
            positions = self.effort.positions
            found.append(self._record(method, times, greatest, rms, at, self.memory[method], note, positions))
        return [*found, *(self._of_marching(method) for method in self.marched)]

    def _of_marching(self, method: str) -> MotionRecord:
        at, greatest, rms = self.off[method].worst()
        times = (self.marched[method], self.marched[method] / median(self.times[DIRECT]), None)
        note = f"extrapolated from {self.off[method].count} positions"
        return self._record(method, times, greatest, rms, at, None, note, self.effort.positions)

    def _scalar(self, method: str) -> MotionRecord:
        """A method that gives one number an output: the output on which it is farthest off."""
        values = getattr(Superposition(self.direct.ahead), "bounds" if method == BOUND else "independent")
        true = [tally.peak_to_peak if method == BOUND else tally.rms for tally in self.tallies]
        at = int(np.argmax(np.abs(np.array(values) - true)))
        off = math.degrees(abs(values[at] - true[at]))
        times = (median(self.times[method]), self._ratio(method), median(self.prepared[method]))
        note = f"{(values[at] / true[at] - 1) * 100:+.1f} % of its {'peak-to-peak' if method == BOUND else 'rms'}"
        error, rms = (off, None) if method == BOUND else (None, off)
        return self._record(method, times, error, rms, at, None, note, 0)

    def _record(
        self,
        method: str,
        times: tuple[float, float, float | None],
        error: float | None,
        rms: float | None,
        output: int,
        megabytes: float | None,
        note: str,
        positions: int,
    ) -> MotionRecord:
        seconds, ratio, prepared = times
        return MotionRecord(
            self.name,
            self.links,
            method,
            seconds,
            megabytes,
            error,
            note,
            rms,
            ratio,
            prepared,
            positions,
            self.outputs[output],
        )

    def _ratio(self, method: str) -> float:
        return median(own / base for own, base in zip(self.times[method], self.times[DIRECT], strict=True))

    def summary(self) -> TrainRecord:
        """What the train is and does."""
        lawful = {source.id for source in self.direct.ahead.sources}
        outputs = {
            tally.name: {"peak_to_peak": math.degrees(tally.peak_to_peak), "rms": math.degrees(tally.rms)}
            for tally in self.tallies
        }
        return TrainRecord(
            self.name,
            self.turns,
            self.effort.positions,
            self.links,
            [source.id for source in self.direct.ahead.used],
            [circuit.id for circuit in self.train.circuits if circuit.id not in lawful],
            outputs,
            self.peaks,
            self.effort.sample,
        )


def _tolerance(method: str) -> float | None:
    name, _, tolerance = method.partition(", ")
    return float(tolerance) if name == TABULATED else None


def _estimate(built: Motion, method: str) -> list[float]:
    superposed = Superposition(built.ahead)
    return superposed.bounds if method == BOUND else superposed.independent


def _peak(task: Callable[[], Any]) -> float:
    """Most memory (MB) that a task has at once beyond what is there before it."""
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    try:
        task()
        return (tracemalloc.get_traced_memory()[1] - before) / 2**20
    finally:
        tracemalloc.stop()


# ------------------------------------------------------------------------------------------------------------- growth


def chain_of_pairs(pairs: int, seed: int = 1) -> dict[str, Any]:
    """An ordinary train of so many pairs with triangular teeth, two wheels on each arbor, the whole ratio near 1.

    Of each pair drawn, the wheel drives that brings the ratio back. Ten tooth numbers make a hundred kinds of pairs.
    """
    draw, log = random.Random(seed), 0.0
    links: dict[str, Any] = {"frame": {}, "g0": {"wheels": {}}}
    gears = []
    for at in range(1, pairs + 1):
        driver, driven = draw.randrange(40, 80, 4), draw.randrange(40, 80, 4)
        if (driver > driven) == (log > 0):
            driver, driven = driven, driver
        log += math.log(driver / driven)
        links[f"g{at - 1}"]["wheels"][f"a{at}"] = driver
        links[f"g{at}"] = {"wheels": {f"b{at}": driven}}
        gears.append({"pair": (f"a{at}", f"b{at}")})
    return {
        "links": links,
        "revolutes": [{"pair": ("frame", f"g{at}"), "axis": f"A{at}"} for at in range(pairs + 1)],
        "gears": gears,
        "inputs": {"g0": 1},
        "outputs": {f"g{pairs}": {}},
        "tooth_form": _TEETH,
    }


def _grown(pairs: int, rounds: int) -> GrowthRecord:
    """Preparation and run of a chain; the medians of some rounds, fewer where they take more than half a minute."""
    found: list[GrowthRecord] = []
    start = time.perf_counter()
    while len(found) < rounds and (not found or (time.perf_counter() - start) * (1 + 1 / len(found)) < 30):
        found.append(_grow(pairs))
    medians = {key: median(getattr(each, key) for each in found) for key in _TIMES}
    return GrowthRecord(pairs, _GROWN, found[0].chunk, **medians)


_TIMES = ("declared", "windows", "prepared", "seconds")


def _grow(pairs: int) -> GrowthRecord:
    _forget()
    data = chain_of_pairs(pairs)
    marks = [time.perf_counter()]
    train = GearTrain.declare(data)
    _ = train.circuits
    marks.append(time.perf_counter())
    _ = train.meshes
    marks.append(time.perf_counter())
    built = train.motion()
    built.at(np.zeros(1))
    marks.append(time.perf_counter())
    for _passage in built.passages(1.0, _GROWN):
        pass
    marks.append(time.perf_counter())
    took = dict(zip(_TIMES, np.diff(marks).tolist(), strict=True))
    return GrowthRecord(pairs, _GROWN, built.ahead.chunk, **took)
