// The page of an exploration: parallel lines with ranges, scatter, shapes, one design, selection.

const { designs, columns, aims, table } = JSON.parse(document.getElementById("explore-data").textContent);
const byId = (id) => document.getElementById(id), SVG = "http://www.w3.org/2000/svg";
const place = Object.fromEntries(columns.map((c, k) => [c.key, k]));
const valueOf = (design, key) => design.values[place[key]];
const show = (v) => (v === null ? "–" : typeof v === "number" ? String(+v.toPrecision(4)) : v);
const levels = {}; // of texts: their order on an axis
for (const c of columns) if (c.text) levels[c.key] = [...new Set(designs.map((d) => valueOf(d, c.key)))].filter((v) => v !== null).sort();
const numberOf = (d, key) => { const v = valueOf(d, key); return levels[key] && v !== null ? levels[key].indexOf(v) : v; };
const varied = columns.filter((c) => new Set(designs.map((d) => valueOf(d, c.key))).size > 1);
const ranges = {}, shapes = new Map();
let turn = Math.PI / 6;

function draw(name, attributes, words) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (words !== undefined) made.textContent = words;
  return made;
}

function span(key) {
  const found = designs.map((d) => numberOf(d, key)).filter((v) => v !== null);
  const [low, high] = [Math.min(...found), Math.max(...found)], margin = high > low ? 0.03 * (high - low) : 1;
  return [low - margin, high + margin];
}

const colourOf = (d) => (d.round === 0 ? (d.row.pattern === "smooth" ? "#A8447F" : "#333333")
  : !d.feasible ? "#b9b9b9" : d.front ? "#B35C00" : "#0072B2");
const inRanges = (d) => Object.entries(ranges).every(([key, [low, high]]) => {
  const v = numberOf(d, key);
  return v !== null && v >= low && v <= high;
});
const isShown = (d) => inRanges(d) && (d.feasible || d.round === 0 || !byId("feasible").checked);
const shown = () => designs.filter(isShown);

function listen(mark, design) {
  mark.classList.add("mark");
  mark.append(draw("title", {}, `${design.name}: ${aims.map((a) => `${columns[place[a]].words} ${show(valueOf(design, a))}`).join(", ")}`));
  mark.onclick = () => open(design);
}

function drawLines() {
  const width = Math.max(760, 118 * varied.length), top = 66, base = 330;
  const svg = draw("svg", { viewBox: `0 0 ${width} 352`, role: "img", "aria-label": `parallel lines of ${varied.map((c) => c.words).join(", ")}` });
  const x = (n) => 66 + ((width - 132) * n) / Math.max(varied.length - 1, 1);
  const scales = varied.map((c) => { const [low, high] = span(c.key); return { low, high, y: (v) => base - ((base - top) * (v - low)) / (high - low), v: (y) => low + ((base - y) * (high - low)) / (base - top) }; });
  for (const d of shown().sort((a, b) => a.front - b.front || (b.round === 0) - (a.round === 0))) {
    const points = varied.map((c, n) => { const v = numberOf(d, c.key); return v === null ? null : `${x(n)},${scales[n].y(v).toFixed(1)}`; }).filter(Boolean);
    const look = { points: points.join(" "), fill: "none", stroke: colourOf(d), "stroke-width": d.front || d.round === 0 ? 2.4 : 1.1, opacity: d.front || d.round === 0 ? 1 : 0.7 };
    if (d.round === 0) look["stroke-dasharray"] = d.row.pattern === "smooth" ? "2 3" : "7 4";
    const line = draw("polyline", look);
    listen(line, d);
    svg.append(line);
  }
  varied.forEach((c, n) => {
    const scale = scales[n];
    (c.words.match(/.{1,16}(\s|$)/g) ?? [c.words]).slice(0, 3).forEach((words, row) => svg.append(draw("text", { x: x(n), y: 14 + 14 * row, "text-anchor": "middle", "font-size": 12 }, words.trim())));
    svg.append(draw("line", { x1: x(n), x2: x(n), y1: top, y2: base, stroke: "#222" }));
    const ticks = levels[c.key] ? levels[c.key].map((words, k) => [k, words]) : [0.03, 0.35, 0.65, 0.97].map((s) => { const v = scale.low + s * (scale.high - scale.low); return [v, String(+v.toPrecision(3))]; });
    for (const [v, words] of ticks) svg.append(draw("text", { x: x(n) - 5, y: scale.y(v) + 4, "text-anchor": "end", "font-size": 11, stroke: "white", "stroke-width": 3, "paint-order": "stroke" }, words));
    const held = ranges[c.key];
    if (held) svg.append(draw("rect", { x: x(n) - 7, width: 14, y: scale.y(held[1]), height: scale.y(held[0]) - scale.y(held[1]), fill: "#0072B2", opacity: 0.3 }));
    const axis = draw("rect", { x: x(n) - 14, width: 28, y: top - 4, height: base - top + 8, fill: "transparent", class: "axis" });
    brush(axis, svg, c.key, scale);
    svg.append(axis);
  });
  byId("lines").replaceChildren(svg);
}

