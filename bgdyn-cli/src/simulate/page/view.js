// The mechanism at an instant: solids from its joints, centres of mass, frames, trails.
const bodies = data.bodies;
const moving = bodies.length > 1;

// Axes (columns of R) and origin of a body; between two rows the quaternion is blended.
const poseAt = (body, t) => {
  if (!body.place) return { R: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], o: [0, 0, 0] };
  const [i, part] = place(T, t);
  const j = Math.min(i + 1, T.length - 1);
  const blend = (list, n, k, unit) => unit * (list[n * i + k] + part * (list[n * j + k] - list[n * i + k]));
  const o = [0, 1, 2].map((k) => blend(body.place, 3, k, data.grain));
  let q = [0, 1, 2, 3].map((k) => blend(body.turn, 4, k, 1));
  const size = Math.hypot(...q) || 1;
  q = q.map((x) => x / size);
  const [w, x, y, z] = q;
  const R = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  return { R, o };
};
const turned = (pose, p) => add(add([pose.R[0][0] * p[0], pose.R[0][1] * p[0], pose.R[0][2] * p[0]], pose.R[1], p[1]), pose.R[2], p[2]);
const inWorld = (pose, p) => add(pose.o, turned(pose, p));

// How large the drawing is, and how thick its parts.
const size = (() => {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const stretch = (p) => p.forEach((x, k) => { low[k] = Math.min(low[k], x); high[k] = Math.max(high[k], x); });
  const stride = Math.max(1, Math.floor(T.length / 150));
  for (let i = 0; i < T.length; i += stride) {
    for (const body of bodies) {
      const pose = poseAt(body, T[i]);
      for (const point of body.points) stretch(inWorld(pose, point.at));
      for (const edge of body.edges || []) stretch(inWorld(pose, edge[0]));
      if (body !== bodies[0]) stretch(pose.o);
      for (const stop of (body.joint && body.joint.stops) || []) stretch(inWorld(poseAt(bodies[body.joint.on], T[i]), stop.at));
    }
  }
  const near = bodies[0].points.some((p) => length(p.at) > 0);
  if (!near || length(add(high, low, -1)) === 0) stretch([0, 0, 0]);
  const lengths = bodies.flatMap((b) => b.points.map((p) => length(p.at))).filter((l) => l > 0).sort((a, b) => a - b);
  const extent = length(add(high, low, -1)), span = extent || 0.2;
  const typical = lengths.length ? lengths[Math.floor(0.6 * lengths.length)] : Infinity;
  const r = Math.min((extent ? 0.015 : 0.07) * span, 0.14 * typical);
  const centre = add(low, add(high, low, -1), 0.5);
  const floor = low[2] - 1.8 * r;
  const reach = Math.max(0.44 * span, 6 * r) + 2 * r;
  const step = 10 ** Math.floor(Math.log10(reach / 2));
  const grid = [1, 2, 5, 10].map((k) => k * step).find((s) => reach / s <= 5) || 10 * step;
  return { low, high, centre, reach, r, floor, grid };
})();

const COLOURS = ["#8d99a6", "#5b9bd5", "#e0a458", "#6fb98f", "#c58fc0", "#d9776c", "#7f9fd0", "#b7b168"];
const JOINT = "#4b5560", RAIL = "#9aa4af", RAM = "#b0453f", ROD = "#c9ced4", STOP = "#d0483e", LOAD = "#c9a227", FORCE = "#d0483e";
const colourOf = (i) => (i === 0 ? COLOURS[0] : COLOURS[1 + ((i - 1) % (COLOURS.length - 1))]);
const heaviest = Math.max(1e-300, ...bodies.flatMap((b) => b.points.map((p) => p.mass || 0)));

