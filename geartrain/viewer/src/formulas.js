// Speeds as exact functions of tooth counts, which come with the scene, and the scene of the same train with other counts.

import { Fraction } from "./fraction.js";
import { isParallel, vector } from "./space.js";

const POLE = { zero: false, carrier: null }; // a function without a value
const MOST = 10n ** 12n; // teeth of a wheel, as in a declaration
const PLAIN = { kind: "exact", why: "", transmissions: [], sources: [], steps: [], offsets: {}, period: null };

export class CountFormulas {
  /** scene   as declared; `scene.formulas` is that of `SceneFormulas.to_dict()` */
  constructor(scene) {
    this.scene = scene;
    this.given = scene.formulas;
    this.declared = this.given.wheels.map((_, at) => BigInt(scene.wheels[this.given.count.indexOf(at)].teeth));
    this.driven = Fraction.of(this.given.input);
  }

  /** Index of the tooth count of a wheel among the counts; null if it cannot be changed. */
  at(wheel) {
    return this.given.count[wheel];
  }

  /** Exact speeds of bodies and pointers for given counts, in the train's unit, null if undetermined; and conditions not satisfied. */
  solve(counts) {
    const broken = this.given.conditions.filter(({ formula, zero }) => isZero(formula, counts) !== zero);
    const found = this.given.formulas.map((formula) => quotient(formula, counts));
    if (found.includes(null) && !broken.length) broken.push(POLE);
    const values = broken.length ? found.map(() => null) : found;
    const of = (index) => (index === null ? null : values[index]);
    return { bodies: this.given.bodies.map(of), pointers: this.given.pointers.map(of), broken };
  }

