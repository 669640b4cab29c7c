// Python in a thread of its own: it is fetched with a count of what has come, then answers one text at a time.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const here = new URL(".", import.meta.url);
let total = 1;
let come = 0;

const tell = (stage, part) => postMessage({ kind: "progress", stage, part });

// every file comes through here, so that its bytes are counted as they come
const plain = globalThis.fetch.bind(globalThis);
globalThis.fetch = async (...asked) => {
  const answer = await plain(...asked);
  if (!answer.ok || !answer.body) return answer;
  const counted = answer.body.pipeThrough(
    new TransformStream({
      transform(piece, onward) {
        come += piece.byteLength;
        tell("fetching", Math.min(come / total, 1));
        onward.enqueue(piece);
      },
    }),
  );
  return new Response(counted, { status: answer.status, headers: answer.headers });
};

async function start() {
  total = (await (await plain(new URL("sizes.json", here))).json()).total;
  const packages = fetch(new URL("packages.zip", here)).then((answer) => answer.arrayBuffer());
  const python = await loadPyodide({ indexURL: new URL("pyodide/", here).href });
  const folder = python.runPython("import sysconfig; sysconfig.get_paths()['purelib']");
  python.unpackArchive(await packages, "zip", { extractDir: folder });
  tell("starting", 1);
  const page = python.pyimport("try_answer");
  page.gather("/home/pyodide/trains");
  postMessage({ kind: "ready", schema: JSON.parse(page.declaration_schema()) });
  return page;
}

const page = start();
page.catch((error) => postMessage({ kind: "failed", why: String(error.message ?? error) }));

onmessage = async ({ data }) => {
  const found = (await page).answer(data.text);
  postMessage({ kind: "answer", id: data.id, found: JSON.parse(found) });
};
