"""Motion of a scene: exact speeds, tables of the transmission errors of teeth and pins, and steps that combine them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Result, Shown, plain
from geartrain.scene.context import SceneContext, packed_key

if TYPE_CHECKING:
    from geartrain.dynamics import Motion
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction as ToothTransmission


# ----------------------------------------------------------------------------------------------------- tables and steps


@dataclass(frozen=True, slots=True)
class ErrorTable(Result):
    """Periodic transmission error of a gear pair or of a pin in a slot, as piecewise polynomials."""

    KEYS = ("pair", "period", packed_key("breaks"), packed_key("coefficients"), "uncertainty")

    pair: str
    """Name of the first gear pair or coupling that has this transmission error."""
    period: float
    """Period of the transmission error, as an angle of the driver [rad]."""
    breaks: Floats
    """Breakpoints of the polynomials, as angles of the driver from 0 to the period [rad]. Shape (n + 1,)."""
    coefficients: Floats
    """Coefficients of the polynomials that give the angular error of the driven link [rad]. Shape (n, degree + 1).

    The coefficients multiply powers of the driver's angle minus the middle of the interval that contains it.
    """
    uncertainty: float
    """Maximum deviation of the table from the transmission error that it represents [rad]."""


@dataclass(frozen=True, slots=True)
class ErrorSource(Shown):
    """Gear pair or coupling whose transmission error contributes to the angular errors of the bodies in a scene.

    After t turns of the driving link the driver's forward angle is

        S = start + period frac(cycles t) + from_known delta[known] + own delta[sources]

    with `start`, `period` and `cycles` of the source, and `from_known`, `known`, `own` and `sources` of the step that
    contains it (`ErrorStep`). The error of the pair is delta = sense e(S), where e is the transmission error of the
    table, and every body in `bodies` has this error multiplied by its weight.
    """

    pair: str
    """Name of the gear pair or coupling."""
    transmission: int
    """Index of the pair's error table in `Movement.transmissions`."""
    cycles: str
    """Exact number of error periods per turn of the driving link; negative if the driver turns backwards."""
    start: float
    """Forward angle S of the driver at the start if all errors are 0 [rad]."""
    sense: int
    """Sense of the driven link's mean motion relative to the carrier, 1 or -1."""
    bodies: Sequence[int]
    """Indices of the bodies that the error of the pair moves."""
    weights: Sequence[float]
    """Derivative of the angular error of each body in `bodies` with respect to the error of the pair [rad/rad]."""


@dataclass(frozen=True, slots=True)
class ErrorStep(Shown):
    """Step in the calculation of errors: it computes the errors of some pairs from those computed in earlier steps."""

    sources: Sequence[int]
    """Indices of the sources whose errors are computed in this step."""
    known: Sequence[int]
    """Indices of the earlier sources whose errors move the drivers of this step."""
    from_known: Sequence[Sequence[float]]
    """Derivatives of the driver angles S with respect to the known errors [rad/rad]; one row per source, one column per
    known error.
    """
    own: Sequence[Sequence[float]]
    """Derivatives of the driver angles S with respect to the errors of this step [rad/rad], one row per source.

    It is empty if the errors of this step do not move its drivers. If it is not empty, the errors are computed by
    iteration.
    """


@dataclass(frozen=True, slots=True)
class Movement(Shown):
    """Motion of a scene: the angular errors of bodies as functions of the turns of the driving link.

    The steps are evaluated in order, and constant offsets are then added.
    """

    kind: str
    """Kind of motion: `exact`, `real`, `mean` or `still`.

    `exact`: ratios are constant. `real`: teeth or pins have transmission errors. `mean`: the mean motion is shown,
    because transmission errors cannot be computed. `still`: no speed is determined.
    """
    why: str = ""
    """Reason why the kind of motion is `mean` or `still`; empty for the other kinds."""
    period: str | None = None
    """Exact number of turns of the driving link after which the pose repeats; None if it does not repeat."""
    transmissions: Sequence[ErrorTable] = ()
    """Tables of transmission errors; identical pairs share one table."""
    sources: Sequence[ErrorSource] = ()
    """Gear pairs and couplings with transmission errors, to which `steps` refer by index."""
    steps: Sequence[ErrorStep] = ()
    """Steps that compute the angular errors, in the order of their evaluation."""
    offsets: Mapping[str, float] = field(default_factory=dict)
    """Constant error of the angle of a link [rad], by link."""


