"""Phase closure: whether the teeth of the last mesh of every loop meet, so that a train can be put together."""

from __future__ import annotations

from geartrain.closure.accuracy import Measured, first_failure, measure
from geartrain.closure.contacts import LeftOut
from geartrain.closure.finding import OnSphere, closure_on_sphere, find_closure, rule_on_sphere
from geartrain.closure.loop import LoopPhase
from geartrain.closure.result import Closure
from geartrain.closure.rules import Rule, find_rule

__all__ = [
    "Closure",
    "LeftOut",
    "LoopPhase",
    "Measured",
    "OnSphere",
    "Rule",
    "closure_on_sphere",
    "find_closure",
    "find_rule",
    "first_failure",
    "measure",
    "rule_on_sphere",
]
