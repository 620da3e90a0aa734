// SPDX-License-Identifier: MIT
// Tables of the page: a table of data becomes a section whose columns sort by a click; the best of a column stands
// out. Also makes elements for report.js, which stands after this. ASCII only.

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function numberText(value, column) {
  if (typeof value !== "number") return value;
  if (column.unit === "%") return (column.better || value < 0 ? "" : "+") + (value * 100).toFixed(column.digits);
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) return value.toExponential(column.digits - 1);
  return value.toFixed(Math.max(column.digits - 1 - Math.floor(Math.log10(size)), 0));
}

// Texts after numbers, "infinite" at its end.
function compareCells(a, b) {
  const order = (cell) => (typeof cell === "number" ? cell : cell === "infinite" ? Infinity
    : cell === "-infinite" ? -Infinity : null);
  const x = order(a), y = order(b);
  if (x !== null && y !== null) return x - y || 0;
  if (x !== null || y !== null) return x !== null ? -1 : 1;
  return String(a).localeCompare(String(b));
}

function bestOf(table, c) {
  const better = table.columns[c].better;
  const numbers = table.rows.map((row) => row[c]).filter((cell) => typeof cell === "number");
  if (!better || numbers.length < 2) return null;
  return better > 0 ? Math.max(...numbers) : Math.min(...numbers);
}

function bodyRow(table, row, best, onShow) {
  const tr = element("tr");
  row.forEach((cell, c) => {
    const isNumber = typeof cell === "number";
    const text = numberText(cell, table.columns[c]);
    const td = element("td", {className: isNumber ? "number" : "text"});
    if (c === 0 && onShow) {
      td.append(element("button", {type: "button", textContent: text, title: "Show it as A", onclick: () => onShow(cell)}));
    } else {
      td.textContent = text;
    }
    if (isNumber && cell === best[c]) {
      td.classList.add("best");
      td.title = "best of the column";
    }
    tr.append(td);
  });
  return tr;
}

function tableSection(table, onShow) {
  const best = table.columns.map((_, c) => bestOf(table, c));
  const body = element("tbody"), head = element("tr");
  const fill = (rows) => body.replaceChildren(...rows.map((row) => bodyRow(table, row, best, onShow)));
  table.columns.forEach((column, c) => {
    const th = element("th", {scope: "col", title: column.hint});
    const button = element("button", {type: "button", textContent: column.name});
    button.onclick = () => {
      const up = th.getAttribute("aria-sort") !== "ascending";
      for (const other of head.children) other.removeAttribute("aria-sort");
      th.setAttribute("aria-sort", up ? "ascending" : "descending");
      fill([...table.rows].sort((a, b) => (up ? 1 : -1) * compareCells(a[c], b[c])));
    };
    th.append(button);
    if (table.columns.some((any) => any.unit)) th.append(element("small", {textContent: column.unit || "\u00a0"}));
    if (!table.rows.some((row) => typeof row[c] === "number")) th.className = "text";
    head.append(th);
  });
  fill(table.rows);
  const section = element("section", {className: "results"}, element("h2", {textContent: table.title}));
  section.setAttribute("aria-label", table.title);
  if (table.note) section.append(element("p", {textContent: table.note}));
  section.append(element("div", {className: "scroll"}, element("table", {}, element("thead", {}, head), body)));
  return section;
}
