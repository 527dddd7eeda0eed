// The page of one file: unpacks what it carries and starts the player.

async function startPage() {
  const films = [...document.querySelectorAll("script.film")];
  themeSwitch(document.getElementById("theme"));
  for (const script of document.querySelectorAll("pre.script")) script.replaceChildren(listing(script.textContent));
  document.getElementById("keys").append(...KEYS_IN_WORDS.flatMap(([keys, does]) =>
    [el("dt", {}, el("kbd", { text: keys })), el("dd", { text: does })]));
  const element = document.getElementById("player");
  try {
    const [film, other] = await Promise.all(films.map((carrier) => unpack(fromBase64(carrier.textContent))));
    window.player = new Player(element, film, { keys: document, label: films[0].dataset.label || "this run" });
    if (other) window.player.overlay(other, { kind: "B", label: films[1].dataset.label });
    document.documentElement.dataset.ready = "yes";
  } catch (error) {
    element.replaceChildren(el("p", { class: "failure", role: "alert", text: error.message }));
  }
}
