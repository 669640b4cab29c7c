"""The declaration of a train: frozen models, and the checks that need nothing but the declaration itself.

In: plain data with the keys of the YAML format (docs/reference.md), or a file. Out: a `Train`, whose parts remember the
lines on which they were written, or `DeclarationError` with every problem that could be collected. Nothing is worked
out here; `geartrain.GearTrain` does that.

declaration                      the whole model, and what follows from it alone: friction in force, epoch
mechanism                        links, wheels, axes, pairs; doubtful tooth counts, efficiencies, bearing friction
outputs, dials, states, drives   what is requested and shown; clutches and cases; what drives a train in time
manufacturing, materials, wheel_stock, reconstruction   errors of cutting, materials, blanks; what may be added
fields, validation, references   strictness, problems in words, names and units that do not go together
yaml_nodes, short_forms, declaration_style   YAML with line numbers; pairs in short and in long form
declaration_files, inheritance   files, JSON and shipped trains; `extends`, and other values of a declaration
periods, trade_words             the table of periods of the sky; words of makers and historians
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
