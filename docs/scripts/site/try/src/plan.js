// Pitch circles in plan, carried and turned as their links are.
import { svg } from "./svg.js";

export function drawPlan(place, plan, turnsOf, clockwise) {
  const sense = clockwise ? -1 : 1;
  const wheels = plan.wheels.map((wheel) => {
    const circle = svg("circle", { class: wheel.ring ? "ring" : "wheel", r: wheel.radius });
    const mark = svg("line", { class: "mark", x1: wheel.ring ? wheel.radius : 0, y1: 0, x2: wheel.radius * (wheel.ring ? 1.06 : 1), y2: 0 });
    const name = svg("title", {}, `${wheel.wheel}, on ${wheel.link}`);
    return { wheel, group: svg("g", {}, name, circle, mark) };
  });
  // large ones below, so that small ones can be seen
  const upwards = [...wheels].sort((one, other) => other.wheel.radius - one.wheel.radius);
  const picture = svg("svg", { role: "img", "aria-label": "pitch circles in plan" }, ...upwards.map((each) => each.group));
  place.replaceChildren(picture);
  if (!wheels.length) return () => {};
  const reach = frame(plan);
  picture.setAttribute("viewBox", reach.box);
  picture.style.setProperty("--line", reach.size / 250);

  const angle = (link, turns) => 2 * Math.PI * sense * (((turnsOf[link] ?? 0) * turns) % 1);
  function at(axis, turns) {
    const pivot = plan.pivots[axis];
    if (pivot === undefined || pivot === axis) return plan.axes[axis];
    const [x, y] = at(pivot, turns);
    const [u, v] = [plan.axes[axis][0] - plan.axes[pivot][0], plan.axes[axis][1] - plan.axes[pivot][1]];
    const turn = angle(plan.bearers[axis], turns);
    return [x + u * Math.cos(turn) - v * Math.sin(turn), y + u * Math.sin(turn) + v * Math.cos(turn)];
  }
  return (turns) => {
    for (const { wheel, group } of wheels) {
      const [x, y] = at(wheel.axis, turns);
      group.setAttribute("transform", `translate(${x} ${-y}) rotate(${(-180 / Math.PI) * angle(wheel.link, turns)})`);
    }
  };
}

function frame(plan) {
  // what is carried sweeps a circle about its pivot
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const wheel of plan.wheels) {
    let [axis, out] = [wheel.axis, wheel.radius * 1.08];
    while (plan.pivots[axis] !== undefined && plan.pivots[axis] !== axis) {
      const pivot = plan.pivots[axis];
      out += Math.hypot(plan.axes[axis][0] - plan.axes[pivot][0], plan.axes[axis][1] - plan.axes[pivot][1]);
      axis = pivot;
    }
    const [x, y] = plan.axes[axis];
    [left, right] = [Math.min(left, x - out), Math.max(right, x + out)];
    [low, high] = [Math.min(low, -y - out), Math.max(high, -y + out)];
  }
  return { box: `${left} ${low} ${right - left} ${high - low}`, size: Math.max(right - left, high - low) };
}
