// What surrounds the picture: transport, curves, tables, and what is told of them.

const ICONS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M6.5 5h4v14h-4zM13.5 5h4v14h-4z",
  first: "M6 5h2.5v14H6zM19 5v14L9 12z",
  last: "M15.5 5H18v14h-2.5zM5 5v14l10-7z",
  back: "M12.5 6v12L5 12zM15 6h3v12h-3z",
  on: "M11.5 6v12l7.5-6zM6 6h3v12H6z",
};

function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

/** A button that shows an icon. */
function iconButton(name, label, click) {
  return el("button", { type: "button", class: "icon", "aria-label": label, title: label, click }, icon(name));
}

class Controls {
  constructor(player) {
    this.player = player;
    this.canvas = el("canvas", {
      class: "stage", tabindex: "0", role: "img", "aria-label": "The collision plane seen from above",
    });
    this.card = el("dl", { class: "card", hidden: true });
    this.cardRows = CARD.map((term) => [el("dt", { text: term }), el("dd")]);
    this.card.append(...this.cardRows.flat());
    this.notice = el("p", { class: "notice" });
    this.told = el("p", { class: "visually-hidden", role: "status", "aria-live": "polite" });
    const view = el("div", { class: "view" }, this.canvas, this.card, this.#nearness());
    this.lines = el("p", { class: "lines", hidden: true }, drawnLine([]), el("span", { text: player.label }), drawnLine([3, 5]), el("span", { class: "other" }));
    this.plots = el("div", { class: "plots", role: "group", "aria-label": "Curves over time; press one to look at that time" }, this.lines);
    this.roots = [el("div", { class: "desk" }, view, this.plots, this.#transport(), this.#options()), this.notice, this.told];
    this.tables = { bodies: bodyTable((body) => player.choose(body)), hits: hitTable() };
    for (const table of Object.values(this.tables)) table.turned = () => this.#fillTables();
    this.tablesRoot = el("div", { class: "tables" }, this.tables.bodies.root, this.tables.hits.root);
    new IntersectionObserver(([entry]) => (this.tablesSeen = entry.isIntersecting)).observe(this.tablesRoot);
  }

  #nearness() {
    const { player } = this;
    const button = (text, label, click) => el("button", { type: "button", text, "aria-label": label, title: label, click });
    return el("div", { class: "nearness", role: "group", "aria-label": "Zoom" },
      button("+", "nearer (+)", () => player.zoom(1.25)),
      button("−", "farther (−)", () => player.zoom(0.8)),
      button("⤢", "all of it (0)", () => player.fit()));
  }

  #transport() {
    const { player } = this;
    this.playButton = iconButton("play", "play (space)", () => player.toggle());
    this.scrubber = el("input", {
      type: "range", min: "0", max: "0", step: "1", value: "0", "aria-label": "time",
      input: () => player.moveTo(Number(this.scrubber.value)),
    });
    this.beats = el("canvas", { class: "beats", "aria-hidden": "true" });
    [this.seconds, this.iteration] = [el("b"), el("span")];
    this.clock = el("output", { class: "clock", "aria-label": "time and iteration" }, this.seconds, " ", this.iteration);
    this.speed = el("select", { "aria-label": "speed", change: () => {
      player.speed = Number(this.speed.value);
      player.steered = true;
    } },
      ...SPEEDS.map((speed) => el("option", { value: speed, text: speed < 1 ? `1⁄${1 / speed} ×` : `${speed} ×` })));
    return el("div", { class: "transport", role: "group", "aria-label": "Playing" },
      iconButton("first", "to the start (Home)", () => player.step(-Infinity)),
      iconButton("back", "one frame back (←)", () => player.step(-1)),
      this.playButton,
      iconButton("on", "one frame on (→)", () => player.step(1)),
      iconButton("last", "to the end (End)", () => player.step(Infinity)),
      el("div", { class: "track" }, this.beats, this.scrubber),
      this.clock,
      this.speed);
  }

  #options() {
    const { player } = this;
    this.shown = SHOWN.map(([what, key, text]) =>
      el("button", { type: "button", class: "toggle", "data-what": what, text, title: `${text.toLowerCase()} (${key})`,
        click: () => player.toggleShown(what) }));
    this.body = el("select", { "aria-label": "body", change: () => player.choose(this.body.value === "" ? null : Number(this.body.value)) });
    this.follow = el("button", { type: "button", class: "toggle", text: "Follow", title: "follow the chosen body (f)",
      click: () => player.follow(!player.following) });
    this.legend = el("ul", { class: "legend", "aria-label": "What the lines and fills mean" });
    return el("div", { class: "options" },
      el("div", { class: "toggles", role: "group", "aria-label": "What is drawn" }, ...this.shown),
      el("div", { class: "toggles", role: "group", "aria-label": "Body" }, this.body, this.follow),
      this.legend);
  }

