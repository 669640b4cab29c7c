// Markers of the contacts of a simulated run: a flash at an impact, a ring at separated teeth, drawn above all parts.

import { BufferAttribute, BufferGeometry, Color, GLSL3, Points, RawShaderMaterial } from "three";

import { NEEDLES } from "./colours.js";
import { vector } from "./space.js";

const corner = `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform float unit; // pixels of a spark at its brightest
in vec3 position;
in vec2 look; // brightness of a blow; 1 where teeth are apart
out vec2 seen;
void main() {
  seen = look;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  gl_PointSize = max(look.x, look.y) > 0.01 ? unit : 0.0;
}`;

const point = `
precision highp float;
in vec2 seen;
uniform vec3 apart;
out vec4 colour;
void main() {
  float off = 2.0 * length(gl_PointCoord - 0.5);
  float reach = 0.35 + 0.65 * seen.x;
  float core = sqrt(seen.x) * smoothstep(0.42 * reach, 0.1 * reach, off);
  float halo = sqrt(seen.x) * 0.75 * pow(max(0.0, 1.0 - off / reach), 1.5);
  float ring = 0.9 * seen.y * smoothstep(0.06, 0.02, abs(off - 0.3));
  vec3 blow = mix(vec3(1.0, 0.32, 0.02), vec3(1.0, 0.93, 0.6), core);
  float blaze = max(core, halo);
  float whole = max(blaze, ring);
  if (whole < 0.02) discard;
  colour = vec4(blaze > ring ? blow : apart, whole);
}`;

export class Sparks {
  constructor(scene, poses, run) {
    Object.assign(this, { poses, run });
    this.places = scene.run.contacts.map(({ body, at }) => ({ body, at: vector(at), lift: poses.lift(body, vector(at)) }));
    const count = this.places.length;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * count), 3));
    this.geometry.setAttribute("look", new BufferAttribute(new Float32Array(2 * count), 2));
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: corner,
      fragmentShader: point,
      uniforms: { unit: { value: 64 }, apart: { value: new Color(NEEDLES[0]).convertLinearToSRGB() } },
      transparent: true,
      depthTest: false,
      depthWrite: false,
    });
    this.points = Object.assign(new Points(this.geometry, this.material), { frustumCulled: false, renderOrder: 9, matrixAutoUpdate: false });
  }

  /** Updates the markers to a time of the run (s). */
  set(time) {
    const { position, look } = this.geometry.attributes;
    this.places.forEach(({ body, at, lift }, index) => {
      const here = this.poses.apart(at, lift).applyMatrix4(this.poses.nodes[body].matrixWorld);
      position.setXYZ(index, here.x, here.y, here.z);
      look.setXY(index, this.run.flash(index, time), this.run.state(index, time) === "a" ? 1 : 0);
    });
    position.needsUpdate = look.needsUpdate = true;
  }

  /** Sizes the markers for a picture of a given width (px). */
  scale(pixels) {
    const crowd = Math.min(1, Math.max(0.5, Math.sqrt(12 / this.places.length)));
    this.material.uniforms.unit.value = crowd * Math.min(160, Math.max(48, 0.14 * pixels));
  }

  dispose() {
    this.geometry.dispose();
    this.material.dispose();
  }
}
