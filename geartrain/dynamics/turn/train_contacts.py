"""Contacts of all pairs of a train in one load case: transmission function, friction and driving side (docs/torques.md,
section 17).

The multiplier x of a pair is the torque on its driven side in the mean sense of its rotation: drive flanks touch for
x >= 0, coast flanks for x <= 0. A flank with the efficiency eta(f) at the coefficient of friction f has the efficiency
1/eta(-f) if the driven side drives, equation (23).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np

from geartrain.dynamics.gear_meshes import PinMesh
from geartrain.dynamics.pair_speeds import pitch_line_speed, radians_per_second
from geartrain.dynamics.torques.mean_efficiencies import find_mean_efficiencies
from geartrain.teeth.friction_law import PairFriction

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.turn.position_motion import PositionMotion
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import TransmissionFunction


class ContactTorques(NamedTuple):
    """Torque on the driven link, and torque supplied by the driver, for a pair with the multiplier 1, shape (n,). Each
    is positive in the mean sense of rotation of its link.
    """

    driven: Floats
    driver: Floats
    barred: Bools | None = None
    """Boolean mask of the positions at which no power can flow; None if power can flow at all positions."""
    lean: Floats | None = None
    """Separating force divided by the tangential force [1], shape (n,); None to use the mean value."""


class PairForce(NamedTuple):
    """Torques on the first and second link of a pair with the multiplier 1, about the reference direction of parallel
    axes, shape (n,).
    """

    first: Floats
    second: Floats
    barred: Bools | None
    """Boolean mask of the positions at which no power can flow; None if power can flow at all positions."""
    lean: Floats | None = None
    """Separating force divided by the tangential force [1], shape (n,); None to use the mean value."""


class DriverState(NamedTuple):
    """Angle and speed of the driver of a pair, each of shape (n,)."""

    S: Floats
    """Angle of the driver in its mean sense of rotation [rad]; empty if no property of the pair depends on it."""
    turning: Floats
    """Speed of the driver relative to its carrier in its mean sense of rotation, divided by the input speed [1]."""


class ContactLosses:
    """Losses of a contact, which are 0 in this base class. Subclasses include the effect of friction on the torques."""

    has_friction: ClassVar[bool] = False
    """True if power is lost in the contact."""

    @property
    def starts_harder(self) -> bool:
        """True if static friction differs from sliding friction."""
        return False

    def torques(
        self, tau: Floats, transmission: TransmissionFunction | None, at: DriverState, way: Floats, static: bool
    ) -> ContactTorques:
        """Return the torque on the driven link and the torque supplied by the driver if the multiplier is 1.

        tau      speed ratio of the flank in contact, which follows from `transmission`
        at       angle and speed of the driver
        way      1 if the driver of the transmission function drives, -1 if the driven link drives, 0 without relative
                 motion
        static   True for static friction, False for sliding friction
        """
        del transmission, at, way, static
        return ContactTorques(np.ones_like(tau), tau)

    def kinks(self, at: DriverState) -> Floats | None:
        """Return values whose sign changes mark kinks of the torques but not of the speed ratio; None if there are
        none.
        """
        del at
        return None


@dataclass(frozen=True)
class BasicEfficiency(ContactLosses):
    """Declared efficiency of a pair for each driving side; 0 or less if the pair locks when that side drives."""

    has_friction: ClassVar[bool] = True
    driver: float
    driven: float

    def torques(
        self, tau: Floats, transmission: TransmissionFunction | None, at: DriverState, way: Floats, static: bool
    ) -> ContactTorques:
        """Return the torques, reduced by the efficiency of the driving side.

        If the speed ratio is negative, as on the return stroke of a pin follower, the opposite side drives.
        """
        del transmission, at, static
        ahead, back = way * tau > 0, way * tau < 0
        barred = (ahead & (self.driver <= 0)) | (back & (self.driven <= 0))
        arrives = np.where(ahead, self.driver if self.driver > 0 else 1.0, 1.0)
        returns = np.where(back, self.driven if self.driven > 0 else 1.0, 1.0)
        return ContactTorques(arrives, tau * returns, barred if barred.any() else None)


@dataclass(frozen=True)
class SlidingFriction(ContactLosses):
    """Friction of teeth or of a pin, with a coefficient of sliding friction and one of static friction."""

    has_friction: ClassVar[bool] = True
    sliding: float | Callable[[Floats, Floats], Floats]
    """Coefficient of sliding friction: a number, or a function of two speed ratios.

    The arguments of the function are the sliding speed divided by the pitch-line speed, and the driver's speed divided
    by the input speed.
    """
    static: float
    """Coefficient of static friction of the contact."""

    @property
    def starts_harder(self) -> bool:
        """True if static friction differs from sliding friction."""
        return self.sliding != self.static


@dataclass(frozen=True)
class ToothFriction(SlidingFriction):
    """Friction of teeth: each tooth pair in contact multiplies the torque by (1 + f out)/(1 + f into).

    The coefficient of friction f is negative if the driven link of the transmission function drives. `into` and `out`
    are defined in `ContactRubbing`.
    """

    turned: int = 1
    """Factor that is -1 for a pair with a ring, whose wheels turn in the same sense, and 1 for other pairs."""

    def lean(self, tau: Floats, rubbing: tuple[Floats, Floats], f: Floats, way: Floats) -> Floats:
        """Return the separating force divided by the tangential force [1], equation (29) of docs/torques.md.

        rubbing   friction terms `into` and `out` of each tooth pair, NaN for tooth pairs that are not in contact
        f         coefficient of friction, which is negative if the driven link of the transmission function drives
        """
        into, out = rubbing
        # components of the normal and of the sliding direction across the line of centres, times D/n2
        c, s = tau + self.turned, tau * into + self.turned * out
        with np.errstate(divide="ignore", invalid="ignore"):
            # the tooth pairs share the torque of the driving side equally
            normal = 1 / (1 + f * np.where(way > 0, into, out))
            apart, across = normal * (np.abs(s) - f * c * np.sign(s)), normal * (c + f * s)
        found: Floats = np.nansum(apart, axis=0) / np.abs(np.nansum(across, axis=0))
        return found

    def torques(
        self, tau: Floats, transmission: TransmissionFunction | None, at: DriverState, way: Floats, static: bool
    ) -> ContactTorques:
        """Return the torque on the driven link and the torque supplied by the driver. The tooth pairs in contact share
        the torque of the driving side equally.
        """
        assert transmission is not None
        sliding, into, out = transmission.rubbing(at.S)
        touching = ~np.isnan(out)  # NaN marks pairs of teeth that do not touch at this position
        own = self.static if static else self.sliding
        f = way * (own(sliding, np.abs(at.turning)) if callable(own) else own)
        lean = self.lean(tau, (into, out), f, way)
        with np.errstate(divide="ignore", invalid="ignore"):
            into, out = 1 + f * into, 1 + f * out
            # driving side: if friction exceeds the driving component of the contact force, the pair locks
            driving = np.where(way > 0, into, out)
            given = np.where(way > 0, out, into) / driving
        locks = (touching & (driving <= 0)).any(axis=0) | ((way > 0) & (touching & (given <= 0)).any(axis=0))
        count = touching.sum(axis=0)
        share = np.where(touching, given, 0.0).sum(axis=0) / np.maximum(count, 1)
        share = np.where((count > 0) & ~locks, share, 1.0)
        barred = locks if locks.any() else None
        return ContactTorques(np.where(way > 0, share, 1.0), tau * np.where(way < 0, share, 1.0), barred, lean)


@dataclass(frozen=True)
class PinFriction(SlidingFriction):
    """Friction of a pin in its slot, which gives the torque on the pin by equation (25) of docs/torques.md."""

    sliding: float
    transmission: PinToSlotTransmission

    def torques(
        self, tau: Floats, transmission: TransmissionFunction | None, at: DriverState, way: Floats, static: bool
    ) -> ContactTorques:
        """Return the torque on the driven link and the torque supplied by the driver, from lever arms that are finite
        even at dead points.
        """
        del transmission
        # by the law of sines sin d = e sin S / rho, so the arm is r e |sin S| / rho^2
        arm = self.transmission.r * self.transmission.e * np.abs(np.sin(at.S)) / self.transmission._reach(at.S)[1]
        return ContactTorques(np.ones_like(tau), tau + way * (self.static if static else self.sliding) * arm)

    def kinks(self, at: DriverState) -> Floats:
        """Return the sine of the driver angle. It is 0 if the pin is on the line through both axes, where the sliding
        velocity reverses.
        """
        return np.sin(at.S)


@dataclass(frozen=True)
class PairContact:
    """Torque transmission of one gear pair or coupling at any position."""

    circuit: Circuit
    first: bool
    """True if the driver of the transmission function is the circuit's first link."""
    way: int
    """Sense of the driver's mean motion relative to the carrier, about the reference direction of parallel axes.

    `sense` is the corresponding sense of the driven link.
    """
    sense: int
    ratio: float
    """Magnitude of the constant speed ratio (driven to driver speed), which is used if `source` is None."""
    losses: ContactLosses
    source: PairErrorSource | None = None
    """Source of the transmission error; None for a pair with constant ratio, which is not evaluated at positions."""

    @property
    def name(self) -> str:
        """Name of the pair or coupling."""
        return self.circuit.id

    @property
    def kind(self) -> str:
        """Kind of the contact: `mesh` or `pin`."""
        return "mesh" if self.circuit.kind == "gear" else "pin"

    @property
    def ends(self) -> tuple[str, str]:
        """Names of the driver of the transmission function and of the driven link."""
        i, j = self.circuit.i, self.circuit.j
        return (i, j) if self.first else (j, i)

    @property
    def bases(self) -> tuple[str, str]:
        """Links whose speeds are subtracted from the speeds of the two `ends`; usually the carrier."""
        i, j = self.circuit.subtracted
        return (i, j) if self.first else (j, i)

    @property
    def two_sided(self) -> bool:
        """True if the two flanks have different transmission functions, or if friction depends on the driving side."""
        return self.losses.has_friction or self.has_flanks

    @property
    def has_flanks(self) -> bool:
        """True for teeth, which have drive and coast flanks with backlash; False for pins."""
        return self.source is not None and self.source.transmission.reversed_motion() is not self.source.transmission

    def torques(self, side: int, at: DriverState, static: bool = False) -> PairForce:
        """Return the torques on both links if the pair's multiplier is 1, about the reference direction of parallel
        axes.

        side     1 for the drive flanks, -1 for the coast flanks
        static   True for static friction, False for sliding friction
        """
        transmission = (
            None
            if self.source is None
            else self.source.transmission
            if side > 0
            else self.source.transmission.reversed_motion()
        )
        tau = np.full(len(at.turning), self.ratio) if transmission is None else transmission.speed(at.S)
        # the driving side follows from the flank and from the sense of motion
        found = self.losses.torques(tau, transmission, at, side * np.sign(at.turning), static)
        driven, driver = self.sense * found.driven, -self.way * found.driver
        both = (driver, driven) if self.first else (driven, driver)
        return PairForce(*both, found.barred, found.lean)


