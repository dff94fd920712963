// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
// The view of the page: surfaces, members and contact nodes of a run, drawn by WebGL 2.
//
// It is no library. three.js (600 kB and more) and vtk.js (several MB) would be most of a page that has to stand
// alone, bring licences of their own into it, and change with each version. What a report needs is a few hundred
// lines: triangles with flat shades, a table of colours, and places that are computed here when a slider moves.
const $ = (id) => document.getElementById(id);
const DATA = JSON.parse($("data").textContent);
const NOTHING = 65535, PLANE = DATA.dimension === 2;

function decoded(text, Kind) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return new Kind(bytes.buffer);
}

function mean_length(points, ends) {
  let sum = 0;
  for (let k = 0; k < ends.length; k += 2)
    sum += Math.hypot(...[0, 1, 2].map((c) => points[3 * ends[k] + c] - points[3 * ends[k + 1] + c]));
  return ends.length ? (2 * sum) / ends.length : 0;
}

class Shape {
  constructor(data) {
    this.name = data.name;
    this.points = decoded(data.points, Float32Array);
    const parts = ["triangles", "edges", "outline", "lines", "border", "cells"];
    for (const part of parts) this[part] = decoded(data[part], Uint32Array);
    this.n = this.points.length / 3;
    this.buffers = {};
    this.outside = new Uint8Array(this.n); // nodes that can be pointed at
    for (const part of [this.triangles, this.lines]) for (const i of part) this.outside[i] = 1;
    this.spacing = mean_length(this.points, this.edges.length ? this.edges : this.lines);
  }
}

// What is shown now; controls change it and call `update` or `draw`.
const now = { increment: DATA.increments.length - 1, factor: DATA.factor, field: null, range: "all", hidden: new Set(),
  spot: null, cut: "", depth: 500, flip: false, mesh: false, nodes: true, before: false };
const shapes = DATA.shapes.map((data) => new Shape(data));
const cache = new Map();
const canvas = document.querySelector("#stage canvas");
const box = { low: [0, 0, 0], high: [0, 0, 0] }; // of the bodies as they are drawn
const centre = centre_of(shapes);
let gl, programs, textures, bodies = [], range = [0, 1], waiting = false;

function centre_of(all) {
  const low = [Infinity, Infinity, Infinity], high = low.map((x) => -x);
  for (const { points } of all) for (let i = 0; i < points.length; i++) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  return low.map((x, i) => (x + high[i]) / 2);
}

// 16 bits of one body and increment
function numbers(increment, i, name) {
  const key = `${increment} ${i} ${name}`;
  if (!cache.has(key)) {
    const frame = DATA.film[increment][i], text = name === "moved" ? frame.moved : frame.values[name];
    cache.set(key, text ? decoded(text, Uint16Array) : null);
  }
  return cache.get(key);
}

const moved = (q) => (q / (NOTHING - 1)) * 2 * DATA.reach - DATA.reach;

// places on the stage, relative to the centre
function places(shape, increment, i, factor) {
  const q = numbers(increment, i, "moved"), out = new Float32Array(3 * shape.n);
  for (let k = 0; k < out.length; k++) out[k] = shape.points[k] - centre[k % 3] + factor * moved(q[k]);
  return out;
}

// pairs: the value on a scale of the field from 0 to 1, and whether there is one
function values(shape, increment, i, field) {
  const out = new Float32Array(2 * shape.n);
  if (field.kind === "displacement") {
    const q = numbers(increment, i, "moved"), span = field.high - field.low || 1;
    for (let k = 0; k < shape.n; k++) {
      const u = [0, 1, 2].map((c) => moved(q[3 * k + c]));
      out[2 * k] = ((field.axis < 0 ? Math.hypot(...u) : u[field.axis]) - field.low) / span;
      out[2 * k + 1] = 1;
    }
    return out;
  }
  const q = numbers(increment, i, field.name);
  for (let k = 0; q && k < shape.n; k++) {
    if (q[k] === NOTHING) continue;
    out[2 * k] = q[k] / (NOTHING - 1);
    out[2 * k + 1] = 1;
  }
  return out;
}

