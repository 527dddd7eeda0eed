// The desk: which scenario is open, what is asked of the server, and where its answers go.

import { byId, el, LABELS, shown } from "./dom.js";
import { List, name } from "./list.js";
import { showDifference, showExpectations, showNumbers } from "./readout.js";
import { Refused, ask, run } from "./server.js";
import { Sliders } from "./sliders.js";

/** A run that has shown nothing for so long is given up for a newer setting [ms]. */
const PATIENCE = 250;
/** Frames that do not reach the moment being looked at are shown after all when the rest takes longer than that [ms]. */
const FLICKER = 80;
/** Between two looks at whether files have changed [ms]. */
const LOOK = 500;

const desk = {
  open: null, // the scenario's id
  run: null, // the one going on: { controller, since, waits }
  again: false, // whether the sliders have moved on since it began
  scene: null,
  outcome: null,
  film: null,
  kept: null, // the run called A: { id, film, outcome, label }
  stamp: null,
  ghostsLaid: "null", // over the film, as JSON
  ghostsChosen: null, // by hand; otherwise they show when there is something to see
};

const list = new List();
const sliders = new Sliders(() => {
  remember();
  changed();
});
const player = new choque.Player(byId("player"), null, { keys: document, tables: byId("tables") });
showPlayer(false);

/* Runs. */

/** Runs the open scenario with the sliders as they are: now, or as soon as the run before it has shown its first frames. */
function changed() {
  showButtons();
  if (desk.run?.waits && performance.now() - desk.run.since < PATIENCE) {
    if (!desk.again) setTimeout(() => desk.again && start(), PATIENCE);
    desk.again = true;
  } else start();
}

async function start() {
  desk.run?.controller.abort();
  const current = { controller: new AbortController(), since: performance.now(), waits: true, end: momentLookedAt() };
  desk.run = current;
  desk.again = false;
  const id = desk.open;
  say("running …");
  try {
    for await (const piece of run({ scenario: id, set: sliders.set }, current.controller.signal)) {
      if (desk.run !== current) return;
      if (piece.text) hear(piece.text, current);
      else show(piece.film, current);
      if (desk.run !== current) return;
      if (!current.waits && desk.again) return start();
    }
    if (desk.run === current && !current.ended) throw new Refused("the run ended without a word; the studio's terminal may say why");
  } catch (error) {
    if (desk.run !== current || error.name === "AbortError") return;
    if (error instanceof Refused) fail(`error: ${error.message}`);
    else gone();
  } finally {
    if (desk.run === current) desk.run = null;
  }
}

/** The time that should still be seen when the next frames are there; the end stays the end. */
function momentLookedAt() {
  if (!player.film || desk.scene?.id !== desk.open) return 0;
  return player.time >= player.film.times.at(-1) && !player.playing ? Infinity : player.time;
}

function hear(event, current) {
  if (event.event === "scene") {
    showScene(event);
  } else if (event.event === "printed") {
    byId("printed").hidden = false;
    byId("printed").querySelector("pre").textContent = event.lines.join("\n");
  } else if (event.event === "error") {
    current.ended = true;
    current.waits = false;
    desk.stamp = event.stamp;
    fail(event.text, event.source, event.line);
  } else if (event.event === "done") {
    current.ended = true;
    desk.outcome = event.outcome;
    showOutcome(event.difference);
    const took = performance.now() - current.since;
    document.documentElement.dataset.took = took.toFixed(1);
    say(`${event.outcome.steps} iterations, in ${shown(Math.round(took))} ms`);
  }
}

function show(bytes, current) {
  const film = choque.read(bytes);
  const waited = () => performance.now() - current.since;
  const reaches = film.times.at(-1) >= Math.min(current.end, desk.scene.steps * desk.scene.time_step * (1 - 1e-9));
  // Someone who looks at the end should not see the picture jump there and back.
  if (!reaches && waited() < FLICKER && desk.film && desk.filmOf === desk.open) return;
  const [first, resumes] = [desk.filmOf !== desk.open, player.playing || current.pausedAtEdge];
  showPlayer(true);
  byId("player").classList.remove("stale");
  if (first) forgetView();
  desk.film = film;
  desk.filmOf = desk.open;
  player.load(film, { isMore: current.presents });
  if (first) {
    current.presents = true;
    player.present();
    player.seek(0);
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) player.play();
  } else if (!resumes) player.seek(Math.min(current.end, film.times.at(-1)));
  if (current.pausedAtEdge) {
    current.pausedAtEdge = false;
    player.play();
  }
  if (current.waits) requestAnimationFrame(() => (document.documentElement.dataset.first = waited().toFixed(1))); // when it is drawn
  current.waits = false;
}

