"""Results of a time-domain simulation: angles, speeds, torques, times in contact, impacts, and the energy balance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import tau
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from geartrain.numerics.files import csv_text
from geartrain.numerics.results import Key, Pictured, Result, Tabular, TrainResult, group

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray


@dataclass(frozen=True)
class TimeRun(Tabular, Pictured, TrainResult):
    """Time-domain simulation of a train with a constant time step h, repeated with h/2. All data are from the run with
    h/2.

    See Also
    --------
    geartrain.GearTrain.dynamics : Returns such an object.

    Examples
    --------
    >>> import geartrain
    >>> wheels = {"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 30}, "inertia": "1e-6 kg m2",
    ...     "bearing": "1 N mm"}}, "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"],
    ...     "axis": "B"}], "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}}
    >>> run = geartrain.GearTrain.declare(wheels).dynamics(rate="1 turn/s", turns=1, steps=200)
    >>> round(run.torque * 1000, 6), run.energy.closure < 1e-12
    (0.666667, True)
    """

    MEANINGS: ClassVar = {
        "time (s)": "Time of the sample [s].",
        "turns": "Turns of the driving input [turn].",
        "* angle (rad)": "Angle of the link [rad].",
        "* speed (rad/s)": "Speed of the link [rad/s].",
        "* torque (N m)": "Torque on the driven side of the contact or where power enters, mean between samples [N m].",
        "* gap (rad)": "Distance of the driven side from its flank [rad].",
        "* ahead (rad)": "Angle by which the output is ahead of the motion with all drive flanks in contact [rad].",
    }

    PAGE = "simulation.time.time_report:time_document"

    FIGURE = "simulation.time.time_run_plot:time_run_figure"

    KEYS = (
        *("train", "state", "model", "driving_link", "rate", "link", "driven", "restitution", "step", "skip"),
        *("duration", "torque", "contacts", "impacts", group("energy", Key("", "energy")), "deviations"),
        *("spectra", "figures", "unsolved", "notes", "assumed", "complete"),
    )

    train: str
    """Name of the train."""
    state: str | None
    """Name of the declared state; None for a train without states."""
    driving_link: str
    """Name of the link whose mean speed defines the time scale."""
    rate: float
    """Mean speed of the driving link in the evaluated part of the run [rad/s]; negative if the link turns backwards."""
    link: str
    """Name of the link at which power enters."""
    driven: Literal["rate", "torque", "spring", "hand"]
    """Kind of drive: prescribed speed, torque (which a weight may exert), spring, or a hand that turns a spring."""
    step: float
    """Time step [s]."""
    skip: float
    """Simulated time before the evaluated part begins [s]."""
    duration: float
    """Duration of the evaluated part of the run [s]."""
    time: Floats
    """Times of the samples [s]. Shape (n,)."""
    turns: Floats
    """Revolutions of the driving link at the samples, positive in its declared sense. Shape (n,)."""
    angles: LabelledArray
    """Angles of all links [rad]. Shape (link, time)."""
    speeds: LabelledArray
    """Speeds of all links [rad/s]. Shape (link, time)."""
    torques: LabelledArray
    """Torque on the driven side of each contact, averaged between samples [N m]. Shape (contact, time)."""
    gaps: LabelledArray
    """Angular gap between the driven side and the drive flank of the driving side [rad]. Shape (pair, time).

    Drive flanks transmit the torque while the driving link turns in its declared sense.
    """
    coast_gaps: LabelledArray
    """Angular gap between the driven side and the coast flank of the driving side [rad]. Shape (pair, time)."""
    outputs: LabelledArray
    """Angles through which outputs have turned [rad]. Shape (output, time)."""
    ahead: LabelledArray
    """Angles by which outputs are ahead of the motion with all drive flanks in contact [rad]. Shape (output, time)."""
    drive: Floats
    """Torque at the power input, averaged between samples [N m], positive in the sense of rotation. Shape (n,)."""
    torque: float
    """Mean torque at the power input in the evaluated part [N m]: work divided by angle."""
    contacts: tuple[ContactInTime, ...]
    """Results of every pair, pin and escapement."""
    impacts: ImpactList
    """Impacts in the evaluated part of the run."""
    energy: EnergyAccount
    """Energy balance of the evaluated part of the run."""
    deviations: tuple[OutputDeviation, ...]
    """Deviations of outputs from the motion with all drive flanks in contact."""
    spectra: Mapping[str, tuple[SpectrumPeak, ...]]
    """Spectral lines of each output in descending order of amplitude, keyed by output."""
    figures: tuple[ConvergedFigure, ...]
    """Main results with time steps h and h/2, for a convergence check."""
    unsolved: int
    """Number of steps without a consistent set of contacts, in which the last iterate was used."""
    notes: tuple[str, ...]
    """Descriptions of the effects that the simulation neglects."""
    complete: bool = True
    """False if the simulation was interrupted before its end.

    If it is False, all data are from the completed part of the run with the longer step, without a comparison.
    """
    model: Literal["rigid", "compliant"] = "rigid"
    """Model of the teeth, rigid or compliant."""
    assumed: tuple[str, ...] = ()
    """Descriptions of the estimates that were used for undeclared quantities."""
    restitution: float = 0.0
    """Maximum coefficient of restitution of the contacts."""
    _without: tuple[str, ...] = field(default=(), kw_only=True, repr=False, compare=False)

    def _summary(self) -> str:
        state = "" if self.state is None else f" state {self.state}"
        rate = f"{abs(self.rate) / tau:.4g} turn/s of {self.driving_link}"
        apart = max((each.apart for each in self.contacts), default=0.0)
        figures = [f"{self.duration:.4g} s", f"mean torque {self.torque:.4g} N m at {self.link}"]
        figures.append(f"teeth apart at most {100 * apart:.3g} % of the time")
        return f"{self.train}{state}: {rate}, {', '.join(figures)}" + ("" if self.complete else ", incomplete")

    def __getitem__(self, name: str) -> Floats | ContactInTime:
        """Return the angles of the link with the given name [rad], or the results of the contact with this name."""
        for each in self.contacts:
            if each.name == name:
                return each
        found: Floats = self.angles[name]
        return found

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with a row for each sample: time, turns, angles, speeds, torques, gaps, deviations."""
        made: dict[str, Floats] = {"time (s)": self.time, "turns": self.turns}
        for found, what in (
            (self.angles, "angle (rad)"),
            (self.speeds, "speed (rad/s)"),
            (self.torques, "torque (N m)"),
        ):
            made |= {f"{name} {what}": row for name, row in zip(found.labels[0], found.values, strict=True)}
        made["drive torque (N m)"] = self.drive
        for name, drive, coast in zip(self.gaps.labels[0], self.gaps.values, self.coast_gaps.values, strict=True):
            made |= {f"{name} gap (rad)": drive, f"{name} coast gap (rad)": coast}
        deviations = zip(self.ahead.labels[0], self.ahead.values, strict=True)
        made |= {f"output {name} ahead (rad)": row for name, row in deviations}
        return {name: column.tolist() for name, column in made.items()}

    def to_csv(self) -> str:
        """Return all samples as CSV text, with the columns of `columns`.

        Returns
        -------
        str
            Comma-separated values with a header that names the units.
        """
        columns = self.columns
        return csv_text([*columns], zip(*columns.values(), strict=True))


