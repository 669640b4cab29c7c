"""Report on the strength of a train. Each table is preceded by the assumptions on which it is based."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.results import Result
from geartrain.report.document import Document, Section, Table, figure, filled_table, result_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.simulation.strength.strength_results import (
        ArborStrength,
        FlankStrength,
        PairStrength,
        PinContact,
        PointContact,
        TrainStrength,
        WearRange,
        WheelStrength,
    )

_FORCES = (
    "Mean forces at the operating pitch circles. Axial: positive along the direction of the axis; radial: positive "
    "towards the axis. Both wheels of a pair have the same force, the sum of both torques divided by the sum of "
    "both radii (the differences for a ring); crossed axes are an exception. The pressure angle is 20 degrees by "
    "default."
)
_CONTACT = (
    "Hertz pressure of smooth flanks under the mean torque. Tooth pairs in contact at the same time carry the same "
    "force, as exact teeth of equal stiffness do. Positions are in pitches past the pitch point."
)
_POINT = (
    "Teeth on crossed axes touch at a point: Hertz's ellipse, with the load shared equally by the tooth pairs in "
    "contact. The pressure is the maximum where the fewest touch; flank safety is 1.6 times the strength divided by "
    "the pressure. At the root one tooth pair carries the whole load at the tip, in the normal section. It bends a "
    "length of the tooth of twice the lever arm. The stress concentration of the fillet is not included."
)
_WHERE = {
    "root": "at the root of its teeth",
    "contact": "on its flanks",
    "arbor": "in its arbor",
    "pin": "in its pins",
}
_PINS = (
    "Half of the pins, or fewer with a clearance, carry the load in proportion to their lever arms; the table has the "
    "maximum pressure of all phases. Radius: equivalent cylinder on a plane. Safety of a disc is 5/3 of the "
    "strength of the weaker side divided by the pressure. Pins in holes are cantilevers with bending and shear at the "
    "plane of the disc, of the train's material or else of steel; those of a ring are supported by it."
)
_ROOT = (
    "Bending by Lewis on the outline that is cut, without the stress concentration of its fillet. At the tip, one "
    "tooth pair carries the whole load, as with inexact teeth. Shared: equal forces. Safety of a root is the "
    "strength of the material divided by the stress with the load at the tip; safety of a flank is 5/3 of the "
    "strength divided by the pressure of single contact, at which yielding begins below the flank (static; pitting is "
    "not included)."
)
_ISO = (
    "ISO 6336-2 and -3, method B, all load factors K 1, for wheels cut by a hob (tip radius of the rack 0.38 "
    "modules, no backlash); an exported outline has another root. Lengths are in modules, stresses in MPa."
)
_WEAR = (
    "Archard's law with the range of the coefficient K: depths are proportional to K, whose uncertainty exceeds all "
    "others. Each flank wears by its own hardness, uniformly along its width. Abrasive particles, corrosion, and "
    "changes of shape and load are not included."
)
_ARBOR = (
    "Upper bound: the forces of all meshes act in one direction, at the worst position between two bearings, together "
    "with the moments of the axial forces at the radii of the wheels, and the total force is on one pivot. Positions "
    "of wheels are not used. Pivot pressure: force divided by diameter times length. Shoulder pressure: thrust divided "
    "by the area of the annulus of the arbor round its pivot."
)


@dataclass(frozen=True)
class StrengthReport(Result):
    """Strength of the teeth, pins and arbors of a train in each requested state."""

    PAGE = "simulation.strength.strength_report:describe_strength"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    states: tuple[TrainStrength, ...]
    """Results for each state, in the requested order."""


def collect_strength_report(train: GearTrain, found: Sequence[TrainStrength]) -> StrengthReport:
    """Return the strength report of a train in one or more states."""
    return StrengthReport(train.name, train.declaration.title, tuple(found))


def describe_strength(found: StrengthReport) -> Document:
    """Return a document on the strength in each state: weakest part, contact pressures, root stresses, ISO 6336
    results, wear and arbors.
    """
    sections = [section for each in found.states for section in strength_sections(each)]
    return Document(f"Strength of {found.name}", (f"Train '{found.name}'.",), tuple(sections))


def strength_document(found: TrainStrength) -> Document | None:
    """Return the document that `geartrain strength` prints for one state, or None if `found` has no train."""
    declared = found._declaration
    return None if declared is None else describe_strength(StrengthReport(declared.name, declared.title, (found,)))


def strength_sections(found: TrainStrength) -> Iterator[Section]:
    """Yield the sections of the strength document for one state."""
    head = "" if found.state is None else f"State {found.state}: "
    yield Section(_title(head, "Strength"), tuple(_verdict(found)))
    if found.forces:
        forces = result_table(found.forces, "pair", "wheel", "radius:5", "tangential:4", "axial:4", "radial:4")
        yield Section(_title(head, "Forces"), (_FORCES,), (forces,))
    if not found.pairs and not found.arbors and not found.points and not found.pins:
        return
    pairs = tuple(found.pairs.values())
    if found.points:
        notes = [f"{each.pair}: {note}." for each in found.points.values() for note in each.notes]
        yield Section(_title(head, "Contact at a point"), (_POINT, *notes), tuple(_points([*found.points.values()])))
    if found.pins:
        yield Section(_title(head, "Pins"), (_PINS,), (_pins([*found.pins.values()]),))
    # pairs without a path of contact have no pressures
    contacts = [_contact(pair) for pair in pairs if pair.contact]
    if contacts:
        yield Section(_title(head, "Contact pressure"), (_CONTACT,), tuple(contacts))
    notes = [f"{pair.pair}: {note}." for pair in pairs for note in pair.notes]
    if pairs:
        yield Section(_title(head, "Teeth"), (_ROOT, *notes), (_teeth(pairs),))
    if any(pair.iso is not None for pair in pairs):
        yield Section(_title(head, "ISO 6336"), (_ISO,), tuple(_iso(pairs)))
    if found.turns is not None:
        K = found.wear_coefficients
        over = f"Over {figure(found.turns, 6)} turns of the input; K from {K.minimum:g} to {K.maximum:g}."
        yield Section(_title(head, "Wear"), (over, _WEAR), (_wear(pairs),))
    if found.arbors:
        yield Section(_title(head, "Arbors"), (_ARBOR,), (_arbors(found.arbors),))


def _title(head: str, name: str) -> str:
    return f"{head}{name[0].lower() if head and name != 'ISO 6336' else name[0]}{name[1:]}"


def _verdict(found: TrainStrength) -> Iterator[str]:
    if not found.verdict:
        yield f"Verdict: {found.verdict.kind}: {found.verdict.text}."
    if found.over is not None:
        yield f"Stresses from the maximum torque in {figure(found.over, 6)} turns of the input; wear from mean torques."
    weakest = found.weakest
    if weakest is not None:
        where = _WHERE[weakest.what]
        yield f"Weakest: '{weakest.part}' {where}, safety {figure(weakest.safety, 3)}."
    for each in found.neglected:
        swings = "torque variation within a turn of " if each.what == "variation within a turn" else ""
        yield f"Not included: {swings}{', '.join(each.where)}: {each.why}."
    if found.verdict and not found.pairs and not found.points and not found.pins and not found.neglected:
        yield "The train has no loaded gear pair."


def _contact(pair: PairStrength) -> Table:
    rows = [
        (
            each.where,
            figure(each.position, 3),
            figure(each.tooth_pairs, 4),
            figure(each.force, 4),
            figure(each.pressure, 4) if each.pressure < float("inf") else "unbounded",
        )
        for each in pair.contact
    ]
    return Table((pair.pair, "position", "tooth pairs", "force (N)", "pressure (MPa)"), rows)


def _points(points: Sequence[PointContact]) -> Iterator[Table]:
    yield result_table(
        points,
        *("pair", "contact_ratio:4", "force (N)=normal_force:4", "semi-axes (mm)=longer:3", "=shorter:3", "pressure:4"),
    )
    yield result_table(
        (wheel for each in points for wheel in each.wheels),
        *("wheel", "material", "at the tip (MPa)=tip_stress:4", ("strength (MPa)", _strength)),
        *("safety of root=root_safety:3", "safety of flank=safety:3"),
    )


def _pins(pins: Sequence[PinContact]) -> Table:
    return result_table(
        pins,
        *("pins of=name", "disc", "material", "pins", "width:4", "force:4", "radius:4", "pressure:4", "strength:4"),
        *("safety of disc=contact_safety:3", "stress of pin (MPa)=pin_stress:4", "safety of pin=pin_safety:3"),
    )


def _teeth(pairs: Sequence[PairStrength]) -> Table:
    header = (
        *("pair", "wheel", "material", "module", "width", "force (N)", "Y", "at the tip (MPa)", "shared (MPa)"),
        *("pressure (MPa)", "strength (MPa)", "safety of root", "safety of flank"),
    )
    rows = [
        (
            *(pair.pair, wheel.wheel, wheel.material, figure(pair.module, 4), figure(pair.face_width, 4)),
            *(figure(pair.tangential, 4), figure(wheel.lewis or None, 4), figure(wheel.tip_stress, 4)),
            *(figure(wheel.shared_stress, 4), figure(wheel.pressure, 4), _strength(wheel)),
            *(figure(wheel.root_safety, 3), figure(wheel.contact_safety, 3)),
        )
        for pair in pairs
        for wheel in pair.wheels
    ]
    return filled_table(header, rows, 9)


def _strength(wheel: WheelStrength | FlankStrength) -> str:
    return figure(wheel.strength, 4) + (f" +- {100 * wheel.spread:.0f} %" if wheel.spread else "")


def _iso(pairs: Sequence[PairStrength]) -> Iterator[Table]:
    # the standard covers external involutes only
    covered = [pair for pair in pairs if pair.iso is not None]
    rows = []
    for pair in covered:
        own = pair.iso
        assert own is not None
        figures = (own.ZH, own.ZE, own.Zeps, own.Zbeta, own.M1, own.M2, own.nominal, *own.stress)
        rows.append((pair.pair, *(figure(each, 5) for each in figures)))
    yield Table(("pair", "ZH", "ZE", "Zeps", "Zbeta", "M1", "M2", "sH0", "sH first", "sH second"), rows)
    names = ("chord", "radius", "lever", "YF", "YS", "Ybeta", "stress")
    roots = [
        (wheel.wheel, *(figure(getattr(wheel.iso, name), 5) for name in names))
        for pair in covered
        for wheel in pair.wheels
        if wheel.iso is not None
    ]
    yield Table(("wheel", "s/m", "rF/m", "h/m", "YF", "YS", "Ybeta", "sF0"), roots)


def _wear(pairs: Sequence[PairStrength]) -> Table:
    rows = [
        (
            *(pair.pair, wheel.wheel, figure(wheel.wear.passages, 6), _range(wheel.wear.volume)),
            *(_range(wheel.wear.mean_depth), "-" if wheel.wear.depth is None else _range(wheel.wear.depth)),
        )
        for pair in pairs
        for wheel in pair.wheels
        if wheel.wear is not None
    ]
    return Table(("pair", "wheel", "passages", "volume (mm3)", "mean depth (mm)", "maximum depth (mm)"), rows)


def _range(found: WearRange) -> str:
    return f"{figure(found.minimum, 3)} to {figure(found.maximum, 3)}"


def _arbors(arbors: Sequence[ArborStrength]) -> Table:
    return result_table(
        arbors,
        *("arbor=link", "material", "force:4", "thrust:4", "bending:4", "torsion:4", "both (MPa)=stress:4"),
        *("pivot_pressure:4", "shoulder_pressure:4", "safety:3"),
    )