/** Another scenario's body, time and overlays are not this one's. */
function forgetView() {
  player.pause();
  if (player.film) player.choose(null);
  layGhosts(null);
  if (desk.kept?.id !== desk.open) forget();
}

player.on("play", (playing) => {
  // The frames so far were played; go on as soon as there are more.
  if (!playing && desk.run && player.film && player.frame === player.film.frames - 1) desk.run.pausedAtEdge = true;
});

/* What a run says. */

function showScene(scene) {
  desk.scene = { ...scene, id: desk.open };
  desk.stamp = scene.stamp;
  byId("error").hidden = true;
  byId("title").textContent = scene.title;
  byId("about").textContent = list.about(desk.open);
  document.title = `${scene.title} · choque studio`;
  if (scene.dropped.length) {
    sliders.drop(scene.dropped);
    remember();
    saved(`No longer in the script, or out of its bounds: ${scene.dropped.join(", ")}.`);
  }
  sliders.show(scene.sliders);
  showSource({ name: "The script", text: scene.text });
  const notes = byId("notes");
  notes.hidden = scene.notes.length === 0;
  notes.querySelector("summary").textContent = scene.notes.length === 1 ? "1 warning" : `${scene.notes.length} warnings`;
  notes.querySelector("ul").replaceChildren(...scene.notes.map((text) => el("li", { text })));
  byId("printed").hidden = true;
  showButtons();
}

function showOutcome(difference) {
  const differs = Boolean(difference?.moved || difference?.missing);
  const box = byId("ghosts").querySelector("input");
  const ghosts = desk.scene.expected;
  box.disabled = !ghosts;
  box.checked = Boolean(ghosts) && (desk.ghostsChosen ?? differs);
  layGhosts(wantedGhosts());
  showDifference(difference, desk.scene.unreadable);
  showExpectations(desk.outcome.expectations);
  showNumbers(desk.outcome, desk.kept?.outcome);
  showButtons();
}

const wantedGhosts = () => (byId("ghosts").querySelector("input").checked ? desk.scene.expected.bodies : null);

/** Lays them over the film, unless they lie there. */
function layGhosts(bodies) {
  const told = JSON.stringify(bodies);
  if (told === desk.ghostsLaid) return;
  desk.ghostsLaid = told;
  player.overlay(bodies && { bodies }, { kind: "ghost", label: "the end in the snapshot" });
}

/** A text that the run was made from; one with an error is opened there. */
function showSource({ name: title, text }, line = null) {
  const [panel, scroll] = [byId("script"), byId("script").querySelector(".scroll")];
  const openedByError = panel.dataset.line !== undefined;
  panel.hidden = false;
  panel.querySelector("summary").textContent = title;
  scroll.replaceChildren(choque.listing(text, line));
  if (line !== null) {
    panel.dataset.line = line;
    panel.open = true;
    const tall = scroll.querySelector(".marked").offsetTop - scroll.clientHeight / 2;
    scroll.scrollTo({ top: tall });
  } else if (openedByError) {
    delete panel.dataset.line;
    panel.open = false;
  }
}

function showPlayer(wanted) {
  byId("player").hidden = !wanted;
  byId("tables").hidden = !wanted;
}

function fail(text, source = null, line = null) {
  const error = byId("error");
  error.textContent = text;
  error.hidden = false;
  if (desk.filmOf === desk.open) byId("player").classList.add("stale");
  else showPlayer(false);
  if (source) showSource(source, line);
  if (desk.scene?.id !== desk.open) {
    byId("title").textContent = name(desk.open);
    byId("about").textContent = list.about(desk.open);
    sliders.show([]);
    showNumbers(null);
    showExpectations([]);
    showDifference(null);
  }
  say("stopped by an error");
  showButtons();
}

/* Buttons. */

function showButtons() {
  const any = sliders.moved.size > 0;
  byId("save").disabled = !any || !desk.scene?.is_script;
  byId("save").title = desk.scene && !desk.scene.is_script ? "a .ron scene is written by choque export: set these values in its script" : "";
  byId("reset").disabled = !any;
  byId("keep").disabled = !desk.outcome || desk.filmOf !== desk.open;
  byId("forget").hidden = !desk.kept;
}

