"""Effects that a balance of mean torques neglects; see the table in section 13 of docs/torques.md."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.load_case import LoadCase, MeanEfficiencies
from geartrain.dynamics.torques.mean_efficiencies import all_mean_efficiencies
from geartrain.dynamics.torques.torque_results import NeglectedEffect
from geartrain.kinematics.circuits import Circuit

if TYPE_CHECKING:
    from geartrain.dynamics.torques.bearing_loads import BearingLoads

_NO_FORM = (
    "the loss of these teeth depends on their form, which is not declared: give a `tooth_form` or an `efficiency`"
)
_NO_SLIDING = "a given transmission error has no sliding speed: give the `efficiency` of the tooth form or of the pair"
_NO_HELIX = (
    "these teeth slide along their length, and their helix angles or their friction are not known: declare the "
    "`helix_angle` of the worm, or of both wheels on crossed axes, and a constant `friction`; or an `efficiency`"
)
_MEAN = "the reported torques are means over a turn"


def find_neglected_effects(
    setting: LoadCase,
    means: Mapping[str, MeanEfficiencies],
    neither: Sequence[str],
    idle: Sequence[str],
    bearings: bool,
    loads: BearingLoads | None = None,
    loose: Sequence[str] = (),
) -> tuple[NeglectedEffect, ...]:
    """Return all effects that are neglected in the mean torques of one load case.

    neither   pairs in which neither torque is constant over a revolution
    idle      pairs that transmit no torque and have no losses
    bearings  True if load-independent friction of bearings was included
    loads     loads of the bearings whose friction depends on the load, or None
    loose     pairs whose torque is undetermined
    """
    busy = [circuit for circuit in setting.circuits if circuit.id not in set(idle)]
    found = [*_pins(setting, busy), *_teeth(setting, busy, means)]
    open_ = [circuit.id for circuit in busy if setting.turn(circuit) is None]
    # pairs whose friction depends on the speed of their teeth; access to another pair would build its teeth
    laws = {name for name in open_ if name in setting.meshes and setting.gears[name].efficiency is None}
    laws = {name for name in laws if setting.meshes[name].wheels.friction_law is not None}
    if lossy := tuple(name for name in open_ if means[name] != MeanEfficiencies() or name in laws):
        why = "their driving side depends on speeds that are not determined"
        found.append(NeglectedEffect("losses of pairs", lossy, why))
    found += _of_couplings(setting, busy)
    found += _bearings(setting, bearings)
    shared = tuple(circuit.id for circuit in busy if circuit.id in set(neither))
    if shared:
        why = (
            "neither torque of these pairs is constant within a turn, so their mean efficiency depends on other pairs; "
            "the value for a constant load torque is used, or for a constant driving torque where loads drive"
        )
        found.append(NeglectedEffect("mean efficiency", shared, why))
    found += [] if loads is None else unknown_forces(loads, idle, loose)
    if links := tuple(link for link, part in setting.train.links.items() if part.drag is not None and part.drag.value):
        why = "it depends on speed: torques over a turn include it if speeds have units"
        found.append(NeglectedEffect("viscous drag", links, why))
    return (*found, *_variation(setting, busy), *_inertia(setting))


def unknown_forces(
    loads: BearingLoads, idle: Sequence[str] = (), loose: Sequence[str] = ()
) -> Iterator[NeglectedEffect]:
    """Yield the effects of unknown forces of pairs and links on bearings, and of weights that move."""
    for why, names in loads.missing.items():
        if busy := tuple(name for name in names if name not in set(idle)):
            yield NeglectedEffect("forces on bearings", busy, why)
    if shared := tuple(force.name for force in loads.forces if force.name in set(loose)):
        yield NeglectedEffect("forces on bearings", shared, "their shares of the load are not determined")
    if light := tuple(link for link, mass in loads.masses.items() if mass is None):
        yield NeglectedEffect("weight on bearings", light, "the `mass` of these links is not declared")
    moving = (link for link, mass in loads.masses.items() if mass)
    if lifted := tuple(link for link in moving if loads.setting.bearer(link) != loads.setting.train.frame):
        why = "they press on bearings, but the torques that lift them with their carriers are not included"
        yield NeglectedEffect("moments of weights", lifted, why)


def neglected_over_turn(setting: LoadCase, at_means: Sequence[str]) -> tuple[NeglectedEffect, ...]:
    """Return the effects that are neglected in the torques at all positions of a revolution.

    These torques include the friction of pins and bearings and its variation, if the data are declared.

    at_means   pairs with a declared tooth form for which the mean efficiency is used at all positions
    """
    found = [
        *_pins(setting, setting.circuits, over_turn=True),
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


def _pins(setting: LoadCase, busy: Sequence[Circuit], over_turn: bool = False) -> Iterator[NeglectedEffect]:
    """Yield the friction of pins that is neglected in the loaded circuits `busy`: friction of followers, which transmit
    no mean power (omitted if `over_turn` is True), and friction of pins without declared dimensions.
    """
    pins = {pin.name for pin in setting.train.pin_couplings if setting.has_friction(pin)}
    rubbing = [circuit for circuit in busy if circuit.id in pins]
    if not over_turn:
        if swinging := tuple(circuit.id for circuit in rubbing if not circuit.b):
            why = "a follower only oscillates and transmits no mean power, so its friction has no efficiency"
            yield NeglectedEffect("friction of pins", swinging, why)
        rubbing = [circuit for circuit in rubbing if circuit.b]
    if bare := tuple(circuit.id for circuit in rubbing if circuit.id not in setting.joints):
        why = "it depends on `pin_radius` and `offset`, which are not declared"
        yield NeglectedEffect("friction of pins", bare, why)


def _of_couplings(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Yield the effects, such as side loads on bearings, that are not modelled for the couplings among the loaded
    circuits `busy`.
    """
    named: dict[tuple[str, str], list[str]] = {}
    for circuit in busy:
        if circuit.kind != "gear" and (effect := setting.couplings[circuit.id].NEGLECTED) is not None:
            named.setdefault(effect, []).append(circuit.id)
    yield from (NeglectedEffect(what, tuple(names), why) for (what, why), names in named.items())


