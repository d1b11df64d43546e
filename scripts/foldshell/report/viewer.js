"use strict";
// The 3D view of a design: WebGL 2 without libraries, arrays from the page itself.

const byId = (id) => document.getElementById(id);
const facts = JSON.parse(byId("facts").textContent);
const STEPS = 65534; // of real values; 65535 is nan
const KINDS = { uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array };

async function readArrays() {
  const text = atob(byId("arrays").textContent.trim());
  const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const data = await new Response(stream).arrayBuffer();
  const arrays = {};
  for (const { name, type, shape, offset, low, step } of facts.arrays) {
    const count = shape.reduce((a, b) => a * b, 1);
    const numbers = new KINDS[type](data, offset, count);
    arrays[name] = step === undefined ? numbers
      : Float32Array.from(numbers, (n) => (n > STEPS ? NaN : low + step * n));
  }
  return arrays;
}

// ---- drawing -------------------------------------------------------------------------------

const HEAD = `#version 300 es
precision highp float;
uniform mat4 camera; uniform vec3 eye; uniform float factor; uniform vec2 size;
`;
const SURFACE = [HEAD + `
layout(location=0) in vec3 place; layout(location=1) in vec3 moved;
layout(location=2) in float value; layout(location=3) in float panel;
out vec3 at; out float share; flat out float mine;
void main() {
  at = place + factor * moved; share = value; mine = panel;
  gl_Position = camera * vec4(at, 1.0);
}`, HEAD + `
in vec3 at; in float share; flat in float mine; out vec4 colour;
uniform sampler2D map; uniform float chosen; uniform bool limited;
void main() {
  vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
  float light = 0.70 + 0.34 * abs(dot(normal, normalize(eye - at)));
  vec3 own = texture(map, vec2(clamp(share, 0.0, 1.0) * (63.0 / 64.0) + 0.5 / 64.0, 0.5)).rgb;
  if (isnan(share) || share < -9.0) own = vec3(0.80);
  else if (limited && share > 1.00001) own = vec3(0.745, 0.0, 0.157);
  if (mine == chosen) own = mix(own, vec3(1.0), 0.45);
  colour = vec4(own * light, 1.0);
}`];
const LINE = [HEAD + `
layout(location=0) in vec3 a; layout(location=1) in vec3 b;
layout(location=2) in vec3 ma; layout(location=3) in vec3 mb;
layout(location=4) in vec2 along; layout(location=5) in vec2 corner;
uniform float width; uniform float lift; out float run;
void main() {
  vec3 from = a + factor * ma, to = b + factor * mb;
  vec4 p = camera * vec4(from + lift * (eye - from), 1.0);
  vec4 q = camera * vec4(to + lift * (eye - to), 1.0);
  vec2 way = (q.xy / q.w - p.xy / p.w) * size;
  vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(0.0);
  vec4 here = corner.x < 0.5 ? p : q;
  run = mix(along.x, along.y, corner.x);
  gl_Position = here + vec4(across * corner.y * width / size * here.w, 0.0, 0.0);
}`, HEAD + `
in float run; out vec4 colour; uniform vec3 ink; uniform float dash;
void main() { if (dash > 0.0 && fract(run / dash) > 0.55) discard; colour = vec4(ink, 1.0); }`];
const MARK = [HEAD + `
layout(location=0) in vec3 place; uniform float lift;
void main() { gl_Position = camera * vec4(place + lift * (eye - place), 1.0);
  gl_PointSize = size.y / 55.0; }`, HEAD + `
out vec4 colour;
void main() { vec2 p = gl_PointCoord;
  if (abs(p.x - 0.5) > 0.5 * p.y || p.y < 0.0) discard; colour = vec4(0.2, 0.2, 0.2, 1.0); }`];

