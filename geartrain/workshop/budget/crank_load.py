"""Torque and efficiency of the link that drives a train, at mean speeds and over a run.

The run is a year, or a shorter period after which the motion repeats. A weight on a drum exerts a torque, part of
which reaches the escape wheel.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.train_torques import drive_both_ways
from geartrain.dynamics.turn.train_turn import find_torque_period
from geartrain.errors import GearTrainError
from geartrain.numerics.quantity import TRAVEL_ARM, Quantity
from geartrain.numerics.results import Result
from geartrain.train.periods import period_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle, Torques
    from geartrain.train import Train


# ------------------------------------------------------------------------------------------------------------------ run


YEAR = period_table()["year_tropical_J2000"].value  # d
MOST_PASSAGES = 600_000
"""Maximum product of the number of tooth engagements in a run and the number of pairs evaluated at each engagement.

Longer runs are shortened to this number, which takes about two minutes without compiled kernels.
"""
SAMPLES = 2_000  # positions of the input in a run


def find_natural_run(train: GearTrain, state: str | None, driving_link: str, of: str | None = None) -> TorqueCycle:
    """Return the torque of a link over the standard run of a train: a year, or its period if that is shorter.

    driving_link   name of the input link; `natural_turns` gives its turns in the run
    of             name of the link whose torque is computed, by default the crank
    """
    turns = natural_turns(train, state, driving_link, of)
    return train.torques(state, turns=turns, samples=SAMPLES, of=of)


def natural_turns(train: GearTrain, state: str | None, driving_link: str, of: str | None = None) -> float:
    """Return the number of turns of the input in the standard run of a train, over which torques are computed.

    The run is a year, or the period after which the motion repeats if that is shorter. If the unit of speeds is not a
    time, one unit replaces the year. For a train of constant ratio any run gives the same result, so the run is one
    unit of time. A run with more than `MOST_PASSAGES` evaluations is shortened.
    """
    once = abs(train.declaration.case(state).inputs[driving_link]) or 1  # an input of speed 0 has no period
    period, unit = find_torque_period(train.mechanics, state, of), train.declaration.unit_days
    if period is None:
        return float(once)
    used = train.motion(state, tuple(train.declaration.links))._forward.used
    passages = len(used) * sum(each.pace for each in used)
    whole = min(period, once if unit is None else once * YEAR / unit)
    return float(whole) if passages * whole <= MOST_PASSAGES else MOST_PASSAGES / passages


# --------------------------------------------------------------------------------------------------------------- weight


@dataclass(frozen=True, slots=True)
class WeightDrive(Result):
    """Torque of a driving weight at its drum, and the torque that it produces at the escape wheel over a run."""

    KEYS = ("link", "torque", "needed", "suffices", "wheel", "mean", "minimum", "efficiency")

    link: str
    """Name of the link that carries the drum, or of the link that represents the weight itself."""
    torque: float
    """Torque of the weight on the drum [N m]: mass times gravity times the radius at which the line acts. For a link
    that represents the weight itself, it is the force of the weight [N].
    """
    needed: float | None = None
    """Torque required at the drum to start the train from its worst position under the declared loads [N m].

    The value is None if no loads are declared, or if friction locks the train.
    """
    wheel: str | None = None
    """Name of the escape wheel's link; None if there is no escapement or if loads are declared."""
    mean: float | None = None
    """Mean torque at the escape wheel over the run, driven by the weight only [N m]."""
    minimum: float | None = None
    """Minimum torque at the escape wheel over the run, driven by the weight only [N m]."""
    efficiency: float | None = None
    """Energy that reaches the escape wheel divided by the energy of the weight; None if it is not computed."""
    unit: str = "N m"
    """Unit of `torque` and `needed`: N m, or N for a link that represents the weight itself."""

    @property
    def suffices(self) -> bool | None:
        """True if the weight can start the train from its worst position; None if the required torque is unknown."""
        return None if self.needed is None else self.torque >= self.needed


def find_weight_drive(
    train: GearTrain, state: str | None, link: str, driving_link: str, under_load: TorqueCycle | None
) -> WeightDrive | None:
    """Return the torques of the weight that drives a train in one state; None if no weight drives the train.

    link           link that carries the drum; `driving_link` is the input link
    under_load     torque over the run under the declared loads; None if no loads are declared
    """
    drive = train.declaration.case(state).drive
    if drive is None or drive.pull is None:
        return None
    arm, unit = (float(TRAVEL_ARM), "N") if link in train.declaration.sliding else (1.0, "N m")
    pull = drive.pull / arm
    if under_load is not None:
        return WeightDrive(link, pull, under_load.starting_torque, unit=unit)
    escapement = train.declaration.escapement
    if escapement is None:
        return WeightDrive(link, pull, unit=unit)
    found = find_natural_run(_driven_by(train, state, link, f"{pull!r} {unit}"), state, driving_link, escapement.link)
    # the escape wheel resists, so its torque is the negative of the load
    mean = None if found.mean is None else -found.mean
    minimum = None if found.maximum is None else -found.maximum.torque
    return WeightDrive(link, pull, None, escapement.link, mean, minimum, found.efficiency, unit)


