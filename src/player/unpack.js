// Reads what `pack.rs` writes: a length, a head of JSON, and numbers as bytes; all of it deflated.

async function inflate(bytes) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error(
      "This browser cannot unpack the recording: it has no DecompressionStream. Browsers since 2023 have it " +
        "(Chrome 80, Edge 80, Firefox 113, Safari 16.4).",
    );
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromBase64(text) {
  const characters = atob(text.trim());
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < characters.length; i++) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** Whole numbers written seven bits at a time, the sign in the lowest bit. */
class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next() {
    let byte = this.bytes[this.at++];
    if (byte < 0x80) return byte & 1 ? -(byte + 1) / 2 : byte / 2;
    let [value, weight] = [byte & 0x7f, 128];
    do {
      byte = this.bytes[this.at++];
      value += (byte & 0x7f) * weight; // beyond 32 bits, where shifts end
      weight *= 128;
    } while (byte >= 0x80);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }

  /** Calls with each of so many numbers that were written as steps from one to the next. */
  steps(count, see) {
    for (let i = 0, last = 0; i < count; i++) see((last += this.next()), i);
  }

  column(count) {
    const column = new Float64Array(count);
    this.steps(count, (value, i) => (column[i] = value));
    return column;
  }
}

const TAU = 2 * Math.PI;
const CHANNELS = ["x", "z", "angle", "vx", "vz", "spin"];

/** The places and motions: for every channel an array, frame after frame, a number per body. */
function posesOf(head, bytes, times) {
  const { frames, bodies, quantum, middle } = head;
  const numbers = new Numbers(bytes);
  const poses = Object.fromEntries(CHANNELS.map((name) => [name, new Float64Array(frames * bodies.length)]));
  const channels = [
    { place: poses.x, motion: poses.vx, step: quantum.place, unit: quantum.velocity, zero: middle[0], angle: false },
    { place: poses.z, motion: poses.vz, step: quantum.place, unit: quantum.velocity, zero: middle[1], angle: false },
    { place: poses.angle, motion: poses.spin, step: quantum.angle, unit: quantum.spin, zero: 0, angle: true },
  ];
  bodies.forEach((body, index) => {
    for (const channel of channels) {
      if (body.moves) readCourse(numbers, channel, times, bodies.length, index);
      else readPlace(numbers, channel, frames, bodies.length, index);
    }
  });
  return poses;
}

/** What stands still is written once. */
function readPlace(numbers, { place, step, zero }, frames, bodies, body) {
  const value = frames ? zero + numbers.next() * step : zero;
  for (let at = body; at < place.length; at += bodies) place[at] = value;
}

/** Velocities as steps; places by their distance from where the mean of the velocities before and after leads. */
function readCourse(numbers, { place, motion, step, unit, zero, angle }, times, bodies, body) {
  const whole = numbers.column(times.length);
  let last = 0;
  for (let frame = 0, at = body; frame < times.length; frame++, at += bodies) {
    if (frame > 0) {
      const mean = 0.5 * (whole[frame - 1] + whole[frame]);
      const led = Math.floor(mean * (unit / step) * (times[frame] - times[frame - 1]) + 0.5);
      if (Math.abs(led) < 2 ** 50) last += led;
    }
    last += numbers.next();
    motion[at] = whole[frame] * unit;
    place[at] = angle ? turned(last * step) : zero + last * step;
  }
}

/** An angle in (−π, π]. */
function turned(angle) {
  return angle - Math.ceil(angle / TAU - 0.5) * TAU;
}

const FLOAT = new DataView(new ArrayBuffer(4));

/** The number whose f32 begins with these 18 bits. */
function unroll(bits) {
  FLOAT.setUint32(0, bits * 2 ** 14);
  return FLOAT.getFloat32(0);
}

/** Exchanges in order of time, a column each; those of frame f begin at first[f]. */
function hitsOf(head, bytes, poses) {
  const { hits: count, frames, bodies, quantum } = head;
  const numbers = new Numbers(bytes);
  const [frame, iteration, a, b, x, z, normal, depth] = Array.from({ length: 8 }, () => numbers.column(count));
  const first = new Uint32Array(frames + 1);
  for (let hit = 0; hit < count; hit++) first[frame[hit] + 1]++;
  for (let f = 0; f < frames; f++) first[f + 1] += first[f];
  const order = new Uint32Array(count); // they were written pair after pair
  const next = first.slice();
  for (let hit = 0; hit < count; hit++) order[next[frame[hit]]++] = hit;
  const column = (value) => Float64Array.from(order, value);
  const stands = (hit) => frame[hit] * bodies.length + a[hit];
  return {
    count,
    first,
    iteration: column((hit) => iteration[hit]),
    a: column((hit) => a[hit]),
    b: column((hit) => b[hit]),
    x: column((hit) => poses.x[stands(hit)] + x[hit] * quantum.point),
    z: column((hit) => poses.z[stands(hit)] + z[hit] * quantum.point),
    normal: column((hit) => normal[hit] * quantum.normal),
    depth: column((hit) => unroll(depth[hit])),
  };
}

/** Contacts that last: for each pair the frames in which it pressed; given back frame by frame. */
function touchesOf(head, bytes) {
  const { touches: pairs, frames, quantum } = head;
  const numbers = new Numbers(bytes);
  const byFrame = Array.from({ length: frames }, () => []);
  for (let pair = 0; pair < pairs; pair++) {
    const [a, b, count] = [numbers.next(), numbers.next(), numbers.next()];
    const frame = numbers.column(count);
    const [normal, x0, z0, x1, z1, push] = [0, 1, 2, 3, 4, 5].map(() => numbers.column(count));
    for (let i = 0; i < count; i++) {
      byFrame[frame[i]].push({
        a,
        b,
        normal: normal[i] * quantum.normal,
        points: [[x0[i], z0[i]], [x1[i], z1[i]]].map((p) => p.map((value) => value * quantum.point)),
        push: unroll(push[i]),
      });
    }
  }
  return byFrame;
}

/** Columns of f64 by name; of a ledger that was kept, four columns a cause. */
function seriesOf(head, bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const series = {};
  head.series.forEach((name, k) => {
    const column = new Float64Array(head.frames);
    for (let i = 0; i < head.frames; i++) column[i] = view.getFloat64((k * head.frames + i) * 8, true);
    series[name] = column;
  });
  return series;
}

/** A film from its bytes: an ArrayBuffer or Uint8Array as a page carries it, deflated. */
const unpack = async (packed) => read(await inflate(packed));

/** A film from its bytes as they are: a Uint8Array. */
function read(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  if (head.format !== 1) throw new Error(`This player reads films of format 1, and this is one of format ${head.format}.`);
  let at = 4 + length;
  const [iterations, poses, hits, touches, columns] = head.sections.map((size) => bytes.subarray(at, (at += size)));
  const series = seriesOf(head, columns);
  const course = posesOf(head, poses, series.time);
  return new Film(head, {
    iteration: new Numbers(iterations).column(head.frames),
    poses: course,
    hits: hitsOf(head, hits, course),
    touches: touchesOf(head, touches),
    series,
  });
}
