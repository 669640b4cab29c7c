// Diagrams within the pages of the documentation: `<gear-diagram kind="...">` with its data and a still in it.

import { circuits } from "./circuits.js";
import { closure } from "./closure.js";
import { differential } from "./differential.js";
import { locking } from "./locking.js";
import { pin } from "./pin.js";
import { teeth } from "./teeth.js";
import { willis } from "./willis.js";

const KINDS = { circuits, closure, differential, locking, pin, teeth, willis };

class GearDiagram extends HTMLElement {
  connectedCallback() {
    if (this.classList.contains("gd-alive")) return;
    const data = JSON.parse(this.querySelector("script[type='application/json']").textContent);
    KINDS[this.getAttribute("kind")](this, data);
    this.classList.add("gd-alive"); // hides the static picture
  }
}

customElements.define("gear-diagram", GearDiagram);
