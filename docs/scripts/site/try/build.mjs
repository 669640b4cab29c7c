// Bundles src/ into a folder: `npm ci && node build.mjs FOLDER`; what Pyodide is made of goes beside it.
import { build } from "esbuild";
import { copyFile, mkdir } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
const PYODIDE = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json"];

await build({
  absWorkingDir: here,
  entryPoints: ["src/try.js", "src/worker.js", "src/try.css"],
  outdir: out,
  bundle: true,
  minify: true,
  charset: "utf8",
  format: "esm",
  target: "es2022",
  external: ["./pyodide/pyodide.mjs"],
  legalComments: "eof",
  logLevel: "warning",
});
await mkdir(join(out, "pyodide"), { recursive: true });
for (const name of PYODIDE) await copyFile(join(here, "node_modules", "pyodide", name), join(out, "pyodide", name));
