// The page to try it on: an editor, and beside it what Python answers at each pause in typing.
import { autocompletion } from "@codemirror/autocomplete";
import { yaml } from "@codemirror/lang-yaml";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { tags } from "@lezer/highlight";
import { basicSetup, EditorView } from "codemirror";
import { options } from "./completion.js";
import { drawDials } from "./dials.js";
import { drawPlan } from "./plan.js";
import { packed, unpacked } from "./share.js";
import { html } from "./svg.js";

const PAUSE = 350; // ms without a key before Python is asked
const PATIENCE = 20000; // ms after which an answer is given up
const RATE = 0.1; // turns of the input a second, while the crank turns by itself

const here = new URL(".", import.meta.url);
const root = document.getElementById("try");
const part = (name) => root.querySelector(`.${name}`);
const names = { links: [], wheels: [] };
let schema = { properties: {} };
let worker = null;
let ready = false;
let asked = 0;
let waiting = null; // the timer of the answer under way
let shown = null;
let turned = () => {};
let angle = 0; // of the crank, in turns; the slider keeps hundredths

// ------------------------------------------------------------------------------------------------------------ editor

function complete(context) {
  const found = options(schema, names, context.state.sliceDoc(0, context.pos));
  if (!context.explicit && found.word === "") return null;
  return { from: context.pos - found.word.length, options: found.options, validFor: /^[\w.-]*$/ };
}

// the site's own colours, which are other ones in the dark
const colours = HighlightStyle.define([
  { tag: [tags.definition(tags.propertyName), tags.propertyName], color: "var(--md-code-hl-keyword-color)" },
  { tag: tags.comment, color: "var(--md-code-hl-comment-color)" },
  { tag: tags.string, color: "var(--md-code-hl-string-color)" },
]);

let pause = 0;
const editor = new EditorView({
  parent: part("editor"),
  extensions: [
    basicSetup,
    yaml(),
    syntaxHighlighting(colours),
    lintGutter(),
    autocompletion({ override: [complete] }),
    EditorView.contentAttributes.of({ "aria-label": "Declaration of a train" }),
    EditorView.updateListener.of((update) => {
      if (!update.docChanged) return;
      clearTimeout(pause);
      pause = setTimeout(ask, PAUSE);
    }),
  ],
});

function write(text) {
  editor.dispatch({ changes: { from: 0, to: editor.state.doc.length, insert: text } });
}

function underline(problems) {
  const { doc } = editor.state;
  const marks = problems
    .filter((each) => each.line >= 1 && each.line <= doc.lines)
    .map((each) => {
      const line = doc.line(each.line);
      const from = line.from + line.text.match(/^\s*/)[0].length;
      const message = [each.what, each.why, each.fix].filter(Boolean).join("\n");
      return { from, to: Math.max(line.to, from), severity: each.level === "error" ? "error" : "info", message };
    });
  editor.dispatch(setDiagnostics(editor.state, marks));
}

// ------------------------------------------------------------------------------------------------------------ Python

function begin() {
  ready = false;
  worker = new Worker(new URL("worker.js", here), { type: "module" });
  worker.onmessage = ({ data }) => {
    if (data.kind === "progress") progress(data);
    if (data.kind === "failed") fail(data.why);
    if (data.kind === "ready") {
      [ready, schema] = [true, data.schema];
      part("progress").hidden = true;
      ask();
    }
    if (data.kind === "answer") answered(data);
  };
  worker.onerror = (error) => fail(error.message || "the worker could not be started");
}

function progress({ stage, part: share }) {
  const percent = Math.round(90 * share) + (stage === "starting" ? 8 : 0);
  part("bar").value = percent;
  part("stage").textContent = stage === "fetching" ? `fetching Python, ${Math.round(100 * share)} %` : "starting Python";
}

function fail(why) {
  const disk = location.protocol === "file:" ? " A browser starts no worker from disk: serve the folder, for example by python -m http.server." : "";
  part("stage").textContent = `Python does not start here: ${why}.${disk}`;
}

function ask() {
  if (!ready) return;
  const id = ++asked;
  part("verdict").classList.add("waiting");
  clearTimeout(waiting);
  waiting = setTimeout(giveUp, PATIENCE);
  worker.postMessage({ id, text: editor.state.doc.toString() });
}

function giveUp() {
  worker.terminate();
  tell(`No answer in ${PATIENCE / 1000} s: Python is started anew, and asked again when the text changes.`, "bad");
  begin();
}

