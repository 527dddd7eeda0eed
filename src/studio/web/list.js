// The list of scenarios: by folder, narrowed by what is typed, walked with the arrow keys.

import { byId, el } from "./dom.js";

export class List {
  #scenarios = [];
  #chosen = null;

  constructor() {
    this.root = byId("scenarios");
    // Where there is little room the list folds away, and again when something has been chosen from it.
    this.fold = this.root.closest("details");
    this.narrow = matchMedia("(max-width: 1080px)");
    this.narrow.addEventListener("change", () => (this.fold.open = !this.narrow.matches));
    this.fold.open = !this.narrow.matches;
    this.filter = byId("filter");
    this.filter.addEventListener("input", () => this.#show());
    this.filter.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === "ArrowDown") {
        const first = this.#links()[0];
        if (event.key === "Enter") first?.click();
        else first?.focus();
        event.preventDefault();
      }
    });
    this.root.addEventListener("keydown", (event) => this.#walk(event));
  }

  get scenarios() {
    return this.#scenarios;
  }

  about(id) {
    return this.#scenarios.find((scenario) => scenario.id === id)?.about ?? "";
  }

  load(scenarios) {
    this.#scenarios = scenarios;
    this.#show();
  }

  choose(id) {
    if (this.narrow.matches && id !== this.#chosen) this.fold.open = false;
    this.#chosen = id;
    this.#mark();
    if (this.fold.open) this.root.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" });
  }

  #show() {
    const wanted = this.filter.value.trim().toLowerCase();
    const matches = ({ id, about }) => `${id} ${about}`.toLowerCase().includes(wanted);
    const folders = new Map([["", []]]); // what lies in no folder stands first, under no heading
    for (const scenario of this.#scenarios.filter(matches)) {
      const at = scenario.id.lastIndexOf("/");
      const folder = scenario.id.slice(0, Math.max(at, 0));
      folders.set(folder, [...(folders.get(folder) ?? []), scenario]);
    }
    const link = ({ id, about }) =>
      el("li", {}, el("a", { href: `#${encodeURI(id)}`, title: about, "data-id": id, text: breakable(name(id)) }));
    const parts = [...folders].filter(([, scenarios]) => scenarios.length).flatMap(([folder, scenarios]) => [
      ...(folder ? [el("h3", { text: folder })] : []),
      el("ul", {}, ...scenarios.map(link)),
    ]);
    const none = this.#scenarios.length ? "Nothing of that name." : "There are no scenarios (.rhai or .ron) here yet.";
    this.root.replaceChildren(...(parts.length ? parts : [el("p", { class: "faint", text: none })]));
    this.#mark();
  }

  #mark() {
    for (const link of this.#links()) {
      if (link.dataset.id === this.#chosen) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  }

  #links() {
    return [...this.root.querySelectorAll("a")];
  }

  #walk(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const links = this.#links();
    const at = links.indexOf(document.activeElement);
    if (!by || at < 0) return;
    event.preventDefault();
    if (at + by < 0) this.filter.focus();
    else links[at + by]?.focus();
  }
}

/** Long names break after an underscore. */
const breakable = (text) => text.replaceAll("_", "_\u200b");

/** A scenario's name without its folder and extension. */
export function name(id) {
  return id.slice(id.lastIndexOf("/") + 1).replace(/\.rhai$/, "");
}
