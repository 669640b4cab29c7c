// Bundles src/ into built/: `npm ci && node build.mjs [folder]`. The same sources give the same bytes.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "built");
const common = { bundle: true, minify: true, charset: "utf8", absWorkingDir: here, logLevel: "warning" };

await build({
  ...common,
  entryPoints: ["src/main.js"],
  outfile: join(out, "viewer.js"),
  format: "iife",
  target: "es2022",
  legalComments: "eof", // three.js asks that its licence stay with it
});
await build({ ...common, entryPoints: ["src/page.css"], outfile: join(out, "viewer.css"), target: "es2022" });
// what pages of the documentation show; no part of the package
await build({ ...common, entryPoints: ["src/diagrams/main.js"], outfile: join(out, "diagrams.js"), format: "iife", target: "es2022" });
await build({ ...common, entryPoints: ["src/diagrams/diagrams.css"], outfile: join(out, "diagrams.css"), target: "es2022" });
