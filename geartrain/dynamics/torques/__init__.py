"""Torques, power and losses: balances of links, directions of power, verdicts on self-locking."""

from geartrain.dynamics.torques.drivers import find_drivers
from geartrain.dynamics.torques.flow_patterns import FlowPattern, find_flow_patterns
from geartrain.dynamics.torques.load_case import LoadCase, input_and_output
from geartrain.dynamics.torques.power_flow import (
    PowerFlow,
    PowerNode,
    PowerStream,
    RecirculatingPower,
    find_power_flow,
    has_torque_units,
    percent_of_text,
    percent_text,
    watts_per_unit,
    watts_text,
)
from geartrain.dynamics.torques.torque_analysis import drive, find_torques, torques_unknown
from geartrain.dynamics.torques.torque_balance import LoadedPair, SolvedTorques, TorqueBalance
from geartrain.dynamics.torques.torque_results import (
    DrivenWay,
    HoldingTorque,
    NeglectedEffect,
    PairTorque,
    Torques,
    TorqueVerdict,
)
from geartrain.dynamics.torques.virtual_work import speed_forms

__all__ = [
    "DrivenWay",
    "FlowPattern",
    "HoldingTorque",
    "LoadCase",
    "LoadedPair",
    "NeglectedEffect",
    "PairTorque",
    "PowerFlow",
    "PowerNode",
    "PowerStream",
    "RecirculatingPower",
    "SolvedTorques",
    "TorqueBalance",
    "TorqueVerdict",
    "Torques",
    "drive",
    "find_drivers",
    "find_flow_patterns",
    "find_power_flow",
    "find_torques",
    "has_torque_units",
    "input_and_output",
    "percent_of_text",
    "percent_text",
    "speed_forms",
    "torques_unknown",
    "watts_per_unit",
    "watts_text",
]
