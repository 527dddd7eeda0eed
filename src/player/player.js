// The player: a film in an element of a page. What a page calls:
//
//   const player = new choque.Player(element, film);     film = await choque.unpack(bytes), or null for later;
//                                                           choque.read(bytes) of bytes that are not deflated
//   player.load(film)                                     another film: time, zoom, chosen body and playing stay
//   player.load(film, { isMore: true })                   more of the film before: all of it is in view until someone steers
//   player.overlay(film, { kind: "B", label })            another run over this one; null takes it away
//   player.overlay({ bodies: [{ name, x, z, angle }] }, { kind: "ghost", label })     where bodies should be
//   player.play()  .pause()  .seek(time)  .time  .frame  .playing  .choose(name)  .follow(true)
//   player.on("frame" | "choose" | "play", listener)

const SPEEDS = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16];
const SHOWN = [["names", "n", "Names"], ["velocities", "v", "Velocities"], ["contacts", "c", "Contacts"],
  ["plane", "g", "Plane"], ["trails", "t", "Trails"]];

class Player {
  /**
   * `keys`: who hears the keyboard, the element itself unless told otherwise; `tables`: where numbers are listed, below the rest
   * unless told otherwise; `label`: what the run is called beside one that is laid over it.
   */
  constructor(element, film = null, { keys = element, tables = element, label = "this run" } = {}) {
    Object.assign(this, { element, label, film: null, position: 0, playing: false, speed: 1, chosen: null, following: false });
    this.show = { names: true, velocities: false, contacts: true, plane: true, trails: false };
    this.overlays = new Map();
    this.listeners = new Map();
    this.quantity = 0;
    this.steered = false; // whether someone has looked nearer, or set the speed
    this.controls = new Controls(this);
    element.classList.add("choque-player");
    element.replaceChildren(...this.controls.roots);
    tables.append(this.controls.tablesRoot);
    this.stage = new Stage(this.controls.canvas);
    steer(this.controls.canvas, this.stage.camera, {
      moved: (how) => {
        this.steered = true;
        if (how === "pan") this.follow(false);
        this.redraw();
      },
      tapped: (px, py) => this.film && this.choose(this.stage.bodyAt(this.film, this.frame, px, py)),
    });
    keys.addEventListener("keydown", (event) => keyPressed(this, event));
    new ResizeObserver(() => this.#resized()).observe(element);
    document.addEventListener("choque-theme", () => this.restyle());
    if (film) this.load(film);
  }

  /** Shows a film; of the one before, the time, the view, the chosen body and whether it plays are kept. */
  load(film, { isMore = false } = {}) {
    const before = this.film;
    const [time, name] = [before ? this.time : film.times[0], before?.bodies[this.chosen]?.name];
    this.film = film;
    this.chosen = film.index.get(name) ?? null;
    this.following &&= this.chosen !== null;
    this.stage.resize();
    if (!before || (isMore && !this.steered)) this.#present();
    this.#changed();
    this.seek(time);
  }

  /** All of the film in view, at a speed at which it lasts a while. */
  #present() {
    const { film } = this;
    if (!this.following) this.stage.camera.fit(film.bounds);
    this.speed = Math.min(1, SPEEDS.findLast((speed) => film.duration / speed >= 2 || speed === SPEEDS[0]));
  }

  /** A film that has nothing to do with the one before is shown as if it were the first. */
  present() {
    this.steered = false;
    this.#present();
    this.redraw();
  }

  /** Lays another run, or a state that bodies should be in, over the film; null takes it away. */
  overlay(over, { kind = "B", label = kind === "B" ? "B" : "expected" } = {}) {
    if (over) this.overlays.set(kind, { over, kind, label });
    else this.overlays.delete(kind);
    if (this.film) {
      const time = this.time;
      this.#changed();
      this.seek(time);
    }
  }

  get clock() {
    return this.#laid().reduce((longest, { film }) => (film.times.at(-1) > longest.times.at(-1) ? film : longest), this.film);
  }

