"""Triangle meshes: binary STL in mm, and the animated assembly as binary glTF (GLB) in metres.

A GLB file has one node for each body, whose rotation is animated, and child nodes for the parts of the body. Vertices
are quantised (glTF extension KHR_mesh_quantization): positions are 16-bit integers and normals 8-bit. The node of a
part contains the transform from integers to mm, so that parts of equal shape share one mesh.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from fractions import Fraction
from math import ceil, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import read_fraction
from geartrain.scene.solids.solid_assembly import SolidModel
from geartrain.scene.solids.solid_part import SolidPart

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.triangle_solids import Solid

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def to_stl(solid: Solid, name: str) -> bytes:
    """Return a solid as a binary STL file, with the name in its header."""
    corners = solid.vertices[solid.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    rows["normal"] = normals / np.where(length > 0, length, 1)  # the normal of a degenerate triangle remains 0
    rows["corners"] = corners
    # the format has a header of 80 bytes
    header = f"{name}, mm".encode("ascii", "replace")[:79].ljust(80)
    return header + np.uint32(len(rows)).tobytes() + rows.tobytes()


# ----------------------------------------------------------------------------------------------------------------- GLB

_METRE = 0.001  # m in a mm: glTF is in metres
_STEPS = 65534  # along the largest extent of a part: from -32767 to 32767
_UNIT = 127  # largest 8-bit integer: length of a unit normal
_COLOURS: dict[str, tuple[float, float, float]] = {
    "surviving": (0.72, 0.53, 0.2),
    "reconstructed": (0.45, 0.56, 0.68),
    "hypothetical": (0.72, 0.46, 0.55),
    "": (0.75, 0.63, 0.36),
    "arbor": (0.55, 0.55, 0.58),
    "plate": (0.62, 0.6, 0.52),
}


_LOOK = {"metallicFactor": 0.4, "roughnessFactor": 0.5}
_VERTEX = np.dtype(
    {"names": ["position", "normal"], "formats": [("<i2", 3), ("i1", 3)], "offsets": [0, 8], "itemsize": 12}
)
"""Data type of a vertex, consisting of position and normal. Each begins at a multiple of four bytes, as glTF
requires.
"""

_BYTE, _SHORT, _UNSIGNED_SHORT, _UNSIGNED_INT, _FLOAT = 5120, 5122, 5123, 5125, 5126  # component types
_VERTICES, _INDICES, _KEYS = range(3)  # the buffer views
_VIEWS: tuple[dict[str, int], ...] = (
    {"byteStride": _VERTEX.itemsize, "target": 34962},  # ARRAY_BUFFER
    {"target": 34963},  # ELEMENT_ARRAY_BUFFER
    {},
)


@dataclass(slots=True)
class _GlbFile:
    """Content of a GLB file: objects of the JSON chunk, and the bytes of each buffer view."""

    nodes: list[dict[str, Any]] = field(default_factory=list)
    meshes: list[dict[str, Any]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)
    animations: list[dict[str, Any]] = field(default_factory=list)
    views: tuple[bytearray, ...] = field(default_factory=lambda: (bytearray(), bytearray(), bytearray()))
    shared: dict[object, int] = field(default_factory=dict)  # numbers of accessors and meshes, by their content

    def append(self, view: int, values: np.ndarray[Any, Any]) -> int:
        """Append an array, padded to a multiple of four bytes, to a buffer view and return its offset [byte]."""
        start, raw = len(self.views[view]), values.tobytes()
        self.views[view].extend(raw + b"\0" * (-len(raw) % 4))
        return start

    def accessor(self, view: int, start: int, count: int, kind: str, component: int, **more: Any) -> int:
        """Add an accessor for `count` elements of a view from a byte offset, with glTF types, and return its index."""
        own = {"bufferView": view, "byteOffset": start, "componentType": component, "count": count, "type": kind}
        self.accessors.append(own | more)
        return len(self.accessors) - 1

    def node(self, **content: Any) -> int:
        """Add a node with the given content, and return its index."""
        self.nodes.append(content)
        return len(self.nodes) - 1

    def to_bytes(self, name: str, root: int) -> bytes:
        """Return the bytes of the file: a header, the JSON chunk and the binary chunk (glTF 2.0, section 4.4)."""
        data, views = b"", []
        for each, more in zip(self.views, _VIEWS, strict=True):
            own = each or bytes(4)  # glTF does not allow an empty view
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(own)} | more)
            data += own
        content = {
            "asset": {"generator": "geartrain", "version": "2.0"},
            "extensionsUsed": ["KHR_mesh_quantization"],
            "extensionsRequired": ["KHR_mesh_quantization"],
            "scene": 0,
            "scenes": [{"name": name, "nodes": [root]}],
            "nodes": self.nodes,
            "materials": [
                {"name": name or "wheel", "pbrMetallicRoughness": {"baseColorFactor": [*colour, 1.0], **_LOOK}}
                for name, colour in _COLOURS.items()
            ],
            "meshes": self.meshes,
            "accessors": self.accessors,
            "animations": self.animations,
            "bufferViews": views,
            "buffers": [{"byteLength": len(data)}],
        }
        content = {key: value for key, value in content.items() if value != []}
        text = json.dumps(content, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)  # chunks have multiples of four bytes; JSON is padded with spaces
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def to_glb(work: SolidModel, turns: Fraction | None = None) -> bytes:
    """Return the assembly as a GLB file with its motion over `turns` turns of the driving link (see `Keyframes.of`)."""
    file, bodies = _GlbFile(), work.scene.bodies
    points = [np.array(body.point) for body in bodies]
    for body, point in zip(bodies, points, strict=True):
        origin = np.zeros(3) if body.parent is None else points[body.parent]
        file.node(name=body.id, translation=(point - origin).tolist(), rotation=[0.0, 0.0, 0.0, 1.0], children=[])
    for at, body in enumerate(bodies):
        if body.parent is not None:
            file.nodes[body.parent]["children"].append(at)
    for part in work.parts:
        file.nodes[part.body]["children"].append(_part(file, part, points[part.body]))
    for node in file.nodes[: len(bodies)]:
        if not node["children"]:
            del node["children"]  # glTF does not allow an empty list
    _animate(file, work, turns)
    roots = [at for at, body in enumerate(bodies) if body.parent is None]
    # z points to the reader, as in drawings: the front of the train is turned to the camera
    front = [0.0, 0.0, 0.0, 1.0] if work.scene.front > 0 else [0.0, 1.0, 0.0, 0.0]
    root = file.node(name=work.train.name, scale=[_METRE] * 3, rotation=front, children=roots)
    return file.to_bytes(work.train.name, root)


def _part(file: _GlbFile, part: SolidPart, origin: Floats) -> int:
    """Add a node for a part, whose body has the origin `origin` [mm], and return the index of the node."""
    solid = part.solid
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    middle, step = (low + high) / 2, float((high - low).max()) / _STEPS
    steps = np.rint((solid.vertices - middle) / step).astype(np.int16)
    matrix = np.identity(4)
    matrix[:3, :3], matrix[:3, 3] = step * part.turn, part.turn @ middle + part.place - origin
    mesh = _mesh(file, part, *_vertices(solid, steps))
    return file.node(name=part.name, mesh=mesh, matrix=matrix.T.reshape(-1).tolist())  # column by column


def _vertices(solid: Solid, steps: np.ndarray[Any, Any]) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Return the distinct vertices (integer position `steps`, normal) of a solid, and the indices of its triangles."""
    corners, at = solid.vertices[solid.faces], solid.faces.reshape(-1).astype(np.int64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    # glTF requires unit normals, also for degenerate triangles
    normals = np.where(length > 0, normals / np.where(length > 0, length, 1), np.array([0.0, 0.0, 1.0]))
    short = np.repeat(np.rint(_UNIT * normals).astype(np.int64), 3, axis=0)
    # one integer for each corner: 8 bits for each component of the normal, and the index of the position
    code = (at << 24) + ((short + 128) << np.array([16, 8, 0])).sum(axis=1)
    _, first, indices = np.unique(code, return_index=True, return_inverse=True)
    vertices = np.zeros(len(first), dtype=_VERTEX)
    vertices["position"], vertices["normal"] = steps[at[first]], short[first]
    # index 65535 is reserved for primitive restart
    return vertices, indices.reshape(-1).astype("<u2" if len(first) <= 65535 else "<u4")


def _mesh(file: _GlbFile, part: SolidPart, vertices: np.ndarray[Any, Any], indices: np.ndarray[Any, Any]) -> int:
    """Return the index of the mesh with the given triangles and the material of the part, added if it is new."""
    colour = "plate" if part.kind in ("plate", "pillar", "post", "drum") else "arbor"
    material = list(_COLOURS).index(part.status if part.kind == "wheel" else colour)
    shape = vertices.tobytes(), indices.tobytes()
    if shape not in file.shared:
        start, positions = file.append(_VERTICES, vertices), vertices["position"]
        limits = {"min": positions.min(axis=0).tolist(), "max": positions.max(axis=0).tolist()}
        short = _UNSIGNED_SHORT if indices.itemsize == 2 else _UNSIGNED_INT
        file.shared[shape] = file.accessor(_VERTICES, start, len(vertices), "VEC3", _SHORT, **limits)
        file.accessor(_VERTICES, start + 8, len(vertices), "VEC3", _BYTE, normalized=True)
        file.accessor(_INDICES, file.append(_INDICES, indices), len(indices), "SCALAR", short)
    if (shape, material) not in file.shared:
        position = file.shared[shape]
        attributes = {"POSITION": position, "NORMAL": position + 1}
        primitive = {"attributes": attributes, "indices": position + 2, "material": material}
        file.meshes.append({"name": part.name, "primitives": [primitive]})
        file.shared[shape, material] = len(file.meshes) - 1
    return file.shared[shape, material]


def _animate(file: _GlbFile, work: SolidModel, turns: Fraction | None) -> None:
    """Add an animation of the rotation or translation of each body relative to its parent."""
    turning = Keyframes.of(work, turns)
    if turning is None:
        return
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, Any]] = []
    clocks: dict[int, int] = {}
    for at, body in enumerate(work.scene.bodies):
        count = turning.keys(at)
        if body.parent is None or not count:
            continue
        if count not in clocks:
            moments = (np.arange(count + 1) / count * turning.seconds).astype("<f4")
            limits = {"min": [float(moments[0])], "max": [float(moments[-1])]}
            clocks[count] = file.accessor(_KEYS, file.append(_KEYS, moments), count + 1, "SCALAR", _FLOAT, **limits)
        half = turning.angle(at, count) / 2
        axis = np.array(body.direction)
        if body.travels:
            places = np.array(file.nodes[at]["translation"]) + np.outer(half / pi, axis)
            values, kind, path = places, "VEC3", "translation"
        else:
            values = np.column_stack([np.sin(half)[:, None] * axis, np.cos(half)])
            # quaternions q and -q are the same rotation; with equal signs every reader interpolates the shorter way
            apart = (values[1:] * values[:-1]).sum(axis=1) < 0
            values[1:] *= np.where(np.cumsum(apart) % 2, -1.0, 1.0)[:, None]
            kind, path = "VEC4", "rotation"
        output = file.accessor(_KEYS, file.append(_KEYS, values.astype("<f4")), count + 1, kind, _FLOAT)
        channels.append({"sampler": len(samplers), "target": {"node": at, "path": path}})
        samplers.append({"input": clocks[count], "output": output, "interpolation": "LINEAR"})
    if channels:
        name = f"{turning.turns} turns of {work.scene.bodies[work.scene.driving_link or 0].id}"
        file.animations.append({"name": name, "channels": channels, "samplers": samplers})


