"""Effects that a balance of mean torques neglects: the table in section 13 of docs/torques.md.

Some bearings reverse within a revolution although their mean speed is constant. Interval bounds find them, equation
(21). Each nonuniform pair adds g (tau(S) - m) w to the mean speed of every link. Here g is its gain at the link, tau
its speed ratio at the angle S of its driver, m the mean ratio, and w the speed of its driver relative to the carrier.
Gains are exact, and the bounds of w widen from pair to pair. So a bearing in the result may reverse, and a bearing that
is not in the result does not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.load_case import LoadCase, MeanEfficiencies
from geartrain.dynamics.torques.mean_efficiencies import all_mean_efficiencies
from geartrain.dynamics.torques.torque_results import NeglectedEffect
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.elimination import LinearForm, eliminate
from geartrain.numerics.exact import decimal, nearest_float

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction


_MOST_NONUNIFORM = 300  # nonuniform pairs: the gains of n pairs at n links are n squared numbers
_SLACK = 1e-12  # of a speed: smaller reversals are rounding
_NO_FORM = (
    "the loss of these teeth depends on their form, which is not declared: give a `tooth_form` or an `efficiency`"
)
_NO_SLIDING = "a given transmission error has no sliding speed: give the `efficiency` of the tooth form or of the pair"
_NO_HELIX = (
    "these teeth slide along their length, and their helix angles or their friction are not known: declare the "
    "`helix_angle` of the worm, or of both wheels on crossed axes, and a constant `friction`; or an `efficiency`"
)
_MEAN = "the reported torques are means over a turn"


@dataclass(frozen=True)
class _NonuniformPair:
    """Pair with a variable speed ratio tau and mean ratio m. Its Willis equation contains a factor times (tau - m)
    times the speed of its driver.
    """

    id: str
    transmission: TransmissionFunction | None
    """Transmission function; None if it is unknown, as for a pin without dimensions or teeth that cannot turn."""
    driver: str
    """Driving link, whose speed is relative to `carrier`. `mean` is the mean speed ratio m."""
    carrier: str
    factor: Fraction
    mean: Fraction

    @property
    def swing(self) -> tuple[float, float]:
        """Bounds of tau - m, the deviation of the speed ratio from its mean."""
        if self.transmission is None:
            return -inf, inf
        low, high = self.transmission.speed_range()
        return low - float(self.mean), high - float(self.mean)


def find_reversing_bearings(setting: LoadCase, links: Sequence[str]) -> Mapping[str, tuple[float, float]] | None:
    """Return minimum and maximum speed of the links that may reverse in their bearings; None if there are too many
    nonuniform pairs.
    """
    nonuniform = list(_nonuniform_pairs(setting))
    if len(nonuniform) > _MOST_NONUNIFORM:
        return None
    if not nonuniform or not links:
        return {}
    import numpy as np

    gains = _gains(setting, nonuniform)

    def bounds(link: str, carrier: str, added: Floats) -> Floats:
        """Return the bounds of a relative speed; `added` has the bounds of each pair's speed deviation, shape (2,
        pairs).
        """
        mean = setting.relative(link, carrier)
        if mean is None:
            return np.array([-inf, inf])
        gain = gains[link] - gains[carrier]
        # a pair without effect may have infinite bounds, and 0 times infinity is NaN
        ends = np.where(gain, gain * added, 0.0)
        return nearest_float(mean) + np.array([ends.min(axis=0).sum(), ends.max(axis=0).sum()])

    swings, added = np.array([each.swing for each in nonuniform]).T, np.zeros((2, len(nonuniform)))
    with np.errstate(invalid="ignore"):
        # without cyclic dependencies each round fixes one more pair, and the last round changes nothing
        for _ in range(len(nonuniform) + 1):
            turning = np.array([bounds(each.driver, each.carrier, added) for each in nonuniform]).T
            products = np.nan_to_num(swings[:, None] * turning, nan=0.0, posinf=inf, neginf=-inf).reshape(4, -1)
            wider = np.stack([products.min(axis=0), products.max(axis=0)])
            if (wider == added).all():
                break
            added = wider
        else:
            added = np.full_like(added, inf) * [[-1], [1]]
        found = {link: tuple(bounds(link, setting.tree.borne_by(link), added).tolist()) for link in links}
    return {
        link: (low, high)
        for link, (low, high) in found.items()
        if low < -_SLACK * abs(high) and high > _SLACK * abs(low)
    }


def _nonuniform_pairs(setting: LoadCase) -> Iterator[_NonuniformPair]:
    for circuit in setting.circuits:
        if circuit.swings:
            joint = setting.joints.get(circuit.id)
            transmission = joint.transmission if joint else None
            yield _NonuniformPair(
                circuit.id, transmission, circuit.j, circuit.subtracted[1], Fraction(circuit.a), Fraction(-circuit.b)
            )
            continue
        tooth = setting.meshes.get(circuit.id)
        if tooth is None or tooth.rigid:
            continue
        # the row a w_i + b w_j = 0 deviates by -own / mean times (tau - mean) times the driver's speed
        first = tooth.driver == circuit.wheels[0]
        driver, own = (circuit.i, circuit.a) if first else (circuit.j, circuit.b)
        mean = Fraction(tooth.transmission.ratio)
        yield _NonuniformPair(
            circuit.id, tooth.transmission if tooth.verdict else None, driver, circuit.subtracted[0], -own / mean, mean
        )


def _gains(setting: LoadCase, nonuniform: Sequence[_NonuniformPair]) -> Mapping[str, Floats]:
    """Return the speed that a unit speed deviation of each pair adds to each link while the inputs turn uniformly."""
    import numpy as np

    number = {each.id: at for at, each in enumerate(nonuniform)}
    system = setting.system
    column = {link: at for at, link in enumerate(system.links)}
    rows: list[LinearForm] = []
    for row in system.equations:
        form: LinearForm = {column[link]: Fraction(value) for link, value in row.terms}
        if row.kind not in ("input", "fixed", "lock", "frame") and row.label in number:
            # the deviation of the pair is a symbol, with inputs fixed
            form[-1 - number[row.label]] = -nonuniform[number[row.label]].factor
        rows.append(form)
    forms = eliminate(rows).forms()
    found = {link: np.zeros(len(nonuniform)) for link in column}
    for link, at in column.items():
        for key, value in forms.get(at, {}).items():
            if key < 0:
                found[link][-1 - key] = setting.sense(link) * nearest_float(value)
    return found


def find_neglected_effects(
    setting: LoadCase,
    means: Mapping[str, MeanEfficiencies],
    neither: Sequence[str],
    idle: Sequence[str],
    bearings: bool,
) -> tuple[NeglectedEffect, ...]:
    """Return all effects that the mean torques of one load case neglect.

    neither   pairs neither of whose torques is constant over a revolution
    idle      pairs without torque, which have no losses
    bearings  False if friction of bearings was not requested
    """
    busy = [circuit for circuit in setting.circuits if circuit.id not in set(idle)]
    found = [*_pins(setting, busy), *_teeth(setting, busy, means), *_open(setting, busy, means)]
    found += _of_couplings(setting, busy)
    found += _bearings(setting) if bearings else _all_bearings(setting)
    shared = tuple(circuit.id for circuit in busy if circuit.id in set(neither))
    if shared:
        why = (
            "neither torque of these pairs is constant within a turn, so their mean efficiency depends on other pairs; "
            "the value for a constant load torque is used, or for a constant driving torque where loads drive"
        )
        found.append(NeglectedEffect("mean efficiency", shared, why))
    return (*found, *_drag(setting), *_variation(setting, busy), *_inertia(setting))


def _drag(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Yield the viscous drag of links, which a balance of exact means does not include."""
    if links := tuple(link for link, part in setting.train.links.items() if part.drag is not None and part.drag.value):
        yield NeglectedEffect(
            "viscous drag", links, "it depends on speed: torques over a turn include it if speeds have units"
        )


