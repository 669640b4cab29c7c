"""What a train did in time: angles, speeds, torques, shares of time apart, impacts, and the account of its energy."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import tau
from typing import TYPE_CHECKING, Any, Literal

from geartrain.numerics.files import csv_text
from geartrain.numerics.results import Key, Pictured, Result, Tabular, group

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray


@dataclass(frozen=True)
class TimeRun(Tabular, Pictured, Result):
    """A train in time, by steps of one length; everything is of the run with the shorter steps.

    Attributes
    ----------
    train : str
        Its name.
    state : str or None
        The declared state.
    lead : str
        The input that sets the scale.
    rate : float
        Its mean speed in the counted part of the run [rad/s], below 0 where it turns backwards.
    step : float
        Length of a step [s].
    link : str
        Where power enters.
    driven : {"rate", "torque", "spring", "hand"}
        By what: a speed that is kept; a torque, also of a weight; a spring; a hand that yields.
    skip, duration : float
        Time before what is counted, and of what is counted [s].
    time, turns : array of float, (n,)
        Of the samples: time [s], and turns of the lead, counted the way in which it is declared to turn.
    angles, speeds : LabelledArray, (link, time)
        Of all links [rad, rad/s].
    torques : LabelledArray, (contact, time)
        Means between samples, of torques on the driven sides [N m].
    gaps, coast_gaps : LabelledArray, (pair, time)
        By how much the driven side is off its drive flank, and off its coast flank [rad]: drive flanks are those that
        push while the lead turns as declared.
    outputs, ahead : LabelledArray, (output, time)
        Angles through which outputs have turned, and by how much they are ahead of `motion` [rad].
    drive : array of float, (n,)
        Torque where power enters, mean between samples [N m], the way the train turns.
    torque : float
        Mean of that over what is counted: its work over the angle [N m].
    contacts : tuple of ContactInTime
        By pair, pin and escapement.
    impacts : ImpactList
        Those of the counted part.
    energy : EnergyAccount
        Of the counted part.
    leads : tuple of OutputLead
        Outputs against `motion`.
    spectra : mapping of str to tuple of SpectrumPeak
        By output, strongest first.
    figures : tuple of SettledFigure
        What steps of h and h/2 say.
    unsolved : int
        Steps in which no consistent set of contacts was found; their last guess was taken.
    notes : tuple of str
        What is left out.
    complete : bool
        False if it was stopped: then all is of the run with the longer steps, as far as that came, and not compared.
    model : {"rigid", "compliant"}
        Whether teeth yield.
    assumed : tuple of str
        What nothing declares and was estimated.
    restitution : float
        The greatest of those of the contacts.

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

    FIGURE = "time_run_figure"
    DRAWN_IN = "simulation"

    KEYS = (
        "train",
        "state",
        "model",
        "lead",
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
        "leads",
        "spectra",
        "figures",
        "unsolved",
        "notes",
        "assumed",
        "complete",
    )

    train: str
    state: str | None
    lead: str
    rate: float
    link: str
    driven: Literal["rate", "torque", "spring", "hand"]
    step: float
    skip: float
    duration: float
    time: Floats
    turns: Floats
    angles: LabelledArray
    speeds: LabelledArray
    torques: LabelledArray
    gaps: LabelledArray
    coast_gaps: LabelledArray
    outputs: LabelledArray
    ahead: LabelledArray
    drive: Floats
    torque: float
    contacts: tuple[ContactInTime, ...]
    impacts: ImpactList
    energy: EnergyAccount
    leads: tuple[OutputLead, ...]
    spectra: Mapping[str, tuple[SpectrumPeak, ...]]
    figures: tuple[SettledFigure, ...]
    unsolved: int
    notes: tuple[str, ...]
    complete: bool = True
    model: Literal["rigid", "compliant"] = "rigid"
    assumed: tuple[str, ...] = ()
    restitution: float = 0.0

    def __getitem__(self, name: str) -> Floats | ContactInTime:
        """The angles of a link [rad], or the course of a pair."""
        for each in self.contacts:
            if each.name == name:
                return each
        found: Floats = self.angles[name]
        return found

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """All samples: time, turns, angles and speeds of links, torques of contacts and drive, gaps, leads."""
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
        leads = zip(self.ahead.labels[0], self.ahead.values, strict=True)
        made |= {f"output {name} ahead (rad)": row for name, row in leads}
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

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(each.name)}</td><td>{100 * each.apart:.3g}</td><td>{100 * each.coast:.3g}</td>"
            f"<td>{each.blows:.4g}</td><td>{1e3 * each.power:.3g}</td></tr>"
            for each in self.contacts
        )
        head = "<tr><th>contact</th><th>apart (%)</th><th>coast (%)</th><th>blows (1/s)</th><th>blows (mW)</th></tr>"
        text = f"{html.escape(self.train)}: {self.rate / tau:.4g} turn/s of {html.escape(self.lead)}"
        return f"<p>{text}</p><table>{head}{rows}</table>"


# ------------------------------------------------------------------------------------------------------- parts of a run


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
