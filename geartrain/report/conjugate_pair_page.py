"""Documents on one pair of wheels with conjugate teeth, and on tooth forms compared with the 20 degree involute.

The document on a pair has sections on the wheels, the path of contact, losses and stresses, and friction.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, degrees, isfinite
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, figure
from geartrain.report.gear_pairs import without_losses
from geartrain.teeth.conjugate.path_losses import FREE, LOADED, ONE_PAIR, SHARED, depth

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_mesh import DesignLosses, PairDesign
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.form_comparison import FormComparison, MeasuredForm


def conjugate_verdict(design: PairDesign) -> str:
    """Return a sentence that says whether the teeth can run or, if not, gives each reason with its remedy."""
    if design.runs and design.locks:
        return "Verdict: the teeth keep the ratio exactly at every instant, but friction locks them."
    if design.runs:
        return "Verdict: the teeth run, and keep the ratio exactly at every instant."
    faults = design.mesh.verdict.faults
    reasons = " ".join(f"{f.what.capitalize()}: {f.why}. What to do: {f.fix}." for f in faults)
    return f"Verdict: these teeth cannot run. {reasons}"


def conjugate_sections(design: PairDesign) -> Iterator[Section]:
    """Yield the sections on a pair; those on losses and friction only if the teeth can run."""
    yield from (_wheels(design), _path(design))
    if design.losses_and_stresses is not None:
        yield from (_losses_and_stresses(design.losses_and_stresses), _friction(design))


def _wheels(design: PairDesign) -> Section:
    pitch = design.path.pitch
    # sizes of bevel wheels are cone angles, of others radii
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
            f" The helix angle is {degrees(helix):.6g} deg. Sizes, losses and stresses are those of spur teeth in the "
            f"transverse section with increased friction; a transverse module is {1 / cos(helix):.9g} normal modules."
        )
    if pitch.bevel:
        text = "Half-angles of cones; thickness of a tooth on the pitch cone in pitches."
    return Section("Wheels", (text,), (Table(header, rows),))


def _path(design: PairDesign) -> Section:
    path = design.path
    rows = []
    for recess, name, arc in ((False, "approach", design.arcs[0]), (True, "recess", design.arcs[1])):
        first, last = path.span(recess) or (0.0, 0.0)
        psi = [degrees(float(path.along(d, recess).psi)) if last else 0.0 for d in (first, last)]
        # a side without contact has no ends
        ends = (f"{value:.6f}" if last else "-" for value in psi)
        rows.append((name, f"{arc:.6g}", figure(last - first), *ends))
    header = ("side", "pitches", "length of path", "psi at the near end (deg)", "psi at the far end (deg)")
    text = (
        f"Contact ratio {path.contact_ratio:.6g}, working depth {figure(depth(path))}; psi is the pressure angle at "
        "the ends near the pitch point and far from it. "
        f"Lengths in {'rad on the unit sphere' if path.pitch.bevel else 'modules'}."
    )
    lines = [text]
    # contact only before, or only after, the pitch point
    if min(path.arcs) < 0:
        lines.append(
            "A negative arc means that all contact is on the other side of the pitch point, and begins or ends at this "
            "distance from it."
        )
    return Section("Path of contact", lines, (Table(header, rows),))


_LOADED = {
    "loss": "mean loss divided by friction",
    "stress": "maximum Hertz pressure divided by the root of tangential force",
    "off_pitch": "the same more than a tenth of a pitch from the pitch point",
    "heat": "maximum heat per area divided by friction times tangential force",
    "flash": "maximum flash temperature (proxy)",
}


def _losses_and_stresses(found: DesignLosses) -> Section:
    loads = found.measures.one_pair, found.measures.shared
    loaded = [(words, *(cost(getattr(costs, name)) for costs in loads)) for name, words in _LOADED.items()]
    free = [
        ("maximum sliding divided by the pitch-line speed", cost(found.sliding)),
        ("maximum sliding divided by the contact's speed along a flank", cost(found.specific_sliding)),
        ("minimum speed along a dedendum divided by the pitch-line speed", cost(found.measures.slowest)),
    ]
    text = (
        f"To first order in friction. One pair: {ONE_PAIR}; the loss is the mean along the path. Shared: {SHARED}; "
        "the loss is the mean over a pitch. The efficiency below is that of shared load."
    )
    tables = Table(("quantity", "one pair", "shared"), loaded), Table(("quantity, whatever the load", "value"), free)
    return Section("Losses and stresses", (text,), tables)


def _friction(design: PairDesign) -> Section:
    transmission = design.mesh.losses
    if (known := without_losses(design.mesh)) is not None:
        return known
    text = (
        f"A friction coefficient of {transmission.friction:.6g} locks these teeth, which lock from "
        f"{transmission.locking_friction:.6g} on."
        if design.locks
        else f"{design.mesh.friction_words}. Efficiency, exact in friction, with the load shared equally by teeth in "
        f"contact: mean {transmission.efficiency_mean():.9f} at constant driver torque, "
        f"{transmission.efficiency_at_constant_load():.9f} at constant load torque, minimum "
        f"{transmission.efficiency_minimum():.9f}."
    )
    return Section("Friction", (text,))


def pair_name(path: PathOfContact) -> str:
    """Return a text with the tooth counts and the kind of a pair, such as `24/18 spur`."""
    pitch = path.pitch
    kind = f"bevel, {degrees(pitch.R1 + pitch.R2):.6g} deg" if pitch.bevel else "internal" if pitch.R2 < 0 else "spur"
    return f"{pitch.z1}/{pitch.z2} {kind}"


def cost(value: float) -> str:
    """Return a text with a loss or stress; `inf` if the value is infinite."""
    return f"{value:.9g}" if isfinite(value) else "inf"


# -------------------------------------------------------------------------------------------------- comparison of forms


def describe_form_comparison(found: FormComparison) -> Document:
    """Return a document that compares tooth forms with the 20 degree involute and lists the forms that cannot run."""
    text = (
        "Ratios to the 20 degree involute. Loss: mean power loss; stress: maximum Hertz pressure, infinite if the "
        "pressure angle is 0 at the pitch point; stress off pitch: the same more than a tenth of a pitch from the "
        "pitch point; heat: maximum heat of friction per area; flash: maximum flash temperature; depth: working "
        "depth; slowest: minimum speed of the contact along a dedendum. Arcs: approach and recess in pitches. For "
        f"loss, stress, heat and flash, {ONE_PAIR}."
    )
    header = ("form", "arcs", *map(_header, (*LOADED, *FREE)))
    table = Table(header, list(map(_ratios, found.forms)), True)
    sections = [Section("Ratios", (text,), [table]), _sharing(found), _base(found)]
    faults = [(form.name, fault) for form in found.forms for fault in form.faults]
    if faults:
        reasons = [f"{name}: {'; '.join(filter(None, (fault.what, fault.why, fault.fix)))}." for name, fault in faults]
        sections.append(Section("Forms that cannot run", reasons))
    return Document(f"Tooth forms, {pair_name(found.path)}", [found.matched], sections)


def _header(name: str) -> str:
    return "stress off pitch" if name == "off_pitch" else name.replace("_", " ")


def _sharing(found: FormComparison) -> Section:
    """Return the section on load sharing by tooth pairs; it is one sentence if no contact ratio exceeds 1."""
    base = found.measures
    runs = [form.measures for form in found.forms if form.runs and form.measures]
    if all(each.contact_ratio < 1 + 1e-9 for each in (base, *runs)):  # tolerance for a contact ratio of exactly 1
        text = "Only one tooth pair is in contact at a time, so that the ratios are the same."
        return Section("Ratios, shared load", (text,))
    table = Table(("form", *map(_header, LOADED)), [_shared(form) for form in found.forms], True)
    return Section("Ratios, shared load", (f"As above, but {SHARED}.",), [table])


def _shared(form: MeasuredForm) -> tuple[str, ...]:
    ratios = None if form.ratios is None else form.ratios.shared
    return (form.name, *("-" if ratios is None else _ratio(ratios[name]) for name in LOADED))


def _ratios(form: MeasuredForm) -> tuple[str, ...]:
    if form.ratios is None:
        words = ", ".join(dict.fromkeys(fault.kind for fault in form.faults))
        return (form.name, _arcs(form), words, *("-" for _ in (*LOADED, *FREE)[1:]))
    every = form.ratios.one_pair | form.ratios.free
    return (form.name, _arcs(form), *(_ratio(every[name]) for name in (*LOADED, *FREE)))


def _ratio(value: float) -> str:
    return f"{value:.4f}" if isfinite(value) else "inf"


def _arcs(form: MeasuredForm) -> str:
    return "-" if form.pitches is None else " + ".join(f"{arc:.4g}" for arc in form.pitches)


def _base(found: FormComparison) -> Section:
    base = found.measures
    loads = base.one_pair, base.shared
    rows = [(_header(name), *(cost(getattr(each, name)) for each in loads)) for name in LOADED]
    rows += [(_header(name), *[cost(getattr(base, name))] * 2) for name in FREE]
    unit = "rad on the unit sphere" if found.path.pitch.bevel else "modules"
    text = (
        f"Values of the 20 degree involute, lengths in {unit}: mean loss divided by friction; maximum Hertz pressure "
        "as the root of curvature divided by cos psi; maximum heat divided by friction times tangential force."
    )
    return Section("The involute of 20 deg", (text,), (Table(("quantity", "one pair", "shared"), rows),))
