// A run as the player shows it: numbers by frame and body, and questions about them.

class Film {
  constructor(head, { iteration, poses, hits, touches, series }) {
    Object.assign(this, { head, iteration, poses, hits, touches, series });
    this.bodies = head.bodies;
    this.frames = head.frames;
    this.times = series.time;
    this.index = new Map(this.bodies.map((body, i) => [body.name, i]));
    for (const body of this.bodies) {
      body.reach = Math.max(0, ...body.rects.map(([x0, x1, z0, z1]) => Math.hypot(Math.max(-x0, x1), Math.max(-z0, z1))));
    }
    this.fastest = this.#greatestSpeed();
    const sizes = this.bodies.filter(({ kind }) => kind === "mobile").map(({ reach }) => reach).sort((a, b) => a - b);
    this.typical = sizes[sizes.length >> 1] ?? 1; // how far a middling mobile body reaches [m]
  }

  /** Of all bodies over the whole run [m/s]. */
  #greatestSpeed() {
    const { vx, vz } = this.poses;
    let most = 0;
    for (let i = 0; i < vx.length; i++) most = Math.max(most, vx[i] * vx[i] + vz[i] * vz[i]);
    return Math.sqrt(most);
  }

  get duration() {
    return this.times[this.frames - 1] - this.times[0];
  }

  /** The last frame at that time or before it. */
  frameAt(time) {
    let [low, high] = [0, this.frames - 1];
    const limit = time + 1e-9 * Math.max(1, Math.abs(time));
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= limit) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** One body in one frame. */
  state(frame, body) {
    const at = frame * this.bodies.length + body;
    const { x, z, angle, vx, vz, spin } = this.poses;
    return { x: x[at], z: z[at], angle: angle[at], vx: vx[at], vz: vz[at], spin: spin[at] };
  }

  /** One moment more of these bodies, with those that are named standing elsewhere: [{ name, x, z, angle }]. */
  still(places) {
    const bodies = places.flatMap(({ name }) => (this.index.has(name) ? [this.bodies[this.index.get(name)]] : []));
    const known = places.filter(({ name }) => this.index.has(name));
    const column = (key) => Float64Array.from(known, (place) => place[key] ?? 0);
    const poses = Object.fromEntries(CHANNELS.map((key) => [key, column(key)]));
    const none = { count: 0, first: [0, 0] };
    return new Film({ ...this.head, bodies, frames: 1 },
      { iteration: [0], poses, hits: none, touches: [[]], series: { time: Float64Array.of(0) } });
  }

  hitsIn(frame) {
    return [this.hits.first[frame], this.hits.first[frame + 1]];
  }

  /** The part of the world that is worth seeing: where mobile bodies are nearly all the time, and what of the fixed ones is near. */
  get bounds() {
    const mobile = this.bodies.flatMap((body, i) => (body.kind === "mobile" ? [i] : []));
    const usual = mobile.length ? this.#usual(mobile) : null;
    let all = usual;
    const room = usual && 0.25 * Math.max(usual[1] - usual[0], usual[3] - usual[2]);
    for (let i = 0; i < this.bodies.length; i++) {
      if (this.bodies[i].kind === "mobile") continue;
      const box = this.boxOf(0, i);
      if (!usual) all = union(all, box);
      else if (box[0] < usual[1] + room && box[1] > usual[0] - room && box[2] < usual[3] + room && box[3] > usual[2] - room) {
        const near = (low, high, k) => [Math.max(box[k], low - room), Math.min(box[k + 1], high + room)];
        all = union(all, [...near(usual[0], usual[1], 0), ...near(usual[2], usual[3], 2)]);
      }
    }
    return all ?? [-1, 1, -1, 1];
  }

  /** The upright box around a body: x from, to, z from, to. */
  boxOf(frame, body) {
    const { x, z, angle } = this.state(frame, body);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const corners = this.bodies[body].rects.flatMap(([x0, x1, z0, z1]) => [[x0, z0], [x1, z0], [x1, z1], [x0, z1]]);
    const [xs, zs] = [[], []];
    for (const [px, pz] of corners.length ? corners : [[0, 0]]) {
      xs.push(x + px * c - pz * s);
      zs.push(z + px * s + pz * c);
    }
    return [Math.min(...xs), Math.max(...xs), Math.min(...zs), Math.max(...zs)];
  }

  /** Where those bodies are, but for the outermost hundredth of what twenty thousand looks at most see. */
  #usual(bodies) {
    const reach = Math.max(...bodies.map((body) => this.bodies[body].reach));
    const all = bodies.length * this.frames;
    const looks = Math.min(all, 20000);
    const [xs, zs] = [[], []];
    for (let look = 0; look < looks; look++) {
      // Spread by the golden section: even steps could miss whole columns of bodies.
      const k = looks === all ? look : Math.floor(((look * 0.6180339887498949) % 1) * all);
      const { x, z } = this.state(Math.floor(k / bodies.length), bodies[k % bodies.length]);
      xs.push(x);
      zs.push(z);
    }
    const range = (values) => {
      values.sort((a, b) => a - b);
      const skip = Math.floor(values.length / 200);
      return [values[skip] - reach, values[values.length - 1 - skip] + reach];
    };
    return [...range(xs), ...range(zs)];
  }
}

function union(a, b) {
  if (!a) return b;
  return [Math.min(a[0], b[0]), Math.max(a[1], b[1]), Math.min(a[2], b[2]), Math.max(a[3], b[3])];
}
