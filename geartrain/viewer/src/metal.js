// The single material: brushed metal under lamps that move with the camera. One shader program draws all parts.
//
// Each vertex has its body and its slot; the pose of the body and the appearance of the slot are read from two small
// textures, so that a train is drawn in one call, whatever its number of parts; parts that are cut open need a second.

import { BackSide, Color, DataTexture, FloatType, GLSL3, NearestFilter, RawShaderMaterial, RGBAFormat } from "three";

import { SECTION } from "./colours.js";

export const WIDTH = 256; // texels in a row of the texture of poses, four for each body

const corner = `
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D poses, palette;
uniform vec3 axis, middle;
uniform float share;
in vec3 position;
in vec3 normal;
in vec3 grain;
in vec2 place; // body, slot
in float lift;
out vec3 facing, brushed, seen;
out vec4 paint;
out float gloss, deep;
#ifdef CUT
uniform vec3 edge, right, up;
out vec3 quarter;
flat out vec2 reader;
#endif
vec4 pose(int at) { return texelFetch(poses, ivec2(at % ${WIDTH}, at / ${WIDTH}), 0); }
void main() {
  int slot = 2 * int(place.y + 0.5);
  ivec2 at = ivec2(slot % 256, slot / 256);
  paint = texelFetch(palette, at, 0);
  vec2 kind = texelFetch(palette, at + ivec2(1, 0), 0).rg;
  gloss = kind.r;
  int body = 4 * int(place.x + 0.5);
  mat4 model = mat4(pose(body), pose(body + 1), pose(body + 2), pose(body + 3));
  vec4 world = model * vec4(position + axis * (share * lift), 1.0);
  vec4 eye = viewMatrix * world;
#ifdef CUT
  vec3 off = world.xyz - edge;
  quarter = vec3(dot(off, right), dot(off, up), kind.g);
  vec3 from = -(transpose(mat3(viewMatrix)) * viewMatrix[3].xyz) - edge;
  reader = vec2(dot(from, right), dot(from, up));
#endif
  seen = eye.xyz;
  facing = mat3(viewMatrix) * (mat3(model) * normal);
  brushed = mat3(viewMatrix) * (mat3(model) * grain);
  deep = eye.z - (viewMatrix * vec4(middle, 1.0)).z;
  gl_Position = projectionMatrix * eye;
}`;

const point = `
precision highp float;
uniform float size;
in vec3 facing, brushed, seen;
in vec4 paint;
in float gloss, deep;
#ifdef CUT
in vec3 quarter;
#endif
out vec4 colour;
const vec3 KEY = vec3(-0.45, 0.68, 0.58), FILL = vec3(0.75, 0.1, 0.65);
// squares in a row are cheaper than powers, and a picture has a million points
float square(float x) { return x * x; }
float power16(float x) { return square(square(square(square(x)))); }
float sheen(vec3 n, vec3 v, vec3 t, vec3 lamp, float brush) {
  vec3 half_way = normalize(lamp + v);
  float facing = max(dot(n, half_way), 0.0);
  float plain = square(power16(facing));
  float turned = power16(max(1.0 - square(dot(t, half_way)), 0.0)) * min(1.0, square(facing) * 1.3);
  return mix(plain, turned, 0.65 * brush);
}
// the room that metal mirrors: a dark floor, a light ceiling, a window and a lamp, soft as brushed metal shows them
float room(vec3 r) {
  float above = clamp(0.34 + 0.55 * r.y, 0.06, 0.72);
  float window = square(max(1.0 - 6.0 * square(r.x + 0.3) - 5.0 * square(r.y - 0.5), 0.0));
  float lamp = max(1.0 - 10.0 * square(r.x - 0.65), 0.0);
  float horizon = max(1.0 - 16.0 * square(r.y + 0.15), 0.0);
  return above + window + 0.35 * lamp - 0.18 * horizon;
}
void main() {
  vec3 v = normalize(-seen);
  vec3 n = normalize(facing);
#ifdef CUT
  if (quarter.z > 0.5 && quarter.x > 0.0 && quarter.y > 0.0) discard;
#endif
  vec3 own = paint.rgb * paint.rgb;
  float lit = 0.30 + 0.16 * n.y + 0.62 * max(dot(n, KEY), 0.0) + 0.22 * max(dot(n, FILL), 0.0);
  vec3 light = own * lit * mix(1.22, 0.62, gloss);
  if (gloss > 0.1) { // else of ink, or of a dial
    float brush = step(0.25, dot(brushed, brushed));
    vec3 t = brush * normalize(brushed + vec3(1e-9));
    float rim = square(square(1.0 - max(dot(n, v), 0.0)));
    vec3 glint = mix(vec3(1.0), own * 1.9, 0.62) * (0.53 * sheen(n, v, t, KEY, brush) + 0.22 * sheen(n, v, t, FILL, brush) + 0.08 * rim);
    light += gloss * (glint + 0.66 * mix(own * 1.75, vec3(1.0), 0.08 + 0.5 * rim) * room(reflect(-v, n)));
  }
  light *= clamp(1.0 + 0.62 * deep / size, 0.62, 1.1); // what lies deeper is darker
  float most = max(light.r, max(light.g, light.b)); // what is too bright keeps its hue
  light *= most > 0.7 ? (1.0 - 0.09 / (most - 0.4)) / most : 1.0;
  colour = vec4(sqrt(light), paint.a);
}`;

// One who looks through the quarter into a body sees its back faces: as much of the picture as the face of the cut has.
const within = `
precision highp float;
uniform float size;
uniform vec3 section;
in vec3 facing, seen, quarter;
in float deep;
flat in vec2 reader;
out vec4 colour;
void main() {
  vec2 a = reader, b = quarter.xy, at = a / (a - b); // where the way from the reader goes in or out, as a part of the way
  vec2 low = mix(vec2(0.0), at, lessThanEqual(a, vec2(0.0))), high = mix(vec2(1.0), at, lessThanEqual(b, vec2(0.0)));
  bool through = all(greaterThan(max(a, b), vec2(0.0))) && max(low.x, low.y) < min(high.x, high.y);
  if (!through || all(greaterThan(b, vec2(0.0))) || dot(facing, -seen) > -0.1 * length(facing) * length(seen)) discard;
  colour = vec4(sqrt(section * clamp(1.0 + 0.62 * deep / size, 0.62, 1.1)), 1.0);
}`;

/**
 * Materials of opaque parts, of transparent parts, of parts that are cut open, and of their insides, which are seen where they are cut.
 *
 * count          number of bodies
 * main, middle   direction in which layers move in the exploded view, and the point that stays fixed
 * size           size of the train (mm)
 * quarter        quarter that can be cut out; null if there is none
 */
export function metals(count, main, middle, size, quarter) {
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
    ...(quarter && { edge: { value: quarter.at }, right: { value: quarter.right }, up: { value: quarter.up }, section: { value: new Color(SECTION) } }),
  };
  const material = (about) => new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: corner, fragmentShader: point, uniforms: shared, ...about });
  const [seen, ghosts, cut] = [{}, { transparent: true, depthWrite: false }, { defines: { CUT: "" } }].map(material);
  return [seen, ghosts, cut, material({ defines: { CUT: "" }, fragmentShader: within, side: BackSide })];
}

/** Shows transparent parts cut open, or whole. */
export function cutOpen([, ghosts], opened) {
  if (opened === "CUT" in ghosts.defines) return;
  ghosts.defines = opened ? { CUT: "" } : {};
  ghosts.needsUpdate = true;
}
