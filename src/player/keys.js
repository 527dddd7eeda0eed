// The keyboard. What a focused control understands itself is left to it.

const KEYS = {
  " ": (player) => player.toggle(),
  ArrowLeft: (player, event) => player.step(event.shiftKey ? -10 : -1),
  ArrowRight: (player, event) => player.step(event.shiftKey ? 10 : 1),
  Home: (player) => player.step(-Infinity),
  End: (player) => player.step(Infinity),
  "+": (player) => player.zoom(1.25),
  "=": (player) => player.zoom(1.25),
  "-": (player) => player.zoom(0.8),
  0: (player) => player.fit(),
  f: (player) => player.follow(!player.following),
  b: (player) => chooseNext(player, 1),
  B: (player) => chooseNext(player, -1),
  Escape: (player) => player.choose(null),
  "[": (player) => changeSpeed(player, -1),
  "]": (player) => changeSpeed(player, 1),
  a: (player) => pan(player, 40, 0),
  d: (player) => pan(player, -40, 0),
  w: (player) => pan(player, 0, 40),
  s: (player) => pan(player, 0, -40),
  ...Object.fromEntries(SHOWN.map(([what, key]) => [key, (player) => player.toggleShown(what)])),
};

/** The same as text, for a page that wants to tell them. */
const KEYS_IN_WORDS = [
  ["space", "play, pause"], ["← →", "a frame back, on; ten with shift"], ["Home End", "to the start, the end"],
  ["+ − 0", "nearer, farther, all of it"], ["w a s d", "look up, left, down, right"], ["b, shift b", "choose the next, the last body"],
  ["f", "follow it"], ["Esc", "choose none"], ["[ ]", "slower, faster"],
  ["n v c g t", "names, velocities, contacts, plane, trails"],
];

function keyPressed(player, event) {
  if (!player.film || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
  const { target, key } = event;
  if (target.isContentEditable || target.matches("input:not([type=range]), textarea, select")) return;
  if (target.matches("button, summary, a") && (key === " " || key === "Enter")) return;
  if (target.matches("input[type=range]") && /^(Arrow|Home|End|Page)/.test(key) && !event.shiftKey) return;
  if (!Object.hasOwn(KEYS, key)) return;
  event.preventDefault();
  KEYS[key](player, event);
}

function chooseNext(player, by) {
  const count = player.film.bodies.length;
  if (count) player.choose(player.chosen === null ? (by > 0 ? 0 : count - 1) : (player.chosen + by + count) % count);
}

function changeSpeed(player, by) {
  player.steered = true;
  player.speed = SPEEDS[clamp(SPEEDS.indexOf(player.speed) + by, 0, SPEEDS.length - 1)];
  player.redraw();
}

function pan(player, dx, dy) {
  player.following = false;
  player.steered = true;
  player.stage.camera.pan(dx, dy);
  player.redraw();
}
