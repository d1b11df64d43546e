// Part of the report's script: parallel lines and scatter of all designs that are shown.

const COLOURS = ["#0072B2", "#B35C00", "#00785A", "#A8447F", "#000000"];
const surfaces = [...new Set(designs.map((d) => d.values.surface))];
const supports = [...new Set(designs.map((d) => d.values.support))];
const colourOf = (k) => COLOURS[surfaces.indexOf(designs[k].values.surface) % COLOURS.length];
const numeric = columns.filter((c) => c.numeric && designs.some((d) => d.values[c.key] !== null));
const DASHES = ["", "7 4", "2 3"];
const dashOf = (k) => DASHES[supports.indexOf(designs[k].values.support) % 3];
const linesColumns = new Set(numeric.filter((c) => c.chosen).map((c) => c.key));

function draw(name, attributes, words) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (words !== undefined) made.textContent = words;
  return made;
}

function findTicks(low, high, count = 5) {
  const size = (high - low || Math.abs(high) || 1) / count;
  const power = 10 ** Math.floor(Math.log10(size));
  const step = [1, 2, 2.5, 5, 10].map((f) => f * power).find((s) => s >= size * 0.999);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
  return ticks;
}

const show = (value) => (value === null ? "–" : String(+value.toPrecision(4)));

function range(key) {
  const values = designs.map((d) => d.values[key]).filter((v) => v !== null);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const margin = high > low ? 0 : Math.abs(low) / 2 || 1;
  return [low - margin, high + margin];
}

function hover(marks, k, event) { // a picture and the numbers of a design, beside the pointer
  const box = byId("hover"), design = designs[k];
  const facts = numeric.filter((c) => linesColumns.has(c.key)).slice(0, 6)
    .map((c) => `${c.words}: ${show(design.values[c.key])}`);
  box.replaceChildren(element("img", { src: design.pictures[byId("picture").value], alt: "" }),
    element("b", {}, design.name), element("span", {}, design.values.state),
    ...facts.map((words) => element("span", {}, words)));
  box.hidden = false;
  box.style.left = Math.min(event.pageX + 16, document.documentElement.scrollWidth - 270) + "px";
  box.style.top = event.pageY + 16 + "px";
  document.querySelectorAll(".mark").forEach((m) => m.classList.toggle("dim", +m.dataset.k !== k));
}

function unhover() {
  byId("hover").hidden = true;
  document.querySelectorAll(".mark.dim").forEach((mark) => mark.classList.remove("dim"));
}

function listen(mark, k) {
  mark.dataset.k = k;
  mark.classList.add("mark");
  mark.onpointermove = (event) => hover(mark, k, event);
  mark.onpointerleave = unhover;
  mark.onclick = () => { location.href = designs[k].page; };
}