const solids = (poses, t) => {
  const { r } = size, faces = [];
  const beam = (from, to, radius, colour, sides = 4) => {
    const l = length(add(to, from, -1));
    if (l > 0.2 * r) faces.push(...prism(from, to, radius, sides, colour, Math.max(1, Math.min(24, Math.round(l / (2.5 * radius))))));
  };
  bodies.forEach((body, i) => {
    const pose = poses[i], colour = colourOf(i);
    for (const point of body.points) {
      if (point.load) {
        const at = inWorld(pose, point.at), half = r * (1 + 1.1 * Math.cbrt(point.mass / heaviest));
        faces.push(...prism(add(at, pose.R[2], -half), add(at, pose.R[2], half), half * Math.SQRT2, 4, LOAD, 2));
      }
      if (point.beam) beam(inWorld(pose, point.from), inWorld(pose, point.at), 0.95 * r, colour);
    }
    const joint = body.joint;
    if (!joint) return;
    const axis = turned(pose, joint.axis);
    for (const stop of joint.stops || []) {
      // A slide's stop is where its block ends; another joint's is beside the beam that meets it.
      const base = poses[joint.on], at = inWorld(base, stop.at), way = turned(base, stop.way);
      if (joint.type === "prismatic") {
        const end = add(at, way, 2.2 * r * stop.side);
        faces.push(...prism(end, add(end, way, 0.9 * r * stop.side), 2.4 * r, 4, STOP, 1));
      } else {
        const side = cross(axis, way), foot = add(at, side, 1.5 * r * stop.side);
        faces.push(...prism(add(foot, way, 1.9 * r), add(foot, way, 4.6 * r), 0.7 * r, 4, STOP, 2));
      }
    }
    if (joint.type === "prismatic") {
      const base = poses[joint.on], from = inWorld(base, joint.from), to = inWorld(base, joint.to), way = unit(turned(base, joint.along));
      beam(add(from, way, -2.5 * r), add(to, way, 2.5 * r), 0.55 * r, RAIL);
      faces.push(...prism(add(pose.o, axis, -2.2 * r), add(pose.o, axis, 2.2 * r), 2 * r, 4, body.points.length ? JOINT : colour, 2));
    } else if (joint.type === "spherical") {
      // A ball of five discs.
      for (let k = -2; k <= 2; k++) {
        const wide = 1.9 * r * Math.sqrt(1 - (k / 2.5) ** 2);
        faces.push(...prism(add(pose.o, axis, (k - 0.5) * 0.76 * r), add(pose.o, axis, (k + 0.5) * 0.76 * r), wide, 16, JOINT, 1));
      }
    } else if (joint.type === "floating") {
      faces.push(...prism(add(pose.o, axis, -1.4 * r), add(pose.o, axis, 1.4 * r), 1.4 * Math.SQRT2 * r, 4, body.points.length > 1 ? JOINT : colour, 2));
    } else if (joint.type === "planar") {
      faces.push(...prism(add(pose.o, axis, -0.5 * r), add(pose.o, axis, 0.5 * r), 2.6 * r, 16, JOINT, 1));
    } else {
      faces.push(...prism(add(pose.o, axis, -1.9 * r), add(pose.o, axis, 1.9 * r), 1.55 * r, 16, JOINT, 2));
    }
  });
  for (const link of data.between) {
    const [from, to] = link.ends.map((e) => inWorld(poses[e.body], e.at));
    if (link.kind === "cylinder") {
      // The barrel is as long as the shortest length of the run allows.
      const barrel = link.shortest * 0.92, way = unit(add(to, from, -1));
      beam(from, add(from, way, barrel), 0.7 * r, RAM, 12);
      beam(add(from, way, barrel), to, 0.35 * r, ROD, 10);
    }
  }
  return faces;
};

// Whether something hangs on a frame: it needs no axes and no name then.
const isEnd = (i, point) => data.between.some((l) => l.ends.some((e) => e.body === i && length(add(e.at, point.at, -1)) < 1e-9));

