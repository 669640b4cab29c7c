// The one material: brushed metal under lamps that go with the reader. One program draws everything.
//
// Each corner knows its body and its slot; where the body stands and what the slot looks like are read from two small
// textures, so that a train, however many parts it has, is drawn in one call.

import { DataTexture, DoubleSide, FloatType, GLSL3, NearestFilter, RawShaderMaterial, RGBAFormat } from "three";

export const WIDTH = 256; // texels of the poses' texture, four a body

const corner = `
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D poses, palette;
uniform vec3 axis, middle;
uniform float share;
uniform bool ghosts; // whether what is half seen is drawn now, or what is seen
in vec3 position;
in vec3 normal;
in vec3 grain;
in vec2 place; // body, slot
in float lift;
out vec3 facing, brushed, seen;
out vec4 paint;
out float gloss, deep;
vec4 pose(int at) { return texelFetch(poses, ivec2(at % ${WIDTH}, at / ${WIDTH}), 0); }
void main() {
  int slot = 2 * int(place.y + 0.5);
  ivec2 at = ivec2(slot % 256, slot / 256);
  paint = texelFetch(palette, at, 0);
  if (paint.a < 0.004 || (paint.a < 0.99) != ghosts) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  gloss = texelFetch(palette, at + ivec2(1, 0), 0).r;
  int body = 4 * int(place.x + 0.5);
  mat4 model = mat4(pose(body), pose(body + 1), pose(body + 2), pose(body + 3));
  mat4 stands = viewMatrix * model;
  vec4 eye = stands * vec4(position + axis * (share * lift), 1.0);
  seen = eye.xyz;
  facing = mat3(stands) * normal;
  brushed = mat3(stands) * grain;
  deep = eye.z - (viewMatrix * vec4(middle, 1.0)).z;
  gl_Position = projectionMatrix * eye;
}`;

const point = `
precision highp float;
uniform float size;
in vec3 facing, brushed, seen;
in vec4 paint;
in float gloss, deep;
out vec4 colour;
const vec3 KEY = vec3(-0.45, 0.68, 0.58), FILL = vec3(0.75, 0.1, 0.65);
float sheen(vec3 n, vec3 v, vec3 t, vec3 lamp) {
  vec3 half_way = normalize(lamp + v);
  float plain = pow(max(dot(n, half_way), 0.0), 36.0);
  float across = dot(t, half_way);
  float turned = dot(t, t) > 0.25 ? pow(max(1.0 - across * across, 0.0), 14.0) * smoothstep(0.2, 1.0, dot(n, half_way)) : plain;
  return 0.35 * plain + 0.65 * turned;
}
// the room that metal mirrors: a dark floor, a light ceiling, a window and a lamp, soft as brushed metal shows them
float room(vec3 r) {
  float above = mix(0.06, 0.72, smoothstep(-0.5, 0.7, r.y));
  float window = smoothstep(-0.8, -0.4, r.x) * smoothstep(0.2, -0.2, r.x) * smoothstep(0.0, 0.35, r.y) * smoothstep(0.98, 0.65, r.y);
  float lamp = smoothstep(0.3, 0.6, r.x) * smoothstep(0.98, 0.7, r.x);
  float horizon = smoothstep(0.25, 0.0, abs(r.y + 0.15));
  return above + 0.75 * window + 0.4 * lamp - 0.18 * horizon;
}
void main() {
  vec3 v = normalize(-seen);
  vec3 n = normalize(facing);
  if (dot(n, v) < 0.0) n = -n;
  vec3 t = dot(brushed, brushed) > 0.25 ? normalize(brushed) : vec3(0.0);
  vec3 own = paint.rgb * paint.rgb;
  float lit = 0.30 + 0.16 * n.y + 0.62 * max(dot(n, KEY), 0.0) + 0.22 * max(dot(n, FILL), 0.0);
  float rim = pow(1.0 - max(dot(n, v), 0.0), 4.0);
  vec3 glint = mix(vec3(1.0), own * 1.9, 0.62) * (0.62 * sheen(n, v, t, KEY) + 0.26 * sheen(n, v, t, FILL) + 0.10 * rim);
  vec3 mirrored = mix(own * 1.75, vec3(1.0), 0.08 + 0.5 * rim) * room(reflect(-v, n));
  vec3 light = own * lit * mix(1.22, 0.62, gloss) + gloss * (0.85 * glint + 0.66 * mirrored);
  light *= clamp(1.0 + 0.62 * deep / size, 0.62, 1.1); // what lies deeper is darker
  float most = max(light.r, max(light.g, light.b)); // what is too bright keeps its hue
  light *= most > 0.7 ? (1.0 - 0.3 * exp((0.7 - most) / 0.3)) / most : 1.0;
  colour = vec4(sqrt(light), paint.a);
}`;

/** What draws all that is seen, and what is half seen over it: `poses` of `count` bodies, and where their layers lie. */
export function metals(count, main, middle, size) {
  const rows = Math.max(1, Math.ceil((4 * count) / WIDTH));
  const poses = new DataTexture(new Float32Array(4 * WIDTH * rows), WIDTH, rows, RGBAFormat, FloatType);
  poses.minFilter = poses.magFilter = NearestFilter;
  const shared = {
    poses: { value: poses },
    palette: { value: null },
    axis: { value: main },
    middle: { value: middle },
    share: { value: 0 },
    size: { value: size },
  };
  return [false, true].map((ghosts) => {
    const uniforms = { ...shared, ghosts: { value: ghosts } };
    const about = { glslVersion: GLSL3, vertexShader: corner, fragmentShader: point, side: DoubleSide };
    return new RawShaderMaterial({ ...about, uniforms, transparent: ghosts, depthWrite: !ghosts });
  });
}
