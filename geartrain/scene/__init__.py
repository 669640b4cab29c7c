"""Layouts, scenes and solids: the geometry of a train in space and time.

In: a train, a state, a layout; sizes to make it in. Out: places of axes and wheels, all data of a picture that turns,
solids to be exported. Lengths are in mm and angles in rad; ratios are exact.

lay_out      a `Layout`: axes and wheels in space, as declared or placed so that pitch circles touch
build_scene  the same with its plates, pillars, arbors and dials, as they are made
make_scene   a `Scene`: the train in one state, its angles from exact speeds and, of real teeth, equations (1) to (4) of
             docs/motion.md
SolidModel   wheels, arbors and plates as closed surfaces, in the sizes of `ManufacturingSizes`

context, construction                        what every part of a scene reads; from a train to its scene
train_scene, elements, built_elements        the scene as plain data, and what is in it
bodies, wheel_phases, strain_waves           links and wheels with their teeth; where two wheels meet; wave wheels
joints, movement, error_steps, pose          pairs and pins; exact speeds with the errors of teeth; positions
dial_scale, dial_marks, dial_pointers        scales of dials, what is engraved on them, what pointers show
hand_outlines, stroke_letters, palette       hands, letters, colours
count_formulas                               speeds as functions of tooth counts, for pages that change counts
run_courses, scene_run, sky                  a simulated run as a page plays it; dates and mean motions
layout, solids, parts                        places of axes and wheels; closed surfaces; parts to be made

A wheel stands at the pitch point of its mates: equations (2), (3), (8) of docs/theory.md for parallel axes, cones and
worms.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.scene.built_elements import SceneHanger as SceneHanger
    from geartrain.scene.built_elements import ScenePart as ScenePart
    from geartrain.scene.construction import make_scene as make_scene
    from geartrain.scene.count_formulas import CountCondition as CountCondition
    from geartrain.scene.count_formulas import CountFormula as CountFormula
    from geartrain.scene.count_formulas import SceneFormulas as SceneFormulas
    from geartrain.scene.elements import SceneBody as SceneBody
    from geartrain.scene.elements import SceneCoupling as SceneCoupling
    from geartrain.scene.elements import ScenePair as ScenePair
    from geartrain.scene.elements import SceneWave as SceneWave
    from geartrain.scene.elements import SceneWheel as SceneWheel
    from geartrain.scene.elements import ToothProfile as ToothProfile
    from geartrain.scene.error_steps import ErrorLawTable as ErrorLawTable
    from geartrain.scene.error_steps import ErrorSource as ErrorSource
    from geartrain.scene.error_steps import ErrorStep as ErrorStep
    from geartrain.scene.error_steps import Movement as Movement
    from geartrain.scene.layout.train_layout import AxisPlace as AxisPlace
    from geartrain.scene.layout.train_layout import Layout as Layout
    from geartrain.scene.layout.train_layout import WheelPlace as WheelPlace
    from geartrain.scene.layout.train_layout import lay_out as lay_out
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

__all__ = [
    "AxisPlace",
    "CountCondition",
    "CountFormula",
    "DialFace",
    "ErrorLawTable",
    "ErrorSource",
    "ErrorStep",
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
    "SceneWave",
    "SceneWheel",
    "SolidModel",
    "SolidPart",
    "ToothProfile",
    "WheelPlace",
    "build_scene",
    "lay_out",
    "make_scene",
]

_PLACES = {
    "AxisPlace": "layout.train_layout",
    "CountCondition": "count_formulas",
    "CountFormula": "count_formulas",
    "DialFace": "train_scene",
    "ErrorLawTable": "error_steps",
    "ErrorSource": "error_steps",
    "ErrorStep": "error_steps",
    "Layout": "layout.train_layout",
    "LinkCourse": "scene_run",
    "ManufacturingSizes": "solids.manufacturing_sizes",
    "Movement": "error_steps",
    "Pointer": "train_scene",
    "PointerTarget": "train_scene",
    "Scene": "train_scene",
    "SceneBody": "elements",
    "SceneContact": "scene_run",
    "SceneCoupling": "elements",
    "SceneEpoch": "train_scene",
    "SceneFormulas": "count_formulas",
    "SceneHanger": "built_elements",
    "ScenePair": "elements",
    "ScenePart": "built_elements",
    "SceneRun": "scene_run",
    "SceneWave": "elements",
    "SceneWheel": "elements",
    "SolidModel": "solids.solid_assembly",
    "SolidPart": "solids.solid_assembly",
    "ToothProfile": "elements",
    "WheelPlace": "layout.train_layout",
    "build_scene": "solids.built_scene",
    "lay_out": "layout.train_layout",
    "make_scene": "construction",
}

__getattr__ = lazy_names(__name__, _PLACES)