# ------------------------------------------------------------------------------------------------------- parts of a run


@dataclass(frozen=True)
class ContactInTime(Result):
    """Results for one pair, pin or escapement from a time-domain simulation."""

    name: str
    """Name of the pair or coupling; for an escapement, the name of its link."""
    apart: float
    """Fraction of the time during which no flank is in contact."""
    coast: float
    """Fraction of the time during which the coast flank is in contact, or is closer than the drive flank."""
    impact_rate: float
    """Number of impacts per second [1/s]."""
    power: float
    """Mean power lost in impacts [W]."""
    hardest: float
    """Maximum closing speed over all impacts, measured at the driven side [rad/s]."""
    torque: float
    """Mean torque on the driven side, positive in the direction of its motion [N m]."""
    rubbed: float
    """Mean power lost to friction [W]."""
    gap: float
    """Maximum gap between the driven side and the closer flank, as an angle of the driven side [rad]."""
    changes: float
    """Number of changes per second from one flank to the other flank without an interval of separation [1/s]."""
    peak: float | None = None
    """Maximum torque on the driven side of compliant teeth [N m]; None for rigid teeth, whose impacts are impulsive."""
    dynamic_factor: float | None = None
    """Dynamic factor: `peak` divided by the maximum quasi-static torque; None for rigid teeth, or if no speed is
    prescribed.
    """


