"""Lobed disc that rolls in a ring of round pins: outline, loads on the pins, losses, and the mesh that a train uses.

Lengths are in modules: pitch radii are half the tooth numbers, and the centre of the disc is half a module from the
centre of the ring. The centre of a pin describes a shortened epitrochoid in the frame of the disc. The outline of the
disc is offset inwards from that curve by the radius of a pin. Every contact normal passes through the pitch point. Half
of all pins press at once, or fewer if a clearance and the deflection of a pin are given (docs/reducers.md, (1) to (7)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import cos, degrees, inf, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import PairSize
from geartrain.teeth.outlines.wheel_requirement import FixedTooth, LanternPins
from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, PairVerdict, motion_figures
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing, ExactRatio, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

_SAMPLES = 4096  # points of a lobe at which the maximum curvature is searched for
_MIN_CHORDS, _MAX_CHORDS = 16, 4096  # minimum and maximum number of chords of a lobe
_PHASES = 64  # positions in a pitch for means and extrema
_RING_CLEARANCE = 0.1  # modules: clearance between the lobes and the ring behind the pins
_WORDS = (
    "Lobed discs in rings of pins, each in the frame of its eccentric. Shortening: pitch radius of the ring divided by "
    "the radius of the pin circle. Bearing: number of pins that bear load at once, reduced by a clearance if the "
    "`deflection` of a pin is given. Max load: maximum load on one pin divided by the force on the disc's pitch "
    "circle, for pins of equal stiffness. Backlash: in degrees of the driven wheel. Efficiency: for pins that do not "
    "roll, as the pair is driven, and driven back."
)
_HEADER = (
    *("pair", "drives", "lobes", "pins", "shortening", "pin radius", "bearing", "max load", "backlash (deg)"),
    *("efficiency", "driven back"),
)


@dataclass(frozen=True)
class CycloidalDisc:
    """Lobed disc of a cycloidal reducer, and the ring of pins in which the disc rolls. Lengths are in modules."""

    lobes: int
    """Number of lobes of the disc. The ring has one pin more than the disc has lobes."""
    circle: float
    """Radius of the circle through the centres of all pins [module]."""
    pin: float
    """Radius of a pin [module]."""
    clearance: float = 0.0
    """Distance by which the outline of the disc is offset inwards from every pin [module]."""
    deflection: float | None = None
    """Deflection of one pin under the whole force on the pitch circle of the disc [module].

    If it is None, all pins that can push the disc are loaded in proportion to their lever arms, as if there were no
    clearance.
    """

    @property
    def pins(self) -> int:
        """Number of pins of the ring."""
        return self.lobes + 1

    @property
    def shortening(self) -> float:
        """Pitch radius of the ring divided by the radius of the pin circle, docs/reducers.md (1). It is less than 1."""
        return self.pins / 2 / self.circle

    def centres(self, turn: Floats) -> Floats:
        """Return the positions of a pin's centre in the frame of the disc [module], as complex numbers x + iy,
        docs/reducers.md (2).

        turn   angle of the eccentric [rad]
        """
        found: Floats = self.circle * np.exp(1j * turn / self.lobes) - np.exp(1j * turn * self.pins / self.lobes) / 2
        return found

    def outline(self, turn: Floats) -> Floats:
        """Return the points of the disc's outline [module], as complex numbers x + iy, docs/reducers.md (3).

        turn   angle of the eccentric [rad]
        """
        found: Floats = self.centres(turn) + (self.pin + self.clearance) * self._inward_normals(turn)
        return found

    def _inward_normals(self, turn: Floats) -> Floats:
        """Return unit normals of the outline at the angles `turn`, as numbers x + iy, from the pins into the disc."""
        to_pitch_point = self.pins / 2 * np.exp(1j * turn) - self.circle
        found: Floats = np.exp(1j * turn / self.lobes) * to_pitch_point / np.abs(to_pitch_point)
        return found

    @cached_property
    def sharpest(self) -> float:
        """Minimum radius of curvature [module] of the convex parts of the curve of a pin's centre in the frame of the
        disc.

        The radius of a pin must be smaller than this value, because a larger pin undercuts the lobes. The value is
        infinite if no part is convex.
        """
        bent = self._centre_curvature(np.linspace(0, 2 * pi, _SAMPLES))
        return 1 / float(bent.max()) if bent.max() > 0 else inf

    def _centre_curvature(self, turn: Floats) -> Floats:
        """Return the curvature of the curve of a pin's centre in the disc's frame [1/module]; positive if convex."""
        # first and second derivative of `centres` with respect to the angle of the eccentric
        z, e, R = self.lobes, 0.5, self.circle
        slow, fast = np.exp(1j * turn / z), np.exp(1j * turn * (z + 1) / z)
        first = 1j * (R / z * slow - e * (z + 1) / z * fast)
        second = -R / z**2 * slow + e * ((z + 1) / z) ** 2 * fast
        found: Floats = (np.conj(first) * second).imag / np.abs(first) ** 3
        return found

    def curvature(self, angle: Floats) -> Floats:
        """Return the curvature of the outline [1/module] at the contact with a pin, negative where the outline is
        concave.

        angle   angle of the pin from the pitch point, about the axis of the ring [rad]
        """
        # curvature of the parallel curve at the distance of a pin radius and the clearance
        bent = self._centre_curvature(angle)
        found: Floats = bent / (1 - bent * (self.pin + self.clearance))
        return found

    # ------------------------------------------------------------------------------------------------------- contacts

    def distance(self, angle: Floats) -> Floats:
        """Return the distance [module] from the pitch point to the centre of a pin.

        angle   angle of the pin from the pitch point, about the axis of the ring [rad]
        """
        a, R = self.pins / 2, self.circle
        found: Floats = np.sqrt(R**2 + a**2 - 2 * R * a * np.cos(angle))
        return found

    def arms(self, angle: Floats) -> Floats:
        """Return the lever arms [module] of the contact normals about the centre of the disc, docs/reducers.md (4), for
        pins at the given angles from the pitch point [rad]; 0 for pins that cannot push the disc forwards.
        """
        found: Floats = np.maximum(self.lobes / 2 * self.circle * np.sin(angle) / self.distance(angle), 0.0)
        return found

    def loads(self, phase: Floats) -> Floats:
        """Return the forces on all pins, divided by the tangential force at the disc's pitch circle, as an array (pins,
        ...), docs/reducers.md (5).

        phase   angle of one pin from the line of centres [rad]
        """
        arms = self.arms(self.angles(phase))
        if self.clearance and self.deflection is not None:
            return np.maximum(self._loaded_angle(arms) * arms - self.clearance, 0.0) / self.deflection
        # pins of equal stiffness: the deflection at a pin is proportional to its lever arm
        found: Floats = arms * self.lobes / 2 / (arms**2).sum(axis=0)
        return found

    def _loaded_angle(self, arms: Floats) -> Floats:
        """Return the rotation [rad] of the disc under load at which the pins in contact carry the whole torque,
        docs/reducers.md (7). Pins with longer lever arms come into contact first.
        """
        assert self.deflection is not None
        ordered = -np.sort(-arms, axis=0)
        torque = self.deflection * self.lobes / 2
        angles = (torque + self.clearance * np.cumsum(ordered, axis=0)) / np.cumsum(ordered**2, axis=0)
        following = np.concatenate([ordered[1:], np.zeros_like(ordered[:1])])
        # the number of loaded pins is the smallest for which the next pin remains unloaded
        enough = angles * following <= self.clearance
        found: Floats = np.take_along_axis(angles, enough.argmax(axis=0)[None], axis=0)[0]
        return found

    @property
    def _phases(self) -> Floats:
        """Equally spaced angles of one pin from the line of centres, which cover a pitch [rad]."""
        return np.linspace(0, 2 * pi / self.pins, _PHASES, endpoint=False)

    @cached_property
    def bearing_pins(self) -> tuple[int, int]:
        """Minimum and maximum number of pins that carry load at the same time."""
        loads = self.loads(self._phases)
        # the lever arm of a pin on the line of centres is 0 except for rounding error
        number = (loads > 1e-9 * loads.max()).sum(axis=0)
        return int(number.min()), int(number.max())

    def angles(self, phase: Floats) -> Floats:
        """Return the angles of all pins from the pitch point [rad], shape (pins, ...); one pin is at `phase`."""
        each = 2 * pi / self.pins * np.arange(self.pins)
        found: Floats = each.reshape(-1, *[1] * np.ndim(phase)) + phase
        return found

    def sliding(self, phase: Floats) -> tuple[Floats, Floats]:
        """Return two quantities: the load-weighted mean sliding speed divided by the pitch-line speed, and the power
        loss divided by both the output power and the friction coefficient.

        phase   angle of one pin from the line of centres [rad]
        """
        angles = self.angles(phase)
        # distance of the contact from the pitch point times the relative angular velocity 2/z1 - 2/z2 = 2/(z1 z2)
        reach = (self.distance(angles) - self.pin) / (self.lobes / 2) / self.pins
        loads = self.loads(phase)
        lost = (loads * reach).sum(axis=0)
        return lost / loads.sum(axis=0), lost

    @cached_property
    def maximum_load(self) -> float:
        """Maximum force on a pin divided by the tangential force at the disc's pitch circle."""
        return float(self.loads(self._phases).max())

    @property
    def loss(self) -> float:
        """Mean power loss over a pitch, divided by both the output power and the friction coefficient."""
        return float(self.sliding(self._phases)[1].mean())

    # ---------------------------------------------------------------------------------------------------------- teeth

    def lobe(self, tolerance: float) -> FixedTooth:
        """Return one lobe, symmetric about the x axis, as at most 4096 chords inside the lobe, so that they do not
        touch the pins. `tolerance` is the maximum distance of a chord from the lobe [module].
        """
        # doubled, because the excess of a chord falls with the square of their number
        number = _MIN_CHORDS
        while np.abs(self._chord_excess(number)).max() > tolerance and number < _MAX_CHORDS:
            number *= 2
        # both ends of a chord move inwards by the larger excess of the chords that they join
        out = np.maximum(self._chord_excess(number), 0.0)
        turn = np.linspace(0, 2 * pi, number, endpoint=False)
        points = self.outline(turn) + np.maximum(out, np.roll(out, 1)) * self._inward_normals(turn)
        # the outline begins at the bottom between two lobes
        points *= np.exp(-1j * pi / self.lobes)
        tooth = tuple((float(point.real), float(point.imag), 0.0) for point in points)
        # the tip of a lobe is where the eccentricity of half a module adds to the radius of the pin circle
        tip = self.circle + 0.5 - self.pin - self.clearance
        return FixedTooth("external", tip, float(np.abs(points[0])), tooth)

    def _chord_excess(self, number: int) -> Floats:
        """Return the distances [module] by which the midpoints of `number` chords around the disc are outside its
        outline; negative inside.
        """
        turn = np.linspace(0, 2 * pi, 2 * number + 1)
        points = self.outline(turn)
        off = points[1::2] - (points[:-1:2] + points[2::2]) / 2
        found: Floats = (off * np.conj(self._inward_normals(turn[1::2]))).real
        return found

    def pin_tooth(self) -> FixedTooth:
        """Return one pin, symmetric about the x axis, as a tooth of the ring (gear 2). It consists of a half circle and
        the part that joins it to the ring.
        """
        # lobes reach farthest out on the line of centres, where the eccentricity of half a module is added
        root = max(self.circle, self.circle + 1 - self.pin - self.clearance + _RING_CLEARANCE)
        R, r = self.circle, self.pin
        if root > R:  # the sides are straight from the centre of the pin outwards
            side = pi / 2
            start = (R, r)
        else:
            open_ = 2 * np.arcsin(r / (2 * R))
            side, start = (pi - open_) / 2, (R * cos(open_), R * sin(open_))
        foot = (sqrt(root**2 - start[1] ** 2), start[1]) if root > R else start
        across = 2 * pi / self.pins - 2 * float(np.arctan2(foot[1], foot[0]))
        points = [(foot[0], -foot[1], 0.0)] if root > R else []
        points += [(start[0], -start[1], -tan(side / 2)), (start[0], start[1], 0.0)]
        points += [(foot[0], foot[1], 0.0)] if root > R else []
        tooth = [(float(x), float(y), float(bulge)) for x, y, bulge in points]
        tooth[-1] = (*tooth[-1][:2], tan(across / 4))
        return FixedTooth("ring", R - r, root, tuple(tooth), LanternPins(2, R, r))