// nodes that may touch, with their states
function contact_nodes(body) {
  const field = DATA.fields.find((f) => f.name === "state"), q = field && numbers(now.increment, body.i, "state");
  const at = [], states = [];
  for (let k = 0; q && k < body.shape.n; k++) {
    if (q[k] === NOTHING) continue;
    at.push(...body.at.subarray(3 * k, 3 * k + 3));
    states.push(Math.round(field.low + (q[k] / (NOTHING - 1)) * (field.high - field.low)));
  }
  return [new Float32Array(at), new Float32Array(states)];
}

// four corners for each line, drawn as two triangles
function thick(body, ends) {
  const at = [], other = [], side = [], value = [], index = [];
  for (let k = 0; k < ends.length; k += 2) {
    const [a, b] = [ends[k], ends[k + 1]], first = side.length;
    for (const [p, q, s] of [[a, b, 1], [a, b, -1], [b, a, -1], [b, a, 1]]) {
      at.push(...body.at.subarray(3 * p, 3 * p + 3));
      other.push(...body.at.subarray(3 * q, 3 * q + 3));
      value.push(body.value[2 * p], body.value[2 * p + 1]);
      side.push(s);
    }
    index.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
  }
  return { at: new Float32Array(at), other: new Float32Array(other), side: new Float32Array(side),
    value: new Float32Array(value), index: new Uint32Array(index) };
}

// on a border of a plane body only what may touch
function touching(body) {
  const { border } = body.shape, kept = [];
  if (now.field.kind !== "contact") return kept;
  for (let k = 0; k < border.length; k += 2)
    if (body.value[2 * border[k] + 1] && body.value[2 * border[k + 1] + 1]) kept.push(border[k], border[k + 1]);
  return kept;
}

function make_body(frame, i) {
  const shape = shapes[frame.shape], body = { i, shape, name: shape.name };
  body.at = places(shape, now.increment, i, now.factor);
  body.value = values(shape, now.increment, i, now.field);
  [body.nodes, body.states] = contact_nodes(body);
  body.thick = thick(body, shape.lines.length ? shape.lines : touching(body));
  return body;
}

function find_box() {
  box.low = [Infinity, Infinity, Infinity];
  box.high = box.low.map((x) => -x);
  for (const { at } of bodies) for (let k = 0; k < at.length; k++) {
    box.low[k % 3] = Math.min(box.low[k % 3], at[k]);
    box.high[k % 3] = Math.max(box.high[k % 3], at[k]);
  }
}

// least and largest value to colour, on the scale of the field
function find_range() {
  const { field } = now, on_scale = (x) => (x - field.low) / (field.high - field.low || 1);
  let found = [0, 1];
  if (now.range !== "all") {
    const all = [];
    for (const { shape, value } of bodies)
      for (let k = 0; k < shape.n; k++) if (value[2 * k + 1]) all.push(value[2 * k]);
    all.sort((a, b) => a - b);
    const out = now.range === "most" ? Math.floor(all.length / 100) : 0;
    if (all.length) found = [all[out], all[all.length - 1 - out]];
  }
  if (is_signed(field)) { // white is 0
    const zero = on_scale(0), reach = Math.max(found[1] - zero, zero - found[0]) || 1;
    found = [zero - reach, zero + reach];
  }
  range = found[1] - found[0] > 1e-9 ? found : [found[0] - 0.5, found[0] + 0.5];
}

const is_signed = (field) => field.low < 0 && field.high > 0 && field.name !== "state";
const value_at = (scaled) => now.field.low + scaled * (now.field.high - now.field.low);

