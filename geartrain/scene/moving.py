"""How a scene moves: exact speeds, and the errors of teeth and pins as tables and steps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.scene.result import Law, Movement, Source, Step
from geartrain.scene.stage import Stage

if TYPE_CHECKING:
    from geartrain.motion import Composition, Motion
    from geartrain.motion.composition import Step as Composed
    from geartrain.teeth.base import Floats
    from geartrain.teeth.base import Law as ToothLaw

TOLERANCE = 1e-11  # of a driven pitch
_DEGREES = (7, 9, 11, 14)  # tried in turn: the smallest table wins
_TRIED = 257  # positions at which pairs that hang on each other are tried


@dataclass(frozen=True, slots=True)
class Setting:
    """How a pair that ripples stands at the beginning.

    driver    its link; `forward` 1, or -1 where it turns against its body's direction
    S, error  its forward angle, and the error of the driven side there (rad)
    """

    driver: str
    forward: int
    S: float
    error: float


@dataclass(frozen=True, slots=True)
class Moved:
    """The movement, and the pose at its beginning.

    rest     angle A of each link about its body's direction after no turn (rad)
    driving  by pair or coupling that ripples
    """

    movement: Movement
    rest: Mapping[str, float]
    driving: Mapping[str, Setting] = field(default_factory=dict)
    motion: Motion | None = None
    notices: tuple[Problem, ...] = ()


def find_movement(stage: Stage) -> Moved:
    """The movement of a train in its state; never an error: what cannot be followed moves in the mean, and says why."""
    if not stage.answer.verdict or stage.lead is None:
        why = stage.answer.verdict.text if not stage.answer.verdict else "nothing drives it"
        return Moved(Movement("still", why, period=None), _started(stage))
    if stage.unbuilt:
        return _in_the_mean(stage, stage.unbuilt)
    if all(mesh.rigid for mesh in stage.meshes) and not stage.train.pins:
        return Moved(Movement("exact", period=_text(_period(stage, ()))), _started(stage))
    try:
        motion = stage.train.motion(stage.answer.state, tuple(stage.train.declaration.links))
        return _followed(stage, motion)
    except GearTrainError as error:
        return _in_the_mean(stage, error.problems)


def _started(stage: Stage) -> dict[str, float]:
    return {link: stage.sense(link) * stage.start(link) for link in stage.train.declaration.links}


def _in_the_mean(stage: Stage, problems: Sequence[Problem]) -> Moved:
    first = problems[0]
    movement = Movement("mean", f"{first.what}: {first.why}" if first.why else first.what, _text(_period(stage, ())))
    return Moved(movement, _started(stage), notices=tuple(problems))


def _followed(stage: Stage, motion: Motion) -> Moved:
    import numpy as np

    composition = motion.ahead
    if not composition.sources:
        return Moved(Movement("exact", period=_text(_period(stage, ()))), _started(stage), motion=motion)
    if any(step.coupled for step in composition.steps):
        motion.at(np.linspace(0, float(motion.period or 1), _TRIED))  # past a dead centre this raises
    error = motion.at(np.zeros(1)).error[:, 0]
    links = tuple(stage.train.declaration.links)
    rest = {
        link: stage.sense(link) * (stage.start(link) + float(each)) for link, each in zip(links, error, strict=True)
    }
    own = error - np.array(composition.offsets) if composition.offsets else error
    driving = dict(_settings(composition, own))
    cycles = [source.cycles for source in composition.sources]
    laws, sources = _laws_and_sources(composition)
    movement = Movement(
        "real",
        period=_text(_period(stage, cycles)),
        laws=laws,
        sources=sources,
        steps=tuple(_step(step) for step in composition.steps),
        offsets={link: each for link, each in zip(links, composition.offsets, strict=False) if each},
    )
    return Moved(movement, rest, driving, motion)


def _settings(composition: Composition, error: Floats) -> Iterator[tuple[str, Setting]]:
    for source in composition.sources:
        S = source.start + composition.driver_shift(source, error)
        driver = composition.spread.links[composition.spread.joints[source.pair].driver]
        yield source.id, Setting(driver, source.forward, S, float(source.law.error(S)))


def _step(step: Composed) -> Step:
    return Step(
        bodies=step.links,
        known=step.known,
        from_known=step.from_known.tolist(),
        sources=step.sources,
        from_sources=step.from_sources.tolist(),
        coupled=step.coupled,
    )


def _laws_and_sources(composition: Composition) -> tuple[tuple[Law, ...], tuple[Source, ...]]:
    """Every source with its law; pairs alike share one."""
    laws: dict[tuple[float, bytes, bytes], Law] = {}
    numbers: dict[tuple[float, bytes, bytes], int] = {}
    sources = []
    for source in composition.sources:
        law = tabulated(source.id, source.law)
        key = law.period, law.breaks.tobytes(), law.coefficients.tobytes()
        laws.setdefault(key, law)
        joint = composition.spread.joints[source.pair]
        sources.append(
            Source(
                pair=source.id,
                law=numbers.setdefault(key, len(numbers)),
                driver=joint.driver,
                carrier=joint.carrier,
                driver_sense=source.driver_sense,
                carrier_sense=source.carrier_sense,
                cycles=str(source.cycles),
                start=source.start,
                forward=source.forward,
                sense=source.sense,
            )
        )
    return tuple(laws.values()), tuple(sources)


def tabulated(pair: str, law: ToothLaw) -> Law:
    """The error of a law as polynomials within `TOLERANCE` of a driven pitch, in the fewest numbers."""
    import numpy as np

    from geartrain.teeth.table import Tabulated

    tables = (Tabulated(law, TOLERANCE, degree).error_table for degree in _DEGREES)
    pitch = (float(law.ratio) or 1.0) * law.period
    # where rounding keeps all tables from the tolerance, the nearest one
    table = min(tables, key=lambda each: (max(each.uncertainty / pitch, TOLERANCE), each.coefficients.size))
    breaks = np.sort(np.concatenate((np.arange(table.cells + 1) * (law.period / table.cells), table.corners)))
    breaks[-1] = law.period
    wide = np.diff(breaks) > 0
    return Law(
        pair,
        law.period,
        np.append(breaks[:-1][wide], law.period),
        np.ascontiguousarray(table.coefficients.T[wide]),
        table.uncertainty,
    )


def _period(stage: Stage, cycles: Iterable[Fraction]) -> Fraction | None:
    """Turns of the lead after which all bodies and laws stand as before; None where nothing moves."""
    ratios = [ratio for link in stage.train.declaration.links if (ratio := stage.ratio(link))]
    rates = [abs(rate) for rate in (*ratios, *cycles) if rate]
    if not rates:
        return None
    return Fraction(lcm(*(rate.denominator for rate in rates)), gcd(*(rate.numerator for rate in rates)))


def _text(value: Fraction | None) -> str | None:
    return None if value is None else str(value)
