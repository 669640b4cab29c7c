"""Strength of a train, as a page: each figure under the assumption it rests on."""

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
    "At the circles on which wheels roll, as means. Axial above 0 along the direction of the axis; radial towards the "
    "axis, below 0 outwards. Both wheels of a pair bear the same force: friction reduces the torque on one of them, "
    "and the greater torque over radius counts, except on crossed axes. Friction counts along teeth that slide along "
    "each other, not up and down them. The pressure angle is 20 degrees by default."
)
_CONTACT = (
    "Hertz pressure of smooth flanks under the mean torque; couples that touch at once carry the same force, as rigid "
    "exact teeth of equal stiffness do. Positions in pitches past the pitch point."
)
_POINT = (
    "Teeth of crossed axes touch at a point: Hertz's ellipse, the load shared evenly among the couples that touch at "
    "once. The pressure is the greatest where fewest touch; safety of a flank is 1.6 times the strength over it. At "
    "the root one couple bears all at the tip, on teeth as they are seen along them, and bends twice as much of a "
    "tooth as its lever is long, without the stress concentration of the round."
)
_WHERE = {
    "root": "at the root of its teeth",
    "contact": "on its flanks",
    "arbor": "in its arbor",
    "pin": "in its pins",
}
_PINS = (
    "Half of the pins bear at once, or fewer with a clearance, and share by their arms; here that with the greatest "
    "pressure of all phases. Radius: of a cylinder on a plane that presses as much. Safety of a disc is 5/3 of the "
    "strength of the weaker side over the pressure. Pins in holes stand out of a plate at one end, bent and sheared "
    "where the disc begins, and are of the train's material, else of steel; those of a ring lie in it."
)
_ROOT = (
    "Bending by Lewis on the outline that is cut, without the stress concentration of its round: at the tip one couple "
    "bears all, as where teeth are not exact to the thousandth; shared, couples carry the same force. Safety is the "
    "strength of the material over the stress at the tip, and 5/3 of the strength over the pressure where one couple "
    "bears all, at which yielding begins below the flank (static; pitting by fatigue is not worked out)."
)
_ISO = (
    "ISO 6336-2 and -3, method B, all load factors K 1, for wheels as a hob cuts them (corner of the rack 0.38 "
    "modules, no backlash); the root of an exported outline is another one. Length in modules, stresses in MPa."
)
_WEAR = (
    "Archard's law with the coefficient K anywhere in its range: depths go with K, and the range is wider than all "
    "else that is not known. Each flank is worn by its own hardness, evenly along its width; grit, corrosion, changes "
    "of shape and of load on the way are not in it."
)
_ARBOR = (
    "The forces of all meshes as if they pulled one way, where that bends most between two bearings; with them the "
    "couples of what pushes along the axis at the radii of the wheels, and the whole on one pivot: where wheels stand "
    "is not looked at, so that this is an upper bound. Pivots: force over diameter times length; shoulder: the thrust "
    "on the ring that an arbor has round its pivot."
)


@dataclass(frozen=True)
class StrengthReport(Result):
    """Strength of a train in every state that was asked for.

    See Also
    --------
    describe_strength : Its page.
    """

    PAGE = "simulation.strength.strength_report:describe_strength"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    states: tuple[TrainStrength, ...]
    """In the order asked."""


def collect_strength_report(train: GearTrain, found: Sequence[TrainStrength]) -> StrengthReport:
    """The strength of a train in some states, to be told.

    Parameters
    ----------
    train : GearTrain
        The train.
    found : sequence of TrainStrength
        What `train.strength` gave, one for each state.

    Returns
    -------
    StrengthReport
        Its `to_dict` is the answer of `geartrain strength --json`.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("longcase-clock-loaded")
    >>> data = collect_strength_report(train, [train.strength()]).to_dict()
    >>> data["states"][0]["weakest"]["what"]
    'arbor'
    """
    return StrengthReport(train.name, train.declaration.title, tuple(found))


