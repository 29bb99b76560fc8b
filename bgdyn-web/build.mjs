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

/** Returns the licences of the packages that these files are of. */
const licences = async (inputs) => {
  const packages = inputs.map((input) => /.*node_modules\/(@[^/]+\/[^/]+|[^/]+)\//.exec(input)).filter(Boolean);
  const named = new Map(packages.map(([path, name]) => [name, path]).sort());
  const texts = [...named].map(async ([name, path]) => `${name}\n\n${await readFile(`${path}LICENSE`, "utf8")}`);
  return (await Promise.all(texts)).join("\n\n");
};

await mkdir(folder, { recursive: true });
const { metafile } = await build({
  ...common,
  entryPoints: [page("main.js")],
  outfile: `${folder}/page.js`,
  loader: { ".yaml": "text", ".woff2": "dataurl", ".woff": "empty", ".ttf": "empty" },
  plugins: [bundledText],
  metafile: true,
});
await copyFile(page("index.html"), `${folder}/index.html`);
await writeFile(`${folder}/LICENSES.txt`, await licences(Object.keys(metafile.inputs)));
const packed = gzipSync(await readFile(wasm), { level: 9 });
// A script, and no file to fetch: pages opened from a disk may fetch nothing.
await writeFile(`${folder}/bgdyn_wasm.js`, `receiveBgdyn("${packed.toString("base64")}");\n`);
console.log(`${folder}: bgdyn as WebAssembly, ${(packed.length / 1e6).toFixed(1)} MB packed`);
