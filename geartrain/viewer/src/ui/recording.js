// Records the canvas as a film and saves it to a file.
import { el, icon } from "./element.js";
import { fileName, saveAs } from "./saving.js";

const RATE = 30; // maximum number of pictures per second
const START = "M12 5a7 7 0 1 0 0 14a7 7 0 0 0 0-14z";
const STOP = "M6 6h12v12H6z";
const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** The film format that this browser records; null if it records none. */
function filmType() {
  if (!HTMLCanvasElement.prototype.captureStream || !globalThis.MediaRecorder) return null;
  return TYPES.find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

/** A button that starts and stops; each side's canvas becomes one film. */
export class Recording {
  constructor() {
    this.type = filmType();
    this.recorders = [];
    this.node = el("button", { type: "button", class: "record", "aria-label": "Record film", "aria-pressed": "false", title: "Record film", onclick: () => this.toggle() });
    this.use([]);
  }

  /** Sets the displayed sides, and ends recordings of others. */
  use(sides) {
    this.stop();
    this.sides = sides.filter(({ stage }) => stage?.renderer);
    this.node.hidden = !this.type || !this.sides.length;
  }

  toggle() {
    if (this.recorders.length) this.stop();
    else this.start();
  }

  start() {
    this.recorders = this.sides.map((side) => this.#record(side));
    this.#show(true);
  }

  #record({ scene, stage }) {
    const stream = stage.canvas.captureStream(RATE);
    const recorder = new MediaRecorder(stream, { mimeType: this.type });
    const parts = [];
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    recorder.addEventListener("stop", () => {
      for (const track of stream.getTracks()) track.stop();
      saveAs(new Blob(parts, { type: "video/webm" }), fileName([scene.name, scene.state], "webm"));
    });
    recorder.start();
    stage.request(); // a canvas that is not redrawn gives no picture
    return recorder;
  }

  stop() {
    for (const recorder of this.recorders) {
      if (recorder.state !== "inactive") recorder.stop();
    }
    this.recorders = [];
    this.#show(false);
  }

  #show(recording) {
    this.node.setAttribute("aria-pressed", String(recording));
    this.node.replaceChildren(icon(recording ? STOP : START));
  }
}
