"""Gear pairs of a train with conjugate teeth, as a table and as plain data.

Real teeth and pins as sections of a train's report, and as plain data.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, isfinite, isnan, nan
from typing import TYPE_CHECKING, Any

from geartrain.analysis.gear_train import GearTrain
from geartrain.report.document import Section, Table
from geartrain.report.pair_page import Running, find_impacts
from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh, explain_clearance

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

    AnyConjugateLaw = ConjugateTransmission | OffDesignTransmission

WORDS = (
    "Conjugate teeth keep the ratio of tooth counts at every instant where their axes are as far apart as they are "
    "made for, involutes at any distance; others have an error there. Arcs of the driver's approach and recess, "
    "and contact ratio, in pitches, as designed; error and play in degrees of the driven wheel; mean efficiency "
    "at constant driver torque, exact in friction, as the pair is driven and driven back, teeth in contact sharing "
    "the load equally."
)


def conjugate_table(meshes: Sequence[ConjugateMesh]) -> Table:
    """One row a pair."""
    figures = ("arcs", "contact ratio", "error p-p (deg)", "play (deg)", "efficiency", "driven back")
    return Table(("pair", "drives", "teeth", *figures, "verdict"), [_row(mesh) for mesh in meshes], wide=True)


def _row(mesh: ConjugateMesh) -> tuple[str, ...]:
    law, p = mesh.law, mesh.law.path.pitch.p
    arcs = " + ".join(f"{round(arc / p, 9):.4g}" for arc in driver_arcs(law))
    known = mesh.friction is not None and mesh.verdict
    low, high = law.error_range() if mesh.rigid or mesh.verdict else (nan, nan)
    ways = [_efficiency(way) if known else "-" for way in (law, mesh.reversed)]
    return (
        mesh.name,
        f"{mesh.driver} -> {mesh.driven}",
        mesh.form.replace("_", " "),
        arcs,
        f"{law.path.contact_ratio:.5g}",
        "-" if isnan(low) else f"{degrees(high - low):.6g}",
        f"{degrees(mesh.verdict.play):.4g}",
        *ways,
        mesh.verdict.kind,
    )


def _efficiency(law: AnyConjugateLaw) -> str:
    return "locks" if law.friction >= law.locking_friction else f"{law.efficiency_mean():.6f}"


def driver_arcs(law: AnyConjugateLaw) -> tuple[float, float]:
    """The driver's approach and recess (X)."""
    approach, recess = law.path.arcs
    return (approach, recess) if law.driver == 1 else (recess, approach)


def conjugate_data(mesh: ConjugateMesh) -> dict[str, Any]:
    """One pair as plain data, with the keys of other teeth where they mean the same; angles in rad."""
    law, path = mesh.law, mesh.law.path
    pitch, verdict = path.pitch, mesh.verdict
    teeth = [pitch.z1, pitch.z2] if law.driver == 1 else [pitch.z2, pitch.z1]
    first = verdict.faults[0] if verdict.faults else None
    return {
        "teeth": teeth,
        "verdict": {
            **verdict.to_dict(),
            "why": first.why if first else "",
            "fix": first.fix if first else "",
        },
        "gears": list(mesh.gears),
        "note": mesh.note,
        "play": verdict.play,
        "arcs": [arc / pitch.p for arc in driver_arcs(law)],
        "contact_ratio": path.contact_ratio,
        "pressure_angle": float(path.at(0.0).psi),
        "shaft_angle": pitch.R1 + pitch.R2 if pitch.bevel else None,
        **_conjugate_law_data(law, mesh.rigid or bool(verdict)),
        "efficiency": efficiency_data(law) if verdict else None,
    }


def _conjugate_law_data(law: AnyConjugateLaw, runs: bool) -> dict[str, Any]:
    if not runs:
        return {"speed_ratio": None, "transmission_error": None}
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    return {
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "transmission_error": {"peak_to_peak": high - low, "rms": rms, "mean": lag},
    }


