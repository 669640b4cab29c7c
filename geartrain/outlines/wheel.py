"""A whole wheel, fit to be cut: teeth, roots the mate's tips do not touch, bore or rim."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.outlines.clearing import Mate, bite
from geartrain.outlines.contour import Contour
from geartrain.outlines.cut import Cut
from geartrain.outlines.fillet import fillet
from geartrain.outlines.flank import flank
from geartrain.outlines.tooth import Tooth, pin_span

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.outlines.flank import Flank
    from geartrain.teeth.conjugate import Pair

_CLEARANCE, _FILLET = 0.25, 0.38  # modules
_BITE = 1e-5  # modules, and the chords' tolerance: deeper is interference
_RELIEFS = (0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 18.0)  # deg; a root so much steeper than the flank it goes on from
_LEAST_FILLET = 1e-3
_HALVINGS = 18
_THIN = 0.1  # modules: least land of a wheel about its bore

Sizes = tuple[float, float, float, float, float]
"""Radii of pitch, tip and root circle, thickness, radius of the round; modules."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel's outline and sizes, mm.

    gear, z     which of the pair (1 drives), and its teeth or pins
    contours    the outer one first, then holes; the axle at (0, 0), a tooth, or a pin, on the x axis
    thickness   of a tooth along the pitch circle
    fillet      radius of the round at the root; 0 where there is none (pins)
    relief      how far (rad) the root is turned off the flank's tangent, so that the mate's tip passes
    kind        external, ring or pins
    """

    gear: int
    z: int
    kind: str
    contours: tuple[Contour, ...]
    module: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    thickness: float
    fillet: float
    relief: float
    clearance: float
    backlash: float
    centre_distance: float
    tolerance: float

    def to_dict(self) -> dict[str, Any]:
        """The sizes as plain data; lengths in mm, angles in rad."""
        names = ("gear", "z", "kind", "module", "thickness", "fillet", "relief", "clearance", "backlash")
        return {name: getattr(self, name) for name in names} | {
            "pitch_diameter": 2 * self.pitch_radius,
            "tip_diameter": 2 * self.tip_radius,
            "root_diameter": 2 * self.root_radius,
            "centre_distance": self.centre_distance,
            "tolerance": self.tolerance,
        }


@dataclass(frozen=True, slots=True)
class Pins:
    """Round pins instead of teeth: which gear has them, the radius of their circle, their own; modules."""

    gear: int
    circle: float
    radius: float


def outline(pair: Pair, gear: int, cut: Cut, pins: Pins | None = None) -> Wheel:
    """The outline of gear 1 or 2 of a pair; `pins` where one of them is a lantern.

    Turned about by its own angle so that a space of gear 2 faces a tooth of gear 1, the two wheels mesh at
    `centre_distance` with half the backlash on either side. Raises `QuestionError` where no such wheel can be cut.
    """
    _refuse(pair)
    both = _Both(pair, cut, pins)
    if pins is not None and gear == pins.gear:
        return both.lantern(pins)
    return both.toothed(gear)


def _refuse(pair: Pair) -> None:
    path = pair.path
    if path.pitch.bevel:
        virtual = [path.pitch.z1 / cos(path.pitch.R1), path.pitch.z2 / max(cos(path.pitch.R2), 1e-9)]
        raise QuestionError(
            Problem(
                "a bevel wheel has no flat outline",
                "its teeth lie on a sphere and taper to the point where the axes meet",
                "leave --profile out, or as a likeness draw the spur pair its back cones develop into, of "
                f"{virtual[0]:.4g} and {virtual[1]:.4g} teeth",
                "--profile",
            )
        )
    if pair.faults:
        raise QuestionError(Problem(fault.what, fault.why, fault.fix, "--profile") for fault in pair.faults)
    if path.approach.start or path.recess.start:
        why = "where the flanks end there is nothing to say how thick the teeth are"
        raise QuestionError(Problem("this path of contact keeps off the pitch point", why, "take another form"))


class _Both:
    """Both wheels of a pair in modules."""

    def __init__(self, pair: Pair, cut: Cut, pins: Pins | None) -> None:
        self.pair, self.pitch, self.cut, self.pins = pair, pair.path.pitch, cut, pins
        self.tolerance = cut.tolerance / cut.module
        self.clearance = _CLEARANCE if cut.clearance is None else cut.clearance / cut.module
        self.internal = self.pitch.R2 < 0
        self.distance = abs(self.pitch.R1 + self.pitch.R2)
        # pins are round whatever part of them works
        whole = pair.path.approach.arc, pair.path.recess.arc
        ends = [pair.arcs if solid else whole for solid in pair.solid]
        self.flanks = [flank(pair.path, which, arcs, self.tolerance) for which, arcs in enumerate(ends, 1)]

    def z(self, gear: int) -> int:
        return self.pitch.z1 if gear == 1 else self.pitch.z2

    def widening(self, gear: int) -> float:
        return self.pair.halves[gear - 1] / self.flanks[gear - 1].R

    def root(self, gear: int) -> float:
        """Radius of the root circle: as deep under the pitch circle as the mate's tip stands over its own, and more.

        A tip that keeps off its pitch circle stands over it by less than nothing.
        """
        own, mate = self.flanks[gear - 1], self.flanks[2 - gear]
        tip = float(mate.r[-1]) if self.pins is None else self.pins.circle + self.pins.radius
        return own.R - own.outward * (mate.outward * (tip - mate.R) + self.clearance)

    def mate(self, gear: int) -> Mate:
        """The tooth or pin that passes through the spaces of `gear`."""
        other = 3 - gear
        found = self.flanks[other - 1]
        if self.pins is not None and other == self.pins.gear:
            span = pin_span(self.pins.circle, self.pins.radius)
        else:
            half = self.widening(other) + found.angle
            flanks = np.stack([np.tile(found.r, 2), np.concatenate((half, -half))])
            land = np.stack([np.full(9, found.r[-1]), np.linspace(-half[-1], half[-1], 9)])
            span = np.concatenate((flanks, land), axis=1)
        # both wheels being symmetric, what passes on this side of its play passes on the other
        touching = span + np.array([[0.0], [self.pair.play / 2 / found.R]])
        return Mate(touching, self.z(other), found.R, self.internal)

    def tooth(self, gear: int) -> tuple[Tooth, float]:
        """The tooth with the fillet asked for, or the largest up to 0.38 modules that lets the mate pass."""
        own, z = self.flanks[gear - 1], self.z(gear)
        if fillet(own, self.widening(gear), self.root(gear), _LEAST_FILLET, z) is None:
            raise _no_root(gear, self.clearance * self.cut.module)
        mate = self.mate(gear)
        wanted = _FILLET if self.cut.fillet is None else self.cut.fillet / self.cut.module
        for degree in _RELIEFS:
            made = _maker(self, gear, mate, radians(degree))
            found = made(wanted) or _largest(made, wanted)
            if found is None:
                continue
            if self.cut.fillet is not None and found.fillet.radius < wanted:
                raise _too_round(gear, self.cut.fillet, found.fillet.radius * self.cut.module)
            return found, radians(degree)
        raise QuestionError(
            Problem(
                f"no root of gear {gear} lets the mate's tips pass",
                "they would cut the flanks below where these work, or teeth outside the path of contact",
                "shorten the arcs, take more teeth, or more backlash or clearance",
                "--profile",
            )
        )

    def toothed(self, gear: int) -> Wheel:
        """A wheel with teeth, or a ring."""
        tooth, relief = self.tooth(gear)
        sizes = (tooth.flank.R, tooth.tip, tooth.root, 2 * self.pair.halves[gear - 1], tooth.fillet.radius)
        kind = "ring" if tooth.flank.outward < 0 else "external"
        return self._wheel(gear, kind, _contours(tooth, self.cut), sizes, relief)

    def lantern(self, pins: Pins) -> Wheel:
        """A disc with a hole for each pin."""
        scale, z = self.cut.module, self.z(pins.gear)
        inner, outer = pins.circle - pins.radius, pins.circle + pins.radius
        rim = 2 * pins.radius * scale if self.cut.rim is None else self.cut.rim
        R = pins.circle * scale
        turns = [2 * pi * k / z for k in range(z)]
        holes = (Contour.circle(pins.radius * scale, (R * cos(t), R * sin(t))) for t in turns)
        contours = [Contour.circle(outer * scale + rim), *holes, *_bore(self.cut, inner * scale)]
        sizes = (self.flanks[pins.gear - 1].R, outer, inner, 2 * self.pair.halves[pins.gear - 1], 0.0)
        return self._wheel(pins.gear, "pins", contours, sizes, 0.0)

    def _wheel(self, gear: int, kind: str, contours: list[Contour], sizes: Sizes, relief: float) -> Wheel:
        scale = self.cut.module
        pitch, tip, root, thickness, round_ = (size * scale for size in sizes)
        return Wheel(
            gear=gear,
            z=self.z(gear),
            kind=kind,
            contours=tuple(contours),
            module=scale,
            pitch_radius=pitch,
            tip_radius=tip,
            root_radius=root,
            thickness=thickness,
            fillet=round_,
            relief=relief,
            clearance=self.clearance * scale,
            backlash=self.pair.play * scale,
            centre_distance=self.distance * scale,
            tolerance=self.cut.tolerance,
        )


def _no_root(gear: int, clearance: float) -> QuestionError:
    return QuestionError(
        Problem(
            f"there is no root circle for gear {gear}",
            f"with a clearance of {clearance:.4g} mm neighbouring teeth meet above it",
            "give less clearance, or thinner teeth by more backlash",
            "--clearance",
        )
    )


def _too_round(gear: int, asked: float, fits: float) -> QuestionError:
    return QuestionError(
        Problem(
            f"a fillet of {asked:g} mm does not fit the root of gear {gear}",
            "there it would stand in the way of the mate's tips, or of the next tooth",
            f"give at most {fits:.4g} mm, or more clearance",
            "--fillet",
        )
    )


def _maker(both: _Both, gear: int, mate: Mate, relief: float) -> Callable[[float], Tooth | None]:
    """From a fillet's radius to a tooth the mate passes, or None."""
    own: Flank = both.flanks[gear - 1]
    z, widening, root = both.z(gear), both.widening(gear), both.root(gear)

    def made(radius: float) -> Tooth | None:
        round_ = fillet(own, widening, root, radius, z, relief)
        if round_ is None:
            return None
        tooth = Tooth(z, own, round_, widening, root)
        return tooth if bite(tooth, mate) <= _BITE + 2 * both.tolerance else None

    return made


