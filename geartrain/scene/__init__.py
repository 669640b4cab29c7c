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
train_scene     the scene as plain data; its records are in `elements`, its formulas in `count_formulas`
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

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.scene.construction import make_scene as make_scene
    from geartrain.scene.count_formulas import CountCondition as CountCondition
    from geartrain.scene.count_formulas import CountFormula as CountFormula
    from geartrain.scene.count_formulas import SceneFormulas as SceneFormulas
    from geartrain.scene.elements import SceneBody as SceneBody
    from geartrain.scene.elements import SceneCoupling as SceneCoupling
    from geartrain.scene.elements import SceneHanger as SceneHanger
    from geartrain.scene.elements import ScenePair as ScenePair
    from geartrain.scene.elements import ScenePart as ScenePart
    from geartrain.scene.elements import SceneWave as SceneWave
    from geartrain.scene.elements import SceneWheel as SceneWheel
    from geartrain.scene.elements import ToothProfile as ToothProfile
    from geartrain.scene.layout.train_layout import AxisPlace as AxisPlace
    from geartrain.scene.layout.train_layout import Layout as Layout
    from geartrain.scene.layout.train_layout import WheelPlace as WheelPlace
    from geartrain.scene.layout.train_layout import lay_out as lay_out
    from geartrain.scene.movement import ErrorSource as ErrorSource
    from geartrain.scene.movement import ErrorStep as ErrorStep
    from geartrain.scene.movement import ErrorTable as ErrorTable
    from geartrain.scene.movement import Movement as Movement
    from geartrain.scene.scene_run import LinkCourse as LinkCourse
    from geartrain.scene.scene_run import SceneContact as SceneContact
    from geartrain.scene.scene_run import SceneRun as SceneRun
    from geartrain.scene.solids.built_scene import build_scene as build_scene
    from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes as ManufacturingSizes
    from geartrain.scene.solids.solid_assembly import SolidModel as SolidModel
    from geartrain.scene.solids.solid_part import SolidPart as SolidPart
    from geartrain.scene.train_scene import DialFace as DialFace
    from geartrain.scene.train_scene import Pointer as Pointer
    from geartrain.scene.train_scene import PointerTarget as PointerTarget
    from geartrain.scene.train_scene import Scene as Scene
    from geartrain.scene.train_scene import SceneEpoch as SceneEpoch
    from geartrain.scene.train_scene import SceneSetting as SceneSetting
    from geartrain.scene.train_scene import TourStop as TourStop

__all__ = [
    "AxisPlace",
    "CountCondition",
    "CountFormula",
    "DialFace",
    "ErrorSource",
    "ErrorStep",
    "ErrorTable",
    "Layout",
    "LinkCourse",
    "ManufacturingSizes",
    "Movement",
    "Pointer",
    "PointerTarget",
    "Scene",
    "SceneBody",
    "SceneContact",
    "SceneCoupling",
    "SceneEpoch",
    "SceneFormulas",
    "SceneHanger",
    "ScenePair",
    "ScenePart",
    "SceneRun",
    "SceneSetting",
    "SceneWave",
    "SceneWheel",
    "SolidModel",
    "SolidPart",
    "ToothProfile",
    "TourStop",
    "WheelPlace",
    "build_scene",
    "lay_out",
    "make_scene",
]

_PLACES = {
    "make_scene": "construction",
    **dict.fromkeys(("CountCondition", "CountFormula", "SceneFormulas"), "count_formulas"),
    **dict.fromkeys(("SceneBody", "SceneCoupling", "SceneHanger", "ScenePair", "ScenePart"), "elements"),
    **dict.fromkeys(("SceneWave", "SceneWheel", "ToothProfile"), "elements"),
    **dict.fromkeys(("AxisPlace", "Layout", "WheelPlace", "lay_out"), "layout.train_layout"),
    **dict.fromkeys(("ErrorSource", "ErrorStep", "ErrorTable", "Movement"), "movement"),
    **dict.fromkeys(("LinkCourse", "SceneContact", "SceneRun"), "scene_run"),
    "build_scene": "solids.built_scene",
    "ManufacturingSizes": "solids.manufacturing_sizes",
    "SolidModel": "solids.solid_assembly",
    "SolidPart": "solids.solid_part",
    **dict.fromkeys(
        ("DialFace", "Pointer", "PointerTarget", "Scene", "SceneEpoch", "SceneSetting", "TourStop"), "train_scene"
    ),
}

__getattr__ = lazy_names(__name__, _PLACES)
