"""The flat shape of every wheel: its own teeth where a form is declared, else involutes that mesh with its mates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.export.making import Making, bores
from geartrain.outlines import Contour, Cut, Pins, Wheel, outline

if TYPE_CHECKING:
    from geartrain.analysis import GearTrain
    from geartrain.layout import Layout, WheelPlace
    from geartrain.meshes import Mesh
    from geartrain.teeth.conjugate import Pair
    from geartrain.teeth.shape import Shape

LIKENESS = "involute, 20 degrees (no form is declared)"
_PLAY = 0.05  # modules, of teeth whose form is not declared
_ADDENDA = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)  # modules: the tallest that run are taken
_DEDENDUM = 1.25
_SAME = 1e-3  # of a size: teeth that differ by less are alike
_LAND = 0.8  # of the root circle: the widest bore


@dataclass(frozen=True, slots=True)
class Blank:
    """A wheel to cut: its axle at the origin, its first tooth on the x axis; lengths in mm.

    kind       external, ring or pins
    form       of its teeth, in words
    contours   the outer one first, then holes
    """

    wheel: str
    link: str
    teeth: int
    kind: str
    form: str
    contours: tuple[Contour, ...]
    module: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    thickness: float
    bore: float


@dataclass(frozen=True, slots=True)
class Blanks:
    """Every wheel that can be cut flat, by id, and why the others cannot."""

    wheels: Mapping[str, Blank]
    notices: tuple[Problem, ...]


def find_blanks(train: GearTrain, layout: Layout, making: Making) -> Blanks:
    """The flat shapes of all wheels of a train, at the sizes of a layout."""
    return _Workshop(train, layout, making).all()


def _two_shapes(wheel: str, first: Mesh, other: Mesh) -> Problem:
    return Problem(
        f"wheel '{wheel}' has the teeth of pair '{first.gear.name}' only",
        f"pair '{other.gear.name}' gives it others, and a wheel is cut once",
        "declare one form for both, or try whether they run",
    )


def _area(contour: Contour) -> float:
    x, y = contour.points.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


class _Workshop:
    def __init__(self, train: GearTrain, layout: Layout, making: Making) -> None:
        self.declared, self.layout, self.making = train.declaration, layout, making
        self.bores = bores(layout, making)
        self.meshes: dict[str, Mesh] = {}
        self.notices: list[Problem] = []
        try:
            meshes = train.meshes
        except GearTrainError as error:
            self.notices += error.problems
            meshes = ()
        self.mates: dict[str, list[str]] = {name: [] for name in self.declared.wheels}
        for gear in self.declared.gears:
            first, second = gear.pair
            self.mates[first].append(second)
            self.mates[second].append(first)
        # a crown wheel is taken for a spur wheel only where nothing better is to be had
        for mesh in sorted(meshes, key=lambda mesh: len({self._kind(wheel) for wheel in mesh.gear.pair})):
            for wheel in mesh.gear.pair:
                known = self.meshes.setdefault(wheel, mesh)
                if mesh is not known and self._other_teeth(wheel, known, mesh):
                    self.notices.append(_two_shapes(wheel, known, mesh))

    def _other_teeth(self, name: str, mesh: Mesh, other: Mesh) -> bool:
        """True if two pairs ask for different teeth of one wheel: in form, height or breadth."""
        if mesh.form != other.form or mesh.form == "triangular":
            return mesh.form != other.form or self._blade(name, mesh) != self._blade(name, other)
        try:
            one, two = (self._declared(name, each) for each in (mesh, other))
        except GearTrainError:
            return False  # its fault is told where it is cut
        sizes = [(each.tip_radius, each.root_radius, *(_area(c) for c in each.contours)) for each in (one, two)]
        pairs = zip(*sizes, strict=True) if len(sizes[0]) == len(sizes[1]) else [(0.0, 1.0)]
        return any(abs(a - b) > _SAME * max(abs(a), 1.0) for a, b in pairs)

    def _blade(self, name: str, mesh: Mesh) -> tuple[float, float]:
        """Tip radius (mm) and half angle (rad) of a wheel of triangular teeth."""
        sizes = mesh.law.sizes  # type: ignore[attr-defined]
        scale = sum(self.layout.wheels[each].radius for each in mesh.gear.pair) / sizes.D
        R, beta = (sizes.R1, sizes.beta1) if name == mesh.driver else (sizes.R2, sizes.beta2)
        return round(R * scale, 3), round(beta, 9)

    def _kind(self, name: str) -> str:
        return self.declared.wheels[name][1].kind

    def _kinds(self, name: str) -> set[str]:
        return {self._kind(mate) for mate in self.mates[name]}

    def _flat_mates(self, name: str) -> list[str]:
        """Mates without a form of their own, in one plane with the wheel."""
        return [mate for mate in self.mates[name] if mate not in self.meshes and self._kind(mate) == "spur"]

    def all(self) -> Blanks:
        found = {}
        for name, place in self.layout.wheels.items():
            try:
                found[name] = self.one(name, place)
            except GearTrainError as error:
                self.notices += (
                    replace(each, what=f"wheel '{name}': {each.what}", place="") for each in error.problems
                )
        return Blanks(found, tuple(self.notices))

    def one(self, name: str, place: WheelPlace) -> Blank:
        link, wheel = self.declared.wheels[name]
        if place.cone or wheel.kind != "spur" or "worm" in self._kinds(name):
            kind = wheel.kind if wheel.kind != "spur" else "bevel" if place.cone else "worm's wheel"
            why = "its teeth do not stand straight in a plane"
            raise GearTrainError(Problem(f"a {kind} has no flat outline", why, "take the solid for a likeness"))
        mesh = self.meshes.get(name)
        if mesh is None:
            shape, form = self._likeness(name), LIKENESS
        elif mesh.form == "triangular":
            return self._bored(self._triangular(name, mesh), place)
        else:
            shape, form = self._declared(name, mesh), mesh.form.replace("_", " ")
        scale = place.module
        blank = Blank(
            name,
            link,
            wheel.count or 0,
            shape.kind,
            form,
            tuple(each.scaled(scale) for each in shape.contours),
            scale,
            shape.pitch_radius * scale,
            shape.tip_radius * scale,
            shape.root_radius * scale,
            place.thickness,
            0.0,
        )
        return self._bored(blank, place)

    def _bored(self, blank: Blank, place: WheelPlace) -> Blank:
        """With the hole for its arbor, if it has the room."""
        bore = self.bores.get(place.axis, 0.0)
        inner = min(blank.root_radius, blank.tip_radius)
        if not bore or blank.kind == "ring":
            return blank
        if bore / 2 >= _LAND * inner:
            what = f"wheel '{blank.wheel}': a bore of {bore:g} mm does not fit"
            why = f"its root circle has a diameter of {2 * inner:.4g} mm, so it is cut without a hole"
            self.notices.append(Problem(what, why, f"give less than {2 * _LAND * inner:.4g} mm", "--bore"))
            return blank
        return replace(blank, contours=(*blank.contours, Contour.circle(bore / 2)), bore=bore)

    # -------------------------------------------------------------------------------------------------- declared forms

    def _triangular(self, name: str, mesh: Mesh) -> Blank:
        """The polygon of triangular teeth, so large that the pair's distance is that of its pitch circles."""
        sizes = mesh.law.sizes  # type: ignore[attr-defined]
        first = name == mesh.driver
        R, z, beta = (sizes.R1, sizes.z1, sizes.beta1) if first else (sizes.R2, sizes.z2, sizes.beta2)
        scale = sum(self.layout.wheels[each].radius for each in mesh.gear.pair) / sizes.D
        tip, root = R * scale, R * scale * sin(beta) / sin(beta + pi / z)
        vertices = [
            (radius * cos(turn), radius * sin(turn), 0.0)
            for k in range(z)
            for radius, turn in ((tip, 2 * pi * k / z), (root, (2 * k + 1) * pi / z))
        ]
        place = self.layout.wheels[name]
        return Blank(
            *(name, place.link, z, "external", mesh.form, (Contour.of(vertices),), place.module, place.radius),
            *(tip, root, place.thickness, 0.0),
        )

    def _declared(self, name: str, mesh: Mesh) -> Wheel:
        """Conjugate teeth, in modules."""
        from geartrain.meshes import ConjugateMesh

        assert isinstance(mesh, ConjugateMesh)
        form = mesh.gear.tooth_form or self.declared.tooth_form
        gear = mesh.wheels.index(name) + 1
        return _outline(mesh.law.pair, gear, _pins(form, mesh.law.pair), _free(form, mesh.law.pair, gear))

    # ------------------------------------------------------------------------------------------------------- likenesses

    def _likeness(self, name: str) -> Wheel:
        """An involute wheel, in modules, its teeth no taller than run with any mate that has no form either."""
        own, mate = self._addendum(name), (self._flat_mates(name) or [name])[0]
        first, second = self._turned(name, mate)
        pair, model = self._pair(first, second, own, self._addendum(mate))
        return _outline(pair, 2 if first != name else 1, None, _free(model, pair, 2 if first != name else 1))

    def _addendum(self, name: str) -> float:
        """The tallest addendum (modules) with which the wheel runs with each of its mates."""
        least = _ADDENDA[0]
        for mate in self._flat_mates(name) or [name]:
            least = min(least, self._tallest(*self._turned(name, mate)))
        return least

    def _tallest(self, first: str, second: str) -> float:
        for height in _ADDENDA:
            pair, _ = self._pair(first, second, height, height)
            if not pair.faults:
                return height
        return _ADDENDA[-1]

    def _turned(self, name: str, mate: str) -> tuple[str, str]:
        """The two wheels, a ring last."""
        return (mate, name) if self.declared.wheels[name][1].internal else (name, mate)

    def _pair(self, first: str, second: str, *addenda: float) -> tuple[Pair, Shape]:
        wheels = [self.declared.wheels[each][1] for each in (first, second)]
        module = self.layout.wheels[first].module
        play = _PLAY if self.making.backlash is None else self.making.backlash / module
        return _involute(wheels[0].count or 0, wheels[1].count or 0, wheels[1].internal, addenda, play)


