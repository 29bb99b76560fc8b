// The page: two files, what is found in them, and what follows from them.
import "./page.css";
import { Cancelled, Engine } from "./engine.js";
import { byId, connectTabs, make } from "./dom.js";
import { goTo, makeEditor, markFindings, setText } from "./editor.js";
import { SAMPLES, firstScene } from "./samples.js";
import { filesOfLink, linkOf } from "./share.js";
import { code } from "./tabs/code.js";
import { counts } from "./tabs/counts.js";
import { equations } from "./tabs/equations.js";
import { graph } from "./tabs/graph.js";
import { run } from "./tabs/run.js";

const PAUSE = 350; // ms after the last letter
const KINDS = ["mechanism", "scene"];
const TABS = { graph, equations, counts, code };

const checker = new Engine();
const viewer = new Engine();
const names = { mechanism: "mechanism.yaml", scene: "scene.yaml" };
let schemas = null;
let active = "mechanism";
let shownTab = "graph";
/** The findings of the last check, and whether each file is sound. */
let checked = { mechanism: null, scene: null };
/** What the panels show: the request of each, as text. */
const shown = {};

const editors = Object.fromEntries(KINDS.map((kind) => [
  kind,
  makeEditor(byId(`file-${kind}`), kind === "scene" ? "Scene in YAML" : "Mechanism in YAML", () => changed(), () => schemas?.[kind] ?? null),
]));

const textOf = (kind) => editors[kind].state.doc.toString();
const isBlank = (kind) => textOf(kind).trim() === "";

/** The files as requests have them. */
const files = () => ({
  mechanism: { name: names.mechanism, text: textOf("mechanism") },
  scene: { name: names.scene, text: textOf("scene"), mechanism: textOf("mechanism") },
});

let timer = null;
const changed = () => {
  clearTimeout(timer);
  timer = setTimeout(check, PAUSE);
  byId("shared").textContent = "";
  byId("samples").value = "";
  layOut();
};

/** Checks both files, then refreshes what is shown. */
const check = async () => {
  checker.cancel();
  const { mechanism, scene } = files();
  try {
    const asked = [checker.ask({ command: "check", file: mechanism })];
    if (!isBlank("scene")) asked.push(checker.ask({ command: "check", file: scene }));
    const [first, second] = await Promise.all(asked);
    checked = { mechanism: first, scene: second ? ofScene(second) : null };
  } catch (error) {
    if (error instanceof Cancelled) return;
    byId("verdict").textContent = error.message;
    byId("verdict").className = "fault";
    return;
  }
  tellFindings();
  refresh();
};

/** Leaves out findings of the mechanism: its own check has them. */
const ofScene = (report) => ({ ...report, findings: report.findings.filter((finding) => !finding.file) });

const tellFindings = () => {
  for (const kind of KINDS) {
    const findings = checked[kind]?.findings ?? [];
    markFindings(editors[kind], findings);
    const count = byId(`tab-${kind}`).querySelector(".count");
    count.textContent = findings.length > 0 ? findings.length : "";
    count.className = `count ${checked[kind]?.ok === false ? "fault" : "warning"}`;
  }
  const report = checked[active];
  const findings = report?.findings ?? [];
  byId("findings").replaceChildren(...findings.map(findingItem));
  byId("verdict").className = !report || report.ok ? "" : "fault";
  byId("verdict").textContent = verdict(report, findings);
};

const verdict = (report, findings) => {
  if (!report) return "";
  if (report.ok) return report.lines.join("\n");
  const faults = findings.filter((finding) => finding.severity === "fault").length;
  if (faults === 0) return "The mechanism has faults: see its file.";
  return faults === 1 ? "1 fault:" : `${faults} faults:`;
};

const findingItem = (finding) => {
  const place = make("button", { type: "button", textContent: `line ${finding.line}` });
  place.addEventListener("click", () => goTo(editors[active], finding));
  const help = finding.help ? make("span", { className: "help", textContent: ` ${finding.help}` }) : "";
  return make("li", { className: finding.severity }, place, ` ${finding.message}`, help);
};

/** Shows the chosen file. */
const layOut = () => {
  const blank = active === "scene" && isBlank("scene");
  byId("no-scene").hidden = !blank;
  if (byId("name").value !== names[active]) byId("name").value = names[active];
};