  /** The scene with other counts: speeds from the formulas, wheels with their declared modules, mean motion. */
  changed(counts) {
    const { scene } = this;
    const { bodies, pointers, broken } = this.solve(counts);
    const [profiles, wheels] = this.#wheels(counts);
    const stands = broken.length > 0 || scene.movement.kind === "still";
    return {
      ...scene,
      bodies: scene.bodies.map((body, at) => (body.parent === null ? body : { ...body, ...this.#told(bodies[at]) })),
      pointers: scene.pointers.map((pointer, at) => ({ ...pointer, ...this.#told(pointers[at]), text: asRead(pointer.sense, pointers[at]) })),
      wheels: phased(scene, wheels),
      profiles,
      pairs: scene.pairs.map((pair) => ({ ...pair, text: restated(pair, scene.wheels, wheels) })),
      movement: { ...PLAIN, kind: stands ? "still" : "mean", why: stands ? "" : MEAN },
      back: null,
      verdict: broken.length ? verdictOf(scene, broken) : scene.verdict,
      changed: true,
    };
  }

  #told(speed) {
    if (speed === null) return { speed: null, shown: null, decimal: "" };
    const text = decimals(speed);
    return { speed: speed.over(this.driven).toString(), shown: this.given.exact ? speed.toString() : text, decimal: text };
  }

  /** Profiles and wheels of the scene with other counts and unchanged modules. */
  #wheels(counts) {
    const profiles = [...this.scene.profiles];
    const wheels = this.scene.wheels.map((wheel, index) => {
      const at = this.at(index);
      const teeth = at === null ? wheel.teeth : Number(counts[at]);
      if (teeth === wheel.teeth) return wheel;
      if (wheel.kind === "worm") return { ...wheel, teeth };
      const factor = teeth / wheel.teeth;
      const { points, ...profile } = profiles[wheel.profile];
      // a tooth keeps its size, so its angle and relative radius change
      profiles.push({ ...profile, points: points.map(([radius, angle]) => [1 + (radius - 1) / factor, angle / factor]) });
      const [radius, tip, root] = [factor * wheel.radius, wheel.tip, wheel.root];
      const off = radius - wheel.radius;
      return { ...wheel, teeth, radius, tip: tip + off, root: root + off, profile: profiles.length - 1 };
    });
    return [profiles, wheels];
  }

  /**
   * Misfit of each pair with its axes: {pair, off, apart, module}. `off` is the exact change of the axis distance that the
   * pair requires, in modules; `apart` is that of skew axes, in mm as drawn; both are null for intersecting axes.
   */
  meshes(counts) {
    const { scene } = this;
    const now = (wheel) => (this.at(wheel) === null ? BigInt(scene.wheels[wheel].teeth) : counts[this.at(wheel)]);
    return scene.pairs.map((pair) => {
      const [one, other] = pair.wheels.map((index) => scene.wheels[index]);
      const grown = pair.wheels.map((index) => now(index) - BigInt(scene.wheels[index].teeth));
      const module = (2 * one.radius) / one.teeth;
      if (!grown[0] && !grown[1]) return { pair, off: Fraction.of(0), module };
      const worm = [one, other].findIndex(({ kind }) => kind === "worm");
      if (worm >= 0) return { pair, off: new Fraction(grown[1 - worm], 2n), module: (2 * [other, one][worm].radius) / [other, one][worm].teeth };
      if (!isParallel(one.direction, other.direction)) return { pair, off: null, apart: skewed(one, other) ? this.#apart(pair, grown) : null };
      const ring = [one, other].findIndex(({ kind }) => kind === "ring");
      const sum = ring < 0 ? grown[0] + grown[1] : grown[ring] - grown[1 - ring];
      return { pair, off: new Fraction(sum, 2n), module };
    });
  }

  /** Change of the distance of two skew axes that a pair requires (mm as drawn). */
  #apart({ wheels }, grown) {
    return wheels.reduce((sum, index, k) => sum + (Number(grown[k]) * this.scene.wheels[index].radius) / this.scene.wheels[index].teeth, 0);
  }
}

const skewed = (...wheels) => wheels.every(({ cone, kind }) => !cone && kind !== "contrate");
export const MEAN = "The motion of teeth and pins was computed only for the declared counts, so mean motion is shown.";

/** A valid tooth count from a number or text; null for other values. */
export function countOf(value) {
  const text = String(value).trim();
  const count = /^\d{1,13}$/.test(text) ? BigInt(text) : 0n;
  return count > 0n && count <= MOST ? count : null;
}

function total(terms, wheels, counts) {
  let sum = 0n;
  for (const [coefficient, powers] of terms) {
    let product = BigInt(coefficient);
    powers.forEach((power, k) => (product *= counts[wheels[k]] ** BigInt(power)));
    sum += product;
  }
  return sum;
}

function quotient({ wheels, numerator, denominator }, counts) {
  const below = total(denominator, wheels, counts);
  return below === 0n ? null : new Fraction(total(numerator, wheels, counts), below);
}

const isZero = ({ wheels, numerator }, counts) => total(numerator, wheels, counts) === 0n;

/** Ten significant digits, without trailing zeros. */
export function decimals(value) {
  const [digits, power] = Number(value).toPrecision(10).split("e");
  const short = digits.includes(".") ? digits.replace(/\.?0+$/, "") : digits;
  return power ? `${short}e${power}` : short;
}

function asRead(sense, speed) {
  if (speed === null) return "";
  if (speed.numerator === 0n) return "at rest";
  return `${speed.numerator > 0n === sense > 0 ? "clockwise" : "counter-clockwise"} as read`;
}

/** The verdict if the formulas do not hold; for a loop that no longer closes, with the parts that it locks. */
function verdictOf(scene, broken) {
  const still = ({ carrier }) => carrier !== null && scene.bodies[carrier].parent === null;
  const said = broken.map((condition) => {
    const { text, zero, carrier } = condition;
    if (!zero) return "with these counts the train is locked or free";
    if (carrier === null) return `no longer satisfied: ${text}`;
    const held = still(condition) ? "lock each other" : `can only turn with ${scene.bodies[carrier].id} as one body`;
    return `${text.replace(/ closes$/, "")} no longer closes: its wheels ${held}`;
  });
  const kind = broken.some(still) ? "locked" : "not determined";
  return { kind, text: `${[...new Set(said)].join("; ")}. Save the train and run \`geartrain solve\` to see which links still turn.`, links: [], loops: [], advice: [] };
}

/** The equation of a circuit with other counts, if its coefficients are the counts. */
function restated({ text, wheels }, before, after) {
  let at = 0;
  return text.replace(/(?<= [+-] |^)(\d+) \(/g, (whole, count) => {
    const index = wheels[at++];
    return index !== undefined && Number(count) === before[index].teeth ? `${after[index].teeth} (` : whole;
  });
}

/** Wheels rotated on their arbors so that teeth mesh, along all pairs connected with a changed wheel. */
function phased(scene, wheels) {
  const turned = [...wheels];
  const near = wheels.map(() => []);
  scene.pairs.forEach(({ wheels: [one, other] }) => {
    near[one].push(other);
    near[other].push(one);
  });
  const met = new Set();
  wheels.forEach((wheel, from) => {
    if (met.has(from)) return;
    const group = [from];
    met.add(from);
    for (const index of group) for (const mate of near[index]) if (!met.has(mate)) group.push((met.add(mate), mate));
    if (group.every((index) => wheels[index] === scene.wheels[index])) return;
    const placed = new Set([from]);
    for (const index of group) {
      for (const mate of near[index]) {
        if (placed.has(mate)) continue;
        placed.add(mate);
        turned[mate] = engaged(turned[mate], turned[index]);
      }
    }
  });
  return turned;
}

/** A wheel rotated so that its teeth mesh with those of another wheel, if both axes are parallel. */
function engaged(wheel, other) {
  const between = vector(other.centre).sub(vector(wheel.centre));
  const axis = vector(wheel.direction);
  between.addScaledVector(axis, -between.dot(axis));
  if (!isParallel(wheel.direction, other.direction) || between.length() < 1e-9) return wheel;
  const inside = wheel.kind === "ring" || other.kind === "ring";
  const towards = between.normalize().multiplyScalar(other.kind === "ring" ? -1 : 1);
  const across = inside ? towards : towards.clone().negate();
  const same = axis.dot(vector(other.direction)) > 0 ? 1 : -1;
  // positions of teeth relative to the pitch point, in pitches along a common tangent
  const theirs = (inside ? same : -same) * place(other, across);
  const wanted = theirs + 0.5;
  return { ...wheel, turn: angleTo(wheel, towards) + (2 * Math.PI * wanted) / wheel.teeth };
}

const place = (wheel, towards) => ((wheel.turn - angleTo(wheel, towards)) * wheel.teeth) / (2 * Math.PI);

/** The angle of a direction about a wheel's axis, from its reference (rad). */
function angleTo({ direction, reference }, towards) {
  const x = vector(reference);
  return Math.atan2(vector(direction).cross(x).dot(towards), x.dot(towards));
}