class Renderer {
  constructor(canvas, arrays) {
    this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("this browser offers no WebGL 2");
    this.canvas = canvas;
    this.arrays = arrays;
    this.programs = { surface: this.compile(SURFACE), line: this.compile(LINE),
      mark: this.compile(MARK) };
    this.buffers = {};
    this.map = this.gl.createTexture();
    const expand = (values, width) => this.expand(values, width);
    this.upload("place", expand(arrays.nodes, 3));
    this.upload("panel", this.perTriangle(arrays.panel));
    this.lines = {};
    for (const kind of ["mountain", "valley", "flat", "border"]) this.addLines(kind);
    const marks = arrays.supports;
    this.upload("marks", Float32Array.from({ length: 3 * marks.length },
      (_, k) => arrays.nodes[3 * marks[Math.floor(k / 3)] + (k % 3)]));
    this.upload("corner", new Float32Array([0, -1, 1, -1, 0, 1, 0, 1, 1, -1, 1, 1]));
  }

  compile([vertex, fragment]) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
        throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    const uniforms = {};
    for (const name of ["camera", "eye", "factor", "size", "map", "chosen", "limited", "width",
      "lift", "ink", "dash"]) uniforms[name] = gl.getUniformLocation(program, name);
    return { program, uniforms };
  }

  expand(values, width) { // node values to the three corners of each triangle
    const corners = this.arrays.triangles, out = new Float32Array(corners.length * width);
    for (let k = 0; k < corners.length; k++)
      for (let c = 0; c < width; c++) out[width * k + c] = values[width * corners[k] + c];
    return out;
  }

  perTriangle(values, panels) {
    const count = this.arrays.triangles.length, out = new Float32Array(count);
    for (let k = 0; k < count; k++) {
      const triangle = Math.floor(k / 3);
      out[k] = values[panels ? panels[triangle] : triangle];
    }
    return out;
  }

  upload(name, data) {
    const gl = this.gl;
    this.buffers[name] ??= gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  }

  addLines(kind) { // segments with the length run along their crease, for dashes
    const lines = this.arrays["crease_" + kind];
    const shape = facts.arrays.find((a) => a.name === "crease_" + kind).shape;
    const from = [], to = [], along = [], nodes = this.arrays.nodes;
    for (let k = 0; k < shape[0]; k++) {
      let run = 0;
      for (let i = 0; i + 1 < shape[1]; i++) {
        const a = lines[k * shape[1] + i], b = lines[k * shape[1] + i + 1];
        const length = Math.hypot(...[0, 1, 2].map((c) => nodes[3 * b + c] - nodes[3 * a + c]));
        from.push(a); to.push(b); along.push(run, run + length);
        run += length;
      }
    }
    this.lines[kind] = { from, to };
    this.upload(kind + "_along", new Float32Array(along));
    this.gather(kind, "", nodes);
  }

  gather(kind, name, values) {
    const { from, to } = this.lines[kind];
    const pick = (ends) => Float32Array.from({ length: 3 * ends.length },
      (_, k) => values[3 * ends[Math.floor(k / 3)] + (k % 3)]);
    this.upload(`${kind}_${name}from`, pick(from));
    this.upload(`${kind}_${name}to`, pick(to));
  }

  setShape(moved) {
    const values = moved ?? new Float32Array(this.arrays.nodes.length);
    this.moved = values;
    this.upload("moved", this.expand(values, 3));
    for (const kind of Object.keys(this.lines)) this.gather(kind, "moved_", values);
  }

  setField(field) {
    const gl = this.gl, values = this.arrays["field_" + field.name];
    const share = field.at === "node" ? this.expand(values, 1)
      : this.perTriangle(values, field.at === "panel" ? this.arrays.panel : null);
    for (let k = 0; k < share.length; k++)
      share[k] = Number.isNaN(share[k]) ? -10 : (share[k] - field.low) / (field.high - field.low);
    this.upload("value", share);
    this.limited = field.limit !== null;
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    const colours = Uint8Array.from(field.colours.match(/../g), (c) => parseInt(c, 16));
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, colours.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE,
      colours);
    const smooth = field.classes ? gl.NEAREST : gl.LINEAR;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, smooth);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, smooth);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  }

  use(name, view) {
    const gl = this.gl, { program, uniforms } = this.programs[name];
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.camera, false, view.matrix);
    gl.uniform3fv(uniforms.eye, view.eye);
    gl.uniform1f(uniforms.factor, view.factor);
    gl.uniform2f(uniforms.size, this.canvas.width, this.canvas.height);
    return uniforms;
  }

  bind(place, name, width, divisor = 0) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, width, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(place, divisor);
  }

  release(count) { for (let k = 0; k < count; k++) this.gl.disableVertexAttribArray(k); }

  draw(view, chosen, showLines) {
    const gl = this.gl, ratio = window.devicePixelRatio || 1;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const surface = this.use("surface", view);
    gl.uniform1f(surface.chosen, chosen);
    gl.uniform1i(surface.limited, this.limited);
    ["place", "moved", "value", "panel"].forEach((n, k) => this.bind(k, n, k < 2 ? 3 : 1));
    gl.drawArrays(gl.TRIANGLES, 0, this.arrays.triangles.length);
    this.release(4);
    if (showLines) {
      const line = this.use("line", view);
      const thin = Math.min(1, Math.sqrt(350 / this.arrays.panel_thickness.length)) * ratio;
      gl.uniform1f(line.lift, 0.0015);
      for (const [kind, width, grey, dash] of [["flat", 0.8, 0.35, 0], ["border", 2.2, 0, 0],
        ["mountain", 1.8, 0, 0], ["valley", 1.8, 0, view.dash]]) {
        gl.uniform1f(line.width, width * thin);
        gl.uniform3f(line.ink, grey, grey, grey);
        gl.uniform1f(line.dash, dash);
        this.bind(0, kind + "_from", 3, 1); this.bind(1, kind + "_to", 3, 1);
        this.bind(2, kind + "_moved_from", 3, 1); this.bind(3, kind + "_moved_to", 3, 1);
        this.bind(4, kind + "_along", 2, 1); this.bind(5, "corner", 2);
        gl.drawArraysInstanced(gl.TRIANGLES, 0, 6, this.lines[kind].from.length);
      }
      this.release(6);
      const mark = this.use("mark", view);
      gl.uniform1f(mark.lift, 0.002);
      this.bind(0, "marks", 3);
      gl.drawArrays(gl.POINTS, 0, this.arrays.supports.length);
      this.release(1);
    }
  }
}

