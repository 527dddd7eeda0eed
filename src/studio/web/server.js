// Questions to the studio's server.

const JSON_BODY = { "content-type": "application/json" };

/** Asks and gives the answer; a refusal is an error with its text. */
export async function ask(name, question) {
  const options = question === undefined ? {} : { method: "POST", headers: JSON_BODY, body: JSON.stringify(question) };
  const response = await fetch(name, options);
  const answer = await response.json();
  if (!response.ok) throw new Refused(answer.error);
  return answer;
}

/** The server is there, and will not. */
export class Refused extends Error {}

/** A run as it comes: `{ text }`, an event, or `{ film }`, bytes for the player. Ends it when the signal says so. */
export async function* run(question, signal) {
  const options = { method: "POST", headers: JSON_BODY, body: JSON.stringify(question), signal };
  const response = await fetch("run", options);
  if (!response.ok) throw new Refused((await response.json()).error);
  const reader = response.body.getReader();
  const buffer = new Buffer();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    buffer.add(value);
    for (let piece = buffer.take(); piece; piece = buffer.take()) yield piece;
  }
}

/** Pieces of a stream: a byte for the kind, four for the length, then the content. */
class Buffer {
  #chunks = [];
  #length = 0;

  add(chunk) {
    this.#chunks.push(chunk);
    this.#length += chunk.length;
  }

  take() {
    if (this.#length < 5) return null;
    const head = this.#join(5);
    const length = new DataView(head.buffer, head.byteOffset).getUint32(1, true);
    if (this.#length < 5 + length) return null;
    const all = this.#join(5 + length);
    const content = all.slice(5, 5 + length);
    this.#chunks = [all.subarray(5 + length)];
    this.#length -= 5 + length;
    if (all[0] === "J".charCodeAt(0)) return { text: JSON.parse(new TextDecoder().decode(content)) };
    return { film: content };
  }

  /** The first chunk, made at least that long. */
  #join(length) {
    if (this.#chunks[0].length < length) {
      const all = new Uint8Array(this.#length);
      let at = 0;
      for (const chunk of this.#chunks) {
        all.set(chunk, at);
        at += chunk.length;
      }
      this.#chunks = [all];
    }
    return this.#chunks[0];
  }
}
