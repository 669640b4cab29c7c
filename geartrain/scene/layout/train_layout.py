"""From a train to its layout: every axis and every wheel in space, in the pose in which all angles are zero."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem
from geartrain.numerics.vectors import Vector, across, dot, minus, size
from geartrain.scene.layout.declared_geometry import read_geometry
from geartrain.scene.layout.layout_diagnostics import notices, pitch_gaps
from geartrain.scene.layout.mesh_alignment import align_meshes, reference
from geartrain.scene.layout.parallel_groups import Arrangement, arrange
from geartrain.scene.layout.wheel_reach import bare_reach, span
from geartrain.scene.layout.wheel_sizes import Seat, size_geometry

How = Literal["given", "found", "free"]
_Z: Vector = (0.0, 0.0, 1.0)  # the axis of what is declared to stand on none
_PARALLEL = 1e-9  # of the cosine: directions are rounded to floats


@dataclass(frozen=True, slots=True)
class AxisPlace:
    """An axis in the zero pose.

    Attributes
    ----------
    label : str
        Its name in the declaration.
    point : tuple of float
        A point of it [mm].
    direction : tuple of float
        Unit vector as declared: speeds of its links are positive about it.
    how : {"given", "found", "free"}
        Given in the declaration, found from wheels that mesh, or free: put where there is room.
    carrier : str
        The link that bears it, the frame or a carrier.

    See Also
    --------
    lay_out : gives it, in `Layout.axes`.
    """

    label: str
    point: Vector
    direction: Vector
    how: How
    carrier: str


@dataclass(frozen=True, slots=True)
class WheelPlace:
    """A wheel on its axis in the zero pose.

    Attributes
    ----------
    wheel, link, axis : str
        Its name, the link that carries it and the axis it turns about.
    centre : tuple of float
        Middle of its pitch circle, on its axis [mm].
    radius : float
        Of its pitch circle [mm]; at the wide end of a bevel wheel.
    module : float
        Pitch diameter over tooth count [mm].
    thickness : float
        Of its rim along the axis [mm].
    given : bool
        True if the declaration gives the module of this wheel, or of one that it meshes with.
    cone : float
        Half angle of its pitch cone [rad]: 0 of a cylinder, pi/2 of a crown wheel.
    facing : int
        Side of the axis, along its direction, to which the cone opens: 1 or -1; 0 of a cylinder.
    layer : int or None
        Number of the level it stands in, 0 nearest the origin, growing along the axis; None off the main axes.
    turn : float
        Angle of its first tooth about its axis' direction from `reference`, so that teeth mesh [rad].
    reference : tuple of float
        Unit vector across the axis from which `turn` is counted.

    See Also
    --------
    lay_out : gives it, in `Layout.wheels`.
    """

    wheel: str
    link: str
    axis: str
    centre: Vector
    radius: float
    module: float
    thickness: float
    given: bool = False
    cone: float = 0.0
    facing: int = 0
    layer: int | None = 0
    turn: float = 0.0
    reference: Vector = (1.0, 0.0, 0.0)

    @property
    def span(self) -> tuple[float, float]:
        """Between which places of its axis its body stands, from its centre along the axis' direction [mm]."""
        return span(self.facing, *bare_reach(self.cone, self.radius, self.thickness, self.module))


@dataclass(frozen=True, slots=True)
class Layout:
    """All axes and wheels of a train in space.

    Attributes
    ----------
    axes : mapping of str to AxisPlace
        By label.
    wheels : mapping of str to WheelPlace
        By name.
    notices : tuple of Problem
        What could not be placed as declared, or collides: what, why and what to do.
    front : int
        The side of z from which the train is looked at: 1 or -1.
    apart : mapping of str to float
        Gear pairs whose wheels do not touch as placed: how far their pitch circles are apart [mm], negative into each
        other.

    See Also
    --------
    lay_out : gives it.
    """

    axes: Mapping[str, AxisPlace]
    wheels: Mapping[str, WheelPlace]
    notices: tuple[Problem, ...] = ()
    front: int = 1
    apart: Mapping[str, float] = field(default_factory=dict)

    def axis_distance(self, first: str, second: str) -> float | None:
        """How far apart the axes of two wheels are, where they are parallel.

        Parameters
        ----------
        first, second : str
            Names of wheels.

        Returns
        -------
        float or None
            In mm; None where the axes are not parallel.
        """
        one, other = self.wheels[first], self.wheels[second]
        directions = [self.axes[each.axis].direction if each.axis in self.axes else _Z for each in (one, other)]
        if abs(abs(dot(*directions)) - 1) > _PARALLEL:
            return None
        return size(across(minus(one.centre, other.centre), directions[0]))


