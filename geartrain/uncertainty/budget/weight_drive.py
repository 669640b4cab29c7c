"""A weight on its drum: the torque it gives, what the train needs, and what of it arrives at the escape wheel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Result
from geartrain.numerics.quantity import Quantity
from geartrain.uncertainty.budget.natural_run import find_natural_run

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle


@dataclass(frozen=True, slots=True)
class WeightDrive(Result):
    """What a weight gives at its drum, and what the train makes of it over a run.

    Attributes
    ----------
    link : str
        The link of the drum.
    torque : float
        Mass times gravity times the radius at which the line pulls [N m].
    needed : float or None
        What starts the train at its worst position under its declared loads [N m]; None without loads, or where it
        locks.
    wheel : str or None
        The link of the escape wheel; None where none is declared, or loads are.
    mean, least : float or None
        Torque that arrives there while the weight alone drives, the mean and the least over the run [N m].
    efficiency : float or None
        Energy that arrives there over that of the weight.

    See Also
    --------
    CrankLoad : holds it
    """

    KEYS = ("link", "torque", "needed", "suffices", "wheel", "mean", "least", "efficiency")

    link: str
    torque: float
    needed: float | None = None
    wheel: str | None = None
    mean: float | None = None
    least: float | None = None
    efficiency: float | None = None

    @property
    def suffices(self) -> bool | None:
        """True if the weight starts the train at its worst position; None where that is not known."""
        return None if self.needed is None else self.torque >= self.needed


def find_weight_drive(
    train: GearTrain, state: str | None, link: str, lead: str, under_load: TorqueCycle | None
) -> WeightDrive | None:
    """The weight that drives a train in one state; None where another thing drives it.

    link         the drum's; `lead`, the input
    under_load   torque over the run under the declared loads; None where none are declared
    """
    drive = train.declaration.case(state).drive
    if drive is None or drive.pull is None:
        return None
    if under_load is not None:
        return WeightDrive(link, drive.pull, under_load.starting_torque)
    escapement = train.declaration.escapement
    if escapement is None:
        return WeightDrive(link, drive.pull)
    found = find_natural_run(_driven_by(train, state, link, drive.pull), state, lead, escapement.link)
    mean = None if found.mean is None else -found.mean
    least = None if found.greatest is None else -found.greatest.torque
    return WeightDrive(link, drive.pull, None, escapement.link, mean, least, found.efficiency)


def _driven_by(train: GearTrain, state: str | None, link: str, pull: float) -> GearTrain:
    """The same train with this torque at the drum, the way it turns."""
    from geartrain.analysis.gear_train import GearTrain

    speed = train.solve(state)[link]
    way = -1 if speed is not None and speed < 0 else 1
    load = Quantity.parse(f"{way * pull!r} N m", "torque", plain=False)
    return GearTrain(train.declaration.model_copy(update={"loads": {link: load}}))
