// Part of the page's script: legend, controls, and what a picked panel says.

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
  const beam = panel >= arrays.panel_planarity.length;
  const words = beam ? ["edge beam"] : [`panel ${panel}`, ...placePanel(panel, arrays)];
  words.push(`thickness ${(1000 * arrays.panel_thickness[panel]).toFixed(1)} mm`);
  if (arrays.panel_utilization)
    words.push(`mean utilization ${arrays.panel_utilization[panel].toFixed(2)}`);
  if (beam) return words.join(" · ");
  words.push(`planarity ${(100 * arrays.panel_planarity[panel]).toFixed(2)} %`);
  if (arrays.panel_class) words.push(`class ${arrays.panel_class[panel]}`);
  return words.join(" · ");
}

function placePanel(panel, arrays) { // zig-zag and strip, or where it is
  if (arrays.panel_zigzag)
    return [`zigzag ${arrays.panel_zigzag[panel]}`, `strip ${arrays.panel_strip[panel]}`];
  const middle = arrays.panel_middle.slice(3 * panel, 3 * panel + 3);
  return [...middle].map((value, k) => `${"xyz"[k]} ${value.toFixed(2)} m`);
}

const SAME = { used: "utilization", utilization: "utilization", down: "displacement",
  displacement: "displacement", thickness: "thickness", class: "class", planarity: "planarity" };

