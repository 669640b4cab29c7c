"""What the diagrams of the pages show, as the package answers it: one function a kind of diagram.

Numbers are exact where the package's are, as text (`-2/3`); nothing is typed in that could be asked for.
"""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import pairwise
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import yaml

import geartrain
from geartrain.drawing.kinematic_graph import graph_layout
from geartrain.drawing.tooth_contact import tooth_pair_pose
from geartrain.scene import make_scene

Data = dict[str, Any]

DOCS = Path(__file__).resolve().parents[2]
_DRAWN = ("bodies", "wheels", "profiles", "pairs", "movement", "back", "driving_link", "step")

# ------------------------------------------------------------------------------------------------------------- speeds


def willis() -> Data:
    """The scene of a planetary, and its speeds with each of its members held."""
    train = geartrain.load("planetary")
    members = {"sun": "sun", "ring": "ring", "carrier": "carrier", "planet": "planet"}
    held = {link: _speeds(_scene(train, f"{link} fixed")) for link in ("ring", "sun", "carrier")}
    return {"scene": _scene(train, "ring fixed"), "held": held, **members}


DIFFERENTIAL = "extends: bevel-differential\nname: two-inputs\nstates: null\noutputs: null\n"
"""The differential with both its axle shafts free."""


def differential() -> Data:
    """The bevel differential, and the turns of all its links for a turn of either axle shaft, the other at rest."""
    scenes = {
        side: _scene(geartrain.load(f"{DIFFERENTIAL}inputs: {{{side}: 1, {other}: 0}}\n"))
        for side, other in (("left", "right"), ("right", "left"))
    }
    return {
        "scene": scenes["left"],
        "shares": {side: _speeds(scene) for side, scene in scenes.items()},
        "crown": "crown",
        "spider": "spider",
    }


# ----------------------------------------------------------------------------------------------------------- circuits

GRAPHS = {
    "planetary-24-18-60": "a planetary",
    "norton-compound": "Norton's train",
    "ravigneaux-set": "a Ravigneaux set",
}


def circuits() -> Data:
    """The graphs of some trains as `draw graph` arranges them, each gear pair with its circuit and its equation."""
    return {"trains": [_graph(name, title) for name, title in GRAPHS.items()]}


def _graph(name: str, title: str) -> Data:
    train = geartrain.load(name)
    places, edges = graph_layout(train)
    texts = train.equations(train.declaration.state_or_first(None)).text().splitlines()
    rows = dict(re.split(r"  +", line, maxsplit=1) for line in texts)
    return {
        "title": title,
        "frame": train.declaration.frame,
        "links": places,
        "edges": [{"kind": e.kind, "label": e.label, "curve": np.round(c, 3).tolist()} for e, c in edges],
        "circuits": {
            each.id: {
                "ends": [each.i, each.j],
                "carrier": each.carrier,
                "ratio": str(each.ratio),
                "equation": rows[each.id],
                "path": _tree_path(train, each.i, each.j),
            }
            for each in train.circuits
        },
    }


def _tree_path(train: geartrain.GearTrain, one: str, other: str) -> list[int]:
    """The turning pairs between two links, as places in the list of edges, which begins with the turning pairs."""
    joints = {frozenset(joint.pair): at for at, joint in enumerate(train.declaration.revolutes)}
    paths = [[one]]
    while paths[0][-1] != other:
        path = paths.pop(0)
        ends = (next(iter(pair - {path[-1]})) for pair in joints if path[-1] in pair)
        paths += [[*path, end] for end in ends if end not in path]
    return [joints[frozenset(pair)] for pair in pairwise(paths[0])]


# -------------------------------------------------------------------------------------------------------------- teeth

TEETH = {"3a": "48 drive 96", "4a": "96 drive 72", "5a": "96 drive 96"}
MOMENTS = 120  # of a pitch


def teeth() -> Data:
    """Pairs of Sorge's note: sizes, law, and where they touch at moments of a pitch of the driver."""
    train = geartrain.load("sorge-pairs")
    tables = {table["pair"]: table for table in make_scene(train).to_dict()["movement"]["transmissions"]}
    transmissions = {mesh.name: mesh.transmission for mesh in train.meshes}
    return {"pairs": {name: _pair(transmissions[name], tables[name], title) for name, title in TEETH.items()}}


def _pair(transmission: Any, table: Data, title: str) -> Data:
    sizes = transmission.sizes
    moments = [tooth_pair_pose(transmission, -transmission.period * n / MOMENTS) for n in range(MOMENTS)]
    return {
        "title": title,
        "teeth": [sizes.z1, sizes.z2],
        "tips": [sizes.R1, sizes.R2],
        "depths": list(sizes.depths),
        "distance": sizes.D,
        "ratio": str(transmission.ratio),
        "law": {key: table[key] for key in ("period", "breaks", "coefficients")},
        "moments": [
            [*(round(float(v), 9) for v in (m.alpha1, m.alpha2, *m.contact, m.centre[0])), m.phase] for m in moments
        ],
    }


# --------------------------------------------------------------------------------------------------------------- pins


