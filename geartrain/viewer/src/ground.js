// Ground below a train, drawn only as a soft shadow.

import { CircleGeometry, GLSL3, Mesh, RawShaderMaterial } from "three";

import { frameAt, vector } from "./space.js";

const BELOW = 0.012; // distance below the train's lowest point, relative to its size
const SOFT = 0.32; // width of the edge of the shadow, relative to the size
const DARK = 0.34;

const corner = `
precision highp float;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 middle, half_wide;
uniform float soft, low;
in vec3 position;
out vec2 off;
void main() {
  off = position.xy * (half_wide + soft); // to the right, and to the reader
  gl_Position = projectionMatrix * modelViewMatrix * vec4(middle.x + off.x, low, middle.y + off.y, 1.0);
}`;

const point = `
precision highp float;
uniform vec2 half_wide;
uniform float soft, dark;
in vec2 off;
out vec4 colour;
void main() {
  vec2 core = 0.72 * half_wide;
  vec2 away = off / (core + soft), near = off / (0.5 * core + 0.3 * soft); // a wide one, and one of what stands on the ground
  float wide = max(1.0 - dot(away, away), 0.0), narrow = max(1.0 - dot(near, near), 0.0);
  float shade = 0.6 * wide * wide + 0.4 * narrow;
  colour = vec4(0.0, 0.0, 0.0, dark * shade);
}`;

/** A mesh below the points of an outline; `fit` moves it below other points. */
export class Ground {
  constructor(size, up) {
    const number = (value) => ({ value });
    this.uniforms = { middle: number([0, 0]), half_wide: number([1, 1]), soft: number(SOFT * size), low: number(0), dark: number(DARK) };
    const about = { glslVersion: GLSL3, vertexShader: corner, fragmentShader: point, uniforms: this.uniforms, transparent: true, depthWrite: false };
    // clockwise seen from above, so that it is invisible from below
    this.mesh = new Mesh(new CircleGeometry(1.05, 48), new RawShaderMaterial({ ...about, side: 1 }));
    this.mesh.matrixAutoUpdate = this.mesh.frustumCulled = false;
    this.mesh.matrix.copy(frameAt([0, 0, 0], vector([1, 0, 0]).cross(vector(up)).toArray(), [1, 0, 0])); // its y axis is upwards
    this.back = this.mesh.matrix.clone().invert();
    this.mesh.renderOrder = -1;
    this.size = size;
  }

  fit(points) {
    const own = points.map((point) => point.clone().applyMatrix4(this.back));
    const range = (key) => own.reduce(([low, high], point) => [Math.min(low, point[key]), Math.max(high, point[key])], [Infinity, -Infinity]);
    const [[left, right], [low], [back, front]] = ["x", "y", "z"].map(range);
    if (!Number.isFinite(low)) return;
    this.uniforms.middle.value = [(left + right) / 2, (back + front) / 2];
    this.uniforms.half_wide.value = [(right - left) / 2, (front - back) / 2];
    this.uniforms.low.value = low - BELOW * this.size;
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
