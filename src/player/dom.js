// Small helpers: elements, numbers as people read them.

/** An element with attributes (functions become listeners) and children; texts are texts, never markup. */
function el(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (key === "text") element.textContent = value;
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value != null) element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** Changes an element's text, if it is another one: what stays the same is not laid out again. */
function say(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(""));
  if (node.data !== text) node.data = text;
}

/** Changes an attribute, if it has another value. */
function mark(element, name, value) {
  if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

const made = new WeakMap();

/** Whether an element is made of something else than when this was asked last. */
function isOther(element, of) {
  const told = JSON.stringify(of);
  const is = made.get(element) !== told;
  made.set(element, told);
  return is;
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

const PREFIXES = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

/** The prefix in which a size is written with one to three digits before the point. */
function prefixOf(size) {
  const found = PREFIXES.find(([factor]) => size >= factor);
  if (size === 0 || !Number.isFinite(size)) return [1, ""];
  return found ?? PREFIXES[PREFIXES.length - 1];
}

/** The same for a unit: kilograms have their prefix already, and take powers of ten. */
function scaleOf(size, unit) {
  const [factor, prefix] = prefixOf(size);
  if (!unit.startsWith("kg")) return [factor, prefix + unit];
  const power = Math.round(Math.log10(factor));
  return [factor, power === 0 ? unit : `10${[...String(power)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")} ${unit}`];
}

/** A number in four digits with a unit: 12.34 kJ. */
function measure(value, unit) {
  if (!Number.isFinite(value)) return "out of range";
  if (value === 0) return `0 ${unit}`;
  if (unit.startsWith("kg") && Math.abs(value) >= 0.1 && Math.abs(value) < 1e6) {
    return `${fixed(value, clamp(3 - Math.floor(Math.log10(Math.abs(value))), 0, 4))} ${unit}`;
  }
  const [factor, scaled] = scaleOf(Math.abs(value), unit);
  return `${digits(value / factor, 4)}${scaled.startsWith("10") ? "·" : " "}${scaled}`;
}

/** A number in so many digits, with a true minus. */
function digits(value, count) {
  if (value === 0) return "0";
  return value.toPrecision(count).replace("-", "−").replace("e", "·10^").replace("+", "");
}

/** A number with so many decimals, with a true minus and no minus before nothing. */
function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** Fits a canvas to the room it has; its drawing context counts in CSS pixels. */
function fitCanvas(canvas) {
  const ratio = clamp(window.devicePixelRatio || 1, 1, 2);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height, ratio };
}

/** Colours of the page's style, by the names after `--`. */
function paletteOf(element) {
  const style = getComputedStyle(element);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  return new Proxy({}, { get: (known, name) => (known[name] ??= colour(name)) });
}
