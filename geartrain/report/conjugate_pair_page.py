"""A page on one pair of wheels with conjugate teeth: wheels, path of contact, what it costs, friction."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, degrees, isfinite
from typing import TYPE_CHECKING

from geartrain.report.document import Section, Table, figure

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_mesh import DesignCosts, PairDesign
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact


def conjugate_verdict(design: PairDesign) -> str:
    """Whether the teeth can run, and if not, each reason with what to do."""
    if design.runs and design.locks:
        return "Verdict: the teeth keep the ratio exactly at every instant, but friction locks them."
    if design.runs:
        return "Verdict: the teeth run, and keep the ratio exactly at every instant."
    faults = design.mesh.verdict.faults
    reasons = " ".join(f"{f.what.capitalize()}: {f.why}. What to do: {f.fix}." for f in faults)
    return f"Verdict: these teeth cannot run. {reasons}"


def conjugate_sections(design: PairDesign) -> Iterator[Section]:
    """What there is to tell; of teeth that cannot run, wheels and path only."""
    yield from (_wheels(design), _path(design))
    if design.costs is not None:
        yield from (_costs(design.costs), _friction(design))


def _wheels(design: PairDesign) -> Section:
    pitch = design.path.pitch
    size = degrees if pitch.bevel else float
    columns = zip(design.teeth, design.pitch_radii, design.flanks, design.thickness, design.top_lands, strict=True)
    rows = [
        (
            str(gear),
            str(z),
            *(figure(size(value), 9) for value in (abs(R), *flank)),
            f"{thickness:.6g}",
            "-" if land is None else f"{degrees(land):.4g}",
        )
        for gear, (z, R, flank, thickness, land) in enumerate(columns, 1)
    ]
    what = "cone (deg)" if pitch.bevel else "radius"
    header = ("wheel", "teeth", f"pitch {what}", f"flank from {what}", f"to {what}", "thickness", "top land (deg)")
    distance = "" if pitch.bevel else f"Centre distance {figure(abs(pitch.R1 + pitch.R2), 9)} modules. "
    text = f"{distance}Radii in modules; thickness of a tooth, or pin, on the pitch circle in pitches."
    if helix := abs(design.mesh.wheels.helix[0]):
        text += (
            f" Teeth lean by {degrees(helix):.6g} deg: sizes and costs are those of straight teeth in the section "
            f"across the axes, in transverse modules of {1 / cos(helix):.9g} normal ones, with more friction."
        )
    if pitch.bevel:
        text = "Half-angles of cones; thickness of a tooth on the pitch cone in pitches."
    return Section("Wheels", (text,), (Table(header, rows),))


def _path(design: PairDesign) -> Section:
    from geartrain.teeth.conjugate.path_costs import depth

    path = design.path
    rows = []
    for recess, name, arc in ((False, "approach", design.arcs[0]), (True, "recess", design.arcs[1])):
        first, last = path.span(recess) or (0.0, 0.0)
        psi = [degrees(float(path.along(d, recess).psi)) if last else 0.0 for d in (first, last)]
        ends = (f"{value:.6f}" if last else "-" for value in psi)
        rows.append((name, f"{arc:.6g}", figure(last - first), *ends))
    header = ("side", "pitches", "length of path", "psi at the near end (deg)", "psi at the far end (deg)")
    text = (
        f"Contact ratio {path.contact_ratio:.6g}, working depth {figure(depth(path))}; psi is the pressure angle, at "
        "the ends near to the pitch point and far from it. "
        f"Lengths in {'rad on the unit sphere' if path.pitch.bevel else 'modules'}."
    )
    lines = [text]
    if min(path.arcs) < 0:
        lines.append(
            "A negative arc: all contact is on the other side of the pitch point, and begins, or ends, so far from it."
        )
    return Section("Path of contact", lines, (Table(header, rows),))


_LOADED = {
    "loss": "mean loss over friction",
    "stress": "greatest Hertz pressure over the root of tangential force",
    "off_pitch": "the same more than a tenth of a pitch from the pitch point",
    "heat": "greatest heat per area over friction times tangential force",
    "flash": "greatest flash proxy",
}


def _costs(found: DesignCosts) -> Section:
    from geartrain.teeth.conjugate.path_costs import ONE_PAIR, SHARED

    loads = found.measures.one_pair, found.measures.shared
    loaded = [(words, *(cost(getattr(costs, name)) for costs in loads)) for name, words in _LOADED.items()]
    free = [
        ("greatest sliding over the pitch-line speed", cost(found.sliding)),
        ("greatest sliding over the contact's speed along a flank", cost(found.specific_sliding)),
        ("least speed along a dedendum over the pitch-line speed", cost(found.measures.slowest)),
    ]
    text = (
        f"To first order in friction. One pair: {ONE_PAIR}, the loss is the mean along it. Shared: {SHARED}, the "
        "loss is the mean over a pitch; the efficiency below shares the load so, too."
    )
    tables = Table(("quantity", "one pair", "shared"), loaded), Table(("quantity, whatever the load", "value"), free)
    return Section("Costs", (text,), tables)


def _friction(design: PairDesign) -> Section:
    law = design.mesh.losses
    if not design.mesh.rubs:
        return Section("Friction", ("No friction is given: nothing is lost by sliding.",))
    if not design.mesh.tells_losses:
        return Section("Friction", (f"{design.mesh.friction_words}.",))
    if design.locks:
        return Section(
            "Friction",
            (f"A friction of {law.friction:.6g} locks these teeth, as any from {law.locking_friction:.6g}.",),
        )
    return Section(
        "Friction",
        (
            f"{design.mesh.friction_words}. Efficiency, exact in friction, teeth in contact sharing the "
            f"load equally: mean {law.efficiency_mean():.9f} at constant driver torque, "
            f"{law.efficiency_at_constant_load():.9f} at constant load torque, least {law.efficiency_least():.9f}.",
        ),
    )


def pair_name(path: PathOfContact) -> str:
    """Tooth numbers and kind of a pair."""
    pitch = path.pitch
    kind = f"bevel, {degrees(pitch.R1 + pitch.R2):.6g} deg" if pitch.bevel else "internal" if pitch.R2 < 0 else "spur"
    return f"{pitch.z1}/{pitch.z2} {kind}"


def cost(value: float) -> str:
    """A cost as text."""
    return f"{value:.9g}" if isfinite(value) else "inf"
