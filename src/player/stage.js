// Draws one moment: the collision plane, the bodies, what moves them and where they touch.

/** A fill of lines, so that kinds of bodies differ by more than colour. */
function hatch(context, colour, ground, crossed, scale = 0.5) {
  const tile = el("canvas", { width: 16, height: 16 });
  const pen = tile.getContext("2d");
  pen.fillStyle = ground;
  pen.fillRect(0, 0, 16, 16);
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5;
  pen.beginPath();
  for (const at of [-8, 0, 8, 16, 24]) {
    pen.moveTo(at - 8, 24);
    pen.lineTo(at + 24, -8);
    if (crossed) {
      pen.moveTo(at - 8, -8);
      pen.lineTo(at + 24, 24);
    }
  }
  pen.stroke();
  const pattern = context.createPattern(tile, "repeat");
  pattern.setTransform(new DOMMatrix().scale(scale));
  return pattern;
}

const HITS_STAY = 8; // frames for which an exchange is still drawn, ever fainter
const HITS_TOGETHER = 400; // exchanges drawn at most before those of earlier frames are left out
const TOGETHER = 12; // bodies in one path, and
const STROKES = 48; // lines: measured, longer paths take more time than they save
const CROWD = 150; // bodies, or exchanges, from which on lines are one pixel wide: others are drawn ten times slower

