"""Picture of two wheels of triangular teeth in contact, to scale: outlines, contact point, normal, instant centre.

The driver turns about (0, 0), and the driven wheel about (D, 0) with the centre distance D, or about (-D, 0) if the
driven wheel is a ring. Lengths are in the unit of `TriangularSizes`. The teeth of driver and driven wheel are at the
angles alpha_1 and alpha_2 from the line of centres, positive on the entry side. In forward motion the entry side is
above the line of centres, in backward motion below.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, ceil, cos, degrees, floor, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    PURPLE,
    SKY,
    TEXT,
    WIDTH,
    Axes,
    Circle,
    FancyArrowPatch,
    Figure,
    Line2D,
    Path,
    Polygon,
    legend_below,
    name_axes,
    note,
)
from geartrain.errors import GearTrainError, Problem
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DWELL
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

PHASES = {APPROACH: BLUE, RECESS: ORANGE, DWELL: BLACK}


def pair_text(transmission: TriangularTransmission, friction: float | None = None) -> str:
    """Return a text with the tooth counts, half angles, clearance factor and friction coefficient of a pair.

    friction   coefficient to print; by default the coefficient of the pair
    """
    sizes = transmission.sizes
    betas = [f"{degrees(beta):.6g}°" for beta in (sizes.beta1, sizes.beta2)]
    beta = betas[0] if betas[0] == betas[1] else ", ".join(betas)
    wheels = [f"a ring of {z}" if s < 0 else str(z) for z, s in zip((sizes.z1, sizes.z2), sizes.signs, strict=True)]
    backwards = "" if transmission.direction > 0 else ", backwards"
    return (
        f"{wheels[0]} drives {wheels[1]}{backwards}: half angle {beta}, clearance factor "
        f"{sizes.clearance_factor:.10g}, friction {transmission.friction if friction is None else friction:.6g}"
    )


def require_contact(transmission: TriangularTransmission) -> None:
    """Raise `GearTrainError` if the pair has no teeth, or if no teeth are in contact."""
    if not transmission.sizes.has_valleys or not transmission.intervals:
        what, fix = "the teeth of this pair never touch", "change `half_angle` or `clearance_factor`"
        raise GearTrainError(Problem(what, transmission.verdict.text, fix))


Point = tuple[float, float]
DRIVER, DRIVEN = 1, 2


@dataclass(frozen=True, slots=True)
class ToothPairPose:
    """Two wheels with triangular teeth, with one tooth of each wheel at the angles alpha_1 and alpha_2 [rad]."""

    sizes: TriangularSizes
    phase: str
    touching: bool
    alpha1: float
    alpha2: float
    tau: float
    direction: int

    def wheel(self, which: int) -> tuple[int, float, float, float]:
        """Return the tooth count, the tip and root radii, and the angle [rad] of wheel 1 (driver) or 2 (driven)."""
        sizes = self.sizes
        if which == DRIVER:
            return sizes.z1, sizes.R1, sizes.R1 - sizes.signs[0] * sizes.depths[0], self.alpha1
        return sizes.z2, sizes.R2, sizes.R2 - sizes.signs[1] * sizes.depths[1], self.alpha2

    @property
    def axis2(self) -> float:
        """Signed distance of the driven wheel's axis from the driver's axis, in the unit of `sizes`."""
        return self.sizes.signs[1] * self.sizes.D

    def place(self, which: int, radius: float | Floats, angle: float | Floats) -> Floats:
        """Return points (..., 2) of wheel 1 or 2 from radii and angles [rad], measured from the line of centres."""
        along: Floats = radius * np.cos(angle)
        across: Floats = radius * np.sin(angle)
        x = along if which == DRIVER else self.axis2 - self.sizes.side * along
        return np.stack([x, self.direction * across], axis=-1)

    def outline(self, which: int, within: float = pi) -> Floats:
        """Return vertices (n, 2) of a wheel's teeth within an angle [rad] from the line of centres.

        If `within` is less than pi, the centre of an external wheel is also a vertex. The body of a ring ends at a
        circle beyond its roots.
        """
        z, tip, root, alpha = self.wheel(which)
        half = pi / z
        steps = np.arange(2 * z)
        if within < pi:
            steps = np.arange(ceil((-within - alpha) / half), floor((within - alpha) / half) + 1)
        radii: Floats = np.where(steps % 2 == 0, tip, root).astype(float)
        angles = alpha + half * steps.astype(float)
        teeth = self.place(which, radii, angles)
        if root > tip:
            if within >= pi:  # closes the line of the teeth, from which the rim is drawn backwards
                angles, teeth = np.append(angles, angles[0] + 2 * pi), np.vstack([teeth, teeth[:1]])
            return np.vstack([teeth, self.place(which, 2 * root - tip, angles[::-1])])
        return teeth if within >= pi else np.vstack([teeth, self.place(which, 0.0, 0.0)])

    @property
    def lean(self) -> float:
        """Angle [rad] from the line of centres to the flank in contact, positive towards the entry side."""
        if self.phase == APPROACH:
            return self.alpha1 + self.sizes.signs[0] * self.sizes.beta1
        return self.sizes.signs[0] * self.sizes.beta2 - self.sizes.side * self.alpha2

    @property
    def contact(self) -> Point:
        """Contact point: the tip of the driven tooth in approach, or the tip of the driver's tooth in recess."""
        which = DRIVEN if self.phase == APPROACH else DRIVER
        _, tip, _, alpha = self.wheel(which)
        x, y = self.place(which, tip, alpha)
        return float(x), float(y)

    @property
    def normal(self) -> Point:
        """Unit normal of the flank in contact, in the direction in which the driver pushes the driven tooth."""
        return sin(self.lean), -self.direction * cos(self.lean)

    @property
    def centre(self) -> Point:
        """Instant centre: the point at which the contact normal intersects the line of centres."""
        x, y = self.contact
        return x + self.direction * y * tan(self.lean), 0.0


