"use strict";
// Sorts the table by the column that is clicked, the other way round at the second click.
if (location.protocol === "data:")
  document.querySelectorAll("td a").forEach((a) => a.replaceWith(a.textContent));
document.querySelectorAll("#summary th button").forEach((button, k) => {
  let turn = 1;
  button.onclick = () => {
    const body = document.querySelector("#summary tbody");
    const text = (row) => row.cells[k].textContent;
    const number = (row) => Number(row.cells[k].dataset.value ?? Infinity);
    const numeric = [...body.rows].some((row) => row.cells[k].dataset.value !== undefined);
    const rows = [...body.rows].sort((a, b) => turn * (numeric ? number(a) - number(b) || 0
      : text(a).localeCompare(text(b), "en", { numeric: true })));
    body.replaceChildren(...rows);
    turn = -turn;
  };
});