def neglected_over_turn(setting: LoadCase, at_means: Sequence[str]) -> tuple[NeglectedEffect, ...]:
    """Return the effects that torques over a revolution neglect.

    Torques over a revolution include friction of pins and bearings, and their variation, if the data are declared.

    at_means   pairs with a declared tooth form that have their mean efficiency at all positions
    """
    found = [
        *_pins_without_dimensions(setting, setting.circuits),
        *_teeth(setting, setting.circuits, all_mean_efficiencies(setting)),
        *_of_couplings(setting, setting.circuits),
        *_inertia(setting),
    ]
    if jumpers := tuple(each.name for each in setting.train.couplings if each.friction_torque):
        found.append(NeglectedEffect("friction of jumpers", jumpers, "it is known as a mean over a turn only"))
    if at_means:
        why = "these pairs are redundant, so the phase of their teeth is not known: mean efficiencies are used"
        found.append(NeglectedEffect("variation within a turn", tuple(at_means), why))
    return tuple(found)


def _pins(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Yield the friction of pins in followers, and of pins in slots without declared dimensions."""
    bearing_friction = _rubbing_pins(setting, busy)
    if swinging := tuple(circuit.id for circuit in bearing_friction if not circuit.b):
        why = "a follower only oscillates and transmits no mean power, so its friction has no efficiency"
        yield NeglectedEffect("friction of pins", swinging, why)
    yield from _pins_without_dimensions(setting, [circuit for circuit in bearing_friction if circuit.b])


def _of_couplings(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Yield the effects of couplings that are not computed, such as the side loads of joints."""
    named: dict[tuple[str, str], list[str]] = {}
    for circuit in busy:
        if circuit.kind != "gear" and (effect := setting.couplings[circuit.id].NEGLECTED) is not None:
            named.setdefault(effect, []).append(circuit.id)
    yield from (NeglectedEffect(what, tuple(names), why) for (what, why), names in named.items())


def _pins_without_dimensions(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    if bare := tuple(circuit.id for circuit in _rubbing_pins(setting, busy) if circuit.id not in setting.joints):
        why = "it depends on `pin_radius` and `offset`, which are not declared"
        yield NeglectedEffect("friction of pins", bare, why)


def _rubbing_pins(setting: LoadCase, busy: Sequence[Circuit]) -> list[Circuit]:
    """Return the circuits of pins with friction."""
    pins = {pin.name for pin in setting.train.pin_couplings if setting.has_friction(pin)}
    return [circuit for circuit in busy if circuit.id in pins]


def _teeth(
    setting: LoadCase, busy: Sequence[Circuit], means: Mapping[str, MeanEfficiencies]
) -> Iterator[NeglectedEffect]:
    """Yield the friction declared for teeth without a tooth form, and for worms with unknown helix angle."""
    bare: dict[str, list[str]] = {_NO_FORM: [], _NO_HELIX: [], _NO_SLIDING: []}
    for circuit in busy:
        gear, mesh = setting.gears.get(circuit.id), setting.meshes.get(circuit.id)
        if gear is not None and gear.efficiency is None and mesh is not None and not mesh.has_shape:
            friction = setting.train.friction_of(gear)
            if friction is not None and friction.has_friction and not mesh.computes_losses:
                bare[_NO_SLIDING].append(circuit.id)
        if gear is None or gear.efficiency is not None or circuit.id in setting.meshes:
            continue
        has_friction = setting.has_friction(gear) and means[circuit.id] == MeanEfficiencies()
        if has_friction and setting.turn(circuit) != 0:
            bare[_NO_HELIX if _slides(setting, circuit) else _NO_FORM].append(circuit.id)
    for why, names in bare.items():
        if names:
            yield NeglectedEffect("friction of teeth", tuple(names), why)


def _slides(setting: LoadCase, circuit: Circuit) -> bool:
    """Return True if a pair is a worm drive or a pair of crossed helical gears, whose tooth forms have no mean loss."""
    wheels = [setting.train.wheels[name][1] for name in circuit.wheels]
    helical = any(wheel.is_helical for wheel in wheels) and not setting.axes.are_parallel(setting.axis_labels(circuit))
    return helical or any(wheel.kind == "worm" for wheel in wheels)


def _open(
    setting: LoadCase, busy: Sequence[Circuit], means: Mapping[str, MeanEfficiencies]
) -> Iterator[NeglectedEffect]:
    """Yield the losses of pairs whose relative speed is undetermined."""
    found = tuple(
        circuit.id
        for circuit in busy
        if (means[circuit.id] != MeanEfficiencies() or _at_no_speed(setting, circuit)) and setting.turn(circuit) is None
    )
    if found:
        yield NeglectedEffect("losses of pairs", found, "their driving side depends on speeds that are not determined")


def _at_no_speed(setting: LoadCase, circuit: Circuit) -> bool:
    tooth = setting.meshes.get(circuit.id)
    declared = circuit.kind == "gear" and setting.gears[circuit.id].efficiency is not None
    return tooth is not None and not declared and tooth.wheels.friction_law is not None


def _bearing_friction(setting: LoadCase) -> list[str]:
    return [link for link in setting.train.links if setting.bearing(link)]


def _all_bearings(setting: LoadCase) -> Iterator[NeglectedEffect]:
    if bearing_friction := _bearing_friction(setting):
        why = "it does not depend on the load, so it is not part of an efficiency"
        yield NeglectedEffect("friction of bearings", tuple(bearing_friction), why)


def _bearings(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Yield the bearings whose sense of rotation is undetermined or changes within a revolution."""
    bearing_friction = _bearing_friction(setting)
    free = tuple(link for link in bearing_friction if setting.relative(link, setting.tree.borne_by(link)) is None)
    if free:
        yield NeglectedEffect("friction of bearings", free, "their sense of rotation is not determined")
    known = [link for link in bearing_friction if link not in free]
    back = find_reversing_bearings(setting, known)
    if back is None:
        why = "it is computed at the mean speeds; the train has too many nonuniform pairs to find reversing bearings"
        yield NeglectedEffect("friction of bearings that reverse", tuple(known), why)
        return
    for link, (low, high) in back.items():
        mean = setting.relative(link, setting.tree.borne_by(link)) or Fraction(0)
        why = (
            f"it is computed at the mean speed {decimal(mean, 4)}, but the speed varies from {low:.4g} to {high:.4g} "
            "within a turn, so that more is lost: torques over a turn include it"
        )
        yield NeglectedEffect("friction of bearings that reverse", (link,), why)


def _variation(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Yield the pairs whose torques vary with position."""
    found = []
    for circuit in busy:
        tooth = setting.meshes.get(circuit.id)
        declared = circuit.kind == "gear" and setting.gears[circuit.id].efficiency is not None
        if circuit.swings or (tooth is not None and (not tooth.rigid or (tooth.has_friction and not declared))):
            found.append(circuit.id)
    resting = [name for name in found if name in setting.joints and setting.joints[name].transmission.dwell]
    if moving := tuple(name for name in found if name not in resting):
        yield NeglectedEffect("variation within a turn", moving, f"{_MEAN}, about which they vary with position")
    if resting:
        why = f"{_MEAN}; at rest the driver carries no torque, and the driven link is held by its lock on the carrier"
        yield NeglectedEffect("variation within a turn", tuple(resting), why)


def _inertia(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Yield the links with inertia in a train with nonuniform pairs, which accelerate them."""
    heavy = tuple(link for link, part in setting.train.links.items() if part.inertia is not None)
    nonuniform = any(circuit.swings for circuit in setting.circuits)
    if heavy and (nonuniform or any(not tooth.rigid for tooth in setting.meshes.values())):
        yield NeglectedEffect("inertia", heavy, "torques are quasi-static: accelerations and impacts are neglected")