// ---- camera: turns about the middle of the sheet, z up ---------------------------------------

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const ANGLE = (26 * Math.PI) / 180;

class Camera {
  constructor(nodes) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    nodes.forEach((v, k) => {
      low[k % 3] = Math.min(low[k % 3], v);
      high[k % 3] = Math.max(high[k % 3], v);
    });
    this.middle = low.map((v, c) => (v + high[c]) / 2);
    this.radius = Math.hypot(...low.map((v, c) => (high[c] - v) / 2));
    const step = Math.max(1, Math.floor(nodes.length / 3 / 2000));
    this.sample = [];
    for (let k = 0; k < nodes.length; k += 3 * step) this.sample.push(nodes.slice(k, k + 3));
    this.reset();
  }

  reset() {
    this.turn = -2.2;
    this.rise = 0.58;
    this.zoom = 1;
    this.aspect = 0; // fits anew when it is drawn
  }

  axes() {
    const away = [Math.cos(this.rise) * Math.cos(this.turn),
      Math.cos(this.rise) * Math.sin(this.turn), Math.sin(this.rise)];
    const right = [-Math.sin(this.turn), Math.cos(this.turn), 0];
    return { away, right, up: cross(away, right) };
  }

  fit(aspect) { // the sheet fills nine tenths of the view, and lies in its middle
    const { away, right, up } = this.axes(), size = Math.tan(ANGLE / 2);
    this.focus = [...this.middle];
    this.distance = this.radius / Math.sin(ANGLE / 2);
    for (let round = 0; round < 12; round++) {
      let [left, most, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
      for (const node of this.sample) {
        const from = this.focus.map((v, c) => node[c] - v);
        const depth = (this.distance - dot(away, from)) * size;
        const x = dot(right, from) / depth / aspect, y = dot(up, from) / depth;
        left = Math.min(left, x); most = Math.max(most, x);
        low = Math.min(low, y); high = Math.max(high, y);
      }
      const scale = this.distance * size;
      this.focus = this.focus.map((v, c) => v + scale * (aspect * right[c] * (left + most) / 2
        + up[c] * (low + high) / 2));
      this.distance *= Math.max(most - left, high - low) / 1.8;
    }
    this.aspect = aspect;
  }

  view(aspect, factor) {
    if (!this.aspect) this.fit(aspect);
    const { away, right, up } = this.axes();
    const distance = (this.distance * Math.max(1, this.aspect / aspect)) / this.zoom;
    const eye = this.focus.map((v, c) => v + distance * away[c]);
    const near = Math.max(distance - 3 * this.radius, distance / 200);
    const far = distance + 3 * this.radius, size = 1 / Math.tan(ANGLE / 2);
    const rows = [right.map((v) => (v * size) / aspect), up.map((v) => v * size),
      away.map((v) => (-v * (far + near)) / (far - near)), away.map((v) => -v)];
    const depth = (-2 * far * near) / (far - near), matrix = [];
    for (let c = 0; c < 3; c++) for (let r = 0; r < 4; r++) matrix.push(rows[r][c]);
    rows.forEach((row, r) => matrix.push(-dot(row, eye) + (r === 2 ? depth : 0)));
    return { matrix, eye, right, up, away, distance, aspect, factor, dash: this.radius / 40 };
  }
}

