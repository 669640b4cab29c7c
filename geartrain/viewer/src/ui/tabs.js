// Panels behind tabs: arrow keys move along them, as a reader of tabs expects.
import { el, fresh } from "./element.js";

export class Tabs {
  /** `panels`: [{name, node, onShow}] */
  constructor(panels, label) {
    this.panels = panels.map((panel) => {
      const [tab, page] = [fresh("tab"), fresh("page")];
      return {
        ...panel,
        tab: el(
          "button",
          { type: "button", role: "tab", id: tab, "aria-controls": page, onclick: () => this.show(panel.name) },
          panel.name,
        ),
        page: el("div", { role: "tabpanel", id: page, tabindex: 0, "aria-labelledby": tab, class: "page", "data-page": panel.name }, panel.node),
      };
    });
    const list = el(
      "div",
      { role: "tablist", "aria-label": label },
      this.panels.map((each) => each.tab),
    );
    list.addEventListener("keydown", (event) => this.#move(event));
    this.list = list;
    this.node = el(
      "div",
      { class: "tabs" },
      list,
      el(
        "div",
        { class: "pages" },
        this.panels.map((each) => each.page),
      ),
    );
    this.show(panels[0].name);
  }

  #move(event) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const index = this.panels.findIndex((each) => each.name === this.current);
    const last = this.panels.length - 1;
    const next = step ? (index + step + last + 1) % (last + 1) : { Home: 0, End: last }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.show(this.panels[next].name);
    this.panels[next].tab.focus();
  }

  show(name) {
    this.current = name;
    for (const each of this.panels) {
      const on = each.name === name;
      each.tab.setAttribute("aria-selected", String(on));
      each.tab.tabIndex = on ? 0 : -1;
      each.page.hidden = !on;
    }
    this.onShow?.(name);
  }
}
