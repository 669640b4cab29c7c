"""Energy per beat, pendulum amplitude, minimum weight and rate errors of a clock with an escapement.

The equations are (20) to (23) of docs/dynamics.md. A positive rate error means that the clock gains.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, pi, sin, sqrt
from typing import TYPE_CHECKING

from scipy.special import ellipk

from geartrain.dynamics.torques.torque_analysis import escapement_torques
from geartrain.numerics.results import Result
from geartrain.train.states import EXPANSIONS, GRAVITY

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.train.states import Escapement, Pendulum

DAY = 86400.0
"""Length of a day [s]."""


def circular_error(amplitude: float) -> float:
    """Return the relative rate error of a pendulum that swings in a circular arc [1]. For small amplitudes A, it is
    -A^2/16.

    The period of a simple pendulum is 2 K(sin(A/2))/pi times the period of infinitely small oscillations, where K is
    the complete elliptic integral of the first kind.

    amplitude   amplitude A, which is half of the total arc [rad]
    """
    return float(pi / (2 * ellipk(sin(amplitude / 2) ** 2)) - 1)


def escapement_error(escapement: Escapement, amplitude: float, quality: float) -> float | None:
    """Return the relative rate error due to the impulses of an escapement, computed by Airy's theorem [1]; None if the
    kind of the escapement is not declared, or if its impulse extends beyond the amplitude.

    amplitude   half of the total arc [rad]
    quality     quality factor of the pendulum; the impulses supply the energy that it loses
    """
    angles = escapement.deadbeat or ((escapement.recoil,) if escapement.recoil is not None else ())
    given = [angle.si for angle in angles]
    if not given or sum(given) == 0 or max(given) > amplitude:
        return None
    # distance of the ends of an impulse from the middle of the swing, as sine of the phase
    lags = [sqrt(1 - (angle / amplitude) ** 2) for angle in given]
    if escapement.recoil is not None:
        return amplitude / (2 * given[0] * quality) * lags[0]
    return amplitude / (2 * quality * sum(given)) * (lags[1] - lags[0])


def swing_amplitude(pendulum: Pendulum, impulse: float) -> float | None:
    """Return the amplitude at which a pendulum loses a given energy per period [rad]; None if the mass of its bob or
    its quality factor is not declared, or if the amplitude would exceed half a turn.

    impulse   energy that the pendulum receives per period [J]
    """
    if pendulum.bob is None or pendulum.quality is None:
        return None
    stored = float(pendulum.quality.value) * impulse / (2 * pi)
    lowered = 1 - stored / (pendulum.bob.si * GRAVITY * pendulum.length.si)
    return acos(lowered) if lowered > -1 else None


@dataclass(frozen=True)
class Timekeeping(Result):
    """Energy, amplitude and rate errors of a clock in one state. Values that cannot be determined are None."""

    state: str | None
    """Name of the state; None for a train without states."""
    source: str
    """Name of the link at which power enters."""
    slides: bool
    """True if `source` is a sliding weight, so that `torque` and `minimum_torque` are forces."""
    torque: float
    """Torque on the link `source` in its sense of rotation [N m], or force along its travel if it slides [N]."""
    power: float
    """Power that enters at the link `source` [W]."""
    efficiency: float
    """Fraction of the input power that reaches the escape wheel; 0 if friction stops the train."""
    lost_in_bearings: float
    """Fraction of the input power that is lost in bearings."""
    beat_energy: float
    """Energy that the escape wheel receives per beat [J]."""
    amplitude: float | None
    """Amplitude of the pendulum, which is half of its total arc [rad]; None if it is not known."""
    minimum_torque: float | None
    """Minimum torque [N m] or force [N] at `source` with which the pendulum reaches its `arc`; None if unknown."""
    minimum_weight: float | None
    """Mass of the weight that exerts the minimum torque [kg]; None if it cannot be determined."""
    descent: float | None
    """Speed at which the weight descends [m/s]; None if there is no weight."""
    going_time: float | None
    """Time from one winding to the next [s]; None if it cannot be determined."""
    circular: float | None
    """Rate error due to the circular arc of the pendulum [s/d]; None if the amplitude is unknown."""
    escapement: float | None
    """Rate error due to the impulses of the escapement [s/d]; None if it cannot be determined."""
    thermal: float | None
    """Rate error per kelvin due to thermal expansion of the pendulum rod [s/d/K]; None if it cannot be determined."""

    @property
    def goes(self) -> bool | None:
        """True if the drive is sufficient: torque reaches the escape wheel, and the pendulum amplitude reaches the
        declared `arc`. None if the arc or the amplitude is unknown.
        """
        if self.efficiency <= 0:
            return False
        return None if self.minimum_torque is None else self.torque >= self.minimum_torque


def find_timekeeping(setting: LoadCase) -> Timekeeping | None:
    """Return the energy, amplitude and rate errors of a clock; None if no escapement is declared, or if the torque or
    the speed at the escape wheel is unknown.
    """
    escapement, case = setting.train.escapement, setting.case
    found = None if escapement is None else escapement_torques(setting)
    if escapement is None or found is None:
        return None
    source, torque, at_escape, lossless, lost = found
    own = setting.relative(escapement.link, setting.reacts_on(escapement.link))
    if not own or not setting.speeds.get(source):
        return None
    # speed of the source in rad/s, from the beat
    speed = 2 * pi * abs(float(escapement.speed * setting.speeds[source] / own))
    beat_energy = at_escape * pi / escapement.teeth
    efficiency = at_escape * float(abs(own)) / (torque * float(abs(setting.speeds[source])))
    pendulum, share = escapement.pendulum, escapement.efficiency
    amplitude = None
    if pendulum is not None and share is not None and at_escape > 0:
        amplitude = swing_amplitude(pendulum, 2 * float(share.base) * beat_energy)
    # torque that constant friction takes at the source
    constant = torque * (1 - at_escape / lossless) if lossless else 0.0
    minimum = None
    if amplitude is not None and escapement.arc is not None:
        # the energy of the pendulum is proportional to the torque beyond the constant friction
        minimum = (torque - constant) * (1 - cos(escapement.arc.si)) / (1 - cos(amplitude)) + constant
    drive, size = case.drive, float(setting.arms.get(source, 1))
    # descent of the weight per radian
    arm = size if source in setting.arms else None if drive is None else drive.arm
    quality = None if pendulum is None or pendulum.quality is None else float(pendulum.quality.value)
    impulses = None if amplitude is None or quality is None else escapement_error(escapement, amplitude, quality)
    expansion = None if pendulum is None or pendulum.rod is None else EXPANSIONS[pendulum.rod]
    return Timekeeping(
        case.state,
        source,
        source in setting.arms,
        torque / size,
        torque * speed,
        efficiency,
        lost,
        beat_energy,
        amplitude,
        None if minimum is None else minimum / size,
        None if minimum is None or arm is None else minimum / (arm * GRAVITY),
        None if arm is None else arm * speed,
        None if arm is None or drive is None or drive.drop is None else drive.drop.si / (arm * speed),
        None if amplitude is None else DAY * circular_error(amplitude),
        None if impulses is None else DAY * impulses,
        None if expansion is None else -DAY * expansion / 2,
    )
