// Numbers at the cursor as tables: bodies, and the exchanges of the frame.

/** A table of which a page of rows is there at a time, so that a thousand bodies cost no more than twenty. */
class Table {
  /** `columns`: [name, unit]; `pick(key)` is called when a row's button is pressed. */
  constructor(title, columns, { rows = 20, filter = false, pick = null } = {}) {
    Object.assign(this, { rows, page: 0, total: 0, pick, cells: [] });
    const column = ([name, unit]) =>
      el("th", { scope: "col" }, name, unit ? el("span", { class: "unit", text: ` ${unit}` }) : "");
    this.body = el("tbody");
    this.count = el("span", { class: "count" });
    this.columns = columns;
    this.back = el("button", { type: "button", text: "‹", "aria-label": `earlier ${title.toLowerCase()}`, click: () => this.turn(-1) });
    this.on = el("button", { type: "button", text: "›", "aria-label": `later ${title.toLowerCase()}`, click: () => this.turn(1) });
    this.filter = el("input", { type: "search", placeholder: "by name", "aria-label": `${title} by name`, input: () => this.turn(-Infinity) });
    const tools = el("div", { class: "table-tools" }, filter ? this.filter : "", this.count, this.back, this.on);
    const head = el("thead", {}, el("tr", {}, ...columns.map(column)));
    this.root = el("section", { class: "table" }, el("header", {}, el("h3", { text: title }), tools),
      el("div", { class: "table-scroll", tabindex: "0", role: "region", "aria-label": title }, el("table", {}, head, this.body)));
  }

  turn(pages) {
    this.page = clamp(this.page + pages, 0, Math.max(0, Math.ceil(this.total / this.rows) - 1));
    this.turned?.();
  }

  /** Shows rows `[key, ...cells]` made by `row(i)` for the indices of a page; `marked` is the key of the chosen one. */
  show(indices, row, marked = null) {
    this.total = indices.length;
    this.page = clamp(this.page, 0, Math.max(0, Math.ceil(this.total / this.rows) - 1));
    const shown = indices.slice(this.page * this.rows, (this.page + 1) * this.rows);
    while (this.cells.length < shown.length) this.#addRow();
    while (this.cells.length > shown.length) this.cells.pop().row.remove();
    shown.forEach((index, k) => {
      const { row: line, cells } = this.cells[k];
      const [key, ...texts] = row(index);
      texts.forEach((text, column) => {
        if (cells[column].textContent !== text) cells[column].textContent = text;
      });
      this.cells[k].key = key;
      line.toggleAttribute("aria-current", key === marked && marked !== null);
    });
    const from = this.page * this.rows;
    this.count.textContent = this.total === 0 ? "none" : `${from + 1}–${from + shown.length} of ${this.total}`;
    this.back.disabled = this.page === 0;
    this.on.disabled = from + shown.length >= this.total;
  }

  #addRow() {
    const entry = { key: null };
    entry.cells = this.columns.map((_, column) => {
      if (column > 0 || !this.pick) return column === 0 ? el("th", { scope: "row" }) : el("td");
      return el("button", { type: "button", class: "pick", click: () => this.pick(entry.key) });
    });
    const cell = (inner, column) => (column === 0 && this.pick ? el("th", { scope: "row" }, inner) : inner);
    entry.row = el("tr", {}, ...entry.cells.map(cell));
    this.cells.push(entry);
    this.body.append(entry.row);
  }
}

const KINDS = { mobile: "mobile", fixed: "fixed", driven: "fixed, moving" };

function bodyTable(pick) {
  const columns = [["body"], ["kind"], ["x", "m"], ["z", "m"], ["angle", "rad"], ["vx", "m/s"], ["vz", "m/s"],
    ["speed", "m/s"], ["spin", "rad/s"]];
  return new Table("Bodies", columns, { filter: true, pick });
}

function showBodies(table, film, frame, chosen) {
  const wanted = table.filter.value.trim().toLowerCase();
  const indices = film.bodies.flatMap((body, i) => (body.name.toLowerCase().includes(wanted) ? [i] : []));
  const row = (i) => {
    const { name, kind } = film.bodies[i];
    const { x, z, angle, vx, vz, spin } = film.state(frame, i);
    const numbers = [x, z, angle, vx, vz, Math.hypot(vx, vz), spin].map((value) => fixed(value, 3));
    return [i, name, KINDS[kind], ...numbers];
  };
  table.show(indices, row, chosen);
}

function hitTable() {
  const columns = [["pair"], ["iteration"], ["x", "m"], ["z", "m"], ["normal x"], ["normal z"], ["depth", ""]];
  return new Table("Exchanges in this frame", columns, { rows: 8 });
}

function showHits(table, film, frame) {
  const [from, to] = film.hitsIn(frame);
  const { a, b, x, z, normal, depth, iteration } = film.hits;
  const row = (hit) => [
    hit,
    `${film.bodies[a[hit]].name} · ${film.bodies[b[hit]].name}`,
    String(iteration[hit] + 1),
    fixed(x[hit], 3),
    fixed(z[hit], 3),
    fixed(Math.cos(normal[hit]), 3),
    fixed(Math.sin(normal[hit]), 3),
    measure(depth[hit], "m"),
  ];
  table.show(Array.from({ length: to - from }, (_, k) => from + k), row);
}
