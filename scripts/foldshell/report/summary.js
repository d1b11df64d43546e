"use strict";
// Sorts the table by the column that is clicked, the other way round at the second click.
if (location.protocol === "data:")
  document.querySelectorAll("td a").forEach((a) => a.replaceWith(a.textContent));
document.querySelectorAll("#summary th button").forEach((button, k) => {
  let turn = 1;
  button.onclick = () => {
    const body = document.querySelector("#summary tbody");
    const key = (row) => row.cells[k].dataset.value ?? row.cells[k].textContent;
    const rows = [...body.rows].sort((a, b) => turn * key(a).localeCompare(key(b), "en",
      { numeric: true }));
    const numbers = [...body.rows].every((row) => !row.cells[k].className.includes("number")
      || row.cells[k].dataset.value === undefined) ? null : (row) =>
      Number(row.cells[k].dataset.value ?? Infinity);
    if (numbers) rows.sort((a, b) => turn * (numbers(a) - numbers(b)));
    body.replaceChildren(...rows);
    turn = -turn;
  };
});
