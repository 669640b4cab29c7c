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
    from geartrain.simulation.time.run_parts import (
        ContactInTime,
        EnergyAccount,
        ImpactList,
        OutputLead,
        SettledFigure,
        SpectrumPeak,
    )


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
