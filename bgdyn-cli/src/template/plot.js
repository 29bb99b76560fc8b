const at = (id) => document.getElementById(id);
const element = (name, parent, text, kind) => {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (kind) made.className = kind;
  parent.append(made);
  return made;
};
const number = (x) => x === null ? "–" : x === 0 ? "0" : Number(x.toPrecision(4)).toString();
const percent = (x) => `${(100 * x).toFixed(x < 0.0995 ? 1 : 0)} %`;
const table = (parent, head, rows) => {
  const made = element("table", parent);
  const line = (cells, kind) => {
    const row = element("tr", made);
    cells.forEach((cell) => element(kind, row, cell));
  };
  line(head, "th");
  rows.forEach((row) => line(row, "td"));
};
const svg = (name, parent, attributes, text) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
};
const [WIDTH, HEIGHT, LEFT, TOP, BOTTOM] = [400, 150, 46, 6, 18];

// Ticks at 1, 2 or 5 times a power of ten.
const ticks = (low, high) => {
  const raw = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((k) => k * power >= raw) * power;
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k += 1) found.push(k * step);
  return found;
};

// Curves over t, in a unit; levels are horizontal lines within which they stay.
const plot = (parent, title, t, curves, levels = [], unit = "s") => {
  const box = element("div", parent, undefined, "plot");
  element("b", box, title);
  const root = svg("svg", box, { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": title });
  let [low, high] = [Infinity, -Infinity];
  for (const y of [...curves.map((c) => c.y), levels]) for (const x of y) { low = Math.min(low, x); high = Math.max(high, x); }
  if (!(high > low)) { low -= 1; high += 1; }
  const [first, last] = [t[0], t[t.length - 1]];
  // The unit has the place beside the last tick.
  const right = WIDTH - 16 - 6 * unit.length;
  const X = (x) => LEFT + (right - LEFT) * (x - first) / (last - first || 1);
  const Y = (y) => TOP + (HEIGHT - TOP - BOTTOM) * (high - y) / (high - low);
  for (const y of ticks(low, high)) {
    svg("line", root, { class: "grid", x1: LEFT, x2: right, y1: Y(y), y2: Y(y) });
    svg("text", root, { x: LEFT - 4, y: Y(y) + 3, "text-anchor": "end" }, number(Math.abs(y) < 1e-12 ? 0 : y));
  }
  for (const x of ticks(first, last)) svg("text", root, { x: X(x), y: HEIGHT - 5, "text-anchor": "middle" }, number(x));
  svg("text", root, { x: WIDTH - 2, y: HEIGHT - 5, "text-anchor": "end" }, unit);
  for (const y of levels) svg("line", root, { class: "level", x1: LEFT, x2: right, y1: Y(y), y2: Y(y) });
  for (const { y, colour } of curves) {
    const path = y.map((value, i) => `${i ? "L" : "M"}${X(t[i]).toFixed(1)} ${Y(value).toFixed(1)}`).join("");
    svg("path", root, { d: path, style: `stroke: var(${colour})` });
  }
};
