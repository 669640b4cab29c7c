"""Parts of what torque over a turn answers: extremes with their places, energies, and what each pair does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from geartrain.numerics.results import Key, Result, group


class TorqueExtreme(NamedTuple):
    """A torque, and where in the run it is needed.

    Attributes
    ----------
    torque : float
        At the link asked for, positive where it drives the way the link turns on average [N m, or plain].
    turns : float
        Turns of the input from the start of the run.
    days : float or None
        Time from the start of the run; None where the train's speeds are not by a time.

    See Also
    --------
    TorqueCycle.greatest, TorqueCycle.least, TorqueCycle.starting : where these stand.
    """

    torque: float
    turns: float
    days: float | None = None


class CycleFigures(NamedTuple):
    """What trials are told of a run: mean, greatest and starting torque, efficiency; None where there is none.

    See Also
    --------
    TorqueCycle : everything.
    """

    mean: float | None
    greatest: float | None
    starting: float | None
    efficiency: float | None


class PlaceInRun(NamedTuple):
    """Where in a run something is.

    Attributes
    ----------
    turns : float
        Turns of the input from the start of the run.
    days : float or None
        Time from there; None where the train's speeds are not by a time.

    See Also
    --------
    TorqueCycle.locked : where these stand.
    """

    turns: float
    days: float | None = None


@dataclass(frozen=True)
class CycleEnergy(Result):
    """Energies over a run [J, or plain torque times radians].

    What goes in comes out or is lost: put_in - returned = taken_out - loads_put_in + mesh + pin + bearing.

    Attributes
    ----------
    put_in : float
        What the unknown torques (the crank's) put in, over the stretches in which they do.
    returned : float
        What they take back where loads drive them.
    taken_out : float
        What loads take out, over the stretches in which they do.
    loads_put_in : float
        What loads put in.
    mesh, pin, bearing : float
        What is lost in gear pairs, in pins and slots, in bearings: 0 or more.

    See Also
    --------
    TorqueCycle.energy : where this stands.
    """

    KEYS = (
        *(Key("in", "put_in"), "returned", Key("out", "taken_out"), Key("loads_in", "loads_put_in")),
        *(group("lost", "mesh", "pin", "bearing"), "net_in", "net_out"),
    )

    put_in: float
    returned: float
    taken_out: float
    loads_put_in: float
    mesh: float
    pin: float
    bearing: float

    @property
    def net_in(self) -> float:
        """What the unknown torques put in, less what they take back."""
        return self.put_in - self.returned

    @property
    def net_out(self) -> float:
        """What loads take out, less what they put in."""
        return self.taken_out - self.loads_put_in

    @property
    def efficiency(self) -> float | None:
        """Energy out over energy in; None where nothing is put in on the whole."""
        if self.net_in > 0:
            return max(self.net_out, 0.0) / (self.net_in + max(-self.net_out, 0.0))
        return -self.net_in / -self.net_out if self.net_out < 0 else None

    @property
    def lost(self) -> float:
        """What is lost in pairs, pins and bearings."""
        return self.mesh + self.pin + self.bearing


@dataclass(frozen=True)
class PairCycle(Result):
    """One gear pair, coupling or bearing over a run.

    Attributes
    ----------
    kind : str
        `mesh`, `pin` or `bearing`.
    loss : float
        Energy lost [J, or plain torque times radians].
    passed : float
        Energy that its driving side put in, in its carrier's frame; of a bearing the same as the loss.
    flank_changes : int
        How often the torque through it changes its sense: each time the play of real teeth is crossed. In a run of
        whole periods the change from its end to its start counts.
    greatest : float
        Greatest torque on its driven side at any position, whichever its sense [N m, or plain]; of a bearing 0.

    See Also
    --------
    TorqueCycle.parts : where these stand.
    """

    KEYS = ("kind", "loss", "passed", "flank_changes", "greatest")

    kind: str
    loss: float
    passed: float
    flank_changes: int = 0
    greatest: float = 0.0
