"""Error against run time, measured in one run against named alternatives."""

from __future__ import annotations

from geartrain.bench.families import FAMILIES
from geartrain.bench.kinematics import count_steps, kinematics
from geartrain.bench.mesh import count_mesh_steps, mesh
from geartrain.bench.mesh_records import MeshRecord, MeshRecords
from geartrain.bench.motion import count_motion_steps, motion
from geartrain.bench.motion_records import GrowthRecord, MotionRecord, MotionRecords, TrainRecord
from geartrain.bench.record import Record, Records
from geartrain.bench.shapes import count_shape_steps, shapes
from geartrain.bench.shapes_records import ExtremeRecord, InwardRecord, ShapeRecords, WorkRecord, quickest
from geartrain.bench.sphere import count_sphere_steps, sphere
from geartrain.bench.sphere_records import ClosureRecord, FitRecord, PackRecord, SphereRecords, growth
from geartrain.bench.teeth import count_teeth_steps, teeth
from geartrain.bench.teeth_records import TeethGrowth, TeethRecord, TeethRecords
from geartrain.bench.uncertainty import count_uncertainty_steps, uncertainty
from geartrain.bench.uncertainty_records import ErrorRecord, RateRecord, UncertaintyRecords, WorkerRecord

__all__ = [
    "FAMILIES",
    "ClosureRecord",
    "ErrorRecord",
    "ExtremeRecord",
    "FitRecord",
    "GrowthRecord",
    "InwardRecord",
    "MeshRecord",
    "MeshRecords",
    "MotionRecord",
    "MotionRecords",
    "PackRecord",
    "RateRecord",
    "Record",
    "Records",
    "ShapeRecords",
    "SphereRecords",
    "TeethGrowth",
    "TeethRecord",
    "TeethRecords",
    "TrainRecord",
    "UncertaintyRecords",
    "WorkRecord",
    "WorkerRecord",
    "count_mesh_steps",
    "count_motion_steps",
    "count_shape_steps",
    "count_sphere_steps",
    "count_steps",
    "count_teeth_steps",
    "count_uncertainty_steps",
    "growth",
    "kinematics",
    "mesh",
    "motion",
    "quickest",
    "shapes",
    "sphere",
    "teeth",
    "uncertainty",
]