def describe_strength(found: StrengthReport) -> Document:
    """Strength state by state: what is weakest, pressures, stresses, factors of ISO 6336, wear, arbors.

    Parameters
    ----------
    found : StrengthReport
        From `collect_strength_report`.

    Returns
    -------
    Document
        Forces in N, stresses in MPa, lengths in mm; the assumption of each table stands over it.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("longcase-clock-loaded")
    >>> page = describe_strength(collect_strength_report(train, [train.strength()]))
    >>> [section.title for section in page.sections]
    ['Strength', 'Forces', 'Contact pressure', 'Teeth', 'Arbors']
    """
    sections = [section for each in found.states for section in strength_sections(each)]
    return Document(f"Strength of {found.name}", (f"Train '{found.name}'.",), tuple(sections))


def strength_document(found: TrainStrength) -> Document | None:
    """Return what `geartrain strength` prints for one state; None where the train is not known."""
    declared = found._declaration
    return None if declared is None else describe_strength(StrengthReport(declared.name, declared.title, (found,)))


def strength_sections(found: TrainStrength) -> Iterator[Section]:
    """Sections of one state."""
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
    contacts = [_contact(pair) for pair in pairs if pair.contact]
    if contacts:
        yield Section(_title(head, "Contact pressure"), (_CONTACT,), tuple(contacts))
    notes = [f"{pair.pair}: {note}." for pair in pairs for note in pair.notes]
    if pairs:
        yield Section(_title(head, "Teeth"), (_ROOT, *notes), (_teeth(pairs),))
    if any(pair.iso is not None for pair in pairs):
        yield Section(_title(head, "ISO 6336"), (_ISO,), tuple(_iso(pairs)))
    if found.turns is not None:
        yield Section(_title(head, "Wear"), tuple(_wear_words(found)), (_wear(pairs),))
    if found.arbors:
        yield Section(_title(head, "Arbors"), (_ARBOR,), (_arbors(found.arbors),))


def _title(head: str, name: str) -> str:
    return f"{head}{name[0].lower() if head and name != 'ISO 6336' else name[0]}{name[1:]}"


def _verdict(found: TrainStrength) -> Iterator[str]:
    if not found.verdict:
        yield f"Verdict: {found.verdict.kind}: {found.verdict.text}."
    if found.over is not None:
        yield f"Under the greatest torque of each pair over {figure(found.over, 6)} turns of the input; wear by means."
    weakest = found.weakest
    if weakest is not None:
        where = _WHERE[weakest.what]
        yield f"Weakest: '{weakest.part}' {where}, safety {figure(weakest.safety, 3)}."
    for each in found.left_out:
        swings = "variation within a turn of " if each.what == "variation within a turn" else ""
        yield f"Left out: {swings}{', '.join(each.where)}: {each.why}."
    if found.verdict and not found.pairs and not found.points and not found.pins and not found.left_out:
        yield "There is no gear pair."


def _contact(pair: PairStrength) -> Table:
    rows = [
        (
            each.where,
            figure(each.position, 3),
            figure(each.tooth_pairs, 4),
            figure(each.force, 4),
            figure(each.pressure, 4) if each.pressure < float("inf") else "no bound",
        )
        for each in pair.contact
    ]
    return Table((pair.pair, "position", "tooth_pairs", "force (N)", "pressure (MPa)"), rows)


def _points(points: Sequence[PointContact]) -> Iterator[Table]:
    yield result_table(
        points,
        *("pair", "contact_ratio:4", "force (N)=normal_force:4", "half axes (mm)=longer:3", "=shorter:3", "pressure:4"),
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


def _wear_words(found: TrainStrength) -> Iterator[str]:
    K = found.wear_coefficients
    yield f"Over {figure(found.turns, 6)} turns of the input; K from {K.minimum:g} to {K.maximum:g}."
    yield _WEAR


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
    return Table(("pair", "wheel", "passages", "volume (mm3)", "mean depth (mm)", "greatest depth (mm)"), rows)


def _range(found: WearRange) -> str:
    return f"{figure(found.minimum, 3)} to {figure(found.maximum, 3)}"


def _arbors(arbors: Sequence[ArborStrength]) -> Table:
    return result_table(
        arbors,
        *("arbor=link", "material", "force:4", "thrust:4", "bending:4", "torsion:4", "both (MPa)=stress:4"),
        *("pivot_pressure:4", "shoulder_pressure:4", "safety:3"),
    )
