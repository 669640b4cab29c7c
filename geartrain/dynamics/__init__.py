"""Torques and transmission error: what loads, losses and real teeth do to a train of known speeds.

In: circuits, exact speeds and loads of a state, and what is known of each gear pair. Out: torques, powers, efficiencies
and who drives whom; every link's angle at every position, with the error of its teeth. A user asks `GearTrain` for both
(`torques`, `driven`, `power_flow`, `motion`, `impacts`) and gets the results that stand here.

Torques balance by the transpose of the Willis system, A^T x + T = 0 (docs/torques.md, equation 3), and each pair loses
by the direction of power in its carrier's frame (5). Errors of pairs spread by the same rows,
a (e_i - e_k) + b (e_j - e_k) = c delta (docs/motion.md, equation 2), each error taken at the angle to which the others
have moved its driver (3).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.error_curve import TransmissionErrorCurve
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.dynamics.motion.motion_run import MotionRun
    from geartrain.dynamics.motion.order_spectrum import SpectrumLine
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.dynamics.motion.superposition import ErrorEstimates
    from geartrain.dynamics.motion.tooth_impacts import ToothImpact
    from geartrain.dynamics.torques.power_flow import (
        PowerFlow,
        PowerLoss,
        PowerNode,
        PowerStream,
        RecirculatingPower,
    )
    from geartrain.dynamics.torques.torque_results import (
        BearingTorque,
        DrivenWay,
        HoldingTorque,
        NeglectedEffect,
        PairTorque,
        Torques,
        TorqueVerdict,
    )

__all__ = [
    "BearingTorque",
    "DrivenWay",
    "ErrorEstimates",
    "ErrorSamples",
    "HoldingTorque",
    "Motion",
    "MotionRun",
    "NeglectedEffect",
    "PairTorque",
    "PowerFlow",
    "PowerLoss",
    "PowerNode",
    "PowerStream",
    "RecirculatingPower",
    "RunningStatistics",
    "SpectrumLine",
    "ToothImpact",
    "TorqueVerdict",
    "Torques",
    "TransmissionErrorCurve",
]

_FLOW, _RESULTS = "torques.power_flow", "torques.torque_results"
_PLACES = {
    "BearingTorque": _RESULTS,
    "DrivenWay": _RESULTS,
    "ErrorEstimates": "motion.superposition",
    "ErrorSamples": "motion.error_composition",
    "HoldingTorque": _RESULTS,
    "Motion": "motion.motion_model",
    "MotionRun": "motion.motion_run",
    "NeglectedEffect": _RESULTS,
    "PairTorque": _RESULTS,
    "PowerFlow": _FLOW,
    "PowerLoss": _FLOW,
    "PowerNode": _FLOW,
    "PowerStream": _FLOW,
    "RecirculatingPower": _FLOW,
    "RunningStatistics": "motion.run_statistics",
    "SpectrumLine": "motion.order_spectrum",
    "ToothImpact": "motion.tooth_impacts",
    "TorqueVerdict": _RESULTS,
    "Torques": _RESULTS,
    "TransmissionErrorCurve": "motion.error_curve",
}

__getattr__ = lazy_names(__name__, _PLACES)
