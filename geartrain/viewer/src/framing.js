// Camera position for which the visible parts fill the picture.

import { vector } from "./space.js";

/**
 * Target point and distance of the camera.
 *
 * points       points that must be visible
 * towards      unit vector from the target to the camera; `above`: upward direction of the picture
 * wide, high   tangents of half the field of view, horizontally and vertically
 */
export function frame(points, towards, above, wide, high) {
  const right = vector(above).cross(towards);
  if (right.length() < 1e-6) right.set(1, 0, 0); // seen from above
  right.normalize();
  const up = towards.clone().cross(right);
  // a point (x, z) is in the field of view of a camera at x = c and distance d if |x - c| <= (d - z) wide
  const fit = (axis, slope) => {
    const most = (sign) => Math.max(...points.map((point) => sign * point.dot(axis) + slope * point.dot(towards)));
    const [over, under] = [most(1), most(-1)];
    return { middle: (over - under) / 2, away: (over + under) / (2 * slope) };
  };
  const [across, upwards] = [fit(right, wide), fit(up, high)];
  const target = right.multiplyScalar(across.middle).addScaledVector(up, upwards.middle);
  const depth = points.map((point) => point.dot(towards));
  const middle = (Math.min(...depth) + Math.max(...depth)) / 2;
  return { target: target.addScaledVector(towards, middle), distance: Math.max(across.away, upwards.away) - middle };
}
