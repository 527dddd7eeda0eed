// Names of bodies, where there is room for them.

const MOST_LABELS = 250;
const LABEL_FONT = "12px system-ui, sans-serif";
const LABEL_TALL = 18; // pixels

/** Names as they are drawn: each once, and copied from then on. */
class Labels {
  #known = new Map();

  /** Colours are others now. */
  clear() {
    this.#known.clear();
  }

  /** `named`: { name, px, py, always }, the most wanted first; a name that would cover one before it is left out. */
  draw(context, colour, { width, height }, pixel, named) {
    const taken = [];
    for (const { name, px, py, always } of named) {
      const { picture, wide } = this.#label(context, colour, pixel, name);
      const left = Math.round(clamp(px - wide / 2, 0, Math.max(0, width - wide)));
      const top = Math.round(clamp(py - LABEL_TALL / 2, 0, Math.max(0, height - LABEL_TALL)));
      const isFree = taken.every(([x, y, w]) => left > x + w || left + wide < x || Math.abs(top - y) > LABEL_TALL - 4);
      if (!isFree && !always) continue;
      taken.push([left, top, wide]);
      context.drawImage(picture, left, top, wide, LABEL_TALL);
      if (taken.length === MOST_LABELS) return;
    }
  }

  /** A name with a rim of the ground around it. */
  #label(context, colour, pixel, name) {
    const known = this.#known.get(name);
    if (known?.pixel === pixel) return known;
    context.font = LABEL_FONT;
    const wide = Math.ceil(context.measureText(name).width) + 6;
    const picture = el("canvas", { width: Math.ceil(wide / pixel), height: Math.ceil(LABEL_TALL / pixel) });
    const pen = picture.getContext("2d");
    pen.scale(1 / pixel, 1 / pixel);
    Object.assign(pen, { font: LABEL_FONT, textBaseline: "middle", lineJoin: "round", lineWidth: 3, strokeStyle: colour.stage, fillStyle: colour.ink });
    pen.strokeText(name, 3, LABEL_TALL / 2);
    pen.fillText(name, 3, LABEL_TALL / 2);
    const label = { picture, wide, pixel };
    if (this.#known.size > 4 * MOST_LABELS) this.#known.clear();
    this.#known.set(name, label);
    return label;
  }
}
