"""Analysis of a set of gears on a sphere: mobility, assembly of the teeth, and sizes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, pi, sin
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.spherical.assembly import spherical_divisibility_rule, spherical_phasing
from geartrain.spherical.configuration import Configuration, kinds_in_order, mesh_kinds, to_train
from geartrain.spherical.gear_sizes import SphereSizing, size_gears

if TYPE_CHECKING:
    from geartrain.kinematics.gridlock.removal import Gridlock
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.numerics.arrays import Floats
    from geartrain.spherical.graph_set import GraphSet

_SPREAD = Key("pitch_spread", "spread")


@dataclass(frozen=True)
class GearSphere(Result):
    """Set of gears on a sphere, and the results of its analysis. Each result is computed when its property is first
    accessed.

    Examples
    --------
    Gears with 20 and 12 teeth on the faces of the icosidodecahedron can turn, mesh around all 29 loops, and have equal
    pitches:

    >>> from geartrain.spherical import from_polyhedron
    >>> sphere = GearSphere(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}), radius=3.13198541004301)
    >>> sphere.moves, sphere.closes, sphere.rule, sphere.sizing.exact
    (True, True, '3 divides z3 and 5 divides z5', True)
    >>> {kind: round(radius, 6) for kind, radius in sphere.radii.items()}
    {'5': 1.25, '3': 0.75}
    """

    PAGE = "report.spherical_report:describe_sphere"

    KEYS = (
        Key("title", "configuration.title"),
        *(Key("gears", "gear_count"), Key("meshes", "mesh_count"), "kinds", Key("teeth", "configuration.teeth")),
        *(
            Key("mobility", "train.mobility.by_rank"),
            "gridlock",
            "rule",
            "closes",
            "residue",
            "loop_residue",
            "closure",
        ),
        *(Key("sphere_radius", "radius"), "radii", Key("cones", to=degrees), Key("angles", to=degrees)),
        Key("graph", keys=("aim", "exact", Key("axes_moved", "maximum_move", degrees), _SPREAD, "residue")),
        "sizing",
    )

    configuration: Configuration
    """Axes, meshes, kinds and tooth numbers of the set."""
    radius: float = 1.0
    """Radius of the sphere, in any unit of length; the pitch radii have the same unit."""
    graph: GraphSet | None = None
    """Result of the construction from a graph; None if the set was not made from a graph."""

    def _summary(self) -> str:
        return f"{self.configuration._summary()}, radius {self.radius:g}"

    @cached_property
    def chosen(self) -> bool:
        """True if a tooth number is chosen for every kind."""
        return all(kind in self.configuration.teeth for kind in self.configuration.kinds)

    @cached_property
    def train(self) -> GearTrain:
        """Gear train of the set. Gears without a chosen tooth number are given ten teeth, because senses of rotation do
        not depend on tooth numbers.
        """
        whole = {kind: self.configuration.teeth.get(kind, 10) for kind in self.configuration.kinds}
        return GearTrain.declare(to_train(replace(self.configuration, teeth=whole)))

    @cached_property
    def moves(self) -> bool:
        """True if the gear train of the set has a degree of freedom and no locked loop."""
        return self.train.mobility.by_rank > 0 and not self.train.mobility.locked

    @cached_property
    def sizing(self) -> SphereSizing | None:
        """Pitch cones, pitches and pressure angles of the gears; None if a tooth number is missing."""
        return size_gears(self.configuration) if self.chosen else None

    @cached_property
    def closure(self) -> MeshPhasing | None:
        """Phases of the meshes around every loop; None if a tooth number is missing, or if the set cannot turn."""
        return spherical_phasing(self.configuration) if self.chosen and self.moves else None

    def pose(self) -> tuple[Configuration, Floats, list[float]]:
        """Return the data for a picture: the set, the half-angles of the pitch cones [rad], and the phases of the teeth
        [pitch].
        """
        sizing = self.sizing
        if sizing is None:
            fix = "give tooth numbers, such as --teeth 5=20,3=12"
            raise QuestionError(Problem("the sphere cannot be drawn", "its gears have no tooth numbers", fix))
        angles = {} if self.closure is None else self.closure.angles
        # phases are fractions of a pitch, which need the tooth numbers
        counts = zip(self.configuration.names, sizing.teeth.tolist(), strict=True)
        phases = [angles.get(name, 0.0) * z / (2 * pi) for name, z in counts]
        return self.configuration, sizing.outer, phases

    @cached_property
    def rule(self) -> str | None:
        """Divisibility rule that the tooth numbers must satisfy for the loops to close; None if the set cannot turn, or
        if the angles between contacts are not known fractions of a revolution.
        """
        rule = spherical_divisibility_rule(self.configuration) if self.moves else None
        return None if rule is None else rule.text

    @property
    def gear_count(self) -> int:
        """Number of gears."""
        return len(self.configuration.names)

    @property
    def mesh_count(self) -> int:
        """Number of meshes."""
        return len(self.configuration.meshes)

    @property
    def kinds(self) -> Mapping[str, int]:
        """Number of gears of each kind."""
        return {kind: self.configuration.kinds.count(kind) for kind in self.cones}

    @property
    def gridlock(self) -> Gridlock | None:
        """Locked parts of the set and the meshes to be removed; None if the set can turn."""
        return None if self.moves else self.train.kinematics.gridlock

    @property
    def closes(self) -> bool | None:
        """True if the teeth mesh around all loops; None if a tooth number is missing, or if the set cannot turn."""
        return None if self.closure is None else bool(self.closure)

    @property
    def residue(self) -> float | None:
        """Maximum phase error of the meshes that are closed last if the gears are assembled one after another [pitch];
        None if `closes` is None.
        """
        return None if self.closure is None else self.closure.last

    @property
    def loop_residue(self) -> float | None:
        """Maximum closing error of the loops [pitch]; None if `closes` is None."""
        return None if self.closure is None else float(self.closure.worst)

    @cached_property
    def cones(self) -> Mapping[str, float | None]:
        """Half-angle of the largest operating pitch cone of each kind of gear [rad]; all values are None if a tooth
        number is missing.
        """
        kinds = kinds_in_order(self.configuration)
        if self.sizing is None:
            return dict.fromkeys(kinds)
        # gears of one kind have equal cones
        cones = dict(zip(self.configuration.kinds, self.sizing.outer.tolist(), strict=True))
        return {kind: cones[kind] for kind in kinds}

    @property
    def radii(self) -> Mapping[str, float | None]:
        """Pitch radius of each kind of gear, in the unit of `radius`; all are None if a tooth number is missing."""
        return {kind: None if cone is None else self.radius * sin(cone) for kind, cone in self.cones.items()}

    @property
    def angles(self) -> Mapping[str, float]:
        """Angle between the two axes of each kind of mesh [rad]."""
        return {f"{each.a}-{each.b}": each.angle for each in mesh_kinds(self.configuration)}
