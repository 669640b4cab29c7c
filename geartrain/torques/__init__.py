"""Torques, power and losses: balances of links, directions of power, verdicts on self-locking."""

from geartrain.torques.amounts import in_newton_metres, in_watts, share, share_of, watts_per_unit
from geartrain.torques.asking import drive, find_torques
from geartrain.torques.balance import Balance, Mesh, Solved
from geartrain.torques.directions import Flow, find_flows
from geartrain.torques.driving import find_drivers, unknown_drivers
from geartrain.torques.flowing import Circulation, Node, PowerFlow, Stream, trace_power
from geartrain.torques.result import Held, LeftOut, PairTorque, Torques, TorqueVerdict
from geartrain.torques.setting import Setting, declared_loads
from geartrain.torques.statics import speed_forms

__all__ = [
    "Balance",
    "Circulation",
    "Flow",
    "Held",
    "LeftOut",
    "Mesh",
    "Node",
    "PairTorque",
    "PowerFlow",
    "Setting",
    "Solved",
    "Stream",
    "TorqueVerdict",
    "Torques",
    "declared_loads",
    "drive",
    "find_drivers",
    "find_flows",
    "find_torques",
    "in_newton_metres",
    "in_watts",
    "share",
    "share_of",
    "speed_forms",
    "trace_power",
    "unknown_drivers",
    "watts_per_unit",
]
