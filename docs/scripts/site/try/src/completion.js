// What can stand where the cursor is, by the schema of a declaration.

// The keys that lead to the end of a text, whether a key or a value is to come, and what of it stands already.
export function yamlPath(text) {
  const stack = [];
  let flow = [];
  let word = "";
  let atValue = false;
  for (const [indent, line] of lines(text)) {
    let column = indent;
    let rest = line.slice(indent);
    if (!flow.length) {
      atValue = false;
      while (/^- /.test(rest) || rest === "-") {
        pop(stack, column + 1);
        stack.push({ column, key: "[]" });
        const lead = rest.match(/^-\s*/)[0].length;
        column += lead;
        rest = rest.slice(lead);
      }
      if (rest !== "" || line === "") pop(stack, column);
      const found = rest.match(/^("[^"]*"|'[^']*'|[^\s#:{[][^:{[]*?):(?:\s|$)/);
      if (found) {
        stack.push({ column, key: unquoted(found[1]) });
        rest = rest.slice(found[0].length);
        atValue = true;
      }
    }
    word = "";
    for (const sign of rest) {
      const top = flow.at(-1);
      if (sign === "{" || sign === "[") {
        flow.push({ open: sign, key: sign === "[" ? "[]" : null });
        [word, atValue] = ["", sign === "["];
      } else if (sign === "}" || sign === "]") {
        flow.pop();
        [word, atValue] = ["", false];
      } else if (top && sign === ",") {
        if (top.open === "{") top.key = null;
        [word, atValue] = ["", top.open === "["];
      } else if (top && sign === ":" && top.open === "{" && top.key === null) {
        top.key = unquoted(word.trim());
        [word, atValue] = ["", true];
      } else if (top || !/\s/.test(sign)) word += sign;
      else word = "";
    }
  }
  const inner = flow.map((each) => each.key).filter((key) => key !== null);
  return { path: [...stack.map((each) => each.key), ...inner], atValue, word: word.trimStart() };
}

function lines(text) {
  const all = text.split("\n");
  return all
    .map((line, at) => [at === all.length - 1 ? line : line.replace(/(^|\s)#.*$/, "").trimEnd(), at])
    .filter(([line, at]) => line.trim() !== "" || at === all.length - 1)
    .map(([line]) => [line.match(/^ */)[0].length, line]);
}

function pop(stack, column) {
  while (stack.length && stack.at(-1).column >= column) stack.pop();
}

const unquoted = (text) => text.replace(/^["']|["']$/g, "");

// All schemas that describe what stands at the end of a path.
export function schemasAt(schema, path) {
  let found = plain(schema, schema);
  for (const key of path) {
    const next = found.flatMap((each) => {
      if (key === "[]") return [each.items, ...(each.prefixItems ?? [])];
      return [each.properties?.[key] ?? each.additionalProperties];
    });
    found = next.filter((each) => each && typeof each === "object").flatMap((each) => plain(each, schema));
  }
  return found;
}

function plain(each, root) {
  if (each.$ref) return plain(each.$ref.slice(2).split("/").reduce((at, key) => at[key], root), root);
  const choices = [...(each.anyOf ?? []), ...(each.oneOf ?? []), ...(each.allOf ?? [])];
  return [each, ...choices.flatMap((choice) => plain(choice, root))];
}

const WHEELS = /^(gears|pair|wheels)$/;
const LINKS = /^(revolutes|fixed|locks|pin|slot|inputs|loads|of|relative_to|frame|fixes|inertias)$/;

// Options for a completion: keys of the schema, values of an enumeration, or names that the declaration gives.
export function options(schema, names, text) {
  const { path, atValue, word } = yamlPath(text);
  const schemas = schemasAt(schema, path);
  const last = path.filter((key) => key !== "[]").at(-1) ?? "";
  if (atValue) {
    const values = schemas.flatMap((each) => each.enum ?? ("const" in each ? [each.const] : []));
    const yes = schemas.some((each) => each.type === "boolean") ? ["true", "false"] : [];
    const named = WHEELS.test(last) ? names.wheels : LINKS.test(last) || LINKS.test(path.at(-3) ?? "") ? names.links : [];
    const found = [...new Set([...values.map(String), ...yes, ...named])];
    return { word: word.match(/[\w.-]*$/)[0], options: found.map((label) => ({ label, type: "constant" })) };
  }
  const keys = new Map(schemas.flatMap((each) => Object.entries(each.properties ?? {})));
  const named = LINKS.test(last) ? names.links : [];
  return {
    word,
    options: [
      ...[...keys].map(([label, each]) => ({ label, type: "property", info: each.description, apply: `${label}: ` })),
      ...named.map((label) => ({ label, type: "variable", apply: `${label}: ` })),
    ],
  };
}
