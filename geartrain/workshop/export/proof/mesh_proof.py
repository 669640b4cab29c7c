"""Proof of every mesh of a train, based on its written outlines: rules on overlap, backlash, clearance and tips."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.flat_files import to_svg
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.buildability import BuildFinding, BuildLevel
from geartrain.numerics.results import Result
from geartrain.workshop.export.cut_sheets import compensated, wheel_sheets
from geartrain.workshop.export.proof.turned_pair import (
    NOTHING,
    SAME,
    TOLERANCE,
    FreeTurn,
    TurnedPair,
    plane_geometry,
    read_material,
)

if TYPE_CHECKING:
    from typing import Any

    from geartrain.dynamics.train_teeth import PairBacklash
    from geartrain.scene.layout import Layout
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.wheel_blanks import Blank

ALLOWED = 1e-3
"""Amount by which the measured backlash may be below the declared backlash [mm]: the accuracy of the outlines."""
_CLEARANCE, _TIP = 0.1, 0.2  # modules: minimum clearance under a tip, and minimum tip width
_AROUND = 32  # chords per quarter circle of the middle line of a cut around a corner
_BUFFER = 0.01  # of a kerf: error of lines that shapely offsets
_WHOLE = 1 - 1e-9  # contact ratio below which a tooth pair separates before the next one meets
_EASY_RATIO = 1.1  # contact ratio with a margin for wear and errors of the distance
_TOUCH = 1e-4  # mm: a smaller backlash counts as 0
_LAND = 0.05  # tooth heights below the tip circle at which the tip width is measured: rounded tips have width 0 on it


@dataclass(frozen=True, slots=True)
class MeshProof(Result):
    """Measured values of a mesh as cut, over a pitch and, for unequal teeth, over all combinations of teeth."""

    KEYS = ("pair", "declared", "minimum", "most", "overlap", "contact_ratio", "clearance", "tip_width", "module")

    pair: str
    """Name of the pair."""
    declared: float
    """Declared backlash, measured as an arc of the pitch circles [mm]."""
    minimum: float
    """Minimum measured backlash [mm]."""
    most: float
    """Maximum measured backlash [mm]."""
    overlap: float
    """Maximum area of the overlap of the two wheels over all positions [mm2]."""
    contact_ratio: float | None
    """Contact ratio of conjugate teeth at the design distance; None for other tooth forms."""
    clearance: float
    """Minimum bottom clearance: distance on the line of centres from a tip to the root of the other wheel [mm]."""
    tip_width: float
    """Smaller tip width of the two wheels [mm]."""
    module: float
    """Module of the second wheel [mm]."""
    findings: tuple[BuildFinding, ...] = ()
    """Findings on rules that the mesh violates."""


@dataclass(frozen=True)
class CutTrain:
    """Shapes of the wheels of a train as cut."""

    materials: dict[str, Any]
    """Shape of each wheel, read from its written drawing, keyed by wheel."""
    findings: tuple[BuildFinding, ...]
    """Messages on drawings that cannot be cut."""


def read_wheels(work: SolidModel) -> CutTrain:
    """Return the material of each cut wheel, read from its drawing, with half the kerf removed along every edge."""
    kerf = work.process.kerf
    materials: dict[str, Any] = {}
    findings = []
    for sheet in wheel_sheets(work.blanks.wheels):
        pins = work.blanks.wheels[sheet.parts[0]].kind == "pins"
        try:
            material = read_material(to_svg(compensated(sheet.drawing, kerf)), pins)
        except GearTrainError as error:
            for problem in error.problems:
                what = f"wheel {' and '.join(map(repr, sheet.parts))}: {problem.what}"
                findings.append(BuildFinding("T0", "error", Problem(what, problem.why, problem.fix)))
            continue
        # the cut removes half a kerf on each side of its line
        left = material.buffer(kerf / (2 if pins else -2), quad_segs=_AROUND) if kerf else material
        left = _with_pins(left, work.blanks.wheels[sheet.parts[0]])
        materials |= dict.fromkeys(sheet.parts, left)
    return CutTrain(materials, tuple(findings))


def _with_pins(ring: Any, blank: Blank) -> Any:
    """Return the material of an internal wheel united with its separate pins. Any other wheel is returned unchanged."""
    if blank.pins is None:
        return ring
    shapely = plane_geometry()
    R, radius = blank.pins.circle * blank.module, blank.pins.radius * blank.module
    turns = 2 * np.pi * np.arange(blank.teeth) / blank.teeth
    middles = shapely.points(np.column_stack([R * np.cos(turns), R * np.sin(turns)]))
    # the corners are outside the circle, so that chords do not cut off any part of the pin
    chords = ceil(np.pi / (4 * np.arccos(1 / (1 + TOLERANCE / radius))))
    return shapely.union_all([ring, *shapely.buffer(middles, radius + TOLERANCE, quad_segs=chords)])


def paired_wheels(work: SolidModel, cut: CutTrain) -> dict[str, tuple[PairBacklash, tuple[Blank, Blank], TurnedPair]]:
    """Return declared backlash, blanks and outlines of each pair of cut wheels, keyed by pair.

    The internal wheel is the second wheel; in an external pair, it is the driven wheel.
    """
    # the backlash of teeth that are not conjugate is stated for a driver that is held
    found, drivers = {}, {mesh.name: mesh.driver for mesh in work.sized.meshes}
    for backlash in work.blanks.backlashes:
        bent = any(work.train.declaration.wheels[name][1].flexible for name in backlash.wheels)
        if set(backlash.wheels) <= set(cut.materials) and not bent:
            one, other = (work.blanks.wheels[name] for name in backlash.wheels)
            driven_first = other.wheel == drivers.get(backlash.pair) and other.kind != "ring"
            wheels = (other, one) if one.kind == "ring" or driven_first else (one, other)
            names = tuple(each.wheel for each in wheels)
            first, second = (cut.materials[name] for name in names)
            counts = wheels[0].teeth, wheels[1].teeth
            apart = axis_distance(work.layout, (names[0], names[1]))
            same = max(SAME, _BUFFER * work.process.kerf)
            turned = TurnedPair((first, second), counts, apart, wheels[1].kind == "ring", same)
            found[backlash.pair] = backlash, wheels, turned
    return found


def axis_distance(layout: Layout, wheels: tuple[str, str]) -> float:
    """Return the distance between the axes of two wheels, measured perpendicular to the first axis [mm]."""
    first, second = (layout.wheels[name] for name in wheels)
    between = np.subtract(second.centre, first.centre)
    along = np.array(layout.axes[first.axis].direction)
    return float(np.linalg.norm(between - (between @ along) * along))


def prove_mesh(backlash: PairBacklash, wheels: tuple[Blank, Blank], turned: TurnedPair) -> MeshProof:
    """Return the measured values of a mesh, whose outlines are turned against each other, with its findings."""
    found = turned.turn()
    R, module = wheels[1].pitch_radius, wheels[1].module
    # arc length on the pitch circle of the second wheel, as the declared backlash
    room = (found.high - found.low) * R
    # NaN at positions in which the second wheel is nowhere free
    measured = room[~np.isnan(room)]
    blocked = bool((found.overlap > NOTHING).any())
    tips = zip(turned.materials, turned.reaches, turned.counts, strict=True)
    proof = MeshProof(
        backlash.pair,
        backlash.length,
        0.0 if blocked else float(measured.min()),
        float(measured.max(initial=0.0)),
        float(found.overlap.max()),
        backlash.contact_ratio,
        clearance(turned),
        min(tip_width(*each) for each in tips),
        module,
    )
    findings = _findings(backlash, proof, found, turned, (wheels[0].wheel, wheels[1].wheel))
    if wheels[1].pins is not None:
        # the bottom between two lobes is itself a flank, at a distance from the pins of about the backlash
        findings = (each for each in findings if each.rule != "T2")
    return replace(proof, findings=tuple(findings))


def clearance(turned: TurnedPair) -> float:
    """Return the minimum distance on the line of centres from a tip to the root of the other wheel [mm]."""
    (tip, root), (other_tip, other_root) = turned.reaches
    a = turned.distance
    if turned.ring:
        return min(other_root - a - tip, other_tip - a - root)
    return min(a - tip - other_root, a - other_tip - root)


def tip_width(material: Any, reach: tuple[float, float], teeth: int) -> float:
    """Return the mean tip width of a wheel slightly below its tip circle [mm], or the diameter of lantern pins."""
    shapely = plane_geometry()
    tip, root = reach
    if material.geom_type != "Polygon":
        return abs(tip - root)
    radius = tip - (tip - root) * _LAND
    # 64 chords for each tooth
    circle = shapely.Point(0.0, 0.0).buffer(radius, quad_segs=max(64, 16 * teeth)).exterior
    return float(shapely.length(shapely.intersection(circle, material))) / teeth


def _findings(
    backlash: PairBacklash, proof: MeshProof, found: FreeTurn, turned: TurnedPair, names: tuple[str, str]
) -> Iterator[BuildFinding]:
    pair, module = f"pair '{proof.pair}'", proof.module
    if found.place is not None:
        where = turned.words(found.place, names)
        what = f"{pair}: {where} overlap by {proof.overlap:.3g} mm2"
        yield _error("T5", what, "overlapping teeth cannot turn", _LOOSER)
    elif min(proof.minimum, proof.declared) <= _TOUCH:
        what = f"{pair} has no backlash"
        fix = f"give --backlash {0.05 * module:.3g}mm"
        yield _error("T5", what, "manufactured wheels jam without backlash", fix)
    elif proof.minimum < proof.declared - ALLOWED:
        what = f"{pair} has a backlash of {proof.minimum:.4g} mm, but {proof.declared:.4g} mm are declared"
        yield _error("T5", what, "its teeth are thicker as cut than as declared", _LOOSER)
    elif not np.isfinite(proof.most):
        fix = "reduce the centre distance, or give taller teeth"
        yield _error("T5", f"{pair} slips: one wheel can turn past the other", "the tips do not overlap", fix)
    if proof.clearance < _CLEARANCE * module - TOLERANCE:
        what = f"{pair}: the clearance between tips and roots is only {proof.clearance:.3g} mm"
        why = "if the clearance is too small, tips touch roots, or dirt jams the pair"
        fix = f"deepen the roots, to leave a clearance of {_CLEARANCE * module:.3g} mm"
        yield BuildFinding("T2", "error" if proof.clearance < _TOUCH else "note", Problem(what, why, fix))
    ratio = proof.contact_ratio
    if ratio is not None and ratio < _EASY_RATIO:
        level: BuildLevel = "error" if ratio < _WHOLE else "note"
        why = (
            "a tooth pair leaves contact before the next one engages"
            if ratio < _WHOLE
            else "wear or a larger centre distance can reduce it below 1"
        )
        yield BuildFinding(
            "T3", level, Problem(f"{pair} has a contact ratio of only {ratio:.4g}", why, backlash.more_contact)
        )
    if proof.tip_width < _TIP * module:
        what = f"{pair} has tips only {proof.tip_width:.3g} mm wide"
        why = "tips narrower than 0.2 modules break, or burn in a laser"
        yield BuildFinding("T4", "note", Problem(what, why, "shorten the addendum"))


_LOOSER = "give more backlash, shorter addenda, or another centre distance"


def _error(rule: str, what: str, why: str, fix: str) -> BuildFinding:
    return BuildFinding(rule, "error", Problem(what, why, fix))
