// Exact values that a click copies to the clipboard.
import { el } from "./element.js";
import { shown } from "./number.js";

/** Copies text to the clipboard; resolves to false if the browser does not permit it. */
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = el("textarea", { class: "unseen", "aria-hidden": "true" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

/** A button that shows an exact value and copies it; `say` announces the result. */
export function copyable(text, say) {
  const button = el(
    "button",
    { type: "button", class: "copy", title: `Copy ${text}`, "aria-label": `${text}, copy` },
    shown(text).split(/(?<=\/)/).flatMap((part) => [part, el("wbr")]), // a fraction may be broken after its bar
  );
  button.addEventListener("click", async (event) => {
    event.stopPropagation();
    const focus = document.activeElement;
    const done = await copy(text);
    if (focus instanceof HTMLElement) focus.focus({ preventScroll: true });
    button.classList.toggle("copied", done);
    say(done ? `${text} copied` : "the browser does not permit copying");
    setTimeout(() => button.classList.remove("copied"), 1200);
  });
  return button;
}
