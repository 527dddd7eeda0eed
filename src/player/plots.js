// Curves over time under one cursor.

const DASHES = [[], [7, 4], [2, 3], [8, 3, 2, 3], [4, 2], [12, 4]];
const CURVES = 6;

/** The panels: what each shows, and in which unit. */
function panelsOf(film) {
  const { series } = film;
  const curve = (name, key) => ({ name, values: series[key] });
  return [
    { title: "Kinetic energy", unit: "J", curves: [curve("", "kinetic_energy")], zero: true },
    { title: "Momentum", unit: "kg·m/s", curves: [curve("X", "momentum_x"), curve("Z", "momentum_z")] },
    { title: "Angular momentum", unit: "kg·m²/s", curves: [curve("", "angular_momentum")] },
    { title: "Deepest overlap", unit: "m", curves: [curve("", "deepest")], zero: true },
  ];
}

const QUANTITIES = [["kinetic_energy", "kinetic energy", "J"], ["momentum_x", "momentum along X", "kg·m/s"],
  ["momentum_z", "momentum along Z", "kg·m/s"], ["angular_momentum", "angular momentum", "kg·m²/s"]];

const CAUSES = { mu_l: "μ_L", mu_a: "μ_A" };

/** What each cause has changed of a quantity; causes that changed nothing are left out. */
function ledgerPanel(film, quantity) {
  const [key, name, unit] = QUANTITIES[quantity];
  const curves = (film.head.causes ?? [])
    .map((cause) => ({ name: CAUSES[cause] ?? cause.replaceAll("_", " "), values: film.series[`${cause}.${key}`] }))
    .filter(({ values }) => values); // a column of noughts is not written
  return { title: "Ledger", of: name, unit, curves, zero: true };
}

/** One panel: a drawn picture that only changes with the film or the size, and a cursor over it. */
class Plot {
  constructor(seek) {
    this.canvas = el("canvas", { class: "curves", "aria-hidden": "true" });
    this.cursor = el("div", { class: "cursor" });
    this.readings = el("ul", { class: "readings" });
    this.heading = el("h3");
    this.area = el("div", { class: "plot-area" }, this.canvas, this.cursor);
    this.root = el("section", { class: "plot" }, el("header", {}, this.heading, this.readings), this.area);
    const pick = (event) => {
      const box = this.area.getBoundingClientRect();
      const share = clamp((event.clientX - box.left - GUTTER) / (box.width - GUTTER - EDGE), 0, 1);
      seek(this.span[0] + share * (this.span[1] - this.span[0]));
    };
    this.area.addEventListener("pointerdown", (event) => {
      this.area.setPointerCapture(event.pointerId);
      pick(event);
    });
    this.area.addEventListener("pointermove", (event) => this.area.hasPointerCapture(event.pointerId) && pick(event));
  }

  /** `panel` is one of the above; `other` the same panel of a run laid over with its film, or nothing; `span` the times from and to. */
  show(panel, other, film, span) {
    Object.assign(this, { panel, other, film, span });
    this.heading.textContent = panel.title;
    this.root.classList.toggle("single", panel.curves.length === 1);
    this.root.classList.toggle("beside", Boolean(other));
    // Room for the longest reading, so that none moves another while the film plays.
    const longest = panel.curves.map(({ name, values }) => `${name} ${measure(-greatest(values), panel.unit)}`.length);
    this.readings.style.setProperty("--reading", `${0.88 * Math.max(0, ...longest)}ch + 34px`);
    const same = panel.curves.map(({ name }) => other?.curves.find((curve) => curve.name === name));
    if (isOther(this.readings, panel.curves.map(({ name }, k) => [name, same[k] && other.label]))) this.#readingsOf(panel, other, same);
    this.entries.forEach((entry, k) => (entry.same = same[k]));
    this.draw();
  }

  #readingsOf(panel, other, same) {
    this.entries = panel.curves.map(({ name }, k) => {
      const line = el("canvas", { class: "swatch", width: 52, height: 16, "aria-hidden": "true" });
      const [value, beside] = [el("output"), el("output", { class: "other" })];
      const spoken = same[k] ? [el("span", { class: "visually-hidden", text: `, ${other.label}: ` }), beside] : [];
      return { line, value, beside, item: el("li", {}, line, el("span", { class: "curve-name", title: name, text: name }), value, ...spoken) };
    });
    const nothing = el("li", { text: "nothing was booked" });
    this.readings.replaceChildren(...(this.entries.length ? this.entries.map(({ item }) => item) : [nothing]));
  }

  draw() {
    if (!this.panel || this.canvas.clientWidth === 0) return void (this.width = 0);
    const { context, width, height } = fitCanvas(this.canvas);
    this.width = width; // kept: asking for it while the film plays would have the page laid out again
    const colour = paletteOf(this.canvas);
    context.clearRect(0, 0, width, height);
    const curves = [...this.panel.curves, ...(this.other?.curves ?? [])];
    const [low, high] = rangeOf(curves, this.panel.zero);
    const frame = { left: GUTTER, right: width - EDGE, top: 5, bottom: height - (this.labelled ? 20 : 5), low, high, span: this.span };
    drawTimes(context, colour, frame, this.labelled);
    drawGrid(context, colour, frame, this.panel.unit);
    for (const [k, { values }] of (this.other?.curves ?? []).entries()) {
      drawCurve(context, frame, this.other.film.times, values, { line: colour[`curve-${k % CURVES}`], width: 1.5, dash: [1.5, 2.5] });
    }
    for (const [k, { values }] of this.panel.curves.entries()) {
      const look = { line: colour[`curve-${k % CURVES}`], width: 1.75, dash: DASHES[(k + (k >= CURVES)) % DASHES.length] };
      drawCurve(context, frame, this.film.times, values, look);
      this.#swatch(this.entries[k].line, look);
    }
  }

  #swatch(canvas, { line, dash }) {
    if (!isOther(canvas, [line, dash])) return;
    const pen = canvas.getContext("2d");
    pen.clearRect(0, 0, 52, 16);
    pen.setLineDash(dash.map((length) => length * 2));
    [pen.strokeStyle, pen.lineWidth] = [line, 4];
    pen.beginPath();
    pen.moveTo(0, 8);
    pen.lineTo(52, 8);
    pen.stroke();
  }

  /** Moves the cursor there, and tells the numbers. */
  at(time, frame) {
    const [from, to] = this.span;
    const share = to > from ? (time - from) / (to - from) : 0;
    const x = GUTTER + clamp(share, 0, 1) * (this.width - GUTTER - EDGE);
    this.cursor.style.transform = `translateX(${x}px)`;
    const there = this.other?.film.frameAt(time);
    for (const [k, { value, beside, same }] of this.entries.entries()) {
      say(value, measure(this.panel.curves[k].values[frame], this.panel.unit));
      if (same) say(beside, measure(same.values[there], this.panel.unit));
    }
  }
}

