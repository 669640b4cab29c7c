"""Motion of a scene: exact speeds, and the errors of teeth and pins as tables and steps that a page can carry.

Angles differ from their exact means by transmission errors: tables of the functions of teeth and pins, and the steps of
their sum.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING, ClassVar

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.arrays import packed
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Key, Result, Shown, plain
from geartrain.scene.context import SceneContext

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.dynamics.motion.error_composition import CompositionStep as Composed
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction as ToothTransmission


# ----------------------------------------------------------------------------------------------------- tables and steps


@dataclass(frozen=True, slots=True)
class ErrorTable(Result):
    """The periodic error of a gear pair or a pin in a slot, as polynomials between breaks.

    See Also
    --------
    Movement : holds it.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        "pair",
        "period",
        Key("breaks", "packed_breaks"),
        Key("coefficients", "packed_coefficients"),
        "uncertainty",
    )

    pair: str
    """The pair, the first of those that share the law."""
    period: float
    """Of the driver's angle [rad]."""
    breaks: Floats
    """Of the driver's angle, from 0 to the period [rad]. Shape (n + 1,)."""
    coefficients: Floats
    """Of the driven side's error [rad], in powers of the driver's angle less the middle of its cell. Shape (n,
    degree + 1)."""
    uncertainty: float
    """Greatest error of the table [rad]."""

    @property
    def packed_breaks(self) -> str:
        """The breaks as a page carries them."""
        return packed(self.breaks)

    @property
    def packed_coefficients(self) -> str:
        """The coefficients as a page carries them, row by row."""
        return packed(self.coefficients)


@dataclass(frozen=True, slots=True)
class ErrorSource(Shown):
    """A pair whose law adds to the errors of a scene.

    After t turns of the lead the driver's forward angle is

        S = start + period frac(cycles t) + forward (driver_sense error[driver] - carrier_sense error[carrier])

    and the pair adds sense law(S) to what it drives.

    See Also
    --------
    Movement : holds it.
    """

    pair: str
    """Name of the gear pair or coupling."""
    transmission: int
    """Index of its law in the movement."""
    driver: int
    """Index of the driving body."""
    carrier: int
    """Index of the body that carries the pair."""
    driver_sense: int
    """1 or -1: how the error of the driver counts in the pair's own sense."""
    carrier_sense: int
    """1 or -1: how the error of the carrier counts in the pair's own sense."""
    cycles: str
    """Periods of the law in a turn of the lead, exact."""
    start: float
    """S at the start [rad]."""
    forward: int
    """1 or -1: the sense in which the driver turns."""
    sense: int
    """1 or -1: the sign with which the law counts."""


@dataclass(frozen=True, slots=True)
class ErrorStep(Shown):
    """Errors of some bodies from those known: error[bodies] = from_known error[known] + from_sources delta[sources].

    See Also
    --------
    Movement : holds it.
    """

    bodies: Sequence[int]
    """Indices of the bodies found in this step."""
    known: Sequence[int]
    """Indices of the bodies from steps before that it takes."""
    from_known: Sequence[Sequence[float]]
    """Coefficients of the known bodies, a row for each body found."""
    sources: Sequence[int]
    """Indices of sources."""
    from_sources: Sequence[Sequence[float]]
    """Coefficients of the sources, a row for each body found."""
    coupled: bool
    """True where sources depend on the bodies found: they are found together, by iteration."""


@dataclass(frozen=True, slots=True)
class Movement(Shown):
    """How errors of angles follow from the turns of the lead: the steps in order, then constant offsets.

    See Also
    --------
    make_scene : gives it, in `Scene.movement`.
    """

    kind: str
    """Nothing ripples; teeth or pins ripple; they would, but cannot be followed; no speed is determined."""
    why: str = ""
    """Why it is mean or still."""
    period: str | None = None
    """Turns of the lead after which all stands as before, exact; None where nothing repeats."""
    transmissions: Sequence[ErrorTable] = ()
    """Laws, those of pairs alike once."""
    sources: Sequence[ErrorSource] = ()
    """The pairs that have them."""
    steps: Sequence[ErrorStep] = ()
    """In the order in which they can be taken."""
    offsets: Mapping[str, float] = field(default_factory=dict)
    """Constant errors by the index of the body [rad]."""


TOLERANCE = 1e-11  # of a driven pitch
_DEGREES = (7, 9, 11, 14)  # tried in turn: the smallest table wins


