"""Friction terms a_f of the driver's lever arm of a pair: T_1 = (tau + a_f) T_2, equation (10) of docs/dynamics.md.

T_1 and T_2 are the torques of the driver and of the driven wheel, and tau is the speed ratio. A contact transmits the
fraction eta(f) = (1 + f out)/(1 + f into) of its power forwards, with the friction coefficient f and the coefficients
`out` and `into` of its geometry; sliding reverses with the sense of rotation, which gives eta(-f).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.simulation.contacts.pair_tables import TabledFunction, tabled_function
from geartrain.teeth.rubbed_transmission import RubbedTransmission

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.coupling import Coupling
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import ContactRubbing, TransmissionFunction
    from geartrain.train.mechanism import GearPair

_ROUGH = 1e-4  # relative tolerance of friction terms that are interpolated between nodes
Arms = tuple[TabledFunction, TabledFunction, TabledFunction, TabledFunction]
"""Tables of the friction terms: drive flank in forward and backward rotation, then coast flank likewise."""


def tooth_arms(mesh: GearMesh) -> Arms | None:
    """Return the friction terms of a gear pair, which are added to the lever arm of its driver, for both flanks and
    both senses of rotation; None without friction.
    """
    ahead, back = _flank_arms(mesh, mesh.transmission), _flank_arms(mesh, mesh.coast)
    # the coast flank drives in the opposite sense, so its terms are swapped
    return None if ahead is None or back is None else (ahead[0], ahead[1], back[1], back[0])


def _flank_arms(mesh: GearMesh, transmission: TransmissionFunction) -> tuple[TabledFunction, TabledFunction] | None:
    """Return the friction terms of one flank as functions of the driver angle, first for the sense of rotation in which
    the flank drives, then for the opposite sense; None without friction.
    """
    if not mesh.computes_losses or not mesh.has_friction:
        return None
    losses = mesh.losses
    coefficient: Callable[[Floats], Floats | float] = lambda _: mesh.friction or 0.0  # noqa: E731
    if isinstance(losses, RubbedTransmission):
        coefficient = losses.by

    def table(way: int) -> TabledFunction:
        def term(S: Floats) -> Floats:
            return _friction_term(transmission.speed(S), transmission.rubbing(S), coefficient, way, mesh.label)

        if not transmission.slow:
            return tabled_function(term, transmission)
        # functions that are slow to evaluate are interpolated between few nodes
        nodes, _ = transmission.graded_nodes(transmission.speed)
        S, more = np.mod(nodes, transmission.period), term(nodes)
        return tabled_function(lambda at: np.interp(at, S, more, period=transmission.period), transmission, _ROUGH)

    return table(1), table(-1)


def _friction_term(
    tau: Floats, rubbing: ContactRubbing, coefficient: Callable[[Floats], Floats | float], way: int, label: str
) -> Floats:
    """Return the friction term tau (1/eta - 1) of the driver's lever arm at each driver angle, where tau is the speed
    ratio and eta the efficiency of the teeth; 0 where no teeth touch. `way` is -1 for the opposite sense of sliding.
    Raise `GearTrainError` if friction locks the teeth.
    """
    sliding, into, out = rubbing
    # NaN marks tooth pairs that do not touch at this angle
    touching = ~np.isnan(out)
    f = way * np.asarray(coefficient(sliding))
    with np.errstate(invalid="ignore", divide="ignore"):
        passed = np.where(touching, (1 + f * out) / (1 + f * into), 0.0).sum(axis=0) / touching.sum(axis=0)
    if (passed[touching.any(axis=0)] <= 0).any():
        why = "friction locks its teeth at some angle: no torque of the driver moves the driven wheel"
        raise GearTrainError(Problem(f"{label} cannot be simulated in time", why, "declare a smaller `friction`"))
    return np.where(touching.any(axis=0), tau * (1 / np.where(passed > 0, passed, 1.0) - 1), 0.0)


def separate_rubbing(
    moving: MotionProblem, declared: Sequence[GearPair | Coupling] = ()
) -> tuple[dict[str, tuple[TabledFunction, TabledFunction]], tuple[str, ...]]:
    """Return the friction terms of the drive flanks keyed by pair, and the names of pairs and pins whose friction is
    neglected.

    Teeth with a variable ratio have friction terms. Friction is neglected for pins, for teeth with a constant ratio,
    for teeth that friction locks at some angle, and for pairs and couplings with a declared efficiency below 1.
    """
    found: dict[str, tuple[TabledFunction, TabledFunction]] = {}
    left = []
    for mesh in moving.teeth:
        arms = None
        if not mesh.rigid:
            with suppress(GearTrainError):
                arms = _flank_arms(mesh, mesh.transmission)
        if arms is not None:
            found[mesh.name] = arms
        elif mesh.has_friction:
            left.append(mesh.name)
    left += [joint.coupling.name for joint in moving.couplings if joint.transmission.friction]
    for pair in declared:
        if pair.name not in found and pair.efficiency is not None and pair.efficiency.forward.base < 1:
            left.append(pair.name)
    return found, tuple(dict.fromkeys(left))


def pin_arms(transmission: PinToSlotTransmission) -> Arms | None:
    """Return the friction terms (r/rho) f |sin d| of a pin that drives a slot, or None if there is no friction.

    The distance of the pin is r from its own axis and rho from the slot's axis; f is the friction coefficient, and d is
    the angle between the pin's arm and the slot. The sign depends on the slot's torque and on the sense of rotation.
    """
    if not transmission.friction:
        return None

    def more(S: Floats) -> Floats:
        arm = transmission.r * transmission.e * np.abs(np.sin(S)) / transmission._reach(S)[1]
        return np.asarray(transmission.friction * arm)

    plus, minus = tabled_function(more, transmission), tabled_function(lambda S: -more(S), transmission)
    return plus, minus, minus, plus


def efficiency_arms(transmission: TransmissionFunction, forward: float, backward: float, label: str) -> Arms | None:
    """Return the friction terms of a pair that has a declared efficiency for each driving direction.

    None means that the pair has no loss. Raises `GearTrainError` if the pair is self-locking forwards.
    """
    if forward == 1 and backward == 1:
        return None
    if forward <= 0:
        why = f"its efficiency is {forward:g} in the direction of the power flow, so it locks"
        raise GearTrainError(Problem(f"{label} cannot be simulated in time", why, "declare an `efficiency` above 0"))
    # backwards the driven wheel drives, so losses reduce its torque on the driver
    more, less = 1 / forward - 1, max(backward, 0.0) - 1
    steady = transmission.speed_range()[0] >= 0

    def table(driving: float, returning: float) -> TabledFunction:
        def term(S: Floats) -> Floats:
            tau = transmission.speed(S)
            # with a negative ratio the driven side moves backwards, and power flows the other way
            return tau * np.where(tau >= 0, driving, returning)

        # a term has a kink where the ratio passes 0
        return tabled_function(term, transmission) if steady else tabled_function(term, transmission, _ROUGH)

    ahead, back = table(more, less), table(less, more)
    return ahead, back, back, ahead
