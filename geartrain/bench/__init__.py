"""Error against run time, measured in one run against named alternatives."""

from __future__ import annotations

from geartrain.bench.families import FAMILIES
from geartrain.bench.kinematics import count_steps, kinematics
from geartrain.bench.mesh import MeshRecord, MeshRecords, count_mesh_steps, mesh
from geartrain.bench.motion import count_motion_steps, motion
from geartrain.bench.motion_records import GrowthRecord, MotionRecord, MotionRecords, TrainRecord
from geartrain.bench.record import Record, Records
from geartrain.bench.sphere import count_sphere_steps, sphere
from geartrain.bench.sphere_records import ClosureRecord, FitRecord, PackRecord, SphereRecords, growth

__all__ = [
    "FAMILIES",
    "ClosureRecord",
    "FitRecord",
    "GrowthRecord",
    "MeshRecord",
    "MeshRecords",
    "MotionRecord",
    "MotionRecords",
    "PackRecord",
    "Record",
    "Records",
    "SphereRecords",
    "TrainRecord",
    "count_mesh_steps",
    "count_motion_steps",
    "count_sphere_steps",
    "count_steps",
    "growth",
    "kinematics",
    "mesh",
    "motion",
    "sphere",
]
