"use strict";
(() => {
  const said = document.getElementById("said");

  // the content of a cell becomes a button, so that it can be reached with the keyboard
  const button = (cell, label, act) => {
    const made = document.createElement("button");
    made.type = "button";
    made.title = label;
    made.append(...cell.childNodes);
    made.addEventListener("click", act);
    cell.append(made);
    return made;
  };

  // returns a number as an exact fraction of two integers, or null if the text is not a number
  const number = (text) => {
    const found = /^([+\-−~]?)(\d+)(?:\.(\d*))?(?:e([+-]?\d+))?(?:\/(\d+))?(?![\w.])/.exec(text.trim());
    if (!found) return null;
    const [, sign, whole, part = "", power = "0", below = "1"] = found;
    if (Math.abs(Number(power)) > 10000 || BigInt(below) === 0n) return null;
    const shift = Number(power) - part.length;
    const size = BigInt(whole + part) * (sign === "-" || sign === "−" ? -1n : 1n);
    return shift < 0 ? [size, BigInt(below) * 10n ** BigInt(-shift)] : [size * 10n ** BigInt(shift), BigInt(below)];
  };

  const key = (cell) => {
    const text = cell.dataset.exact ?? cell.textContent;
    const ratio = /^1 : (.*)$/.exec(text.trim()); // 1 : n means 1/n
    const value = number(ratio ? ratio[1] : text);
    const turned = ratio && value && value[0] !== 0n;
    return { text, value: turned ? (value[0] < 0n ? [-value[1], -value[0]] : [value[1], value[0]]) : value };
  };

  // orders numbers by value, then words; empty cells are last in both directions
  const compare = (a, b, way) => {
    if (a.value && b.value) {
      const difference = a.value[0] * b.value[1] - b.value[0] * a.value[1];
      return way * (difference > 0n ? 1 : difference < 0n ? -1 : 0);
    }
    const rank = ({ text, value }) => (value ? 0 : /^(-|)$/.test(text.trim()) ? 2 : 1);
    if (rank(a) !== rank(b)) return rank(a) - rank(b);
    return way * a.text.localeCompare(b.text, "en", { numeric: true });
  };

  const sort = (table, column, head) => {
    const way = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", way === 1 ? "ascending" : "descending");
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => ({ row, key: key(row.cells[column]) }));
    rows.sort((a, b) => compare(a.key, b.key, way));
    body.append(...rows.map(({ row }) => row));
  };

  for (const table of document.querySelectorAll("table.sortable")) {
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      button(head, "Sort by this column", () => sort(table, column, head));
    });
  }

  const copied = (text) => {
    const area = document.createElement("textarea"); // fallback where scripts cannot access the clipboard
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  };

  const copy = async (text) => {
    let done = true;
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      done = copied(text);
    }
    said.textContent = done ? `Copied ${text.length > 60 ? `${text.slice(0, 60)}…` : text}` : "The browser does not allow copying";
    said.classList.add("shown");
    setTimeout(() => said.classList.remove("shown"), 2000);
  };

  // name the wanted scene as the first and reload the frame
  const turn = (frame, number) => {
    frame.dataset.given ??= frame.srcdoc;
    const inner = new DOMParser().parseFromString(frame.dataset.given, "text/html");
    inner.getElementById("scenes").dataset.first = number - 1;
    frame.srcdoc = `<!DOCTYPE html>${inner.documentElement.outerHTML}`;
    frame.scrollIntoView({ block: "nearest" });
  };

  for (const text of document.querySelectorAll("[data-scene]")) {
    const frame = text.closest("article").querySelector("section.viewer iframe");
    if (frame) button(text, "Show the animation", () => turn(frame, Number(text.dataset.scene)));
  }

  for (const cell of document.querySelectorAll("[data-exact]")) {
    button(cell, "Copy the exact value", () => copy(cell.dataset.exact));
  }

  // a link of the contents opens the section it leads to
  addEventListener("hashchange", () => {
    const folded = document.getElementById(location.hash.slice(1))?.querySelector("details");
    if (folded) folded.open = true;
  });
})();