function pickPanel(view, x, y, arrays, moved) { // nearest triangle on the ray through x, y
  const size = Math.tan(ANGLE / 2), { nodes, triangles, panel } = arrays;
  const ray = [0, 1, 2].map((c) => -view.away[c] + x * size * view.aspect * view.right[c]
    + y * size * view.up[c]);
  let nearest = Infinity, found = -1;
  const at = (node) => [0, 1, 2].map((c) =>
    nodes[3 * node + c] + view.factor * moved[3 * node + c] - view.eye[c]);
  for (let k = 0; k < triangles.length; k += 3) {
    const a = at(triangles[k]), b = at(triangles[k + 1]), d = at(triangles[k + 2]);
    const u = b.map((v, c) => v - a[c]), w = d.map((v, c) => v - a[c]);
    const p = cross(ray, w), volume = dot(u, p);
    if (Math.abs(volume) < 1e-12) continue;
    const back = a.map((v) => -v), s = dot(back, p) / volume;
    if (s < 0 || s > 1) continue;
    const q = cross(back, u), t = dot(ray, q) / volume;
    if (t < 0 || s + t > 1) continue;
    const far = dot(w, q) / volume;
    if (far > 0 && far < nearest) { nearest = far; found = panel[k / 3]; }
  }
  return found;
}

// ---- the page ---------------------------------------------------------------------------------