const greatest = (values) => values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);

const GUTTER = 58; // pixels left of the curves, for their numbers
const EDGE = 10;

function rangeOf(curves, zero) {
  let [low, high] = zero ? [0, 0] : [Infinity, -Infinity];
  for (const { values } of curves) {
    for (const value of values) {
      if (!Number.isFinite(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (!(low <= high)) return [0, 1];
  if (low === high) return low === 0 ? [0, 1] : [Math.min(0, 2 * low), Math.max(0, 2 * high)];
  // What differs by rounding alone is drawn as what it is: a level line.
  const least = 1e-9 * Math.max(Math.abs(low), Math.abs(high));
  const room = Math.max((high - low) * 0.06, least);
  return [zero && low === 0 ? 0 : low - room, high + room];
}

function drawGrid(context, colour, { left, right, top, bottom, low, high }, unit) {
  const [factor, scaled] = scaleOf(Math.max(Math.abs(low), Math.abs(high)), unit);
  const step = niceStep(((high - low) / factor) * (26 / (bottom - top)));
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.lineWidth = 1;
  const decimals = clamp(Math.ceil(-Math.log10(step) - 1e-9), 0, 9);
  for (let k = Math.ceil(low / factor / step); k * step * factor <= high; k++) {
    const y = Math.round(bottom - ((k * step * factor - low) / (high - low)) * (bottom - top)) + 0.5;
    context.strokeStyle = k === 0 ? colour.axis : colour.grid;
    context.beginPath();
    context.moveTo(left, y);
    context.lineTo(right, y);
    context.stroke();
    context.fillStyle = colour.faint;
    context.fillText(fixed(k * step, decimals), left - 6, y);
  }
  context.save();
  context.translate(9, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  const wide = context.measureText(scaled).width;
  if (wide > bottom - top + 10) context.scale((bottom - top + 10) / wide, (bottom - top + 10) / wide);
  context.fillText(scaled, 0, 0);
  context.restore();
}

/** Lines at round times, through all panels; the lowest panel tells which. */
function drawTimes(context, colour, { left, right, top, bottom, span: [from, to] }, labelled) {
  if (!(to > from)) return;
  const step = niceStep((to - from) * (64 / (right - left)));
  const decimals = clamp(Math.ceil(-Math.log10(step) - 1e-9), 0, 9);
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "top";
  context.lineWidth = 1;
  context.strokeStyle = colour.grid;
  context.fillStyle = colour.faint;
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k++) {
    const x = Math.round(left + ((k * step - from) / (to - from)) * (right - left)) + 0.5;
    context.beginPath();
    context.moveTo(x, top);
    context.lineTo(x, bottom);
    context.stroke();
    if (labelled) context.fillText(`${fixed(k * step, decimals)} s`, Math.min(x, right - 4), bottom + 5);
  }
}

/** At most a few points a pixel are drawn, and among them the least and the greatest of all that fall there. */
function drawCurve(context, { left, right, top, bottom, low, high, span }, times, values, { line, width, dash }) {
  const [from, to] = span;
  const across = to > from ? (right - left) / (to - from) : 0;
  const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  const every = Math.max(1, Math.floor(times.length / (2 * (right - left))));
  context.beginPath();
  let pen = "moveTo";
  for (let start = 0; start < times.length; start += every) {
    let [least, most] = [start, start];
    for (let i = start; i < Math.min(start + every, times.length); i++) {
      if (values[i] < values[least]) least = i;
      if (values[i] > values[most]) most = i;
    }
    for (const i of least === most ? [least] : [Math.min(least, most), Math.max(least, most)]) {
      if (!Number.isFinite(values[i]) || times[i] < from - 1e-9 || times[i] > to + 1e-9) continue;
      context[pen](left + (times[i] - from) * across, y(values[i]));
      pen = "lineTo";
    }
  }
  [context.strokeStyle, context.lineWidth] = [line, width];
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}
