"""Torques, power and losses: balances of links, directions of power, verdicts on self-locking."""

from geartrain.torques.balance import Balance, Mesh, Solved, solve_balance
from geartrain.torques.directions import Flow, find_flows

__all__ = ["Balance", "Flow", "Mesh", "Solved", "find_flows", "solve_balance"]
