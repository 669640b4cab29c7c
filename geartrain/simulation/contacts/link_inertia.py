"""Moments of inertia of links, which are declared or computed from the plates from which their wheels are cut.

A wheel of density rho and thickness t has the moment of inertia rho t (integral of r^2 dA) over its outline, without
spokes, by Green's theorem. A planet of mass m at a distance r from its carrier's axis adds m r^2 to the carrier.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple

from geartrain.dynamics.cut_teeth import find_cut_teeth, find_modules
from geartrain.dynamics.wheel_teeth import WheelTeeth
from geartrain.numerics.quantity import TRAVEL_ARM
from geartrain.numerics.results import Result

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics

_MILLIMETRES = 1e-3


@dataclass(frozen=True)
class LinkInertia(Result):
    """Moment of inertia of a link, and the source of this value."""

    link: str
    """Name of the link."""
    value: float
    """Moment of inertia about the link's axis, including the planets that the link carries [kg m2]; 0 if it is unknown.
    For a sliding link, it gives the same kinetic energy if a travel of 1 mm is treated as one turn.
    """
    source: Literal["declared", "outlines", "unknown"]
    """Source of the moment of inertia without the planets: declaration, outlines of the wheels, or unknown."""
    carried: float = 0.0
    """Part of `value` that is due to the masses of carried planets [kg m2]."""
    missing: tuple[str, ...] = ()
    """Reasons why the inertia, or a part of it, is unknown; empty if the inertia is complete."""


class PlateMoments(NamedTuple):
    """Mass [kg] and moment of inertia [kg m2] of a plate."""

    mass: float
    inertia: float


def plate_moments(teeth: WheelTeeth, module: float, thickness: float, density: float) -> PlateMoments:
    """Return the mass and the moment of inertia of a wheel cut from a plate. The wheel is solid except for its pin
    holes.

    `module` and `thickness` are in m, `density` in kg/m3.
    """
    # moments are signed by the orientation of the contour
    outer, *holes = (contour.moments() for contour in teeth.contours(module / _MILLIMETRES))
    area = abs(outer[0]) - sum(abs(hole[0]) for hole in holes)
    polar = abs(outer[1]) - sum(abs(hole[1]) for hole in holes)
    scale = density * thickness
    return PlateMoments(scale * area * _MILLIMETRES**2, scale * polar * _MILLIMETRES**4)


def find_link_inertias(
    train: TrainMechanics, state: str | None = None, with_inputs: bool = False
) -> tuple[LinkInertia, ...]:
    """Return the moment of inertia of every moving link whose motion is not prescribed, with the source of each value.

    Parameters
    ----------
    train : TrainMechanics
        Mechanics of the train, from `GearTrain.mechanics`.
    state : str, optional
        Name of a declared state; None only for a train that has no states.
    with_inputs : bool
        True to include the inputs, for example if a torque or a weight drives them.

    Returns
    -------
    tuple of LinkInertia
        Inertias in the order of the declaration (docs/dynamics.md, section 1).

    Examples
    --------
    Inertia of a bronze wheel, 2 mm thick, from the outlines of its teeth:

    >>> import geartrain
    >>> train = geartrain.load('''
    ... links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: {teeth: 60, module: 1 mm}}}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... gears: [{pair: [p, w]}]
    ... density: 8.7 g/cm3
    ... thickness: 2 mm
    ... inputs: {a: 1}
    ... ''')
    >>> found = find_link_inertias(train.mechanics)
    >>> [(each.link, each.source, float(f"{each.value:.3g}")) for each in found]
    [('b', 'outlines', 2.2e-05)]
    """
    # equal planets share the load, and their masses add
    train = train.planets_as_one
    declared, case = train.declaration, train.kinematics.case(state)
    prescribed = {declared.frame, *case.fixed} | (set() if with_inputs else set(case.inputs))
    bodies = _Bodies(train)
    return tuple(bodies.total_inertia(link) for link in declared.links if link not in prescribed)


class _Bodies:
    """Links of a train as rigid bodies, with their masses and moments of inertia."""

    def __init__(self, train: TrainMechanics) -> None:
        self.train, self.declared = train, train.declaration

    def total_inertia(self, link: str) -> LinkInertia:
        """Return the moment of inertia of a link, including the planets that it carries."""
        if link in self.train.tree.lines:
            return self._sliding(link)
        own = self._own_inertia(link)
        tree, missing = self.train.tree, list(own.missing)
        carried = 0.0
        for planet in self.declared.links:
            if not tree.bears(link, planet):
                continue
            mass, radius = self._mass(planet), self._orbit(link, planet)
            if mass is None or radius is None:
                what = "mass" if mass is None else "distance from its axis"
                missing.append(f"the {what} of '{planet}', which it carries, is not known")
            else:
                carried += mass * radius**2
        return replace(own, value=own.value + carried, carried=carried, missing=tuple(missing))

    def _sliding(self, link: str) -> LinkInertia:
        """Return the moment of inertia that represents the mass of a sliding link and of the links that it carries, if
        1 mm of travel is treated as one turn.
        """
        tree, line = self.train.tree, self.train.tree.lines[link]
        masses = {each: self._mass(each) for each in self.declared.links if tree.moving(each, line) == link}
        missing = tuple(f"the mass of '{each}' is not known" for each, mass in masses.items() if mass is None)
        own, whole = masses[link] or 0.0, sum(mass or 0.0 for mass in masses.values())
        arm = float(TRAVEL_ARM)
        source: Literal["declared", "unknown"] = "unknown" if masses[link] is None else "declared"
        return LinkInertia(link, whole * arm**2, source, (whole - own) * arm**2, missing)

    def _own_inertia(self, link: str) -> LinkInertia:
        part = self.declared.links[link]
        if part.inertia is not None:
            return LinkInertia(link, part.inertia.si, "declared")
        plates, missing = self._plates(link)
        if missing or not plates:
            return LinkInertia(
                link, 0.0, "unknown", missing=missing or ("it has neither wheels nor a declared `inertia`",)
            )
        return LinkInertia(link, sum(plate.inertia for plate in plates), "outlines")

    def _mass(self, link: str) -> float | None:
        part = self.declared.links[link]
        if part.mass is not None:
            return part.mass.si
        plates, missing = self._plates(link)
        return None if missing or not plates else sum(plate.mass for plate in plates)

    def _plates(self, link: str) -> tuple[Sequence[PlateMoments], tuple[str, ...]]:
        """Return the mass and moment of inertia of each wheel of a link, and texts that name missing data."""
        plates, missing = [], []
        for name, wheel in self.declared.links[link].wheels.items():
            thickness = wheel.thickness or self.declared.thickness
            density = wheel.density or self.declared.density
            lacking = [key for key, given in (("density", density), ("thickness", thickness),
                                              ("module", self.modules.get(name))) if given is None]  # fmt: skip
            if lacking or thickness is None or density is None:
                missing.append(f"wheel '{name}' has no {', no '.join(lacking)}")
            elif wheel.internal:
                missing.append(f"wheel '{name}' is a ring, and the width of its rim is not known")
            elif name not in self.teeth:
                missing.append(f"wheel '{name}' has no planar outline")
            else:
                plates.append(plate_moments(self.teeth[name], self.modules[name], thickness.si, density.si))
        return plates, tuple(missing)

    @cached_property
    def modules(self) -> Mapping[str, float]:
        """Transverse module of each wheel [m], keyed by wheel."""
        return find_modules(self.declared)

    @cached_property
    def teeth(self) -> Mapping[str, WheelTeeth]:
        """Tooth geometry of each planar wheel, keyed by wheel."""
        return find_cut_teeth(self.train).wheels

    def _orbit(self, carrier: str, planet: str) -> float | None:
        """Return the distance from a carrier's axis to a planet's axis [m], which is the centre distance of a gear pair
        on this carrier; None if it is unknown.
        """
        from geartrain.dynamics.gear_meshes import find_sizes

        tree = self.train.tree
        for circuit in self.train.circuits:
            # only a gear pair on this carrier fixes the distance of the planet's axis
            ends = (circuit.i, circuit.j)
            if circuit.kind != "gear" or circuit.carrier != carrier or planet not in ends:
                continue
            other = ends[1 - ends.index(planet)]
            module = self.modules.get(circuit.wheels[0])
            # the mate must turn about the carrier's own axis
            if module is None or tree.axis_seen_from(carrier, other) != tree.axis(carrier):
                continue
            sizes = find_sizes(mesh for mesh in self.train.meshes if mesh.name == circuit.id)
            if circuit.id in sizes:
                return sizes[circuit.id].distance * module
            first, second = (self.declared.wheels[wheel][1] for wheel in circuit.wheels)
            z1, z2 = first.count or 0, second.count or 0
            # centre distance of standard gears without profile shift
            return module * (abs(z1 - z2) if first.internal or second.internal else z1 + z2) / 2
        return None
