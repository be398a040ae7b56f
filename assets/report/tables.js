// SPDX-License-Identifier: MIT
// Tables: sorting by their heads, and heads that stay in sight.
"use strict";
(function () {
  const names = new Intl.Collator("en", {numeric: true});

  /// Numbers before text; what has no value is last, in either direction.
  function compare(a, b, sign) {
    if (a.empty || b.empty) return a.empty - b.empty;
    const numbers = !Number.isNaN(a.number) && !Number.isNaN(b.number);
    return sign * (numbers ? a.number - b.number : names.compare(a.text, b.text));
  }

  /// By one more click the rows rise, fall, and are as they were.
  function sort(table, head) {
    const body = table.tBodies[0];
    const order = {none: "ascending", ascending: "descending", descending: "none"}[head.getAttribute("aria-sort")];
    for (const other of table.tHead.querySelectorAll("[aria-sort]")) other.setAttribute("aria-sort", "none");
    head.setAttribute("aria-sort", order);
    const column = Number(head.dataset.column), sign = order === "ascending" ? 1 : -1;
    const keyed = Array.from(body.rows, (row) => {
      const cell = row.cells[column];
      return {row, number: parseFloat(cell.dataset.value), text: cell.textContent, empty: cell.querySelector(".none") !== null};
    });
    if (order === "none") keyed.sort((a, b) => a.row.dataset.index - b.row.dataset.index);
    else keyed.sort((a, b) => compare(a, b, sign) || a.row.dataset.index - b.row.dataset.index);
    body.append(...keyed.map((key) => key.row));
  }

  /// A head may span two rows or stand in the second: its column is counted as the cells lie.
  function numberHeads(table) {
    const rows = table.tHead.rows, taken = [];
    Array.from(rows).forEach((row, line) => {
      let column = 0;
      for (const head of row.cells) {
        while (taken[column] > line) ++column;
        head.dataset.column = column;
        for (let i = 0; i < head.colSpan; ++i) taken[column + i] = line + head.rowSpan;
        column += head.colSpan;
      }
    });
  }

  function setUp(table) {
    numberHeads(table);
    Array.from(table.tBodies[0].rows).forEach((row, index) => { row.dataset.index = index; });
    for (const head of table.tHead.querySelectorAll("[aria-sort]"))
      head.querySelector("button").addEventListener("click", () => sort(table, head));
    // A box that scrolls keeps its head at its own top; a table that fits needs no box, and keeps it at the window's.
    const box = table.parentElement;
    const fit = () => box.classList.toggle("fits", table.offsetWidth <= box.parentElement.clientWidth);
    new ResizeObserver(() => requestAnimationFrame(fit)).observe(box.parentElement);
    fit();
  }

  document.querySelectorAll("table.data").forEach(setUp);
})();
