"""Declaration of a train: immutable models, and the checks that need only the declaration itself.

Input is plain data with the keys of the YAML format (docs/reference.md), or a file. The result is a `Train`, whose
parts keep their line numbers, or a `DeclarationError` with every problem that could be collected. Nothing is calculated
here; `geartrain.GearTrain` does that.

declaration                      complete model, friction in force, epoch
mechanism                        links, wheels, axes, pairs; uncertain and owned tooth counts, bearing friction
outputs, states                  outputs, printed periods, dials, targets; clutches, cases, and drives in time
manufacturing, wheel_stock, reconstruction   materials and cutting errors; blanks; constraints of a reconstruction
fields, validation, references   strict fields; short forms and problems; conflicting names and units
yaml_nodes, declaration_style    YAML with line numbers; rewriting in short or long forms
declaration_files, inheritance   files, JSON and shipped trains; `extends`, and changed copies of a declaration
periods                          table of astronomical periods
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names
from geartrain.train.declaration import Epoch, FrictionInForce, Train
from geartrain.train.manufacturing import ArborSizes, Material, PairMounting, WheelManufacture, material_table
from geartrain.train.mechanism import Axis, BearingFriction, GearPair, Link, Revolute, Slide, Source, Teeth, Wheel
from geartrain.train.outputs import (
    Dial,
    DialName,
    DialNumerals,
    DialRing,
    Expect,
    Output,
    Published,
    SpeedUnit,
    Target,
    TourStep,
    View,
)
from geartrain.train.periods import CalendarDate, Period, date_of, julian_day, period_table, read_date
from geartrain.train.states import Clutch, Drive, Escapement, HandDrive, SpringDrive, State, StateCase
from geartrain.train.validation import declare

if TYPE_CHECKING:
    from geartrain.train.declaration_style import with_long_forms as with_long_forms
    from geartrain.train.declaration_style import with_short_forms as with_short_forms

__all__ = [
    "ArborSizes",
    "Axis",
    "BearingFriction",
    "CalendarDate",
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
    "Period",
    "Published",
    "Revolute",
    "Slide",
    "Source",
    "SpeedUnit",
    "SpringDrive",
    "State",
    "StateCase",
    "Target",
    "Teeth",
    "TourStep",
    "Train",
    "View",
    "Wheel",
    "WheelManufacture",
    "date_of",
    "declare",
    "julian_day",
    "material_table",
    "period_table",
    "read_date",
    "with_long_forms",
    "with_short_forms",
]

__getattr__ = lazy_names(__name__, dict.fromkeys(("with_long_forms", "with_short_forms"), "declaration_style"))