// Where a plane cuts tetrahedra: triangles with values. d: distances of nodes, of both signs.
function section(body, d) {
  const { cells } = body.shape, at = [], value = [];
  const add = (a, b) => {
    const w = d[a] / (d[a] - d[b]);
    for (let c = 0; c < 3; c++) at.push((1 - w) * body.at[3 * a + c] + w * body.at[3 * b + c]);
    for (let c = 0; c < 2; c++) value.push((1 - w) * body.value[2 * a + c] + w * body.value[2 * b + c]);
  };
  for (let k = 0; k < cells.length; k += 4) {
    const side = d[cells[k]] > 0;
    if (side === d[cells[k + 1]] > 0 && side === d[cells[k + 2]] > 0 && side === d[cells[k + 3]] > 0) continue;
    const inside = [], beyond = [];
    for (let c = 0; c < 4; c++) (d[cells[k + c]] > 0 ? beyond : inside).push(cells[k + c]);
    if (inside.length === 2) {
      const [a, b] = inside, [p, q] = beyond;
      for (const [m, n] of [[a, p], [a, q], [b, q], [a, p], [b, q], [b, p]]) add(m, n);
    } else {
      const [one, three] = inside.length === 1 ? [inside[0], beyond] : [beyond[0], inside];
      for (const other of three) add(one, other);
    }
  }
  return { at: new Float32Array(at), value: new Float32Array(value) };
}

// normal and distance of what is cut away; nothing where no section is chosen
function plane() {
  if (now.cut === "") return [0, 0, 0, 1];
  const axis = Number(now.cut), sign = now.flip ? -1 : 1, n = [0, 0, 0];
  n[axis] = sign;
  return [...n, sign * (box.low[axis] + (box.high[axis] - box.low[axis]) * (now.depth / 1000))];
}

function cut_bodies() {
  const [x, y, z, w] = plane();
  for (const body of bodies) {
    body.section = null;
    if (now.cut === "" || !body.shape.cells.length) continue;
    const d = new Float32Array(body.shape.n);
    for (let k = 0; k < d.length; k++) d[k] = x * body.at[3 * k] + y * body.at[3 * k + 1] + z * body.at[3 * k + 2] - w;
    body.section = section(body, d);
    const b = body.shape.buffers;
    fill(gl, b, "section", body.section.at);
    fill(gl, b, "section_value", body.section.value);
  }
}

function upload(body) {
  const b = body.shape.buffers, { shape, thick: t } = body, index = gl.ELEMENT_ARRAY_BUFFER;
  fill(gl, b, "at", body.at);
  fill(gl, b, "value", body.value);
  fill(gl, b, "nodes", body.nodes);
  fill(gl, b, "states", body.states);
  for (const part of ["at", "other", "side", "value"]) fill(gl, b, "thick_" + part, t[part]);
  fill(gl, b, "thick", t.index, index);
  if (b.triangles) return;
  for (const part of ["triangles", "edges", "outline", "lines"]) fill(gl, b, part, shape[part], index);
  fill(gl, b, "before", shape.points.map((x, k) => x - centre[k % 3]));
}

// all that depends on increment, factor and field
function update() {
  bodies = DATA.film[now.increment].map(make_body);
  find_box();
  find_range();
  bodies.forEach(upload);
  cut_bodies();
  tell_legend();
  tell_spot();
  draw();
}

function use(made, more = {}) {
  gl.useProgram(made.made);
  const { clientWidth: w, clientHeight: h } = canvas, [x, y] = sight.middle;
  const k = 2 * sight.zoom, deep = 0.4 / (sight.size + now.factor * DATA.reach);
  const set = { nearer: 0, width: 1, flatly: PLANE ? 1 : 0, ...more }, u = made.uniforms;
  gl.uniformMatrix3fv(u.turn, true, sight.turn);
  gl.uniform3f(u.scale, k / w, k / h, deep);
  gl.uniform2f(u.shift, (-x * k) / w, (-y * k) / h);
  gl.uniform4fv(u.plane, set.plane ?? plane());
  if (u.range) gl.uniform2fv(u.range, range);
  if (u.paint) gl.uniform4fv(u.paint, set.paint ?? [0, 0, 0, 0]);
  if (u.pixels) gl.uniform2f(u.pixels, w / 2, h / 2);
  if (u.states) gl.uniform3fv(u.states, STATES.flatMap(([, c]) => rgb(c).map((v) => v / 255)));
  for (const name of ["nearer", "width", "flatly"]) if (u[name]) gl.uniform1f(u[name], set[name]);
}

function elements(buffer, kind, count) {
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
  gl.drawElements(kind, count, gl.UNSIGNED_INT, 0);
}