TOLERANCE = 1e-9  # maximum error of a table in driven pitches; the page displays hundredths of a degree
_DEGREES = (3, 5, 7, 9, 11, 14)  # degrees of polynomials, of which the smallest table is used


def tables_and_sources(
    composition: ErrorComposition, way: int = 1
) -> tuple[tuple[ErrorTable, ...], tuple[ErrorSource, ...]]:
    """Return the error tables, and the error sources that refer to them; pairs with equal functions share a table.

    way   1, or -1 if the driving link turns backwards about its declared axis
    """
    transmissions: dict[tuple[float, bytes, bytes], ErrorTable] = {}
    sources = []
    for source in composition.sources:
        transmission = tabulated(source.id, source.transmission)
        # compared bit by bit: functions that differ due to rounding errors come from different pairs
        key = transmission.period, transmission.breaks.tobytes(), transmission.coefficients.tobytes()
        transmissions.setdefault(key, transmission)
        response = way * composition.spread.response[:, source.pair]
        bodies = response.nonzero()[0]
        sources.append(
            ErrorSource(
                pair=source.id,
                transmission=list(transmissions).index(key),
                cycles=fraction_text(way * source.cycles),
                start=source.start,
                sense=source.sense,
                bodies=bodies.tolist(),
                weights=response[bodies].tolist(),
            )
        )
    return tuple(transmissions.values()), tuple(sources)


def tabulated(pair: str, transmission: ToothTransmission) -> ErrorTable:
    """Return a pair's transmission error as the smallest table of polynomials accurate to `TOLERANCE` [pitches]."""
    import numpy as np

    from geartrain.teeth.transmission_table import fit, folded_kinks

    # a follower that swings has mean ratio 0: its tolerance is relative to the period of the driver
    ratio = float(transmission.ratio) or 1.0
    pitch, kinks = ratio * transmission.period, folded_kinks(transmission)
    fine = TOLERANCE * ratio * transmission.pitch
    tables = [fit(transmission.error, transmission.period, kinks, fine, degree) for degree in _DEGREES]
    # if rounding errors keep all tables above the tolerance, the most accurate one is used
    table = min(tables, key=lambda each: (max(each.uncertainty / pitch, TOLERANCE), each.coefficients.size))
    # cells are split at kinks, because a polynomial must not cross one
    breaks = np.sort(np.concatenate((np.arange(table.cells + 1) * (transmission.period / table.cells), table.kinks)))
    breaks[-1] = transmission.period  # exact, unlike cells times a quotient
    wide = np.diff(breaks) > 0  # a kink on the border of a cell gives an empty cell
    return ErrorTable(
        pair,
        transmission.period,
        np.append(breaks[:-1][wide], transmission.period),
        np.ascontiguousarray(table.coefficients.T[wide]),
        table.uncertainty,
    )


# --------------------------------------------------------------------------------------------------------- from a train


_TRIED_ERRORS = 720  # angles of a driver at which a transmission error is compared with its shifted copy
_TRIED = 257  # positions at which coupled pairs are tested


@dataclass(frozen=True, slots=True)
class InitialPosition:
    """Initial position of a gear pair or coupling with a transmission error."""

    driver: str
    """Name of the driving link."""
    forward: int
    """1 if the driving link turns about the direction of its body, -1 if it turns against it."""
    S: float
    """Forward angle of the driver [rad]."""
    error: float
    """Transmission error of the driven link at the driver's angle S [rad]."""
    transmission: ToothTransmission

    def error_past(self, shift: float) -> float:
        """Return the minimum error [rad] with which the driven link clears a driver that leads by `shift` [rad]."""
        import numpy as np

        S = self.transmission.period * np.arange(_TRIED_ERRORS) / _TRIED_ERRORS
        # the driven link has the error e(S) + c, and the driver requires e(S + shift): c is the largest difference
        return self.error + float((self.transmission.error(S + shift) - self.transmission.error(S)).max())


@dataclass(frozen=True, slots=True)
class MovementStart:
    """Movement of a scene, with the initial angles of all links and the initial positions of all pairs."""

    movement: Movement
    rest: Mapping[str, float]
    """Initial angle A of each link about the direction of its body [rad]."""
    driving: Mapping[str, InitialPosition] = field(default_factory=dict)
    """Initial position of each pair or coupling that has a transmission error, by name."""
    notices: tuple[Problem, ...] = ()
    back: Movement | None = None
    """Movement on the coast flanks, when the driving link is reversed; None if it equals the forward movement."""


