"""Motion in time, strength and wear of gear trains, and their export as co-simulation units.

Inputs are a train with moments of inertia, loads, an input speed and materials. Results are the input speed at which
tooth contact is first lost, motion in time with impacts and an energy balance, vibration modes, contact pressure, root
stress and wear, and a co-simulation unit.

contacts   moments of inertia, input speeds at which teeth separate, and the contact model for time integration
steps      equations of one time step, the search for closed contacts, the energy balance
time       runs and their results, spectra, modes, step-by-step simulation
strength   pressures, stresses and wear of a loaded train: ISO 6336, Hertz, Lewis and Archard
fmu        co-simulation units (FMI)
answers    the results that commands print as JSON
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.simulation.contacts.link_inertia import find_link_inertias as find_link_inertias
    from geartrain.simulation.contacts.separation_rate import SeparationRates as SeparationRates
    from geartrain.simulation.contacts.separation_rate import find_separation as find_separation
    from geartrain.simulation.fmu.co_simulation import CoSimulationCase as CoSimulationCase
    from geartrain.simulation.fmu.co_simulation import fmu_file as fmu_file
    from geartrain.simulation.strength.strength_results import PairStrength as PairStrength
    from geartrain.simulation.strength.strength_results import TrainStrength as TrainStrength
    from geartrain.simulation.time.stepwise_simulation import Simulation as Simulation
    from geartrain.simulation.time.time_run import TimeRun as TimeRun
    from geartrain.simulation.time.train_in_time import find_vibration_modes as find_vibration_modes

__getattr__, __all__ = public_names(
    __name__,
    {
        "contacts.link_inertia": "find_link_inertias",
        "contacts.separation_rate": "SeparationRates find_separation",
        "fmu.co_simulation": "CoSimulationCase fmu_file",
        "strength.strength_results": "PairStrength TrainStrength",
        "time.stepwise_simulation": "Simulation",
        "time.time_run": "TimeRun",
        "time.train_in_time": "find_vibration_modes",
    },
)
