"""Train as a tree of coupled joints for robot and multibody simulators: URDF with mimic joints, and MJCF (MuJoCo).

Every link turns on the link that carries its axis, so the rate of its joint is the speed of the link minus the speed of
this carrier. In URDF each joint follows the joint of the input by its exact ratio. In MJCF every gear pair, coupling,
brake and lock is an equality constraint between two joints, or between more joints on a fixed tendon. Masses are
nominal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.vectors import Vector, minus

if TYPE_CHECKING:
    from geartrain.scene.elements import SceneBody
    from geartrain.scene.solids.solid_assembly import SolidModel

_MASS = "0.1"  # kg
_INERTIA = "1e-4"  # kg m^2


def to_urdf(work: SolidModel) -> str:
    """Return the train in one state in URDF format, in which every joint mimics the joint of the input.

    Raises `GearTrainError` if the speeds are not determined, or do not follow from one input.
    """
    case, bodies = work.train.declaration.case(work.scene.state), _bodies(work)
    moving = [link for link, speed in case.inputs.items() if speed]
    rates = _rates(work)
    if len(moving) != 1 or not rates.get(moving[0]):
        what = f"'{work.train.name}' cannot be written as URDF"
        why = f"mimic joints need one input that determines all speeds; the number of moving inputs is {len(moving)}"
        raise GearTrainError(Problem(what, why, "write MJCF (-o FILE.xml), or choose another --state", "-o"))
    root = Element("robot", name=work.train.name)
    moments = {"ixx": _INERTIA, "iyy": _INERTIA, "izz": _INERTIA, "ixy": "0", "ixz": "0", "iyz": "0"}
    for body in bodies:
        inertial = SubElement(SubElement(root, "link", name=body.id), "inertial")
        SubElement(inertial, "mass", value=_MASS)
        SubElement(inertial, "inertia", moments)
    for body in bodies:
        if body.parent is None:
            continue
        rate = rates[body.id]
        joint = SubElement(root, "joint", name=body.id, type="continuous" if rate else "fixed")
        SubElement(joint, "parent", link=bodies[body.parent].id)
        SubElement(joint, "child", link=body.id)
        SubElement(joint, "origin", xyz=_metres(body, bodies[body.parent]), rpy="0 0 0")
        SubElement(joint, "axis", xyz=_numbers(body.direction))
        if rate and body.id != moving[0]:
            SubElement(joint, "mimic", joint=moving[0], multiplier=str(float(rate / rates[moving[0]])), offset="0")
    return _text(root)


def to_mjcf(work: SolidModel) -> str:
    """Return the train in one state in MJCF format; every row of its Willis system is an equality constraint."""
    bodies = _bodies(work)
    root = Element("mujoco", model=work.train.name)
    SubElement(root, "compiler", angle="radian")
    SubElement(root, "option", gravity="0 0 0", integrator="implicitfast")  # stable with stiff drives
    moving = [body for body in bodies if body.parent is not None]
    nodes = {body.id: SubElement(root, "worldbody") for body in bodies if body.parent is None}
    for body in moving:
        node = nodes[body.id] = Element("body", name=body.id, pos=_metres(body, bodies[body.parent or 0]))
        SubElement(node, "inertial", pos="0 0 0", mass=_MASS, diaginertia=" ".join([_INERTIA] * 3))
        SubElement(node, "joint", name=body.id, type="hinge", axis=_numbers(body.direction))
    for body in moving:
        nodes[bodies[body.parent or 0].id].append(nodes[body.id])
    tendons, equality = Element("tendon"), Element("equality")
    for label, terms in _constraints(work):
        a, *others = terms.values()
        if len(terms) <= 2:
            joints = dict(zip(("joint1", "joint2"), terms, strict=False))
            slope = float(-sum(others) / a)
            SubElement(equality, "joint", {"name": label, **joints, "polycoef": f"0 {slope} 0 0 0"})
        else:
            tendon = SubElement(tendons, "fixed", name=label)
            for joint, each in terms.items():
                SubElement(tendon, "joint", joint=joint, coef=str(float(each / a)))
            SubElement(equality, "tendon", name=label, tendon1=label, polycoef="0 0 0 0 0")
    root.extend(each for each in (tendons, equality) if len(each))
    actuators = SubElement(root, "actuator")
    for link in work.train.declaration.case(work.scene.state).inputs:
        SubElement(actuators, "velocity", name=f"drive {link}", joint=link, kv="1")
    return _text(root)


def mean_ratios(work: SolidModel) -> Iterator[Problem]:
    """Yield a problem for each coupling whose ratio varies. Files with joints contain only its mean ratio."""
    why, fix = "the ratio of two coupled joints is a constant", "use .glb or .fmu for its motion"
    for circuit in work.train.circuits:
        if circuit.swings:
            yield Problem(f"coupling '{circuit.id}' is written with its mean ratio", why, fix)


def _bodies(work: SolidModel) -> Sequence[SceneBody]:
    """Return the links as bodies. Raises `GearTrainError` if a link slides."""
    for link in sorted(work.train.declaration.sliding):
        why = "only revolute joints are written, and the travel of the link is a length per turn"
        raise GearTrainError(Problem(f"link '{link}' slides", why, "choose another format, such as .glb", "-o"))
    return work.scene.bodies


def _rates(work: SolidModel) -> dict[str, Fraction]:
    """Return the speed of each link relative to the link that carries it, keyed by link; empty if undetermined."""
    answer, bodies = work.train.solve(work.scene.state, method="exact"), work.scene.bodies
    if not answer.verdict:
        return {}
    speeds = [body.sense * Fraction(answer.speeds[body.id]) for body in bodies]
    pairs = zip(bodies, speeds, strict=True)
    return {body.id: speed - speeds[body.parent] for body, speed in pairs if body.parent is not None}


def _constraints(work: SolidModel) -> Iterator[tuple[str, Mapping[str, Fraction]]]:
    """Yield name and coefficients of each equation between the speeds of joints that follows from the Willis system.

    The coefficients are keyed by the link that turns in the joint. Equations of the frame and of inputs are omitted.
    """
    bodies = {body.id: body for body in work.scene.bodies}
    for equation in work.train.equations(work.scene.state).equations:
        if equation.kind in ("frame", "input"):
            continue
        terms: dict[str, Fraction] = {}
        for link, coefficient in equation.terms:
            # the speed of a link is the sum of the joint rates on its path to the frame
            body, sense = bodies[link], bodies[link].sense
            while body.parent is not None:
                terms[body.id] = terms.get(body.id, Fraction(0)) + sense * coefficient
                body = work.scene.bodies[body.parent]
        if terms := {link: each for link, each in terms.items() if each}:
            yield equation.label, terms


def _metres(body: SceneBody, parent: SceneBody) -> str:
    """Return the position of the joint of a body relative to the joint of its parent, as text in metres."""
    origin = (0.0, 0.0, 0.0) if parent.parent is None else parent.point
    return _numbers(tuple(each / 1000 for each in minus(body.point, origin)))


def _numbers(values: Vector | tuple[float, ...]) -> str:
    return " ".join(f"{each + 0.0:.12g}" for each in values)


def _text(root: Element) -> str:
    indent(root)
    return f'<?xml version="1.0"?>\n{tostring(root, encoding="unicode")}\n'
