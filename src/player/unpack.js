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

  /** The same of numbers that were written as differences from where the two before lead. */
  bends(count, see) {
    let [last, step] = [0, 0];
    for (let i = 0; i < count; i++) {
      const value = last + step + this.next();
      step = i === 0 ? 0 : value - last;
      see((last = value), i);
    }
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
function posesOf(head, bytes) {
  const { frames, bodies, quantum, middle } = head;
  const numbers = new Numbers(bytes);
  const poses = {};
  for (const name of CHANNELS) poses[name] = new Float64Array(frames * bodies.length);
  const read = (name, body, way, unit, zero) => {
    const column = poses[name];
    numbers[way](frames, (value, frame) => (column[frame * bodies.length + body] = zero + value * unit));
  };
  const turn = (value) => value - Math.ceil(value / TAU - 0.5) * TAU; // into (−π, π]
  for (let body = 0; body < bodies.length; body++) {
    if (!bodies[body].moves) {
      // What stands still is written once.
      CHANNELS.forEach((name, k) => {
        const unit = [quantum.place, quantum.place, quantum.angle, 0, 0, 0][k];
        const value = (k < 2 ? middle[k] : 0) + (k < 3 ? numbers.next() : 0) * unit;
        for (let frame = 0; frame < frames; frame++) poses[name][frame * bodies.length + body] = value;
      });
      continue;
    }
    read("x", body, "bends", quantum.place, middle[0]);
    read("z", body, "bends", quantum.place, middle[1]);
    numbers.bends(frames, (value, frame) => (poses.angle[frame * bodies.length + body] = turn(value * quantum.angle)));
    read("vx", body, "steps", quantum.velocity, 0);
    read("vz", body, "steps", quantum.velocity, 0);
    read("spin", body, "steps", quantum.spin, 0);
  }
  return poses;
}

const FLOAT = new DataView(new ArrayBuffer(4));

/** The number whose f32 begins with these 26 bits. */
function unroll(bits) {
  FLOAT.setUint32(0, bits * 64);
  return FLOAT.getFloat32(0);
}

/** Exchanges, a column each, in order. */
function hitsOf(head, bytes) {
  const { hits: count, quantum, middle } = head;
  const numbers = new Numbers(bytes);
  const iteration = numbers.column(count);
  const [a, b, x, z, normal, depth] = [0, 1, 2, 3, 4, 5].map(() => numbers.column(count));
  return {
    count,
    iteration,
    a,
    b,
    x: x.map((value) => middle[0] + value * quantum.place),
    z: z.map((value) => middle[1] + value * quantum.place),
    normal: normal.map((value) => value * quantum.normal),
    depth: depth.map(unroll),
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
        points: [[x0[i], z0[i]], [x1[i], z1[i]]].map((p) => p.map((value) => value * quantum.touch)),
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

/** A film from its bytes: an ArrayBuffer or Uint8Array as a page or a server carries it. */
async function unpack(packed) {
  const bytes = await inflate(packed);
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  if (head.format !== 1) throw new Error(`This player reads films of format 1, and this is one of format ${head.format}.`);
  let at = 4 + length;
  const [iterations, poses, hits, touches, series] = head.sections.map((size) => bytes.subarray(at, (at += size)));
  return new Film(head, {
    iteration: new Numbers(iterations).column(head.frames),
    poses: posesOf(head, poses),
    hits: hitsOf(head, hits),
    touches: touchesOf(head, touches),
    series: seriesOf(head, series),
  });
}
