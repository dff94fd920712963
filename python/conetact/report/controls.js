// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
// Mouse, fingers, sliders; what is written beside the view.

// From where bodies are seen: rows of `turn` are the directions to the right, up and to the eye.
const sight = { turn: [1, 0, 0, 0, 1, 0, 0, 0, 1], middle: [0, 0], zoom: 1, size: 1, touched: false };
const VIEWS = { space: [22, -60], "x": [0, 0], "y": [0, -90], "z": [90, -90] };

function look(elevation, azimuth) {
  const [e, a] = [elevation, azimuth].map((x) => (x * Math.PI) / 180), { sin, cos } = Math;
  sight.turn = [-sin(a), cos(a), 0, -sin(e) * cos(a), -sin(e) * sin(a), cos(e),
    cos(e) * cos(a), cos(e) * sin(a), sin(e)];
}

const seen = (p, k = 0) => [0, 1, 2].map((r) => sight.turn[3 * r] * p[k] + sight.turn[3 * r + 1] * p[k + 1]
  + sight.turn[3 * r + 2] * p[k + 2]);

// all that is drawn fills the stage
function fit() {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (let i = 0; i < 8; i++) {
    const q = seen([0, 1, 2].map((c) => ((i >> c) & 1 ? box.high : box.low)[c]));
    for (let c = 0; c < 2; c++) {
      low[c] = Math.min(low[c], q[c]);
      high[c] = Math.max(high[c], q[c]);
    }
  }
  sight.size = Math.hypot(...box.high.map((x, c) => x - box.low[c])) || 1;
  sight.middle = [0, 1].map((c) => (low[c] + high[c]) / 2);
  const least = sight.size * 1e-6;
  sight.zoom = 0.84 * Math.min(canvas.clientWidth / Math.max(high[0] - low[0], least),
    canvas.clientHeight / Math.max(high[1] - low[1], least));
  sight.touched = false;
  draw();
}

// a view that nobody has turned or moved stays fitted
function resized() {
  if (sight.touched) draw(); else fit();
}

function times(a, b) {
  const all = [0, 1, 2];
  return all.flatMap((r) => all.map((c) => all.reduce((sum, k) => sum + a[3 * r + k] * b[3 * k + c], 0)));
}

function turn(dx, dy) {
  const [a, b] = [dx * 0.008, dy * 0.008], { sin, cos } = Math;
  const around = times([1, 0, 0, 0, cos(b), -sin(b), 0, sin(b), cos(b)],
    [cos(a), 0, sin(a), 0, 1, 0, -sin(a), 0, cos(a)]);
  const pivot = [0, 1, 2].map((c) => (box.low[c] + box.high[c]) / 2), before = seen(pivot);
  sight.turn = times(around, sight.turn);
  const after = seen(pivot); // the middle of the bodies stays where it is
  for (let c = 0; c < 2; c++) sight.middle[c] += after[c] - before[c];
}

function move(dx, dy) {
  sight.middle[0] -= dx / sight.zoom;
  sight.middle[1] += dy / sight.zoom;
}

// what is below the pointer stays there
function zoom(by, x, y) {
  const from = [x - canvas.clientWidth / 2, canvas.clientHeight / 2 - y];
  for (let c = 0; c < 2; c++) sight.middle[c] += (from[c] / sight.zoom) * (1 - 1 / by);
  sight.zoom *= by;
}

const pointers = new Map();
let way = 0;

function on_move(event) {
  const last = pointers.get(event.pointerId);
  if (!last) return;
  const place = [event.offsetX, event.offsetY], [dx, dy] = [place[0] - last[0], place[1] - last[1]];
  way += Math.hypot(dx, dy);
  sight.touched = true;
  if (pointers.size > 1) {
    const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
    const far = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
    zoom(far(place) / far(last), (place[0] + other[0]) / 2, (place[1] + other[1]) / 2);
    move(dx / 2, dy / 2);
  } else if (PLANE || event.shiftKey || event.buttons & 6) move(dx, dy);
  else turn(dx, dy);
  pointers.set(event.pointerId, place);
  draw();
}

function on_up(event) {
  if (pointers.delete(event.pointerId) && event.type === "pointerup" && way < 4) point_at(event.offsetX, event.offsetY);
}

function listen() {
  canvas.addEventListener("pointerdown", (event) => {
    if (!pointers.size) way = 0;
    pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", on_move);
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, on_up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", fit);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    sight.touched = true;
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.04 : 0.0012)), event.offsetX, event.offsetY);
    draw();
  }, { passive: false });
  canvas.addEventListener("keydown", on_key);
}