@lru_cache(maxsize=4096)
def _involute(z1: int, z2: int, internal: bool, addenda: tuple[float, ...], play: float) -> tuple[Pair, Shape]:
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.shape import Wheels, paired

    model = Involute.model_validate(
        {"form": "involute", "addendum": [f"{a:g}" for a in addenda], "dedendum": _DEDENDUM, "backlash": f"{play:.9f}"}
    )
    return paired(model, Wheels(z1, z2, internal)), model


@lru_cache(maxsize=4096)
def _outline(pair: Pair, gear: int, pins: Pins | None, clearance: float | None) -> Wheel:
    return outline(pair, gear, Cut(1.0, clearance, tolerance=1e-3), pins)


def _free(form: object, pair: Pair, gear: int) -> float | None:
    """What an involute's dedendum leaves under the mate's tip (modules); None, the usual, for other forms."""
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.shape import Wheels

    if not isinstance(form, Involute):
        return None
    pitch = pair.path.pitch
    found = form.involutes(Wheels(pitch.z1, pitch.z2, pitch.R2 < 0))
    own, mate = (found.first, found.second) if gear == 1 else (found.second, found.first)
    if not found.second.ring:
        return max(found.distance - mate.tip - own.root, 0.0)
    ring, pinion = (own, mate) if gear == 2 else (mate, own)
    free = ring.root - pinion.tip if gear == 2 else ring.tip - pinion.root
    return max(free - found.distance, 0.0)


def _pins(form: object, pair: Pair) -> Pins | None:
    from geartrain.teeth.lantern import Lantern
    from geartrain.teeth.shape import Wheels

    if not isinstance(form, Lantern):
        return None
    pitch = pair.path.pitch
    wheels = Wheels(pitch.z1, pitch.z2, pitch.R2 < 0)
    z = pitch.z1 if form.pins == 1 else pitch.z2
    radius = z / 2 if form.pin_radius is None else wheels.modules(form.pin_radius, "pin_radius")
    return Pins(form.pins, radius, wheels.modules(form.pin_diameter, "pin_diameter") / 2)
