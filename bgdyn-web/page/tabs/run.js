// A run of the scene: started by hand, in its own worker, and cancelled by ending that.
import { Cancelled, Engine } from "../engine.js";
import { byId, make, save, stem } from "../dom.js";

const engine = new Engine();
let done = null;
let running = false;

const say = (kind, ...lines) => {
  byId("run-message").replaceChildren(...lines.map((line) => make("p", { className: kind, textContent: line })));
};

const busy = (is) => {
  running = is;
  byId("run-start").hidden = is;
  byId("run-cancel").hidden = !is;
  byId("run-progress").hidden = !is;
  byId("run-progress").value = 0;
};

/** Runs a scene; shows the replay. */
const start = async (file) => {
  say("", "Running …");
  busy(true);
  const began = performance.now();
  const clock = setInterval(() => { byId("run-clock").textContent = `${((performance.now() - began) / 1000).toFixed(1)} s`; }, 100);
  try {
    const answer = await engine.ask({ command: "run", file }, (share) => { byId("run-progress").value = share; });
    done = { answer, file };
    show(answer, (performance.now() - began) / 1000);
  } catch (error) {
    hideReplay();
    if (error instanceof Cancelled) say("", "Cancelled.");
    else say("fault", error.message);
  } finally {
    clearInterval(clock);
    byId("run-clock").textContent = "";
    busy(false);
  }
};

const show = ({ summary, warnings, failure, page }, seconds) => {
  say("", `${summary}. Computed in ${seconds.toFixed(1)} s, with a second, finer run for the error.`);
  const told = [...(failure ? [`Fault: ${failure}`] : []), ...warnings.map((warning) => `Warning: ${warning}`)];
  byId("run-message").append(...told.map((line) => make("p", { className: failure ? "fault" : "warning", textContent: line })));
  // A new frame each time: the player measures itself when it is loaded.
  const frame = byId("replay").cloneNode();
  frame.srcdoc = page;
  frame.hidden = false;
  frame.classList.remove("old");
  byId("replay").replaceWith(frame);
  for (const id of ["run-table", "run-page"]) byId(id).hidden = false;
};

const hideReplay = () => {
  done = null;
  for (const id of ["replay", "run-table", "run-page"]) byId(id).hidden = true;
};

byId("run-cancel").addEventListener("click", () => engine.cancel());
byId("run-table").addEventListener("click", () => save(`${stem(done.file.name)}.csv`, done.answer.table, "text/csv"));
byId("run-page").addEventListener("click", () => save(`${stem(done.file.name)}.html`, done.answer.page, "text/html"));

export const run = {
  /** `scene()` gives the file to run, or null with a reason in the page. */
  connect: (scene) => byId("run-start").addEventListener("click", () => {
    const file = scene();
    if (file) start(file);
  }),
  /** Says what keeps the scene from being run; nothing if it can be run. */
  allow: (reason) => {
    byId("run-start").disabled = Boolean(reason);
    if (running) return;
    if (reason) say("", reason);
    else if (!done && !byId("run-message").querySelector(".fault")) say("", "The scene can be run.");
  },
  /** Marks the replay as that of an older text. */
  outdate: (file) => {
    const old = done && (done.file.text !== file.text || done.file.mechanism !== file.mechanism);
    if (old && !running) say("", "The files have changed since this run.");
    byId("replay").classList.toggle("old", Boolean(old));
  },
  /** Forgets the last run. */
  forget: () => {
    engine.cancel();
    say("", "");
    hideReplay();
  },
};
