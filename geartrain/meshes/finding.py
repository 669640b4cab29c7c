"""From a declared train to its real teeth: every gear pair with a tooth form, every pin whose dimensions are known."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.meshes import conjugate
from geartrain.meshes.conjugate import IDEAL, ConjugateMesh
from geartrain.meshes.mesh import Driver, Mesh
from geartrain.meshes.triangular import TriangularMesh
from geartrain.teeth import ConjugateForm, Ideal, Triangular
from geartrain.teeth.shape import Shape
from geartrain.teeth.triangular.form import COVERS, refusal
from geartrain.train import GearPair, Train, Wheel

if TYPE_CHECKING:
    from geartrain.pins import Coupling
    from geartrain.pins.laws import BackLaw, SlotLaw

ShaftAngle = Callable[[GearPair], float | None]
"""The angle (rad) under which the axes of a pair meet; None where they are parallel."""

_CONTRATE = "the contrate is taken for a spur wheel"


@dataclass(frozen=True)
class PinJoint:
    """A coupling whose dimensions are declared, with its law."""

    coupling: Coupling
    law: SlotLaw

    @property
    def reversed(self) -> BackLaw:
        """The law with the slot driving, which no follower can."""
        from geartrain.pins.laws import BackLaw

        return BackLaw(self.law.r, self.law.e, self.law.friction)


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
    def driver(self) -> Driver:
        return Driver(self.gear.pair[0], "", False)

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


def find_meshes(train: Train, shaft_angle: ShaftAngle = lambda _: None) -> tuple[Mesh, ...]:
    """Every gear pair with real teeth, whoever drives: for now the first wheel does, till `Mesh.driven_by` says better.

    Raises `GearTrainError` with all pairs whose teeth cannot be built.

    shaft_angle   of a pair; asked only where teeth hang on it
    """
    forms = [gear.tooth_form or train.tooth_form for gear in train.gears]
    if all(form is None or isinstance(form, Ideal) for form in forms):
        return ()
    meshes: list[Mesh] = []
    problems: list[Problem] = []
    for at, (gear, form) in enumerate(zip(train.gears, forms, strict=True)):
        found = _Found(train, gear, train.place("gears", at))
        try:
            match form:
                case Triangular():
                    meshes.append(_triangular(found, form))
                case Shape():
                    meshes.append(_conjugate(found, form, shaft_angle))
        except GearTrainError as error:
            problems += [_placed(problem, found) for problem in error.problems]
    if problems:
        raise GearTrainError(problems)
    return tuple(meshes)


def find_pins(train: Train) -> tuple[PinJoint, ...]:
    """Every coupling whose dimensions are declared."""
    return tuple(
        PinJoint(coupling, coupling.law) for coupling in train.couplings if coupling.pin_radius and coupling.law
    )


def _placed(problem: Problem, found: _Found) -> Problem:
    return replace(problem, what=f"pair '{found.gear.name}': {problem.what}", place=found.place)


def _triangular(found: _Found, form: Triangular) -> Mesh:
    if why := refusal(found.kinds, any(found.internal)):
        raise GearTrainError(Problem("it cannot have triangular teeth", why, f"{COVERS}; {IDEAL}"))
    law = form.law(*found.counts, found.friction or 0.0, pitch_distance=found.distance)
    return TriangularMesh(found.gear, form.form, found.driver, found.place, law, found.friction, found.note)


def _conjugate(found: _Found, form: ConjugateForm, shaft_angle: ShaftAngle) -> Mesh:
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
