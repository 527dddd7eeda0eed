// What came of a run, in numbers: this one, and the one kept as A beside it.

import { byId, el, shown } from "./dom.js";

const ROWS = [
  ["Kinetic energy", "J", (outcome) => outcome.kinetic_energy],
  ["Momentum x", "kg·m/s", (outcome) => outcome.momentum[0]],
  ["Momentum z", "kg·m/s", (outcome) => outcome.momentum[1]],
  ["Angular momentum", "kg·m²/s", (outcome) => outcome.angular_momentum],
  ["Deepest overlap", "m", (outcome) => outcome.deepest],
  ["Collisions", "", (outcome) => outcome.collisions],
  ["Time", "s", (outcome) => outcome.time],
];

export function showNumbers(outcome, a) {
  const table = byId("numbers");
  if (!outcome) return table.replaceChildren();
  const cells = (value) => [el("td", { text: value(outcome) }), ...(a ? [el("td", { text: value(a) })] : [])];
  const head = a ? [el("thead", {}, el("tr", {}, el("td"), el("th", { scope: "col", text: "now" }), el("th", { scope: "col", text: "A" })))] : [];
  const row = ([label, unit, read]) => {
    const differs = a && read(outcome) !== read(a);
    const name = el("th", { scope: "row", text: label }, ...(unit ? [el("span", { class: "unit", text: ` ${unit}` })] : []));
    return el("tr", differs ? { class: "differs" } : {}, name, ...cells((of) => shown(read(of))));
  };
  const digest = el("tr", { class: "digest" }, el("th", { scope: "row", text: "Digest" }), ...cells((of) => of.digest));
  table.replaceChildren(...head, el("tbody", {}, ...ROWS.map(row), digest));
}

export function showExpectations(expectations) {
  const line = ({ text, held, first_failure: first, numbers }) => {
    const since = first === null || first === undefined ? "" : ` (first at iteration ${first})`;
    const read = Object.entries(numbers ?? {}).map(([name, value]) => `${name} = ${shown(value)}`).join(", ");
    return el("li", { class: held ? "held" : "failed" },
      el("span", { class: "mark", text: held ? "✓" : "✗", "aria-label": held ? "holds:" : "does not hold:" }),
      el("span", { text: text + (held ? "" : since) }, ...(held || !read ? [] : [el("small", { text: read })])));
  };
  byId("expectations").replaceChildren(...(expectations ?? []).map(line));
}

export function showDifference(difference, unreadable) {
  byId("difference").textContent = inWords(difference, unreadable);
  byId("difference").classList.toggle("failed", Boolean(unreadable || difference?.moved || difference?.missing));
}

function inWords(difference, unreadable) {
  if (unreadable) return `The snapshot cannot be read: ${unreadable}`;
  if (!difference) return "";
  const { moved, missing, furthest, distance } = difference;
  const lost = missing ? ` ${count(missing)} of the snapshot ${missing === 1 ? "is" : "are"} not in the scene.` : "";
  if (!moved) return `Every body ends where the snapshot expects it.${lost}`;
  return `${count(moved)} ${moved === 1 ? "ends" : "end"} elsewhere than the snapshot expects` +
    (furthest ? `; ${furthest} is furthest off, by ${shown(distance)} m.` : ".") + lost;
}

const count = (bodies) => (bodies === 1 ? "1 body" : `${bodies} bodies`);
