// The sliders: what was moved away from the script's value, and by how much.

import { LABELS, MEANINGS, byId, el, shown } from "./dom.js";

const DOCUMENTS = ["mu_l", "mu_a", "epsilon"];

export class Sliders {
  #rows = new Map();
  #order = "";
  /** name → value, of those that differ from the script. */
  moved = new Map();

  constructor(changed) {
    this.root = byId("sliders");
    this.changed = changed;
  }

  /** What a run is asked with. */
  get set() {
    return [...this.moved];
  }

  /** Shows the sliders of a scenario. One that is being moved stays under the hand that moves it. */
  show(all) {
    // The numbers of impulses are for scenes that have them; those of the document are always in sight.
    const sliders = all.filter(({ name, idle }) => !idle || DOCUMENTS.includes(name) || this.moved.has(name));
    const order = sliders.map((slider) => slider.name).join("\n");
    if (order !== this.#order) {
      this.#order = order;
      this.#rows = new Map(sliders.map((slider) => [slider.name, new Row(slider, (value) => this.#move(slider.name, value))]));
      const group = (title, some) => (some.length ? [el("h4", { text: title }), ...some] : []);
      const rows = (wanted) => sliders.filter(wanted).map((slider) => this.#rows.get(slider.name).root);
      this.root.replaceChildren(
        ...group("Settings", rows((slider) => !slider.is_param)),
        ...group("Params of the script", rows((slider) => slider.is_param)),
      );
    }
    for (const slider of sliders) {
      if (this.moved.get(slider.name) === slider.written) this.moved.delete(slider.name);
      this.#rows.get(slider.name).update(slider, this.moved.get(slider.name));
    }
  }

  /** Everything as the script has it. */
  reset() {
    this.moved.clear();
    for (const row of this.#rows.values()) row.update(row.slider, undefined);
    this.changed();
  }

  /** These values are the script's own from now on, unless they have been moved again. */
  written(set) {
    for (const [name, value] of set) if (this.moved.get(name) === value) this.moved.delete(name);
  }

  drop(names) {
    for (const name of names) this.moved.delete(name);
  }

  #move(name, value) {
    const row = this.#rows.get(name);
    if (value === row.slider.written) this.moved.delete(name);
    else this.moved.set(name, value);
    row.update(row.slider, this.moved.get(name));
    this.changed();
  }
}

/** One slider: its name, a box for an exact number, the way back to the script's value. */
class Row {
  constructor(slider, move) {
    const label = LABELS[slider.name] ?? slider.name;
    this.range = el("input", { type: "range", "aria-label": label });
    this.box = el("input", { type: "text", inputmode: "decimal", "aria-label": `${label}, exactly`, autocomplete: "off" });
    this.back = el("button", { type: "button", class: "back", "aria-label": `${label} back to the script's value`, text: "↺" });
    this.hint = el("p", { class: "hint" });
    const meaning = MEANINGS[slider.name];
    const name = el("span", { class: "name", text: label, ...(meaning ? { title: meaning } : {}) });
    this.root = el("div", { class: "slider", "data-name": slider.name },
      el("div", { class: "line" }, name, this.back, this.box), this.range, this.hint);
    this.range.addEventListener("input", () => move(this.range.valueAsNumber));
    this.box.addEventListener("change", () => this.#typed(move));
    this.back.addEventListener("click", () => {
      move(this.slider.written);
      this.range.focus();
    });
  }

  update(slider, moved) {
    this.slider = slider;
    const value = moved ?? slider.written;
    // A number typed beyond the slider stretches it, where the script allows.
    const [min, max] = [Math.min(slider.min, value), Math.max(slider.max, value)];
    // Steps count from the least value; the script's own is among them only if any number is.
    const onStep = Number.isInteger(Math.round(((slider.written - min) / slider.step) * 1e9) / 1e9);
    Object.assign(this.range, { min, max, step: onStep ? slider.step : "any" });
    if (this.range.valueAsNumber !== value) this.range.value = value;
    if (document.activeElement !== this.box) this.box.value = String(value);
    this.range.style.setProperty("--at", `${max > min ? (100 * (value - min)) / (max - min) : 0}%`);
    this.back.hidden = moved === undefined;
    this.root.classList.toggle("moved", moved !== undefined);
    this.root.classList.toggle("idle", slider.idle !== "");
    this.#say(slider.idle || (moved === undefined ? "" : `the script says ${shown(slider.written)}`));
  }

  #typed(move) {
    const text = this.box.value.trim().replace(",", ".").replace("−", "-");
    const value = Number(text);
    const { min, max, is_bound: bound, name } = this.slider;
    if (text === "" || !Number.isFinite(value)) this.#say("that is no number");
    else if (bound && (value < min || value > max)) this.#say(`the script allows ${shown(min)} … ${shown(max)}`);
    else if (!this.slider.is_param && value < 0) this.#say(`${LABELS[name]} is 0 or more`);
    else if (name === "restitution" && value > 1) this.#say("e is between 0 and 1");
    else move(value);
  }

  #say(text) {
    this.hint.textContent = text;
    this.hint.hidden = text === "";
  }
}
