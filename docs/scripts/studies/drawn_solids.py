"""How far teeth run into each other as the viewer draws them: its own triangles in its own poses, by manifold3d.

Everything is read out of the page in a browser: the shapes it casts, and the matrices by which it turns them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import manifold3d
import numpy as np

from geartrain.scene import Scene
from geartrain.scene.elements import SceneCoupling, ScenePair, ScenePart, SceneWheel
from geartrain.viewer import page
from studies.tooth_solids import BentTeeth, DrawnTooth, Floats, about_z

if TYPE_CHECKING:
    from playwright.sync_api import Browser

# of each wheel what the viewer casts as teeth: shapes in the wheel's frame, where that stands, and how many copies
SHAPES = """(() => {
  const [{ world }] = globalThis["geartrain"].stages;
  const many = world.scene.wheels.reduce((sum, { teeth }) => sum + teeth, 0);
  return world.wheels.map((part) => {
    const found = [];
    const add = ({ points }, { elements }, slot, count = 1) => found.push({ points, elements, count });
    if (part.wheel.kind === "worm") part.castBody((shape, matrix) => add(shape, matrix, null, part.wheel.teeth));
    else part.castTeeth(add, many);
    return found;
  });
})()"""
# where all bodies stand after each of some exact numbers of turns of the lead: matrices, column by column
POSES = """((asked) => {
  const { machines: [machine], stages: [{ world: { poses } }] } = globalThis["geartrain"];
  const before = machine.turns;
  const found = asked.map((turns) => {
    machine.turns = before.constructor.of(turns);
    const array = new Float64Array(16 * poses.bodies.length);
    poses.turn(array);
    return [...array];
  });
  machine.turns = before;
  return found;
})"""
# corners of the teeth of thin wheels as they are bent in the picture after each of some turns, by wave, of their body
BENT = """((asked) => {
  const { machines: [machine], stages: [{ world }] } = globalThis["geartrain"];
  const before = machine.turns;
  const found = asked.map((turns) => {
    machine.turns = before.constructor.of(turns);
    world.turn();
    return world.scene.waves.map(({ wheel }) => {
      const { parts, geometry } = world.castings[1];
      const { first, last } = parts.find(({ slot }) => slot === world.wheels[wheel].toothed);
      return [...geometry.attributes.position.array.slice(3 * first, 3 * last)];
    });
  });
  machine.turns = before;
  world.turn();
  return found;
})"""
PATIENCE = 90_000  # ms: software draws slowly on a busy machine


@dataclass(frozen=True)
class DrawnTeeth:
    """The teeth of all wheels of a scene as a page draws them."""

    scene: Scene
    wheels: Sequence[DrawnTooth | None]
    poses: Callable[[Sequence[str]], Any]
    bends: Callable[[Sequence[str]], Any]

    def bent(self, turns: Sequence[Fraction]) -> list[dict[int, BentTeeth]]:
        """Teeth of thin wheels by wheel after each of some turns of the lead, as waves bend them."""
        waves = self.scene.waves
        if not waves:
            return [{} for _ in turns]
        return [
            {
                wave.wheel: BentTeeth(self.scene.wheels[wave.wheel], np.array(points))
                for wave, points in zip(waves, pose, strict=True)
            }
            for pose in self.bends([str(each) for each in turns])
        ]

    def matrices(self, turns: Sequence[Fraction]) -> Floats:
        """Of all bodies after each of some turns of the lead, as numbers (turns, bodies, 4, 4)."""
        found = np.array(self.poses([str(each) for each in turns]))
        return np.asarray(found.reshape(len(turns), -1, 4, 4).swapaxes(2, 3))

    def common(
        self, pair: ScenePair, bodies: Floats, ahead: float = 0.0, bent: Mapping[int, BentTeeth] | None = None
    ) -> float:
        """What teeth of both wheels have in common, over the volume of the smaller tooth.

        bodies   where bodies stand, of one pose; `bent`, thin wheels in that
        ahead    pitches by which the second wheel is turned beyond that
        """
        first, second = ((bent or {}).get(at, self.wheels[at]) for at in pair.wheels)
        if first is None or second is None:
            raise ValueError(f"'{pair.id}' has a wheel that is drawn without teeth")
        here, there = (bodies[self.scene.wheels[at].body] for at in pair.wheels)
        stands = first.standing(here), second.standing(there, ahead)
        middles = [tooth.middles(each) for tooth, each in zip((first, second), stands, strict=True)]
        apart = np.linalg.norm(middles[0][:, None] - middles[1], axis=2)
        shared = sum(
            float((first.placed(stands[0], one) ^ second.placed(stands[1], other)).volume())
            for one, other in np.argwhere(apart < first.reach + second.reach)
        )
        shared += self._in_pins(pair.wheels, (first, second), stands, bodies, (0.0, ahead))
        return shared / min(first.volume, second.volume)

    def _in_pins(
        self,
        wheels: tuple[int, int],
        teeth: Sequence[DrawnTooth | BentTeeth],
        stands: Sequence[Floats],
        bodies: Floats,
        ahead: Sequence[float],
    ) -> float:
        """What teeth have in common with pins that stand in their mate, parts of their own (mm3)."""
        shared = 0.0
        for at, index in enumerate(wheels):
            ring, tooth, places = self.scene.wheels[index], teeth[1 - at], stands[1 - at]
            middles = tooth.middles(places)
            for pin in (part for name, part in self.parts.items() if name.startswith(f"{ring.id} pin ")):
                turned = _about(np.array(ring.centre), pin, 2 * pi * ahead[at] / ring.teeth)
                stand = bodies[ring.body] @ turned @ _frame(pin)
                solid = _turned(pin).transform(stand[:3])
                low, high, radius, _ = pin.bands[0]
                middle, reach = stand[:3] @ [0, 0, (low + high) / 2, 1], np.hypot((high - low) / 2, radius)
                near = np.linalg.norm(middles - middle, axis=1) < tooth.reach + reach
                shared += sum(float((tooth.placed(places, int(at)) ^ solid).volume()) for at in np.flatnonzero(near))
        return shared

    def in_slot(self, coupling: SceneCoupling, bodies: Floats, aside: float = 0.0) -> float:
        """What a pin and the plate with its slot have in common, over the pin's part in the plate.

        aside   by how much (mm, of the nearest that the pin comes) the plate is turned beyond where it stands
        """
        turned = aside / abs(coupling.pin_radius - coupling.offset)
        pin, slot = (self.parts[f"{coupling.id} {kind}"] for kind in ("pin", "slot"))
        stand = bodies[coupling.slot] @ _about(np.array(coupling.slot_at), slot, turned) @ _frame(slot)
        cylinder = _turned(pin).transform((bodies[coupling.pin] @ _frame(pin))[:3])
        shared: float = (cylinder ^ _plate(slot).transform(stand[:3])).volume()
        return shared / (slot.height * pi * pin.bands[0][2] ** 2)

    def in_holes(self, coupling: SceneCoupling, bodies: Floats, aside: float = 0.0) -> float:
        """What pins and the wheel in whose holes or slot they move have in common, over the part of one pin in it.

        aside   by how much (mm, at the pins' circle) the wheel is turned beyond where it stands
        """
        wheel, pins = self.holed[coupling.id]
        x = np.cos(wheel.turn) * np.array(wheel.reference)
        x = x + np.sin(wheel.turn) * np.cross(wheel.direction, wheel.reference)
        own = np.eye(4)
        own[:3] = np.column_stack([x, np.cross(wheel.direction, x), wheel.direction, wheel.centre])
        stand = bodies[wheel.body] @ own @ about_z(aside / coupling.pin_radius)
        lines = [np.array(line).reshape(-1, 2) for line in wheel.holes]
        disc = manifold3d.Manifold.cylinder(wheel.thickness, wheel.root, wheel.root, 256, center=True)
        for line in lines:
            hole = manifold3d.CrossSection([line], manifold3d.FillRule.NonZero)
            disc -= manifold3d.Manifold.extrude(hole, 2 * wheel.thickness).translate((0, 0, -wheel.thickness))
        disc = disc.transform(stand[:3])
        shared = sum((_turned(pin).transform((bodies[coupling.pin] @ _frame(pin))[:3]) ^ disc).volume() for pin in pins)
        return float(shared) / (wheel.thickness * pi * pins[0].bands[0][2] ** 2)

    @cached_property
    def holed(self) -> dict[str, tuple[SceneWheel, list[ScenePart]]]:
        """Of couplings whose slot or holes are cut into a wheel: that wheel, and the pins."""
        found = {}
        for each in self.scene.couplings:
            wheels = [wheel for wheel in self.scene.wheels if wheel.body == each.slot and wheel.holes]
            pins = [
                part
                for name, part in self.parts.items()
                if name == f"{each.id} pin" or name.startswith(f"{each.id} pin ")
            ]
            if wheels and pins and f"{each.id} slot" not in self.parts:
                found[each.id] = wheels[0], [pin for pin in pins if pin.bands]
        return found

    @cached_property
    def parts(self) -> dict[str, ScenePart]:
        """All that holds wheels, by name."""
        return {part.name: part for part in self.scene.parts}

    @property
    def slotted(self) -> list[SceneCoupling]:
        """Couplings whose slots are in plates of their own."""
        return [each for each in self.scene.couplings if {f"{each.id} pin", f"{each.id} slot"} <= set(self.parts)]


def _frame(part: ScenePart) -> Floats:
    found = np.eye(4)
    x, z = np.array(part.across), np.array(part.direction)
    found[:3] = np.column_stack([x, np.cross(z, x), z, part.place])
    return found


def _about(point: Floats, part: ScenePart, angle: float) -> Floats:
    """A turn about the line through a point along the z axis of a part."""
    there = _frame(part)
    there[:3, 3] = point
    return np.asarray(there @ about_z(angle) @ np.linalg.inv(there))


def _turned(part: ScenePart) -> manifold3d.Manifold:
    bars = [
        manifold3d.Manifold.cylinder(high - low, radius, radius, 64).translate((0, 0, low))
        for low, high, radius, _ in part.bands
    ]
    return manifold3d.Manifold.batch_boolean(bars, manifold3d.OpType.Add)


def _plate(part: ScenePart) -> manifold3d.Manifold:
    lines = [np.array(line).reshape(-1, 2) for line in part.outlines]
    flat = manifold3d.CrossSection(lines, manifold3d.FillRule.EvenOdd)
    return manifold3d.Manifold.extrude(flat, part.height).translate((0, 0, -part.height / 2))


@contextmanager
def opened(browser: Browser, scene: Scene) -> Iterator[DrawnTeeth]:
    """The teeth of a scene while its page is open."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "page.html"
        path.write_text(page([scene]), encoding="utf-8")
        # a page in motion is drawn without end, by this processor
        sheet = browser.new_page(viewport={"width": 320, "height": 240}, reduced_motion="reduce")
        sheet.set_default_timeout(PATIENCE)
        try:
            sheet.goto(path.as_uri())
            while not sheet.evaluate("Boolean(globalThis.geartrain?.ready)"):
                time.sleep(0.02)
            found = zip(sheet.evaluate(SHAPES), scene.wheels, strict=True)
            wheels = [_tooth(shapes, wheel.kind == "worm") for shapes, wheel in found]
            yield DrawnTeeth(
                scene,
                wheels,
                lambda requested: sheet.evaluate(POSES, requested),
                lambda requested: sheet.evaluate(BENT, requested),
            )
        finally:
            sheet.close()


def _tooth(shapes: Sequence[dict[str, Any]], worm: bool) -> DrawnTooth | None:
    if not shapes:
        return None
    (shape,) = shapes
    return DrawnTooth(np.array(shape["points"]).reshape(-1, 3), shape["elements"], shape["count"], worm)
