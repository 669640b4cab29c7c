// Wheels of a scene in plan: all teeth of a wheel as one path.

import { svg } from "../ui/element.js";
import { simplify } from "../tooth.js";

const TURN = 2 * Math.PI;

/** Corners of a path, rounded so that pages stay small. */
export const path = (points) => `M${points.map(([x, y]) => `${+x.toFixed(3)} ${+y.toFixed(3)}`).join("L")}Z`;

const circle = (radius) => `M${radius} 0A${radius} ${radius} 0 1 0 ${-radius} 0A${radius} ${radius} 0 1 0 ${radius} 0Z`;

/** Outer radius of a ring (mm), as drawn. */
export const rimOf = ({ root, module }) => root + 2 * module;

/** All teeth of a wheel about the origin; `radii` and angles of one tooth's corners as in `ToothProfile`. */
export function teeth({ kind, teeth: count, radius, turn }, { points }) {
  const tooth = simplify(points, undefined, kind === "ring" ? -1 : 1);
  return Array.from({ length: count }, (_, n) =>
    tooth.slice(1).map(([r, angle]) => {
      const at = turn + angle + (TURN * n) / count;
      return [r * radius * Math.cos(at), r * radius * Math.sin(at)];
    }),
  ).flat();
}

/** Path of a wheel about the origin, in the zero pose of the scene. */
export function wheelPath(wheel, profile) {
  const edge = path(teeth(wheel, profile));
  return svg("path", {
    d: wheel.kind === "ring" ? circle(rimOf(wheel)) + edge : edge + (wheel.radius > 6 * wheel.module ? circle(2 * wheel.module) : ""),
    "fill-rule": "evenodd",
    class: "gd-wheel",
  });
}
