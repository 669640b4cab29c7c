"""Parts of what a train did in time: courses of contacts, impacts, energy, outputs, figures, lines of a spectrum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from geartrain.numerics.results import Result

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class ContactInTime(Result):
    """What one pair, pin or escapement did during a run.

    Attributes
    ----------
    name : str
        The pair or coupling; of an escapement its link.
    apart : float
        Share of time in which no flank touches.
    coast : float
        Share of time on the coast flank, or nearer to it.
    blows : float
        Impacts a second [1/s].
    power : float
        What they take [W].
    hardest : float
        Greatest closing speed of one, of the driven side [rad/s].
    torque : float
        Mean torque on the driven side, forwards positive [N m].
    rubbed : float
        What friction takes [W].
    gap : float
        Greatest gap, to the nearer flank [rad].
    changes : float
        Changes from one flank to the other without time apart [1/s].
    peak : float or None
        Greatest torque on the driven side of teeth that yield [N m]; None of rigid ones, which give blows.
    dynamic_factor : float or None
        That over the greatest torque in balance at every moment; None where no speed is prescribed.

    See Also
    --------
    TimeRun.contacts : where these stand.
    """

    name: str
    apart: float
    coast: float
    blows: float
    power: float
    hardest: float
    torque: float
    rubbed: float
    gap: float
    changes: float
    peak: float | None = None
    dynamic_factor: float | None = None


@dataclass(frozen=True)
class ImpactList(Result):
    """Impacts one after another, as far as they were kept.

    Attributes
    ----------
    total : int
        How many there were.
    contact : tuple of str
        The pair, pin or escapement of each that was kept.
    time, speed, energy, impulse : array of float, (kept,)
        Of each: time [s], closing speed [rad/s], energy taken [J], impulse on the driven side [N m s].

    See Also
    --------
    TimeRun.impacts : where it stands.
    """

    KEYS = ("total",)

    total: int
    contact: tuple[str, ...]
    time: Floats
    speed: Floats
    energy: Floats
    impulse: Floats


@dataclass(frozen=True)
class EnergyAccount(Result):
    """Where energy came from and went [J]: what is put in is what is taken and what kinetic energy has grown by.

    Attributes
    ----------
    drive, loads, springs : float
        Work of what keeps a speed, of constant torques, of springs.
    bearings, drag, friction : float
        Taken by dry friction in bearings, by viscous drag, by friction of teeth and pins.
    blows : float
        Taken by impacts; of teeth that yield, by their damping.
    steps : float
        Taken, or given, by contact that lasts: an error of the steps' length, that falls with it.
    kinetic : float
        Growth of kinetic energy.
    stored : float
        Kinetic energy at the end.
    elastic : float
        Growth of the energy stored in teeth that yield.

    See Also
    --------
    TimeRun.energy : where it stands.
    """

    KEYS = (
        "drive",
        "loads",
        "springs",
        "bearings",
        "drag",
        "friction",
        "blows",
        "steps",
        "kinetic",
        "elastic",
        "stored",
        "closure",
    )

    drive: float
    loads: float
    springs: float
    bearings: float
    drag: float
    friction: float
    blows: float
    steps: float
    kinetic: float
    stored: float
    elastic: float = 0.0

    @property
    def put_in(self) -> float:
        """Work of drive, loads and springs."""
        return self.drive + self.loads + self.springs

    @property
    def closure(self) -> float:
        """By how much the account does not close, over all that passed through it and what is stored."""
        taken = self.bearings + self.drag + self.friction + self.blows + self.steps
        kept = self.kinetic + self.elastic
        scale = sum(abs(each) for each in (self.put_in, taken, kept, self.stored))
        return abs(self.put_in - taken - kept) / scale if scale else 0.0


@dataclass(frozen=True)
class OutputLead(Result):
    """How far an output runs ahead of the motion in which all drive flanks touch, and behind it.

    Attributes
    ----------
    output : str
        Its name.
    ahead, behind : float
        Greatest angles, 0 or more [rad].
    rms : float
        Root mean square of the difference [rad].

    See Also
    --------
    TimeRun.leads : where these stand.
    """

    output: str
    ahead: float
    behind: float
    rms: float


@dataclass(frozen=True)
class SettledFigure(Result):
    """A figure by steps of length h and h/2, with what the length of the run leaves open.

    Attributes
    ----------
    name : str
        What it is of.
    unit : str
        Its unit.
    coarse, fine : float
        By steps of length h, and of h/2.
    kind : {"mean", "extreme"}
        A mean over the run holds if steps are short; an extreme depends on single flights, which are chaotic.
    settled : bool
        Whether both agree: a mean to 5 %, an extreme to 1 %, a share of time to 0.005, an angle to 1e-6 rad if that is
        more; and whether the interval of a mean is as narrow.
    interval : float or None
        Half the 95 % interval of a mean, from blocks of whole turns; None of an extreme, and of fewer than 5 turns.

    See Also
    --------
    TimeRun.figures : where these stand.
    """

    name: str
    unit: str
    coarse: float
    fine: float
    kind: Literal["mean", "extreme"]
    settled: bool
    interval: float | None = None


@dataclass(frozen=True)
class SpectrumPeak(Result):
    """A line of the spectrum of an output's angle about its mean motion.

    Attributes
    ----------
    order : float
        Periods in a turn of the lead.
    frequency : float
        The same a second [Hz].
    amplitude : float
        Of the angle [rad].
    source : str
        The pair (or beat) and harmonic that fall on it, such as `c2~d1 x1`; empty for none.

    See Also
    --------
    TimeRun.spectra : where these stand.
    """

    order: float
    frequency: float
    amplitude: float
    source: str
