// Light or dark theme: that of the system unless the user selects one.
import { el } from "./element.js";

const NAMES = { system: "System", light: "Light", dark: "Dark" };

export class Theme {
  /** `onChange(background)`: the colour behind the pictures */
  constructor(onChange) {
    this.onChange = onChange;
    this.system = matchMedia("(prefers-color-scheme: dark)");
    this.system.addEventListener("change", () => this.apply());
    this.select = el(
      "select",
      { "aria-label": "theme", onchange: () => this.apply() },
      Object.entries(NAMES).map(([value, name]) => el("option", { value }, name)),
    );
  }

  apply() {
    const chosen = this.select.value;
    const dark = chosen === "dark" || (chosen === "system" && this.system.matches);
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.onChange(this.background);
  }

  get background() {
    return getComputedStyle(document.documentElement).getPropertyValue("--stage").trim();
  }
}
