"""A composition as plain arrays, as its kernel reads it: the solved order, its sources, their laws as tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.fed_back_law import FedBackLaw
from geartrain.numerics.error_free import split
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.transmission_kernel import join_transmission_tables, make_transmission_table

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import CompositionStep, ErrorComposition
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission_kernel import TransmissionTable, TransmissionTables


class CompositionOrder(NamedTuple):
    """The solved order, step by step. Links stand in rows, which later links take again; ranges begin at `..._start`.

    own           rows of the links of a step
    known         rows of the links that they follow, by `from_known`, (own, known) flat
    sources       numbers of the first source of a step, and one beyond the last; by `from_sources`, (own, sources) flat
    seen          of each output: rows of the links of which it is the sum, with their signs
    offset        what each output is ahead at every position (rad)
    """

    own_start: Ints
    own: Ints
    known_start: Ints
    known: Ints
    from_known_start: Ints
    from_known: Floats
    sources: Ints
    from_sources_start: Ints
    from_sources: Floats
    seen_start: Ints
    seen: Ints
    seen_sign: Floats
    offset: Floats


class ComposedSources(NamedTuple):
    """The sources in the order of the steps; the number of one is that of its law.

    factor, high, low, rest   cycles per turn of the input: as a float, that as a sum of two halves, and what it lacks
    start, mean               forward angle (rad) and mean speed of the driver
    row, sign                 (sources, 2): driver and carrier, row -1 where no error reaches one
    sense, ratio              of the driven side, and of the law
    gain                      what the source adds to its own driver, where its law is a `FedBackLaw`, else 0
    """

    factor: Floats
    high: Floats
    low: Floats
    rest: Floats
    start: Floats
    mean: Floats
    row: Ints
    sign: Floats
    sense: Floats
    ratio: Floats
    gain: Floats


class CompositionArrays(NamedTuple):
    """All that the kernel reads; `rows` of links are kept at once, `most` sources stand in one step."""

    order: CompositionOrder
    sources: ComposedSources
    laws: TransmissionTables
    rows: int
    most: int


def make_composition_arrays(composition: ErrorComposition) -> CompositionArrays | None:
    """The arrays of a composition; None where a law is not read from tables, or pairs turn each other's drivers."""
    laws: list[TransmissionTable | None] = []
    gains: list[float] = []
    for step in composition.steps:
        if step.coupled and len(step.sources) > 1:
            return None
        own = _fed_back(composition, step) if step.coupled else None
        if step.coupled and own is None:
            return None
        gains += [0.0 if own is None else float(composition.gain(step)[0, 0])] * len(step.sources)
        laws += [own] if own else [make_transmission_table(composition.sources[at].law) for at in step.sources]
    tables = [law for law in laws if law is not None]
    if len(tables) < len(laws):
        return None
    most = max((len(step.sources) for step in composition.steps), default=0)
    return CompositionArrays(
        _order(composition),
        _sources(composition, gains),
        join_transmission_tables(tables),
        composition.rows,
        most,
    )


def _fed_back(composition: ErrorComposition, step: CompositionStep) -> TransmissionTable | None:
    """The table of a pair that moves its own driver; None where it has none, or may come to a dead centre."""
    (source,) = (composition.sources[at] for at in step.sources)
    law = FedBackLaw(source.law, source.sense, float(composition.gain(step)[0, 0]))
    changing = type(source.law).picked is not TransmissionFunction.picked
    return make_transmission_table(law) if law.goes_on and not changing else None


def _order(composition: ErrorComposition) -> CompositionOrder:
    steps, place = composition.steps, composition.place
    own = _ranges([[place[link] for link in step.links] for step in steps])
    known = _ranges([[place[link] for link in step.known] for step in steps])
    from_known = _matrices([step.from_known for step in steps])
    from_sources = _matrices([step.from_sources for step in steps])
    seen = [
        [(place[link], sign) for link, sign in ((each.of, 1), (each.base, -each.sense)) if link in place]
        for each in composition.outputs
    ]
    return CompositionOrder(
        *own,
        *known,
        *from_known,
        _starts(len(step.sources) for step in steps),
        *from_sources,
        *_ranges([[row for row, _ in each] for each in seen]),
        np.array([float(sign) for each in seen for _, sign in each]),
        np.array(composition.offsets or (0.0,) * len(composition.outputs)),
    )


def _sources(composition: ErrorComposition, gains: Sequence[float]) -> ComposedSources:
    used, place = composition.used, composition.place
    factor = np.array([float(source.cycles) for source in used])
    ends = [composition.turned_by(source) for source in used]
    return ComposedSources(
        factor,
        *split(factor),
        np.array([float(source.cycles - Fraction(float(source.cycles))) for source in used]),
        np.array([source.start for source in used]),
        np.array([source.mean for source in used]),
        np.array([[place.get(link, -1) for link, _ in each] for each in ends], dtype=np.int64).reshape(-1, 2),
        np.array([[float(sign) for _, sign in each] for each in ends]).reshape(-1, 2),
        np.array([float(source.sense) for source in used]),
        np.array([float(source.law.ratio) for source in used]),
        np.array(gains, dtype=float),
    )


def _starts(counts: Iterable[int]) -> Ints:
    return np.cumsum([0, *counts], dtype=np.int64)


def _ranges(lists: Sequence[Sequence[int]]) -> tuple[Ints, Ints]:
    flat = [each for part in lists for each in part]
    return _starts(len(part) for part in lists), np.array(flat, dtype=np.int64)


def _matrices(matrices: Sequence[Floats]) -> tuple[Ints, Floats]:
    return _starts(each.size for each in matrices), np.concatenate([np.zeros(0), *(each.ravel() for each in matrices)])