def _driven_by(train: GearTrain, state: str | None, link: str, pull: str) -> GearTrain:
    """Return a copy of the train whose only load is the torque or force `pull` on a link, in its sense of motion."""
    from geartrain.analysis.gear_train import GearTrain

    speed = train.solve(state)[link]
    way = "-" if speed is not None and speed < 0 else ""
    load = Quantity.parse(f"{way}{pull}", "torque or force", plain=False)
    return GearTrain(train.declaration.model_copy(update={"loads": {link: load}}))


# ---------------------------------------------------------------------------------------------------------------- crank


@dataclass(frozen=True, slots=True)
class CrankLoad(Result):
    """Torque and efficiency at the driving link of a train."""

    link: str
    """Name of the driving link: the crank or the input."""
    torque: float | None
    """Torque under the declared loads [N m, or the unit of the loads]; None if no loads are declared.

    The torque is positive if it acts in the sense of rotation of the link and therefore supplies power, as in
    `over_turn`.
    """
    efficiency: float | None
    """Output power divided by input power; None if it is undetermined, or if no friction or efficiency is declared."""
    note: str
    """Note on the loads that apply, or on missing data."""
    pointers: Mapping[str, float] = field(default_factory=dict)
    """Mapping from pointer to the efficiency of the train if only this pointer is driven.

    Pointers that cannot be driven are omitted. The mapping is empty if there is no friction.
    """
    over_turn: TorqueCycle | None = None
    """Torque over the standard run (`natural_turns`); None if no loads are declared or if it cannot be computed."""
    weight: WeightDrive | None = None
    """Torques of the weight that drives the train; None if no weight drives it, or if they cannot be computed."""


def find_crank_load(train: GearTrain, state: str | None, driving_link: str, links: Mapping[str, str]) -> CrankLoad:
    """Return the load of the crank at mean speeds and over a run.

    Without declared loads, the result contains the efficiency from the input to the output, and the results of a
    driving weight if one is declared.

    links   name of the link that turns with each pointer, by pointer
    """
    found = _at_mean_speeds(train, state, driving_link, links)
    drive = train.declaration.case(state).drive
    loaded = train.declaration.is_loaded(state)
    if not loaded and (drive is None or drive.pull is None):
        return found
    try:
        over_turn = find_natural_run(train, state, driving_link) if loaded else None
        weight = find_weight_drive(train, state, found.link, driving_link, over_turn)
    except GearTrainError as error:  # pairs with tooth forms in a loop, or teeth that cannot turn
        return replace(found, note=f"{found.note}; not followed over a run: {error.problems[0].what}")
    return replace(found, over_turn=over_turn, weight=weight)


def _at_mean_speeds(train: GearTrain, state: str | None, driving_link: str, links: Mapping[str, str]) -> CrankLoad:
    link, has_losses = train.declaration.crank or driving_link, _has_losses(train.declaration)
    found = train.torques(state)
    pointers = dict(_efficiencies(train, state, link, links)) if has_losses else {}
    # a positive torque acts in the sense in which the link turns
    if found.verdict.kind != "unloaded":
        sense = -1 if train.solve(state).speeds[link] < 0 else 1
        torque = found.external.get(link)
        note = f"under the declared loads: {found.verdict.text}"
        efficiency = _efficiency(found) if has_losses else None
        return CrankLoad(link, None if torque is None else sense * float(torque), efficiency, note, pointers)
    if not has_losses:
        return CrankLoad(link, None, None, "neither loads nor friction are declared", pointers)
    # without a load no torque can be computed, but the efficiency at a unit of power can
    ways = drive_both_ways(train.mechanics, state)
    if not ways or not ways[0].torques.verdict:
        return CrankLoad(link, None, None, "no loads are declared", pointers)
    way = ways[0]
    note = f"no loads are declared: a unit of power from '{way.source}' to '{way.load}'"
    return CrankLoad(link, None, _efficiency(way.torques), note, pointers)


def _efficiencies(
    train: GearTrain, state: str | None, crank: str, links: Mapping[str, str]
) -> Iterator[tuple[str, float]]:
    """Yield the name of each pointer that the crank can drive, and the efficiency from the crank to this pointer."""
    known: dict[str, float | None] = {}
    for name, link in links.items():
        if link != crank and link not in known:
            found = train.driven(link, crank, state)
            known[link] = _efficiency(found) if found.verdict else None
        if (efficiency := known.get(link)) is not None:
            yield name, efficiency


def _efficiency(found: Torques) -> float | None:
    return None if found.efficiency is None else float(found.efficiency)


def _has_losses(declared: Train) -> bool:
    """Return True if any friction (of pairs or bearings) or efficiency is declared."""
    pairs = any(gear.friction is not None or gear.efficiency is not None for gear in declared.gears)
    return declared.friction is not None or pairs or any(link.bearing for link in declared.links.values())
