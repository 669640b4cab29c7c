"""Torques, power and losses: balances of links, directions of power, verdicts on self-locking."""

from geartrain.torques.asking import Setting, declared_loads, drive, find_torques
from geartrain.torques.balance import Balance, Mesh, Solved, solve_balance
from geartrain.torques.directions import Flow, find_flows
from geartrain.torques.result import PairTorque, Torques, TorqueVerdict

__all__ = [
    "Balance",
    "Flow",
    "Mesh",
    "PairTorque",
    "Setting",
    "Solved",
    "TorqueVerdict",
    "Torques",
    "declared_loads",
    "drive",
    "find_flows",
    "find_torques",
    "solve_balance",
]
