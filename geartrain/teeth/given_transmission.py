"""Gear pairs whose transmission function is given instead of the shape of their teeth: as a table of transmission
errors, or as an object of Python.

With S the forward angle of the wheel to which the function refers, i the ratio and f the given error, the other wheel
is at q = i S + f(S). If that wheel drives, its angle q is given, and S is the root of this equation. The error is then
S - q/i = -f(S)/i, and the speed ratio is 1/(i + f'(S)).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import ceil, degrees, isfinite, pi
from typing import TYPE_CHECKING, Protocol, TypeGuard, runtime_checkable

import numpy as np

from geartrain.errors import RangeError
from geartrain.numerics.periodic_function import FittedFunction, PeriodicFunction, PeriodicSum
from geartrain.numerics.roots import roots_by_false_position
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.pair_results import PairVerdict, SlidingEfficiency
from geartrain.teeth.tooth_form import refused
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing, SpeedLeap

if TYPE_CHECKING:
    from typing import NoReturn

    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.meshing_wheels import MeshingWheels, NamedForm, PairSize
    from geartrain.teeth.pair_results import PairAccount

_CLOSE = 4e-16  # periods: distance at which the search for the driving angle ends
_LEAP = 1e-9  # relative size of an upward step of the speed ratio that is not a rounding error
_TRIED = 257  # positions at which a function of Python is checked
_SAME = 1e-7  # pitches, or of the ratio: maximum difference of values that should be equal
_LOSSLESS = 1 - 1e-9  # efficiencies above it are this value if the other one is lower


@runtime_checkable
class TransmissionProtocol(Protocol):
    """Protocol of transmission functions that `GearTrain.with_tooth_form` accepts for a gear pair.

    A subclass of `TransmissionFunction` satisfies it. Two methods are optional: `kinks()` returns the driver angles in
    one period at which the speed ratio or its slope is discontinuous [rad], and `efficiency(S)` the efficiency at
    driver angles, above 0 and at most 1.

    See Also
    --------
    geartrain.GearTrain.with_tooth_form : attaches it to gear pairs.
    """

    ratio: Fraction
    """Exact mean of the speed ratio, without sign: tooth count of the driver divided by that of the driven wheel."""
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


def has_transmission_members(given: object) -> TypeGuard[TransmissionProtocol]:
    """Return True if an object has the members of `TransmissionProtocol`."""
    return not isinstance(given, str | Mapping | list | tuple) and isinstance(given, TransmissionProtocol)


class GivenTransmission(ToothTransmission):
    """Transmission function of a gear pair from a given error, with either wheel driving.

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
        Direction of rotation. With -1 the coast flanks drive.
    """

    def __init__(
        self,
        function: PeriodicFunction,
        counts: tuple[int, int],
        refers_to: int = 1,
        backlash: float = 0.0,
        efficiencies: tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]] | None = None,
        driver: int = 1,
        direction: int = 1,
    ) -> None:
        self.function, self._counts, self._refers_to = function, counts, refers_to
        self._efficiencies_of, self._play = efficiencies, backlash
        self.driver, self.direction, self._inverse = driver, direction, driver != refers_to
        own, other = counts if refers_to == 1 else counts[::-1]
        self._mean = own / other
        self.ratio = Fraction(other, own) if self._inverse else Fraction(own, other)
        self.period = function.period * (self._mean if self._inverse else 1.0)
        self.pitch_count = round(function.period * own / (2 * pi))
        self.waves = max(1, ceil(function.period / (32 * function.resolution)))
        # the coefficient 1 scales the friction terms of `rubbing`, which state the efficiencies
        self.friction = 0.0 if efficiencies is None else 1.0
        # errors of the driven wheel per error of the function
        self._scale = -1 / self._mean if self._inverse else 1.0

    def _driven(self, driver: int, direction: int) -> GivenTransmission:
        return GivenTransmission(
            *(self.function, self._counts, self._refers_to, self._play, self._efficiencies_of, driver, direction)
        )

    def _summary(self) -> str:
        return f"ratio {self.ratio}, period {degrees(self.period):.6g} deg"

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict that the pair runs, because its speed ratio was checked to be above 0."""
        return PairVerdict("runs", "the wheels turn", abs(self._scale) * self._play)

    # ---------------------------------------------------------------------------------------------------------- motion

    def _own_angle(self, S: ArrayLike) -> Floats:
        """Return the angle of the wheel to which the function refers [rad], modulo its period, at driver angles S."""
        S = np.asarray(S, dtype=float)
        if not self._inverse:
            return S
        q, (low, high) = np.mod(S, self.period).ravel(), self._extremes

        def beyond(x: Floats, which: NDArray[np.intp]) -> Floats:
            return np.asarray(self._mean * x + self.function(x) - q[which])

        first, last = (q - high) / self._mean, (q - low) / self._mean
        every = np.arange(len(q))
        close = _CLOSE * self.function.period
        found = roots_by_false_position(beyond, first, last, beyond(first, every), beyond(last, every), close)
        return found.reshape(S.shape)

    @cached_property
    def _extremes(self) -> tuple[float, float]:
        return self.function.extremes()

    @property
    def _coast(self) -> float:
        """Angle by which the driven wheel is ahead on the coast flanks [rad]; 0 on the drive flanks."""
        return abs(self._scale) * self._play if self.direction < 0 else 0.0

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S."""
        return self._scale * self.function(self._own_angle(S)) + self._coast

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S."""
        return self._tau(self._mean + self.function.derivative(self._own_angle(S)))

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return the transmission error [rad of the driven side] and the speed ratio at driver angles S."""
        at = self._own_angle(S)
        tau = self._tau(self._mean + self.function.derivative(at))
        return self._scale * self.function(at) + self._coast, tau

    def _tau(self, own: Floats) -> Floats:
        return 1 / own if self._inverse else own

    @property
    def minimum(self) -> float:
        """Minimum speed ratio with the wheel `refers_to` driving, which must be above 0."""
        return self._mean + self.function.extremes(1)[0]

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and maximum speed ratio over a period."""
        low, high = (self._mean + each for each in self.function.extremes(1))
        return (1 / high, 1 / low) if self._inverse else (low, high)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and maximum transmission error over a period [rad of the driven side]."""
        low, high = sorted(self._scale * each for each in self._extremes)
        return low + self._coast, high + self._coast

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error and its rms deviation from the mean [rad of the driven side]."""
        # the means of f and f^2 over S and over q are equal, because those of f f' and f^2 f' are 0
        mean, rms = self.function.moments()
        return self._scale * mean + self._coast, abs(self._scale) * rms

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] of the breakpoints of the given error and efficiencies."""
        broken = [each for each in self._efficiencies_of or () if isinstance(each, PeriodicFunction)]
        at = PeriodicSum([self.function, *broken], self.function.period).breakpoints
        found: list[float] = (self._mean * at + self.function(at) if self._inverse else at).tolist()
        return found

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio in the direction of motion within one period."""
        sides = [self._tau(self._mean + each) for each in self.function.sides(1)]
        pairs = zip(*(each.tolist() for each in sides[:: self.direction]), strict=True)
        return tuple(SpeedLeap(before, after) for before, after in pairs if after > before * (1 + _LEAP))

    def steepest_fall(self) -> float | None:
        """Return the maximum of -d(speed ratio)/dS [1/rad]; None if the wheel to which the function refers is driven,
        or if the driver turns backwards.
        """
        return None if self._inverse or self.direction < 0 else max(0.0, -self.function.extremes(2)[0])

    # ---------------------------------------------------------------------------------------------------------- losses

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the friction terms of a single contact for a coefficient of friction of 1, without sliding speed.

        They satisfy (1 + out)/(1 + into) = a and (1 - into)/(1 - out) = b, where a and b are the efficiencies with the
        driver and with the driven side as the input.
        """
        S = np.asarray(S, dtype=float)
        none = np.zeros((1, *S.shape))
        if self._efficiencies_of is None:
            return ContactRubbing(none, none, none)
        at = self._own_angle(S)
        a, b = (each(at) for each in self._efficiencies_of[:: -1 if self._inverse else 1])
        a = np.where(b < a, np.minimum(a, _LOSSLESS), a)
        lossy = a * b < 1
        into = np.divide(1 + a * b - 2 * b, 1 - a * b, where=lossy, out=np.zeros(S.shape))
        return ContactRubbing(none, into[None], (a * (1 + into) - 1)[None])


@dataclass(frozen=True)
class GivenLosses(SlidingEfficiency):
    """Declared efficiency of a pair, which has no coefficient of friction."""

    @property
    def friction(self) -> None:
        """None, because the efficiency is declared."""
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
    """Gear pair whose transmission function is given. The shape of its teeth is not known."""

    transmission: GivenTransmission

    def _summary(self) -> str:
        return f"{self.name}: {self.tooth_form.words} transmission error, {self.driver} drives {self.driven}"

    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """Return None, because the shape of the teeth is not known."""
        del tips
        return None

    def requirement(self, wheel: str, scale: float, tolerance: float) -> NoReturn:
        """Raise `GearTrainError`, because the shape of the teeth is not known."""
        del scale, tolerance
        what, why = f"the teeth of '{wheel}' have no shape", "this pair declares a transmission error instead of teeth"
        raise refused(what, why, "declare a tooth form with shapes, such as `tooth_form: involute`")

    @property
    def friction_words(self) -> str:
        """Statement of the losses of the pair, without a full stop."""
        return "Efficiency as given" if self.computes_losses else "No efficiency is given"

    def efficiency(self, driver: str) -> SlidingEfficiency:
        """Return the given efficiency of the pair, averaged over a period, with one of its wheels driving."""
        return GivenLosses(self.transmission if driver == self.driver else self.reversed)

    def account(self) -> PairAccount:
        """Return the report of the pair: speed ratio, transmission error, backlash and efficiencies."""
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
    """Return the mesh of a pair with a given transmission function, its first wheel driving.

    Raises `GearTrainError` if the speed ratio is not above 0 everywhere, or if friction is declared on the pair.
    """
    if getattr(wheels.gear, "friction", None) is not None:
        what, why = (
            "friction is declared together with a given transmission error",
            "no sliding speed of teeth is known",
        )
        raise refused(what, why, "remove `friction`, and give the `efficiency` of the tooth form")
    low = transmission.minimum
    if not low > 0:
        at = degrees(transmission.function.minimum_at(1))
        what = f"the driven wheel stops or turns back: the minimum speed ratio is {low:.6g}, at {at:.6g} deg"
        why = "the slope of the transmission error reaches minus the mean speed ratio"
        raise refused(what, why, "check the unit of the errors, their sign, and the distance of the points")
    # the friction of the train does not apply; with the coefficient 1 the friction terms are the given efficiencies
    rubbing = None if transmission._efficiencies_of is None else 1.0
    own = replace(wheels, friction=rubbing, friction_law=None)
    return GivenMesh(own, form, wheels.driver, transmission if transmission.driver == 1 else transmission.reversed)


# ------------------------------------------------------------------------------------------------- functions of Python


def checked_function(given: TransmissionProtocol, counts: tuple[int, int]) -> PeriodicFunction:
    """Return the error of a transmission function of Python as a periodic function.

    counts   tooth counts of the wheel to whose angle it refers, and of the other wheel

    Raises `GearTrainError` if its ratio, its period, or the shape or values of its results are not valid.
    """
    own, other = counts
    kind, ratio = type(given).__name__, Fraction(own, other)
    if given.ratio not in (ratio, float(ratio)):
        what = f"the ratio of '{kind}' is {given.ratio}, but this pair has {ratio}"
        raise refused(
            what, "the mean ratio follows from the tooth counts", f"return the ratio Fraction({own}, {other})"
        )
    pitches = given.period * own / (2 * pi)
    if not isfinite(pitches) or round(pitches) < 1 or abs(pitches - round(pitches)) > _SAME * pitches:
        what = f"the period of '{kind}' is {pitches:.9g} pitches of the driver"
        why = "a transmission function repeats after a whole number of pitches"
        raise refused(what, why, f"return a multiple of 2 pi / {own}, such as 2 pi for a revolution of the driver")
    period = 2 * pi * round(pitches) / own

    def read(method: str) -> Callable[[Floats], Floats]:
        def values(S: Floats) -> Floats:
            found = np.asarray(getattr(given, method)(S), dtype=float)
            if found.shape != S.shape or not np.isfinite(found).all():
                what = f"`{method}` of '{kind}' does not return a finite number for each angle"
                why = f"for angles of shape {S.shape} it returns shape {found.shape}"
                raise refused(what, why, "return an array of finite numbers with the shape of the angles")
            return found

        return values

    error, speed = read("error"), read("speed")
    # between the positions at which kinks are likely
    S = (np.arange(_TRIED) + 0.6180339887) / _TRIED * period
    pitch = 2 * pi / other
    for name, values, scale in (("error", error, pitch), ("speed", speed, float(ratio))):
        apart = np.abs(values(S + period) - values(S)).max()
        if apart > _SAME * scale:
            what = f"`{name}` of '{kind}' changes by {apart:.6g} after one period"
            raise refused(
                what, "a transmission error repeats after its period", "return the error, not the total angle"
            )
    kinks: Sequence[float] = getattr(given, "kinks", list)()
    try:
        found = FittedFunction(error, lambda S: speed(S) - float(ratio), period, kinks)
    except RangeError as problem:
        what = f"the speed ratio of '{kind}' is not smooth: {problem.problems[0].what}"
        fix = "return the angles of its kinks from a method `kinks()`"
        raise refused(what, "its extremes are computed between its kinks", fix) from None
    if (apart := found.mismatch()) > _SAME * pitch:
        what = f"`speed` of '{kind}' is not the ratio plus the slope of `error`"
        raise refused(
            what, f"its integral differs from the error by {apart:.6g} rad", "return dq/dS = ratio + d error/dS"
        )
    return found


def checked_efficiency(
    given: TransmissionProtocol,
) -> tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]] | None:
    """Return the efficiency of a transmission function of Python, equal for both driving wheels; None without losses.

    Raises `GearTrainError` if an efficiency is not above 0 and at most 1.
    """
    method = getattr(given, "efficiency", None)
    try:
        values = None if method is None else np.asarray(method(np.linspace(0.0, given.period, _TRIED)), dtype=float)
    except RangeError:  # the sliding of its teeth is not known
        return None
    if method is None or values is None or (values == 1).all():
        return None
    if values.shape != (_TRIED,) or not ((values > 0) & (values <= 1)).all():
        what = f"an efficiency of '{type(given).__name__}' is out of range"
        raise refused(what, "it must be above 0 and at most 1", "return one efficiency for each angle")

    def efficiency(S: Floats) -> Floats:
        return np.asarray(method(S), dtype=float)

    return efficiency, efficiency