  /** Another film, or other things laid over it. */
  filmChanged(laid) {
    const { player } = this;
    const { film, clock } = player;
    this.scrubber.max = clock.frames - 1;
    if (isOther(this.body, film.bodies.map(({ name }) => name))) {
      this.body.replaceChildren(el("option", { value: "", text: "no body chosen" }),
        ...film.bodies.map(({ name }, i) => el("option", { value: i, text: name })));
      this.chosen = undefined; // the new list shows nobody
    }
    this.notice.textContent = [
      ...film.head.notes,
      `Places are told to ${measure(film.head.quantum.place, "m")}, velocities to ${measure(film.head.quantum.velocity, "m/s")}.`,
    ].join(" ");
    this.#legendOf(film, laid);
    this.#plotsOf(film, laid.find(({ kind }) => kind === "B"), [clock.times[0], clock.times.at(-1)]);
    this.#drawBeats();
  }

  #legendOf(film, laid) {
    const kinds = ["mobile", "fixed", "driven"].filter((kind) => film.bodies.some((body) => body.kind === kind));
    const entries = [...kinds.map((kind) => [kind, KINDS[kind]]), ["contact", "exchange: point, normal, face"], ["velocity", "velocity"],
      ...(film.head.touches ? [["touch", "contact that lasts"]] : []),
      ...laid.map(({ kind, label }) => [kind === "ghost" ? "ghost" : "other", label])];
    if (!isOther(this.legend, [paletteOf(this.legend).stage, entries])) return;
    const pictures = entries.map(([kind]) => el("canvas", { class: "swatch", width: 44, height: 28, "aria-hidden": "true" }));
    this.legend.replaceChildren(...entries.map(([, text], k) => el("li", {}, pictures[k], el("span", { text }))));
    entries.forEach(([kind], k) => drawKey(pictures[k], kind));
  }

  #plotsOf(film, other, span) {
    const { player } = this;
    const seek = (time) => player.seek(time);
    const panels = panelsOf(film);
    const of = (make) => other && { ...make(other.film), film: other.film, label: other.label };
    this.lines.hidden = !other;
    say(this.lines.lastChild, other?.label ?? "");
    if (!this.curves) {
      this.curves = panels.map(() => new Plot(seek));
      this.ledger = new Plot(seek);
      this.quantity = el("select", { "aria-label": "quantity of the ledger", change: () => {
        player.quantity = Number(this.quantity.value);
        this.filmChanged(this.laid);
        player.redraw();
      } }, ...QUANTITIES.map(([, name], k) => el("option", { value: k, text: name })));
      this.ledger.heading.after(this.quantity);
      this.plots.append(...this.curves.map(({ root }) => root), this.ledger.root);
    }
    this.laid = other ? [other] : [];
    this.ledger.root.hidden = !film.head.causes.length;
    for (const plot of this.#plotsShown) plot.labelled = plot === this.#plotsShown.at(-1);
    panels.forEach((panel, k) => this.curves[k].show(panel, of((of) => panelsOf(of)[k]), film, span));
    if (!this.ledger.root.hidden) {
      this.ledger.show(ledgerPanel(film, player.quantity), of((of) => ledgerPanel(of, player.quantity)), film, span);
    }
  }

  get #plotsShown() {
    return this.ledger.root.hidden ? this.curves : [...this.curves, this.ledger];
  }

  /** How many exchanges there were, above the track: a bar a pixel. */
  #drawBeats() {
    const { film, clock } = this.player;
    const { context, width, height } = fitCanvas(this.beats);
    context.clearRect(0, 0, width, height);
    if (width === 0) return;
    const counts = new Float64Array(Math.ceil(width));
    for (let frame = 0; frame < film.frames; frame++) {
      const [from, to] = film.hitsIn(frame);
      const share = clock.frames > 1 ? clock.frameAt(film.times[frame]) / (clock.frames - 1) : 0;
      counts[clamp(Math.round(THUMB / 2 + share * (width - THUMB)), 0, counts.length - 1)] += to - from;
    }
    const most = counts.reduce((a, b) => Math.max(a, b), 1);
    const wide = clamp(Math.ceil((width - THUMB) / clock.frames), 1, 4);
    context.fillStyle = paletteOf(this.beats).contact;
    counts.forEach((count, x) => {
      const bar = count && Math.max(2, Math.sqrt(count / most) * height);
      context.fillRect(x, height - bar, wide, bar);
    });
  }

  resized() {
    this.#drawBeats();
    for (const plot of this.#plotsShown) plot.draw();
  }

  playing(playing) {
    const label = playing ? "pause (space)" : "play (space)";
    this.playButton.replaceChildren(icon(playing ? "pause" : "play"));
    this.playButton.title = label;
    this.playButton.setAttribute("aria-label", label);
  }

  /** The numbers of a moment; tables follow ten times a second while it plays. */
  update(frame, time) {
    const { player } = this;
    const { film } = player;
    const iteration = `iteration ${film.iteration[frame]}`;
    this.scrubber.value = player.position;
    mark(this.scrubber, "aria-valuetext", `${fixed(time, 3)} seconds, ${iteration}`);
    say(this.seconds, `${fixed(time, 3)} s`);
    say(this.iteration, iteration);
    for (const [k, [what]] of SHOWN.entries()) mark(this.shown[k], "aria-pressed", player.show[what]);
    mark(this.follow, "aria-pressed", player.following);
    if (this.chosen !== player.chosen) this.body.value = player.chosen ?? "";
    this.chosen = player.chosen;
    if (Number(this.speed.value) !== player.speed) this.speed.value = player.speed;
    for (const plot of this.#plotsShown) plot.at(time, frame);
    this.#showCard(film, frame);
    clearTimeout(this.later);
    const now = performance.now();
    if (!player.playing || (this.tablesSeen && now - (this.filled ?? 0) > 100)) {
      this.filled = now;
      this.#fillTables();
    }
    if (!player.playing) this.later = setTimeout(() => this.#tell(frame, time), 400);
  }

  #fillTables() {
    const { player } = this;
    if (!player.film) return;
    showBodies(this.tables.bodies, player.film, player.frame, player.chosen);
    showHits(this.tables.hits, player.film, player.frame);
  }

  #showCard(film, frame) {
    const { chosen } = this.player;
    this.card.hidden = chosen === null;
    if (chosen === null) return;
    const { name, kind, mass } = film.bodies[chosen];
    const { x, z, angle, vx, vz, spin } = film.state(frame, chosen);
    say(this.cardRows[0][0], name);
    const texts = [KINDS[kind], `${fixed(x, 3)}, ${fixed(z, 3)} m`, `${fixed(angle, 4)} rad`, `${fixed(vx, 3)}, ${fixed(vz, 3)} m/s`,
      `${fixed(Math.hypot(vx, vz), 3)} m/s`, `${fixed(spin, 4)} rad/s`, kind === "mobile" ? measure(mass, "kg") : "—"];
    texts.forEach((text, k) => say(this.cardRows[k][1], text));
  }

  /** Says where one is to who does not see it. */
  #tell(frame, time) {
    const { film, chosen } = this.player;
    const [from, to] = film.hitsIn(frame);
    const body = film.bodies[chosen];
    const { x, z } = body ? film.state(frame, chosen) : {};
    const where = body ? `, ${body.name} at ${fixed(x, 2)}, ${fixed(z, 2)} metres` : "";
    this.told.textContent = `${fixed(time, 3)} seconds, iteration ${film.iteration[frame]}, ${to - from} exchanges${where}`;
  }
}

