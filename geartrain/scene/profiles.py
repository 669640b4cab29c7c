"""One tooth of every wheel: that of its declared form, or a likeness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.scene import likeness
from geartrain.scene.meeting import meet
from geartrain.scene.result import Profile
from geartrain.scene.stage import Stage
from geartrain.teeth.triangular.sizes import depth

if TYPE_CHECKING:
    from geartrain.circuits import Circuit
    from geartrain.meshes import Mesh, TriangularMesh

_DIGITS = 9
_SAME = 1e-9  # of a pitch radius


@dataclass(frozen=True, slots=True)
class Drawn:
    """Teeth by wheel, names of forms by pair, and what could not be drawn."""

    profiles: Mapping[str, Profile]
    forms: Mapping[str, str]
    notices: tuple[Problem, ...] = ()


def find_profiles(stage: Stage) -> Drawn:
    """The tooth of every wheel; of several pairs with real teeth, the first one's."""
    profiles: dict[str, Profile] = {}
    notices: list[Problem] = []
    resized: list[str] = []
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    for mesh in stage.meshes:
        try:
            found = _real(stage, circuits[mesh.name], mesh, profiles)
        except GearTrainError as error:
            notices.append(_not_drawn(mesh, error.problems[0]))
            continue
        for wheel, profile in found.items():
            first = profiles.setdefault(wheel, profile)
            if first.form != profile.form:
                notices.append(_other_form(mesh, wheel, first.form))
            elif abs(_tip(first) - _tip(profile)) > _SAME:
                resized.append(mesh.name)
    if resized:
        notices.append(_resized(resized))
    for wheel in stage.train.declaration.wheels:
        if wheel not in profiles:
            profiles[wheel] = _likeness(stage, wheel)
    rounded = {wheel: _rounded(profile) for wheel, profile in profiles.items()}
    return Drawn(rounded, {mesh.name: mesh.form for mesh in stage.meshes}, tuple(notices))


def _tip(profile: Profile) -> float:
    return max(r for r, _ in profile.points)


def _real(stage: Stage, circuit: Circuit, mesh: Mesh, drawn: Mapping[str, Profile]) -> dict[str, Profile]:
    """One tooth of each wheel of a pair with real teeth, so large that they mesh where the wheels stand."""
    from geartrain.meshes import ConjugateMesh, TriangularMesh

    meeting = meet(stage, circuit)
    radii = {wheel: stage.layout.wheels[wheel].radius for wheel in circuit.wheels}
    distance = meeting.distance if meeting is not None and meeting.distance is not None else sum(radii.values())
    if isinstance(mesh, TriangularMesh):
        tips = {wheel: _tip(drawn[wheel]) * radii[wheel] for wheel in radii if wheel in drawn}
        return _triangular(mesh, distance, radii, tips)
    if not isinstance(mesh, ConjugateMesh) or mesh.law.path.pitch.bevel:
        return {}  # of bevel wheels a likeness is drawn
    from geartrain.scene.cutting import cut

    return cut(mesh, stage.train.declaration, distance, radii)


def _triangular(
    mesh: TriangularMesh, distance: float, radii: Mapping[str, float], drawn: Mapping[str, float]
) -> dict[str, Profile]:
    """Straight flanks from the bottom of a space to a point.

    distance   of the axes as placed (mm); radii, of pitch circles
    drawn      tip radii (mm) of wheels that an earlier pair has made larger or smaller: their mates make up for it
    """
    sizes = mesh.law.sizes
    wheels, scale = (mesh.driver, mesh.driven), distance / sizes.D
    tips = [R * scale for R in (sizes.R1, sizes.R2)]
    found = {}
    for at, (wheel, z, beta) in enumerate(zip(wheels, (sizes.z1, sizes.z2), (sizes.beta1, sizes.beta2), strict=True)):
        mate = wheels[1 - at]
        tip = tips[at] + (tips[1 - at] - drawn[mate] if mate in drawn and wheel not in drawn else 0.0)
        tip /= radii[wheel]
        root = tip * (1 - depth(z, beta))
        found[wheel] = Profile("triangular", ((root, -pi / z), (tip, 0.0), (root, pi / z)))
    return found


def _likeness(stage: Stage, name: str) -> Profile:
    _, wheel = stage.train.declaration.wheels[name]
    place, z = stage.layout.wheels[name], wheel.count or 1
    if wheel.internal:
        return likeness.ring(z)
    if wheel.kind == "worm":
        return likeness.worm(z, _mate_module(stage, name) / place.radius)
    return likeness.bevel(z, place.cone) if place.cone else likeness.spur(z)


def _mate_module(stage: Stage, name: str) -> float:
    for circuit in stage.train.circuits:
        if name in circuit.wheels:
            return stage.layout.wheels[circuit.wheels[1 - circuit.wheels.index(name)]].module
    return stage.layout.wheels[name].module


def _rounded(profile: Profile) -> Profile:
    """As many digits as a picture needs; profiles alike become one. Ends stay, so that teeth join without a fold."""
    points = [(_short(r), _short(angle)) for r, angle in profile.points]
    if not profile.hole:
        points[0] = points[0][0], profile.points[0][1]
        points[-1] = points[-1][0], profile.points[-1][1]
    return Profile(profile.form, tuple(points), profile.hole)


def _short(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")


def _not_drawn(mesh: Mesh, problem: Problem) -> Problem:
    what = f"the teeth of pair '{mesh.name}' are drawn as a likeness: {problem.what}"
    return Problem(what, problem.why, problem.fix, mesh.place)


def _resized(pairs: list[str]) -> Problem:
    return Problem(
        f"the teeth of {', '.join(pairs)} are drawn in other sizes than their law has",
        "a wheel with several mates has one size in a picture, and each pair's own sizes fit its mate; the motion is "
        "exact, and the teeth drawn may cut into each other or stand apart by a little",
    )


def _other_form(mesh: Mesh, wheel: str, form: str) -> Problem:
    return Problem(
        f"wheel '{wheel}' is drawn with {form} teeth, and pair '{mesh.name}' has {mesh.form} ones",
        "a wheel has one form of teeth in a picture, that of its first pair",
        "",
        mesh.place,
    )
