"""A set of gears on a sphere, a survey of solids, and tooth numbers to choose from: as pages and as plain data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, pi, sin
from typing import TYPE_CHECKING, Any

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem, QuestionError
from geartrain.report.document import Document, Section, Table, cut, figure

if TYPE_CHECKING:
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.numerics.arrays import Floats
    from geartrain.spherical import Configuration, GraphSet
    from geartrain.spherical.gear_sizes import SphereSizing
    from geartrain.spherical.polyhedron_survey import SurveyRow
    from geartrain.spherical.tooth_count_search import ToothCountSuggestions


@dataclass(frozen=True)
class SphereAnswers:
    """What is asked of one set; each part is made when it is first needed.

    radius   of the sphere, in the unit of the reader; wheels are sized by it
    graph    how the set was fitted to a graph, where it was
    """

    configuration: Configuration
    radius: float = 1.0
    graph: GraphSet | None = None

    @cached_property
    def chosen(self) -> bool:
        """True if every kind has its tooth number."""
        return all(kind in self.configuration.teeth for kind in self.configuration.kinds)

    @cached_property
    def train(self) -> GearTrain:
        """The set as a train; where teeth are not chosen, with ten on every gear: signs do not hang on them."""
        from geartrain.spherical import to_train

        whole = {kind: self.configuration.teeth.get(kind, 10) for kind in self.configuration.kinds}
        return GearTrain.declare(to_train(replace(self.configuration, teeth=whole)))

    @cached_property
    def moves(self) -> bool:
        """True if the set can turn."""
        return self.train.mobility.by_rank > 0 and not self.train.mobility.locked

    @cached_property
    def sizing(self) -> SphereSizing | None:
        """Cones, pitches and pressure angles; None while teeth are not chosen."""
        from geartrain.spherical.gear_sizes import size_gears

        return size_gears(self.configuration) if self.chosen else None

    @cached_property
    def closure(self) -> MeshPhasing | None:
        """Whether the teeth of every loop meet; None while teeth are not chosen, and for a set that cannot turn."""
        from geartrain.kinematics.phasing import spherical_phasing

        return spherical_phasing(self.configuration) if self.chosen and self.moves else None

    def pose(self) -> tuple[Configuration, Floats, list[float]]:
        """What a picture needs: the set, its pitch cones (rad), and how far its teeth are turned (pitches)."""
        sizing = self.sizing
        if sizing is None:
            raise QuestionError(Problem("the sphere cannot be drawn", "its gears have no teeth", "give --teeth"))
        angles = {} if self.closure is None else self.closure.angles
        counts = zip(self.configuration.names, sizing.teeth.tolist(), strict=True)
        phases = [angles.get(name, 0.0) * z / (2 * pi) for name, z in counts]
        return self.configuration, sizing.outer, phases

    @cached_property
    def rule(self) -> str | None:
        """The condition on tooth numbers, where contacts stand at known parts of a turn."""
        from geartrain.kinematics.phasing import spherical_divisibility_rule

        rule = spherical_divisibility_rule(self.configuration) if self.moves else None
        return None if rule is None else rule.text


def sphere_document(found: SphereAnswers) -> Document:
    """Whether a set turns, closes and fits, and its sizes."""
    configuration = found.configuration
    lead = [
        f"{len(configuration.names)} gears, {len(configuration.meshes)} meshes, on a sphere of radius "
        f"{found.radius:.15g}."
    ]
    return Document(configuration.title or "Gears on a sphere", lead, list(_sections(found)))


def _sections(found: SphereAnswers) -> Iterator[Section]:
    mobility = found.train.mobility
    lines = [f"Degrees of freedom by count {mobility.by_count}, by rank {mobility.by_rank}."]
    if found.moves:
        lines.append(f"It turns; {mobility.redundant} of its meshes repeat what the others say.")
    else:
        lines += [f"{line[0].upper()}{line[1:]}." for line in found.train.gridlock.lines()]
    yield Section("Whether it turns", lines)
    if found.graph is not None:
        yield Section("How it was fitted to its graph", [line.strip() for line in str(found.graph).splitlines()])
    yield _phases(found)
    yield Section("Kinds of gear", (), (_kinds(found),))
    yield Section("Kinds of mesh", tuple(_pitch(found)), (_meshes(found),))


def _phases(found: SphereAnswers) -> Section:
    lines = []
    if found.rule is not None:
        lines.append(f"It closes if {found.rule}." if found.rule != "always" else "It closes with any tooth numbers.")
    if found.closure is not None:
        lines += [line.strip() for line in found.closure.text.splitlines()]
    elif not found.moves:
        lines.append("A set that cannot turn is not asked for phases.")
    elif not found.chosen:
        lines.append("Give `--teeth` for every kind, or ask for tooth numbers with `--suggest`.")
    return Section("Whether its teeth meet", lines)


def _kinds(found: SphereAnswers) -> Table:
    rows = []
    for kind, cone in _cones(found).items():
        count = found.configuration.teeth.get(kind)
        sizes = ("-", "-") if cone is None else (f"{degrees(cone):.9f}", figure(found.radius * sin(cone), 12))
        rows.append((kind, str(found.configuration.kinds.count(kind)), "-" if count is None else str(count), *sizes))
    return Table(("kind", "gears", "teeth", "pitch cone (deg)", "wheel radius"), rows)


def _cones(found: SphereAnswers) -> dict[str, float | None]:
    """Pitch cone of each kind (rad): the largest in operation."""
    kinds = dict.fromkeys(found.configuration.kinds)
    if found.sizing is None:
        return dict.fromkeys(kinds)
    cones = dict(zip(found.configuration.kinds, found.sizing.outer.tolist(), strict=True))
    return {kind: cones[kind] for kind in kinds}


def _meshes(found: SphereAnswers) -> Table:
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


def _pitch(found: SphereAnswers) -> Iterator[str]:
    from geartrain.spherical.gear_sizes import impossibility_theorem, ratio_windows

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
        for collision in sizing.collisions[:6]:
            yield f"Too close: {collision}."
        for kind, count in sizing.undercut.items():
            yield f"Kind {kind} is undercut: {count:.1f} virtual teeth."
    for window in ratio_windows(found.configuration) if found.moves else ():
        yield f"Neighbours do not overlap while {window}."


def sphere_data(found: SphereAnswers) -> dict[str, Any]:
    """A set as plain data with stable keys; angles in degrees, residues in pitches."""
    from geartrain.spherical.configuration import mesh_kinds

    configuration, mobility, closure = found.configuration, found.train.mobility, found.closure
    cones = _cones(found)
    return {
        "title": configuration.title,
        "gears": len(configuration.names),
        "meshes": len(configuration.meshes),
        "kinds": {kind: configuration.kinds.count(kind) for kind in cones},
        "teeth": dict(configuration.teeth),
        "mobility": mobility.by_rank,
        "gridlock": None if found.moves else found.train.gridlock.to_dict(),
        "rule": found.rule,
        "closes": None if closure is None else bool(closure),
        "residue": None if closure is None else closure.last,
        "loop_residue": None if closure is None else float(closure.worst),
        "closure": None if closure is None else closure.to_dict(),
        "sphere_radius": found.radius,
        "radii": {kind: None if cone is None else found.radius * sin(cone) for kind, cone in cones.items()},
        "cones": {kind: None if cone is None else degrees(cone) for kind, cone in cones.items()},
        "angles": {f"{each.a}-{each.b}": degrees(each.angle) for each in mesh_kinds(configuration)},
        "graph": None if found.graph is None else _graph_data(found.graph),
        "sizing": None if found.sizing is None else found.sizing.to_dict(),
    }


def _graph_data(found: GraphSet) -> dict[str, Any]:
    return {
        "aim": found.aim,
        "exact": list(found.exact),
        "axes_moved": degrees(float(found.moved.max())),
        "pitch_spread": found.spread,
        "residue": found.residue,
    }


def survey_document(rows: Iterable[SurveyRow]) -> Document:
    """The table of solids: which turn, what frees them, which can have one pitch."""
    header = ("faces of", "gears", "meshes", "turns", "count", "to take out", "types", "mesh kinds", "free", "angles")
    table = Table(
        header,
        [
            (
                row.solid,
                str(row.gears),
                str(row.meshes),
                "yes" if row.bipartite else "no",
                str(row.gruebler),
                str(row.drop),
                str(row.types),
                str(row.mesh_kinds),
                str(row.positions),
                " ".join(f"{angle:.9f}" for angle in row.angles),
            )
            for row in rows
        ],
        wide=True,
    )
    text = (
        "Gears on all faces. A set turns if neighbours can turn against each other everywhere; `to take out` is the "
        "least number of meshes that frees it. `count` is gears less meshes; types of gear and kinds of mesh are those "
        "that no symmetry joins, and `free` the parameters by which axes can move while all symmetries stay."
    )
    return Document("Gears on the faces of solids", (text,), (Section("Solids", (), (table,)),))


def suggestions_document(found: ToothCountSuggestions) -> Document:
    """Tooth numbers whose loops close and whose tips clear, best first, and what removed the rest."""
    kinds = list(dict.fromkeys(found.configuration.kinds))
    rows = [
        (
            *(str(each.teeth[kind]) for kind in kinds),
            f"{each.mismatch:+.9e}",
            ", ".join(f"{degrees(a):.6f} {degrees(b):.6f}" for a, b in each.cones),
            " ".join(f"{degrees(angle):.4f}" for angle in each.pressure),
            f"{each.room:.2f}",
            f"{each.residue:.3g}",
        )
        for each in found
    ]
    gone = ", ".join(f"{count} by {reason}" for reason, count in found.removed.items())
    lines = [f"Of {found.considered} sets of tooth numbers, removed: {gone}."]
    if not rows:
        lines.append("No tooth numbers meet every condition: raise the bound, or allow a greater mismatch.")
    meshes = ", ".join(str(mesh) for mesh in found.meshes)
    lines.append(f"Meshes: {meshes}. The mismatch is ln of the ratio of their pitches.")
    header = (*kinds, "mismatch", "cones (deg)", "pressure angles (deg)", "room (modules)", "residue")
    title = f"Tooth numbers for {found.configuration.title or 'a set'}"
    return Document(title, lines, (Section("Best sets", (), (Table(header, cut(rows)),)),))


def suggestions_data(found: ToothCountSuggestions) -> dict[str, Any]:
    """Suggestions as plain data; angles in degrees."""
    return {
        "considered": found.considered,
        "removed": dict(found.removed),
        "meshes": [{"kinds": [mesh.a, mesh.b], "angle": degrees(mesh.angle)} for mesh in found.meshes],
        "solutions": [
            {
                "teeth": dict(each.teeth),
                "mismatch": each.mismatch,
                "cones": [[degrees(a), degrees(b)] for a, b in each.cones],
                "pressure_angles": [degrees(angle) for angle in each.pressure],
                "room": each.room,
                "residue": each.residue,
            }
            for each in found
        ],
    }
