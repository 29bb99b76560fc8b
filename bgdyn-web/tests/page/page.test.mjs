// The built page in a headless browser: faults at their place, completion, what the tabs show against what the command
// prints, runs to the last bit, cancelling, links.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import test, { after, before } from "node:test";
import { folder, launch, open, picture, sample, saved, tab, write } from "./browser.mjs";
import { bgdyn, root, written } from "./native.mjs";

const spec = (path) => readFileSync(join(root, "specs", path), "utf8");
let browser;
let page;
before(async () => {
  browser = await launch();
  page = await open(browser);
});
after(() => browser?.close());

const verdictIs = (wanted) => page.waitForFunction((wanted) => document.querySelector("#verdict").textContent.startsWith(wanted), wanted);
const findings = () => page.locator("#findings li").allTextContents();

test("the first sample is there and sound, opened from the disk", async () => {
  assert.equal(await page.textContent("#verdict"), bgdyn("check", "specs/cart_pole.yaml").trim());
  await tab(page, "graph");
  await picture(page, "graph");
});

test("broken YAML is a fault at its line", async () => {
  for (const path of ["invalid/yaml_syntax.yaml", "invalid/unknown_joint_type.yaml", "invalid/negative_mass.yaml", "invalid/unknown_parent.yaml"]) {
    await write(page, "mechanism", spec(path));
    await page.fill("#name", path.split("/")[1]);
    await verdictIs("1 fault");
    let report;
    try {
      bgdyn("check", "--json", `specs/${path}`);
    } catch (refused) {
      report = JSON.parse(refused.stdout);
    }
    const [wanted] = report.findings;
    await page.waitForFunction((text) => document.querySelector("#findings").textContent.includes(text), wanted.message);
    const [line] = await findings();
    assert.ok(line.startsWith(`line ${wanted.line} ${wanted.message}`), line);
    if (wanted.help) assert.ok(line.includes(wanted.help), line);
    // The underlined word is in that line of the editor, which the list's button goes to.
    await page.click("#findings button");
    const active = page.locator("#file-mechanism .cm-activeLineGutter:not(:has(.cm-lint-marker))");
    assert.ok((await active.allTextContents()).join().includes(String(wanted.line)), path);
    assert.ok(await page.locator("#file-mechanism .cm-line .cm-lintRange-error").count() > 0, path);
    assert.equal(await page.textContent("#tab-mechanism .count"), "1");
  }
  assert.match(await page.textContent("#about"), /has faults: correct them first/);
  await picture(page, "fault");
});

test("a file in the wrong place is told", async () => {
  await write(page, "mechanism", spec("scenes/stick_slip.scene.yaml"));
  await verdictIs("1 fault");
  await page.waitForFunction(() => document.querySelector("#findings").textContent.includes("it belongs under Scene"));
});

test("completion offers keys and words of the schema", async () => {
  await write(page, "mechanism", "format: 1\nlinks:\n  - name: a\n    ");
  await page.keyboard.type("jo");
  await page.waitForSelector(".cm-tooltip-autocomplete li[aria-selected]");
  assert.ok((await page.locator(".cm-tooltip-autocomplete li").allTextContents()).some((item) => item.startsWith("joint")));
  await page.waitForTimeout(200); // the editor takes no Enter that comes at once
  await page.keyboard.press("Enter");
  await page.keyboard.type("{ name: x, type: re");
  await page.waitForFunction(() => document.querySelector(".cm-tooltip-autocomplete")?.textContent.includes("revolute"));
  await picture(page, "completion");
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#file-mechanism .cm-content").innerText(), /joint: \{ name: x, type: revolute/);
});

