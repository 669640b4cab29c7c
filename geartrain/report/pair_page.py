"""Pages on one pair of wheels, whatever the form of its teeth, and on one pin in a slot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING

from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, figure
from geartrain.report.gear_pairs import fault_text, joined_table
from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairImpacts, PairOperation
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_outline import WheelOutline
    from geartrain.teeth.pair_results import PairFigures
    from geartrain.teeth.pin_transmission import PinTransmission
    from geartrain.teeth.triangular.triangular_mesh import TriangularFigures
    from geartrain.teeth.triangular.triangular_transmission import ContactCourse


@dataclass(frozen=True)
class FormedPair(Result):
    """A pair of any form, with the figures of its mesh.

    mesh       the pair, as it is driven
    outlines   wheels that were cut
    """

    KEYS = (
        *(Key("form", "mesh.form"), Key("driver", "mesh.driver"), Key("gears", "mesh.gears"), Key("note", "mesh.note")),
        *(Key("", "figures"), "outlines"),
    )

    mesh: GearMesh
    outlines: tuple[WheelOutline, ...] = ()

    @property
    def figures(self) -> PairFigures:
        """What the mesh tells of itself."""
        return self.mesh.account().figures


@dataclass(frozen=True)
class TriangularPair(Result):
    """A pair with triangular teeth in no train, and what its collisions cost, where a run of it is given.

    course     speed ratio, instant centre and moment arms over the pitch
    outlines   wheels that were cut
    """

    KEYS = (Key("", "figures"), "course", "impacts", "outlines")

    figures: TriangularFigures
    course: ContactCourse
    impacts: PairImpacts | None
    outlines: tuple[WheelOutline, ...] = ()


def collect_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> PairDesign | TriangularPair | FormedPair:
    """What there is to tell of one pair without a train: its design, or the figures that its form has.

    Parameters
    ----------
    mesh : GearMesh
        The pair, as it is driven.
    outlines : sequence of WheelOutline
        Wheels that were cut.
    operation : PairOperation, optional
        How the pair is run, for the impacts of triangular teeth.

    Returns
    -------
    PairDesign, TriangularPair or FormedPair
        Conjugate teeth at their design distance; triangular teeth; any others. `to_dict()` gives the data.

    Examples
    --------
    >>> import geartrain
    >>> data = collect_pair(geartrain.load("planetary-24-18-60-involute").meshes[0]).to_dict()
    >>> data["form"], data["teeth"], round(data["contact_ratio"], 3)
    ('involute', [24, 18], 1.566)
    """
    if isinstance(mesh, TriangularMesh):
        return _triangular_pair(mesh, outlines, operation)
    design = _design(mesh, outlines)
    return FormedPair(mesh, tuple(outlines)) if design is None else design


def describe_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> Document:
    """A page on one pair without a train: verdict, design or figures, motion, losses, and wheels that were cut.

    Parameters
    ----------
    mesh : GearMesh
        The pair, as it is driven.
    outlines : sequence of WheelOutline
        Wheels that were cut.
    operation : PairOperation, optional
        How the pair is run, for the impacts of triangular teeth.

    Returns
    -------
    Document
        What `collect_pair` gives as data, with the limits of a friction or a clearance that is out of range.

    Examples
    --------
    >>> import geartrain
    >>> page = describe_pair(geartrain.load("planetary-24-18-60-involute").meshes[0])
    >>> page.title, [section.title for section in page.sections]
    ('Involute teeth 24/18 spur', ['Wheels', 'Path of contact', 'Costs', 'Friction'])
    """
    if isinstance(mesh, TriangularMesh):
        return _triangular_page(mesh, outlines, operation)
    design = _design(mesh, outlines)
    return _formed_page(mesh, outlines) if design is None else _design_page(design)


def _triangular_pair(
    mesh: TriangularMesh, outlines: Sequence[WheelOutline], operation: PairOperation | None
) -> TriangularPair:
    from geartrain.dynamics.motion.pair_impacts import find_pair_impacts
    from geartrain.teeth.rubbed_transmission import pair_friction
    from geartrain.teeth.triangular.triangular_mesh import triangular_figures
    from geartrain.teeth.triangular.triangular_transmission import contact_course

    impacts = None if operation is None or not mesh.law.intervals else find_pair_impacts(mesh.law, operation)
    figures = triangular_figures(mesh.law, mesh.window, losses=mesh.efficiency(mesh.driver))
    return TriangularPair(
        figures, contact_course(mesh.law, friction=pair_friction(mesh.wheels)), impacts, tuple(outlines)
    )


def _triangular_page(
    mesh: TriangularMesh, outlines: Sequence[WheelOutline], operation: PairOperation | None
) -> Document:
    from geartrain.report.triangular_pair_page import triangular_sections, triangular_verdict

    z1, z2 = mesh.counts
    lead = [f"The wheel of {z1} drives the wheel of {z2}.", triangular_verdict(mesh)]
    sections = [*triangular_sections(mesh, operation), *map(_outline, outlines)]
    return Document(f"Triangular teeth {z1}/{z2}", lead, sections)


def _design(mesh: GearMesh, outlines: Sequence[WheelOutline]) -> PairDesign | None:
    """The design of conjugate teeth; None for others, and at a distance at which they are conjugate no more."""
    if not isinstance(mesh, ConjugateMesh) or not mesh.rigid:
        return None
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign

    return PairDesign(mesh, tuple(outlines))


def _design_page(design: PairDesign) -> Document:
    from geartrain.report.conjugate_pair_page import conjugate_sections, conjugate_verdict, pair_name

    driver, driven = design.mesh.counts
    lead = [f"The wheel of {driver} drives the wheel of {driven}.", conjugate_verdict(design)]
    sections = [*conjugate_sections(design), *map(_outline, design.outlines)]
    return Document(f"{design.mesh.tooth_form.words.capitalize()} teeth {pair_name(design.path)}", lead, sections)


def _formed_page(mesh: GearMesh, outlines: Sequence[WheelOutline]) -> Document:
    account = mesh.account()
    first, second = mesh.wheels.counts
    lead = [f"{mesh.verdict.text.capitalize()}.", account.words, *map(fault_text, mesh.faults)]
    tables = [joined_table([each]) for each in account.tables]
    sections = [Section("Motion and losses", (), tables), *map(_outline, outlines)]
    return Document(f"{mesh.tooth_form.words.capitalize()} teeth {first}/{second}", lead, sections)


def _outline(wheel: WheelOutline) -> Section:
    sizes = wheel.to_dict()
    names = ("module", "pitch_diameter", "tip_diameter", "root_diameter", "thickness", "fillet", "clearance")
    rows = [
        (name.replace("_", " "), f"{sizes[name]:.6g}") for name in (*names, "backlash", "centre_distance", "tolerance")
    ]
    kinds = {"pins": "a disc with a hole for each pin", "ring": "teeth inwards", "external": "teeth outwards"}
    text = (
        f"Wheel {wheel.gear}, {kinds[wheel.kind]}; lengths in mm, thickness along the pitch circle. The axle is at "
        "the origin, a tooth or pin on the x axis."
    )
    lines = [text]
    if wheel.relief:
        lines.append(f"The root is turned {degrees(wheel.relief):.3g} deg off the flank so that the mate's tip passes.")
    return Section("Outline", lines, (Table(("quantity", "mm"), rows),))


def describe_pin(law: PinTransmission) -> Document:
    """A page on a pin in a slot: mean ratio, amplitude, extreme speeds and friction.

    Parameters
    ----------
    law : PinTransmission
        Of the pin in the slot, whichever drives.

    Returns
    -------
    Document
        One section; its data are those of `geartrain.teeth.pair_results.pin_figures`.

    Examples
    --------
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> describe_pin(PinToSlotTransmission(2, 1)).sections[0].tables[0].rows[0]
    ('amplitude', '0.523598776 rad', '30 deg')
    """
    from geartrain.teeth.pair_results import pin_figures

    found = pin_figures(law)
    ratio, rms, efficiency = found.speed_ratio, found.transmission_error.rms, found.efficiency
    kind = "encloses" if ratio.mean else "leaves out"
    lead = [
        f"The {law.driver} drives. The pin's circle, of radius {figure(found.pin_radius)}, {kind} the slot's axis at "
        f"{figure(found.offset)}: the mean ratio is {ratio.mean}.",
    ]
    rows = [
        ("amplitude", f"{found.amplitude:.9g} rad", f"{degrees(found.amplitude):.9g} deg"),
        ("error, rms", f"{rms:.9g} rad", f"{degrees(rms):.9g} deg"),
        ("speed ratio, least", figure(ratio.least), ""),
        ("speed ratio, greatest", figure(ratio.greatest), ""),
    ]
    if efficiency.friction:
        name = f"efficiency at friction {efficiency.friction:g}, mean"
        rows.append((name, _share(efficiency.mean), "at constant driver torque"))
        rows.append(("", _share(efficiency.at_constant_load), "at constant load torque"))
    table = Table(("quantity", "value", ""), rows)
    return Document("Pin in a slot", lead, [Section("Law of motion", (), (table,))])


def _share(efficiency: float | None) -> str:
    """An efficiency; `-` where friction locks, or no work is done on a constant load."""
    return "-" if efficiency is None else f"{efficiency:.9f}"