function drawLines() {
  const chosen = numeric.filter((c) => linesColumns.has(c.key));
  const width = Math.max(640, 175 * chosen.length), height = 360, top = 64, base = 330;
  const svg = draw("svg", { viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": "parallel lines: " + chosen.map((c) => c.words).join(", ") });
  const x = (n) => (chosen.length < 2 ? width / 2 : 70 + ((width - 140) * n) / (chosen.length - 1));
  const places = chosen.map((column, n) => {
    const [low, high] = range(column.key);
    const y = (value) => base - ((base - top) * (value - low)) / (high - low);
    svg.append(draw("line", { x1: x(n), x2: x(n), y1: top, y2: base, stroke: "#6b6b6b" }));
    const words = column.words.match(/.{1,22}(\s|$)/g) ?? [column.words];
    words.slice(0, 3).forEach((line, row) => svg.append(draw("text",
      { x: x(n), y: 14 + 15 * row, "text-anchor": "middle", "font-size": 12 }, line.trim())));
    for (const tick of findTicks(low, high)) svg.append(draw("text",
      { x: x(n) - 6, y: y(tick) + 4, "text-anchor": "end", "font-size": 11 }, show(tick)));
    return y;
  });
  designs.forEach((design, k) => {
    if (!shown[k]) return;
    const points = chosen.map((c, n) => (design.values[c.key] === null ? null
      : `${x(n).toFixed(1)},${places[n](design.values[c.key]).toFixed(1)}`)).filter(Boolean);
    const line = draw("polyline", { points: points.join(" "), fill: "none", stroke: colourOf(k),
      "stroke-width": 2, "stroke-dasharray": dashOf(k) });
    const wide = draw("polyline", { points: points.join(" "), fill: "none", stroke: "transparent",
      "stroke-width": 12 });
    listen(line, k);
    listen(wide, k);
    svg.append(line, wide);
  });
  byId("lines").replaceChildren(svg);
}

function drawMark(k, x, y) {
  const kind = supports.indexOf(designs[k].values.support) % 3;
  const look = { fill: colourOf(k), stroke: "white", "stroke-width": 1 };
  if (kind === 0) return draw("circle", { cx: x, cy: y, r: 6, ...look });
  if (kind === 1) return draw("rect", { x: x - 5.5, y: y - 5.5, width: 11, height: 11, ...look });
  return draw("path", { d: `M${x} ${y - 7}l7 12h-14z`, ...look });
}

function drawScatter() {
  const [across, up] = ["scatter-x", "scatter-y"].map((id) =>
    columns.find((c) => c.key === byId(id).value));
  const width = 760, height = 430, left = 80, right = 730, top = 24, base = 370;
  const svg = draw("svg", { viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `${up.words} over ${across.words}` });
  const [[x0, x1], [y0, y1]] = [range(across.key), range(up.key)].map(([low, high]) =>
    [low - 0.04 * (high - low), high + 0.04 * (high - low)]);
  const x = (v) => left + ((right - left) * (v - x0)) / (x1 - x0);
  const y = (v) => base - ((base - top) * (v - y0)) / (y1 - y0);
  for (const tick of findTicks(x0, x1, 7)) svg.append(
    draw("line", { x1: x(tick), x2: x(tick), y1: top, y2: base, stroke: "#dcdcdc" }),
    draw("text", { x: x(tick), y: base + 18, "text-anchor": "middle", "font-size": 12 }, show(tick)));
  for (const tick of findTicks(y0, y1)) svg.append(
    draw("line", { x1: left, x2: right, y1: y(tick), y2: y(tick), stroke: "#dcdcdc" }),
    draw("text", { x: left - 8, y: y(tick) + 4, "text-anchor": "end", "font-size": 12 }, show(tick)));
  svg.append(draw("text", { x: (left + right) / 2, y: height - 12, "text-anchor": "middle",
    "font-size": 13 }, across.words), draw("text", { x: 0, y: 0, "text-anchor": "middle",
    "font-size": 13, transform: `translate(18 ${(top + base) / 2}) rotate(-90)` }, up.words));
  designs.forEach((design, k) => {
    const [a, b] = [design.values[across.key], design.values[up.key]];
    if (!shown[k] || a === null || b === null) return;
    const mark = drawMark(k, x(a), y(b));
    listen(mark, k);
    svg.append(mark);
  });
  byId("scatter").replaceChildren(svg);
}

function drawKeys() {
  const keys = [];
  surfaces.forEach((name) => {
    const k = designs.findIndex((d) => d.values.surface === name);
    const svg = draw("svg", { viewBox: "0 0 30 10", "aria-hidden": "true" });
    svg.append(draw("path", { d: "M0 5h30", stroke: colourOf(k), "stroke-width": 4 }));
    keys.push([svg, name]);
  });
  supports.forEach((name, kind) => {
    const k = designs.findIndex((d) => d.values.support === name);
    const svg = draw("svg", { viewBox: "0 0 44 14", "aria-hidden": "true" });
    const mark = drawMark(k, 36, 7);
    mark.setAttribute("fill", "#333");
    svg.append(draw("path", { d: "M0 7h26", stroke: "#333", "stroke-width": 2,
      "stroke-dasharray": DASHES[kind % 3] }), mark);
    keys.push([svg, `${name} edges supported`]);
  });
  byId("chart-keys").replaceChildren(...keys.map(([svg, words]) => {
    const key = element("span");
    key.append(svg, words);
    return key;
  }));
}

function startCharts() {
  for (const [id, first] of [["scatter-x", "volume_per_area_m"],
    ["scatter-y", "displacement_vertical_max_m"]]) {
    byId(id).append(...numeric.map((c) => new Option(c.words, c.key)));
    if (numeric.some((c) => c.key === first)) byId(id).value = first;
    byId(id).onchange = drawScatter;
  }
  byId("lines-columns").append(...numeric.map((column) => {
    const label = element("label"), box = element("input",
      { type: "checkbox", checked: linesColumns.has(column.key) });
    box.onchange = () => {
      linesColumns[box.checked ? "add" : "delete"](column.key);
      drawLines();
    };
    label.append(box, " " + column.words);
    return label;
  }));
  drawKeys();
  listeners.push(drawLines, drawScatter);
  drawLines();
  drawScatter();
}

if (numeric.length) requestAnimationFrame(() => setTimeout(startCharts)); // after the first view
