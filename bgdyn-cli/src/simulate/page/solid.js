// Solids as faces, a camera, and the order to paint them in.
const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.sqrt(dot(a, a));
const unit = (a) => { const l = length(a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };

// Two directions across an axis.
const across = (axis) => {
  const least = Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const first = unit(cross(least, axis));
  return [first, cross(axis, first)];
};

// A prism with `sides` sides along a line, in pieces so that painting by depth works.
const prism = (from, to, radius, sides, colour, pieces = 1, twist = Math.PI / sides) => {
  const axis = unit(add(to, from, -1)), [x, y] = across(axis), faces = [];
  const ring = (part) => {
    const middle = add(from, add(to, from, -1), part), points = [];
    for (let k = 0; k < sides; k++) {
      const angle = (2 * Math.PI * k) / sides + twist;
      points.push(add(add(middle, x, radius * Math.cos(angle)), y, radius * Math.sin(angle)));
    }
    return points;
  };
  let before = ring(0);
  faces.push({ points: [...before].reverse(), colour });
  for (let i = 1; i <= pieces; i++) {
    const here = ring(i / pieces);
    for (let k = 0; k < sides; k++) {
      const next = (k + 1) % sides;
      faces.push({ points: [before[k], before[next], here[next], here[k]], colour, open: true });
    }
    before = here;
  }
  faces.push({ points: before, colour });
  return faces;
};

// A spring's wire: a zigzag between two points.
const zigzag = (from, to, radius, turns = 10) => {
  const axis = unit(add(to, from, -1)), [x, y] = across(axis), points = [from];
  for (let k = 0; k <= 8 * turns; k++) {
    const part = 0.1 + (0.8 * k) / (8 * turns), angle = (2 * Math.PI * k) / 8;
    const middle = add(from, add(to, from, -1), part);
    points.push(add(add(middle, x, radius * Math.cos(angle)), y, radius * Math.sin(angle)));
  }
  return [...points, to];
};

const camera = { turn: -50, rise: 22, zoom: 1, move: [0, 0] };
const VIEWS = { iso: [-50, 22], front: [0, 0], side: [-90, 0], top: [-90, 89.9] };

// From the world to the screen: x to the right, y down, and how far away.
const projection = (centre, reach, width, height) => {
  const [a, e] = [camera.turn, camera.rise].map((x) => (x * Math.PI) / 180);
  const back = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
  const right = [-Math.sin(a), Math.cos(a), 0], up = cross(back, right);
  const distance = 5 * reach, focus = (0.86 * camera.zoom * Math.min(width, height) * distance) / (2 * reach);
  const project = (p) => {
    const d = add(p, centre, -1), far = distance - dot(d, back);
    const k = focus / Math.max(far, 0.02 * distance);
    return [width / 2 + camera.move[0] + k * dot(d, right), height / 2 + camera.move[1] - k * dot(d, up), far];
  };
  return { project, back, eye: add(centre, back, distance), scale: focus / distance };
};

const LIGHT = unit([0.45, -0.6, 0.85]);
// A face's colour as the light falls on it.
const lit = (colour, normal, dark) => {
  const shade = (dark ? 0.5 : 0.62) + 0.38 * Math.max(0, dot(normal, LIGHT)) + 0.06 * normal[2];
  const part = (k) => Math.round(Math.min(255, parseInt(colour.slice(k, k + 2), 16) * shade));
  return `rgb(${part(1)},${part(3)},${part(5)})`;
};

// Paints faces from the farthest to the nearest; those seen from behind are left out.
const paint = (draw, faces, lens, dark) => {
  const seen = [];
  for (const face of faces) {
    const p = face.points;
    const middle = p.reduce((sum, x) => add(sum, x, 1 / p.length), [0, 0, 0]);
    const normal = unit(cross(add(p[1], p[0], -1), add(p[2], p[1], -1)));
    if (dot(normal, add(lens.eye, middle, -1)) <= 0) continue;
    const flat = p.map(lens.project);
    seen.push({ flat, face, normal, far: lens.project(middle)[2] });
  }
  seen.sort((a, b) => b.far - a.far);
  for (const { flat, face, normal } of seen) {
    draw.beginPath();
    flat.forEach(([x, y], k) => (k ? draw.lineTo(x, y) : draw.moveTo(x, y)));
    draw.closePath();
    draw.fillStyle = lit(face.colour, normal, dark);
    draw.strokeStyle = draw.fillStyle;
    draw.lineWidth = 0.7;
    draw.fill();
    draw.stroke();
  }
};