def followed_pairs(setting: LoadCase, teeth: Mapping[str, GearMesh]) -> set[str]:
    """Return the names of the pairs whose speed ratio or losses depend on their position."""
    names = {circuit.id for circuit in setting.circuits}
    uneven = {name for name, mesh in teeth.items() if not mesh.rigid or _by_friction(setting, mesh)}
    return names & {*uneven, *setting.joints}


def find_contacts(
    setting: LoadCase, positions: PositionMotion, teeth: Mapping[str, GearMesh]
) -> dict[str, PairContact]:
    """Return the contact of every pair and coupling, by name.

    positions   motion of the train, with the pairs that are evaluated at every position; other pairs have a constant
                ratio
    teeth       meshes with a declared tooth form; the driver of a mesh is the driver of its transmission function
    """
    found = {}
    for circuit in setting.circuits:
        source, mesh = positions.sources.get(circuit.id), teeth.get(circuit.id)
        first = circuit.kind == "gear" and (mesh is None or mesh.driver == circuit.wheels[0])
        if circuit.kind == "gear":
            losses = _gear_losses(setting, circuit, first, source, mesh)
        else:
            losses = _coupling_losses(setting, circuit)
        if source is None:
            own, other = (circuit.a, circuit.b) if first else (circuit.b, circuit.a)
            sense = -1 if circuit.a * circuit.b > 0 else 1
            found[circuit.id] = PairContact(circuit, first, 1, sense, abs(own / other), losses)
        else:
            way, sense = positions.way * source.forward, positions.way * source.sense
            ratio = float(source.transmission.ratio)
            found[circuit.id] = PairContact(circuit, first, way, sense, ratio, losses, source)
    return found