for (const [title, path, scene] of [
  ["Block on a belt", "slider.yaml", "stick_slip"],
  ["SCARA", "scara.yaml", "scara_everything"],
]) {
  test(`${path}: the tabs have what the command prints`, async () => {
    await page.click("#tab-mechanism");
    await sample(page, title);
    await tab(page, "graph");
    const graph = await saved(page, "#graph-save");
    assert.equal(graph.text, bgdyn("graph", `specs/${path}`));

    await tab(page, "equations");
    await picture(page, `equations_${path}`);
    const latex = await saved(page, "#equations-save");
    assert.equal(latex.text, bgdyn("equations", "--format", "latex", `specs/${path}`));
    assert.equal(await page.locator("#equations .katex-error").count(), 0);
    await page.selectOption("#equations-form", "text");
    assert.equal(await page.textContent("#equations pre"), bgdyn("equations", `specs/${path}`));
    await page.selectOption("#equations-form", "set");

    await tab(page, "counts");
    await picture(page, "counts");
    assert.deepEqual(await shownCounts(), nativeCounts(`specs/${path}`));

    await code(`specs/${path}`);
    await picture(page, "code");
  });

  test(`${scene}: graph, counts and code of a scene`, async () => {
    const file = `specs/scenes/${scene}.scene.yaml`;
    await page.click("#tab-scene");
    await tab(page, "graph");
    assert.equal((await saved(page, "#graph-save")).text, bgdyn("graph", file));
    await tab(page, "counts");
    assert.deepEqual(await shownCounts(), nativeCounts(file));
    await code(file);
  });

  test(`${scene}: a run has the bits of the command's`, async () => {
    await page.click("#tab-run");
    await page.click("#run-start");
    await page.waitForSelector("#run-table:not([hidden])", { timeout: 120_000 });
    const [table, replay] = written([`${scene}.csv`, `${scene}.html`], (out) =>
      bgdyn("simulate", `specs/scenes/${scene}.scene.yaml`, "--out", out));
    assert.equal((await saved(page, "#run-table")).text, table);
    assert.equal((await saved(page, "#run-page")).text, replay);
    await page.frameLocator("#replay").locator(".plot canvas").first().waitFor();
    await picture(page, `run_${scene}`);
  });
}