def find_movement(stage: SceneContext) -> MovementStart:
    """Return the movement in a state; its kind is `still` without a determined speed, `mean` without known errors."""
    if not stage.answer.verdict or stage.driving_link is None:
        why = stage.answer.verdict.text if not stage.answer.verdict else "nothing drives it"
        return MovementStart(Movement("still", why, period=None), _starting_angles(stage))
    if stage.unbuilt:
        return _mean_movement(stage, stage.unbuilt)
    if not stage.meshes and not stage.train.mechanics.couplings:
        return MovementStart(Movement("exact", period=_text(_period(stage, ()))), _starting_angles(stage))
    try:
        motion = stage.train.motion(stage.answer.state, tuple(stage.train.declaration.links))
        return _followed(stage, motion._with_angles(stage.set_angles) if stage.set_angles else motion)
    except GearTrainError as error:
        return _mean_movement(stage, error.problems)


def _starting_angles(stage: SceneContext) -> dict[str, float]:
    return {link: stage.sense(link) * stage.start(link) for link in stage.train.declaration.links}


def _mean_movement(stage: SceneContext, problems: Sequence[Problem]) -> MovementStart:
    first = problems[0]
    movement = Movement("mean", f"{first.what}: {first.why}" if first.why else first.what, _text(_period(stage, ())))
    return MovementStart(movement, _starting_angles(stage), notices=tuple(problems))


def _followed(stage: SceneContext, motion: Motion) -> MovementStart:
    import numpy as np

    composition = motion._forward
    _check_positions(composition, float(motion.period or 1))
    error, way = composition.at(np.zeros(1)).error[:, 0], motion._problem.way
    links = tuple(stage.train.declaration.links)
    rest = {
        link: stage.sense(link) * (stage.start(link) + way * float(each))
        for link, each in zip(links, error, strict=True)
    }
    driving = dict(_settings(composition, way))
    movement = _movement(stage, composition, way)
    back, notices = _backward(stage, motion, movement)
    return MovementStart(movement, rest, driving, notices, back)


def _check_positions(composition: ErrorComposition, turns: float) -> None:
    """Raise `GearTrainError` if pairs that depend on each other have no common position."""
    import numpy as np

    if any(step.coupled for step in composition.steps):
        composition.at(np.linspace(0, turns, _TRIED))  # this raises an error beyond a dead centre


def _backward(stage: SceneContext, motion: Motion, ahead: Movement) -> tuple[Movement | None, tuple[Problem, ...]]:
    """Return the movement with the driving link reversed, and warnings.

    The movement is None if it equals `ahead`, and the mean motion if the reversed movement cannot be computed.
    """
    try:
        composition = motion._backward
        _check_positions(composition, -float(motion.period or 1))
        back = _movement(stage, composition, motion._problem.way)
    except GearTrainError as error:
        mean = _mean_movement(stage, error.problems)
        return mean.movement, mean.notices
    return (None if plain(back) == plain(ahead) else back), ()


def _movement(stage: SceneContext, composition: ErrorComposition, way: int) -> Movement:
    """Return the movement with the given errors of pairs. `way` is 1 if the driving link turns forwards, and -1 if it
    turns backwards.
    """
    transmissions, sources = tables_and_sources(composition, way)
    links = tuple(stage.train.declaration.links)
    return Movement(
        "real" if sources else "exact",
        period=_text(_period(stage, [source.cycles for source in composition.sources])),
        transmissions=transmissions,
        sources=sources,
        steps=tuple(
            ErrorStep(step.sources, step.known, step.from_known.tolist(), step.own.tolist() if step.coupled else [])
            for step in composition.steps
        ),
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
    """Return the turns of the driving link after which all angles and errors repeat; None if no link moves."""
    ratios = [ratio for link in stage.train.declaration.links if (ratio := stage.ratio(link))]
    rates = [abs(rate) for rate in (*ratios, *cycles) if rate]
    if not rates:
        return None
    # the least common multiple of the periods 1/rate, exact
    return Fraction(lcm(*(rate.denominator for rate in rates)), gcd(*(rate.numerator for rate in rates)))


def _text(value: Fraction | None) -> str | None:
    return None if value is None else fraction_text(value)
