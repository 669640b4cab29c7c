"""What a train did in time: angles, speeds, torques, shares of time apart, impacts, and the account of its energy."""

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
    """A train in time, by steps of one length; everything is of the run with the shorter steps.

    See Also
    --------
    geartrain.GearTrain.dynamics : gives these.

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
        "* ahead (rad)": "Angle by which the output is ahead of its motion without inertia [rad].",
    }

    PAGE = "simulation.time.time_report:time_document"

    FIGURE = "time_run_figure"
    DRAWN_IN = "simulation"

    KEYS = (
        "train",
        "state",
        "model",
        "driving_link",
        "rate",
        "link",
        "driven",
        "restitution",
        "step",
        "skip",
        "duration",
        "torque",
        "contacts",
        "impacts",
        group("energy", Key("", "energy")),
        "deviations",
        "spectra",
        "figures",
        "unsolved",
        "notes",
        "assumed",
        "complete",
    )

    train: str
    """Its name."""
    state: str | None
    """The declared state."""
    driving_link: str
    """The input that sets the scale."""
    rate: float
    """Its mean speed in the counted part of the run [rad/s], below 0 where it turns backwards."""
    link: str
    """Where power enters."""
    driven: Literal["rate", "torque", "spring", "hand"]
    """By what: a speed that is kept; a torque, also of a weight; a spring; a hand that yields."""
    step: float
    """Length of a step [s]."""
    skip: float
    """Time before what is counted [s]."""
    duration: float
    """Time that is counted [s]."""
    time: Floats
    """Times of the samples [s]. Shape (n,)."""
    turns: Floats
    """Turns of the lead at the samples, positive in its declared sense. Shape (n,)."""
    angles: LabelledArray
    """Angles of all links [rad]. Shape (link, time)."""
    speeds: LabelledArray
    """Speeds of all links [rad/s]. Shape (link, time)."""
    torques: LabelledArray
    """Means between samples, of torques on the driven sides [N m]. Shape (contact, time)."""
    gaps: LabelledArray
    """Distance of the driven side from its drive flank [rad]. Drive flanks push while the lead turns as declared.
    Shape (pair, time)."""
    coast_gaps: LabelledArray
    """Distance of the driven side from its coast flank [rad]. Shape (pair, time)."""
    outputs: LabelledArray
    """Angles through which outputs have turned [rad]. Shape (output, time)."""
    ahead: LabelledArray
    """Angles by which outputs are ahead of `motion` [rad]. Shape (output, time)."""
    drive: Floats
    """Torque where power enters, mean between samples [N m], the way the train turns. Shape (n,)."""
    torque: float
    """Mean of that over what is counted: its work over the angle [N m]."""
    contacts: tuple[ContactInTime, ...]
    """By pair, pin and escapement."""
    impacts: ImpactList
    """Those of the counted part."""
    energy: EnergyAccount
    """Of the counted part."""
    deviations: tuple[OutputDeviation, ...]
    """Outputs against `motion`."""
    spectra: Mapping[str, tuple[SpectrumPeak, ...]]
    """By output, strongest first."""
    figures: tuple[ConvergedFigure, ...]
    """What steps of h and h/2 say."""
    unsolved: int
    """Steps in which no consistent set of contacts was found; their last guess was taken."""
    notes: tuple[str, ...]
    """What is left out."""
    complete: bool = True
    """False if it was stopped: then all is of the run with the longer steps, as far as that came, and not compared."""
    model: Literal["rigid", "compliant"] = "rigid"
    """Whether teeth yield."""
    assumed: tuple[str, ...] = ()
    """What nothing declares and was estimated."""
    restitution: float = 0.0
    """The greatest of those of the contacts."""
    _without: tuple[str, ...] = field(default=(), kw_only=True, repr=False, compare=False)

    def _summary(self) -> str:
        state = "" if self.state is None else f" state {self.state}"
        rate = f"{abs(self.rate) / tau:.4g} turn/s of {self.driving_link}"
        apart = max((each.apart for each in self.contacts), default=0.0)
        figures = [f"{self.duration:.4g} s", f"mean torque {self.torque:.4g} N m at {self.link}"]
        figures.append(f"teeth apart at most {100 * apart:.3g} % of the time")
        return f"{self.train}{state}: {rate}, {', '.join(figures)}" + ("" if self.complete else ", incomplete")

    def __getitem__(self, name: str) -> Floats | ContactInTime:
        """The angles of a link [rad], or the course of a pair."""
        for each in self.contacts:
            if each.name == name:
                return each
        found: Floats = self.angles[name]
        return found

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """All samples: time, turns, angles and speeds of links, torques of contacts and drive, gaps, deviations."""
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
        """All samples as a table, as `columns` has them.

        Returns
        -------
        str
            Comma-separated, with a head that names units.
        """
        columns = self.columns
        return csv_text([*columns], zip(*columns.values(), strict=True))


# ------------------------------------------------------------------------------------------------------- parts of a run


@dataclass(frozen=True)
class ContactInTime(Result):
    """What one pair, pin or escapement did during a run.

    See Also
    --------
    TimeRun.contacts : where these stand.
    """

    name: str
    """The pair or coupling; of an escapement its link."""
    apart: float
    """Share of time in which no flank touches."""
    coast: float
    """Share of time on the coast flank, or nearer to it."""
    impact_rate: float
    """Impacts a second [1/s]."""
    power: float
    """What they take [W]."""
    hardest: float
    """Greatest closing speed of one, of the driven side [rad/s]."""
    torque: float
    """Mean torque on the driven side, forwards positive [N m]."""
    rubbed: float
    """What friction takes [W]."""
    gap: float
    """Greatest gap, to the nearer flank [rad]."""
    changes: float
    """Changes from one flank to the other without time apart [1/s]."""
    peak: float | None = None
    """Greatest torque on the driven side of teeth that yield [N m]; None of rigid ones, which give blows."""
    dynamic_factor: float | None = None
    """That over the greatest torque in balance at every moment; None where no speed is prescribed."""


@dataclass(frozen=True)
class ImpactList(Result):
    """Impacts one after another, as far as they were kept.

    See Also
    --------
    TimeRun.impacts : where it stands.
    """

    KEYS = ("total",)

    total: int
    """How many there were."""
    contact: tuple[str, ...]
    """The pair, pin or escapement of each that was kept."""
    time: Floats
    """Time of each impact [s]. Shape (kept,)."""
    speed: Floats
    """Closing speed [rad/s]. Shape (kept,)."""
    energy: Floats
    """Energy dissipated [J]. Shape (kept,)."""
    impulse: Floats
    """Impulse on the driven side [N m s]. Shape (kept,)."""


@dataclass(frozen=True)
class EnergyAccount(Result):
    """Where energy came from and went [J]: what is put in is what is taken and what kinetic energy has grown by.

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
        "impact_loss",
        "steps",
        "kinetic",
        "elastic",
        "stored",
        "closure",
    )

    drive: float
    """Work of what keeps a speed [J]."""
    loads: float
    """Work of constant torques [J]."""
    springs: float
    """Work of springs [J]."""
    bearings: float
    """Energy lost by dry friction in bearings [J]."""
    drag: float
    """Energy lost by viscous drag [J]."""
    friction: float
    """Energy lost by friction of teeth and pins [J]."""
    impact_loss: float
    """Taken by impacts; of teeth that yield, by their damping."""
    steps: float
    """Taken, or given, by contact that lasts: an error of the steps' length, that falls with it."""
    kinetic: float
    """Growth of kinetic energy."""
    stored: float
    """Kinetic energy at the end."""
    elastic: float = 0.0
    """Growth of the energy stored in teeth that yield."""

    @property
    def put_in(self) -> float:
        """Work of drive, loads and springs."""
        return self.drive + self.loads + self.springs

    @property
    def closure(self) -> float:
        """By how much the account does not close, over all that passed through it and what is stored."""
        taken = self.bearings + self.drag + self.friction + self.impact_loss + self.steps
        kept = self.kinetic + self.elastic
        scale = sum(abs(each) for each in (self.put_in, taken, kept, self.stored))
        return abs(self.put_in - taken - kept) / scale if scale else 0.0


