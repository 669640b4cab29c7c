"""A page on one pair of wheels with conjugate teeth."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Document, Section, Table, figure
from geartrain.teeth.transmission_figures import SlidingEfficiency

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.path_costs import PathMeasures
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.outlines.wheel_outline import WheelOutline

LOADED = ("loss", "stress", "off_pitch", "heat", "flash")
"""Costs that depend on how the load is shared, in the order of tables."""

FREE = ("depth", "contact_ratio", "slowest")
"""Measures that do not."""


def shape_document(name: str, law: ConjugateTransmission, wheels: Sequence[WheelOutline] = ()) -> Document:
    """Wheels, path of contact, costs and faults of one pair."""
    from geartrain.teeth.conjugate.path_costs import measure

    pitch = law.path.pitch
    driver, driven = (pitch.z1, pitch.z2) if law.driver == 1 else (pitch.z2, pitch.z1)
    lead = [f"The wheel of {driver} drives the wheel of {driven}.", _verdict(law)]
    sections = [_wheels(law), _path(law)]
    if law.verdict:
        sections += [_costs(law, measure(law.path)), _friction(law), *map(_outline, wheels)]
    return Document(f"{name.replace('_', ' ').capitalize()} teeth {pair_name(law.path)}", lead, sections)


def _verdict(law: ConjugateTransmission) -> str:
    verdict = law.verdict
    if verdict and law.friction >= law.locking_friction:
        return "Verdict: the teeth keep the ratio exactly at every instant, but friction locks them."
    if verdict:
        return "Verdict: the teeth run, and keep the ratio exactly at every instant."
    reasons = " ".join(f"{f.what.capitalize()}: {f.why}. What to do: {f.fix}." for f in verdict.faults)
    return f"Verdict: these teeth cannot run. {reasons}"


def _wheels(law: ConjugateTransmission) -> Section:
    from geartrain.teeth.conjugate.admissibility import tip_thickness

    pitch, p = law.path.pitch, law.path.pitch.p
    rows = []
    for gear, (z, R) in enumerate(((pitch.z1, pitch.R1), (pitch.z2, pitch.R2)), 1):
        low, high = reaches(law.path, gear, law.pair.arcs)
        thick = 2 * law.pair.halves[gear - 1] / p
        solid = law.pair.solid[gear - 1]
        land = degrees(tip_thickness(law.path, gear, law.pair.halves)) if solid else float("nan")
        size = degrees if pitch.bevel else float
        rows.append(
            (
                str(gear),
                str(z),
                *(figure(size(value), 9) for value in (abs(R), low, high)),
                f"{thick:.6g}",
                f"{land:.4g}" if solid else "-",
            )
        )
    what = "cone (deg)" if pitch.bevel else "radius"
    header = ("wheel", "teeth", f"pitch {what}", f"flank from {what}", f"to {what}", "thickness", "top land (deg)")
    distance = "" if pitch.bevel else f"Centre distance {figure(abs(pitch.R1 + pitch.R2), 9)} modules. "
    text = f"{distance}Radii in modules; thickness of a tooth, or pin, on the pitch circle in pitches."
    if pitch.bevel:
        text = "Half-angles of cones; thickness of a tooth on the pitch cone in pitches."
    return Section("Wheels", (text,), (Table(header, rows),))


def reaches(path: PathOfContact, gear: int, arcs: tuple[float, float]) -> tuple[float, float]:
    """Radii (modules; half-angles of cones, rad) between which a flank works, root end first."""
    import numpy as np

    approach, recess = arcs
    ends = np.array([-approach, recess] if gear == 1 else [recess, -approach])
    pitch = path.pitch
    points = (path.flank1 if gear == 1 else path.flank2)(ends)
    R = -pitch.R1 if gear == 1 else pitch.R2
    if pitch.bevel:
        axis = np.array([0.0, np.sin(R), np.cos(R)])
        low, high = np.arctan2(np.linalg.norm(np.cross(points, axis), axis=1), points @ axis)
    else:
        low, high = np.hypot(points[:, 0], points[:, 1] - R)
    return float(low), float(high)


def _path(law: ConjugateTransmission) -> Section:
    from geartrain.teeth.conjugate.path_costs import depth

    path = law.path
    rows = []
    for recess, name, arc in ((False, "approach", path.arcs[0]), (True, "recess", path.arcs[1])):
        first, last = path.span(recess) or (0.0, 0.0)
        psi = [degrees(float(path.along(d, recess).psi)) if last else 0.0 for d in (first, last)]
        ends = (f"{value:.6f}" if last else "-" for value in psi)
        rows.append((name, f"{arc / path.pitch.p:.6g}", figure(last - first), *ends))
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


def _costs(law: ConjugateTransmission, found: PathMeasures) -> Section:
    from geartrain.teeth.conjugate.path_costs import ONE_PAIR, SHARED

    slide, specific = sliding(law.path)
    loads = found.one_pair, found.shared
    loaded = [(words, *(cost(getattr(costs, name)) for costs in loads)) for name, words in _LOADED.items()]
    free = [
        ("greatest sliding over the pitch-line speed", cost(slide)),
        ("greatest sliding over the contact's speed along a flank", cost(specific)),
        ("least speed along a dedendum over the pitch-line speed", cost(found.slowest)),
    ]
    text = (
        f"To first order in friction. One pair: {ONE_PAIR}, the loss is the mean along it. Shared: {SHARED}, the "
        "loss is the mean over a pitch; the efficiency below shares the load so, too."
    )
    tables = Table(("quantity", "one pair", "shared"), loaded), Table(("quantity, whatever the load", "value"), free)
    return Section("Costs", (text,), tables)


def sliding(path: PathOfContact) -> tuple[float, float]:
    """Greatest sliding over the pitch-line speed, and over the slower of the contact's speeds along the flanks."""
    import numpy as np

    from geartrain.teeth.conjugate.path_costs import greatest

    pitch = path.pitch
    slide = greatest(path, lambda c: (pitch.A + pitch.B) * np.abs(pitch.S(c.d)))
    return slide, greatest(path, lambda c: c.Q1.clip(c.Q2) * c.cos_psi)