@dataclass(frozen=True)
class ImpactList(Result):
    """Impacts in a run in chronological order, up to a storage limit."""

    KEYS = ("total",)

    total: int
    """Total number of impacts, including impacts beyond the storage limit."""
    contact: tuple[str, ...]
    """Name of the pair, pin or escapement of each stored impact."""
    time: Floats
    """Time of each impact [s]. Shape (stored,)."""
    speed: Floats
    """Closing speed of each impact [rad/s]. Shape (stored,)."""
    energy: Floats
    """Energy dissipated in each impact [J]. Shape (stored,)."""
    impulse: Floats
    """Impulse on the driven side in each impact [N m s]. Shape (stored,)."""


@dataclass(frozen=True)
class EnergyAccount(Result):
    """Energy balance of a run [J]: the input work equals the losses plus the increase of stored energy."""

    KEYS = (
        *("drive", "loads", "springs", "bearings", "drag", "friction", "impact_loss", "steps", "kinetic", "elastic"),
        *("stored", "closure"),
    )

    drive: float
    """Work of a drive with a prescribed speed [J]."""
    loads: float
    """Work of the constant load torques [J]."""
    springs: float
    """Work of springs [J]."""
    bearings: float
    """Energy lost to dry friction in bearings [J]."""
    drag: float
    """Energy lost to viscous drag [J]."""
    friction: float
    """Energy lost to friction of teeth and pins, and to losses given by declared efficiencies [J]."""
    impact_loss: float
    """Energy lost in impacts, or in the damping of compliant teeth [J]."""
    steps: float
    """Numerical dissipation in sustained contacts [J]. It can have either sign, and it decreases with the time step."""
    kinetic: float
    """Increase of kinetic energy [J]."""
    stored: float
    """Kinetic energy at the end of the evaluated part [J]."""
    elastic: float = 0.0
    """Increase of the elastic energy of compliant teeth [J]."""

    @property
    def put_in(self) -> float:
        """Total work of the drive, the loads and the springs [J]."""
        return self.drive + self.loads + self.springs

    @property
    def closure(self) -> float:
        """Relative error of the energy balance: its residual divided by the sum of the magnitudes of all terms and the
        stored energy.
        """
        # the balance is closed by the numerical dissipation `steps`
        taken = self.bearings + self.drag + self.friction + self.impact_loss + self.steps
        kept = self.kinetic + self.elastic
        # the scale includes stored energy: a free motion has neither input nor losses
        scale = sum(abs(each) for each in (self.put_in, taken, kept, self.stored))
        return abs(self.put_in - taken - kept) / scale if scale else 0.0


@dataclass(frozen=True)
class OutputDeviation(Result):
    """Deviation of an output from the motion with all drive flanks in contact."""

    output: str
    """Name of the output."""
    ahead: float
    """Maximum angle by which the output is ahead of the motion with all drive flanks in contact [rad], 0 or more."""
    behind: float
    """Maximum angle by which the output lags the motion with all drive flanks in contact [rad], 0 or more."""
    rms: float
    """Root mean square of the deviation of the output [rad]."""


@dataclass(frozen=True)
class ConvergedFigure(Result):
    """Result of two simulations with time steps h and h/2, used to check convergence."""

    name: str
    """Name of the result."""
    unit: str
    """Unit of the values; empty for a fraction."""
    coarse: float
    """Value with the time step h, in `unit`."""
    fine: float
    """Value with the time step h/2, in `unit`."""
    kind: Literal["mean", "extreme"]
    """Kind of result, "mean" or "extreme".

    A mean over the run converges as the time step decreases. An extreme depends on individual separations, which are
    chaotic.
    """
    converged: bool
    """True if the values `coarse` and `fine` agree within the tolerance and, for a mean, the confidence interval is not
    wider than the tolerance.

    The tolerance is 5 % for a mean, 1 % for an extreme, 0.005 for a fraction of time, and at least 1e-6 rad for an
    angle.
    """
    interval: float | None = None
    """Half-width of the 95 % confidence interval of a mean, computed from batches of whole turns; None for an extreme,
    and for a simulation of fewer than 5 turns.
    """


@dataclass(frozen=True)
class SpectrumPeak(Result):
    """Line in the spectrum of the deviation of an output's angle from its mean motion."""

    order: float
    """Number of vibration periods per revolution of the driving link."""
    frequency: float
    """Frequency of the line [Hz]."""
    amplitude: float
    """Amplitude of the output's angle at this frequency [rad]."""
    source: str
    """Pair (or beat) and harmonic that have this frequency, such as `c2~d1 x1`; empty if no source has this
    frequency.
    """