def _largest(made: Callable[[float], Tooth | None], wanted: float) -> Tooth | None:
    """The tooth with the largest fillet below `wanted`; None where not even a small one fits."""
    found = made(_LEAST_FILLET)
    low, high = _LEAST_FILLET, wanted
    if found is None or wanted <= low:
        return found
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if (better := made(middle)) is None:
            high = middle
        else:
            low, found = middle, better
    return found


def _contours(tooth: Tooth, cut: Cut) -> list[Contour]:
    """Teeth and bore, or rim and teeth, in mm."""
    teeth = tooth.whole().scaled(cut.module)
    if tooth.flank.outward > 0:
        if cut.rim is not None:
            raise QuestionError(Problem("only a ring or a lantern has a rim", "", "leave --rim out", "--rim"))
        return [teeth, *_bore(cut, tooth.root * cut.module)]
    if cut.bore is not None:
        raise QuestionError(Problem("a ring has no bore", "its middle is open", "leave --bore out", "--bore"))
    return [Contour.circle(tooth.root * cut.module + (2 * cut.module if cut.rim is None else cut.rim)), teeth]


def _bore(cut: Cut, root: float) -> list[Contour]:
    if cut.bore is None:
        return []
    most = 2 * (root - _THIN * cut.module)
    if cut.bore >= most:
        raise QuestionError(
            Problem(
                f"a bore of {cut.bore:g} mm does not fit",
                f"the wheel's root circle has a diameter of {2 * root:.4g} mm",
                f"give less than {most:.4g} mm",
                "--bore",
            )
        )
    return [Contour.circle(cut.bore / 2)]