function draw_faces(body) {
  const b = body.shape.buffers;
  attach(gl, [[0, b.at, 3], [1, b.value, 2]]);
  if (PLANE && now.field.kind === "contact") gl.disableVertexAttribArray(1); // inside nothing touches
  elements(b.triangles, gl.TRIANGLES, body.shape.triangles.length);
  if (!body.section) return;
  use(programs.faces, { plane: [0, 0, 0, 1], flatly: 1 });
  attach(gl, [[0, b.section, 3], [1, b.section_value, 2]]);
  gl.drawArrays(gl.TRIANGLES, 0, body.section.at.length / 3);
}

function draw_lines(body) {
  const b = body.shape.buffers, { shape } = body, dark = matchMedia("(prefers-color-scheme: dark)").matches;
  attach(gl, [[0, b.at, 3]]);
  if (now.mesh) {
    use(programs.faces, { paint: [0, 0, 0, 0.32], nearer: 1e-4 });
    elements(b.edges, gl.LINES, shape.edges.length);
  }
  use(programs.faces, { paint: [0, 0, 0, 0.75], nearer: 2e-4 });
  elements(b.outline, gl.LINES, shape.outline.length);
  if (!now.before) return;
  attach(gl, [[0, b.before, 3]]);
  use(programs.faces, { paint: dark ? [1, 1, 1, 0.45] : [0.2, 0.25, 0.3, 0.5], nearer: 1e-4 });
  const part = shape.lines.length ? "lines" : "outline";
  elements(b[part], gl.LINES, shape[part].length);
}

function draw_marks(body) {
  const b = body.shape.buffers, { shape, thick: t } = body, dots = canvas.width / canvas.clientWidth;
  use(programs.lines, { width: shape.lines.length ? 2.2 : 3, nearer: 3e-4 });
  attach(gl, [[0, b.thick_at, 3], [1, b.thick_value, 2], [2, b.thick_other, 3], [3, b.thick_side, 1]]);
  elements(b.thick, gl.TRIANGLES, t.index.length);
  if (!now.nodes || !body.states.length) return;
  const width = Math.min(Math.max(0.3 * shape.spacing * sight.zoom, 3.5), 9);
  use(programs.marks, { width: width * dots, nearer: 1.5e-3 });
  attach(gl, [[0, b.nodes, 3], [4, b.states, 1]]);
  gl.drawArrays(gl.POINTS, 0, body.states.length);
}

function paint() {
  waiting = false;
  const dots = Math.min(devicePixelRatio || 1, 2);
  canvas.width = Math.round(canvas.clientWidth * dots);
  canvas.height = Math.round(canvas.clientHeight * dots);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.bindTexture(gl.TEXTURE_2D, textures[is_signed(now.field) ? "signed" : "plain"]);
  const shown = bodies.filter((body) => !now.hidden.has(body.name));
  for (const body of shown) {
    use(programs.faces);
    draw_faces(body);
  }
  shown.forEach(draw_lines);
  shown.forEach(draw_marks);
  draw_axes();
  place_spot();
}

function draw() {
  if (!waiting) requestAnimationFrame(paint);
  waiting = true;
}

function texture(stops) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp(stops));
  for (const name of ["MIN_FILTER", "MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], gl.LINEAR);
  for (const name of ["WRAP_S", "WRAP_T"]) gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], gl.CLAMP_TO_EDGE);
  return made;
}

function prepare() {
  programs = { faces: program(gl, FACES), lines: program(gl, LINES), marks: program(gl, MARKS) };
  textures = { plain: texture(MAPS.plain), signed: texture(MAPS.signed) };
  for (const shape of shapes) shape.buffers = {};
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  gl.enable(gl.POLYGON_OFFSET_FILL);
  gl.polygonOffset(1, 1);
}

function start() {
  gl = canvas.getContext("webgl2", { antialias: true, alpha: true });
  if (!gl) {
    $("told").textContent = "This browser has no WebGL 2: bodies are not drawn, all else of the page is there.";
    return;
  }
  prepare();
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { prepare(); update(); });
  make_controls();
  update();
  fit();
  new ResizeObserver(resized).observe(canvas);
}

start();