def _friction(law: ConjugateTransmission) -> Section:
    if not law.friction:
        return Section("Friction", ("No friction is given: nothing is lost by sliding.",))
    if law.friction >= law.locking_friction:
        return Section(
            "Friction", (f"A friction of {law.friction:g} locks these teeth, as any from {law.locking_friction:.6g}.",)
        )
    return Section(
        "Friction",
        (
            f"Coefficient of friction {law.friction:g}. Efficiency, exact in friction, teeth in contact sharing the "
            f"load equally: mean {law.efficiency_mean():.9f} at constant driver torque, "
            f"{law.efficiency_at_constant_load():.9f} at constant load torque, least {law.efficiency_least():.9f}.",
        ),
    )


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


def shape_data(name: str, law: ConjugateTransmission, wheels: Sequence[WheelOutline] = ()) -> dict[str, Any]:
    """One pair as plain data; lengths in modules (bevel: rad), angles in rad, infinite values null.

    Costs and efficiency of teeth that cannot run are null.
    """
    path, pitch = law.path, law.path.pitch
    return {
        "form": name,
        "teeth": [pitch.z1, pitch.z2],
        "verdict": law.verdict.to_dict(),
        "pitch_radii": [pitch.R1, pitch.R2],
        "flanks": [list(reaches(path, gear, law.pair.arcs)) for gear in (1, 2)],
        "thickness": [2 * half / pitch.p for half in law.pair.halves],
        "arcs": [arc / pitch.p for arc in law.pair.arcs],
        "contact_ratio": path.contact_ratio,
        "pressure_angles": [float(path.at(X).psi) for X in (-path.arcs[0], 0.0, path.arcs[1])],
        "costs": _costs_data(law) if law.verdict else None,
        "efficiency": _efficiency_data(law) if law.verdict else None,
        "outlines": [wheel.to_dict() for wheel in wheels],
    }


def _efficiency_data(law: ConjugateTransmission) -> dict[str, Any]:
    from geartrain.teeth.conjugate.path_costs import SHARED

    return {"assumption": SHARED} | SlidingEfficiency(law).to_dict()


def _costs_data(law: ConjugateTransmission) -> dict[str, Any]:
    from geartrain.teeth.conjugate.path_costs import measure

    slide, specific = sliding(law.path)
    return measures_data(measure(law.path)) | {"sliding": slide, "specific_sliding": finite(specific)}


# ------------------------------------------------------------------------------------------------------------- shared


def pair_name(path: PathOfContact) -> str:
    """Tooth numbers and kind of a pair."""
    pitch = path.pitch
    kind = f"bevel, {degrees(pitch.R1 + pitch.R2):.6g} deg" if pitch.bevel else "internal" if pitch.R2 < 0 else "spur"
    return f"{pitch.z1}/{pitch.z2} {kind}"


def cost(value: float) -> str:
    """A cost as text."""
    return f"{value:.9g}" if isfinite(value) else "inf"


def measures_data(found: PathMeasures) -> dict[str, Any]:
    """Measures as plain data, costs under the assumption on the load they have; infinite ones are null."""
    from geartrain.teeth.conjugate.path_costs import ONE_PAIR, SHARED

    loads = {"one_pair": (ONE_PAIR, found.one_pair), "shared": (SHARED, found.shared)}
    costs = {
        key: {"assumption": words} | {name: finite(getattr(each, name)) for name in LOADED}
        for key, (words, each) in loads.items()
    }
    return costs | {name: finite(getattr(found, name)) for name in FREE}


def finite(value: float) -> float | None:
    """None for what is infinite or undetermined: JSON has neither."""
    return value if isfinite(value) else None
