"""Documents on gears on a sphere: one configuration, a survey of polyhedra, and suggested tooth counts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import degrees, sin
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table, cut, figure, result_table

if TYPE_CHECKING:
    from geartrain.spherical.gear_sphere import GearSphere
    from geartrain.spherical.polyhedron_gears import SurveyRow
    from geartrain.spherical.tooth_count_search import ToothCountSuggestions


def describe_sphere(found: GearSphere) -> Document:
    """Return a document on a set of gears on a sphere: mobility, phase closure, kinds of gear and mesh, and sizes."""
    configuration = found.configuration
    counts = f"{len(configuration.names)} gears, {len(configuration.meshes)} meshes"
    summary = [f"{counts}, on a sphere of radius {found.radius:.15g}."]
    return Document(configuration.title or "Gears on a sphere", summary, list(_sections(found)))


def _sections(found: GearSphere) -> Iterator[Section]:
    mobility = found.train.mobility
    lines = [f"Degrees of freedom by count {mobility.by_count}, by rank {mobility.by_rank}."]
    if found.moves:
        lines.append(f"The set turns; {mobility.redundant} of its meshes are redundant.")
    else:
        lines += [f"{line[0].upper()}{line[1:]}." for line in found.train.kinematics.gridlock.lines()]
    yield Section("Mobility", lines)
    if found.graph is not None:
        yield Section("Fit to the graph", [line.strip() for line in str(found.graph).splitlines()])
    yield _phases(found)
    yield Section("Kinds of gear", (), (_kinds(found),))
    yield Section("Kinds of mesh", tuple(_pitch(found)), (_meshes(found),))


def _phases(found: GearSphere) -> Section:
    lines = []
    if found.rule is not None:
        lines.append(f"The loops close {'with any tooth counts' if found.rule == 'always' else f'if {found.rule}'}.")
    if found.closure is not None:
        lines += [line.strip() for line in found.closure.text.splitlines()]
    elif not found.moves:
        lines.append("Phases are not computed for a set that cannot turn.")
    elif not found.chosen:
        lines.append("Give `--teeth` for every kind, or search tooth counts with `--suggest`.")
    return Section("Phase closure", lines)


def _kinds(found: GearSphere) -> Table:
    rows = []
    for kind, cone in found.cones.items():
        count = found.configuration.teeth.get(kind)
        sizes = ("-", "-") if cone is None else (f"{degrees(cone):.9f}", figure(found.radius * sin(cone), 12))
        rows.append((kind, str(found.configuration.kinds.count(kind)), "-" if count is None else str(count), *sizes))
    return Table(("kind", "gears", "teeth", "pitch cone (deg)", "wheel radius"), rows)


def _meshes(found: GearSphere) -> Table:
    from geartrain.spherical.configuration import mesh_kinds

    rows = []
    for kind in mesh_kinds(found.configuration):
        sizing, first = found.sizing, kind.meshes[0]
        row = [f"{kind.a}-{kind.b}", str(len(kind.meshes)), f"{degrees(kind.angle):.9f}"]
        if sizing is not None:
            cones = " and ".join(f"{degrees(cone):.6f}" for cone in sizing.cones[first].tolist())
            row += [cones, f"{sizing.pitches[first]:.9g}", f"{degrees(sizing.pressure[first]):.4f}"]
        rows.append(row)
    header = ("mesh", "number", "axes apart (deg)", "cones (deg)", "pitch", "pressure angle (deg)")
    return Table(header if found.sizing is not None else header[:3], rows)


def _pitch(found: GearSphere) -> Iterator[str]:
    from geartrain.spherical import ratio_windows
    from geartrain.spherical.gear_sizes import impossibility_theorem

    sizing = found.sizing
    if sizing is not None:
        if sizing.exact:
            yield f"One pitch for all meshes; module {found.radius * sizing.module:.9g}."
        else:
            yield (
                f"Pitches differ by {100 * sizing.mismatch:.4g} %: involutes on one base pitch mesh exactly, at the "
                "pressure angles given."
            )
            if text := impossibility_theorem(found.configuration):
                yield f"One pitch is impossible here: {text}."
        # one collision repeats for every symmetric pair of gears
        for collision in sizing.collisions[:6]:
            yield f"Too close: {collision}."
        for kind, count in sizing.undercut.items():
            yield f"Kind {kind} is undercut: {count:.1f} virtual teeth."
    # ratios are only defined for a set that turns
    for window in ratio_windows(found.configuration) if found.moves else ():
        yield f"Neighbours do not overlap while {window}."


def describe_survey(rows: Iterable[SurveyRow]) -> Document:
    """Return a table of polyhedra: whether the gears turn, how many meshes prevent it, and the angles between axes."""
    table = result_table(
        rows,
        *("faces of=solid", "gears", "meshes", ("turns", lambda row: "yes" if row.bipartite else "no")),
        *("count=gruebler", "to remove=drop", "types", "mesh_kinds", "free=positions"),
        ("angles", lambda row: " ".join(f"{angle:.9f}" for angle in row.angles)),
        wide=True,
    )
    text = (
        "Gears on all faces. A set turns if all neighbours can turn in opposite senses; `to remove` is the minimum "
        "number of meshes whose removal frees it. `count` is the number of gears minus that of meshes. `types` of gear "
        "and `mesh kinds` are counted up to symmetry. `free` is the number of parameters by which the axes can move "
        "with all symmetries kept."
    )
    return Document("Gears on the faces of solids", (text,), (Section("Solids", (), (table,)),))


def describe_suggestions(found: ToothCountSuggestions) -> Document:
    """Return a document on suggested tooth counts and their properties, and on the number of rejected sets."""
    kinds = list(dict.fromkeys(found.configuration.kinds))
    rows = []
    for each in found:
        cones = ", ".join(f"{degrees(a):.6f} {degrees(b):.6f}" for a, b in each.cones)
        angles = " ".join(f"{degrees(angle):.4f}" for angle in each.pressure)
        figures = (f"{each.mismatch:+.9e}", cones, angles, f"{each.room:.2f}", f"{each.residue:.3g}")
        rows.append((*(str(each.teeth[kind]) for kind in kinds), *figures))
    gone = ", ".join(f"{count} by {reason}" for reason, count in found.removed.items())
    lines = [f"{found.considered} sets of tooth counts were considered; rejected: {gone}."]
    if not rows:
        lines.append("No tooth counts meet every condition: raise the bound, or allow a larger mismatch.")
    meshes = ", ".join(str(mesh) for mesh in found.meshes)
    lines.append(f"Meshes: {meshes}. The mismatch is the logarithm of the ratio of their pitches.")
    header = (*kinds, "mismatch", "cones (deg)", "pressure angles (deg)", "tip gap (modules)", "residue")
    title = f"Tooth counts for {found.configuration.title or 'a set'}"
    return Document(title, lines, (Section("Best sets", (), (Table(header, cut(rows)),)),))