@dataclass(frozen=True)
class OutputDeviation(Result):
    """How far an output runs ahead of the motion in which all drive flanks touch, and behind it.

    See Also
    --------
    TimeRun.deviations : where these stand.
    """

    output: str
    """Its name."""
    ahead: float
    """Greatest angle ahead of `motion`, 0 or more [rad]."""
    behind: float
    """Greatest angle behind `motion`, 0 or more [rad]."""
    rms: float
    """Root mean square of the difference [rad]."""


@dataclass(frozen=True)
class ConvergedFigure(Result):
    """A figure by steps of length h and h/2, with what the length of the run leaves open.

    See Also
    --------
    TimeRun.figures : where these stand.
    """

    name: str
    """What it is of."""
    unit: str
    """Its unit."""
    coarse: float
    """Value by steps of length h."""
    fine: float
    """Value by steps of length h/2."""
    kind: Literal["mean", "extreme"]
    """A mean over the run holds if steps are short; an extreme depends on single flights, which are chaotic."""
    converged: bool
    """Whether both agree: a mean to 5 %, an extreme to 1 %, a share of time to 0.005, an angle to 1e-6 rad if that
    is more; and whether the interval of a mean is as narrow."""
    interval: float | None = None
    """Half the 95 % interval of a mean, from blocks of whole turns; None of an extreme, and of fewer than 5 turns."""


@dataclass(frozen=True)
class SpectrumPeak(Result):
    """A line of the spectrum of an output's angle about its mean motion.

    See Also
    --------
    TimeRun.spectra : where these stand.
    """

    order: float
    """Periods in a turn of the lead."""
    frequency: float
    """The same a second [Hz]."""
    amplitude: float
    """Of the angle [rad]."""
    source: str
    """The pair (or beat) and harmonic that fall on it, such as `c2~d1 x1`; empty for none."""
