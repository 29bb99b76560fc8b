// Plots of curves over time: those of one unit and of like size share one.
const LEFT = 62, RIGHT = 14, TOP = 8, BOTTOM = 24;
const spanOf = (curves) => {
  let low = Infinity, high = -Infinity;
  for (const c of curves) if (c.low <= c.high) { low = Math.min(low, c.low); high = Math.max(high, c.high); }
  return low <= high ? [low, high] : [0, 0];
};
const plots = [];
const share = (curves) => {
  const made = [];
  for (const curve of curves) {
    const own = curve.high - curve.low;
    const fits = (plot) => {
      if (plot.unit !== curve.unit || plot.curves.length >= PALETTE.length) return false;
      const [low, high] = spanOf([...plot.curves, curve]);
      const spans = [...plot.curves.map((c) => c.high - c.low), own].filter((s) => s > 0);
      return spans.length === 0 || high - low <= 12 * Math.min(...spans);
    };
    const found = made.find(fits);
    if (found) found.curves.push(curve); else made.push({ unit: curve.unit, curves: [curve], times: T });
  }
  return made;
};
plots.push(...share(data.outputs));
if (data.energy.t.length > 1) {
  const [supplied, stored, dissipated, drift] = data.energy.curves;
  plots.push({ unit: "J", title: "energy", curves: [supplied, stored, dissipated], times: data.energy.t });
  plots.push({ unit: "J", title: "drift of the energy", curves: [drift], times: data.energy.t });
}

for (const plot of plots) {
  const box = element("div", byId("plots"), "plot"), head = element("div", box, "curves");
  if (plot.title) element("b", head, "", plot.title);
  plot.marks = [];
  plot.values = plot.curves.map((curve, k) => {
    const item = element("span", head, "curve");
    plot.marks.push(element("i", item));
    const name = element("span", item, "name", curve.name);
    name.title = curve.name;
    return element("span", item, "value");
  });
  plot.canvas = element("canvas", box);
  plot.axis = axisOf(spanOf(plot.curves));
  const jump = (event) => {
    const rect = plot.canvas.getBoundingClientRect();
    const part = (event.clientX - rect.left - LEFT) / (rect.width - LEFT - RIGHT);
    show(END * Math.min(1, Math.max(0, part)));
  };
  plot.canvas.addEventListener("pointerdown", (event) => { pause(); plot.canvas.setPointerCapture(event.pointerId); jump(event); });
  plot.canvas.addEventListener("pointermove", (event) => event.buttons && jump(event));
}

// Range, ticks and the power of ten taken out of them; a small change of a large value is shown as a
// change from where it begins.
function axisOf([low, high]) {
  const large = Math.max(Math.abs(low), Math.abs(high));
  let change = high - low;
  const flat = change <= 1e-12 * large;
  const offset = !flat && change < 1e-3 * large ? low : 0;
  if (flat) {
    const margin = large > 0 ? 0.1 * large : 1;
    [low, high] = [low - margin, high + margin];
    change = high - low;
  } else {
    [low, high] = [low - 0.06 * change, high + 0.06 * change];
  }
  const shown = offset === 0 ? Math.max(Math.abs(low), Math.abs(high)) : change;
  const power = shown >= 0.01 && shown < 1e4 ? 0 : 3 * Math.floor(Math.log10(shown) / 3);
  return { low, high, offset, power, ticks: ticksOf(low - offset, high - offset, 4) };
}
function ticksOf(low, high, count) {
  const rough = (high - low) / count, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * ten).find((s) => s >= 0.999 * rough), ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
  return { step, at: ticks };
}
const tickText = (x, step, power) => {
  const scale = 10 ** power, decimals = Math.max(0, -Math.floor(Math.log10(step / scale) + 1e-9));
  return (x / scale + 0).toFixed(Math.min(9, decimals)).replace(/^-(0(\.0+)?)$/, "$1").replace("-", "−");
};
const SECONDS = axisOf([0, END || 1]);
SECONDS.ticks = ticksOf(0, END || 1, 6);

const drawPlot = (plot, t) => {
  const [draw, width, height] = canvasOf(plot.canvas), axis = plot.axis;
  const ink = css("--soft"), w = width - LEFT - RIGHT, h = height - TOP - BOTTOM;
  const X = (s) => LEFT + (w * s) / (END || 1), Y = (y) => TOP + h - (h * (y - axis.low)) / (axis.high - axis.low);
  draw.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  draw.lineWidth = 1;
  const rule = (x0, y0, x1, y1, colour) => { draw.strokeStyle = colour; draw.beginPath(); draw.moveTo(x0, y0); draw.lineTo(x1, y1); draw.stroke(); };
  draw.fillStyle = ink;
  draw.textAlign = "right";
  draw.textBaseline = "middle";
  for (const tick of axis.ticks.at) {
    const y = Y(tick + axis.offset);
    rule(LEFT, y, LEFT + w, y, css("--grid"));
    draw.fillText(tickText(tick, axis.ticks.step, axis.power), LEFT - 6, y);
  }
  draw.textAlign = "center";
  draw.textBaseline = "top";
  for (const tick of SECONDS.ticks.at) {
    rule(X(tick), TOP + h, X(tick), TOP + h + 4, ink);
    if (X(tick) < LEFT + w - 26) draw.fillText(tickText(tick, SECONDS.ticks.step, SECONDS.power), X(tick), TOP + h + 7);
  }
  draw.textAlign = "right";
  draw.fillText(SECONDS.power ? `1e${SECONDS.power} s` : "s", LEFT + w + 8, TOP + h + 7);
  draw.textAlign = "left";
  draw.textBaseline = "top";
  const label = [axis.power ? `1e${axis.power}` : "", plot.unit].filter(Boolean).join(" ");
  const from = axis.offset ? ` from ${number(axis.offset, 7)}` : "";
  draw.save();
  draw.translate(4, TOP + h / 2);
  draw.rotate(-Math.PI / 2);
  draw.textAlign = "center";
  draw.fillText(label + from, 0, 0);
  draw.restore();
  rule(LEFT, TOP, LEFT, TOP + h, ink);
  rule(LEFT, TOP + h, LEFT + w, TOP + h, ink);
  if (data.events.length <= 60) {
    draw.globalAlpha = 0.4;
    for (const event of data.events) rule(X(event.t), TOP, X(event.t), TOP + h, css("--event"));
    draw.globalAlpha = 1;
  }
  draw.save();
  draw.beginPath();
  draw.rect(LEFT, TOP - 2, w + 1, h + 4);
  draw.clip();
  plot.curves.forEach((curve, k) => {
    draw.strokeStyle = colour(k);
    draw.lineWidth = 1.7;
    draw.beginPath();
    let pen = false;
    curve.at.forEach((y, i) => {
      if (Number.isNaN(y)) { pen = false; return; }
      if (pen) draw.lineTo(X(plot.times[i]), Y(y)); else draw.moveTo(X(plot.times[i]), Y(y));
      pen = true;
    });
    draw.stroke();
  });
  draw.restore();
  draw.lineWidth = 1.2;
  rule(X(t), TOP, X(t), TOP + h, css("--ink"));
  plot.curves.forEach((curve, k) => {
    const y = value(curve, plot.times, t);
    plot.marks[k].style.background = colour(k);
    plot.values[k].textContent = `${number(y)} ${curve.unit}`;
    if (Number.isNaN(y)) return;
    draw.fillStyle = colour(k);
    draw.beginPath();
    draw.arc(X(t), Y(y), 3, 0, 2 * Math.PI);
    draw.fill();
  });
};