function on_key(event) {
  const step = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] }[event.key];
  if (step) (PLANE || event.shiftKey ? move : turn)(...step);
  else if (event.key === "+" || event.key === "-") {
    zoom(event.key === "+" ? 1.2 : 1 / 1.2, canvas.clientWidth / 2, canvas.clientHeight / 2);
  }
  else return;
  event.preventDefault();
  sight.touched = true;
  draw();
}

// the foremost node near a place on the stage
function nearest(x, y) {
  const [a, b, c, w] = plane();
  let best = null;
  for (const body of bodies) for (let k = 0; k < body.shape.n && !now.hidden.has(body.name); k++) {
    if (!body.shape.outside[k]) continue;
    const p = body.at, away = a * p[3 * k] + b * p[3 * k + 1] + c * p[3 * k + 2] > w;
    const q = seen(p, 3 * k), px = (q[0] - sight.middle[0]) * sight.zoom + canvas.clientWidth / 2;
    const far = Math.hypot(px - x, canvas.clientHeight / 2 - (q[1] - sight.middle[1]) * sight.zoom - y);
    const rank = q[2] * sight.zoom - 3 * far; // in pixels: nearer to the eye, or to the pointer
    if (!away && far < 14 && !(best && best.rank >= rank)) best = { body, k, rank };
  }
  return best;
}

function point_at(x, y) {
  const found = nearest(x, y);
  now.spot = found && { name: found.body.name, k: found.k };
  tell_spot();
  draw();
}

// node of the largest value in sight
function point_at_largest() {
  let best = null;
  for (const body of bodies) for (let k = 0; k < body.shape.n && !now.hidden.has(body.name); k++) {
    const value = body.value[2 * k];
    const counts = body.shape.outside[k] && body.value[2 * k + 1];
    if (counts && !(best && best.value >= value)) best = { name: body.name, k, value };
  }
  now.spot = best;
  tell_spot();
  draw();
}

const body_of_spot = () => now.spot && bodies.find(({ name, shape }) => name === now.spot.name && now.spot.k < shape.n);

function tell_spot() {
  const body = body_of_spot();
  if (!body) {
    $("told").textContent = "";
    return;
  }
  const { k } = now.spot, axes = PLANE ? [0, 1] : [0, 1, 2], q = numbers(now.increment, body.i, "moved");
  const place = axes.map((c) => told(body.shape.points[3 * k + c])).join(", ");
  const way_of = axes.map((c) => told(moved(q[3 * k + c]), DATA.reach)).join(", ");
  $("told").textContent = `${value_told(body, k)}\n${body.name}, node at (${place}), displacement (${way_of})`;
}

function value_told({ value }, k) {
  const { field } = now;
  if (!value[2 * k + 1]) return `no ${field.title} here`;
  const found = value_at(value[2 * k]);
  return field.name === "state" ? `contact state: ${STATES[Math.round(found)][0]}`
    : `${field.title} ${told(found, field.high - field.low)} ${field.unit}`;
}

function place_spot() {
  const body = body_of_spot();
  $("spot").hidden = !body || now.hidden.has(body.name);
  if (!body) return;
  const q = seen(body.at, 3 * now.spot.k);
  $("spot").style.left = `${(q[0] - sight.middle[0]) * sight.zoom + canvas.clientWidth / 2}px`;
  $("spot").style.top = `${canvas.clientHeight / 2 - (q[1] - sight.middle[1]) * sight.zoom}px`;
}

// where x, y and z point to
function draw_axes() {
  const names = PLANE ? ["x", "y"] : ["x", "y", "z"], colours = ["#d0402b", "#2f9e44", "#3b76d6"];
  $("axes").innerHTML = names.map((name, c) => {
    const [x, y] = [sight.turn[c] * 24, -sight.turn[3 + c] * 24];
    return `<line x2="${x}" y2="${y}" stroke="${colours[c]}" stroke-width="2.5" stroke-linecap="round"/>`
      + `<text x="${x * 1.34}" y="${y * 1.34 + 4}" text-anchor="middle">${name}</text>`;
  }).join("");
}

function key(colour, words) {
  return `<span><i style="background:#${colour}"></i>${words}</span>`;
}

// of the increment that is shown
function extremes_told() {
  let [low, high] = [Infinity, -Infinity];
  for (const { shape, value } of bodies) for (let k = 0; k < shape.n; k++) if (value[2 * k + 1]) {
    low = Math.min(low, value[2 * k]);
    high = Math.max(high, value[2 * k]);
  }
  const span = now.field.high - now.field.low;
  return high < low ? "" : `, here ${told(value_at(low), span)} to ${told(value_at(high), span)}`;
}

