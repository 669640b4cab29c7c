"""Motion in time, strength and wear, co-simulation units.

In: a train with inertia, loads, a rate and materials. Out: the rate at which teeth first part, motion in time with
impacts and energy, vibration modes, contact pressure, root stress and wear, a co-simulation unit.

inertia    moments of inertia of links, loads due to inertia, separation rates
contacts   the model that is stepped: coordinates and contacts, of rigid or compliant teeth
steps      the equations of one step, the search for contacts, the energy account
time       runs and their figures, spectra, modes, step-by-step simulation
strength   pressures, stresses and wear of a loaded train; `formulas` of ISO 6336, Hertz, Lewis and Archard
fmu        co-simulation units (FMI)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.simulation.contacts.train_separation import find_separation as find_separation
    from geartrain.simulation.contacts.train_separation import find_tooth_impacts as find_tooth_impacts
    from geartrain.simulation.fmu.co_simulation import CoSimulationCase as CoSimulationCase
    from geartrain.simulation.fmu.co_simulation import fmu_file as fmu_file
    from geartrain.simulation.inertia.link_inertia import LinkInertia as LinkInertia
    from geartrain.simulation.inertia.link_inertia import find_link_inertias as find_link_inertias
    from geartrain.simulation.inertia.separation_rate import PairSeparation as PairSeparation
    from geartrain.simulation.inertia.separation_rate import SeparationRates as SeparationRates
    from geartrain.simulation.strength.contact_results import FlankStrength as FlankStrength
    from geartrain.simulation.strength.contact_results import PinContact as PinContact
    from geartrain.simulation.strength.contact_results import PointContact as PointContact
    from geartrain.simulation.strength.strength_report import StrengthReport as StrengthReport
    from geartrain.simulation.strength.strength_report import collect_strength_report as collect_strength_report
    from geartrain.simulation.strength.strength_report import describe_strength as describe_strength
    from geartrain.simulation.strength.strength_results import ArborStrength as ArborStrength
    from geartrain.simulation.strength.strength_results import FlankWear as FlankWear
    from geartrain.simulation.strength.strength_results import PairStrength as PairStrength
    from geartrain.simulation.strength.strength_results import TrainStrength as TrainStrength
    from geartrain.simulation.strength.strength_results import WheelStrength as WheelStrength
    from geartrain.simulation.time.run_parts import ContactInTime as ContactInTime
    from geartrain.simulation.time.run_parts import EnergyAccount as EnergyAccount
    from geartrain.simulation.time.run_parts import ImpactList as ImpactList
    from geartrain.simulation.time.run_parts import OutputLead as OutputLead
    from geartrain.simulation.time.run_parts import SettledFigure as SettledFigure
    from geartrain.simulation.time.run_parts import SpectrumPeak as SpectrumPeak
    from geartrain.simulation.time.stepped_separation import SteppedSeparation as SteppedSeparation
    from geartrain.simulation.time.stepwise_simulation import Simulation as Simulation
    from geartrain.simulation.time.time_report import TimeReport as TimeReport
    from geartrain.simulation.time.time_report import collect_time_report as collect_time_report
    from geartrain.simulation.time.time_report import describe_time_run as describe_time_run
    from geartrain.simulation.time.time_run import TimeRun as TimeRun
    from geartrain.simulation.time.time_run_plot import time_run_figure as time_run_figure
    from geartrain.simulation.time.train_in_time import find_vibration_modes as find_vibration_modes
    from geartrain.simulation.time.train_in_time import step_to_separation as step_to_separation
    from geartrain.simulation.time.vibration_modes import VibrationModes as VibrationModes

__all__ = [
    "ArborStrength",
    "CoSimulationCase",
    "ContactInTime",
    "EnergyAccount",
    "FlankStrength",
    "FlankWear",
    "ImpactList",
    "LinkInertia",
    "OutputLead",
    "PairSeparation",
    "PairStrength",
    "PinContact",
    "PointContact",
    "SeparationRates",
    "SettledFigure",
    "Simulation",
    "SpectrumPeak",
    "SteppedSeparation",
    "StrengthReport",
    "TimeReport",
    "TimeRun",
    "TrainStrength",
    "VibrationModes",
    "WheelStrength",
    "collect_strength_report",
    "collect_time_report",
    "describe_strength",
    "describe_time_run",
    "find_link_inertias",
    "find_separation",
    "find_tooth_impacts",
    "find_vibration_modes",
    "fmu_file",
    "step_to_separation",
    "time_run_figure",
]

_PLACES = {
    **dict.fromkeys(("find_separation", "find_tooth_impacts"), "contacts.train_separation"),
    **dict.fromkeys(("CoSimulationCase", "fmu_file"), "fmu.co_simulation"),
    **dict.fromkeys(("LinkInertia", "find_link_inertias"), "inertia.link_inertia"),
    **dict.fromkeys(("PairSeparation", "SeparationRates"), "inertia.separation_rate"),
    **dict.fromkeys(("FlankStrength", "PinContact", "PointContact"), "strength.contact_results"),
    **dict.fromkeys(("StrengthReport", "collect_strength_report", "describe_strength"), "strength.strength_report"),
    **dict.fromkeys(
        ("ArborStrength", "FlankWear", "PairStrength", "TrainStrength", "WheelStrength"), "strength.strength_results"
    ),
    **dict.fromkeys(
        ("ContactInTime", "EnergyAccount", "ImpactList", "OutputLead", "SettledFigure", "SpectrumPeak"),
        "time.run_parts",
    ),
    "SteppedSeparation": "time.stepped_separation",
    "Simulation": "time.stepwise_simulation",
    **dict.fromkeys(("TimeReport", "collect_time_report", "describe_time_run"), "time.time_report"),
    "TimeRun": "time.time_run",
    "time_run_figure": "time.time_run_plot",
    **dict.fromkeys(("find_vibration_modes", "step_to_separation"), "time.train_in_time"),
    "VibrationModes": "time.vibration_modes",
}

__getattr__ = lazy_names(__name__, _PLACES)