byId("reset").addEventListener("click", () => sliders.reset());

byId("save").addEventListener("click", async () => {
  const [id, set] = [desk.open, sliders.set];
  try {
    const { lines } = await ask("save", { scenario: id, digest: desk.scene.digest, set });
    if (desk.open !== id) return;
    sliders.written(set);
    remember();
    saved("Written into the script:", lines.map(({ number, text }) => `${number}  ${text.trim()}`).join("\n"), true);
    start();
  } catch (error) {
    if (!(error instanceof Refused)) return gone();
    saved("Nothing was written.", error.message);
  }
});

function saved(text, details, done = false) {
  const place = byId("saved");
  place.classList.toggle("done", done);
  place.replaceChildren(el("p", { text }), ...(details ? [el("pre", { text: details })] : []));
}

byId("keep").addEventListener("click", () => {
  const moved = [...sliders.moved].map(([key, value]) => `${LABELS[key] ?? key} ${shown(value)}`);
  const label = `A: ${moved.length ? moved.join(", ") : "as written"}`;
  desk.kept = { id: desk.open, film: desk.film, outcome: desk.outcome, label };
  player.overlay(desk.film, { kind: "B", label });
  showNumbers(desk.outcome, desk.kept.outcome);
  showButtons();
});

byId("forget").addEventListener("click", () => {
  forget();
  showNumbers(desk.outcome);
  showButtons();
});

function forget() {
  desk.kept = null;
  player.overlay(null, { kind: "B" });
}

byId("ghosts").querySelector("input").addEventListener("change", (event) => {
  desk.ghostsChosen = event.target.checked;
  layGhosts(wantedGhosts());
});

/* Scenarios. */

const store = (id) => `choque ${id}`;

/** Moved sliders outlive a reload of the page and a look at another scenario. */
function remember() {
  sessionStorage.setItem(store(desk.open), JSON.stringify(sliders.set));
}

function open(id) {
  desk.run?.controller.abort();
  Object.assign(desk, { open: id, run: null, scene: null, outcome: null, stamp: null, ghostsChosen: null });
  sliders.moved = new Map(JSON.parse(sessionStorage.getItem(store(id)) ?? "[]"));
  byId("saved").replaceChildren();
  for (const panel of ["notes", "printed", "script"]) byId(panel).hidden = true; // until there is one
  list.choose(id);
  start();
}

function openFromAddress() {
  const wanted = decodeURI(location.hash.slice(1));
  const id = wanted || list.scenarios[0]?.id;
  if (id && id !== desk.open) open(id);
}

/* Changes on disk. */

let listStamp = null;
let looks = 0;

async function look() {
  if (document.hidden) return;
  try {
    if (looks++ % 6 === 0) await loadList();
    if (!desk.open || !desk.stamp || desk.run) return;
    const [id, before] = [desk.open, desk.stamp];
    const { stamp } = await ask("state", { scenario: id });
    const changed = stamp && stamp !== before && desk.open === id && desk.stamp === before && !desk.run;
    if (changed) start();
    byId("gone").hidden = true;
  } catch (error) {
    if (!(error instanceof Refused)) gone();
  }
}

async function loadList() {
  const { folder, stamp, scenarios } = await ask("scenarios");
  if (stamp === listStamp) return;
  listStamp = stamp;
  byId("folder").textContent = folder;
  list.load(scenarios);
  list.choose(desk.open);
  if (!scenarios.length) byId("title").textContent = "No scenarios yet: save a .rhai file here, and it appears.";
  openFromAddress();
}

function gone() {
  byId("gone").hidden = false;
  byId("gone").textContent = "The studio has ended. Start choque studio again and open the address it prints; what the sliders say is kept here meanwhile.";
  say("");
}

function say(text) {
  byId("state").textContent = text;
}

choque.themeSwitch(byId("theme"));
byId("keys").append(...choque.KEYS_IN_WORDS.flatMap(([keys, does]) => [el("dt", {}, el("kbd", { text: keys })), el("dd", { text: does })]));
addEventListener("hashchange", openFromAddress);
document.addEventListener("visibilitychange", look);
setInterval(look, LOOK);
look();
