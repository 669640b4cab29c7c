"""Mean torques: balance of every link, power flow, and verdicts.

load_case                            train in one state with its loads; check of equilibrium by virtual work
torque_balance, flow_patterns        balance of every link; patterns of power flow consistent with the losses
mean_efficiencies                    mean efficiency of each pair, for a constant torque of the driver or of the driven
link
bearing_loads                        forces of pairs on the axes of their wheels; friction of loaded bearings
torque_analysis                      torques of a declared train and their verdict
torque_results                       results: torques on single links and pairs
power_flow                           power flow of a result, and recirculating power
drivers                              driving side of each pair
neglected_effects                    effects that a balance of mean torques neglects
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.dynamics.torques.flow_patterns import find_flow_patterns as find_flow_patterns
    from geartrain.dynamics.torques.torque_balance import LoadedPair as LoadedPair
    from geartrain.dynamics.torques.torque_balance import TorqueBalance as TorqueBalance

__getattr__, __all__ = public_names(
    __name__,
    {
        "flow_patterns": "find_flow_patterns",
        "torque_balance": "LoadedPair TorqueBalance",
    },
)