def step_of(step: Composed) -> ErrorStep:
    """A step of a composition in plain numbers."""
    return ErrorStep(
        bodies=step.links,
        known=step.known,
        from_known=step.from_known.tolist(),
        sources=step.sources,
        from_sources=step.from_sources.tolist(),
        coupled=step.coupled,
    )


def laws_and_sources(
    composition: ErrorComposition, way: int = 1
) -> tuple[tuple[ErrorTable, ...], tuple[ErrorSource, ...]]:
    """Every source with its law; pairs alike share one.

    way   -1 where the lead turns backwards: a composition counts in the lead's sense, a scene about declared axes
    """
    transmissions: dict[tuple[float, bytes, bytes], ErrorTable] = {}
    numbers: dict[tuple[float, bytes, bytes], int] = {}
    sources = []
    for source in composition.sources:
        transmission = tabulated(source.id, source.transmission)
        # bit by bit: laws that differ only by rounding come from pairs that are not alike
        key = transmission.period, transmission.breaks.tobytes(), transmission.coefficients.tobytes()
        transmissions.setdefault(key, transmission)
        joint = composition.spread.joints[source.pair]
        sources.append(
            ErrorSource(
                pair=source.id,
                transmission=numbers.setdefault(key, len(numbers)),
                driver=joint.driver,
                carrier=joint.carrier,
                driver_sense=source.driver_sense,
                carrier_sense=source.carrier_sense,
                cycles=fraction_text(way * source.cycles),
                start=source.start,
                forward=way * source.forward,
                sense=way * source.sense,
            )
        )
    return tuple(transmissions.values()), tuple(sources)


def tabulated(pair: str, transmission: ToothTransmission) -> ErrorTable:
    """The error of a law as polynomials within `TOLERANCE` of a driven pitch, in the fewest numbers."""
    import numpy as np

    from geartrain.teeth.transmission_table import TabulatedTransmission

    tables = (TabulatedTransmission(transmission, TOLERANCE, degree).error_table for degree in _DEGREES)
    pitch = (float(transmission.ratio) or 1.0) * transmission.period
    # where rounding keeps all tables from the tolerance, the nearest one
    table = min(tables, key=lambda each: (max(each.uncertainty / pitch, TOLERANCE), each.coefficients.size))
    # corners, where the error has a kink, part cells: no polynomial runs across one
    breaks = np.sort(np.concatenate((np.arange(table.cells + 1) * (transmission.period / table.cells), table.kinks)))
    breaks[-1] = transmission.period  # not cells times a quotient, which rounds
    wide = np.diff(breaks) > 0  # a corner on the border of a cell leaves none between
    return ErrorTable(
        pair,
        transmission.period,
        np.append(breaks[:-1][wide], transmission.period),
        np.ascontiguousarray(table.coefficients.T[wide]),
        table.uncertainty,
    )


# --------------------------------------------------------------------------------------------------------- from a train


_TRIED_ERRORS = 720  # angles of a driver at which a law is compared with itself
_TRIED = 257  # positions at which pairs that depend on each other are tried


@dataclass(frozen=True, slots=True)
class InitialPosition:
    """How a pair that ripples stands at the beginning."""

    driver: str
    """Its link; `forward` 1, or -1 where it turns against its body's direction."""
    forward: int
    S: float
    """Its forward angle, and the error of the driven side there (rad)."""
    error: float
    """Its forward angle, and the error of the driven side there (rad)."""
    transmission: ToothTransmission
    """Of the pair."""

    def error_past(self, shift: float) -> float:
        """The least error (rad) with which a driven tooth that moves by this law is never cut by its driver's, where
        these stand `shift` (rad) before it.

        The driven side then keeps e(S) + c, its mate asks for e(S + shift), and c is the most by which that is more.
        """
        import numpy as np

        S = self.transmission.period * np.arange(_TRIED_ERRORS) / _TRIED_ERRORS
        return self.error + float((self.transmission.error(S + shift) - self.transmission.error(S)).max())


@dataclass(frozen=True, slots=True)
class MovementStart:
    """The movement, and the pose at its beginning."""

    movement: Movement
    rest: Mapping[str, float]
    """Angle A of each link about its body's direction after no turn (rad)."""
    driving: Mapping[str, InitialPosition] = field(default_factory=dict)
    """By pair or coupling that ripples."""
    motion: Motion | None = None
    notices: tuple[Problem, ...] = ()
    back: Movement | None = None
    """The movement against the declared sense of the lead, on the other flanks; None where it is the same."""


