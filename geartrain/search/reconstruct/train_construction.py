"""Conversion of a candidate to a complete declaration, in which added parts are marked as hypothetical.

The names of parts depend only on the evidence and the candidate, so equal candidates give equal declarations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from geartrain.numerics.exact import fraction_text
from geartrain.search.reconstruct.candidate_names import NamedArbor, NamedWheel, free_name, named_candidate
from geartrain.search.reconstruct.link_roles import couplings_of, find_base, joined_arbors
from geartrain.search.reconstruct.reconstruction_problem import (
    Arbor,
    PlacedWheel,
    SurvivingGeometry,
    read_geometry_evidence,
)
from geartrain.train import Train, declare
from geartrain.train.yaml_nodes import as_yaml

# One module for wheels that mesh, from all their measurements, so that a candidate can be built and drawn.


def fit_modules(train: NamedArbor, geometry: SurvivingGeometry) -> dict[str, float | None]:
    """Return the module [mm] to be declared for each measured wheel for which the measured module cannot be declared.

    Wheels that mesh share one module. In a group of such wheels, the first measured wheel receives the geometric mean
    of the measured modules, and the others receive None, because their modules follow from the first. All wheels of a
    group receive None if the positions of two axes determine their module.
    """
    # first wheel of the group of each wheel
    mates: dict[str, str] = {}
    for _, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        mates[arbor.driven.name] = mates.setdefault(wheel.name, wheel.name)
    placed = {
        mates[wheel.name]
        for arbor, wheel, driven in train.meshes()
        if arbor.name in geometry.places and driven.name in geometry.places
    }
    measured: dict[str, dict[str, float]] = {}
    for wheel in (wheel for arbor in train.arbors() for wheel in arbor.wheels()):
        module = geometry.module_of(PlacedWheel(None if wheel.added else wheel.name, wheel.teeth))
        if module is not None:
            measured.setdefault(mates[wheel.name], {})[wheel.name] = math.log(module)
    found: dict[str, float | None] = {}
    for group, logs in measured.items():
        if group not in placed and len(logs) == 1 and geometry.measured[next(iter(logs))].is_module:
            continue
        found |= dict.fromkeys(logs)  # None: the module follows from other wheels
        if group not in placed:
            found[next(iter(logs))] = math.exp(sum(logs.values()) / len(logs))
    return found


ADDED_NOTE = "added by reconstruct"
_LEFT_OUT = {
    *("name", "title", "extends", "remove", "reconstruct"),
    *("links", "axes", "revolutes", "gears", "couplings", "outputs"),
}


def candidate_train(evidence: Train, arbor: Arbor, name: str) -> Train:
    """Convert a candidate reconstruction to a validated declaration.

    Parameters
    ----------
    evidence : Train
        Evidence that the candidate explains.
    arbor : Arbor
        Input arbor of the candidate.
    name : str
        Name of the train.

    Returns
    -------
    Train

    Examples
    --------
    >>> from geartrain.search.reconstruct import evidence_question, find_reconstructions, read_evidence
    >>> evidence = read_evidence("metonic-l-m")
    >>> found = find_reconstructions(evidence_question(evidence).problem)
    >>> train = candidate_train(evidence, found.candidates[0].arbor, "first")
    >>> [gear.pair for gear in train.gears]
    [('b2', 'l1'), ('l2', 'm1'), ('m2', 'new_metonic1')]
    """
    return declare(candidate_data(evidence, arbor, name))


def candidate_text(evidence: Train, arbor: Arbor, name: str) -> str:
    """Return the declaration of a candidate as YAML text. Equal candidates give equal texts."""
    return as_yaml(candidate_data(evidence, arbor, name))


def candidate_data(evidence: Train, arbor: Arbor, name: str) -> dict[str, Any]:
    """Return the declaration of a candidate as plain data."""
    train = TrainConstruction(evidence, arbor)
    given = train.given
    kept = {key: value for key, value in given.items() if key not in _LEFT_OUT}
    about = {"title": f"{given['title']}, as {name}"} if given.get("title") else {}
    data = {"name": name, **about, **kept, "frame": evidence.frame, **train.parts()}
    unused = [link for link in evidence.links if link not in (*train.links, evidence.frame)]
    if unused:
        said = f"Not used: {', '.join(unused)}."
        data["note"] = f"{kept['note']} {said}" if kept.get("note") else said
    return data


class TrainConstruction:
    """Declaration of a candidate, to which the parts are added arbor by arbor.

    given    evidence as plain data
    links, revolutes, gears, couplings   parts of the candidate, as plain data
    shown    link that carries each pointer, and speed of this link relative to the base
    meshes   pairs of meshing wheels, the driving wheel first
    added    tooth count of each added wheel
    doubtful tooth count in this candidate of each surviving wheel with an uncertain tooth count
    modules  new module [mm] of each measured wheel whose module changes; None if the module follows from other wheels
    """

    def __init__(self, evidence: Train, arbor: Arbor) -> None:
        self.evidence, self.base, self._joined = evidence, find_base(evidence), joined_arbors(evidence)
        self.given = evidence.model_dump(mode="json", exclude_unset=True, by_alias=True)
        self.links: dict[str, Any] = {}
        self.revolutes: list[dict[str, Any]] = []
        self.gears: list[dict[str, Any]] = []
        self.couplings: list[dict[str, Any]] = []
        self.shown: dict[str, tuple[str, Fraction]] = {}
        self.meshes: list[tuple[str, str]] = []
        self.added: dict[str, int] = {}
        self.doubtful: dict[str, int] = {}
        source = named_candidate(evidence, arbor)
        self.modules = fit_modules(source, read_geometry_evidence(evidence))
        if self.base.is_carrier:
            self.links[self.base.name] = dict(self.given["links"][self.base.name] or {})
            self._joint(evidence.frame, self.base.name)
        self._put(source, self.base.driven)
        speeds = {source.name: self.base.driven}
        rings = {name for name, (_, wheel) in evidence.wheels.items() if wheel.internal}
        for driving, wheel, child in source.meshes():
            assert child.driven is not None
            sense = 1 if rings & {wheel.name, child.driven.name} else -1  # added wheels have names of their own
            speeds[child.name] = sense * speeds[driving.name] * wheel.teeth / child.driven.teeth
            self._put(child, speeds[child.name])
            self.gears.append(self._gear(wheel.name, child.driven.name))
            self.meshes.append((wheel.name, child.driven.name))
        self.doubtful = {name: self.doubtful[name] for name in evidence.wheels if name in self.doubtful}

    def _put(self, arbor: NamedArbor, speed: Fraction) -> None:
        """Add an arbor with its wheels and pointers. If couplings connect several links to form the arbor, add all of
        these links.
        """
        links = self._joined.get(arbor.name, (arbor.name,))
        for link in links:
            self._link(link, arbor.added)
        self.couplings += couplings_of(self.evidence, links)
        for wheel in arbor.wheels():
            self._wheel(arbor.name if wheel.added else self.evidence.wheels[wheel.name][0], wheel)
        for dial in arbor.dials:
            of = self.evidence.outputs[dial].of
            self.shown[dial] = (of if of in links else links[0], speed)

    def parts(self) -> dict[str, Any]:
        """Return the entries of the declaration that differ from the evidence."""
        frame = self.evidence.frame
        links = {frame: self.given["links"].get(frame, {})}
        links |= {link: self.links[link] for link in (*self.evidence.links, *self.links) if link in self.links}
        labels = {joint["axis"] for joint in self.revolutes}
        axes = {label: axis for label, axis in self.given.get("axes", {}).items() if label in labels}
        outputs = {name: self._output(name) for name in self.evidence.outputs}
        couplings = {"couplings": self.couplings} if self.couplings else {}
        found = {"links": links, "revolutes": self.revolutes, "gears": self.gears, **couplings, "outputs": outputs}
        return {"axes": axes, **found} if axes else found

    def _link(self, link: str, added: bool) -> None:
        base = self.base
        declared = self.given["links"].get(link) or {}
        self.links[link] = {"wheels": {}, "note": ADDED_NOTE} if added else dict(declared)
        if link != base.source or not base.is_carrier:
            self._joint(base.name, link)
        elif link != self.evidence.frame:  # driven from outside, about the axis of the carrier
            self._joint(self.evidence.frame, link, self.revolutes[0]["axis"])

    def _joint(self, bearing: str, link: str, axis: str | None = None) -> None:
        """Add the turning pair of a link: the declared pair, or a new pair if none is declared.

        bearing   link on which the new pair is, that is, the frame or the carrier
        axis      label of the axis of the new pair; None for a new axis
        """
        joints = self.given.get("revolutes", ())
        bearings = {bearing, self.evidence.frame, self.base.name} - {link}
        joint = next((joint for joint in joints if link in joint["pair"] and bearings & set(joint["pair"])), None)
        if joint is None:
            labels = {joint["axis"] for joint in (*joints, *self.revolutes)} | set(self.evidence.axes)
            joint = {"pair": [bearing, link], "axis": axis or free_name(link, "axis", labels)}
        self.revolutes.append(joint)

    def _wheel(self, link: str, wheel: NamedWheel) -> None:
        wheels = dict(self.links[link].get("wheels", {}))
        if wheel.added:
            self.added[wheel.name] = wheel.teeth
            wheels[wheel.name] = {"teeth": wheel.teeth, "status": "hypothetical", "note": ADDED_NOTE}
        else:
            declared = wheels[wheel.name]["teeth"]
            if isinstance(declared, Mapping) and {"range", "choices", "search"} & set(declared):
                self.doubtful[wheel.name] = wheel.teeth
            wheels[wheel.name] = wheels[wheel.name] | {"teeth": _with_count(wheels[wheel.name]["teeth"], wheel.teeth)}
            if wheel.name in self.modules:
                wheels[wheel.name] = self._with_module(wheel.name, wheels[wheel.name])
        self.links[link]["wheels"] = wheels

    def _with_module(self, name: str, wheel: Mapping[str, Any]) -> dict[str, Any]:
        """Return a declared wheel with its new module. If the new module differs from the measured value, a note with
        this value is added.
        """
        requested, module = self.evidence.reconstruct, self.modules[name]
        assert requested is not None
        assert requested.geometry is not None
        radii = requested.geometry.radii
        measured = f"pitch radius {radii[name]}" if name in radii else f"module {wheel['module']}"
        text = "" if module is None else f"{module:.4g} mm"
        found = {key: value for key, value in wheel.items() if key != "module"} | ({"module": text} if text else {})
        if measured == f"module {text}":
            return found
        note = f"measured {measured}"
        return found | {"note": f"{wheel['note']}; {note}" if wheel.get("note") else note}

    def _gear(self, driving: str, driven: str) -> dict[str, Any]:
        for gear in self.given.get("gears", ()):
            if set(gear["pair"]) == {driving, driven}:
                return {key: value for key, value in gear.items() if key != "driver"}
        return {"pair": [driving, driven]}

    def _output(self, name: str) -> dict[str, Any]:
        link, speed = self.shown[name]
        output = self.evidence.outputs[name]
        speed += self.base.seen(output.relative_to or self.evidence.frame)
        given = dict(self.given["outputs"][name] or {})
        if output.expect is None or not output.expect.holds(speed):
            given["expect"] = fraction_text(speed)
        # a value without a tolerance has a short form
        elif set(given["expect"]) == {"value"}:
            given["expect"] = given["expect"]["value"]
        return {"of": link} | {key: value for key, value in given.items() if key != "of"}


def _with_count(teeth: Any, count: int) -> Any:
    """Return a declared tooth count with its value replaced by the tooth count in a candidate. Its range or choices are
    preserved.
    """
    if not isinstance(teeth, Mapping):
        return count
    found = {"value": count, **{key: part for key, part in teeth.items() if key not in ("value", "search")}}
    if "search" in teeth and not {"range", "choices"} & set(found):
        found["range" if len(teeth["search"]) == 2 else "choices"] = teeth["search"]
    return found
