"""Flat shape of every wheel: its teeth as cut for all mates, the hole for its arbor, and crossings (spokes).

The openings between spokes leave a rim, spokes and a hub. All inner corners are rounded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import asin, cos, degrees, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.cut_teeth import not_cut
from geartrain.dynamics.train_teeth import PairBacklash, find_train_teeth
from geartrain.dynamics.wheel_teeth import WheelTeeth
from geartrain.errors import Problem
from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes
from geartrain.teeth.outlines.contour import Contour, bulge_about
from geartrain.teeth.outlines.fixed_teeth import ESCAPEMENT
from geartrain.teeth.outlines.wheel_outline import pin_seats

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.layout import Layout, WheelPlace
    from geartrain.teeth.outlines.wheel_requirement import LanternPins

RIM, HUB = 2.25, 1.125
"""Radial depth of the rim below the tooth roots [modules], and radius of the hub [diameters of the bore].

Clockmakers use rims of 2 to 2.5 modules, and hubs of 2 to 2.5 diameters of the arbor.
"""
_SPOKE = 1.0  # width of a spoke divided by the depth of the rim
_WINDOW = 1.0  # minimum radial size of a window divided by the depth of the rim
_CORNER = 0.5  # default radius of corners in modules

Point = tuple[float, float]


def spoke_windows(root: float, module: float, bore: float, spokes: int) -> tuple[Contour, ...]:
    """Return the openings between the spokes of a wheel, each as one contour; empty if there is not enough space.

    A spoke has a uniform width equal to the depth of the rim. An opening is bounded by two spokes, the rim and the hub.

    root     root radius [mm]; `bore` is the diameter of the hole for the arbor [mm]
    spokes   number of spokes, 3 or more; for fewer, the result is empty
    """
    if spokes < 3:
        return ()
    depth = RIM * module
    corner = _CORNER * module
    # many spokes require a larger hub
    meet = (_SPOKE * depth / 2 + corner) / sin(pi / spokes) - corner
    outer, inner = root - depth, max(HUB * bore, depth, meet)
    if outer - inner < max(_WINDOW * depth, 2 * corner):
        return ()
    window = _window(outer, inner, _SPOKE * depth / 2, 2 * pi / spokes, corner)
    if window is None:
        return ()
    return tuple(_turned(window, 2 * pi * (at + 0.5) / spokes) for at in range(spokes))


def _window(outer: float, inner: float, half: float, pitch: float, corner: float) -> Contour | None:
    """Return the opening about the x axis between spokes of half width `half` at +-pitch/2; None if it is too small.

    Corners are arcs about centres at the distance `corner` from a spoke, and from the rim or the hub.
    """
    ends = []
    for circle, centre in ((outer, outer - corner), (inner, inner + corner)):
        if half + corner >= centre:
            return None
        lean = asin((half + corner) / centre)
        along = sqrt(centre**2 - (half + corner) ** 2)
        ends.append((circle, centre, pitch / 2 - lean, along))
    (rim, rim_centre, rim_turn, far), (hub, hub_centre, hub_turn, near) = ends
    # -1e-9: at the limit the two arcs at one end meet on the x axis
    if min(rim_turn, hub_turn) < -1e-9 or far <= near:
        return None
    upper = [
        (_at(rim, rim_turn), _at(rim_centre, rim_turn), _spoke_edge(far, half, pitch)),
        (_spoke_edge(near, half, pitch), _at(hub_centre, hub_turn), _at(hub, hub_turn)),
    ]
    corners = [*upper, *((_mirrored(c), _mirrored(b), _mirrored(a)) for a, b, c in reversed(upper))]
    vertices = []
    for at, (start, about, end) in enumerate(corners):
        following = corners[(at + 1) % 4][0]
        round_ = at in (1, 3)  # arcs along the hub and the rim; the other two sides are straight edges of spokes
        bulge = bulge_about(complex(*end), complex(*following)) if round_ else 0.0
        vertices += [(*start, bulge_about(complex(*start), complex(*end), complex(*about))), (*end, bulge)]
    return Contour.of(vertices)


def _at(radius: float, angle: float) -> Point:
    return radius * cos(angle), radius * sin(angle)


def _spoke_edge(along: float, half: float, pitch: float) -> Point:
    """Return the point at the distance `along` on the edge of the spoke at +pitch/2 that faces the opening."""
    c, s = cos(pitch / 2), sin(pitch / 2)
    return along * c + half * s, along * s - half * c


def _mirrored(point: Point) -> Point:
    return point[0], -point[1]


def _turned(contour: Contour, angle: float) -> Contour:
    """Return the contour rotated about the origin, with the same orientation."""
    c, s = cos(angle), sin(angle)
    x, y = contour.points.T
    points = contour.points.copy()
    points[:, 0], points[:, 1] = c * x - s * y, s * x + c * y
    return Contour(points, contour.bulges)


# --------------------------------------------------------------------------------------------------------------- blanks


_LAND = 0.8  # maximum bore divided by the root diameter
_THIN = 0.4  # mm: wall between bore and roots that allows a larger bore


@dataclass(frozen=True, slots=True)
class Blank:
    """Flat wheel blank to be cut, with its axis at the origin and its first tooth on the x axis; lengths are in mm."""

    wheel: str
    link: str
    teeth: int
    kind: str
    """Kind of the wheel: external, ring or pins."""
    form: str
    contours: tuple[Contour, ...]
    """Contours of the blank [mm]: first the outer contour, then the holes."""
    module: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    thickness: float
    bore: float
    helix: float = 0.0
    """Helix angle of the teeth [rad], positive for a right-hand helix."""
    arms: int = 0
    """Number of spokes; 0 for a solid web."""
    pins: LanternPins | None = None
    """Pins of a pin ring [modules], which are separate parts in seats inside the ring; None for other wheels."""

    @property
    def twist(self) -> float:
        """Angle by which the upper face of the wheel is rotated relative to its lower face [rad]."""
        return self.thickness * tan(self.helix) / self.pitch_radius


@dataclass(frozen=True, slots=True)
class Blanks:
    """Flat shapes of wheels by name, with warnings, and the backlash of every pair whose teeth are cut."""

    wheels: Mapping[str, Blank]
    notices: tuple[Problem, ...]
    backlashes: tuple[PairBacklash, ...]
    uncut: Mapping[str, tuple[Problem, ...]]
    """Reasons why a wheel cannot be cut, by wheel."""
    flat: frozenset[str]
    """Names of all wheels with planar teeth parallel to the axis."""


def find_blanks(train: GearTrain, layout: Layout, making: ManufacturingSizes) -> Blanks:
    """Return the flat shapes, without holes, of all wheels that can be cut from sheet, at the sizes of a layout."""
    toothed = find_train_teeth(train.mechanics, layout.wheels, making.backlash, layout.apart)
    mated = {name for gear in train.declaration.gears for name in gear.pair}
    wheels, notices = {}, []
    for name, problems in toothed.problems.items():
        notices += [replace(not_cut(name, each), place="") for each in problems]
    for name, toothing in toothed.wheels.items():
        wheel, blank = train.declaration.wheels[name][1], _blank(toothing, layout.wheels[name])
        if name not in mated and blank.kind == "external":
            blank, notice = _without_mates(toothing, blank)
            notices.append(notice)
        wheels[name] = blank
        if wheel.is_helical:
            wheels[name] = replace(blank, helix=wheel.helix)
            what = f"wheel '{name}' is drawn flat, but it has a helix angle of {abs(degrees(wheel.helix)):.6g} deg"
            fix = "print it from the .stl, or have it hobbed"
            why = "a flat drawing shows the transverse section, and the .step file extrudes it without twist"
            notices.append(Problem(what, why, fix))
    return Blanks(wheels, tuple(notices), toothed.backlashes, toothed.problems, toothed.flat)


def _blank(toothing: WheelTeeth, place: WheelPlace) -> Blank:
    module = place.module
    return Blank(
        toothing.wheel,
        place.link,
        toothing.z,
        toothing.kind,
        toothing.words,
        toothing.contours(module),
        module,
        place.radius,
        toothing.tip * module,
        toothing.depth * module,
        place.thickness,
        0.0,
        pins=toothing.pins if toothing.kind == "ring" else None,
    )


def _without_mates(toothing: WheelTeeth, blank: Blank) -> tuple[Blank, Problem]:
    """Return the blank of a wheel without a mate, and a notice. It is a plain disc, except for an escape wheel."""
    if toothing.form == ESCAPEMENT:
        what = f"the teeth of escape wheel '{blank.wheel}' may not match its anchor"
        fix = "make an anchor to match the teeth, or recut them for another escapement"
        return blank, Problem(what, "no anchor is declared, so the teeth are those of a dead-beat escapement", fix)
    r = blank.pitch_radius
    form = "a disc without teeth, with the diameter of its pitch circle, because its teeth are not known"
    what = f"wheel '{blank.wheel}' is cut as a disc without teeth, with the diameter of its pitch circle"
    why, fix = "it has no mate, so its tooth form is not known", "cut its teeth to match the part that it engages"
    notice = Problem(what, why, fix)
    return replace(blank, form=form, contours=(Contour.circle(r),), tip_radius=r, root_radius=r), notice


def with_seats(blank: Blank, wider: float) -> Blank:
    """Return the blank of a ring with its recesses for pins widened by `wider` [mm]; other blanks are unchanged."""
    if blank.pins is None or not wider:
        return blank
    root = blank.contours[1].points  # corners of the seats are on the inner circle
    inside = float(np.hypot(*root[0])) / blank.module
    seats = pin_seats(blank.pins, blank.teeth, inside, blank.module, wider)
    return replace(blank, contours=(blank.contours[0], seats, *blank.contours[2:]))


def crossed_out(blank: Blank, arms: int) -> tuple[Blank, list[Problem]]:
    """Return the blank, and warnings. A plain spur wheel with sufficient space has openings between spokes."""
    own = 1 + (blank.bore > 0)
    if blank.kind != "external" or blank.helix:
        return blank, []
    windows = spoke_windows(min(blank.root_radius, blank.tip_radius), blank.module, blank.bore, arms)
    if windows and len(blank.contours) > own:
        what = f"wheel '{blank.wheel}' keeps its solid web"
        why = "openings between its spokes could intersect holes for other parts"
        return blank, [Problem(what, why, "cut the openings by hand", "--spokes")]
    return replace(blank, contours=(*blank.contours, *windows), arms=arms if windows else 0), []


def bored(blank: Blank, bore: float, holes: Sequence[Contour] = ()) -> tuple[Blank, list[Problem]]:
    """Return the blank with holes for other parts and, if there is space, for its arbor. Also return a list of
    warnings.
    """
    inner = min(blank.root_radius, blank.tip_radius)
    blank = replace(blank, contours=(*blank.contours, *holes)) if holes else blank
    if not bore or blank.kind == "ring":
        return blank, []
    if bore / 2 >= _LAND * inner and bore / 2 >= inner - _THIN:
        what = f"wheel '{blank.wheel}' has no space for a bore of {bore:g} mm"
        why = f"its root circle has a diameter of {2 * inner:.4g} mm, so it is cut without a hole"
        return blank, [Problem(what, why, f"give a bore of less than {2 * _LAND * inner:.4g} mm", "--bore")]
    return replace(blank, contours=(*blank.contours, Contour.circle(bore / 2)), bore=bore), []
