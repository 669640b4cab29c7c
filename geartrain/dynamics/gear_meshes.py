"""Gear meshes with declared tooth forms, and couplings with variable ratio, built from the declaration of a train.

The module also computes tooth sizes if only the tooth shape is declared. The size of triangular teeth is arbitrary, but
a wheel has the same size in all its pairs. Therefore, the sizes in every connected set of pairs follow from its first
pair by breadth-first search. Each pair is at the centre distance that its transmission function requires.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import MeshingWheels, PairSize
from geartrain.train import GearPair, Train

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.pitch_distances import PairOutline
    from geartrain.teeth.coupling import Coupling
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission, SlotToPinTransmission
    from geartrain.teeth.couplings.pins import PinCoupling
    from geartrain.teeth.transmission import TransmissionFunction


ShaftAngle = Callable[[GearPair], float | None]
"""Function that returns the shaft angle of a gear pair [rad]; None for a pair on parallel axes."""


@dataclass(frozen=True)
class CouplingMesh:
    """Coupling with variable ratio and declared dimensions, together with its transmission function."""

    coupling: Coupling
    transmission: TransmissionFunction


@dataclass(frozen=True)
class PinMesh(CouplingMesh):
    """Pin-and-slot coupling with declared dimensions, together with its transmission function."""

    coupling: PinCoupling
    transmission: PinToSlotTransmission

    @property
    def reversed(self) -> SlotToPinTransmission:
        """Transmission function if the slot drives the pin. Raises `RangeError` for a pin follower, whose slot only
        oscillates and cannot drive the pin.
        """
        from geartrain.teeth.couplings.pin_transmission import SlotToPinTransmission

        return SlotToPinTransmission(self.transmission.r, self.transmission.e, self.transmission.friction)


def find_meshes(train: Train, shaft_angle: ShaftAngle = lambda _: None) -> Mapping[str, GearMesh]:
    """Return the meshes of all gear pairs with a declared tooth form, by name of the pair.

    The first wheel of a pair is the driver, unless it is changed by `GearMesh.driven_by`. The teeth of a pair are built
    on first access to the pair; `GearTrainError` is then raised if they cannot be built.

    shaft_angle   function that returns the shaft angle of a pair; it is called only if the tooth form requires the
                  angle
    """
    forms = {gear.name: (at, gear, train.form_of(gear)) for at, gear in enumerate(train.gears)}

    def made(name: str) -> GearMesh:
        at, gear, form = forms[name]
        wheels = _meshing_wheels(train, gear, train.place("gears", at))
        assert form is not None
        try:
            mesh = form.mesh(wheels, partial(shaft_angle, gear))
        except GearTrainError as error:
            what = f"pair '{name}'"
            problems = [replace(each, what=f"{what}: {each.what}", place=wheels.place) for each in error.problems]
            raise GearTrainError(problems) from None
        assert mesh is not None
        return mesh

    # the form "ideal" has no teeth
    real = (name for name, (_, _, form) in forms.items() if form is not None and form.form != "ideal")
    return ItemwiseMapping(real, made)


def all_meshes(meshes: Mapping[str, GearMesh]) -> tuple[GearMesh, ...]:
    """Return all meshes with the teeth of every pair built. Raise `GearTrainError` with all problems found."""
    problems: list[Problem] = []
    for name in meshes:
        try:
            _ = meshes[name]
        except GearTrainError as error:
            problems += error.problems
    if problems:
        raise GearTrainError(problems)
    return tuple(meshes.values())


def _meshing_wheels(train: Train, gear: GearPair, place: str) -> MeshingWheels:
    """Return tooth counts, kinds, dimensions and friction of the wheels of a pair, which is declared at `place`."""
    first, second = wheels = [train.wheels[name][1] for name in gear.pair]
    friction = train.friction_of(gear)
    kinds = ["helical" if wheel.is_helical else wheel.kind for wheel in wheels]
    widths = [width.si for wheel in wheels if (width := wheel.thickness or train.thickness) is not None]
    radii = [
        wheel.transverse_module * wheel.count / 2
        for wheel in wheels
        if wheel.transverse_module is not None and wheel.count is not None
    ]
    return MeshingWheels(
        gear,
        place,
        (first.count or 0, second.count or 0),
        (kinds[0], kinds[1]),
        (first.internal, second.internal),
        None if friction is None else friction.sliding,
        sum(radii) if len(radii) == 2 else None,
        None if friction is None else friction.law,
        helix=(first.helix, second.helix),
        width=min(widths) if len(widths) == 2 else None,
    )


def find_couplings(train: Train, couplings: Iterable[Coupling]) -> tuple[CouplingMesh, ...]:
    """Return the couplings of a train that have a variable ratio and declared dimensions.

    couplings   couplings with the angles between their axes, as returned by `couplings_on_axes`
    """
    pins = {each.name for each in train.pin_couplings}
    found: list[CouplingMesh] = []
    for coupling in couplings:
        if (transmission := coupling.transmission) is not None:
            found.append((PinMesh if coupling.name in pins else CouplingMesh)(coupling, transmission))  # type: ignore[arg-type]
    return tuple(found)


def find_sizes(meshes: Iterable[GearMesh]) -> dict[str, PairSize]:
    """Return the tooth sizes of all pairs that have a declared tooth form and parallel axes, by name of the pair."""
    tips: dict[str, float] = {}
    found = {}
    for mesh in _in_order(meshes):
        if (size := mesh.size(tips)) is not None:
            found[mesh.name] = size
            for wheel, R in mesh.unit_tips.items():
                # the first pair of a wheel fixes its size in all later pairs
                tips.setdefault(wheel, R * size.scale)
    return found


def find_outlines(meshes: Sequence[GearMesh]) -> dict[str, PairOutline]:
    """Return the tooth outlines of all pairs with a declared tooth form and parallel axes, by name of the pair."""
    from geartrain.dynamics.wheel_teeth import CHORD
    from geartrain.kinematics.buildability.pitch_distances import PairOutline

    found, named = {}, {mesh.name: mesh for mesh in meshes}
    for name, size in find_sizes(meshes).items():
        mesh = named[name]
        tips = {wheel: mesh.requirement(wheel, size.scale, CHORD).tip for wheel in mesh.gear.pair}
        found[name] = PairOutline(size.distance, tips)
    return found


def _in_order(meshes: Iterable[GearMesh]) -> Iterator[GearMesh]:
    """Yield the meshes breadth-first: each, except the first of a connected set, shares a wheel with an earlier one."""
    at: dict[str, list[GearMesh]] = {}
    for mesh in (meshes := tuple(meshes)):
        for wheel in mesh.gear.pair:
            at.setdefault(wheel, []).append(mesh)
    done: set[str] = set()
    for first in meshes:
        # a new search for each connected set of pairs
        waiting = deque([first])
        while waiting:
            mesh = waiting.popleft()
            if mesh.name not in done:
                done.add(mesh.name)
                waiting.extend(each for wheel in mesh.gear.pair for each in at[wheel])
                yield mesh
