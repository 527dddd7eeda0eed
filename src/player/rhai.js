// Lights the syntax of a script: comments, texts, numbers, Rhai's keywords and choque's words.

const RHAI_KEYWORDS = new Set(
  ("let const if else switch do while loop for in until break continue return throw try catch fn private import export as " +
    "this is true false null").split(" "),
);
const RHAI_TOKENS =
  /(\/\/[^\n]*|\/\*[^]*?\*\/)|("(?:\\[^]|[^"\\])*"|`(?:\\[^]|[^`\\])*`|'(?:\\[^]|[^'\\])')|(\b(?:0x[\da-f_]+|\d[\d_]*(?:\.\d[\d_]*)?(?:e[+-]?\d+)?)\b)|([a-z_]\w*)/gi;

/** A script with the numbers of its lines, one of them marked. */
function listing(script, marked = null) {
  const lines = script.replace(/\n$/, "").split("\n");
  const numbers = el("div", { class: "numbers", "aria-hidden": "true", text: lines.map((_, i) => i + 1).join("\n") });
  const page = el("div", { class: "listing" }, numbers, el("div", { class: "code" }, lit(script)));
  if (marked) {
    page.append(el("div", { class: "marked" }));
    page.lastChild.style.setProperty("--line", marked); // as an attribute a page's rules would forbid it
  }
  return page;
}

/** The script as elements: a span for what is lit, text for the rest. */
function lit(script) {
  const parts = document.createDocumentFragment();
  let at = 0;
  for (const found of script.matchAll(RHAI_TOKENS)) {
    const [text, comment, string, number, word] = found;
    const called = word && /^\s*\(/.test(script.slice(found.index + text.length, found.index + text.length + 8));
    const kind = comment ? "comment" : string ? "string" : number ? "number" : RHAI_KEYWORDS.has(word) ? "keyword" : called ? "call" : "";
    if (!kind) continue;
    parts.append(script.slice(at, found.index), el("span", { class: `rhai-${kind}`, text }));
    at = found.index + text.length;
  }
  parts.append(script.slice(at));
  return parts;
}
