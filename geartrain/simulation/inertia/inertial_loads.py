"""What acts on the links of a train besides their pairs: inertia, loads, friction of bearings, viscous drag."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Tree
    from geartrain.numerics.quantity import Quantity
    from geartrain.simulation.inertia.link_inertia import LinkInertia
    from geartrain.train import StateCase, Train


@dataclass(frozen=True)
class InertialLoads:
    """What acts on links besides their pairs: SI units, by link, about their own axes.

    inertia    kg m2; of a link that takes others round, theirs too
    load       constant torque (N m), positive about the link's axis
    friction   of its bearing while it turns (N m), 0 or more; `drag`, viscous (N m s)
    bearer     the link in which it turns
    crank      the link at which power enters so that the input turns evenly; None where that is the input
    """

    inertia: Mapping[str, float]
    load: Mapping[str, float]
    friction: Mapping[str, float]
    drag: Mapping[str, float]
    bearer: Mapping[str, str]
    crank: str | None = None


def find_inertial_loads(
    train: Train, case: StateCase, tree: Tree, inertias: Sequence[LinkInertia], speeds: Mapping[str, Fraction]
) -> InertialLoads:
    """Of one state. Raises `QuestionError` where no link has an inertia, or a torque has no unit.

    speeds   mean speeds of links: a weight or a torque that drives pulls the way its link turns
    """
    if not any(each.value for each in inertias):
        what = f"no link of '{train.name}' has a moment of inertia"
        fix = "give links an `inertia`, such as 30 kg mm2, or wheels `density`, `thickness` and `module`"
        raise QuestionError(Problem(what, "without one no teeth part", fix))
    turning = {link: part for link, part in train.links.items() if link != train.frame}
    load, friction = _torques(train, case)
    for key, torques in (("load", load), ("bearing", friction)):
        for link, torque in torques.items():
            if _is_plain(torque):
                what = f"the {key} of '{link}', {torque}, has no unit"
                raise QuestionError(Problem(what, "inertias are in kg m2", f"write for example '{torque} N m'"))
    return InertialLoads(
        {each.link: each.value for each in inertias},
        loads_with_drive({link: torque.si for link, torque in load.items()}, train, case, speeds),
        {link: torque.si for link, torque in friction.items()},
        {link: part.drag.si for link, part in turning.items() if part.drag is not None},
        {link: tree.parent[link][0] for link in turning},
        train.crank if _is_cranked(train, case) and speeds[train.crank or ""] else None,
    )


def loads_with_drive(
    loads: dict[str, float], train: Train, case: StateCase, speeds: Mapping[str, Fraction]
) -> dict[str, float]:
    """Loads, and at the crank what drives with a steady torque, where the crank is not the input that stays."""
    torque = None if case.drive is None else case.drive.steady_torque
    if torque is None or train.crank is None or train.crank in case.inputs:
        return loads
    way = -1 if speeds[train.crank] < 0 else 1
    return {**loads, train.crank: loads.get(train.crank, 0.0) + way * torque}


def _is_cranked(train: Train, case: StateCase) -> bool:
    """True if a link that is no input keeps the input turning: one that drives with a torque of its own does not."""
    steady = case.drive is not None and case.drive.steady_torque is not None
    return train.crank is not None and train.crank not in case.inputs and len(case.inputs) == 1 and not steady


def torques_have_units(train: Train, case: StateCase) -> bool:
    """True if every torque that acts in one state has a unit."""
    return not any(_is_plain(torque) for torques in _torques(train, case) for torque in torques.values())


def _torques(train: Train, case: StateCase) -> tuple[dict[str, Quantity], dict[str, Quantity]]:
    """Loads and friction of bearings, by link; loads on inputs do no work when pairs give way, unless a crank does."""
    still = {train.frame} if _is_cranked(train, case) else {train.frame, *case.inputs}
    loads = {link: torque for link, torque in case.loads.items() if link not in still}
    bearings = ((link, part.bearing) for link, part in train.links.items() if link != train.frame)
    return loads, {link: bearing.sliding for link, bearing in bearings if bearing is not None}


def _is_plain(torque: Quantity) -> bool:
    return torque.unit is None and bool(torque.value)