def efficiency_data(law: TriangularTransmission | AnyConjugateLaw) -> dict[str, float | None]:
    """Friction and what it costs; null where it locks."""
    locks = law.friction >= law.locking_friction
    return {
        "friction": law.friction,
        "mean": None if locks else law.efficiency_mean(),
        "at_constant_load": None if locks else law.efficiency_at_constant_load(),
        "min": None if locks else law.efficiency_least(),
        "locks_at": law.locking_friction if isfinite(law.locking_friction) else None,
    }


_TRIANGULAR = (
    "Triangular teeth, each pair in its carrier's frame. Speed ratio over its mean, transmission error of the driven "
    "wheel, mean sliding efficiency at constant driver torque, relative leaps of normal velocity."
)


def teeth_sections(train: GearTrain) -> Iterator[Section]:
    """The real teeth and pins of a train; nothing where none are declared."""
    if train.meshes:
        yield _teeth(train)
    if train.pins:
        yield _pins(train)


def _teeth(train: GearTrain) -> Section:
    lines: list[str] = []
    tables: list[Table] = []
    ways = [mesh for mesh, _ in driven_ways(train)]
    if triangular := [mesh for mesh in ways if isinstance(mesh, TriangularMesh)]:
        lines.append(_TRIANGULAR)
        tables += _triangular_tables(triangular)
    if conjugate := [mesh for mesh in ways if isinstance(mesh, ConjugateMesh)]:
        lines.append(WORDS)
        tables.append(conjugate_table(conjugate))
    tables.append(_drivers(train))
    lines += [f"Pair '{mesh.name}': {mesh.note}." for mesh in train.meshes if mesh.note]
    for fault in train.faults:
        lines.append(f"{fault.what}; {fault.why}. {fault.fix}." if fault.why else f"{fault.what}. {fault.fix}.")
    return Section("Teeth", lines, tables)


def driven_ways(train: GearTrain) -> Iterator[tuple[GearMesh, tuple[str, ...]]]:
    """Every pair with real teeth in every way it is driven, with the states in which it is."""
    for ways in train.driven_ways.values():
        yield from ways


def _drivers(train: GearTrain) -> Table:
    """Who drives each pair, and how that is known."""
    rows = [(mesh.name, mesh.driver, mesh.who.why, ", ".join(states)) for mesh, states in driven_ways(train)]
    used = 4 if train.states else 3
    return Table(("pair", "driver", "how that is known", "states")[:used], [row[:used] for row in rows], wide=True)


def _triangular_tables(meshes: Sequence[TriangularMesh]) -> tuple[Table, Table]:
    places = Table(("pair", "drives", "clearance", "window", "verdict"), [_place_row(mesh) for mesh in meshes])
    header = ("pair", "tau/mean", "error p-p (deg)", "efficiency", "jumps")
    return places, Table(header, [_law_row(mesh) for mesh in meshes])


def _place_row(mesh: TriangularMesh) -> tuple[str, ...]:
    law, window = mesh.law, mesh.window
    where = (
        "-" if window is None else f"{1 + window.jam:.5f} {window.jam_kind} .. {1 + window.run:.5f} {window.run_kind}"
    )
    return (mesh.name, f"{mesh.driver} -> {mesh.driven}", f"{1 + law.sizes.excess:.6g}", where, law.verdict.kind)


def _law_row(mesh: TriangularMesh) -> tuple[str, ...]:
    law = mesh.law
    if not law.intervals:
        return (mesh.name, "-", "-", "-", "-")
    least, most = law.speed_range()
    low, high = law.error_range()
    mean = float(law.ratio)
    efficiency = "-" if mesh.friction is None else f"{law.efficiency_mean():.6f}"
    jumps = ", ".join(f"{jump.value:.4f}" for jump in law.jumps)
    return (mesh.name, f"{least / mean:.5f}..{most / mean:.5f}", f"{degrees(high - low):.6g}", efficiency, jumps)