function tell_legend() {
  const { field } = now, one = DATA.increments[now.increment], is_state = field.name === "state";
  $("title").textContent = field.title + (field.unit ? ` [${field.unit}]` : "") + (is_state ? "" : extremes_told());
  const stops = is_signed(field) ? MAPS.signed : MAPS.plain;
  const span = value_at(range[1]) - value_at(range[0]);
  $("bar").style.background = gradient(stops);
  $("bar").hidden = $("ticks").hidden = is_state;
  const beyond = now.range === "most" ? { 0: "≤ ", 1: "≥ " } : {};
  $("ticks").innerHTML = [0, 0.25, 0.5, 0.75, 1].map((w) =>
    `<span>${beyond[w] ?? ""}${told(value_at(range[0] + w * (range[1] - range[0])), span)}</span>`).join("");
  const grey = bodies.some(({ value }) => value.some((has, k) => k % 2 && !has));
  const marked = now.nodes && bodies.some((body) => body.states.length);
  // bonded and wet where there are any
  const found = STATES.filter((_, k) => k < 3 || bodies.some((body) => body.states.includes(k)));
  const states = marked ? found.map(([name, colour]) => key(colour, name)) : [];
  $("keys").innerHTML = [...states, ...(grey ? [key("b8bfc7", "no value")] : [])].join("");
  $("when").textContent = `${one.number}, t = ${told(one.time)}`;
  $("larger").textContent = `× ${told(now.factor)}`;
}

function choose(id, name, changed) {
  const input = $(id), is_box = input.type === "checkbox";
  input.addEventListener("input", () => {
    now[name] = is_box ? input.checked : input.value;
    changed();
  });
}

function make_fields() {
  const select = $("field");
  DATA.fields.forEach((field, i) => select.add(new Option(field.title, i)));
  const wanted = ["von_mises", "moment", "axial_force", "displacement"].map(
    (name) => DATA.fields.findIndex((f) => f.name === name));
  select.value = String(Math.max(wanted.find((i) => i >= 0) ?? 0, 0));
  now.field = DATA.fields[select.value];
  select.addEventListener("input", () => {
    now.field = DATA.fields[select.value];
    update();
  });
}

function make_film() {
  const slider = $("increment"), n = DATA.increments.length;
  let timer = 0;
  $("times").hidden = n < 2;
  slider.max = n - 1;
  slider.value = now.increment;
  const show = (i) => {
    now.increment = i;
    slider.value = i;
    update();
  };
  slider.addEventListener("input", () => show(Number(slider.value)));
  $("play").addEventListener("click", () => {
    if (timer) clearInterval(timer);
    timer = timer ? 0 : setInterval(() => show((now.increment + 1) % n), Math.min(Math.max(5000 / n, 80), 500));
    $("play").textContent = timer ? "Stop" : "Play";
  });
}

function make_bodies() {
  for (const name of new Set(shapes.map((shape) => shape.name))) {
    const label = document.createElement("label"), input = document.createElement("input");
    input.type = "checkbox";
    input.checked = true;
    input.addEventListener("input", () => {
      now.hidden[input.checked ? "delete" : "add"](name);
      draw();
    });
    label.append(input, " " + name);
    $("bodies").append(label);
  }
  $("bodies").hidden = shapes.length < 2;
}

function make_sights() {
  const buttons = PLANE ? { whole: null } : { ...VIEWS, whole: null };
  for (const [name, angles] of Object.entries(buttons)) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = { space: "askew", whole: "fit" }[name] ?? "along " + name;
    button.addEventListener("click", () => {
      if (angles) look(...angles);
      fit();
    });
    $("sights").append(button);
  }
  $("largest").addEventListener("click", point_at_largest);
}

function make_controls() {
  make_fields();
  make_film();
  make_bodies();
  make_sights();
  listen();
  look(...(PLANE ? VIEWS.z : VIEWS.space));
  $("amplify").value = 100;
  $("amplify").addEventListener("input", () => {
    now.factor = (DATA.factor * $("amplify").value) / 100;
    update();
  });
  choose("range", "range", update);
  choose("mesh", "mesh", draw);
  choose("nodes", "nodes", () => { tell_legend(); draw(); });
  choose("before", "before", draw);
  const recut = () => {
    $("depth").hidden = $("sides").hidden = now.cut === "";
    cut_bodies();
    draw();
  };
  for (const [id, name] of [["cut", "cut"], ["depth", "depth"], ["flip", "flip"]]) choose(id, name, recut);
  recut();
  $("cut").closest(".row").hidden = PLANE || !shapes.some((shape) => shape.triangles.length);
  $("nodes").parentElement.hidden = !DATA.fields.some((f) => f.name === "state");
  $("mesh").parentElement.hidden = !shapes.some((shape) => shape.edges.length);
  $("hint").textContent = (PLANE ? "Drag moves" : "Drag turns, with Shift or the right button it moves")
    + ", the wheel or two fingers zoom, a click tells the values of a node, a double click shows all.";
}