function brush(axis, svg, key, scale) { // drag keeps a range, a click lets it go
  let from = null;
  const at = (event) => { const box = svg.getBoundingClientRect(); return ((event.clientY - box.top) * svg.viewBox.baseVal.height) / box.height; };
  axis.onpointerdown = (event) => { from = at(event); axis.setPointerCapture(event.pointerId); };
  axis.onpointerup = (event) => {
    const to = at(event);
    if (from === null) return;
    if (Math.abs(to - from) < 4) delete ranges[key];
    else ranges[key] = [scale.v(Math.max(from, to)), scale.v(Math.min(from, to))];
    from = null;
    update();
  };
}

function drawScatter() {
  const [ax, ay] = ["scatter-x", "scatter-y"].map((id) => columns[place[byId(id).value]]);
  const left = 74, right = 735, top = 14, base = 380, [[x0, x1], [y0, y1]] = [span(ax.key), span(ay.key)];
  const svg = draw("svg", { viewBox: "0 0 760 430", role: "img", "aria-label": `${ay.words} over ${ax.words}` });
  const x = (v) => left + ((right - left) * (v - x0)) / (x1 - x0), y = (v) => base - ((base - top) * (v - y0)) / (y1 - y0);
  const ticks = (c, low, high) => (levels[c.key] ? levels[c.key].map((words, k) => [k, words]) : [0.05, 0.27, 0.5, 0.73, 0.95].map((s) => { const v = low + s * (high - low); return [v, String(+v.toPrecision(3))]; }));
  for (const [v, words] of ticks(ax, x0, x1)) svg.append(draw("line", { x1: x(v), x2: x(v), y1: top, y2: base, stroke: "#ddd" }), draw("text", { x: x(v), y: base + 18, "text-anchor": "middle", "font-size": 12 }, words));
  for (const [v, words] of ticks(ay, y0, y1)) svg.append(draw("line", { x1: left, x2: right, y1: y(v), y2: y(v), stroke: "#ddd" }), draw("text", { x: left - 8, y: y(v) + 4, "text-anchor": "end", "font-size": 12 }, words));
  svg.append(draw("text", { x: (left + right) / 2, y: 420, "text-anchor": "middle", "font-size": 13 }, ax.words), draw("text", { x: 0, y: 0, "text-anchor": "middle", "font-size": 13, transform: `translate(16 ${(top + base) / 2}) rotate(-90)` }, ay.words));
  const found = shown().filter((d) => numberOf(d, ax.key) !== null && numberOf(d, ay.key) !== null);
  const front = paretoOf(found.filter((d) => d.feasible), ax, ay);
  if (front.length > 1) svg.append(draw("path", { d: "M" + front.map((d, k) => `${k ? `H${x(numberOf(d, ax.key))}V` : `${x(numberOf(d, ax.key))} `}${y(numberOf(d, ay.key))}`).join(""), fill: "none", stroke: "#B35C00", "stroke-width": 1.5 }));
  for (const d of found) {
    const [cx, cy] = [x(numberOf(d, ax.key)), y(numberOf(d, ay.key))], fill = colourOf(d);
    const mark = d.round === 0 ? draw("rect", { x: cx - 6, y: cy - 6, width: 12, height: 12, fill, stroke: "white" }) : draw("circle", { cx, cy, r: front.includes(d) ? 7 : 5, fill, stroke: "white" });
    listen(mark, d);
    svg.append(mark);
  }
  byId("scatter").replaceChildren(svg);
}