const CARD = ["name", "place", "angle", "velocity", "speed", "spin", "mass"];

/** A swatch of a line in the colour of the text. */
function drawnLine(dash) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 26 8");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", "M0 4h26");
  line.setAttribute("stroke-dasharray", dash.join(" "));
  svg.append(line);
  return svg;
}

const THUMB = 16; // width of the scrubber's handle, which keeps its middle off the ends

/** What a kind of body or line looks like, twice as large as it is shown. */
function drawKey(canvas, kind) {
  const context = canvas.getContext("2d");
  const colour = paletteOf(canvas);
  context.clearRect(0, 0, 44, 28);
  context.beginPath();
  context.lineWidth = 3;
  if (kind === "contact" || kind === "velocity") {
    context.strokeStyle = colour[kind];
    if (kind === "contact") {
      diamond(context, 10, 14, 8);
      context.moveTo(10, 1);
      context.lineTo(10, 27);
    }
    arrow(context, kind === "contact" ? 10 : 2, 14, 42, 14, 9);
    return context.stroke();
  }
  if (kind === "touch") {
    context.strokeStyle = colour.contact;
    context.arc(22, 14, 5, 0, TAU);
    context.moveTo(8, 14);
    context.lineTo(36, 14);
    return context.stroke();
  }
  context.rect(2, 3, 40, 22);
  if (kind === "ghost" || kind === "other") {
    context.setLineDash(kind === "ghost" ? [4, 5] : [12, 5]);
    context.strokeStyle = colour[kind];
    return context.stroke();
  }
  const [line, ground] = [colour[kind], colour[`${kind}-fill`]];
  context.fillStyle = kind === "mobile" ? ground : hatch(context, line, ground, kind === "driven", 1);
  context.fill();
  context.strokeStyle = line;
  context.stroke();
}
