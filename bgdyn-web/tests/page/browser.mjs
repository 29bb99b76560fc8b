// A headless browser with the built page, opened from the disk.
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { root } from "./native.mjs";

export const folder = join(root, process.env.CARGO_TARGET_DIR ?? "target", "page");
const pictures = process.env.BGDYN_PICTURES;

const FLAGS = ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** Returns a browser. */
export const launch = () => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });

/** Opens the page at an address; `page.mistakes` are errors of its scripts. */
export const open = async (browser, address = pathToFileURL(join(folder, "index.html")).href, settings = {}) => {
  const context = await browser.newContext({ viewport: { width: 1400, height: 860 }, acceptDownloads: true, ...settings });
  const page = await context.newPage();
  page.mistakes = [];
  page.on("pageerror", (error) => page.mistakes.push(String(error)));
  page.on("console", (message) => message.type() === "error" && page.mistakes.push(message.text()));
  await page.goto(address);
  await page.waitForFunction(() => document.querySelector("#verdict").textContent !== "", null, { timeout: 60_000 });
  return page;
};

/** Chooses a sample by the start of its title; waits for its check. */
export const sample = async (page, title) => {
  await page.click("#tab-mechanism");
  const options = await page.locator("#samples option").allTextContents();
  const value = options.findIndex((option) => option.startsWith(title));
  await page.evaluate(() => { document.querySelector("#verdict").textContent = ""; });
  await page.selectOption("#samples", { index: value });
  await page.waitForFunction(() => document.querySelector("#verdict").textContent !== "");
};

/** Chooses a tab of results and waits until it shows what belongs to the files. */
export const tab = async (page, name) => {
  await page.click(`#tab-${name}`);
  await page.waitForFunction((name) => {
    const about = document.querySelector("#about");
    return about.className === "" && about.textContent.startsWith("of ") && !document.querySelector(`#panel-${name}`).classList.contains("old");
  }, name, { timeout: 60_000 });
};

/** Replaces the text of an editor, as a paste does. */
export const write = async (page, kind, text) => {
  await page.click(`#tab-${kind}`);
  await page.locator(`#file-${kind} .cm-content`).focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await page.keyboard.insertText(text);
};

/** Returns the text that a button saves, and the name of its file. */
export const saved = async (page, button) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
};

/** Takes a picture into the folder BGDYN_PICTURES, if there is one. */
export const picture = async (page, name) => {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
};