function answered({ id, found }) {
  if (id !== asked) return; // a newer text is under way
  clearTimeout(waiting);
  underline(found.problems);
  tell(found.verdict, found.sound ? "good" : "bad");
  part("problems").replaceChildren(
    ...found.problems.map((each) => {
      const place = each.line ? `line ${each.line}: ` : "";
      const more = [each.why, each.fix].filter(Boolean).map((text) => html("div", {}, text));
      return html("li", { class: each.level }, place + each.what, ...more);
    }),
  );
  part("left-out").textContent = found.left_out ?? "";
  part("results").classList.toggle("stale", !found.page);
  if (!found.page) return;
  [names.links, names.wheels] = [found.links, found.wheels];
  [shown] = [found];
  offerStates(found.states);
  draw();
  report(found.page);
}

function tell(text, kind) {
  part("verdict").textContent = text;
  part("verdict").className = `verdict ${kind}`;
}

// ------------------------------------------------------------------------------------------------------------ answers

function offerStates(states) {
  const chosen = part("state").value;
  part("state").replaceChildren(...states.map((each) => html("option", { value: each.name }, each.name)));
  if (states.some((each) => each.name === chosen)) part("state").value = chosen;
  part("states").hidden = states.length < 2;
}

function draw() {
  const state = shown.states.find((each) => each.name === part("state").value) ?? shown.states[0];
  const dials = drawDials(part("dials"), state, shown.clockwise);
  const plan = drawPlan(part("plan"), shown.plan, state.turns, shown.clockwise);
  part("unit").textContent = shown.unit ? `in ${shown.unit}` : "numbers without a unit";
  part("sense").textContent = shown.clockwise ? "clockwise" : "counter-clockwise";
  part("lead").textContent = state.lead ? `turns of ${state.lead}` : "turns";
  turned = (turns) => {
    dials(turns);
    plan(turns);
  };
  crank(angle);
}

function crank(turns) {
  angle = turns;
  part("turns").value = turns;
  part("count").textContent = turns.toFixed(2);
  turned(turns);
}

let from = null;
function play(now) {
  const on = part("play").getAttribute("aria-pressed") === "true";
  if (on && from !== null) crank((angle + (RATE * (now - from)) / 1000) % Number(part("turns").max));
  from = on ? now : null;
  if (on) requestAnimationFrame(play);
}

function report(page) {
  // without scripts, and scrolled to where the one before it was
  const old = part("page").querySelector("iframe");
  const fresh = html("iframe", { title: "Report", sandbox: "allow-same-origin", srcdoc: page });
  fresh.addEventListener("load", () => {
    fresh.contentWindow.scrollTo(0, old?.contentWindow?.scrollY ?? 0);
    old?.remove();
    fresh.classList.remove("coming");
  });
  fresh.className = "coming";
  part("page").append(fresh);
}

// ------------------------------------------------------------------------------------------------------------ buttons

let trains = null;
async function example(name) {
  trains ??= await (await fetch(new URL("examples.json", here))).json();
  if (part("example").options.length < 2)
    for (const [folder, group] of Object.entries(Object.groupBy(Object.entries(trains), ([, each]) => each.folder)))
      part("example").append(html("optgroup", { label: folder }, ...group.map(([key, each]) => html("option", { value: key, title: each.title }, key))));
  if (name in trains) {
    part("example").value = name;
    write(trains[name].text);
  }
}

part("example").addEventListener("change", (event) => {
  history.replaceState(null, "", `#train=${encodeURIComponent(event.target.value)}`);
  example(event.target.value);
});
part("state").addEventListener("change", draw);
part("turns").addEventListener("input", (event) => crank(Number(event.target.value)));
part("play").addEventListener("click", () => {
  const on = part("play").getAttribute("aria-pressed") !== "true";
  part("play").setAttribute("aria-pressed", String(on));
  if (on) requestAnimationFrame(play);
});
part("share").addEventListener("click", async () => {
  history.replaceState(null, "", `#text=${await packed(editor.state.doc.toString())}`);
  try {
    await navigator.clipboard.writeText(location.href);
    part("share").textContent = "Address copied";
  } catch {
    part("share").textContent = "It is in the address bar";
  }
  setTimeout(() => (part("share").textContent = "Share"), 2500);
});

async function open() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const text = asked.get("text");
  if (text) {
    try {
      write(await unpacked(text));
      await example("");
      return;
    } catch {
      tell("The address does not hold a whole text; it may have been cut.", "bad");
    }
  }
  await example(asked.get("train") ?? "planetary-24-18-60");
}

addEventListener("hashchange", open);
document.getElementById("try-absent").remove();
root.hidden = false;
open().then(begin, (error) => fail(error.message));
