"""Context of a scene: a train in one state, the layout of the train, and the indices of its bodies and wheels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Literal

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.arrays import packed
from geartrain.numerics.exact import decimal, fraction_text, pi_text, touches_pi
from geartrain.numerics.quantity import turns_in
from geartrain.numerics.results import Key
from geartrain.numerics.vectors import Vector, dot, unit_or_z

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.kinematics.answer import Answer
    from geartrain.scene.layout import Layout
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import Output, StateCase

_Z: Vector = (0.0, 0.0, 1.0)
_MOST_LINKS = 100  # maximum number of links used as outputs


@dataclass(frozen=True)
class SceneContext:
    """Train in one state, with its solution and layout, and quantities that several builders of scene elements need."""

    train: GearTrain
    answer: Answer
    layout: Layout
    set_angles: Mapping[str, float] = field(default_factory=dict)
    """Starting angles of links [rad] that follow from the epoch and replace declared starting angles, by link."""

    @cached_property
    def case(self) -> StateCase:
        """Inputs and outputs that the state of the train prescribes."""
        return self.train.declaration.case(self.answer.state)

    @cached_property
    def outputs(self) -> Mapping[str, Output]:
        """Outputs declared in the state; for a train without declared outputs, the speeds of its first 100 links."""
        from geartrain.train import Output

        declared = self.train.declaration
        links = (link for link in declared.links if link != declared.frame)
        return self.case.outputs or {link: Output() for link in islice(links, _MOST_LINKS)}

    @cached_property
    def body(self) -> Mapping[str, int]:
        """Index of the body of each link, by name of the link."""
        return {link: at for at, link in enumerate(self.train.declaration.links)}

    @cached_property
    def wheel(self) -> Mapping[str, int]:
        """Index of each wheel, by name of the wheel."""
        return {wheel: at for at, wheel in enumerate(self.train.declaration.wheels)}

    @cached_property
    def driving_link(self) -> str | None:
        """Name of the first input link with a speed other than 0; None if no link is driven."""
        return next((link for link, speed in self.case.inputs.items() if speed), None)

    @cached_property
    def crank(self) -> str | None:
        """Link that is turned by hand: the declared crank or the driving link; None if it slides or neither exists."""
        link = self.train.declaration.crank or self.driving_link
        return None if link in self.train.declaration.sliding else link

    def speed(self, link: str) -> Fraction | None:
        """Return the exact speed of a link at the declared input speeds; None if the speed is not determined."""
        found = self.answer.speeds.get(link)
        return None if found is None else Fraction(found)

    def ratio(self, link: str) -> Fraction | None:
        """Return the exact speed of a link divided by that of the driving link; None if either speed is unknown."""
        found = self.speed(link)
        if found is None or self.driving_link is None:
            return None
        return found / self.case.inputs[self.driving_link]

    def shown(self, speed: Fraction | None, link: str) -> str | None:
        """Return the speed of a link as text, exact if the inputs are exact, with a unit if it slides."""
        if speed is None:
            return None
        text = pi_text(speed) if touches_pi(speed) else self.case.shown(speed)
        return text + self._unit(link)

    def rounded(self, speed: Fraction | None, link: str) -> str:
        """Return the speed of a link as a decimal in text form, with a unit if it slides; empty for None."""
        return "" if speed is None else decimal(speed) + self._unit(link)

    def _unit(self, link: str) -> str:
        return " mm" if link in self.train.kinematics.tree.lines else ""

    def sense(self, link: str) -> int:
        """Return -1 if a link's axis is opposite to the reference direction of the axes parallel to it, 1 if not."""
        return self.train.kinematics.signs.get(link, 1)

    def start(self, link: str) -> float:
        """Return the starting angle of a link [rad], which follows from the epoch or is declared; 0 by default."""
        angle = self.train.declaration.links[link].angle
        return self.set_angles.get(link, 0.0 if angle is None else angle.si)

    def along(self, axis: str | None) -> Vector:
        """Return the declared unit direction of an axis; z if the axis is None or not in the layout."""
        place = self.layout.axes.get(axis or "")
        return _Z if place is None else unit_or_z(place.direction)

    def line(self, axis: str) -> Vector:
        """Return the unit direction in which links slide on an axis: declared, along a screw, down a drum, or x."""
        declared = self.train.declaration.axes.get(axis)
        if declared is not None and "direction" in declared.model_fields_set:
            return self.reference(axis)
        seen_from = self.train.kinematics.tree.axis_seen_from
        screws = (each for each in self.train.circuits if each.kind == "screw")
        found = (seen_from(each.carrier, each.j) for each in screws if seen_from(each.carrier, each.i) == axis)
        screw = next(found, None)
        if screw is not None:
            return self.reference(screw)
        from geartrain.teeth.couplings.travel import Drum

        tree = self.train.kinematics.tree
        drums = (each for each in self.train.declaration.couplings if isinstance(each, Drum))
        drum = next((each for each in drums if tree.axis(each.slides) == axis), None)
        if drum is None or abs(self.reference(tree.axis(drum.turns))[1]) > 0.5:  # an axis that is not horizontal
            return (1.0, 0.0, 0.0)
        return (0.0, 1.0 if (self.speed(drum.slides) or 0) < 0 else -1.0, 0.0)

    def reference(self, axis: str | None) -> Vector:
        """Return the unit direction of an axis, reversed if it is opposite to z or to the first axis parallel to it."""
        own = self.along(axis)
        # the frame (z) first, so that signs are relative to it where possible
        for label in (None, *self.train.declaration.axes):
            first = self.along(label)
            # the cosine of parallel directions is 1 except for rounding errors
            if abs(dot(first, own)) > 1 - 1e-9:
                return own if dot(first, own) > 0 else (-own[0], -own[1], -own[2])
        return own

    @cached_property
    def step(self) -> Fraction:
        """Turns of the driving link per time unit of the input (one minute for `100 rpm`); 1 if no link is driven."""
        if self.driving_link is None:
            return Fraction(1)
        declared = self.train.declaration
        turns = Fraction(1) if declared.unit is not None else turns_in(declared.input_unit)
        return self.case.inputs[self.driving_link] * turns

    @cached_property
    def meshes(self) -> tuple[GearMesh, ...]:
        """Gear pairs with their computed tooth geometry; empty if the geometry cannot be computed (see `unbuilt`)."""
        return self._built[0]

    @property
    def unbuilt(self) -> tuple[Problem, ...]:
        """Reasons why the tooth geometry cannot be computed; empty if it can be computed."""
        return self._built[1]

    @cached_property
    def _built(self) -> tuple[tuple[GearMesh, ...], tuple[Problem, ...]]:
        try:
            return self.train.mechanics.meshes_in(self.answer.state), ()
        except GearTrainError as error:
            return (), error.problems

    @cached_property
    def near(self) -> Vector:
        """Unit vector along z towards the viewer."""
        return (0.0, 0.0, float(self.layout.front))


def exact(value: Fraction | None) -> str | None:
    """Return a ratio as exact text, such as `-254/19`; None if the ratio is None."""
    return None if value is None else fraction_text(value)


def packed_key(name: str, kind: Literal["<f8", "<f4", "<u4"] = "<f8") -> Key:
    """Return the JSON key of an array attribute that is written as base64 text of little-endian numbers."""
    return Key(name, ".", to=lambda result: packed(getattr(result, name), kind))
