"""Pages on one pair of wheels, whatever the form of its teeth, and on one pin in a slot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, isnan
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Key, Result
from geartrain.report.document import Document, Section, Table, figure
from geartrain.report.gear_pairs import fault_text, joined_table
from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairImpacts, PairOperation
    from geartrain.teeth.conjugate.pair_design import PairDesign
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.cut_wheel import WheelOutline
    from geartrain.teeth.pair_account import PairFigures
    from geartrain.teeth.pin_transmission import PinTransmission
    from geartrain.teeth.triangular.triangular_account import TriangularFigures


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
    """A pair with triangular teeth in no train, and what its collisions cost, where a run of it is given."""

    KEYS = (Key("", "figures"), "impacts")

    figures: TriangularFigures
    impacts: PairImpacts | None


def collect_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> PairDesign | TriangularPair | FormedPair:
    """What there is to tell of one pair, as its form has it.

    outlines    wheels that were cut
    operation   how the pair is run, for the impacts of triangular teeth
    """
    if isinstance(mesh, TriangularMesh):
        return _triangular_pair(mesh, operation)
    design = _design(mesh, outlines)
    return FormedPair(mesh, tuple(outlines)) if design is None else design


def describe_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> Document:
    """A page on the same: verdict, design or figures, motion, losses, and wheels that were cut."""
    if isinstance(mesh, TriangularMesh):
        return _triangular_page(mesh, operation)
    design = _design(mesh, outlines)
    return _formed_page(mesh, outlines) if design is None else _design_page(design)


def _triangular_pair(mesh: TriangularMesh, operation: PairOperation | None) -> TriangularPair:
    from geartrain.dynamics.motion.pair_impacts import find_pair_impacts
    from geartrain.teeth.triangular.triangular_account import triangular_figures

    impacts = None if operation is None or not mesh.law.intervals else find_pair_impacts(mesh.law, operation)
    return TriangularPair(triangular_figures(mesh.law, mesh.window), impacts)


def _triangular_page(mesh: TriangularMesh, operation: PairOperation | None) -> Document:
    from geartrain.report.triangular_pair_page import triangular_sections, triangular_verdict

    z1, z2 = mesh.counts
    lead = [f"The wheel of {z1} drives the wheel of {z2}.", triangular_verdict(mesh)]
    return Document(f"Triangular teeth {z1}/{z2}", lead, list(triangular_sections(mesh, operation)))


def _design(mesh: GearMesh, outlines: Sequence[WheelOutline]) -> PairDesign | None:
    """The design of conjugate teeth; None for others, and at a distance at which they are conjugate no more."""
    if not isinstance(mesh, ConjugateMesh) or not mesh.rigid:
        return None
    from geartrain.teeth.conjugate.pair_design import PairDesign

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
    """Mean ratio, amplitude, extreme speeds and friction of one coupling."""
    least, most = law.speed_range()
    kind = "encloses" if law.ratio else "leaves out"
    lead = [
        f"The {law.driver} drives. The pin's circle, of radius {figure(law.r)}, {kind} the slot's axis at "
        f"{figure(law.e)}: the mean ratio is {law.ratio}.",
    ]
    rows = [
        ("amplitude", f"{law.amplitude:.9g} rad", f"{degrees(law.amplitude):.9g} deg"),
        ("error, rms", f"{law.error_moments()[1]:.9g} rad", f"{degrees(law.error_moments()[1]):.9g} deg"),
        ("speed ratio, least", figure(least), ""),
        ("speed ratio, greatest", figure(most), ""),
    ]
    if law.friction:
        driver, load = law.efficiency_mean(), law.efficiency_at_constant_load()
        rows.append((f"efficiency at friction {law.friction:g}, mean", _share(driver), "at constant driver torque"))
        rows.append(("", _share(load), "at constant load torque"))
    table = Table(("quantity", "value", ""), rows)
    return Document("Pin in a slot", lead, [Section("Law of motion", (), (table,))])


def _share(efficiency: float) -> str:
    """An efficiency; `-` where friction locks, or no work is done on a constant load."""
    return "-" if isnan(efficiency) else f"{efficiency:.9f}"
