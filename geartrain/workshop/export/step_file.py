"""Assembly in STEP format: wheels and plates are extruded from their outlines, with exact arcs, names and positions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.errors import MissingExtraError, Problem
from geartrain.numerics.polylines import simplified
from geartrain.scene.parts.turned_parts import profile

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.turned_parts import TurnedPart
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart
    from geartrain.teeth.outlines.contour import Contour

FINE = 0.005  # mm: maximum deviation of chords or curves from a flank
_CORNER = 0.35  # rad: a larger change of direction is a corner
_CURVED = 4  # minimum number of points of a run that becomes one curve
_STRAIGHT = 1e-9  # bulge below which an edge is straight
_POINT = 1e-5  # mm: shorter edges are dropped, because OCP rejects degenerate edges
_DATE = re.compile(rb"'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d'")  # replaced, so that the same train gives the same file


def to_step(work: SolidModel) -> bytes:
    """Return the assembly at the start of its motion as a STEP file in mm, without the parts listed by `omitted`.

    Raises `MissingExtraError` if the library that writes STEP is not installed.
    """
    try:
        import OCP.STEPCAFControl  # noqa: F401
    except ImportError:
        raise MissingExtraError("OCP (cadquery-ocp-novtk)", "step", "a model as STEP") from None
    return _write(work.train.name, [part for part in work.parts if _is_exact(part)])


def omitted(work: SolidModel) -> tuple[Problem, ...]:
    """Return a problem for each part that has no exact shape and is therefore omitted from the STEP file."""
    why = "its shape is approximated by triangles, and STEP needs an exact shape"
    return tuple(
        Problem(f"'{part.name}' is not included in the STEP file", why, "use the GLB or STL file")
        for part in work.parts
        if not _is_exact(part)
    )


def _is_exact(part: SolidPart) -> bool:
    return bool(part.contours) or part.turned is not None


def _write(name: str, parts: Sequence[SolidPart]) -> bytes:
    from OCP.Interface import Interface_Static
    from OCP.Message import Message, Message_PrinterOStream
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document

    Message.DefaultMessenger_s().RemovePrinters(Message_PrinterOStream.get_type_descriptor_s())  # it prints to stdout
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    _assemble(document, name, parts)
    writer = STEPCAFControl_Writer()
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetIVal_s("write.step.assembly", 1)
    Interface_Static.SetIVal_s("write.surfacecurve.mode", 0)  # 3D curves suffice, and halve the file
    writer.SetNameMode(True)
    writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs)
    with TemporaryDirectory() as folder:  # the library writes only to files
        path = Path(folder) / "assembly.step"
        writer.Write(str(path))
        return _DATE.sub(b"'2000-01-01T00:00:00'", path.read_bytes(), count=1)


def _assemble(document: Any, name: str, parts: Sequence[SolidPart]) -> None:
    """Add one shape to the document for each group of equal parts, and one component for each part."""
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    whole = tool.NewShape()
    _set_name(whole, name)
    shapes: dict[object, Any] = {}
    for part in parts:
        outline = *(contour.points.round(6).tobytes() for contour in part.contours), part.height
        key = outline if part.turned is None else (part.kind, part.turned.bands)
        if key not in shapes:
            shapes[key] = tool.AddShape(_shape(part), False)
            _set_name(shapes[key], part.name)
        _set_name(tool.AddComponent(whole, shapes[key], _location(part)), part.name)
    tool.UpdateAssemblies()


def _set_name(label: Any, name: str) -> None:
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name

    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name, True))


def _location(part: SolidPart) -> Any:
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    rows = np.column_stack([part.turn, part.place]).tolist()
    move = gp_Trsf()
    move.SetValues(*(each for row in rows for each in row))
    return TopLoc_Location(move)


def _shape(part: SolidPart) -> Any:
    if part.turned is not None:
        return _revolved(part.turned)
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt, gp_Vec

    low = -part.height / 2
    plane = gp_Pln(gp_Pnt(0, 0, low), gp_Dir(0, 0, 1))
    outer, *holes = (_wire(contour, low) for contour in part.contours)
    face = BRepBuilderAPI_MakeFace(plane, outer, True)
    for hole in holes:
        hole.Reverse()  # a hole is oriented against the outer wire
        face.Add(hole)
    return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, part.height)).Shape()


def _revolved(part: TurnedPart) -> Any:
    """Return a part as a solid of revolution about the z axis, or a compound if it consists of several pieces."""
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt
    from OCP.TopoDS import TopoDS_Compound

    shapes = []
    for section in part.sections():
        outline = BRepBuilderAPI_MakePolygon()
        for radius, height in profile(section):
            outline.Add(gp_Pnt(radius, 0.0, height))
        outline.Close()
        face = BRepBuilderAPI_MakeFace(outline.Wire()).Face()
        shapes.append(BRepPrimAPI_MakeRevol(face, gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))).Shape())
    if len(shapes) == 1:
        return shapes[0]
    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    for shape in shapes:
        builder.Add(whole, shape)
    return whole


def _wire(contour: Contour, height: float) -> Any:
    """Return a contour at the height z = `height` as a counter-clockwise wire whose edges share their vertices."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex, BRepBuilderAPI_MakeWire
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.gp import gp_Pnt

    edges = list(_edges(contour))
    # adjacent edges share their vertices, otherwise the wire is not closed
    corners = [BRepBuilderAPI_MakeVertex(gp_Pnt(*edge[0].tolist(), height)).Vertex() for edge in edges]
    wire = BRepBuilderAPI_MakeWire()
    for at, line in enumerate(edges):
        ends = corners[at], corners[(at + 1) % len(corners)]
        if isinstance(line, _Arc):
            arc = GC_MakeArcOfCircle(*(gp_Pnt(*point.tolist(), height) for point in line)).Value()
            edge = BRepBuilderAPI_MakeEdge(arc, *ends)
        elif len(line) > 2:
            edge = BRepBuilderAPI_MakeEdge(_curve(line, height), *ends)
        else:
            edge = BRepBuilderAPI_MakeEdge(*ends)
        wire.Add(edge.Edge())
    return wire.Wire()


