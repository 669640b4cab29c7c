// The picture of the page's diagram, with the numbers under it, as SVG that stands alone.
([style, line]) => {
  const picture = document.querySelector(".gd-picture").cloneNode(true);
  const rows = [...document.querySelectorAll(".gd-reading tr")].map((row) => [...row.cells].map((cell) => cell.textContent));
  const [, , wide, high] = picture.getAttribute("viewBox").split(" ").map(Number);
  const make = (tag, attributes, text = "") => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    node.textContent = text;
    return node;
  };
  rows.forEach((cells, row) =>
    cells.forEach((text, n) => {
      // names from the left edge on, numbers to their column's right: what is long has the whole width between
      const [x, y] = [wide * (0.08 + (0.84 * n) / (cells.length - 1)), high + line * (row + 1)];
      picture.append(make("text", { x, y, "text-anchor": n ? "end" : "start", class: "gd-text" }, text));
    }),
  );
  const whole = high + line * (rows.length + 0.7);
  picture.prepend(make("style", {}, style), make("rect", { width: wide, height: whole, fill: "var(--gd-paper)" }));
  for (const part of picture.querySelectorAll(".gd-handle")) {
    const said = [...part.attributes].map(({ name }) => name).filter((name) => /^(aria-.*|role|tabindex)$/.test(name));
    for (const name of said) part.removeAttribute(name);
  }
  for (const [name, value] of Object.entries({ viewBox: `0 0 ${wide} ${whole}`, width: wide, height: whole, role: "img" })) {
    picture.setAttribute(name, value);
  }
  return new XMLSerializer().serializeToString(picture);
}
