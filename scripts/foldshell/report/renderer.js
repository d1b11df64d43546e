// Part of the page's script: what WebGL draws.

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

const CREASES = [["flat", 0.8, 0.35, false], ["border", 2.2, 0, false],
  ["mountain", 1.8, 0, false], ["valley", 1.8, 0, true]];
const ARROWS = [["loads", [0, 0.32, 0.54]], ["reactions", [0.64, 0, 0.14]]];

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
    this.arrows = {}; // number of segments by kind
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

  setArrows(kind, ends) { // ends: six numbers a segment
    const count = ends.length / 6, pick = (shift) => Float32Array.from({ length: 3 * count },
      (_, k) => ends[6 * Math.floor(k / 3) + (k % 3) + shift]);
    this.arrows[kind] = count;
    this.upload(`${kind}_from`, pick(0));
    this.upload(`${kind}_to`, pick(3));
    for (const name of ["moved_from", "moved_to"])
      this.upload(`${kind}_${name}`, new Float32Array(3 * count));
    this.upload(`${kind}_along`, new Float32Array(2 * count));
  }

  setField(field, values) {
    const gl = this.gl;
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
    const thin = Math.min(1, Math.sqrt(350 / this.arrays.panel_thickness.length)) * ratio;
    if (showLines) this.drawLines(view, CREASES.map(([kind, width, grey, dashed]) =>
      [kind, this.lines[kind].from.length, width * thin, [grey, grey, grey], dashed ? view.dash : 0]));
    this.drawLines(view, ARROWS.map(([kind, ink]) => [kind, this.arrows[kind] ?? 0, 2 * ratio, ink, 0]));
    if (showLines) {
      const mark = this.use("mark", view);
      gl.uniform1f(mark.lift, 0.002);
      this.bind(0, "marks", 3);
      gl.drawArrays(gl.POINTS, 0, this.arrays.supports.length);
      this.release(1);
    }
  }

  drawLines(view, kinds) { // kind, number of segments, width, ink, length of a dash
    const gl = this.gl, line = this.use("line", view);
    gl.uniform1f(line.lift, 0.0015);
    for (const [kind, count, width, ink, dash] of kinds) {
      if (!count) continue;
      gl.uniform1f(line.width, width);
      gl.uniform3f(line.ink, ...ink);
      gl.uniform1f(line.dash, dash);
      this.bind(0, kind + "_from", 3, 1); this.bind(1, kind + "_to", 3, 1);
      this.bind(2, kind + "_moved_from", 3, 1); this.bind(3, kind + "_moved_to", 3, 1);
      this.bind(4, kind + "_along", 2, 1); this.bind(5, "corner", 2);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, 6, count);
    }
    this.release(6);
  }
}
