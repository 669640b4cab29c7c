"""From a declared train to its real teeth: every gear pair with a tooth form, every pin whose dimensions are known.

How large real teeth are, and how far apart their axes want to stand, where only their shape is declared.

Triangular teeth have sizes up to a scale, and a wheel with several mates has one size: from the first pair of wheels
that hang together the others follow, each at the distance its own law asks for.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.teeth import ConjugateForm, Ideal, Triangular
from geartrain.teeth.conjugate import conjugate_mesh as conjugate
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
from geartrain.teeth.conjugate.conjugate_mesh import IDEAL, ConjugateMesh
from geartrain.teeth.gear_mesh import GearMesh, MeshDriver
from geartrain.teeth.triangular.triangular_form import TRIANGULAR_SCOPE, refusal
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.train import GearPair, Train, Wheel

if TYPE_CHECKING:
    from geartrain.teeth.pin_coupling import Coupling
    from geartrain.teeth.pin_transmission import PinToSlotTransmission, SlotToPinTransmission


ShaftAngle = Callable[[GearPair], float | None]
"""The angle (rad) under which the axes of a pair meet; None where they are parallel."""

_CONTRATE = "the contrate is taken for a spur wheel"


@dataclass(frozen=True)
class PinMesh:
    """A coupling whose dimensions are declared, with its law."""

    coupling: Coupling
    law: PinToSlotTransmission

    @property
    def reversed(self) -> SlotToPinTransmission:
        """The law with the slot driving, which no follower can."""
        from geartrain.teeth.pin_transmission import SlotToPinTransmission

        return SlotToPinTransmission(self.law.r, self.law.e, self.law.friction)


@dataclass(frozen=True)
class _Found:
    """A gear pair that is to have real teeth, with what its law hangs on."""

    train: Train
    gear: GearPair
    place: str

    @cached_property
    def wheels(self) -> tuple[Wheel, Wheel]:
        first, second = (self.train.wheels[name][1] for name in self.gear.pair)
        return first, second

    @property
    def kinds(self) -> tuple[str, str]:
        first, second = self.wheels
        return first.kind, second.kind

    @property
    def internal(self) -> tuple[bool, bool]:
        first, second = self.wheels
        return first.internal, second.internal

    @property
    def counts(self) -> tuple[int, int]:
        first, second = self.wheels
        return first.count or 0, second.count or 0

    @property
    def friction(self) -> float | None:
        rubbing = self.gear.friction or self.train.friction
        return None if rubbing is None else float(rubbing.value)

    @property
    def driver(self) -> MeshDriver:
        return MeshDriver(self.gear.pair[0], "", False)

    @property
    def note(self) -> str:
        return _CONTRATE if "contrate" in self.kinds else ""

    @cached_property
    def distance(self) -> float | None:
        """Half the modules times the teeth, summed (m); None unless both wheels declare a module with a unit."""
        halves = list(self._halves())
        return sum(halves) if len(halves) == 2 else None

    def _halves(self) -> Iterator[float]:
        for wheel in self.wheels:
            if wheel.module is not None and wheel.module.unit is not None and wheel.count is not None:
                yield wheel.module.si * wheel.count / 2


def find_meshes(train: Train, shaft_angle: ShaftAngle = lambda _: None) -> tuple[GearMesh, ...]:
    """Every gear pair with real teeth, whoever drives: for now the first wheel does, till `Mesh.driven_by` says better.

    Raises `GearTrainError` with all pairs whose teeth cannot be built.

    shaft_angle   of a pair; asked only where teeth hang on it
    """
    forms = [gear.tooth_form or train.tooth_form for gear in train.gears]
    if all(form is None or isinstance(form, Ideal) for form in forms):
        return ()
    meshes: list[GearMesh] = []
    problems: list[Problem] = []
    for at, (gear, form) in enumerate(zip(train.gears, forms, strict=True)):
        found = _Found(train, gear, train.place("gears", at))
        try:
            match form:
                case Triangular():
                    meshes.append(_triangular(found, form))
                case ConjugateToothForm():
                    meshes.append(_conjugate(found, form, shaft_angle))
        except GearTrainError as error:
            problems += [_placed(problem, found) for problem in error.problems]
    if problems:
        raise GearTrainError(problems)
    return tuple(meshes)


def find_pins(train: Train) -> tuple[PinMesh, ...]:
    """Every coupling whose dimensions are declared."""
    return tuple(
        PinMesh(coupling, coupling.law) for coupling in train.couplings if coupling.pin_radius and coupling.law
    )


def _placed(problem: Problem, found: _Found) -> Problem:
    return replace(problem, what=f"pair '{found.gear.name}': {problem.what}", place=found.place)


def _triangular(found: _Found, form: Triangular) -> GearMesh:
    if why := refusal(found.kinds, any(found.internal)):
        raise GearTrainError(Problem("it cannot have triangular teeth", why, f"{TRIANGULAR_SCOPE}; {IDEAL}"))
    law = form.law(*found.counts, found.friction or 0.0, pitch_distance=found.distance)
    return TriangularMesh(found.gear, form.form, found.driver, found.place, law, found.friction, found.note)


def _conjugate(found: _Found, form: ConjugateForm, shaft_angle: ShaftAngle) -> GearMesh:
    if why := conjugate.refusal(found.kinds):
        raise GearTrainError(Problem(f"it cannot have {_words(form)} teeth", why, IDEAL))
    ring_first = found.internal[0]
    if ring_first:
        conjugate.check_order(form, found.gear.pair)
    counts = found.counts[::-1] if ring_first else found.counts
    law = form.law(
        *counts,
        found.friction or 0.0,
        2 if ring_first else 1,
        pitch_distance=found.distance,
        internal=any(found.internal),
        shaft_angle=_meeting(found, form, shaft_angle),
    )
    mesh = ConjugateMesh(found.gear, form.form, found.driver, found.place, law, found.friction, found.note, ring_first)
    if not mesh.rigid:
        _ = mesh.faults  # teeth too far apart to touch raise: here, the pair is named
    return mesh


def _meeting(found: _Found, form: ConjugateForm, shaft_angle: ShaftAngle) -> float | None:
    """The shaft angle of a bevel pair; None for wheels that mesh as spur wheels do."""
    if "contrate" in found.kinds:
        return None
    angle = shaft_angle(found.gear)
    if angle is None and "bevel" in found.kinds:
        fix = f"declare `axes` with the `direction` of both, or {IDEAL}"
        raise GearTrainError(
            Problem(f"it cannot have {_words(form)} teeth", "nothing says how the axes of its bevels meet", fix)
        )
    return angle


def _words(form: ConjugateForm) -> str:
    return form.form.replace("_", " ")


@dataclass(frozen=True, slots=True)
class PairSize:
    """Of a pair with real teeth.

    scale      modules in one unit of its law's lengths
    distance   of its axes, in modules
    stretch    that distance over the one at which pitch circles touch
    """

    scale: float
    distance: float
    stretch: float


def find_sizes(train: Train, meshes: Iterable[GearMesh]) -> dict[str, PairSize]:
    """The sizes of all pairs with real teeth and parallel axes, by name."""
    tips: dict[str, float] = {}
    found = {}
    for mesh in _in_order(meshes):
        if isinstance(mesh, TriangularMesh):
            found[mesh.name] = _triangular_size(train, mesh, tips)
        elif isinstance(mesh, ConjugateMesh) and not mesh.law.path.pitch.bevel:
            pitch = mesh.law.path.pitch
            distance = float(getattr(mesh.law, "distance", abs(pitch.R1 + pitch.R2)))
            found[mesh.name] = PairSize(1.0, distance, distance / _touching(train, mesh))
    return found


def _in_order(meshes: Iterable[GearMesh]) -> Iterator[GearMesh]:
    """Pairs one after another such that, where they hang together, each shares a wheel with one before it."""
    at: dict[str, list[GearMesh]] = {}
    for mesh in (meshes := tuple(meshes)):
        for wheel in mesh.gear.pair:
            at.setdefault(wheel, []).append(mesh)
    done: set[str] = set()
    for first in meshes:
        waiting = deque([first])
        while waiting:
            mesh = waiting.popleft()
            if mesh.name not in done:
                done.add(mesh.name)
                waiting.extend(each for wheel in mesh.gear.pair for each in at[wheel])
                yield mesh


def _touching(train: Train, mesh: GearMesh) -> float:
    """The distance (modules) at which pitch circles touch."""
    (z1, ring1), (z2, ring2) = (
        (wheel.count or 0, wheel.internal) for _, wheel in (train.wheels[name] for name in mesh.gear.pair)
    )
    return abs(z1 - z2) / 2 if ring1 or ring2 else (z1 + z2) / 2


def _triangular_size(train: Train, mesh: TriangularMesh, tips: dict[str, float]) -> PairSize:
    """As large as its wheel that has a size already; else as lengths declare it, or so that pitch circles touch."""
    sizes, touching = mesh.law.sizes, _touching(train, mesh)
    own = {mesh.driver: sizes.R1, mesh.driven: sizes.R2}
    form = mesh.gear.tooth_form or train.tooth_form
    module = _module(train, mesh)
    scale = touching / sizes.D
    if module is not None and _has_lengths(form):
        scale = 1 / module
    scale = next((tips[wheel] / R for wheel, R in own.items() if wheel in tips), scale)
    for wheel, R in own.items():
        tips.setdefault(wheel, R * scale)
    return PairSize(scale, sizes.D * scale, sizes.D * scale / touching)


def _has_lengths(form: object) -> bool:
    """True for teeth declared in units of length."""
    if not isinstance(form, Triangular):
        return False
    radii = () if isinstance(form.radii, str) else form.radii
    return any(length is not None and length.unit for length in (form.centre_distance, form.backlash, *radii))


def _module(train: Train, mesh: GearMesh) -> float | None:
    """Mean module (m) of the wheels of a pair; None unless both declare one with a unit."""
    wheels = [train.wheels[name][1] for name in mesh.gear.pair]
    sizes = [wheel.module.si * (wheel.count or 0) for wheel in wheels if wheel.module and wheel.module.unit]
    return sum(sizes) / sum(wheel.count or 0 for wheel in wheels) if len(sizes) == 2 else None
