"""The declaration of a train: frozen models, and the checks that need nothing but the declaration itself.

In: plain data with the keys of the YAML format (docs/reference.md), or a file. Out: a `Train`, whose parts remember the
lines on which they were written, or `DeclarationError` with every problem that could be collected. Nothing is worked
out here; `geartrain.GearTrain` does that.

declaration, mechanism, outputs, dials, states, manufacturing   the models; state_case: what is prescribed in one state
efficiencies, bearing_friction, friction_in_force        what is lost; drives: what drives a train in time
fields, validation, references, unit_consistency         strictness, problems in words, names, units
yaml_nodes, json_text                                    YAML with line numbers; JSON, whose lines are found when read
declaration_files, inheritance                           shipped trains, `extends`
periods, materials                                       the tables of periods of the sky, and of materials
"""

from __future__ import annotations

from geartrain.train.declaration import Epoch, FrictionInForce, Train
from geartrain.train.dials import Dial, DialName, DialNumerals, DialRing
from geartrain.train.drives import Drive, Escapement, HandDrive, SpringDrive
from geartrain.train.manufacturing import PairMounting, WheelManufacture
from geartrain.train.materials import ArborSizes, Material, material_table
from geartrain.train.mechanism import Axis, BearingFriction, GearPair, Link, Revolute, Source, Teeth, Wheel
from geartrain.train.outputs import Expect, Output, Published, SpeedUnit, Target, View
from geartrain.train.states import Clutch, State, StateCase
from geartrain.train.validation import declare

__all__ = [
    "ArborSizes",
    "Axis",
    "BearingFriction",
    "Clutch",
    "Dial",
    "DialName",
    "DialNumerals",
    "DialRing",
    "Drive",
    "Epoch",
    "Escapement",
    "Expect",
    "FrictionInForce",
    "GearPair",
    "HandDrive",
    "Link",
    "Material",
    "Output",
    "PairMounting",
    "Published",
    "Revolute",
    "Source",
    "SpeedUnit",
    "SpringDrive",
    "State",
    "StateCase",
    "Target",
    "Teeth",
    "Train",
    "View",
    "Wheel",
    "WheelManufacture",
    "declare",
    "material_table",
]