class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.camera = new Camera();
    this.labels = new Labels();
    this.restyle();
  }

  /** Colours are read again: the page is light or dark now. */
  restyle() {
    this.styles = null;
    this.labels.clear();
  }

  #style(context) {
    if (this.styles) return this.styles;
    const colour = paletteOf(this.canvas);
    const kinds = {
      mobile: { fill: colour["mobile-fill"], line: colour.mobile, width: 1.25 },
      fixed: { fill: hatch(context, colour.fixed, colour["fixed-fill"], false), line: colour.fixed, width: 1.25 },
      driven: { fill: hatch(context, colour.driven, colour["driven-fill"], true), line: colour.driven, width: 1.75 },
    };
    return (this.styles = { colour, kinds });
  }

  resize() {
    const { width, height } = fitCanvas(this.canvas);
    this.camera.resize(width, height);
  }

  /** `scene`: { film, frame, show, chosen, overlays: [{ film, frame, kind, label }] }. */
  draw(scene) {
    const { context, width, height, ratio } = fitCanvas(this.canvas);
    const style = this.#style(context);
    this.pixel = 1 / ratio;
    this.crowded = this.#countVisible(scene.film, scene.frame) > CROWD;
    context.fillStyle = style.colour.stage;
    context.fillRect(0, 0, width, height);
    this.#plane(context, style.colour, scene.film, scene.show);
    if (scene.show.trails) this.#trails(context, style.colour, scene);
    this.#bodies(context, style, scene.film, scene.frame);
    for (const overlay of scene.overlays) this.#outline(context, style.colour, overlay);
    if (scene.show.velocities) this.#velocities(context, style.colour, scene.film, scene.frame);
    if (scene.show.contacts) this.#contacts(context, style.colour, scene.film, scene.frame);
    if (scene.chosen != null) this.#chosen(context, style.colour, scene);
    if (scene.show.names) this.labels.draw(context, style.colour, this.camera, this.pixel, this.#named(scene));
  }

  /** Calls `visit(body, x, y, cos, sin)` for every body in view, in pixels. */
  #visible(film, frame, visit) {
    const { camera } = this;
    const { x, z, angle } = film.poses;
    const count = film.bodies.length;
    for (let body = 0, at = frame * count; body < count; body++, at++) {
      const px = camera.width / 2 + (x[at] - camera.x) * camera.scale;
      const py = camera.height / 2 - (z[at] - camera.z) * camera.scale;
      const reach = film.bodies[body].reach * camera.scale + 2;
      if (px < -reach || py < -reach || px > camera.width + reach || py > camera.height + reach) continue;
      visit(body, px, py, Math.cos(angle[at]) * camera.scale, Math.sin(angle[at]) * camera.scale);
    }
  }

  #countVisible(film, frame) {
    let count = 0;
    this.#visible(film, frame, () => count++);
    return count;
  }

  /** Adds a body's rectangles to the path that is being drawn. */
  #trace(context, rects, px, py, c, s) {
    for (const [x0, x1, z0, z1] of rects) {
      context.moveTo(px + x0 * c - z0 * s, py - x0 * s - z0 * c);
      context.lineTo(px + x1 * c - z0 * s, py - x1 * s - z0 * c);
      context.lineTo(px + x1 * c - z1 * s, py - x1 * s - z1 * c);
      context.lineTo(px + x0 * c - z1 * s, py - x0 * s - z1 * c);
      context.closePath();
    }
  }

  /** Bodies of a kind share paths: a dozen in each are drawn fastest. */
  #bodies(context, style, film, frame) {
    for (const kind of ["fixed", "driven", "mobile"]) {
      const { fill, line, width } = style.kinds[kind];
      [context.fillStyle, context.strokeStyle, context.lineWidth] = [fill, line, this.crowded ? this.pixel : width];
      let traced = 0;
      const paint = () => {
        if (!traced) return;
        context.fill();
        context.stroke();
        context.beginPath();
        traced = 0;
      };
      context.beginPath();
      this.#visible(film, frame, (body, px, py, c, s) => {
        if (film.bodies[body].kind !== kind) return;
        this.#trace(context, film.bodies[body].rects, px, py, c, s);
        if (++traced === TOGETHER) paint();
      });
      paint();
    }
    this.#headings(context, style.colour, film, frame);
  }

  /** A mobile body's centre, and which way its own X points; of one that is off the plane that is all there is. */
  #headings(context, colour, film, frame) {
    context.beginPath();
    this.#visible(film, frame, (body, px, py, c, s) => {
      const { kind, rects, reach } = film.bodies[body];
      if (rects.length === 0) {
        context.moveTo(px + 4, py);
        context.arc(px, py, 4, 0, TAU);
      } else if (kind === "mobile" && reach * this.camera.scale > 6) {
        const nose = Math.max(...rects.map((rect) => rect[1]));
        context.moveTo(px, py);
        context.lineTo(px + nose * c, py - nose * s);
      }
    });
    context.strokeStyle = colour.mobile;
    context.lineWidth = this.pixel;
    context.stroke();
  }

  /** Another run, or where bodies should be, over this one: outlines only. */
  #outline(context, colour, { film, frame, kind }) {
    context.beginPath();
    this.#visible(film, frame, (body, px, py, c, s) => {
      if (film.bodies[body].kind !== "fixed") this.#trace(context, film.bodies[body].rects, px, py, c, s);
    });
    context.setLineDash(kind === "ghost" ? [2, 3] : [7, 3]);
    context.lineWidth = this.crowded ? this.pixel : kind === "ghost" ? 1.75 : 1.5;
    context.strokeStyle = kind === "ghost" ? colour.ghost : colour.other;
    context.stroke();
    context.setLineDash([]);
  }

  #plane(context, colour, film, show) {
    const { camera } = this;
    const step = niceStep(90 / camera.scale);
    const [x0, z1] = camera.toWorld(0, 0);
    const [x1, z0] = camera.toWorld(camera.width, camera.height);
    const lines = (only) => {
      context.beginPath();
      for (let k = Math.ceil(x0 / step); k * step <= x1; k++) {
        if (only && k !== 0) continue;
        const px = Math.round(camera.toScreen(k * step, 0)[0]) + 0.5;
        context.moveTo(px, 0);
        context.lineTo(px, camera.height);
      }
      for (let k = Math.ceil(z0 / step); k * step <= z1; k++) {
        if (only && k !== 0) continue;
        const py = Math.round(camera.toScreen(0, k * step)[1]) + 0.5;
        context.moveTo(0, py);
        context.lineTo(camera.width, py);
      }
      context.stroke();
    };
    context.lineWidth = 1;
    if (show.plane) {
      context.strokeStyle = colour.grid;
      lines(false);
      context.strokeStyle = colour.axis;
      lines(true);
    }
    this.#scaleBar(context, colour, film, step);
  }

  #scaleBar(context, colour, film, step) {
    const [right, bottom] = [this.camera.width - 14, this.camera.height - 14];
    const left = right - step * this.camera.scale;
    context.strokeStyle = colour.faint;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [x, y] of [[left, -5], [left, 0], [right, 0], [right, -5]]) context.lineTo(x, bottom + y);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillStyle = colour.faint;
    const height = film.head.plane;
    const text = `${measure(step, "m").replace(/\.0+ /, " ")} · X right, Z up · plane Y = ${height === 0 ? "0" : digits(height, 3)} m`;
    context.lineWidth = 4;
    context.strokeStyle = colour.stage;
    context.strokeText(text, right, bottom - 8);
    context.fillText(text, right, bottom - 8);
  }

  #trails(context, colour, { film, frame, chosen }) {
    const { x, z } = film.poses;
    const count = film.bodies.length;
    const all = film.bodies.flatMap((body, i) => (body.kind === "mobile" ? [i] : []));
    const bodies = chosen != null ? [chosen] : all.slice(0, 200);
    const every = Math.max(1, Math.ceil((frame * bodies.length) / 20000));
    context.strokeStyle = colour.trail;
    context.lineWidth = chosen != null ? 1.5 : this.pixel;
    for (const body of bodies) {
      context.beginPath();
      let pen = "moveTo";
      for (let f = 0; f <= frame; f += every) {
        context[pen](...this.camera.toScreen(x[f * count + body], z[f * count + body]));
        pen = "lineTo";
      }
      context.lineTo(...this.camera.toScreen(x[frame * count + body], z[frame * count + body]));
      context.stroke();
    }
  }

  /** Arrows; the fastest body of the run has one of 70 pixels. */
  #velocities(context, colour, film, frame) {
    const longest = film.fastest;
    if (longest === 0) return;
    const { vx, vz } = film.poses;
    const first = frame * film.bodies.length;
    context.strokeStyle = colour.velocity;
    context.lineWidth = this.crowded ? this.pixel : 1.5;
    context.beginPath();
    let traced = 0;
    this.#visible(film, frame, (body, px, py) => {
      const [dx, dy] = [(vx[first + body] / longest) * 70, (-vz[first + body] / longest) * 70];
      if (dx * dx + dy * dy <= 4) return;
      arrow(context, px, py, px + dx, py + dy, 5);
      if (++traced % STROKES !== 0) return;
      context.stroke();
      context.beginPath();
    });
    context.stroke();
  }

  /**
   * The exchanges of this frame and, fainter, of some before, as long as those are not so many that nothing could be told
   * apart: point, normal and the face's line; and contacts that last.
   */
  #contacts(context, colour, film, frame) {
    const long = clamp(1.5 * film.typical * this.camera.scale, 8, 26); // pixels
    context.strokeStyle = colour.contact;
    let ages = 0;
    while (ages < Math.min(HITS_STAY, frame) && film.hits.first[frame + 1] - film.hits.first[frame - ages - 1] < HITS_TOGETHER) ages++;
    const many = film.hits.first[frame + 1] - film.hits.first[frame - ages] > CROWD;
    for (let age = ages; age >= 0; age--) {
      context.globalAlpha = 1 - age / (HITS_STAY + 1);
      context.lineWidth = many ? this.pixel : age === 0 && long > 12 ? 1.75 : 1.25;
      const [from, to] = film.hitsIn(frame - age);
      for (let first = from; first < to; first += STROKES) this.#hits(context, film.hits, first, Math.min(first + STROKES, to), long);
    }
    context.globalAlpha = 1;
    this.#touches(context, film, frame, clamp(0.5 * film.typical * this.camera.scale, 1.5, 7));
  }

  #hits(context, { x, z, normal }, from, to, long) {
    context.beginPath();
    for (let hit = from; hit < to; hit++) {
      const [px, py] = this.camera.toScreen(x[hit], z[hit]);
      if (px < -40 || py < -40 || px > this.camera.width + 40 || py > this.camera.height + 40) continue;
      const [nx, ny] = [Math.cos(normal[hit]), -Math.sin(normal[hit])];
      diamond(context, px, py, long / 6);
      if (long > 12) arrow(context, px, py, px + long * nx, py + long * ny, long / 5);
      else segment(context, px, py, px + long * nx, py + long * ny);
      segment(context, px - 0.5 * long * ny, py + 0.5 * long * nx, px + 0.5 * long * ny, py - 0.5 * long * nx);
    }
    context.stroke();
  }

  /** Contacts that last: a ring and a line along the normal at each point, of that size in pixels; the line alone where it is small. */
  #touches(context, film, frame, size) {
    const first = frame * film.bodies.length;
    context.lineWidth = size < 3 || this.crowded ? 0.75 * this.pixel : 1.25;
    context.beginPath();
    let traced = 0;
    for (const { a, normal, points } of film.touches[frame]) {
      const [nx, ny] = [Math.cos(normal) * size, -Math.sin(normal) * size];
      for (const [x, z] of points) {
        const [px, py] = this.camera.toScreen(film.poses.x[first + a] + x, film.poses.z[first + a] + z);
        if (px < 0 || py < 0 || px > this.camera.width || py > this.camera.height) continue;
        segment(context, px - nx, py - ny, px + nx, py + ny);
        if (size > 3) {
          context.moveTo(px + 0.4 * size, py);
          context.arc(px, py, 0.4 * size, 0, TAU);
        }
        if (++traced % STROKES === 0) {
          context.stroke();
          context.beginPath();
        }
      }
    }
    context.stroke();
  }

  #chosen(context, colour, { film, frame, chosen }) {
    const { x, z, angle } = film.state(frame, chosen);
    const [px, py] = this.camera.toScreen(x, z);
    const [c, s] = [Math.cos(angle) * this.camera.scale, Math.sin(angle) * this.camera.scale];
    context.beginPath();
    this.#trace(context, film.bodies[chosen].rects, px, py, c, s);
    context.lineJoin = "round";
    for (const [width, line] of [[7, colour.stage], [3, colour.ink]]) {
      context.lineWidth = width;
      context.strokeStyle = line;
      context.stroke();
    }
    context.lineJoin = "miter";
  }

  /** Whose names are wanted, the most wanted first: the chosen body, mobile ones, fixed ones; `lift` is how far above its centre. */
  #named({ film, frame, chosen }) {
    const { width, height, scale } = this.camera;
    const named = [[], [], []];
    this.#visible(film, frame, (body, px, py) => {
      const { name, kind, reach } = film.bodies[body];
      const isInView = px > 0 && py > 0 && px < width && py < height;
      if (body !== chosen && (!isInView || reach * scale < 9)) return;
      // In a large body there is room for its name; it stands above a small one.
      const lift = reach * scale < 40 ? reach * scale * 0.6 + 9 : 0;
      named[body === chosen ? 0 : kind === "mobile" ? 1 : 2].push({ name, px, py: py - lift, always: body === chosen });
    });
    return named.flat();
  }

  /** The body at a pixel, the smallest first; null where there is none. */
  bodyAt(film, frame, px, py) {
    let found = null;
    const [wx, wz] = this.camera.toWorld(px, py);
    const slack = 6 / this.camera.scale;
    film.bodies.forEach((body, i) => {
      const { x, z, angle } = film.state(frame, i);
      const [dx, dz] = [wx - x, wz - z];
      const [lx, lz] = [dx * Math.cos(angle) + dz * Math.sin(angle), dz * Math.cos(angle) - dx * Math.sin(angle)];
      const inside = body.rects.some(
        ([x0, x1, z0, z1]) => lx > x0 - slack && lx < x1 + slack && lz > z0 - slack && lz < z1 + slack,
      );
      if (inside && (found === null || body.reach < film.bodies[found].reach)) found = i;
    });
    return found;
  }
}

/** 1, 2 or 5 times a power of ten, not less than that. */
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((digit) => digit * power >= least * 0.999) ?? 10);
}

function segment(context, x0, y0, x1, y1) {
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
}

function arrow(context, x0, y0, x1, y1, head) {
  const angle = Math.atan2(y1 - y0, x1 - x0);
  segment(context, x0, y0, x1, y1);
  for (const turn of [2.6, -2.6]) {
    segment(context, x1, y1, x1 + head * Math.cos(angle + turn), y1 + head * Math.sin(angle + turn));
  }
}

function diamond(context, x, y, size) {
  context.moveTo(x + size, y);
  context.lineTo(x, y - size);
  context.lineTo(x - size, y);
  context.lineTo(x, y + size);
  context.closePath();
}
