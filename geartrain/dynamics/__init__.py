"""Torques, transmission error, motion in time: what loads, losses, real teeth and inertia do to a train.

In: circuits, exact speeds and loads of a state, and what is known of each gear pair. Out: torques, powers, efficiencies
and who drives whom; every link's angle at every position, with the error of its teeth; its motion in time. A user calls
`GearTrain` (`torques`, `driven`, `motion`, `strength`, `dynamics`), or one of the functions here with
`GearTrain.mechanics`, and gets the results that are here.

Torques balance by the transpose of the Willis system, A^T x + T = 0 (docs/torques.md, equation 3), and each pair loses
by the direction of power in its carrier's frame (5). Errors of pairs spread by the same rows,
a (e_i - e_k) + b (e_j - e_k) = c delta (docs/motion.md, equation 2), each error taken at the angle to which the others
have moved its driver (3).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.dynamics.contacts.train_separation import find_separation, find_tooth_impacts
    from geartrain.dynamics.inertia.link_inertia import LinkInertia, find_link_inertias
    from geartrain.dynamics.inertia.separation_rate import PairSeparation, SeparationRates
    from geartrain.dynamics.motion.corner_positions import CornerPositions
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.motion_model import Motion, TransmissionErrorCurve
    from geartrain.dynamics.motion.motion_run import MotionRun
    from geartrain.dynamics.motion.order_spectrum import SpectrumLine
    from geartrain.dynamics.motion.pair_impacts import ToothImpact
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.dynamics.motion.superposition import ErrorEstimates
    from geartrain.dynamics.strength.contact_results import FlankStrength, PinContact, PointContact
    from geartrain.dynamics.strength.strength_results import (
        ArborStrength,
        FlankWear,
        PairStrength,
        TrainStrength,
        WheelStrength,
    )
    from geartrain.dynamics.time.run_parts import (
        ContactInTime,
        EnergyAccount,
        ImpactList,
        OutputLead,
        SettledFigure,
        SpectrumPeak,
    )
    from geartrain.dynamics.time.stepped_separation import SteppedSeparation
    from geartrain.dynamics.time.stepwise_simulation import Simulation
    from geartrain.dynamics.time.time_run import TimeRun
    from geartrain.dynamics.time.train_in_time import find_vibration_modes, step_to_separation
    from geartrain.dynamics.time.vibration_modes import VibrationModes
    from geartrain.dynamics.torques.member_torques import BearingTorque, HoldingTorque, PairTorque
    from geartrain.dynamics.torques.power_circulation import PowerNode, PowerStream, RecirculatingPower
    from geartrain.dynamics.torques.power_flow import PowerFlow, PowerLoss, find_power_flow
    from geartrain.dynamics.torques.torque_results import DrivenWay, NeglectedEffect, Torques, TorqueVerdict
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.turn.cycle_parts import CycleEnergy, PairCycle, PlaceInRun, TorqueExtreme
    from geartrain.dynamics.turn.torque_cycle import TorqueCycle
    from geartrain.dynamics.turn.train_turn import find_torque_period

__all__ = [
    "ArborStrength",
    "BearingTorque",
    "ContactInTime",
    "CornerPositions",
    "CycleEnergy",
    "DrivenWay",
    "EnergyAccount",
    "ErrorEstimates",
    "ErrorSamples",
    "FlankStrength",
    "FlankWear",
    "HoldingTorque",
    "ImpactList",
    "LinkInertia",
    "Motion",
    "MotionRun",
    "NeglectedEffect",
    "OutputLead",
    "PairCycle",
    "PairSeparation",
    "PairStrength",
    "PairTorque",
    "PinContact",
    "PlaceInRun",
    "PointContact",
    "PowerFlow",
    "PowerLoss",
    "PowerNode",
    "PowerStream",
    "RecirculatingPower",
    "RunningStatistics",
    "SeparationRates",
    "SettledFigure",
    "Simulation",
    "SpectrumLine",
    "SpectrumPeak",
    "SteppedSeparation",
    "TimeRun",
    "ToothImpact",
    "TorqueCycle",
    "TorqueExtreme",
    "TorqueVerdict",
    "Torques",
    "TrainMechanics",
    "TrainStrength",
    "TransmissionErrorCurve",
    "VibrationModes",
    "WheelStrength",
    "find_link_inertias",
    "find_power_flow",
    "find_separation",
    "find_tooth_impacts",
    "find_torque_period",
    "find_vibration_modes",
    "step_to_separation",
]

_PLACES = {
    "ArborStrength": "strength.strength_results",
    "BearingTorque": "torques.member_torques",
    "ContactInTime": "time.run_parts",
    "CornerPositions": "motion.corner_positions",
    "CycleEnergy": "turn.cycle_parts",
    "DrivenWay": "torques.torque_results",
    "EnergyAccount": "time.run_parts",
    "ErrorEstimates": "motion.superposition",
    "ErrorSamples": "motion.error_composition",
    "FlankStrength": "strength.contact_results",
    "FlankWear": "strength.strength_results",
    "HoldingTorque": "torques.member_torques",
    "ImpactList": "time.run_parts",
    "LinkInertia": "inertia.link_inertia",
    "Motion": "motion.motion_model",
    "MotionRun": "motion.motion_run",
    "NeglectedEffect": "torques.torque_results",
    "OutputLead": "time.run_parts",
    "PairCycle": "turn.cycle_parts",
    "PairSeparation": "inertia.separation_rate",
    "PairStrength": "strength.strength_results",
    "PairTorque": "torques.member_torques",
    "PinContact": "strength.contact_results",
    "PlaceInRun": "turn.cycle_parts",
    "PointContact": "strength.contact_results",
    "PowerFlow": "torques.power_flow",
    "PowerLoss": "torques.power_flow",
    "PowerNode": "torques.power_circulation",
    "PowerStream": "torques.power_circulation",
    "RecirculatingPower": "torques.power_circulation",
    "RunningStatistics": "motion.run_statistics",
    "SeparationRates": "inertia.separation_rate",
    "SettledFigure": "time.run_parts",
    "Simulation": "time.stepwise_simulation",
    "SpectrumLine": "motion.order_spectrum",
    "SpectrumPeak": "time.run_parts",
    "SteppedSeparation": "time.stepped_separation",
    "TimeRun": "time.time_run",
    "ToothImpact": "motion.pair_impacts",
    "TorqueCycle": "turn.torque_cycle",
    "TorqueExtreme": "turn.cycle_parts",
    "TorqueVerdict": "torques.torque_results",
    "Torques": "torques.torque_results",
    "TrainMechanics": "train_mechanics",
    "TrainStrength": "strength.strength_results",
    "TransmissionErrorCurve": "motion.motion_model",
    "VibrationModes": "time.vibration_modes",
    "WheelStrength": "strength.strength_results",
    "find_link_inertias": "inertia.link_inertia",
    "find_power_flow": "torques.power_flow",
    "find_separation": "contacts.train_separation",
    "find_tooth_impacts": "contacts.train_separation",
    "find_torque_period": "turn.train_turn",
    "find_vibration_modes": "time.train_in_time",
    "step_to_separation": "time.train_in_time",
}

__getattr__ = lazy_names(__name__, _PLACES)
