// What things are painted with where nobody says otherwise.

export const BROKEN = "#c2281d";
export const CHOSEN = "#1f6feb";
export const FADED = "#8a8d91";
export const BRASS = ["#b8924a", "#c8a564", "#a98144", "#bd9b5e", "#b08a3e", "#cdb074"];
export const PARTS = { arbor: "#8a8f98", arm: "#7d6b4a", pin: "#444b57", slot: "#6d7480", face: "#e9e2d0", mark: "#3a352b" };
export const NEEDLES = ["#1f2933", "#9b2915", "#1d4e89", "#3b7a57", "#6f4e7c", "#8a6d1b", "#2f6f73", "#a0522d"];
export const STATUS = { surviving: "#4f8a6d", reconstructed: "#c9973f", hypothetical: "#8f7fb8", "": "#9aa3ad" };

const mix = (one, other, share) =>
  `#${[1, 3, 5].map((at) => {
    const [a, b] = [one, other].map((hex) => parseInt(hex.slice(at, at + 2), 16));
    return Math.round(a + share * (b - a)).toString(16).padStart(2, "0");
  }).join("")}`;

/** Faster is stronger, on a logarithmic scale over six decades; blue for positive turns, orange for negative ones. */
export function speedColour(speed, fastest) {
  if (!speed) return "#9aa3ad";
  const share = 1 + Math.log10(Math.abs(speed) / fastest) / 6;
  return mix("#d5d8dc", speed > 0 ? "#1d5fa8" : "#c4570f", Math.min(1, Math.max(0.15, share)));
}

/** From none lost to the most lost. */
export const lossColour = (loss, most) => (loss === null ? "#9aa3ad" : mix("#dcd8cc", "#a31621", most ? loss / most : 0));

/** A colour by wheel in one of the modes. */
export function colours(scene, mode) {
  const speeds = scene.bodies.map((body) => (body.speed === null ? 0 : body.sense * ratio(body.speed)));
  const fastest = Math.max(...speeds.map(Math.abs), 1e-300);
  const most = Math.max(...scene.wheels.map((wheel) => wheel.loss ?? 0), 0);
  const ways = {
    speed: (wheel) => speedColour(speeds[wheel.body], fastest),
    status: (wheel) => STATUS[wheel.status] ?? STATUS[""],
    loss: (wheel) => lossColour(wheel.loss, most),
  };
  return scene.wheels.map(ways[mode] ?? ((wheel) => BRASS[wheel.body % BRASS.length]));
}

function ratio(text) {
  const [above, below = "1"] = text.split("/");
  return Number(above) / Number(below);
}