def _teeth(
    setting: LoadCase, busy: Sequence[Circuit], means: Mapping[str, MeanEfficiencies]
) -> Iterator[NeglectedEffect]:
    """Yield the effect of friction declared for teeth without a tooth form, or for worms of unknown helix angle."""
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
    """Return True for a worm drive or crossed helical gears, whose teeth slide along their length."""
    wheels = [setting.train.wheels[name][1] for name in circuit.wheels]
    helical = any(wheel.is_helical for wheel in wheels) and not setting.axes.are_parallel(setting.axis_labels(circuit))
    return helical or any(wheel.kind == "worm" for wheel in wheels)


def _bearings(setting: LoadCase, included: bool) -> Iterator[NeglectedEffect]:
    """Yield the neglected friction of bearings: all of it unless `included`, friction of unknown sense, and friction
    that may reverse within a revolution.
    """
    rubbing = tuple(link for link in setting.train.links if setting.bearing(link))
    if not included:
        if rubbing:
            why = "it does not depend on the load, so it is not part of an efficiency"
            yield NeglectedEffect("friction of bearings", rubbing, why)
        return
    free = tuple(link for link in rubbing if setting.relative(link, setting.tree.borne_by(link)) is None)
    if free:
        yield NeglectedEffect("friction of bearings", free, "their sense of rotation is not determined")
    known = tuple(link for link in rubbing if link not in free)
    if known and any(circuit.swings for circuit in setting.circuits):
        why = (
            "it is computed at mean speeds; if the speed of a bearing changes its sign within a turn, more is lost: "
            "torques over a turn include it, and `motion --links` prints extreme speeds"
        )
        yield NeglectedEffect("friction of bearings that reverse", known, why)


def _variation(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Yield the neglected variation of torques within a revolution, with the pairs that cause it."""
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
    """Yield the neglected inertia of links that variable speed ratios accelerate."""
    heavy = tuple(link for link, part in setting.train.links.items() if part.inertia is not None)
    nonuniform = any(circuit.swings for circuit in setting.circuits)
    if heavy and (nonuniform or any(not tooth.rigid for tooth in setting.meshes.values())):
        yield NeglectedEffect("inertia", heavy, "torques are quasi-static: accelerations and impacts are neglected")