const drawView = (t) => {
  if (!moving) return;
  const [draw, width, height] = canvasOf(byId("view"));
  const dark = css("--solid") === "1", ink = css("--ink"), soft = css("--soft");
  const lens = projection(size.centre, size.reach, width, height);
  const poses = bodies.map((b) => poseAt(b, t));
  const line = (points, colour, wide, alpha = 1) => {
    draw.globalAlpha = alpha;
    draw.strokeStyle = colour;
    draw.lineWidth = wide;
    draw.beginPath();
    points.map(lens.project).forEach(([x, y], k) => (k ? draw.lineTo(x, y) : draw.moveTo(x, y)));
    draw.stroke();
    draw.globalAlpha = 1;
  };
  drawGrids(line, poses);
  if (byId("trail").checked) {
    trails.forEach((trail) => line(trail.points, css("--accent"), 1.2, 0.3));
  }
  paint(draw, solids(poses, t), lens, dark);
  for (const link of data.between.filter((l) => l.kind !== "cylinder")) {
    const [from, to] = link.ends.map((e) => inWorld(poses[e.body], e.at));
    line(link.kind === "damper" ? [from, to] : zigzag(from, to, 1.3 * size.r), css("--event"), 1.8);
  }
  if (byId("trail").checked) {
    const [i] = place(T, t);
    trails.forEach((trail) => line([...trail.points.slice(0, i + 1), inWorld(poses[trail.body], trail.at)], css("--accent"), 2.2));
  }
  bodies.forEach((body, i) => body.points.forEach((p) => p.mass && line([p.from, p.at].map((x) => inWorld(poses[i], x)), colourOf(i), 2)));
  bodies.forEach((body, i) => (body.edges || []).forEach((edge) => line(edge.map((x) => inWorld(poses[i], x)), colourOf(i), 1.2)));
  drawMasses(draw, lens, poses, dark);
  if (data.contacts) drawForces(line, t);
  const names = [];
  const axes = (pose, at, R, long, wide) => ["#d94a3d", "#3a9e4b", "#3a6fd9"].forEach((colour, k) => {
    const tip = add(at, turned(pose, R[k]), long);
    line([at, tip], colour, wide);
  });
  axes(poses[0], [0, 0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]], 5 * size.r, 2.2);
  names.push([[0, 0, 0], "world", true]);
  bodies.forEach((body, i) => body.points.forEach((point) => {
    if (!point.axes || isEnd(i, point)) return;
    const at = inWorld(poses[i], point.at);
    axes(poses[i], at, point.axes, (point.tip ? 4.2 : 2.6) * size.r, point.tip ? 2.2 : 1.4);
    names.push([at, point.name, point.tip]);
  }));
  bodies.forEach((body, i) => body.joint && names.push([poses[i].o, body.joint.name, true]));
  bodies.forEach((body, i) => body.points.forEach((p) => p.load && names.push([inWorld(poses[i], p.at), p.name, true])));
  for (const link of data.between) {
    const [from, to] = link.ends.map((e) => inWorld(poses[e.body], e.at));
    names.push([add(from, add(to, from, -1), 0.5), link.name, true]);
  }
  if (byId("labels").checked) drawNames(draw, lens, names, ink, css("--panel"), width, height);
  const longest = data.contacts ? ` · arrows: contact forces, up to ${number(1000 * data.contacts.unit, 3)} N` : "";
  byId("scale").textContent = `grid: ${number(size.grid, 1)} m${longest}`;
};

// A grid on each plane that something touches, around the drawing; without contacts one on the floor.
const drawGrids = (line, poses) => {
  if (!data.contacts || !data.contacts.planes.length) return drawGrid(line);
  const g = size.grid, colour = css("--line");
  for (const plane of data.contacts.planes) {
    const pose = poses[plane.body], at = inWorld(pose, plane.at), [x, y] = plane.axes.map((a) => turned(pose, a));
    const middle = add(size.centre, at, -1), round = (axis) => Math.round(dot(middle, axis) / g);
    const [i0, j0] = plane.body === 0 ? [round(x), round(y)] : [0, 0];
    // A wall would hide what is before it.
    const n = Math.abs(turned(pose, plane.axes[2])[2]) > 0.7 ? Math.ceil(size.reach / g) : 1;
    const point = (i, j) => add(add(at, x, (i0 + i) * g), y, (j0 + j) * g);
    for (let i = -n; i <= n; i++) {
      line([point(i, -n), point(i, n)], colour, i0 + i === 0 ? 1.6 : 0.8);
      line([point(-n, i), point(n, i)], colour, j0 + i === 0 ? 1.6 : 0.8);
    }
  }
};

