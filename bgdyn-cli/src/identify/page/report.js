const data = JSON.parse(document.getElementById("data").textContent);
at("name").textContent = data.name;
at("about").textContent = `Identified from ${data.rows} equations, cut ${number(data.cut)} Hz, condition number ${number(data.condition)}; judged on ${data.last_third ? "the last third of the log" : "another motion"}.`;
at("report").textContent = data.summary;
table(at("left"), ["joint", "rms of the effort", "left by the file", "by least squares", "by bodies", "share", "explained by v", "by q", "correlation"],
  data.joints.map((j) => [j.name, `${number(j.effort)} ${j.unit}`, ...j.rms.map(number), percent(j.rms[2] / j.effort), percent(j.by_velocity), percent(j.by_position), j.correlation.toFixed(2)]));
for (const j of data.joints) {
  const title = `${j.name}, ${j.unit}`;
  plot(at("efforts"), title, data.t, [{ y: j.file, colour: "--file" }, { y: j.measured, colour: "--measured" }, { y: j.bodies, colour: "--found" }]);
  plot(at("residuals"), title, data.t, [{ y: j.measured.map((y, i) => y - j.bodies[i]), colour: "--found" }]);
}
// Logarithmic, from 0.1 % to 1000 %.
const place = (share) => 100 * Math.min(1, Math.max(0, (Math.log10(share) + 3) / 4));
for (const p of data.base) {
  const bar = element("div", at("bars"), undefined, p.seen ? "bar" : "bar unseen");
  element("span", bar, p.name, "name").title = p.name;
  const gauge = element("div", bar, undefined, "gauge");
  element("i", gauge).style.width = `${place(p.share ?? 10)}%`;
  element("b", gauge).style.left = `${place(data.unseen)}%`;
  element("span", bar, `${number(p.value)} ± ${p.deviation === null ? "∞" : number(Number(p.deviation.toPrecision(2)))}`, "value");
}
table(at("columns"), ["number", "file", "found", "±"], data.columns.map((c) => [c.name, number(c.file), number(c.value), number(Number(c.deviation.toPrecision(2)))]));