def _curve(line: Floats, height: float) -> Any:
    """Return a B-spline curve with few poles that passes through the points of a flank at the height z = `height`."""
    from OCP.GeomAbs import GeomAbs_C1
    from OCP.GeomAPI import GeomAPI_PointsToBSpline
    from OCP.gp import gp_Pnt

    try:
        from OCP.collections import Array1_gp_Pnt as Points
    except ImportError:  # module name before release 8
        from OCP.TColgp import TColgp_Array1OfPnt as Points
    points = Points(1, len(line))
    for at, (x, y) in enumerate(line.tolist(), 1):
        points.SetValue(at, gp_Pnt(x, y, height))
    # half of the tolerance, because the points deviate by up to a quarter of it
    return GeomAPI_PointsToBSpline(points, 3, 5, GeomAbs_C1, FINE / 2).Curve()


class _Arc(NamedTuple):
    """Circular arc, defined by its start, middle and end points."""

    start: Floats
    middle: Floats
    end: Floats


def _edges(contour: Contour) -> Iterator[Floats | _Arc]:
    """Yield the edges of a contour in order: arcs, chords (two points), and smooth curves (more than two points)."""
    apart = np.linalg.norm(np.roll(contour.points, -1, axis=0) - contour.points, axis=1) > _POINT
    points, bulges = contour.points[apart], contour.bulges[apart]
    count = len(points)
    straight = abs(bulges) < _STRAIGHT
    # begin after an arc, so that a run of chords is not split
    first = 0 if straight.all() or not straight.any() else int(np.flatnonzero(~straight)[0]) + 1
    order = [(first + k) % count for k in range(count)]
    run: list[int] = []
    for at in [*order, -1]:
        if at >= 0 and straight[at]:
            run.append(at)
            continue
        if run:
            yield from _smooth(points[[*run, (run[-1] + 1) % count]])
            run = []
        if at >= 0:
            start, end, bulge = points[at], points[(at + 1) % count], bulges[at]
            chord = end - start
            # the middle of an arc is to the right of the middle of its chord by half the bulge times the chord
            yield _Arc(start, (start + end) / 2 + np.array([chord[1], -chord[0]]) * bulge / 2, end)


def _smooth(line: Floats) -> Iterator[Floats]:
    """Yield the parts of a line between its corners. A part that would need many chords is a single smooth curve."""
    steps = np.diff(line, axis=0)
    turn = np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))
    ends = [0, *(np.flatnonzero(abs(turn) > _CORNER) + 1).tolist(), len(line) - 1]
    if len(ends) == 2 and np.allclose(line[0], line[-1]):
        ends.insert(1, len(line) // 2)  # a closed line is split, because an edge needs two different ends
    for low, high in pairwise(ends):
        whole = line[low : high + 1]
        part = whole[simplified(whole, FINE)]
        if len(part) < _CURVED:
            yield from (part[at : at + 2] for at in range(len(part) - 1))
        else:
            yield whole[simplified(whole, FINE / 4)]  # finer than FINE, because the curve may deviate by FINE / 2 more
