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
  const beam = panel >= arrays.panel_zigzag.length;
  const words = beam ? ["edge beam"] : [`panel ${panel}`, `zigzag ${arrays.panel_zigzag[panel]}`,
    `strip ${arrays.panel_strip[panel]}`];
  words.push(`thickness ${(1000 * arrays.panel_thickness[panel]).toFixed(1)} mm`);
  if (arrays.panel_utilization)
    words.push(`mean utilization ${arrays.panel_utilization[panel].toFixed(2)}`);
  if (beam) return words.join(" · ");
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
    const number = facts.fields.findIndex((f) => f.name === wanted.get("field"));
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
