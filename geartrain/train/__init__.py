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

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.train.declaration import Epoch as Epoch
    from geartrain.train.declaration import FrictionInForce as FrictionInForce
    from geartrain.train.declaration import Train as Train
    from geartrain.train.declaration_style import with_long_forms as with_long_forms
    from geartrain.train.declaration_style import with_short_forms as with_short_forms
    from geartrain.train.manufacturing import ArborSizes as ArborSizes
    from geartrain.train.manufacturing import Material as Material
    from geartrain.train.manufacturing import PairMounting as PairMounting
    from geartrain.train.manufacturing import WheelManufacture as WheelManufacture
    from geartrain.train.manufacturing import material_table as material_table
    from geartrain.train.mechanism import Axis as Axis
    from geartrain.train.mechanism import BearingFriction as BearingFriction
    from geartrain.train.mechanism import GearPair as GearPair
    from geartrain.train.mechanism import Link as Link
    from geartrain.train.mechanism import Revolute as Revolute
    from geartrain.train.mechanism import Slide as Slide
    from geartrain.train.mechanism import Source as Source
    from geartrain.train.mechanism import Teeth as Teeth
    from geartrain.train.mechanism import Wheel as Wheel
    from geartrain.train.outputs import Dial as Dial
    from geartrain.train.outputs import DialName as DialName
    from geartrain.train.outputs import DialNumerals as DialNumerals
    from geartrain.train.outputs import DialRing as DialRing
    from geartrain.train.outputs import Expect as Expect
    from geartrain.train.outputs import Output as Output
    from geartrain.train.outputs import Published as Published
    from geartrain.train.outputs import SpeedUnit as SpeedUnit
    from geartrain.train.outputs import Target as Target
    from geartrain.train.outputs import TourStep as TourStep
    from geartrain.train.outputs import View as View
    from geartrain.train.periods import CalendarDate as CalendarDate
    from geartrain.train.periods import Period as Period
    from geartrain.train.periods import date_of as date_of
    from geartrain.train.periods import julian_day as julian_day
    from geartrain.train.periods import period_table as period_table
    from geartrain.train.periods import read_date as read_date
    from geartrain.train.states import Clutch as Clutch
    from geartrain.train.states import Drive as Drive
    from geartrain.train.states import Escapement as Escapement
    from geartrain.train.states import HandDrive as HandDrive
    from geartrain.train.states import SpringDrive as SpringDrive
    from geartrain.train.states import State as State
    from geartrain.train.states import StateCase as StateCase
    from geartrain.train.validation import declare as declare

__getattr__, __all__ = public_names(
    __name__,
    {
        "declaration": "Epoch FrictionInForce Train",
        "declaration_style": "with_long_forms with_short_forms",
        "manufacturing": "ArborSizes Material PairMounting WheelManufacture material_table",
        "mechanism": "Axis BearingFriction GearPair Link Revolute Slide Source Teeth Wheel",
        "outputs": "Dial DialName DialNumerals DialRing Expect Output Published SpeedUnit Target TourStep View",
        "periods": "CalendarDate Period date_of julian_day period_table read_date",
        "states": "Clutch Drive Escapement HandDrive SpringDrive State StateCase",
        "validation": "declare",
    },
)
