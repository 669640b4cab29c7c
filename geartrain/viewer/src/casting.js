// Castings: positioned shapes merged into one geometry, which one draw call draws.

import { BufferAttribute, BufferGeometry, Matrix4, Mesh, Sphere, Vector3 } from "three";

export class Casting {
  constructor() {
    this.jobs = [];
  }

  /**
   * Adds a shape, repeated `count` times around its z axis.
   *
   * matrix       its position in the zero pose
   * body, slot   by index
   * lift         displacement along the main direction in the exploded view, a number or a function of each point
   */
  add(shape, matrix, { body, slot, lift, count = 1 }) {
    turnOut(shape);
    if (shape.corners) this.jobs.push({ shape, matrix, body, slot, lift, count });
  }

  /**
   * Creates the meshes of all added shapes: opaque, transparent, and cut open, with their insides. `parts` gives the range
   * of each shape in the geometry.
   */
  cast([seen, ghosts, cut, inside]) {
    const total = (key) => this.jobs.reduce((sum, job) => sum + job.count * key(job.shape), 0);
    const corners = total((shape) => shape.corners);
    const data = {
      position: new BufferAttribute(new Float32Array(3 * corners), 3),
      normal: new BufferAttribute(new Int8Array(4 * corners), 4, true),
      grain: new BufferAttribute(new Int8Array(4 * corners), 4, true),
      place: new BufferAttribute(new Uint16Array(2 * corners), 2),
      lift: new BufferAttribute(new Float32Array(corners), 1),
    };
    this.index = new Uint32Array(total((shape) => shape.indices.length));
    this.parts = [];
    let [first, next] = [0, 0];
    for (const job of this.jobs) {
      const [from, began] = [next, first];
      for (let n = 0; n < job.count; n += 1) {
        set(data, job, n, first);
        for (const at of job.shape.indices) this.index[next++] = first + at;
        first += job.shape.corners;
      }
      this.parts.push({ body: job.body, slot: job.slot, from, to: next, first: began, last: first, ball: around(data.position.array, began, first) });
    }
    this.jobs = [];
    const drawn = new BufferAttribute(this.index.slice(), 1);
    const made = (geometry, material) => Object.assign(new Mesh(geometry, material), { frustumCulled: false, matrixAutoUpdate: false });
    this.meshes = [seen, ghosts, cut].map((material) => {
      const geometry = new BufferGeometry().setIndex(drawn);
      for (const [name, attribute] of Object.entries(data)) geometry.setAttribute(name, attribute);
      return made(geometry, material);
    });
    this.meshes[2].add(made(this.meshes[2].geometry, inside));
    this.geometry = this.meshes[0].geometry;
    return this.meshes;
  }

  /** Distributes the parts: each mesh draws those for which `meshOf(slot)` is its number. */
  distribute(meshOf) {
    const { index } = this.geometry;
    let next = 0;
    this.meshes.forEach((mesh, at) => {
      const start = next;
      for (const { slot, from, to } of this.parts) {
        if (meshOf(slot) !== at) continue;
        index.array.set(this.index.subarray(from, to), next);
        next += to - from;
      }
      mesh.geometry.setDrawRange(start, next - start);
      mesh.visible = next > start;
    });
    index.needsUpdate = true;
  }

  /** Intersections of a ray, unordered: [distance, part]. `seenBy(body)`: the ray in the frame of a body; `shift(lift)`: mm. */
  *met(seenBy, shift) {
    if (!this.geometry) return;
    const { position, lift } = this.geometry.attributes;
    const { index } = this;
    const [corners, hit] = [[new Vector3(), new Vector3(), new Vector3()], new Vector3()];
    const ball = new Sphere();
    for (const part of this.parts) {
      const own = seenBy(part.body);
      const most = shift(lift.array[index[part.from]]);
      ball.copy(part.ball).radius += most.length() + 1e-9;
      if (!own.intersectsSphere(ball)) continue;
      for (let at = part.from; at < part.to; at += 3) {
        corners.forEach((corner, k) => corner.fromBufferAttribute(position, index[at + k]).add(shift(lift.array[index[at + k]])));
        if (own.intersectTriangle(...corners, false, hit)) yield [hit.distanceTo(own.origin), part];
      }
    }
  }

  dispose() {
    for (const { geometry } of this.meshes ?? []) geometry.dispose();
  }
}

/** Orients all triangles counter-clockwise as seen from outside, so that back faces are not drawn. */
function turnOut({ points: p, normals: n, indices }) {
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [3 * indices[at], 3 * indices[at + 1], 3 * indices[at + 2]];
    let out = 0;
    for (let k = 0; k < 3; k += 1) {
      const [l, m] = [(k + 1) % 3, (k + 2) % 3];
      out += (n[a + k] + n[b + k] + n[c + k]) * ((p[b + l] - p[a + l]) * (p[c + m] - p[a + m]) - (p[b + m] - p[a + m]) * (p[c + l] - p[a + l]));
    }
    if (out < 0) [indices[at + 1], indices[at + 2]] = [indices[at + 2], indices[at + 1]];
  }
}

/** Writes one copy of a shape into the arrays, from vertex `first` on. */
function set({ position, normal, grain, place, lift }, { shape, matrix, body, slot, lift: height, count }, copy, first) {
  const turned = copy ? matrix.clone().multiply(new Matrix4().makeRotationZ((2 * Math.PI * copy) / count)) : matrix;
  move(position.array, 3 * first, 3, turned.elements, 1, 1, shape.points);
  move(normal.array, 4 * first, 4, turned.elements, 0, 127, shape.normals);
  move(grain.array, 4 * first, 4, turned.elements, 0, 127, shape.grains);
  const last = first + shape.corners;
  for (let to = first; to < last; to += 1) {
    place.array[2 * to] = body;
    place.array[2 * to + 1] = slot;
  }
  if (typeof height === "number") lift.array.fill(height, first, last);
  else for (let to = first; to < last; to += 1) lift.array[to] = height(new Vector3().fromBufferAttribute(position, to));
}

/** Writes vectors, transformed by a matrix `e` and scaled, into an array; `shift` is 1 for points and 0 for directions. */
function move(array, to, stride, e, shift, scale, triples) {
  for (let i = 0; i < triples.length; i += 3, to += stride) {
    const [x, y, z] = [triples[i], triples[i + 1], triples[i + 2]];
    array[to] = scale * (e[0] * x + e[4] * y + e[8] * z + shift * e[12]);
    array[to + 1] = scale * (e[1] * x + e[5] * y + e[9] * z + shift * e[13]);
    array[to + 2] = scale * (e[2] * x + e[6] * y + e[10] * z + shift * e[14]);
  }
}

function around(points, from, to) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let at = 3 * from; at < 3 * to; at += 1) {
    low[at % 3] = Math.min(low[at % 3], points[at]);
    high[at % 3] = Math.max(high[at % 3], points[at]);
  }
  const middle = new Vector3(...low).add(new Vector3(...high)).multiplyScalar(0.5);
  return new Sphere(middle, middle.distanceTo(new Vector3(...high)));
}