function paretoOf(found, ax, ay) { // what none beats in both, where both have a better side
  if (!ax.better || !ay.better) return [];
  const sorted = [...found].sort((a, b) => ax.better * (numberOf(a, ax.key) - numberOf(b, ax.key)));
  let best = Infinity;
  return sorted.filter((d) => { const v = ay.better * numberOf(d, ay.key); if (v >= best) return false; best = v; return true; });
}

const shapeOf = (d) => { if (!shapes.has(d)) shapes.set(d, unpack(d.shape)); return shapes.get(d); };
const watcher = new IntersectionObserver((seen) => { for (const one of seen) { one.target.seen = one.isIntersecting; if (one.isIntersecting) paint(one.target, shapeOf(one.target.design), turn, 0.5); } }, { rootMargin: "200px" });

function drawShapes() {
  const key = byId("sort").value, sign = columns[place[key]].better || 1;
  const rank = (d) => { const v = numberOf(d, key); return v === null ? Infinity : sign * v; };
  const made = shown().filter((d) => d.shape).sort((a, b) => rank(a) - rank(b)).map((d) => {
    const button = document.createElement("button"), canvas = document.createElement("canvas");
    Object.assign(canvas, { width: 220, height: 140, design: d });
    canvas.setAttribute("aria-hidden", "true");
    if (d.front) button.className = "front";
    button.append(canvas, `${d.name}: ${show(valueOf(d, aims[0]))} ${columns[place[aims[0]]].words.replace(/.*\[|\]/g, "")}`, document.createElement("br"), `factor ${show(valueOf(d, "buckling_factor_min"))}`);
    button.onclick = () => open(d);
    watcher.observe(canvas);
    return button;
  });
  byId("shapes").replaceChildren(...made);
}

let current = null, around = Math.PI / 6, tilt = 0.5;
const repaint = () => { if (current?.shape) paint(byId("big"), shapeOf(current), around, tilt); };

function open(design) {
  current = design;
  byId("single-name").textContent = `Design ${design.name}: ${design.feasible ? "keeps all limits" : design.broken.join(", ") || design.state}`;
  byId("facts").replaceChildren(...columns.map((c) => { const p = document.createElement("span"); p.textContent = `${c.words}: ${show(valueOf(design, c.key))}`; return p; }));
  byId("page").hidden = !design.page;
  byId("page").href = design.page || "#";
  byId("big").hidden = !design.shape;
  if (!byId("single").open) byId("single").showModal();
  repaint();
}

function exportSelection() {
  const lines = [["design", ...table, "tags"].join("\t")];
  for (const d of shown()) lines.push([`c${d.name}`, ...table.map((key) => d.row[key] ?? ""), "chosen"].join("\t"));
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([lines.join("\n") + "\n"], { type: "text/tab-separated-values" }));
  link.download = "designs.tsv";
  link.click();
  URL.revokeObjectURL(link.href);
}

function update() {
  byId("shown").textContent = `${shown().length} of ${designs.length} designs shown`;
  drawLines();
  drawScatter();
  drawShapes();
}

document.body.classList.add("scripted");
for (const id of ["scatter-x", "scatter-y", "sort"]) byId(id).append(...varied.map((c) => new Option(c.words, c.key)));
const pick = (key, other) => (varied.some((c) => c.key === key) ? key : varied[Math.min(other, varied.length - 1)].key);
byId("scatter-x").value = byId("sort").value = pick(aims[0], 0);
byId("scatter-y").value = pick(aims[1], 1);
byId("scatter-x").onchange = byId("scatter-y").onchange = drawScatter;
byId("sort").onchange = drawShapes;
byId("feasible").onchange = update;
byId("clear").onclick = () => { for (const key of Object.keys(ranges)) delete ranges[key]; update(); };
byId("export").onclick = exportSelection;
byId("turn").oninput = () => { turn = (byId("turn").value * Math.PI) / 180; for (const canvas of document.querySelectorAll("#shapes canvas")) if (canvas.seen) paint(canvas, shapeOf(canvas.design), turn, 0.5); };
byId("big").onpointerdown = (event) => byId("big").setPointerCapture(event.pointerId);
byId("big").onpointermove = (event) => { if (event.buttons) { around += event.movementX / 150; tilt = Math.min(1.55, Math.max(0.02, tilt + event.movementY / 150)); repaint(); } };
byId("big").onkeydown = (event) => { const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key]; if (step) { around += step[0]; tilt = Math.min(1.55, Math.max(0.02, tilt + step[1])); repaint(); event.preventDefault(); } };
update();
