"""Small trains that several tests modify: a pair of wheels and a planetary set, as templates."""

from __future__ import annotations

from typing import Any

import pytest

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics import Torques
from geartrain.report import to_markdown
from geartrain.report.torque_report import collect_torque_report, describe_torques

PAIR = """
links:
  frame: {{}}
  a: {{wheels: {{p: 20}}}}
  b: {{wheels: {{w: 60}}}}
revolutes:
  - {{pair: [frame, a], axis: A}}
  - {{pair: [frame, b], axis: B}}
gears: [{{pair: [p, w]}}]
{rest}
"""

PLANETARY = """
links:
  frame: {{wheels: {{ring: {{teeth: 60, internal: true}}}}}}
  sun: {{wheels: {{s: 24}}}}
  planet: {{wheels: {{p: 18}}}}
  carrier: {{}}
revolutes:
  - {{pair: [frame, sun], axis: main}}
  - {{pair: [frame, carrier], axis: main}}
  - {{pair: [carrier, planet], axis: planet}}
gears: [{{pair: [s, p]}}, {{pair: [p, ring]}}]
{rest}
"""


def pair(rest: str = "inputs: {a: 1}") -> GearTrain:
    return load(PAIR.format(rest=rest))


def planetary(rest: str = "inputs: {sun: 1}") -> GearTrain:
    return load(PLANETARY.format(rest=rest))


def transmission_of(text: str) -> Any:
    """Return the transmission function of the only pair or coupling of a train."""
    (found,) = (law for *_, law in load(text).graph.edges(data="transmission") if law is not None)
    return found


def refusal(text: str) -> str:
    with pytest.raises(GearTrainError) as caught:
        load(text)
    return str(caught.value)


def torque_figures(train: GearTrain, state: str | None = None) -> Any:
    """Return the torques of one state with powers in watts, losses, power flow and efficiencies both ways."""
    (found,) = collect_torque_report(train, [train.torques(state)]).states
    return found


def torque_page(train: GearTrain, *found: Torques) -> str:
    """Return the section on torques of a report."""
    return to_markdown([describe_torques(collect_torque_report(train, found))])
