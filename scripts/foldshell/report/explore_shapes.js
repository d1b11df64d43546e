// Part of the page of an exploration: folded sheets drawn on canvases, from packed coordinates.
"use strict";

function unpack(text) { // counts, box, 16-bit coordinates, corners of panels but for a grid's
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), view = new DataView(bytes.buffer);
  const [vertices, panels, strips] = [0, 4, 8].map((k) => view.getUint32(k, true));
  const box = Array.from({ length: 6 }, (_, k) => view.getFloat32(12 + 4 * k, true));
  const xyz = new Float32Array(3 * vertices), quads = new Uint16Array(4 * panels);
  const centre = [0, 1, 2].map((k) => box[k] + box[3 + k] / 2);
  for (let k = 0; k < xyz.length; k++)
    xyz[k] = box[k % 3] + (box[3 + (k % 3)] * view.getUint16(36 + 2 * k, true)) / 65535 - centre[k % 3];
  const start = 36 + 6 * vertices;
  for (let k = 0; k < panels; k++) {
    const first = strips ? k + Math.floor(k / (strips - 1)) : 0;
    const corners = [first, first + 1, first + strips + 1, first + strips];
    for (let m = 0; m < 4; m++) quads[4 * k + m] = strips ? corners[m] : view.getUint16(start + 8 * k + 2 * m, true);
  }
  return { xyz, quads, size: Math.hypot(box[3], box[4]) };
}

function paint(canvas, shape, turn, tilt) { // panels from back to front, lit from above
  const context = canvas.getContext("2d"), { xyz, quads, size } = shape;
  const [width, height] = [canvas.width, canvas.height], scale = (1.05 * Math.min(width, 1.7 * height)) / size;
  const [ct, st, cp, sp] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
  const count = xyz.length / 3, sx = new Float32Array(count), sy = new Float32Array(count), depth = new Float32Array(count);
  for (let k = 0; k < count; k++) {
    const [x, y, z] = [xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]];
    const away = st * x + ct * y;
    sx[k] = width / 2 + scale * (ct * x - st * y);
    sy[k] = height / 2 + scale * (sp * away - cp * z);
    depth[k] = cp * away + sp * z;
  }
  const order = Array.from({ length: quads.length / 4 }, (_, k) => k);
  const far = order.map((k) => depth[quads[4 * k]] + depth[quads[4 * k + 1]] + depth[quads[4 * k + 2]] + depth[quads[4 * k + 3]]);
  order.sort((a, b) => far[b] - far[a]);
  context.fillStyle = "white";
  context.fillRect(0, 0, width, height);
  context.lineWidth = width > 300 ? 1.2 : 0.8;
  context.strokeStyle = "#222";
  for (const k of order) {
    const [a, b, c, d] = quads.subarray(4 * k, 4 * k + 4);
    const u = [0, 1, 2].map((i) => xyz[3 * c + i] - xyz[3 * a + i]), v = [0, 1, 2].map((i) => xyz[3 * d + i] - xyz[3 * b + i]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const light = Math.abs(0.35 * n[0] + 0.2 * n[1] + 0.9 * n[2]) / (Math.hypot(...n) || 1);
    const grey = Math.round(110 + 135 * Math.min(light, 1));
    context.fillStyle = `rgb(${grey - 14},${grey - 4},${grey})`;
    context.beginPath();
    context.moveTo(sx[a], sy[a]);
    for (const m of [b, c, d]) context.lineTo(sx[m], sy[m]);
    context.closePath();
    context.fill();
    context.stroke();
  }
}
