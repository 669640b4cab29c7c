"""Layouts, scenes and solids: the geometry of a train in space and time.

The input is a train, a state, a layout and manufacturing sizes. The output is the positions of axes and wheels, all
data of an animated picture, and solids to export. Lengths are in mm and angles in rad; ratios are exact.

lay_out      `Layout`: axes and wheels in space, as declared or placed so that pitch circles touch
build_scene  `Scene` with plates, pillars, arbors and dials in manufacturing sizes
make_scene   `Scene`: the train in one state, with angles from exact speeds and, for pairs with a tooth form, from
             equations (1) to (4) of docs/motion.md
SolidModel   wheels, arbors and plates as closed surfaces, in the sizes of `ManufacturingSizes`

context         a train, its answer in one state and its layout, from which all parts of a scene are derived
construction    construction of the scene of a train; phases of wheels; exact speeds as functions of tooth counts
train_scene     the scene as plain data; its records are in `elements`
bodies          links and wheels with their teeth; flexible wheels of strain waves
joints          gear pairs, and pins in slots
movement        exact speeds and transmission errors, as tables and steps; evaluated by `pose`
scene_run       a simulated motion as it is replayed on a page
displays        figures, road wheels and the kind of drive
dial_scale      scales of dials and their engraving; dials, pointers, dates and mean motions are in `dial_pointers`
stroke_letters  letters as strokes, outlines of hands
palette         colours of the themes
layout          positions of axes and wheels (beam search, local search)
solids          closed surfaces of wheels, plates and pins
parts           parts of the frame: plates, pillars, arbors, pipes

Each wheel is placed so that its pitch surface touches the pitch surfaces of its mates at the pitch point: equations
(2), (3), (8) of docs/theory.md for parallel axes, cones and worms.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.scene.construction import make_scene as make_scene
    from geartrain.scene.dial_scale import engrave as engrave
    from geartrain.scene.layout.train_layout import AxisPlace as AxisPlace
    from geartrain.scene.layout.train_layout import Layout as Layout
    from geartrain.scene.layout.train_layout import WheelPlace as WheelPlace
    from geartrain.scene.layout.train_layout import lay_out as lay_out
    from geartrain.scene.palette import THEMES as THEMES
    from geartrain.scene.palette import series_colour as series_colour
    from geartrain.scene.palette import series_dash as series_dash
    from geartrain.scene.pose import scene_pose as scene_pose
    from geartrain.scene.solids.built_scene import build_scene as build_scene
    from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes as ManufacturingSizes
    from geartrain.scene.solids.solid_assembly import SolidModel as SolidModel
    from geartrain.scene.solids.solid_part import SolidPart as SolidPart
    from geartrain.scene.train_scene import Scene as Scene

__getattr__, __all__ = public_names(
    __name__,
    {
        "construction": "make_scene",
        "dial_scale": "engrave",
        "layout.train_layout": "AxisPlace Layout WheelPlace lay_out",
        "palette": "THEMES series_colour series_dash",
        "pose": "scene_pose",
        "solids.built_scene": "build_scene",
        "solids.manufacturing_sizes": "ManufacturingSizes",
        "solids.solid_assembly": "SolidModel",
        "solids.solid_part": "SolidPart",
        "train_scene": "Scene",
    },
)
