"use strict";
// The 3D view of a design: WebGL 2 without libraries, arrays from the page itself. The page joins
// data.js, renderer.js, camera.js and viewer.js into one script.

const byId = (id) => document.getElementById(id);
const facts = JSON.parse(byId("facts").textContent);
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
    const missing = 2 ** (8 * numbers.BYTES_PER_ELEMENT) - 1; // of real values
    arrays[name] = step === undefined ? numbers
      : Float32Array.from(numbers, (n) => (n === missing ? NaN : low + step * n));
  }
  return arrays;
}
