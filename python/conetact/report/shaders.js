// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
// Programs for the graphics card: faces and thin lines, thick lines, round marks.
const COMMON = `#version 300 es
precision highp float;
uniform mat3 turn; uniform vec3 scale; uniform vec2 shift; uniform vec4 plane; uniform float nearer;
vec4 seen_at(vec3 p) { vec3 q = turn * p; return vec4(q.xy * scale.xy + shift, -q.z * scale.z - nearer, 1.0); }
`;
const COLOUR = `#version 300 es
precision highp float;
uniform sampler2D map; uniform vec2 range; uniform vec4 paint; uniform float flatly;
in vec2 v; in float beyond; in vec3 at; out vec4 colour;
vec3 looked_up() {
  if (v.y < 0.999) return vec3(0.72, 0.75, 0.78);
  return texture(map, vec2((clamp((v.x - range.x) / (range.y - range.x), 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}
`;
// each face has one normal, by how its place changes from pixel to pixel
const FACES = [COMMON + `
in vec3 place; in vec2 value; out vec2 v; out float beyond; out vec3 at;
void main() { gl_Position = seen_at(place); v = value; at = turn * place; beyond = dot(plane.xyz, place) - plane.w; }`,
COLOUR + `
void main() {
  if (beyond > 0.0) discard;
  if (paint.a > 0.0) { colour = vec4(paint.rgb * paint.a, paint.a); return; }
  vec3 n = normalize(cross(dFdx(at), dFdy(at)));
  float light = flatly > 0.0 ? 1.0 : 0.58 + 0.46 * abs(dot(n, normalize(vec3(0.25, 0.45, 0.85))));
  colour = vec4(min(looked_up() * light, 1.0), 1.0);
}`];
const LINES = [COMMON + `
in vec3 place; in vec3 other; in float side; in vec2 value; uniform vec2 pixels; uniform float width;
out vec2 v; out float beyond; out vec3 at;
void main() {
  vec4 a = seen_at(place), b = seen_at(other);
  vec2 along = (b.xy - a.xy) * pixels;
  vec2 d = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  gl_Position = a + vec4(vec2(-d.y, d.x) * side * width / pixels, 0.0, 0.0);
  v = value; at = turn * place; beyond = dot(plane.xyz, place) - plane.w;
}`, COLOUR + `
void main() { if (beyond > 0.0) discard; colour = vec4(looked_up(), 1.0); }`];
const MARKS = [COMMON + `
in vec3 place; in float state; uniform float width; out float beyond; flat out int kind;
void main() {
  gl_Position = seen_at(place); gl_PointSize = width; kind = int(state + 0.5);
  beyond = dot(plane.xyz, place) - plane.w;
}`, `#version 300 es
precision highp float;
uniform vec3 states[5]; in float beyond; flat in int kind; out vec4 colour;
void main() {
  float r = length(gl_PointCoord - 0.5);
  if (beyond > 0.0 || r > 0.5) discard;
  colour = vec4(r > 0.36 ? vec3(1.0) : states[kind], 1.0);
}`];

function program(gl, [vertex, fragment]) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  ["place", "value", "other", "side", "state"].forEach((name, i) => gl.bindAttribLocation(made, i, name));
  gl.linkProgram(made);
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
    const name = gl.getActiveUniform(made, i).name.replace("[0]", "");
    uniforms[name] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

// a buffer that is filled anew when bodies move
function fill(gl, buffers, name, data, target = gl.ARRAY_BUFFER) {
  buffers[name] ??= gl.createBuffer();
  gl.bindBuffer(target, buffers[name]);
  gl.bufferData(target, data, gl.DYNAMIC_DRAW);
}

// attributes by their numbers: place, value, other, side, state
function attach(gl, list) {
  for (let i = 0; i < 5; i++) gl.disableVertexAttribArray(i);
  for (const [i, buffer, size] of list) {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, size, gl.FLOAT, false, 0, 0);
  }
}
