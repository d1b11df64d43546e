// Part of the page's script: single combinations, section forces, loads and reactions, iterations.

const DIVERGING = [[0, 70, 150], [245, 245, 242], [200, 95, 0]]; // less, equal, more
const ARROW_SHARE = { loads: 0.07, reactions: 0.11 }; // longest arrow / diagonal of the sheet

const sizeOf = (name) => facts.arrays.find((a) => a.name === name).shape;

function principal(xx, yy, xy) {
  const mean = (xx + yy) / 2, radius = Math.hypot((xx - yy) / 2, xy);
  return [mean + radius, mean - radius];
}

function findSection(arrays, k, panel) { // n, m, v of a panel in combination k, as principal values
  const panels = sizeOf("sections")[1], at = 8 * (k * panels + panel);
  const [nx, ny, nxy, mx, my, mxy, vx, vy] = arrays.sections.slice(at, at + 8);
  return { n: principal(nx, ny, nxy), m: principal(mx, my, mxy), v: Math.hypot(vx, vy) };
}

function valuesOf(field, k, arrays) { // what colours the sheet in combination k
  if (field.name === "used") {
    const count = sizeOf("used")[1], cells = arrays.panel.length / count;
    const own = arrays.used.subarray(k * count, (k + 1) * count);
    return cells === 1 ? own
      : Float32Array.from(arrays.panel, (_, i) => own[Math.floor(i / cells)]);
  }
  if (field.name === "down" || field.name === "displacement") {
    const moved = movedOf(k, arrays);
    return Float32Array.from({ length: moved.length / 3 }, (_, i) => -1000 * moved[3 * i + 2]);
  }
  return Float32Array.from({ length: sizeOf("sections")[1] }, (_, panel) => {
    const { n, m } = findSection(arrays, k, panel);
    return field.name === "n1" ? n[0] : field.name === "n2" ? n[1]
      : Math.max(Math.abs(m[0]), Math.abs(m[1]));
  });
}

function movedOf(k, arrays) {
  const count = 3 * sizeOf("moved")[1];
  return arrays.moved.subarray(k * count, (k + 1) * count);
}

function findMiddles(arrays) { // of panels, from those of their triangles
  const count = arrays.panel_thickness.length, sums = new Float32Array(3 * count);
  const parts = new Float32Array(count), { triangles, panel, nodes } = arrays;
  panel.forEach((p, k) => {
    parts[p] += 3;
    for (let i = 0; i < 3; i++) for (let c = 0; c < 3; c++)
      sums[3 * p + c] += nodes[3 * triangles[3 * k + i] + c];
  });
  return sums.map((value, k) => value / parts[Math.floor(k / 3)]);
}

function makeArrows(tips, vectors, longest, pulls) { // shafts and four strokes a head, at their tips
  const size = Math.max(...Array.from({ length: vectors.length / 3 }, (_, k) =>
    Math.hypot(...vectors.slice(3 * k, 3 * k + 3)))) || 1;
  const ends = [];
  for (let k = 0; k < vectors.length / 3; k++) {
    const force = [...vectors.slice(3 * k, 3 * k + 3)], length = Math.hypot(...force);
    if (length < 1e-3 * size) continue;
    const way = force.map((v) => (v / size) * longest), place = [...tips.slice(3 * k, 3 * k + 3)];
    const tip = pulls ? place.map((v, c) => v + way[c]) : place;
    const tail = pulls ? place : place.map((v, c) => v - way[c]);
    ends.push(...tail, ...tip);
    const unit = way.map((v) => v / Math.hypot(...way)), head = 0.28 * Math.hypot(...way);
    const across = cross(unit, Math.abs(unit[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
    const side = across.map((v) => v / Math.hypot(...across)), other = cross(unit, side);
    for (const [a, b] of [[side, 1], [side, -1], [other, 1], [other, -1]])
      ends.push(...tip, ...tip.map((v, c) => v - head * (unit[c] - 0.4 * b * a[c])));
  }
  return ends;
}

function loadsOf(factors, arrays) { // kN on each panel
  const [cases, panels] = sizeOf("case_force"), out = new Float32Array(3 * panels);
  for (let i = 0; i < cases; i++) {
    const factor = factors[i];
    if (factor) for (let j = 0; j < out.length; j++)
      out[j] += factor * arrays.case_force[i * out.length + j];
  }
  return out;
}

function thinOut(many, places, vectors, arrays) { // of many panels every second one each way
  if (!many) return [places, vectors];
  const kept = [...arrays.panel_planarity.keys()].filter((p) => !arrays.panel_zigzag ? p % 4 === 0
    : arrays.panel_zigzag[p] % 2 === 0 && arrays.panel_strip[p] % 2 === 0);
  const pick = (values) => Float32Array.from(kept.flatMap((p) => [...values.slice(3 * p, 3 * p + 3)]));
  return [pick(places), pick(vectors)];
}

function showSections(panel, k, arrays) { // a table below the view: one combination, or all
  const box = byId("sections");
  box.hidden = panel < 0 || !facts.combinations.length;
  if (box.hidden) return;
  const format = (value) => String(+value.toPrecision(4));
  const chosen = k < 0 ? facts.combinations.map((_, i) => i) : [k];
  byId("sections-rows").replaceChildren(...chosen.map((i) => {
    const { n, m, v } = findSection(arrays, i, panel), row = document.createElement("tr");
    for (const words of [facts.combinations[i].name, ...n.map(format), ...m.map(format), format(v)]) {
      const cell = document.createElement("td");
      cell.textContent = words;
      cell.className = row.cells.length ? "number" : "";
      row.append(cell);
    }
    return row;
  }));
}

function describeReactions(k) {
  if (k < 0) return "";
  return "Reactions [kN]: " + facts.combinations[k].edges.map(([name, force]) =>
    `${name} x ${force[0]}, y ${force[1]}, z ${force[2]}`).join("; ");
}

function compareIterations(first, second, arrays) { // thickness of the second less the first, mm
  const [, panels] = sizeOf("iteration_thickness"), all = arrays.iteration_thickness;
  const values = Float32Array.from({ length: arrays.panel_thickness.length }, (_, p) =>
    (p < panels ? 1000 * (all[second * panels + p] - all[first * panels + p]) : NaN));
  const most = Math.max(1, ...[...values].filter((v) => !Number.isNaN(v)).map(Math.abs));
  const step = 10 ** Math.floor(Math.log10(most)), high = Math.ceil(most / step) * step;
  const ticks = [-high, -high / 2, 0, high / 2, high].map((v) => [v, String(+v.toPrecision(3))]);
  const colours = Array.from({ length: 64 }, (_, k) => {
    const share = (2 * k) / 63, low = share < 1 ? 0 : 1, rest = share - low;
    return DIVERGING[low].map((v, c) => Math.round(v + rest * (DIVERGING[low + 1]?.[c] - v || 0))
      .toString(16).padStart(2, "0")).join("");
  }).join("");
  const words = `thickness of iteration ${second} less that of ${first} [mm]`;
  return [{ name: "iterations", words, at: "panel", low: -high, high, limit: null, colours, ticks },
    values];
}