  get time() {
    return this.film ? this.clock.times[this.position] : 0;
  }

  get frame() {
    return this.film ? this.film.frameAt(this.time) : 0;
  }

  seek(time) {
    if (this.film) this.moveTo(this.clock.frameAt(time));
  }

  /** Shows that frame of the longest film. */
  moveTo(position) {
    this.position = clamp(Math.round(position), 0, this.clock.frames - 1);
    this.redraw();
    this.#tell("frame", this.frame);
  }

  step(frames) {
    this.pause();
    this.moveTo(this.position + frames);
  }

  play() {
    if (!this.film || this.playing) return;
    if (this.position === this.clock.frames - 1) this.moveTo(0);
    this.playing = true;
    let [last, time] = [null, this.time];
    const tick = (now) => {
      if (!this.playing) return;
      if (this.time !== this.lastShown) time = this.time; // someone looked elsewhere meanwhile
      time += last === null ? 0 : (Math.min(now - last, 250) / 1000) * this.speed;
      last = now;
      const position = this.clock.frameAt(time);
      if (position !== this.position) this.moveTo(position);
      this.lastShown = this.time;
      if (position === this.clock.frames - 1) this.pause();
      else requestAnimationFrame(tick);
    };
    this.lastShown = time;
    requestAnimationFrame(tick);
    this.controls.playing(true);
    this.#tell("play", true);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.controls.playing(false);
    this.redraw();
    this.#tell("play", false);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** A body by its name or its place; null for none. */
  choose(body) {
    this.chosen = typeof body === "string" ? (this.film.index.get(body) ?? null) : body;
    if (this.chosen === null) this.following = false;
    this.redraw();
    this.#tell("choose", this.film.bodies[this.chosen]?.name ?? null);
  }

  /** Keeps the chosen body in the middle, the first mobile one when none is chosen. */
  follow(following) {
    if (following && this.chosen === null) {
      const first = this.film.bodies.findIndex((body) => body.kind === "mobile");
      if (first < 0) return;
      this.choose(first);
    }
    this.following = following;
    this.redraw();
  }

  toggleShown(what) {
    this.show[what] = !this.show[what];
    this.redraw();
  }

  zoom(factor) {
    this.steered = true;
    this.stage.camera.zoom(factor);
    this.redraw();
  }

  fit() {
    this.following = false;
    this.stage.camera.fit(this.film.bounds);
    this.redraw();
  }

  on(event, listener) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }

  restyle() {
    this.stage.restyle();
    if (this.film) this.#changed();
  }

  /** Draws before the next picture of the screen, however often it is asked for. */
  redraw() {
    if (this.waiting || !this.film) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    const [film, frame, time] = [this.film, this.frame, this.time];
    if (this.following) {
      const { x, z } = film.state(frame, this.chosen);
      Object.assign(this.stage.camera, { x, z });
    }
    const overlays = this.#laid().map(({ film: over, kind }) => ({ film: over, kind, frame: over.frameAt(time) }));
    this.stage.draw({ film, frame, show: this.show, chosen: this.chosen, overlays });
    this.controls.update(frame, time);
  }

  /** What is laid over, as films. */
  #laid() {
    return [...this.overlays.values()].map(({ over, kind, label }) => ({
      film: over instanceof Film ? over : (over.still ??= this.film.still(over.bodies)),
      kind,
      label,
    }));
  }

  #changed() {
    for (const { over } of this.overlays.values()) if (!(over instanceof Film)) over.still = null;
    this.position = Math.min(this.position, this.clock.frames - 1);
    this.controls.filmChanged(this.#laid());
    this.redraw();
  }

  #resized() {
    if (!this.film) return;
    this.stage.resize();
    this.controls.resized();
    this.redraw();
  }

  #tell(event, value) {
    for (const listener of this.listeners.get(event) ?? []) listener(value);
  }
}