def pin() -> Data:
    """The Moon's pin and slot of the reconstruction of 2008: its two wheels, sizes [mm] and law."""
    scene = make_scene(geartrain.load("freeth-2008")).to_dict()
    (coupling,) = scene["couplings"]
    source = next(each for each in scene["movement"]["sources"] if each["pair"] == coupling["id"])
    transmission = scene["movement"]["transmissions"][source["transmission"]]
    wheels = [wheel for wheel in scene["wheels"] if wheel["body"] in (coupling["pin"], coupling["slot"])]
    return {
        "wheels": [_shaped(scene, wheel) for wheel in wheels],
        "pin_radius": coupling["pin_radius"],
        "offset": coupling["offset"],
        "transmission": {key: transmission[key] for key in ("period", "breaks", "coefficients")},
    }


# ------------------------------------------------------------------------------------------------------------ closure

PLANET = 18
SUNS = (22, 23, 24, 25, 26)
ASSEMBLED = """
name: two-planets
links: {{frame: {{}}, sun: {{wheels: {{s: {sun}}}}}, ring: {{wheels: {{r: {{teeth: {ring}, internal: true}}}}}},
  arm: {{}}, P0: {{wheels: {{p0: {planet}}}}}, P1: {{wheels: {{p1: {planet}}}}}}}
axes: {{main: {{position: [0 mm, 0 mm, 0 mm]}}, P0: {{position: ["{d:.8f} mm", 0 mm, 0 mm]}},
  P1: {{position: ["{x:.8f} mm", "{y:.8f} mm", 0 mm]}}}}
revolutes: {{main: [frame, sun, ring, arm], P0: [arm, P0], P1: [arm, P1]}}
gears: [s ~ p0, p0 ~ r, s ~ p1, p1 ~ r]
fixed: [{fixed}]
inputs: {{arm: 1}}
"""


def two_planets(sun: int, turns: Fraction, fixed: str = "ring") -> geartrain.GearTrain:
    """Two equal planets between a sun and a ring, so many turns from each other."""
    distance, angle = Fraction(sun + PLANET, 2), 2 * np.pi * float(turns)
    place = {"d": float(distance), "x": float(distance) * np.cos(angle), "y": float(distance) * np.sin(angle)}
    ring = sun + 2 * PLANET
    return geartrain.load(ASSEMBLED.format(sun=sun, ring=ring, planet=PLANET, fixed=fixed, **place))


def closure() -> Data:
    """Two planets about suns of several counts: wheels, and the planet's turns for one of the arm, sun or ring held."""
    return {"planet": PLANET, "sets": {str(sun): _set(sun) for sun in SUNS}}


def _set(sun: int) -> Data:
    held = {link: two_planets(sun, Fraction(1, 2), link).solve().speeds["P1"] for link in ("sun", "ring")}
    scene = _scene(two_planets(sun, Fraction(1, 2)))
    wheels = {wheel["id"]: _shaped(scene, wheel) for wheel in scene["wheels"]}
    return {
        "rolled": {link: str(turns) for link, turns in held.items()},
        "wheels": {name: wheels[name] for name in ("s", "r", "p0")},
    }


# ------------------------------------------------------------------------------------------------------------- torques

MINIMUM, STEPS = Fraction("0.9"), 200


def locking() -> Data:
    """The set of docs/torques.md, section 5: what of its power arrives both ways, by the efficiency of its pairs."""
    set_ = block("torques.md", "near.yaml")
    basic = [MINIMUM + n * (1 - MINIMUM) / STEPS for n in range(STEPS + 1)]
    train = geartrain.GearTrain.declare(set_)
    return {
        "basic": [str(each) for each in basic],
        "ratio": str(prod((circuit.ratio for circuit in train.circuits), start=Fraction(1))),
        "ways": {
            "sun drives arm": [_efficiency(set_, each, -1) for each in basic],
            "arm drives sun": [_efficiency(set_, each, 1) for each in basic],
        },
    }


def _efficiency(declared: Data, basic: Fraction, load: int) -> float | None:
    """From the member that drives to the other, None where it locks."""
    gears = [{**gear, "efficiency": float(basic)} for gear in declared["gears"]]
    found = geartrain.GearTrain.declare({**declared, "gears": gears, "loads": {"arm": load}}).torques()
    return None if found.verdict.kind == "self-locking" else round(float(found.efficiency), 12)


def block(page: str, name: str) -> Data:
    """A declaration that stands in a page."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = re.search(rf"<!-- file: {re.escape(name)} -->\n```yaml\n(.*?)```", text, re.DOTALL)
    assert found, f"{page} shows no {name}"
    declared: Data = yaml.safe_load(found[1])
    return declared


# -------------------------------------------------------------------------------------------------------------- scenes


def _scene(train: geartrain.GearTrain, state: str | None = None) -> Data:
    """What of a scene is drawn and turned."""
    scene = make_scene(train, state).to_dict()
    return {key: scene[key] for key in _DRAWN}


def _shaped(scene: Data, wheel: Data) -> Data:
    """A wheel with the form of its tooth."""
    points = scene["profiles"][wheel["profile"]]["points"]
    return {**wheel, "shape": {"points": [[round(radius, 6), round(angle, 6)] for radius, angle in points]}}


def _speeds(scene: Data) -> dict[str, str]:
    """Over the lead's, by link."""
    return {body["id"]: body["speed"] for body in scene["bodies"]}
