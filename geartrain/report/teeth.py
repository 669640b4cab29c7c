"""Real teeth and pins as sections of a train's report, and as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any

from geartrain.analysis import GearTrain
from geartrain.meshes import ConjugateMesh, Mesh, TriangularMesh, explain
from geartrain.report.conjugate import WORDS, conjugate_data, conjugate_table, efficiency_data
from geartrain.report.document import Section, Table
from geartrain.report.meshing import Running, find_blows

if TYPE_CHECKING:
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.meshing import Window


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


def driven_ways(train: GearTrain) -> Iterator[tuple[Mesh, tuple[str, ...]]]:
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


def _mesh_data(mesh: Mesh) -> dict[str, Any]:
    if isinstance(mesh, TriangularMesh):
        return mesh_data(mesh.law, mesh.window)
    assert isinstance(mesh, ConjugateMesh)
    return conjugate_data(mesh)


def mesh_data(law: TriangularLaw, window: Window | None, running: Running | None = None) -> dict[str, Any]:
    """One pair as plain data with stable keys; angles in rad."""
    found, sizes = law.verdict, law.sizes
    why, fix = ("", "") if found else explain(law, window)
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


def window_data(window: Window) -> dict[str, Any]:
    """Clearance factors between which a pair turns."""
    return {
        "jam": 1 + window.jam,
        "jam_kind": window.jam_kind,
        "run": 1 + window.run,
        "run_kind": window.run_kind,
        "reach": 1 + window.reach,
        "works": bool(window),
    }


def _law_data(law: TriangularLaw) -> dict[str, Any]:
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


def _impact_data(law: TriangularLaw, running: Running) -> dict[str, Any] | None:
    """None where no inertia is given; what takes a rate or a load that is not given is None in it."""
    found = find_blows(law, running)
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