class App {
  constructor(arrays) {
    this.canvas = byId("view");
    this.arrays = arrays;
    this.renderer = new Renderer(this.canvas, arrays);
    this.camera = new Camera(arrays.nodes);
    this.chosen = -1;
    this.fill("combination", ["envelope", ...facts.combinations.map((c) => c.name)]);
    for (const id of ["combination-part", "arrows-part"])
      byId(id).hidden = !facts.combinations.length;
    byId("iterations-part").hidden = facts.iterations.length < 2;
    for (const id of ["first", "second"]) this.fill(id, facts.iterations);
    byId("second").value = facts.iterations.length - 1;
    this.fill("loads-of", ["the combination", ...(facts.cases ?? []).map(([name]) => name)]);
    this.middles = findMiddles(arrays);
    this.listen();
    this.setCombination();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  fill(id, names) {
    byId(id).replaceChildren(...names.map((name, k) => new Option(name, k)));
  }

  get combination() { return byId("combination").value - 1; } // -1: envelope

  get fields() {
    const single = this.combination, strength = facts.combinations.length
      ? sizeOf("used")[0] : 0;
    if (single < 0) return facts.fields;
    const whole = facts.fields.filter((f) => ["thickness", "class", "planarity"].includes(f.name));
    return [...facts.quantities.filter((q) => q.name !== "used" || single < strength), ...whole];
  }

  get shapes() {
    if (this.combination < 0) return facts.shapes;
    const { name, drawn } = facts.combinations[this.combination];
    return [{ name: "displacement", words: `displacement of ${name}`, factor: drawn },
      ...facts.shapes.filter((s) => s.name !== "displacement")];
  }

  get shape() { return this.shapes[byId("shape").value]; }

  setCombination() {
    const single = this.combination, before = facts.combinations[single];
    const kept = this.shown && SAME[this.shown.name];
    this.fill("field", this.fields.map((f) => f.words));
    this.fill("shape", this.shapes.map((s) => s.words));
    byId("deform-controls").hidden = !this.shapes.length;
    const number = this.fields.findIndex((f) => (SAME[f.name] ?? f.name) === kept);
    byId("field").value = Math.max(number, 0);
    byId("combination-words").textContent = before ? before.words : "largest of all combinations";
    byId("reactions-words").textContent = describeReactions(single);
    this.setField();
    this.setShape();
    this.setArrows();
    showSections(this.chosen, single, this.arrays);
  }

  setArrows() {
    const single = this.combination, arrays = this.arrays, longest = (kind) =>
      ARROW_SHARE[kind] * facts.size;
    const number = byId("loads-of").value - 1; // of a single case; -1: of the combination
    const factors = number >= 0 ? facts.cases.map((_, i) => +(i === number))
      : facts.combinations[single]?.factors;
    byId("reactions").disabled = single < 0;
    byId("loads").disabled = !factors;
    byId("loads-words").textContent = number >= 0 ? facts.cases[number][1] : "";
    const many = arrays.panel_planarity.length > 400;
    if (number >= 0 || single >= 0) byId("loads-words").textContent
      += many && byId("loads").checked ? " Arrows stand on every fourth panel." : "";
    this.renderer.setArrows("loads", factors && byId("loads").checked
      ? makeArrows(...thinOut(many, this.middles, loadsOf(factors, arrays), arrays),
        longest("loads"), false) : []);
    let ends = [];
    if (single >= 0 && byId("reactions").checked) {
      const count = 3 * sizeOf("reaction")[1];
      const tips = Array.from(arrays.reaction_node).flatMap((n) =>
        [...arrays.nodes.slice(3 * n, 3 * n + 3)]);
      ends = makeArrows(tips, arrays.reaction.slice(single * count, (single + 1) * count),
        longest("reactions"), false);
    }
    this.renderer.setArrows("reactions", ends);
    this.draw();
  }

  compareIterations() {
    const [first, second] = ["first", "second"].map((id) => Number(byId(id).value));
    const [field, values] = compareIterations(first, second, this.arrays);
    this.shown = field;
    this.renderer.setField(field, values);
    drawLegend(field);
    this.draw();
  }

  get factor() {
    return this.shape ? (this.shape.factor * byId("deform").value) / 50 : 0;
  }

  setField() {
    const field = this.fields[byId("field").value], arrays = this.arrays;
    this.shown = field;
    const single = this.combination < 0 ? facts.displaced : this.combination;
    this.renderer.setField(field, arrays["field_" + field.name]
      ?? valuesOf(field, single, arrays));
    drawLegend(field);
    this.draw();
  }

  setShape() {
    const shape = this.shape, kept = shape && this.arrays["shape_" + shape.name];
    const single = this.combination < 0 ? facts.displaced : this.combination;
    this.renderer.setShape(kept ?? (shape && movedOf(single, this.arrays)));
    this.draw();
  }

  choose(panel) {
    this.chosen = panel;
    byId("picked").textContent = describePanel(panel, this.arrays);
    showSections(panel, this.combination, this.arrays);
    this.draw();
  }

  listen() {
    byId("field").onchange = () => this.setField();
    byId("shape").onchange = () => this.setShape();
    byId("combination").onchange = () => this.setCombination();
    for (const id of ["loads", "reactions"]) byId(id).onchange = () => this.setArrows();
    byId("loads-of").onchange = () => {
      byId("loads").checked = true;
      this.setArrows();
    };
    byId("first").onchange = byId("second").onchange = () => this.compareIterations();
    byId("compare").onclick = () => this.compareIterations();
    byId("deform").oninput = () => this.draw();
    byId("creases").onchange = () => this.draw();
    byId("home").onclick = () => { this.camera.reset(); this.rotate(0, 0); };
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
    const camera = this.camera;
    this.look(camera.turn + turn, camera.rise + rise, camera.zoom, true);
  }

  zoom(by) {
    const camera = this.camera;
    this.look(camera.turn, camera.rise, camera.zoom * by, true);
  }

  look(turn, rise, zoom, tell) { // tells the page that holds this one as a frame
    Object.assign(this.camera, { turn, rise: Math.max(-1.5, Math.min(1.57, rise)),
      zoom: Math.max(0.3, Math.min(30, zoom)) });
    if (tell && parent !== window) parent.postMessage({ kind: "camera", turn, rise, zoom }, "*");
    this.draw();
  }

  listenToParent() {
    window.addEventListener("message", ({ source, data }) => {
      if (source !== parent || data === null || data.kind !== "camera") return;
      const { turn, rise, zoom } = data;
      if ([turn, rise, zoom].every(Number.isFinite)) this.look(turn, rise, zoom, false);
    });
    parent.postMessage({ kind: "ready" }, "*");
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
  const wanted = new URLSearchParams(location.hash.slice(1));
  document.body.classList.toggle("embed", wanted.has("embed")); // as a frame: the view alone
  try {
    const app = new App(await readArrays());
    byId("stage").classList.add("ready");
    if (parent !== window) app.listenToParent();
    const named = facts.combinations.findIndex((c) => c.name === wanted.get("combination"));
    if (named >= 0) { byId("combination").value = named + 1; app.setCombination(); }
    for (const kind of ["loads", "reactions"])
      if (wanted.has(kind)) { byId(kind).checked = true; app.setArrows(); }
    const number = app.fields.findIndex((f) => f.name === wanted.get("field"));
    if (number >= 0) { byId("field").value = number; app.setField(); }
    if (wanted.has("deform")) { byId("deform").value = wanted.get("deform"); app.draw(); }
    if (wanted.has("panel")) app.choose(Number(wanted.get("panel")));
    document.body.dataset.state = "ready";
  } catch (error) {
    byId("why").textContent = `: ${error.message}`;
    document.body.dataset.state = "no-view";
  }
}

start();