// Forces of contacts on what touches, as arrows; the longest of the run is half as long as the drawing.
const drawForces = (line, t) => {
  const [i, part] = place(T, t), j = Math.min(i + 1, T.length - 1);
  const at = (list, row) => [0, 1, 2].map((k) => list[3 * row + k]);
  const blend = (list) => add(at(list, i), add(at(list, j), at(list, i), -1), part);
  for (const contact of data.contacts.forces) {
    const force = blend(contact.force), newton = length(force);
    if (newton < 2) continue;
    const foot = blend(contact.at).map((x) => x * data.grain), way = unit(force), [side] = across(way);
    const tip = add(foot, force, size.reach / 2000), head = Math.min(2.2 * size.r, length(add(tip, foot, -1)) / 2);
    line([foot, tip], FORCE, 2.4);
    for (const s of [-0.45, 0.45]) line([add(add(tip, way, -head), side, s * head), tip], FORCE, 2.4);
  }
};

const drawGrid = (line) => {
  const g = size.grid, colour = css("--line");
  const from = [0, 1].map((k) => Math.floor((size.centre[k] - size.reach) / g)), to = [0, 1].map((k) => Math.ceil((size.centre[k] + size.reach) / g));
  for (let i = from[0]; i <= to[0]; i++) line([[i * g, from[1] * g, size.floor], [i * g, to[1] * g, size.floor]], colour, i === 0 ? 1.6 : 0.8);
  for (let i = from[1]; i <= to[1]; i++) line([[from[0] * g, i * g, size.floor], [to[0] * g, i * g, size.floor]], colour, i === 0 ? 1.6 : 0.8);
};

// The usual sign of a centre of mass, a disc in quarters, larger for more mass.
const drawMasses = (draw, lens, poses, dark) => bodies.forEach((body, i) => body.points.forEach((point) => {
  if (!point.mass || point.load) return;
  const [x, y] = lens.project(inWorld(poses[i], point.at));
  const radius = Math.max(3.5, size.r * lens.scale * (0.45 + 0.75 * Math.cbrt(point.mass / heaviest)));
  for (let k = 0; k < 4; k++) {
    draw.beginPath();
    draw.moveTo(x, y);
    draw.arc(x, y, radius, (k * Math.PI) / 2, ((k + 1) * Math.PI) / 2);
    draw.closePath();
    draw.fillStyle = k % 2 ? "#ffffff" : "#1c2127";
    draw.fill();
  }
  draw.beginPath();
  draw.arc(x, y, radius, 0, 2 * Math.PI);
  draw.strokeStyle = dark ? "#000000" : "#1c2127";
  draw.lineWidth = 1;
  draw.stroke();
}));

// Names beside their points; one that finds no room is left out, those of joints and tips come first.
const drawNames = (draw, lens, names, ink, back, width, height) => {
  const taken = [[0, 0, 330, 40]];
  draw.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  draw.textBaseline = "middle";
  const first = [...names.filter((n) => n[2]), ...names.filter((n) => !n[2])];
  for (const [at, full, ,] of first) {
    const name = full.length > 24 ? full.slice(0, 23) + "…" : full;
    const [x, y] = lens.project(at), w = draw.measureText(name).width, gap = 6 + 1.6 * size.r * lens.scale;
    const spots = [[x + gap, y - 10], [x + gap, y + 12], [x - gap - w, y - 10], [x - gap - w, y + 12], [x - w / 2, y - gap - 10], [x - w / 2, y + gap + 12], [x + gap, y - 28], [x - gap - w, y + 30]];
    const free = ([a, b]) => a > 2 && a + w < width - 2 && b > 8 && b < height - 28 && taken.every(([l, t, r, u]) => a + w < l || a > r || b + 8 < t || b - 8 > u);
    const spot = spots.find(free);
    if (!spot) continue;
    taken.push([spot[0] - 8, spot[1] - 9, spot[0] + w + 8, spot[1] + 9]);
    draw.lineWidth = 3.5;
    draw.lineJoin = "round";
    draw.strokeStyle = back;
    draw.strokeText(name, ...spot);
    draw.fillStyle = ink;
    draw.fillText(name, ...spot);
  }
};

// The ways of the tips, four at the most.
const trails = bodies.flatMap((body, i) => body.points.filter((p) => p.tip && i > 0).map((p) => ({ body: i, at: p.at }))).slice(0, 4);
for (const trail of trails) trail.points = T.map((t) => inWorld(poseAt(bodies[trail.body], t), trail.at));