def tooth_pair_pose(transmission: TriangularTransmission, alpha1: float | None = None) -> ToothPairPose:
    """Return the pose with a driver's tooth at `alpha1` from the line of centres [rad], by default at mid-contact."""
    if alpha1 is None:
        interval = transmission.intervals[0]
        x = (interval.start + interval.end) / 2
    else:
        known = ((each, alpha1) for each in transmission.intervals if each.end <= alpha1 <= each.start)
        interval, x = next(known, None) or transmission.contact.locate(alpha1)
    tooth_pair, standing = transmission.contact.path.tooth_pair, interval.held
    alpha2 = float(tooth_pair.angle(interval.phase, x)) if standing is None else standing
    tau = transmission.contact.speed(interval, x)
    return ToothPairPose(transmission.sizes, interval.phase, standing is None, x, alpha2, tau, transmission.direction)


_FEW = 40  # maximum sum of tooth counts of wheels that are drawn whole
_SHAPE = 0.68  # height divided by width of the view of a few teeth
_COLORS = {DRIVER: ORANGE, DRIVEN: SKY}
_NAMES = {DRIVER: "driver", DRIVEN: "driven"}


def teeth_figure(
    transmission: TriangularTransmission, alpha1: float | None = None, whole: bool | None = None
) -> Figure:
    """Return a figure of two triangular teeth in contact, to scale, with their contact point and line of centres.

    whole   True to draw whole wheels, False to draw the teeth near the contact; by default according to tooth counts
    """
    require_contact(transmission)
    here = tooth_pair_pose(transmission, alpha1)
    whole = transmission.sizes.z1 + transmission.sizes.z2 <= _FEW if whole is None else whole
    view = _whole(here) if whole else _near(here)
    figure = Figure(figsize=(WIDTH, WIDTH * view.shape + 1.3), layout="constrained")
    axes = figure.add_subplot()
    axes.set_aspect("equal")
    axes.set_xlim(view.left, view.right)
    axes.set_ylim(view.bottom, view.top)
    axes.set_axis_off()
    for which in (DRIVER, DRIVEN):
        _wheel(axes, here, which, view)
        _turning(axes, here, which, view)
    _line_of_centres(axes, here, view)
    if here.touching:
        _contact(axes, here, view)
    name_axes(axes, title=f"{pair_text(transmission)}\n{_moment(here)}")
    legend_below(figure, 4, list(_legend(here)))
    return figure