function drawLegend(field) {
  const colours = field.colours.match(/.{6}/g).map((c) => "#" + c);
  byId("quantity").textContent = field.words;
  const bar = byId("bar"), ticks = byId("ticks"), place = (v) =>
    (100 * (v - field.low)) / (field.high - field.low);
  ticks.replaceChildren();
  const add = (share, words) => {
    const tick = document.createElement("span");
    tick.style.left = share + "%";
    tick.textContent = words;
    ticks.append(tick);
  };
  if (field.classes) {
    const names = Object.entries(field.classes), width = 100 / names.length;
    const pick = (k) => colours[Math.min(63, Math.floor(((k + 0.5) / names.length) * 64))];
    bar.style.background = "linear-gradient(to right," + names.map((_, k) =>
      `${pick(k)} ${k * width}% ${(k + 1) * width}%`).join(",") + ")";
    names.forEach(([, words], k) => add((k + 0.5) * width, words));
  } else {
    bar.style.background = `linear-gradient(to right,${colours.join(",")})`;
    field.ticks.forEach(([value, words]) => add(place(value), words));
  }
  byId("above").hidden = field.limit === null;
  byId("above-words").textContent = field.limit === null ? "" : `above ${field.limit}: ${field.above}`;
}

function describePanel(panel, arrays) {
  if (panel < 0) return "Click a panel to read its values.";
  if (panel >= arrays.panel_zigzag.length)
    return `edge beam · thickness ${(1000 * arrays.panel_thickness[panel]).toFixed(1)} mm`;
  const words = [`panel ${panel}`, `zigzag ${arrays.panel_zigzag[panel]}`,
    `strip ${arrays.panel_strip[panel]}`,
    `thickness ${(1000 * arrays.panel_thickness[panel]).toFixed(1)} mm`];
  if (arrays.panel_utilization)
    words.push(`mean utilization ${arrays.panel_utilization[panel].toFixed(2)}`);
  words.push(`planarity ${(100 * arrays.panel_planarity[panel]).toFixed(2)} %`);
  if (arrays.panel_class) words.push(`class ${arrays.panel_class[panel]}`);
  return words.join(" · ");
}

