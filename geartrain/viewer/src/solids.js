// Solids, all of one material: the GPU learns one program, and is not told of another for each part. Colours stand
// with the instances.

import { BufferGeometry, Color, DoubleSide, Float32BufferAttribute, InstancedMesh, Matrix4, MeshPhongMaterial } from "three";

const METAL = new MeshPhongMaterial({ side: DoubleSide, shininess: 34, specular: 0x2c2823 });
const UNSEEN = METAL.clone();
UNSEEN.visible = false;

/** A geometry `count` times round its z axis, in one colour. */
export function solid(geometry, colour, count = 1) {
  const mesh = new InstancedMesh(geometry, METAL, count);
  const matrix = new Matrix4();
  for (let n = 0; n < count; n += 1) mesh.setMatrixAt(n, matrix.makeRotationZ((2 * Math.PI * n) / count));
  paint(mesh, new Color(colour));
  return mesh;
}

export function paint(mesh, colour) {
  for (let n = 0; n < mesh.count; n += 1) mesh.setColorAt(n, colour);
  mesh.instanceColor.needsUpdate = true;
}

/** A solid that can be touched and not seen. */
export function unseen(geometry) {
  const mesh = solid(geometry, 0);
  mesh.material = UNSEEN;
  return mesh;
}

/** Triangles (x, y, z after each other) as a geometry with flat faces. */
export function flat(triangles) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(triangles, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Two triangles between four points in order. */
export const quad = (triangles, a, b, c, d) => triangles.push(...a, ...b, ...c, ...a, ...c, ...d);

/** A closed outline of [radius, z] points swept round the z axis in `count` steps. */
export function swept(triangles, outline, count) {
  const at = ([radius, z], n) => [radius * Math.cos((2 * Math.PI * n) / count), radius * Math.sin((2 * Math.PI * n) / count), z];
  outline.forEach((point, m) => {
    const next = outline[(m + 1) % outline.length];
    for (let n = 0; n < count; n += 1) quad(triangles, at(point, n), at(next, n), at(next, n + 1), at(point, n + 1));
  });
  return triangles;
}