def lay_out(train: GearTrain) -> Layout:
    """Places of all axes and wheels of a train by beam search and local search; the same for the same declaration.

    Declared positions, modules and offsets of pins always hold. What is left open is found so that pitch circles
    touch, wheels of one level keep apart and the plan is compact. Every train that loads has a layout. The time grows
    with the square of the number of axes: a quarter of a second for 70 wheels, a second for 1000 axes.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared; it need not be able to turn.

    Returns
    -------
    Layout
        Lengths in mm, in the pose in which all angles are zero; its `notices` tell what could not be met.

    Notes
    -----
    In this order: modules of all wheels (`wheel_modules`), groups of parallel axes (`parallel_groups`), of each group
    the plan (`plan_search`) and the heights of its wheels (`stack_order`, `wheel_stacks`), then the angles at which
    teeth mesh (`mesh_alignment`).

    Examples
    --------
    A sun of 24, a planet of 18 and a ring of 60 teeth, where nothing gives a size, have a module of 1 mm.

    >>> import geartrain
    >>> layout = lay_out(geartrain.load("planetary-24-18-60"))
    >>> {name: wheel.radius for name, wheel in layout.wheels.items()}
    {'ring': 30.0, 's': 12.0, 'p': 9.0}
    """
    train = train.unfolded
    geometry = size_geometry(read_geometry(train))
    declared = geometry.declared
    found = arrange(geometry)
    alignment = align_meshes(found)
    gaps = pitch_gaps(found)
    return Layout(
        _axis_places(found),
        _wheel_places(found, alignment.turns),
        tuple(notices(train, found, gaps, alignment.misses)),
        declared.front,
        gaps,
    )


def _axis_places(found: Arrangement) -> dict[str, AxisPlace]:
    declared = found.geometry.declared
    pairs = (*found.geometry.modules.distances, *(contact.axes for contact in declared.contacts))
    tied = {label for pair in pairs for label in pair}
    places = {}
    for label, line in declared.lines.items():
        how: How = "given" if line.given else "found" if label in tied else "free"
        places[label] = AxisPlace(label, found.points[label], line.direction, how, line.bearers[0])
    return places


def _wheel_places(found: Arrangement, turns: Mapping[str, float]) -> dict[str, WheelPlace]:
    geometry, declared = found.geometry, found.geometry.declared
    layers, coned = _layers(found), _coned_seats(found)
    places = {}
    for wheel, (link, kind) in declared.wheels.items():
        axis, sized = declared.axis[wheel], geometry.sizes[wheel]
        direction = declared.lines[axis].direction if axis else _Z
        cone = coned[wheel].cone if wheel in coned else 0.0
        places[wheel] = WheelPlace(
            wheel=wheel,
            link=link,
            axis=axis,
            centre=found.centres[wheel],
            radius=sized.radius,
            module=sized.module,
            thickness=sized.thickness,
            given=wheel in geometry.modules.declared,
            cone=cone,
            facing=kind.facing if cone else 0,
            layer=layers.get(wheel),
            turn=turns.get(wheel, 0.0),
            reference=reference(direction),
        )
    return places


def _coned_seats(found: Arrangement) -> dict[str, Seat]:
    """The seat of each wheel that has a cone; a wheel that also meshes about a parallel axis has none."""
    contacts = found.geometry.declared.contacts
    straight = {wheel for contact in contacts if contact.parallel for wheel in contact.wheels}
    return {wheel: seat for (_, wheel), seat in found.geometry.seats.items() if wheel not in straight}


def _layers(found: Arrangement) -> dict[str, int]:
    """Numbers of levels of the wheels on the main axes, from below; a broad wheel counts where it begins."""
    declared, sizes = found.geometry.declared, found.geometry.sizes
    heights = {
        wheel: dot(found.centres[wheel], found.up) - sizes[wheel].foot
        for wheel, axis in declared.axis.items()
        if axis and declared.lines[axis].group == found.main
    }
    levels: list[float] = []
    layers = {}
    for wheel, height in sorted(heights.items(), key=lambda each: each[1]):
        if not levels or height - levels[-1] > 1e-6 * sizes[wheel].thickness:  # less is rounding
            levels.append(height)
        layers[wheel] = len(levels) - 1
    return layers
