// Elements of the page, and numbers as people read them.

/** An element with attributes and children; `text` is its text, `on…` a listener. Nothing is ever read as HTML. */
export function el(tag, { text, ...attributes } = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else element.setAttribute(name, value);
  }
  if (text !== undefined) element.textContent = text;
  element.append(...children);
  return element;
}

export const byId = (id) => document.getElementById(id);

/** At most six digits that count, with a true minus. */
export function shown(number) {
  if (number === null || number === undefined) return "–";
  const size = Math.abs(number);
  const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? number.toExponential(4) : String(Number(number.toPrecision(6)));
  return text.replaceAll("-", "−");
}

/** The names that people know settings by. */
export const LABELS = { mu_l: "μ_L", mu_a: "μ_A", epsilon: "ε", restitution: "e", friction: "μ" };

/** What they are. */
export const MEANINGS = {
  mu_l: "share of linear momentum an exchange hands over",
  mu_a: "share of angular momentum an exchange hands over",
  epsilon: "gap that a relocation leaves [m]",
  restitution: "share of the speed that a bounce gives back",
  friction: "greatest sideways force over the pressing one",
};