/** Computes what the chosen panel shows, if its files are sound and it is not shown already. */
const refresh = async () => {
  const all = files();
  runState(all.scene);
  const tab = TABS[shownTab];
  if (!tab) return tell("", "");
  const file = tab.about(all, active === "scene" && isBlank("scene") ? "mechanism" : active);
  const kind = file.mechanism === undefined ? "mechanism" : "scene";
  if (!checked[kind]) return;
  const panel = byId(`panel-${shownTab}`);
  if (!checked[kind].ok) {
    panel.classList.add("old");
    return tell("fault", `${file.name} has faults: correct them first, they are listed under the editor.`);
  }
  const request = tab.request(file);
  const key = JSON.stringify(request);
  if (shown[shownTab] === key) {
    panel.classList.remove("old");
    return tell("", `of ${file.name}`);
  }
  viewer.cancel();
  tell("busy", `of ${file.name}: computing …`);
  panel.classList.add("old");
  try {
    tab.show(await viewer.ask(request), file);
    shown[request.command] = key;
    panel.classList.remove("old");
    tell("", `of ${file.name}`);
  } catch (error) {
    if (!(error instanceof Cancelled)) tell("fault", error.message);
  }
};

const tell = (kind, text) => {
  byId("about").className = kind;
  byId("about").textContent = text;
};

const runState = (scene) => {
  if (isBlank("scene")) return run.allow("What is run is a scene: choose the tab Scene, and write one there.");
  if (!checked.scene) return;
  run.allow(checked.scene.ok ? "" : `${names.scene} has faults: correct them first.`);
  run.outdate(scene);
};

/** Opens files in place of those that are there. */
const open = ({ title, mechanism, scene }) => {
  run.forget();
  Object.assign(names, { mechanism: mechanism.name, scene: scene.name || "first.scene.yaml" });
  checked = { mechanism: null, scene: null };
  setText(editors.mechanism, mechanism.text);
  setText(editors.scene, scene.text);
  byId("samples").value = title ? SAMPLES.findIndex((sample) => sample.title === title) : "";
  layOut();
  clearTimeout(timer);
  check();
};

const chooseFile = connectTabs(byId("files").querySelector(".tabs"), (kind) => {
  active = kind;
  layOut();
  tellFindings();
  refresh();
});
const chooseTab = connectTabs(byId("results").querySelector(".tabs"), (tab) => {
  shownTab = tab;
  refresh();
});

byId("name").addEventListener("change", ({ target }) => {
  names[active] = target.value.trim() || `${active}.yaml`;
  changed();
});
byId("start-scene").addEventListener("click", () => {
  setText(editors.scene, firstScene(names.mechanism));
  editors.scene.focus();
});
byId("samples").append(make("option", { value: "", textContent: "none: files of your own", disabled: true }), ...SAMPLES.map(({ title }, i) => make("option", { value: i, textContent: title })));
byId("samples").addEventListener("change", ({ target }) => {
  history.replaceState(null, "", location.pathname + location.search);
  open(SAMPLES[target.value]);
});
byId("share").addEventListener("click", async () => {
  const { mechanism, scene } = files();
  const link = await linkOf({ mechanism, scene: { name: scene.name, text: scene.text } });
  history.replaceState(null, "", link);
  const copied = await navigator.clipboard?.writeText(link).then(() => true, () => false);
  byId("shared").textContent = copied ? "Copied." : "The link is in the address line.";
});
equations.watch(refresh);
code.watch(refresh);
run.connect(() => files().scene);

const resize = (share) => document.documentElement.style.setProperty("--left", `${Math.min(75, Math.max(20, share))}%`);
byId("divider").addEventListener("pointerdown", (event) => {
  event.target.setPointerCapture(event.pointerId);
  const move = ({ clientX }) => resize((100 * clientX) / innerWidth);
  event.target.addEventListener("pointermove", move);
  event.target.addEventListener("pointerup", () => event.target.removeEventListener("pointermove", move), { once: true });
});
byId("divider").addEventListener("keydown", ({ key }) => {
  const step = { ArrowLeft: -3, ArrowRight: 3 }[key];
  if (step) resize((100 * byId("divider").getBoundingClientRect().left) / innerWidth + step);
});

chooseFile("mechanism");
chooseTab("graph");
checker.ask({ command: "schemas" }).then((found) => { schemas = found; }, () => {});
filesOfLink().then((linked) => open(linked ?? SAMPLES[0]));