def _pins(train: GearTrain) -> Section:
    rows = []
    for joint in train.pins:
        law, coupling = joint.law, joint.coupling
        least, most = law.speed_range()
        rows.append(
            (
                coupling.name,
                f"{coupling.pin} -> {coupling.slot}",
                str(coupling.pin_radius),
                str(coupling.offset),
                str(law.ratio),
                f"{degrees(law.amplitude):.5f}",
                f"{least:.6f}..{most:.6f}",
            )
        )
    header = ("coupling", "pin -> slot", "pin radius", "offset", "mean ratio", "amplitude (deg)", "speed ratio")
    text = "Speeds and angles of the slot in the carrier's frame, the pin turning evenly there."
    return Section("Pins", (text,), (Table(header, rows),))


def teeth_data(train: GearTrain) -> dict[str, Any]:
    """Real teeth and pins of a train as plain data; empty lists where none are declared."""
    return {
        "teeth": [
            {"pair": mesh.name, **mesh.who.to_dict(), "states": list(states), "form": mesh.form, **_mesh_data(mesh)}
            for mesh, states in driven_ways(train)
        ],
        "pins": [
            {
                "coupling": joint.coupling.name,
                "ratio": str(joint.law.ratio),
                "amplitude": joint.law.amplitude,
                "speed_ratio": {"min": joint.law.speed_range()[0], "max": joint.law.speed_range()[1]},
            }
            for joint in train.pins
        ],
    }


def _mesh_data(mesh: GearMesh) -> dict[str, Any]:
    if isinstance(mesh, TriangularMesh):
        return mesh_data(mesh.law, mesh.window)
    assert isinstance(mesh, ConjugateMesh)
    return conjugate_data(mesh)


def mesh_data(
    law: TriangularTransmission, window: ClearanceWindow | None, running: Running | None = None
) -> dict[str, Any]:
    """One pair as plain data with stable keys; angles in rad."""
    found, sizes = law.verdict, law.sizes
    why, fix = ("", "") if found else explain_clearance(law, window)
    data: dict[str, Any] = {
        "teeth": [sizes.z1, sizes.z2],
        "verdict": {"kind": found.kind, "text": found.text, "why": why, "fix": fix},
        "clearance": 1 + sizes.excess,
        "window": None if window is None else window_data(window),
        "sizes": {
            "radii": [sizes.R1, sizes.R2],
            "half_angles": [sizes.beta1, sizes.beta2],
            "depths": list(sizes.depths),
            "centre_distance": sizes.D,
            "reach": sizes.reach1,
            "matching": sizes.matching if isfinite(sizes.matching) else None,
        },
    }
    if not law.intervals:
        return data | {
            "play": None,
            "speed_ratio": None,
            "transmission_error": None,
            "efficiency": None,
            "intervals": [],
            "jumps": [],
            "impacts": None,
        }
    return data | _law_data(law) | {"impacts": _impact_data(law, running or Running())}


def window_data(window: ClearanceWindow) -> dict[str, Any]:
    """Clearance factors between which a pair turns."""
    return {
        "jam": 1 + window.jam,
        "jam_kind": window.jam_kind,
        "run": 1 + window.run,
        "run_kind": window.run_kind,
        "reach": 1 + window.reach,
        "works": bool(window),
    }


def _law_data(law: TriangularTransmission) -> dict[str, Any]:
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    return {
        "play": law.verdict.play,
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "transmission_error": {"peak_to_peak": high - low, "rms": rms, "mean": lag},
        "efficiency": efficiency_data(law),
        "intervals": [{"phase": i.phase, "start": i.start, "end": i.end} for i in law.intervals],
        "jumps": [
            {"kind": j.kind, "alpha1": j.alpha1, "before": j.before, "after": j.after, "value": j.value}
            for j in law.jumps
        ],
    }


def _impact_data(law: TriangularTransmission, running: Running) -> dict[str, Any] | None:
    """None where no inertia is given; what takes a rate or a load that is not given is None in it."""
    found = find_impacts(law, running)
    if found is None:
        return None
    handed, dissipated, work = found.energies or (None, None, None)
    return {
        "inertia": found.inertia,
        "rate": running.rate,
        "handed": handed,
        "dissipated": dissipated,
        "work": work,
        "load_to_stay_in_contact": found.least_load,
        "void_above": found.void,
    }
