"""What friction adds to the driver's arm of a pair: T_1 = (tau + more) T_2, docs/dynamics.md (10).

Four cases of flank and turning. On one flank the sliding changes its sign with the turning, so that what passes
eta(f) = (1 + f out)/(1 + f into) of its power forwards asks tau/eta(f) of the driver, and tau/eta(-f) backwards,
whichever wheel puts the power in.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.simulation.contacts.pair_tables import TabledFunction, tabled_function
from geartrain.teeth.rubbed_transmission import RubbedTransmission

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.inertial_contacts import FlankArms
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.pin_transmission import PinTransmission
    from geartrain.teeth.transmission import ContactRubbing, TransmissionFunction
    from geartrain.train.mechanism import GearPair

_ROUGH = 1e-4  # of what friction adds, where it is read between nodes
Arms = tuple[TabledFunction, TabledFunction, TabledFunction, TabledFunction]
"""Of the drive flank turning forward and back, and of the coast flank turning forward and back."""


def tooth_arms(mesh: GearMesh) -> Arms | None:
    """What friction adds to the arm of a driver of teeth; None where nothing says that they rub."""
    ahead, back = drive_flank_arms(mesh), _flank_arms(mesh, mesh.coast)
    return None if ahead is None or back is None else (ahead[0], ahead[1], back[1], back[0])


def drive_flank_arms(mesh: GearMesh) -> tuple[TabledFunction, TabledFunction] | None:
    """The same of the drive flank alone, turning forward and back."""
    return _flank_arms(mesh, mesh.transmission)


def _flank_arms(mesh: GearMesh, transmission: TransmissionFunction) -> tuple[TabledFunction, TabledFunction] | None:
    """Of one flank, turning the way in which it was made to drive, and the other way."""
    if not mesh.tells_losses or not mesh.rubs:
        return None
    losses = mesh.losses
    coefficient: Callable[[Floats], Floats | float] = lambda _: mesh.friction or 0.0  # noqa: E731
    if isinstance(losses, RubbedTransmission):
        coefficient = losses.by

    def table(way: int) -> TabledFunction:
        nodes = transmission.rubbing_nodes()
        if nodes is None:
            return tabled_function(partial(_at_angles, transmission, coefficient, way, mesh.label), transmission)
        # laws that would be slow to ask elsewhere are read between the nodes at which they know how teeth rub
        S = np.mod(nodes[0], transmission.period)
        more = _more_by_teeth(transmission.speed(nodes[0]), nodes[2], coefficient, way, mesh.label)
        return tabled_function(lambda at: np.interp(at, S, more, period=transmission.period), transmission, _ROUGH)

    return table(1), table(-1)


def _at_angles(
    transmission: TransmissionFunction, coefficient: Callable[[Floats], Floats | float], way: int, label: str, S: Floats
) -> Floats:
    return _more_by_teeth(transmission.speed(S), transmission.rubbing(S), coefficient, way, label)


def _more_by_teeth(
    tau: Floats, rubbing: ContactRubbing, coefficient: Callable[[Floats], Floats | float], way: int, label: str
) -> Floats:
    """tau (1/eta - 1) at driver angles; 0 in a standstill, where nothing rubs. `way` -1 reverses the sliding."""
    sliding, into, out = rubbing
    touching = ~np.isnan(out)
    f = way * np.asarray(coefficient(sliding))
    with np.errstate(invalid="ignore", divide="ignore"):
        passed = np.where(touching, (1 + f * out) / (1 + f * into), 0.0).sum(axis=0) / touching.sum(axis=0)
    if (passed[touching.any(axis=0)] <= 0).any():
        why = "friction locks its teeth at some angle, so that no torque of the one wheel moves the other"
        raise GearTrainError(Problem(f"{label} cannot be stepped through time", why, "give it less friction"))
    return np.where(touching.any(axis=0), tau * (1 / np.where(passed > 0, passed, 1.0) - 1), 0.0)


def separate_rubbing(
    moving: MotionProblem, gears: Sequence[GearPair] = ()
) -> tuple[dict[str, FlankArms], tuple[str, ...]]:
    """Drive flanks that rub, of teeth that do not keep their ratio, and all other pairs and pins that lose, by name.

    Teeth that friction locks somewhere are among the others, and gears with a declared efficiency.
    """
    found: dict[str, FlankArms] = {}
    left = []
    for mesh in moving.teeth:
        arms = None
        if not mesh.rigid:
            with suppress(GearTrainError):
                arms = drive_flank_arms(mesh)
        if arms is not None:
            found[mesh.name] = arms[0].__call__, arms[1].__call__
        elif mesh.rubs:
            left.append(mesh.name)
    left += [joint.coupling.name for joint in moving.pins if joint.transmission.friction]
    for gear in gears:
        if gear.name not in found and gear.efficiency is not None and gear.efficiency.forward.base < 1:
            left.append(gear.name)
    return found, tuple(dict.fromkeys(left))


def pin_arms(transmission: PinTransmission) -> Arms | None:
    """The same for a pin that drives a slot: (r/rho) f |sin d|, with the sign of slot torque and turning."""
    if not transmission.friction:
        return None

    def more(S: Floats) -> Floats:
        half = np.sin(S / 2)
        square = (transmission.r - transmission.e) ** 2 + 4 * transmission.r * transmission.e * half**2
        return np.asarray(transmission.r * transmission.friction * transmission.e * np.abs(np.sin(S)) / square)

    plus, minus = tabled_function(more, transmission), tabled_function(lambda S: -more(S), transmission)
    return plus, minus, minus, plus


def even_arms(transmission: TransmissionFunction, forward: float, backward: float, label: str) -> Arms | None:
    """The same for a pair that keeps its ratio and passes a declared part of its power, by the wheel that drives."""
    if forward == 1 and backward == 1:
        return None
    if forward <= 0:
        why = f"its efficiency is {forward:g} with the wheel driving that drives here"
        raise GearTrainError(Problem(f"{label} cannot be stepped through time", why, "give an efficiency above 0"))
    ratio = float(transmission.ratio)

    def constant(value: float) -> TabledFunction:
        return tabled_function(lambda S: np.full(np.shape(S), value), transmission)

    ahead, back = constant(ratio * (1 / forward - 1)), constant(ratio * (max(backward, 0.0) - 1))
    return ahead, back, back, ahead