# ---------------------------------------------------------------------------------------------------------------- view


@dataclass(frozen=True, slots=True)
class ToothViewport:
    """Rectangular part of the plane that is drawn. `whole` is True if the rectangle contains whole wheels."""

    left: float
    right: float
    bottom: float
    top: float
    whole: bool

    @property
    def shape(self) -> float:
        """Height of the viewport divided by its width."""
        return (self.top - self.bottom) / (self.right - self.left)

    def within(self, here: ToothPairPose, which: int) -> float:
        """Return the half-angle [rad] of a sector about the line of centres that contains a wheel's visible part."""
        if self.whole:
            return pi
        z = here.wheel(which)[0]
        axis, side = (0.0, 1.0) if which == DRIVER else (here.axis2, -here.sizes.side)
        near = min(side * (end - axis) for end in (self.left, self.right))
        if near <= 0:
            return pi
        # one pitch more, so that the ends of the outline are outside of the picture
        return min(pi, atan2(max(self.top, -self.bottom), near) + 2 * pi / z)


def _whole(here: ToothPairPose) -> ToothViewport:
    sizes = here.sizes
    reach = {at: max(tip, 2 * root - tip) for at in (DRIVER, DRIVEN) for _, tip, root, _ in [here.wheel(at)]}
    rim, tall = 0.03 * (sizes.R1 + sizes.R2), max(reach.values())
    left, right = min(-reach[DRIVER], here.axis2 - reach[DRIVEN]), max(reach[DRIVER], here.axis2 + reach[DRIVEN])
    return ToothViewport(left - rim, right + rim, -tall - rim, tall + rim, True)


def _near(here: ToothPairPose) -> ToothViewport:
    """Return a viewport around the contact point, the instant centre and the pitch point, with a margin."""
    sizes = here.sizes
    pitch = 2 * pi * sizes.D / sizes.pitch_sum
    points = [(sizes.D * sizes.z1 / sizes.pitch_sum, 0.0)]
    if here.touching:
        points += [here.contact, here.centre]
    xs = [x for x, _ in points]
    xs += [float(here.place(which, radius, 0.0)[0]) for which in (DRIVER, DRIVEN) for radius in here.wheel(which)[1:3]]
    ys = [y for _, y in points]
    left, right, bottom, top = min(xs) - pitch, max(xs) + pitch, min(ys) - 1.5 * pitch, max(ys) + 1.5 * pitch
    wider = max(0.0, (top - bottom) / _SHAPE - (right - left)) / 2
    taller = max(0.0, (right - left) * _SHAPE - (top - bottom)) / 2
    return ToothViewport(left - wider, right + wider, bottom - taller, top + taller, False)


# -------------------------------------------------------------------------------------------------------------- wheels


