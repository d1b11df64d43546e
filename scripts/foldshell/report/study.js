"use strict";
// The report of a study: sorts and filters cards and table alike. The page joins study.js,
// study_charts.js and study_views.js into one script.

const byId = (id) => document.getElementById(id);
const { columns, designs } = JSON.parse(byId("study-data").textContent);
const cards = designs.map((design) => byId("card-" + design.name));
const first = byId("picture").options[0].value; // this one stands in the page, not in the data
designs.forEach((design, k) => { design.pictures[first] = cards[k].querySelector("img").src; });
const rows = [...document.querySelectorAll("#summary tbody tr")];
const shown = designs.map(() => true);
const listeners = []; // called when other designs are shown
const SVG = "http://www.w3.org/2000/svg";
const CATEGORIES = ["surface", "support", "pattern", "fold_mode", "state", "engineering", "crosscheck"];

function element(name, attributes = {}, words) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made[key] = value;
  if (words !== undefined) made.textContent = words;
  return made;
}

const valueOf = (k, key) => (key === "name" ? designs[k].name : designs[k].values[key]);

function compare(key, a, b) { // gaps go last
  const [u, v] = [valueOf(a, key), valueOf(b, key)];
  if (u === null || v === null) return (u === null) - (v === null) || a - b;
  return (typeof u === "number" ? u - v : String(u).localeCompare(String(v), "en",
    { numeric: true })) || a - b;
}

function sort(key, falling) {
  const order = designs.map((_, k) => k).sort((a, b) => {
    const gaps = [a, b].some((k) => valueOf(k, key) === null);
    return compare(key, a, b) * (falling && !gaps ? -1 : 1);
  });
  byId("cards").append(...order.map((k) => cards[k]));
  document.querySelector("#summary tbody").append(...order.map((k) => rows[k]));
  document.querySelectorAll("#summary thead th").forEach((head) => {
    const mine = (head.dataset.key ?? "name") === key;
    head.setAttribute("aria-sort", mine ? (falling ? "descending" : "ascending") : "none");
  });
}

function filter() {
  const words = byId("find").value.toLowerCase().split(/\s+/).filter(Boolean);
  const chosen = [...document.querySelectorAll("#filters select")].filter((s) => s.value);
  const key = byId("range-column").value;
  const [low, high] = ["range-low", "range-high"].map((id) => byId(id).valueAsNumber);
  designs.forEach((design, k) => {
    const text = [design.name, design.governing, ...design.tags, ...Object.values(design.values)]
      .join(" ").toLowerCase();
    const value = design.values[key];
    shown[k] = words.every((word) => text.includes(word))
      && chosen.every((s) => (s.dataset.key === "tags" ? design.tags.includes(s.value)
        : String(design.values[s.dataset.key]) === s.value))
      && (Number.isNaN(low) || (value !== null && value >= low))
      && (Number.isNaN(high) || (value !== null && value <= high));
    cards[k].hidden = rows[k].hidden = !shown[k];
  });
  byId("count").textContent = `${shown.filter(Boolean).length} of ${designs.length} shown`;
  listeners.forEach((listener) => listener());
}

function addFilters() {
  const named = [["tags", "tag", [...new Set(designs.flatMap((d) => d.tags))]]];
  for (const key of CATEGORIES) {
    const column = columns.find((c) => c.key === key);
    if (column) named.push([key, column.words,
      [...new Set(designs.map((d) => d.values[key]).filter((v) => v !== null))]]);
  }
  for (const [key, words, values] of named) {
    if (values.length < 2) continue;
    const select = element("select");
    select.dataset.key = key;
    select.append(new Option("all", ""), ...values.sort().map((v) => new Option(v, v)));
    select.onchange = filter;
    const label = element("label", {}, words + " ");
    label.append(select);
    byId("filters").append(label);
  }
}

function listenToTable() {
  document.querySelectorAll("#summary thead th").forEach((head) => {
    const button = element("button", { type: "button" }, head.textContent);
    head.replaceChildren(button);
    button.onclick = () => {
      const key = head.dataset.key ?? "name";
      const again = byId("sort").value === key;
      byId("sort").value = key;
      byId("falling").checked = again && !byId("falling").checked;
      sort(key, byId("falling").checked);
    };
  });
}

function showPicture(name) {
  designs.forEach((design, k) => {
    const picture = cards[k].querySelector("img");
    picture.src = design.pictures[name];
    picture.alt = `${design.name}: ${name}`;
  });
  document.querySelectorAll(".scale-legend").forEach((legend) => {
    legend.hidden = legend.id !== "legend-" + name;
  });
}

function start() {
  document.body.classList.add("scripted");
  byId("sort").append(new Option("design", "name"),
    ...columns.map((c) => new Option(c.words, c.key)));
  byId("range-column").append(...columns.filter((c) => c.numeric)
    .map((c) => new Option(c.words, c.key)));
  const again = () => sort(byId("sort").value, byId("falling").checked);
  byId("sort").onchange = byId("falling").onchange = again;
  for (const id of ["find", "range-column", "range-low", "range-high"]) byId(id).oninput = filter;
  byId("all").onclick = () => {
    document.querySelectorAll("#filters select, #find, #range input").forEach((e) => { e.value = ""; });
    filter();
  };
  byId("picture").onchange = () => showPicture(byId("picture").value);
  addFilters();
  listenToTable();
  filter();
}

start();
