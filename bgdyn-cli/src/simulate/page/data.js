// The run as it stands in the page: numbers in counts of a range, unpacked once.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const T = data.t, END = T[T.length - 1];

// A curve of whole numbers from 0 to its `levels` over a range; null where there is no number.
for (const curve of [...data.outputs, ...data.states, ...data.energy.curves]) {
  const step = (curve.high - curve.low) / data.levels;
  curve.unit = curve.unit.replaceAll("*", "·").replaceAll("^2", "²").replaceAll("^3", "³");
  // What is less than a count from zero is zero.
  curve.at = curve.counts.map((k) => (k === null ? NaN : Math.abs(curve.low + step * k) < 0.6 * step ? 0 : curve.low + step * k));
}
// Unevenly spaced times: where t lies among them, as a row and a part of the way to the next one.
const place = (times, t) => {
  let low = 0, high = times.length - 1;
  if (high < 1 || t <= times[0]) return [0, 0];
  if (t >= times[high]) return [high - 1, 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return [low, (t - times[low]) / (times[high] - times[low])];
};
const value = (curve, times, t) => {
  const [i, part] = place(times, t);
  const a = curve.at[i];
  return part === 0 || curve.at.length < 2 ? a : a + part * (curve.at[i + 1] - a);
};

// Four digits, with a power of ten where the number is very large or very small.
const number = (x, digits = 4) => {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  if (size === 0) return "0";
  const text = size < 1e-3 || size >= 1e5 ? x.toExponential(digits - 2) : x.toPrecision(digits);
  return text.replace(/-/g, "−");
};
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// A canvas in the screen's own pixels; drawing is in those of the page.
const canvasOf = (canvas) => {
  const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
  const [w, h] = [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const draw = canvas.getContext("2d");
  draw.setTransform(ratio, 0, 0, ratio, 0, 0);
  draw.clearRect(0, 0, box.width, box.height);
  return [draw, box.width, box.height];
};
const element = (kind, parent, name = "", text = "") => {
  const made = document.createElement(kind);
  if (name) made.className = name;
  if (text) made.textContent = text;
  parent.appendChild(made);
  return made;
};
// Okabe and Ito's palette, in an order that also tells apart in grey.
const PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
// The first and the last of them are too dark on a dark ground.
const colour = (k) => (css("--solid") === "1" ? { 0: "#56b4e9", 5: "#b3b3ff" }[k] || PALETTE[k] : PALETTE[k]);
