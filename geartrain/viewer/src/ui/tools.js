// Tools of the picture: view, colours, exploded view.
import { MODES, legend } from "./colours.js";
import { el, field } from "./element.js";
import { Recording } from "./recording.js";
import { savePicture } from "./saving.js";

const SMALL = "(max-width: 820px), (max-height: 520px)"; // as in page.css
const LOOKS = { front: "Front", back: "Back", side: "Side", free: "Free" };

export class Tools {
  constructor(options) {
    this.sides = [];
    this.mode = "plain";
    this.looking = "free";
    this.looks = Object.entries(LOOKS).map(([look, name]) =>
      el(
        "button",
        { type: "button", "data-look": look, "aria-pressed": "false", onclick: () => this.look(look) },
        name,
      ),
    );
    this.colour = el(
      "select",
      { "aria-label": "Colours", onchange: () => this.paint(this.colour.value) },
      Object.entries(MODES).map(([mode, name]) => el("option", { value: mode }, name)),
    );
    this.apart = el("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0, oninput: () => this.#explode() });
    this.front = el("input", {
      type: "checkbox",
      onchange: () => this.#each((stage) => stage.hideFront(this.front.checked)),
    });
    this.teeth = el("input", {
      type: "checkbox",
      onchange: () => this.#each((stage) => stage.showTeeth(this.teeth.checked)),
    });
    this.open = el("input", {
      type: "checkbox",
      onchange: () => this.#cut((this.wanted = this.open.checked)),
    });
    this.names = el("input", { type: "checkbox", onchange: () => this.#name() });
    this.status = el("button", { type: "button", "aria-pressed": "false", onclick: () => this.paint(this.mode === "status" ? "plain" : "status") }, "Status");
    this.opening = field("Cut open", this.open, { class: "field tick" });
    this.recording = new Recording();
    this.teeth.checked = options?.teeth !== false;
    this.row = el(
      "div",
      { class: "tools", role: "group", "aria-label": "picture" },
      el("div", { class: "group", role: "group", "aria-label": "view from" }, this.looks),
      this.colour,
      this.status,
      field("Apart", this.apart),
      field("Hide front", this.front, { class: "field tick" }),
      field("Names", this.names, { class: "field tick" }),
      field("Teeth", this.teeth, { class: "field tick" }),
      this.opening,
    );
    this.files = el(
      "div",
      { class: "group", role: "group", "aria-label": "files" },
      el("button", { type: "button", class: "save", "aria-label": "Save picture", onclick: () => savePicture(this.sides) }, "Save"),
      this.recording.node,
    );
    this.node = el("details", { class: "fold" }, el("summary", {}, "Picture"), this.row);
    this.small = matchMedia(SMALL);
    this.names.checked = !this.small.matches;
    this.#asRoomIs(() => (this.node.open = !this.small.matches)); // on wide pages the tools are always open
  }

  #asRoomIs(act) {
    this.small.addEventListener("change", act);
    act();
  }

  /** Places rarely used controls in the head on wide pages, else among the tools. */
  lodge(place, seldom) {
    this.#asRoomIs(() => (this.small.matches ? this.row : place).append(this.files, ...seldom));
  }

  /** Sets the displayed sides, and applies the controls to their pictures. */
  use(sides) {
    this.sides = sides;
    this.recording.use(sides);
    const stages = sides.flatMap(({ stage }) => stage ?? []);
    this.opening.hidden = !stages.some((stage) => stage.canOpen);
    this.open.checked = this.wanted ?? stages.some((stage) => stage.world?.opened);
    this.#each((stage) => {
      stage.onOrbit = () => this.#press(null);
      stage.hideFront(this.front.checked);
      stage.showTeeth(this.teeth.checked);
    });
    this.status.hidden = !sides.some(({ scene }) => scene.wheels.some(({ status }) => status));
    this.#name();
    if (this.wanted !== undefined) this.#cut(this.wanted);
    this.#explode();
    this.look(this.looking);
    this.paint(this.mode);
  }

  /** Applies the controls to a new picture; the viewing direction is kept. */
  dress(side, stage) {
    stage.hideFront(this.front.checked);
    stage.showTeeth(this.teeth.checked);
    stage.explode(Number(this.apart.value));
    stage.paint(this.mode);
    side.legend.replaceChildren(legend(side.scene, this.mode));
  }

  /** Marks the button of the viewing direction; none after the user has turned the picture. */
  #press(look) {
    for (const each of this.looks) each.setAttribute("aria-pressed", String(each.dataset.look === look));
  }

  #each(act) {
    for (const side of this.sides) {
      if (side.stage) act(side.stage);
    }
  }

  #name() {
    for (const { callouts } of this.sides) callouts?.show(this.names.checked);
  }

  #cut(opened) {
    this.#each((stage) => stage.cutOpen?.(opened));
  }

  #explode() {
    this.apart.setAttribute("aria-valuetext", `${Math.round(this.apart.value * 100)} %`);
    this.#each((stage) => stage.explode(Number(this.apart.value)));
  }

  look(look) {
    this.looking = look;
    this.#press(look);
    this.#each((stage) => stage.look(look));
  }

  paint(mode) {
    this.mode = mode;
    this.colour.value = mode;
    this.status.setAttribute("aria-pressed", String(mode === "status"));
    for (const side of this.sides) side.legend.replaceChildren(legend(side.scene, mode));
    this.#each((stage) => stage.paint(mode));
  }

  /** Selects the next colours. */
  next() {
    const modes = Object.keys(MODES);
    this.paint(modes[(modes.indexOf(this.mode) + 1) % modes.length]);
  }

  toggle(control) {
    control.checked = !control.checked;
    control.dispatchEvent(new Event("change"));
  }

  /** Puts all parts together. */
  assemble() {
    this.apart.value = 0;
    this.#explode();
  }

  takeApart() {
    this.apart.value = Number(this.apart.value) > 0 ? 0 : 1;
    this.#explode();
  }
}
