"""Declaration of a train: immutable models, and the checks that need only the declaration itself.

Input is plain data with the keys of the YAML format (docs/reference.md), or a file. The result is a `Train`, whose
parts keep their line numbers, or a `DeclarationError` with every problem that could be collected. Nothing is calculated
here; `geartrain.GearTrain` does that.

declaration                      complete model, effective friction, epoch; blanks of wheels
mechanism                        links, wheels, axes, pairs; uncertain and owned tooth counts, bearing friction
outputs, states                  outputs, printed periods, dials, targets; clutches, cases, and drives in time
manufacturing, reconstruction    materials and cutting errors; constraints of a reconstruction
fields, validation, references   strict fields; short forms and problems; conflicting names and units
yaml_nodes, declaration_style    YAML with line numbers; rewriting in short or long forms
declaration_files, inheritance   files, JSON and shipped trains; `extends`, and changed copies of a declaration
periods                          table of astronomical periods
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.train.declaration import Train as Train
    from geartrain.train.manufacturing import Material as Material
    from geartrain.train.mechanism import GearPair as GearPair
    from geartrain.train.mechanism import Link as Link
    from geartrain.train.mechanism import Source as Source
    from geartrain.train.mechanism import Teeth as Teeth
    from geartrain.train.mechanism import Wheel as Wheel
    from geartrain.train.outputs import Output as Output
    from geartrain.train.outputs import Published as Published
    from geartrain.train.periods import period_table as period_table
    from geartrain.train.states import Drive as Drive
    from geartrain.train.states import State as State
    from geartrain.train.states import StateCase as StateCase
    from geartrain.train.validation import declare as declare

__getattr__, __all__ = public_names(
    __name__,
    {
        "declaration": "Train",
        "manufacturing": "Material",
        "mechanism": "GearPair Link Source Teeth Wheel",
        "outputs": "Output Published",
        "periods": "period_table",
        "states": "Drive State StateCase",
        "validation": "declare",
    },
)