class DiscTransmission(ExactRatio, ToothTransmission):
    """Transmission function of a disc in its ring of pins, relative to the eccentric. The ratio is exact.

    `driver` is 1 if the disc drives, 2 if the ring drives; `direction` -1 reverses the motion, so that the coast flanks
    are in contact.
    """

    def __init__(self, disc: CycloidalDisc, friction: float = 0.0, driver: int = 1, direction: int = 1) -> None:
        self.disc, self.driver, self.direction = disc, driver, direction
        self.friction = check_friction(friction)
        z1, z2 = (disc.lobes, disc.pins) if driver == 1 else (disc.pins, disc.lobes)
        # rad of the driven wheel: the clearance on both flanks at the pitch radius z2 / 2
        self._backlash = 4 * disc.clearance / z2
        # the coast flanks are ahead by the backlash
        super().__init__(Fraction(z1, z2), 2 * pi / z1, self._backlash if direction < 0 else 0.0)

    @property
    def verdict(self) -> PairVerdict:
        """Verdict on the pair: always "runs", because impossible discs are rejected when they are declared."""
        return PairVerdict("runs", "the teeth run", self._backlash, ())

    def _driven(self, driver: int, direction: int) -> DiscTransmission:
        return DiscTransmission(self.disc, self.friction, driver, direction)

    def _phase(self, S: ArrayLike) -> Floats:
        """Return the angle of a pin from the line of centres [rad] at driver angles S [rad]. At S = 0, this angle is 0
        if the ring drives, and half a pin pitch if the disc drives.
        """
        S = self.direction * np.asarray(S, dtype=float)
        found: Floats = S if self.driver == 2 else S * self.disc.lobes / self.disc.pins + pi / self.disc.pins
        return found

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speed of all pins at driver angles S [rad], weighted by their loads, and the changes of
        the input and output power per unit friction coefficient. All pins are combined into one contact.
        """
        speed, lost = self.disc.sliding(self._phase(S))
        # the load is given on the driven side, so the loss is added to the input power
        return ContactRubbing(speed[None], lost[None], np.zeros_like(lost)[None])


# ------------------------------------------------------------------------------------------------------ pair of a train


@dataclass(frozen=True)
class DiscFigures(PairFigures):
    """Results of a lobed disc in its ring of pins: the results in `PairFigures`, and sizes and loads of the pins."""

    KEYS = (*PairFigures.KEYS, "shortening", "pin_radius", "maximum_load", "bearing")

    shortening: float
    """Pitch radius of the ring divided by the radius of the pin circle."""
    pin_radius: float
    """Radius of a pin [module]."""
    maximum_load: float
    """Maximum force on a pin divided by the tangential force at the disc's pitch circle."""
    bearing: tuple[int, int]
    """Minimum and maximum number of pins that carry load at the same time."""