def mean_friction_pairs(
    setting: LoadCase, sources: Mapping[str, PairErrorSource], teeth: Mapping[str, GearMesh]
) -> Iterator[str]:
    """Yield the names of redundant pairs with tooth friction. The phase of their teeth is unknown, so the mean value of
    friction over a pitch is used.
    """
    names = {circuit.id for circuit in setting.circuits} - sources.keys()
    return (name for name in teeth if name in names and _by_friction(setting, teeth[name]))


def _by_friction(setting: LoadCase, mesh: GearMesh) -> bool:
    gear = setting.gears[mesh.name]
    return gear.efficiency is None and setting.has_friction(gear)


def _coupling_losses(setting: LoadCase, circuit: Circuit) -> ContactLosses:
    coupling, joint = setting.couplings[circuit.id], setting.joints.get(circuit.id)
    if (declared := coupling.losses) is not None:
        driver, driven = float(declared.forward.base), float(declared.backward.base)
        return ContactLosses() if driver == driven == 1 else BasicEfficiency(driver, driven)
    friction = setting.train.friction_of(coupling)
    if not isinstance(joint, PinMesh) or friction is None or not friction.has_friction:
        return ContactLosses()
    return PinFriction(joint.transmission.friction, friction.static, joint.transmission)


def _gear_losses(
    setting: LoadCase, circuit: Circuit, first: bool, source: PairErrorSource | None, mesh: GearMesh | None
) -> ContactLosses:
    """Return the losses of a gear pair, due to tooth friction at each position or to a constant efficiency."""
    if source is None or mesh is None or not _by_friction(setting, mesh):
        means = find_mean_efficiencies(setting, circuit).load
        driver, driven = (float(each) for each in (means if first else means[::-1]))
        return ContactLosses() if driver == driven == 1 else BasicEfficiency(driver, driven)
    transmission, coefficient = mesh.wheels.friction_law, mesh.friction or 0.0
    turned = -1 if any(mesh.wheels.internal) else 1
    declared = setting.train.friction_of(setting.gears[circuit.id]) if mesh.has_shape else None
    static = coefficient if declared is None else declared.static
    if transmission is None:
        return ToothFriction(coefficient, static, turned)
    # proportional to the driver's speed, which varies with the position
    pitch_line = (pitch_line_speed(setting, circuit, mesh) or 0.0) / (source.mean or 1.0)
    law = PairFriction
    return ToothFriction(lambda sliding, turning: law(transmission, pitch_line * turning)(sliding), static, turned)