# ----------------------------------------------------------------------------------------------------------- key frames

_A_TURN = 3  # key frames per turn: readers interpolate the shorter way, so two would be ambiguous
_RIPPLING = 48  # key frames per turn if teeth or pins add transmission errors
_MINIMUM_RIPPLING = 240  # minimum number of key frames with transmission errors, for a slow body
_MOST = 60_000  # maximum key frames of one body: a longer period is not shown completely
_USUAL = 10  # turns of the driving link, if the period is too long
_PACE = 1.0  # seconds in which the fastest body turns once
_LONGEST = 120.0  # maximum duration [s]


@dataclass(frozen=True)
class Keyframes:
    """Motion in an animation: speeds of the bodies, and duration."""

    work: SolidModel
    turns: Fraction
    """Number of turns of the driving link in the animation."""
    seconds: float
    """Duration of the animation [s]."""
    speeds: tuple[Fraction | None, ...]
    """Speed of each body relative to its parent, divided by that of the driving link; None if undetermined."""
    ripples: bool
    _found: dict[int, Floats] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(cls, work: SolidModel, turns: Fraction | None = None) -> Keyframes | None:
        """Return the key frames of a train over `turns` turns of the driving link, or None if nothing turns.

        The default is one period of the motion; for a long period, it is ten turns, or the maximum number of turns.
        """
        scene = work.scene
        if scene.movement.kind == "still" or scene.driving_link is None:
            return None
        speeds = _relative(work)
        turning = (speed for speed, body in zip(speeds, scene.bodies, strict=True) if speed and not body.travels)
        fastest = max(map(abs, turning), default=Fraction(0))
        if not fastest:
            return None
        ripples = scene.movement.kind == "real"
        dense = _RIPPLING if ripples else _A_TURN
        if turns is None:
            period = read_fraction(scene.movement.period) if scene.movement.period else None
            # a whole period repeats without a jump, but only if it is short enough
            turns = period if period and period * fastest * dense <= _MOST else Fraction(_USUAL)
            turns = min(turns, Fraction(_MOST) / (fastest * dense))
        elif turns <= 0 or turns * fastest * dense > _MOST:
            most = float(_MOST / (fastest * dense))
            why = (
                f"an animation has more than 0 turns and at most {_MOST:,} key frames of a body ({most:.4g} turns here)"
            )
            fix = f"give more than 0 and at most {most:.4g} turns of the driving link"
            raise QuestionError(Problem(f"{turns} turns cannot be animated", why, fix, "--turns"))
        seconds = min(max(float(turns * fastest) * _PACE, 1.0), _LONGEST)
        return cls(work, turns, seconds, speeds, ripples)

    def keys(self, body: int) -> int:
        """Return the number of key frames of a body minus 1; 0 if the body is fixed relative to its parent."""
        speed = self.speeds[body]
        if self.work.scene.bodies[body].travels and not self.ripples:
            return 1 if speed else 0
        turned = abs(float((speed or 0) * self.turns))
        if self.ripples and self.work.scene.bodies[body].speed is not None:
            return max(ceil(_RIPPLING * turned), _MINIMUM_RIPPLING)
        return ceil(_A_TURN * turned)

    def angle(self, body: int, count: int) -> Floats:
        """Return the angles of a body relative to its parent at `count` + 1 equally spaced times [rad]."""
        bodies = self.work.scene.bodies
        found = np.zeros(count + 1)
        for at, sign in ((body, 1), (bodies[body].reference, -1)):
            if at is not None and bodies[at].parent is not None:
                own = bodies[at]
                whole = read_fraction(own.speed or "0") * self.turns
                # fractions of a turn in exact integers, so that a periodic motion closes without rounding errors
                above, below = whole.numerator, whole.denominator * count
                parts = [(above * k if own.travels else above * k % below) / below for k in range(count + 1)]
                found += sign * own.sense * (own.start + 2 * pi * np.array(parts) + self._errors(count)[at])
        return found

    def _errors(self, count: int) -> Floats:
        """Return the deviations of all bodies from mean motion [rad] at `count` + 1 times, (bodies, count + 1)."""
        bodies = self.work.scene.bodies
        if not self.ripples:
            return np.zeros((len(bodies), count + 1))
        if count not in self._found:  # shared by all bodies with this number of key frames
            links = tuple(self.work.train.declaration.links)
            motion = self.work.sized.motion(self.work.scene.state, links)
            error = motion.at(float(self.turns) * np.arange(count + 1) / count).error
            # travels of 1 mm are angles of 2 pi here
            self._found[count] = error * [[2 * pi if body.travels else 1.0] for body in bodies]
        return self._found[count]


def _relative(work: SolidModel) -> tuple[Fraction | None, ...]:
    bodies = work.scene.bodies
    found: list[Fraction | None] = []
    for body in bodies:
        parent = None if body.reference is None else bodies[body.reference]
        if parent is None or body.speed is None:
            found.append(None)
            continue
        carried = read_fraction(parent.speed or "0") * parent.sense if parent.parent is not None else Fraction(0)
        found.append(read_fraction(body.speed) * body.sense - carried)
    return tuple(found)