def _wheel(axes: Axes, here: ToothPairPose, which: int, view: ToothViewport) -> None:
    sizes, (z, tip, _, _) = here.sizes, here.wheel(which)
    color, name = _COLORS[which], _NAMES[which]
    outline = here.outline(which, view.within(here, which))
    ring = here.sizes.signs[which - 1] < 0
    axes.add_patch(
        Polygon(outline, facecolor=(color, 0.35), edgecolor="none" if ring else BLACK, linewidth=1.3, gid=name)
    )
    if ring:  # draws the line of its teeth without the rim
        axes.plot(*outline[: len(outline) // 2].T, color=BLACK, linewidth=1.3)
    x, y = here.place(which, 0.0, 0.0)
    pitch = sizes.D * z / sizes.pitch_sum
    for radius, style, width in ((tip, "-", 0.7), (pitch, "--", 1.1)):
        axes.add_patch(Circle((x, y), radius, fill=False, edgecolor=GREY, linestyle=style, linewidth=width))


def _turning(axes: Axes, here: ToothPairPose, which: int, view: ToothViewport) -> None:
    """Draw an arrow in the sense of rotation of wheel 1 or 2, and the wheel's name. A wheel at rest has no arrow."""
    z, tip, root, _ = here.wheel(which)
    pitch = 2 * pi / z
    inwards = 1 if tip > root else -1
    if view.whole:
        radius, first, last = 0.55 * root if inwards > 0 else 1.5 * root - 0.5 * tip, 0.7, 0.2
    else:
        radius = root - inwards * 0.45 * pitch * root
        high = (view.top if here.direction > 0 else -view.bottom) / radius
        first, last = 0.9 * high, 0.9 * high - 0.8 * pitch
    arc = here.place(which, radius, np.linspace(first, last, 30))
    if which == DRIVER or here.touching:
        arrow = FancyArrowPatch(path=Path(arc), arrowstyle="-|>", mutation_scale=18, linewidth=2.0, color=BLACK)
        axes.add_patch(arrow)
    x, y = arc[len(arc) // 2]
    offset = (-12 if which == DRIVER else 12, 0)
    note(axes, f"{_NAMES[which]}, {z} teeth", (x, y), offset, va="center", fontsize=TEXT, path_effects=None)


def _line_of_centres(axes: Axes, here: ToothPairPose, view: ToothViewport) -> None:
    axes.axhline(0.0, color=GREY, linewidth=0.9, linestyle="-.")
    if view.whole:
        axes.plot([0.0, here.axis2], [0.0, 0.0], "+", color=BLACK, markersize=10)
    for name, x, aside in (("$O_1$", 0.0, 1), ("$O_2$", here.axis2, -1 if here.axis2 > 0 else 1)):
        at = x if view.left < x < view.right else view.left if aside > 0 else view.right
        text = name if at == x else f"to {name}"
        _label(axes, text, (at, 0.0), (4 * aside, 8))


# ------------------------------------------------------------------------------------------------------------- contact


def _contact(axes: Axes, here: ToothPairPose, view: ToothViewport) -> None:
    """Draw the contact point, the contact normal and the instant centre."""
    (x, y), (cx, cy), (nx, ny) = here.contact, here.centre, here.normal
    more = 0.12 * (view.top - view.bottom)
    along = (cx - x) * nx + (cy - y) * ny
    ends = np.array([min(0.0, along) - more, max(0.0, along) + more])
    color = PHASES[here.phase]
    axes.plot(x + ends * nx, y + ends * ny, color=color, linewidth=1.4, gid="normal")
    axes.plot([x], [y], "o", color=color, markersize=7, zorder=5, gid="contact")
    axes.plot([cx], [cy], "D", color=PURPLE, markersize=7, markeredgecolor=BLACK, zorder=5, gid="centre")
    if here.phase == APPROACH:  # the label lies in the body whose flank is touched
        _label(axes, "$V_2$", (x, y), (-11, 5 * here.direction))
    else:
        _label(axes, "$V_1$", (x, y), (12, -4 * here.direction))
    _label(axes, "$C$", (cx, cy), (10, 11 * here.direction))


def _label(axes: Axes, text: str, at: tuple[float, float], offset: tuple[float, float]) -> None:
    note(axes, text, at, offset, va="center", fontsize=TEXT + 1, zorder=6)


def _moment(here: ToothPairPose) -> str:
    where = f"$\\alpha_1 = {degrees(here.alpha1):.4g}°$, $\\alpha_2 = {degrees(here.alpha2):.4g}°$"
    if not here.touching:
        return f"dwell: {where}; no tooth touches, the driven wheel is at rest"
    return f"{here.phase}: {where}, speed ratio {here.tau:.4g}"


def _legend(here: ToothPairPose) -> Iterator[Line2D]:
    if here.touching:
        color = PHASES[here.phase]
        point = "driven apex on the driver's flank" if here.phase == APPROACH else "driver's apex on the driven flank"
        yield Line2D([], [], color=color, marker="o", markersize=7, linestyle="none", label=point)
        yield Line2D([], [], color=color, linewidth=1.2, label=f"normal $n_{here.phase[0]}$")
        yield Line2D(
            [], [], color=PURPLE, marker="D", markeredgecolor=BLACK, linestyle="none", label="instant centre $C$"
        )
    yield Line2D([], [], color=GREY, linestyle="--", label="pitch circles")
    yield Line2D([], [], color=GREY, linewidth=0.7, label="tip circles")
    yield Line2D([], [], color=GREY, linestyle="-.", linewidth=0.9, label="line of centres")
