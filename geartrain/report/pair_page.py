"""Documents on one pair of wheels with any tooth form, and on one pin in a slot.

The document on triangular teeth has sizes, clearance, path of contact, transmission function, impacts and losses.
`conjugate_pair_page` describes conjugate teeth.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees, isfinite, pi
from typing import TYPE_CHECKING

from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, figure
from geartrain.report.gear_pairs import fault_text, joined_table, without_losses
from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
from geartrain.teeth.rubbed_transmission import pair_friction
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh, explain_clearance, triangular_figures
from geartrain.teeth.triangular.triangular_transmission import contact_course

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairImpacts, PairOperation
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign
    from geartrain.teeth.couplings.pin_transmission import PinTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_outline import WheelOutline
    from geartrain.teeth.pair_results import PairFigures
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.triangular_mesh import TriangularFigures
    from geartrain.teeth.triangular.triangular_transmission import ContactCourse, TriangularTransmission


@dataclass(frozen=True)
class FormedPair(Result):
    """Pair of wheels with any tooth form, and the results for its mesh."""

    KEYS = (
        *(Key("form", "mesh.form"), Key("driver", "mesh.driver"), Key("gears", "mesh.gears"), Key("note", "mesh.note")),
        *(Key("", "figures"), "outlines"),
    )

    mesh: GearMesh
    """Gear mesh of the pair; the mesh specifies the driving wheel."""
    outlines: tuple[WheelOutline, ...] = ()
    """Outlines of the wheels; empty if they were not constructed."""

    @property
    def figures(self) -> PairFigures:
        """Sizes, transmission function and losses of the mesh."""
        return self.mesh.account().figures


@dataclass(frozen=True)
class TriangularPair(Result):
    """Pair of wheels with triangular teeth outside a train, with impacts under operating conditions."""

    KEYS = (Key("", "figures"), "course", "impacts", "outlines")

    figures: TriangularFigures
    course: ContactCourse
    """Speed ratio, instant centre and moment arms over one pitch."""
    impacts: PairImpacts | None
    """Energies of the impacts and speed limits; None if no operating conditions are given."""
    outlines: tuple[WheelOutline, ...] = ()
    """Outlines of the wheels; empty if they were not constructed."""


def collect_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> PairDesign | TriangularPair | FormedPair:
    """Return the data on a pair of wheels outside a train, in a class that depends on its teeth.

    outlines    outlines of the wheels that were constructed
    operation   operating conditions, for the impacts of triangular teeth
    """
    if not isinstance(mesh, TriangularMesh):
        return _design(mesh, outlines) or FormedPair(mesh, tuple(outlines))
    figures = triangular_figures(mesh.transmission, mesh.window, losses=mesh.efficiency(mesh.driver))
    course = contact_course(mesh.transmission, friction=pair_friction(mesh.wheels))
    return TriangularPair(figures, course, _impacts(mesh.transmission, operation), tuple(outlines))


def describe_pair(
    mesh: GearMesh, outlines: Sequence[WheelOutline] = (), operation: PairOperation | None = None
) -> Document:
    """Return a document on one pair of wheels. The arguments are the same as for `collect_pair`."""
    first, second = mesh.counts
    drives = f"The wheel of {first} drives the wheel of {second}."
    if isinstance(mesh, TriangularMesh):
        name, summary = f"{first}/{second}", [drives, triangular_verdict(mesh)]
        sections = [*triangular_sections(mesh, operation)]
    elif (design := _design(mesh, outlines)) is not None:
        from geartrain.report.conjugate_pair_page import conjugate_sections, conjugate_verdict, pair_name

        name, summary = pair_name(design.path), [drives, conjugate_verdict(design)]
        sections = [*conjugate_sections(design)]
    else:
        account, counts = mesh.account(), mesh.wheels.counts
        name = f"{counts[0]}/{counts[1]}"
        summary = [f"{mesh.verdict.text.capitalize()}.", account.words, *map(fault_text, mesh.faults)]
        sections = [Section("Motion and losses", (), [joined_table([each]) for each in account.tables])]
    title = f"{mesh.tooth_form.words.capitalize()} teeth {name}"
    return Document(title, summary, [*sections, *map(_outline, outlines)])


def _design(mesh: GearMesh, outlines: Sequence[WheelOutline]) -> PairDesign | None:
    """Return the design of conjugate teeth; None for other tooth forms, and at a distance at which the ratio varies."""
    if not isinstance(mesh, ConjugateMesh) or not mesh.rigid:
        return None
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign

    return PairDesign(mesh, tuple(outlines))


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
        lines.append(
            f"The root is relieved by {degrees(wheel.relief):.3g} deg from the flank so that the mate's tip clears it."
        )
    return Section("Outline", lines, (Table(("quantity", "mm"), rows),))


def describe_pin(transmission: PinTransmission) -> Document:
    """Return a document on a pin in a slot: mean ratio, amplitude, speeds and friction, for either of them driving."""
    from geartrain.teeth.pair_results import pin_figures

    found = pin_figures(transmission)
    ratio, rms, efficiency = found.speed_ratio, found.transmission_error.rms, found.efficiency
    # the mean ratio is 1 if the circle encloses the axis, else 0
    kind = "encloses" if ratio.mean else "does not enclose"
    summary = [
        f"The {transmission.driver} drives. The pin's circle, of radius {figure(found.pin_radius)}, "
        f"{kind} the slot's axis at "
        f"{figure(found.offset)}: the mean ratio is {ratio.mean}.",
    ]
    rows = [
        _angle("amplitude", found.amplitude),
        _angle("anomaly, rms", rms),
        ("speed ratio, minimum", figure(ratio.minimum), ""),
        ("speed ratio, maximum", figure(ratio.maximum), ""),
    ]
    if efficiency.friction:
        name = f"efficiency at friction {efficiency.friction:g}, mean"
        rows.append((name, _share(efficiency.mean), "at constant driver torque"))
        rows.append(("", _share(efficiency.at_constant_load), "at constant load torque"))
    table = Table(("quantity", "value", ""), rows)
    return Document("Pin in a slot", summary, [Section("Transmission function", (), (table,))])


def _angle(name: str, angle: float) -> tuple[str, str, str]:
    """Return a table row with the name of an angle, its value in radians and its value in degrees."""
    return name, f"{angle:.9g} rad", f"{degrees(angle):.9g} deg"


def _share(efficiency: float | None) -> str:
    """Return an efficiency as text; `-` if it is None, because friction locks the pin or no work is done."""
    return "-" if efficiency is None else f"{efficiency:.9f}"


# ----------------------------------------------------------------------------------------------------- triangular teeth


def triangular_sections(mesh: TriangularMesh, operation: PairOperation | None) -> Iterator[Section]:
    """Yield the sections on a pair of triangular teeth; only sizes and clearance if the teeth never touch."""
    transmission, window = mesh.transmission, mesh.window
    yield _sizes(transmission)
    if window is not None:
        yield _clearance(transmission, window)
    if transmission.intervals:
        yield from (_path(transmission), _course(mesh), _transmission(transmission), _collisions(transmission))
        yield _losses(mesh)
        yield from _impact_section(transmission, operation)


def triangular_verdict(mesh: TriangularMesh) -> str:
    """Return a sentence that says whether the pair can turn or, if not, gives the reason and the remedy."""
    transmission, found = mesh.transmission, mesh.transmission.verdict
    words = [f"Verdict: {found.kind}: {found.text}."]
    if not found:
        why, fix = explain_clearance(transmission, mesh.window)
        words += [f"Why: {why}." if why else "", f"What to do: {fix}."]
    elif mesh.losses.locks:
        (lock,) = mesh.friction_faults()
        words = [f"Verdict: friction locks: {lock.what}.", f"Why: {lock.why}.", f"What to do: {lock.fix}."]
    return " ".join(word for word in words if word)


def _sizes(transmission: TriangularTransmission) -> Section:
    sizes = transmission.sizes
    names = [
        f"{name}, a ring" if sign < 0 else name for name, sign in zip(("driver", "driven"), sizes.signs, strict=True)
    ]
    counts, angles, radii = (sizes.z1, sizes.z2), (sizes.beta1, sizes.beta2), (sizes.R1, sizes.R2)
    columns = zip(names, counts, angles, radii, sizes.depths, sizes.flanks, (sizes.p1, sizes.p2), strict=True)
    rows = [
        (name, str(z), _deg(beta), figure(R), figure(h), figure(e), _deg(pitch))
        for name, z, beta, R, h, e, pitch in columns
    ]
    header = ("wheel", "teeth", "half angle", "tip radius", "depth", "flank", "pitch")
    text = f"Centre distance {figure(sizes.D)}, in the unit of radii, depths and flanks (Eqs. 1 to 3). Angles in deg."
    return Section("Sizes", (text,), (Table(header, rows),))


def _clearance(transmission: TriangularTransmission, window: ClearanceWindow) -> Section:
    sizes = transmission.sizes
    turns = (
        f"These teeth turn from {window.jam_factor:.6f} ({window.jam_kind}) to {window.run_factor:.6f} "
        f"({window.run_kind})"
        if window
        else f"No clearance factor works: {window.jam_kind} up to {window.jam_factor:.6f}, {window.run_kind} from "
        f"{window.run_factor:.6f}"
    )
    lines = [
        f"Clearance factor {sizes.clearance_factor:.9g}. {turns}; beyond {window.reach_factor:.6f} tips never touch."
    ]
    if sizes.ring:
        depth = sizes.delta / min(sizes.depths)
        lines.append(
            f"A ring is deepest at the maximum distance. The tips overlap by {depth:.4g} of the smaller depth."
        )
    if transmission.intervals:
        backlash = transmission.verdict.backlash
        # pitch radius of the driven wheel: R2 = D z2 / (z1 + z2)
        arc = backlash * sizes.D * sizes.z2 / sizes.pitch_sum
        lines.append(
            f"Minimum backlash over a pitch: {degrees(backlash):.6g} deg of the driven wheel, an arc of {arc:.6g} on "
            "its pitch circle."
        )
    return Section("Clearance", lines)


def _path(transmission: TriangularTransmission) -> Section:
    sizes = transmission.sizes
    ideal = (
        f"On the ideal path, a tooth pair is in contact from alpha_1 = {_deg(sizes.reach1)} to {_deg(-sizes.reach1)} "
        f"deg (Eq. 4), with matching flanks at {_deg(sizes.matching)} deg (Eq. 10): approach before, recess after. The "
        f"real path is one pitch, {_deg(sizes.p1)} deg. alpha_1 decreases with time."
    )
    rows = []
    for interval in transmission.intervals:
        taus = (figure(transmission.contact.speed(interval, end)) for end in (interval.start, interval.end))
        share = interval.width / sizes.p1  # width of the interval in pitches
        rows.append((interval.phase, _deg(interval.start), _deg(interval.end), f"{share:.4f}", *taus))
    header = ("phase", "from alpha_1", "to alpha_1", "pitches", "tau at first", "tau at last")
    return Section("Path of contact", (ideal,), (Table(header, rows),))


def _course(mesh: TriangularMesh) -> Section:
    """Return a section with a table of speed ratio, instant centre and moment arms at the ends of contact intervals."""
    found = contact_course(mesh.transmission, friction=pair_friction(mesh.wheels))
    angles, lengths = (found.alpha1, found.alpha2), (found.speed_ratio, found.instant_centre, found.driver_arm)
    columns = (each.tolist() for each in (*angles, *lengths, found.driven_arm, found.efficiency))
    rows = [
        (phase, _deg(x), _deg(y), *(figure(value) if isfinite(value) else "-" for value in values))
        for phase, x, y, *values in zip(found.phases, *columns, strict=True)
    ]
    header = ("phase", "alpha_1", "alpha_2", "tau", "O1C", "b1", "b2", "efficiency")
    text = (
        "O1C: the instant centre of the relative motion, on the line of centres, from the driver's axis (Eqs. 11, 18). "
        "b1, b2: arms of the force about the driver's and the driven axis (Eqs. 28 to 31); efficiency is tau b2/b1. "
        "Lengths as under Sizes, angles in deg."
    )
    return Section("Over the pitch", (text,), (Table(header, rows),))


def _transmission(transmission: TriangularTransmission) -> Section:
    minimum, most = transmission.speed_range()
    low, high = transmission.error_range()
    lag, rms = transmission.error_moments()
    mean = float(transmission.ratio)
    rows = [
        ("speed ratio, mean", f"{transmission.ratio} = {figure(transmission.ratio)}", ""),
        ("speed ratio, minimum", figure(minimum), f"{(minimum / mean - 1) * 100:+.3f} %"),
        ("speed ratio, maximum", figure(most), f"{(most / mean - 1) * 100:+.3f} %"),
        _angle("transmission error, peak to peak", high - low),
        _angle("transmission error, rms", rms),
        _angle("transmission error, mean", lag),
    ]
    text = (
        "Transmission error: driven angle minus its mean motion, positive where the driven wheel is ahead, measured "
        "from the position with a tooth of the driver on the line of centres."
    )
    return Section("Transmission function", (text,), (Table(("quantity", "value", ""), rows),))


def _collisions(transmission: TriangularTransmission) -> Section:
    rows = [
        (jump.kind, _deg(jump.alpha1), figure(jump.before), figure(jump.after), f"{jump.value:.5f}")
        for jump in transmission.jumps
    ]
    header = ("begins", "at alpha_1", "tau before", "tau after", "jump")
    text = "Jump: 1 - before/after, the jump of normal velocity divided by the driver's (Eqs. 22, 25, 26, 27)."
    return Section("Collisions", (text,), (Table(header, rows),))


def _losses(mesh: TriangularMesh) -> Section:
    transmission = mesh.losses
    if (known := without_losses(mesh)) is not None:
        return known
    if transmission.locks:
        (lock,) = mesh.friction_faults()
        return Section("Friction", (f"{lock.what}: {lock.why}.",))
    lines = [
        f"{mesh.friction_words}. Sliding efficiency: mean {transmission.efficiency_mean():.9f} at constant "
        f"driver torque (Eq. 34), {transmission.efficiency_at_constant_load():.9f} at constant load torque, minimum "
        f"{transmission.efficiency_minimum():.6f}.",
    ]
    if isfinite(transmission.locking_friction):
        lines.append(f"These teeth lock from a friction coefficient of {transmission.locking_friction:.6g} on.")
    return Section("Friction", lines)


def _impacts(transmission: TriangularTransmission, operation: PairOperation | None) -> PairImpacts | None:
    """Return the impacts for given operating data; None if `operation` is None, or if the teeth never touch."""
    from geartrain.dynamics.motion.pair_impacts import find_pair_impacts

    return None if operation is None or not transmission.intervals else find_pair_impacts(transmission, operation)


def _impact_section(transmission: TriangularTransmission, operation: PairOperation | None) -> Iterator[Section]:
    found = _impacts(transmission, operation)
    if found is None or operation is None:
        return
    lines = []
    if found.work is not None:
        # [W]: work per pitch x pitches per second
        watts = found.work * (operation.rate or 0) * transmission.sizes.z1
        lines.append(
            f"At {operation.rate:g} turns of the driver per second, the impacts of one pitch transfer "
            f"{found.handed:.6g} J to the driven side and dissipate {found.dissipated:.6g} J. The driver supplies "
            f"their sum, {found.work:.6g} J, or {watts:.6g} W. Sorge counts the transferred energy as lost; "
            "inelastic impacts lose only the dissipated energy."
        )
        lines.append(
            f"The driven inertia stays in contact as tau falls if the load torque is at least {found.minimum_load:.6g} "
            "N m."
        )
    if found.void is not None:
        lines.append(
            f"With a load torque of {operation.load:g} N m the quasi-static motion is invalid above {found.void:.6g} "
            f"turns of the driver per second ({2 * pi * found.void:.6g} rad/s)."
        )
    if not lines:
        lines.append(
            "Give a rate to compute the impacts, or a load torque to compute the speed above which the quasi-static "
            "motion is invalid."
        )
    yield Section("Impacts", lines)


def _deg(angle: float) -> str:
    return f"{degrees(angle):.6g}" if isfinite(angle) else "none"
