"""Thin wheels bent into their rings, as they are written: no tooth in the ring wherever the wave stands.

A wheel that a wave bends is no rigid body, and cannot be turned as others are: while the wave turns, the wheel itself
turns by the ring's teeth.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem
from geartrain.kinematics.buildability import BuildFinding
from geartrain.teeth.outlines.fixed_teeth import bent_line
from geartrain.workshop.export.proof.cut_outlines import plane_geometry
from geartrain.workshop.export.proof.turned_pair import NOTHING

if TYPE_CHECKING:
    from typing import Any

    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.eccentrics import Eccentric
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.workshop.export.proof.mesh_proof import CutTrain

_POSITIONS = 7  # of the wave in a pitch of the ring
_PARTS = 4  # of each chord of the wheel, which bending makes round


def prove_waves(work: SolidModel, cut: CutTrain) -> Iterator[BuildFinding]:
    """What is in the way of thin wheels that are bent into their rings."""
    waves = () if work.frame is None else (each for each in work.frame.plan.stack.eccentrics if each.wave is not None)
    for each in waves:
        for gear in work.train.declaration.gears:
            if each.wheels[0] in gear.pair and set(gear.pair) <= set(cut.materials):
                ring = next(name for name in gear.pair if name != each.wheels[0])
                area = max(overlaps(work, each, cut.materials[each.wheels[0]], (ring, cut.materials[ring])))
                if area > NOTHING:
                    what = (
                        f"pair '{gear.name}': bent by its wave '{each.wheels[0]}' overlaps '{ring}' by {area:.3g} mm2"
                    )
                    yield BuildFinding("T5", "error", Problem(what, "it cannot turn", "give more backlash"))


def overlaps(work: SolidModel, wave: Eccentric, thin: Any, ring: tuple[str, Any]) -> Iterator[float]:
    """Common areas (mm2) of a bent wheel and its ring, the wave in several places of a pitch."""
    assert wave.wave is not None
    shapely = plane_geometry()
    name, material = ring
    blank, counts = work.blanks.wheels[wave.wheels[0]], work.blanks.wheels[name].teeth
    pitch, z = 2 * np.pi / counts, blank.teeth
    middle = wave.radius + wave.wave.wall / 2
    line = _divided(np.asarray(thin.exterior.coords)[:-1])
    for turn in np.arange(_POSITIONS) * pitch / _POSITIONS * counts / (counts - z):
        own = -turn * (counts - z) / z
        bent = shapely.Polygon(bent_line(line, middle, (wave.wave.rise, wave.wave.lobes), (own, turn)))
        # a tooth of the wheel stands before a space of its ring where the wave begins
        c, s = np.cos(pitch / 2), np.sin(pitch / 2)
        held = shapely.transform(material, lambda points, c=c, s=s: points @ np.array([[c, s], [-s, c]]))
        yield float(shapely.intersection(bent, held).area)


def _divided(line: Floats) -> Floats:
    """With points between its corners."""
    steps = np.arange(_PARTS)[None, :, None] / _PARTS
    after = np.roll(line, -1, axis=0)
    found: Floats = (line[:, None, :] + (after - line)[:, None, :] * steps).reshape(-1, 2)
    return found
