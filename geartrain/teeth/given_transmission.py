"""Gear pairs whose transmission function is given, by a table of errors or a Python object, instead of teeth."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import degrees, isfinite, pi
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

from geartrain.errors import RangeError
from geartrain.numerics.periodic_function import HarmonicSeries, PeriodicFunction, PeriodicSum, periodic_integral
from geartrain.teeth.couplings.table_transmission import DeviationTransmission
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.pair_results import PairVerdict, SlidingEfficiency
from geartrain.teeth.tooth_form import refused
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing

if TYPE_CHECKING:
    from typing import NoReturn

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.meshing_wheels import MeshingWheels, NamedForm, PairSize
    from geartrain.teeth.pair_results import PairAccount

    Efficiencies = tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]]

_TRIED = 257  # positions at which a function of Python is checked
_SAME = 1e-7  # pitches, or of the ratio: maximum difference of values that should be equal
_LOSSLESS = 1 - 1e-9  # efficiencies above it are this value if the other one is lower


@runtime_checkable
class TransmissionProtocol(Protocol):
    """Protocol of transmission functions that `GearTrain.with_tooth_form` accepts for a gear pair.

    A subclass of `TransmissionFunction` satisfies it. Two methods are optional: `kinks()` returns the driver angles in
    one period at which the speed ratio or its slope is discontinuous [rad], and `efficiency(S)` returns the efficiency
    at driver angles, above 0 and at most 1.

    See Also
    --------
    geartrain.GearTrain.with_tooth_form : attaches it to gear pairs.
    """

    ratio: Fraction
    """Exact mean speed ratio, without sign: tooth count of the driver divided by tooth count of the driven wheel."""
    period: float
    """Period [rad of the driver], a whole number of pitches of the driver."""

    def error(self, S: Floats) -> ArrayLike:
        """Return the transmission error at driver angles S.

        Parameters
        ----------
        S : ndarray
            Driver angles [rad], any shape.

        Returns
        -------
        array_like
            Transmission error [rad of the driven wheel], of the shape of S.
        """

    def speed(self, S: Floats) -> ArrayLike:
        """Return the speed ratio dq/dS at driver angles S.

        Parameters
        ----------
        S : ndarray
            Driver angles [rad], any shape.

        Returns
        -------
        array_like
            Speed ratio, above 0, of the shape of S.
        """


class GivenTransmission(DeviationTransmission, ToothTransmission):
    """Transmission function of a gear pair with a given transmission error, in which either wheel can drive.

    Parameters
    ----------
    function : PeriodicFunction
        Transmission error [rad of the other wheel] as a function of the angle [rad] of the wheel `refers_to`.
    counts : tuple of int
        Tooth counts of the first and of the second wheel.
    refers_to : {1, 2}
        Wheel to whose angle the function refers.
    backlash : float
        Angle by which the other wheel is ahead while the coast flanks are in contact [rad].
    efficiencies : tuple of callable, optional
        Efficiencies with the wheel `refers_to` driving, and with the other wheel driving, as functions of the angle of
        the wheel `refers_to`; None without losses.
    driver : {1, 2}
        Number of the driving wheel.
    direction : {1, -1}
        Direction of rotation. With -1 the coast flanks are in contact.
    """

    def __init__(
        self,
        function: PeriodicFunction,
        counts: tuple[int, int],
        refers_to: int = 1,
        backlash: float = 0.0,
        efficiencies: Efficiencies | None = None,
        driver: int = 1,
        direction: int = 1,
    ) -> None:
        self._declared, self._efficiencies_of = (function, counts, refers_to, backlash, efficiencies), efficiencies
        own, other = counts if refers_to == 1 else counts[::-1]
        inverse = driver != refers_to
        self._backlash = backlash * (other / own if inverse else 1)
        lag = self._backlash if direction < 0 else 0.0
        super().__init__(Fraction(own, other), function, inverse=inverse, direction=direction, lag=lag)
        self.driver, self.pitch_count = driver, round(function.period * own / (2 * pi))
        # the coefficient 1 scales the friction terms of `rubbing`, which state the efficiencies
        self.friction = 0.0 if efficiencies is None else 1.0

    def _driven(self, driver: int, direction: int) -> GivenTransmission:
        return GivenTransmission(*self._declared, driver, direction)

    def _summary(self) -> str:
        return f"ratio {self.ratio}, period {degrees(self.period):.6g} deg"

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict that the pair runs. The speed ratio was checked to be above 0 when the function was created."""
        return PairVerdict("runs", "the wheels turn", self._backlash)

    @property
    def _breakpoints(self) -> Floats:
        broken = [each for each in self._efficiencies_of or () if isinstance(each, PeriodicFunction)]
        return PeriodicSum([self.deviation, *broken], self.deviation.period).breakpoints

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the changes of the input and output power of a single contact per unit friction coefficient, chosen
        such that a coefficient of 1 gives the declared efficiencies. The sliding speed is not known.

        The changes `out` and `into` satisfy (1 + out)/(1 + into) = a and (1 - into)/(1 - out) = b, where a is the
        efficiency if the driver is the input and b the efficiency if the driven side is the input.
        """
        S = np.asarray(S, dtype=float)
        none = np.zeros((1, *S.shape))
        if self._efficiencies_of is None:
            return ContactRubbing(none, none, none)
        at = self._own_angle(S)
        a, b = (np.asarray(each(at), dtype=float) for each in self._efficiencies_of[:: -1 if self.inverse else 1])
        a = np.where(b < a, np.minimum(a, _LOSSLESS), a)
        lossy = a * b < 1
        into = np.divide(1 + a * b - 2 * b, 1 - a * b, where=lossy, out=np.zeros(S.shape))
        return ContactRubbing(none, into[None], (a * (1 + into) - 1)[None])


@dataclass(frozen=True)
class GivenLosses(SlidingEfficiency):
    """Losses of a gear pair whose efficiency is declared, so that it has no coefficient of friction."""

    @property
    def friction(self) -> None:
        """Coefficient of friction: None, because the efficiency is declared instead."""
        return


_WORDS = (
    "Pairs with a given transmission error, each in its carrier's frame; standard teeth are drawn. Speed ratio over "
    "its mean; transmission error peak to peak and backlash in degrees of the driven wheel; period in pitches; mean "
    "efficiency at constant driver torque, as the pair is driven and driven back."
)
_HEADER = (
    *("pair", "drives", "period (pitches)", "speed/mean", "error p-p (deg)", "backlash (deg)"),
    *("efficiency", "driven back"),
)


@dataclass(frozen=True)
class GivenMesh(GearMesh):
    """Gear pair whose transmission function is given, so that the shape of its teeth is not known."""

    transmission: GivenTransmission

    def _summary(self) -> str:
        return f"{self.name}: {self.tooth_form.words} transmission error, {self.driver} drives {self.driven}"

    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """Return None, because a pair whose tooth shape is not known has no size."""
        del tips
        return None

    def requirement(self, wheel: str, scale: float, tolerance: float) -> NoReturn:
        """Raise `GearTrainError`, because the shape of teeth with a given transmission function is not known."""
        del scale, tolerance
        what, why = f"the teeth of '{wheel}' have no shape", "this pair declares a transmission error instead of teeth"
        raise refused(what, why, "declare a tooth form with shapes, such as `tooth_form: involute`")

    @property
    def friction_words(self) -> str:
        """Text that describes the losses of the pair for reports. It does not end with a full stop."""
        return "Efficiency as given" if self.computes_losses else "No efficiency is given"

    def efficiency(self, driver: str) -> SlidingEfficiency:
        """Return the given efficiency of the pair, averaged over a period, if the wheel `driver` drives."""
        return GivenLosses(self.transmission if driver == self.driver else self.reversed)

    def account(self) -> PairAccount:
        """Return the report on the pair: speed ratio, transmission error, backlash and efficiencies."""
        from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, SpeedRatio, TransmissionError

        transmission, losses = self.transmission, self.efficiency(self.driver) if self.computes_losses else None
        speed, error = SpeedRatio.of(transmission), TransmissionError.of(transmission)
        row = (
            self.name,
            f"{self.driver} -> {self.driven}",
            str(transmission.pitch_count),
            "{:.5f}..{:.5f}".format(*speed.relative),
            error.text,
            f"{degrees(self.verdict.backlash):.4g}",
            *self.efficiency_texts,
        )
        return PairAccount(
            _WORDS,
            (AccountTable(_HEADER, row, wide=True),),
            PairFigures(self.counts, self.verdict, speed, error, losses),
        )


def given_mesh(wheels: MeshingWheels, form: NamedForm, transmission: GivenTransmission) -> GivenMesh:
    """Return the mesh of a pair with a given transmission function. Its first wheel drives.

    Raises `GearTrainError` if the speed ratio is not above 0 everywhere, or if friction is declared on the pair.
    """
    if getattr(wheels.gear, "friction", None) is not None:
        what = "friction is declared together with a given transmission error"
        raise refused(
            what, "no sliding speed of teeth is known", "remove `friction`, and give the `efficiency` of the tooth form"
        )
    forward = transmission.reversed if transmission.inverse else transmission
    low = forward.speed_range()[0]
    if not low > 0:
        at = degrees(transmission.deviation.minimum_at(1))
        what = f"the driven wheel stops or turns back: the minimum speed ratio is {low:.6g}, at {at:.6g} deg"
        why = "the slope of the transmission error reaches minus the mean speed ratio"
        raise refused(what, why, "check the unit of the errors, their sign, and the distance of the points")
    # the friction of the train does not apply; with the coefficient 1 the friction terms are the given efficiencies
    rubbing = None if transmission._efficiencies_of is None else 1.0
    own = replace(wheels, friction=rubbing, friction_law=None)
    return GivenMesh(own, form, wheels.driver, transmission if transmission.driver == 1 else transmission.reversed)


# ------------------------------------------------------------------------------------------------- functions of Python


def checked_function(given: TransmissionProtocol, counts: tuple[int, int]) -> PeriodicFunction:
    """Return the transmission error of a transmission function that is defined in Python, as a periodic function.

    counts   tooth counts of the wheel to whose angle the function refers, and of the other wheel

    Raises `GearTrainError` if the ratio, the period, or the shape or values of the results of the given function are
    not valid.
    """
    own, other = counts
    kind, ratio = type(given).__name__, Fraction(own, other)
    if given.ratio not in (ratio, float(ratio)):
        what = f"the ratio of '{kind}' is {given.ratio}, but this pair has {ratio}"
        why = "the mean ratio follows from the tooth counts"
        raise refused(what, why, f"return the ratio Fraction({own}, {other})")
    pitches = given.period * own / (2 * pi)
    if not isfinite(pitches) or round(pitches) < 1 or abs(pitches - round(pitches)) > _SAME * pitches:
        what = f"the period of '{kind}' is {pitches:.9g} pitches of the driver"
        why = "a transmission function repeats after a whole number of pitches"
        raise refused(what, why, f"return a multiple of 2 pi / {own}, such as 2 pi for a revolution of the driver")
    period, pitch = 2 * pi * round(pitches) / own, 2 * pi / other

    def values(method: str, S: Floats) -> Floats:
        found = np.asarray(getattr(given, method)(S), dtype=float)
        if found.shape != S.shape or not np.isfinite(found).all():
            what = f"`{method}` of '{kind}' does not return a finite number for each angle"
            why = f"for angles of shape {S.shape} it returns shape {found.shape}"
            raise refused(what, why, "return an array of finite numbers with the shape of the angles")
        return found

    # between the positions at which kinks are likely
    S = (np.arange(_TRIED) + 0.6180339887) / _TRIED * period
    for method, scale in (("error", pitch), ("speed", float(ratio))):
        apart = np.abs(values(method, S + period) - values(method, S)).max()
        if apart > _SAME * scale:
            what = f"`{method}` of '{kind}' changes by {apart:.6g} after one period"
            why = "a transmission error repeats after its period"
            raise refused(what, why, "return the error, not the total angle")
    kinks: Sequence[float] = getattr(given, "kinks", list)()
    try:
        found, drift = periodic_integral(lambda S: values("speed", S) - float(ratio), period, kinks)
    except RangeError as problem:
        what = f"the speed ratio of '{kind}' is not smooth: {problem.problems[0].what}"
        why = "its extremes are computed between its kinks"
        raise refused(what, why, "return the angles of its kinks from a method `kinks()`") from None
    lag = values("error", S) - found(S)
    if (apart := max(float(np.ptp(lag)), abs(drift) * period)) > _SAME * pitch:
        what = f"`speed` of '{kind}' is not the ratio plus the slope of `error`"
        why = f"its integral differs from the error by {apart:.6g} rad"
        raise refused(what, why, "return dq/dS = ratio + d error/dS")
    return PeriodicSum([found, HarmonicSeries((), period, float(lag.mean()))], period)


def checked_efficiency(given: TransmissionProtocol) -> Efficiencies | None:
    """Return the efficiencies of the transmission function `given`, which is defined in Python, for both driving
    wheels; None for a function without losses.

    Raises `GearTrainError` if an efficiency is not above 0 and at most 1.
    """
    method = getattr(given, "efficiency", None)
    if method is None:
        return None
    try:
        values = np.asarray(method(np.linspace(0.0, given.period, _TRIED)), dtype=float)
    except RangeError:  # the sliding of its teeth is not known
        return None
    if values.shape != (_TRIED,) or not ((values > 0) & (values <= 1)).all():
        what = f"an efficiency of '{type(given).__name__}' is out of range"
        raise refused(what, "it must be above 0 and at most 1", "return one efficiency for each angle")
    return None if (values == 1).all() else (method, method)
