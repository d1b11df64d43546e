// Part of the page's script: a camera that turns about the middle of the sheet, z up; picking.

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