@dataclass(frozen=True)
class DiscMesh(GearMesh):
    """Mesh of a cycloidal disc and its ring of pins. The disc is gear 1."""

    transmission: DiscTransmission

    @property
    def gears(self) -> tuple[str, str]:
        """Names of the disc and of its ring of pins, in this order."""
        first, second = self.gear.pair
        return (second, first) if self.wheels.internal[0] else (first, second)

    @property
    def tooth_phase(self) -> float:
        """Distance [pitch] of a lobe past the line of centres at the disc angle 0: (1 - `backlash`) / 2."""
        return (1 - self.backlash) / 2

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Return the size of the pair. Lengths are in modules, and the centre distance is half a module. The tip radii
        `tips` are not needed.
        """
        del tips
        return PairSize(1.0, 0.5, 1.0)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """Return a lobe if `wheel` is the disc, or a pin if it is the ring. The chords of a lobe deviate from it by at
        most `tolerance` [module]; `scale` is not used.
        """
        del scale
        return self.transmission.disc.lobe(tolerance) if wheel == self.gears[0] else self.transmission.disc.pin_tooth()

    def account(self) -> PairAccount:
        """Return the report on the pair: sizes, maximum pin load, backlash and efficiency."""
        disc = self.transmission.disc
        fewest, most = disc.bearing_pins
        figures = DiscFigures(
            self.counts,
            self.verdict,
            *motion_figures(self.transmission),
            self.efficiency(self.driver),
            disc.shortening,
            disc.pin,
            disc.maximum_load,
            disc.bearing_pins,
        )
        row = (
            *(self.name, f"{self.driver} -> {self.driven}", str(disc.lobes), str(disc.pins)),
            *(f"{disc.shortening:.4g}", f"{disc.pin:.4g}", str(most) if fewest == most else f"{fewest} to {most}"),
            f"{disc.maximum_load:.4g}",
            *(f"{degrees(self.verdict.backlash):.4g}", *self.efficiency_texts),
        )
        return PairAccount(_WORDS, (AccountTable(_HEADER, row, wide=True),), figures)
