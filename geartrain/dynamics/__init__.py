"""Torques, losses and transmission errors of a train, from its loads, friction and tooth forms.

The input consists of the circuits, exact speeds and loads of a state, and the known data of each gear pair. The results
are torques, powers, efficiencies, the driving wheel of each pair, and the angle of every link, including transmission
errors, at every position of the input. Call the methods of `GearTrain` (`torques`, `driven`, `motion`, `strength`,
`dynamics`), or one of the functions here with `GearTrain.mechanics`. Both return results of the classes in this
package.

Torques are balanced with the transpose of the Willis system, A^T x + T = 0 (docs/torques.md, equation 3). The loss of
each pair follows from the direction of power flow relative to its carrier (5). Transmission errors propagate according
to the same rows, a (e_i - e_k) + b (e_j - e_k) = c delta (docs/motion.md, equation 2). Each error is evaluated at its
driver's angle, which includes the errors of other pairs (3).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorSamples as ErrorSamples
    from geartrain.dynamics.motion.kink_positions import KinkPositions as KinkPositions
    from geartrain.dynamics.motion.motion_model import Motion as Motion
    from geartrain.dynamics.motion.motion_model import TransmissionErrorCurve as TransmissionErrorCurve
    from geartrain.dynamics.motion.motion_run import MotionRun as MotionRun
    from geartrain.dynamics.motion.run_statistics import RunningStatistics as RunningStatistics
    from geartrain.dynamics.torques.power_flow import PowerFlow as PowerFlow
    from geartrain.dynamics.torques.power_flow import PowerNode as PowerNode
    from geartrain.dynamics.torques.power_flow import find_power_flow as find_power_flow
    from geartrain.dynamics.torques.torque_results import Torques as Torques
    from geartrain.dynamics.torques.torque_results import TorqueVerdict as TorqueVerdict
    from geartrain.dynamics.turn.torque_cycle import TorqueCycle as TorqueCycle

__getattr__, __all__ = public_names(
    __name__,
    {
        "motion.error_composition": "ErrorSamples",
        "motion.kink_positions": "KinkPositions",
        "motion.motion_model": "Motion TransmissionErrorCurve",
        "motion.motion_run": "MotionRun",
        "motion.run_statistics": "RunningStatistics",
        "torques.power_flow": "PowerFlow PowerNode find_power_flow",
        "torques.torque_results": "TorqueVerdict Torques",
        "turn.torque_cycle": "TorqueCycle",
    },
)
