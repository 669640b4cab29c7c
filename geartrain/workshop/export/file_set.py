"""Files of an export: a single file whose format follows from its suffix, or a whole folder with tables as CSV."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from geartrain.drawing.flat_files import to_dxf, to_svg
from geartrain.errors import GearTrainError, Problem, QuestionError, install_command, suggest
from geartrain.kinematics import graph
from geartrain.numerics.exact import decimal, fraction_text
from geartrain.numerics.files import csv_text
from geartrain.numerics.results import Shown
from geartrain.scene.solids.bearing_plates import FlatDrawing
from geartrain.workshop.export.assembly_guide import readme, step_pictures
from geartrain.workshop.export.cut_sheets import cut_sheets, wheel_drawing, wheel_sheets
from geartrain.workshop.export.maker_sheet import maker_sheets
from geartrain.workshop.export.parts_list import parts_list, to_csv
from geartrain.workshop.export.proof import TrainProof, proof_is_installed, prove_train
from geartrain.workshop.export.proof.train_proof import are_installed
from geartrain.workshop.rexs.unit_export import omitted_parts, to_rexs

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Answer
    from geartrain.scene.solids.solid_assembly import SolidModel


KINDS = ("svg", "dxf", "stl", "glb", "step", "graphml", "dot", "rexs", "csv")
"""Formats of files that `export_files` writes."""

SUFFIXES = {
    **{".glb": "glb", ".stl": "stl", ".step": "step", ".stp": "step"},
    **{".graphml": "graphml", ".dot": "dot", ".gv": "dot", ".rexsj": "rexs", ".json": "rexs"},
    **{".rexs": "rexs-xml", ".urdf": "urdf", ".xml": "mjcf"},
}
"""Mapping from file suffix to the format of an export file of a whole train."""

WHEEL_SUFFIXES = (".svg", ".dxf", ".stl")
"""Suffixes of export files that contain a single wheel."""

_NEEDED = {"dxf": ("ezdxf", "dxf"), "step": ("OCP", "step")}  # kind -> (library, extra that installs it)
_TITLES = {
    "graphml": "graph of links and pairs",
    "dot": "graph of links and pairs for Graphviz",
    "rexs": "gear unit as REXS 1.4",
    "stl": "all parts as closed surfaces, in mm",
    "glb": "all parts in motion, in m",
    "step": "all parts with exact arcs, in mm",
}

_DIGITS = 15  # significant digits that a double always keeps
Rows = Sequence[Sequence[object]]


@dataclass(frozen=True, slots=True)
class ExportFile(Shown):
    """One file of an export. Its content is computed on request."""

    path: str
    """Path of the file relative to the export folder, with `/` as separator."""
    title: str
    """Description of the content of the file."""
    make: Callable[[], bytes]
    """Function that returns the content of the file, or raises `GearTrainError` if it cannot be computed."""


def installed(kinds: Sequence[str]) -> tuple[list[str], list[Problem]]:
    """Return the formats whose libraries are installed, and a problem for each of the other formats."""
    found, missing = [], []
    for kind in kinds:
        library, extra = _NEEDED.get(kind, ("", ""))
        if library and not are_installed(library):
            what = f"{kind.upper()} files are not written"
            missing.append(Problem(what, f"{library} is not installed", install_command(extra)))
        else:
            found.append(kind)
    return found, missing


def train_file(work: SolidModel, kind: str, turns: Fraction | None = None) -> bytes:
    """Return the content of an export file of the whole train in the format `kind`.

    Parameters
    ----------
    work : SolidModel
        Solid model of the train.
    kind : {"stl", "glb", "step", "graphml", "dot", "rexs", "rexs-xml", "urdf", "mjcf"}
        Kind of file.
    turns : Fraction, optional
        Revolutions of the driving link in the animation of a GLB; by default one period, or ten if the period is long.

    Returns
    -------
    bytes
        Content of the file.

    Raises
    ------
    MissingExtraError
        If the library that writes STEP is not installed.
    GearTrainError
        If the train cannot be represented in this format; the message gives the reason.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes, SolidModel
    >>> work = SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes())
    >>> train_file(work, "dot").decode().splitlines()[0]
    'graph "planetary-24-18-60" {'
    """
    if kind in ("stl", "step") and not work.parts:
        why = "only wheels, pins and plates have solids, and this train declares none"
        fix = "declare the wheels of its links, or choose another format, such as .graphml"
        raise GearTrainError(Problem(f"'{work.train.name}' has no parts to make", why, fix))
    if kind == "glb":
        from geartrain.workshop.export.triangle_files import to_glb

        return to_glb(work, turns)
    if kind == "stl":
        from geartrain.scene.solids.triangle_solids import joined
        from geartrain.workshop.export.triangle_files import to_stl

        return to_stl(joined(part.placed for part in work.parts), work.train.name)
    if kind == "step":
        from geartrain.workshop.export.step_file import to_step

        return to_step(work)
    if kind in ("urdf", "mjcf"):
        from geartrain.workshop.export.joint_tree import to_mjcf, to_urdf

        return (to_urdf if kind == "urdf" else to_mjcf)(work).encode("utf-8")
    text = {"graphml": graph.to_graphml, "dot": graph.to_dot}.get(kind)
    found = to_rexs(work, xml=kind == "rexs-xml") if text is None else text(work.train.graph) + "\n"
    return found.encode("utf-8")


def wheel_file(work: SolidModel, wheel: str, suffix: str) -> bytes:
    """Return the content of an export file of one wheel, for cutting or printing, in the format of the suffix.

    Parameters
    ----------
    work : SolidModel
        Solid model of the train.
    wheel : str
        Name of the wheel.
    suffix : {".svg", ".dxf", ".stl"}
        Suffix that selects the format.

    Returns
    -------
    bytes
        Content of the file; drawings are 1:1 in mm.

    Raises
    ------
    QuestionError
        If the wheel does not exist, or has no flat shape.
    MissingExtraError
        If the library that writes DXF is not installed.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes, SolidModel
    >>> work = SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes(module=2.0))
    >>> wheel_file(work, "s", ".svg")[:4]
    b'<svg'
    """
    known = work.train.declaration.wheels
    if wheel not in known:
        what = f"the train has no wheel '{wheel}'"
        raise QuestionError(Problem(what, "only declared wheels can be exported", suggest(wheel, known)))
    blank = work.blanks.wheels.get(wheel)
    if blank is None:
        raise QuestionError(notice for notice in work.blanks.notices if f"'{wheel}'" in notice.what)
    if suffix == ".stl":
        from geartrain.scene.solids.triangle_solids import wheel_solid
        from geartrain.workshop.export.triangle_files import to_stl

        return to_stl(wheel_solid(blank), wheel)
    return _drawn(wheel_drawing(work, blank), suffix[1:])


def export_files(
    work: SolidModel, kinds: Sequence[str], turns: Fraction | None = None, proof: TrainProof | None = None
) -> list[ExportFile]:
    """Return all files of the requested kinds, followed by a README that lists them.

    Parameters
    ----------
    work : SolidModel
        Solid model of the train.
    kinds : sequence of str
        Formats of the files: svg, dxf, stl, glb, step, graphml, dot, rexs, csv.
    turns : Fraction, optional
        Revolutions of the driving link in the animation of a GLB; by default one period, or ten if the period is long.
    proof : TrainProof, optional
        Proof of the train for the README. By default it is computed when the README is made, if the extra `proof` is
        installed.

    Returns
    -------
    list of ExportFile
        Files whose content is computed when `make` is called.

    Raises
    ------
    QuestionError
        If a kind does not exist, or the requested sizes contradict the declaration.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes, SolidModel
    >>> work = SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes())
    >>> [file.path for file in export_files(work, ["graphml", "rexs"])]
    ['graph.graphml', 'gear-unit.rexsj', 'README.md']
    """
    unknown = [kind for kind in kinds if kind not in KINDS]
    if unknown:
        what = f"'{unknown[0]}' is not an export format"
        why = "only these kinds of files can be written"
        raise QuestionError(Problem(what, why, f"use one or more of {', '.join(KINDS)}", "--as"))
    files = [*_sheets(work, kinds)]
    files += [ExportFile(*each) for each in (*maker_sheets(work), *step_pictures(work))] if "svg" in kinds else []
    if "csv" in kinds:
        for make in (_wheels, _links, _pairs, _circuits, _couplings, _axes, _outputs):
            name, (head, rows) = make.__name__[1:], make(work)
            files.append(ExportFile(f"tables/{name}.csv", f"table of {name}", csv_text(head.split(), rows).encode))
    named = {"graphml": "graph.graphml", "dot": "graph.dot", "rexs": "gear-unit.rexsj"}
    named |= {kind: f"assembly.{kind}" for kind in ("stl", "glb", "step")}
    for kind, name in named.items():
        if kind in kinds:
            files.append(ExportFile(name, _TITLES[kind], partial(train_file, work, kind, turns)))
    if parts_requested(kinds):
        title = "list of parts: count, material, sizes, mass, fits"
        files.append(ExportFile("parts.csv", title, lambda: to_csv(parts_list(work)).encode("utf-8")))
    return [*files, ExportFile("README.md", "description of the files", lambda: _readme(work, files, kinds, proof))]


def _readme(work: SolidModel, files: Sequence[ExportFile], kinds: Sequence[str], proof: TrainProof | None) -> bytes:
    named, parts = [(each.path, each.title) for each in files], parts_requested(kinds)
    if proof is None and parts and proof_is_installed():
        proof = prove_train(work)
    return readme(work, named, notices(work, kinds), parts, proof).encode("utf-8")


def parts_requested(kinds: Sequence[str]) -> bool:
    """Return True if any of the given formats shows parts to be made, False otherwise."""
    return bool({"svg", "dxf", "stl", "glb", "step"} & set(kinds))


def _sheets(work: SolidModel, kinds: Sequence[str]) -> Iterator[ExportFile]:
    flat = [kind for kind in kinds if kind in ("svg", "dxf")]
    for path, drawing in cut_sheets(work) if flat else ():
        for kind in flat:
            yield ExportFile(f"{path}.{kind}", drawing.title, partial(_drawn, drawing, kind))
    for sheet in wheel_sheets(work.blanks.wheels) if "stl" in kinds else ():
        yield ExportFile(
            f"wheels/{sheet.file}.stl", sheet.drawing.title, partial(wheel_file, work, sheet.parts[0], ".stl")
        )


def _drawn(drawing: FlatDrawing, kind: str) -> bytes:
    return (to_svg(drawing) if kind == "svg" else to_dxf(drawing)).encode("utf-8")


def notices(work: SolidModel, kinds: Sequence[str]) -> list[Problem]:
    """Return the distinct problems that affect an export of given kinds, such as parts that cannot be made.

    Parameters
    ----------
    work : SolidModel
        Solid model of the train.
    kinds : sequence of str
        Kinds of files: svg, dxf, stl, glb, step, graphml, dot, rexs, csv.

    Returns
    -------
    list of Problem
        Problems with their causes and remedies.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes, SolidModel
    >>> notices(SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes()), ["graphml"])
    []
    """
    found: list[Problem] = list(work.layout.notices)
    if work.frame is not None and parts_requested(kinds):
        found += [*work.frame.plan.notices, *work.frame.problems()]
        found += (problem for cup in work.frame.plan.stack.cups for problem in cup.notices())
    if {"svg", "dxf", "stl"} & set(kinds):
        found += work.blanks.notices
        declared = work.train.declaration
        forms = {gear.name: declared.form_of(gear) for gear in declared.gears}
        plain = [name for name, form in forms.items() if form and not form.has_shape and form.form != "ideal"]
        if plain:
            why = "their form gives the transmission error, not the shape of the teeth"
            fix = "declare a form with shapes, such as `tooth_form: involute`, for parts of that form"
            found.append(Problem(f"standard teeth are cut for {', '.join(plain)}", why, fix))
    if {"svg", "dxf"} & set(kinds):
        found += work.couplings.notices
    found += [problem for kind in kinds for problem in simplifications(work, kind)]
    if "step" in kinds:
        from geartrain.workshop.export.step_file import omitted

        found += omitted(work)
    # the same problem can come from several sources
    once: dict[str, Problem] = {}
    for problem in found:
        once.setdefault(problem.text, problem)
    return [*once.values()]


def simplifications(work: SolidModel, kind: str) -> list[Problem]:
    """Return a message on each part of the train that a file of the given format omits or simplifies."""
    if kind in ("rexs", "rexs-xml"):
        return [*omitted_parts(work)]
    if kind in ("urdf", "mjcf"):
        from geartrain.workshop.export.joint_tree import mean_ratios

        return [*mean_ratios(work)]
    return []


def kind_of(name: str) -> str:
    """Return the format of an export file of a whole train. Raises `GearTrainError` for an unknown file suffix."""
    suffix = f".{name.rpartition('.')[2].lower()}" if "." in name else ""
    if suffix in SUFFIXES:
        return SUFFIXES[suffix]
    fix = f"use {', '.join(SUFFIXES)} or .fmu; for wheels, plates and tables, give --to FOLDER"
    what = f"a train cannot be written as '{suffix or name}'"
    raise GearTrainError(Problem(what, "the format follows from the suffix of the file", fix, "-o"))


# --------------------------------------------------------------------------------------------------------------- tables


def _both(value: Fraction | None) -> tuple[str, str]:
    """Return a number as two texts, a fraction and a decimal number, which are empty for None."""
    return ("", "") if value is None else (fraction_text(value), decimal(value, _DIGITS))


def _answers(work: SolidModel) -> Iterator[Answer]:
    """Yield the exact speeds of the train in the selected state, or in each of its states if no state is selected."""
    states = work.train.states if work.state is None else (work.state,)
    return (work.train.solve(state, method="exact") for state in states or (None,))


def _wheels(work: SolidModel) -> tuple[str, Rows]:
    rows = []
    for name, (link, wheel) in work.train.declaration.wheels.items():
        place = work.layout.wheels[name]
        uncertainty = wheel.uncertainty
        rows.append(
            (
                *(name, link, wheel.count, " ".join(map(str, uncertainty.allowed)) if uncertainty else "", wheel.kind),
                # the normal module, by which gear cutters are named
                *("yes" if wheel.internal else "", place.axis, place.layer, f"{place.module / wheel.slant:.9g}"),
                *(f"{place.radius:.9g}", *(f"{each:.9g}" for each in place.centre), wheel.status, wheel.source),
            )
        )
    return "wheel link teeth allowed kind internal axis layer module_mm radius_mm x_mm y_mm z_mm status source", rows


def _links(work: SolidModel) -> tuple[str, Rows]:
    train, rows = work.train, []
    for answer in _answers(work):
        for link in train.declaration.links:
            found = answer.speeds.get(link)
            joint = train.kinematics.tree.parent.get(link)
            parent, axis = joint if joint else ("", "")
            speed = _both(None if found is None else Fraction(found))
            wheels = " ".join(train.declaration.links[link].wheels)
            rows.append((answer.state, link, parent, axis, *speed, answer.unit, wheels))
    return "state link joined_to axis speed speed_decimal unit wheels", rows


def _pairs(work: SolidModel) -> tuple[str, Rows]:
    declared = work.train.declaration
    carriers = {circuit.id: circuit.carrier for circuit in work.train.circuits}
    rows = []
    for gear in declared.gears:
        first, second = gear.pair
        form = declared.form_of(gear)
        counts = [declared.wheels[wheel][1].count for wheel in gear.pair]
        distance = work.layout.axis_distance(first, second)
        shown = "" if distance is None else f"{distance:.9g}"
        rows.append((gear.name, first, second, *counts, carriers[gear.name], form.form if form else "", shown))
    return "pair first second first_teeth second_teeth carrier form distance_mm", rows


def _circuits(work: SolidModel) -> tuple[str, Rows]:
    rows = [
        (each.id, each.kind, each.i, each.j, each.carrier, each.a, each.b, *_both(each.ratio), each.note)
        for each in work.train.circuits
    ]
    return "circuit kind i j carrier a b ratio ratio_decimal note", rows


def _couplings(work: SolidModel) -> tuple[str, Rows]:
    rows = []
    for each in work.train.declaration.pin_couplings:
        sizes = (None if size is None else f"{size.si * 1000:.12g}" for size in (each.pin_radius, each.offset))
        rows.append((each.name, each.kind, each.pin, each.slot, *sizes, each.status))
    return "coupling kind pin slot pin_radius_mm offset_mm status", rows


def _axes(work: SolidModel) -> tuple[str, Rows]:
    rows = [
        (axis.label, axis.carrier, axis.how, *(f"{each:.9g}" for each in (*axis.point, *axis.direction)))
        for axis in work.layout.axes.values()
    ]
    return "axis carrier how x_mm y_mm z_mm dx dy dz", rows


def _outputs(work: SolidModel) -> tuple[str, Rows]:
    rows = []
    for answer in _answers(work):
        for name, result in answer.outputs.items():
            speed = _both(None if result.speed is None else Fraction(result.speed))
            holds = "yes" if result.holds else "no"
            rows.append((answer.state, name, result.of, result.relative_to, *speed, answer.unit, holds))
    return "state output of relative_to speed speed_decimal unit holds", rows
