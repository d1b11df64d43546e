// Part of the report's script: two to four designs side by side, their 3D views turned together.

const PICKED_MAX = 4, PATIENCE = 6000; // ms until a page that does not answer counts as missing
const picks = [...document.querySelectorAll(".pick")];
const frames = new Map(); // number of the design: its frame

function makeView(k) {
  const box = element("figure", { className: "view" }), design = designs[k];
  const frame = element("iframe", { src: design.page + "#embed", title: "3D view of " + design.name });
  const caption = element("figcaption");
  caption.append(element("a", { href: design.page }, design.name), ` ${design.values.state}`);
  box.append(frame, caption);
  frames.set(k, { box, frame, ready: false });
  setTimeout(() => { // the report stands alone: the picture instead
    const mine = frames.get(k);
    if (mine && !mine.ready) frame.replaceWith(element("img",
      { src: design.pictures[byId("picture").value], alt: design.name }));
  }, PATIENCE);
  return box;
}

function listBeside(chosen) {
  const table = element("table"), head = element("tr");
  head.append(element("th", {}, "quantity"),
    ...chosen.map((k) => element("th", { className: "number" }, designs[k].name)));
  table.append(element("thead"), element("tbody"));
  table.tHead.append(head);
  for (const column of columns) {
    const row = element("tr"), values = chosen.map((k) => designs[k].values[column.key]);
    row.append(element("th", { scope: "row" }, column.words), ...values.map((value) =>
      element("td", { className: column.numeric ? "number" : "" },
        typeof value === "number" ? show(value) : value ?? "–")));
    if (new Set(values).size > 1) row.className = "differs";
    table.tBodies[0].append(row);
  }
  const box = element("div", { className: "scroll" });
  box.append(table);
  return box;
}

function showPicked() {
  const chosen = picks.filter((box) => box.checked).map((box) => +box.value);
  picks.forEach((box) => { box.disabled = !box.checked && chosen.length >= PICKED_MAX; });
  for (const k of [...frames.keys()]) if (!chosen.includes(k)) {
    frames.get(k).box.remove();
    frames.delete(k);
  }
  if (chosen.length > 1)
    for (const k of chosen) if (!frames.has(k)) byId("views").append(makeView(k));
  byId("beside").replaceChildren(...(chosen.length > 1 ? [listBeside(chosen)] : []));
  byId("pick-words").textContent = chosen.length === 1
    ? `${designs[chosen[0]].name}: tick “compare” on one to three more.`
    : "Tick “compare” on two to four designs: their 3D views turn together.";
}

window.addEventListener("message", (event) => { // of a design's page: it is ready, or was turned
  const mine = [...frames.values()].find((f) => f.frame.contentWindow === event.source);
  if (!mine || typeof event.data !== "object" || event.data === null) return;
  mine.ready = true;
  if (event.data.kind !== "camera") return;
  for (const other of frames.values())
    if (other !== mine) other.frame.contentWindow?.postMessage(event.data, "*");
});

picks.forEach((box) => { box.onchange = showPicked; });
showPicked();
