// Puts the page together: `node build.mjs MODULE.wasm FOLDER`.
import { mkdir, readFile, writeFile, copyFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const [, , wasm, folder] = process.argv;
const page = (name) => fileURLToPath(new URL(`page/${name}`, import.meta.url));
const common = { bundle: true, minify: true, format: "iife", target: "es2022", legalComments: "none" };

/** `import text from "./file.js?text"`: the bundle of that file, as text. */
const bundledText = {
  name: "bundled-text",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /\?text$/ }, ({ path }) => ({ path: page(path.slice(2, -"?text".length)), namespace: "bundled-text" }));
    onLoad({ filter: /.*/, namespace: "bundled-text" }, async ({ path }) => {
      const { outputFiles } = await build({ ...common, entryPoints: [path], write: false });
      return { contents: outputFiles[0].text, loader: "text" };
    });
  },
};

await mkdir(folder, { recursive: true });
await build({
  ...common,
  entryPoints: [page("main.js")],
  outfile: `${folder}/page.js`,
  loader: { ".yaml": "text" },
  plugins: [bundledText],
});
for (const name of ["index.html", "page.css"]) await copyFile(page(name), `${folder}/${name}`);
const packed = gzipSync(await readFile(wasm), { level: 9 });
// A script, and no file to fetch: pages opened from a disk may fetch nothing.
await writeFile(`${folder}/bgdyn_wasm.js`, `receiveBgdyn("${packed.toString("base64")}");\n`);
console.log(`${folder}: bgdyn as WebAssembly, ${(packed.length / 1e6).toFixed(1)} MB packed`);