class BearingTorques(NamedTuple):
    """Friction torques of a bearing in motion and at rest, and its viscous drag torque at the input speed. The drag
    torque is proportional to the speed of the bearing divided by the input speed.
    """

    sliding: float
    static: float
    drag: float = 0.0
    radius: float = 0.0
    """Load-dependent friction torque per unit of bearing load [m]. This torque is added to the sliding and to the
    static friction torque.
    """


def find_bearings(setting: LoadCase) -> dict[str, BearingTorques]:
    """Return the friction torques of each link's bearing that has friction, by link. Viscous drag is included if speeds
    and torques have units.
    """
    train, unit = setting.train, _radians_per_second(setting)
    found = {}
    for link, part in train.links.items():
        sliding, static = (0.0, 0.0) if part.bearing is None else (
            float(part.bearing.sliding.base), float(part.bearing.at_rest.base)
        )  # fmt: skip
        drag = 0.0 if part.drag is None else part.drag.si * (unit or 0.0)
        each = BearingTorques(sliding, static, drag, part.friction_radius)
        if link != train.frame and any(each):
            found[link] = each
    return found


def dragging_links(setting: LoadCase) -> tuple[str, ...]:
    """Return the links whose viscous drag is neglected because speeds or torques have no units."""
    links = tuple(link for link, part in setting.train.links.items() if part.drag is not None and part.drag.si)
    return () if _radians_per_second(setting) else links


def _radians_per_second(setting: LoadCase) -> float | None:
    """Return the magnitude of the input speed [rad/s]; None if speeds or torques are numbers without a unit."""
    unit = radians_per_second(setting.train, setting.case)
    driving_speed = next((speed for speed in setting.case.inputs.values() if speed), None)
    if unit is None or driving_speed is None or not setting.train.has_torque_units(setting.case.state):
        return None
    return unit * abs(float(driving_speed))