def find_movement(stage: SceneContext) -> MovementStart:
    """The movement of a train in its state; never an error: what cannot be followed moves in the mean, and says why."""
    if not stage.answer.verdict or stage.driving_link is None:
        why = stage.answer.verdict.text if not stage.answer.verdict else "nothing drives it"
        return MovementStart(Movement("still", why, period=None), _started(stage))
    if stage.unbuilt:
        return _in_the_mean(stage, stage.unbuilt)
    if not stage.meshes and not stage.train.mechanics.pins:
        return MovementStart(Movement("exact", period=_text(_period(stage, ()))), _started(stage))
    try:
        motion = stage.train.motion(stage.answer.state, tuple(stage.train.declaration.links))
        return _followed(stage, motion)
    except GearTrainError as error:
        return _in_the_mean(stage, error.problems)


def _started(stage: SceneContext) -> dict[str, float]:
    return {link: stage.sense(link) * stage.start(link) for link in stage.train.declaration.links}


def _in_the_mean(stage: SceneContext, problems: Sequence[Problem]) -> MovementStart:
    first = problems[0]
    movement = Movement("mean", f"{first.what}: {first.why}" if first.why else first.what, _text(_period(stage, ())))
    return MovementStart(movement, _started(stage), notices=tuple(problems))


def _followed(stage: SceneContext, motion: Motion) -> MovementStart:
    import numpy as np

    composition = motion._forward
    _try(composition, float(motion.period or 1))
    error, way = composition.at(np.zeros(1)).error[:, 0], motion._problem.way
    links = tuple(stage.train.declaration.links)
    rest = {
        link: stage.sense(link) * (stage.start(link) + way * float(each))
        for link, each in zip(links, error, strict=True)
    }
    driving = dict(_settings(composition, way))
    movement = _written(stage, composition, way)
    back, notices = _backward(stage, motion, movement)
    return MovementStart(movement, rest, driving, motion, notices, back)


def _try(composition: ErrorComposition, turns: float) -> None:
    """Raises `GearTrainError` where pairs that depend on each other have no common position."""
    import numpy as np

    if any(step.coupled for step in composition.steps):
        composition.at(np.linspace(0, turns, _TRIED))  # past a dead centre this raises


def _backward(stage: SceneContext, motion: Motion, ahead: Movement) -> tuple[Movement | None, tuple[Problem, ...]]:
    """How errors follow where the lead turns back, if otherwise than ahead; and why they cannot be followed."""
    try:
        composition = motion._backward
        _try(composition, -float(motion.period or 1))
        back = _written(stage, composition, motion._problem.way)
    except GearTrainError as error:
        mean = _in_the_mean(stage, error.problems)
        return mean.movement, mean.notices
    return (None if plain(back) == plain(ahead) else back), ()


def _written(stage: SceneContext, composition: ErrorComposition, way: int) -> Movement:
    """Exact where nothing ripples: teeth that keep their ratio may still have play, and then their offsets stand."""
    transmissions, sources = laws_and_sources(composition, way)
    links = tuple(stage.train.declaration.links)
    return Movement(
        "real" if sources else "exact",
        period=_text(_period(stage, [source.cycles for source in composition.sources])),
        transmissions=transmissions,
        sources=sources,
        steps=tuple(step_of(step) for step in composition.steps),
        offsets={link: way * each for link, each in zip(links, composition.offsets, strict=False) if each},
    )


def _settings(composition: ErrorComposition, way: int) -> Iterator[tuple[str, InitialPosition]]:
    for source in composition.sources:
        S = source.phase
        driver = composition.spread.links[composition.spread.joints[source.pair].driver]
        yield (
            source.id,
            InitialPosition(driver, way * source.forward, S, float(source.transmission.error(S)), source.transmission),
        )


def _period(stage: SceneContext, cycles: Iterable[Fraction]) -> Fraction | None:
    """Turns of the lead after which all bodies and laws stand as before; None where nothing moves."""
    ratios = [ratio for link in stage.train.declaration.links if (ratio := stage.ratio(link))]
    rates = [abs(rate) for rate in (*ratios, *cycles) if rate]
    if not rates:
        return None
    return Fraction(lcm(*(rate.denominator for rate in rates)), gcd(*(rate.numerator for rate in rates)))


def _text(value: Fraction | None) -> str | None:
    return None if value is None else fraction_text(value)
