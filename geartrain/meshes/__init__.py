"""Real teeth and pins of a train: a law for every gear pair with a tooth form and every coupling with dimensions."""

from geartrain.meshes.conjugate import ConjugateMesh
from geartrain.meshes.finding import PinJoint, find_meshes, find_pins
from geartrain.meshes.mesh import Driver, Fit, Mesh, find_faults
from geartrain.meshes.sizing import PairSize, find_sizes
from geartrain.meshes.triangular import TriangularMesh, explain, locked_by_friction

__all__ = [
    "ConjugateMesh",
    "Driver",
    "Fit",
    "Mesh",
    "PairSize",
    "PinJoint",
    "TriangularMesh",
    "explain",
    "find_faults",
    "find_meshes",
    "find_pins",
    "find_sizes",
    "locked_by_friction",
]