const shownCounts = async () => {
  const rows = await page.locator("#counts tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  const kinds = ["mul", "add", "div", "sqrt", "sincos", "other"];
  return Object.fromEntries(rows.map(([name, ...cells]) => [name, Object.fromEntries(kinds.map((kind, i) => [kind, Number(cells[i])]))]));
};

const nativeCounts = (path) => JSON.parse(bgdyn("ops", "--json", path)).functions;

/** Compares the files of both languages. */
const code = async (path) => {
  await tab(page, "code");
  await page.selectOption("#code-backend", "rust");
  await tab(page, "code");
  assert.equal((await saved(page, "#code-save")).text, bgdyn("generate", path));
  await page.selectOption("#code-backend", "c");
  await page.waitForFunction(() => document.querySelector("#code-file").options[0].textContent.endsWith(".h"));
  await tab(page, "code");
  const names = await page.locator("#code-file option").allTextContents();
  const native = written(names, (out) => bgdyn("generate", path, "--backend", "c", "-o", out));
  for (const [i, name] of names.entries()) {
    await page.selectOption("#code-file", { index: i });
    const found = await saved(page, "#code-save");
    assert.deepEqual([found.name, found.text], [name, native[i]]);
  }
  await page.selectOption("#code-backend", "rust");
  await tab(page, "code");
};

test("the view of a run turns by the mouse", async () => {
  const view = page.frameLocator("#replay").locator("#view");
  const pixels = () => view.evaluate((canvas) => canvas.toDataURL());
  const still = await pixels();
  const box = await view.boundingBox();
  await page.mouse.move(box.x + 200, box.y + 150);
  await page.mouse.down();
  await page.mouse.move(box.x + 320, box.y + 190, { steps: 4 });
  await page.mouse.up();
  assert.notEqual(await pixels(), still);
});

test("a long run shows its progress, leaves the page alive and can be cancelled", async () => {
  await sample(page, "Block on a belt");
  const long = spec("scenes/stick_slip.scene.yaml").replace("step: 1 ms, end: 5 s", "step: 1 us, end: 500 s");
  await write(page, "scene", long);
  await verdictIs("ok: stick_slip");
  await page.click("#tab-run");
  await page.waitForFunction(() => !document.querySelector("#run-start").disabled);
  await page.click("#run-start");
  await page.waitForFunction(() => document.querySelector("#run-progress").value > 0);
  // Another tab is computed meanwhile.
  await tab(page, "counts");
  await page.click("#tab-run");
  await picture(page, "running");
  await page.click("#run-cancel");
  await page.waitForFunction(() => document.querySelector("#run-message").textContent === "Cancelled.");
  assert.ok(await page.isVisible("#run-start"));
});

test("a broken scene is told at its line, and cannot be run", async () => {
  await write(page, "scene", spec("scenes/stick_slip.scene.yaml").replace("method: rk4", "method: rk5"));
  await verdictIs("1 fault");
  const [line] = await findings();
  assert.match(line, /^line 11 .*rk5/);
  await page.click("#tab-run");
  assert.ok(await page.isDisabled("#run-start"));
  await write(page, "mechanism", spec("slider.yaml").replace("mass: 1 kg", "mass: -1 kg"));
  await verdictIs("1 fault");
  await page.click("#tab-scene");
  await verdictIs("1 fault");
});

test("a run that ends early says so and shows what there is", async () => {
  await sample(page, "Cart and pole");
  await write(page, "scene", spec("scenes/cart_and_pole.scene.yaml").replace("swing: 5 deg", "swing: 5 deg, swing_rate: 1e99 rad/s"));
  await verdictIs("ok: cart_and_pole");
  await page.click("#tab-run");
  await page.waitForFunction(() => !document.querySelector("#run-start").disabled);
  await page.click("#run-start");
  await page.waitForFunction(() => /Fault: the run ends early/.test(document.querySelector("#run-message").textContent));
  assert.ok(await page.isVisible("#replay"));
});

test("equations that are too long say which limit", async () => {
  await sample(page, "PUMA 560");
  await page.click("#tab-equations");
  await page.waitForFunction(() => document.querySelector("#about").textContent.startsWith("Too long for a closed form"));
  assert.match(await page.textContent("#about"), /the limit is 300 terms/);
});

test("a first scene of a mechanism without one can be run", async () => {
  await sample(page, "Four-bar");
  await page.click("#tab-scene");
  await page.click("#start-scene");
  await verdictIs("ok: first");
  await page.click("#tab-run");
  await page.waitForFunction(() => !document.querySelector("#run-start").disabled);
  await page.click("#run-start");
  await page.waitForSelector("#run-table:not([hidden])", { timeout: 120_000 });
  await picture(page, "first_scene");
});

test("a link brings both files, and a server may deliver the page", async () => {
  const server = createServer((request, response) => {
    const name = request.url.split(/[?#]/)[0].slice(1) || "index.html";
    const type = { html: "text/html", js: "text/javascript", css: "text/css" }[name.split(".").at(-1)];
    response.writeHead(200, { "content-type": type }).end(readFileSync(join(folder, name)));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const first = await open(browser, `http://127.0.0.1:${server.address().port}/`);
  try {
    await write(first, "mechanism", spec("double_pendulum.yaml").replace("description:", "# shared\ndescription:"));
    await first.click("#share");
    await first.waitForFunction(() => location.hash.length > 100);
    const second = await open(browser, first.url(), { colorScheme: "dark" });
    assert.match(await second.locator("#file-mechanism .cm-content").innerText(), /# shared/);
    await tab(second, "graph");
    await picture(second, "dark");
    assert.deepEqual([...first.mistakes, ...second.mistakes], []);
  } finally {
    server.close();
    server.closeAllConnections();
  }
});

test("the keyboard alone reaches the tabs", async () => {
  await page.focus("#tab-run");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.getAttribute("#tab-graph", "aria-selected"), "true");
  assert.ok(await page.evaluate(() => document.activeElement.id === "tab-graph"));
});

test("no script of the page made a mistake", () => assert.deepEqual(page.mistakes, []));