class App {
  constructor(arrays) {
    this.canvas = byId("view");
    this.arrays = arrays;
    this.renderer = new Renderer(this.canvas, arrays);
    this.camera = new Camera(arrays.nodes);
    this.chosen = -1;
    this.fill("field", facts.fields.map((f) => f.words));
    this.fill("shape", facts.shapes.map((s) => s.words));
    byId("deform-controls").hidden = !facts.shapes.length;
    this.listen();
    this.setField();
    this.setShape();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  fill(id, names) {
    byId(id).replaceChildren(...names.map((name, k) => new Option(name, k)));
  }

  get shape() { return facts.shapes[byId("shape").value]; }

  get factor() {
    return this.shape ? (this.shape.factor * byId("deform").value) / 50 : 0;
  }

  setField() {
    const field = facts.fields[byId("field").value];
    this.renderer.setField(field);
    drawLegend(field);
    this.draw();
  }

  setShape() {
    this.renderer.setShape(this.shape && this.arrays["shape_" + this.shape.name]);
    this.draw();
  }

  choose(panel) {
    this.chosen = panel;
    byId("picked").textContent = describePanel(panel, this.arrays);
    this.draw();
  }

  listen() {
    byId("field").onchange = () => this.setField();
    byId("shape").onchange = () => this.setShape();
    byId("deform").oninput = () => this.draw();
    byId("creases").onchange = () => this.draw();
    byId("home").onclick = () => { this.camera.reset(); this.draw(); };
    const canvas = this.canvas, camera = this.camera, fingers = new Map();
    let travelled = 0;
    canvas.onpointerdown = (e) => {
      canvas.setPointerCapture(e.pointerId);
      fingers.set(e.pointerId, [e.clientX, e.clientY]);
      travelled = 0;
    };
    canvas.onpointermove = (e) => {
      const last = fingers.get(e.pointerId);
      if (!last) return;
      const dx = e.clientX - last[0], dy = e.clientY - last[1];
      travelled += Math.abs(dx) + Math.abs(dy);
      const others = [...fingers].filter(([id]) => id !== e.pointerId);
      if (others.length) {
        const [x, y] = others[0][1];
        this.zoom(Math.hypot(e.clientX - x, e.clientY - y)
          / Math.max(1, Math.hypot(last[0] - x, last[1] - y)));
      } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) this.pan(dx, dy);
      else this.rotate(-dx * 0.008, dy * 0.008);
      fingers.set(e.pointerId, [e.clientX, e.clientY]);
      this.draw();
    };
    canvas.onpointerup = (e) => {
      if (fingers.delete(e.pointerId) && travelled < 5) this.choose(this.pick(e));
    };
    canvas.onpointercancel = (e) => fingers.delete(e.pointerId);
    canvas.oncontextmenu = (e) => e.preventDefault();
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.zoom(Math.exp(-0.0015 * e.deltaY));
    }, { passive: false });
    canvas.onkeydown = (e) => {
      const step = 0.1, keys = { ArrowLeft: [-step, 0], ArrowRight: [step, 0],
        ArrowUp: [0, step], ArrowDown: [0, -step] };
      if (keys[e.key]) this.rotate(...keys[e.key]);
      else if (e.key === "+" || e.key === "=") this.zoom(1.15);
      else if (e.key === "-") this.zoom(1 / 1.15);
      else if (e.key === "0") camera.reset();
      else return;
      e.preventDefault();
      this.draw();
    };
  }

  rotate(turn, rise) {
    this.camera.turn += turn;
    this.camera.rise = Math.max(-1.5, Math.min(1.57, this.camera.rise + rise));
  }

  zoom(by) {
    this.camera.zoom = Math.max(0.3, Math.min(30, this.camera.zoom * by));
    this.draw();
  }

  pan(dx, dy) {
    const view = this.lastView, box = this.canvas.getBoundingClientRect();
    const scale = (2 * view.distance * Math.tan(ANGLE / 2)) / box.height;
    this.camera.focus = this.camera.focus.map((v, c) =>
      v + scale * (dy * view.up[c] - dx * view.right[c]));
  }

  pick(event) {
    const box = this.canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    return pickPanel(this.lastView, x, y, this.arrays, this.renderer.moved);
  }

  draw() {
    this.waiting ??= requestAnimationFrame(() => { this.waiting = undefined; this.drawNow(); });
  }

  drawNow() {
    const ratio = window.devicePixelRatio || 1, canvas = this.canvas;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height)
      Object.assign(canvas, { width, height });
    this.lastView = this.camera.view(width / height, this.factor);
    this.renderer.draw(this.lastView, this.chosen, byId("creases").checked);
    drawAxes(this.lastView);
    const factor = this.factor;
    byId("factor").textContent = !factor ? "not deformed"
      : this.shape.name === "buckling" ? "size is arbitrary" : `drawn × ${+factor.toPrecision(3)}`;
  }
}

function drawAxes({ right, up }) {
  ["x", "y", "z"].forEach((name, c) => {
    const x = 26 * right[c], y = -26 * up[c];
    for (const [key, value] of [["x2", x], ["y2", y]])
      byId("axis-" + name).setAttribute(key, value);
    byId("name-" + name).setAttribute("x", 1.4 * x);
    byId("name-" + name).setAttribute("y", 1.4 * y + 4);
  });
}

async function start() {
  if (location.protocol === "data:" || location.protocol === "about:")
    document.body.classList.add("embedded"); // links to files beside the page lead nowhere
  try {
    const app = new App(await readArrays());
    byId("stage").classList.add("ready");
    const wanted = new URLSearchParams(location.hash.slice(1));
    const number = facts.fields.findIndex((f) => f.name === wanted.get("field"));
    if (number >= 0) { byId("field").value = number; app.setField(); }
    if (wanted.has("deform")) { byId("deform").value = wanted.get("deform"); app.draw(); }
    if (wanted.has("panel")) app.choose(Number(wanted.get("panel")));
    document.body.dataset.state = "ready";
  } catch (error) {
    byId("no-view").textContent = `No 3D view: ${error.message}. All numbers stand in the tables.`;
    document.body.dataset.state = "no-view";
  }
}

start();
