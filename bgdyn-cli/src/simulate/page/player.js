// Time: playing, the slider, keys, the mouse; the page's fragment sets time and view.
byId("name").textContent = data.name;
byId("about").textContent = [data.description, data.method].filter(Boolean).join(" — ");
byId("report").textContent = data.report;
if (data.failure) {
  byId("failure").textContent = data.failure;
  byId("failure").hidden = false;
}
if (!moving) document.querySelector("main").classList.add("plain");
const signs = ["● centres of mass"];
if (bodies.some((b) => b.points.some((p) => p.load))) signs.push("yellow boxes: payloads");
if (bodies.some((b) => b.joint && b.joint.stops)) signs.push("red blocks: stops");
byId("legend").textContent = moving ? [...signs, "red x, green y, blue z"].join(" · ") : "";

let now = 0, playing = false, last = 0, asked = false;
const slider = byId("slider");
slider.max = END || 1;

// What the scene has beside its joints: bars over their range, and whether friction holds.
const bars = [];
if (data.states.length || data.modes.length) {
  element("h2", byId("state"), "", "Inputs and states");
  for (const curve of data.states) {
    const row = element("div", byId("state"), "bar");
    element("span", row, "name", curve.name).title = curve.name;
    const gauge = element("span", row, "gauge"), fill = element("i", gauge);
    const low = Math.min(0, curve.low), high = Math.max(0, curve.high), span = high - low || 1;
    element("b", gauge).style.left = `${(100 * (0 - low)) / span}%`;
    const text = element("span", row, "value");
    bars.push((t) => {
      const x = value(curve, T, t), at = (y) => (100 * (y - low)) / span;
      text.textContent = `${number(x)} ${curve.unit}`;
      fill.style.left = `${Math.min(at(0), at(x))}%`;
      fill.style.width = `${Math.abs(at(x) - at(0))}%`;
    });
  }
  for (const mode of data.modes) {
    const row = element("div", byId("state"), "bar");
    element("span", row, "name", mode.name).title = mode.name;
    const chip = element("span", row, "chip");
    bars.push((t) => {
      const held = mode.at[place(T, t)[0]];
      chip.textContent = held === 0 ? "held by friction" : `slips, ${held > 0 ? "+" : "−"}`;
      chip.style.color = held === 0 ? "var(--event)" : "var(--ink)";
    });
  }
}

const drawMarks = () => {
  const [draw, width, height] = canvasOf(byId("marks"));
  draw.fillStyle = css("--event");
  // The slider's knob is about 16 px wide.
  for (const event of data.events) draw.fillRect(8 + ((width - 16) * event.t) / (END || 1) - 0.75, 0, 1.5, height / 2 - 5);
};
const drawAll = () => {
  asked = false;
  drawView(now);
  for (const plot of plots) drawPlot(plot, now);
  for (const bar of bars) bar(now);
  slider.value = now;
  const near = data.events.filter((e) => Math.abs(e.t - now) < 0.002 * END).map((e) => e.text)[0];
  byId("clock").textContent = `t = ${number(now)} s`;
  byId("clock").title = near || "";
  byId("play").textContent = playing ? "❚❚" : "▶";
};
const ask = () => { if (!asked) { asked = true; requestAnimationFrame(drawAll); } };
function show(t) { now = Math.min(END, Math.max(0, t)); ask(); }
function pause() { playing = false; ask(); }

// Speeds against real time; what lasts long or next to nothing is played in about eight seconds.
const speeds = [0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 100];
const usual = END >= 1 && END <= 30 ? 1 : speeds.reduce((best, s) => (Math.abs(Math.log(END / s / 8)) < Math.abs(Math.log(END / best / 8)) ? s : best));
for (const s of speeds) {
  const option = element("option", byId("speed"), "", `${s}×`);
  option.value = s;
  option.selected = s === usual;
}
const tick = (stamp) => {
  if (!playing) return;
  const passed = last ? (stamp - last) / 1000 : 0;
  last = stamp;
  now += passed * Number(byId("speed").value);
  if (now >= END) { now = END; playing = false; }
  drawAll();
  requestAnimationFrame(tick);
};
const toggle = () => {
  playing = !playing;
  if (playing) {
    if (now >= END) now = 0;
    last = 0;
    requestAnimationFrame(tick);
  }
  ask();
};
byId("play").addEventListener("click", toggle);
slider.addEventListener("input", () => { pause(); show(Number(slider.value)); });
for (const id of ["labels", "trail"]) byId(id).addEventListener("change", ask);
document.addEventListener("keydown", (event) => {
  if (event.target.tagName === "SELECT" || event.ctrlKey || event.metaKey || event.altKey) return;
  const row = () => { const [i, part] = place(T, now); return i + Math.round(part); };
  const keys = {
    " ": toggle,
    ArrowRight: () => { pause(); show(T[Math.min(T.length - 1, row() + (event.shiftKey ? 10 : 1))]); },
    ArrowLeft: () => { pause(); show(T[Math.max(0, row() - (event.shiftKey ? 10 : 1))]); },
    Home: () => { pause(); show(0); },
    End: () => { pause(); show(END); },
  };
  if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
});

const view = byId("view");
view.addEventListener("pointerdown", (event) => view.setPointerCapture(event.pointerId));
view.addEventListener("pointermove", (event) => {
  if (!event.buttons) return;
  if (event.shiftKey || event.buttons & 2) {
    camera.move[0] += event.movementX;
    camera.move[1] += event.movementY;
  } else {
    camera.turn -= 0.4 * event.movementX;
    camera.rise = Math.max(-89.9, Math.min(89.9, camera.rise + 0.4 * event.movementY));
  }
  ask();
});
view.addEventListener("contextmenu", (event) => event.preventDefault());
view.addEventListener("wheel", (event) => {
  event.preventDefault();
  camera.zoom = Math.max(0.05, Math.min(40, camera.zoom * Math.exp(-0.0012 * event.deltaY)));
  ask();
}, { passive: false });
const look = ([turn, rise]) => { Object.assign(camera, { turn, rise, zoom: 1, move: [0, 0] }); ask(); };
for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", () => look(VIEWS[button.dataset.view]));

// #t=0.5&view=top, or &view=TURN,RISE,ZOOM in degrees
const follow = () => {
  const asked = new URLSearchParams(location.hash.slice(1));
  const named = asked.get("view");
  if (VIEWS[named]) look(VIEWS[named]);
  else if (named) {
    const [turn, rise, zoom] = named.split(",").map(Number);
    if (Number.isFinite(turn) && Number.isFinite(rise)) look([turn, rise]);
    if (zoom > 0) camera.zoom = zoom;
  }
  const t = Number(asked.get("t"));
  if (Number.isFinite(t)) show(t);
};
const redraw = () => { drawMarks(); ask(); };
window.addEventListener("hashchange", follow);
window.addEventListener("resize", redraw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
follow();
redraw();
