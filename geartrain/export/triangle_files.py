"""Solids as binary STL, in mm, and the turning assembly as binary glTF, in metres: a node a body, its rotation in key
frames.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import MissingExtraError
from geartrain.scene.solids.keyframes import Keyframes
from geartrain.scene.solids.solid_assembly import SolidModel
from geartrain.scene.solids.solid_part import SolidPart, by_body

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.triangle_solids import Solid


_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def to_stl(solid: Solid, name: str) -> bytes:
    """A solid as binary STL; the header holds its name."""
    corners = solid.vertices[solid.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    rows["normal"] = normals / np.where(length > 0, length, 1)
    rows["corners"] = corners
    header = f"{name}, mm".encode("ascii", "replace")[:79].ljust(80)
    return header + np.uint32(len(rows)).tobytes() + rows.tobytes()


_METRE = 0.001
_COLOURS: dict[str, tuple[float, float, float]] = {
    "surviving": (0.72, 0.53, 0.2),
    "reconstructed": (0.45, 0.56, 0.68),
    "hypothetical": (0.72, 0.46, 0.55),
    "": (0.75, 0.63, 0.36),
    "arbor": (0.55, 0.55, 0.58),
    "plate": (0.62, 0.6, 0.52),
}


@dataclass(frozen=True, slots=True)
class _Buffer:
    """Bytes of all accessors, each at a multiple of four."""

    gltf: Any
    data: bytearray

    def add(self, values: Any, kind: str, component: int, target: int | None = None, limits: bool = False) -> int:
        """Number of a new accessor over these values."""
        from pygltflib import Accessor, BufferView

        raw = values.tobytes()
        self.gltf.bufferViews.append(
            BufferView(buffer=0, byteOffset=len(self.data), byteLength=len(raw), target=target)
        )
        self.data.extend(raw + b"\0" * (-len(raw) % 4))
        flat = values.reshape(len(values), -1)
        ends = {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()} if limits else {}
        view = len(self.gltf.bufferViews) - 1
        self.gltf.accessors.append(
            Accessor(bufferView=view, componentType=component, count=len(values), type=kind, **ends)
        )
        return len(self.gltf.accessors) - 1


def to_glb(work: SolidModel, turns: Fraction | None = None) -> bytes:
    """The assembly with its motion over some turns of the lead (default `Keyframes`'s). Raises `MissingExtraError`."""
    try:
        from pygltflib import GLTF2, Asset, Buffer, Material, Node, PbrMetallicRoughness
        from pygltflib import Scene as Root
    except ImportError:
        raise MissingExtraError("pygltflib", "model", "a model as GLB") from None
    gltf = GLTF2(asset=Asset(generator="geartrain", version="2.0"), scene=0)
    buffer = _Buffer(gltf, bytearray())
    numbers = {}
    for name, colour in _COLOURS.items():
        numbers[name] = len(gltf.materials)
        metal = PbrMetallicRoughness(baseColorFactor=[*colour, 1.0], metallicFactor=0.4, roughnessFactor=0.5)
        gltf.materials.append(Material(name=name or "wheel", pbrMetallicRoughness=metal))
    bodies, points = work.scene.bodies, [np.array(body.point) for body in work.scene.bodies]
    for body, point in zip(bodies, points, strict=True):
        origin = np.zeros(3) if body.parent is None else points[body.parent]
        gltf.nodes.append(Node(name=body.id, translation=(point - origin).tolist(), rotation=[0.0, 0.0, 0.0, 1.0]))
    for at, body in enumerate(bodies):
        if body.parent is not None:
            gltf.nodes[body.parent].children.append(at)
    for at, parts in by_body(work.parts).items():
        for part in parts:
            material = numbers[_material(part)]
            gltf.meshes.append(_mesh(buffer, part, points[at], material))
            gltf.nodes.append(Node(name=part.name, mesh=len(gltf.meshes) - 1))
            gltf.nodes[at].children.append(len(gltf.nodes) - 1)
    roots = [at for at, body in enumerate(bodies) if body.parent is None]
    # z is up on paper, y in glTF: the front of the train looks at the reader
    front = [0.0, 0.0, 0.0, 1.0] if work.scene.front > 0 else [0.0, 1.0, 0.0, 0.0]
    gltf.nodes.append(Node(name=work.train.name, scale=[_METRE] * 3, rotation=front, children=roots))
    gltf.scenes.append(Root(name=work.train.name, nodes=[len(gltf.nodes) - 1]))
    _animate(buffer, work, turns)
    gltf.buffers.append(Buffer(byteLength=len(buffer.data)))
    gltf.set_binary_blob(bytes(buffer.data))
    return b"".join(gltf.save_to_bytes())


def _material(part: SolidPart) -> str:
    if part.kind == "wheel":
        return part.status
    return "plate" if part.kind in ("plate", "pillar", "post") else "arbor"


def _mesh(buffer: _Buffer, part: SolidPart, origin: Floats, material: int) -> Any:
    """Every triangle with corners of its own, so that edges stay sharp."""
    from pygltflib import ARRAY_BUFFER, FLOAT, Attributes, Mesh, Primitive

    placed = part.placed
    corners = (placed.vertices[placed.faces] - origin).astype("<f4")
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(length > 0, normals / np.where(length > 0, length, 1), np.array([0.0, 0.0, 1.0]))
    position = buffer.add(corners.reshape(-1, 3), "VEC3", FLOAT, ARRAY_BUFFER, limits=True)
    normal = buffer.add(np.repeat(normals, 3, axis=0).astype("<f4"), "VEC3", FLOAT, ARRAY_BUFFER)
    attributes = Attributes(POSITION=position, NORMAL=normal)
    return Mesh(name=part.name, primitives=[Primitive(attributes=attributes, material=material)])


def _animate(buffer: _Buffer, work: SolidModel, turns: Fraction | None) -> None:
    from pygltflib import FLOAT, Animation, AnimationChannel, AnimationChannelTarget, AnimationSampler

    turning = Keyframes.of(work, turns)
    if turning is None:
        return
    animation = Animation(name=f"{turning.turns} turns of {work.scene.bodies[work.scene.lead or 0].id}")
    clocks: dict[int, int] = {}
    for at, body in enumerate(work.scene.bodies):
        count = turning.keys(at)
        if body.parent is None or not count:
            continue
        t = np.arange(count + 1) / count
        if count not in clocks:
            clocks[count] = buffer.add((t * turning.seconds).astype("<f4"), "SCALAR", FLOAT, limits=True)
        half = turning.angle(at, count) / 2
        axis = np.array(body.direction)
        quaternions = np.column_stack([np.sin(half)[:, None] * axis, np.cos(half)])
        # q and -q turn alike: neighbours of one sign are joined the shorter way by every reader
        apart = (quaternions[1:] * quaternions[:-1]).sum(axis=1) < 0
        quaternions[1:] *= np.where(np.cumsum(apart) % 2, -1.0, 1.0)[:, None]
        output = buffer.add(quaternions.astype("<f4"), "VEC4", FLOAT)
        animation.samplers.append(AnimationSampler(input=clocks[count], output=output, interpolation="LINEAR"))
        target = AnimationChannelTarget(node=at, path="rotation")
        animation.channels.append(AnimationChannel(sampler=len(animation.samplers) - 1, target=target))
    if animation.channels:
        buffer.gltf.animations.append(animation)
