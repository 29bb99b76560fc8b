const data = JSON.parse(document.getElementById("data").textContent);
at("name").textContent = data.name;
at("about").textContent = `A planned motion of ${number(data.period)} s, periodic, at rest at its start, that shows ${data.base} base parameters; nothing of it is measured.`;
if (data.weak !== null) at("weak").textContent = data.weak;
at("report").textContent = data.summary;
table(at("shown"), ["motion", "condition number", "without weights of noise", "log det"],
  ["the first random one", "the best of the random ones", "this one"].map((name, i) => [name, ...data.condition[i].map(number), number(data.log_det[i])]));
table(at("used"), ["joint", "position", "speed", "acceleration", "effort", "nearest"],
  data.joints.map((j) => [j.name, ...j.used.map((x, i) => i === 3 && j.effort === null ? "–" : percent(x)), j.nearest]));
for (const j of data.joints) {
  const both = (x) => x === null ? [] : [-x, x];
  const one = (id, i, y, levels) => plot(at(id), `${j.name}, ${j.units[i]}`, data.t, [{ y, colour: "--found" }], levels);
  one("positions", 0, j.q, j.range);
  one("velocities", 1, j.v, both(j.speed));
  one("accelerations", 2, j.a, both(j.acceleration));
  one("efforts", 3, j.tau, both(j.effort));
}
data.ascents.forEach((values, i) => {
  if (values.length > 1) plot(at("ascents"), `weight ${i + 1}`, values.map((_, k) => k), [{ y: values, colour: "--found" }], [], "steps");
});
